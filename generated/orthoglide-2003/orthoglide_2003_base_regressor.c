/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2003.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2003_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2003_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_2003_GEO_g
#define ORTHOGLIDE_2003_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2003_GEO_D41
#define ORTHOGLIDE_2003_GEO_D41 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D42
#define ORTHOGLIDE_2003_GEO_D42 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D43
#define ORTHOGLIDE_2003_GEO_D43 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_b3
#define ORTHOGLIDE_2003_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_2003_GEO_b7
#define ORTHOGLIDE_2003_GEO_b7 0.04
#endif
#ifndef ORTHOGLIDE_2003_GEO_a
#define ORTHOGLIDE_2003_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2003_GEO_d6
#define ORTHOGLIDE_2003_GEO_d6 0.1
#endif

static const double orthoglide_2003_geo_g = ORTHOGLIDE_2003_GEO_g;
static const double orthoglide_2003_geo_D41 = ORTHOGLIDE_2003_GEO_D41;
static const double orthoglide_2003_geo_D42 = ORTHOGLIDE_2003_GEO_D42;
static const double orthoglide_2003_geo_D43 = ORTHOGLIDE_2003_GEO_D43;

/* Regressor of the base parameters.
 * 68 additions, 114 multiplications. */
void orthoglide_2003_tree_base_regressor(const double *q, const double *qd, const double *qdd,
                                         double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 516; i++)
        phi[i] = 0.0;

    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s10, c10;
    modeler_sincos(q[10], &s10, &c10);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);

    phi[0] = qdd[0];
    phi[43] = qdd[1] - orthoglide_2003_geo_g;
    phi[86] = qdd[2];
    phi[130] = qdd[3];
    phi[131] = qd[3];
    phi[132] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    phi[133] = 1.0;
    const double t1 = qd[6]*qd[6];
    const double t2 = s6*t1 - c6*qdd[6];
    phi[143] = t2;
    phi[144] = s6*qdd[6] + c6*t1;
    const double t3 = s7*qd[6];
    const double t4 = c7*qd[6];
    const double t5 = t3*t4;
    const double t6 = qdd[7] - t5;
    const double t7 = qd[7]*qd[7];
    const double t8 = t3*t3 + t7;
    const double t9 = qd[7]*t4;
    const double t10 = s7*qdd[6];
    const double t11 = t10 + t9;
    const double t12 = t9 + t11;
    phi[150] = s6*c7*t6 - s6*s7*t8 + c6*t12;
    phi[151] = t2;
    phi[177] = qdd[4];
    phi[178] = qd[4];
    phi[179] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    phi[180] = 1.0;
    const double t13 = qd[8]*qd[8];
    const double t14 = s8*t13 - c8*qdd[8];
    phi[196] = t14;
    phi[197] = s8*qdd[8] + c8*t13;
    const double t15 = s9*qd[8];
    const double t16 = c9*qd[8];
    const double t17 = t15*t16;
    const double t18 = qdd[9] - t17;
    const double t19 = qd[9]*qd[9];
    const double t20 = t15*t15 + t19;
    const double t21 = qd[9]*t16;
    const double t22 = s9*qdd[8];
    const double t23 = t22 + t21;
    const double t24 = t21 + t23;
    phi[203] = s8*c9*t18 - s8*s9*t20 + c8*t24;
    phi[204] = t14;
    phi[224] = qdd[5];
    phi[225] = qd[5];
    phi[226] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    phi[227] = 1.0;
    const double t25 = qd[10]*qd[10];
    const double t26 = s10*t25 - c10*qdd[10];
    phi[249] = t26;
    phi[250] = s10*qdd[10] + c10*t25;
    const double t27 = s11*qd[10];
    const double t28 = c11*qd[10];
    const double t29 = t27*t28;
    const double t30 = qdd[11] - t29;
    const double t31 = qd[11]*qd[11];
    const double t32 = t27*t27 + t31;
    const double t33 = qd[11]*t28;
    const double t34 = s11*qdd[10];
    const double t35 = t34 + t33;
    const double t36 = t33 + t35;
    phi[256] = s10*c11*t30 - s10*s11*t32 + c10*t36;
    phi[257] = t26;
    phi[271] = qdd[6];
    const double t37 = c6*qdd[3];
    phi[272] = -t37;
    const double t38 = s6*qdd[3];
    phi[273] = t38;
    const double t39 = qd[7]*t3;
    phi[274] = s7*t11 + c7*t39;
    const double t40 = c7*qdd[6];
    const double t41 = t39 - t40 + t39;
    phi[275] = c7*t12 - s7*t41;
    const double t42 = t4*t4 + t7;
    phi[276] = c7*(t1 - t42) - s7*(qdd[7] + t5);
    phi[277] = -(s7*(t1 - t8) + c7*t6);
    phi[279] = s7*t37;
    phi[280] = orthoglide_2003_geo_D41*c7*qdd[6] - (t37 + orthoglide_2003_geo_D41*t41);
    phi[317] = -t5;
    phi[318] = t8 - t42;
    phi[319] = -t10;
    phi[320] = -t40;
    phi[321] = qdd[7];
    phi[322] = c7*t38 - orthoglide_2003_geo_g*s7;
    phi[323] = orthoglide_2003_geo_D41*s7*t1;
    phi[367] = qdd[8];
    const double t43 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    phi[368] = -t43;
    const double t44 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    phi[369] = t44;
    const double t45 = qd[9]*t15;
    phi[370] = s9*t23 + c9*t45;
    const double t46 = c9*qdd[8];
    const double t47 = t45 - t46 + t45;
    phi[371] = c9*t24 - s9*t47;
    const double t48 = t16*t16 + t19;
    phi[372] = c9*(t13 - t48) - s9*(qdd[9] + t17);
    phi[373] = -(s9*(t13 - t20) + c9*t18);
    phi[375] = s9*t43;
    phi[376] = orthoglide_2003_geo_D42*c9*qdd[8] - (t43 + orthoglide_2003_geo_D42*t47);
    phi[413] = -t17;
    phi[414] = t20 - t48;
    phi[415] = -t22;
    phi[416] = -t46;
    phi[417] = qdd[9];
    phi[418] = c9*t44;
    phi[419] = orthoglide_2003_geo_D42*s9*t13;
    phi[463] = qdd[10];
    const double t49 = qdd[5] - orthoglide_2003_geo_g;
    const double t50 = c10*t49;
    phi[464] = -t50;
    const double t51 = s10*t49;
    phi[465] = t51;
    const double t52 = qd[11]*t27;
    phi[466] = s11*t35 + c11*t52;
    const double t53 = c11*qdd[10];
    const double t54 = t52 - t53 + t52;
    phi[467] = c11*t36 - s11*t54;
    const double t55 = t28*t28 + t31;
    phi[468] = c11*(t25 - t55) - s11*(qdd[11] + t29);
    phi[469] = -(s11*(t25 - t32) + c11*t30);
    phi[471] = s11*t50;
    phi[472] = orthoglide_2003_geo_D43*c11*qdd[10] - (t50 + orthoglide_2003_geo_D43*t54);
    phi[509] = -t29;
    phi[510] = t32 - t55;
    phi[511] = -t34;
    phi[512] = -t53;
    phi[513] = qdd[11];
    phi[514] = c11*t51;
    phi[515] = orthoglide_2003_geo_D43*s11*t25;
}
