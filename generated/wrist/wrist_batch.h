/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Many samples at once: a library of its own, which a controller has no use for.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef WRIST_BATCH_H
#define WRIST_BATCH_H

#include <stddef.h>

#include "wrist.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Observation matrix of many samples: y = W beta, with the torques of one sample together in y.
 *
 * q qd qdd  samples x 3
 * W         (samples*3) x 17
 */
void wrist_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *W);

#ifdef __cplusplus
}
#endif

#endif
