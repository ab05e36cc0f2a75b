/* Arithmetic of vectors of floats whose lanes are samples; the version is modeler_versions.h's.
 *
 * Vectors of gcc and clang have + - * / and comparisons; here is the rest. Where MODELER_WIDTH is 1
 * a vector is one float, and all is plain C. Every version has its own: types and functions have
 * no guard, names do.
 */
#ifndef MODELER_LANES_H
#define MODELER_LANES_H

#include <math.h>

#include "modeler_sincos.h"
#include "modeler_tile.h"

#define modeler_lanes MODELER_VERSION(modeler_lanes)
#define modeler_bits MODELER_VERSION(modeler_bits)
#define modeler_quad MODELER_VERSION(modeler_quad)
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

/* A vector of these numbers, as C and as C++ write it. */
#ifdef __cplusplus
#define MODELER_LANES_OF(...) modeler_lanes{__VA_ARGS__}
#else
#define MODELER_LANES_OF(...) ((modeler_lanes){__VA_ARGS__})
#endif

/* Entry i of MODELER_WIDTH rows of n > 1; and rows of one. Four neighbours come with one load, and
 * squares of four are turned in the registers. */
#define MODELER_ROWS(x, n, i) MODELER_JOIN(MODELER_ROWS_, MODELER_WIDTH)(x, n, i)
#define MODELER_ROWS_1(x, n, i) (x)[i]
#define MODELER_ROWS_OF_ONE(x) (*(const modeler_loose *)(x))
#define MODELER_EACH_4(x, n, i) (x)[i], (x)[(n) + (i)], (x)[2*(n) + (i)], (x)[3*(n) + (i)]
#define MODELER_EACH_8(x, n, i) MODELER_EACH_4(x, n, i), MODELER_EACH_4((x) + 4*(n), n, i)
#define MODELER_EACH_16(x, n, i) MODELER_EACH_8(x, n, i), MODELER_EACH_8((x) + 8*(n), n, i)

#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define MODELER_LOW(n, i) ((i) - (i) % 4 > (n) - 4 ? (n) - 4 : (i) - (i) % 4)
#define MODELER_HIGH(n, i) ((i) - MODELER_LOW(n, i))
#define MODELER_SECOND(n, i) (MODELER_HIGH(n, i) / 2 * 2) /* of two pairs of a row */
#define MODELER_ODD(n, i) (MODELER_HIGH(n, i) % 2 * 2)
#define MODELER_QUAD(x, n, i, row) (*(const modeler_quad *)((x) + (row)*(n) + MODELER_LOW(n, i)))
#define MODELER_OCT(x, n, i, row) __builtin_shufflevector( \
    MODELER_QUAD(x, n, i, row), MODELER_QUAD(x, n, i, (row) + 4), 0, 1, 2, 3, 4, 5, 6, 7)
#define MODELER_ALL(x, n, i, row) __builtin_shufflevector( \
    MODELER_OCT(x, n, i, row), MODELER_OCT(x, n, i, (row) + 8), \
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define MODELER_PAIRS_4(a, b, k) __builtin_shufflevector(a, b, k, 4 + (k), 1 + (k), 5 + (k))
#define MODELER_PAIRS_8(a, b, k) __builtin_shufflevector( \
    a, b, k, 8 + (k), 1 + (k), 9 + (k), 4 + (k), 12 + (k), 5 + (k), 13 + (k))
#define MODELER_PAIRS_16(a, b, k) __builtin_shufflevector( \
    a, b, k, 16 + (k), 1 + (k), 17 + (k), 4 + (k), 20 + (k), 5 + (k), 21 + (k), \
    8 + (k), 24 + (k), 9 + (k), 25 + (k), 12 + (k), 28 + (k), 13 + (k), 29 + (k))
#define MODELER_TURNED_4(a, b, k) __builtin_shufflevector(a, b, k, 1 + (k), 4 + (k), 5 + (k))
#define MODELER_TURNED_8(a, b, k) __builtin_shufflevector( \
    a, b, k, 1 + (k), 8 + (k), 9 + (k), 4 + (k), 5 + (k), 12 + (k), 13 + (k))
#define MODELER_TURNED_16(a, b, k) __builtin_shufflevector( \
    a, b, k, 1 + (k), 16 + (k), 17 + (k), 4 + (k), 5 + (k), 20 + (k), 21 + (k), \
    8 + (k), 9 + (k), 24 + (k), 25 + (k), 12 + (k), 13 + (k), 28 + (k), 29 + (k))
#define MODELER_FOUR_ROWS(width, rows, x, n, i) \
    MODELER_TURNED_##width( \
        MODELER_PAIRS_##width(rows(x, n, i, 0), rows(x, n, i, 1), MODELER_SECOND(n, i)), \
        MODELER_PAIRS_##width(rows(x, n, i, 2), rows(x, n, i, 3), MODELER_SECOND(n, i)), \
        MODELER_ODD(n, i))
#define MODELER_ROWS_4(x, n, i) \
    ((n) < 4 ? MODELER_LANES_OF(MODELER_EACH_4(x, n, i)) \
             : (modeler_lanes)MODELER_FOUR_ROWS(4, MODELER_QUAD, x, n, i))
#define MODELER_ROWS_8(x, n, i) \
    ((n) < 4 ? MODELER_LANES_OF(MODELER_EACH_8(x, n, i)) \
             : (modeler_lanes)MODELER_FOUR_ROWS(8, MODELER_OCT, x, n, i))
#define MODELER_ROWS_16(x, n, i) \
    ((n) < 4 ? MODELER_LANES_OF(MODELER_EACH_16(x, n, i)) \
             : (modeler_lanes)MODELER_FOUR_ROWS(16, MODELER_ALL, x, n, i))
#else
#define MODELER_ROWS_4(x, n, i) (MODELER_LANES_OF(MODELER_EACH_4(x, n, i)))
#define MODELER_ROWS_8(x, n, i) (MODELER_LANES_OF(MODELER_EACH_8(x, n, i)))
#define MODELER_ROWS_16(x, n, i) (MODELER_LANES_OF(MODELER_EACH_16(x, n, i)))
#endif

/* Whether every lane of x is less than a bound. */
#define MODELER_ALL_LESS(x, bound) MODELER_JOIN(MODELER_ALL_LESS_, MODELER_WIDTH)(x, bound)
#define MODELER_ALL_LESS_1(x, bound) ((x) < (bound))
#define MODELER_ALL_LESS_4(x, bound) \
    ((x)[0] < (bound) && (x)[1] < (bound) && (x)[2] < (bound) && (x)[3] < (bound))
#define MODELER_ALL_LESS_8(x, bound) \
    (__builtin_ia32_movmskps256((modeler_lanes)((x) < (bound))) == 255)
#define MODELER_ALL_LESS_16(x, bound) /* 21: not less, quiet; 4: the rounding that is set */ \
    (__builtin_ia32_cmpps512_mask(x, modeler_lanes_spread(bound), 21, (unsigned short)65535, 4) \
     == 0)

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
            x[i] = function##f(x[i]); \
        } \
        return x; \
    }

/* Sines and cosines of the lanes that modeler_lanes_sincos leaves out. */
MODELER_SELDOM void modeler_far_sincos(int lanes, const float *x, float *sines, float *cosines)
{
    for (int i = 0; i < lanes; i++) {
        if (!(x[i]*x[i] < 1e10f)) {
            modeler_sincos(x[i], sines + i, cosines + i);
        }
    }
}

#endif

#if MODELER_WIDTH == 1

typedef float modeler_lanes;
typedef float modeler_loose;

MODELER_INLINE float modeler_lanes_spread(float x) { return x; }
MODELER_INLINE float modeler_lanes_fabs(float x) { return fabsf(x); }
MODELER_INLINE float modeler_lanes_sin(float x) { return sinf(x); }
MODELER_INLINE float modeler_lanes_cos(float x) { return cosf(x); }
MODELER_INLINE float modeler_lanes_tan(float x) { return tanf(x); }
MODELER_INLINE float modeler_lanes_sqrt(float x) { return sqrtf(x); }
MODELER_INLINE float modeler_lanes_exp(float x) { return expf(x); }
MODELER_INLINE float modeler_lanes_tanh(float x) { return tanhf(x); }
MODELER_INLINE float modeler_lanes_pow(float x, float y) { return powf(x, y); }

MODELER_INLINE float modeler_lanes_sign(float x)
{
    return modeler_sign(x);
}

MODELER_INLINE void modeler_lanes_sincos(float x, float *sine, float *cosine)
{
    modeler_sincos(x, sine, cosine);
}

#else

typedef float modeler_lanes __attribute__((vector_size(4*MODELER_WIDTH), may_alias));
typedef int modeler_bits __attribute__((vector_size(4*MODELER_WIDTH), may_alias));
typedef float modeler_quad __attribute__((vector_size(16), aligned(4), may_alias));
typedef float modeler_loose __attribute__((vector_size(4*MODELER_WIDTH), aligned(4), may_alias));

MODELER_EACH_LANE(sin)
MODELER_EACH_LANE(cos)
MODELER_EACH_LANE(tan)
MODELER_EACH_LANE(sqrt)
MODELER_EACH_LANE(exp)
MODELER_EACH_LANE(tanh)

MODELER_INLINE modeler_lanes modeler_lanes_pow(modeler_lanes x, modeler_lanes y)
{
    for (int i = 0; i < MODELER_WIDTH; i++) {
        x[i] = powf(x[i], y[i]);
    }
    return x;
}

MODELER_INLINE modeler_lanes modeler_lanes_spread(float x)
{
    const modeler_lanes zero = {0.0f};

    return x - zero; /* changes nothing, not even -0.0 */
}

MODELER_INLINE modeler_lanes modeler_lanes_fabs(modeler_lanes x)
{
    const modeler_lanes minus = modeler_lanes_spread(-0.0f);

    return (modeler_lanes)((modeler_bits)x & ~(modeler_bits)minus);
}

/* 1 with the sign of x, where |x| > 0; NaN where x is not finite. A comparison gives all bits or
 * none in each lane. */
MODELER_INLINE modeler_lanes modeler_lanes_sign(modeler_lanes x)
{
    const modeler_bits minus = (modeler_bits)modeler_lanes_spread(-0.0f);
    const modeler_bits one = (modeler_bits)modeler_lanes_spread(1.0f) | ((modeler_bits)x & minus);

    return (modeler_lanes)(one & (modeler_lanes_fabs(x) > 0.0f)) + (x - x);
}

/* Method, bounds and coefficients as in modeler_sincos.h, which does the lanes beyond them. */
MODELER_INLINE void modeler_lanes_sincos(modeler_lanes x, modeler_lanes *sine,
                                         modeler_lanes *cosine)
{
    const float PART_1 = 1.5703125f, PART_2 = 4.825592041015625e-4f;
    const float PART_3 = 1.26759068e-6f, TWO_OVER_PI = 6.36619772e-1f;
    const float WHOLE = 12582912.0f; /* 1.5*2^23: a sum with it is a whole number */

    const modeler_lanes turned = x*TWO_OVER_PI + WHOLE, n = turned - WHOLE;
    const modeler_lanes r = ((x - n*PART_1) - n*PART_2) - n*PART_3, z = r*r;

    const modeler_lanes s_high = z*(8.3321608736e-3f - z*1.9515295891e-4f);
    const modeler_lanes s = r + r*z*(s_high - 1.6666654611e-1f);
    const modeler_lanes c_high = z*(z*2.443315711809948e-5f - 1.388731625493765e-3f);
    const modeler_lanes c = (1.0f - 0.5f*z) + z*z*(4.166664568298827e-2f + c_high);

    /* Turn by n quarters: an odd one swaps the two, the next bit turns the sign. */
    const modeler_bits k = (modeler_bits)turned, odd = k << 31 >> 31, turn = k >> 1 << 31;
    const modeler_bits S = (modeler_bits)s, C = (modeler_bits)c, both = S ^ C;
    const modeler_bits minus = (modeler_bits)modeler_lanes_spread(-0.0f);
    *sine = (modeler_lanes)(S ^ (both & odd) ^ turn);
    *cosine = (modeler_lanes)(C ^ ((both ^ minus) & odd) ^ turn);

    if (!MODELER_ALL_LESS(x*x, 1e10f)) {
        modeler_lanes given = x, sines = *sine, cosines = *cosine;
        modeler_far_sincos(MODELER_WIDTH, (const float *)&given, (float *)&sines,
                           (float *)&cosines);
        *sine = sines;
        *cosine = cosines;
    }
}

#endif
