/*
 * The two passes of a step and what else must know the numbers: plain.c includes this once for each type of number.
 * REAL is the type, NAMED(x) the name that x has for it.
 */

/* The start. Cells outside the interior keep the background in value and vapour. */
static void NAMED(load)(plain_crystal *crystal, const double *values)
{
    REAL *value = crystal->value;
    for (size_t i = 0; i < padded_count(crystal); i++)
        value[i] = (REAL)values[i];
    memcpy(crystal->vapour, value, padded_count(crystal) * sizeof *value);
}

static double NAMED(read)(const plain_crystal *crystal, size_t index)
{
    return ((const REAL *)crystal->value)[index];
}

static bool NAMED(rim_reached)(const plain_crystal *crystal)
{
    const REAL *value = crystal->value;
    for (size_t i = 0; i < crystal->rim_count; i++) {
        if (value[crystal->rim[i]] >= 1)
            return true;
    }
    return false;
}

static REAL NAMED(greater)(REAL a, REAL b)
{
    return a > b ? a : b;
}

/* First pass: v, and what receptive cells keep. One comparison a cell, for seven in a row are not vectorised. */
static void NAMED(split_row)(row_span span, size_t stride, REAL addition, const REAL *restrict value,
                             REAL *restrict vapour, REAL *restrict kept)
{
    for (size_t i = span.first; i < span.end; i++) {
        REAL row = NAMED(greater)(NAMED(greater)(value[i - 1], value[i]), value[i + 1]);
        REAL above = NAMED(greater)(value[i - stride], value[i - stride + 1]);
        REAL below = NAMED(greater)(value[i + stride - 1], value[i + stride]);
        REAL most = NAMED(greater)(row, NAMED(greater)(above, below));
        REAL gained = value[i] + addition;
        vapour[i] = most < 1 ? value[i] : 0;
        kept[i] = most < 1 ? 0 : gained;
    }
}

/* Second pass: u' = kept + v + (alpha / 12) (sum of the six neighbours' v - 6 v). */
static void NAMED(update_row)(row_span span, size_t stride, REAL rate, REAL *restrict value,
                              const REAL *restrict vapour, const REAL *restrict kept)
{
    for (size_t i = span.first; i < span.end; i++) {
        REAL sum = vapour[i + 1] + vapour[i - 1] + vapour[i + stride] + vapour[i - stride] +
                   vapour[i - stride + 1] + vapour[i + stride - 1];
        value[i] = kept[i] + vapour[i] + rate * (sum - 6 * vapour[i]);
    }
}

static void NAMED(step)(plain_crystal *crystal)
{
    REAL addition = (REAL)crystal->addition;
    REAL rate = (REAL)(crystal->diffusion / 12);
    for (int32_t row = 0; row < crystal->bounds.height; row++)
        NAMED(split_row)(crystal->rows[row], crystal->stride, addition, crystal->value, crystal->vapour,
                         crystal->kept);
    for (int32_t row = 0; row < crystal->bounds.height; row++)
        NAMED(update_row)(crystal->rows[row], crystal->stride, rate, crystal->value, crystal->vapour,
                          crystal->kept);
}

static const arithmetic NAMED(arithmetic) = {
    .size = sizeof(REAL),
    .load = NAMED(load),
    .read = NAMED(read),
    .rim_reached = NAMED(rim_reached),
    .step = NAMED(step),
};
