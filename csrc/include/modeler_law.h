/* Laws that were learned: smooth functions of one or two quantities, by tables of the robot's file.
 *
 * A uniform cubic spline (de Boor 1978), of two quantities the tensor product. Along the first axis
 * every cell has its polynomial, of the place in it, 0 to 1; its coefficients are the values, or
 * those of the spline along the second axis. Outside of the table a law is held at its end, and its
 * derivative is 0. Not a number where an argument is not finite. Straight-line code, no call.
 */
#ifndef MODELER_LAW_H
#define MODELER_LAW_H

#include "modeler_runtime.h"

typedef struct {
    const modeler_real *values; /* of power p in cell k, coefficient l: values[(4*k + p)*step + l] */
    modeler_real low[2], scale[2]; /* of each axis: its start, cells per unit */
    /* 0, and how many cells. Compilers that do not know them take the larger and the smaller of two
     * numbers; from constants they make jumps. */
    const volatile modeler_real least, cells[2];
    int step; /* coefficients along the second axis */
} modeler_law;

/* The law, and its derivatives along its axes. */
#define modeler_law_1(law, x) modeler_law_of_1(law, -1, x)
#define modeler_law_1x(law, x) modeler_law_of_1(law, 0, x)
#define modeler_law_2(law, x, y) modeler_law_of_2(law, -1, x, y)
#define modeler_law_2x(law, x, y) modeler_law_of_2(law, 0, x, y)
#define modeler_law_2y(law, x, y) modeler_law_of_2(law, 1, x, y)

/* The cell of x along an axis, where x lies in it, and by what the derivative there counts: cells per
 * unit, or 0. A comparison with what is not a number is false: that is in the first cell. */
static inline MODELER_INTO_CLONES int modeler_law_cell(const modeler_law *law, int axis,
                                                       modeler_real x, modeler_real *at,
                                                       modeler_real *rate)
{
    const modeler_real least = law->least, most = law->cells[axis];
    const modeler_real u = (x - law->low[axis])*law->scale[axis];
    const modeler_real above = u > least ? u : least, held = above < most ? above : most;
    const int cell = (int)held;

    *at = (held - (modeler_real)cell) + (x - x);
    *rate = (modeler_real)(held == u)*law->scale[axis];
    return cell;
}

/* The polynomial at f of a cell of the first axis, or its derivative. */
static inline MODELER_INTO_CLONES modeler_real modeler_law_power(const modeler_real *c, int step,
                                                                 modeler_real f, int slope)
{
    if (slope != 0) {
        return (3*c[3*step]*f + 2*c[2*step])*f + c[step];
    }
    return ((c[3*step]*f + c[2*step])*f + c[step])*f + c[0];
}

/* By what the four coefficients along the second axis count at g of a cell, or its derivative. */
static inline MODELER_INTO_CLONES void modeler_law_weights(modeler_real g, int slope,
                                                           modeler_real *w)
{
    const modeler_real one = 1, half = one/2, sixth = one/6, left = one - g;

    if (slope != 0) {
        w[0] = -half*left*left;
        w[1] = g*(3*half*g - 2);
        w[3] = half*g*g;
        w[2] = -w[0] - w[1] - w[3];
    } else {
        w[0] = sixth*left*left*left;
        w[1] = 4*sixth + g*g*(half*g - one);
        w[3] = sixth*g*g*g;
        w[2] = one - w[0] - w[1] - w[3];
    }
}

static inline MODELER_INTO_CLONES modeler_real modeler_law_of_1(const modeler_law *law, int along,
                                                                modeler_real x)
{
    modeler_real f, rate;
    const int cell = modeler_law_cell(law, 0, x, &f, &rate);
    const modeler_real value = modeler_law_power(law->values + 4*cell, 1, f, along == 0);

    return along < 0 ? value : value*rate;
}

static inline MODELER_INTO_CLONES modeler_real modeler_law_of_2(const modeler_law *law, int along,
                                                                modeler_real x, modeler_real y)
{
    modeler_real f, g, w[4], rates[2];
    const int k = modeler_law_cell(law, 0, x, &f, &rates[0]);
    const int l = modeler_law_cell(law, 1, y, &g, &rates[1]);
    const int step = law->step, slope = along == 0;
    const modeler_real *const c = law->values + 4*k*step + l;

    modeler_law_weights(g, along == 1, w);
    const modeler_real value =
        (w[0]*modeler_law_power(c, step, f, slope) + w[1]*modeler_law_power(c + 1, step, f, slope))
        + (w[2]*modeler_law_power(c + 2, step, f, slope)
           + w[3]*modeler_law_power(c + 3, step, f, slope));

    return along < 0 ? value : value*rates[slope != 0 ? 0 : 1];
}

#endif
