#include "truth.h"

#include "course.h"
#include "timing.h"

#include <math.h>
#include <stdlib.h>

static const char *allocate(truth *exact, const course *watched, size_t marks)
{
    exact->size = course_size(watched);
    exact->result.cells = course_cells(watched);
    exact->inside = calloc(exact->size, sizeof *exact->inside);
    exact->vapour = calloc(marks * exact->size, sizeof *exact->vapour);
    exact->freeze_steps = calloc(exact->size, sizeof *exact->freeze_steps);
    bool done = exact->inside != NULL && exact->vapour != NULL && exact->freeze_steps != NULL;
    return done ? course_copy_inside(watched, exact->inside) : "no memory";
}

/* Runs to the next mark or to the stop, and keeps the vapour of that moment. */
static const char *watch_next(truth *exact, course *watched, const snow_stop *stop, int64_t step, bool *ended)
{
    snow_summary summary;
    double start = timing_now();
    const char *trouble = course_run(watched, stop, step, &summary);
    if (trouble != NULL)
        return trouble;
    exact->result.seconds += timing_now() - start;
    exact->result.steps = summary.steps;
    exact->result.frozen = summary.frozen;
    exact->result.reason = summary.reason;
    *ended = summary.reason != SNOW_STOP_STEPS || summary.steps == stop->max_steps;
    mark_list *marks = &exact->marks;
    if (marks->count > 0 && marks->steps[marks->count - 1] == summary.steps)
        return NULL; /* the last mark was the stop */
    marks->steps[marks->count++] = summary.steps;
    return course_copy_vapour(watched, exact->vapour + (marks->count - 1) * exact->size);
}

const char *truth_find(truth *exact, const snow_scene *scene, const mark_list *marks)
{
    *exact = (truth){0};
    variant quad;
    variant_find("quad", &quad);
    course *watched = course_start(&quad, scene);
    const char *trouble = watched != NULL ? allocate(exact, watched, marks->count + 1) : "no memory";
    bool ended = false;
    for (size_t i = 0; i <= marks->count && !ended && trouble == NULL; i++) {
        int64_t step = i < marks->count ? marks->steps[i] : INT64_MAX;
        trouble = watch_next(exact, watched, &scene->stop, step, &ended);
    }
    if (trouble == NULL)
        trouble = course_copy_freeze_steps(watched, exact->freeze_steps);
    course_end(watched);
    return trouble;
}

void truth_free(truth *exact)
{
    free(exact->inside);
    free(exact->vapour);
    free(exact->freeze_steps);
}

static void compare_vapour(const truth *exact, size_t mark, const double *vapour, distance *from)
{
    const double *wanted = exact->vapour + mark * exact->size;
    double greatest = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < exact->size; i++) {
        double error = exact->inside[i] * fabs(vapour[i] - wanted[i]);
        greatest = error > greatest ? error : greatest;
        sum += error;
    }
    from->max_error[mark] = greatest;
    from->mean_error[mark] = sum / (double)exact->result.cells;
}

/* Two ice sets differ first in the earlier of the steps in which a cell froze in the one, and in the other. */
static void compare_ice(const truth *exact, const double *freeze_steps, distance *from)
{
    for (size_t i = 0; i < exact->size; i++) {
        double here = freeze_steps[i];
        double there = exact->freeze_steps[i];
        if (here == there)
            continue;
        from->differing_cells += (here < 0.0) != (there < 0.0);
        double first = here < 0.0 || (there >= 0.0 && there < here) ? there : here;
        if (from->first_difference < 0 || first < (double)from->first_difference)
            from->first_difference = (int64_t)first;
    }
}

static const char *watch(const truth *exact, course *watched, double *field, distance *from)
{
    const char *trouble = NULL;
    for (size_t mark = 0; mark < exact->marks.count && trouble == NULL; mark++) {
        trouble = course_advance(watched, exact->marks.steps[mark]);
        if (trouble == NULL)
            trouble = course_copy_vapour(watched, field);
        if (trouble == NULL)
            compare_vapour(exact, mark, field, from);
    }
    if (trouble == NULL)
        trouble = course_copy_freeze_steps(watched, field);
    if (trouble == NULL)
        compare_ice(exact, field, from);
    return trouble;
}

const char *truth_compare(const truth *exact, const variant *way, const snow_scene *scene, distance *from)
{
    *from = (distance){.first_difference = -1};
    course *watched = course_start(way, scene);
    double *field = calloc(exact->size, sizeof *field);
    const char *trouble = watched != NULL && field != NULL ? watch(exact, watched, field, from) : "no memory";
    free(field);
    course_end(watched);
    return trouble;
}
