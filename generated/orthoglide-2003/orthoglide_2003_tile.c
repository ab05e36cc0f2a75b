/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003_tile.h.
 * This file includes itself once for every instruction set.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "orthoglide_2003_tile.h"

#include <string.h>

#include "orthoglide_2003_tree.h"

/* Lengths of orthoglide_2003_loops. */
#define GIVEN 3
#define UNKNOWNS 12
#define SOLVED 9
#define FACTORS 25
#define COUPLINGS 27
#define JACOBIAN 27
#define JACOBIAN_AT 9
#define TURNS_AT 36
#define LENGTH 48

/* Geometry; see orthoglide_2003.c. */
#ifndef ORTHOGLIDE_2003_GEO_g
#define ORTHOGLIDE_2003_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2003_GEO_D41
#define ORTHOGLIDE_2003_GEO_D41 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D42
#define ORTHOGLIDE_2003_GEO_D42 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D43
#define ORTHOGLIDE_2003_GEO_D43 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_b3
#define ORTHOGLIDE_2003_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_2003_GEO_b7
#define ORTHOGLIDE_2003_GEO_b7 0.04
#endif
#ifndef ORTHOGLIDE_2003_GEO_a
#define ORTHOGLIDE_2003_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2003_GEO_d6
#define ORTHOGLIDE_2003_GEO_d6 0.1
#endif

static const double orthoglide_2003_geo_g = ORTHOGLIDE_2003_GEO_g;
static const double orthoglide_2003_geo_D41 = ORTHOGLIDE_2003_GEO_D41;
static const double orthoglide_2003_geo_D42 = ORTHOGLIDE_2003_GEO_D42;
static const double orthoglide_2003_geo_D43 = ORTHOGLIDE_2003_GEO_D43;
static const double orthoglide_2003_geo_b3 = ORTHOGLIDE_2003_GEO_b3;
static const double orthoglide_2003_geo_a = ORTHOGLIDE_2003_GEO_a;
static const double orthoglide_2003_geo_d6 = ORTHOGLIDE_2003_GEO_d6;

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2
};

static const int column[] = {
    0, 1, 2, 3, 4, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32,
    33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 0, 5, 6, 7, 8, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22,
    23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 0, 9, 10, 11,
    12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35,
    36, 37, 38, 39, 40, 41, 42
};

#define ENTRIES 105

#define MODELER_BODY "orthoglide_2003_tile.c"
#include "modeler_versions.h"

#ifdef MODELER_APART /* who loads this library has them in another one */
#define SINGLES NULL
#else
static const struct orthoglide_2003_single singles = {&orthoglide_2003_loops, orthoglide_2003_posed, orthoglide_2003_tree_next, modeler_eliminated};
#define SINGLES &singles
#endif

#define TILED(version) \
    {3, 43, 0, ENTRIES, row, column, NULL, closing_##version, sizeof(closing_state), SINGLES}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *orthoglide_2003_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *orthoglide_2003_tile_signature(void)
{
    return "8b4d899ee4120f16";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

MODELER_TARGET static void MODELER_VERSION(closure)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT values)
{
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
const double o32_z = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;
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
const modeler_lanes o41_x = c6*c7*orthoglide_2003_geo_D41;
    values[0] = o41_x - q[0];
    values[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    /* link 51: velocity of the origin, for unit speed of each joint below, m51 = R51' (m41 + e41 x
    p51) */
const modeler_lanes minus_m51_21y = s6*c7*orthoglide_2003_geo_D41;
    values[2] = q[3] - minus_m51_21y + orthoglide_2003_geo_d6 - q[2];
    /* link 52: velocity of the origin, for unit speed of each joint below, m52 = R52' (m42 + e42 x
    p52) */
const modeler_lanes minus_m52_22y = s8*c9*orthoglide_2003_geo_D42;
    values[3] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[4] + minus_m52_22y) - q[0];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
const modeler_lanes o42_y = c8*c9*orthoglide_2003_geo_D42;
    values[4] = o42_y - q[1];
    values[5] = -(orthoglide_2003_geo_D42*s9 - o32_z + orthoglide_2003_geo_b3 + q[2]);
    values[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    /* link 53: velocity of the origin, for unit speed of each joint below, m53 = R53' (m43 + e43 x
    p53) */
const modeler_lanes minus_m53_23y = s10*c11*orthoglide_2003_geo_D43;
    values[7] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[5] + minus_m53_23y) - q[1];
    const modeler_lanes minus_m53_23x = c10*c11*orthoglide_2003_geo_D43;
    values[8] = orthoglide_2003_geo_a + minus_m53_23x - q[2];
    values[9] = modeler_lanes_spread(-1.0);
    values[10] = -minus_m51_21y;
    values[11] = -c6*s7*orthoglide_2003_geo_D41;
    values[12] = modeler_lanes_spread(-1.0);
    values[13] = -orthoglide_2003_geo_D41*c7;
    values[14] = modeler_lanes_spread(-1.0);
    values[15] = modeler_lanes_spread(1.0);
    values[16] = -o41_x;
    values[17] = s6*s7*orthoglide_2003_geo_D41;
    values[18] = modeler_lanes_spread(-1.0);
    values[19] = modeler_lanes_spread(1.0);
    values[20] = -o42_y;
    values[21] = s8*s9*orthoglide_2003_geo_D42;
    values[22] = modeler_lanes_spread(-1.0);
    values[23] = -minus_m52_22y;
    values[24] = -c8*s9*orthoglide_2003_geo_D42;
    values[25] = modeler_lanes_spread(-1.0);
    values[26] = -orthoglide_2003_geo_D42*c9;
    values[27] = modeler_lanes_spread(-1.0);
    values[28] = -orthoglide_2003_geo_D43*c11;
    values[29] = modeler_lanes_spread(-1.0);
    values[30] = modeler_lanes_spread(1.0);
    values[31] = -minus_m53_23x;
    values[32] = s10*s11*orthoglide_2003_geo_D43;
    values[33] = modeler_lanes_spread(-1.0);
    values[34] = -minus_m53_23y;
    values[35] = -c10*s11*orthoglide_2003_geo_D43;
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
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
const double o32_z = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;
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
    f[0] = c6*c7*orthoglide_2003_geo_D41 - q[0];
    f[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    f[2] = q[3] - s6*c7*orthoglide_2003_geo_D41 + orthoglide_2003_geo_d6 - q[2];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
const modeler_lanes minus_o42_x = orthoglide_2003_geo_a - q[4] + s8*c9*orthoglide_2003_geo_D42;
    f[3] = orthoglide_2003_geo_d6 - minus_o42_x - q[0];
    f[4] = c8*c9*orthoglide_2003_geo_D42 - q[1];
    f[5] = -(orthoglide_2003_geo_D42*s9 - o32_z + orthoglide_2003_geo_b3 + q[2]);
    f[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
const modeler_lanes minus_o43_y = orthoglide_2003_geo_a - q[5] +
    s10*c11*orthoglide_2003_geo_D43;
    f[7] = orthoglide_2003_geo_d6 - minus_o43_y - q[1];
    f[8] = orthoglide_2003_geo_a + c10*c11*orthoglide_2003_geo_D43 - q[2];
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
    const modeler_lanes t1 = G[8]*v[0] + G[17]*v[1] + G[26]*v[2];
    const modeler_lanes t2 = t[11]*t1;
    const modeler_lanes t3 = orthoglide_2003_geo_D43*t2*t1;
    const modeler_lanes t4 = G[5]*v[0] + G[14]*v[1] + G[23]*v[2];
    const modeler_lanes t5 = t[5]*t4;
    const modeler_lanes t6 = G[6]*v[0] + G[15]*v[1] + G[24]*v[2];
    const modeler_lanes t7 = t[7]*t6;
    const modeler_lanes t8 = t[4]*t4;
    const modeler_lanes t9 = t[6]*t6;
    const modeler_lanes t10 = orthoglide_2003_geo_D42*(t[6]*t5 + t[4]*t7)*t4;
    const modeler_lanes t11 = orthoglide_2003_geo_D42*(t[6]*t8 - t[5]*t7)*t4;
    const modeler_lanes t12 = t11 - orthoglide_2003_geo_D42*(t[7]*t5 - t[4]*t9)*t6;
    const modeler_lanes t13 = orthoglide_2003_geo_D42*t7*t6;
    const modeler_lanes t14 = t10 + orthoglide_2003_geo_D42*(t[7]*t8 + t[5]*t9)*t6 + lu[13]*t12;
    const modeler_lanes t15 = G[3]*v[0] + G[12]*v[1] + G[21]*v[2];
    const modeler_lanes t16 = t[1]*t15;
    const modeler_lanes t17 = G[4]*v[0] + G[13]*v[1] + G[22]*v[2];
    const modeler_lanes t18 = t[3]*t17;
    const modeler_lanes t19 = t[0]*t15;
    const modeler_lanes t20 = t[2]*t17;
    const modeler_lanes t21 = orthoglide_2003_geo_D41*(t[2]*t16 + t[0]*t18)*t15;
    const modeler_lanes t22 = orthoglide_2003_geo_D41*(t[2]*t19 - t[1]*t18)*t15;
    const modeler_lanes t23 = t22 - orthoglide_2003_geo_D41*(t[3]*t16 - t[0]*t20)*t17;
    const modeler_lanes t24 = orthoglide_2003_geo_D41*t18*t17;
    const modeler_lanes t25 = t21 + orthoglide_2003_geo_D41*(t[3]*t19 + t[1]*t20)*t17 + lu[10]*t23;
    const modeler_lanes t26 = t25 - lu[11]*t24 - lu[16]*t3;
    const modeler_lanes t27 = lu[14]*t13 - t14 + t3 + lu[21]*t26;
    const modeler_lanes t28 = G[7]*v[0] + G[16]*v[1] + G[25]*v[2];
    const modeler_lanes t29 = t[9]*t28;
    const modeler_lanes t30 = t[8]*t28;
    const modeler_lanes t31 = t[10]*t1;
    const modeler_lanes t32 = orthoglide_2003_geo_D43*(t[10]*t29 + t[8]*t2)*t28;
    const modeler_lanes t33 = orthoglide_2003_geo_D43*(t[10]*t30 - t[9]*t2)*t28;
    const modeler_lanes t34 = t33 - orthoglide_2003_geo_D43*(t[11]*t29 - t[8]*t31)*t1;
    const modeler_lanes t35 = t32 + orthoglide_2003_geo_D43*(t[11]*t30 + t[9]*t31)*t1 + lu[18]*t34;
    const modeler_lanes t36 = lu[8]*(t35 - lu[22]*t26 + lu[24]*t27);
    const modeler_lanes t37 = lu[7]*(t27 + lu[23]*t36);
    const modeler_lanes t38 = lu[4]*(t3 + lu[15]*t37);
    const modeler_lanes t39 = t38 - (G[0]*a[0] + G[9]*a[1] + G[18]*a[2]);
    const modeler_lanes t40 = t36 - (G[1]*a[0] + G[10]*a[1] + G[19]*a[2]) + orthoglide_2003_geo_g;
    const modeler_lanes t41 = lu[6]*(t26 - lu[19]*t36 + lu[20]*t37);
    const modeler_lanes t42 = t41 - (G[2]*a[0] + G[11]*a[1] + G[20]*a[2]);
    MODELER_PUT(0) = -(G[0]*t39 + G[1]*t40 + G[2]*t42);
    MODELER_PUT(35) = -(G[9]*t39 + G[10]*t40 + G[11]*t42);
    MODELER_PUT(70) = -(G[18]*t39 + G[19]*t40 + G[20]*t42);
    MODELER_PUT(1) = a[0];
    MODELER_PUT(2) = v[0];
    MODELER_PUT(3) = modeler_lanes_sign(v[0]);
    MODELER_PUT(4) = modeler_lanes_spread(1.0);
    MODELER_PUT(36) = a[1];
    MODELER_PUT(37) = v[1];
    MODELER_PUT(38) = modeler_lanes_sign(v[1]);
    MODELER_PUT(39) = modeler_lanes_spread(1.0);
    MODELER_PUT(71) = a[2];
    MODELER_PUT(72) = v[2];
    MODELER_PUT(73) = modeler_lanes_sign(v[2]);
    MODELER_PUT(74) = modeler_lanes_spread(1.0);
    const modeler_lanes t43 = lu[1]*(t24 + t36);
    const modeler_lanes t44 = G[3]*a[0] + G[12]*a[1] + G[21]*a[2] + lu[0]*(t23 - t38 + lu[9]*t43);
    MODELER_PUT(5) = G[3]*t44;
    MODELER_PUT(40) = G[12]*t44;
    MODELER_PUT(75) = G[21]*t44;
    const modeler_lanes t45 = t15*t15;
    const modeler_lanes t46 = t[1]*t45 - t[0]*t44;
    const modeler_lanes t47 = t[0]*a[0];
    MODELER_PUT(6) = t46 - G[3]*t47;
    MODELER_PUT(41) = -G[12]*t47;
    MODELER_PUT(76) = -G[21]*t47;
    const modeler_lanes t48 = t[1]*a[0];
    MODELER_PUT(7) = t[1]*t44 + t[0]*t45 + G[3]*t48;
    MODELER_PUT(42) = G[12]*t48;
    MODELER_PUT(77) = G[21]*t48;
    const modeler_lanes t49 = t[3]*t44;
    const modeler_lanes t50 = t[2]*t15;
    const modeler_lanes t51 = t17*t50;
    const modeler_lanes t52 = t49 + t51;
    const modeler_lanes t53 = t[3]*t15;
    const modeler_lanes t54 = t17*t53;
    const modeler_lanes t55 = t[3]*t52 + t[2]*t54;
    const modeler_lanes t56 = t53*t50;
    MODELER_PUT(8) = G[3]*t55 - G[4]*t56;
    MODELER_PUT(43) = G[12]*t55 - G[13]*t56;
    MODELER_PUT(78) = G[21]*t55 - G[22]*t56;
    const modeler_lanes t57 = t[2]*t44;
    const modeler_lanes t58 = t54 - t57 + t54;
    const modeler_lanes t59 = t51 + t52;
    const modeler_lanes t60 = t[3]*t58 - t[2]*t59;
    const modeler_lanes t61 = t17*t17;
    const modeler_lanes t62 = t50*t50 + t61;
    const modeler_lanes t63 = t53*t53 + t61;
    const modeler_lanes t64 = t62 - t63;
    MODELER_PUT(9) = -(G[3]*t60 + G[4]*t64);
    MODELER_PUT(44) = -(G[12]*t60 + G[13]*t64);
    MODELER_PUT(79) = -(G[21]*t60 + G[22]*t64);
    const modeler_lanes t65 = t43 - (G[4]*a[0] + G[13]*a[1] + G[22]*a[2]);
    const modeler_lanes t66 = t[3]*(t65 - t56) + t[2]*(t45 - t62);
    MODELER_PUT(10) = G[3]*t66 - G[4]*t49;
    MODELER_PUT(45) = G[12]*t66 - G[13]*t49;
    MODELER_PUT(80) = G[21]*t66 - G[22]*t49;
    const modeler_lanes t67 = t65 + t56;
    const modeler_lanes t68 = t[3]*(t45 - t63) - t[2]*t67;
    MODELER_PUT(11) = -(G[3]*t68 + G[4]*t57);
    MODELER_PUT(46) = -(G[12]*t68 + G[13]*t57);
    MODELER_PUT(81) = -(G[21]*t68 + G[22]*t57);
    MODELER_PUT(12) = -G[4]*t65;
    MODELER_PUT(47) = -G[13]*t65;
    MODELER_PUT(82) = -G[22]*t65;
    const modeler_lanes t69 = t[3]*t47;
    const modeler_lanes t70 = t[2]*t48 - orthoglide_2003_geo_g*t[3];
    MODELER_PUT(13) = G[4]*t70 - (t[1]*t[2]*t67 + t[1]*t[3]*t63 - t[0]*t59 - G[3]*t69);
    MODELER_PUT(48) = G[12]*t69 + G[13]*t70;
    MODELER_PUT(83) = G[21]*t69 + G[22]*t70;
    const modeler_lanes t71 = t47 + orthoglide_2003_geo_D41*t58 - orthoglide_2003_geo_D41*t[2]*t44;
    const modeler_lanes t72 = orthoglide_2003_geo_D41*t[3]*t45;
    MODELER_PUT(14) = t46 - G[3]*t71 + G[4]*t72;
    MODELER_PUT(49) = G[13]*t72 - G[12]*t71;
    MODELER_PUT(84) = G[22]*t72 - G[21]*t71;
    const modeler_lanes t73 = lu[3]*(t13 + t41);
    const modeler_lanes t74 = G[5]*a[0] + G[14]*a[1] + G[23]*a[2] + lu[2]*(t12 - t36 + lu[12]*t73);
    MODELER_PUT(15) = G[5]*t74;
    MODELER_PUT(50) = G[14]*t74;
    MODELER_PUT(85) = G[23]*t74;
    const modeler_lanes t75 = t[4]*a[1] - orthoglide_2003_geo_g*t[5];
    MODELER_PUT(16) = -G[5]*t75;
    const modeler_lanes t76 = t4*t4;
    const modeler_lanes t77 = t[5]*t76 - t[4]*t74;
    MODELER_PUT(51) = t77 - G[14]*t75;
    MODELER_PUT(86) = -G[23]*t75;
    const modeler_lanes t78 = orthoglide_2003_geo_g*t[4] + t[5]*a[1];
    MODELER_PUT(17) = G[5]*t78;
    MODELER_PUT(52) = t[5]*t74 + t[4]*t76 + G[14]*t78;
    MODELER_PUT(87) = G[23]*t78;
    const modeler_lanes t79 = t[7]*t74;
    const modeler_lanes t80 = t[6]*t4;
    const modeler_lanes t81 = t6*t80;
    const modeler_lanes t82 = t79 + t81;
    const modeler_lanes t83 = t[7]*t4;
    const modeler_lanes t84 = t6*t83;
    const modeler_lanes t85 = t[7]*t82 + t[6]*t84;
    const modeler_lanes t86 = t83*t80;
    MODELER_PUT(18) = G[5]*t85 - G[6]*t86;
    MODELER_PUT(53) = G[14]*t85 - G[15]*t86;
    MODELER_PUT(88) = G[23]*t85 - G[24]*t86;
    const modeler_lanes t87 = t[6]*t74;
    const modeler_lanes t88 = t84 - t87 + t84;
    const modeler_lanes t89 = t81 + t82;
    const modeler_lanes t90 = t[7]*t88 - t[6]*t89;
    const modeler_lanes t91 = t6*t6;
    const modeler_lanes t92 = t80*t80 + t91;
    const modeler_lanes t93 = t83*t83 + t91;
    const modeler_lanes t94 = t92 - t93;
    MODELER_PUT(19) = -(G[5]*t90 + G[6]*t94);
    MODELER_PUT(54) = -(G[14]*t90 + G[15]*t94);
    MODELER_PUT(89) = -(G[23]*t90 + G[24]*t94);
    const modeler_lanes t95 = t73 - (G[6]*a[0] + G[15]*a[1] + G[24]*a[2]);
    const modeler_lanes t96 = t[7]*(t95 - t86) + t[6]*(t76 - t92);
    MODELER_PUT(20) = G[5]*t96 - G[6]*t79;
    MODELER_PUT(55) = G[14]*t96 - G[15]*t79;
    MODELER_PUT(90) = G[23]*t96 - G[24]*t79;
    const modeler_lanes t97 = t95 + t86;
    const modeler_lanes t98 = t[7]*(t76 - t93) - t[6]*t97;
    MODELER_PUT(21) = -(G[5]*t98 + G[6]*t87);
    MODELER_PUT(56) = -(G[14]*t98 + G[15]*t87);
    MODELER_PUT(91) = -(G[23]*t98 + G[24]*t87);
    MODELER_PUT(22) = -G[6]*t95;
    MODELER_PUT(57) = -G[15]*t95;
    MODELER_PUT(92) = -G[24]*t95;
    const modeler_lanes t99 = t[7]*t75;
    const modeler_lanes t100 = t[6]*t78;
    MODELER_PUT(23) = G[5]*t99 + G[6]*t100;
    MODELER_PUT(58) = G[15]*t100 - (t[5]*t[6]*t97 + t[5]*t[7]*t93 - t[4]*t89 - G[14]*t99);
    MODELER_PUT(93) = G[23]*t99 + G[24]*t100;
    const modeler_lanes t101 = t75 + orthoglide_2003_geo_D42*t88 - orthoglide_2003_geo_D42*t[6]*t74;
    const modeler_lanes t102 = orthoglide_2003_geo_D42*t[7]*t76;
    MODELER_PUT(24) = G[6]*t102 - G[5]*t101;
    MODELER_PUT(59) = t77 - G[14]*t101 + G[15]*t102;
    MODELER_PUT(94) = G[24]*t102 - G[23]*t101;
    const modeler_lanes t103 = G[7]*a[0] + G[16]*a[1] + G[25]*a[2] + lu[5]*(t34 - t41 - lu[17]*t37);
    MODELER_PUT(25) = G[7]*t103;
    MODELER_PUT(60) = G[16]*t103;
    MODELER_PUT(95) = G[25]*t103;
    const modeler_lanes t104 = orthoglide_2003_geo_g - a[2];
    const modeler_lanes t105 = t[8]*t104;
    MODELER_PUT(26) = G[7]*t105;
    MODELER_PUT(61) = G[16]*t105;
    const modeler_lanes t106 = t28*t28;
    const modeler_lanes t107 = t[9]*t106 - t[8]*t103;
    MODELER_PUT(96) = t107 + G[25]*t105;
    const modeler_lanes t108 = t[9]*t104;
    MODELER_PUT(27) = -G[7]*t108;
    MODELER_PUT(62) = -G[16]*t108;
    MODELER_PUT(97) = t[9]*t103 + t[8]*t106 - G[25]*t108;
    const modeler_lanes t109 = t[11]*t103;
    const modeler_lanes t110 = t[10]*t28;
    const modeler_lanes t111 = t1*t110;
    const modeler_lanes t112 = t109 + t111;
    const modeler_lanes t113 = t[11]*t28;
    const modeler_lanes t114 = t1*t113;
    const modeler_lanes t115 = t[11]*t112 + t[10]*t114;
    const modeler_lanes t116 = t113*t110;
    MODELER_PUT(28) = G[7]*t115 - G[8]*t116;
    MODELER_PUT(63) = G[16]*t115 - G[17]*t116;
    MODELER_PUT(98) = G[25]*t115 - G[26]*t116;
    const modeler_lanes t117 = t[10]*t103;
    const modeler_lanes t118 = t114 - t117 + t114;
    const modeler_lanes t119 = t111 + t112;
    const modeler_lanes t120 = t[11]*t118 - t[10]*t119;
    const modeler_lanes t121 = t1*t1;
    const modeler_lanes t122 = t110*t110 + t121;
    const modeler_lanes t123 = t113*t113 + t121;
    const modeler_lanes t124 = t122 - t123;
    MODELER_PUT(29) = -(G[7]*t120 + G[8]*t124);
    MODELER_PUT(64) = -(G[16]*t120 + G[17]*t124);
    MODELER_PUT(99) = -(G[25]*t120 + G[26]*t124);
    const modeler_lanes t125 = G[8]*a[0] + G[17]*a[1] + G[26]*a[2] + t37;
    const modeler_lanes t126 = t[11]*(t125 + t116) - t[10]*(t106 - t122);
    MODELER_PUT(30) = -(G[7]*t126 + G[8]*t109);
    MODELER_PUT(65) = -(G[16]*t126 + G[17]*t109);
    MODELER_PUT(100) = -(G[25]*t126 + G[26]*t109);
    const modeler_lanes t127 = t125 - t116;
    const modeler_lanes t128 = t[11]*(t106 - t123) + t[10]*t127;
    MODELER_PUT(31) = -(G[7]*t128 + G[8]*t117);
    MODELER_PUT(66) = -(G[16]*t128 + G[17]*t117);
    MODELER_PUT(101) = -(G[25]*t128 + G[26]*t117);
    MODELER_PUT(32) = G[8]*t125;
    MODELER_PUT(67) = G[17]*t125;
    MODELER_PUT(102) = G[26]*t125;
    const modeler_lanes t129 = t[11]*t105;
    const modeler_lanes t130 = t[10]*t108;
    MODELER_PUT(33) = -(G[7]*t129 + G[8]*t130);
    MODELER_PUT(68) = -(G[16]*t129 + G[17]*t130);
    MODELER_PUT(103) = t[9]*t[10]*t127 - t[9]*t[11]*t123 + t[8]*t119 - G[25]*t129 - G[26]*t130;
    const modeler_lanes t131 = t105 - orthoglide_2003_geo_D43*t118 +
    orthoglide_2003_geo_D43*t[10]*t103;
    const modeler_lanes t132 = orthoglide_2003_geo_D43*t[11]*t106;
    MODELER_PUT(34) = G[7]*t131 + G[8]*t132;
    MODELER_PUT(69) = G[16]*t131 + G[17]*t132;
    MODELER_PUT(104) = t107 + G[25]*t131 + G[26]*t132;
}

#include "modeler_closing.h"

#ifndef ONE_BY_ONE
#define ONE_BY_ONE

typedef struct {
    int anchored; /* tiles can start from `from` */
    int posed;    /* p is the last posture, and `from` is not later */
    modeler_anchor from;
    struct orthoglide_2003_posture p;
    double rows[UNKNOWNS * ORTHOGLIDE_2003_BASE_PARAMETERS], phi[GIVEN * ORTHOGLIDE_2003_BASE_PARAMETERS];
} closing_state;

/* Samples one after another, from the posture of the last one. */
static void one_by_one(const struct orthoglide_2003_single *one, const double *q, const double *qd, const double *qdd,
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
            values[k * MODELER_LANES + i] = state->phi[row[k] * ORTHOGLIDE_2003_BASE_PARAMETERS + column[k]];
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
    const struct orthoglide_2003_single *const one = (const struct orthoglide_2003_single *)robot->singles;
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
