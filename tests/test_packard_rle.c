/* Patterns in run-length encoding, out and in; against bgolly where it is installed; and hostile ones. */
#define _XOPEN_SOURCE 700 /* mkdtemp() */
#include "support/packard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *save_pattern(const snow_grid *grid)
{
    size_t size = 0, again = 0;
    assert_ok(snow_packard_save_rle(grid, NULL, 0, &size));
    char *text = malloc(size + 1);
    assert_non_null(text);
    assert_status(SNOW_ERROR_BUFFER, snow_packard_save_rle(grid, text, size - 1, &again));
    assert_int_equal(size, again);
    assert_ok(snow_packard_save_rle(grid, text, size, &again));
    text[size] = '\0';
    return text;
}

static snow_grid *load_pattern(const char *text)
{
    snow_grid *grid = NULL;
    assert_ok(snow_packard_load_rle(text, strlen(text), NULL, NULL, &grid));
    assert_non_null(grid);
    return grid;
}

static void a_small_crystal_is_written_as_it_should_be(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0100000");
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 1));
    char *text = save_pattern(grid);
    assert_string_equal("#CXRLE Pos=-1,-1 Gen=1\nx = 3, y = 3, rule = B1/S0123456H\n2o$3o$b2o!\n", text);
    free(text);
    snow_destroy(grid);

    params.seeds = &(snow_cell){0, 0};
    grid = make_packard(&params, NULL); /* seed_count = 0 */
    text = save_pattern(grid);
    assert_string_equal("#CXRLE Pos=0,0 Gen=0\nx = 0, y = 0, rule = B1/S0123456H\n!\n", text);
    snow_grid *loaded = load_pattern(text);
    assert_int_equal(0, frozen_of(loaded));
    free(text);
    snow_destroy(grid);
    snow_destroy(loaded);
}

static void what_is_written_is_read_back(void **state)
{
    (void)state;
    static const char *const rules[] = {"0101010", "B1/S0123456H:T20,13", "B13/S0123456H:P31,8", "0110100"};
    for (size_t i = 0; i < COUNT_OF(rules); i++) {
        for (int engine = SNOW_PACKARD_ENGINE_REFERENCE; engine <= SNOW_PACKARD_ENGINE_QUADTREE; engine++) {
            snow_packard_params params = packard_scene(rules[i]);
            if (engine == SNOW_PACKARD_ENGINE_QUADTREE && params.domain != SNOW_PACKARD_PLANE)
                continue;
            params.engine = (snow_packard_engine)engine;
            params.scatter = 5;
            params.scatter_side = 8;
            snow_grid *grid = make_packard(&params, NULL);
            for (int part = 0; part < 3; part++) {
                char *text = save_pattern(grid);
                snow_grid *loaded = load_pattern(text);
                assert_same_crystals(grid, loaded);
                assert_ok(snow_step(grid, 9));
                assert_ok(snow_step(loaded, 9));
                assert_same_crystals(grid, loaded);
                free(text);
                snow_destroy(loaded);
            }
            snow_destroy(grid);
        }
    }
}

static void lines_are_short(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 100));
    char *text = save_pattern(grid);
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n"))
        assert_in_range(strlen(line), 1, 70);
    free(text);
    snow_destroy(grid);
}

static void patterns_of_others_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint64_t cells;
        int32_t q, r; /* a cell that is frozen */
    } patterns[] = {
        {"x = 1, y = 1, rule = B1/S0123456H\no!", 1, 0, 0},
        {"x=3,y=3,rule=b1s0123456h\r\nbo$\r\n3o$bo!", 5, 1, -1},
        {"#C a comment\n#N name\n x = 2, y = 1\n2o!rubbish", 2, 0, 0},
        {"#CXRLE Pos=5,3\nx = 3, y = 1, rule = 0123456/1H\n3o!", 3, 2, 3},
        {"x = 2, y = 2, rule = B1/S0123456H\n.A$A.!", 2, -1, 0},
        {"x = 0, y = 0, rule = B1/S0123456H\n!", 0, 0, 0},
    };
    for (size_t i = 0; i < COUNT_OF(patterns); i++) {
        snow_grid *grid = load_pattern(patterns[i].text);
        assert_int_equal(patterns[i].cells, frozen_of(grid));
        assert_same_double(patterns[i].cells > 0, value_at(grid, SNOW_FIELD_FROZEN, patterns[i].q, patterns[i].r));
        snow_destroy(grid);
    }
}

static void the_header_wins_over_the_parameters(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0110100");
    params.domain = SNOW_PACKARD_DISC;
    params.radius = 9;
    params.cluster = 7;
    params.record_freeze_steps = 1;
    static const char with_rule[] = "#CXRLE Gen=12\nx = 1, y = 1, rule = B1/S0123456H\no!";
    static const char without[] = "x = 1, y = 1\no!";
    snow_grid *grid = NULL;
    uint32_t rule = 0;
    assert_ok(snow_packard_load_rle(with_rule, strlen(with_rule), &params, NULL, &grid));
    assert_ok(snow_packard_rule_of(grid, &rule));
    assert_int_equal(2, rule);
    assert_int_equal(12, steps_of(grid));
    assert_int_equal(1, frozen_of(grid));
    assert_true(records_freeze_steps(grid));
    snow_destroy(grid);
    assert_ok(snow_packard_load_rle(without, strlen(without), &params, NULL, &grid));
    assert_ok(snow_packard_rule_of(grid, &rule));
    assert_int_equal(0x16, rule);
    snow_destroy(grid);
}

static void wrong_patterns_are_refused(void **state)
{
    (void)state;
#define HEAD "x = 9, y = 9, rule = B1/S0123456H\n"
    static const struct {
        snow_status status;
        const char *text;
    } wrong[] = {
        {SNOW_ERROR_TRUNCATED, ""},
        {SNOW_ERROR_TRUNCATED, "#C only a comment"},
        {SNOW_ERROR_TRUNCATED, "x = 3"},
        {SNOW_ERROR_TRUNCATED, HEAD},
        {SNOW_ERROR_TRUNCATED, HEAD "3o$2"},
        {SNOW_ERROR_PACKARD_RLE, "hello"},
        {SNOW_ERROR_PACKARD_RLE, "x = -1, y = 1\no!"},
        {SNOW_ERROR_PACKARD_RLE, "x = 1, y = 1, ruel = B1/S0123456H\no!"},
        {SNOW_ERROR_PACKARD_RLE, "#CXRLE Pos=1\nx = 1, y = 1\no!"},
        {SNOW_ERROR_PACKARD_RLE, HEAD "0o!"},
        {SNOW_ERROR_PACKARD_RLE, HEAD "3o?!"},
        {SNOW_ERROR_PACKARD_RLE, HEAD "\xff\xfe!"},
        {SNOW_ERROR_PACKARD_RLE_STATES, HEAD "3oB!"},
        {SNOW_ERROR_PACKARD_RLE_STATES, HEAD "pA!"},
        {SNOW_ERROR_PACKARD_RULE_MELTS, "x = 1, y = 1, rule = B2/S34H\no!"},
        {SNOW_ERROR_PACKARD_RULE_LATTICE, "x = 1, y = 1, rule = B3/S23\no!"},
        {SNOW_ERROR_PACKARD_BIRTH, "x = 1, y = 1, rule = B01/S0123456H\no!"},
        {SNOW_ERROR_PACKARD_RULE_DOMAIN, "x = 1, y = 1, rule = B1/S0123456H:C9,9\no!"},
        {SNOW_ERROR_PACKARD_SEED, "x = 9, y = 1, rule = B1/S0123456H:T5,5\n9o!"},
        {SNOW_ERROR_TOO_LARGE, HEAD "99999999999999999999o!"},
        {SNOW_ERROR_TOO_LARGE, HEAD "2147483648b2147483648bo!"},
        {SNOW_ERROR_TOO_LARGE, HEAD "2147483648$2147483648$o!"},
        {SNOW_ERROR_TOO_LARGE, "#CXRLE Pos=9999999999,0\n" HEAD "o!"},
        {SNOW_ERROR_TOO_LARGE, "#CXRLE Gen=9999999999999999999\n" HEAD "o!"},
    };
#undef HEAD
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        snow_grid *grid = NULL;
        snow_status status = snow_packard_load_rle(wrong[i].text, strlen(wrong[i].text), NULL, NULL, &grid);
        if (status != wrong[i].status)
            print_error("pattern \"%s\"\n", wrong[i].text);
        assert_status(wrong[i].status, status);
        assert_null(grid);
    }
}

/* A few bytes stand for many cells; the limit holds. */
static void large_patterns_keep_to_the_memory_limit(void **state)
{
    (void)state;
    static const char text[] = "x = 1, y = 1, rule = B1/S0123456H\n1000000000o$1000000000o!";
    snow_options options = default_options();
    options.memory_limit = 1 << 20;
    snow_grid *grid = NULL;
    assert_status(SNOW_ERROR_MEMORY_LIMIT, snow_packard_load_rle(text, strlen(text), NULL, &options, &grid));
    assert_null(grid);
}

static void any_bytes_are_survived(void **state)
{
    (void)state;
    static const char letters[] = "0123456789bo$!.A\nx=y,rule #:T-";
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = make_packard(&params, NULL);
    assert_ok(snow_step(grid, 6));
    char *sound = save_pattern(grid);
    size_t size = strlen(sound);
    snow_options options = default_options();
    options.memory_limit = 1 << 22;
    uint64_t random = 5;
    for (int i = 0; i < 3000; i++) {
        char *text = malloc(size);
        memcpy(text, sound, size);
        for (int k = 0; k < 1 + i % 4; k++)
            text[next_below(&random, (uint32_t)size)] = letters[next_below(&random, sizeof letters - 1)];
        snow_grid *loaded = NULL;
        snow_status status = snow_packard_load_rle(text, size - (size_t)(i % 7), NULL, &options, &loaded);
        assert_int_equal(status == SNOW_OK, loaded != NULL);
        snow_destroy(loaded);
        free(text);
    }
    free(sound);
    snow_destroy(grid);
}

typedef struct pieces {
    const char *next;
    size_t left;
    size_t calls;
} pieces;

static int read_three(void *context, void *bytes, size_t size, size_t *got)
{
    pieces *from = context;
    *got = from->left < 3 ? from->left : 3;
    assert_true(size >= 3);
    memcpy(bytes, from->next, *got);
    from->next += *got;
    from->left -= *got;
    return 0;
}

static int read_nothing(void *context, void *bytes, size_t size, size_t *got)
{
    (void)context, (void)bytes, (void)size, (void)got;
    return 1;
}

static int write_once(void *context, const void *bytes, size_t size)
{
    (void)bytes, (void)size;
    return ++*(int *)context > 1;
}

static void callbacks_serve_as_well_as_memory(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0100000");
    snow_grid *grid = make_packard(&params, NULL), *loaded = NULL;
    assert_ok(snow_step(grid, 150));
    char *text = save_pattern(grid);
    pieces from = {text, strlen(text), 0};
    assert_ok(snow_packard_load_rle_from(read_three, &from, NULL, NULL, &loaded));
    assert_same_crystals(grid, loaded);
    int calls = 0;
    assert_status(SNOW_ERROR_WRITE, snow_packard_save_rle_to(grid, write_once, &calls));
    assert_int_equal(2, calls);
    assert_status(SNOW_ERROR_READ, snow_packard_load_rle_from(read_nothing, NULL, NULL, NULL, &loaded));
    assert_status(SNOW_ERROR_NULL, snow_packard_load_rle_from(NULL, NULL, NULL, NULL, &loaded));
    assert_status(SNOW_ERROR_NULL, snow_packard_load_rle_from(read_three, &from, NULL, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_load_rle(NULL, 0, NULL, NULL, &loaded));
    assert_status(SNOW_ERROR_NULL, snow_packard_load_rle(text, 1, NULL, NULL, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_save_rle(NULL, NULL, 0, &from.left));
    assert_status(SNOW_ERROR_NULL, snow_packard_save_rle(grid, text, 9, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_save_rle_to(grid, NULL, NULL));
    free(text);
    snow_destroy(grid);
    snow_destroy(loaded);
}

static char *read_file(const char *name)
{
    static char text[1 << 19];
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

/* The pattern in the middle of the plane: bgolly writes neither place nor step count. */
static snow_grid *load_centred(const char *text)
{
    return load_pattern(text[0] == '#' ? strchr(text, '\n') + 1 : text);
}

/* The pattern goes to bgolly, takes steps there, and comes back as the crystal that took them here. */
static void bgolly_sees_the_same_crystal(void **state)
{
    (void)state;
    if (system("bgolly --help >/dev/null 2>&1") == -1 || system("command -v bgolly >/dev/null 2>&1") != 0) {
        print_message("skipped: bgolly is not installed (Debian: golly)\n");
        skip();
    }
    static const char *const rules[] = {"0100000", "0101010", "0110100", "0101101", "B1/S0123456H:T20,13",
                                        "B135/S0123456H:T17,24", "B14/S0123456H:P20,13", "B2/S0123456H:P15,16"};
    char folder[] = "/tmp/snow-rle-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char in[64], out[64], command[256];
    snprintf(in, sizeof in, "%s/in.rle", folder);
    snprintf(out, sizeof out, "%s/out.rle", folder);
    for (size_t i = 0; i < COUNT_OF(rules); i++) {
        snow_packard_params params = packard_scene(rules[i]);
        params.scatter = 4;
        params.scatter_side = 6;
        params.random_seed = i;
        snow_grid *grid = make_packard(&params, NULL);
        char *text = save_pattern(grid);
        FILE *file = fopen(in, "wb");
        assert_non_null(file);
        fputs(text, file);
        fclose(file);
        snprintf(command, sizeof command, "bgolly -m 25 -o %s %s >/dev/null 2>&1", out, in);
        assert_int_equal(0, system(command));
        assert_ok(snow_step(grid, 25));
        free(text);
        text = save_pattern(grid);
        snow_grid *ours = load_centred(text);
        snow_grid *theirs = load_centred(read_file(out));
        assert_same_crystals(ours, theirs);
        assert_int_equal(frozen_of(grid), frozen_of(theirs));
        free(text);
        snow_destroy(grid);
        snow_destroy(ours);
        snow_destroy(theirs);
    }
    remove(in);
    remove(out);
    remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_small_crystal_is_written_as_it_should_be),
        cmocka_unit_test(what_is_written_is_read_back),
        cmocka_unit_test(lines_are_short),
        cmocka_unit_test(patterns_of_others_are_read),
        cmocka_unit_test(the_header_wins_over_the_parameters),
        cmocka_unit_test(wrong_patterns_are_refused),
        cmocka_unit_test(large_patterns_keep_to_the_memory_limit),
        cmocka_unit_test(any_bytes_are_survived),
        cmocka_unit_test(callbacks_serve_as_well_as_memory),
        cmocka_unit_test(bgolly_sees_the_same_crystal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
