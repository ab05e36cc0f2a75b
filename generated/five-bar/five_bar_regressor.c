/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
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
void five_bar_tree_regressor(const double *q, const double *qd, const double *qdd,
                             double *MODELER_RESTRICT phi)
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
    const double t1 = five_bar_geo_g*c0;
    MODELER_ZEROS(phi + 0, 5);
    phi[6] = t1;
    const double t2 = five_bar_geo_g*s0;
    MODELER_ZEROS(phi + 8, 7);
    phi[7] = -t2;
    const double t3 = qdd[0] + qdd[1];
    MODELER_ZEROS(phi + 18, 1);
    phi[15] = t3;
    phi[55] = t3;
    MODELER_ZEROS(phi + 20, 8);
    const double t4 = t1 + five_bar_geo_L1*qdd[0];
    const double t5 = t2 - qd[0]*qd[0]*five_bar_geo_L1;
    MODELER_ZEROS(phi + 28, 8);
    const double t6 = c1*t4 - s1*t5;
    const double t7 = qd[0] + qd[1];
    MODELER_ZEROS(phi + 36, 8);
    const double t8 = t7*t7;
    const double t9 = five_bar_geo_L1*s1;
    MODELER_ZEROS(phi + 44, 8);
    const double t10 = five_bar_geo_L1*c1;
    phi[16] = t3*t10 - t8*t9 + t6;
    MODELER_ZEROS(phi + 52, 3);
    phi[56] = t6;
    const double t11 = c1*t5 + s1*t4;
    MODELER_ZEROS(phi + 58, 8);
    phi[17] = -(t3*t9 + t8*t10 + t11);
    phi[57] = -t11;
    MODELER_ZEROS(phi + 66, 8);
    phi[19] = t11*t9 + t6*t10;
    MODELER_ZEROS(phi + 74, 8);
    phi[105] = qdd[2];
    const double t12 = five_bar_geo_g*c2;
    MODELER_ZEROS(phi + 82, 8);
    phi[106] = t12;
    const double t13 = five_bar_geo_g*s2;
    MODELER_ZEROS(phi + 90, 8);
    phi[107] = -t13;
    const double t14 = qdd[2] + qdd[3];
    MODELER_ZEROS(phi + 98, 7);
    phi[115] = t14;
    phi[155] = t14;
    MODELER_ZEROS(phi + 108, 7);
    const double t15 = t12 + five_bar_geo_L3*qdd[2];
    const double t16 = t13 - qd[2]*qd[2]*five_bar_geo_L3;
    MODELER_ZEROS(phi + 118, 1);
    const double t17 = c3*t15 - s3*t16;
    const double t18 = qd[2] + qd[3];
    MODELER_ZEROS(phi + 120, 8);
    const double t19 = t18*t18;
    const double t20 = five_bar_geo_L3*s3;
    MODELER_ZEROS(phi + 128, 8);
    const double t21 = five_bar_geo_L3*c3;
    phi[116] = t14*t21 - t19*t20 + t17;
    MODELER_ZEROS(phi + 136, 8);
    phi[156] = t17;
    const double t22 = c3*t16 + s3*t15;
    MODELER_ZEROS(phi + 144, 8);
    phi[117] = -(t14*t20 + t19*t21 + t22);
    phi[157] = -t22;
    MODELER_ZEROS(phi + 152, 3);
    phi[119] = t22*t20 + t17*t21;
    MODELER_ZEROS(phi + 158, 2);
}
