/* Small systems of equations A x = b with a status.
 *
 * A is n x n, row-major, symmetric and positive definite, as inertia matrices are, or nearly so:
 * Gauss's elimination in the order of the rows, none exchanged, which is L D L' then (Cholesky
 * without roots). Inline, so that a compiler unrolls loops of known length. C99, no allocation, no
 * global state, re-entrant.
 */
#ifndef MODELER_SOLVE_H
#define MODELER_SOLVE_H

#include <math.h>

#include "modeler_real.h"
#include "modeler_status.h"

/* 1 if all are finite. */
static inline int modeler_finite(const modeler_real *x, int n)
{
    int bad = 0;

    for (int i = 0; i < n; i++) {
        bad |= !(x[i] - x[i] == MODELER_REAL(0.0));
    }
    return !bad;
}

/* What a function returns: the status, or MODELER_NOT_FINITE. `x` is NaN then unless it is
 * MODELER_DONE. */
static inline int modeler_told(int status, modeler_real *x, int n)
{
    if (status == MODELER_DONE && !modeler_finite(x, n)) {
        status = MODELER_NOT_FINITE;
    }
    for (int i = 0; status != MODELER_DONE && i < n; i++) {
        x[i] = NAN;
    }
    return status;
}

/* Status of n pivots that were found from the last to the first, each left of an entry of the
 * diagonal. */
static inline int modeler_pivots(const modeler_real *pivot, const modeler_real *diagonal, int n)
{
    int status = MODELER_DONE;

    for (int i = n - 1; i >= 0 && status == MODELER_DONE; i--) {
        if (!modeler_finite(pivot + i, 1)) {
            status = MODELER_NOT_FINITE;
        } else if (!(pivot[i] > MODELER_REAL(0.0)) || !(pivot[i] > MODELER_PIVOT * diagonal[i])) {
            status = MODELER_SINGULAR;
        }
    }
    return status;
}

/* Factors of A in its place: L below the diagonal, 1/pivots on it, U = D L' above. */
static inline int modeler_factor(modeler_real *A, int n)
{
    int status = MODELER_DONE;

    for (int i = 0; i < n && status == MODELER_DONE; i++) {
        modeler_real *const row = A + i * n;
        const modeler_real diagonal = row[i];

        for (int k = 0; k < i; k++) {
            row[k] *= A[k * n + k];
            for (int j = k + 1; j < n; j++) {
                row[j] -= row[k] * A[k * n + j];
            }
        }
        status = modeler_pivots(row + i, &diagonal, 1);
        row[i] = MODELER_REAL(1.0) / row[i];
    }
    return status;
}

/* X = A^-1 X of the factors; X is n x columns. */
static inline void modeler_solve(const modeler_real *A, int n, modeler_real *X, int columns)
{
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) {
            for (int j = 0; j < columns; j++) {
                X[i * columns + j] -= A[i * n + k] * X[k * columns + j];
            }
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) {
            for (int j = 0; j < columns; j++) {
                X[i * columns + j] -= A[i * n + k] * X[k * columns + j];
            }
        }
        for (int j = 0; j < columns; j++) {
            X[i * columns + j] *= A[i * n + i];
        }
    }
}

#endif
