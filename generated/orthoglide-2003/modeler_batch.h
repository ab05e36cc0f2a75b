/* Loops over samples for emitted robot functions.
 *
 * C99, no allocation, no global state, re-entrant. Arrays are row-major; `samples` is how many rows
 * they have. Output arrays must not overlap input arrays.
 */
#ifndef MODELER_BATCH_H
#define MODELER_BATCH_H

#include <stddef.h>

#include "modeler_runtime.h"

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
typedef void (*modeler_function_6)(const modeler_real *, const modeler_real *, const modeler_real *,
                                   const modeler_real *, const modeler_real *, const modeler_real *,
                                   modeler_real *);

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
void modeler_batch_6(modeler_function_6 function, size_t samples, const modeler_input inputs[6],
                     modeler_real *out, size_t out_step);

/* Emitted functions with a status, and loops over samples that keep it. */
typedef int (*modeler_status_1)(const modeler_real *, modeler_real *);
typedef int (*modeler_status_2)(const modeler_real *, const modeler_real *, modeler_real *);
typedef int (*modeler_status_3)(const modeler_real *, const modeler_real *, const modeler_real *,
                                modeler_real *);
typedef int (*modeler_status_4)(const modeler_real *, const modeler_real *, const modeler_real *,
                                const modeler_real *, modeler_real *);
typedef int (*modeler_status_5)(const modeler_real *, const modeler_real *, const modeler_real *,
                                const modeler_real *, const modeler_real *, modeler_real *);

void modeler_batch_status_1(modeler_status_1 function, size_t samples,
                            const modeler_input inputs[1], modeler_real *out, size_t out_step,
                            int *status);
void modeler_batch_status_2(modeler_status_2 function, size_t samples,
                            const modeler_input inputs[2], modeler_real *out, size_t out_step,
                            int *status);
void modeler_batch_status_3(modeler_status_3 function, size_t samples,
                            const modeler_input inputs[3], modeler_real *out, size_t out_step,
                            int *status);
void modeler_batch_status_4(modeler_status_4 function, size_t samples,
                            const modeler_input inputs[4], modeler_real *out, size_t out_step,
                            int *status);
void modeler_batch_status_5(modeler_status_5 function, size_t samples,
                            const modeler_input inputs[5], modeler_real *out, size_t out_step,
                            int *status);

#ifdef __cplusplus
}
#endif

#endif
