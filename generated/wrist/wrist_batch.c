/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "wrist_batch.h"

#include "modeler_batch.h"

void wrist_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, WRIST_JOINTS},
        {qd, WRIST_JOINTS},
        {qdd, WRIST_JOINTS},
    };

    modeler_batch_3(wrist_base_regressor, samples, inputs, W,
                    (size_t)WRIST_JOINTS * WRIST_BASE_PARAMETERS);
}
