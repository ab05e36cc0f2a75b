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

/* Regressor of the base parameters.
 * 340 additions, 454 multiplications. */
MODELER_CLONES
void sr400_tree_base_regressor(const double q[SR400_TREE_JOINTS],
                               const double qd[SR400_TREE_JOINTS],
                               const double qdd[SR400_TREE_JOINTS],
                               double MODELER_OUT(phi, 8 * 50))
{
    MODELER_ALL_ZEROS(phi, 400);

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

    phi[0] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    phi[1] = s1*minus_wd2_x + c1*minus_ww2_xz;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    phi[51] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    MODELER_ZEROS(phi + 5, 1);
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    phi[2] = c1*minus_U2_zy - s1*minus_U2_zx;
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    phi[52] = minus_U2_yy - minus_U2_xx;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    phi[3] = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    phi[53] = -U2_yz;
    MODELER_ZEROS(phi + 12, 1);
    phi[4] = -(s1*(ww1_zz - minus_U2_yy) + c1*(qdd[1] - ww2_xy));
    phi[54] = -minus_U2_xz;
    phi[55] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_tree_geo_D2*qdd[0];
    phi[6] = c1*vd2_z - sr400_tree_geo_D2*minus_U2_zx;
    const double minus_vd2a_x = sr400_tree_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_tree_geo_g*c1 - s1*minus_vd2a_x;
    phi[56] = -minus_vd2_y;
    phi[7] = -(s1*vd2_z + sr400_tree_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_tree_geo_g*s1;
    phi[57] = minus_vd2_x;
    MODELER_ZEROS(phi + 40, 1);
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = c2*minus_wd2_x + s2*minus_wd2_y + qd[2]*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double minus_e3_1x = s1*c2 + c1*s2;
    const double minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    const double w3_z = qd[1] + qd[2];
    const double minus_ww3_xz = minus_w3_x*w3_z;
    const double minus_e3_1y = c1*c2 - s1*s2;
    phi[8] = minus_wd3_x*minus_e3_1x + minus_ww3_xz*minus_e3_1y;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    phi[58] = -ww3_xy;
    phi[108] = -ww3_xy;
    MODELER_ZEROS(phi + 47, 1);
    const double minus_wd3_y = c2*minus_wd2_y - s2*minus_wd2_x - qd[2]*minus_w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    const double minus_ww3_yz = minus_w3_y*w3_z;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    phi[9] = U3_zx*minus_e3_1x + minus_U3_zy*minus_e3_1y;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    phi[59] = -minus_n3_XYz;
    phi[109] = -minus_n3_XYz;
    MODELER_ZEROS(phi + 50, 1);
    const double wd3_z = qdd[1] + qdd[2];
    const double U3_yx = wd3_z + ww3_xy;
    phi[10] = minus_e3_1y*(ww1_zz - minus_U3_xx) - U3_yx*minus_e3_1x;
    const double U3_yz = minus_wd3_x - minus_ww3_yz;
    phi[60] = -U3_yz;
    phi[110] = -U3_yz;
    const double minus_U3_xy = wd3_z - ww3_xy;
    phi[11] = -(minus_e3_1x*(ww1_zz - minus_U3_yy) + minus_U3_xy*minus_e3_1y);
    const double minus_U3_xz = minus_wd3_y + minus_ww3_xz;
    phi[61] = -minus_U3_xz;
    phi[111] = -minus_U3_xz;
    MODELER_ZEROS(phi + 86, 8);
    phi[62] = wd3_z;
    phi[112] = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_tree_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_tree_geo_D2 + sr400_tree_geo_D3*c1;
    phi[13] = vd3_z*minus_e3_1y + U3_zx*m3_1z;
    const double minus_vd3a_y = minus_vd2_y - sr400_tree_geo_D3*U2_yx;
    const double minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*minus_U2_xx;
    const double minus_vd3_y = c2*minus_vd3a_y - s2*minus_vd3a_x;
    const double m3_2x = sr400_tree_geo_D3*s2;
    const double m3_2y = sr400_tree_geo_D3*c2;
    phi[63] = -(minus_U3_xx*m3_2x - U3_yx*m3_2y + minus_vd3_y);
    phi[113] = -minus_vd3_y;
    MODELER_ZEROS(phi + 94, 8);
    phi[14] = -(vd3_z*minus_e3_1x + minus_U3_zy*m3_1z);
    const double minus_vd3_x = c2*minus_vd3a_x + s2*minus_vd3a_y;
    phi[64] = minus_vd3_x - (minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    phi[114] = minus_vd3_x;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*w3_z - s3*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*wd3_z + qd[3]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c3*minus_e3_1x;
    const double minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const double w4_z = qd[3] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s3*minus_e3_1x;
    MODELER_ZEROS(phi + 102, 6);
    const double t57 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    phi[15] = minus_wd4_x*minus_e4_1x - t57 + ww4_xy*minus_e3_1y;
    const double t59 = c3*minus_ww4_xz;
    const double t60 = s3*minus_wd4_x + t59;
    phi[65] = t60;
    phi[115] = t60;
    phi[165] = -ww4_xy;
    const double minus_wd4_y = c3*wd3_z - s3*minus_wd3_x - qd[3]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    MODELER_ZEROS(phi + 136, 8);
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    phi[16] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y + minus_e3_1y*minus_n4_XYz;
    const double t69 = s3*U4_zx + c3*minus_U4_zy;
    phi[66] = t69;
    phi[116] = t69;
    phi[166] = -minus_n4_XYz;
    const double wd4_z = qdd[3] - minus_wd3_y;
    MODELER_ZEROS(phi + 144, 8);
    const double U4_yx = wd4_z + ww4_xy;
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    phi[17] = U4_yz*minus_e3_1y - (U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy);
    const double t74 = s3*U4_yx - c3*minus_n4_XZy;
    phi[67] = -t74;
    phi[117] = -t74;
    phi[167] = -U4_yz;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    MODELER_ZEROS(phi + 152, 8);
    phi[18] = minus_U4_xz*minus_e3_1y - (minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y);
    const double t78 = s3*n4_YZx + c3*minus_U4_xy;
    phi[68] = -t78;
    phi[118] = -t78;
    phi[168] = -minus_U4_xz;
    phi[19] = t57 + minus_ww4_yz*minus_e4_1x - wd4_z*minus_e3_1y;
    const double t79 = t59 - s3*minus_ww4_yz;
    phi[69] = -t79;
    phi[119] = -t79;
    phi[169] = wd4_z;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_tree_geo_RL4*minus_U3_yy - sr400_tree_geo_D4*U3_yx +
        minus_vd3_y;
    MODELER_ZEROS(phi + 160, 5);
    const double vd4a_z = sr400_tree_geo_D4*U3_zx - sr400_tree_geo_RL4*minus_U3_zy + vd3_z;
    const double minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx + sr400_tree_geo_RL4*minus_U3_xy +
        minus_vd3_x;
    const double minus_vd4_y = c3*vd4a_z - s3*minus_vd4a_x;
    const double t84 = sr400_tree_geo_D4*minus_e3_1y - sr400_tree_geo_RL4*minus_e3_1x + m3_1z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s3*t84;
    const double minus_m4_1y = c3*t84;
    phi[20] = minus_vd4_z*e4_1y + minus_vd4_y*minus_e3_1y + (minus_U4_xx*minus_m4_1x -
        U4_yx*minus_m4_1y);
    const double t87 = c3*minus_vd4_z;
    const double t88 = sr400_tree_geo_RL4 - m3_2x;
    const double minus_m4_2x = c3*t88;
    const double m4_2y = s3*t88;
    const double m4_2z = sr400_tree_geo_D4 + m3_2y;
    MODELER_ZEROS(phi + 186, 8);
    phi[70] = minus_U4_xx*minus_m4_2x + U4_yx*m4_2y + U4_zx*m4_2z - t87;
    const double minus_m4_3x = sr400_tree_geo_RL4*c3;
    const double m4_3y = sr400_tree_geo_RL4*s3;
    phi[120] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_tree_geo_D4*U4_zx - t87;
    phi[170] = -minus_vd4_y;
    const double minus_vd4_x = c3*minus_vd4a_x + s3*vd4a_z;
    phi[21] = minus_vd4_z*minus_e4_1x - minus_vd4_x*minus_e3_1y + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    const double t95 = s3*minus_vd4_z;
    phi[71] = minus_U4_xy*minus_m4_2x - minus_U4_yy*m4_2y - minus_U4_zy*m4_2z + t95;
    phi[121] = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_tree_geo_D4*minus_U4_zy + t95;
    phi[171] = minus_vd4_x;
    MODELER_ZEROS(phi + 194, 8);
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_1x = c4*minus_e4_1x + s4*minus_e3_1y;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double minus_e5_1y = c4*minus_e3_1y - s4*minus_e4_1x;
    const double t103 = minus_ww5_xz*minus_e5_1y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    phi[22] = minus_wd5_x*minus_e5_1x + t103 - minus_ww5_xy*e4_1y;
    const double minus_e5_2x = s3*c4;
    MODELER_ZEROS(phi + 202, 8);
    const double e5_2y = s3*s4;
    const double t107 = minus_ww5_xz*e5_2y;
    const double t108 = minus_wd5_x*minus_e5_2x - t107 + c3*minus_ww5_xy;
    phi[72] = t108;
    phi[122] = t108;
    const double t109 = c4*minus_ww5_xz;
    phi[172] = -(s4*minus_wd5_x + t109);
    phi[222] = minus_ww5_xy;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    const double ww5_yz = w5_y*w5_z;
    MODELER_ZEROS(phi + 210, 8);
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    phi[23] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x - minus_U5_zy*minus_e5_1y);
    const double t118 = minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c3*minus_n5_XYz;
    phi[73] = -t118;
    phi[123] = -t118;
    phi[173] = s4*minus_U5_zx - c4*minus_U5_zy;
    phi[223] = -minus_n5_XYz;
    MODELER_ZEROS(phi + 218, 4);
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    phi[24] = U5_yz*e4_1y - (U5_yx*minus_e5_1x - minus_e5_1y*minus_n5_XZy);
    const double t123 = U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c3*U5_yz;
    phi[74] = -t123;
    phi[124] = -t123;
    phi[174] = s4*U5_yx - c4*minus_n5_XZy;
    phi[224] = -U5_yz;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    MODELER_ZEROS(phi + 236, 8);
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    phi[25] = -(minus_e5_1x*n5_YZx + minus_U5_xy*minus_e5_1y + U5_xz*e4_1y);
    const double t127 = minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y - c3*U5_xz;
    phi[75] = -t127;
    phi[125] = -t127;
    phi[175] = s4*n5_YZx + c4*minus_U5_xy;
    phi[225] = U5_xz;
    phi[26] = -(t103 + ww5_yz*minus_e5_1x + wd5_z*e4_1y);
    const double t128 = t107 - ww5_yz*minus_e5_2x + c3*wd5_z;
    phi[76] = t128;
    phi[126] = t128;
    MODELER_ZEROS(phi + 244, 8);
    phi[176] = t109 + s4*ww5_yz;
    phi[226] = wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c4*minus_m4_1x;
    const double m5_1y = s4*minus_m4_1x;
    phi[27] = minus_vd4_y*minus_e5_1y + minus_vd5_y*e4_1y + (minus_U5_xx*minus_m5_1x + U5_yx*m5_1y -
        minus_U5_zx*minus_m4_1y);
    const double t132 = minus_vd4_y*e5_2y + c3*minus_vd5_y;
    const double minus_m5_2x = c4*minus_m4_2x - s4*m4_2z;
    const double m5_2y = c4*m4_2z + s4*minus_m4_2x;
    phi[77] = minus_U5_xx*minus_m5_2x + U5_yx*m5_2y + minus_U5_zx*m4_2y - t132;
    const double minus_m5_3x = c4*minus_m4_3x - sr400_tree_geo_D4*s4;
    MODELER_ZEROS(phi + 252, 8);
    const double m5_3y = sr400_tree_geo_D4*c4 + s4*minus_m4_3x;
    phi[127] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - t132;
    phi[177] = -c4*minus_vd4_y;
    phi[227] = -minus_vd5_y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    phi[28] = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    const double t138 = minus_vd4_y*minus_e5_2x - c3*minus_vd5_x;
    phi[78] = minus_U5_xy*minus_m5_2x - minus_U5_yy*m5_2y + minus_U5_zy*m4_2y - t138;
    phi[128] = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y - t138;
    phi[178] = s4*minus_vd4_y;
    phi[228] = minus_vd5_x;
    MODELER_ZEROS(phi + 260, 8);
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
    const double t146 = minus_ww6_xz*e6_1y;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    phi[29] = minus_wd6_x*minus_e6_1x - t146 + ww6_xy*minus_e5_1y;
    const double minus_e6_2x = c5*minus_e5_2x + c3*s5;
    MODELER_ZEROS(phi + 268, 8);
    const double minus_e6_2y = c3*c5 - s5*minus_e5_2x;
    const double t150 = minus_ww6_xz*minus_e6_2y;
    const double t151 = minus_wd6_x*minus_e6_2x + t150 - ww6_xy*e5_2y;
    phi[79] = t151;
    phi[129] = t151;
    const double e6_4x = s4*c5;
    const double minus_e6_4y = s4*s5;
    const double t154 = minus_ww6_xz*minus_e6_4y;
    phi[179] = -(minus_wd6_x*e6_4x - t154 + c4*ww6_xy);
    const double t155 = c5*minus_ww6_xz;
    phi[229] = s5*minus_wd6_x + t155;
    MODELER_ZEROS(phi + 276, 3);
    phi[279] = -ww6_xy;
    const double minus_wd6_y = c5*wd5_z - s5*minus_wd5_x - qd[5]*minus_w6_x;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const double U6_zx = minus_wd6_y - minus_ww6_xz;
    const double minus_ww6_yz = minus_w6_y*w6_z;
    const double minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    const double ww6_zz = w6_z*w6_z;
    const double minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const double minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const double minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    phi[30] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y + minus_e5_1y*minus_n6_XYz;
    const double t164 = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    MODELER_ZEROS(phi + 286, 8);
    phi[80] = t164;
    phi[130] = t164;
    phi[180] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c4*minus_n6_XYz);
    phi[230] = s5*U6_zx + c5*minus_U6_zy;
    phi[280] = -minus_n6_XYz;
    const double wd6_z = qdd[5] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    phi[31] = U6_yz*minus_e5_1y - (U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy);
    const double t169 = U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y;
    phi[81] = -t169;
    MODELER_ZEROS(phi + 294, 8);
    phi[131] = -t169;
    phi[181] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c4*U6_yz;
    phi[231] = c5*minus_n6_XZy - s5*U6_yx;
    phi[281] = -U6_yz;
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    phi[32] = minus_U6_xz*minus_e5_1y - (minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y);
    const double t173 = minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y;
    phi[82] = -t173;
    phi[132] = -t173;
    MODELER_ZEROS(phi + 302, 8);
    phi[182] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c4*minus_U6_xz;
    phi[232] = -(s5*n6_YZx + c5*minus_U6_xy);
    phi[282] = -minus_U6_xz;
    phi[33] = t146 + minus_ww6_yz*minus_e6_1x - wd6_z*minus_e5_1y;
    const double t174 = t150 - minus_ww6_yz*minus_e6_2x - wd6_z*e5_2y;
    phi[83] = -t174;
    phi[133] = -t174;
    phi[183] = c4*wd6_z - (t154 + minus_ww6_yz*e6_4x);
    phi[233] = s5*minus_ww6_yz - t155;
    phi[283] = wd6_z;
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c5*minus_vd4_y - s5*minus_vd5_x;
    MODELER_ZEROS(phi + 310, 8);
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c5*minus_m5_1x + s5*minus_m4_1y;
    const double minus_m6_1y = c5*minus_m4_1y - s5*minus_m5_1x;
    phi[34] = minus_vd5_y*e6_1y + minus_vd6_y*minus_e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const double t178 = minus_vd5_y*minus_e6_2y + minus_vd6_y*e5_2y;
    const double minus_m6_2x = c5*minus_m5_2x - s5*m4_2y;
    const double m6_2y = c5*m4_2y + s5*minus_m5_2x;
    phi[84] = minus_U6_xx*minus_m6_2x + U6_yx*m6_2y + U6_zx*m5_2y - t178;
    const double minus_m6_3x = c5*minus_m5_3x - s5*m4_3y;
    const double m6_3y = c5*m4_3y + s5*minus_m5_3x;
    phi[134] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - t178;
    phi[184] = -(minus_vd5_y*minus_e6_4y + c4*minus_vd6_y);
    MODELER_ZEROS(phi + 318, 8);
    phi[234] = -c5*minus_vd5_y;
    phi[284] = -minus_vd6_y;
    const double minus_vd6_x = c5*minus_vd5_x + s5*minus_vd4_y;
    phi[35] = minus_vd5_y*minus_e6_1x - minus_vd6_x*minus_e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    const double t184 = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y;
    phi[85] = minus_U6_xy*minus_m6_2x - minus_U6_yy*m6_2y - minus_U6_zy*m5_2y + t184;
    phi[135] = minus_U6_xy*minus_m6_3x - minus_U6_yy*m6_3y - minus_U6_zy*m5_3y + t184;
    phi[185] = c4*minus_vd6_x - minus_vd5_y*e6_4x;
    phi[235] = s5*minus_vd5_y;
    phi[285] = minus_vd6_x;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double U7_yz = s6*qdd[0];
    MODELER_ZEROS(phi + 326, 8);
    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const double minus_w7_y = c6*qd[0];
    const double minus_ww7_yz = qd[6]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd1 + (R7' w1) x qd7 z + qdd7 z */
    const double minus_wd7_x = U7_yz + minus_ww7_yz;
    const double minus_w7_x = s6*qd[0];
    const double minus_ww7_xz = qd[6]*minus_w7_x;
    phi[36] = s6*minus_wd7_x + c6*minus_ww7_xz;
    const double ww7_xy = minus_w7_x*minus_w7_y;
    phi[336] = -ww7_xy;
    const double minus_U7_xz = c6*qdd[0];
    const double minus_wd7_y = minus_U7_xz - minus_ww7_xz;
    const double minus_U7_zx = minus_ww7_xz - minus_wd7_y;
    MODELER_ZEROS(phi + 334, 2);
    const double minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    phi[37] = c6*minus_U7_zy - s6*minus_U7_zx;
    const double ww7_zz = qd[6]*qd[6];
    const double minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const double minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    phi[337] = minus_U7_yy - minus_U7_xx;
    const double U7_yx = qdd[6] + ww7_xy;
    phi[38] = c6*(ww1_zz - minus_U7_xx) - s6*U7_yx;
    phi[338] = -U7_yz;
    phi[39] = -(s6*(ww1_zz - minus_U7_yy) + c6*(qdd[6] - ww7_xy));
    phi[339] = -minus_U7_xz;
    phi[340] = qdd[6];
    MODELER_ZEROS(phi + 350, 8);
    phi[41] = c6*vd2_z - sr400_tree_geo_D2*minus_U7_zx;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_tree_geo_g*c6 - s6*minus_vd2a_x;
    phi[341] = -minus_vd7_y;
    phi[42] = -(s6*vd2_z + sr400_tree_geo_D2*minus_U7_zy);
    const double minus_vd7_x = c6*minus_vd2a_x + sr400_tree_geo_g*s6;
    phi[342] = minus_vd7_x;
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const double minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    /* link 8: angular acceleration, wd8 = R8' wd7 + (R8' w7) x qd8 z + qdd8 z */
    const double minus_wd8_x = c7*minus_wd7_x + s7*minus_wd7_y + qd[7]*minus_w8_y;
    /* link 8: axes of the joints below, for unit speed of each, e8 = R8' e7 */
    const double minus_e8_1x = s6*c7 + c6*s7;
    const double minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const double w8_z = qd[6] + qd[7];
    MODELER_ZEROS(phi + 358, 8);
    const double minus_ww8_xz = minus_w8_x*w8_z;
    const double minus_e8_1y = c6*c7 - s6*s7;
    phi[43] = minus_wd8_x*minus_e8_1x + minus_ww8_xz*minus_e8_1y;
    const double ww8_xy = minus_w8_x*minus_w8_y;
    phi[343] = -ww8_xy;
    phi[393] = -ww8_xy;
    const double minus_wd8_y = c7*minus_wd7_y - s7*minus_wd7_x - qd[7]*minus_w8_x;
    /* link 8: acceleration of points of the link, U8 = [wd8 x] + [w8 x][w8 x] */
    const double U8_zx = minus_wd8_y - minus_ww8_xz;
    const double minus_ww8_yz = minus_w8_y*w8_z;
    const double minus_U8_zy = minus_wd8_x + minus_ww8_yz;
    phi[44] = U8_zx*minus_e8_1x + minus_U8_zy*minus_e8_1y;
    MODELER_ZEROS(phi + 366, 8);
    const double ww8_zz = w8_z*w8_z;
    const double minus_U8_xx = minus_w8_y*minus_w8_y + ww8_zz;
    const double minus_U8_yy = minus_w8_x*minus_w8_x + ww8_zz;
    /* link 8: moment on the link at its origin for one unit of a parameter, n8 = J8 wd8 + w8 x J8
        w8 + MS8 x vd8 */
    const double minus_n8_XYz = minus_U8_xx - minus_U8_yy;
    phi[344] = -minus_n8_XYz;
    phi[394] = -minus_n8_XYz;
    const double wd8_z = qdd[6] + qdd[7];
    const double U8_yx = wd8_z + ww8_xy;
    phi[45] = minus_e8_1y*(ww1_zz - minus_U8_xx) - U8_yx*minus_e8_1x;
    const double U8_yz = minus_wd8_x - minus_ww8_yz;
    phi[345] = -U8_yz;
    MODELER_ZEROS(phi + 374, 8);
    phi[395] = -U8_yz;
    const double minus_U8_xy = wd8_z - ww8_xy;
    phi[46] = -(minus_e8_1x*(ww1_zz - minus_U8_yy) + minus_U8_xy*minus_e8_1y);
    const double minus_U8_xz = minus_wd8_y + minus_ww8_xz;
    phi[346] = -minus_U8_xz;
    phi[396] = -minus_U8_xz;
    phi[347] = wd8_z;
    phi[397] = wd8_z;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double vd8_z = vd2_z - sr400_tree_geo_D8*minus_U7_zx;
    /* link 8: velocity of the origin, for unit speed of each joint below, m8 = R8' (m7 + e7 x p8)
        */
    const double m8_1z = sr400_tree_geo_D2 + sr400_tree_geo_D8*c6;
    phi[48] = vd8_z*minus_e8_1y + U8_zx*m8_1z;
    MODELER_ZEROS(phi + 382, 8);
    const double minus_vd8a_y = minus_vd7_y - sr400_tree_geo_D8*U7_yx;
    const double minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*minus_U7_xx;
    const double minus_vd8_y = c7*minus_vd8a_y - s7*minus_vd8a_x;
    const double m8_7x = sr400_tree_geo_D8*s7;
    const double m8_7y = sr400_tree_geo_D8*c7;
    phi[348] = -(minus_U8_xx*m8_7x - U8_yx*m8_7y + minus_vd8_y);
    phi[398] = -minus_vd8_y;
    phi[49] = -(vd8_z*minus_e8_1x + minus_U8_zy*m8_1z);
    const double minus_vd8_x = c7*minus_vd8a_x + s7*minus_vd8a_y;
    phi[349] = minus_vd8_x - (minus_U8_xy*m8_7x + minus_U8_yy*m8_7y);
    phi[399] = minus_vd8_x;
    MODELER_ZEROS(phi + 390, 3);
}

/* The entries of the base regressor that are not always 0.
 * 340 additions, 454 multiplications. */
MODELER_CLONES
void sr400_tree_base_regressor_nonzeros(const double q[SR400_TREE_JOINTS],
                                        const double qd[SR400_TREE_JOINTS],
                                        const double qdd[SR400_TREE_JOINTS],
                                        double MODELER_OUT(values, 172))
{
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

    values[0] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    values[1] = s1*minus_wd2_x + c1*minus_ww2_xz;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    values[46] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    values[2] = c1*minus_U2_zy - s1*minus_U2_zx;
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    values[47] = minus_U2_yy - minus_U2_xx;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    values[3] = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    values[48] = -U2_yz;
    values[4] = -(s1*(ww1_zz - minus_U2_yy) + c1*(qdd[1] - ww2_xy));
    values[49] = -minus_U2_xz;
    values[50] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_tree_geo_D2*qdd[0];
    values[5] = c1*vd2_z - sr400_tree_geo_D2*minus_U2_zx;
    const double minus_vd2a_x = sr400_tree_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_tree_geo_g*c1 - s1*minus_vd2a_x;
    values[51] = -minus_vd2_y;
    values[6] = -(s1*vd2_z + sr400_tree_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_tree_geo_g*s1;
    values[52] = minus_vd2_x;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = c2*minus_wd2_x + s2*minus_wd2_y + qd[2]*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double minus_e3_1x = s1*c2 + c1*s2;
    const double minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    const double w3_z = qd[1] + qd[2];
    const double minus_ww3_xz = minus_w3_x*w3_z;
    const double minus_e3_1y = c1*c2 - s1*s2;
    values[7] = minus_wd3_x*minus_e3_1x + minus_ww3_xz*minus_e3_1y;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    values[53] = -ww3_xy;
    values[81] = -ww3_xy;
    const double minus_wd3_y = c2*minus_wd2_y - s2*minus_wd2_x - qd[2]*minus_w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    const double minus_ww3_yz = minus_w3_y*w3_z;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    values[8] = U3_zx*minus_e3_1x + minus_U3_zy*minus_e3_1y;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    values[54] = -minus_n3_XYz;
    values[82] = -minus_n3_XYz;
    const double wd3_z = qdd[1] + qdd[2];
    const double U3_yx = wd3_z + ww3_xy;
    values[9] = minus_e3_1y*(ww1_zz - minus_U3_xx) - U3_yx*minus_e3_1x;
    const double U3_yz = minus_wd3_x - minus_ww3_yz;
    values[55] = -U3_yz;
    values[83] = -U3_yz;
    const double minus_U3_xy = wd3_z - ww3_xy;
    values[10] = -(minus_e3_1x*(ww1_zz - minus_U3_yy) + minus_U3_xy*minus_e3_1y);
    const double minus_U3_xz = minus_wd3_y + minus_ww3_xz;
    values[56] = -minus_U3_xz;
    values[84] = -minus_U3_xz;
    values[57] = wd3_z;
    values[85] = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_tree_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_tree_geo_D2 + sr400_tree_geo_D3*c1;
    values[11] = vd3_z*minus_e3_1y + U3_zx*m3_1z;
    const double minus_vd3a_y = minus_vd2_y - sr400_tree_geo_D3*U2_yx;
    const double minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*minus_U2_xx;
    const double minus_vd3_y = c2*minus_vd3a_y - s2*minus_vd3a_x;
    const double m3_2x = sr400_tree_geo_D3*s2;
    const double m3_2y = sr400_tree_geo_D3*c2;
    values[58] = -(minus_U3_xx*m3_2x - U3_yx*m3_2y + minus_vd3_y);
    values[86] = -minus_vd3_y;
    values[12] = -(vd3_z*minus_e3_1x + minus_U3_zy*m3_1z);
    const double minus_vd3_x = c2*minus_vd3a_x + s2*minus_vd3a_y;
    values[59] = minus_vd3_x - (minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    values[87] = minus_vd3_x;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*w3_z - s3*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*wd3_z + qd[3]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c3*minus_e3_1x;
    const double minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const double w4_z = qd[3] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s3*minus_e3_1x;
    const double t57 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    values[13] = minus_wd4_x*minus_e4_1x - t57 + ww4_xy*minus_e3_1y;
    const double t59 = c3*minus_ww4_xz;
    const double t60 = s3*minus_wd4_x + t59;
    values[60] = t60;
    values[88] = t60;
    values[109] = -ww4_xy;
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
    values[14] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y + minus_e3_1y*minus_n4_XYz;
    const double t69 = s3*U4_zx + c3*minus_U4_zy;
    values[61] = t69;
    values[89] = t69;
    values[110] = -minus_n4_XYz;
    const double wd4_z = qdd[3] - minus_wd3_y;
    const double U4_yx = wd4_z + ww4_xy;
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    values[15] = U4_yz*minus_e3_1y - (U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy);
    const double t74 = s3*U4_yx - c3*minus_n4_XZy;
    values[62] = -t74;
    values[90] = -t74;
    values[111] = -U4_yz;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    values[16] = minus_U4_xz*minus_e3_1y - (minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y);
    const double t78 = s3*n4_YZx + c3*minus_U4_xy;
    values[63] = -t78;
    values[91] = -t78;
    values[112] = -minus_U4_xz;
    values[17] = t57 + minus_ww4_yz*minus_e4_1x - wd4_z*minus_e3_1y;
    const double t79 = t59 - s3*minus_ww4_yz;
    values[64] = -t79;
    values[92] = -t79;
    values[113] = wd4_z;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_tree_geo_RL4*minus_U3_yy - sr400_tree_geo_D4*U3_yx +
        minus_vd3_y;
    const double vd4a_z = sr400_tree_geo_D4*U3_zx - sr400_tree_geo_RL4*minus_U3_zy + vd3_z;
    const double minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx + sr400_tree_geo_RL4*minus_U3_xy +
        minus_vd3_x;
    const double minus_vd4_y = c3*vd4a_z - s3*minus_vd4a_x;
    const double t84 = sr400_tree_geo_D4*minus_e3_1y - sr400_tree_geo_RL4*minus_e3_1x + m3_1z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s3*t84;
    const double minus_m4_1y = c3*t84;
    values[18] = minus_vd4_z*e4_1y + minus_vd4_y*minus_e3_1y + (minus_U4_xx*minus_m4_1x -
        U4_yx*minus_m4_1y);
    const double t87 = c3*minus_vd4_z;
    const double t88 = sr400_tree_geo_RL4 - m3_2x;
    const double minus_m4_2x = c3*t88;
    const double m4_2y = s3*t88;
    const double m4_2z = sr400_tree_geo_D4 + m3_2y;
    values[65] = minus_U4_xx*minus_m4_2x + U4_yx*m4_2y + U4_zx*m4_2z - t87;
    const double minus_m4_3x = sr400_tree_geo_RL4*c3;
    const double m4_3y = sr400_tree_geo_RL4*s3;
    values[93] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_tree_geo_D4*U4_zx - t87;
    values[114] = -minus_vd4_y;
    const double minus_vd4_x = c3*minus_vd4a_x + s3*vd4a_z;
    values[19] = minus_vd4_z*minus_e4_1x - minus_vd4_x*minus_e3_1y + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    const double t95 = s3*minus_vd4_z;
    values[66] = minus_U4_xy*minus_m4_2x - minus_U4_yy*m4_2y - minus_U4_zy*m4_2z + t95;
    values[94] = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_tree_geo_D4*minus_U4_zy + t95;
    values[115] = minus_vd4_x;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_1x = c4*minus_e4_1x + s4*minus_e3_1y;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double minus_e5_1y = c4*minus_e3_1y - s4*minus_e4_1x;
    const double t103 = minus_ww5_xz*minus_e5_1y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    values[20] = minus_wd5_x*minus_e5_1x + t103 - minus_ww5_xy*e4_1y;
    const double minus_e5_2x = s3*c4;
    const double e5_2y = s3*s4;
    const double t107 = minus_ww5_xz*e5_2y;
    const double t108 = minus_wd5_x*minus_e5_2x - t107 + c3*minus_ww5_xy;
    values[67] = t108;
    values[95] = t108;
    const double t109 = c4*minus_ww5_xz;
    values[116] = -(s4*minus_wd5_x + t109);
    values[130] = minus_ww5_xy;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    const double ww5_yz = w5_y*w5_z;
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    values[21] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x - minus_U5_zy*minus_e5_1y);
    const double t118 = minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c3*minus_n5_XYz;
    values[68] = -t118;
    values[96] = -t118;
    values[117] = s4*minus_U5_zx - c4*minus_U5_zy;
    values[131] = -minus_n5_XYz;
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    values[22] = U5_yz*e4_1y - (U5_yx*minus_e5_1x - minus_e5_1y*minus_n5_XZy);
    const double t123 = U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c3*U5_yz;
    values[69] = -t123;
    values[97] = -t123;
    values[118] = s4*U5_yx - c4*minus_n5_XZy;
    values[132] = -U5_yz;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    values[23] = -(minus_e5_1x*n5_YZx + minus_U5_xy*minus_e5_1y + U5_xz*e4_1y);
    const double t127 = minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y - c3*U5_xz;
    values[70] = -t127;
    values[98] = -t127;
    values[119] = s4*n5_YZx + c4*minus_U5_xy;
    values[133] = U5_xz;
    values[24] = -(t103 + ww5_yz*minus_e5_1x + wd5_z*e4_1y);
    const double t128 = t107 - ww5_yz*minus_e5_2x + c3*wd5_z;
    values[71] = t128;
    values[99] = t128;
    values[120] = t109 + s4*ww5_yz;
    values[134] = wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c4*minus_m4_1x;
    const double m5_1y = s4*minus_m4_1x;
    values[25] = minus_vd4_y*minus_e5_1y + minus_vd5_y*e4_1y + (minus_U5_xx*minus_m5_1x +
        U5_yx*m5_1y - minus_U5_zx*minus_m4_1y);
    const double t132 = minus_vd4_y*e5_2y + c3*minus_vd5_y;
    const double minus_m5_2x = c4*minus_m4_2x - s4*m4_2z;
    const double m5_2y = c4*m4_2z + s4*minus_m4_2x;
    values[72] = minus_U5_xx*minus_m5_2x + U5_yx*m5_2y + minus_U5_zx*m4_2y - t132;
    const double minus_m5_3x = c4*minus_m4_3x - sr400_tree_geo_D4*s4;
    const double m5_3y = sr400_tree_geo_D4*c4 + s4*minus_m4_3x;
    values[100] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - t132;
    values[121] = -c4*minus_vd4_y;
    values[135] = -minus_vd5_y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    values[26] = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    const double t138 = minus_vd4_y*minus_e5_2x - c3*minus_vd5_x;
    values[73] = minus_U5_xy*minus_m5_2x - minus_U5_yy*m5_2y + minus_U5_zy*m4_2y - t138;
    values[101] = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y - t138;
    values[122] = s4*minus_vd4_y;
    values[136] = minus_vd5_x;
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
    const double t146 = minus_ww6_xz*e6_1y;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    values[27] = minus_wd6_x*minus_e6_1x - t146 + ww6_xy*minus_e5_1y;
    const double minus_e6_2x = c5*minus_e5_2x + c3*s5;
    const double minus_e6_2y = c3*c5 - s5*minus_e5_2x;
    const double t150 = minus_ww6_xz*minus_e6_2y;
    const double t151 = minus_wd6_x*minus_e6_2x + t150 - ww6_xy*e5_2y;
    values[74] = t151;
    values[102] = t151;
    const double e6_4x = s4*c5;
    const double minus_e6_4y = s4*s5;
    const double t154 = minus_ww6_xz*minus_e6_4y;
    values[123] = -(minus_wd6_x*e6_4x - t154 + c4*ww6_xy);
    const double t155 = c5*minus_ww6_xz;
    values[137] = s5*minus_wd6_x + t155;
    values[144] = -ww6_xy;
    const double minus_wd6_y = c5*wd5_z - s5*minus_wd5_x - qd[5]*minus_w6_x;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const double U6_zx = minus_wd6_y - minus_ww6_xz;
    const double minus_ww6_yz = minus_w6_y*w6_z;
    const double minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    const double ww6_zz = w6_z*w6_z;
    const double minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const double minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const double minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    values[28] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y + minus_e5_1y*minus_n6_XYz;
    const double t164 = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    values[75] = t164;
    values[103] = t164;
    values[124] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c4*minus_n6_XYz);
    values[138] = s5*U6_zx + c5*minus_U6_zy;
    values[145] = -minus_n6_XYz;
    const double wd6_z = qdd[5] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    values[29] = U6_yz*minus_e5_1y - (U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy);
    const double t169 = U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y;
    values[76] = -t169;
    values[104] = -t169;
    values[125] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c4*U6_yz;
    values[139] = c5*minus_n6_XZy - s5*U6_yx;
    values[146] = -U6_yz;
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    values[30] = minus_U6_xz*minus_e5_1y - (minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y);
    const double t173 = minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y;
    values[77] = -t173;
    values[105] = -t173;
    values[126] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c4*minus_U6_xz;
    values[140] = -(s5*n6_YZx + c5*minus_U6_xy);
    values[147] = -minus_U6_xz;
    values[31] = t146 + minus_ww6_yz*minus_e6_1x - wd6_z*minus_e5_1y;
    const double t174 = t150 - minus_ww6_yz*minus_e6_2x - wd6_z*e5_2y;
    values[78] = -t174;
    values[106] = -t174;
    values[127] = c4*wd6_z - (t154 + minus_ww6_yz*e6_4x);
    values[141] = s5*minus_ww6_yz - t155;
    values[148] = wd6_z;
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c5*minus_vd4_y - s5*minus_vd5_x;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c5*minus_m5_1x + s5*minus_m4_1y;
    const double minus_m6_1y = c5*minus_m4_1y - s5*minus_m5_1x;
    values[32] = minus_vd5_y*e6_1y + minus_vd6_y*minus_e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const double t178 = minus_vd5_y*minus_e6_2y + minus_vd6_y*e5_2y;
    const double minus_m6_2x = c5*minus_m5_2x - s5*m4_2y;
    const double m6_2y = c5*m4_2y + s5*minus_m5_2x;
    values[79] = minus_U6_xx*minus_m6_2x + U6_yx*m6_2y + U6_zx*m5_2y - t178;
    const double minus_m6_3x = c5*minus_m5_3x - s5*m4_3y;
    const double m6_3y = c5*m4_3y + s5*minus_m5_3x;
    values[107] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - t178;
    values[128] = -(minus_vd5_y*minus_e6_4y + c4*minus_vd6_y);
    values[142] = -c5*minus_vd5_y;
    values[149] = -minus_vd6_y;
    const double minus_vd6_x = c5*minus_vd5_x + s5*minus_vd4_y;
    values[33] = minus_vd5_y*minus_e6_1x - minus_vd6_x*minus_e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    const double t184 = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y;
    values[80] = minus_U6_xy*minus_m6_2x - minus_U6_yy*m6_2y - minus_U6_zy*m5_2y + t184;
    values[108] = minus_U6_xy*minus_m6_3x - minus_U6_yy*m6_3y - minus_U6_zy*m5_3y + t184;
    values[129] = c4*minus_vd6_x - minus_vd5_y*e6_4x;
    values[143] = s5*minus_vd5_y;
    values[150] = minus_vd6_x;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double U7_yz = s6*qdd[0];
    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const double minus_w7_y = c6*qd[0];
    const double minus_ww7_yz = qd[6]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd1 + (R7' w1) x qd7 z + qdd7 z */
    const double minus_wd7_x = U7_yz + minus_ww7_yz;
    const double minus_w7_x = s6*qd[0];
    const double minus_ww7_xz = qd[6]*minus_w7_x;
    values[34] = s6*minus_wd7_x + c6*minus_ww7_xz;
    const double ww7_xy = minus_w7_x*minus_w7_y;
    values[151] = -ww7_xy;
    const double minus_U7_xz = c6*qdd[0];
    const double minus_wd7_y = minus_U7_xz - minus_ww7_xz;
    const double minus_U7_zx = minus_ww7_xz - minus_wd7_y;
    const double minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    values[35] = c6*minus_U7_zy - s6*minus_U7_zx;
    const double ww7_zz = qd[6]*qd[6];
    const double minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const double minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    values[152] = minus_U7_yy - minus_U7_xx;
    const double U7_yx = qdd[6] + ww7_xy;
    values[36] = c6*(ww1_zz - minus_U7_xx) - s6*U7_yx;
    values[153] = -U7_yz;
    values[37] = -(s6*(ww1_zz - minus_U7_yy) + c6*(qdd[6] - ww7_xy));
    values[154] = -minus_U7_xz;
    values[155] = qdd[6];
    values[38] = c6*vd2_z - sr400_tree_geo_D2*minus_U7_zx;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_tree_geo_g*c6 - s6*minus_vd2a_x;
    values[156] = -minus_vd7_y;
    values[39] = -(s6*vd2_z + sr400_tree_geo_D2*minus_U7_zy);
    const double minus_vd7_x = c6*minus_vd2a_x + sr400_tree_geo_g*s6;
    values[157] = minus_vd7_x;
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const double minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    /* link 8: angular acceleration, wd8 = R8' wd7 + (R8' w7) x qd8 z + qdd8 z */
    const double minus_wd8_x = c7*minus_wd7_x + s7*minus_wd7_y + qd[7]*minus_w8_y;
    /* link 8: axes of the joints below, for unit speed of each, e8 = R8' e7 */
    const double minus_e8_1x = s6*c7 + c6*s7;
    const double minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const double w8_z = qd[6] + qd[7];
    const double minus_ww8_xz = minus_w8_x*w8_z;
    const double minus_e8_1y = c6*c7 - s6*s7;
    values[40] = minus_wd8_x*minus_e8_1x + minus_ww8_xz*minus_e8_1y;
    const double ww8_xy = minus_w8_x*minus_w8_y;
    values[158] = -ww8_xy;
    values[165] = -ww8_xy;
    const double minus_wd8_y = c7*minus_wd7_y - s7*minus_wd7_x - qd[7]*minus_w8_x;
    /* link 8: acceleration of points of the link, U8 = [wd8 x] + [w8 x][w8 x] */
    const double U8_zx = minus_wd8_y - minus_ww8_xz;
    const double minus_ww8_yz = minus_w8_y*w8_z;
    const double minus_U8_zy = minus_wd8_x + minus_ww8_yz;
    values[41] = U8_zx*minus_e8_1x + minus_U8_zy*minus_e8_1y;
    const double ww8_zz = w8_z*w8_z;
    const double minus_U8_xx = minus_w8_y*minus_w8_y + ww8_zz;
    const double minus_U8_yy = minus_w8_x*minus_w8_x + ww8_zz;
    /* link 8: moment on the link at its origin for one unit of a parameter, n8 = J8 wd8 + w8 x J8
        w8 + MS8 x vd8 */
    const double minus_n8_XYz = minus_U8_xx - minus_U8_yy;
    values[159] = -minus_n8_XYz;
    values[166] = -minus_n8_XYz;
    const double wd8_z = qdd[6] + qdd[7];
    const double U8_yx = wd8_z + ww8_xy;
    values[42] = minus_e8_1y*(ww1_zz - minus_U8_xx) - U8_yx*minus_e8_1x;
    const double U8_yz = minus_wd8_x - minus_ww8_yz;
    values[160] = -U8_yz;
    values[167] = -U8_yz;
    const double minus_U8_xy = wd8_z - ww8_xy;
    values[43] = -(minus_e8_1x*(ww1_zz - minus_U8_yy) + minus_U8_xy*minus_e8_1y);
    const double minus_U8_xz = minus_wd8_y + minus_ww8_xz;
    values[161] = -minus_U8_xz;
    values[168] = -minus_U8_xz;
    values[162] = wd8_z;
    values[169] = wd8_z;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double vd8_z = vd2_z - sr400_tree_geo_D8*minus_U7_zx;
    /* link 8: velocity of the origin, for unit speed of each joint below, m8 = R8' (m7 + e7 x p8)
        */
    const double m8_1z = sr400_tree_geo_D2 + sr400_tree_geo_D8*c6;
    values[44] = vd8_z*minus_e8_1y + U8_zx*m8_1z;
    const double minus_vd8a_y = minus_vd7_y - sr400_tree_geo_D8*U7_yx;
    const double minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*minus_U7_xx;
    const double minus_vd8_y = c7*minus_vd8a_y - s7*minus_vd8a_x;
    const double m8_7x = sr400_tree_geo_D8*s7;
    const double m8_7y = sr400_tree_geo_D8*c7;
    values[163] = -(minus_U8_xx*m8_7x - U8_yx*m8_7y + minus_vd8_y);
    values[170] = -minus_vd8_y;
    values[45] = -(vd8_z*minus_e8_1x + minus_U8_zy*m8_1z);
    const double minus_vd8_x = c7*minus_vd8a_x + s7*minus_vd8a_y;
    values[164] = minus_vd8_x - (minus_U8_xy*m8_7x + minus_U8_yy*m8_7y);
    values[171] = minus_vd8_x;
}
