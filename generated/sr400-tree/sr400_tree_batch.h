/* SR400, 6R arm with a parallelogram, cut open
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef SR400_TREE_BATCH_H
#define SR400_TREE_BATCH_H

#include <stddef.h>

#include "sr400_tree.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 8
 * W         (samples*8) x 50
 */
void sr400_tree_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                            double *W);

#ifdef __cplusplus
}
#endif

#endif
