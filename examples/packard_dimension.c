/* How crystals fill the plane under different rules: a table of rule against dimension. */
#include "common/message.h"
#include "common/options.h"

#include <snowgrowth/snowgrowth.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* The rules of the paper, and one whose crystals have no holes. */
static const char *const rules[] = {"0100000", "0100010", "0101010", "0101100", "0110000", "0110100"};

static snow_status grow(const char *rule, int64_t steps, snow_grid **grid)
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    snow_status status = snow_packard_params_rule(&params, rule);
    if (status == SNOW_OK)
        status = snow_packard_create(&params, NULL, grid);
    return status == SNOW_OK ? snow_step(*grid, steps) : status;
}

/* N(side) ~ side^−D, from boxes of 2 and of 16 cells. */
static snow_status box_dimension(const snow_grid *grid, double *dimension)
{
    uint64_t small = 0, large = 0;
    snow_status status = snow_box_count(grid, 2, &small);
    if (status == SNOW_OK)
        status = snow_box_count(grid, 16, &large);
    if (status == SNOW_OK)
        *dimension = log2((double)small / (double)large) / 3;
    return status;
}

static snow_status print_rule(const char *rule, int64_t steps)
{
    snow_grid *grid = NULL;
    uint64_t frozen = 0;
    double by_radius = 0, by_boxes = 0, density = 0;
    snow_status status = grow(rule, steps, &grid);
    if (status == SNOW_OK)
        status = snow_frozen(grid, &frozen);
    if (status == SNOW_OK)
        status = snow_dimension(grid, &by_radius);
    if (status == SNOW_OK)
        status = box_dimension(grid, &by_boxes);
    if (status == SNOW_OK)
        status = snow_density(grid, &density);
    if (status == SNOW_OK)
        printf("%s  %10" PRIu64 "  %8.4f  %8.4f  %8.4f\n", rule, frozen, by_radius, by_boxes, density);
    snow_destroy(grid);
    return status;
}

int main(int argc, char **argv)
{
    int64_t steps = 1000;
    option_row rows[] = {
        OPTION_GROUP("The crystals"),
        OPTION_LONG("steps", "STEPS", &steps, 32, 100000, "how long each grows (1000)"),
        OPTION_END,
    };
    program command = {"packard_dimension",
                       "Prints for several rules how many cells are frozen, the dimension of mass and radius, that of\n"
                       "box counting, and the density within the hexagon.",
                       "packard_dimension --steps 100", rows};
    int exit_code;

    if (!options_read(&command, argc, argv, &exit_code))
        return exit_code;
    printf("rule     population  D(radius)  D(boxes)   density\n");
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        snow_status status = print_rule(rules[i], steps);
        if (status != SNOW_OK)
            return complain_status(rules[i], status);
    }
    return print_line("%s", "");
}
