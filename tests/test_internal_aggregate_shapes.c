/* What grows from one seed: the shapes of three and four particles, and the mean square radius of gyration up to
   six, against their exact values; many small clusters with the same tables. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "aggregate/growth.h"

enum { MOST_PARTICLES = 6, SHAPES = 5 };

/* N^2 Rg^2, the sum of the squared distances of all pairs, tells the shapes of three and four particles apart. */
typedef struct known_growth {
    snow_aggregate_lattice lattice;
    snow_aggregate_contact contact;
    int clusters;
    struct {
        int moment;
        double chance;
    } three[SHAPES], four[SHAPES];
    double gyration[MOST_PARTICLES + 1]; /* E[Rg^2] at N; 0: not known */
} known_growth;

static const known_growth known[] = {
    {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ARRIVAL, 10000,
     {{6, 0.427312510911622}, {4, 0.572687489088378}},
     {{14, 0.426493957501305}, {11, 0.204300930947211}, {20, 0.162796244424176}, {12, 0.151779438273735},
      {8, 0.0546294288535738}},
     {0, 0, 0, 0.53940278020258, 0.85828370150216, 1.1988019482099, 1.5561331460634}},
    {SNOW_AGGREGATE_SQUARE, SNOW_AGGREGATE_ENTRY, 10000,
     {{6, 0.363380227632419}, {4, 0.636619772367581}},
     {{14, 0.364380394927638}, {11, 0.247659629678292}, {12, 0.171813631107221}, {20, 0.108126251198436},
      {8, 0.108020093088413}},
     {0, 0, 0, 0.52519560614054, 0.80712692483818, 1.0933962178705, 1.3829939553443}},
    {SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ARRIVAL, 8000,
     {{6, 0.29043810541999}, {5, 0.551596703723016}, {3, 0.157965190856994}},
     {{0, 0}},
     {0, 0, 0, 0.55272308041178, 0.8888178222097, 1.2486634892227, 0}},
    {SNOW_AGGREGATE_HEXAGONAL, SNOW_AGGREGATE_ENTRY, 8000,
     {{6, 0.230675542489749}, {5, 0.435991124176917}, {3, 1.0 / 3}},
     {{0, 0}},
     {0, 0, 0, 0.50711209731368, 0.76916764045811, 1.0347940017776, 0}},
};

typedef struct cluster {
    snow_aggregate_lattice lattice;
    snow_site site[MOST_PARTICLES];
    int particles;
    int moment[MOST_PARTICLES + 1]; /* at each mass */
} cluster;

static int square_between(snow_aggregate_lattice lattice, snow_site a, snow_site b)
{
    int x = a.x - b.x;
    int y = a.y - b.y;
    return x * x + y * y + (lattice == SNOW_AGGREGATE_HEXAGONAL ? x * y : 0);
}

static void add(cluster *self, snow_site site)
{
    int moment = self->moment[self->particles];
    for (int i = 0; i < self->particles; i++)
        moment += square_between(self->lattice, site, self->site[i]);
    self->site[self->particles++] = site;
    self->moment[self->particles] = moment;
}

static bool arrives(void *context, snow_site site, bool filled)
{
    assert_true(filled);
    add(context, site);
    return true;
}

typedef struct counts {
    int three[SHAPES], four[SHAPES];
    double sum[MOST_PARTICLES + 1];
    double squares[MOST_PARTICLES + 1];
} counts;

static void count_cluster(const known_growth *law, const cluster *grown, counts *counted)
{
    for (int shape = 0; shape < SHAPES; shape++) {
        counted->three[shape] += grown->moment[3] == law->three[shape].moment;
        counted->four[shape] += grown->moment[4] == law->four[shape].moment;
    }
    for (int mass = 3; mass <= MOST_PARTICLES; mass++) {
        double square = (double)grown->moment[mass] / (mass * mass);
        counted->sum[mass] += square;
        counted->squares[mass] += square * square;
    }
}

/* So far from the truth comes one in 150,000 right numbers. */
static const double deviations = 4.5;

static void check_share(double chance, int got, int clusters)
{
    if (chance > 0)
        assert_true(fabs(got - clusters * chance) <= deviations * sqrt(clusters * chance * (1 - chance)));
}

static void check(const known_growth *law, const counts *counted)
{
    for (int shape = 0; shape < SHAPES; shape++) {
        check_share(law->three[shape].chance, counted->three[shape], law->clusters);
        check_share(law->four[shape].chance, counted->four[shape], law->clusters);
    }
    for (int mass = 3; mass <= MOST_PARTICLES; mass++) {
        double mean = counted->sum[mass] / law->clusters;
        double variance = counted->squares[mass] / law->clusters - mean * mean;
        if (law->gyration[mass] > 0)
            assert_true(fabs(mean - law->gyration[mass]) <= deviations * sqrt(variance / law->clusters));
    }
}

static void grow_many(const known_growth *law, snow_heap *heap)
{
    snow_growth_rules rules = {
        .lattice = law->lattice, .contact = law->contact, .stick = 1, .lid = -1, .isa = SNOW_ISA_BASELINE};
    snow_growth *growth = NULL;
    assert_int_equal(SNOW_OK, snow_growth_start(&growth, heap, &rules));
    const snow_growth_crew crew = {.threads = 1};
    counts counted = {{0}, {0}, {0}, {0}};
    for (int i = 0; i < law->clusters; i++) {
        cluster grown = {.lattice = law->lattice};
        const snow_growth_port port = {.arrives = arrives, .context = &grown};
        uint64_t walker = 0;
        const snow_site seed = {0, 0, 0};
        add(&grown, seed);
        assert_int_equal(SNOW_OK, snow_growth_clear(growth, heap, (uint64_t)i));
        assert_int_equal(SNOW_OK, snow_growth_fill(growth, heap, &seed, 1));
        assert_int_equal(SNOW_OK, snow_growth_run(growth, heap, &crew, MOST_PARTICLES - 1, &walker, &port));
        assert_int_equal(MOST_PARTICLES, grown.particles);
        count_cluster(law, &grown, &counted);
    }
    snow_growth_end(growth, heap);
    check(law, &counted);
}

static void shapes_and_radii_have_their_exact_chances(void **state)
{
    (void)state;
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        grow_many(&known[i], &heap);
    assert_int_equal(0, heap.used);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_and_radii_have_their_exact_chances)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
