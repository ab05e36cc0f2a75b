/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of the opened tree, for orthoglide_2012_loops.c: q, qd, qdd are here the free variables
 * u = 6x, 6y, 6, 11, 12, 13, 21, 31, 22, 32, 23, 33.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_2012_TREE_H
#define ORTHOGLIDE_2012_TREE_H

#include "orthoglide_2012.h"
#include "modeler_closure.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const modeler_closure orthoglide_2012_loops;
extern const modeler_closure orthoglide_2012_platform_loops;
extern const double orthoglide_2012_home[12];

/* Closes the loops from `start`, into p. Returns a status. */
int orthoglide_2012_posed(const modeler_closure *loops, const double *q, const double *start,
    struct orthoglide_2012_posture *p);

/* G of that posture; its speeds and accelerations, where qd is not NULL. */
void orthoglide_2012_moved(const modeler_closure *loops, const double *qd,
    struct orthoglide_2012_posture *p);

void orthoglide_2012_tree_regressor(const double q[12], const double qd[12], const double qdd[12],
                                    double phi[12 * 196]);
void orthoglide_2012_tree_base_regressor(const double q[12], const double qd[12],
                                         const double qdd[12], double phi[12 * 53]);
void orthoglide_2012_tree_inverse_dynamics(const double q[12], const double qd[12],
                                           const double qdd[12], const double beta[53],
                                           double tau[12]);
void orthoglide_2012_tree_inertia_matrix(const double q[12], const double beta[53],
                                         double M[12 * 12]);
void orthoglide_2012_tree_gravity(const double q[12], const double beta[53], double tau[12]);
void orthoglide_2012_tree_coriolis(const double q[12], const double qd[12], const double qdd[12],
                                   const double beta[53], double tau[12]);
void orthoglide_2012_tree_friction(const double qd[12], const double beta[53], double tau[12]);
void orthoglide_2012_tree_forward_kinematics(const double q[12], double T[18 * 3 * 4]);
void orthoglide_2012_tree_drift(const double q[12], const double qd[12], double values[9]);
void orthoglide_2012_tree_closure(const double q[12], double values[48]);
void orthoglide_2012_tree_residual(const double q[12], double f[9]);
void orthoglide_2012_tree_factor(const double J[27], double lu[25]);
void orthoglide_2012_tree_solve(const double lu[25], const double right[9], double x[9]);
void orthoglide_2012_tree_coupling(const double J[27], const double lu[25], double G[27]);
void orthoglide_2012_tree_turned(const double J[27], const double K[27], const double lu[25],
                                 double x[9]);
void orthoglide_2012_tree_spread(const double J[27], const double K[27], const double lu[25],
                                 double x[1]);
void orthoglide_2012_tree_platform_factor(const double J[27], double lu[18]);
void orthoglide_2012_tree_platform_solve(const double lu[18], const double right[9], double x[9]);
void orthoglide_2012_tree_platform_coupling(const double J[27], const double lu[18], double G[18]);
void orthoglide_2012_tree_platform_turned(const double J[27], const double K[27],
                                          const double lu[18], double x[9]);
void orthoglide_2012_tree_platform_spread(const double J[27], const double K[27],
                                          const double lu[18], double x[1]);
void orthoglide_2012_tree_rows(const double q[12], const double t[12], const double G[27],
                               const double lu[25], const double v[3], const double a[3],
                               double phi[3 * 53]);

/* Regressor of the base parameters, for orthoglide_2012_batch.c: from the posture p if `next`,
 * and if that is 0 or fails from home. Returns a status. */
int orthoglide_2012_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct orthoglide_2012_posture *p, double *rows, double *phi);

/* What closes the loops of one sample after another, for orthoglide_2012_tile.c. */
struct orthoglide_2012_single {
    const modeler_closure *loops;
    int (*posed)(const modeler_closure *, const double *, const double *, struct orthoglide_2012_posture *);
    int (*next)(const double *, const double *, const double *, int, struct orthoglide_2012_posture *,
                double *, double *);
    int (*eliminated)(const modeler_closure *, const modeler_work *, const double **, const double **,
                      const double **);
};

#ifdef __cplusplus
}
#endif

#endif
