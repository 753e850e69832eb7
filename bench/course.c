#include "course.h"

#include "plain.h"

#include <stdlib.h>
#include <string.h>

struct course {
    snow_grid *grid;        /* for the plain program, its start */
    plain_crystal *crystal; /* NULL for the library */
    size_t size;
    uint64_t cells;
    int64_t steps;
    double *frozen;       /* the plain program's, for a moment */
    double *freeze_steps; /* the plain program's; the library keeps its own */
};

static bool make_grid(course *watched, const variant *way, const snow_scene *scene)
{
    return variant_make_grid(way, scene, true, &watched->grid) == SNOW_OK &&
           snow_domain_cells(watched->grid, &watched->cells) == SNOW_OK &&
           snow_field_copy(watched->grid, SNOW_FIELD_VAPOUR, NULL, NULL, 0, &watched->size) == SNOW_OK;
}

static void note_frozen(course *watched)
{
    plain_copy_frozen(watched->crystal, watched->frozen);
    for (size_t i = 0; i < watched->size; i++)
        if (watched->frozen[i] != 0.0 && watched->freeze_steps[i] < 0.0)
            watched->freeze_steps[i] = (double)watched->steps;
}

static bool make_crystal(course *watched, const variant *way, const snow_scene *scene)
{
    bool single = way->precision == SNOW_REITER_PRECISION_SINGLE;
    watched->crystal = plain_create(&scene->params, single, watched->grid);
    watched->frozen = malloc(watched->size * sizeof *watched->frozen);
    watched->freeze_steps = malloc(watched->size * sizeof *watched->freeze_steps);
    if (watched->crystal == NULL || watched->frozen == NULL || watched->freeze_steps == NULL)
        return false;
    for (size_t i = 0; i < watched->size; i++)
        watched->freeze_steps[i] = -1.0;
    note_frozen(watched);
    return true;
}

course *course_start(const variant *way, const snow_scene *scene)
{
    if (!variant_can_grow(way, scene))
        return NULL;
    course *watched = calloc(1, sizeof *watched);
    if (watched == NULL)
        return NULL;
    if (make_grid(watched, way, scene) && (!way->plain || make_crystal(watched, way, scene)))
        return watched;
    course_end(watched);
    return NULL;
}

void course_end(course *watched)
{
    if (watched == NULL)
        return;
    plain_destroy(watched->crystal);
    snow_destroy(watched->grid);
    free(watched->frozen);
    free(watched->freeze_steps);
    free(watched);
}

size_t course_size(const course *watched)
{
    return watched->size;
}

uint64_t course_cells(const course *watched)
{
    return watched->cells;
}

static const char *trouble_of(snow_status status)
{
    return status == SNOW_OK ? NULL : snow_strerror(status);
}

const char *course_advance(course *watched, int64_t step)
{
    snow_status status = SNOW_OK;
    if (watched->crystal == NULL)
        status = snow_step(watched->grid, step - watched->steps);
    while (watched->crystal != NULL && watched->steps < step) {
        plain_run(watched->crystal, ++watched->steps, false);
        note_frozen(watched);
    }
    watched->steps = step;
    return trouble_of(status);
}

const char *course_run(course *watched, const snow_stop *stop, int64_t step, snow_summary *summary)
{
    snow_stop until = *stop;
    if (until.max_steps < 0 || until.max_steps > step)
        until.max_steps = step;
    snow_summary_init(summary, sizeof *summary);
    snow_status status = snow_run(watched->grid, &until, summary);
    watched->steps = summary->steps;
    return trouble_of(status);
}

static const char *copy_of_grid(const course *watched, snow_field field, double *values)
{
    return trouble_of(snow_field_copy(watched->grid, field, NULL, values, watched->size, NULL));
}

const char *course_copy_inside(const course *watched, double *inside)
{
    return copy_of_grid(watched, SNOW_FIELD_INSIDE, inside);
}

const char *course_copy_vapour(const course *watched, double *vapour)
{
    if (watched->crystal == NULL)
        return copy_of_grid(watched, SNOW_FIELD_VAPOUR, vapour);
    plain_copy_vapour(watched->crystal, vapour);
    return NULL;
}

const char *course_copy_freeze_steps(const course *watched, double *freeze_steps)
{
    if (watched->crystal == NULL)
        return copy_of_grid(watched, SNOW_FIELD_FREEZE_STEP, freeze_steps);
    memcpy(freeze_steps, watched->freeze_steps, watched->size * sizeof *freeze_steps);
    return NULL;
}
