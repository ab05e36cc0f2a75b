/* SR400, 6R arm with a parallelogram
 *
 * Functions of sr400_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "sr400_batch.h"

#include "modeler_batch.h"

void sr400_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, SR400_JOINTS},
        {qd, SR400_JOINTS},
        {qdd, SR400_JOINTS},
    };

    modeler_batch_3(sr400_base_regressor, samples, inputs, W,
                    (size_t)SR400_JOINTS * SR400_BASE_PARAMETERS);
}
