/* Samples side by side: base regressors of MODELER_LANES samples at once, and loops over many.
 *
 * C99, no allocation, no global state, re-entrant. Arrays are row-major: one row per sample.
 * Output arrays must not overlap input arrays. A value that is not finite marks only its sample.
 * Without loops, what a sample gives depends on nothing but that sample: not on its place, nor on
 * how many there are.
 */
#ifndef MODELER_TILE_H
#define MODELER_TILE_H

#include <stddef.h>

#include "modeler_runtime.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Entries of the base regressor of MODELER_LANES samples: values[k*MODELER_LANES + lane], 64-byte
 * aligned. Inputs are rows, of any alignment; s may be NULL where there are no signals. */
typedef void (*modeler_tile_function)(const modeler_real *q, const modeler_real *qd,
                                      const modeler_real *qdd, const modeler_real *s,
                                      modeler_real *values);

struct modeler_tiled_;

/* The same of a robot with loops, of the first `samples` of the tile; `state` starts with zeros and
 * keeps the posture from which the next tile goes on. Where loops do not close, values are NaN. */
typedef void (*modeler_tile_closing)(const struct modeler_tiled_ *robot, const modeler_real *q,
                                     const modeler_real *qd, const modeler_real *qdd,
                                     size_t samples, void *state, modeler_real *values,
                                     int *status);

/* A robot's tiles. */
typedef struct modeler_tiled_ {
    int joints, columns, signals, nonzeros;
    const int *row, *column;      /* of each entry, row after row */
    modeler_tile_function tile;   /* NULL: the robot has loops */
    modeler_tile_closing closing; /* NULL: it has none */
    size_t room;                  /* bytes of its state */
    const void *singles;          /* what closes the loops of one sample */
} modeler_tiled;

/* Bytes that the loops below work in, without content or alignment; each thread needs its own. */
size_t modeler_tile_work(const modeler_tiled *robot);

/* W, (samples*joints) x columns: y = W beta. Every entry is written, zeros too, past the caches. */
void modeler_tile_observation(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                              const modeler_real *qd, const modeler_real *qdd,
                              const modeler_real *s, modeler_real *W, void *work);

/* The same W column after column, as Fortran and LAPACK have it: row i of column c stands at
 * W[c*rows + i], `rows` is at least samples*joints. */
void modeler_tile_columns(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                          const modeler_real *qd, const modeler_real *qdd, const modeler_real *s,
                          modeler_real *W, size_t rows, void *work);

/* Entries that are not always 0, samples x nonzeros, past the caches. */
void modeler_tile_nonzeros(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                           const modeler_real *qd, const modeler_real *qdd, const modeler_real *s,
                           modeler_real *values, void *work);

/* W of a robot with loops: row after row if `rows` is 0, else as modeler_tile_columns. Each sample
 * starts from one before it, or where that fails from home; status[i] says whether its loops close.
 * Those of a tile are closed together, and one after another where together is not safe. */
void modeler_tile_closed(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                         const modeler_real *qd, const modeler_real *qdd, modeler_real *W,
                         size_t rows, int *status, void *work);

#ifdef __cplusplus
}
#endif

#endif
