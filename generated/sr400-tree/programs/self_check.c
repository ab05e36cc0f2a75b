/* SR400, 6R arm with a parallelogram, cut open
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

#include "sr400_tree.h"
#include "sr400_tree_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "sr400_tree_tile.h"

#define N 8
#define C 50
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if SR400_TREE_JOINTS != N || SR400_TREE_BASE_PARAMETERS != C \
    || SR400_TREE_STANDARD_PARAMETERS != 80
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef SR400_TREE_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_TREE_GEO_D2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_TREE_GEO_D3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_TREE_GEO_D4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_TREE_GEO_RL4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef SR400_TREE_GEO_D8
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    -1.0625, 0.3125, -1.1875, 0.1875, -1.3125, 0.0625, -1.4375, -0.0625, -0.1875, 1.1875, -0.3125,
    1.0625, -0.4375, 0.9375, -0.5625, 0.8125
};
static double qd[] = {
    1.0, -1.3125, 1.625, -1.125, 1.4375, -1.75, 1.25, -1.5625, -0.0185546875, 0.0234375, -0.015625,
    0.0205078125, -0.025390625, 0.017578125, -0.0224609375, 0.02734375
};
static double qdd[] = {
    -2.125, -0.875, 0.375, 1.625, -2.875, -1.625, -0.375, 0.875, -0.375, 0.875, 2.125, -2.375,
    -1.125, 0.125, 1.375, 2.625
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
    172.22795288085936, -4.21881103515625, 1.01123046875, 1.06378173828125, 1.676513671875,
    37.11846923828125, 6.19140625, 1.341796875, 39.3710791015625, 0.95795654296875, 1.783935546875,
    1.560791015625, 73.7247314453125, 2.134814453125, 7.476416015625, 33.775634765625,
    1.77978515625, 1.668212890625, 1.445068359375, 66.7744140625, 1.221923828125, -0.772705078125,
    33.659912109375, 1.6640625, 1.552490234375, 1.329345703125, 66.54296875, 1.106201171875,
    3.761962890625, 0.334716796875, 1.54833984375, 1.436767578125, 1.213623046875, 33.10205078125,
    1.990478515625, 1.87890625, 0.160238037109375, 1.4326171875, 0.78348388671875, 1.097900390625,
    34.16080688476563, 2.3732666015625, 1.76318359375, 0.334716796875, 1.31689453125,
    1.205322265625, 1.982177734375, 33.87060546875, 1.759033203125, 1.6474609375
};
static double at_inverse_dynamics[] = {
    -747.5132405290892, -561.4664997093065, -500.3228113935516, 103.47093918840457,
    -436.2697382526008, -173.44388839844493, -35.26913934057787, -1.3084993636917654,
    73.05565957981113, 503.9007046414633, 472.676214808174, -176.5261111163621, 42.11162671320046,
    -92.50489400494958, 141.86260437302596, 123.60019061181309
};
static double at_inertia_matrix[] = {
    303.3254290708939, -3.689830734042951, -1.2480240646491265, -73.66334713174179,
    8.944937582166178, 16.629476609273894, 1.6927098651047476, 1.0620892110654632,
    -3.689830734042951, 188.70528745657344, 145.63588615145937, 2.17199845056084, 64.6406546371915,
    -5.204679053659416, 0.0, 0.0, -1.2480240646491265, 145.63588615145937, 139.68495408462655,
    0.6050179189326846, 64.71654121469963, -6.338325272223121, 0.0, 0.0, -73.66334713174179,
    2.17199845056084, 0.6050179189326846, 99.03640394128938, 0.0117228162713318, 7.142276137248239,
    0.0, 0.0, 8.944937582166178, 64.6406546371915, 64.71654121469963, 0.0117228162713318,
    66.73731339312583, -1.3009929836895997, 0.0, 0.0, 16.629476609273894, -5.204679053659416,
    -6.338325272223121, 7.142276137248239, -1.3009929836895997, 33.10205078125, 0.0, 0.0,
    1.6927098651047476, 0.0, 0.0, 0.0, 0.0, 0.0, 69.33236095067778, 34.52107976733108,
    1.0620892110654632, 0.0, 0.0, 0.0, 0.0, 0.0, 34.52107976733108, 33.87060546875,
    270.9161439001977, -7.195314476055493, -2.789145442975899, -62.450588363217385,
    -45.30514308362849, -23.047298249895704, -2.7296649162530024, -2.218758129567457,
    -7.195314476055493, 191.5877001715264, 150.5028623016207, 0.22389614302620306,
    35.46823535316772, -11.138293448976682, 0.0, 0.0, -2.789145442975899, 150.5028623016207,
    146.53649366999625, -0.7018290878673356, 33.4873952138986, -12.16798652609713, 0.0, 0.0,
    -62.450588363217385, 0.22389614302620306, -0.7018290878673356, 98.55347536080768,
    -1.2821061673418959, 30.03851783139969, 0.0, 0.0, -45.30514308362849, 35.46823535316772,
    33.4873952138986, -1.2821061673418959, 68.23770562633341, -1.8763794800778526, 0.0, 0.0,
    -23.047298249895704, -11.138293448976682, -12.16798652609713, 30.03851783139969,
    -1.8763794800778526, 33.10205078125, 0.0, 0.0, -2.7296649162530024, 0.0, 0.0, 0.0, 0.0, 0.0,
    68.04092593971426, 33.87536226184932, -2.218758129567457, 0.0, 0.0, 0.0, 0.0, 0.0,
    33.87536226184932, 33.87060546875
};
static double at_gravity[] = {
    0.0, -142.319221613151, -88.56999908940374, -16.962504069531555, -13.477950899269102,
    -18.55842789514046, -37.57933952887115, -17.341756130798778, 0.0, 55.49289768760593,
    65.99968105456743, 30.229751075004064, -3.113525958173194, -0.4338753609411362,
    -41.64026810692814, -12.721223075755706
};
static double at_coriolis[] = {
    66.44067564612641, -142.6297180507246, -164.578197534102, -183.721807057161,
    -181.75531230889808, -83.28076593507048, 1.7008992117303434, 1.5988214682140274,
    0.04205607473369121, 0.07754877742999729, 0.07802449754364671, -0.012035326268854792,
    -0.002732631345501396, -0.017980765077897004, 0.0001490318976566925, 0.0004169234694401921
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_forward_kinematics[] = {
    0.4866896677019633, 0.8735749351670711, 0.0, 0.0, -0.8735749351670711, 0.4866896677019633, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, 0.463118288431404, -0.14962714849991077, 0.8735749351670711,
    0.146006900310589, -0.8312659085232449, 0.26857058044241683, 0.4866896677019633,
    -0.26207248055012133, -0.30743851458038085, -0.9515679480481722, 0.0, 0.0, 0.3119665478975112,
    0.3735554920500532, 0.8735749351670711, 0.493345616634142, -0.5599587888123231,
    -0.6705067652037441, 0.4866896677019633, -0.885521911942555, 0.7675435022360271,
    -0.6409968581633251, 0.0, -0.23057888593528564, 0.14366156000560107, -0.9164156538034472,
    0.3735554920500532, 0.8389849924588112, -0.6408651250043887, -0.37378144599367225,
    -0.6705067652037441, -1.5059211424273986, 0.7540910075911702, -0.1430726392252541,
    -0.6409968581633251, -0.6282448471305417, -0.32446735668434645, 0.2343144978661656,
    0.9164156538034472, 0.8389849924588112, 0.48456515409588985, -0.7908754908750846,
    0.37378144599367225, -1.5059211424273986, 0.8123530918771096, 0.5653429702603727,
    0.1430726392252541, -0.6282448471305417, -0.38107253423889537, -0.8943603522845098,
    0.2343144978661656, 0.8389849924588112, 0.4602729116785096, -0.4033172506948852,
    -0.7908754908750846, -1.5059211424273986, 0.8018307617095598, -0.19353231139385088,
    0.5653429702603727, -0.6282448471305417, 0.06468200318269028, 0.482372336595002,
    0.8735749351670711, 0.146006900310589, -0.11609980750895446, -0.865825618729624,
    0.4866896677019633, -0.26207248055012133, 0.9911291909537616, -0.13290194445282522, 0.0, 0.0,
    0.034427065173821096, 0.4854705035647016, 0.8735749351670711, 0.1686456014245306,
    -0.061794246360763604, -0.8713866182521153, 0.4866896677019633, -0.3027074131782554,
    0.9974949866040544, -0.0707372016677029, 0.0, 0.3468952168338166, 0.9824733131012553,
    0.18640329676226988, 0.0, 0.0, -0.18640329676226988, 0.9824733131012553, 0.0, 0.0, 0.0, 0.0,
    1.0, 0.0, 0.36742500692856345, -0.9111820209155261, 0.18640329676226988, 0.2947419939303766,
    -0.06971103610762959, 0.17287729893957626, 0.9824733131012553, -0.055920989028680965,
    -0.9274369173848677, -0.37397963082453317, 0.0, 0.0, 0.6297623069272175, -0.7540910075911702,
    0.18640329676226988, 0.5703107491267991, -0.11948392757590091, 0.1430726392252541,
    0.9824733131012553, -0.10820426610940316, -0.7675435022360271, -0.6409968581633251, 0.0,
    -0.6955776880386507, 0.14366156000560107, -0.6408651250043887, -0.7540910075911702,
    0.06150228909294561, -0.9164156538034472, -0.37378144599367225, 0.1430726392252541,
    -0.011668743865585012, -0.3735554920500532, 0.6705067652037441, -0.6409968581633251,
    -1.323506699904715, 0.44962106252276307, -0.6221999611772817, 0.6408651250043887,
    0.06150228909294561, -0.8907183192161333, -0.25866639991244683, 0.37378144599367225,
    -0.011668743865585012, -0.06679652647172564, -0.738890317887116, -0.6705067652037441,
    -1.323506699904715, -0.25050124353972186, -0.7416982778030714, -0.6221999611772817,
    0.06150228909294561, -0.8284297840238128, 0.4967854531873825, -0.25866639991244683,
    -0.011668743865585012, 0.50095231302721, 0.4506527246177092, -0.738890317887116,
    -1.323506699904715, 0.8310982453930675, 0.5239556445546909, 0.18640329676226988,
    0.2947419939303766, -0.1576831154686433, -0.09940937651924671, 0.9824733131012553,
    -0.055920989028680965, 0.5333026735360201, -0.8459244992310679, 0.0, 0.0, 0.9519305970630177,
    -0.2430677875231591, 0.18640329676226988, 0.5856263798179502, -0.1806084696807789,
    0.04611691363708136, 0.9824733131012553, -0.11111007944270612, -0.24740395925452294,
    -0.9689124217106447, 0.0, 0.18665593573760705
};

static double out[STATES * 640], worst;
static double product[STATES * N];
static int failed;

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("sr400_tree: the %s is %s,\nthe header %s\n", part, signature, header);
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
        for (int k = 0; k < SR400_TREE_NONZEROS; k++) {
            product[i * N + sr400_tree_nonzero_row[k]] +=
                values[i * SR400_TREE_NONZEROS + k]
                * parameters[sr400_tree_nonzero_column[k]];
        }
    }
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = SR400_TREE_NONZEROS };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static double S[MANY * SIGNALS + 1], entries[MANY * LONG];

/* W by rows, W by columns, nonzeros, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work)
{
    const modeler_tiled *const robot = sr400_tree_tiled();
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
    const size_t room = modeler_tile_work(sr400_tree_tiled());
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
        modeler_batch_3(sr400_tree_base_regressor_nonzeros, MANY, inputs, entries, LONG);
        modeler_batch_3(sr400_tree_base_regressor, MANY, inputs, one, N * C);
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
    if (!belongs("library", sr400_tree_signature(),
            SR400_TREE_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", sr400_tree_tile_signature(),
            SR400_TREE_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(sr400_tree_base_parameters, 1, inputs,
            out, 50);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("sr400_tree_base_parameters", out,
            beta, 1, 50, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, {beta, 0}, };

        modeler_batch_4(sr400_tree_inverse_dynamics, 2, inputs,
            out, 8);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("sr400_tree_inverse_dynamics", out,
            at_inverse_dynamics, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {beta, 0}, };

        modeler_batch_2(sr400_tree_inertia_matrix, 2, inputs,
            out, 64);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("sr400_tree_inertia_matrix", out,
            at_inertia_matrix, 2, 64, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {beta, 0}, };

        modeler_batch_2(sr400_tree_gravity, 2, inputs,
            out, 8);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("sr400_tree_gravity", out,
            at_gravity, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {beta, 0}, };

        modeler_batch_3(sr400_tree_coriolis, 2, inputs,
            out, 8);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("sr400_tree_coriolis", out,
            at_coriolis, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {qd, 8}, {beta, 0}, };

        modeler_batch_2(sr400_tree_friction, 2, inputs,
            out, 8);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("sr400_tree_friction", out,
            at_friction, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, };

        modeler_batch_1(sr400_tree_forward_kinematics, 2, inputs,
            out, 96);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("sr400_tree_forward_kinematics", out,
            at_forward_kinematics, 2, 96, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, };

        modeler_batch_3(sr400_tree_regressor, 2, inputs,
            out, 640);
    }
    multiply(out, 80, chi);
    compare("sr400_tree_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, };

        modeler_batch_3(sr400_tree_base_regressor, 2, inputs,
            out, 400);
    }
    multiply(out, 50, beta);
    compare("sr400_tree_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, };

        modeler_batch_3(sr400_tree_base_regressor_nonzeros, 2, inputs,
            out, 172);
    }
    multiply_nonzeros(out, beta);
    compare("sr400_tree_base_regressor_nonzeros", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    sr400_tree_observation(STATES, q, qd, qdd, out);
    multiply(out, C, beta);
    compare("sr400_tree_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("sr400_tree_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("sr400_tree %s:\n", SR400_TREE_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("11 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
