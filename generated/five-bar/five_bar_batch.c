/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "five_bar_batch.h"

#include "modeler_closure.h"
#include "five_bar_tree.h"

/* Each sample starts from the one before; where that fails, from home. */
void five_bar_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                          double *MODELER_RESTRICT W, int *status)
{
    struct five_bar_posture p;
    double rows[4 * FIVE_BAR_BASE_PARAMETERS];
    const size_t width = (size_t)FIVE_BAR_JOINTS * FIVE_BAR_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * FIVE_BAR_JOINTS;

        status[i] = five_bar_tree_next(q + at, qd + at, qdd + at,
                                           i > 0 && status[i - 1] == MODELER_CLOSED, &p, rows,
                                           W + i * width);
    }
}
