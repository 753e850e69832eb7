/* x^y without libm, so that every platform gives the same bits. */
#ifndef SNOW_AGGREGATE_POWER_H
#define SNOW_AGGREGATE_POWER_H

#include <math.h>

/* x > 0, y >= 0: the product of x^(2^k) over the binary digits of y. Square
   roots are rounded correctly by IEEE 754. */
static inline double snow_power(double x, double y)
{
    double result = 1;
    double whole = floor(y);
    double square = x;
    for (unsigned n = (unsigned)whole; n > 0; n /= 2, square *= square)
        if (n % 2 != 0)
            result *= square;
    double rest = y - whole;
    double root = x;
    for (int digit = 0; digit < 52 && rest > 0; digit++) {
        root = sqrt(root);
        rest *= 2;
        if (rest >= 1) {
            result *= root;
            rest -= 1;
        }
    }
    return result;
}

#endif
