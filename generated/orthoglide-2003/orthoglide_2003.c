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
 *   h      angular momentum J w
 *   f      force on the link
 *   n      moment on the link at its origin
 *   fc     force on the link and all that it carries
 *   MSc    first moments of the link and all that it carries
 *   Jc     inertia of the link and all that it carries
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   p      origin of the frame in that of its antecedent
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: fc, lin, vd
 *   ...d   derivative by a variable, qd2 for qd[2], or by the time, t: x, y
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
static const double orthoglide_2003_geo_b3 = ORTHOGLIDE_2003_GEO_b3;
static const double orthoglide_2003_geo_b7 = ORTHOGLIDE_2003_GEO_b7;
static const double orthoglide_2003_geo_a = ORTHOGLIDE_2003_GEO_a;
static const double orthoglide_2003_geo_d6 = ORTHOGLIDE_2003_GEO_d6;

/* Joint torques, by the Newton-Euler recursion.
 * 165 additions, 226 multiplications. */
void orthoglide_2003_tree_inverse_dynamics(const double q[12], const double qd[12],
                                           const double qdd[12], const double beta[43],
                                           double MODELER_OUT(tau, 12))
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

    tau[0] = qdd[0]*beta[0];
    tau[1] = (qdd[1] - orthoglide_2003_geo_g)*beta[0];
    tau[2] = qdd[2]*beta[0];
    const double ww21_zz = qd[6]*qd[6];
    /* link 41: force on the link, f41 = M41 vd41 + U41 MS41 */
    const double minus_f41_x = ww21_zz*beta[22];
    /* link 41: force on the link and all that it carries, fc41 = f41 + sum of R fc of what hangs on
        it */
    const double fc41a_y = s7*minus_f41_x;
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_x = s7*qd[6];
    const double ww31_zz = qd[7]*qd[7];
    const double minus_w31_y = c7*qd[6];
    const double ww31_xy = minus_w31_x*minus_w31_y;
    /* link 31: force on the link and all that it carries, fc31 = f31 + sum of R fc of what hangs on
        it */
    const double minus_fc31a_x = s7*(fc41a_y - (minus_w31_x*minus_w31_x + ww31_zz)*beta[21]) +
        c7*(c7*minus_f41_x + (qdd[7] - ww31_xy)*beta[21]);
    const double f41_z = qdd[6]*beta[22];
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = s7*qdd[6] + minus_ww31_yz;
    const double t12 = c6*(f41_z - (minus_ww31_yz + minus_wd31_x)*beta[21] + (qdd[6]*beta[14] -
        ww21_zz*beta[15]));
    const double t13 = s6*(ww21_zz*beta[14] + qdd[6]*beta[15] + minus_fc31a_x) - t12 +
        qdd[3]*beta[1];
    tau[3] = qd[3]*beta[2] + t13 + modeler_sign(qd[3])*beta[3] + beta[4];
    const double ww22_zz = qd[8]*qd[8];
    /* link 42: force on the link, f42 = M42 vd42 + U42 MS42 */
    const double minus_f42_x = ww22_zz*beta[32];
    /* link 42: force on the link and all that it carries, fc42 = f42 + sum of R fc of what hangs on
        it */
    const double fc42a_y = s9*minus_f42_x;
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_x = s9*qd[8];
    const double ww32_zz = qd[9]*qd[9];
    const double minus_w32_y = c9*qd[8];
    const double ww32_xy = minus_w32_x*minus_w32_y;
    const double t21 = c9*(c9*minus_f42_x + (qdd[9] - ww32_xy)*beta[31]);
    /* link 32: force on the link and all that it carries, fc32 = f32 + sum of R fc of what hangs on
        it */
    const double minus_fc32a_x = s9*(fc42a_y - (minus_w32_x*minus_w32_x + ww32_zz)*beta[31]) + t21;
    const double f42_z = qdd[8]*beta[32];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = s9*qdd[8] + minus_ww32_yz;
    const double t26 = c8*(f42_z - (minus_ww32_yz + minus_wd32_x)*beta[31] + (qdd[8]*beta[24] -
        ww22_zz*beta[25]));
    const double t27 = s8*(ww22_zz*beta[24] + qdd[8]*beta[25] + minus_fc32a_x) - t26 +
        qdd[4]*beta[5];
    tau[4] = qd[4]*beta[6] + t27 + modeler_sign(qd[4])*beta[7] + beta[8];
    const double ww23_zz = qd[10]*qd[10];
    /* link 43: force on the link, f43 = M43 vd43 + U43 MS43 */
    const double minus_f43_x = ww23_zz*beta[42];
    /* link 43: force on the link and all that it carries, fc43 = f43 + sum of R fc of what hangs on
        it */
    const double fc43a_y = s11*minus_f43_x;
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_x = s11*qd[10];
    const double ww33_zz = qd[11]*qd[11];
    const double minus_w33_y = c11*qd[10];
    const double ww33_xy = minus_w33_x*minus_w33_y;
    const double t35 = c11*(c11*minus_f43_x + (qdd[11] - ww33_xy)*beta[41]);
    /* link 33: force on the link and all that it carries, fc33 = f33 + sum of R fc of what hangs on
        it */
    const double minus_fc33a_x = s11*(fc43a_y - (minus_w33_x*minus_w33_x + ww33_zz)*beta[41]) + t35;
    const double f43_z = qdd[10]*beta[42];
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = s11*qdd[10] + minus_ww33_yz;
    const double t40 = c10*(f43_z - (minus_ww33_yz + minus_wd33_x)*beta[41] + (qdd[10]*beta[34] -
        ww23_zz*beta[35]));
    const double t41 = s10*(ww23_zz*beta[34] + qdd[10]*beta[35] + minus_fc33a_x) - t40 +
        qdd[5]*beta[9];
    tau[5] = qd[5]*beta[10] + t41 + modeler_sign(qd[5])*beta[11] + beta[12];
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    const double minus_wd31_y = c7*qdd[6] - minus_ww31_xz;
    /* link 41: moment on the link at its origin, n41 = J41 wd41 + w41 x J41 w41 + MS41 x vd41 */
    const double n41_y = (minus_vd21_y + orthoglide_2003_geo_D41*(minus_ww31_xz -
        minus_wd31_y))*beta[22];
    const double minus_h31_z = minus_w31_x*beta[18] + minus_w31_y*beta[19] - qd[7]*beta[20];
    const double minus_h31_y = minus_w31_x*beta[17] - qd[7]*beta[19];
    const double t48 = minus_w31_y*minus_h31_z + qd[7]*minus_h31_y + (qdd[7]*beta[18] -
        (minus_wd31_x*beta[16] + minus_wd31_y*beta[17]));
    const double minus_h31_x = minus_w31_x*beta[16] + minus_w31_y*beta[17] - qd[7]*beta[18];
    /* link 31: moment on the link at its origin, n31 = J31 wd31 + w31 x J31 w31 + MS31 x vd31 */
    const double minus_n31_y = qd[7]*minus_h31_x + minus_w31_x*minus_h31_z + (minus_wd31_x*beta[17]
        - qdd[7]*beta[19]);
    const double t51 = c7*(c7*n41_y - orthoglide_2003_geo_D41*f41_z - minus_n31_y);
    const double minus_vd21_x = s6*qdd[3];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = minus_vd21_x*beta[15] - minus_vd21_y*beta[14] + qdd[6]*beta[13];
    tau[6] = n21_z - (s7*(t48 - minus_vd21_y*beta[21] + s7*n41_y) + t51);
    /* link 41: acceleration of the origin less gravity, vd41 = R41' (vd31 + U31 p41) */
    const double vd41a_y = orthoglide_2003_geo_g*c7 + s7*minus_vd21_x +
        orthoglide_2003_geo_D41*(qdd[7] + ww31_xy);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double minus_vd31_x = c7*minus_vd21_x - orthoglide_2003_geo_g*s7;
    const double n41_z = (c7*vd41a_y - s7*(minus_vd31_x +
        orthoglide_2003_geo_D41*(minus_w31_y*minus_w31_y + ww31_zz)))*beta[22];
    const double t57 = minus_w31_x*minus_h31_y - minus_w31_y*minus_h31_x + (qdd[7]*beta[20] -
        (minus_wd31_x*beta[18] + minus_wd31_y*beta[19]));
    tau[7] = orthoglide_2003_geo_D41*fc41a_y + n41_z + (t57 + minus_vd31_x*beta[21]) - n41_z;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    const double minus_wd32_y = c9*qdd[8] - minus_ww32_xz;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double n42_y = (minus_vd22_y + orthoglide_2003_geo_D42*(minus_ww32_xz -
        minus_wd32_y))*beta[32];
    const double minus_h32_z = minus_w32_x*beta[28] + minus_w32_y*beta[29] - qd[9]*beta[30];
    const double minus_h32_y = minus_w32_x*beta[27] - qd[9]*beta[29];
    const double t64 = minus_w32_y*minus_h32_z + qd[9]*minus_h32_y + (qdd[9]*beta[28] -
        (minus_wd32_x*beta[26] + minus_wd32_y*beta[27]));
    const double minus_h32_x = minus_w32_x*beta[26] + minus_w32_y*beta[27] - qd[9]*beta[28];
    /* link 32: moment on the link at its origin, n32 = J32 wd32 + w32 x J32 w32 + MS32 x vd32 */
    const double minus_n32_y = qd[9]*minus_h32_x + minus_w32_x*minus_h32_z + (minus_wd32_x*beta[27]
        - qdd[9]*beta[29]);
    const double t67 = c9*(c9*n42_y - orthoglide_2003_geo_D42*f42_z - minus_n32_y);
    const double minus_vd22_x = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = minus_vd22_x*beta[25] - minus_vd22_y*beta[24] + qdd[8]*beta[23];
    tau[8] = n22_z - (s9*(t64 - minus_vd22_y*beta[31] + s9*n42_y) + t67);
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) */
    const double minus_vd32_x = c9*minus_vd22_x;
    const double t71 = c9*(s9*minus_vd22_x + orthoglide_2003_geo_D42*(qdd[9] + ww32_xy));
    const double n42_z = (t71 - s9*(minus_vd32_x + orthoglide_2003_geo_D42*(minus_w32_y*minus_w32_y
        + ww32_zz)))*beta[32];
    const double t73 = minus_w32_x*minus_h32_y - minus_w32_y*minus_h32_x + (qdd[9]*beta[30] -
        (minus_wd32_x*beta[28] + minus_wd32_y*beta[29]));
    tau[9] = orthoglide_2003_geo_D42*fc42a_y + n42_z + (t73 + minus_vd32_x*beta[31]) - n42_z;
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2003_geo_g;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    const double minus_wd33_y = c11*qdd[10] - minus_ww33_xz;
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double n43_y = (minus_vd23_y + orthoglide_2003_geo_D43*(minus_ww33_xz -
        minus_wd33_y))*beta[42];
    const double minus_h33_z = minus_w33_x*beta[38] + minus_w33_y*beta[39] - qd[11]*beta[40];
    const double minus_h33_y = minus_w33_x*beta[37] - qd[11]*beta[39];
    const double t81 = minus_w33_y*minus_h33_z + qd[11]*minus_h33_y + (qdd[11]*beta[38] -
        (minus_wd33_x*beta[36] + minus_wd33_y*beta[37]));
    const double minus_h33_x = minus_w33_x*beta[36] + minus_w33_y*beta[37] - qd[11]*beta[38];
    /* link 33: moment on the link at its origin, n33 = J33 wd33 + w33 x J33 w33 + MS33 x vd33 */
    const double minus_n33_y = qd[11]*minus_h33_x + minus_w33_x*minus_h33_z + (minus_wd33_x*beta[37]
        - qdd[11]*beta[39]);
    const double t84 = c11*(c11*n43_y - orthoglide_2003_geo_D43*f43_z - minus_n33_y);
    const double minus_vd23_x = s10*vd13_z;
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double n23_z = minus_vd23_x*beta[35] - minus_vd23_y*beta[34] + qdd[10]*beta[33];
    tau[10] = n23_z - (s11*(t81 - minus_vd23_y*beta[41] + s11*n43_y) + t84);
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) */
    const double minus_vd33_x = c11*minus_vd23_x;
    const double t88 = c11*(s11*minus_vd23_x + orthoglide_2003_geo_D43*(qdd[11] + ww33_xy));
    const double n43_z = (t88 - s11*(minus_vd33_x + orthoglide_2003_geo_D43*(minus_w33_y*minus_w33_y
        + ww33_zz)))*beta[42];
    const double t90 = minus_w33_x*minus_h33_y - minus_w33_y*minus_h33_x + (qdd[11]*beta[40] -
        (minus_wd33_x*beta[38] + minus_wd33_y*beta[39]));
    tau[11] = orthoglide_2003_geo_D43*fc43a_y + n43_z + (t90 + minus_vd33_x*beta[41]) - n43_z;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 33 additions, 57 multiplications. */
void orthoglide_2003_tree_inertia_matrix(const double q[12], const double beta[43],
                                         double MODELER_OUT(M, 12 * 12))
{
    MODELER_ALL_ZEROS(M, 144);

    const double k1 = orthoglide_2003_geo_D43*2.0;
    const double k2 = orthoglide_2003_geo_D42*2.0;
    const double k3 = orthoglide_2003_geo_D41*2.0;

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

    M[0] = beta[0];
    M[13] = beta[0];
    M[26] = beta[0];
    MODELER_ZEROS(M + 1, 8);
    M[39] = beta[1];
    /* link 31: first moments of the link and all that it carries, MSc31 = MS31 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc31_x = c7*beta[22];
    MODELER_ZEROS(M + 9, 4);
    const double lin41a_41x = s7*beta[22];
    const double MSc31_y = beta[21] - lin41a_41x;
    MODELER_ZEROS(M + 14, 8);
    /* link 11: first moments of the link and all that it carries, MSc11 = MS11 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc11_x = s6*beta[15] - c6*(c7*MSc31_x - s7*MSc31_y + beta[14]);
    M[42] = minus_MSc11_x;
    MODELER_ZEROS(M + 22, 4);
    const double lin21a_31z = s6*(c7*lin41a_41x + c7*MSc31_y);
    M[43] = lin21a_31z;
    M[52] = beta[5];
    MODELER_ZEROS(M + 27, 8);
    /* link 32: first moments of the link and all that it carries, MSc32 = MS32 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc32_x = c9*beta[32];
    const double lin42a_42x = s9*beta[32];
    MODELER_ZEROS(M + 35, 4);
    const double MSc32_y = beta[31] - lin42a_42x;
    /* link 12: first moments of the link and all that it carries, MSc12 = MS12 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc12_x = s8*beta[25] - c8*(c9*MSc32_x - s9*MSc32_y + beta[24]);
    MODELER_ZEROS(M + 40, 2);
    M[56] = minus_MSc12_x;
    const double lin22a_32z = s8*(c9*lin42a_42x + c9*MSc32_y);
    MODELER_ZEROS(M + 44, 8);
    M[57] = lin22a_32z;
    M[65] = beta[9];
    MODELER_ZEROS(M + 53, 3);
    /* link 33: first moments of the link and all that it carries, MSc33 = MS33 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc33_x = c11*beta[42];
    const double lin43a_43x = s11*beta[42];
    const double MSc33_y = beta[41] - lin43a_43x;
    MODELER_ZEROS(M + 58, 7);
    /* link 13: first moments of the link and all that it carries, MSc13 = MS13 + sum of R MSc + Mc
        p of what hangs on it */
    const double minus_MSc13_x = s10*beta[35] - c10*(c11*MSc33_x - s11*MSc33_y + beta[34]);
    M[70] = minus_MSc13_x;
    MODELER_ZEROS(M + 66, 4);
    const double lin23a_33z = s10*(c11*lin43a_43x + c11*MSc33_y);
    M[71] = lin23a_33z;
    MODELER_ZEROS(M + 72, 3);
    M[75] = minus_MSc11_x;
    /* link 31: inertia of the link and all that it carries, Jc31 = J31 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc31_xy = beta[17] + orthoglide_2003_geo_D41*lin41a_41x;
    MODELER_ZEROS(M + 76, 2);
    M[78] = s7*(s7*beta[16] + c7*Jc31_xy) + c7*(s7*Jc31_xy + k3*MSc31_x*c7) + beta[13];
    /* link 21: inertia of the link and all that it carries, Jc21 = J21 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc21_yz = s7*beta[18] + c7*beta[19];
    M[79] = -minus_Jc21_yz;
    MODELER_ZEROS(M + 80, 7);
    M[87] = lin21a_31z;
    M[90] = -minus_Jc21_yz;
    MODELER_ZEROS(M + 88, 2);
    M[91] = beta[20];
    M[100] = minus_MSc12_x;
    MODELER_ZEROS(M + 92, 8);
    /* link 32: inertia of the link and all that it carries, Jc32 = J32 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc32_xy = beta[27] + orthoglide_2003_geo_D42*lin42a_42x;
    M[104] = s9*(s9*beta[26] + c9*Jc32_xy) + c9*(s9*Jc32_xy + k2*MSc32_x*c9) + beta[23];
    MODELER_ZEROS(M + 101, 3);
    /* link 22: inertia of the link and all that it carries, Jc22 = J22 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc22_yz = s9*beta[28] + c9*beta[29];
    M[105] = -minus_Jc22_yz;
    MODELER_ZEROS(M + 106, 6);
    M[112] = lin22a_32z;
    M[116] = -minus_Jc22_yz;
    M[117] = beta[30];
    MODELER_ZEROS(M + 113, 3);
    M[125] = minus_MSc13_x;
    /* link 33: inertia of the link and all that it carries, Jc33 = J33 + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc33_xy = beta[37] + orthoglide_2003_geo_D43*lin43a_43x;
    MODELER_ZEROS(M + 118, 7);
    M[130] = s11*(s11*beta[36] + c11*Jc33_xy) + c11*(s11*Jc33_xy + k1*MSc33_x*c11) + beta[33];
    /* link 23: inertia of the link and all that it carries, Jc23 = J23 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc23_yz = s11*beta[38] + c11*beta[39];
    MODELER_ZEROS(M + 126, 4);
    M[131] = -minus_Jc23_yz;
    M[137] = lin23a_33z;
    MODELER_ZEROS(M + 132, 5);
    M[142] = -minus_Jc23_yz;
    M[143] = beta[40];
    MODELER_ZEROS(M + 138, 4);
}

/* Torques that hold the robot still, without friction.
 * 8 additions, 27 multiplications. */
void orthoglide_2003_tree_gravity(const double q[12], const double beta[43],
                                  double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
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

    tau[1] = -orthoglide_2003_geo_g*beta[0];
    tau[7] = -orthoglide_2003_geo_g*s7*beta[21];
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22_y = orthoglide_2003_geo_g*s8;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double minus_n42_y = vd22_y*beta[32];
    const double minus_vd22_x = orthoglide_2003_geo_g*c8;
    tau[8] = s9*(s9*minus_n42_y - vd22_y*beta[31]) + c9*minus_n42_y*c9 + (vd22_y*beta[24] +
        minus_vd22_x*beta[25]);
    tau[9] = c9*minus_vd22_x*beta[31];
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double vd23_y = orthoglide_2003_geo_g*c10;
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double minus_n43_y = beta[42]*vd23_y;
    const double vd23_x = orthoglide_2003_geo_g*s10;
    tau[10] = s11*(s11*minus_n43_y - beta[41]*vd23_y) + c11*minus_n43_y*c11 + (beta[34]*vd23_y -
        beta[35]*vd23_x);
    tau[11] = -c11*vd23_x*beta[41];
}

/* Torques without gravity and friction.
 * 152 additions, 220 multiplications. */
void orthoglide_2003_tree_coriolis(const double q[12], const double qd[12], const double qdd[12],
                                   const double beta[43], double MODELER_OUT(tau, 12))
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

    tau[0] = qdd[0]*beta[0];
    tau[1] = qdd[1]*beta[0];
    tau[2] = qdd[2]*beta[0];
    const double ww21_zz = qd[6]*qd[6];
    /* link 41: force on the link, f41 = M41 vd41 + U41 MS41 */
    const double minus_f41_x = ww21_zz*beta[22];
    /* link 41: force on the link and all that it carries, fc41 = f41 + sum of R fc of what hangs on
        it */
    const double fc41a_y = s7*minus_f41_x;
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_x = s7*qd[6];
    const double ww31_zz = qd[7]*qd[7];
    const double minus_w31_y = c7*qd[6];
    const double ww31_xy = minus_w31_x*minus_w31_y;
    /* link 31: force on the link and all that it carries, fc31 = f31 + sum of R fc of what hangs on
        it */
    const double minus_fc31a_x = s7*(fc41a_y - (minus_w31_x*minus_w31_x + ww31_zz)*beta[21]) +
        c7*(c7*minus_f41_x + (qdd[7] - ww31_xy)*beta[21]);
    const double f41_z = qdd[6]*beta[22];
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = s7*qdd[6] + minus_ww31_yz;
    const double t12 = c6*(f41_z - (minus_ww31_yz + minus_wd31_x)*beta[21] + (qdd[6]*beta[14] -
        ww21_zz*beta[15]));
    tau[3] = s6*(ww21_zz*beta[14] + qdd[6]*beta[15] + minus_fc31a_x) - t12 + qdd[3]*beta[1];
    const double ww22_zz = qd[8]*qd[8];
    /* link 42: force on the link, f42 = M42 vd42 + U42 MS42 */
    const double minus_f42_x = ww22_zz*beta[32];
    /* link 42: force on the link and all that it carries, fc42 = f42 + sum of R fc of what hangs on
        it */
    const double fc42a_y = s9*minus_f42_x;
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_x = s9*qd[8];
    const double ww32_zz = qd[9]*qd[9];
    const double minus_w32_y = c9*qd[8];
    const double ww32_xy = minus_w32_x*minus_w32_y;
    const double t20 = c9*(c9*minus_f42_x + (qdd[9] - ww32_xy)*beta[31]);
    /* link 32: force on the link and all that it carries, fc32 = f32 + sum of R fc of what hangs on
        it */
    const double minus_fc32a_x = s9*(fc42a_y - (minus_w32_x*minus_w32_x + ww32_zz)*beta[31]) + t20;
    const double f42_z = qdd[8]*beta[32];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = s9*qdd[8] + minus_ww32_yz;
    const double t25 = c8*(f42_z - (minus_ww32_yz + minus_wd32_x)*beta[31] + (qdd[8]*beta[24] -
        ww22_zz*beta[25]));
    tau[4] = s8*(ww22_zz*beta[24] + qdd[8]*beta[25] + minus_fc32a_x) - t25 + qdd[4]*beta[5];
    const double ww23_zz = qd[10]*qd[10];
    /* link 43: force on the link, f43 = M43 vd43 + U43 MS43 */
    const double minus_f43_x = ww23_zz*beta[42];
    /* link 43: force on the link and all that it carries, fc43 = f43 + sum of R fc of what hangs on
        it */
    const double fc43a_y = s11*minus_f43_x;
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_x = s11*qd[10];
    const double ww33_zz = qd[11]*qd[11];
    const double minus_w33_y = c11*qd[10];
    const double ww33_xy = minus_w33_x*minus_w33_y;
    const double t33 = c11*(c11*minus_f43_x + (qdd[11] - ww33_xy)*beta[41]);
    /* link 33: force on the link and all that it carries, fc33 = f33 + sum of R fc of what hangs on
        it */
    const double minus_fc33a_x = s11*(fc43a_y - (minus_w33_x*minus_w33_x + ww33_zz)*beta[41]) + t33;
    const double f43_z = qdd[10]*beta[42];
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = s11*qdd[10] + minus_ww33_yz;
    const double t38 = c10*(f43_z - (minus_ww33_yz + minus_wd33_x)*beta[41] + (qdd[10]*beta[34] -
        ww23_zz*beta[35]));
    tau[5] = s10*(ww23_zz*beta[34] + qdd[10]*beta[35] + minus_fc33a_x) - t38 + qdd[5]*beta[9];
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    const double minus_wd31_y = c7*qdd[6] - minus_ww31_xz;
    /* link 41: moment on the link at its origin, n41 = J41 wd41 + w41 x J41 w41 + MS41 x vd41 */
    const double n41_y = (minus_vd21_y + orthoglide_2003_geo_D41*(minus_ww31_xz -
        minus_wd31_y))*beta[22];
    const double minus_h31_z = minus_w31_x*beta[18] + minus_w31_y*beta[19] - qd[7]*beta[20];
    const double minus_h31_y = minus_w31_x*beta[17] - qd[7]*beta[19];
    const double t45 = minus_w31_y*minus_h31_z + qd[7]*minus_h31_y + (qdd[7]*beta[18] -
        (minus_wd31_x*beta[16] + minus_wd31_y*beta[17]));
    const double minus_h31_x = minus_w31_x*beta[16] + minus_w31_y*beta[17] - qd[7]*beta[18];
    /* link 31: moment on the link at its origin, n31 = J31 wd31 + w31 x J31 w31 + MS31 x vd31 */
    const double minus_n31_y = qd[7]*minus_h31_x + minus_w31_x*minus_h31_z + (minus_wd31_x*beta[17]
        - qdd[7]*beta[19]);
    const double t48 = c7*(c7*n41_y - orthoglide_2003_geo_D41*f41_z - minus_n31_y);
    const double minus_vd21_x = s6*qdd[3];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = minus_vd21_x*beta[15] - minus_vd21_y*beta[14] + qdd[6]*beta[13];
    tau[6] = n21_z - (s7*(t45 - minus_vd21_y*beta[21] + s7*n41_y) + t48);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) */
    const double minus_vd31_x = c7*minus_vd21_x;
    const double t52 = c7*(s7*minus_vd21_x + orthoglide_2003_geo_D41*(qdd[7] + ww31_xy));
    const double n41_z = beta[22]*(t52 - s7*(minus_vd31_x +
        orthoglide_2003_geo_D41*(minus_w31_y*minus_w31_y + ww31_zz)));
    const double t54 = minus_w31_x*minus_h31_y - minus_w31_y*minus_h31_x + (qdd[7]*beta[20] -
        (minus_wd31_x*beta[18] + minus_wd31_y*beta[19]));
    tau[7] = orthoglide_2003_geo_D41*fc41a_y + n41_z + (t54 + minus_vd31_x*beta[21]) - n41_z;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4];
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    const double minus_wd32_y = c9*qdd[8] - minus_ww32_xz;
    /* link 42: moment on the link at its origin, n42 = J42 wd42 + w42 x J42 w42 + MS42 x vd42 */
    const double n42_y = beta[32]*(minus_vd22_y + orthoglide_2003_geo_D42*(minus_ww32_xz -
        minus_wd32_y));
    const double minus_h32_z = minus_w32_x*beta[28] + minus_w32_y*beta[29] - qd[9]*beta[30];
    const double minus_h32_y = minus_w32_x*beta[27] - qd[9]*beta[29];
    const double t61 = minus_w32_y*minus_h32_z + qd[9]*minus_h32_y + (qdd[9]*beta[28] -
        (minus_wd32_x*beta[26] + minus_wd32_y*beta[27]));
    const double minus_h32_x = minus_w32_x*beta[26] + minus_w32_y*beta[27] - qd[9]*beta[28];
    /* link 32: moment on the link at its origin, n32 = J32 wd32 + w32 x J32 w32 + MS32 x vd32 */
    const double minus_n32_y = qd[9]*minus_h32_x + minus_w32_x*minus_h32_z + (minus_wd32_x*beta[27]
        - qdd[9]*beta[29]);
    const double t64 = c9*(orthoglide_2003_geo_D42*f42_z - c9*n42_y + minus_n32_y);
    const double minus_vd22_x = s8*qdd[4];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = minus_vd22_x*beta[25] - minus_vd22_y*beta[24] + qdd[8]*beta[23];
    tau[8] = n22_z - (s9*(t61 - minus_vd22_y*beta[31] + s9*n42_y) - t64);
    const double minus_vd22_x_2 = orthoglide_2003_geo_g*c8 + minus_vd22_x;
    const double t68 = s9*(c9*minus_vd22_x_2 + orthoglide_2003_geo_D42*(minus_w32_y*minus_w32_y +
        ww32_zz));
    const double n42_z = (c9*(s9*minus_vd22_x_2 + orthoglide_2003_geo_D42*(qdd[9] + ww32_xy)) -
        t68)*beta[32];
    const double t70 = minus_w32_x*minus_h32_y - minus_w32_y*minus_h32_x + (qdd[9]*beta[30] -
        (minus_wd32_x*beta[28] + minus_wd32_y*beta[29]));
    tau[9] = orthoglide_2003_geo_D42*fc42a_y + n42_z + (t70 + c9*minus_vd22_x*beta[31]) - n42_z;
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    const double minus_wd33_y = c11*qdd[10] - minus_ww33_xz;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*qdd[5];
    /* link 43: moment on the link at its origin, n43 = J43 wd43 + w43 x J43 w43 + MS43 x vd43 */
    const double n43_y = beta[42]*(orthoglide_2003_geo_D43*(minus_ww33_xz - minus_wd33_y) +
        minus_vd23_y);
    const double minus_h33_z = minus_w33_x*beta[38] + minus_w33_y*beta[39] - qd[11]*beta[40];
    const double minus_h33_y = minus_w33_x*beta[37] - qd[11]*beta[39];
    const double t77 = minus_w33_y*minus_h33_z + qd[11]*minus_h33_y + (qdd[11]*beta[38] -
        (minus_wd33_x*beta[36] + minus_wd33_y*beta[37]));
    const double minus_h33_x = minus_w33_x*beta[36] + minus_w33_y*beta[37] - qd[11]*beta[38];
    /* link 33: moment on the link at its origin, n33 = J33 wd33 + w33 x J33 w33 + MS33 x vd33 */
    const double minus_n33_y = qd[11]*minus_h33_x + minus_w33_x*minus_h33_z + (minus_wd33_x*beta[37]
        - qdd[11]*beta[39]);
    const double t80 = c11*(orthoglide_2003_geo_D43*f43_z - c11*n43_y + minus_n33_y);
    const double minus_vd23_x = s10*qdd[5];
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double n23_z = beta[35]*minus_vd23_x - beta[34]*minus_vd23_y + qdd[10]*beta[33];
    tau[10] = n23_z - (s11*(t77 - beta[41]*minus_vd23_y + s11*n43_y) - t80);
    const double minus_vd23_x_2 = s10*(qdd[5] - orthoglide_2003_geo_g);
    const double t84 = c11*(s11*minus_vd23_x_2 + orthoglide_2003_geo_D43*(qdd[11] + ww33_xy));
    const double n43_z = (t84 - s11*(c11*minus_vd23_x_2 +
        orthoglide_2003_geo_D43*(minus_w33_y*minus_w33_y + ww33_zz)))*beta[42];
    const double t86 = minus_w33_x*minus_h33_y - minus_w33_y*minus_h33_x + (qdd[11]*beta[40] -
        (minus_wd33_x*beta[38] + minus_wd33_y*beta[39]));
    tau[11] = orthoglide_2003_geo_D43*fc43a_y + n43_z + (t86 + c11*minus_vd23_x*beta[41]) - n43_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 6 additions, 6 multiplications. */
void orthoglide_2003_tree_friction(const double qd[12], const double beta[43],
                                   double MODELER_OUT(tau, 12))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[6] = 0.0;
    tau[7] = 0.0;
    tau[8] = 0.0;
    tau[9] = 0.0;
    tau[10] = 0.0;
    tau[11] = 0.0;

    tau[3] = qd[3]*beta[2] + modeler_sign(qd[3])*beta[3] + beta[4];
    tau[4] = qd[4]*beta[6] + modeler_sign(qd[4])*beta[7] + beta[8];
    tau[5] = qd[5]*beta[10] + modeler_sign(qd[5])*beta[11] + beta[12];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 9 additions, 21 multiplications. */
void orthoglide_2003_tree_forward_kinematics(const double q[12], double MODELER_OUT(T, 21 * 3 * 4))
{
    MODELER_ALL_ZEROS(T, 252);

    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
    const double o32_z = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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
    T[15] = q[0];
    MODELER_ZEROS(T + 5, 4);
    T[18] = 1.0;
    T[19] = q[1];
    T[20] = 1.0;
    MODELER_ZEROS(T + 10, 3);
    T[24] = 1.0;
    T[27] = q[0];
    T[29] = 1.0;
    MODELER_ZEROS(T + 14, 1);
    T[31] = q[1];
    T[34] = 1.0;
    T[35] = q[2];
    MODELER_ZEROS(T + 16, 2);
    T[36] = 1.0;
    T[41] = 1.0;
    T[46] = 1.0;
    MODELER_ZEROS(T + 21, 3);
    T[47] = q[3];
    T[50] = 1.0;
    const double minus_p12_x = orthoglide_2003_geo_a - q[4];
    MODELER_ZEROS(T + 25, 2);
    T[51] = -minus_p12_x;
    T[52] = 1.0;
    T[57] = 1.0;
    MODELER_ZEROS(T + 28, 1);
    T[59] = orthoglide_2003_geo_a;
    T[61] = 1.0;
    MODELER_ZEROS(T + 30, 1);
    T[66] = 1.0;
    const double minus_p13_y = orthoglide_2003_geo_a - q[5];
    T[67] = -minus_p13_y;
    MODELER_ZEROS(T + 32, 2);
    T[68] = 1.0;
    T[71] = orthoglide_2003_geo_a;
    T[72] = c6;
    MODELER_ZEROS(T + 37, 4);
    T[73] = -s6;
    T[78] = 1.0;
    T[80] = -s6;
    MODELER_ZEROS(T + 42, 4);
    T[81] = -c6;
    T[83] = q[3];
    const double x31_x = c6*c7;
    MODELER_ZEROS(T + 48, 2);
    T[84] = x31_x;
    const double minus_y31_x = c6*s7;
    T[85] = -minus_y31_x;
    MODELER_ZEROS(T + 53, 4);
    T[86] = -s6;
    T[88] = -s7;
    T[89] = -c7;
    MODELER_ZEROS(T + 58, 1);
    T[91] = orthoglide_2003_geo_b3;
    const double minus_x31_z = s6*c7;
    T[92] = -minus_x31_z;
    MODELER_ZEROS(T + 60, 1);
    const double y31_z = s6*s7;
    T[93] = y31_z;
    T[94] = -c6;
    MODELER_ZEROS(T + 62, 4);
    T[95] = q[3];
    T[96] = c6;
    MODELER_ZEROS(T + 69, 2);
    T[98] = -s6;
    /* link 41: origin of the frame in frame 0, o41 = o31 + [x31 y31 z31] p41 */
    const double o41_x = orthoglide_2003_geo_D41*x31_x;
    T[99] = o41_x;
    MODELER_ZEROS(T + 74, 4);
    T[101] = -1.0;
    const double o41_y = orthoglide_2003_geo_b3 - orthoglide_2003_geo_D41*s7;
    T[103] = o41_y;
    MODELER_ZEROS(T + 79, 1);
    T[104] = -s6;
    T[106] = -c6;
    const double o41_z = q[3] - orthoglide_2003_geo_D41*minus_x31_z;
    MODELER_ZEROS(T + 82, 1);
    T[107] = o41_z;
    T[109] = 1.0;
    T[111] = o41_x;
    MODELER_ZEROS(T + 87, 1);
    T[114] = 1.0;
    T[115] = o41_y;
    T[116] = 1.0;
    MODELER_ZEROS(T + 90, 1);
    T[119] = o41_z;
    T[120] = x31_x;
    T[121] = -minus_y31_x;
    MODELER_ZEROS(T + 97, 1);
    T[122] = -s6;
    T[124] = -s7;
    T[125] = -c7;
    MODELER_ZEROS(T + 100, 1);
    T[127] = orthoglide_2003_geo_b7;
    T[128] = -minus_x31_z;
    T[129] = y31_z;
    MODELER_ZEROS(T + 102, 1);
    T[130] = -c6;
    T[131] = q[3];
    MODELER_ZEROS(T + 105, 1);
    T[132] = -s8;
    T[133] = -c8;
    T[135] = -minus_p12_x;
    MODELER_ZEROS(T + 108, 1);
    T[136] = c8;
    T[137] = -s8;
    T[142] = 1.0;
    MODELER_ZEROS(T + 110, 1);
    T[143] = orthoglide_2003_geo_a;
    const double minus_x32_x = s8*c9;
    T[144] = -minus_x32_x;
    MODELER_ZEROS(T + 112, 2);
    const double y32_x = s8*s9;
    T[145] = y32_x;
    T[146] = -c8;
    MODELER_ZEROS(T + 117, 2);
    T[147] = -minus_p12_x;
    const double x32_y = c8*c9;
    T[148] = x32_y;
    MODELER_ZEROS(T + 123, 1);
    const double minus_y32_y = c8*s9;
    T[149] = -minus_y32_y;
    T[150] = -s8;
    MODELER_ZEROS(T + 126, 1);
    T[152] = -s9;
    T[153] = -c9;
    T[155] = o32_z;
    MODELER_ZEROS(T + 134, 1);
    T[156] = -s8;
    T[158] = -c8;
    MODELER_ZEROS(T + 138, 4);
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double minus_o42_x = minus_p12_x + orthoglide_2003_geo_D42*minus_x32_x;
    T[159] = -minus_o42_x;
    T[160] = c8;
    MODELER_ZEROS(T + 151, 1);
    T[162] = -s8;
    const double o42_y = orthoglide_2003_geo_D42*x32_y;
    T[163] = o42_y;
    MODELER_ZEROS(T + 154, 1);
    T[165] = -1.0;
    const double o42_z = o32_z - orthoglide_2003_geo_D42*s9;
    T[167] = o42_z;
    MODELER_ZEROS(T + 157, 1);
    T[168] = 1.0;
    T[171] = -minus_o42_x;
    T[173] = 1.0;
    MODELER_ZEROS(T + 161, 1);
    T[175] = o42_y;
    T[178] = 1.0;
    T[179] = o42_z;
    MODELER_ZEROS(T + 164, 1);
    T[180] = -minus_x32_x;
    T[181] = y32_x;
    T[182] = -c8;
    MODELER_ZEROS(T + 166, 1);
    T[183] = -minus_p12_x;
    T[184] = x32_y;
    T[185] = -minus_y32_y;
    MODELER_ZEROS(T + 169, 2);
    T[186] = -s8;
    T[188] = -s9;
    T[189] = -c9;
    MODELER_ZEROS(T + 172, 1);
    T[191] = orthoglide_2003_geo_a + orthoglide_2003_geo_b7;
    T[194] = 1.0;
    MODELER_ZEROS(T + 174, 1);
    T[196] = -s10;
    T[197] = -c10;
    T[199] = -minus_p13_y;
    MODELER_ZEROS(T + 176, 2);
    T[200] = c10;
    T[201] = -s10;
    T[203] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 187, 1);
    T[204] = -s11;
    T[205] = -c11;
    T[207] = orthoglide_2003_geo_b3;
    MODELER_ZEROS(T + 190, 1);
    const double minus_x33_y = s10*c11;
    T[208] = -minus_x33_y;
    const double y33_y = s10*s11;
    MODELER_ZEROS(T + 192, 2);
    T[209] = y33_y;
    T[210] = -c10;
    T[211] = -minus_p13_y;
    MODELER_ZEROS(T + 195, 1);
    const double x33_z = c10*c11;
    T[212] = x33_z;
    const double minus_y33_z = c10*s11;
    MODELER_ZEROS(T + 198, 1);
    T[213] = -minus_y33_z;
    T[214] = -s10;
    T[215] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 202, 1);
    T[217] = -1.0;
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
    const double o43_x = orthoglide_2003_geo_b3 - orthoglide_2003_geo_D43*s11;
    T[219] = o43_x;
    MODELER_ZEROS(T + 206, 1);
    T[220] = -s10;
    T[222] = -c10;
    MODELER_ZEROS(T + 216, 1);
    const double minus_o43_y = minus_p13_y + orthoglide_2003_geo_D43*minus_x33_y;
    T[223] = -minus_o43_y;
    T[224] = c10;
    MODELER_ZEROS(T + 218, 1);
    T[226] = -s10;
    const double o43_z = orthoglide_2003_geo_a + orthoglide_2003_geo_D43*x33_z;
    T[227] = o43_z;
    MODELER_ZEROS(T + 221, 1);
    T[230] = 1.0;
    T[231] = o43_x;
    T[232] = 1.0;
    MODELER_ZEROS(T + 225, 1);
    T[235] = -minus_o43_y;
    T[237] = 1.0;
    T[239] = o43_z;
    MODELER_ZEROS(T + 228, 2);
    T[240] = -s11;
    T[241] = -c11;
    T[243] = orthoglide_2003_geo_b7;
    MODELER_ZEROS(T + 233, 2);
    T[244] = -minus_x33_y;
    T[245] = y33_y;
    T[246] = -c10;
    MODELER_ZEROS(T + 236, 1);
    T[247] = -minus_p13_y;
    T[248] = x33_z;
    T[249] = -minus_y33_z;
    MODELER_ZEROS(T + 238, 1);
    T[250] = -s10;
    T[251] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 242, 1);
}

/* d/dt(df/du) ud.
 * 18 additions, 66 multiplications. */
void orthoglide_2003_tree_drift(const double q[12], const double qd[12],
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
    const double t5 = orthoglide_2003_geo_D41*(c7*minus_x21d_tz - s6*y31d_ty)*qd[6];
    values[0] = orthoglide_2003_geo_D41*(s7*minus_x21d_tx - c6*minus_x31d_ty)*qd[7] - t5;
    values[1] = orthoglide_2003_geo_D41*y31d_ty*qd[7];
    const double t6 = orthoglide_2003_geo_D41*(c7*minus_x21d_tx + c6*y31d_ty)*qd[6];
    values[2] = t6 + orthoglide_2003_geo_D41*(s7*minus_x21d_tz + s6*minus_x31d_ty)*qd[7];
    const double minus_x22d_ty = s8*qd[8];
    const double y32d_tz = s9*qd[9];
    const double minus_x22d_tx = c8*qd[8];
    const double minus_x32d_tz = c9*qd[9];
    const double t11 = orthoglide_2003_geo_D42*(s9*minus_x22d_tx + s8*minus_x32d_tz)*qd[9];
    values[3] = orthoglide_2003_geo_D42*(c9*minus_x22d_ty + c8*y32d_tz)*qd[8] + t11;
    const double t12 = orthoglide_2003_geo_D42*(s9*minus_x22d_ty - c8*minus_x32d_tz)*qd[9];
    values[4] = t12 - orthoglide_2003_geo_D42*(c9*minus_x22d_tx - s8*y32d_tz)*qd[8];
    values[5] = orthoglide_2003_geo_D42*y32d_tz*qd[9];
    const double y33d_tx = s11*qd[11];
    values[6] = orthoglide_2003_geo_D43*y33d_tx*qd[11];
    const double minus_x23d_tz = s10*qd[10];
    const double minus_x23d_ty = c10*qd[10];
    const double minus_x33d_tx = c11*qd[11];
    const double t17 = orthoglide_2003_geo_D43*(c11*minus_x23d_tz + c10*y33d_tx)*qd[10];
    values[7] = t17 + orthoglide_2003_geo_D43*(s11*minus_x23d_ty + s10*minus_x33d_tx)*qd[11];
    const double t18 = orthoglide_2003_geo_D43*(c11*minus_x23d_ty - s10*y33d_tx)*qd[10];
    values[8] = orthoglide_2003_geo_D43*(s11*minus_x23d_tz - c10*minus_x33d_tx)*qd[11] - t18;
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 20 additions, 30 multiplications. */
void orthoglide_2003_tree_closure(const double q[12], double MODELER_OUT(values, 48))
{
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
    const double o32_z = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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
    const double o41_x = c6*c7*orthoglide_2003_geo_D41;
    values[0] = o41_x - q[0];
    values[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    /* link 51: velocity of the origin, for unit speed of each joint below, m51 = R51' (m41 + e41 x
        p51) */
    const double minus_m51_21y = s6*c7*orthoglide_2003_geo_D41;
    values[2] = q[3] - minus_m51_21y + orthoglide_2003_geo_d6 - q[2];
    /* link 52: velocity of the origin, for unit speed of each joint below, m52 = R52' (m42 + e42 x
        p52) */
    const double minus_m52_22y = s8*c9*orthoglide_2003_geo_D42;
    values[3] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[4] + minus_m52_22y) - q[0];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double o42_y = c8*c9*orthoglide_2003_geo_D42;
    values[4] = o42_y - q[1];
    values[5] = -(orthoglide_2003_geo_D42*s9 - o32_z + orthoglide_2003_geo_b3 + q[2]);
    values[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    /* link 53: velocity of the origin, for unit speed of each joint below, m53 = R53' (m43 + e43 x
        p53) */
    const double minus_m53_23y = s10*c11*orthoglide_2003_geo_D43;
    values[7] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[5] + minus_m53_23y) - q[1];
    const double minus_m53_23x = c10*c11*orthoglide_2003_geo_D43;
    values[8] = orthoglide_2003_geo_a + minus_m53_23x - q[2];
    values[9] = -1.0;
    values[10] = -minus_m51_21y;
    values[11] = -c6*s7*orthoglide_2003_geo_D41;
    values[12] = -1.0;
    values[13] = -orthoglide_2003_geo_D41*c7;
    values[14] = -1.0;
    values[15] = 1.0;
    values[16] = -o41_x;
    values[17] = s6*s7*orthoglide_2003_geo_D41;
    values[18] = -1.0;
    values[19] = 1.0;
    values[20] = -o42_y;
    values[21] = s8*s9*orthoglide_2003_geo_D42;
    values[22] = -1.0;
    values[23] = -minus_m52_22y;
    values[24] = -c8*s9*orthoglide_2003_geo_D42;
    values[25] = -1.0;
    values[26] = -orthoglide_2003_geo_D42*c9;
    values[27] = -1.0;
    values[28] = -orthoglide_2003_geo_D43*c11;
    values[29] = -1.0;
    values[30] = 1.0;
    values[31] = -minus_m53_23x;
    values[32] = s10*s11*orthoglide_2003_geo_D43;
    values[33] = -1.0;
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

/* The independent equations.
 * 20 additions, 15 multiplications. */
void orthoglide_2003_tree_residual(const double q[12], double MODELER_OUT(f, 9))
{
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
    const double o32_z = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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

    f[0] = c6*c7*orthoglide_2003_geo_D41 - q[0];
    f[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    f[2] = q[3] - s6*c7*orthoglide_2003_geo_D41 + orthoglide_2003_geo_d6 - q[2];
    /* link 42: origin of the frame in frame 0, o42 = o32 + [x32 y32 z32] p42 */
    const double minus_o42_x = orthoglide_2003_geo_a - q[4] + s8*c9*orthoglide_2003_geo_D42;
    f[3] = orthoglide_2003_geo_d6 - minus_o42_x - q[0];
    f[4] = c8*c9*orthoglide_2003_geo_D42 - q[1];
    f[5] = -(orthoglide_2003_geo_D42*s9 - o32_z + orthoglide_2003_geo_b3 + q[2]);
    f[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    /* link 43: origin of the frame in frame 0, o43 = o33 + [x33 y33 z33] p43 */
    const double minus_o43_y = orthoglide_2003_geo_a - q[5] + s10*c11*orthoglide_2003_geo_D43;
    f[7] = orthoglide_2003_geo_d6 - minus_o43_y - q[1];
    f[8] = orthoglide_2003_geo_a + c10*c11*orthoglide_2003_geo_D43 - q[2];
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 8 additions, 22 multiplications. */
void orthoglide_2003_tree_factor(const double J[27], double MODELER_OUT(lu, 25))
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
void orthoglide_2003_tree_solve(const double lu[25], const double right[9],
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
void orthoglide_2003_tree_coupling(const double J[27], const double lu[25],
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
void orthoglide_2003_tree_turned(const double J[27], const double K[27], const double lu[25],
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
void orthoglide_2003_tree_spread(const double J[27], const double K[27], const double lu[25],
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
void orthoglide_2003_tree_platform_factor(const double J[27], double MODELER_OUT(lu, 18))
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
void orthoglide_2003_tree_platform_solve(const double lu[18], const double right[9],
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
void orthoglide_2003_tree_platform_coupling(const double J[27], const double lu[18],
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
void orthoglide_2003_tree_platform_turned(const double J[27], const double K[27],
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
void orthoglide_2003_tree_platform_spread(const double J[27], const double K[27],
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
 * 96 additions, 21 multiplications. */
void orthoglide_2003_base_parameters(const double chi[ORTHOGLIDE_2003_STANDARD_PARAMETERS],
                                     double MODELER_OUT(beta, ORTHOGLIDE_2003_BASE_PARAMETERS))
{
    const double k1 = 1.0/orthoglide_2003_geo_D41;
    const double k2 = 1.0/orthoglide_2003_geo_D42;
    const double k3 = 1.0/orthoglide_2003_geo_D43;
    const double k4 = orthoglide_2003_geo_g*k3;

    const double t1 = k1*chi[59];
    const double t2 = k1*chi[79];
    const double t3 = k2*chi[99];
    const double t4 = k2*chi[119];
    const double t5 = k3*chi[139];
    const double t6 = k3*chi[159];
    beta[0] = chi[0] + t1 + chi[72] + t2 + t3 + chi[112] + t4 + t5 + chi[152] + t6;
    beta[1] = chi[10] + chi[11] + chi[52] - t1 + chi[62] - t2 + chi[82];
    beta[2] = chi[12];
    beta[3] = chi[13];
    beta[4] = chi[14];
    beta[5] = chi[24] + chi[25] + chi[92] - t3 + chi[102] - t4 + chi[122];
    beta[6] = chi[26];
    beta[7] = chi[27];
    beta[8] = chi[28];
    beta[9] = chi[38] + chi[39] + chi[132] - t5 + chi[142] - t6 + chi[162];
    beta[10] = chi[40];
    beta[11] = chi[41];
    const double t7 = chi[42] - orthoglide_2003_geo_g*chi[38] - orthoglide_2003_geo_g*chi[132];
    const double t8 = t7 + k4*chi[139] - orthoglide_2003_geo_g*chi[142] + k4*chi[159];
    beta[12] = t8 - orthoglide_2003_geo_g*chi[162];
    const double t9 = orthoglide_2003_geo_D41*chi[59];
    const double t10 = orthoglide_2003_geo_D41*chi[79];
    beta[13] = chi[48] + chi[56] - t9 + chi[66] + chi[76] - t10;
    beta[14] = chi[49];
    beta[15] = chi[50] + chi[61] + chi[71] + chi[81];
    beta[16] = chi[53] - chi[56] + t9 + chi[73] - chi[76] + t10;
    beta[17] = chi[54] + chi[74];
    beta[18] = chi[55] - orthoglide_2003_geo_D41*chi[71] + chi[75];
    beta[19] = chi[57] + chi[77];
    beta[20] = chi[58] - t9 + chi[78] - t10;
    beta[21] = chi[60] + chi[80];
    beta[22] = chi[69];
    const double t11 = orthoglide_2003_geo_D42*chi[99];
    const double t12 = orthoglide_2003_geo_D42*chi[119];
    beta[23] = chi[88] + chi[96] - t11 + chi[106] + chi[116] - t12;
    beta[24] = chi[89];
    beta[25] = chi[90] + chi[101] + chi[111] + chi[121];
    beta[26] = chi[93] - chi[96] + t11 + chi[113] - chi[116] + t12;
    beta[27] = chi[94] + chi[114];
    beta[28] = chi[95] - orthoglide_2003_geo_D42*chi[111] + chi[115];
    beta[29] = chi[97] + chi[117];
    beta[30] = chi[98] - t11 + chi[118] - t12;
    beta[31] = chi[100] + chi[120];
    beta[32] = chi[109];
    const double t13 = orthoglide_2003_geo_D43*chi[139];
    const double t14 = orthoglide_2003_geo_D43*chi[159];
    beta[33] = chi[128] + chi[136] - t13 + chi[146] + chi[156] - t14;
    beta[34] = chi[129];
    beta[35] = chi[130] + chi[141] + chi[151] + chi[161];
    beta[36] = chi[133] - chi[136] + t13 + chi[153] - chi[156] + t14;
    beta[37] = chi[134] + chi[154];
    beta[38] = chi[135] - orthoglide_2003_geo_D43*chi[151] + chi[155];
    beta[39] = chi[137] + chi[157];
    beta[40] = chi[138] - t13 + chi[158] - t14;
    beta[41] = chi[140] + chi[160];
    beta[42] = chi[149];
}
