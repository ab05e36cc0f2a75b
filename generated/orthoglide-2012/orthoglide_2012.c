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
 *   h      angular momentum J w
 *   f      force on the link
 *   n      moment on the link at its origin
 *   fc     force on the link and all that it carries
 *   nc     moment on the link and all that it carries
 *   MSc    first moments of the link and all that it carries
 *   Jc     inertia of the link and all that it carries
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   p      origin of the frame in that of its antecedent
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: fc, lin
 *   ...d   derivative by a variable, qd2 for qd[2], or by the time, t: x, y
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
static const double orthoglide_2012_geo_a = ORTHOGLIDE_2012_GEO_a;
static const double orthoglide_2012_geo_d6 = ORTHOGLIDE_2012_GEO_d6;

/* Joint torques, by the Newton-Euler recursion.
 * 179 additions, 241 multiplications. */
void orthoglide_2012_tree_inverse_dynamics(const double q[12], const double qd[12],
                                           const double qdd[12], const double beta[53],
                                           double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

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

    const double ww21_zz = qd[6]*qd[6];
    /* link 41: force on the link, f41 = M41 vd41 + U41 MS41 */
    const double minus_f41_x = ww21_zz*beta[24];
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    const double ww31_zz = qd[7]*qd[7];
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    const double minus_w31_x = s7*qd[6];
    const double ww31_xy = minus_w31_x*minus_w31_y;
    /* link 41: force on the link and all that it carries, fc41 = f41 + sum of R fc of what hangs on
        it */
    const double fc41a_y = s7*minus_f41_x;
    const double U31_yx = qdd[7] + ww31_xy;
    const double t10 = c7*(minus_U31_xx*beta[20] + (qdd[7] - ww31_xy)*beta[21] + c7*minus_f41_x);
    /* link 31: force on the link and all that it carries, fc31 = f31 + sum of R fc of what hangs on
        it */
    const double minus_fc31a_x = t10 + s7*(U31_yx*beta[20] - (minus_w31_x*minus_w31_x +
        ww31_zz)*beta[21] + fc41a_y);
    const double f41_z = qdd[6]*beta[24];
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_y = c7*qdd[6] - minus_ww31_xz;
    const double minus_U31_zx = minus_ww31_xz - minus_wd31_y;
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    const double minus_wd31_x = s7*qdd[6] + minus_ww31_yz;
    const double fc31_z = f41_z - (minus_U31_zx*beta[20] + (minus_ww31_yz + minus_wd31_x)*beta[21]);
    const double t19 = s6*(ww21_zz*beta[11] + qdd[6]*beta[12] + minus_fc31a_x);
    /* link 11: force on the link and all that it carries, fc11 = f11 + sum of R fc of what hangs on
        it */
    const double fc11_z = t19 - c6*(qdd[6]*beta[11] - ww21_zz*beta[12] + fc31_z) + qdd[3]*beta[0];
    tau[3] = qd[3]*beta[1] + fc11_z + modeler_sign(qd[3])*beta[2];
    const double ww22_zz = qd[8]*qd[8];
    /* link 42: force on the link, f42 = M42 vd42 + U42 MS42 */
    const double minus_f42_x = ww22_zz*beta[38];
    /* link 42: force on the link and all that it carries, fc42 = f42 + sum of R fc of what hangs on
        it */
    const double fc42a_y = s9*minus_f42_x;
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_x = s9*qd[8];
    const double ww32_zz = qd[9]*qd[9];
    const double minus_w32_y = c9*qd[8];
    const double ww32_xy = minus_w32_x*minus_w32_y;
    const double t28 = c9*(c9*minus_f42_x + (qdd[9] - ww32_xy)*beta[35]);
    /* link 32: force on the link and all that it carries, fc32 = f32 + sum of R fc of what hangs on
        it */
    const double minus_fc32a_x = s9*(fc42a_y - (minus_w32_x*minus_w32_x + ww32_zz)*beta[35]) + t28;
    const double f42_z = qdd[8]*beta[38];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = s9*qdd[8] + minus_ww32_yz;
    const double t33 = c8*(f42_z - (minus_ww32_yz + minus_wd32_x)*beta[35] + (qdd[8]*beta[26] -
        ww22_zz*beta[27]));
    /* link 12: force on the link and all that it carries, fc12 = f12 + sum of R fc of what hangs on
        it */
    const double fc12_z = s8*(ww22_zz*beta[26] + qdd[8]*beta[27] + minus_fc32a_x) - t33 +
        qdd[4]*beta[3];
    tau[4] = qd[4]*beta[4] + fc12_z + modeler_sign(qd[4])*beta[5];
    const double ww23_zz = qd[10]*qd[10];
    /* link 43: force on the link, f43 = M43 vd43 + U43 MS43 */
    const double minus_f43_x = ww23_zz*beta[52];
    /* link 43: force on the link and all that it carries, fc43 = f43 + sum of R fc of what hangs on
        it */
    const double fc43a_y = s11*minus_f43_x;
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_x = s11*qd[10];
    const double ww33_zz = qd[11]*qd[11];
    const double minus_w33_y = c11*qd[10];
    const double ww33_xy = minus_w33_x*minus_w33_y;
    const double t42 = c11*(c11*minus_f43_x + (qdd[11] - ww33_xy)*beta[49]);
    /* link 33: force on the link and all that it carries, fc33 = f33 + sum of R fc of what hangs on
        it */
    const double minus_fc33a_x = s11*(fc43a_y - (minus_w33_x*minus_w33_x + ww33_zz)*beta[49]) + t42;
    const double f43_z = qdd[10]*beta[52];
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = s11*qdd[10] + minus_ww33_yz;
    const double t47 = c10*(f43_z - (minus_ww33_yz + minus_wd33_x)*beta[49] + (qdd[10]*beta[40] -
        ww23_zz*beta[41]));
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2012_geo_g;
    /* link 13: force on the link and all that it carries, fc13 = f13 + sum of R fc of what hangs on
        it */
    const double fc13_z = s10*(ww23_zz*beta[40] + qdd[10]*beta[41] + minus_fc33a_x) - t47 +
        vd13_z*beta[6];
    tau[5] = fc13_z + qdd[5]*beta[7] + qd[5]*beta[8] + modeler_sign(qd[5])*beta[9];
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    /* link 41: moment on the link at its origin, n41 = J41 wd41 + w41 x J41 w41 + MS41 x vd41 */
    const double n41_y = (minus_vd21_y + orthoglide_2012_geo_d4*minus_U31_zx)*beta[24];
    const double minus_h31_z = minus_w31_x*beta[17] + minus_w31_y*beta[18] - qd[7]*beta[19];
    const double minus_h31_y = minus_w31_x*beta[16] - qd[7]*beta[18];
    const double t54 = minus_w31_y*minus_h31_z + qd[7]*minus_h31_y + (qdd[7]*beta[17] -
        (minus_wd31_x*beta[15] + minus_wd31_y*beta[16]));
    const double minus_h31_x = minus_w31_x*beta[15] + minus_w31_y*beta[16] - qd[7]*beta[17];
    /* link 31: moment on the link at its origin, n31 = J31 wd31 + w31 x J31 w31 + MS31 x vd31 */
    const double minus_n31_y = qd[7]*minus_h31_x + minus_w31_x*minus_h31_z + (minus_wd31_x*beta[16]
        - qdd[7]*beta[18]) - minus_vd21_y*beta[20];
    const double t57 = c7*(c7*n41_y - orthoglide_2012_geo_d4*f41_z - minus_n31_y);
    const double minus_vd21_x = s6*qdd[3];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = minus_vd21_x*beta[12] - minus_vd21_y*beta[11] + qdd[6]*beta[10];
    const double t60 = n21_z - (s7*(t54 - minus_vd21_y*beta[21] + s7*n41_y) + t57) + qd[6]*beta[13];
    tau[6] = modeler_sign(qd[6])*beta[14] + t60;
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double vd31_y = orthoglide_2012_geo_g*c7 + s7*minus_vd21_x;
    const double minus_vd31_x = c7*minus_vd21_x - orthoglide_2012_geo_g*s7;
    const double t63 = c7*(vd31_y + orthoglide_2012_geo_d4*U31_yx);
    const double n41_z = (t63 - s7*(minus_vd31_x + orthoglide_2012_geo_d4*minus_U31_xx))*beta[24];
    const double t65 = minus_w31_x*minus_h31_y - minus_w31_y*minus_h31_x + (qdd[7]*beta[19] -
        (minus_wd31_x*beta[17] + minus_wd31_y*beta[18]));
    /* link 31: moment on the link and all that it carries, nc31 = n31 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc31_z = orthoglide_2012_geo_d4*fc41a_y + n41_z + (vd31_y*beta[20] +
        minus_vd31_x*beta[21] + t65);
    tau[7] = nc31_z - n41_z + qd[7]*beta[22] + modeler_sign(qd[7])*beta[23];
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    const double minus_wd32_y = c9*qdd[8] - minus_ww32_xz;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double n42_y = (minus_vd22_y + orthoglide_2012_geo_d4*(minus_ww32_xz -
        minus_wd32_y))*beta[38];
    const double minus_h32_z = minus_w32_x*beta[32] + minus_w32_y*beta[33] - qd[9]*beta[34];
    const double minus_h32_y = minus_w32_x*beta[31] - qd[9]*beta[33];
    const double t73 = minus_w32_y*minus_h32_z + qd[9]*minus_h32_y + (qdd[9]*beta[32] -
        (minus_wd32_x*beta[30] + minus_wd32_y*beta[31]));
    const double minus_h32_x = minus_w32_x*beta[30] + minus_w32_y*beta[31] - qd[9]*beta[32];
    /* link 32: moment on the link at its origin, n32 = J32 wd32 + w32 x J32 w32 + MS32 x vd32 */
    const double minus_n32_y = qd[9]*minus_h32_x + minus_w32_x*minus_h32_z + (minus_wd32_x*beta[31]
        - qdd[9]*beta[33]);
    const double t76 = c9*(c9*n42_y - orthoglide_2012_geo_d4*f42_z - minus_n32_y);
    const double minus_vd22_x = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = minus_vd22_x*beta[27] - minus_vd22_y*beta[26] + qdd[8]*beta[25];
    const double t79 = n22_z - (s9*(t73 - minus_vd22_y*beta[35] + s9*n42_y) + t76) + qd[8]*beta[28];
    tau[8] = modeler_sign(qd[8])*beta[29] + t79;
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) */
    const double minus_vd32_x = c9*minus_vd22_x;
    const double t81 = c9*(s9*minus_vd22_x + orthoglide_2012_geo_d4*(qdd[9] + ww32_xy));
    const double n42_z = (t81 - s9*(minus_vd32_x + orthoglide_2012_geo_d4*(minus_w32_y*minus_w32_y +
        ww32_zz)))*beta[38];
    const double t83 = minus_w32_x*minus_h32_y - minus_w32_y*minus_h32_x + (qdd[9]*beta[34] -
        (minus_wd32_x*beta[32] + minus_wd32_y*beta[33]));
    const double t84 = n42_z - (orthoglide_2012_geo_d4*fc42a_y + n42_z + (t83 +
        minus_vd32_x*beta[35]));
    tau[9] = qd[9]*beta[36] - t84 + modeler_sign(qd[9])*beta[37];
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    const double minus_wd33_y = c11*qdd[10] - minus_ww33_xz;
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double n43_y = (minus_vd23_y + orthoglide_2012_geo_d4*(minus_ww33_xz -
        minus_wd33_y))*beta[52];
    const double minus_h33_z = minus_w33_x*beta[46] + minus_w33_y*beta[47] - qd[11]*beta[48];
    const double minus_h33_y = minus_w33_x*beta[45] - qd[11]*beta[47];
    const double t91 = minus_w33_y*minus_h33_z + qd[11]*minus_h33_y + (qdd[11]*beta[46] -
        (minus_wd33_x*beta[44] + minus_wd33_y*beta[45]));
    const double minus_h33_x = minus_w33_x*beta[44] + minus_w33_y*beta[45] - qd[11]*beta[46];
    /* link 33: moment on the link at its origin, n33 = J33 wd33 + w33 x J33 w33 + MS33 x vd33 */
    const double minus_n33_y = qd[11]*minus_h33_x + minus_w33_x*minus_h33_z + (minus_wd33_x*beta[45]
        - qdd[11]*beta[47]);
    const double t94 = c11*(c11*n43_y - orthoglide_2012_geo_d4*f43_z - minus_n33_y);
    const double minus_vd23_x = s10*vd13_z;
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double n23_z = minus_vd23_x*beta[41] - minus_vd23_y*beta[40] + qdd[10]*beta[39];
    const double t97 = n23_z - (s11*(t91 - minus_vd23_y*beta[49] + s11*n43_y) + t94) +
        qd[10]*beta[42];
    tau[10] = modeler_sign(qd[10])*beta[43] + t97;
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) */
    const double minus_vd33_x = c11*minus_vd23_x;
    const double t99 = c11*(s11*minus_vd23_x + orthoglide_2012_geo_d4*(qdd[11] + ww33_xy));
    const double n43_z = (t99 - s11*(minus_vd33_x + orthoglide_2012_geo_d4*(minus_w33_y*minus_w33_y
        + ww33_zz)))*beta[52];
    const double t101 = minus_w33_x*minus_h33_y - minus_w33_y*minus_h33_x + (qdd[11]*beta[48] -
        (minus_wd33_x*beta[46] + minus_wd33_y*beta[47]));
    const double t102 = n43_z - (orthoglide_2012_geo_d4*fc43a_y + n43_z + (t101 +
        minus_vd33_x*beta[49]));
    tau[11] = qd[11]*beta[50] - t102 + modeler_sign(qd[11])*beta[51];
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 35 additions, 57 multiplications. */
void orthoglide_2012_tree_inertia_matrix(const double q[12], const double beta[53],
                                         double MODELER_OUT(M, 12 * 12))
{
    MODELER_ALL_ZEROS(M, 144);

    const double k1 = orthoglide_2012_geo_d4*2.0;

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

    M[39] = beta[0];
    const double lin41a_41x = s7*beta[24];
    /* link 31: first moments of the link and all that it carries, MSc31 = MS31 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc31_y = beta[21] - lin41a_41x;
    MODELER_ZEROS(M + 0, 8);
    const double lin41a_41y = c7*beta[24];
    const double MSc31_x = beta[20] + lin41a_41y;
    MODELER_ZEROS(M + 8, 8);
    /* link 11: first moments of the link and all that it carries, MSc11 = MS11 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc11_x = s6*beta[12] - c6*(c7*MSc31_x - s7*MSc31_y + beta[11]);
    M[42] = minus_MSc11_x;
    MODELER_ZEROS(M + 16, 8);
    const double lin21a_31z = s6*(c7*MSc31_y + s7*MSc31_x);
    M[43] = lin21a_31z;
    MODELER_ZEROS(M + 24, 8);
    M[52] = beta[3];
    /* link 32: first moments of the link and all that it carries, MSc32 = MS32 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc32_x = c9*beta[38];
    const double lin42a_42x = s9*beta[38];
    MODELER_ZEROS(M + 32, 7);
    const double MSc32_y = beta[35] - lin42a_42x;
    /* link 12: first moments of the link and all that it carries, MSc12 = MS12 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc12_x = s8*beta[27] - c8*(c9*MSc32_x - s9*MSc32_y + beta[26]);
    MODELER_ZEROS(M + 40, 2);
    M[56] = minus_MSc12_x;
    const double lin22a_32z = s8*(c9*lin42a_42x + c9*MSc32_y);
    MODELER_ZEROS(M + 44, 8);
    M[57] = lin22a_32z;
    M[65] = beta[6] + beta[7];
    MODELER_ZEROS(M + 53, 3);
    /* link 33: first moments of the link and all that it carries, MSc33 = MS33 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc33_x = c11*beta[52];
    const double lin43a_43x = s11*beta[52];
    const double MSc33_y = beta[49] - lin43a_43x;
    MODELER_ZEROS(M + 58, 7);
    /* link 13: first moments of the link and all that it carries, MSc13 = MS13 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc13_x = s10*beta[41] - c10*(c11*MSc33_x - s11*MSc33_y + beta[40]);
    M[70] = minus_MSc13_x;
    MODELER_ZEROS(M + 66, 4);
    const double lin23a_33z = s10*(c11*lin43a_43x + c11*MSc33_y);
    M[71] = lin23a_33z;
    MODELER_ZEROS(M + 72, 3);
    M[75] = minus_MSc11_x;
    /* link 31: inertia of the link and all that it carries, Jc31 = J31 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc31_xy = beta[16] + orthoglide_2012_geo_d4*lin41a_41x;
    MODELER_ZEROS(M + 76, 2);
    M[78] = s7*(s7*beta[15] + c7*Jc31_xy) + c7*(s7*Jc31_xy + k1*lin41a_41y*c7) + beta[10];
    /* link 21: inertia of the link and all that it carries, Jc21 = J21 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc21_yz = s7*beta[17] + c7*beta[18];
    MODELER_ZEROS(M + 80, 7);
    M[79] = -minus_Jc21_yz;
    M[87] = lin21a_31z;
    M[90] = -minus_Jc21_yz;
    MODELER_ZEROS(M + 88, 2);
    M[91] = beta[19];
    M[100] = minus_MSc12_x;
    MODELER_ZEROS(M + 92, 8);
    /* link 32: inertia of the link and all that it carries, Jc32 = J32 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc32_xy = beta[31] + orthoglide_2012_geo_d4*lin42a_42x;
    M[104] = s9*(s9*beta[30] + c9*Jc32_xy) + c9*(s9*Jc32_xy + k1*MSc32_x*c9) + beta[25];
    MODELER_ZEROS(M + 101, 3);
    /* link 22: inertia of the link and all that it carries, Jc22 = J22 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc22_yz = s9*beta[32] + c9*beta[33];
    M[105] = -minus_Jc22_yz;
    MODELER_ZEROS(M + 106, 6);
    M[112] = lin22a_32z;
    M[116] = -minus_Jc22_yz;
    M[117] = beta[34];
    MODELER_ZEROS(M + 113, 3);
    M[125] = minus_MSc13_x;
    /* link 33: inertia of the link and all that it carries, Jc33 = J33 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc33_xy = beta[45] + orthoglide_2012_geo_d4*lin43a_43x;
    MODELER_ZEROS(M + 118, 7);
    M[130] = s11*(s11*beta[44] + c11*Jc33_xy) + c11*(s11*Jc33_xy + k1*MSc33_x*c11) + beta[39];
    /* link 23: inertia of the link and all that it carries, Jc23 = J23 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc23_yz = s11*beta[46] + c11*beta[47];
    MODELER_ZEROS(M + 126, 4);
    M[131] = -minus_Jc23_yz;
    M[137] = lin23a_33z;
    MODELER_ZEROS(M + 132, 5);
    M[142] = -minus_Jc23_yz;
    M[143] = beta[48];
    MODELER_ZEROS(M + 138, 4);
}

/* Torques that hold the robot still, without friction.
 * 9 additions, 29 multiplications. */
void orthoglide_2012_tree_gravity(const double q[12], const double beta[53],
                                  double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[6] = 0.0;

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

    tau[5] = -orthoglide_2012_geo_g*beta[6];
    tau[7] = orthoglide_2012_geo_g*c7*beta[20] - orthoglide_2012_geo_g*s7*beta[21];
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22_y = orthoglide_2012_geo_g*s8;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double minus_n42_y = vd22_y*beta[38];
    const double minus_vd22_x = orthoglide_2012_geo_g*c8;
    tau[8] = s9*(s9*minus_n42_y - vd22_y*beta[35]) + c9*minus_n42_y*c9 + (vd22_y*beta[26] +
        minus_vd22_x*beta[27]);
    tau[9] = c9*minus_vd22_x*beta[35];
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double vd23_y = orthoglide_2012_geo_g*c10;
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double minus_n43_y = beta[52]*vd23_y;
    const double vd23_x = orthoglide_2012_geo_g*s10;
    tau[10] = s11*(s11*minus_n43_y - beta[49]*vd23_y) + c11*minus_n43_y*c11 + (beta[40]*vd23_y -
        beta[41]*vd23_x);
    tau[11] = -c11*vd23_x*beta[49];
}

/* Torques without gravity and friction.
 * 158 additions, 223 multiplications. */
void orthoglide_2012_tree_coriolis(const double q[12], const double qd[12], const double qdd[12],
                                   const double beta[53], double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

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

    const double ww21_zz = qd[6]*qd[6];
    /* link 41: force on the link, f41 = M41 vd41 + U41 MS41 */
    const double minus_f41_x = ww21_zz*beta[24];
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    const double ww31_zz = qd[7]*qd[7];
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    const double minus_w31_x = s7*qd[6];
    const double ww31_xy = minus_w31_x*minus_w31_y;
    /* link 41: force on the link and all that it carries, fc41 = f41 + sum of R fc of what hangs on
        it */
    const double fc41a_y = s7*minus_f41_x;
    const double U31_yx = qdd[7] + ww31_xy;
    const double t10 = c7*(minus_U31_xx*beta[20] + (qdd[7] - ww31_xy)*beta[21] + c7*minus_f41_x);
    /* link 31: force on the link and all that it carries, fc31 = f31 + sum of R fc of what hangs on
        it */
    const double minus_fc31a_x = t10 + s7*(U31_yx*beta[20] - (minus_w31_x*minus_w31_x +
        ww31_zz)*beta[21] + fc41a_y);
    const double f41_z = qdd[6]*beta[24];
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_y = c7*qdd[6] - minus_ww31_xz;
    const double minus_U31_zx = minus_ww31_xz - minus_wd31_y;
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    const double minus_wd31_x = s7*qdd[6] + minus_ww31_yz;
    const double fc31_z = f41_z - (minus_U31_zx*beta[20] + (minus_ww31_yz + minus_wd31_x)*beta[21]);
    const double t19 = s6*(ww21_zz*beta[11] + qdd[6]*beta[12] + minus_fc31a_x);
    tau[3] = t19 - c6*(qdd[6]*beta[11] - ww21_zz*beta[12] + fc31_z) + qdd[3]*beta[0];
    const double ww22_zz = qd[8]*qd[8];
    /* link 42: force on the link, f42 = M42 vd42 + U42 MS42 */
    const double minus_f42_x = ww22_zz*beta[38];
    /* link 42: force on the link and all that it carries, fc42 = f42 + sum of R fc of what hangs on
        it */
    const double fc42a_y = s9*minus_f42_x;
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_x = s9*qd[8];
    const double ww32_zz = qd[9]*qd[9];
    const double minus_w32_y = c9*qd[8];
    const double ww32_xy = minus_w32_x*minus_w32_y;
    const double t27 = c9*(c9*minus_f42_x + (qdd[9] - ww32_xy)*beta[35]);
    /* link 32: force on the link and all that it carries, fc32 = f32 + sum of R fc of what hangs on
        it */
    const double minus_fc32a_x = s9*(fc42a_y - (minus_w32_x*minus_w32_x + ww32_zz)*beta[35]) + t27;
    const double f42_z = qdd[8]*beta[38];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = s9*qdd[8] + minus_ww32_yz;
    const double t32 = c8*(f42_z - (minus_ww32_yz + minus_wd32_x)*beta[35] + (qdd[8]*beta[26] -
        ww22_zz*beta[27]));
    tau[4] = s8*(ww22_zz*beta[26] + qdd[8]*beta[27] + minus_fc32a_x) - t32 + qdd[4]*beta[3];
    const double ww23_zz = qd[10]*qd[10];
    /* link 43: force on the link, f43 = M43 vd43 + U43 MS43 */
    const double minus_f43_x = ww23_zz*beta[52];
    /* link 43: force on the link and all that it carries, fc43 = f43 + sum of R fc of what hangs on
        it */
    const double fc43a_y = s11*minus_f43_x;
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_x = s11*qd[10];
    const double ww33_zz = qd[11]*qd[11];
    const double minus_w33_y = c11*qd[10];
    const double ww33_xy = minus_w33_x*minus_w33_y;
    const double t40 = c11*(c11*minus_f43_x + (qdd[11] - ww33_xy)*beta[49]);
    /* link 33: force on the link and all that it carries, fc33 = f33 + sum of R fc of what hangs on
        it */
    const double minus_fc33a_x = s11*(fc43a_y - (minus_w33_x*minus_w33_x + ww33_zz)*beta[49]) + t40;
    const double f43_z = qdd[10]*beta[52];
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = s11*qdd[10] + minus_ww33_yz;
    const double t45 = c10*(f43_z - (minus_ww33_yz + minus_wd33_x)*beta[49] + (qdd[10]*beta[40] -
        ww23_zz*beta[41]));
    /* link 13: force on the link and all that it carries, fc13 = f13 + sum of R fc of what hangs on
        it */
    const double fc13_z = s10*(ww23_zz*beta[40] + qdd[10]*beta[41] + minus_fc33a_x) - t45 +
        qdd[5]*beta[6];
    tau[5] = qdd[5]*beta[7] + fc13_z;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    /* link 41: moment on the link at its origin, n41 = J41 wd41 + w41 x J41 w41 + MS41 x vd41 */
    const double n41_y = (minus_vd21_y + orthoglide_2012_geo_d4*minus_U31_zx)*beta[24];
    const double minus_h31_z = minus_w31_x*beta[17] + minus_w31_y*beta[18] - qd[7]*beta[19];
    const double minus_h31_y = minus_w31_x*beta[16] - qd[7]*beta[18];
    const double t51 = minus_w31_y*minus_h31_z + qd[7]*minus_h31_y + (qdd[7]*beta[17] -
        (minus_wd31_x*beta[15] + minus_wd31_y*beta[16]));
    const double minus_h31_x = minus_w31_x*beta[15] + minus_w31_y*beta[16] - qd[7]*beta[17];
    /* link 31: moment on the link at its origin, n31 = J31 wd31 + w31 x J31 w31 + MS31 x vd31 */
    const double minus_n31_y = qd[7]*minus_h31_x + minus_w31_x*minus_h31_z + (minus_wd31_x*beta[16]
        - qdd[7]*beta[18]) - minus_vd21_y*beta[20];
    const double t54 = c7*(c7*n41_y - orthoglide_2012_geo_d4*f41_z - minus_n31_y);
    const double minus_vd21_x = s6*qdd[3];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = minus_vd21_x*beta[12] - minus_vd21_y*beta[11] + qdd[6]*beta[10];
    tau[6] = n21_z - (s7*(t51 - minus_vd21_y*beta[21] + s7*n41_y) + t54);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double vd31_y = s7*minus_vd21_x;
    const double minus_vd31_x = c7*minus_vd21_x;
    const double t59 = c7*(vd31_y + orthoglide_2012_geo_d4*U31_yx);
    const double n41_z = beta[24]*(t59 - s7*(minus_vd31_x + orthoglide_2012_geo_d4*minus_U31_xx));
    const double t61 = minus_w31_x*minus_h31_y - minus_w31_y*minus_h31_x + (qdd[7]*beta[19] -
        (minus_wd31_x*beta[17] + minus_wd31_y*beta[18]));
    /* link 31: moment on the link and all that it carries, nc31 = n31 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc31_z = orthoglide_2012_geo_d4*fc41a_y + n41_z + (vd31_y*beta[20] +
        minus_vd31_x*beta[21] + t61);
    tau[7] = nc31_z - n41_z;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4];
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    const double minus_wd32_y = c9*qdd[8] - minus_ww32_xz;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double n42_y = beta[38]*(minus_vd22_y + orthoglide_2012_geo_d4*(minus_ww32_xz -
        minus_wd32_y));
    const double minus_h32_z = minus_w32_x*beta[32] + minus_w32_y*beta[33] - qd[9]*beta[34];
    const double minus_h32_y = minus_w32_x*beta[31] - qd[9]*beta[33];
    const double t69 = minus_w32_y*minus_h32_z + qd[9]*minus_h32_y + (qdd[9]*beta[32] -
        (minus_wd32_x*beta[30] + minus_wd32_y*beta[31]));
    const double minus_h32_x = minus_w32_x*beta[30] + minus_w32_y*beta[31] - qd[9]*beta[32];
    /* link 32: moment on the link at its origin, n32 = J32 wd32 + w32 x J32 w32 + MS32 x vd32 */
    const double minus_n32_y = qd[9]*minus_h32_x + minus_w32_x*minus_h32_z + (minus_wd32_x*beta[31]
        - qdd[9]*beta[33]);
    const double t72 = c9*(orthoglide_2012_geo_d4*f42_z - c9*n42_y + minus_n32_y);
    const double minus_vd22_x = s8*qdd[4];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = minus_vd22_x*beta[27] - minus_vd22_y*beta[26] + qdd[8]*beta[25];
    tau[8] = n22_z - (s9*(t69 - minus_vd22_y*beta[35] + s9*n42_y) - t72);
    const double minus_vd22_x_2 = orthoglide_2012_geo_g*c8 + minus_vd22_x;
    const double t76 = s9*(c9*minus_vd22_x_2 + orthoglide_2012_geo_d4*(minus_w32_y*minus_w32_y +
        ww32_zz));
    const double n42_z = (c9*(s9*minus_vd22_x_2 + orthoglide_2012_geo_d4*(qdd[9] + ww32_xy)) -
        t76)*beta[38];
    const double t78 = minus_w32_x*minus_h32_y - minus_w32_y*minus_h32_x + (qdd[9]*beta[34] -
        (minus_wd32_x*beta[32] + minus_wd32_y*beta[33]));
    tau[9] = orthoglide_2012_geo_d4*fc42a_y + n42_z + (t78 + c9*minus_vd22_x*beta[35]) - n42_z;
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    const double minus_wd33_y = c11*qdd[10] - minus_ww33_xz;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*qdd[5];
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double n43_y = beta[52]*(orthoglide_2012_geo_d4*(minus_ww33_xz - minus_wd33_y) +
        minus_vd23_y);
    const double minus_h33_z = minus_w33_x*beta[46] + minus_w33_y*beta[47] - qd[11]*beta[48];
    const double minus_h33_y = minus_w33_x*beta[45] - qd[11]*beta[47];
    const double t85 = minus_w33_y*minus_h33_z + qd[11]*minus_h33_y + (qdd[11]*beta[46] -
        (minus_wd33_x*beta[44] + minus_wd33_y*beta[45]));
    const double minus_h33_x = minus_w33_x*beta[44] + minus_w33_y*beta[45] - qd[11]*beta[46];
    /* link 33: moment on the link at its origin, n33 = J33 wd33 + w33 x J33 w33 + MS33 x vd33 */
    const double minus_n33_y = qd[11]*minus_h33_x + minus_w33_x*minus_h33_z + (minus_wd33_x*beta[45]
        - qdd[11]*beta[47]);
    const double t88 = c11*(orthoglide_2012_geo_d4*f43_z - c11*n43_y + minus_n33_y);
    const double minus_vd23_x = s10*qdd[5];
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double n23_z = beta[41]*minus_vd23_x - beta[40]*minus_vd23_y + qdd[10]*beta[39];
    tau[10] = n23_z - (s11*(t85 - beta[49]*minus_vd23_y + s11*n43_y) - t88);
    const double minus_vd23_x_2 = s10*(qdd[5] - orthoglide_2012_geo_g);
    const double t92 = c11*(s11*minus_vd23_x_2 + orthoglide_2012_geo_d4*(qdd[11] + ww33_xy));
    const double n43_z = (t92 - s11*(c11*minus_vd23_x_2 +
        orthoglide_2012_geo_d4*(minus_w33_y*minus_w33_y + ww33_zz)))*beta[52];
    const double t94 = minus_w33_x*minus_h33_y - minus_w33_y*minus_h33_x + (qdd[11]*beta[48] -
        (minus_wd33_x*beta[46] + minus_wd33_y*beta[47]));
    tau[11] = orthoglide_2012_geo_d4*fc43a_y + n43_z + (t94 + c11*minus_vd23_x*beta[49]) - n43_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 9 additions, 18 multiplications. */
void orthoglide_2012_tree_friction(const double qd[12], const double beta[53],
                                   double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

    tau[3] = qd[3]*beta[1] + modeler_sign(qd[3])*beta[2];
    tau[4] = qd[4]*beta[4] + modeler_sign(qd[4])*beta[5];
    tau[5] = qd[5]*beta[8] + modeler_sign(qd[5])*beta[9];
    tau[6] = qd[6]*beta[13] + modeler_sign(qd[6])*beta[14];
    tau[7] = qd[7]*beta[22] + modeler_sign(qd[7])*beta[23];
    tau[8] = qd[8]*beta[28] + modeler_sign(qd[8])*beta[29];
    tau[9] = qd[9]*beta[36] + modeler_sign(qd[9])*beta[37];
    tau[10] = qd[10]*beta[42] + modeler_sign(qd[10])*beta[43];
    tau[11] = qd[11]*beta[50] + modeler_sign(qd[11])*beta[51];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 7 additions, 21 multiplications. */
void orthoglide_2012_tree_forward_kinematics(const double q[12], double MODELER_OUT(T, 18 * 3 * 4))
{
    MODELER_ALL_ZEROS(T, 216);

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

    T[2] = 1.0;
    T[3] = q[0];
    T[4] = 1.0;
    MODELER_ZEROS(T + 0, 2);
    T[9] = 1.0;
    T[13] = 1.0;
    MODELER_ZEROS(T + 5, 4);
    T[15] = q[0];
    T[18] = 1.0;
    T[19] = q[1];
    MODELER_ZEROS(T + 10, 3);
    T[20] = 1.0;
    T[24] = 1.0;
    MODELER_ZEROS(T + 14, 1);
    T[27] = q[0];
    T[29] = 1.0;
    T[31] = q[1];
    MODELER_ZEROS(T + 16, 2);
    T[34] = 1.0;
    T[35] = q[2];
    MODELER_ZEROS(T + 21, 3);
    T[36] = 1.0;
    T[41] = 1.0;
    T[46] = 1.0;
    MODELER_ZEROS(T + 25, 2);
    T[47] = q[3];
    T[50] = 1.0;
    MODELER_ZEROS(T + 28, 1);
    const double minus_p12_x = orthoglide_2012_geo_a - q[4];
    T[51] = -minus_p12_x;
    T[52] = 1.0;
    MODELER_ZEROS(T + 30, 1);
    T[57] = 1.0;
    T[59] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 32, 2);
    T[61] = 1.0;
    T[66] = 1.0;
    MODELER_ZEROS(T + 37, 4);
    const double minus_p13_y = orthoglide_2012_geo_a - q[5];
    T[67] = -minus_p13_y;
    T[68] = 1.0;
    MODELER_ZEROS(T + 42, 4);
    T[71] = orthoglide_2012_geo_a;
    T[72] = c6;
    MODELER_ZEROS(T + 48, 2);
    T[73] = -s6;
    T[78] = 1.0;
    T[80] = -s6;
    MODELER_ZEROS(T + 53, 4);
    T[81] = -c6;
    T[83] = q[3];
    MODELER_ZEROS(T + 58, 1);
    const double x31_x = c6*c7;
    T[84] = x31_x;
    T[85] = -c6*s7;
    MODELER_ZEROS(T + 60, 1);
    T[86] = -s6;
    T[88] = -s7;
    MODELER_ZEROS(T + 62, 4);
    T[89] = -c7;
    const double minus_x31_z = s6*c7;
    T[92] = -minus_x31_z;
    MODELER_ZEROS(T + 69, 2);
    T[93] = s6*s7;
    T[94] = -c6;
    MODELER_ZEROS(T + 74, 4);
    T[95] = q[3];
    T[96] = c6;
    MODELER_ZEROS(T + 79, 1);
    T[98] = -s6;
    /* link 41: origin of the frame in frame 0, o41 = o31 + [x31 y31 z31] p41 */
    const double o41_x = orthoglide_2012_geo_d4*x31_x;
    T[99] = o41_x;
    MODELER_ZEROS(T + 82, 1);
    T[101] = -1.0;
    const double minus_o41_y = orthoglide_2012_geo_d4*s7;
    MODELER_ZEROS(T + 87, 1);
    T[103] = -minus_o41_y;
    T[104] = -s6;
    T[106] = -c6;
    MODELER_ZEROS(T + 90, 2);
    const double o41_z = q[3] - orthoglide_2012_geo_d4*minus_x31_z;
    T[107] = o41_z;
    MODELER_ZEROS(T + 97, 1);
    T[108] = 1.0;
    T[111] = o41_x;
    T[114] = 1.0;
    MODELER_ZEROS(T + 100, 1);
    T[115] = -minus_o41_y;
    T[117] = -1.0;
    MODELER_ZEROS(T + 102, 1);
    T[119] = o41_z;
    T[120] = -s8;
    T[121] = -c8;
    MODELER_ZEROS(T + 105, 1);
    T[123] = -minus_p12_x;
    T[124] = c8;
    MODELER_ZEROS(T + 109, 2);
    T[125] = -s8;
    T[130] = 1.0;
    MODELER_ZEROS(T + 112, 2);
    T[131] = orthoglide_2012_geo_a;
    const double minus_x32_x = s8*c9;
    T[132] = -minus_x32_x;
    MODELER_ZEROS(T + 116, 1);
    T[133] = s8*s9;
    T[134] = -c8;
    MODELER_ZEROS(T + 118, 1);
    T[135] = -minus_p12_x;
    const double x32_y = c8*c9;
    T[136] = x32_y;
    MODELER_ZEROS(T + 122, 1);
    T[137] = -c8*s9;
    T[138] = -s8;
    MODELER_ZEROS(T + 126, 4);
    T[140] = -s9;
    T[141] = -c9;
    T[143] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 139, 1);
    T[144] = -s8;
    T[146] = -c8;
    MODELER_ZEROS(T + 142, 1);
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double minus_o42_x = minus_p12_x + orthoglide_2012_geo_d4*minus_x32_x;
    T[147] = -minus_o42_x;
    T[148] = c8;
    MODELER_ZEROS(T + 145, 1);
    T[150] = -s8;
    const double o42_y = orthoglide_2012_geo_d4*x32_y;
    MODELER_ZEROS(T + 149, 1);
    T[151] = o42_y;
    T[153] = -1.0;
    MODELER_ZEROS(T + 152, 1);
    const double o42_z = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9;
    T[155] = o42_z;
    T[157] = -1.0;
    MODELER_ZEROS(T + 154, 1);
    T[159] = -minus_o42_x;
    T[160] = 1.0;
    MODELER_ZEROS(T + 156, 1);
    T[163] = o42_y;
    T[166] = 1.0;
    T[167] = o42_z;
    MODELER_ZEROS(T + 158, 1);
    T[170] = 1.0;
    T[172] = -s10;
    MODELER_ZEROS(T + 161, 2);
    T[173] = -c10;
    T[175] = -minus_p13_y;
    T[176] = c10;
    MODELER_ZEROS(T + 164, 2);
    T[177] = -s10;
    T[179] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 168, 2);
    T[180] = -s11;
    T[181] = -c11;
    const double minus_x33_y = s10*c11;
    MODELER_ZEROS(T + 171, 1);
    T[184] = -minus_x33_y;
    T[185] = s10*s11;
    MODELER_ZEROS(T + 174, 1);
    T[186] = -c10;
    T[187] = -minus_p13_y;
    MODELER_ZEROS(T + 178, 1);
    const double x33_z = c10*c11;
    T[188] = x33_z;
    T[189] = -c10*s11;
    MODELER_ZEROS(T + 182, 2);
    T[190] = -s10;
    T[191] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 192, 1);
    T[193] = -1.0;
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
    const double minus_o43_x = orthoglide_2012_geo_d4*s11;
    T[195] = -minus_o43_x;
    MODELER_ZEROS(T + 194, 1);
    T[196] = -s10;
    T[198] = -c10;
    MODELER_ZEROS(T + 197, 1);
    const double minus_o43_y = minus_p13_y + orthoglide_2012_geo_d4*minus_x33_y;
    T[199] = -minus_o43_y;
    T[200] = c10;
    MODELER_ZEROS(T + 201, 1);
    T[202] = -s10;
    const double o43_z = orthoglide_2012_geo_a + orthoglide_2012_geo_d4*x33_z;
    MODELER_ZEROS(T + 204, 2);
    T[203] = o43_z;
    T[206] = 1.0;
    T[207] = -minus_o43_x;
    MODELER_ZEROS(T + 208, 1);
    T[209] = -1.0;
    T[211] = -minus_o43_y;
    MODELER_ZEROS(T + 210, 1);
    T[212] = 1.0;
    T[215] = o43_z;
    MODELER_ZEROS(T + 213, 2);
}

/* d/dt(df/du) ud.
 * 18 additions, 66 multiplications. */
void orthoglide_2012_tree_drift(const double q[12], const double qd[12],
                                double MODELER_OUT(values, 9))
{
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

    const double minus_x21d_tz = c6*qd[6];
    const double y31d_ty = s7*qd[7];
    const double minus_x21d_tx = s6*qd[6];
    const double minus_x31d_ty = c7*qd[7];
    const double t5 = orthoglide_2012_geo_d4*(c7*minus_x21d_tz - s6*y31d_ty)*qd[6];
    values[0] = orthoglide_2012_geo_d4*(s7*minus_x21d_tx - c6*minus_x31d_ty)*qd[7] - t5;
    values[1] = orthoglide_2012_geo_d4*y31d_ty*qd[7];
    const double t6 = orthoglide_2012_geo_d4*(c7*minus_x21d_tx + c6*y31d_ty)*qd[6];
    values[2] = t6 + orthoglide_2012_geo_d4*(s7*minus_x21d_tz + s6*minus_x31d_ty)*qd[7];
    const double minus_x22d_ty = s8*qd[8];
    const double y32d_tz = s9*qd[9];
    const double minus_x22d_tx = c8*qd[8];
    const double minus_x32d_tz = c9*qd[9];
    const double t11 = orthoglide_2012_geo_d4*(s9*minus_x22d_tx + s8*minus_x32d_tz)*qd[9];
    values[3] = orthoglide_2012_geo_d4*(c9*minus_x22d_ty + c8*y32d_tz)*qd[8] + t11;
    const double t12 = orthoglide_2012_geo_d4*(s9*minus_x22d_ty - c8*minus_x32d_tz)*qd[9];
    values[4] = t12 - orthoglide_2012_geo_d4*(c9*minus_x22d_tx - s8*y32d_tz)*qd[8];
    values[5] = orthoglide_2012_geo_d4*y32d_tz*qd[9];
    const double y33d_tx = s11*qd[11];
    values[6] = orthoglide_2012_geo_d4*y33d_tx*qd[11];
    const double minus_x23d_tz = s10*qd[10];
    const double minus_x23d_ty = c10*qd[10];
    const double minus_x33d_tx = c11*qd[11];
    const double t17 = orthoglide_2012_geo_d4*(c11*minus_x23d_tz + c10*y33d_tx)*qd[10];
    values[7] = t17 + orthoglide_2012_geo_d4*(s11*minus_x23d_ty + s10*minus_x33d_tx)*qd[11];
    const double t18 = orthoglide_2012_geo_d4*(c11*minus_x23d_ty - s10*y33d_tx)*qd[10];
    values[8] = orthoglide_2012_geo_d4*(s11*minus_x23d_tz - c10*minus_x33d_tx)*qd[11] - t18;
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 19 additions, 30 multiplications. */
void orthoglide_2012_tree_closure(const double q[12], double MODELER_OUT(values, 48))
{
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

    /* link 41: origin of the frame in frame 0, o41 = o31 + [x31 y31 z31] p41 */
    const double o41_x = c6*c7*orthoglide_2012_geo_d4;
    values[0] = o41_x - q[0];
    values[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    /* link 51: velocity of the origin, for unit speed of each joint below, m51 = R51' (m41 + e41 x
        p51) */
    const double minus_m51_21x = s6*c7*orthoglide_2012_geo_d4;
    values[2] = q[3] - minus_m51_21x + orthoglide_2012_geo_d6 - q[2];
    /* link 52: velocity of the origin, for unit speed of each joint below, m52 = R52' (m42 + e42 x
        p52) */
    const double minus_m52_22x = s8*c9*orthoglide_2012_geo_d4;
    values[3] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[4] + minus_m52_22x) - q[0];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double o42_y = c8*c9*orthoglide_2012_geo_d4;
    values[4] = o42_y - q[1];
    values[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    values[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    /* link 53: velocity of the origin, for unit speed of each joint below, m53 = R53' (m43 + e43 x
        p53) */
    const double minus_m53_23x = s10*c11*orthoglide_2012_geo_d4;
    values[7] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[5] + minus_m53_23x) - q[1];
    const double m53_23y = c10*c11*orthoglide_2012_geo_d4;
    values[8] = orthoglide_2012_geo_a + m53_23y - q[2];
    values[9] = -1.0;
    values[10] = -minus_m51_21x;
    values[11] = -c6*s7*orthoglide_2012_geo_d4;
    values[12] = -1.0;
    values[13] = -orthoglide_2012_geo_d4*c7;
    values[14] = -1.0;
    values[15] = 1.0;
    values[16] = -o41_x;
    values[17] = s6*s7*orthoglide_2012_geo_d4;
    values[18] = -1.0;
    values[19] = 1.0;
    values[20] = -o42_y;
    values[21] = s8*s9*orthoglide_2012_geo_d4;
    values[22] = -1.0;
    values[23] = -minus_m52_22x;
    values[24] = -c8*s9*orthoglide_2012_geo_d4;
    values[25] = -1.0;
    values[26] = -orthoglide_2012_geo_d4*c9;
    values[27] = -1.0;
    values[28] = -orthoglide_2012_geo_d4*c11;
    values[29] = -1.0;
    values[30] = 1.0;
    values[31] = -m53_23y;
    values[32] = s10*s11*orthoglide_2012_geo_d4;
    values[33] = -1.0;
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

/* The independent equations.
 * 19 additions, 15 multiplications. */
void orthoglide_2012_tree_residual(const double q[12], double MODELER_OUT(f, 9))
{
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

    f[0] = c6*c7*orthoglide_2012_geo_d4 - q[0];
    f[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    f[2] = q[3] - s6*c7*orthoglide_2012_geo_d4 + orthoglide_2012_geo_d6 - q[2];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double minus_o42_x = orthoglide_2012_geo_a - q[4] + s8*c9*orthoglide_2012_geo_d4;
    f[3] = orthoglide_2012_geo_d6 - minus_o42_x - q[0];
    f[4] = c8*c9*orthoglide_2012_geo_d4 - q[1];
    f[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    f[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
    const double minus_o43_y = orthoglide_2012_geo_a - q[5] + s10*c11*orthoglide_2012_geo_d4;
    f[7] = orthoglide_2012_geo_d6 - minus_o43_y - q[1];
    f[8] = orthoglide_2012_geo_a + c10*c11*orthoglide_2012_geo_d4 - q[2];
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 8 additions, 22 multiplications. */
void orthoglide_2012_tree_factor(const double J[27], double MODELER_OUT(lu, 25))
{
    const double t1 = 1.0/J[1];
    lu[0] = t1;
    const double t2 = 1.0/J[4];
    lu[1] = t2;
    const double t3 = 1.0/J[14];
    lu[2] = t3;
    const double t4 = 1.0/J[17];
    lu[3] = t4;
    lu[4] = -1.0;
    const double t5 = 1.0/J[25];
    lu[5] = t5;
    lu[6] = -1.0;
    const double t6 = J[11]*t3;
    const double t7 = (J[12] - J[15]*t6)*t4;
    const double t8 = J[7]*t1;
    const double t9 = J[19]*t8;
    const double t10 = 1.0/(J[19] - t7*t9);
    lu[7] = -t10;
    const double t11 = (J[8] - J[2]*t8)*t2;
    const double t12 = J[22]*t5;
    const double t13 = t6 + t11*t7;
    const double t14 = (J[23] - J[26]*t12 + t9*t12)*t10;
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

/* Solution with the factors.
 * 22 additions, 25 multiplications. */
void orthoglide_2012_tree_solve(const double lu[25], const double right[9],
                                double MODELER_OUT(x, 9))
{
    const double t1 = right[2] - lu[10]*right[0] - lu[11]*right[1] - lu[16]*right[6];
    const double t2 = lu[14]*right[5] - (right[3] - lu[13]*right[4]) + right[6] + lu[21]*t1;
    const double t3 = lu[8]*(right[7] - lu[18]*right[8] - lu[22]*t1 + lu[24]*t2);
    const double t4 = lu[7]*(t2 + lu[23]*t3);
    const double t5 = lu[4]*(right[6] + lu[15]*t4);
    x[0] = t5;
    x[1] = t3;
    const double t6 = lu[6]*(t1 - lu[19]*t3 + lu[20]*t4);
    x[2] = t6;
    const double t7 = lu[1]*(right[1] + t3);
    x[3] = lu[0]*(right[0] + t5 - lu[9]*t7);
    x[4] = t7;
    const double t8 = lu[3]*(right[5] + t6);
    x[5] = lu[2]*(right[4] + t3 - lu[12]*t8);
    x[6] = t8;
    x[7] = lu[5]*(right[8] + t6 + lu[17]*t4);
    x[8] = -t4;
}

/* G from the factors.
 * 16 additions, 48 multiplications. */
void orthoglide_2012_tree_coupling(const double J[27], const double lu[25],
                                   double MODELER_OUT(G, 27))
{
    (void)J;

    const double t1 = lu[8]*(lu[22] - lu[21]*lu[24]);
    const double t2 = lu[7]*(lu[21] - lu[23]*t1);
    const double t3 = lu[15]*t2*lu[4];
    G[0] = -t3;
    G[1] = t1;
    const double t4 = lu[6]*(1.0 + lu[19]*t1 + lu[20]*t2);
    G[2] = -t4;
    const double t5 = lu[1]*t1;
    G[3] = -lu[0]*(t3 + lu[9]*t5);
    G[4] = t5;
    const double t6 = lu[3]*t4;
    G[5] = lu[2]*(t1 + lu[12]*t6);
    G[6] = -t6;
    G[7] = -lu[5]*(t4 + lu[17]*t2);
    G[8] = t2;
    const double t7 = lu[8]*lu[24];
    const double t8 = lu[7]*(1.0 + lu[23]*t7);
    const double t9 = lu[15]*t8*lu[4];
    G[9] = t9;
    G[10] = t7;
    const double t10 = lu[6]*(lu[19]*t7 - lu[20]*t8);
    G[11] = -t10;
    const double t11 = lu[1]*t7;
    G[12] = lu[0]*(t9 - lu[9]*t11);
    G[13] = t11;
    const double t12 = lu[3]*t10;
    G[14] = lu[2]*(t7 + lu[12]*t12);
    G[15] = -t12;
    G[16] = -lu[5]*(t10 - lu[17]*t8);
    G[17] = -t8;
    const double t13 = lu[8]*lu[23]*lu[7];
    const double t14 = lu[15]*t13*lu[4];
    G[18] = -t14;
    G[19] = -lu[8];
    const double t15 = lu[6]*(lu[8]*lu[19] - lu[20]*t13);
    G[20] = t15;
    const double t16 = lu[1]*lu[8];
    G[21] = -lu[0]*(t14 - lu[9]*t16);
    G[22] = -t16;
    const double t17 = lu[3]*t15;
    G[23] = -lu[2]*(lu[8] + lu[12]*t17);
    G[24] = t17;
    G[25] = lu[5]*(t15 - lu[17]*t13);
    G[26] = t13;
}

/* Bounds of the rows of J^-1 (K - J).
 * 43 additions, 32 multiplications. */
void orthoglide_2012_tree_turned(const double J[27], const double K[27], const double lu[25],
                                 double MODELER_OUT(x, 9))
{
    const double k1 = fabs(1.0);

    const double t1 = fabs(J[19] - K[19]);
    const double t2 = fabs(J[14] - K[14]) + fabs(J[15] - K[15]);
    const double t3 = fabs(J[17] - K[17]);
    const double t4 = fabs(J[11] - K[11]) + fabs(J[12] - K[12]) + t2*fabs(lu[13]);
    const double t5 = fabs(J[1] - K[1]) + fabs(J[2] - K[2]);
    const double t6 = fabs(J[4] - K[4]);
    const double t7 = fabs(J[7] - K[7]) + fabs(J[8] - K[8]) + t5*fabs(lu[10]) + t6*fabs(lu[11]);
    const double t8 = t7 + t1*fabs(lu[16]);
    const double t9 = t4 + t3*fabs(lu[14]) + k1*t1 + t8*fabs(lu[21]);
    const double t10 = fabs(J[25] - K[25]) + fabs(J[26] - K[26]);
    const double t11 = fabs(J[22] - K[22]) + fabs(J[23] - K[23]) + t10*fabs(lu[18]);
    const double t12 = (t11 + t8*fabs(lu[22]) + t9*fabs(lu[24]))*fabs(lu[8]);
    const double t13 = (t9 + t12*fabs(lu[23]))*fabs(lu[7]);
    const double t14 = (t1 + t13*fabs(lu[15]))*fabs(lu[4]);
    x[0] = (1000000000000000.0/848528137423857.0)*t14;
    x[1] = (1000000000000000.0/848528137423857.0)*t12;
    const double t15 = (t8 + t12*fabs(lu[19]) + t13*fabs(lu[20]))*fabs(lu[6]);
    x[2] = (1000000000000000.0/848528137423857.0)*t15;
    const double t16 = k1*t12;
    const double t17 = (t6 + t16)*fabs(lu[1]);
    x[3] = (t5 + k1*t14 + t17*fabs(lu[9]))*fabs(lu[0]);
    x[4] = t17;
    const double t18 = k1*t15;
    const double t19 = (t3 + t18)*fabs(lu[3]);
    x[5] = (t2 + t16 + t19*fabs(lu[12]))*fabs(lu[2]);
    x[6] = t19;
    x[7] = (t10 + t18 + t13*fabs(lu[17]))*fabs(lu[5]);
    x[8] = t13;
}

/* Sum of the squares of J^-1 (K - J).
 * 122 additions, 188 multiplications. */
void orthoglide_2012_tree_spread(const double J[27], const double K[27], const double lu[25],
                                 double MODELER_OUT(x, 1))
{
    const double t1 = J[1] - K[1];
    const double t2 = J[7] - K[7] - lu[10]*t1;
    const double t3 = lu[21]*t2;
    const double t4 = lu[8]*(lu[22]*t2 - lu[24]*t3);
    const double t5 = lu[7]*(t3 - lu[23]*t4);
    const double t6 = lu[15]*t5*lu[4];
    const double t7 = (1000000000000000.0/848528137423857.0)*t6;
    const double t8 = (1000000000000000.0/848528137423857.0)*t4;
    const double t9 = lu[6]*(t2 + lu[19]*t4 + lu[20]*t5);
    const double t10 = (1000000000000000.0/848528137423857.0)*t9;
    const double t11 = lu[1]*t4;
    const double t12 = lu[0]*(t1 + t6 + lu[9]*t11);
    const double t13 = lu[3]*t9;
    const double t14 = lu[2]*(t4 + lu[12]*t13);
    const double t15 = lu[5]*(t9 + lu[17]*t5);
    const double t16 = t7*t7 + t8*t8 + t10*t10 + t12*t12 + t11*t11 + t14*t14 + t13*t13 + t15*t15;
    const double t17 = J[2] - K[2];
    const double t18 = J[4] - K[4];
    const double t19 = J[8] - K[8] - lu[10]*t17 - lu[11]*t18;
    const double t20 = lu[21]*t19;
    const double t21 = lu[8]*(lu[22]*t19 - lu[24]*t20);
    const double t22 = lu[7]*(t20 - lu[23]*t21);
    const double t23 = lu[15]*t22*lu[4];
    const double t24 = (1000000000000000.0/848528137423857.0)*t23;
    const double t25 = (1000000000000000.0/848528137423857.0)*t21;
    const double t26 = lu[6]*(t19 + lu[19]*t21 + lu[20]*t22);
    const double t27 = (1000000000000000.0/848528137423857.0)*t26;
    const double t28 = lu[1]*(t18 - t21);
    const double t29 = lu[0]*(t17 + t23 - lu[9]*t28);
    const double t30 = lu[3]*t26;
    const double t31 = lu[2]*(t21 + lu[12]*t30);
    const double t32 = t16 + t5*t5 + t24*t24 + t25*t25 + t27*t27 + t29*t29 + t28*t28 + t31*t31;
    const double t33 = lu[5]*(t26 + lu[17]*t22);
    const double t34 = J[14] - K[14];
    const double t35 = J[11] - K[11] - lu[13]*t34;
    const double t36 = lu[24]*t35*lu[8];
    const double t37 = lu[7]*(t35 + lu[23]*t36);
    const double t38 = lu[15]*t37*lu[4];
    const double t39 = (1000000000000000.0/848528137423857.0)*t38;
    const double t40 = (1000000000000000.0/848528137423857.0)*t36;
    const double t41 = lu[6]*(lu[19]*t36 - lu[20]*t37);
    const double t42 = (1000000000000000.0/848528137423857.0)*t41;
    const double t43 = lu[1]*t36;
    const double t44 = lu[0]*(t38 - lu[9]*t43);
    const double t45 = t32 + t30*t30 + t33*t33 + t22*t22 + t39*t39 + t40*t40 + t42*t42 + t44*t44;
    const double t46 = lu[3]*t41;
    const double t47 = lu[2]*(t34 - t36 - lu[12]*t46);
    const double t48 = lu[5]*(t41 - lu[17]*t37);
    const double t49 = J[15] - K[15];
    const double t50 = J[17] - K[17];
    const double t51 = J[12] - K[12] - lu[13]*t49 - lu[14]*t50;
    const double t52 = lu[24]*t51*lu[8];
    const double t53 = lu[7]*(t51 + lu[23]*t52);
    const double t54 = lu[15]*t53*lu[4];
    const double t55 = (1000000000000000.0/848528137423857.0)*t54;
    const double t56 = (1000000000000000.0/848528137423857.0)*t52;
    const double t57 = lu[6]*(lu[19]*t52 - lu[20]*t53);
    const double t58 = (1000000000000000.0/848528137423857.0)*t57;
    const double t59 = t45 + t43*t43 + t47*t47 + t46*t46 + t48*t48 + t37*t37 + t55*t55 + t56*t56;
    const double t60 = lu[1]*t52;
    const double t61 = lu[0]*(t54 - lu[9]*t60);
    const double t62 = lu[3]*(t50 + t57);
    const double t63 = lu[2]*(t49 - t52 - lu[12]*t62);
    const double t64 = lu[5]*(t57 - lu[17]*t53);
    const double t65 = J[25] - K[25];
    const double t66 = lu[8]*(J[22] - K[22] - lu[18]*t65);
    const double t67 = lu[23]*t66*lu[7];
    const double t68 = lu[15]*t67*lu[4];
    const double t69 = (1000000000000000.0/848528137423857.0)*t68;
    const double t70 = t59 + t58*t58 + t61*t61 + t60*t60 + t63*t63 + t62*t62 + t64*t64 + t53*t53;
    const double t71 = (1000000000000000.0/848528137423857.0)*t66;
    const double t72 = lu[6]*(lu[19]*t66 - lu[20]*t67);
    const double t73 = (1000000000000000.0/848528137423857.0)*t72;
    const double t74 = lu[1]*t66;
    const double t75 = lu[0]*(t68 - lu[9]*t74);
    const double t76 = lu[3]*t72;
    const double t77 = lu[2]*(t66 + lu[12]*t76);
    const double t78 = lu[5]*(t65 - t72 + lu[17]*t67);
    const double t79 = t70 + t69*t69 + t71*t71 + t73*t73 + t75*t75 + t74*t74 + t77*t77 + t76*t76;
    const double t80 = J[19] - K[19];
    const double t81 = lu[16]*t80;
    const double t82 = t80 - lu[21]*t81;
    const double t83 = J[26] - K[26];
    const double t84 = lu[8]*(J[23] - K[23] - lu[18]*t83 + lu[22]*t81 + lu[24]*t82);
    const double t85 = lu[7]*(t82 + lu[23]*t84);
    const double t86 = lu[4]*(t80 + lu[15]*t85);
    const double t87 = (1000000000000000.0/848528137423857.0)*t86;
    const double t88 = (1000000000000000.0/848528137423857.0)*t84;
    const double t89 = lu[6]*(t81 + lu[19]*t84 - lu[20]*t85);
    const double t90 = (1000000000000000.0/848528137423857.0)*t89;
    const double t91 = lu[1]*t84;
    const double t92 = lu[0]*(t86 - lu[9]*t91);
    const double t93 = lu[3]*t89;
    const double t94 = lu[2]*(t84 + lu[12]*t93);
    const double t95 = t79 + t78*t78 + t67*t67 + t87*t87 + t88*t88 + t90*t90 + t92*t92 + t91*t91;
    const double t96 = lu[5]*(t83 - t89 + lu[17]*t85);
    x[0] = t95 + t94*t94 + t93*t93 + t96*t96 + t85*t85;
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 0 additions, 11 multiplications. */
void orthoglide_2012_tree_platform_factor(const double J[27], double MODELER_OUT(lu, 18))
{
    const double t1 = 1.0/J[4];
    lu[0] = t1;
    const double t2 = 1.0/J[1];
    lu[1] = t2;
    lu[2] = 1.0;
    lu[3] = 1.0;
    lu[4] = 1.0/J[14];
    lu[5] = 1.0/J[17];
    const double t3 = 1.0/J[19];
    lu[6] = t3;
    lu[7] = 1.0;
    lu[8] = 1.0/J[25];
    lu[9] = J[2]*t1;
    lu[10] = J[8]*t1;
    lu[11] = J[7]*t2;
    lu[12] = J[11];
    lu[13] = J[12];
    lu[14] = J[15];
    lu[15] = J[23]*t3;
    lu[16] = J[26]*t3;
    lu[17] = J[22];
}

/* Solution with the factors.
 * 9 additions, 18 multiplications. */
void orthoglide_2012_tree_platform_solve(const double lu[18], const double right[9],
                                         double MODELER_OUT(x, 9))
{
    const double t1 = right[0] - lu[9]*right[1];
    x[0] = lu[2]*(right[2] - lu[10]*right[1] - lu[11]*t1);
    const double t2 = lu[5]*right[5];
    const double t3 = lu[4]*(right[4] - lu[14]*t2);
    x[1] = lu[3]*(right[3] - lu[12]*t3 - lu[13]*t2);
    const double t4 = lu[8]*(right[8] - lu[16]*right[6]);
    x[2] = lu[7]*(right[7] - lu[15]*right[6] - lu[17]*t4);
    x[3] = lu[1]*t1;
    x[4] = lu[0]*right[1];
    x[5] = t3;
    x[6] = t2;
    x[7] = t4;
    x[8] = lu[6]*right[6];
}

/* G from the factors.
 * 3 additions, 16 multiplications. */
void orthoglide_2012_tree_platform_coupling(const double J[27], const double lu[18],
                                            double MODELER_OUT(G, 18))
{
    (void)J;

    G[0] = -lu[2]*lu[11];
    G[1] = lu[3];
    const double t1 = lu[8]*lu[16];
    G[2] = -lu[7]*(lu[15] - lu[17]*t1);
    G[3] = lu[1];
    G[4] = -t1;
    G[5] = lu[6];
    G[6] = -lu[2]*(lu[10] - lu[9]*lu[11]);
    G[7] = -lu[4]*lu[12]*lu[3];
    G[8] = lu[7];
    G[9] = -lu[1]*lu[9];
    G[10] = lu[0];
    G[11] = lu[4];
    G[12] = lu[2];
    const double t2 = lu[5]*lu[14]*lu[4];
    G[13] = lu[3]*(lu[12]*t2 - lu[5]*lu[13]);
    G[14] = -lu[8]*lu[17]*lu[7];
    G[15] = -t2;
    G[16] = lu[5];
    G[17] = lu[8];
}

/* Bounds of the rows of J^-1 (K - J).
 * 30 additions, 21 multiplications. */
void orthoglide_2012_tree_platform_turned(const double J[27], const double K[27],
                                          const double lu[18], double MODELER_OUT(x, 9))
{
    const double t1 = fabs(J[4] - K[4]);
    const double t2 = fabs(J[1] - K[1]) + fabs(J[2] - K[2]) + t1*fabs(lu[9]);
    const double t3 = fabs(J[7] - K[7]) + fabs(J[8] - K[8]) + t1*fabs(lu[10]) + fabs(lu[11])*t2;
    x[0] = fabs(lu[2])*t3*(1000000000000000.0/848528137423857.0);
    const double t4 = fabs(J[17] - K[17])*fabs(lu[5]);
    const double t5 = fabs(lu[4])*(fabs(J[14] - K[14]) + fabs(J[15] - K[15]) + fabs(lu[14])*t4);
    const double t6 = fabs(J[11] - K[11]) + fabs(J[12] - K[12]) + fabs(lu[12])*t5;
    x[1] = fabs(lu[3])*(t6 + fabs(lu[13])*t4)*(1000000000000000.0/848528137423857.0);
    const double t7 = fabs(J[19] - K[19]);
    const double t8 = fabs(lu[8])*(fabs(J[25] - K[25]) + fabs(J[26] - K[26]) + t7*fabs(lu[16]));
    const double t9 = fabs(J[22] - K[22]) + fabs(J[23] - K[23]) + t7*fabs(lu[15]);
    x[2] = fabs(lu[7])*(t9 + fabs(lu[17])*t8)*(1000000000000000.0/848528137423857.0);
    x[3] = fabs(lu[1])*t2;
    x[4] = t1*fabs(lu[0]);
    x[5] = t5;
    x[6] = t4;
    x[7] = t8;
    x[8] = t7*fabs(lu[6]);
}

/* Sum of the squares of J^-1 (K - J).
 * 41 additions, 48 multiplications. */
void orthoglide_2012_tree_platform_spread(const double J[27], const double K[27],
                                          const double lu[18], double MODELER_OUT(x, 1))
{
    const double t1 = J[1] - K[1];
    const double t2 = lu[2]*(J[7] - K[7] - lu[11]*t1)*(1000000000000000.0/848528137423857.0);
    const double t3 = lu[1]*t1;
    const double t4 = J[4] - K[4];
    const double t5 = J[2] - K[2] - lu[9]*t4;
    const double t6 = lu[2]*(J[8] - K[8] - lu[10]*t4 - lu[11]*t5);
    const double t7 = (1000000000000000.0/848528137423857.0)*t6;
    const double t8 = lu[1]*t5;
    const double t9 = lu[0]*t4;
    const double t10 = lu[4]*(J[14] - K[14]);
    const double t11 = lu[3]*(J[11] - K[11] - lu[12]*t10)*(1000000000000000.0/848528137423857.0);
    const double t12 = lu[5]*(J[17] - K[17]);
    const double t13 = lu[4]*(J[15] - K[15] - lu[14]*t12);
    const double t14 = lu[3]*(J[12] - K[12] - lu[12]*t13 - lu[13]*t12);
    const double t15 = (1000000000000000.0/848528137423857.0)*t14;
    const double t16 = t2*t2 + t3*t3 + t7*t7 + t8*t8 + t9*t9 + t11*t11 + t10*t10 + t15*t15;
    const double t17 = lu[8]*(J[25] - K[25]);
    const double t18 = lu[7]*(J[22] - K[22] - lu[17]*t17)*(1000000000000000.0/848528137423857.0);
    const double t19 = J[19] - K[19];
    const double t20 = lu[8]*(J[26] - K[26] - lu[16]*t19);
    const double t21 = lu[7]*(J[23] - K[23] - lu[15]*t19 - lu[17]*t20);
    const double t22 = (1000000000000000.0/848528137423857.0)*t21;
    const double t23 = lu[6]*t19;
    x[0] = t16 + t13*t13 + t12*t12 + t18*t18 + t17*t17 + t22*t22 + t20*t20 + t23*t23;
}

/* Base parameters from standard ones: the grouping relations.
 * 103 additions, 21 multiplications. */
void orthoglide_2012_base_parameters(const double chi[ORTHOGLIDE_2012_STANDARD_PARAMETERS],
                                     double MODELER_OUT(beta, ORTHOGLIDE_2012_BASE_PARAMETERS))
{
    const double k1 = 1.0/orthoglide_2012_geo_d4;
    const double k2 = orthoglide_2012_geo_d4*orthoglide_2012_geo_d4;

    const double t1 = k1*chi[111];
    const double t2 = chi[0] + chi[10] + chi[11] + chi[49] + chi[62] + chi[75] + chi[88] + t1;
    const double t3 = k1*chi[163];
    beta[0] = chi[127] + t2 + chi[140] + t3 + chi[179] + chi[192];
    beta[1] = chi[12];
    beta[2] = chi[13];
    beta[3] = chi[23] + chi[24] + chi[101] - t1 + chi[114];
    beta[4] = chi[25];
    beta[5] = chi[26];
    beta[6] = chi[36] + chi[153] - t3 + chi[166];
    beta[7] = chi[37];
    beta[8] = chi[38];
    beta[9] = chi[39];
    const double t4 = k2*chi[0];
    const double t5 = k2*chi[75];
    const double t6 = k2*chi[88];
    const double t7 = orthoglide_2012_geo_d4*chi[111];
    const double t8 = k2*chi[127];
    const double t9 = k2*chi[140];
    const double t10 = chi[45] + t4 + chi[50] + chi[56] + chi[69] + t5 + t6 + chi[89] + t7 + t8;
    const double t11 = orthoglide_2012_geo_d4*chi[163];
    const double t12 = k2*chi[179];
    const double t13 = k2*chi[192];
    beta[10] = t10 + t9 + t11 + t12 + t13;
    beta[11] = chi[46];
    beta[12] = chi[47] + chi[61] + chi[74];
    beta[13] = chi[51] + chi[90];
    beta[14] = chi[52] + chi[91];
    beta[15] = -(t4 - chi[53] + chi[56] + t5 + t6 + t7 + t8 + t9 + t11 + t12 + t13);
    beta[16] = chi[54];
    beta[17] = chi[55] - orthoglide_2012_geo_d4*chi[74];
    beta[18] = chi[57];
    const double t14 = chi[58] + t4 + chi[63] + t5 + chi[76] + t6 + t7 + t8 + t9 + t11 + t12;
    beta[19] = t13 + t14;
    const double t15 = chi[59] + orthoglide_2012_geo_d4*chi[0] + orthoglide_2012_geo_d4*chi[75];
    const double t16 = t15 + orthoglide_2012_geo_d4*chi[88] + chi[111];
    const double t17 = t16 + orthoglide_2012_geo_d4*chi[127] + orthoglide_2012_geo_d4*chi[140];
    const double t18 = chi[163] + t17 + orthoglide_2012_geo_d4*chi[179];
    beta[20] = t18 + orthoglide_2012_geo_d4*chi[192];
    beta[21] = chi[60];
    beta[22] = chi[64] + chi[77];
    beta[23] = chi[65] + chi[78];
    beta[24] = chi[72];
    beta[25] = chi[97] + chi[102] + chi[108] - t7 + chi[121] + chi[141];
    beta[26] = chi[98];
    beta[27] = chi[99] + chi[113] + chi[126];
    beta[28] = chi[103] + chi[142];
    beta[29] = chi[104] + chi[143];
    beta[30] = chi[105] - chi[108] + t7;
    beta[31] = chi[106];
    beta[32] = chi[107] - orthoglide_2012_geo_d4*chi[126];
    beta[33] = chi[109];
    beta[34] = chi[110] - t7 + chi[115] + chi[128];
    beta[35] = chi[112];
    beta[36] = chi[116] + chi[129];
    beta[37] = chi[117] + chi[130];
    beta[38] = chi[124];
    beta[39] = chi[149] + chi[154] + chi[160] - t11 + chi[173] + chi[193];
    beta[40] = chi[150];
    beta[41] = chi[151] + chi[165] + chi[178];
    beta[42] = chi[155] + chi[194];
    beta[43] = chi[156] + chi[195];
    beta[44] = chi[157] - chi[160] + t11;
    beta[45] = chi[158];
    beta[46] = chi[159] - orthoglide_2012_geo_d4*chi[178];
    beta[47] = chi[161];
    beta[48] = chi[162] - t11 + chi[167] + chi[180];
    beta[49] = chi[164];
    beta[50] = chi[168] + chi[181];
    beta[51] = chi[169] + chi[182];
    beta[52] = chi[176];
}
