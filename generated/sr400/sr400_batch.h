/* SR400, 6R arm with a parallelogram
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef SR400_BATCH_H
#define SR400_BATCH_H

#include <stddef.h>

#include "sr400.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 6
 * W         (samples*6) x 39
 */
void sr400_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *W);

#ifdef __cplusplus
}
#endif

#endif
