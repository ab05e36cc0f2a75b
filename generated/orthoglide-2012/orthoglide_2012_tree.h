/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of the opened tree, for orthoglide_2012_loops.c: q, qd, qdd are here the free variables
 * u = 6x, 6y, 6, 11, 12, 13, 21, 31, 22, 32, 23, 33.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_2012_TREE_H
#define ORTHOGLIDE_2012_TREE_H

#ifdef __cplusplus
extern "C" {
#endif

void orthoglide_2012_tree_regressor(const double *q, const double *qd, const double *qdd,
                                    double *phi);
void orthoglide_2012_tree_base_regressor(const double *q, const double *qd, const double *qdd,
                                         double *phi);
void orthoglide_2012_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                           const double *beta, double *tau);
void orthoglide_2012_tree_inertia_matrix(const double *q, const double *beta, double *M);
void orthoglide_2012_tree_gravity(const double *q, const double *beta, double *tau);
void orthoglide_2012_tree_coriolis(const double *q, const double *qd, const double *qdd,
                                   const double *beta, double *tau);
void orthoglide_2012_tree_friction(const double *qd, const double *beta, double *tau);
void orthoglide_2012_tree_forward_kinematics(const double *q, double *T);
void orthoglide_2012_tree_drift(const double *q, const double *qd, double *values);
void orthoglide_2012_tree_closure(const double *q, double *values);
void orthoglide_2012_tree_residual(const double *q, double *f);
void orthoglide_2012_tree_factor(const double *J, double *lu);
void orthoglide_2012_tree_solve(const double *lu, const double *right, double *x);
void orthoglide_2012_tree_coupling(const double *J, const double *lu, double *G);
void orthoglide_2012_tree_turned(const double *J, const double *K, const double *lu, double *x);
void orthoglide_2012_tree_spread(const double *J, const double *K, const double *lu, double *x);
void orthoglide_2012_tree_platform_factor(const double *J, double *lu);
void orthoglide_2012_tree_platform_solve(const double *lu, const double *right, double *x);
void orthoglide_2012_tree_platform_coupling(const double *J, const double *lu, double *G);
void orthoglide_2012_tree_platform_turned(const double *J, const double *K, const double *lu,
                                          double *x);
void orthoglide_2012_tree_platform_spread(const double *J, const double *K, const double *lu,
                                          double *x);
void orthoglide_2012_tree_rows(const double *q, const double *t, const double *G, const double *lu,
                               const double *v, const double *a, double *phi);

#ifdef __cplusplus
}
#endif

#endif
