/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist.h.
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
 *   h      angular momentum J w
 *   f      force on the link
 *   n      moment on the link at its origin
 *   nc     moment on the link and all that it carries
 *   Jc     inertia of the link and all that it carries
 *   Js     what moving the inertia to the origin of the antecedent adds
 *   ang_1  angular momentum of what hangs on a joint, for unit speed of it
 *   x      axis x of the frame in frame 0
 *   y      axis y of the frame in frame 0
 *   ...a   in axes of the antecedent: ang, Jc, nc, vd
 */
#include "wrist.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DWRIST_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef WRIST_GEO_g
#define WRIST_GEO_g 9.81
#endif
#ifndef WRIST_GEO_al1
#define WRIST_GEO_al1 0.2
#endif
#ifndef WRIST_GEO_bl1
#define WRIST_GEO_bl1 0.1
#endif

static const double wrist_geo_g = WRIST_GEO_g;
static const double wrist_geo_al1 = WRIST_GEO_al1;
static const double wrist_geo_bl1 = WRIST_GEO_bl1;

const int wrist_nonzero_row[WRIST_NONZEROS] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2,
    2, 2, 2, 2, 2
};

const int wrist_nonzero_column[WRIST_NONZEROS] = {
    0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
    15, 16, 10, 11, 12, 13, 14, 15, 16
};

const char *wrist_signature(void)
{
    return "04a9ce4bbacd538f";
}

/* Joint torques, by the Newton-Euler recursion.
 * 77 additions, 105 multiplications. */
void wrist_inverse_dynamics(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                            const double qdd[WRIST_JOINTS],
                            const double beta[WRIST_BASE_PARAMETERS],
                            double MODELER_OUT(tau, WRIST_JOINTS))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double w2_x = s1*qd[0];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1] + s2*w2_x;
    const double w3_x = c2*w2_x - s2*qd[1];
    const double w2_y = c1*qd[0];
    const double w3_z = qd[2] + w2_y;
    const double h3_z = w3_x*beta[12] - minus_w3_y*beta[13] + w3_z*beta[14];
    const double h3_y = w3_x*beta[11] + w3_z*beta[13];
    const double ww2_yz = qd[1]*w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const double wd2_x = s1*qdd[0] + ww2_yz;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double wd3_x = c2*wd2_x - s2*qdd[1] - qd[2]*minus_w3_y;
    const double minus_wd3_y = c2*qdd[1] + s2*wd2_x + qd[2]*w3_x;
    const double wd2_y = c1*qdd[0] - qd[1]*w2_x;
    const double wd3_z = qdd[2] + wd2_y;
    /* link 1: acceleration of the origin less gravity, vd1 = R1' (vd0 + U0 p1) */
    const double vd1_x = wrist_geo_g*c0;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = s1*vd1_x;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3_z = minus_vd2_y + wrist_geo_bl1*(w2_x*w2_x + qd[1]*qd[1]);
    const double t17 = minus_w3_y*h3_z + w3_z*h3_y - (wd3_x*beta[10] - minus_wd3_y*beta[11] +
        wd3_z*beta[12]);
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_x = t17 + minus_vd3_z*beta[16];
    const double h3_x = w3_x*beta[10] - minus_w3_y*beta[11] + w3_z*beta[12];
    const double n3_y = w3_z*h3_x - w3_x*h3_z + (wd3_x*beta[11] + wd3_z*beta[13]) +
        minus_vd3_z*beta[15];
    const double ww3_zz = w3_z*w3_z;
    const double minus_ww3_xy = w3_x*minus_w3_y;
    /* link 3: force on the link, f3 = M3 vd3 + U3 MS3 */
    const double minus_f3_x = (minus_w3_y*minus_w3_y + ww3_zz)*beta[15] + (wd3_z +
        minus_ww3_xy)*beta[16];
    const double minus_f3_y = (w3_x*w3_x + ww3_zz)*beta[16] - (wd3_z - minus_ww3_xy)*beta[15];
    const double minus_vd1_y = wrist_geo_g*s0;
    const double h2_z = w2_x*beta[5] + w2_y*beta[6] + qd[1]*beta[7];
    const double h2_y = w2_x*beta[4] + qd[1]*beta[6];
    const double t28 = w2_y*h2_z - qd[1]*h2_y + (wd2_x*beta[3] + wd2_y*beta[4] + qdd[1]*beta[5]);
    /* link 2: moment on the link and all that it carries, nc2 = n2 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc2_x = c2*minus_n3_x + s2*n3_y - wrist_geo_bl1*(s2*minus_f3_x +
        c2*minus_f3_y) - (minus_vd1_y*beta[9] + t28);
    const double vd3a_z = minus_vd1_y + wrist_geo_bl1*(ww2_yz + wd2_x);
    const double vd2_x = c1*vd1_x;
    const double vd3a_x = vd2_x - wrist_geo_bl1*(qdd[1] - w2_x*w2_y);
    const double t33 = w3_x*h3_y + minus_w3_y*h3_x + (wd3_x*beta[12] - minus_wd3_y*beta[13] +
        wd3_z*beta[14]);
    const double n3_z = t33 - ((c2*vd3a_z + s2*vd3a_x)*beta[15] + (c2*vd3a_x - s2*vd3a_z)*beta[16]);
    const double h2_x = w2_x*beta[3] + w2_y*beta[4] + qd[1]*beta[5];
    const double nc2_y = qd[1]*h2_x - w2_x*h2_z + (wd2_x*beta[4] + qdd[1]*beta[6]) -
        minus_vd1_y*beta[8] + n3_z;
    tau[0] = -(s1*minus_nc2_x - c1*nc2_y + (minus_vd1_y*beta[1] + vd1_x*beta[2] - qdd[0]*beta[0]));
    const double t37 = w2_x*h2_y - w2_y*h2_x + (wd2_x*beta[5] + wd2_y*beta[6] + qdd[1]*beta[7]);
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double nc3a_z = s2*minus_n3_x - c2*n3_y + wrist_geo_bl1*(c2*minus_f3_x - s2*minus_f3_y);
    tau[1] = t37 - (minus_vd2_y*beta[8] + vd2_x*beta[9]) + nc3a_z;
    tau[2] = n3_z;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 24 additions, 28 multiplications. */
void wrist_inertia_matrix(const double q[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                          double MODELER_OUT(M, 3 * 3))
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    const double t1 = c2*beta[10] - s2*beta[11];
    const double t2 = c2*beta[11];
    const double t3 = s2*t2;
    const double Js3_xy = wrist_geo_bl1*(s2*beta[16] - c2*beta[15]);
    /* link 3: inertia of the link and all that it carries, Jc3 = J3 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc3a_xy = c2*beta[12] - s2*beta[13];
    /* link 2: inertia of the link and all that it carries, Jc2 = J2 + sum of R Jc R' + Js of what
        hangs on it */
    const double Jc2_xy = beta[4] + Jc3a_xy + Js3_xy;
    const double t7 = c1*beta[14];
    M[0] = s1*(s1*(c2*t1 - t3 + beta[3]) + c1*Jc2_xy) + c1*(t7 + s1*Jc2_xy) + beta[0];
    const double Js3_yz = wrist_geo_bl1*(c2*beta[16] + s2*beta[15]);
    const double minus_Jc3a_yz = s2*beta[12] + c2*beta[13];
    /* link 1: inertia of the link and all that it carries, Jc1 = J1 + sum of R Jc R' + Js of what
        hangs on it */
    const double minus_Jc1_yz = s1*(beta[5] - (s2*t1 + c2*t2)) + c1*(beta[6] - minus_Jc3a_yz +
        Js3_yz);
    M[1] = minus_Jc1_yz;
    const double ang2a_3z = s1*(Jc3a_xy + Js3_xy) + t7;
    M[2] = ang2a_3z;
    M[3] = minus_Jc1_yz;
    M[4] = t3 + s2*(s2*beta[10] + t2) + beta[7];
    const double minus_ang3a_3z = minus_Jc3a_yz - Js3_yz;
    M[5] = -minus_ang3a_3z;
    M[6] = ang2a_3z;
    M[7] = -minus_ang3a_3z;
    M[8] = beta[14];
}

/* Torques that hold the robot still, without friction.
 * 12 additions, 24 multiplications. */
void wrist_gravity(const double q[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                   double MODELER_OUT(tau, WRIST_JOINTS))
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    /* link 1: acceleration of the origin less gravity, vd1 = R1' (vd0 + U0 p1) */
    const double vd1_x = wrist_geo_g*c0;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const double minus_vd2_y = s1*vd1_x;
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_x = minus_vd2_y*beta[16];
    const double n3_y = minus_vd2_y*beta[15];
    const double minus_vd1_y = wrist_geo_g*s0;
    const double vd2_x = c1*vd1_x;
    const double minus_n3_z = beta[15]*(c2*minus_vd1_y + s2*vd2_x) + beta[16]*(c2*vd2_x -
        s2*minus_vd1_y);
    /* link 2: moment on the link and all that it carries, nc2 = n2 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc2a_z = s1*(c2*minus_n3_x + s2*n3_y - minus_vd1_y*beta[9]) + c1*(minus_n3_z
        + minus_vd1_y*beta[8]);
    tau[0] = -(minus_vd1_y*beta[1] + vd1_x*beta[2] + minus_nc2a_z);
    tau[1] = s2*minus_n3_x - c2*n3_y - (minus_vd2_y*beta[8] + vd2_x*beta[9]);
    tau[2] = -minus_n3_z;
}

/* Coriolis and centripetal torques.
 * 57 additions, 87 multiplications. */
void wrist_coriolis(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                    const double beta[WRIST_BASE_PARAMETERS],
                    double MODELER_OUT(tau, WRIST_JOINTS))
{
    const double k1 = wrist_geo_bl1*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const double w2_x = s1*qd[0];
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const double minus_w3_y = c2*qd[1] + s2*w2_x;
    const double w2_y = c1*qd[0];
    const double ww2_yz = qd[1]*w2_y;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const double minus_wd3_x = qd[2]*minus_w3_y - c2*ww2_yz;
    const double w3_x = c2*w2_x - s2*qd[1];
    const double minus_wd3_y = qd[2]*w3_x + s2*ww2_yz;
    const double ww2_xz = qd[1]*w2_x;
    const double w3_z = qd[2] + w2_y;
    const double h3_z = w3_x*beta[12] - minus_w3_y*beta[13] + w3_z*beta[14];
    const double h3_y = w3_x*beta[11] + w3_z*beta[13];
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const double minus_vd3_z = wrist_geo_bl1*(w2_x*w2_x + qd[1]*qd[1]);
    /* link 3: moment on the link at its origin, n3 = J3 wd3 + w3 x J3 w3 + MS3 x vd3 */
    const double minus_n3_x = beta[10]*minus_wd3_x + beta[11]*minus_wd3_y + ww2_xz*beta[12] +
        (minus_w3_y*h3_z + w3_z*h3_y) + minus_vd3_z*beta[16];
    const double h3_x = w3_x*beta[10] - minus_w3_y*beta[11] + w3_z*beta[12];
    const double minus_n3_y = beta[11]*minus_wd3_x + ww2_xz*beta[13] + (w3_x*h3_z - w3_z*h3_x) -
        minus_vd3_z*beta[15];
    const double ww3_zz = w3_z*w3_z;
    const double minus_ww3_xy = w3_x*minus_w3_y;
    /* link 3: force on the link, f3 = M3 vd3 + U3 MS3 */
    const double minus_f3_x = (minus_w3_y*minus_w3_y + ww3_zz)*beta[15] - beta[16]*(ww2_xz -
        minus_ww3_xy);
    const double minus_f3_y = beta[15]*(ww2_xz + minus_ww3_xy) + (w3_x*w3_x + ww3_zz)*beta[16];
    const double h2_z = w2_x*beta[5] + w2_y*beta[6] + qd[1]*beta[7];
    const double h2_y = w2_x*beta[4] + qd[1]*beta[6];
    /* link 3: moment on the link and all that it carries, nc3 = n3 + sum of R nc + p x R fc of what
        hangs on it */
    const double minus_nc3a_x = c2*minus_n3_x - s2*minus_n3_y - wrist_geo_bl1*(s2*minus_f3_x +
        c2*minus_f3_y);
    const double vd3a_z = k1*ww2_yz;
    const double vd3a_x = w2_x*w2_y*wrist_geo_bl1;
    const double t25 = beta[12]*minus_wd3_x + beta[13]*minus_wd3_y + ww2_xz*beta[14] - (w3_x*h3_y +
        minus_w3_y*h3_x);
    const double minus_n3_z = beta[15]*(c2*vd3a_z + s2*vd3a_x) + beta[16]*(c2*vd3a_x - s2*vd3a_z) +
        t25;
    const double h2_x = w2_x*beta[3] + w2_y*beta[4] + qd[1]*beta[5];
    const double t28 = s1*(minus_nc3a_x - (ww2_yz*beta[3] - ww2_xz*beta[4] + (w2_y*h2_z -
        qd[1]*h2_y)));
    tau[0] = -(t28 + c1*(minus_n3_z - (qd[1]*h2_x - w2_x*h2_z + ww2_yz*beta[4])));
    const double nc3a_z = s2*minus_n3_x + c2*minus_n3_y + wrist_geo_bl1*(c2*minus_f3_x -
        s2*minus_f3_y);
    tau[1] = ww2_yz*beta[5] - ww2_xz*beta[6] + (w2_x*h2_y - w2_y*h2_x) + nc3a_z;
    tau[2] = -minus_n3_z;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void wrist_friction(const double qd[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                    double MODELER_OUT(tau, WRIST_JOINTS))
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 12 additions, 3 multiplications. */
void wrist_base_parameters(const double chi[WRIST_STANDARD_PARAMETERS],
                           double MODELER_OUT(beta, WRIST_BASE_PARAMETERS))
{
    const double k1 = wrist_geo_bl1*wrist_geo_bl1;
    const double k2 = wrist_geo_bl1*2.0;

    beta[0] = chi[5] + chi[13];
    beta[1] = chi[6];
    beta[2] = chi[7] - chi[18];
    const double t1 = k2*chi[28];
    const double t2 = k1*chi[29];
    beta[3] = chi[10] - chi[13] + chi[23] + t1 + t2;
    beta[4] = chi[11];
    beta[5] = chi[12];
    beta[6] = chi[14];
    beta[7] = chi[15] + chi[23] + t1 + t2;
    beta[8] = chi[16];
    beta[9] = chi[17] + chi[28] + wrist_geo_bl1*chi[29];
    beta[10] = chi[20] - chi[23];
    beta[11] = chi[21];
    beta[12] = chi[22];
    beta[13] = chi[24];
    beta[14] = chi[25];
    beta[15] = chi[26];
    beta[16] = chi[27];
}

/* Poses of the frames of all moving rows of the table, in order.
 * 5 additions, 17 multiplications. */
void wrist_forward_kinematics(const double q[WRIST_JOINTS], double MODELER_OUT(T, 3 * 3 * 4))
{
    T[2] = 0.0;
    T[3] = 0.0;
    T[6] = 0.0;
    T[7] = 0.0;
    T[8] = 0.0;
    T[9] = 0.0;
    T[15] = 0.0;
    T[19] = 0.0;
    T[22] = 0.0;

    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    T[0] = -s0;
    T[1] = -c0;
    T[4] = c0;
    T[5] = -s0;
    T[10] = 1.0;
    T[11] = wrist_geo_al1;
    const double minus_x2_x = s0*c1;
    T[12] = -minus_x2_x;
    const double y2_x = s0*s1;
    T[13] = y2_x;
    T[14] = c0;
    const double x2_y = c0*c1;
    T[16] = x2_y;
    const double minus_y2_y = c0*s1;
    T[17] = -minus_y2_y;
    T[18] = s0;
    T[20] = s1;
    T[21] = c1;
    T[23] = wrist_geo_al1;
    T[24] = -(c2*minus_x2_x + c0*s2);
    T[25] = s2*minus_x2_x - c0*c2;
    T[26] = y2_x;
    T[27] = wrist_geo_bl1*y2_x;
    T[28] = c2*x2_y - s0*s2;
    T[29] = -(s0*c2 + s2*x2_y);
    T[30] = -minus_y2_y;
    T[31] = -wrist_geo_bl1*minus_y2_y;
    T[32] = s1*c2;
    T[33] = -s1*s2;
    T[34] = c1;
    T[35] = wrist_geo_al1 + wrist_geo_bl1*c1;
}
