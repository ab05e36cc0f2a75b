/* Planar five-bar, two actuated joints at the base
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: 11, 12.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef FIVE_BAR_H
#define FIVE_BAR_H

#include <stddef.h>

#include "modeler_kept.h"
#include "modeler_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What five_bar_signature() of the library that belongs to this header returns. */
#define FIVE_BAR_SIGNATURE "d1c82fb9d880dc4b"
#define FIVE_BAR_SIGNATURE_1 0xd1c82fb9u
#define FIVE_BAR_SIGNATURE_2 0xd880dc4bu

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in five_bar_generator.h. */
#define FIVE_BAR_INTERFACE 2
#define FIVE_BAR_LICENSE "MIT"

#define FIVE_BAR_JOINTS 2
#define FIVE_BAR_STANDARD_PARAMETERS 40
#define FIVE_BAR_BASE_PARAMETERS 11
#define FIVE_BAR_FREE_VARIABLES 4
#ifndef FIVE_BAR_MAX_CLOSURE_EVALUATIONS
#define FIVE_BAR_MAX_CLOSURE_EVALUATIONS 5000 /* in one call; -D sets another, in all files alike */
#endif

/* chi: standard parameters, columns of five_bar_regressor
 *
 *    0  XX11     kg m2
 *    1  XY11     kg m2
 *    2  XZ11     kg m2
 *    3  YY11     kg m2
 *    4  YZ11     kg m2
 *    5  ZZ11     kg m2
 *    6  MX11     kg m
 *    7  MY11     kg m
 *    8  MZ11     kg m
 *    9  M11      kg
 *   10  XX21     kg m2
 *   11  XY21     kg m2
 *   12  XZ21     kg m2
 *   13  YY21     kg m2
 *   14  YZ21     kg m2
 *   15  ZZ21     kg m2
 *   16  MX21     kg m
 *   17  MY21     kg m
 *   18  MZ21     kg m
 *   19  M21      kg
 *   20  XX12     kg m2
 *   21  XY12     kg m2
 *   22  XZ12     kg m2
 *   23  YY12     kg m2
 *   24  YZ12     kg m2
 *   25  ZZ12     kg m2
 *   26  MX12     kg m
 *   27  MY12     kg m
 *   28  MZ12     kg m
 *   29  M12      kg
 *   30  XX22     kg m2
 *   31  XY22     kg m2
 *   32  XZ22     kg m2
 *   33  YY22     kg m2
 *   34  YZ22     kg m2
 *   35  ZZ22     kg m2
 *   36  MX22     kg m
 *   37  MY22     kg m
 *   38  MZ22     kg m
 *   39  M22      kg
 */
enum {
    FIVE_BAR_CHI_XX11, FIVE_BAR_CHI_XY11, FIVE_BAR_CHI_XZ11, FIVE_BAR_CHI_YY11, FIVE_BAR_CHI_YZ11,
    FIVE_BAR_CHI_ZZ11, FIVE_BAR_CHI_MX11, FIVE_BAR_CHI_MY11, FIVE_BAR_CHI_MZ11, FIVE_BAR_CHI_M11,
    FIVE_BAR_CHI_XX21, FIVE_BAR_CHI_XY21, FIVE_BAR_CHI_XZ21, FIVE_BAR_CHI_YY21, FIVE_BAR_CHI_YZ21,
    FIVE_BAR_CHI_ZZ21, FIVE_BAR_CHI_MX21, FIVE_BAR_CHI_MY21, FIVE_BAR_CHI_MZ21, FIVE_BAR_CHI_M21,
    FIVE_BAR_CHI_XX12, FIVE_BAR_CHI_XY12, FIVE_BAR_CHI_XZ12, FIVE_BAR_CHI_YY12, FIVE_BAR_CHI_YZ12,
    FIVE_BAR_CHI_ZZ12, FIVE_BAR_CHI_MX12, FIVE_BAR_CHI_MY12, FIVE_BAR_CHI_MZ12, FIVE_BAR_CHI_M12,
    FIVE_BAR_CHI_XX22, FIVE_BAR_CHI_XY22, FIVE_BAR_CHI_XZ22, FIVE_BAR_CHI_YY22, FIVE_BAR_CHI_YZ22,
    FIVE_BAR_CHI_ZZ22, FIVE_BAR_CHI_MX22, FIVE_BAR_CHI_MY22, FIVE_BAR_CHI_MZ22, FIVE_BAR_CHI_M22
};

/* beta: base parameters, columns of five_bar_base_regressor
 *
 *    0  ZZ11R = ZZ11 + L1**2*M21 + L1**2*MX22/L4  [kg m2]
 *    1  MX11R = MX11 + L1*M21 + L1*MX22/L4  [kg m]
 *    2  MY11  [kg m]
 *    3  ZZ21R = ZZ21 + L2**2*MX22/L4  [kg m2]
 *    4  MX21R = MX21 + L2*MX22/L4  [kg m]
 *    5  MY21  [kg m]
 *    6  ZZ12R = ZZ12 - L3**2*MX22/L4 + L3**2*M22  [kg m2]
 *    7  MX12R = MX12 - L3*MX22/L4 + L3*M22  [kg m]
 *    8  MY12  [kg m]
 *    9  ZZ22R = ZZ22 - L4*MX22  [kg m2]
 *   10  MY22  [kg m]
 */
enum {
    FIVE_BAR_BETA_ZZ11R, FIVE_BAR_BETA_MX11R, FIVE_BAR_BETA_MY11, FIVE_BAR_BETA_ZZ21R,
    FIVE_BAR_BETA_MX21R, FIVE_BAR_BETA_MY21, FIVE_BAR_BETA_ZZ12R, FIVE_BAR_BETA_MX12R,
    FIVE_BAR_BETA_MY12, FIVE_BAR_BETA_ZZ22R, FIVE_BAR_BETA_MY22
};

/* u: free variables of the opened tree: 11, 21, 12, 22
 *
 * Functions that close the loops return a status: 0 done; 1 the loops cannot be closed on the
 * straight way from the home posture to these values; 2 singular posture; 3 an input is not finite,
 * or an output would not be; 4 these values are so far that FIVE_BAR_MAX_CLOSURE_EVALUATIONS
 * evaluations of the closure equations do not do: no call makes more. Outputs are NaN unless it is 0. The assembly
 * mode is that of the home posture.
 */

/* Tells whether this code belongs to a manifest. */
const char *five_bar_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      2        joint positions [rad]
 * qd     2        joint velocities [rad/s]
 * qdd    2        joint accelerations [rad/s2]
 * phi    2 x 40   torque per unit of each standard parameter, row-major [SI]
 */
int five_bar_regressor(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                       const double qdd[FIVE_BAR_JOINTS], double phi[2 * 40]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      2        joint positions [rad]
 * qd     2        joint velocities [rad/s]
 * qdd    2        joint accelerations [rad/s2]
 * phi    2 x 11   torque per unit of each base parameter, row-major [SI]
 */
int five_bar_base_regressor(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                            const double qdd[FIVE_BAR_JOINTS], double phi[2 * 11]);

/* Torques that move the closed robot so.
 *
 * tau = M qdd + c + g + f
 *
 * q      2        joint positions [rad]
 * qd     2        joint velocities [rad/s]
 * qdd    2        joint accelerations [rad/s2]
 * beta   11       base parameters [SI]
 * tau    2        joint torques or forces [N m]
 */
int five_bar_inverse_dynamics(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                              const double qdd[FIVE_BAR_JOINTS],
                              const double beta[FIVE_BAR_BASE_PARAMETERS],
                              double tau[FIVE_BAR_JOINTS]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      2        joint positions [rad]
 * beta   11       base parameters [SI]
 * tau    2        joint torques or forces [N m]
 */
int five_bar_gravity(const double q[FIVE_BAR_JOINTS], const double beta[FIVE_BAR_BASE_PARAMETERS],
                     double tau[FIVE_BAR_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets
 *
 * q      2        joint positions [rad]
 * qd     2        joint velocities [rad/s]
 * beta   11       base parameters [SI]
 * tau    2        joint torques or forces [N m]
 */
int five_bar_coriolis(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                      const double beta[FIVE_BAR_BASE_PARAMETERS], double tau[FIVE_BAR_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(q, qd)
 *
 * q      2        joint positions [rad]
 * qd     2        joint velocities [rad/s]
 * beta   11       base parameters [SI]
 * tau    2        joint torques or forces [N m]
 */
int five_bar_friction(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                      const double beta[FIVE_BAR_BASE_PARAMETERS], double tau[FIVE_BAR_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      2        joint positions [rad]
 * beta   11       base parameters [SI]
 * M      2 x 2    inertia matrix, row-major [kg m2, kg m or kg]
 */
int five_bar_inertia_matrix(const double q[FIVE_BAR_JOINTS],
                            const double beta[FIVE_BAR_BASE_PARAMETERS], double M[2 * 2]);

/* Pose of the frame of every moving row of the table.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      2         joint positions [rad]
 * T      4 x 3 x 4 poses [R | p] of rows 11, 21, 12, 22 in frame 0, row-major [1 | m]
 */
int five_bar_forward_kinematics(const double q[FIVE_BAR_JOINTS], double T[4 * 3 * 4]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * q      2        joint positions [rad]
 * u      4        free variables of the opened tree [rad or m]
 */
int five_bar_close(const double q[FIVE_BAR_JOINTS], double u[4]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * q      2        joint positions [rad]
 * start  4        a closed posture to start from [rad or m]
 * u      4        free variables of the opened tree [rad or m]
 */
int five_bar_close_from(const double q[FIVE_BAR_JOINTS], const double start[4], double u[4]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G qd
 *
 * q      2        joint positions [rad]
 * G      4 x 2    d u / d q, row-major [SI]
 */
int five_bar_coupling(const double q[FIVE_BAR_JOINTS], double G[4 * 2]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    40       standard parameters [SI]
 * beta   11       base parameters [SI]
 */
void five_bar_base_parameters(const double chi[FIVE_BAR_STANDARD_PARAMETERS],
                              double beta[FIVE_BAR_BASE_PARAMETERS]);

/* A closed posture and what solved it, and a controller's state: members are the library's. */
struct five_bar_posture {
    double u[4];      /* free variables */
    double ud[4];     /* their speeds */
    double gamma[4];  /* their accelerations at qdd = 0 */
    double G[8];
    double qd[2];
    modeler_kept kept;
    int places[8];
    double numbers[92];
};

struct five_bar_state {
    struct five_bar_posture at;
    int closed; /* by the last call of five_bar_state; memory of zeros is no state yet */
    int status;
    int rated; /* `rate` holds dG/dt */
    double rate[8];
    double rows[44];
};

/* The state at q, qd: closes the loops once for all functions that end in _at.
 *
 * They are those of the same name without q and qd, and give the same numbers. The loops are closed
 * from the closed posture `previous`; NULL: from home, as at the start. In a control loop give the
 * state's own last one, state.at.u (from home, if there is none yet): at 1 kHz that takes two or three evaluations of the closure
 * equations. Returns a status. Unless it is 0, the functions return it too, with outputs NaN, and
 * the posture is the last closed one, from where the next call may go on. Before the first status 0
 * there is none: give NULL, and call no function that ends in _at.
 */
#if defined(__cplusplus) && defined(__GNUC__) /* a structure and a function of one name */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#endif
int five_bar_state(const double *q, const double *qd, const double *previous,
    struct five_bar_state *state);

/* The same with at most `evaluations` of the closure equations, and never more than
 * FIVE_BAR_MAX_CLOSURE_EVALUATIONS: status 4 if these do not do. */
int five_bar_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct five_bar_state *state);
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
int five_bar_base_regressor_at(struct five_bar_state *state, const double qdd[FIVE_BAR_JOINTS],
                               double phi[2 * 11]);
int five_bar_inverse_dynamics_at(struct five_bar_state *state, const double qdd[FIVE_BAR_JOINTS],
                                 const double beta[FIVE_BAR_BASE_PARAMETERS],
                                 double tau[FIVE_BAR_JOINTS]);
int five_bar_gravity_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                        double tau[FIVE_BAR_JOINTS]);
int five_bar_coriolis_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                         double tau[FIVE_BAR_JOINTS]);
int five_bar_friction_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                         double tau[FIVE_BAR_JOINTS]);
int five_bar_inertia_matrix_at(struct five_bar_state *state,
                               const double beta[FIVE_BAR_BASE_PARAMETERS], double M[2 * 2]);
int five_bar_forward_kinematics_at(struct five_bar_state *state, double T[4 * 3 * 4]);
int five_bar_coupling_at(struct five_bar_state *state, double G[4 * 2]);

/* dG/dt, as G: udd = G qdd + dG/dt qd. `rate` may be NULL: it is kept in the state. */
int five_bar_coupling_rate_at(struct five_bar_state *state, double *rate);

#ifdef __cplusplus
}
#endif

#endif
