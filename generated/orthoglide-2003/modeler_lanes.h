/* Arithmetic of vectors whose lanes are samples, for the version that modeler_versions.h is at.
 *
 * Vectors of gcc and clang have + - * / and comparisons; here is the rest. Where MODELER_WIDTH is 1
 * a vector is one double, and all is plain C. Every version has its own: types and functions have
 * no guard, names do.
 */
#ifndef MODELER_LANES_H
#define MODELER_LANES_H

#include <math.h>

#include "modeler_sincos.h"
#include "modeler_tile.h"

#define modeler_lanes MODELER_VERSION(modeler_lanes)
#define modeler_bits MODELER_VERSION(modeler_bits)
#define modeler_pair MODELER_VERSION(modeler_pair)
#define modeler_loose MODELER_VERSION(modeler_loose)
#define modeler_lanes_spread MODELER_VERSION(modeler_lanes_spread)
#define modeler_lanes_sincos MODELER_VERSION(modeler_lanes_sincos)
#define modeler_lanes_sign MODELER_VERSION(modeler_lanes_sign)
#define modeler_lanes_fabs MODELER_VERSION(modeler_lanes_fabs)
#define modeler_lanes_sin MODELER_VERSION(modeler_lanes_sin)
#define modeler_lanes_cos MODELER_VERSION(modeler_lanes_cos)
#define modeler_lanes_tan MODELER_VERSION(modeler_lanes_tan)
#define modeler_lanes_sqrt MODELER_VERSION(modeler_lanes_sqrt)
#define modeler_lanes_exp MODELER_VERSION(modeler_lanes_exp)
#define modeler_lanes_tanh MODELER_VERSION(modeler_lanes_tanh)
#define modeler_lanes_pow MODELER_VERSION(modeler_lanes_pow)

/* Where entry k goes; `values` is that of the first lane. */
#define MODELER_PUT(k) (*(modeler_lanes *)(void *)(values + (k)*MODELER_LANES))

/* Entry i of MODELER_WIDTH rows of n > 1; and rows of one. Two neighbours come with one load. */
#define MODELER_ROWS(x, n, i) MODELER_JOIN(MODELER_ROWS_, MODELER_WIDTH)(x, n, i)
#define MODELER_ROWS_1(x, n, i) (x)[i]
#define MODELER_ROWS_OF_ONE(x) (*(const modeler_loose *)(x))

#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define MODELER_LOW(n, i) ((n) % 2 != 0 && (i) == (n) - 1 ? (i) - 1 : (i) - (i) % 2)
#define MODELER_HIGH(n, i) ((i) - MODELER_LOW(n, i))
#define MODELER_TWO(x, n, i, row) (*(const modeler_pair *)((x) + (row)*(n) + MODELER_LOW(n, i)))
#define MODELER_FOUR(x, n, i, row) __builtin_shufflevector( \
    MODELER_TWO(x, n, i, row), MODELER_TWO(x, n, i, (row) + 2), 0, 1, 2, 3)
#define MODELER_EIGHT(x, n, i, row) __builtin_shufflevector( \
    MODELER_FOUR(x, n, i, row), MODELER_FOUR(x, n, i, (row) + 4), 0, 1, 2, 3, 4, 5, 6, 7)
#define MODELER_ROWS_2(x, n, i) __builtin_shufflevector( \
    MODELER_TWO(x, n, i, 0), MODELER_TWO(x, n, i, 1), MODELER_HIGH(n, i), 2 + MODELER_HIGH(n, i))
#define MODELER_ROWS_4(x, n, i) __builtin_shufflevector( \
    MODELER_FOUR(x, n, i, 0), MODELER_FOUR(x, n, i, 1), MODELER_HIGH(n, i), \
    4 + MODELER_HIGH(n, i), 2 + MODELER_HIGH(n, i), 6 + MODELER_HIGH(n, i))
#define MODELER_ROWS_8(x, n, i) __builtin_shufflevector( \
    MODELER_EIGHT(x, n, i, 0), MODELER_EIGHT(x, n, i, 1), MODELER_HIGH(n, i), \
    8 + MODELER_HIGH(n, i), 2 + MODELER_HIGH(n, i), 10 + MODELER_HIGH(n, i), \
    4 + MODELER_HIGH(n, i), 12 + MODELER_HIGH(n, i), 6 + MODELER_HIGH(n, i), \
    14 + MODELER_HIGH(n, i))
#else
#define MODELER_ROWS_2(x, n, i) ((modeler_lanes){(x)[i], (x)[(n) + (i)]})
#define MODELER_ROWS_4(x, n, i) ((modeler_lanes){ \
    (x)[i], (x)[(n) + (i)], (x)[2*(n) + (i)], (x)[3*(n) + (i)]})
#define MODELER_ROWS_8(x, n, i) ((modeler_lanes){ \
    (x)[i], (x)[(n) + (i)], (x)[2*(n) + (i)], (x)[3*(n) + (i)], \
    (x)[4*(n) + (i)], (x)[5*(n) + (i)], (x)[6*(n) + (i)], (x)[7*(n) + (i)]})
#endif

/* Whether every lane of x is less than a bound. */
#define MODELER_ALL_LESS(x, bound) MODELER_JOIN(MODELER_ALL_LESS_, MODELER_WIDTH)(x, bound)
#define MODELER_ALL_LESS_1(x, bound) ((x) < (bound))
#define MODELER_ALL_LESS_2(x, bound) ((x)[0] < (bound) && (x)[1] < (bound))
#define MODELER_ALL_LESS_4(x, bound) \
    (__builtin_ia32_movmskpd256((modeler_lanes)((x) < (bound))) == 15)
#define MODELER_ALL_LESS_8(x, bound) /* 21: not less, quiet; 4: the rounding that is set */ \
    (__builtin_ia32_cmppd512_mask(x, modeler_lanes_spread(bound), 21, (unsigned char)255, 4) == 0)

#ifdef __GNUC__
#define MODELER_INLINE static inline __attribute__((always_inline, unused)) MODELER_TARGET
#define MODELER_SELDOM static __attribute__((noinline, cold, unused))
#else
#define MODELER_INLINE static inline
#define MODELER_SELDOM static
#endif

/* A function of <math.h>, one lane after another. */
#define MODELER_EACH_LANE(function) \
    MODELER_INLINE modeler_lanes MODELER_VERSION(modeler_lanes_##function)(modeler_lanes x) \
    { \
        for (int i = 0; i < MODELER_WIDTH; i++) { \
            x[i] = function(x[i]); \
        } \
        return x; \
    }

/* Sines and cosines of the lanes that modeler_lanes_sincos leaves out. */
MODELER_SELDOM void modeler_far_sincos(int lanes, const double *x, double *sines, double *cosines)
{
    for (int i = 0; i < lanes; i++) {
        if (!(x[i]*x[i] < 1e10)) {
            modeler_sincos(x[i], sines + i, cosines + i);
        }
    }
}

#endif

#if MODELER_WIDTH == 1

typedef double modeler_lanes;
typedef double modeler_loose;

MODELER_INLINE double modeler_lanes_spread(double x) { return x; }
MODELER_INLINE double modeler_lanes_fabs(double x) { return fabs(x); }
MODELER_INLINE double modeler_lanes_sin(double x) { return sin(x); }
MODELER_INLINE double modeler_lanes_cos(double x) { return cos(x); }
MODELER_INLINE double modeler_lanes_tan(double x) { return tan(x); }
MODELER_INLINE double modeler_lanes_sqrt(double x) { return sqrt(x); }
MODELER_INLINE double modeler_lanes_exp(double x) { return exp(x); }
MODELER_INLINE double modeler_lanes_tanh(double x) { return tanh(x); }
MODELER_INLINE double modeler_lanes_pow(double x, double y) { return pow(x, y); }

MODELER_INLINE double modeler_lanes_sign(double x)
{
    return modeler_sign(x);
}

MODELER_INLINE void modeler_lanes_sincos(double x, double *sine, double *cosine)
{
    modeler_sincos(x, sine, cosine);
}

#else

typedef double modeler_lanes __attribute__((vector_size(8*MODELER_WIDTH), may_alias));
typedef long long modeler_bits __attribute__((vector_size(8*MODELER_WIDTH), may_alias));
typedef double modeler_pair __attribute__((vector_size(16), aligned(8), may_alias));
typedef double modeler_loose __attribute__((vector_size(8*MODELER_WIDTH), aligned(8), may_alias));

MODELER_EACH_LANE(sin)
MODELER_EACH_LANE(cos)
MODELER_EACH_LANE(tan)
MODELER_EACH_LANE(sqrt)
MODELER_EACH_LANE(exp)
MODELER_EACH_LANE(tanh)

MODELER_INLINE modeler_lanes modeler_lanes_pow(modeler_lanes x, modeler_lanes y)
{
    for (int i = 0; i < MODELER_WIDTH; i++) {
        x[i] = pow(x[i], y[i]);
    }
    return x;
}

MODELER_INLINE modeler_lanes modeler_lanes_spread(double x)
{
    const modeler_lanes zero = {0.0};

    return x - zero; /* changes nothing, not even -0.0 */
}

MODELER_INLINE modeler_lanes modeler_lanes_fabs(modeler_lanes x)
{
    const modeler_lanes minus = modeler_lanes_spread(-0.0);

    return (modeler_lanes)((modeler_bits)x & ~(modeler_bits)minus);
}

/* 1 with the sign of x, where |x| > 0; NaN where x is not finite. A comparison gives all bits or
 * none in each lane. */
MODELER_INLINE modeler_lanes modeler_lanes_sign(modeler_lanes x)
{
    const modeler_bits minus = (modeler_bits)modeler_lanes_spread(-0.0);
    const modeler_bits one = (modeler_bits)modeler_lanes_spread(1.0) | ((modeler_bits)x & minus);

    return (modeler_lanes)(one & (modeler_lanes_fabs(x) > 0.0)) + (x - x);
}

/* Method, bounds and coefficients as in modeler_sincos.h, which does the lanes beyond them. */
MODELER_INLINE void modeler_lanes_sincos(modeler_lanes x, modeler_lanes *sine,
                                         modeler_lanes *cosine)
{
    const double PART_1 = 1.57079632673412561417e+00, PART_2 = 6.07710050630396597660e-11;
    const double PART_3 = 2.02226624879595063154e-21, TWO_OVER_PI = 6.36619772367581382433e-01;
    const double WHOLE = 6755399441055744.0; /* 1.5*2^52: a sum with it is a whole number */

    const modeler_lanes turned = x*TWO_OVER_PI + WHOLE, n = turned - WHOLE;
    const modeler_lanes r = ((x - n*PART_1) - n*PART_2) - n*PART_3, z = r*r;

    const modeler_lanes s_high = z*(-2.50507602534068634195e-08 + z*1.58969099521155010221e-10);
    const modeler_lanes s_low = 8.33333333332248946124e-03 +
        z*(-1.98412698298579493134e-04 + z*(2.75573137070700676789e-06 + s_high));
    const modeler_lanes s = r + r*z*(-1.66666666666666324348e-01 + z*s_low);

    const modeler_lanes c_high = z*(2.08757232129817482790e-09 - z*1.13596475577881948265e-11);
    const modeler_lanes c_low = z*(4.16666666666666019037e-02 +
        z*(-1.38888888888741095749e-03 +
           z*(2.48015872894767294178e-05 + z*(-2.75573143513906633035e-07 + c_high))));
    const modeler_lanes half = 0.5*z, w = 1.0 - half;
    const modeler_lanes c = w + (((1.0 - w) - half) + z*c_low);

    /* Turn by n quarters: an odd one swaps the two, the next bit turns the sign. */
    const modeler_bits k = (modeler_bits)turned, odd = k << 63 >> 63, turn = k >> 1 << 63;
    const modeler_bits S = (modeler_bits)s, C = (modeler_bits)c, both = S ^ C;
    const modeler_bits minus = (modeler_bits)modeler_lanes_spread(-0.0);
    *sine = (modeler_lanes)(S ^ (both & odd) ^ turn);
    *cosine = (modeler_lanes)(C ^ ((both ^ minus) & odd) ^ turn);

    if (!MODELER_ALL_LESS(x*x, 1e10)) {
        modeler_lanes given = x, sines = *sine, cosines = *cosine;
        modeler_far_sincos(MODELER_WIDTH, (const double *)&given, (double *)&sines,
                           (double *)&cosines);
        *sine = sines;
        *cosine = cosines;
    }
}

#endif
