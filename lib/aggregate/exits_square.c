/* The exit law of a square, in closed form: the discrete Laplace equation
   separates. With n = 2r,
       P(x) = (1/n) sum over odd k < n of cos(k pi x/n) / cosh(a_k r),  cosh(a_k) = 2 - cos(k pi/n).
   The method is that of W. H. McCrea and F. J. W. Whipple, "Random paths in two
   and three dimensions", Proc. R. Soc. Edinburgh 60 (1940) 281-298. */
#include "aggregate/exits.h"
#include "aggregate/series.h"

/* Terms fall like e^(-k pi/2): more are below 2^-60. */
enum { TERMS = 16 };

void snow_exits_square(int32_t radius, double *chance)
{
    double weight[TERMS];
    int terms = 0;
    for (int32_t k = 1; k < 2 * radius && terms < TERMS; k += 2)
        weight[terms++] = snow_series_decay(snow_series_versine(k, radius), radius) / (2 * radius);
    for (int32_t x = 0; x < radius; x++)
        chance[x] = snow_series_odd_cosines(weight, terms, snow_series_cosine(x, radius));
}
