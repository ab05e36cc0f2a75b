/* Planar five-bar, two actuated joints at the base
 *
 * Base regressors of many samples: see modeler_tile.h for what to do with them.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef FIVE_BAR_TILE_H
#define FIVE_BAR_TILE_H

#include "modeler_tile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The entries of this robot's base regressor, by the best instructions of this processor. They are
 * those of the scalar function
 *     five_bar_base_regressor_nonzeros
 * but for roundings, where one fuses a multiplication and an addition and the other does not. */
const modeler_tiled *five_bar_tiled(void);

/* Tells whether this code belongs to a manifest. */
const char *five_bar_tile_signature(void);

#ifdef __cplusplus
}
#endif

#endif
