/* The exit laws of empty regions against exact fractions, blurred circles, and the kernels against known values and their equation. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "aggregate/blur.h"
#include "aggregate/exits.h"
#include "aggregate/potential.h"
#include "aggregate/source.h"

enum { MOST = 64 };

static snow_heap new_heap(void)
{
    snow_options options;
    snow_options_init(&options, sizeof options);
    snow_heap heap;
    snow_heap_start(&heap, &options);
    return heap;
}

static void near(double expected, double got, double tolerance)
{
    if (!(fabs(expected - got) <= tolerance)) {
        print_error("%.17g instead of %.17g\n", got, expected);
        fail();
    }
}

static void squares_are_left_by_exact_fractions(void **state)
{
    (void)state;
    static const double fractions[5][4] = {
        [1] = {1.0 / 4},
        [2] = {1.0 / 8, 1.0 / 16},
        [3] = {1.0 / 13, 3.0 / 52, 3.0 / 104},
        [4] = {15.0 / 272, 13.0 / 272, 9.0 / 272, 9.0 / 544},
    };
    for (int32_t radius = 1; radius <= 4; radius++) {
        double chance[4];
        snow_exits_square(radius, chance);
        for (int32_t x = 0; x < radius; x++)
            near(fractions[radius][x], chance[x], 1e-15);
    }
}

static void hexagons_are_left_by_exact_fractions(void **state)
{
    (void)state;
    static const double fractions[5][4] = {
        [1] = {1.0 / 6},
        [2] = {1.0 / 18, 1.0 / 9},
        [3] = {5.0 / 174, 2.0 / 29, 2.0 / 29},
        [4] = {25.0 / 1362, 21.0 / 454, 38.0 / 681, 21.0 / 454},
    };
    snow_heap heap = new_heap();
    for (int32_t radius = 1; radius <= 4; radius++) {
        double chance[4];
        assert_int_equal(SNOW_OK, snow_exits_hexagonal(radius, chance, &heap));
        for (int32_t t = 0; t < radius; t++)
            near(fractions[radius][t], chance[t], 1e-15);
    }
    assert_int_equal(0, heap.used);
}

static void cubes_are_left_by_exact_fractions(void **state)
{
    (void)state;
    snow_heap heap = new_heap();
    double chance[3];
    assert_int_equal(SNOW_OK, snow_exits_cubic(1, chance, &heap));
    near(1.0 / 6, chance[0], 1e-15);
    assert_int_equal(SNOW_OK, snow_exits_cubic(2, chance, &heap));
    near(5.0 / 102, chance[0], 1e-15);
    near(1.0 / 51, chance[1], 1e-15);
    near(1.0 / 102, chance[2], 1e-15);
    assert_int_equal(0, heap.used);
}

static void laws_add_up_to_one(void **state)
{
    (void)state;
    snow_heap heap = new_heap();
    static double chance[MOST * (MOST + 1) / 2];
    for (int32_t radius = 1; radius <= MOST; radius += radius < 8 ? 1 : 7) {
        snow_exits_square(radius, chance);
        double sum = 4 * chance[0];
        for (int32_t x = 1; x < radius; x++)
            sum += 8 * chance[x];
        near(1, sum, 1e-13);
        assert_int_equal(SNOW_OK, snow_exits_hexagonal(radius, chance, &heap));
        sum = 0;
        for (int32_t t = 0; t < radius; t++)
            sum += 6 * chance[t];
        near(1, sum, 1e-12);
        assert_int_equal(SNOW_OK, snow_exits_cubic(radius, chance, &heap));
        sum = 0;
        for (int32_t a = 0; a < radius; a++)
            for (int32_t b = 0; b <= a; b++)
                sum += (a == 0 ? 6 : b == 0 || b == a ? 24 : 48) * chance[a * (a + 1) / 2 + b];
        near(1, sum, 1e-12);
    }
}

/* The mean of a harmonic function over the exits is its value at the centre, here 0. One step changes both
   x^4 - 6 x^2 y^2 + y^4 and x^2 + y^2 by 1 in the mean, so their difference is harmonic on the lattice. */
static void square_exits_keep_a_harmonic_function(void **state)
{
    (void)state;
    double chance[MOST];
    for (int32_t radius = 2; radius <= MOST; radius *= 2) {
        snow_exits_square(radius, chance);
        double mean = 0;
        for (int32_t x = 0; x < radius; x++) {
            double a = (double)x * x;
            double b = (double)radius * radius;
            mean += (x == 0 ? 4 : 8) * chance[x] * (a * a - 6 * a * b + b * b - (a + b));
        }
        near(0, mean, 1e-12 * pow(radius, 4));
    }
}

/* The mean over a sphere of the density times a polynomial of degree up to 16: Gauss on panels of z, and points evenly
   round the axis. */
static double mean_over_sphere(double radius, double (*polynomial)(double x, double y, double z))
{
    enum { PANELS = 16, POINTS = 32 };
    static const double node[2] = {0.33998104358485626, 0.86113631159405258};
    static const double weight[2] = {0.65214515486254614, 0.34785484513745386};
    const double pi = 3.14159265358979323846;
    double mean = 0;
    for (int i = 0; i < 4 * PANELS; i++) {
        double z = (2 * (i / 4) + 1 + (i % 2 == 0 ? 1 : -1) * node[i / 2 % 2]) / PANELS - 1;
        double across = sqrt(1 - z * z);
        for (int k = 0; k < POINTS; k++) {
            double x = across * cos(2 * pi * k / POINTS);
            double y = across * sin(2 * pi * k / POINTS);
            mean += weight[i / 2 % 2] / (2 * PANELS * POINTS) * snow_source_sphere_density(radius, x, y, z) *
                    polynomial(radius * x, radius * y, radius * z);
        }
    }
    return mean;
}

static double one(double x, double y, double z)
{
    (void)x;
    (void)y;
    (void)z;
    return 1;
}

/* One step changes x^4 + y^4 + z^4 - 3 (x^2 y^2 + ...) and x^2 + y^2 + z^2 by 1 in the mean; the mean over a cell of
   their difference is less by 0.275. */
static double fourth(double x, double y, double z)
{
    double p = x * x;
    double q = y * y;
    double r = z * z;
    return p * p + q * q + r * r - 3 * (p * q + q * r + r * p) - (p + q + r) - 0.275;
}

/* The same of degree 6, but for what does not grow. */
static double sixth(double x, double y, double z)
{
    double p = x * x;
    double q = y * y;
    double r = z * z;
    return p * p * p + q * q * q + r * r * r - 7.5 * (p * p * (q + r) + q * q * (r + p) + r * r * (p + q)) +
           90 * p * q * r - (p + q + r);
}

static void spheres_keep_harmonic_functions(void **state)
{
    (void)state;
    for (double radius = 16; radius <= 256; radius *= 4) {
        near(1, mean_over_sphere(radius, one), 1e-12);
        near(0, mean_over_sphere(radius, fourth), 1e-10 * pow(radius, 4));
        near(0, mean_over_sphere(radius, fourth), 1e-4 * pow(radius, 2));
        near(0, mean_over_sphere(radius, sixth), 1e-12 * pow(radius, 6) + 1e-4 * pow(radius, 2));
    }
}

/* The Fourier transform of the blur: of ten numbers of 4 bits, uniform and independent. */
static double blur_at(double frequency)
{
    const double pi = 3.14159265358979323846;
    double transform = 1;
    for (int part = 0; part < 10; part++) {
        double x = pi * remainder(frequency * snow_blur(UINT64_C(1) << (4 * part)), 1);
        if (fabs(x) > 1e-9)
            transform *= fabs(sin(16 * x) / (16 * sin(x)));
    }
    return transform;
}

static void blurs_are_sums_of_digits(void **state)
{
    (void)state;
    double sum = 0;
    for (int bit = 0; bit < 40; bit++) {
        double part = snow_blur(UINT64_C(1) << bit);
        near(part, snow_blur(UINT64_C(1) << (bit - bit % 4)) * (1 << bit % 4), 0);
        sum += part;
    }
    near(sum, snow_blur(UINT64_MAX), 0);
    near(0, snow_blur(~UINT64_C(0) << 40), 0);
    assert_true(sum > 15 && sum < SNOW_BLUR_WIDTH);
}

/* The lengths of the frequencies of each lattice, and more, are the roots of n and of 4/3 n. What is left of the
   roundings at frequency f, a sum over a circle round the cluster, is less than the transform times f^-3/2. */
static void blurs_hide_the_lattice(void **state)
{
    (void)state;
    assert_true(blur_at(1) < 2e-12);
    assert_true(blur_at(sqrt(4.0 / 3)) < 2e-12);
    for (int n = 1; n < 100000; n++) {
        double frequencies[2] = {sqrt(n), sqrt(n * 4.0 / 3)};
        for (int i = 0; i < 2; i++)
            assert_true(blur_at(frequencies[i]) < 2e-10 * pow(frequencies[i], 1.5));
    }
    assert_true(blur_at(0.1) > 0.3); /* and where it is not small */
}

static void directions_are_those_of_the_angle(void **state)
{
    (void)state;
    const long double quarter = 0.785398163397448309615660845819875721L;
    for (uint64_t i = 0; i < 80000; i++) {
        uint64_t number = i < 16 ? i << 60 | (i % 2 == 0 ? 0 : (UINT64_C(1) << 60) - 1) : i * UINT64_C(0x9E3779B97F4A7C15);
        long double angle = quarter * ((long double)(number >> 40 & 0x1FFFFF) + 0.5L) / 0x200000;
        long double along[2] = {cosl(angle), sinl(angle)};
        bool swaps = number >> 61 & 1;
        snow_vector unit = snow_direction_of(number);
        near((double)along[swaps] * (number >> 63 != 0 ? -1 : 1), unit.x, 4e-15);
        near((double)along[!swaps] * ((number >> 62 & 1) != 0 ? -1 : 1), unit.y, 4e-15);
    }
}

static void kernels_have_their_known_values(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846;
    snow_heap heap = new_heap();
    snow_potential potential;
    assert_int_equal(SNOW_OK, snow_potential_start(&potential, &heap, SNOW_AGGREGATE_SQUARE, 1 << 20));
    near(0, snow_potential_at(&potential, 0, 0, 0), 0);
    near(1, snow_potential_at(&potential, 0, -1, 0), snow_potential_error);
    near(4 / pi, snow_potential_at(&potential, -1, 1, 0), snow_potential_error);
    near(4 - 8 / pi, snow_potential_at(&potential, 2, 0, 0), snow_potential_error);
    near(2.152758080652748, snow_potential_at(&potential, 3, -5, 0), snow_potential_error);
    double diagonal = 0; /* a(n, n) = 4/pi (1 + 1/3 + ... + 1/(2n - 1)), in the table and beyond it */
    for (int32_t n = 1; n <= 300; n++) {
        diagonal += 4 / pi / (2 * n - 1);
        near(diagonal, snow_potential_at(&potential, n, -n, 0), snow_potential_error);
    }
    snow_potential_end(&potential, &heap);

    assert_int_equal(SNOW_OK, snow_potential_start(&potential, &heap, SNOW_AGGREGATE_HEXAGONAL, 1 << 20));
    near(0, snow_potential_at(&potential, 0, 0, 0), 0);
    near(1, snow_potential_at(&potential, 1, -1, 0), snow_potential_error);
    near(6 * sqrt(3.0) / pi - 2, snow_potential_at(&potential, 1, 1, 0), snow_potential_error);
    near(8 - 12 * sqrt(3.0) / pi, snow_potential_at(&potential, -2, 2, 0), snow_potential_error);
    snow_potential_end(&potential, &heap);

    assert_int_equal(SNOW_OK, snow_potential_start(&potential, &heap, SNOW_AGGREGATE_CUBIC, 1 << 20));
    near(1.516386059151978, snow_potential_at(&potential, 0, 0, 0), snow_potential_error);
    near(0.516386059151978, snow_potential_at(&potential, 0, -1, 0), snow_potential_error);
    snow_potential_end(&potential, &heap);
    assert_int_equal(0, heap.used);
}

/* The mean over the neighbours is the value, also where the table ends and the series begins; and each of the
   lattice's symmetries keeps it. */
static void kernels_are_harmonic_everywhere(void **state)
{
    (void)state;
    static const int32_t steps[3][6][3] = {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}},
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}},
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
    };
    snow_heap heap = new_heap();
    for (int lattice = SNOW_AGGREGATE_SQUARE; lattice <= SNOW_AGGREGATE_CUBIC; lattice++) {
        bool space = lattice == SNOW_AGGREGATE_CUBIC;
        int neighbours = lattice == SNOW_AGGREGATE_SQUARE ? 4 : 6;
        snow_potential potential;
        assert_int_equal(SNOW_OK,
                         snow_potential_start(&potential, &heap, (snow_aggregate_lattice)lattice, 1 << 20));
        for (int32_t x = 1; x < 70; x++)
            for (int32_t y = -9; y < 70; y += 3)
                for (int32_t z = space ? -5 : 0; z < (space ? 70 : 1); z += 17) {
                    double mean = 0;
                    for (int i = 0; i < neighbours; i++) {
                        const int32_t *step = steps[lattice - 1][i];
                        mean += snow_potential_at(&potential, x + step[0], y + step[1], z + step[2]) / neighbours;
                    }
                    near(snow_potential_at(&potential, x, y, z), mean, 2 * snow_potential_error);
                    near(snow_potential_at(&potential, x, y, z), snow_potential_at(&potential, -x, -y, -z), 0);
                    near(snow_potential_at(&potential, x, y, z), snow_potential_at(&potential, y, x, z), 0);
                }
        snow_potential_end(&potential, &heap);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_are_left_by_exact_fractions),
        cmocka_unit_test(hexagons_are_left_by_exact_fractions),
        cmocka_unit_test(cubes_are_left_by_exact_fractions),
        cmocka_unit_test(laws_add_up_to_one),
        cmocka_unit_test(square_exits_keep_a_harmonic_function),
        cmocka_unit_test(spheres_keep_harmonic_functions),
        cmocka_unit_test(blurs_are_sums_of_digits),
        cmocka_unit_test(blurs_hide_the_lattice),
        cmocka_unit_test(directions_are_those_of_the_angle),
        cmocka_unit_test(kernels_have_their_known_values),
        cmocka_unit_test(kernels_are_harmonic_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
