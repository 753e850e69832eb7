/* Dense systems of equations with a symmetric, positive definite matrix. */
#ifndef SNOW_AGGREGATE_SPD_H
#define SNOW_AGGREGATE_SPD_H

#include <stddef.h>

/* Reads the upper triangle of a matrix of count rows, diagonal included, and
   writes Cholesky's factor into the lower one, diagonal included. */
void snow_spd_factor(double *matrix, size_t count);

/* Solves with that factor; `vector` holds the right side, then the solution. */
void snow_spd_solve(const double *matrix, size_t count, double *vector);

#endif
