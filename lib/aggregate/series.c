#include "aggregate/series.h"

#include <math.h>

#define QUARTER_TURN 1.57079632679489661923

/* Taylor's series on [0, pi/4], where the last term is below 2^-60. */
static double small_cosine(double x)
{
    double square = x * x;
    double sum = 1;
    for (int n = 20; n > 0; n -= 2)
        sum = 1 - square * sum / (n * (n - 1));
    return sum;
}

static double small_sine(double x)
{
    double square = x * x;
    double sum = 1;
    for (int n = 21; n > 1; n -= 2)
        sum = 1 - square * sum / (n * (n - 1));
    return x * sum;
}

double snow_series_cosine(int64_t part, int64_t whole)
{
    if (2 * part <= whole)
        return small_cosine(QUARTER_TURN * (double)part / (double)whole);
    return small_sine(QUARTER_TURN * (double)(whole - part) / (double)whole);
}

double snow_series_versine(int64_t part, int64_t whole)
{
    double half = snow_series_cosine(2 * whole - part, 2 * whole); /* the sine of half the angle */
    return 2 * half * half;
}

double snow_series_decay(double excess, int32_t n)
{
    double power = 1 / (1 + excess + sqrt(excess * (excess + 2))); /* e^-a */
    double decayed = 1;
    for (; n > 0; n /= 2) {
        if (n % 2 != 0)
            decayed *= power;
        power *= power;
    }
    return 2 * decayed / (1 + decayed * decayed);
}

double snow_series_odd_cosines(const double *weight, int count, double cosine_of_phi)
{
    double twice = 2 * (2 * cosine_of_phi * cosine_of_phi - 1);
    double next = 0;
    double after = 0;
    for (int j = count - 1; j >= 0; j--) {
        double sum = weight[j] + twice * next - after;
        after = next;
        next = sum;
    }
    return cosine_of_phi * (next - after);
}
