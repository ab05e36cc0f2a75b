/* Closing loops by Newton along a path; see modeler_closure.h. */
#include "modeler_closure.h"

#include <math.h>

#define STEP     MODELER_REAL(0.3) /* longest change of a variable in one step, in its scale */
#define NEWTON   12                /* corrections of one step, at most */
#define POLISHED 2 /* corrections after CONVERGED, at most: rounding may be above EXACT */
#define INEXACT  MODELER_REAL(1e-3) /* how far from closed a start may be, in its scale */
#define TURNED   MODELER_REAL(0.5)  /* |J^-1 J' - 1| from the start of a step to its end, at most */
#define TURNING  MODELER_REAL(4.0)  /* about that, per length of a step */
#define NEAR MODELER_REAL(0.05) /* length of a step, or contraction, up to which old factors do */
#define STRAIGHT                                                                                   \
    MODELER_REAL(0.1) /* how far from the last direction a step may be to bend like it */

/* What `kept` holds: 1 or 0; PLACE: which of two; DENSE: of either. */
enum { VALID, PLACE, BENT, COUPLED, DENSE, KEPT = 8 };

/* The parts of `work`. There are two places for values and factors: where a step starts, and where
 * it has come. */
typedef struct {
    modeler_real *kept;
    modeler_real *values[2];
    modeler_real *lu[2];
    modeler_real *dense[2]; /* factors with rows exchanged, rows and columns scaled */
    modeler_real *norm[2];  /* of the rows */
    modeler_real *order[2]; /* of the rows */
    modeler_real *step;     /* of the solved variables, as all below */
    modeler_real *right;
    modeler_real *along;   /* tangent of a step, to its end */
    modeler_real *bend;    /* what the last step was along its tangent */
    modeler_real *share;   /* 1/scale */
    modeler_real *whole;   /* of all variables: a change */
    modeler_real *change;  /* of the given variables that is left at the start of a step */
    modeler_real *last;    /* what the last step changed of them */
    modeler_real *trial;   /* posture */
    modeler_real *start;   /* of a step: posture */
    modeler_real *coupled; /* nonzeros of G in solved rows */
    int at;                /* place of the values of the trial posture */
    int left;              /* evaluations */
} workspace;

static modeler_real *take(modeler_real **work, int length)
{
    modeler_real *const part = *work;

    *work += length;
    return part;
}

static workspace parts(const modeler_closure *loops, modeler_real *work)
{
    const int n = loops->unknowns, m = loops->solved;
    workspace w;

    w.kept = take(&work, KEPT);
    for (int k = 0; k < 2; k++) {
        w.values[k] = take(&work, loops->length);
        w.lu[k] = take(&work, loops->factors);
        w.dense[k] = take(&work, m * m);
        w.norm[k] = take(&work, m);
        w.order[k] = take(&work, m);
    }
    w.step = take(&work, m);
    w.right = take(&work, m);
    w.along = take(&work, m);
    w.bend = take(&work, m);
    w.share = take(&work, m);
    w.coupled = take(&work, m * (n - m));
    w.whole = take(&work, n);
    w.change = take(&work, n);
    w.last = take(&work, n);
    w.trial = take(&work, n);
    w.start = take(&work, n);
    w.at = w.kept[PLACE] > MODELER_REAL(0.0);
    w.left = MODELER_EVALUATIONS;
    return w;
}

static const modeler_real *jacobian(const modeler_closure *loops, const workspace *w, int k)
{
    return w->values[k] + loops->equations + loops->alignments;
}

/* Dense factors of the solved columns; 0 if they are singular. */
static int pivoted(const modeler_closure *loops, const workspace *w, int at)
{
    const int m = loops->solved;
    const modeler_real *J = jacobian(loops, w, at);
    modeler_real *const lu = w->dense[at], *const norm = w->norm[at], *const order = w->order[at];
    modeler_real largest = MODELER_REAL(0.0);

    for (int k = 0; k < loops->unknowns; k++)
        w->whole[k] = -MODELER_REAL(1.0);
    for (int j = 0; j < m; j++)
        w->whole[loops->solved_places[j]] = (modeler_real)j;
    for (int i = 0; i < m; i++) {
        norm[i] = MODELER_REAL(0.0);
        order[i] = (modeler_real)i;
    }
    for (int k = 0; k < m * m; k++)
        lu[k] = MODELER_REAL(0.0);
    for (int k = 0; k < loops->nonzeros; k++) {
        const int place = (int)w->whole[loops->column[k]];
        const modeler_real value = J[k] * loops->scale[loops->column[k]];
        norm[loops->row[k]] += value * value;
        if (place >= 0)
            lu[loops->row[k] * m + place] = value;
    }
    for (int i = 0; i < m; i++) {
        norm[i] = modeler_sqrt(norm[i]);
        if (!(norm[i] > MODELER_REAL(0.0)))
            return 0;
        for (int j = 0; j < m; j++)
            lu[i * m + j] /= norm[i];
    }
    for (int j = 0; j < m; j++) {
        int pivot = j;
        for (int i = j + 1; i < m; i++)
            if (modeler_fabs(lu[i * m + j]) > modeler_fabs(lu[pivot * m + j]))
                pivot = i;
        if (modeler_fabs(lu[pivot * m + j]) > largest)
            largest = modeler_fabs(lu[pivot * m + j]);
        if (!(modeler_fabs(lu[pivot * m + j]) > MODELER_FLAT * largest))
            return 0;
        if (pivot != j) {
            const modeler_real row = order[j];
            order[j] = order[pivot];
            order[pivot] = row;
            for (int k = 0; k < m; k++) {
                const modeler_real value = lu[j * m + k];
                lu[j * m + k] = lu[pivot * m + k];
                lu[pivot * m + k] = value;
            }
        }
        for (int i = j + 1; i < m; i++) {
            const modeler_real share = lu[i * m + j] / lu[j * m + j];
            lu[i * m + j] = share;
            for (int k = j + 1; k < m; k++)
                lu[i * m + k] -= share * lu[j * m + k];
        }
    }
    return 1;
}

/* Factors of the solved columns of the Jacobian at hand; 0 if they are singular. */
static int factor(const modeler_closure *loops, const workspace *w, int at)
{
    int small = 0;

    loops->factor(jacobian(loops, w, at), w->lu[at]);
    for (int j = 0; j < loops->solved; j++)
        small |= !(modeler_fabs(w->lu[at][j]) <= loops->limits[j]);
    w->kept[DENSE + at] = (modeler_real)small;
    return !small || pivoted(loops, w, at);
}

/* x with J_solved x = right; right in the order of the equations. */
static void solve(const modeler_closure *loops, const workspace *w, int at,
                  const modeler_real *right, modeler_real *x)
{
    const int m = loops->solved;
    const modeler_real *const lu = w->dense[at];

    if (!(w->kept[DENSE + at] > MODELER_REAL(0.0))) {
        loops->solve(w->lu[at], right, x);
        return;
    }
    for (int i = 0; i < m; i++) {
        const int row = (int)w->order[at][i];
        x[i] = right[row] / w->norm[at][row];
        for (int k = 0; k < i; k++)
            x[i] -= lu[i * m + k] * x[k];
    }
    for (int i = m - 1; i >= 0; i--) {
        for (int k = i + 1; k < m; k++)
            x[i] -= lu[i * m + k] * x[k];
        x[i] /= lu[i * m + i];
    }
    for (int i = 0; i < m; i++)
        x[i] *= loops->scale[loops->solved_places[i]];
}

/* Largest change of a solved variable, in its scale. */
static modeler_real largest(const modeler_closure *loops, const workspace *w, const modeler_real *x)
{
    modeler_real found = MODELER_REAL(0.0);

    for (int j = 0; j < loops->solved; j++) {
        const modeler_real size = modeler_fabs(x[j]) * w->share[j];
        if (size > found || isnan(size))
            found = size;
    }
    return found;
}

/* Takes the step from w->trial. */
static void correct(const modeler_closure *loops, const workspace *w)
{
    for (int j = 0; j < loops->solved; j++)
        w->trial[loops->solved_places[j]] -= w->step[j];
}

/* 1 if a correction is not within `allowed`, or does not contract from the one before. */
static int diverges(modeler_real size, modeler_real before, int round, modeler_real allowed)
{
    return !(size <= allowed) ||
           (round > 0 && size > MODELER_CONVERGED && !(size <= MODELER_REAL(0.5) * before));
}

/* Newton on w->trial with the given variables held. 1 if it contracts, within a move of `allowed`;
 * values and factors are then those there. */
static int corrected(const modeler_closure *loops, workspace *w, modeler_real allowed)
{
    modeler_real before = MODELER_REAL(0.0);
    int polished = 0;

    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->closure(w->trial, w->values[w->at]);
        if (!factor(loops, w, w->at))
            return 0;
        solve(loops, w, w->at, w->values[w->at], w->step);
        const modeler_real size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed))
            return 0;
        if (size <= MODELER_EXACT || (size <= MODELER_CONVERGED && polished++ >= POLISHED))
            return 1;
        correct(loops, w);
        before = size;
    }
    return 0;
}

/* The same with the factors where the step of that length starts, as long as these contract well; 0
 * if it does not contract. */
static int neared(const modeler_closure *loops, workspace *w, modeler_real allowed,
                  modeler_real length)
{
    modeler_real before = MODELER_REAL(0.0);

    if (length > NEAR)
        return 1;
    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->residual(w->trial, w->right);
        solve(loops, w, 1 - w->at, w->right, w->step);
        const modeler_real size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed))
            return 0;
        correct(loops, w);
        const modeler_real rate = round > 0 ? size / before : TURNING * length;
        if (!(size * rate > MODELER_REAL(0.1) * MODELER_EXACT) || (round > 0 && rate > NEAR))
            return 1;
        before = size;
    }
    return 1;
}

/* 1 if every loop is closed at w->trial, redundant equations and directions of axes included. */
static int closed(const modeler_closure *loops, const workspace *w)
{
    const modeler_real *const f = w->values[w->at], *const cosine = f + loops->equations;

    for (int i = 0; i < loops->equations; i++)
        if (!(modeler_fabs(f[i]) <= loops->tolerance))
            return 0;
    for (int i = 0; i < loops->alignments; i++)
        if (!(cosine[i] > MODELER_REAL(0.0)))
            return 0;
    return 1;
}

/* |J^-1 J' - 1|^2 from the start of the step, where pivoting was dense. */
static modeler_real spread(const modeler_closure *loops, const workspace *w)
{
    const int m = loops->solved;
    const modeler_real *const J = jacobian(loops, w, w->at);
    modeler_real sum = MODELER_REAL(0.0);

    for (int j = 0; j < m; j++) {
        const int k = loops->solved_places[j];
        for (int i = 0; i < m; i++)
            w->right[i] = MODELER_REAL(0.0);
        for (int i = 0; i < loops->nonzeros; i++)
            if (loops->column[i] == k)
                w->right[loops->row[i]] = J[i];
        solve(loops, w, 1 - w->at, w->right, w->step);
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
static int alike(const modeler_closure *loops, const workspace *w)
{
    const int first = 1 - w->at;
    const modeler_real *const J = jacobian(loops, w, first), *const K = jacobian(loops, w, w->at);
    modeler_real sum = MODELER_REAL(0.0);

    if (w->kept[DENSE + first] > MODELER_REAL(0.0))
        return spread(loops, w) <= TURNED * TURNED;
    loops->turned(J, K, w->lu[first], w->step);
    for (int j = 0; j < loops->solved; j++)
        sum += w->step[j] * w->step[j];
    if (!(sum <= TURNED * TURNED))
        loops->spread(J, K, w->lu[first], &sum);
    return sum <= TURNED * TURNED;
}

/* The tangent, from G at hand. */
static void along_coupling(const modeler_closure *loops, const workspace *w)
{
    for (int k = 0; k < loops->unknowns; k++)
        w->whole[k] = MODELER_REAL(0.0);
    for (int k = 0; k < loops->couplings; k++)
        w->whole[loops->coupling_row[k]] += w->coupled[k] * w->change[loops->coupling_column[k]];
    for (int j = 0; j < loops->solved; j++)
        w->along[j] = w->whole[loops->solved_places[j]];
}

/* The tangent, from the factors. */
static void along_solution(const modeler_closure *loops, const workspace *w)
{
    const modeler_real *const J = jacobian(loops, w, w->at);

    for (int k = 0; k < loops->unknowns; k++)
        w->whole[k] = MODELER_REAL(0.0);
    for (int j = 0; j < loops->given; j++)
        w->whole[loops->given_places[j]] = w->change[j];
    for (int i = 0; i < loops->solved; i++)
        w->right[i] = MODELER_REAL(0.0);
    for (int k = 0; k < loops->nonzeros; k++)
        w->right[loops->row[k]] -= J[k] * w->whole[loops->column[k]];
    solve(loops, w, w->at, w->right, w->along);
}

/* The posture w->trial is where the next step starts, straight to q; gives its length, in scales:
 * infinite where more steps would be needed than evaluations are left. */
static modeler_real arrive(const modeler_closure *loops, workspace *w, const modeler_real *q)
{
    modeler_real length;

    for (int k = 0; k < loops->unknowns; k++)
        w->start[k] = w->trial[k];
    for (int j = 0; j < loops->given; j++)
        w->change[j] = q[j] - w->start[loops->given_places[j]];
    if (w->kept[COUPLED] > MODELER_REAL(0.0))
        along_coupling(loops, w);
    else
        along_solution(loops, w);
    w->kept[COUPLED] = MODELER_REAL(0.0);
    w->at = 1 - w->at;
    length = largest(loops, w, w->along);
    for (int j = 0; j < loops->given; j++) {
        const modeler_real own = modeler_fabs(w->change[j]) / loops->scale[loops->given_places[j]];
        if (own > STEP * (modeler_real)w->left)
            return INFINITY;
        if (own > length || isnan(own))
            length = own;
    }
    return length;
}

/* Share of the last step in this one, if it goes about the same way; 0 if not. */
static modeler_real straight(const modeler_closure *loops, const workspace *w)
{
    modeler_real own = MODELER_REAL(0.0), last = MODELER_REAL(0.0), both = MODELER_REAL(0.0);

    if (!(w->kept[BENT] > MODELER_REAL(0.0)))
        return MODELER_REAL(0.0);
    for (int j = 0; j < loops->given; j++) {
        const modeler_real scale = loops->scale[loops->given_places[j]];
        const modeler_real x = w->change[j] / scale, y = w->last[j] / scale;
        own += x * x;
        last += y * y;
        both += x * y;
    }
    if (!(last > MODELER_REAL(0.0)) || own * last - both * both > STRAIGHT * STRAIGHT * own * last)
        return MODELER_REAL(0.0);
    return both / last;
}

/* Puts w->trial a share of the way ahead. A whole step bends like the one before: its second order
 * is half the change of the tangent. */
static void advance(const modeler_closure *loops, workspace *w, const modeler_real *q,
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
static void remember(const modeler_closure *loops, workspace *w, modeler_real share)
{
    for (int j = 0; j < loops->solved; j++)
        w->bend[j] = share * w->along[j];
    for (int j = 0; j < loops->given; j++)
        w->last[j] = share * w->change[j];
    w->kept[BENT] = MODELER_REAL(1.0);
}

/* A share of the way; 1 if the loops are closed at its end, in the same assembly mode. */
static int stepped(const modeler_closure *loops, workspace *w, const modeler_real *q,
                   modeler_real share, modeler_real length)
{
    const modeler_real allowed = MODELER_REAL(0.5) * share * length + INEXACT;

    advance(loops, w, q, share);
    if (!neared(loops, w, allowed, share * length))
        advance(loops, w, q, share);
    return corrected(loops, w, allowed) && alike(loops, w) && closed(loops, w);
}

/* From w->trial, whose values and factors are at hand, to q. */
static int walk(const modeler_closure *loops, workspace *w, const modeler_real *q, modeler_real *u)
{
    modeler_real share = MODELER_REAL(1.0);

    w->kept[VALID] = MODELER_REAL(0.0);
    do {
        const modeler_real length = arrive(loops, w, q);

        if (!isfinite(length))
            return MODELER_UNFINISHED;
        share = modeler_fmin(MODELER_REAL(1.0), MODELER_REAL(2.0) * share);
        if (share * length > STEP)
            share = STEP / length;
        while (!stepped(loops, w, q, share, length)) {
            share *= MODELER_REAL(0.5);
            if (w->left <= 0)
                return MODELER_UNFINISHED;
            if (share < MODELER_SHORTEST)
                return MODELER_OPEN;
        }
        remember(loops, w, share);
    } while (share < MODELER_REAL(1.0));
    for (int k = 0; k < loops->unknowns; k++)
        u[k] = w->trial[k];
    w->kept[VALID] = MODELER_REAL(1.0);
    w->kept[PLACE] = (modeler_real)w->at;
    return MODELER_CLOSED;
}

int modeler_close(const modeler_closure *loops, const modeler_real *q, const modeler_real *start,
                  modeler_real *u, modeler_real *work)
{
    workspace w;

    for (int k = 0; k < KEPT; k++)
        work[k] = MODELER_REAL(0.0);
    if (!modeler_finite(q, (size_t)loops->given) || !modeler_finite(start, (size_t)loops->unknowns))
        return MODELER_NOT_FINITE;
    w = parts(loops, work);
    for (int j = 0; j < loops->solved; j++)
        w.bend[j] = MODELER_REAL(0.0);
    for (int j = 0; j < loops->solved; j++)
        w.share[j] = MODELER_REAL(1.0) / loops->scale[loops->solved_places[j]];
    for (int k = 0; k < loops->unknowns; k++)
        w.trial[k] = start[k];
    if (!corrected(loops, &w, INEXACT))
        return factor(loops, &w, w.at) ? MODELER_OPEN : MODELER_SINGULAR;
    return walk(loops, &w, q, u);
}

int modeler_close_next(const modeler_closure *loops, const modeler_real *q, modeler_real *u,
                       modeler_real *work)
{
    workspace w = parts(loops, work);
    int moved = 0;

    if (!modeler_finite(q, (size_t)loops->given))
        return MODELER_NOT_FINITE;
    if (!(w.kept[VALID] > MODELER_REAL(0.0)))
        return MODELER_OPEN;
    for (int j = 0; j < loops->given; j++)
        moved |= !(q[j] == w.trial[loops->given_places[j]]);
    if (moved)
        return walk(loops, &w, q, u);
    for (int k = 0; k < loops->unknowns; k++)
        u[k] = w.trial[k];
    return MODELER_CLOSED;
}

/* Nonzeros of G in solved rows, where the elimination is sparse. */
static const modeler_real *coupled(const modeler_closure *loops, const workspace *w)
{
    if (!(w->kept[COUPLED] > MODELER_REAL(0.0)))
        loops->coupling(jacobian(loops, w, w->at), w->lu[w->at], w->coupled);
    w->kept[COUPLED] = MODELER_REAL(1.0);
    return w->coupled;
}

void modeler_coupling(const modeler_closure *loops, modeler_real *G, modeler_real *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const workspace w = parts(loops, work);
    const modeler_real *const J = jacobian(loops, &w, w.at);

    for (int k = 0; k < n * g; k++)
        G[k] = MODELER_REAL(0.0);
    for (int j = 0; j < g; j++)
        G[loops->given_places[j] * g + j] = MODELER_REAL(1.0);
    if (!(w.kept[DENSE + w.at] > MODELER_REAL(0.0))) {
        const modeler_real *const values = coupled(loops, &w);
        for (int k = 0; k < loops->couplings; k++)
            G[loops->coupling_row[k] * g + loops->coupling_column[k]] = values[k];
        return;
    }
    for (int j = 0; j < g; j++) {
        for (int i = 0; i < m; i++)
            w.right[i] = MODELER_REAL(0.0);
        for (int k = 0; k < loops->nonzeros; k++)
            if (loops->column[k] == loops->given_places[j])
                w.right[loops->row[k]] = -J[k];
        solve(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++)
            G[loops->solved_places[i] * g + j] = w.step[i];
    }
}

void modeler_follow(const modeler_closure *loops,
                    void (*drift)(const modeler_real *u, const modeler_real *ud,
                                  modeler_real *values),
                    const modeler_real *u, const modeler_real *qd, const modeler_real *qdd,
                    modeler_real *G, modeler_real *ud, modeler_real *udd, modeler_real *work)
{
    const int n = loops->unknowns, g = loops->given;
    const workspace w = parts(loops, work);

    modeler_coupling(loops, G, work);
    for (int k = 0; k < n; k++) {
        ud[k] = udd[k] = MODELER_REAL(0.0);
        for (int j = 0; j < g; j++) {
            ud[k] += G[k * g + j] * qd[j];
            udd[k] += G[k * g + j] * qdd[j];
        }
    }
    drift(u, ud, w.right);
    solve(loops, &w, w.at, w.right, w.step);
    for (int i = 0; i < loops->solved; i++)
        udd[loops->solved_places[i]] -= w.step[i];
}

int modeler_eliminated(const modeler_closure *loops, modeler_real *work,
                       const modeler_real **values, const modeler_real **lu, const modeler_real **G)
{
    const workspace w = parts(loops, work);

    if (w.kept[DENSE + w.at] > MODELER_REAL(0.0))
        return 0;
    *values = w.values[w.at];
    *lu = w.lu[w.at];
    *G = coupled(loops, &w);
    return 1;
}

void modeler_project(const modeler_closure *loops, const modeler_real *G, const modeler_real *rows,
                     int width, modeler_real *out)
{
    const int g = loops->given;

    for (int k = 0; k < g * width; k++)
        out[k] = MODELER_REAL(0.0);
    for (int k = 0; k < loops->unknowns; k++)
        for (int j = 0; j < g; j++) {
            const modeler_real share = G[k * g + j];
            if (share != MODELER_REAL(0.0))
                for (int c = 0; c < width; c++)
                    out[j * width + c] += share * rows[k * width + c];
        }
}

int modeler_finite(const modeler_real *x, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (!isfinite(x[i]))
            return 0;
    return 1;
}

int modeler_told(int status, modeler_real *out, size_t length)
{
    if (status == MODELER_CLOSED && !modeler_finite(out, length))
        status = MODELER_NOT_FINITE;
    for (size_t i = 0; i < length && status != MODELER_CLOSED; i++)
        out[i] = NAN;
    return status;
}
