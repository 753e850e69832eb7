#include <snowgrowth/snowgrowth.h>
#include <stdio.h>

int main(void)
{
    snow_reiter_params params;
    snow_summary summary;
    snow_grid *grid = NULL;

    snow_reiter_params_init(&params, sizeof params); /* Reiter's scene: one seed in a disc of radius 200 */
    snow_summary_init(&summary, sizeof summary);
    params.background = 0.4;  /* β: the vapour at the start */
    params.addition = 0.0001; /* γ: what a cell at the ice gains in each step */

    snow_status status = snow_reiter_create(&params, NULL, &grid);
    if (status == SNOW_OK)
        status = snow_run(grid, NULL, &summary); /* until the ice nears the rim */
    if (status == SNOW_OK)
        printf("%lld steps, %llu cells of ice\n", (long long)summary.steps, (unsigned long long)summary.frozen);
    else
        fprintf(stderr, "hello: %s\n", snow_strerror(status));
    snow_destroy(grid); /* NULL is fine */
    return status == SNOW_OK ? 0 : 1;
}
