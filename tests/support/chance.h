/*
 * Whether counts agree with chances: Pearson's chi-square test.
 */
#ifndef TESTS_SUPPORT_CHANCE_H
#define TESTS_SUPPORT_CHANCE_H

#include "check.h"

/* The chance that chi-square with so many degrees of freedom is at least this. */
double chance_of_chi_square(double chi_square, int freedom);

/* Fails when so unlikely counts come up once in ten thousand right programs. Cells are
   taken together, one after the other, until ten are expected. */
#define assert_counts(expected, got, cells) check_counts((expected), (got), (cells), #got, __FILE__, __LINE__)
void check_counts(const double *expected, const double *got, size_t cells, const char *text, const char *file,
                  int line);

/* The same for two samples of equal size from one unknown law. */
#define assert_alike(one, other, cells) check_alike((one), (other), (cells), #one, __FILE__, __LINE__)
void check_alike(const double *one, const double *other, size_t cells, const char *text, const char *file, int line);

#endif
