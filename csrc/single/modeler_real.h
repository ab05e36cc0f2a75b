/* The type of every number, and what follows from its precision: here float.
 *
 * A program may hold robots of both kinds, so every external name of the runtime is another one
 * here.
 */
#ifndef MODELER_REAL_H
#define MODELER_REAL_H

#define MODELER_SINGLE
typedef float modeler_real;

/* Numbers in a line of the cache: as many samples has a tile. */
#define MODELER_LANES 16

/* A literal. */
#define MODELER_REAL(x) x##f

/* Of <math.h>. */
#define modeler_fabs fabsf
#define modeler_fmin fminf
#define modeler_sqrt sqrtf

/* Bounds of the solutions by Newton and by elimination, in scaled variables. */
#define MODELER_CONVERGED 2e-4f /* a correction after which the error is its square */
#define MODELER_EXACT 2e-6f     /* a correction that is not worth making */
#define MODELER_FLAT 1e-4f      /* pivots below this share of the largest are zero */
#define MODELER_PIVOT 1e-5f     /* pivots below this share of the diagonal are zero */
#define MODELER_SHORTEST 1e-4f  /* share of a way; where shorter steps fail too, it ends */

/* modeler_batch.c */
#define modeler_batch_1 modelerf_batch_1
#define modeler_batch_2 modelerf_batch_2
#define modeler_batch_3 modelerf_batch_3
#define modeler_batch_4 modelerf_batch_4
#define modeler_batch_5 modelerf_batch_5
#define modeler_batch_6 modelerf_batch_6
#define modeler_batch_status_1 modelerf_batch_status_1
#define modeler_batch_status_2 modelerf_batch_status_2
#define modeler_batch_status_3 modelerf_batch_status_3
#define modeler_batch_status_4 modelerf_batch_status_4
#define modeler_batch_status_5 modelerf_batch_status_5

/* modeler_tile.c */
#define modeler_tile_function modelerf_tile_function
#define modeler_tile_closing modelerf_tile_closing
#define modeler_tiled modelerf_tiled
#define modeler_tiled_ modelerf_tiled_
#define modeler_tile_work modelerf_tile_work
#define modeler_tile_observation modelerf_tile_observation
#define modeler_tile_columns modelerf_tile_columns
#define modeler_tile_nonzeros modelerf_tile_nonzeros
#define modeler_tile_closed modelerf_tile_closed

/* modeler_closure*.c */
#define modeler_close modelerf_close
#define modeler_close_next modelerf_close_next
#define modeler_close_soon modelerf_close_soon
#define modeler_coupling modelerf_coupling
#define modeler_drift modelerf_drift
#define modeler_accelerations modelerf_accelerations
#define modeler_coupling_rate modelerf_coupling_rate
#define modeler_parts modelerf_parts
#define modeler_jacobian modelerf_jacobian
#define modeler_factors modelerf_factors
#define modeler_solution modelerf_solution
#define modeler_eliminated modelerf_eliminated
#define modeler_project modelerf_project
#define modeler_project_more modelerf_project_more
#define modeler_apply_more modelerf_apply_more

#endif
