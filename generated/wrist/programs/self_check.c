/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
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

#include "wrist.h"
#include "wrist_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "wrist_tile.h"

#define N 3
#define C 17
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if WRIST_JOINTS != N || WRIST_BASE_PARAMETERS != C \
    || WRIST_STANDARD_PARAMETERS != 30
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef WRIST_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef WRIST_GEO_al1
#undef REPLACED
#define REPLACED 1
#endif
#ifdef WRIST_GEO_bl1
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    -1.0625, 0.3125, -1.1875, -0.1875, 1.1875, -0.3125
};
static double qd[] = {
    1.0, -1.3125, 1.625, -0.0185546875, 0.0234375, -0.015625
};
static double qdd[] = {
    -2.125, -0.875, 0.375, -0.375, 0.875, 2.125
};
static double chi[] = {
    33.238525390625, 1.126953125, 1.015380859375, 33.90380859375, 1.792236328125, 33.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 33.122802734375, 1.01123046875,
    1.899658203125, 33.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 33.67236328125,
    1.560791015625, 33.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875
};
static double beta[] = {
    67.46875, 1.569091796875, 0.227294921875, 33.240009765625, 1.01123046875, 1.899658203125,
    1.676513671875, 67.470234375, 1.453369140625, 2.556591796875, -0.665283203125, 1.8955078125,
    1.783935546875, 1.560791015625, 33.44921875, 1.337646484375, 1.22607421875
};
static double at_inverse_dynamics[] = {
    -152.1048532097732, -74.43074102951641, -30.7255757584769, -16.579348922031667,
    19.061897962058676, 65.24086060516701
};
static double at_inertia_matrix[] = {
    102.74684746013787, 3.4726530415158603, 32.42900311460502, 3.4726530415158603,
    65.58311279163942, 0.9925780417565672, 32.42900311460502, 0.9925780417565672, 33.44921875,
    103.27126266421551, 0.4605737967909322, 14.375703095021812, 0.4605737967909322,
    66.29829639238675, -0.8612033214018361, 14.375703095021812, -0.8612033214018361, 33.44921875
};
static double at_gravity[] = {
    34.563645046478875, -16.151784965436768, 17.584819585215286, -8.816118958666443,
    -36.95339978393445, 0.2938888286061526
};
static double at_coriolis[] = {
    22.546247839890388, 6.1134385761673355, 8.92628503013047, 0.012122386602174772,
    0.007060634430225854, 0.011823499670648404
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_forward_kinematics[] = {
    0.8735749351670711, -0.4866896677019633, 0.0, 0.0, 0.4866896677019633, 0.8735749351670711, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.2, 0.8312659085232449, -0.26857058044241683, 0.4866896677019633, 0.0,
    0.463118288431404, -0.14962714849991077, -0.8735749351670711, 0.0, 0.30743851458038085,
    0.9515679480481722, 0.0, 0.2, 0.7622504827231178, 0.5889346694746347, -0.26857058044241683,
    -0.026857058044241686, -0.6369888384403679, 0.7562122295587241, -0.14962714849991077,
    -0.014962714849991076, 0.1149757421840137, 0.28512982824781113, 0.9515679480481722,
    0.2951567948048172, 0.18640329676226988, -0.9824733131012553, 0.0, 0.0, 0.9824733131012553,
    0.18640329676226988, 0.0, 0.0, 0.0, 0.0, 1.0, 0.2, 0.06971103610762959, -0.17287729893957626,
    0.9824733131012553, 0.0, 0.36742500692856345, -0.9111820209155261, -0.18640329676226988, 0.0,
    0.9274369173848677, 0.37397963082453317, 0.0, 0.2, 0.3683849235799645, -0.9134582571690619,
    -0.17287729893957626, -0.01728772989395763, 0.2923223072351204, 0.29033600095929135,
    -0.9111820209155261, -0.09111820209155261, 0.8825192444200407, 0.28512982824781113,
    0.37397963082453317, 0.2373979630824533
};

static double out[STATES * 90], worst;
static double product[STATES * N];
static int failed;

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("wrist: the %s is %s,\nthe header %s\n", part, signature, header);
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
        for (int k = 0; k < WRIST_NONZEROS; k++) {
            product[i * N + wrist_nonzero_row[k]] +=
                values[i * WRIST_NONZEROS + k]
                * parameters[wrist_nonzero_column[k]];
        }
    }
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = WRIST_NONZEROS };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static double S[MANY * SIGNALS + 1], entries[MANY * LONG];

/* W by rows, W by columns, nonzeros, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work)
{
    const modeler_tiled *const robot = wrist_tiled();
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
    const size_t room = modeler_tile_work(wrist_tiled());
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
        modeler_batch_3(wrist_base_regressor_nonzeros, MANY, inputs, entries, LONG);
        modeler_batch_3(wrist_base_regressor, MANY, inputs, one, N * C);
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
    if (!belongs("library", wrist_signature(),
            WRIST_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", wrist_tile_signature(),
            WRIST_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(wrist_base_parameters, 1, inputs,
            out, 17);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("wrist_base_parameters", out,
            beta, 1, 17, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, {beta, 0}, };

        modeler_batch_4(wrist_inverse_dynamics, 2, inputs,
            out, 3);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("wrist_inverse_dynamics", out,
            at_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_2(wrist_inertia_matrix, 2, inputs,
            out, 9);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("wrist_inertia_matrix", out,
            at_inertia_matrix, 2, 9, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_2(wrist_gravity, 2, inputs,
            out, 3);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("wrist_gravity", out,
            at_gravity, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_3(wrist_coriolis, 2, inputs,
            out, 3);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("wrist_coriolis", out,
            at_coriolis, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {qd, 3}, {beta, 0}, };

        modeler_batch_2(wrist_friction, 2, inputs,
            out, 3);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("wrist_friction", out,
            at_friction, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_1(wrist_forward_kinematics, 2, inputs,
            out, 36);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("wrist_forward_kinematics", out,
            at_forward_kinematics, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_3(wrist_regressor, 2, inputs,
            out, 90);
    }
    multiply(out, 30, chi);
    compare("wrist_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_3(wrist_base_regressor, 2, inputs,
            out, 51);
    }
    multiply(out, 17, beta);
    compare("wrist_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_3(wrist_base_regressor_nonzeros, 2, inputs,
            out, 37);
    }
    multiply_nonzeros(out, beta);
    compare("wrist_base_regressor_nonzeros", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    wrist_observation(STATES, q, qd, qdd, out);
    multiply(out, C, beta);
    compare("wrist_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("wrist_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("wrist %s:\n", WRIST_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("11 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
