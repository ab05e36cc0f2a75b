/* Closing kinematic loops: which free variables u of the opened tree belong to given ones.
 *
 * Newton along a path: from a closed posture the given variables move straight to their values, in
 * steps so short that Newton contracts from the first and that the Jacobian is singular nowhere
 * within one, so the assembly mode never changes: a way through a turning point or a bifurcation
 * ends there. Every equation of every loop is checked at the end of each step, those that follow
 * from others too. Each step starts with the factors of the one before.
 *
 * modeler_closure.c walks, modeler_closure_factor.c solves, modeler_closure_motion.c carries motion
 * over. C99, no allocation, no global state, re-entrant.
 */
#ifndef MODELER_CLOSURE_H
#define MODELER_CLOSURE_H

#include <stddef.h>

#include "modeler_kept.h"
#include "modeler_runtime.h"
#include "modeler_solve.h"
#include "modeler_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The loops of a robot; its functions are straight-line code without the zeros of df/du.
 *
 * `values` are all equations f, the `solved` independent ones first; cosines; the nonzeros of
 * df/du, row after row; sines and cosines for other functions. Where a pivot of `factor` is small,
 * the equations are solved densely, with rows exchanged. */
typedef struct {
    int unknowns;              /* length of u */
    int given;                 /* how many of u are given */
    int solved;                /* the others: as many as independent equations */
    const int *given_places;   /* in u */
    const int *solved_places;  /* in u */
    const modeler_real *scale; /* of u: 1 for angles in rad, the robot's size for travels in m */
    int equations;             /* of all loops, in m or 1 */
    int alignments;            /* cosines that are positive where axes point as they should */
    modeler_real tolerance;    /* of the equations */
    int nonzeros;              /* of df/du */
    const int *row;            /* of each nonzero: equation */
    const int *column;         /* of each nonzero: place in u */
    int length;                /* of `values` */
    void (*closure)(const modeler_real *u, modeler_real *values);
    void (*residual)(const modeler_real *u, modeler_real *f); /* the independent equations alone */
    int factors;                                              /* length of lu */
    const modeler_real *limits; /* largest size of the first `solved` of lu, which are 1/pivot */
    void (*factor)(const modeler_real *J, modeler_real *lu);
    /* J_solved x = right */
    void (*solve)(const modeler_real *lu, const modeler_real *right, modeler_real *x);
    int couplings;              /* nonzeros of G in solved rows */
    const int *coupling_row;    /* of each: place in u */
    const int *coupling_column; /* of each: place among the given */
    void (*coupling)(const modeler_real *J, const modeler_real *lu, modeler_real *G);
    /* x: at least the sums of the absolute entries of each row of J_solved^-1 (K - J)_solved */
    void (*turned)(const modeler_real *J, const modeler_real *K, const modeler_real *lu,
                   modeler_real *x);
    /* sum of the squares of the entries of that matrix, in scaled variables */
    void (*spread)(const modeler_real *J, const modeler_real *K, const modeler_real *lu,
                   modeler_real *sum);
} modeler_closure;

/* Memory of the functions below: it keeps the posture that was found last. */
typedef struct {
    modeler_kept *kept;
    int *places;           /* MODELER_CLOSURE_PLACES of them */
    modeler_real *numbers; /* MODELER_CLOSURE_NUMBERS of them */
    int evaluations;       /* of the closure equations in one call, at most */
} modeler_work;

#define MODELER_CLOSURE_PLACES(unknowns, solved) (2 * (solved) + (unknowns))
#define MODELER_CLOSURE_NUMBERS(unknowns, solved, length, factors) \
    (2 * ((length) + (factors) + (solved) * ((solved) + 1)) + \
     (solved) * ((unknowns) - (solved) + 5) + 5 * (unknowns))

/* Closed posture u with the given variables at q, from the closed posture `start`.
 * u may be `start`. Returns a status, MODELER_UNFINISHED where work->evaluations do not do; u is
 * unchanged unless it is MODELER_CLOSED. */
int modeler_close(const modeler_closure *loops, const modeler_real *q, const modeler_real *start,
                  modeler_real *u, const modeler_work *work);

/* The same from the posture to which the last call with this `work` has come. */
int modeler_close_next(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                       const modeler_work *work);

/* The same for steps as short as a controller's: fewer evaluations, each with new factors. */
int modeler_close_soon(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                       const modeler_work *work);

/* The functions below use what `work` holds of the closed posture that was found last. */

/* G: ud = G qd; unknowns x given, row-major. */
void modeler_coupling(const modeler_closure *loops, modeler_real *G, const modeler_work *work);

/* Writes d/dt(J) ud. */
typedef void (*modeler_drift_function)(const modeler_real *u, const modeler_real *ud,
                                       modeler_real *values);

/* Speeds ud = G qd, and gamma, the accelerations where qdd = 0. */
void modeler_drift(const modeler_closure *loops, modeler_drift_function drift,
                   const modeler_real *u, const modeler_real *G, const modeler_real *qd,
                   modeler_real *ud, modeler_real *gamma, const modeler_work *work);

/* udd = G qdd + gamma. */
void modeler_accelerations(const modeler_closure *loops, const modeler_real *G,
                           const modeler_real *gamma, const modeler_real *qdd, modeler_real *udd);

/* dG/dt at the speeds ud; unknowns x given, row-major. */
void modeler_coupling_rate(const modeler_closure *loops, modeler_drift_function drift,
                           const modeler_real *u, const modeler_real *G, const modeler_real *ud,
                           modeler_real *rate, const modeler_work *work);

/* `values`, lu and the nonzeros of G in solved rows; returns 0 if the equations were solved
 * densely, so that there is no lu. */
int modeler_eliminated(const modeler_closure *loops, const modeler_work *work,
                       const modeler_real **values, const modeler_real **lu,
                       const modeler_real **G);

/* out = G^T rows: `rows` is unknowns x width, out is given x width. */
void modeler_project(const modeler_closure *loops, const modeler_real *G, const modeler_real *rows,
                     int width, modeler_real *out);

/* out += factor G^T rows. */
void modeler_project_more(const modeler_closure *loops, const modeler_real *G,
                          const modeler_real *rows, int width, modeler_real factor,
                          modeler_real *out);

/* out += A x: A is rows x inner, x is inner x width. */
void modeler_apply_more(const modeler_real *A, int rows, int inner, const modeler_real *x,
                        int width, modeler_real *out);

#ifdef __cplusplus
}
#endif

#endif
