/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003.h.
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
 *   n_1    moment on the link at its origin for one unit of a parameter
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: vd
 */
#include "orthoglide_2003.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2003_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2003_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
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

/* Regressor of the standard parameters.
 * 99 additions, 172 multiplications. */
MODELER_CLONES
void orthoglide_2003_tree_regressor(const double q[12], const double qd[12], const double qdd[12],
                                    double MODELER_OUT(phi, 12 * 163))
{
    MODELER_ALL_ZEROS(phi, 1956);

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
    phi[163] = qdd[1] - orthoglide_2003_geo_g;
    MODELER_ZEROS(phi + 1, 8);
    phi[326] = qdd[2];
    MODELER_ZEROS(phi + 9, 8);
    phi[499] = qdd[3];
    MODELER_ZEROS(phi + 17, 8);
    phi[500] = qdd[3];
    MODELER_ZEROS(phi + 25, 8);
    phi[501] = qd[3];
    phi[502] = modeler_sign(qd[3]);
    MODELER_ZEROS(phi + 33, 8);
    phi[503] = 1.0;
    MODELER_ZEROS(phi + 41, 8);
    phi[676] = qdd[4];
    MODELER_ZEROS(phi + 49, 8);
    phi[677] = qdd[4];
    MODELER_ZEROS(phi + 57, 8);
    phi[678] = qd[4];
    phi[679] = modeler_sign(qd[4]);
    MODELER_ZEROS(phi + 65, 8);
    phi[680] = 1.0;
    MODELER_ZEROS(phi + 73, 8);
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2003_geo_g;
    MODELER_ZEROS(phi + 81, 8);
    phi[853] = vd13_z;
    MODELER_ZEROS(phi + 89, 8);
    phi[854] = qdd[5];
    phi[855] = qd[5];
    MODELER_ZEROS(phi + 97, 8);
    phi[856] = modeler_sign(qd[5]);
    MODELER_ZEROS(phi + 105, 8);
    phi[857] = 1.0;
    MODELER_ZEROS(phi + 113, 8);
    phi[1026] = qdd[6];
    MODELER_ZEROS(phi + 121, 8);
    const double ww21_zz = qd[6]*qd[6];
    const double t3 = s6*ww21_zz - c6*qdd[6];
    MODELER_ZEROS(phi + 129, 8);
    phi[538] = t3;
    MODELER_ZEROS(phi + 137, 8);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    MODELER_ZEROS(phi + 145, 8);
    phi[1027] = -minus_vd21_y;
    MODELER_ZEROS(phi + 153, 8);
    const double t5 = s6*qdd[6] + c6*ww21_zz;
    phi[539] = t5;
    MODELER_ZEROS(phi + 161, 2);
    const double minus_vd21_x = s6*qdd[3];
    MODELER_ZEROS(phi + 164, 8);
    phi[1028] = minus_vd21_x;
    MODELER_ZEROS(phi + 172, 8);
    phi[541] = qdd[3];
    MODELER_ZEROS(phi + 180, 8);
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double U31_yz = s7*qdd[6];
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    MODELER_ZEROS(phi + 188, 8);
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    MODELER_ZEROS(phi + 196, 8);
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = U31_yz + minus_ww31_yz;
    MODELER_ZEROS(phi + 204, 8);
    const double minus_w31_x = s7*qd[6];
    MODELER_ZEROS(phi + 212, 8);
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    const double t13 = c7*minus_ww31_xz;
    MODELER_ZEROS(phi + 220, 8);
    const double t14 = s7*minus_wd31_x + t13;
    MODELER_ZEROS(phi + 228, 8);
    phi[1031] = t14;
    MODELER_ZEROS(phi + 236, 8);
    const double ww31_xy = minus_w31_x*minus_w31_y;
    MODELER_ZEROS(phi + 244, 8);
    phi[1194] = -ww31_xy;
    MODELER_ZEROS(phi + 252, 8);
    const double minus_U31_xz = c7*qdd[6];
    const double minus_wd31_y = minus_U31_xz - minus_ww31_xz;
    MODELER_ZEROS(phi + 260, 8);
    const double minus_U31_zx = minus_ww31_xz - minus_wd31_y;
    MODELER_ZEROS(phi + 268, 8);
    const double minus_U31_zy = minus_ww31_yz + minus_wd31_x;
    MODELER_ZEROS(phi + 276, 8);
    const double t20 = s7*minus_U31_zx - c7*minus_U31_zy;
    MODELER_ZEROS(phi + 284, 8);
    phi[1032] = -t20;
    const double ww31_zz = qd[7]*qd[7];
    MODELER_ZEROS(phi + 292, 8);
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    MODELER_ZEROS(phi + 300, 8);
    const double minus_U31_yy = minus_w31_x*minus_w31_x + ww31_zz;
    MODELER_ZEROS(phi + 308, 8);
    /* link 31: moment on the link at its origin for one unit of a parameter, n31 = J31 wd31 + w31 x
        J31 w31 + MS31 x vd31 */
    const double minus_n31_XYz = minus_U31_xx - minus_U31_yy;
    MODELER_ZEROS(phi + 316, 8);
    phi[1195] = -minus_n31_XYz;
    const double U31_yx = qdd[7] + ww31_xy;
    MODELER_ZEROS(phi + 324, 2);
    const double t26 = s7*U31_yx - c7*(ww21_zz - minus_U31_xx);
    MODELER_ZEROS(phi + 327, 8);
    phi[1033] = -t26;
    MODELER_ZEROS(phi + 335, 8);
    phi[1196] = -U31_yz;
    MODELER_ZEROS(phi + 343, 8);
    const double t27 = c7*minus_wd31_y - t13;
    phi[1034] = t27;
    MODELER_ZEROS(phi + 351, 8);
    phi[1197] = ww31_xy;
    MODELER_ZEROS(phi + 359, 8);
    const double minus_U31_xy = qdd[7] - ww31_xy;
    MODELER_ZEROS(phi + 367, 8);
    const double t29 = s7*(ww21_zz - minus_U31_yy) + c7*minus_U31_xy;
    MODELER_ZEROS(phi + 375, 8);
    phi[1035] = -t29;
    phi[1198] = -minus_U31_xz;
    MODELER_ZEROS(phi + 383, 8);
    phi[1199] = qdd[7];
    MODELER_ZEROS(phi + 391, 8);
    const double minus_x31_z = s6*c7;
    MODELER_ZEROS(phi + 399, 8);
    const double y31_z = s6*s7;
    MODELER_ZEROS(phi + 407, 8);
    const double t32 = minus_x31_z*minus_U31_xx + y31_z*U31_yx + c6*minus_U31_zx;
    phi[548] = t32;
    MODELER_ZEROS(phi + 415, 8);
    const double t33 = c7*minus_vd21_y;
    MODELER_ZEROS(phi + 423, 8);
    phi[1037] = -t33;
    MODELER_ZEROS(phi + 431, 8);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double vd31_y = orthoglide_2003_geo_g*c7 + s7*minus_vd21_x;
    MODELER_ZEROS(phi + 439, 8);
    phi[1200] = vd31_y;
    const double t35 = minus_x31_z*minus_U31_xy - y31_z*minus_U31_yy + c6*minus_U31_zy;
    MODELER_ZEROS(phi + 447, 8);
    phi[549] = t35;
    MODELER_ZEROS(phi + 455, 8);
    const double t36 = s7*minus_vd21_y;
    MODELER_ZEROS(phi + 463, 8);
    phi[1038] = t36;
    MODELER_ZEROS(phi + 471, 8);
    const double minus_vd31_x = c7*minus_vd21_x - orthoglide_2003_geo_g*s7;
    phi[1201] = minus_vd31_x;
    MODELER_ZEROS(phi + 479, 8);
    phi[550] = t5;
    MODELER_ZEROS(phi + 487, 8);
    phi[1039] = minus_vd21_x;
    MODELER_ZEROS(phi + 495, 4);
    phi[551] = qdd[3];
    MODELER_ZEROS(phi + 504, 8);
    phi[1044] = qdd[6];
    MODELER_ZEROS(phi + 512, 8);
    phi[558] = t3;
    /* link 41: acceleration of the origin less gravity, vd41 = R41' (vd31 + U31 p41) */
    const double minus_vd41_z = minus_vd21_y + orthoglide_2003_geo_D41*minus_U31_zx;
    MODELER_ZEROS(phi + 520, 8);
    /* link 41: velocity of the origin, for unit speed of each joint below, m41 = R41' (m31 + e31 x
        p41) */
    const double m41_21z = orthoglide_2003_geo_D41*c7;
    MODELER_ZEROS(phi + 528, 8);
    phi[1047] = m41_21z*qdd[6] - minus_vd41_z;
    MODELER_ZEROS(phi + 536, 2);
    /* link 61: origin of the frame in frame 0, o61 = o51 + [x51 y51 z51] p61 */
    const double minus_o61_y = orthoglide_2003_geo_D41*s7;
    MODELER_ZEROS(phi + 540, 1);
    phi[1210] = minus_o61_y*ww21_zz;
    phi[560] = t5;
    MODELER_ZEROS(phi + 542, 6);
    const double minus_vd41a_x = minus_vd31_x + orthoglide_2003_geo_D41*minus_U31_xx;
    MODELER_ZEROS(phi + 552, 6);
    const double vd41a_y = vd31_y + orthoglide_2003_geo_D41*U31_yx;
    MODELER_ZEROS(phi + 559, 1);
    const double minus_vd41_x = c7*minus_vd41a_x + s7*vd41a_y;
    MODELER_ZEROS(phi + 562, 6);
    phi[1049] = minus_vd41_x - m41_21z*ww21_zz;
    phi[1212] = minus_o61_y*qdd[6];
    MODELER_ZEROS(phi + 572, 8);
    phi[561] = s6*minus_vd41_x + c6*minus_vd41_z;
    MODELER_ZEROS(phi + 580, 8);
    phi[1050] = -m41_21z*minus_vd41_z;
    MODELER_ZEROS(phi + 588, 8);
    phi[1213] = minus_o61_y*minus_vd41_x + m41_21z*(c7*vd41a_y - s7*minus_vd41a_x);
    MODELER_ZEROS(phi + 596, 8);
    phi[1051] = t14;
    phi[1214] = -ww31_xy;
    MODELER_ZEROS(phi + 604, 8);
    phi[1052] = -t20;
    MODELER_ZEROS(phi + 612, 8);
    phi[1215] = -minus_n31_XYz;
    MODELER_ZEROS(phi + 620, 8);
    phi[1053] = -t26;
    MODELER_ZEROS(phi + 628, 8);
    phi[1216] = -U31_yz;
    phi[1054] = t27;
    MODELER_ZEROS(phi + 636, 8);
    phi[1217] = ww31_xy;
    MODELER_ZEROS(phi + 644, 8);
    phi[1055] = -t29;
    MODELER_ZEROS(phi + 652, 8);
    phi[1218] = -minus_U31_xz;
    MODELER_ZEROS(phi + 660, 8);
    phi[1219] = qdd[7];
    phi[568] = t32;
    MODELER_ZEROS(phi + 668, 8);
    phi[1057] = -t33;
    MODELER_ZEROS(phi + 681, 8);
    phi[1220] = vd31_y;
    MODELER_ZEROS(phi + 689, 8);
    phi[569] = t35;
    MODELER_ZEROS(phi + 697, 8);
    phi[1058] = t36;
    phi[1221] = minus_vd31_x;
    MODELER_ZEROS(phi + 705, 8);
    phi[570] = t5;
    MODELER_ZEROS(phi + 713, 8);
    phi[1059] = minus_vd21_x;
    MODELER_ZEROS(phi + 721, 8);
    phi[571] = qdd[3];
    MODELER_ZEROS(phi + 729, 8);
    phi[1392] = qdd[8];
    MODELER_ZEROS(phi + 737, 4);
    const double ww22_zz = qd[8]*qd[8];
    const double t45 = s8*ww22_zz - c8*qdd[8];
    MODELER_ZEROS(phi + 743, 1);
    phi[741] = t45;
    MODELER_ZEROS(phi + 745, 6);
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    MODELER_ZEROS(phi + 755, 6);
    phi[1393] = -minus_vd22_y;
    MODELER_ZEROS(phi + 762, 1);
    const double t47 = s8*qdd[8] + c8*ww22_zz;
    phi[742] = t47;
    MODELER_ZEROS(phi + 765, 6);
    const double minus_vd22_x = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    MODELER_ZEROS(phi + 775, 8);
    phi[1394] = minus_vd22_x;
    MODELER_ZEROS(phi + 783, 8);
    phi[744] = qdd[4];
    MODELER_ZEROS(phi + 791, 8);
    /* link 32: acceleration of points of the link, U32 = [wd32 x] + [w32 x][w32 x] */
    const double U32_yz = s9*qdd[8];
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_y = c9*qd[8];
    MODELER_ZEROS(phi + 799, 8);
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    MODELER_ZEROS(phi + 807, 8);
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = U32_yz + minus_ww32_yz;
    MODELER_ZEROS(phi + 815, 8);
    const double minus_w32_x = s9*qd[8];
    MODELER_ZEROS(phi + 823, 8);
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    const double t55 = c9*minus_ww32_xz;
    MODELER_ZEROS(phi + 831, 8);
    const double t56 = s9*minus_wd32_x + t55;
    MODELER_ZEROS(phi + 839, 8);
    phi[1397] = t56;
    MODELER_ZEROS(phi + 847, 6);
    const double ww32_xy = minus_w32_x*minus_w32_y;
    MODELER_ZEROS(phi + 858, 8);
    phi[1560] = -ww32_xy;
    const double minus_U32_xz = c9*qdd[8];
    MODELER_ZEROS(phi + 866, 8);
    const double minus_wd32_y = minus_U32_xz - minus_ww32_xz;
    MODELER_ZEROS(phi + 874, 8);
    const double minus_U32_zx = minus_ww32_xz - minus_wd32_y;
    MODELER_ZEROS(phi + 882, 8);
    const double minus_U32_zy = minus_ww32_yz + minus_wd32_x;
    MODELER_ZEROS(phi + 890, 8);
    const double t62 = s9*minus_U32_zx - c9*minus_U32_zy;
    phi[1398] = -t62;
    MODELER_ZEROS(phi + 898, 8);
    const double ww32_zz = qd[9]*qd[9];
    MODELER_ZEROS(phi + 906, 8);
    const double minus_U32_xx = minus_w32_y*minus_w32_y + ww32_zz;
    MODELER_ZEROS(phi + 914, 8);
    const double minus_U32_yy = minus_w32_x*minus_w32_x + ww32_zz;
    MODELER_ZEROS(phi + 922, 8);
    /* link 32: moment on the link at its origin for one unit of a parameter, n32 = J32 wd32 + w32 x
        J32 w32 + MS32 x vd32 */
    const double minus_n32_XYz = minus_U32_xx - minus_U32_yy;
    phi[1561] = -minus_n32_XYz;
    MODELER_ZEROS(phi + 930, 8);
    const double U32_yx = qdd[9] + ww32_xy;
    MODELER_ZEROS(phi + 938, 6);
    const double t68 = s9*U32_yx - c9*(ww22_zz - minus_U32_xx);
    MODELER_ZEROS(phi + 946, 1);
    phi[1399] = -t68;
    MODELER_ZEROS(phi + 948, 6);
    phi[1562] = -U32_yz;
    const double t69 = c9*minus_wd32_y - t55;
    MODELER_ZEROS(phi + 958, 6);
    phi[1400] = t69;
    MODELER_ZEROS(phi + 965, 1);
    phi[1563] = ww32_xy;
    MODELER_ZEROS(phi + 968, 6);
    const double minus_U32_xy = qdd[9] - ww32_xy;
    MODELER_ZEROS(phi + 978, 8);
    const double t71 = s9*(ww22_zz - minus_U32_yy) + c9*minus_U32_xy;
    MODELER_ZEROS(phi + 986, 8);
    phi[1401] = -t71;
    phi[1564] = -minus_U32_xz;
    MODELER_ZEROS(phi + 994, 8);
    phi[1565] = qdd[9];
    MODELER_ZEROS(phi + 1002, 8);
    const double minus_x32_x = s8*c9;
    MODELER_ZEROS(phi + 1010, 8);
    const double y32_x = s8*s9;
    MODELER_ZEROS(phi + 1018, 8);
    const double t74 = minus_x32_x*minus_U32_xx + y32_x*U32_yx + c8*minus_U32_zx;
    phi[751] = t74;
    MODELER_ZEROS(phi + 1029, 2);
    const double t75 = c9*minus_vd22_y;
    MODELER_ZEROS(phi + 1036, 1);
    phi[1403] = -t75;
    MODELER_ZEROS(phi + 1040, 4);
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) */
    const double vd32_y = s9*minus_vd22_x;
    MODELER_ZEROS(phi + 1045, 2);
    phi[1566] = vd32_y;
    const double t77 = minus_x32_x*minus_U32_xy - y32_x*minus_U32_yy + c8*minus_U32_zy;
    MODELER_ZEROS(phi + 1048, 1);
    phi[752] = t77;
    MODELER_ZEROS(phi + 1056, 1);
    const double t78 = s9*minus_vd22_y;
    MODELER_ZEROS(phi + 1060, 8);
    phi[1404] = t78;
    MODELER_ZEROS(phi + 1068, 8);
    const double minus_vd32_x = c9*minus_vd22_x;
    phi[1567] = minus_vd32_x;
    MODELER_ZEROS(phi + 1076, 8);
    phi[753] = t47;
    MODELER_ZEROS(phi + 1084, 8);
    phi[1405] = minus_vd22_x;
    MODELER_ZEROS(phi + 1092, 8);
    phi[754] = qdd[4];
    MODELER_ZEROS(phi + 1100, 8);
    phi[1410] = qdd[8];
    phi[761] = t45;
    MODELER_ZEROS(phi + 1108, 8);
    /* link 42: acceleration of the origin less gravity, vd42 = R42' (vd32 + U32 p42) */
    const double minus_vd42_z = minus_vd22_y + orthoglide_2003_geo_D42*minus_U32_zx;
    MODELER_ZEROS(phi + 1116, 8);
    /* link 42: velocity of the origin, for unit speed of each joint below, m42 = R42' (m32 + e32 x
        p42) */
    const double m42_22z = orthoglide_2003_geo_D42*c9;
    MODELER_ZEROS(phi + 1124, 8);
    phi[1413] = m42_22z*qdd[8] - minus_vd42_z;
    MODELER_ZEROS(phi + 1132, 8);
    const double minus_m42_32x = orthoglide_2003_geo_D42*s9;
    phi[1576] = minus_m42_32x*ww22_zz;
    MODELER_ZEROS(phi + 1140, 8);
    phi[763] = t47;
    MODELER_ZEROS(phi + 1148, 8);
    const double minus_vd42a_x = minus_vd32_x + orthoglide_2003_geo_D42*minus_U32_xx;
    MODELER_ZEROS(phi + 1156, 8);
    const double vd42a_y = vd32_y + orthoglide_2003_geo_D42*U32_yx;
    MODELER_ZEROS(phi + 1164, 8);
    const double minus_vd42_x = c9*minus_vd42a_x + s9*vd42a_y;
    phi[1415] = minus_vd42_x - m42_22z*ww22_zz;
    MODELER_ZEROS(phi + 1172, 8);
    phi[1578] = minus_m42_32x*qdd[8];
    MODELER_ZEROS(phi + 1180, 8);
    phi[764] = s8*minus_vd42_x + c8*minus_vd42_z;
    MODELER_ZEROS(phi + 1188, 6);
    phi[1416] = -m42_22z*minus_vd42_z;
    MODELER_ZEROS(phi + 1202, 8);
    phi[1579] = minus_m42_32x*minus_vd42_x + m42_22z*(c9*vd42a_y - s9*minus_vd42a_x);
    phi[1417] = t56;
    MODELER_ZEROS(phi + 1211, 1);
    phi[1580] = -ww32_xy;
    MODELER_ZEROS(phi + 1222, 8);
    phi[1418] = -t62;
    MODELER_ZEROS(phi + 1230, 8);
    phi[1581] = -minus_n32_XYz;
    MODELER_ZEROS(phi + 1238, 8);
    phi[1419] = -t68;
    MODELER_ZEROS(phi + 1246, 8);
    phi[1582] = -U32_yz;
    phi[1420] = t69;
    MODELER_ZEROS(phi + 1254, 8);
    phi[1583] = ww32_xy;
    MODELER_ZEROS(phi + 1262, 8);
    phi[1421] = -t71;
    MODELER_ZEROS(phi + 1270, 8);
    phi[1584] = -minus_U32_xz;
    MODELER_ZEROS(phi + 1278, 8);
    phi[1585] = qdd[9];
    phi[771] = t74;
    MODELER_ZEROS(phi + 1286, 8);
    phi[1423] = -t75;
    MODELER_ZEROS(phi + 1294, 8);
    phi[1586] = vd32_y;
    MODELER_ZEROS(phi + 1302, 8);
    phi[772] = t77;
    MODELER_ZEROS(phi + 1310, 8);
    phi[1424] = t78;
    phi[1587] = minus_vd32_x;
    MODELER_ZEROS(phi + 1318, 8);
    phi[773] = t47;
    MODELER_ZEROS(phi + 1326, 8);
    phi[1425] = minus_vd22_x;
    MODELER_ZEROS(phi + 1334, 8);
    phi[774] = qdd[4];
    MODELER_ZEROS(phi + 1342, 8);
    phi[1758] = qdd[10];
    const double ww23_zz = qd[10]*qd[10];
    MODELER_ZEROS(phi + 1350, 8);
    const double t87 = s10*ww23_zz - c10*qdd[10];
    MODELER_ZEROS(phi + 1358, 8);
    phi[944] = t87;
    MODELER_ZEROS(phi + 1366, 8);
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    MODELER_ZEROS(phi + 1374, 8);
    phi[1759] = -minus_vd23_y;
    const double t89 = s10*qdd[10] + c10*ww23_zz;
    MODELER_ZEROS(phi + 1382, 8);
    phi[945] = t89;
    MODELER_ZEROS(phi + 1390, 2);
    const double minus_vd23_x = s10*vd13_z;
    MODELER_ZEROS(phi + 1395, 2);
    phi[1760] = minus_vd23_x;
    MODELER_ZEROS(phi + 1402, 1);
    phi[947] = vd13_z;
    /* link 33: acceleration of points of the link, U33 = [wd33 x] + [w33 x][w33 x] */
    const double U33_yz = s11*qdd[10];
    MODELER_ZEROS(phi + 1406, 4);
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_y = c11*qd[10];
    MODELER_ZEROS(phi + 1411, 2);
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    MODELER_ZEROS(phi + 1414, 1);
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = U33_yz + minus_ww33_yz;
    MODELER_ZEROS(phi + 1422, 1);
    const double minus_w33_x = s11*qd[10];
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    MODELER_ZEROS(phi + 1426, 8);
    const double t97 = c11*minus_ww33_xz;
    MODELER_ZEROS(phi + 1434, 8);
    const double t98 = s11*minus_wd33_x + t97;
    MODELER_ZEROS(phi + 1442, 8);
    phi[1763] = t98;
    MODELER_ZEROS(phi + 1450, 8);
    const double ww33_xy = minus_w33_x*minus_w33_y;
    MODELER_ZEROS(phi + 1458, 8);
    phi[1926] = -ww33_xy;
    const double minus_U33_xz = c11*qdd[10];
    MODELER_ZEROS(phi + 1466, 8);
    const double minus_wd33_y = minus_U33_xz - minus_ww33_xz;
    MODELER_ZEROS(phi + 1474, 8);
    const double minus_U33_zx = minus_ww33_xz - minus_wd33_y;
    MODELER_ZEROS(phi + 1482, 8);
    const double minus_U33_zy = minus_ww33_yz + minus_wd33_x;
    MODELER_ZEROS(phi + 1490, 8);
    const double t104 = s11*minus_U33_zx - c11*minus_U33_zy;
    phi[1764] = -t104;
    MODELER_ZEROS(phi + 1498, 8);
    const double ww33_zz = qd[11]*qd[11];
    MODELER_ZEROS(phi + 1506, 8);
    const double minus_U33_xx = minus_w33_y*minus_w33_y + ww33_zz;
    MODELER_ZEROS(phi + 1514, 8);
    const double minus_U33_yy = minus_w33_x*minus_w33_x + ww33_zz;
    MODELER_ZEROS(phi + 1522, 8);
    /* link 33: moment on the link at its origin for one unit of a parameter, n33 = J33 wd33 + w33 x
        J33 w33 + MS33 x vd33 */
    const double minus_n33_XYz = minus_U33_xx - minus_U33_yy;
    phi[1927] = -minus_n33_XYz;
    MODELER_ZEROS(phi + 1530, 8);
    const double U33_yx = qdd[11] + ww33_xy;
    MODELER_ZEROS(phi + 1538, 8);
    const double t110 = s11*U33_yx - c11*(ww23_zz - minus_U33_xx);
    MODELER_ZEROS(phi + 1546, 8);
    phi[1765] = -t110;
    MODELER_ZEROS(phi + 1554, 6);
    phi[1928] = -U33_yz;
    const double t111 = c11*minus_wd33_y - t97;
    MODELER_ZEROS(phi + 1568, 8);
    phi[1766] = t111;
    MODELER_ZEROS(phi + 1577, 1);
    phi[1929] = ww33_xy;
    MODELER_ZEROS(phi + 1588, 8);
    const double minus_U33_xy = qdd[11] - ww33_xy;
    MODELER_ZEROS(phi + 1596, 8);
    const double t113 = s11*(ww23_zz - minus_U33_yy) + c11*minus_U33_xy;
    phi[1767] = -t113;
    MODELER_ZEROS(phi + 1604, 8);
    phi[1930] = -minus_U33_xz;
    MODELER_ZEROS(phi + 1612, 8);
    phi[1931] = qdd[11];
    MODELER_ZEROS(phi + 1620, 8);
    const double minus_x33_y = s10*c11;
    MODELER_ZEROS(phi + 1628, 8);
    const double y33_y = s10*s11;
    const double t116 = minus_x33_y*minus_U33_xx + y33_y*U33_yx + c10*minus_U33_zx;
    MODELER_ZEROS(phi + 1636, 8);
    phi[954] = t116;
    MODELER_ZEROS(phi + 1644, 8);
    const double t117 = c11*minus_vd23_y;
    MODELER_ZEROS(phi + 1652, 8);
    phi[1769] = -t117;
    MODELER_ZEROS(phi + 1660, 8);
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) */
    const double vd33_y = s11*minus_vd23_x;
    phi[1932] = vd33_y;
    MODELER_ZEROS(phi + 1668, 8);
    const double t119 = minus_x33_y*minus_U33_xy - y33_y*minus_U33_yy + c10*minus_U33_zy;
    MODELER_ZEROS(phi + 1676, 8);
    phi[955] = t119;
    MODELER_ZEROS(phi + 1684, 8);
    const double t120 = s11*minus_vd23_y;
    MODELER_ZEROS(phi + 1692, 8);
    phi[1770] = t120;
    const double minus_vd33_x = c11*minus_vd23_x;
    MODELER_ZEROS(phi + 1700, 8);
    phi[1933] = minus_vd33_x;
    MODELER_ZEROS(phi + 1708, 8);
    phi[956] = t89;
    MODELER_ZEROS(phi + 1716, 8);
    phi[1771] = minus_vd23_x;
    MODELER_ZEROS(phi + 1724, 8);
    phi[957] = vd13_z;
    MODELER_ZEROS(phi + 1732, 8);
    phi[1776] = qdd[10];
    phi[964] = t87;
    MODELER_ZEROS(phi + 1740, 8);
    /* link 43: acceleration of the origin less gravity, vd43 = R43' (vd33 + U33 p43) */
    const double minus_vd43_z = minus_vd23_y + orthoglide_2003_geo_D43*minus_U33_zx;
    MODELER_ZEROS(phi + 1748, 8);
    /* link 43: velocity of the origin, for unit speed of each joint below, m43 = R43' (m33 + e33 x
        p43) */
    const double m43_23z = orthoglide_2003_geo_D43*c11;
    MODELER_ZEROS(phi + 1756, 2);
    phi[1779] = m43_23z*qdd[10] - minus_vd43_z;
    MODELER_ZEROS(phi + 1761, 2);
    /* link 63: origin of the frame in frame 0, o63 = o53 + [x53 y53 z53] p63 */
    const double minus_o63_x = orthoglide_2003_geo_D43*s11;
    phi[1942] = minus_o63_x*ww23_zz;
    MODELER_ZEROS(phi + 1768, 1);
    phi[966] = t89;
    MODELER_ZEROS(phi + 1772, 4);
    const double minus_vd43a_x = minus_vd33_x + orthoglide_2003_geo_D43*minus_U33_xx;
    MODELER_ZEROS(phi + 1777, 2);
    const double vd43a_y = vd33_y + orthoglide_2003_geo_D43*U33_yx;
    MODELER_ZEROS(phi + 1780, 1);
    const double minus_vd43_x = c11*minus_vd43a_x + s11*vd43a_y;
    phi[1781] = minus_vd43_x - m43_23z*ww23_zz;
    MODELER_ZEROS(phi + 1788, 1);
    phi[1944] = minus_o63_x*qdd[10];
    MODELER_ZEROS(phi + 1792, 8);
    phi[967] = s10*minus_vd43_x + c10*minus_vd43_z;
    MODELER_ZEROS(phi + 1800, 8);
    phi[1782] = -m43_23z*minus_vd43_z;
    MODELER_ZEROS(phi + 1808, 8);
    phi[1945] = minus_o63_x*minus_vd43_x + m43_23z*(c11*vd43a_y - s11*minus_vd43a_x);
    phi[1783] = t98;
    MODELER_ZEROS(phi + 1816, 8);
    phi[1946] = -ww33_xy;
    MODELER_ZEROS(phi + 1824, 8);
    phi[1784] = -t104;
    MODELER_ZEROS(phi + 1832, 8);
    phi[1947] = -minus_n33_XYz;
    MODELER_ZEROS(phi + 1840, 8);
    phi[1785] = -t110;
    phi[1948] = -U33_yz;
    MODELER_ZEROS(phi + 1848, 8);
    phi[1786] = t111;
    MODELER_ZEROS(phi + 1856, 8);
    phi[1949] = ww33_xy;
    MODELER_ZEROS(phi + 1864, 8);
    phi[1787] = -t113;
    MODELER_ZEROS(phi + 1872, 8);
    phi[1950] = -minus_U33_xz;
    phi[1951] = qdd[11];
    MODELER_ZEROS(phi + 1880, 8);
    phi[974] = t116;
    MODELER_ZEROS(phi + 1888, 8);
    phi[1789] = -t117;
    MODELER_ZEROS(phi + 1896, 8);
    phi[1952] = vd33_y;
    MODELER_ZEROS(phi + 1904, 8);
    phi[975] = t119;
    phi[1790] = t120;
    MODELER_ZEROS(phi + 1912, 8);
    phi[1953] = minus_vd33_x;
    MODELER_ZEROS(phi + 1920, 6);
    phi[976] = t89;
    MODELER_ZEROS(phi + 1934, 8);
    phi[1791] = minus_vd23_x;
    MODELER_ZEROS(phi + 1943, 1);
    phi[977] = vd13_z;
    MODELER_ZEROS(phi + 1954, 2);
}
