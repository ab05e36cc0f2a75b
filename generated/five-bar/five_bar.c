/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 *
 * Temporaries are named by quantity, link and component: wd3_x is that of wd of link 3, in its own
 * frame; m3_1x is what one unit of joint 1 makes, f3_MXx what one unit of MX3 does; minus_wd3_x is
 * minus that. R3 turns from frame 3 to that of its antecedent; the base, link 0, has vd0 = -g.
 *
 *   w      angular velocity
 *   wd     angular acceleration
 *   vd     acceleration of the origin less gravity
 *   ww     products of the components of w
 *   n      moment on the link at its origin
 *   fc     force on the link and all that it carries
 *   nc     moment on the link and all that it carries
 *   lin_1  momentum of what hangs on a joint, for unit speed of it
 *   ang_1  angular momentum of what hangs on a joint, for unit speed of it
 *   x      axis x of the frame in frame 0
 *   o      origin of the frame in frame 0
 *   ...a   in axes of the antecedent: ang, fc, lin, nc, vd
 *   ...d   derivative by a variable, qd2 for qd[2], or by the time, t: o, x
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
void five_bar_tree_inverse_dynamics(const double q[4], const double qd[4], const double qdd[4],
                                    const double beta[11], double MODELER_OUT(tau, 4))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double wd21_z = qdd[0] + qdd[1];
    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd0 + U0 p11) */
    const double vd11_y = five_bar_geo_g*c0;
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double vd21a_y = vd11_y + five_bar_geo_L1*qdd[0];
    const double vd11_x = five_bar_geo_g*s0;
    const double vd21a_x = vd11_x - qd[0]*qd[0]*five_bar_geo_L1;
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = (c1*vd21a_y - s1*vd21a_x)*beta[4] - (c1*vd21a_x + s1*vd21a_y)*beta[5] +
        wd21_z*beta[3];
    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double w21_z = qd[0] + qd[1];
    const double ww21_zz = w21_z*w21_z;
    /* link 21: force on the link and all that it carries, fc21 = f21 + sum of R fc of what hangs on
        it */
    const double minus_fc21a_y = s1*(ww21_zz*beta[4] + wd21_z*beta[5]) + c1*(ww21_zz*beta[5] -
        wd21_z*beta[4]);
    tau[0] = n21_z - five_bar_geo_L1*minus_fc21a_y + (vd11_y*beta[1] - vd11_x*beta[2] +
        qdd[0]*beta[0]);
    tau[1] = n21_z;
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double wd22_z = qdd[2] + qdd[3];
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd0 + U0 p12) */
    const double vd12_x = five_bar_geo_g*s2;
    const double vd12_y = five_bar_geo_g*c2;
    /* link 22: acceleration of the origin less gravity, vd22 = R22' (vd12 + U12 p22) */
    const double vd22_x = c3*(vd12_x - qd[2]*qd[2]*five_bar_geo_L3) + s3*(vd12_y +
        five_bar_geo_L3*qdd[2]);
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = wd22_z*beta[9] - vd22_x*beta[10];
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double w22_z = qd[2] + qd[3];
    /* link 22: moment on the link and all that it carries, nc22 = n22 + sum of R nc + p x R fc of
        what hangs on it */
    const double nc22a_z = n22_z - five_bar_geo_L3*(w22_z*w22_z*beta[10]*c3 + wd22_z*beta[10]*s3);
    tau[2] = vd12_y*beta[7] - vd12_x*beta[8] + qdd[2]*beta[6] + nc22a_z;
    tau[3] = n22_z;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 7 additions, 7 multiplications. */
void five_bar_tree_inertia_matrix(const double q[4], const double beta[11],
                                  double MODELER_OUT(M, 4 * 4))
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

    const double minus_lin21a_21y = s1*beta[5] - c1*beta[4];
    M[0] = beta[0] + beta[3] - k2*minus_lin21a_21y;
    const double ang21a_21z = beta[3] - five_bar_geo_L1*minus_lin21a_21y;
    M[1] = ang21a_21z;
    M[4] = ang21a_21z;
    M[5] = beta[3];
    const double minus_lin22a_22y = s3*beta[10];
    M[10] = beta[6] + beta[9] - k1*minus_lin22a_22y;
    const double ang22a_22z = beta[9] - five_bar_geo_L3*minus_lin22a_22y;
    M[11] = ang22a_22z;
    M[14] = ang22a_22z;
    M[15] = beta[9];
}

/* Torques that hold the robot still, without friction.
 * 8 additions, 17 multiplications. */
void five_bar_tree_gravity(const double q[4], const double beta[11], double MODELER_OUT(tau, 4))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    /* link 11: acceleration of the origin less gravity, vd11 = R11' (vd0 + U0 p11) */
    const double vd11_y = five_bar_geo_g*c0;
    const double vd11_x = five_bar_geo_g*s0;
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = beta[4]*(c1*vd11_y - s1*vd11_x) - beta[5]*(c1*vd11_x + s1*vd11_y);
    tau[0] = vd11_y*beta[1] - vd11_x*beta[2] + n21_z;
    tau[1] = n21_z;
    /* link 12: acceleration of the origin less gravity, vd12 = R12' (vd0 + U0 p12) */
    const double vd12_x = five_bar_geo_g*s2;
    const double vd12_y = five_bar_geo_g*c2;
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double minus_n22_z = beta[10]*(c3*vd12_x + s3*vd12_y);
    tau[2] = vd12_y*beta[7] - vd12_x*beta[8] - minus_n22_z;
    tau[3] = -minus_n22_z;
}

/* Torques without gravity and friction.
 * 18 additions, 33 multiplications. */
void five_bar_tree_coriolis(const double q[4], const double qd[4], const double qdd[4],
                            const double beta[11], double MODELER_OUT(tau, 4))
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    /* link 21: angular velocity, w21 = R21' w11 + qd21 z */
    const double w21_z = qd[0] + qd[1];
    const double ww21_zz = w21_z*w21_z;
    /* link 21: angular acceleration, wd21 = R21' wd11 + (R21' w11) x qd21 z + qdd21 z */
    const double wd21_z = qdd[0] + qdd[1];
    /* link 21: force on the link and all that it carries, fc21 = f21 + sum of R fc of what hangs on
        it */
    const double minus_fc21a_y = s1*(ww21_zz*beta[4] + wd21_z*beta[5]) + c1*(ww21_zz*beta[5] -
        wd21_z*beta[4]);
    /* link 21: acceleration of the origin less gravity, vd21 = R21' (vd11 + U11 p21) */
    const double minus_vd21a_x = qd[0]*qd[0]*five_bar_geo_L1;
    const double vd21a_y = five_bar_geo_L1*qdd[0];
    /* link 21: moment on the link at its origin, n21 = J21 wd21 + w21 x J21 w21 + MS21 x vd21 */
    const double n21_z = beta[4]*(s1*minus_vd21a_x + c1*vd21a_y) + beta[5]*(c1*minus_vd21a_x -
        s1*vd21a_y) + wd21_z*beta[3];
    tau[0] = n21_z - five_bar_geo_L1*minus_fc21a_y + qdd[0]*beta[0];
    tau[1] = n21_z;
    /* link 22: angular velocity, w22 = R22' w12 + qd22 z */
    const double w22_z = qd[2] + qd[3];
    /* link 22: angular acceleration, wd22 = R22' wd12 + (R22' w12) x qd22 z + qdd22 z */
    const double wd22_z = qdd[2] + qdd[3];
    const double t10 = beta[10]*(qd[2]*qd[2]*five_bar_geo_L3*c3 - five_bar_geo_L3*qdd[2]*s3);
    /* link 22: moment on the link at its origin, n22 = J22 wd22 + w22 x J22 w22 + MS22 x vd22 */
    const double n22_z = wd22_z*beta[9] + t10;
    /* link 22: moment on the link and all that it carries, nc22 = n22 + sum of R nc + p x R fc of
        what hangs on it */
    const double minus_nc22a_z = five_bar_geo_L3*(w22_z*w22_z*beta[10]*c3 + wd22_z*beta[10]*s3) -
        n22_z;
    tau[2] = qdd[2]*beta[6] - minus_nc22a_z;
    tau[3] = n22_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void five_bar_tree_friction(const double qd[4], const double beta[11], double MODELER_OUT(tau, 4))
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
void five_bar_tree_forward_kinematics(const double q[4], double MODELER_OUT(T, 4 * 3 * 4))
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
    const double x21_x = c0*c1 - s0*s1;
    T[12] = x21_x;
    MODELER_ZEROS(T + 11, 1);
    const double x21_y = s0*c1 + c0*s1;
    T[13] = -x21_y;
    MODELER_ZEROS(T + 14, 1);
    T[15] = five_bar_geo_L1*c0;
    T[16] = x21_y;
    MODELER_ZEROS(T + 18, 1);
    T[17] = x21_x;
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
    const double x22_x = c2*c3 - s2*s3;
    MODELER_ZEROS(T + 35, 1);
    T[36] = x22_x;
    const double x22_y = s2*c3 + c2*s3;
    MODELER_ZEROS(T + 38, 1);
    T[37] = -x22_y;
    T[39] = five_bar_geo_L0 + five_bar_geo_L3*c2;
    MODELER_ZEROS(T + 42, 1);
    T[40] = x22_y;
    T[41] = x22_x;
    MODELER_ZEROS(T + 44, 2);
    T[43] = five_bar_geo_L3*s2;
    T[46] = 1.0;
    MODELER_ZEROS(T + 47, 1);
}

/* d/dt(df/du) ud.
 * 26 additions, 50 multiplications. */
void five_bar_tree_drift(const double q[4], const double qd[4], double MODELER_OUT(values, 2))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double o31d_q1y = five_bar_geo_L2*(c0*c1 - s0*s1);
    const double x11d_ty = c0*qd[0];
    const double t3 = s1*qd[1];
    const double minus_x11d_tx = s0*qd[0];
    const double t5 = c1*qd[1];
    const double t6 = five_bar_geo_L2*(c1*x11d_ty - s0*t3 + (c0*t5 - s1*minus_x11d_tx))*qd[1];
    const double x12d_ty = c2*qd[2];
    const double t8 = s3*qd[3];
    const double minus_x12d_tx = s2*qd[2];
    const double t10 = c3*qd[3];
    const double minus_o32dd_q3tx = five_bar_geo_L4*(c3*x12d_ty - s2*t8 + (c2*t10 -
        s3*minus_x12d_tx));
    const double minus_o31dd_ttx = qd[0]*((five_bar_geo_L1*c0 + o31d_q1y)*qd[0] + o31d_q1y*qd[1]) +
        t6;
    values[0] = qd[3]*minus_o32dd_q3tx - (minus_o31dd_ttx - qd[2]*(five_bar_geo_L3*x12d_ty +
        minus_o32dd_q3tx));
    const double minus_o31d_q1x = five_bar_geo_L2*(s0*c1 + c0*s1);
    const double t14 = five_bar_geo_L2*(c1*minus_x11d_tx + c0*t3 + (s1*x11d_ty + s0*t5))*qd[1];
    const double minus_o32dd_q3ty = five_bar_geo_L4*(c3*minus_x12d_tx + c2*t8 + (s3*x12d_ty +
        s2*t10));
    const double minus_o31dd_tty = qd[0]*((five_bar_geo_L1*s0 + minus_o31d_q1x)*qd[0] +
        minus_o31d_q1x*qd[1]) + t14;
    values[1] = qd[3]*minus_o32dd_q3ty - (minus_o31dd_tty - qd[2]*(five_bar_geo_L3*minus_x12d_tx +
        minus_o32dd_q3ty));
}

/* All equations of all loops, cosines, nonzeros of df/du, turns.
 * 12 additions, 16 multiplications. */
void five_bar_tree_closure(const double q[4], double MODELER_OUT(values, 19))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    const double o31d_q1y = five_bar_geo_L2*(c0*c1 - s0*s1);
    /* link 31: origin of the frame in frame 0, o31 = o21 + [x21 y21 z21] p31 */
    const double o31_x = five_bar_geo_L1*c0 + o31d_q1y;
    const double o22d_q2y = five_bar_geo_L3*c2;
    const double o32d_q3y = five_bar_geo_L4*(c2*c3 - s2*s3);
    values[0] = o31_x - (five_bar_geo_L0 + o22d_q2y + o32d_q3y);
    const double minus_o31d_q1x = five_bar_geo_L2*(s0*c1 + c0*s1);
    const double o31_y = five_bar_geo_L1*s0 + minus_o31d_q1x;
    const double minus_o32d_q3x = five_bar_geo_L4*(s2*c3 + c2*s3);
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
    const double o32_y = five_bar_geo_L3*s2 + minus_o32d_q3x;
    values[1] = o31_y - o32_y;
    values[2] = 1.0;
    values[3] = -o31_y;
    values[4] = -minus_o31d_q1x;
    values[5] = o32_y;
    values[6] = minus_o32d_q3x;
    values[7] = o31_x;
    values[8] = o31d_q1y;
    values[9] = -(o22d_q2y + o32d_q3y);
    values[10] = -o32d_q3y;
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
void five_bar_tree_residual(const double q[4], double MODELER_OUT(f, 2))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);

    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
    const double o32_x = five_bar_geo_L0 + five_bar_geo_L3*c2 + five_bar_geo_L4*(c2*c3 - s2*s3);
    f[0] = five_bar_geo_L1*c0 + five_bar_geo_L2*(c0*c1 - s0*s1) - o32_x;
    /* link 31: origin of the frame in frame 0, o31 = o21 + [x21 y21 z21] p31 */
    const double o31_y = five_bar_geo_L1*s0 + five_bar_geo_L2*(s0*c1 + c0*s1);
    f[1] = o31_y - (five_bar_geo_L3*s2 + five_bar_geo_L4*(s2*c3 + c2*s3));
}

/* Factors of the solved columns of J: 1/pivots, then the rest.
 * 1 additions, 4 multiplications. */
void five_bar_tree_factor(const double J[8], double MODELER_OUT(lu, 4))
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
void five_bar_tree_solve(const double lu[4], const double right[2], double MODELER_OUT(x, 2))
{
    const double t1 = lu[1]*(right[1] - lu[3]*right[0]);
    x[0] = lu[0]*(right[0] - lu[2]*t1);
    x[1] = t1;
}

/* G from the factors.
 * 4 additions, 8 multiplications. */
void five_bar_tree_coupling(const double J[8], const double lu[4], double MODELER_OUT(G, 4))
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
void five_bar_tree_turned(const double J[8], const double K[8], const double lu[4],
                          double MODELER_OUT(x, 2))
{
    const double t1 = fabs(J[1] - K[1]) + fabs(J[3] - K[3]);
    const double t2 = (fabs(J[5] - K[5]) + fabs(J[7] - K[7]) + t1*fabs(lu[3]))*fabs(lu[1]);
    x[0] = (t1 + t2*fabs(lu[2]))*fabs(lu[0]);
    x[1] = t2;
}

/* Sum of the squares of J^-1 (K - J).
 * 11 additions, 12 multiplications. */
void five_bar_tree_spread(const double J[8], const double K[8], const double lu[4],
                          double MODELER_OUT(x, 1))
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
void five_bar_base_parameters(const double chi[FIVE_BAR_STANDARD_PARAMETERS],
                              double MODELER_OUT(beta, FIVE_BAR_BASE_PARAMETERS))
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
