/* Packard's model: rules as text, parameters, and what each call answers to nonsense. */
#include "support/packard.h"

#include <string.h>

static void check_rule(const char *text, uint32_t expected)
{
    snow_packard_params params;
    snow_packard_params_init(&params, sizeof params);
    params.rule = 77;
    assert_ok(snow_packard_params_rule(&params, text));
    assert_int_equal(expected, params.rule);
    assert_int_equal(SNOW_PACKARD_PLANE, params.domain);
}

static void rules_are_read_in_all_spellings(void **state)
{
    (void)state;
    static const char *const parity[] = {"0101010",          " 0101010\n",       "B135/S0123456H", "b135/s0123456h",
                                         "B135S0123456H",    "0123456/135H",     "b531/S6543210h", "S0123456/B135H",
                                         "\tB135/S0123456H "};
    for (size_t i = 0; i < COUNT_OF(parity); i++)
        check_rule(parity[i], 0x2A);
    check_rule("0000000", 0);
    check_rule("1000001", 0x41);
    check_rule("B/S0123456H", 0);
    check_rule("B06/S0123456H", 0x41);
    check_rule("B0123456/S0123456H", 0x7F);
}

static void every_rule_survives_both_notations(void **state)
{
    (void)state;
    for (uint32_t rule = 0; rule < 128; rule++) {
        for (int notation = SNOW_PACKARD_DIGITS; notation <= SNOW_PACKARD_BIRTHS; notation++) {
            char text[SNOW_PACKARD_RULE_SIZE];
            assert_ok(snow_packard_rule_text(rule, (snow_packard_notation)notation, text, sizeof text));
            check_rule(text, rule);
        }
    }
    char text[SNOW_PACKARD_RULE_SIZE];
    assert_ok(snow_packard_rule_text(0x2A, SNOW_PACKARD_DIGITS, text, 8));
    assert_string_equal("0101010", text);
    assert_ok(snow_packard_rule_text(0x2A, SNOW_PACKARD_BIRTHS, text, 15));
    assert_string_equal("B135/S0123456H", text);
}

static void universes_are_read(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("B1/S0123456H:T20,13");
    assert_int_equal(SNOW_PACKARD_TORUS, params.domain);
    assert_int_equal(20, params.width);
    assert_int_equal(13, params.height);
    params = packard_scene("b1s0123456h:p7");
    assert_int_equal(SNOW_PACKARD_RHOMBUS, params.domain);
    assert_int_equal(7, params.width);
    assert_int_equal(7, params.height);
}

static void wrong_rules_are_told_apart(void **state)
{
    (void)state;
    static const struct {
        snow_status status;
        const char *text;
    } wrong[] = {
        {SNOW_ERROR_PACKARD_RULE, ""},
        {SNOW_ERROR_PACKARD_RULE, "   "},
        {SNOW_ERROR_PACKARD_RULE, "parity"},
        {SNOW_ERROR_PACKARD_RULE, "01010x0"},
        {SNOW_ERROR_PACKARD_RULE, "B135/S0123456HH"},
        {SNOW_ERROR_PACKARD_RULE, "B135/B0123456H"},
        {SNOW_ERROR_PACKARD_RULE, "S0123456H"},
        {SNOW_ERROR_PACKARD_RULE, "B135 /S0123456H"},
        {SNOW_ERROR_PACKARD_RULE, "-101010"},
        {SNOW_ERROR_PACKARD_RULE, "B1/S0123456H and a text that is much longer than any rule could ever be"},
        {SNOW_ERROR_PACKARD_RULE_LENGTH, "010101"},
        {SNOW_ERROR_PACKARD_RULE_LENGTH, "01010100"},
        {SNOW_ERROR_PACKARD_RULE_DIGIT, "0102010"},
        {SNOW_ERROR_PACKARD_RULE_DIGIT, "B17/S0123456H"},
        {SNOW_ERROR_PACKARD_RULE_DIGIT, "B1/S01234567H"},
        {SNOW_ERROR_PACKARD_RULE_MELTS, "B1H"},
        {SNOW_ERROR_PACKARD_RULE_MELTS, "B1/SH"},
        {SNOW_ERROR_PACKARD_RULE_MELTS, "B2/S34H"},
        {SNOW_ERROR_PACKARD_RULE_MELTS, "B135/S012345H"},
        {SNOW_ERROR_PACKARD_RULE_LATTICE, "B3/S23"},
        {SNOW_ERROR_PACKARD_RULE_LATTICE, "B135/S0123456"},
        {SNOW_ERROR_PACKARD_RULE_LATTICE, "23/3"},
        {SNOW_ERROR_PACKARD_RULE_DOMAIN, "B1/S0123456H:K20,13"},
        {SNOW_ERROR_PACKARD_RULE_DOMAIN, "B1/S0123456H:"},
        {SNOW_ERROR_PACKARD_RULE_DOMAIN, "B1/S0123456H:T20+3,13"},
        {SNOW_ERROR_PACKARD_SIDES, "B1/S0123456H:T0,13"},
        {SNOW_ERROR_PACKARD_SIDES, "B1/S0123456H:T"},
        {SNOW_ERROR_PACKARD_SIDES, "B1/S0123456H:P20,99999999999999999999"},
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        snow_packard_params params = packard_scene("0110000"), before = params;
        snow_status status = snow_packard_params_rule(&params, wrong[i].text);
        if (status != wrong[i].status)
            print_error("rule \"%s\"\n", wrong[i].text);
        assert_status(wrong[i].status, status);
        assert_memory_equal(&before, &params, sizeof params);
    }
}

static void rule_calls_check_their_arguments(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0110000");
    char text[SNOW_PACKARD_RULE_SIZE] = "kept";
    assert_status(SNOW_ERROR_NULL, snow_packard_params_rule(NULL, "0110000"));
    assert_status(SNOW_ERROR_NULL, snow_packard_params_rule(&params, NULL));
    params.struct_size = 0;
    assert_status(SNOW_ERROR_STRUCT_SIZE, snow_packard_params_rule(&params, "0110000"));
    assert_status(SNOW_ERROR_NULL, snow_packard_rule_text(0, SNOW_PACKARD_DIGITS, NULL, 20));
    assert_status(SNOW_ERROR_ENUM, snow_packard_rule_text(0, (snow_packard_notation)3, text, sizeof text));
    assert_status(SNOW_ERROR_RANGE, snow_packard_rule_text(128, SNOW_PACKARD_DIGITS, text, sizeof text));
    assert_status(SNOW_ERROR_BUFFER, snow_packard_rule_text(0x2A, SNOW_PACKARD_DIGITS, text, 7));
    assert_status(SNOW_ERROR_BUFFER, snow_packard_rule_text(0x2A, SNOW_PACKARD_BIRTHS, text, 14));
    assert_string_equal("kept", text);
}

/* Each change of a sound scene, and what it is answered. */
typedef struct wrong_scene {
    snow_status status;
    void (*spoil)(snow_packard_params *params);
} wrong_scene;

#define SPOIL(name, change) \
    static void name(snow_packard_params *params) \
    { \
        change; \
    }
static const snow_cell far_seed[] = {{0, 0}, {9, 9}};
SPOIL(no_size, params->struct_size = 0)
SPOIL(great_rule, params->rule = 128)
SPOIL(birth, params->rule = 1)
SPOIL(half_flag, params->record_freeze_steps = 2)
SPOIL(domain_0, params->domain = (snow_packard_domain)0)
SPOIL(domain_7, params->domain = (snow_packard_domain)7)
SPOIL(engine_4, params->engine = (snow_packard_engine)4)
SPOIL(radius_0, (params->domain = SNOW_PACKARD_DISC, params->radius = 0))
SPOIL(radius_great, (params->domain = SNOW_PACKARD_HEXAGON, params->radius = (1 << 20) + 1))
SPOIL(width_0, (params->domain = SNOW_PACKARD_TORUS, params->width = 0))
SPOIL(height_great, (params->domain = SNOW_PACKARD_RECTANGLE, params->height = (1 << 21) + 1))
SPOIL(lost_seeds, params->seed_count = 1)
SPOIL(far_away, (params->domain = SNOW_PACKARD_DISC, params->radius = 5, params->seeds = far_seed,
                 params->seed_count = 2))
SPOIL(cluster_negative, params->cluster = -1)
SPOIL(cluster_great, params->cluster = 1025)
SPOIL(cluster_and_seeds, (params->cluster = 3, params->seeds = far_seed, params->seed_count = 2))
SPOIL(cluster_outside, (params->domain = SNOW_PACKARD_DISC, params->radius = 2, params->cluster = 50))
SPOIL(scatter_negative, params->scatter = -1)
SPOIL(scatter_and_cluster, (params->scatter = 3, params->cluster = 3))
SPOIL(scatter_side_0, (params->scatter = 3, params->scatter_side = 0))
SPOIL(scatter_dense, (params->scatter = 14, params->scatter_side = 5))
SPOIL(scatter_cut, (params->scatter = 5, params->domain = SNOW_PACKARD_HEXAGON, params->radius = 2))
SPOIL(tree_in_disc, (params->engine = SNOW_PACKARD_ENGINE_QUADTREE, params->domain = SNOW_PACKARD_DISC))
SPOIL(tree_with_dates, (params->engine = SNOW_PACKARD_ENGINE_QUADTREE, params->record_freeze_steps = 1))

static void wrong_scenes_are_refused(void **state)
{
    (void)state;
    static const wrong_scene wrong[] = {
        {SNOW_ERROR_STRUCT_SIZE, no_size},
        {SNOW_ERROR_RANGE, great_rule},
        {SNOW_ERROR_PACKARD_BIRTH, birth},
        {SNOW_ERROR_RANGE, half_flag},
        {SNOW_ERROR_ENUM, domain_0},
        {SNOW_ERROR_ENUM, domain_7},
        {SNOW_ERROR_ENUM, engine_4},
        {SNOW_ERROR_PACKARD_RADIUS, radius_0},
        {SNOW_ERROR_PACKARD_RADIUS, radius_great},
        {SNOW_ERROR_PACKARD_SIDES, width_0},
        {SNOW_ERROR_PACKARD_SIDES, height_great},
        {SNOW_ERROR_NULL, lost_seeds},
        {SNOW_ERROR_PACKARD_SEED, far_away},
        {SNOW_ERROR_PACKARD_CLUSTER, cluster_negative},
        {SNOW_ERROR_PACKARD_CLUSTER, cluster_great},
        {SNOW_ERROR_PACKARD_CLUSTER, cluster_and_seeds},
        {SNOW_ERROR_PACKARD_SEED, cluster_outside},
        {SNOW_ERROR_PACKARD_SCATTER, scatter_negative},
        {SNOW_ERROR_PACKARD_SCATTER, scatter_and_cluster},
        {SNOW_ERROR_PACKARD_SIDES, scatter_side_0},
        {SNOW_ERROR_PACKARD_SCATTER, scatter_dense},
        {SNOW_ERROR_PACKARD_SCATTER, scatter_cut},
        {SNOW_ERROR_PACKARD_ENGINE, tree_in_disc},
        {SNOW_ERROR_PACKARD_ENGINE, tree_with_dates},
    };
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        snow_packard_params params = packard_scene("0101010");
        snow_grid *grid = NULL;
        wrong[i].spoil(&params);
        assert_status(wrong[i].status, snow_packard_create(&params, NULL, &grid));
        assert_null(grid);
    }
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = NULL;
    assert_status(SNOW_ERROR_NULL, snow_packard_create(NULL, NULL, &grid));
    assert_status(SNOW_ERROR_NULL, snow_packard_create(&params, NULL, NULL));
}

static void seeds_are_where_they_should_be(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = make_packard(&params, NULL);
    assert_int_equal(1, frozen_of(grid));
    assert_same_double(1, value_at(grid, SNOW_FIELD_FROZEN, 0, 0));
    snow_destroy(grid);

    params.seeds = far_seed;
    params.seed_count = 2;
    grid = make_packard(&params, NULL);
    assert_int_equal(2, frozen_of(grid));
    assert_same_double(1, value_at(grid, SNOW_FIELD_FROZEN, 9, 9));
    snow_destroy(grid);

    params.seed_count = 0;
    grid = make_packard(&params, NULL);
    assert_int_equal(0, frozen_of(grid));
    assert_same_double(0, tip_of(grid));
    assert_ok(snow_step(grid, 1000));
    assert_int_equal(0, frozen_of(grid));
    snow_rect bounds;
    assert_ok(snow_frozen_bounds(grid, &bounds));
    assert_int_equal(0, bounds.width);
    snow_destroy(grid);
}

static void random_seeds_are_reproducible(void **state)
{
    (void)state;
    uint64_t digests[2][2];
    for (int seed = 0; seed < 2; seed++) {
        snow_packard_params params = packard_scene("0101010");
        params.random_seed = (uint64_t)seed;
        params.cluster = 9;
        snow_grid *grid = make_packard(&params, NULL);
        assert_in_range(frozen_of(grid), 20, 61);
        digests[seed][0] = digest_of(grid);
        snow_destroy(grid);
        params.cluster = 0;
        params.scatter = 200;
        params.scatter_side = 31;
        grid = make_packard(&params, NULL);
        assert_int_equal(200, frozen_of(grid));
        snow_rect bounds;
        assert_ok(snow_frozen_bounds(grid, &bounds));
        assert_true(bounds.q >= -15 && bounds.q + bounds.width <= 16 && bounds.r >= -15 &&
                    bounds.r + bounds.height <= 16);
        digests[seed][1] = digest_of(grid);
        snow_grid *again = make_packard(&params, NULL);
        assert_true(digests[seed][1] == digest_of(again));
        snow_destroy(grid);
        snow_destroy(again);
    }
    assert_true(digests[0][0] != digests[1][0]);
    assert_true(digests[0][1] != digests[1][1]);
}

static void names_are_known(void **state)
{
    (void)state;
    assert_string_equal("auto", snow_packard_engine_name(SNOW_PACKARD_ENGINE_AUTO));
    assert_string_equal("reference", snow_packard_engine_name(SNOW_PACKARD_ENGINE_REFERENCE));
    assert_string_equal("tiles", snow_packard_engine_name(SNOW_PACKARD_ENGINE_TILES));
    assert_string_equal("quadtree", snow_packard_engine_name(SNOW_PACKARD_ENGINE_QUADTREE));
    assert_null(snow_packard_engine_name((snow_packard_engine)9));
    snow_packard_params params = packard_scene("0110100");
    snow_grid *grid = make_packard(&params, NULL);
    snow_model model = (snow_model)0;
    uint32_t rule = 0;
    assert_ok(snow_model_of(grid, &model));
    assert_int_equal(SNOW_MODEL_PACKARD, model);
    assert_ok(snow_packard_rule_of(grid, &rule));
    assert_int_equal(0x16, rule);
    snow_destroy(grid);
}

static void other_models_and_null_are_refused(void **state)
{
    (void)state;
    snow_reiter_params reiter = disc_scene(0.4, 0.01, 1, 5);
    snow_grid *other = make_grid(&reiter, NULL);
    snow_packard_params params = packard_scene("0101010");
    snow_grid *grid = make_packard(&params, NULL);
    snow_packard_zone zone = packard_zone_of(SNOW_PACKARD_RESTRICTION, SNOW_PACKARD_SIDES, 1, 2);
    uint32_t rule;
    uint64_t high, low, words[4];
    size_t size;
    snow_packard_engine engine;
    snow_reiter_conditions conditions;
    snow_reiter_conditions_init(&conditions, sizeof conditions);
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_rule_of(other, &rule));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_engine_of(other, &engine));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_population(other, &high, &low));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_add_zone(other, &zone));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_copy_bits(other, 0, 0, 1, 1, words, 4));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_packard_save_rle(other, NULL, 0, &size));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_reiter_change(grid, &conditions));
    assert_status(SNOW_ERROR_UNSUPPORTED, snow_reiter_conditions_of(grid, &conditions));
    assert_status(SNOW_ERROR_NULL, snow_packard_rule_of(NULL, &rule));
    assert_status(SNOW_ERROR_NULL, snow_packard_rule_of(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_engine_of(NULL, &engine));
    assert_status(SNOW_ERROR_NULL, snow_packard_engine_of(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_population(NULL, &high, &low));
    assert_status(SNOW_ERROR_NULL, snow_packard_population(grid, NULL, &low));
    assert_status(SNOW_ERROR_NULL, snow_packard_population(grid, &high, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_add_zone(NULL, &zone));
    assert_status(SNOW_ERROR_NULL, snow_packard_add_zone(grid, NULL));
    assert_status(SNOW_ERROR_NULL, snow_packard_copy_bits(NULL, 0, 0, 1, 1, words, 4));
    assert_status(SNOW_ERROR_NULL, snow_packard_copy_bits(grid, 0, 0, 1, 1, NULL, 4));
    snow_destroy(other);
    snow_destroy(grid);
}

/* However little of the rhombus belongs to the interior, its cells are found soon. */
static void a_scatter_over_a_small_interior_takes_no_time(void **state)
{
    (void)state;
    snow_packard_params params = packard_scene("0100000");
    params.scatter_side = 1 << 21;
    for (int domain = SNOW_PACKARD_DISC; domain <= SNOW_PACKARD_TORUS; domain++) {
        params.domain = (snow_packard_domain)domain;
        params.radius = 3;
        params.width = 2;
        params.height = 9;
        params.scatter = 9;
        snow_grid *grid = make_packard(&params, NULL);
        assert_int_equal(9, frozen_of(grid));
        snow_destroy(grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_are_read_in_all_spellings),
        cmocka_unit_test(every_rule_survives_both_notations),
        cmocka_unit_test(universes_are_read),
        cmocka_unit_test(wrong_rules_are_told_apart),
        cmocka_unit_test(rule_calls_check_their_arguments),
        cmocka_unit_test(wrong_scenes_are_refused),
        cmocka_unit_test(seeds_are_where_they_should_be),
        cmocka_unit_test(random_seeds_are_reproducible),
        cmocka_unit_test(a_scatter_over_a_small_interior_takes_no_time),
        cmocka_unit_test(names_are_known),
        cmocka_unit_test(other_models_and_null_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
