/* Planar five-bar, two actuated joints at the base
 *
 * Functions of the opened tree, for five_bar_loops.c: q, qd, qdd are here the free variables
 * u = 11, 21, 12, 22.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef FIVE_BAR_TREE_H
#define FIVE_BAR_TREE_H

#include "five_bar.h"
#include "modeler_closure.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const modeler_closure five_bar_loops;
extern const double five_bar_home[4];

/* Closes the loops from `start`, into p. Returns a status. */
int five_bar_posed(const modeler_closure *loops, const double *q, const double *start,
    struct five_bar_posture *p);

/* G of that posture; its speeds and accelerations, where qd is not NULL. */
void five_bar_moved(const modeler_closure *loops, const double *qd,
    struct five_bar_posture *p);

void five_bar_tree_regressor(const double q[4], const double qd[4], const double qdd[4],
                             double phi[4 * 40]);
void five_bar_tree_base_regressor(const double q[4], const double qd[4], const double qdd[4],
                                  double phi[4 * 11]);
void five_bar_tree_inverse_dynamics(const double q[4], const double qd[4], const double qdd[4],
                                    const double beta[11], double tau[4]);
void five_bar_tree_inertia_matrix(const double q[4], const double beta[11], double M[4 * 4]);
void five_bar_tree_gravity(const double q[4], const double beta[11], double tau[4]);
void five_bar_tree_coriolis(const double q[4], const double qd[4], const double qdd[4],
                            const double beta[11], double tau[4]);
void five_bar_tree_friction(const double qd[4], const double beta[11], double tau[4]);
void five_bar_tree_forward_kinematics(const double q[4], double T[4 * 3 * 4]);
void five_bar_tree_drift(const double q[4], const double qd[4], double values[2]);
void five_bar_tree_closure(const double q[4], double values[19]);
void five_bar_tree_residual(const double q[4], double f[2]);
void five_bar_tree_factor(const double J[8], double lu[4]);
void five_bar_tree_solve(const double lu[4], const double right[2], double x[2]);
void five_bar_tree_coupling(const double J[8], const double lu[4], double G[4]);
void five_bar_tree_turned(const double J[8], const double K[8], const double lu[4], double x[2]);
void five_bar_tree_spread(const double J[8], const double K[8], const double lu[4], double x[1]);
void five_bar_tree_rows(const double q[4], const double t[8], const double G[4],
                        const double lu[4], const double v[2], const double a[2],
                        double phi[2 * 11]);

/* Regressor of the base parameters, for five_bar_batch.c: from the posture p if `next`,
 * and if that is 0 or fails from home. Returns a status. */
int five_bar_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct five_bar_posture *p, double *rows, double *phi);

/* What closes the loops of one sample after another, for five_bar_tile.c. */
struct five_bar_single {
    const modeler_closure *loops;
    int (*posed)(const modeler_closure *, const double *, const double *, struct five_bar_posture *);
    int (*next)(const double *, const double *, const double *, int, struct five_bar_posture *,
                double *, double *);
    int (*eliminated)(const modeler_closure *, const modeler_work *, const double **, const double **,
                      const double **);
};

#ifdef __cplusplus
}
#endif

#endif
