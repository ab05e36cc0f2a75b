/* What emitted robot functions are written with. C99, no allocation, no global state. */
#ifndef MODELER_RUNTIME_H
#define MODELER_RUNTIME_H

#include <stddef.h>

#include "modeler_real.h"

#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error "modeler: NaN must stay NaN: compile without -ffast-math and -ffinite-math-only (/fp:fast)"
#endif

/* `restrict`, which C++ and the C of Visual Studio spell otherwise, or have not. */
#if !defined(__cplusplus) && !defined(_MSC_VER)
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

/* Where gcc can, a function is compiled for processors with AVX-512 and with FMA besides, and the
 * loader picks (ifunc): a build for any x86-64 is then about as fast as one for the processor at
 * hand. Results differ only where a multiplication and an addition are fused. -DMODELER_NO_CLONES
 * leaves it out: one text of machine code, the same digits on every processor. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) \
    && !defined(__INTEL_COMPILER) && !defined(__cplusplus) && __STDC_HOSTED__ \
    && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && !defined(__FMA__) \
    && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) \
    && !defined(MODELER_NO_CLONES) && !defined(MODELER_PLAIN)
#include <limits.h> /* says whether the C library is glibc, whose loader can */
#if defined(__GLIBC__) && !defined(__UCLIBC__) && __GNUC__ >= 8
#undef MODELER_INTO_CLONES
#define MODELER_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#define MODELER_INTO_CLONES __attribute__((always_inline))
#endif
#endif
#ifndef MODELER_CLONES
#define MODELER_CLONES
#undef MODELER_INTO_CLONES
#define MODELER_INTO_CLONES
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
/* Wider stores would cross lines of the cache. */
#if defined(__GNUC__) && defined(__SSE2__) && !defined(__cplusplus)
#define MODELER_ZEROS(x, length) \
    for (int i_ = 0; i_ + MODELER_FEW_ <= (length); i_ += MODELER_FEW_) { \
        *(modeler_few_ *)(void *)((x) + i_) = (modeler_few_){0}; \
    } \
    for (int i_ = (length) / MODELER_FEW_ * MODELER_FEW_; i_ < (length); i_++) { \
        (x)[i_] = 0; \
    }
#define MODELER_FEW_ (int)(16 / sizeof(modeler_real))
typedef modeler_real modeler_few_
    __attribute__((vector_size(16), aligned(sizeof(modeler_real)), may_alias));
#else
#define MODELER_ZEROS(x, length) MODELER_CLEAR(x, length)
#endif
#endif

/* -1, 0 or 1; NaN where x is not finite. */
static inline modeler_real modeler_sign(modeler_real x)
{
    const modeler_real zero = 0, one = 1;

    return (x > zero ? one : x < zero ? -one : zero) + (x - x);
}

#endif
