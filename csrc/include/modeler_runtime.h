/* Loops over samples for emitted robot functions.
 *
 * C99, no allocation, no global state, re-entrant. Arrays are row-major; `samples` is how many rows
 * they have. Output arrays must not overlap input arrays.
 */
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

#ifdef __cplusplus
extern "C" {
#endif

/* An emitted function with so many inputs. */
typedef void (*modeler_function_1)(const modeler_real *, modeler_real *);
typedef void (*modeler_function_2)(const modeler_real *, const modeler_real *, modeler_real *);
typedef void (*modeler_function_3)(const modeler_real *, const modeler_real *, const modeler_real *,
                                   modeler_real *);
typedef void (*modeler_function_4)(const modeler_real *, const modeler_real *, const modeler_real *,
                                   const modeler_real *, modeler_real *);
typedef void (*modeler_function_5)(const modeler_real *, const modeler_real *, const modeler_real *,
                                   const modeler_real *, const modeler_real *, modeler_real *);

/* An input over samples: the values of sample i stand at data + i*step.
 * step 0: the same values for every sample, as for parameters. */
typedef struct {
    const modeler_real *data;
    size_t step;
} modeler_input;

/* Call `function` once per sample; inputs in its order. The result of sample i is written at
 * out + i*out_step. */
void modeler_batch_1(modeler_function_1 function, size_t samples, const modeler_input inputs[1],
                     modeler_real *out, size_t out_step);
void modeler_batch_2(modeler_function_2 function, size_t samples, const modeler_input inputs[2],
                     modeler_real *out, size_t out_step);
void modeler_batch_3(modeler_function_3 function, size_t samples, const modeler_input inputs[3],
                     modeler_real *out, size_t out_step);
void modeler_batch_4(modeler_function_4 function, size_t samples, const modeler_input inputs[4],
                     modeler_real *out, size_t out_step);
void modeler_batch_5(modeler_function_5 function, size_t samples, const modeler_input inputs[5],
                     modeler_real *out, size_t out_step);

#ifdef __cplusplus
}
#endif

#endif
