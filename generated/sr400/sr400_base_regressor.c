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

/* Regressor of the base parameters.
 * 291 additions, 398 multiplications. */
MODELER_CLONES
void sr400_base_regressor(const double q[SR400_JOINTS], const double qd[SR400_JOINTS],
                          const double qdd[SR400_JOINTS], double MODELER_OUT(phi, 6 * 39))
{
    MODELER_ALL_ZEROS(phi, 234);

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

    phi[0] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    phi[1] = s1*minus_wd2_x + c1*minus_ww2_xz;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    phi[40] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    phi[2] = c1*minus_U2_zy - s1*minus_U2_zx;
    MODELER_ZEROS(phi + 5, 1);
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    phi[41] = minus_U2_yy - minus_U2_xx;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    phi[3] = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    phi[42] = -U2_yz;
    const double minus_U2_xy = qdd[1] - ww2_xy;
    phi[4] = -(s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy);
    phi[43] = -minus_U2_xz;
    phi[44] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_geo_D2*qdd[0];
    phi[6] = c1*vd2_z - sr400_geo_D2*minus_U2_zx;
    MODELER_ZEROS(phi + 12, 1);
    const double minus_vd2a_x = sr400_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_geo_g*c1 - s1*minus_vd2a_x;
    phi[45] = -minus_vd2_y;
    phi[7] = -(s1*vd2_z + sr400_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_geo_g*s1;
    phi[46] = minus_vd2_x;
    const double t23 = qd[1] - qd[5];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = sa2*minus_w2_y - ca2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = sa2*minus_wd2_x + ca2*minus_wd2_y - t23*minus_w3_y;
    const double minus_w3_x = sa2*minus_w2_x + ca2*minus_w2_y;
    const double minus_ww3_xz = qd[5]*minus_w3_x;
    phi[8] = c5*minus_wd3_x - s5*minus_ww3_xz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    phi[203] = -ww3_xy;
    const double minus_wd3_y = sa2*minus_wd2_y - ca2*minus_wd2_x + t23*minus_w3_x;
    MODELER_ZEROS(phi + 39, 1);
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    const double minus_ww3_yz = qd[5]*minus_w3_y;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    phi[9] = c5*U3_zx - s5*minus_U3_zy;
    const double ww3_zz = qd[5]*qd[5];
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    phi[204] = minus_U3_yy - minus_U3_xx;
    const double U3_yx = qdd[5] + ww3_xy;
    phi[10] = -(c5*U3_yx + s5*(ww1_zz - minus_U3_xx));
    phi[205] = minus_ww3_yz - minus_wd3_x;
    const double minus_U3_xy = qdd[5] - ww3_xy;
    phi[11] = s5*minus_U3_xy - c5*(ww1_zz - minus_U3_yy);
    phi[206] = -(minus_wd3_y + minus_ww3_xz);
    MODELER_ZEROS(phi + 47, 5);
    phi[207] = qdd[5];
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_geo_D2 + sr400_geo_D3*c1;
    phi[13] = m3_1z*U3_zx - s5*vd3_z;
    const double m3_2x = sr400_geo_D3*ca2;
    const double m3_2y = sr400_geo_D3*sa2;
    phi[52] = U3_yx*m3_2y - minus_U3_xx*m3_2x;
    const double minus_vd3a_y = minus_vd2_y - sr400_geo_D3*U2_yx;
    const double minus_vd3a_x = minus_vd2_x + sr400_geo_D3*minus_U2_xx;
    const double minus_vd3_y = sa2*minus_vd3a_y - ca2*minus_vd3a_x;
    phi[208] = -minus_vd3_y;
    phi[14] = -(c5*vd3_z + m3_1z*minus_U3_zy);
    phi[53] = -(minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    const double minus_vd3_x = sa2*minus_vd3a_x + ca2*minus_vd3a_y;
    phi[209] = minus_vd3_x;
    MODELER_ZEROS(phi + 54, 5);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c2*qd[5] - s2*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c2*minus_wd3_x + s2*qdd[5] + qd[2]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c2*c5;
    const double minus_w4_x = c2*minus_w3_x + s2*qd[5];
    const double w4_z = qd[2] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s2*c5;
    const double t53 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    phi[15] = minus_wd4_x*minus_e4_1x - t53 - s5*ww4_xy;
    phi[93] = -ww4_xy;
    const double t55 = c2*minus_ww4_xz;
    phi[210] = s2*minus_wd4_x + t55;
    const double minus_wd4_y = c2*qdd[5] - s2*minus_wd3_x - qd[2]*minus_w4_x;
    MODELER_ZEROS(phi + 61, 5);
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    phi[16] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y - s5*minus_n4_XYz;
    phi[94] = -minus_n4_XYz;
    phi[211] = s2*U4_zx + c2*minus_U4_zy;
    const double wd4_z = qdd[2] - minus_wd3_y;
    const double U4_yx = wd4_z + ww4_xy;
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    phi[17] = -(U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy + s5*U4_yz);
    MODELER_ZEROS(phi + 68, 5);
    phi[95] = -U4_yz;
    phi[212] = c2*minus_n4_XZy - s2*U4_yx;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    phi[18] = -(minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y + s5*minus_U4_xz);
    phi[96] = -minus_U4_xz;
    phi[213] = -(s2*n4_YZx + c2*minus_U4_xy);
    phi[19] = t53 + minus_ww4_yz*minus_e4_1x + s5*wd4_z;
    phi[97] = wd4_z;
    phi[214] = s2*minus_ww4_yz - t55;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_geo_RL4*minus_U3_yy - sr400_geo_D4*U3_yx + minus_vd3_y;
    const double vd4a_z = sr400_geo_D4*U3_zx - sr400_geo_RL4*minus_U3_zy + vd3_z;
    const double minus_vd4a_x = sr400_geo_D4*minus_U3_xx + sr400_geo_RL4*minus_U3_xy + minus_vd3_x;
    MODELER_ZEROS(phi + 75, 2);
    const double minus_vd4_y = c2*vd4a_z - s2*minus_vd4a_x;
    const double t75 = m3_1z - (sr400_geo_RL4*c5 + sr400_geo_D4*s5);
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s2*t75;
    const double minus_m4_1y = c2*t75;
    phi[20] = minus_vd4_z*e4_1y - s5*minus_vd4_y + (minus_U4_xx*minus_m4_1x - U4_yx*minus_m4_1y);
    const double t78 = sr400_geo_RL4 - m3_2x;
    const double minus_m4_2x = c2*t78;
    const double minus_m4_3x = sr400_geo_RL4*c2;
    const double t81 = minus_m4_2x - minus_m4_3x;
    const double m4_2y = s2*t78;
    const double m4_3y = sr400_geo_RL4*s2;
    const double t84 = m4_2y - m4_3y;
    phi[59] = minus_U4_xx*t81 + U4_yx*t84 + U4_zx*m3_2y;
    phi[98] = -minus_vd4_y;
    phi[215] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_geo_D4*U4_zx - c2*minus_vd4_z;
    MODELER_ZEROS(phi + 78, 8);
    const double minus_vd4_x = c2*minus_vd4a_x + s2*vd4a_z;
    phi[21] = minus_vd4_z*minus_e4_1x + s5*minus_vd4_x + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    phi[60] = minus_U4_xy*t81 - minus_U4_yy*t84 - minus_U4_zy*m3_2y;
    phi[99] = minus_vd4_x;
    phi[216] = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_geo_D4*minus_U4_zy +
        s2*minus_vd4_z;
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
    const double t93 = minus_ww5_xz*e5_1y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    MODELER_ZEROS(phi + 86, 7);
    phi[22] = minus_wd5_x*minus_e5_1x - t93 - minus_ww5_xy*e4_1y;
    const double t95 = c3*minus_ww5_xz;
    phi[100] = -(s3*minus_wd5_x + t95);
    phi[139] = minus_ww5_xy;
    const double minus_e5_2x = s2*c3;
    const double e5_2y = s2*s3;
    const double t98 = minus_ww5_xz*e5_2y;
    phi[217] = minus_wd5_x*minus_e5_2x - t98 + c2*minus_ww5_xy;
    const double wd5_y = c3*wd4_z + s3*minus_wd4_x + qd[3]*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const double minus_U5_zx = wd5_y + minus_ww5_xz;
    const double ww5_yz = w5_y*w5_z;
    const double minus_U5_zy = minus_wd5_x - ww5_yz;
    const double ww5_zz = w5_z*w5_z;
    const double minus_U5_xx = w5_y*w5_y + ww5_zz;
    MODELER_ZEROS(phi + 114, 8);
    const double minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const double minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    phi[23] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x + minus_U5_zy*e5_1y);
    phi[101] = s3*minus_U5_zx - c3*minus_U5_zy;
    phi[140] = -minus_n5_XYz;
    phi[218] = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c2*minus_n5_XYz);
    const double wd5_z = qdd[3] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    phi[24] = U5_yz*e4_1y - (U5_yx*minus_e5_1x + e5_1y*minus_n5_XZy);
    phi[102] = s3*U5_yx - c3*minus_n5_XZy;
    phi[141] = -U5_yz;
    phi[219] = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c2*U5_yz);
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    MODELER_ZEROS(phi + 122, 8);
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    phi[25] = -(minus_e5_1x*n5_YZx - minus_U5_xy*e5_1y + U5_xz*e4_1y);
    phi[103] = s3*n5_YZx + c3*minus_U5_xy;
    phi[142] = U5_xz;
    phi[220] = c2*U5_xz - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    phi[26] = t93 - ww5_yz*minus_e5_1x - wd5_z*e4_1y;
    phi[104] = t95 + s3*ww5_yz;
    phi[143] = wd5_z;
    phi[221] = t98 - ww5_yz*minus_e5_2x + c2*wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c3*minus_vd4_z - s3*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c3*minus_m4_1x;
    const double m5_1y = s3*minus_m4_1x;
    phi[27] = minus_U5_xx*minus_m5_1x + U5_yx*m5_1y - minus_U5_zx*minus_m4_1y - (minus_vd4_y*e5_1y -
        minus_vd5_y*e4_1y);
    MODELER_ZEROS(phi + 130, 8);
    const double m4_2z = sr400_geo_D4 + m3_2y;
    const double minus_m5_2x = c3*minus_m4_2x - s3*m4_2z;
    const double minus_m5_3x = c3*minus_m4_3x - sr400_geo_D4*s3;
    const double t120 = minus_m5_2x - minus_m5_3x;
    const double m5_3y = sr400_geo_D4*c3 + s3*minus_m4_3x;
    const double t122 = c3*m4_2z + s3*minus_m4_2x - m5_3y;
    phi[66] = minus_U5_xx*t120 + U5_yx*t122 + minus_U5_zx*t84;
    phi[105] = -c3*minus_vd4_y;
    phi[144] = -minus_vd5_y;
    phi[222] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - (minus_vd4_y*e5_2y +
        c2*minus_vd5_y);
    const double minus_vd5_x = c3*minus_vd4_x + s3*minus_vd4_z;
    phi[28] = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    phi[67] = minus_U5_xy*t120 - minus_U5_yy*t122 + minus_U5_zy*t84;
    phi[106] = s3*minus_vd4_y;
    phi[145] = minus_vd5_x;
    MODELER_ZEROS(phi + 138, 1);
    phi[223] = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y -
        (minus_vd4_y*minus_e5_2x - c2*minus_vd5_x);
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c4*w5_z - s4*minus_w5_x;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = c4*minus_wd5_x + s4*wd5_z + qd[4]*minus_w6_y;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const double minus_e6_1x = c4*minus_e5_1x - s4*e4_1y;
    const double minus_w6_x = c4*minus_w5_x + s4*w5_z;
    const double w6_z = qd[4] + w5_y;
    const double minus_ww6_xz = minus_w6_x*w6_z;
    const double e6_1y = c4*e4_1y + s4*minus_e5_1x;
    const double t131 = minus_ww6_xz*e6_1y;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    phi[29] = minus_wd6_x*minus_e6_1x - t131 - ww6_xy*e5_1y;
    const double e6_4x = s3*c4;
    const double minus_e6_4y = s3*s4;
    const double t135 = minus_ww6_xz*minus_e6_4y;
    MODELER_ZEROS(phi + 153, 8);
    phi[107] = -(minus_wd6_x*e6_4x - t135 + c3*ww6_xy);
    const double t136 = c4*minus_ww6_xz;
    phi[146] = s4*minus_wd6_x + t136;
    phi[185] = -ww6_xy;
    const double minus_e6_2x = c4*minus_e5_2x + c2*s4;
    const double minus_e6_2y = c2*c4 - s4*minus_e5_2x;
    const double t139 = minus_ww6_xz*minus_e6_2y;
    phi[224] = minus_wd6_x*minus_e6_2x + t139 - ww6_xy*e5_2y;
    const double minus_wd6_y = c4*wd5_z - s4*minus_wd5_x - qd[4]*minus_w6_x;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const double U6_zx = minus_wd6_y - minus_ww6_xz;
    const double minus_ww6_yz = minus_w6_y*w6_z;
    const double minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    const double ww6_zz = w6_z*w6_z;
    const double minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const double minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    MODELER_ZEROS(phi + 161, 8);
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const double minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    phi[30] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y - e5_1y*minus_n6_XYz;
    phi[108] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c3*minus_n6_XYz);
    phi[147] = s4*U6_zx + c4*minus_U6_zy;
    phi[186] = -minus_n6_XYz;
    phi[225] = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    const double wd6_z = qdd[4] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    phi[31] = -(U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy + U6_yz*e5_1y);
    phi[109] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c3*U6_yz;
    phi[148] = c4*minus_n6_XZy - s4*U6_yx;
    phi[187] = -U6_yz;
    MODELER_ZEROS(phi + 169, 8);
    phi[226] = -(U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y);
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    phi[32] = -(minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y + minus_U6_xz*e5_1y);
    phi[110] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c3*minus_U6_xz;
    phi[149] = -(s4*n6_YZx + c4*minus_U6_xy);
    phi[188] = -minus_U6_xz;
    phi[227] = -(minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y);
    phi[33] = t131 + minus_ww6_yz*minus_e6_1x + wd6_z*e5_1y;
    phi[111] = c3*wd6_z - (t135 + minus_ww6_yz*e6_4x);
    phi[150] = s4*minus_ww6_yz - t136;
    phi[189] = wd6_z;
    phi[228] = wd6_z*e5_2y - (t139 - minus_ww6_yz*minus_e6_2x);
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c4*minus_vd4_y - s4*minus_vd5_x;
    MODELER_ZEROS(phi + 177, 8);
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c4*minus_m5_1x + s4*minus_m4_1y;
    const double minus_m6_1y = c4*minus_m4_1y - s4*minus_m5_1x;
    phi[34] = minus_vd5_y*e6_1y - minus_vd6_y*e5_1y + (minus_U6_xx*minus_m6_1x - U6_yx*minus_m6_1y +
        U6_zx*m5_1y);
    const double minus_m6_3x = c4*minus_m5_3x - s4*m4_3y;
    const double t159 = c4*minus_m5_2x - s4*m4_2y - minus_m6_3x;
    const double m6_3y = c4*m4_3y + s4*minus_m5_3x;
    const double t161 = c4*m4_2y + s4*minus_m5_2x - m6_3y;
    phi[73] = minus_U6_xx*t159 + U6_yx*t161 + U6_zx*t122;
    phi[112] = -(minus_vd5_y*minus_e6_4y + c3*minus_vd6_y);
    phi[151] = -c4*minus_vd5_y;
    phi[190] = -minus_vd6_y;
    phi[229] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - (minus_vd5_y*minus_e6_2y +
        minus_vd6_y*e5_2y);
    const double minus_vd6_x = c4*minus_vd5_x + s4*minus_vd4_y;
    phi[35] = minus_vd5_y*minus_e6_1x + minus_vd6_x*e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    MODELER_ZEROS(phi + 192, 8);
    phi[74] = minus_U6_xy*t159 - minus_U6_yy*t161 - minus_U6_zy*t122;
    phi[113] = c3*minus_vd6_x - minus_vd5_y*e6_4x;
    phi[152] = s4*minus_vd5_y;
    phi[191] = minus_vd6_x;
    phi[230] = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y + (minus_U6_xy*minus_m6_3x -
        minus_U6_yy*m6_3y - minus_U6_zy*m5_3y);
    phi[36] = c5*vd2_z + sr400_geo_D2*minus_U3_zy;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_geo_g*c5 - s5*minus_vd2a_x;
    phi[231] = -minus_vd7_y;
    phi[37] = sr400_geo_D2*U3_zx - s5*vd2_z;
    const double minus_vd7_x = c5*minus_vd2a_x + sr400_geo_g*s5;
    phi[232] = minus_vd7_x;
    phi[38] = -(s1*(vd2_z + sr400_geo_D8*minus_U3_zy) + (sr400_geo_D2 +
        sr400_geo_D8*c5)*minus_U2_zy);
    phi[77] = ca2*(minus_vd7_x + sr400_geo_D8*minus_U3_yy) + sa2*(minus_vd7_y -
        sr400_geo_D8*minus_U3_xy);
    phi[233] = -(sr400_geo_D8*sa2*minus_U2_xy + sr400_geo_D8*ca2*minus_U2_yy);
    MODELER_ZEROS(phi + 200, 3);
}

/* The entries of the base regressor that are not always 0.
 * 291 additions, 398 multiplications. */
MODELER_CLONES
void sr400_base_regressor_nonzeros(const double q[SR400_JOINTS], const double qd[SR400_JOINTS],
                                   const double qdd[SR400_JOINTS], double MODELER_OUT(values, 126))
{
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

    values[0] = qdd[0];
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double minus_w2_y = c1*qd[0];
    const double minus_ww2_yz = qd[1]*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double minus_wd2_x = U2_yz + minus_ww2_yz;
    const double minus_w2_x = s1*qd[0];
    const double minus_ww2_xz = qd[1]*minus_w2_x;
    values[1] = s1*minus_wd2_x + c1*minus_ww2_xz;
    const double ww2_xy = minus_w2_x*minus_w2_y;
    values[37] = -ww2_xy;
    const double minus_U2_xz = c1*qdd[0];
    const double minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const double minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const double minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    values[2] = c1*minus_U2_zy - s1*minus_U2_zx;
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const double minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    values[38] = minus_U2_yy - minus_U2_xx;
    const double U2_yx = qdd[1] + ww2_xy;
    const double ww1_zz = qd[0]*qd[0];
    values[3] = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    values[39] = -U2_yz;
    const double minus_U2_xy = qdd[1] - ww2_xy;
    values[4] = -(s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy);
    values[40] = -minus_U2_xz;
    values[41] = qdd[1];
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double vd2_z = sr400_geo_D2*qdd[0];
    values[5] = c1*vd2_z - sr400_geo_D2*minus_U2_zx;
    const double minus_vd2a_x = sr400_geo_D2*ww1_zz;
    const double minus_vd2_y = sr400_geo_g*c1 - s1*minus_vd2a_x;
    values[42] = -minus_vd2_y;
    values[6] = -(s1*vd2_z + sr400_geo_D2*minus_U2_zy);
    const double minus_vd2_x = c1*minus_vd2a_x + sr400_geo_g*s1;
    values[43] = minus_vd2_x;
    const double t23 = qd[1] - qd[5];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = sa2*minus_w2_y - ca2*minus_w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = sa2*minus_wd2_x + ca2*minus_wd2_y - t23*minus_w3_y;
    const double minus_w3_x = sa2*minus_w2_x + ca2*minus_w2_y;
    const double minus_ww3_xz = qd[5]*minus_w3_x;
    values[7] = c5*minus_wd3_x - s5*minus_ww3_xz;
    const double ww3_xy = minus_w3_x*minus_w3_y;
    values[95] = -ww3_xy;
    const double minus_wd3_y = sa2*minus_wd2_y - ca2*minus_wd2_x + t23*minus_w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y - minus_ww3_xz;
    const double minus_ww3_yz = qd[5]*minus_w3_y;
    const double minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    values[8] = c5*U3_zx - s5*minus_U3_zy;
    const double ww3_zz = qd[5]*qd[5];
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    values[96] = minus_U3_yy - minus_U3_xx;
    const double U3_yx = qdd[5] + ww3_xy;
    values[9] = -(c5*U3_yx + s5*(ww1_zz - minus_U3_xx));
    values[97] = minus_ww3_yz - minus_wd3_x;
    const double minus_U3_xy = qdd[5] - ww3_xy;
    values[10] = s5*minus_U3_xy - c5*(ww1_zz - minus_U3_yy);
    values[98] = -(minus_wd3_y + minus_ww3_xz);
    values[99] = qdd[5];
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double vd3_z = vd2_z - sr400_geo_D3*minus_U2_zx;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double m3_1z = sr400_geo_D2 + sr400_geo_D3*c1;
    values[11] = m3_1z*U3_zx - s5*vd3_z;
    const double m3_2x = sr400_geo_D3*ca2;
    const double m3_2y = sr400_geo_D3*sa2;
    values[44] = U3_yx*m3_2y - minus_U3_xx*m3_2x;
    const double minus_vd3a_y = minus_vd2_y - sr400_geo_D3*U2_yx;
    const double minus_vd3a_x = minus_vd2_x + sr400_geo_D3*minus_U2_xx;
    const double minus_vd3_y = sa2*minus_vd3a_y - ca2*minus_vd3a_x;
    values[100] = -minus_vd3_y;
    values[12] = -(c5*vd3_z + m3_1z*minus_U3_zy);
    values[45] = -(minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    const double minus_vd3_x = sa2*minus_vd3a_x + ca2*minus_vd3a_y;
    values[101] = minus_vd3_x;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const double minus_w4_y = c2*qd[5] - s2*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const double minus_wd4_x = c2*minus_wd3_x + s2*qdd[5] + qd[2]*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const double minus_e4_1x = c2*c5;
    const double minus_w4_x = c2*minus_w3_x + s2*qd[5];
    const double w4_z = qd[2] - minus_w3_y;
    const double minus_ww4_xz = minus_w4_x*w4_z;
    const double e4_1y = s2*c5;
    const double t53 = minus_ww4_xz*e4_1y;
    const double ww4_xy = minus_w4_x*minus_w4_y;
    values[13] = minus_wd4_x*minus_e4_1x - t53 - s5*ww4_xy;
    values[53] = -ww4_xy;
    const double t55 = c2*minus_ww4_xz;
    values[102] = s2*minus_wd4_x + t55;
    const double minus_wd4_y = c2*qdd[5] - s2*minus_wd3_x - qd[2]*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const double U4_zx = minus_wd4_y - minus_ww4_xz;
    const double minus_ww4_yz = minus_w4_y*w4_z;
    const double minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const double ww4_zz = w4_z*w4_z;
    const double minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const double minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const double minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    values[14] = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y - s5*minus_n4_XYz;
    values[54] = -minus_n4_XYz;
    values[103] = s2*U4_zx + c2*minus_U4_zy;
    const double wd4_z = qdd[2] - minus_wd3_y;
    const double U4_yx = wd4_z + ww4_xy;
    const double minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const double U4_yz = minus_wd4_x - minus_ww4_yz;
    values[15] = -(U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy + s5*U4_yz);
    values[55] = -U4_yz;
    values[104] = c2*minus_n4_XZy - s2*U4_yx;
    const double n4_YZx = minus_U3_yy - minus_U4_yy;
    const double minus_U4_xy = wd4_z - ww4_xy;
    const double minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    values[16] = -(minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y + s5*minus_U4_xz);
    values[56] = -minus_U4_xz;
    values[105] = -(s2*n4_YZx + c2*minus_U4_xy);
    values[17] = t53 + minus_ww4_yz*minus_e4_1x + s5*wd4_z;
    values[57] = wd4_z;
    values[106] = s2*minus_ww4_yz - t55;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const double minus_vd4_z = sr400_geo_RL4*minus_U3_yy - sr400_geo_D4*U3_yx + minus_vd3_y;
    const double vd4a_z = sr400_geo_D4*U3_zx - sr400_geo_RL4*minus_U3_zy + vd3_z;
    const double minus_vd4a_x = sr400_geo_D4*minus_U3_xx + sr400_geo_RL4*minus_U3_xy + minus_vd3_x;
    const double minus_vd4_y = c2*vd4a_z - s2*minus_vd4a_x;
    const double t75 = m3_1z - (sr400_geo_RL4*c5 + sr400_geo_D4*s5);
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const double minus_m4_1x = s2*t75;
    const double minus_m4_1y = c2*t75;
    values[18] = minus_vd4_z*e4_1y - s5*minus_vd4_y + (minus_U4_xx*minus_m4_1x - U4_yx*minus_m4_1y);
    const double t78 = sr400_geo_RL4 - m3_2x;
    const double minus_m4_2x = c2*t78;
    const double minus_m4_3x = sr400_geo_RL4*c2;
    const double t81 = minus_m4_2x - minus_m4_3x;
    const double m4_2y = s2*t78;
    const double m4_3y = sr400_geo_RL4*s2;
    const double t84 = m4_2y - m4_3y;
    values[46] = minus_U4_xx*t81 + U4_yx*t84 + U4_zx*m3_2y;
    values[58] = -minus_vd4_y;
    values[107] = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_geo_D4*U4_zx - c2*minus_vd4_z;
    const double minus_vd4_x = c2*minus_vd4a_x + s2*vd4a_z;
    values[19] = minus_vd4_z*minus_e4_1x + s5*minus_vd4_x + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    values[47] = minus_U4_xy*t81 - minus_U4_yy*t84 - minus_U4_zy*m3_2y;
    values[59] = minus_vd4_x;
    values[108] = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_geo_D4*minus_U4_zy +
        s2*minus_vd4_z;
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
    const double t93 = minus_ww5_xz*e5_1y;
    const double minus_ww5_xy = minus_w5_x*w5_y;
    values[20] = minus_wd5_x*minus_e5_1x - t93 - minus_ww5_xy*e4_1y;
    const double t95 = c3*minus_ww5_xz;
    values[60] = -(s3*minus_wd5_x + t95);
    values[74] = minus_ww5_xy;
    const double minus_e5_2x = s2*c3;
    const double e5_2y = s2*s3;
    const double t98 = minus_ww5_xz*e5_2y;
    values[109] = minus_wd5_x*minus_e5_2x - t98 + c2*minus_ww5_xy;
    const double wd5_y = c3*wd4_z + s3*minus_wd4_x + qd[3]*minus_w5_x;
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
    values[21] = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x + minus_U5_zy*e5_1y);
    values[61] = s3*minus_U5_zx - c3*minus_U5_zy;
    values[75] = -minus_n5_XYz;
    values[110] = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c2*minus_n5_XYz);
    const double wd5_z = qdd[3] + minus_wd4_y;
    const double U5_yx = wd5_z - minus_ww5_xy;
    const double minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const double U5_yz = minus_wd5_x + ww5_yz;
    values[22] = U5_yz*e4_1y - (U5_yx*minus_e5_1x + e5_1y*minus_n5_XZy);
    values[62] = s3*U5_yx - c3*minus_n5_XZy;
    values[76] = -U5_yz;
    values[111] = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c2*U5_yz);
    const double n5_YZx = minus_U4_yy - minus_U5_yy;
    const double minus_U5_xy = wd5_z + minus_ww5_xy;
    const double U5_xz = wd5_y - minus_ww5_xz;
    values[23] = -(minus_e5_1x*n5_YZx - minus_U5_xy*e5_1y + U5_xz*e4_1y);
    values[63] = s3*n5_YZx + c3*minus_U5_xy;
    values[77] = U5_xz;
    values[112] = c2*U5_xz - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    values[24] = t93 - ww5_yz*minus_e5_1x - wd5_z*e4_1y;
    values[64] = t95 + s3*ww5_yz;
    values[78] = wd5_z;
    values[113] = t98 - ww5_yz*minus_e5_2x + c2*wd5_z;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const double minus_vd5_y = c3*minus_vd4_z - s3*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const double minus_m5_1x = c3*minus_m4_1x;
    const double m5_1y = s3*minus_m4_1x;
    values[25] = minus_U5_xx*minus_m5_1x + U5_yx*m5_1y - minus_U5_zx*minus_m4_1y -
        (minus_vd4_y*e5_1y - minus_vd5_y*e4_1y);
    const double m4_2z = sr400_geo_D4 + m3_2y;
    const double minus_m5_2x = c3*minus_m4_2x - s3*m4_2z;
    const double minus_m5_3x = c3*minus_m4_3x - sr400_geo_D4*s3;
    const double t120 = minus_m5_2x - minus_m5_3x;
    const double m5_3y = sr400_geo_D4*c3 + s3*minus_m4_3x;
    const double t122 = c3*m4_2z + s3*minus_m4_2x - m5_3y;
    values[48] = minus_U5_xx*t120 + U5_yx*t122 + minus_U5_zx*t84;
    values[65] = -c3*minus_vd4_y;
    values[79] = -minus_vd5_y;
    values[114] = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - (minus_vd4_y*e5_2y +
        c2*minus_vd5_y);
    const double minus_vd5_x = c3*minus_vd4_x + s3*minus_vd4_z;
    values[26] = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    values[49] = minus_U5_xy*t120 - minus_U5_yy*t122 + minus_U5_zy*t84;
    values[66] = s3*minus_vd4_y;
    values[80] = minus_vd5_x;
    values[115] = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y -
        (minus_vd4_y*minus_e5_2x - c2*minus_vd5_x);
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const double minus_w6_y = c4*w5_z - s4*minus_w5_x;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const double minus_wd6_x = c4*minus_wd5_x + s4*wd5_z + qd[4]*minus_w6_y;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const double minus_e6_1x = c4*minus_e5_1x - s4*e4_1y;
    const double minus_w6_x = c4*minus_w5_x + s4*w5_z;
    const double w6_z = qd[4] + w5_y;
    const double minus_ww6_xz = minus_w6_x*w6_z;
    const double e6_1y = c4*e4_1y + s4*minus_e5_1x;
    const double t131 = minus_ww6_xz*e6_1y;
    const double ww6_xy = minus_w6_x*minus_w6_y;
    values[27] = minus_wd6_x*minus_e6_1x - t131 - ww6_xy*e5_1y;
    const double e6_4x = s3*c4;
    const double minus_e6_4y = s3*s4;
    const double t135 = minus_ww6_xz*minus_e6_4y;
    values[67] = -(minus_wd6_x*e6_4x - t135 + c3*ww6_xy);
    const double t136 = c4*minus_ww6_xz;
    values[81] = s4*minus_wd6_x + t136;
    values[88] = -ww6_xy;
    const double minus_e6_2x = c4*minus_e5_2x + c2*s4;
    const double minus_e6_2y = c2*c4 - s4*minus_e5_2x;
    const double t139 = minus_ww6_xz*minus_e6_2y;
    values[116] = minus_wd6_x*minus_e6_2x + t139 - ww6_xy*e5_2y;
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
    values[28] = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y - e5_1y*minus_n6_XYz;
    values[68] = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c3*minus_n6_XYz);
    values[82] = s4*U6_zx + c4*minus_U6_zy;
    values[89] = -minus_n6_XYz;
    values[117] = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    const double wd6_z = qdd[4] + wd5_y;
    const double U6_yx = wd6_z + ww6_xy;
    const double minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const double U6_yz = minus_wd6_x - minus_ww6_yz;
    values[29] = -(U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy + U6_yz*e5_1y);
    values[69] = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c3*U6_yz;
    values[83] = c4*minus_n6_XZy - s4*U6_yx;
    values[90] = -U6_yz;
    values[118] = -(U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y);
    const double n6_YZx = minus_U5_yy - minus_U6_yy;
    const double minus_U6_xy = wd6_z - ww6_xy;
    const double minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    values[30] = -(minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y + minus_U6_xz*e5_1y);
    values[70] = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c3*minus_U6_xz;
    values[84] = -(s4*n6_YZx + c4*minus_U6_xy);
    values[91] = -minus_U6_xz;
    values[119] = -(minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y);
    values[31] = t131 + minus_ww6_yz*minus_e6_1x + wd6_z*e5_1y;
    values[71] = c3*wd6_z - (t135 + minus_ww6_yz*e6_4x);
    values[85] = s4*minus_ww6_yz - t136;
    values[92] = wd6_z;
    values[120] = wd6_z*e5_2y - (t139 - minus_ww6_yz*minus_e6_2x);
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const double minus_vd6_y = c4*minus_vd4_y - s4*minus_vd5_x;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const double minus_m6_1x = c4*minus_m5_1x + s4*minus_m4_1y;
    const double minus_m6_1y = c4*minus_m4_1y - s4*minus_m5_1x;
    values[32] = minus_vd5_y*e6_1y - minus_vd6_y*e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const double minus_m6_3x = c4*minus_m5_3x - s4*m4_3y;
    const double t159 = c4*minus_m5_2x - s4*m4_2y - minus_m6_3x;
    const double m6_3y = c4*m4_3y + s4*minus_m5_3x;
    const double t161 = c4*m4_2y + s4*minus_m5_2x - m6_3y;
    values[50] = minus_U6_xx*t159 + U6_yx*t161 + U6_zx*t122;
    values[72] = -(minus_vd5_y*minus_e6_4y + c3*minus_vd6_y);
    values[86] = -c4*minus_vd5_y;
    values[93] = -minus_vd6_y;
    values[121] = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - (minus_vd5_y*minus_e6_2y +
        minus_vd6_y*e5_2y);
    const double minus_vd6_x = c4*minus_vd5_x + s4*minus_vd4_y;
    values[33] = minus_vd5_y*minus_e6_1x + minus_vd6_x*e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    values[51] = minus_U6_xy*t159 - minus_U6_yy*t161 - minus_U6_zy*t122;
    values[73] = c3*minus_vd6_x - minus_vd5_y*e6_4x;
    values[87] = s4*minus_vd5_y;
    values[94] = minus_vd6_x;
    values[122] = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y + (minus_U6_xy*minus_m6_3x -
        minus_U6_yy*m6_3y - minus_U6_zy*m5_3y);
    values[34] = c5*vd2_z + sr400_geo_D2*minus_U3_zy;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const double minus_vd7_y = sr400_geo_g*c5 - s5*minus_vd2a_x;
    values[123] = -minus_vd7_y;
    values[35] = sr400_geo_D2*U3_zx - s5*vd2_z;
    const double minus_vd7_x = c5*minus_vd2a_x + sr400_geo_g*s5;
    values[124] = minus_vd7_x;
    values[36] = -(s1*(vd2_z + sr400_geo_D8*minus_U3_zy) + (sr400_geo_D2 +
        sr400_geo_D8*c5)*minus_U2_zy);
    values[52] = ca2*(minus_vd7_x + sr400_geo_D8*minus_U3_yy) + sa2*(minus_vd7_y -
        sr400_geo_D8*minus_U3_xy);
    values[125] = -(sr400_geo_D8*sa2*minus_U2_xy + sr400_geo_D8*ca2*minus_U2_yy);
}
