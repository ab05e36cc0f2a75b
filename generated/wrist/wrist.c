/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
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
    return "c67e08e798fc0aab";
}

void wrist_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                       double *MODELER_RESTRICT W)
{
    const modeler_input inputs[3] = {
        {q, WRIST_JOINTS},
        {qd, WRIST_JOINTS},
        {qdd, WRIST_JOINTS},
    };

    modeler_batch_3(wrist_base_regressor, samples, inputs, W,
                    (size_t)WRIST_JOINTS * WRIST_BASE_PARAMETERS);
}

/* Joint torques, by the Newton-Euler recursion.
 * 77 additions, 105 multiplications. */
void wrist_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                            const double *beta, double *MODELER_RESTRICT tau)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    const double t1 = s1*qd[0];
    const double t2 = c2*qd[1] + s2*t1;
    const double t3 = c2*t1 - s2*qd[1];
    const double t4 = c1*qd[0];
    const double t5 = qd[2] + t4;
    const double t6 = t3*beta[12] - t2*beta[13] + t5*beta[14];
    const double t7 = t3*beta[11] + t5*beta[13];
    const double t8 = qd[1]*t4;
    const double t9 = s1*qdd[0] + t8;
    const double t10 = c2*t9 - s2*qdd[1] - qd[2]*t2;
    const double t11 = c2*qdd[1] + s2*t9 + qd[2]*t3;
    const double t12 = c1*qdd[0] - qd[1]*t1;
    const double t13 = qdd[2] + t12;
    const double t14 = wrist_geo_g*c0;
    const double t15 = s1*t14;
    const double t16 = t15 + wrist_geo_bl1*(t1*t1 + qd[1]*qd[1]);
    const double t17 = t2*t6 + t5*t7 - (t10*beta[10] - t11*beta[11] + t13*beta[12]);
    const double t18 = t17 + t16*beta[16];
    const double t19 = t3*beta[10] - t2*beta[11] + t5*beta[12];
    const double t20 = t5*t19 - t3*t6 + (t10*beta[11] + t13*beta[13]) + t16*beta[15];
    const double t21 = t5*t5;
    const double t22 = t3*t2;
    const double t23 = (t2*t2 + t21)*beta[15] + (t13 + t22)*beta[16];
    const double t24 = (t3*t3 + t21)*beta[16] - (t13 - t22)*beta[15];
    const double t25 = wrist_geo_g*s0;
    const double t26 = t1*beta[5] + t4*beta[6] + qd[1]*beta[7];
    const double t27 = t1*beta[4] + qd[1]*beta[6];
    const double t28 = t4*t26 - qd[1]*t27 + (t9*beta[3] + t12*beta[4] + qdd[1]*beta[5]);
    const double t29 = c2*t18 + s2*t20 - wrist_geo_bl1*(s2*t23 + c2*t24) - (t25*beta[9] + t28);
    const double t30 = t25 + wrist_geo_bl1*(t8 + t9);
    const double t31 = c1*t14;
    const double t32 = t31 - wrist_geo_bl1*(qdd[1] - t1*t4);
    const double t33 = t3*t7 + t2*t19 + (t10*beta[12] - t11*beta[13] + t13*beta[14]);
    const double t34 = t33 - ((c2*t30 + s2*t32)*beta[15] + (c2*t32 - s2*t30)*beta[16]);
    const double t35 = t1*beta[3] + t4*beta[4] + qd[1]*beta[5];
    const double t36 = qd[1]*t35 - t1*t26 + (t9*beta[4] + qdd[1]*beta[6]) - t25*beta[8] + t34;
    tau[0] = -(s1*t29 - c1*t36 + (t25*beta[1] + t14*beta[2] - qdd[0]*beta[0]));
    const double t37 = t1*t27 - t4*t35 + (t9*beta[5] + t12*beta[6] + qdd[1]*beta[7]);
    const double t38 = s2*t18 - c2*t20 + wrist_geo_bl1*(c2*t23 - s2*t24);
    tau[1] = t37 - (t15*beta[8] + t31*beta[9]) + t38;
    tau[2] = t34;
}

/* Inertia matrix, rotor inertias included; symmetric.
 * 24 additions, 28 multiplications. */
void wrist_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    const double t1 = c2*beta[10] - s2*beta[11];
    const double t2 = c2*beta[11];
    const double t3 = s2*t2;
    const double t4 = wrist_geo_bl1*(s2*beta[16] - c2*beta[15]);
    const double t5 = c2*beta[12] - s2*beta[13];
    const double t6 = beta[4] + t5 + t4;
    const double t7 = c1*beta[14];
    M[0] = s1*(s1*(c2*t1 - t3 + beta[3]) + c1*t6) + c1*(t7 + s1*t6) + beta[0];
    const double t8 = wrist_geo_bl1*(c2*beta[16] + s2*beta[15]);
    const double t9 = s2*beta[12] + c2*beta[13];
    const double t10 = s1*(beta[5] - (s2*t1 + c2*t2)) + c1*(beta[6] - t9 + t8);
    M[1] = t10;
    const double t11 = s1*(t5 + t4) + t7;
    M[2] = t11;
    M[3] = t10;
    M[4] = t3 + s2*(s2*beta[10] + t2) + beta[7];
    const double t12 = t9 - t8;
    M[5] = -t12;
    M[6] = t11;
    M[7] = -t12;
    M[8] = beta[14];
}

/* Torques that hold the robot still, without friction.
 * 12 additions, 24 multiplications. */
void wrist_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    double s0, c0;
    modeler_sincos(q[0], &s0, &c0);
    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    const double t1 = wrist_geo_g*c0;
    const double t2 = s1*t1;
    const double t3 = t2*beta[16];
    const double t4 = t2*beta[15];
    const double t5 = wrist_geo_g*s0;
    const double t6 = c1*t1;
    const double t7 = beta[15]*(c2*t5 + s2*t6) + beta[16]*(c2*t6 - s2*t5);
    const double t8 = s1*(c2*t3 + s2*t4 - t5*beta[9]) + c1*(t7 + t5*beta[8]);
    tau[0] = -(t5*beta[1] + t1*beta[2] + t8);
    tau[1] = s2*t3 - c2*t4 - (t2*beta[8] + t6*beta[9]);
    tau[2] = -t7;
}

/* Coriolis and centripetal torques.
 * 57 additions, 87 multiplications. */
void wrist_coriolis(const double *q, const double *qd, const double *beta,
                    double *MODELER_RESTRICT tau)
{
    const double k1 = wrist_geo_bl1*2.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);

    const double t1 = s1*qd[0];
    const double t2 = c2*qd[1] + s2*t1;
    const double t3 = c1*qd[0];
    const double t4 = qd[1]*t3;
    const double t5 = qd[2]*t2 - c2*t4;
    const double t6 = c2*t1 - s2*qd[1];
    const double t7 = qd[2]*t6 + s2*t4;
    const double t8 = qd[1]*t1;
    const double t9 = qd[2] + t3;
    const double t10 = t6*beta[12] - t2*beta[13] + t9*beta[14];
    const double t11 = t6*beta[11] + t9*beta[13];
    const double t12 = wrist_geo_bl1*(t1*t1 + qd[1]*qd[1]);
    const double t13 = beta[10]*t5 + beta[11]*t7 + t8*beta[12] + (t2*t10 + t9*t11) + t12*beta[16];
    const double t14 = t6*beta[10] - t2*beta[11] + t9*beta[12];
    const double t15 = beta[11]*t5 + t8*beta[13] + (t6*t10 - t9*t14) - t12*beta[15];
    const double t16 = t9*t9;
    const double t17 = t6*t2;
    const double t18 = (t2*t2 + t16)*beta[15] - beta[16]*(t8 - t17);
    const double t19 = beta[15]*(t8 + t17) + (t6*t6 + t16)*beta[16];
    const double t20 = t1*beta[5] + t3*beta[6] + qd[1]*beta[7];
    const double t21 = t1*beta[4] + qd[1]*beta[6];
    const double t22 = c2*t13 - s2*t15 - wrist_geo_bl1*(s2*t18 + c2*t19);
    const double t23 = k1*t4;
    const double t24 = t1*t3*wrist_geo_bl1;
    const double t25 = beta[12]*t5 + beta[13]*t7 + t8*beta[14] - (t6*t11 + t2*t14);
    const double t26 = beta[15]*(c2*t23 + s2*t24) + beta[16]*(c2*t24 - s2*t23) + t25;
    const double t27 = t1*beta[3] + t3*beta[4] + qd[1]*beta[5];
    const double t28 = s1*(t22 - (t4*beta[3] - t8*beta[4] + (t3*t20 - qd[1]*t21)));
    tau[0] = -(t28 + c1*(t26 - (qd[1]*t27 - t1*t20 + t4*beta[4])));
    const double t29 = s2*t13 + c2*t15 + wrist_geo_bl1*(c2*t18 - s2*t19);
    tau[1] = t4*beta[5] - t8*beta[6] + (t1*t21 - t3*t27) + t29;
    tau[2] = -t26;
}

/* Torques of all effects but rotor inertias: friction, offsets.
 * 0 additions, 0 multiplications. */
void wrist_friction(const double *qd, const double *beta, double *MODELER_RESTRICT tau)
{
    (void)qd;
    (void)beta;
    tau[0] = 0.0;
    tau[1] = 0.0;
    tau[2] = 0.0;
}

/* Base parameters from standard ones: the grouping relations.
 * 12 additions, 3 multiplications. */
void wrist_base_parameters(const double *chi, double *MODELER_RESTRICT beta)
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
void wrist_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
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
    const double t1 = s0*c1;
    T[12] = -t1;
    const double t2 = s0*s1;
    T[13] = t2;
    T[14] = c0;
    const double t3 = c0*c1;
    T[16] = t3;
    const double t4 = c0*s1;
    T[17] = -t4;
    T[18] = s0;
    T[20] = s1;
    T[21] = c1;
    T[23] = wrist_geo_al1;
    T[24] = -(c2*t1 + c0*s2);
    T[25] = s2*t1 - c0*c2;
    T[26] = t2;
    T[27] = wrist_geo_bl1*t2;
    T[28] = c2*t3 - s0*s2;
    T[29] = -(s0*c2 + s2*t3);
    T[30] = -t4;
    T[31] = -wrist_geo_bl1*t4;
    T[32] = s1*c2;
    T[33] = -s1*s2;
    T[34] = c1;
    T[35] = wrist_geo_al1 + wrist_geo_bl1*c1;
}
