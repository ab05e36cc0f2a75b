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
    MODELER_ALL_ZEROS(phi, 636);

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
    MODELER_ZEROS(phi + 0, 8);
    phi[161] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    phi[215] = qdd[4];
    MODELER_ZEROS(phi + 8, 8);
    phi[216] = qd[4];
    phi[217] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    MODELER_ZEROS(phi + 16, 8);
    const double t1 = qdd[5] - orthoglide_2012_geo_g;
    phi[271] = t1;
    MODELER_ZEROS(phi + 24, 8);
    phi[272] = qdd[5];
    MODELER_ZEROS(phi + 32, 8);
    phi[273] = qd[5];
    phi[274] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    MODELER_ZEROS(phi + 40, 8);
    phi[328] = qdd[6];
    const double t2 = qd[6]*qd[6];
    MODELER_ZEROS(phi + 48, 8);
    const double t3 = s6*t2 - c6*qdd[6];
    phi[170] = t3;
    MODELER_ZEROS(phi + 56, 8);
    const double t4 = c6*qdd[3];
    MODELER_ZEROS(phi + 64, 8);
    phi[329] = -t4;
    phi[171] = s6*qdd[6] + c6*t2;
    MODELER_ZEROS(phi + 72, 8);
    const double t5 = s6*qdd[3];
    phi[330] = t5;
    MODELER_ZEROS(phi + 80, 8);
    phi[331] = qd[6];
    phi[332] = (double)((qd[6] > 0.0) - (qd[6] < 0.0));
    MODELER_ZEROS(phi + 88, 8);
    const double t6 = s7*qdd[6];
    MODELER_ZEROS(phi + 96, 8);
    const double t7 = c7*qd[6];
    const double t8 = qd[7]*t7;
    MODELER_ZEROS(phi + 104, 8);
    const double t9 = t6 + t8;
    const double t10 = s7*qd[6];
    MODELER_ZEROS(phi + 112, 8);
    const double t11 = qd[7]*t10;
    phi[333] = s7*t9 + c7*t11;
    MODELER_ZEROS(phi + 120, 8);
    const double t12 = t10*t7;
    phi[386] = -t12;
    MODELER_ZEROS(phi + 128, 8);
    const double t13 = c7*qdd[6];
    MODELER_ZEROS(phi + 136, 8);
    const double t14 = t11 - t13 + t11;
    const double t15 = t8 + t9;
    MODELER_ZEROS(phi + 144, 8);
    phi[334] = c7*t15 - s7*t14;
    const double t16 = qd[7]*qd[7];
    MODELER_ZEROS(phi + 152, 7);
    const double t17 = t7*t7 + t16;
    const double t18 = t10*t10 + t16;
    MODELER_ZEROS(phi + 162, 8);
    phi[387] = t18 - t17;
    MODELER_ZEROS(phi + 172, 7);
    const double t19 = qdd[7] + t12;
    phi[335] = c7*(t2 - t17) - s7*t19;
    MODELER_ZEROS(phi + 181, 2);
    phi[388] = -t6;
    const double t20 = qdd[7] - t12;
    MODELER_ZEROS(phi + 184, 8);
    phi[336] = -(s7*(t2 - t18) + c7*t20);
    phi[389] = -t13;
    MODELER_ZEROS(phi + 192, 8);
    phi[390] = qdd[7];
    MODELER_ZEROS(phi + 200, 8);
    const double t21 = s6*c7;
    const double t22 = s6*s7;
    MODELER_ZEROS(phi + 208, 7);
    phi[179] = t21*t17 + t22*t19 + c6*t14;
    phi[338] = -c7*t4;
    MODELER_ZEROS(phi + 218, 8);
    phi[391] = orthoglide_2012_geo_g*c7 + s7*t5;
    phi[180] = t21*t20 - t22*t18 + c6*t15;
    MODELER_ZEROS(phi + 226, 8);
    phi[339] = s7*t4;
    MODELER_ZEROS(phi + 234, 4);
    phi[392] = c7*t5 - orthoglide_2012_geo_g*s7;
    phi[393] = qd[7];
    MODELER_ZEROS(phi + 240, 7);
    phi[394] = (double)((qd[7] > 0.0) - (qd[7] < 0.0));
    phi[183] = t3;
    MODELER_ZEROS(phi + 248, 2);
    phi[342] = orthoglide_2012_geo_d4*c7*qdd[6] - (t4 + orthoglide_2012_geo_d4*t14);
    phi[395] = orthoglide_2012_geo_d4*s7*t2;
    MODELER_ZEROS(phi + 251, 8);
    phi[449] = qdd[8];
    const double t23 = qd[8]*qd[8];
    MODELER_ZEROS(phi + 259, 8);
    const double t24 = s8*t23 - c8*qdd[8];
    MODELER_ZEROS(phi + 267, 4);
    phi[238] = t24;
    const double t25 = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    MODELER_ZEROS(phi + 275, 8);
    phi[450] = -t25;
    phi[239] = s8*qdd[8] + c8*t23;
    MODELER_ZEROS(phi + 283, 8);
    const double t26 = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    phi[451] = t26;
    MODELER_ZEROS(phi + 291, 8);
    phi[452] = qd[8];
    MODELER_ZEROS(phi + 299, 6);
    phi[453] = (double)((qd[8] > 0.0) - (qd[8] < 0.0));
    const double t27 = s9*qdd[8];
    MODELER_ZEROS(phi + 307, 7);
    const double t28 = c9*qd[8];
    const double t29 = qd[9]*t28;
    MODELER_ZEROS(phi + 315, 2);
    const double t30 = t27 + t29;
    const double t31 = s9*qd[8];
    MODELER_ZEROS(phi + 318, 8);
    const double t32 = qd[9]*t31;
    MODELER_ZEROS(phi + 326, 2);
    phi[454] = s9*t30 + c9*t32;
    const double t33 = t31*t28;
    MODELER_ZEROS(phi + 337, 1);
    phi[507] = -t33;
    const double t34 = c9*qdd[8];
    MODELER_ZEROS(phi + 340, 2);
    const double t35 = t32 - t34 + t32;
    const double t36 = t29 + t30;
    MODELER_ZEROS(phi + 343, 8);
    phi[455] = c9*t36 - s9*t35;
    MODELER_ZEROS(phi + 351, 8);
    const double t37 = qd[9]*qd[9];
    const double t38 = t28*t28 + t37;
    MODELER_ZEROS(phi + 359, 8);
    const double t39 = t31*t31 + t37;
    phi[508] = t39 - t38;
    MODELER_ZEROS(phi + 367, 8);
    phi[456] = c9*(t23 - t38) - s9*(qdd[9] + t33);
    phi[509] = -t27;
    MODELER_ZEROS(phi + 375, 8);
    const double t40 = qdd[9] - t33;
    phi[457] = -(s9*(t23 - t39) + c9*t40);
    MODELER_ZEROS(phi + 383, 3);
    phi[510] = -t34;
    MODELER_ZEROS(phi + 396, 8);
    phi[511] = qdd[9];
    phi[247] = s8*c9*t40 - s8*s9*t39 + c8*t36;
    MODELER_ZEROS(phi + 404, 8);
    phi[459] = s9*t25;
    phi[512] = c9*t26;
    MODELER_ZEROS(phi + 412, 8);
    phi[513] = qd[9];
    phi[514] = (double)((qd[9] > 0.0) - (qd[9] < 0.0));
    MODELER_ZEROS(phi + 420, 8);
    phi[250] = t24;
    MODELER_ZEROS(phi + 428, 8);
    phi[462] = orthoglide_2012_geo_d4*c9*qdd[8] - (t25 + orthoglide_2012_geo_d4*t35);
    phi[515] = orthoglide_2012_geo_d4*s9*t23;
    MODELER_ZEROS(phi + 436, 8);
    phi[569] = qdd[10];
    const double t41 = qd[10]*qd[10];
    MODELER_ZEROS(phi + 444, 5);
    const double t42 = s10*t41 - c10*qdd[10];
    phi[305] = t42;
    MODELER_ZEROS(phi + 458, 1);
    const double t43 = c10*t1;
    MODELER_ZEROS(phi + 460, 2);
    phi[570] = -t43;
    phi[306] = s10*qdd[10] + c10*t41;
    MODELER_ZEROS(phi + 463, 8);
    const double t44 = s10*t1;
    phi[571] = t44;
    MODELER_ZEROS(phi + 471, 8);
    phi[572] = qd[10];
    phi[573] = (double)((qd[10] > 0.0) - (qd[10] < 0.0));
    MODELER_ZEROS(phi + 479, 8);
    const double t45 = s11*qdd[10];
    MODELER_ZEROS(phi + 487, 8);
    const double t46 = c11*qd[10];
    const double t47 = qd[11]*t46;
    MODELER_ZEROS(phi + 495, 8);
    const double t48 = t45 + t47;
    const double t49 = s11*qd[10];
    MODELER_ZEROS(phi + 503, 4);
    const double t50 = qd[11]*t49;
    phi[574] = s11*t48 + c11*t50;
    MODELER_ZEROS(phi + 516, 8);
    const double t51 = t49*t46;
    phi[627] = -t51;
    MODELER_ZEROS(phi + 524, 8);
    const double t52 = c11*qdd[10];
    MODELER_ZEROS(phi + 532, 8);
    const double t53 = t50 - t52 + t50;
    const double t54 = t47 + t48;
    MODELER_ZEROS(phi + 540, 8);
    phi[575] = c11*t54 - s11*t53;
    const double t55 = qd[11]*qd[11];
    MODELER_ZEROS(phi + 548, 8);
    const double t56 = t46*t46 + t55;
    const double t57 = t49*t49 + t55;
    MODELER_ZEROS(phi + 556, 8);
    phi[628] = t57 - t56;
    MODELER_ZEROS(phi + 564, 5);
    phi[576] = c11*(t41 - t56) - s11*(qdd[11] + t51);
    phi[629] = -t45;
    MODELER_ZEROS(phi + 578, 1);
    const double t58 = qdd[11] - t51;
    phi[577] = -(s11*(t41 - t57) + c11*t58);
    MODELER_ZEROS(phi + 580, 2);
    phi[630] = -t52;
    phi[631] = qdd[11];
    MODELER_ZEROS(phi + 583, 8);
    phi[314] = s10*c11*t58 - s10*s11*t57 + c10*t54;
    MODELER_ZEROS(phi + 591, 8);
    phi[579] = s11*t43;
    phi[632] = c11*t44;
    MODELER_ZEROS(phi + 599, 8);
    phi[633] = qd[11];
    phi[634] = (double)((qd[11] > 0.0) - (qd[11] < 0.0));
    MODELER_ZEROS(phi + 607, 8);
    phi[317] = t42;
    phi[582] = orthoglide_2012_geo_d4*c11*qdd[10] - (t43 + orthoglide_2012_geo_d4*t53);
    MODELER_ZEROS(phi + 615, 8);
    phi[635] = orthoglide_2012_geo_d4*s11*t41;
    MODELER_ZEROS(phi + 623, 4);
}
