/* What a saved grid of Packard's model holds: the scene, the zones, then the frozen cells: of the quadtree its
   different squares, of other engines rows of bits, or, where these would be mostly empty, blocks of them. */
#include "base/hexagon.h"
#include "packard/model.h"
#include "packard/quadtree.h"

enum { CHUNK = 64 /* words of a row that are read at a time */ };

typedef enum saved_form {
    SAVED_ROWS = 0,
    SAVED_TREE = 1,
    SAVED_BLOCKS = 2,
    SAVED_SHIFTED_TREE = 3,
    SAVED_FORMS
} saved_form;

static saved_form form_of(const snow_grid *grid)
{
    const packard *model = packard_of(grid);
    if (model->engine == &snow_packard_quadtree)
        return snow_packard_tree_is_shifted(model->cells) ? SAVED_SHIFTED_TREE : SAVED_TREE;
    return snow_packard_is_sparse(grid) ? SAVED_BLOCKS : SAVED_ROWS;
}

static void save_scene(const snow_grid *grid, snow_sink *sink)
{
    const packard *model = packard_of(grid);
    const snow_packard_params *params = &model->params;
    snow_sink_u32(sink, params->rule);
    snow_sink_u32(sink, (uint32_t)params->domain);
    snow_sink_u32(sink, (uint32_t)params->radius);
    snow_sink_u32(sink, (uint32_t)params->width);
    snow_sink_u32(sink, (uint32_t)params->height);
    snow_sink_u32(sink, (uint32_t)params->engine);
    snow_sink_u8(sink, params->record_freeze_steps != 0);
    snow_sink_u8(sink, grid->census.still);
    snow_sink_u8(sink, (uint8_t)form_of(grid));
    snow_sink_u64(sink, (uint64_t)grid->census.steps);
}

static size_t words_of(const packard_zone *zone)
{
    return packard_words((uint64_t)zone->rect.width) * (size_t)zone->rect.height;
}

static void save_zone(const packard_zone *zone, snow_sink *sink)
{
    snow_sink_u32(sink, (uint32_t)zone->kind);
    snow_sink_u32(sink, (uint32_t)zone->shape);
    snow_sink_u64(sink, (uint64_t)zone->first_step);
    snow_sink_u64(sink, (uint64_t)zone->last_step);
    snow_sink_u32(sink, (uint32_t)zone->centre.q);
    snow_sink_u32(sink, (uint32_t)zone->centre.r);
    snow_sink_u64(sink, (uint64_t)zone->half_cells);
    snow_sink_double(sink, zone->half_angle);
    snow_sink_u64(sink, (uint64_t)zone->inner);
    snow_sink_u64(sink, (uint64_t)zone->outer);
    snow_sink_u8(sink, zone->inverted);
    snow_sink_u32(sink, (uint32_t)zone->rect.q);
    snow_sink_u32(sink, (uint32_t)zone->rect.r);
    snow_sink_u32(sink, (uint32_t)zone->rect.width);
    snow_sink_u32(sink, (uint32_t)zone->rect.height);
    snow_sink_u8(sink, zone->cells != NULL);
    for (size_t i = 0; zone->cells != NULL && i < words_of(zone); i++)
        snow_sink_u64(sink, zone->cells[i]);
}

static void save_dates(const packard *model, const packard_region *row, const uint64_t *words, snow_sink *sink)
{
    for (int64_t x = 0; x < row->width; x++)
        if ((words[x / PACKARD_WORD] >> (x % PACKARD_WORD) & 1) != 0)
            snow_sink_u64(sink, (uint64_t)model->engine->date(model->cells, row->q + x, row->r));
}

/* The words of a row, and after them, where they are recorded, the freeze steps. */
static void save_row(const packard *model, const packard_region *row, snow_sink *sink)
{
    uint64_t words[CHUNK];
    for (int64_t x = 0; x < row->width; x += CHUNK * PACKARD_WORD) {
        int64_t left = row->width - x;
        packard_region part = {row->q + x, row->r, left < CHUNK * PACKARD_WORD ? left : CHUNK * PACKARD_WORD, 1};
        model->engine->copy(model->cells, &part, words);
        for (size_t i = 0; i < packard_words((uint64_t)part.width); i++)
            snow_sink_u64(sink, words[i]);
        if (model->params.record_freeze_steps)
            save_dates(model, &part, words, sink);
    }
}

static void save_rows(const snow_grid *grid, snow_sink *sink)
{
    packard_region bounds = snow_packard_bounds(grid);
    snow_sink_u64(sink, (uint64_t)bounds.q);
    snow_sink_u64(sink, (uint64_t)bounds.r);
    snow_sink_u64(sink, (uint64_t)bounds.width);
    snow_sink_u64(sink, (uint64_t)bounds.height);
    for (int64_t y = 0; y < bounds.height; y++)
        save_row(packard_of(grid), &(packard_region){bounds.q, bounds.r + y, bounds.width, 1}, sink);
}

static bool is_empty(const uint64_t *words, int64_t count)
{
    for (int64_t i = 0; i < count; i++)
        if (words[i] != 0)
            return false;
    return true;
}

/* Each block with its place and size, the words of its rows, and, where they are recorded, the freeze steps; at the
   end one without cells. */
static void save_blocks(const snow_grid *grid, snow_sink *sink)
{
    const packard *model = packard_of(grid);
    packard_region block;
    for (bool more = snow_packard_first_block(grid, &block); more; more = snow_packard_next_block(grid, &block)) {
        uint64_t words[PACKARD_BLOCK];
        model->engine->copy(model->cells, &block, words);
        if (is_empty(words, block.height))
            continue;
        snow_sink_u8(sink, (uint8_t)block.width);
        snow_sink_u8(sink, (uint8_t)block.height);
        snow_sink_u64(sink, (uint64_t)block.q);
        snow_sink_u64(sink, (uint64_t)block.r);
        for (int64_t y = 0; y < block.height; y++)
            save_row(model, &(packard_region){block.q, block.r + y, block.width, 1}, sink);
    }
    snow_sink_u8(sink, 0);
}

static void save_cells(const snow_grid *grid, snow_sink *sink)
{
    switch (form_of(grid)) {
    case SAVED_ROWS: save_rows(grid, sink); break;
    case SAVED_TREE:
    case SAVED_SHIFTED_TREE: snow_packard_tree_save(packard_of(grid)->cells, sink); break;
    case SAVED_BLOCKS: save_blocks(grid, sink); break;
    case SAVED_FORMS: break;
    }
}

void snow_packard_save(const snow_grid *grid, snow_sink *sink)
{
    const packard *model = packard_of(grid);
    save_scene(grid, sink);
    snow_sink_u32(sink, (uint32_t)model->zone_count);
    for (size_t i = 0; i < model->zone_count; i++)
        save_zone(&model->zones[i], sink);
    save_cells(grid, sink);
}

typedef struct saved_scene {
    snow_packard_params params;
    bool still;
    saved_form form;
    int64_t steps;
} saved_scene;

static snow_status load_scene(snow_source *source, saved_scene *scene)
{
    snow_packard_params *params = &scene->params;
    snow_packard_params_init(params, sizeof *params);
    params->rule = snow_source_u32(source);
    params->domain = (snow_packard_domain)snow_source_u32(source);
    params->radius = (int32_t)snow_source_u32(source);
    params->width = (int32_t)snow_source_u32(source);
    params->height = (int32_t)snow_source_u32(source);
    params->engine = (snow_packard_engine)snow_source_u32(source);
    params->record_freeze_steps = snow_source_u8(source);
    uint8_t still = snow_source_u8(source);
    uint8_t form = snow_source_u8(source);
    uint64_t steps = snow_source_u64(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    scene->still = still == 1;
    scene->form = (saved_form)form;
    scene->steps = (int64_t)steps;
    bool sound = still <= 1 && form < SAVED_FORMS && steps <= UINT64_C(1) << 62 &&
                 snow_packard_params_check(params) == SNOW_OK &&
                 ((form != SAVED_TREE && form != SAVED_SHIFTED_TREE) ||
                  (params->domain == SNOW_PACKARD_PLANE && !params->record_freeze_steps &&
                                (params->engine == SNOW_PACKARD_ENGINE_AUTO ||
                                 params->engine == SNOW_PACKARD_ENGINE_QUADTREE)));
    return sound ? SNOW_OK : SNOW_ERROR_DAMAGED;
}

/* The zone's cells are compared with the data before anything is allocated for them. */
static snow_status load_zone_cells(snow_source *source, snow_heap *heap, packard_zone *zone)
{
    uint64_t words = (uint64_t)packard_words((uint64_t)zone->rect.width) * (uint64_t)zone->rect.height;
    if (words > snow_source_left(source) / sizeof(uint64_t))
        return SNOW_ERROR_TRUNCATED;
    if (words == 0)
        return SNOW_ERROR_DAMAGED;
    zone->cells = snow_heap_get_raw(heap, (size_t)words, sizeof *zone->cells);
    if (zone->cells == NULL)
        return heap->refusal;
    for (size_t i = 0; i < words; i++)
        zone->cells[i] = snow_source_u64(source);
    return SNOW_OK;
}

static snow_status load_zone(snow_source *source, snow_grid *grid)
{
    snow_packard_zone zone;
    snow_packard_zone_init(&zone, sizeof zone, SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_CORNERS);
    zone.kind = (snow_packard_zone_kind)snow_source_u32(source);
    zone.shape = (snow_packard_zone_shape)snow_source_u32(source);
    zone.first_step = (int64_t)snow_source_u64(source);
    zone.last_step = (int64_t)snow_source_u64(source);
    zone.centre.q = (int32_t)snow_source_u32(source);
    zone.centre.r = (int32_t)snow_source_u32(source);
    int64_t half_cells = (int64_t)snow_source_u64(source);
    zone.half_angle = snow_source_double(source);
    int64_t inner = (int64_t)snow_source_u64(source);
    int64_t outer = (int64_t)snow_source_u64(source);
    zone.inverted = snow_source_u8(source);
    zone.rect.q = (int32_t)snow_source_u32(source);
    zone.rect.r = (int32_t)snow_source_u32(source);
    zone.rect.width = (int32_t)snow_source_u32(source);
    zone.rect.height = (int32_t)snow_source_u32(source);
    uint8_t has_cells = snow_source_u8(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    packard_zone copy;
    bool sound = half_cells >= -1 && (half_cells < 0) == (zone.half_angle > 0) && has_cells <= 1 && inner >= 0 &&
                 outer >= 0 && (has_cells == 0 || zone.shape == SNOW_PACKARD_CELLS);
    if (!sound || snow_packard_zone_read(&zone, &grid->heap, &copy) != SNOW_OK)
        return SNOW_ERROR_DAMAGED;
    copy.half_cells = half_cells;
    copy.inner = inner;
    copy.outer = outer;
    snow_status status = has_cells != 0 ? load_zone_cells(source, &grid->heap, &copy) : SNOW_OK;
    if (status == SNOW_OK)
        status = snow_packard_zone_keep(grid, &copy);
    if (status != SNOW_OK)
        snow_heap_put(&grid->heap, copy.cells);
    return status;
}

static snow_status load_dates(snow_source *source, snow_grid *grid, const packard_region *row, const uint64_t *words)
{
    const packard *model = packard_of(grid);
    for (int64_t x = 0; x < row->width; x++) {
        if ((words[x / PACKARD_WORD] >> (x % PACKARD_WORD) & 1) == 0)
            continue;
        uint64_t date = snow_source_u64(source);
        if (source->truncated)
            return SNOW_ERROR_TRUNCATED;
        if (date > (uint64_t)grid->census.steps)
            return SNOW_ERROR_DAMAGED;
        snow_status status = model->engine->put_dated(model->cells, row->q + x, row->r, (int64_t)date);
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

/* Every cell whose bit is set belongs to the row and the domain. */
static bool is_sound_row(const snow_grid *grid, const packard_region *row, const uint64_t *words)
{
    for (int64_t x = 0; x < (int64_t)packard_words((uint64_t)row->width) * PACKARD_WORD; x++)
        if ((words[x / PACKARD_WORD] >> (x % PACKARD_WORD) & 1) != 0 &&
            (x >= row->width || !packard_has_cell(grid, row->q + x, row->r)))
            return false;
    return true;
}

static snow_status load_row(snow_source *source, snow_grid *grid, const packard_region *row)
{
    uint64_t words[CHUNK];
    for (int64_t x = 0; x < row->width; x += CHUNK * PACKARD_WORD) {
        int64_t left = row->width - x;
        packard_region part = {row->q + x, row->r, left < CHUNK * PACKARD_WORD ? left : CHUNK * PACKARD_WORD, 1};
        for (size_t i = 0; i < packard_words((uint64_t)part.width); i++)
            words[i] = snow_source_u64(source);
        if (!is_sound_row(grid, &part, words))
            return SNOW_ERROR_DAMAGED;
        snow_status status = packard_of(grid)->params.record_freeze_steps ? load_dates(source, grid, &part, words)
                                                                          : snow_packard_put(grid, &part, words);
        if (status != SNOW_OK)
            return status;
    }
    return SNOW_OK;
}

/* A crystal can have come so far from 32-bit seeds in tiles, and no farther. */
static bool is_sound_place(int64_t first, uint64_t count)
{
    const int64_t limit = INT64_C(1) << 36;
    return first > -limit && first < limit && count < (uint64_t)limit;
}

/* The reference takes a byte and more for each cell of a rectangle, and few bytes can tell of a large one: then the
   tiles, which give the same cells, take its place. */
static bool is_dear(const snow_source *source, int64_t width, int64_t height)
{
    const int64_t cheap = INT64_C(1) << 20;
    const int64_t cells_a_byte = 8;
    double most = (double)cheap + (double)cells_a_byte * (double)snow_source_left(source);
    return (double)width * (double)height > most;
}

/* On the plane the rectangle grows from the origin to the crystal, with a margin as wide as itself. */
static bool is_dear_on_the_plane(const snow_source *source, const packard_region *crystal)
{
    int64_t width = snow_hexagon_magnitude(crystal->q) + crystal->width;
    int64_t height = snow_hexagon_magnitude(crystal->r) + crystal->height;
    int64_t side = 2 * (width > height ? width : height);
    return is_dear(source, side, side);
}

static bool is_dear_domain(const snow_source *source, const snow_packard_params *params)
{
    int64_t side = 3 * (int64_t)params->radius;
    switch (params->domain) {
    case SNOW_PACKARD_PLANE: return false;
    case SNOW_PACKARD_DISC:
    case SNOW_PACKARD_HEXAGON: return is_dear(source, side, side);
    case SNOW_PACKARD_RECTANGLE: return is_dear(source, (int64_t)params->width + params->height / 2, params->height);
    case SNOW_PACKARD_RHOMBUS:
    case SNOW_PACKARD_TORUS: break;
    }
    return is_dear(source, params->width, params->height);
}

/* In place of an engine that has no cells yet. */
static void use_engine(snow_grid *grid, const packard_engine *engine, void *cells)
{
    packard *model = packard_of(grid);
    model->engine->destroy(grid, model->cells);
    model->engine = engine;
    model->cells = cells;
}

static snow_status use_tiles(snow_grid *grid)
{
    packard *model = packard_of(grid);
    void *cells;
    snow_status status = snow_packard_tiles.create(grid, &model->fold, &cells);
    if (status != SNOW_OK)
        return status;
    use_engine(grid, &snow_packard_tiles, cells);
    model->params.engine = SNOW_PACKARD_ENGINE_TILES;
    return SNOW_OK;
}

static snow_status load_rows(snow_source *source, snow_grid *grid)
{
    int64_t q = (int64_t)snow_source_u64(source);
    int64_t r = (int64_t)snow_source_u64(source);
    uint64_t width = snow_source_u64(source);
    uint64_t height = snow_source_u64(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (!is_sound_place(q, width) || !is_sound_place(r, height) || (width == 0) != (height == 0))
        return SNOW_ERROR_DAMAGED;
    uint64_t words = (width + PACKARD_WORD - 1) / PACKARD_WORD;
    if (words > 0 && height > snow_source_left(source) / sizeof(uint64_t) / words)
        return SNOW_ERROR_TRUNCATED;
    const packard_region crystal = {q, r, (int64_t)width, (int64_t)height};
    snow_status status = SNOW_OK;
    if (packard_of(grid)->engine == &snow_packard_reference && is_dear_on_the_plane(source, &crystal))
        status = use_tiles(grid);
    for (int64_t y = 0; y < (int64_t)height && status == SNOW_OK; y++)
        status = load_row(source, grid, &(packard_region){q, r + y, (int64_t)width, 1});
    return status == SNOW_OK && source->truncated ? SNOW_ERROR_TRUNCATED : status;
}

static snow_status load_block(snow_source *source, snow_grid *grid, int64_t width)
{
    uint8_t height = snow_source_u8(source);
    packard_region block = {.width = width, .height = height};
    block.q = (int64_t)snow_source_u64(source);
    block.r = (int64_t)snow_source_u64(source);
    if (source->truncated)
        return SNOW_ERROR_TRUNCATED;
    if (width > PACKARD_BLOCK || height > PACKARD_BLOCK || !is_sound_place(block.q, (uint64_t)width) ||
        !is_sound_place(block.r, height))
        return SNOW_ERROR_DAMAGED;
    snow_status status = SNOW_OK;
    for (int64_t y = 0; y < height && status == SNOW_OK && !source->truncated; y++)
        status = load_row(source, grid, &(packard_region){block.q, block.r + y, width, 1});
    return source->truncated ? SNOW_ERROR_TRUNCATED : status;
}

/* Blocks can stand anywhere on the plane, and the reference fills the space between them. */
static snow_status load_blocks(snow_source *source, snow_grid *grid)
{
    const packard *model = packard_of(grid);
    snow_status status = SNOW_OK;
    if (model->engine == &snow_packard_reference && packard_is_plane(model))
        status = use_tiles(grid);
    while (status == SNOW_OK) {
        uint8_t width = snow_source_u8(source);
        if (source->truncated)
            return SNOW_ERROR_TRUNCATED;
        if (width == 0)
            return SNOW_OK;
        status = load_block(source, grid, width);
    }
    return status;
}

static snow_status load_tree(snow_source *source, snow_grid *grid, bool shifted)
{
    void *cells;
    snow_status status = snow_packard_tree_load(grid, source, shifted, &cells);
    if (status == SNOW_OK)
        use_engine(grid, &snow_packard_quadtree, cells);
    return status;
}

static snow_status load_cells(snow_source *source, saved_form form, snow_grid *grid)
{
    switch (form) {
    case SAVED_ROWS: return load_rows(source, grid);
    case SAVED_TREE:
    case SAVED_SHIFTED_TREE: return load_tree(source, grid, form == SAVED_SHIFTED_TREE);
    case SAVED_BLOCKS: return load_blocks(source, grid);
    case SAVED_FORMS: break;
    }
    return SNOW_ERROR_DAMAGED;
}

static snow_status load_frozen(snow_source *source, const saved_scene *scene, snow_grid *grid)
{
    snow_status status = load_cells(source, scene->form, grid);
    if (status == SNOW_OK)
        status = snow_packard_settle(grid);
    grid->census.still = scene->still;
    return status;
}

static snow_status load_all(snow_source *source, const saved_scene *scene, snow_grid *grid)
{
    uint32_t zones = snow_source_u32(source);
    snow_status status = SNOW_OK;
    for (uint32_t i = 0; i < zones && status == SNOW_OK; i++)
        status = load_zone(source, grid);
    return status == SNOW_OK ? load_frozen(source, scene, grid) : status;
}

snow_status snow_packard_load(snow_source *source, const snow_options *options, snow_grid **result)
{
    saved_scene scene;
    snow_status status = load_scene(source, &scene);
    if (status != SNOW_OK)
        return status;
    if (scene.params.engine == SNOW_PACKARD_ENGINE_REFERENCE && is_dear_domain(source, &scene.params))
        scene.params.engine = SNOW_PACKARD_ENGINE_TILES;
    snow_grid *grid = NULL;
    status = snow_packard_build(&scene.params, options, scene.steps, &grid);
    if (status == SNOW_OK)
        status = load_all(source, &scene, grid);
    return snow_grid_hand_over(grid, status, result);
}
