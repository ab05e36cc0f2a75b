/* SR400, 6R arm with a parallelogram, cut open
 *
 * Functions of sr400_tree.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "sr400_tree.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DSR400_TREE_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef SR400_TREE_GEO_g
#define SR400_TREE_GEO_g 9.81
#endif
#ifndef SR400_TREE_GEO_D2
#define SR400_TREE_GEO_D2 0.3
#endif
#ifndef SR400_TREE_GEO_D3
#define SR400_TREE_GEO_D3 0.75
#endif
#ifndef SR400_TREE_GEO_D4
#define SR400_TREE_GEO_D4 0.15
#endif
#ifndef SR400_TREE_GEO_RL4
#define SR400_TREE_GEO_RL4 0.8
#endif
#ifndef SR400_TREE_GEO_D8
#define SR400_TREE_GEO_D8 0.35
#endif

static const double sr400_tree_geo_g = SR400_TREE_GEO_g;
static const double sr400_tree_geo_D2 = SR400_TREE_GEO_D2;
static const double sr400_tree_geo_D3 = SR400_TREE_GEO_D3;
static const double sr400_tree_geo_D4 = SR400_TREE_GEO_D4;
static const double sr400_tree_geo_RL4 = SR400_TREE_GEO_RL4;
static const double sr400_tree_geo_D8 = SR400_TREE_GEO_D8;

const int sr400_tree_nonzero_row[SR400_TREE_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7
};

const int sr400_tree_nonzero_column[SR400_TREE_NONZEROS] = {
    0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
    28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 41, 42, 43, 44, 45, 46, 48, 49, 1, 2, 3, 4, 5,
    6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
    31, 32, 33, 34, 35, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
    27, 28, 29, 30, 31, 32, 33, 34, 35, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29,
    30, 31, 32, 33, 34, 35, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 29, 30, 31, 32,
    33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 43, 44, 45, 46, 47, 48, 49
};

const char *sr400_tree_signature(void)
{
    return "bdce896f9c70e246";
}

void sr400_tree_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                            double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, SR400_TREE_JOINTS},
        {qd, SR400_TREE_JOINTS},
        {qdd, SR400_TREE_JOINTS},
    };

    modeler_batch_3(sr400_tree_base_regressor, samples, inputs, W,
                    (size_t)SR400_TREE_JOINTS * SR400_TREE_BASE_PARAMETERS);
}

/* Joint torques, by the Newton-Euler recursion.
 * 323 additions, 408 multiplications. */
void sr400_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                 const double *beta, double *MODELER_RESTRICT tau)
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    const double t1 = c6*qd[0];
    const double t2 = s6*qd[0];
    const double t3 = c7*t1 - s7*t2;
    const double t4 = c7*t2 + s7*t1;
    const double t5 = qd[6] + qd[7];
    const double t6 = t4*beta[45] + t3*beta[46] - t5*beta[47];
    const double t7 = t4*beta[44] - t5*beta[46];
    const double t8 = qd[6]*t1;
    const double t9 = s6*qdd[0] + t8;
    const double t10 = qd[6]*t2;
    const double t11 = c6*qdd[0] - t10;
    const double t12 = c7*t9 + s7*t11 + qd[7]*t3;
    const double t13 = c7*t11 - s7*t9 - qd[7]*t4;
    const double t14 = qdd[6] + qdd[7];
    const double t15 = sr400_tree_geo_D2*qdd[0];
    const double t16 = t10 - t11;
    const double t17 = t15 - sr400_tree_geo_D8*t16;
    const double t18 = t3*t6 + t5*t7 + (t14*beta[45] - (t12*beta[43] + t13*beta[44]));
    const double t19 = t18 + t17*beta[49];
    const double t20 = t4*beta[43] + t3*beta[44] - t5*beta[45];
    const double t21 = t5*t20 + t4*t6 + (t12*beta[44] - t14*beta[46]) + t17*beta[48];
    const double t22 = t2*beta[38] + t1*beta[39] - qd[6]*beta[40];
    const double t23 = t2*beta[37] - qd[6]*beta[39];
    const double t24 = t1*t22 + qd[6]*t23 + (qdd[6]*beta[38] - (t9*beta[36] + t11*beta[37]));
    const double t25 = (t13 - t4*t5)*beta[48] - (t12 + t3*t5)*beta[49];
    const double t26 = t2*beta[36] + t1*beta[37] - qd[6]*beta[38];
    const double t27 = qd[6]*t26 + t2*t22 + (t9*beta[37] - qdd[6]*beta[39]) + t15*beta[41];
    const double t28 = c6*(s7*t19 - c7*t21 - sr400_tree_geo_D8*t25 - t27);
    const double t29 = sr400_tree_geo_D2*(t25 - (t16*beta[41] + (t8 + t9)*beta[42]));
    const double t30 = qd[1] + qd[2];
    const double t31 = s1*qd[0];
    const double t32 = c1*qd[0];
    const double t33 = c2*t31 + s2*t32;
    const double t34 = c3*t30 - s3*t33;
    const double t35 = qd[4] + t34;
    const double t36 = c3*t33 + s3*t30;
    const double t37 = c2*t32 - s2*t31;
    const double t38 = qd[3] - t37;
    const double t39 = c4*t36 - s4*t38;
    const double t40 = c5*t35 - s5*t39;
    const double t41 = c5*t39 + s5*t35;
    const double t42 = c4*t38 + s4*t36;
    const double t43 = qd[5] + t42;
    const double t44 = t41*beta[31] + t40*beta[32] - t43*beta[33];
    const double t45 = t41*beta[30] - t43*beta[32];
    const double t46 = qd[1]*t32;
    const double t47 = s1*qdd[0] + t46;
    const double t48 = qd[1]*t31;
    const double t49 = c1*qdd[0] - t48;
    const double t50 = c2*t47 + s2*t49 + qd[2]*t37;
    const double t51 = qdd[1] + qdd[2];
    const double t52 = c3*t50 + s3*t51 + qd[3]*t34;
    const double t53 = c2*t49 - s2*t47 - qd[2]*t33;
    const double t54 = qdd[3] - t53;
    const double t55 = c4*t52 - s4*t54 - qd[4]*t42;
    const double t56 = c3*t51 - s3*t50 - qd[3]*t36;
    const double t57 = qdd[4] + t56;
    const double t58 = c5*t55 + s5*t57 + qd[5]*t40;
    const double t59 = c5*t57 - s5*t55 - qd[5]*t41;
    const double t60 = c4*t54 + s4*t52 + qd[4]*t39;
    const double t61 = qdd[5] + t60;
    const double t62 = qd[0]*qd[0]*sr400_tree_geo_D2;
    const double t63 = sr400_tree_geo_g*c1 - s1*t62;
    const double t64 = t63 - sr400_tree_geo_D3*(qdd[1] + t31*t32);
    const double t65 = c1*t62 + sr400_tree_geo_g*s1;
    const double t66 = t65 + sr400_tree_geo_D3*(t32*t32 + qd[1]*qd[1]);
    const double t67 = c2*t64 - s2*t66;
    const double t68 = t33*t37;
    const double t69 = t51 + t68;
    const double t70 = t30*t30;
    const double t71 = t33*t33 + t70;
    const double t72 = sr400_tree_geo_RL4*t71 - sr400_tree_geo_D4*t69 + t67;
    const double t73 = c2*t66 + s2*t64;
    const double t74 = t37*t37 + t70;
    const double t75 = t51 - t68;
    const double t76 = sr400_tree_geo_D4*t74 + sr400_tree_geo_RL4*t75 + t73;
    const double t77 = t48 - t49;
    const double t78 = t15 - sr400_tree_geo_D3*t77;
    const double t79 = t53 - t33*t30;
    const double t80 = t50 + t37*t30;
    const double t81 = sr400_tree_geo_D4*t79 - sr400_tree_geo_RL4*t80 + t78;
    const double t82 = c3*t76 + s3*t81;
    const double t83 = c4*t72 - s4*t82;
    const double t84 = t40*t44 + t43*t45 + (t61*beta[31] - (t58*beta[29] + t59*beta[30]));
    const double t85 = t84 - t83*beta[35];
    const double t86 = t41*beta[29] + t40*beta[30] - t43*beta[31];
    const double t87 = t43*t86 + t41*t44 + (t58*beta[30] - t61*beta[32]) - t83*beta[34];
    const double t88 = t39*beta[24] - t42*beta[25] - t35*beta[26];
    const double t89 = t39*beta[23] - t35*beta[25];
    const double t90 = c3*t81 - s3*t76;
    const double t91 = t42*t88 - t35*t89 + (t55*beta[22] - t60*beta[23] - t57*beta[24]);
    const double t92 = c5*t85 + s5*t87 + (t90*beta[28] - t91);
    const double t93 = c4*t82 + s4*t72;
    const double t94 = t41*t45 - t40*t86 + (t61*beta[33] - (t58*beta[31] + t59*beta[32]));
    const double t95 = (c5*t93 + s5*t90)*beta[35] - (c5*t90 - s5*t93)*beta[34] + t94;
    const double t96 = t39*beta[22] - t42*beta[23] - t35*beta[24];
    const double t97 = t95 - (t35*t96 + t39*t88 + (t55*beta[23] - t57*beta[25]) + t90*beta[27]);
    const double t98 = t36*beta[17] + t34*beta[18] - t38*beta[19];
    const double t99 = t36*beta[16] - t38*beta[18];
    const double t100 = t34*t98 + t38*t99 + (t54*beta[17] - (t52*beta[15] + t56*beta[16]));
    const double t101 = c4*t92 - s4*t97 + (t100 - t72*beta[21]);
    const double t102 = t39*t89 + t42*t96 + (t57*beta[26] - (t55*beta[24] - t60*beta[25]));
    const double t103 = s5*t85 - c5*t87 + (t83*beta[27] - t93*beta[28] - t102);
    const double t104 = t36*beta[15] + t34*beta[16] - t38*beta[17];
    const double t105 = t72*beta[20] - (t38*t104 + t36*t98 + (t52*beta[16] - t54*beta[18])) + t103;
    const double t106 = t43*t43;
    const double t107 = t41*t40;
    const double t108 = (t40*t40 + t106)*beta[34] + (t61 - t107)*beta[35];
    const double t109 = (t41*t41 + t106)*beta[35] - (t61 + t107)*beta[34];
    const double t110 = t35*t35;
    const double t111 = t39*t42;
    const double t112 = c5*t108 - s5*t109 + ((t42*t42 + t110)*beta[27] + (t57 + t111)*beta[28]);
    const double t113 = (t59 - t41*t43)*beta[34] - (t58 + t40*t43)*beta[35];
    const double t114 = (t57 - t111)*beta[27] - (t39*t39 + t110)*beta[28] + t113;
    const double t115 = t38*t38;
    const double t116 = t36*t34;
    const double t117 = c4*t112 + s4*t114 + ((t34*t34 + t115)*beta[20] + (t54 - t116)*beta[21]);
    const double t118 = s5*t108 + c5*t109 - ((t60 + t39*t35)*beta[27] + (t55 - t42*t35)*beta[28]);
    const double t119 = (t36*t36 + t115)*beta[21] - (t54 + t116)*beta[20] + t118;
    const double t120 = s3*t117 + c3*t119;
    const double t121 = t33*beta[10] + t37*beta[11] - t30*beta[12];
    const double t122 = t33*beta[9] - t30*beta[11];
    const double t123 = t37*t121 + t30*t122 + (t51*beta[10] - (t50*beta[8] + t53*beta[9]));
    const double t124 = c3*t101 - s3*t105 + sr400_tree_geo_RL4*t120 + (t123 + t78*beta[14]);
    const double t125 = t36*t99 - t34*t104 + (t54*beta[19] - (t52*beta[17] + t56*beta[18]));
    const double t126 = s4*t92 + c4*t97 + (t82*beta[21] - t90*beta[20] + t125);
    const double t127 = t33*beta[8] + t37*beta[9] - t30*beta[10];
    const double t128 = t30*t127 + t33*t121 + (t50*beta[9] - t51*beta[11]) + t78*beta[13];
    const double t129 = t126 - sr400_tree_geo_D4*t120 - t128;
    const double t130 = t31*beta[3] + t32*beta[4] - qd[1]*beta[5];
    const double t131 = t31*beta[2] - qd[1]*beta[4];
    const double t132 = t32*t130 + qd[1]*t131 + (qdd[1]*beta[3] - (t47*beta[1] + t49*beta[2]));
    const double t133 = t79*beta[13] - t80*beta[14] + t120;
    const double t134 = t31*beta[1] + t32*beta[2] - qd[1]*beta[3];
    const double t135 = qd[1]*t134 + t31*t130 + (t47*beta[2] - qdd[1]*beta[4]) + t15*beta[6];
    const double t136 = c1*(s2*t124 + c2*t129 - sr400_tree_geo_D3*t133 - t135);
    const double t137 = sr400_tree_geo_D2*(t133 - (t77*beta[6] + (t46 + t47)*beta[7]));
    const double t138 = s1*(c2*t124 - s2*t129 + (t132 + t15*beta[7])) + t136 - t137;
    const double t139 = s6*(c7*t19 + s7*t21 + (t24 + t15*beta[42])) + t28 - t29 + t138;
    tau[0] = qdd[0]*beta[0] - t139;
    const double t140 = s4*t112 - c4*t114 + ((t52 + t34*t38)*beta[21] - (t56 - t36*t38)*beta[20]);
    const double t141 = c3*t117 - s3*t119;
    const double t142 = t33*t122 - t37*t127 + (t51*beta[12] - (t50*beta[10] + t53*beta[11]));
    const double t143 = s3*t101 + c3*t105 + (sr400_tree_geo_D4*t140 - sr400_tree_geo_RL4*t141);
    const double t144 = t67*beta[13] - t73*beta[14] - t142 + t143;
    const double t145 = s2*(t74*beta[13] + t75*beta[14] + t141);
    const double t146 = t31*t131 - t32*t134 + (qdd[1]*beta[5] - (t47*beta[3] + t49*beta[4]));
    const double t147 = t144 + sr400_tree_geo_D3*(t145 + c2*(t71*beta[14] - t69*beta[13] + t140));
    tau[1] = t65*beta[7] - t63*beta[6] + t146 - t147;
    tau[2] = -t144;
    tau[3] = t126;
    tau[4] = -t103;
    tau[5] = t95;
    const double t148 = sr400_tree_geo_g*c6 - s6*t62;
    const double t149 = t148 - sr400_tree_geo_D8*(qdd[6] + t2*t1);
    const double t150 = c6*t62 + sr400_tree_geo_g*s6;
    const double t151 = t150 + sr400_tree_geo_D8*(t1*t1 + qd[6]*qd[6]);
    const double t152 = t4*t7 - t3*t20 + (t14*beta[47] - (t12*beta[45] + t13*beta[46]));
    const double t153 = (c7*t151 + s7*t149)*beta[49] - (c7*t149 - s7*t151)*beta[48] + t152;
    const double t154 = t5*t5;
    const double t155 = t4*t3;
    const double t156 = s7*((t3*t3 + t154)*beta[48] + (t14 - t155)*beta[49]);
    const double t157 = t156 + c7*((t4*t4 + t154)*beta[49] - (t14 + t155)*beta[48]);
    const double t158 = t2*t23 - t1*t26 + (qdd[6]*beta[40] - (t9*beta[38] + t11*beta[39]));
    tau[6] = t153 - sr400_tree_geo_D8*t157 + (t150*beta[42] - t148*beta[41] + t158);
    tau[7] = t153;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 157 additions, 190 multiplications. */
void sr400_tree_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    MODELER_ALL_ZEROS(M, 64);

    const double k1 = sr400_tree_geo_D8*2.0;
    const double k2 = sr400_tree_geo_D2*2.0;
    const double k3 = sr400_tree_geo_D4*2.0;
    const double k4 = sr400_tree_geo_RL4*2.0;
    const double k5 = sr400_tree_geo_D3*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    const double t1 = s5*beta[35] - c5*beta[34];
    const double t2 = beta[27] - t1;
    const double t3 = c4*beta[28] + s4*t2;
    const double t4 = beta[14] + t3;
    const double t5 = c5*beta[35] + s5*beta[34];
    const double t6 = beta[21] + t5;
    const double t7 = s4*beta[28] - c4*t2;
    const double t8 = beta[20] - t7;
    const double t9 = s3*t6 - c3*t8;
    const double t10 = beta[13] - t9;
    const double t11 = c2*t4 + s2*t10;
    const double t12 = s2*t4 - c2*t10;
    const double t13 = c7*beta[49] + s7*beta[48];
    const double t14 = s7*beta[49] - c7*beta[48];
    const double t15 = c7*beta[43] - s7*beta[44];
    const double t16 = c7*beta[44];
    const double t17 = s7*t16;
    const double t18 = s7*t15 + c7*t16 + beta[37] - sr400_tree_geo_D8*t13;
    const double t19 = k1*t14;
    const double t20 = c6*(s6*t18 + c6*(t17 + s7*(s7*beta[43] + t16) - t19));
    const double t21 = s6*(s6*(c7*t15 - t17 + beta[36]) + c6*t18) + t20 + beta[0];
    const double t22 = c5*beta[29] - s5*beta[30];
    MODELER_ZEROS(M + 14, 2);
    const double t23 = c5*beta[30];
    const double t24 = s5*t23;
    const double t25 = c5*t22 - t24 + beta[22];
    const double t26 = c5*beta[31] - s5*beta[32];
    const double t27 = beta[23] + t26;
    const double t28 = s4*t27;
    const double t29 = c4*t25 - t28;
    const double t30 = s4*beta[33];
    const double t31 = c4*t27;
    const double t32 = t30 - t31;
    const double t33 = c4*t29 + s4*t32 + beta[15];
    const double t34 = beta[24] - (s5*t22 + c5*t23);
    const double t35 = s5*beta[31] + c5*beta[32];
    const double t36 = beta[25] - t35;
    const double t37 = c4*t34 - s4*t36;
    const double t38 = beta[16] - t37;
    const double t39 = s3*t38;
    const double t40 = c3*t33 - t39;
    const double t41 = t24 + s5*(s5*beta[29] + t23) + beta[26];
    const double t42 = s3*t41;
    const double t43 = c3*t38;
    const double t44 = t42 - t43;
    MODELER_ZEROS(M + 22, 2);
    const double t45 = k4*t3;
    const double t46 = c3*t40 + s3*t44 + beta[8] + t45;
    const double t47 = s4*t29 - c4*t32 + beta[17];
    const double t48 = s4*t34 + c4*t36;
    const double t49 = beta[18] - t48;
    const double t50 = c3*t47 - s3*t49;
    const double t51 = sr400_tree_geo_RL4*t9;
    const double t52 = beta[9] + t50 + (t51 - sr400_tree_geo_D4*t3);
    const double t53 = s2*t52;
    const double t54 = c2*t46 - t53;
    const double t55 = c2*t52;
    const double t56 = c4*beta[33];
    const double t57 = s4*(s4*t25 + t31) + c4*(t56 + t28) + beta[19];
    const double t58 = k3*t9;
    const double t59 = t57 - t58;
    const double t60 = t55 - s2*t59;
    const double t61 = s2*t54 + c2*t60 + beta[2] - sr400_tree_geo_D3*t11;
    const double t62 = k5*t12;
    const double t63 = c1*(s1*t61 + c1*(s2*(s2*t46 + t55) + c2*(t53 + c2*t59) - t62));
    const double t64 = k2*(s6*(beta[42] + t13) - c6*(beta[41] - t14)) - t21;
    const double t65 = t64 - (s1*(s1*(c2*t54 - s2*t60 + beta[1]) + c1*t61) + t63);
    M[0] = -(k2*(s1*(beta[7] + t11) - c1*(beta[6] - t12)) + t65);
    MODELER_ZEROS(M + 30, 2);
    const double t66 = c3*t6 + s3*t8;
    const double t67 = c3*t44 - s3*t40 + beta[10] + sr400_tree_geo_D4*t66;
    const double t68 = sr400_tree_geo_RL4*t66;
    const double t69 = s3*t47 + c3*t49;
    const double t70 = beta[11] - t69 + t68;
    const double t71 = c2*t67 - s2*t70;
    const double t72 = s2*t67 + c2*t70;
    const double t73 = s1*(beta[3] + t71 + sr400_tree_geo_D3*t66) + c1*(beta[4] + t72);
    M[1] = -t73;
    const double t74 = s1*t71 + c1*t72;
    M[2] = -t74;
    const double t75 = t50 + t51;
    const double t76 = t57 - sr400_tree_geo_D4*t9;
    const double t77 = s1*(c2*t75 - s2*t76) + c1*(s2*t75 + c2*t76 - sr400_tree_geo_D3*t9);
    const double t78 = t77 - sr400_tree_geo_D2*t9;
    M[3] = -t78;
    const double t79 = s3*t3;
    const double t80 = c3*t37 + t42 + sr400_tree_geo_RL4*t79;
    const double t81 = t48 - sr400_tree_geo_D4*t79;
    const double t82 = s1*(c2*t80 - s2*t81) + c1*(s2*t80 + c2*t81 - sr400_tree_geo_D3*t79);
    const double t83 = t82 - sr400_tree_geo_D2*t79;
    MODELER_ZEROS(M + 38, 2);
    M[4] = -t83;
    const double t84 = c4*t26 - t30;
    const double t85 = c4*t5;
    const double t86 = s3*t85 + c3*t1;
    const double t87 = c3*t84 - s3*t35 + sr400_tree_geo_RL4*t86;
    const double t88 = s4*t26 + t56;
    const double t89 = t88 - sr400_tree_geo_D4*t86;
    const double t90 = s1*(c2*t87 - s2*t89) + c1*(s2*t87 + c2*t89 - sr400_tree_geo_D3*t86);
    const double t91 = t90 - sr400_tree_geo_D2*t86;
    M[5] = -t91;
    const double t92 = c7*beta[45] - s7*beta[46];
    const double t93 = s7*beta[45] + c7*beta[46];
    const double t94 = s6*(beta[38] + t92) + c6*(beta[39] + t93);
    M[6] = -t94;
    const double t95 = s6*t92 + c6*t93;
    M[7] = -t95;
    M[8] = -t73;
    const double t96 = c3*t41;
    const double t97 = s3*(s3*t33 + t43) + c3*(t96 + t39) + beta[12] + (t45 - t58);
    M[9] = beta[5] + t97 - t62;
    const double t98 = t97 - sr400_tree_geo_D3*t12;
    M[10] = t98;
    MODELER_ZEROS(M + 46, 2);
    const double t99 = t69 - t68;
    const double t100 = t99 + s2*t66*sr400_tree_geo_D3;
    M[11] = -t100;
    const double t101 = c3*t3;
    const double t102 = s3*t37 - t96 + (sr400_tree_geo_D4*t7 - sr400_tree_geo_RL4*t101);
    const double t103 = t102 + sr400_tree_geo_D3*(s2*t101 + c2*t7);
    M[12] = -t103;
    const double t104 = s4*t5;
    const double t105 = c3*t85 - s3*t1;
    const double t106 = s3*t84 + c3*t35 + (sr400_tree_geo_D4*t104 - sr400_tree_geo_RL4*t105);
    const double t107 = t106 + sr400_tree_geo_D3*(s2*t105 + c2*t104);
    M[13] = -t107;
    M[16] = -t74;
    M[17] = t98;
    M[18] = t97;
    M[19] = -t99;
    M[20] = -t102;
    M[21] = -t106;
    M[24] = -t78;
    M[25] = -t100;
    M[26] = -t99;
    M[27] = t57;
    MODELER_ZEROS(M + 49, 5);
    M[28] = t48;
    M[29] = t88;
    M[32] = -t83;
    M[33] = -t103;
    M[34] = -t102;
    M[35] = t48;
    M[36] = t41;
    M[37] = -t35;
    M[40] = -t91;
    M[41] = -t107;
    M[42] = -t106;
    M[43] = t88;
    M[44] = -t35;
    M[45] = beta[33];
    M[48] = -t94;
    M[54] = beta[40] + beta[47] - t19;
    const double t108 = beta[47] - sr400_tree_geo_D8*t14;
    M[55] = t108;
    M[56] = -t95;
    M[62] = t108;
    M[63] = beta[47];
    MODELER_ZEROS(M + 57, 5);
}

/* Torques that hold the robot still, without friction.
 * 29 additions, 52 multiplications. */
void sr400_tree_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    const double t1 = sr400_tree_geo_g*c1;
    const double t2 = sr400_tree_geo_g*s1;
    const double t3 = c2*t1 - s2*t2;
    const double t4 = c2*t2 + s2*t1;
    const double t5 = c3*t4;
    const double t6 = c4*t3 - s4*t5;
    const double t7 = beta[35]*t6;
    const double t8 = beta[34]*t6;
    const double t9 = s3*t4;
    const double t10 = c5*t7 + s5*t8 + beta[28]*t9;
    const double t11 = c4*t5 + s4*t3;
    const double t12 = beta[34]*(c5*t9 + s5*t11) + beta[35]*(c5*t11 - s5*t9);
    const double t13 = t12 + beta[27]*t9;
    const double t14 = s5*t7 - c5*t8 + (beta[28]*t11 - beta[27]*t6);
    const double t15 = s3*(c4*t10 + s4*t13 + beta[21]*t3) + c3*(t14 - beta[20]*t3);
    const double t16 = beta[14]*t4 - beta[13]*t3 + t15;
    tau[1] = t2*beta[7] - t1*beta[6] + t16;
    tau[2] = t16;
    tau[3] = beta[20]*t9 + beta[21]*t5 - (s4*t10 - c4*t13);
    tau[4] = t14;
    tau[5] = t12;
    const double t17 = sr400_tree_geo_g*c6;
    const double t18 = sr400_tree_geo_g*s6;
    const double t19 = beta[48]*(c7*t17 - s7*t18) - beta[49]*(c7*t18 + s7*t17);
    tau[6] = -(t17*beta[41] - t18*beta[42] + t19);
    tau[7] = -t19;
}

/* Coriolis and centripetal torques.
 * 267 additions, 376 multiplications. */
void sr400_tree_coriolis(const double *q, const double *qd, const double *beta,
                         double *MODELER_RESTRICT tau)
{
    const double k1 = sr400_tree_geo_D8*2.0;
    const double k2 = sr400_tree_geo_D4*2.0;
    const double k3 = sr400_tree_geo_RL4*2.0;
    const double k4 = sr400_tree_geo_D3*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    const double t1 = c6*qd[0];
    const double t2 = s6*qd[0];
    const double t3 = c7*t1 - s7*t2;
    const double t4 = qd[6] + qd[7];
    const double t5 = t3*t4;
    const double t6 = c7*t2 + s7*t1;
    const double t7 = t6*t4;
    const double t8 = t6*beta[45] + t3*beta[46] - t4*beta[47];
    const double t9 = t6*beta[44] - t4*beta[46];
    const double t10 = qd[6]*t2;
    const double t11 = k1*t10;
    const double t12 = t5*beta[43] - t7*beta[44] - (t3*t8 + t4*t9) + beta[49]*t11;
    const double t13 = t6*beta[43] + t3*beta[44] - t4*beta[45];
    const double t14 = t4*t13 + t6*t8 + t5*beta[44] - beta[48]*t11;
    const double t15 = qd[6]*t1;
    const double t16 = t2*beta[38] + t1*beta[39] - qd[6]*beta[40];
    const double t17 = t2*beta[37] - qd[6]*beta[39];
    const double t18 = c7*t12 - s7*t14 + (t15*beta[36] - t10*beta[37] - (t1*t16 + qd[6]*t17));
    const double t19 = 2.0*t7*beta[48] + 2.0*t5*beta[49];
    const double t20 = t2*beta[36] + t1*beta[37] - qd[6]*beta[38];
    const double t21 = s7*t12 + c7*t14 - sr400_tree_geo_D8*t19;
    const double t22 = sr400_tree_geo_D2*(2.0*t10*beta[41] + 2.0*t15*beta[42] + t19);
    const double t23 = qd[1] + qd[2];
    const double t24 = s1*qd[0];
    const double t25 = c1*qd[0];
    const double t26 = c2*t24 + s2*t25;
    const double t27 = c3*t23 - s3*t26;
    const double t28 = qd[4] + t27;
    const double t29 = c3*t26 + s3*t23;
    const double t30 = c2*t25 - s2*t24;
    const double t31 = qd[3] - t30;
    const double t32 = c4*t29 - s4*t31;
    const double t33 = c5*t28 - s5*t32;
    const double t34 = c4*t31 + s4*t29;
    const double t35 = t30*t23;
    const double t36 = qd[3]*t27 + c3*t35;
    const double t37 = t26*t23;
    const double t38 = s4*t37 - c4*t36 + qd[4]*t34;
    const double t39 = qd[3]*t29 + s3*t35;
    const double t40 = qd[5]*t33 - (c5*t38 + s5*t39);
    const double t41 = c5*t32 + s5*t28;
    const double t42 = c5*t39 - s5*t38 + qd[5]*t41;
    const double t43 = c4*t37 + s4*t36 + qd[4]*t32;
    const double t44 = qd[5] + t34;
    const double t45 = t41*beta[31] + t33*beta[32] - t44*beta[33];
    const double t46 = t41*beta[30] - t44*beta[32];
    const double t47 = qd[0]*qd[0]*sr400_tree_geo_D2;
    const double t48 = s1*t47;
    const double t49 = t48 + t24*t25*sr400_tree_geo_D3;
    const double t50 = c1*t47;
    const double t51 = t50 + sr400_tree_geo_D3*(t25*t25 + qd[1]*qd[1]);
    const double t52 = c2*t49 + s2*t51;
    const double t53 = t23*t23;
    const double t54 = t26*t26 + t53;
    const double t55 = t26*t30;
    const double t56 = sr400_tree_geo_D4*t55 - sr400_tree_geo_RL4*t54 + t52;
    const double t57 = c2*t51 - s2*t49;
    const double t58 = t30*t30 + t53;
    const double t59 = sr400_tree_geo_D4*t58 - sr400_tree_geo_RL4*t55 + t57;
    const double t60 = qd[1]*t24;
    const double t61 = k4*t60;
    const double t62 = k2*t37 + k3*t35 + t61;
    const double t63 = c3*t59 - s3*t62;
    const double t64 = c4*t56 + s4*t63;
    const double t65 = beta[29]*t40 - beta[30]*t42 - beta[31]*t43 - (t33*t45 + t44*t46);
    const double t66 = t65 - beta[35]*t64;
    const double t67 = t41*beta[29] + t33*beta[30] - t44*beta[31];
    const double t68 = beta[30]*t40 - beta[32]*t43 + (t44*t67 + t41*t45) + beta[34]*t64;
    const double t69 = t32*beta[24] - t34*beta[25] - t28*beta[26];
    const double t70 = t32*beta[23] - t28*beta[25];
    const double t71 = c3*t62 + s3*t59;
    const double t72 = beta[22]*t38 + beta[23]*t43 - beta[24]*t39 + (t28*t70 - t34*t69);
    const double t73 = c5*t66 - s5*t68 + (beta[28]*t71 - t72);
    const double t74 = c4*t63 - s4*t56;
    const double t75 = beta[31]*t40 - beta[32]*t42 - beta[33]*t43 + (t33*t67 - t41*t46);
    const double t76 = t75 - (beta[34]*(c5*t71 + s5*t74) + beta[35]*(c5*t74 - s5*t71));
    const double t77 = t32*beta[22] - t34*beta[23] - t28*beta[24];
    const double t78 = t76 - (beta[23]*t38 - beta[25]*t39 - (t28*t77 + t32*t69) + beta[27]*t71);
    const double t79 = t29*beta[17] + t27*beta[18] - t31*beta[19];
    const double t80 = t29*beta[16] - t31*beta[18];
    const double t81 = beta[15]*t36 - beta[16]*t39 - t37*beta[17] - (t27*t79 + t31*t80);
    const double t82 = c4*t73 - s4*t78 + (t81 - beta[21]*t56);
    const double t83 = beta[24]*t38 + beta[25]*t43 - beta[26]*t39 + (t32*t70 + t34*t77);
    const double t84 = s5*t66 + c5*t68 + (beta[27]*t64 + beta[28]*t74 + t83);
    const double t85 = t29*beta[15] + t27*beta[16] - t31*beta[17];
    const double t86 = beta[16]*t36 - t37*beta[18] + (t31*t85 + t29*t79) + beta[20]*t56 + t84;
    const double t87 = t44*t44;
    const double t88 = t41*t33;
    const double t89 = (t33*t33 + t87)*beta[34] - beta[35]*(t88 - t43);
    const double t90 = beta[34]*(t88 + t43) - (t41*t41 + t87)*beta[35];
    const double t91 = t28*t28;
    const double t92 = t32*t34;
    const double t93 = c5*t89 + s5*t90 + ((t34*t34 + t91)*beta[27] + beta[28]*(t92 - t39));
    const double t94 = beta[34]*(t41*t44 + t42) + beta[35]*(t33*t44 + t40);
    const double t95 = beta[27]*(t92 + t39) + (t32*t32 + t91)*beta[28] + t94;
    const double t96 = t31*t31;
    const double t97 = t29*t27;
    const double t98 = c4*t93 - s4*t95 + ((t27*t27 + t96)*beta[20] + beta[21]*(t37 - t97));
    const double t99 = s5*t89 - c5*t90 + (beta[28]*(t34*t28 + t38) - beta[27]*(t32*t28 + t43));
    const double t100 = (t29*t29 + t96)*beta[21] - beta[20]*(t37 + t97) + t99;
    const double t101 = s3*t98 + c3*t100;
    const double t102 = t26*beta[10] + t30*beta[11] - t23*beta[12];
    const double t103 = t26*beta[9] - t23*beta[11];
    const double t104 = t35*beta[8] - t37*beta[9] - (t30*t102 + t23*t103) + beta[14]*t61;
    const double t105 = c3*t82 - s3*t86 - sr400_tree_geo_RL4*t101 + t104;
    const double t106 = beta[17]*t36 - beta[18]*t39 - t37*beta[19] + (t27*t85 - t29*t80);
    const double t107 = s4*t73 + c4*t78 + (t106 - (beta[20]*t71 + beta[21]*t63));
    const double t108 = t26*beta[8] + t30*beta[9] - t23*beta[10];
    const double t109 = t23*t108 + t26*t102 + t35*beta[9] - beta[13]*t61;
    const double t110 = t107 + sr400_tree_geo_D4*t101 + t109;
    const double t111 = qd[1]*t25;
    const double t112 = t24*beta[3] + t25*beta[4] - qd[1]*beta[5];
    const double t113 = t24*beta[2] - qd[1]*beta[4];
    const double t114 = c2*t105 - s2*t110 + (t111*beta[1] - t60*beta[2] - (t25*t112 + qd[1]*t113));
    const double t115 = t101 - (2.0*t37*beta[13] + 2.0*t35*beta[14]);
    const double t116 = t24*beta[1] + t25*beta[2] - qd[1]*beta[3];
    const double t117 = s2*t105 + c2*t110 + sr400_tree_geo_D3*t115;
    const double t118 = sr400_tree_geo_D2*(t115 - (2.0*t60*beta[6] + 2.0*t111*beta[7]));
    const double t119 = s1*t114 + c1*(qd[1]*t116 + t24*t112 + t111*beta[2] + t117) + t118;
    tau[0] = s6*t18 + c6*(qd[6]*t20 + t2*t16 + t15*beta[37] + t21) - t22 + t119;
    const double t120 = s4*t93 + c4*t95 + (beta[20]*(t29*t31 + t39) + beta[21]*(t27*t31 + t36));
    const double t121 = c3*t98 - s3*t100;
    const double t122 = t35*beta[10] - t37*beta[11] + (t30*t108 - t26*t103);
    const double t123 = s3*t82 + c3*t86 + (sr400_tree_geo_RL4*t121 - sr400_tree_geo_D4*t120);
    const double t124 = beta[13]*t52 + beta[14]*t57 - t122 + t123;
    const double t125 = s2*(t58*beta[13] - t55*beta[14] + t121);
    const double t126 = t111*beta[3] - t60*beta[4] + (t25*t116 - t24*t113);
    const double t127 = t124 - sr400_tree_geo_D3*(t125 + c2*(t54*beta[14] - t55*beta[13] + t120));
    tau[1] = t48*beta[6] + t50*beta[7] - t126 + t127;
    tau[2] = t124;
    tau[3] = -t107;
    tau[4] = t84;
    tau[5] = -t76;
    const double t128 = s6*t47;
    const double t129 = t128 + t2*t1*sr400_tree_geo_D8;
    const double t130 = c6*t47;
    const double t131 = t130 + sr400_tree_geo_D8*(t1*t1 + qd[6]*qd[6]);
    const double t132 = beta[48]*(c7*t129 + s7*t131) + beta[49]*(c7*t131 - s7*t129);
    const double t133 = t5*beta[45] - t7*beta[46] + (t3*t13 - t6*t9) - t132;
    const double t134 = t4*t4;
    const double t135 = t6*t3;
    const double t136 = s7*((t3*t3 + t134)*beta[48] - t135*beta[49]);
    const double t137 = sr400_tree_geo_D8*(t136 - c7*(t135*beta[48] - (t6*t6 + t134)*beta[49]));
    const double t138 = t15*beta[38] - t10*beta[39] + (t1*t20 - t2*t17);
    tau[6] = -(t133 + t137 + (t138 - (t128*beta[41] + t130*beta[42])));
    tau[7] = -t133;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void sr400_tree_friction(const double *qd, const double *beta, double *MODELER_RESTRICT tau)
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
    tau[6] = 0.0;
    tau[7] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 62 additions, 36 multiplications. */
void sr400_tree_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = sr400_tree_geo_D2*sr400_tree_geo_D2;
    const double k2 = sr400_tree_geo_D8*sr400_tree_geo_D8;
    const double k3 = sr400_tree_geo_D4*sr400_tree_geo_D4;
    const double k4 = sr400_tree_geo_RL4*2.0;
    const double k5 = sr400_tree_geo_RL4*sr400_tree_geo_RL4;
    const double k6 = sr400_tree_geo_D4*sr400_tree_geo_RL4;
    const double k7 = sr400_tree_geo_D3*sr400_tree_geo_D3;
    const double k8 = k1 + k7;
    const double k9 = k3 + k8;
    const double k10 = k1 + k2;
    const double k11 = k3 - k5;
    const double k12 = k3 + k5;

    const double t1 = chi[5] + chi[13] + k1*chi[19] + chi[23] + k8*chi[29] + k9*chi[39];
    const double t2 = t1 + k9*chi[49] + k9*chi[59] + chi[63] + k1*chi[69] + chi[73];
    beta[0] = t2 + k10*chi[79];
    const double t3 = k7*chi[29];
    const double t4 = k7*chi[39];
    const double t5 = k7*chi[49];
    const double t6 = k7*chi[59];
    beta[1] = chi[10] - chi[13] - t3 - t4 - t5 - t6;
    beta[2] = chi[11];
    beta[3] = chi[12] - sr400_tree_geo_D3*chi[28];
    beta[4] = chi[14];
    beta[5] = chi[15] + t3 + t4 + t5 + t6;
    const double t7 = chi[16] + sr400_tree_geo_D3*chi[29] + sr400_tree_geo_D3*chi[39];
    beta[6] = t7 + sr400_tree_geo_D3*chi[49] + sr400_tree_geo_D3*chi[59];
    beta[7] = chi[17];
    const double t8 = k4*chi[38];
    beta[8] = chi[20] - chi[23] + chi[33] + t8 - k11*chi[39] - k11*chi[49] - k11*chi[59];
    beta[9] = chi[21] - sr400_tree_geo_D4*chi[38] - k6*chi[39] - k6*chi[49] - k6*chi[59];
    beta[10] = chi[22];
    beta[11] = chi[24];
    beta[12] = chi[25] + chi[33] + t8 + k12*chi[39] + k12*chi[49] + k12*chi[59];
    const double t9 = chi[26] + sr400_tree_geo_D4*chi[39] + sr400_tree_geo_D4*chi[49];
    beta[13] = t9 + sr400_tree_geo_D4*chi[59];
    const double t10 = chi[27] + chi[38] + sr400_tree_geo_RL4*chi[39];
    beta[14] = t10 + sr400_tree_geo_RL4*chi[49] + sr400_tree_geo_RL4*chi[59];
    beta[15] = chi[30] - chi[33] + chi[43];
    beta[16] = chi[31];
    beta[17] = chi[32];
    beta[18] = chi[34];
    beta[19] = chi[35] + chi[43];
    beta[20] = chi[36];
    beta[21] = chi[37] - chi[48];
    beta[22] = chi[40] - chi[43] + chi[53];
    beta[23] = chi[41];
    beta[24] = chi[42];
    beta[25] = chi[44];
    beta[26] = chi[45] + chi[53];
    beta[27] = chi[46];
    beta[28] = chi[47] + chi[58];
    beta[29] = chi[50] - chi[53];
    beta[30] = chi[51];
    beta[31] = chi[52];
    beta[32] = chi[54];
    beta[33] = chi[55];
    beta[34] = chi[56];
    beta[35] = chi[57];
    const double t11 = k2*chi[79];
    beta[36] = chi[60] - chi[63] - t11;
    beta[37] = chi[61];
    beta[38] = chi[62] - sr400_tree_geo_D8*chi[78];
    beta[39] = chi[64];
    beta[40] = chi[65] + t11;
    beta[41] = chi[66] + sr400_tree_geo_D8*chi[79];
    beta[42] = chi[67];
    beta[43] = chi[70] - chi[73];
    beta[44] = chi[71];
    beta[45] = chi[72];
    beta[46] = chi[74];
    beta[47] = chi[75];
    beta[48] = chi[76];
    beta[49] = chi[77];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 38 additions, 80 multiplications. */
void sr400_tree_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    T[2] = 0.0;
    T[3] = 0.0;
    T[6] = 0.0;
    T[7] = 0.0;
    T[8] = 0.0;
    T[9] = 0.0;
    T[11] = 0.0;
    T[22] = 0.0;
    T[23] = 0.0;
    T[34] = 0.0;
    T[82] = 0.0;
    T[83] = 0.0;
    T[94] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);

    T[0] = c0;
    T[1] = -s0;
    T[4] = s0;
    T[5] = c0;
    T[10] = 1.0;
    const double t1 = c0*c1;
    T[12] = t1;
    const double t2 = c0*s1;
    T[13] = -t2;
    T[14] = -s0;
    const double t3 = sr400_tree_geo_D2*c0;
    T[15] = t3;
    const double t4 = s0*c1;
    T[16] = t4;
    const double t5 = s0*s1;
    T[17] = -t5;
    T[18] = c0;
    const double t6 = sr400_tree_geo_D2*s0;
    T[19] = t6;
    T[20] = -s1;
    T[21] = -c1;
    const double t7 = c2*t1 - s2*t2;
    T[24] = t7;
    const double t8 = c2*t2 + s2*t1;
    T[25] = -t8;
    T[26] = -s0;
    const double t9 = t3 + sr400_tree_geo_D3*t1;
    T[27] = t9;
    const double t10 = c2*t4 - s2*t5;
    T[28] = t10;
    const double t11 = c2*t5 + s2*t4;
    T[29] = -t11;
    T[30] = c0;
    const double t12 = t6 + sr400_tree_geo_D3*t4;
    T[31] = t12;
    const double t13 = s1*c2 + c1*s2;
    T[32] = -t13;
    const double t14 = c1*c2 - s1*s2;
    T[33] = -t14;
    const double t15 = sr400_tree_geo_D3*s1;
    T[35] = -t15;
    const double t16 = c3*t7 + s0*s3;
    T[36] = t16;
    const double t17 = s0*c3 - s3*t7;
    T[37] = t17;
    T[38] = -t8;
    const double t18 = t9 + sr400_tree_geo_D4*t7 - sr400_tree_geo_RL4*t8;
    T[39] = t18;
    const double t19 = c3*t10 - c0*s3;
    T[40] = t19;
    const double t20 = c0*c3 + s3*t10;
    T[41] = -t20;
    T[42] = -t11;
    const double t21 = t12 + sr400_tree_geo_D4*t10 - sr400_tree_geo_RL4*t11;
    T[43] = t21;
    const double t22 = c3*t13;
    T[44] = -t22;
    const double t23 = s3*t13;
    T[45] = t23;
    T[46] = -t14;
    const double t24 = t15 + sr400_tree_geo_D4*t13 + sr400_tree_geo_RL4*t14;
    T[47] = -t24;
    const double t25 = c4*t16 - s4*t8;
    T[48] = t25;
    const double t26 = c4*t8 + s4*t16;
    T[49] = -t26;
    T[50] = -t17;
    T[51] = t18;
    const double t27 = c4*t19 - s4*t11;
    T[52] = t27;
    const double t28 = c4*t11 + s4*t19;
    T[53] = -t28;
    T[54] = t20;
    T[55] = t21;
    const double t29 = c4*t22 + s4*t14;
    T[56] = -t29;
    const double t30 = c4*t14 - s4*t22;
    T[57] = -t30;
    T[58] = -t23;
    T[59] = -t24;
    T[60] = c5*t25 + s5*t17;
    T[61] = c5*t17 - s5*t25;
    T[62] = -t26;
    T[63] = t18;
    T[64] = c5*t27 - s5*t20;
    T[65] = -(c5*t20 + s5*t27);
    T[66] = -t28;
    T[67] = t21;
    T[68] = s5*t23 - c5*t29;
    T[69] = c5*t23 + s5*t29;
    T[70] = -t30;
    T[71] = -t24;
    const double t31 = c0*c6;
    T[72] = t31;
    const double t32 = c0*s6;
    T[73] = -t32;
    T[74] = -s0;
    T[75] = t3;
    const double t33 = s0*c6;
    T[76] = t33;
    const double t34 = s0*s6;
    T[77] = -t34;
    T[78] = c0;
    T[79] = t6;
    T[80] = -s6;
    T[81] = -c6;
    T[84] = c7*t31 - s7*t32;
    T[85] = -(c7*t32 + s7*t31);
    T[86] = -s0;
    T[87] = t3 + sr400_tree_geo_D8*t31;
    T[88] = c7*t33 - s7*t34;
    T[89] = -(c7*t34 + s7*t33);
    T[90] = c0;
    T[91] = t6 + sr400_tree_geo_D8*t33;
    T[92] = -(s6*c7 + c6*s7);
    T[93] = s6*s7 - c6*c7;
    T[95] = -sr400_tree_geo_D8*s6;
}
