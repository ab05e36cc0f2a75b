/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of orthoglide_2012_tile.h.
 * This file includes itself once for every instruction set.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "orthoglide_2012_tile.h"

#include <string.h>

#include "orthoglide_2012_tree.h"

/* Lengths of orthoglide_2012_loops. */
#define GIVEN 3
#define UNKNOWNS 12
#define SOLVED 9
#define FACTORS 25
#define COUPLINGS 27
#define JACOBIAN 27
#define JACOBIAN_AT 9
#define TURNS_AT 36
#define LENGTH 48

/* Geometry; see orthoglide_2012.c. */
#ifndef ORTHOGLIDE_2012_GEO_g
#define ORTHOGLIDE_2012_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2012_GEO_d4
#define ORTHOGLIDE_2012_GEO_d4 0.31
#endif
#ifndef ORTHOGLIDE_2012_GEO_a
#define ORTHOGLIDE_2012_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2012_GEO_d6
#define ORTHOGLIDE_2012_GEO_d6 0.1
#endif

static const double orthoglide_2012_geo_g = ORTHOGLIDE_2012_GEO_g;
static const double orthoglide_2012_geo_d4 = ORTHOGLIDE_2012_GEO_d4;
static const double orthoglide_2012_geo_a = ORTHOGLIDE_2012_GEO_a;
static const double orthoglide_2012_geo_d6 = ORTHOGLIDE_2012_GEO_d6;

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2
};

static const int column[] = {
    0, 1, 2, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31,
    32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 3, 4, 5, 10,
    11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34,
    35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 6, 7, 8, 9, 10, 11, 12,
    13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36,
    37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52
};

#define ENTRIES 139

#define MODELER_BODY "orthoglide_2012_tile.c"
#include "modeler_versions.h"

#ifdef MODELER_APART /* who loads this library has them in another one */
#define SINGLES NULL
#else
static const struct orthoglide_2012_single singles = {&orthoglide_2012_loops, orthoglide_2012_posed, orthoglide_2012_tree_next, modeler_eliminated};
#define SINGLES &singles
#endif

#define TILED(version) \
    {3, 53, 0, ENTRIES, row, column, NULL, closing_##version, sizeof(closing_state), SINGLES}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *orthoglide_2012_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *orthoglide_2012_tile_signature(void)
{
    return "32a799aacf456c49";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

MODELER_TARGET static void MODELER_VERSION(closure)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT values)
{
    modeler_lanes s6, c6;
    modeler_lanes_sincos(q[6], &s6, &c6);
    modeler_lanes s7, c7;
    modeler_lanes_sincos(q[7], &s7, &c7);
    modeler_lanes s8, c8;
    modeler_lanes_sincos(q[8], &s8, &c8);
    modeler_lanes s9, c9;
    modeler_lanes_sincos(q[9], &s9, &c9);
    modeler_lanes s10, c10;
    modeler_lanes_sincos(q[10], &s10, &c10);
    modeler_lanes s11, c11;
    modeler_lanes_sincos(q[11], &s11, &c11);
    /* link 41: origin of the frame in frame 0, o41 = o31 + [x31 y31 z31] p41 */
const modeler_lanes o41_x = c6*c7*orthoglide_2012_geo_d4;
    values[0] = o41_x - q[0];
    values[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    /* link 51: velocity of the origin, for unit speed of each joint below, m51 = R51' (m41 + e41 x
    p51) */
const modeler_lanes minus_m51_21x = s6*c7*orthoglide_2012_geo_d4;
    values[2] = q[3] - minus_m51_21x + orthoglide_2012_geo_d6 - q[2];
    /* link 52: velocity of the origin, for unit speed of each joint below, m52 = R52' (m42 + e42 x
    p52) */
const modeler_lanes minus_m52_22x = s8*c9*orthoglide_2012_geo_d4;
    values[3] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[4] + minus_m52_22x) - q[0];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
const modeler_lanes o42_y = c8*c9*orthoglide_2012_geo_d4;
    values[4] = o42_y - q[1];
    values[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    values[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    /* link 53: velocity of the origin, for unit speed of each joint below, m53 = R53' (m43 + e43 x
    p53) */
const modeler_lanes minus_m53_23x = s10*c11*orthoglide_2012_geo_d4;
    values[7] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[5] + minus_m53_23x) - q[1];
    const modeler_lanes m53_23y = c10*c11*orthoglide_2012_geo_d4;
    values[8] = orthoglide_2012_geo_a + m53_23y - q[2];
    values[9] = modeler_lanes_spread(-1.0);
    values[10] = -minus_m51_21x;
    values[11] = -c6*s7*orthoglide_2012_geo_d4;
    values[12] = modeler_lanes_spread(-1.0);
    values[13] = -orthoglide_2012_geo_d4*c7;
    values[14] = modeler_lanes_spread(-1.0);
    values[15] = modeler_lanes_spread(1.0);
    values[16] = -o41_x;
    values[17] = s6*s7*orthoglide_2012_geo_d4;
    values[18] = modeler_lanes_spread(-1.0);
    values[19] = modeler_lanes_spread(1.0);
    values[20] = -o42_y;
    values[21] = s8*s9*orthoglide_2012_geo_d4;
    values[22] = modeler_lanes_spread(-1.0);
    values[23] = -minus_m52_22x;
    values[24] = -c8*s9*orthoglide_2012_geo_d4;
    values[25] = modeler_lanes_spread(-1.0);
    values[26] = -orthoglide_2012_geo_d4*c9;
    values[27] = modeler_lanes_spread(-1.0);
    values[28] = -orthoglide_2012_geo_d4*c11;
    values[29] = modeler_lanes_spread(-1.0);
    values[30] = modeler_lanes_spread(1.0);
    values[31] = -m53_23y;
    values[32] = s10*s11*orthoglide_2012_geo_d4;
    values[33] = modeler_lanes_spread(-1.0);
    values[34] = -minus_m53_23x;
    values[35] = -c10*s11*orthoglide_2012_geo_d4;
    values[36] = c6;
    values[37] = s6;
    values[38] = c7;
    values[39] = s7;
    values[40] = c8;
    values[41] = s8;
    values[42] = c9;
    values[43] = s9;
    values[44] = c10;
    values[45] = s10;
    values[46] = c11;
    values[47] = s11;
}

MODELER_TARGET static void MODELER_VERSION(residual)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT f)
{
    modeler_lanes s6, c6;
    modeler_lanes_sincos(q[6], &s6, &c6);
    modeler_lanes s7, c7;
    modeler_lanes_sincos(q[7], &s7, &c7);
    modeler_lanes s8, c8;
    modeler_lanes_sincos(q[8], &s8, &c8);
    modeler_lanes s9, c9;
    modeler_lanes_sincos(q[9], &s9, &c9);
    modeler_lanes s10, c10;
    modeler_lanes_sincos(q[10], &s10, &c10);
    modeler_lanes s11, c11;
    modeler_lanes_sincos(q[11], &s11, &c11);
    f[0] = c6*c7*orthoglide_2012_geo_d4 - q[0];
    f[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    f[2] = q[3] - s6*c7*orthoglide_2012_geo_d4 + orthoglide_2012_geo_d6 - q[2];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
const modeler_lanes minus_o42_x = orthoglide_2012_geo_a - q[4] + s8*c9*orthoglide_2012_geo_d4;
    f[3] = orthoglide_2012_geo_d6 - minus_o42_x - q[0];
    f[4] = c8*c9*orthoglide_2012_geo_d4 - q[1];
    f[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    f[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
const modeler_lanes minus_o43_y = orthoglide_2012_geo_a - q[5] + s10*c11*orthoglide_2012_geo_d4;
    f[7] = orthoglide_2012_geo_d6 - minus_o43_y - q[1];
    f[8] = orthoglide_2012_geo_a + c10*c11*orthoglide_2012_geo_d4 - q[2];
}

MODELER_TARGET static void MODELER_VERSION(factor)(
const modeler_lanes *J, modeler_lanes *MODELER_RESTRICT lu)
{
    const modeler_lanes t1 = 1.0/J[1];
    lu[0] = t1;
    const modeler_lanes t2 = 1.0/J[4];
    lu[1] = t2;
    const modeler_lanes t3 = 1.0/J[14];
    lu[2] = t3;
    const modeler_lanes t4 = 1.0/J[17];
    lu[3] = t4;
    lu[4] = modeler_lanes_spread(-1.0);
    const modeler_lanes t5 = 1.0/J[25];
    lu[5] = t5;
    lu[6] = modeler_lanes_spread(-1.0);
    const modeler_lanes t6 = J[11]*t3;
    const modeler_lanes t7 = (J[12] - J[15]*t6)*t4;
    const modeler_lanes t8 = J[7]*t1;
    const modeler_lanes t9 = J[19]*t8;
    const modeler_lanes t10 = 1.0/(J[19] - t7*t9);
    lu[7] = -t10;
    const modeler_lanes t11 = (J[8] - J[2]*t8)*t2;
    const modeler_lanes t12 = J[22]*t5;
    const modeler_lanes t13 = t6 + t11*t7;
    const modeler_lanes t14 = (J[23] - J[26]*t12 + t9*t12)*t10;
    lu[8] = -1.0/(1.0 - t11*t12 - t13*t14);
    lu[9] = J[2];
    lu[10] = t8;
    lu[11] = t11;
    lu[12] = J[15];
    lu[13] = t6;
    lu[14] = t7;
    lu[15] = J[19];
    lu[16] = -t8;
    lu[17] = J[26];
    lu[18] = t12;
    lu[19] = t11;
    lu[20] = t9;
    lu[21] = -t7;
    lu[22] = -t12;
    lu[23] = t13;
    lu[24] = -t14;
}

MODELER_TARGET static void MODELER_VERSION(solve)(
const modeler_lanes *lu, const modeler_lanes *right, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = right[2] - lu[10]*right[0] - lu[11]*right[1] - lu[16]*right[6];
    const modeler_lanes t2 = lu[14]*right[5] - (right[3] - lu[13]*right[4]) + right[6] + lu[21]*t1;
    const modeler_lanes t3 = lu[8]*(right[7] - lu[18]*right[8] - lu[22]*t1 + lu[24]*t2);
    const modeler_lanes t4 = lu[7]*(t2 + lu[23]*t3);
    const modeler_lanes t5 = lu[4]*(right[6] + lu[15]*t4);
    x[0] = t5;
    x[1] = t3;
    const modeler_lanes t6 = lu[6]*(t1 - lu[19]*t3 + lu[20]*t4);
    x[2] = t6;
    const modeler_lanes t7 = lu[1]*(right[1] + t3);
    x[3] = lu[0]*(right[0] + t5 - lu[9]*t7);
    x[4] = t7;
    const modeler_lanes t8 = lu[3]*(right[5] + t6);
    x[5] = lu[2]*(right[4] + t3 - lu[12]*t8);
    x[6] = t8;
    x[7] = lu[5]*(right[8] + t6 + lu[17]*t4);
    x[8] = -t4;
}

MODELER_TARGET static void MODELER_VERSION(coupling)(
const modeler_lanes *J, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT G)
{
    (void)J;
    const modeler_lanes t1 = lu[8]*(lu[22] - lu[21]*lu[24]);
    const modeler_lanes t2 = lu[7]*(lu[21] - lu[23]*t1);
    const modeler_lanes t3 = lu[15]*t2*lu[4];
    G[0] = -t3;
    G[1] = t1;
    const modeler_lanes t4 = lu[6]*(1.0 + lu[19]*t1 + lu[20]*t2);
    G[2] = -t4;
    const modeler_lanes t5 = lu[1]*t1;
    G[3] = -lu[0]*(t3 + lu[9]*t5);
    G[4] = t5;
    const modeler_lanes t6 = lu[3]*t4;
    G[5] = lu[2]*(t1 + lu[12]*t6);
    G[6] = -t6;
    G[7] = -lu[5]*(t4 + lu[17]*t2);
    G[8] = t2;
    const modeler_lanes t7 = lu[8]*lu[24];
    const modeler_lanes t8 = lu[7]*(1.0 + lu[23]*t7);
    const modeler_lanes t9 = lu[15]*t8*lu[4];
    G[9] = t9;
    G[10] = t7;
    const modeler_lanes t10 = lu[6]*(lu[19]*t7 - lu[20]*t8);
    G[11] = -t10;
    const modeler_lanes t11 = lu[1]*t7;
    G[12] = lu[0]*(t9 - lu[9]*t11);
    G[13] = t11;
    const modeler_lanes t12 = lu[3]*t10;
    G[14] = lu[2]*(t7 + lu[12]*t12);
    G[15] = -t12;
    G[16] = -lu[5]*(t10 - lu[17]*t8);
    G[17] = -t8;
    const modeler_lanes t13 = lu[8]*lu[23]*lu[7];
    const modeler_lanes t14 = lu[15]*t13*lu[4];
    G[18] = -t14;
    G[19] = -lu[8];
    const modeler_lanes t15 = lu[6]*(lu[8]*lu[19] - lu[20]*t13);
    G[20] = t15;
    const modeler_lanes t16 = lu[1]*lu[8];
    G[21] = -lu[0]*(t14 - lu[9]*t16);
    G[22] = -t16;
    const modeler_lanes t17 = lu[3]*t15;
    G[23] = -lu[2]*(lu[8] + lu[12]*t17);
    G[24] = t17;
    G[25] = lu[5]*(t15 - lu[17]*t13);
    G[26] = t13;
}

MODELER_TARGET static void MODELER_VERSION(turned)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const double k1 = fabs(1.0);
    const modeler_lanes t1 = modeler_lanes_fabs(J[19] - K[19]);
    const modeler_lanes t2 = modeler_lanes_fabs(J[14] - K[14]) + modeler_lanes_fabs(J[15] - K[15]);
    const modeler_lanes t3 = modeler_lanes_fabs(J[11] - K[11]) + modeler_lanes_fabs(J[12] - K[12]);
    const modeler_lanes t4 = modeler_lanes_fabs(J[17] - K[17]);
    const modeler_lanes t5 = modeler_lanes_fabs(J[1] - K[1]) + modeler_lanes_fabs(J[2] - K[2]);
    const modeler_lanes t6 = modeler_lanes_fabs(J[7] - K[7]) + modeler_lanes_fabs(J[8] - K[8]);
    const modeler_lanes t7 = modeler_lanes_fabs(J[4] - K[4]);
    const modeler_lanes t8 = t6 + t5*modeler_lanes_fabs(lu[10]) + t7*modeler_lanes_fabs(lu[11]);
    const modeler_lanes t9 = t8 + t1*modeler_lanes_fabs(lu[16]);
    const modeler_lanes t10 = t3 + t2*modeler_lanes_fabs(lu[13]) + t4*modeler_lanes_fabs(lu[14]) +
    k1*t1;
    const modeler_lanes t11 = t10 + t9*modeler_lanes_fabs(lu[21]);
    const modeler_lanes t12 = modeler_lanes_fabs(J[25] - K[25]) + modeler_lanes_fabs(J[26] - K[26]);
    const modeler_lanes t13 = modeler_lanes_fabs(J[22] - K[22]) + modeler_lanes_fabs(J[23] - K[23]);
    const modeler_lanes t14 = t13 + t12*modeler_lanes_fabs(lu[18]) + t9*modeler_lanes_fabs(lu[22]);
    const modeler_lanes t15 = (t14 + t11*modeler_lanes_fabs(lu[24]))*modeler_lanes_fabs(lu[8]);
    const modeler_lanes t16 = (t11 + t15*modeler_lanes_fabs(lu[23]))*modeler_lanes_fabs(lu[7]);
    const modeler_lanes t17 = (t1 + t16*modeler_lanes_fabs(lu[15]))*modeler_lanes_fabs(lu[4]);
    x[0] = (1000000000000000.0/848528137423857.0)*t17;
    x[1] = (1000000000000000.0/848528137423857.0)*t15;
    const modeler_lanes t18 = t9 + t15*modeler_lanes_fabs(lu[19]) + t16*modeler_lanes_fabs(lu[20]);
    const modeler_lanes t19 = t18*modeler_lanes_fabs(lu[6]);
    x[2] = (1000000000000000.0/848528137423857.0)*t19;
    const modeler_lanes t20 = k1*t15;
    const modeler_lanes t21 = (t7 + t20)*modeler_lanes_fabs(lu[1]);
    x[3] = (t5 + k1*t17 + t21*modeler_lanes_fabs(lu[9]))*modeler_lanes_fabs(lu[0]);
    x[4] = t21;
    const modeler_lanes t22 = k1*t19;
    const modeler_lanes t23 = (t4 + t22)*modeler_lanes_fabs(lu[3]);
    x[5] = (t2 + t20 + t23*modeler_lanes_fabs(lu[12]))*modeler_lanes_fabs(lu[2]);
    x[6] = t23;
    x[7] = (t12 + t22 + t16*modeler_lanes_fabs(lu[17]))*modeler_lanes_fabs(lu[5]);
    x[8] = t16;
}

MODELER_TARGET static void MODELER_VERSION(spread)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = J[1] - K[1];
    const modeler_lanes t2 = J[7] - K[7] - lu[10]*t1;
    const modeler_lanes t3 = lu[21]*t2;
    const modeler_lanes t4 = lu[8]*(lu[22]*t2 - lu[24]*t3);
    const modeler_lanes t5 = lu[7]*(t3 - lu[23]*t4);
    const modeler_lanes t6 = lu[15]*t5*lu[4];
    const modeler_lanes t7 = (1000000000000000.0/848528137423857.0)*t6;
    const modeler_lanes t8 = (1000000000000000.0/848528137423857.0)*t4;
    const modeler_lanes t9 = lu[6]*(t2 + lu[19]*t4 + lu[20]*t5);
    const modeler_lanes t10 = (1000000000000000.0/848528137423857.0)*t9;
    const modeler_lanes t11 = lu[1]*t4;
    const modeler_lanes t12 = lu[0]*(t1 + t6 + lu[9]*t11);
    const modeler_lanes t13 = lu[3]*t9;
    const modeler_lanes t14 = lu[2]*(t4 + lu[12]*t13);
    const modeler_lanes t15 = lu[5]*(t9 + lu[17]*t5);
    const modeler_lanes t16 = t7*t7 + t8*t8 + t10*t10 + t12*t12 + t11*t11 + t14*t14 + t13*t13 +
    t15*t15;
    const modeler_lanes t17 = J[2] - K[2];
    const modeler_lanes t18 = J[4] - K[4];
    const modeler_lanes t19 = J[8] - K[8] - lu[10]*t17 - lu[11]*t18;
    const modeler_lanes t20 = lu[21]*t19;
    const modeler_lanes t21 = lu[8]*(lu[22]*t19 - lu[24]*t20);
    const modeler_lanes t22 = lu[7]*(t20 - lu[23]*t21);
    const modeler_lanes t23 = lu[15]*t22*lu[4];
    const modeler_lanes t24 = (1000000000000000.0/848528137423857.0)*t23;
    const modeler_lanes t25 = (1000000000000000.0/848528137423857.0)*t21;
    const modeler_lanes t26 = lu[6]*(t19 + lu[19]*t21 + lu[20]*t22);
    const modeler_lanes t27 = (1000000000000000.0/848528137423857.0)*t26;
    const modeler_lanes t28 = lu[1]*(t18 - t21);
    const modeler_lanes t29 = lu[0]*(t17 + t23 - lu[9]*t28);
    const modeler_lanes t30 = lu[3]*t26;
    const modeler_lanes t31 = lu[2]*(t21 + lu[12]*t30);
    const modeler_lanes t32 = t16 + t5*t5 + t24*t24 + t25*t25 + t27*t27 + t29*t29 + t28*t28 +
    t31*t31;
    const modeler_lanes t33 = lu[5]*(t26 + lu[17]*t22);
    const modeler_lanes t34 = J[14] - K[14];
    const modeler_lanes t35 = J[11] - K[11] - lu[13]*t34;
    const modeler_lanes t36 = lu[24]*t35*lu[8];
    const modeler_lanes t37 = lu[7]*(t35 + lu[23]*t36);
    const modeler_lanes t38 = lu[15]*t37*lu[4];
    const modeler_lanes t39 = (1000000000000000.0/848528137423857.0)*t38;
    const modeler_lanes t40 = (1000000000000000.0/848528137423857.0)*t36;
    const modeler_lanes t41 = lu[6]*(lu[19]*t36 - lu[20]*t37);
    const modeler_lanes t42 = (1000000000000000.0/848528137423857.0)*t41;
    const modeler_lanes t43 = lu[1]*t36;
    const modeler_lanes t44 = lu[0]*(t38 - lu[9]*t43);
    const modeler_lanes t45 = t32 + t30*t30 + t33*t33 + t22*t22 + t39*t39 + t40*t40 + t42*t42 +
    t44*t44;
    const modeler_lanes t46 = lu[3]*t41;
    const modeler_lanes t47 = lu[2]*(t34 - t36 - lu[12]*t46);
    const modeler_lanes t48 = lu[5]*(t41 - lu[17]*t37);
    const modeler_lanes t49 = J[15] - K[15];
    const modeler_lanes t50 = J[17] - K[17];
    const modeler_lanes t51 = J[12] - K[12] - lu[13]*t49 - lu[14]*t50;
    const modeler_lanes t52 = lu[24]*t51*lu[8];
    const modeler_lanes t53 = lu[7]*(t51 + lu[23]*t52);
    const modeler_lanes t54 = lu[15]*t53*lu[4];
    const modeler_lanes t55 = (1000000000000000.0/848528137423857.0)*t54;
    const modeler_lanes t56 = (1000000000000000.0/848528137423857.0)*t52;
    const modeler_lanes t57 = lu[6]*(lu[19]*t52 - lu[20]*t53);
    const modeler_lanes t58 = (1000000000000000.0/848528137423857.0)*t57;
    const modeler_lanes t59 = t45 + t43*t43 + t47*t47 + t46*t46 + t48*t48 + t37*t37 + t55*t55 +
    t56*t56;
    const modeler_lanes t60 = lu[1]*t52;
    const modeler_lanes t61 = lu[0]*(t54 - lu[9]*t60);
    const modeler_lanes t62 = lu[3]*(t50 + t57);
    const modeler_lanes t63 = lu[2]*(t49 - t52 - lu[12]*t62);
    const modeler_lanes t64 = lu[5]*(t57 - lu[17]*t53);
    const modeler_lanes t65 = J[25] - K[25];
    const modeler_lanes t66 = lu[8]*(J[22] - K[22] - lu[18]*t65);
    const modeler_lanes t67 = lu[23]*t66*lu[7];
    const modeler_lanes t68 = lu[15]*t67*lu[4];
    const modeler_lanes t69 = (1000000000000000.0/848528137423857.0)*t68;
    const modeler_lanes t70 = t59 + t58*t58 + t61*t61 + t60*t60 + t63*t63 + t62*t62 + t64*t64 +
    t53*t53;
    const modeler_lanes t71 = (1000000000000000.0/848528137423857.0)*t66;
    const modeler_lanes t72 = lu[6]*(lu[19]*t66 - lu[20]*t67);
    const modeler_lanes t73 = (1000000000000000.0/848528137423857.0)*t72;
    const modeler_lanes t74 = lu[1]*t66;
    const modeler_lanes t75 = lu[0]*(t68 - lu[9]*t74);
    const modeler_lanes t76 = lu[3]*t72;
    const modeler_lanes t77 = lu[2]*(t66 + lu[12]*t76);
    const modeler_lanes t78 = lu[5]*(t65 - t72 + lu[17]*t67);
    const modeler_lanes t79 = t70 + t69*t69 + t71*t71 + t73*t73 + t75*t75 + t74*t74 + t77*t77 +
    t76*t76;
    const modeler_lanes t80 = J[19] - K[19];
    const modeler_lanes t81 = lu[16]*t80;
    const modeler_lanes t82 = t80 - lu[21]*t81;
    const modeler_lanes t83 = J[26] - K[26];
    const modeler_lanes t84 = lu[8]*(J[23] - K[23] - lu[18]*t83 + lu[22]*t81 + lu[24]*t82);
    const modeler_lanes t85 = lu[7]*(t82 + lu[23]*t84);
    const modeler_lanes t86 = lu[4]*(t80 + lu[15]*t85);
    const modeler_lanes t87 = (1000000000000000.0/848528137423857.0)*t86;
    const modeler_lanes t88 = (1000000000000000.0/848528137423857.0)*t84;
    const modeler_lanes t89 = lu[6]*(t81 + lu[19]*t84 - lu[20]*t85);
    const modeler_lanes t90 = (1000000000000000.0/848528137423857.0)*t89;
    const modeler_lanes t91 = lu[1]*t84;
    const modeler_lanes t92 = lu[0]*(t86 - lu[9]*t91);
    const modeler_lanes t93 = lu[3]*t89;
    const modeler_lanes t94 = lu[2]*(t84 + lu[12]*t93);
    const modeler_lanes t95 = t79 + t78*t78 + t67*t67 + t87*t87 + t88*t88 + t90*t90 + t92*t92 +
    t91*t91;
    const modeler_lanes t96 = lu[5]*(t83 - t89 + lu[17]*t85);
    x[0] = t95 + t94*t94 + t93*t93 + t96*t96 + t85*t85;
}

MODELER_TARGET static void MODELER_VERSION(rows)(
const modeler_lanes *q, const modeler_lanes *t, const modeler_lanes *G, const modeler_lanes *lu, const modeler_lanes *v, const modeler_lanes *a, double *values)
{
    (void)q;
    MODELER_PUT(0) = a[0];
    MODELER_PUT(1) = v[0];
    MODELER_PUT(2) = modeler_lanes_sign(v[0]);
    MODELER_PUT(46) = a[1];
    MODELER_PUT(47) = v[1];
    MODELER_PUT(48) = modeler_lanes_sign(v[1]);
    const modeler_lanes t1 = orthoglide_2012_geo_g - a[2];
    MODELER_PUT(92) = -t1;
    MODELER_PUT(93) = a[2];
    MODELER_PUT(94) = v[2];
    MODELER_PUT(95) = modeler_lanes_sign(v[2]);
    const modeler_lanes t2 = G[3]*v[0] + G[12]*v[1] + G[21]*v[2];
    const modeler_lanes t3 = t[0]*t2;
    const modeler_lanes t4 = G[4]*v[0] + G[13]*v[1] + G[22]*v[2];
    const modeler_lanes t5 = t[3]*t4;
    const modeler_lanes t6 = t[1]*t2;
    const modeler_lanes t7 = t[2]*t4;
    const modeler_lanes t8 = orthoglide_2012_geo_d4*(t[2]*t3 - t[1]*t5)*t2;
    const modeler_lanes t9 = t8 - orthoglide_2012_geo_d4*(t[3]*t6 - t[0]*t7)*t4;
    const modeler_lanes t10 = G[8]*v[0] + G[17]*v[1] + G[26]*v[2];
    const modeler_lanes t11 = t[11]*t10;
    const modeler_lanes t12 = orthoglide_2012_geo_d4*t11*t10;
    const modeler_lanes t13 = G[5]*v[0] + G[14]*v[1] + G[23]*v[2];
    const modeler_lanes t14 = t[5]*t13;
    const modeler_lanes t15 = G[6]*v[0] + G[15]*v[1] + G[24]*v[2];
    const modeler_lanes t16 = t[7]*t15;
    const modeler_lanes t17 = t[4]*t13;
    const modeler_lanes t18 = t[6]*t15;
    const modeler_lanes t19 = orthoglide_2012_geo_d4*(t[6]*t14 + t[4]*t16)*t13;
    const modeler_lanes t20 = orthoglide_2012_geo_d4*(t[6]*t17 - t[5]*t16)*t13;
    const modeler_lanes t21 = t20 - orthoglide_2012_geo_d4*(t[7]*t14 - t[4]*t18)*t15;
    const modeler_lanes t22 = orthoglide_2012_geo_d4*t16*t15;
    const modeler_lanes t23 = t19 + orthoglide_2012_geo_d4*(t[7]*t17 + t[5]*t18)*t15 + lu[13]*t21;
    const modeler_lanes t24 = orthoglide_2012_geo_d4*(t[2]*t6 + t[0]*t5)*t2;
    const modeler_lanes t25 = orthoglide_2012_geo_d4*t5*t4;
    const modeler_lanes t26 = t24 + orthoglide_2012_geo_d4*(t[3]*t3 + t[1]*t7)*t4 + lu[10]*t9;
    const modeler_lanes t27 = t26 - lu[11]*t25 - lu[16]*t12;
    const modeler_lanes t28 = lu[14]*t22 - t23 + t12 + lu[21]*t27;
    const modeler_lanes t29 = G[7]*v[0] + G[16]*v[1] + G[25]*v[2];
    const modeler_lanes t30 = t[9]*t29;
    const modeler_lanes t31 = t[8]*t29;
    const modeler_lanes t32 = t[10]*t10;
    const modeler_lanes t33 = orthoglide_2012_geo_d4*(t[10]*t30 + t[8]*t11)*t29;
    const modeler_lanes t34 = orthoglide_2012_geo_d4*(t[10]*t31 - t[9]*t11)*t29;
    const modeler_lanes t35 = t34 - orthoglide_2012_geo_d4*(t[11]*t30 - t[8]*t32)*t10;
    const modeler_lanes t36 = t33 + orthoglide_2012_geo_d4*(t[11]*t31 + t[9]*t32)*t10 + lu[18]*t35;
    const modeler_lanes t37 = lu[8]*(t36 - lu[22]*t27 + lu[24]*t28);
    const modeler_lanes t38 = lu[7]*(t28 + lu[23]*t37);
    const modeler_lanes t39 = lu[1]*(t25 + t37);
    const modeler_lanes t40 = lu[0]*(t9 - lu[4]*(t12 + lu[15]*t38) + lu[9]*t39);
    const modeler_lanes t41 = G[3]*a[0] + G[12]*a[1] + G[21]*a[2] + t40;
    MODELER_PUT(3) = G[3]*t41;
    MODELER_PUT(49) = G[12]*t41;
    MODELER_PUT(96) = G[21]*t41;
    const modeler_lanes t42 = t2*t2;
    const modeler_lanes t43 = t[1]*t42 - t[0]*t41;
    const modeler_lanes t44 = t[0]*a[0];
    MODELER_PUT(4) = t43 - G[3]*t44;
    MODELER_PUT(50) = -G[12]*t44;
    MODELER_PUT(97) = -G[21]*t44;
    const modeler_lanes t45 = t[1]*a[0];
    MODELER_PUT(5) = t[1]*t41 + t[0]*t42 + G[3]*t45;
    MODELER_PUT(51) = G[12]*t45;
    MODELER_PUT(98) = G[21]*t45;
    MODELER_PUT(6) = G[3]*t2;
    MODELER_PUT(52) = G[12]*t2;
    MODELER_PUT(99) = G[21]*t2;
    const modeler_lanes t46 = modeler_lanes_sign(t2);
    MODELER_PUT(7) = G[3]*t46;
    MODELER_PUT(53) = G[12]*t46;
    MODELER_PUT(100) = G[21]*t46;
    const modeler_lanes t47 = t[3]*t41;
    const modeler_lanes t48 = t[2]*t2;
    const modeler_lanes t49 = t4*t48;
    const modeler_lanes t50 = t47 + t49;
    const modeler_lanes t51 = t[3]*t2;
    const modeler_lanes t52 = t4*t51;
    const modeler_lanes t53 = t[3]*t50 + t[2]*t52;
    const modeler_lanes t54 = t51*t48;
    MODELER_PUT(8) = G[3]*t53 - G[4]*t54;
    MODELER_PUT(54) = G[12]*t53 - G[13]*t54;
    MODELER_PUT(101) = G[21]*t53 - G[22]*t54;
    const modeler_lanes t55 = t[2]*t41;
    const modeler_lanes t56 = t52 - t55 + t52;
    const modeler_lanes t57 = t49 + t50;
    const modeler_lanes t58 = t[3]*t56 - t[2]*t57;
    const modeler_lanes t59 = t4*t4;
    const modeler_lanes t60 = t48*t48 + t59;
    const modeler_lanes t61 = t51*t51 + t59;
    const modeler_lanes t62 = t60 - t61;
    MODELER_PUT(9) = -(G[3]*t58 + G[4]*t62);
    MODELER_PUT(55) = -(G[12]*t58 + G[13]*t62);
    MODELER_PUT(102) = -(G[21]*t58 + G[22]*t62);
    const modeler_lanes t63 = t39 - (G[4]*a[0] + G[13]*a[1] + G[22]*a[2]);
    const modeler_lanes t64 = t63 - t54;
    const modeler_lanes t65 = t[3]*t64 + t[2]*(t42 - t60);
    MODELER_PUT(10) = G[3]*t65 - G[4]*t47;
    MODELER_PUT(56) = G[12]*t65 - G[13]*t47;
    MODELER_PUT(103) = G[21]*t65 - G[22]*t47;
    const modeler_lanes t66 = t63 + t54;
    const modeler_lanes t67 = t[3]*(t42 - t61) - t[2]*t66;
    MODELER_PUT(11) = -(G[3]*t67 + G[4]*t55);
    MODELER_PUT(57) = -(G[12]*t67 + G[13]*t55);
    MODELER_PUT(104) = -(G[21]*t67 + G[22]*t55);
    MODELER_PUT(12) = -G[4]*t63;
    MODELER_PUT(58) = -G[13]*t63;
    MODELER_PUT(105) = -G[22]*t63;
    const modeler_lanes t68 = t[1]*t[2];
    const modeler_lanes t69 = t[1]*t[3];
    const modeler_lanes t70 = t[2]*t44;
    const modeler_lanes t71 = orthoglide_2012_geo_g*t[2] + t[3]*t45;
    MODELER_PUT(13) = t68*t60 - t69*t64 + t[0]*t56 - G[3]*t70 + G[4]*t71;
    MODELER_PUT(59) = G[13]*t71 - G[12]*t70;
    MODELER_PUT(106) = G[22]*t71 - G[21]*t70;
    const modeler_lanes t72 = t[3]*t44;
    const modeler_lanes t73 = t[2]*t45 - orthoglide_2012_geo_g*t[3];
    MODELER_PUT(14) = G[4]*t73 - (t68*t66 + t69*t61 - t[0]*t57 - G[3]*t72);
    MODELER_PUT(60) = G[12]*t72 + G[13]*t73;
    MODELER_PUT(107) = G[21]*t72 + G[22]*t73;
    MODELER_PUT(15) = G[4]*t4;
    MODELER_PUT(61) = G[13]*t4;
    MODELER_PUT(108) = G[22]*t4;
    const modeler_lanes t74 = modeler_lanes_sign(t4);
    MODELER_PUT(16) = G[4]*t74;
    MODELER_PUT(62) = G[13]*t74;
    MODELER_PUT(109) = G[22]*t74;
    const modeler_lanes t75 = t44 + orthoglide_2012_geo_d4*t56 - orthoglide_2012_geo_d4*t[2]*t41;
    const modeler_lanes t76 = orthoglide_2012_geo_d4*t[3]*t42;
    MODELER_PUT(17) = t43 - G[3]*t75 + G[4]*t76;
    MODELER_PUT(63) = G[13]*t76 - G[12]*t75;
    MODELER_PUT(110) = G[22]*t76 - G[21]*t75;
    const modeler_lanes t77 = lu[6]*(t27 - lu[19]*t37 + lu[20]*t38);
    const modeler_lanes t78 = lu[3]*(t22 + t77);
    const modeler_lanes t79 = G[5]*a[0] + G[14]*a[1] + G[23]*a[2] + lu[2]*(t21 - t37 + lu[12]*t78);
    MODELER_PUT(18) = G[5]*t79;
    MODELER_PUT(64) = G[14]*t79;
    MODELER_PUT(111) = G[23]*t79;
    const modeler_lanes t80 = t[4]*a[1] - orthoglide_2012_geo_g*t[5];
    MODELER_PUT(19) = -G[5]*t80;
    const modeler_lanes t81 = t13*t13;
    const modeler_lanes t82 = t[5]*t81 - t[4]*t79;
    MODELER_PUT(65) = t82 - G[14]*t80;
    MODELER_PUT(112) = -G[23]*t80;
    const modeler_lanes t83 = orthoglide_2012_geo_g*t[4] + t[5]*a[1];
    MODELER_PUT(20) = G[5]*t83;
    MODELER_PUT(66) = t[5]*t79 + t[4]*t81 + G[14]*t83;
    MODELER_PUT(113) = G[23]*t83;
    MODELER_PUT(21) = G[5]*t13;
    MODELER_PUT(67) = G[14]*t13;
    MODELER_PUT(114) = G[23]*t13;
    const modeler_lanes t84 = modeler_lanes_sign(t13);
    MODELER_PUT(22) = G[5]*t84;
    MODELER_PUT(68) = G[14]*t84;
    MODELER_PUT(115) = G[23]*t84;
    const modeler_lanes t85 = t[7]*t79;
    const modeler_lanes t86 = t[6]*t13;
    const modeler_lanes t87 = t15*t86;
    const modeler_lanes t88 = t85 + t87;
    const modeler_lanes t89 = t[7]*t13;
    const modeler_lanes t90 = t15*t89;
    const modeler_lanes t91 = t[7]*t88 + t[6]*t90;
    const modeler_lanes t92 = t89*t86;
    MODELER_PUT(23) = G[5]*t91 - G[6]*t92;
    MODELER_PUT(69) = G[14]*t91 - G[15]*t92;
    MODELER_PUT(116) = G[23]*t91 - G[24]*t92;
    const modeler_lanes t93 = t[6]*t79;
    const modeler_lanes t94 = t90 - t93 + t90;
    const modeler_lanes t95 = t87 + t88;
    const modeler_lanes t96 = t[7]*t94 - t[6]*t95;
    const modeler_lanes t97 = t15*t15;
    const modeler_lanes t98 = t86*t86 + t97;
    const modeler_lanes t99 = t89*t89 + t97;
    const modeler_lanes t100 = t98 - t99;
    MODELER_PUT(24) = -(G[5]*t96 + G[6]*t100);
    MODELER_PUT(70) = -(G[14]*t96 + G[15]*t100);
    MODELER_PUT(117) = -(G[23]*t96 + G[24]*t100);
    const modeler_lanes t101 = t78 - (G[6]*a[0] + G[15]*a[1] + G[24]*a[2]);
    const modeler_lanes t102 = t[7]*(t101 - t92) + t[6]*(t81 - t98);
    MODELER_PUT(25) = G[5]*t102 - G[6]*t85;
    MODELER_PUT(71) = G[14]*t102 - G[15]*t85;
    MODELER_PUT(118) = G[23]*t102 - G[24]*t85;
    const modeler_lanes t103 = t101 + t92;
    const modeler_lanes t104 = t[7]*(t81 - t99) - t[6]*t103;
    MODELER_PUT(26) = -(G[5]*t104 + G[6]*t93);
    MODELER_PUT(72) = -(G[14]*t104 + G[15]*t93);
    MODELER_PUT(119) = -(G[23]*t104 + G[24]*t93);
    MODELER_PUT(27) = -G[6]*t101;
    MODELER_PUT(73) = -G[15]*t101;
    MODELER_PUT(120) = -G[24]*t101;
    const modeler_lanes t105 = t[7]*t80;
    const modeler_lanes t106 = t[6]*t83;
    MODELER_PUT(28) = G[5]*t105 + G[6]*t106;
    MODELER_PUT(74) = G[15]*t106 - (t[5]*t[6]*t103 + t[5]*t[7]*t99 - t[4]*t95 - G[14]*t105);
    MODELER_PUT(121) = G[23]*t105 + G[24]*t106;
    MODELER_PUT(29) = G[6]*t15;
    MODELER_PUT(75) = G[15]*t15;
    MODELER_PUT(122) = G[24]*t15;
    const modeler_lanes t107 = modeler_lanes_sign(t15);
    MODELER_PUT(30) = G[6]*t107;
    MODELER_PUT(76) = G[15]*t107;
    MODELER_PUT(123) = G[24]*t107;
    const modeler_lanes t108 = t80 + orthoglide_2012_geo_d4*t94 - orthoglide_2012_geo_d4*t[6]*t79;
    const modeler_lanes t109 = orthoglide_2012_geo_d4*t[7]*t81;
    MODELER_PUT(31) = G[6]*t109 - G[5]*t108;
    MODELER_PUT(77) = t82 - G[14]*t108 + G[15]*t109;
    MODELER_PUT(124) = G[24]*t109 - G[23]*t108;
    const modeler_lanes t110 = G[7]*a[0] + G[16]*a[1] + G[25]*a[2] + lu[5]*(t35 - t77 - lu[17]*t38);
    MODELER_PUT(32) = G[7]*t110;
    MODELER_PUT(78) = G[16]*t110;
    MODELER_PUT(125) = G[25]*t110;
    const modeler_lanes t111 = t[8]*t1;
    MODELER_PUT(33) = G[7]*t111;
    MODELER_PUT(79) = G[16]*t111;
    const modeler_lanes t112 = t29*t29;
    const modeler_lanes t113 = t[9]*t112 - t[8]*t110;
    MODELER_PUT(126) = t113 + G[25]*t111;
    const modeler_lanes t114 = t[9]*t1;
    MODELER_PUT(34) = -G[7]*t114;
    MODELER_PUT(80) = -G[16]*t114;
    MODELER_PUT(127) = t[9]*t110 + t[8]*t112 - G[25]*t114;
    MODELER_PUT(35) = G[7]*t29;
    MODELER_PUT(81) = G[16]*t29;
    MODELER_PUT(128) = G[25]*t29;
    const modeler_lanes t115 = modeler_lanes_sign(t29);
    MODELER_PUT(36) = G[7]*t115;
    MODELER_PUT(82) = G[16]*t115;
    MODELER_PUT(129) = G[25]*t115;
    const modeler_lanes t116 = t[11]*t110;
    const modeler_lanes t117 = t[10]*t29;
    const modeler_lanes t118 = t10*t117;
    const modeler_lanes t119 = t116 + t118;
    const modeler_lanes t120 = t[11]*t29;
    const modeler_lanes t121 = t10*t120;
    const modeler_lanes t122 = t[11]*t119 + t[10]*t121;
    const modeler_lanes t123 = t120*t117;
    MODELER_PUT(37) = G[7]*t122 - G[8]*t123;
    MODELER_PUT(83) = G[16]*t122 - G[17]*t123;
    MODELER_PUT(130) = G[25]*t122 - G[26]*t123;
    const modeler_lanes t124 = t[10]*t110;
    const modeler_lanes t125 = t121 - t124 + t121;
    const modeler_lanes t126 = t118 + t119;
    const modeler_lanes t127 = t[11]*t125 - t[10]*t126;
    const modeler_lanes t128 = t10*t10;
    const modeler_lanes t129 = t117*t117 + t128;
    const modeler_lanes t130 = t120*t120 + t128;
    const modeler_lanes t131 = t129 - t130;
    MODELER_PUT(38) = -(G[7]*t127 + G[8]*t131);
    MODELER_PUT(84) = -(G[16]*t127 + G[17]*t131);
    MODELER_PUT(131) = -(G[25]*t127 + G[26]*t131);
    const modeler_lanes t132 = G[8]*a[0] + G[17]*a[1] + G[26]*a[2] + t38;
    const modeler_lanes t133 = t[11]*(t132 + t123) - t[10]*(t112 - t129);
    MODELER_PUT(39) = -(G[7]*t133 + G[8]*t116);
    MODELER_PUT(85) = -(G[16]*t133 + G[17]*t116);
    MODELER_PUT(132) = -(G[25]*t133 + G[26]*t116);
    const modeler_lanes t134 = t132 - t123;
    const modeler_lanes t135 = t[11]*(t112 - t130) + t[10]*t134;
    MODELER_PUT(40) = -(G[7]*t135 + G[8]*t124);
    MODELER_PUT(86) = -(G[16]*t135 + G[17]*t124);
    MODELER_PUT(133) = -(G[25]*t135 + G[26]*t124);
    MODELER_PUT(41) = G[8]*t132;
    MODELER_PUT(87) = G[17]*t132;
    MODELER_PUT(134) = G[26]*t132;
    const modeler_lanes t136 = t[11]*t111;
    const modeler_lanes t137 = t[10]*t114;
    MODELER_PUT(42) = -(G[7]*t136 + G[8]*t137);
    MODELER_PUT(88) = -(G[16]*t136 + G[17]*t137);
    MODELER_PUT(135) = t[9]*t[10]*t134 - t[9]*t[11]*t130 + t[8]*t126 - G[25]*t136 - G[26]*t137;
    MODELER_PUT(43) = G[8]*t10;
    MODELER_PUT(89) = G[17]*t10;
    MODELER_PUT(136) = G[26]*t10;
    const modeler_lanes t138 = modeler_lanes_sign(t10);
    MODELER_PUT(44) = G[8]*t138;
    MODELER_PUT(90) = G[17]*t138;
    MODELER_PUT(137) = G[26]*t138;
    const modeler_lanes t139 = t111 - orthoglide_2012_geo_d4*t125 +
    orthoglide_2012_geo_d4*t[10]*t110;
    const modeler_lanes t140 = orthoglide_2012_geo_d4*t[11]*t112;
    MODELER_PUT(45) = G[7]*t139 + G[8]*t140;
    MODELER_PUT(91) = G[16]*t139 + G[17]*t140;
    MODELER_PUT(138) = t113 + G[25]*t139 + G[26]*t140;
}

#include "modeler_closing.h"

#ifndef ONE_BY_ONE
#define ONE_BY_ONE

typedef struct {
    int anchored; /* tiles can start from `from` */
    int posed;    /* p is the last posture, and `from` is not later */
    modeler_anchor from;
    struct orthoglide_2012_posture p;
    double rows[UNKNOWNS * ORTHOGLIDE_2012_BASE_PARAMETERS], phi[GIVEN * ORTHOGLIDE_2012_BASE_PARAMETERS];
} closing_state;

/* Samples one after another, from the posture of the last one. */
static void one_by_one(const struct orthoglide_2012_single *one, const double *q, const double *qd, const double *qdd,
                       size_t samples, closing_state *state, double *values, int *status)
{
    const modeler_closure *const loops = one->loops;
    modeler_anchor *const from = &state->from;
    const double *f, *lu, *G;
    int next = state->posed;

    if (state->anchored && !next) {
        double at[GIVEN];

        for (int j = 0; j < GIVEN; j++) {
            at[j] = from->u[loops->given_places[j]];
        }
        next = one->posed(loops, at, from->u, &state->p) == MODELER_CLOSED;
    }
    for (size_t i = 0; i < samples; i++) {
        status[i] = one->next(q + i * GIVEN, qd + i * GIVEN, qdd + i * GIVEN, next, &state->p,
                              state->rows, state->phi);
        next = status[i] == MODELER_CLOSED;
        for (size_t k = 0; k < ENTRIES; k++) {
            values[k * MODELER_LANES + i] = state->phi[row[k] * ORTHOGLIDE_2012_BASE_PARAMETERS + column[k]];
        }
    }
    state->posed = next;
    state->anchored = 0;
    if (next != 0) {
        const modeler_work work = {&state->p.kept, state->p.places, state->p.numbers, 0};

        state->anchored = one->eliminated(loops, &work, &f, &lu, &G);
    }
    if (state->anchored != 0) {
        memset(from, 0, sizeof *from);
        memcpy(from->u, state->p.u, sizeof from->u);
        memcpy(from->J, f + JACOBIAN_AT, sizeof from->J);
        memcpy(from->lu, lu, sizeof from->lu);
        memcpy(from->G, G, sizeof from->G);
        for (int k = 0; k < UNKNOWNS; k++) {
            from->share[k] = 1 / loops->scale[k];
        }
    }
}

#endif

/* MODELER_WIDTH samples together; 0, and nothing done, where that is not safe. */
MODELER_TARGET static int MODELER_VERSION(vector)(const modeler_closure *loops,
                                                  const double *q, const double *qd,
                                                  const double *qdd, modeler_anchor *from,
                                                  double *values)
{
    const modeler_lanes given[] = {
        MODELER_ROWS(q, 3, 0),
        MODELER_ROWS(q, 3, 1),
        MODELER_ROWS(q, 3, 2),
    };
    const modeler_lanes v[] = {
        MODELER_ROWS(qd, 3, 0),
        MODELER_ROWS(qd, 3, 1),
        MODELER_ROWS(qd, 3, 2),
    };
    const modeler_lanes a[] = {
        MODELER_ROWS(qdd, 3, 0),
        MODELER_ROWS(qdd, 3, 1),
        MODELER_ROWS(qdd, 3, 2),
    };
    modeler_lanes u[UNKNOWNS], f[LENGTH], lu[FACTORS], G[COUPLINGS];

    if (!MODELER_VERSION(together)(loops, from, given, v, a, u, f, lu)) {
        return 0;
    }
    MODELER_VERSION(coupling)(f + JACOBIAN_AT, lu, G);
    MODELER_VERSION(rows)(u, f + TURNS_AT, G, lu, v, a, values);
    for (int j = 0; j < GIVEN; j++) {
        from->last[j] = MODELER_LAST(given[j]) - from->u[loops->given_places[j]];
    }
    for (int k = 0; k < UNKNOWNS; k++) {
        from->u[k] = MODELER_LAST(u[k]);
    }
    for (int k = 0; k < JACOBIAN; k++) {
        from->J[k] = MODELER_LAST(f[JACOBIAN_AT + k]);
    }
    for (int k = 0; k < FACTORS; k++) {
        from->lu[k] = MODELER_LAST(lu[k]);
    }
    for (int k = 0; k < COUPLINGS; k++) {
        from->turned[k] = MODELER_LAST(G[k]) - from->G[k];
        from->G[k] = MODELER_LAST(G[k]);
    }
    return 1;
}

static void MODELER_VERSION(closing)(const modeler_tiled *robot, const double *q, const double *qd,
                                     const double *qdd, size_t samples, void *memory,
                                     double *values, int *status)
{
    const struct orthoglide_2012_single *const one = (const struct orthoglide_2012_single *)robot->singles;
    closing_state *const state = (closing_state *)memory;

    for (size_t i = 0; i < samples; i += MODELER_WIDTH) {
        const size_t now = samples - i < MODELER_WIDTH ? samples - i : MODELER_WIDTH;

        size_t done = 0;

        if (!state->anchored) {
            one_by_one(one, q, qd, qdd, 1, state, values + i, status + i);
            done = 1;
        }
        if (state->anchored && MODELER_VERSION(vector)(one->loops, q, qd, qdd, &state->from, values + i)) {
            state->posed = 0;
            for (size_t k = 0; k < now; k++) {
                status[i + k] = MODELER_CLOSED;
            }
        } else if (done < now) {
            one_by_one(one, q + done * GIVEN, qd + done * GIVEN, qdd + done * GIVEN, now - done, state,
                       values + i + done, status + i + done);
        }
        q += MODELER_WIDTH * GIVEN;
        qd += MODELER_WIDTH * GIVEN;
        qdd += MODELER_WIDTH * GIVEN;
    }
}

#endif
