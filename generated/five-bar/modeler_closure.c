/* Closing loops by Newton along a path; see modeler_closure.h. */
#include "modeler_closure.h"

#include <math.h>

#define STEP 0.3          /* longest change of a variable in one step, in its scale */
#define SHORTEST 1e-7     /* share of the way; where shorter steps fail too, the way ends */
#define NEWTON 12         /* corrections of one step, at most */
#define CONVERGED 1e-8    /* a correction after which the error is its square */
#define EXACT 1e-14       /* a correction that is not worth making */
#define POLISHED 2        /* corrections after CONVERGED, at most: rounding may be above EXACT */
#define FLAT 1e-11        /* pivots below this share of the largest are zero */
#define INEXACT 1e-3      /* how far from closed a start may be, in its scale */
#define TURNED 0.5        /* |J^-1 J' - 1| from the start of a step to its end, at most */
#define TURNING 4.0       /* about that, per length of a step */
#define NEAR 0.05         /* length of a step, or contraction, up to which old factors do */
#define STRAIGHT 0.1      /* how far from the last direction a step may be to bend like it */

/* What `kept` holds: 1 or 0; PLACE: which of two; DENSE: of either. */
enum { VALID, PLACE, BENT, COUPLED, DENSE, KEPT = 8 };

/* The parts of `work`. There are two places for values and factors: where a step starts, and where
 * it has come. */
typedef struct {
    double *kept;
    double *values[2];
    double *lu[2];
    double *dense[2]; /* factors with rows exchanged, rows and columns scaled */
    double *norm[2];  /* of the rows */
    double *order[2]; /* of the rows */
    double *step;     /* of the solved variables, as all below */
    double *right;
    double *along; /* tangent of a step, to its end */
    double *bend;  /* what the last step was along its tangent */
    double *share; /* 1/scale */
    double *whole; /* of all variables: a change */
    double *change; /* of the given variables that is left at the start of a step */
    double *last;   /* what the last step changed of them */
    double *trial;  /* posture */
    double *start;  /* of a step: posture */
    double *coupled; /* nonzeros of G in solved rows */
    int at;         /* place of the values of the trial posture */
    int left;       /* evaluations */
} workspace;

static double *take(double **work, int length)
{
    double *const part = *work;

    *work += length;
    return part;
}

static workspace parts(const modeler_closure *loops, double *work)
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
    w.at = w.kept[PLACE] > 0.0;
    w.left = MODELER_EVALUATIONS;
    return w;
}

static const double *jacobian(const modeler_closure *loops, const workspace *w, int k)
{
    return w->values[k] + loops->equations + loops->alignments;
}

/* Dense factors of the solved columns; 0 if they are singular. */
static int pivoted(const modeler_closure *loops, const workspace *w, int at)
{
    const int m = loops->solved;
    const double *J = jacobian(loops, w, at);
    double *const lu = w->dense[at], *const norm = w->norm[at], *const order = w->order[at];
    double largest = 0.0;

    for (int k = 0; k < loops->unknowns; k++)
        w->whole[k] = -1.0;
    for (int j = 0; j < m; j++)
        w->whole[loops->solved_places[j]] = (double)j;
    for (int i = 0; i < m; i++) {
        norm[i] = 0.0;
        order[i] = (double)i;
    }
    for (int k = 0; k < m * m; k++)
        lu[k] = 0.0;
    for (int k = 0; k < loops->nonzeros; k++) {
        const int place = (int)w->whole[loops->column[k]];
        const double value = J[k] * loops->scale[loops->column[k]];
        norm[loops->row[k]] += value * value;
        if (place >= 0)
            lu[loops->row[k] * m + place] = value;
    }
    for (int i = 0; i < m; i++) {
        norm[i] = sqrt(norm[i]);
        if (!(norm[i] > 0.0))
            return 0;
        for (int j = 0; j < m; j++)
            lu[i * m + j] /= norm[i];
    }
    for (int j = 0; j < m; j++) {
        int pivot = j;
        for (int i = j + 1; i < m; i++)
            if (fabs(lu[i * m + j]) > fabs(lu[pivot * m + j]))
                pivot = i;
        if (fabs(lu[pivot * m + j]) > largest)
            largest = fabs(lu[pivot * m + j]);
        if (!(fabs(lu[pivot * m + j]) > FLAT * largest))
            return 0;
        if (pivot != j) {
            const double row = order[j];
            order[j] = order[pivot];
            order[pivot] = row;
            for (int k = 0; k < m; k++) {
                const double value = lu[j * m + k];
                lu[j * m + k] = lu[pivot * m + k];
                lu[pivot * m + k] = value;
            }
        }
        for (int i = j + 1; i < m; i++) {
            const double share = lu[i * m + j] / lu[j * m + j];
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
        small |= !(fabs(w->lu[at][j]) <= loops->limits[j]);
    w->kept[DENSE + at] = (double)small;
    return !small || pivoted(loops, w, at);
}

/* x with J_solved x = right; right in the order of the equations. */
static void solve(const modeler_closure *loops, const workspace *w, int at, const double *right,
                  double *x)
{
    const int m = loops->solved;
    const double *const lu = w->dense[at];

    if (!(w->kept[DENSE + at] > 0.0)) {
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
static double largest(const modeler_closure *loops, const workspace *w, const double *x)
{
    double found = 0.0;

    for (int j = 0; j < loops->solved; j++) {
        const double size = fabs(x[j]) * w->share[j];
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
static int diverges(double size, double before, int round, double allowed)
{
    return !(size <= allowed) || (round > 0 && size > CONVERGED && !(size <= 0.5 * before));
}

/* Newton on w->trial with the given variables held. 1 if it contracts, within a move of `allowed`;
 * values and factors are then those there. */
static int corrected(const modeler_closure *loops, workspace *w, double allowed)
{
    double before = 0.0;
    int polished = 0;

    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->closure(w->trial, w->values[w->at]);
        if (!factor(loops, w, w->at))
            return 0;
        solve(loops, w, w->at, w->values[w->at], w->step);
        const double size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed))
            return 0;
        if (size <= EXACT || (size <= CONVERGED && polished++ >= POLISHED))
            return 1;
        correct(loops, w);
        before = size;
    }
    return 0;
}

/* The same with the factors where the step of that length starts, as long as these contract well; 0
 * if it does not contract. */
static int neared(const modeler_closure *loops, workspace *w, double allowed, double length)
{
    double before = 0.0;

    if (length > NEAR)
        return 1;
    for (int round = 0; round < NEWTON && w->left-- > 0; round++) {
        loops->residual(w->trial, w->right);
        solve(loops, w, 1 - w->at, w->right, w->step);
        const double size = largest(loops, w, w->step);
        if (diverges(size, before, round, allowed))
            return 0;
        correct(loops, w);
        const double rate = round > 0 ? size / before : TURNING * length;
        if (!(size * rate > 0.1 * EXACT) || (round > 0 && rate > NEAR))
            return 1;
        before = size;
    }
    return 1;
}

/* 1 if every loop is closed at w->trial, redundant equations and directions of axes included. */
static int closed(const modeler_closure *loops, const workspace *w)
{
    const double *const f = w->values[w->at], *const cosine = f + loops->equations;

    for (int i = 0; i < loops->equations; i++)
        if (!(fabs(f[i]) <= loops->tolerance))
            return 0;
    for (int i = 0; i < loops->alignments; i++)
        if (!(cosine[i] > 0.0))
            return 0;
    return 1;
}

/* |J^-1 J' - 1|^2 from the start of the step, where pivoting was dense. */
static double spread(const modeler_closure *loops, const workspace *w)
{
    const int m = loops->solved;
    const double *const J = jacobian(loops, w, w->at);
    double sum = 0.0;

    for (int j = 0; j < m; j++) {
        const int k = loops->solved_places[j];
        for (int i = 0; i < m; i++)
            w->right[i] = 0.0;
        for (int i = 0; i < loops->nonzeros; i++)
            if (loops->column[i] == k)
                w->right[loops->row[i]] = J[i];
        solve(loops, w, 1 - w->at, w->right, w->step);
        for (int i = 0; i < m; i++) {
            const double x = w->step[i] * w->share[i] * loops->scale[k] - (i == j ? 1.0 : 0.0);
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
    const double *const J = jacobian(loops, w, first), *const K = jacobian(loops, w, w->at);
    double sum = 0.0;

    if (w->kept[DENSE + first] > 0.0)
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
        w->whole[k] = 0.0;
    for (int k = 0; k < loops->couplings; k++)
        w->whole[loops->coupling_row[k]] += w->coupled[k] * w->change[loops->coupling_column[k]];
    for (int j = 0; j < loops->solved; j++)
        w->along[j] = w->whole[loops->solved_places[j]];
}

/* The tangent, from the factors. */
static void along_solution(const modeler_closure *loops, const workspace *w)
{
    const double *const J = jacobian(loops, w, w->at);

    for (int k = 0; k < loops->unknowns; k++)
        w->whole[k] = 0.0;
    for (int j = 0; j < loops->given; j++)
        w->whole[loops->given_places[j]] = w->change[j];
    for (int i = 0; i < loops->solved; i++)
        w->right[i] = 0.0;
    for (int k = 0; k < loops->nonzeros; k++)
        w->right[loops->row[k]] -= J[k] * w->whole[loops->column[k]];
    solve(loops, w, w->at, w->right, w->along);
}

/* The posture w->trial is where the next step starts, straight to q; gives its length, in scales:
 * infinite where more steps would be needed than evaluations are left. */
static double arrive(const modeler_closure *loops, workspace *w, const double *q)
{
    double length;

    for (int k = 0; k < loops->unknowns; k++)
        w->start[k] = w->trial[k];
    for (int j = 0; j < loops->given; j++)
        w->change[j] = q[j] - w->start[loops->given_places[j]];
    if (w->kept[COUPLED] > 0.0)
        along_coupling(loops, w);
    else
        along_solution(loops, w);
    w->kept[COUPLED] = 0.0;
    w->at = 1 - w->at;
    length = largest(loops, w, w->along);
    for (int j = 0; j < loops->given; j++) {
        const double own = fabs(w->change[j]) / loops->scale[loops->given_places[j]];
        if (own > STEP * (double)w->left)
            return INFINITY;
        if (own > length || isnan(own))
            length = own;
    }
    return length;
}

/* Share of the last step in this one, if it goes about the same way; 0 if not. */
static double straight(const modeler_closure *loops, const workspace *w)
{
    double own = 0.0, last = 0.0, both = 0.0;

    if (!(w->kept[BENT] > 0.0))
        return 0.0;
    for (int j = 0; j < loops->given; j++) {
        const double scale = loops->scale[loops->given_places[j]];
        const double x = w->change[j] / scale, y = w->last[j] / scale;
        own += x * x;
        last += y * y;
        both += x * y;
    }
    if (!(last > 0.0) || own * last - both * both > STRAIGHT * STRAIGHT * own * last)
        return 0.0;
    return both / last;
}

/* Puts w->trial a share of the way ahead. A whole step bends like the one before: its second order
 * is half the change of the tangent. */
static void advance(const modeler_closure *loops, workspace *w, const double *q, double share)
{
    const double more = share >= 1.0 ? straight(loops, w) : 0.0;

    for (int j = 0; j < loops->solved; j++) {
        const int k = loops->solved_places[j];
        const double bend = 0.5 * more * (w->along[j] - more * w->bend[j]);
        w->trial[k] = w->start[k] + share * w->along[j] + bend;
    }
    for (int j = 0; j < loops->given; j++) {
        const int k = loops->given_places[j];
        w->trial[k] = share >= 1.0 ? q[j] : w->start[k] + share * w->change[j];
    }
}

/* The step is done: the next one may bend like it. */
static void remember(const modeler_closure *loops, workspace *w, double share)
{
    for (int j = 0; j < loops->solved; j++)
        w->bend[j] = share * w->along[j];
    for (int j = 0; j < loops->given; j++)
        w->last[j] = share * w->change[j];
    w->kept[BENT] = 1.0;
}

/* A share of the way; 1 if the loops are closed at its end, in the same assembly mode. */
static int stepped(const modeler_closure *loops, workspace *w, const double *q, double share,
                   double length)
{
    const double allowed = 0.5 * share * length + INEXACT;

    advance(loops, w, q, share);
    if (!neared(loops, w, allowed, share * length))
        advance(loops, w, q, share);
    return corrected(loops, w, allowed) && alike(loops, w) && closed(loops, w);
}

/* From w->trial, whose values and factors are at hand, to q. */
static int walk(const modeler_closure *loops, workspace *w, const double *q, double *u)
{
    double share = 1.0;

    w->kept[VALID] = 0.0;
    do {
        const double length = arrive(loops, w, q);

        if (!isfinite(length))
            return MODELER_UNFINISHED;
        share = fmin(1.0, 2.0 * share);
        if (share * length > STEP)
            share = STEP / length;
        while (!stepped(loops, w, q, share, length)) {
            share *= 0.5;
            if (w->left <= 0)
                return MODELER_UNFINISHED;
            if (share < SHORTEST)
                return MODELER_OPEN;
        }
        remember(loops, w, share);
    } while (share < 1.0);
    for (int k = 0; k < loops->unknowns; k++)
        u[k] = w->trial[k];
    w->kept[VALID] = 1.0;
    w->kept[PLACE] = (double)w->at;
    return MODELER_CLOSED;
}

int modeler_close(const modeler_closure *loops, const double *q, const double *start, double *u,
                  double *work)
{
    workspace w;

    for (int k = 0; k < KEPT; k++)
        work[k] = 0.0;
    if (!modeler_finite(q, (size_t)loops->given) || !modeler_finite(start, (size_t)loops->unknowns))
        return MODELER_NOT_FINITE;
    w = parts(loops, work);
    for (int j = 0; j < loops->solved; j++)
        w.bend[j] = 0.0;
    for (int j = 0; j < loops->solved; j++)
        w.share[j] = 1.0 / loops->scale[loops->solved_places[j]];
    for (int k = 0; k < loops->unknowns; k++)
        w.trial[k] = start[k];
    if (!corrected(loops, &w, INEXACT))
        return factor(loops, &w, w.at) ? MODELER_OPEN : MODELER_SINGULAR;
    return walk(loops, &w, q, u);
}

int modeler_close_next(const modeler_closure *loops, const double *q, double *u, double *work)
{
    workspace w = parts(loops, work);
    int moved = 0;

    if (!modeler_finite(q, (size_t)loops->given))
        return MODELER_NOT_FINITE;
    if (!(w.kept[VALID] > 0.0))
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
static const double *coupled(const modeler_closure *loops, const workspace *w)
{
    if (!(w->kept[COUPLED] > 0.0))
        loops->coupling(jacobian(loops, w, w->at), w->lu[w->at], w->coupled);
    w->kept[COUPLED] = 1.0;
    return w->coupled;
}

void modeler_coupling(const modeler_closure *loops, double *G, double *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const workspace w = parts(loops, work);
    const double *const J = jacobian(loops, &w, w.at);

    for (int k = 0; k < n * g; k++)
        G[k] = 0.0;
    for (int j = 0; j < g; j++)
        G[loops->given_places[j] * g + j] = 1.0;
    if (!(w.kept[DENSE + w.at] > 0.0)) {
        const double *const values = coupled(loops, &w);
        for (int k = 0; k < loops->couplings; k++)
            G[loops->coupling_row[k] * g + loops->coupling_column[k]] = values[k];
        return;
    }
    for (int j = 0; j < g; j++) {
        for (int i = 0; i < m; i++)
            w.right[i] = 0.0;
        for (int k = 0; k < loops->nonzeros; k++)
            if (loops->column[k] == loops->given_places[j])
                w.right[loops->row[k]] = -J[k];
        solve(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++)
            G[loops->solved_places[i] * g + j] = w.step[i];
    }
}

void modeler_follow(const modeler_closure *loops,
                    void (*drift)(const double *u, const double *ud, double *values),
                    const double *u, const double *qd, const double *qdd, double *G, double *ud,
                    double *udd, double *work)
{
    const int n = loops->unknowns, g = loops->given;
    const workspace w = parts(loops, work);

    modeler_coupling(loops, G, work);
    for (int k = 0; k < n; k++) {
        ud[k] = udd[k] = 0.0;
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

int modeler_eliminated(const modeler_closure *loops, double *work, const double **values,
                       const double **lu, const double **G)
{
    const workspace w = parts(loops, work);

    if (w.kept[DENSE + w.at] > 0.0)
        return 0;
    *values = w.values[w.at];
    *lu = w.lu[w.at];
    *G = coupled(loops, &w);
    return 1;
}

void modeler_project(const modeler_closure *loops, const double *G, const double *rows, int width,
                     double *out)
{
    const int g = loops->given;

    for (int k = 0; k < g * width; k++)
        out[k] = 0.0;
    for (int k = 0; k < loops->unknowns; k++)
        for (int j = 0; j < g; j++) {
            const double share = G[k * g + j];
            if (share != 0.0)
                for (int c = 0; c < width; c++)
                    out[j * width + c] += share * rows[k * width + c];
        }
}

int modeler_finite(const double *x, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (!isfinite(x[i]))
            return 0;
    return 1;
}

int modeler_told(int status, double *out, size_t length)
{
    if (status == MODELER_CLOSED && !modeler_finite(out, length))
        status = MODELER_NOT_FINITE;
    for (size_t i = 0; i < length && status != MODELER_CLOSED; i++)
        out[i] = NAN;
    return status;
}

/* Values of input `which` at sample i. */
#define AT(which) (inputs[which].data + i * inputs[which].step)

void modeler_batch_status_1(modeler_status_1 function, size_t samples,
                            const modeler_input inputs[1], double *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++)
        status[i] = function(AT(0), out + i * out_step);
}

void modeler_batch_status_2(modeler_status_2 function, size_t samples,
                            const modeler_input inputs[2], double *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++)
        status[i] = function(AT(0), AT(1), out + i * out_step);
}

void modeler_batch_status_3(modeler_status_3 function, size_t samples,
                            const modeler_input inputs[3], double *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++)
        status[i] = function(AT(0), AT(1), AT(2), out + i * out_step);
}

void modeler_batch_status_4(modeler_status_4 function, size_t samples,
                            const modeler_input inputs[4], double *out, size_t out_step,
                            int *status)
{
    for (size_t i = 0; i < samples; i++)
        status[i] = function(AT(0), AT(1), AT(2), AT(3), out + i * out_step);
}
