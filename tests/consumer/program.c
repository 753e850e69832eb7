/*
 * A program that knows the library only as it is installed. C and C++ both
 * compile it. It grows a crystal whose size is known and fails on any other.
 */
#include <snowgrowth/snowgrowth.h>

#include <stdio.h>

int main(void)
{
    snow_reiter_params params;
    snow_reiter_params_init(&params, sizeof params);
    params.radius = 100;

    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);

    snow_grid *grid = NULL;
    snow_status status = snow_reiter_create(&params, NULL, &grid);
    if (status == SNOW_OK)
        status = snow_run(grid, NULL, &summary);
    snow_destroy(grid);
    if (status != SNOW_OK) {
        fprintf(stderr, "program: %s\n", snow_strerror(status));
        return 1;
    }
    printf("version=%s steps=%ld frozen=%lu\n", snow_version_text(), (long)summary.steps, (unsigned long)summary.frozen);
    return !(snow_version() == SNOW_VERSION && summary.steps == 2011 && summary.frozen == 7975);
}
