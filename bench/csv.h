/* Files that figures are recorded in. */
#ifndef BENCH_CSV_H
#define BENCH_CSV_H

#include <stdbool.h>
#include <stdio.h>

/*
 * Opens a file for appending; without a path there is none, and NULL is returned. The column names go to the top of a
 * new file. Then, for each session, comment lines: the command, the date if there is one, the processor and the build.
 * A file that cannot be opened ends the program with status 2.
 */
FILE *csv_open(const char *path, const char *columns, int argument_count, char *const *arguments, const char *date);

/* False when anything that was written did not reach the file. Fine for NULL. */
bool csv_close(FILE *csv);

#endif
