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
    const modeler_real *values; /* power p, cell k, coefficient l: values[(4*k + p)*step + l] */
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

/* The cell of x along an axis, where x lies in it, and by what the derivative there counts: cells
 * per unit, or 0. A comparison with what is no number is false: that is in the first cell. */
static inline MODELER_INTO_CLONES int modeler_law_cell(const modeler_law *law, int axis,
                                                       modeler_real x, modeler_real *at,
                                                       modeler_real *rate)
{
    const modeler_real least = law->least, most = law->cells[axis];
    const modeler_real u = (x - law->low[axis])*law->scale[axis];
    const modeler_real above = u > least ? u : least, held = above < most ? above : most;
    const int cell = (int)held;

    *at = (held - (modeler_real)cell) + (x - x);
    *rate = (modeler_real)((u >= least) & (u <= most))*law->scale[axis];
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

static inline MODELER_INTO_CLONES modeler_real modeler_law_of_1(const modeler_law *law, int along,
                                                                modeler_real x)
{
    modeler_real f, rate;
    const int cell = modeler_law_cell(law, 0, x, &f, &rate);
    const modeler_real value = modeler_law_power(law->values + 4*cell, 1, f, along == 0);

    return along < 0 ? value : value*rate;
}

#if defined(__GNUC__) && !defined(MODELER_PLAIN)
/* Four coefficients along the second axis side by side. */
typedef modeler_real modeler_law_four
    __attribute__((vector_size(4*sizeof(modeler_real)), aligned(sizeof(modeler_real)), may_alias));
#define MODELER_LAW_FOUR(at) (*(const modeler_law_four *)(const void *)(at))

/* The sum of their polynomials at f, each times what it counts at g; or its derivative. */
static inline MODELER_INTO_CLONES modeler_real modeler_law_sum(const modeler_real *c, int step,
                                                               modeler_real f, modeler_real g,
                                                               int along)
{
    const modeler_real one = 1, two = 2, three = 3, half = one/2, sixth = one/6;
    const modeler_law_four a = MODELER_LAW_FOUR(c + 3*step), b = MODELER_LAW_FOUR(c + 2*step);
    const modeler_law_four first = {-sixth, half, -half, sixth}, second = {half, -one, half, 0};
    const modeler_law_four third = {-half, 0, half, 0}, last = {sixth, 4*sixth, sixth, 0};
    const modeler_law_four d = MODELER_LAW_FOUR(c + step);
    const modeler_law_four values = along == 0 ? (a*(three*f) + b*two)*f + d
        : ((a*f + b)*f + d)*f + MODELER_LAW_FOUR(c);
    const modeler_law_four counts = along == 1 ? (first*(three*g) + second*two)*g + third
        : ((first*g + second)*g + third)*g + last;
    const modeler_law_four parts = values*counts;

    return (parts[0] + parts[2]) + (parts[1] + parts[3]);
}
#else
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

static inline MODELER_INTO_CLONES modeler_real modeler_law_sum(const modeler_real *c, int step,
                                                               modeler_real f, modeler_real g,
                                                               int along)
{
    const int slope = along == 0;
    modeler_real w[4];

    modeler_law_weights(g, along == 1, w);
    return (w[0]*modeler_law_power(c, step, f, slope)
            + w[1]*modeler_law_power(c + 1, step, f, slope))
        + (w[2]*modeler_law_power(c + 2, step, f, slope)
           + w[3]*modeler_law_power(c + 3, step, f, slope));
}
#endif

static inline MODELER_INTO_CLONES modeler_real modeler_law_of_2(const modeler_law *law, int along,
                                                                modeler_real x, modeler_real y)
{
    modeler_real f, g, rates[2];
    const int k = modeler_law_cell(law, 0, x, &f, &rates[0]);
    const int l = modeler_law_cell(law, 1, y, &g, &rates[1]);
    const int step = law->step;
    const modeler_real value = modeler_law_sum(law->values + 4*k*step + l, step, f, g, along);

    return along < 0 ? value : value*rates[along == 0 ? 0 : 1];
}

#endif
