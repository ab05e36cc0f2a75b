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
static const double five_bar_geo_L3 = FIVE_BAR_GEO_L3;

/* Regressor of the standard parameters.
 * 22 additions, 36 multiplications. */
MODELER_CLONES
void five_bar_tree_regressor(const double q[4], const double qd[4], const double qdd[4],
                             double MODELER_OUT(phi, 4 * 40))
{
    MODELER_ALL_ZEROS(phi, 160);

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    phi[5] = qdd[0];
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd0 + U0 p11) */
    const double vd11_y = five_bar_geo_g*c0;
    MODELER_ZEROS(phi + 0, 5);
    phi[6] = vd11_y;
    const double vd11_x = five_bar_geo_g*s0;
    MODELER_ZEROS(phi + 8, 7);
    phi[7] = -vd11_x;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double wd21_z = qdd[0] + qdd[1];
    MODELER_ZEROS(phi + 18, 1);
    phi[15] = wd21_z;
    phi[55] = wd21_z;
    MODELER_ZEROS(phi + 20, 8);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double vd21a_y = vd11_y + five_bar_geo_L1*qdd[0];
    const double vd21a_x = vd11_x - qd[0]*qd[0]*five_bar_geo_L1;
    MODELER_ZEROS(phi + 28, 8);
    const double vd21_y = c1*vd21a_y - s1*vd21a_x;
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double w21_z = qd[0] + qd[1];
    MODELER_ZEROS(phi + 36, 8);
    const double ww21_zz = w21_z*w21_z;
    /* link 21: velocity of the origin, for unit speed of each joint below, m21 = R21' (m11 + e11 x
        p21) */
    const double m21_11x = five_bar_geo_L1*s1;
    MODELER_ZEROS(phi + 44, 8);
    const double m21_11y = five_bar_geo_L1*c1;
    phi[16] = wd21_z*m21_11y - ww21_zz*m21_11x + vd21_y;
    MODELER_ZEROS(phi + 52, 3);
    phi[56] = vd21_y;
    const double vd21_x = c1*vd21a_x + s1*vd21a_y;
    MODELER_ZEROS(phi + 58, 8);
    phi[17] = -(wd21_z*m21_11x + ww21_zz*m21_11y + vd21_x);
    phi[57] = -vd21_x;
    MODELER_ZEROS(phi + 66, 8);
    phi[19] = vd21_x*m21_11x + vd21_y*m21_11y;
    MODELER_ZEROS(phi + 74, 8);
    phi[105] = qdd[2];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd0 + U0 p12) */
    const double vd12_y = five_bar_geo_g*c2;
    MODELER_ZEROS(phi + 82, 8);
    phi[106] = vd12_y;
    const double vd12_x = five_bar_geo_g*s2;
    MODELER_ZEROS(phi + 90, 8);
    phi[107] = -vd12_x;
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double wd22_z = qdd[2] + qdd[3];
    MODELER_ZEROS(phi + 98, 7);
    phi[115] = wd22_z;
    phi[155] = wd22_z;
    MODELER_ZEROS(phi + 108, 7);
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22a_y = vd12_y + five_bar_geo_L3*qdd[2];
    const double vd22a_x = vd12_x - qd[2]*qd[2]*five_bar_geo_L3;
    MODELER_ZEROS(phi + 118, 1);
    const double vd22_y = c3*vd22a_y - s3*vd22a_x;
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double w22_z = qd[2] + qd[3];
    MODELER_ZEROS(phi + 120, 8);
    const double ww22_zz = w22_z*w22_z;
    /* link 22: velocity of the origin, for unit speed of each joint below, m22 = R22' (m12 + e12 x
        p22) */
    const double m22_12x = five_bar_geo_L3*s3;
    MODELER_ZEROS(phi + 128, 8);
    const double m22_12y = five_bar_geo_L3*c3;
    phi[116] = wd22_z*m22_12y - ww22_zz*m22_12x + vd22_y;
    MODELER_ZEROS(phi + 136, 8);
    phi[156] = vd22_y;
    const double vd22_x = c3*vd22a_x + s3*vd22a_y;
    MODELER_ZEROS(phi + 144, 8);
    phi[117] = -(wd22_z*m22_12x + ww22_zz*m22_12y + vd22_x);
    phi[157] = -vd22_x;
    MODELER_ZEROS(phi + 152, 3);
    phi[119] = vd22_x*m22_12x + vd22_y*m22_12y;
    MODELER_ZEROS(phi + 158, 2);
}
