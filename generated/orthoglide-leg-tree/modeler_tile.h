/* Samples side by side: base regressors of MODELER_LANES samples at once, and loops over many.
 *
 * C99, no allocation, no global state, re-entrant. Arrays are row-major: one row per sample.
 * Output arrays must not overlap input arrays. A value that is not finite marks only its sample.
 * What a sample gives depends on nothing but that sample: not on its place, nor on how many there
 * are.
 */
#ifndef MODELER_TILE_H
#define MODELER_TILE_H

#include <stddef.h>

#include "modeler_runtime.h"

#ifdef __cplusplus
extern "C" {
#endif

#define MODELER_LANES 8

/* Entries of the base regressor of MODELER_LANES samples: values[k*MODELER_LANES + lane], 64-byte
 * aligned. Inputs are rows, of any alignment; s may be NULL where there are no signals. */
typedef void (*modeler_tile_function)(const double *q, const double *qd, const double *qdd,
                                      const double *s, double *values);

/* A robot's tiles. */
typedef struct {
    int joints, columns, signals, nonzeros;
    const int *row, *column; /* of each entry, row after row */
    modeler_tile_function tile;
} modeler_tiled;

/* Bytes that the loops below work in, without content or alignment; each thread needs its own. */
size_t modeler_tile_work(const modeler_tiled *robot);

/* W, (samples*joints) x columns: y = W beta. Every entry is written, zeros too, past the caches. */
void modeler_tile_observation(const modeler_tiled *robot, size_t samples, const double *q,
                              const double *qd, const double *qdd, const double *s, double *W,
                              void *work);

/* Entries that are not always 0, samples x nonzeros, past the caches. */
void modeler_tile_nonzeros(const modeler_tiled *robot, size_t samples, const double *q,
                           const double *qd, const double *qdd, const double *s, double *values,
                           void *work);

#ifdef __cplusplus
}
#endif

#endif
