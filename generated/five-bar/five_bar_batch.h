/* Planar five-bar, two actuated joints at the base
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef FIVE_BAR_BATCH_H
#define FIVE_BAR_BATCH_H

#include <stddef.h>

#include "five_bar.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 2
 * W         (samples*2) x 11
 * status    samples
 */
void five_bar_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                          double *W, int *status);

#ifdef __cplusplus
}
#endif

#endif
