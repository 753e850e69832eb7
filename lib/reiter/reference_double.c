/* The REFERENCE engine: doubles that are multiples of the model's quantum, hence the bits of the fast engines. */
#include "reiter/model.h"

typedef double real;

static double real_make(double high, double low)
{
    return high + low;
}

static double real_high(double x)
{
    return x;
}

static double real_low(double x)
{
    (void)x;
    return 0;
}

static double real_add(double x, double y)
{
    return x + y;
}

static double real_subtract(double x, double y)
{
    return x - y;
}

static double real_multiply(double x, double y)
{
    return x * y;
}

/* In single precision the sum is a whole number of quanta that is rounded to a
   float, then its product with the weight, then that to a whole number. */
static double single_flow(const reiter *model, double sum)
{
    float quanta = (float)(sum / reiter_quantum(model));
    float flow = (float)((double)quanta * reiter_single_weight(model));
    return nearbyint(flow) * reiter_quantum(model);
}

static double real_flow(const reiter *model, double sum)
{
    if (reiter_is_single(model))
        return single_flow(model, sum);
    return reiter_round(model->params.diffusion / 12 * sum, reiter_rounder(model));
}

static double real_vapour(const reiter *model, double vapour)
{
    return reiter_settled(model, vapour);
}

#define REFERENCE_ENGINE snow_reiter_reference
#include "reiter/reference.h"
