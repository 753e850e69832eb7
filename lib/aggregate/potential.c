#include "aggregate/potential.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const double euler = 0.57721566490153286061;

enum { NODES = 192 };

/* Of Gauss and Legendre's rule on [0, 1], the node with this number. */
static void find_node(int number, double *node, double *weight)
{
    double x = cos(pi * (number + 0.75) / (NODES + 0.5));
    double slope = 1;
    for (int round = 0; round < 6; round++) { /* Newton */
        double before = 1;
        double value = x;
        for (int k = 2; k <= NODES; k++) {
            double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
            before = value;
            value = next;
        }
        slope = NODES * (x * value - before) / (x * x - 1);
        x -= value / slope;
    }
    *node = (1 + x) / 2;
    *weight = 1 / ((1 - x * x) * slope * slope);
}

/* A wave along one axis of the lattice that decays along the other one. */
typedef struct wave {
    double angle; /* a step across */
    double decay; /* a step along */
    double weight;
} wave;

/* One axis of the lattice's Fourier integral is done in closed form: cosh(decay) = 2 - cos(angle). */
static wave square_wave(double node, double weight)
{
    double angle = pi * node;
    double half = sin(angle / 2);
    double excess = 2 * half * half;
    double sine = sqrt(excess * (excess + 2));
    return (wave){angle, log1p(excess + sine), 2 * weight / sine};
}

/* The same with rows of sites half a spacing apart: a step across is half a spacing. */
static wave hexagonal_wave(double node, double weight)
{
    double angle = pi / 2 * node;
    double half = sin(angle / 2);
    double cosine = cos(angle);
    double next = 2 * cosine / 3;                         /* the weight of the next rows */
    double excess = 4.0 / 3 * half * half * (2 + cosine); /* that of the row, less this */
    double root = sqrt(excess * (excess + 2 * next));
    return (wave){angle, log1p((excess + root) / next), weight / root};
}

static size_t index_of(int32_t along, int32_t across)
{
    return (size_t)along * ((size_t)along + 1) / 2 + (size_t)across;
}

/* 1 - e^(-decay along) cos(angle across), without loss where it is small. */
static void add_wave(double *near, int32_t reach, wave one)
{
    double versine[SNOW_POTENTIAL_REACH];
    for (int32_t across = 0; across < reach; across++) {
        double half = sin(one.angle * across / 2);
        versine[across] = 2 * half * half;
    }
    for (int32_t along = 0; along < reach; along++) {
        double lost = -expm1(-one.decay * along);
        for (int32_t across = 0; across <= along; across++)
            near[index_of(along, across)] += one.weight * (lost + (1 - lost) * versine[across]);
    }
}

static void fill_plane(double *near, int32_t reach, snow_aggregate_lattice lattice)
{
    for (int number = 0; number < NODES; number++) {
        double node;
        double weight;
        find_node(number, &node, &weight);
        add_wave(near, reach, lattice == SNOW_AGGREGATE_SQUARE ? square_wave(node, weight)
                                                               : hexagonal_wave(node, weight));
    }
}

snow_status snow_potential_start(snow_potential *potential, snow_heap *heap, snow_aggregate_lattice lattice,
                                 int64_t extent)
{
    int32_t reach = extent < SNOW_POTENTIAL_REACH ? (int32_t)extent + 1 : SNOW_POTENTIAL_REACH;
    size_t side = (size_t)reach;
    bool space = lattice == SNOW_AGGREGATE_CUBIC;
    size_t count = space ? side * (side + 1) * (side + 2) / 6 : side * (side + 1) / 2;
    *potential = (snow_potential){lattice, reach, snow_heap_get(heap, count, sizeof *potential->near)};
    if (potential->near == NULL)
        return heap->refusal;
    if (space)
        snow_potential_fill_space(potential->near, reach);
    else
        fill_plane(potential->near, reach, lattice);
    return SNOW_OK;
}

void snow_potential_end(snow_potential *potential, snow_heap *heap)
{
    snow_heap_put(heap, potential->near);
    potential->near = NULL;
}

/* cos(n phi), n = 1 ... 4, from cos(phi), by Chebyshev's polynomials. */
static void multiples(double cosine, double list[5])
{
    list[0] = 1;
    list[1] = cosine;
    for (int n = 2; n < 5; n++)
        list[n] = 2 * cosine * list[n - 1] - list[n - 2];
}

/* Asymptotic series of the Fourier integral: the lattice's symbol expanded about the origin, term by
   term. The harmonic terms, which the equation leaves free, were fitted to the integral at 40 digits. */
static double far_square(double x, double y)
{
    double square = x * x + y * y;
    double diagonal = 2 * x * y / square;
    double cosine[5];
    multiples(1 - 2 * diagonal * diagonal, cosine); /* of 4 phi */
    double u = 1 / square;
    double series = u * (-cosine[1] / 12 +
                         u * (-3.0 / 40 * cosine[1] - 5.0 / 48 * cosine[2] +
                              u * (-51.0 / 112 * cosine[2] - 35.0 / 72 * cosine[3] +
                                   u * (-217.0 / 320 * cosine[2] - 45.0 / 8 * cosine[3] -
                                        1925.0 / 384 * cosine[4]))));
    return 2 / pi * (log(square) / 2 + euler + 1.5 * log(2.0) + series);
}

static double far_hexagonal(double along, double across)
{
    double square = (3 * along * along + across * across) / 4;
    double sixth = 0.75 * along * along / square; /* the square of the sine of phi */
    double cosine[5];
    multiples(1 - 2 * sixth * (3 - 4 * sixth) * (3 - 4 * sixth), cosine); /* of 6 phi */
    double u = 1 / square;
    double series = u * u * (-cosine[1] / 30 + u * (-5.0 / 84 * cosine[1] + u * (-7.0 / 20) * cosine[2]));
    return sqrt(3.0) / pi * (log(square) / 2 + euler + log(12.0) / 2 + series);
}

static int32_t greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t size_of(int32_t x)
{
    return x < 0 ? -x : x;
}

double snow_potential_at(const snow_potential *potential, int32_t x, int32_t y, int32_t z)
{
    int32_t a = size_of(x);
    int32_t b = size_of(y);
    int32_t c = size_of(potential->lattice == SNOW_AGGREGATE_HEXAGONAL ? x + y : z);
    int32_t most = greater(greater(a, b), c);
    int32_t least = lesser(lesser(a, b), c);
    bool near = most < potential->reach;
    if (potential->lattice == SNOW_AGGREGATE_SQUARE)
        return near ? potential->near[index_of(most, lesser(a, b))] : far_square(a, b);
    if (potential->lattice == SNOW_AGGREGATE_HEXAGONAL) /* in the sector where the row is the greatest of the three */
        return near ? potential->near[index_of(most, most - 2 * least)] : far_hexagonal(most, most - 2 * least);
    if (!near)
        return snow_potential_far_space(a, b, c);
    size_t side = (size_t)most;
    return potential->near[side * (side + 1) * (side + 2) / 6 + index_of(a + b + c - most - least, least)];
}
