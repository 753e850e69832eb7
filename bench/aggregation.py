#!/usr/bin/env python3
"""Time a walk against the error of hit probabilities: python3 bench/aggregation.py results/aggregation.csv OUT.png"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {row["way"]: row for row in rows if row["part"] == "law"}  # the last of each way


def draw(rows, path):
    figure, axes = plt.subplots(figsize=(8, 5), dpi=150)
    for name, row in rows.items():
        time = float(row["microseconds_a_particle"])
        bias, seen = float(row["bias"]), float(row["bias_seen"])
        exact = name == "exact jumps"
        colour = "#c02020" if exact else "#8090a0" if name == "steps, exact return" else "#305080"
        if bias > seen:
            axes.plot(100 * bias, time, "o", color=colour, markersize=9)
            place = 100 * bias
        else:  # none was found: an arrow from what would have been found
            place = 100 * seen
            axes.annotate("", (place / 1.6, time), (place, time),
                          arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2})
            axes.plot(place, time, "|", color=colour, markersize=14, markeredgewidth=2)
        axes.annotate(name, (place, time), (0, 11), textcoords="offset points", ha="center",
                      color=colour, fontweight="bold" if exact else "normal")
    axes.set_xscale("log")
    axes.set_yscale("log")
    low, high = axes.get_xlim()
    axes.set_xlim(low / 1.6, high * 1.6)
    low, high = axes.get_ylim()
    axes.set_ylim(low / 1.5, high * 1.8)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
    axes.set_xlabel("relative error of the hit probabilities, %   (arrow: none seen, it is less than this)")
    axes.set_ylabel("processor time a walk, µs")
    particles = next(iter(rows.values()))["particles"]
    axes.set_title(f"Walkers that end on a cluster of {particles} particles: lower left is better")
    axes.grid(True, which="both", alpha=0.2)
    figure.tight_layout()
    figure.savefig(path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(read(sys.argv[1]), sys.argv[2])
