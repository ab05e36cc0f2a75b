/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree.h.
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
#include "orthoglide_leg_tree.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_LEG_TREE_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_LEG_TREE_GEO_g
#define ORTHOGLIDE_LEG_TREE_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_D4
#define ORTHOGLIDE_LEG_TREE_GEO_D4 0.31
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b3
#define ORTHOGLIDE_LEG_TREE_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b7
#define ORTHOGLIDE_LEG_TREE_GEO_b7 0.04
#endif

static const double orthoglide_leg_tree_geo_g = ORTHOGLIDE_LEG_TREE_GEO_g;
static const double orthoglide_leg_tree_geo_D4 = ORTHOGLIDE_LEG_TREE_GEO_D4;

/* Regressor of the base parameters.
 * 140 additions, 202 multiplications. */
MODELER_CLONES
void orthoglide_leg_tree_base_regressor(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        double MODELER_OUT(phi, 6 * 32))
{
    MODELER_ALL_ZEROS(phi, 192);

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

    phi[0] = qdd[0];
    phi[33] = qdd[1];
    const double ww2_zz = qd[1]*qd[1];
    phi[2] = s1*ww2_zz - c1*qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = c1*qdd[0];
    phi[34] = -minus_vd2_y;
    phi[3] = s1*qdd[1] + c1*ww2_zz;
    const double minus_vd2_x = s1*qdd[0];
    phi[35] = minus_vd2_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_yz = s2*qdd[1];
    MODELER_ZEROS(phi + 1, 1);
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1];
    const double minus_ww3_yz = qd[2]*minus_w3_y;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = U3_yz + minus_ww3_yz;
    const double minus_w3_x = s2*qd[1];
    const double minus_ww3_xz = qd[2]*minus_w3_x;
    phi[36] = s2*minus_wd3_x + c2*minus_ww3_xz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    phi[68] = -ww3_xy;
    const double minus_U3_xz = c2*qdd[1];
    MODELER_ZEROS(phi + 4, 5);
    const double minus_wd3_y = minus_U3_xz - minus_ww3_xz;
    const double minus_U3_zx = minus_ww3_xz - minus_wd3_y;
    const double minus_U3_zy = minus_ww3_yz + minus_wd3_x;
    phi[37] = c2*minus_U3_zy - s2*minus_U3_zx;
    const double ww3_zz = qd[2]*qd[2];
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    phi[69] = minus_U3_yy - minus_U3_xx;
    const double U3_yx = qdd[2] + ww3_xy;
    phi[38] = c2*(ww2_zz - minus_U3_xx) - s2*U3_yx;
    MODELER_ZEROS(phi + 11, 5);
    phi[70] = -U3_yz;
    const double minus_U3_xy = qdd[2] - ww3_xy;
    phi[39] = -(s2*(ww2_zz - minus_U3_yy) + c2*minus_U3_xy);
    phi[71] = -minus_U3_xz;
    phi[72] = qdd[2];
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double minus_m3_1x = s1*c2;
    const double m3_1y = s1*s2;
    phi[9] = minus_U3_xx*minus_m3_1x + U3_yx*m3_1y + c1*minus_U3_zx;
    phi[41] = -c2*minus_vd2_y;
    MODELER_ZEROS(phi + 18, 5);
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_y = orthoglide_leg_tree_geo_g*c2 + s2*minus_vd2_x;
    phi[73] = vd3_y;
    phi[10] = minus_U3_xy*minus_m3_1x - minus_U3_yy*m3_1y + c1*minus_U3_zy;
    phi[42] = s2*minus_vd2_y;
    const double minus_vd3_x = c2*minus_vd2_x - orthoglide_leg_tree_geo_g*s2;
    phi[74] = minus_vd3_x;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*minus_w3_y - s3*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*minus_wd3_y + qd[3]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_2x = s2*c3 + c2*s3;
    const double minus_w4_x = c3*minus_w3_x + s3*minus_w3_y;
    MODELER_ZEROS(phi + 25, 5);
    const double w4_z = qd[2] + qd[3];
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double minus_e4_2y = c2*c3 - s2*s3;
    phi[43] = minus_wd4_x*minus_e4_2x + minus_ww4_xz*minus_e4_2y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    phi[75] = -ww4_xy;
    phi[107] = -ww4_xy;
    const double minus_wd4_y = c3*minus_wd3_y - s3*minus_wd3_x - qd[3]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    MODELER_ZEROS(phi + 32, 1);
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    phi[44] = U4_zx*minus_e4_2x + minus_U4_zy*minus_e4_2y;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    phi[76] = -minus_n4_XYz;
    phi[108] = -minus_n4_XYz;
    const double wd4_z = qdd[2] + qdd[3];
    MODELER_ZEROS(phi + 40, 1);
    const double U4_yx = wd4_z + ww4_xy;
    phi[45] = minus_e4_2y*(ww2_zz - minus_U4_xx) - U4_yx*minus_e4_2x;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    phi[77] = -U4_yz;
    phi[109] = -U4_yz;
    const double minus_U4_xy = wd4_z - ww4_xy;
    phi[46] = -(minus_e4_2x*(ww2_zz - minus_U4_yy) + minus_U4_xy*minus_e4_2y);
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    phi[78] = -minus_U4_xz;
    MODELER_ZEROS(phi + 47, 1);
    phi[110] = -minus_U4_xz;
    phi[79] = wd4_z;
    phi[111] = wd4_z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = c3*minus_m3_1x - s3*m3_1y;
    const double m4_1y = c3*m3_1y + s3*minus_m3_1x;
    phi[16] = minus_U4_xx*minus_m4_1x + U4_yx*m4_1y - c1*U4_zx;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = minus_vd2_y + orthoglide_leg_tree_geo_D4*minus_U3_zx;
    const double m4_2z = orthoglide_leg_tree_geo_D4*c2;
    phi[48] = U4_zx*m4_2z - minus_vd4_z*minus_e4_2y;
    const double vd4a_y = vd3_y + orthoglide_leg_tree_geo_D4*U3_yx;
    MODELER_ZEROS(phi + 61, 1);
    const double minus_vd4a_x = minus_vd3_x + orthoglide_leg_tree_geo_D4*minus_U3_xx;
    const double vd4_y = c3*vd4a_y + s3*minus_vd4a_x;
    const double m4_3x = orthoglide_leg_tree_geo_D4*s3;
    const double m4_3y = orthoglide_leg_tree_geo_D4*c3;
    phi[80] = U4_yx*m4_3y - minus_U4_xx*m4_3x + vd4_y;
    phi[112] = vd4_y;
    phi[17] = minus_U4_xy*minus_m4_1x - minus_U4_yy*m4_1y + c1*minus_U4_zy;
    phi[49] = minus_vd4_z*minus_e4_2x - minus_U4_zy*m4_2z;
    const double minus_vd4_x = c3*minus_vd4a_x - s3*vd4a_y;
    MODELER_ZEROS(phi + 64, 4);
    phi[81] = minus_vd4_x - (minus_U4_xy*m4_3x + minus_U4_yy*m4_3y);
    phi[113] = minus_vd4_x;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_2x = c4*minus_e4_2x;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double e5_2y = s4*minus_e4_2x;
    const double t62 = minus_ww5_xz*e5_2y;
    MODELER_ZEROS(phi + 89, 8);
    const double minus_ww5_xy = minus_w5_x*w5_y;
    phi[50] = minus_wd5_x*minus_e5_2x - t62 + minus_ww5_xy*minus_e4_2y;
    const double t64 = c4*minus_ww5_xz;
    const double t65 = s4*minus_wd5_x + t64;
    phi[82] = -t65;
    phi[114] = -t65;
    phi[146] = minus_ww5_xy;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    MODELER_ZEROS(phi + 97, 8);
    const double ww5_yz = w5_y*w5_z;
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    phi[51] = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + minus_e4_2y*minus_n5_XYz);
    const double t74 = s4*minus_U5_zx - c4*minus_U5_zy;
    phi[83] = t74;
    phi[115] = t74;
    MODELER_ZEROS(phi + 105, 2);
    phi[147] = -minus_n5_XYz;
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    phi[52] = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + U5_yz*minus_e4_2y);
    const double t79 = s4*U5_yx - c4*minus_n5_XZy;
    phi[84] = t79;
    phi[116] = t79;
    MODELER_ZEROS(phi + 121, 8);
    phi[148] = -U5_yz;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    phi[53] = U5_xz*minus_e4_2y - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    const double t83 = s4*n5_YZx + c4*minus_U5_xy;
    phi[85] = t83;
    phi[117] = t83;
    phi[149] = U5_xz;
    phi[54] = t62 - ww5_yz*minus_e5_2x + wd5_z*minus_e4_2y;
    MODELER_ZEROS(phi + 129, 8);
    const double t84 = t64 + s4*ww5_yz;
    phi[86] = t84;
    phi[118] = t84;
    phi[150] = wd5_z;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c4*minus_m4_1x + c1*s4;
    const double minus_m5_1y = c1*c4 - s4*minus_m4_1x;
    phi[23] = minus_U5_xx*minus_m5_1x - U5_yx*minus_m5_1y + minus_U5_zx*m4_1y;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    const double m5_2x = s4*m4_2z;
    MODELER_ZEROS(phi + 137, 8);
    const double m5_2y = c4*m4_2z;
    phi[55] = vd4_y*e5_2y - minus_vd5_y*minus_e4_2y + (U5_yx*m5_2y - minus_U5_xx*m5_2x);
    const double t90 = c4*vd4_y;
    const double m5_3x = c4*m4_3x;
    const double minus_m5_3y = s4*m4_3x;
    phi[87] = minus_U5_zx*m4_3y - (minus_U5_xx*m5_3x + U5_yx*minus_m5_3y) + t90;
    phi[119] = t90;
    phi[151] = -minus_vd5_y;
    phi[24] = minus_U5_xy*minus_m5_1x + minus_U5_yy*minus_m5_1y + minus_U5_zy*m4_1y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    MODELER_ZEROS(phi + 145, 1);
    phi[56] = vd4_y*minus_e5_2x + minus_vd5_x*minus_e4_2y - (minus_U5_xy*m5_2x + minus_U5_yy*m5_2y);
    const double t94 = s4*vd4_y;
    phi[88] = -(minus_U5_xy*m5_3x - minus_U5_yy*minus_m5_3y - minus_U5_zy*m4_3y + t94);
    phi[120] = -t94;
    phi[152] = minus_vd5_x;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double U7_yz = s5*qdd[1];
    /* link 7: angular velocity, w7 = R7' w2 + qd7 z */
    const double minus_w7_y = c5*qd[1];
    const double minus_ww7_yz = qd[5]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd2 + (R7' w2) x qd7 z + qdd7 z */
    const double minus_wd7_x = U7_yz + minus_ww7_yz;
    MODELER_ZEROS(phi + 153, 8);
    const double minus_w7_x = s5*qd[1];
    const double minus_ww7_xz = qd[5]*minus_w7_x;
    phi[57] = s5*minus_wd7_x + c5*minus_ww7_xz;
    const double ww7_xy = minus_w7_x*minus_w7_y;
    phi[185] = -ww7_xy;
    const double minus_U7_xz = c5*qdd[1];
    const double minus_U7_zx = minus_ww7_xz - minus_U7_xz + minus_ww7_xz;
    const double minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    phi[58] = c5*minus_U7_zy - s5*minus_U7_zx;
    const double ww7_zz = qd[5]*qd[5];
    MODELER_ZEROS(phi + 161, 8);
    const double minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const double minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    phi[186] = minus_U7_yy - minus_U7_xx;
    const double U7_yx = qdd[5] + ww7_xy;
    phi[59] = c5*(ww2_zz - minus_U7_xx) - s5*U7_yx;
    phi[187] = -U7_yz;
    const double minus_U7_xy = qdd[5] - ww7_xy;
    phi[60] = -(s5*(ww2_zz - minus_U7_yy) + c5*minus_U7_xy);
    phi[188] = -minus_U7_xz;
    MODELER_ZEROS(phi + 169, 8);
    phi[189] = qdd[5];
    /* link 7: velocity of the origin, for unit speed of each joint below, m7 = R7' (m2 + e2 x p7)
        */
    const double minus_m7_1x = s1*c5;
    const double m7_1y = s1*s5;
    phi[30] = minus_U7_xx*minus_m7_1x + U7_yx*m7_1y + c1*minus_U7_zx;
    phi[62] = -c5*minus_vd2_y;
    phi[190] = orthoglide_leg_tree_geo_g*c5 + s5*minus_vd2_x;
    phi[31] = minus_U7_xy*minus_m7_1x - minus_U7_yy*m7_1y + c1*minus_U7_zy;
    phi[63] = s5*minus_vd2_y;
    phi[191] = c5*minus_vd2_x - orthoglide_leg_tree_geo_g*s5;
    MODELER_ZEROS(phi + 177, 8);
}

/* The entries of the base regressor that are not always 0.
 * 140 additions, 202 multiplications. */
MODELER_CLONES
void orthoglide_leg_tree_base_regressor_nonzeros(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 double MODELER_OUT(values, 88))
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

    values[0] = qdd[0];
    values[11] = qdd[1];
    const double ww2_zz = qd[1]*qd[1];
    values[1] = s1*ww2_zz - c1*qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = c1*qdd[0];
    values[12] = -minus_vd2_y;
    values[2] = s1*qdd[1] + c1*ww2_zz;
    const double minus_vd2_x = s1*qdd[0];
    values[13] = minus_vd2_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_yz = s2*qdd[1];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1];
    const double minus_ww3_yz = qd[2]*minus_w3_y;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = U3_yz + minus_ww3_yz;
    const double minus_w3_x = s2*qd[1];
    const double minus_ww3_xz = qd[2]*minus_w3_x;
    values[14] = s2*minus_wd3_x + c2*minus_ww3_xz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    values[39] = -ww3_xy;
    const double minus_U3_xz = c2*qdd[1];
    const double minus_wd3_y = minus_U3_xz - minus_ww3_xz;
    const double minus_U3_zx = minus_ww3_xz - minus_wd3_y;
    const double minus_U3_zy = minus_ww3_yz + minus_wd3_x;
    values[15] = c2*minus_U3_zy - s2*minus_U3_zx;
    const double ww3_zz = qd[2]*qd[2];
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    values[40] = minus_U3_yy - minus_U3_xx;
    const double U3_yx = qdd[2] + ww3_xy;
    values[16] = c2*(ww2_zz - minus_U3_xx) - s2*U3_yx;
    values[41] = -U3_yz;
    const double minus_U3_xy = qdd[2] - ww3_xy;
    values[17] = -(s2*(ww2_zz - minus_U3_yy) + c2*minus_U3_xy);
    values[42] = -minus_U3_xz;
    values[43] = qdd[2];
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double minus_m3_1x = s1*c2;
    const double m3_1y = s1*s2;
    values[3] = minus_U3_xx*minus_m3_1x + U3_yx*m3_1y + c1*minus_U3_zx;
    values[18] = -c2*minus_vd2_y;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_y = orthoglide_leg_tree_geo_g*c2 + s2*minus_vd2_x;
    values[44] = vd3_y;
    values[4] = minus_U3_xy*minus_m3_1x - minus_U3_yy*m3_1y + c1*minus_U3_zy;
    values[19] = s2*minus_vd2_y;
    const double minus_vd3_x = c2*minus_vd2_x - orthoglide_leg_tree_geo_g*s2;
    values[45] = minus_vd3_x;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*minus_w3_y - s3*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*minus_wd3_y + qd[3]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_2x = s2*c3 + c2*s3;
    const double minus_w4_x = c3*minus_w3_x + s3*minus_w3_y;
    const double w4_z = qd[2] + qd[3];
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double minus_e4_2y = c2*c3 - s2*s3;
    values[20] = minus_wd4_x*minus_e4_2x + minus_ww4_xz*minus_e4_2y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    values[46] = -ww4_xy;
    values[60] = -ww4_xy;
    const double minus_wd4_y = c3*minus_wd3_y - s3*minus_wd3_x - qd[3]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    values[21] = U4_zx*minus_e4_2x + minus_U4_zy*minus_e4_2y;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    values[47] = -minus_n4_XYz;
    values[61] = -minus_n4_XYz;
    const double wd4_z = qdd[2] + qdd[3];
    const double U4_yx = wd4_z + ww4_xy;
    values[22] = minus_e4_2y*(ww2_zz - minus_U4_xx) - U4_yx*minus_e4_2x;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    values[48] = -U4_yz;
    values[62] = -U4_yz;
    const double minus_U4_xy = wd4_z - ww4_xy;
    values[23] = -(minus_e4_2x*(ww2_zz - minus_U4_yy) + minus_U4_xy*minus_e4_2y);
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    values[49] = -minus_U4_xz;
    values[63] = -minus_U4_xz;
    values[50] = wd4_z;
    values[64] = wd4_z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = c3*minus_m3_1x - s3*m3_1y;
    const double m4_1y = c3*m3_1y + s3*minus_m3_1x;
    values[5] = minus_U4_xx*minus_m4_1x + U4_yx*m4_1y - c1*U4_zx;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = minus_vd2_y + orthoglide_leg_tree_geo_D4*minus_U3_zx;
    const double m4_2z = orthoglide_leg_tree_geo_D4*c2;
    values[24] = U4_zx*m4_2z - minus_vd4_z*minus_e4_2y;
    const double vd4a_y = vd3_y + orthoglide_leg_tree_geo_D4*U3_yx;
    const double minus_vd4a_x = minus_vd3_x + orthoglide_leg_tree_geo_D4*minus_U3_xx;
    const double vd4_y = c3*vd4a_y + s3*minus_vd4a_x;
    const double m4_3x = orthoglide_leg_tree_geo_D4*s3;
    const double m4_3y = orthoglide_leg_tree_geo_D4*c3;
    values[51] = U4_yx*m4_3y - minus_U4_xx*m4_3x + vd4_y;
    values[65] = vd4_y;
    values[6] = minus_U4_xy*minus_m4_1x - minus_U4_yy*m4_1y + c1*minus_U4_zy;
    values[25] = minus_vd4_z*minus_e4_2x - minus_U4_zy*m4_2z;
    const double minus_vd4_x = c3*minus_vd4a_x - s3*vd4a_y;
    values[52] = minus_vd4_x - (minus_U4_xy*m4_3x + minus_U4_yy*m4_3y);
    values[66] = minus_vd4_x;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_2x = c4*minus_e4_2x;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double e5_2y = s4*minus_e4_2x;
    const double t62 = minus_ww5_xz*e5_2y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    values[26] = minus_wd5_x*minus_e5_2x - t62 + minus_ww5_xy*minus_e4_2y;
    const double t64 = c4*minus_ww5_xz;
    const double t65 = s4*minus_wd5_x + t64;
    values[53] = -t65;
    values[67] = -t65;
    values[74] = minus_ww5_xy;
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
    values[27] = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + minus_e4_2y*minus_n5_XYz);
    const double t74 = s4*minus_U5_zx - c4*minus_U5_zy;
    values[54] = t74;
    values[68] = t74;
    values[75] = -minus_n5_XYz;
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    values[28] = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + U5_yz*minus_e4_2y);
    const double t79 = s4*U5_yx - c4*minus_n5_XZy;
    values[55] = t79;
    values[69] = t79;
    values[76] = -U5_yz;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    values[29] = U5_xz*minus_e4_2y - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    const double t83 = s4*n5_YZx + c4*minus_U5_xy;
    values[56] = t83;
    values[70] = t83;
    values[77] = U5_xz;
    values[30] = t62 - ww5_yz*minus_e5_2x + wd5_z*minus_e4_2y;
    const double t84 = t64 + s4*ww5_yz;
    values[57] = t84;
    values[71] = t84;
    values[78] = wd5_z;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c4*minus_m4_1x + c1*s4;
    const double minus_m5_1y = c1*c4 - s4*minus_m4_1x;
    values[7] = minus_U5_xx*minus_m5_1x - U5_yx*minus_m5_1y + minus_U5_zx*m4_1y;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    const double m5_2x = s4*m4_2z;
    const double m5_2y = c4*m4_2z;
    values[31] = vd4_y*e5_2y - minus_vd5_y*minus_e4_2y + (U5_yx*m5_2y - minus_U5_xx*m5_2x);
    const double t90 = c4*vd4_y;
    const double m5_3x = c4*m4_3x;
    const double minus_m5_3y = s4*m4_3x;
    values[58] = minus_U5_zx*m4_3y - (minus_U5_xx*m5_3x + U5_yx*minus_m5_3y) + t90;
    values[72] = t90;
    values[79] = -minus_vd5_y;
    values[8] = minus_U5_xy*minus_m5_1x + minus_U5_yy*minus_m5_1y + minus_U5_zy*m4_1y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    values[32] = vd4_y*minus_e5_2x + minus_vd5_x*minus_e4_2y - (minus_U5_xy*m5_2x +
        minus_U5_yy*m5_2y);
    const double t94 = s4*vd4_y;
    values[59] = -(minus_U5_xy*m5_3x - minus_U5_yy*minus_m5_3y - minus_U5_zy*m4_3y + t94);
    values[73] = -t94;
    values[80] = minus_vd5_x;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double U7_yz = s5*qdd[1];
    /* link 7: angular velocity, w7 = R7' w2 + qd7 z */
    const double minus_w7_y = c5*qd[1];
    const double minus_ww7_yz = qd[5]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd2 + (R7' w2) x qd7 z + qdd7 z */
    const double minus_wd7_x = U7_yz + minus_ww7_yz;
    const double minus_w7_x = s5*qd[1];
    const double minus_ww7_xz = qd[5]*minus_w7_x;
    values[33] = s5*minus_wd7_x + c5*minus_ww7_xz;
    const double ww7_xy = minus_w7_x*minus_w7_y;
    values[81] = -ww7_xy;
    const double minus_U7_xz = c5*qdd[1];
    const double minus_U7_zx = minus_ww7_xz - minus_U7_xz + minus_ww7_xz;
    const double minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    values[34] = c5*minus_U7_zy - s5*minus_U7_zx;
    const double ww7_zz = qd[5]*qd[5];
    const double minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const double minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    values[82] = minus_U7_yy - minus_U7_xx;
    const double U7_yx = qdd[5] + ww7_xy;
    values[35] = c5*(ww2_zz - minus_U7_xx) - s5*U7_yx;
    values[83] = -U7_yz;
    const double minus_U7_xy = qdd[5] - ww7_xy;
    values[36] = -(s5*(ww2_zz - minus_U7_yy) + c5*minus_U7_xy);
    values[84] = -minus_U7_xz;
    values[85] = qdd[5];
    /* link 7: velocity of the origin, for unit speed of each joint below, m7 = R7' (m2 + e2 x p7)
        */
    const double minus_m7_1x = s1*c5;
    const double m7_1y = s1*s5;
    values[9] = minus_U7_xx*minus_m7_1x + U7_yx*m7_1y + c1*minus_U7_zx;
    values[37] = -c5*minus_vd2_y;
    values[86] = orthoglide_leg_tree_geo_g*c5 + s5*minus_vd2_x;
    values[10] = minus_U7_xy*minus_m7_1x - minus_U7_yy*m7_1y + c1*minus_U7_zy;
    values[38] = s5*minus_vd2_y;
    values[87] = c5*minus_vd2_x - orthoglide_leg_tree_geo_g*s5;
}
