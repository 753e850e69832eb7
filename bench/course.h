/* A crystal that is watched as it grows: its vapour at chosen steps, and the step in which each cell froze. */
#ifndef BENCH_COURSE_H
#define BENCH_COURSE_H

#include "scenes.h"
#include "variant.h"

#include <stddef.h>
#include <stdint.h>

typedef struct course course;

/* Starts the scene with a variant. NULL: no memory, or the variant cannot grow it. */
course *course_start(const variant *way, const snow_scene *scene);
void course_end(course *watched);

/* Cells of the rectangle that the copies below fill, in row order: snow_domain_bounds(). */
size_t course_size(const course *watched);

/* Cells of the interior. */
uint64_t course_cells(const course *watched);

/* Steps on to this step, whatever the crystal does. NULL, or what went wrong. */
const char *course_advance(course *watched, int64_t step);

/* Runs an engine of the library until the stop says so, but not past this step. NULL, or what went wrong. */
const char *course_run(course *watched, const snow_stop *stop, int64_t step, snow_summary *summary);

/* NULL, or what went wrong. Inside is 1 in the interior, else 0; freeze steps are -1 where a cell is not ice. */
const char *course_copy_inside(const course *watched, double *inside);
const char *course_copy_vapour(const course *watched, double *vapour);
const char *course_copy_freeze_steps(const course *watched, double *freeze_steps);

#endif
