#!/usr/bin/env python3
"""Draws the work-precision diagram from the figures of snowgrowth-accuracy, and renews the tables of a page: what
stands between <!-- NAME --> and <!-- end --> for the names errors, tolerances and speeds.

    python3 bench/work_precision.py bench/results/accuracy.csv doc/pictures/work-precision.png doc/accuracy.md

Needs matplotlib; pngquant, where there is one, makes the picture small.
"""
import csv
import re
import shutil
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PANELS = [
    ("dendrite-r100", "dendrite: β 0.4, γ 0.001, α 1, R 100"),
    ("star", "star: β 0.6, γ 0.01, α 1, R 100"),
    ("sector", "sectored plate: β 0.9, γ 0.05, α 1, R 100"),
    ("near-tie", "near tie: β 0.95, γ 0.05, α 1, R 100"),
    ("alpha-0.5", "slow diffusion: β 0.4, γ 0.0001, α 0.5, R 60"),
    ("alpha-2.003", "negative weight: β 0.4, γ 0.0001, α 2.003, R 60"),
    ("alpha-2.6", "nearly unstable: β 0.4, γ 0.0001, α 2.6, R 60"),
    ("plate-r60", "plate without vapour: β 0, γ 0.01, α 1, R 60"),
]
BEST_FIRST = ["avx512", "avx2", "baseline"]
DOUBLE, SINGLE, OTHER = "#1f5fa8", "#c2570c", "#444444"
ZERO, BAND = 1e-19, 1e-17  # where an error of exactly 0 is drawn, and the top of the strip for it
LOWEST, HIGHEST = 1e-20, 1e3
ABOVE, BELOW, RIGHT = (0, 9, "center"), (0, -9, "center"), (8, 0, "left")  # offset of a label in points
HIGHER, HIGHEST_LABEL = (0, 19, "center"), (0, 29, "center")
SPEEDS, ERRORS = [0.1, 1, 10, 100, 1000], [1, 1e-4, 1e-8, 1e-12, 1e-16]
CAPTION = """\
Each mark is one way of growing the crystal. To the right: faster. Up: less exact.
●  each cell freezes in the step in which it does with 31 digits
✖  not every cell does: so many cells are ice in only one of the two at the stop, or some froze a step off
Three joined marks: baseline, AVX2, AVX-512 (same bits). Dotted: tolerance τ, from 0 up to 10⁻⁴."""


def read_scenes(path):
    """The rows at each scene's stop, by scene and settings; figures as numbers."""
    scenes = {}
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            for name in ("step", "seconds", "max_error", "first_difference", "differing_cells", "stop_difference"):
                row[name] = float(row[name])
            row["tau"] = 0.0 if row["tolerance"] == "-" else float(row["tolerance"])
            rows = scenes.setdefault(row["scene"], {})
            key = tuple(row[name] for name in ("engine", "precision", "symmetry", "tau", "isa"))
            if key not in rows or rows[key]["step"] <= row["step"]:
                rows[key] = row
    return scenes


class Panel:
    def __init__(self, axes, rows):
        self.axes = axes
        self.rows = rows
        self.plain_seconds = self.row("plain", "double", "-")["seconds"]

    def row(self, engine, precision, symmetry, tau=0.0, isa="-"):
        return self.rows[(engine, precision, symmetry, tau, isa)]

    def place(self, row):
        return self.plain_seconds / row["seconds"], row["max_error"] or ZERO

    def mark(self, row, color, size=6):
        """A disc where all ice is exact, a cross where some is not."""
        same = row["first_difference"] < 0
        self.axes.plot(*self.place(row), marker="o" if same else "X", markersize=size if same else size + 2.5,
                       color=color, markeredgecolor="white", markeredgewidth=0.5, zorder=3)

    def label(self, text, row, color, offset):
        if row["differing_cells"] > 0:
            text += f": {row['differing_cells']:.0f} cells"
        elif row["first_difference"] >= 0:
            text += ": a step off"
        self.axes.annotate(text, self.place(row), xytext=offset[:2], textcoords="offset points", color=color,
                           fontsize=8.5, ha=offset[2], va="center", zorder=4)

    def join(self, rows, color, style):
        self.axes.plot(*zip(*[self.place(row) for row in rows]), color=color, linewidth=1.2, linestyle=style, zorder=2)

    def single_mark(self, engine, precision, text, offset):
        row = self.row(engine, precision, "-")
        self.mark(row, OTHER)
        self.label(text, row, OTHER, offset)

    def instruction_sets(self, precision, symmetry, color, text, offset):
        rows = [self.rows[key] for isa in BEST_FIRST
                if (key := ("rows", precision, symmetry, 0.0, isa)) in self.rows]
        self.join(rows, color, "-")
        for row in rows:
            self.mark(row, color)
        fastest = min(rows, key=lambda row: row["seconds"])
        self.label(text, fastest if offset is RIGHT else rows[len(rows) // 2], color, offset)
        return rows[0]

    def tolerances(self, start, color):
        tolerant = [row for key, row in self.rows.items() if key[:3] == ("rows", "double", "auto") and key[3] > 0]
        tolerant.sort(key=lambda row: row["tau"])
        self.join([start] + tolerant, color, ":")
        for row in tolerant:
            self.mark(row, color, 3.5)
        if tolerant[-1]["max_error"] > 100 * start["max_error"]:
            self.label("τ = 10⁻⁴", tolerant[-1], color, RIGHT)

    def draw(self):
        dry = self.row("plain", "double", "-")["max_error"] == 0
        self.single_mark("reference", "double", "reference", ABOVE)
        self.single_mark("plain", "double", "plain loop", ABOVE if dry else BELOW)
        self.single_mark("plain", "single", "plain loop, float", HIGHEST_LABEL if dry else ABOVE)
        self.instruction_sets("double", "none", DOUBLE, "every cell", ABOVE)
        start = self.instruction_sets("double", "auto", DOUBLE, "folded", ABOVE if dry else RIGHT)
        self.tolerances(start, DOUBLE)
        self.instruction_sets("single", "none", SINGLE, "every cell, single", HIGHER if dry else BELOW)
        self.instruction_sets("single", "auto", SINGLE, "folded, single", RIGHT)


def draw(scenes, picture):
    figure, grid = plt.subplots(4, 2, figsize=(11.5, 13), sharex=True, sharey=True)
    for axes, (name, title) in zip(grid.flat, PANELS):
        axes.set(xscale="log", yscale="log", xlim=(0.04, 5000), ylim=(LOWEST, HIGHEST))
        axes.set_title(title, fontsize=10, loc="left", fontweight="bold")
        axes.set_xticks(SPEEDS, [f"{speed:g}" for speed in SPEEDS])
        axes.set_yticks(ERRORS + [ZERO], ["1", "10⁻⁴", "10⁻⁸", "10⁻¹²", "10⁻¹⁶", "none"])
        axes.minorticks_off()
        axes.axhspan(LOWEST, BAND, color="#eaf3ea", zorder=0)
        axes.grid(True, color="#dddddd", linewidth=0.6)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        Panel(axes, scenes[name]).draw()
    figure.text(0.06, 0.985, CAPTION, fontsize=11, va="top", linespacing=1.5)
    figure.supxlabel("times as fast as the plain loop in doubles, one thread", fontsize=11)
    figure.supylabel("greatest error of the vapour at the stop", fontsize=11)
    figure.tight_layout(rect=(0, 0, 1, 0.92))
    figure.savefig(picture, dpi=100)
    if shutil.which("pngquant"):
        subprocess.run(["pngquant", "--force", "--ext", ".png", "32", picture], check=True)


def power(number):
    """1.2·10⁻⁸"""
    if number == 0:
        return "0"
    digits, exponent = f"{number:.1e}".split("e")
    return digits + "·10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def in_words(row):
    """The error, and what became of the ice where it is not the exact one."""
    text = power(row["max_error"])
    if row["differing_cells"] > 0:
        text += f"; {row['differing_cells']:.0f} cells"
    elif row["first_difference"] >= 0:
        text += "; a step off"
    return text + (f"; {row['stop_difference']:+.0f} steps" if row["stop_difference"] else "")


def table(heads, lines):
    return "\n".join("| " + " | ".join(line) + " |" for line in [heads, ["---"] * len(heads)] + lines)


def best_isa(rows):
    return next(isa for isa in BEST_FIRST if ("rows", "double", "auto", 0.0, isa) in rows)


def error_table(scenes):
    lines = []
    for name, _ in PANELS:
        rows = scenes[name]
        keys = [("plain", precision, "-", 0.0, "-") for precision in ("double", "single")]
        keys += [("rows", precision, "auto", 0.0, best_isa(rows)) for precision in ("double", "single")]
        lines.append([f"`{name}`", f"{rows[keys[0]]['step']:.0f}"] + [in_words(rows[key]) for key in keys])
    return table(["scene", "steps", "plain loop", "plain loop, float", "double", "single"], lines)


def tolerance_table(scenes):
    taus = [1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4]
    lines = [[f"`{name}`"] + [in_words(scenes[name][("rows", "double", "auto", tau, "auto")]) for tau in taus]
             for name, _ in PANELS]
    return table(["scene"] + [f"τ = {power(tau)[4:]}" for tau in taus], lines)


def speed_table(scenes):
    columns = [("double", 0.0), ("single", 0.0), ("double", 1e-8), ("double", 1e-6)]
    lines = []
    for name, _ in PANELS:
        rows = scenes[name]
        plain = rows[("plain", "double", "-", 0.0, "-")]["seconds"]
        keys = [("rows", precision, symmetry, tau, "auto" if tau else best_isa(rows))
                for symmetry in ("auto", "none") for precision, tau in columns]
        ratios = [plain / rows[key]["seconds"] for key in keys]
        lines.append([f"`{name}`"] + [f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.1f}" for ratio in ratios])
    heads = ["double", "single", "τ = 10⁻⁸", "τ = 10⁻⁶"]
    return table(["scene"] + [f"folded: {heads[0]}"] + heads[1:] + [f"every cell: {heads[0]}"] + heads[1:], lines)


def renew_tables(scenes, page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    for name, content in (("errors", error_table(scenes)), ("tolerances", tolerance_table(scenes)),
                          ("speeds", speed_table(scenes))):
        text, found = re.subn(rf"(<!-- {name} -->\n).*?(<!-- end -->)", rf"\1{content}\n\2", text, flags=re.DOTALL)
        if found != 1:
            sys.exit(f"{page} has no place for the table of {name}")
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    FIGURES = read_scenes(sys.argv[1])
    draw(FIGURES, sys.argv[2])
    renew_tables(FIGURES, sys.argv[3])
