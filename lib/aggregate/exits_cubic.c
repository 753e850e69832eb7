/* The exit law of a cube, in closed form as that of a square (McCrea and Whipple 1940). With n = 2r,
       P(y, z) = (2/n^2) sum over odd j, k < n of cos(j pi y/n) cos(k pi z/n) / cosh(a_jk r),
       cosh(a_jk) = 3 - cos(j pi/n) - cos(k pi/n). */
#include "aggregate/exits.h"
#include "aggregate/series.h"

/* Terms fall like e^(-sqrt(j^2 + k^2) pi/2): more are below 2^-60. */
enum { TERMS = 16 };

snow_status snow_exits_cubic(int32_t radius, double *chance, snow_heap *heap)
{
    double *cosine = snow_heap_get_raw(heap, (size_t)radius, sizeof *cosine);
    if (cosine == NULL)
        return heap->refusal;
    for (int32_t x = 0; x < radius; x++)
        cosine[x] = snow_series_cosine(x, radius);
    int terms = radius < TERMS ? radius : TERMS;
    double weight[TERMS][TERMS];
    for (int j = 0; j < terms; j++) {
        for (int k = 0; k < terms; k++) {
            double excess = snow_series_versine(2 * j + 1, radius) + snow_series_versine(2 * k + 1, radius);
            weight[j][k] = snow_series_decay(excess, radius) / (2.0 * radius * radius);
        }
    }
    for (int32_t a = 0; a < radius; a++) {
        double line[TERMS];
        for (int j = 0; j < terms; j++)
            line[j] = snow_series_odd_cosines(weight[j], terms, cosine[a]);
        for (int32_t b = 0; b <= a; b++)
            chance[a * (a + 1) / 2 + b] = snow_series_odd_cosines(line, terms, cosine[b]);
    }
    snow_heap_put(heap, cosine);
    return SNOW_OK;
}
