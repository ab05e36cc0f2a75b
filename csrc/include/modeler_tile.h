/* Entries of a base regressor for several samples at once. */
#ifndef MODELER_TILE_H
#define MODELER_TILE_H

#ifdef __cplusplus
extern "C" {
#endif

#define MODELER_LANES 8
/* Entries of the base regressor for MODELER_LANES samples, row-major inputs (lane after lane),
 * values[k*MODELER_LANES + lane], 64-byte aligned. s may be NULL where there are no signals. */
typedef void (*modeler_tile_function)(const double *q, const double *qd, const double *qdd,
                                      const double *s, double *values);
typedef struct {
    int joints, columns, signals, nonzeros;
    const int *row, *column;          /* of each entry, row after row */
    modeler_tile_function tile;
} modeler_tiled;

#ifdef __cplusplus
}
#endif

#endif
