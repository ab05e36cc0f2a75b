/* Planar five-bar, two actuated joints at the base
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * every function gives at stored states what the equations of motion give there, evaluated with 40
 * digits and not by this code. Prints what differs and one line more; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "five_bar.h"
#include "modeler_closure.h"
#include "modeler_runtime.h"
#include "modeler_sincos.h"

#define N 2
#define C 11
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if FIVE_BAR_JOINTS != N || FIVE_BAR_BASE_PARAMETERS != C \
    || FIVE_BAR_STANDARD_PARAMETERS != 40
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef FIVE_BAR_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L0
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L1
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L4
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* Inputs, one row for each state. */
static double q[] = {
    2.25, 0.81427001953125, 2.1357421875, 0.95001220703125
};
static double qd[] = {
    1.0, -1.3125, -0.0185546875, 0.0234375
};
static double qdd[] = {
    -2.125, -0.875, -0.375, 0.875
};
static double chi[] = {
    1.238525390625, 1.126953125, 1.015380859375, 1.90380859375, 1.792236328125, 1.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 1.122802734375, 1.01123046875,
    1.899658203125, 1.7880859375, 1.676513671875, 1.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 1.007080078125, 1.8955078125, 1.783935546875, 1.67236328125,
    1.560791015625, 1.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    1.891357421875, 1.77978515625, 1.668212890625, 1.556640625, 1.445068359375, 1.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125
};
static double beta[] = {
    2.04318359375, 2.777490234375, 1.45751953125, 2.030436197916667, 2.617106119791667, 1.341796875,
    1.350991536458333, 1.020784505208333, 1.22607421875, 0.8202880859375, 1.1103515625
};
static double start[] = {
    2.1357421875, -1.259453113929089, 0.95001220703125, 1.366363355991266, 2.25, -1.492711345449275,
    0.81427001953125, 1.588731266189806
};

/* What the functions give there. */
static double at_inverse_dynamics[] = {
    -38.47203184508059, 3.294213289994722, -33.86797029731403, 3.570861015396606
};
static double at_gravity[] = {
    -34.58001026741769, 5.906981074397319, -33.01062606311497, 1.31519564490783
};
static double at_coriolis[] = {
    1.089615606735097, -0.5264671975080737, 0.0003474277364489426, -0.0001720955499459912
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0
};
static double at_inertia_matrix[] = {
    2.382130977654429, -0.09187559213447234, -0.09187559213447234, 2.607469965920317,
    2.296955781687307, 0.00419057851111697, 0.00419057851111697, 2.579895923406161
};
static double at_forward_kinematics[] = {
    -0.6281736227227391, -0.7780731968879212, 0.0, 0.0, 0.7780731968879212, -0.6281736227227391,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.7267012482014271, -0.6869536344342956, 0.0, -0.1884520868168217,
    0.6869536344342956, 0.7267012482014271, 0.0, 0.2334219590663764, 0.0, 0.0, 1.0, 0.0,
    0.6863994361432988, -0.7272247342205581, 0.0, 0.2, 0.7272247342205581, 0.6863994361432988, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, -0.7394176493825559, -0.6732470124564799, 0.0, 0.4127838252044226,
    0.6732470124564799, -0.7394176493825559, 0.0, 0.225439667608373, 0.0, 0.0, 1.0, 0.0,
    -0.5353700897952323, -0.8446175862203231, 0.0, 0.0, 0.8446175862203231, -0.5353700897952323,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6400069058185038, -0.7683691563985535, 0.0, -0.1606110269385697,
    0.7683691563985535, 0.6400069058185038, 0.0, 0.2533852758660969, 0.0, 0.0, 1.0, 0.0,
    0.5816731600320588, -0.8134226053524201, 0.0, 0.2, 0.8134226053524201, 0.5816731600320588, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, -0.6783974862407294, -0.7346950732530193, 0.0, 0.3803186796099382,
    0.7346950732530193, -0.6783974862407294, 0.0, 0.2521610076592502, 0.0, 0.0, 1.0, 0.0
};
static double at_close[] = {
    2.25, -1.492711345449275, 0.81427001953125, 1.588731266189806, 2.1357421875, -1.259453113929089,
    0.95001220703125, 1.366363355991266
};
static double at_close_from[] = {
    2.25, -1.492711345449275, 0.81427001953125, 1.588731266189806, 2.1357421875, -1.259453113929089,
    0.95001220703125, 1.366363355991266
};
static double at_coupling[] = {
    1.0, 0.0, -1.114625293717916, 0.7770549316240707, 0.0, 1.0, 0.7141122496232772,
    -1.042153154482043, 1.0, 0.0, -1.135898777557682, 0.7653906677242563, 0.0, 1.0,
    0.6857950550251212, -1.054833163040424
};

static double out[STATES * 80], product[STATES * N], worst;
static int failed;
static int status[STATES];

static void empty(void)
{
    for (size_t i = 0; i < sizeof(out) / sizeof(*out); i++)
        out[i] = NAN;
}

/* Compares what a function gave with what it should; or takes it for that. */
static void compare(const char *name, const double *given, double *expected, int states, int length,
                    int taken)
{
    for (int k = 0; k < states * length; k++) {
        const double *const state = expected + k / length * length;
        double largest = LEAST, apart;

        if (taken)
            expected[k] = given[k];
        for (int i = 0; i < length; i++)
            largest = fmax(largest, fabs(state[i]));
        apart = fabs(given[k] - expected[k]) / largest;
        if (!(apart <= TOLERANCE)) {
            printf("%s: state %d, number %d: %.12g, expected %.12g\n", name, k / length, k % length,
                   given[k], expected[k]);
            failed = 1;
            return;
        }
        worst = fmax(worst, apart);
    }
    for (int i = 0; i < states; i++)
        if (status[i] != 0) {
            printf("%s: state %d: status %d\n", name, i, status[i]);
            failed = 1;
        }
}

/* Rows times parameters, into `product`. */
static void multiply(const double *rows, int columns, const double *parameters)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = 0.0;
        for (int k = 0; k < columns; k++)
            product[i] += rows[i * columns + k] * parameters[k];
    }
}

/* M qdd + c + g + f, into `product`. */
static void add_up(const double *M, const double *c, const double *g, const double *f)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = c[i] + g[i] + f[i];
        for (int k = 0; k < N; k++)
            product[i] += M[i * N + k] * qdd[i / N * N + k];
    }
}

/* Sines and cosines against those of <math.h>. */
static void compare_sines(void)
{
    for (int i = -400; i <= 400; i++) {
        const double angle = 0.37 * (double)i;
        double sine, cosine;

        modeler_sincos(angle, &sine, &cosine);
        if (!(fabs(sine - sin(angle)) + fabs(cosine - cos(angle)) <= 1e-15)) {
            printf("sine, cosine of %g: %g, %g\n", angle, sine, cosine);
            failed = 1;
            return;
        }
    }
}

int main(void)
{
    const char *const signature = five_bar_signature();

    if (strcmp(signature, FIVE_BAR_SIGNATURE) != 0) {
        printf("five_bar: the library is %s,\n", signature);
        printf("the header %s\n", FIVE_BAR_SIGNATURE);
        return 1;
    }
    compare_sines();
    {
        const modeler_input inputs[] = {
            {chi, 0},
        };
        empty();
        modeler_batch_1(five_bar_base_parameters,
            1, inputs, out, 11);
        compare("five_bar_base_parameters", out, beta, 1, C, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {qd, 2},
            {qdd, 2},
            {beta, 0},
        };
        empty();
        modeler_batch_status_4(five_bar_inverse_dynamics,
            2, inputs, out, 2, status);
        compare("five_bar_inverse_dynamics", out,
                at_inverse_dynamics, STATES, 2, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {beta, 0},
        };
        empty();
        modeler_batch_status_2(five_bar_gravity,
            2, inputs, out, 2, status);
        compare("five_bar_gravity", out,
                at_gravity, STATES, 2, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {qd, 2},
            {beta, 0},
        };
        empty();
        modeler_batch_status_3(five_bar_coriolis,
            2, inputs, out, 2, status);
        compare("five_bar_coriolis", out,
                at_coriolis, STATES, 2, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {qd, 2},
            {beta, 0},
        };
        empty();
        modeler_batch_status_3(five_bar_friction,
            2, inputs, out, 2, status);
        compare("five_bar_friction", out,
                at_friction, STATES, 2, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {beta, 0},
        };
        empty();
        modeler_batch_status_2(five_bar_inertia_matrix,
            2, inputs, out, 4, status);
        compare("five_bar_inertia_matrix", out,
                at_inertia_matrix, STATES, 4, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
        };
        empty();
        modeler_batch_status_1(five_bar_forward_kinematics,
            2, inputs, out, 48, status);
        compare("five_bar_forward_kinematics", out,
                at_forward_kinematics, STATES, 48, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
        };
        empty();
        modeler_batch_status_1(five_bar_close,
            2, inputs, out, 4, status);
        compare("five_bar_close", out,
                at_close, STATES, 4, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {start, 4},
        };
        empty();
        modeler_batch_status_2(five_bar_close_from,
            2, inputs, out, 4, status);
        compare("five_bar_close_from", out,
                at_close_from, STATES, 4, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
        };
        empty();
        modeler_batch_status_1(five_bar_coupling,
            2, inputs, out, 8, status);
        compare("five_bar_coupling", out,
                at_coupling, STATES, 8, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {qd, 2},
            {qdd, 2},
        };
        empty();
        modeler_batch_status_3(five_bar_regressor,
            2, inputs, out, 80, status);
        multiply(out, 40, chi);
        compare("five_bar_regressor", product,
                at_inverse_dynamics, STATES, N, 0);
    }
    {
        const modeler_input inputs[] = {
            {q, 2},
            {qd, 2},
            {qdd, 2},
        };
        empty();
        modeler_batch_status_3(five_bar_base_regressor,
            2, inputs, out, 22, status);
        multiply(out, 11, beta);
        compare("five_bar_base_regressor", product,
                at_inverse_dynamics, STATES, N, 0);
    }
    empty();
    five_bar_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("five_bar_observation", product,
            at_inverse_dynamics, STATES, N, 0);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("five_bar_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, 0);
    printf("five_bar %s:\n", signature);
    if (failed) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("13 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
