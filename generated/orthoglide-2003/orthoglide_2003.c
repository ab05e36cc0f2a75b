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
    tau[3] = qd[3]*beta[2] + t13 + modeler_sign(qd[3])*beta[3] + beta[4];
    const double t14 = qd[8]*qd[8];
    const double t15 = t14*beta[32];
    const double t16 = s9*t15;
    const double t17 = s9*qd[8];
    const double t18 = qd[9]*qd[9];
    const double t19 = c9*qd[8];
    const double t20 = t17*t19;
    const double t21 = c9*(c9*t15 + (qdd[9] - t20)*beta[31]);
    const double t22 = s9*(t16 - (t17*t17 + t18)*beta[31]) + t21;
    const double t23 = qdd[8]*beta[32];
    const double t24 = qd[9]*t19;
    const double t25 = s9*qdd[8] + t24;
    const double t26 = c8*(t23 - (t24 + t25)*beta[31] + (qdd[8]*beta[24] - t14*beta[25]));
    const double t27 = s8*(t14*beta[24] + qdd[8]*beta[25] + t22) - t26 + qdd[4]*beta[5];
    tau[4] = qd[4]*beta[6] + t27 + modeler_sign(qd[4])*beta[7] + beta[8];
    const double t28 = qd[10]*qd[10];
    const double t29 = t28*beta[42];
    const double t30 = s11*t29;
    const double t31 = s11*qd[10];
    const double t32 = qd[11]*qd[11];
    const double t33 = c11*qd[10];
    const double t34 = t31*t33;
    const double t35 = c11*(c11*t29 + (qdd[11] - t34)*beta[41]);
    const double t36 = s11*(t30 - (t31*t31 + t32)*beta[41]) + t35;
    const double t37 = qdd[10]*beta[42];
    const double t38 = qd[11]*t33;
    const double t39 = s11*qdd[10] + t38;
    const double t40 = c10*(t37 - (t38 + t39)*beta[41] + (qdd[10]*beta[34] - t28*beta[35]));
    const double t41 = s10*(t28*beta[34] + qdd[10]*beta[35] + t36) - t40 + qdd[5]*beta[9];
    tau[5] = qd[5]*beta[10] + t41 + modeler_sign(qd[5])*beta[11] + beta[12];
    const double t42 = c6*qdd[3];
    const double t43 = qd[7]*t4;
    const double t44 = c7*qdd[6] - t43;
    const double t45 = (t42 + orthoglide_2003_geo_D41*(t43 - t44))*beta[22];
    const double t46 = t4*beta[18] + t6*beta[19] - qd[7]*beta[20];
    const double t47 = t4*beta[17] - qd[7]*beta[19];
    const double t48 = t6*t46 + qd[7]*t47 + (qdd[7]*beta[18] - (t11*beta[16] + t44*beta[17]));
    const double t49 = t4*beta[16] + t6*beta[17] - qd[7]*beta[18];
    const double t50 = qd[7]*t49 + t4*t46 + (t11*beta[17] - qdd[7]*beta[19]);
    const double t51 = c7*(c7*t45 - orthoglide_2003_geo_D41*t9 - t50);
    const double t52 = s6*qdd[3];
    const double t53 = t52*beta[15] - t42*beta[14] + qdd[6]*beta[13];
    tau[6] = t53 - (s7*(t48 - t42*beta[21] + s7*t45) + t51);
    const double t54 = orthoglide_2003_geo_g*c7 + s7*t52 + orthoglide_2003_geo_D41*(qdd[7] + t7);
    const double t55 = c7*t52 - orthoglide_2003_geo_g*s7;
    const double t56 = (c7*t54 - s7*(t55 + orthoglide_2003_geo_D41*(t6*t6 + t5)))*beta[22];
    const double t57 = t4*t47 - t6*t49 + (qdd[7]*beta[20] - (t11*beta[18] + t44*beta[19]));
    tau[7] = orthoglide_2003_geo_D41*t3 + t56 + (t57 + t55*beta[21]) - t56;
    const double t58 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    const double t59 = qd[9]*t17;
    const double t60 = c9*qdd[8] - t59;
    const double t61 = (t58 + orthoglide_2003_geo_D42*(t59 - t60))*beta[32];
    const double t62 = t17*beta[28] + t19*beta[29] - qd[9]*beta[30];
    const double t63 = t17*beta[27] - qd[9]*beta[29];
    const double t64 = t19*t62 + qd[9]*t63 + (qdd[9]*beta[28] - (t25*beta[26] + t60*beta[27]));
    const double t65 = t17*beta[26] + t19*beta[27] - qd[9]*beta[28];
    const double t66 = qd[9]*t65 + t17*t62 + (t25*beta[27] - qdd[9]*beta[29]);
    const double t67 = c9*(c9*t61 - orthoglide_2003_geo_D42*t23 - t66);
    const double t68 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    const double t69 = t68*beta[25] - t58*beta[24] + qdd[8]*beta[23];
    tau[8] = t69 - (s9*(t64 - t58*beta[31] + s9*t61) + t67);
    const double t70 = c9*t68;
    const double t71 = c9*(s9*t68 + orthoglide_2003_geo_D42*(qdd[9] + t20));
    const double t72 = (t71 - s9*(t70 + orthoglide_2003_geo_D42*(t19*t19 + t18)))*beta[32];
    const double t73 = t17*t63 - t19*t65 + (qdd[9]*beta[30] - (t25*beta[28] + t60*beta[29]));
    tau[9] = orthoglide_2003_geo_D42*t16 + t72 + (t73 + t70*beta[31]) - t72;
    const double t74 = qdd[5] - orthoglide_2003_geo_g;
    const double t75 = c10*t74;
    const double t76 = qd[11]*t31;
    const double t77 = c11*qdd[10] - t76;
    const double t78 = (t75 + orthoglide_2003_geo_D43*(t76 - t77))*beta[42];
    const double t79 = t31*beta[38] + t33*beta[39] - qd[11]*beta[40];
    const double t80 = t31*beta[37] - qd[11]*beta[39];
    const double t81 = t33*t79 + qd[11]*t80 + (qdd[11]*beta[38] - (t39*beta[36] + t77*beta[37]));
    const double t82 = t31*beta[36] + t33*beta[37] - qd[11]*beta[38];
    const double t83 = qd[11]*t82 + t31*t79 + (t39*beta[37] - qdd[11]*beta[39]);
    const double t84 = c11*(c11*t78 - orthoglide_2003_geo_D43*t37 - t83);
    const double t85 = s10*t74;
    const double t86 = t85*beta[35] - t75*beta[34] + qdd[10]*beta[33];
    tau[10] = t86 - (s11*(t81 - t75*beta[41] + s11*t78) + t84);
    const double t87 = c11*t85;
    const double t88 = c11*(s11*t85 + orthoglide_2003_geo_D43*(qdd[11] + t34));
    const double t89 = (t88 - s11*(t87 + orthoglide_2003_geo_D43*(t33*t33 + t32)))*beta[42];
    const double t90 = t31*t80 - t33*t82 + (qdd[11]*beta[40] - (t39*beta[38] + t77*beta[39]));
    tau[11] = orthoglide_2003_geo_D43*t30 + t89 + (t90 + t87*beta[41]) - t89;
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

    tau[3] = qd[3]*beta[2] + modeler_sign(qd[3])*beta[3] + beta[4];
    tau[4] = qd[4]*beta[6] + modeler_sign(qd[4])*beta[7] + beta[8];
    tau[5] = qd[5]*beta[10] + modeler_sign(qd[5])*beta[11] + beta[12];
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

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 20 additions, 30 multiplications. */
void orthoglide_2003_tree_closure(const double *q, double *MODELER_RESTRICT values)
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

    const double t1 = c6*c7*orthoglide_2003_geo_D41;
    values[0] = t1 - q[0];
    values[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    const double t2 = s6*c7*orthoglide_2003_geo_D41;
    values[2] = q[3] - t2 + orthoglide_2003_geo_d6 - q[2];
    const double t3 = s8*c9*orthoglide_2003_geo_D42;
    values[3] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[4] + t3) - q[0];
    const double t4 = c8*c9*orthoglide_2003_geo_D42;
    values[4] = t4 - q[1];
    values[5] = -(orthoglide_2003_geo_D42*s9 - k1 + orthoglide_2003_geo_b3 + q[2]);
    values[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    const double t5 = s10*c11*orthoglide_2003_geo_D43;
    values[7] = orthoglide_2003_geo_d6 - (orthoglide_2003_geo_a - q[5] + t5) - q[1];
    const double t6 = c10*c11*orthoglide_2003_geo_D43;
    values[8] = orthoglide_2003_geo_a + t6 - q[2];
    values[9] = -1.0;
    values[10] = -t2;
    values[11] = -c6*s7*orthoglide_2003_geo_D41;
    values[12] = -1.0;
    values[13] = -orthoglide_2003_geo_D41*c7;
    values[14] = -1.0;
    values[15] = 1.0;
    values[16] = -t1;
    values[17] = s6*s7*orthoglide_2003_geo_D41;
    values[18] = -1.0;
    values[19] = 1.0;
    values[20] = -t4;
    values[21] = s8*s9*orthoglide_2003_geo_D42;
    values[22] = -1.0;
    values[23] = -t3;
    values[24] = -c8*s9*orthoglide_2003_geo_D42;
    values[25] = -1.0;
    values[26] = -orthoglide_2003_geo_D42*c9;
    values[27] = -1.0;
    values[28] = -orthoglide_2003_geo_D43*c11;
    values[29] = -1.0;
    values[30] = 1.0;
    values[31] = -t6;
    values[32] = s10*s11*orthoglide_2003_geo_D43;
    values[33] = -1.0;
    values[34] = -t5;
    values[35] = -c10*s11*orthoglide_2003_geo_D43;
    values[36] = c6;
    values[37] = s6;
    values[38] = c7;
    values[39] = s7;
    values[40] = c8;
    values[41] = s8;
    values[42] = c9;
    values[43] = s9;
    values[44] = c10;
    values[45] = s10;
    values[46] = c11;
    values[47] = s11;
}

/* The independent equations.
 * 20 additions, 15 multiplications. */
void orthoglide_2003_tree_residual(const double *q, double *MODELER_RESTRICT f)
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

    f[0] = c6*c7*orthoglide_2003_geo_D41 - q[0];
    f[1] = -(q[1] + orthoglide_2003_geo_D41*s7);
    f[2] = q[3] - s6*c7*orthoglide_2003_geo_D41 + orthoglide_2003_geo_d6 - q[2];
    const double t1 = orthoglide_2003_geo_a - q[4] + s8*c9*orthoglide_2003_geo_D42;
    f[3] = orthoglide_2003_geo_d6 - t1 - q[0];
    f[4] = c8*c9*orthoglide_2003_geo_D42 - q[1];
    f[5] = -(orthoglide_2003_geo_D42*s9 - k1 + orthoglide_2003_geo_b3 + q[2]);
    f[6] = -(q[0] + orthoglide_2003_geo_D43*s11);
    const double t2 = orthoglide_2003_geo_a - q[5] + s10*c11*orthoglide_2003_geo_D43;
    f[7] = orthoglide_2003_geo_d6 - t2 - q[1];
    f[8] = orthoglide_2003_geo_a + c10*c11*orthoglide_2003_geo_D43 - q[2];
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 8 additions, 22 multiplications. */
void orthoglide_2003_tree_factor(const double *J, double *MODELER_RESTRICT lu)
{
    const double t1 = 1.0/J[1];
    lu[0] = t1;
    const double t2 = 1.0/J[4];
    lu[1] = t2;
    const double t3 = 1.0/J[14];
    lu[2] = t3;
    const double t4 = 1.0/J[17];
    lu[3] = t4;
    lu[4] = -1.0;
    const double t5 = 1.0/J[25];
    lu[5] = t5;
    lu[6] = -1.0;
    const double t6 = J[11]*t3;
    const double t7 = (J[12] - J[15]*t6)*t4;
    const double t8 = J[7]*t1;
    const double t9 = J[19]*t8;
    const double t10 = 1.0/(J[19] - t7*t9);
    lu[7] = -t10;
    const double t11 = (J[8] - J[2]*t8)*t2;
    const double t12 = J[22]*t5;
    const double t13 = t6 + t11*t7;
    const double t14 = (J[23] - J[26]*t12 + t9*t12)*t10;
    lu[8] = -1.0/(1.0 - t11*t12 - t13*t14);
    lu[9] = J[2];
    lu[10] = t8;
    lu[11] = t11;
    lu[12] = J[15];
    lu[13] = t6;
    lu[14] = t7;
    lu[15] = J[19];
    lu[16] = -t8;
    lu[17] = J[26];
    lu[18] = t12;
    lu[19] = t11;
    lu[20] = t9;
    lu[21] = -t7;
    lu[22] = -t12;
    lu[23] = t13;
    lu[24] = -t14;
}

/* Solution with the factors.
 * 22 additions, 25 multiplications. */
void orthoglide_2003_tree_solve(const double *lu, const double *right, double *MODELER_RESTRICT x)
{
    const double t1 = right[2] - lu[10]*right[0] - lu[11]*right[1] - lu[16]*right[6];
    const double t2 = lu[14]*right[5] - (right[3] - lu[13]*right[4]) + right[6] + lu[21]*t1;
    const double t3 = lu[8]*(right[7] - lu[18]*right[8] - lu[22]*t1 + lu[24]*t2);
    const double t4 = lu[7]*(t2 + lu[23]*t3);
    const double t5 = lu[4]*(right[6] + lu[15]*t4);
    x[0] = t5;
    x[1] = t3;
    const double t6 = lu[6]*(t1 - lu[19]*t3 + lu[20]*t4);
    x[2] = t6;
    const double t7 = lu[1]*(right[1] + t3);
    x[3] = lu[0]*(right[0] + t5 - lu[9]*t7);
    x[4] = t7;
    const double t8 = lu[3]*(right[5] + t6);
    x[5] = lu[2]*(right[4] + t3 - lu[12]*t8);
    x[6] = t8;
    x[7] = lu[5]*(right[8] + t6 + lu[17]*t4);
    x[8] = -t4;
}

/* G from the factors.
 * 16 additions, 48 multiplications. */
void orthoglide_2003_tree_coupling(const double *J, const double *lu, double *MODELER_RESTRICT G)
{
    (void)J;

    const double t1 = lu[8]*(lu[22] - lu[21]*lu[24]);
    const double t2 = lu[7]*(lu[21] - lu[23]*t1);
    const double t3 = lu[15]*t2*lu[4];
    G[0] = -t3;
    G[1] = t1;
    const double t4 = lu[6]*(1.0 + lu[19]*t1 + lu[20]*t2);
    G[2] = -t4;
    const double t5 = lu[1]*t1;
    G[3] = -lu[0]*(t3 + lu[9]*t5);
    G[4] = t5;
    const double t6 = lu[3]*t4;
    G[5] = lu[2]*(t1 + lu[12]*t6);
    G[6] = -t6;
    G[7] = -lu[5]*(t4 + lu[17]*t2);
    G[8] = t2;
    const double t7 = lu[8]*lu[24];
    const double t8 = lu[7]*(1.0 + lu[23]*t7);
    const double t9 = lu[15]*t8*lu[4];
    G[9] = t9;
    G[10] = t7;
    const double t10 = lu[6]*(lu[19]*t7 - lu[20]*t8);
    G[11] = -t10;
    const double t11 = lu[1]*t7;
    G[12] = lu[0]*(t9 - lu[9]*t11);
    G[13] = t11;
    const double t12 = lu[3]*t10;
    G[14] = lu[2]*(t7 + lu[12]*t12);
    G[15] = -t12;
    G[16] = -lu[5]*(t10 - lu[17]*t8);
    G[17] = -t8;
    const double t13 = lu[8]*lu[23]*lu[7];
    const double t14 = lu[15]*t13*lu[4];
    G[18] = -t14;
    G[19] = -lu[8];
    const double t15 = lu[6]*(lu[8]*lu[19] - lu[20]*t13);
    G[20] = t15;
    const double t16 = lu[1]*lu[8];
    G[21] = -lu[0]*(t14 - lu[9]*t16);
    G[22] = -t16;
    const double t17 = lu[3]*t15;
    G[23] = -lu[2]*(lu[8] + lu[12]*t17);
    G[24] = t17;
    G[25] = lu[5]*(t15 - lu[17]*t13);
    G[26] = t13;
}

/* Bounds of the rows of J^-1 (K - J).
 * 43 additions, 32 multiplications. */
void orthoglide_2003_tree_turned(const double *J, const double *K, const double *lu,
                                 double *MODELER_RESTRICT x)
{
    const double k1 = fabs(1.0);

    const double t1 = fabs(J[19] - K[19]);
    const double t2 = fabs(J[14] - K[14]) + fabs(J[15] - K[15]);
    const double t3 = fabs(J[17] - K[17]);
    const double t4 = fabs(J[11] - K[11]) + fabs(J[12] - K[12]) + t2*fabs(lu[13]);
    const double t5 = fabs(J[1] - K[1]) + fabs(J[2] - K[2]);
    const double t6 = fabs(J[4] - K[4]);
    const double t7 = fabs(J[7] - K[7]) + fabs(J[8] - K[8]) + t5*fabs(lu[10]) + t6*fabs(lu[11]);
    const double t8 = t7 + t1*fabs(lu[16]);
    const double t9 = t4 + t3*fabs(lu[14]) + k1*t1 + t8*fabs(lu[21]);
    const double t10 = fabs(J[25] - K[25]) + fabs(J[26] - K[26]);
    const double t11 = fabs(J[22] - K[22]) + fabs(J[23] - K[23]) + t10*fabs(lu[18]);
    const double t12 = (t11 + t8*fabs(lu[22]) + t9*fabs(lu[24]))*fabs(lu[8]);
    const double t13 = (t9 + t12*fabs(lu[23]))*fabs(lu[7]);
    const double t14 = (t1 + t13*fabs(lu[15]))*fabs(lu[4]);
    x[0] = (1000000000000000.0/848528137423857.0)*t14;
    x[1] = (1000000000000000.0/848528137423857.0)*t12;
    const double t15 = (t8 + t12*fabs(lu[19]) + t13*fabs(lu[20]))*fabs(lu[6]);
    x[2] = (1000000000000000.0/848528137423857.0)*t15;
    const double t16 = k1*t12;
    const double t17 = (t6 + t16)*fabs(lu[1]);
    x[3] = (t5 + k1*t14 + t17*fabs(lu[9]))*fabs(lu[0]);
    x[4] = t17;
    const double t18 = k1*t15;
    const double t19 = (t3 + t18)*fabs(lu[3]);
    x[5] = (t2 + t16 + t19*fabs(lu[12]))*fabs(lu[2]);
    x[6] = t19;
    x[7] = (t10 + t18 + t13*fabs(lu[17]))*fabs(lu[5]);
    x[8] = t13;
}

/* Sum of the squares of J^-1 (K - J).
 * 122 additions, 188 multiplications. */
void orthoglide_2003_tree_spread(const double *J, const double *K, const double *lu,
                                 double *MODELER_RESTRICT x)
{
    const double t1 = J[1] - K[1];
    const double t2 = J[7] - K[7] - lu[10]*t1;
    const double t3 = lu[21]*t2;
    const double t4 = lu[8]*(lu[22]*t2 - lu[24]*t3);
    const double t5 = lu[7]*(t3 - lu[23]*t4);
    const double t6 = lu[15]*t5*lu[4];
    const double t7 = (1000000000000000.0/848528137423857.0)*t6;
    const double t8 = (1000000000000000.0/848528137423857.0)*t4;
    const double t9 = lu[6]*(t2 + lu[19]*t4 + lu[20]*t5);
    const double t10 = (1000000000000000.0/848528137423857.0)*t9;
    const double t11 = lu[1]*t4;
    const double t12 = lu[0]*(t1 + t6 + lu[9]*t11);
    const double t13 = lu[3]*t9;
    const double t14 = lu[2]*(t4 + lu[12]*t13);
    const double t15 = lu[5]*(t9 + lu[17]*t5);
    const double t16 = t7*t7 + t8*t8 + t10*t10 + t12*t12 + t11*t11 + t14*t14 + t13*t13 + t15*t15;
    const double t17 = J[2] - K[2];
    const double t18 = J[4] - K[4];
    const double t19 = J[8] - K[8] - lu[10]*t17 - lu[11]*t18;
    const double t20 = lu[21]*t19;
    const double t21 = lu[8]*(lu[22]*t19 - lu[24]*t20);
    const double t22 = lu[7]*(t20 - lu[23]*t21);
    const double t23 = lu[15]*t22*lu[4];
    const double t24 = (1000000000000000.0/848528137423857.0)*t23;
    const double t25 = (1000000000000000.0/848528137423857.0)*t21;
    const double t26 = lu[6]*(t19 + lu[19]*t21 + lu[20]*t22);
    const double t27 = (1000000000000000.0/848528137423857.0)*t26;
    const double t28 = lu[1]*(t18 - t21);
    const double t29 = lu[0]*(t17 + t23 - lu[9]*t28);
    const double t30 = lu[3]*t26;
    const double t31 = lu[2]*(t21 + lu[12]*t30);
    const double t32 = t16 + t5*t5 + t24*t24 + t25*t25 + t27*t27 + t29*t29 + t28*t28 + t31*t31;
    const double t33 = lu[5]*(t26 + lu[17]*t22);
    const double t34 = J[14] - K[14];
    const double t35 = J[11] - K[11] - lu[13]*t34;
    const double t36 = lu[24]*t35*lu[8];
    const double t37 = lu[7]*(t35 + lu[23]*t36);
    const double t38 = lu[15]*t37*lu[4];
    const double t39 = (1000000000000000.0/848528137423857.0)*t38;
    const double t40 = (1000000000000000.0/848528137423857.0)*t36;
    const double t41 = lu[6]*(lu[19]*t36 - lu[20]*t37);
    const double t42 = (1000000000000000.0/848528137423857.0)*t41;
    const double t43 = lu[1]*t36;
    const double t44 = lu[0]*(t38 - lu[9]*t43);
    const double t45 = t32 + t30*t30 + t33*t33 + t22*t22 + t39*t39 + t40*t40 + t42*t42 + t44*t44;
    const double t46 = lu[3]*t41;
    const double t47 = lu[2]*(t34 - t36 - lu[12]*t46);
    const double t48 = lu[5]*(t41 - lu[17]*t37);
    const double t49 = J[15] - K[15];
    const double t50 = J[17] - K[17];
    const double t51 = J[12] - K[12] - lu[13]*t49 - lu[14]*t50;
    const double t52 = lu[24]*t51*lu[8];
    const double t53 = lu[7]*(t51 + lu[23]*t52);
    const double t54 = lu[15]*t53*lu[4];
    const double t55 = (1000000000000000.0/848528137423857.0)*t54;
    const double t56 = (1000000000000000.0/848528137423857.0)*t52;
    const double t57 = lu[6]*(lu[19]*t52 - lu[20]*t53);
    const double t58 = (1000000000000000.0/848528137423857.0)*t57;
    const double t59 = t45 + t43*t43 + t47*t47 + t46*t46 + t48*t48 + t37*t37 + t55*t55 + t56*t56;
    const double t60 = lu[1]*t52;
    const double t61 = lu[0]*(t54 - lu[9]*t60);
    const double t62 = lu[3]*(t50 + t57);
    const double t63 = lu[2]*(t49 - t52 - lu[12]*t62);
    const double t64 = lu[5]*(t57 - lu[17]*t53);
    const double t65 = J[25] - K[25];
    const double t66 = lu[8]*(J[22] - K[22] - lu[18]*t65);
    const double t67 = lu[23]*t66*lu[7];
    const double t68 = lu[15]*t67*lu[4];
    const double t69 = (1000000000000000.0/848528137423857.0)*t68;
    const double t70 = t59 + t58*t58 + t61*t61 + t60*t60 + t63*t63 + t62*t62 + t64*t64 + t53*t53;
    const double t71 = (1000000000000000.0/848528137423857.0)*t66;
    const double t72 = lu[6]*(lu[19]*t66 - lu[20]*t67);
    const double t73 = (1000000000000000.0/848528137423857.0)*t72;
    const double t74 = lu[1]*t66;
    const double t75 = lu[0]*(t68 - lu[9]*t74);
    const double t76 = lu[3]*t72;
    const double t77 = lu[2]*(t66 + lu[12]*t76);
    const double t78 = lu[5]*(t65 - t72 + lu[17]*t67);
    const double t79 = t70 + t69*t69 + t71*t71 + t73*t73 + t75*t75 + t74*t74 + t77*t77 + t76*t76;
    const double t80 = J[19] - K[19];
    const double t81 = lu[16]*t80;
    const double t82 = t80 - lu[21]*t81;
    const double t83 = J[26] - K[26];
    const double t84 = lu[8]*(J[23] - K[23] - lu[18]*t83 + lu[22]*t81 + lu[24]*t82);
    const double t85 = lu[7]*(t82 + lu[23]*t84);
    const double t86 = lu[4]*(t80 + lu[15]*t85);
    const double t87 = (1000000000000000.0/848528137423857.0)*t86;
    const double t88 = (1000000000000000.0/848528137423857.0)*t84;
    const double t89 = lu[6]*(t81 + lu[19]*t84 - lu[20]*t85);
    const double t90 = (1000000000000000.0/848528137423857.0)*t89;
    const double t91 = lu[1]*t84;
    const double t92 = lu[0]*(t86 - lu[9]*t91);
    const double t93 = lu[3]*t89;
    const double t94 = lu[2]*(t84 + lu[12]*t93);
    const double t95 = t79 + t78*t78 + t67*t67 + t87*t87 + t88*t88 + t90*t90 + t92*t92 + t91*t91;
    const double t96 = lu[5]*(t83 - t89 + lu[17]*t85);
    x[0] = t95 + t94*t94 + t93*t93 + t96*t96 + t85*t85;
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 0 additions, 11 multiplications. */
void orthoglide_2003_tree_platform_factor(const double *J, double *MODELER_RESTRICT lu)
{
    const double t1 = 1.0/J[4];
    lu[0] = t1;
    const double t2 = 1.0/J[1];
    lu[1] = t2;
    lu[2] = 1.0;
    lu[3] = 1.0;
    lu[4] = 1.0/J[14];
    lu[5] = 1.0/J[17];
    const double t3 = 1.0/J[19];
    lu[6] = t3;
    lu[7] = 1.0;
    lu[8] = 1.0/J[25];
    lu[9] = J[2]*t1;
    lu[10] = J[8]*t1;
    lu[11] = J[7]*t2;
    lu[12] = J[11];
    lu[13] = J[12];
    lu[14] = J[15];
    lu[15] = J[23]*t3;
    lu[16] = J[26]*t3;
    lu[17] = J[22];
}

/* Solution with the factors.
 * 9 additions, 18 multiplications. */
void orthoglide_2003_tree_platform_solve(const double *lu, const double *right,
                                         double *MODELER_RESTRICT x)
{
    const double t1 = right[0] - lu[9]*right[1];
    x[0] = lu[2]*(right[2] - lu[10]*right[1] - lu[11]*t1);
    const double t2 = lu[5]*right[5];
    const double t3 = lu[4]*(right[4] - lu[14]*t2);
    x[1] = lu[3]*(right[3] - lu[12]*t3 - lu[13]*t2);
    const double t4 = lu[8]*(right[8] - lu[16]*right[6]);
    x[2] = lu[7]*(right[7] - lu[15]*right[6] - lu[17]*t4);
    x[3] = lu[1]*t1;
    x[4] = lu[0]*right[1];
    x[5] = t3;
    x[6] = t2;
    x[7] = t4;
    x[8] = lu[6]*right[6];
}

/* G from the factors.
 * 3 additions, 16 multiplications. */
void orthoglide_2003_tree_platform_coupling(const double *J, const double *lu,
                                            double *MODELER_RESTRICT G)
{
    (void)J;

    G[0] = -lu[2]*lu[11];
    G[1] = lu[3];
    const double t1 = lu[8]*lu[16];
    G[2] = -lu[7]*(lu[15] - lu[17]*t1);
    G[3] = lu[1];
    G[4] = -t1;
    G[5] = lu[6];
    G[6] = -lu[2]*(lu[10] - lu[9]*lu[11]);
    G[7] = -lu[4]*lu[12]*lu[3];
    G[8] = lu[7];
    G[9] = -lu[1]*lu[9];
    G[10] = lu[0];
    G[11] = lu[4];
    G[12] = lu[2];
    const double t2 = lu[5]*lu[14]*lu[4];
    G[13] = lu[3]*(lu[12]*t2 - lu[5]*lu[13]);
    G[14] = -lu[8]*lu[17]*lu[7];
    G[15] = -t2;
    G[16] = lu[5];
    G[17] = lu[8];
}

/* Bounds of the rows of J^-1 (K - J).
 * 30 additions, 21 multiplications. */
void orthoglide_2003_tree_platform_turned(const double *J, const double *K, const double *lu,
                                          double *MODELER_RESTRICT x)
{
    const double t1 = fabs(J[4] - K[4]);
    const double t2 = fabs(J[1] - K[1]) + fabs(J[2] - K[2]) + t1*fabs(lu[9]);
    const double t3 = fabs(J[7] - K[7]) + fabs(J[8] - K[8]) + t1*fabs(lu[10]) + fabs(lu[11])*t2;
    x[0] = fabs(lu[2])*t3*(1000000000000000.0/848528137423857.0);
    const double t4 = fabs(J[17] - K[17])*fabs(lu[5]);
    const double t5 = fabs(lu[4])*(fabs(J[14] - K[14]) + fabs(J[15] - K[15]) + fabs(lu[14])*t4);
    const double t6 = fabs(J[11] - K[11]) + fabs(J[12] - K[12]) + fabs(lu[12])*t5;
    x[1] = fabs(lu[3])*(t6 + fabs(lu[13])*t4)*(1000000000000000.0/848528137423857.0);
    const double t7 = fabs(J[19] - K[19]);
    const double t8 = fabs(lu[8])*(fabs(J[25] - K[25]) + fabs(J[26] - K[26]) + t7*fabs(lu[16]));
    const double t9 = fabs(J[22] - K[22]) + fabs(J[23] - K[23]) + t7*fabs(lu[15]);
    x[2] = fabs(lu[7])*(t9 + fabs(lu[17])*t8)*(1000000000000000.0/848528137423857.0);
    x[3] = fabs(lu[1])*t2;
    x[4] = t1*fabs(lu[0]);
    x[5] = t5;
    x[6] = t4;
    x[7] = t8;
    x[8] = t7*fabs(lu[6]);
}

/* Sum of the squares of J^-1 (K - J).
 * 41 additions, 48 multiplications. */
void orthoglide_2003_tree_platform_spread(const double *J, const double *K, const double *lu,
                                          double *MODELER_RESTRICT x)
{
    const double t1 = J[1] - K[1];
    const double t2 = lu[2]*(J[7] - K[7] - lu[11]*t1)*(1000000000000000.0/848528137423857.0);
    const double t3 = lu[1]*t1;
    const double t4 = J[4] - K[4];
    const double t5 = J[2] - K[2] - lu[9]*t4;
    const double t6 = lu[2]*(J[8] - K[8] - lu[10]*t4 - lu[11]*t5);
    const double t7 = (1000000000000000.0/848528137423857.0)*t6;
    const double t8 = lu[1]*t5;
    const double t9 = lu[0]*t4;
    const double t10 = lu[4]*(J[14] - K[14]);
    const double t11 = lu[3]*(J[11] - K[11] - lu[12]*t10)*(1000000000000000.0/848528137423857.0);
    const double t12 = lu[5]*(J[17] - K[17]);
    const double t13 = lu[4]*(J[15] - K[15] - lu[14]*t12);
    const double t14 = lu[3]*(J[12] - K[12] - lu[12]*t13 - lu[13]*t12);
    const double t15 = (1000000000000000.0/848528137423857.0)*t14;
    const double t16 = t2*t2 + t3*t3 + t7*t7 + t8*t8 + t9*t9 + t11*t11 + t10*t10 + t15*t15;
    const double t17 = lu[8]*(J[25] - K[25]);
    const double t18 = lu[7]*(J[22] - K[22] - lu[17]*t17)*(1000000000000000.0/848528137423857.0);
    const double t19 = J[19] - K[19];
    const double t20 = lu[8]*(J[26] - K[26] - lu[16]*t19);
    const double t21 = lu[7]*(J[23] - K[23] - lu[15]*t19 - lu[17]*t20);
    const double t22 = (1000000000000000.0/848528137423857.0)*t21;
    const double t23 = lu[6]*t19;
    x[0] = t16 + t13*t13 + t12*t12 + t18*t18 + t17*t17 + t22*t22 + t20*t20 + t23*t23;
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
