/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of orthoglide_2012.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 *
 * Temporaries are named by quantity, link and component: wd3_x is that of wd of link 3, in its own
 * frame; m3_1x is what one unit of joint 1 makes, f3_MXx what one unit of MX3 does; minus_wd3_x is
 * minus that. R3 turns from frame 3 to that of its antecedent; the base, link 0, has vd0 = -g.
 *
 *   w      angular velocity
 *   wd     angular acceleration
 *   vd     acceleration of the origin less gravity
 *   ww     products of the components of w
 *   U      acceleration of points of the link
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: vd
 */
#include "orthoglide_2012.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2012_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2012_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
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

/* Regressor of the standard parameters.
 * 99 additions, 172 multiplications. */
MODELER_CLONES
void orthoglide_2012_tree_regressor(const double q[12], const double qd[12], const double qdd[12],
                                    double MODELER_OUT(phi, 12 * 196))
{
    MODELER_ALL_ZEROS(phi, 2352);

    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s10, c10;
    modeler_sincos(q[10], &s10, &c10);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);

    phi[0] = qdd[0];
    MODELER_ZEROS(phi + 1, 8);
    phi[196] = qdd[1] - orthoglide_2012_geo_g;
    MODELER_ZEROS(phi + 9, 8);
    phi[392] = qdd[2];
    MODELER_ZEROS(phi + 17, 8);
    phi[598] = qdd[3];
    MODELER_ZEROS(phi + 25, 8);
    phi[599] = qdd[3];
    MODELER_ZEROS(phi + 33, 8);
    phi[600] = qd[3];
    MODELER_ZEROS(phi + 41, 8);
    phi[601] = modeler_sign(qd[3]);
    MODELER_ZEROS(phi + 49, 8);
    phi[807] = qdd[4];
    MODELER_ZEROS(phi + 57, 8);
    phi[808] = qdd[4];
    MODELER_ZEROS(phi + 65, 8);
    phi[809] = qd[4];
    MODELER_ZEROS(phi + 73, 8);
    MODELER_ZEROS(phi + 81, 8);
    phi[810] = modeler_sign(qd[4]);
    MODELER_ZEROS(phi + 89, 8);
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2012_geo_g;
    MODELER_ZEROS(phi + 97, 8);
    phi[1016] = vd13_z;
    MODELER_ZEROS(phi + 105, 8);
    phi[1017] = qdd[5];
    MODELER_ZEROS(phi + 113, 8);
    phi[1018] = qd[5];
    MODELER_ZEROS(phi + 121, 8);
    phi[1019] = modeler_sign(qd[5]);
    MODELER_ZEROS(phi + 129, 8);
    phi[1221] = qdd[6];
    MODELER_ZEROS(phi + 137, 8);
    const double ww21_zz = qd[6]*qd[6];
    MODELER_ZEROS(phi + 145, 8);
    const double t3 = s6*ww21_zz - c6*qdd[6];
    MODELER_ZEROS(phi + 153, 8);
    MODELER_ZEROS(phi + 161, 8);
    phi[634] = t3;
    MODELER_ZEROS(phi + 169, 8);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    MODELER_ZEROS(phi + 177, 8);
    phi[1222] = -minus_vd21_y;
    MODELER_ZEROS(phi + 185, 8);
    const double t5 = s6*qdd[6] + c6*ww21_zz;
    MODELER_ZEROS(phi + 193, 3);
    phi[635] = t5;
    MODELER_ZEROS(phi + 197, 8);
    const double minus_vd21_x = s6*qdd[3];
    MODELER_ZEROS(phi + 205, 8);
    phi[1223] = minus_vd21_x;
    MODELER_ZEROS(phi + 213, 8);
    phi[637] = qdd[3];
    MODELER_ZEROS(phi + 221, 8);
    phi[1226] = qdd[6];
    MODELER_ZEROS(phi + 229, 8);
    MODELER_ZEROS(phi + 237, 8);
    phi[1227] = qd[6];
    MODELER_ZEROS(phi + 245, 8);
    const double t7 = modeler_sign(qd[6]);
    MODELER_ZEROS(phi + 253, 8);
    phi[1228] = t7;
    MODELER_ZEROS(phi + 261, 8);
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double U31_yz = s7*qdd[6];
    MODELER_ZEROS(phi + 269, 8);
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    MODELER_ZEROS(phi + 277, 8);
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    MODELER_ZEROS(phi + 285, 8);
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = U31_yz + minus_ww31_yz;
    MODELER_ZEROS(phi + 293, 8);
    const double minus_w31_x = s7*qd[6];
    MODELER_ZEROS(phi + 301, 8);
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    MODELER_ZEROS(phi + 309, 8);
    MODELER_ZEROS(phi + 317, 8);
    const double t14 = c7*minus_ww31_xz;
    MODELER_ZEROS(phi + 325, 8);
    phi[1229] = s7*minus_wd31_x + t14;
    MODELER_ZEROS(phi + 333, 8);
    const double ww31_xy = minus_w31_x*minus_w31_y;
    MODELER_ZEROS(phi + 341, 8);
    phi[1425] = -ww31_xy;
    MODELER_ZEROS(phi + 349, 8);
    const double minus_U31_xz = c7*qdd[6];
    MODELER_ZEROS(phi + 357, 8);
    const double minus_wd31_y = minus_U31_xz - minus_ww31_xz;
    MODELER_ZEROS(phi + 365, 8);
    const double minus_U31_zx = minus_ww31_xz - minus_wd31_y;
    MODELER_ZEROS(phi + 373, 8);
    const double minus_U31_zy = minus_ww31_yz + minus_wd31_x;
    MODELER_ZEROS(phi + 381, 8);
    phi[1230] = c7*minus_U31_zy - s7*minus_U31_zx;
    MODELER_ZEROS(phi + 389, 3);
    MODELER_ZEROS(phi + 393, 8);
    const double ww31_zz = qd[7]*qd[7];
    MODELER_ZEROS(phi + 401, 8);
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    MODELER_ZEROS(phi + 409, 8);
    const double minus_U31_yy = minus_w31_x*minus_w31_x + ww31_zz;
    MODELER_ZEROS(phi + 417, 8);
    phi[1426] = minus_U31_yy - minus_U31_xx;
    MODELER_ZEROS(phi + 425, 8);
    const double U31_yx = qdd[7] + ww31_xy;
    MODELER_ZEROS(phi + 433, 8);
    phi[1231] = c7*(ww21_zz - minus_U31_xx) - s7*U31_yx;
    MODELER_ZEROS(phi + 441, 8);
    phi[1427] = -U31_yz;
    MODELER_ZEROS(phi + 449, 8);
    phi[1232] = c7*minus_wd31_y - t14;
    MODELER_ZEROS(phi + 457, 8);
    phi[1428] = ww31_xy;
    MODELER_ZEROS(phi + 465, 8);
    MODELER_ZEROS(phi + 473, 8);
    const double minus_U31_xy = qdd[7] - ww31_xy;
    MODELER_ZEROS(phi + 481, 8);
    phi[1233] = -(s7*(ww21_zz - minus_U31_yy) + c7*minus_U31_xy);
    MODELER_ZEROS(phi + 489, 8);
    phi[1429] = -minus_U31_xz;
    MODELER_ZEROS(phi + 497, 8);
    phi[1430] = qdd[7];
    MODELER_ZEROS(phi + 505, 8);
    const double minus_x31_z = s6*c7;
    MODELER_ZEROS(phi + 513, 8);
    const double y31_z = s6*s7;
    MODELER_ZEROS(phi + 521, 8);
    phi[647] = minus_x31_z*minus_U31_xx + y31_z*U31_yx + c6*minus_U31_zx;
    MODELER_ZEROS(phi + 529, 8);
    phi[1235] = -c7*minus_vd21_y;
    MODELER_ZEROS(phi + 537, 8);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double vd31_y = orthoglide_2012_geo_g*c7 + s7*minus_vd21_x;
    MODELER_ZEROS(phi + 545, 8);
    MODELER_ZEROS(phi + 553, 8);
    phi[1431] = vd31_y;
    MODELER_ZEROS(phi + 561, 8);
    phi[648] = minus_x31_z*minus_U31_xy - y31_z*minus_U31_yy + c6*minus_U31_zy;
    MODELER_ZEROS(phi + 569, 8);
    phi[1236] = s7*minus_vd21_y;
    MODELER_ZEROS(phi + 577, 8);
    const double minus_vd31_x = c7*minus_vd21_x - orthoglide_2012_geo_g*s7;
    MODELER_ZEROS(phi + 585, 8);
    phi[1432] = minus_vd31_x;
    MODELER_ZEROS(phi + 593, 5);
    phi[649] = t5;
    MODELER_ZEROS(phi + 602, 8);
    phi[1237] = minus_vd21_x;
    MODELER_ZEROS(phi + 610, 8);
    phi[650] = qdd[3];
    MODELER_ZEROS(phi + 618, 8);
    phi[1435] = qdd[7];
    MODELER_ZEROS(phi + 626, 8);
    MODELER_ZEROS(phi + 636, 1);
    phi[1436] = qd[7];
    MODELER_ZEROS(phi + 638, 8);
    const double t29 = modeler_sign(qd[7]);
    MODELER_ZEROS(phi + 646, 1);
    phi[1437] = t29;
    MODELER_ZEROS(phi + 651, 8);
    phi[1245] = qdd[6];
    MODELER_ZEROS(phi + 659, 1);
    phi[660] = t3;
    MODELER_ZEROS(phi + 661, 1);
    /* link 41: acceleration of the origin less gravity, vd41 = R41' (vd31 + U31 p41) */
    const double minus_vd41_z = minus_vd21_y + orthoglide_2012_geo_d4*minus_U31_zx;
    MODELER_ZEROS(phi + 664, 8);
    /* link 41: velocity of the origin, for unit speed of each joint below, m41 = R41' (m31 + e31 x
        p41) */
    const double m41_21z = orthoglide_2012_geo_d4*c7;
    MODELER_ZEROS(phi + 672, 4);
    phi[1248] = m41_21z*qdd[6] - minus_vd41_z;
    MODELER_ZEROS(phi + 677, 8);
    /* link 41: origin of the frame in frame 0, o41 = o31 + [x31 y31 z31] p41 */
    const double minus_o41_y = orthoglide_2012_geo_d4*s7;
    MODELER_ZEROS(phi + 685, 8);
    MODELER_ZEROS(phi + 693, 8);
    phi[1444] = minus_o41_y*ww21_zz;
    MODELER_ZEROS(phi + 701, 8);
    phi[662] = t5;
    MODELER_ZEROS(phi + 709, 8);
    const double minus_vd41a_x = minus_vd31_x + orthoglide_2012_geo_d4*minus_U31_xx;
    MODELER_ZEROS(phi + 717, 8);
    const double vd41a_y = vd31_y + orthoglide_2012_geo_d4*U31_yx;
    MODELER_ZEROS(phi + 725, 8);
    const double minus_vd41_x = c7*minus_vd41a_x + s7*vd41a_y;
    MODELER_ZEROS(phi + 733, 8);
    phi[1250] = minus_vd41_x - m41_21z*ww21_zz;
    MODELER_ZEROS(phi + 741, 8);
    phi[1446] = minus_o41_y*qdd[6];
    MODELER_ZEROS(phi + 749, 8);
    /* link 51: acceleration of the origin less gravity, vd51 = R51' (vd41 + U41 p51) */
    const double minus_vd51_y = c6*minus_vd41_z + s6*minus_vd41_x;
    MODELER_ZEROS(phi + 757, 8);
    phi[663] = minus_vd51_y;
    MODELER_ZEROS(phi + 765, 8);
    MODELER_ZEROS(phi + 773, 8);
    const double t37 = m41_21z*minus_vd41_z;
    MODELER_ZEROS(phi + 781, 8);
    phi[1251] = -t37;
    MODELER_ZEROS(phi + 789, 8);
    const double t38 = minus_o41_y*minus_vd41_x + m41_21z*(c7*vd41a_y - s7*minus_vd41a_x);
    MODELER_ZEROS(phi + 797, 8);
    phi[1447] = t38;
    MODELER_ZEROS(phi + 805, 2);
    phi[1448] = qdd[7];
    MODELER_ZEROS(phi + 811, 8);
    phi[1449] = qd[7];
    MODELER_ZEROS(phi + 819, 8);
    phi[1450] = t29;
    MODELER_ZEROS(phi + 827, 8);
    phi[676] = minus_vd51_y;
    MODELER_ZEROS(phi + 835, 8);
    phi[1264] = -t37;
    MODELER_ZEROS(phi + 843, 8);
    MODELER_ZEROS(phi + 851, 8);
    phi[1460] = t38;
    MODELER_ZEROS(phi + 859, 8);
    phi[1265] = qdd[6];
    MODELER_ZEROS(phi + 867, 8);
    phi[1266] = qd[6];
    MODELER_ZEROS(phi + 875, 7);
    phi[1267] = t7;
    MODELER_ZEROS(phi + 884, 1);
    phi[1665] = qdd[8];
    MODELER_ZEROS(phi + 886, 8);
    const double ww22_zz = qd[8]*qd[8];
    MODELER_ZEROS(phi + 894, 1);
    const double t40 = s8*ww22_zz - c8*qdd[8];
    MODELER_ZEROS(phi + 899, 8);
    phi[882] = t40;
    MODELER_ZEROS(phi + 907, 1);
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    MODELER_ZEROS(phi + 909, 1);
    MODELER_ZEROS(phi + 912, 8);
    phi[1666] = -minus_vd22_y;
    MODELER_ZEROS(phi + 920, 4);
    const double t42 = s8*qdd[8] + c8*ww22_zz;
    MODELER_ZEROS(phi + 925, 8);
    phi[883] = t42;
    MODELER_ZEROS(phi + 933, 8);
    const double minus_vd22_x = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    MODELER_ZEROS(phi + 941, 8);
    phi[1667] = minus_vd22_x;
    MODELER_ZEROS(phi + 949, 8);
    phi[885] = qdd[4];
    MODELER_ZEROS(phi + 957, 8);
    phi[1670] = qdd[8];
    MODELER_ZEROS(phi + 965, 8);
    phi[1671] = qd[8];
    MODELER_ZEROS(phi + 973, 8);
    const double t44 = modeler_sign(qd[8]);
    MODELER_ZEROS(phi + 981, 8);
    MODELER_ZEROS(phi + 989, 8);
    phi[1672] = t44;
    MODELER_ZEROS(phi + 997, 8);
    /* link 32: acceleration of points of the link, U32 = [wd32 x] + [w32 x][w32 x] */
    const double U32_yz = s9*qdd[8];
    MODELER_ZEROS(phi + 1005, 8);
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_y = c9*qd[8];
    MODELER_ZEROS(phi + 1013, 3);
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    MODELER_ZEROS(phi + 1020, 8);
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = U32_yz + minus_ww32_yz;
    MODELER_ZEROS(phi + 1028, 8);
    const double minus_w32_x = s9*qd[8];
    MODELER_ZEROS(phi + 1036, 8);
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    MODELER_ZEROS(phi + 1044, 8);
    const double t51 = c9*minus_ww32_xz;
    MODELER_ZEROS(phi + 1052, 8);
    phi[1673] = s9*minus_wd32_x + t51;
    MODELER_ZEROS(phi + 1060, 8);
    MODELER_ZEROS(phi + 1068, 8);
    const double ww32_xy = minus_w32_x*minus_w32_y;
    MODELER_ZEROS(phi + 1076, 8);
    phi[1869] = -ww32_xy;
    MODELER_ZEROS(phi + 1084, 8);
    const double minus_U32_xz = c9*qdd[8];
    MODELER_ZEROS(phi + 1092, 8);
    const double minus_wd32_y = minus_U32_xz - minus_ww32_xz;
    MODELER_ZEROS(phi + 1100, 8);
    const double minus_U32_zx = minus_ww32_xz - minus_wd32_y;
    MODELER_ZEROS(phi + 1108, 8);
    const double minus_U32_zy = minus_ww32_yz + minus_wd32_x;
    MODELER_ZEROS(phi + 1116, 8);
    phi[1674] = c9*minus_U32_zy - s9*minus_U32_zx;
    MODELER_ZEROS(phi + 1124, 6);
    const double ww32_zz = qd[9]*qd[9];
    MODELER_ZEROS(phi + 1132, 1);
    const double minus_U32_xx = minus_w32_y*minus_w32_y + ww32_zz;
    MODELER_ZEROS(phi + 1134, 8);
    MODELER_ZEROS(phi + 1142, 1);
    const double minus_U32_yy = minus_w32_x*minus_w32_x + ww32_zz;
    MODELER_ZEROS(phi + 1147, 8);
    phi[1870] = minus_U32_yy - minus_U32_xx;
    MODELER_ZEROS(phi + 1155, 1);
    const double U32_yx = qdd[9] + ww32_xy;
    MODELER_ZEROS(phi + 1157, 1);
    phi[1675] = c9*(ww22_zz - minus_U32_xx) - s9*U32_yx;
    MODELER_ZEROS(phi + 1160, 8);
    phi[1871] = -U32_yz;
    MODELER_ZEROS(phi + 1168, 4);
    phi[1676] = c9*minus_wd32_y - t51;
    MODELER_ZEROS(phi + 1173, 8);
    phi[1872] = ww32_xy;
    MODELER_ZEROS(phi + 1181, 8);
    const double minus_U32_xy = qdd[9] - ww32_xy;
    MODELER_ZEROS(phi + 1189, 8);
    phi[1677] = -(s9*(ww22_zz - minus_U32_yy) + c9*minus_U32_xy);
    MODELER_ZEROS(phi + 1197, 8);
    MODELER_ZEROS(phi + 1205, 8);
    phi[1873] = -minus_U32_xz;
    MODELER_ZEROS(phi + 1213, 8);
    phi[1874] = qdd[9];
    MODELER_ZEROS(phi + 1224, 2);
    const double minus_x32_x = s8*c9;
    MODELER_ZEROS(phi + 1234, 1);
    const double y32_x = s8*s9;
    MODELER_ZEROS(phi + 1238, 7);
    phi[895] = minus_x32_x*minus_U32_xx + y32_x*U32_yx + c8*minus_U32_zx;
    MODELER_ZEROS(phi + 1246, 2);
    phi[1679] = -c9*minus_vd22_y;
    MODELER_ZEROS(phi + 1249, 1);
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) */
    const double vd32_y = s9*minus_vd22_x;
    MODELER_ZEROS(phi + 1252, 8);
    phi[1875] = vd32_y;
    MODELER_ZEROS(phi + 1260, 4);
    phi[896] = minus_x32_x*minus_U32_xy - y32_x*minus_U32_yy + c8*minus_U32_zy;
    MODELER_ZEROS(phi + 1268, 8);
    MODELER_ZEROS(phi + 1276, 8);
    phi[1680] = s9*minus_vd22_y;
    MODELER_ZEROS(phi + 1284, 8);
    const double minus_vd32_x = c9*minus_vd22_x;
    MODELER_ZEROS(phi + 1292, 8);
    phi[1876] = minus_vd32_x;
    MODELER_ZEROS(phi + 1300, 8);
    phi[897] = t42;
    MODELER_ZEROS(phi + 1308, 8);
    phi[1681] = minus_vd22_x;
    MODELER_ZEROS(phi + 1316, 8);
    phi[898] = qdd[4];
    MODELER_ZEROS(phi + 1324, 8);
    phi[1879] = qdd[9];
    MODELER_ZEROS(phi + 1332, 8);
    phi[1880] = qd[9];
    MODELER_ZEROS(phi + 1340, 8);
    const double t66 = modeler_sign(qd[9]);
    MODELER_ZEROS(phi + 1348, 8);
    MODELER_ZEROS(phi + 1356, 8);
    phi[1881] = t66;
    MODELER_ZEROS(phi + 1364, 8);
    phi[1689] = qdd[8];
    MODELER_ZEROS(phi + 1372, 8);
    phi[908] = t40;
    MODELER_ZEROS(phi + 1380, 8);
    /* link 42: acceleration of the origin less gravity, vd42 = R42' (vd32 + U32 p42) */
    const double minus_vd42_z = minus_vd22_y + orthoglide_2012_geo_d4*minus_U32_zx;
    MODELER_ZEROS(phi + 1388, 8);
    /* link 42: velocity of the origin, for unit speed of each joint below, m42 = R42' (m32 + e32 x
        p42) */
    const double m42_22z = orthoglide_2012_geo_d4*c9;
    MODELER_ZEROS(phi + 1396, 8);
    phi[1692] = m42_22z*qdd[8] - minus_vd42_z;
    MODELER_ZEROS(phi + 1404, 8);
    const double minus_m42_32x = orthoglide_2012_geo_d4*s9;
    MODELER_ZEROS(phi + 1412, 8);
    phi[1888] = minus_m42_32x*ww22_zz;
    MODELER_ZEROS(phi + 1420, 5);
    phi[910] = t42;
    MODELER_ZEROS(phi + 1433, 2);
    MODELER_ZEROS(phi + 1438, 6);
    const double minus_vd42a_x = minus_vd32_x + orthoglide_2012_geo_d4*minus_U32_xx;
    MODELER_ZEROS(phi + 1445, 1);
    const double vd42a_y = vd32_y + orthoglide_2012_geo_d4*U32_yx;
    MODELER_ZEROS(phi + 1451, 8);
    const double minus_vd42_x = c9*minus_vd42a_x + s9*vd42a_y;
    MODELER_ZEROS(phi + 1459, 1);
    phi[1694] = minus_vd42_x - m42_22z*ww22_zz;
    MODELER_ZEROS(phi + 1461, 8);
    phi[1890] = minus_m42_32x*qdd[8];
    MODELER_ZEROS(phi + 1469, 8);
    /* link 52: acceleration of the origin less gravity, vd52 = R52' (vd42 + U42 p52) */
    const double minus_vd52_y = c8*minus_vd42_z + s8*minus_vd42_x;
    MODELER_ZEROS(phi + 1477, 8);
    phi[911] = minus_vd52_y;
    MODELER_ZEROS(phi + 1485, 8);
    const double t74 = m42_22z*minus_vd42_z;
    MODELER_ZEROS(phi + 1493, 8);
    phi[1695] = -t74;
    MODELER_ZEROS(phi + 1501, 8);
    MODELER_ZEROS(phi + 1509, 8);
    const double t75 = minus_m42_32x*minus_vd42_x + m42_22z*(c9*vd42a_y - s9*minus_vd42a_x);
    MODELER_ZEROS(phi + 1517, 8);
    phi[1891] = t75;
    MODELER_ZEROS(phi + 1525, 8);
    phi[1892] = qdd[9];
    MODELER_ZEROS(phi + 1533, 8);
    phi[1893] = qd[9];
    MODELER_ZEROS(phi + 1541, 8);
    phi[1894] = t66;
    MODELER_ZEROS(phi + 1549, 8);
    phi[924] = minus_vd52_y;
    MODELER_ZEROS(phi + 1557, 8);
    phi[1708] = -t74;
    MODELER_ZEROS(phi + 1565, 8);
    phi[1904] = t75;
    MODELER_ZEROS(phi + 1573, 8);
    phi[1709] = qdd[8];
    MODELER_ZEROS(phi + 1581, 8);
    MODELER_ZEROS(phi + 1589, 8);
    phi[1710] = qd[8];
    MODELER_ZEROS(phi + 1597, 8);
    phi[1711] = t44;
    MODELER_ZEROS(phi + 1605, 8);
    phi[2109] = qdd[10];
    MODELER_ZEROS(phi + 1613, 8);
    const double ww23_zz = qd[10]*qd[10];
    MODELER_ZEROS(phi + 1621, 8);
    const double t77 = s10*ww23_zz - c10*qdd[10];
    MODELER_ZEROS(phi + 1629, 8);
    phi[1130] = t77;
    MODELER_ZEROS(phi + 1637, 8);
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    MODELER_ZEROS(phi + 1645, 8);
    phi[2110] = -minus_vd23_y;
    MODELER_ZEROS(phi + 1653, 8);
    const double t79 = s10*qdd[10] + c10*ww23_zz;
    MODELER_ZEROS(phi + 1661, 4);
    MODELER_ZEROS(phi + 1668, 2);
    phi[1131] = t79;
    MODELER_ZEROS(phi + 1678, 1);
    const double minus_vd23_x = s10*vd13_z;
    MODELER_ZEROS(phi + 1682, 7);
    phi[2111] = minus_vd23_x;
    MODELER_ZEROS(phi + 1690, 2);
    phi[1133] = vd13_z;
    MODELER_ZEROS(phi + 1693, 1);
    phi[2114] = qdd[10];
    MODELER_ZEROS(phi + 1696, 8);
    phi[2115] = qd[10];
    MODELER_ZEROS(phi + 1704, 4);
    const double t81 = modeler_sign(qd[10]);
    MODELER_ZEROS(phi + 1712, 8);
    phi[2116] = t81;
    MODELER_ZEROS(phi + 1720, 8);
    /* link 33: acceleration of points of the link, U33 = [wd33 x] + [w33 x][w33 x] */
    const double U33_yz = s11*qdd[10];
    MODELER_ZEROS(phi + 1728, 8);
    MODELER_ZEROS(phi + 1736, 8);
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_y = c11*qd[10];
    MODELER_ZEROS(phi + 1744, 8);
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    MODELER_ZEROS(phi + 1752, 8);
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = U33_yz + minus_ww33_yz;
    MODELER_ZEROS(phi + 1760, 8);
    const double minus_w33_x = s11*qd[10];
    MODELER_ZEROS(phi + 1768, 8);
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    MODELER_ZEROS(phi + 1776, 8);
    const double t88 = c11*minus_ww33_xz;
    MODELER_ZEROS(phi + 1784, 8);
    phi[2117] = s11*minus_wd33_x + t88;
    MODELER_ZEROS(phi + 1792, 8);
    const double ww33_xy = minus_w33_x*minus_w33_y;
    MODELER_ZEROS(phi + 1800, 8);
    phi[2313] = -ww33_xy;
    MODELER_ZEROS(phi + 1808, 8);
    MODELER_ZEROS(phi + 1816, 8);
    const double minus_U33_xz = c11*qdd[10];
    MODELER_ZEROS(phi + 1824, 8);
    const double minus_wd33_y = minus_U33_xz - minus_ww33_xz;
    MODELER_ZEROS(phi + 1832, 8);
    const double minus_U33_zx = minus_ww33_xz - minus_wd33_y;
    MODELER_ZEROS(phi + 1840, 8);
    const double minus_U33_zy = minus_ww33_yz + minus_wd33_x;
    MODELER_ZEROS(phi + 1848, 8);
    phi[2118] = c11*minus_U33_zy - s11*minus_U33_zx;
    MODELER_ZEROS(phi + 1856, 8);
    const double ww33_zz = qd[11]*qd[11];
    MODELER_ZEROS(phi + 1864, 5);
    const double minus_U33_xx = minus_w33_y*minus_w33_y + ww33_zz;
    MODELER_ZEROS(phi + 1877, 2);
    const double minus_U33_yy = minus_w33_x*minus_w33_x + ww33_zz;
    MODELER_ZEROS(phi + 1882, 6);
    phi[2314] = minus_U33_yy - minus_U33_xx;
    MODELER_ZEROS(phi + 1889, 1);
    MODELER_ZEROS(phi + 1895, 8);
    const double U33_yx = qdd[11] + ww33_xy;
    MODELER_ZEROS(phi + 1903, 1);
    phi[2119] = c11*(ww23_zz - minus_U33_xx) - s11*U33_yx;
    MODELER_ZEROS(phi + 1905, 8);
    phi[2315] = -U33_yz;
    MODELER_ZEROS(phi + 1913, 8);
    phi[2120] = c11*minus_wd33_y - t88;
    MODELER_ZEROS(phi + 1921, 8);
    phi[2316] = ww33_xy;
    MODELER_ZEROS(phi + 1929, 8);
    const double minus_U33_xy = qdd[11] - ww33_xy;
    MODELER_ZEROS(phi + 1937, 8);
    phi[2121] = -(s11*(ww23_zz - minus_U33_yy) + c11*minus_U33_xy);
    MODELER_ZEROS(phi + 1945, 8);
    phi[2317] = -minus_U33_xz;
    MODELER_ZEROS(phi + 1953, 8);
    phi[2318] = qdd[11];
    MODELER_ZEROS(phi + 1961, 8);
    MODELER_ZEROS(phi + 1969, 8);
    const double minus_x33_y = s10*c11;
    MODELER_ZEROS(phi + 1977, 8);
    const double y33_y = s10*s11;
    MODELER_ZEROS(phi + 1985, 8);
    phi[1143] = minus_x33_y*minus_U33_xx + y33_y*U33_yx + c10*minus_U33_zx;
    MODELER_ZEROS(phi + 1993, 8);
    phi[2123] = -c11*minus_vd23_y;
    MODELER_ZEROS(phi + 2001, 8);
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) */
    const double vd33_y = s11*minus_vd23_x;
    MODELER_ZEROS(phi + 2009, 8);
    phi[2319] = vd33_y;
    MODELER_ZEROS(phi + 2017, 8);
    phi[1144] = minus_x33_y*minus_U33_xy - y33_y*minus_U33_yy + c10*minus_U33_zy;
    MODELER_ZEROS(phi + 2025, 8);
    phi[2124] = s11*minus_vd23_y;
    MODELER_ZEROS(phi + 2033, 8);
    const double minus_vd33_x = c11*minus_vd23_x;
    MODELER_ZEROS(phi + 2041, 8);
    MODELER_ZEROS(phi + 2049, 8);
    phi[2320] = minus_vd33_x;
    MODELER_ZEROS(phi + 2057, 8);
    phi[1145] = t79;
    MODELER_ZEROS(phi + 2065, 8);
    phi[2125] = minus_vd23_x;
    MODELER_ZEROS(phi + 2073, 8);
    phi[1146] = vd13_z;
    MODELER_ZEROS(phi + 2081, 8);
    phi[2323] = qdd[11];
    MODELER_ZEROS(phi + 2089, 8);
    phi[2324] = qd[11];
    MODELER_ZEROS(phi + 2097, 8);
    const double t103 = modeler_sign(qd[11]);
    MODELER_ZEROS(phi + 2105, 4);
    phi[2325] = t103;
    MODELER_ZEROS(phi + 2112, 2);
    phi[2133] = qdd[10];
    MODELER_ZEROS(phi + 2122, 1);
    MODELER_ZEROS(phi + 2126, 7);
    phi[1156] = t77;
    MODELER_ZEROS(phi + 2134, 2);
    /* link 43: acceleration of the origin less gravity, vd43 = R43' (vd33 + U33 p43) */
    const double minus_vd43_z = minus_vd23_y + orthoglide_2012_geo_d4*minus_U33_zx;
    MODELER_ZEROS(phi + 2137, 1);
    /* link 43: velocity of the origin, for unit speed of each joint below, m43 = R43' (m33 + e33 x
        p43) */
    const double m43_23z = orthoglide_2012_geo_d4*c11;
    MODELER_ZEROS(phi + 2140, 8);
    phi[2136] = m43_23z*qdd[10] - minus_vd43_z;
    MODELER_ZEROS(phi + 2148, 4);
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
    const double minus_o43_x = orthoglide_2012_geo_d4*s11;
    MODELER_ZEROS(phi + 2156, 8);
    phi[2332] = minus_o43_x*ww23_zz;
    MODELER_ZEROS(phi + 2164, 8);
    phi[1158] = t79;
    MODELER_ZEROS(phi + 2172, 8);
    const double minus_vd43a_x = minus_vd33_x + orthoglide_2012_geo_d4*minus_U33_xx;
    MODELER_ZEROS(phi + 2180, 8);
    const double vd43a_y = vd33_y + orthoglide_2012_geo_d4*U33_yx;
    MODELER_ZEROS(phi + 2188, 8);
    MODELER_ZEROS(phi + 2196, 8);
    const double minus_vd43_x = c11*minus_vd43a_x + s11*vd43a_y;
    MODELER_ZEROS(phi + 2204, 8);
    phi[2138] = minus_vd43_x - m43_23z*ww23_zz;
    MODELER_ZEROS(phi + 2212, 8);
    phi[2334] = minus_o43_x*qdd[10];
    MODELER_ZEROS(phi + 2220, 8);
    /* link 53: acceleration of the origin less gravity, vd53 = R53' (vd43 + U43 p53) */
    const double minus_vd53_y = c10*minus_vd43_z + s10*minus_vd43_x;
    MODELER_ZEROS(phi + 2228, 8);
    phi[1159] = minus_vd53_y;
    MODELER_ZEROS(phi + 2236, 8);
    const double t111 = m43_23z*minus_vd43_z;
    MODELER_ZEROS(phi + 2244, 8);
    phi[2139] = -t111;
    MODELER_ZEROS(phi + 2252, 8);
    const double t112 = minus_o43_x*minus_vd43_x + m43_23z*(c11*vd43a_y - s11*minus_vd43a_x);
    MODELER_ZEROS(phi + 2260, 8);
    phi[2335] = t112;
    MODELER_ZEROS(phi + 2268, 8);
    MODELER_ZEROS(phi + 2276, 8);
    phi[2336] = qdd[11];
    MODELER_ZEROS(phi + 2284, 8);
    phi[2337] = qd[11];
    MODELER_ZEROS(phi + 2292, 8);
    phi[2338] = t103;
    MODELER_ZEROS(phi + 2300, 8);
    phi[1172] = minus_vd53_y;
    MODELER_ZEROS(phi + 2308, 5);
    phi[2152] = -t111;
    MODELER_ZEROS(phi + 2321, 2);
    phi[2348] = t112;
    MODELER_ZEROS(phi + 2326, 6);
    phi[2153] = qdd[10];
    MODELER_ZEROS(phi + 2333, 1);
    phi[2154] = qd[10];
    MODELER_ZEROS(phi + 2339, 8);
    phi[2155] = t81;
    MODELER_ZEROS(phi + 2347, 1);
    MODELER_ZEROS(phi + 2349, 3);
}
