/* Closing kinematic loops: which free variables u of the opened tree belong to given ones.
 *
 * Newton along a path: from a closed posture the given variables move straight to their values, in
 * steps so short that Newton contracts from the first and that the Jacobian is singular nowhere
 * within one, so the assembly mode never changes: a way through a turning point or a bifurcation
 * ends there. Every equation of every loop is checked at the end of each step, those that follow
 * from others too. C99, no allocation, no global state, re-entrant.
 */
#ifndef MODELER_CLOSURE_H
#define MODELER_CLOSURE_H

#include <stddef.h>

#include "modeler_runtime.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What functions of robots with loops return; outputs are NaN unless it is MODELER_CLOSED. */
enum {
    MODELER_CLOSED = 0,    /* done */
    MODELER_OPEN = 1,      /* the loops cannot be closed on the way to these values */
    MODELER_SINGULAR = 2,  /* singular posture: the passive joints are not determined */
    MODELER_UNFINISHED = 3 /* too many steps, or a value that is not finite */
};

/* The loops of a robot. `equations` writes the residuals f, then their derivatives by u, row after
 * row: solved + solved * unknowns numbers. */
typedef struct {
    int unknowns;             /* length of u */
    int given;                /* how many of u are given */
    int solved;               /* the others: as many as equations */
    const int *given_places;  /* in u */
    const int *solved_places; /* in u */
    const double *scale;      /* of u: 1 for angles in rad, the robot's size for travels in m */
    void (*equations)(const double *u, double *values);
    int residuals;            /* equations of all loops, in m or 1 */
    int alignments;           /* cosines that are positive where axes point as they should */
    double tolerance;         /* of the residuals */
    void (*residual)(const double *u, double *values); /* residuals, then alignments */
} modeler_closure;

/* Numbers that `work` must hold; `checked` = residuals + alignments. */
#define MODELER_CLOSURE_WORK(unknowns, solved, checked) \
    ((solved) * ((unknowns) + 2 * (solved) + 7) + 3 * (unknowns) + (checked))

/* Closed posture u with the given variables at q, from the closed posture `start`.
 * u may be `start`. Returns a status; u is unchanged unless it is MODELER_CLOSED. */
int modeler_close(const modeler_closure *loops, const double *q, const double *start, double *u,
                  double *work);

/* Velocities and accelerations at a closed posture: ud = G qd, udd = G qdd + gamma.
 * `drift` writes d/dt(J) ud. G is unknowns x given, row-major. */
int modeler_follow(const modeler_closure *loops,
                   void (*drift)(const double *u, const double *ud, double *values),
                   const double *u, const double *qd, const double *qdd, double *G, double *ud,
                   double *udd, double *work);

/* G alone. */
int modeler_coupling(const modeler_closure *loops, const double *u, double *G, double *work);

/* out = G^T rows: `rows` is unknowns x width, out is given x width. */
void modeler_project(const modeler_closure *loops, const double *G, const double *rows, int width,
                     double *out);

/* All NaN. */
void modeler_nothing(double *out, size_t length);

/* Emitted functions with a status, and loops over samples that keep it. */
typedef int (*modeler_status_1)(const double *, double *);
typedef int (*modeler_status_2)(const double *, const double *, double *);
typedef int (*modeler_status_3)(const double *, const double *, const double *, double *);
typedef int (*modeler_status_4)(const double *, const double *, const double *, const double *,
                                double *);

void modeler_batch_status_1(modeler_status_1 function, size_t samples,
                            const modeler_input inputs[1], double *out, size_t out_step,
                            int *status);
void modeler_batch_status_2(modeler_status_2 function, size_t samples,
                            const modeler_input inputs[2], double *out, size_t out_step,
                            int *status);
void modeler_batch_status_3(modeler_status_3 function, size_t samples,
                            const modeler_input inputs[3], double *out, size_t out_step,
                            int *status);
void modeler_batch_status_4(modeler_status_4 function, size_t samples,
                            const modeler_input inputs[4], double *out, size_t out_step,
                            int *status);

#ifdef __cplusplus
}
#endif

#endif
