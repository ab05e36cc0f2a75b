/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef EVRA_BATCH_H
#define EVRA_BATCH_H

#include <stddef.h>

#include "evra.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 8
 * W         (samples*8) x 90
 * status    samples
 */
void evra_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                      double *W, int *status);

#ifdef __cplusplus
}
#endif

#endif
