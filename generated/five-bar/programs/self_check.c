/* Planar five-bar, two actuated joints at the base
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * every function gives at stored states what the equations of motion give there, evaluated with 40
 * digits and not by this code. Prints what differs and one line more; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "five_bar.h"
#include "five_bar_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "five_bar_tile.h"

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

/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    2.21038818359375, 0.94146728515625, 2.1495361328125, 0.8919677734375
};
static double qd[] = {
    1.0, -1.3125, -0.0185546875, 0.0234375
};
static double qdd[] = {
    -2.125, -0.875, -0.375, 0.875
};
static double chi[] = {
    33.238525390625, 1.126953125, 1.015380859375, 33.90380859375, 1.792236328125, 33.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 33.122802734375, 1.01123046875,
    1.899658203125, 33.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 33.67236328125,
    1.560791015625, 33.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    33.891357421875, 1.77978515625, 1.668212890625, 33.556640625, 1.445068359375, 33.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125
};
static double beta[] = {
    34.04318359375, 2.777490234375, 1.45751953125, 34.030436197916664, 2.6171061197916665,
    1.341796875, 33.35099153645833, 1.0207845052083333, 1.22607421875, 32.8202880859375,
    1.1103515625
};
static double start[] = {
    2.1495361328125, -1.319676666861738, 0.8919677734375, 1.4368442870263094, 2.21038818359375,
    -1.350132251110884, 0.94146728515625, 1.4270768889925665
};
static double at_inverse_dynamics[] = {
    -134.76945474141746, -36.83154365182733, -56.04163732168564, 51.71165524392496
};
static double at_gravity[] = {
    -33.84787879730468, 1.8281897924623383, -33.38160824854484, 3.155057060920931
};
static double at_coriolis[] = {
    2.420399765868296, -0.8349636927842448, 0.0012407967559906986, 0.0003433504053242518
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0
};
static double at_inertia_matrix[] = {
    50.3915093272485, -4.274264697625131, -4.274264697625131, 53.60866541023866, 50.29058576362389,
    -4.345485952614664, -4.345485952614664, 53.63051154327795
};
static double at_forward_kinematics[] = {
    -0.5968680217005637, -0.8023394323297686, 0.0, 0.0, 0.8023394323297686, -0.5968680217005637,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6522434902696306, -0.7580095180147083, 0.0,
    -0.17906040651016913, 0.7580095180147083, 0.6522434902696306, 0.0, 0.24070182969893059, 0.0,
    0.0, 1.0, 0.0, 0.5886024725579445, -0.808422618002907, 0.0, 0.2, 0.808422618002907,
    0.5886024725579445, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.7157851830839993, -0.6983205364855065, 0.0,
    0.3824667664929628, 0.6983205364855065, -0.7157851830839993, 0.0, 0.25061101158090116, 0.0, 0.0,
    1.0, 0.0, -0.5469693967176524, -0.8371526020113222, 0.0, 0.0, 0.8371526020113222,
    -0.5469693967176524, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6749794578902304, -0.7378365207999741, 0.0,
    -0.16409081901529574, 0.7378365207999741, 0.6749794578902304, 0.0, 0.2511457806033967, 0.0, 0.0,
    1.0, 0.0, 0.6278817078337691, -0.7783087825328386, 0.0, 0.2, 0.7783087825328386,
    0.6278817078337691, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.6874818221135047, -0.7262015865195389, 0.0,
    0.3946433294284684, 0.7262015865195389, -0.6874818221135047, 0.0, 0.24127572258517996, 0.0, 0.0,
    1.0, 0.0
};
static double at_close[] = {
    2.21038818359375, -1.350132251110884, 0.94146728515625, 1.4270768889925665, 2.1495361328125,
    -1.319676666861738, 0.8919677734375, 1.4368442870263094
};
static double at_close_from[] = {
    2.21038818359375, -1.350132251110884, 0.94146728515625, 1.4270768889925665, 2.1495361328125,
    -1.319676666861738, 0.8919677734375, 1.4368442870263094
};
static double at_coupling[] = {
    1.0, 0.0, -1.1183542554446448, 0.7685107448112802, 0.0, 1.0, 0.6983297720607691,
    -1.0599930116552918, 1.0, 0.0, -1.1340837537066526, 0.7700438645571115, 0.0, 1.0,
    0.6936714346412841, -1.0459308652490307
};

static double out[STATES * 80], worst;
static double product[STATES * N];
static int failed;
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("five_bar: the %s is %s,\nthe header %s\n", part, signature, header);
    return 0;
}

static void empty(void)
{
    for (size_t i = 0; i < sizeof(out) / sizeof(*out); i++) {
        out[i] = NAN;
    }
}

/* Compares what a function gave with what it should. */
static void compare(const char *name, const double *given, const double *expected, int states,
                    int length, double tolerance)
{
    for (int k = 0; k < states * length; k++) {
        const double *const state = expected + k / length * length;
        double largest = LEAST, apart;

        for (int i = 0; i < length; i++) {
            largest = fmax(largest, fabs(state[i]));
        }
        apart = fabs(given[k] - expected[k]) / largest;
        if (!(apart <= tolerance)) {
            printf("%s: state %d, number %d: %.12g, expected %.12g\n", name, k / length, k % length,
                   given[k], expected[k]);
            failed = 1;
            return;
        }
        worst = fmax(worst, apart);
    }
    for (int i = 0; i < STATES; i++) {
        if (status[i] != 0) {
            printf("%s: state %d: status %d\n", name, i, status[i]);
            failed = 1;
        }
    }
}

/* Rows times parameters, into `product`. */
static void multiply(const double *rows, int columns, const double *parameters)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = 0.0;
        for (int k = 0; k < columns; k++) {
            product[i] += rows[i * columns + k] * parameters[k];
        }
    }
}

/* M qdd + c + g + f, into `product`. */
static void add_up(const double *M, const double *c, const double *g, const double *f)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = c[i] + g[i] + f[i];
        for (int k = 0; k < N; k++) {
            product[i] += M[i * N + k] * qdd[i / N * N + k];
        }
    }
}

/* Many samples side by side, about the first state, against one after another. */
static void compare_tiles(void)
{
    enum { MANY = 19 };
    static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], W[MANY * N * C], one[MANY * N * C];
    const modeler_tiled *const robot = five_bar_tiled();
    void *const work = malloc(modeler_tile_work(robot));
    int closed[MANY], told[MANY];

    for (int i = 0; i < MANY * N; i++) {
        Q[i] = q[i % N] + 1e-4 * (double)(i / N);
        QD[i] = qd[i % N];
        QDD[i] = qdd[i % N];
    }
    if (work == NULL) {
        failed = 1;
        return;
    }
    modeler_tile_closed(robot, MANY, Q, QD, QDD, W, 0, closed, work);
    five_bar_observation(MANY, Q, QD, QDD, one, told);
    compare("tiles", W, one, MANY, N * C, 1e-11);
    for (int i = 0; i < MANY; i++) {
        failed |= closed[i] != told[i];
    }
    free(work);
}

/* Sines and cosines against those of <math.h>. */
static void compare_sines(void)
{
    for (int i = -400; i <= 400 && !failed; i++) {
        const double angle = 0.37 * (double)i, expected[] = {sin(angle), cos(angle)};
        double given[2];

        modeler_sincos(angle, given, given + 1);
        compare("modeler_sincos", given, expected, 1, 2, 1e-15);
    }
}

int main(void)
{
    if (!belongs("library", five_bar_signature(),
            FIVE_BAR_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", five_bar_tile_signature(),
            FIVE_BAR_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(five_bar_base_parameters, 1, inputs,
            out, 11);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("five_bar_base_parameters", out,
            beta, 1, 11, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, {beta, 0}, };

        modeler_batch_status_4(five_bar_inverse_dynamics, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("five_bar_inverse_dynamics", out,
            at_inverse_dynamics, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {beta, 0}, };

        modeler_batch_status_2(five_bar_gravity, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("five_bar_gravity", out,
            at_gravity, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {beta, 0}, };

        modeler_batch_status_3(five_bar_coriolis, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("five_bar_coriolis", out,
            at_coriolis, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {beta, 0}, };

        modeler_batch_status_3(five_bar_friction, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("five_bar_friction", out,
            at_friction, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {beta, 0}, };

        modeler_batch_status_2(five_bar_inertia_matrix, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("five_bar_inertia_matrix", out,
            at_inertia_matrix, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_forward_kinematics, 2, inputs,
            out, 48, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("five_bar_forward_kinematics", out,
            at_forward_kinematics, 2, 48, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_close, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("five_bar_close", out,
            at_close, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {start, 4}, };

        modeler_batch_status_2(five_bar_close_from, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("five_bar_close_from", out,
            at_close_from, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_coupling, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("five_bar_coupling", out,
            at_coupling, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, };

        modeler_batch_status_3(five_bar_regressor, 2, inputs,
            out, 80, status);
    }
    multiply(out, 40, chi);
    compare("five_bar_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, };

        modeler_batch_status_3(five_bar_base_regressor, 2, inputs,
            out, 22, status);
    }
    multiply(out, 11, beta);
    compare("five_bar_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    five_bar_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("five_bar_observation", product, at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("five_bar_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("five_bar %s:\n", FIVE_BAR_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("13 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
