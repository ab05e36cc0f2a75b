/* Sine and cosine at once, inline: the calls of <math.h> are a good third of a regressor's time.
 *
 * Straight-line code; error below 2.5 units in the last place (1.5 for |x| < 320). Method and
 * coefficients: fdlibm (Sun Microsystems, 1993): reduction by pi/2 in three parts (Cody, Waite),
 * polynomials on [-pi/4, pi/4]. Angles of 1e5 rad and more go to <math.h>; with
 * -DMODELER_BOUNDED_ANGLES they give NaN, and its sin and cos, 4 KB on a Cortex-M, are not linked.
 */
#ifndef MODELER_SINCOS_H
#define MODELER_SINCOS_H

#include <math.h>

#ifndef MODELER_INTO_CLONES /* of modeler_runtime.h */
#define MODELER_INTO_CLONES
#endif

static inline MODELER_INTO_CLONES void modeler_sincos(double x, double *sine, double *cosine)
{
    /* pi/2 = PART_1 + PART_2 + PART_3; the first two have 33 bits, so n*PART is exact. */
    const double PART_1 = 1.57079632673412561417e+00, PART_2 = 6.07710050630396597660e-11;
    const double PART_3 = 2.02226624879595063154e-21, TWO_OVER_PI = 6.36619772367581382433e-01;
    static const double SINES[5] = {0.0, 1.0, 0.0, -1.0, 0.0};

    if (!(fabs(x) < 1e5)) { /* too many turns for that reduction, or not a number */
#ifdef MODELER_BOUNDED_ANGLES
        *sine = NAN;
        *cosine = NAN;
#else
        *sine = sin(x);
        *cosine = cos(x);
#endif
        return;
    }
    const int n = (int)(x*TWO_OVER_PI + copysign(0.5, x));
    const double r = ((x - n*PART_1) - n*PART_2) - n*PART_3, z = r*r;

    const double s_high = z*(-2.50507602534068634195e-08 + z*1.58969099521155010221e-10);
    const double s_low = 8.33333333332248946124e-03 +
        z*(-1.98412698298579493134e-04 + z*(2.75573137070700676789e-06 + s_high));
    const double s = r + r*z*(-1.66666666666666324348e-01 + z*s_low);

    const double c_high = z*(2.08757232129817482790e-09 - z*1.13596475577881948265e-11);
    const double c_low = z*(4.16666666666666019037e-02 +
        z*(-1.38888888888741095749e-03 +
           z*(2.48015872894767294178e-05 + z*(-2.75573143513906633035e-07 + c_high))));
    const double half = 0.5*z, w = 1.0 - half;
    const double c = w + (((1.0 - w) - half) + z*c_low);

    /* Turn by n quarters; exact, because the factors are 0, 1, -1. */
    const unsigned k = (unsigned)n & 3u; /* of quarters */
    const double a = SINES[k + 1u], b = SINES[k];
    *sine = a*s + b*c;
    *cosine = a*c - b*s;
}

#endif
