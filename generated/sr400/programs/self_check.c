/* SR400, 6R arm with a parallelogram
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * every function gives at stored states what the equations of motion give there, evaluated with 40
 * digits and not by this code. Prints what differs and one line more; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "sr400.h"
#include "modeler_runtime.h"
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

/* Inputs, one row for each state. */
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
    1.238525390625, 1.126953125, 1.015380859375, 1.90380859375, 1.792236328125, 1.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 1.122802734375, 1.01123046875,
    1.899658203125, 1.7880859375, 1.676513671875, 1.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 1.007080078125, 1.8955078125, 1.783935546875, 1.67236328125,
    1.560791015625, 1.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    1.891357421875, 1.77978515625, 1.668212890625, 1.556640625, 1.445068359375, 1.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 1.775634765625, 1.6640625,
    1.552490234375, 1.44091796875, 1.329345703125, 1.2177734375, 1.106201171875, 1.99462890625,
    1.883056640625, 1.771484375, 1.659912109375, 1.54833984375, 1.436767578125, 1.3251953125,
    1.213623046875, 1.10205078125, 1.990478515625, 1.87890625, 1.767333984375, 1.65576171875,
    1.544189453125, 1.4326171875, 1.321044921875, 1.20947265625, 1.097900390625, 1.986328125,
    1.874755859375, 1.76318359375, 1.651611328125, 1.5400390625, 1.428466796875, 1.31689453125,
    1.205322265625, 1.09375, 1.982177734375, 1.87060546875, 1.759033203125, 1.6474609375,
    1.535888671875, 1.42431640625
};
static double beta[] = {
    12.38819091796875, -3.88409423828125, 2.328125, 2.26910400390625, 3.65869140625,
    6.98907470703125, 7.950439453125, 1.341796875, 7.210841064453125, -0.47466064453125,
    2.8818359375, 0.77730712890625, 11.88553833007813, 2.134814453125, 6.655533854166666,
    1.775634765625, 1.77978515625, 1.668212890625, 1.445068359375, 2.7744140625, 1.221923828125,
    -0.772705078125, 1.659912109375, 1.6640625, 1.552490234375, 1.329345703125, 2.54296875,
    1.106201171875, 3.761962890625, 0.334716796875, 1.54833984375, 1.436767578125, 1.213623046875,
    1.10205078125, 1.990478515625, 1.87890625, 1.552384440104167, 1.76318359375, 1.6474609375
};

/* What the functions give there. */
static double at_inverse_dynamics[] = {
    -40.50330436684936, -67.47245831929793, -77.69540508203363, -18.23680217363417,
    -43.48581487240539, 41.89224255687772, 0.803036295080106, 13.00037491717373, 11.48819622097113,
    12.40410318932676, -4.452242051765696, 72.66211842730057
};
static double at_inertia_matrix[] = {
    11.30751974729035, -3.155666895113098, -0.01836524646803165, 0.3645204045375465,
    0.6881838281384212, -1.878531137928347, -3.155666895113098, 6.98907470703125, 3.22542665467143,
    -0.6828742463892655, 2.002600460106357, -7.845129163994653, -0.01836524646803165,
    3.22542665467143, 5.096872242658314, 2.921989384838574, 1.369864027232158, 1.542387857692327,
    0.3645204045375465, -0.6828742463892655, 2.921989384838574, 2.091089999782653,
    1.079104743884946, 4.779918408862415, 0.6881838281384212, 2.002600460106357, 1.369864027232158,
    1.079104743884946, 1.10205078125, -0.4926581748812017, -1.878531137928347, -7.845129163994653,
    1.542387857692327, 4.779918408862415, -0.4926581748812017, 22.00253039308846, 11.637110284542,
    -3.585434266558774, 6.27862341643493, 1.316776708871176, 1.702221464387566, 0.07084125231968073,
    -3.585434266558774, 6.98907470703125, -0.1177477205344146, -3.7794617584886, 0.1525174214539521,
    -8.306846781873372, 6.27862341643493, -0.1177477205344146, 8.377540283702517, 1.009637726182577,
    2.122442969360729, -0.07068158579751573, 1.316776708871176, -3.7794617584886, 1.009637726182577,
    1.414632754528359, -0.490592052408485, 4.859236912755541, 1.702221464387566, 0.1525174214539521,
    2.122442969360729, -0.490592052408485, 1.10205078125, -0.9247777310910504, 0.07084125231968073,
    -8.306846781873372, -0.07068158579751573, 4.859236912755541, -0.9247777310910504,
    19.97176508607281
};
static double at_gravity[] = {
    0.0, -65.20089337795137, -43.45718658088708, 17.51107342201369, -26.14352366856749,
    94.43373786643592, 0.0, -1.9713622782596, 0.9407070826742997, 16.26884708989452,
    -8.261692536583947, 88.11611733779391
};
static double at_coriolis[] = {
    -20.89557672026493, -9.952639638614315, -31.66981682137068, -29.19475841748682,
    -14.027042923564, -37.40590522120201, -0.00437845043684863, -0.004310846583481518,
    -0.002797789501174078, -0.008971645250661428, -0.00561229887768953, -0.004902052356657041
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_forward_kinematics[] = {
    0.4866896677019633, 0.8735749351670711, 0.0, 0.0, -0.8735749351670711, 0.4866896677019633, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, 0.463118288431404, -0.1496271484999108, 0.8735749351670711,
    0.146006900310589, -0.8312659085232449, 0.2685705804424168, 0.4866896677019633,
    -0.2620724805501213, -0.3074385145803809, -0.9515679480481722, 0.0, 0.0, -0.03039830464559933,
    -0.4857394113334029, 0.8735749351670711, 0.493345616634142, 0.05456289453473677,
    0.8718692894534958, 0.4866896677019633, -0.885521911942555, -0.9980475107000991,
    0.0624593178423802, 0.0, -0.2305788859352856, 0.7988172982269811, -0.3548917417055875,
    -0.4857394113334029, 0.1001943418705798, 0.4717793762913933, -0.1314083795424031,
    0.8718692894534958, -0.1798420461995479, -0.3732494395969674, -0.9256261067273407,
    0.0624593178423802, -0.3303185582663963, 0.6942732499117451, -0.6261281866568205,
    0.3548917417055875, 0.1001943418705798, 0.6260299567777583, 0.7686470783154502,
    0.1314083795424031, -0.1798420461995479, -0.3550649907746773, 0.1309395389901921,
    0.9256261067273407, -0.3303185582663963, 0.5204595921082178, 0.5805904811968496,
    -0.6261281866568205, 0.1001943418705798, 0.2869583011589891, 0.5716962501128279,
    0.7686470783154502, -0.1798420461995479, 0.8042243134713688, -0.5797224256060322,
    0.1309395389901921, -0.3303185582663963, 0.4857394113334029, -0.03039830464559933,
    0.8735749351670711, 0.146006900310589, -0.8718692894534958, 0.05456289453473677,
    0.4866896677019633, -0.2620724805501213, -0.0624593178423802, -0.9980475107000991, 0.0, 0.0,
    0.463118288431404, -0.1496271484999108, 0.8735749351670711, 0.31601569427728,
    -0.8312659085232449, 0.2685705804424168, 0.4866896677019633, -0.5672267318588449,
    -0.3074385145803809, -0.9515679480481722, 0.0, -0.02186076124483307, -0.4857394113334029,
    0.03039830464559933, 0.8735749351670711, 0.6633544106008331, 0.8718692894534958,
    -0.05456289453473677, 0.4866896677019633, -1.190676163251279, 0.0624593178423802,
    0.9980475107000991, 0.0, -0.2524396471801187, 0.9824733131012553, 0.1864032967622699, 0.0, 0.0,
    -0.1864032967622699, 0.9824733131012553, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3674250069285634,
    -0.9111820209155261, 0.1864032967622699, 0.2947419939303766, -0.06971103610762959,
    0.1728772989395763, 0.9824733131012553, -0.05592098902868096, -0.9274369173848677,
    -0.3739796308245332, 0.0, 0.0, -0.7919531770612147, -0.5814326928362435, 0.1864032967622699,
    0.5703107491267991, 0.1502561760375773, 0.1103144170378805, 0.9824733131012553,
    -0.1082042661094032, -0.5918050750924775, 0.806081108260693, 0.0, -0.6955776880386507,
    -0.6962897069768926, -0.4208523109824008, -0.5814326928362435, -0.01362838170137786,
    0.4450290971083578, -0.8886955789923299, 0.1103144170378805, 0.00258569392653784,
    -0.5631427409502433, -0.181943673207562, 0.806081108260693, -0.139483562693968,
    -0.8468020330613183, 0.3252839515623089, 0.4208523109824008, -0.01362838170137786,
    0.3129589731012311, -0.335077377682992, 0.8886955789923299, 0.00258569392653784,
    0.430096498426389, 0.8842587301356425, 0.181943673207562, -0.139483562693968,
    -0.5887397367471929, -0.7399836979493909, 0.3252839515623089, -0.01362838170137786,
    0.6600017368871817, -0.6723993294694701, -0.335077377682992, 0.00258569392653784,
    0.4666725079547212, 0.01741460588562528, 0.8842587301356425, -0.139483562693968,
    0.5814326928362435, -0.7919531770612147, 0.1864032967622699, 0.2947419939303766,
    -0.1103144170378805, 0.1502561760375773, 0.9824733131012553, -0.05592098902868096,
    -0.806081108260693, -0.5918050750924775, 0.0, 0.0, 0.3674250069285634, -0.9111820209155261,
    0.1864032967622699, 0.4982434364230618, -0.06971103610762959, 0.1728772989395763,
    0.9824733131012553, -0.09453103499193914, -0.9274369173848677, -0.3739796308245332, 0.0,
    -0.2821283878912426, -0.5814326928362435, 0.7919531770612147, 0.1864032967622699,
    0.7738121916194844, 0.1103144170378805, -0.1502561760375773, 0.9824733131012553,
    -0.1468143120726613, 0.806081108260693, 0.5918050750924775, 0.0, -0.9777060759298933
};

static double out[STATES * 480], product[STATES * N], worst;
static int failed;

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

/* The same as `multiply` of the entries that are not always 0. */
static void multiply_nonzeros(const double *values, const double *parameters)
{
    for (int i = 0; i < STATES * N; i++)
        product[i] = 0.0;
    for (int i = 0; i < STATES; i++)
        for (int k = 0; k < SR400_NONZEROS; k++)
            product[i * N + sr400_nonzero_row[k]] +=
                values[i * SR400_NONZEROS + k]
                * parameters[sr400_nonzero_column[k]];
}

/* Many samples, the states one after another, against the same one by one. */
static void compare_tiles(void)
{
    enum { MANY = 19, SIGNALS = 0, LENGTH = SR400_NONZEROS };
    static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], S[MANY * SIGNALS + 1];
    static double work[2 * MANY * (LENGTH + N * C) + 4096];
    static double W[MANY * N * C], entries[MANY * LENGTH], one[LENGTH], dense[N * C];
    const modeler_tiled *const robot = sr400_tiled();

    for (int i = 0; i < MANY; i++) {
        for (int k = 0; k < N; k++) {
            Q[i * N + k] = q[i % STATES * N + k] + 0.1 * (double)i;
            QD[i * N + k] = qd[i % STATES * N + k];
            QDD[i * N + k] = qdd[i % STATES * N + k] - 0.1 * (double)i;
        }
    }
    if (modeler_tile_work(robot) > sizeof(work)) {
        failed = 1;
        return;
    }
    modeler_tile_nonzeros(robot, MANY, Q, QD, QDD, S, entries, work);
    modeler_tile_observation(robot, MANY, Q, QD, QDD, S, W, work);
    for (int i = 0; i < MANY; i++) {
        double largest = 0.0, apart = 0.0;

        sr400_base_regressor_nonzeros(Q + i * N, QD + i * N, QDD + i * N,
            one);
        sr400_base_regressor(Q + i * N, QD + i * N, QDD + i * N,
            dense);
        for (int k = 0; k < LENGTH; k++) {
            largest = fmax(largest, fabs(one[k]));
            apart = fmax(apart, fabs(entries[i * LENGTH + k] - one[k]));
        }
        for (int k = 0; k < N * C; k++)
            apart = fmax(apart, fabs(W[i * N * C + k] - dense[k]));
        if (!(apart <= ROUNDINGS * largest)) {
            printf("tiles: sample %d of %d is not what it is alone\n", i, (int)MANY);
            failed = 1;
            return;
        }
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
    const char *const signature = sr400_signature();

    if (strcmp(signature, SR400_SIGNATURE) != 0) {
        printf("sr400: the library is %s,\n", signature);
        printf("the header %s\n", SR400_SIGNATURE);
        return 1;
    }
    if (strcmp(sr400_tile_signature(), signature) != 0) {
        printf("sr400: the tiles are %s,\n", sr400_tile_signature());
        printf("the library %s\n", signature);
        return 1;
    }
    compare_sines();
    compare_tiles();
    {
        const modeler_input inputs[] = {
            {chi, 0},
        };
        empty();
        modeler_batch_1(sr400_base_parameters,
            1, inputs, out, 39);
        compare("sr400_base_parameters", out, beta, 1, C, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {qd, 6},
            {qdd, 6},
            {beta, 0},
        };
        empty();
        modeler_batch_4(sr400_inverse_dynamics,
            2, inputs, out, 6);
        compare("sr400_inverse_dynamics", out,
                at_inverse_dynamics, STATES, 6, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {beta, 0},
        };
        empty();
        modeler_batch_2(sr400_inertia_matrix,
            2, inputs, out, 36);
        compare("sr400_inertia_matrix", out,
                at_inertia_matrix, STATES, 36, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {beta, 0},
        };
        empty();
        modeler_batch_2(sr400_gravity,
            2, inputs, out, 6);
        compare("sr400_gravity", out,
                at_gravity, STATES, 6, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {qd, 6},
            {beta, 0},
        };
        empty();
        modeler_batch_3(sr400_coriolis,
            2, inputs, out, 6);
        compare("sr400_coriolis", out,
                at_coriolis, STATES, 6, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {qd, 6},
            {beta, 0},
        };
        empty();
        modeler_batch_2(sr400_friction,
            2, inputs, out, 6);
        compare("sr400_friction", out,
                at_friction, STATES, 6, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
        };
        empty();
        modeler_batch_1(sr400_forward_kinematics,
            2, inputs, out, 108);
        compare("sr400_forward_kinematics", out,
                at_forward_kinematics, STATES, 108, REPLACED);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {qd, 6},
            {qdd, 6},
        };
        empty();
        modeler_batch_3(sr400_regressor,
            2, inputs, out, 480);
        multiply(out, 80, chi);
        compare("sr400_regressor", product,
                at_inverse_dynamics, STATES, N, 0);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {qd, 6},
            {qdd, 6},
        };
        empty();
        modeler_batch_3(sr400_base_regressor,
            2, inputs, out, 234);
        multiply(out, 39, beta);
        compare("sr400_base_regressor", product,
                at_inverse_dynamics, STATES, N, 0);
    }
    {
        const modeler_input inputs[] = {
            {q, 6},
            {qd, 6},
            {qdd, 6},
        };
        empty();
        modeler_batch_3(sr400_base_regressor_nonzeros,
            2, inputs, out, 126);
        multiply_nonzeros(out, beta);
        compare("sr400_base_regressor_nonzeros", product,
                at_inverse_dynamics, STATES, N, 0);
    }
    empty();
    sr400_observation(STATES, q, qd, qdd, out);
    multiply(out, C, beta);
    compare("sr400_observation", product,
            at_inverse_dynamics, STATES, N, 0);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("sr400_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, 0);
    printf("sr400 %s:\n", signature);
    if (failed) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("11 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
