/* The caller's floating-point state: every call leaves each bit of it as it was, and gives the same answer in all. */
#include "support/grids.h"

#include <fenv.h>
#include <stdlib.h>
#include <string.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/* What a thread can set: the whole control and status register on x86, so traps, flushing to zero and the flag of
   subnormal operands too; elsewhere what C knows of. */
typedef struct floating_state {
    const char *name;
    unsigned control; /* MXCSR; elsewhere the rounding mode */
    unsigned more;    /* the x87 control word; elsewhere the flags */
} floating_state;

#if defined(__SSE2__)
enum { CALM = 0x1F80, ALL_FLAGS = 0x3F, UPWARD = 0x4000, DOWNWARD = 0x2000, TOWARD_ZERO = 0x6000, FLUSH = 0x8040 };
enum { X87_CALM = 0x37F, X87_SINGLE = 0x7F, X87_UPWARD = 0xB7F, X87_TRAPS = 0x340 };

static const floating_state calm = {"calm", CALM, X87_CALM};
static const floating_state states[] = {
    {"as a program starts", CALM, X87_CALM},
    {"flags raised", CALM | ALL_FLAGS, X87_CALM},
    {"upward", CALM | UPWARD, X87_UPWARD},
    {"downward, flags raised", CALM | DOWNWARD | ALL_FLAGS, X87_CALM},
    {"toward zero", CALM | TOWARD_ZERO, X87_CALM},
    {"flush to zero, subnormal operands are zero", CALM | FLUSH, X87_CALM},
    {"upward, flush, flags raised", CALM | UPWARD | FLUSH | ALL_FLAGS, X87_CALM},
    {"x87 in single precision", CALM, X87_SINGLE},
    {"every exception traps", 0, X87_TRAPS},
    {"every exception traps, toward zero, flush", TOWARD_ZERO | FLUSH, X87_TRAPS},
};

static void set_state(const floating_state *wanted)
{
    unsigned short word = (unsigned short)wanted->more;
    __asm__ volatile("fnclex; fldcw %0" : : "m"(word));
    _mm_setcsr(wanted->control);
}

static floating_state get_state(void)
{
    unsigned short word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return (floating_state){NULL, _mm_getcsr(), word};
}
#else
static const floating_state calm = {"calm", FE_TONEAREST, 0};
static const floating_state states[] = {
    {"as a program starts", FE_TONEAREST, 0},
    {"flags raised", FE_TONEAREST, FE_ALL_EXCEPT},
#ifdef FE_UPWARD
    {"upward", FE_UPWARD, 0},
    {"toward zero, flags raised", FE_TOWARDZERO, FE_ALL_EXCEPT},
#endif
};

static void set_state(const floating_state *wanted)
{
    fesetround((int)wanted->control);
    feclearexcept(FE_ALL_EXCEPT);
    feraiseexcept((int)wanted->more);
}

static floating_state get_state(void)
{
    return (floating_state){NULL, (unsigned)fegetround(), (unsigned)fetestexcept(FE_ALL_EXCEPT)};
}
#endif

static bool is_same(const floating_state *a, const floating_state *b)
{
    return a->control == b->control && a->more == b->more;
}

/* Emulators, valgrind among them, keep only a part. */
static bool can_be_kept(const floating_state *state)
{
    fenv_t saved;
    set_state(state);
    fegetenv(&saved);
    fesetenv(FE_DFL_ENV);
    fesetenv(&saved);
    floating_state kept = get_state();
    set_state(&calm);
    return is_same(state, &kept);
}

/* A program's life with its grids; what the calls answer goes into the trace. */
enum { NUMBERS = 1024, PIXELS = 200 * 200 * 4 };

typedef struct life {
    snow_reiter_params params;
    snow_grid *grid;
    unsigned char *bytes; /* a snapshot */
    size_t size, at;
    double numbers[NUMBERS];
    unsigned char pixels[PIXELS];
    uint64_t trace;
} life;

static void note(life *mine, const void *what, size_t size)
{
    const unsigned char *bytes = what;
    for (size_t i = 0; i < size; i++)
        mine->trace = (mine->trace ^ bytes[i]) * UINT64_C(0x100000001b3);
}

static void note_status(life *mine, snow_status status)
{
    note(mine, &status, sizeof status);
}

static void create(life *mine)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    options.threads = 2;
    note_status(mine, snow_reiter_create(&mine->params, &options, &mine->grid));
}

static void refuse_to_create(life *mine)
{
    snow_reiter_params params = mine->params;
    snow_grid *none = NULL;
    params.addition = -0x1p-1074;
    note_status(mine, snow_reiter_create(&params, NULL, &none));
    params.addition = 0.1;
    params.background = -0x1p-1074;
    note_status(mine, snow_reiter_create(&params, NULL, &none));
}

static void create_in_thin_air(life *mine)
{
    snow_reiter_params params = mine->params;
    params.background = 0x1p-1060;
    params.addition = 0x1p-1070;
    params.noise = 0;
    snow_grid *thin = NULL;
    note_status(mine, snow_reiter_create(&params, NULL, &thin));
    note_status(mine, snow_step(thin, 10));
    note_status(mine, snow_field_copy(thin, SNOW_FIELD_VALUE, NULL, mine->numbers, NUMBERS, NULL));
    note(mine, mine->numbers, sizeof mine->numbers);
    snow_destroy(thin);
}

static void step(life *mine)
{
    note_status(mine, snow_step(mine->grid, 25));
}

static int look(void *context, const snow_grid *grid, const snow_summary *summary)
{
    life *mine = context;
    double value = 0;
    note_status(mine, snow_cell_value(grid, SNOW_FIELD_VALUE, 3, -1, &value));
    note(mine, &value, sizeof value);
    note(mine, &summary->tip_radius, sizeof summary->tip_radius);
    return 0;
}

static void run(life *mine)
{
    snow_stop stop;
    snow_stop_init(&stop, sizeof stop);
    stop.max_steps = 60;
    stop.rim = 0;
    stop.progress = look;
    stop.progress_context = mine;
    stop.progress_steps = 10;
    snow_summary summary;
    snow_summary_init(&summary, sizeof summary);
    note_status(mine, snow_run(mine->grid, &stop, &summary));
    note(mine, &summary.reason, sizeof summary.reason);
    note(mine, &summary.tip_radius, sizeof summary.tip_radius);
    stop.seconds = -0x1p-1074;
    note_status(mine, snow_run(mine->grid, &stop, NULL));
    stop.seconds = 0;
    stop.tip_radius = 0x1p-1074;
    note_status(mine, snow_run(mine->grid, &stop, NULL));
}

static void change(life *mine)
{
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    conditions.background = 0.3;
    conditions.addition = 0.0171;
    conditions.diffusion = 0.9;
    note_status(mine, snow_reiter_change(mine->grid, &conditions));
    conditions.addition = -0x1p-1074;
    note_status(mine, snow_reiter_change(mine->grid, &conditions));
    conditions.addition = 0x1p-1074;
    note_status(mine, snow_reiter_change(mine->grid, &conditions));
    conditions.addition = 0.0123;
    note_status(mine, snow_reiter_change(mine->grid, &conditions));
    note_status(mine, snow_reiter_conditions_of(mine->grid, &conditions));
    note(mine, &conditions.background, sizeof conditions.background);
}

static void set(life *mine)
{
    static const double values[] = {0.1234567, 0x1p-1074, 1e-310, 1.7, 1.0 / 3};
    static const double negative = -0x1p-1074;
    snow_rect inside = {-2, 4, 5, 1};
    snow_rect rim = {10, 0, 5, 1};
    snow_rect cell = {-2, 4, 1, 1};
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_VAPOUR, &inside, values, 3));
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_VALUE, &inside, values, 5));
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_ADDITION, &cell, values, 1));
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_BACKGROUND, &rim, values, 3));
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_VALUE, &cell, &negative, 1));
    note_status(mine, snow_field_set(mine->grid, SNOW_FIELD_ADDITION, &cell, &negative, 1));
}

static void read_fields(life *mine)
{
    static const snow_field fields[] = {SNOW_FIELD_VALUE, SNOW_FIELD_VAPOUR, SNOW_FIELD_ADDITION,
                                        SNOW_FIELD_BACKGROUND};
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        note_status(mine, snow_field_copy(mine->grid, fields[i], NULL, mine->numbers, NUMBERS, NULL));
        note(mine, mine->numbers, sizeof mine->numbers);
        note_status(mine, snow_cell_value(mine->grid, fields[i], 1, 1, mine->numbers));
        note(mine, mine->numbers, sizeof mine->numbers[0]);
    }
}

static void measure(life *mine)
{
    double numbers[4] = {0};
    uint64_t digest = 0;
    note_status(mine, snow_mass(mine->grid, &numbers[0], &numbers[1]));
    note_status(mine, snow_symmetry_defect(mine->grid, &numbers[2]));
    note_status(mine, snow_tip_radius(mine->grid, &numbers[3]));
    note_status(mine, snow_digest(mine->grid, &digest));
    note(mine, numbers, sizeof numbers);
    note(mine, &digest, sizeof digest);
}

static void draw(life *mine)
{
    snow_view view;
    snow_view_init(&view, sizeof view);
    note_status(mine, snow_view_fit(mine->grid, 97, &view));
    view.scale *= 0.5; /* exact: the tests themselves must raise nothing */
    note_status(mine, snow_render(mine->grid, &view, mine->pixels, sizeof mine->pixels, NULL));
    note(mine, mine->pixels, sizeof mine->pixels);
    view.centre_y = 0x1p-1074;
    note_status(mine, snow_render(mine->grid, &view, mine->pixels, sizeof mine->pixels, NULL));
    view.scale = 0x1p-1074;
    note_status(mine, snow_render(mine->grid, &view, mine->pixels, sizeof mine->pixels, NULL));
    note(mine, mine->pixels, sizeof mine->pixels);
}

static int take(void *context, const void *bytes, size_t size)
{
    note(context, bytes, size);
    return 0;
}

static void save(life *mine)
{
    mine->bytes = malloc(1 << 16);
    note_status(mine, snow_save(mine->grid, mine->bytes, 1 << 16, &mine->size));
    note(mine, mine->bytes, mine->size);
    note_status(mine, snow_save_to(mine->grid, take, mine));
}

static int give(void *context, void *bytes, size_t size, size_t *got)
{
    life *mine = context;
    *got = size < mine->size - mine->at ? size : mine->size - mine->at;
    memcpy(bytes, mine->bytes + mine->at, *got);
    mine->at += *got;
    return 0;
}

static void load(life *mine)
{
    snow_grid *copy = NULL;
    uint64_t digests[2] = {0};
    note_status(mine, snow_load_from(give, mine, NULL, &copy));
    note_status(mine, snow_step(copy, 5));
    note_status(mine, snow_digest(copy, &digests[0]));
    snow_destroy(copy);
    copy = NULL;
    note_status(mine, snow_load(mine->bytes, mine->size, NULL, &copy));
    note_status(mine, snow_step(copy, 5));
    note_status(mine, snow_digest(copy, &digests[1]));
    snow_destroy(copy);
    note(mine, digests, sizeof digests);
}

/* One grid: the trace is not made for several threads. */
static snow_status create_for_sweep(void *context, size_t index, const snow_options *options, snow_stop *stop,
                                    snow_grid **grid)
{
    const life *mine = context;
    (void)index;
    stop->max_steps = 30;
    return snow_reiter_create(&mine->params, options, grid);
}

static int take_from_sweep(void *context, size_t index, snow_status status, snow_grid *grid,
                           const snow_summary *summary)
{
    life *mine = context;
    uint64_t digest = 0;
    (void)index;
    note_status(mine, status);
    note_status(mine, snow_digest(grid, &digest));
    note(mine, &digest, sizeof digest);
    note(mine, &summary->tip_radius, sizeof summary->tip_radius);
    return 0;
}

static void sweep(life *mine)
{
    note_status(mine, snow_sweep(1, create_for_sweep, take_from_sweep, mine, NULL, NULL));
}

/* Steps until the vapour leaves its bound. */
static void explode(life *mine)
{
    snow_reiter_params params = mine->params;
    params.background = 1e-6;
    params.noise = 1e-7;
    params.diffusion = 4;
    params.allow_unstable = 1;
    snow_grid *wild = NULL;
    uint64_t digest = 0;
    note_status(mine, snow_reiter_create(&params, NULL, &wild));
    note_status(mine, snow_step(wild, 1000));
    note_status(mine, snow_digest(wild, &digest));
    note(mine, &digest, sizeof digest);
    snow_destroy(wild);
}

static void destroy(life *mine)
{
    snow_destroy(mine->grid);
    free(mine->bytes);
    mine->grid = NULL;
    mine->bytes = NULL;
}

static const struct {
    const char *name;
    void (*make)(life *mine);
} calls[] = {
    {"create", create},
    {"refuse to create", refuse_to_create},
    {"create in thin air", create_in_thin_air},
    {"step", step},
    {"run", run},
    {"change", change},
    {"step after a change", step},
    {"set", set},
    {"step after a set", step},
    {"read", read_fields},
    {"measure", measure},
    {"draw", draw},
    {"save", save},
    {"load", load},
    {"sweep", sweep},
    {"explode", explode},
    {"destroy", destroy},
};

/* The trace after each call, all of them made in one state. */
static void live(const snow_reiter_params *params, const floating_state *state, uint64_t traces[COUNT_OF(calls)])
{
    static life mine;
    memset(&mine, 0, sizeof mine);
    mine.params = *params;
    for (size_t i = 0; i < COUNT_OF(calls); i++) {
        set_state(state);
        calls[i].make(&mine);
        floating_state after = get_state();
        set_state(&calm);
        if (!is_same(state, &after))
            fail_msg("%s, %s: %x and %x became %x and %x", calls[i].name, state->name, state->control, state->more,
                     after.control, after.more);
        traces[i] = mine.trace;
    }
}

static void live_in_every_state(snow_reiter_engine engine, snow_reiter_precision precision)
{
    snow_reiter_params params = disc_scene(0.4, 0.013, 1, 12);
    params.noise = 0.1;
    params.engine = engine;
    params.precision = precision;
    uint64_t expected[COUNT_OF(calls)];
    size_t kept = 0;
    live(&params, &calm, expected);
    for (size_t i = 0; i < COUNT_OF(states); i++) {
        if (!can_be_kept(&states[i]))
            continue;
        kept++;
        uint64_t got[COUNT_OF(calls)];
        live(&params, &states[i], got);
        for (size_t k = 0; k < COUNT_OF(calls); k++)
            if (got[k] != expected[k])
                fail_msg("%s, %s: another answer", calls[k].name, states[i].name);
    }
    if (kept == 0)
        skip();
}

static void rows(void **state)
{
    (void)state;
    live_in_every_state(SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_DOUBLE);
}

static void rows_in_single_precision(void **state)
{
    (void)state;
    live_in_every_state(SNOW_REITER_ENGINE_ROWS, SNOW_REITER_PRECISION_SINGLE);
}

static void reference(void **state)
{
    (void)state;
    live_in_every_state(SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_DOUBLE);
}

static void reference_in_single_precision(void **state)
{
    (void)state;
    live_in_every_state(SNOW_REITER_ENGINE_REFERENCE, SNOW_REITER_PRECISION_SINGLE);
}

static void quad(void **state)
{
    (void)state;
    live_in_every_state(SNOW_REITER_ENGINE_QUAD, SNOW_REITER_PRECISION_DOUBLE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows),
        cmocka_unit_test(rows_in_single_precision),
        cmocka_unit_test(reference),
        cmocka_unit_test(reference_in_single_precision),
        cmocka_unit_test(quad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
