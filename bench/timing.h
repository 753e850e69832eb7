/* Time, and the middle of several measurements. */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

#include <stddef.h>

/* Seconds of a clock that only runs forwards. */
double timing_now(void);

/* Seconds that this process has computed: nobody's waiting counts. */
double timing_processor(void);

/* Sorts the values, at least one, and returns their median. */
double timing_median(double *values, size_t count);

#endif
