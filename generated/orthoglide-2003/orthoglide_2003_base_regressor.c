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
    MODELER_ALL_ZEROS(phi, 516);

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
    MODELER_ZEROS(phi + 1, 8);
    phi[86] = qdd[2];
    phi[130] = qdd[3];
    MODELER_ZEROS(phi + 9, 8);
    phi[131] = qd[3];
    phi[132] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    MODELER_ZEROS(phi + 17, 8);
    phi[133] = 1.0;
    phi[177] = qdd[4];
    MODELER_ZEROS(phi + 25, 8);
    phi[178] = qd[4];
    phi[179] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    MODELER_ZEROS(phi + 33, 8);
    phi[180] = 1.0;
    phi[224] = qdd[5];
    MODELER_ZEROS(phi + 41, 2);
    phi[225] = qd[5];
    phi[226] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    MODELER_ZEROS(phi + 44, 8);
    phi[227] = 1.0;
    phi[271] = qdd[6];
    MODELER_ZEROS(phi + 52, 8);
    const double t1 = qd[6]*qd[6];
    const double t2 = s6*t1 - c6*qdd[6];
    MODELER_ZEROS(phi + 60, 8);
    phi[143] = t2;
    const double t3 = c6*qdd[3];
    MODELER_ZEROS(phi + 68, 8);
    phi[272] = -t3;
    phi[144] = s6*qdd[6] + c6*t1;
    MODELER_ZEROS(phi + 76, 8);
    const double t4 = s6*qdd[3];
    phi[273] = t4;
    MODELER_ZEROS(phi + 84, 2);
    const double t5 = s7*qdd[6];
    const double t6 = c7*qd[6];
    MODELER_ZEROS(phi + 87, 8);
    const double t7 = qd[7]*t6;
    const double t8 = t5 + t7;
    MODELER_ZEROS(phi + 95, 8);
    const double t9 = s7*qd[6];
    const double t10 = qd[7]*t9;
    MODELER_ZEROS(phi + 103, 8);
    phi[274] = s7*t8 + c7*t10;
    const double t11 = t9*t6;
    MODELER_ZEROS(phi + 111, 8);
    phi[317] = -t11;
    MODELER_ZEROS(phi + 119, 8);
    const double t12 = c7*qdd[6];
    const double t13 = t10 - t12 + t10;
    MODELER_ZEROS(phi + 127, 3);
    const double t14 = t7 + t8;
    phi[275] = c7*t14 - s7*t13;
    MODELER_ZEROS(phi + 134, 8);
    const double t15 = qd[7]*qd[7];
    const double t16 = t6*t6 + t15;
    MODELER_ZEROS(phi + 142, 1);
    const double t17 = t9*t9 + t15;
    phi[318] = t17 - t16;
    MODELER_ZEROS(phi + 145, 5);
    phi[276] = c7*(t1 - t16) - s7*(qdd[7] + t11);
    phi[319] = -t5;
    MODELER_ZEROS(phi + 152, 8);
    const double t18 = qdd[7] - t11;
    phi[277] = -(s7*(t1 - t17) + c7*t18);
    MODELER_ZEROS(phi + 160, 8);
    phi[320] = -t12;
    phi[321] = qdd[7];
    MODELER_ZEROS(phi + 168, 8);
    phi[150] = s6*c7*t18 - s6*s7*t17 + c6*t14;
    phi[279] = s7*t3;
    MODELER_ZEROS(phi + 176, 1);
    phi[322] = c7*t4 - orthoglide_2003_geo_g*s7;
    phi[151] = t2;
    MODELER_ZEROS(phi + 181, 8);
    phi[280] = orthoglide_2003_geo_D41*c7*qdd[6] - (t3 + orthoglide_2003_geo_D41*t13);
    phi[323] = orthoglide_2003_geo_D41*s7*t1;
    MODELER_ZEROS(phi + 189, 7);
    phi[367] = qdd[8];
    const double t19 = qd[8]*qd[8];
    MODELER_ZEROS(phi + 198, 5);
    const double t20 = s8*t19 - c8*qdd[8];
    phi[196] = t20;
    MODELER_ZEROS(phi + 205, 8);
    const double t21 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    phi[368] = -t21;
    MODELER_ZEROS(phi + 213, 8);
    phi[197] = s8*qdd[8] + c8*t19;
    const double t22 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    MODELER_ZEROS(phi + 221, 3);
    phi[369] = t22;
    const double t23 = s9*qdd[8];
    MODELER_ZEROS(phi + 228, 8);
    const double t24 = c9*qd[8];
    const double t25 = qd[9]*t24;
    MODELER_ZEROS(phi + 236, 8);
    const double t26 = t23 + t25;
    MODELER_ZEROS(phi + 244, 5);
    const double t27 = s9*qd[8];
    const double t28 = qd[9]*t27;
    MODELER_ZEROS(phi + 251, 5);
    phi[370] = s9*t26 + c9*t28;
    const double t29 = t27*t24;
    MODELER_ZEROS(phi + 258, 8);
    phi[413] = -t29;
    const double t30 = c9*qdd[8];
    MODELER_ZEROS(phi + 266, 5);
    const double t31 = t28 - t30 + t28;
    const double t32 = t25 + t26;
    MODELER_ZEROS(phi + 278, 1);
    phi[371] = c9*t32 - s9*t31;
    const double t33 = qd[9]*qd[9];
    MODELER_ZEROS(phi + 281, 8);
    const double t34 = t24*t24 + t33;
    const double t35 = t27*t27 + t33;
    MODELER_ZEROS(phi + 289, 8);
    phi[414] = t35 - t34;
    phi[372] = c9*(t19 - t34) - s9*(qdd[9] + t29);
    MODELER_ZEROS(phi + 297, 8);
    phi[415] = -t23;
    const double t36 = qdd[9] - t29;
    MODELER_ZEROS(phi + 305, 8);
    phi[373] = -(s9*(t19 - t35) + c9*t36);
    phi[416] = -t30;
    MODELER_ZEROS(phi + 313, 4);
    phi[417] = qdd[9];
    phi[203] = s8*c9*t36 - s8*s9*t35 + c8*t32;
    MODELER_ZEROS(phi + 324, 8);
    phi[375] = s9*t21;
    phi[418] = c9*t22;
    MODELER_ZEROS(phi + 332, 8);
    phi[204] = t20;
    phi[376] = orthoglide_2003_geo_D42*c9*qdd[8] - (t21 + orthoglide_2003_geo_D42*t31);
    MODELER_ZEROS(phi + 340, 8);
    phi[419] = orthoglide_2003_geo_D42*s9*t19;
    phi[463] = qdd[10];
    MODELER_ZEROS(phi + 348, 8);
    const double t37 = qd[10]*qd[10];
    const double t38 = s10*t37 - c10*qdd[10];
    MODELER_ZEROS(phi + 356, 8);
    phi[249] = t38;
    const double t39 = qdd[5] - orthoglide_2003_geo_g;
    MODELER_ZEROS(phi + 364, 3);
    const double t40 = c10*t39;
    phi[464] = -t40;
    MODELER_ZEROS(phi + 374, 1);
    phi[250] = s10*qdd[10] + c10*t37;
    MODELER_ZEROS(phi + 377, 8);
    const double t41 = s10*t39;
    phi[465] = t41;
    MODELER_ZEROS(phi + 385, 8);
    const double t42 = s11*qdd[10];
    const double t43 = c11*qd[10];
    MODELER_ZEROS(phi + 393, 8);
    const double t44 = qd[11]*t43;
    const double t45 = t42 + t44;
    MODELER_ZEROS(phi + 401, 8);
    const double t46 = s11*qd[10];
    const double t47 = qd[11]*t46;
    MODELER_ZEROS(phi + 409, 4);
    phi[466] = s11*t45 + c11*t47;
    const double t48 = t46*t43;
    MODELER_ZEROS(phi + 420, 8);
    phi[509] = -t48;
    const double t49 = c11*qdd[10];
    MODELER_ZEROS(phi + 428, 8);
    const double t50 = t47 - t49 + t47;
    const double t51 = t44 + t45;
    MODELER_ZEROS(phi + 436, 8);
    phi[467] = c11*t51 - s11*t50;
    const double t52 = qd[11]*qd[11];
    MODELER_ZEROS(phi + 444, 8);
    const double t53 = t43*t43 + t52;
    const double t54 = t46*t46 + t52;
    MODELER_ZEROS(phi + 452, 8);
    phi[510] = t54 - t53;
    phi[468] = c11*(t37 - t53) - s11*(qdd[11] + t48);
    MODELER_ZEROS(phi + 460, 3);
    phi[511] = -t42;
    const double t55 = qdd[11] - t48;
    MODELER_ZEROS(phi + 470, 1);
    phi[469] = -(s11*(t37 - t54) + c11*t55);
    phi[512] = -t49;
    MODELER_ZEROS(phi + 473, 8);
    phi[513] = qdd[11];
    phi[256] = s10*c11*t55 - s10*s11*t54 + c10*t51;
    MODELER_ZEROS(phi + 481, 8);
    phi[471] = s11*t40;
    phi[514] = c11*t41;
    MODELER_ZEROS(phi + 489, 8);
    phi[257] = t38;
    phi[472] = orthoglide_2003_geo_D43*c11*qdd[10] - (t40 + orthoglide_2003_geo_D43*t50);
    MODELER_ZEROS(phi + 497, 8);
    phi[515] = orthoglide_2003_geo_D43*s11*t37;
    MODELER_ZEROS(phi + 505, 4);
}
