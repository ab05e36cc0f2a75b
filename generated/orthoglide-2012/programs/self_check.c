/* Orthoglide, full dynamic model (Briot, Gautier 2012)
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

#include "orthoglide_2012.h"
#include "orthoglide_2012_batch.h"
#include "modeler_batch.h"
#include "modeler_sincos.h"
#include "orthoglide_2012_tile.h"

#define N 3
#define C 53
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if ORTHOGLIDE_2012_JOINTS != N || ORTHOGLIDE_2012_BASE_PARAMETERS != C \
    || ORTHOGLIDE_2012_STANDARD_PARAMETERS != 196
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef ORTHOGLIDE_2012_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2012_GEO_d4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2012_GEO_a
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2012_GEO_d6
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
    1.899658203125, 1.7880859375, 33.676513671875, 1.56494140625, 1.453369140625, 33.341796875,
    1.230224609375, 33.11865234375, 1.007080078125, 1.8955078125, 1.783935546875, 1.67236328125,
    1.560791015625, 1.44921875, 1.337646484375, 33.22607421875, 1.114501953125, 1.0029296875,
    33.891357421875, 1.77978515625, 33.668212890625, 1.556640625, 1.445068359375, 1.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 33.775634765625, 1.6640625,
    1.552490234375, 33.44091796875, 1.329345703125, 33.2177734375, 1.106201171875, 1.99462890625,
    1.883056640625, 1.771484375, 1.659912109375, 1.54833984375, 1.436767578125, 33.3251953125,
    1.213623046875, 1.10205078125, 33.990478515625, 1.87890625, 33.767333984375, 1.65576171875,
    1.544189453125, 1.4326171875, 1.321044921875, 1.20947265625, 1.097900390625, 1.986328125,
    33.874755859375, 1.76318359375, 1.651611328125, 33.5400390625, 1.428466796875, 33.31689453125,
    1.205322265625, 1.09375, 1.982177734375, 1.87060546875, 1.759033203125, 1.6474609375,
    1.535888671875, 33.42431640625, 1.312744140625, 1.201171875, 33.089599609375, 1.97802734375,
    33.866455078125, 1.7548828125, 1.643310546875, 1.53173828125, 1.420166015625, 1.30859375,
    1.197021484375, 1.08544921875, 33.973876953125, 1.8623046875, 1.750732421875, 33.63916015625,
    1.527587890625, 33.416015625, 1.304443359375, 1.19287109375, 1.081298828125, 1.9697265625,
    1.858154296875, 1.74658203125, 1.635009765625, 33.5234375, 1.411865234375, 1.30029296875,
    33.188720703125, 1.0771484375, 33.965576171875, 1.85400390625, 1.742431640625, 1.630859375,
    1.519287109375, 1.40771484375, 1.296142578125, 1.1845703125, 33.072998046875, 1.96142578125,
    1.849853515625, 33.73828125, 1.626708984375, 33.51513671875, 1.403564453125, 1.2919921875,
    1.180419921875, 1.06884765625, 1.957275390625, 1.845703125, 1.734130859375, 33.62255859375,
    1.510986328125, 1.3994140625, 33.287841796875, 1.17626953125, 33.064697265625, 1.953125,
    1.841552734375, 1.72998046875, 1.618408203125, 1.5068359375, 1.395263671875, 1.28369140625,
    33.172119140625, 1.060546875, 1.948974609375, 33.83740234375, 1.725830078125, 33.6142578125,
    1.502685546875, 1.39111328125, 1.279541015625, 1.16796875, 1.056396484375, 1.94482421875,
    1.833251953125, 33.7216796875, 1.610107421875, 1.49853515625, 33.386962890625, 1.275390625,
    33.163818359375, 1.05224609375, 1.940673828125, 1.8291015625, 1.717529296875, 1.60595703125,
    1.494384765625, 1.3828125, 33.271240234375, 1.15966796875, 1.048095703125, 33.9365234375,
    1.824951171875, 33.71337890625, 1.601806640625, 1.490234375, 1.378662109375, 1.26708984375,
    1.155517578125, 1.0439453125, 1.932373046875, 33.82080078125, 1.709228515625, 1.59765625,
    33.486083984375, 1.37451171875, 33.262939453125, 1.1513671875, 1.039794921875, 1.92822265625,
    1.816650390625, 1.705078125, 1.593505859375, 1.48193359375
};
static double beta[] = {
    24.90185546875, 1.899658203125, 1.7880859375, 0.7415102066532258, 1.44921875, 1.337646484375,
    0.7130796370967742, 1.1103515625, 1.998779296875, 1.88720703125, 105.60759252929688,
    1.106201171875, 5.409423828125, 2.745361328125, 2.522216796875, -2.556078857421875,
    1.213623046875, 0.48757568359375, 1.87890625, 38.62663549804687, 7.7551025390625,
    1.544189453125, 2.745361328125, 3.522216796875, 1.205322265625, 103.1332666015625,
    1.304443359375, 4.004150390625, 3.141845703125, 2.918701171875, 0.9094580078125, 1.411865234375,
    0.93436279296875, 1.0771484375, 36.7558251953125, 1.742431640625, 3.141845703125,
    2.918701171875, 1.403564453125, 103.3730224609375, 1.502685546875, 4.598876953125,
    3.538330078125, 3.315185546875, 0.6609130859375, 1.610107421875, 1.07114990234375, 1.275390625,
    35.5990966796875, 1.940673828125, 2.538330078125, 3.315185546875, 1.601806640625
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
    -25645.375036809255, -19995.96677227696, -13677.615128974301, -907.2894628957752,
    1077.645557647381, 2795.224509250748
};
static double at_gravity[] = {
    129.01566707334436, -58.82954403209273, -336.2734474981738, 174.74767113628496,
    -52.46877295342063, -344.11982433473594
};
static double at_coriolis[] = {
    -22679.31216661858, -18481.06963473148, -13938.71349677862, -3.527413443130718,
    -2.058831065820661, -4.0189264370481474
};
static double at_friction[] = {
    95.24854222101774, -95.50548480514293, 128.63220783521396, -23.393162913629375,
    23.820670864938375, -23.73256132868932
};
static double at_inertia_matrix[] = {
    1497.2497081304002, 30.04447289123113, 46.979904191704236, 30.04447289123113,
    1476.7704958139361, -12.115786605820754, 46.979904191704236, -12.115786605820754,
    1487.9215749188184, 1529.6756484229704, -159.81978077764674, -160.77453239352715,
    -159.81978077764674, 1504.1792314556826, -125.99376682995565, -160.77453239352715,
    -125.99376682995565, 1513.9058436140515
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
    -0.9999945626182978, 0.0, 0.0, 0.9999097383299469, 0.0032974064087488444, -0.013024680568544137,
    0.17962646484375, 0.013024680568544137, 0.0, 0.9999151752504246, 0.004037629021999144, 0.0,
    -1.0, 0.0, 0.001022282701586299, 0.9999151752504246, 0.0, -0.013024680568544137,
    0.48959848372603354, 1.0, 0.0, 0.0, 0.004037629021999144, 0.0, 0.0, 1.0, 0.001022282701586299,
    0.0, -1.0, 0.0, 0.48959848372603354, 0.999994556489855, -0.0032995440076223695, 0.0,
    -0.4057861328125, 0.0032995440076223695, 0.999994556489855, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6,
    0.9994314897887069, -0.03355309565550675, -0.0032995440076223695, -0.4057861328125,
    0.003297686134149352, -0.00011071051836113731, 0.999994556489855, 0.0, -0.03355327830311759,
    -0.999436930233776, 0.0, 0.6, 0.999994556489855, 0.0, -0.0032995440076223695,
    -0.09596237097800085, 0.0032995440076223695, 0.0, 0.999994556489855, 0.001022282701586299, 0.0,
    -1.0, 0.0, 0.5895984837260335, 0.0, -1.0, 0.0, -0.09596237097800085, 1.0, 0.0, 0.0,
    0.001022282701586299, 0.0, 0.0, 1.0, 0.5895984837260335, 0.0, 0.0, 1.0, 0.0, 0.9994368346712392,
    0.033556124662033726, 0.0, -0.40877685546875, -0.033556124662033726, 0.9994368346712392, 0.0,
    0.6, 0.013024609748384337, -0.9999151761729104, 0.0, 0.0, 0.999352058613988,
    0.013017274739753407, 0.033556124662033726, -0.40877685546875, -0.03355327830311759,
    -0.00043705542839112444, 0.9994368346712392, 0.6, 0.0, -1.0, 0.0, 0.004037629021999144,
    0.9994368346712392, 0.0, 0.033556124662033726, -0.0989777172984137, -0.033556124662033726, 0.0,
    0.9994368346712392, 0.5895984837260335, 0.0, 0.0, 1.0, 0.004037629021999144, 0.0, -1.0, 0.0,
    -0.0989777172984137, 1.0, 0.0, 0.0, 0.5895984837260335, 0.0, 0.0, 1.0, 0.015789588283663156,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.015789588283663156, 0.0, 0.0, 1.0,
    0.01572527272135455, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.015789588283663156, 0.0, 1.0, 0.0,
    0.01572527272135455, 0.0, 0.0, 1.0, 0.6201965375748805, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.0, 0.0, 1.0, 0.21099853515625, 0.0, 0.0, 1.0, -0.39315185546875, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    0.0, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -0.393212890625, 1.0, 0.0, 0.0, 0.6,
    0.05099981429577978, 0.9986986627315548, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.9986986627315548,
    -0.05099981429577978, 0.0, 0.21099853515625, 0.05093415575375212, 0.0025870515759341085,
    0.9986986627315548, 0.0, 0.05072668619791791, -0.9987125729194452, 0.0, 0.0, 0.9974129110278404,
    0.05066067367066384, -0.05099981429577978, 0.21099853515625, 0.05099981429577978, 0.0,
    0.9986986627315548, 0.015789588283663156, 0.0, -1.0, 0.0, 0.01572527272135455,
    0.9986986627315548, 0.0, -0.05099981429577978, 0.5201965375748805, 1.0, 0.0, 0.0,
    0.015789588283663156, 0.0, 0.0, 1.0, 0.01572527272135455, 0.0, -1.0, 0.0, 0.5201965375748805,
    0.998707081540371, -0.05083468580717974, 0.0, -0.39315185546875, 0.05083468580717974,
    0.998707081540371, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6, 0.9965853024271392, 0.06506588741493337,
    -0.05083468580717974, -0.39315185546875, 0.05072668619791791, 0.0033118859419740314,
    0.998707081540371, 0.0, 0.06515012120929192, -0.9978754740479469, 0.0, 0.6, 0.998707081540371,
    0.0, -0.05083468580717974, -0.08421041171633684, 0.05083468580717974, 0.0, 0.998707081540371,
    0.01572527272135455, 0.0, -1.0, 0.0, 0.6201965375748805, 0.0, -1.0, 0.0, -0.08421041171633684,
    1.0, 0.0, 0.0, 0.01572527272135455, 0.0, 0.0, 1.0, 0.6201965375748805, 0.0, 0.0, 1.0, 0.0,
    0.9978699421814733, -0.065234795092368, 0.0, -0.393212890625, 0.065234795092368,
    0.9978699421814733, 0.0, 0.6, 0.05093415575375212, -0.9987020135043548, 0.0, 0.0,
    0.9965747204721115, 0.05082566305705878, -0.065234795092368, -0.393212890625,
    0.06515012120929192, 0.003322679213798776, 0.9978699421814733, 0.6, 0.0, -1.0, 0.0,
    0.015789588283663156, 0.9978699421814733, 0.0, -0.065234795092368, -0.08427472727864545,
    0.065234795092368, 0.0, 0.9978699421814733, 0.6201965375748805, 0.0, 0.0, 1.0,
    0.015789588283663156, 0.0, -1.0, 0.0, -0.08427472727864545, 1.0, 0.0, 0.0, 0.6201965375748805
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
    -2934.642212422807, -1249.2334161136273, 212.32586293647574, -617.6176233299253,
    992.695491728621, 3313.9686251740095
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

static double out[STATES * 588], worst;
static double product[STATES * N];
static int failed;
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("orthoglide_2012: the %s is %s,\nthe header %s\n", part, signature, header);
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
    const modeler_tiled *const robot = orthoglide_2012_tiled();
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
    orthoglide_2012_observation(MANY, Q, QD, QDD, one, told);
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
    if (!belongs("library", orthoglide_2012_signature(),
            ORTHOGLIDE_2012_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", orthoglide_2012_tile_signature(),
            ORTHOGLIDE_2012_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(orthoglide_2012_base_parameters, 1, inputs,
            out, 53);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("orthoglide_2012_base_parameters", out,
            beta, 1, 53, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2012_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("orthoglide_2012_inverse_dynamics", out,
            at_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2012_gravity, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("orthoglide_2012_gravity", out,
            at_gravity, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2012_coriolis, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("orthoglide_2012_coriolis", out,
            at_coriolis, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2012_friction, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("orthoglide_2012_friction", out,
            at_friction, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2012_inertia_matrix, 2, inputs,
            out, 9, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("orthoglide_2012_inertia_matrix", out,
            at_inertia_matrix, 2, 9, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2012_forward_kinematics, 2, inputs,
            out, 216, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("orthoglide_2012_forward_kinematics", out,
            at_forward_kinematics, 2, 216, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2012_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("orthoglide_2012_close", out,
            at_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2012_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("orthoglide_2012_close_from", out,
            at_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2012_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("orthoglide_2012_coupling", out,
            at_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2012_platform_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_inverse_dynamics, out, sizeof(at_platform_inverse_dynamics));
    }
    compare("orthoglide_2012_platform_inverse_dynamics", out,
            at_platform_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2012_platform_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close, out, sizeof(at_platform_close));
    }
    compare("orthoglide_2012_platform_close", out,
            at_platform_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2012_platform_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close_from, out, sizeof(at_platform_close_from));
    }
    compare("orthoglide_2012_platform_close_from", out,
            at_platform_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2012_platform_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_coupling, out, sizeof(at_platform_coupling));
    }
    compare("orthoglide_2012_platform_coupling", out,
            at_platform_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2012_regressor, 2, inputs,
            out, 588, status);
    }
    multiply(out, 196, chi);
    compare("orthoglide_2012_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2012_base_regressor, 2, inputs,
            out, 159, status);
    }
    multiply(out, 53, beta);
    compare("orthoglide_2012_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, };

        modeler_batch_status_3(orthoglide_2012_platform_base_regressor, 2, inputs,
            out, 159, status);
    }
    multiply(out, 53, beta);
    compare("orthoglide_2012_platform_base_regressor", product,
            at_platform_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    orthoglide_2012_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("orthoglide_2012_observation", product, at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("orthoglide_2012_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("orthoglide_2012 %s:\n", ORTHOGLIDE_2012_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("18 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
