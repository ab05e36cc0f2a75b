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
static const double five_bar_geo_L2 = FIVE_BAR_GEO_L2;
static const double five_bar_geo_L3 = FIVE_BAR_GEO_L3;
static const double five_bar_geo_L4 = FIVE_BAR_GEO_L4;

/* Regressor of the base parameters.
 * 17 additions, 28 multiplications. */
void five_bar_tree_base_regressor(const double *q, const double *qd, const double *qdd,
                                  double *MODELER_RESTRICT phi)
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
    const double t1 = five_bar_geo_g*c0;
    phi[1] = t1;
    const double t2 = five_bar_geo_g*s0;
    phi[2] = -t2;
    const double t3 = qdd[0] + qdd[1];
    phi[3] = t3;
    MODELER_ZEROS(phi + 6, 8);
    phi[14] = t3;
    const double t4 = t1 + five_bar_geo_L1*qdd[0];
    const double t5 = t2 - qd[0]*qd[0]*five_bar_geo_L1;
    const double t6 = c1*t4 - s1*t5;
    const double t7 = qd[0] + qd[1];
    const double t8 = t7*t7;
    MODELER_ZEROS(phi + 17, 8);
    const double t9 = five_bar_geo_L1*s1;
    const double t10 = five_bar_geo_L1*c1;
    phi[4] = t3*t10 - t8*t9 + t6;
    phi[15] = t6;
    const double t11 = c1*t5 + s1*t4;
    phi[5] = -(t3*t9 + t8*t10 + t11);
    phi[16] = -t11;
    MODELER_ZEROS(phi + 25, 3);
    phi[28] = qdd[2];
    const double t12 = five_bar_geo_g*c2;
    phi[29] = t12;
    const double t13 = five_bar_geo_g*s2;
    phi[30] = -t13;
    const double t14 = qdd[2] + qdd[3];
    MODELER_ZEROS(phi + 33, 8);
    phi[31] = t14;
    phi[42] = t14;
    const double t15 = c3*(t13 - qd[2]*qd[2]*five_bar_geo_L3) + s3*(t12 + five_bar_geo_L3*qdd[2]);
    const double t16 = qd[2] + qd[3];
    phi[32] = -(five_bar_geo_L3*s3*t14 + t16*t16*(five_bar_geo_L3*c3) + t15);
    phi[43] = -t15;
    MODELER_ZEROS(phi + 41, 1);
}

/* Regressor of the base parameters, loops closed.
 * 56 additions, 100 multiplications. */
void five_bar_tree_rows(const double *q, const double *t, const double *G, const double *lu,
                        const double *v, const double *a, double *MODELER_RESTRICT phi)
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
