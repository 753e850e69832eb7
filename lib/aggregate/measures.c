/* Measures of the whole: radii, masses, heights, clusters. */
#include "aggregate/model.h"
#include "base/floating.h"

enum { SLICE = 256 };

static snow_status check(const snow_grid *grid, const void *a, const void *b)
{
    if (grid == NULL || a == NULL || b == NULL)
        return SNOW_ERROR_NULL;
    return grid->operations == &snow_aggregate_operations ? SNOW_OK : SNOW_ERROR_UNSUPPORTED;
}

/* Calls use for the points of the particles, in their order, until it says that it has enough. */
typedef bool (*point_user)(void *context, snow_point point);

static void for_each_point(const snow_grid *grid, point_user use, void *context)
{
    snow_point points[SLICE];
    uint64_t particles = snow_aggregate_count(grid);
    for (uint64_t first = 0; first < particles; first += SLICE) {
        size_t count = particles - first < SLICE ? (size_t)(particles - first) : SLICE;
        snow_aggregate_list_points(grid, first, points, count);
        for (size_t i = 0; i < count; i++)
            if (!use(context, points[i]))
                return;
    }
}

/* Mean and scatter so far, renewed point by point without loss (B. P. Welford, Technometrics 4 (1962) 419). */
typedef struct gyration {
    const uint64_t *masses;
    double *radii;
    size_t count;
    size_t done;
    uint64_t mass;
    snow_point mean;
    double scatter;
} gyration;

static void add_coordinate(double *mean, double *scatter, double x, double mass)
{
    double before = x - *mean;
    *mean += before / mass;
    *scatter += before * (x - *mean);
}

static bool add_point(void *context, snow_point point)
{
    gyration *self = context;
    double mass = (double)++self->mass;
    add_coordinate(&self->mean.x, &self->scatter, point.x, mass);
    add_coordinate(&self->mean.y, &self->scatter, point.y, mass);
    add_coordinate(&self->mean.z, &self->scatter, point.z, mass);
    while (self->done < self->count && self->masses[self->done] == self->mass)
        self->radii[self->done++] = sqrt(self->scatter / mass);
    return self->done < self->count;
}

snow_status snow_aggregate_gyration(const snow_grid *grid, const uint64_t *masses, double *radii, size_t count)
{
    snow_status status = check(grid, masses, radii);
    if (status != SNOW_OK)
        return status;
    if (aggregate_of(grid)->params.scene == SNOW_AGGREGATE_CLUSTER_CLUSTER)
        return SNOW_ERROR_UNSUPPORTED;
    for (size_t i = 0; i < count; i++)
        if (masses[i] < 1 || masses[i] > snow_aggregate_count(grid) || (i > 0 && masses[i] < masses[i - 1]))
            return SNOW_ERROR_RANGE;
    if (count == 0)
        return SNOW_OK;
    snow_floating floating;
    snow_floating_enter(&floating);
    gyration self = {.masses = masses, .radii = radii, .count = count};
    for_each_point(grid, add_point, &self);
    snow_floating_leave(&floating);
    return SNOW_OK;
}

typedef struct mass_within {
    const double *radii;
    uint64_t *masses;
    size_t count;
} mass_within;

/* Counts a point at the least radius that holds it; sums follow. */
static bool count_point(void *context, snow_point point)
{
    const mass_within *self = context;
    double square = point.x * point.x + point.y * point.y + point.z * point.z;
    size_t low = 0;
    size_t high = self->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        /* Squares of lattice distances are whole, but for the rounding of √3/2. */
        if (self->radii[middle] * self->radii[middle] * (1 + 0x1p-48) >= square)
            high = middle;
        else
            low = middle + 1;
    }
    if (low < self->count)
        self->masses[low]++;
    return true;
}

snow_status snow_aggregate_mass(const snow_grid *grid, const double *radii, uint64_t *masses, size_t count)
{
    snow_status status = check(grid, radii, masses);
    if (status != SNOW_OK)
        return status;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(radii[i]))
            return SNOW_ERROR_NOT_FINITE;
        if (radii[i] < 0 || (i > 0 && radii[i] < radii[i - 1]))
            return SNOW_ERROR_RANGE;
    }
    snow_floating floating;
    snow_floating_enter(&floating);
    for (size_t i = 0; i < count; i++)
        masses[i] = 0;
    mass_within self = {radii, masses, count};
    for_each_point(grid, count_point, &self);
    for (size_t i = 1; i < count; i++)
        masses[i] += masses[i - 1];
    snow_floating_leave(&floating);
    return SNOW_OK;
}

typedef struct box {
    bool any;
    snow_point low;
    snow_point high;
} box;

static bool stretch(void *context, snow_point point)
{
    box *self = context;
    if (!self->any)
        *self = (box){true, point, point};
    self->low = (snow_point){fmin(self->low.x, point.x), fmin(self->low.y, point.y), fmin(self->low.z, point.z)};
    self->high = (snow_point){fmax(self->high.x, point.x), fmax(self->high.y, point.y), fmax(self->high.z, point.z)};
    return true;
}

snow_status snow_aggregate_bounds(const snow_grid *grid, snow_point *low, snow_point *high)
{
    snow_status status = check(grid, low, high);
    if (status != SNOW_OK)
        return status;
    box bounds = {false, {0, 0, 0}, {0, 0, 0}};
    snow_floating floating;
    snow_floating_enter(&floating);
    for_each_point(grid, stretch, &bounds);
    snow_floating_leave(&floating);
    if (!bounds.any)
        return SNOW_ERROR_RANGE;
    *low = bounds.low;
    *high = bounds.high;
    return SNOW_OK;
}

static size_t column_of(const snow_aggregate_params *params, snow_site site)
{
    if (params->lattice == SNOW_AGGREGATE_CUBIC)
        return (size_t)site.y * (size_t)params->width + (size_t)site.x;
    if (params->lattice == SNOW_AGGREGATE_HEXAGONAL)
        return (size_t)((int64_t)site.x + site.y / 2);
    return (size_t)site.x;
}

static void find_heights(const aggregate *model, int32_t *heights)
{
    for (uint64_t i = 0; i < model->sites.count; i++) {
        snow_site site = snow_sites_at(&model->sites, i);
        int32_t *height = &heights[column_of(&model->params, site)];
        int32_t top = aggregate_height(model, site) + 1;
        *height = top > *height ? top : *height;
    }
}

static void find_land(const snow_grid *grid, int32_t *heights)
{
    const snow_aggregate_params *params = &aggregate_of(grid)->params;
    for (int32_t x = 0; x < params->width; x++) {
        int32_t height = params->height;
        while (height > 0 && snow_aggregate_hardness(grid, (snow_site){x, height - 1, 0}) == 0)
            height--;
        heights[x] = height;
    }
}

snow_status snow_aggregate_profile(const snow_grid *grid, int32_t *heights, size_t capacity, size_t *count)
{
    snow_status status = check(grid, grid, heights != NULL ? (const void *)heights : (const void *)count);
    if (status != SNOW_OK)
        return status;
    const aggregate *model = aggregate_of(grid);
    const snow_aggregate_params *params = &model->params;
    if (!snow_aggregate_has_floor(params) || params->scene == SNOW_AGGREGATE_CHIMNEY)
        return SNOW_ERROR_UNSUPPORTED;
    size_t columns = (size_t)params->width * (aggregate_is_space(params) ? (size_t)params->depth : 1);
    if (count != NULL)
        *count = columns;
    if (heights == NULL)
        return SNOW_OK;
    if (capacity < columns)
        return SNOW_ERROR_BUFFER;
    for (size_t i = 0; i < columns; i++)
        heights[i] = 0;
    if (params->scene == SNOW_AGGREGATE_SHORE)
        find_land(grid, heights);
    else
        find_heights(model, heights);
    return SNOW_OK;
}

snow_status snow_aggregate_clusters(const snow_grid *grid, snow_aggregate_cluster *clusters, size_t capacity,
                                    size_t *count)
{
    snow_status status = check(grid, grid, clusters != NULL ? (const void *)clusters : (const void *)count);
    if (status != SNOW_OK)
        return status;
    if (aggregate_of(grid)->params.scene != SNOW_AGGREGATE_CLUSTER_CLUSTER)
        return SNOW_ERROR_UNSUPPORTED;
    size_t there = snow_aggregate_list_clusters(grid, NULL);
    if (count != NULL)
        *count = there;
    if (clusters == NULL)
        return SNOW_OK;
    if (capacity < there)
        return SNOW_ERROR_BUFFER;
    snow_floating floating;
    snow_floating_enter(&floating);
    snow_aggregate_list_clusters(grid, clusters);
    snow_floating_leave(&floating);
    return SNOW_OK;
}
