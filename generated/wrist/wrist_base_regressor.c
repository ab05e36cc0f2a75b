/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
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
void wrist_base_regressor(const double *q, const double *qd, const double *qdd,
                          double *MODELER_RESTRICT phi)
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
    const double t1 = wrist_geo_g*s0;
    phi[1] = -t1;
    const double t2 = wrist_geo_g*c0;
    phi[2] = -t2;
    const double t3 = s1*qdd[0];
    const double t4 = c1*qd[0];
    const double t5 = qd[1]*t4;
    const double t6 = t3 + t5;
    const double t7 = s1*qd[0];
    const double t8 = qd[1]*t7;
    phi[3] = s1*t6 + c1*t8;
    const double t9 = c1*qdd[0];
    const double t10 = t9 - t8;
    const double t11 = t5 + t6;
    phi[4] = c1*t11 - s1*(t8 - t10);
    const double t12 = t7*t4;
    const double t13 = qd[0]*qd[0];
    const double t14 = qd[1]*qd[1];
    const double t15 = t4*t4 + t14;
    phi[5] = s1*(qdd[1] + t12) - c1*(t13 - t15);
    const double t16 = t7*t7 + t14;
    const double t17 = qdd[1] - t12;
    phi[6] = s1*(t13 - t16) + c1*t17;
    phi[8] = -c1*t1;
    phi[9] = s1*t1;
    const double t18 = c2*qd[1] + s2*t7;
    const double t19 = c2*t6 - s2*qdd[1] - qd[2]*t18;
    const double t20 = s1*c2;
    const double t21 = c2*t7 - s2*qd[1];
    const double t22 = qd[2] + t4;
    const double t23 = t21*t22;
    const double t24 = s1*s2;
    const double t25 = t23*t24;
    const double t26 = t21*t18;
    phi[10] = t19*t20 - t25 + c1*t26;
    const double t27 = c2*qdd[1] + s2*t6 + qd[2]*t21;
    const double t28 = t27 + t23;
    const double t29 = t18*t22;
    const double t30 = t19 - t29;
    const double t31 = t22*t22;
    const double t32 = t18*t18 + t31;
    const double t33 = t21*t21 + t31;
    const double t34 = t32 - t33;
    phi[11] = -(t28*t20 + t30*t24 + c1*t34);
    const double t35 = qdd[2] + t10;
    const double t36 = t35 - t26;
    const double t37 = t16 - t32;
    const double t38 = t19 + t29;
    phi[12] = t36*t20 + t24*t37 + c1*t38;
    const double t39 = t16 - t33;
    const double t40 = t35 + t26;
    const double t41 = t27 - t23;
    phi[13] = t20*t39 - t40*t24 - c1*t41;
    phi[14] = t25 - t29*t20 + c1*t35;
    const double t42 = s1*t2;
    const double t43 = t42 + wrist_geo_bl1*t16;
    const double t44 = t1 + wrist_geo_bl1*t11;
    const double t45 = c1*t2;
    const double t46 = t45 - wrist_geo_bl1*t17;
    const double t47 = c2*t44 + s2*t46;
    const double t48 = wrist_geo_bl1*s1;
    const double t49 = s2*t48;
    const double t50 = c2*t48;
    phi[15] = t32*t49 - t36*t50 - (t43*t24 + c1*t47);
    const double t51 = c2*t46 - s2*t44;
    phi[16] = t40*t49 + t33*t50 - (t43*t20 + c1*t51);
    phi[20] = -t12;
    phi[21] = t16 - t15;
    phi[22] = t3;
    phi[23] = t9;
    phi[24] = qdd[1];
    phi[25] = -t42;
    phi[26] = -t45;
    const double t52 = c2*t23;
    phi[27] = -(s2*t19 + t52);
    phi[28] = s2*t28 - c2*t30;
    phi[29] = c2*t37 - s2*t36;
    phi[30] = -(s2*t39 + c2*t40);
    phi[31] = t52 + s2*t29;
    const double t53 = wrist_geo_bl1*c2;
    const double t54 = wrist_geo_bl1*s2;
    phi[32] = t32*t53 + t36*t54 - c2*t43;
    phi[33] = t40*t53 - t33*t54 + s2*t43;
    phi[44] = t26;
    phi[45] = -t34;
    phi[46] = t38;
    phi[47] = -t41;
    phi[48] = t35;
    phi[49] = -t47;
    phi[50] = -t51;
}

/* The entries of the base regressor that are not always 0.
 * 64 additions, 92 multiplications. */
void wrist_base_regressor_nonzeros(const double *q, const double *qd, const double *qdd,
                                   double *MODELER_RESTRICT values)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    values[0] = qdd[0];
    const double t1 = wrist_geo_g*s0;
    values[1] = -t1;
    const double t2 = wrist_geo_g*c0;
    values[2] = -t2;
    const double t3 = s1*qdd[0];
    const double t4 = c1*qd[0];
    const double t5 = qd[1]*t4;
    const double t6 = t3 + t5;
    const double t7 = s1*qd[0];
    const double t8 = qd[1]*t7;
    values[3] = s1*t6 + c1*t8;
    const double t9 = c1*qdd[0];
    const double t10 = t9 - t8;
    const double t11 = t5 + t6;
    values[4] = c1*t11 - s1*(t8 - t10);
    const double t12 = t7*t4;
    const double t13 = qd[0]*qd[0];
    const double t14 = qd[1]*qd[1];
    const double t15 = t4*t4 + t14;
    values[5] = s1*(qdd[1] + t12) - c1*(t13 - t15);
    const double t16 = t7*t7 + t14;
    const double t17 = qdd[1] - t12;
    values[6] = s1*(t13 - t16) + c1*t17;
    values[7] = -c1*t1;
    values[8] = s1*t1;
    const double t18 = c2*qd[1] + s2*t7;
    const double t19 = c2*t6 - s2*qdd[1] - qd[2]*t18;
    const double t20 = s1*c2;
    const double t21 = c2*t7 - s2*qd[1];
    const double t22 = qd[2] + t4;
    const double t23 = t21*t22;
    const double t24 = s1*s2;
    const double t25 = t23*t24;
    const double t26 = t21*t18;
    values[9] = t19*t20 - t25 + c1*t26;
    const double t27 = c2*qdd[1] + s2*t6 + qd[2]*t21;
    const double t28 = t27 + t23;
    const double t29 = t18*t22;
    const double t30 = t19 - t29;
    const double t31 = t22*t22;
    const double t32 = t18*t18 + t31;
    const double t33 = t21*t21 + t31;
    const double t34 = t32 - t33;
    values[10] = -(t28*t20 + t30*t24 + c1*t34);
    const double t35 = qdd[2] + t10;
    const double t36 = t35 - t26;
    const double t37 = t16 - t32;
    const double t38 = t19 + t29;
    values[11] = t36*t20 + t24*t37 + c1*t38;
    const double t39 = t16 - t33;
    const double t40 = t35 + t26;
    const double t41 = t27 - t23;
    values[12] = t20*t39 - t40*t24 - c1*t41;
    values[13] = t25 - t29*t20 + c1*t35;
    const double t42 = s1*t2;
    const double t43 = t42 + wrist_geo_bl1*t16;
    const double t44 = t1 + wrist_geo_bl1*t11;
    const double t45 = c1*t2;
    const double t46 = t45 - wrist_geo_bl1*t17;
    const double t47 = c2*t44 + s2*t46;
    const double t48 = wrist_geo_bl1*s1;
    const double t49 = s2*t48;
    const double t50 = c2*t48;
    values[14] = t32*t49 - t36*t50 - (t43*t24 + c1*t47);
    const double t51 = c2*t46 - s2*t44;
    values[15] = t40*t49 + t33*t50 - (t43*t20 + c1*t51);
    values[16] = -t12;
    values[17] = t16 - t15;
    values[18] = t3;
    values[19] = t9;
    values[20] = qdd[1];
    values[21] = -t42;
    values[22] = -t45;
    const double t52 = c2*t23;
    values[23] = -(s2*t19 + t52);
    values[24] = s2*t28 - c2*t30;
    values[25] = c2*t37 - s2*t36;
    values[26] = -(s2*t39 + c2*t40);
    values[27] = t52 + s2*t29;
    const double t53 = wrist_geo_bl1*c2;
    const double t54 = wrist_geo_bl1*s2;
    values[28] = t32*t53 + t36*t54 - c2*t43;
    values[29] = t40*t53 - t33*t54 + s2*t43;
    values[30] = t26;
    values[31] = -t34;
    values[32] = t38;
    values[33] = -t41;
    values[34] = t35;
    values[35] = -t47;
    values[36] = -t51;
}
