/* SR400, 6R arm with a parallelogram
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

#include "sr400.h"
#include "sr400_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "sr400_tile.h"

#define N 6
#define C 39
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if SR400_JOINTS != N || SR400_BASE_PARAMETERS != C \
    || SR400_STANDARD_PARAMETERS != 80
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef SR400_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_GEO_D2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_GEO_D3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_GEO_D4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_GEO_RL4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_GEO_D8
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
    1.213623046875, 33.10205078125, 1.990478515625, 1.87890625, 1.767333984375, 1.65576171875,
    33.544189453125, 1.4326171875, 1.321044921875, 33.20947265625, 1.097900390625, 33.986328125,
    1.874755859375, 1.76318359375, 1.651611328125, 1.5400390625, 33.428466796875, 1.31689453125,
    1.205322265625, 33.09375, 1.982177734375, 33.87060546875, 1.759033203125, 1.6474609375,
    1.535888671875, 1.42431640625
};
static double beta[] = {
    172.38819091796876, -3.88409423828125, 2.328125, 2.26910400390625, 3.65869140625,
    70.98907470703125, 7.950439453125, 1.341796875, 39.21084106445313, -0.47466064453125,
    2.8818359375, 0.77730712890625, 107.88553833007812, 2.134814453125, 6.655533854166666,
    33.775634765625, 1.77978515625, 1.668212890625, 1.445068359375, 66.7744140625, 1.221923828125,
    -0.772705078125, 33.659912109375, 1.6640625, 1.552490234375, 1.329345703125, 66.54296875,
    1.106201171875, 3.761962890625, 0.334716796875, 1.54833984375, 1.436767578125, 1.213623046875,
    33.10205078125, 1.990478515625, 1.87890625, 1.5523844401041667, 1.76318359375, 1.6474609375
};
static double at_inverse_dynamics[] = {
    -818.193131227033, -123.47245831929793, -448.9063636138819, -355.8889581561996,
    -234.93150790322966, -424.2261186378698, 9.75969757377101, 69.00037491717373, 168.9331432283558,
    -136.34524420841004, -19.032107259094843, -42.31767407857449
};
static double at_inertia_matrix[] = {
    267.30751974729037, -3.1556668951130984, 5.977729266400467, 59.60459123508735,
    4.878249075824567, -1.8785311379283474, -3.1556668951130984, 70.98907470703125,
    3.2254266546714296, -0.6828742463892655, 2.0026004601063567, -7.8451291639946525,
    5.977729266400467, 3.2254266546714296, 101.0968722426583, 2.9219893848385743, 32.80901004647232,
    1.5423878576923271, 59.60459123508735, -0.6828742463892655, 2.9219893848385743,
    66.09108999978265, 1.0791047438849457, 28.71461478163254, 4.878249075824567, 2.0026004601063567,
    32.80901004647232, 1.0791047438849457, 33.10205078125, -6.024731740947642, -1.8785311379283474,
    -7.8451291639946525, 1.5423878576923271, 28.71461478163254, -6.024731740947642,
    182.00253039308845, 267.637110284542, -3.5854342665587744, 83.66240980946145,
    12.961171794155145, 29.998500828728126, 0.07084125231968073, -3.5854342665587744,
    70.98907470703125, -0.11774772053441457, -3.7794617584886, 0.1525174214539521,
    -8.306846781873372, 83.66240980946145, -0.11774772053441457, 104.37754028370252,
    1.0096377261825769, 17.696512335823556, -0.07068158579751573, 12.961171794155145,
    -3.7794617584886, 1.0096377261825769, 65.41463275452836, -0.490592052408485, 65.75958558783856,
    29.998500828728126, 0.1525174214539521, 17.696512335823556, -0.490592052408485, 33.10205078125,
    -9.51903630524839, 0.07084125231968073, -8.306846781873372, -0.07068158579751573,
    65.75958558783856, -9.51903630524839, 179.97176508607282
};
static double at_gravity[] = {
    0.0, -65.20089337795137, -43.45718658088708, 17.511073422013688, -26.14352366856749,
    94.43373786643592, 0.0, -1.9713622782596, 0.9407070826742997, 16.26884708989452,
    -8.261692536583947, 88.11611733779391
};
static double at_coriolis[] = {
    -341.05261653531994, -9.952639638614315, -335.75152970805794, -306.06788227938245,
    -125.34814660512824, -298.32285952414196, 0.0004893555052430756, -0.0043108465834815176,
    -0.018102847460886716, -0.0042144703913555535, 0.005012173457032163, -0.014907350836547179
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_forward_kinematics[] = {
    0.4866896677019633, 0.8735749351670711, 0.0, 0.0, -0.8735749351670711, 0.4866896677019633, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, 0.463118288431404, -0.14962714849991077, 0.8735749351670711,
    0.146006900310589, -0.8312659085232449, 0.26857058044241683, 0.4866896677019633,
    -0.26207248055012133, -0.30743851458038085, -0.9515679480481722, 0.0, 0.0, -0.03039830464559933,
    -0.4857394113334029, 0.8735749351670711, 0.493345616634142, 0.05456289453473677,
    0.8718692894534958, 0.4866896677019633, -0.885521911942555, -0.9980475107000991,
    0.0624593178423802, 0.0, -0.23057888593528564, 0.7988172982269811, -0.3548917417055875,
    -0.4857394113334029, 0.10019434187057977, 0.47177937629139327, -0.13140837954240306,
    0.8718692894534958, -0.17984204619954786, -0.37324943959696744, -0.9256261067273407,
    0.0624593178423802, -0.33031855826639633, 0.6942732499117451, -0.6261281866568205,
    0.3548917417055875, 0.10019434187057977, 0.6260299567777583, 0.7686470783154502,
    0.13140837954240306, -0.17984204619954786, -0.3550649907746773, 0.13093953899019206,
    0.9256261067273407, -0.33031855826639633, 0.5204595921082178, 0.5805904811968496,
    -0.6261281866568205, 0.10019434187057977, 0.2869583011589891, 0.5716962501128279,
    0.7686470783154502, -0.17984204619954786, 0.8042243134713688, -0.5797224256060322,
    0.13093953899019206, -0.33031855826639633, 0.4857394113334029, -0.03039830464559933,
    0.8735749351670711, 0.146006900310589, -0.8718692894534958, 0.05456289453473677,
    0.4866896677019633, -0.26207248055012133, -0.0624593178423802, -0.9980475107000991, 0.0, 0.0,
    0.463118288431404, -0.14962714849991077, 0.8735749351670711, 0.31601569427728005,
    -0.8312659085232449, 0.26857058044241683, 0.4866896677019633, -0.5672267318588449,
    -0.30743851458038085, -0.9515679480481722, 0.0, -0.02186076124483307, -0.4857394113334029,
    0.03039830464559933, 0.8735749351670711, 0.6633544106008331, 0.8718692894534958,
    -0.05456289453473677, 0.4866896677019633, -1.1906761632512786, 0.0624593178423802,
    0.9980475107000991, 0.0, -0.2524396471801187, 0.9824733131012553, 0.18640329676226988, 0.0, 0.0,
    -0.18640329676226988, 0.9824733131012553, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.36742500692856345,
    -0.9111820209155261, 0.18640329676226988, 0.2947419939303766, -0.06971103610762959,
    0.17287729893957626, 0.9824733131012553, -0.055920989028680965, -0.9274369173848677,
    -0.37397963082453317, 0.0, 0.0, -0.7919531770612147, -0.5814326928362435, 0.18640329676226988,
    0.5703107491267991, 0.15025617603757735, 0.1103144170378805, 0.9824733131012553,
    -0.10820426610940316, -0.5918050750924775, 0.806081108260693, 0.0, -0.6955776880386507,
    -0.6962897069768926, -0.42085231098240083, -0.5814326928362435, -0.013628381701377859,
    0.44502909710835775, -0.8886955789923299, 0.1103144170378805, 0.0025856939265378404,
    -0.5631427409502433, -0.18194367320756202, 0.806081108260693, -0.13948356269396797,
    -0.8468020330613183, 0.3252839515623089, 0.42085231098240083, -0.013628381701377859,
    0.3129589731012311, -0.33507737768299195, 0.8886955789923299, 0.0025856939265378404,
    0.430096498426389, 0.8842587301356425, 0.18194367320756202, -0.13948356269396797,
    -0.5887397367471929, -0.7399836979493909, 0.3252839515623089, -0.013628381701377859,
    0.6600017368871817, -0.6723993294694701, -0.33507737768299195, 0.0025856939265378404,
    0.4666725079547212, 0.01741460588562528, 0.8842587301356425, -0.13948356269396797,
    0.5814326928362435, -0.7919531770612147, 0.18640329676226988, 0.2947419939303766,
    -0.1103144170378805, 0.15025617603757735, 0.9824733131012553, -0.055920989028680965,
    -0.806081108260693, -0.5918050750924775, 0.0, 0.0, 0.36742500692856345, -0.9111820209155261,
    0.18640329676226988, 0.4982434364230618, -0.06971103610762959, 0.17287729893957626,
    0.9824733131012553, -0.09453103499193914, -0.9274369173848677, -0.37397963082453317, 0.0,
    -0.28212838789124256, -0.5814326928362435, 0.7919531770612147, 0.18640329676226988,
    0.7738121916194844, 0.1103144170378805, -0.15025617603757735, 0.9824733131012553,
    -0.14681431207266132, 0.806081108260693, 0.5918050750924775, 0.0, -0.9777060759298933
};

static double out[STATES * 480], worst;
static double product[STATES * N];
static int failed;

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("sr400: the %s is %s,\nthe header %s\n", part, signature, header);
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
        for (int k = 0; k < SR400_NONZEROS; k++) {
            product[i * N + sr400_nonzero_row[k]] +=
                values[i * SR400_NONZEROS + k]
                * parameters[sr400_nonzero_column[k]];
        }
    }
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = SR400_NONZEROS };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static double S[MANY * SIGNALS + 1], entries[MANY * LONG];

/* W by rows, W by columns, nonzeros, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work)
{
    const modeler_tiled *const robot = sr400_tiled();
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
    const size_t room = modeler_tile_work(sr400_tiled());
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
        modeler_batch_3(sr400_base_regressor_nonzeros, MANY, inputs, entries, LONG);
        modeler_batch_3(sr400_base_regressor, MANY, inputs, one, N * C);
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
    if (!belongs("library", sr400_signature(),
            SR400_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", sr400_tile_signature(),
            SR400_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(sr400_base_parameters, 1, inputs,
            out, 39);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("sr400_base_parameters", out,
            beta, 1, 39, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, {beta, 0}, };

        modeler_batch_4(sr400_inverse_dynamics, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("sr400_inverse_dynamics", out,
            at_inverse_dynamics, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {beta, 0}, };

        modeler_batch_2(sr400_inertia_matrix, 2, inputs,
            out, 36);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("sr400_inertia_matrix", out,
            at_inertia_matrix, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {beta, 0}, };

        modeler_batch_2(sr400_gravity, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("sr400_gravity", out,
            at_gravity, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {beta, 0}, };

        modeler_batch_3(sr400_coriolis, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("sr400_coriolis", out,
            at_coriolis, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {qd, 6}, {beta, 0}, };

        modeler_batch_2(sr400_friction, 2, inputs,
            out, 6);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("sr400_friction", out,
            at_friction, 2, 6, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, };

        modeler_batch_1(sr400_forward_kinematics, 2, inputs,
            out, 108);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("sr400_forward_kinematics", out,
            at_forward_kinematics, 2, 108, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(sr400_regressor, 2, inputs,
            out, 480);
    }
    multiply(out, 80, chi);
    compare("sr400_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(sr400_base_regressor, 2, inputs,
            out, 234);
    }
    multiply(out, 39, beta);
    compare("sr400_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 6}, {qd, 6}, {qdd, 6}, };

        modeler_batch_3(sr400_base_regressor_nonzeros, 2, inputs,
            out, 126);
    }
    multiply_nonzeros(out, beta);
    compare("sr400_base_regressor_nonzeros", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    sr400_observation(STATES, q, qd, qdd, out);
    multiply(out, C, beta);
    compare("sr400_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("sr400_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("sr400 %s:\n", SR400_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("11 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
