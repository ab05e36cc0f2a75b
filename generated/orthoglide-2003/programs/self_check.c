/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
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

#include "orthoglide_2003.h"
#include "orthoglide_2003_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "orthoglide_2003_tile.h"

#define N 3
#define C 43
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if ORTHOGLIDE_2003_JOINTS != N || ORTHOGLIDE_2003_BASE_PARAMETERS != C \
    || ORTHOGLIDE_2003_STANDARD_PARAMETERS != 163
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef ORTHOGLIDE_2003_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D41
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D42
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D43
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_b3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_b7
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_a
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_d6
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    0.17962646484375, 0.1942138671875, 0.19122314453125, 0.21099853515625, 0.20684814453125,
    0.206787109375
};
static double qd[] = {
    1.0, -1.3125, 1.625, -0.0185546875, 0.0234375, -0.015625
};
static double qdd[] = {
    -2.125, -0.875, 0.375, -0.375, 0.875, 2.125
};
static double chi[] = {
    1.238525390625, 33.126953125, 1.015380859375, 1.90380859375, 33.792236328125, 1.6806640625,
    33.569091796875, 1.45751953125, 1.345947265625, 1.234375, 1.122802734375, 1.01123046875,
    1.899658203125, 1.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    33.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 1.67236328125,
    1.560791015625, 1.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 33.0029296875,
    1.891357421875, 1.77978515625, 33.668212890625, 1.556640625, 33.445068359375, 1.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 1.775634765625, 1.6640625,
    1.552490234375, 33.44091796875, 1.329345703125, 1.2177734375, 33.106201171875, 1.99462890625,
    33.883056640625, 1.771484375, 1.659912109375, 1.54833984375, 1.436767578125, 33.3251953125,
    1.213623046875, 1.10205078125, 33.990478515625, 1.87890625, 33.767333984375, 1.65576171875,
    1.544189453125, 1.4326171875, 1.321044921875, 33.20947265625, 1.097900390625, 1.986328125,
    33.874755859375, 1.76318359375, 33.651611328125, 1.5400390625, 1.428466796875, 1.31689453125,
    1.205322265625, 33.09375, 1.982177734375, 1.87060546875, 33.759033203125, 1.6474609375,
    33.535888671875, 1.42431640625, 1.312744140625, 1.201171875, 1.089599609375, 33.97802734375,
    1.866455078125, 1.7548828125, 33.643310546875, 1.53173828125, 33.420166015625, 1.30859375,
    1.197021484375, 1.08544921875, 1.973876953125, 33.8623046875, 1.750732421875, 1.63916015625,
    33.527587890625, 1.416015625, 33.304443359375, 1.19287109375, 1.081298828125, 1.9697265625,
    1.858154296875, 33.74658203125, 1.635009765625, 1.5234375, 33.411865234375, 1.30029296875,
    33.188720703125, 1.0771484375, 1.965576171875, 1.85400390625, 1.742431640625, 33.630859375,
    1.519287109375, 1.40771484375, 33.296142578125, 1.1845703125, 33.072998046875, 1.96142578125,
    1.849853515625, 1.73828125, 1.626708984375, 33.51513671875, 1.403564453125, 1.2919921875,
    33.180419921875, 1.06884765625, 33.957275390625, 1.845703125, 1.734130859375, 1.62255859375,
    1.510986328125, 33.3994140625, 1.287841796875, 1.17626953125, 33.064697265625, 1.953125,
    33.841552734375, 1.72998046875, 1.618408203125, 1.5068359375, 1.395263671875, 33.28369140625,
    1.172119140625, 1.060546875, 33.948974609375, 1.83740234375, 33.725830078125, 1.6142578125,
    1.502685546875, 1.39111328125, 1.279541015625, 33.16796875, 1.056396484375, 1.94482421875,
    33.833251953125, 1.7216796875, 33.610107421875, 1.49853515625, 1.386962890625, 1.275390625,
    1.163818359375
};
static double beta[] = {
    35.991273941532256, -3.954290574596774, 1.899658203125, 1.7880859375, 1.676513671875,
    -1.7064012096774193, 1.337646484375, 1.22607421875, 1.114501953125, -2.4585118447580645,
    1.775634765625, 1.6640625, 44.18399240801411, 134.5525, 1.771484375, 5.610595703125,
    -0.3757421875, 3.19580078125, 2.5644189453125, 3.5263671875, 66.3483984375, 2.85693359375,
    1.5400390625, 132.6779296875, 1.30859375, 6.759033203125, 1.647265625, 3.27001953125,
    2.4721337890625, 2.6005859375, 65.399609375, 2.93115234375, 1.0771484375, 133.803359375,
    1.845703125, 5.907470703125, 0.6702734375, 2.34423828125, 2.6898486328125, 3.6748046875,
    66.4508203125, 3.00537109375, 1.6142578125
};
static double x[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.01580810546875, 0.0157470703125,
    0.62017822265625
};
static double xd[] = {
    1.0, -1.3125, 1.625, -0.0185546875, 0.0234375, -0.015625
};
static double xdd[] = {
    -2.125, -0.875, 0.375, -0.375, 0.875, 2.125
};
static double start[] = {
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702,
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277
};
static double at_inverse_dynamics[] = {
    -36953.492868904905, -29136.34657460355, -19958.218322897672, -1228.2477154045914,
    1514.0859057250161, 4089.4459775604882
};
static double at_gravity[] = {
    165.5817799481417, -91.74539880362852, -425.3354424814579, 223.64967646011584,
    -83.41305227329865, -435.5986756113111
};
static double at_coriolis[] = {
    -32580.598485956347, -27019.90901316419, -20208.77082456491, -5.080119407460269,
    -3.0019877050328745, -5.7895013290993615
};
static double at_friction[] = {
    5.3642578125, -1.8672332763671875, 48.73346140215474, -0.1468198299407959, 2.371927261352539,
    42.49218561480122
};
static double at_inertia_matrix[] = {
    2123.47508138438, 71.43063794569414, 82.78916116023528, 71.43063794569414, 2133.4128563706563,
    -11.462865067841603, 82.78916116023528, -11.462865067841603, 2114.8038487404665,
    2162.0091533676905, -203.2251908334089, -215.57410735773624, -203.2251908334089,
    2169.601613343639, -177.16792460998468, -215.57410735773624, -177.16792460998468,
    2147.0699353697332
};
static double at_forward_kinematics[] = {
    0.0, 0.0, 1.0, 0.004037629021999144, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.004037629021999144, 0.0, 0.0, 1.0, 0.001022282701586299, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.004037629021999144, 0.0, 1.0, 0.0, 0.001022282701586299, 0.0, 0.0, 1.0, 0.5895984837260335,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.17962646484375, 0.0, 0.0, 1.0,
    -0.4057861328125, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    -0.40877685546875, 1.0, 0.0, 0.0, 0.6, 0.013024680568544137, 0.9999151752504246, 0.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.9999151752504246, -0.013024680568544137, 0.0, 0.17962646484375,
    0.013024609748384337, 4.295130851261249e-05, 0.9999151752504246, 0.0, 0.003297686134149352,
    -0.9999945626182978, 0.0, -0.04, 0.9999097383299469, 0.0032974064087488444,
    -0.013024680568544137, 0.17962646484375, 0.013024680568544137, 0.0, 0.9999151752504246,
    0.004037629021999144, 0.0, -1.0, 0.0, -0.0389777172984137, 0.9999151752504246, 0.0,
    -0.013024680568544137, 0.48959848372603354, 0.0, 1.0, 0.0, 0.004037629021999144, 0.0, 0.0, 1.0,
    -0.0389777172984137, 1.0, 0.0, 0.0, 0.48959848372603354, 0.013024609748384337,
    4.295130851261249e-05, 0.9999151752504246, 0.0, 0.003297686134149352, -0.9999945626182978, 0.0,
    0.04, 0.9999097383299469, 0.0032974064087488444, -0.013024680568544137, 0.17962646484375,
    0.999994556489855, -0.0032995440076223695, 0.0, -0.4057861328125, 0.0032995440076223695,
    0.999994556489855, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6, 0.9994314897887069, -0.03355309565550675,
    -0.0032995440076223695, -0.4057861328125, 0.003297686134149352, -0.00011071051836113731,
    0.999994556489855, 0.0, -0.03355327830311759, -0.999436930233776, 0.0, 0.56, 0.999994556489855,
    0.0, -0.0032995440076223695, -0.09596237097800085, 0.0032995440076223695, 0.0,
    0.999994556489855, 0.001022282701586299, 0.0, -1.0, 0.0, 0.5495984837260336, 1.0, 0.0, 0.0,
    -0.09596237097800085, 0.0, 1.0, 0.0, 0.001022282701586299, 0.0, 0.0, 1.0, 0.5495984837260336,
    0.9994314897887069, -0.03355309565550675, -0.0032995440076223695, -0.4057861328125,
    0.003297686134149352, -0.00011071051836113731, 0.999994556489855, 0.0, -0.03355327830311759,
    -0.999436930233776, 0.0, 0.64, 0.0, 0.0, 1.0, 0.0, 0.9994368346712392, 0.033556124662033726,
    0.0, -0.40877685546875, -0.033556124662033726, 0.9994368346712392, 0.0, 0.6,
    0.013024609748384337, -0.9999151761729104, 0.0, -0.04, 0.999352058613988, 0.013017274739753407,
    0.033556124662033726, -0.40877685546875, -0.03355327830311759, -0.00043705542839112444,
    0.9994368346712392, 0.6, 0.0, -1.0, 0.0, -0.035962370978000854, 0.9994368346712392, 0.0,
    0.033556124662033726, -0.0989777172984137, -0.033556124662033726, 0.0, 0.9994368346712392,
    0.5895984837260335, 0.0, 0.0, 1.0, -0.035962370978000854, 1.0, 0.0, 0.0, -0.0989777172984137,
    0.0, 1.0, 0.0, 0.5895984837260335, 0.013024609748384337, -0.9999151761729104, 0.0, 0.04,
    0.999352058613988, 0.013017274739753407, 0.033556124662033726, -0.40877685546875,
    -0.03355327830311759, -0.00043705542839112444, 0.9994368346712392, 0.6, 0.0, 0.0, 1.0,
    0.015789588283663156, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.015789588283663156, 0.0, 0.0, 1.0, 0.01572527272135455, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.015789588283663156, 0.0, 1.0, 0.0, 0.01572527272135455, 0.0, 0.0, 1.0, 0.6201965375748805,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.21099853515625, 0.0, 0.0, 1.0,
    -0.39315185546875, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    -0.393212890625, 1.0, 0.0, 0.0, 0.6, 0.05099981429577978, 0.9986986627315548, 0.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.9986986627315548, -0.05099981429577978, 0.0, 0.21099853515625,
    0.05093415575375212, 0.0025870515759341085, 0.9986986627315548, 0.0, 0.05072668619791791,
    -0.9987125729194452, 0.0, -0.04, 0.9974129110278404, 0.05066067367066384, -0.05099981429577978,
    0.21099853515625, 0.05099981429577978, 0.0, 0.9986986627315548, 0.015789588283663156, 0.0, -1.0,
    0.0, -0.024274727278645446, 0.9986986627315548, 0.0, -0.05099981429577978, 0.5201965375748805,
    0.0, 1.0, 0.0, 0.015789588283663156, 0.0, 0.0, 1.0, -0.024274727278645446, 1.0, 0.0, 0.0,
    0.5201965375748805, 0.05093415575375212, 0.0025870515759341085, 0.9986986627315548, 0.0,
    0.05072668619791791, -0.9987125729194452, 0.0, 0.04, 0.9974129110278404, 0.05066067367066384,
    -0.05099981429577978, 0.21099853515625, 0.998707081540371, -0.05083468580717974, 0.0,
    -0.39315185546875, 0.05083468580717974, 0.998707081540371, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6,
    0.9965853024271392, 0.06506588741493337, -0.05083468580717974, -0.39315185546875,
    0.05072668619791791, 0.0033118859419740314, 0.998707081540371, 0.0, 0.06515012120929192,
    -0.9978754740479469, 0.0, 0.56, 0.998707081540371, 0.0, -0.05083468580717974,
    -0.08421041171633684, 0.05083468580717974, 0.0, 0.998707081540371, 0.01572527272135455, 0.0,
    -1.0, 0.0, 0.5801965375748805, 1.0, 0.0, 0.0, -0.08421041171633684, 0.0, 1.0, 0.0,
    0.01572527272135455, 0.0, 0.0, 1.0, 0.5801965375748805, 0.9965853024271392, 0.06506588741493337,
    -0.05083468580717974, -0.39315185546875, 0.05072668619791791, 0.0033118859419740314,
    0.998707081540371, 0.0, 0.06515012120929192, -0.9978754740479469, 0.0, 0.64, 0.0, 0.0, 1.0, 0.0,
    0.9978699421814733, -0.065234795092368, 0.0, -0.393212890625, 0.065234795092368,
    0.9978699421814733, 0.0, 0.6, 0.05093415575375212, -0.9987020135043548, 0.0, -0.04,
    0.9965747204721115, 0.05082566305705878, -0.065234795092368, -0.393212890625,
    0.06515012120929192, 0.003322679213798776, 0.9978699421814733, 0.6, 0.0, -1.0, 0.0,
    -0.02421041171633684, 0.9978699421814733, 0.0, -0.065234795092368, -0.08427472727864545,
    0.065234795092368, 0.0, 0.9978699421814733, 0.6201965375748805, 0.0, 0.0, 1.0,
    -0.02421041171633684, 1.0, 0.0, 0.0, -0.08427472727864545, 0.0, 1.0, 0.0, 0.6201965375748805,
    0.05093415575375212, -0.9987020135043548, 0.0, 0.04, 0.9965747204721115, 0.05082566305705878,
    -0.065234795092368, -0.393212890625, 0.06515012120929192, 0.003322679213798776,
    0.9978699421814733, 0.6
};
static double at_close[] = {
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277,
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702
};
static double at_close_from[] = {
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277,
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702
};
static double at_coupling[] = {
    0.03344478743718129, 0.999608779471041, -0.003408571480129206, 0.03312085097060254,
    -0.013463634857979558, 0.999935192067077, 0.999455123343039, -0.012976286672988871,
    -0.003253370759277447, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.10790073939385604,
    3.2248336633468138, -0.010857827534915227, -0.10684203568480903, 0.0434313163396756,
    -3.225614932664378, 0.10654488939609275, -0.04345114576582606, 3.2274333851336596,
    -3.2258651721258844, 0.04188257207777473, 0.010500656987240963, 3.2260919471235696,
    -0.043296467049250865, -0.010496739653437339, -0.10789556320227839, -3.2248179913102746,
    0.01099632462172287, -0.06260451377307497, 1.0056504335023029, -0.04800414916191437,
    -0.06259148202582829, -0.04820099548875443, 1.0056367485099913, 1.0063802728563385,
    -0.04890339647898126, -0.04869354348989963, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,
    -0.20299823871033304, 3.2520442125380584, -0.14682876648560259, 0.20216828345788293,
    0.1556875185492732, -3.2481712950100294, -0.19178834821190352, -0.15654520869298447,
    3.2545815980172508, -3.2532996965911454, 0.15808875553153603, 0.1574103691560059,
    3.2568717858935967, -0.14746510885859226, -0.15813278829118418, 0.2022125135411009,
    -3.2482498408869946, 0.15505335122668829
};
static double at_platform_inverse_dynamics[] = {
    -4282.624960303166, -1543.5470954401403, 59.79139171622435, -805.1580010715252,
    1498.8382501708452, 4710.676409632289
};
static double at_platform_close[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.17962752026605516, 0.19420457160050866,
    0.19123830051323304, -1.5578013066089245, -0.0033470954633180554, -1.5674473460229505,
    0.033555944162842376, -1.6043551054948433, -0.012994947390024759, 0.01580810546875,
    0.0157470703125, 0.62017822265625, 0.21098227575839357, 0.20686657522879023, 0.2068086571426197,
    -1.5197143074849013, -0.0508188719623078, -1.5198693623587485, -0.06513709210776798,
    -1.5055742582206773, -0.05101601506345277
};
static double at_platform_close_from[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.17962752026605516, 0.19420457160050866,
    0.19123830051323304, -1.5578013066089245, -0.0033470954633180554, -1.5674473460229505,
    0.033555944162842376, -1.6043551054948433, -0.012994947390024759, 0.01580810546875,
    0.0157470703125, 0.62017822265625, 0.21098227575839357, 0.20686657522879023, 0.2068086571426197,
    -1.5197143074849013, -0.0508188719623078, -1.5198693623587485, -0.06513709210776798,
    -1.5055742582206773, -0.05101601506345277
};
static double at_platform_coupling[] = {
    1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.012995751727453693, 0.003347390596465345, 1.0,
    1.0, 0.0033489932923590664, -0.03356873276576382, 0.013003000167041536, 1.0,
    -0.03357138224945269, 3.2260969136757773, 0.0001403175088521454, 0.0, 0.0, -3.225824521129574,
    0.0, 0.0, 3.227641535412409, -0.00036285210690062674, 0.0, 0.0, -3.227623435344588,
    -0.0014074830465624641, 0.0, 3.2278962838910386, -3.2260788395813096, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.05112649640899802, 0.05092909680896328, 1.0, 1.0,
    0.05097103746546799, 0.06531405033365781, 0.0511691158977287, 1.0, 0.06531470932737107,
    3.234195046969203, 0.00839932691734234, 0.0, 0.0, -3.2299763543081985, 0.0, 0.0,
    3.2368584412179358, 0.010747982296217236, 0.0, 0.0, -3.232661861999762, 0.010772046901964785,
    0.0, 3.2368910998779423, -3.230008805095861, 0.0, 0.0
};

static double out[STATES * 489], worst;
static double product[STATES * N];
static int failed;
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("orthoglide_2003: the %s is %s,\nthe header %s\n", part, signature, header);
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
    const modeler_tiled *const robot = orthoglide_2003_tiled();
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
    orthoglide_2003_observation(MANY, Q, QD, QDD, one, told);
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
    if (!belongs("library", orthoglide_2003_signature(),
            ORTHOGLIDE_2003_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", orthoglide_2003_tile_signature(),
            ORTHOGLIDE_2003_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(orthoglide_2003_base_parameters, 1, inputs,
            out, 43);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("orthoglide_2003_base_parameters", out,
            beta, 1, 43, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2003_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("orthoglide_2003_inverse_dynamics", out,
            at_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2003_gravity, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("orthoglide_2003_gravity", out,
            at_gravity, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2003_coriolis, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("orthoglide_2003_coriolis", out,
            at_coriolis, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2003_friction, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("orthoglide_2003_friction", out,
            at_friction, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2003_inertia_matrix, 2, inputs,
            out, 9, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("orthoglide_2003_inertia_matrix", out,
            at_inertia_matrix, 2, 9, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_forward_kinematics, 2, inputs,
            out, 252, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("orthoglide_2003_forward_kinematics", out,
            at_forward_kinematics, 2, 252, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("orthoglide_2003_close", out,
            at_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2003_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("orthoglide_2003_close_from", out,
            at_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("orthoglide_2003_coupling", out,
            at_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2003_platform_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_inverse_dynamics, out, sizeof(at_platform_inverse_dynamics));
    }
    compare("orthoglide_2003_platform_inverse_dynamics", out,
            at_platform_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2003_platform_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close, out, sizeof(at_platform_close));
    }
    compare("orthoglide_2003_platform_close", out,
            at_platform_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2003_platform_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close_from, out, sizeof(at_platform_close_from));
    }
    compare("orthoglide_2003_platform_close_from", out,
            at_platform_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2003_platform_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_coupling, out, sizeof(at_platform_coupling));
    }
    compare("orthoglide_2003_platform_coupling", out,
            at_platform_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_regressor, 2, inputs,
            out, 489, status);
    }
    multiply(out, 163, chi);
    compare("orthoglide_2003_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_base_regressor, 2, inputs,
            out, 129, status);
    }
    multiply(out, 43, beta);
    compare("orthoglide_2003_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_platform_base_regressor, 2, inputs,
            out, 129, status);
    }
    multiply(out, 43, beta);
    compare("orthoglide_2003_platform_base_regressor", product,
            at_platform_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    orthoglide_2003_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("orthoglide_2003_observation", product, at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("orthoglide_2003_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("orthoglide_2003 %s:\n", ORTHOGLIDE_2003_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("18 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
