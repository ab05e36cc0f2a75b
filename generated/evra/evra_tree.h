/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of the opened tree, for evra_loops.c: q, qd, qdd are here the free variables
 * u = Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32, 13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef EVRA_TREE_H
#define EVRA_TREE_H

#ifdef __cplusplus
extern "C" {
#endif

void evra_tree_regressor(const double *q, const double *qd, const double *qdd, double *phi);
void evra_tree_base_regressor(const double *q, const double *qd, const double *qdd, double *phi);
void evra_tree_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                const double *beta, double *tau);
void evra_tree_inertia_matrix(const double *q, const double *beta, double *M);
void evra_tree_gravity(const double *q, const double *beta, double *tau);
void evra_tree_coriolis(const double *q, const double *qd, const double *qdd, const double *beta,
                        double *tau);
void evra_tree_friction(const double *qd, const double *beta, double *tau);
void evra_tree_forward_kinematics(const double *q, double *T);
void evra_tree_drift(const double *q, const double *qd, double *values);
void evra_tree_closure(const double *q, double *values);
void evra_tree_residual(const double *q, double *f);
void evra_tree_factor(const double *J, double *lu);
void evra_tree_solve(const double *lu, const double *right, double *x);
void evra_tree_coupling(const double *J, const double *lu, double *G);
void evra_tree_turned(const double *J, const double *K, const double *lu, double *x);
void evra_tree_spread(const double *J, const double *K, const double *lu, double *x);
void evra_tree_platform_factor(const double *J, double *lu);
void evra_tree_platform_solve(const double *lu, const double *right, double *x);
void evra_tree_platform_coupling(const double *J, const double *lu, double *G);
void evra_tree_platform_turned(const double *J, const double *K, const double *lu, double *x);
void evra_tree_platform_spread(const double *J, const double *K, const double *lu, double *x);
void evra_tree_rows(const double *q, const double *t, const double *G, const double *lu,
                    const double *v, const double *a, double *phi);

#ifdef __cplusplus
}
#endif

#endif
