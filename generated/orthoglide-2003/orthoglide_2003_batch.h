/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_2003_BATCH_H
#define ORTHOGLIDE_2003_BATCH_H

#include <stddef.h>

#include "orthoglide_2003.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 3
 * W         (samples*3) x 43
 * status    samples
 */
void orthoglide_2003_observation(size_t samples, const double *q, const double *qd,
                                 const double *qdd, double *W, int *status);

#ifdef __cplusplus
}
#endif

#endif
