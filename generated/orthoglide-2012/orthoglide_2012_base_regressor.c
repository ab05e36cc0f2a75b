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
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
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

/* Regressor of the base parameters.
 * 70 additions, 120 multiplications. */
MODELER_CLONES
void orthoglide_2012_tree_base_regressor(const double q[12], const double qd[12],
                                         const double qdd[12], double MODELER_OUT(phi, 12 * 53))
{
    MODELER_ALL_ZEROS(phi, 636);

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

    phi[159] = qdd[3];
    phi[160] = qd[3];
    MODELER_ZEROS(phi + 0, 8);
    phi[161] = modeler_sign(qd[3]);
    phi[215] = qdd[4];
    MODELER_ZEROS(phi + 8, 8);
    phi[216] = qd[4];
    phi[217] = modeler_sign(qd[4]);
    MODELER_ZEROS(phi + 16, 8);
    /* link 13: acceleration of the origin less gravity, vd13 = R13' (vd0 + U0 p13) + 2 w13 x qd13 z
        + qdd13 z */
    const double vd13_z = qdd[5] - orthoglide_2012_geo_g;
    phi[271] = vd13_z;
    MODELER_ZEROS(phi + 24, 8);
    phi[272] = qdd[5];
    MODELER_ZEROS(phi + 32, 8);
    phi[273] = qd[5];
    phi[274] = modeler_sign(qd[5]);
    MODELER_ZEROS(phi + 40, 8);
    phi[328] = qdd[6];
    const double ww21_zz = qd[6]*qd[6];
    MODELER_ZEROS(phi + 48, 8);
    const double t3 = s6*ww21_zz - c6*qdd[6];
    phi[170] = t3;
    MODELER_ZEROS(phi + 56, 8);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21_y = c6*qdd[3];
    MODELER_ZEROS(phi + 64, 8);
    phi[329] = -minus_vd21_y;
    phi[171] = s6*qdd[6] + c6*ww21_zz;
    MODELER_ZEROS(phi + 72, 8);
    const double minus_vd21_x = s6*qdd[3];
    phi[330] = minus_vd21_x;
    MODELER_ZEROS(phi + 80, 8);
    phi[331] = qd[6];
    phi[332] = modeler_sign(qd[6]);
    MODELER_ZEROS(phi + 88, 8);
    /* link 31: acceleration of points of the link, U31 = [wd31 x] + [w31 x][w31 x] */
    const double U31_yz = s7*qdd[6];
    MODELER_ZEROS(phi + 96, 8);
    /* link 31: angular velocity, w31 = R31' w21 + qd31 z */
    const double minus_w31_y = c7*qd[6];
    const double minus_ww31_yz = qd[7]*minus_w31_y;
    MODELER_ZEROS(phi + 104, 8);
    /* link 31: angular acceleration, wd31 = R31' wd21 + (R31' w21) x qd31 z + qdd31 z */
    const double minus_wd31_x = U31_yz + minus_ww31_yz;
    const double minus_w31_x = s7*qd[6];
    MODELER_ZEROS(phi + 112, 8);
    const double minus_ww31_xz = qd[7]*minus_w31_x;
    phi[333] = s7*minus_wd31_x + c7*minus_ww31_xz;
    MODELER_ZEROS(phi + 120, 8);
    const double ww31_xy = minus_w31_x*minus_w31_y;
    phi[386] = -ww31_xy;
    MODELER_ZEROS(phi + 128, 8);
    const double minus_U31_xz = c7*qdd[6];
    MODELER_ZEROS(phi + 136, 8);
    const double minus_U31_zx = minus_ww31_xz - minus_U31_xz + minus_ww31_xz;
    const double minus_U31_zy = minus_ww31_yz + minus_wd31_x;
    MODELER_ZEROS(phi + 144, 8);
    phi[334] = c7*minus_U31_zy - s7*minus_U31_zx;
    const double ww31_zz = qd[7]*qd[7];
    MODELER_ZEROS(phi + 152, 7);
    const double minus_U31_xx = minus_w31_y*minus_w31_y + ww31_zz;
    const double minus_U31_yy = minus_w31_x*minus_w31_x + ww31_zz;
    MODELER_ZEROS(phi + 162, 8);
    phi[387] = minus_U31_yy - minus_U31_xx;
    MODELER_ZEROS(phi + 172, 7);
    const double U31_yx = qdd[7] + ww31_xy;
    phi[335] = c7*(ww21_zz - minus_U31_xx) - s7*U31_yx;
    MODELER_ZEROS(phi + 181, 2);
    phi[388] = -U31_yz;
    const double minus_U31_xy = qdd[7] - ww31_xy;
    MODELER_ZEROS(phi + 184, 8);
    phi[336] = -(s7*(ww21_zz - minus_U31_yy) + c7*minus_U31_xy);
    phi[389] = -minus_U31_xz;
    MODELER_ZEROS(phi + 192, 8);
    phi[390] = qdd[7];
    MODELER_ZEROS(phi + 200, 8);
    const double minus_x31_z = s6*c7;
    const double y31_z = s6*s7;
    MODELER_ZEROS(phi + 208, 7);
    phi[179] = minus_x31_z*minus_U31_xx + y31_z*U31_yx + c6*minus_U31_zx;
    phi[338] = -c7*minus_vd21_y;
    MODELER_ZEROS(phi + 218, 8);
    phi[391] = orthoglide_2012_geo_g*c7 + s7*minus_vd21_x;
    phi[180] = minus_x31_z*minus_U31_xy - y31_z*minus_U31_yy + c6*minus_U31_zy;
    MODELER_ZEROS(phi + 226, 8);
    phi[339] = s7*minus_vd21_y;
    MODELER_ZEROS(phi + 234, 4);
    phi[392] = c7*minus_vd21_x - orthoglide_2012_geo_g*s7;
    phi[393] = qd[7];
    MODELER_ZEROS(phi + 240, 7);
    phi[394] = modeler_sign(qd[7]);
    phi[183] = t3;
    MODELER_ZEROS(phi + 248, 2);
    phi[342] = orthoglide_2012_geo_d4*c7*qdd[6] - (minus_vd21_y +
        orthoglide_2012_geo_d4*minus_U31_zx);
    phi[395] = orthoglide_2012_geo_d4*s7*ww21_zz;
    MODELER_ZEROS(phi + 251, 8);
    phi[449] = qdd[8];
    const double ww22_zz = qd[8]*qd[8];
    MODELER_ZEROS(phi + 259, 8);
    const double t24 = s8*ww22_zz - c8*qdd[8];
    MODELER_ZEROS(phi + 267, 4);
    phi[238] = t24;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double minus_vd22_y = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    MODELER_ZEROS(phi + 275, 8);
    phi[450] = -minus_vd22_y;
    phi[239] = s8*qdd[8] + c8*ww22_zz;
    MODELER_ZEROS(phi + 283, 8);
    const double minus_vd22_x = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    phi[451] = minus_vd22_x;
    MODELER_ZEROS(phi + 291, 8);
    phi[452] = qd[8];
    MODELER_ZEROS(phi + 299, 6);
    phi[453] = modeler_sign(qd[8]);
    /* link 32: acceleration of points of the link, U32 = [wd32 x] + [w32 x][w32 x] */
    const double U32_yz = s9*qdd[8];
    MODELER_ZEROS(phi + 307, 7);
    /* link 32: angular velocity, w32 = R32' w22 + qd32 z */
    const double minus_w32_y = c9*qd[8];
    const double minus_ww32_yz = qd[9]*minus_w32_y;
    MODELER_ZEROS(phi + 315, 2);
    /* link 32: angular acceleration, wd32 = R32' wd22 + (R32' w22) x qd32 z + qdd32 z */
    const double minus_wd32_x = U32_yz + minus_ww32_yz;
    const double minus_w32_x = s9*qd[8];
    MODELER_ZEROS(phi + 318, 8);
    const double minus_ww32_xz = qd[9]*minus_w32_x;
    MODELER_ZEROS(phi + 326, 2);
    phi[454] = s9*minus_wd32_x + c9*minus_ww32_xz;
    const double ww32_xy = minus_w32_x*minus_w32_y;
    MODELER_ZEROS(phi + 337, 1);
    phi[507] = -ww32_xy;
    const double minus_U32_xz = c9*qdd[8];
    MODELER_ZEROS(phi + 340, 2);
    const double minus_U32_zx = minus_ww32_xz - minus_U32_xz + minus_ww32_xz;
    const double minus_U32_zy = minus_ww32_yz + minus_wd32_x;
    MODELER_ZEROS(phi + 343, 8);
    phi[455] = c9*minus_U32_zy - s9*minus_U32_zx;
    MODELER_ZEROS(phi + 351, 8);
    const double ww32_zz = qd[9]*qd[9];
    const double minus_U32_xx = minus_w32_y*minus_w32_y + ww32_zz;
    MODELER_ZEROS(phi + 359, 8);
    const double minus_U32_yy = minus_w32_x*minus_w32_x + ww32_zz;
    phi[508] = minus_U32_yy - minus_U32_xx;
    MODELER_ZEROS(phi + 367, 8);
    phi[456] = c9*(ww22_zz - minus_U32_xx) - s9*(qdd[9] + ww32_xy);
    phi[509] = -U32_yz;
    MODELER_ZEROS(phi + 375, 8);
    const double minus_U32_xy = qdd[9] - ww32_xy;
    phi[457] = -(s9*(ww22_zz - minus_U32_yy) + c9*minus_U32_xy);
    MODELER_ZEROS(phi + 383, 3);
    phi[510] = -minus_U32_xz;
    MODELER_ZEROS(phi + 396, 8);
    phi[511] = qdd[9];
    phi[247] = s8*c9*minus_U32_xy - s8*s9*minus_U32_yy + c8*minus_U32_zy;
    MODELER_ZEROS(phi + 404, 8);
    phi[459] = s9*minus_vd22_y;
    phi[512] = c9*minus_vd22_x;
    MODELER_ZEROS(phi + 412, 8);
    phi[513] = qd[9];
    phi[514] = modeler_sign(qd[9]);
    MODELER_ZEROS(phi + 420, 8);
    phi[250] = t24;
    MODELER_ZEROS(phi + 428, 8);
    phi[462] = orthoglide_2012_geo_d4*c9*qdd[8] - (minus_vd22_y +
        orthoglide_2012_geo_d4*minus_U32_zx);
    phi[515] = orthoglide_2012_geo_d4*s9*ww22_zz;
    MODELER_ZEROS(phi + 436, 8);
    phi[569] = qdd[10];
    const double ww23_zz = qd[10]*qd[10];
    MODELER_ZEROS(phi + 444, 5);
    const double t42 = s10*ww23_zz - c10*qdd[10];
    phi[305] = t42;
    MODELER_ZEROS(phi + 458, 1);
    /* link 23: acceleration of the origin less gravity, vd23 = R23' (vd13 + U13 p23) */
    const double minus_vd23_y = c10*vd13_z;
    MODELER_ZEROS(phi + 460, 2);
    phi[570] = -minus_vd23_y;
    phi[306] = s10*qdd[10] + c10*ww23_zz;
    MODELER_ZEROS(phi + 463, 8);
    const double minus_vd23_x = s10*vd13_z;
    phi[571] = minus_vd23_x;
    MODELER_ZEROS(phi + 471, 8);
    phi[572] = qd[10];
    phi[573] = modeler_sign(qd[10]);
    MODELER_ZEROS(phi + 479, 8);
    /* link 33: acceleration of points of the link, U33 = [wd33 x] + [w33 x][w33 x] */
    const double U33_yz = s11*qdd[10];
    MODELER_ZEROS(phi + 487, 8);
    /* link 33: angular velocity, w33 = R33' w23 + qd33 z */
    const double minus_w33_y = c11*qd[10];
    const double minus_ww33_yz = qd[11]*minus_w33_y;
    MODELER_ZEROS(phi + 495, 8);
    /* link 33: angular acceleration, wd33 = R33' wd23 + (R33' w23) x qd33 z + qdd33 z */
    const double minus_wd33_x = U33_yz + minus_ww33_yz;
    const double minus_w33_x = s11*qd[10];
    MODELER_ZEROS(phi + 503, 4);
    const double minus_ww33_xz = qd[11]*minus_w33_x;
    phi[574] = s11*minus_wd33_x + c11*minus_ww33_xz;
    MODELER_ZEROS(phi + 516, 8);
    const double ww33_xy = minus_w33_x*minus_w33_y;
    phi[627] = -ww33_xy;
    MODELER_ZEROS(phi + 524, 8);
    const double minus_U33_xz = c11*qdd[10];
    MODELER_ZEROS(phi + 532, 8);
    const double minus_U33_zx = minus_ww33_xz - minus_U33_xz + minus_ww33_xz;
    const double minus_U33_zy = minus_ww33_yz + minus_wd33_x;
    MODELER_ZEROS(phi + 540, 8);
    phi[575] = c11*minus_U33_zy - s11*minus_U33_zx;
    const double ww33_zz = qd[11]*qd[11];
    MODELER_ZEROS(phi + 548, 8);
    const double minus_U33_xx = minus_w33_y*minus_w33_y + ww33_zz;
    const double minus_U33_yy = minus_w33_x*minus_w33_x + ww33_zz;
    MODELER_ZEROS(phi + 556, 8);
    phi[628] = minus_U33_yy - minus_U33_xx;
    MODELER_ZEROS(phi + 564, 5);
    phi[576] = c11*(ww23_zz - minus_U33_xx) - s11*(qdd[11] + ww33_xy);
    phi[629] = -U33_yz;
    MODELER_ZEROS(phi + 578, 1);
    const double minus_U33_xy = qdd[11] - ww33_xy;
    phi[577] = -(s11*(ww23_zz - minus_U33_yy) + c11*minus_U33_xy);
    MODELER_ZEROS(phi + 580, 2);
    phi[630] = -minus_U33_xz;
    phi[631] = qdd[11];
    MODELER_ZEROS(phi + 583, 8);
    phi[314] = s10*c11*minus_U33_xy - s10*s11*minus_U33_yy + c10*minus_U33_zy;
    MODELER_ZEROS(phi + 591, 8);
    phi[579] = s11*minus_vd23_y;
    phi[632] = c11*minus_vd23_x;
    MODELER_ZEROS(phi + 599, 8);
    phi[633] = qd[11];
    phi[634] = modeler_sign(qd[11]);
    MODELER_ZEROS(phi + 607, 8);
    phi[317] = t42;
    phi[582] = orthoglide_2012_geo_d4*c11*qdd[10] - (minus_vd23_y +
        orthoglide_2012_geo_d4*minus_U33_zx);
    MODELER_ZEROS(phi + 615, 8);
    phi[635] = orthoglide_2012_geo_d4*s11*ww23_zz;
    MODELER_ZEROS(phi + 623, 4);
}

/* Regressor of the base parameters, loops closed.
 * 210 additions, 433 multiplications. */
MODELER_CLONES
void orthoglide_2012_tree_rows(const double q[12], const double t[12], const double G[27],
                               const double lu[25], const double v[3], const double a[3],
                               double MODELER_OUT(phi, 3 * 53))
{
    (void)q;
    MODELER_ALL_ZEROS(phi, 159);

    phi[0] = a[0];
    phi[1] = v[0];
    phi[2] = modeler_sign(v[0]);
    phi[56] = a[1];
    phi[57] = v[1];
    phi[58] = modeler_sign(v[1]);
    const double t1 = orthoglide_2012_geo_g - a[2];
    phi[112] = -t1;
    phi[113] = a[2];
    phi[114] = v[2];
    phi[115] = modeler_sign(v[2]);
    const double t2 = G[3]*v[0] + G[12]*v[1] + G[21]*v[2];
    const double t3 = t[0]*t2;
    const double t4 = G[4]*v[0] + G[13]*v[1] + G[22]*v[2];
    const double t5 = t[3]*t4;
    const double t6 = t[1]*t2;
    const double t7 = t[2]*t4;
    const double t8 = orthoglide_2012_geo_d4*(t[2]*t3 - t[1]*t5)*t2;
    const double t9 = t8 - orthoglide_2012_geo_d4*(t[3]*t6 - t[0]*t7)*t4;
    const double t10 = G[8]*v[0] + G[17]*v[1] + G[26]*v[2];
    const double t11 = t[11]*t10;
    const double t12 = orthoglide_2012_geo_d4*t11*t10;
    const double t13 = G[5]*v[0] + G[14]*v[1] + G[23]*v[2];
    const double t14 = t[5]*t13;
    const double t15 = G[6]*v[0] + G[15]*v[1] + G[24]*v[2];
    const double t16 = t[7]*t15;
    const double t17 = t[4]*t13;
    const double t18 = t[6]*t15;
    const double t19 = orthoglide_2012_geo_d4*(t[6]*t14 + t[4]*t16)*t13;
    const double t20 = orthoglide_2012_geo_d4*(t[6]*t17 - t[5]*t16)*t13;
    const double t21 = t20 - orthoglide_2012_geo_d4*(t[7]*t14 - t[4]*t18)*t15;
    const double t22 = orthoglide_2012_geo_d4*t16*t15;
    const double t23 = t19 + orthoglide_2012_geo_d4*(t[7]*t17 + t[5]*t18)*t15 + lu[13]*t21;
    const double t24 = orthoglide_2012_geo_d4*(t[2]*t6 + t[0]*t5)*t2;
    const double t25 = orthoglide_2012_geo_d4*t5*t4;
    const double t26 = t24 + orthoglide_2012_geo_d4*(t[3]*t3 + t[1]*t7)*t4 + lu[10]*t9;
    const double t27 = t26 - lu[11]*t25 - lu[16]*t12;
    const double t28 = lu[14]*t22 - t23 + t12 + lu[21]*t27;
    const double t29 = G[7]*v[0] + G[16]*v[1] + G[25]*v[2];
    const double t30 = t[9]*t29;
    const double t31 = t[8]*t29;
    const double t32 = t[10]*t10;
    const double t33 = orthoglide_2012_geo_d4*(t[10]*t30 + t[8]*t11)*t29;
    const double t34 = orthoglide_2012_geo_d4*(t[10]*t31 - t[9]*t11)*t29;
    const double t35 = t34 - orthoglide_2012_geo_d4*(t[11]*t30 - t[8]*t32)*t10;
    const double t36 = t33 + orthoglide_2012_geo_d4*(t[11]*t31 + t[9]*t32)*t10 + lu[18]*t35;
    const double t37 = lu[8]*(t36 - lu[22]*t27 + lu[24]*t28);
    const double t38 = lu[7]*(t28 + lu[23]*t37);
    const double t39 = lu[1]*(t25 + t37);
    const double t40 = lu[0]*(t9 - lu[4]*(t12 + lu[15]*t38) + lu[9]*t39);
    const double t41 = G[3]*a[0] + G[12]*a[1] + G[21]*a[2] + t40;
    phi[10] = G[3]*t41;
    phi[63] = G[12]*t41;
    phi[116] = G[21]*t41;
    const double t42 = t2*t2;
    const double t43 = t[1]*t42 - t[0]*t41;
    const double t44 = t[0]*a[0];
    phi[11] = t43 - G[3]*t44;
    phi[64] = -G[12]*t44;
    phi[117] = -G[21]*t44;
    const double t45 = t[1]*a[0];
    phi[12] = t[1]*t41 + t[0]*t42 + G[3]*t45;
    phi[65] = G[12]*t45;
    phi[118] = G[21]*t45;
    phi[13] = G[3]*t2;
    phi[66] = G[12]*t2;
    phi[119] = G[21]*t2;
    const double t46 = modeler_sign(t2);
    phi[14] = G[3]*t46;
    phi[67] = G[12]*t46;
    MODELER_ZEROS(phi + 3, 7);
    phi[120] = G[21]*t46;
    const double t47 = t[3]*t41;
    const double t48 = t[2]*t2;
    const double t49 = t4*t48;
    const double t50 = t47 + t49;
    const double t51 = t[3]*t2;
    const double t52 = t4*t51;
    const double t53 = t[3]*t50 + t[2]*t52;
    const double t54 = t51*t48;
    phi[15] = G[3]*t53 - G[4]*t54;
    phi[68] = G[12]*t53 - G[13]*t54;
    phi[121] = G[21]*t53 - G[22]*t54;
    const double t55 = t[2]*t41;
    const double t56 = t52 - t55 + t52;
    const double t57 = t49 + t50;
    const double t58 = t[3]*t56 - t[2]*t57;
    const double t59 = t4*t4;
    const double t60 = t48*t48 + t59;
    const double t61 = t51*t51 + t59;
    const double t62 = t60 - t61;
    phi[16] = -(G[3]*t58 + G[4]*t62);
    phi[69] = -(G[12]*t58 + G[13]*t62);
    phi[122] = -(G[21]*t58 + G[22]*t62);
    const double t63 = t39 - (G[4]*a[0] + G[13]*a[1] + G[22]*a[2]);
    const double t64 = t63 - t54;
    const double t65 = t[3]*t64 + t[2]*(t42 - t60);
    phi[17] = G[3]*t65 - G[4]*t47;
    phi[70] = G[12]*t65 - G[13]*t47;
    phi[123] = G[21]*t65 - G[22]*t47;
    const double t66 = t63 + t54;
    const double t67 = t[3]*(t42 - t61) - t[2]*t66;
    phi[18] = -(G[3]*t67 + G[4]*t55);
    phi[71] = -(G[12]*t67 + G[13]*t55);
    phi[124] = -(G[21]*t67 + G[22]*t55);
    phi[19] = -G[4]*t63;
    phi[72] = -G[13]*t63;
    phi[125] = -G[22]*t63;
    const double t68 = t[1]*t[2];
    const double t69 = t[1]*t[3];
    const double t70 = t[2]*t44;
    const double t71 = orthoglide_2012_geo_g*t[2] + t[3]*t45;
    phi[20] = t68*t60 - t69*t64 + t[0]*t56 - G[3]*t70 + G[4]*t71;
    phi[73] = G[13]*t71 - G[12]*t70;
    phi[126] = G[22]*t71 - G[21]*t70;
    const double t72 = t[3]*t44;
    const double t73 = t[2]*t45 - orthoglide_2012_geo_g*t[3];
    phi[21] = G[4]*t73 - (t68*t66 + t69*t61 - t[0]*t57 - G[3]*t72);
    phi[74] = G[12]*t72 + G[13]*t73;
    phi[127] = G[21]*t72 + G[22]*t73;
    phi[22] = G[4]*t4;
    phi[75] = G[13]*t4;
    phi[128] = G[22]*t4;
    const double t74 = modeler_sign(t4);
    phi[23] = G[4]*t74;
    phi[76] = G[13]*t74;
    phi[129] = G[22]*t74;
    const double t75 = t44 + orthoglide_2012_geo_d4*t56 - orthoglide_2012_geo_d4*t[2]*t41;
    const double t76 = orthoglide_2012_geo_d4*t[3]*t42;
    phi[24] = t43 - G[3]*t75 + G[4]*t76;
    phi[77] = G[13]*t76 - G[12]*t75;
    phi[130] = G[22]*t76 - G[21]*t75;
    const double t77 = lu[6]*(t27 - lu[19]*t37 + lu[20]*t38);
    const double t78 = lu[3]*(t22 + t77);
    const double t79 = G[5]*a[0] + G[14]*a[1] + G[23]*a[2] + lu[2]*(t21 - t37 + lu[12]*t78);
    phi[25] = G[5]*t79;
    phi[78] = G[14]*t79;
    phi[131] = G[23]*t79;
    const double t80 = t[4]*a[1] - orthoglide_2012_geo_g*t[5];
    phi[26] = -G[5]*t80;
    const double t81 = t13*t13;
    MODELER_ZEROS(phi + 53, 3);
    const double t82 = t[5]*t81 - t[4]*t79;
    phi[79] = t82 - G[14]*t80;
    phi[132] = -G[23]*t80;
    const double t83 = orthoglide_2012_geo_g*t[4] + t[5]*a[1];
    phi[27] = G[5]*t83;
    phi[80] = t[5]*t79 + t[4]*t81 + G[14]*t83;
    phi[133] = G[23]*t83;
    phi[28] = G[5]*t13;
    phi[81] = G[14]*t13;
    phi[134] = G[23]*t13;
    const double t84 = modeler_sign(t13);
    phi[29] = G[5]*t84;
    phi[82] = G[14]*t84;
    phi[135] = G[23]*t84;
    const double t85 = t[7]*t79;
    const double t86 = t[6]*t13;
    const double t87 = t15*t86;
    const double t88 = t85 + t87;
    const double t89 = t[7]*t13;
    const double t90 = t15*t89;
    const double t91 = t[7]*t88 + t[6]*t90;
    const double t92 = t89*t86;
    phi[30] = G[5]*t91 - G[6]*t92;
    phi[83] = G[14]*t91 - G[15]*t92;
    phi[136] = G[23]*t91 - G[24]*t92;
    const double t93 = t[6]*t79;
    const double t94 = t90 - t93 + t90;
    const double t95 = t87 + t88;
    const double t96 = t[7]*t94 - t[6]*t95;
    const double t97 = t15*t15;
    const double t98 = t86*t86 + t97;
    const double t99 = t89*t89 + t97;
    const double t100 = t98 - t99;
    phi[31] = -(G[5]*t96 + G[6]*t100);
    phi[84] = -(G[14]*t96 + G[15]*t100);
    phi[137] = -(G[23]*t96 + G[24]*t100);
    const double t101 = t78 - (G[6]*a[0] + G[15]*a[1] + G[24]*a[2]);
    const double t102 = t[7]*(t101 - t92) + t[6]*(t81 - t98);
    phi[32] = G[5]*t102 - G[6]*t85;
    phi[85] = G[14]*t102 - G[15]*t85;
    phi[138] = G[23]*t102 - G[24]*t85;
    const double t103 = t101 + t92;
    const double t104 = t[7]*(t81 - t99) - t[6]*t103;
    phi[33] = -(G[5]*t104 + G[6]*t93);
    phi[86] = -(G[14]*t104 + G[15]*t93);
    phi[139] = -(G[23]*t104 + G[24]*t93);
    phi[34] = -G[6]*t101;
    phi[87] = -G[15]*t101;
    phi[140] = -G[24]*t101;
    const double t105 = t[7]*t80;
    const double t106 = t[6]*t83;
    phi[35] = G[5]*t105 + G[6]*t106;
    phi[88] = G[15]*t106 - (t[5]*t[6]*t103 + t[5]*t[7]*t99 - t[4]*t95 - G[14]*t105);
    phi[141] = G[23]*t105 + G[24]*t106;
    phi[36] = G[6]*t15;
    phi[89] = G[15]*t15;
    phi[142] = G[24]*t15;
    const double t107 = modeler_sign(t15);
    phi[37] = G[6]*t107;
    phi[90] = G[15]*t107;
    phi[143] = G[24]*t107;
    const double t108 = t80 + orthoglide_2012_geo_d4*t94 - orthoglide_2012_geo_d4*t[6]*t79;
    const double t109 = orthoglide_2012_geo_d4*t[7]*t81;
    phi[38] = G[6]*t109 - G[5]*t108;
    phi[91] = t82 - G[14]*t108 + G[15]*t109;
    phi[144] = G[24]*t109 - G[23]*t108;
    const double t110 = G[7]*a[0] + G[16]*a[1] + G[25]*a[2] + lu[5]*(t35 - t77 - lu[17]*t38);
    phi[39] = G[7]*t110;
    phi[92] = G[16]*t110;
    phi[145] = G[25]*t110;
    MODELER_ZEROS(phi + 59, 4);
    const double t111 = t[8]*t1;
    phi[40] = G[7]*t111;
    phi[93] = G[16]*t111;
    const double t112 = t29*t29;
    const double t113 = t[9]*t112 - t[8]*t110;
    phi[146] = t113 + G[25]*t111;
    const double t114 = t[9]*t1;
    phi[41] = -G[7]*t114;
    phi[94] = -G[16]*t114;
    phi[147] = t[9]*t110 + t[8]*t112 - G[25]*t114;
    phi[42] = G[7]*t29;
    phi[95] = G[16]*t29;
    phi[148] = G[25]*t29;
    const double t115 = modeler_sign(t29);
    phi[43] = G[7]*t115;
    phi[96] = G[16]*t115;
    phi[149] = G[25]*t115;
    const double t116 = t[11]*t110;
    const double t117 = t[10]*t29;
    const double t118 = t10*t117;
    const double t119 = t116 + t118;
    const double t120 = t[11]*t29;
    const double t121 = t10*t120;
    const double t122 = t[11]*t119 + t[10]*t121;
    const double t123 = t120*t117;
    phi[44] = G[7]*t122 - G[8]*t123;
    phi[97] = G[16]*t122 - G[17]*t123;
    phi[150] = G[25]*t122 - G[26]*t123;
    const double t124 = t[10]*t110;
    const double t125 = t121 - t124 + t121;
    const double t126 = t118 + t119;
    const double t127 = t[11]*t125 - t[10]*t126;
    const double t128 = t10*t10;
    const double t129 = t117*t117 + t128;
    const double t130 = t120*t120 + t128;
    const double t131 = t129 - t130;
    phi[45] = -(G[7]*t127 + G[8]*t131);
    phi[98] = -(G[16]*t127 + G[17]*t131);
    phi[151] = -(G[25]*t127 + G[26]*t131);
    const double t132 = G[8]*a[0] + G[17]*a[1] + G[26]*a[2] + t38;
    const double t133 = t[11]*(t132 + t123) - t[10]*(t112 - t129);
    phi[46] = -(G[7]*t133 + G[8]*t116);
    phi[99] = -(G[16]*t133 + G[17]*t116);
    phi[152] = -(G[25]*t133 + G[26]*t116);
    const double t134 = t132 - t123;
    const double t135 = t[11]*(t112 - t130) + t[10]*t134;
    phi[47] = -(G[7]*t135 + G[8]*t124);
    phi[100] = -(G[16]*t135 + G[17]*t124);
    phi[153] = -(G[25]*t135 + G[26]*t124);
    phi[48] = G[8]*t132;
    phi[101] = G[17]*t132;
    phi[154] = G[26]*t132;
    const double t136 = t[11]*t111;
    const double t137 = t[10]*t114;
    phi[49] = -(G[7]*t136 + G[8]*t137);
    phi[102] = -(G[16]*t136 + G[17]*t137);
    phi[155] = t[9]*t[10]*t134 - t[9]*t[11]*t130 + t[8]*t126 - G[25]*t136 - G[26]*t137;
    phi[50] = G[8]*t10;
    phi[103] = G[17]*t10;
    phi[156] = G[26]*t10;
    const double t138 = modeler_sign(t10);
    phi[51] = G[8]*t138;
    phi[104] = G[17]*t138;
    phi[157] = G[26]*t138;
    const double t139 = t111 - orthoglide_2012_geo_d4*t125 + orthoglide_2012_geo_d4*t[10]*t110;
    const double t140 = orthoglide_2012_geo_d4*t[11]*t112;
    phi[52] = G[7]*t139 + G[8]*t140;
    phi[105] = G[16]*t139 + G[17]*t140;
    phi[158] = t113 + G[25]*t139 + G[26]*t140;
    MODELER_ZEROS(phi + 106, 6);
}
