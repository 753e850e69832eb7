#include "common/particles.h"

#include "common/dots.h"
#include "common/message.h"
#include "common/png.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const colour night = {10, 11, 24};
static const colour wall = {92, 94, 104};
static const colour land = {196, 164, 112};
static const colour rock = {112, 84, 58};
static const colour sea = {24, 70, 120};
static const colour ice = {196, 220, 240};

#define ROW_DISTANCE 0.86602540378443865

bool particles_fetch(particles *self, const snow_grid *grid)
{
    uint64_t count = 0;
    *self = (particles){0, NULL};
    snow_status status = snow_aggregate_particles(grid, &count);
    if (status == SNOW_OK && count < SIZE_MAX / sizeof *self->points)
        self->points = malloc((size_t)(count + 1) * sizeof *self->points);
    if (status == SNOW_OK && self->points == NULL)
        status = SNOW_ERROR_NO_MEMORY;
    if (status == SNOW_OK)
        status = snow_aggregate_points(grid, 0, self->points, (size_t)count);
    self->count = (size_t)count;
    if (status != SNOW_OK)
        complain_status("the particles", status);
    return status == SNOW_OK;
}

void particles_destroy(particles *self)
{
    free(self->points);
    self->points = NULL;
}

static snow_aggregate_params params_of(const snow_grid *grid)
{
    snow_aggregate_params params;
    snow_aggregate_params_init(&params, sizeof params);
    snow_aggregate_params_of(grid, &params);
    return params;
}

static bool has_box(const snow_aggregate_params *params)
{
    return params->scene == SNOW_AGGREGATE_LINE || params->scene == SNOW_AGGREGATE_ELECTROLYSIS ||
           params->scene == SNOW_AGGREGATE_SHORE || params->scene == SNOW_AGGREGATE_CHIMNEY;
}

static double age_of(const particles *self, size_t number)
{
    return self->count > 1 ? (double)number / (double)(self->count - 1) : 0;
}

/* Particles that drift have no age. */
static colour colour_of(const particles *self, const snow_aggregate_params *params, size_t number)
{
    return params->scene == SNOW_AGGREGATE_CLUSTER_CLUSTER ? ice : dots_age(age_of(self, number));
}

static frame frame_of(const particles *self, const snow_aggregate_params *params)
{
    double row = params->lattice == SNOW_AGGREGATE_HEXAGONAL ? ROW_DISTANCE : 1;
    if (has_box(params))
        return (frame){-0.5, -1.5 * row, params->width - 0.5 + (row < 1 ? 0.5 : 0), (params->height - 0.5) * row};
    frame view = {0, 0, 0, 0};
    for (size_t i = 0; i < self->count; i++) {
        snow_point at = self->points[i];
        if (i == 0)
            view = (frame){at.x, at.y, at.x, at.y};
        view.left = fmin(view.left, at.x);
        view.right = fmax(view.right, at.x);
        view.bottom = fmin(view.bottom, at.y);
        view.top = fmax(view.top, at.y);
    }
    double margin = 1.5 + 0.02 * fmax(view.right - view.left, view.top - view.bottom);
    return (frame){view.left - margin, view.bottom - margin, view.right + margin, view.top + margin};
}

/* What is not air: walls, and the land that is left, darker where it is harder. */
static void paint_cells(dots *image, const snow_grid *grid, const snow_aggregate_params *params)
{
    bool shore = params->scene == SNOW_AGGREGATE_SHORE;
    if (!shore && params->scene != SNOW_AGGREGATE_CHIMNEY)
        return;
    for (int32_t y = 0; y < params->height; y++) {
        for (int32_t x = 0; x < params->width; x++) {
            double inside = 0;
            double value = 0;
            snow_cell_value(grid, SNOW_FIELD_INSIDE, x, y, &inside);
            snow_cell_value(grid, SNOW_FIELD_VALUE, x, y, &value);
            if (inside == 0)
                dots_paint(image, x, y, 1, 1, wall);
            else if (shore && value > 0)
                dots_paint(image, x, y, 1, 1, dots_dimmed(land, 1 - 0.3 * value / params->hardness_greatest));
        }
    }
    if (shore)
        dots_paint(image, (params->width - 1) / 2.0, -1, params->width, 1, rock);
}

static void paint_floor(dots *image, const snow_aggregate_params *params)
{
    double first = fmax(params->cathode_first, 0);
    double last = fmin(params->cathode_last, params->width - 1);
    if (params->scene == SNOW_AGGREGATE_LINE)
        dots_paint(image, params->width / 2.0, -1, params->width + 1, 1, wall);
    if (params->scene == SNOW_AGGREGATE_ELECTROLYSIS && first <= last)
        dots_paint(image, (first + last) / 2, -1, last - first + 1, 1, wall);
}

static bool paint_obstacles(dots *image, const snow_grid *grid, const snow_aggregate_params *params)
{
    double lean = params->lattice == SNOW_AGGREGATE_HEXAGONAL ? 0.5 : 0;
    double row = lean > 0 ? ROW_DISTANCE : 1;
    size_t count = 0;
    snow_aggregate_obstacles(grid, NULL, 0, &count);
    snow_site *sites = malloc((count + 1) * sizeof *sites);
    if (sites == NULL || snow_aggregate_obstacles(grid, sites, count, NULL) != SNOW_OK) {
        complain("no memory for %zu obstacles", count);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        dots_paint(image, sites[i].x + lean * sites[i].y, row * sites[i].y, 1, row, wall);
    free(sites);
    return true;
}

static void paint_plane(const particles *self, dots *image, const snow_aggregate_params *params)
{
    double width = params->scene == SNOW_AGGREGATE_OFF_LATTICE ? 0.886 : 1; /* the disc's area as a square's */
    double height = params->lattice == SNOW_AGGREGATE_HEXAGONAL ? ROW_DISTANCE : width;
    for (size_t i = 0; i < self->count && params->scene != SNOW_AGGREGATE_SHORE; i++)
        dots_paint(image, self->points[i].x, self->points[i].y, width, height, colour_of(self, params, i));
}

/* A particle in space, seen along the diagonal of the axes. */
typedef struct seen {
    double x;
    double y;
    double depth;
    size_t number;
} seen;

static int is_behind(const void *a, const void *b)
{
    double depth_a = ((const seen *)a)->depth;
    double depth_b = ((const seen *)b)->depth;
    return (depth_a > depth_b) - (depth_a < depth_b);
}

static seen *see_all(const particles *self, frame *view)
{
    seen *all = malloc((self->count + 1) * sizeof *all);
    *view = (frame){-1, -1, 1, 1};
    for (size_t i = 0; i < self->count && all != NULL; i++) {
        snow_point at = self->points[i];
        all[i] = (seen){(at.x - at.y) * 0.7071, at.z * 0.8165 + (at.x + at.y) * 0.4082,
                        at.z * 0.5774 - (at.x + at.y) * 0.5774, i};
        if (i == 0)
            *view = (frame){all[0].x, all[0].y, all[0].x, all[0].y};
        view->left = fmin(view->left, all[i].x - 2);
        view->right = fmax(view->right, all[i].x + 2);
        view->bottom = fmin(view->bottom, all[i].y - 2);
        view->top = fmax(view->top, all[i].y + 2);
    }
    if (all != NULL)
        qsort(all, self->count, sizeof *all, is_behind);
    else
        complain("no memory for %zu particles", self->count);
    return all;
}

static bool draw_space(const particles *self, const snow_aggregate_params *params, int32_t size, dots *image)
{
    frame view;
    seen *all = see_all(self, &view);
    if (all == NULL || !dots_create(image, view, size, night)) {
        free(all);
        return false;
    }
    double farthest = self->count > 0 ? all[0].depth : 0;
    double nearest = self->count > 0 ? all[self->count - 1].depth : 1;
    for (size_t i = 0; i < self->count; i++) {
        double light = 0.12 + 0.88 * (all[i].depth - farthest) / fmax(nearest - farthest, 1);
        dots_paint(image, all[i].x, all[i].y, 1.15, 1.15, dots_dimmed(colour_of(self, params, all[i].number), light));
    }
    free(all);
    return true;
}

static bool draw_plane(const particles *self, const snow_grid *grid, const snow_aggregate_params *params, int32_t size,
                       dots *image)
{
    bool shore = params->scene == SNOW_AGGREGATE_SHORE;
    if (!dots_create(image, frame_of(self, params), size, shore ? sea : night))
        return false;
    paint_cells(image, grid, params);
    paint_floor(image, params);
    paint_plane(self, image, params);
    bool painted = paint_obstacles(image, grid, params);
    if (!painted)
        dots_destroy(image);
    return painted;
}

bool particles_draw(const particles *self, const snow_grid *grid, int32_t size, output *file)
{
    snow_aggregate_params params = params_of(grid);
    bool space = params.lattice == SNOW_AGGREGATE_CUBIC && params.scene != SNOW_AGGREGATE_OFF_LATTICE;
    dots image;
    picture pixels;
    if (!(space ? draw_space(self, &params, size, &image) : draw_plane(self, grid, &params, size, &image)))
        return false;
    bool written = dots_finish(&image, &pixels) && png_write(file, &pixels);
    dots_destroy(&image);
    picture_destroy(&pixels);
    return written;
}

static bool finish(output *file)
{
    if (!ferror(file->file))
        return output_commit(file);
    output_complain(file);
    return false;
}

static void print_site(FILE *file, snow_site site, bool space)
{
    if (space)
        fprintf(file, "%d %d %d\n", (int)site.x, (int)site.y, (int)site.z);
    else
        fprintf(file, "%d %d\n", (int)site.x, (int)site.y);
}

bool particles_list(const particles *self, const snow_grid *grid, output *file)
{
    snow_aggregate_params params = params_of(grid);
    errno = 0;
    for (size_t i = 0; i < self->count; i++) {
        snow_site site;
        if (snow_aggregate_sites(grid, i, &site, 1) == SNOW_OK)
            print_site(file->file, site, params.lattice == SNOW_AGGREGATE_CUBIC);
        else
            fprintf(file->file, "%.9f %.9f\n", self->points[i].x, self->points[i].y);
    }
    return finish(file);
}

/* Binary PLY says which byte order it has: this machine's. */
static const char *byte_order(void)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1 ? "little" : "big";
}

bool particles_write_ply(const particles *self, output *file)
{
    errno = 0;
    fprintf(file->file,
            "ply\nformat binary_%s_endian 1.0\ncomment particles in the order in which they joined\n"
            "element vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float age\nend_header\n",
            byte_order(), self->count);
    for (size_t i = 0; i < self->count; i++) {
        float place[3] = {(float)self->points[i].x, (float)self->points[i].y, (float)self->points[i].z};
        colour paint = dots_age(age_of(self, i));
        float age = (float)i;
        fwrite(place, sizeof place, 1, file->file);
        fwrite((unsigned char[]){paint.red, paint.green, paint.blue}, 3, 1, file->file);
        fwrite(&age, sizeof age, 1, file->file);
    }
    return finish(file);
}

bool particles_write_vtk(const particles *self, output *file)
{
    errno = 0;
    fprintf(file->file, "# vtk DataFile Version 3.0\nparticles in the order in which they joined\nASCII\n"
                        "DATASET POLYDATA\nPOINTS %zu float\n", self->count);
    for (size_t i = 0; i < self->count; i++)
        fprintf(file->file, "%.7g %.7g %.7g\n", self->points[i].x, self->points[i].y, self->points[i].z);
    fprintf(file->file, "VERTICES %zu %zu\n", self->count, 2 * self->count);
    for (size_t i = 0; i < self->count; i++)
        fprintf(file->file, "1 %zu\n", i);
    fprintf(file->file, "POINT_DATA %zu\nSCALARS age float 1\nLOOKUP_TABLE default\n", self->count);
    for (size_t i = 0; i < self->count; i++)
        fprintf(file->file, "%zu\n", i);
    return finish(file);
}
