#include "aggregate/spd.h"

#include <math.h>

/* In eight sums, which the processor can keep going side by side. */
static double dot(const double *a, const double *b, size_t count)
{
    enum { LANES = 8 };
    double sum[LANES] = {0};
    size_t whole = count - count % LANES;
    for (size_t i = 0; i < whole; i += LANES)
        for (size_t lane = 0; lane < LANES; lane++)
            sum[lane] += a[i + lane] * b[i + lane];
    for (size_t i = whole; i < count; i++)
        sum[0] += a[i] * b[i];
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

/* Row j of the factor must be there up to its diagonal when i > j, and row i up to column j. */
static void factor_entry(double *matrix, size_t count, size_t i, size_t j)
{
    double *row = matrix + i * count;
    const double *above = matrix + j * count;
    double left = matrix[j * count + i] - dot(row, above, j);
    row[j] = i == j ? sqrt(left) : left / above[j];
}

/* Row by row, but a block of rows at a time, for which each earlier row is read once. */
void snow_spd_factor(double *matrix, size_t count)
{
    enum { BLOCK = 16 };
    for (size_t first = 0; first < count; first += BLOCK) {
        size_t end = count - first < BLOCK ? count : first + BLOCK;
        for (size_t j = 0; j < end; j++)
            for (size_t i = j > first ? j : first; i < end; i++)
                factor_entry(matrix, count, i, j);
    }
}

void snow_spd_solve(const double *matrix, size_t count, double *vector)
{
    for (size_t i = 0; i < count; i++)
        vector[i] = (vector[i] - dot(matrix + i * count, vector, i)) / matrix[i * count + i];
    for (size_t i = count; i-- > 0;) {
        vector[i] /= matrix[i * count + i];
        for (size_t j = 0; j < i; j++)
            vector[j] -= matrix[i * count + j] * vector[i];
    }
}
