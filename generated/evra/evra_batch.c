/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of evra_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "evra_batch.h"

#include "modeler_closure.h"
#include "evra_tree.h"

/* Each sample starts from the one before; where that fails, from home. */
void evra_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                      double *MODELER_RESTRICT W, int *status)
{
    struct evra_posture p;
    double rows[26 * EVRA_BASE_PARAMETERS];
    const size_t width = (size_t)EVRA_JOINTS * EVRA_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * EVRA_JOINTS;

        status[i] = evra_tree_next(q + at, qd + at, qdd + at,
                                           i > 0 && status[i - 1] == MODELER_CLOSED, &p, rows,
                                           W + i * width);
    }
}
