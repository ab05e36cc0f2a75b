/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: 1, 2, 3.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef WRIST_H
#define WRIST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What wrist_signature() of the library that belongs to this header returns. */
#define WRIST_SIGNATURE "04a9ce4bbacd538f"
#define WRIST_SIGNATURE_1 0x04a9ce4bu
#define WRIST_SIGNATURE_2 0xbacd538fu

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in wrist_generator.h. */
#define WRIST_INTERFACE 2
#define WRIST_LICENSE "MIT"

#define WRIST_JOINTS 3
#define WRIST_STANDARD_PARAMETERS 30
#define WRIST_BASE_PARAMETERS 17
#define WRIST_NONZEROS 37

/* chi: standard parameters, columns of wrist_regressor
 *
 *    0  XX1      kg m2
 *    1  XY1      kg m2
 *    2  XZ1      kg m2
 *    3  YY1      kg m2
 *    4  YZ1      kg m2
 *    5  ZZ1      kg m2
 *    6  MX1      kg m
 *    7  MY1      kg m
 *    8  MZ1      kg m
 *    9  M1       kg
 *   10  XX2      kg m2
 *   11  XY2      kg m2
 *   12  XZ2      kg m2
 *   13  YY2      kg m2
 *   14  YZ2      kg m2
 *   15  ZZ2      kg m2
 *   16  MX2      kg m
 *   17  MY2      kg m
 *   18  MZ2      kg m
 *   19  M2       kg
 *   20  XX3      kg m2
 *   21  XY3      kg m2
 *   22  XZ3      kg m2
 *   23  YY3      kg m2
 *   24  YZ3      kg m2
 *   25  ZZ3      kg m2
 *   26  MX3      kg m
 *   27  MY3      kg m
 *   28  MZ3      kg m
 *   29  M3       kg
 */
enum {
    WRIST_CHI_XX1, WRIST_CHI_XY1, WRIST_CHI_XZ1, WRIST_CHI_YY1, WRIST_CHI_YZ1, WRIST_CHI_ZZ1,
    WRIST_CHI_MX1, WRIST_CHI_MY1, WRIST_CHI_MZ1, WRIST_CHI_M1, WRIST_CHI_XX2, WRIST_CHI_XY2,
    WRIST_CHI_XZ2, WRIST_CHI_YY2, WRIST_CHI_YZ2, WRIST_CHI_ZZ2, WRIST_CHI_MX2, WRIST_CHI_MY2,
    WRIST_CHI_MZ2, WRIST_CHI_M2, WRIST_CHI_XX3, WRIST_CHI_XY3, WRIST_CHI_XZ3, WRIST_CHI_YY3,
    WRIST_CHI_YZ3, WRIST_CHI_ZZ3, WRIST_CHI_MX3, WRIST_CHI_MY3, WRIST_CHI_MZ3, WRIST_CHI_M3
};

/* beta: base parameters, columns of wrist_base_regressor
 *
 *    0  ZZ1R = ZZ1 + YY2  [kg m2]
 *    1  MX1  [kg m]
 *    2  MY1R = MY1 - MZ2  [kg m]
 *    3  XX2R = XX2 - YY2 + YY3 + 2*bl1*MZ3 + bl1**2*M3  [kg m2]
 *    4  XY2  [kg m2]
 *    5  XZ2  [kg m2]
 *    6  YZ2  [kg m2]
 *    7  ZZ2R = ZZ2 + YY3 + 2*bl1*MZ3 + bl1**2*M3  [kg m2]
 *    8  MX2  [kg m]
 *    9  MY2R = MY2 + MZ3 + bl1*M3  [kg m]
 *   10  XX3R = XX3 - YY3  [kg m2]
 *   11  XY3  [kg m2]
 *   12  XZ3  [kg m2]
 *   13  YZ3  [kg m2]
 *   14  ZZ3  [kg m2]
 *   15  MX3  [kg m]
 *   16  MY3  [kg m]
 */
enum {
    WRIST_BETA_ZZ1R, WRIST_BETA_MX1, WRIST_BETA_MY1R, WRIST_BETA_XX2R, WRIST_BETA_XY2,
    WRIST_BETA_XZ2, WRIST_BETA_YZ2, WRIST_BETA_ZZ2R, WRIST_BETA_MX2, WRIST_BETA_MY2R,
    WRIST_BETA_XX3R, WRIST_BETA_XY3, WRIST_BETA_XZ3, WRIST_BETA_YZ3, WRIST_BETA_ZZ3, WRIST_BETA_MX3,
    WRIST_BETA_MY3
};

/* Where the values of wrist_base_regressor_nonzeros stand: joint and column. */
extern const int wrist_nonzero_row[WRIST_NONZEROS];
extern const int wrist_nonzero_column[WRIST_NONZEROS];

/* Tells whether this code belongs to a manifest. */
const char *wrist_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      3        joint positions [rad]
 * qd     3        joint velocities [rad/s]
 * qdd    3        joint accelerations [rad/s2]
 * phi    3 x 30   torque per unit of each standard parameter, row-major [SI]
 */
void wrist_regressor(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                     const double qdd[WRIST_JOINTS], double phi[3 * 30]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      3        joint positions [rad]
 * qd     3        joint velocities [rad/s]
 * qdd    3        joint accelerations [rad/s2]
 * phi    3 x 17   torque per unit of each base parameter, row-major [SI]
 */
void wrist_base_regressor(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                          const double qdd[WRIST_JOINTS], double phi[3 * 17]);

/* The entries of the base regressor that are not always 0.
 *
 * values[k] = phi[nonzero_row[k]][nonzero_column[k]]
 *
 * q      3        joint positions [rad]
 * qd     3        joint velocities [rad/s]
 * qdd    3        joint accelerations [rad/s2]
 * values 37       entries, row after row [SI]
 */
void wrist_base_regressor_nonzeros(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                                   const double qdd[WRIST_JOINTS], double values[37]);

/* Joint torques, by the Newton-Euler recursion.
 *
 * tau = M(q) qdd + c(q, qd) + g(q) + f(qd)
 *
 * q      3        joint positions [rad]
 * qd     3        joint velocities [rad/s]
 * qdd    3        joint accelerations [rad/s2]
 * beta   17       base parameters [SI]
 * tau    3        joint torques or forces [N m]
 */
void wrist_inverse_dynamics(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                            const double qdd[WRIST_JOINTS],
                            const double beta[WRIST_BASE_PARAMETERS], double tau[WRIST_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      3        joint positions [rad]
 * beta   17       base parameters [SI]
 * M      3 x 3    inertia matrix, row-major [kg m2, kg m or kg]
 */
void wrist_inertia_matrix(const double q[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                          double M[3 * 3]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      3        joint positions [rad]
 * beta   17       base parameters [SI]
 * tau    3        joint torques or forces [N m]
 */
void wrist_gravity(const double q[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                   double tau[WRIST_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity and effects
 *
 * q      3        joint positions [rad]
 * qd     3        joint velocities [rad/s]
 * beta   17       base parameters [SI]
 * tau    3        joint torques or forces [N m]
 */
void wrist_coriolis(const double q[WRIST_JOINTS], const double qd[WRIST_JOINTS],
                    const double beta[WRIST_BASE_PARAMETERS], double tau[WRIST_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(qd)
 *
 * qd     3        joint velocities [rad/s]
 * beta   17       base parameters [SI]
 * tau    3        joint torques or forces [N m]
 */
void wrist_friction(const double qd[WRIST_JOINTS], const double beta[WRIST_BASE_PARAMETERS],
                    double tau[WRIST_JOINTS]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    30       standard parameters [SI]
 * beta   17       base parameters [SI]
 */
void wrist_base_parameters(const double chi[WRIST_STANDARD_PARAMETERS],
                           double beta[WRIST_BASE_PARAMETERS]);

/* Poses of the frames of all moving rows of the table, in order.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      3         joint positions [rad]
 * T      3 x 3 x 4 poses [R | p] of the links' frames in frame 0, row-major [1 | m]
 */
void wrist_forward_kinematics(const double q[WRIST_JOINTS], double T[3 * 3 * 4]);

#ifdef __cplusplus
}
#endif

#endif
