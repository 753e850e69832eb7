/* The exit law of a hexagon has no closed form: expected visits G are solved
   for, with the twelve symmetries of the hexagon taken out. A site stands for
   its images; the equations
       6 G(s) - sum of G over the six neighbours = 6 [s is the centre],  G = 0 at distance r,
   each times the number of images, make a symmetric band matrix, which is
   factored as L D L^T. */
#include "aggregate/exits.h"

#include "base/hexagon.h"

#include <stddef.h>

/* Layer by layer; in a layer by the distance from the nearer corner. */
static int32_t number_of(int32_t layer, int32_t offset)
{
    int32_t half = layer / 2; /* layers below hold 1 + 1 + 2 + 2 + 3 + 3 ... */
    int32_t before = layer % 2 == 0 ? half * (half + 1) : (half + 1) * (half + 1);
    return before + offset;
}

/* Number of the site that stands for (q, r). */
static int32_t canonical_number(int64_t q, int64_t r)
{
    while (q < 0 || r < 0 || (q == 0 && r != 0)) {
        int64_t turned = -r;
        r = q + r;
        q = turned;
    }
    int32_t layer = (int32_t)(q + r);
    int32_t offset = (int32_t)(r < q ? r : q);
    return number_of(layer, offset);
}

static int32_t images(int32_t layer, int32_t offset)
{
    if (layer == 0)
        return 1;
    return offset == 0 || 2 * offset == layer ? 6 : 12;
}

static const int64_t step_q[6] = {1, 0, -1, -1, 0, 1};
static const int64_t step_r[6] = {0, 1, 1, 0, -1, -1};

/* Row i holds the columns i - width … i. */
typedef struct band {
    double *value;
    int32_t width;
} band;

static double *row_of(const band *matrix, int32_t i)
{
    return matrix->value + (size_t)i * (size_t)(matrix->width + 1) + matrix->width - i;
}

static void fill(const band *matrix, int32_t radius)
{
    for (int32_t layer = 0; layer < radius; layer++) {
        for (int32_t offset = 0; 2 * offset <= layer; offset++) {
            int32_t i = number_of(layer, offset);
            double weight = images(layer, offset);
            double *row = row_of(matrix, i);
            row[i] += 6 * weight;
            for (int k = 0; k < 6; k++) {
                int64_t q = layer - offset + step_q[k];
                int64_t r = offset + step_r[k];
                int32_t j = canonical_number(q, r);
                if (snow_hexagon_distance(q, r) < radius && j <= i)
                    row[j] -= weight;
            }
        }
    }
}

/* L below the diagonal, D on it, a column at a time. */
static void factor(const band *matrix, int32_t count, double *column)
{
    for (int32_t j = 0; j < count; j++) {
        int32_t last = j + matrix->width < count ? j + matrix->width : count - 1;
        double pivot = row_of(matrix, j)[j];
        for (int32_t i = j + 1; i <= last; i++)
            column[i] = row_of(matrix, i)[j];
        for (int32_t i = j + 1; i <= last; i++) {
            double *row = row_of(matrix, i);
            double scaled = column[i] / pivot;
            row[j] = scaled;
            if (scaled == 0)
                continue;
            for (int32_t k = j + 1; k <= i; k++)
                row[k] -= scaled * column[k];
        }
    }
}

/* The centre is number 0: L y = e0 first, then back. */
static void solve(const band *matrix, int32_t count, double *visits)
{
    for (int32_t i = 0; i < count; i++) {
        const double *row = row_of(matrix, i);
        double sum = i == 0 ? 6 : 0;
        for (int32_t j = i > matrix->width ? i - matrix->width : 0; j < i; j++)
            sum -= row[j] * visits[j];
        visits[i] = sum;
    }
    for (int32_t i = 0; i < count; i++)
        visits[i] /= row_of(matrix, i)[i];
    for (int32_t i = count - 1; i > 0; i--) {
        const double *row = row_of(matrix, i);
        for (int32_t j = i > matrix->width ? i - matrix->width : 0; j < i; j++)
            visits[j] -= row[j] * visits[i];
    }
}

static void collect(const double *visits, int32_t radius, double *chance)
{
    for (int32_t t = 0; t < radius; t++) {
        double sum = 0;
        for (int k = 0; k < 6; k++) {
            int64_t q = radius - t + step_q[k];
            int64_t r = t + step_r[k];
            if (snow_hexagon_distance(q, r) < radius)
                sum += visits[canonical_number(q, r)];
        }
        chance[t] = sum / 6;
    }
}

snow_status snow_exits_hexagonal(int32_t radius, double *chance, snow_heap *heap)
{
    int32_t count = number_of(radius, 0);
    band matrix = {NULL, radius / 2 + 2};
    double *visits = snow_heap_get_raw(heap, (size_t)count, sizeof *visits);
    if (visits == NULL)
        return heap->refusal;
    matrix.value = snow_heap_get(heap, (size_t)count * (size_t)(matrix.width + 1), sizeof *matrix.value);
    if (matrix.value != NULL) {
        fill(&matrix, radius);
        factor(&matrix, count, visits);
        solve(&matrix, count, visits);
        collect(visits, radius, chance);
    }
    snow_status status = matrix.value == NULL ? heap->refusal : SNOW_OK;
    snow_heap_put(heap, matrix.value);
    snow_heap_put(heap, visits);
    return status;
}
