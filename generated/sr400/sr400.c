/* SR400, 6R arm with a parallelogram
 *
 * Functions of sr400.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "sr400.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DSR400_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef SR400_GEO_g
#define SR400_GEO_g 9.81
#endif
#ifndef SR400_GEO_D2
#define SR400_GEO_D2 0.3
#endif
#ifndef SR400_GEO_D3
#define SR400_GEO_D3 0.75
#endif
#ifndef SR400_GEO_D4
#define SR400_GEO_D4 0.15
#endif
#ifndef SR400_GEO_RL4
#define SR400_GEO_RL4 0.8
#endif
#ifndef SR400_GEO_D8
#define SR400_GEO_D8 0.35
#endif

static const double sr400_geo_g = SR400_GEO_g;
static const double sr400_geo_D2 = SR400_GEO_D2;
static const double sr400_geo_D3 = SR400_GEO_D3;
static const double sr400_geo_D4 = SR400_GEO_D4;
static const double sr400_geo_RL4 = SR400_GEO_RL4;
static const double sr400_geo_D8 = SR400_GEO_D8;

const int sr400_nonzero_row[SR400_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5
};

const int sr400_nonzero_column[SR400_NONZEROS] = {
    0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
    28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 1, 2, 3, 4, 5, 6, 7, 13, 14, 20, 21, 27, 28, 34, 35,
    38, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 22, 23,
    24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 29, 30, 31, 32, 33, 34, 35, 8, 9, 10, 11, 12,
    13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36,
    37, 38
};

const char *sr400_signature(void)
{
    return "805eb0618315098c";
}

void sr400_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, SR400_JOINTS},
        {qd, SR400_JOINTS},
        {qdd, SR400_JOINTS},
    };

    modeler_batch_3(sr400_base_regressor, samples, inputs, W,
                    (size_t)SR400_JOINTS * SR400_BASE_PARAMETERS);
}

/* Joint torques, by the Newton-Euler recursion.
 * 264 additions, 331 multiplications. */
void sr400_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                            const double *beta, double *MODELER_RESTRICT tau)
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    const double t1 = q[1] - q[5];
    double sa2, ca2;
    modeler_sincos(t1, &sa2, &ca2);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    const double t2 = sr400_geo_D2*qdd[0];
    const double t3 = c1*qd[0];
    const double t4 = qd[1]*t3;
    const double t5 = s1*qdd[0] + t4;
    const double t6 = s1*qd[0];
    const double t7 = qd[1]*t6;
    const double t8 = c1*qdd[0] - t7;
    const double t9 = qd[1] - qd[5];
    const double t10 = sa2*t3 - ca2*t6;
    const double t11 = sa2*t5 + ca2*t8 - t9*t10;
    const double t12 = t11 + qd[5]*t10;
    const double t13 = (t2 + sr400_geo_D8*t12)*beta[38];
    const double t14 = t4 + t5;
    const double t15 = t14*beta[38];
    const double t16 = sa2*t6 + ca2*t3;
    const double t17 = sa2*t8 - ca2*t5 + t9*t16;
    const double t18 = t17 - qd[5]*t16;
    const double t19 = s5*(ca2*t13 + t2*beta[37]) + c5*(sa2*t13 + sr400_geo_D8*t15 - t2*beta[36]);
    const double t20 = c2*qd[5] - s2*t16;
    const double t21 = qd[3] + t20;
    const double t22 = c2*t16 + s2*qd[5];
    const double t23 = qd[2] - t10;
    const double t24 = c3*t22 - s3*t23;
    const double t25 = c4*t21 - s4*t24;
    const double t26 = c4*t24 + s4*t21;
    const double t27 = c3*t23 + s3*t22;
    const double t28 = qd[4] + t27;
    const double t29 = t26*beta[31] + t25*beta[32] - t28*beta[33];
    const double t30 = t26*beta[30] - t28*beta[32];
    const double t31 = c2*t11 + s2*qdd[5] + qd[2]*t20;
    const double t32 = qdd[2] - t17;
    const double t33 = c3*t31 - s3*t32 - qd[3]*t27;
    const double t34 = c2*qdd[5] - s2*t11 - qd[2]*t22;
    const double t35 = qdd[3] + t34;
    const double t36 = c4*t33 + s4*t35 + qd[4]*t25;
    const double t37 = c4*t35 - s4*t33 - qd[4]*t26;
    const double t38 = c3*t32 + s3*t31 + qd[3]*t24;
    const double t39 = qdd[4] + t38;
    const double t40 = qd[0]*qd[0]*sr400_geo_D2;
    const double t41 = sr400_geo_g*c1 - s1*t40;
    const double t42 = t6*t3;
    const double t43 = t41 - sr400_geo_D3*(qdd[1] + t42);
    const double t44 = c1*t40 + sr400_geo_g*s1;
    const double t45 = qd[1]*qd[1];
    const double t46 = t44 + sr400_geo_D3*(t3*t3 + t45);
    const double t47 = sa2*t43 - ca2*t46;
    const double t48 = t16*t10;
    const double t49 = qdd[5] + t48;
    const double t50 = qd[5]*qd[5];
    const double t51 = t16*t16 + t50;
    const double t52 = sr400_geo_RL4*t51 - sr400_geo_D4*t49 + t47;
    const double t53 = sa2*t46 + ca2*t43;
    const double t54 = t10*t10 + t50;
    const double t55 = qdd[5] - t48;
    const double t56 = sr400_geo_D4*t54 + sr400_geo_RL4*t55 + t53;
    const double t57 = t7 - t8;
    const double t58 = t2 - sr400_geo_D3*t57;
    const double t59 = sr400_geo_D4*t18 - sr400_geo_RL4*t12 + t58;
    const double t60 = c2*t56 + s2*t59;
    const double t61 = c3*t52 - s3*t60;
    const double t62 = t25*t29 + t28*t30 + (t39*beta[31] - (t36*beta[29] + t37*beta[30]));
    const double t63 = t62 - t61*beta[35];
    const double t64 = t26*beta[29] + t25*beta[30] - t28*beta[31];
    const double t65 = t28*t64 + t26*t29 + (t36*beta[30] - t39*beta[32]) - t61*beta[34];
    const double t66 = t24*beta[24] - t27*beta[25] - t21*beta[26];
    const double t67 = t24*beta[23] - t21*beta[25];
    const double t68 = c2*t59 - s2*t56;
    const double t69 = t27*t66 - t21*t67 + (t33*beta[22] - t38*beta[23] - t35*beta[24]);
    const double t70 = c4*t63 + s4*t65 + (t68*beta[28] - t69);
    const double t71 = c3*t60 + s3*t52;
    const double t72 = t26*t30 - t25*t64 + (t39*beta[33] - (t36*beta[31] + t37*beta[32]));
    const double t73 = (c4*t71 + s4*t68)*beta[35] - (c4*t68 - s4*t71)*beta[34] + t72;
    const double t74 = t24*beta[22] - t27*beta[23] - t21*beta[24];
    const double t75 = t73 - (t21*t74 + t24*t66 + (t33*beta[23] - t35*beta[25]) + t68*beta[27]);
    const double t76 = t22*beta[17] + t20*beta[18] - t23*beta[19];
    const double t77 = t22*beta[16] - t23*beta[18];
    const double t78 = t20*t76 + t23*t77 + (t32*beta[17] - (t31*beta[15] + t34*beta[16]));
    const double t79 = c3*t70 - s3*t75 + (t78 - t52*beta[21]);
    const double t80 = t24*t67 + t27*t74 + (t35*beta[26] - (t33*beta[24] - t38*beta[25]));
    const double t81 = s4*t63 - c4*t65 + (t61*beta[27] - t71*beta[28] - t80);
    const double t82 = t22*beta[15] + t20*beta[16] - t23*beta[17];
    const double t83 = t52*beta[20] - (t23*t82 + t22*t76 + (t31*beta[16] - t32*beta[18])) + t81;
    const double t84 = t28*t28;
    const double t85 = t26*t25;
    const double t86 = (t25*t25 + t84)*beta[34] + (t39 - t85)*beta[35];
    const double t87 = (t26*t26 + t84)*beta[35] - (t39 + t85)*beta[34];
    const double t88 = t21*t21;
    const double t89 = t24*t27;
    const double t90 = c4*t86 - s4*t87 + ((t27*t27 + t88)*beta[27] + (t35 + t89)*beta[28]);
    const double t91 = (t37 - t26*t28)*beta[34] - (t36 + t25*t28)*beta[35];
    const double t92 = (t35 - t89)*beta[27] - (t24*t24 + t88)*beta[28] + t91;
    const double t93 = t23*t23;
    const double t94 = t22*t20;
    const double t95 = c3*t90 + s3*t92 + ((t20*t20 + t93)*beta[20] + (t32 - t94)*beta[21]);
    const double t96 = s4*t86 + c4*t87 - ((t38 + t24*t21)*beta[27] + (t33 - t27*t21)*beta[28]);
    const double t97 = (t22*t22 + t93)*beta[21] - (t32 + t94)*beta[20] + t96;
    const double t98 = s2*t95 + c2*t97;
    const double t99 = t16*beta[10] + t10*beta[11] - qd[5]*beta[12];
    const double t100 = t16*beta[9] - qd[5]*beta[11];
    const double t101 = t10*t99 + qd[5]*t100 + (qdd[5]*beta[10] - (t11*beta[8] + t17*beta[9]));
    const double t102 = c2*t79 - s2*t83 + sr400_geo_RL4*t98 + (t101 + t58*beta[14]);
    const double t103 = t22*t77 - t20*t82 + (t32*beta[19] - (t31*beta[17] + t34*beta[18]));
    const double t104 = s3*t70 + c3*t75 + (t60*beta[21] - t68*beta[20] + t103);
    const double t105 = t16*beta[8] + t10*beta[9] - qd[5]*beta[10];
    const double t106 = qd[5]*t105 + t16*t99 + (t11*beta[9] - qdd[5]*beta[11]) + t58*beta[13];
    const double t107 = t104 - sr400_geo_D4*t98 - t106;
    const double t108 = t6*beta[3] + t3*beta[4] - qd[1]*beta[5];
    const double t109 = t6*beta[2] - qd[1]*beta[4];
    const double t110 = t3*t108 + qd[1]*t109 + (qdd[1]*beta[3] - (t5*beta[1] + t8*beta[2]));
    const double t111 = t18*beta[13] - t12*beta[14] + t98;
    const double t112 = t6*beta[1] + t3*beta[2] - qd[1]*beta[3];
    const double t113 = qd[1]*t112 + t6*t108 + (t5*beta[2] - qdd[1]*beta[4]) + t2*beta[6];
    const double t114 = c1*(ca2*t102 + sa2*t107 - sr400_geo_D3*t111 - t113);
    const double t115 = s1*(sa2*t102 - ca2*t107 + (t110 + t2*beta[7])) + t114;
    const double t116 = t19 + sr400_geo_D2*(t15 - (t12*beta[36] + t18*beta[37]));
    const double t117 = t115 - sr400_geo_D2*(t111 - (t57*beta[6] + t14*beta[7])) + t116;
    tau[0] = qdd[0]*beta[0] - t117;
    const double t118 = c5*t40 + sr400_geo_g*s5;
    const double t119 = sr400_geo_g*c5 - s5*t40;
    const double t120 = (ca2*(t118 + sr400_geo_D8*t51) + sa2*(t119 - sr400_geo_D8*t55))*beta[38];
    const double t121 = s3*t90 - c3*t92 + ((t31 + t20*t23)*beta[21] - (t34 - t22*t23)*beta[20]);
    const double t122 = c2*t95 - s2*t97;
    const double t123 = t16*t100 - t10*t105 + (qdd[5]*beta[12] - (t11*beta[10] + t17*beta[11]));
    const double t124 = s2*t79 + c2*t83 + (sr400_geo_D4*t121 - sr400_geo_RL4*t122);
    const double t125 = t47*beta[13] - t53*beta[14] - t123 + t124;
    const double t126 = ca2*(t54*beta[13] + t55*beta[14] + t122);
    const double t127 = t6*t109 - t3*t112 + (qdd[1]*beta[5] - (t5*beta[3] + t8*beta[4]));
    const double t128 = t125 + sr400_geo_D3*(t126 + sa2*(t51*beta[14] - t49*beta[13] + t121));
    tau[1] = t44*beta[7] - t41*beta[6] + t127 - t128 + t125 + t120;
    tau[2] = t104;
    tau[3] = -t81;
    tau[4] = t73;
    const double t129 = sr400_geo_D8*((t6*t6 + t45)*beta[38]*ca2 + (qdd[1] - t42)*beta[38]*sa2);
    tau[5] = t120 - t129 + (t118*beta[37] - t119*beta[36]) - t125 - t120;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 133 additions, 169 multiplications. */
void sr400_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    const double k1 = sr400_geo_D8*2.0;
    const double k2 = sr400_geo_D2*2.0;
    const double k3 = sr400_geo_D4*2.0;
    const double k4 = sr400_geo_RL4*2.0;
    const double k5 = sr400_geo_D3*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    const double t1 = q[1] - q[5];
    double sa2, ca2;
    modeler_sincos(t1, &sa2, &ca2);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    const double t2 = s4*beta[35] - c4*beta[34];
    const double t3 = beta[27] - t2;
    const double t4 = c3*beta[28] + s3*t3;
    const double t5 = beta[14] + t4;
    const double t6 = c4*beta[35] + s4*beta[34];
    const double t7 = beta[21] + t6;
    const double t8 = s3*beta[28] - c3*t3;
    const double t9 = beta[20] - t8;
    const double t10 = s2*t7 - c2*t9;
    const double t11 = beta[13] - t10;
    const double t12 = sa2*t5 + ca2*t11;
    const double t13 = ca2*t5 - sa2*t11;
    const double t14 = ca2*beta[38];
    const double t15 = sa2*beta[38];
    const double t16 = sr400_geo_D8*t14*s5;
    const double t17 = k2*(s5*(beta[37] + t14) - c5*(beta[36] - t15));
    const double t18 = c4*beta[29] - s4*beta[30];
    const double t19 = c4*beta[30];
    const double t20 = s4*t19;
    const double t21 = c4*t18 - t20 + beta[22];
    const double t22 = c4*beta[31] - s4*beta[32];
    const double t23 = beta[23] + t22;
    const double t24 = s3*t23;
    const double t25 = c3*t21 - t24;
    const double t26 = s3*beta[33];
    const double t27 = c3*t23;
    const double t28 = t26 - t27;
    const double t29 = c3*t25 + s3*t28 + beta[15];
    const double t30 = beta[24] - (s4*t18 + c4*t19);
    const double t31 = s4*beta[31] + c4*beta[32];
    const double t32 = beta[25] - t31;
    const double t33 = c3*t30 - s3*t32;
    const double t34 = beta[16] - t33;
    const double t35 = s2*t34;
    const double t36 = c2*t29 - t35;
    const double t37 = t20 + s4*(s4*beta[29] + t19) + beta[26];
    const double t38 = s2*t37;
    const double t39 = c2*t34;
    const double t40 = t38 - t39;
    const double t41 = k4*t4;
    const double t42 = c2*t36 + s2*t40 + beta[8] + t41;
    const double t43 = s3*t25 - c3*t28 + beta[17];
    const double t44 = s3*t30 + c3*t32;
    const double t45 = beta[18] - t44;
    const double t46 = c2*t43 - s2*t45;
    const double t47 = sr400_geo_RL4*t10;
    const double t48 = beta[9] + t46 + (t47 - sr400_geo_D4*t4);
    const double t49 = ca2*t48;
    const double t50 = sa2*t42 - t49;
    const double t51 = sa2*t48;
    const double t52 = c3*beta[33];
    const double t53 = s3*(s3*t21 + t27) + c3*(t52 + t24) + beta[19];
    const double t54 = k3*t10;
    const double t55 = t53 - t54;
    const double t56 = t51 - ca2*t55;
    const double t57 = ca2*t50 + sa2*t56 + beta[2] - sr400_geo_D3*t12;
    const double t58 = c1*(s1*t57 + c1*(ca2*(ca2*t42 + t51) + sa2*(t49 + sa2*t55) - k5*t13));
    const double t59 = s1*(s1*(sa2*t50 - ca2*t56 + beta[1]) + c1*t57) + t58;
    const double t60 = c5*t16 + c5*(t16 + k1*t15*c5) - beta[0] + t17 - t59;
    M[0] = -(k2*(s1*(beta[7] + t12) - c1*(beta[6] - t13)) + t60);
    const double t61 = c2*t7 + s2*t9;
    const double t62 = c2*t40 - s2*t36 + beta[10] + sr400_geo_D4*t61;
    const double t63 = sr400_geo_RL4*t61;
    const double t64 = s2*t43 + c2*t45;
    const double t65 = beta[11] - t64 + t63;
    const double t66 = sa2*t62 - ca2*t65;
    const double t67 = ca2*t62 + sa2*t65;
    const double t68 = s1*t66 + c1*t67;
    const double t69 = t68 - (s1*(beta[3] + t66 + sr400_geo_D3*t61) + c1*(beta[4] + t67));
    M[1] = t69;
    const double t70 = t46 + t47;
    const double t71 = t53 - sr400_geo_D4*t10;
    const double t72 = s1*(sa2*t70 - ca2*t71) + c1*(ca2*t70 + sa2*t71 - sr400_geo_D3*t10);
    const double t73 = t72 - sr400_geo_D2*t10;
    M[2] = -t73;
    const double t74 = s2*t4;
    const double t75 = c2*t33 + t38 + sr400_geo_RL4*t74;
    const double t76 = t44 - sr400_geo_D4*t74;
    const double t77 = s1*(sa2*t75 - ca2*t76) + c1*(ca2*t75 + sa2*t76 - sr400_geo_D3*t74);
    const double t78 = t77 - sr400_geo_D2*t74;
    M[3] = -t78;
    const double t79 = c3*t22 - t26;
    const double t80 = c3*t6;
    const double t81 = s2*t80 + c2*t2;
    const double t82 = c2*t79 - s2*t31 + sr400_geo_RL4*t81;
    const double t83 = s3*t22 + t52;
    const double t84 = t83 - sr400_geo_D4*t81;
    const double t85 = s1*(sa2*t82 - ca2*t84) + c1*(ca2*t82 + sa2*t84 - sr400_geo_D3*t81);
    const double t86 = t85 - sr400_geo_D2*t81;
    M[4] = -t86;
    M[5] = -t68;
    M[6] = t69;
    M[7] = beta[5];
    const double t87 = ca2*t61*sr400_geo_D3;
    M[8] = -t87;
    const double t88 = c2*t4;
    const double t89 = sr400_geo_D3*(ca2*t88 + sa2*t8);
    M[9] = -t89;
    const double t90 = c2*t80 - s2*t2;
    const double t91 = s3*t6;
    const double t92 = sr400_geo_D3*(ca2*t90 + sa2*t91);
    M[10] = -t92;
    const double t93 = sr400_geo_D8*t15 + sr400_geo_D3*t13;
    M[11] = -t93;
    M[12] = -t73;
    M[13] = -t87;
    M[14] = t53;
    M[15] = t44;
    M[16] = t83;
    const double t94 = t64 - t63;
    M[17] = -t94;
    M[18] = -t78;
    M[19] = -t89;
    M[20] = t44;
    M[21] = t37;
    M[22] = -t31;
    const double t95 = c2*t37;
    const double t96 = s2*t33 - t95 + (sr400_geo_D4*t8 - sr400_geo_RL4*t88);
    M[23] = -t96;
    M[24] = -t86;
    M[25] = -t92;
    M[26] = t83;
    M[27] = -t31;
    M[28] = beta[33];
    const double t97 = s2*t79 + c2*t31 + (sr400_geo_D4*t91 - sr400_geo_RL4*t90);
    M[29] = -t97;
    M[30] = -t68;
    M[31] = -t93;
    M[32] = -t94;
    M[33] = -t96;
    M[34] = -t97;
    M[35] = s2*(s2*t29 + t39) + c2*(t95 + t35) + beta[12] + (t41 - t54);
}

/* Torques that hold the robot still, without friction.
 * 26 additions, 43 multiplications. */
void sr400_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
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

    const double t1 = sr400_geo_g*s1;
    const double t2 = t1*beta[38];
    tau[1] = t1*beta[7] - sr400_geo_g*c1*beta[6] + t2;
    const double t3 = sr400_geo_g*s5;
    const double t4 = sr400_geo_g*c5;
    const double t5 = c2*t4;
    const double t6 = c3*t3 + s3*t5;
    const double t7 = beta[35]*t6;
    const double t8 = beta[34]*t6;
    const double t9 = s2*t4;
    const double t10 = c4*t7 + s4*t8 - beta[28]*t9;
    const double t11 = c3*t5 - s3*t3;
    const double t12 = beta[34]*(c4*t9 + s4*t11) + beta[35]*(c4*t11 - s4*t9);
    const double t13 = t12 + beta[27]*t9;
    tau[2] = s3*t10 + c3*t13 + (beta[20]*t9 + beta[21]*t5);
    const double t14 = s4*t7 - c4*t8 - (beta[27]*t6 + beta[28]*t11);
    tau[3] = -t14;
    tau[4] = t12;
    const double t15 = s2*(c3*t10 - s3*t13 + t3*beta[21]) + c2*(t14 - t3*beta[20]);
    tau[5] = t3*beta[37] - t4*beta[36] + t2 + (t3*beta[13] + t4*beta[14] - t15) - t2;
}

/* Coriolis and centripetal torques.
 * 227 additions, 309 multiplications. */
void sr400_coriolis(const double *q, const double *qd, const double *beta,
                    double *MODELER_RESTRICT tau)
{
    const double k1 = sr400_geo_D8*2.0;
    const double k2 = sr400_geo_D4*2.0;
    const double k3 = sr400_geo_RL4*2.0;
    const double k4 = sr400_geo_D3*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    const double t1 = q[1] - q[5];
    double sa2, ca2;
    modeler_sincos(t1, &sa2, &ca2);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    const double t2 = c1*qd[0];
    const double t3 = s1*qd[0];
    const double t4 = sa2*t2 - ca2*t3;
    const double t5 = qd[5]*t4;
    const double t6 = k1*t5*beta[38];
    const double t7 = qd[1]*t2;
    const double t8 = 2.0*t7;
    const double t9 = beta[38]*t8;
    const double t10 = 2.0*t5;
    const double t11 = sa2*t3 + ca2*t2;
    const double t12 = qd[5]*t11;
    const double t13 = 2.0*t12;
    const double t14 = sr400_geo_D2*(beta[37]*t13 - beta[36]*t10 + t9);
    const double t15 = c2*qd[5] - s2*t11;
    const double t16 = qd[3] + t15;
    const double t17 = c2*t11 + s2*qd[5];
    const double t18 = qd[2] - t4;
    const double t19 = c3*t17 - s3*t18;
    const double t20 = c4*t16 - s4*t19;
    const double t21 = c3*t18 + s3*t17;
    const double t22 = qd[2]*t15 + c2*t5;
    const double t23 = s3*t12 - c3*t22 + qd[3]*t21;
    const double t24 = qd[2]*t17 + s2*t5;
    const double t25 = qd[4]*t20 - (c4*t23 + s4*t24);
    const double t26 = c4*t19 + s4*t16;
    const double t27 = c4*t24 - s4*t23 + qd[4]*t26;
    const double t28 = c3*t12 + s3*t22 + qd[3]*t19;
    const double t29 = qd[4] + t21;
    const double t30 = t26*beta[31] + t20*beta[32] - t29*beta[33];
    const double t31 = t26*beta[30] - t29*beta[32];
    const double t32 = qd[0]*qd[0]*sr400_geo_D2;
    const double t33 = s1*t32;
    const double t34 = t3*t2;
    const double t35 = t33 + sr400_geo_D3*t34;
    const double t36 = c1*t32;
    const double t37 = qd[1]*qd[1];
    const double t38 = t36 + sr400_geo_D3*(t2*t2 + t37);
    const double t39 = sa2*t35 + ca2*t38;
    const double t40 = qd[5]*qd[5];
    const double t41 = t11*t11 + t40;
    const double t42 = t11*t4;
    const double t43 = sr400_geo_D4*t42 - sr400_geo_RL4*t41 + t39;
    const double t44 = sa2*t38 - ca2*t35;
    const double t45 = t4*t4 + t40;
    const double t46 = sr400_geo_D4*t45 - sr400_geo_RL4*t42 + t44;
    const double t47 = qd[1]*t3;
    const double t48 = k4*t47;
    const double t49 = k2*t12 + k3*t5 + t48;
    const double t50 = c2*t46 - s2*t49;
    const double t51 = c3*t43 + s3*t50;
    const double t52 = beta[29]*t25 - beta[30]*t27 - beta[31]*t28 - (t20*t30 + t29*t31);
    const double t53 = t52 - beta[35]*t51;
    const double t54 = t26*beta[29] + t20*beta[30] - t29*beta[31];
    const double t55 = beta[30]*t25 - beta[32]*t28 + (t29*t54 + t26*t30) + beta[34]*t51;
    const double t56 = t19*beta[24] - t21*beta[25] - t16*beta[26];
    const double t57 = t19*beta[23] - t16*beta[25];
    const double t58 = c2*t49 + s2*t46;
    const double t59 = beta[22]*t23 + beta[23]*t28 - beta[24]*t24 + (t16*t57 - t21*t56);
    const double t60 = c4*t53 - s4*t55 + (beta[28]*t58 - t59);
    const double t61 = c3*t50 - s3*t43;
    const double t62 = beta[31]*t25 - beta[32]*t27 - beta[33]*t28 + (t20*t54 - t26*t31);
    const double t63 = t62 - (beta[34]*(c4*t58 + s4*t61) + beta[35]*(c4*t61 - s4*t58));
    const double t64 = t19*beta[22] - t21*beta[23] - t16*beta[24];
    const double t65 = t63 - (beta[23]*t23 - beta[25]*t24 - (t16*t64 + t19*t56) + beta[27]*t58);
    const double t66 = t17*beta[17] + t15*beta[18] - t18*beta[19];
    const double t67 = t17*beta[16] - t18*beta[18];
    const double t68 = beta[15]*t22 - beta[16]*t24 - t12*beta[17] - (t15*t66 + t18*t67);
    const double t69 = c3*t60 - s3*t65 + (t68 - beta[21]*t43);
    const double t70 = beta[24]*t23 + beta[25]*t28 - beta[26]*t24 + (t19*t57 + t21*t64);
    const double t71 = s4*t53 + c4*t55 + (beta[27]*t51 + beta[28]*t61 + t70);
    const double t72 = t17*beta[15] + t15*beta[16] - t18*beta[17];
    const double t73 = beta[16]*t22 - t12*beta[18] + (t18*t72 + t17*t66) + beta[20]*t43 + t71;
    const double t74 = t29*t29;
    const double t75 = t26*t20;
    const double t76 = (t20*t20 + t74)*beta[34] - beta[35]*(t75 - t28);
    const double t77 = beta[34]*(t75 + t28) - (t26*t26 + t74)*beta[35];
    const double t78 = t16*t16;
    const double t79 = t19*t21;
    const double t80 = c4*t76 + s4*t77 + ((t21*t21 + t78)*beta[27] + beta[28]*(t79 - t24));
    const double t81 = beta[34]*(t26*t29 + t27) + beta[35]*(t20*t29 + t25);
    const double t82 = beta[27]*(t79 + t24) + (t19*t19 + t78)*beta[28] + t81;
    const double t83 = t18*t18;
    const double t84 = t17*t15;
    const double t85 = c3*t80 - s3*t82 + ((t15*t15 + t83)*beta[20] + beta[21]*(t12 - t84));
    const double t86 = s4*t76 - c4*t77 + (beta[28]*(t21*t16 + t23) - beta[27]*(t19*t16 + t28));
    const double t87 = (t17*t17 + t83)*beta[21] - beta[20]*(t12 + t84) + t86;
    const double t88 = s2*t85 + c2*t87;
    const double t89 = t11*beta[10] + t4*beta[11] - qd[5]*beta[12];
    const double t90 = t11*beta[9] - qd[5]*beta[11];
    const double t91 = t5*beta[8] - t12*beta[9] - (t4*t89 + qd[5]*t90) + beta[14]*t48;
    const double t92 = c2*t69 - s2*t73 - sr400_geo_RL4*t88 + t91;
    const double t93 = beta[17]*t22 - beta[18]*t24 - t12*beta[19] + (t15*t72 - t17*t67);
    const double t94 = s3*t60 + c3*t65 + (t93 - (beta[20]*t58 + beta[21]*t50));
    const double t95 = t11*beta[8] + t4*beta[9] - qd[5]*beta[10];
    const double t96 = t94 + sr400_geo_D4*t88 + (qd[5]*t95 + t11*t89 + t5*beta[9] - beta[13]*t48);
    const double t97 = t3*beta[3] + t2*beta[4] - qd[1]*beta[5];
    const double t98 = t3*beta[2] - qd[1]*beta[4];
    const double t99 = t88 - (beta[13]*t13 + beta[14]*t10);
    const double t100 = t3*beta[1] + t2*beta[2] - qd[1]*beta[3];
    const double t101 = ca2*t92 + sa2*t96 + sr400_geo_D3*t99 + (qd[1]*t100 + t3*t97 + t7*beta[2]);
    const double t102 = s1*(sa2*t92 - ca2*t96 + (t7*beta[1] - t47*beta[2] - (t2*t97 + qd[1]*t98)));
    const double t103 = t102 + c1*t101 + sr400_geo_D2*(t99 - (2.0*t47*beta[6] + beta[7]*t8));
    tau[0] = t103 - (ca2*t6*s5 + c5*(sa2*t6 + sr400_geo_D8*t9) + t14);
    const double t104 = c5*t32;
    const double t105 = s5*t32;
    const double t106 = beta[38]*(ca2*(t104 + sr400_geo_D8*t41) - sa2*(t105 - sr400_geo_D8*t42));
    const double t107 = s3*t80 + c3*t82 + (beta[20]*(t17*t18 + t24) + beta[21]*(t15*t18 + t22));
    const double t108 = c2*t85 - s2*t87;
    const double t109 = t5*beta[10] - t12*beta[11] + (t4*t95 - t11*t90);
    const double t110 = s2*t69 + c2*t73 + (sr400_geo_RL4*t108 - sr400_geo_D4*t107);
    const double t111 = beta[13]*t39 + beta[14]*t44 - t109 + t110;
    const double t112 = ca2*(t45*beta[13] - t42*beta[14] + t108);
    const double t113 = t7*beta[3] - t47*beta[4] + (t2*t100 - t3*t98);
    const double t114 = t111 - sr400_geo_D3*(t112 + sa2*(t41*beta[14] - t42*beta[13] + t107));
    tau[1] = t33*beta[6] + t36*beta[7] - t113 + t114 - t111 + t106;
    tau[2] = -t94;
    tau[3] = t71;
    tau[4] = -t63;
    const double t115 = t106 + sr400_geo_D8*(t34*beta[38]*sa2 - (t3*t3 + t37)*beta[38]*ca2);
    tau[5] = t105*beta[36] + t104*beta[37] + t115 + t111 - t106;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void sr400_friction(const double *qd, const double *beta, double *MODELER_RESTRICT tau)
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
    tau[4] = 0.0;
    tau[5] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 75 additions, 37 multiplications. */
void sr400_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = sr400_geo_D2*sr400_geo_D2;
    const double k2 = sr400_geo_D8*sr400_geo_D8;
    const double k3 = sr400_geo_D3*sr400_geo_D3;
    const double k4 = sr400_geo_D4*sr400_geo_D4;
    const double k5 = sr400_geo_RL4*2.0;
    const double k6 = sr400_geo_RL4*sr400_geo_RL4;
    const double k7 = sr400_geo_D4*sr400_geo_RL4;
    const double k8 = k1 + k3;
    const double k9 = k4 + k8;
    const double k10 = k4 - k6;
    const double k11 = k4 + k6;
    const double k12 = 1.0/sr400_geo_D3*sr400_geo_D8;

    const double t1 = chi[5] + chi[13] + k1*chi[19] + chi[23] + k8*chi[29] + k9*chi[39];
    beta[0] = t1 + k9*chi[49] + k9*chi[59] + chi[60] + k1*chi[69] + chi[73] + k1*chi[79];
    const double t2 = k3*chi[29];
    const double t3 = k3*chi[39];
    const double t4 = k3*chi[49];
    const double t5 = k3*chi[59];
    beta[1] = chi[10] - chi[13] - t2 - t3 - t4 - t5 + chi[70] - chi[73];
    beta[2] = chi[11] + chi[71];
    beta[3] = chi[12] - sr400_geo_D3*chi[28] + chi[72];
    beta[4] = chi[14] + chi[74];
    beta[5] = chi[15] + t2 + t3 + t4 + t5 + chi[75];
    const double t6 = chi[16] + sr400_geo_D3*chi[29] + sr400_geo_D3*chi[39];
    beta[6] = t6 + sr400_geo_D3*chi[49] + sr400_geo_D3*chi[59] + chi[76];
    beta[7] = chi[17];
    const double t7 = k5*chi[38];
    const double t8 = chi[20] - chi[23] + chi[33] + t7 - k10*chi[39] - k10*chi[49] - k10*chi[59];
    const double t9 = k2*chi[79];
    beta[8] = t8 - chi[60] + chi[63] + t9;
    const double t10 = chi[21] - sr400_geo_D4*chi[38] - k7*chi[39] - k7*chi[49] - k7*chi[59];
    beta[9] = t10 - chi[61];
    beta[10] = chi[22] + chi[64];
    beta[11] = chi[24] - chi[62] + sr400_geo_D8*chi[78];
    const double t11 = chi[25] + chi[33] + t7 + k11*chi[39] + k11*chi[49] + k11*chi[59] + chi[65];
    beta[12] = t9 + t11;
    const double t12 = chi[26] + sr400_geo_D4*chi[39] + sr400_geo_D4*chi[49];
    beta[13] = t12 + sr400_geo_D4*chi[59];
    const double t13 = chi[27] + chi[38] + sr400_geo_RL4*chi[39] + sr400_geo_RL4*chi[49];
    const double t14 = k12*chi[76];
    beta[14] = t13 + sr400_geo_RL4*chi[59] - t14;
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
    beta[36] = chi[66] - t14 + sr400_geo_D8*chi[79];
    beta[37] = chi[67];
    beta[38] = chi[77];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 34 additions, 60 multiplications. */
void sr400_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
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
    T[106] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    const double t1 = q[1] - q[5];
    double sa3, ca3;
    modeler_sincos(t1, &sa3, &ca3);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    T[0] = c0;
    T[1] = -s0;
    T[4] = s0;
    T[5] = c0;
    T[10] = 1.0;
    const double t2 = c0*c1;
    T[12] = t2;
    const double t3 = c0*s1;
    T[13] = -t3;
    T[14] = -s0;
    const double t4 = sr400_geo_D2*c0;
    T[15] = t4;
    const double t5 = s0*c1;
    T[16] = t5;
    const double t6 = s0*s1;
    T[17] = -t6;
    T[18] = c0;
    const double t7 = sr400_geo_D2*s0;
    T[19] = t7;
    T[20] = -s1;
    T[21] = -c1;
    const double t8 = sa3*t2 - ca3*t3;
    T[24] = t8;
    const double t9 = sa3*t3 + ca3*t2;
    T[25] = -t9;
    T[26] = -s0;
    const double t10 = sr400_geo_D3*t2;
    const double t11 = t4 + t10;
    T[27] = t11;
    const double t12 = sa3*t5 - ca3*t6;
    T[28] = t12;
    const double t13 = sa3*t6 + ca3*t5;
    T[29] = -t13;
    T[30] = c0;
    const double t14 = sr400_geo_D3*t5;
    const double t15 = t7 + t14;
    T[31] = t15;
    T[32] = -c5;
    T[33] = s5;
    const double t16 = sr400_geo_D3*s1;
    T[35] = -t16;
    const double t17 = c2*t8 + s0*s2;
    T[36] = t17;
    const double t18 = s0*c2 - s2*t8;
    T[37] = t18;
    T[38] = -t9;
    const double t19 = t11 + sr400_geo_D4*t8 - sr400_geo_RL4*t9;
    T[39] = t19;
    const double t20 = c2*t12 - c0*s2;
    T[40] = t20;
    const double t21 = c0*c2 + s2*t12;
    T[41] = -t21;
    T[42] = -t13;
    const double t22 = t15 + sr400_geo_D4*t12 - sr400_geo_RL4*t13;
    T[43] = t22;
    const double t23 = c2*c5;
    T[44] = -t23;
    const double t24 = s2*c5;
    T[45] = t24;
    T[46] = s5;
    const double t25 = t16 + sr400_geo_D4*c5 - sr400_geo_RL4*s5;
    T[47] = -t25;
    const double t26 = c3*t17 - s3*t9;
    T[48] = t26;
    const double t27 = c3*t9 + s3*t17;
    T[49] = -t27;
    T[50] = -t18;
    T[51] = t19;
    const double t28 = c3*t20 - s3*t13;
    T[52] = t28;
    const double t29 = c3*t13 + s3*t20;
    T[53] = -t29;
    T[54] = t21;
    T[55] = t22;
    const double t30 = c3*t23 - s3*s5;
    T[56] = -t30;
    const double t31 = c3*s5 + s3*t23;
    T[57] = t31;
    T[58] = -t24;
    T[59] = -t25;
    T[60] = c4*t26 + s4*t18;
    T[61] = c4*t18 - s4*t26;
    T[62] = -t27;
    T[63] = t19;
    T[64] = c4*t28 - s4*t21;
    T[65] = -(c4*t21 + s4*t28);
    T[66] = -t29;
    T[67] = t22;
    T[68] = s4*t24 - c4*t30;
    T[69] = c4*t24 + s4*t30;
    T[70] = t31;
    T[71] = -t25;
    T[72] = t9;
    T[73] = t8;
    T[74] = -s0;
    T[75] = t4;
    T[76] = t13;
    T[77] = t12;
    T[78] = c0;
    T[79] = t7;
    T[80] = -s5;
    T[81] = -c5;
    T[84] = t2;
    T[85] = -t3;
    T[86] = -s0;
    const double t32 = t4 + sr400_geo_D8*t9;
    T[87] = t32;
    T[88] = t5;
    T[89] = -t6;
    T[90] = c0;
    const double t33 = t7 + sr400_geo_D8*t13;
    T[91] = t33;
    T[92] = -s1;
    T[93] = -c1;
    const double t34 = sr400_geo_D8*s5;
    T[95] = -t34;
    T[96] = -t9;
    T[97] = -t8;
    T[98] = -s0;
    T[99] = t10 + t32;
    T[100] = -t13;
    T[101] = -t12;
    T[102] = c0;
    T[103] = t14 + t33;
    T[104] = s5;
    T[105] = c5;
    T[107] = -(t16 + t34);
}
