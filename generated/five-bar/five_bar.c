/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "five_bar.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "five_bar_tree.h"

/* Geometry. To use another value, compile with e.g. -DFIVE_BAR_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef FIVE_BAR_GEO_g
#define FIVE_BAR_GEO_g 9.81
#endif
#ifndef FIVE_BAR_GEO_L0
#define FIVE_BAR_GEO_L0 0.2
#endif
#ifndef FIVE_BAR_GEO_L1
#define FIVE_BAR_GEO_L1 0.3
#endif
#ifndef FIVE_BAR_GEO_L2
#define FIVE_BAR_GEO_L2 0.4
#endif
#ifndef FIVE_BAR_GEO_L3
#define FIVE_BAR_GEO_L3 0.31
#endif
#ifndef FIVE_BAR_GEO_L4
#define FIVE_BAR_GEO_L4 0.42
#endif

static const double five_bar_geo_g = FIVE_BAR_GEO_g;
static const double five_bar_geo_L0 = FIVE_BAR_GEO_L0;
static const double five_bar_geo_L1 = FIVE_BAR_GEO_L1;
static const double five_bar_geo_L2 = FIVE_BAR_GEO_L2;
static const double five_bar_geo_L3 = FIVE_BAR_GEO_L3;
static const double five_bar_geo_L4 = FIVE_BAR_GEO_L4;

/* Joint torques, by the Newton-Euler recursion.
 * 26 additions, 41 multiplications. */
void five_bar_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                    const double *beta, double *MODELER_RESTRICT tau)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = qdd[0] + qdd[1];
    const double t2 = five_bar_geo_g*c0;
    const double t3 = t2 + five_bar_geo_L1*qdd[0];
    const double t4 = five_bar_geo_g*s0;
    const double t5 = t4 - qd[0]*qd[0]*five_bar_geo_L1;
    const double t6 = (c1*t3 - s1*t5)*beta[4] - (c1*t5 + s1*t3)*beta[5] + t1*beta[3];
    const double t7 = qd[0] + qd[1];
    const double t8 = t7*t7;
    const double t9 = s1*(t8*beta[4] + t1*beta[5]) + c1*(t8*beta[5] - t1*beta[4]);
    tau[0] = t6 - five_bar_geo_L1*t9 + (t2*beta[1] - t4*beta[2] + qdd[0]*beta[0]);
    tau[1] = t6;
    const double t10 = qdd[2] + qdd[3];
    const double t11 = five_bar_geo_g*s2;
    const double t12 = five_bar_geo_g*c2;
    const double t13 = c3*(t11 - qd[2]*qd[2]*five_bar_geo_L3) + s3*(t12 + five_bar_geo_L3*qdd[2]);
    const double t14 = t10*beta[9] - t13*beta[10];
    const double t15 = qd[2] + qd[3];
    const double t16 = t14 - five_bar_geo_L3*(t15*t15*beta[10]*c3 + t10*beta[10]*s3);
    tau[2] = t12*beta[7] - t11*beta[8] + qdd[2]*beta[6] + t16;
    tau[3] = t14;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 7 additions, 7 multiplications. */
void five_bar_tree_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    M[2] = 0.0;
    M[3] = 0.0;
    M[6] = 0.0;
    M[7] = 0.0;
    M[8] = 0.0;
    M[9] = 0.0;
    M[12] = 0.0;
    M[13] = 0.0;

    const double k1 = five_bar_geo_L3*2.0;
    const double k2 = five_bar_geo_L1*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = s1*beta[5] - c1*beta[4];
    M[0] = beta[0] + beta[3] - k2*t1;
    const double t2 = beta[3] - five_bar_geo_L1*t1;
    M[1] = t2;
    M[4] = t2;
    M[5] = beta[3];
    const double t3 = s3*beta[10];
    M[10] = beta[6] + beta[9] - k1*t3;
    const double t4 = beta[9] - five_bar_geo_L3*t3;
    M[11] = t4;
    M[14] = t4;
    M[15] = beta[9];
}

/* Torques that hold the robot still, without friction.
 * 8 additions, 17 multiplications. */
void five_bar_tree_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = five_bar_geo_g*c0;
    const double t2 = five_bar_geo_g*s0;
    const double t3 = beta[4]*(c1*t1 - s1*t2) - beta[5]*(c1*t2 + s1*t1);
    tau[0] = t1*beta[1] - t2*beta[2] + t3;
    tau[1] = t3;
    const double t4 = five_bar_geo_g*s2;
    const double t5 = five_bar_geo_g*c2;
    const double t6 = beta[10]*(c3*t4 + s3*t5);
    tau[2] = t5*beta[7] - t4*beta[8] - t6;
    tau[3] = -t6;
}

/* Torques without gravity and friction.
 * 18 additions, 33 multiplications. */
void five_bar_tree_coriolis(const double *q, const double *qd, const double *qdd,
                            const double *beta, double *MODELER_RESTRICT tau)
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = qd[0] + qd[1];
    const double t2 = t1*t1;
    const double t3 = qdd[0] + qdd[1];
    const double t4 = s1*(t2*beta[4] + t3*beta[5]) + c1*(t2*beta[5] - t3*beta[4]);
    const double t5 = qd[0]*qd[0]*five_bar_geo_L1;
    const double t6 = five_bar_geo_L1*qdd[0];
    const double t7 = beta[4]*(s1*t5 + c1*t6) + beta[5]*(c1*t5 - s1*t6) + t3*beta[3];
    tau[0] = t7 - five_bar_geo_L1*t4 + qdd[0]*beta[0];
    tau[1] = t7;
    const double t8 = qd[2] + qd[3];
    const double t9 = qdd[2] + qdd[3];
    const double t10 = beta[10]*(qd[2]*qd[2]*five_bar_geo_L3*c3 - five_bar_geo_L3*qdd[2]*s3);
    const double t11 = t9*beta[9] + t10;
    const double t12 = five_bar_geo_L3*(t8*t8*beta[10]*c3 + t9*beta[10]*s3) - t11;
    tau[2] = qdd[2]*beta[6] - t12;
    tau[3] = t11;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void five_bar_tree_friction(const double *qd, const double *beta, double *MODELER_RESTRICT tau)
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
    tau[3] = 0.0;
}

/* Poses of the frames of all moving rows of the table, in order.
 * 5 additions, 12 multiplications. */
void five_bar_tree_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    MODELER_ALL_ZEROS(T, 48);

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    T[0] = c0;
    T[1] = -s0;
    T[4] = s0;
    MODELER_ZEROS(T + 2, 2);
    T[5] = c0;
    T[10] = 1.0;
    MODELER_ZEROS(T + 6, 4);
    const double t1 = c0*c1 - s0*s1;
    T[12] = t1;
    MODELER_ZEROS(T + 11, 1);
    const double t2 = s0*c1 + c0*s1;
    T[13] = -t2;
    MODELER_ZEROS(T + 14, 1);
    T[15] = five_bar_geo_L1*c0;
    T[16] = t2;
    MODELER_ZEROS(T + 18, 1);
    T[17] = t1;
    T[19] = five_bar_geo_L1*s0;
    MODELER_ZEROS(T + 20, 2);
    T[22] = 1.0;
    T[24] = c2;
    MODELER_ZEROS(T + 23, 1);
    T[25] = -s2;
    T[27] = five_bar_geo_L0;
    MODELER_ZEROS(T + 26, 1);
    T[28] = s2;
    T[29] = c2;
    MODELER_ZEROS(T + 30, 4);
    T[34] = 1.0;
    const double t3 = c2*c3 - s2*s3;
    MODELER_ZEROS(T + 35, 1);
    T[36] = t3;
    const double t4 = s2*c3 + c2*s3;
    MODELER_ZEROS(T + 38, 1);
    T[37] = -t4;
    T[39] = five_bar_geo_L0 + five_bar_geo_L3*c2;
    MODELER_ZEROS(T + 42, 1);
    T[40] = t4;
    T[41] = t3;
    MODELER_ZEROS(T + 44, 2);
    T[43] = five_bar_geo_L3*s2;
    T[46] = 1.0;
    MODELER_ZEROS(T + 47, 1);
}

/* d/dt(df/du) ud.
 * 26 additions, 50 multiplications. */
void five_bar_tree_drift(const double *q, const double *qd, double *MODELER_RESTRICT values)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = five_bar_geo_L2*(c0*c1 - s0*s1);
    const double t2 = c0*qd[0];
    const double t3 = s1*qd[1];
    const double t4 = s0*qd[0];
    const double t5 = c1*qd[1];
    const double t6 = five_bar_geo_L2*(c1*t2 - s0*t3 + (c0*t5 - s1*t4))*qd[1];
    const double t7 = c2*qd[2];
    const double t8 = s3*qd[3];
    const double t9 = s2*qd[2];
    const double t10 = c3*qd[3];
    const double t11 = five_bar_geo_L4*(c3*t7 - s2*t8 + (c2*t10 - s3*t9));
    const double t12 = qd[0]*((five_bar_geo_L1*c0 + t1)*qd[0] + t1*qd[1]) + t6;
    values[0] = qd[3]*t11 - (t12 - qd[2]*(five_bar_geo_L3*t7 + t11));
    const double t13 = five_bar_geo_L2*(s0*c1 + c0*s1);
    const double t14 = five_bar_geo_L2*(c1*t4 + c0*t3 + (s1*t2 + s0*t5))*qd[1];
    const double t15 = five_bar_geo_L4*(c3*t9 + c2*t8 + (s3*t7 + s2*t10));
    const double t16 = qd[0]*((five_bar_geo_L1*s0 + t13)*qd[0] + t13*qd[1]) + t14;
    values[1] = qd[3]*t15 - (t16 - qd[2]*(five_bar_geo_L3*t9 + t15));
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 12 additions, 16 multiplications. */
void five_bar_tree_closure(const double *q, double *MODELER_RESTRICT values)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = five_bar_geo_L2*(c0*c1 - s0*s1);
    const double t2 = five_bar_geo_L1*c0 + t1;
    const double t3 = five_bar_geo_L3*c2;
    const double t4 = five_bar_geo_L4*(c2*c3 - s2*s3);
    values[0] = t2 - (five_bar_geo_L0 + t3 + t4);
    const double t5 = five_bar_geo_L2*(s0*c1 + c0*s1);
    const double t6 = five_bar_geo_L1*s0 + t5;
    const double t7 = five_bar_geo_L4*(s2*c3 + c2*s3);
    const double t8 = five_bar_geo_L3*s2 + t7;
    values[1] = t6 - t8;
    values[2] = 1.0;
    values[3] = -t6;
    values[4] = -t5;
    values[5] = t8;
    values[6] = t7;
    values[7] = t2;
    values[8] = t1;
    values[9] = -(t3 + t4);
    values[10] = -t4;
    values[11] = c0;
    values[12] = s0;
    values[13] = c1;
    values[14] = s1;
    values[15] = c2;
    values[16] = s2;
    values[17] = c3;
    values[18] = s3;
}

/* The independent equations.
 * 11 additions, 16 multiplications. */
void five_bar_tree_residual(const double *q, double *MODELER_RESTRICT f)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double t1 = five_bar_geo_L0 + five_bar_geo_L3*c2 + five_bar_geo_L4*(c2*c3 - s2*s3);
    f[0] = five_bar_geo_L1*c0 + five_bar_geo_L2*(c0*c1 - s0*s1) - t1;
    const double t2 = five_bar_geo_L1*s0 + five_bar_geo_L2*(s0*c1 + c0*s1);
    f[1] = t2 - (five_bar_geo_L3*s2 + five_bar_geo_L4*(s2*c3 + c2*s3));
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 1 additions, 4 multiplications. */
void five_bar_tree_factor(const double *J, double *MODELER_RESTRICT lu)
{
    const double t1 = 1.0/J[1];
    lu[0] = t1;
    const double t2 = J[5]*t1;
    lu[1] = 1.0/(J[7] - J[3]*t2);
    lu[2] = J[3];
    lu[3] = t2;
}

/* Solution with the factors.
 * 2 additions, 4 multiplications. */
void five_bar_tree_solve(const double *lu, const double *right, double *MODELER_RESTRICT x)
{
    const double t1 = lu[1]*(right[1] - lu[3]*right[0]);
    x[0] = lu[0]*(right[0] - lu[2]*t1);
    x[1] = t1;
}

/* G from the factors.
 * 4 additions, 8 multiplications. */
void five_bar_tree_coupling(const double *J, const double *lu, double *MODELER_RESTRICT G)
{
    const double t1 = lu[1]*(J[4] - J[0]*lu[3]);
    G[0] = -lu[0]*(J[0] - lu[2]*t1);
    G[1] = -t1;
    const double t2 = lu[1]*(J[6] - J[2]*lu[3]);
    G[2] = -lu[0]*(J[2] - lu[2]*t2);
    G[3] = -t2;
}

/* Bounds of the rows of J^-1 (K - J).
 * 8 additions, 4 multiplications. */
void five_bar_tree_turned(const double *J, const double *K, const double *lu,
                          double *MODELER_RESTRICT x)
{
    const double t1 = fabs(J[1] - K[1]) + fabs(J[3] - K[3]);
    const double t2 = (fabs(J[5] - K[5]) + fabs(J[7] - K[7]) + t1*fabs(lu[3]))*fabs(lu[1]);
    x[0] = (t1 + t2*fabs(lu[2]))*fabs(lu[0]);
    x[1] = t2;
}

/* Sum of the squares of J^-1 (K - J).
 * 11 additions, 12 multiplications. */
void five_bar_tree_spread(const double *J, const double *K, const double *lu,
                          double *MODELER_RESTRICT x)
{
    const double t1 = J[1] - K[1];
    const double t2 = lu[1]*(J[5] - K[5] - lu[3]*t1);
    const double t3 = lu[0]*(t1 - lu[2]*t2);
    const double t4 = J[3] - K[3];
    const double t5 = lu[1]*(J[7] - K[7] - lu[3]*t4);
    const double t6 = lu[0]*(t4 - lu[2]*t5);
    x[0] = t3*t3 + t2*t2 + t6*t6 + t5*t5;
}

/* Base parameters from standard ones: the grouping relations.
 * 11 additions, 11 multiplications. */
void five_bar_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
{
    const double k1 = five_bar_geo_L1*five_bar_geo_L1;
    const double k2 = 1.0/five_bar_geo_L4;
    const double k3 = k1*k2;
    const double k4 = five_bar_geo_L1*k2;
    const double k5 = five_bar_geo_L2*five_bar_geo_L2*k2;
    const double k6 = five_bar_geo_L2*k2;
    const double k7 = five_bar_geo_L3*five_bar_geo_L3;
    const double k8 = k2*k7;
    const double k9 = five_bar_geo_L3*k2;

    beta[0] = chi[5] + k1*chi[19] + k3*chi[36];
    beta[1] = chi[6] + five_bar_geo_L1*chi[19] + k4*chi[36];
    beta[2] = chi[7];
    beta[3] = chi[15] + k5*chi[36];
    beta[4] = chi[16] + k6*chi[36];
    beta[5] = chi[17];
    beta[6] = chi[25] - k8*chi[36] + k7*chi[39];
    beta[7] = chi[26] - k9*chi[36] + five_bar_geo_L3*chi[39];
    beta[8] = chi[27];
    beta[9] = chi[35] - five_bar_geo_L4*chi[36];
    beta[10] = chi[37];
}
