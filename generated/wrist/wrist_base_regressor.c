/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist.h.
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
#include "wrist.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DWRIST_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef WRIST_GEO_g
#define WRIST_GEO_g 9.81
#endif
#ifndef WRIST_GEO_al1
#define WRIST_GEO_al1 0.2
#endif
#ifndef WRIST_GEO_bl1
#define WRIST_GEO_bl1 0.1
#endif

static const double wrist_geo_g = WRIST_GEO_g;
static const double wrist_geo_bl1 = WRIST_GEO_bl1;

/* Regressor of the base parameters.
 * 64 additions, 92 multiplications. */
MODELER_CLONES
void wrist_base_regressor(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                          const double qdd[WRIST_JOINTS], double MODELER_OUT(phi, 3 * 17))
{
    phi[7] = 0.0;
    phi[17] = 0.0;
    phi[18] = 0.0;
    phi[19] = 0.0;
    phi[34] = 0.0;
    phi[35] = 0.0;
    phi[36] = 0.0;
    phi[37] = 0.0;
    phi[38] = 0.0;
    phi[39] = 0.0;
    phi[40] = 0.0;
    phi[41] = 0.0;
    phi[42] = 0.0;
    phi[43] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    phi[0] = qdd[0];
    /* link 1: acceleration of the origin less gravity, vd1 = R1' (vd0 + U0 p1) */
    const double minus_vd1_y = wrist_geo_g*s0;
    phi[1] = -minus_vd1_y;
    const double vd1_x = wrist_geo_g*c0;
    phi[2] = -vd1_x;
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double minus_U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double w2_y = c1*qd[0];
    const double ww2_yz = qd[1]*w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double wd2_x = minus_U2_yz + ww2_yz;
    const double w2_x = s1*qd[0];
    const double ww2_xz = qd[1]*w2_x;
    phi[3] = s1*wd2_x + c1*ww2_xz;
    const double ww2_xy = w2_x*w2_y;
    phi[20] = -ww2_xy;
    const double U2_xz = c1*qdd[0];
    const double wd2_y = U2_xz - ww2_xz;
    const double U2_zy = ww2_yz + wd2_x;
    phi[4] = c1*U2_zy - s1*(ww2_xz - wd2_y);
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = w2_y*w2_y + ww2_zz;
    const double minus_U2_yy = w2_x*w2_x + ww2_zz;
    phi[21] = minus_U2_yy - minus_U2_xx;
    const double ww1_zz = qd[0]*qd[0];
    phi[5] = s1*(qdd[1] + ww2_xy) - c1*(ww1_zz - minus_U2_xx);
    phi[22] = minus_U2_yz;
    const double minus_U2_xy = qdd[1] - ww2_xy;
    phi[6] = s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy;
    phi[23] = U2_xz;
    phi[24] = qdd[1];
    phi[8] = -c1*minus_vd1_y;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = s1*vd1_x;
    phi[25] = -minus_vd2_y;
    phi[9] = s1*minus_vd1_y;
    const double vd2_x = c1*vd1_x;
    phi[26] = -vd2_x;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1] + s2*w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double wd3_x = c2*wd2_x - s2*qdd[1] - qd[2]*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double e3_1x = s1*c2;
    const double w3_x = c2*w2_x - s2*qd[1];
    const double w3_z = qd[2] + w2_y;
    const double ww3_xz = w3_x*w3_z;
    const double minus_e3_1y = s1*s2;
    const double t27 = ww3_xz*minus_e3_1y;
    const double minus_ww3_xy = w3_x*minus_w3_y;
    phi[10] = wd3_x*e3_1x - t27 + c1*minus_ww3_xy;
    const double t29 = c2*ww3_xz;
    phi[27] = -(s2*wd3_x + t29);
    phi[44] = minus_ww3_xy;
    const double minus_wd3_y = c2*qdd[1] + s2*wd2_x + qd[2]*w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y + ww3_xz;
    const double minus_ww3_yz = minus_w3_y*w3_z;
    const double U3_zy = wd3_x - minus_ww3_yz;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = w3_x*w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    phi[11] = -(U3_zx*e3_1x + U3_zy*minus_e3_1y + c1*minus_n3_XYz);
    phi[28] = s2*U3_zx - c2*U3_zy;
    phi[45] = -minus_n3_XYz;
    const double wd3_z = qdd[2] + wd2_y;
    const double U3_yx = wd3_z - minus_ww3_xy;
    const double minus_n3_XZy = minus_U2_yy - minus_U3_xx;
    const double minus_U3_yz = wd3_x + minus_ww3_yz;
    phi[12] = U3_yx*e3_1x + minus_e3_1y*minus_n3_XZy + c1*minus_U3_yz;
    phi[29] = c2*minus_n3_XZy - s2*U3_yx;
    phi[46] = minus_U3_yz;
    const double n3_YZx = minus_U2_yy - minus_U3_yy;
    const double minus_U3_xy = wd3_z + minus_ww3_xy;
    const double minus_U3_xz = minus_wd3_y - ww3_xz;
    phi[13] = e3_1x*n3_YZx - minus_U3_xy*minus_e3_1y - c1*minus_U3_xz;
    phi[30] = -(s2*n3_YZx + c2*minus_U3_xy);
    phi[47] = -minus_U3_xz;
    phi[14] = t27 - minus_ww3_yz*e3_1x + c1*wd3_z;
    phi[31] = t29 + s2*minus_ww3_yz;
    phi[48] = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3_z = minus_vd2_y + wrist_geo_bl1*minus_U2_yy;
    const double vd3a_z = minus_vd1_y + wrist_geo_bl1*U2_zy;
    const double vd3a_x = vd2_x - wrist_geo_bl1*minus_U2_xy;
    const double minus_vd3_y = c2*vd3a_z + s2*vd3a_x;
    const double t49 = wrist_geo_bl1*s1;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double minus_m3_1x = s2*t49;
    const double minus_m3_1y = c2*t49;
    phi[15] = minus_U3_xx*minus_m3_1x - U3_yx*minus_m3_1y - (minus_vd3_z*minus_e3_1y +
        c1*minus_vd3_y);
    const double minus_m3_2x = wrist_geo_bl1*c2;
    const double m3_2y = wrist_geo_bl1*s2;
    phi[32] = minus_U3_xx*minus_m3_2x + U3_yx*m3_2y - c2*minus_vd3_z;
    phi[49] = -minus_vd3_y;
    const double vd3_x = c2*vd3a_x - s2*vd3a_z;
    phi[16] = minus_U3_xy*minus_m3_1x + minus_U3_yy*minus_m3_1y - (minus_vd3_z*e3_1x + c1*vd3_x);
    phi[33] = minus_U3_xy*minus_m3_2x - minus_U3_yy*m3_2y + s2*minus_vd3_z;
    phi[50] = -vd3_x;
}

/* The entries of the base regressor that are not always 0.
 * 64 additions, 92 multiplications. */
MODELER_CLONES
void wrist_base_regressor_nonzeros(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                                   const double qdd[WRIST_JOINTS], double MODELER_OUT(values, 37))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    values[0] = qdd[0];
    /* link 1: acceleration of the origin less gravity, vd1 = R1' (vd0 + U0 p1) */
    const double minus_vd1_y = wrist_geo_g*s0;
    values[1] = -minus_vd1_y;
    const double vd1_x = wrist_geo_g*c0;
    values[2] = -vd1_x;
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const double minus_U2_yz = s1*qdd[0];
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double w2_y = c1*qd[0];
    const double ww2_yz = qd[1]*w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double wd2_x = minus_U2_yz + ww2_yz;
    const double w2_x = s1*qd[0];
    const double ww2_xz = qd[1]*w2_x;
    values[3] = s1*wd2_x + c1*ww2_xz;
    const double ww2_xy = w2_x*w2_y;
    values[16] = -ww2_xy;
    const double U2_xz = c1*qdd[0];
    const double wd2_y = U2_xz - ww2_xz;
    const double U2_zy = ww2_yz + wd2_x;
    values[4] = c1*U2_zy - s1*(ww2_xz - wd2_y);
    const double ww2_zz = qd[1]*qd[1];
    const double minus_U2_xx = w2_y*w2_y + ww2_zz;
    const double minus_U2_yy = w2_x*w2_x + ww2_zz;
    values[17] = minus_U2_yy - minus_U2_xx;
    const double ww1_zz = qd[0]*qd[0];
    values[5] = s1*(qdd[1] + ww2_xy) - c1*(ww1_zz - minus_U2_xx);
    values[18] = minus_U2_yz;
    const double minus_U2_xy = qdd[1] - ww2_xy;
    values[6] = s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy;
    values[19] = U2_xz;
    values[20] = qdd[1];
    values[7] = -c1*minus_vd1_y;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = s1*vd1_x;
    values[21] = -minus_vd2_y;
    values[8] = s1*minus_vd1_y;
    const double vd2_x = c1*vd1_x;
    values[22] = -vd2_x;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1] + s2*w2_x;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double wd3_x = c2*wd2_x - s2*qdd[1] - qd[2]*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const double e3_1x = s1*c2;
    const double w3_x = c2*w2_x - s2*qd[1];
    const double w3_z = qd[2] + w2_y;
    const double ww3_xz = w3_x*w3_z;
    const double minus_e3_1y = s1*s2;
    const double t27 = ww3_xz*minus_e3_1y;
    const double minus_ww3_xy = w3_x*minus_w3_y;
    values[9] = wd3_x*e3_1x - t27 + c1*minus_ww3_xy;
    const double t29 = c2*ww3_xz;
    values[23] = -(s2*wd3_x + t29);
    values[30] = minus_ww3_xy;
    const double minus_wd3_y = c2*qdd[1] + s2*wd2_x + qd[2]*w3_x;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const double U3_zx = minus_wd3_y + ww3_xz;
    const double minus_ww3_yz = minus_w3_y*w3_z;
    const double U3_zy = wd3_x - minus_ww3_yz;
    const double ww3_zz = w3_z*w3_z;
    const double minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const double minus_U3_yy = w3_x*w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const double minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    values[10] = -(U3_zx*e3_1x + U3_zy*minus_e3_1y + c1*minus_n3_XYz);
    values[24] = s2*U3_zx - c2*U3_zy;
    values[31] = -minus_n3_XYz;
    const double wd3_z = qdd[2] + wd2_y;
    const double U3_yx = wd3_z - minus_ww3_xy;
    const double minus_n3_XZy = minus_U2_yy - minus_U3_xx;
    const double minus_U3_yz = wd3_x + minus_ww3_yz;
    values[11] = U3_yx*e3_1x + minus_e3_1y*minus_n3_XZy + c1*minus_U3_yz;
    values[25] = c2*minus_n3_XZy - s2*U3_yx;
    values[32] = minus_U3_yz;
    const double n3_YZx = minus_U2_yy - minus_U3_yy;
    const double minus_U3_xy = wd3_z + minus_ww3_xy;
    const double minus_U3_xz = minus_wd3_y - ww3_xz;
    values[12] = e3_1x*n3_YZx - minus_U3_xy*minus_e3_1y - c1*minus_U3_xz;
    values[26] = -(s2*n3_YZx + c2*minus_U3_xy);
    values[33] = -minus_U3_xz;
    values[13] = t27 - minus_ww3_yz*e3_1x + c1*wd3_z;
    values[27] = t29 + s2*minus_ww3_yz;
    values[34] = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3_z = minus_vd2_y + wrist_geo_bl1*minus_U2_yy;
    const double vd3a_z = minus_vd1_y + wrist_geo_bl1*U2_zy;
    const double vd3a_x = vd2_x - wrist_geo_bl1*minus_U2_xy;
    const double minus_vd3_y = c2*vd3a_z + s2*vd3a_x;
    const double t49 = wrist_geo_bl1*s1;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const double minus_m3_1x = s2*t49;
    const double minus_m3_1y = c2*t49;
    values[14] = minus_U3_xx*minus_m3_1x - U3_yx*minus_m3_1y - (minus_vd3_z*minus_e3_1y +
        c1*minus_vd3_y);
    const double minus_m3_2x = wrist_geo_bl1*c2;
    const double m3_2y = wrist_geo_bl1*s2;
    values[28] = minus_U3_xx*minus_m3_2x + U3_yx*m3_2y - c2*minus_vd3_z;
    values[35] = -minus_vd3_y;
    const double vd3_x = c2*vd3a_x - s2*vd3a_z;
    values[15] = minus_U3_xy*minus_m3_1x + minus_U3_yy*minus_m3_1y - (minus_vd3_z*e3_1x + c1*vd3_x);
    values[29] = minus_U3_xy*minus_m3_2x - minus_U3_yy*m3_2y + s2*minus_vd3_z;
    values[36] = -vd3_x;
}
