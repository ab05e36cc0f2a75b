/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of orthoglide_2012.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2012.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2012_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2012_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_2012_GEO_g
#define ORTHOGLIDE_2012_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2012_GEO_d4
#define ORTHOGLIDE_2012_GEO_d4 0.31
#endif
#ifndef ORTHOGLIDE_2012_GEO_a
#define ORTHOGLIDE_2012_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2012_GEO_d6
#define ORTHOGLIDE_2012_GEO_d6 0.1
#endif

static const double orthoglide_2012_geo_g = ORTHOGLIDE_2012_GEO_g;
static const double orthoglide_2012_geo_d4 = ORTHOGLIDE_2012_GEO_d4;

/* Regressor of the base parameters.
 * 70 additions, 120 multiplications. */
void orthoglide_2012_tree_base_regressor(const double *q, const double *qd, const double *qdd,
                                         double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 636; i++)
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

    phi[159] = qdd[3];
    phi[160] = qd[3];
    phi[161] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    const double t1 = qd[6]*qd[6];
    const double t2 = s6*t1 - c6*qdd[6];
    phi[170] = t2;
    phi[171] = s6*qdd[6] + c6*t1;
    const double t3 = s6*c7;
    const double t4 = c7*qd[6];
    const double t5 = qd[7]*qd[7];
    const double t6 = t4*t4 + t5;
    const double t7 = s6*s7;
    const double t8 = s7*qd[6];
    const double t9 = t8*t4;
    const double t10 = qdd[7] + t9;
    const double t11 = qd[7]*t8;
    const double t12 = c7*qdd[6];
    const double t13 = t11 - t12 + t11;
    phi[179] = t3*t6 + t7*t10 + c6*t13;
    const double t14 = qdd[7] - t9;
    const double t15 = t8*t8 + t5;
    const double t16 = qd[7]*t4;
    const double t17 = s7*qdd[6];
    const double t18 = t17 + t16;
    const double t19 = t16 + t18;
    phi[180] = t3*t14 - t7*t15 + c6*t19;
    phi[183] = t2;
    phi[215] = qdd[4];
    phi[216] = qd[4];
    phi[217] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    const double t20 = qd[8]*qd[8];
    const double t21 = s8*t20 - c8*qdd[8];
    phi[238] = t21;
    phi[239] = s8*qdd[8] + c8*t20;
    const double t22 = s9*qd[8];
    const double t23 = c9*qd[8];
    const double t24 = t22*t23;
    const double t25 = qdd[9] - t24;
    const double t26 = qd[9]*qd[9];
    const double t27 = t22*t22 + t26;
    const double t28 = qd[9]*t23;
    const double t29 = s9*qdd[8];
    const double t30 = t29 + t28;
    const double t31 = t28 + t30;
    phi[247] = s8*c9*t25 - s8*s9*t27 + c8*t31;
    phi[250] = t21;
    const double t32 = qdd[5] - orthoglide_2012_geo_g;
    phi[271] = t32;
    phi[272] = qdd[5];
    phi[273] = qd[5];
    phi[274] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    const double t33 = qd[10]*qd[10];
    const double t34 = s10*t33 - c10*qdd[10];
    phi[305] = t34;
    phi[306] = s10*qdd[10] + c10*t33;
    const double t35 = s11*qd[10];
    const double t36 = c11*qd[10];
    const double t37 = t35*t36;
    const double t38 = qdd[11] - t37;
    const double t39 = qd[11]*qd[11];
    const double t40 = t35*t35 + t39;
    const double t41 = qd[11]*t36;
    const double t42 = s11*qdd[10];
    const double t43 = t42 + t41;
    const double t44 = t41 + t43;
    phi[314] = s10*c11*t38 - s10*s11*t40 + c10*t44;
    phi[317] = t34;
    phi[328] = qdd[6];
    const double t45 = c6*qdd[3];
    phi[329] = -t45;
    const double t46 = s6*qdd[3];
    phi[330] = t46;
    phi[331] = qd[6];
    phi[332] = (double)((qd[6] > 0.0) - (qd[6] < 0.0));
    phi[333] = s7*t18 + c7*t11;
    phi[334] = c7*t19 - s7*t13;
    phi[335] = c7*(t1 - t6) - s7*t10;
    phi[336] = -(s7*(t1 - t15) + c7*t14);
    phi[338] = -c7*t45;
    phi[339] = s7*t45;
    phi[342] = orthoglide_2012_geo_d4*c7*qdd[6] - (t45 + orthoglide_2012_geo_d4*t13);
    phi[386] = -t9;
    phi[387] = t15 - t6;
    phi[388] = -t17;
    phi[389] = -t12;
    phi[390] = qdd[7];
    phi[391] = orthoglide_2012_geo_g*c7 + s7*t46;
    phi[392] = c7*t46 - orthoglide_2012_geo_g*s7;
    phi[393] = qd[7];
    phi[394] = (double)((qd[7] > 0.0) - (qd[7] < 0.0));
    phi[395] = orthoglide_2012_geo_d4*s7*t1;
    phi[449] = qdd[8];
    const double t47 = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    phi[450] = -t47;
    const double t48 = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    phi[451] = t48;
    phi[452] = qd[8];
    phi[453] = (double)((qd[8] > 0.0) - (qd[8] < 0.0));
    const double t49 = qd[9]*t22;
    phi[454] = s9*t30 + c9*t49;
    const double t50 = c9*qdd[8];
    const double t51 = t49 - t50 + t49;
    phi[455] = c9*t31 - s9*t51;
    const double t52 = t23*t23 + t26;
    phi[456] = c9*(t20 - t52) - s9*(qdd[9] + t24);
    phi[457] = -(s9*(t20 - t27) + c9*t25);
    phi[459] = s9*t47;
    phi[462] = orthoglide_2012_geo_d4*c9*qdd[8] - (t47 + orthoglide_2012_geo_d4*t51);
    phi[507] = -t24;
    phi[508] = t27 - t52;
    phi[509] = -t29;
    phi[510] = -t50;
    phi[511] = qdd[9];
    phi[512] = c9*t48;
    phi[513] = qd[9];
    phi[514] = (double)((qd[9] > 0.0) - (qd[9] < 0.0));
    phi[515] = orthoglide_2012_geo_d4*s9*t20;
    phi[569] = qdd[10];
    const double t53 = c10*t32;
    phi[570] = -t53;
    const double t54 = s10*t32;
    phi[571] = t54;
    phi[572] = qd[10];
    phi[573] = (double)((qd[10] > 0.0) - (qd[10] < 0.0));
    const double t55 = qd[11]*t35;
    phi[574] = s11*t43 + c11*t55;
    const double t56 = c11*qdd[10];
    const double t57 = t55 - t56 + t55;
    phi[575] = c11*t44 - s11*t57;
    const double t58 = t36*t36 + t39;
    phi[576] = c11*(t33 - t58) - s11*(qdd[11] + t37);
    phi[577] = -(s11*(t33 - t40) + c11*t38);
    phi[579] = s11*t53;
    phi[582] = orthoglide_2012_geo_d4*c11*qdd[10] - (t53 + orthoglide_2012_geo_d4*t57);
    phi[627] = -t37;
    phi[628] = t40 - t58;
    phi[629] = -t42;
    phi[630] = -t56;
    phi[631] = qdd[11];
    phi[632] = c11*t54;
    phi[633] = qd[11];
    phi[634] = (double)((qd[11] > 0.0) - (qd[11] < 0.0));
    phi[635] = orthoglide_2012_geo_d4*s11*t33;
}
