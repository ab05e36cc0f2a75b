/* Laws of modeler_law.h in the lanes of modeler_lanes.h, for the version that is read. */
#ifndef MODELER_LAW_LANES_H
#define MODELER_LAW_LANES_H

#include "modeler_law.h"

#define modeler_lanes_law_of_1 MODELER_VERSION(modeler_lanes_law_of_1)
#define modeler_lanes_law_of_2 MODELER_VERSION(modeler_lanes_law_of_2)
#define modeler_lanes_law_1(law, x) modeler_lanes_law_of_1(law, x)
#define modeler_lanes_law_2(law, x, y) modeler_lanes_law_of_2(law, x, y)

#endif

#if MODELER_WIDTH == 1

MODELER_INLINE modeler_real modeler_lanes_law_of_1(const modeler_law *law, modeler_real x)
{
    return modeler_law_1(law, x);
}

MODELER_INLINE modeler_real modeler_lanes_law_of_2(const modeler_law *law, modeler_real x,
                                                   modeler_real y)
{
    return modeler_law_2(law, x, y);
}

#else

MODELER_INLINE modeler_lanes modeler_lanes_law_of_1(const modeler_law *law, modeler_lanes x)
{
    for (int i = 0; i < MODELER_WIDTH; i++) {
        x[i] = modeler_law_1(law, x[i]);
    }
    return x;
}

MODELER_INLINE modeler_lanes modeler_lanes_law_of_2(const modeler_law *law, modeler_lanes x,
                                                    modeler_lanes y)
{
    for (int i = 0; i < MODELER_WIDTH; i++) {
        x[i] = modeler_law_2(law, x[i], y[i]);
    }
    return x;
}

#endif
