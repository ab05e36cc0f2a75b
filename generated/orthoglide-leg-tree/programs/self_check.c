/* One leg of the Orthoglide, cut open
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

#include "orthoglide_leg_tree.h"
#include "orthoglide_leg_tree_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "orthoglide_leg_tree_tile.h"

#define N 6
#define C 32
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if ORTHOGLIDE_LEG_TREE_JOINTS != N || ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS != C \
    || ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS != 60
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef ORTHOGLIDE_LEG_TREE_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_LEG_TREE_GEO_D4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_LEG_TREE_GEO_b3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_LEG_TREE_GEO_b7
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    -1.0625, 0.3125, -1.1875, 0.1875, -1.3125, 0.0625, -0.1875, 1.1875, -0.3125, 1.0625, -0.4375,
    0.9375
};
static double qd[] = {
    1.0, -1.3125, 1.625, -1.125, 1.4375, -1.75, -0.0185546875, 0.0234375, -0.015625, 0.0205078125,
    -0.025390625, 0.017578125
};
static double qdd[] = {
    -2.125, -0.875, 0.375, 1.625, -2.875, -1.625, -0.375, 0.875, 2.125, -2.375, -1.125, 0.125
};
static double chi[] = {
    33.238525390625, 1.126953125, 1.015380859375, 33.90380859375, 1.792236328125, 33.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 33.122802734375, 1.01123046875,
    1.899658203125, 33.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 33.67236328125,
    1.560791015625, 33.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    33.891357421875, 1.77978515625, 1.668212890625, 33.556640625, 1.445068359375, 33.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 33.775634765625, 1.6640625,
    1.552490234375, 33.44091796875, 1.329345703125, 33.2177734375, 1.106201171875, 1.99462890625,
    1.883056640625, 1.771484375, 33.659912109375, 1.54833984375, 1.436767578125, 33.3251953125,
    1.213623046875, 33.10205078125, 1.990478515625, 1.87890625, 1.767333984375, 1.65576171875
};
static double beta[] = {
    8.67041015625, 134.47074086914063, 1.453369140625, 6.222412109375, -1.016883447265625,
    1.8955078125, 1.16431396484375, 1.560791015625, 33.80081899414063, 2.4718408203125,
    1.22607421875, 33.775634765625, 1.77978515625, 1.668212890625, 1.445068359375, 66.7744140625,
    1.221923828125, -0.772705078125, 0.334716796875, 1.6640625, 1.552490234375, 1.329345703125,
    33.2177734375, 1.106201171875, 1.99462890625, 0.334716796875, 1.54833984375, 1.436767578125,
    1.213623046875, 33.10205078125, 1.990478515625, 1.87890625
};
static double at_inverse_dynamics[] = {
    23.193469306690776, -175.65831729177384, 239.3796081529563, 200.2333641137297,
    -136.9518706841693, -38.30396705473363, 1.24175575553303, 118.84111055312869,
    106.54439903999744, 8.946545018206228, -26.739261309095717, -1.7504599687392601
};
static double at_inertia_matrix[] = {
    8.67041015625, -4.528802506516393, -1.580285530093216, -1.0164587748150502, -2.196959993914295,
    0.614742259158303, -4.528802506516393, 166.8759772185194, -0.6345082497914306,
    -1.291637620101791, 19.619161677749982, -1.3009929836895997, -1.580285530093216,
    -0.6345082497914306, 102.24661983909462, 67.35558919415286, -1.1290688692888267, 0.0,
    -1.0164587748150502, -1.291637620101791, 67.35558919415286, 66.2653775433517,
    -1.1614290071585522, 0.0, -2.196959993914295, 19.619161677749982, -1.1290688692888267,
    -1.1614290071585522, 33.2177734375, 0.0, 0.614742259158303, -1.3009929836895997, 0.0, 0.0, 0.0,
    33.10205078125, 8.67041015625, 4.536844304675597, 1.7930437472733314, 1.4158052026908212,
    0.21724852395831631, 2.5193206022847536, 4.536844304675597, 170.60467248300807,
    -3.6889622095302395, -2.4341904428830734, 23.50746730847487, -1.8763794800778526,
    1.7930437472733314, -3.6889622095302395, 100.70265193435817, 66.22954441718986,
    0.18402022510914537, 0.0, 1.4158052026908212, -2.4341904428830734, 66.22954441718986,
    65.55725589416218, 0.5463862760484332, 0.0, 0.21724852395831631, 23.50746730847487,
    0.18402022510914537, 0.5463862760484332, 33.2177734375, 0.0, 2.5193206022847536,
    -1.8763794800778526, 0.0, 0.0, 0.0, 33.10205078125
};
static double at_gravity[] = {
    0.0, 0.0, 32.04087158968079, 11.8173151522388, -4.622780079397156, 18.337214233825964, 0.0, 0.0,
    53.96809869876655, 27.19595207755799, -8.94764880511874, -3.301806095552644
};
static double at_coriolis[] = {
    34.58243746700824, 17.36228539945609, 52.38404721389568, 48.84719829608518, -22.019042528380325,
    -2.6823903290453477, 0.005229705138015863, 0.0016292951983923308, -0.01441093664005258,
    -0.013178048158811064, -0.002558657962523852, 0.00016705008203756074
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_forward_kinematics[] = {
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0625, 0.9515679480481722,
    -0.30743851458038085, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.30743851458038085, -0.9515679480481722,
    0.0, -1.0625, 0.355867029915514, 0.8825192444200407, -0.30743851458038085, 0.0,
    0.9274369173848677, -0.37397963082453317, 0.0, -0.04, -0.1149757421840137, -0.28512982824781113,
    -0.9515679480481722, -1.0625, 0.5141343565206417, 0.8007168183557247, -0.30743851458038085,
    0.11031877927380934, 0.8414709848078965, -0.5403023058681398, 0.0, 0.24750544438930897,
    -0.16610973834045548, -0.2587005896318299, -0.9515679480481722, -1.0981424800770443,
    0.4285669958205608, 0.41854857172809073, -0.8007168183557247, 0.11031877927380934,
    0.21494010337711905, 0.8135564948015623, 0.5403023058681398, 0.24750544438930897,
    0.8775711264926467, -0.40366189177400774, 0.2587005896318299, -1.0981424800770443,
    0.9497100218114796, -0.05943428491576232, -0.30743851458038085, 0.0, -0.0624593178423802,
    -0.9980475107000991, 0.0, 0.04, -0.30683824417028527, 0.019202399899165248, -0.9515679480481722,
    -1.0625, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -0.1875, 0.37397963082453317,
    -0.9274369173848677, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.9274369173848677, -0.37397963082453317,
    0.0, -0.1875, 0.355867029915514, 0.1149757421840137, -0.9274369173848677, 0.0,
    0.30743851458038085, -0.9515679480481722, 0.0, -0.04, -0.8825192444200407, -0.28512982824781113,
    -0.37397963082453317, -0.1875, 0.2736367330598518, -0.2549190118292191, -0.9274369173848677,
    0.11031877927380934, -0.6816387600233341, -0.7316888688738209, 0.0, 0.055305939519918065,
    -0.6785952690331571, 0.6321769503660846, -0.37397963082453317, -0.4610809657702126,
    0.6407968990439626, -0.7241516633852718, 0.2549190118292191, 0.11031877927380934,
    -0.6174377159826243, -0.2887941586118195, 0.7316888688738209, 0.055305939519918065,
    -0.4562345899400896, -0.6262605706637097, -0.6321769503660846, -0.4610809657702126,
    0.2213230435031699, -0.30145791528196453, -0.9274369173848677, 0.0, -0.806081108260693,
    -0.5918050750924775, 0.0, 0.04, -0.5488618745364875, 0.747589378207475, -0.37397963082453317,
    -0.1875
};

static double out[STATES * 360], worst;
static double product[STATES * N];
static int failed;

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("orthoglide_leg_tree: the %s is %s,\nthe header %s\n", part, signature, header);
    return 0;
}

static void empty(void)
{
    volatile double stack[4096]; /* what functions do not write must show there too */

    for (int i = 0; i < 4096; i++) {
        stack[i] = NAN;
    }
    worst = fmax(worst, stack[4095]);
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

/* The same as `multiply` of the entries that are not always 0. */
static void multiply_nonzeros(const double *values, const double *parameters)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = 0.0;
    }
    for (int i = 0; i < STATES; i++) {
        for (int k = 0; k < ORTHOGLIDE_LEG_TREE_NONZEROS; k++) {
            product[i * N + orthoglide_leg_tree_nonzero_row[k]] +=
                values[i * ORTHOGLIDE_LEG_TREE_NONZEROS + k]
                * parameters[orthoglide_leg_tree_nonzero_column[k]];
        }
    }
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = ORTHOGLIDE_LEG_TREE_NONZEROS };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static double S[MANY * SIGNALS + 1], entries[MANY * LONG];

/* W by rows, W by columns, nonzeros, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work)
{
    const modeler_tiled *const robot = orthoglide_leg_tree_tiled();
    const size_t room = modeler_tile_work(robot), rows = kind == 1 ? (size_t)(samples * N + 3) : 0;
    const int length = kind == 2 ? LONG : N * C;
    double *const W = results + GUARD + phase;
    int touched = 0;

    memset(work, 0xff, room);
    memset(work + room, 0x5a, SPARE);
    for (size_t i = 0; i < sizeof(results) / sizeof(*results); i++) {
        results[i] = -7;
    }
    if (kind == 0) {
        modeler_tile_observation(robot, (size_t)samples, Q, QD, QDD, S, W, work);
    } else if (kind == 1) {
        modeler_tile_columns(robot, (size_t)samples, Q, QD, QDD, S, W, rows, work);
    } else {
        modeler_tile_nonzeros(robot, (size_t)samples, Q, QD, QDD, S, W, work);
    }
    for (int i = 0; i < samples; i++) {
        const double *const right = kind == 2 ? entries + i * LONG : one + i * N * C;
        double largest = LEAST;

        for (int k = 0; k < length; k++) {
            largest = fmax(largest, fabs(right[k]));
        }
        for (int k = 0; k < length; k++) {
            const size_t place = kind == 1 ? (size_t)(k % C) * rows + (size_t)(i * N + k / C)
                                           : (size_t)(i * length + k);
            double *const given = W + place;

            touched |= !(fabs(*given - right[k]) <= ROUNDINGS * largest);
            *given = -7;
        }
    }
    for (size_t i = 0; i < sizeof(results) / sizeof(*results); i++) {
        touched |= !(results[i] + 7 == 0);
    }
    for (int i = 0; i < SPARE; i++) {
        touched |= work[room + (size_t)i] != 0x5a;
    }
    if (touched != 0 && !failed) {
        printf("tiles: %d samples, kind %d, place %d: not what single samples give\n", samples,
               kind, phase);
    }
    failed |= touched;
}

static void compare_tiles(void)
{
    static const int counts[] = {1, 7, 8, 9, MANY};
    const size_t room = modeler_tile_work(orthoglide_leg_tree_tiled());
    unsigned char *const work = (unsigned char *)malloc(room + SPARE);
    const modeler_input inputs[] = { {Q, N}, {QD, N}, {QDD, N}, {S, SIGNALS} };

    if (work == NULL) {
        failed = 1;
        return;
    }
    for (int way = 0; way < 1; way++) {
        for (int i = 0; i < MANY * N; i++) {
            Q[i] = q[i % (STATES * N)] + 0.1 * (double)(i / N);
            QD[i] = qd[i % (STATES * N)];
            QDD[i] = qdd[i % (STATES * N)] - 0.1 * (double)(i / N);
        }
        modeler_batch_3(orthoglide_leg_tree_base_regressor_nonzeros, MANY, inputs, entries, LONG);
        modeler_batch_3(orthoglide_leg_tree_base_regressor, MANY, inputs, one, N * C);
        for (int k = 0; k < 3 * 5 * 8; k++) {
            compare_tile(k / 40, counts[k / 8 % 5], k % 8, work);
        }
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
    /* Where a sine is small, its digits count. */
    for (int i = -60000; i <= 60000 && !failed; i += 997) {
        const double angle = 1.5707963267948966 * i, expected[] = {sin(angle), cos(angle)};
        double given[2];

        modeler_sincos(angle, given, given + 1);
        for (int k = 0; k < 2; k++) {
            failed |= !(fabs(given[k] - expected[k]) <= 1e-9 * fabs(expected[k]));
        }
        if (failed != 0) {
            printf("modeler_sincos: %.17g\n", angle);
        }
    }
}

int main(void)
{
    if (!belongs("library", orthoglide_leg_tree_signature(),
            ORTHOGLIDE_LEG_TREE_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", orthoglide_leg_tree_tile_signature(),
            ORTHOGLIDE_LEG_TREE_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(orthoglide_leg_tree_base_parameters, 1, inputs,
            out, 32);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("orthoglide_leg_tree_base_parameters", out,
            beta, 1, 32, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, {beta, 0}, };

        modeler_batch_4(orthoglide_leg_tree_inverse_dynamics, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("orthoglide_leg_tree_inverse_dynamics", out,
            at_inverse_dynamics, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {beta, 0}, };

        modeler_batch_2(orthoglide_leg_tree_inertia_matrix, 2, inputs,
            out, 36);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("orthoglide_leg_tree_inertia_matrix", out,
            at_inertia_matrix, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {beta, 0}, };

        modeler_batch_2(orthoglide_leg_tree_gravity, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("orthoglide_leg_tree_gravity", out,
            at_gravity, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {beta, 0}, };

        modeler_batch_3(orthoglide_leg_tree_coriolis, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("orthoglide_leg_tree_coriolis", out,
            at_coriolis, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {qd, 6}, {beta, 0}, };

        modeler_batch_2(orthoglide_leg_tree_friction, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("orthoglide_leg_tree_friction", out,
            at_friction, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, };

        modeler_batch_1(orthoglide_leg_tree_forward_kinematics, 2, inputs,
            out, 72);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("orthoglide_leg_tree_forward_kinematics", out,
            at_forward_kinematics, 2, 72, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(orthoglide_leg_tree_regressor, 2, inputs,
            out, 360);
    }
    multiply(out, 60, chi);
    compare("orthoglide_leg_tree_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(orthoglide_leg_tree_base_regressor, 2, inputs,
            out, 192);
    }
    multiply(out, 32, beta);
    compare("orthoglide_leg_tree_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(orthoglide_leg_tree_base_regressor_nonzeros, 2, inputs,
            out, 88);
    }
    multiply_nonzeros(out, beta);
    compare("orthoglide_leg_tree_base_regressor_nonzeros", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    orthoglide_leg_tree_observation(STATES, q, qd, qdd, out);
    multiply(out, C, beta);
    compare("orthoglide_leg_tree_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("orthoglide_leg_tree_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("orthoglide_leg_tree %s:\n", ORTHOGLIDE_LEG_TREE_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("11 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
