/* SR400, 6R arm with a parallelogram
 *
 * Functions of sr400.h.
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
#include "sr400.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DSR400_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef SR400_GEO_g
#define SR400_GEO_g 9.81
#endif
#ifndef SR400_GEO_D2
#define SR400_GEO_D2 0.3
#endif
#ifndef SR400_GEO_D3
#define SR400_GEO_D3 0.75
#endif
#ifndef SR400_GEO_D4
#define SR400_GEO_D4 0.15
#endif
#ifndef SR400_GEO_RL4
#define SR400_GEO_RL4 0.8
#endif
#ifndef SR400_GEO_D8
#define SR400_GEO_D8 0.35
#endif

static const double sr400_geo_g = SR400_GEO_g;
static const double sr400_geo_D2 = SR400_GEO_D2;
static const double sr400_geo_D3 = SR400_GEO_D3;
static const double sr400_geo_D4 = SR400_GEO_D4;
static const double sr400_geo_RL4 = SR400_GEO_RL4;
static const double sr400_geo_D8 = SR400_GEO_D8;

/* Regressor of the standard parameters.
 * 329 additions, 445 multiplications. */
MODELER_CLONES
void sr400_regressor(const double q[SR400_JOINTS], const double qd[SR400_JOINTS],
                     const double qdd[SR400_JOINTS], double MODELER_OUT(phi, 6 * 80))
{
    MODELER_ALL_ZEROS(phi, 480);

    const double k1 = sr400_geo_D2*sr400_geo_D2;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    const double t1 = q[1] - q[5];
    double sa2, ca2;
    modeler_sincos(t1, &sa2, &ca2);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    phi[5] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    const double t8 = c1*minus_ww2_xz;
    const double t9 = s1*minus_wd2_x + t8;
    MODELER_ZEROS(phi + 0, 5);
    phi[10] = t9;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    phi[90] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    const double t15 = s1*minus_U2_zx - c1*minus_U2_zy;
    phi[11] = -t15;
    MODELER_ZEROS(phi + 6, 4);
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    /* link 2: moment on the link at its origin for one unit of a parameter, n2 = J2 wd2 + w2 x J2
        w2 + MS2 x vd2 */
    const double minus_n2_XYz = minus_U2_xx - minus_U2_yy;
    phi[91] = -minus_n2_XYz;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    const double t22 = s1*U2_yx - c1*(ww1_zz - minus_U2_xx);
    MODELER_ZEROS(phi + 15, 1);
    phi[12] = -t22;
    phi[92] = -U2_yz;
    const double t23 = t8 - c1*minus_wd2_y;
    phi[13] = -t23;
    phi[93] = ww2_xy;
    const double minus_U2_xy = qdd[1] - ww2_xy;
    const double t25 = s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy;
    phi[14] = -t25;
    phi[94] = -minus_U2_xz;
    MODELER_ZEROS(phi + 18, 1);
    phi[95] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_geo_D2*qdd[0];
    phi[16] = c1*vd2_z - sr400_geo_D2*minus_U2_zx;
    const double minus_vd2a_x = sr400_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_geo_g*c1 - s1*minus_vd2a_x;
    phi[96] = -minus_vd2_y;
    phi[17] = -(s1*vd2_z + sr400_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_geo_g*s1;
    phi[97] = minus_vd2_x;
    MODELER_ZEROS(phi + 25, 1);
    const double t30 = k1*qdd[0];
    phi[19] = t30;
    const double t31 = qd[1] - qd[5];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = sa2*minus_w2_y - ca2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = sa2*minus_wd2_x + ca2*minus_wd2_y - t31*minus_w3_y;
    const double minus_w3_x = sa2*minus_w2_x + ca2*minus_w2_y;
    const double minus_ww3_xz = qd[5]*minus_w3_x;
    const double t36 = s5*minus_ww3_xz;
    MODELER_ZEROS(phi + 65, 1);
    const double t37 = c5*minus_wd3_x - t36;
    phi[20] = t37;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    phi[420] = -ww3_xy;
    const double minus_wd3_y = sa2*minus_wd2_y - ca2*minus_wd2_x + t31*minus_w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    const double minus_ww3_yz = qd[5]*minus_w3_y;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    const double t43 = c5*U3_zx - s5*minus_U3_zy;
    MODELER_ZEROS(phi + 68, 1);
    phi[21] = t43;
    const double ww3_zz = qd[5]*qd[5];
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    phi[421] = -minus_n3_XYz;
    const double U3_yx = qdd[5] + ww3_xy;
    const double t49 = c5*U3_yx + s5*(ww1_zz - minus_U3_xx);
    MODELER_ZEROS(phi + 75, 1);
    phi[22] = -t49;
    const double U3_yz = minus_wd3_x - minus_ww3_yz;
    phi[422] = -U3_yz;
    const double t51 = t36 - s5*minus_wd3_y;
    phi[23] = t51;
    phi[423] = ww3_xy;
    const double minus_U3_xy = qdd[5] - ww3_xy;
    const double t53 = c5*(ww1_zz - minus_U3_yy) - s5*minus_U3_xy;
    phi[24] = -t53;
    MODELER_ZEROS(phi + 80, 8);
    const double minus_U3_xz = minus_wd3_y + minus_ww3_xz;
    phi[424] = -minus_U3_xz;
    phi[425] = qdd[5];
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_geo_D2 + sr400_geo_D3*c1;
    phi[26] = m3_1z*U3_zx - s5*vd3_z;
    const double m3_2x = sr400_geo_D3*ca2;
    const double m3_2y = sr400_geo_D3*sa2;
    phi[106] = U3_yx*m3_2y - minus_U3_xx*m3_2x;
    MODELER_ZEROS(phi + 88, 2);
    const double minus_vd3a_y = minus_vd2_y - sr400_geo_D3*U2_yx;
    const double minus_vd3a_x = minus_vd2_x + sr400_geo_D3*minus_U2_xx;
    const double minus_vd3_y = sa2*minus_vd3a_y - ca2*minus_vd3a_x;
    phi[426] = -minus_vd3_y;
    phi[27] = -(c5*vd3_z + m3_1z*minus_U3_zy);
    const double t62 = minus_U3_xy*m3_2x + minus_U3_yy*m3_2y;
    phi[107] = -t62;
    const double minus_vd3_x = sa2*minus_vd3a_x + ca2*minus_vd3a_y;
    MODELER_ZEROS(phi + 98, 8);
    phi[427] = minus_vd3_x;
    phi[28] = -(c5*minus_vd3_y + s5*minus_vd3_x + m3_1z*ww1_zz);
    phi[108] = U3_yz*m3_2y - minus_U3_xz*m3_2x;
    phi[29] = m3_1z*vd3_z;
    phi[109] = -(minus_vd3_x*m3_2x + minus_vd3_y*m3_2y);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c2*qd[5] - s2*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c2*minus_wd3_x + s2*qdd[5] + qd[2]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c2*c5;
    const double minus_w4_x = c2*minus_w3_x + s2*qd[5];
    MODELER_ZEROS(phi + 110, 6);
    const double w4_z = qd[2] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s2*c5;
    const double t71 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    const double t73 = s5*ww4_xy;
    phi[30] = minus_wd4_x*minus_e4_1x - t71 - t73;
    phi[190] = -ww4_xy;
    MODELER_ZEROS(phi + 120, 6);
    const double t74 = c2*minus_ww4_xz;
    phi[430] = s2*minus_wd4_x + t74;
    const double minus_wd4_y = c2*qdd[5] - s2*minus_wd3_x - qd[2]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    MODELER_ZEROS(phi + 130, 6);
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    phi[31] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y - s5*minus_n4_XYz;
    phi[191] = -minus_n4_XYz;
    phi[431] = s2*U4_zx + c2*minus_U4_zy;
    const double wd4_z = qdd[2] - minus_wd3_y;
    const double U4_yx = wd4_z + ww4_xy;
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    phi[32] = -(U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy + s5*U4_yz);
    MODELER_ZEROS(phi + 140, 8);
    phi[192] = -U4_yz;
    phi[432] = c2*minus_n4_XZy - s2*U4_yx;
    const double t87 = minus_ww4_yz*minus_e4_1x;
    phi[33] = t73 - (t87 + minus_wd4_y*e4_1y);
    phi[193] = ww4_xy;
    const double t88 = s2*minus_ww4_yz;
    phi[433] = c2*minus_wd4_y - t88;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    MODELER_ZEROS(phi + 148, 2);
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    phi[34] = -(minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y + s5*minus_U4_xz);
    phi[194] = -minus_U4_xz;
    phi[434] = -(s2*n4_YZx + c2*minus_U4_xy);
    phi[35] = t71 + t87 + s5*wd4_z;
    phi[195] = wd4_z;
    phi[435] = t88 - t74;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_geo_RL4*minus_U3_yy - sr400_geo_D4*U3_yx + minus_vd3_y;
    MODELER_ZEROS(phi + 158, 8);
    const double vd4a_z = sr400_geo_D4*U3_zx - sr400_geo_RL4*minus_U3_zy + vd3_z;
    const double t94 = sr400_geo_RL4*minus_U3_xy;
    const double minus_vd4a_x = sr400_geo_D4*minus_U3_xx + t94 + minus_vd3_x;
    const double minus_vd4_y = c2*vd4a_z - s2*minus_vd4a_x;
    const double t97 = m3_1z - (sr400_geo_RL4*c5 + sr400_geo_D4*s5);
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s2*t97;
    const double minus_m4_1y = c2*t97;
    phi[36] = minus_vd4_z*e4_1y - s5*minus_vd4_y + (minus_U4_xx*minus_m4_1x - U4_yx*minus_m4_1y);
    MODELER_ZEROS(phi + 166, 8);
    const double t100 = sr400_geo_RL4 - m3_2x;
    const double minus_m4_2x = c2*t100;
    const double minus_m4_3x = sr400_geo_RL4*c2;
    const double t103 = minus_m4_2x - minus_m4_3x;
    const double m4_2y = s2*t100;
    const double m4_3y = sr400_geo_RL4*s2;
    const double t106 = m4_2y - m4_3y;
    phi[116] = minus_U4_xx*t103 + U4_yx*t106 + U4_zx*m3_2y;
    phi[196] = -minus_vd4_y;
    MODELER_ZEROS(phi + 174, 8);
    phi[436] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_geo_D4*U4_zx - c2*minus_vd4_z;
    const double minus_vd4_x = c2*minus_vd4a_x + s2*vd4a_z;
    const double t108 = minus_vd4_z*minus_e4_1x + s5*minus_vd4_x + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    phi[37] = t108;
    const double t109 = minus_U4_xy*t103 - minus_U4_yy*t106 - minus_U4_zy*m3_2y;
    phi[117] = t109;
    phi[197] = minus_vd4_x;
    const double t110 = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_geo_D4*minus_U4_zy +
        s2*minus_vd4_z;
    phi[437] = t110;
    MODELER_ZEROS(phi + 182, 8);
    phi[38] = minus_U4_xz*minus_m4_1x - U4_yz*minus_m4_1y - (minus_vd4_y*minus_e4_1x +
        minus_vd4_x*e4_1y);
    phi[118] = -t62;
    phi[438] = t94 - sr400_geo_D4*minus_U3_yy + minus_vd4a_x;
    const double t111 = minus_vd4_x*minus_m4_1x + minus_vd4_y*minus_m4_1y;
    phi[39] = t111;
    const double t112 = minus_vd4_x*t103 - minus_vd4_y*t106 - minus_vd4_z*m3_2y;
    phi[119] = t112;
    const double t113 = minus_vd4_x*minus_m4_3x - minus_vd4_y*m4_3y - sr400_geo_D4*minus_vd4_z;
    MODELER_ZEROS(phi + 198, 2);
    phi[439] = t113;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const double w5_y = c3*w4_z + s3*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const double minus_wd5_x = c3*minus_wd4_x - s3*wd4_z - qd[3]*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const double minus_e5_1x = c3*minus_e4_1x - s3*s5;
    const double minus_w5_x = c3*minus_w4_x - s3*w4_z;
    const double w5_z = qd[3] + minus_w4_y;
    const double minus_ww5_xz = minus_w5_x*w5_z;
    const double e5_1y = c3*s5 + s3*minus_e4_1x;
    const double t121 = minus_ww5_xz*e5_1y;
    MODELER_ZEROS(phi + 209, 1);
    const double minus_ww5_xy = minus_w5_x*w5_y;
    const double t123 = minus_ww5_xy*e4_1y;
    phi[40] = minus_wd5_x*minus_e5_1x - t121 - t123;
    const double t124 = c3*minus_ww5_xz;
    phi[200] = -(s3*minus_wd5_x + t124);
    phi[280] = minus_ww5_xy;
    const double minus_e5_2x = s2*c3;
    const double e5_2y = s2*s3;
    MODELER_ZEROS(phi + 219, 8);
    const double t127 = minus_ww5_xz*e5_2y;
    const double t128 = c2*minus_ww5_xy;
    phi[440] = minus_wd5_x*minus_e5_2x - t127 + t128;
    const double wd5_y = c3*wd4_z + s3*minus_wd4_x + qd[3]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    const double ww5_yz = w5_y*w5_z;
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    MODELER_ZEROS(phi + 227, 8);
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    phi[41] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x + minus_U5_zy*e5_1y);
    phi[201] = s3*minus_U5_zx - c3*minus_U5_zy;
    phi[281] = -minus_n5_XYz;
    phi[441] = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c2*minus_n5_XYz);
    const double wd5_z = qdd[3] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    MODELER_ZEROS(phi + 235, 8);
    const double U5_yz = minus_wd5_x + ww5_yz;
    phi[42] = U5_yz*e4_1y - (U5_yx*minus_e5_1x + e5_1y*minus_n5_XZy);
    phi[202] = s3*U5_yx - c3*minus_n5_XZy;
    phi[282] = -U5_yz;
    phi[442] = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c2*U5_yz);
    const double t141 = ww5_yz*minus_e5_1x;
    phi[43] = t141 + wd5_y*e5_1y + t123;
    const double t142 = s3*ww5_yz;
    MODELER_ZEROS(phi + 243, 8);
    phi[203] = c3*wd5_y - t142;
    phi[283] = -minus_ww5_xy;
    const double t143 = ww5_yz*minus_e5_2x;
    phi[443] = t143 + wd5_y*e5_2y - t128;
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    phi[44] = -(minus_e5_1x*n5_YZx - minus_U5_xy*e5_1y + U5_xz*e4_1y);
    phi[204] = s3*n5_YZx + c3*minus_U5_xy;
    MODELER_ZEROS(phi + 251, 8);
    phi[284] = U5_xz;
    phi[444] = c2*U5_xz - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    phi[45] = t121 - t141 - wd5_z*e4_1y;
    phi[205] = t124 + t142;
    phi[285] = wd5_z;
    phi[445] = t127 - t143 + c2*wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c3*minus_vd4_z - s3*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c3*minus_m4_1x;
    MODELER_ZEROS(phi + 259, 8);
    const double m5_1y = s3*minus_m4_1x;
    phi[46] = minus_U5_xx*minus_m5_1x + U5_yx*m5_1y - minus_U5_zx*minus_m4_1y - (minus_vd4_y*e5_1y -
        minus_vd5_y*e4_1y);
    const double m4_2z = sr400_geo_D4 + m3_2y;
    const double minus_m5_2x = c3*minus_m4_2x - s3*m4_2z;
    const double minus_m5_3x = c3*minus_m4_3x - sr400_geo_D4*s3;
    const double t153 = minus_m5_2x - minus_m5_3x;
    const double m5_3y = sr400_geo_D4*c3 + s3*minus_m4_3x;
    const double t155 = c3*m4_2z + s3*minus_m4_2x - m5_3y;
    phi[126] = minus_U5_xx*t153 + U5_yx*t155 + minus_U5_zx*t106;
    MODELER_ZEROS(phi + 267, 8);
    phi[206] = -c3*minus_vd4_y;
    phi[286] = -minus_vd5_y;
    phi[446] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - (minus_vd4_y*e5_2y +
        c2*minus_vd5_y);
    const double minus_vd5_x = c3*minus_vd4_x + s3*minus_vd4_z;
    const double t157 = minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y + (minus_U5_zy*minus_m4_1y -
        (minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y));
    phi[47] = -t157;
    const double t158 = minus_U5_xy*t153 - minus_U5_yy*t155 + minus_U5_zy*t106;
    phi[127] = t158;
    const double t159 = s3*minus_vd4_y;
    MODELER_ZEROS(phi + 275, 5);
    phi[207] = t159;
    phi[287] = minus_vd5_x;
    const double t160 = minus_vd4_y*minus_e5_2x - c2*minus_vd5_x - (minus_U5_xy*minus_m5_3x -
        minus_U5_yy*m5_3y + minus_U5_zy*m4_3y);
    phi[447] = -t160;
    phi[48] = -t108;
    phi[128] = -t109;
    phi[208] = -minus_vd4_x;
    phi[448] = -t110;
    MODELER_ZEROS(phi + 288, 2);
    phi[49] = t111;
    phi[129] = t112;
    phi[449] = t113;
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c4*w5_z - s4*minus_w5_x;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = c4*minus_wd5_x + s4*wd5_z + qd[4]*minus_w6_y;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const double minus_e6_1x = c4*minus_e5_1x - s4*e4_1y;
    const double minus_w6_x = c4*minus_w5_x + s4*w5_z;
    const double w6_z = qd[4] + w5_y;
    const double minus_ww6_xz = minus_w6_x*w6_z;
    MODELER_ZEROS(phi + 299, 8);
    const double e6_1y = c4*e4_1y + s4*minus_e5_1x;
    const double t168 = minus_ww6_xz*e6_1y;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    const double t170 = ww6_xy*e5_1y;
    phi[50] = minus_wd6_x*minus_e6_1x - t168 - t170;
    const double e6_4x = s3*c4;
    const double minus_e6_4y = s3*s4;
    const double t173 = minus_ww6_xz*minus_e6_4y;
    MODELER_ZEROS(phi + 307, 8);
    const double t174 = c3*ww6_xy;
    phi[210] = -(minus_wd6_x*e6_4x - t173 + t174);
    const double t175 = c4*minus_ww6_xz;
    phi[290] = s4*minus_wd6_x + t175;
    phi[370] = -ww6_xy;
    const double minus_e6_2x = c4*minus_e5_2x + c2*s4;
    const double minus_e6_2y = c2*c4 - s4*minus_e5_2x;
    const double t178 = minus_ww6_xz*minus_e6_2y;
    const double t179 = ww6_xy*e5_2y;
    MODELER_ZEROS(phi + 315, 8);
    phi[450] = minus_wd6_x*minus_e6_2x + t178 - t179;
    const double minus_wd6_y = c4*wd5_z - s4*minus_wd5_x - qd[4]*minus_w6_x;
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
    MODELER_ZEROS(phi + 323, 8);
    phi[51] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y - e5_1y*minus_n6_XYz;
    phi[211] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c3*minus_n6_XYz);
    phi[291] = s4*U6_zx + c4*minus_U6_zy;
    phi[371] = -minus_n6_XYz;
    phi[451] = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    const double wd6_z = qdd[4] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    MODELER_ZEROS(phi + 331, 8);
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    phi[52] = -(U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy + U6_yz*e5_1y);
    phi[212] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c3*U6_yz;
    phi[292] = c4*minus_n6_XZy - s4*U6_yx;
    phi[372] = -U6_yz;
    phi[452] = -(U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y);
    const double t192 = minus_ww6_yz*minus_e6_1x;
    phi[53] = t170 - (t192 + minus_wd6_y*e6_1y);
    const double t193 = minus_ww6_yz*e6_4x;
    MODELER_ZEROS(phi + 339, 8);
    phi[213] = t193 + minus_wd6_y*minus_e6_4y + t174;
    const double t194 = s4*minus_ww6_yz;
    phi[293] = c4*minus_wd6_y - t194;
    phi[373] = ww6_xy;
    const double t195 = minus_ww6_yz*minus_e6_2x;
    phi[453] = minus_wd6_y*minus_e6_2y - t195 + t179;
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    MODELER_ZEROS(phi + 347, 8);
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    phi[54] = -(minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y + minus_U6_xz*e5_1y);
    phi[214] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c3*minus_U6_xz;
    phi[294] = -(s4*n6_YZx + c4*minus_U6_xy);
    phi[374] = -minus_U6_xz;
    phi[454] = -(minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y);
    phi[55] = t168 + t192 + wd6_z*e5_1y;
    phi[215] = c3*wd6_z - (t173 + t193);
    phi[295] = t194 - t175;
    MODELER_ZEROS(phi + 355, 8);
    phi[375] = wd6_z;
    phi[455] = wd6_z*e5_2y - (t178 - t195);
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c4*minus_vd4_y - s4*minus_vd5_x;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c4*minus_m5_1x + s4*minus_m4_1y;
    const double minus_m6_1y = c4*minus_m4_1y - s4*minus_m5_1x;
    phi[56] = minus_vd5_y*e6_1y - minus_vd6_y*e5_1y + (minus_U6_xx*minus_m6_1x - U6_yx*minus_m6_1y +
        U6_zx*m5_1y);
    const double minus_m6_3x = c4*minus_m5_3x - s4*m4_3y;
    const double t203 = c4*minus_m5_2x - s4*m4_2y - minus_m6_3x;
    const double m6_3y = c4*m4_3y + s4*minus_m5_3x;
    MODELER_ZEROS(phi + 363, 7);
    const double t205 = c4*m4_2y + s4*minus_m5_2x - m6_3y;
    phi[136] = minus_U6_xx*t203 + U6_yx*t205 + U6_zx*t155;
    phi[216] = -(minus_vd5_y*minus_e6_4y + c3*minus_vd6_y);
    phi[296] = -c4*minus_vd5_y;
    phi[376] = -minus_vd6_y;
    phi[456] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - (minus_vd5_y*minus_e6_2y +
        minus_vd6_y*e5_2y);
    const double minus_vd6_x = c4*minus_vd5_x + s4*minus_vd4_y;
    phi[57] = minus_vd5_y*minus_e6_1x + minus_vd6_x*e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    MODELER_ZEROS(phi + 378, 8);
    phi[137] = minus_U6_xy*t203 - minus_U6_yy*t205 - minus_U6_zy*t155;
    phi[217] = c3*minus_vd6_x - minus_vd5_y*e6_4x;
    phi[297] = s4*minus_vd5_y;
    phi[377] = minus_vd6_x;
    phi[457] = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y + (minus_U6_xy*minus_m6_3x -
        minus_U6_yy*m6_3y - minus_U6_zy*m5_3y);
    phi[58] = -t157;
    phi[138] = t158;
    phi[218] = t159;
    phi[298] = minus_vd5_x;
    MODELER_ZEROS(phi + 386, 8);
    phi[458] = -t160;
    phi[59] = t111;
    phi[139] = t112;
    phi[459] = t113;
    phi[60] = t51;
    phi[460] = ww3_xy;
    phi[61] = -t43;
    phi[461] = minus_n3_XYz;
    MODELER_ZEROS(phi + 394, 8);
    phi[62] = t53;
    phi[462] = minus_U3_xz;
    phi[63] = t37;
    phi[463] = -ww3_xy;
    phi[64] = -t49;
    phi[464] = -U3_yz;
    phi[465] = qdd[5];
    phi[66] = c5*vd2_z + sr400_geo_D2*minus_U3_zy;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_geo_g*c5 - s5*minus_vd2a_x;
    MODELER_ZEROS(phi + 402, 8);
    phi[466] = -minus_vd7_y;
    phi[67] = sr400_geo_D2*U3_zx - s5*vd2_z;
    const double minus_vd7_x = c5*minus_vd2a_x + sr400_geo_g*s5;
    phi[467] = minus_vd7_x;
    phi[69] = t30;
    phi[70] = t9;
    phi[150] = -ww2_xy;
    phi[71] = -t15;
    phi[151] = -minus_n2_XYz;
    MODELER_ZEROS(phi + 410, 8);
    phi[72] = -t22;
    phi[152] = -U2_yz;
    phi[73] = -t23;
    phi[153] = ww2_xy;
    phi[74] = -t25;
    phi[154] = -minus_U2_xz;
    phi[155] = qdd[1];
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const double vd8_z = vd2_z + sr400_geo_D8*minus_U3_zy;
    MODELER_ZEROS(phi + 418, 2);
    /* link 8: velocity of the origin, for unit speed of each joint below, m8 = R8' (m7 + e7 x p8)
        */
    const double m8_1z = sr400_geo_D2 + sr400_geo_D8*c5;
    phi[76] = c1*vd8_z - m8_1z*minus_U2_zx;
    const double minus_vd8a_y = minus_vd7_y - sr400_geo_D8*minus_U3_xy;
    const double minus_vd8a_x = minus_vd7_x + sr400_geo_D8*minus_U3_yy;
    const double minus_vd8_y = ca2*minus_vd8a_y - sa2*minus_vd8a_x;
    phi[156] = -minus_vd8_y;
    const double m8_7x = sr400_geo_D8*sa2;
    const double m8_7y = sr400_geo_D8*ca2;
    phi[476] = U2_yx*m8_7y - minus_U2_xx*m8_7x;
    MODELER_ZEROS(phi + 428, 2);
    phi[77] = -(s1*vd8_z + m8_1z*minus_U2_zy);
    const double minus_vd8_x = ca2*minus_vd8a_x + sa2*minus_vd8a_y;
    phi[157] = minus_vd8_x;
    phi[477] = -(minus_U2_xy*m8_7x + minus_U2_yy*m8_7y);
    phi[78] = -(s1*minus_vd8_y - c1*minus_vd8_x + m8_1z*ww1_zz);
    phi[478] = U2_yz*m8_7y - minus_U2_xz*m8_7x;
    phi[79] = m8_1z*vd8_z;
    phi[479] = -(minus_vd8_x*m8_7x + minus_vd8_y*m8_7y);
    MODELER_ZEROS(phi + 468, 8);
}
