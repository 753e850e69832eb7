/* The few functions that the exit laws need, from + - * / and sqrt alone: the
   same bits on every platform, which libm does not promise. */
#ifndef SNOW_AGGREGATE_SERIES_H
#define SNOW_AGGREGATE_SERIES_H

#include <stdint.h>

/* cos(pi/2 * part/whole), 0 <= part <= whole. */
double snow_series_cosine(int64_t part, int64_t whole);

/* 1 - cos(pi/2 * part/whole), 0 <= part <= 2 whole, to full relative precision. */
double snow_series_versine(int64_t part, int64_t whole);

/* 1/cosh(a n), where cosh(a) = 1 + excess. */
double snow_series_decay(double excess, int32_t n);

/* The sum of weight[j] cos((2j + 1) phi), j < count. C. W. Clenshaw, Math. Comp. 9 (1955) 118. */
double snow_series_odd_cosines(const double *weight, int count, double cosine_of_phi);

#endif
