/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of evra.h.
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
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   ang_1  angular momentum of what hangs on a joint, for unit speed of it
 *   p      origin of the frame in that of its antecedent
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: ang, lin, nc
 *   ...d   derivative by a variable, qd2 for qd[2], or by the time, t: o, x, y
 */
#include "evra.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "evra_tree.h"

/* Geometry. To use another value, compile with e.g. -DEVRA_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef EVRA_GEO_g
#define EVRA_GEO_g 9.81
#endif
#ifndef EVRA_GEO_RB
#define EVRA_GEO_RB 0.6
#endif
#ifndef EVRA_GEO_RP
#define EVRA_GEO_RP 0.35
#endif
#ifndef EVRA_GEO_beta1
#define EVRA_GEO_beta1 0.1745
#endif
#ifndef EVRA_GEO_beta2
#define EVRA_GEO_beta2 1.9199
#endif
#ifndef EVRA_GEO_beta3
#define EVRA_GEO_beta3 2.2689
#endif
#ifndef EVRA_GEO_beta4
#define EVRA_GEO_beta4 4.0143
#endif
#ifndef EVRA_GEO_beta5
#define EVRA_GEO_beta5 4.3633
#endif
#ifndef EVRA_GEO_beta6
#define EVRA_GEO_beta6 6.1087
#endif
#ifndef EVRA_GEO_phi1
#define EVRA_GEO_phi1 0.8727
#endif
#ifndef EVRA_GEO_phi2
#define EVRA_GEO_phi2 1.2217
#endif
#ifndef EVRA_GEO_phi3
#define EVRA_GEO_phi3 2.9671
#endif
#ifndef EVRA_GEO_phi4
#define EVRA_GEO_phi4 3.3161
#endif
#ifndef EVRA_GEO_phi5
#define EVRA_GEO_phi5 5.0615
#endif
#ifndef EVRA_GEO_phi6
#define EVRA_GEO_phi6 5.4105
#endif

static const double evra_geo_g = EVRA_GEO_g;
static const double evra_geo_RB = EVRA_GEO_RB;
static const double evra_geo_RP = EVRA_GEO_RP;
static const double evra_geo_beta1 = EVRA_GEO_beta1;
static const double evra_geo_beta2 = EVRA_GEO_beta2;
static const double evra_geo_beta3 = EVRA_GEO_beta3;
static const double evra_geo_beta4 = EVRA_GEO_beta4;
static const double evra_geo_beta5 = EVRA_GEO_beta5;
static const double evra_geo_beta6 = EVRA_GEO_beta6;
static const double evra_geo_phi1 = EVRA_GEO_phi1;
static const double evra_geo_phi2 = EVRA_GEO_phi2;
static const double evra_geo_phi3 = EVRA_GEO_phi3;
static const double evra_geo_phi4 = EVRA_GEO_phi4;
static const double evra_geo_phi5 = EVRA_GEO_phi5;
static const double evra_geo_phi6 = EVRA_GEO_phi6;

/* Joint torques, by the Newton-Euler recursion.
 * 519 additions, 687 multiplications. */
void evra_tree_inverse_dynamics(const double q[26], const double qd[26], const double qdd[26],
                                const double beta[90], double MODELER_OUT(tau, 26))
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    /* link Pz: acceleration of the origin less gravity, vd_Pz = R_Pz' (vd_Py + U_Py p_Pz) + 2 w_Pz
        x qd_Pz z + qdd_Pz z */
    const double vd_Pz_z = qdd[2] + evra_geo_g;
    /* link Pa: acceleration of the origin less gravity, vd_Pa = R_Pa' (vd_Pz + U_Pz p_Pa) */
    const double vd_Pa_y = c3*vd_Pz_z - s3*qdd[1];
    /* link Pb: acceleration of the origin less gravity, vd_Pb = R_Pb' (vd_Pa + U_Pa p_Pb) */
    const double vd_Pb_x = c4*vd_Pa_y + s4*qdd[0];
    /* link Pb: angular velocity, w_Pb = R_Pb' w_Pa + qd_Pb z */
    const double w_Pb_y = c4*qd[3];
    const double w_Pb_x = s4*qd[3];
    /* link Pb: angular acceleration, wd_Pb = R_Pb' wd_Pa + (R_Pb' w_Pa) x qd_Pb z + qdd_Pb z */
    const double wd_Pb_y = c4*qdd[3] - qd[4]*w_Pb_x;
    /* link P: angular velocity, w_P = R_P' w_Pb + qd_P z */
    const double w_P_x = c5*w_Pb_y + s5*qd[4];
    /* link P: angular acceleration, wd_P = R_P' wd_Pb + (R_P' w_Pb) x qd_P z + qdd_P z */
    const double wd_P_y = c5*qdd[4] - s5*wd_Pb_y - qd[5]*w_P_x;
    const double w_P_z = qd[5] + w_Pb_x;
    const double ww_P_xz = w_P_x*w_P_z;
    const double w_P_y = c5*qd[4] - s5*w_Pb_y;
    const double wd_P_x = c5*wd_Pb_y + s5*qdd[4] + qd[5]*w_P_y;
    const double ww_P_yz = w_P_y*w_P_z;
    const double t14 = (wd_P_y - ww_P_xz)*beta[6] - (wd_P_x + ww_P_yz)*beta[7] + (w_Pb_y*w_Pb_y +
        qd[4]*qd[4])*beta[8];
    /* link P: force on the link, f_P = M_P vd_P + U_P MS_P */
    const double f_P_z = vd_Pb_x*beta[9] - t14;
    const double vd_Pb_y = c4*qdd[0] - s4*vd_Pa_y;
    const double vd_Pa_x = c3*qdd[1] + s3*vd_Pz_z;
    /* link P: acceleration of the origin less gravity, vd_P = R_P' (vd_Pb + U_Pb p_P) */
    const double vd_P_x = c5*vd_Pb_y + s5*vd_Pa_x;
    const double ww_P_zz = w_P_z*w_P_z;
    const double wd_P_z = s4*qdd[3] + qd[4]*w_Pb_y + qdd[5];
    const double ww_P_xy = w_P_x*w_P_y;
    const double t22 = (w_P_y*w_P_y + ww_P_zz)*beta[6] + (wd_P_z - ww_P_xy)*beta[7] - (wd_P_y +
        ww_P_xz)*beta[8];
    const double f_P_x = vd_P_x*beta[9] - t22;
    const double vd_P_y = c5*vd_Pa_x - s5*vd_Pb_y;
    const double t25 = (w_P_x*w_P_x + ww_P_zz)*beta[7] - (wd_P_z + ww_P_xy)*beta[6] + (wd_P_x -
        ww_P_yz)*beta[8];
    const double f_P_y = vd_P_y*beta[9] - t25;
    /* link Pb: force on the link and all that it carries, fc_Pb = f_Pb + sum of R fc of what hangs
        on it */
    const double fc_Pb_y = c5*f_P_x - s5*f_P_y;
    tau[0] = s4*f_P_z + c4*fc_Pb_y;
    const double fc_Pb_z = s5*f_P_x + c5*f_P_y;
    /* link Pa: force on the link and all that it carries, fc_Pa = f_Pa + sum of R fc of what hangs
        on it */
    const double fc_Pa_y = c4*f_P_z - s4*fc_Pb_y;
    tau[1] = c3*fc_Pb_z - s3*fc_Pa_y;
    tau[2] = s3*fc_Pb_z + c3*fc_Pa_y;
    const double h_P_y = w_P_x*beta[1] + w_P_y*beta[3] + w_P_z*beta[4];
    const double h_P_x = w_P_x*beta[0] + w_P_y*beta[1] + w_P_z*beta[2];
    const double t32 = w_P_x*h_P_y - w_P_y*h_P_x + (wd_P_x*beta[2] + wd_P_y*beta[4] +
        wd_P_z*beta[5]);
    /* link P: moment on the link at its origin, n_P = J_P wd_P + w_P x J_P w_P + MS_P x vd_P */
    const double n_P_z = vd_P_y*beta[6] - vd_P_x*beta[7] + t32;
    const double h_P_z = w_P_x*beta[2] + w_P_y*beta[4] + w_P_z*beta[5];
    const double t35 = w_P_y*h_P_z - w_P_z*h_P_y + (wd_P_x*beta[0] + wd_P_y*beta[1] +
        wd_P_z*beta[2]);
    const double n_P_x = vd_Pb_x*beta[7] - vd_P_y*beta[8] + t35;
    const double t37 = w_P_z*h_P_x - w_P_x*h_P_z + (wd_P_x*beta[1] + wd_P_y*beta[3] +
        wd_P_z*beta[4]);
    const double n_P_y = vd_P_x*beta[8] - vd_Pb_x*beta[6] + t37;
    tau[3] = s4*n_P_z + c4*(c5*n_P_x - s5*n_P_y);
    tau[4] = s5*n_P_x + c5*n_P_y;
    tau[5] = n_P_z;
    /* link 26: angular velocity, w26 = R26' w16 + qd26 z */
    const double minus_w26_y = s24*qd[23];
    const double ww26_zz = qd[24]*qd[24];
    /* link 26: acceleration of points of the link, U26 = [wd26 x] + [w26 x][w26 x] */
    const double minus_U26_xx = minus_w26_y*minus_w26_y + ww26_zz;
    const double minus_U26_xz = s24*qdd[23];
    const double w26_x = c24*qd[23];
    const double minus_ww26_xy = w26_x*minus_w26_y;
    const double minus_U26_xy = qdd[24] + minus_ww26_xy;
    /* link 36: force on the link, f36 = M36 vd36 + U36 MS36 */
    const double minus_f36_x = minus_U26_xx*beta[87] + minus_U26_xz*beta[88] -
        minus_U26_xy*beta[89];
    /* link 26: force on the link and all that it carries, fc26 = f26 + sum of R fc of what hangs on
        it */
    const double minus_fc26_x = minus_U26_xx*beta[85] + minus_U26_xy*beta[86] + minus_f36_x;
    const double minus_U26_yy = w26_x*w26_x + ww26_zz;
    const double U26_yx = qdd[24] - minus_ww26_xy;
    const double minus_U26_yz = c24*qdd[23];
    const double minus_f36_z = U26_yx*beta[87] - minus_U26_yz*beta[88] + minus_U26_yy*beta[89];
    const double fc26_y = U26_yx*beta[85] - minus_U26_yy*beta[86] + minus_f36_z;
    const double ww16_zz = qd[23]*qd[23];
    const double ww26_xz = qd[24]*w26_x;
    /* link 26: angular acceleration, wd26 = R26' wd16 + (R26' w16) x qd26 z + qdd26 z */
    const double minus_wd26_y = minus_U26_xz + ww26_xz;
    const double U26_zx = ww26_xz + minus_wd26_y;
    const double minus_ww26_yz = qd[24]*minus_w26_y;
    const double wd26_x = minus_U26_yz - minus_ww26_yz;
    const double minus_U26_zy = minus_ww26_yz - wd26_x;
    const double minus_f36_y = ww16_zz*beta[88] - U26_zx*beta[87] - minus_U26_zy*beta[89];
    /* link 16: force on the link and all that it carries, fc16 = f16 + sum of R fc of what hangs on
        it */
    const double fc16_y = minus_U26_zy*beta[86] - U26_zx*beta[85] + minus_f36_y + (qdd[23]*beta[78]
        - ww16_zz*beta[79]);
    /* link B6: force on the link and all that it carries, fc_B6 = f_B6 + sum of R fc of what hangs
        on it */
    const double minus_fc_B6_x = s23*(s24*minus_fc26_x - c24*fc26_y - (ww16_zz*beta[78] +
        qdd[23]*beta[79])) + c23*fc16_y;
    const double minus_fc16_z = c24*minus_fc26_x + s24*fc26_y;
    /* link 25: angular velocity, w25 = R25' w15 + qd25 z */
    const double minus_w25_y = s21*qd[20];
    const double ww25_zz = qd[21]*qd[21];
    /* link 25: acceleration of points of the link, U25 = [wd25 x] + [w25 x][w25 x] */
    const double minus_U25_xx = minus_w25_y*minus_w25_y + ww25_zz;
    const double minus_U25_xz = s21*qdd[20];
    const double w25_x = c21*qd[20];
    const double minus_ww25_xy = w25_x*minus_w25_y;
    const double minus_U25_xy = qdd[21] + minus_ww25_xy;
    /* link 35: force on the link, f35 = M35 vd35 + U35 MS35 */
    const double minus_f35_x = minus_U25_xx*beta[74] + minus_U25_xz*beta[75] -
        minus_U25_xy*beta[76];
    /* link 25: force on the link and all that it carries, fc25 = f25 + sum of R fc of what hangs on
        it */
    const double minus_fc25_x = minus_U25_xx*beta[72] + minus_U25_xy*beta[73] + minus_f35_x;
    const double minus_U25_yy = w25_x*w25_x + ww25_zz;
    const double U25_yx = qdd[21] - minus_ww25_xy;
    const double minus_U25_yz = c21*qdd[20];
    const double minus_f35_z = U25_yx*beta[74] - minus_U25_yz*beta[75] + minus_U25_yy*beta[76];
    const double fc25_y = U25_yx*beta[72] - minus_U25_yy*beta[73] + minus_f35_z;
    const double ww15_zz = qd[20]*qd[20];
    const double ww25_xz = qd[21]*w25_x;
    /* link 25: angular acceleration, wd25 = R25' wd15 + (R25' w15) x qd25 z + qdd25 z */
    const double minus_wd25_y = minus_U25_xz + ww25_xz;
    const double U25_zx = ww25_xz + minus_wd25_y;
    const double minus_ww25_yz = qd[21]*minus_w25_y;
    const double wd25_x = minus_U25_yz - minus_ww25_yz;
    const double minus_U25_zy = minus_ww25_yz - wd25_x;
    const double minus_f35_y = ww15_zz*beta[75] - U25_zx*beta[74] - minus_U25_zy*beta[76];
    /* link 15: force on the link and all that it carries, fc15 = f15 + sum of R fc of what hangs on
        it */
    const double fc15_y = minus_U25_zy*beta[73] - U25_zx*beta[72] + minus_f35_y + (qdd[20]*beta[65]
        - ww15_zz*beta[66]);
    /* link B5: force on the link and all that it carries, fc_B5 = f_B5 + sum of R fc of what hangs
        on it */
    const double minus_fc_B5_x = s20*(s21*minus_fc25_x - c21*fc25_y - (ww15_zz*beta[65] +
        qdd[20]*beta[66])) + c20*fc15_y;
    const double minus_fc15_z = c21*minus_fc25_x + s21*fc25_y;
    /* link 24: angular velocity, w24 = R24' w14 + qd24 z */
    const double minus_w24_y = s18*qd[17];
    const double ww24_zz = qd[18]*qd[18];
    /* link 24: acceleration of points of the link, U24 = [wd24 x] + [w24 x][w24 x] */
    const double minus_U24_xx = minus_w24_y*minus_w24_y + ww24_zz;
    const double minus_U24_xz = s18*qdd[17];
    const double w24_x = c18*qd[17];
    const double minus_ww24_xy = w24_x*minus_w24_y;
    const double minus_U24_xy = qdd[18] + minus_ww24_xy;
    /* link 34: force on the link, f34 = M34 vd34 + U34 MS34 */
    const double minus_f34_x = minus_U24_xx*beta[61] + minus_U24_xz*beta[62] -
        minus_U24_xy*beta[63];
    /* link 24: force on the link and all that it carries, fc24 = f24 + sum of R fc of what hangs on
        it */
    const double minus_fc24_x = minus_U24_xx*beta[59] + minus_U24_xy*beta[60] + minus_f34_x;
    const double minus_U24_yy = w24_x*w24_x + ww24_zz;
    const double U24_yx = qdd[18] - minus_ww24_xy;
    const double minus_U24_yz = c18*qdd[17];
    const double minus_f34_z = U24_yx*beta[61] - minus_U24_yz*beta[62] + minus_U24_yy*beta[63];
    const double fc24_y = U24_yx*beta[59] - minus_U24_yy*beta[60] + minus_f34_z;
    const double ww14_zz = qd[17]*qd[17];
    const double ww24_xz = qd[18]*w24_x;
    /* link 24: angular acceleration, wd24 = R24' wd14 + (R24' w14) x qd24 z + qdd24 z */
    const double minus_wd24_y = minus_U24_xz + ww24_xz;
    const double U24_zx = ww24_xz + minus_wd24_y;
    const double minus_ww24_yz = qd[18]*minus_w24_y;
    const double wd24_x = minus_U24_yz - minus_ww24_yz;
    const double minus_U24_zy = minus_ww24_yz - wd24_x;
    const double minus_f34_y = ww14_zz*beta[62] - U24_zx*beta[61] - minus_U24_zy*beta[63];
    /* link 14: force on the link and all that it carries, fc14 = f14 + sum of R fc of what hangs on
        it */
    const double fc14_y = minus_U24_zy*beta[60] - U24_zx*beta[59] + minus_f34_y + (qdd[17]*beta[52]
        - ww14_zz*beta[53]);
    /* link B4: force on the link and all that it carries, fc_B4 = f_B4 + sum of R fc of what hangs
        on it */
    const double minus_fc_B4_x = s17*(s18*minus_fc24_x - c18*fc24_y - (ww14_zz*beta[52] +
        qdd[17]*beta[53])) + c17*fc14_y;
    const double minus_fc14_z = c18*minus_fc24_x + s18*fc24_y;
    /* link 23: angular velocity, w23 = R23' w13 + qd23 z */
    const double minus_w23_y = s15*qd[14];
    const double ww23_zz = qd[15]*qd[15];
    /* link 23: acceleration of points of the link, U23 = [wd23 x] + [w23 x][w23 x] */
    const double minus_U23_xx = minus_w23_y*minus_w23_y + ww23_zz;
    const double minus_U23_xz = s15*qdd[14];
    const double w23_x = c15*qd[14];
    const double minus_ww23_xy = w23_x*minus_w23_y;
    const double minus_U23_xy = qdd[15] + minus_ww23_xy;
    /* link 33: force on the link, f33 = M33 vd33 + U33 MS33 */
    const double minus_f33_x = minus_U23_xx*beta[48] + minus_U23_xz*beta[49] -
        minus_U23_xy*beta[50];
    /* link 23: force on the link and all that it carries, fc23 = f23 + sum of R fc of what hangs on
        it */
    const double minus_fc23_x = minus_U23_xx*beta[46] + minus_U23_xy*beta[47] + minus_f33_x;
    const double minus_U23_yy = w23_x*w23_x + ww23_zz;
    const double U23_yx = qdd[15] - minus_ww23_xy;
    const double minus_U23_yz = c15*qdd[14];
    const double minus_f33_z = U23_yx*beta[48] - minus_U23_yz*beta[49] + minus_U23_yy*beta[50];
    const double fc23_y = U23_yx*beta[46] - minus_U23_yy*beta[47] + minus_f33_z;
    const double ww13_zz = qd[14]*qd[14];
    const double ww23_xz = qd[15]*w23_x;
    /* link 23: angular acceleration, wd23 = R23' wd13 + (R23' w13) x qd23 z + qdd23 z */
    const double minus_wd23_y = minus_U23_xz + ww23_xz;
    const double U23_zx = ww23_xz + minus_wd23_y;
    const double minus_ww23_yz = qd[15]*minus_w23_y;
    const double wd23_x = minus_U23_yz - minus_ww23_yz;
    const double minus_U23_zy = minus_ww23_yz - wd23_x;
    const double minus_f33_y = ww13_zz*beta[49] - U23_zx*beta[48] - minus_U23_zy*beta[50];
    /* link 13: force on the link and all that it carries, fc13 = f13 + sum of R fc of what hangs on
        it */
    const double fc13_y = minus_U23_zy*beta[47] - U23_zx*beta[46] + minus_f33_y + (qdd[14]*beta[39]
        - ww13_zz*beta[40]);
    /* link B3: force on the link and all that it carries, fc_B3 = f_B3 + sum of R fc of what hangs
        on it */
    const double minus_fc_B3_x = s14*(s15*minus_fc23_x - c15*fc23_y - (ww13_zz*beta[39] +
        qdd[14]*beta[40])) + c14*fc13_y;
    const double minus_fc13_z = c15*minus_fc23_x + s15*fc23_y;
    const double t139 = x_B6_x*minus_fc_B6_x - x_B6_y*minus_fc16_z + (x_B5_x*minus_fc_B5_x -
        x_B5_y*minus_fc15_z) + (x_B4_x*minus_fc_B4_x - x_B4_y*minus_fc14_z);
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double minus_w22_y = s12*qd[11];
    const double ww22_zz = qd[12]*qd[12];
    /* link 22: acceleration of points of the link, U22 = [wd22 x] + [w22 x][w22 x] */
    const double minus_U22_xx = minus_w22_y*minus_w22_y + ww22_zz;
    const double minus_U22_xz = s12*qdd[11];
    const double w22_x = c12*qd[11];
    const double minus_ww22_xy = w22_x*minus_w22_y;
    const double minus_U22_xy = qdd[12] + minus_ww22_xy;
    /* link 32: force on the link, f32 = M32 vd32 + U32 MS32 */
    const double minus_f32_x = minus_U22_xx*beta[35] + minus_U22_xz*beta[36] -
        minus_U22_xy*beta[37];
    /* link 22: force on the link and all that it carries, fc22 = f22 + sum of R fc of what hangs on
        it */
    const double minus_fc22_x = minus_U22_xx*beta[33] + minus_U22_xy*beta[34] + minus_f32_x;
    const double minus_U22_yy = w22_x*w22_x + ww22_zz;
    const double U22_yx = qdd[12] - minus_ww22_xy;
    const double minus_U22_yz = c12*qdd[11];
    const double minus_f32_z = U22_yx*beta[35] - minus_U22_yz*beta[36] + minus_U22_yy*beta[37];
    const double fc22_y = U22_yx*beta[33] - minus_U22_yy*beta[34] + minus_f32_z;
    const double ww12_zz = qd[11]*qd[11];
    const double ww22_xz = qd[12]*w22_x;
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double minus_wd22_y = minus_U22_xz + ww22_xz;
    const double U22_zx = ww22_xz + minus_wd22_y;
    const double minus_ww22_yz = qd[12]*minus_w22_y;
    const double wd22_x = minus_U22_yz - minus_ww22_yz;
    const double minus_U22_zy = minus_ww22_yz - wd22_x;
    const double minus_f32_y = ww12_zz*beta[36] - U22_zx*beta[35] - minus_U22_zy*beta[37];
    /* link 12: force on the link and all that it carries, fc12 = f12 + sum of R fc of what hangs on
        it */
    const double fc12_y = minus_U22_zy*beta[34] - U22_zx*beta[33] + minus_f32_y + (qdd[11]*beta[26]
        - ww12_zz*beta[27]);
    /* link B2: force on the link and all that it carries, fc_B2 = f_B2 + sum of R fc of what hangs
        on it */
    const double minus_fc_B2_x = s11*(s12*minus_fc22_x - c12*fc22_y - (ww12_zz*beta[26] +
        qdd[11]*beta[27])) + c11*fc12_y;
    const double minus_fc12_z = c12*minus_fc22_x + s12*fc22_y;
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double minus_w21_y = s9*qd[8];
    const double ww21_zz = qd[9]*qd[9];
    /* link 21: acceleration of points of the link, U21 = [wd21 x] + [w21 x][w21 x] */
    const double minus_U21_xx = minus_w21_y*minus_w21_y + ww21_zz;
    const double minus_U21_xz = s9*qdd[8];
    const double w21_x = c9*qd[8];
    const double minus_ww21_xy = w21_x*minus_w21_y;
    const double minus_U21_xy = qdd[9] + minus_ww21_xy;
    /* link 31: force on the link, f31 = M31 vd31 + U31 MS31 */
    const double minus_f31_x = minus_U21_xx*beta[22] + minus_U21_xz*beta[23] -
        minus_U21_xy*beta[24];
    /* link 21: force on the link and all that it carries, fc21 = f21 + sum of R fc of what hangs on
        it */
    const double minus_fc21_x = minus_U21_xx*beta[20] + minus_U21_xy*beta[21] + minus_f31_x;
    const double minus_U21_yy = w21_x*w21_x + ww21_zz;
    const double U21_yx = qdd[9] - minus_ww21_xy;
    const double minus_U21_yz = c9*qdd[8];
    const double minus_f31_z = U21_yx*beta[22] - minus_U21_yz*beta[23] + minus_U21_yy*beta[24];
    const double fc21_y = U21_yx*beta[20] - minus_U21_yy*beta[21] + minus_f31_z;
    const double ww11_zz = qd[8]*qd[8];
    const double ww21_xz = qd[9]*w21_x;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double minus_wd21_y = minus_U21_xz + ww21_xz;
    const double U21_zx = ww21_xz + minus_wd21_y;
    const double minus_ww21_yz = qd[9]*minus_w21_y;
    const double wd21_x = minus_U21_yz - minus_ww21_yz;
    const double minus_U21_zy = minus_ww21_yz - wd21_x;
    const double minus_f31_y = ww11_zz*beta[23] - U21_zx*beta[22] - minus_U21_zy*beta[24];
    /* link 11: force on the link and all that it carries, fc11 = f11 + sum of R fc of what hangs on
        it */
    const double fc11_y = minus_U21_zy*beta[21] - U21_zx*beta[20] + minus_f31_y + (qdd[8]*beta[13] -
        ww11_zz*beta[14]);
    /* link B1: force on the link and all that it carries, fc_B1 = f_B1 + sum of R fc of what hangs
        on it */
    const double minus_fc_B1_x = s8*(s9*minus_fc21_x - c9*fc21_y - (ww11_zz*beta[13] +
        qdd[8]*beta[14])) + c8*fc11_y;
    const double minus_fc11_z = c9*minus_fc21_x + s9*fc21_y;
    /* link B: force on the link and all that it carries, fc_B = f_B + sum of R fc of what hangs on
        it */
    const double minus_fc_B_x = x_B3_x*minus_fc_B3_x - x_B3_y*minus_fc13_z + t139 +
        (x_B2_x*minus_fc_B2_x - x_B2_y*minus_fc12_z) + (x_B1_x*minus_fc_B1_x - x_B1_y*minus_fc11_z);
    tau[6] = qdd[6]*beta[10] - (minus_fc_B_x - qdd[6]*beta[11]);
    const double t191 = x_B6_y*minus_fc_B6_x + x_B6_x*minus_fc16_z + (x_B5_y*minus_fc_B5_x +
        x_B5_x*minus_fc15_z) + (x_B4_y*minus_fc_B4_x + x_B4_x*minus_fc14_z);
    const double minus_fc_B_y = x_B3_y*minus_fc_B3_x + x_B3_x*minus_fc13_z + t191 +
        (x_B2_y*minus_fc_B2_x + x_B2_x*minus_fc12_z) + (x_B1_y*minus_fc_B1_x + x_B1_x*minus_fc11_z);
    tau[7] = qdd[7]*beta[11] - minus_fc_B_y;
    /* link B1: acceleration of the origin less gravity, vd_B1 = R_B1' (vd_B + U_B p_B1) */
    const double vd_B1_y = x_B1_x*qdd[7] - x_B1_y*qdd[6];
    const double vd_B1_x = x_B1_x*qdd[6] + x_B1_y*qdd[7];
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd_B1 + U_B1 p11) */
    const double minus_vd11_x = s8*vd_B1_x + evra_geo_g*c8;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = s9*vd_B1_y - c9*minus_vd11_x;
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) + 2 w31 x qd31
        z + qdd31 z */
    const double vd31_z = minus_vd21_y - q[10]*minus_U21_yy + qdd[10];
    const double vd11_y = evra_geo_g*s8 - c8*vd_B1_x;
    const double minus_vd31_y = vd11_y - q[10]*minus_U21_zy + qd[10]*w21_x*2.0;
    const double h21_z = w21_x*beta[17] - minus_w21_y*beta[18] + qd[9]*beta[19];
    const double h21_y = w21_x*beta[16] + qd[9]*beta[18];
    const double t202 = minus_w21_y*h21_z + qd[9]*h21_y - (wd21_x*beta[15] - minus_wd21_y*beta[16] +
        qdd[9]*beta[17]);
    const double vd21_x = s9*minus_vd11_x + c9*vd_B1_y;
    const double vd31_x = vd21_x + q[10]*minus_U21_xy + qd[9]*qd[10]*2.0;
    const double h21_x = w21_x*beta[15] - minus_w21_y*beta[16] + qd[9]*beta[17];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_y = qd[9]*h21_x - w21_x*h21_z + (wd21_x*beta[16] + qdd[9]*beta[18]) +
        vd11_y*beta[20];
    const double t207 = c9*(vd31_z*beta[23] + minus_vd31_y*beta[24] + q[10]*minus_f31_y - (t202 +
        vd11_y*beta[21]));
    /* link 21: moment on the link and all that it carries, nc21 = n21 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc21a_z = t207 - s9*(minus_vd31_y*beta[22] + vd31_x*beta[23] + n21_y);
    tau[8] = vd11_y*beta[13] + minus_vd11_x*beta[14] + qdd[8]*beta[12] + nc21a_z;
    const double t209 = w21_x*h21_y + minus_w21_y*h21_x + (wd21_x*beta[17] - minus_wd21_y*beta[18] +
        qdd[9]*beta[19]);
    /* link 31: moment on the link and all that it carries, nc31 = n31 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc31a_z = vd31_x*beta[24] - vd31_z*beta[22] - q[10]*minus_f31_x;
    tau[9] = t209 - (minus_vd21_y*beta[20] + vd21_x*beta[21]) + nc31a_z;
    tau[10] = -minus_f31_z;
    /* link B2: acceleration of the origin less gravity, vd_B2 = R_B2' (vd_B + U_B p_B2) */
    const double vd_B2_y = x_B2_x*qdd[7] - x_B2_y*qdd[6];
    const double vd_B2_x = x_B2_x*qdd[6] + x_B2_y*qdd[7];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd_B2 + U_B2 p12) */
    const double minus_vd12_x = s11*vd_B2_x + evra_geo_g*c11;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = s12*vd_B2_y - c12*minus_vd12_x;
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) + 2 w32 x qd32
        z + qdd32 z */
    const double vd32_z = minus_vd22_y - q[13]*minus_U22_yy + qdd[13];
    const double vd12_y = evra_geo_g*s11 - c11*vd_B2_x;
    const double minus_vd32_y = vd12_y - q[13]*minus_U22_zy + qd[13]*w22_x*2.0;
    const double h22_z = w22_x*beta[30] - minus_w22_y*beta[31] + qd[12]*beta[32];
    const double h22_y = w22_x*beta[29] + qd[12]*beta[31];
    const double t220 = wd22_x*beta[28] - minus_wd22_y*beta[29] + qdd[12]*beta[30];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double minus_n22_x = minus_w22_y*h22_z + qd[12]*h22_y - t220 + vd12_y*beta[34];
    const double vd22_x = s12*minus_vd12_x + c12*vd_B2_y;
    const double vd32_x = vd22_x + q[13]*minus_U22_xy + qd[12]*qd[13]*2.0;
    const double h22_x = w22_x*beta[28] - minus_w22_y*beta[29] + qd[12]*beta[30];
    const double t225 = qd[12]*h22_x - w22_x*h22_z + (wd22_x*beta[29] + qdd[12]*beta[31]);
    const double t226 = s12*(minus_vd32_y*beta[35] + vd32_x*beta[36] + (t225 + vd12_y*beta[33]));
    /* link 22: moment on the link and all that it carries, nc22 = n22 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc22a_z = c12*(vd32_z*beta[36] + minus_vd32_y*beta[37] + q[13]*minus_f32_y -
        minus_n22_x) - t226;
    tau[11] = vd12_y*beta[26] + minus_vd12_x*beta[27] + qdd[11]*beta[25] + nc22a_z;
    const double t228 = w22_x*h22_y + minus_w22_y*h22_x + (wd22_x*beta[30] - minus_wd22_y*beta[31] +
        qdd[12]*beta[32]);
    /* link 32: moment on the link and all that it carries, nc32 = n32 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc32a_z = vd32_x*beta[37] - vd32_z*beta[35] - q[13]*minus_f32_x;
    tau[12] = t228 - (minus_vd22_y*beta[33] + vd22_x*beta[34]) + nc32a_z;
    tau[13] = -minus_f32_z;
    /* link B3: acceleration of the origin less gravity, vd_B3 = R_B3' (vd_B + U_B p_B3) */
    const double vd_B3_y = x_B3_x*qdd[7] - x_B3_y*qdd[6];
    const double vd_B3_x = x_B3_x*qdd[6] + x_B3_y*qdd[7];
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd_B3 + U_B3 p13) */
    const double minus_vd13_x = s14*vd_B3_x + evra_geo_g*c14;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = s15*vd_B3_y - c15*minus_vd13_x;
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) + 2 w33 x qd33
        z + qdd33 z */
    const double vd33_z = minus_vd23_y - q[16]*minus_U23_yy + qdd[16];
    const double vd13_y = evra_geo_g*s14 - c14*vd_B3_x;
    const double minus_vd33_y = vd13_y - q[16]*minus_U23_zy + qd[16]*w23_x*2.0;
    const double h23_z = w23_x*beta[43] - minus_w23_y*beta[44] + qd[15]*beta[45];
    const double h23_y = w23_x*beta[42] + qd[15]*beta[44];
    const double t239 = wd23_x*beta[41] - minus_wd23_y*beta[42] + qdd[15]*beta[43];
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double minus_n23_x = minus_w23_y*h23_z + qd[15]*h23_y - t239 + vd13_y*beta[47];
    const double vd23_x = s15*minus_vd13_x + c15*vd_B3_y;
    const double vd33_x = vd23_x + q[16]*minus_U23_xy + qd[15]*qd[16]*2.0;
    const double h23_x = w23_x*beta[41] - minus_w23_y*beta[42] + qd[15]*beta[43];
    const double t244 = qd[15]*h23_x - w23_x*h23_z + (wd23_x*beta[42] + qdd[15]*beta[44]);
    const double t245 = s15*(minus_vd33_y*beta[48] + vd33_x*beta[49] + (t244 + vd13_y*beta[46]));
    /* link 23: moment on the link and all that it carries, nc23 = n23 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc23a_z = c15*(vd33_z*beta[49] + minus_vd33_y*beta[50] + q[16]*minus_f33_y -
        minus_n23_x) - t245;
    tau[14] = vd13_y*beta[39] + minus_vd13_x*beta[40] + qdd[14]*beta[38] + nc23a_z;
    const double t247 = w23_x*h23_y + minus_w23_y*h23_x + (wd23_x*beta[43] - minus_wd23_y*beta[44] +
        qdd[15]*beta[45]);
    /* link 33: moment on the link and all that it carries, nc33 = n33 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc33a_z = vd33_x*beta[50] - vd33_z*beta[48] - q[16]*minus_f33_x;
    tau[15] = t247 - (minus_vd23_y*beta[46] + vd23_x*beta[47]) + nc33a_z;
    tau[16] = -minus_f33_z;
    /* link B4: acceleration of the origin less gravity, vd_B4 = R_B4' (vd_B + U_B p_B4) */
    const double vd_B4_y = x_B4_x*qdd[7] - x_B4_y*qdd[6];
    const double vd_B4_x = x_B4_x*qdd[6] + x_B4_y*qdd[7];
    /* link 14: acceleration of the origin less gravity, vd14 = R14' (vd_B4 + U_B4 p14) */
    const double minus_vd14_x = s17*vd_B4_x + evra_geo_g*c17;
    /* link 24: acceleration of the origin less gravity, vd24 = R24' (vd14 + U14 p24) */
    const double minus_vd24_y = s18*vd_B4_y - c18*minus_vd14_x;
    /* link 34: acceleration of the origin less gravity, vd34 = R34' (vd24 + U24 p34) + 2 w34 x qd34
        z + qdd34 z */
    const double vd34_z = minus_vd24_y - q[19]*minus_U24_yy + qdd[19];
    const double vd14_y = evra_geo_g*s17 - c17*vd_B4_x;
    const double minus_vd34_y = vd14_y - q[19]*minus_U24_zy + qd[19]*w24_x*2.0;
    const double h24_z = w24_x*beta[56] - minus_w24_y*beta[57] + qd[18]*beta[58];
    const double h24_y = w24_x*beta[55] + qd[18]*beta[57];
    const double t258 = wd24_x*beta[54] - minus_wd24_y*beta[55] + qdd[18]*beta[56];
    /* link 24: moment on the link at its origin, n24 = J24 wd24 + w24 x J24 w24 + MS24 x vd24 */
    const double minus_n24_x = minus_w24_y*h24_z + qd[18]*h24_y - t258 + vd14_y*beta[60];
    const double vd24_x = s18*minus_vd14_x + c18*vd_B4_y;
    const double vd34_x = vd24_x + q[19]*minus_U24_xy + qd[18]*qd[19]*2.0;
    const double h24_x = w24_x*beta[54] - minus_w24_y*beta[55] + qd[18]*beta[56];
    const double t263 = qd[18]*h24_x - w24_x*h24_z + (wd24_x*beta[55] + qdd[18]*beta[57]);
    const double t264 = s18*(minus_vd34_y*beta[61] + vd34_x*beta[62] + (t263 + vd14_y*beta[59]));
    /* link 24: moment on the link and all that it carries, nc24 = n24 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc24a_z = c18*(vd34_z*beta[62] + minus_vd34_y*beta[63] + q[19]*minus_f34_y -
        minus_n24_x) - t264;
    tau[17] = vd14_y*beta[52] + minus_vd14_x*beta[53] + qdd[17]*beta[51] + nc24a_z;
    const double t266 = w24_x*h24_y + minus_w24_y*h24_x + (wd24_x*beta[56] - minus_wd24_y*beta[57] +
        qdd[18]*beta[58]);
    /* link 34: moment on the link and all that it carries, nc34 = n34 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc34a_z = vd34_x*beta[63] - vd34_z*beta[61] - q[19]*minus_f34_x;
    tau[18] = t266 - (minus_vd24_y*beta[59] + vd24_x*beta[60]) + nc34a_z;
    tau[19] = -minus_f34_z;
    /* link B5: acceleration of the origin less gravity, vd_B5 = R_B5' (vd_B + U_B p_B5) */
    const double vd_B5_y = x_B5_x*qdd[7] - x_B5_y*qdd[6];
    const double vd_B5_x = x_B5_x*qdd[6] + x_B5_y*qdd[7];
    /* link 15: acceleration of the origin less gravity, vd15 = R15' (vd_B5 + U_B5 p15) */
    const double minus_vd15_x = s20*vd_B5_x + evra_geo_g*c20;
    /* link 25: acceleration of the origin less gravity, vd25 = R25' (vd15 + U15 p25) */
    const double minus_vd25_y = s21*vd_B5_y - c21*minus_vd15_x;
    /* link 35: acceleration of the origin less gravity, vd35 = R35' (vd25 + U25 p35) + 2 w35 x qd35
        z + qdd35 z */
    const double vd35_z = minus_vd25_y - q[22]*minus_U25_yy + qdd[22];
    const double vd15_y = evra_geo_g*s20 - c20*vd_B5_x;
    const double minus_vd35_y = vd15_y - q[22]*minus_U25_zy + qd[22]*w25_x*2.0;
    const double h25_z = w25_x*beta[69] - minus_w25_y*beta[70] + qd[21]*beta[71];
    const double h25_y = w25_x*beta[68] + qd[21]*beta[70];
    const double t277 = minus_w25_y*h25_z + qd[21]*h25_y - (wd25_x*beta[67] - minus_wd25_y*beta[68]
        + qdd[21]*beta[69]);
    const double vd25_x = s21*minus_vd15_x + c21*vd_B5_y;
    const double vd35_x = vd25_x + q[22]*minus_U25_xy + qd[21]*qd[22]*2.0;
    const double h25_x = w25_x*beta[67] - minus_w25_y*beta[68] + qd[21]*beta[69];
    /* link 25: moment on the link at its origin, n25 = J25 wd25 + w25 x J25 w25 + MS25 x vd25 */
    const double n25_y = qd[21]*h25_x - w25_x*h25_z + (wd25_x*beta[68] + qdd[21]*beta[70]) +
        vd15_y*beta[72];
    const double t282 = c21*(vd35_z*beta[75] + minus_vd35_y*beta[76] + q[22]*minus_f35_y - (t277 +
        vd15_y*beta[73]));
    /* link 25: moment on the link and all that it carries, nc25 = n25 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc25a_z = t282 - s21*(minus_vd35_y*beta[74] + vd35_x*beta[75] + n25_y);
    tau[20] = vd15_y*beta[65] + minus_vd15_x*beta[66] + qdd[20]*beta[64] + nc25a_z;
    const double t284 = w25_x*h25_y + minus_w25_y*h25_x + (wd25_x*beta[69] - minus_wd25_y*beta[70] +
        qdd[21]*beta[71]);
    /* link 35: moment on the link and all that it carries, nc35 = n35 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc35a_z = vd35_x*beta[76] - vd35_z*beta[74] - q[22]*minus_f35_x;
    tau[21] = t284 - (minus_vd25_y*beta[72] + vd25_x*beta[73]) + nc35a_z;
    tau[22] = -minus_f35_z;
    /* link B6: acceleration of the origin less gravity, vd_B6 = R_B6' (vd_B + U_B p_B6) */
    const double vd_B6_y = x_B6_x*qdd[7] - x_B6_y*qdd[6];
    const double vd_B6_x = x_B6_x*qdd[6] + x_B6_y*qdd[7];
    /* link 16: acceleration of the origin less gravity, vd16 = R16' (vd_B6 + U_B6 p16) */
    const double minus_vd16_x = s23*vd_B6_x + evra_geo_g*c23;
    /* link 26: acceleration of the origin less gravity, vd26 = R26' (vd16 + U16 p26) */
    const double minus_vd26_y = s24*vd_B6_y - c24*minus_vd16_x;
    /* link 36: acceleration of the origin less gravity, vd36 = R36' (vd26 + U26 p36) + 2 w36 x qd36
        z + qdd36 z */
    const double vd36_z = minus_vd26_y - q[25]*minus_U26_yy + qdd[25];
    const double vd16_y = evra_geo_g*s23 - c23*vd_B6_x;
    const double minus_vd36_y = vd16_y - q[25]*minus_U26_zy + qd[25]*w26_x*2.0;
    const double h26_z = w26_x*beta[82] - minus_w26_y*beta[83] + qd[24]*beta[84];
    const double h26_y = w26_x*beta[81] + qd[24]*beta[83];
    const double t295 = minus_w26_y*h26_z + qd[24]*h26_y - (wd26_x*beta[80] - minus_wd26_y*beta[81]
        + qdd[24]*beta[82]);
    const double vd26_x = s24*minus_vd16_x + c24*vd_B6_y;
    const double vd36_x = vd26_x + q[25]*minus_U26_xy + qd[24]*qd[25]*2.0;
    const double h26_x = w26_x*beta[80] - minus_w26_y*beta[81] + qd[24]*beta[82];
    /* link 26: moment on the link at its origin, n26 = J26 wd26 + w26 x J26 w26 + MS26 x vd26 */
    const double n26_y = qd[24]*h26_x - w26_x*h26_z + (wd26_x*beta[81] + qdd[24]*beta[83]) +
        vd16_y*beta[85];
    const double t300 = c24*(vd36_z*beta[88] + minus_vd36_y*beta[89] + q[25]*minus_f36_y - (t295 +
        vd16_y*beta[86]));
    /* link 26: moment on the link and all that it carries, nc26 = n26 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc26a_z = t300 - s24*(minus_vd36_y*beta[87] + vd36_x*beta[88] + n26_y);
    tau[23] = vd16_y*beta[78] + minus_vd16_x*beta[79] + qdd[23]*beta[77] + nc26a_z;
    const double t302 = w26_x*h26_y + minus_w26_y*h26_x + (wd26_x*beta[82] - minus_wd26_y*beta[83] +
        qdd[24]*beta[84]);
    /* link 36: moment on the link and all that it carries, nc36 = n36 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc36a_z = vd36_x*beta[89] - vd36_z*beta[87] - q[25]*minus_f36_x;
    tau[24] = t302 - (minus_vd26_y*beta[85] + vd26_x*beta[86]) + nc36a_z;
    tau[25] = -minus_f36_z;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 124 additions, 188 multiplications. */
void evra_tree_inertia_matrix(const double q[26], const double beta[90],
                              double MODELER_OUT(M, 26 * 26))
{
    MODELER_ALL_ZEROS(M, 676);

    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    M[0] = beta[9];
    /* link Pb: first moments of the link and all that it carries, MSc_Pb = MS_Pb + sum of R MSc +
        Mc p of what hangs on it */
    const double minus_MSc_Pb_y = s5*beta[7] - c5*beta[6];
    /* link Pa: first moments of the link and all that it carries, MSc_Pa = MS_Pa + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_Pa_y = s4*minus_MSc_Pb_y + c4*beta[8];
    MODELER_ZEROS(M + 1, 3);
    M[4] = MSc_Pa_y;
    const double MSc_Pb_z = c5*beta[7] + s5*beta[6];
    MODELER_ZEROS(M + 6, 8);
    const double minus_lin_Pba_Pz = c4*MSc_Pb_z;
    M[5] = -minus_lin_Pba_Pz;
    M[27] = beta[9];
    MODELER_ZEROS(M + 14, 8);
    /* link Pz: first moments of the link and all that it carries, MSc_Pz = MS_Pz + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_Pz_z = c3*MSc_Pa_y + s3*MSc_Pb_z;
    M[29] = -MSc_Pz_z;
    MODELER_ZEROS(M + 22, 5);
    const double minus_MSc_Pa_z = c4*minus_MSc_Pb_y - s4*beta[8];
    const double minus_lin_Paa_Pby = s3*minus_MSc_Pa_z;
    MODELER_ZEROS(M + 28, 1);
    M[30] = -minus_lin_Paa_Pby;
    const double lin_Pba_Py = s4*MSc_Pb_z;
    const double minus_lin_Paa_Py = c3*minus_MSc_Pb_y + s3*lin_Pba_Py;
    MODELER_ZEROS(M + 32, 8);
    M[31] = -minus_lin_Paa_Py;
    M[54] = beta[9];
    MODELER_ZEROS(M + 40, 8);
    const double minus_MSc_Pz_y = s3*MSc_Pa_y - c3*MSc_Pb_z;
    M[55] = -minus_MSc_Pz_y;
    const double lin_Paa_Pbz = c3*minus_MSc_Pa_z;
    MODELER_ZEROS(M + 48, 6);
    M[56] = lin_Paa_Pbz;
    const double minus_lin_Paa_Pz = s3*minus_MSc_Pb_y - c3*lin_Pba_Py;
    MODELER_ZEROS(M + 58, 8);
    M[57] = -minus_lin_Paa_Pz;
    M[79] = -MSc_Pz_z;
    MODELER_ZEROS(M + 66, 8);
    M[80] = -minus_MSc_Pz_y;
    /* link Pb: inertia of the link and all that it carries, Jc_Pb = J_Pb + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc_Pb_xy = c5*beta[2] - s5*beta[4];
    const double ang_Pba_Pz = s4*beta[5] + c4*Jc_Pb_xy;
    MODELER_ZEROS(M + 74, 5);
    const double t15 = s5*beta[1];
    const double t16 = c5*beta[0] - t15;
    MODELER_ZEROS(M + 84, 8);
    const double t17 = c5*beta[1];
    const double t18 = t17 - s5*beta[3];
    MODELER_ZEROS(M + 92, 8);
    M[81] = s4*ang_Pba_Pz + c4*(s4*Jc_Pb_xy + c4*(c5*t16 - s5*t18));
    const double Jc_Pb_xz = s5*beta[2] + c5*beta[4];
    /* link Pa: inertia of the link and all that it carries, Jc_Pa = J_Pa + sum of R Jc R' + Js of
        what hangs on it */
    const double Jc_Pa_xz = s4*Jc_Pb_xz + c4*(s5*t16 + c5*t18);
    MODELER_ZEROS(M + 100, 4);
    M[82] = Jc_Pa_xz;
    M[83] = ang_Pba_Pz;
    MODELER_ZEROS(M + 110, 8);
    M[104] = MSc_Pa_y;
    M[105] = -minus_lin_Paa_Pby;
    M[106] = lin_Paa_Pbz;
    MODELER_ZEROS(M + 118, 8);
    M[107] = Jc_Pa_xz;
    M[108] = s5*(s5*beta[0] + t17) + c5*(t15 + c5*beta[3]);
    MODELER_ZEROS(M + 126, 4);
    M[109] = Jc_Pb_xz;
    M[130] = -minus_lin_Pba_Pz;
    MODELER_ZEROS(M + 136, 8);
    M[131] = -minus_lin_Paa_Py;
    M[132] = -minus_lin_Paa_Pz;
    M[133] = ang_Pba_Pz;
    MODELER_ZEROS(M + 144, 8);
    M[134] = Jc_Pb_xz;
    M[135] = beta[5];
    MODELER_ZEROS(M + 152, 8);
    M[162] = beta[10] + beta[11];
    /* link 21: first moments of the link and all that it carries, MSc21 = MS21 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc21_y = beta[21] - beta[24];
    const double MSc21_x = beta[20] + beta[22];
    MODELER_ZEROS(M + 160, 2);
    const double minus_lin21a_21z = c9*MSc21_y + s9*MSc21_x;
    /* link B1: first moments of the link and all that it carries, MSc_B1 = MS_B1 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B1_z = s8*(beta[14] - beta[23]) - c8*(beta[13] - minus_lin21a_21z);
    MODELER_ZEROS(M + 163, 1);
    const double lin_B1a_11x = x_B1_x*MSc_B1_z;
    M[164] = lin_B1a_11x;
    MODELER_ZEROS(M + 166, 1);
    const double minus_lin11a_21x = s8*(s9*MSc21_y - c9*MSc21_x);
    const double minus_lin_B1a_21x = x_B1_x*minus_lin11a_21x - x_B1_y*minus_lin21a_21z;
    M[165] = -minus_lin_B1a_21x;
    MODELER_ZEROS(M + 169, 1);
    /* link 22: first moments of the link and all that it carries, MSc22 = MS22 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc22_y = beta[34] - beta[37];
    const double MSc22_x = beta[33] + beta[35];
    MODELER_ZEROS(M + 172, 1);
    const double minus_lin22a_22z = c12*MSc22_y + s12*MSc22_x;
    /* link B2: first moments of the link and all that it carries, MSc_B2 = MS_B2 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B2_z = s11*(beta[27] - beta[36]) - c11*(beta[26] - minus_lin22a_22z);
    MODELER_ZEROS(M + 175, 1);
    const double lin_B2a_12x = x_B2_x*MSc_B2_z;
    M[167] = lin_B2a_12x;
    const double minus_lin12a_22x = s11*(s12*MSc22_y - c12*MSc22_x);
    MODELER_ZEROS(M + 178, 1);
    const double minus_lin_B2a_22x = x_B2_x*minus_lin12a_22x - x_B2_y*minus_lin22a_22z;
    M[168] = -minus_lin_B2a_22x;
    MODELER_ZEROS(M + 181, 8);
    /* link 23: first moments of the link and all that it carries, MSc23 = MS23 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc23_y = beta[47] - beta[50];
    const double MSc23_x = beta[46] + beta[48];
    const double minus_lin23a_23z = c15*MSc23_y + s15*MSc23_x;
    MODELER_ZEROS(M + 192, 1);
    /* link B3: first moments of the link and all that it carries, MSc_B3 = MS_B3 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B3_z = s14*(beta[40] - beta[49]) - c14*(beta[39] - minus_lin23a_23z);
    const double lin_B3a_13x = x_B3_x*MSc_B3_z;
    MODELER_ZEROS(M + 195, 1);
    M[170] = lin_B3a_13x;
    const double minus_lin13a_23x = s14*(s15*MSc23_y - c15*MSc23_x);
    MODELER_ZEROS(M + 198, 1);
    const double minus_lin_B3a_23x = x_B3_x*minus_lin13a_23x - x_B3_y*minus_lin23a_23z;
    M[171] = -minus_lin_B3a_23x;
    /* link 24: first moments of the link and all that it carries, MSc24 = MS24 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc24_y = beta[60] - beta[63];
    MODELER_ZEROS(M + 201, 1);
    const double MSc24_x = beta[59] + beta[61];
    const double minus_lin24a_24z = c18*MSc24_y + s18*MSc24_x;
    MODELER_ZEROS(M + 204, 1);
    /* link B4: first moments of the link and all that it carries, MSc_B4 = MS_B4 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B4_z = s17*(beta[53] - beta[62]) - c17*(beta[52] - minus_lin24a_24z);
    const double lin_B4a_14x = x_B4_x*MSc_B4_z;
    M[173] = lin_B4a_14x;
    MODELER_ZEROS(M + 207, 7);
    const double minus_lin14a_24x = s17*(s18*MSc24_y - c18*MSc24_x);
    const double minus_lin_B4a_24x = x_B4_x*minus_lin14a_24x - x_B4_y*minus_lin24a_24z;
    MODELER_ZEROS(M + 219, 8);
    M[174] = -minus_lin_B4a_24x;
    /* link 25: first moments of the link and all that it carries, MSc25 = MS25 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc25_y = beta[73] - beta[76];
    MODELER_ZEROS(M + 227, 8);
    const double MSc25_x = beta[72] + beta[74];
    const double minus_lin25a_25z = c21*MSc25_y + s21*MSc25_x;
    /* link B5: first moments of the link and all that it carries, MSc_B5 = MS_B5 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B5_z = s20*(beta[66] - beta[75]) - c20*(beta[65] - minus_lin25a_25z);
    MODELER_ZEROS(M + 235, 5);
    const double lin_B5a_15x = x_B5_x*MSc_B5_z;
    M[176] = lin_B5a_15x;
    MODELER_ZEROS(M + 245, 8);
    const double minus_lin15a_25x = s20*(s21*MSc25_y - c21*MSc25_x);
    const double minus_lin_B5a_25x = x_B5_x*minus_lin15a_25x - x_B5_y*minus_lin25a_25z;
    MODELER_ZEROS(M + 253, 8);
    M[177] = -minus_lin_B5a_25x;
    /* link 26: first moments of the link and all that it carries, MSc26 = MS26 + sum of R MSc + Mc
        p of what hangs on it */
    const double MSc26_y = beta[86] - beta[89];
    const double MSc26_x = beta[85] + beta[87];
    MODELER_ZEROS(M + 261, 7);
    const double minus_lin26a_26z = c24*MSc26_y + s24*MSc26_x;
    /* link B6: first moments of the link and all that it carries, MSc_B6 = MS_B6 + sum of R MSc +
        Mc p of what hangs on it */
    const double MSc_B6_z = s23*(beta[79] - beta[88]) - c23*(beta[78] - minus_lin26a_26z);
    MODELER_ZEROS(M + 270, 8);
    const double lin_B6a_16x = x_B6_x*MSc_B6_z;
    M[179] = lin_B6a_16x;
    const double minus_lin16a_26x = s23*(s24*MSc26_y - c24*MSc26_x);
    MODELER_ZEROS(M + 278, 8);
    const double minus_lin_B6a_26x = x_B6_x*minus_lin16a_26x - x_B6_y*minus_lin26a_26z;
    M[180] = -minus_lin_B6a_26x;
    MODELER_ZEROS(M + 286, 6);
    M[189] = beta[11];
    const double lin_B1a_11y = x_B1_y*MSc_B1_z;
    MODELER_ZEROS(M + 294, 3);
    M[190] = lin_B1a_11y;
    const double minus_lin_B1a_21y = x_B1_y*minus_lin11a_21x + x_B1_x*minus_lin21a_21z;
    M[191] = -minus_lin_B1a_21y;
    MODELER_ZEROS(M + 300, 8);
    const double lin_B2a_12y = x_B2_y*MSc_B2_z;
    M[193] = lin_B2a_12y;
    MODELER_ZEROS(M + 308, 8);
    const double minus_lin_B2a_22y = x_B2_y*minus_lin12a_22x + x_B2_x*minus_lin22a_22z;
    M[194] = -minus_lin_B2a_22y;
    MODELER_ZEROS(M + 316, 2);
    const double lin_B3a_13y = x_B3_y*MSc_B3_z;
    M[196] = lin_B3a_13y;
    const double minus_lin_B3a_23y = x_B3_y*minus_lin13a_23x + x_B3_x*minus_lin23a_23z;
    MODELER_ZEROS(M + 320, 3);
    M[197] = -minus_lin_B3a_23y;
    const double lin_B4a_14y = x_B4_y*MSc_B4_z;
    MODELER_ZEROS(M + 326, 8);
    M[199] = lin_B4a_14y;
    const double minus_lin_B4a_24y = x_B4_y*minus_lin14a_24x + x_B4_x*minus_lin24a_24z;
    M[200] = -minus_lin_B4a_24y;
    MODELER_ZEROS(M + 334, 8);
    const double lin_B5a_15y = x_B5_y*MSc_B5_z;
    M[202] = lin_B5a_15y;
    MODELER_ZEROS(M + 342, 7);
    const double minus_lin_B5a_25y = x_B5_y*minus_lin15a_25x + x_B5_x*minus_lin25a_25z;
    M[203] = -minus_lin_B5a_25y;
    MODELER_ZEROS(M + 351, 8);
    const double lin_B6a_16y = x_B6_y*MSc_B6_z;
    M[205] = lin_B6a_16y;
    const double minus_lin_B6a_26y = x_B6_y*minus_lin16a_26x + x_B6_x*minus_lin26a_26z;
    MODELER_ZEROS(M + 359, 8);
    M[206] = -minus_lin_B6a_26y;
    M[214] = lin_B1a_11x;
    MODELER_ZEROS(M + 367, 3);
    M[215] = lin_B1a_11y;
    const double t75 = s9*(beta[16] + q[10]*beta[22]);
    const double Js31_xx = q[10]*beta[24]*2.0;
    MODELER_ZEROS(M + 372, 6);
    M[216] = c9*(c9*(beta[15] + Js31_xx) - t75) - c9*t75 + beta[12];
    /* link 11: inertia of the link and all that it carries, Jc11 = J11 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc11_yz = c9*beta[17] - s9*(beta[18] + q[10]*beta[23]);
    MODELER_ZEROS(M + 381, 8);
    M[217] = minus_Jc11_yz;
    const double ang21a_31z = c9*beta[23];
    MODELER_ZEROS(M + 389, 7);
    M[218] = ang21a_31z;
    M[240] = -minus_lin_B1a_21x;
    M[241] = -minus_lin_B1a_21y;
    MODELER_ZEROS(M + 398, 6);
    M[242] = minus_Jc11_yz;
    M[243] = beta[19] + Js31_xx;
    MODELER_ZEROS(M + 407, 8);
    M[244] = -beta[22];
    M[268] = ang21a_31z;
    MODELER_ZEROS(M + 415, 8);
    M[269] = -beta[22];
    M[292] = lin_B2a_12x;
    M[293] = lin_B2a_12y;
    MODELER_ZEROS(M + 423, 7);
    const double t79 = s12*(beta[29] + q[13]*beta[35]);
    const double Js32_xx = q[13]*beta[37]*2.0;
    MODELER_ZEROS(M + 432, 8);
    M[297] = c12*(c12*(beta[28] + Js32_xx) - t79) - c12*t79 + beta[25];
    /* link 12: inertia of the link and all that it carries, Jc12 = J12 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc12_yz = c12*beta[30] - s12*(beta[31] + q[13]*beta[36]);
    M[298] = minus_Jc12_yz;
    MODELER_ZEROS(M + 440, 8);
    const double ang22a_32z = c12*beta[36];
    M[299] = ang22a_32z;
    MODELER_ZEROS(M + 450, 8);
    M[318] = -minus_lin_B2a_22x;
    M[319] = -minus_lin_B2a_22y;
    MODELER_ZEROS(M + 458, 1);
    M[323] = minus_Jc12_yz;
    M[324] = beta[32] + Js32_xx;
    M[325] = -beta[35];
    MODELER_ZEROS(M + 462, 8);
    M[349] = ang22a_32z;
    M[350] = -beta[35];
    MODELER_ZEROS(M + 470, 4);
    M[370] = lin_B3a_13x;
    M[371] = lin_B3a_13y;
    const double t83 = s15*(beta[42] + q[16]*beta[48]);
    MODELER_ZEROS(M + 476, 8);
    const double Js33_xx = q[16]*beta[50]*2.0;
    M[378] = c15*(c15*(beta[41] + Js33_xx) - t83) - c15*t83 + beta[38];
    MODELER_ZEROS(M + 484, 1);
    /* link 13: inertia of the link and all that it carries, Jc13 = J13 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc13_yz = c15*beta[43] - s15*(beta[44] + q[16]*beta[49]);
    M[379] = minus_Jc13_yz;
    MODELER_ZEROS(M + 488, 8);
    const double ang23a_33z = c15*beta[49];
    M[380] = ang23a_33z;
    M[396] = -minus_lin_B3a_23x;
    MODELER_ZEROS(M + 496, 8);
    M[397] = -minus_lin_B3a_23y;
    M[404] = minus_Jc13_yz;
    MODELER_ZEROS(M + 504, 7);
    M[405] = beta[45] + Js33_xx;
    M[406] = -beta[48];
    MODELER_ZEROS(M + 513, 8);
    M[430] = ang23a_33z;
    M[431] = -beta[48];
    M[448] = lin_B4a_14x;
    MODELER_ZEROS(M + 521, 5);
    M[449] = lin_B4a_14y;
    const double t87 = s18*(beta[55] + q[19]*beta[61]);
    MODELER_ZEROS(M + 528, 8);
    const double Js34_xx = q[19]*beta[63]*2.0;
    M[459] = c18*(c18*(beta[54] + Js34_xx) - t87) - c18*t87 + beta[51];
    /* link 14: inertia of the link and all that it carries, Jc14 = J14 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc14_yz = c18*beta[56] - s18*(beta[57] + q[19]*beta[62]);
    MODELER_ZEROS(M + 536, 4);
    M[460] = minus_Jc14_yz;
    const double ang24a_34z = c18*beta[62];
    MODELER_ZEROS(M + 543, 8);
    M[461] = ang24a_34z;
    M[474] = -minus_lin_B4a_24x;
    MODELER_ZEROS(M + 551, 1);
    M[475] = -minus_lin_B4a_24y;
    M[485] = minus_Jc14_yz;
    M[486] = beta[58] + Js34_xx;
    MODELER_ZEROS(M + 554, 8);
    M[487] = -beta[61];
    M[511] = ang24a_34z;
    MODELER_ZEROS(M + 562, 4);
    M[512] = -beta[61];
    M[526] = lin_B5a_15x;
    M[527] = lin_B5a_15y;
    MODELER_ZEROS(M + 569, 8);
    const double t91 = s21*(beta[68] + q[22]*beta[74]);
    const double Js35_xx = q[22]*beta[76]*2.0;
    MODELER_ZEROS(M + 577, 8);
    M[540] = c21*(c21*(beta[67] + Js35_xx) - t91) - c21*t91 + beta[64];
    /* link 15: inertia of the link and all that it carries, Jc15 = J15 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc15_yz = c21*beta[69] - s21*(beta[70] + q[22]*beta[75]);
    MODELER_ZEROS(M + 585, 7);
    M[541] = minus_Jc15_yz;
    const double ang25a_35z = c21*beta[75];
    M[542] = ang25a_35z;
    MODELER_ZEROS(M + 594, 8);
    M[552] = -minus_lin_B5a_25x;
    M[553] = -minus_lin_B5a_25y;
    MODELER_ZEROS(M + 602, 2);
    M[566] = minus_Jc15_yz;
    M[567] = beta[71] + Js35_xx;
    MODELER_ZEROS(M + 606, 8);
    M[568] = -beta[74];
    M[592] = ang25a_35z;
    M[593] = -beta[74];
    MODELER_ZEROS(M + 614, 7);
    M[604] = lin_B6a_16x;
    M[605] = lin_B6a_16y;
    MODELER_ZEROS(M + 624, 6);
    const double t95 = s24*(beta[81] + q[25]*beta[87]);
    const double Js36_xx = q[25]*beta[89]*2.0;
    M[621] = c24*(c24*(beta[80] + Js36_xx) - t95) - c24*t95 + beta[77];
    MODELER_ZEROS(M + 632, 8);
    /* link 16: inertia of the link and all that it carries, Jc16 = J16 + sum of R Jc R' + Js of
        what hangs on it */
    const double minus_Jc16_yz = c24*beta[82] - s24*(beta[83] + q[25]*beta[88]);
    M[622] = minus_Jc16_yz;
    MODELER_ZEROS(M + 640, 7);
    const double ang26a_36z = c24*beta[88];
    M[623] = ang26a_36z;
    MODELER_ZEROS(M + 650, 8);
    M[630] = -minus_lin_B6a_26x;
    M[631] = -minus_lin_B6a_26y;
    M[647] = minus_Jc16_yz;
    MODELER_ZEROS(M + 658, 8);
    M[648] = beta[84] + Js36_xx;
    M[649] = -beta[87];
    MODELER_ZEROS(M + 666, 7);
    M[673] = ang26a_36z;
    M[674] = -beta[87];
    MODELER_ZEROS(M + 675, 1);
}

/* Torques that hold the robot still, without friction.
 * 72 additions, 139 multiplications. */
void evra_tree_gravity(const double q[26], const double beta[90], double MODELER_OUT(tau, 26))
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[6] = 0.0;
    tau[7] = 0.0;
    tau[10] = 0.0;
    tau[13] = 0.0;
    tau[16] = 0.0;
    tau[19] = 0.0;
    tau[22] = 0.0;
    tau[25] = 0.0;

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    /* link Pa: acceleration of the origin less gravity, vd_Pa = R_Pa' (vd_Pz + U_Pz p_Pa) */
    const double vd_Pa_y = evra_geo_g*c3;
    /* link Pb: acceleration of the origin less gravity, vd_Pb = R_Pb' (vd_Pa + U_Pa p_Pb) */
    const double minus_vd_Pb_y = s4*vd_Pa_y;
    const double vd_Pa_x = evra_geo_g*s3;
    /* link P: acceleration of the origin less gravity, vd_P = R_P' (vd_Pb + U_Pb p_P) */
    const double minus_vd_P_x = c5*minus_vd_Pb_y - s5*vd_Pa_x;
    /* link P: force on the link, f_P = M_P vd_P + U_P MS_P */
    const double minus_f_P_x = beta[9]*minus_vd_P_x;
    const double vd_P_y = c5*vd_Pa_x + s5*minus_vd_Pb_y;
    const double f_P_y = beta[9]*vd_P_y;
    const double vd_Pb_x = c4*vd_Pa_y;
    tau[2] = c3*(beta[9]*vd_Pb_x*c4 + s4*(c5*minus_f_P_x + s5*f_P_y)) - s3*(s5*minus_f_P_x -
        c5*f_P_y);
    /* link P: moment on the link at its origin, n_P = J_P wd_P + w_P x J_P w_P + MS_P x vd_P */
    const double n_P_z = beta[6]*vd_P_y + beta[7]*minus_vd_P_x;
    const double n_P_x = beta[7]*vd_Pb_x - beta[8]*vd_P_y;
    const double minus_n_P_y = beta[8]*minus_vd_P_x + beta[6]*vd_Pb_x;
    tau[3] = s4*n_P_z + c4*(c5*n_P_x + s5*minus_n_P_y);
    tau[4] = s5*n_P_x - c5*minus_n_P_y;
    tau[5] = n_P_z;
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd_B1 + U_B1 p11) */
    const double minus_vd11_x = evra_geo_g*c8;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double vd21_y = c9*minus_vd11_x;
    const double vd11_y = evra_geo_g*s8;
    const double vd21_x = s9*minus_vd11_x;
    const double t16 = c9*(beta[23]*vd21_y - vd11_y*beta[24] + vd11_y*beta[21]);
    /* link 21: moment on the link and all that it carries, nc21 = n21 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc21a_z = t16 + s9*(vd11_y*beta[22] + beta[23]*vd21_x + vd11_y*beta[20]);
    tau[8] = vd11_y*beta[13] + minus_vd11_x*beta[14] - minus_nc21a_z;
    tau[9] = beta[24]*vd21_x + beta[22]*vd21_y + (beta[20]*vd21_y - beta[21]*vd21_x);
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd_B2 + U_B2 p12) */
    const double minus_vd12_x = evra_geo_g*c11;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22_y = c12*minus_vd12_x;
    const double vd12_y = evra_geo_g*s11;
    const double vd22_x = s12*minus_vd12_x;
    const double t22 = c12*(beta[36]*vd22_y - vd12_y*beta[37] + vd12_y*beta[34]);
    /* link 22: moment on the link and all that it carries, nc22 = n22 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc22a_z = t22 + s12*(vd12_y*beta[35] + beta[36]*vd22_x + vd12_y*beta[33]);
    tau[11] = vd12_y*beta[26] + minus_vd12_x*beta[27] - minus_nc22a_z;
    tau[12] = beta[37]*vd22_x + beta[35]*vd22_y + (beta[33]*vd22_y - beta[34]*vd22_x);
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd_B3 + U_B3 p13) */
    const double minus_vd13_x = evra_geo_g*c14;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double vd23_y = c15*minus_vd13_x;
    const double vd13_y = evra_geo_g*s14;
    const double vd23_x = s15*minus_vd13_x;
    const double t28 = c15*(beta[49]*vd23_y - vd13_y*beta[50] + vd13_y*beta[47]);
    /* link 23: moment on the link and all that it carries, nc23 = n23 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc23a_z = t28 + s15*(vd13_y*beta[48] + beta[49]*vd23_x + vd13_y*beta[46]);
    tau[14] = vd13_y*beta[39] + minus_vd13_x*beta[40] - minus_nc23a_z;
    tau[15] = beta[50]*vd23_x + beta[48]*vd23_y + (beta[46]*vd23_y - beta[47]*vd23_x);
    /* link 14: acceleration of the origin less gravity, vd14 = R14' (vd_B4 + U_B4 p14) */
    const double minus_vd14_x = evra_geo_g*c17;
    /* link 24: acceleration of the origin less gravity, vd24 = R24' (vd14 + U14 p24) */
    const double vd24_y = c18*minus_vd14_x;
    const double vd14_y = evra_geo_g*s17;
    const double vd24_x = s18*minus_vd14_x;
    const double t34 = c18*(beta[62]*vd24_y - vd14_y*beta[63] + vd14_y*beta[60]);
    /* link 24: moment on the link and all that it carries, nc24 = n24 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc24a_z = t34 + s18*(vd14_y*beta[61] + beta[62]*vd24_x + vd14_y*beta[59]);
    tau[17] = vd14_y*beta[52] + minus_vd14_x*beta[53] - minus_nc24a_z;
    tau[18] = beta[63]*vd24_x + beta[61]*vd24_y + (beta[59]*vd24_y - beta[60]*vd24_x);
    /* link 15: acceleration of the origin less gravity, vd15 = R15' (vd_B5 + U_B5 p15) */
    const double minus_vd15_x = evra_geo_g*c20;
    /* link 25: acceleration of the origin less gravity, vd25 = R25' (vd15 + U15 p25) */
    const double vd25_y = c21*minus_vd15_x;
    const double vd15_y = evra_geo_g*s20;
    const double vd25_x = s21*minus_vd15_x;
    const double t40 = c21*(beta[75]*vd25_y - vd15_y*beta[76] + vd15_y*beta[73]);
    /* link 25: moment on the link and all that it carries, nc25 = n25 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc25a_z = t40 + s21*(vd15_y*beta[74] + beta[75]*vd25_x + vd15_y*beta[72]);
    tau[20] = vd15_y*beta[65] + minus_vd15_x*beta[66] - minus_nc25a_z;
    tau[21] = beta[76]*vd25_x + beta[74]*vd25_y + (beta[72]*vd25_y - beta[73]*vd25_x);
    /* link 16: acceleration of the origin less gravity, vd16 = R16' (vd_B6 + U_B6 p16) */
    const double minus_vd16_x = evra_geo_g*c23;
    /* link 26: acceleration of the origin less gravity, vd26 = R26' (vd16 + U16 p26) */
    const double vd26_y = c24*minus_vd16_x;
    const double vd16_y = evra_geo_g*s23;
    const double vd26_x = s24*minus_vd16_x;
    const double t46 = c24*(beta[88]*vd26_y - vd16_y*beta[89] + vd16_y*beta[86]);
    /* link 26: moment on the link and all that it carries, nc26 = n26 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc26a_z = t46 + s24*(vd16_y*beta[87] + beta[88]*vd26_x + vd16_y*beta[85]);
    tau[23] = vd16_y*beta[78] + minus_vd16_x*beta[79] - minus_nc26a_z;
    tau[24] = beta[89]*vd26_x + beta[87]*vd26_y + (beta[85]*vd26_y - beta[86]*vd26_x);
}

/* Torques without gravity and friction.
 * 519 additions, 692 multiplications. */
void evra_tree_coriolis(const double q[26], const double qd[26], const double qdd[26],
                        const double beta[90], double MODELER_OUT(tau, 26))
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    /* link Pz: acceleration of the origin less gravity, vd_Pz = R_Pz' (vd_Py + U_Py p_Pz) + 2 w_Pz
        x qd_Pz z + qdd_Pz z */
    const double vd_Pz_z = qdd[2] + evra_geo_g;
    const double t2 = s3*qdd[1];
    /* link Pa: acceleration of the origin less gravity, vd_Pa = R_Pa' (vd_Pz + U_Pz p_Pa) */
    const double vd_Pa_y = c3*vd_Pz_z - t2;
    const double t4 = s4*qdd[0];
    /* link Pb: angular velocity, w_Pb = R_Pb' w_Pa + qd_Pb z */
    const double w_Pb_y = c4*qd[3];
    const double w_Pb_x = s4*qd[3];
    /* link Pb: angular acceleration, wd_Pb = R_Pb' wd_Pa + (R_Pb' w_Pa) x qd_Pb z + qdd_Pb z */
    const double wd_Pb_y = c4*qdd[3] - qd[4]*w_Pb_x;
    /* link P: angular velocity, w_P = R_P' w_Pb + qd_P z */
    const double w_P_x = c5*w_Pb_y + s5*qd[4];
    /* link P: angular acceleration, wd_P = R_P' wd_Pb + (R_P' w_Pb) x qd_P z + qdd_P z */
    const double wd_P_y = c5*qdd[4] - s5*wd_Pb_y - qd[5]*w_P_x;
    const double w_P_z = qd[5] + w_Pb_x;
    const double ww_P_xz = w_P_x*w_P_z;
    const double w_P_y = c5*qd[4] - s5*w_Pb_y;
    const double wd_P_x = c5*wd_Pb_y + s5*qdd[4] + qd[5]*w_P_y;
    const double ww_P_yz = w_P_y*w_P_z;
    const double t15 = (wd_P_y - ww_P_xz)*beta[6] - (wd_P_x + ww_P_yz)*beta[7] + (w_Pb_y*w_Pb_y +
        qd[4]*qd[4])*beta[8];
    /* link P: force on the link, f_P = M_P vd_P + U_P MS_P */
    const double f_P_z = (c4*vd_Pa_y + t4)*beta[9] - t15;
    const double t17 = c4*qdd[0];
    /* link Pb: acceleration of the origin less gravity, vd_Pb = R_Pb' (vd_Pa + U_Pa p_Pb) */
    const double vd_Pb_y = t17 - s4*vd_Pa_y;
    const double t19 = c3*qdd[1];
    const double vd_Pa_x = t19 + s3*vd_Pz_z;
    const double ww_P_zz = w_P_z*w_P_z;
    const double wd_P_z = s4*qdd[3] + qd[4]*w_Pb_y + qdd[5];
    const double ww_P_xy = w_P_x*w_P_y;
    const double t24 = (w_P_y*w_P_y + ww_P_zz)*beta[6] + (wd_P_z - ww_P_xy)*beta[7] - (wd_P_y +
        ww_P_xz)*beta[8];
    const double f_P_x = (c5*vd_Pb_y + s5*vd_Pa_x)*beta[9] - t24;
    const double t26 = (w_P_x*w_P_x + ww_P_zz)*beta[7] - (wd_P_z + ww_P_xy)*beta[6] + (wd_P_x -
        ww_P_yz)*beta[8];
    const double f_P_y = (c5*vd_Pa_x - s5*vd_Pb_y)*beta[9] - t26;
    /* link Pb: force on the link and all that it carries, fc_Pb = f_Pb + sum of R fc of what hangs
        on it */
    const double fc_Pb_y = c5*f_P_x - s5*f_P_y;
    tau[0] = s4*f_P_z + c4*fc_Pb_y;
    tau[1] = c3*(s5*f_P_x + c5*f_P_y) - s3*(c4*f_P_z - s4*fc_Pb_y);
    const double minus_vd_Pa_y = t2 - c3*qdd[2];
    const double vd_Pb_y_2 = t17 + s4*minus_vd_Pa_y;
    const double vd_Pa_x_2 = t19 + s3*qdd[2];
    /* link P: acceleration of the origin less gravity, vd_P = R_P' (vd_Pb + U_Pb p_P) */
    const double vd_P_x = c5*vd_Pb_y_2 + s5*vd_Pa_x_2;
    const double minus_f_P_x = t24 - beta[9]*vd_P_x;
    const double vd_P_y = c5*vd_Pa_x_2 - s5*vd_Pb_y_2;
    const double minus_f_P_y = t26 - beta[9]*vd_P_y;
    const double vd_Pb_x = t4 - c4*minus_vd_Pa_y;
    tau[2] = -(s3*(s5*minus_f_P_x + c5*minus_f_P_y) + c3*(c4*(t15 - beta[9]*vd_Pb_x) -
        s4*(c5*minus_f_P_x - s5*minus_f_P_y)));
    const double h_P_y = w_P_x*beta[1] + w_P_y*beta[3] + w_P_z*beta[4];
    const double h_P_x = w_P_x*beta[0] + w_P_y*beta[1] + w_P_z*beta[2];
    const double t39 = w_P_x*h_P_y - w_P_y*h_P_x + (wd_P_x*beta[2] + wd_P_y*beta[4] +
        wd_P_z*beta[5]);
    /* link P: moment on the link at its origin, n_P = J_P wd_P + w_P x J_P w_P + MS_P x vd_P */
    const double n_P_z = beta[6]*vd_P_y - beta[7]*vd_P_x + t39;
    const double h_P_z = w_P_x*beta[2] + w_P_y*beta[4] + w_P_z*beta[5];
    const double t42 = w_P_y*h_P_z - w_P_z*h_P_y + (wd_P_x*beta[0] + wd_P_y*beta[1] +
        wd_P_z*beta[2]);
    const double n_P_x = beta[7]*vd_Pb_x - beta[8]*vd_P_y + t42;
    const double t44 = w_P_z*h_P_x - w_P_x*h_P_z + (wd_P_x*beta[1] + wd_P_y*beta[3] +
        wd_P_z*beta[4]);
    const double n_P_y = beta[8]*vd_P_x - beta[6]*vd_Pb_x + t44;
    tau[3] = s4*n_P_z + c4*(c5*n_P_x - s5*n_P_y);
    tau[4] = s5*n_P_x + c5*n_P_y;
    tau[5] = n_P_z;
    /* link 26: angular velocity, w26 = R26' w16 + qd26 z */
    const double minus_w26_y = s24*qd[23];
    const double ww26_zz = qd[24]*qd[24];
    /* link 26: acceleration of points of the link, U26 = [wd26 x] + [w26 x][w26 x] */
    const double minus_U26_xx = minus_w26_y*minus_w26_y + ww26_zz;
    const double minus_U26_xz = s24*qdd[23];
    const double w26_x = c24*qd[23];
    const double minus_ww26_xy = w26_x*minus_w26_y;
    const double minus_U26_xy = qdd[24] + minus_ww26_xy;
    /* link 36: force on the link, f36 = M36 vd36 + U36 MS36 */
    const double minus_f36_x = minus_U26_xx*beta[87] + minus_U26_xz*beta[88] -
        minus_U26_xy*beta[89];
    /* link 26: force on the link and all that it carries, fc26 = f26 + sum of R fc of what hangs on
        it */
    const double minus_fc26_x = minus_U26_xx*beta[85] + minus_U26_xy*beta[86] + minus_f36_x;
    const double minus_U26_yy = w26_x*w26_x + ww26_zz;
    const double U26_yx = qdd[24] - minus_ww26_xy;
    const double minus_U26_yz = c24*qdd[23];
    const double minus_f36_z = U26_yx*beta[87] - minus_U26_yz*beta[88] + minus_U26_yy*beta[89];
    const double fc26_y = U26_yx*beta[85] - minus_U26_yy*beta[86] + minus_f36_z;
    const double ww16_zz = qd[23]*qd[23];
    const double ww26_xz = qd[24]*w26_x;
    /* link 26: angular acceleration, wd26 = R26' wd16 + (R26' w16) x qd26 z + qdd26 z */
    const double minus_wd26_y = minus_U26_xz + ww26_xz;
    const double U26_zx = ww26_xz + minus_wd26_y;
    const double minus_ww26_yz = qd[24]*minus_w26_y;
    const double wd26_x = minus_U26_yz - minus_ww26_yz;
    const double minus_U26_zy = minus_ww26_yz - wd26_x;
    const double minus_f36_y = ww16_zz*beta[88] - U26_zx*beta[87] - minus_U26_zy*beta[89];
    /* link 16: force on the link and all that it carries, fc16 = f16 + sum of R fc of what hangs on
        it */
    const double fc16_y = minus_U26_zy*beta[86] - U26_zx*beta[85] + minus_f36_y + (qdd[23]*beta[78]
        - ww16_zz*beta[79]);
    /* link B6: force on the link and all that it carries, fc_B6 = f_B6 + sum of R fc of what hangs
        on it */
    const double minus_fc_B6_x = s23*(s24*minus_fc26_x - c24*fc26_y - (ww16_zz*beta[78] +
        qdd[23]*beta[79])) + c23*fc16_y;
    const double minus_fc16_z = c24*minus_fc26_x + s24*fc26_y;
    /* link 25: angular velocity, w25 = R25' w15 + qd25 z */
    const double minus_w25_y = s21*qd[20];
    const double ww25_zz = qd[21]*qd[21];
    /* link 25: acceleration of points of the link, U25 = [wd25 x] + [w25 x][w25 x] */
    const double minus_U25_xx = minus_w25_y*minus_w25_y + ww25_zz;
    const double minus_U25_xz = s21*qdd[20];
    const double w25_x = c21*qd[20];
    const double minus_ww25_xy = w25_x*minus_w25_y;
    const double minus_U25_xy = qdd[21] + minus_ww25_xy;
    /* link 35: force on the link, f35 = M35 vd35 + U35 MS35 */
    const double minus_f35_x = minus_U25_xx*beta[74] + minus_U25_xz*beta[75] -
        minus_U25_xy*beta[76];
    /* link 25: force on the link and all that it carries, fc25 = f25 + sum of R fc of what hangs on
        it */
    const double minus_fc25_x = minus_U25_xx*beta[72] + minus_U25_xy*beta[73] + minus_f35_x;
    const double minus_U25_yy = w25_x*w25_x + ww25_zz;
    const double U25_yx = qdd[21] - minus_ww25_xy;
    const double minus_U25_yz = c21*qdd[20];
    const double minus_f35_z = U25_yx*beta[74] - minus_U25_yz*beta[75] + minus_U25_yy*beta[76];
    const double fc25_y = U25_yx*beta[72] - minus_U25_yy*beta[73] + minus_f35_z;
    const double ww15_zz = qd[20]*qd[20];
    const double ww25_xz = qd[21]*w25_x;
    /* link 25: angular acceleration, wd25 = R25' wd15 + (R25' w15) x qd25 z + qdd25 z */
    const double minus_wd25_y = minus_U25_xz + ww25_xz;
    const double U25_zx = ww25_xz + minus_wd25_y;
    const double minus_ww25_yz = qd[21]*minus_w25_y;
    const double wd25_x = minus_U25_yz - minus_ww25_yz;
    const double minus_U25_zy = minus_ww25_yz - wd25_x;
    const double minus_f35_y = ww15_zz*beta[75] - U25_zx*beta[74] - minus_U25_zy*beta[76];
    /* link 15: force on the link and all that it carries, fc15 = f15 + sum of R fc of what hangs on
        it */
    const double fc15_y = minus_U25_zy*beta[73] - U25_zx*beta[72] + minus_f35_y + (qdd[20]*beta[65]
        - ww15_zz*beta[66]);
    /* link B5: force on the link and all that it carries, fc_B5 = f_B5 + sum of R fc of what hangs
        on it */
    const double minus_fc_B5_x = s20*(s21*minus_fc25_x - c21*fc25_y - (ww15_zz*beta[65] +
        qdd[20]*beta[66])) + c20*fc15_y;
    const double minus_fc15_z = c21*minus_fc25_x + s21*fc25_y;
    /* link 24: angular velocity, w24 = R24' w14 + qd24 z */
    const double minus_w24_y = s18*qd[17];
    const double ww24_zz = qd[18]*qd[18];
    /* link 24: acceleration of points of the link, U24 = [wd24 x] + [w24 x][w24 x] */
    const double minus_U24_xx = minus_w24_y*minus_w24_y + ww24_zz;
    const double minus_U24_xz = s18*qdd[17];
    const double w24_x = c18*qd[17];
    const double minus_ww24_xy = w24_x*minus_w24_y;
    const double minus_U24_xy = qdd[18] + minus_ww24_xy;
    /* link 34: force on the link, f34 = M34 vd34 + U34 MS34 */
    const double minus_f34_x = minus_U24_xx*beta[61] + minus_U24_xz*beta[62] -
        minus_U24_xy*beta[63];
    /* link 24: force on the link and all that it carries, fc24 = f24 + sum of R fc of what hangs on
        it */
    const double minus_fc24_x = minus_U24_xx*beta[59] + minus_U24_xy*beta[60] + minus_f34_x;
    const double minus_U24_yy = w24_x*w24_x + ww24_zz;
    const double U24_yx = qdd[18] - minus_ww24_xy;
    const double minus_U24_yz = c18*qdd[17];
    const double minus_f34_z = U24_yx*beta[61] - minus_U24_yz*beta[62] + minus_U24_yy*beta[63];
    const double fc24_y = U24_yx*beta[59] - minus_U24_yy*beta[60] + minus_f34_z;
    const double ww14_zz = qd[17]*qd[17];
    const double ww24_xz = qd[18]*w24_x;
    /* link 24: angular acceleration, wd24 = R24' wd14 + (R24' w14) x qd24 z + qdd24 z */
    const double minus_wd24_y = minus_U24_xz + ww24_xz;
    const double U24_zx = ww24_xz + minus_wd24_y;
    const double minus_ww24_yz = qd[18]*minus_w24_y;
    const double wd24_x = minus_U24_yz - minus_ww24_yz;
    const double minus_U24_zy = minus_ww24_yz - wd24_x;
    const double minus_f34_y = ww14_zz*beta[62] - U24_zx*beta[61] - minus_U24_zy*beta[63];
    /* link 14: force on the link and all that it carries, fc14 = f14 + sum of R fc of what hangs on
        it */
    const double fc14_y = minus_U24_zy*beta[60] - U24_zx*beta[59] + minus_f34_y + (qdd[17]*beta[52]
        - ww14_zz*beta[53]);
    /* link B4: force on the link and all that it carries, fc_B4 = f_B4 + sum of R fc of what hangs
        on it */
    const double minus_fc_B4_x = s17*(s18*minus_fc24_x - c18*fc24_y - (ww14_zz*beta[52] +
        qdd[17]*beta[53])) + c17*fc14_y;
    const double minus_fc14_z = c18*minus_fc24_x + s18*fc24_y;
    /* link 23: angular velocity, w23 = R23' w13 + qd23 z */
    const double minus_w23_y = s15*qd[14];
    const double ww23_zz = qd[15]*qd[15];
    /* link 23: acceleration of points of the link, U23 = [wd23 x] + [w23 x][w23 x] */
    const double minus_U23_xx = minus_w23_y*minus_w23_y + ww23_zz;
    const double minus_U23_xz = s15*qdd[14];
    const double w23_x = c15*qd[14];
    const double minus_ww23_xy = w23_x*minus_w23_y;
    const double minus_U23_xy = qdd[15] + minus_ww23_xy;
    /* link 33: force on the link, f33 = M33 vd33 + U33 MS33 */
    const double minus_f33_x = minus_U23_xx*beta[48] + minus_U23_xz*beta[49] -
        minus_U23_xy*beta[50];
    /* link 23: force on the link and all that it carries, fc23 = f23 + sum of R fc of what hangs on
        it */
    const double minus_fc23_x = minus_U23_xx*beta[46] + minus_U23_xy*beta[47] + minus_f33_x;
    const double minus_U23_yy = w23_x*w23_x + ww23_zz;
    const double U23_yx = qdd[15] - minus_ww23_xy;
    const double minus_U23_yz = c15*qdd[14];
    const double minus_f33_z = U23_yx*beta[48] - minus_U23_yz*beta[49] + minus_U23_yy*beta[50];
    const double fc23_y = U23_yx*beta[46] - minus_U23_yy*beta[47] + minus_f33_z;
    const double ww13_zz = qd[14]*qd[14];
    const double ww23_xz = qd[15]*w23_x;
    /* link 23: angular acceleration, wd23 = R23' wd13 + (R23' w13) x qd23 z + qdd23 z */
    const double minus_wd23_y = minus_U23_xz + ww23_xz;
    const double U23_zx = ww23_xz + minus_wd23_y;
    const double minus_ww23_yz = qd[15]*minus_w23_y;
    const double wd23_x = minus_U23_yz - minus_ww23_yz;
    const double minus_U23_zy = minus_ww23_yz - wd23_x;
    const double minus_f33_y = ww13_zz*beta[49] - U23_zx*beta[48] - minus_U23_zy*beta[50];
    /* link 13: force on the link and all that it carries, fc13 = f13 + sum of R fc of what hangs on
        it */
    const double fc13_y = minus_U23_zy*beta[47] - U23_zx*beta[46] + minus_f33_y + (qdd[14]*beta[39]
        - ww13_zz*beta[40]);
    /* link B3: force on the link and all that it carries, fc_B3 = f_B3 + sum of R fc of what hangs
        on it */
    const double minus_fc_B3_x = s14*(s15*minus_fc23_x - c15*fc23_y - (ww13_zz*beta[39] +
        qdd[14]*beta[40])) + c14*fc13_y;
    const double minus_fc13_z = c15*minus_fc23_x + s15*fc23_y;
    const double t146 = x_B6_x*minus_fc_B6_x - x_B6_y*minus_fc16_z + (x_B5_x*minus_fc_B5_x -
        x_B5_y*minus_fc15_z) + (x_B4_x*minus_fc_B4_x - x_B4_y*minus_fc14_z);
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double minus_w22_y = s12*qd[11];
    const double ww22_zz = qd[12]*qd[12];
    /* link 22: acceleration of points of the link, U22 = [wd22 x] + [w22 x][w22 x] */
    const double minus_U22_xx = minus_w22_y*minus_w22_y + ww22_zz;
    const double minus_U22_xz = s12*qdd[11];
    const double w22_x = c12*qd[11];
    const double minus_ww22_xy = w22_x*minus_w22_y;
    const double minus_U22_xy = qdd[12] + minus_ww22_xy;
    /* link 32: force on the link, f32 = M32 vd32 + U32 MS32 */
    const double minus_f32_x = minus_U22_xx*beta[35] + minus_U22_xz*beta[36] -
        minus_U22_xy*beta[37];
    /* link 22: force on the link and all that it carries, fc22 = f22 + sum of R fc of what hangs on
        it */
    const double minus_fc22_x = minus_U22_xx*beta[33] + minus_U22_xy*beta[34] + minus_f32_x;
    const double minus_U22_yy = w22_x*w22_x + ww22_zz;
    const double U22_yx = qdd[12] - minus_ww22_xy;
    const double minus_U22_yz = c12*qdd[11];
    const double minus_f32_z = U22_yx*beta[35] - minus_U22_yz*beta[36] + minus_U22_yy*beta[37];
    const double fc22_y = U22_yx*beta[33] - minus_U22_yy*beta[34] + minus_f32_z;
    const double ww12_zz = qd[11]*qd[11];
    const double ww22_xz = qd[12]*w22_x;
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double minus_wd22_y = minus_U22_xz + ww22_xz;
    const double U22_zx = ww22_xz + minus_wd22_y;
    const double minus_ww22_yz = qd[12]*minus_w22_y;
    const double wd22_x = minus_U22_yz - minus_ww22_yz;
    const double minus_U22_zy = minus_ww22_yz - wd22_x;
    const double minus_f32_y = ww12_zz*beta[36] - U22_zx*beta[35] - minus_U22_zy*beta[37];
    /* link 12: force on the link and all that it carries, fc12 = f12 + sum of R fc of what hangs on
        it */
    const double fc12_y = minus_U22_zy*beta[34] - U22_zx*beta[33] + minus_f32_y + (qdd[11]*beta[26]
        - ww12_zz*beta[27]);
    /* link B2: force on the link and all that it carries, fc_B2 = f_B2 + sum of R fc of what hangs
        on it */
    const double minus_fc_B2_x = s11*(s12*minus_fc22_x - c12*fc22_y - (ww12_zz*beta[26] +
        qdd[11]*beta[27])) + c11*fc12_y;
    const double minus_fc12_z = c12*minus_fc22_x + s12*fc22_y;
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double minus_w21_y = s9*qd[8];
    const double ww21_zz = qd[9]*qd[9];
    /* link 21: acceleration of points of the link, U21 = [wd21 x] + [w21 x][w21 x] */
    const double minus_U21_xx = minus_w21_y*minus_w21_y + ww21_zz;
    const double minus_U21_xz = s9*qdd[8];
    const double w21_x = c9*qd[8];
    const double minus_ww21_xy = w21_x*minus_w21_y;
    const double minus_U21_xy = qdd[9] + minus_ww21_xy;
    /* link 31: force on the link, f31 = M31 vd31 + U31 MS31 */
    const double minus_f31_x = minus_U21_xx*beta[22] + minus_U21_xz*beta[23] -
        minus_U21_xy*beta[24];
    /* link 21: force on the link and all that it carries, fc21 = f21 + sum of R fc of what hangs on
        it */
    const double minus_fc21_x = minus_U21_xx*beta[20] + minus_U21_xy*beta[21] + minus_f31_x;
    const double minus_U21_yy = w21_x*w21_x + ww21_zz;
    const double U21_yx = qdd[9] - minus_ww21_xy;
    const double minus_U21_yz = c9*qdd[8];
    const double minus_f31_z = U21_yx*beta[22] - minus_U21_yz*beta[23] + minus_U21_yy*beta[24];
    const double fc21_y = U21_yx*beta[20] - minus_U21_yy*beta[21] + minus_f31_z;
    const double ww11_zz = qd[8]*qd[8];
    const double ww21_xz = qd[9]*w21_x;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double minus_wd21_y = minus_U21_xz + ww21_xz;
    const double U21_zx = ww21_xz + minus_wd21_y;
    const double minus_ww21_yz = qd[9]*minus_w21_y;
    const double wd21_x = minus_U21_yz - minus_ww21_yz;
    const double minus_U21_zy = minus_ww21_yz - wd21_x;
    const double minus_f31_y = ww11_zz*beta[23] - U21_zx*beta[22] - minus_U21_zy*beta[24];
    /* link 11: force on the link and all that it carries, fc11 = f11 + sum of R fc of what hangs on
        it */
    const double fc11_y = minus_U21_zy*beta[21] - U21_zx*beta[20] + minus_f31_y + (qdd[8]*beta[13] -
        ww11_zz*beta[14]);
    /* link B1: force on the link and all that it carries, fc_B1 = f_B1 + sum of R fc of what hangs
        on it */
    const double minus_fc_B1_x = s8*(s9*minus_fc21_x - c9*fc21_y - (ww11_zz*beta[13] +
        qdd[8]*beta[14])) + c8*fc11_y;
    const double minus_fc11_z = c9*minus_fc21_x + s9*fc21_y;
    /* link B: force on the link and all that it carries, fc_B = f_B + sum of R fc of what hangs on
        it */
    const double minus_fc_B_x = x_B3_x*minus_fc_B3_x - x_B3_y*minus_fc13_z + t146 +
        (x_B2_x*minus_fc_B2_x - x_B2_y*minus_fc12_z) + (x_B1_x*minus_fc_B1_x - x_B1_y*minus_fc11_z);
    tau[6] = qdd[6]*beta[10] - (minus_fc_B_x - qdd[6]*beta[11]);
    const double t198 = x_B6_y*minus_fc_B6_x + x_B6_x*minus_fc16_z + (x_B5_y*minus_fc_B5_x +
        x_B5_x*minus_fc15_z) + (x_B4_y*minus_fc_B4_x + x_B4_x*minus_fc14_z);
    const double minus_fc_B_y = x_B3_y*minus_fc_B3_x + x_B3_x*minus_fc13_z + t198 +
        (x_B2_y*minus_fc_B2_x + x_B2_x*minus_fc12_z) + (x_B1_y*minus_fc_B1_x + x_B1_x*minus_fc11_z);
    tau[7] = qdd[7]*beta[11] - minus_fc_B_y;
    /* link B1: acceleration of the origin less gravity, vd_B1 = R_B1' (vd_B + U_B p_B1) */
    const double vd_B1_y = x_B1_x*qdd[7] - x_B1_y*qdd[6];
    const double vd_B1_x = x_B1_x*qdd[6] + x_B1_y*qdd[7];
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd_B1 + U_B1 p11) */
    const double minus_vd11_x = s8*vd_B1_x;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = s9*vd_B1_y - c9*minus_vd11_x;
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) + 2 w31 x qd31
        z + qdd31 z */
    const double vd31_z = minus_vd21_y - q[10]*minus_U21_yy + qdd[10];
    const double minus_vd11_y = c8*vd_B1_x;
    const double minus_vd31_y = qd[10]*w21_x*2.0 - (minus_vd11_y + q[10]*minus_U21_zy);
    const double h21_z = w21_x*beta[17] - minus_w21_y*beta[18] + qd[9]*beta[19];
    const double h21_y = w21_x*beta[16] + qd[9]*beta[18];
    const double t209 = minus_w21_y*h21_z + qd[9]*h21_y - (wd21_x*beta[15] - minus_wd21_y*beta[16] +
        qdd[9]*beta[17]);
    const double vd21_x = c9*vd_B1_y + s9*minus_vd11_x;
    const double vd31_x = q[10]*minus_U21_xy + vd21_x + qd[9]*qd[10]*2.0;
    const double h21_x = w21_x*beta[15] - minus_w21_y*beta[16] + qd[9]*beta[17];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_y = qd[9]*h21_x - w21_x*h21_z + (wd21_x*beta[16] + qdd[9]*beta[18]) -
        minus_vd11_y*beta[20];
    const double t214 = c9*(beta[23]*vd31_z + beta[24]*minus_vd31_y + q[10]*minus_f31_y +
        (minus_vd11_y*beta[21] - t209));
    /* link 21: moment on the link and all that it carries, nc21 = n21 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc21a_z = t214 - s9*(beta[22]*minus_vd31_y + beta[23]*vd31_x + n21_y);
    tau[8] = minus_vd11_x*beta[14] - minus_vd11_y*beta[13] + qdd[8]*beta[12] + nc21a_z;
    const double t216 = w21_x*h21_y + minus_w21_y*h21_x + (wd21_x*beta[17] - minus_wd21_y*beta[18] +
        qdd[9]*beta[19]);
    /* link 31: moment on the link and all that it carries, nc31 = n31 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc31a_z = beta[22]*vd31_z - beta[24]*vd31_x + q[10]*minus_f31_x;
    tau[9] = t216 - (beta[20]*minus_vd21_y + beta[21]*vd21_x) - minus_nc31a_z;
    tau[10] = -minus_f31_z;
    /* link B2: acceleration of the origin less gravity, vd_B2 = R_B2' (vd_B + U_B p_B2) */
    const double vd_B2_y = x_B2_x*qdd[7] - x_B2_y*qdd[6];
    const double vd_B2_x = x_B2_x*qdd[6] + x_B2_y*qdd[7];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd_B2 + U_B2 p12) */
    const double minus_vd12_x = s11*vd_B2_x;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = s12*vd_B2_y - c12*minus_vd12_x;
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) + 2 w32 x qd32
        z + qdd32 z */
    const double vd32_z = minus_vd22_y - q[13]*minus_U22_yy + qdd[13];
    const double minus_vd12_y = c11*vd_B2_x;
    const double minus_vd32_y = qd[13]*w22_x*2.0 - (minus_vd12_y + q[13]*minus_U22_zy);
    const double h22_z = w22_x*beta[30] - minus_w22_y*beta[31] + qd[12]*beta[32];
    const double h22_y = w22_x*beta[29] + qd[12]*beta[31];
    const double t227 = wd22_x*beta[28] - minus_wd22_y*beta[29] + qdd[12]*beta[30];
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double minus_n22_x = minus_w22_y*h22_z + qd[12]*h22_y - t227 - minus_vd12_y*beta[34];
    const double vd22_x = c12*vd_B2_y + s12*minus_vd12_x;
    const double vd32_x = q[13]*minus_U22_xy + vd22_x + qd[12]*qd[13]*2.0;
    const double h22_x = w22_x*beta[28] - minus_w22_y*beta[29] + qd[12]*beta[30];
    const double t232 = qd[12]*h22_x - w22_x*h22_z + (wd22_x*beta[29] + qdd[12]*beta[31]);
    const double t233 = s12*(beta[35]*minus_vd32_y + beta[36]*vd32_x + (t232 -
        minus_vd12_y*beta[33]));
    /* link 22: moment on the link and all that it carries, nc22 = n22 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc22a_z = c12*(beta[36]*vd32_z + beta[37]*minus_vd32_y + q[13]*minus_f32_y -
        minus_n22_x) - t233;
    tau[11] = minus_vd12_x*beta[27] - minus_vd12_y*beta[26] + qdd[11]*beta[25] + nc22a_z;
    const double t235 = w22_x*h22_y + minus_w22_y*h22_x + (wd22_x*beta[30] - minus_wd22_y*beta[31] +
        qdd[12]*beta[32]);
    /* link 32: moment on the link and all that it carries, nc32 = n32 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc32a_z = beta[35]*vd32_z - beta[37]*vd32_x + q[13]*minus_f32_x;
    tau[12] = t235 - (beta[33]*minus_vd22_y + beta[34]*vd22_x) - minus_nc32a_z;
    tau[13] = -minus_f32_z;
    /* link B3: acceleration of the origin less gravity, vd_B3 = R_B3' (vd_B + U_B p_B3) */
    const double vd_B3_y = x_B3_x*qdd[7] - x_B3_y*qdd[6];
    const double vd_B3_x = x_B3_x*qdd[6] + x_B3_y*qdd[7];
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd_B3 + U_B3 p13) */
    const double minus_vd13_x = s14*vd_B3_x;
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = s15*vd_B3_y - c15*minus_vd13_x;
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) + 2 w33 x qd33
        z + qdd33 z */
    const double vd33_z = minus_vd23_y - q[16]*minus_U23_yy + qdd[16];
    const double minus_vd13_y = c14*vd_B3_x;
    const double minus_vd33_y = qd[16]*w23_x*2.0 - (minus_vd13_y + q[16]*minus_U23_zy);
    const double h23_z = w23_x*beta[43] - minus_w23_y*beta[44] + qd[15]*beta[45];
    const double h23_y = w23_x*beta[42] + qd[15]*beta[44];
    const double t246 = wd23_x*beta[41] - minus_wd23_y*beta[42] + qdd[15]*beta[43];
    /* link 23: moment on the link at its origin, n23 = J23 wd23 + w23 x J23 w23 + MS23 x vd23 */
    const double minus_n23_x = minus_w23_y*h23_z + qd[15]*h23_y - t246 - minus_vd13_y*beta[47];
    const double vd23_x = c15*vd_B3_y + s15*minus_vd13_x;
    const double vd33_x = q[16]*minus_U23_xy + vd23_x + qd[15]*qd[16]*2.0;
    const double h23_x = w23_x*beta[41] - minus_w23_y*beta[42] + qd[15]*beta[43];
    const double t251 = qd[15]*h23_x - w23_x*h23_z + (wd23_x*beta[42] + qdd[15]*beta[44]);
    const double t252 = s15*(beta[48]*minus_vd33_y + beta[49]*vd33_x + (t251 -
        minus_vd13_y*beta[46]));
    /* link 23: moment on the link and all that it carries, nc23 = n23 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc23a_z = c15*(beta[49]*vd33_z + beta[50]*minus_vd33_y + q[16]*minus_f33_y -
        minus_n23_x) - t252;
    tau[14] = minus_vd13_x*beta[40] - minus_vd13_y*beta[39] + qdd[14]*beta[38] + nc23a_z;
    const double t254 = w23_x*h23_y + minus_w23_y*h23_x + (wd23_x*beta[43] - minus_wd23_y*beta[44] +
        qdd[15]*beta[45]);
    /* link 33: moment on the link and all that it carries, nc33 = n33 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc33a_z = beta[48]*vd33_z - beta[50]*vd33_x + q[16]*minus_f33_x;
    tau[15] = t254 - (beta[46]*minus_vd23_y + beta[47]*vd23_x) - minus_nc33a_z;
    tau[16] = -minus_f33_z;
    /* link B4: acceleration of the origin less gravity, vd_B4 = R_B4' (vd_B + U_B p_B4) */
    const double vd_B4_y = x_B4_x*qdd[7] - x_B4_y*qdd[6];
    const double vd_B4_x = x_B4_x*qdd[6] + x_B4_y*qdd[7];
    /* link 14: acceleration of the origin less gravity, vd14 = R14' (vd_B4 + U_B4 p14) */
    const double minus_vd14_x = s17*vd_B4_x;
    /* link 24: acceleration of the origin less gravity, vd24 = R24' (vd14 + U14 p24) */
    const double minus_vd24_y = s18*vd_B4_y - c18*minus_vd14_x;
    /* link 34: acceleration of the origin less gravity, vd34 = R34' (vd24 + U24 p34) + 2 w34 x qd34
        z + qdd34 z */
    const double vd34_z = minus_vd24_y - q[19]*minus_U24_yy + qdd[19];
    const double minus_vd14_y = c17*vd_B4_x;
    const double minus_vd34_y = qd[19]*w24_x*2.0 - (minus_vd14_y + q[19]*minus_U24_zy);
    const double h24_z = w24_x*beta[56] - minus_w24_y*beta[57] + qd[18]*beta[58];
    const double h24_y = w24_x*beta[55] + qd[18]*beta[57];
    const double t265 = wd24_x*beta[54] - minus_wd24_y*beta[55] + qdd[18]*beta[56];
    /* link 24: moment on the link at its origin, n24 = J24 wd24 + w24 x J24 w24 + MS24 x vd24 */
    const double minus_n24_x = minus_w24_y*h24_z + qd[18]*h24_y - t265 - minus_vd14_y*beta[60];
    const double vd24_x = c18*vd_B4_y + s18*minus_vd14_x;
    const double vd34_x = q[19]*minus_U24_xy + vd24_x + qd[18]*qd[19]*2.0;
    const double h24_x = w24_x*beta[54] - minus_w24_y*beta[55] + qd[18]*beta[56];
    const double t270 = qd[18]*h24_x - w24_x*h24_z + (wd24_x*beta[55] + qdd[18]*beta[57]);
    const double t271 = s18*(beta[61]*minus_vd34_y + beta[62]*vd34_x + (t270 -
        minus_vd14_y*beta[59]));
    /* link 24: moment on the link and all that it carries, nc24 = n24 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc24a_z = c18*(beta[62]*vd34_z + beta[63]*minus_vd34_y + q[19]*minus_f34_y -
        minus_n24_x) - t271;
    tau[17] = minus_vd14_x*beta[53] - minus_vd14_y*beta[52] + qdd[17]*beta[51] + nc24a_z;
    const double t273 = w24_x*h24_y + minus_w24_y*h24_x + (wd24_x*beta[56] - minus_wd24_y*beta[57] +
        qdd[18]*beta[58]);
    /* link 34: moment on the link and all that it carries, nc34 = n34 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc34a_z = beta[61]*vd34_z - beta[63]*vd34_x + q[19]*minus_f34_x;
    tau[18] = t273 - (beta[59]*minus_vd24_y + beta[60]*vd24_x) - minus_nc34a_z;
    tau[19] = -minus_f34_z;
    /* link B5: acceleration of the origin less gravity, vd_B5 = R_B5' (vd_B + U_B p_B5) */
    const double vd_B5_y = x_B5_x*qdd[7] - x_B5_y*qdd[6];
    const double vd_B5_x = x_B5_x*qdd[6] + x_B5_y*qdd[7];
    /* link 15: acceleration of the origin less gravity, vd15 = R15' (vd_B5 + U_B5 p15) */
    const double minus_vd15_x = s20*vd_B5_x;
    /* link 25: acceleration of the origin less gravity, vd25 = R25' (vd15 + U15 p25) */
    const double minus_vd25_y = s21*vd_B5_y - c21*minus_vd15_x;
    /* link 35: acceleration of the origin less gravity, vd35 = R35' (vd25 + U25 p35) + 2 w35 x qd35
        z + qdd35 z */
    const double vd35_z = minus_vd25_y - q[22]*minus_U25_yy + qdd[22];
    const double minus_vd15_y = c20*vd_B5_x;
    const double minus_vd35_y = qd[22]*w25_x*2.0 - (minus_vd15_y + q[22]*minus_U25_zy);
    const double h25_z = w25_x*beta[69] - minus_w25_y*beta[70] + qd[21]*beta[71];
    const double h25_y = w25_x*beta[68] + qd[21]*beta[70];
    const double t284 = minus_w25_y*h25_z + qd[21]*h25_y - (wd25_x*beta[67] - minus_wd25_y*beta[68]
        + qdd[21]*beta[69]);
    const double vd25_x = c21*vd_B5_y + s21*minus_vd15_x;
    const double vd35_x = q[22]*minus_U25_xy + vd25_x + qd[21]*qd[22]*2.0;
    const double h25_x = w25_x*beta[67] - minus_w25_y*beta[68] + qd[21]*beta[69];
    /* link 25: moment on the link at its origin, n25 = J25 wd25 + w25 x J25 w25 + MS25 x vd25 */
    const double n25_y = qd[21]*h25_x - w25_x*h25_z + (wd25_x*beta[68] + qdd[21]*beta[70]) -
        minus_vd15_y*beta[72];
    const double t289 = c21*(beta[75]*vd35_z + beta[76]*minus_vd35_y + q[22]*minus_f35_y +
        (minus_vd15_y*beta[73] - t284));
    /* link 25: moment on the link and all that it carries, nc25 = n25 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc25a_z = t289 - s21*(beta[74]*minus_vd35_y + beta[75]*vd35_x + n25_y);
    tau[20] = minus_vd15_x*beta[66] - minus_vd15_y*beta[65] + qdd[20]*beta[64] + nc25a_z;
    const double t291 = w25_x*h25_y + minus_w25_y*h25_x + (wd25_x*beta[69] - minus_wd25_y*beta[70] +
        qdd[21]*beta[71]);
    /* link 35: moment on the link and all that it carries, nc35 = n35 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc35a_z = beta[74]*vd35_z - beta[76]*vd35_x + q[22]*minus_f35_x;
    tau[21] = t291 - (beta[72]*minus_vd25_y + beta[73]*vd25_x) - minus_nc35a_z;
    tau[22] = -minus_f35_z;
    /* link B6: acceleration of the origin less gravity, vd_B6 = R_B6' (vd_B + U_B p_B6) */
    const double vd_B6_y = x_B6_x*qdd[7] - x_B6_y*qdd[6];
    const double vd_B6_x = x_B6_x*qdd[6] + x_B6_y*qdd[7];
    /* link 16: acceleration of the origin less gravity, vd16 = R16' (vd_B6 + U_B6 p16) */
    const double minus_vd16_x = s23*vd_B6_x;
    /* link 26: acceleration of the origin less gravity, vd26 = R26' (vd16 + U16 p26) */
    const double minus_vd26_y = s24*vd_B6_y - c24*minus_vd16_x;
    /* link 36: acceleration of the origin less gravity, vd36 = R36' (vd26 + U26 p36) + 2 w36 x qd36
        z + qdd36 z */
    const double vd36_z = minus_vd26_y - q[25]*minus_U26_yy + qdd[25];
    const double minus_vd16_y = c23*vd_B6_x;
    const double minus_vd36_y = qd[25]*w26_x*2.0 - (minus_vd16_y + q[25]*minus_U26_zy);
    const double h26_z = w26_x*beta[82] - minus_w26_y*beta[83] + qd[24]*beta[84];
    const double h26_y = w26_x*beta[81] + qd[24]*beta[83];
    const double t302 = minus_w26_y*h26_z + qd[24]*h26_y - (wd26_x*beta[80] - minus_wd26_y*beta[81]
        + qdd[24]*beta[82]);
    const double vd26_x = c24*vd_B6_y + s24*minus_vd16_x;
    const double vd36_x = q[25]*minus_U26_xy + vd26_x + qd[24]*qd[25]*2.0;
    const double h26_x = w26_x*beta[80] - minus_w26_y*beta[81] + qd[24]*beta[82];
    /* link 26: moment on the link at its origin, n26 = J26 wd26 + w26 x J26 w26 + MS26 x vd26 */
    const double n26_y = qd[24]*h26_x - w26_x*h26_z + (wd26_x*beta[81] + qdd[24]*beta[83]) -
        minus_vd16_y*beta[85];
    const double t307 = c24*(beta[88]*vd36_z + beta[89]*minus_vd36_y + q[25]*minus_f36_y +
        (minus_vd16_y*beta[86] - t302));
    /* link 26: moment on the link and all that it carries, nc26 = n26 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc26a_z = t307 - s24*(beta[87]*minus_vd36_y + beta[88]*vd36_x + n26_y);
    tau[23] = minus_vd16_x*beta[79] - minus_vd16_y*beta[78] + qdd[23]*beta[77] + nc26a_z;
    const double t309 = w26_x*h26_y + minus_w26_y*h26_x + (wd26_x*beta[82] - minus_wd26_y*beta[83] +
        qdd[24]*beta[84]);
    /* link 36: moment on the link and all that it carries, nc36 = n36 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc36a_z = beta[87]*vd36_z - beta[89]*vd36_x + q[25]*minus_f36_x;
    tau[24] = t309 - (beta[85]*minus_vd26_y + beta[86]*vd26_x) - minus_nc36a_z;
    tau[25] = -minus_f36_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void evra_tree_friction(const double qd[26], const double beta[90], double MODELER_OUT(tau, 26))
{
    (void)qd;
    (void)beta;
    MODELER_ALL_ZEROS(tau, 26);

    MODELER_ZEROS(tau + 0, 8);
    MODELER_ZEROS(tau + 8, 8);
    MODELER_ZEROS(tau + 16, 8);
    MODELER_ZEROS(tau + 24, 2);
}

/* Poses of the frames of all moving rows of the table, in order.
 * 52 additions, 116 multiplications. */
void evra_tree_forward_kinematics(const double q[26], double MODELER_OUT(T, 26 * 3 * 4))
{
    MODELER_ALL_ZEROS(T, 312);

    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p_B1_x = x_B1_x*evra_geo_RB;
    const double p_B1_y = x_B1_y*evra_geo_RB;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p_B2_x = evra_geo_RB*x_B2_x;
    const double p_B2_y = evra_geo_RB*x_B2_y;
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p_B3_x = evra_geo_RB*x_B3_x;
    const double p_B3_y = evra_geo_RB*x_B3_y;
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p_B4_x = evra_geo_RB*x_B4_x;
    const double p_B4_y = evra_geo_RB*x_B4_y;
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p_B5_x = evra_geo_RB*x_B5_x;
    const double p_B5_y = evra_geo_RB*x_B5_y;
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p_B6_x = evra_geo_RB*x_B6_x;
    const double p_B6_y = evra_geo_RB*x_B6_y;

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    T[2] = 1.0;
    T[3] = q[0];
    T[4] = 1.0;
    T[9] = 1.0;
    T[13] = 1.0;
    T[15] = q[0];
    T[18] = 1.0;
    T[19] = q[1];
    T[20] = 1.0;
    T[24] = 1.0;
    T[27] = q[0];
    MODELER_ZEROS(T + 0, 2);
    T[29] = 1.0;
    T[31] = q[1];
    T[34] = 1.0;
    T[35] = q[2];
    T[38] = 1.0;
    T[39] = q[0];
    T[40] = c3;
    T[41] = -s3;
    T[43] = q[1];
    T[44] = s3;
    MODELER_ZEROS(T + 5, 4);
    T[45] = c3;
    T[47] = q[2];
    T[48] = s4;
    T[49] = c4;
    T[51] = q[0];
    const double minus_x_Pb_y = s3*c4;
    T[52] = -minus_x_Pb_y;
    const double y_Pb_y = s3*s4;
    T[53] = y_Pb_y;
    T[54] = c3;
    MODELER_ZEROS(T + 10, 3);
    T[55] = q[1];
    const double x_Pb_z = c3*c4;
    T[56] = x_Pb_z;
    const double minus_y_Pb_z = c3*s4;
    T[57] = -minus_y_Pb_z;
    T[58] = s3;
    T[59] = q[2];
    T[60] = c4*c5;
    T[61] = -c4*s5;
    T[62] = s4;
    T[63] = q[0];
    MODELER_ZEROS(T + 14, 1);
    T[64] = c5*y_Pb_y + c3*s5;
    T[65] = c3*c5 - s5*y_Pb_y;
    T[66] = -minus_x_Pb_y;
    T[67] = q[1];
    T[68] = s3*s5 - c5*minus_y_Pb_z;
    T[69] = s3*c5 + s5*minus_y_Pb_z;
    T[70] = x_Pb_z;
    T[71] = q[2];
    T[74] = 1.0;
    T[75] = q[6];
    MODELER_ZEROS(T + 16, 2);
    T[76] = 1.0;
    T[81] = 1.0;
    T[85] = 1.0;
    T[87] = q[6];
    T[90] = 1.0;
    T[91] = q[7];
    T[92] = 1.0;
    const double minus_x11_x = x_B1_x*s8;
    T[96] = -minus_x11_x;
    const double minus_y11_x = x_B1_x*c8;
    MODELER_ZEROS(T + 21, 3);
    T[97] = -minus_y11_x;
    T[98] = -x_B1_y;
    /* link B1: origin of the frame in frame 0, o_B1 = o_B + [x_B y_B z_B] p_B1 */
    const double o_B1_x = q[6] + p_B1_x;
    T[99] = o_B1_x;
    const double minus_x11_y = x_B1_y*s8;
    T[100] = -minus_x11_y;
    const double minus_y11_y = x_B1_y*c8;
    T[101] = -minus_y11_y;
    T[102] = x_B1_x;
    const double o_B1_y = q[7] + p_B1_y;
    MODELER_ZEROS(T + 25, 2);
    T[103] = o_B1_y;
    T[104] = -c8;
    T[105] = s8;
    const double x21_x = s9*minus_x11_x - x_B1_y*c9;
    T[108] = x21_x;
    const double y21_x = x_B1_y*s9 + c9*minus_x11_x;
    T[109] = y21_x;
    T[110] = minus_y11_x;
    T[111] = o_B1_x;
    const double x21_y = s9*minus_x11_y + x_B1_x*c9;
    T[112] = x21_y;
    MODELER_ZEROS(T + 28, 1);
    const double minus_y21_y = x_B1_x*s9 - c9*minus_x11_y;
    T[113] = -minus_y21_y;
    T[114] = minus_y11_y;
    T[115] = o_B1_y;
    const double x21_z = c8*s9;
    T[116] = x21_z;
    const double y21_z = c8*c9;
    T[117] = y21_z;
    T[118] = -s8;
    T[120] = x21_x;
    MODELER_ZEROS(T + 30, 1);
    T[121] = minus_y11_x;
    T[122] = -y21_x;
    T[123] = o_B1_x - q[10]*y21_x;
    T[124] = x21_y;
    T[125] = minus_y11_y;
    T[126] = minus_y21_y;
    T[127] = o_B1_y + q[10]*minus_y21_y;
    T[128] = x21_z;
    T[129] = -s8;
    T[130] = -y21_z;
    MODELER_ZEROS(T + 32, 2);
    T[131] = -q[10]*y21_z;
    const double minus_x12_x = x_B2_x*s11;
    T[132] = -minus_x12_x;
    const double minus_y12_x = x_B2_x*c11;
    T[133] = -minus_y12_x;
    T[134] = -x_B2_y;
    /* link B2: origin of the frame in frame 0, o_B2 = o_B + [x_B y_B z_B] p_B2 */
    const double o_B2_x = q[6] + p_B2_x;
    T[135] = o_B2_x;
    const double minus_x12_y = x_B2_y*s11;
    T[136] = -minus_x12_y;
    const double minus_y12_y = x_B2_y*c11;
    MODELER_ZEROS(T + 36, 2);
    T[137] = -minus_y12_y;
    T[138] = x_B2_x;
    const double o_B2_y = q[7] + p_B2_y;
    T[139] = o_B2_y;
    T[140] = -c11;
    T[141] = s11;
    const double x22_x = s12*minus_x12_x - x_B2_y*c12;
    T[144] = x22_x;
    const double y22_x = x_B2_y*s12 + c12*minus_x12_x;
    T[145] = y22_x;
    MODELER_ZEROS(T + 42, 1);
    T[146] = minus_y12_x;
    T[147] = o_B2_x;
    const double x22_y = s12*minus_x12_y + x_B2_x*c12;
    T[148] = x22_y;
    const double minus_y22_y = x_B2_x*s12 - c12*minus_x12_y;
    T[149] = -minus_y22_y;
    T[150] = minus_y12_y;
    T[151] = o_B2_y;
    const double x22_z = c11*s12;
    T[152] = x22_z;
    MODELER_ZEROS(T + 46, 1);
    const double y22_z = c11*c12;
    T[153] = y22_z;
    T[154] = -s11;
    T[156] = x22_x;
    T[157] = minus_y12_x;
    T[158] = -y22_x;
    T[159] = o_B2_x - q[13]*y22_x;
    T[160] = x22_y;
    T[161] = minus_y12_y;
    T[162] = minus_y22_y;
    MODELER_ZEROS(T + 50, 1);
    T[163] = o_B2_y + q[13]*minus_y22_y;
    T[164] = x22_z;
    T[165] = -s11;
    T[166] = -y22_z;
    T[167] = -q[13]*y22_z;
    const double minus_x13_x = x_B3_x*s14;
    T[168] = -minus_x13_x;
    const double minus_y13_x = x_B3_x*c14;
    T[169] = -minus_y13_x;
    T[170] = -x_B3_y;
    /* link B3: origin of the frame in frame 0, o_B3 = o_B + [x_B y_B z_B] p_B3 */
    const double o_B3_x = q[6] + p_B3_x;
    MODELER_ZEROS(T + 72, 2);
    T[171] = o_B3_x;
    const double minus_x13_y = x_B3_y*s14;
    T[172] = -minus_x13_y;
    const double minus_y13_y = x_B3_y*c14;
    T[173] = -minus_y13_y;
    T[174] = x_B3_x;
    const double o_B3_y = q[7] + p_B3_y;
    T[175] = o_B3_y;
    T[176] = -c14;
    T[177] = s14;
    MODELER_ZEROS(T + 77, 4);
    const double x23_x = s15*minus_x13_x - x_B3_y*c15;
    T[180] = x23_x;
    const double y23_x = x_B3_y*s15 + c15*minus_x13_x;
    T[181] = y23_x;
    T[182] = minus_y13_x;
    T[183] = o_B3_x;
    const double x23_y = s15*minus_x13_y + x_B3_x*c15;
    T[184] = x23_y;
    const double minus_y23_y = x_B3_x*s15 - c15*minus_x13_y;
    T[185] = -minus_y23_y;
    MODELER_ZEROS(T + 82, 3);
    T[186] = minus_y13_y;
    T[187] = o_B3_y;
    const double x23_z = c14*s15;
    T[188] = x23_z;
    const double y23_z = c14*c15;
    T[189] = y23_z;
    T[190] = -s14;
    T[192] = x23_x;
    T[193] = minus_y13_x;
    T[194] = -y23_x;
    T[195] = o_B3_x - q[16]*y23_x;
    MODELER_ZEROS(T + 86, 1);
    T[196] = x23_y;
    T[197] = minus_y13_y;
    T[198] = minus_y23_y;
    T[199] = o_B3_y + q[16]*minus_y23_y;
    T[200] = x23_z;
    T[201] = -s14;
    T[202] = -y23_z;
    T[203] = -q[16]*y23_z;
    const double minus_x14_x = x_B4_x*s17;
    T[204] = -minus_x14_x;
    MODELER_ZEROS(T + 88, 2);
    const double minus_y14_x = x_B4_x*c17;
    T[205] = -minus_y14_x;
    T[206] = -x_B4_y;
    /* link B4: origin of the frame in frame 0, o_B4 = o_B + [x_B y_B z_B] p_B4 */
    const double o_B4_x = q[6] + p_B4_x;
    T[207] = o_B4_x;
    const double minus_x14_y = x_B4_y*s17;
    T[208] = -minus_x14_y;
    const double minus_y14_y = x_B4_y*c17;
    T[209] = -minus_y14_y;
    T[210] = x_B4_x;
    MODELER_ZEROS(T + 93, 3);
    const double o_B4_y = q[7] + p_B4_y;
    T[211] = o_B4_y;
    T[212] = -c17;
    T[213] = s17;
    const double x24_x = s18*minus_x14_x - x_B4_y*c18;
    T[216] = x24_x;
    const double y24_x = x_B4_y*s18 + c18*minus_x14_x;
    T[217] = y24_x;
    T[218] = minus_y14_x;
    T[219] = o_B4_x;
    MODELER_ZEROS(T + 106, 2);
    const double x24_y = s18*minus_x14_y + x_B4_x*c18;
    T[220] = x24_y;
    const double minus_y24_y = x_B4_x*s18 - c18*minus_x14_y;
    T[221] = -minus_y24_y;
    T[222] = minus_y14_y;
    T[223] = o_B4_y;
    const double x24_z = c17*s18;
    T[224] = x24_z;
    const double y24_z = c17*c18;
    T[225] = y24_z;
    T[226] = -s17;
    MODELER_ZEROS(T + 119, 1);
    T[228] = x24_x;
    T[229] = minus_y14_x;
    T[230] = -y24_x;
    T[231] = o_B4_x - q[19]*y24_x;
    T[232] = x24_y;
    T[233] = minus_y14_y;
    T[234] = minus_y24_y;
    T[235] = o_B4_y + q[19]*minus_y24_y;
    T[236] = x24_z;
    T[237] = -s17;
    MODELER_ZEROS(T + 142, 2);
    T[238] = -y24_z;
    T[239] = -q[19]*y24_z;
    const double minus_x15_x = x_B5_x*s20;
    T[240] = -minus_x15_x;
    const double minus_y15_x = x_B5_x*c20;
    T[241] = -minus_y15_x;
    T[242] = -x_B5_y;
    /* link B5: origin of the frame in frame 0, o_B5 = o_B + [x_B y_B z_B] p_B5 */
    const double o_B5_x = q[6] + p_B5_x;
    T[243] = o_B5_x;
    const double minus_x15_y = x_B5_y*s20;
    MODELER_ZEROS(T + 155, 1);
    T[244] = -minus_x15_y;
    const double minus_y15_y = x_B5_y*c20;
    T[245] = -minus_y15_y;
    T[246] = x_B5_x;
    const double o_B5_y = q[7] + p_B5_y;
    T[247] = o_B5_y;
    T[248] = -c20;
    T[249] = s20;
    const double x25_x = s21*minus_x15_x - x_B5_y*c21;
    T[252] = x25_x;
    const double y25_x = x_B5_y*s21 + c21*minus_x15_x;
    MODELER_ZEROS(T + 178, 2);
    T[253] = y25_x;
    T[254] = minus_y15_x;
    T[255] = o_B5_x;
    const double x25_y = s21*minus_x15_y + x_B5_x*c21;
    T[256] = x25_y;
    const double minus_y25_y = x_B5_x*s21 - c21*minus_x15_y;
    T[257] = -minus_y25_y;
    T[258] = minus_y15_y;
    T[259] = o_B5_y;
    const double x25_z = c20*s21;
    MODELER_ZEROS(T + 191, 1);
    T[260] = x25_z;
    const double y25_z = c20*c21;
    T[261] = y25_z;
    T[262] = -s20;
    T[264] = x25_x;
    T[265] = minus_y15_x;
    T[266] = -y25_x;
    T[267] = o_B5_x - q[22]*y25_x;
    T[268] = x25_y;
    T[269] = minus_y15_y;
    MODELER_ZEROS(T + 214, 2);
    T[270] = minus_y25_y;
    T[271] = o_B5_y + q[22]*minus_y25_y;
    T[272] = x25_z;
    T[273] = -s20;
    T[274] = -y25_z;
    T[275] = -q[22]*y25_z;
    const double minus_x16_x = x_B6_x*s23;
    T[276] = -minus_x16_x;
    const double minus_y16_x = x_B6_x*c23;
    T[277] = -minus_y16_x;
    MODELER_ZEROS(T + 227, 1);
    T[278] = -x_B6_y;
    /* link B6: origin of the frame in frame 0, o_B6 = o_B + [x_B y_B z_B] p_B6 */
    const double o_B6_x = q[6] + p_B6_x;
    T[279] = o_B6_x;
    const double minus_x16_y = x_B6_y*s23;
    T[280] = -minus_x16_y;
    const double minus_y16_y = x_B6_y*c23;
    T[281] = -minus_y16_y;
    T[282] = x_B6_x;
    const double o_B6_y = q[7] + p_B6_y;
    T[283] = o_B6_y;
    T[284] = -c23;
    MODELER_ZEROS(T + 250, 2);
    T[285] = s23;
    const double x26_x = s24*minus_x16_x - x_B6_y*c24;
    T[288] = x26_x;
    const double y26_x = x_B6_y*s24 + c24*minus_x16_x;
    T[289] = y26_x;
    T[290] = minus_y16_x;
    T[291] = o_B6_x;
    const double x26_y = s24*minus_x16_y + x_B6_x*c24;
    T[292] = x26_y;
    const double minus_y26_y = x_B6_x*s24 - c24*minus_x16_y;
    MODELER_ZEROS(T + 263, 1);
    T[293] = -minus_y26_y;
    T[294] = minus_y16_y;
    T[295] = o_B6_y;
    const double x26_z = c23*s24;
    T[296] = x26_z;
    const double y26_z = c23*c24;
    T[297] = y26_z;
    T[298] = -s23;
    T[300] = x26_x;
    T[301] = minus_y16_x;
    MODELER_ZEROS(T + 286, 2);
    T[302] = -y26_x;
    T[303] = o_B6_x - q[25]*y26_x;
    T[304] = x26_y;
    T[305] = minus_y16_y;
    T[306] = minus_y26_y;
    T[307] = o_B6_y + q[25]*minus_y26_y;
    T[308] = x26_z;
    T[309] = -s23;
    T[310] = -y26_z;
    T[311] = -q[25]*y26_z;
    MODELER_ZEROS(T + 299, 1);
}

/* d/dt(df/du) ud.
 * 282 additions, 572 multiplications. */
void evra_tree_drift(const double q[26], const double qd[26], double MODELER_OUT(values, 18))
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    const double x_Pbd_tx = c4*qd[4];
    const double t2 = s5*qd[5];
    const double minus_x_Pdd_q4tx = c5*x_Pbd_tx - s4*t2;
    const double t4 = c5*qd[5];
    const double y_Pdd_q4tx = s5*x_Pbd_tx + s4*t4;
    const double minus_y_Pbd_tx = s4*qd[4];
    const double y_Pd_tx = s5*minus_y_Pbd_tx - c4*t4;
    const double minus_x_Pd_tx = c5*minus_y_Pbd_tx + c4*t2;
    const double minus_y11_x = x_B1_x*c8;
    const double t10 = s9*qd[9];
    const double x11d_tz = s8*qd[8];
    const double t12 = qd[8]*(c9*minus_y11_x*qd[10] - q[10]*(minus_y11_x*t10 + x_B1_x*x11d_tz*c9));
    const double minus_x11_x = x_B1_x*s8;
    const double t14 = c9*qd[9];
    const double y11d_tz = c8*qd[8];
    const double minus_x11d_tx = x_B1_x*y11d_tz;
    const double t17 = qd[9]*((s9*minus_x11_x - x_B1_y*c9)*qd[10] + q[10]*(minus_x11_x*t14 +
        s9*minus_x11d_tx + x_B1_y*t10));
    const double t18 = qd[4]*(p41_x*minus_x_Pdd_q4tx - p41_y*y_Pdd_q4tx) - qd[5]*(p41_x*y_Pd_tx +
        p41_y*minus_x_Pd_tx) - t12 + t17;
    values[0] = t18 - qd[10]*(c9*minus_x11d_tx - minus_x11_x*t10 + x_B1_y*t14);
    const double minus_y_Pb_z = c3*s4;
    const double minus_x_Pad_ty = s3*qd[3];
    const double y_Pbd_tz = s4*minus_x_Pad_ty - c3*x_Pbd_tx;
    const double x_Pad_tz = c3*qd[3];
    const double x_Pd_tz = minus_y_Pb_z*t2 + c5*y_Pbd_tz + (s5*x_Pad_tz + s3*t4);
    const double y_Pd_tz = c5*x_Pad_tz - s3*t2 + (minus_y_Pb_z*t4 - s5*y_Pbd_tz);
    const double minus_x_Pb_y = s3*c4;
    const double minus_x_Pbd_ty = c4*x_Pad_tz - s3*minus_y_Pbd_tx;
    const double minus_x_Pdd_q4ty = minus_x_Pb_y*t2 - c5*minus_x_Pbd_ty;
    const double minus_y_Pdd_q4ty = minus_x_Pb_y*t4 + s5*minus_x_Pbd_ty;
    const double y_Pb_y = s3*s4;
    const double y_Pbd_ty = s4*x_Pad_tz + s3*x_Pbd_tx;
    const double minus_y_Pd_ty = c5*minus_x_Pad_ty + c3*t2 + (y_Pb_y*t4 + s5*y_Pbd_ty);
    const double minus_x_Pd_ty = y_Pb_y*t2 - c5*y_Pbd_ty + (s5*minus_x_Pad_ty - c3*t4);
    const double t33 = qd[3]*(p41_x*x_Pd_tz + p41_y*y_Pd_tz) + qd[4]*(p41_x*minus_x_Pdd_q4ty +
        p41_y*minus_y_Pdd_q4ty);
    const double minus_y11_y = x_B1_y*c8;
    const double t35 = qd[8]*(c9*minus_y11_y*qd[10] - q[10]*(minus_y11_y*t10 + x_B1_y*x11d_tz*c9));
    const double minus_x11_y = x_B1_y*s8;
    const double minus_x11d_ty = x_B1_y*y11d_tz;
    const double t38 = qd[9]*((s9*minus_x11_y + x_B1_x*c9)*qd[10] + q[10]*(minus_x11_y*t14 +
        s9*minus_x11d_ty - x_B1_x*t10));
    const double t39 = t33 + qd[5]*(p41_x*minus_y_Pd_ty - p41_y*minus_x_Pd_ty) - t35 + t38;
    values[1] = t39 + qd[10]*(minus_x11_y*t10 - c9*minus_x11d_ty + x_B1_x*t14);
    const double x_Pb_z = c3*c4;
    const double minus_x_Pbd_tz = c4*minus_x_Pad_ty + c3*minus_y_Pbd_tx;
    const double x_Pdd_q4tz = x_Pb_z*t2 + c5*minus_x_Pbd_tz;
    const double y_Pdd_q4tz = x_Pb_z*t4 - s5*minus_x_Pbd_tz;
    const double t44 = qd[3]*(p41_x*minus_x_Pd_ty + p41_y*minus_y_Pd_ty) - qd[4]*(p41_x*x_Pdd_q4tz +
        p41_y*y_Pdd_q4tz);
    const double t45 = qd[8]*(s8*c9*qd[10] + q[10]*(c9*y11d_tz - s8*t10));
    const double t46 = qd[9]*(c8*s9*qd[10] - q[10]*(s9*x11d_tz - c8*t14));
    values[2] = t44 - qd[5]*(p41_x*y_Pd_tz - p41_y*x_Pd_tz) + t45 + t46 + qd[10]*(c9*x11d_tz +
        c8*t10);
    const double minus_y12_x = x_B2_x*c11;
    const double t48 = s12*qd[12];
    const double x12d_tz = s11*qd[11];
    const double t50 = qd[11]*(c12*minus_y12_x*qd[13] - q[13]*(minus_y12_x*t48 +
        x_B2_x*x12d_tz*c12));
    const double minus_x12_x = x_B2_x*s11;
    const double t52 = c12*qd[12];
    const double y12d_tz = c11*qd[11];
    const double minus_x12d_tx = x_B2_x*y12d_tz;
    const double t55 = qd[12]*((s12*minus_x12_x - x_B2_y*c12)*qd[13] + q[13]*(minus_x12_x*t52 +
        s12*minus_x12d_tx + x_B2_y*t48));
    const double t56 = qd[4]*(p42_x*minus_x_Pdd_q4tx - p42_y*y_Pdd_q4tx) - qd[5]*(p42_x*y_Pd_tx +
        p42_y*minus_x_Pd_tx) - t50 + t55;
    values[3] = t56 - qd[13]*(c12*minus_x12d_tx - minus_x12_x*t48 + x_B2_y*t52);
    const double t57 = qd[3]*(p42_x*x_Pd_tz + p42_y*y_Pd_tz) + qd[4]*(p42_x*minus_x_Pdd_q4ty +
        p42_y*minus_y_Pdd_q4ty);
    const double minus_y12_y = x_B2_y*c11;
    const double t59 = qd[11]*(c12*minus_y12_y*qd[13] - q[13]*(minus_y12_y*t48 +
        x_B2_y*x12d_tz*c12));
    const double minus_x12_y = x_B2_y*s11;
    const double minus_x12d_ty = x_B2_y*y12d_tz;
    const double t62 = qd[12]*((s12*minus_x12_y + x_B2_x*c12)*qd[13] + q[13]*(minus_x12_y*t52 +
        s12*minus_x12d_ty - x_B2_x*t48));
    const double t63 = t57 + qd[5]*(p42_x*minus_y_Pd_ty - p42_y*minus_x_Pd_ty) - t59 + t62;
    values[4] = t63 + qd[13]*(minus_x12_y*t48 - c12*minus_x12d_ty + x_B2_x*t52);
    const double t64 = qd[3]*(p42_x*minus_x_Pd_ty + p42_y*minus_y_Pd_ty) - qd[4]*(p42_x*x_Pdd_q4tz +
        p42_y*y_Pdd_q4tz);
    const double t65 = qd[11]*(s11*c12*qd[13] + q[13]*(c12*y12d_tz - s11*t48));
    const double t66 = qd[12]*(c11*s12*qd[13] - q[13]*(s12*x12d_tz - c11*t52));
    values[5] = t64 - qd[5]*(p42_x*y_Pd_tz - p42_y*x_Pd_tz) + t65 + t66 + qd[13]*(c12*x12d_tz +
        c11*t48);
    const double minus_y13_x = x_B3_x*c14;
    const double t68 = s15*qd[15];
    const double x13d_tz = s14*qd[14];
    const double t70 = qd[14]*(c15*minus_y13_x*qd[16] - q[16]*(minus_y13_x*t68 +
        x_B3_x*x13d_tz*c15));
    const double minus_x13_x = x_B3_x*s14;
    const double t72 = c15*qd[15];
    const double y13d_tz = c14*qd[14];
    const double minus_x13d_tx = x_B3_x*y13d_tz;
    const double t75 = qd[15]*((s15*minus_x13_x - x_B3_y*c15)*qd[16] + q[16]*(minus_x13_x*t72 +
        s15*minus_x13d_tx + x_B3_y*t68));
    const double t76 = qd[4]*(p43_x*minus_x_Pdd_q4tx - p43_y*y_Pdd_q4tx) - qd[5]*(p43_x*y_Pd_tx +
        p43_y*minus_x_Pd_tx) - t70 + t75;
    values[6] = t76 - qd[16]*(c15*minus_x13d_tx - minus_x13_x*t68 + x_B3_y*t72);
    const double t77 = qd[3]*(p43_x*x_Pd_tz + p43_y*y_Pd_tz) + qd[4]*(p43_x*minus_x_Pdd_q4ty +
        p43_y*minus_y_Pdd_q4ty);
    const double minus_y13_y = x_B3_y*c14;
    const double t79 = qd[14]*(c15*minus_y13_y*qd[16] - q[16]*(minus_y13_y*t68 +
        x_B3_y*x13d_tz*c15));
    const double minus_x13_y = x_B3_y*s14;
    const double minus_x13d_ty = x_B3_y*y13d_tz;
    const double t82 = qd[15]*((s15*minus_x13_y + x_B3_x*c15)*qd[16] + q[16]*(minus_x13_y*t72 +
        s15*minus_x13d_ty - x_B3_x*t68));
    const double t83 = t77 + qd[5]*(p43_x*minus_y_Pd_ty - p43_y*minus_x_Pd_ty) - t79 + t82;
    values[7] = t83 + qd[16]*(minus_x13_y*t68 - c15*minus_x13d_ty + x_B3_x*t72);
    const double t84 = qd[3]*(p43_x*minus_x_Pd_ty + p43_y*minus_y_Pd_ty) - qd[4]*(p43_x*x_Pdd_q4tz +
        p43_y*y_Pdd_q4tz);
    const double t85 = qd[14]*(s14*c15*qd[16] + q[16]*(c15*y13d_tz - s14*t68));
    const double t86 = qd[15]*(c14*s15*qd[16] - q[16]*(s15*x13d_tz - c14*t72));
    values[8] = t84 - qd[5]*(p43_x*y_Pd_tz - p43_y*x_Pd_tz) + t85 + t86 + qd[16]*(c15*x13d_tz +
        c14*t68);
    const double minus_y14_x = x_B4_x*c17;
    const double t88 = s18*qd[18];
    const double x14d_tz = s17*qd[17];
    const double t90 = qd[17]*(c18*minus_y14_x*qd[19] - q[19]*(minus_y14_x*t88 +
        x_B4_x*x14d_tz*c18));
    const double minus_x14_x = x_B4_x*s17;
    const double t92 = c18*qd[18];
    const double y14d_tz = c17*qd[17];
    const double minus_x14d_tx = x_B4_x*y14d_tz;
    const double t95 = qd[18]*((s18*minus_x14_x - x_B4_y*c18)*qd[19] + q[19]*(minus_x14_x*t92 +
        s18*minus_x14d_tx + x_B4_y*t88));
    const double t96 = qd[4]*(p44_x*minus_x_Pdd_q4tx - p44_y*y_Pdd_q4tx) - qd[5]*(p44_x*y_Pd_tx +
        p44_y*minus_x_Pd_tx) - t90 + t95;
    values[9] = t96 - qd[19]*(c18*minus_x14d_tx - minus_x14_x*t88 + x_B4_y*t92);
    const double t97 = qd[3]*(p44_x*x_Pd_tz + p44_y*y_Pd_tz) + qd[4]*(p44_x*minus_x_Pdd_q4ty +
        p44_y*minus_y_Pdd_q4ty);
    const double minus_y14_y = x_B4_y*c17;
    const double t99 = qd[17]*(c18*minus_y14_y*qd[19] - q[19]*(minus_y14_y*t88 +
        x_B4_y*x14d_tz*c18));
    const double minus_x14_y = x_B4_y*s17;
    const double minus_x14d_ty = x_B4_y*y14d_tz;
    const double o34dd_q18ty = (s18*minus_x14_y + x_B4_x*c18)*qd[19] + q[19]*(minus_x14_y*t92 +
        s18*minus_x14d_ty - x_B4_x*t88);
    const double t103 = t97 + qd[5]*(p44_x*minus_y_Pd_ty - p44_y*minus_x_Pd_ty) - t99 +
        qd[18]*o34dd_q18ty;
    values[10] = t103 + qd[19]*(minus_x14_y*t88 - c18*minus_x14d_ty + x_B4_x*t92);
    const double t104 = qd[3]*(p44_x*minus_x_Pd_ty + p44_y*minus_y_Pd_ty) - qd[4]*(p44_x*x_Pdd_q4tz
        + p44_y*y_Pdd_q4tz);
    const double t105 = qd[17]*(s17*c18*qd[19] + q[19]*(c18*y14d_tz - s17*t88));
    const double t106 = qd[18]*(c17*s18*qd[19] - q[19]*(s18*x14d_tz - c17*t92));
    const double t107 = t104 - qd[5]*(p44_x*y_Pd_tz - p44_y*x_Pd_tz) + t105 + t106;
    values[11] = t107 + qd[19]*(c18*x14d_tz + c17*t88);
    const double minus_y15_x = x_B5_x*c20;
    const double t109 = s21*qd[21];
    const double x15d_tz = s20*qd[20];
    const double t111 = qd[20]*(c21*minus_y15_x*qd[22] - q[22]*(minus_y15_x*t109 +
        x_B5_x*x15d_tz*c21));
    const double minus_x15_x = x_B5_x*s20;
    const double t113 = c21*qd[21];
    const double y15d_tz = c20*qd[20];
    const double minus_x15d_tx = x_B5_x*y15d_tz;
    const double o35dd_q21tx = (s21*minus_x15_x - x_B5_y*c21)*qd[22] + q[22]*(minus_x15_x*t113 +
        s21*minus_x15d_tx + x_B5_y*t109);
    const double t117 = qd[4]*(p45_x*minus_x_Pdd_q4tx - p45_y*y_Pdd_q4tx) - qd[5]*(p45_x*y_Pd_tx +
        p45_y*minus_x_Pd_tx) - t111 + qd[21]*o35dd_q21tx;
    values[12] = t117 - qd[22]*(c21*minus_x15d_tx - minus_x15_x*t109 + x_B5_y*t113);
    const double t118 = qd[3]*(p45_x*x_Pd_tz + p45_y*y_Pd_tz) + qd[4]*(p45_x*minus_x_Pdd_q4ty +
        p45_y*minus_y_Pdd_q4ty);
    const double minus_y15_y = x_B5_y*c20;
    const double t120 = qd[20]*(c21*minus_y15_y*qd[22] - q[22]*(minus_y15_y*t109 +
        x_B5_y*x15d_tz*c21));
    const double minus_x15_y = x_B5_y*s20;
    const double minus_x15d_ty = x_B5_y*y15d_tz;
    const double o35dd_q21ty = (s21*minus_x15_y + x_B5_x*c21)*qd[22] + q[22]*(minus_x15_y*t113 +
        s21*minus_x15d_ty - x_B5_x*t109);
    const double t124 = t118 + qd[5]*(p45_x*minus_y_Pd_ty - p45_y*minus_x_Pd_ty) - t120 +
        qd[21]*o35dd_q21ty;
    values[13] = t124 + qd[22]*(minus_x15_y*t109 - c21*minus_x15d_ty + x_B5_x*t113);
    const double t125 = qd[3]*(p45_x*minus_x_Pd_ty + p45_y*minus_y_Pd_ty) - qd[4]*(p45_x*x_Pdd_q4tz
        + p45_y*y_Pdd_q4tz);
    const double t126 = qd[20]*(s20*c21*qd[22] + q[22]*(c21*y15d_tz - s20*t109));
    const double t127 = qd[21]*(c20*s21*qd[22] - q[22]*(s21*x15d_tz - c20*t113));
    const double t128 = t125 - qd[5]*(p45_x*y_Pd_tz - p45_y*x_Pd_tz) + t126 + t127;
    values[14] = t128 + qd[22]*(c21*x15d_tz + c20*t109);
    const double minus_y16_x = x_B6_x*c23;
    const double t130 = s24*qd[24];
    const double x16d_tz = s23*qd[23];
    const double t132 = qd[23]*(c24*minus_y16_x*qd[25] - q[25]*(minus_y16_x*t130 +
        x_B6_x*x16d_tz*c24));
    const double minus_x16_x = x_B6_x*s23;
    const double t134 = c24*qd[24];
    const double y16d_tz = c23*qd[23];
    const double minus_x16d_tx = x_B6_x*y16d_tz;
    const double o36dd_q24tx = (s24*minus_x16_x - x_B6_y*c24)*qd[25] + q[25]*(minus_x16_x*t134 +
        s24*minus_x16d_tx + x_B6_y*t130);
    const double t138 = qd[4]*(p46_x*minus_x_Pdd_q4tx - p46_y*y_Pdd_q4tx) - qd[5]*(p46_x*y_Pd_tx +
        p46_y*minus_x_Pd_tx) - t132 + qd[24]*o36dd_q24tx;
    values[15] = t138 - qd[25]*(c24*minus_x16d_tx - minus_x16_x*t130 + x_B6_y*t134);
    const double t139 = qd[3]*(p46_x*x_Pd_tz + p46_y*y_Pd_tz) + qd[4]*(p46_x*minus_x_Pdd_q4ty +
        p46_y*minus_y_Pdd_q4ty);
    const double minus_y16_y = x_B6_y*c23;
    const double t141 = qd[23]*(c24*minus_y16_y*qd[25] - q[25]*(minus_y16_y*t130 +
        x_B6_y*x16d_tz*c24));
    const double minus_x16_y = x_B6_y*s23;
    const double minus_x16d_ty = x_B6_y*y16d_tz;
    const double o36dd_q24ty = (s24*minus_x16_y + x_B6_x*c24)*qd[25] + q[25]*(minus_x16_y*t134 +
        s24*minus_x16d_ty - x_B6_x*t130);
    const double t145 = t139 + qd[5]*(p46_x*minus_y_Pd_ty - p46_y*minus_x_Pd_ty) - t141 +
        qd[24]*o36dd_q24ty;
    values[16] = t145 + qd[25]*(minus_x16_y*t130 - c24*minus_x16d_ty + x_B6_x*t134);
    const double t146 = qd[3]*(p46_x*minus_x_Pd_ty + p46_y*minus_y_Pd_ty) - qd[4]*(p46_x*x_Pdd_q4tz
        + p46_y*y_Pdd_q4tz);
    const double t147 = qd[23]*(s23*c24*qd[25] + q[25]*(c24*y16d_tz - s23*t130));
    const double t148 = qd[24]*(c23*s24*qd[25] - q[25]*(s24*x16d_tz - c23*t134));
    const double t149 = t146 - qd[5]*(p46_x*y_Pd_tz - p46_y*x_Pd_tz) + t147 + t148;
    values[17] = t149 + qd[25]*(c24*x16d_tz + c23*t130);
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 154 additions, 284 multiplications. */
void evra_tree_closure(const double q[26], double MODELER_OUT(values, 180))
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p_B1_x = x_B1_x*evra_geo_RB;
    const double p_B1_y = x_B1_y*evra_geo_RB;
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p_B2_x = evra_geo_RB*x_B2_x;
    const double p_B2_y = evra_geo_RB*x_B2_y;
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p_B3_x = evra_geo_RB*x_B3_x;
    const double p_B3_y = evra_geo_RB*x_B3_y;
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p_B4_x = evra_geo_RB*x_B4_x;
    const double p_B4_y = evra_geo_RB*x_B4_y;
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p_B5_x = evra_geo_RB*x_B5_x;
    const double p_B5_y = evra_geo_RB*x_B5_y;
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p_B6_x = evra_geo_RB*x_B6_x;
    const double p_B6_y = evra_geo_RB*x_B6_y;
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    const double minus_x11_x = x_B1_x*s8;
    const double y21_x = x_B1_y*s9 + c9*minus_x11_x;
    const double x_P_x = c4*c5;
    const double minus_y_P_x = c4*s5;
    values[0] = q[6] + p_B1_x - q[10]*y21_x + (p41_y*minus_y_P_x - (q[0] + p41_x*x_P_x));
    const double minus_x11_y = x_B1_y*s8;
    const double minus_y21_y = x_B1_x*s9 - c9*minus_x11_y;
    const double y_Pb_y = s3*s4;
    const double x_P_y = c5*y_Pb_y + c3*s5;
    const double t9 = p41_x*x_P_y;
    const double y_P_y = c3*c5 - s5*y_Pb_y;
    const double t11 = p41_y*y_P_y;
    values[1] = q[7] + p_B1_y + q[10]*minus_y21_y - (q[1] + t9 + t11);
    const double y21_z = c8*c9;
    const double minus_y_Pb_z = c3*s4;
    const double minus_x_P_z = c5*minus_y_Pb_z - s3*s5;
    const double t15 = p41_x*minus_x_P_z;
    const double y_P_z = s3*c5 + s5*minus_y_Pb_z;
    const double t17 = p41_y*y_P_z;
    values[2] = -(q[2] - t15 + t17 + q[10]*y21_z);
    const double minus_x12_x = x_B2_x*s11;
    const double y22_x = x_B2_y*s12 + c12*minus_x12_x;
    values[3] = q[6] + p_B2_x - q[13]*y22_x + (p42_y*minus_y_P_x - (q[0] + p42_x*x_P_x));
    const double minus_x12_y = x_B2_y*s11;
    const double minus_y22_y = x_B2_x*s12 - c12*minus_x12_y;
    const double t22 = p42_x*x_P_y;
    const double t23 = p42_y*y_P_y;
    values[4] = q[7] + p_B2_y + q[13]*minus_y22_y - (q[1] + t22 + t23);
    const double y22_z = c11*c12;
    const double t25 = p42_x*minus_x_P_z;
    const double t26 = p42_y*y_P_z;
    values[5] = -(q[2] - t25 + t26 + q[13]*y22_z);
    const double minus_x13_x = x_B3_x*s14;
    const double y23_x = x_B3_y*s15 + c15*minus_x13_x;
    values[6] = q[6] + p_B3_x - q[16]*y23_x + (p43_y*minus_y_P_x - (q[0] + p43_x*x_P_x));
    const double minus_x13_y = x_B3_y*s14;
    const double minus_y23_y = x_B3_x*s15 - c15*minus_x13_y;
    const double t31 = p43_x*x_P_y;
    const double t32 = p43_y*y_P_y;
    values[7] = q[7] + p_B3_y + q[16]*minus_y23_y - (q[1] + t31 + t32);
    const double y23_z = c14*c15;
    const double t34 = p43_x*minus_x_P_z;
    const double t35 = p43_y*y_P_z;
    values[8] = -(q[2] - t34 + t35 + q[16]*y23_z);
    const double minus_x14_x = x_B4_x*s17;
    const double y24_x = x_B4_y*s18 + c18*minus_x14_x;
    values[9] = q[6] + p_B4_x - q[19]*y24_x + (p44_y*minus_y_P_x - (q[0] + p44_x*x_P_x));
    const double minus_x14_y = x_B4_y*s17;
    const double minus_y24_y = x_B4_x*s18 - c18*minus_x14_y;
    const double t40 = p44_x*x_P_y;
    const double t41 = p44_y*y_P_y;
    values[10] = q[7] + p_B4_y + q[19]*minus_y24_y - (q[1] + t40 + t41);
    const double y24_z = c17*c18;
    const double t43 = p44_x*minus_x_P_z;
    const double t44 = p44_y*y_P_z;
    values[11] = -(q[2] - t43 + t44 + q[19]*y24_z);
    const double minus_x15_x = x_B5_x*s20;
    const double y25_x = x_B5_y*s21 + c21*minus_x15_x;
    values[12] = q[6] + p_B5_x - q[22]*y25_x + (p45_y*minus_y_P_x - (q[0] + p45_x*x_P_x));
    const double minus_x15_y = x_B5_y*s20;
    const double minus_y25_y = x_B5_x*s21 - c21*minus_x15_y;
    const double t49 = p45_x*x_P_y;
    const double t50 = p45_y*y_P_y;
    values[13] = q[7] + p_B5_y + q[22]*minus_y25_y - (q[1] + t49 + t50);
    const double y25_z = c20*c21;
    const double t52 = p45_x*minus_x_P_z;
    const double t53 = p45_y*y_P_z;
    values[14] = -(q[2] - t52 + t53 + q[22]*y25_z);
    const double minus_x16_x = x_B6_x*s23;
    const double y26_x = x_B6_y*s24 + c24*minus_x16_x;
    values[15] = q[6] + p_B6_x - q[25]*y26_x + (p46_y*minus_y_P_x - (q[0] + p46_x*x_P_x));
    const double minus_x16_y = x_B6_y*s23;
    const double minus_y26_y = x_B6_x*s24 - c24*minus_x16_y;
    const double t58 = p46_x*x_P_y;
    const double t59 = p46_y*y_P_y;
    values[16] = q[7] + p_B6_y + q[25]*minus_y26_y - (q[1] + t58 + t59);
    const double y26_z = c23*c24;
    const double t61 = p46_x*minus_x_P_z;
    const double t62 = p46_y*y_P_z;
    values[17] = -(q[2] - t61 + t62 + q[25]*y26_z);
    values[18] = -1.0;
    const double minus_x_Pd_q4x = s4*c5;
    const double y_Pd_q4x = s4*s5;
    values[19] = p41_x*minus_x_Pd_q4x - p41_y*y_Pd_q4x;
    values[20] = p41_x*minus_y_P_x + p41_y*x_P_x;
    values[21] = 1.0;
    values[22] = -x_B1_x*c8*c9*q[10];
    values[23] = q[10]*(s9*minus_x11_x - x_B1_y*c9);
    values[24] = -y21_x;
    values[25] = -1.0;
    values[26] = t17 - t15;
    const double minus_x_Pb_y = s3*c4;
    const double x_Pd_q4y = c5*minus_x_Pb_y;
    const double minus_y_Pd_q4y = s5*minus_x_Pb_y;
    values[27] = p41_y*minus_y_Pd_q4y - p41_x*x_Pd_q4y;
    values[28] = p41_y*x_P_y - p41_x*y_P_y;
    values[29] = 1.0;
    values[30] = -x_B1_y*c8*c9*q[10];
    values[31] = q[10]*(s9*minus_x11_y + x_B1_x*c9);
    values[32] = minus_y21_y;
    values[33] = -1.0;
    values[34] = -(t9 + t11);
    const double x_Pb_z = c3*c4;
    const double minus_x_Pd_q4z = c5*x_Pb_z;
    const double y_Pd_q4z = s5*x_Pb_z;
    values[35] = p41_x*minus_x_Pd_q4z - p41_y*y_Pd_q4z;
    values[36] = -(p41_x*y_P_z + p41_y*minus_x_P_z);
    values[37] = s8*c9*q[10];
    values[38] = c8*s9*q[10];
    values[39] = -y21_z;
    values[40] = -1.0;
    values[41] = p42_x*minus_x_Pd_q4x - p42_y*y_Pd_q4x;
    values[42] = p42_x*minus_y_P_x + p42_y*x_P_x;
    values[43] = 1.0;
    values[44] = -x_B2_x*c11*c12*q[13];
    values[45] = q[13]*(s12*minus_x12_x - x_B2_y*c12);
    values[46] = -y22_x;
    values[47] = -1.0;
    values[48] = t26 - t25;
    values[49] = p42_y*minus_y_Pd_q4y - p42_x*x_Pd_q4y;
    values[50] = p42_y*x_P_y - p42_x*y_P_y;
    values[51] = 1.0;
    values[52] = -x_B2_y*c11*c12*q[13];
    values[53] = q[13]*(s12*minus_x12_y + x_B2_x*c12);
    values[54] = minus_y22_y;
    values[55] = -1.0;
    values[56] = -(t22 + t23);
    values[57] = p42_x*minus_x_Pd_q4z - p42_y*y_Pd_q4z;
    values[58] = -(p42_x*y_P_z + p42_y*minus_x_P_z);
    values[59] = s11*c12*q[13];
    values[60] = c11*s12*q[13];
    values[61] = -y22_z;
    values[62] = -1.0;
    values[63] = p43_x*minus_x_Pd_q4x - p43_y*y_Pd_q4x;
    values[64] = p43_x*minus_y_P_x + p43_y*x_P_x;
    values[65] = 1.0;
    values[66] = -x_B3_x*c14*c15*q[16];
    values[67] = q[16]*(s15*minus_x13_x - x_B3_y*c15);
    values[68] = -y23_x;
    values[69] = -1.0;
    values[70] = t35 - t34;
    values[71] = p43_y*minus_y_Pd_q4y - p43_x*x_Pd_q4y;
    values[72] = p43_y*x_P_y - p43_x*y_P_y;
    values[73] = 1.0;
    values[74] = -x_B3_y*c14*c15*q[16];
    values[75] = q[16]*(s15*minus_x13_y + x_B3_x*c15);
    values[76] = minus_y23_y;
    values[77] = -1.0;
    values[78] = -(t31 + t32);
    values[79] = p43_x*minus_x_Pd_q4z - p43_y*y_Pd_q4z;
    values[80] = -(p43_x*y_P_z + p43_y*minus_x_P_z);
    values[81] = s14*c15*q[16];
    values[82] = c14*s15*q[16];
    values[83] = -y23_z;
    values[84] = -1.0;
    values[85] = p44_x*minus_x_Pd_q4x - p44_y*y_Pd_q4x;
    values[86] = p44_x*minus_y_P_x + p44_y*x_P_x;
    values[87] = 1.0;
    values[88] = -x_B4_x*c17*c18*q[19];
    values[89] = q[19]*(s18*minus_x14_x - x_B4_y*c18);
    values[90] = -y24_x;
    values[91] = -1.0;
    values[92] = t44 - t43;
    values[93] = p44_y*minus_y_Pd_q4y - p44_x*x_Pd_q4y;
    values[94] = p44_y*x_P_y - p44_x*y_P_y;
    values[95] = 1.0;
    values[96] = -x_B4_y*c17*c18*q[19];
    values[97] = q[19]*(s18*minus_x14_y + x_B4_x*c18);
    values[98] = minus_y24_y;
    values[99] = -1.0;
    values[100] = -(t40 + t41);
    values[101] = p44_x*minus_x_Pd_q4z - p44_y*y_Pd_q4z;
    values[102] = -(p44_x*y_P_z + p44_y*minus_x_P_z);
    values[103] = s17*c18*q[19];
    values[104] = c17*s18*q[19];
    values[105] = -y24_z;
    values[106] = -1.0;
    values[107] = p45_x*minus_x_Pd_q4x - p45_y*y_Pd_q4x;
    values[108] = p45_x*minus_y_P_x + p45_y*x_P_x;
    values[109] = 1.0;
    values[110] = -x_B5_x*c20*c21*q[22];
    values[111] = q[22]*(s21*minus_x15_x - x_B5_y*c21);
    values[112] = -y25_x;
    values[113] = -1.0;
    values[114] = t53 - t52;
    values[115] = p45_y*minus_y_Pd_q4y - p45_x*x_Pd_q4y;
    values[116] = p45_y*x_P_y - p45_x*y_P_y;
    values[117] = 1.0;
    values[118] = -x_B5_y*c20*c21*q[22];
    values[119] = q[22]*(s21*minus_x15_y + x_B5_x*c21);
    values[120] = minus_y25_y;
    values[121] = -1.0;
    values[122] = -(t49 + t50);
    values[123] = p45_x*minus_x_Pd_q4z - p45_y*y_Pd_q4z;
    values[124] = -(p45_x*y_P_z + p45_y*minus_x_P_z);
    values[125] = s20*c21*q[22];
    values[126] = c20*s21*q[22];
    values[127] = -y25_z;
    values[128] = -1.0;
    values[129] = p46_x*minus_x_Pd_q4x - p46_y*y_Pd_q4x;
    values[130] = p46_x*minus_y_P_x + p46_y*x_P_x;
    values[131] = 1.0;
    values[132] = -x_B6_x*c23*c24*q[25];
    values[133] = q[25]*(s24*minus_x16_x - x_B6_y*c24);
    values[134] = -y26_x;
    values[135] = -1.0;
    values[136] = t62 - t61;
    values[137] = p46_y*minus_y_Pd_q4y - p46_x*x_Pd_q4y;
    values[138] = p46_y*x_P_y - p46_x*y_P_y;
    values[139] = 1.0;
    values[140] = -x_B6_y*c23*c24*q[25];
    values[141] = q[25]*(s24*minus_x16_y + x_B6_x*c24);
    values[142] = minus_y26_y;
    values[143] = -1.0;
    values[144] = -(t58 + t59);
    values[145] = p46_x*minus_x_Pd_q4z - p46_y*y_Pd_q4z;
    values[146] = -(p46_x*y_P_z + p46_y*minus_x_P_z);
    values[147] = s23*c24*q[25];
    values[148] = c23*s24*q[25];
    values[149] = -y26_z;
    values[150] = c3;
    values[151] = s3;
    values[152] = c4;
    values[153] = s4;
    values[154] = c5;
    values[155] = s5;
    values[156] = c8;
    values[157] = s8;
    values[158] = c9;
    values[159] = s9;
    values[160] = c11;
    values[161] = s11;
    values[162] = c12;
    values[163] = s12;
    values[164] = c14;
    values[165] = s14;
    values[166] = c15;
    values[167] = s15;
    values[168] = c17;
    values[169] = s17;
    values[170] = c18;
    values[171] = s18;
    values[172] = c20;
    values[173] = s20;
    values[174] = c21;
    values[175] = s21;
    values[176] = c23;
    values[177] = s23;
    values[178] = c24;
    values[179] = s24;
}

/* The independent equations.
 * 94 additions, 108 multiplications. */
void evra_tree_residual(const double q[26], double MODELER_OUT(f, 18))
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p_B1_x = x_B1_x*evra_geo_RB;
    const double p_B1_y = x_B1_y*evra_geo_RB;
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p_B2_x = evra_geo_RB*x_B2_x;
    const double p_B2_y = evra_geo_RB*x_B2_y;
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p_B3_x = evra_geo_RB*x_B3_x;
    const double p_B3_y = evra_geo_RB*x_B3_y;
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p_B4_x = evra_geo_RB*x_B4_x;
    const double p_B4_y = evra_geo_RB*x_B4_y;
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p_B5_x = evra_geo_RB*x_B5_x;
    const double p_B5_y = evra_geo_RB*x_B5_y;
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p_B6_x = evra_geo_RB*x_B6_x;
    const double p_B6_y = evra_geo_RB*x_B6_y;
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    const double x_P_x = c4*c5;
    const double minus_y_P_x = c4*s5;
    f[0] = q[6] + p_B1_x - q[10]*(x_B1_y*s9 + x_B1_x*s8*c9) + (p41_y*minus_y_P_x - (q[0] +
        p41_x*x_P_x));
    const double y_Pb_y = s3*s4;
    const double x_P_y = c5*y_Pb_y + c3*s5;
    const double y_P_y = c3*c5 - s5*y_Pb_y;
    f[1] = q[7] + p_B1_y + q[10]*(x_B1_x*s9 - x_B1_y*s8*c9) - (q[1] + p41_x*x_P_y + p41_y*y_P_y);
    const double minus_y_Pb_z = c3*s4;
    const double minus_x_P_z = c5*minus_y_Pb_z - s3*s5;
    const double y_P_z = s3*c5 + s5*minus_y_Pb_z;
    f[2] = -(q[2] - p41_x*minus_x_P_z + p41_y*y_P_z + c8*c9*q[10]);
    f[3] = q[6] + p_B2_x - q[13]*(x_B2_y*s12 + x_B2_x*s11*c12) + (p42_y*minus_y_P_x - (q[0] +
        p42_x*x_P_x));
    f[4] = q[7] + p_B2_y + q[13]*(x_B2_x*s12 - x_B2_y*s11*c12) - (q[1] + p42_x*x_P_y + p42_y*y_P_y);
    f[5] = -(q[2] - p42_x*minus_x_P_z + p42_y*y_P_z + c11*c12*q[13]);
    f[6] = q[6] + p_B3_x - q[16]*(x_B3_y*s15 + x_B3_x*s14*c15) + (p43_y*minus_y_P_x - (q[0] +
        p43_x*x_P_x));
    f[7] = q[7] + p_B3_y + q[16]*(x_B3_x*s15 - x_B3_y*s14*c15) - (q[1] + p43_x*x_P_y + p43_y*y_P_y);
    f[8] = -(q[2] - p43_x*minus_x_P_z + p43_y*y_P_z + c14*c15*q[16]);
    f[9] = q[6] + p_B4_x - q[19]*(x_B4_y*s18 + x_B4_x*s17*c18) + (p44_y*minus_y_P_x - (q[0] +
        p44_x*x_P_x));
    f[10] = q[7] + p_B4_y + q[19]*(x_B4_x*s18 - x_B4_y*s17*c18) - (q[1] + p44_x*x_P_y +
        p44_y*y_P_y);
    f[11] = -(q[2] - p44_x*minus_x_P_z + p44_y*y_P_z + c17*c18*q[19]);
    f[12] = q[6] + p_B5_x - q[22]*(x_B5_y*s21 + x_B5_x*s20*c21) + (p45_y*minus_y_P_x - (q[0] +
        p45_x*x_P_x));
    f[13] = q[7] + p_B5_y + q[22]*(x_B5_x*s21 - x_B5_y*s20*c21) - (q[1] + p45_x*x_P_y +
        p45_y*y_P_y);
    f[14] = -(q[2] - p45_x*minus_x_P_z + p45_y*y_P_z + c20*c21*q[22]);
    f[15] = q[6] + p_B6_x - q[25]*(x_B6_y*s24 + x_B6_x*s23*c24) + (p46_y*minus_y_P_x - (q[0] +
        p46_x*x_P_x));
    f[16] = q[7] + p_B6_y + q[25]*(x_B6_x*s24 - x_B6_y*s23*c24) - (q[1] + p46_x*x_P_y +
        p46_y*y_P_y);
    f[17] = -(q[2] - p46_x*minus_x_P_z + p46_y*y_P_z + c23*c24*q[25]);
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 115 additions, 161 multiplications. */
void evra_tree_factor(const double J[132], double MODELER_OUT(lu, 107))
{
    const double t1 = 1.0/J[4];
    lu[0] = t1;
    const double t2 = J[12]*t1;
    const double t3 = 1.0/(J[13] - J[5]*t2);
    lu[1] = t3;
    const double t4 = 1.0/J[26];
    lu[2] = t4;
    const double t5 = J[34]*t4;
    const double t6 = 1.0/(J[35] - J[27]*t5);
    lu[3] = t6;
    const double t7 = 1.0/J[48];
    lu[4] = t7;
    const double t8 = J[56]*t7;
    const double t9 = 1.0/(J[57] - J[49]*t8);
    lu[5] = t9;
    const double t10 = 1.0/J[70];
    lu[6] = t10;
    const double t11 = J[78]*t10;
    const double t12 = 1.0/(J[79] - J[71]*t11);
    lu[7] = t12;
    const double t13 = 1.0/J[92];
    lu[8] = t13;
    const double t14 = J[100]*t13;
    const double t15 = 1.0/(J[101] - J[93]*t14);
    lu[9] = t15;
    const double t16 = 1.0/J[114];
    lu[10] = t16;
    const double t17 = J[122]*t16;
    const double t18 = 1.0/(J[123] - J[115]*t17);
    lu[11] = t18;
    const double t19 = J[19]*t1;
    const double t20 = (J[20] - J[5]*t19)*t3;
    const double t21 = 1.0/(t19 - t2*t20);
    lu[12] = t21;
    const double t22 = J[41]*t4;
    const double t23 = (J[42] - J[27]*t22)*t6;
    const double t24 = (t22 - t5*t23)*t21;
    const double t25 = 1.0/(1.0 - t24);
    lu[13] = -t25;
    const double t26 = J[63]*t7;
    const double t27 = (J[64] - J[49]*t26)*t9;
    const double t28 = (t26 - t8*t27)*t21;
    const double t29 = t23 - t20*t24;
    const double t30 = (1.0 - t28)*t25;
    const double t31 = 1.0/(t27 - t20*t28 - t29*t30);
    lu[14] = t31;
    const double t32 = J[85]*t10;
    const double t33 = (J[86] - J[71]*t32)*t12;
    const double t34 = J[16] - J[8]*t20;
    const double t35 = (t32 - t11*t33)*t21;
    const double t36 = J[38] - J[30]*t23 - t34*t24;
    const double t37 = (1.0 - t35)*t25;
    const double t38 = J[60] - J[52]*t27 - t34*t28 - t36*t30;
    const double t39 = (t33 - t20*t35 - t29*t37)*t31;
    const double t40 = 1.0/(J[82] - J[74]*t33 - t34*t35 - t36*t37 - t38*t39);
    lu[15] = t40;
    const double t41 = J[107]*t13;
    const double t42 = J[97] - J[89]*t14;
    const double t43 = (J[108] - J[93]*t41)*t15;
    const double t44 = J[9] - J[1]*t2;
    const double t45 = J[17] - J[1]*t19 - t44*t20;
    const double t46 = (t41 - t14*t43)*t21;
    const double t47 = J[31] - J[23]*t5;
    const double t48 = J[39] - J[23]*t22 - t47*t23 - t45*t24;
    const double t49 = (1.0 - t46)*t25;
    const double t50 = J[53] - J[45]*t8;
    const double t51 = J[61] - J[45]*t26 - t50*t27 - t45*t28 - t48*t30;
    const double t52 = (t43 - t20*t46 - t29*t49)*t31;
    const double t53 = J[75] - J[67]*t11;
    const double t54 = J[83] - J[67]*t32 - t53*t33 - t45*t35 - t48*t37 - t51*t39;
    const double t55 = (J[104] - J[96]*t43 - t34*t46 - t36*t49 - t38*t52)*t40;
    const double t56 = 1.0/(J[105] - J[89]*t41 - t42*t43 - t45*t46 - t48*t49 - t51*t52 - t54*t55);
    lu[16] = t56;
    const double t57 = J[129]*t16;
    const double t58 = J[120] - J[112]*t17;
    const double t59 = (J[130] - J[115]*t57)*t18;
    const double t60 = J[10] - J[2]*t2;
    const double t61 = J[18] - J[2]*t19 - t60*t20;
    const double t62 = (t57 - t17*t59)*t21;
    const double t63 = J[32] - J[24]*t5;
    const double t64 = J[40] - J[24]*t22 - t63*t23 - t61*t24;
    const double t65 = (1.0 - t62)*t25;
    const double t66 = J[54] - J[46]*t8;
    const double t67 = J[62] - J[46]*t26 - t66*t27 - t61*t28 - t64*t30;
    const double t68 = (t59 - t20*t62 - t29*t65)*t31;
    const double t69 = J[76] - J[68]*t11;
    const double t70 = J[84] - J[68]*t32 - t69*t33 - t61*t35 - t64*t37 - t67*t39;
    const double t71 = (J[126] - J[118]*t59 - t34*t62 - t36*t65 - t38*t68)*t40;
    const double t72 = J[98] - J[90]*t14;
    const double t73 = J[106] - J[90]*t41 - t72*t43 - t61*t46 - t64*t49 - t67*t52 - t70*t55;
    const double t74 = J[119] - J[111]*t17;
    const double t75 = J[127] - J[111]*t57 - t74*t59 - t45*t62 - t48*t65 - t51*t68 - t54*t71;
    const double t76 = t75*t56;
    const double t77 = J[128] - J[112]*t57 - t58*t59 - t61*t62 - t64*t65 - t67*t68 - t70*t71;
    lu[17] = 1.0/(t77 - t73*t76);
    lu[18] = J[1];
    lu[19] = J[2];
    lu[20] = J[5];
    lu[21] = t2;
    lu[22] = t19;
    lu[23] = t2;
    lu[24] = J[8];
    lu[25] = t44;
    lu[26] = t60;
    lu[27] = t20;
    lu[28] = J[23];
    lu[29] = J[24];
    lu[30] = J[27];
    lu[31] = t5;
    lu[32] = t22;
    lu[33] = t5;
    lu[34] = J[30];
    lu[35] = t47;
    lu[36] = t63;
    lu[37] = t23;
    lu[38] = J[45];
    lu[39] = J[46];
    lu[40] = J[49];
    lu[41] = t8;
    lu[42] = t26;
    lu[43] = t8;
    lu[44] = J[52];
    lu[45] = t50;
    lu[46] = t66;
    lu[47] = t27;
    lu[48] = J[67];
    lu[49] = J[68];
    lu[50] = J[71];
    lu[51] = t11;
    lu[52] = t32;
    lu[53] = t11;
    lu[54] = J[74];
    lu[55] = t53;
    lu[56] = t69;
    lu[57] = t33;
    lu[58] = J[89];
    lu[59] = J[90];
    lu[60] = J[93];
    lu[61] = t14;
    lu[62] = t41;
    lu[63] = t14;
    lu[64] = J[96];
    lu[65] = t42;
    lu[66] = t72;
    lu[67] = t43;
    lu[68] = J[111];
    lu[69] = J[112];
    lu[70] = J[115];
    lu[71] = t17;
    lu[72] = t57;
    lu[73] = t17;
    lu[74] = J[118];
    lu[75] = t74;
    lu[76] = t58;
    lu[77] = t59;
    lu[78] = t20;
    lu[79] = t34;
    lu[80] = t45;
    lu[81] = t61;
    lu[82] = t24;
    lu[83] = t28;
    lu[84] = t35;
    lu[85] = t46;
    lu[86] = t62;
    lu[87] = t29;
    lu[88] = t36;
    lu[89] = t48;
    lu[90] = t64;
    lu[91] = t30;
    lu[92] = t37;
    lu[93] = t49;
    lu[94] = t65;
    lu[95] = t38;
    lu[96] = t51;
    lu[97] = t67;
    lu[98] = t39;
    lu[99] = t52;
    lu[100] = t68;
    lu[101] = t54;
    lu[102] = t70;
    lu[103] = t55;
    lu[104] = t71;
    lu[105] = t73;
    lu[106] = t76;
}

/* Solution with the factors.
 * 102 additions, 107 multiplications. */
void evra_tree_solve(const double lu[107], const double right[18], double MODELER_OUT(x, 18))
{
    const double t1 = right[4] - lu[31]*right[3];
    const double t2 = right[1] - lu[21]*right[0];
    const double t3 = right[2] - lu[22]*right[0] - lu[27]*t2;
    const double t4 = right[5] - lu[32]*right[3] - lu[37]*t1 - lu[82]*t3;
    const double t5 = right[7] - lu[41]*right[6];
    const double t6 = right[8] - lu[42]*right[6] - lu[47]*t5 - lu[83]*t3 - lu[91]*t4;
    const double t7 = right[10] - lu[51]*right[9];
    const double t8 = right[11] - lu[52]*right[9] - lu[57]*t7 - lu[84]*t3 - lu[92]*t4;
    const double t9 = t8 - lu[98]*t6;
    const double t10 = right[13] - lu[61]*right[12];
    const double t11 = right[14] - lu[62]*right[12] - lu[67]*t10 - lu[85]*t3 - lu[93]*t4;
    const double t12 = t11 - lu[99]*t6 - lu[103]*t9;
    const double t13 = right[16] - lu[71]*right[15];
    const double t14 = right[17] - lu[72]*right[15] - lu[77]*t13 - lu[86]*t3 - lu[94]*t4;
    const double t15 = lu[17]*(t14 - lu[100]*t6 - lu[104]*t9 - lu[106]*t12);
    const double t16 = lu[16]*(t12 - lu[105]*t15);
    const double t17 = lu[15]*(t9 - lu[101]*t16 - lu[102]*t15);
    const double t18 = lu[14]*(t6 - lu[95]*t17 - lu[96]*t16 - lu[97]*t15);
    const double t19 = lu[13]*(t4 - lu[87]*t18 - lu[88]*t17 - lu[89]*t16 - lu[90]*t15);
    const double t20 = lu[12]*(t3 - lu[78]*t18 + t19 - lu[79]*t17 - lu[80]*t16 - lu[81]*t15);
    x[0] = t20;
    x[1] = t18;
    x[2] = t19;
    x[3] = t17;
    x[4] = t16;
    x[5] = t15;
    const double t21 = lu[1]*(t2 - lu[23]*t20 + t18 - lu[24]*t17 - lu[25]*t16 - lu[26]*t15);
    x[6] = lu[0]*(right[0] + t20 - lu[18]*t16 - lu[19]*t15 - lu[20]*t21);
    x[7] = t21;
    const double t22 = lu[3]*(t1 - lu[33]*t20 + t18 - lu[34]*t17 - lu[35]*t16 - lu[36]*t15);
    x[8] = lu[2]*(right[3] + t20 - lu[28]*t16 - lu[29]*t15 - lu[30]*t22);
    x[9] = t22;
    const double t23 = lu[5]*(t5 - lu[43]*t20 + t18 - lu[44]*t17 - lu[45]*t16 - lu[46]*t15);
    x[10] = lu[4]*(right[6] + t20 - lu[38]*t16 - lu[39]*t15 - lu[40]*t23);
    x[11] = t23;
    const double t24 = lu[7]*(t7 - lu[53]*t20 + t18 - lu[54]*t17 - lu[55]*t16 - lu[56]*t15);
    x[12] = lu[6]*(right[9] + t20 - lu[48]*t16 - lu[49]*t15 - lu[50]*t24);
    x[13] = t24;
    const double t25 = lu[9]*(t10 - lu[63]*t20 + t18 - lu[64]*t17 - lu[65]*t16 - lu[66]*t15);
    x[14] = lu[8]*(right[12] + t20 - lu[58]*t16 - lu[59]*t15 - lu[60]*t25);
    x[15] = t25;
    const double t26 = lu[11]*(t13 - lu[73]*t20 + t18 - lu[74]*t17 - lu[75]*t16 - lu[76]*t15);
    x[16] = lu[10]*(right[15] + t20 - lu[68]*t16 - lu[69]*t15 - lu[70]*t26);
    x[17] = t26;
}

/* G from the factors.
 * 540 additions, 681 multiplications. */
void evra_tree_coupling(const double J[132], const double lu[107], double MODELER_OUT(G, 144))
{
    const double t1 = lu[22] - lu[21]*lu[27];
    const double t2 = lu[32] - lu[31]*lu[37] - lu[82]*t1;
    const double t3 = lu[42] - lu[41]*lu[47] - lu[83]*t1 - lu[91]*t2;
    const double t4 = lu[52] - lu[51]*lu[57] - lu[84]*t1 - lu[92]*t2 - lu[98]*t3;
    const double t5 = lu[62] - lu[61]*lu[67] - lu[85]*t1 - lu[93]*t2 - lu[99]*t3 - lu[103]*t4;
    const double t6 = lu[72] - lu[71]*lu[77] - lu[86]*t1 - lu[94]*t2 - lu[100]*t3 - lu[104]*t4;
    const double t7 = lu[17]*(t6 - lu[106]*t5);
    const double t8 = lu[16]*(t5 - lu[105]*t7);
    const double t9 = lu[15]*(t4 - lu[101]*t8 - lu[102]*t7);
    const double t10 = lu[14]*(t3 - lu[95]*t9 - lu[96]*t8 - lu[97]*t7);
    const double t11 = lu[13]*(t2 - lu[87]*t10 - lu[88]*t9 - lu[89]*t8 - lu[90]*t7);
    const double t12 = lu[12]*(t1 - lu[78]*t10 + t11 - lu[79]*t9 - lu[80]*t8 - lu[81]*t7);
    G[0] = t12;
    G[1] = t10;
    G[2] = t11;
    G[3] = t9;
    G[4] = t8;
    G[5] = t7;
    const double t13 = 1.0 - t12;
    const double t14 = lu[1]*(lu[21] - lu[23]*t12 + t10 - lu[24]*t9 - lu[25]*t8 - lu[26]*t7);
    G[6] = -lu[0]*(t13 + lu[18]*t8 + lu[19]*t7 + lu[20]*t14);
    G[7] = t14;
    const double t15 = lu[3]*(lu[31] - lu[33]*t12 + t10 - lu[34]*t9 - lu[35]*t8 - lu[36]*t7);
    G[8] = -lu[2]*(t13 + lu[28]*t8 + lu[29]*t7 + lu[30]*t15);
    G[9] = t15;
    const double t16 = lu[5]*(lu[41] - lu[43]*t12 + t10 - lu[44]*t9 - lu[45]*t8 - lu[46]*t7);
    G[10] = -lu[4]*(t13 + lu[38]*t8 + lu[39]*t7 + lu[40]*t16);
    G[11] = t16;
    const double t17 = lu[7]*(lu[51] - lu[53]*t12 + t10 - lu[54]*t9 - lu[55]*t8 - lu[56]*t7);
    G[12] = -lu[6]*(t13 + lu[48]*t8 + lu[49]*t7 + lu[50]*t17);
    G[13] = t17;
    const double t18 = lu[9]*(lu[61] - lu[63]*t12 + t10 - lu[64]*t9 - lu[65]*t8 - lu[66]*t7);
    G[14] = -lu[8]*(t13 + lu[58]*t8 + lu[59]*t7 + lu[60]*t18);
    G[15] = t18;
    const double t19 = lu[11]*(lu[71] - lu[73]*t12 + t10 - lu[74]*t9 - lu[75]*t8 - lu[76]*t7);
    G[16] = -lu[10]*(t13 + lu[68]*t8 + lu[69]*t7 + lu[70]*t19);
    G[17] = t19;
    const double t20 = lu[37] - lu[27]*lu[82];
    const double t21 = lu[47] - lu[27]*lu[83] - lu[91]*t20;
    const double t22 = lu[57] - lu[27]*lu[84] - lu[92]*t20 - lu[98]*t21;
    const double t23 = lu[67] - lu[27]*lu[85] - lu[93]*t20 - lu[99]*t21 - lu[103]*t22;
    const double t24 = lu[77] - lu[27]*lu[86] - lu[94]*t20 - lu[100]*t21 - lu[104]*t22;
    const double t25 = lu[17]*(t24 - lu[106]*t23);
    const double t26 = lu[16]*(t23 - lu[105]*t25);
    const double t27 = lu[15]*(t22 - lu[101]*t26 - lu[102]*t25);
    const double t28 = lu[14]*(t21 - lu[95]*t27 - lu[96]*t26 - lu[97]*t25);
    const double t29 = lu[13]*(t20 - lu[87]*t28 - lu[88]*t27 - lu[89]*t26 - lu[90]*t25);
    const double t30 = lu[12]*(lu[27] - lu[78]*t28 + t29 - lu[79]*t27 - lu[80]*t26 - lu[81]*t25);
    G[18] = t30;
    G[19] = t28;
    G[20] = t29;
    G[21] = t27;
    G[22] = t26;
    G[23] = t25;
    const double t31 = lu[1]*(t28 - (1.0 + lu[23]*t30) - lu[24]*t27 - lu[25]*t26 - lu[26]*t25);
    G[24] = lu[0]*(t30 - lu[18]*t26 - lu[19]*t25 - lu[20]*t31);
    G[25] = t31;
    const double t32 = lu[3]*(t28 - (1.0 + lu[33]*t30) - lu[34]*t27 - lu[35]*t26 - lu[36]*t25);
    G[26] = lu[2]*(t30 - lu[28]*t26 - lu[29]*t25 - lu[30]*t32);
    G[27] = t32;
    const double t33 = lu[5]*(t28 - (1.0 + lu[43]*t30) - lu[44]*t27 - lu[45]*t26 - lu[46]*t25);
    G[28] = lu[4]*(t30 - lu[38]*t26 - lu[39]*t25 - lu[40]*t33);
    G[29] = t33;
    const double t34 = lu[7]*(t28 - (1.0 + lu[53]*t30) - lu[54]*t27 - lu[55]*t26 - lu[56]*t25);
    G[30] = lu[6]*(t30 - lu[48]*t26 - lu[49]*t25 - lu[50]*t34);
    G[31] = t34;
    const double t35 = lu[9]*(t28 - (1.0 + lu[63]*t30) - lu[64]*t27 - lu[65]*t26 - lu[66]*t25);
    G[32] = lu[8]*(t30 - lu[58]*t26 - lu[59]*t25 - lu[60]*t35);
    G[33] = t35;
    const double t36 = lu[11]*(t28 - (1.0 + lu[73]*t30) - lu[74]*t27 - lu[75]*t26 - lu[76]*t25);
    G[34] = lu[10]*(t30 - lu[68]*t26 - lu[69]*t25 - lu[70]*t36);
    G[35] = t36;
    const double t37 = J[14] - J[6]*lu[21];
    const double t38 = J[21] - J[6]*lu[22] - lu[27]*t37;
    const double t39 = lu[82]*t38;
    const double t40 = lu[83]*t38 - lu[91]*t39;
    const double t41 = lu[84]*t38 - lu[92]*t39 - lu[98]*t40;
    const double t42 = lu[85]*t38 - lu[93]*t39 - lu[99]*t40 - lu[103]*t41;
    const double t43 = lu[17]*(lu[86]*t38 - lu[94]*t39 - lu[100]*t40 - lu[104]*t41 - lu[106]*t42);
    const double t44 = lu[16]*(t42 - lu[105]*t43);
    const double t45 = lu[15]*(t41 - lu[101]*t44 - lu[102]*t43);
    const double t46 = lu[14]*(t40 - lu[95]*t45 - lu[96]*t44 - lu[97]*t43);
    const double t47 = lu[13]*(t39 - lu[87]*t46 - lu[88]*t45 - lu[89]*t44 - lu[90]*t43);
    const double t48 = lu[12]*(t47 - (t38 + lu[78]*t46) - lu[79]*t45 - lu[80]*t44 - lu[81]*t43);
    G[36] = t48;
    G[37] = t46;
    G[38] = t47;
    G[39] = t45;
    G[40] = t44;
    G[41] = t43;
    const double t49 = lu[1]*(t46 - (t37 + lu[23]*t48) - lu[24]*t45 - lu[25]*t44 - lu[26]*t43);
    G[42] = -lu[0]*(J[6] - t48 + lu[18]*t44 + lu[19]*t43 + lu[20]*t49);
    G[43] = t49;
    const double t50 = lu[3]*(t46 - lu[33]*t48 - lu[34]*t45 - lu[35]*t44 - lu[36]*t43);
    G[44] = lu[2]*(t48 - lu[28]*t44 - lu[29]*t43 - lu[30]*t50);
    G[45] = t50;
    const double t51 = lu[5]*(t46 - lu[43]*t48 - lu[44]*t45 - lu[45]*t44 - lu[46]*t43);
    G[46] = lu[4]*(t48 - lu[38]*t44 - lu[39]*t43 - lu[40]*t51);
    G[47] = t51;
    const double t52 = lu[7]*(t46 - lu[53]*t48 - lu[54]*t45 - lu[55]*t44 - lu[56]*t43);
    G[48] = lu[6]*(t48 - lu[48]*t44 - lu[49]*t43 - lu[50]*t52);
    G[49] = t52;
    const double t53 = lu[9]*(t46 - lu[63]*t48 - lu[64]*t45 - lu[65]*t44 - lu[66]*t43);
    G[50] = lu[8]*(t48 - lu[58]*t44 - lu[59]*t43 - lu[60]*t53);
    G[51] = t53;
    const double t54 = lu[11]*(t46 - lu[73]*t48 - lu[74]*t45 - lu[75]*t44 - lu[76]*t43);
    G[52] = lu[10]*(t48 - lu[68]*t44 - lu[69]*t43 - lu[70]*t54);
    G[53] = t54;
    const double t55 = J[36] - J[28]*lu[31];
    const double t56 = J[43] - J[28]*lu[32] - lu[37]*t55;
    const double t57 = lu[91]*t56;
    const double t58 = lu[92]*t56 - lu[98]*t57;
    const double t59 = lu[93]*t56 - lu[99]*t57 - lu[103]*t58;
    const double t60 = lu[17]*(lu[94]*t56 - lu[100]*t57 - lu[104]*t58 - lu[106]*t59);
    const double t61 = lu[16]*(t59 - lu[105]*t60);
    const double t62 = lu[15]*(t58 - lu[101]*t61 - lu[102]*t60);
    const double t63 = lu[14]*(t57 - lu[95]*t62 - lu[96]*t61 - lu[97]*t60);
    const double t64 = lu[13]*(t56 + lu[87]*t63 + lu[88]*t62 + lu[89]*t61 + lu[90]*t60);
    const double t65 = lu[12]*(t64 + lu[78]*t63 + lu[79]*t62 + lu[80]*t61 + lu[81]*t60);
    G[54] = -t65;
    G[55] = t63;
    G[56] = -t64;
    G[57] = t62;
    G[58] = t61;
    G[59] = t60;
    const double t66 = lu[1]*(t63 + lu[23]*t65 - lu[24]*t62 - lu[25]*t61 - lu[26]*t60);
    G[60] = -lu[0]*(t65 + lu[18]*t61 + lu[19]*t60 + lu[20]*t66);
    G[61] = t66;
    const double t67 = lu[3]*(lu[33]*t65 - t55 + t63 - lu[34]*t62 - lu[35]*t61 - lu[36]*t60);
    G[62] = -lu[2]*(J[28] + t65 + lu[28]*t61 + lu[29]*t60 + lu[30]*t67);
    G[63] = t67;
    const double t68 = lu[5]*(t63 + lu[43]*t65 - lu[44]*t62 - lu[45]*t61 - lu[46]*t60);
    G[64] = -lu[4]*(t65 + lu[38]*t61 + lu[39]*t60 + lu[40]*t68);
    G[65] = t68;
    const double t69 = lu[7]*(t63 + lu[53]*t65 - lu[54]*t62 - lu[55]*t61 - lu[56]*t60);
    G[66] = -lu[6]*(t65 + lu[48]*t61 + lu[49]*t60 + lu[50]*t69);
    G[67] = t69;
    const double t70 = lu[9]*(t63 + lu[63]*t65 - lu[64]*t62 - lu[65]*t61 - lu[66]*t60);
    G[68] = -lu[8]*(t65 + lu[58]*t61 + lu[59]*t60 + lu[60]*t70);
    G[69] = t70;
    const double t71 = lu[11]*(t63 + lu[73]*t65 - lu[74]*t62 - lu[75]*t61 - lu[76]*t60);
    G[70] = -lu[10]*(t65 + lu[68]*t61 + lu[69]*t60 + lu[70]*t71);
    G[71] = t71;
    const double t72 = J[58] - J[50]*lu[41];
    const double t73 = J[65] - J[50]*lu[42] - lu[47]*t72;
    const double t74 = lu[98]*t73;
    const double t75 = lu[99]*t73 - lu[103]*t74;
    const double t76 = lu[17]*(lu[100]*t73 - lu[104]*t74 - lu[106]*t75);
    const double t77 = lu[16]*(t75 - lu[105]*t76);
    const double t78 = lu[15]*(t74 - lu[101]*t77 - lu[102]*t76);
    const double t79 = lu[14]*(t73 + lu[95]*t78 + lu[96]*t77 + lu[97]*t76);
    const double t80 = lu[13]*(lu[87]*t79 - lu[88]*t78 - lu[89]*t77 - lu[90]*t76);
    const double t81 = lu[12]*(t80 + lu[78]*t79 - lu[79]*t78 - lu[80]*t77 - lu[81]*t76);
    G[72] = t81;
    G[73] = -t79;
    G[74] = t80;
    G[75] = t78;
    G[76] = t77;
    G[77] = t76;
    const double t82 = lu[1]*(t79 + lu[23]*t81 + lu[24]*t78 + lu[25]*t77 + lu[26]*t76);
    G[78] = lu[0]*(t81 - lu[18]*t77 - lu[19]*t76 + lu[20]*t82);
    G[79] = -t82;
    const double t83 = lu[3]*(t79 + lu[33]*t81 + lu[34]*t78 + lu[35]*t77 + lu[36]*t76);
    G[80] = lu[2]*(t81 - lu[28]*t77 - lu[29]*t76 + lu[30]*t83);
    G[81] = -t83;
    const double t84 = lu[5]*(t72 + lu[43]*t81 + t79 + lu[44]*t78 + lu[45]*t77 + lu[46]*t76);
    G[82] = -lu[4]*(J[50] - t81 + lu[38]*t77 + lu[39]*t76 - lu[40]*t84);
    G[83] = -t84;
    const double t85 = lu[7]*(t79 + lu[53]*t81 + lu[54]*t78 + lu[55]*t77 + lu[56]*t76);
    G[84] = lu[6]*(t81 - lu[48]*t77 - lu[49]*t76 + lu[50]*t85);
    G[85] = -t85;
    const double t86 = lu[9]*(t79 + lu[63]*t81 + lu[64]*t78 + lu[65]*t77 + lu[66]*t76);
    G[86] = lu[8]*(t81 - lu[58]*t77 - lu[59]*t76 + lu[60]*t86);
    G[87] = -t86;
    const double t87 = lu[11]*(t79 + lu[73]*t81 + lu[74]*t78 + lu[75]*t77 + lu[76]*t76);
    G[88] = lu[10]*(t81 - lu[68]*t77 - lu[69]*t76 + lu[70]*t87);
    G[89] = -t87;
    const double t88 = J[80] - J[72]*lu[51];
    const double t89 = J[87] - J[72]*lu[52] - lu[57]*t88;
    const double t90 = lu[103]*t89;
    const double t91 = lu[17]*(lu[104]*t89 - lu[106]*t90);
    const double t92 = lu[16]*(t90 - lu[105]*t91);
    const double t93 = lu[15]*(t89 + lu[101]*t92 + lu[102]*t91);
    const double t94 = lu[14]*(lu[95]*t93 - lu[96]*t92 - lu[97]*t91);
    const double t95 = lu[13]*(lu[87]*t94 - lu[88]*t93 + lu[89]*t92 + lu[90]*t91);
    const double t96 = lu[12]*(t95 + lu[78]*t94 - lu[79]*t93 + lu[80]*t92 + lu[81]*t91);
    G[90] = -t96;
    G[91] = t94;
    G[92] = -t95;
    G[93] = -t93;
    G[94] = t92;
    G[95] = t91;
    const double t97 = lu[1]*(t94 + lu[23]*t96 + lu[24]*t93 - lu[25]*t92 - lu[26]*t91);
    G[96] = -lu[0]*(t96 + lu[18]*t92 + lu[19]*t91 + lu[20]*t97);
    G[97] = t97;
    const double t98 = lu[3]*(t94 + lu[33]*t96 + lu[34]*t93 - lu[35]*t92 - lu[36]*t91);
    G[98] = -lu[2]*(t96 + lu[28]*t92 + lu[29]*t91 + lu[30]*t98);
    G[99] = t98;
    const double t99 = lu[5]*(t94 + lu[43]*t96 + lu[44]*t93 - lu[45]*t92 - lu[46]*t91);
    G[100] = -lu[4]*(t96 + lu[38]*t92 + lu[39]*t91 + lu[40]*t99);
    G[101] = t99;
    const double t100 = lu[7]*(lu[53]*t96 - t88 + t94 + lu[54]*t93 - lu[55]*t92 - lu[56]*t91);
    G[102] = -lu[6]*(J[72] + t96 + lu[48]*t92 + lu[49]*t91 + lu[50]*t100);
    G[103] = t100;
    const double t101 = lu[9]*(t94 + lu[63]*t96 + lu[64]*t93 - lu[65]*t92 - lu[66]*t91);
    G[104] = -lu[8]*(t96 + lu[58]*t92 + lu[59]*t91 + lu[60]*t101);
    G[105] = t101;
    const double t102 = lu[11]*(t94 + lu[73]*t96 + lu[74]*t93 - lu[75]*t92 - lu[76]*t91);
    G[106] = -lu[10]*(t96 + lu[68]*t92 + lu[69]*t91 + lu[70]*t102);
    G[107] = t102;
    const double t103 = J[102] - J[94]*lu[61];
    const double t104 = J[109] - J[94]*lu[62] - lu[67]*t103;
    const double t105 = lu[106]*t104*lu[17];
    const double t106 = lu[16]*(t104 + lu[105]*t105);
    const double t107 = lu[15]*(lu[101]*t106 - lu[102]*t105);
    const double t108 = lu[14]*(lu[95]*t107 - lu[96]*t106 + lu[97]*t105);
    const double t109 = lu[13]*(lu[87]*t108 - lu[88]*t107 + lu[89]*t106 - lu[90]*t105);
    const double t110 = lu[12]*(t109 + lu[78]*t108 - lu[79]*t107 + lu[80]*t106 - lu[81]*t105);
    G[108] = t110;
    G[109] = -t108;
    G[110] = t109;
    G[111] = t107;
    G[112] = -t106;
    G[113] = t105;
    const double t111 = lu[1]*(t108 + lu[23]*t110 + lu[24]*t107 - lu[25]*t106 + lu[26]*t105);
    G[114] = lu[0]*(t110 + lu[18]*t106 - lu[19]*t105 + lu[20]*t111);
    G[115] = -t111;
    const double t112 = lu[3]*(t108 + lu[33]*t110 + lu[34]*t107 - lu[35]*t106 + lu[36]*t105);
    G[116] = lu[2]*(t110 + lu[28]*t106 - lu[29]*t105 + lu[30]*t112);
    G[117] = -t112;
    const double t113 = lu[5]*(t108 + lu[43]*t110 + lu[44]*t107 - lu[45]*t106 + lu[46]*t105);
    G[118] = lu[4]*(t110 + lu[38]*t106 - lu[39]*t105 + lu[40]*t113);
    G[119] = -t113;
    const double t114 = lu[7]*(t108 + lu[53]*t110 + lu[54]*t107 - lu[55]*t106 + lu[56]*t105);
    G[120] = lu[6]*(t110 + lu[48]*t106 - lu[49]*t105 + lu[50]*t114);
    G[121] = -t114;
    const double t115 = t103 + lu[63]*t110 + t108 + lu[64]*t107 - lu[65]*t106 + lu[66]*t105;
    const double t116 = lu[9]*t115;
    G[122] = -lu[8]*(J[94] - t110 - lu[58]*t106 + lu[59]*t105 - lu[60]*t116);
    G[123] = -t116;
    const double t117 = lu[11]*(t108 + lu[73]*t110 + lu[74]*t107 - lu[75]*t106 + lu[76]*t105);
    G[124] = lu[10]*(t110 + lu[68]*t106 - lu[69]*t105 + lu[70]*t117);
    G[125] = -t117;
    const double t118 = J[124] - J[116]*lu[71];
    const double t119 = lu[17]*(J[131] - J[116]*lu[72] - lu[77]*t118);
    const double t120 = lu[105]*t119*lu[16];
    const double t121 = lu[15]*(lu[101]*t120 - lu[102]*t119);
    const double t122 = lu[14]*(lu[95]*t121 - lu[96]*t120 + lu[97]*t119);
    const double t123 = lu[13]*(lu[87]*t122 - lu[88]*t121 + lu[89]*t120 - lu[90]*t119);
    const double t124 = lu[12]*(t123 + lu[78]*t122 - lu[79]*t121 + lu[80]*t120 - lu[81]*t119);
    G[126] = -t124;
    G[127] = t122;
    G[128] = -t123;
    G[129] = -t121;
    G[130] = t120;
    G[131] = -t119;
    const double t125 = lu[1]*(t122 + lu[23]*t124 + lu[24]*t121 - lu[25]*t120 + lu[26]*t119);
    G[132] = -lu[0]*(t124 + lu[18]*t120 - lu[19]*t119 + lu[20]*t125);
    G[133] = t125;
    const double t126 = lu[3]*(t122 + lu[33]*t124 + lu[34]*t121 - lu[35]*t120 + lu[36]*t119);
    G[134] = -lu[2]*(t124 + lu[28]*t120 - lu[29]*t119 + lu[30]*t126);
    G[135] = t126;
    const double t127 = lu[5]*(t122 + lu[43]*t124 + lu[44]*t121 - lu[45]*t120 + lu[46]*t119);
    G[136] = -lu[4]*(t124 + lu[38]*t120 - lu[39]*t119 + lu[40]*t127);
    G[137] = t127;
    const double t128 = lu[7]*(t122 + lu[53]*t124 + lu[54]*t121 - lu[55]*t120 + lu[56]*t119);
    G[138] = -lu[6]*(t124 + lu[48]*t120 - lu[49]*t119 + lu[50]*t128);
    G[139] = t128;
    const double t129 = lu[9]*(t122 + lu[63]*t124 + lu[64]*t121 - lu[65]*t120 + lu[66]*t119);
    G[140] = -lu[8]*(t124 + lu[58]*t120 - lu[59]*t119 + lu[60]*t129);
    G[141] = t129;
    const double t130 = lu[73]*t124 - t118 + t122 + lu[74]*t121 - lu[75]*t120 + lu[76]*t119;
    const double t131 = lu[11]*t130;
    G[142] = -lu[10]*(J[116] + t124 + lu[68]*t120 - lu[69]*t119 + lu[70]*t131);
    G[143] = t131;
}

/* Bounds of the rows of J^-1 (K - J).
 * 252 additions, 113 multiplications. */
void evra_tree_turned(const double J[132], const double K[132], const double lu[107],
                      double MODELER_OUT(x, 18))
{
    const double k1 = fabs(1.0);

    const double t1 = fabs(J[16] - K[16]) + fabs(J[17] - K[17]) + fabs(J[18] - K[18]);
    const double t2 = fabs(J[1] - K[1]) + fabs(J[2] - K[2]) + fabs(J[4] - K[4]);
    const double t3 = t2 + fabs(J[5] - K[5]);
    const double t4 = fabs(J[8] - K[8]) + fabs(J[9] - K[9]) + fabs(J[10] - K[10]);
    const double t5 = t4 + fabs(J[12] - K[12]) + fabs(J[13] - K[13]) + t3*fabs(lu[21]);
    const double t6 = t1 + fabs(J[19] - K[19]) + fabs(J[20] - K[20]) + t3*fabs(lu[22]);
    const double t7 = t6 + t5*fabs(lu[27]);
    const double t8 = fabs(J[60] - K[60]) + fabs(J[61] - K[61]) + fabs(J[62] - K[62]);
    const double t9 = fabs(J[45] - K[45]) + fabs(J[46] - K[46]) + fabs(J[48] - K[48]);
    const double t10 = t9 + fabs(J[49] - K[49]);
    const double t11 = fabs(J[52] - K[52]) + fabs(J[53] - K[53]) + fabs(J[54] - K[54]);
    const double t12 = t11 + fabs(J[56] - K[56]) + fabs(J[57] - K[57]) + t10*fabs(lu[41]);
    const double t13 = t8 + fabs(J[63] - K[63]) + fabs(J[64] - K[64]) + t10*fabs(lu[42]);
    const double t14 = fabs(J[38] - K[38]) + fabs(J[39] - K[39]) + fabs(J[40] - K[40]);
    const double t15 = fabs(J[23] - K[23]) + fabs(J[24] - K[24]) + fabs(J[26] - K[26]);
    const double t16 = t15 + fabs(J[27] - K[27]);
    const double t17 = fabs(J[30] - K[30]) + fabs(J[31] - K[31]) + fabs(J[32] - K[32]);
    const double t18 = t17 + fabs(J[34] - K[34]) + fabs(J[35] - K[35]) + t16*fabs(lu[31]);
    const double t19 = t14 + fabs(J[41] - K[41]) + fabs(J[42] - K[42]) + t16*fabs(lu[32]);
    const double t20 = t19 + t18*fabs(lu[37]) + t7*fabs(lu[82]);
    const double t21 = t13 + t12*fabs(lu[47]) + t7*fabs(lu[83]) + t20*fabs(lu[91]);
    const double t22 = fabs(J[82] - K[82]) + fabs(J[83] - K[83]) + fabs(J[84] - K[84]);
    const double t23 = fabs(J[67] - K[67]) + fabs(J[68] - K[68]) + fabs(J[70] - K[70]);
    const double t24 = t23 + fabs(J[71] - K[71]);
    const double t25 = fabs(J[74] - K[74]) + fabs(J[75] - K[75]) + fabs(J[76] - K[76]);
    const double t26 = t25 + fabs(J[78] - K[78]) + fabs(J[79] - K[79]) + t24*fabs(lu[51]);
    const double t27 = t22 + fabs(J[85] - K[85]) + fabs(J[86] - K[86]) + t24*fabs(lu[52]);
    const double t28 = t27 + t26*fabs(lu[57]) + t7*fabs(lu[84]) + t20*fabs(lu[92]);
    const double t29 = t28 + t21*fabs(lu[98]);
    const double t30 = fabs(J[104] - K[104]) + fabs(J[105] - K[105]) + fabs(J[106] - K[106]);
    const double t31 = fabs(J[89] - K[89]) + fabs(J[90] - K[90]) + fabs(J[92] - K[92]);
    const double t32 = t31 + fabs(J[93] - K[93]);
    const double t33 = fabs(J[96] - K[96]) + fabs(J[97] - K[97]) + fabs(J[98] - K[98]);
    const double t34 = t33 + fabs(J[100] - K[100]) + fabs(J[101] - K[101]) + t32*fabs(lu[61]);
    const double t35 = t30 + fabs(J[107] - K[107]) + fabs(J[108] - K[108]) + t32*fabs(lu[62]);
    const double t36 = t35 + t34*fabs(lu[67]) + t7*fabs(lu[85]) + t20*fabs(lu[93]);
    const double t37 = t36 + t21*fabs(lu[99]) + t29*fabs(lu[103]);
    const double t38 = fabs(J[126] - K[126]) + fabs(J[127] - K[127]) + fabs(J[128] - K[128]);
    const double t39 = fabs(J[111] - K[111]) + fabs(J[112] - K[112]) + fabs(J[114] - K[114]);
    const double t40 = t39 + fabs(J[115] - K[115]);
    const double t41 = fabs(J[118] - K[118]) + fabs(J[119] - K[119]) + fabs(J[120] - K[120]);
    const double t42 = t41 + fabs(J[122] - K[122]) + fabs(J[123] - K[123]) + t40*fabs(lu[71]);
    const double t43 = t38 + fabs(J[129] - K[129]) + fabs(J[130] - K[130]) + t40*fabs(lu[72]);
    const double t44 = t43 + t42*fabs(lu[77]) + t7*fabs(lu[86]) + t20*fabs(lu[94]);
    const double t45 = t44 + t21*fabs(lu[100]) + t29*fabs(lu[104]) + t37*fabs(lu[106]);
    const double t46 = t45*fabs(lu[17]);
    const double t47 = (t37 + t46*fabs(lu[105]))*fabs(lu[16]);
    const double t48 = (t29 + t47*fabs(lu[101]) + t46*fabs(lu[102]))*fabs(lu[15]);
    const double t49 = t21 + t48*fabs(lu[95]) + t47*fabs(lu[96]) + t46*fabs(lu[97]);
    const double t50 = t49*fabs(lu[14]);
    const double t51 = t20 + t50*fabs(lu[87]) + t48*fabs(lu[88]) + t47*fabs(lu[89]);
    const double t52 = (t51 + t46*fabs(lu[90]))*fabs(lu[13]);
    const double t53 = t7 + t50*fabs(lu[78]) + k1*t52 + t48*fabs(lu[79]) + t47*fabs(lu[80]);
    const double t54 = (t53 + t46*fabs(lu[81]))*fabs(lu[12]);
    x[0] = (5.0/3.0)*t54;
    x[1] = (5.0/3.0)*t50;
    x[2] = (5.0/3.0)*t52;
    x[3] = t48;
    x[4] = t47;
    x[5] = t46;
    const double t55 = k1*t54;
    const double t56 = k1*t50;
    const double t57 = t5 + t54*fabs(lu[23]) + t56 + t48*fabs(lu[24]) + t47*fabs(lu[25]);
    const double t58 = (t57 + t46*fabs(lu[26]))*fabs(lu[1]);
    const double t59 = t3 + t55 + t47*fabs(lu[18]) + t46*fabs(lu[19]) + t58*fabs(lu[20]);
    x[6] = t59*fabs(lu[0]);
    x[7] = t58;
    const double t60 = t18 + t54*fabs(lu[33]) + t56 + t48*fabs(lu[34]) + t47*fabs(lu[35]);
    const double t61 = (t60 + t46*fabs(lu[36]))*fabs(lu[3]);
    const double t62 = t16 + t55 + t47*fabs(lu[28]) + t46*fabs(lu[29]) + t61*fabs(lu[30]);
    x[8] = t62*fabs(lu[2]);
    x[9] = t61;
    const double t63 = t12 + t54*fabs(lu[43]) + t56 + t48*fabs(lu[44]) + t47*fabs(lu[45]);
    const double t64 = (t63 + t46*fabs(lu[46]))*fabs(lu[5]);
    const double t65 = t10 + t55 + t47*fabs(lu[38]) + t46*fabs(lu[39]) + t64*fabs(lu[40]);
    x[10] = t65*fabs(lu[4]);
    x[11] = t64;
    const double t66 = t26 + t54*fabs(lu[53]) + t56 + t48*fabs(lu[54]) + t47*fabs(lu[55]);
    const double t67 = (t66 + t46*fabs(lu[56]))*fabs(lu[7]);
    const double t68 = t24 + t55 + t47*fabs(lu[48]) + t46*fabs(lu[49]) + t67*fabs(lu[50]);
    x[12] = t68*fabs(lu[6]);
    x[13] = t67;
    const double t69 = t34 + t54*fabs(lu[63]) + t56 + t48*fabs(lu[64]) + t47*fabs(lu[65]);
    const double t70 = (t69 + t46*fabs(lu[66]))*fabs(lu[9]);
    const double t71 = t32 + t55 + t47*fabs(lu[58]) + t46*fabs(lu[59]) + t70*fabs(lu[60]);
    x[14] = t71*fabs(lu[8]);
    x[15] = t70;
    const double t72 = t42 + t54*fabs(lu[73]) + t56 + t48*fabs(lu[74]) + t47*fabs(lu[75]);
    const double t73 = (t72 + t46*fabs(lu[76]))*fabs(lu[11]);
    const double t74 = t40 + t55 + t47*fabs(lu[68]) + t46*fabs(lu[69]) + t73*fabs(lu[70]);
    x[16] = t74*fabs(lu[10]);
    x[17] = t73;
}

/* Sum of the squares of J^-1 (K - J).
 * 1395 additions, 1618 multiplications. */
void evra_tree_spread(const double J[132], const double K[132], const double lu[107],
                      double MODELER_OUT(x, 1))
{
    const double t1 = J[30] - K[30];
    const double t2 = J[8] - K[8];
    const double t3 = J[16] - K[16] - lu[27]*t2;
    const double t4 = J[38] - K[38] - lu[37]*t1 - lu[82]*t3;
    const double t5 = J[52] - K[52];
    const double t6 = J[60] - K[60] - lu[47]*t5 - lu[83]*t3 - lu[91]*t4;
    const double t7 = J[74] - K[74];
    const double t8 = J[82] - K[82] - lu[57]*t7 - lu[84]*t3 - lu[92]*t4 - lu[98]*t6;
    const double t9 = J[96] - K[96];
    const double t10 = J[104] - K[104] - lu[67]*t9 - lu[85]*t3 - lu[93]*t4 - lu[99]*t6;
    const double t11 = t10 - lu[103]*t8;
    const double t12 = J[118] - K[118];
    const double t13 = J[126] - K[126] - lu[77]*t12 - lu[86]*t3 - lu[94]*t4 - lu[100]*t6;
    const double t14 = lu[17]*(t13 - lu[104]*t8 - lu[106]*t11);
    const double t15 = lu[16]*(t11 - lu[105]*t14);
    const double t16 = lu[15]*(t8 - lu[101]*t15 - lu[102]*t14);
    const double t17 = lu[14]*(t6 - lu[95]*t16 - lu[96]*t15 - lu[97]*t14);
    const double t18 = lu[13]*(t4 - lu[87]*t17 - lu[88]*t16 - lu[89]*t15 - lu[90]*t14);
    const double t19 = lu[12]*(t3 - lu[78]*t17 + t18 - lu[79]*t16 - lu[80]*t15 - lu[81]*t14);
    const double t20 = (5.0/3.0)*t19;
    const double t21 = (5.0/3.0)*t17;
    const double t22 = (5.0/3.0)*t18;
    const double t23 = lu[1]*(t2 - lu[23]*t19 + t17 - lu[24]*t16 - lu[25]*t15 - lu[26]*t14);
    const double t24 = lu[0]*(t19 - lu[18]*t15 - lu[19]*t14 - lu[20]*t23);
    const double t25 = t20*t20 + t21*t21 + t22*t22 + t16*t16 + t15*t15 + t14*t14 + t24*t24;
    const double t26 = lu[3]*(t1 - lu[33]*t19 + t17 - lu[34]*t16 - lu[35]*t15 - lu[36]*t14);
    const double t27 = lu[2]*(t19 - lu[28]*t15 - lu[29]*t14 - lu[30]*t26);
    const double t28 = lu[5]*(t5 - lu[43]*t19 + t17 - lu[44]*t16 - lu[45]*t15 - lu[46]*t14);
    const double t29 = lu[4]*(t19 - lu[38]*t15 - lu[39]*t14 - lu[40]*t28);
    const double t30 = lu[7]*(t7 - lu[53]*t19 + t17 - lu[54]*t16 - lu[55]*t15 - lu[56]*t14);
    const double t31 = lu[6]*(t19 - lu[48]*t15 - lu[49]*t14 - lu[50]*t30);
    const double t32 = lu[9]*(t9 - lu[63]*t19 + t17 - lu[64]*t16 - lu[65]*t15 - lu[66]*t14);
    const double t33 = lu[8]*(t19 - lu[58]*t15 - lu[59]*t14 - lu[60]*t32);
    const double t34 = t25 + t23*t23 + t27*t27 + t26*t26 + t29*t29 + t28*t28 + t31*t31 + t30*t30;
    const double t35 = lu[11]*(t12 - lu[73]*t19 + t17 - lu[74]*t16 - lu[75]*t15 - lu[76]*t14);
    const double t36 = lu[10]*(t19 - lu[68]*t15 - lu[69]*t14 - lu[70]*t35);
    const double t37 = J[23] - K[23];
    const double t38 = J[31] - K[31] - lu[31]*t37;
    const double t39 = J[1] - K[1];
    const double t40 = J[9] - K[9] - lu[21]*t39;
    const double t41 = J[17] - K[17] - lu[22]*t39 - lu[27]*t40;
    const double t42 = J[39] - K[39] - lu[32]*t37 - lu[37]*t38 - lu[82]*t41;
    const double t43 = J[45] - K[45];
    const double t44 = J[53] - K[53] - lu[41]*t43;
    const double t45 = J[61] - K[61] - lu[42]*t43 - lu[47]*t44 - lu[83]*t41 - lu[91]*t42;
    const double t46 = J[67] - K[67];
    const double t47 = J[75] - K[75] - lu[51]*t46;
    const double t48 = J[83] - K[83] - lu[52]*t46 - lu[57]*t47 - lu[84]*t41 - lu[92]*t42;
    const double t49 = t48 - lu[98]*t45;
    const double t50 = J[89] - K[89];
    const double t51 = J[97] - K[97] - lu[61]*t50;
    const double t52 = J[105] - K[105] - lu[62]*t50 - lu[67]*t51 - lu[85]*t41 - lu[93]*t42;
    const double t53 = t52 - lu[99]*t45 - lu[103]*t49;
    const double t54 = J[111] - K[111];
    const double t55 = J[119] - K[119] - lu[71]*t54;
    const double t56 = J[127] - K[127] - lu[72]*t54 - lu[77]*t55 - lu[86]*t41 - lu[94]*t42;
    const double t57 = lu[17]*(t56 - lu[100]*t45 - lu[104]*t49 - lu[106]*t53);
    const double t58 = lu[16]*(t53 - lu[105]*t57);
    const double t59 = lu[15]*(t49 - lu[101]*t58 - lu[102]*t57);
    const double t60 = lu[14]*(t45 - lu[95]*t59 - lu[96]*t58 - lu[97]*t57);
    const double t61 = lu[13]*(t42 - lu[87]*t60 - lu[88]*t59 - lu[89]*t58 - lu[90]*t57);
    const double t62 = lu[12]*(t41 - lu[78]*t60 + t61 - lu[79]*t59 - lu[80]*t58 - lu[81]*t57);
    const double t63 = (5.0/3.0)*t62;
    const double t64 = (5.0/3.0)*t60;
    const double t65 = (5.0/3.0)*t61;
    const double t66 = t34 + t33*t33 + t32*t32 + t36*t36 + t35*t35 + t63*t63 + t64*t64 + t65*t65;
    const double t67 = lu[1]*(t40 - lu[23]*t62 + t60 - lu[24]*t59 - lu[25]*t58 - lu[26]*t57);
    const double t68 = lu[0]*(t39 + t62 - lu[18]*t58 - lu[19]*t57 - lu[20]*t67);
    const double t69 = lu[3]*(t38 - lu[33]*t62 + t60 - lu[34]*t59 - lu[35]*t58 - lu[36]*t57);
    const double t70 = lu[2]*(t37 + t62 - lu[28]*t58 - lu[29]*t57 - lu[30]*t69);
    const double t71 = lu[5]*(t44 - lu[43]*t62 + t60 - lu[44]*t59 - lu[45]*t58 - lu[46]*t57);
    const double t72 = lu[4]*(t43 + t62 - lu[38]*t58 - lu[39]*t57 - lu[40]*t71);
    const double t73 = t66 + t59*t59 + t58*t58 + t57*t57 + t68*t68 + t67*t67 + t70*t70 + t69*t69;
    const double t74 = lu[7]*(t47 - lu[53]*t62 + t60 - lu[54]*t59 - lu[55]*t58 - lu[56]*t57);
    const double t75 = lu[6]*(t46 + t62 - lu[48]*t58 - lu[49]*t57 - lu[50]*t74);
    const double t76 = lu[9]*(t51 - lu[63]*t62 + t60 - lu[64]*t59 - lu[65]*t58 - lu[66]*t57);
    const double t77 = lu[8]*(t50 + t62 - lu[58]*t58 - lu[59]*t57 - lu[60]*t76);
    const double t78 = lu[11]*(t55 - lu[73]*t62 + t60 - lu[74]*t59 - lu[75]*t58 - lu[76]*t57);
    const double t79 = lu[10]*(t54 + t62 - lu[68]*t58 - lu[69]*t57 - lu[70]*t78);
    const double t80 = t73 + t72*t72 + t71*t71 + t75*t75 + t74*t74 + t77*t77 + t76*t76 + t79*t79;
    const double t81 = J[24] - K[24];
    const double t82 = J[32] - K[32] - lu[31]*t81;
    const double t83 = J[2] - K[2];
    const double t84 = J[10] - K[10] - lu[21]*t83;
    const double t85 = J[18] - K[18] - lu[22]*t83 - lu[27]*t84;
    const double t86 = J[40] - K[40] - lu[32]*t81 - lu[37]*t82 - lu[82]*t85;
    const double t87 = J[46] - K[46];
    const double t88 = J[54] - K[54] - lu[41]*t87;
    const double t89 = J[62] - K[62] - lu[42]*t87 - lu[47]*t88 - lu[83]*t85 - lu[91]*t86;
    const double t90 = J[68] - K[68];
    const double t91 = J[76] - K[76] - lu[51]*t90;
    const double t92 = J[84] - K[84] - lu[52]*t90 - lu[57]*t91 - lu[84]*t85 - lu[92]*t86;
    const double t93 = t92 - lu[98]*t89;
    const double t94 = J[90] - K[90];
    const double t95 = J[98] - K[98] - lu[61]*t94;
    const double t96 = J[106] - K[106] - lu[62]*t94 - lu[67]*t95 - lu[85]*t85 - lu[93]*t86;
    const double t97 = t96 - lu[99]*t89 - lu[103]*t93;
    const double t98 = J[112] - K[112];
    const double t99 = J[120] - K[120] - lu[71]*t98;
    const double t100 = J[128] - K[128] - lu[72]*t98 - lu[77]*t99 - lu[86]*t85 - lu[94]*t86;
    const double t101 = lu[17]*(t100 - lu[100]*t89 - lu[104]*t93 - lu[106]*t97);
    const double t102 = lu[16]*(t97 - lu[105]*t101);
    const double t103 = lu[15]*(t93 - lu[101]*t102 - lu[102]*t101);
    const double t104 = lu[14]*(t89 - lu[95]*t103 - lu[96]*t102 - lu[97]*t101);
    const double t105 = lu[13]*(t86 - lu[87]*t104 - lu[88]*t103 - lu[89]*t102 - lu[90]*t101);
    const double t106 = t85 - lu[78]*t104 + t105 - lu[79]*t103 - lu[80]*t102 - lu[81]*t101;
    const double t107 = lu[12]*t106;
    const double t108 = (5.0/3.0)*t107;
    const double t109 = (5.0/3.0)*t104;
    const double t110 = (5.0/3.0)*t105;
    const double t111 = t80 + t78*t78 + t108*t108 + t109*t109 + t110*t110 + t103*t103 + t102*t102;
    const double t112 = lu[1]*(t84 - lu[23]*t107 + t104 - lu[24]*t103 - lu[25]*t102 - lu[26]*t101);
    const double t113 = lu[0]*(t83 + t107 - lu[18]*t102 - lu[19]*t101 - lu[20]*t112);
    const double t114 = lu[3]*(t82 - lu[33]*t107 + t104 - lu[34]*t103 - lu[35]*t102 - lu[36]*t101);
    const double t115 = lu[2]*(t81 + t107 - lu[28]*t102 - lu[29]*t101 - lu[30]*t114);
    const double t116 = lu[5]*(t88 - lu[43]*t107 + t104 - lu[44]*t103 - lu[45]*t102 - lu[46]*t101);
    const double t117 = lu[4]*(t87 + t107 - lu[38]*t102 - lu[39]*t101 - lu[40]*t116);
    const double t118 = t111 + t101*t101 + t113*t113 + t112*t112 + t115*t115 + t114*t114;
    const double t119 = lu[7]*(t91 - lu[53]*t107 + t104 - lu[54]*t103 - lu[55]*t102 - lu[56]*t101);
    const double t120 = lu[6]*(t90 + t107 - lu[48]*t102 - lu[49]*t101 - lu[50]*t119);
    const double t121 = lu[9]*(t95 - lu[63]*t107 + t104 - lu[64]*t103 - lu[65]*t102 - lu[66]*t101);
    const double t122 = lu[8]*(t94 + t107 - lu[58]*t102 - lu[59]*t101 - lu[60]*t121);
    const double t123 = t118 + t117*t117 + t116*t116 + t120*t120 + t119*t119 + t122*t122;
    const double t124 = t99 - lu[73]*t107 + t104 - lu[74]*t103 - lu[75]*t102 - lu[76]*t101;
    const double t125 = lu[11]*t124;
    const double t126 = lu[10]*(t98 + t107 - lu[68]*t102 - lu[69]*t101 - lu[70]*t125);
    const double t127 = J[4] - K[4];
    const double t128 = J[12] - K[12] - lu[21]*t127;
    const double t129 = J[19] - K[19] - lu[22]*t127 - lu[27]*t128;
    const double t130 = lu[82]*t129;
    const double t131 = lu[83]*t129 - lu[91]*t130;
    const double t132 = lu[84]*t129 - lu[92]*t130 - lu[98]*t131;
    const double t133 = lu[85]*t129 - lu[93]*t130 - lu[99]*t131 - lu[103]*t132;
    const double t134 = lu[86]*t129 - lu[94]*t130 - lu[100]*t131 - lu[104]*t132 - lu[106]*t133;
    const double t135 = lu[17]*t134;
    const double t136 = lu[16]*(t133 - lu[105]*t135);
    const double t137 = lu[15]*(t132 - lu[101]*t136 - lu[102]*t135);
    const double t138 = lu[14]*(t131 - lu[95]*t137 - lu[96]*t136 - lu[97]*t135);
    const double t139 = lu[13]*(t130 - lu[87]*t138 - lu[88]*t137 - lu[89]*t136 - lu[90]*t135);
    const double t140 = t139 - (t129 + lu[78]*t138) - lu[79]*t137 - lu[80]*t136 - lu[81]*t135;
    const double t141 = lu[12]*t140;
    const double t142 = (5.0/3.0)*t141;
    const double t143 = (5.0/3.0)*t138;
    const double t144 = (5.0/3.0)*t139;
    const double t145 = t123 + t121*t121 + t126*t126 + t125*t125 + t142*t142 + t143*t143;
    const double t146 = t138 - (t128 + lu[23]*t141) - lu[24]*t137 - lu[25]*t136 - lu[26]*t135;
    const double t147 = lu[1]*t146;
    const double t148 = lu[0]*(t127 - t141 + lu[18]*t136 + lu[19]*t135 + lu[20]*t147);
    const double t149 = t145 + t144*t144 + t137*t137 + t136*t136 + t135*t135 + t148*t148;
    const double t150 = lu[3]*(t138 - lu[33]*t141 - lu[34]*t137 - lu[35]*t136 - lu[36]*t135);
    const double t151 = lu[2]*(t141 - lu[28]*t136 - lu[29]*t135 - lu[30]*t150);
    const double t152 = lu[5]*(t138 - lu[43]*t141 - lu[44]*t137 - lu[45]*t136 - lu[46]*t135);
    const double t153 = lu[4]*(t141 - lu[38]*t136 - lu[39]*t135 - lu[40]*t152);
    const double t154 = lu[7]*(t138 - lu[53]*t141 - lu[54]*t137 - lu[55]*t136 - lu[56]*t135);
    const double t155 = lu[6]*(t141 - lu[48]*t136 - lu[49]*t135 - lu[50]*t154);
    const double t156 = t149 + t147*t147 + t151*t151 + t150*t150 + t153*t153 + t152*t152;
    const double t157 = lu[9]*(t138 - lu[63]*t141 - lu[64]*t137 - lu[65]*t136 - lu[66]*t135);
    const double t158 = lu[8]*(t141 - lu[58]*t136 - lu[59]*t135 - lu[60]*t157);
    const double t159 = lu[11]*(t138 - lu[73]*t141 - lu[74]*t137 - lu[75]*t136 - lu[76]*t135);
    const double t160 = lu[10]*(t141 - lu[68]*t136 - lu[69]*t135 - lu[70]*t159);
    const double t161 = t156 + t155*t155 + t154*t154 + t158*t158 + t157*t157 + t160*t160;
    const double t162 = J[5] - K[5];
    const double t163 = J[13] - K[13] - lu[21]*t162;
    const double t164 = J[20] - K[20] - lu[22]*t162 - lu[27]*t163;
    const double t165 = lu[82]*t164;
    const double t166 = lu[83]*t164 - lu[91]*t165;
    const double t167 = lu[84]*t164 - lu[92]*t165 - lu[98]*t166;
    const double t168 = lu[85]*t164 - lu[93]*t165 - lu[99]*t166 - lu[103]*t167;
    const double t169 = lu[86]*t164 - lu[94]*t165 - lu[100]*t166 - lu[104]*t167 - lu[106]*t168;
    const double t170 = lu[17]*t169;
    const double t171 = lu[16]*(t168 - lu[105]*t170);
    const double t172 = lu[15]*(t167 - lu[101]*t171 - lu[102]*t170);
    const double t173 = lu[14]*(t166 - lu[95]*t172 - lu[96]*t171 - lu[97]*t170);
    const double t174 = lu[13]*(t165 - lu[87]*t173 - lu[88]*t172 - lu[89]*t171 - lu[90]*t170);
    const double t175 = t174 - (t164 + lu[78]*t173) - lu[79]*t172 - lu[80]*t171 - lu[81]*t170;
    const double t176 = lu[12]*t175;
    const double t177 = (5.0/3.0)*t176;
    const double t178 = (5.0/3.0)*t173;
    const double t179 = (5.0/3.0)*t174;
    const double t180 = t161 + t159*t159 + t177*t177 + t178*t178 + t179*t179 + t172*t172;
    const double t181 = t173 - (t163 + lu[23]*t176) - lu[24]*t172 - lu[25]*t171 - lu[26]*t170;
    const double t182 = lu[1]*t181;
    const double t183 = lu[0]*(t162 - t176 + lu[18]*t171 + lu[19]*t170 + lu[20]*t182);
    const double t184 = lu[3]*(t173 - lu[33]*t176 - lu[34]*t172 - lu[35]*t171 - lu[36]*t170);
    const double t185 = lu[2]*(t176 - lu[28]*t171 - lu[29]*t170 - lu[30]*t184);
    const double t186 = t180 + t171*t171 + t170*t170 + t183*t183 + t182*t182 + t185*t185;
    const double t187 = lu[5]*(t173 - lu[43]*t176 - lu[44]*t172 - lu[45]*t171 - lu[46]*t170);
    const double t188 = lu[4]*(t176 - lu[38]*t171 - lu[39]*t170 - lu[40]*t187);
    const double t189 = lu[7]*(t173 - lu[53]*t176 - lu[54]*t172 - lu[55]*t171 - lu[56]*t170);
    const double t190 = lu[6]*(t176 - lu[48]*t171 - lu[49]*t170 - lu[50]*t189);
    const double t191 = lu[9]*(t173 - lu[63]*t176 - lu[64]*t172 - lu[65]*t171 - lu[66]*t170);
    const double t192 = lu[8]*(t176 - lu[58]*t171 - lu[59]*t170 - lu[60]*t191);
    const double t193 = t186 + t184*t184 + t188*t188 + t187*t187 + t190*t190 + t189*t189;
    const double t194 = lu[11]*(t173 - lu[73]*t176 - lu[74]*t172 - lu[75]*t171 - lu[76]*t170);
    const double t195 = lu[10]*(t176 - lu[68]*t171 - lu[69]*t170 - lu[70]*t194);
    const double t196 = J[26] - K[26];
    const double t197 = J[34] - K[34] - lu[31]*t196;
    const double t198 = J[41] - K[41] - lu[32]*t196 - lu[37]*t197;
    const double t199 = lu[91]*t198;
    const double t200 = lu[92]*t198 - lu[98]*t199;
    const double t201 = lu[93]*t198 - lu[99]*t199 - lu[103]*t200;
    const double t202 = lu[17]*(lu[94]*t198 - lu[100]*t199 - lu[104]*t200 - lu[106]*t201);
    const double t203 = lu[16]*(t201 - lu[105]*t202);
    const double t204 = lu[15]*(t200 - lu[101]*t203 - lu[102]*t202);
    const double t205 = lu[14]*(t199 - lu[95]*t204 - lu[96]*t203 - lu[97]*t202);
    const double t206 = lu[13]*(t198 + lu[87]*t205 + lu[88]*t204 + lu[89]*t203 + lu[90]*t202);
    const double t207 = lu[12]*(t206 + lu[78]*t205 + lu[79]*t204 + lu[80]*t203 + lu[81]*t202);
    const double t208 = (5.0/3.0)*t207;
    const double t209 = (5.0/3.0)*t205;
    const double t210 = t193 + t192*t192 + t191*t191 + t195*t195 + t194*t194 + t208*t208;
    const double t211 = (5.0/3.0)*t206;
    const double t212 = lu[1]*(t205 + lu[23]*t207 - lu[24]*t204 - lu[25]*t203 - lu[26]*t202);
    const double t213 = lu[0]*(t207 + lu[18]*t203 + lu[19]*t202 + lu[20]*t212);
    const double t214 = t210 + t209*t209 + t211*t211 + t204*t204 + t203*t203 + t202*t202;
    const double t215 = lu[33]*t207 - t197 + t205 - lu[34]*t204 - lu[35]*t203 - lu[36]*t202;
    const double t216 = lu[3]*t215;
    const double t217 = lu[2]*(t196 + t207 + lu[28]*t203 + lu[29]*t202 + lu[30]*t216);
    const double t218 = lu[5]*(t205 + lu[43]*t207 - lu[44]*t204 - lu[45]*t203 - lu[46]*t202);
    const double t219 = lu[4]*(t207 + lu[38]*t203 + lu[39]*t202 + lu[40]*t218);
    const double t220 = t214 + t213*t213 + t212*t212 + t217*t217 + t216*t216 + t219*t219;
    const double t221 = lu[7]*(t205 + lu[53]*t207 - lu[54]*t204 - lu[55]*t203 - lu[56]*t202);
    const double t222 = lu[6]*(t207 + lu[48]*t203 + lu[49]*t202 + lu[50]*t221);
    const double t223 = lu[9]*(t205 + lu[63]*t207 - lu[64]*t204 - lu[65]*t203 - lu[66]*t202);
    const double t224 = lu[8]*(t207 + lu[58]*t203 + lu[59]*t202 + lu[60]*t223);
    const double t225 = lu[11]*(t205 + lu[73]*t207 - lu[74]*t204 - lu[75]*t203 - lu[76]*t202);
    const double t226 = lu[10]*(t207 + lu[68]*t203 + lu[69]*t202 + lu[70]*t225);
    const double t227 = t220 + t218*t218 + t222*t222 + t221*t221 + t224*t224 + t223*t223;
    const double t228 = J[27] - K[27];
    const double t229 = J[35] - K[35] - lu[31]*t228;
    const double t230 = J[42] - K[42] - lu[32]*t228 - lu[37]*t229;
    const double t231 = lu[91]*t230;
    const double t232 = lu[92]*t230 - lu[98]*t231;
    const double t233 = lu[93]*t230 - lu[99]*t231 - lu[103]*t232;
    const double t234 = lu[17]*(lu[94]*t230 - lu[100]*t231 - lu[104]*t232 - lu[106]*t233);
    const double t235 = lu[16]*(t233 - lu[105]*t234);
    const double t236 = lu[15]*(t232 - lu[101]*t235 - lu[102]*t234);
    const double t237 = lu[14]*(t231 - lu[95]*t236 - lu[96]*t235 - lu[97]*t234);
    const double t238 = lu[13]*(t230 + lu[87]*t237 + lu[88]*t236 + lu[89]*t235 + lu[90]*t234);
    const double t239 = lu[12]*(t238 + lu[78]*t237 + lu[79]*t236 + lu[80]*t235 + lu[81]*t234);
    const double t240 = (5.0/3.0)*t239;
    const double t241 = (5.0/3.0)*t237;
    const double t242 = (5.0/3.0)*t238;
    const double t243 = t227 + t226*t226 + t225*t225 + t240*t240 + t241*t241 + t242*t242;
    const double t244 = lu[1]*(t237 + lu[23]*t239 - lu[24]*t236 - lu[25]*t235 - lu[26]*t234);
    const double t245 = lu[0]*(t239 + lu[18]*t235 + lu[19]*t234 + lu[20]*t244);
    const double t246 = lu[33]*t239 - t229 + t237 - lu[34]*t236 - lu[35]*t235 - lu[36]*t234;
    const double t247 = lu[3]*t246;
    const double t248 = lu[2]*(t228 + t239 + lu[28]*t235 + lu[29]*t234 + lu[30]*t247);
    const double t249 = t243 + t236*t236 + t235*t235 + t234*t234 + t245*t245 + t244*t244;
    const double t250 = lu[5]*(t237 + lu[43]*t239 - lu[44]*t236 - lu[45]*t235 - lu[46]*t234);
    const double t251 = lu[4]*(t239 + lu[38]*t235 + lu[39]*t234 + lu[40]*t250);
    const double t252 = lu[7]*(t237 + lu[53]*t239 - lu[54]*t236 - lu[55]*t235 - lu[56]*t234);
    const double t253 = lu[6]*(t239 + lu[48]*t235 + lu[49]*t234 + lu[50]*t252);
    const double t254 = t249 + t248*t248 + t247*t247 + t251*t251 + t250*t250 + t253*t253;
    const double t255 = lu[9]*(t237 + lu[63]*t239 - lu[64]*t236 - lu[65]*t235 - lu[66]*t234);
    const double t256 = lu[8]*(t239 + lu[58]*t235 + lu[59]*t234 + lu[60]*t255);
    const double t257 = lu[11]*(t237 + lu[73]*t239 - lu[74]*t236 - lu[75]*t235 - lu[76]*t234);
    const double t258 = lu[10]*(t239 + lu[68]*t235 + lu[69]*t234 + lu[70]*t257);
    const double t259 = J[48] - K[48];
    const double t260 = J[56] - K[56] - lu[41]*t259;
    const double t261 = J[63] - K[63] - lu[42]*t259 - lu[47]*t260;
    const double t262 = lu[98]*t261;
    const double t263 = lu[99]*t261 - lu[103]*t262;
    const double t264 = lu[17]*(lu[100]*t261 - lu[104]*t262 - lu[106]*t263);
    const double t265 = lu[16]*(t263 - lu[105]*t264);
    const double t266 = lu[15]*(t262 - lu[101]*t265 - lu[102]*t264);
    const double t267 = lu[14]*(t261 + lu[95]*t266 + lu[96]*t265 + lu[97]*t264);
    const double t268 = lu[13]*(lu[87]*t267 - lu[88]*t266 - lu[89]*t265 - lu[90]*t264);
    const double t269 = lu[12]*(t268 + lu[78]*t267 - lu[79]*t266 - lu[80]*t265 - lu[81]*t264);
    const double t270 = (5.0/3.0)*t269;
    const double t271 = t254 + t252*t252 + t256*t256 + t255*t255 + t258*t258 + t257*t257;
    const double t272 = (5.0/3.0)*t267;
    const double t273 = (5.0/3.0)*t268;
    const double t274 = t271 + t270*t270 + t272*t272 + t273*t273 + t266*t266 + t265*t265;
    const double t275 = lu[1]*(t267 + lu[23]*t269 + lu[24]*t266 + lu[25]*t265 + lu[26]*t264);
    const double t276 = lu[0]*(t269 - lu[18]*t265 - lu[19]*t264 + lu[20]*t275);
    const double t277 = lu[3]*(t267 + lu[33]*t269 + lu[34]*t266 + lu[35]*t265 + lu[36]*t264);
    const double t278 = lu[2]*(t269 - lu[28]*t265 - lu[29]*t264 + lu[30]*t277);
    const double t279 = t260 + lu[43]*t269 + t267 + lu[44]*t266 + lu[45]*t265 + lu[46]*t264;
    const double t280 = lu[5]*t279;
    const double t281 = lu[4]*(t259 - t269 + lu[38]*t265 + lu[39]*t264 - lu[40]*t280);
    const double t282 = t274 + t264*t264 + t276*t276 + t275*t275 + t278*t278 + t277*t277;
    const double t283 = lu[7]*(t267 + lu[53]*t269 + lu[54]*t266 + lu[55]*t265 + lu[56]*t264);
    const double t284 = lu[6]*(t269 - lu[48]*t265 - lu[49]*t264 + lu[50]*t283);
    const double t285 = lu[9]*(t267 + lu[63]*t269 + lu[64]*t266 + lu[65]*t265 + lu[66]*t264);
    const double t286 = lu[8]*(t269 - lu[58]*t265 - lu[59]*t264 + lu[60]*t285);
    const double t287 = t282 + t281*t281 + t280*t280 + t284*t284 + t283*t283 + t286*t286;
    const double t288 = lu[11]*(t267 + lu[73]*t269 + lu[74]*t266 + lu[75]*t265 + lu[76]*t264);
    const double t289 = lu[10]*(t269 - lu[68]*t265 - lu[69]*t264 + lu[70]*t288);
    const double t290 = J[49] - K[49];
    const double t291 = J[57] - K[57] - lu[41]*t290;
    const double t292 = J[64] - K[64] - lu[42]*t290 - lu[47]*t291;
    const double t293 = lu[98]*t292;
    const double t294 = lu[99]*t292 - lu[103]*t293;
    const double t295 = lu[17]*(lu[100]*t292 - lu[104]*t293 - lu[106]*t294);
    const double t296 = lu[16]*(t294 - lu[105]*t295);
    const double t297 = lu[15]*(t293 - lu[101]*t296 - lu[102]*t295);
    const double t298 = lu[14]*(t292 + lu[95]*t297 + lu[96]*t296 + lu[97]*t295);
    const double t299 = lu[13]*(lu[87]*t298 - lu[88]*t297 - lu[89]*t296 - lu[90]*t295);
    const double t300 = lu[12]*(t299 + lu[78]*t298 - lu[79]*t297 - lu[80]*t296 - lu[81]*t295);
    const double t301 = (5.0/3.0)*t300;
    const double t302 = (5.0/3.0)*t298;
    const double t303 = (5.0/3.0)*t299;
    const double t304 = t287 + t285*t285 + t289*t289 + t288*t288 + t301*t301 + t302*t302;
    const double t305 = lu[1]*(t298 + lu[23]*t300 + lu[24]*t297 + lu[25]*t296 + lu[26]*t295);
    const double t306 = lu[0]*(t300 - lu[18]*t296 - lu[19]*t295 + lu[20]*t305);
    const double t307 = t304 + t303*t303 + t297*t297 + t296*t296 + t295*t295 + t306*t306;
    const double t308 = lu[3]*(t298 + lu[33]*t300 + lu[34]*t297 + lu[35]*t296 + lu[36]*t295);
    const double t309 = lu[2]*(t300 - lu[28]*t296 - lu[29]*t295 + lu[30]*t308);
    const double t310 = t291 + lu[43]*t300 + t298 + lu[44]*t297 + lu[45]*t296 + lu[46]*t295;
    const double t311 = lu[5]*t310;
    const double t312 = lu[4]*(t290 - t300 + lu[38]*t296 + lu[39]*t295 - lu[40]*t311);
    const double t313 = lu[7]*(t298 + lu[53]*t300 + lu[54]*t297 + lu[55]*t296 + lu[56]*t295);
    const double t314 = lu[6]*(t300 - lu[48]*t296 - lu[49]*t295 + lu[50]*t313);
    const double t315 = t307 + t305*t305 + t309*t309 + t308*t308 + t312*t312 + t311*t311;
    const double t316 = lu[9]*(t298 + lu[63]*t300 + lu[64]*t297 + lu[65]*t296 + lu[66]*t295);
    const double t317 = lu[8]*(t300 - lu[58]*t296 - lu[59]*t295 + lu[60]*t316);
    const double t318 = lu[11]*(t298 + lu[73]*t300 + lu[74]*t297 + lu[75]*t296 + lu[76]*t295);
    const double t319 = lu[10]*(t300 - lu[68]*t296 - lu[69]*t295 + lu[70]*t318);
    const double t320 = t315 + t314*t314 + t313*t313 + t317*t317 + t316*t316 + t319*t319;
    const double t321 = J[70] - K[70];
    const double t322 = J[78] - K[78] - lu[51]*t321;
    const double t323 = J[85] - K[85] - lu[52]*t321 - lu[57]*t322;
    const double t324 = lu[103]*t323;
    const double t325 = lu[17]*(lu[104]*t323 - lu[106]*t324);
    const double t326 = lu[16]*(t324 - lu[105]*t325);
    const double t327 = lu[15]*(t323 + lu[101]*t326 + lu[102]*t325);
    const double t328 = lu[14]*(lu[95]*t327 - lu[96]*t326 - lu[97]*t325);
    const double t329 = lu[13]*(lu[87]*t328 - lu[88]*t327 + lu[89]*t326 + lu[90]*t325);
    const double t330 = lu[12]*(t329 + lu[78]*t328 - lu[79]*t327 + lu[80]*t326 + lu[81]*t325);
    const double t331 = (5.0/3.0)*t330;
    const double t332 = (5.0/3.0)*t328;
    const double t333 = (5.0/3.0)*t329;
    const double t334 = t320 + t318*t318 + t331*t331 + t332*t332 + t333*t333 + t327*t327;
    const double t335 = lu[1]*(t328 + lu[23]*t330 + lu[24]*t327 - lu[25]*t326 - lu[26]*t325);
    const double t336 = lu[0]*(t330 + lu[18]*t326 + lu[19]*t325 + lu[20]*t335);
    const double t337 = lu[3]*(t328 + lu[33]*t330 + lu[34]*t327 - lu[35]*t326 - lu[36]*t325);
    const double t338 = lu[2]*(t330 + lu[28]*t326 + lu[29]*t325 + lu[30]*t337);
    const double t339 = t334 + t326*t326 + t325*t325 + t336*t336 + t335*t335 + t338*t338;
    const double t340 = lu[5]*(t328 + lu[43]*t330 + lu[44]*t327 - lu[45]*t326 - lu[46]*t325);
    const double t341 = lu[4]*(t330 + lu[38]*t326 + lu[39]*t325 + lu[40]*t340);
    const double t342 = lu[53]*t330 - t322 + t328 + lu[54]*t327 - lu[55]*t326 - lu[56]*t325;
    const double t343 = lu[7]*t342;
    const double t344 = lu[6]*(t321 + t330 + lu[48]*t326 + lu[49]*t325 + lu[50]*t343);
    const double t345 = lu[9]*(t328 + lu[63]*t330 + lu[64]*t327 - lu[65]*t326 - lu[66]*t325);
    const double t346 = lu[8]*(t330 + lu[58]*t326 + lu[59]*t325 + lu[60]*t345);
    const double t347 = t339 + t337*t337 + t341*t341 + t340*t340 + t344*t344 + t343*t343;
    const double t348 = lu[11]*(t328 + lu[73]*t330 + lu[74]*t327 - lu[75]*t326 - lu[76]*t325);
    const double t349 = lu[10]*(t330 + lu[68]*t326 + lu[69]*t325 + lu[70]*t348);
    const double t350 = J[71] - K[71];
    const double t351 = J[79] - K[79] - lu[51]*t350;
    const double t352 = J[86] - K[86] - lu[52]*t350 - lu[57]*t351;
    const double t353 = lu[103]*t352;
    const double t354 = lu[17]*(lu[104]*t352 - lu[106]*t353);
    const double t355 = lu[16]*(t353 - lu[105]*t354);
    const double t356 = lu[15]*(t352 + lu[101]*t355 + lu[102]*t354);
    const double t357 = lu[14]*(lu[95]*t356 - lu[96]*t355 - lu[97]*t354);
    const double t358 = lu[13]*(lu[87]*t357 - lu[88]*t356 + lu[89]*t355 + lu[90]*t354);
    const double t359 = lu[12]*(t358 + lu[78]*t357 - lu[79]*t356 + lu[80]*t355 + lu[81]*t354);
    const double t360 = (5.0/3.0)*t359;
    const double t361 = (5.0/3.0)*t357;
    const double t362 = t347 + t346*t346 + t345*t345 + t349*t349 + t348*t348 + t360*t360;
    const double t363 = (5.0/3.0)*t358;
    const double t364 = lu[1]*(t357 + lu[23]*t359 + lu[24]*t356 - lu[25]*t355 - lu[26]*t354);
    const double t365 = lu[0]*(t359 + lu[18]*t355 + lu[19]*t354 + lu[20]*t364);
    const double t366 = t362 + t361*t361 + t363*t363 + t356*t356 + t355*t355 + t354*t354;
    const double t367 = lu[3]*(t357 + lu[33]*t359 + lu[34]*t356 - lu[35]*t355 - lu[36]*t354);
    const double t368 = lu[2]*(t359 + lu[28]*t355 + lu[29]*t354 + lu[30]*t367);
    const double t369 = lu[5]*(t357 + lu[43]*t359 + lu[44]*t356 - lu[45]*t355 - lu[46]*t354);
    const double t370 = lu[4]*(t359 + lu[38]*t355 + lu[39]*t354 + lu[40]*t369);
    const double t371 = t366 + t365*t365 + t364*t364 + t368*t368 + t367*t367 + t370*t370;
    const double t372 = lu[53]*t359 - t351 + t357 + lu[54]*t356 - lu[55]*t355 - lu[56]*t354;
    const double t373 = lu[7]*t372;
    const double t374 = lu[6]*(t350 + t359 + lu[48]*t355 + lu[49]*t354 + lu[50]*t373);
    const double t375 = lu[9]*(t357 + lu[63]*t359 + lu[64]*t356 - lu[65]*t355 - lu[66]*t354);
    const double t376 = lu[8]*(t359 + lu[58]*t355 + lu[59]*t354 + lu[60]*t375);
    const double t377 = lu[11]*(t357 + lu[73]*t359 + lu[74]*t356 - lu[75]*t355 - lu[76]*t354);
    const double t378 = lu[10]*(t359 + lu[68]*t355 + lu[69]*t354 + lu[70]*t377);
    const double t379 = t371 + t369*t369 + t374*t374 + t373*t373 + t376*t376 + t375*t375;
    const double t380 = J[92] - K[92];
    const double t381 = J[100] - K[100] - lu[61]*t380;
    const double t382 = J[107] - K[107] - lu[62]*t380 - lu[67]*t381;
    const double t383 = lu[106]*t382*lu[17];
    const double t384 = lu[16]*(t382 + lu[105]*t383);
    const double t385 = lu[15]*(lu[101]*t384 - lu[102]*t383);
    const double t386 = lu[14]*(lu[95]*t385 - lu[96]*t384 + lu[97]*t383);
    const double t387 = lu[13]*(lu[87]*t386 - lu[88]*t385 + lu[89]*t384 - lu[90]*t383);
    const double t388 = lu[12]*(t387 + lu[78]*t386 - lu[79]*t385 + lu[80]*t384 - lu[81]*t383);
    const double t389 = (5.0/3.0)*t388;
    const double t390 = (5.0/3.0)*t386;
    const double t391 = (5.0/3.0)*t387;
    const double t392 = t379 + t378*t378 + t377*t377 + t389*t389 + t390*t390 + t391*t391;
    const double t393 = lu[1]*(t386 + lu[23]*t388 + lu[24]*t385 - lu[25]*t384 + lu[26]*t383);
    const double t394 = lu[0]*(t388 + lu[18]*t384 - lu[19]*t383 + lu[20]*t393);
    const double t395 = lu[3]*(t386 + lu[33]*t388 + lu[34]*t385 - lu[35]*t384 + lu[36]*t383);
    const double t396 = lu[2]*(t388 + lu[28]*t384 - lu[29]*t383 + lu[30]*t395);
    const double t397 = t392 + t385*t385 + t384*t384 + t383*t383 + t394*t394 + t393*t393;
    const double t398 = lu[5]*(t386 + lu[43]*t388 + lu[44]*t385 - lu[45]*t384 + lu[46]*t383);
    const double t399 = lu[4]*(t388 + lu[38]*t384 - lu[39]*t383 + lu[40]*t398);
    const double t400 = lu[7]*(t386 + lu[53]*t388 + lu[54]*t385 - lu[55]*t384 + lu[56]*t383);
    const double t401 = lu[6]*(t388 + lu[48]*t384 - lu[49]*t383 + lu[50]*t400);
    const double t402 = t397 + t396*t396 + t395*t395 + t399*t399 + t398*t398 + t401*t401;
    const double t403 = t381 + lu[63]*t388 + t386 + lu[64]*t385 - lu[65]*t384 + lu[66]*t383;
    const double t404 = lu[9]*t403;
    const double t405 = lu[8]*(t380 - t388 - lu[58]*t384 + lu[59]*t383 - lu[60]*t404);
    const double t406 = lu[11]*(t386 + lu[73]*t388 + lu[74]*t385 - lu[75]*t384 + lu[76]*t383);
    const double t407 = lu[10]*(t388 + lu[68]*t384 - lu[69]*t383 + lu[70]*t406);
    const double t408 = J[93] - K[93];
    const double t409 = J[101] - K[101] - lu[61]*t408;
    const double t410 = J[108] - K[108] - lu[62]*t408 - lu[67]*t409;
    const double t411 = lu[106]*t410*lu[17];
    const double t412 = lu[16]*(t410 + lu[105]*t411);
    const double t413 = lu[15]*(lu[101]*t412 - lu[102]*t411);
    const double t414 = lu[14]*(lu[95]*t413 - lu[96]*t412 + lu[97]*t411);
    const double t415 = lu[13]*(lu[87]*t414 - lu[88]*t413 + lu[89]*t412 - lu[90]*t411);
    const double t416 = lu[12]*(t415 + lu[78]*t414 - lu[79]*t413 + lu[80]*t412 - lu[81]*t411);
    const double t417 = (5.0/3.0)*t416;
    const double t418 = t402 + t400*t400 + t405*t405 + t404*t404 + t407*t407 + t406*t406;
    const double t419 = (5.0/3.0)*t414;
    const double t420 = (5.0/3.0)*t415;
    const double t421 = t418 + t417*t417 + t419*t419 + t420*t420 + t413*t413 + t412*t412;
    const double t422 = lu[1]*(t414 + lu[23]*t416 + lu[24]*t413 - lu[25]*t412 + lu[26]*t411);
    const double t423 = lu[0]*(t416 + lu[18]*t412 - lu[19]*t411 + lu[20]*t422);
    const double t424 = lu[3]*(t414 + lu[33]*t416 + lu[34]*t413 - lu[35]*t412 + lu[36]*t411);
    const double t425 = lu[2]*(t416 + lu[28]*t412 - lu[29]*t411 + lu[30]*t424);
    const double t426 = lu[5]*(t414 + lu[43]*t416 + lu[44]*t413 - lu[45]*t412 + lu[46]*t411);
    const double t427 = lu[4]*(t416 + lu[38]*t412 - lu[39]*t411 + lu[40]*t426);
    const double t428 = t421 + t411*t411 + t423*t423 + t422*t422 + t425*t425 + t424*t424;
    const double t429 = lu[7]*(t414 + lu[53]*t416 + lu[54]*t413 - lu[55]*t412 + lu[56]*t411);
    const double t430 = lu[6]*(t416 + lu[48]*t412 - lu[49]*t411 + lu[50]*t429);
    const double t431 = t409 + lu[63]*t416 + t414 + lu[64]*t413 - lu[65]*t412 + lu[66]*t411;
    const double t432 = lu[9]*t431;
    const double t433 = lu[8]*(t408 - t416 - lu[58]*t412 + lu[59]*t411 - lu[60]*t432);
    const double t434 = t428 + t427*t427 + t426*t426 + t430*t430 + t429*t429 + t433*t433;
    const double t435 = lu[11]*(t414 + lu[73]*t416 + lu[74]*t413 - lu[75]*t412 + lu[76]*t411);
    const double t436 = lu[10]*(t416 + lu[68]*t412 - lu[69]*t411 + lu[70]*t435);
    const double t437 = J[114] - K[114];
    const double t438 = J[122] - K[122] - lu[71]*t437;
    const double t439 = lu[17]*(J[129] - K[129] - lu[72]*t437 - lu[77]*t438);
    const double t440 = lu[105]*t439*lu[16];
    const double t441 = lu[15]*(lu[101]*t440 - lu[102]*t439);
    const double t442 = lu[14]*(lu[95]*t441 - lu[96]*t440 + lu[97]*t439);
    const double t443 = lu[13]*(lu[87]*t442 - lu[88]*t441 + lu[89]*t440 - lu[90]*t439);
    const double t444 = lu[12]*(t443 + lu[78]*t442 - lu[79]*t441 + lu[80]*t440 - lu[81]*t439);
    const double t445 = (5.0/3.0)*t444;
    const double t446 = (5.0/3.0)*t442;
    const double t447 = (5.0/3.0)*t443;
    const double t448 = t434 + t432*t432 + t436*t436 + t435*t435 + t445*t445 + t446*t446;
    const double t449 = lu[1]*(t442 + lu[23]*t444 + lu[24]*t441 - lu[25]*t440 + lu[26]*t439);
    const double t450 = lu[0]*(t444 + lu[18]*t440 - lu[19]*t439 + lu[20]*t449);
    const double t451 = t448 + t447*t447 + t441*t441 + t440*t440 + t439*t439 + t450*t450;
    const double t452 = lu[3]*(t442 + lu[33]*t444 + lu[34]*t441 - lu[35]*t440 + lu[36]*t439);
    const double t453 = lu[2]*(t444 + lu[28]*t440 - lu[29]*t439 + lu[30]*t452);
    const double t454 = lu[5]*(t442 + lu[43]*t444 + lu[44]*t441 - lu[45]*t440 + lu[46]*t439);
    const double t455 = lu[4]*(t444 + lu[38]*t440 - lu[39]*t439 + lu[40]*t454);
    const double t456 = lu[7]*(t442 + lu[53]*t444 + lu[54]*t441 - lu[55]*t440 + lu[56]*t439);
    const double t457 = lu[6]*(t444 + lu[48]*t440 - lu[49]*t439 + lu[50]*t456);
    const double t458 = t451 + t449*t449 + t453*t453 + t452*t452 + t455*t455 + t454*t454;
    const double t459 = lu[9]*(t442 + lu[63]*t444 + lu[64]*t441 - lu[65]*t440 + lu[66]*t439);
    const double t460 = lu[8]*(t444 + lu[58]*t440 - lu[59]*t439 + lu[60]*t459);
    const double t461 = lu[73]*t444 - t438 + t442 + lu[74]*t441 - lu[75]*t440 + lu[76]*t439;
    const double t462 = lu[11]*t461;
    const double t463 = lu[10]*(t437 + t444 + lu[68]*t440 - lu[69]*t439 + lu[70]*t462);
    const double t464 = t458 + t457*t457 + t456*t456 + t460*t460 + t459*t459 + t463*t463;
    const double t465 = J[115] - K[115];
    const double t466 = J[123] - K[123] - lu[71]*t465;
    const double t467 = lu[17]*(J[130] - K[130] - lu[72]*t465 - lu[77]*t466);
    const double t468 = lu[105]*t467*lu[16];
    const double t469 = lu[15]*(lu[101]*t468 - lu[102]*t467);
    const double t470 = lu[14]*(lu[95]*t469 - lu[96]*t468 + lu[97]*t467);
    const double t471 = lu[13]*(lu[87]*t470 - lu[88]*t469 + lu[89]*t468 - lu[90]*t467);
    const double t472 = lu[12]*(t471 + lu[78]*t470 - lu[79]*t469 + lu[80]*t468 - lu[81]*t467);
    const double t473 = (5.0/3.0)*t472;
    const double t474 = (5.0/3.0)*t470;
    const double t475 = (5.0/3.0)*t471;
    const double t476 = t464 + t462*t462 + t473*t473 + t474*t474 + t475*t475 + t469*t469;
    const double t477 = lu[1]*(t470 + lu[23]*t472 + lu[24]*t469 - lu[25]*t468 + lu[26]*t467);
    const double t478 = lu[0]*(t472 + lu[18]*t468 - lu[19]*t467 + lu[20]*t477);
    const double t479 = lu[3]*(t470 + lu[33]*t472 + lu[34]*t469 - lu[35]*t468 + lu[36]*t467);
    const double t480 = lu[2]*(t472 + lu[28]*t468 - lu[29]*t467 + lu[30]*t479);
    const double t481 = t476 + t468*t468 + t467*t467 + t478*t478 + t477*t477 + t480*t480;
    const double t482 = lu[5]*(t470 + lu[43]*t472 + lu[44]*t469 - lu[45]*t468 + lu[46]*t467);
    const double t483 = lu[4]*(t472 + lu[38]*t468 - lu[39]*t467 + lu[40]*t482);
    const double t484 = lu[7]*(t470 + lu[53]*t472 + lu[54]*t469 - lu[55]*t468 + lu[56]*t467);
    const double t485 = lu[6]*(t472 + lu[48]*t468 - lu[49]*t467 + lu[50]*t484);
    const double t486 = lu[9]*(t470 + lu[63]*t472 + lu[64]*t469 - lu[65]*t468 + lu[66]*t467);
    const double t487 = lu[8]*(t472 + lu[58]*t468 - lu[59]*t467 + lu[60]*t486);
    const double t488 = t481 + t479*t479 + t483*t483 + t482*t482 + t485*t485 + t484*t484;
    const double t489 = lu[73]*t472 - t466 + t470 + lu[74]*t469 - lu[75]*t468 + lu[76]*t467;
    const double t490 = lu[11]*t489;
    const double t491 = lu[10]*(t465 + t472 + lu[68]*t468 - lu[69]*t467 + lu[70]*t490);
    x[0] = t488 + t487*t487 + t486*t486 + t491*t491 + t490*t490;
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 30 additions, 66 multiplications. */
void evra_tree_platform_factor(const double J[132], double MODELER_OUT(lu, 54))
{
    const double t1 = 1.0/J[4];
    lu[0] = t1;
    const double t2 = J[12]*t1;
    const double t3 = 1.0/(J[13] - J[5]*t2);
    lu[1] = t3;
    const double t4 = J[19]*t1;
    const double t5 = (J[20] - J[5]*t4)*t3;
    const double t6 = J[14] - J[6]*t2;
    lu[2] = 1.0/(J[21] - J[6]*t4 - t5*t6);
    const double t7 = 1.0/J[26];
    lu[3] = t7;
    const double t8 = J[34]*t7;
    const double t9 = 1.0/(J[35] - J[27]*t8);
    lu[4] = t9;
    const double t10 = J[41]*t7;
    const double t11 = (J[42] - J[27]*t10)*t9;
    const double t12 = J[36] - J[28]*t8;
    lu[5] = 1.0/(J[43] - J[28]*t10 - t11*t12);
    const double t13 = 1.0/J[48];
    lu[6] = t13;
    const double t14 = J[56]*t13;
    const double t15 = 1.0/(J[57] - J[49]*t14);
    lu[7] = t15;
    const double t16 = J[63]*t13;
    const double t17 = (J[64] - J[49]*t16)*t15;
    const double t18 = J[58] - J[50]*t14;
    lu[8] = 1.0/(J[65] - J[50]*t16 - t17*t18);
    const double t19 = 1.0/J[70];
    lu[9] = t19;
    const double t20 = J[78]*t19;
    const double t21 = 1.0/(J[79] - J[71]*t20);
    lu[10] = t21;
    const double t22 = J[85]*t19;
    const double t23 = (J[86] - J[71]*t22)*t21;
    const double t24 = J[80] - J[72]*t20;
    lu[11] = 1.0/(J[87] - J[72]*t22 - t23*t24);
    const double t25 = 1.0/J[92];
    lu[12] = t25;
    const double t26 = J[100]*t25;
    const double t27 = 1.0/(J[101] - J[93]*t26);
    lu[13] = t27;
    const double t28 = J[107]*t25;
    const double t29 = (J[108] - J[93]*t28)*t27;
    const double t30 = J[102] - J[94]*t26;
    lu[14] = 1.0/(J[109] - J[94]*t28 - t29*t30);
    const double t31 = 1.0/J[114];
    lu[15] = t31;
    const double t32 = J[122]*t31;
    const double t33 = 1.0/(J[123] - J[115]*t32);
    lu[16] = t33;
    const double t34 = J[129]*t31;
    const double t35 = (J[130] - J[115]*t34)*t33;
    const double t36 = J[124] - J[116]*t32;
    lu[17] = 1.0/(J[131] - J[116]*t34 - t35*t36);
    lu[18] = J[5];
    lu[19] = J[6];
    lu[20] = t2;
    lu[21] = t4;
    lu[22] = t6;
    lu[23] = t5;
    lu[24] = J[27];
    lu[25] = J[28];
    lu[26] = t8;
    lu[27] = t10;
    lu[28] = t12;
    lu[29] = t11;
    lu[30] = J[49];
    lu[31] = J[50];
    lu[32] = t14;
    lu[33] = t16;
    lu[34] = t18;
    lu[35] = t17;
    lu[36] = J[71];
    lu[37] = J[72];
    lu[38] = t20;
    lu[39] = t22;
    lu[40] = t24;
    lu[41] = t23;
    lu[42] = J[93];
    lu[43] = J[94];
    lu[44] = t26;
    lu[45] = t28;
    lu[46] = t30;
    lu[47] = t29;
    lu[48] = J[115];
    lu[49] = J[116];
    lu[50] = t32;
    lu[51] = t34;
    lu[52] = t36;
    lu[53] = t35;
}

/* Solution with the factors.
 * 36 additions, 54 multiplications. */
void evra_tree_platform_solve(const double lu[54], const double right[18],
                              double MODELER_OUT(x, 18))
{
    const double t1 = right[1] - lu[20]*right[0];
    const double t2 = lu[2]*(right[2] - lu[21]*right[0] - lu[23]*t1);
    const double t3 = lu[1]*(t1 - lu[22]*t2);
    x[0] = lu[0]*(right[0] - lu[18]*t3 - lu[19]*t2);
    x[1] = t3;
    x[2] = t2;
    const double t4 = right[4] - lu[26]*right[3];
    const double t5 = lu[5]*(right[5] - lu[27]*right[3] - lu[29]*t4);
    const double t6 = lu[4]*(t4 - lu[28]*t5);
    x[3] = lu[3]*(right[3] - lu[24]*t6 - lu[25]*t5);
    x[4] = t6;
    x[5] = t5;
    const double t7 = right[7] - lu[32]*right[6];
    const double t8 = lu[8]*(right[8] - lu[33]*right[6] - lu[35]*t7);
    const double t9 = lu[7]*(t7 - lu[34]*t8);
    x[6] = lu[6]*(right[6] - lu[30]*t9 - lu[31]*t8);
    x[7] = t9;
    x[8] = t8;
    const double t10 = right[10] - lu[38]*right[9];
    const double t11 = lu[11]*(right[11] - lu[39]*right[9] - lu[41]*t10);
    const double t12 = lu[10]*(t10 - lu[40]*t11);
    x[9] = lu[9]*(right[9] - lu[36]*t12 - lu[37]*t11);
    x[10] = t12;
    x[11] = t11;
    const double t13 = right[13] - lu[44]*right[12];
    const double t14 = lu[14]*(right[14] - lu[45]*right[12] - lu[47]*t13);
    const double t15 = lu[13]*(t13 - lu[46]*t14);
    x[12] = lu[12]*(right[12] - lu[42]*t15 - lu[43]*t14);
    x[13] = t15;
    x[14] = t14;
    const double t16 = right[16] - lu[50]*right[15];
    const double t17 = lu[17]*(right[17] - lu[51]*right[15] - lu[53]*t16);
    const double t18 = lu[16]*(t16 - lu[52]*t17);
    x[15] = lu[15]*(right[15] - lu[48]*t18 - lu[49]*t17);
    x[16] = t18;
    x[17] = t17;
}

/* G from the factors.
 * 132 additions, 258 multiplications. */
void evra_tree_platform_coupling(const double J[132], const double lu[54],
                                 double MODELER_OUT(G, 144))
{
    const double t1 = lu[2]*(lu[21] - lu[20]*lu[23]);
    const double t2 = lu[1]*(lu[20] - lu[22]*t1);
    const double t3 = lu[0]*(1.0 + lu[18]*t2 + lu[19]*t1);
    G[0] = t3;
    G[1] = -t2;
    G[2] = -t1;
    const double t4 = lu[5]*(lu[27] - lu[26]*lu[29]);
    const double t5 = lu[4]*(lu[26] - lu[28]*t4);
    const double t6 = lu[3]*(1.0 + lu[24]*t5 + lu[25]*t4);
    G[3] = t6;
    G[4] = -t5;
    G[5] = -t4;
    const double t7 = lu[8]*(lu[33] - lu[32]*lu[35]);
    const double t8 = lu[7]*(lu[32] - lu[34]*t7);
    const double t9 = lu[6]*(1.0 + lu[30]*t8 + lu[31]*t7);
    G[6] = t9;
    G[7] = -t8;
    G[8] = -t7;
    const double t10 = lu[11]*(lu[39] - lu[38]*lu[41]);
    const double t11 = lu[10]*(lu[38] - lu[40]*t10);
    const double t12 = lu[9]*(1.0 + lu[36]*t11 + lu[37]*t10);
    G[9] = t12;
    G[10] = -t11;
    G[11] = -t10;
    const double t13 = lu[14]*(lu[45] - lu[44]*lu[47]);
    const double t14 = lu[13]*(lu[44] - lu[46]*t13);
    const double t15 = lu[12]*(1.0 + lu[42]*t14 + lu[43]*t13);
    G[12] = t15;
    G[13] = -t14;
    G[14] = -t13;
    const double t16 = lu[17]*(lu[51] - lu[50]*lu[53]);
    const double t17 = lu[16]*(lu[50] - lu[52]*t16);
    const double t18 = lu[15]*(1.0 + lu[48]*t17 + lu[49]*t16);
    G[15] = t18;
    G[16] = -t17;
    G[17] = -t16;
    const double t19 = lu[2]*lu[23];
    const double t20 = lu[1]*(1.0 + lu[22]*t19);
    const double t21 = lu[0]*(lu[18]*t20 - lu[19]*t19);
    G[18] = -t21;
    G[19] = t20;
    G[20] = -t19;
    const double t22 = lu[5]*lu[29];
    const double t23 = lu[4]*(1.0 + lu[28]*t22);
    const double t24 = lu[3]*(lu[24]*t23 - lu[25]*t22);
    G[21] = -t24;
    G[22] = t23;
    G[23] = -t22;
    const double t25 = lu[8]*lu[35];
    const double t26 = lu[7]*(1.0 + lu[34]*t25);
    const double t27 = lu[6]*(lu[30]*t26 - lu[31]*t25);
    G[24] = -t27;
    G[25] = t26;
    G[26] = -t25;
    const double t28 = lu[11]*lu[41];
    const double t29 = lu[10]*(1.0 + lu[40]*t28);
    const double t30 = lu[9]*(lu[36]*t29 - lu[37]*t28);
    G[27] = -t30;
    G[28] = t29;
    G[29] = -t28;
    const double t31 = lu[14]*lu[47];
    const double t32 = lu[13]*(1.0 + lu[46]*t31);
    const double t33 = lu[12]*(lu[42]*t32 - lu[43]*t31);
    G[30] = -t33;
    G[31] = t32;
    G[32] = -t31;
    const double t34 = lu[17]*lu[53];
    const double t35 = lu[16]*(1.0 + lu[52]*t34);
    const double t36 = lu[15]*(lu[48]*t35 - lu[49]*t34);
    G[33] = -t36;
    G[34] = t35;
    G[35] = -t34;
    const double t37 = lu[2]*lu[22]*lu[1];
    G[36] = lu[0]*(lu[18]*t37 - lu[2]*lu[19]);
    G[37] = -t37;
    G[38] = lu[2];
    const double t38 = lu[5]*lu[28]*lu[4];
    G[39] = lu[3]*(lu[24]*t38 - lu[5]*lu[25]);
    G[40] = -t38;
    G[41] = lu[5];
    const double t39 = lu[8]*lu[34]*lu[7];
    G[42] = lu[6]*(lu[30]*t39 - lu[8]*lu[31]);
    G[43] = -t39;
    G[44] = lu[8];
    const double t40 = lu[11]*lu[40]*lu[10];
    G[45] = lu[9]*(lu[36]*t40 - lu[11]*lu[37]);
    G[46] = -t40;
    G[47] = lu[11];
    const double t41 = lu[14]*lu[46]*lu[13];
    G[48] = lu[12]*(lu[42]*t41 - lu[14]*lu[43]);
    G[49] = -t41;
    G[50] = lu[14];
    const double t42 = lu[17]*lu[52]*lu[16];
    G[51] = lu[15]*(lu[48]*t42 - lu[17]*lu[49]);
    G[52] = -t42;
    G[53] = lu[17];
    const double t43 = lu[2]*(J[16] - J[8]*lu[23]);
    const double t44 = lu[1]*(J[8] - lu[22]*t43);
    G[54] = lu[0]*(lu[18]*t44 + lu[19]*t43);
    G[55] = -t44;
    G[56] = -t43;
    const double t45 = lu[5]*(J[38] - J[30]*lu[29]);
    const double t46 = lu[4]*(J[30] - lu[28]*t45);
    G[57] = lu[3]*(lu[24]*t46 + lu[25]*t45);
    G[58] = -t46;
    G[59] = -t45;
    const double t47 = lu[8]*(J[60] - J[52]*lu[35]);
    const double t48 = lu[7]*(J[52] - lu[34]*t47);
    G[60] = lu[6]*(lu[30]*t48 + lu[31]*t47);
    G[61] = -t48;
    G[62] = -t47;
    const double t49 = lu[11]*(J[82] - J[74]*lu[41]);
    const double t50 = lu[10]*(J[74] - lu[40]*t49);
    G[63] = lu[9]*(lu[36]*t50 + lu[37]*t49);
    G[64] = -t50;
    G[65] = -t49;
    const double t51 = lu[14]*(J[104] - J[96]*lu[47]);
    const double t52 = lu[13]*(J[96] - lu[46]*t51);
    G[66] = lu[12]*(lu[42]*t52 + lu[43]*t51);
    G[67] = -t52;
    G[68] = -t51;
    const double t53 = lu[17]*(J[126] - J[118]*lu[53]);
    const double t54 = lu[16]*(J[118] - lu[52]*t53);
    G[69] = lu[15]*(lu[48]*t54 + lu[49]*t53);
    G[70] = -t54;
    G[71] = -t53;
    const double t55 = J[9] - J[1]*lu[20];
    const double t56 = lu[2]*(J[17] - J[1]*lu[21] - lu[23]*t55);
    const double t57 = lu[1]*(t55 - lu[22]*t56);
    G[72] = -lu[0]*(J[1] - lu[18]*t57 - lu[19]*t56);
    G[73] = -t57;
    G[74] = -t56;
    const double t58 = J[31] - J[23]*lu[26];
    const double t59 = lu[5]*(J[39] - J[23]*lu[27] - lu[29]*t58);
    const double t60 = lu[4]*(t58 - lu[28]*t59);
    G[75] = -lu[3]*(J[23] - lu[24]*t60 - lu[25]*t59);
    G[76] = -t60;
    G[77] = -t59;
    const double t61 = J[53] - J[45]*lu[32];
    const double t62 = lu[8]*(J[61] - J[45]*lu[33] - lu[35]*t61);
    const double t63 = lu[7]*(t61 - lu[34]*t62);
    G[78] = -lu[6]*(J[45] - lu[30]*t63 - lu[31]*t62);
    G[79] = -t63;
    G[80] = -t62;
    const double t64 = J[75] - J[67]*lu[38];
    const double t65 = lu[11]*(J[83] - J[67]*lu[39] - lu[41]*t64);
    const double t66 = lu[10]*(t64 - lu[40]*t65);
    G[81] = -lu[9]*(J[67] - lu[36]*t66 - lu[37]*t65);
    G[82] = -t66;
    G[83] = -t65;
    const double t67 = J[97] - J[89]*lu[44];
    const double t68 = lu[14]*(J[105] - J[89]*lu[45] - lu[47]*t67);
    const double t69 = lu[13]*(t67 - lu[46]*t68);
    G[84] = -lu[12]*(J[89] - lu[42]*t69 - lu[43]*t68);
    G[85] = -t69;
    G[86] = -t68;
    const double t70 = J[119] - J[111]*lu[50];
    const double t71 = lu[17]*(J[127] - J[111]*lu[51] - lu[53]*t70);
    const double t72 = lu[16]*(t70 - lu[52]*t71);
    G[87] = -lu[15]*(J[111] - lu[48]*t72 - lu[49]*t71);
    G[88] = -t72;
    G[89] = -t71;
    const double t73 = J[10] - J[2]*lu[20];
    const double t74 = lu[2]*(J[18] - J[2]*lu[21] - lu[23]*t73);
    const double t75 = lu[1]*(t73 - lu[22]*t74);
    G[90] = -lu[0]*(J[2] - lu[18]*t75 - lu[19]*t74);
    G[91] = -t75;
    G[92] = -t74;
    const double t76 = J[32] - J[24]*lu[26];
    const double t77 = lu[5]*(J[40] - J[24]*lu[27] - lu[29]*t76);
    const double t78 = lu[4]*(t76 - lu[28]*t77);
    G[93] = -lu[3]*(J[24] - lu[24]*t78 - lu[25]*t77);
    G[94] = -t78;
    G[95] = -t77;
    const double t79 = J[54] - J[46]*lu[32];
    const double t80 = lu[8]*(J[62] - J[46]*lu[33] - lu[35]*t79);
    const double t81 = lu[7]*(t79 - lu[34]*t80);
    G[96] = -lu[6]*(J[46] - lu[30]*t81 - lu[31]*t80);
    G[97] = -t81;
    G[98] = -t80;
    const double t82 = J[76] - J[68]*lu[38];
    const double t83 = lu[11]*(J[84] - J[68]*lu[39] - lu[41]*t82);
    const double t84 = lu[10]*(t82 - lu[40]*t83);
    G[99] = -lu[9]*(J[68] - lu[36]*t84 - lu[37]*t83);
    G[100] = -t84;
    G[101] = -t83;
    const double t85 = J[98] - J[90]*lu[44];
    const double t86 = lu[14]*(J[106] - J[90]*lu[45] - lu[47]*t85);
    const double t87 = lu[13]*(t85 - lu[46]*t86);
    G[102] = -lu[12]*(J[90] - lu[42]*t87 - lu[43]*t86);
    G[103] = -t87;
    G[104] = -t86;
    const double t88 = J[120] - J[112]*lu[50];
    const double t89 = lu[17]*(J[128] - J[112]*lu[51] - lu[53]*t88);
    const double t90 = lu[16]*(t88 - lu[52]*t89);
    G[105] = -lu[15]*(J[112] - lu[48]*t90 - lu[49]*t89);
    G[106] = -t90;
    G[107] = -t89;
    G[108] = -t3;
    G[109] = t2;
    G[110] = t1;
    G[111] = -t6;
    G[112] = t5;
    G[113] = t4;
    G[114] = -t9;
    G[115] = t8;
    G[116] = t7;
    G[117] = -t12;
    G[118] = t11;
    G[119] = t10;
    G[120] = -t15;
    G[121] = t14;
    G[122] = t13;
    G[123] = -t18;
    G[124] = t17;
    G[125] = t16;
    G[126] = t21;
    G[127] = -t20;
    G[128] = t19;
    G[129] = t24;
    G[130] = -t23;
    G[131] = t22;
    G[132] = t27;
    G[133] = -t26;
    G[134] = t25;
    G[135] = t30;
    G[136] = -t29;
    G[137] = t28;
    G[138] = t33;
    G[139] = -t32;
    G[140] = t31;
    G[141] = t36;
    G[142] = -t35;
    G[143] = t34;
}

/* Bounds of the rows of J^-1 (K - J).
 * 126 additions, 78 multiplications. */
void evra_tree_platform_turned(const double J[132], const double K[132], const double lu[54],
                               double MODELER_OUT(x, 18))
{
    const double t1 = fabs(J[4] - K[4]) + fabs(J[5] - K[5]) + 0.6*fabs(J[6] - K[6]);
    const double t2 = fabs(J[12] - K[12]) + fabs(J[13] - K[13]) + 0.6*fabs(J[14] - K[14]);
    const double t3 = t2 + fabs(lu[20])*t1;
    const double t4 = fabs(J[19] - K[19]) + fabs(J[20] - K[20]) + 0.6*fabs(J[21] - K[21]);
    const double t5 = fabs(lu[2])*(t4 + fabs(lu[21])*t1 + fabs(lu[23])*t3);
    const double t6 = fabs(lu[1])*(t3 + fabs(lu[22])*t5);
    x[0] = fabs(lu[0])*(t1 + fabs(lu[18])*t6 + fabs(lu[19])*t5);
    x[1] = t6;
    x[2] = (5.0/3.0)*t5;
    const double t7 = fabs(J[26] - K[26]) + fabs(J[27] - K[27]) + 0.6*fabs(J[28] - K[28]);
    const double t8 = fabs(J[34] - K[34]) + fabs(J[35] - K[35]) + 0.6*fabs(J[36] - K[36]);
    const double t9 = t8 + fabs(lu[26])*t7;
    const double t10 = fabs(J[41] - K[41]) + fabs(J[42] - K[42]) + 0.6*fabs(J[43] - K[43]);
    const double t11 = fabs(lu[5])*(t10 + fabs(lu[27])*t7 + fabs(lu[29])*t9);
    const double t12 = fabs(lu[4])*(t9 + fabs(lu[28])*t11);
    x[3] = fabs(lu[3])*(t7 + fabs(lu[24])*t12 + fabs(lu[25])*t11);
    x[4] = t12;
    x[5] = (5.0/3.0)*t11;
    const double t13 = fabs(J[48] - K[48]) + fabs(J[49] - K[49]) + 0.6*fabs(J[50] - K[50]);
    const double t14 = fabs(J[56] - K[56]) + fabs(J[57] - K[57]) + 0.6*fabs(J[58] - K[58]);
    const double t15 = t14 + fabs(lu[32])*t13;
    const double t16 = fabs(J[63] - K[63]) + fabs(J[64] - K[64]) + 0.6*fabs(J[65] - K[65]);
    const double t17 = fabs(lu[8])*(t16 + fabs(lu[33])*t13 + fabs(lu[35])*t15);
    const double t18 = fabs(lu[7])*(t15 + fabs(lu[34])*t17);
    x[6] = fabs(lu[6])*(t13 + fabs(lu[30])*t18 + fabs(lu[31])*t17);
    x[7] = t18;
    x[8] = (5.0/3.0)*t17;
    const double t19 = fabs(J[70] - K[70]) + fabs(J[71] - K[71]) + 0.6*fabs(J[72] - K[72]);
    const double t20 = fabs(J[78] - K[78]) + fabs(J[79] - K[79]) + 0.6*fabs(J[80] - K[80]);
    const double t21 = t20 + fabs(lu[38])*t19;
    const double t22 = fabs(J[85] - K[85]) + fabs(J[86] - K[86]) + 0.6*fabs(J[87] - K[87]);
    const double t23 = fabs(lu[11])*(t22 + fabs(lu[39])*t19 + fabs(lu[41])*t21);
    const double t24 = fabs(lu[10])*(t21 + fabs(lu[40])*t23);
    x[9] = fabs(lu[9])*(t19 + fabs(lu[36])*t24 + fabs(lu[37])*t23);
    x[10] = t24;
    x[11] = (5.0/3.0)*t23;
    const double t25 = fabs(J[92] - K[92]) + fabs(J[93] - K[93]) + 0.6*fabs(J[94] - K[94]);
    const double t26 = fabs(J[100] - K[100]) + fabs(J[101] - K[101]) + 0.6*fabs(J[102] - K[102]);
    const double t27 = t26 + fabs(lu[44])*t25;
    const double t28 = fabs(J[107] - K[107]) + fabs(J[108] - K[108]) + 0.6*fabs(J[109] - K[109]);
    const double t29 = fabs(lu[14])*(t28 + fabs(lu[45])*t25 + fabs(lu[47])*t27);
    const double t30 = fabs(lu[13])*(t27 + fabs(lu[46])*t29);
    x[12] = fabs(lu[12])*(t25 + fabs(lu[42])*t30 + fabs(lu[43])*t29);
    x[13] = t30;
    x[14] = (5.0/3.0)*t29;
    const double t31 = fabs(J[114] - K[114]) + fabs(J[115] - K[115]) + 0.6*fabs(J[116] - K[116]);
    const double t32 = fabs(J[122] - K[122]) + fabs(J[123] - K[123]) + 0.6*fabs(J[124] - K[124]);
    const double t33 = t32 + fabs(lu[50])*t31;
    const double t34 = fabs(J[129] - K[129]) + fabs(J[130] - K[130]) + 0.6*fabs(J[131] - K[131]);
    const double t35 = fabs(lu[17])*(t34 + fabs(lu[51])*t31 + fabs(lu[53])*t33);
    const double t36 = fabs(lu[16])*(t33 + fabs(lu[52])*t35);
    x[15] = fabs(lu[15])*(t31 + fabs(lu[48])*t36 + fabs(lu[49])*t35);
    x[16] = t36;
    x[17] = (5.0/3.0)*t35;
}

/* Sum of the squares of J^-1 (K - J).
 * 215 additions, 240 multiplications. */
void evra_tree_platform_spread(const double J[132], const double K[132], const double lu[54],
                               double MODELER_OUT(x, 1))
{
    const double t1 = J[4] - K[4];
    const double t2 = J[12] - K[12] - lu[20]*t1;
    const double t3 = lu[2]*(J[19] - K[19] - lu[21]*t1 - lu[23]*t2);
    const double t4 = lu[1]*(t2 - lu[22]*t3);
    const double t5 = lu[0]*(t1 - lu[18]*t4 - lu[19]*t3);
    const double t6 = (5.0/3.0)*t3;
    const double t7 = J[5] - K[5];
    const double t8 = J[13] - K[13] - lu[20]*t7;
    const double t9 = lu[2]*(J[20] - K[20] - lu[21]*t7 - lu[23]*t8);
    const double t10 = lu[1]*(t8 - lu[22]*t9);
    const double t11 = lu[0]*(t7 - lu[18]*t10 - lu[19]*t9);
    const double t12 = (5.0/3.0)*t9;
    const double t13 = J[6] - K[6];
    const double t14 = J[14] - K[14] - lu[20]*t13;
    const double t15 = lu[2]*(J[21] - K[21] - lu[21]*t13 - lu[23]*t14);
    const double t16 = lu[1]*(t14 - lu[22]*t15);
    const double t17 = lu[0]*(t13 - lu[18]*t16 - lu[19]*t15)*0.6;
    const double t18 = 0.6*t16;
    const double t19 = t5*t5 + t4*t4 + t6*t6 + t11*t11 + t10*t10 + t12*t12 + t17*t17 + t18*t18;
    const double t20 = J[26] - K[26];
    const double t21 = J[34] - K[34] - lu[26]*t20;
    const double t22 = lu[5]*(J[41] - K[41] - lu[27]*t20 - lu[29]*t21);
    const double t23 = lu[4]*(t21 - lu[28]*t22);
    const double t24 = lu[3]*(t20 - lu[24]*t23 - lu[25]*t22);
    const double t25 = (5.0/3.0)*t22;
    const double t26 = J[27] - K[27];
    const double t27 = J[35] - K[35] - lu[26]*t26;
    const double t28 = lu[5]*(J[42] - K[42] - lu[27]*t26 - lu[29]*t27);
    const double t29 = lu[4]*(t27 - lu[28]*t28);
    const double t30 = lu[3]*(t26 - lu[24]*t29 - lu[25]*t28);
    const double t31 = (5.0/3.0)*t28;
    const double t32 = J[28] - K[28];
    const double t33 = J[36] - K[36] - lu[26]*t32;
    const double t34 = lu[5]*(J[43] - K[43] - lu[27]*t32 - lu[29]*t33);
    const double t35 = lu[4]*(t33 - lu[28]*t34);
    const double t36 = lu[3]*(t32 - lu[24]*t35 - lu[25]*t34)*0.6;
    const double t37 = t19 + t15*t15 + t24*t24 + t23*t23 + t25*t25 + t30*t30 + t29*t29 + t31*t31;
    const double t38 = 0.6*t35;
    const double t39 = J[48] - K[48];
    const double t40 = J[56] - K[56] - lu[32]*t39;
    const double t41 = lu[8]*(J[63] - K[63] - lu[33]*t39 - lu[35]*t40);
    const double t42 = lu[7]*(t40 - lu[34]*t41);
    const double t43 = lu[6]*(t39 - lu[30]*t42 - lu[31]*t41);
    const double t44 = (5.0/3.0)*t41;
    const double t45 = J[49] - K[49];
    const double t46 = J[57] - K[57] - lu[32]*t45;
    const double t47 = lu[8]*(J[64] - K[64] - lu[33]*t45 - lu[35]*t46);
    const double t48 = lu[7]*(t46 - lu[34]*t47);
    const double t49 = lu[6]*(t45 - lu[30]*t48 - lu[31]*t47);
    const double t50 = t37 + t36*t36 + t38*t38 + t34*t34 + t43*t43 + t42*t42 + t44*t44 + t49*t49;
    const double t51 = (5.0/3.0)*t47;
    const double t52 = J[50] - K[50];
    const double t53 = J[58] - K[58] - lu[32]*t52;
    const double t54 = lu[8]*(J[65] - K[65] - lu[33]*t52 - lu[35]*t53);
    const double t55 = lu[7]*(t53 - lu[34]*t54);
    const double t56 = lu[6]*(t52 - lu[30]*t55 - lu[31]*t54)*0.6;
    const double t57 = 0.6*t55;
    const double t58 = J[70] - K[70];
    const double t59 = J[78] - K[78] - lu[38]*t58;
    const double t60 = lu[11]*(J[85] - K[85] - lu[39]*t58 - lu[41]*t59);
    const double t61 = lu[10]*(t59 - lu[40]*t60);
    const double t62 = lu[9]*(t58 - lu[36]*t61 - lu[37]*t60);
    const double t63 = (5.0/3.0)*t60;
    const double t64 = t50 + t48*t48 + t51*t51 + t56*t56 + t57*t57 + t54*t54 + t62*t62 + t61*t61;
    const double t65 = J[71] - K[71];
    const double t66 = J[79] - K[79] - lu[38]*t65;
    const double t67 = lu[11]*(J[86] - K[86] - lu[39]*t65 - lu[41]*t66);
    const double t68 = lu[10]*(t66 - lu[40]*t67);
    const double t69 = lu[9]*(t65 - lu[36]*t68 - lu[37]*t67);
    const double t70 = (5.0/3.0)*t67;
    const double t71 = J[72] - K[72];
    const double t72 = J[80] - K[80] - lu[38]*t71;
    const double t73 = lu[11]*(J[87] - K[87] - lu[39]*t71 - lu[41]*t72);
    const double t74 = lu[10]*(t72 - lu[40]*t73);
    const double t75 = lu[9]*(t71 - lu[36]*t74 - lu[37]*t73)*0.6;
    const double t76 = 0.6*t74;
    const double t77 = J[92] - K[92];
    const double t78 = J[100] - K[100] - lu[44]*t77;
    const double t79 = lu[14]*(J[107] - K[107] - lu[45]*t77 - lu[47]*t78);
    const double t80 = lu[13]*(t78 - lu[46]*t79);
    const double t81 = lu[12]*(t77 - lu[42]*t80 - lu[43]*t79);
    const double t82 = t64 + t63*t63 + t69*t69 + t68*t68 + t70*t70 + t75*t75 + t76*t76 + t73*t73;
    const double t83 = (5.0/3.0)*t79;
    const double t84 = J[93] - K[93];
    const double t85 = J[101] - K[101] - lu[44]*t84;
    const double t86 = lu[14]*(J[108] - K[108] - lu[45]*t84 - lu[47]*t85);
    const double t87 = lu[13]*(t85 - lu[46]*t86);
    const double t88 = lu[12]*(t84 - lu[42]*t87 - lu[43]*t86);
    const double t89 = (5.0/3.0)*t86;
    const double t90 = J[94] - K[94];
    const double t91 = J[102] - K[102] - lu[44]*t90;
    const double t92 = lu[14]*(J[109] - K[109] - lu[45]*t90 - lu[47]*t91);
    const double t93 = lu[13]*(t91 - lu[46]*t92);
    const double t94 = lu[12]*(t90 - lu[42]*t93 - lu[43]*t92)*0.6;
    const double t95 = 0.6*t93;
    const double t96 = t82 + t81*t81 + t80*t80 + t83*t83 + t88*t88 + t87*t87 + t89*t89 + t94*t94;
    const double t97 = J[114] - K[114];
    const double t98 = J[122] - K[122] - lu[50]*t97;
    const double t99 = lu[17]*(J[129] - K[129] - lu[51]*t97 - lu[53]*t98);
    const double t100 = lu[16]*(t98 - lu[52]*t99);
    const double t101 = lu[15]*(t97 - lu[48]*t100 - lu[49]*t99);
    const double t102 = (5.0/3.0)*t99;
    const double t103 = J[115] - K[115];
    const double t104 = J[123] - K[123] - lu[50]*t103;
    const double t105 = lu[17]*(J[130] - K[130] - lu[51]*t103 - lu[53]*t104);
    const double t106 = lu[16]*(t104 - lu[52]*t105);
    const double t107 = lu[15]*(t103 - lu[48]*t106 - lu[49]*t105);
    const double t108 = t96 + t95*t95 + t92*t92 + t101*t101 + t100*t100 + t102*t102 + t107*t107;
    const double t109 = (5.0/3.0)*t105;
    const double t110 = J[116] - K[116];
    const double t111 = J[124] - K[124] - lu[50]*t110;
    const double t112 = lu[17]*(J[131] - K[131] - lu[51]*t110 - lu[53]*t111);
    const double t113 = lu[16]*(t111 - lu[52]*t112);
    const double t114 = lu[15]*(t110 - lu[48]*t113 - lu[49]*t112)*0.6;
    const double t115 = 0.6*t113;
    x[0] = t108 + t106*t106 + t109*t109 + t114*t114 + t115*t115 + t112*t112;
}

/* Base parameters from standard ones: the grouping relations.
 * 114 additions, 36 multiplications. */
void evra_base_parameters(const double chi[EVRA_STANDARD_PARAMETERS],
                          double MODELER_OUT(beta, EVRA_BASE_PARAMETERS))
{
    const double k1 = cos(evra_geo_phi1);
    const double k2 = sin(evra_geo_phi1);
    const double p41_x = k1*evra_geo_RP;
    const double p41_y = k2*evra_geo_RP;
    const double k5 = cos(evra_geo_phi2);
    const double k6 = sin(evra_geo_phi2);
    const double p42_x = evra_geo_RP*k5;
    const double p42_y = evra_geo_RP*k6;
    const double k9 = cos(evra_geo_phi3);
    const double k10 = sin(evra_geo_phi3);
    const double p43_x = evra_geo_RP*k9;
    const double p43_y = evra_geo_RP*k10;
    const double k13 = cos(evra_geo_phi4);
    const double k14 = sin(evra_geo_phi4);
    const double p44_x = evra_geo_RP*k13;
    const double p44_y = evra_geo_RP*k14;
    const double k17 = cos(evra_geo_phi5);
    const double k18 = sin(evra_geo_phi5);
    const double p45_x = evra_geo_RP*k17;
    const double p45_y = evra_geo_RP*k18;
    const double k21 = cos(evra_geo_phi6);
    const double k22 = sin(evra_geo_phi6);
    const double p46_x = evra_geo_RP*k21;
    const double p46_y = evra_geo_RP*k22;
    const double k25 = evra_geo_RP*evra_geo_RP;
    const double k26 = k2*k2*k25;
    const double k27 = k6*k6*k25;
    const double k28 = k10*k10*k25;
    const double k29 = k14*k14*k25;
    const double k30 = k18*k18*k25;
    const double k31 = k22*k22*k25;
    const double k32 = k1*k25*k2;
    const double k33 = k5*k25*k6;
    const double k34 = k9*k25*k10;
    const double k35 = k13*k25*k14;
    const double k36 = k17*k25*k18;
    const double k37 = k21*k25*k22;
    const double k38 = k1*k1*k25;
    const double k39 = k5*k5*k25;
    const double k40 = k9*k9*k25;
    const double k41 = k13*k13*k25;
    const double k42 = k17*k17*k25;
    const double k43 = k21*k21*k25;

    const double t1 = chi[0] + k26*chi[59] + k27*chi[89] + k28*chi[119] + k29*chi[149];
    beta[0] = t1 + k30*chi[179] + k31*chi[209];
    const double t2 = chi[1] - k32*chi[59] - k33*chi[89] - k34*chi[119] - k35*chi[149];
    beta[1] = t2 - k36*chi[179] - k37*chi[209];
    beta[2] = chi[2];
    const double t3 = chi[3] + k38*chi[59] + k39*chi[89] + k40*chi[119] + k41*chi[149];
    beta[3] = t3 + k42*chi[179] + k43*chi[209];
    beta[4] = chi[4];
    const double t4 = chi[5] + k25*chi[59] + k25*chi[89] + k25*chi[119] + k25*chi[149];
    beta[5] = t4 + k25*chi[179] + k25*chi[209];
    const double t5 = chi[6] + p41_x*chi[59] + p42_x*chi[89] + p43_x*chi[119] + p44_x*chi[149];
    beta[6] = t5 + p45_x*chi[179] + p46_x*chi[209];
    const double t6 = chi[7] + p41_y*chi[59] + p42_y*chi[89] + p43_y*chi[119] + p44_y*chi[149];
    beta[7] = t6 + p45_y*chi[179] + p46_y*chi[209];
    beta[8] = chi[8];
    beta[9] = chi[9] + chi[59] + chi[89] + chi[119] + chi[149] + chi[179] + chi[209];
    beta[10] = chi[19];
    const double t7 = chi[29] + chi[39] + chi[49] + chi[69] + chi[79] + chi[99] + chi[109];
    beta[11] = chi[129] + t7 + chi[139] + chi[159] + chi[169] + chi[189] + chi[199];
    beta[12] = chi[35] + chi[43] + chi[55];
    beta[13] = chi[36];
    beta[14] = chi[37] - chi[48];
    beta[15] = chi[40] - chi[43] + chi[50] - chi[55];
    beta[16] = chi[41] - chi[52];
    beta[17] = chi[42] + chi[51];
    beta[18] = chi[44] - chi[54];
    beta[19] = chi[45] + chi[53];
    beta[20] = chi[46];
    beta[21] = chi[47];
    beta[22] = chi[56];
    beta[23] = chi[57];
    beta[24] = chi[58];
    beta[25] = chi[65] + chi[73] + chi[85];
    beta[26] = chi[66];
    beta[27] = chi[67] - chi[78];
    beta[28] = chi[70] - chi[73] + chi[80] - chi[85];
    beta[29] = chi[71] - chi[82];
    beta[30] = chi[72] + chi[81];
    beta[31] = chi[74] - chi[84];
    beta[32] = chi[75] + chi[83];
    beta[33] = chi[76];
    beta[34] = chi[77];
    beta[35] = chi[86];
    beta[36] = chi[87];
    beta[37] = chi[88];
    beta[38] = chi[95] + chi[103] + chi[115];
    beta[39] = chi[96];
    beta[40] = chi[97] - chi[108];
    beta[41] = chi[100] - chi[103] + chi[110] - chi[115];
    beta[42] = chi[101] - chi[112];
    beta[43] = chi[102] + chi[111];
    beta[44] = chi[104] - chi[114];
    beta[45] = chi[105] + chi[113];
    beta[46] = chi[106];
    beta[47] = chi[107];
    beta[48] = chi[116];
    beta[49] = chi[117];
    beta[50] = chi[118];
    beta[51] = chi[125] + chi[133] + chi[145];
    beta[52] = chi[126];
    beta[53] = chi[127] - chi[138];
    beta[54] = chi[130] - chi[133] + chi[140] - chi[145];
    beta[55] = chi[131] - chi[142];
    beta[56] = chi[132] + chi[141];
    beta[57] = chi[134] - chi[144];
    beta[58] = chi[135] + chi[143];
    beta[59] = chi[136];
    beta[60] = chi[137];
    beta[61] = chi[146];
    beta[62] = chi[147];
    beta[63] = chi[148];
    beta[64] = chi[155] + chi[163] + chi[175];
    beta[65] = chi[156];
    beta[66] = chi[157] - chi[168];
    beta[67] = chi[160] - chi[163] + chi[170] - chi[175];
    beta[68] = chi[161] - chi[172];
    beta[69] = chi[162] + chi[171];
    beta[70] = chi[164] - chi[174];
    beta[71] = chi[165] + chi[173];
    beta[72] = chi[166];
    beta[73] = chi[167];
    beta[74] = chi[176];
    beta[75] = chi[177];
    beta[76] = chi[178];
    beta[77] = chi[185] + chi[193] + chi[205];
    beta[78] = chi[186];
    beta[79] = chi[187] - chi[198];
    beta[80] = chi[190] - chi[193] + chi[200] - chi[205];
    beta[81] = chi[191] - chi[202];
    beta[82] = chi[192] + chi[201];
    beta[83] = chi[194] - chi[204];
    beta[84] = chi[195] + chi[203];
    beta[85] = chi[196];
    beta[86] = chi[197];
    beta[87] = chi[206];
    beta[88] = chi[207];
    beta[89] = chi[208];
}
