/* The REFERENCE engine: doubles, with the model's quantum, hence the bits of the fast engines. */
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

static double real_divide(double x, double y)
{
    return x / y;
}

static double real_flow(const reiter *model, double flow)
{
    return reiter_round(flow, reiter_rounder(model));
}

static double real_vapour(const reiter *model, double vapour)
{
    return reiter_settled(model, vapour);
}

#define REFERENCE_ENGINE snow_reiter_reference
#include "reiter/reference.h"
