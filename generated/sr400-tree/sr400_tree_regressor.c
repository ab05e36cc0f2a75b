/* SR400, 6R arm with a parallelogram, cut open
 *
 * Functions of sr400_tree.h.
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
 *   e_1    axes of the joints below, for unit speed of each
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   ...a   in axes of the antecedent: vd
 */
#include "sr400_tree.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DSR400_TREE_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef SR400_TREE_GEO_g
#define SR400_TREE_GEO_g 9.81
#endif
#ifndef SR400_TREE_GEO_D2
#define SR400_TREE_GEO_D2 0.3
#endif
#ifndef SR400_TREE_GEO_D3
#define SR400_TREE_GEO_D3 0.75
#endif
#ifndef SR400_TREE_GEO_D4
#define SR400_TREE_GEO_D4 0.15
#endif
#ifndef SR400_TREE_GEO_RL4
#define SR400_TREE_GEO_RL4 0.8
#endif
#ifndef SR400_TREE_GEO_D8
#define SR400_TREE_GEO_D8 0.35
#endif

static const double sr400_tree_geo_g = SR400_TREE_GEO_g;
static const double sr400_tree_geo_D2 = SR400_TREE_GEO_D2;
static const double sr400_tree_geo_D3 = SR400_TREE_GEO_D3;
static const double sr400_tree_geo_D4 = SR400_TREE_GEO_D4;
static const double sr400_tree_geo_RL4 = SR400_TREE_GEO_RL4;
static const double sr400_tree_geo_D8 = SR400_TREE_GEO_D8;

/* Regressor of the standard parameters.
 * 380 additions, 500 multiplications. */
MODELER_CLONES
void sr400_tree_regressor(const double q[SR400_TREE_JOINTS], const double qd[SR400_TREE_JOINTS],
                          const double qdd[SR400_TREE_JOINTS], double MODELER_OUT(phi, 8 * 80))
{
    MODELER_ALL_ZEROS(phi, 640);

    const double k1 = sr400_tree_geo_D2*sr400_tree_geo_D2;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    phi[5] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    const double t7 = c1*minus_ww2_xz;
    MODELER_ZEROS(phi + 0, 5);
    phi[10] = s1*minus_wd2_x + t7;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    phi[90] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    MODELER_ZEROS(phi + 6, 4);
    phi[11] = c1*minus_U2_zy - s1*minus_U2_zx;
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    phi[91] = minus_U2_yy - minus_U2_xx;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    phi[12] = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    MODELER_ZEROS(phi + 15, 1);
    phi[92] = -U2_yz;
    phi[13] = c1*minus_wd2_y - t7;
    phi[93] = ww2_xy;
    phi[14] = -(s1*(ww1_zz - minus_U2_yy) + c1*(qdd[1] - ww2_xy));
    phi[94] = -minus_U2_xz;
    phi[95] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_tree_geo_D2*qdd[0];
    MODELER_ZEROS(phi + 18, 1);
    phi[16] = c1*vd2_z - sr400_tree_geo_D2*minus_U2_zx;
    const double minus_vd2a_x = sr400_tree_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_tree_geo_g*c1 - s1*minus_vd2a_x;
    phi[96] = -minus_vd2_y;
    phi[17] = -(s1*vd2_z + sr400_tree_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_tree_geo_g*s1;
    phi[97] = minus_vd2_x;
    const double t22 = k1*qdd[0];
    MODELER_ZEROS(phi + 25, 1);
    phi[19] = t22;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = c2*minus_wd2_x + s2*minus_wd2_y + qd[2]*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double minus_e3_1x = s1*c2 + c1*s2;
    const double minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    const double w3_z = qd[1] + qd[2];
    const double minus_ww3_xz = minus_w3_x*w3_z;
    MODELER_ZEROS(phi + 65, 1);
    const double minus_e3_1y = c1*c2 - s1*s2;
    const double t30 = minus_ww3_xz*minus_e3_1y;
    phi[20] = minus_wd3_x*minus_e3_1x + t30;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    phi[100] = -ww3_xy;
    phi[180] = -ww3_xy;
    const double minus_wd3_y = c2*minus_wd2_y - s2*minus_wd2_x - qd[2]*minus_w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    MODELER_ZEROS(phi + 68, 1);
    const double minus_ww3_yz = minus_w3_y*w3_z;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    phi[21] = U3_zx*minus_e3_1x + minus_U3_zy*minus_e3_1y;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    MODELER_ZEROS(phi + 75, 1);
    phi[101] = -minus_n3_XYz;
    phi[181] = -minus_n3_XYz;
    const double wd3_z = qdd[1] + qdd[2];
    const double U3_yx = wd3_z + ww3_xy;
    phi[22] = minus_e3_1y*(ww1_zz - minus_U3_xx) - U3_yx*minus_e3_1x;
    const double U3_yz = minus_wd3_x - minus_ww3_yz;
    phi[102] = -U3_yz;
    phi[182] = -U3_yz;
    MODELER_ZEROS(phi + 80, 8);
    phi[23] = minus_wd3_y*minus_e3_1y - t30;
    phi[103] = ww3_xy;
    phi[183] = ww3_xy;
    const double minus_U3_xy = wd3_z - ww3_xy;
    phi[24] = -(minus_e3_1x*(ww1_zz - minus_U3_yy) + minus_U3_xy*minus_e3_1y);
    const double minus_U3_xz = minus_wd3_y + minus_ww3_xz;
    phi[104] = -minus_U3_xz;
    MODELER_ZEROS(phi + 88, 2);
    phi[184] = -minus_U3_xz;
    phi[105] = wd3_z;
    phi[185] = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_tree_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_tree_geo_D2 + sr400_tree_geo_D3*c1;
    phi[26] = vd3_z*minus_e3_1y + U3_zx*m3_1z;
    const double minus_vd3a_y = minus_vd2_y - sr400_tree_geo_D3*U2_yx;
    MODELER_ZEROS(phi + 98, 2);
    const double minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*minus_U2_xx;
    const double minus_vd3_y = c2*minus_vd3a_y - s2*minus_vd3a_x;
    const double m3_2x = sr400_tree_geo_D3*s2;
    const double m3_2y = sr400_tree_geo_D3*c2;
    phi[106] = -(minus_U3_xx*m3_2x - U3_yx*m3_2y + minus_vd3_y);
    phi[186] = -minus_vd3_y;
    phi[27] = -(vd3_z*minus_e3_1x + minus_U3_zy*m3_1z);
    const double minus_vd3_x = c2*minus_vd3a_x + s2*minus_vd3a_y;
    MODELER_ZEROS(phi + 140, 8);
    phi[107] = minus_vd3_x - (minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    phi[187] = minus_vd3_x;
    phi[28] = -(minus_vd3_y*minus_e3_1x - minus_vd3_x*minus_e3_1y + ww1_zz*m3_1z);
    phi[108] = U3_yz*m3_2y - minus_U3_xz*m3_2x;
    phi[29] = vd3_z*m3_1z;
    phi[109] = -(minus_vd3_x*m3_2x + minus_vd3_y*m3_2y);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*w3_z - s3*minus_w3_x;
    MODELER_ZEROS(phi + 148, 8);
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*wd3_z + qd[3]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c3*minus_e3_1x;
    const double minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const double w4_z = qd[3] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s3*minus_e3_1x;
    const double t60 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    MODELER_ZEROS(phi + 156, 8);
    const double t62 = ww4_xy*minus_e3_1y;
    phi[30] = minus_wd4_x*minus_e4_1x - t60 + t62;
    const double t63 = c3*minus_ww4_xz;
    const double t64 = s3*minus_wd4_x + t63;
    phi[110] = t64;
    phi[190] = t64;
    phi[270] = -ww4_xy;
    MODELER_ZEROS(phi + 164, 8);
    const double minus_wd4_y = c3*wd3_z - s3*minus_wd3_x - qd[3]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    MODELER_ZEROS(phi + 172, 8);
    phi[31] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y + minus_e3_1y*minus_n4_XYz;
    const double t73 = s3*U4_zx + c3*minus_U4_zy;
    phi[111] = t73;
    phi[191] = t73;
    phi[271] = -minus_n4_XYz;
    const double wd4_z = qdd[3] - minus_wd3_y;
    const double U4_yx = wd4_z + ww4_xy;
    MODELER_ZEROS(phi + 188, 2);
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    phi[32] = U4_yz*minus_e3_1y - (U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy);
    const double t78 = s3*U4_yx - c3*minus_n4_XZy;
    phi[112] = -t78;
    phi[192] = -t78;
    phi[272] = -U4_yz;
    const double t79 = minus_ww4_yz*minus_e4_1x;
    MODELER_ZEROS(phi + 220, 8);
    phi[33] = -(t79 + minus_wd4_y*e4_1y + t62);
    const double t80 = s3*minus_ww4_yz;
    const double t81 = t80 - c3*minus_wd4_y;
    phi[113] = -t81;
    phi[193] = -t81;
    phi[273] = ww4_xy;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    MODELER_ZEROS(phi + 228, 8);
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    phi[34] = minus_U4_xz*minus_e3_1y - (minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y);
    const double t85 = s3*n4_YZx + c3*minus_U4_xy;
    phi[114] = -t85;
    phi[194] = -t85;
    phi[274] = -minus_U4_xz;
    phi[35] = t60 + t79 - wd4_z*minus_e3_1y;
    MODELER_ZEROS(phi + 236, 8);
    const double t86 = t63 - t80;
    phi[115] = -t86;
    phi[195] = -t86;
    phi[275] = wd4_z;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_tree_geo_RL4*minus_U3_yy - sr400_tree_geo_D4*U3_yx +
        minus_vd3_y;
    const double vd4a_z = sr400_tree_geo_D4*U3_zx - sr400_tree_geo_RL4*minus_U3_zy + vd3_z;
    const double t89 = sr400_tree_geo_RL4*minus_U3_xy;
    MODELER_ZEROS(phi + 244, 8);
    const double minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx + t89 + minus_vd3_x;
    const double minus_vd4_y = c3*vd4a_z - s3*minus_vd4a_x;
    const double t92 = sr400_tree_geo_D4*minus_e3_1y - sr400_tree_geo_RL4*minus_e3_1x + m3_1z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s3*t92;
    const double minus_m4_1y = c3*t92;
    phi[36] = minus_vd4_z*e4_1y + minus_vd4_y*minus_e3_1y + (minus_U4_xx*minus_m4_1x -
        U4_yx*minus_m4_1y);
    const double t95 = c3*minus_vd4_z;
    MODELER_ZEROS(phi + 252, 8);
    const double t96 = sr400_tree_geo_RL4 - m3_2x;
    const double minus_m4_2x = c3*t96;
    const double m4_2y = s3*t96;
    const double m4_2z = sr400_tree_geo_D4 + m3_2y;
    phi[116] = minus_U4_xx*minus_m4_2x + U4_yx*m4_2y + U4_zx*m4_2z - t95;
    const double minus_m4_3x = sr400_tree_geo_RL4*c3;
    const double m4_3y = sr400_tree_geo_RL4*s3;
    phi[196] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_tree_geo_D4*U4_zx - t95;
    MODELER_ZEROS(phi + 260, 8);
    phi[276] = -minus_vd4_y;
    const double minus_vd4_x = c3*minus_vd4a_x + s3*vd4a_z;
    const double t103 = minus_vd4_z*minus_e4_1x - minus_vd4_x*minus_e3_1y + (minus_U4_xy*minus_m4_1x
        + minus_U4_yy*minus_m4_1y);
    phi[37] = t103;
    const double t104 = s3*minus_vd4_z;
    const double t105 = minus_U4_xy*minus_m4_2x - minus_U4_yy*m4_2y - minus_U4_zy*m4_2z + t104;
    phi[117] = t105;
    MODELER_ZEROS(phi + 268, 2);
    const double t106 = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_tree_geo_D4*minus_U4_zy
        + t104;
    phi[197] = t106;
    phi[277] = minus_vd4_x;
    phi[38] = minus_U4_xz*minus_m4_1x - U4_yz*minus_m4_1y - (minus_vd4_y*minus_e4_1x +
        minus_vd4_x*e4_1y);
    phi[118] = minus_U4_xz*minus_m4_2x + U4_yz*m4_2y - minus_U3_yy*m4_2z + minus_vd4a_x;
    phi[198] = t89 - sr400_tree_geo_D4*minus_U3_yy + minus_vd4a_x;
    const double t107 = minus_vd4_x*minus_m4_1x + minus_vd4_y*minus_m4_1y;
    phi[39] = t107;
    MODELER_ZEROS(phi + 278, 2);
    const double t108 = minus_vd4_x*minus_m4_2x - minus_vd4_y*m4_2y - minus_vd4_z*m4_2z;
    phi[119] = t108;
    const double t109 = minus_vd4_x*minus_m4_3x - minus_vd4_y*m4_3y - sr400_tree_geo_D4*minus_vd4_z;
    phi[199] = t109;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_1x = c4*minus_e4_1x + s4*minus_e3_1y;
    MODELER_ZEROS(phi + 289, 1);
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double minus_e5_1y = c4*minus_e3_1y - s4*minus_e4_1x;
    const double t117 = minus_ww5_xz*minus_e5_1y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    const double t119 = minus_ww5_xy*e4_1y;
    phi[40] = minus_wd5_x*minus_e5_1x + t117 - t119;
    MODELER_ZEROS(phi + 299, 8);
    const double minus_e5_2x = s3*c4;
    const double e5_2y = s3*s4;
    const double t122 = minus_ww5_xz*e5_2y;
    const double t123 = c3*minus_ww5_xy;
    const double t124 = minus_wd5_x*minus_e5_2x - t122 + t123;
    phi[120] = t124;
    phi[200] = t124;
    MODELER_ZEROS(phi + 307, 8);
    const double t125 = c4*minus_ww5_xz;
    phi[280] = -(s4*minus_wd5_x + t125);
    phi[360] = minus_ww5_xy;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    const double ww5_yz = w5_y*w5_z;
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    MODELER_ZEROS(phi + 315, 8);
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    phi[41] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x - minus_U5_zy*minus_e5_1y);
    const double t134 = minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c3*minus_n5_XYz;
    phi[121] = -t134;
    phi[201] = -t134;
    MODELER_ZEROS(phi + 323, 8);
    phi[281] = s4*minus_U5_zx - c4*minus_U5_zy;
    phi[361] = -minus_n5_XYz;
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    phi[42] = U5_yz*e4_1y - (U5_yx*minus_e5_1x - minus_e5_1y*minus_n5_XZy);
    const double t139 = U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c3*U5_yz;
    MODELER_ZEROS(phi + 331, 8);
    phi[122] = -t139;
    phi[202] = -t139;
    phi[282] = s4*U5_yx - c4*minus_n5_XZy;
    phi[362] = -U5_yz;
    const double t140 = ww5_yz*minus_e5_1x;
    phi[43] = t140 - wd5_y*minus_e5_1y + t119;
    const double t141 = ww5_yz*minus_e5_2x;
    MODELER_ZEROS(phi + 339, 8);
    const double t142 = t123 - (t141 + wd5_y*e5_2y);
    phi[123] = -t142;
    phi[203] = -t142;
    const double t143 = s4*ww5_yz;
    phi[283] = c4*wd5_y - t143;
    phi[363] = -minus_ww5_xy;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    MODELER_ZEROS(phi + 347, 8);
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    phi[44] = -(minus_e5_1x*n5_YZx + minus_U5_xy*minus_e5_1y + U5_xz*e4_1y);
    const double t147 = minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y - c3*U5_xz;
    phi[124] = -t147;
    phi[204] = -t147;
    phi[284] = s4*n5_YZx + c4*minus_U5_xy;
    phi[364] = U5_xz;
    MODELER_ZEROS(phi + 355, 5);
    phi[45] = -(t117 + t140 + wd5_z*e4_1y);
    const double t148 = t122 - t141 + c3*wd5_z;
    phi[125] = t148;
    phi[205] = t148;
    phi[285] = t125 + t143;
    phi[365] = wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    MODELER_ZEROS(phi + 368, 2);
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c4*minus_m4_1x;
    const double m5_1y = s4*minus_m4_1x;
    phi[46] = minus_vd4_y*minus_e5_1y + minus_vd5_y*e4_1y + (minus_U5_xx*minus_m5_1x + U5_yx*m5_1y -
        minus_U5_zx*minus_m4_1y);
    const double t152 = minus_vd4_y*e5_2y + c3*minus_vd5_y;
    const double minus_m5_2x = c4*minus_m4_2x - s4*m4_2z;
    const double m5_2y = c4*m4_2z + s4*minus_m4_2x;
    phi[126] = minus_U5_xx*minus_m5_2x + U5_yx*m5_2y + minus_U5_zx*m4_2y - t152;
    const double minus_m5_3x = c4*minus_m4_3x - sr400_tree_geo_D4*s4;
    MODELER_ZEROS(phi + 379, 8);
    const double m5_3y = sr400_tree_geo_D4*c4 + s4*minus_m4_3x;
    phi[206] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - t152;
    phi[286] = -c4*minus_vd4_y;
    phi[366] = -minus_vd5_y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    const double t158 = minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y + (minus_U5_zy*minus_m4_1y -
        (minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y));
    phi[47] = -t158;
    MODELER_ZEROS(phi + 387, 8);
    const double t159 = minus_vd4_y*minus_e5_2x - c3*minus_vd5_x;
    const double t160 = t159 - (minus_U5_xy*minus_m5_2x - minus_U5_yy*m5_2y + minus_U5_zy*m4_2y);
    phi[127] = -t160;
    const double t161 = t159 - (minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y);
    phi[207] = -t161;
    const double t162 = s4*minus_vd4_y;
    phi[287] = t162;
    phi[367] = minus_vd5_x;
    MODELER_ZEROS(phi + 395, 8);
    phi[48] = -t103;
    phi[128] = -t105;
    phi[208] = -t106;
    phi[288] = -minus_vd4_x;
    phi[49] = t107;
    phi[129] = t108;
    phi[209] = t109;
    MODELER_ZEROS(phi + 403, 8);
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c5*w5_z - s5*minus_w5_x;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = c5*minus_wd5_x + s5*wd5_z + qd[5]*minus_w6_y;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const double minus_e6_1x = c5*minus_e5_1x - s5*e4_1y;
    const double minus_w6_x = c5*minus_w5_x + s5*w5_z;
    const double w6_z = qd[5] + w5_y;
    const double minus_ww6_xz = minus_w6_x*w6_z;
    const double e6_1y = c5*e4_1y + s5*minus_e5_1x;
    const double t170 = minus_ww6_xz*e6_1y;
    MODELER_ZEROS(phi + 411, 8);
    const double ww6_xy = minus_w6_x*minus_w6_y;
    const double t172 = ww6_xy*minus_e5_1y;
    phi[50] = minus_wd6_x*minus_e6_1x - t170 + t172;
    const double minus_e6_2x = c5*minus_e5_2x + c3*s5;
    const double minus_e6_2y = c3*c5 - s5*minus_e5_2x;
    const double t175 = minus_ww6_xz*minus_e6_2y;
    const double t176 = ww6_xy*e5_2y;
    MODELER_ZEROS(phi + 419, 8);
    const double t177 = minus_wd6_x*minus_e6_2x + t175 - t176;
    phi[130] = t177;
    phi[210] = t177;
    const double e6_4x = s4*c5;
    const double minus_e6_4y = s4*s5;
    const double t180 = minus_ww6_xz*minus_e6_4y;
    const double t181 = c4*ww6_xy;
    phi[290] = -(minus_wd6_x*e6_4x - t180 + t181);
    MODELER_ZEROS(phi + 427, 8);
    const double t182 = c5*minus_ww6_xz;
    phi[370] = s5*minus_wd6_x + t182;
    phi[450] = -ww6_xy;
    const double minus_wd6_y = c5*wd5_z - s5*minus_wd5_x - qd[5]*minus_w6_x;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const double U6_zx = minus_wd6_y - minus_ww6_xz;
    const double minus_ww6_yz = minus_w6_y*w6_z;
    const double minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    MODELER_ZEROS(phi + 435, 8);
    const double ww6_zz = w6_z*w6_z;
    const double minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const double minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const double minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    phi[51] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y + minus_e5_1y*minus_n6_XYz;
    const double t191 = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    phi[131] = t191;
    MODELER_ZEROS(phi + 443, 7);
    phi[211] = t191;
    phi[291] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c4*minus_n6_XYz);
    phi[371] = s5*U6_zx + c5*minus_U6_zy;
    phi[451] = -minus_n6_XYz;
    const double wd6_z = qdd[5] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    MODELER_ZEROS(phi + 458, 8);
    phi[52] = U6_yz*minus_e5_1y - (U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy);
    const double t196 = U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y;
    phi[132] = -t196;
    phi[212] = -t196;
    phi[292] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c4*U6_yz;
    phi[372] = c5*minus_n6_XZy - s5*U6_yx;
    phi[452] = -U6_yz;
    MODELER_ZEROS(phi + 466, 8);
    const double t197 = minus_ww6_yz*minus_e6_1x;
    phi[53] = -(t197 + minus_wd6_y*e6_1y + t172);
    const double t198 = minus_ww6_yz*minus_e6_2x;
    const double t199 = minus_wd6_y*minus_e6_2y - t198 + t176;
    phi[133] = t199;
    phi[213] = t199;
    const double t200 = minus_ww6_yz*e6_4x;
    phi[293] = t200 + minus_wd6_y*minus_e6_4y + t181;
    MODELER_ZEROS(phi + 474, 8);
    const double t201 = s5*minus_ww6_yz;
    phi[373] = c5*minus_wd6_y - t201;
    phi[453] = ww6_xy;
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    phi[54] = minus_U6_xz*minus_e5_1y - (minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y);
    MODELER_ZEROS(phi + 482, 8);
    const double t205 = minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y;
    phi[134] = -t205;
    phi[214] = -t205;
    phi[294] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c4*minus_U6_xz;
    phi[374] = -(s5*n6_YZx + c5*minus_U6_xy);
    phi[454] = -minus_U6_xz;
    phi[55] = t170 + t197 - wd6_z*minus_e5_1y;
    const double t206 = t175 - t198 - wd6_z*e5_2y;
    MODELER_ZEROS(phi + 490, 8);
    phi[135] = -t206;
    phi[215] = -t206;
    phi[295] = c4*wd6_z - (t180 + t200);
    phi[375] = t201 - t182;
    phi[455] = wd6_z;
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c5*minus_vd4_y - s5*minus_vd5_x;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c5*minus_m5_1x + s5*minus_m4_1y;
    MODELER_ZEROS(phi + 498, 8);
    const double minus_m6_1y = c5*minus_m4_1y - s5*minus_m5_1x;
    phi[56] = minus_vd5_y*e6_1y + minus_vd6_y*minus_e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const double t210 = minus_vd5_y*minus_e6_2y + minus_vd6_y*e5_2y;
    const double minus_m6_2x = c5*minus_m5_2x - s5*m4_2y;
    const double m6_2y = c5*m4_2y + s5*minus_m5_2x;
    phi[136] = minus_U6_xx*minus_m6_2x + U6_yx*m6_2y + U6_zx*m5_2y - t210;
    const double minus_m6_3x = c5*minus_m5_3x - s5*m4_3y;
    const double m6_3y = c5*m4_3y + s5*minus_m5_3x;
    MODELER_ZEROS(phi + 506, 8);
    phi[216] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - t210;
    phi[296] = -(minus_vd5_y*minus_e6_4y + c4*minus_vd6_y);
    phi[376] = -c5*minus_vd5_y;
    phi[456] = -minus_vd6_y;
    const double minus_vd6_x = c5*minus_vd5_x + s5*minus_vd4_y;
    phi[57] = minus_vd5_y*minus_e6_1x - minus_vd6_x*minus_e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    const double t216 = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y;
    MODELER_ZEROS(phi + 514, 8);
    phi[137] = minus_U6_xy*minus_m6_2x - minus_U6_yy*m6_2y - minus_U6_zy*m5_2y + t216;
    phi[217] = minus_U6_xy*minus_m6_3x - minus_U6_yy*m6_3y - minus_U6_zy*m5_3y + t216;
    phi[297] = c4*minus_vd6_x - minus_vd5_y*e6_4x;
    phi[377] = s5*minus_vd5_y;
    phi[457] = minus_vd6_x;
    phi[58] = -t158;
    phi[138] = -t160;
    phi[218] = -t161;
    MODELER_ZEROS(phi + 522, 8);
    phi[298] = t162;
    phi[378] = minus_vd5_x;
    phi[59] = t107;
    phi[139] = t108;
    phi[219] = t109;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double U7_yz = s6*qdd[0];
    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const double minus_w7_y = c6*qd[0];
    MODELER_ZEROS(phi + 530, 8);
    const double minus_ww7_yz = qd[6]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd1 + (R7' w1) x qd7 z + qdd7 z */
    const double minus_wd7_x = U7_yz + minus_ww7_yz;
    const double minus_w7_x = s6*qd[0];
    const double minus_ww7_xz = qd[6]*minus_w7_x;
    const double t223 = c6*minus_ww7_xz;
    phi[60] = s6*minus_wd7_x + t223;
    const double ww7_xy = minus_w7_x*minus_w7_y;
    MODELER_ZEROS(phi + 538, 2);
    phi[540] = -ww7_xy;
    const double minus_U7_xz = c6*qdd[0];
    const double minus_wd7_y = minus_U7_xz - minus_ww7_xz;
    const double minus_U7_zx = minus_ww7_xz - minus_wd7_y;
    const double minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    phi[61] = c6*minus_U7_zy - s6*minus_U7_zx;
    const double ww7_zz = qd[6]*qd[6];
    const double minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    MODELER_ZEROS(phi + 548, 2);
    const double minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    phi[541] = minus_U7_yy - minus_U7_xx;
    const double U7_yx = qdd[6] + ww7_xy;
    phi[62] = c6*(ww1_zz - minus_U7_xx) - s6*U7_yx;
    phi[542] = -U7_yz;
    phi[63] = c6*minus_wd7_y - t223;
    phi[543] = ww7_xy;
    MODELER_ZEROS(phi + 560, 8);
    phi[64] = -(s6*(ww1_zz - minus_U7_yy) + c6*(qdd[6] - ww7_xy));
    phi[544] = -minus_U7_xz;
    phi[545] = qdd[6];
    phi[66] = c6*vd2_z - sr400_tree_geo_D2*minus_U7_zx;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_tree_geo_g*c6 - s6*minus_vd2a_x;
    phi[546] = -minus_vd7_y;
    phi[67] = -(s6*vd2_z + sr400_tree_geo_D2*minus_U7_zy);
    const double minus_vd7_x = c6*minus_vd2a_x + sr400_tree_geo_g*s6;
    MODELER_ZEROS(phi + 568, 8);
    phi[547] = minus_vd7_x;
    phi[69] = t22;
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const double minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    /* link 8: angular acceleration, wd8 = R8' wd7 + (R8' w7) x qd8 z + qdd8 z */
    const double minus_wd8_x = c7*minus_wd7_x + s7*minus_wd7_y + qd[7]*minus_w8_y;
    /* link 8: axes of the joints below, for unit speed of each, e8 = R8' e7 */
    const double minus_e8_1x = s6*c7 + c6*s7;
    const double minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const double w8_z = qd[6] + qd[7];
    MODELER_ZEROS(phi + 576, 8);
    const double minus_ww8_xz = minus_w8_x*w8_z;
    const double minus_e8_1y = c6*c7 - s6*s7;
    const double t242 = minus_ww8_xz*minus_e8_1y;
    phi[70] = minus_wd8_x*minus_e8_1x + t242;
    const double ww8_xy = minus_w8_x*minus_w8_y;
    phi[550] = -ww8_xy;
    phi[630] = -ww8_xy;
    const double minus_wd8_y = c7*minus_wd7_y - s7*minus_wd7_x - qd[7]*minus_w8_x;
    MODELER_ZEROS(phi + 584, 8);
    /* link 8: acceleration of points of the link, U8 = [wd8 x] + [w8 x][w8 x] */
    const double U8_zx = minus_wd8_y - minus_ww8_xz;
    const double minus_ww8_yz = minus_w8_y*w8_z;
    const double minus_U8_zy = minus_wd8_x + minus_ww8_yz;
    phi[71] = U8_zx*minus_e8_1x + minus_U8_zy*minus_e8_1y;
    const double ww8_zz = w8_z*w8_z;
    const double minus_U8_xx = minus_w8_y*minus_w8_y + ww8_zz;
    const double minus_U8_yy = minus_w8_x*minus_w8_x + ww8_zz;
    MODELER_ZEROS(phi + 592, 8);
    /* link 8: moment on the link at its origin for one unit of a parameter, n8 = J8 wd8 + w8 x J8
        w8 + MS8 x vd8 */
    const double minus_n8_XYz = minus_U8_xx - minus_U8_yy;
    phi[551] = -minus_n8_XYz;
    phi[631] = -minus_n8_XYz;
    const double wd8_z = qdd[6] + qdd[7];
    const double U8_yx = wd8_z + ww8_xy;
    phi[72] = minus_e8_1y*(ww1_zz - minus_U8_xx) - U8_yx*minus_e8_1x;
    const double U8_yz = minus_wd8_x - minus_ww8_yz;
    phi[552] = -U8_yz;
    MODELER_ZEROS(phi + 600, 8);
    phi[632] = -U8_yz;
    phi[73] = minus_wd8_y*minus_e8_1y - t242;
    phi[553] = ww8_xy;
    phi[633] = ww8_xy;
    const double minus_U8_xy = wd8_z - ww8_xy;
    phi[74] = -(minus_e8_1x*(ww1_zz - minus_U8_yy) + minus_U8_xy*minus_e8_1y);
    const double minus_U8_xz = minus_wd8_y + minus_ww8_xz;
    MODELER_ZEROS(phi + 608, 8);
    phi[554] = -minus_U8_xz;
    phi[634] = -minus_U8_xz;
    phi[555] = wd8_z;
    phi[635] = wd8_z;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double vd8_z = vd2_z - sr400_tree_geo_D8*minus_U7_zx;
    /* link 8: velocity of the origin, for unit speed of each joint below, m8 = R8' (m7 + e7 x p8)
        */
    const double m8_1z = sr400_tree_geo_D2 + sr400_tree_geo_D8*c6;
    phi[76] = vd8_z*minus_e8_1y + U8_zx*m8_1z;
    const double minus_vd8a_y = minus_vd7_y - sr400_tree_geo_D8*U7_yx;
    MODELER_ZEROS(phi + 616, 8);
    const double minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*minus_U7_xx;
    const double minus_vd8_y = c7*minus_vd8a_y - s7*minus_vd8a_x;
    const double m8_7x = sr400_tree_geo_D8*s7;
    const double m8_7y = sr400_tree_geo_D8*c7;
    phi[556] = -(minus_U8_xx*m8_7x - U8_yx*m8_7y + minus_vd8_y);
    phi[636] = -minus_vd8_y;
    phi[77] = -(vd8_z*minus_e8_1x + minus_U8_zy*m8_1z);
    MODELER_ZEROS(phi + 624, 6);
    const double minus_vd8_x = c7*minus_vd8a_x + s7*minus_vd8a_y;
    phi[557] = minus_vd8_x - (minus_U8_xy*m8_7x + minus_U8_yy*m8_7y);
    phi[637] = minus_vd8_x;
    phi[78] = -(minus_vd8_y*minus_e8_1x - minus_vd8_x*minus_e8_1y + ww1_zz*m8_1z);
    phi[558] = U8_yz*m8_7y - minus_U8_xz*m8_7x;
    phi[79] = vd8_z*m8_1z;
    phi[559] = -(minus_vd8_x*m8_7x + minus_vd8_y*m8_7y);
    MODELER_ZEROS(phi + 638, 2);
}
