/*
 * cmocka, and what it lacks: comparisons of doubles that print both sides
 * exactly, and of statuses that print their text.
 */
#ifndef TESTS_SUPPORT_CHECK_H
#define TESTS_SUPPORT_CHECK_H

/* cmocka.h needs these first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <snowgrowth/snowgrowth.h>

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

/* The call answers the expected status. */
#define assert_status(expected, call) check_status((expected), (call), #call, __FILE__, __LINE__)
#define assert_ok(call) assert_status(SNOW_OK, call)

/* The same bits, so that 0.0 and -0.0 differ and a NaN equals itself. */
#define assert_same_double(expected, got) check_same_double((expected), (got), #got, __FILE__, __LINE__)

/* |expected - got| <= tolerance; never for a NaN. */
#define assert_near(expected, got, tolerance) check_near((expected), (got), (tolerance), #got, __FILE__, __LINE__)

void check_status(snow_status expected, snow_status got, const char *text, const char *file, int line);
void check_same_double(double expected, double got, const char *text, const char *file, int line);
void check_near(double expected, double got, double tolerance, const char *text, const char *file, int line);

#endif
