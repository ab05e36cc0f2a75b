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
    MODELER_ALL_ZEROS(phi, 90);

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
    MODELER_ZEROS(phi + 0, 5);
    const double t8 = qd[1]*t7;
    const double t9 = c1*t8;
    phi[10] = s1*t6 + t9;
    const double t10 = t7*t4;
    phi[40] = -t10;
    const double t11 = c1*qdd[0];
    const double t12 = t11 - t8;
    const double t13 = t5 + t6;
    phi[11] = c1*t13 - s1*(t8 - t12);
    const double t14 = qd[1]*qd[1];
    MODELER_ZEROS(phi + 8, 2);
    const double t15 = t4*t4 + t14;
    const double t16 = t7*t7 + t14;
    phi[41] = t16 - t15;
    const double t17 = qd[0]*qd[0];
    phi[12] = s1*(qdd[1] + t10) - c1*(t17 - t15);
    phi[42] = t3;
    phi[13] = c1*t12 - t9;
    phi[43] = t10;
    const double t18 = qdd[1] - t10;
    MODELER_ZEROS(phi + 15, 1);
    phi[14] = s1*(t17 - t16) + c1*t18;
    phi[44] = t11;
    phi[45] = qdd[1];
    phi[16] = -c1*t1;
    const double t19 = s1*t2;
    phi[46] = -t19;
    phi[17] = s1*t1;
    const double t20 = c1*t2;
    phi[47] = -t20;
    phi[18] = t2;
    MODELER_ZEROS(phi + 19, 1);
    const double t21 = c2*qd[1] + s2*t7;
    const double t22 = c2*t6 - s2*qdd[1] - qd[2]*t21;
    const double t23 = s1*c2;
    const double t24 = c2*t7 - s2*qd[1];
    const double t25 = qd[2] + t4;
    const double t26 = t24*t25;
    const double t27 = s1*s2;
    const double t28 = t26*t27;
    const double t29 = t24*t21;
    const double t30 = c1*t29;
    MODELER_ZEROS(phi + 30, 8);
    phi[20] = t22*t23 - t28 + t30;
    const double t31 = c2*t26;
    phi[50] = -(s2*t22 + t31);
    phi[80] = t29;
    const double t32 = c2*qdd[1] + s2*t6 + qd[2]*t24;
    const double t33 = t32 + t26;
    const double t34 = t21*t25;
    const double t35 = t22 - t34;
    const double t36 = t25*t25;
    MODELER_ZEROS(phi + 38, 2);
    const double t37 = t21*t21 + t36;
    const double t38 = t24*t24 + t36;
    const double t39 = t37 - t38;
    phi[21] = -(t33*t23 + t35*t27 + c1*t39);
    phi[51] = s2*t33 - c2*t35;
    phi[81] = -t39;
    const double t40 = qdd[2] + t12;
    const double t41 = t40 - t29;
    const double t42 = t16 - t37;
    const double t43 = t22 + t34;
    MODELER_ZEROS(phi + 48, 2);
    phi[22] = t41*t23 + t27*t42 + c1*t43;
    phi[52] = c2*t42 - s2*t41;
    phi[82] = t43;
    const double t44 = t34*t23;
    phi[23] = t44 + t32*t27 - t30;
    const double t45 = s2*t34;
    phi[53] = c2*t32 - t45;
    phi[83] = -t29;
    const double t46 = t16 - t38;
    const double t47 = t40 + t29;
    MODELER_ZEROS(phi + 60, 8);
    const double t48 = t32 - t26;
    phi[24] = t23*t46 - t47*t27 - c1*t48;
    phi[54] = -(s2*t46 + c2*t47);
    phi[84] = -t48;
    phi[25] = t28 - t44 + c1*t40;
    phi[55] = t31 + t45;
    phi[85] = t40;
    const double t49 = t19 + wrist_geo_bl1*t16;
    const double t50 = t1 + wrist_geo_bl1*t13;
    MODELER_ZEROS(phi + 68, 8);
    const double t51 = wrist_geo_bl1*t18;
    const double t52 = t20 - t51;
    const double t53 = c2*t50 + s2*t52;
    const double t54 = wrist_geo_bl1*s1;
    const double t55 = s2*t54;
    const double t56 = c2*t54;
    phi[26] = t37*t55 - t41*t56 - (t49*t27 + c1*t53);
    const double t57 = wrist_geo_bl1*c2;
    const double t58 = wrist_geo_bl1*s2;
    phi[56] = t37*t57 + t41*t58 - c2*t49;
    MODELER_ZEROS(phi + 76, 4);
    phi[86] = -t53;
    const double t59 = c2*t52 - s2*t50;
    phi[27] = t47*t55 + t38*t56 - (t49*t23 + c1*t59);
    phi[57] = t47*t57 - t38*t58 + s2*t49;
    phi[87] = -t59;
    phi[28] = t53*t23 - t59*t27 + (t48*t55 + t43*t56);
    phi[58] = t51 - t52;
    phi[29] = t53*t56 - t59*t55;
    phi[59] = -(t59*t57 + t53*t58);
    MODELER_ZEROS(phi + 88, 2);
}
