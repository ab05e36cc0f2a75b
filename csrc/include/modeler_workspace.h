/* What closing loops works in: the parts of a modeler_work, for modeler_closure*.c alone. */
#ifndef MODELER_WORKSPACE_H
#define MODELER_WORKSPACE_H

#include "modeler_closure.h"

/* There are two places for values and factors: where a step starts, and where it has come. */
typedef struct {
    modeler_kept *kept;
    int *order[2];           /* of the rows */
    int *places;             /* of all variables: among the solved ones, or -1 */
    modeler_real *values[2]; /* see modeler_closure.h */
    modeler_real *lu[2];
    modeler_real *dense[2]; /* factors with rows exchanged, rows and columns scaled */
    modeler_real *norm[2];  /* of the rows */
    modeler_real *step;     /* of the solved variables, as all below */
    modeler_real *right;
    modeler_real *along;   /* tangent of a step, to its end */
    modeler_real *bend;    /* what the last step was along its tangent */
    modeler_real *share;   /* 1/scale */
    modeler_real *coupled; /* nonzeros of G in solved rows */
    modeler_real *whole;   /* of all variables: a change */
    modeler_real *change;  /* of the given variables that is left at the start of a step */
    modeler_real *last;    /* what the last step changed of them */
    modeler_real *trial;   /* posture */
    modeler_real *start;   /* of a step: posture */
    int at;                /* place of the values of the trial posture */
    int left;              /* evaluations */
    int brief;             /* as few evaluations as can be, each with new factors */
} modeler_workspace;

/* The parts of `work`. */
modeler_workspace modeler_parts(const modeler_closure *loops, const modeler_work *work);

/* The nonzeros of df/du at a place. */
const modeler_real *modeler_jacobian(const modeler_closure *loops, const modeler_workspace *w,
                                     int at);

/* Factors of the solved columns of the Jacobian at hand; 0 if they are singular. */
int modeler_factors(const modeler_closure *loops, const modeler_workspace *w, int at);

/* x with J_solved x = right; right in the order of the equations. */
void modeler_solution(const modeler_closure *loops, const modeler_workspace *w, int at,
                      const modeler_real *right, modeler_real *x);

#endif
