/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_leg_tree.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_LEG_TREE_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_LEG_TREE_GEO_g
#define ORTHOGLIDE_LEG_TREE_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_D4
#define ORTHOGLIDE_LEG_TREE_GEO_D4 0.31
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b3
#define ORTHOGLIDE_LEG_TREE_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b7
#define ORTHOGLIDE_LEG_TREE_GEO_b7 0.04
#endif

static const double orthoglide_leg_tree_geo_g = ORTHOGLIDE_LEG_TREE_GEO_g;
static const double orthoglide_leg_tree_geo_D4 = ORTHOGLIDE_LEG_TREE_GEO_D4;
static const double orthoglide_leg_tree_geo_b3 = ORTHOGLIDE_LEG_TREE_GEO_b3;
static const double orthoglide_leg_tree_geo_b7 = ORTHOGLIDE_LEG_TREE_GEO_b7;

const int orthoglide_leg_tree_nonzero_row[ORTHOGLIDE_LEG_TREE_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5
};

const int orthoglide_leg_tree_nonzero_column[ORTHOGLIDE_LEG_TREE_NONZEROS] = {
    0, 2, 3, 9, 10, 16, 17, 23, 24, 30, 31, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18,
    19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 30, 31, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
    17, 18, 19, 20, 21, 22, 23, 24, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 18, 19,
    20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
};

const char *orthoglide_leg_tree_signature(void)
{
    return "013bd860370eec91";
}

void orthoglide_leg_tree_observation(size_t samples, const double *q, const double *qd,
                                     const double *qdd, double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, ORTHOGLIDE_LEG_TREE_JOINTS},
        {qd, ORTHOGLIDE_LEG_TREE_JOINTS},
        {qdd, ORTHOGLIDE_LEG_TREE_JOINTS},
    };

    modeler_batch_3(orthoglide_leg_tree_base_regressor, samples, inputs, W,
                    (size_t)ORTHOGLIDE_LEG_TREE_JOINTS * ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS);
}

/* Joint torques, by the Newton-Euler recursion.
 * 185 additions, 238 multiplications. */
void orthoglide_leg_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
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

    const double t1 = c5*qd[1];
    const double t2 = qd[5]*qd[5];
    const double t3 = s5*qd[1];
    const double t4 = t3*t1;
    const double t5 = c5*((t1*t1 + t2)*beta[30] + (qdd[5] - t4)*beta[31]);
    const double t6 = qd[2] + qd[3];
    const double t7 = s2*qd[1];
    const double t8 = c2*qd[1];
    const double t9 = c3*t7 + s3*t8;
    const double t10 = c4*t6 + s4*t9;
    const double t11 = c3*t8 - s3*t7;
    const double t12 = qd[4] + t11;
    const double t13 = t12*t12;
    const double t14 = qd[2]*t7;
    const double t15 = c2*qdd[1] - t14;
    const double t16 = qd[2]*t8;
    const double t17 = s2*qdd[1] + t16;
    const double t18 = c3*t15 - s3*t17 - qd[3]*t9;
    const double t19 = qdd[4] + t18;
    const double t20 = c4*t9 - s4*t6;
    const double t21 = t20*t10;
    const double t22 = (t10*t10 + t13)*beta[23] + (t19 + t21)*beta[24];
    const double t23 = (t20*t20 + t13)*beta[24] - (t19 - t21)*beta[23];
    const double t24 = t6*t6;
    const double t25 = qdd[2] + qdd[3];
    const double t26 = t9*t11;
    const double t27 = c4*t22 - s4*t23 + ((t11*t11 + t24)*beta[16] + (t25 - t26)*beta[17]);
    const double t28 = c3*t17 + s3*t15 + qd[3]*t11;
    const double t29 = c4*t25 + s4*t28 + qd[4]*t20;
    const double t30 = c4*t28 - s4*t25 - qd[4]*t10;
    const double t31 = (t29 + t20*t12)*beta[23] + (t30 - t10*t12)*beta[24];
    const double t32 = (t25 + t26)*beta[16] - (t9*t9 + t24)*beta[17] + t31;
    const double t33 = qd[2]*qd[2];
    const double t34 = t8*t8 + t33;
    const double t35 = t7*t8;
    const double t36 = s3*t27 - c3*t32;
    const double t37 = qdd[2] + t35;
    const double t38 = c2*(c3*t27 + s3*t32 + (t34*beta[9] + (qdd[2] - t35)*beta[10]));
    const double t39 = t5 - s5*((t3*t3 + t2)*beta[31] - (qdd[5] + t4)*beta[30]);
    const double t40 = qd[1]*qd[1];
    const double t41 = t38 - s2*((t7*t7 + t33)*beta[10] - t37*beta[9] + t36) + t39;
    const double t42 = qd[5]*t3;
    const double t43 = c5*qdd[1] - t42;
    const double t44 = qd[5]*t1;
    const double t45 = s5*qdd[1] + t44;
    const double t46 = s4*t22 + c4*t23 + ((t28 + t11*t6)*beta[17] - (t18 - t9*t6)*beta[16]);
    const double t47 = t14 - t15;
    const double t48 = (t42 - t43)*beta[30] + (t44 + t45)*beta[31];
    const double t49 = t47*beta[9] + (t16 + t17)*beta[10] + t46 + t48;
    const double t50 = s1*(t40*beta[2] + qdd[1]*beta[3] + t41);
    tau[0] = t50 + c1*(t40*beta[3] - qdd[1]*beta[2] + t49) + qdd[0]*beta[0];
    const double t51 = t3*beta[27] + t1*beta[28] - qd[5]*beta[29];
    const double t52 = t3*beta[26] - qd[5]*beta[28];
    const double t53 = c1*qdd[0];
    const double t54 = t1*t51 + qd[5]*t52 + (qdd[5]*beta[27] - (t45*beta[25] + t43*beta[26]));
    const double t55 = t3*beta[25] + t1*beta[26] - qd[5]*beta[27];
    const double t56 = c5*(qd[5]*t55 + t3*t51 + (t45*beta[26] - qdd[5]*beta[28]) - t53*beta[30]);
    const double t57 = t20*beta[20] - t10*beta[21] - t12*beta[22];
    const double t58 = t20*beta[19] - t12*beta[21];
    const double t59 = s1*qdd[0];
    const double t60 = orthoglide_leg_tree_geo_g*c2 + s2*t59;
    const double t61 = t60 + orthoglide_leg_tree_geo_D4*t37;
    const double t62 = c2*t59 - orthoglide_leg_tree_geo_g*s2;
    const double t63 = t62 + orthoglide_leg_tree_geo_D4*t34;
    const double t64 = c3*t61 + s3*t63;
    const double t65 = t10*t57 - t12*t58 + (t30*beta[18] - t29*beta[19] - t19*beta[20]);
    const double t66 = t65 + t64*beta[24];
    const double t67 = t20*beta[18] - t10*beta[19] - t12*beta[20];
    const double t68 = t12*t67 + t20*t57 + (t30*beta[19] - t19*beta[21]) - t64*beta[23];
    const double t69 = t9*beta[13] + t11*beta[14] - t6*beta[15];
    const double t70 = t9*beta[12] - t6*beta[14];
    const double t71 = t53 + orthoglide_leg_tree_geo_D4*t47;
    const double t72 = t11*t69 + t6*t70 + (t25*beta[13] - (t28*beta[11] + t18*beta[12]));
    const double t73 = c4*t66 - s4*t68 + (t71*beta[17] - t72);
    const double t74 = c3*t63 - s3*t61;
    const double t75 = t20*t58 + t10*t67 + (t19*beta[22] - (t30*beta[20] - t29*beta[21]));
    const double t76 = (c4*t74 + s4*t71)*beta[24] - (c4*t71 - s4*t74)*beta[23] + t75;
    const double t77 = t9*beta[11] + t11*beta[12] - t6*beta[13];
    const double t78 = t6*t77 + t9*t69 + (t28*beta[12] - t25*beta[14]) - t71*beta[16] + t76;
    const double t79 = t7*beta[6] + t8*beta[7] - qd[2]*beta[8];
    const double t80 = t7*beta[5] - qd[2]*beta[7];
    const double t81 = t8*t79 + qd[2]*t80 + (qdd[2]*beta[6] - (t17*beta[4] + t15*beta[5]));
    const double t82 = t7*beta[4] + t8*beta[5] - qd[2]*beta[6];
    const double t83 = qd[2]*t82 + t7*t79 + (t17*beta[5] - qdd[2]*beta[7]) - t53*beta[9];
    const double t84 = c2*(s3*t73 + c3*t78 - orthoglide_leg_tree_geo_D4*t46 + t83);
    const double t85 = s2*(c3*t73 - s3*t78 + (t53*beta[10] - t81)) + t84;
    const double t86 = t59*beta[3] - t53*beta[2] + qdd[1]*beta[1];
    tau[1] = t86 - (s5*(t54 - t53*beta[31]) - t56 - t85);
    const double t87 = t9*t70 - t11*t77 + (t25*beta[15] - (t28*beta[13] + t18*beta[14]));
    const double t88 = s4*t66 + c4*t68 - (t64*beta[16] + t74*beta[17] + t87);
    const double t89 = t7*t80 - t8*t82 + (qdd[2]*beta[8] - (t17*beta[6] + t15*beta[7]));
    tau[2] = t60*beta[9] + t62*beta[10] + t89 - (t88 + orthoglide_leg_tree_geo_D4*t36);
    tau[3] = -t88;
    tau[4] = t76;
    const double t90 = (orthoglide_leg_tree_geo_g*c5 + s5*t59)*beta[30];
    const double t91 = t3*t52 - t1*t55 + (qdd[5]*beta[29] - (t45*beta[27] + t43*beta[28]));
    tau[5] = t90 + (c5*t59 - orthoglide_leg_tree_geo_g*s5)*beta[31] + t91;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 64 additions, 84 multiplications. */
void orthoglide_leg_tree_inertia_matrix(const double *q, const double *beta,
                                        double *MODELER_RESTRICT M)
{
    M[17] = 0.0;
    M[23] = 0.0;
    M[29] = 0.0;
    M[32] = 0.0;
    M[33] = 0.0;
    M[34] = 0.0;

    const double k1 = orthoglide_leg_tree_geo_D4*2.0;

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

    M[0] = beta[0];
    const double t1 = c4*beta[24] + s4*beta[23];
    const double t2 = s4*beta[24] - c4*beta[23];
    const double t3 = beta[16] - t2;
    const double t4 = c3*beta[17] + s3*t3;
    const double t5 = beta[10] + t4;
    const double t6 = s3*beta[17] - c3*t3;
    const double t7 = beta[9] - t6;
    const double t8 = c1*(c5*beta[30] - s5*beta[31] + beta[2] + (c2*t7 - s2*t5));
    const double t9 = s1*(beta[3] + t1) - t8;
    M[1] = t9;
    const double t10 = s1*(c2*t5 + s2*t7);
    M[2] = t10;
    const double t11 = s1*(c2*t4 - s2*t6);
    M[3] = t11;
    const double t12 = s3*t1;
    const double t13 = s1*(c3*t1*c2 - s2*t12) + c1*t2;
    M[4] = t13;
    const double t14 = s1*(c5*beta[31] + s5*beta[30]);
    M[5] = t14;
    M[6] = t9;
    const double t15 = c5*beta[26];
    const double t16 = c4*beta[18] - s4*beta[19];
    const double t17 = c4*beta[19];
    const double t18 = s4*t17;
    const double t19 = c4*t16 - t18 + beta[11];
    const double t20 = c4*beta[20] - s4*beta[21];
    const double t21 = beta[12] - t20;
    const double t22 = s3*t21;
    const double t23 = c3*t19 - t22;
    const double t24 = s3*beta[22];
    const double t25 = c3*t21;
    const double t26 = t24 - t25;
    const double t27 = s3*t23 - c3*t26 + beta[5] - orthoglide_leg_tree_geo_D4*t4;
    const double t28 = c3*beta[22];
    const double t29 = k1*t6;
    const double t30 = c2*(s2*t27 + c2*(s3*(s3*t19 + t25) + c3*(t28 + t22) - t29));
    const double t31 = s2*(s2*(c3*t23 + s3*t26 + beta[4]) + c2*t27) + t30;
    M[7] = s5*t15 + s5*(s5*beta[25] + t15) + beta[1] + t31;
    const double t32 = s4*t16 + c4*t17 + beta[13];
    const double t33 = s4*beta[20] + c4*beta[21];
    const double t34 = beta[14] - t33;
    const double t35 = c3*t32 - s3*t34;
    const double t36 = s3*t32 + c3*t34;
    const double t37 = s2*(beta[6] + t35 - orthoglide_leg_tree_geo_D4*t1) + c2*(beta[7] + t36);
    M[8] = -t37;
    const double t38 = s2*t35 + c2*t36;
    M[9] = -t38;
    const double t39 = s2*(c3*t20 + t24) + c2*(s3*t20 - t28 + orthoglide_leg_tree_geo_D4*t2);
    M[10] = -t39;
    const double t40 = s5*beta[27] + c5*beta[28];
    M[11] = -t40;
    M[12] = t10;
    M[13] = -t37;
    const double t41 = t18 + s4*(s4*beta[18] + t17) + beta[15];
    M[14] = beta[8] + t41 - t29;
    const double t42 = t41 - orthoglide_leg_tree_geo_D4*t6;
    M[15] = t42;
    const double t43 = t33 - orthoglide_leg_tree_geo_D4*t12;
    M[16] = t43;
    M[18] = t11;
    M[19] = -t38;
    M[20] = t42;
    M[21] = t41;
    M[22] = t33;
    M[24] = t13;
    M[25] = -t39;
    M[26] = t43;
    M[27] = t33;
    M[28] = beta[22];
    M[30] = t14;
    M[31] = -t40;
    M[35] = beta[29];
}

/* Torques that hold the robot still, without friction.
 * 9 additions, 22 multiplications. */
void orthoglide_leg_tree_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    tau[0] = 0.0;
    tau[1] = 0.0;

    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    const double t1 = orthoglide_leg_tree_geo_g*c2;
    const double t2 = orthoglide_leg_tree_geo_g*s2;
    const double t3 = c3*t1 - s3*t2;
    const double t4 = c3*t2 + s3*t1;
    const double t5 = beta[24]*t3*s4 - beta[23]*t3*c4 + (beta[17]*t4 - beta[16]*t3);
    tau[2] = t1*beta[9] - t2*beta[10] - t5;
    tau[3] = -t5;
    tau[4] = -(s4*t4*beta[23] + c4*t4*beta[24]);
    const double t6 = orthoglide_leg_tree_geo_g*c5*beta[30];
    tau[5] = t6 - orthoglide_leg_tree_geo_g*s5*beta[31];
}

/* Coriolis and centripetal torques.
 * 131 additions, 199 multiplications. */
void orthoglide_leg_tree_coriolis(const double *q, const double *qd, const double *beta,
                                  double *MODELER_RESTRICT tau)
{
    const double k1 = orthoglide_leg_tree_geo_D4*2.0;

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

    const double t1 = c5*qd[1];
    const double t2 = qd[5]*qd[5];
    const double t3 = s5*qd[1];
    const double t4 = t3*t1;
    const double t5 = c5*((t1*t1 + t2)*beta[30] - t4*beta[31]);
    const double t6 = qd[2] + qd[3];
    const double t7 = s2*qd[1];
    const double t8 = c2*qd[1];
    const double t9 = c3*t7 + s3*t8;
    const double t10 = c4*t6 + s4*t9;
    const double t11 = c3*t8 - s3*t7;
    const double t12 = qd[4] + t11;
    const double t13 = t12*t12;
    const double t14 = t9*t6;
    const double t15 = c4*t9 - s4*t6;
    const double t16 = t15*t10;
    const double t17 = (t10*t10 + t13)*beta[23] - beta[24]*(t14 - t16);
    const double t18 = beta[23]*(t14 + t16) + (t15*t15 + t13)*beta[24];
    const double t19 = t6*t6;
    const double t20 = t9*t11;
    const double t21 = c4*t17 - s4*t18 + ((t11*t11 + t19)*beta[16] - t20*beta[17]);
    const double t22 = t11*t6;
    const double t23 = qd[4]*t15 + s4*t22;
    const double t24 = qd[4]*t10 - c4*t22;
    const double t25 = beta[23]*(t15*t12 + t23) - beta[24]*(t10*t12 + t24);
    const double t26 = t20*beta[16] - (t9*t9 + t19)*beta[17] + t25;
    const double t27 = qd[2]*qd[2];
    const double t28 = t8*t8 + t27;
    const double t29 = t7*t8;
    const double t30 = s3*t21 - c3*t26;
    const double t31 = c2*(c3*t21 + s3*t26 + (t28*beta[9] - t29*beta[10]));
    const double t32 = t31 - s2*((t7*t7 + t27)*beta[10] - t29*beta[9] + t30);
    const double t33 = qd[1]*qd[1];
    const double t34 = qd[5]*t3;
    const double t35 = qd[5]*t1;
    const double t36 = s4*t17 + c4*t18 + (2.0*t14*beta[16] + 2.0*t22*beta[17]);
    const double t37 = qd[2]*t7;
    const double t38 = qd[2]*t8;
    const double t39 = 2.0*t37*beta[9] + 2.0*t38*beta[10] + t36;
    const double t40 = s1*(t5 + s5*(t4*beta[30] - (t3*t3 + t2)*beta[31]) + t32 + t33*beta[2]);
    tau[0] = t40 + c1*(2.0*t34*beta[30] + 2.0*t35*beta[31] + t39 + t33*beta[3]);
    const double t41 = t3*beta[27] + t1*beta[28] - qd[5]*beta[29];
    const double t42 = t3*beta[26] - qd[5]*beta[28];
    const double t43 = t3*beta[25] + t1*beta[26] - qd[5]*beta[27];
    const double t44 = s5*(t35*beta[25] - t34*beta[26] - (t1*t41 + qd[5]*t42));
    const double t45 = t15*beta[20] - t10*beta[21] - t12*beta[22];
    const double t46 = t15*beta[19] - t12*beta[21];
    const double t47 = orthoglide_leg_tree_geo_D4*t29;
    const double t48 = orthoglide_leg_tree_geo_D4*t28;
    const double t49 = c3*t47 + s3*t48;
    const double t50 = beta[18]*t24 + beta[19]*t23 - t14*beta[20] + (t12*t46 - t10*t45);
    const double t51 = t50 - beta[24]*t49;
    const double t52 = t15*beta[18] - t10*beta[19] - t12*beta[20];
    const double t53 = beta[19]*t24 - t14*beta[21] - (t12*t52 + t15*t45) + beta[23]*t49;
    const double t54 = t9*beta[13] + t11*beta[14] - t6*beta[15];
    const double t55 = t9*beta[12] - t6*beta[14];
    const double t56 = k1*t37;
    const double t57 = t22*beta[11] - t14*beta[12] - (t11*t54 + t6*t55) + beta[17]*t56;
    const double t58 = c4*t51 - s4*t53 - t57;
    const double t59 = c3*t48 - s3*t47;
    const double t60 = beta[20]*t24 + beta[21]*t23 - t14*beta[22] + (t15*t46 + t10*t52);
    const double t61 = beta[24]*(c4*t59 + s4*t56) - beta[23]*(c4*t56 - s4*t59) + t60;
    const double t62 = t9*beta[11] + t11*beta[12] - t6*beta[13];
    const double t63 = t6*t62 + t9*t54 + t22*beta[12] - beta[16]*t56 + t61;
    const double t64 = t7*beta[6] + t8*beta[7] - qd[2]*beta[8];
    const double t65 = t7*beta[5] - qd[2]*beta[7];
    const double t66 = t7*beta[4] + t8*beta[5] - qd[2]*beta[6];
    const double t67 = s3*t58 - c3*t63 + orthoglide_leg_tree_geo_D4*t36;
    const double t68 = s2*(c3*t58 + s3*t63 + (t8*t64 + qd[2]*t65 - (t38*beta[4] - t37*beta[5])));
    const double t69 = t68 + c2*(t67 - (qd[2]*t66 + t7*t64 + t38*beta[5]));
    tau[1] = t44 + c5*(qd[5]*t43 + t3*t41 + t35*beta[26]) - t69;
    const double t70 = t22*beta[13] - t14*beta[14] + (t11*t62 - t9*t55);
    const double t71 = s4*t51 + c4*t53 + (beta[16]*t49 + beta[17]*t59 - t70);
    const double t72 = t38*beta[6] - t37*beta[7] + (t8*t66 - t7*t65);
    tau[2] = t71 - orthoglide_leg_tree_geo_D4*t30 - t72;
    tau[3] = t71;
    tau[4] = t61;
    tau[5] = t3*t42 - t1*t43 - (t35*beta[27] - t34*beta[28]);
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void orthoglide_leg_tree_friction(const double *qd, const double *beta,
                                  double *MODELER_RESTRICT tau)
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
 * 27 additions, 5 multiplications. */
void orthoglide_leg_tree_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = orthoglide_leg_tree_geo_D4*orthoglide_leg_tree_geo_D4;

    beta[0] = chi[9] + chi[19] + chi[29] + chi[39] + chi[49] + chi[59];
    const double t1 = k1*chi[39];
    const double t2 = k1*chi[49];
    beta[1] = chi[15] + chi[23] + chi[33] + t1 + t2 + chi[53];
    beta[2] = chi[16];
    beta[3] = chi[17] + chi[28] + chi[38] + chi[58];
    beta[4] = -(chi[23] - chi[20] + t1 + t2);
    beta[5] = chi[21];
    beta[6] = chi[22] - orthoglide_leg_tree_geo_D4*chi[38];
    beta[7] = chi[24];
    beta[8] = chi[25] + t1 + t2;
    const double t3 = chi[26] + orthoglide_leg_tree_geo_D4*chi[39];
    beta[9] = t3 + orthoglide_leg_tree_geo_D4*chi[49];
    beta[10] = chi[27];
    beta[11] = chi[30] - chi[33] + chi[43];
    beta[12] = chi[31];
    beta[13] = chi[32];
    beta[14] = chi[34];
    beta[15] = chi[35] + chi[43];
    beta[16] = chi[36];
    beta[17] = chi[37] - chi[48];
    beta[18] = chi[40] - chi[43];
    beta[19] = chi[41];
    beta[20] = chi[42];
    beta[21] = chi[44];
    beta[22] = chi[45];
    beta[23] = chi[46];
    beta[24] = chi[47];
    beta[25] = chi[50] - chi[53];
    beta[26] = chi[51];
    beta[27] = chi[52];
    beta[28] = chi[54];
    beta[29] = chi[55];
    beta[30] = chi[56];
    beta[31] = chi[57];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 12 additions, 33 multiplications. */
void orthoglide_leg_tree_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    MODELER_ALL_ZEROS(T, 72);

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

    T[0] = 1.0;
    T[5] = 1.0;
    T[10] = 1.0;
    T[11] = q[0];
    T[12] = c1;
    T[13] = -s1;
    T[18] = 1.0;
    MODELER_ZEROS(T + 1, 4);
    T[20] = -s1;
    T[21] = -c1;
    T[23] = q[0];
    const double t1 = c1*c2;
    T[24] = t1;
    const double t2 = c1*s2;
    T[25] = -t2;
    MODELER_ZEROS(T + 6, 4);
    T[26] = -s1;
    T[28] = -s2;
    T[29] = -c2;
    T[31] = orthoglide_leg_tree_geo_b3;
    const double t3 = s1*c2;
    T[32] = -t3;
    MODELER_ZEROS(T + 14, 4);
    const double t4 = s1*s2;
    T[33] = t4;
    T[34] = -c1;
    T[35] = q[0];
    const double t5 = c3*t1 - s3*t2;
    T[36] = t5;
    const double t6 = c3*t2 + s3*t1;
    MODELER_ZEROS(T + 19, 1);
    T[37] = -t6;
    T[38] = -s1;
    const double t7 = orthoglide_leg_tree_geo_D4*t1;
    T[39] = t7;
    const double t8 = s2*c3 + c2*s3;
    T[40] = -t8;
    MODELER_ZEROS(T + 22, 1);
    const double t9 = c2*c3 - s2*s3;
    T[41] = -t9;
    const double t10 = orthoglide_leg_tree_geo_b3 - orthoglide_leg_tree_geo_D4*s2;
    T[43] = t10;
    const double t11 = c3*t3 - s3*t4;
    T[44] = -t11;
    const double t12 = c3*t4 + s3*t3;
    MODELER_ZEROS(T + 27, 1);
    T[45] = t12;
    T[46] = -c1;
    const double t13 = q[0] - orthoglide_leg_tree_geo_D4*t3;
    T[47] = t13;
    T[48] = c4*t5 - s1*s4;
    T[49] = -(s1*c4 + s4*t5);
    T[50] = t6;
    MODELER_ZEROS(T + 30, 1);
    T[51] = t7;
    T[52] = -c4*t8;
    T[53] = s4*t8;
    T[54] = t9;
    T[55] = t10;
    T[56] = -(c4*t11 + c1*s4);
    MODELER_ZEROS(T + 42, 1);
    T[57] = s4*t11 - c1*c4;
    T[58] = -t12;
    T[59] = t13;
    T[60] = c1*c5;
    T[61] = -c1*s5;
    T[62] = -s1;
    T[64] = -s5;
    MODELER_ZEROS(T + 63, 1);
    T[65] = -c5;
    T[67] = orthoglide_leg_tree_geo_b7;
    T[68] = -s1*c5;
    T[69] = s1*s5;
    T[70] = -c1;
    T[71] = q[0];
    MODELER_ZEROS(T + 66, 1);
}
