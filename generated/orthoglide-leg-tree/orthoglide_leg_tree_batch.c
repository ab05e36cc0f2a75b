/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree_batch.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_leg_tree_batch.h"

#include "modeler_batch.h"

void orthoglide_leg_tree_observation(size_t samples, const double *q, const double *qd,
                                     const double *qdd, double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, ORTHOGLIDE_LEG_TREE_JOINTS},
        {qd, ORTHOGLIDE_LEG_TREE_JOINTS},
        {qdd, ORTHOGLIDE_LEG_TREE_JOINTS},
    };

    modeler_batch_3(orthoglide_leg_tree_base_regressor, samples, inputs, W,
                    (size_t)ORTHOGLIDE_LEG_TREE_JOINTS * ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS);
}
