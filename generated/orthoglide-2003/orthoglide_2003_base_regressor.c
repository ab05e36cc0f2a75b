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

/* Regressor of the base parameters.
 * 68 additions, 114 multiplications. */
MODELER_CLONES
void orthoglide_2003_tree_base_regressor(const double q[12], const double qd[12],
                                         const double qdd[12], double MODELER_OUT(phi, 12 * 43))
{
    MODELER_ALL_ZEROS(phi, 516);

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
    phi[43] = qdd[1] - orthoglide_2003_geo_g;
    MODELER_ZEROS(phi + 1, 8);
    phi[86] = qdd[2];
    phi[130] = qdd[3];
    MODELER_ZEROS(phi + 9, 8);
    phi[131] = qd[3];
    phi[132] = modeler_sign(qd[3]);
    MODELER_ZEROS(phi + 17, 8);
    phi[133] = 1.0;
    phi[177] = qdd[4];
    MODELER_ZEROS(phi + 25, 8);
    phi[178] = qd[4];
    phi[179] = modeler_sign(qd[4]);
    MODELER_ZEROS(phi + 33, 8);
    phi[180] = 1.0;
    phi[224] = qdd[5];
    MODELER_ZEROS(phi + 41, 2);
    phi[225] = qd[5];
    phi[226] = modeler_sign(qd[5]);
    MODELER_ZEROS(phi + 44, 8);
    phi[227] = 1.0;
    phi[271] = qdd[6];
    MODELER_ZEROS(phi + 52, 8);
    const double ww21_zz = qd[6]*qd[6];
    const double t2 = s6*ww21_zz - c6*qdd[6];
    MODELER_ZEROS(phi + 60, 8);
    phi[143] = t2;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    MODELER_ZEROS(phi + 68, 8);
    phi[272] = -minus_vd21_y;
    phi[144] = s6*qdd[6] + c6*ww21_zz;
    MODELER_ZEROS(phi + 76, 8);
    const double minus_vd21_x = s6*qdd[3];
    phi[273] = minus_vd21_x;
    MODELER_ZEROS(phi + 84, 2);
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double U31_yz = s7*qdd[6];
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    MODELER_ZEROS(phi + 87, 8);
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = U31_yz + minus_ww31_yz;
    MODELER_ZEROS(phi + 95, 8);
    const double minus_w31_x = s7*qd[6];
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    MODELER_ZEROS(phi + 103, 8);
    phi[274] = s7*minus_wd31_x + c7*minus_ww31_xz;
    const double ww31_xy = minus_w31_x*minus_w31_y;
    MODELER_ZEROS(phi + 111, 8);
    phi[317] = -ww31_xy;
    MODELER_ZEROS(phi + 119, 8);
    const double minus_U31_xz = c7*qdd[6];
    const double minus_U31_zx = minus_ww31_xz - minus_U31_xz + minus_ww31_xz;
    MODELER_ZEROS(phi + 127, 3);
    const double minus_U31_zy = minus_ww31_yz + minus_wd31_x;
    phi[275] = c7*minus_U31_zy - s7*minus_U31_zx;
    MODELER_ZEROS(phi + 134, 8);
    const double ww31_zz = qd[7]*qd[7];
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    MODELER_ZEROS(phi + 142, 1);
    const double minus_U31_yy = minus_w31_x*minus_w31_x + ww31_zz;
    phi[318] = minus_U31_yy - minus_U31_xx;
    MODELER_ZEROS(phi + 145, 5);
    phi[276] = c7*(ww21_zz - minus_U31_xx) - s7*(qdd[7] + ww31_xy);
    phi[319] = -U31_yz;
    MODELER_ZEROS(phi + 152, 8);
    const double minus_U31_xy = qdd[7] - ww31_xy;
    phi[277] = -(s7*(ww21_zz - minus_U31_yy) + c7*minus_U31_xy);
    MODELER_ZEROS(phi + 160, 8);
    phi[320] = -minus_U31_xz;
    phi[321] = qdd[7];
    MODELER_ZEROS(phi + 168, 8);
    phi[150] = s6*c7*minus_U31_xy - s6*s7*minus_U31_yy + c6*minus_U31_zy;
    phi[279] = s7*minus_vd21_y;
    MODELER_ZEROS(phi + 176, 1);
    phi[322] = c7*minus_vd21_x - orthoglide_2003_geo_g*s7;
    phi[151] = t2;
    MODELER_ZEROS(phi + 181, 8);
    phi[280] = orthoglide_2003_geo_D41*c7*qdd[6] - (minus_vd21_y +
        orthoglide_2003_geo_D41*minus_U31_zx);
    phi[323] = orthoglide_2003_geo_D41*s7*ww21_zz;
    MODELER_ZEROS(phi + 189, 7);
    phi[367] = qdd[8];
    const double ww22_zz = qd[8]*qd[8];
    MODELER_ZEROS(phi + 198, 5);
    const double t20 = s8*ww22_zz - c8*qdd[8];
    phi[196] = t20;
    MODELER_ZEROS(phi + 205, 8);
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    phi[368] = -minus_vd22_y;
    MODELER_ZEROS(phi + 213, 8);
    phi[197] = s8*qdd[8] + c8*ww22_zz;
    const double minus_vd22_x = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    MODELER_ZEROS(phi + 221, 3);
    phi[369] = minus_vd22_x;
    /* link 32: acceleration of points of the link, U32 = [wd32 x] + [w32 x][w32 x] */
    const double U32_yz = s9*qdd[8];
    MODELER_ZEROS(phi + 228, 8);
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_y = c9*qd[8];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    MODELER_ZEROS(phi + 236, 8);
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = U32_yz + minus_ww32_yz;
    MODELER_ZEROS(phi + 244, 5);
    const double minus_w32_x = s9*qd[8];
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    MODELER_ZEROS(phi + 251, 5);
    phi[370] = s9*minus_wd32_x + c9*minus_ww32_xz;
    const double ww32_xy = minus_w32_x*minus_w32_y;
    MODELER_ZEROS(phi + 258, 8);
    phi[413] = -ww32_xy;
    const double minus_U32_xz = c9*qdd[8];
    MODELER_ZEROS(phi + 266, 5);
    const double minus_U32_zx = minus_ww32_xz - minus_U32_xz + minus_ww32_xz;
    const double minus_U32_zy = minus_ww32_yz + minus_wd32_x;
    MODELER_ZEROS(phi + 278, 1);
    phi[371] = c9*minus_U32_zy - s9*minus_U32_zx;
    const double ww32_zz = qd[9]*qd[9];
    MODELER_ZEROS(phi + 281, 8);
    const double minus_U32_xx = minus_w32_y*minus_w32_y + ww32_zz;
    const double minus_U32_yy = minus_w32_x*minus_w32_x + ww32_zz;
    MODELER_ZEROS(phi + 289, 8);
    phi[414] = minus_U32_yy - minus_U32_xx;
    phi[372] = c9*(ww22_zz - minus_U32_xx) - s9*(qdd[9] + ww32_xy);
    MODELER_ZEROS(phi + 297, 8);
    phi[415] = -U32_yz;
    const double minus_U32_xy = qdd[9] - ww32_xy;
    MODELER_ZEROS(phi + 305, 8);
    phi[373] = -(s9*(ww22_zz - minus_U32_yy) + c9*minus_U32_xy);
    phi[416] = -minus_U32_xz;
    MODELER_ZEROS(phi + 313, 4);
    phi[417] = qdd[9];
    phi[203] = s8*c9*minus_U32_xy - s8*s9*minus_U32_yy + c8*minus_U32_zy;
    MODELER_ZEROS(phi + 324, 8);
    phi[375] = s9*minus_vd22_y;
    phi[418] = c9*minus_vd22_x;
    MODELER_ZEROS(phi + 332, 8);
    phi[204] = t20;
    phi[376] = orthoglide_2003_geo_D42*c9*qdd[8] - (minus_vd22_y +
        orthoglide_2003_geo_D42*minus_U32_zx);
    MODELER_ZEROS(phi + 340, 8);
    phi[419] = orthoglide_2003_geo_D42*s9*ww22_zz;
    phi[463] = qdd[10];
    MODELER_ZEROS(phi + 348, 8);
    const double ww23_zz = qd[10]*qd[10];
    const double t38 = s10*ww23_zz - c10*qdd[10];
    MODELER_ZEROS(phi + 356, 8);
    phi[249] = t38;
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2003_geo_g;
    MODELER_ZEROS(phi + 364, 3);
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    phi[464] = -minus_vd23_y;
    MODELER_ZEROS(phi + 374, 1);
    phi[250] = s10*qdd[10] + c10*ww23_zz;
    MODELER_ZEROS(phi + 377, 8);
    const double minus_vd23_x = s10*vd13_z;
    phi[465] = minus_vd23_x;
    MODELER_ZEROS(phi + 385, 8);
    /* link 33: acceleration of points of the link, U33 = [wd33 x] + [w33 x][w33 x] */
    const double U33_yz = s11*qdd[10];
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_y = c11*qd[10];
    MODELER_ZEROS(phi + 393, 8);
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = U33_yz + minus_ww33_yz;
    MODELER_ZEROS(phi + 401, 8);
    const double minus_w33_x = s11*qd[10];
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    MODELER_ZEROS(phi + 409, 4);
    phi[466] = s11*minus_wd33_x + c11*minus_ww33_xz;
    const double ww33_xy = minus_w33_x*minus_w33_y;
    MODELER_ZEROS(phi + 420, 8);
    phi[509] = -ww33_xy;
    const double minus_U33_xz = c11*qdd[10];
    MODELER_ZEROS(phi + 428, 8);
    const double minus_U33_zx = minus_ww33_xz - minus_U33_xz + minus_ww33_xz;
    const double minus_U33_zy = minus_ww33_yz + minus_wd33_x;
    MODELER_ZEROS(phi + 436, 8);
    phi[467] = c11*minus_U33_zy - s11*minus_U33_zx;
    const double ww33_zz = qd[11]*qd[11];
    MODELER_ZEROS(phi + 444, 8);
    const double minus_U33_xx = minus_w33_y*minus_w33_y + ww33_zz;
    const double minus_U33_yy = minus_w33_x*minus_w33_x + ww33_zz;
    MODELER_ZEROS(phi + 452, 8);
    phi[510] = minus_U33_yy - minus_U33_xx;
    phi[468] = c11*(ww23_zz - minus_U33_xx) - s11*(qdd[11] + ww33_xy);
    MODELER_ZEROS(phi + 460, 3);
    phi[511] = -U33_yz;
    const double minus_U33_xy = qdd[11] - ww33_xy;
    MODELER_ZEROS(phi + 470, 1);
    phi[469] = -(s11*(ww23_zz - minus_U33_yy) + c11*minus_U33_xy);
    phi[512] = -minus_U33_xz;
    MODELER_ZEROS(phi + 473, 8);
    phi[513] = qdd[11];
    phi[256] = s10*c11*minus_U33_xy - s10*s11*minus_U33_yy + c10*minus_U33_zy;
    MODELER_ZEROS(phi + 481, 8);
    phi[471] = s11*minus_vd23_y;
    phi[514] = c11*minus_vd23_x;
    MODELER_ZEROS(phi + 489, 8);
    phi[257] = t38;
    phi[472] = orthoglide_2003_geo_D43*c11*qdd[10] - (minus_vd23_y +
        orthoglide_2003_geo_D43*minus_U33_zx);
    MODELER_ZEROS(phi + 497, 8);
    phi[515] = orthoglide_2003_geo_D43*s11*ww23_zz;
    MODELER_ZEROS(phi + 505, 4);
}

/* Regressor of the base parameters, loops closed.
 * 219 additions, 403 multiplications. */
MODELER_CLONES
void orthoglide_2003_tree_rows(const double q[12], const double t[12], const double G[27],
                               const double lu[25], const double v[3], const double a[3],
                               double MODELER_OUT(phi, 3 * 43))
{
    (void)q;
    MODELER_ALL_ZEROS(phi, 129);

    const double t1 = G[8]*v[0] + G[17]*v[1] + G[26]*v[2];
    const double t2 = t[11]*t1;
    const double t3 = orthoglide_2003_geo_D43*t2*t1;
    const double t4 = G[5]*v[0] + G[14]*v[1] + G[23]*v[2];
    const double t5 = t[5]*t4;
    const double t6 = G[6]*v[0] + G[15]*v[1] + G[24]*v[2];
    const double t7 = t[7]*t6;
    const double t8 = t[4]*t4;
    const double t9 = t[6]*t6;
    const double t10 = orthoglide_2003_geo_D42*(t[6]*t5 + t[4]*t7)*t4;
    const double t11 = orthoglide_2003_geo_D42*(t[6]*t8 - t[5]*t7)*t4;
    const double t12 = t11 - orthoglide_2003_geo_D42*(t[7]*t5 - t[4]*t9)*t6;
    const double t13 = orthoglide_2003_geo_D42*t7*t6;
    const double t14 = t10 + orthoglide_2003_geo_D42*(t[7]*t8 + t[5]*t9)*t6 + lu[13]*t12;
    const double t15 = G[3]*v[0] + G[12]*v[1] + G[21]*v[2];
    const double t16 = t[1]*t15;
    const double t17 = G[4]*v[0] + G[13]*v[1] + G[22]*v[2];
    const double t18 = t[3]*t17;
    const double t19 = t[0]*t15;
    const double t20 = t[2]*t17;
    const double t21 = orthoglide_2003_geo_D41*(t[2]*t16 + t[0]*t18)*t15;
    const double t22 = orthoglide_2003_geo_D41*(t[2]*t19 - t[1]*t18)*t15;
    const double t23 = t22 - orthoglide_2003_geo_D41*(t[3]*t16 - t[0]*t20)*t17;
    const double t24 = orthoglide_2003_geo_D41*t18*t17;
    const double t25 = t21 + orthoglide_2003_geo_D41*(t[3]*t19 + t[1]*t20)*t17 + lu[10]*t23;
    const double t26 = t25 - lu[11]*t24 - lu[16]*t3;
    const double t27 = lu[14]*t13 - t14 + t3 + lu[21]*t26;
    const double t28 = G[7]*v[0] + G[16]*v[1] + G[25]*v[2];
    const double t29 = t[9]*t28;
    const double t30 = t[8]*t28;
    const double t31 = t[10]*t1;
    const double t32 = orthoglide_2003_geo_D43*(t[10]*t29 + t[8]*t2)*t28;
    const double t33 = orthoglide_2003_geo_D43*(t[10]*t30 - t[9]*t2)*t28;
    const double t34 = t33 - orthoglide_2003_geo_D43*(t[11]*t29 - t[8]*t31)*t1;
    const double t35 = t32 + orthoglide_2003_geo_D43*(t[11]*t30 + t[9]*t31)*t1 + lu[18]*t34;
    const double t36 = lu[8]*(t35 - lu[22]*t26 + lu[24]*t27);
    const double t37 = lu[7]*(t27 + lu[23]*t36);
    const double t38 = lu[4]*(t3 + lu[15]*t37);
    const double t39 = t38 - (G[0]*a[0] + G[9]*a[1] + G[18]*a[2]);
    const double t40 = t36 - (G[1]*a[0] + G[10]*a[1] + G[19]*a[2]) + orthoglide_2003_geo_g;
    const double t41 = lu[6]*(t26 - lu[19]*t36 + lu[20]*t37);
    const double t42 = t41 - (G[2]*a[0] + G[11]*a[1] + G[20]*a[2]);
    phi[0] = -(G[0]*t39 + G[1]*t40 + G[2]*t42);
    phi[43] = -(G[9]*t39 + G[10]*t40 + G[11]*t42);
    phi[86] = -(G[18]*t39 + G[19]*t40 + G[20]*t42);
    phi[1] = a[0];
    phi[2] = v[0];
    phi[3] = modeler_sign(v[0]);
    phi[4] = 1.0;
    phi[48] = a[1];
    phi[49] = v[1];
    phi[50] = modeler_sign(v[1]);
    phi[51] = 1.0;
    phi[95] = a[2];
    phi[96] = v[2];
    phi[97] = modeler_sign(v[2]);
    phi[98] = 1.0;
    const double t43 = lu[1]*(t24 + t36);
    const double t44 = G[3]*a[0] + G[12]*a[1] + G[21]*a[2] + lu[0]*(t23 - t38 + lu[9]*t43);
    phi[13] = G[3]*t44;
    MODELER_ZEROS(phi + 5, 8);
    phi[56] = G[12]*t44;
    phi[99] = G[21]*t44;
    const double t45 = t15*t15;
    const double t46 = t[1]*t45 - t[0]*t44;
    const double t47 = t[0]*a[0];
    phi[14] = t46 - G[3]*t47;
    phi[57] = -G[12]*t47;
    phi[100] = -G[21]*t47;
    const double t48 = t[1]*a[0];
    phi[15] = t[1]*t44 + t[0]*t45 + G[3]*t48;
    phi[58] = G[12]*t48;
    phi[101] = G[21]*t48;
    const double t49 = t[3]*t44;
    const double t50 = t[2]*t15;
    const double t51 = t17*t50;
    const double t52 = t49 + t51;
    const double t53 = t[3]*t15;
    const double t54 = t17*t53;
    const double t55 = t[3]*t52 + t[2]*t54;
    const double t56 = t53*t50;
    phi[16] = G[3]*t55 - G[4]*t56;
    phi[59] = G[12]*t55 - G[13]*t56;
    phi[102] = G[21]*t55 - G[22]*t56;
    const double t57 = t[2]*t44;
    const double t58 = t54 - t57 + t54;
    const double t59 = t51 + t52;
    const double t60 = t[3]*t58 - t[2]*t59;
    const double t61 = t17*t17;
    const double t62 = t50*t50 + t61;
    const double t63 = t53*t53 + t61;
    const double t64 = t62 - t63;
    phi[17] = -(G[3]*t60 + G[4]*t64);
    phi[60] = -(G[12]*t60 + G[13]*t64);
    phi[103] = -(G[21]*t60 + G[22]*t64);
    const double t65 = t43 - (G[4]*a[0] + G[13]*a[1] + G[22]*a[2]);
    const double t66 = t[3]*(t65 - t56) + t[2]*(t45 - t62);
    phi[18] = G[3]*t66 - G[4]*t49;
    phi[61] = G[12]*t66 - G[13]*t49;
    phi[104] = G[21]*t66 - G[22]*t49;
    const double t67 = t65 + t56;
    const double t68 = t[3]*(t45 - t63) - t[2]*t67;
    phi[19] = -(G[3]*t68 + G[4]*t57);
    phi[62] = -(G[12]*t68 + G[13]*t57);
    phi[105] = -(G[21]*t68 + G[22]*t57);
    phi[20] = -G[4]*t65;
    phi[63] = -G[13]*t65;
    phi[106] = -G[22]*t65;
    const double t69 = t[3]*t47;
    const double t70 = t[2]*t48 - orthoglide_2003_geo_g*t[3];
    phi[21] = G[4]*t70 - (t[1]*t[2]*t67 + t[1]*t[3]*t63 - t[0]*t59 - G[3]*t69);
    phi[64] = G[12]*t69 + G[13]*t70;
    phi[107] = G[21]*t69 + G[22]*t70;
    const double t71 = t47 + orthoglide_2003_geo_D41*t58 - orthoglide_2003_geo_D41*t[2]*t44;
    const double t72 = orthoglide_2003_geo_D41*t[3]*t45;
    phi[22] = t46 - G[3]*t71 + G[4]*t72;
    phi[65] = G[13]*t72 - G[12]*t71;
    phi[108] = G[22]*t72 - G[21]*t71;
    const double t73 = lu[3]*(t13 + t41);
    const double t74 = G[5]*a[0] + G[14]*a[1] + G[23]*a[2] + lu[2]*(t12 - t36 + lu[12]*t73);
    MODELER_ZEROS(phi + 44, 4);
    phi[23] = G[5]*t74;
    phi[66] = G[14]*t74;
    phi[109] = G[23]*t74;
    const double t75 = t[4]*a[1] - orthoglide_2003_geo_g*t[5];
    phi[24] = -G[5]*t75;
    const double t76 = t4*t4;
    const double t77 = t[5]*t76 - t[4]*t74;
    phi[67] = t77 - G[14]*t75;
    phi[110] = -G[23]*t75;
    const double t78 = orthoglide_2003_geo_g*t[4] + t[5]*a[1];
    phi[25] = G[5]*t78;
    phi[68] = t[5]*t74 + t[4]*t76 + G[14]*t78;
    phi[111] = G[23]*t78;
    const double t79 = t[7]*t74;
    const double t80 = t[6]*t4;
    const double t81 = t6*t80;
    const double t82 = t79 + t81;
    const double t83 = t[7]*t4;
    const double t84 = t6*t83;
    const double t85 = t[7]*t82 + t[6]*t84;
    const double t86 = t83*t80;
    phi[26] = G[5]*t85 - G[6]*t86;
    phi[69] = G[14]*t85 - G[15]*t86;
    phi[112] = G[23]*t85 - G[24]*t86;
    const double t87 = t[6]*t74;
    const double t88 = t84 - t87 + t84;
    const double t89 = t81 + t82;
    const double t90 = t[7]*t88 - t[6]*t89;
    const double t91 = t6*t6;
    const double t92 = t80*t80 + t91;
    const double t93 = t83*t83 + t91;
    const double t94 = t92 - t93;
    phi[27] = -(G[5]*t90 + G[6]*t94);
    phi[70] = -(G[14]*t90 + G[15]*t94);
    phi[113] = -(G[23]*t90 + G[24]*t94);
    const double t95 = t73 - (G[6]*a[0] + G[15]*a[1] + G[24]*a[2]);
    const double t96 = t[7]*(t95 - t86) + t[6]*(t76 - t92);
    phi[28] = G[5]*t96 - G[6]*t79;
    phi[71] = G[14]*t96 - G[15]*t79;
    phi[114] = G[23]*t96 - G[24]*t79;
    const double t97 = t95 + t86;
    const double t98 = t[7]*(t76 - t93) - t[6]*t97;
    phi[29] = -(G[5]*t98 + G[6]*t87);
    phi[72] = -(G[14]*t98 + G[15]*t87);
    phi[115] = -(G[23]*t98 + G[24]*t87);
    phi[30] = -G[6]*t95;
    phi[73] = -G[15]*t95;
    phi[116] = -G[24]*t95;
    const double t99 = t[7]*t75;
    const double t100 = t[6]*t78;
    phi[31] = G[5]*t99 + G[6]*t100;
    phi[74] = G[15]*t100 - (t[5]*t[6]*t97 + t[5]*t[7]*t93 - t[4]*t89 - G[14]*t99);
    phi[117] = G[23]*t99 + G[24]*t100;
    const double t101 = t75 + orthoglide_2003_geo_D42*t88 - orthoglide_2003_geo_D42*t[6]*t74;
    const double t102 = orthoglide_2003_geo_D42*t[7]*t76;
    phi[32] = G[6]*t102 - G[5]*t101;
    phi[75] = t77 - G[14]*t101 + G[15]*t102;
    phi[118] = G[24]*t102 - G[23]*t101;
    const double t103 = G[7]*a[0] + G[16]*a[1] + G[25]*a[2] + lu[5]*(t34 - t41 - lu[17]*t37);
    MODELER_ZEROS(phi + 52, 4);
    phi[33] = G[7]*t103;
    phi[76] = G[16]*t103;
    phi[119] = G[25]*t103;
    const double t104 = orthoglide_2003_geo_g - a[2];
    const double t105 = t[8]*t104;
    phi[34] = G[7]*t105;
    phi[77] = G[16]*t105;
    const double t106 = t28*t28;
    const double t107 = t[9]*t106 - t[8]*t103;
    phi[120] = t107 + G[25]*t105;
    const double t108 = t[9]*t104;
    phi[35] = -G[7]*t108;
    phi[78] = -G[16]*t108;
    phi[121] = t[9]*t103 + t[8]*t106 - G[25]*t108;
    const double t109 = t[11]*t103;
    const double t110 = t[10]*t28;
    const double t111 = t1*t110;
    const double t112 = t109 + t111;
    const double t113 = t[11]*t28;
    const double t114 = t1*t113;
    const double t115 = t[11]*t112 + t[10]*t114;
    const double t116 = t113*t110;
    phi[36] = G[7]*t115 - G[8]*t116;
    phi[79] = G[16]*t115 - G[17]*t116;
    phi[122] = G[25]*t115 - G[26]*t116;
    const double t117 = t[10]*t103;
    const double t118 = t114 - t117 + t114;
    const double t119 = t111 + t112;
    const double t120 = t[11]*t118 - t[10]*t119;
    const double t121 = t1*t1;
    const double t122 = t110*t110 + t121;
    const double t123 = t113*t113 + t121;
    const double t124 = t122 - t123;
    phi[37] = -(G[7]*t120 + G[8]*t124);
    phi[80] = -(G[16]*t120 + G[17]*t124);
    phi[123] = -(G[25]*t120 + G[26]*t124);
    const double t125 = G[8]*a[0] + G[17]*a[1] + G[26]*a[2] + t37;
    const double t126 = t[11]*(t125 + t116) - t[10]*(t106 - t122);
    phi[38] = -(G[7]*t126 + G[8]*t109);
    phi[81] = -(G[16]*t126 + G[17]*t109);
    phi[124] = -(G[25]*t126 + G[26]*t109);
    const double t127 = t125 - t116;
    const double t128 = t[11]*(t106 - t123) + t[10]*t127;
    phi[39] = -(G[7]*t128 + G[8]*t117);
    phi[82] = -(G[16]*t128 + G[17]*t117);
    phi[125] = -(G[25]*t128 + G[26]*t117);
    phi[40] = G[8]*t125;
    phi[83] = G[17]*t125;
    phi[126] = G[26]*t125;
    const double t129 = t[11]*t105;
    const double t130 = t[10]*t108;
    phi[41] = -(G[7]*t129 + G[8]*t130);
    phi[84] = -(G[16]*t129 + G[17]*t130);
    phi[127] = t[9]*t[10]*t127 - t[9]*t[11]*t123 + t[8]*t119 - G[25]*t129 - G[26]*t130;
    const double t131 = t105 - orthoglide_2003_geo_D43*t118 + orthoglide_2003_geo_D43*t[10]*t103;
    const double t132 = orthoglide_2003_geo_D43*t[11]*t106;
    phi[42] = G[7]*t131 + G[8]*t132;
    phi[85] = G[16]*t131 + G[17]*t132;
    phi[128] = t107 + G[25]*t131 + G[26]*t132;
    MODELER_ZEROS(phi + 87, 8);
}
