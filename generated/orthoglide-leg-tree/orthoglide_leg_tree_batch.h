/* One leg of the Orthoglide, cut open
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_LEG_TREE_BATCH_H
#define ORTHOGLIDE_LEG_TREE_BATCH_H

#include <stddef.h>

#include "orthoglide_leg_tree.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 6
 * W         (samples*6) x 32
 */
void orthoglide_leg_tree_observation(size_t samples, const double *q, const double *qd,
                                     const double *qdd, double *W);

#ifdef __cplusplus
}
#endif

#endif
