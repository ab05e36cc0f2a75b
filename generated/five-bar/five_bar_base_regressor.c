/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar.h.
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
 *   m_1    velocity of the origin, for unit speed of each joint below
 *   ...a   in axes of the antecedent: vd
 */
#include "five_bar.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "five_bar_tree.h"

/* Geometry. To use another value, compile with e.g. -DFIVE_BAR_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef FIVE_BAR_GEO_g
#define FIVE_BAR_GEO_g 9.81
#endif
#ifndef FIVE_BAR_GEO_L0
#define FIVE_BAR_GEO_L0 0.2
#endif
#ifndef FIVE_BAR_GEO_L1
#define FIVE_BAR_GEO_L1 0.3
#endif
#ifndef FIVE_BAR_GEO_L2
#define FIVE_BAR_GEO_L2 0.4
#endif
#ifndef FIVE_BAR_GEO_L3
#define FIVE_BAR_GEO_L3 0.31
#endif
#ifndef FIVE_BAR_GEO_L4
#define FIVE_BAR_GEO_L4 0.42
#endif

static const double five_bar_geo_g = FIVE_BAR_GEO_g;
static const double five_bar_geo_L1 = FIVE_BAR_GEO_L1;
static const double five_bar_geo_L2 = FIVE_BAR_GEO_L2;
static const double five_bar_geo_L3 = FIVE_BAR_GEO_L3;
static const double five_bar_geo_L4 = FIVE_BAR_GEO_L4;

/* Regressor of the base parameters.
 * 17 additions, 28 multiplications. */
MODELER_CLONES
void five_bar_tree_base_regressor(const double q[4], const double qd[4], const double qdd[4],
                                  double MODELER_OUT(phi, 4 * 11))
{
    MODELER_ALL_ZEROS(phi, 44);

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    phi[0] = qdd[0];
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd0 + U0 p11) */
    const double vd11_y = five_bar_geo_g*c0;
    phi[1] = vd11_y;
    const double vd11_x = five_bar_geo_g*s0;
    phi[2] = -vd11_x;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double wd21_z = qdd[0] + qdd[1];
    phi[3] = wd21_z;
    MODELER_ZEROS(phi + 6, 8);
    phi[14] = wd21_z;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double vd21a_y = vd11_y + five_bar_geo_L1*qdd[0];
    const double vd21a_x = vd11_x - qd[0]*qd[0]*five_bar_geo_L1;
    const double vd21_y = c1*vd21a_y - s1*vd21a_x;
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double w21_z = qd[0] + qd[1];
    const double ww21_zz = w21_z*w21_z;
    MODELER_ZEROS(phi + 17, 8);
    /* link 21: velocity of the origin, for unit speed of each joint below, m21 = R21' (m11 + e11 x
        p21) */
    const double m21_11x = five_bar_geo_L1*s1;
    const double m21_11y = five_bar_geo_L1*c1;
    phi[4] = wd21_z*m21_11y - ww21_zz*m21_11x + vd21_y;
    phi[15] = vd21_y;
    const double vd21_x = c1*vd21a_x + s1*vd21a_y;
    phi[5] = -(wd21_z*m21_11x + ww21_zz*m21_11y + vd21_x);
    phi[16] = -vd21_x;
    MODELER_ZEROS(phi + 25, 3);
    phi[28] = qdd[2];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd0 + U0 p12) */
    const double vd12_y = five_bar_geo_g*c2;
    phi[29] = vd12_y;
    const double vd12_x = five_bar_geo_g*s2;
    phi[30] = -vd12_x;
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double wd22_z = qdd[2] + qdd[3];
    MODELER_ZEROS(phi + 33, 8);
    phi[31] = wd22_z;
    phi[42] = wd22_z;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22_x = c3*(vd12_x - qd[2]*qd[2]*five_bar_geo_L3) + s3*(vd12_y +
        five_bar_geo_L3*qdd[2]);
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double w22_z = qd[2] + qd[3];
    phi[32] = -(five_bar_geo_L3*s3*wd22_z + w22_z*w22_z*(five_bar_geo_L3*c3) + vd22_x);
    phi[43] = -vd22_x;
    MODELER_ZEROS(phi + 41, 1);
}

/* Regressor of the base parameters, loops closed.
 * 56 additions, 100 multiplications. */
MODELER_CLONES
void five_bar_tree_rows(const double q[4], const double t[8], const double G[4],
                        const double lu[4], const double v[2], const double a[2],
                        double MODELER_OUT(phi, 2 * 11))
{
    (void)q;
    phi[6] = 0.0;
    phi[7] = 0.0;
    phi[8] = 0.0;
    phi[11] = 0.0;
    phi[12] = 0.0;
    phi[13] = 0.0;

    phi[0] = a[0];
    const double t1 = five_bar_geo_g*t[0];
    phi[1] = t1;
    const double t2 = five_bar_geo_g*t[1];
    phi[2] = -t2;
    const double t3 = five_bar_geo_L2*(t[0]*t[2] - t[1]*t[3]);
    const double t4 = G[0]*v[0] + G[2]*v[1];
    const double t5 = t[0]*v[0];
    const double t6 = t[3]*t4;
    const double t7 = t[1]*v[0];
    const double t8 = t[2]*t4;
    const double t9 = five_bar_geo_L2*(t[2]*t5 - t[1]*t6 + (t[0]*t8 - t[3]*t7))*t4;
    const double t10 = t[4]*v[1];
    const double t11 = G[1]*v[0] + G[3]*v[1];
    const double t12 = t[7]*t11;
    const double t13 = t[5]*v[1];
    const double t14 = t[6]*t11;
    const double t15 = five_bar_geo_L4*(t[6]*t10 - t[5]*t12 + (t[4]*t14 - t[7]*t13));
    const double t16 = v[0]*(v[0]*(five_bar_geo_L1*t[0] + t3) + t4*t3) + t9;
    const double t17 = t16 - v[1]*(five_bar_geo_L3*t10 + t15) - t11*t15;
    const double t18 = five_bar_geo_L2*(t[1]*t[2] + t[0]*t[3]);
    const double t19 = five_bar_geo_L2*(t[2]*t7 + t[0]*t6 + (t[3]*t5 + t[1]*t8))*t4;
    const double t20 = five_bar_geo_L4*(t[6]*t13 + t[4]*t12 + (t[7]*t10 + t[5]*t14));
    const double t21 = v[0]*(v[0]*(five_bar_geo_L1*t[1] + t18) + t4*t18) + t19;
    const double t22 = lu[1]*(t21 - v[1]*(five_bar_geo_L3*t13 + t20) - t11*t20 - lu[3]*t17);
    const double t23 = G[0]*a[0] + G[2]*a[1] + lu[0]*(t17 - lu[2]*t22) + a[0];
    phi[3] = t23 + G[0]*t23;
    phi[14] = G[2]*t23;
    const double t24 = t1 + five_bar_geo_L1*a[0];
    const double t25 = t2 - v[0]*v[0]*five_bar_geo_L1;
    const double t26 = t[2]*t24 - t[3]*t25;
    const double t27 = v[0] + t4;
    const double t28 = t27*t27;
    const double t29 = five_bar_geo_L1*t[3];
    const double t30 = five_bar_geo_L1*t[2];
    phi[4] = t23*t30 - t28*t29 + t26 + G[0]*t26;
    phi[15] = G[2]*t26;
    const double t31 = t[2]*t25 + t[3]*t24;
    phi[5] = -(t23*t29 + t28*t30 + t31 + G[0]*t31);
    phi[16] = -G[2]*t31;
    phi[17] = a[1];
    const double t32 = five_bar_geo_g*t[4];
    phi[18] = t32;
    const double t33 = five_bar_geo_g*t[5];
    phi[19] = -t33;
    const double t34 = G[1]*a[0] + G[3]*a[1] + t22 + a[1];
    phi[9] = G[1]*t34;
    phi[20] = t34 + G[3]*t34;
    const double t35 = t[6]*(t33 - v[1]*v[1]*five_bar_geo_L3) + t[7]*(t32 + five_bar_geo_L3*a[1]);
    phi[10] = -G[1]*t35;
    const double t36 = v[1] + t11;
    phi[21] = -(five_bar_geo_L3*t[7]*t34 + t36*t36*(five_bar_geo_L3*t[6]) + t35 + G[3]*t35);
}
