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
static const double orthoglide_2003_geo_b3 = ORTHOGLIDE_2003_GEO_b3;
static const double orthoglide_2003_geo_b7 = ORTHOGLIDE_2003_GEO_b7;
static const double orthoglide_2003_geo_a = ORTHOGLIDE_2003_GEO_a;
static const double orthoglide_2003_geo_d6 = ORTHOGLIDE_2003_GEO_d6;

/* Joint torques, by the Newton-Euler recursion.
 * 165 additions, 226 multiplications. */
void orthoglide_2003_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                           const double *beta, double *MODELER_RESTRICT tau)
{
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

    tau[0] = qdd[0]*beta[0];
    tau[1] = (qdd[1] - orthoglide_2003_geo_g)*beta[0];
    tau[2] = qdd[2]*beta[0];
    const double t1 = qd[6]*qd[6];
    const double t2 = t1*beta[22];
    const double t3 = s7*t2;
    const double t4 = s7*qd[6];
    const double t5 = qd[7]*qd[7];
    const double t6 = c7*qd[6];
    const double t7 = t4*t6;
    const double t8 = s7*(t3 - (t4*t4 + t5)*beta[21]) + c7*(c7*t2 + (qdd[7] - t7)*beta[21]);
    const double t9 = qdd[6]*beta[22];
    const double t10 = qd[7]*t6;
    const double t11 = s7*qdd[6] + t10;
    const double t12 = c6*(t9 - (t10 + t11)*beta[21] + (qdd[6]*beta[14] - t1*beta[15]));
    const double t13 = s6*(t1*beta[14] + qdd[6]*beta[15] + t8) - t12 + qdd[3]*beta[1];
    const double t14 = qd[3]*beta[2] + t13 + (double)((qd[3] > 0.0) - (qd[3] < 0.0))*beta[3];
    tau[3] = beta[4] + t14;
    const double t15 = qd[8]*qd[8];
    const double t16 = t15*beta[32];
    const double t17 = s9*t16;
    const double t18 = s9*qd[8];
    const double t19 = qd[9]*qd[9];
    const double t20 = c9*qd[8];
    const double t21 = t18*t20;
    const double t22 = c9*(c9*t16 + (qdd[9] - t21)*beta[31]);
    const double t23 = s9*(t17 - (t18*t18 + t19)*beta[31]) + t22;
    const double t24 = qdd[8]*beta[32];
    const double t25 = qd[9]*t20;
    const double t26 = s9*qdd[8] + t25;
    const double t27 = c8*(t24 - (t25 + t26)*beta[31] + (qdd[8]*beta[24] - t15*beta[25]));
    const double t28 = s8*(t15*beta[24] + qdd[8]*beta[25] + t23) - t27 + qdd[4]*beta[5];
    const double t29 = qd[4]*beta[6] + t28 + (double)((qd[4] > 0.0) - (qd[4] < 0.0))*beta[7];
    tau[4] = beta[8] + t29;
    const double t30 = qd[10]*qd[10];
    const double t31 = t30*beta[42];
    const double t32 = s11*t31;
    const double t33 = s11*qd[10];
    const double t34 = qd[11]*qd[11];
    const double t35 = c11*qd[10];
    const double t36 = t33*t35;
    const double t37 = c11*(c11*t31 + (qdd[11] - t36)*beta[41]);
    const double t38 = s11*(t32 - (t33*t33 + t34)*beta[41]) + t37;
    const double t39 = qdd[10]*beta[42];
    const double t40 = qd[11]*t35;
    const double t41 = s11*qdd[10] + t40;
    const double t42 = c10*(t39 - (t40 + t41)*beta[41] + (qdd[10]*beta[34] - t30*beta[35]));
    const double t43 = s10*(t30*beta[34] + qdd[10]*beta[35] + t38) - t42 + qdd[5]*beta[9];
    const double t44 = qd[5]*beta[10] + t43 + (double)((qd[5] > 0.0) - (qd[5] < 0.0))*beta[11];
    tau[5] = beta[12] + t44;
    const double t45 = c6*qdd[3];
    const double t46 = qd[7]*t4;
    const double t47 = c7*qdd[6] - t46;
    const double t48 = (t45 + orthoglide_2003_geo_D41*(t46 - t47))*beta[22];
    const double t49 = t4*beta[18] + t6*beta[19] - qd[7]*beta[20];
    const double t50 = t4*beta[17] - qd[7]*beta[19];
    const double t51 = t6*t49 + qd[7]*t50 + (qdd[7]*beta[18] - (t11*beta[16] + t47*beta[17]));
    const double t52 = t4*beta[16] + t6*beta[17] - qd[7]*beta[18];
    const double t53 = qd[7]*t52 + t4*t49 + (t11*beta[17] - qdd[7]*beta[19]);
    const double t54 = c7*(c7*t48 - orthoglide_2003_geo_D41*t9 - t53);
    const double t55 = s6*qdd[3];
    const double t56 = t55*beta[15] - t45*beta[14] + qdd[6]*beta[13];
    tau[6] = t56 - (s7*(t51 - t45*beta[21] + s7*t48) + t54);
    const double t57 = orthoglide_2003_geo_g*c7 + s7*t55 + orthoglide_2003_geo_D41*(qdd[7] + t7);
    const double t58 = c7*t55 - orthoglide_2003_geo_g*s7;
    const double t59 = (c7*t57 - s7*(t58 + orthoglide_2003_geo_D41*(t6*t6 + t5)))*beta[22];
    const double t60 = t4*t50 - t6*t52 + (qdd[7]*beta[20] - (t11*beta[18] + t47*beta[19]));
    tau[7] = orthoglide_2003_geo_D41*t3 + t59 + (t60 + t58*beta[21]) - t59;
    const double t61 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    const double t62 = qd[9]*t18;
    const double t63 = c9*qdd[8] - t62;
    const double t64 = (t61 + orthoglide_2003_geo_D42*(t62 - t63))*beta[32];
    const double t65 = t18*beta[28] + t20*beta[29] - qd[9]*beta[30];
    const double t66 = t18*beta[27] - qd[9]*beta[29];
    const double t67 = t20*t65 + qd[9]*t66 + (qdd[9]*beta[28] - (t26*beta[26] + t63*beta[27]));
    const double t68 = t18*beta[26] + t20*beta[27] - qd[9]*beta[28];
    const double t69 = qd[9]*t68 + t18*t65 + (t26*beta[27] - qdd[9]*beta[29]);
    const double t70 = c9*(c9*t64 - orthoglide_2003_geo_D42*t24 - t69);
    const double t71 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    const double t72 = t71*beta[25] - t61*beta[24] + qdd[8]*beta[23];
    tau[8] = t72 - (s9*(t67 - t61*beta[31] + s9*t64) + t70);
    const double t73 = c9*t71;
    const double t74 = c9*(s9*t71 + orthoglide_2003_geo_D42*(qdd[9] + t21));
    const double t75 = (t74 - s9*(t73 + orthoglide_2003_geo_D42*(t20*t20 + t19)))*beta[32];
    const double t76 = t18*t66 - t20*t68 + (qdd[9]*beta[30] - (t26*beta[28] + t63*beta[29]));
    tau[9] = orthoglide_2003_geo_D42*t17 + t75 + (t76 + t73*beta[31]) - t75;
    const double t77 = qdd[5] - orthoglide_2003_geo_g;
    const double t78 = c10*t77;
    const double t79 = qd[11]*t33;
    const double t80 = c11*qdd[10] - t79;
    const double t81 = (t78 + orthoglide_2003_geo_D43*(t79 - t80))*beta[42];
    const double t82 = t33*beta[38] + t35*beta[39] - qd[11]*beta[40];
    const double t83 = t33*beta[37] - qd[11]*beta[39];
    const double t84 = t35*t82 + qd[11]*t83 + (qdd[11]*beta[38] - (t41*beta[36] + t80*beta[37]));
    const double t85 = t33*beta[36] + t35*beta[37] - qd[11]*beta[38];
    const double t86 = qd[11]*t85 + t33*t82 + (t41*beta[37] - qdd[11]*beta[39]);
    const double t87 = c11*(c11*t81 - orthoglide_2003_geo_D43*t39 - t86);
    const double t88 = s10*t77;
    const double t89 = t88*beta[35] - t78*beta[34] + qdd[10]*beta[33];
    tau[10] = t89 - (s11*(t84 - t78*beta[41] + s11*t81) + t87);
    const double t90 = c11*t88;
    const double t91 = c11*(s11*t88 + orthoglide_2003_geo_D43*(qdd[11] + t36));
    const double t92 = (t91 - s11*(t90 + orthoglide_2003_geo_D43*(t35*t35 + t34)))*beta[42];
    const double t93 = t33*t83 - t35*t85 + (qdd[11]*beta[40] - (t41*beta[38] + t80*beta[39]));
    tau[11] = orthoglide_2003_geo_D43*t32 + t92 + (t93 + t90*beta[41]) - t92;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 33 additions, 57 multiplications. */
void orthoglide_2003_tree_inertia_matrix(const double *q, const double *beta,
                                         double *MODELER_RESTRICT M)
{
    MODELER_ALL_ZEROS(M, 144);

    const double k1 = orthoglide_2003_geo_D43*2.0;
    const double k2 = orthoglide_2003_geo_D42*2.0;
    const double k3 = orthoglide_2003_geo_D41*2.0;

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

    M[0] = beta[0];
    M[13] = beta[0];
    M[26] = beta[0];
    MODELER_ZEROS(M + 1, 8);
    M[39] = beta[1];
    const double t1 = c7*beta[22];
    MODELER_ZEROS(M + 9, 4);
    const double t2 = s7*beta[22];
    const double t3 = beta[21] - t2;
    MODELER_ZEROS(M + 14, 8);
    const double t4 = s6*beta[15] - c6*(c7*t1 - s7*t3 + beta[14]);
    M[42] = t4;
    MODELER_ZEROS(M + 22, 4);
    const double t5 = s6*(c7*t2 + c7*t3);
    M[43] = t5;
    M[52] = beta[5];
    MODELER_ZEROS(M + 27, 8);
    const double t6 = c9*beta[32];
    const double t7 = s9*beta[32];
    MODELER_ZEROS(M + 35, 4);
    const double t8 = beta[31] - t7;
    const double t9 = s8*beta[25] - c8*(c9*t6 - s9*t8 + beta[24]);
    MODELER_ZEROS(M + 40, 2);
    M[56] = t9;
    const double t10 = s8*(c9*t7 + c9*t8);
    MODELER_ZEROS(M + 44, 8);
    M[57] = t10;
    M[65] = beta[9];
    MODELER_ZEROS(M + 53, 3);
    const double t11 = c11*beta[42];
    const double t12 = s11*beta[42];
    const double t13 = beta[41] - t12;
    MODELER_ZEROS(M + 58, 7);
    const double t14 = s10*beta[35] - c10*(c11*t11 - s11*t13 + beta[34]);
    M[70] = t14;
    MODELER_ZEROS(M + 66, 4);
    const double t15 = s10*(c11*t12 + c11*t13);
    M[71] = t15;
    MODELER_ZEROS(M + 72, 3);
    M[75] = t4;
    const double t16 = beta[17] + orthoglide_2003_geo_D41*t2;
    MODELER_ZEROS(M + 76, 2);
    M[78] = s7*(s7*beta[16] + c7*t16) + c7*(s7*t16 + k3*t1*c7) + beta[13];
    const double t17 = s7*beta[18] + c7*beta[19];
    M[79] = -t17;
    MODELER_ZEROS(M + 80, 7);
    M[87] = t5;
    M[90] = -t17;
    MODELER_ZEROS(M + 88, 2);
    M[91] = beta[20];
    M[100] = t9;
    MODELER_ZEROS(M + 92, 8);
    const double t18 = beta[27] + orthoglide_2003_geo_D42*t7;
    M[104] = s9*(s9*beta[26] + c9*t18) + c9*(s9*t18 + k2*t6*c9) + beta[23];
    MODELER_ZEROS(M + 101, 3);
    const double t19 = s9*beta[28] + c9*beta[29];
    M[105] = -t19;
    MODELER_ZEROS(M + 106, 6);
    M[112] = t10;
    M[116] = -t19;
    M[117] = beta[30];
    MODELER_ZEROS(M + 113, 3);
    M[125] = t14;
    const double t20 = beta[37] + orthoglide_2003_geo_D43*t12;
    MODELER_ZEROS(M + 118, 7);
    M[130] = s11*(s11*beta[36] + c11*t20) + c11*(s11*t20 + k1*t11*c11) + beta[33];
    const double t21 = s11*beta[38] + c11*beta[39];
    MODELER_ZEROS(M + 126, 4);
    M[131] = -t21;
    M[137] = t15;
    MODELER_ZEROS(M + 132, 5);
    M[142] = -t21;
    M[143] = beta[40];
    MODELER_ZEROS(M + 138, 4);
}

/* Torques that hold the robot still, without friction.
 * 8 additions, 27 multiplications. */
void orthoglide_2003_tree_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
    tau[6] = 0.0;

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

    tau[1] = -orthoglide_2003_geo_g*beta[0];
    tau[7] = -orthoglide_2003_geo_g*s7*beta[21];
    const double t1 = orthoglide_2003_geo_g*s8;
    const double t2 = t1*beta[32];
    const double t3 = orthoglide_2003_geo_g*c8;
    tau[8] = s9*(s9*t2 - t1*beta[31]) + c9*t2*c9 + (t1*beta[24] + t3*beta[25]);
    tau[9] = c9*t3*beta[31];
    const double t4 = orthoglide_2003_geo_g*c10;
    const double t5 = beta[42]*t4;
    const double t6 = orthoglide_2003_geo_g*s10;
    tau[10] = s11*(s11*t5 - beta[41]*t4) + c11*t5*c11 + (beta[34]*t4 - beta[35]*t6);
    tau[11] = -c11*t6*beta[41];
}

/* Torques without gravity and friction.
 * 152 additions, 220 multiplications. */
void orthoglide_2003_tree_coriolis(const double *q, const double *qd, const double *qdd,
                                   const double *beta, double *MODELER_RESTRICT tau)
{
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

    tau[0] = qdd[0]*beta[0];
    tau[1] = qdd[1]*beta[0];
    tau[2] = qdd[2]*beta[0];
    const double t1 = qd[6]*qd[6];
    const double t2 = t1*beta[22];
    const double t3 = s7*t2;
    const double t4 = s7*qd[6];
    const double t5 = qd[7]*qd[7];
    const double t6 = c7*qd[6];
    const double t7 = t4*t6;
    const double t8 = s7*(t3 - (t4*t4 + t5)*beta[21]) + c7*(c7*t2 + (qdd[7] - t7)*beta[21]);
    const double t9 = qdd[6]*beta[22];
    const double t10 = qd[7]*t6;
    const double t11 = s7*qdd[6] + t10;
    const double t12 = c6*(t9 - (t10 + t11)*beta[21] + (qdd[6]*beta[14] - t1*beta[15]));
    tau[3] = s6*(t1*beta[14] + qdd[6]*beta[15] + t8) - t12 + qdd[3]*beta[1];
    const double t13 = qd[8]*qd[8];
    const double t14 = t13*beta[32];
    const double t15 = s9*t14;
    const double t16 = s9*qd[8];
    const double t17 = qd[9]*qd[9];
    const double t18 = c9*qd[8];
    const double t19 = t16*t18;
    const double t20 = c9*(c9*t14 + (qdd[9] - t19)*beta[31]);
    const double t21 = s9*(t15 - (t16*t16 + t17)*beta[31]) + t20;
    const double t22 = qdd[8]*beta[32];
    const double t23 = qd[9]*t18;
    const double t24 = s9*qdd[8] + t23;
    const double t25 = c8*(t22 - (t23 + t24)*beta[31] + (qdd[8]*beta[24] - t13*beta[25]));
    tau[4] = s8*(t13*beta[24] + qdd[8]*beta[25] + t21) - t25 + qdd[4]*beta[5];
    const double t26 = qd[10]*qd[10];
    const double t27 = t26*beta[42];
    const double t28 = s11*t27;
    const double t29 = s11*qd[10];
    const double t30 = qd[11]*qd[11];
    const double t31 = c11*qd[10];
    const double t32 = t29*t31;
    const double t33 = c11*(c11*t27 + (qdd[11] - t32)*beta[41]);
    const double t34 = s11*(t28 - (t29*t29 + t30)*beta[41]) + t33;
    const double t35 = qdd[10]*beta[42];
    const double t36 = qd[11]*t31;
    const double t37 = s11*qdd[10] + t36;
    const double t38 = c10*(t35 - (t36 + t37)*beta[41] + (qdd[10]*beta[34] - t26*beta[35]));
    tau[5] = s10*(t26*beta[34] + qdd[10]*beta[35] + t34) - t38 + qdd[5]*beta[9];
    const double t39 = c6*qdd[3];
    const double t40 = qd[7]*t4;
    const double t41 = c7*qdd[6] - t40;
    const double t42 = (t39 + orthoglide_2003_geo_D41*(t40 - t41))*beta[22];
    const double t43 = t4*beta[18] + t6*beta[19] - qd[7]*beta[20];
    const double t44 = t4*beta[17] - qd[7]*beta[19];
    const double t45 = t6*t43 + qd[7]*t44 + (qdd[7]*beta[18] - (t11*beta[16] + t41*beta[17]));
    const double t46 = t4*beta[16] + t6*beta[17] - qd[7]*beta[18];
    const double t47 = qd[7]*t46 + t4*t43 + (t11*beta[17] - qdd[7]*beta[19]);
    const double t48 = c7*(c7*t42 - orthoglide_2003_geo_D41*t9 - t47);
    const double t49 = s6*qdd[3];
    const double t50 = t49*beta[15] - t39*beta[14] + qdd[6]*beta[13];
    tau[6] = t50 - (s7*(t45 - t39*beta[21] + s7*t42) + t48);
    const double t51 = c7*t49;
    const double t52 = c7*(s7*t49 + orthoglide_2003_geo_D41*(qdd[7] + t7));
    const double t53 = beta[22]*(t52 - s7*(t51 + orthoglide_2003_geo_D41*(t6*t6 + t5)));
    const double t54 = t4*t44 - t6*t46 + (qdd[7]*beta[20] - (t11*beta[18] + t41*beta[19]));
    tau[7] = orthoglide_2003_geo_D41*t3 + t53 + (t54 + t51*beta[21]) - t53;
    const double t55 = c8*qdd[4];
    const double t56 = qd[9]*t16;
    const double t57 = c9*qdd[8] - t56;
    const double t58 = beta[32]*(t55 + orthoglide_2003_geo_D42*(t56 - t57));
    const double t59 = t16*beta[28] + t18*beta[29] - qd[9]*beta[30];
    const double t60 = t16*beta[27] - qd[9]*beta[29];
    const double t61 = t18*t59 + qd[9]*t60 + (qdd[9]*beta[28] - (t24*beta[26] + t57*beta[27]));
    const double t62 = t16*beta[26] + t18*beta[27] - qd[9]*beta[28];
    const double t63 = qd[9]*t62 + t16*t59 + (t24*beta[27] - qdd[9]*beta[29]);
    const double t64 = c9*(orthoglide_2003_geo_D42*t22 - c9*t58 + t63);
    const double t65 = s8*qdd[4];
    const double t66 = t65*beta[25] - t55*beta[24] + qdd[8]*beta[23];
    tau[8] = t66 - (s9*(t61 - t55*beta[31] + s9*t58) - t64);
    const double t67 = orthoglide_2003_geo_g*c8 + t65;
    const double t68 = s9*(c9*t67 + orthoglide_2003_geo_D42*(t18*t18 + t17));
    const double t69 = (c9*(s9*t67 + orthoglide_2003_geo_D42*(qdd[9] + t19)) - t68)*beta[32];
    const double t70 = t16*t60 - t18*t62 + (qdd[9]*beta[30] - (t24*beta[28] + t57*beta[29]));
    tau[9] = orthoglide_2003_geo_D42*t15 + t69 + (t70 + c9*t65*beta[31]) - t69;
    const double t71 = qd[11]*t29;
    const double t72 = c11*qdd[10] - t71;
    const double t73 = c10*qdd[5];
    const double t74 = beta[42]*(orthoglide_2003_geo_D43*(t71 - t72) + t73);
    const double t75 = t29*beta[38] + t31*beta[39] - qd[11]*beta[40];
    const double t76 = t29*beta[37] - qd[11]*beta[39];
    const double t77 = t31*t75 + qd[11]*t76 + (qdd[11]*beta[38] - (t37*beta[36] + t72*beta[37]));
    const double t78 = t29*beta[36] + t31*beta[37] - qd[11]*beta[38];
    const double t79 = qd[11]*t78 + t29*t75 + (t37*beta[37] - qdd[11]*beta[39]);
    const double t80 = c11*(orthoglide_2003_geo_D43*t35 - c11*t74 + t79);
    const double t81 = s10*qdd[5];
    const double t82 = beta[35]*t81 - beta[34]*t73 + qdd[10]*beta[33];
    tau[10] = t82 - (s11*(t77 - beta[41]*t73 + s11*t74) - t80);
    const double t83 = s10*(qdd[5] - orthoglide_2003_geo_g);
    const double t84 = c11*(s11*t83 + orthoglide_2003_geo_D43*(qdd[11] + t32));
    const double t85 = (t84 - s11*(c11*t83 + orthoglide_2003_geo_D43*(t31*t31 + t30)))*beta[42];
    const double t86 = t29*t76 - t31*t78 + (qdd[11]*beta[40] - (t37*beta[38] + t72*beta[39]));
    tau[11] = orthoglide_2003_geo_D43*t28 + t85 + (t86 + c11*t81*beta[41]) - t85;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 6 additions, 6 multiplications. */
void orthoglide_2003_tree_friction(const double *qd, const double *beta,
                                   double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[6] = 0.0;
    tau[7] = 0.0;
    tau[8] = 0.0;
    tau[9] = 0.0;
    tau[10] = 0.0;
    tau[11] = 0.0;

    tau[3] = qd[3]*beta[2] + (double)((qd[3] > 0.0) - (qd[3] < 0.0))*beta[3] + beta[4];
    tau[4] = qd[4]*beta[6] + (double)((qd[4] > 0.0) - (qd[4] < 0.0))*beta[7] + beta[8];
    const double t1 = qd[5]*beta[10] + (double)((qd[5] > 0.0) - (qd[5] < 0.0))*beta[11];
    tau[5] = beta[12] + t1;
}

/* Poses of the frames of all moving rows of the table, in order.
 * 9 additions, 21 multiplications. */
void orthoglide_2003_tree_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    MODELER_ALL_ZEROS(T, 252);

    const double k1 = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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

    T[2] = 1.0;
    T[3] = q[0];
    T[4] = 1.0;
    MODELER_ZEROS(T + 0, 2);
    T[9] = 1.0;
    T[13] = 1.0;
    T[15] = q[0];
    MODELER_ZEROS(T + 5, 4);
    T[18] = 1.0;
    T[19] = q[1];
    T[20] = 1.0;
    MODELER_ZEROS(T + 10, 3);
    T[24] = 1.0;
    T[27] = q[0];
    T[29] = 1.0;
    MODELER_ZEROS(T + 14, 1);
    T[31] = q[1];
    T[34] = 1.0;
    T[35] = q[2];
    MODELER_ZEROS(T + 16, 2);
    T[36] = 1.0;
    T[41] = 1.0;
    T[46] = 1.0;
    MODELER_ZEROS(T + 21, 3);
    T[47] = q[3];
    T[50] = 1.0;
    const double t1 = orthoglide_2003_geo_a - q[4];
    MODELER_ZEROS(T + 25, 2);
    T[51] = -t1;
    T[52] = 1.0;
    T[57] = 1.0;
    MODELER_ZEROS(T + 28, 1);
    T[59] = orthoglide_2003_geo_a;
    T[61] = 1.0;
    MODELER_ZEROS(T + 30, 1);
    T[66] = 1.0;
    const double t2 = orthoglide_2003_geo_a - q[5];
    T[67] = -t2;
    MODELER_ZEROS(T + 32, 2);
    T[68] = 1.0;
    T[71] = orthoglide_2003_geo_a;
    T[72] = c6;
    MODELER_ZEROS(T + 37, 4);
    T[73] = -s6;
    T[78] = 1.0;
    T[80] = -s6;
    MODELER_ZEROS(T + 42, 4);
    T[81] = -c6;
    T[83] = q[3];
    const double t3 = c6*c7;
    MODELER_ZEROS(T + 48, 2);
    T[84] = t3;
    const double t4 = c6*s7;
    T[85] = -t4;
    MODELER_ZEROS(T + 53, 4);
    T[86] = -s6;
    T[88] = -s7;
    T[89] = -c7;
    MODELER_ZEROS(T + 58, 1);
    T[91] = orthoglide_2003_geo_b3;
    const double t5 = s6*c7;
    T[92] = -t5;
    MODELER_ZEROS(T + 60, 1);
    const double t6 = s6*s7;
    T[93] = t6;
    T[94] = -c6;
    MODELER_ZEROS(T + 62, 4);
    T[95] = q[3];
    T[96] = c6;
    MODELER_ZEROS(T + 69, 2);
    T[98] = -s6;
    const double t7 = orthoglide_2003_geo_D41*t3;
    T[99] = t7;
    MODELER_ZEROS(T + 74, 4);
    T[101] = -1.0;
    const double t8 = orthoglide_2003_geo_b3 - orthoglide_2003_geo_D41*s7;
    T[103] = t8;
    MODELER_ZEROS(T + 79, 1);
    T[104] = -s6;
    T[106] = -c6;
    const double t9 = q[3] - orthoglide_2003_geo_D41*t5;
    MODELER_ZEROS(T + 82, 1);
    T[107] = t9;
    T[109] = 1.0;
    T[111] = t7;
    MODELER_ZEROS(T + 87, 1);
    T[114] = 1.0;
    T[115] = t8;
    T[116] = 1.0;
    MODELER_ZEROS(T + 90, 1);
    T[119] = t9;
    T[120] = t3;
    T[121] = -t4;
    MODELER_ZEROS(T + 97, 1);
    T[122] = -s6;
    T[124] = -s7;
    T[125] = -c7;
    MODELER_ZEROS(T + 100, 1);
    T[127] = orthoglide_2003_geo_b7;
    T[128] = -t5;
    T[129] = t6;
    MODELER_ZEROS(T + 102, 1);
    T[130] = -c6;
    T[131] = q[3];
    MODELER_ZEROS(T + 105, 1);
    T[132] = -s8;
    T[133] = -c8;
    T[135] = -t1;
    MODELER_ZEROS(T + 108, 1);
    T[136] = c8;
    T[137] = -s8;
    T[142] = 1.0;
    MODELER_ZEROS(T + 110, 1);
    T[143] = orthoglide_2003_geo_a;
    const double t10 = s8*c9;
    T[144] = -t10;
    MODELER_ZEROS(T + 112, 2);
    const double t11 = s8*s9;
    T[145] = t11;
    T[146] = -c8;
    MODELER_ZEROS(T + 117, 2);
    T[147] = -t1;
    const double t12 = c8*c9;
    T[148] = t12;
    MODELER_ZEROS(T + 123, 1);
    const double t13 = c8*s9;
    T[149] = -t13;
    T[150] = -s8;
    MODELER_ZEROS(T + 126, 1);
    T[152] = -s9;
    T[153] = -c9;
    T[155] = k1;
    MODELER_ZEROS(T + 134, 1);
    T[156] = -s8;
    T[158] = -c8;
    MODELER_ZEROS(T + 138, 4);
    const double t14 = t1 + orthoglide_2003_geo_D42*t10;
    T[159] = -t14;
    T[160] = c8;
    MODELER_ZEROS(T + 151, 1);
    T[162] = -s8;
    const double t15 = orthoglide_2003_geo_D42*t12;
    T[163] = t15;
    MODELER_ZEROS(T + 154, 1);
    T[165] = -1.0;
    const double t16 = k1 - orthoglide_2003_geo_D42*s9;
    T[167] = t16;
    MODELER_ZEROS(T + 157, 1);
    T[168] = 1.0;
    T[171] = -t14;
    T[173] = 1.0;
    MODELER_ZEROS(T + 161, 1);
    T[175] = t15;
    T[178] = 1.0;
    T[179] = t16;
    MODELER_ZEROS(T + 164, 1);
    T[180] = -t10;
    T[181] = t11;
    T[182] = -c8;
    MODELER_ZEROS(T + 166, 1);
    T[183] = -t1;
    T[184] = t12;
    T[185] = -t13;
    MODELER_ZEROS(T + 169, 2);
    T[186] = -s8;
    T[188] = -s9;
    T[189] = -c9;
    MODELER_ZEROS(T + 172, 1);
    T[191] = orthoglide_2003_geo_a + orthoglide_2003_geo_b7;
    T[194] = 1.0;
    MODELER_ZEROS(T + 174, 1);
    T[196] = -s10;
    T[197] = -c10;
    T[199] = -t2;
    MODELER_ZEROS(T + 176, 2);
    T[200] = c10;
    T[201] = -s10;
    T[203] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 187, 1);
    T[204] = -s11;
    T[205] = -c11;
    T[207] = orthoglide_2003_geo_b3;
    MODELER_ZEROS(T + 190, 1);
    const double t17 = s10*c11;
    T[208] = -t17;
    const double t18 = s10*s11;
    MODELER_ZEROS(T + 192, 2);
    T[209] = t18;
    T[210] = -c10;
    T[211] = -t2;
    MODELER_ZEROS(T + 195, 1);
    const double t19 = c10*c11;
    T[212] = t19;
    const double t20 = c10*s11;
    MODELER_ZEROS(T + 198, 1);
    T[213] = -t20;
    T[214] = -s10;
    T[215] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 202, 1);
    T[217] = -1.0;
    const double t21 = orthoglide_2003_geo_b3 - orthoglide_2003_geo_D43*s11;
    T[219] = t21;
    MODELER_ZEROS(T + 206, 1);
    T[220] = -s10;
    T[222] = -c10;
    MODELER_ZEROS(T + 216, 1);
    const double t22 = t2 + orthoglide_2003_geo_D43*t17;
    T[223] = -t22;
    T[224] = c10;
    MODELER_ZEROS(T + 218, 1);
    T[226] = -s10;
    const double t23 = orthoglide_2003_geo_a + orthoglide_2003_geo_D43*t19;
    T[227] = t23;
    MODELER_ZEROS(T + 221, 1);
    T[230] = 1.0;
    T[231] = t21;
    T[232] = 1.0;
    MODELER_ZEROS(T + 225, 1);
    T[235] = -t22;
    T[237] = 1.0;
    T[239] = t23;
    MODELER_ZEROS(T + 228, 2);
    T[240] = -s11;
    T[241] = -c11;
    T[243] = orthoglide_2003_geo_b7;
    MODELER_ZEROS(T + 233, 2);
    T[244] = -t17;
    T[245] = t18;
    T[246] = -c10;
    MODELER_ZEROS(T + 236, 1);
    T[247] = -t2;
    T[248] = t19;
    T[249] = -t20;
    MODELER_ZEROS(T + 238, 1);
    T[250] = -s10;
    T[251] = orthoglide_2003_geo_a;
    MODELER_ZEROS(T + 242, 1);
}

/* Closure equations f(u) and their derivatives by u.
 * 20 additions, 30 multiplications. */
void orthoglide_2003_tree_closure(const double *q, double *MODELER_RESTRICT values)
{
    MODELER_ALL_ZEROS(values, 117);

    const double k1 = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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

    const double t1 = c6*c7*orthoglide_2003_geo_D41;
    values[0] = t1 - q[0];
    values[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    MODELER_ZEROS(values + 10, 5);
    const double t2 = s6*c7*orthoglide_2003_geo_D41;
    values[2] = q[3] - t2 + orthoglide_2003_geo_d6 - q[2];
    MODELER_ZEROS(values + 17, 5);
    const double t3 = s8*c9*orthoglide_2003_geo_D42;
    values[3] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[4] + t3) - q[0];
    MODELER_ZEROS(values + 23, 5);
    const double t4 = c8*c9*orthoglide_2003_geo_D42;
    values[4] = t4 - q[1];
    MODELER_ZEROS(values + 29, 6);
    values[5] = -(orthoglide_2003_geo_D42*s9 - k1 + orthoglide_2003_geo_b3 + q[2]);
    values[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    MODELER_ZEROS(values + 37, 2);
    const double t5 = s10*c11*orthoglide_2003_geo_D43;
    values[7] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[5] + t5) - q[1];
    MODELER_ZEROS(values + 41, 4);
    const double t6 = c10*c11*orthoglide_2003_geo_D43;
    values[8] = orthoglide_2003_geo_a + t6 - q[2];
    MODELER_ZEROS(values + 46, 3);
    values[9] = -1.0;
    values[15] = -t2;
    MODELER_ZEROS(values + 50, 3);
    values[16] = -c6*s7*orthoglide_2003_geo_D41;
    values[22] = -1.0;
    MODELER_ZEROS(values + 55, 3);
    values[28] = -orthoglide_2003_geo_D41*c7;
    values[35] = -1.0;
    MODELER_ZEROS(values + 59, 6);
    values[36] = 1.0;
    values[39] = -t1;
    values[40] = s6*s7*orthoglide_2003_geo_D41;
    MODELER_ZEROS(values + 67, 4);
    values[45] = -1.0;
    values[49] = 1.0;
    MODELER_ZEROS(values + 72, 6);
    values[53] = -t4;
    values[54] = s8*s9*orthoglide_2003_geo_D42;
    MODELER_ZEROS(values + 79, 2);
    values[58] = -1.0;
    values[65] = -t3;
    MODELER_ZEROS(values + 82, 8);
    values[66] = -c8*s9*orthoglide_2003_geo_D42;
    values[71] = -1.0;
    MODELER_ZEROS(values + 90, 2);
    values[78] = -orthoglide_2003_geo_D42*c9;
    values[81] = -1.0;
    MODELER_ZEROS(values + 93, 1);
    values[92] = -orthoglide_2003_geo_D43*c11;
    values[94] = -1.0;
    MODELER_ZEROS(values + 95, 3);
    values[98] = 1.0;
    values[103] = -t6;
    MODELER_ZEROS(values + 99, 4);
    values[104] = s10*s11*orthoglide_2003_geo_D43;
    values[107] = -1.0;
    MODELER_ZEROS(values + 105, 2);
    values[115] = -t5;
    values[116] = -c10*s11*orthoglide_2003_geo_D43;
    MODELER_ZEROS(values + 108, 7);
}

/* All equations of all loops, then cosines that are positive.
 * 20 additions, 15 multiplications. */
void orthoglide_2003_tree_residual(const double *q, double *MODELER_RESTRICT values)
{
    const double k1 = orthoglide_2003_geo_a + orthoglide_2003_geo_b3;

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

    values[0] = c6*c7*orthoglide_2003_geo_D41 - q[0];
    values[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    values[2] = q[3] - s6*c7*orthoglide_2003_geo_D41 + orthoglide_2003_geo_d6 - q[2];
    const double t1 = orthoglide_2003_geo_a - q[4] + s8*c9*orthoglide_2003_geo_D42;
    values[3] = orthoglide_2003_geo_d6 - t1 - q[0];
    values[4] = c8*c9*orthoglide_2003_geo_D42 - q[1];
    values[5] = -(orthoglide_2003_geo_D42*s9 - k1 + orthoglide_2003_geo_b3 + q[2]);
    values[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    const double t2 = orthoglide_2003_geo_a - q[5] + s10*c11*orthoglide_2003_geo_D43;
    values[7] = orthoglide_2003_geo_d6 - t2 - q[1];
    values[8] = orthoglide_2003_geo_a + c10*c11*orthoglide_2003_geo_D43 - q[2];
}

/* d/dt(df/du) ud.
 * 18 additions, 66 multiplications. */
void orthoglide_2003_tree_drift(const double *q, const double *qd, double *MODELER_RESTRICT values)
{
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

    const double t1 = c6*qd[6];
    const double t2 = s7*qd[7];
    const double t3 = s6*qd[6];
    const double t4 = c7*qd[7];
    const double t5 = orthoglide_2003_geo_D41*(c7*t1 - s6*t2)*qd[6];
    values[0] = orthoglide_2003_geo_D41*(s7*t3 - c6*t4)*qd[7] - t5;
    values[1] = orthoglide_2003_geo_D41*t2*qd[7];
    const double t6 = orthoglide_2003_geo_D41*(c7*t3 + c6*t2)*qd[6];
    values[2] = t6 + orthoglide_2003_geo_D41*(s7*t1 + s6*t4)*qd[7];
    const double t7 = s8*qd[8];
    const double t8 = s9*qd[9];
    const double t9 = c8*qd[8];
    const double t10 = c9*qd[9];
    const double t11 = orthoglide_2003_geo_D42*(s9*t9 + s8*t10)*qd[9];
    values[3] = orthoglide_2003_geo_D42*(c9*t7 + c8*t8)*qd[8] + t11;
    const double t12 = orthoglide_2003_geo_D42*(s9*t7 - c8*t10)*qd[9];
    values[4] = t12 - orthoglide_2003_geo_D42*(c9*t9 - s8*t8)*qd[8];
    values[5] = orthoglide_2003_geo_D42*t8*qd[9];
    const double t13 = s11*qd[11];
    values[6] = orthoglide_2003_geo_D43*t13*qd[11];
    const double t14 = s10*qd[10];
    const double t15 = c10*qd[10];
    const double t16 = c11*qd[11];
    const double t17 = orthoglide_2003_geo_D43*(c11*t14 + c10*t13)*qd[10];
    values[7] = t17 + orthoglide_2003_geo_D43*(s11*t15 + s10*t16)*qd[11];
    const double t18 = orthoglide_2003_geo_D43*(c11*t15 - s10*t13)*qd[10];
    values[8] = orthoglide_2003_geo_D43*(s11*t14 - c10*t16)*qd[11] - t18;
}

/* Base parameters from standard ones: the grouping relations.
 * 96 additions, 21 multiplications. */
void orthoglide_2003_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = 1.0/orthoglide_2003_geo_D41;
    const double k2 = 1.0/orthoglide_2003_geo_D42;
    const double k3 = 1.0/orthoglide_2003_geo_D43;
    const double k4 = orthoglide_2003_geo_g*k3;

    const double t1 = k1*chi[59];
    const double t2 = k1*chi[79];
    const double t3 = k2*chi[99];
    const double t4 = k2*chi[119];
    const double t5 = k3*chi[139];
    const double t6 = k3*chi[159];
    beta[0] = chi[0] + t1 + chi[72] + t2 + t3 + chi[112] + t4 + t5 + chi[152] + t6;
    beta[1] = chi[10] + chi[11] + chi[52] - t1 + chi[62] - t2 + chi[82];
    beta[2] = chi[12];
    beta[3] = chi[13];
    beta[4] = chi[14];
    beta[5] = chi[24] + chi[25] + chi[92] - t3 + chi[102] - t4 + chi[122];
    beta[6] = chi[26];
    beta[7] = chi[27];
    beta[8] = chi[28];
    beta[9] = chi[38] + chi[39] + chi[132] - t5 + chi[142] - t6 + chi[162];
    beta[10] = chi[40];
    beta[11] = chi[41];
    const double t7 = chi[42] - orthoglide_2003_geo_g*chi[38] - orthoglide_2003_geo_g*chi[132];
    const double t8 = t7 + k4*chi[139] - orthoglide_2003_geo_g*chi[142] + k4*chi[159];
    beta[12] = t8 - orthoglide_2003_geo_g*chi[162];
    const double t9 = orthoglide_2003_geo_D41*chi[59];
    const double t10 = orthoglide_2003_geo_D41*chi[79];
    beta[13] = chi[48] + chi[56] - t9 + chi[66] + chi[76] - t10;
    beta[14] = chi[49];
    beta[15] = chi[50] + chi[61] + chi[71] + chi[81];
    beta[16] = chi[53] - chi[56] + t9 + chi[73] - chi[76] + t10;
    beta[17] = chi[54] + chi[74];
    beta[18] = chi[55] - orthoglide_2003_geo_D41*chi[71] + chi[75];
    beta[19] = chi[57] + chi[77];
    beta[20] = chi[58] - t9 + chi[78] - t10;
    beta[21] = chi[60] + chi[80];
    beta[22] = chi[69];
    const double t11 = orthoglide_2003_geo_D42*chi[99];
    const double t12 = orthoglide_2003_geo_D42*chi[119];
    beta[23] = chi[88] + chi[96] - t11 + chi[106] + chi[116] - t12;
    beta[24] = chi[89];
    beta[25] = chi[90] + chi[101] + chi[111] + chi[121];
    beta[26] = chi[93] - chi[96] + t11 + chi[113] - chi[116] + t12;
    beta[27] = chi[94] + chi[114];
    beta[28] = chi[95] - orthoglide_2003_geo_D42*chi[111] + chi[115];
    beta[29] = chi[97] + chi[117];
    beta[30] = chi[98] - t11 + chi[118] - t12;
    beta[31] = chi[100] + chi[120];
    beta[32] = chi[109];
    const double t13 = orthoglide_2003_geo_D43*chi[139];
    const double t14 = orthoglide_2003_geo_D43*chi[159];
    beta[33] = chi[128] + chi[136] - t13 + chi[146] + chi[156] - t14;
    beta[34] = chi[129];
    beta[35] = chi[130] + chi[141] + chi[151] + chi[161];
    beta[36] = chi[133] - chi[136] + t13 + chi[153] - chi[156] + t14;
    beta[37] = chi[134] + chi[154];
    beta[38] = chi[135] - orthoglide_2003_geo_D43*chi[151] + chi[155];
    beta[39] = chi[137] + chi[157];
    beta[40] = chi[138] - t13 + chi[158] - t14;
    beta[41] = chi[140] + chi[160];
    beta[42] = chi[149];
}
