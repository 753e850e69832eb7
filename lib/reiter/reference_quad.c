/* The QUAD engine: double-double numbers, about 31 digits, without a quantum.

   The error-free transformations are those of T. J. Dekker, "A floating-point
   technique for extending the available precision", Numerische Mathematik 18
   (1971) 224–242, and D. E. Knuth, The Art of Computer Programming, vol. 2. */
#include "reiter/model.h"

typedef struct real {
    double high;
    double low; /* at most half a unit in the last place of high */
} real;

static real real_make(double high, double low)
{
    return (real){high, low};
}

static double real_high(real x)
{
    return x.high;
}

static double real_low(real x)
{
    return x.low;
}

/* high + low where |high| >= |low|. */
static real normalise(double high, double low)
{
    double sum = high + low;
    return (real){sum, low - (sum - high)};
}

static real sum_of(double x, double y)
{
    double sum = x + y;
    double part = sum - x;
    return (real){sum, (x - (sum - part)) + (y - part)};
}

static real product_of(double x, double y)
{
    double product = x * y;
    return (real){product, fma(x, y, -product)};
}

static real real_add(real x, real y)
{
    real high = sum_of(x.high, y.high);
    real low = sum_of(x.low, y.low);
    high = normalise(high.high, high.low + low.high);
    return normalise(high.high, high.low + low.low);
}

static real real_subtract(real x, real y)
{
    return real_add(x, (real){-y.high, -y.low});
}

static real real_multiply(real x, real y)
{
    real product = product_of(x.high, y.high);
    return normalise(product.high, product.low + (x.high * y.low + x.low * y.high));
}

static real real_divide(double x, double y)
{
    double quotient = x / y;
    double rest = -fma(quotient, y, -x);
    return normalise(quotient, rest / y);
}

static real real_flow(const reiter *model, real sum)
{
    return real_multiply(real_divide(model->params.diffusion, 12), sum);
}

static real real_vapour(const reiter *model, real vapour)
{
    (void)model;
    return vapour;
}

#define REFERENCE_ENGINE snow_reiter_quad
#include "reiter/reference.h"
