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
 *   n_1    moment on the link at its origin for one unit of a parameter
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
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
static const double evra_geo_beta1 = EVRA_GEO_beta1;
static const double evra_geo_beta2 = EVRA_GEO_beta2;
static const double evra_geo_beta3 = EVRA_GEO_beta3;
static const double evra_geo_beta4 = EVRA_GEO_beta4;
static const double evra_geo_beta5 = EVRA_GEO_beta5;
static const double evra_geo_beta6 = EVRA_GEO_beta6;

/* Regressor of the standard parameters.
 * 396 additions, 656 multiplications. */
MODELER_CLONES
void evra_tree_regressor(const double q[26], const double qd[26], const double qdd[26],
                         double MODELER_OUT(phi, 26 * 210))
{
    MODELER_ALL_ZEROS(phi, 5460);

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

    const double x_P_x = c4*c5;
    /* link Pb: angular velocity, w_Pb = R_Pb' w_Pa + qd_Pb z */
    const double w_Pb_x = s4*qd[3];
    MODELER_ZEROS(phi + 0, 6);
    /* link Pb: angular acceleration, wd_Pb = R_Pb' wd_Pa + (R_Pb' w_Pa) x qd_Pb z + qdd_Pb z */
    const double wd_Pb_y = c4*qdd[3] - qd[4]*w_Pb_x;
    MODELER_ZEROS(phi + 10, 8);
    const double w_Pb_y = c4*qd[3];
    MODELER_ZEROS(phi + 18, 8);
    /* link P: angular velocity, w_P = R_P' w_Pb + qd_P z */
    const double w_P_y = c5*qd[4] - s5*w_Pb_y;
    MODELER_ZEROS(phi + 26, 8);
    /* link P: angular acceleration, wd_P = R_P' wd_Pb + (R_P' w_Pb) x qd_P z + qdd_P z */
    const double wd_P_x = c5*wd_Pb_y + s5*qdd[4] + qd[5]*w_P_y;
    MODELER_ZEROS(phi + 34, 8);
    const double minus_y_P_x = c4*s5;
    MODELER_ZEROS(phi + 42, 8);
    const double w_P_x = c5*w_Pb_y + s5*qd[4];
    MODELER_ZEROS(phi + 50, 8);
    const double w_P_z = qd[5] + w_Pb_x;
    MODELER_ZEROS(phi + 58, 8);
    const double ww_P_xz = w_P_x*w_P_z;
    const double t11 = minus_y_P_x*ww_P_xz;
    MODELER_ZEROS(phi + 66, 8);
    const double ww_P_xy = w_P_x*w_P_y;
    MODELER_ZEROS(phi + 74, 8);
    const double t13 = s4*ww_P_xy;
    MODELER_ZEROS(phi + 82, 8);
    phi[630] = x_P_x*wd_P_x - t11 - t13;
    MODELER_ZEROS(phi + 90, 8);
    const double t14 = c5*ww_P_xz;
    MODELER_ZEROS(phi + 98, 8);
    phi[840] = s5*wd_P_x + t14;
    MODELER_ZEROS(phi + 106, 8);
    phi[1050] = -ww_P_xy;
    MODELER_ZEROS(phi + 114, 8);
    const double wd_P_y = c5*qdd[4] - s5*wd_Pb_y - qd[5]*w_P_x;
    MODELER_ZEROS(phi + 122, 8);
    /* link P: acceleration of points of the link, U_P = [wd_P x] + [w_P x][w_P x] */
    const double minus_U_P_zx = wd_P_y - ww_P_xz;
    const double ww_P_yz = w_P_y*w_P_z;
    MODELER_ZEROS(phi + 130, 8);
    const double U_P_zy = wd_P_x + ww_P_yz;
    MODELER_ZEROS(phi + 138, 8);
    const double ww_P_zz = w_P_z*w_P_z;
    MODELER_ZEROS(phi + 146, 8);
    const double minus_U_P_xx = w_P_y*w_P_y + ww_P_zz;
    MODELER_ZEROS(phi + 154, 8);
    const double minus_U_P_yy = w_P_x*w_P_x + ww_P_zz;
    MODELER_ZEROS(phi + 162, 8);
    /* link P: moment on the link at its origin for one unit of a parameter, n_P = J_P wd_P + w_P x
        J_P w_P + MS_P x vd_P */
    const double minus_n_P_XYz = minus_U_P_xx - minus_U_P_yy;
    MODELER_ZEROS(phi + 170, 8);
    phi[631] = x_P_x*minus_U_P_zx - minus_y_P_x*U_P_zy - s4*minus_n_P_XYz;
    MODELER_ZEROS(phi + 178, 8);
    phi[841] = s5*minus_U_P_zx + c5*U_P_zy;
    MODELER_ZEROS(phi + 186, 8);
    phi[1051] = -minus_n_P_XYz;
    const double wd_P_z = s4*qdd[3] + qd[4]*w_Pb_y + qdd[5];
    MODELER_ZEROS(phi + 194, 8);
    const double U_P_yx = wd_P_z + ww_P_xy;
    MODELER_ZEROS(phi + 202, 8);
    /* link Pb: acceleration of points of the link, U_Pb = [wd_Pb x] + [w_Pb x][w_Pb x] */
    const double minus_U_Pb_xx = w_Pb_y*w_Pb_y + qd[4]*qd[4];
    MODELER_ZEROS(phi + 210, 6);
    const double minus_n_P_XZy = minus_U_Pb_xx - minus_U_P_xx;
    MODELER_ZEROS(phi + 220, 8);
    const double minus_U_P_yz = wd_P_x - ww_P_yz;
    MODELER_ZEROS(phi + 228, 8);
    phi[632] = x_P_x*U_P_yx + minus_y_P_x*minus_n_P_XZy + s4*minus_U_P_yz;
    MODELER_ZEROS(phi + 236, 8);
    phi[842] = s5*U_P_yx - c5*minus_n_P_XZy;
    MODELER_ZEROS(phi + 244, 8);
    phi[1052] = minus_U_P_yz;
    MODELER_ZEROS(phi + 252, 8);
    const double t28 = x_P_x*ww_P_yz;
    phi[633] = t13 - (t28 + minus_y_P_x*wd_P_y);
    MODELER_ZEROS(phi + 260, 8);
    const double t29 = s5*ww_P_yz;
    MODELER_ZEROS(phi + 268, 8);
    phi[843] = c5*wd_P_y - t29;
    MODELER_ZEROS(phi + 276, 8);
    phi[1053] = ww_P_xy;
    MODELER_ZEROS(phi + 284, 8);
    const double n_P_YZx = minus_U_Pb_xx - minus_U_P_yy;
    MODELER_ZEROS(phi + 292, 8);
    const double minus_U_P_xy = wd_P_z - ww_P_xy;
    MODELER_ZEROS(phi + 300, 8);
    const double U_P_xz = wd_P_y + ww_P_xz;
    MODELER_ZEROS(phi + 308, 8);
    phi[634] = x_P_x*n_P_YZx - minus_y_P_x*minus_U_P_xy + s4*U_P_xz;
    MODELER_ZEROS(phi + 316, 8);
    phi[844] = s5*n_P_YZx + c5*minus_U_P_xy;
    phi[1054] = U_P_xz;
    MODELER_ZEROS(phi + 324, 8);
    phi[635] = t11 + t28 + s4*wd_P_z;
    MODELER_ZEROS(phi + 332, 8);
    phi[845] = t29 - t14;
    MODELER_ZEROS(phi + 340, 8);
    phi[1055] = wd_P_z;
    MODELER_ZEROS(phi + 348, 8);
    phi[6] = -(x_P_x*minus_U_P_xx + minus_y_P_x*U_P_yx + s4*minus_U_P_zx);
    MODELER_ZEROS(phi + 356, 8);
    const double y_Pb_y = s3*s4;
    MODELER_ZEROS(phi + 364, 8);
    const double x_P_y = c5*y_Pb_y + c3*s5;
    MODELER_ZEROS(phi + 372, 8);
    const double y_P_y = c3*c5 - s5*y_Pb_y;
    MODELER_ZEROS(phi + 380, 8);
    const double minus_x_Pb_y = s3*c4;
    phi[216] = minus_x_Pb_y*minus_U_P_zx - (x_P_y*minus_U_P_xx - y_P_y*U_P_yx);
    MODELER_ZEROS(phi + 388, 8);
    const double minus_y_Pb_z = c3*s4;
    MODELER_ZEROS(phi + 396, 8);
    const double minus_x_P_z = c5*minus_y_Pb_z - s3*s5;
    MODELER_ZEROS(phi + 404, 8);
    const double y_P_z = s3*c5 + s5*minus_y_Pb_z;
    MODELER_ZEROS(phi + 412, 8);
    const double x_Pb_z = c3*c4;
    MODELER_ZEROS(phi + 420, 6);
    phi[426] = minus_x_P_z*minus_U_P_xx + y_P_z*U_P_yx - x_Pb_z*minus_U_P_zx;
    MODELER_ZEROS(phi + 430, 8);
    /* link Pz: acceleration of the origin less gravity, vd_Pz = R_Pz' (vd_Py + U_Py p_Pz) + 2 w_Pz
        x qd_Pz z + qdd_Pz z */
    const double vd_Pz_z = qdd[2] + evra_geo_g;
    MODELER_ZEROS(phi + 438, 8);
    /* link Pa: acceleration of the origin less gravity, vd_Pa = R_Pa' (vd_Pz + U_Pz p_Pa) */
    const double vd_Pa_y = c3*vd_Pz_z - s3*qdd[1];
    MODELER_ZEROS(phi + 446, 8);
    /* link Pb: acceleration of the origin less gravity, vd_Pb = R_Pb' (vd_Pa + U_Pa p_Pb) */
    const double vd_Pb_x = c4*vd_Pa_y + s4*qdd[0];
    const double vd_Pa_x = c3*qdd[1] + s3*vd_Pz_z;
    MODELER_ZEROS(phi + 454, 8);
    const double vd_Pb_y = c4*qdd[0] - s4*vd_Pa_y;
    MODELER_ZEROS(phi + 462, 8);
    /* link P: acceleration of the origin less gravity, vd_P = R_P' (vd_Pb + U_Pb p_P) */
    const double vd_P_y = c5*vd_Pa_x - s5*vd_Pb_y;
    MODELER_ZEROS(phi + 470, 8);
    phi[636] = minus_y_P_x*vd_Pb_x + s4*vd_P_y;
    MODELER_ZEROS(phi + 478, 8);
    phi[846] = -c5*vd_Pb_x;
    MODELER_ZEROS(phi + 486, 8);
    phi[1056] = vd_P_y;
    MODELER_ZEROS(phi + 494, 8);
    phi[7] = s4*U_P_zy - (x_P_x*minus_U_P_xy - minus_y_P_x*minus_U_P_yy);
    MODELER_ZEROS(phi + 502, 8);
    phi[217] = -(x_P_y*minus_U_P_xy + y_P_y*minus_U_P_yy + minus_x_Pb_y*U_P_zy);
    MODELER_ZEROS(phi + 510, 8);
    phi[427] = minus_x_P_z*minus_U_P_xy - y_P_z*minus_U_P_yy + x_Pb_z*U_P_zy;
    const double vd_P_x = c5*vd_Pb_y + s5*vd_Pa_x;
    MODELER_ZEROS(phi + 518, 8);
    phi[637] = x_P_x*vd_Pb_x - s4*vd_P_x;
    MODELER_ZEROS(phi + 526, 8);
    phi[847] = s5*vd_Pb_x;
    MODELER_ZEROS(phi + 534, 8);
    phi[1057] = -vd_P_x;
    MODELER_ZEROS(phi + 542, 8);
    phi[8] = x_P_x*U_P_xz + minus_y_P_x*minus_U_P_yz - s4*minus_U_Pb_xx;
    MODELER_ZEROS(phi + 550, 8);
    phi[218] = x_P_y*U_P_xz - y_P_y*minus_U_P_yz + minus_x_Pb_y*minus_U_Pb_xx;
    MODELER_ZEROS(phi + 558, 8);
    phi[428] = -(minus_x_P_z*U_P_xz + y_P_z*minus_U_P_yz + x_Pb_z*minus_U_Pb_xx);
    MODELER_ZEROS(phi + 566, 8);
    phi[638] = -(x_P_x*vd_P_y + minus_y_P_x*vd_P_x);
    MODELER_ZEROS(phi + 574, 8);
    phi[848] = vd_Pb_y;
    MODELER_ZEROS(phi + 582, 8);
    phi[9] = qdd[0];
    phi[219] = qdd[1];
    MODELER_ZEROS(phi + 590, 8);
    phi[429] = vd_Pz_z;
    MODELER_ZEROS(phi + 598, 8);
    phi[1279] = qdd[6];
    MODELER_ZEROS(phi + 606, 8);
    phi[1289] = qdd[6];
    MODELER_ZEROS(phi + 614, 8);
    phi[1499] = qdd[7];
    MODELER_ZEROS(phi + 622, 8);
    phi[1715] = qdd[8];
    MODELER_ZEROS(phi + 639, 8);
    const double minus_x11_x = x_B1_x*s8;
    MODELER_ZEROS(phi + 647, 8);
    const double ww11_zz = qd[8]*qd[8];
    MODELER_ZEROS(phi + 655, 8);
    const double minus_y11_x = x_B1_x*c8;
    phi[1296] = minus_x11_x*ww11_zz - minus_y11_x*qdd[8];
    MODELER_ZEROS(phi + 663, 8);
    const double minus_x11_y = x_B1_y*s8;
    MODELER_ZEROS(phi + 671, 8);
    const double minus_y11_y = x_B1_y*c8;
    MODELER_ZEROS(phi + 679, 8);
    phi[1506] = minus_x11_y*ww11_zz - minus_y11_y*qdd[8];
    MODELER_ZEROS(phi + 687, 8);
    /* link B1: acceleration of the origin less gravity, vd_B1 = R_B1' (vd_B + U_B p_B1) */
    const double vd_B1_x = x_B1_x*qdd[6] + x_B1_y*qdd[7];
    MODELER_ZEROS(phi + 695, 8);
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd_B1 + U_B1 p11) */
    const double vd11_y = evra_geo_g*s8 - c8*vd_B1_x;
    MODELER_ZEROS(phi + 703, 8);
    phi[1716] = vd11_y;
    MODELER_ZEROS(phi + 711, 8);
    const double t55 = minus_x11_x*qdd[8] + minus_y11_x*ww11_zz;
    MODELER_ZEROS(phi + 719, 8);
    phi[1297] = t55;
    const double t56 = minus_x11_y*qdd[8] + minus_y11_y*ww11_zz;
    MODELER_ZEROS(phi + 727, 8);
    phi[1507] = t56;
    MODELER_ZEROS(phi + 735, 8);
    const double minus_vd11_x = s8*vd_B1_x + evra_geo_g*c8;
    MODELER_ZEROS(phi + 743, 8);
    phi[1717] = minus_vd11_x;
    MODELER_ZEROS(phi + 751, 8);
    phi[1299] = qdd[6];
    MODELER_ZEROS(phi + 759, 8);
    phi[1509] = qdd[7];
    MODELER_ZEROS(phi + 767, 8);
    /* link 21: acceleration of points of the link, U21 = [wd21 x] + [w21 x][w21 x] */
    const double minus_U21_yz = c9*qdd[8];
    MODELER_ZEROS(phi + 775, 8);
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double minus_w21_y = s9*qd[8];
    MODELER_ZEROS(phi + 783, 8);
    const double minus_ww21_yz = qd[9]*minus_w21_y;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double wd21_x = minus_U21_yz - minus_ww21_yz;
    MODELER_ZEROS(phi + 791, 8);
    const double w21_x = c9*qd[8];
    MODELER_ZEROS(phi + 799, 8);
    const double ww21_xz = qd[9]*w21_x;
    MODELER_ZEROS(phi + 807, 8);
    const double t64 = s9*ww21_xz;
    MODELER_ZEROS(phi + 815, 8);
    const double t65 = c9*wd21_x - t64;
    MODELER_ZEROS(phi + 823, 8);
    phi[1720] = t65;
    MODELER_ZEROS(phi + 831, 8);
    const double minus_ww21_xy = w21_x*minus_w21_y;
    MODELER_ZEROS(phi + 839, 1);
    phi[1930] = minus_ww21_xy;
    MODELER_ZEROS(phi + 849, 8);
    const double minus_U21_xz = s9*qdd[8];
    const double minus_wd21_y = minus_U21_xz + ww21_xz;
    MODELER_ZEROS(phi + 857, 8);
    const double U21_zx = ww21_xz + minus_wd21_y;
    MODELER_ZEROS(phi + 865, 8);
    const double minus_U21_zy = minus_ww21_yz - wd21_x;
    MODELER_ZEROS(phi + 873, 8);
    const double t71 = c9*U21_zx - s9*minus_U21_zy;
    MODELER_ZEROS(phi + 881, 8);
    phi[1721] = -t71;
    MODELER_ZEROS(phi + 889, 8);
    const double ww21_zz = qd[9]*qd[9];
    MODELER_ZEROS(phi + 897, 8);
    const double minus_U21_xx = minus_w21_y*minus_w21_y + ww21_zz;
    MODELER_ZEROS(phi + 905, 8);
    const double minus_U21_yy = w21_x*w21_x + ww21_zz;
    MODELER_ZEROS(phi + 913, 8);
    /* link 21: moment on the link at its origin for one unit of a parameter, n21 = J21 wd21 + w21 x
        J21 w21 + MS21 x vd21 */
    const double minus_n21_XYz = minus_U21_xx - minus_U21_yy;
    phi[1931] = -minus_n21_XYz;
    MODELER_ZEROS(phi + 921, 8);
    const double U21_yx = qdd[9] - minus_ww21_xy;
    MODELER_ZEROS(phi + 929, 8);
    const double t77 = c9*U21_yx + s9*(ww11_zz - minus_U21_xx);
    MODELER_ZEROS(phi + 937, 8);
    phi[1722] = t77;
    MODELER_ZEROS(phi + 945, 8);
    phi[1932] = minus_U21_yz;
    MODELER_ZEROS(phi + 953, 8);
    const double t78 = t64 + s9*minus_wd21_y;
    MODELER_ZEROS(phi + 961, 8);
    phi[1723] = t78;
    MODELER_ZEROS(phi + 969, 8);
    phi[1933] = -minus_ww21_xy;
    MODELER_ZEROS(phi + 977, 8);
    const double minus_U21_xy = qdd[9] + minus_ww21_xy;
    const double t80 = c9*(ww11_zz - minus_U21_yy) - s9*minus_U21_xy;
    MODELER_ZEROS(phi + 985, 8);
    phi[1724] = t80;
    MODELER_ZEROS(phi + 993, 8);
    phi[1934] = -minus_U21_xz;
    MODELER_ZEROS(phi + 1001, 8);
    phi[1935] = qdd[9];
    MODELER_ZEROS(phi + 1009, 8);
    const double x21_x = s9*minus_x11_x - x_B1_y*c9;
    MODELER_ZEROS(phi + 1017, 8);
    const double y21_x = x_B1_y*s9 + c9*minus_x11_x;
    MODELER_ZEROS(phi + 1025, 8);
    const double t83 = x21_x*minus_U21_xx - y21_x*U21_yx - minus_y11_x*U21_zx;
    MODELER_ZEROS(phi + 1033, 8);
    phi[1306] = -t83;
    MODELER_ZEROS(phi + 1041, 8);
    const double x21_y = s9*minus_x11_y + x_B1_x*c9;
    const double minus_y21_y = x_B1_x*s9 - c9*minus_x11_y;
    MODELER_ZEROS(phi + 1049, 1);
    const double t86 = x21_y*minus_U21_xx + minus_y21_y*U21_yx - minus_y11_y*U21_zx;
    MODELER_ZEROS(phi + 1058, 8);
    phi[1516] = -t86;
    MODELER_ZEROS(phi + 1066, 8);
    phi[1726] = -s9*vd11_y;
    MODELER_ZEROS(phi + 1074, 8);
    const double vd_B1_y = x_B1_x*qdd[7] - x_B1_y*qdd[6];
    MODELER_ZEROS(phi + 1082, 8);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = s9*vd_B1_y - c9*minus_vd11_x;
    MODELER_ZEROS(phi + 1090, 8);
    phi[1936] = -minus_vd21_y;
    MODELER_ZEROS(phi + 1098, 8);
    const double t89 = x21_x*minus_U21_xy + y21_x*minus_U21_yy + minus_y11_x*minus_U21_zy;
    MODELER_ZEROS(phi + 1106, 8);
    phi[1307] = -t89;
    MODELER_ZEROS(phi + 1114, 8);
    const double t90 = x21_y*minus_U21_xy - minus_y21_y*minus_U21_yy + minus_y11_y*minus_U21_zy;
    phi[1517] = -t90;
    MODELER_ZEROS(phi + 1122, 8);
    phi[1727] = -c9*vd11_y;
    MODELER_ZEROS(phi + 1130, 8);
    const double vd21_x = s9*minus_vd11_x + c9*vd_B1_y;
    MODELER_ZEROS(phi + 1138, 8);
    phi[1937] = -vd21_x;
    MODELER_ZEROS(phi + 1146, 8);
    phi[1308] = -t55;
    MODELER_ZEROS(phi + 1154, 8);
    phi[1518] = -t56;
    MODELER_ZEROS(phi + 1162, 8);
    phi[1728] = -minus_vd11_x;
    MODELER_ZEROS(phi + 1170, 8);
    phi[1309] = qdd[6];
    MODELER_ZEROS(phi + 1178, 8);
    phi[1519] = qdd[7];
    phi[1730] = t65;
    MODELER_ZEROS(phi + 1186, 8);
    phi[1940] = minus_ww21_xy;
    MODELER_ZEROS(phi + 1194, 8);
    phi[1731] = t77;
    MODELER_ZEROS(phi + 1202, 8);
    phi[1941] = minus_U21_yz;
    MODELER_ZEROS(phi + 1210, 8);
    phi[1732] = t71;
    MODELER_ZEROS(phi + 1218, 8);
    phi[1942] = minus_n21_XYz;
    MODELER_ZEROS(phi + 1226, 8);
    phi[1943] = qdd[9];
    MODELER_ZEROS(phi + 1234, 8);
    phi[1734] = -t80;
    MODELER_ZEROS(phi + 1242, 8);
    phi[1944] = minus_U21_xz;
    phi[1735] = t78;
    MODELER_ZEROS(phi + 1250, 8);
    phi[1945] = -minus_ww21_xy;
    MODELER_ZEROS(phi + 1258, 8);
    phi[1316] = -t83;
    MODELER_ZEROS(phi + 1266, 8);
    phi[1526] = -t86;
    MODELER_ZEROS(phi + 1274, 5);
    /* link 31: acceleration of the origin less gravity, vd31 = R31' (vd21 + U21 p31) + 2 w31 x qd31
        z + qdd31 z */
    const double minus_vd31_y = vd11_y - q[10]*minus_U21_zy + qd[10]*w21_x*2.0;
    MODELER_ZEROS(phi + 1280, 8);
    /* link 31: velocity of the origin, for unit speed of each joint below, m31 = R31' (m21 + e21 x
        p31), its own z */
    const double minus_m31_11y = c9*q[10];
    MODELER_ZEROS(phi + 1288, 1);
    phi[1736] = -(s9*minus_vd31_y + U21_zx*minus_m31_11y);
    MODELER_ZEROS(phi + 1290, 6);
    const double vd31_z = minus_vd21_y - q[10]*minus_U21_yy + qdd[10];
    MODELER_ZEROS(phi + 1298, 1);
    phi[1946] = -(vd31_z + q[10]*minus_U21_xx);
    phi[2156] = -U21_yx;
    MODELER_ZEROS(phi + 1300, 6);
    phi[1317] = -t55;
    MODELER_ZEROS(phi + 1310, 6);
    phi[1527] = -t56;
    MODELER_ZEROS(phi + 1320, 6);
    const double t95 = q[10]*minus_U21_xy;
    MODELER_ZEROS(phi + 1328, 1);
    const double vd31_x = vd21_x + t95 + qd[9]*qd[10]*2.0;
    MODELER_ZEROS(phi + 1330, 6);
    phi[1737] = c9*vd31_z - s9*vd31_x + ww11_zz*minus_m31_11y;
    MODELER_ZEROS(phi + 1340, 6);
    phi[1947] = -q[10]*minus_U21_xz;
    MODELER_ZEROS(phi + 1350, 6);
    phi[2157] = minus_U21_yz;
    MODELER_ZEROS(phi + 1358, 1);
    phi[1318] = t89;
    phi[1528] = t90;
    MODELER_ZEROS(phi + 1360, 6);
    phi[1738] = c9*minus_vd31_y - minus_U21_zy*minus_m31_11y;
    MODELER_ZEROS(phi + 1370, 6);
    phi[1948] = t95 + vd31_x;
    MODELER_ZEROS(phi + 1380, 6);
    phi[2158] = -minus_U21_yy;
    MODELER_ZEROS(phi + 1388, 1);
    phi[1319] = x21_x*vd31_x - minus_y11_x*minus_vd31_y - y21_x*vd31_z;
    MODELER_ZEROS(phi + 1390, 6);
    phi[1529] = x21_y*vd31_x - minus_y11_y*minus_vd31_y + minus_y21_y*vd31_z;
    MODELER_ZEROS(phi + 1400, 6);
    phi[1739] = minus_vd31_y*minus_m31_11y;
    MODELER_ZEROS(phi + 1410, 6);
    phi[1949] = q[10]*vd31_x;
    MODELER_ZEROS(phi + 1418, 1);
    phi[2159] = vd31_z;
    phi[2375] = qdd[11];
    MODELER_ZEROS(phi + 1420, 6);
    const double minus_x12_x = x_B2_x*s11;
    MODELER_ZEROS(phi + 1430, 6);
    const double ww12_zz = qd[11]*qd[11];
    MODELER_ZEROS(phi + 1440, 6);
    const double minus_y12_x = x_B2_x*c11;
    MODELER_ZEROS(phi + 1448, 1);
    phi[1326] = minus_x12_x*ww12_zz - minus_y12_x*qdd[11];
    MODELER_ZEROS(phi + 1450, 6);
    const double minus_x12_y = x_B2_y*s11;
    MODELER_ZEROS(phi + 1460, 6);
    const double minus_y12_y = x_B2_y*c11;
    MODELER_ZEROS(phi + 1470, 8);
    phi[1536] = minus_x12_y*ww12_zz - minus_y12_y*qdd[11];
    MODELER_ZEROS(phi + 1478, 8);
    /* link B2: acceleration of the origin less gravity, vd_B2 = R_B2' (vd_B + U_B p_B2) */
    const double vd_B2_x = x_B2_x*qdd[6] + x_B2_y*qdd[7];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd_B2 + U_B2 p12) */
    const double vd12_y = evra_geo_g*s11 - c11*vd_B2_x;
    MODELER_ZEROS(phi + 1486, 8);
    phi[2376] = vd12_y;
    MODELER_ZEROS(phi + 1494, 5);
    const double t104 = minus_x12_x*qdd[11] + minus_y12_x*ww12_zz;
    MODELER_ZEROS(phi + 1500, 6);
    phi[1327] = t104;
    MODELER_ZEROS(phi + 1508, 1);
    const double t105 = minus_x12_y*qdd[11] + minus_y12_y*ww12_zz;
    MODELER_ZEROS(phi + 1510, 6);
    phi[1537] = t105;
    MODELER_ZEROS(phi + 1520, 6);
    const double minus_vd12_x = s11*vd_B2_x + evra_geo_g*c11;
    MODELER_ZEROS(phi + 1530, 6);
    phi[2377] = minus_vd12_x;
    MODELER_ZEROS(phi + 1538, 1);
    phi[1329] = qdd[6];
    phi[1539] = qdd[7];
    MODELER_ZEROS(phi + 1540, 6);
    /* link 22: acceleration of points of the link, U22 = [wd22 x] + [w22 x][w22 x] */
    const double minus_U22_yz = c12*qdd[11];
    MODELER_ZEROS(phi + 1550, 6);
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double minus_w22_y = s12*qd[11];
    MODELER_ZEROS(phi + 1560, 6);
    const double minus_ww22_yz = qd[12]*minus_w22_y;
    MODELER_ZEROS(phi + 1568, 1);
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double wd22_x = minus_U22_yz - minus_ww22_yz;
    MODELER_ZEROS(phi + 1570, 6);
    const double w22_x = c12*qd[11];
    MODELER_ZEROS(phi + 1580, 6);
    const double ww22_xz = qd[12]*w22_x;
    MODELER_ZEROS(phi + 1590, 6);
    const double t113 = s12*ww22_xz;
    MODELER_ZEROS(phi + 1598, 1);
    const double t114 = c12*wd22_x - t113;
    phi[2380] = t114;
    MODELER_ZEROS(phi + 1600, 6);
    const double minus_ww22_xy = w22_x*minus_w22_y;
    MODELER_ZEROS(phi + 1610, 6);
    phi[2590] = minus_ww22_xy;
    MODELER_ZEROS(phi + 1620, 6);
    const double minus_U22_xz = s12*qdd[11];
    MODELER_ZEROS(phi + 1628, 1);
    const double minus_wd22_y = minus_U22_xz + ww22_xz;
    MODELER_ZEROS(phi + 1630, 6);
    const double U22_zx = ww22_xz + minus_wd22_y;
    MODELER_ZEROS(phi + 1640, 6);
    const double minus_U22_zy = minus_ww22_yz - wd22_x;
    MODELER_ZEROS(phi + 1650, 6);
    const double t120 = c12*U22_zx - s12*minus_U22_zy;
    MODELER_ZEROS(phi + 1658, 1);
    phi[2381] = -t120;
    MODELER_ZEROS(phi + 1660, 6);
    const double ww22_zz = qd[12]*qd[12];
    const double minus_U22_xx = minus_w22_y*minus_w22_y + ww22_zz;
    MODELER_ZEROS(phi + 1670, 6);
    const double minus_U22_yy = w22_x*w22_x + ww22_zz;
    MODELER_ZEROS(phi + 1680, 8);
    /* link 22: moment on the link at its origin for one unit of a parameter, n22 = J22 wd22 + w22 x
        J22 w22 + MS22 x vd22 */
    const double minus_n22_XYz = minus_U22_xx - minus_U22_yy;
    MODELER_ZEROS(phi + 1688, 8);
    phi[2591] = -minus_n22_XYz;
    MODELER_ZEROS(phi + 1696, 8);
    const double U22_yx = qdd[12] - minus_ww22_xy;
    MODELER_ZEROS(phi + 1704, 8);
    const double t126 = c12*U22_yx + s12*(ww12_zz - minus_U22_xx);
    MODELER_ZEROS(phi + 1712, 3);
    phi[2382] = t126;
    MODELER_ZEROS(phi + 1718, 2);
    phi[2592] = minus_U22_yz;
    MODELER_ZEROS(phi + 1725, 1);
    const double t127 = t113 + s12*minus_wd22_y;
    phi[2383] = t127;
    MODELER_ZEROS(phi + 1729, 1);
    phi[2593] = -minus_ww22_xy;
    MODELER_ZEROS(phi + 1733, 1);
    const double minus_U22_xy = qdd[12] + minus_ww22_xy;
    MODELER_ZEROS(phi + 1740, 8);
    const double t129 = c12*(ww12_zz - minus_U22_yy) - s12*minus_U22_xy;
    MODELER_ZEROS(phi + 1748, 8);
    phi[2384] = t129;
    MODELER_ZEROS(phi + 1756, 8);
    phi[2594] = -minus_U22_xz;
    MODELER_ZEROS(phi + 1764, 8);
    phi[2595] = qdd[12];
    MODELER_ZEROS(phi + 1772, 8);
    const double x22_x = s12*minus_x12_x - x_B2_y*c12;
    MODELER_ZEROS(phi + 1780, 8);
    const double y22_x = x_B2_y*s12 + c12*minus_x12_x;
    const double t132 = x22_x*minus_U22_xx - y22_x*U22_yx - minus_y12_x*U22_zx;
    MODELER_ZEROS(phi + 1788, 8);
    phi[1336] = -t132;
    MODELER_ZEROS(phi + 1796, 8);
    const double x22_y = s12*minus_x12_y + x_B2_x*c12;
    MODELER_ZEROS(phi + 1804, 8);
    const double minus_y22_y = x_B2_x*s12 - c12*minus_x12_y;
    MODELER_ZEROS(phi + 1812, 8);
    const double t135 = x22_y*minus_U22_xx + minus_y22_y*U22_yx - minus_y12_y*U22_zx;
    MODELER_ZEROS(phi + 1820, 8);
    phi[1546] = -t135;
    MODELER_ZEROS(phi + 1828, 8);
    phi[2386] = -s12*vd12_y;
    MODELER_ZEROS(phi + 1836, 8);
    const double vd_B2_y = x_B2_x*qdd[7] - x_B2_y*qdd[6];
    MODELER_ZEROS(phi + 1844, 8);
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = s12*vd_B2_y - c12*minus_vd12_x;
    phi[2596] = -minus_vd22_y;
    MODELER_ZEROS(phi + 1852, 8);
    const double t138 = x22_x*minus_U22_xy + y22_x*minus_U22_yy + minus_y12_x*minus_U22_zy;
    MODELER_ZEROS(phi + 1860, 8);
    phi[1337] = -t138;
    MODELER_ZEROS(phi + 1868, 8);
    const double t139 = x22_y*minus_U22_xy - minus_y22_y*minus_U22_yy + minus_y12_y*minus_U22_zy;
    MODELER_ZEROS(phi + 1876, 8);
    phi[1547] = -t139;
    MODELER_ZEROS(phi + 1884, 8);
    phi[2387] = -c12*vd12_y;
    MODELER_ZEROS(phi + 1892, 8);
    const double vd22_x = s12*minus_vd12_x + c12*vd_B2_y;
    MODELER_ZEROS(phi + 1900, 8);
    phi[2597] = -vd22_x;
    MODELER_ZEROS(phi + 1908, 8);
    phi[1338] = -t104;
    phi[1548] = -t105;
    MODELER_ZEROS(phi + 1916, 8);
    phi[2388] = -minus_vd12_x;
    MODELER_ZEROS(phi + 1924, 6);
    phi[1339] = qdd[6];
    MODELER_ZEROS(phi + 1938, 2);
    phi[1549] = qdd[7];
    MODELER_ZEROS(phi + 1950, 8);
    phi[2390] = t114;
    MODELER_ZEROS(phi + 1958, 8);
    phi[2600] = minus_ww22_xy;
    MODELER_ZEROS(phi + 1966, 8);
    phi[2391] = t126;
    MODELER_ZEROS(phi + 1974, 8);
    phi[2601] = minus_U22_yz;
    MODELER_ZEROS(phi + 1982, 8);
    phi[2392] = t120;
    phi[2602] = minus_n22_XYz;
    MODELER_ZEROS(phi + 1990, 8);
    phi[2603] = qdd[12];
    MODELER_ZEROS(phi + 1998, 8);
    phi[2394] = -t129;
    MODELER_ZEROS(phi + 2006, 8);
    phi[2604] = minus_U22_xz;
    MODELER_ZEROS(phi + 2014, 8);
    phi[2395] = t127;
    MODELER_ZEROS(phi + 2022, 8);
    phi[2605] = -minus_ww22_xy;
    MODELER_ZEROS(phi + 2030, 8);
    phi[1346] = -t132;
    MODELER_ZEROS(phi + 2038, 8);
    phi[1556] = -t135;
    MODELER_ZEROS(phi + 2046, 8);
    /* link 32: acceleration of the origin less gravity, vd32 = R32' (vd22 + U22 p32) + 2 w32 x qd32
        z + qdd32 z */
    const double minus_vd32_y = vd12_y - q[13]*minus_U22_zy + qd[13]*w22_x*2.0;
    /* link 32: velocity of the origin, for unit speed of each joint below, m32 = R32' (m22 + e22 x
        p32), its own z */
    const double minus_m32_12y = c12*q[13];
    MODELER_ZEROS(phi + 2054, 8);
    phi[2396] = -(s12*minus_vd32_y + U22_zx*minus_m32_12y);
    MODELER_ZEROS(phi + 2062, 8);
    const double vd32_z = minus_vd22_y - q[13]*minus_U22_yy + qdd[13];
    MODELER_ZEROS(phi + 2070, 8);
    phi[2606] = -(vd32_z + q[13]*minus_U22_xx);
    MODELER_ZEROS(phi + 2078, 8);
    phi[2816] = -U22_yx;
    MODELER_ZEROS(phi + 2086, 8);
    phi[1347] = -t104;
    MODELER_ZEROS(phi + 2094, 8);
    phi[1557] = -t105;
    MODELER_ZEROS(phi + 2102, 8);
    const double t144 = q[13]*minus_U22_xy;
    MODELER_ZEROS(phi + 2110, 8);
    const double vd32_x = vd22_x + t144 + qd[12]*qd[13]*2.0;
    phi[2397] = c12*vd32_z - s12*vd32_x + ww12_zz*minus_m32_12y;
    MODELER_ZEROS(phi + 2118, 8);
    phi[2607] = -q[13]*minus_U22_xz;
    MODELER_ZEROS(phi + 2126, 8);
    phi[2817] = minus_U22_yz;
    MODELER_ZEROS(phi + 2134, 8);
    phi[1348] = t138;
    MODELER_ZEROS(phi + 2142, 8);
    phi[1558] = t139;
    MODELER_ZEROS(phi + 2150, 6);
    phi[2398] = c12*minus_vd32_y - minus_U22_zy*minus_m32_12y;
    MODELER_ZEROS(phi + 2160, 8);
    phi[2608] = t144 + vd32_x;
    MODELER_ZEROS(phi + 2168, 8);
    phi[2818] = -minus_U22_yy;
    MODELER_ZEROS(phi + 2176, 8);
    phi[1349] = x22_x*vd32_x - minus_y12_x*minus_vd32_y - y22_x*vd32_z;
    MODELER_ZEROS(phi + 2184, 8);
    phi[1559] = x22_y*vd32_x - minus_y12_y*minus_vd32_y + minus_y22_y*vd32_z;
    phi[2399] = minus_vd32_y*minus_m32_12y;
    MODELER_ZEROS(phi + 2192, 8);
    phi[2609] = q[13]*vd32_x;
    MODELER_ZEROS(phi + 2200, 8);
    phi[2819] = vd32_z;
    MODELER_ZEROS(phi + 2208, 8);
    phi[3035] = qdd[14];
    MODELER_ZEROS(phi + 2216, 8);
    const double minus_x13_x = x_B3_x*s14;
    MODELER_ZEROS(phi + 2224, 8);
    const double ww13_zz = qd[14]*qd[14];
    MODELER_ZEROS(phi + 2232, 8);
    const double minus_y13_x = x_B3_x*c14;
    MODELER_ZEROS(phi + 2240, 8);
    phi[1356] = minus_x13_x*ww13_zz - minus_y13_x*qdd[14];
    MODELER_ZEROS(phi + 2248, 8);
    const double minus_x13_y = x_B3_y*s14;
    const double minus_y13_y = x_B3_y*c14;
    MODELER_ZEROS(phi + 2256, 8);
    phi[1566] = minus_x13_y*ww13_zz - minus_y13_y*qdd[14];
    MODELER_ZEROS(phi + 2264, 8);
    /* link B3: acceleration of the origin less gravity, vd_B3 = R_B3' (vd_B + U_B p_B3) */
    const double vd_B3_x = x_B3_x*qdd[6] + x_B3_y*qdd[7];
    MODELER_ZEROS(phi + 2272, 8);
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd_B3 + U_B3 p13) */
    const double vd13_y = evra_geo_g*s14 - c14*vd_B3_x;
    MODELER_ZEROS(phi + 2280, 8);
    phi[3036] = vd13_y;
    MODELER_ZEROS(phi + 2288, 8);
    const double t153 = minus_x13_x*qdd[14] + minus_y13_x*ww13_zz;
    MODELER_ZEROS(phi + 2296, 8);
    phi[1357] = t153;
    MODELER_ZEROS(phi + 2304, 8);
    const double t154 = minus_x13_y*qdd[14] + minus_y13_y*ww13_zz;
    MODELER_ZEROS(phi + 2312, 8);
    phi[1567] = t154;
    const double minus_vd13_x = s14*vd_B3_x + evra_geo_g*c14;
    MODELER_ZEROS(phi + 2320, 8);
    phi[3037] = minus_vd13_x;
    MODELER_ZEROS(phi + 2328, 8);
    phi[1359] = qdd[6];
    MODELER_ZEROS(phi + 2336, 8);
    phi[1569] = qdd[7];
    MODELER_ZEROS(phi + 2344, 8);
    /* link 23: acceleration of points of the link, U23 = [wd23 x] + [w23 x][w23 x] */
    const double minus_U23_yz = c15*qdd[14];
    MODELER_ZEROS(phi + 2352, 8);
    /* link 23: angular velocity, w23 = R23' w13 + qd23 z */
    const double minus_w23_y = s15*qd[14];
    MODELER_ZEROS(phi + 2360, 8);
    const double minus_ww23_yz = qd[15]*minus_w23_y;
    MODELER_ZEROS(phi + 2368, 7);
    /* link 23: angular acceleration, wd23 = R23' wd13 + (R23' w13) x qd23 z + qdd23 z */
    const double wd23_x = minus_U23_yz - minus_ww23_yz;
    MODELER_ZEROS(phi + 2378, 2);
    const double w23_x = c15*qd[14];
    const double ww23_xz = qd[15]*w23_x;
    MODELER_ZEROS(phi + 2385, 1);
    const double t162 = s15*ww23_xz;
    MODELER_ZEROS(phi + 2389, 1);
    const double t163 = c15*wd23_x - t162;
    MODELER_ZEROS(phi + 2393, 1);
    phi[3040] = t163;
    MODELER_ZEROS(phi + 2400, 8);
    const double minus_ww23_xy = w23_x*minus_w23_y;
    MODELER_ZEROS(phi + 2408, 8);
    phi[3250] = minus_ww23_xy;
    MODELER_ZEROS(phi + 2416, 8);
    const double minus_U23_xz = s15*qdd[14];
    MODELER_ZEROS(phi + 2424, 8);
    const double minus_wd23_y = minus_U23_xz + ww23_xz;
    MODELER_ZEROS(phi + 2432, 8);
    const double U23_zx = ww23_xz + minus_wd23_y;
    const double minus_U23_zy = minus_ww23_yz - wd23_x;
    MODELER_ZEROS(phi + 2440, 8);
    const double t169 = c15*U23_zx - s15*minus_U23_zy;
    MODELER_ZEROS(phi + 2448, 8);
    phi[3041] = -t169;
    MODELER_ZEROS(phi + 2456, 8);
    const double ww23_zz = qd[15]*qd[15];
    MODELER_ZEROS(phi + 2464, 8);
    const double minus_U23_xx = minus_w23_y*minus_w23_y + ww23_zz;
    MODELER_ZEROS(phi + 2472, 8);
    const double minus_U23_yy = w23_x*w23_x + ww23_zz;
    MODELER_ZEROS(phi + 2480, 8);
    /* link 23: moment on the link at its origin for one unit of a parameter, n23 = J23 wd23 + w23 x
        J23 w23 + MS23 x vd23 */
    const double minus_n23_XYz = minus_U23_xx - minus_U23_yy;
    MODELER_ZEROS(phi + 2488, 8);
    phi[3251] = -minus_n23_XYz;
    MODELER_ZEROS(phi + 2496, 8);
    const double U23_yx = qdd[15] - minus_ww23_xy;
    const double t175 = c15*U23_yx + s15*(ww13_zz - minus_U23_xx);
    MODELER_ZEROS(phi + 2504, 8);
    phi[3042] = t175;
    MODELER_ZEROS(phi + 2512, 8);
    phi[3252] = minus_U23_yz;
    MODELER_ZEROS(phi + 2520, 8);
    const double t176 = t162 + s15*minus_wd23_y;
    MODELER_ZEROS(phi + 2528, 8);
    phi[3043] = t176;
    MODELER_ZEROS(phi + 2536, 8);
    phi[3253] = -minus_ww23_xy;
    MODELER_ZEROS(phi + 2544, 8);
    const double minus_U23_xy = qdd[15] + minus_ww23_xy;
    MODELER_ZEROS(phi + 2552, 8);
    const double t178 = c15*(ww13_zz - minus_U23_yy) - s15*minus_U23_xy;
    MODELER_ZEROS(phi + 2560, 8);
    phi[3044] = t178;
    phi[3254] = -minus_U23_xz;
    MODELER_ZEROS(phi + 2568, 8);
    phi[3255] = qdd[15];
    MODELER_ZEROS(phi + 2576, 8);
    const double x23_x = s15*minus_x13_x - x_B3_y*c15;
    MODELER_ZEROS(phi + 2584, 6);
    const double y23_x = x_B3_y*s15 + c15*minus_x13_x;
    MODELER_ZEROS(phi + 2598, 2);
    const double t181 = x23_x*minus_U23_xx - y23_x*U23_yx - minus_y13_x*U23_zx;
    MODELER_ZEROS(phi + 2610, 8);
    phi[1366] = -t181;
    MODELER_ZEROS(phi + 2618, 8);
    const double x23_y = s15*minus_x13_y + x_B3_x*c15;
    MODELER_ZEROS(phi + 2626, 8);
    const double minus_y23_y = x_B3_x*s15 - c15*minus_x13_y;
    MODELER_ZEROS(phi + 2634, 8);
    const double t184 = x23_y*minus_U23_xx + minus_y23_y*U23_yx - minus_y13_y*U23_zx;
    phi[1576] = -t184;
    MODELER_ZEROS(phi + 2642, 8);
    phi[3046] = -s15*vd13_y;
    MODELER_ZEROS(phi + 2650, 8);
    const double vd_B3_y = x_B3_x*qdd[7] - x_B3_y*qdd[6];
    MODELER_ZEROS(phi + 2658, 8);
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = s15*vd_B3_y - c15*minus_vd13_x;
    MODELER_ZEROS(phi + 2666, 8);
    phi[3256] = -minus_vd23_y;
    MODELER_ZEROS(phi + 2674, 8);
    const double t187 = x23_x*minus_U23_xy + y23_x*minus_U23_yy + minus_y13_x*minus_U23_zy;
    MODELER_ZEROS(phi + 2682, 8);
    phi[1367] = -t187;
    MODELER_ZEROS(phi + 2690, 8);
    const double t188 = x23_y*minus_U23_xy - minus_y23_y*minus_U23_yy + minus_y13_y*minus_U23_zy;
    MODELER_ZEROS(phi + 2698, 8);
    phi[1577] = -t188;
    MODELER_ZEROS(phi + 2706, 8);
    phi[3047] = -c15*vd13_y;
    const double vd23_x = s15*minus_vd13_x + c15*vd_B3_y;
    MODELER_ZEROS(phi + 2714, 8);
    phi[3257] = -vd23_x;
    MODELER_ZEROS(phi + 2722, 8);
    phi[1368] = -t153;
    MODELER_ZEROS(phi + 2730, 8);
    phi[1578] = -t154;
    MODELER_ZEROS(phi + 2738, 8);
    phi[3048] = -minus_vd13_x;
    MODELER_ZEROS(phi + 2746, 8);
    phi[1369] = qdd[6];
    MODELER_ZEROS(phi + 2754, 8);
    phi[1579] = qdd[7];
    MODELER_ZEROS(phi + 2762, 8);
    phi[3050] = t163;
    MODELER_ZEROS(phi + 2770, 8);
    phi[3260] = minus_ww23_xy;
    phi[3051] = t175;
    MODELER_ZEROS(phi + 2778, 8);
    phi[3261] = minus_U23_yz;
    MODELER_ZEROS(phi + 2786, 8);
    phi[3052] = t169;
    MODELER_ZEROS(phi + 2794, 8);
    phi[3262] = minus_n23_XYz;
    MODELER_ZEROS(phi + 2802, 8);
    phi[3263] = qdd[15];
    MODELER_ZEROS(phi + 2810, 6);
    phi[3054] = -t178;
    MODELER_ZEROS(phi + 2820, 8);
    phi[3264] = minus_U23_xz;
    MODELER_ZEROS(phi + 2828, 8);
    phi[3055] = t176;
    MODELER_ZEROS(phi + 2836, 8);
    phi[3265] = -minus_ww23_xy;
    phi[1376] = -t181;
    MODELER_ZEROS(phi + 2844, 8);
    phi[1586] = -t184;
    MODELER_ZEROS(phi + 2852, 8);
    /* link 33: acceleration of the origin less gravity, vd33 = R33' (vd23 + U23 p33) + 2 w33 x qd33
        z + qdd33 z */
    const double minus_vd33_y = vd13_y - q[16]*minus_U23_zy + qd[16]*w23_x*2.0;
    MODELER_ZEROS(phi + 2860, 8);
    /* link 33: velocity of the origin, for unit speed of each joint below, m33 = R33' (m23 + e23 x
        p33), its own z */
    const double minus_m33_13y = c15*q[16];
    MODELER_ZEROS(phi + 2868, 8);
    phi[3056] = -(s15*minus_vd33_y + U23_zx*minus_m33_13y);
    MODELER_ZEROS(phi + 2876, 8);
    const double vd33_z = minus_vd23_y - q[16]*minus_U23_yy + qdd[16];
    MODELER_ZEROS(phi + 2884, 8);
    phi[3266] = -(vd33_z + q[16]*minus_U23_xx);
    MODELER_ZEROS(phi + 2892, 8);
    phi[3476] = -U23_yx;
    MODELER_ZEROS(phi + 2900, 8);
    phi[1377] = -t153;
    phi[1587] = -t154;
    MODELER_ZEROS(phi + 2908, 8);
    const double t193 = q[16]*minus_U23_xy;
    MODELER_ZEROS(phi + 2916, 8);
    const double vd33_x = vd23_x + t193 + qd[15]*qd[16]*2.0;
    MODELER_ZEROS(phi + 2924, 8);
    phi[3057] = c15*vd33_z - s15*vd33_x + ww13_zz*minus_m33_13y;
    MODELER_ZEROS(phi + 2932, 8);
    phi[3267] = -q[16]*minus_U23_xz;
    MODELER_ZEROS(phi + 2940, 8);
    phi[3477] = minus_U23_yz;
    MODELER_ZEROS(phi + 2948, 8);
    phi[1378] = t187;
    MODELER_ZEROS(phi + 2956, 8);
    phi[1588] = t188;
    MODELER_ZEROS(phi + 2964, 8);
    phi[3058] = c15*minus_vd33_y - minus_U23_zy*minus_m33_13y;
    phi[3268] = t193 + vd33_x;
    MODELER_ZEROS(phi + 2972, 8);
    phi[3478] = -minus_U23_yy;
    MODELER_ZEROS(phi + 2980, 8);
    phi[1379] = x23_x*vd33_x - minus_y13_x*minus_vd33_y - y23_x*vd33_z;
    MODELER_ZEROS(phi + 2988, 8);
    phi[1589] = x23_y*vd33_x - minus_y13_y*minus_vd33_y + minus_y23_y*vd33_z;
    MODELER_ZEROS(phi + 2996, 8);
    phi[3059] = minus_vd33_y*minus_m33_13y;
    MODELER_ZEROS(phi + 3004, 8);
    phi[3269] = q[16]*vd33_x;
    MODELER_ZEROS(phi + 3012, 8);
    phi[3479] = vd33_z;
    MODELER_ZEROS(phi + 3020, 8);
    phi[3695] = qdd[17];
    MODELER_ZEROS(phi + 3028, 7);
    const double minus_x14_x = x_B4_x*s17;
    const double ww14_zz = qd[17]*qd[17];
    MODELER_ZEROS(phi + 3038, 2);
    const double minus_y14_x = x_B4_x*c17;
    MODELER_ZEROS(phi + 3045, 1);
    phi[1386] = minus_x14_x*ww14_zz - minus_y14_x*qdd[17];
    MODELER_ZEROS(phi + 3049, 1);
    const double minus_x14_y = x_B4_y*s17;
    MODELER_ZEROS(phi + 3053, 1);
    const double minus_y14_y = x_B4_y*c17;
    MODELER_ZEROS(phi + 3060, 8);
    phi[1596] = minus_x14_y*ww14_zz - minus_y14_y*qdd[17];
    MODELER_ZEROS(phi + 3068, 8);
    /* link B4: acceleration of the origin less gravity, vd_B4 = R_B4' (vd_B + U_B p_B4) */
    const double vd_B4_x = x_B4_x*qdd[6] + x_B4_y*qdd[7];
    MODELER_ZEROS(phi + 3076, 8);
    /* link 14: acceleration of the origin less gravity, vd14 = R14' (vd_B4 + U_B4 p14) */
    const double vd14_y = evra_geo_g*s17 - c17*vd_B4_x;
    MODELER_ZEROS(phi + 3084, 8);
    phi[3696] = vd14_y;
    const double t202 = minus_x14_x*qdd[17] + minus_y14_x*ww14_zz;
    MODELER_ZEROS(phi + 3092, 8);
    phi[1387] = t202;
    MODELER_ZEROS(phi + 3100, 8);
    const double t203 = minus_x14_y*qdd[17] + minus_y14_y*ww14_zz;
    MODELER_ZEROS(phi + 3108, 8);
    phi[1597] = t203;
    MODELER_ZEROS(phi + 3116, 8);
    const double minus_vd14_x = s17*vd_B4_x + evra_geo_g*c17;
    MODELER_ZEROS(phi + 3124, 8);
    phi[3697] = minus_vd14_x;
    MODELER_ZEROS(phi + 3132, 8);
    phi[1389] = qdd[6];
    MODELER_ZEROS(phi + 3140, 8);
    phi[1599] = qdd[7];
    MODELER_ZEROS(phi + 3148, 8);
    /* link 24: acceleration of points of the link, U24 = [wd24 x] + [w24 x][w24 x] */
    const double minus_U24_yz = c18*qdd[17];
    /* link 24: angular velocity, w24 = R24' w14 + qd24 z */
    const double minus_w24_y = s18*qd[17];
    MODELER_ZEROS(phi + 3156, 8);
    const double minus_ww24_yz = qd[18]*minus_w24_y;
    MODELER_ZEROS(phi + 3164, 8);
    /* link 24: angular acceleration, wd24 = R24' wd14 + (R24' w14) x qd24 z + qdd24 z */
    const double wd24_x = minus_U24_yz - minus_ww24_yz;
    MODELER_ZEROS(phi + 3172, 8);
    const double w24_x = c18*qd[17];
    MODELER_ZEROS(phi + 3180, 8);
    const double ww24_xz = qd[18]*w24_x;
    MODELER_ZEROS(phi + 3188, 8);
    const double t211 = s18*ww24_xz;
    MODELER_ZEROS(phi + 3196, 8);
    const double t212 = c18*wd24_x - t211;
    MODELER_ZEROS(phi + 3204, 8);
    phi[3700] = t212;
    MODELER_ZEROS(phi + 3212, 8);
    const double minus_ww24_xy = w24_x*minus_w24_y;
    phi[3910] = minus_ww24_xy;
    MODELER_ZEROS(phi + 3220, 8);
    const double minus_U24_xz = s18*qdd[17];
    MODELER_ZEROS(phi + 3228, 8);
    const double minus_wd24_y = minus_U24_xz + ww24_xz;
    MODELER_ZEROS(phi + 3236, 8);
    const double U24_zx = ww24_xz + minus_wd24_y;
    MODELER_ZEROS(phi + 3244, 6);
    const double minus_U24_zy = minus_ww24_yz - wd24_x;
    MODELER_ZEROS(phi + 3258, 2);
    const double t218 = c18*U24_zx - s18*minus_U24_zy;
    MODELER_ZEROS(phi + 3270, 8);
    phi[3701] = -t218;
    MODELER_ZEROS(phi + 3278, 8);
    const double ww24_zz = qd[18]*qd[18];
    MODELER_ZEROS(phi + 3286, 8);
    const double minus_U24_xx = minus_w24_y*minus_w24_y + ww24_zz;
    MODELER_ZEROS(phi + 3294, 8);
    const double minus_U24_yy = w24_x*w24_x + ww24_zz;
    /* link 24: moment on the link at its origin for one unit of a parameter, n24 = J24 wd24 + w24 x
        J24 w24 + MS24 x vd24 */
    const double minus_n24_XYz = minus_U24_xx - minus_U24_yy;
    MODELER_ZEROS(phi + 3302, 8);
    phi[3911] = -minus_n24_XYz;
    MODELER_ZEROS(phi + 3310, 8);
    const double U24_yx = qdd[18] - minus_ww24_xy;
    MODELER_ZEROS(phi + 3318, 8);
    const double t224 = c18*U24_yx + s18*(ww14_zz - minus_U24_xx);
    MODELER_ZEROS(phi + 3326, 8);
    phi[3702] = t224;
    MODELER_ZEROS(phi + 3334, 8);
    phi[3912] = minus_U24_yz;
    MODELER_ZEROS(phi + 3342, 8);
    const double t225 = t211 + s18*minus_wd24_y;
    MODELER_ZEROS(phi + 3350, 8);
    phi[3703] = t225;
    MODELER_ZEROS(phi + 3358, 8);
    phi[3913] = -minus_ww24_xy;
    const double minus_U24_xy = qdd[18] + minus_ww24_xy;
    MODELER_ZEROS(phi + 3366, 8);
    const double t227 = c18*(ww14_zz - minus_U24_yy) - s18*minus_U24_xy;
    MODELER_ZEROS(phi + 3374, 8);
    phi[3704] = t227;
    MODELER_ZEROS(phi + 3382, 8);
    phi[3914] = -minus_U24_xz;
    MODELER_ZEROS(phi + 3390, 8);
    phi[3915] = qdd[18];
    MODELER_ZEROS(phi + 3398, 8);
    const double x24_x = s18*minus_x14_x - x_B4_y*c18;
    MODELER_ZEROS(phi + 3406, 8);
    const double y24_x = x_B4_y*s18 + c18*minus_x14_x;
    MODELER_ZEROS(phi + 3414, 8);
    const double t230 = x24_x*minus_U24_xx - y24_x*U24_yx - minus_y14_x*U24_zx;
    MODELER_ZEROS(phi + 3422, 8);
    phi[1396] = -t230;
    const double x24_y = s18*minus_x14_y + x_B4_x*c18;
    MODELER_ZEROS(phi + 3430, 8);
    const double minus_y24_y = x_B4_x*s18 - c18*minus_x14_y;
    MODELER_ZEROS(phi + 3438, 8);
    const double t233 = x24_y*minus_U24_xx + minus_y24_y*U24_yx - minus_y14_y*U24_zx;
    MODELER_ZEROS(phi + 3446, 8);
    phi[1606] = -t233;
    MODELER_ZEROS(phi + 3454, 8);
    phi[3706] = -s18*vd14_y;
    MODELER_ZEROS(phi + 3462, 8);
    const double vd_B4_y = x_B4_x*qdd[7] - x_B4_y*qdd[6];
    MODELER_ZEROS(phi + 3470, 6);
    /* link 24: acceleration of the origin less gravity, vd24 = R24' (vd14 + U14 p24) */
    const double minus_vd24_y = s18*vd_B4_y - c18*minus_vd14_x;
    MODELER_ZEROS(phi + 3480, 8);
    phi[3916] = -minus_vd24_y;
    MODELER_ZEROS(phi + 3488, 8);
    const double t236 = x24_x*minus_U24_xy + y24_x*minus_U24_yy + minus_y14_x*minus_U24_zy;
    phi[1397] = -t236;
    MODELER_ZEROS(phi + 3496, 8);
    const double t237 = x24_y*minus_U24_xy - minus_y24_y*minus_U24_yy + minus_y14_y*minus_U24_zy;
    MODELER_ZEROS(phi + 3504, 8);
    phi[1607] = -t237;
    MODELER_ZEROS(phi + 3512, 8);
    phi[3707] = -c18*vd14_y;
    MODELER_ZEROS(phi + 3520, 8);
    const double vd24_x = s18*minus_vd14_x + c18*vd_B4_y;
    MODELER_ZEROS(phi + 3528, 8);
    phi[3917] = -vd24_x;
    MODELER_ZEROS(phi + 3536, 8);
    phi[1398] = -t202;
    MODELER_ZEROS(phi + 3544, 8);
    phi[1608] = -t203;
    MODELER_ZEROS(phi + 3552, 8);
    phi[3708] = -minus_vd14_x;
    phi[1399] = qdd[6];
    MODELER_ZEROS(phi + 3560, 8);
    phi[1609] = qdd[7];
    MODELER_ZEROS(phi + 3568, 8);
    phi[3710] = t212;
    MODELER_ZEROS(phi + 3576, 8);
    phi[3920] = minus_ww24_xy;
    MODELER_ZEROS(phi + 3584, 8);
    phi[3711] = t224;
    MODELER_ZEROS(phi + 3592, 8);
    phi[3921] = minus_U24_yz;
    MODELER_ZEROS(phi + 3600, 8);
    phi[3712] = t218;
    MODELER_ZEROS(phi + 3608, 8);
    phi[3922] = minus_n24_XYz;
    MODELER_ZEROS(phi + 3616, 8);
    phi[3923] = qdd[18];
    phi[3714] = -t227;
    MODELER_ZEROS(phi + 3624, 8);
    phi[3924] = minus_U24_xz;
    MODELER_ZEROS(phi + 3632, 8);
    phi[3715] = t225;
    MODELER_ZEROS(phi + 3640, 8);
    phi[3925] = -minus_ww24_xy;
    MODELER_ZEROS(phi + 3648, 8);
    phi[1406] = -t230;
    MODELER_ZEROS(phi + 3656, 8);
    phi[1616] = -t233;
    MODELER_ZEROS(phi + 3664, 8);
    /* link 34: acceleration of the origin less gravity, vd34 = R34' (vd24 + U24 p34) + 2 w34 x qd34
        z + qdd34 z */
    const double minus_vd34_y = vd14_y - q[19]*minus_U24_zy + qd[19]*w24_x*2.0;
    MODELER_ZEROS(phi + 3672, 8);
    /* link 34: velocity of the origin, for unit speed of each joint below, m34 = R34' (m24 + e24 x
        p34), its own z */
    const double minus_m34_14y = c18*q[19];
    MODELER_ZEROS(phi + 3680, 8);
    phi[3716] = -(s18*minus_vd34_y + U24_zx*minus_m34_14y);
    const double vd34_z = minus_vd24_y - q[19]*minus_U24_yy + qdd[19];
    MODELER_ZEROS(phi + 3688, 7);
    phi[3926] = -(vd34_z + q[19]*minus_U24_xx);
    MODELER_ZEROS(phi + 3698, 2);
    phi[4136] = -U24_yx;
    MODELER_ZEROS(phi + 3705, 1);
    phi[1407] = -t202;
    MODELER_ZEROS(phi + 3709, 1);
    phi[1617] = -t203;
    MODELER_ZEROS(phi + 3713, 1);
    const double t242 = q[19]*minus_U24_xy;
    MODELER_ZEROS(phi + 3720, 8);
    const double vd34_x = vd24_x + t242 + qd[18]*qd[19]*2.0;
    MODELER_ZEROS(phi + 3728, 8);
    phi[3717] = c18*vd34_z - s18*vd34_x + ww14_zz*minus_m34_14y;
    MODELER_ZEROS(phi + 3736, 8);
    phi[3927] = -q[19]*minus_U24_xz;
    phi[4137] = minus_U24_yz;
    MODELER_ZEROS(phi + 3744, 8);
    phi[1408] = t236;
    MODELER_ZEROS(phi + 3752, 8);
    phi[1618] = t237;
    MODELER_ZEROS(phi + 3760, 8);
    phi[3718] = c18*minus_vd34_y - minus_U24_zy*minus_m34_14y;
    MODELER_ZEROS(phi + 3768, 8);
    phi[3928] = t242 + vd34_x;
    MODELER_ZEROS(phi + 3776, 8);
    phi[4138] = -minus_U24_yy;
    MODELER_ZEROS(phi + 3784, 8);
    phi[1409] = x24_x*vd34_x - minus_y14_x*minus_vd34_y - y24_x*vd34_z;
    MODELER_ZEROS(phi + 3792, 8);
    phi[1619] = x24_y*vd34_x - minus_y14_y*minus_vd34_y + minus_y24_y*vd34_z;
    MODELER_ZEROS(phi + 3800, 8);
    phi[3719] = minus_vd34_y*minus_m34_14y;
    MODELER_ZEROS(phi + 3808, 8);
    phi[3929] = q[19]*vd34_x;
    phi[4139] = vd34_z;
    MODELER_ZEROS(phi + 3816, 8);
    phi[4355] = qdd[20];
    MODELER_ZEROS(phi + 3824, 8);
    const double minus_x15_x = x_B5_x*s20;
    MODELER_ZEROS(phi + 3832, 8);
    const double ww15_zz = qd[20]*qd[20];
    MODELER_ZEROS(phi + 3840, 8);
    const double minus_y15_x = x_B5_x*c20;
    MODELER_ZEROS(phi + 3848, 8);
    phi[1416] = minus_x15_x*ww15_zz - minus_y15_x*qdd[20];
    MODELER_ZEROS(phi + 3856, 8);
    const double minus_x15_y = x_B5_y*s20;
    MODELER_ZEROS(phi + 3864, 8);
    const double minus_y15_y = x_B5_y*c20;
    MODELER_ZEROS(phi + 3872, 8);
    phi[1626] = minus_x15_y*ww15_zz - minus_y15_y*qdd[20];
    /* link B5: acceleration of the origin less gravity, vd_B5 = R_B5' (vd_B + U_B p_B5) */
    const double vd_B5_x = x_B5_x*qdd[6] + x_B5_y*qdd[7];
    MODELER_ZEROS(phi + 3880, 8);
    /* link 15: acceleration of the origin less gravity, vd15 = R15' (vd_B5 + U_B5 p15) */
    const double vd15_y = evra_geo_g*s20 - c20*vd_B5_x;
    MODELER_ZEROS(phi + 3888, 8);
    phi[4356] = vd15_y;
    MODELER_ZEROS(phi + 3896, 8);
    const double t251 = minus_x15_x*qdd[20] + minus_y15_x*ww15_zz;
    MODELER_ZEROS(phi + 3904, 6);
    phi[1417] = t251;
    MODELER_ZEROS(phi + 3918, 2);
    const double t252 = minus_x15_y*qdd[20] + minus_y15_y*ww15_zz;
    MODELER_ZEROS(phi + 3930, 8);
    phi[1627] = t252;
    MODELER_ZEROS(phi + 3938, 8);
    const double minus_vd15_x = s20*vd_B5_x + evra_geo_g*c20;
    MODELER_ZEROS(phi + 3946, 8);
    phi[4357] = minus_vd15_x;
    phi[1419] = qdd[6];
    MODELER_ZEROS(phi + 3954, 8);
    phi[1629] = qdd[7];
    MODELER_ZEROS(phi + 3962, 8);
    /* link 25: acceleration of points of the link, U25 = [wd25 x] + [w25 x][w25 x] */
    const double minus_U25_yz = c21*qdd[20];
    MODELER_ZEROS(phi + 3970, 8);
    /* link 25: angular velocity, w25 = R25' w15 + qd25 z */
    const double minus_w25_y = s21*qd[20];
    MODELER_ZEROS(phi + 3978, 8);
    const double minus_ww25_yz = qd[21]*minus_w25_y;
    MODELER_ZEROS(phi + 3986, 8);
    /* link 25: angular acceleration, wd25 = R25' wd15 + (R25' w15) x qd25 z + qdd25 z */
    const double wd25_x = minus_U25_yz - minus_ww25_yz;
    MODELER_ZEROS(phi + 3994, 8);
    const double w25_x = c21*qd[20];
    MODELER_ZEROS(phi + 4002, 8);
    const double ww25_xz = qd[21]*w25_x;
    MODELER_ZEROS(phi + 4010, 8);
    const double t260 = s21*ww25_xz;
    const double t261 = c21*wd25_x - t260;
    MODELER_ZEROS(phi + 4018, 8);
    phi[4360] = t261;
    MODELER_ZEROS(phi + 4026, 8);
    const double minus_ww25_xy = w25_x*minus_w25_y;
    MODELER_ZEROS(phi + 4034, 8);
    phi[4570] = minus_ww25_xy;
    MODELER_ZEROS(phi + 4042, 8);
    const double minus_U25_xz = s21*qdd[20];
    MODELER_ZEROS(phi + 4050, 8);
    const double minus_wd25_y = minus_U25_xz + ww25_xz;
    MODELER_ZEROS(phi + 4058, 8);
    const double U25_zx = ww25_xz + minus_wd25_y;
    MODELER_ZEROS(phi + 4066, 8);
    const double minus_U25_zy = minus_ww25_yz - wd25_x;
    MODELER_ZEROS(phi + 4074, 8);
    const double t267 = c21*U25_zx - s21*minus_U25_zy;
    phi[4361] = -t267;
    MODELER_ZEROS(phi + 4082, 8);
    const double ww25_zz = qd[21]*qd[21];
    MODELER_ZEROS(phi + 4090, 8);
    const double minus_U25_xx = minus_w25_y*minus_w25_y + ww25_zz;
    MODELER_ZEROS(phi + 4098, 8);
    const double minus_U25_yy = w25_x*w25_x + ww25_zz;
    MODELER_ZEROS(phi + 4106, 8);
    /* link 25: moment on the link at its origin for one unit of a parameter, n25 = J25 wd25 + w25 x
        J25 w25 + MS25 x vd25 */
    const double minus_n25_XYz = minus_U25_xx - minus_U25_yy;
    MODELER_ZEROS(phi + 4114, 8);
    phi[4571] = -minus_n25_XYz;
    MODELER_ZEROS(phi + 4122, 8);
    const double U25_yx = qdd[21] - minus_ww25_xy;
    MODELER_ZEROS(phi + 4130, 6);
    const double t273 = c21*U25_yx + s21*(ww15_zz - minus_U25_xx);
    MODELER_ZEROS(phi + 4140, 8);
    phi[4362] = t273;
    phi[4572] = minus_U25_yz;
    MODELER_ZEROS(phi + 4148, 8);
    const double t274 = t260 + s21*minus_wd25_y;
    MODELER_ZEROS(phi + 4156, 8);
    phi[4363] = t274;
    MODELER_ZEROS(phi + 4164, 8);
    phi[4573] = -minus_ww25_xy;
    MODELER_ZEROS(phi + 4172, 8);
    const double minus_U25_xy = qdd[21] + minus_ww25_xy;
    MODELER_ZEROS(phi + 4180, 8);
    const double t276 = c21*(ww15_zz - minus_U25_yy) - s21*minus_U25_xy;
    MODELER_ZEROS(phi + 4188, 8);
    phi[4364] = t276;
    MODELER_ZEROS(phi + 4196, 8);
    phi[4574] = -minus_U25_xz;
    MODELER_ZEROS(phi + 4204, 8);
    phi[4575] = qdd[21];
    const double x25_x = s21*minus_x15_x - x_B5_y*c21;
    MODELER_ZEROS(phi + 4212, 8);
    const double y25_x = x_B5_y*s21 + c21*minus_x15_x;
    MODELER_ZEROS(phi + 4220, 8);
    const double t279 = x25_x*minus_U25_xx - y25_x*U25_yx - minus_y15_x*U25_zx;
    MODELER_ZEROS(phi + 4228, 8);
    phi[1426] = -t279;
    MODELER_ZEROS(phi + 4236, 8);
    const double x25_y = s21*minus_x15_y + x_B5_x*c21;
    MODELER_ZEROS(phi + 4244, 8);
    const double minus_y25_y = x_B5_x*s21 - c21*minus_x15_y;
    MODELER_ZEROS(phi + 4252, 8);
    const double t282 = x25_y*minus_U25_xx + minus_y25_y*U25_yx - minus_y15_y*U25_zx;
    MODELER_ZEROS(phi + 4260, 8);
    phi[1636] = -t282;
    MODELER_ZEROS(phi + 4268, 8);
    phi[4366] = -s21*vd15_y;
    const double vd_B5_y = x_B5_x*qdd[7] - x_B5_y*qdd[6];
    MODELER_ZEROS(phi + 4276, 8);
    /* link 25: acceleration of the origin less gravity, vd25 = R25' (vd15 + U15 p25) */
    const double minus_vd25_y = s21*vd_B5_y - c21*minus_vd15_x;
    MODELER_ZEROS(phi + 4284, 8);
    phi[4576] = -minus_vd25_y;
    MODELER_ZEROS(phi + 4292, 8);
    const double t285 = x25_x*minus_U25_xy + y25_x*minus_U25_yy + minus_y15_x*minus_U25_zy;
    MODELER_ZEROS(phi + 4300, 8);
    phi[1427] = -t285;
    MODELER_ZEROS(phi + 4308, 8);
    const double t286 = x25_y*minus_U25_xy - minus_y25_y*minus_U25_yy + minus_y15_y*minus_U25_zy;
    MODELER_ZEROS(phi + 4316, 8);
    phi[1637] = -t286;
    MODELER_ZEROS(phi + 4324, 8);
    phi[4367] = -c21*vd15_y;
    MODELER_ZEROS(phi + 4332, 8);
    const double vd25_x = s21*minus_vd15_x + c21*vd_B5_y;
    phi[4577] = -vd25_x;
    MODELER_ZEROS(phi + 4340, 8);
    phi[1428] = -t251;
    MODELER_ZEROS(phi + 4348, 7);
    phi[1638] = -t252;
    MODELER_ZEROS(phi + 4358, 2);
    phi[4368] = -minus_vd15_x;
    MODELER_ZEROS(phi + 4365, 1);
    phi[1429] = qdd[6];
    MODELER_ZEROS(phi + 4369, 1);
    phi[1639] = qdd[7];
    MODELER_ZEROS(phi + 4373, 1);
    phi[4370] = t261;
    MODELER_ZEROS(phi + 4380, 8);
    phi[4580] = minus_ww25_xy;
    MODELER_ZEROS(phi + 4388, 8);
    phi[4371] = t273;
    MODELER_ZEROS(phi + 4396, 8);
    phi[4581] = minus_U25_yz;
    phi[4372] = t267;
    MODELER_ZEROS(phi + 4404, 8);
    phi[4582] = minus_n25_XYz;
    MODELER_ZEROS(phi + 4412, 8);
    phi[4583] = qdd[21];
    MODELER_ZEROS(phi + 4420, 8);
    phi[4374] = -t276;
    MODELER_ZEROS(phi + 4428, 8);
    phi[4584] = minus_U25_xz;
    MODELER_ZEROS(phi + 4436, 8);
    phi[4375] = t274;
    MODELER_ZEROS(phi + 4444, 8);
    phi[4585] = -minus_ww25_xy;
    MODELER_ZEROS(phi + 4452, 8);
    phi[1436] = -t279;
    MODELER_ZEROS(phi + 4460, 8);
    phi[1646] = -t282;
    /* link 35: acceleration of the origin less gravity, vd35 = R35' (vd25 + U25 p35) + 2 w35 x qd35
        z + qdd35 z */
    const double minus_vd35_y = vd15_y - q[22]*minus_U25_zy + qd[22]*w25_x*2.0;
    MODELER_ZEROS(phi + 4468, 8);
    /* link 35: velocity of the origin, for unit speed of each joint below, m35 = R35' (m25 + e25 x
        p35), its own z */
    const double minus_m35_15y = c21*q[22];
    MODELER_ZEROS(phi + 4476, 8);
    phi[4376] = -(s21*minus_vd35_y + U25_zx*minus_m35_15y);
    MODELER_ZEROS(phi + 4484, 8);
    const double vd35_z = minus_vd25_y - q[22]*minus_U25_yy + qdd[22];
    MODELER_ZEROS(phi + 4492, 8);
    phi[4586] = -(vd35_z + q[22]*minus_U25_xx);
    MODELER_ZEROS(phi + 4500, 8);
    phi[4796] = -U25_yx;
    MODELER_ZEROS(phi + 4508, 8);
    phi[1437] = -t251;
    MODELER_ZEROS(phi + 4516, 8);
    phi[1647] = -t252;
    MODELER_ZEROS(phi + 4524, 8);
    const double t291 = q[22]*minus_U25_xy;
    const double vd35_x = vd25_x + t291 + qd[21]*qd[22]*2.0;
    MODELER_ZEROS(phi + 4532, 8);
    phi[4377] = c21*vd35_z - s21*vd35_x + ww15_zz*minus_m35_15y;
    MODELER_ZEROS(phi + 4540, 8);
    phi[4587] = -q[22]*minus_U25_xz;
    MODELER_ZEROS(phi + 4548, 8);
    phi[4797] = minus_U25_yz;
    MODELER_ZEROS(phi + 4556, 8);
    phi[1438] = t285;
    MODELER_ZEROS(phi + 4564, 6);
    phi[1648] = t286;
    MODELER_ZEROS(phi + 4578, 2);
    phi[4378] = c21*minus_vd35_y - minus_U25_zy*minus_m35_15y;
    MODELER_ZEROS(phi + 4590, 8);
    phi[4588] = t291 + vd35_x;
    MODELER_ZEROS(phi + 4598, 8);
    phi[4798] = -minus_U25_yy;
    phi[1439] = x25_x*vd35_x - minus_y15_x*minus_vd35_y - y25_x*vd35_z;
    MODELER_ZEROS(phi + 4606, 8);
    phi[1649] = x25_y*vd35_x - minus_y15_y*minus_vd35_y + minus_y25_y*vd35_z;
    MODELER_ZEROS(phi + 4614, 8);
    phi[4379] = minus_vd35_y*minus_m35_15y;
    MODELER_ZEROS(phi + 4622, 8);
    phi[4589] = q[22]*vd35_x;
    MODELER_ZEROS(phi + 4630, 8);
    phi[4799] = vd35_z;
    MODELER_ZEROS(phi + 4638, 8);
    phi[5015] = qdd[23];
    MODELER_ZEROS(phi + 4646, 8);
    const double minus_x16_x = x_B6_x*s23;
    MODELER_ZEROS(phi + 4654, 8);
    const double ww16_zz = qd[23]*qd[23];
    MODELER_ZEROS(phi + 4662, 8);
    const double minus_y16_x = x_B6_x*c23;
    phi[1446] = minus_x16_x*ww16_zz - minus_y16_x*qdd[23];
    MODELER_ZEROS(phi + 4670, 8);
    const double minus_x16_y = x_B6_y*s23;
    MODELER_ZEROS(phi + 4678, 8);
    const double minus_y16_y = x_B6_y*c23;
    MODELER_ZEROS(phi + 4686, 8);
    phi[1656] = minus_x16_y*ww16_zz - minus_y16_y*qdd[23];
    MODELER_ZEROS(phi + 4694, 8);
    /* link B6: acceleration of the origin less gravity, vd_B6 = R_B6' (vd_B + U_B p_B6) */
    const double vd_B6_x = x_B6_x*qdd[6] + x_B6_y*qdd[7];
    MODELER_ZEROS(phi + 4702, 8);
    /* link 16: acceleration of the origin less gravity, vd16 = R16' (vd_B6 + U_B6 p16) */
    const double vd16_y = evra_geo_g*s23 - c23*vd_B6_x;
    MODELER_ZEROS(phi + 4710, 8);
    phi[5016] = vd16_y;
    MODELER_ZEROS(phi + 4718, 8);
    const double t300 = minus_x16_x*qdd[23] + minus_y16_x*ww16_zz;
    MODELER_ZEROS(phi + 4726, 8);
    phi[1447] = t300;
    const double t301 = minus_x16_y*qdd[23] + minus_y16_y*ww16_zz;
    MODELER_ZEROS(phi + 4734, 8);
    phi[1657] = t301;
    MODELER_ZEROS(phi + 4742, 8);
    const double minus_vd16_x = s23*vd_B6_x + evra_geo_g*c23;
    MODELER_ZEROS(phi + 4750, 8);
    phi[5017] = minus_vd16_x;
    MODELER_ZEROS(phi + 4758, 8);
    phi[1449] = qdd[6];
    MODELER_ZEROS(phi + 4766, 8);
    phi[1659] = qdd[7];
    MODELER_ZEROS(phi + 4774, 8);
    /* link 26: acceleration of points of the link, U26 = [wd26 x] + [w26 x][w26 x] */
    const double minus_U26_yz = c24*qdd[23];
    MODELER_ZEROS(phi + 4782, 8);
    /* link 26: angular velocity, w26 = R26' w16 + qd26 z */
    const double minus_w26_y = s24*qd[23];
    MODELER_ZEROS(phi + 4790, 6);
    const double minus_ww26_yz = qd[24]*minus_w26_y;
    /* link 26: angular acceleration, wd26 = R26' wd16 + (R26' w16) x qd26 z + qdd26 z */
    const double wd26_x = minus_U26_yz - minus_ww26_yz;
    MODELER_ZEROS(phi + 4800, 8);
    const double w26_x = c24*qd[23];
    MODELER_ZEROS(phi + 4808, 8);
    const double ww26_xz = qd[24]*w26_x;
    MODELER_ZEROS(phi + 4816, 8);
    const double t309 = s24*ww26_xz;
    MODELER_ZEROS(phi + 4824, 8);
    const double t310 = c24*wd26_x - t309;
    MODELER_ZEROS(phi + 4832, 8);
    phi[5020] = t310;
    MODELER_ZEROS(phi + 4840, 8);
    const double minus_ww26_xy = w26_x*minus_w26_y;
    MODELER_ZEROS(phi + 4848, 8);
    phi[5230] = minus_ww26_xy;
    MODELER_ZEROS(phi + 4856, 8);
    const double minus_U26_xz = s24*qdd[23];
    const double minus_wd26_y = minus_U26_xz + ww26_xz;
    MODELER_ZEROS(phi + 4864, 8);
    const double U26_zx = ww26_xz + minus_wd26_y;
    MODELER_ZEROS(phi + 4872, 8);
    const double minus_U26_zy = minus_ww26_yz - wd26_x;
    MODELER_ZEROS(phi + 4880, 8);
    const double t316 = c24*U26_zx - s24*minus_U26_zy;
    MODELER_ZEROS(phi + 4888, 8);
    phi[5021] = -t316;
    MODELER_ZEROS(phi + 4896, 8);
    const double ww26_zz = qd[24]*qd[24];
    MODELER_ZEROS(phi + 4904, 8);
    const double minus_U26_xx = minus_w26_y*minus_w26_y + ww26_zz;
    MODELER_ZEROS(phi + 4912, 8);
    const double minus_U26_yy = w26_x*w26_x + ww26_zz;
    MODELER_ZEROS(phi + 4920, 8);
    /* link 26: moment on the link at its origin for one unit of a parameter, n26 = J26 wd26 + w26 x
        J26 w26 + MS26 x vd26 */
    const double minus_n26_XYz = minus_U26_xx - minus_U26_yy;
    MODELER_ZEROS(phi + 4928, 8);
    phi[5231] = -minus_n26_XYz;
    const double U26_yx = qdd[24] - minus_ww26_xy;
    MODELER_ZEROS(phi + 4936, 8);
    const double t322 = c24*U26_yx + s24*(ww16_zz - minus_U26_xx);
    MODELER_ZEROS(phi + 4944, 8);
    phi[5022] = t322;
    MODELER_ZEROS(phi + 4952, 8);
    phi[5232] = minus_U26_yz;
    MODELER_ZEROS(phi + 4960, 8);
    const double t323 = t309 + s24*minus_wd26_y;
    MODELER_ZEROS(phi + 4968, 8);
    phi[5023] = t323;
    MODELER_ZEROS(phi + 4976, 8);
    phi[5233] = -minus_ww26_xy;
    MODELER_ZEROS(phi + 4984, 8);
    const double minus_U26_xy = qdd[24] + minus_ww26_xy;
    MODELER_ZEROS(phi + 4992, 8);
    const double t325 = c24*(ww16_zz - minus_U26_yy) - s24*minus_U26_xy;
    phi[5024] = t325;
    MODELER_ZEROS(phi + 5000, 8);
    phi[5234] = -minus_U26_xz;
    MODELER_ZEROS(phi + 5008, 7);
    phi[5235] = qdd[24];
    MODELER_ZEROS(phi + 5018, 2);
    const double x26_x = s24*minus_x16_x - x_B6_y*c24;
    MODELER_ZEROS(phi + 5025, 1);
    const double y26_x = x_B6_y*s24 + c24*minus_x16_x;
    MODELER_ZEROS(phi + 5029, 1);
    const double t328 = x26_x*minus_U26_xx - y26_x*U26_yx - minus_y16_x*U26_zx;
    MODELER_ZEROS(phi + 5033, 1);
    phi[1456] = -t328;
    MODELER_ZEROS(phi + 5040, 8);
    const double x26_y = s24*minus_x16_y + x_B6_x*c24;
    MODELER_ZEROS(phi + 5048, 8);
    const double minus_y26_y = x_B6_x*s24 - c24*minus_x16_y;
    const double t331 = x26_y*minus_U26_xx + minus_y26_y*U26_yx - minus_y16_y*U26_zx;
    MODELER_ZEROS(phi + 5056, 8);
    phi[1666] = -t331;
    MODELER_ZEROS(phi + 5064, 8);
    phi[5026] = -s24*vd16_y;
    MODELER_ZEROS(phi + 5072, 8);
    const double vd_B6_y = x_B6_x*qdd[7] - x_B6_y*qdd[6];
    MODELER_ZEROS(phi + 5080, 8);
    /* link 26: acceleration of the origin less gravity, vd26 = R26' (vd16 + U16 p26) */
    const double minus_vd26_y = s24*vd_B6_y - c24*minus_vd16_x;
    MODELER_ZEROS(phi + 5088, 8);
    phi[5236] = -minus_vd26_y;
    MODELER_ZEROS(phi + 5096, 8);
    const double t334 = x26_x*minus_U26_xy + y26_x*minus_U26_yy + minus_y16_x*minus_U26_zy;
    MODELER_ZEROS(phi + 5104, 8);
    phi[1457] = -t334;
    MODELER_ZEROS(phi + 5112, 8);
    const double t335 = x26_y*minus_U26_xy - minus_y26_y*minus_U26_yy + minus_y16_y*minus_U26_zy;
    phi[1667] = -t335;
    MODELER_ZEROS(phi + 5120, 8);
    phi[5027] = -c24*vd16_y;
    MODELER_ZEROS(phi + 5128, 8);
    const double vd26_x = s24*minus_vd16_x + c24*vd_B6_y;
    MODELER_ZEROS(phi + 5136, 8);
    phi[5237] = -vd26_x;
    MODELER_ZEROS(phi + 5144, 8);
    phi[1458] = -t300;
    MODELER_ZEROS(phi + 5152, 8);
    phi[1668] = -t301;
    MODELER_ZEROS(phi + 5160, 8);
    phi[5028] = -minus_vd16_x;
    MODELER_ZEROS(phi + 5168, 8);
    phi[1459] = qdd[6];
    MODELER_ZEROS(phi + 5176, 8);
    phi[1669] = qdd[7];
    phi[5030] = t310;
    MODELER_ZEROS(phi + 5184, 8);
    phi[5240] = minus_ww26_xy;
    MODELER_ZEROS(phi + 5192, 8);
    phi[5031] = t322;
    MODELER_ZEROS(phi + 5200, 8);
    phi[5241] = minus_U26_yz;
    MODELER_ZEROS(phi + 5208, 8);
    phi[5032] = t316;
    MODELER_ZEROS(phi + 5216, 8);
    phi[5242] = minus_n26_XYz;
    MODELER_ZEROS(phi + 5224, 6);
    phi[5243] = qdd[24];
    MODELER_ZEROS(phi + 5238, 2);
    phi[5034] = -t325;
    MODELER_ZEROS(phi + 5250, 8);
    phi[5244] = minus_U26_xz;
    phi[5035] = t323;
    MODELER_ZEROS(phi + 5258, 8);
    phi[5245] = -minus_ww26_xy;
    MODELER_ZEROS(phi + 5266, 8);
    phi[1466] = -t328;
    MODELER_ZEROS(phi + 5274, 8);
    phi[1676] = -t331;
    MODELER_ZEROS(phi + 5282, 8);
    /* link 36: acceleration of the origin less gravity, vd36 = R36' (vd26 + U26 p36) + 2 w36 x qd36
        z + qdd36 z */
    const double minus_vd36_y = vd16_y - q[25]*minus_U26_zy + qd[25]*w26_x*2.0;
    MODELER_ZEROS(phi + 5290, 8);
    /* link 36: velocity of the origin, for unit speed of each joint below, m36 = R36' (m26 + e26 x
        p36), its own z */
    const double minus_m36_16y = c24*q[25];
    MODELER_ZEROS(phi + 5298, 8);
    phi[5036] = -(s24*minus_vd36_y + U26_zx*minus_m36_16y);
    MODELER_ZEROS(phi + 5306, 8);
    const double vd36_z = minus_vd26_y - q[25]*minus_U26_yy + qdd[25];
    MODELER_ZEROS(phi + 5314, 8);
    phi[5246] = -(vd36_z + q[25]*minus_U26_xx);
    phi[5456] = -U26_yx;
    MODELER_ZEROS(phi + 5322, 8);
    phi[1467] = -t300;
    MODELER_ZEROS(phi + 5330, 8);
    phi[1677] = -t301;
    MODELER_ZEROS(phi + 5338, 8);
    const double t340 = q[25]*minus_U26_xy;
    MODELER_ZEROS(phi + 5346, 8);
    const double vd36_x = vd26_x + t340 + qd[24]*qd[25]*2.0;
    MODELER_ZEROS(phi + 5354, 8);
    phi[5037] = c24*vd36_z - s24*vd36_x + ww16_zz*minus_m36_16y;
    MODELER_ZEROS(phi + 5362, 8);
    phi[5247] = -q[25]*minus_U26_xz;
    MODELER_ZEROS(phi + 5370, 8);
    phi[5457] = minus_U26_yz;
    MODELER_ZEROS(phi + 5378, 8);
    phi[1468] = t334;
    phi[1678] = t335;
    MODELER_ZEROS(phi + 5386, 8);
    phi[5038] = c24*minus_vd36_y - minus_U26_zy*minus_m36_16y;
    MODELER_ZEROS(phi + 5394, 8);
    phi[5248] = t340 + vd36_x;
    MODELER_ZEROS(phi + 5402, 8);
    phi[5458] = -minus_U26_yy;
    MODELER_ZEROS(phi + 5410, 8);
    phi[1469] = x26_x*vd36_x - minus_y16_x*minus_vd36_y - y26_x*vd36_z;
    MODELER_ZEROS(phi + 5418, 8);
    phi[1679] = x26_y*vd36_x - minus_y16_y*minus_vd36_y + minus_y26_y*vd36_z;
    MODELER_ZEROS(phi + 5426, 8);
    phi[5039] = minus_vd36_y*minus_m36_16y;
    MODELER_ZEROS(phi + 5434, 8);
    phi[5249] = q[25]*vd36_x;
    MODELER_ZEROS(phi + 5442, 8);
    phi[5459] = vd36_z;
    MODELER_ZEROS(phi + 5450, 6);
}
