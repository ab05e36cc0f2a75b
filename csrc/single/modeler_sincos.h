/* Sine and cosine at once, in single precision: float alone, no function of <math.h>.
 *
 * Straight-line code. For |x| < 1e5 the error is below 1e-7, and below 2 units in the last place
 * of results above 0.001 where |x| < 100. At 1e5 neighbouring floats are 0.008 rad apart, so no
 * angle of a robot is beyond: there both are NaN. Reduction by pi/2 in three parts (Cody, Waite);
 * polynomials on [-pi/4, pi/4]: Cephes (Moshier, 1992).
 */
#ifndef MODELER_SINCOS_H
#define MODELER_SINCOS_H

#include <math.h>

#ifndef MODELER_INTO_CLONES /* of modeler_runtime.h */
#define MODELER_INTO_CLONES
#endif

static inline MODELER_INTO_CLONES void modeler_sincos(float x, float *sine, float *cosine)
{
    /* pi/2 = PART_1 + PART_2 + PART_3; the first two have 8 bits and n has 16, so n*PART is exact,
     * and so are the differences from x. */
    const float PART_1 = 1.5703125f, PART_2 = 4.825592041015625e-4f;
    const float PART_3 = 1.26759068e-6f, TWO_OVER_PI = 6.36619772e-1f;
    static const float SINES[5] = {0.0f, 1.0f, 0.0f, -1.0f, 0.0f};

    if (!(fabsf(x) < 1e5f)) { /* nor a number, then */
        *sine = NAN;
        *cosine = NAN;
        return;
    }
    const int n = (int)(x*TWO_OVER_PI + copysignf(0.5f, x));
    const float turns = (float)n;
    const float r = ((x - turns*PART_1) - turns*PART_2) - turns*PART_3, z = r*r;

    const float s_high = z*(8.3321608736e-3f - z*1.9515295891e-4f);
    const float s = r + r*z*(s_high - 1.6666654611e-1f);
    const float c_high = z*(z*2.443315711809948e-5f - 1.388731625493765e-3f);
    const float c = (1.0f - 0.5f*z) + z*z*(4.166664568298827e-2f + c_high);

    /* Turn by n quarters; exact, because the factors are 0, 1, -1. */
    const unsigned k = (unsigned)n & 3u; /* of quarters */
    const float a = SINES[k + 1u], b = SINES[k];
    *sine = a*s + b*c;
    *cosine = a*c - b*s;
}

#endif
