/* Planar five-bar, two actuated joints at the base
 *
 * Functions of the opened tree, for five_bar_loops.c: q, qd, qdd are here the free variables
 * u = 11, 21, 12, 22.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef FIVE_BAR_TREE_H
#define FIVE_BAR_TREE_H

#ifdef __cplusplus
extern "C" {
#endif

void five_bar_tree_regressor(const double *q, const double *qd, const double *qdd, double *phi);
void five_bar_tree_base_regressor(const double *q, const double *qd, const double *qdd, double *phi);
void five_bar_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                    const double *beta, double *tau);
void five_bar_tree_inertia_matrix(const double *q, const double *beta, double *M);
void five_bar_tree_gravity(const double *q, const double *beta, double *tau);
void five_bar_tree_coriolis(const double *q, const double *qd, const double *qdd,
                            const double *beta, double *tau);
void five_bar_tree_friction(const double *qd, const double *beta, double *tau);
void five_bar_tree_forward_kinematics(const double *q, double *T);
void five_bar_tree_drift(const double *q, const double *qd, double *values);
void five_bar_tree_closure(const double *q, double *values);
void five_bar_tree_residual(const double *q, double *f);
void five_bar_tree_factor(const double *J, double *lu);
void five_bar_tree_solve(const double *lu, const double *right, double *x);
void five_bar_tree_coupling(const double *J, const double *lu, double *G);
void five_bar_tree_turned(const double *J, const double *K, const double *lu, double *x);
void five_bar_tree_spread(const double *J, const double *K, const double *lu, double *x);
void five_bar_tree_rows(const double *q, const double *t, const double *G, const double *lu,
                        const double *v, const double *a, double *phi);

#ifdef __cplusplus
}
#endif

#endif
