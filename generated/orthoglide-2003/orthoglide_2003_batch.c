/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2003_batch.h"

#include "modeler_closure.h"
#include "orthoglide_2003_tree.h"

/* Each sample starts from the one before; where that fails, from home. */
void orthoglide_2003_observation(size_t samples, const double *q, const double *qd,
                                 const double *qdd, double *MODELER_RESTRICT W, int *status)
{
    struct orthoglide_2003_posture p;
    double rows[12 * ORTHOGLIDE_2003_BASE_PARAMETERS];
    const size_t width = (size_t)ORTHOGLIDE_2003_JOINTS * ORTHOGLIDE_2003_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * ORTHOGLIDE_2003_JOINTS;

        status[i] = orthoglide_2003_tree_next(q + at, qd + at, qdd + at,
                                           i > 0 && status[i - 1] == MODELER_CLOSED, &p, rows,
                                           W + i * width);
    }
}
