/* What emitted robot functions are written with. C99, no allocation, no global state. */
#ifndef MODELER_RUNTIME_H
#define MODELER_RUNTIME_H

#include <stddef.h>

#include "modeler_real.h"

#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error "modeler: NaN must stay NaN: compile without -ffast-math and -ffinite-math-only (/fp:fast)"
#endif

/* `restrict`, which C++ spells otherwise or has not. */
#if !defined(__cplusplus)
#define MODELER_RESTRICT restrict
#elif defined(__GNUC__) || defined(_MSC_VER)
#define MODELER_RESTRICT __restrict
#else
#define MODELER_RESTRICT
#endif

/* The output of a function where it is defined: nothing else points there, and its length, which
 * C++ and some compilers of C cannot say beside that. */
#if !defined(__cplusplus) && (defined(__GNUC__) || defined(__clang__))
#define MODELER_OUT(name, length) name[MODELER_RESTRICT length]
#else
#define MODELER_OUT(name, length) *MODELER_RESTRICT name
#endif

/* What is always 0 in an output is written between the arithmetic, where it costs no time; all at
 * once, and first, where the code is to be small. */
#define MODELER_CLEAR(x, length) \
    for (int i_ = 0; i_ < (length); i_++) { \
        (x)[i_] = 0; \
    }
#ifdef __OPTIMIZE_SIZE__
#define MODELER_ALL_ZEROS(x, length) MODELER_CLEAR(x, length)
#define MODELER_ZEROS(x, length) (void)0
#else
#define MODELER_ALL_ZEROS(x, length) (void)0
#define MODELER_ZEROS(x, length) MODELER_CLEAR(x, length)
#endif

/* -1, 0 or 1; NaN where x is not finite. */
static inline modeler_real modeler_sign(modeler_real x)
{
    const modeler_real zero = 0, one = 1;

    return (x > zero ? one : x < zero ? -one : zero) + (x - x);
}

#endif
