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

/* Regressor of the standard parameters.
 * 74 additions, 103 multiplications. */
void wrist_regressor(const double *q, const double *qd, const double *qdd,
                     double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 90; i++)
        phi[i] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    phi[5] = qdd[0];
    const double t1 = wrist_geo_g*s0;
    phi[6] = -t1;
    const double t2 = wrist_geo_g*c0;
    phi[7] = -t2;
    const double t3 = s1*qdd[0];
    const double t4 = c1*qd[0];
    const double t5 = qd[1]*t4;
    const double t6 = t3 + t5;
    const double t7 = s1*qd[0];
    const double t8 = qd[1]*t7;
    const double t9 = c1*t8;
    phi[10] = s1*t6 + t9;
    const double t10 = c1*qdd[0];
    const double t11 = t10 - t8;
    const double t12 = t5 + t6;
    phi[11] = c1*t12 - s1*(t8 - t11);
    const double t13 = t7*t4;
    const double t14 = qd[0]*qd[0];
    const double t15 = qd[1]*qd[1];
    const double t16 = t4*t4 + t15;
    phi[12] = s1*(qdd[1] + t13) - c1*(t14 - t16);
    phi[13] = c1*t11 - t9;
    const double t17 = t7*t7 + t15;
    const double t18 = qdd[1] - t13;
    phi[14] = s1*(t14 - t17) + c1*t18;
    phi[16] = -c1*t1;
    phi[17] = s1*t1;
    phi[18] = t2;
    const double t19 = c2*qd[1] + s2*t7;
    const double t20 = c2*t6 - s2*qdd[1] - qd[2]*t19;
    const double t21 = s1*c2;
    const double t22 = c2*t7 - s2*qd[1];
    const double t23 = qd[2] + t4;
    const double t24 = t22*t23;
    const double t25 = s1*s2;
    const double t26 = t24*t25;
    const double t27 = t22*t19;
    const double t28 = c1*t27;
    phi[20] = t20*t21 - t26 + t28;
    const double t29 = c2*qdd[1] + s2*t6 + qd[2]*t22;
    const double t30 = t29 + t24;
    const double t31 = t19*t23;
    const double t32 = t20 - t31;
    const double t33 = t23*t23;
    const double t34 = t19*t19 + t33;
    const double t35 = t22*t22 + t33;
    const double t36 = t34 - t35;
    phi[21] = -(t30*t21 + t32*t25 + c1*t36);
    const double t37 = qdd[2] + t11;
    const double t38 = t37 - t27;
    const double t39 = t17 - t34;
    const double t40 = t20 + t31;
    phi[22] = t38*t21 + t25*t39 + c1*t40;
    const double t41 = t31*t21;
    phi[23] = t41 + t29*t25 - t28;
    const double t42 = t17 - t35;
    const double t43 = t37 + t27;
    const double t44 = t29 - t24;
    phi[24] = t21*t42 - t43*t25 - c1*t44;
    phi[25] = t26 - t41 + c1*t37;
    const double t45 = s1*t2;
    const double t46 = t45 + wrist_geo_bl1*t17;
    const double t47 = t1 + wrist_geo_bl1*t12;
    const double t48 = c1*t2;
    const double t49 = wrist_geo_bl1*t18;
    const double t50 = t48 - t49;
    const double t51 = c2*t47 + s2*t50;
    const double t52 = wrist_geo_bl1*s1;
    const double t53 = s2*t52;
    const double t54 = c2*t52;
    phi[26] = t34*t53 - t38*t54 - (t46*t25 + c1*t51);
    const double t55 = c2*t50 - s2*t47;
    phi[27] = t43*t53 + t35*t54 - (t46*t21 + c1*t55);
    phi[28] = t51*t21 - t55*t25 + (t44*t53 + t40*t54);
    phi[29] = t51*t54 - t55*t53;
    phi[40] = -t13;
    phi[41] = t17 - t16;
    phi[42] = t3;
    phi[43] = t13;
    phi[44] = t10;
    phi[45] = qdd[1];
    phi[46] = -t45;
    phi[47] = -t48;
    const double t56 = c2*t24;
    phi[50] = -(s2*t20 + t56);
    phi[51] = s2*t30 - c2*t32;
    phi[52] = c2*t39 - s2*t38;
    const double t57 = s2*t31;
    phi[53] = c2*t29 - t57;
    phi[54] = -(s2*t42 + c2*t43);
    phi[55] = t56 + t57;
    const double t58 = wrist_geo_bl1*c2;
    const double t59 = wrist_geo_bl1*s2;
    phi[56] = t34*t58 + t38*t59 - c2*t46;
    phi[57] = t43*t58 - t35*t59 + s2*t46;
    phi[58] = t49 - t50;
    phi[59] = -(t55*t58 + t51*t59);
    phi[80] = t27;
    phi[81] = -t36;
    phi[82] = t40;
    phi[83] = -t27;
    phi[84] = -t44;
    phi[85] = t37;
    phi[86] = -t51;
    phi[87] = -t55;
}
