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
    const double t9 = t7*t4;
    phi[20] = -t9;
    const double t10 = c1*qdd[0];
    const double t11 = t10 - t8;
    const double t12 = t5 + t6;
    phi[4] = c1*t12 - s1*(t8 - t11);
    const double t13 = qd[1]*qd[1];
    const double t14 = t4*t4 + t13;
    const double t15 = t7*t7 + t13;
    phi[21] = t15 - t14;
    const double t16 = qd[0]*qd[0];
    phi[5] = s1*(qdd[1] + t9) - c1*(t16 - t14);
    phi[22] = t3;
    const double t17 = qdd[1] - t9;
    phi[6] = s1*(t16 - t15) + c1*t17;
    phi[23] = t10;
    phi[24] = qdd[1];
    phi[8] = -c1*t1;
    const double t18 = s1*t2;
    phi[25] = -t18;
    phi[9] = s1*t1;
    const double t19 = c1*t2;
    phi[26] = -t19;
    const double t20 = c2*qd[1] + s2*t7;
    const double t21 = c2*t6 - s2*qdd[1] - qd[2]*t20;
    const double t22 = s1*c2;
    const double t23 = c2*t7 - s2*qd[1];
    const double t24 = qd[2] + t4;
    const double t25 = t23*t24;
    const double t26 = s1*s2;
    const double t27 = t25*t26;
    const double t28 = t23*t20;
    phi[10] = t21*t22 - t27 + c1*t28;
    const double t29 = c2*t25;
    phi[27] = -(s2*t21 + t29);
    phi[44] = t28;
    const double t30 = c2*qdd[1] + s2*t6 + qd[2]*t23;
    const double t31 = t30 + t25;
    const double t32 = t20*t24;
    const double t33 = t21 - t32;
    const double t34 = t24*t24;
    const double t35 = t20*t20 + t34;
    const double t36 = t23*t23 + t34;
    const double t37 = t35 - t36;
    phi[11] = -(t31*t22 + t33*t26 + c1*t37);
    phi[28] = s2*t31 - c2*t33;
    phi[45] = -t37;
    const double t38 = qdd[2] + t11;
    const double t39 = t38 - t28;
    const double t40 = t15 - t35;
    const double t41 = t21 + t32;
    phi[12] = t39*t22 + t26*t40 + c1*t41;
    phi[29] = c2*t40 - s2*t39;
    phi[46] = t41;
    const double t42 = t15 - t36;
    const double t43 = t38 + t28;
    const double t44 = t30 - t25;
    phi[13] = t22*t42 - t43*t26 - c1*t44;
    phi[30] = -(s2*t42 + c2*t43);
    phi[47] = -t44;
    phi[14] = t27 - t32*t22 + c1*t38;
    phi[31] = t29 + s2*t32;
    phi[48] = t38;
    const double t45 = t18 + wrist_geo_bl1*t15;
    const double t46 = t1 + wrist_geo_bl1*t12;
    const double t47 = t19 - wrist_geo_bl1*t17;
    const double t48 = c2*t46 + s2*t47;
    const double t49 = wrist_geo_bl1*s1;
    const double t50 = s2*t49;
    const double t51 = c2*t49;
    phi[15] = t35*t50 - t39*t51 - (t45*t26 + c1*t48);
    const double t52 = wrist_geo_bl1*c2;
    const double t53 = wrist_geo_bl1*s2;
    phi[32] = t35*t52 + t39*t53 - c2*t45;
    phi[49] = -t48;
    const double t54 = c2*t47 - s2*t46;
    phi[16] = t43*t50 + t36*t51 - (t45*t22 + c1*t54);
    phi[33] = t43*t52 - t36*t53 + s2*t45;
    phi[50] = -t54;
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
    const double t9 = t7*t4;
    values[16] = -t9;
    const double t10 = c1*qdd[0];
    const double t11 = t10 - t8;
    const double t12 = t5 + t6;
    values[4] = c1*t12 - s1*(t8 - t11);
    const double t13 = qd[1]*qd[1];
    const double t14 = t4*t4 + t13;
    const double t15 = t7*t7 + t13;
    values[17] = t15 - t14;
    const double t16 = qd[0]*qd[0];
    values[5] = s1*(qdd[1] + t9) - c1*(t16 - t14);
    values[18] = t3;
    const double t17 = qdd[1] - t9;
    values[6] = s1*(t16 - t15) + c1*t17;
    values[19] = t10;
    values[20] = qdd[1];
    values[7] = -c1*t1;
    const double t18 = s1*t2;
    values[21] = -t18;
    values[8] = s1*t1;
    const double t19 = c1*t2;
    values[22] = -t19;
    const double t20 = c2*qd[1] + s2*t7;
    const double t21 = c2*t6 - s2*qdd[1] - qd[2]*t20;
    const double t22 = s1*c2;
    const double t23 = c2*t7 - s2*qd[1];
    const double t24 = qd[2] + t4;
    const double t25 = t23*t24;
    const double t26 = s1*s2;
    const double t27 = t25*t26;
    const double t28 = t23*t20;
    values[9] = t21*t22 - t27 + c1*t28;
    const double t29 = c2*t25;
    values[23] = -(s2*t21 + t29);
    values[30] = t28;
    const double t30 = c2*qdd[1] + s2*t6 + qd[2]*t23;
    const double t31 = t30 + t25;
    const double t32 = t20*t24;
    const double t33 = t21 - t32;
    const double t34 = t24*t24;
    const double t35 = t20*t20 + t34;
    const double t36 = t23*t23 + t34;
    const double t37 = t35 - t36;
    values[10] = -(t31*t22 + t33*t26 + c1*t37);
    values[24] = s2*t31 - c2*t33;
    values[31] = -t37;
    const double t38 = qdd[2] + t11;
    const double t39 = t38 - t28;
    const double t40 = t15 - t35;
    const double t41 = t21 + t32;
    values[11] = t39*t22 + t26*t40 + c1*t41;
    values[25] = c2*t40 - s2*t39;
    values[32] = t41;
    const double t42 = t15 - t36;
    const double t43 = t38 + t28;
    const double t44 = t30 - t25;
    values[12] = t22*t42 - t43*t26 - c1*t44;
    values[26] = -(s2*t42 + c2*t43);
    values[33] = -t44;
    values[13] = t27 - t32*t22 + c1*t38;
    values[27] = t29 + s2*t32;
    values[34] = t38;
    const double t45 = t18 + wrist_geo_bl1*t15;
    const double t46 = t1 + wrist_geo_bl1*t12;
    const double t47 = t19 - wrist_geo_bl1*t17;
    const double t48 = c2*t46 + s2*t47;
    const double t49 = wrist_geo_bl1*s1;
    const double t50 = s2*t49;
    const double t51 = c2*t49;
    values[14] = t35*t50 - t39*t51 - (t45*t26 + c1*t48);
    const double t52 = wrist_geo_bl1*c2;
    const double t53 = wrist_geo_bl1*s2;
    values[28] = t35*t52 + t39*t53 - c2*t45;
    values[35] = -t48;
    const double t54 = c2*t47 - s2*t46;
    values[15] = t43*t50 + t36*t51 - (t45*t22 + c1*t54);
    values[29] = t43*t52 - t36*t53 + s2*t45;
    values[36] = -t54;
}
