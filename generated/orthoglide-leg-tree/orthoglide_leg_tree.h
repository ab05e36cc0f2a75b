/* One leg of the Orthoglide, cut open
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: 1, 2, 3, 4, 5, 7.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_LEG_TREE_H
#define ORTHOGLIDE_LEG_TREE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What orthoglide_leg_tree_signature() of the library that belongs to this header returns. */
#define ORTHOGLIDE_LEG_TREE_SIGNATURE "3decae1a5d54f2a6"
#define ORTHOGLIDE_LEG_TREE_SIGNATURE_1 0x3decae1au
#define ORTHOGLIDE_LEG_TREE_SIGNATURE_2 0x5d54f2a6u

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in orthoglide_leg_tree_generator.h. */
#define ORTHOGLIDE_LEG_TREE_INTERFACE 2
#define ORTHOGLIDE_LEG_TREE_LICENSE "MIT"

#define ORTHOGLIDE_LEG_TREE_JOINTS 6
#define ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS 60
#define ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS 32
#define ORTHOGLIDE_LEG_TREE_NONZEROS 88

/* chi: standard parameters, columns of orthoglide_leg_tree_regressor
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
 *   30  XX4      kg m2
 *   31  XY4      kg m2
 *   32  XZ4      kg m2
 *   33  YY4      kg m2
 *   34  YZ4      kg m2
 *   35  ZZ4      kg m2
 *   36  MX4      kg m
 *   37  MY4      kg m
 *   38  MZ4      kg m
 *   39  M4       kg
 *   40  XX5      kg m2
 *   41  XY5      kg m2
 *   42  XZ5      kg m2
 *   43  YY5      kg m2
 *   44  YZ5      kg m2
 *   45  ZZ5      kg m2
 *   46  MX5      kg m
 *   47  MY5      kg m
 *   48  MZ5      kg m
 *   49  M5       kg
 *   50  XX7      kg m2
 *   51  XY7      kg m2
 *   52  XZ7      kg m2
 *   53  YY7      kg m2
 *   54  YZ7      kg m2
 *   55  ZZ7      kg m2
 *   56  MX7      kg m
 *   57  MY7      kg m
 *   58  MZ7      kg m
 *   59  M7       kg
 */
enum {
    ORTHOGLIDE_LEG_TREE_CHI_XX1, ORTHOGLIDE_LEG_TREE_CHI_XY1, ORTHOGLIDE_LEG_TREE_CHI_XZ1,
    ORTHOGLIDE_LEG_TREE_CHI_YY1, ORTHOGLIDE_LEG_TREE_CHI_YZ1, ORTHOGLIDE_LEG_TREE_CHI_ZZ1,
    ORTHOGLIDE_LEG_TREE_CHI_MX1, ORTHOGLIDE_LEG_TREE_CHI_MY1, ORTHOGLIDE_LEG_TREE_CHI_MZ1,
    ORTHOGLIDE_LEG_TREE_CHI_M1, ORTHOGLIDE_LEG_TREE_CHI_XX2, ORTHOGLIDE_LEG_TREE_CHI_XY2,
    ORTHOGLIDE_LEG_TREE_CHI_XZ2, ORTHOGLIDE_LEG_TREE_CHI_YY2, ORTHOGLIDE_LEG_TREE_CHI_YZ2,
    ORTHOGLIDE_LEG_TREE_CHI_ZZ2, ORTHOGLIDE_LEG_TREE_CHI_MX2, ORTHOGLIDE_LEG_TREE_CHI_MY2,
    ORTHOGLIDE_LEG_TREE_CHI_MZ2, ORTHOGLIDE_LEG_TREE_CHI_M2, ORTHOGLIDE_LEG_TREE_CHI_XX3,
    ORTHOGLIDE_LEG_TREE_CHI_XY3, ORTHOGLIDE_LEG_TREE_CHI_XZ3, ORTHOGLIDE_LEG_TREE_CHI_YY3,
    ORTHOGLIDE_LEG_TREE_CHI_YZ3, ORTHOGLIDE_LEG_TREE_CHI_ZZ3, ORTHOGLIDE_LEG_TREE_CHI_MX3,
    ORTHOGLIDE_LEG_TREE_CHI_MY3, ORTHOGLIDE_LEG_TREE_CHI_MZ3, ORTHOGLIDE_LEG_TREE_CHI_M3,
    ORTHOGLIDE_LEG_TREE_CHI_XX4, ORTHOGLIDE_LEG_TREE_CHI_XY4, ORTHOGLIDE_LEG_TREE_CHI_XZ4,
    ORTHOGLIDE_LEG_TREE_CHI_YY4, ORTHOGLIDE_LEG_TREE_CHI_YZ4, ORTHOGLIDE_LEG_TREE_CHI_ZZ4,
    ORTHOGLIDE_LEG_TREE_CHI_MX4, ORTHOGLIDE_LEG_TREE_CHI_MY4, ORTHOGLIDE_LEG_TREE_CHI_MZ4,
    ORTHOGLIDE_LEG_TREE_CHI_M4, ORTHOGLIDE_LEG_TREE_CHI_XX5, ORTHOGLIDE_LEG_TREE_CHI_XY5,
    ORTHOGLIDE_LEG_TREE_CHI_XZ5, ORTHOGLIDE_LEG_TREE_CHI_YY5, ORTHOGLIDE_LEG_TREE_CHI_YZ5,
    ORTHOGLIDE_LEG_TREE_CHI_ZZ5, ORTHOGLIDE_LEG_TREE_CHI_MX5, ORTHOGLIDE_LEG_TREE_CHI_MY5,
    ORTHOGLIDE_LEG_TREE_CHI_MZ5, ORTHOGLIDE_LEG_TREE_CHI_M5, ORTHOGLIDE_LEG_TREE_CHI_XX7,
    ORTHOGLIDE_LEG_TREE_CHI_XY7, ORTHOGLIDE_LEG_TREE_CHI_XZ7, ORTHOGLIDE_LEG_TREE_CHI_YY7,
    ORTHOGLIDE_LEG_TREE_CHI_YZ7, ORTHOGLIDE_LEG_TREE_CHI_ZZ7, ORTHOGLIDE_LEG_TREE_CHI_MX7,
    ORTHOGLIDE_LEG_TREE_CHI_MY7, ORTHOGLIDE_LEG_TREE_CHI_MZ7, ORTHOGLIDE_LEG_TREE_CHI_M7
};

/* beta: base parameters, columns of orthoglide_leg_tree_base_regressor
 *
 *    0  M1R = M1 + M2 + M3 + M4 + M5 + M7  [kg]
 *    1  ZZ2R = ZZ2 + YY3 + YY4 + D4**2*M4 + D4**2*M5 + YY7  [kg m2]
 *    2  MX2  [kg m]
 *    3  MY2R = MY2 + MZ3 + MZ4 + MZ7  [kg m]
 *    4  XX3R = XX3 - YY3 - D4**2*M4 - D4**2*M5  [kg m2]
 *    5  XY3  [kg m2]
 *    6  XZ3R = XZ3 - D4*MZ4  [kg m2]
 *    7  YZ3  [kg m2]
 *    8  ZZ3R = ZZ3 + D4**2*M4 + D4**2*M5  [kg m2]
 *    9  MX3R = MX3 + D4*M4 + D4*M5  [kg m]
 *   10  MY3  [kg m]
 *   11  XX4R = XX4 - YY4 + YY5  [kg m2]
 *   12  XY4  [kg m2]
 *   13  XZ4  [kg m2]
 *   14  YZ4  [kg m2]
 *   15  ZZ4R = ZZ4 + YY5  [kg m2]
 *   16  MX4  [kg m]
 *   17  MY4R = MY4 - MZ5  [kg m]
 *   18  XX5R = XX5 - YY5  [kg m2]
 *   19  XY5  [kg m2]
 *   20  XZ5  [kg m2]
 *   21  YZ5  [kg m2]
 *   22  ZZ5  [kg m2]
 *   23  MX5  [kg m]
 *   24  MY5  [kg m]
 *   25  XX7R = XX7 - YY7  [kg m2]
 *   26  XY7  [kg m2]
 *   27  XZ7  [kg m2]
 *   28  YZ7  [kg m2]
 *   29  ZZ7  [kg m2]
 *   30  MX7  [kg m]
 *   31  MY7  [kg m]
 */
enum {
    ORTHOGLIDE_LEG_TREE_BETA_M1R, ORTHOGLIDE_LEG_TREE_BETA_ZZ2R, ORTHOGLIDE_LEG_TREE_BETA_MX2,
    ORTHOGLIDE_LEG_TREE_BETA_MY2R, ORTHOGLIDE_LEG_TREE_BETA_XX3R, ORTHOGLIDE_LEG_TREE_BETA_XY3,
    ORTHOGLIDE_LEG_TREE_BETA_XZ3R, ORTHOGLIDE_LEG_TREE_BETA_YZ3, ORTHOGLIDE_LEG_TREE_BETA_ZZ3R,
    ORTHOGLIDE_LEG_TREE_BETA_MX3R, ORTHOGLIDE_LEG_TREE_BETA_MY3, ORTHOGLIDE_LEG_TREE_BETA_XX4R,
    ORTHOGLIDE_LEG_TREE_BETA_XY4, ORTHOGLIDE_LEG_TREE_BETA_XZ4, ORTHOGLIDE_LEG_TREE_BETA_YZ4,
    ORTHOGLIDE_LEG_TREE_BETA_ZZ4R, ORTHOGLIDE_LEG_TREE_BETA_MX4, ORTHOGLIDE_LEG_TREE_BETA_MY4R,
    ORTHOGLIDE_LEG_TREE_BETA_XX5R, ORTHOGLIDE_LEG_TREE_BETA_XY5, ORTHOGLIDE_LEG_TREE_BETA_XZ5,
    ORTHOGLIDE_LEG_TREE_BETA_YZ5, ORTHOGLIDE_LEG_TREE_BETA_ZZ5, ORTHOGLIDE_LEG_TREE_BETA_MX5,
    ORTHOGLIDE_LEG_TREE_BETA_MY5, ORTHOGLIDE_LEG_TREE_BETA_XX7R, ORTHOGLIDE_LEG_TREE_BETA_XY7,
    ORTHOGLIDE_LEG_TREE_BETA_XZ7, ORTHOGLIDE_LEG_TREE_BETA_YZ7, ORTHOGLIDE_LEG_TREE_BETA_ZZ7,
    ORTHOGLIDE_LEG_TREE_BETA_MX7, ORTHOGLIDE_LEG_TREE_BETA_MY7
};

/* Where the values of orthoglide_leg_tree_base_regressor_nonzeros stand: joint and column. */
extern const int orthoglide_leg_tree_nonzero_row[ORTHOGLIDE_LEG_TREE_NONZEROS];
extern const int orthoglide_leg_tree_nonzero_column[ORTHOGLIDE_LEG_TREE_NONZEROS];

/* Tells whether this code belongs to a manifest. */
const char *orthoglide_leg_tree_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      6        joint positions [m or rad]
 * qd     6        joint velocities [m/s or rad/s]
 * qdd    6        joint accelerations [m/s2 or rad/s2]
 * phi    6 x 60   torque per unit of each standard parameter, row-major [SI]
 */
void orthoglide_leg_tree_regressor(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                   const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                   const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                   double phi[6 * 60]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      6        joint positions [m or rad]
 * qd     6        joint velocities [m/s or rad/s]
 * qdd    6        joint accelerations [m/s2 or rad/s2]
 * phi    6 x 32   torque per unit of each base parameter, row-major [SI]
 */
void orthoglide_leg_tree_base_regressor(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        double phi[6 * 32]);

/* The entries of the base regressor that are not always 0.
 *
 * values[k] = phi[nonzero_row[k]][nonzero_column[k]]
 *
 * q      6        joint positions [m or rad]
 * qd     6        joint velocities [m/s or rad/s]
 * qdd    6        joint accelerations [m/s2 or rad/s2]
 * values 88       entries, row after row [SI]
 */
void orthoglide_leg_tree_base_regressor_nonzeros(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                                 double values[88]);

/* Joint torques, by the Newton-Euler recursion.
 *
 * tau = M(q) qdd + c(q, qd) + g(q) + f(qd)
 *
 * q      6        joint positions [m or rad]
 * qd     6        joint velocities [m/s or rad/s]
 * qdd    6        joint accelerations [m/s2 or rad/s2]
 * beta   32       base parameters [SI]
 * tau    6        joint torques or forces [N or N m]
 */
void orthoglide_leg_tree_inverse_dynamics(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double qdd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                          const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                          double tau[ORTHOGLIDE_LEG_TREE_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      6        joint positions [m or rad]
 * beta   32       base parameters [SI]
 * M      6 x 6    inertia matrix, row-major [kg m2, kg m or kg]
 */
void orthoglide_leg_tree_inertia_matrix(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                        const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                        double M[6 * 6]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      6        joint positions [m or rad]
 * beta   32       base parameters [SI]
 * tau    6        joint torques or forces [N or N m]
 */
void orthoglide_leg_tree_gravity(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                 const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                 double tau[ORTHOGLIDE_LEG_TREE_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity and effects
 *
 * q      6        joint positions [m or rad]
 * qd     6        joint velocities [m/s or rad/s]
 * beta   32       base parameters [SI]
 * tau    6        joint torques or forces [N or N m]
 */
void orthoglide_leg_tree_coriolis(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                  double tau[ORTHOGLIDE_LEG_TREE_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(qd)
 *
 * qd     6        joint velocities [m/s or rad/s]
 * beta   32       base parameters [SI]
 * tau    6        joint torques or forces [N or N m]
 */
void orthoglide_leg_tree_friction(const double qd[ORTHOGLIDE_LEG_TREE_JOINTS],
                                  const double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS],
                                  double tau[ORTHOGLIDE_LEG_TREE_JOINTS]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    60       standard parameters [SI]
 * beta   32       base parameters [SI]
 */
void orthoglide_leg_tree_base_parameters(const double chi[ORTHOGLIDE_LEG_TREE_STANDARD_PARAMETERS],
        double beta[ORTHOGLIDE_LEG_TREE_BASE_PARAMETERS]);

/* Poses of the frames of all moving rows of the table, in order.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      6         joint positions [m or rad]
 * T      6 x 3 x 4 poses [R | p] of the links' frames in frame 0, row-major [1 | m]
 */
void orthoglide_leg_tree_forward_kinematics(const double q[ORTHOGLIDE_LEG_TREE_JOINTS],
                                            double T[6 * 3 * 4]);

#ifdef __cplusplus
}
#endif

#endif
