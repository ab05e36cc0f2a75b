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
static const double orthoglide_2012_geo_a = ORTHOGLIDE_2012_GEO_a;
static const double orthoglide_2012_geo_d6 = ORTHOGLIDE_2012_GEO_d6;

/* Joint torques, by the Newton-Euler recursion.
 * 179 additions, 241 multiplications. */
void orthoglide_2012_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                           const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

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

    const double t1 = qd[6]*qd[6];
    const double t2 = t1*beta[24];
    const double t3 = c7*qd[6];
    const double t4 = qd[7]*qd[7];
    const double t5 = t3*t3 + t4;
    const double t6 = s7*qd[6];
    const double t7 = t6*t3;
    const double t8 = s7*t2;
    const double t9 = qdd[7] + t7;
    const double t10 = c7*(t5*beta[20] + (qdd[7] - t7)*beta[21] + c7*t2);
    const double t11 = t10 + s7*(t9*beta[20] - (t6*t6 + t4)*beta[21] + t8);
    const double t12 = qdd[6]*beta[24];
    const double t13 = qd[7]*t6;
    const double t14 = c7*qdd[6] - t13;
    const double t15 = t13 - t14;
    const double t16 = qd[7]*t3;
    const double t17 = s7*qdd[6] + t16;
    const double t18 = t12 - (t15*beta[20] + (t16 + t17)*beta[21]);
    const double t19 = s6*(t1*beta[11] + qdd[6]*beta[12] + t11);
    const double t20 = t19 - c6*(qdd[6]*beta[11] - t1*beta[12] + t18) + qdd[3]*beta[0];
    tau[3] = qd[3]*beta[1] + t20 + modeler_sign(qd[3])*beta[2];
    const double t21 = qd[8]*qd[8];
    const double t22 = t21*beta[38];
    const double t23 = s9*t22;
    const double t24 = s9*qd[8];
    const double t25 = qd[9]*qd[9];
    const double t26 = c9*qd[8];
    const double t27 = t24*t26;
    const double t28 = c9*(c9*t22 + (qdd[9] - t27)*beta[35]);
    const double t29 = s9*(t23 - (t24*t24 + t25)*beta[35]) + t28;
    const double t30 = qdd[8]*beta[38];
    const double t31 = qd[9]*t26;
    const double t32 = s9*qdd[8] + t31;
    const double t33 = c8*(t30 - (t31 + t32)*beta[35] + (qdd[8]*beta[26] - t21*beta[27]));
    const double t34 = s8*(t21*beta[26] + qdd[8]*beta[27] + t29) - t33 + qdd[4]*beta[3];
    tau[4] = qd[4]*beta[4] + t34 + modeler_sign(qd[4])*beta[5];
    const double t35 = qd[10]*qd[10];
    const double t36 = t35*beta[52];
    const double t37 = s11*t36;
    const double t38 = s11*qd[10];
    const double t39 = qd[11]*qd[11];
    const double t40 = c11*qd[10];
    const double t41 = t38*t40;
    const double t42 = c11*(c11*t36 + (qdd[11] - t41)*beta[49]);
    const double t43 = s11*(t37 - (t38*t38 + t39)*beta[49]) + t42;
    const double t44 = qdd[10]*beta[52];
    const double t45 = qd[11]*t40;
    const double t46 = s11*qdd[10] + t45;
    const double t47 = c10*(t44 - (t45 + t46)*beta[49] + (qdd[10]*beta[40] - t35*beta[41]));
    const double t48 = qdd[5] - orthoglide_2012_geo_g;
    const double t49 = s10*(t35*beta[40] + qdd[10]*beta[41] + t43) - t47 + t48*beta[6];
    tau[5] = t49 + qdd[5]*beta[7] + qd[5]*beta[8] + modeler_sign(qd[5])*beta[9];
    const double t50 = c6*qdd[3];
    const double t51 = (t50 + orthoglide_2012_geo_d4*t15)*beta[24];
    const double t52 = t6*beta[17] + t3*beta[18] - qd[7]*beta[19];
    const double t53 = t6*beta[16] - qd[7]*beta[18];
    const double t54 = t3*t52 + qd[7]*t53 + (qdd[7]*beta[17] - (t17*beta[15] + t14*beta[16]));
    const double t55 = t6*beta[15] + t3*beta[16] - qd[7]*beta[17];
    const double t56 = qd[7]*t55 + t6*t52 + (t17*beta[16] - qdd[7]*beta[18]) - t50*beta[20];
    const double t57 = c7*(c7*t51 - orthoglide_2012_geo_d4*t12 - t56);
    const double t58 = s6*qdd[3];
    const double t59 = t58*beta[12] - t50*beta[11] + qdd[6]*beta[10];
    const double t60 = t59 - (s7*(t54 - t50*beta[21] + s7*t51) + t57) + qd[6]*beta[13];
    tau[6] = modeler_sign(qd[6])*beta[14] + t60;
    const double t61 = orthoglide_2012_geo_g*c7 + s7*t58;
    const double t62 = c7*t58 - orthoglide_2012_geo_g*s7;
    const double t63 = c7*(t61 + orthoglide_2012_geo_d4*t9);
    const double t64 = (t63 - s7*(t62 + orthoglide_2012_geo_d4*t5))*beta[24];
    const double t65 = t6*t53 - t3*t55 + (qdd[7]*beta[19] - (t17*beta[17] + t14*beta[18]));
    const double t66 = orthoglide_2012_geo_d4*t8 + t64 + (t61*beta[20] + t62*beta[21] + t65);
    tau[7] = t66 - t64 + qd[7]*beta[22] + modeler_sign(qd[7])*beta[23];
    const double t67 = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    const double t68 = qd[9]*t24;
    const double t69 = c9*qdd[8] - t68;
    const double t70 = (t67 + orthoglide_2012_geo_d4*(t68 - t69))*beta[38];
    const double t71 = t24*beta[32] + t26*beta[33] - qd[9]*beta[34];
    const double t72 = t24*beta[31] - qd[9]*beta[33];
    const double t73 = t26*t71 + qd[9]*t72 + (qdd[9]*beta[32] - (t32*beta[30] + t69*beta[31]));
    const double t74 = t24*beta[30] + t26*beta[31] - qd[9]*beta[32];
    const double t75 = qd[9]*t74 + t24*t71 + (t32*beta[31] - qdd[9]*beta[33]);
    const double t76 = c9*(c9*t70 - orthoglide_2012_geo_d4*t30 - t75);
    const double t77 = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    const double t78 = t77*beta[27] - t67*beta[26] + qdd[8]*beta[25];
    const double t79 = t78 - (s9*(t73 - t67*beta[35] + s9*t70) + t76) + qd[8]*beta[28];
    tau[8] = modeler_sign(qd[8])*beta[29] + t79;
    const double t80 = c9*t77;
    const double t81 = c9*(s9*t77 + orthoglide_2012_geo_d4*(qdd[9] + t27));
    const double t82 = (t81 - s9*(t80 + orthoglide_2012_geo_d4*(t26*t26 + t25)))*beta[38];
    const double t83 = t24*t72 - t26*t74 + (qdd[9]*beta[34] - (t32*beta[32] + t69*beta[33]));
    const double t84 = t82 - (orthoglide_2012_geo_d4*t23 + t82 + (t83 + t80*beta[35]));
    tau[9] = qd[9]*beta[36] - t84 + modeler_sign(qd[9])*beta[37];
    const double t85 = c10*t48;
    const double t86 = qd[11]*t38;
    const double t87 = c11*qdd[10] - t86;
    const double t88 = (t85 + orthoglide_2012_geo_d4*(t86 - t87))*beta[52];
    const double t89 = t38*beta[46] + t40*beta[47] - qd[11]*beta[48];
    const double t90 = t38*beta[45] - qd[11]*beta[47];
    const double t91 = t40*t89 + qd[11]*t90 + (qdd[11]*beta[46] - (t46*beta[44] + t87*beta[45]));
    const double t92 = t38*beta[44] + t40*beta[45] - qd[11]*beta[46];
    const double t93 = qd[11]*t92 + t38*t89 + (t46*beta[45] - qdd[11]*beta[47]);
    const double t94 = c11*(c11*t88 - orthoglide_2012_geo_d4*t44 - t93);
    const double t95 = s10*t48;
    const double t96 = t95*beta[41] - t85*beta[40] + qdd[10]*beta[39];
    const double t97 = t96 - (s11*(t91 - t85*beta[49] + s11*t88) + t94) + qd[10]*beta[42];
    tau[10] = modeler_sign(qd[10])*beta[43] + t97;
    const double t98 = c11*t95;
    const double t99 = c11*(s11*t95 + orthoglide_2012_geo_d4*(qdd[11] + t41));
    const double t100 = (t99 - s11*(t98 + orthoglide_2012_geo_d4*(t40*t40 + t39)))*beta[52];
    const double t101 = t38*t90 - t40*t92 + (qdd[11]*beta[48] - (t46*beta[46] + t87*beta[47]));
    const double t102 = t100 - (orthoglide_2012_geo_d4*t37 + t100 + (t101 + t98*beta[49]));
    tau[11] = qd[11]*beta[50] - t102 + modeler_sign(qd[11])*beta[51];
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 35 additions, 57 multiplications. */
void orthoglide_2012_tree_inertia_matrix(const double *q, const double *beta,
                                         double *MODELER_RESTRICT M)
{
    MODELER_ALL_ZEROS(M, 144);

    const double k1 = orthoglide_2012_geo_d4*2.0;

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

    M[39] = beta[0];
    const double t1 = s7*beta[24];
    const double t2 = beta[21] - t1;
    MODELER_ZEROS(M + 0, 8);
    const double t3 = c7*beta[24];
    const double t4 = beta[20] + t3;
    MODELER_ZEROS(M + 8, 8);
    const double t5 = s6*beta[12] - c6*(c7*t4 - s7*t2 + beta[11]);
    M[42] = t5;
    MODELER_ZEROS(M + 16, 8);
    const double t6 = s6*(c7*t2 + s7*t4);
    M[43] = t6;
    MODELER_ZEROS(M + 24, 8);
    M[52] = beta[3];
    const double t7 = c9*beta[38];
    const double t8 = s9*beta[38];
    MODELER_ZEROS(M + 32, 7);
    const double t9 = beta[35] - t8;
    const double t10 = s8*beta[27] - c8*(c9*t7 - s9*t9 + beta[26]);
    MODELER_ZEROS(M + 40, 2);
    M[56] = t10;
    const double t11 = s8*(c9*t8 + c9*t9);
    MODELER_ZEROS(M + 44, 8);
    M[57] = t11;
    M[65] = beta[6] + beta[7];
    MODELER_ZEROS(M + 53, 3);
    const double t12 = c11*beta[52];
    const double t13 = s11*beta[52];
    const double t14 = beta[49] - t13;
    MODELER_ZEROS(M + 58, 7);
    const double t15 = s10*beta[41] - c10*(c11*t12 - s11*t14 + beta[40]);
    M[70] = t15;
    MODELER_ZEROS(M + 66, 4);
    const double t16 = s10*(c11*t13 + c11*t14);
    M[71] = t16;
    MODELER_ZEROS(M + 72, 3);
    M[75] = t5;
    const double t17 = beta[16] + orthoglide_2012_geo_d4*t1;
    MODELER_ZEROS(M + 76, 2);
    M[78] = s7*(s7*beta[15] + c7*t17) + c7*(s7*t17 + k1*t3*c7) + beta[10];
    const double t18 = s7*beta[17] + c7*beta[18];
    MODELER_ZEROS(M + 80, 7);
    M[79] = -t18;
    M[87] = t6;
    M[90] = -t18;
    MODELER_ZEROS(M + 88, 2);
    M[91] = beta[19];
    M[100] = t10;
    MODELER_ZEROS(M + 92, 8);
    const double t19 = beta[31] + orthoglide_2012_geo_d4*t8;
    M[104] = s9*(s9*beta[30] + c9*t19) + c9*(s9*t19 + k1*t7*c9) + beta[25];
    MODELER_ZEROS(M + 101, 3);
    const double t20 = s9*beta[32] + c9*beta[33];
    M[105] = -t20;
    MODELER_ZEROS(M + 106, 6);
    M[112] = t11;
    M[116] = -t20;
    M[117] = beta[34];
    MODELER_ZEROS(M + 113, 3);
    M[125] = t15;
    const double t21 = beta[45] + orthoglide_2012_geo_d4*t13;
    MODELER_ZEROS(M + 118, 7);
    M[130] = s11*(s11*beta[44] + c11*t21) + c11*(s11*t21 + k1*t12*c11) + beta[39];
    const double t22 = s11*beta[46] + c11*beta[47];
    MODELER_ZEROS(M + 126, 4);
    M[131] = -t22;
    M[137] = t16;
    MODELER_ZEROS(M + 132, 5);
    M[142] = -t22;
    M[143] = beta[48];
    MODELER_ZEROS(M + 138, 4);
}

/* Torques that hold the robot still, without friction.
 * 9 additions, 29 multiplications. */
void orthoglide_2012_tree_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
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

    tau[5] = -orthoglide_2012_geo_g*beta[6];
    tau[7] = orthoglide_2012_geo_g*c7*beta[20] - orthoglide_2012_geo_g*s7*beta[21];
    const double t1 = orthoglide_2012_geo_g*s8;
    const double t2 = t1*beta[38];
    const double t3 = orthoglide_2012_geo_g*c8;
    tau[8] = s9*(s9*t2 - t1*beta[35]) + c9*t2*c9 + (t1*beta[26] + t3*beta[27]);
    tau[9] = c9*t3*beta[35];
    const double t4 = orthoglide_2012_geo_g*c10;
    const double t5 = beta[52]*t4;
    const double t6 = orthoglide_2012_geo_g*s10;
    tau[10] = s11*(s11*t5 - beta[49]*t4) + c11*t5*c11 + (beta[40]*t4 - beta[41]*t6);
    tau[11] = -c11*t6*beta[49];
}

/* Torques without gravity and friction.
 * 158 additions, 223 multiplications. */
void orthoglide_2012_tree_coriolis(const double *q, const double *qd, const double *qdd,
                                   const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

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

    const double t1 = qd[6]*qd[6];
    const double t2 = t1*beta[24];
    const double t3 = c7*qd[6];
    const double t4 = qd[7]*qd[7];
    const double t5 = t3*t3 + t4;
    const double t6 = s7*qd[6];
    const double t7 = t6*t3;
    const double t8 = s7*t2;
    const double t9 = qdd[7] + t7;
    const double t10 = c7*(t5*beta[20] + (qdd[7] - t7)*beta[21] + c7*t2);
    const double t11 = t10 + s7*(t9*beta[20] - (t6*t6 + t4)*beta[21] + t8);
    const double t12 = qdd[6]*beta[24];
    const double t13 = qd[7]*t6;
    const double t14 = c7*qdd[6] - t13;
    const double t15 = t13 - t14;
    const double t16 = qd[7]*t3;
    const double t17 = s7*qdd[6] + t16;
    const double t18 = t12 - (t15*beta[20] + (t16 + t17)*beta[21]);
    const double t19 = s6*(t1*beta[11] + qdd[6]*beta[12] + t11);
    tau[3] = t19 - c6*(qdd[6]*beta[11] - t1*beta[12] + t18) + qdd[3]*beta[0];
    const double t20 = qd[8]*qd[8];
    const double t21 = t20*beta[38];
    const double t22 = s9*t21;
    const double t23 = s9*qd[8];
    const double t24 = qd[9]*qd[9];
    const double t25 = c9*qd[8];
    const double t26 = t23*t25;
    const double t27 = c9*(c9*t21 + (qdd[9] - t26)*beta[35]);
    const double t28 = s9*(t22 - (t23*t23 + t24)*beta[35]) + t27;
    const double t29 = qdd[8]*beta[38];
    const double t30 = qd[9]*t25;
    const double t31 = s9*qdd[8] + t30;
    const double t32 = c8*(t29 - (t30 + t31)*beta[35] + (qdd[8]*beta[26] - t20*beta[27]));
    tau[4] = s8*(t20*beta[26] + qdd[8]*beta[27] + t28) - t32 + qdd[4]*beta[3];
    const double t33 = qd[10]*qd[10];
    const double t34 = t33*beta[52];
    const double t35 = s11*t34;
    const double t36 = s11*qd[10];
    const double t37 = qd[11]*qd[11];
    const double t38 = c11*qd[10];
    const double t39 = t36*t38;
    const double t40 = c11*(c11*t34 + (qdd[11] - t39)*beta[49]);
    const double t41 = s11*(t35 - (t36*t36 + t37)*beta[49]) + t40;
    const double t42 = qdd[10]*beta[52];
    const double t43 = qd[11]*t38;
    const double t44 = s11*qdd[10] + t43;
    const double t45 = c10*(t42 - (t43 + t44)*beta[49] + (qdd[10]*beta[40] - t33*beta[41]));
    const double t46 = s10*(t33*beta[40] + qdd[10]*beta[41] + t41) - t45 + qdd[5]*beta[6];
    tau[5] = qdd[5]*beta[7] + t46;
    const double t47 = c6*qdd[3];
    const double t48 = (t47 + orthoglide_2012_geo_d4*t15)*beta[24];
    const double t49 = t6*beta[17] + t3*beta[18] - qd[7]*beta[19];
    const double t50 = t6*beta[16] - qd[7]*beta[18];
    const double t51 = t3*t49 + qd[7]*t50 + (qdd[7]*beta[17] - (t17*beta[15] + t14*beta[16]));
    const double t52 = t6*beta[15] + t3*beta[16] - qd[7]*beta[17];
    const double t53 = qd[7]*t52 + t6*t49 + (t17*beta[16] - qdd[7]*beta[18]) - t47*beta[20];
    const double t54 = c7*(c7*t48 - orthoglide_2012_geo_d4*t12 - t53);
    const double t55 = s6*qdd[3];
    const double t56 = t55*beta[12] - t47*beta[11] + qdd[6]*beta[10];
    tau[6] = t56 - (s7*(t51 - t47*beta[21] + s7*t48) + t54);
    const double t57 = s7*t55;
    const double t58 = c7*t55;
    const double t59 = c7*(t57 + orthoglide_2012_geo_d4*t9);
    const double t60 = beta[24]*(t59 - s7*(t58 + orthoglide_2012_geo_d4*t5));
    const double t61 = t6*t50 - t3*t52 + (qdd[7]*beta[19] - (t17*beta[17] + t14*beta[18]));
    const double t62 = orthoglide_2012_geo_d4*t8 + t60 + (t57*beta[20] + t58*beta[21] + t61);
    tau[7] = t62 - t60;
    const double t63 = c8*qdd[4];
    const double t64 = qd[9]*t23;
    const double t65 = c9*qdd[8] - t64;
    const double t66 = beta[38]*(t63 + orthoglide_2012_geo_d4*(t64 - t65));
    const double t67 = t23*beta[32] + t25*beta[33] - qd[9]*beta[34];
    const double t68 = t23*beta[31] - qd[9]*beta[33];
    const double t69 = t25*t67 + qd[9]*t68 + (qdd[9]*beta[32] - (t31*beta[30] + t65*beta[31]));
    const double t70 = t23*beta[30] + t25*beta[31] - qd[9]*beta[32];
    const double t71 = qd[9]*t70 + t23*t67 + (t31*beta[31] - qdd[9]*beta[33]);
    const double t72 = c9*(orthoglide_2012_geo_d4*t29 - c9*t66 + t71);
    const double t73 = s8*qdd[4];
    const double t74 = t73*beta[27] - t63*beta[26] + qdd[8]*beta[25];
    tau[8] = t74 - (s9*(t69 - t63*beta[35] + s9*t66) - t72);
    const double t75 = orthoglide_2012_geo_g*c8 + t73;
    const double t76 = s9*(c9*t75 + orthoglide_2012_geo_d4*(t25*t25 + t24));
    const double t77 = (c9*(s9*t75 + orthoglide_2012_geo_d4*(qdd[9] + t26)) - t76)*beta[38];
    const double t78 = t23*t68 - t25*t70 + (qdd[9]*beta[34] - (t31*beta[32] + t65*beta[33]));
    tau[9] = orthoglide_2012_geo_d4*t22 + t77 + (t78 + c9*t73*beta[35]) - t77;
    const double t79 = qd[11]*t36;
    const double t80 = c11*qdd[10] - t79;
    const double t81 = c10*qdd[5];
    const double t82 = beta[52]*(orthoglide_2012_geo_d4*(t79 - t80) + t81);
    const double t83 = t36*beta[46] + t38*beta[47] - qd[11]*beta[48];
    const double t84 = t36*beta[45] - qd[11]*beta[47];
    const double t85 = t38*t83 + qd[11]*t84 + (qdd[11]*beta[46] - (t44*beta[44] + t80*beta[45]));
    const double t86 = t36*beta[44] + t38*beta[45] - qd[11]*beta[46];
    const double t87 = qd[11]*t86 + t36*t83 + (t44*beta[45] - qdd[11]*beta[47]);
    const double t88 = c11*(orthoglide_2012_geo_d4*t42 - c11*t82 + t87);
    const double t89 = s10*qdd[5];
    const double t90 = beta[41]*t89 - beta[40]*t81 + qdd[10]*beta[39];
    tau[10] = t90 - (s11*(t85 - beta[49]*t81 + s11*t82) - t88);
    const double t91 = s10*(qdd[5] - orthoglide_2012_geo_g);
    const double t92 = c11*(s11*t91 + orthoglide_2012_geo_d4*(qdd[11] + t39));
    const double t93 = (t92 - s11*(c11*t91 + orthoglide_2012_geo_d4*(t38*t38 + t37)))*beta[52];
    const double t94 = t36*t84 - t38*t86 + (qdd[11]*beta[48] - (t44*beta[46] + t80*beta[47]));
    tau[11] = orthoglide_2012_geo_d4*t35 + t93 + (t94 + c11*t89*beta[49]) - t93;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 9 additions, 18 multiplications. */
void orthoglide_2012_tree_friction(const double *qd, const double *beta,
                                   double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;

    tau[3] = qd[3]*beta[1] + modeler_sign(qd[3])*beta[2];
    tau[4] = qd[4]*beta[4] + modeler_sign(qd[4])*beta[5];
    tau[5] = qd[5]*beta[8] + modeler_sign(qd[5])*beta[9];
    tau[6] = qd[6]*beta[13] + modeler_sign(qd[6])*beta[14];
    tau[7] = qd[7]*beta[22] + modeler_sign(qd[7])*beta[23];
    tau[8] = qd[8]*beta[28] + modeler_sign(qd[8])*beta[29];
    tau[9] = qd[9]*beta[36] + modeler_sign(qd[9])*beta[37];
    tau[10] = qd[10]*beta[42] + modeler_sign(qd[10])*beta[43];
    tau[11] = qd[11]*beta[50] + modeler_sign(qd[11])*beta[51];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 7 additions, 21 multiplications. */
void orthoglide_2012_tree_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    MODELER_ALL_ZEROS(T, 216);

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
    MODELER_ZEROS(T + 5, 4);
    T[15] = q[0];
    T[18] = 1.0;
    T[19] = q[1];
    MODELER_ZEROS(T + 10, 3);
    T[20] = 1.0;
    T[24] = 1.0;
    MODELER_ZEROS(T + 14, 1);
    T[27] = q[0];
    T[29] = 1.0;
    T[31] = q[1];
    MODELER_ZEROS(T + 16, 2);
    T[34] = 1.0;
    T[35] = q[2];
    MODELER_ZEROS(T + 21, 3);
    T[36] = 1.0;
    T[41] = 1.0;
    T[46] = 1.0;
    MODELER_ZEROS(T + 25, 2);
    T[47] = q[3];
    T[50] = 1.0;
    MODELER_ZEROS(T + 28, 1);
    const double t1 = orthoglide_2012_geo_a - q[4];
    T[51] = -t1;
    T[52] = 1.0;
    MODELER_ZEROS(T + 30, 1);
    T[57] = 1.0;
    T[59] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 32, 2);
    T[61] = 1.0;
    T[66] = 1.0;
    MODELER_ZEROS(T + 37, 4);
    const double t2 = orthoglide_2012_geo_a - q[5];
    T[67] = -t2;
    T[68] = 1.0;
    MODELER_ZEROS(T + 42, 4);
    T[71] = orthoglide_2012_geo_a;
    T[72] = c6;
    MODELER_ZEROS(T + 48, 2);
    T[73] = -s6;
    T[78] = 1.0;
    T[80] = -s6;
    MODELER_ZEROS(T + 53, 4);
    T[81] = -c6;
    T[83] = q[3];
    MODELER_ZEROS(T + 58, 1);
    const double t3 = c6*c7;
    T[84] = t3;
    T[85] = -c6*s7;
    MODELER_ZEROS(T + 60, 1);
    T[86] = -s6;
    T[88] = -s7;
    MODELER_ZEROS(T + 62, 4);
    T[89] = -c7;
    const double t4 = s6*c7;
    T[92] = -t4;
    MODELER_ZEROS(T + 69, 2);
    T[93] = s6*s7;
    T[94] = -c6;
    MODELER_ZEROS(T + 74, 4);
    T[95] = q[3];
    T[96] = c6;
    MODELER_ZEROS(T + 79, 1);
    T[98] = -s6;
    const double t5 = orthoglide_2012_geo_d4*t3;
    T[99] = t5;
    MODELER_ZEROS(T + 82, 1);
    T[101] = -1.0;
    const double t6 = orthoglide_2012_geo_d4*s7;
    MODELER_ZEROS(T + 87, 1);
    T[103] = -t6;
    T[104] = -s6;
    T[106] = -c6;
    MODELER_ZEROS(T + 90, 2);
    const double t7 = q[3] - orthoglide_2012_geo_d4*t4;
    T[107] = t7;
    MODELER_ZEROS(T + 97, 1);
    T[108] = 1.0;
    T[111] = t5;
    T[114] = 1.0;
    MODELER_ZEROS(T + 100, 1);
    T[115] = -t6;
    T[117] = -1.0;
    MODELER_ZEROS(T + 102, 1);
    T[119] = t7;
    T[120] = -s8;
    T[121] = -c8;
    MODELER_ZEROS(T + 105, 1);
    T[123] = -t1;
    T[124] = c8;
    MODELER_ZEROS(T + 109, 2);
    T[125] = -s8;
    T[130] = 1.0;
    MODELER_ZEROS(T + 112, 2);
    T[131] = orthoglide_2012_geo_a;
    const double t8 = s8*c9;
    T[132] = -t8;
    MODELER_ZEROS(T + 116, 1);
    T[133] = s8*s9;
    T[134] = -c8;
    MODELER_ZEROS(T + 118, 1);
    T[135] = -t1;
    const double t9 = c8*c9;
    T[136] = t9;
    MODELER_ZEROS(T + 122, 1);
    T[137] = -c8*s9;
    T[138] = -s8;
    MODELER_ZEROS(T + 126, 4);
    T[140] = -s9;
    T[141] = -c9;
    T[143] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 139, 1);
    T[144] = -s8;
    T[146] = -c8;
    MODELER_ZEROS(T + 142, 1);
    const double t10 = t1 + orthoglide_2012_geo_d4*t8;
    T[147] = -t10;
    T[148] = c8;
    MODELER_ZEROS(T + 145, 1);
    T[150] = -s8;
    const double t11 = orthoglide_2012_geo_d4*t9;
    MODELER_ZEROS(T + 149, 1);
    T[151] = t11;
    T[153] = -1.0;
    MODELER_ZEROS(T + 152, 1);
    const double t12 = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9;
    T[155] = t12;
    T[157] = -1.0;
    MODELER_ZEROS(T + 154, 1);
    T[159] = -t10;
    T[160] = 1.0;
    MODELER_ZEROS(T + 156, 1);
    T[163] = t11;
    T[166] = 1.0;
    T[167] = t12;
    MODELER_ZEROS(T + 158, 1);
    T[170] = 1.0;
    T[172] = -s10;
    MODELER_ZEROS(T + 161, 2);
    T[173] = -c10;
    T[175] = -t2;
    T[176] = c10;
    MODELER_ZEROS(T + 164, 2);
    T[177] = -s10;
    T[179] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 168, 2);
    T[180] = -s11;
    T[181] = -c11;
    const double t13 = s10*c11;
    MODELER_ZEROS(T + 171, 1);
    T[184] = -t13;
    T[185] = s10*s11;
    MODELER_ZEROS(T + 174, 1);
    T[186] = -c10;
    T[187] = -t2;
    MODELER_ZEROS(T + 178, 1);
    const double t14 = c10*c11;
    T[188] = t14;
    T[189] = -c10*s11;
    MODELER_ZEROS(T + 182, 2);
    T[190] = -s10;
    T[191] = orthoglide_2012_geo_a;
    MODELER_ZEROS(T + 192, 1);
    T[193] = -1.0;
    const double t15 = orthoglide_2012_geo_d4*s11;
    T[195] = -t15;
    MODELER_ZEROS(T + 194, 1);
    T[196] = -s10;
    T[198] = -c10;
    MODELER_ZEROS(T + 197, 1);
    const double t16 = t2 + orthoglide_2012_geo_d4*t13;
    T[199] = -t16;
    T[200] = c10;
    MODELER_ZEROS(T + 201, 1);
    T[202] = -s10;
    const double t17 = orthoglide_2012_geo_a + orthoglide_2012_geo_d4*t14;
    MODELER_ZEROS(T + 204, 2);
    T[203] = t17;
    T[206] = 1.0;
    T[207] = -t15;
    MODELER_ZEROS(T + 208, 1);
    T[209] = -1.0;
    T[211] = -t16;
    MODELER_ZEROS(T + 210, 1);
    T[212] = 1.0;
    T[215] = t17;
    MODELER_ZEROS(T + 213, 2);
}

/* d/dt(df/du) ud.
 * 18 additions, 66 multiplications. */
void orthoglide_2012_tree_drift(const double *q, const double *qd, double *MODELER_RESTRICT values)
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
    const double t5 = orthoglide_2012_geo_d4*(c7*t1 - s6*t2)*qd[6];
    values[0] = orthoglide_2012_geo_d4*(s7*t3 - c6*t4)*qd[7] - t5;
    values[1] = orthoglide_2012_geo_d4*t2*qd[7];
    const double t6 = orthoglide_2012_geo_d4*(c7*t3 + c6*t2)*qd[6];
    values[2] = t6 + orthoglide_2012_geo_d4*(s7*t1 + s6*t4)*qd[7];
    const double t7 = s8*qd[8];
    const double t8 = s9*qd[9];
    const double t9 = c8*qd[8];
    const double t10 = c9*qd[9];
    const double t11 = orthoglide_2012_geo_d4*(s9*t9 + s8*t10)*qd[9];
    values[3] = orthoglide_2012_geo_d4*(c9*t7 + c8*t8)*qd[8] + t11;
    const double t12 = orthoglide_2012_geo_d4*(s9*t7 - c8*t10)*qd[9];
    values[4] = t12 - orthoglide_2012_geo_d4*(c9*t9 - s8*t8)*qd[8];
    values[5] = orthoglide_2012_geo_d4*t8*qd[9];
    const double t13 = s11*qd[11];
    values[6] = orthoglide_2012_geo_d4*t13*qd[11];
    const double t14 = s10*qd[10];
    const double t15 = c10*qd[10];
    const double t16 = c11*qd[11];
    const double t17 = orthoglide_2012_geo_d4*(c11*t14 + c10*t13)*qd[10];
    values[7] = t17 + orthoglide_2012_geo_d4*(s11*t15 + s10*t16)*qd[11];
    const double t18 = orthoglide_2012_geo_d4*(c11*t15 - s10*t13)*qd[10];
    values[8] = orthoglide_2012_geo_d4*(s11*t14 - c10*t16)*qd[11] - t18;
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 19 additions, 30 multiplications. */
void orthoglide_2012_tree_closure(const double *q, double *MODELER_RESTRICT values)
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

    const double t1 = c6*c7*orthoglide_2012_geo_d4;
    values[0] = t1 - q[0];
    values[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    const double t2 = s6*c7*orthoglide_2012_geo_d4;
    values[2] = q[3] - t2 + orthoglide_2012_geo_d6 - q[2];
    const double t3 = s8*c9*orthoglide_2012_geo_d4;
    values[3] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[4] + t3) - q[0];
    const double t4 = c8*c9*orthoglide_2012_geo_d4;
    values[4] = t4 - q[1];
    values[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    values[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    const double t5 = s10*c11*orthoglide_2012_geo_d4;
    values[7] = orthoglide_2012_geo_d6 - (orthoglide_2012_geo_a - q[5] + t5) - q[1];
    const double t6 = c10*c11*orthoglide_2012_geo_d4;
    values[8] = orthoglide_2012_geo_a + t6 - q[2];
    values[9] = -1.0;
    values[10] = -t2;
    values[11] = -c6*s7*orthoglide_2012_geo_d4;
    values[12] = -1.0;
    values[13] = -orthoglide_2012_geo_d4*c7;
    values[14] = -1.0;
    values[15] = 1.0;
    values[16] = -t1;
    values[17] = s6*s7*orthoglide_2012_geo_d4;
    values[18] = -1.0;
    values[19] = 1.0;
    values[20] = -t4;
    values[21] = s8*s9*orthoglide_2012_geo_d4;
    values[22] = -1.0;
    values[23] = -t3;
    values[24] = -c8*s9*orthoglide_2012_geo_d4;
    values[25] = -1.0;
    values[26] = -orthoglide_2012_geo_d4*c9;
    values[27] = -1.0;
    values[28] = -orthoglide_2012_geo_d4*c11;
    values[29] = -1.0;
    values[30] = 1.0;
    values[31] = -t6;
    values[32] = s10*s11*orthoglide_2012_geo_d4;
    values[33] = -1.0;
    values[34] = -t5;
    values[35] = -c10*s11*orthoglide_2012_geo_d4;
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
 * 19 additions, 15 multiplications. */
void orthoglide_2012_tree_residual(const double *q, double *MODELER_RESTRICT f)
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

    f[0] = c6*c7*orthoglide_2012_geo_d4 - q[0];
    f[1] = -(q[1] + orthoglide_2012_geo_d4*s7);
    f[2] = q[3] - s6*c7*orthoglide_2012_geo_d4 + orthoglide_2012_geo_d6 - q[2];
    const double t1 = orthoglide_2012_geo_a - q[4] + s8*c9*orthoglide_2012_geo_d4;
    f[3] = orthoglide_2012_geo_d6 - t1 - q[0];
    f[4] = c8*c9*orthoglide_2012_geo_d4 - q[1];
    f[5] = orthoglide_2012_geo_a - orthoglide_2012_geo_d4*s9 - q[2];
    f[6] = -(q[0] + orthoglide_2012_geo_d4*s11);
    const double t2 = orthoglide_2012_geo_a - q[5] + s10*c11*orthoglide_2012_geo_d4;
    f[7] = orthoglide_2012_geo_d6 - t2 - q[1];
    f[8] = orthoglide_2012_geo_a + c10*c11*orthoglide_2012_geo_d4 - q[2];
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 8 additions, 22 multiplications. */
void orthoglide_2012_tree_factor(const double *J, double *MODELER_RESTRICT lu)
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
void orthoglide_2012_tree_solve(const double *lu, const double *right, double *MODELER_RESTRICT x)
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
void orthoglide_2012_tree_coupling(const double *J, const double *lu, double *MODELER_RESTRICT G)
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
void orthoglide_2012_tree_turned(const double *J, const double *K, const double *lu,
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
void orthoglide_2012_tree_spread(const double *J, const double *K, const double *lu,
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
void orthoglide_2012_tree_platform_factor(const double *J, double *MODELER_RESTRICT lu)
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
void orthoglide_2012_tree_platform_solve(const double *lu, const double *right,
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
void orthoglide_2012_tree_platform_coupling(const double *J, const double *lu,
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
void orthoglide_2012_tree_platform_turned(const double *J, const double *K, const double *lu,
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
void orthoglide_2012_tree_platform_spread(const double *J, const double *K, const double *lu,
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
 * 103 additions, 21 multiplications. */
void orthoglide_2012_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = 1.0/orthoglide_2012_geo_d4;
    const double k2 = orthoglide_2012_geo_d4*orthoglide_2012_geo_d4;

    const double t1 = k1*chi[111];
    const double t2 = chi[0] + chi[10] + chi[11] + chi[49] + chi[62] + chi[75] + chi[88] + t1;
    const double t3 = k1*chi[163];
    beta[0] = chi[127] + t2 + chi[140] + t3 + chi[179] + chi[192];
    beta[1] = chi[12];
    beta[2] = chi[13];
    beta[3] = chi[23] + chi[24] + chi[101] - t1 + chi[114];
    beta[4] = chi[25];
    beta[5] = chi[26];
    beta[6] = chi[36] + chi[153] - t3 + chi[166];
    beta[7] = chi[37];
    beta[8] = chi[38];
    beta[9] = chi[39];
    const double t4 = k2*chi[0];
    const double t5 = k2*chi[75];
    const double t6 = k2*chi[88];
    const double t7 = orthoglide_2012_geo_d4*chi[111];
    const double t8 = k2*chi[127];
    const double t9 = k2*chi[140];
    const double t10 = chi[45] + t4 + chi[50] + chi[56] + chi[69] + t5 + t6 + chi[89] + t7 + t8;
    const double t11 = orthoglide_2012_geo_d4*chi[163];
    const double t12 = k2*chi[179];
    const double t13 = k2*chi[192];
    beta[10] = t10 + t9 + t11 + t12 + t13;
    beta[11] = chi[46];
    beta[12] = chi[47] + chi[61] + chi[74];
    beta[13] = chi[51] + chi[90];
    beta[14] = chi[52] + chi[91];
    beta[15] = -(t4 - chi[53] + chi[56] + t5 + t6 + t7 + t8 + t9 + t11 + t12 + t13);
    beta[16] = chi[54];
    beta[17] = chi[55] - orthoglide_2012_geo_d4*chi[74];
    beta[18] = chi[57];
    const double t14 = chi[58] + t4 + chi[63] + t5 + chi[76] + t6 + t7 + t8 + t9 + t11 + t12;
    beta[19] = t13 + t14;
    const double t15 = chi[59] + orthoglide_2012_geo_d4*chi[0] + orthoglide_2012_geo_d4*chi[75];
    const double t16 = t15 + orthoglide_2012_geo_d4*chi[88] + chi[111];
    const double t17 = t16 + orthoglide_2012_geo_d4*chi[127] + orthoglide_2012_geo_d4*chi[140];
    const double t18 = chi[163] + t17 + orthoglide_2012_geo_d4*chi[179];
    beta[20] = t18 + orthoglide_2012_geo_d4*chi[192];
    beta[21] = chi[60];
    beta[22] = chi[64] + chi[77];
    beta[23] = chi[65] + chi[78];
    beta[24] = chi[72];
    beta[25] = chi[97] + chi[102] + chi[108] - t7 + chi[121] + chi[141];
    beta[26] = chi[98];
    beta[27] = chi[99] + chi[113] + chi[126];
    beta[28] = chi[103] + chi[142];
    beta[29] = chi[104] + chi[143];
    beta[30] = chi[105] - chi[108] + t7;
    beta[31] = chi[106];
    beta[32] = chi[107] - orthoglide_2012_geo_d4*chi[126];
    beta[33] = chi[109];
    beta[34] = chi[110] - t7 + chi[115] + chi[128];
    beta[35] = chi[112];
    beta[36] = chi[116] + chi[129];
    beta[37] = chi[117] + chi[130];
    beta[38] = chi[124];
    beta[39] = chi[149] + chi[154] + chi[160] - t11 + chi[173] + chi[193];
    beta[40] = chi[150];
    beta[41] = chi[151] + chi[165] + chi[178];
    beta[42] = chi[155] + chi[194];
    beta[43] = chi[156] + chi[195];
    beta[44] = chi[157] - chi[160] + t11;
    beta[45] = chi[158];
    beta[46] = chi[159] - orthoglide_2012_geo_d4*chi[178];
    beta[47] = chi[161];
    beta[48] = chi[162] - t11 + chi[167] + chi[180];
    beta[49] = chi[164];
    beta[50] = chi[168] + chi[181];
    beta[51] = chi[169] + chi[182];
    beta[52] = chi[176];
}
