#include "chance.h"

#include <math.h>

/* The upper incomplete gamma function over the complete one: series or Lentz's continued fraction. */
static double upper_gamma(double a, double x)
{
    double front = exp(a * log(x) - x - lgamma(a));
    if (x < a + 1) {
        double sum = 0;
        double term = 1 / a;
        for (int n = 1; term > 1e-17 * sum; n++) {
            sum += term;
            term *= x / (a + n);
        }
        return 1 - front * sum;
    }
    double b = x + 1 - a;
    double c = 1e300;
    double d = 1 / b;
    double fraction = d;
    for (int n = 1; n < 10000; n++) {
        double part = n * (a - n);
        b += 2;
        d = 1 / (part * d + b);
        c = b + part / c;
        fraction *= c * d;
        if (fabs(c * d - 1) < 1e-14)
            break;
    }
    return front * fraction;
}

double chance_of_chi_square(double chi_square, int freedom)
{
    return chi_square <= 0 ? 1 : upper_gamma(freedom / 2.0, chi_square / 2);
}

static void judge(double chi_square, int freedom, const char *text, const char *file, int line)
{
    double chance = chance_of_chi_square(chi_square, freedom);
    if (!(freedom >= 1 && chance > 1e-4)) {
        print_error("%s: chi-square %.1f with %d degrees of freedom: p = %.2g\n", text, chi_square, freedom, chance);
        _fail(file, line);
    }
}

enum { LEAST = 10 };

void check_counts(const double *expected, const double *got, size_t cells, const char *text, const char *file,
                  int line)
{
    double chi_square = 0;
    double sum_expected = 0;
    double sum_got = 0;
    int classes = 0;
    for (size_t i = 0; i < cells; i++) {
        sum_expected += expected[i];
        sum_got += got[i];
        if (sum_expected < LEAST)
            continue;
        chi_square += (sum_got - sum_expected) * (sum_got - sum_expected) / sum_expected;
        classes++;
        sum_expected = sum_got = 0;
    }
    judge(chi_square, classes - 1, text, file, line);
}

void check_alike(const double *one, const double *other, size_t cells, const char *text, const char *file, int line)
{
    double chi_square = 0;
    double sums[2] = {0, 0};
    int classes = 0;
    for (size_t i = 0; i < cells; i++) {
        sums[0] += one[i];
        sums[1] += other[i];
        double both = sums[0] + sums[1];
        if (both < 2 * LEAST)
            continue;
        chi_square += (sums[0] - sums[1]) * (sums[0] - sums[1]) / both;
        classes++;
        sums[0] = sums[1] = 0;
    }
    judge(chi_square, classes - 1, text, file, line);
}
