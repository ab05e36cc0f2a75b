/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of the opened tree, for evra_loops.c: q, qd, qdd are here the free variables
 * u = Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32, 13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef EVRA_TREE_H
#define EVRA_TREE_H

#include "evra.h"
#include "modeler_closure.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const modeler_closure evra_loops;
extern const modeler_closure evra_platform_loops;
extern const double evra_home[26];

/* Closes the loops from `start`, into p. Returns a status. */
int evra_posed(const modeler_closure *loops, const double *q, const double *start,
    struct evra_posture *p);

/* G of that posture; its speeds and accelerations, where qd is not NULL. */
void evra_moved(const modeler_closure *loops, const double *qd,
    struct evra_posture *p);

void evra_tree_regressor(const double q[26], const double qd[26], const double qdd[26],
                         double phi[26 * 210]);
void evra_tree_base_regressor(const double q[26], const double qd[26], const double qdd[26],
                              double phi[26 * 90]);
void evra_tree_inverse_dynamics(const double q[26], const double qd[26], const double qdd[26],
                                const double beta[90], double tau[26]);
void evra_tree_inertia_matrix(const double q[26], const double beta[90], double M[26 * 26]);
void evra_tree_gravity(const double q[26], const double beta[90], double tau[26]);
void evra_tree_coriolis(const double q[26], const double qd[26], const double qdd[26],
                        const double beta[90], double tau[26]);
void evra_tree_friction(const double qd[26], const double beta[90], double tau[26]);
void evra_tree_forward_kinematics(const double q[26], double T[26 * 3 * 4]);
void evra_tree_drift(const double q[26], const double qd[26], double values[18]);
void evra_tree_closure(const double q[26], double values[180]);
void evra_tree_residual(const double q[26], double f[18]);
void evra_tree_factor(const double J[132], double lu[107]);
void evra_tree_solve(const double lu[107], const double right[18], double x[18]);
void evra_tree_coupling(const double J[132], const double lu[107], double G[144]);
void evra_tree_turned(const double J[132], const double K[132], const double lu[107], double x[18]);
void evra_tree_spread(const double J[132], const double K[132], const double lu[107], double x[1]);
void evra_tree_platform_factor(const double J[132], double lu[54]);
void evra_tree_platform_solve(const double lu[54], const double right[18], double x[18]);
void evra_tree_platform_coupling(const double J[132], const double lu[54], double G[144]);
void evra_tree_platform_turned(const double J[132], const double K[132], const double lu[54],
                               double x[18]);
void evra_tree_platform_spread(const double J[132], const double K[132], const double lu[54],
                               double x[1]);
void evra_tree_rows(const double q[26], const double t[30], const double G[144],
                    const double lu[107], const double v[8], const double a[8], double phi[8 * 90]);

/* Regressor of the base parameters, for evra_batch.c: from the posture p if `next`,
 * and if that is 0 or fails from home. Returns a status. */
int evra_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct evra_posture *p, double *rows, double *phi);

/* What closes the loops of one sample after another, for evra_tile.c. */
struct evra_single {
    const modeler_closure *loops;
    int (*posed)(const modeler_closure *, const double *, const double *, struct evra_posture *);
    int (*next)(const double *, const double *, const double *, int, struct evra_posture *,
                double *, double *);
    int (*eliminated)(const modeler_closure *, const modeler_work *, const double **, const double **,
                      const double **);
};

#ifdef __cplusplus
}
#endif

#endif
