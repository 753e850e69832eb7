/* Green's function of the cubic lattice: G(x, y, z) is the integral over all
   times t of e^-t I_x(t/3) I_y(t/3) I_z(t/3), the modified Bessel functions
   being the law of a walk along one axis in continuous time. */
#include "aggregate/potential.h"

#include <math.h>

/* e^-t I_n(t) for n < count by Miller's backward recurrence of their ratios; their sum over all whole n is 1. */
static void list_bessel(double t, double *bessel, int32_t count)
{
    int32_t n = count + 40 + (int32_t)(15 * sqrt(t + 1));
    double ratio = 0; /* of the n-th to the one before it */
    double rest = 0;  /* of all from the n-th on to the one before them */
    for (; n > 0; n--) {
        ratio = 1 / (2 * n / t + ratio);
        rest = ratio * (1 + rest);
        if (n < count)
            bessel[n] = ratio;
    }
    bessel[0] = 1 / (1 + 2 * rest);
    for (n = 1; n < count; n++)
        bessel[n] *= bessel[n - 1];
}

/* Hankel's asymptotic series. */
static void list_late_bessel(double t, double *bessel, int32_t count)
{
    const double tau = 6.28318530717958647693;
    for (int32_t n = 0; n < count; n++) {
        double term = 1;
        double sum = 1;
        for (int32_t k = 1; fabs(term) > 0x1p-60; k++) {
            term *= -(4.0 * n * n - (2.0 * k - 1) * (2.0 * k - 1)) / (8 * k * t);
            sum += term;
        }
        bessel[n] = sum / sqrt(tau * t);
    }
}

static void add_time(double *near, int32_t reach, const double *bessel, double weight)
{
    for (int32_t x = 0; x < reach; x++)
        for (int32_t y = 0; y <= x; y++) {
            double both = weight * bessel[x] * bessel[y];
            for (int32_t z = 0; z <= y; z++)
                *near++ += both * bessel[z];
        }
}

/* The trapezoidal rule in ln t, whose error is below e^-39 for this step. */
void snow_potential_fill_space(double *near, int32_t reach)
{
    const double step = 0.25;
    const double late = 4000;
    double bessel[SNOW_POTENTIAL_REACH];
    for (int32_t i = -150; i <= 300; i++) {
        double t = exp(step * i);
        if (t / 3 < late)
            list_bessel(t / 3, bessel, reach);
        else
            list_late_bessel(t / 3, bessel, reach);
        add_time(near, reach, bessel, step * t);
    }
}

/* As in the plane: the symbol expanded about the origin, term by term. */
double snow_potential_far_space(double x, double y, double z)
{
    double a = x * x;
    double b = y * y;
    double c = z * z;
    double square = a + b + c;
    double u = 1 / square;
    double s = (a * a + b * b + c * c) * u * u;
    double t = a * b * c * u * u * u;
    double first = (5 * s - 3) / 8;
    double second = (575 - 4536 * t + s * (1155 * s - 1638)) / 128;
    double third = (1575288 * t - 145383 + s * (645339 - 3243240 * t + s * (425425 * s - 920205))) / 1024;
    const double scale = 0.47746482927568600731; /* 3/(2 pi) */
    return scale * sqrt(u) * (1 + u * (first + u * (second + u * third)));
}
