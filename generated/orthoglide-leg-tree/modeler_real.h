/* The type of every number, and what follows from its precision: here double.
 *
 * The runtime is written once, in modeler_real; beside a module of floats stands another file of
 * this name.
 */
#ifndef MODELER_REAL_H
#define MODELER_REAL_H

typedef double modeler_real;

/* Numbers in a line of the cache: as many samples has a tile. */
#define MODELER_LANES 8

/* A literal. */
#define MODELER_REAL(x) x

/* Of <math.h>. */
#define modeler_fabs fabs
#define modeler_fmin fmin
#define modeler_sqrt sqrt

/* Bounds of the solutions by Newton and by elimination, in scaled variables. */
#define MODELER_CONVERGED 1e-8 /* a correction after which the error is its square */
#define MODELER_EXACT 1e-14    /* a correction that is not worth making */
#define MODELER_FLAT 1e-11     /* pivots below this share of the largest are zero */
#define MODELER_PIVOT 1e-13     /* pivots below this share of the diagonal are zero */
#define MODELER_SHORTEST 1e-7  /* share of a way; where shorter steps fail too, it ends */

#endif
