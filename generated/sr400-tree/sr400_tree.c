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
 *   h      angular momentum J w
 *   f      force on the link
 *   n      moment on the link at its origin
 *   fc     force on the link and all that it carries
 *   nc     moment on the link and all that it carries
 *   MSc    first moments of the link and all that it carries
 *   Jc     inertia of the link and all that it carries
 *   Js     what moving the inertia to the origin of the antecedent adds
 *   e_1    axes of the joints below, for unit speed of each
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   ang_1  angular momentum of what hangs on a joint, for unit speed of it
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: ang, fc, Jc, lin, nc, vd
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

const int sr400_tree_nonzero_row[SR400_TREE_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7
};

const int sr400_tree_nonzero_column[SR400_TREE_NONZEROS] = {
    0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
    28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 41, 42, 43, 44, 45, 46, 48, 49, 1, 2, 3, 4, 5,
    6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
    31, 32, 33, 34, 35, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
    27, 28, 29, 30, 31, 32, 33, 34, 35, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29,
    30, 31, 32, 33, 34, 35, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 29, 30, 31, 32,
    33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 43, 44, 45, 46, 47, 48, 49
};

const char *sr400_tree_signature(void)
{
    return "1fb9681687ac8601";
}

/* Joint torques, by the Newton-Euler recursion.
 * 323 additions, 408 multiplications. */
void sr400_tree_inverse_dynamics(const double q[SR400_TREE_JOINTS],
                                 const double qd[SR400_TREE_JOINTS],
                                 const double qdd[SR400_TREE_JOINTS],
                                 const double beta[SR400_TREE_BASE_PARAMETERS],
                                 double MODELER_OUT(tau, SR400_TREE_JOINTS))
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

    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const double minus_w7_y = c6*qd[0];
    const double minus_w7_x = s6*qd[0];
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const double minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    const double minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const double w8_z = qd[6] + qd[7];
    const double minus_h8_z = minus_w8_x*beta[45] + minus_w8_y*beta[46] - w8_z*beta[47];
    const double minus_h8_y = minus_w8_x*beta[44] - w8_z*beta[46];
    const double minus_ww7_yz = qd[6]*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd1 + (R7' w1) x qd7 z + qdd7 z */
    const double minus_wd7_x = s6*qdd[0] + minus_ww7_yz;
    const double minus_ww7_xz = qd[6]*minus_w7_x;
    const double minus_wd7_y = c6*qdd[0] - minus_ww7_xz;
    /* link 8: angular acceleration, wd8 = R8' wd7 + (R8' w7) x qd8 z + qdd8 z */
    const double minus_wd8_x = c7*minus_wd7_x + s7*minus_wd7_y + qd[7]*minus_w8_y;
    const double minus_wd8_y = c7*minus_wd7_y - s7*minus_wd7_x - qd[7]*minus_w8_x;
    const double wd8_z = qdd[6] + qdd[7];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_tree_geo_D2*qdd[0];
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const double minus_U7_zx = minus_ww7_xz - minus_wd7_y;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double vd8_z = vd2_z - sr400_tree_geo_D8*minus_U7_zx;
    const double t18 = minus_w8_y*minus_h8_z + w8_z*minus_h8_y + (wd8_z*beta[45] -
        (minus_wd8_x*beta[43] + minus_wd8_y*beta[44]));
    /* link 8: moment on the link at its origin, n8 = J8 wd8 + w8 x J8 w8 + MS8 x vd8 */
    const double n8_x = t18 + vd8_z*beta[49];
    const double minus_h8_x = minus_w8_x*beta[43] + minus_w8_y*beta[44] - w8_z*beta[45];
    const double minus_n8_y = w8_z*minus_h8_x + minus_w8_x*minus_h8_z + (minus_wd8_x*beta[44] -
        wd8_z*beta[46]) + vd8_z*beta[48];
    const double minus_h7_z = minus_w7_x*beta[38] + minus_w7_y*beta[39] - qd[6]*beta[40];
    const double minus_h7_y = minus_w7_x*beta[37] - qd[6]*beta[39];
    const double t24 = minus_w7_y*minus_h7_z + qd[6]*minus_h7_y + (qdd[6]*beta[38] -
        (minus_wd7_x*beta[36] + minus_wd7_y*beta[37]));
    /* link 8: force on the link, f8 = M8 vd8 + U8 MS8 */
    const double f8_z = (minus_wd8_y - minus_w8_x*w8_z)*beta[48] - (minus_wd8_x +
        minus_w8_y*w8_z)*beta[49];
    const double minus_h7_x = minus_w7_x*beta[36] + minus_w7_y*beta[37] - qd[6]*beta[38];
    /* link 7: moment on the link at its origin, n7 = J7 wd7 + w7 x J7 w7 + MS7 x vd7 */
    const double minus_n7_y = qd[6]*minus_h7_x + minus_w7_x*minus_h7_z + (minus_wd7_x*beta[37] -
        qdd[6]*beta[39]) + vd2_z*beta[41];
    const double t28 = c6*(s7*n8_x - c7*minus_n8_y - sr400_tree_geo_D8*f8_z - minus_n7_y);
    const double t29 = sr400_tree_geo_D2*(f8_z - (minus_U7_zx*beta[41] + (minus_ww7_yz +
        minus_wd7_x)*beta[42]));
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double w3_z = qd[1] + qd[2];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_x = s1*qd[0];
    const double minus_w2_y = c1*qd[0];
    const double minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*w3_z - s3*minus_w3_x;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const double minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    const double w4_z = qd[3] - minus_w3_y;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c5*w5_z - s5*minus_w5_x;
    const double minus_w6_x = c5*minus_w5_x + s5*w5_z;
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    const double w6_z = qd[5] + w5_y;
    const double minus_h6_z = minus_w6_x*beta[31] + minus_w6_y*beta[32] - w6_z*beta[33];
    const double minus_h6_y = minus_w6_x*beta[30] - w6_z*beta[32];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = s1*qdd[0] + minus_ww2_yz;
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    const double minus_wd2_y = c1*qdd[0] - minus_ww2_xz;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = c2*minus_wd2_x + s2*minus_wd2_y + qd[2]*minus_w3_y;
    const double wd3_z = qdd[1] + qdd[2];
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c3*minus_wd3_x + s3*wd3_z + qd[3]*minus_w4_y;
    const double minus_wd3_y = c2*minus_wd2_y - s2*minus_wd2_x - qd[2]*minus_w3_x;
    const double wd4_z = qdd[3] - minus_wd3_y;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd[4]*w5_y;
    const double minus_wd4_y = c3*wd3_z - s3*minus_wd3_x - qd[3]*minus_w4_x;
    const double wd5_z = qdd[4] + minus_wd4_y;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = c5*minus_wd5_x + s5*wd5_z + qd[5]*minus_w6_y;
    const double minus_wd6_y = c5*wd5_z - s5*minus_wd5_x - qd[5]*minus_w6_x;
    const double wd5_y = c4*wd4_z + s4*minus_wd4_x + qd[4]*minus_w5_x;
    const double wd6_z = qdd[5] + wd5_y;
    const double minus_vd2a_x = qd[0]*qd[0]*sr400_tree_geo_D2;
    const double minus_vd2_y = sr400_tree_geo_g*c1 - s1*minus_vd2a_x;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3a_y = minus_vd2_y - sr400_tree_geo_D3*(qdd[1] + minus_w2_x*minus_w2_y);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_tree_geo_g*s1;
    const double minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*(minus_w2_y*minus_w2_y +
        qd[1]*qd[1]);
    const double minus_vd3_y = c2*minus_vd3a_y - s2*minus_vd3a_x;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_yx = wd3_z + ww3_xy;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_tree_geo_RL4*minus_U3_yy - sr400_tree_geo_D4*U3_yx +
        minus_vd3_y;
    const double minus_vd3_x = c2*minus_vd3a_x + s2*minus_vd3a_y;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_xy = wd3_z - ww3_xy;
    const double minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx + sr400_tree_geo_RL4*minus_U3_xy +
        minus_vd3_x;
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double vd3_z = vd2_z - sr400_tree_geo_D3*minus_U2_zx;
    const double U3_zx = minus_wd3_y - minus_w3_x*w3_z;
    const double minus_U3_zy = minus_wd3_x + minus_w3_y*w3_z;
    const double vd4a_z = sr400_tree_geo_D4*U3_zx - sr400_tree_geo_RL4*minus_U3_zy + vd3_z;
    const double minus_vd4_x = c3*minus_vd4a_x + s3*vd4a_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    const double t84 = minus_w6_y*minus_h6_z + w6_z*minus_h6_y + (wd6_z*beta[31] -
        (minus_wd6_x*beta[29] + minus_wd6_y*beta[30]));
    /* link 6: moment on the link at its origin, n6 = J6 wd6 + w6 x J6 w6 + MS6 x vd6 */
    const double n6_x = t84 - minus_vd5_y*beta[35];
    const double minus_h6_x = minus_w6_x*beta[29] + minus_w6_y*beta[30] - w6_z*beta[31];
    const double minus_n6_y = w6_z*minus_h6_x + minus_w6_x*minus_h6_z + (minus_wd6_x*beta[30] -
        wd6_z*beta[32]) - minus_vd5_y*beta[34];
    const double minus_h5_z = minus_w5_x*beta[24] - w5_y*beta[25] - w5_z*beta[26];
    const double minus_h5_y = minus_w5_x*beta[23] - w5_z*beta[25];
    const double minus_vd4_y = c3*vd4a_z - s3*minus_vd4a_x;
    const double t91 = w5_y*minus_h5_z - w5_z*minus_h5_y + (minus_wd5_x*beta[22] - wd5_y*beta[23] -
        wd5_z*beta[24]);
    /* link 5: moment on the link and all that it carries, nc5 = n5 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc5_x = c5*n6_x + s5*minus_n6_y + (minus_vd4_y*beta[28] - t91);
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    const double t94 = minus_w6_x*minus_h6_y - minus_w6_y*minus_h6_x + (wd6_z*beta[33] -
        (minus_wd6_x*beta[31] + minus_wd6_y*beta[32]));
    const double n6_z = (c5*minus_vd5_x + s5*minus_vd4_y)*beta[35] - (c5*minus_vd4_y -
        s5*minus_vd5_x)*beta[34] + t94;
    const double minus_h5_x = minus_w5_x*beta[22] - w5_y*beta[23] - w5_z*beta[24];
    const double nc5_y = n6_z - (w5_z*minus_h5_x + minus_w5_x*minus_h5_z + (minus_wd5_x*beta[23] -
        wd5_z*beta[25]) + minus_vd4_y*beta[27]);
    const double minus_h4_z = minus_w4_x*beta[17] + minus_w4_y*beta[18] - w4_z*beta[19];
    const double minus_h4_y = minus_w4_x*beta[16] - w4_z*beta[18];
    const double t100 = minus_w4_y*minus_h4_z + w4_z*minus_h4_y + (wd4_z*beta[17] -
        (minus_wd4_x*beta[15] + minus_wd4_y*beta[16]));
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc4_x = c4*nc5_x - s4*nc5_y + (t100 - minus_vd4_z*beta[21]);
    const double t102 = minus_w5_x*minus_h5_y + w5_y*minus_h5_x + (wd5_z*beta[26] -
        (minus_wd5_x*beta[24] - wd5_y*beta[25]));
    const double minus_nc5_z = s5*n6_x - c5*minus_n6_y + (minus_vd5_y*beta[27] -
        minus_vd5_x*beta[28] - t102);
    const double minus_h4_x = minus_w4_x*beta[15] + minus_w4_y*beta[16] - w4_z*beta[17];
    const double nc4_y = minus_vd4_z*beta[20] - (w4_z*minus_h4_x + minus_w4_x*minus_h4_z +
        (minus_wd4_x*beta[16] - wd4_z*beta[18])) + minus_nc5_z;
    const double ww6_zz = w6_z*w6_z;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    /* link 6: force on the link, f6 = M6 vd6 + U6 MS6 */
    const double minus_f6_x = (minus_w6_y*minus_w6_y + ww6_zz)*beta[34] + (wd6_z - ww6_xy)*beta[35];
    const double minus_f6_y = (minus_w6_x*minus_w6_x + ww6_zz)*beta[35] - (wd6_z + ww6_xy)*beta[34];
    const double ww5_zz = w5_z*w5_z;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    /* link 5: force on the link and all that it carries, fc5 = f5 + sum of R fc of what hangs on it
        */
    const double minus_fc5_x = c5*minus_f6_x - s5*minus_f6_y + ((w5_y*w5_y + ww5_zz)*beta[27] +
        (wd5_z + minus_ww5_xy)*beta[28]);
    const double f6_z = (minus_wd6_y - minus_w6_x*w6_z)*beta[34] - (minus_wd6_x +
        minus_w6_y*w6_z)*beta[35];
    const double fc5_y = (wd5_z - minus_ww5_xy)*beta[27] - (minus_w5_x*minus_w5_x + ww5_zz)*beta[28]
        + f6_z;
    const double ww4_zz = w4_z*w4_z;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    /* link 4: force on the link and all that it carries, fc4 = f4 + sum of R fc of what hangs on it
        */
    const double minus_fc4_x = c4*minus_fc5_x + s4*fc5_y + ((minus_w4_y*minus_w4_y +
        ww4_zz)*beta[20] + (wd4_z - ww4_xy)*beta[21]);
    const double fc5_z = s5*minus_f6_x + c5*minus_f6_y - ((wd5_y + minus_w5_x*w5_z)*beta[27] +
        (minus_wd5_x - w5_y*w5_z)*beta[28]);
    const double minus_fc4_y = (minus_w4_x*minus_w4_x + ww4_zz)*beta[21] - (wd4_z + ww4_xy)*beta[20]
        + fc5_z;
    const double fc4a_z = s3*minus_fc4_x + c3*minus_fc4_y;
    const double minus_h3_z = minus_w3_x*beta[10] + minus_w3_y*beta[11] - w3_z*beta[12];
    const double minus_h3_y = minus_w3_x*beta[9] - w3_z*beta[11];
    const double t123 = minus_w3_y*minus_h3_z + w3_z*minus_h3_y + (wd3_z*beta[10] -
        (minus_wd3_x*beta[8] + minus_wd3_y*beta[9]));
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc3_x = c3*nc4_x - s3*nc4_y + sr400_tree_geo_RL4*fc4a_z + (t123 + vd3_z*beta[14]);
    const double t125 = minus_w4_x*minus_h4_y - minus_w4_y*minus_h4_x + (wd4_z*beta[19] -
        (minus_wd4_x*beta[17] + minus_wd4_y*beta[18]));
    const double nc4_z = s4*nc5_x + c4*nc5_y + (minus_vd4_x*beta[21] - minus_vd4_y*beta[20] + t125);
    const double minus_h3_x = minus_w3_x*beta[8] + minus_w3_y*beta[9] - w3_z*beta[10];
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_y = w3_z*minus_h3_x + minus_w3_x*minus_h3_z + (minus_wd3_x*beta[9] -
        wd3_z*beta[11]) + vd3_z*beta[13];
    const double nc3_y = nc4_z - sr400_tree_geo_D4*fc4a_z - minus_n3_y;
    const double minus_h2_z = minus_w2_x*beta[3] + minus_w2_y*beta[4] - qd[1]*beta[5];
    const double minus_h2_y = minus_w2_x*beta[2] - qd[1]*beta[4];
    const double t132 = minus_w2_y*minus_h2_z + qd[1]*minus_h2_y + (qdd[1]*beta[3] -
        (minus_wd2_x*beta[1] + minus_wd2_y*beta[2]));
    /* link 3: force on the link and all that it carries, fc3 = f3 + sum of R fc of what hangs on it
        */
    const double fc3_z = U3_zx*beta[13] - minus_U3_zy*beta[14] + fc4a_z;
    const double minus_h2_x = minus_w2_x*beta[1] + minus_w2_y*beta[2] - qd[1]*beta[3];
    /* link 2: moment on the link at its origin, n2 = J2 wd2 + w2 x J2 w2 + MS2 x vd2 */
    const double minus_n2_y = qd[1]*minus_h2_x + minus_w2_x*minus_h2_z + (minus_wd2_x*beta[2] -
        qdd[1]*beta[4]) + vd2_z*beta[6];
    const double t136 = c1*(s2*nc3_x + c2*nc3_y - sr400_tree_geo_D3*fc3_z - minus_n2_y);
    const double t137 = sr400_tree_geo_D2*(fc3_z - (minus_U2_zx*beta[6] + (minus_ww2_yz +
        minus_wd2_x)*beta[7]));
    /* link 2: moment on the link and all that it carries, nc2 = n2 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc2a_z = s1*(c2*nc3_x - s2*nc3_y + (t132 + vd2_z*beta[7])) + t136 - t137;
    const double t139 = s6*(c7*n8_x + s7*minus_n8_y + (t24 + vd2_z*beta[42])) + t28 - t29 +
        minus_nc2a_z;
    tau[0] = qdd[0]*beta[0] - t139;
    const double minus_fc4_z = s4*minus_fc5_x - c4*fc5_y + ((minus_wd4_x + minus_w4_y*w4_z)*beta[21]
        - (minus_wd4_y - minus_w4_x*w4_z)*beta[20]);
    const double minus_fc4a_x = c3*minus_fc4_x - s3*minus_fc4_y;
    const double t142 = minus_w3_x*minus_h3_y - minus_w3_y*minus_h3_x + (wd3_z*beta[12] -
        (minus_wd3_x*beta[10] + minus_wd3_y*beta[11]));
    const double minus_nc4a_z = s3*nc4_x + c3*nc4_y + (sr400_tree_geo_D4*minus_fc4_z -
        sr400_tree_geo_RL4*minus_fc4a_x);
    const double minus_nc3_z = minus_vd3_y*beta[13] - minus_vd3_x*beta[14] - t142 + minus_nc4a_z;
    const double t145 = s2*(minus_U3_xx*beta[13] + minus_U3_xy*beta[14] + minus_fc4a_x);
    const double t146 = minus_w2_x*minus_h2_y - minus_w2_y*minus_h2_x + (qdd[1]*beta[5] -
        (minus_wd2_x*beta[3] + minus_wd2_y*beta[4]));
    const double minus_nc3a_z = minus_nc3_z + sr400_tree_geo_D3*(t145 + c2*(minus_U3_yy*beta[14] -
        U3_yx*beta[13] + minus_fc4_z));
    tau[1] = minus_vd2_x*beta[7] - minus_vd2_y*beta[6] + t146 - minus_nc3a_z;
    tau[2] = -minus_nc3_z;
    tau[3] = nc4_z;
    tau[4] = -minus_nc5_z;
    tau[5] = n6_z;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_tree_geo_g*c6 - s6*minus_vd2a_x;
    const double minus_vd8a_y = minus_vd7_y - sr400_tree_geo_D8*(qdd[6] + minus_w7_x*minus_w7_y);
    const double minus_vd7_x = c6*minus_vd2a_x + sr400_tree_geo_g*s6;
    const double minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*(minus_w7_y*minus_w7_y +
        qd[6]*qd[6]);
    const double t152 = minus_w8_x*minus_h8_y - minus_w8_y*minus_h8_x + (wd8_z*beta[47] -
        (minus_wd8_x*beta[45] + minus_wd8_y*beta[46]));
    const double n8_z = (c7*minus_vd8a_x + s7*minus_vd8a_y)*beta[49] - (c7*minus_vd8a_y -
        s7*minus_vd8a_x)*beta[48] + t152;
    const double ww8_zz = w8_z*w8_z;
    const double ww8_xy = minus_w8_x*minus_w8_y;
    const double t156 = s7*((minus_w8_y*minus_w8_y + ww8_zz)*beta[48] + (wd8_z - ww8_xy)*beta[49]);
    /* link 8: force on the link and all that it carries, fc8 = f8 + sum of R fc of what hangs on it
        */
    const double minus_fc8a_y = t156 + c7*((minus_w8_x*minus_w8_x + ww8_zz)*beta[49] - (wd8_z +
        ww8_xy)*beta[48]);
    const double t158 = minus_w7_x*minus_h7_y - minus_w7_y*minus_h7_x + (qdd[6]*beta[40] -
        (minus_wd7_x*beta[38] + minus_wd7_y*beta[39]));
    tau[6] = n8_z - sr400_tree_geo_D8*minus_fc8a_y + (minus_vd7_x*beta[42] - minus_vd7_y*beta[41] +
        t158);
    tau[7] = n8_z;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 157 additions, 190 multiplications. */
void sr400_tree_inertia_matrix(const double q[SR400_TREE_JOINTS],
                               const double beta[SR400_TREE_BASE_PARAMETERS],
                               double MODELER_OUT(M, 8 * 8))
{
    MODELER_ALL_ZEROS(M, 64);

    const double k1 = sr400_tree_geo_D8*2.0;
    const double k2 = sr400_tree_geo_D2*2.0;
    const double k3 = sr400_tree_geo_D4*2.0;
    const double k4 = sr400_tree_geo_RL4*2.0;
    const double k5 = sr400_tree_geo_D3*2.0;

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

    const double lin6a_6z = s5*beta[35] - c5*beta[34];
    /* link 5: first moments of the link and all that it carries, MSc5 = MS5 + sum of R MSc + Mc p
        of what hangs on it */
    const double MSc5_x = beta[27] - lin6a_6z;
    /* link 4: first moments of the link and all that it carries, MSc4 = MS4 + sum of R MSc + Mc p
        of what hangs on it */
    const double MSc4_z = c4*beta[28] + s4*MSc5_x;
    /* link 3: first moments of the link and all that it carries, MSc3 = MS3 + sum of R MSc + Mc p
        of what hangs on it */
    const double MSc3_y = beta[14] + MSc4_z;
    const double minus_MSc5_z = c5*beta[35] + s5*beta[34];
    const double MSc4_y = beta[21] + minus_MSc5_z;
    const double minus_lin5a_5z = s4*beta[28] - c4*MSc5_x;
    const double MSc4_x = beta[20] - minus_lin5a_5z;
    const double lin4a_4z = s3*MSc4_y - c3*MSc4_x;
    const double MSc3_x = beta[13] - lin4a_4z;
    const double minus_lin3a_3x = c2*MSc3_y + s2*MSc3_x;
    const double minus_lin3a_3y = s2*MSc3_y - c2*MSc3_x;
    const double minus_lin8a_8x = c7*beta[49] + s7*beta[48];
    const double minus_lin8a_8y = s7*beta[49] - c7*beta[48];
    const double t15 = c7*beta[43] - s7*beta[44];
    const double t16 = c7*beta[44];
    const double t17 = s7*t16;
    /* link 7: inertia of the link and all that it carries, Jc7 = J7 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc7_xy = s7*t15 + c7*t16 + beta[37] - sr400_tree_geo_D8*minus_lin8a_8x;
    const double minus_Js8_yy = k1*minus_lin8a_8y;
    const double t20 = c6*(s6*Jc7_xy + c6*(t17 + s7*(s7*beta[43] + t16) - minus_Js8_yy));
    const double t21 = s6*(s6*(c7*t15 - t17 + beta[36]) + c6*Jc7_xy) + t20 + beta[0];
    const double t22 = c5*beta[29] - s5*beta[30];
    MODELER_ZEROS(M + 14, 2);
    const double t23 = c5*beta[30];
    const double t24 = s5*t23;
    /* link 5: inertia of the link and all that it carries, Jc5 = J5 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc5_xx = c5*t22 - t24 + beta[22];
    const double ang6a_6x = c5*beta[31] - s5*beta[32];
    const double Jc5_xy = beta[23] + ang6a_6x;
    const double t28 = s4*Jc5_xy;
    const double t29 = c4*Jc5_xx - t28;
    const double t30 = s4*beta[33];
    const double t31 = c4*Jc5_xy;
    const double t32 = t30 - t31;
    /* link 4: inertia of the link and all that it carries, Jc4 = J4 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc4_xx = c4*t29 + s4*t32 + beta[15];
    const double Jc5_xz = beta[24] - (s5*t22 + c5*t23);
    const double minus_ang6a_6z = s5*beta[31] + c5*beta[32];
    const double Jc5_yz = beta[25] - minus_ang6a_6z;
    const double ang5a_5x = c4*Jc5_xz - s4*Jc5_yz;
    const double Jc4_xy = beta[16] - ang5a_5x;
    const double t39 = s3*Jc4_xy;
    const double t40 = c3*Jc4_xx - t39;
    const double Jc5_zz = t24 + s5*(s5*beta[29] + t23) + beta[26];
    const double t42 = s3*Jc5_zz;
    const double t43 = c3*Jc4_xy;
    const double t44 = t42 - t43;
    MODELER_ZEROS(M + 22, 2);
    const double Js4_xx = k4*MSc4_z;
    /* link 3: inertia of the link and all that it carries, Jc3 = J3 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc3_xx = c3*t40 + s3*t44 + beta[8] + Js4_xx;
    const double Jc4_xz = s4*t29 - c4*t32 + beta[17];
    const double ang5a_5z = s4*Jc5_xz + c4*Jc5_yz;
    const double Jc4_yz = beta[18] - ang5a_5z;
    const double Jc4a_xy = c3*Jc4_xz - s3*Jc4_yz;
    const double t51 = sr400_tree_geo_RL4*lin4a_4z;
    const double Jc3_xy = beta[9] + Jc4a_xy + (t51 - sr400_tree_geo_D4*MSc4_z);
    const double t53 = s2*Jc3_xy;
    const double t54 = c2*Jc3_xx - t53;
    const double t55 = c2*Jc3_xy;
    const double t56 = c4*beta[33];
    const double Jc4_zz = s4*(s4*Jc5_xx + t31) + c4*(t56 + t28) + beta[19];
    const double minus_Js4_yy = k3*lin4a_4z;
    const double Jc3_yy = Jc4_zz - minus_Js4_yy;
    const double t60 = t55 - s2*Jc3_yy;
    /* link 2: inertia of the link and all that it carries, Jc2 = J2 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc2_xy = s2*t54 + c2*t60 + beta[2] - sr400_tree_geo_D3*minus_lin3a_3x;
    const double minus_Js3_yy = k5*minus_lin3a_3y;
    const double t63 = c1*(s1*Jc2_xy + c1*(s2*(s2*Jc3_xx + t55) + c2*(t53 + c2*Jc3_yy) -
        minus_Js3_yy));
    /* link 1: inertia of the link and all that it carries, Jc1 = J1 + sum of R Jc R' + Js of what
        hangs on it */
    const double minus_Jc1_zz = k2*(s6*(beta[42] + minus_lin8a_8x) - c6*(beta[41] - minus_lin8a_8y))
        - t21;
    const double t65 = minus_Jc1_zz - (s1*(s1*(c2*t54 - s2*t60 + beta[1]) + c1*Jc2_xy) + t63);
    M[0] = -(k2*(s1*(beta[7] + minus_lin3a_3x) - c1*(beta[6] - minus_lin3a_3y)) + t65);
    MODELER_ZEROS(M + 30, 2);
    const double minus_MSc3_z = c3*MSc4_y + s3*MSc4_x;
    const double Jc3_xz = c3*t44 - s3*t40 + beta[10] + sr400_tree_geo_D4*minus_MSc3_z;
    const double Js4_yz = sr400_tree_geo_RL4*minus_MSc3_z;
    const double minus_Jc4a_yz = s3*Jc4_xz + c3*Jc4_yz;
    const double Jc3_yz = beta[11] - minus_Jc4a_yz + Js4_yz;
    const double ang3a_3x = c2*Jc3_xz - s2*Jc3_yz;
    const double ang3a_3y = s2*Jc3_xz + c2*Jc3_yz;
    const double minus_ang2a_2z = s1*(beta[3] + ang3a_3x + sr400_tree_geo_D3*minus_MSc3_z) +
        c1*(beta[4] + ang3a_3y);
    M[1] = -minus_ang2a_2z;
    const double minus_ang2a_3z = s1*ang3a_3x + c1*ang3a_3y;
    M[2] = -minus_ang2a_3z;
    const double ang4a_4x = Jc4a_xy + t51;
    const double ang4a_4y = Jc4_zz - sr400_tree_geo_D4*lin4a_4z;
    const double t77 = s1*(c2*ang4a_4x - s2*ang4a_4y) + c1*(s2*ang4a_4x + c2*ang4a_4y -
        sr400_tree_geo_D3*lin4a_4z);
    const double minus_ang2a_4z = t77 - sr400_tree_geo_D2*lin4a_4z;
    M[3] = -minus_ang2a_4z;
    const double lin4a_5z = s3*MSc4_z;
    const double ang4a_5x = c3*ang5a_5x + t42 + sr400_tree_geo_RL4*lin4a_5z;
    const double ang4a_5y = ang5a_5z - sr400_tree_geo_D4*lin4a_5z;
    const double t82 = s1*(c2*ang4a_5x - s2*ang4a_5y) + c1*(s2*ang4a_5x + c2*ang4a_5y -
        sr400_tree_geo_D3*lin4a_5z);
    const double minus_ang2a_5z = t82 - sr400_tree_geo_D2*lin4a_5z;
    MODELER_ZEROS(M + 38, 2);
    M[4] = -minus_ang2a_5z;
    const double ang5a_6x = c4*ang6a_6x - t30;
    const double minus_lin5a_6x = c4*minus_MSc5_z;
    const double lin4a_6z = s3*minus_lin5a_6x + c3*lin6a_6z;
    const double ang4a_6x = c3*ang5a_6x - s3*minus_ang6a_6z + sr400_tree_geo_RL4*lin4a_6z;
    const double ang5a_6z = s4*ang6a_6x + t56;
    const double ang4a_6y = ang5a_6z - sr400_tree_geo_D4*lin4a_6z;
    const double t90 = s1*(c2*ang4a_6x - s2*ang4a_6y) + c1*(s2*ang4a_6x + c2*ang4a_6y -
        sr400_tree_geo_D3*lin4a_6z);
    const double minus_ang2a_6z = t90 - sr400_tree_geo_D2*lin4a_6z;
    M[5] = -minus_ang2a_6z;
    const double ang8a_8x = c7*beta[45] - s7*beta[46];
    const double ang8a_8y = s7*beta[45] + c7*beta[46];
    const double minus_Jc1_yz = s6*(beta[38] + ang8a_8x) + c6*(beta[39] + ang8a_8y);
    M[6] = -minus_Jc1_yz;
    const double minus_ang7a_8z = s6*ang8a_8x + c6*ang8a_8y;
    M[7] = -minus_ang7a_8z;
    M[8] = -minus_ang2a_2z;
    const double t96 = c3*Jc5_zz;
    const double Jc3_zz = s3*(s3*Jc4_xx + t43) + c3*(t96 + t39) + beta[12] + (Js4_xx -
        minus_Js4_yy);
    M[9] = beta[5] + Jc3_zz - minus_Js3_yy;
    const double ang3a_3z = Jc3_zz - sr400_tree_geo_D3*minus_lin3a_3y;
    M[10] = ang3a_3z;
    MODELER_ZEROS(M + 46, 2);
    const double minus_ang4a_4z = minus_Jc4a_yz - Js4_yz;
    const double minus_ang3a_4z = minus_ang4a_4z + s2*minus_MSc3_z*sr400_tree_geo_D3;
    M[11] = -minus_ang3a_4z;
    const double minus_lin4a_5x = c3*MSc4_z;
    const double minus_ang4a_5z = s3*ang5a_5x - t96 + (sr400_tree_geo_D4*minus_lin5a_5z -
        sr400_tree_geo_RL4*minus_lin4a_5x);
    const double minus_ang3a_5z = minus_ang4a_5z + sr400_tree_geo_D3*(s2*minus_lin4a_5x +
        c2*minus_lin5a_5z);
    M[12] = -minus_ang3a_5z;
    const double minus_lin5a_6z = s4*minus_MSc5_z;
    const double minus_lin4a_6x = c3*minus_lin5a_6x - s3*lin6a_6z;
    const double minus_ang4a_6z = s3*ang5a_6x + c3*minus_ang6a_6z +
        (sr400_tree_geo_D4*minus_lin5a_6z - sr400_tree_geo_RL4*minus_lin4a_6x);
    const double minus_ang3a_6z = minus_ang4a_6z + sr400_tree_geo_D3*(s2*minus_lin4a_6x +
        c2*minus_lin5a_6z);
    M[13] = -minus_ang3a_6z;
    M[16] = -minus_ang2a_3z;
    M[17] = ang3a_3z;
    M[18] = Jc3_zz;
    M[19] = -minus_ang4a_4z;
    M[20] = -minus_ang4a_5z;
    M[21] = -minus_ang4a_6z;
    M[24] = -minus_ang2a_4z;
    M[25] = -minus_ang3a_4z;
    M[26] = -minus_ang4a_4z;
    M[27] = Jc4_zz;
    MODELER_ZEROS(M + 49, 5);
    M[28] = ang5a_5z;
    M[29] = ang5a_6z;
    M[32] = -minus_ang2a_5z;
    M[33] = -minus_ang3a_5z;
    M[34] = -minus_ang4a_5z;
    M[35] = ang5a_5z;
    M[36] = Jc5_zz;
    M[37] = -minus_ang6a_6z;
    M[40] = -minus_ang2a_6z;
    M[41] = -minus_ang3a_6z;
    M[42] = -minus_ang4a_6z;
    M[43] = ang5a_6z;
    M[44] = -minus_ang6a_6z;
    M[45] = beta[33];
    M[48] = -minus_Jc1_yz;
    M[54] = beta[40] + beta[47] - minus_Js8_yy;
    const double ang8a_8z = beta[47] - sr400_tree_geo_D8*minus_lin8a_8y;
    M[55] = ang8a_8z;
    M[56] = -minus_ang7a_8z;
    M[62] = ang8a_8z;
    M[63] = beta[47];
    MODELER_ZEROS(M + 57, 5);
}

/* Torques that hold the robot still, without friction.
 * 29 additions, 52 multiplications. */
void sr400_tree_gravity(const double q[SR400_TREE_JOINTS],
                        const double beta[SR400_TREE_BASE_PARAMETERS],
                        double MODELER_OUT(tau, SR400_TREE_JOINTS))
{
    tau[0] = 0.0;

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

    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = sr400_tree_geo_g*c1;
    const double minus_vd2_x = sr400_tree_geo_g*s1;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3_y = c2*minus_vd2_y - s2*minus_vd2_x;
    const double minus_vd3_x = c2*minus_vd2_x + s2*minus_vd2_y;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_x = c3*minus_vd3_x;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c4*minus_vd3_y - s4*minus_vd4_x;
    /* link 6: moment on the link at its origin, n6 = J6 wd6 + w6 x J6 w6 + MS6 x vd6 */
    const double minus_n6_x = beta[35]*minus_vd5_y;
    const double n6_y = beta[34]*minus_vd5_y;
    const double vd4_y = s3*minus_vd3_x;
    /* link 5: moment on the link and all that it carries, nc5 = n5 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc5_x = c5*minus_n6_x + s5*n6_y + beta[28]*vd4_y;
    const double minus_vd5_x = c4*minus_vd4_x + s4*minus_vd3_y;
    const double n6_z = beta[34]*(c5*vd4_y + s5*minus_vd5_x) + beta[35]*(c5*minus_vd5_x - s5*vd4_y);
    const double nc5_y = n6_z + beta[27]*vd4_y;
    const double nc5_z = s5*minus_n6_x - c5*n6_y + (beta[28]*minus_vd5_x - beta[27]*minus_vd5_y);
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc4a_z = s3*(c4*minus_nc5_x + s4*nc5_y + beta[21]*minus_vd3_y) + c3*(nc5_z -
        beta[20]*minus_vd3_y);
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc3_z = beta[14]*minus_vd3_x - beta[13]*minus_vd3_y + nc4a_z;
    tau[1] = minus_vd2_x*beta[7] - minus_vd2_y*beta[6] + nc3_z;
    tau[2] = nc3_z;
    tau[3] = beta[20]*vd4_y + beta[21]*minus_vd4_x - (s4*minus_nc5_x - c4*nc5_y);
    tau[4] = nc5_z;
    tau[5] = n6_z;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_tree_geo_g*c6;
    const double minus_vd7_x = sr400_tree_geo_g*s6;
    /* link 8: moment on the link at its origin, n8 = J8 wd8 + w8 x J8 w8 + MS8 x vd8 */
    const double minus_n8_z = beta[48]*(c7*minus_vd7_y - s7*minus_vd7_x) - beta[49]*(c7*minus_vd7_x
        + s7*minus_vd7_y);
    tau[6] = -(minus_vd7_y*beta[41] - minus_vd7_x*beta[42] + minus_n8_z);
    tau[7] = -minus_n8_z;
}

/* Coriolis and centripetal torques.
 * 267 additions, 376 multiplications. */
void sr400_tree_coriolis(const double q[SR400_TREE_JOINTS], const double qd[SR400_TREE_JOINTS],
                         const double beta[SR400_TREE_BASE_PARAMETERS],
                         double MODELER_OUT(tau, SR400_TREE_JOINTS))
{
    const double k1 = sr400_tree_geo_D8*2.0;
    const double k2 = sr400_tree_geo_D4*2.0;
    const double k3 = sr400_tree_geo_RL4*2.0;
    const double k4 = sr400_tree_geo_D3*2.0;

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

    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const double minus_w7_y = c6*qd[0];
    const double minus_w7_x = s6*qd[0];
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const double minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    const double w8_z = qd[6] + qd[7];
    const double minus_ww8_yz = minus_w8_y*w8_z;
    const double minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const double minus_ww8_xz = minus_w8_x*w8_z;
    const double minus_h8_z = minus_w8_x*beta[45] + minus_w8_y*beta[46] - w8_z*beta[47];
    const double minus_h8_y = minus_w8_x*beta[44] - w8_z*beta[46];
    const double minus_ww7_xz = qd[6]*minus_w7_x;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double minus_vd8_z = k1*minus_ww7_xz;
    /* link 8: moment on the link at its origin, n8 = J8 wd8 + w8 x J8 w8 + MS8 x vd8 */
    const double minus_n8_x = minus_ww8_yz*beta[43] - minus_ww8_xz*beta[44] - (minus_w8_y*minus_h8_z
        + w8_z*minus_h8_y) + beta[49]*minus_vd8_z;
    const double minus_h8_x = minus_w8_x*beta[43] + minus_w8_y*beta[44] - w8_z*beta[45];
    const double minus_n8_y = w8_z*minus_h8_x + minus_w8_x*minus_h8_z + minus_ww8_yz*beta[44] -
        beta[48]*minus_vd8_z;
    const double minus_ww7_yz = qd[6]*minus_w7_y;
    const double minus_h7_z = minus_w7_x*beta[38] + minus_w7_y*beta[39] - qd[6]*beta[40];
    const double minus_h7_y = minus_w7_x*beta[37] - qd[6]*beta[39];
    /* link 7: moment on the link and all that it carries, nc7 = n7 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc7_x = c7*minus_n8_x - s7*minus_n8_y + (minus_ww7_yz*beta[36] -
        minus_ww7_xz*beta[37] - (minus_w7_y*minus_h7_z + qd[6]*minus_h7_y));
    /* link 8: force on the link, f8 = M8 vd8 + U8 MS8 */
    const double minus_f8_z = 2.0*minus_ww8_xz*beta[48] + 2.0*minus_ww8_yz*beta[49];
    const double minus_h7_x = minus_w7_x*beta[36] + minus_w7_y*beta[37] - qd[6]*beta[38];
    /* link 8: moment on the link and all that it carries, nc8 = n8 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc8a_y = s7*minus_n8_x + c7*minus_n8_y - sr400_tree_geo_D8*minus_f8_z;
    const double t22 = sr400_tree_geo_D2*(2.0*minus_ww7_xz*beta[41] + 2.0*minus_ww7_yz*beta[42] +
        minus_f8_z);
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double w3_z = qd[1] + qd[2];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_x = s1*qd[0];
    const double minus_w2_y = c1*qd[0];
    const double minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c3*w3_z - s3*minus_w3_x;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_z = qd[4] + minus_w4_y;
    const double minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const double minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    const double w4_z = qd[3] - minus_w3_y;
    const double minus_w5_x = c4*minus_w4_x - s4*w4_z;
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c5*w5_z - s5*minus_w5_x;
    const double w5_y = c4*w4_z + s4*minus_w4_x;
    const double minus_ww3_yz = minus_w3_y*w3_z;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = qd[3]*minus_w4_y + c3*minus_ww3_yz;
    const double minus_ww3_xz = minus_w3_x*w3_z;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double wd5_x = s4*minus_ww3_xz - c4*minus_wd4_x + qd[4]*w5_y;
    const double wd4_y = qd[3]*minus_w4_x + s3*minus_ww3_yz;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = qd[5]*minus_w6_y - (c5*wd5_x + s5*wd4_y);
    const double minus_w6_x = c5*minus_w5_x + s5*w5_z;
    const double wd6_y = c5*wd4_y - s5*wd5_x + qd[5]*minus_w6_x;
    const double wd5_y = c4*minus_ww3_xz + s4*minus_wd4_x + qd[4]*minus_w5_x;
    const double w6_z = qd[5] + w5_y;
    const double minus_h6_z = minus_w6_x*beta[31] + minus_w6_y*beta[32] - w6_z*beta[33];
    const double minus_h6_y = minus_w6_x*beta[30] - w6_z*beta[32];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2a_x = qd[0]*qd[0]*sr400_tree_geo_D2;
    const double vd2_y = s1*minus_vd2a_x;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3a_y = vd2_y + minus_w2_x*minus_w2_y*sr400_tree_geo_D3;
    const double minus_vd2_x = c1*minus_vd2a_x;
    const double minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*(minus_w2_y*minus_w2_y +
        qd[1]*qd[1]);
    const double vd3_y = c2*vd3a_y + s2*minus_vd3a_x;
    const double ww3_zz = w3_z*w3_z;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double vd4_z = sr400_tree_geo_D4*ww3_xy - sr400_tree_geo_RL4*minus_U3_yy + vd3_y;
    const double minus_vd3_x = c2*minus_vd3a_x - s2*vd3a_y;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx - sr400_tree_geo_RL4*ww3_xy +
        minus_vd3_x;
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    const double minus_vd3_z = k4*minus_ww2_xz;
    const double minus_vd4a_z = k2*minus_ww3_xz + k3*minus_ww3_yz + minus_vd3_z;
    const double minus_vd4_x = c3*minus_vd4a_x - s3*minus_vd4a_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double vd5_y = c4*vd4_z + s4*minus_vd4_x;
    const double t65 = beta[29]*minus_wd6_x - beta[30]*wd6_y - beta[31]*wd5_y -
        (minus_w6_y*minus_h6_z + w6_z*minus_h6_y);
    /* link 6: moment on the link at its origin, n6 = J6 wd6 + w6 x J6 w6 + MS6 x vd6 */
    const double minus_n6_x = t65 - beta[35]*vd5_y;
    const double minus_h6_x = minus_w6_x*beta[29] + minus_w6_y*beta[30] - w6_z*beta[31];
    const double minus_n6_y = beta[30]*minus_wd6_x - beta[32]*wd5_y + (w6_z*minus_h6_x +
        minus_w6_x*minus_h6_z) + beta[34]*vd5_y;
    const double minus_h5_z = minus_w5_x*beta[24] - w5_y*beta[25] - w5_z*beta[26];
    const double minus_h5_y = minus_w5_x*beta[23] - w5_z*beta[25];
    const double vd4_y = c3*minus_vd4a_z + s3*minus_vd4a_x;
    const double t72 = beta[22]*wd5_x + beta[23]*wd5_y - beta[24]*wd4_y + (w5_z*minus_h5_y -
        w5_y*minus_h5_z);
    /* link 5: moment on the link and all that it carries, nc5 = n5 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc5_x = c5*minus_n6_x - s5*minus_n6_y + (beta[28]*vd4_y - t72);
    const double minus_vd5_x = c4*minus_vd4_x - s4*vd4_z;
    const double t75 = beta[31]*minus_wd6_x - beta[32]*wd6_y - beta[33]*wd5_y +
        (minus_w6_y*minus_h6_x - minus_w6_x*minus_h6_y);
    const double minus_n6_z = t75 - (beta[34]*(c5*vd4_y + s5*minus_vd5_x) + beta[35]*(c5*minus_vd5_x
        - s5*vd4_y));
    const double minus_h5_x = minus_w5_x*beta[22] - w5_y*beta[23] - w5_z*beta[24];
    const double minus_nc5_y = minus_n6_z - (beta[23]*wd5_x - beta[25]*wd4_y - (w5_z*minus_h5_x +
        minus_w5_x*minus_h5_z) + beta[27]*vd4_y);
    const double minus_h4_z = minus_w4_x*beta[17] + minus_w4_y*beta[18] - w4_z*beta[19];
    const double minus_h4_y = minus_w4_x*beta[16] - w4_z*beta[18];
    const double t81 = beta[15]*minus_wd4_x - beta[16]*wd4_y - minus_ww3_xz*beta[17] -
        (minus_w4_y*minus_h4_z + w4_z*minus_h4_y);
    /* link 4: moment on the link and all that it carries, nc4 = n4 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc4_x = c4*minus_nc5_x - s4*minus_nc5_y + (t81 - beta[21]*vd4_z);
    const double t83 = beta[24]*wd5_x + beta[25]*wd5_y - beta[26]*wd4_y + (minus_w5_x*minus_h5_y +
        w5_y*minus_h5_x);
    const double nc5_z = s5*minus_n6_x + c5*minus_n6_y + (beta[27]*vd5_y + beta[28]*minus_vd5_x +
        t83);
    const double minus_h4_x = minus_w4_x*beta[15] + minus_w4_y*beta[16] - w4_z*beta[17];
    const double minus_nc4_y = beta[16]*minus_wd4_x - minus_ww3_xz*beta[18] + (w4_z*minus_h4_x +
        minus_w4_x*minus_h4_z) + beta[20]*vd4_z + nc5_z;
    const double ww6_zz = w6_z*w6_z;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    /* link 6: force on the link, f6 = M6 vd6 + U6 MS6 */
    const double minus_f6_x = (minus_w6_y*minus_w6_y + ww6_zz)*beta[34] - beta[35]*(ww6_xy - wd5_y);
    const double f6_y = beta[34]*(ww6_xy + wd5_y) - (minus_w6_x*minus_w6_x + ww6_zz)*beta[35];
    const double ww5_zz = w5_z*w5_z;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    /* link 5: force on the link and all that it carries, fc5 = f5 + sum of R fc of what hangs on it
        */
    const double minus_fc5_x = c5*minus_f6_x + s5*f6_y + ((w5_y*w5_y + ww5_zz)*beta[27] +
        beta[28]*(minus_ww5_xy - wd4_y));
    const double minus_f6_z = beta[34]*(minus_w6_x*w6_z + wd6_y) + beta[35]*(minus_w6_y*w6_z +
        minus_wd6_x);
    const double minus_fc5_y = beta[27]*(minus_ww5_xy + wd4_y) + (minus_w5_x*minus_w5_x +
        ww5_zz)*beta[28] + minus_f6_z;
    const double ww4_zz = w4_z*w4_z;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    /* link 4: force on the link and all that it carries, fc4 = f4 + sum of R fc of what hangs on it
        */
    const double minus_fc4_x = c4*minus_fc5_x - s4*minus_fc5_y + ((minus_w4_y*minus_w4_y +
        ww4_zz)*beta[20] + beta[21]*(minus_ww3_xz - ww4_xy));
    const double fc5_z = s5*minus_f6_x - c5*f6_y + (beta[28]*(w5_y*w5_z + wd5_x) -
        beta[27]*(minus_w5_x*w5_z + wd5_y));
    const double minus_fc4_y = (minus_w4_x*minus_w4_x + ww4_zz)*beta[21] - beta[20]*(minus_ww3_xz +
        ww4_xy) + fc5_z;
    const double fc4a_z = s3*minus_fc4_x + c3*minus_fc4_y;
    const double minus_h3_z = minus_w3_x*beta[10] + minus_w3_y*beta[11] - w3_z*beta[12];
    const double minus_h3_y = minus_w3_x*beta[9] - w3_z*beta[11];
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_x = minus_ww3_yz*beta[8] - minus_ww3_xz*beta[9] - (minus_w3_y*minus_h3_z +
        w3_z*minus_h3_y) + beta[14]*minus_vd3_z;
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc3_x = c3*minus_nc4_x - s3*minus_nc4_y - sr400_tree_geo_RL4*fc4a_z +
        minus_n3_x;
    const double t106 = beta[17]*minus_wd4_x - beta[18]*wd4_y - minus_ww3_xz*beta[19] +
        (minus_w4_y*minus_h4_x - minus_w4_x*minus_h4_y);
    const double minus_nc4_z = s4*minus_nc5_x + c4*minus_nc5_y + (t106 - (beta[20]*vd4_y +
        beta[21]*minus_vd4_x));
    const double minus_h3_x = minus_w3_x*beta[8] + minus_w3_y*beta[9] - w3_z*beta[10];
    const double minus_n3_y = w3_z*minus_h3_x + minus_w3_x*minus_h3_z + minus_ww3_yz*beta[9] -
        beta[13]*minus_vd3_z;
    const double minus_nc3_y = minus_nc4_z + sr400_tree_geo_D4*fc4a_z + minus_n3_y;
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    const double minus_h2_z = minus_w2_x*beta[3] + minus_w2_y*beta[4] - qd[1]*beta[5];
    const double minus_h2_y = minus_w2_x*beta[2] - qd[1]*beta[4];
    /* link 2: moment on the link and all that it carries, nc2 = n2 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc2_x = c2*minus_nc3_x - s2*minus_nc3_y + (minus_ww2_yz*beta[1] -
        minus_ww2_xz*beta[2] - (minus_w2_y*minus_h2_z + qd[1]*minus_h2_y));
    /* link 3: force on the link and all that it carries, fc3 = f3 + sum of R fc of what hangs on it
        */
    const double fc3_z = fc4a_z - (2.0*minus_ww3_xz*beta[13] + 2.0*minus_ww3_yz*beta[14]);
    const double minus_h2_x = minus_w2_x*beta[1] + minus_w2_y*beta[2] - qd[1]*beta[3];
    const double minus_nc3a_y = s2*minus_nc3_x + c2*minus_nc3_y + sr400_tree_geo_D3*fc3_z;
    const double t118 = sr400_tree_geo_D2*(fc3_z - (2.0*minus_ww2_xz*beta[6] +
        2.0*minus_ww2_yz*beta[7]));
    const double nc2a_z = s1*minus_nc2_x + c1*(qd[1]*minus_h2_x + minus_w2_x*minus_h2_z +
        minus_ww2_yz*beta[2] + minus_nc3a_y) + t118;
    tau[0] = s6*minus_nc7_x + c6*(qd[6]*minus_h7_x + minus_w7_x*minus_h7_z + minus_ww7_yz*beta[37] +
        minus_nc8a_y) - t22 + nc2a_z;
    const double minus_fc4_z = s4*minus_fc5_x + c4*minus_fc5_y + (beta[20]*(minus_w4_x*w4_z + wd4_y)
        + beta[21]*(minus_w4_y*w4_z + minus_wd4_x));
    const double minus_fc4a_x = c3*minus_fc4_x - s3*minus_fc4_y;
    const double t122 = minus_ww3_yz*beta[10] - minus_ww3_xz*beta[11] + (minus_w3_y*minus_h3_x -
        minus_w3_x*minus_h3_y);
    const double nc4a_z = s3*minus_nc4_x + c3*minus_nc4_y + (sr400_tree_geo_RL4*minus_fc4a_x -
        sr400_tree_geo_D4*minus_fc4_z);
    const double nc3_z = beta[13]*vd3_y + beta[14]*minus_vd3_x - t122 + nc4a_z;
    const double t125 = s2*(minus_U3_xx*beta[13] - ww3_xy*beta[14] + minus_fc4a_x);
    const double t126 = minus_ww2_yz*beta[3] - minus_ww2_xz*beta[4] + (minus_w2_y*minus_h2_x -
        minus_w2_x*minus_h2_y);
    const double nc3a_z = nc3_z - sr400_tree_geo_D3*(t125 + c2*(minus_U3_yy*beta[14] -
        ww3_xy*beta[13] + minus_fc4_z));
    tau[1] = vd2_y*beta[6] + minus_vd2_x*beta[7] - t126 + nc3a_z;
    tau[2] = nc3_z;
    tau[3] = -minus_nc4_z;
    tau[4] = nc5_z;
    tau[5] = -minus_n6_z;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double vd7_y = s6*minus_vd2a_x;
    const double vd8a_y = vd7_y + minus_w7_x*minus_w7_y*sr400_tree_geo_D8;
    const double minus_vd7_x = c6*minus_vd2a_x;
    const double minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*(minus_w7_y*minus_w7_y +
        qd[6]*qd[6]);
    const double t132 = beta[48]*(c7*vd8a_y + s7*minus_vd8a_x) + beta[49]*(c7*minus_vd8a_x -
        s7*vd8a_y);
    const double minus_n8_z = minus_ww8_yz*beta[45] - minus_ww8_xz*beta[46] + (minus_w8_y*minus_h8_x
        - minus_w8_x*minus_h8_y) - t132;
    const double ww8_zz = w8_z*w8_z;
    const double ww8_xy = minus_w8_x*minus_w8_y;
    const double t136 = s7*((minus_w8_y*minus_w8_y + ww8_zz)*beta[48] - ww8_xy*beta[49]);
    const double t137 = sr400_tree_geo_D8*(t136 - c7*(ww8_xy*beta[48] - (minus_w8_x*minus_w8_x +
        ww8_zz)*beta[49]));
    const double t138 = minus_ww7_yz*beta[38] - minus_ww7_xz*beta[39] + (minus_w7_y*minus_h7_x -
        minus_w7_x*minus_h7_y);
    tau[6] = -(minus_n8_z + t137 + (t138 - (vd7_y*beta[41] + minus_vd7_x*beta[42])));
    tau[7] = -minus_n8_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void sr400_tree_friction(const double qd[SR400_TREE_JOINTS],
                         const double beta[SR400_TREE_BASE_PARAMETERS],
                         double MODELER_OUT(tau, SR400_TREE_JOINTS))
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
    tau[6] = 0.0;
    tau[7] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 62 additions, 36 multiplications. */
void sr400_tree_base_parameters(const double chi[SR400_TREE_STANDARD_PARAMETERS],
                                double MODELER_OUT(beta, SR400_TREE_BASE_PARAMETERS))
{
    const double k1 = sr400_tree_geo_D2*sr400_tree_geo_D2;
    const double k2 = sr400_tree_geo_D8*sr400_tree_geo_D8;
    const double k3 = sr400_tree_geo_D4*sr400_tree_geo_D4;
    const double k4 = sr400_tree_geo_RL4*2.0;
    const double k5 = sr400_tree_geo_RL4*sr400_tree_geo_RL4;
    const double k6 = sr400_tree_geo_D4*sr400_tree_geo_RL4;
    const double k7 = sr400_tree_geo_D3*sr400_tree_geo_D3;
    const double k8 = k1 + k7;
    const double k9 = k3 + k8;
    const double k10 = k1 + k2;
    const double k11 = k3 - k5;
    const double k12 = k3 + k5;

    const double t1 = chi[5] + chi[13] + k1*chi[19] + chi[23] + k8*chi[29] + k9*chi[39];
    const double t2 = t1 + k9*chi[49] + k9*chi[59] + chi[63] + k1*chi[69] + chi[73];
    beta[0] = t2 + k10*chi[79];
    const double t3 = k7*chi[29];
    const double t4 = k7*chi[39];
    const double t5 = k7*chi[49];
    const double t6 = k7*chi[59];
    beta[1] = chi[10] - chi[13] - t3 - t4 - t5 - t6;
    beta[2] = chi[11];
    beta[3] = chi[12] - sr400_tree_geo_D3*chi[28];
    beta[4] = chi[14];
    beta[5] = chi[15] + t3 + t4 + t5 + t6;
    const double t7 = chi[16] + sr400_tree_geo_D3*chi[29] + sr400_tree_geo_D3*chi[39];
    beta[6] = t7 + sr400_tree_geo_D3*chi[49] + sr400_tree_geo_D3*chi[59];
    beta[7] = chi[17];
    const double t8 = k4*chi[38];
    beta[8] = chi[20] - chi[23] + chi[33] + t8 - k11*chi[39] - k11*chi[49] - k11*chi[59];
    beta[9] = chi[21] - sr400_tree_geo_D4*chi[38] - k6*chi[39] - k6*chi[49] - k6*chi[59];
    beta[10] = chi[22];
    beta[11] = chi[24];
    beta[12] = chi[25] + chi[33] + t8 + k12*chi[39] + k12*chi[49] + k12*chi[59];
    const double t9 = chi[26] + sr400_tree_geo_D4*chi[39] + sr400_tree_geo_D4*chi[49];
    beta[13] = t9 + sr400_tree_geo_D4*chi[59];
    const double t10 = chi[27] + chi[38] + sr400_tree_geo_RL4*chi[39];
    beta[14] = t10 + sr400_tree_geo_RL4*chi[49] + sr400_tree_geo_RL4*chi[59];
    beta[15] = chi[30] - chi[33] + chi[43];
    beta[16] = chi[31];
    beta[17] = chi[32];
    beta[18] = chi[34];
    beta[19] = chi[35] + chi[43];
    beta[20] = chi[36];
    beta[21] = chi[37] - chi[48];
    beta[22] = chi[40] - chi[43] + chi[53];
    beta[23] = chi[41];
    beta[24] = chi[42];
    beta[25] = chi[44];
    beta[26] = chi[45] + chi[53];
    beta[27] = chi[46];
    beta[28] = chi[47] + chi[58];
    beta[29] = chi[50] - chi[53];
    beta[30] = chi[51];
    beta[31] = chi[52];
    beta[32] = chi[54];
    beta[33] = chi[55];
    beta[34] = chi[56];
    beta[35] = chi[57];
    const double t11 = k2*chi[79];
    beta[36] = chi[60] - chi[63] - t11;
    beta[37] = chi[61];
    beta[38] = chi[62] - sr400_tree_geo_D8*chi[78];
    beta[39] = chi[64];
    beta[40] = chi[65] + t11;
    beta[41] = chi[66] + sr400_tree_geo_D8*chi[79];
    beta[42] = chi[67];
    beta[43] = chi[70] - chi[73];
    beta[44] = chi[71];
    beta[45] = chi[72];
    beta[46] = chi[74];
    beta[47] = chi[75];
    beta[48] = chi[76];
    beta[49] = chi[77];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 38 additions, 80 multiplications. */
void sr400_tree_forward_kinematics(const double q[SR400_TREE_JOINTS],
                                   double MODELER_OUT(T, 8 * 3 * 4))
{
    T[2] = 0.0;
    T[3] = 0.0;
    T[6] = 0.0;
    T[7] = 0.0;
    T[8] = 0.0;
    T[9] = 0.0;
    T[11] = 0.0;
    T[22] = 0.0;
    T[23] = 0.0;
    T[34] = 0.0;
    T[82] = 0.0;
    T[83] = 0.0;
    T[94] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
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

    T[0] = c0;
    T[1] = -s0;
    T[4] = s0;
    T[5] = c0;
    T[10] = 1.0;
    const double x2_x = c0*c1;
    T[12] = x2_x;
    const double minus_y2_x = c0*s1;
    T[13] = -minus_y2_x;
    T[14] = -s0;
    /* link 2: origin of the frame in frame 0, o2 = o1 + [x1 y1 z1] p2 */
    const double o2_x = sr400_tree_geo_D2*c0;
    T[15] = o2_x;
    const double x2_y = s0*c1;
    T[16] = x2_y;
    const double minus_y2_y = s0*s1;
    T[17] = -minus_y2_y;
    T[18] = c0;
    const double o2_y = sr400_tree_geo_D2*s0;
    T[19] = o2_y;
    T[20] = -s1;
    T[21] = -c1;
    const double x3_x = c2*x2_x - s2*minus_y2_x;
    T[24] = x3_x;
    const double minus_y3_x = c2*minus_y2_x + s2*x2_x;
    T[25] = -minus_y3_x;
    T[26] = -s0;
    /* link 3: origin of the frame in frame 0, o3 = o2 + [x2 y2 z2] p3 */
    const double o3_x = o2_x + sr400_tree_geo_D3*x2_x;
    T[27] = o3_x;
    const double x3_y = c2*x2_y - s2*minus_y2_y;
    T[28] = x3_y;
    const double minus_y3_y = c2*minus_y2_y + s2*x2_y;
    T[29] = -minus_y3_y;
    T[30] = c0;
    const double o3_y = o2_y + sr400_tree_geo_D3*x2_y;
    T[31] = o3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double minus_e3_1x = s1*c2 + c1*s2;
    T[32] = -minus_e3_1x;
    const double minus_e3_1y = c1*c2 - s1*s2;
    T[33] = -minus_e3_1y;
    const double minus_o3_z = sr400_tree_geo_D3*s1;
    T[35] = -minus_o3_z;
    const double x4_x = c3*x3_x + s0*s3;
    T[36] = x4_x;
    const double y4_x = s0*c3 - s3*x3_x;
    T[37] = y4_x;
    T[38] = -minus_y3_x;
    /* link 4: origin of the frame in frame 0, o4 = o3 + [x3 y3 z3] p4 */
    const double o4_x = o3_x + sr400_tree_geo_D4*x3_x - sr400_tree_geo_RL4*minus_y3_x;
    T[39] = o4_x;
    const double x4_y = c3*x3_y - c0*s3;
    T[40] = x4_y;
    const double minus_y4_y = c0*c3 + s3*x3_y;
    T[41] = -minus_y4_y;
    T[42] = -minus_y3_y;
    const double o4_y = o3_y + sr400_tree_geo_D4*x3_y - sr400_tree_geo_RL4*minus_y3_y;
    T[43] = o4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c3*minus_e3_1x;
    T[44] = -minus_e4_1x;
    const double e4_1y = s3*minus_e3_1x;
    T[45] = e4_1y;
    T[46] = -minus_e3_1y;
    const double minus_o4_z = minus_o3_z + sr400_tree_geo_D4*minus_e3_1x +
        sr400_tree_geo_RL4*minus_e3_1y;
    T[47] = -minus_o4_z;
    const double x5_x = c4*x4_x - s4*minus_y3_x;
    T[48] = x5_x;
    const double minus_y5_x = c4*minus_y3_x + s4*x4_x;
    T[49] = -minus_y5_x;
    T[50] = -y4_x;
    T[51] = o4_x;
    const double x5_y = c4*x4_y - s4*minus_y3_y;
    T[52] = x5_y;
    const double minus_y5_y = c4*minus_y3_y + s4*x4_y;
    T[53] = -minus_y5_y;
    T[54] = minus_y4_y;
    T[55] = o4_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_1x = c4*minus_e4_1x + s4*minus_e3_1y;
    T[56] = -minus_e5_1x;
    const double minus_e5_1y = c4*minus_e3_1y - s4*minus_e4_1x;
    T[57] = -minus_e5_1y;
    T[58] = -e4_1y;
    T[59] = -minus_o4_z;
    T[60] = c5*x5_x + s5*y4_x;
    T[61] = c5*y4_x - s5*x5_x;
    T[62] = -minus_y5_x;
    T[63] = o4_x;
    T[64] = c5*x5_y - s5*minus_y4_y;
    T[65] = -(c5*minus_y4_y + s5*x5_y);
    T[66] = -minus_y5_y;
    T[67] = o4_y;
    T[68] = s5*e4_1y - c5*minus_e5_1x;
    T[69] = c5*e4_1y + s5*minus_e5_1x;
    T[70] = -minus_e5_1y;
    T[71] = -minus_o4_z;
    const double x7_x = c0*c6;
    T[72] = x7_x;
    const double minus_y7_x = c0*s6;
    T[73] = -minus_y7_x;
    T[74] = -s0;
    T[75] = o2_x;
    const double x7_y = s0*c6;
    T[76] = x7_y;
    const double minus_y7_y = s0*s6;
    T[77] = -minus_y7_y;
    T[78] = c0;
    T[79] = o2_y;
    T[80] = -s6;
    T[81] = -c6;
    T[84] = c7*x7_x - s7*minus_y7_x;
    T[85] = -(c7*minus_y7_x + s7*x7_x);
    T[86] = -s0;
    T[87] = o2_x + sr400_tree_geo_D8*x7_x;
    T[88] = c7*x7_y - s7*minus_y7_y;
    T[89] = -(c7*minus_y7_y + s7*x7_y);
    T[90] = c0;
    T[91] = o2_y + sr400_tree_geo_D8*x7_y;
    T[92] = -(s6*c7 + c6*s7);
    T[93] = s6*s7 - c6*c7;
    T[95] = -sr400_tree_geo_D8*s6;
}
