/* SR400, 6R arm with a parallelogram, cut open
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: 1, 2, 3, 4, 5, 6, 7, 8.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef SR400_TREE_H
#define SR400_TREE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What sr400_tree_signature() of the library that belongs to this header returns. */
#define SR400_TREE_SIGNATURE "1fb9681687ac8601"
#define SR400_TREE_SIGNATURE_1 0x1fb96816u
#define SR400_TREE_SIGNATURE_2 0x87ac8601u

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in sr400_tree_generator.h. */
#define SR400_TREE_INTERFACE 2
#define SR400_TREE_LICENSE "MIT"

#define SR400_TREE_JOINTS 8
#define SR400_TREE_STANDARD_PARAMETERS 80
#define SR400_TREE_BASE_PARAMETERS 50
#define SR400_TREE_NONZEROS 172

/* chi: standard parameters, columns of sr400_tree_regressor
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
 *   50  XX6      kg m2
 *   51  XY6      kg m2
 *   52  XZ6      kg m2
 *   53  YY6      kg m2
 *   54  YZ6      kg m2
 *   55  ZZ6      kg m2
 *   56  MX6      kg m
 *   57  MY6      kg m
 *   58  MZ6      kg m
 *   59  M6       kg
 *   60  XX7      kg m2
 *   61  XY7      kg m2
 *   62  XZ7      kg m2
 *   63  YY7      kg m2
 *   64  YZ7      kg m2
 *   65  ZZ7      kg m2
 *   66  MX7      kg m
 *   67  MY7      kg m
 *   68  MZ7      kg m
 *   69  M7       kg
 *   70  XX8      kg m2
 *   71  XY8      kg m2
 *   72  XZ8      kg m2
 *   73  YY8      kg m2
 *   74  YZ8      kg m2
 *   75  ZZ8      kg m2
 *   76  MX8      kg m
 *   77  MY8      kg m
 *   78  MZ8      kg m
 *   79  M8       kg
 */
enum {
    SR400_TREE_CHI_XX1, SR400_TREE_CHI_XY1, SR400_TREE_CHI_XZ1, SR400_TREE_CHI_YY1,
    SR400_TREE_CHI_YZ1, SR400_TREE_CHI_ZZ1, SR400_TREE_CHI_MX1, SR400_TREE_CHI_MY1,
    SR400_TREE_CHI_MZ1, SR400_TREE_CHI_M1, SR400_TREE_CHI_XX2, SR400_TREE_CHI_XY2,
    SR400_TREE_CHI_XZ2, SR400_TREE_CHI_YY2, SR400_TREE_CHI_YZ2, SR400_TREE_CHI_ZZ2,
    SR400_TREE_CHI_MX2, SR400_TREE_CHI_MY2, SR400_TREE_CHI_MZ2, SR400_TREE_CHI_M2,
    SR400_TREE_CHI_XX3, SR400_TREE_CHI_XY3, SR400_TREE_CHI_XZ3, SR400_TREE_CHI_YY3,
    SR400_TREE_CHI_YZ3, SR400_TREE_CHI_ZZ3, SR400_TREE_CHI_MX3, SR400_TREE_CHI_MY3,
    SR400_TREE_CHI_MZ3, SR400_TREE_CHI_M3, SR400_TREE_CHI_XX4, SR400_TREE_CHI_XY4,
    SR400_TREE_CHI_XZ4, SR400_TREE_CHI_YY4, SR400_TREE_CHI_YZ4, SR400_TREE_CHI_ZZ4,
    SR400_TREE_CHI_MX4, SR400_TREE_CHI_MY4, SR400_TREE_CHI_MZ4, SR400_TREE_CHI_M4,
    SR400_TREE_CHI_XX5, SR400_TREE_CHI_XY5, SR400_TREE_CHI_XZ5, SR400_TREE_CHI_YY5,
    SR400_TREE_CHI_YZ5, SR400_TREE_CHI_ZZ5, SR400_TREE_CHI_MX5, SR400_TREE_CHI_MY5,
    SR400_TREE_CHI_MZ5, SR400_TREE_CHI_M5, SR400_TREE_CHI_XX6, SR400_TREE_CHI_XY6,
    SR400_TREE_CHI_XZ6, SR400_TREE_CHI_YY6, SR400_TREE_CHI_YZ6, SR400_TREE_CHI_ZZ6,
    SR400_TREE_CHI_MX6, SR400_TREE_CHI_MY6, SR400_TREE_CHI_MZ6, SR400_TREE_CHI_M6,
    SR400_TREE_CHI_XX7, SR400_TREE_CHI_XY7, SR400_TREE_CHI_XZ7, SR400_TREE_CHI_YY7,
    SR400_TREE_CHI_YZ7, SR400_TREE_CHI_ZZ7, SR400_TREE_CHI_MX7, SR400_TREE_CHI_MY7,
    SR400_TREE_CHI_MZ7, SR400_TREE_CHI_M7, SR400_TREE_CHI_XX8, SR400_TREE_CHI_XY8,
    SR400_TREE_CHI_XZ8, SR400_TREE_CHI_YY8, SR400_TREE_CHI_YZ8, SR400_TREE_CHI_ZZ8,
    SR400_TREE_CHI_MX8, SR400_TREE_CHI_MY8, SR400_TREE_CHI_MZ8, SR400_TREE_CHI_M8
};

/* beta: base parameters, columns of sr400_tree_base_regressor
 *
 *    0  ZZ1R = ZZ1 + YY2 + D2**2*M2 + YY3 + (D2**2 + D3**2)*M3 + (D2**2 + D3**2 + D4**2)*M4 +
 *         (D2**2 + D3**2 + D4**2)*M5 + (D2**2 + D3**2 + D4**2)*M6 + YY7 + D2**2*M7 + YY8 + (D2**2
 *         + D8**2)*M8  [kg m2]
 *    1  XX2R = XX2 - YY2 - D3**2*M3 - D3**2*M4 - D3**2*M5 - D3**2*M6  [kg m2]
 *    2  XY2  [kg m2]
 *    3  XZ2R = XZ2 - D3*MZ3  [kg m2]
 *    4  YZ2  [kg m2]
 *    5  ZZ2R = ZZ2 + D3**2*M3 + D3**2*M4 + D3**2*M5 + D3**2*M6  [kg m2]
 *    6  MX2R = MX2 + D3*M3 + D3*M4 + D3*M5 + D3*M6  [kg m]
 *    7  MY2  [kg m]
 *    8  XX3R = XX3 - YY3 + YY4 + 2*RL4*MZ4 + (-D4**2 + RL4**2)*M4 + (-D4**2 + RL4**2)*M5 + (-D4**2
 *         + RL4**2)*M6  [kg m2]
 *    9  XY3R = XY3 - D4*MZ4 - D4*RL4*M4 - D4*RL4*M5 - D4*RL4*M6  [kg m2]
 *   10  XZ3  [kg m2]
 *   11  YZ3  [kg m2]
 *   12  ZZ3R = ZZ3 + YY4 + 2*RL4*MZ4 + (D4**2 + RL4**2)*M4 + (D4**2 + RL4**2)*M5 + (D4**2 +
 *         RL4**2)*M6  [kg m2]
 *   13  MX3R = MX3 + D4*M4 + D4*M5 + D4*M6  [kg m]
 *   14  MY3R = MY3 + MZ4 + RL4*M4 + RL4*M5 + RL4*M6  [kg m]
 *   15  XX4R = XX4 - YY4 + YY5  [kg m2]
 *   16  XY4  [kg m2]
 *   17  XZ4  [kg m2]
 *   18  YZ4  [kg m2]
 *   19  ZZ4R = ZZ4 + YY5  [kg m2]
 *   20  MX4  [kg m]
 *   21  MY4R = MY4 - MZ5  [kg m]
 *   22  XX5R = XX5 - YY5 + YY6  [kg m2]
 *   23  XY5  [kg m2]
 *   24  XZ5  [kg m2]
 *   25  YZ5  [kg m2]
 *   26  ZZ5R = ZZ5 + YY6  [kg m2]
 *   27  MX5  [kg m]
 *   28  MY5R = MY5 + MZ6  [kg m]
 *   29  XX6R = XX6 - YY6  [kg m2]
 *   30  XY6  [kg m2]
 *   31  XZ6  [kg m2]
 *   32  YZ6  [kg m2]
 *   33  ZZ6  [kg m2]
 *   34  MX6  [kg m]
 *   35  MY6  [kg m]
 *   36  XX7R = XX7 - YY7 - D8**2*M8  [kg m2]
 *   37  XY7  [kg m2]
 *   38  XZ7R = XZ7 - D8*MZ8  [kg m2]
 *   39  YZ7  [kg m2]
 *   40  ZZ7R = ZZ7 + D8**2*M8  [kg m2]
 *   41  MX7R = MX7 + D8*M8  [kg m]
 *   42  MY7  [kg m]
 *   43  XX8R = XX8 - YY8  [kg m2]
 *   44  XY8  [kg m2]
 *   45  XZ8  [kg m2]
 *   46  YZ8  [kg m2]
 *   47  ZZ8  [kg m2]
 *   48  MX8  [kg m]
 *   49  MY8  [kg m]
 */
enum {
    SR400_TREE_BETA_ZZ1R, SR400_TREE_BETA_XX2R, SR400_TREE_BETA_XY2, SR400_TREE_BETA_XZ2R,
    SR400_TREE_BETA_YZ2, SR400_TREE_BETA_ZZ2R, SR400_TREE_BETA_MX2R, SR400_TREE_BETA_MY2,
    SR400_TREE_BETA_XX3R, SR400_TREE_BETA_XY3R, SR400_TREE_BETA_XZ3, SR400_TREE_BETA_YZ3,
    SR400_TREE_BETA_ZZ3R, SR400_TREE_BETA_MX3R, SR400_TREE_BETA_MY3R, SR400_TREE_BETA_XX4R,
    SR400_TREE_BETA_XY4, SR400_TREE_BETA_XZ4, SR400_TREE_BETA_YZ4, SR400_TREE_BETA_ZZ4R,
    SR400_TREE_BETA_MX4, SR400_TREE_BETA_MY4R, SR400_TREE_BETA_XX5R, SR400_TREE_BETA_XY5,
    SR400_TREE_BETA_XZ5, SR400_TREE_BETA_YZ5, SR400_TREE_BETA_ZZ5R, SR400_TREE_BETA_MX5,
    SR400_TREE_BETA_MY5R, SR400_TREE_BETA_XX6R, SR400_TREE_BETA_XY6, SR400_TREE_BETA_XZ6,
    SR400_TREE_BETA_YZ6, SR400_TREE_BETA_ZZ6, SR400_TREE_BETA_MX6, SR400_TREE_BETA_MY6,
    SR400_TREE_BETA_XX7R, SR400_TREE_BETA_XY7, SR400_TREE_BETA_XZ7R, SR400_TREE_BETA_YZ7,
    SR400_TREE_BETA_ZZ7R, SR400_TREE_BETA_MX7R, SR400_TREE_BETA_MY7, SR400_TREE_BETA_XX8R,
    SR400_TREE_BETA_XY8, SR400_TREE_BETA_XZ8, SR400_TREE_BETA_YZ8, SR400_TREE_BETA_ZZ8,
    SR400_TREE_BETA_MX8, SR400_TREE_BETA_MY8
};

/* Where the values of sr400_tree_base_regressor_nonzeros stand: joint and column. */
extern const int sr400_tree_nonzero_row[SR400_TREE_NONZEROS];
extern const int sr400_tree_nonzero_column[SR400_TREE_NONZEROS];

/* Tells whether this code belongs to a manifest. */
const char *sr400_tree_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      8        joint positions [rad]
 * qd     8        joint velocities [rad/s]
 * qdd    8        joint accelerations [rad/s2]
 * phi    8 x 80   torque per unit of each standard parameter, row-major [SI]
 */
void sr400_tree_regressor(const double q[SR400_TREE_JOINTS], const double qd[SR400_TREE_JOINTS],
                          const double qdd[SR400_TREE_JOINTS], double phi[8 * 80]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      8        joint positions [rad]
 * qd     8        joint velocities [rad/s]
 * qdd    8        joint accelerations [rad/s2]
 * phi    8 x 50   torque per unit of each base parameter, row-major [SI]
 */
void sr400_tree_base_regressor(const double q[SR400_TREE_JOINTS],
                               const double qd[SR400_TREE_JOINTS],
                               const double qdd[SR400_TREE_JOINTS], double phi[8 * 50]);

/* The entries of the base regressor that are not always 0.
 *
 * values[k] = phi[nonzero_row[k]][nonzero_column[k]]
 *
 * q      8        joint positions [rad]
 * qd     8        joint velocities [rad/s]
 * qdd    8        joint accelerations [rad/s2]
 * values 172      entries, row after row [SI]
 */
void sr400_tree_base_regressor_nonzeros(const double q[SR400_TREE_JOINTS],
                                        const double qd[SR400_TREE_JOINTS],
                                        const double qdd[SR400_TREE_JOINTS], double values[172]);

/* Joint torques, by the Newton-Euler recursion.
 *
 * tau = M(q) qdd + c(q, qd) + g(q) + f(qd)
 *
 * q      8        joint positions [rad]
 * qd     8        joint velocities [rad/s]
 * qdd    8        joint accelerations [rad/s2]
 * beta   50       base parameters [SI]
 * tau    8        joint torques or forces [N m]
 */
void sr400_tree_inverse_dynamics(const double q[SR400_TREE_JOINTS],
                                 const double qd[SR400_TREE_JOINTS],
                                 const double qdd[SR400_TREE_JOINTS],
                                 const double beta[SR400_TREE_BASE_PARAMETERS],
                                 double tau[SR400_TREE_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      8        joint positions [rad]
 * beta   50       base parameters [SI]
 * M      8 x 8    inertia matrix, row-major [kg m2, kg m or kg]
 */
void sr400_tree_inertia_matrix(const double q[SR400_TREE_JOINTS],
                               const double beta[SR400_TREE_BASE_PARAMETERS], double M[8 * 8]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      8        joint positions [rad]
 * beta   50       base parameters [SI]
 * tau    8        joint torques or forces [N m]
 */
void sr400_tree_gravity(const double q[SR400_TREE_JOINTS],
                        const double beta[SR400_TREE_BASE_PARAMETERS],
                        double tau[SR400_TREE_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity and effects
 *
 * q      8        joint positions [rad]
 * qd     8        joint velocities [rad/s]
 * beta   50       base parameters [SI]
 * tau    8        joint torques or forces [N m]
 */
void sr400_tree_coriolis(const double q[SR400_TREE_JOINTS], const double qd[SR400_TREE_JOINTS],
                         const double beta[SR400_TREE_BASE_PARAMETERS],
                         double tau[SR400_TREE_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(qd)
 *
 * qd     8        joint velocities [rad/s]
 * beta   50       base parameters [SI]
 * tau    8        joint torques or forces [N m]
 */
void sr400_tree_friction(const double qd[SR400_TREE_JOINTS],
                         const double beta[SR400_TREE_BASE_PARAMETERS],
                         double tau[SR400_TREE_JOINTS]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    80       standard parameters [SI]
 * beta   50       base parameters [SI]
 */
void sr400_tree_base_parameters(const double chi[SR400_TREE_STANDARD_PARAMETERS],
                                double beta[SR400_TREE_BASE_PARAMETERS]);

/* Poses of the frames of all moving rows of the table, in order.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      8         joint positions [rad]
 * T      8 x 3 x 4 poses [R | p] of the links' frames in frame 0, row-major [1 | m]
 */
void sr400_tree_forward_kinematics(const double q[SR400_TREE_JOINTS], double T[8 * 3 * 4]);

#ifdef __cplusplus
}
#endif

#endif
