/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Base regressors of many samples: see modeler_tile.h for what to do with them.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_2012_TILE_H
#define ORTHOGLIDE_2012_TILE_H

#include "modeler_tile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The entries of this robot's base regressor, by the best instructions of this processor. They are
 * those of the scalar function
 *     orthoglide_2012_base_regressor_nonzeros
 * but for roundings, where one fuses a multiplication and an addition and the other does not. */
const modeler_tiled *orthoglide_2012_tiled(void);

/* Tells whether this code belongs to a manifest. */
const char *orthoglide_2012_tile_signature(void);

#ifdef __cplusplus
}
#endif

#endif
