/* Closing loops by Newton along a path; see modeler_closure.h. */
#include "modeler_workspace.h"

#include <math.h>

#define STEP MODELER_REAL(0.3)     /* longest change of a variable in one step, in its scale */
#define NEWTON 12                  /* corrections of one step, at most */
#define POLISHED 2                 /* after CONVERGED, at most: rounding may be above EXACT */
#define INEXACT MODELER_REAL(1e-3) /* how far from closed a start may be, in its scale */
#define TURNED MODELER_REAL(0.5)   /* |J^-1 J' - 1| from a step's start to its end, at most */
#define TURNING MODELER_REAL(4.0)  /* about that, per length of a step */
#define NEAR MODELER_REAL(0.05)    /* length or contraction up to which old factors do */
#define STRAIGHT MODELER_REAL(0.1) /* how far from the last direction a step may bend like it */

/* Largest change of a solved variable, in its scale. */
static modeler_real largest(const modeler_closure *loops, const modeler_workspace *w,
                            const modeler_real *x)
{
    modeler_real found = MODELER_REAL(0.0);

    for (int j = 0; j < loops->solved; j++) {
        const modeler_real size = modeler_fabs(x[j]) * w->share[j];
        if (size > found || isnan(size)) {
            found = size;
        }
    }
    return found;
}

/* Takes the step from w->trial. */
static void correct(const modeler_closure *loops, const modeler_workspace *w)
{
    for (int j = 0; j < loops->solved; j++) {
        w->trial[loops->solved_places[j]] -= w->step[j];
    }
}

/* 1 if a correction is not within `allowed`, or does not contract from the one before. */
static int diverges(modeler_real size, modeler_real before, int round, modeler_real allowed)
{
    return !(size <= allowed) ||
           (round > 0 && size > MODELER_CONVERGED && !(size <= MODELER_REAL(0.5) * before));
}

/* Newton on w->trial with the given variables held. 1 if it contracts, within a move of `allowed`;
 * values and factors are then those there. */
static int corrected(const modeler_closure *loops, modeler_workspace *w, modeler_real allowed)
{
    modeler_real before = MODELER_REAL(0.0);
    int polished = 0;

    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->closure(w->trial, w->values[w->at]);
        if (!modeler_factors(loops, w, w->at)) {
            return 0;
        }
        modeler_solution(loops, w, w->at, w->values[w->at], w->step);
        const modeler_real size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed) != 0) {
            return 0;
        }
        if (size <= MODELER_EXACT || (size <= MODELER_CONVERGED && polished++ >= POLISHED)) {
            return 1;
        }
        correct(loops, w);
        before = size;
    }
    return 0;
}

/* The same with the factors where the step of that length starts, as long as these contract well; 0
 * if it does not contract. */
static int neared(const modeler_closure *loops, modeler_workspace *w, modeler_real allowed,
                  modeler_real length)
{
    modeler_real before = MODELER_REAL(0.0);

    if (length > NEAR) {
        return 1;
    }
    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->residual(w->trial, w->right);
        modeler_solution(loops, w, 1 - w->at, w->right, w->step);
        const modeler_real size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed) != 0) {
            return 0;
        }
        correct(loops, w);
        const modeler_real rate = round > 0 ? size / before : TURNING * length;
        if (!(size * rate > MODELER_REAL(0.1) * MODELER_EXACT) || (round > 0 && rate > NEAR)) {
            return 1;
        }
        before = size;
    }
    return 1;
}

/* 1 if every loop is closed at w->trial, redundant equations and directions of axes included. */
static int closed(const modeler_closure *loops, const modeler_workspace *w)
{
    const modeler_real *const f = w->values[w->at], *const cosine = f + loops->equations;

    for (int i = 0; i < loops->equations; i++) {
        if (!(modeler_fabs(f[i]) <= loops->tolerance)) {
            return 0;
        }
    }
    for (int i = 0; i < loops->alignments; i++) {
        if (!(cosine[i] > MODELER_REAL(0.0))) {
            return 0;
        }
    }
    return 1;
}

/* |J^-1 J' - 1|^2 from the start of the step, where pivoting was dense. */
static modeler_real spread(const modeler_closure *loops, const modeler_workspace *w)
{
    const int m = loops->solved;
    const modeler_real *const J = modeler_jacobian(loops, w, w->at);
    modeler_real sum = MODELER_REAL(0.0);

    for (int j = 0; j < m; j++) {
        const int k = loops->solved_places[j];
        for (int i = 0; i < m; i++) {
            w->right[i] = MODELER_REAL(0.0);
        }
        for (int i = 0; i < loops->nonzeros; i++) {
            if (loops->column[i] == k) {
                w->right[loops->row[i]] = J[i];
            }
        }
        modeler_solution(loops, w, 1 - w->at, w->right, w->step);
        for (int i = 0; i < m; i++) {
            const modeler_real x = w->step[i] * w->share[i] * loops->scale[k] -
                                   (i == j ? MODELER_REAL(1.0) : MODELER_REAL(0.0));
            sum += x * x;
        }
    }
    return sum;
}

/* 1 if the Jacobian has turned so little since the start of the step that it was singular nowhere
 * between: |J^-1 J' - 1| stays below 1 on the straight way from J to J'. The norm is that of
 * Frobenius; sums of absolute entries of rows bound it from above, and are quicker. */
static int alike(const modeler_closure *loops, const modeler_workspace *w)
{
    const int first = 1 - w->at;
    const modeler_real *const J = modeler_jacobian(loops, w, first), *const K = modeler_jacobian(
                                                                         loops, w, w->at);
    modeler_real sum = MODELER_REAL(0.0);

    if (w->kept->dense[first] != 0) {
        return spread(loops, w) <= TURNED * TURNED;
    }
    loops->turned(J, K, w->lu[first], w->step);
    for (int j = 0; j < loops->solved; j++) {
        sum += w->step[j] * w->step[j];
    }
    if (!(sum <= TURNED * TURNED)) {
        loops->spread(J, K, w->lu[first], &sum);
    }
    return sum <= TURNED * TURNED;
}

/* The tangent, from G at hand. */
static void along_coupling(const modeler_closure *loops, const modeler_workspace *w)
{
    for (int k = 0; k < loops->unknowns; k++) {
        w->whole[k] = MODELER_REAL(0.0);
    }
    for (int k = 0; k < loops->couplings; k++) {
        w->whole[loops->coupling_row[k]] += w->coupled[k] * w->change[loops->coupling_column[k]];
    }
    for (int j = 0; j < loops->solved; j++) {
        w->along[j] = w->whole[loops->solved_places[j]];
    }
}

/* The tangent, from the factors. */
static void along_solution(const modeler_closure *loops, const modeler_workspace *w)
{
    const modeler_real *const J = modeler_jacobian(loops, w, w->at);

    for (int k = 0; k < loops->unknowns; k++) {
        w->whole[k] = MODELER_REAL(0.0);
    }
    for (int j = 0; j < loops->given; j++) {
        w->whole[loops->given_places[j]] = w->change[j];
    }
    for (int i = 0; i < loops->solved; i++) {
        w->right[i] = MODELER_REAL(0.0);
    }
    for (int k = 0; k < loops->nonzeros; k++) {
        w->right[loops->row[k]] -= J[k] * w->whole[loops->column[k]];
    }
    modeler_solution(loops, w, w->at, w->right, w->along);
}

/* The posture w->trial is where the next step starts, straight to q; gives its length, in scales:
 * infinite where more steps would be needed than evaluations are left. */
static modeler_real arrive(const modeler_closure *loops, modeler_workspace *w,
                           const modeler_real *q)
{
    modeler_real length;

    for (int k = 0; k < loops->unknowns; k++) {
        w->start[k] = w->trial[k];
    }
    for (int j = 0; j < loops->given; j++) {
        w->change[j] = q[j] - w->start[loops->given_places[j]];
    }
    if (w->kept->coupled != 0) {
        along_coupling(loops, w);
    } else {
        along_solution(loops, w);
    }
    w->kept->coupled = 0;
    w->at = 1 - w->at;
    length = largest(loops, w, w->along);
    for (int j = 0; j < loops->given; j++) {
        const modeler_real own = modeler_fabs(w->change[j]) / loops->scale[loops->given_places[j]];
        if (own > STEP * (modeler_real)w->left) {
            return INFINITY;
        }
        if (own > length || isnan(own)) {
            length = own;
        }
    }
    return length;
}

/* Share of the last step in this one, if it goes about the same way; 0 if not. */
static modeler_real straight(const modeler_closure *loops, const modeler_workspace *w)
{
    modeler_real own = MODELER_REAL(0.0), last = MODELER_REAL(0.0), both = MODELER_REAL(0.0);

    if (!w->kept->bent) {
        return MODELER_REAL(0.0);
    }
    for (int j = 0; j < loops->given; j++) {
        const modeler_real scale = loops->scale[loops->given_places[j]];
        const modeler_real x = w->change[j] / scale, y = w->last[j] / scale;
        own += x * x;
        last += y * y;
        both += x * y;
    }
    if (!(last > MODELER_REAL(0.0)) ||
        own * last - both * both > STRAIGHT * STRAIGHT * own * last) {
        return MODELER_REAL(0.0);
    }
    return both / last;
}

/* Puts w->trial a share of the way ahead. A whole step bends like the one before: its second order
 * is half the change of the tangent. */
static void advance(const modeler_closure *loops, modeler_workspace *w, const modeler_real *q,
                    modeler_real share)
{
    const modeler_real more = share >= MODELER_REAL(1.0) ? straight(loops, w) : MODELER_REAL(0.0);

    for (int j = 0; j < loops->solved; j++) {
        const int k = loops->solved_places[j];
        const modeler_real bend = MODELER_REAL(0.5) * more * (w->along[j] - more * w->bend[j]);
        w->trial[k] = w->start[k] + share * w->along[j] + bend;
    }
    for (int j = 0; j < loops->given; j++) {
        const int k = loops->given_places[j];
        w->trial[k] = share >= MODELER_REAL(1.0) ? q[j] : w->start[k] + share * w->change[j];
    }
}

/* The step is done: the next one may bend like it. */
static void remember(const modeler_closure *loops, modeler_workspace *w, modeler_real share)
{
    for (int j = 0; j < loops->solved; j++) {
        w->bend[j] = share * w->along[j];
    }
    for (int j = 0; j < loops->given; j++) {
        w->last[j] = share * w->change[j];
    }
    w->kept->bent = 1;
}

/* A share of the way; 1 if the loops are closed at its end, in the same assembly mode. */
static int stepped(const modeler_closure *loops, modeler_workspace *w, const modeler_real *q,
                   modeler_real share, modeler_real length)
{
    const modeler_real allowed = MODELER_REAL(0.5) * share * length + INEXACT;

    advance(loops, w, q, share);
    if (!w->brief && !neared(loops, w, allowed, share * length)) {
        advance(loops, w, q, share);
    }
    return corrected(loops, w, allowed) && alike(loops, w) && closed(loops, w);
}

/* From w->trial, whose values and factors are at hand, to q. */
static int walk(const modeler_closure *loops, modeler_workspace *w, const modeler_real *q,
                modeler_real *u)
{
    modeler_real share = MODELER_REAL(1.0);

    w->kept->valid = 0;
    do {
        const modeler_real length = arrive(loops, w, q);

        if (!isfinite(length)) {
            return MODELER_UNFINISHED;
        }
        share = modeler_fmin(MODELER_REAL(1.0), MODELER_REAL(2.0) * share);
        if (share * length > STEP) {
            share = STEP / length;
        }
        while (!stepped(loops, w, q, share, length)) {
            share *= MODELER_REAL(0.5);
            if (w->left <= 0) {
                return MODELER_UNFINISHED;
            }
            if (share < MODELER_SHORTEST) {
                return MODELER_OPEN;
            }
        }
        remember(loops, w, share);
    } while (share < MODELER_REAL(1.0));
    for (int k = 0; k < loops->unknowns; k++) {
        u[k] = w->trial[k];
    }
    w->kept->valid = 1;
    w->kept->at = w->at;
    return MODELER_CLOSED;
}

int modeler_close(const modeler_closure *loops, const modeler_real *q, const modeler_real *start,
                  modeler_real *u, const modeler_work *work)
{
    static const modeler_kept nothing = {0, 0, 0, 0, 0, {0, 0}};
    modeler_workspace w;

    *work->kept = nothing;
    if (!modeler_finite(q, loops->given) ||
        !modeler_finite(start, loops->unknowns)) {
        return MODELER_NOT_FINITE;
    }
    w = modeler_parts(loops, work);
    for (int j = 0; j < loops->solved; j++) {
        w.bend[j] = MODELER_REAL(0.0);
    }
    for (int j = 0; j < loops->solved; j++) {
        w.share[j] = MODELER_REAL(1.0) / loops->scale[loops->solved_places[j]];
    }
    for (int k = 0; k < loops->unknowns; k++) {
        w.trial[k] = start[k];
    }
    if (!corrected(loops, &w, INEXACT)) {
        if (w.left <= 0) {
            return MODELER_UNFINISHED;
        }
        return modeler_factors(loops, &w, w.at) ? MODELER_OPEN : MODELER_SINGULAR;
    }
    return walk(loops, &w, q, u);
}

static int next(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                const modeler_work *work, int brief)
{
    modeler_workspace w = modeler_parts(loops, work);
    int moved = 0;

    w.brief = brief;
    if (!modeler_finite(q, loops->given)) {
        return MODELER_NOT_FINITE;
    }
    if (!w.kept->valid) {
        return MODELER_OPEN;
    }
    for (int j = 0; j < loops->given; j++) {
        moved |= !(q[j] == w.trial[loops->given_places[j]]);
    }
    if (moved != 0) {
        return walk(loops, &w, q, u);
    }
    for (int k = 0; k < loops->unknowns; k++) {
        u[k] = w.trial[k];
    }
    return MODELER_CLOSED;
}

int modeler_close_next(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                       const modeler_work *work)
{
    return next(loops, q, u, work, 0);
}

int modeler_close_soon(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                       const modeler_work *work)
{
    return next(loops, q, u, work, 1);
}
