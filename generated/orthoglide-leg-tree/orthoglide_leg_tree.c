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
 *   h      angular momentum J w
 *   f      force on the link
 *   n      moment on the link at its origin
 *   fc     force on the link and all that it carries
 *   nc     moment on the link and all that it carries
 *   MSc    first moments of the link and all that it carries
 *   Jc     inertia of the link and all that it carries
 *   Js     what moving the inertia to the origin of the antecedent adds
 *   e_1    axes of the joints below, for unit speed of each
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   ang_1  angular momentum of what hangs on a joint, for unit speed of it
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: ang, fc, Jc, lin, nc, vd
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
static const double orthoglide_leg_tree_geo_b3 = ORTHOGLIDE_LEG_TREE_GEO_b3;
static const double orthoglide_leg_tree_geo_b7 = ORTHOGLIDE_LEG_TREE_GEO_b7;

const int orthoglide_leg_tree_nonzero_row[ORTHOGLIDE_LEG_TREE_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5
};

const int orthoglide_leg_tree_nonzero_column[ORTHOGLIDE_LEG_TREE_NONZEROS] = {
    0, 2, 3, 9, 10, 16, 17, 23, 24, 30, 31, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18,
    19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 30, 31, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
    17, 18, 19, 20, 21, 22, 23, 24, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 18, 19,
    20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
};

const char *orthoglide_leg_tree_signature(void)
{
    return "3decae1a5d54f2a6";
}

/* Joint torques, by the Newton-Euler recursion.
 * 185 additions, 238 multiplications. */
void orthoglide_leg_tree_inverse_dynamics(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                          double MODELER_OUT(tau, ORTHOGLIDE_LEG_TREE_JOINTS))
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

    /* link 7: angular velocity, w7 = R7' w2 + qd7 z */
    const double minus_w7_y = c5*qd[1];
    const double ww7_zz = qd[5]*qd[5];
    const double minus_w7_x = s5*qd[1];
    const double ww7_xy = minus_w7_x*minus_w7_y;
    const double t5 = c5*((minus_w7_y*minus_w7_y + ww7_zz)*beta[30] + (qdd[5] - ww7_xy)*beta[31]);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double w4_z = qd[2] + qd[3];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_x = s2*qd[1];
    const double minus_w3_y = c2*qd[1];
    const double minus_w4_x = c3*minus_w3_x + s3*minus_w3_y;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    const double minus_w4_y = c3*minus_w3_y - s3*minus_w3_x;
    const double w5_z = qd[4] + minus_w4_y;
    const double ww5_zz = w5_z*w5_z;
    const double minus_ww3_xz = qd[2]*minus_w3_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_y = c2*qdd[1] - minus_ww3_xz;
    const double minus_ww3_yz = qd[2]*minus_w3_y;
    const double minus_wd3_x = s2*qdd[1] + minus_ww3_yz;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_y = c3*minus_wd3_y - s3*minus_wd3_x - qd[3]*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double wd5_z = qdd[4] + minus_wd4_y;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    /* link 5: force on the link, f5 = M5 vd5 + U5 MS5 */
    const double minus_f5_x = (w5_y*w5_y + ww5_zz)*beta[23] + (wd5_z + minus_ww5_xy)*beta[24];
    const double minus_f5_y = (minus_w5_x*minus_w5_x + ww5_zz)*beta[24] - (wd5_z -
        minus_ww5_xy)*beta[23];
    const double ww4_zz = w4_z*w4_z;
    const double wd4_z = qdd[2] + qdd[3];
    const double ww4_xy = minus_w4_x*minus_w4_y;
    /* link 4: force on the link and all that it carries, fc4 = f4 + sum of R fc of what hangs on it
        */
    const double minus_fc4_x = c4*minus_f5_x - s4*minus_f5_y + ((minus_w4_y*minus_w4_y +
        ww4_zz)*beta[16] + (wd4_z - ww4_xy)*beta[17]);
    const double minus_wd4_x = c3*minus_wd3_x + s3*minus_wd3_y + qd[3]*minus_w4_y;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    const double minus_f5_z = (wd5_y + minus_w5_x*w5_z)*beta[23] + (minus_wd5_x -
        w5_y*w5_z)*beta[24];
    const double fc4_y = (wd4_z + ww4_xy)*beta[16] - (minus_w4_x*minus_w4_x + ww4_zz)*beta[17] +
        minus_f5_z;
    const double ww3_zz = qd[2]*qd[2];
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    const double minus_fc4a_y = s3*minus_fc4_x - c3*fc4_y;
    const double U3_yx = qdd[2] + ww3_xy;
    const double t38 = c2*(c3*minus_fc4_x + s3*fc4_y + (minus_U3_xx*beta[9] + (qdd[2] -
        ww3_xy)*beta[10]));
    /* link 7: force on the link and all that it carries, fc7 = f7 + sum of R fc of what hangs on it
        */
    const double minus_fc7a_x = t5 - s5*((minus_w7_x*minus_w7_x + ww7_zz)*beta[31] - (qdd[5] +
        ww7_xy)*beta[30]);
    const double ww2_zz = qd[1]*qd[1];
    const double t41 = t38 - s2*((minus_w3_x*minus_w3_x + ww3_zz)*beta[10] - U3_yx*beta[9] +
        minus_fc4a_y) + minus_fc7a_x;
    const double minus_ww7_xz = qd[5]*minus_w7_x;
    /* link 7: angular acceleration, wd7 = R7' wd2 + (R7' w2) x qd7 z + qdd7 z */
    const double minus_wd7_y = c5*qdd[1] - minus_ww7_xz;
    const double minus_ww7_yz = qd[5]*minus_w7_y;
    const double minus_wd7_x = s5*qdd[1] + minus_ww7_yz;
    const double minus_fc4_z = s4*minus_f5_x + c4*minus_f5_y + ((minus_wd4_x +
        minus_w4_y*w4_z)*beta[17] - (minus_wd4_y - minus_w4_x*w4_z)*beta[16]);
    const double minus_U3_zx = minus_ww3_xz - minus_wd3_y;
    /* link 7: force on the link, f7 = M7 vd7 + U7 MS7 */
    const double minus_f7_z = (minus_ww7_xz - minus_wd7_y)*beta[30] + (minus_ww7_yz +
        minus_wd7_x)*beta[31];
    const double t49 = minus_U3_zx*beta[9] + (minus_ww3_yz + minus_wd3_x)*beta[10] + minus_fc4_z +
        minus_f7_z;
    const double t50 = s1*(ww2_zz*beta[2] + qdd[1]*beta[3] + t41);
    tau[0] = t50 + c1*(ww2_zz*beta[3] - qdd[1]*beta[2] + t49) + qdd[0]*beta[0];
    const double minus_h7_z = minus_w7_x*beta[27] + minus_w7_y*beta[28] - qd[5]*beta[29];
    const double minus_h7_y = minus_w7_x*beta[26] - qd[5]*beta[28];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = c1*qdd[0];
    const double t54 = minus_w7_y*minus_h7_z + qd[5]*minus_h7_y + (qdd[5]*beta[27] -
        (minus_wd7_x*beta[25] + minus_wd7_y*beta[26]));
    const double minus_h7_x = minus_w7_x*beta[25] + minus_w7_y*beta[26] - qd[5]*beta[27];
    const double t56 = c5*(qd[5]*minus_h7_x + minus_w7_x*minus_h7_z + (minus_wd7_x*beta[26] -
        qdd[5]*beta[28]) - minus_vd2_y*beta[30]);
    const double minus_h5_z = minus_w5_x*beta[20] - w5_y*beta[21] - w5_z*beta[22];
    const double minus_h5_y = minus_w5_x*beta[19] - w5_z*beta[21];
    const double minus_vd2_x = s1*qdd[0];
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_y = orthoglide_leg_tree_geo_g*c2 + s2*minus_vd2_x;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double vd4a_y = vd3_y + orthoglide_leg_tree_geo_D4*U3_yx;
    const double minus_vd3_x = c2*minus_vd2_x - orthoglide_leg_tree_geo_g*s2;
    const double minus_vd4a_x = minus_vd3_x + orthoglide_leg_tree_geo_D4*minus_U3_xx;
    const double vd4_y = c3*vd4a_y + s3*minus_vd4a_x;
    const double t65 = w5_y*minus_h5_z - w5_z*minus_h5_y + (minus_wd5_x*beta[18] - wd5_y*beta[19] -
        wd5_z*beta[20]);
    /* link 5: moment on the link at its origin, n5 = J5 wd5 + w5 x J5 w5 + MS5 x vd5 */
    const double minus_n5_x = t65 + vd4_y*beta[24];
    const double minus_h5_x = minus_w5_x*beta[18] - w5_y*beta[19] - w5_z*beta[20];
    const double minus_n5_y = w5_z*minus_h5_x + minus_w5_x*minus_h5_z + (minus_wd5_x*beta[19] -
        wd5_z*beta[21]) - vd4_y*beta[23];
    const double minus_h4_z = minus_w4_x*beta[13] + minus_w4_y*beta[14] - w4_z*beta[15];
    const double minus_h4_y = minus_w4_x*beta[12] - w4_z*beta[14];
    const double minus_vd4_z = minus_vd2_y + orthoglide_leg_tree_geo_D4*minus_U3_zx;
    const double t72 = minus_w4_y*minus_h4_z + w4_z*minus_h4_y + (wd4_z*beta[13] -
        (minus_wd4_x*beta[11] + minus_wd4_y*beta[12]));
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc4_x = c4*minus_n5_x - s4*minus_n5_y + (minus_vd4_z*beta[17] - t72);
    const double minus_vd4_x = c3*minus_vd4a_x - s3*vd4a_y;
    const double t75 = minus_w5_x*minus_h5_y + w5_y*minus_h5_x + (wd5_z*beta[22] -
        (minus_wd5_x*beta[20] - wd5_y*beta[21]));
    const double n5_z = (c4*minus_vd4_x + s4*minus_vd4_z)*beta[24] - (c4*minus_vd4_z -
        s4*minus_vd4_x)*beta[23] + t75;
    const double minus_h4_x = minus_w4_x*beta[11] + minus_w4_y*beta[12] - w4_z*beta[13];
    const double minus_nc4_y = w4_z*minus_h4_x + minus_w4_x*minus_h4_z + (minus_wd4_x*beta[12] -
        wd4_z*beta[14]) - minus_vd4_z*beta[16] + n5_z;
    const double minus_h3_z = minus_w3_x*beta[6] + minus_w3_y*beta[7] - qd[2]*beta[8];
    const double minus_h3_y = minus_w3_x*beta[5] - qd[2]*beta[7];
    const double t81 = minus_w3_y*minus_h3_z + qd[2]*minus_h3_y + (qdd[2]*beta[6] -
        (minus_wd3_x*beta[4] + minus_wd3_y*beta[5]));
    const double minus_h3_x = minus_w3_x*beta[4] + minus_w3_y*beta[5] - qd[2]*beta[6];
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_y = qd[2]*minus_h3_x + minus_w3_x*minus_h3_z + (minus_wd3_x*beta[5] -
        qdd[2]*beta[7]) - minus_vd2_y*beta[9];
    const double t84 = c2*(s3*minus_nc4_x + c3*minus_nc4_y - orthoglide_leg_tree_geo_D4*minus_fc4_z
        + minus_n3_y);
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc3a_z = s2*(c3*minus_nc4_x - s3*minus_nc4_y + (minus_vd2_y*beta[10] - t81)) + t84;
    /* link 2: moment on the link at its origin, n2 = J2 wd2 + w2 x J2 w2 + MS2 x vd2 */
    const double n2_z = minus_vd2_x*beta[3] - minus_vd2_y*beta[2] + qdd[1]*beta[1];
    tau[1] = n2_z - (s5*(t54 - minus_vd2_y*beta[31]) - t56 - nc3a_z);
    const double t87 = minus_w4_x*minus_h4_y - minus_w4_y*minus_h4_x + (wd4_z*beta[15] -
        (minus_wd4_x*beta[13] + minus_wd4_y*beta[14]));
    const double minus_nc4_z = s4*minus_n5_x + c4*minus_n5_y - (vd4_y*beta[16] +
        minus_vd4_x*beta[17] + t87);
    const double t89 = minus_w3_x*minus_h3_y - minus_w3_y*minus_h3_x + (qdd[2]*beta[8] -
        (minus_wd3_x*beta[6] + minus_wd3_y*beta[7]));
    tau[2] = vd3_y*beta[9] + minus_vd3_x*beta[10] + t89 - (minus_nc4_z +
        orthoglide_leg_tree_geo_D4*minus_fc4a_y);
    tau[3] = -minus_nc4_z;
    tau[4] = n5_z;
    const double t90 = (orthoglide_leg_tree_geo_g*c5 + s5*minus_vd2_x)*beta[30];
    const double t91 = minus_w7_x*minus_h7_y - minus_w7_y*minus_h7_x + (qdd[5]*beta[29] -
        (minus_wd7_x*beta[27] + minus_wd7_y*beta[28]));
    tau[5] = t90 + (c5*minus_vd2_x - orthoglide_leg_tree_geo_g*s5)*beta[31] + t91;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 64 additions, 84 multiplications. */
void orthoglide_leg_tree_inertia_matrix(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                        double MODELER_OUT(M, 6 * 6))
{
    M[17] = 0.0;
    M[23] = 0.0;
    M[29] = 0.0;
    M[32] = 0.0;
    M[33] = 0.0;
    M[34] = 0.0;

    const double k1 = orthoglide_leg_tree_geo_D4*2.0;

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

    M[0] = beta[0];
    /* link 4: first moments of the link and all that it carries, MSc4 = MS4 + sum of R MSc + Mc p
        of what hangs on it */
    const double MSc4_z = c4*beta[24] + s4*beta[23];
    const double minus_lin5a_5z = s4*beta[24] - c4*beta[23];
    const double MSc4_x = beta[16] - minus_lin5a_5z;
    const double minus_lin4a_4x = c3*beta[17] + s3*MSc4_x;
    /* link 3: first moments of the link and all that it carries, MSc3 = MS3 + sum of R MSc + Mc p
        of what hangs on it */
    const double MSc3_y = beta[10] + minus_lin4a_4x;
    const double minus_lin4a_4y = s3*beta[17] - c3*MSc4_x;
    const double MSc3_x = beta[9] - minus_lin4a_4y;
    const double t8 = c1*(c5*beta[30] - s5*beta[31] + beta[2] + (c2*MSc3_x - s2*MSc3_y));
    /* link 1: first moments of the link and all that it carries, MSc1 = MS1 + sum of R MSc + Mc p
        of what hangs on it */
    const double minus_MSc1_x = s1*(beta[3] + MSc4_z) - t8;
    M[1] = minus_MSc1_x;
    const double lin2a_3z = s1*(c2*MSc3_y + s2*MSc3_x);
    M[2] = lin2a_3z;
    const double lin2a_4z = s1*(c2*minus_lin4a_4x - s2*minus_lin4a_4y);
    M[3] = lin2a_4z;
    const double minus_lin4a_5y = s3*MSc4_z;
    const double lin2a_5z = s1*(c3*MSc4_z*c2 - s2*minus_lin4a_5y) + c1*minus_lin5a_5z;
    M[4] = lin2a_5z;
    const double lin2a_7z = s1*(c5*beta[31] + s5*beta[30]);
    M[5] = lin2a_7z;
    M[6] = minus_MSc1_x;
    const double t15 = c5*beta[26];
    const double t16 = c4*beta[18] - s4*beta[19];
    const double t17 = c4*beta[19];
    const double t18 = s4*t17;
    /* link 4: inertia of the link and all that it carries, Jc4 = J4 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc4_xx = c4*t16 - t18 + beta[11];
    const double ang5a_5x = c4*beta[20] - s4*beta[21];
    const double Jc4_xy = beta[12] - ang5a_5x;
    const double t22 = s3*Jc4_xy;
    const double t23 = c3*Jc4_xx - t22;
    const double t24 = s3*beta[22];
    const double t25 = c3*Jc4_xy;
    const double t26 = t24 - t25;
    /* link 3: inertia of the link and all that it carries, Jc3 = J3 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc3_xy = s3*t23 - c3*t26 + beta[5] - orthoglide_leg_tree_geo_D4*minus_lin4a_4x;
    const double t28 = c3*beta[22];
    const double minus_Js4_yy = k1*minus_lin4a_4y;
    const double t30 = c2*(s2*Jc3_xy + c2*(s3*(s3*Jc4_xx + t25) + c3*(t28 + t22) - minus_Js4_yy));
    const double Jc3a_zz = s2*(s2*(c3*t23 + s3*t26 + beta[4]) + c2*Jc3_xy) + t30;
    M[7] = s5*t15 + s5*(s5*beta[25] + t15) + beta[1] + Jc3a_zz;
    const double Jc4_xz = s4*t16 + c4*t17 + beta[13];
    const double ang5a_5z = s4*beta[20] + c4*beta[21];
    const double Jc4_yz = beta[14] - ang5a_5z;
    const double ang4a_4x = c3*Jc4_xz - s3*Jc4_yz;
    const double ang4a_4y = s3*Jc4_xz + c3*Jc4_yz;
    const double minus_ang3a_3z = s2*(beta[6] + ang4a_4x - orthoglide_leg_tree_geo_D4*MSc4_z) +
        c2*(beta[7] + ang4a_4y);
    M[8] = -minus_ang3a_3z;
    const double minus_ang3a_4z = s2*ang4a_4x + c2*ang4a_4y;
    M[9] = -minus_ang3a_4z;
    const double minus_ang3a_5z = s2*(c3*ang5a_5x + t24) + c2*(s3*ang5a_5x - t28 +
        orthoglide_leg_tree_geo_D4*minus_lin5a_5z);
    M[10] = -minus_ang3a_5z;
    /* link 2: inertia of the link and all that it carries, Jc2 = J2 + sum of R Jc R' + Js of what
        hangs on it */
    const double minus_Jc2_yz = s5*beta[27] + c5*beta[28];
    M[11] = -minus_Jc2_yz;
    M[12] = lin2a_3z;
    M[13] = -minus_ang3a_3z;
    const double Jc4_zz = t18 + s4*(s4*beta[18] + t17) + beta[15];
    M[14] = beta[8] + Jc4_zz - minus_Js4_yy;
    const double ang4a_4z = Jc4_zz - orthoglide_leg_tree_geo_D4*minus_lin4a_4y;
    M[15] = ang4a_4z;
    const double ang4a_5z = ang5a_5z - orthoglide_leg_tree_geo_D4*minus_lin4a_5y;
    M[16] = ang4a_5z;
    M[18] = lin2a_4z;
    M[19] = -minus_ang3a_4z;
    M[20] = ang4a_4z;
    M[21] = Jc4_zz;
    M[22] = ang5a_5z;
    M[24] = lin2a_5z;
    M[25] = -minus_ang3a_5z;
    M[26] = ang4a_5z;
    M[27] = ang5a_5z;
    M[28] = beta[22];
    M[30] = lin2a_7z;
    M[31] = -minus_Jc2_yz;
    M[35] = beta[29];
}

/* Torques that hold the robot still, without friction.
 * 9 additions, 22 multiplications. */
void orthoglide_leg_tree_gravity(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                 const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                 double MODELER_OUT(tau, ORTHOGLIDE_LEG_TREE_JOINTS))
{
    tau[0] = 0.0;
    tau[1] = 0.0;

    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_y = orthoglide_leg_tree_geo_g*c2;
    const double vd3_x = orthoglide_leg_tree_geo_g*s2;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double vd4_y = c3*vd3_y - s3*vd3_x;
    const double vd4_x = c3*vd3_x + s3*vd3_y;
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc4_z = beta[24]*vd4_y*s4 - beta[23]*vd4_y*c4 + (beta[17]*vd4_x -
        beta[16]*vd4_y);
    tau[2] = vd3_y*beta[9] - vd3_x*beta[10] - minus_nc4_z;
    tau[3] = -minus_nc4_z;
    tau[4] = -(s4*vd4_x*beta[23] + c4*vd4_x*beta[24]);
    const double t6 = orthoglide_leg_tree_geo_g*c5*beta[30];
    tau[5] = t6 - orthoglide_leg_tree_geo_g*s5*beta[31];
}

/* Coriolis and centripetal torques.
 * 131 additions, 199 multiplications. */
void orthoglide_leg_tree_coriolis(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                  double MODELER_OUT(tau, ORTHOGLIDE_LEG_TREE_JOINTS))
{
    const double k1 = orthoglide_leg_tree_geo_D4*2.0;

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

    /* link 7: angular velocity, w7 = R7' w2 + qd7 z */
    const double minus_w7_y = c5*qd[1];
    const double ww7_zz = qd[5]*qd[5];
    const double minus_w7_x = s5*qd[1];
    const double ww7_xy = minus_w7_x*minus_w7_y;
    const double t5 = c5*((minus_w7_y*minus_w7_y + ww7_zz)*beta[30] - ww7_xy*beta[31]);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double w4_z = qd[2] + qd[3];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_x = s2*qd[1];
    const double minus_w3_y = c2*qd[1];
    const double minus_w4_x = c3*minus_w3_x + s3*minus_w3_y;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    const double minus_w4_y = c3*minus_w3_y - s3*minus_w3_x;
    const double w5_z = qd[4] + minus_w4_y;
    const double ww5_zz = w5_z*w5_z;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    /* link 5: force on the link, f5 = M5 vd5 + U5 MS5 */
    const double minus_f5_x = (w5_y*w5_y + ww5_zz)*beta[23] - beta[24]*(minus_ww4_xz -
        minus_ww5_xy);
    const double minus_f5_y = beta[23]*(minus_ww4_xz + minus_ww5_xy) + (minus_w5_x*minus_w5_x +
        ww5_zz)*beta[24];
    const double ww4_zz = w4_z*w4_z;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    /* link 4: force on the link and all that it carries, fc4 = f4 + sum of R fc of what hangs on it
        */
    const double minus_fc4_x = c4*minus_f5_x - s4*minus_f5_y + ((minus_w4_y*minus_w4_y +
        ww4_zz)*beta[16] - ww4_xy*beta[17]);
    const double minus_ww4_yz = minus_w4_y*w4_z;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double wd5_y = qd[4]*minus_w5_x + s4*minus_ww4_yz;
    const double wd5_x = qd[4]*w5_y - c4*minus_ww4_yz;
    const double minus_f5_z = beta[23]*(minus_w5_x*w5_z + wd5_y) - beta[24]*(w5_y*w5_z + wd5_x);
    const double fc4_y = ww4_xy*beta[16] - (minus_w4_x*minus_w4_x + ww4_zz)*beta[17] + minus_f5_z;
    const double ww3_zz = qd[2]*qd[2];
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    const double minus_fc4a_y = s3*minus_fc4_x - c3*fc4_y;
    const double t31 = c2*(c3*minus_fc4_x + s3*fc4_y + (minus_U3_xx*beta[9] - ww3_xy*beta[10]));
    /* link 3: force on the link and all that it carries, fc3 = f3 + sum of R fc of what hangs on it
        */
    const double minus_fc3a_x = t31 - s2*((minus_w3_x*minus_w3_x + ww3_zz)*beta[10] - ww3_xy*beta[9]
        + minus_fc4a_y);
    const double ww2_zz = qd[1]*qd[1];
    const double minus_ww7_xz = qd[5]*minus_w7_x;
    const double minus_ww7_yz = qd[5]*minus_w7_y;
    const double minus_fc4_z = s4*minus_f5_x + c4*minus_f5_y + (2.0*minus_ww4_xz*beta[16] +
        2.0*minus_ww4_yz*beta[17]);
    const double minus_ww3_xz = qd[2]*minus_w3_x;
    const double minus_ww3_yz = qd[2]*minus_w3_y;
    const double minus_fc3_z = 2.0*minus_ww3_xz*beta[9] + 2.0*minus_ww3_yz*beta[10] + minus_fc4_z;
    const double t40 = s1*(t5 + s5*(ww7_xy*beta[30] - (minus_w7_x*minus_w7_x + ww7_zz)*beta[31]) +
        minus_fc3a_x + ww2_zz*beta[2]);
    tau[0] = t40 + c1*(2.0*minus_ww7_xz*beta[30] + 2.0*minus_ww7_yz*beta[31] + minus_fc3_z +
        ww2_zz*beta[3]);
    const double minus_h7_z = minus_w7_x*beta[27] + minus_w7_y*beta[28] - qd[5]*beta[29];
    const double minus_h7_y = minus_w7_x*beta[26] - qd[5]*beta[28];
    const double minus_h7_x = minus_w7_x*beta[25] + minus_w7_y*beta[26] - qd[5]*beta[27];
    const double t44 = s5*(minus_ww7_yz*beta[25] - minus_ww7_xz*beta[26] - (minus_w7_y*minus_h7_z +
        qd[5]*minus_h7_y));
    const double minus_h5_z = minus_w5_x*beta[20] - w5_y*beta[21] - w5_z*beta[22];
    const double minus_h5_y = minus_w5_x*beta[19] - w5_z*beta[21];
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double vd4a_y = orthoglide_leg_tree_geo_D4*ww3_xy;
    const double minus_vd4a_x = orthoglide_leg_tree_geo_D4*minus_U3_xx;
    const double vd4_y = c3*vd4a_y + s3*minus_vd4a_x;
    const double t50 = beta[18]*wd5_x + beta[19]*wd5_y - minus_ww4_xz*beta[20] + (w5_z*minus_h5_y -
        w5_y*minus_h5_z);
    /* link 5: moment on the link at its origin, n5 = J5 wd5 + w5 x J5 w5 + MS5 x vd5 */
    const double n5_x = t50 - beta[24]*vd4_y;
    const double minus_h5_x = minus_w5_x*beta[18] - w5_y*beta[19] - w5_z*beta[20];
    const double n5_y = beta[19]*wd5_x - minus_ww4_xz*beta[21] - (w5_z*minus_h5_x +
        minus_w5_x*minus_h5_z) + beta[23]*vd4_y;
    const double minus_h4_z = minus_w4_x*beta[13] + minus_w4_y*beta[14] - w4_z*beta[15];
    const double minus_h4_y = minus_w4_x*beta[12] - w4_z*beta[14];
    const double minus_vd4_z = k1*minus_ww3_xz;
    /* link 4: moment on the link at its origin, n4 = J4 wd4 + w4 x J4 w4 + MS4 x vd4 */
    const double minus_n4_x = minus_ww4_yz*beta[11] - minus_ww4_xz*beta[12] - (minus_w4_y*minus_h4_z
        + w4_z*minus_h4_y) + beta[17]*minus_vd4_z;
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc4_x = c4*n5_x - s4*n5_y - minus_n4_x;
    const double minus_vd4_x = c3*minus_vd4a_x - s3*vd4a_y;
    const double t60 = beta[20]*wd5_x + beta[21]*wd5_y - minus_ww4_xz*beta[22] +
        (minus_w5_x*minus_h5_y + w5_y*minus_h5_x);
    const double n5_z = beta[24]*(c4*minus_vd4_x + s4*minus_vd4_z) - beta[23]*(c4*minus_vd4_z -
        s4*minus_vd4_x) + t60;
    const double minus_h4_x = minus_w4_x*beta[11] + minus_w4_y*beta[12] - w4_z*beta[13];
    const double minus_nc4_y = w4_z*minus_h4_x + minus_w4_x*minus_h4_z + minus_ww4_yz*beta[12] -
        beta[16]*minus_vd4_z + n5_z;
    const double minus_h3_z = minus_w3_x*beta[6] + minus_w3_y*beta[7] - qd[2]*beta[8];
    const double minus_h3_y = minus_w3_x*beta[5] - qd[2]*beta[7];
    const double minus_h3_x = minus_w3_x*beta[4] + minus_w3_y*beta[5] - qd[2]*beta[6];
    const double nc4a_y = s3*nc4_x - c3*minus_nc4_y + orthoglide_leg_tree_geo_D4*minus_fc4_z;
    const double t68 = s2*(c3*nc4_x + s3*minus_nc4_y + (minus_w3_y*minus_h3_z + qd[2]*minus_h3_y -
        (minus_ww3_yz*beta[4] - minus_ww3_xz*beta[5])));
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc3a_z = t68 + c2*(nc4a_y - (qd[2]*minus_h3_x + minus_w3_x*minus_h3_z +
        minus_ww3_yz*beta[5]));
    tau[1] = t44 + c5*(qd[5]*minus_h7_x + minus_w7_x*minus_h7_z + minus_ww7_yz*beta[26]) -
        minus_nc3a_z;
    const double t70 = minus_ww4_yz*beta[13] - minus_ww4_xz*beta[14] + (minus_w4_y*minus_h4_x -
        minus_w4_x*minus_h4_y);
    const double nc4_z = s4*n5_x + c4*n5_y + (beta[16]*vd4_y + beta[17]*minus_vd4_x - t70);
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_z = minus_ww3_yz*beta[6] - minus_ww3_xz*beta[7] + (minus_w3_y*minus_h3_x -
        minus_w3_x*minus_h3_y);
    tau[2] = nc4_z - orthoglide_leg_tree_geo_D4*minus_fc4a_y - minus_n3_z;
    tau[3] = nc4_z;
    tau[4] = n5_z;
    tau[5] = minus_w7_x*minus_h7_y - minus_w7_y*minus_h7_x - (minus_ww7_yz*beta[27] -
        minus_ww7_xz*beta[28]);
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void orthoglide_leg_tree_friction(const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                  double MODELER_OUT(tau, ORTHOGLIDE_LEG_TREE_JOINTS))
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 27 additions, 5 multiplications. */
void orthoglide_leg_tree_base_parameters(const double chi[ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS],
        double MODELER_OUT(beta, ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS))
{
    const double k1 = orthoglide_leg_tree_geo_D4*orthoglide_leg_tree_geo_D4;

    beta[0] = chi[9] + chi[19] + chi[29] + chi[39] + chi[49] + chi[59];
    const double t1 = k1*chi[39];
    const double t2 = k1*chi[49];
    beta[1] = chi[15] + chi[23] + chi[33] + t1 + t2 + chi[53];
    beta[2] = chi[16];
    beta[3] = chi[17] + chi[28] + chi[38] + chi[58];
    beta[4] = -(chi[23] - chi[20] + t1 + t2);
    beta[5] = chi[21];
    beta[6] = chi[22] - orthoglide_leg_tree_geo_D4*chi[38];
    beta[7] = chi[24];
    beta[8] = chi[25] + t1 + t2;
    const double t3 = chi[26] + orthoglide_leg_tree_geo_D4*chi[39];
    beta[9] = t3 + orthoglide_leg_tree_geo_D4*chi[49];
    beta[10] = chi[27];
    beta[11] = chi[30] - chi[33] + chi[43];
    beta[12] = chi[31];
    beta[13] = chi[32];
    beta[14] = chi[34];
    beta[15] = chi[35] + chi[43];
    beta[16] = chi[36];
    beta[17] = chi[37] - chi[48];
    beta[18] = chi[40] - chi[43];
    beta[19] = chi[41];
    beta[20] = chi[42];
    beta[21] = chi[44];
    beta[22] = chi[45];
    beta[23] = chi[46];
    beta[24] = chi[47];
    beta[25] = chi[50] - chi[53];
    beta[26] = chi[51];
    beta[27] = chi[52];
    beta[28] = chi[54];
    beta[29] = chi[55];
    beta[30] = chi[56];
    beta[31] = chi[57];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 12 additions, 33 multiplications. */
void orthoglide_leg_tree_forward_kinematics(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                            double MODELER_OUT(T, 6 * 3 * 4))
{
    MODELER_ALL_ZEROS(T, 72);

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

    T[0] = 1.0;
    T[5] = 1.0;
    T[10] = 1.0;
    T[11] = q[0];
    T[12] = c1;
    T[13] = -s1;
    T[18] = 1.0;
    MODELER_ZEROS(T + 1, 4);
    T[20] = -s1;
    T[21] = -c1;
    T[23] = q[0];
    const double x3_x = c1*c2;
    T[24] = x3_x;
    const double minus_y3_x = c1*s2;
    T[25] = -minus_y3_x;
    MODELER_ZEROS(T + 6, 4);
    T[26] = -s1;
    T[28] = -s2;
    T[29] = -c2;
    T[31] = orthoglide_leg_tree_geo_b3;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double minus_m3_1x = s1*c2;
    T[32] = -minus_m3_1x;
    MODELER_ZEROS(T + 14, 4);
    const double m3_1y = s1*s2;
    T[33] = m3_1y;
    T[34] = -c1;
    T[35] = q[0];
    const double x4_x = c3*x3_x - s3*minus_y3_x;
    T[36] = x4_x;
    const double minus_y4_x = c3*minus_y3_x + s3*x3_x;
    MODELER_ZEROS(T + 19, 1);
    T[37] = -minus_y4_x;
    T[38] = -s1;
    /* link 4: origin of the frame in frame 0, o4 = o3 + [x3 y3 z3] p4 */
    const double o4_x = orthoglide_leg_tree_geo_D4*x3_x;
    T[39] = o4_x;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_2x = s2*c3 + c2*s3;
    T[40] = -minus_e4_2x;
    MODELER_ZEROS(T + 22, 1);
    const double minus_e4_2y = c2*c3 - s2*s3;
    T[41] = -minus_e4_2y;
    const double o4_y = orthoglide_leg_tree_geo_b3 - orthoglide_leg_tree_geo_D4*s2;
    T[43] = o4_y;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = c3*minus_m3_1x - s3*m3_1y;
    T[44] = -minus_m4_1x;
    const double m4_1y = c3*m3_1y + s3*minus_m3_1x;
    MODELER_ZEROS(T + 27, 1);
    T[45] = m4_1y;
    T[46] = -c1;
    const double o4_z = q[0] - orthoglide_leg_tree_geo_D4*minus_m3_1x;
    T[47] = o4_z;
    T[48] = c4*x4_x - s1*s4;
    T[49] = -(s1*c4 + s4*x4_x);
    T[50] = minus_y4_x;
    MODELER_ZEROS(T + 30, 1);
    T[51] = o4_x;
    T[52] = -c4*minus_e4_2x;
    T[53] = s4*minus_e4_2x;
    T[54] = minus_e4_2y;
    T[55] = o4_y;
    T[56] = -(c4*minus_m4_1x + c1*s4);
    MODELER_ZEROS(T + 42, 1);
    T[57] = s4*minus_m4_1x - c1*c4;
    T[58] = -m4_1y;
    T[59] = o4_z;
    T[60] = c1*c5;
    T[61] = -c1*s5;
    T[62] = -s1;
    T[64] = -s5;
    MODELER_ZEROS(T + 63, 1);
    T[65] = -c5;
    T[67] = orthoglide_leg_tree_geo_b7;
    T[68] = -s1*c5;
    T[69] = s1*s5;
    T[70] = -c1;
    T[71] = q[0];
    MODELER_ZEROS(T + 66, 1);
}
