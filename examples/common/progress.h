/* A progress line on standard error, only where that is a terminal, and Ctrl-C as a wish to stop. */
#ifndef EXAMPLES_PROGRESS_H
#define EXAMPLES_PROGRESS_H

#include "common/message.h"

#include <snowgrowth/grid.h>

#include <stdbool.h>

/* From now on Ctrl-C (and SIGTERM) asks for an end; a second one ends the program at once. */
void progress_start(void);

bool progress_cancelled(void);

/* Seconds since some moment. */
double progress_clock(void);

/* Replaces the line, at most ten times a second. From one thread at a time. */
void progress_show(const char *format, ...) PRINTF_LIKE(1, 2);

/* Takes the line away, before anything else is printed. */
void progress_clear(void);

/* For snow_stop: ends the run after Ctrl-C; the first also shows how far it has come. */
int progress_of_run(void *context, const snow_grid *grid, const snow_summary *summary);
int progress_of_panel(void *context, const snow_grid *grid, const snow_summary *summary);

#endif
