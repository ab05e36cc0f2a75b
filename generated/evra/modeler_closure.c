/* Closing loops by Newton along a path; see modeler_closure.h. */
#include "modeler_closure.h"

#include <math.h>

#define STEP 0.3          /* longest change of a variable in one step, in its scale */
#define SHORTEST 1e-7     /* share of the way; where shorter steps fail too, the way ends */
#define EVALUATIONS 1000  /* of the equations, at most */
#define NEWTON 12         /* corrections of one step, at most */
#define CONVERGED 1e-8    /* a correction after which the error is its square */
#define FLAT 1e-11        /* pivots below this share of the largest are zero */
#define INEXACT 1e-3      /* how far from closed a start may be, in its scale */
#define TURNED 0.5        /* |J^-1 J' - 1| from the start of a step to its end, at most */

/* Factors of the solved columns of a Jacobian, rows and columns scaled. */
typedef struct {
    double *lu;
    double *norm;  /* of the rows */
    double *order; /* of the rows */
} factors;

/* The parts of `work`. */
typedef struct {
    double *values; /* residuals and Jacobian */
    factors at;     /* where they were evaluated last */
    factors first;  /* where a step starts */
    double *step;
    double *along;  /* tangent at the start of a step: of the solved variables, scaled */
    double *change; /* of the given variables that is left there */
    double *trial;  /* posture */
    double *start;  /* of a step: posture */
    double *check;  /* all equations, and the alignments */
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

    w.values = take(&work, m + m * n);
    w.at.lu = take(&work, m * m);
    w.at.norm = take(&work, m);
    w.at.order = take(&work, m);
    w.first.lu = take(&work, m * m);
    w.first.norm = take(&work, m);
    w.first.order = take(&work, m);
    w.step = take(&work, m);
    w.along = take(&work, m);
    w.change = take(&work, n);
    w.trial = take(&work, n);
    w.start = take(&work, n);
    w.check = work;
    return w;
}

/* Factors of the solved columns of the Jacobian at hand; 0 if they are singular. */
static int factor(const modeler_closure *loops, const workspace *w)
{
    const int n = loops->unknowns, m = loops->solved;
    const double *J = w->values + m;
    double *const lu = w->at.lu;
    double largest = 0.0;

    for (int i = 0; i < m; i++) {
        double sum = 0.0;
        for (int k = 0; k < n; k++)
            sum += J[i * n + k] * J[i * n + k] * loops->scale[k] * loops->scale[k];
        w->at.norm[i] = sqrt(sum);
        if (!(w->at.norm[i] > 0.0))
            return 0;
        for (int j = 0; j < m; j++) {
            const int k = loops->solved_places[j];
            lu[i * m + j] = J[i * n + k] * loops->scale[k] / w->at.norm[i];
        }
        w->at.order[i] = (double)i;
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
            const double row = w->at.order[j];
            w->at.order[j] = w->at.order[pivot];
            w->at.order[pivot] = row;
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

/* x with J_solved x = right, in scaled variables; right in the order of the equations. */
static void solve(int m, const factors *f, const double *right, int stride, double *x)
{
    for (int i = 0; i < m; i++) {
        const int row = (int)f->order[i];
        x[i] = right[row * stride] / f->norm[row];
        for (int k = 0; k < i; k++)
            x[i] -= f->lu[i * m + k] * x[k];
    }
    for (int i = m - 1; i >= 0; i--) {
        for (int k = i + 1; k < m; k++)
            x[i] -= f->lu[i * m + k] * x[k];
        x[i] /= f->lu[i * m + i];
    }
}

static double largest(const double *x, int n)
{
    double found = 0.0;

    for (int i = 0; i < n; i++)
        if (!(fabs(x[i]) <= found))
            found = fabs(x[i]);
    return found;
}

/* Newton on w->trial with the given variables held. 1 if it contracts, within a move of `allowed`;
 * values and factors are then those there. */
static int corrected(const modeler_closure *loops, workspace *w, double allowed, int *evaluations)
{
    const int m = loops->solved;
    double before = 0.0;

    for (int round = 0; round < NEWTON; round++) {
        loops->equations(w->trial, w->values);
        ++*evaluations;
        if (!factor(loops, w))
            return 0;
        solve(m, &w->at, w->values, 1, w->step);
        const double size = largest(w->step, m);
        if (!(size <= allowed) || (round > 0 && size > CONVERGED && !(size <= 0.5 * before)))
            return 0;
        for (int j = 0; j < m; j++) {
            const int k = loops->solved_places[j];
            w->trial[k] -= w->step[j] * loops->scale[k];
        }
        if (size <= CONVERGED)
            return 1;
        before = size;
    }
    return 0;
}

/* 1 if every loop is closed at w->trial, redundant equations and directions of axes included. */
static int closed(const modeler_closure *loops, const workspace *w)
{
    loops->residual(w->trial, w->check);
    for (int i = 0; i < loops->residuals; i++)
        if (!(fabs(w->check[i]) <= loops->tolerance))
            return 0;
    for (int i = 0; i < loops->alignments; i++)
        if (!(w->check[loops->residuals + i] > 0.0))
            return 0;
    return 1;
}

/* 1 if the Jacobian has turned so little since the start of the step that it was singular nowhere
 * between: |J^-1 J' - 1| stays below 1 on the straight way from J to J'. */
static int alike(const modeler_closure *loops, const workspace *w)
{
    const int n = loops->unknowns, m = loops->solved;
    double sum = 0.0;

    for (int j = 0; j < m; j++) {
        const int k = loops->solved_places[j];
        solve(m, &w->first, w->values + m + k, n, w->step);
        for (int i = 0; i < m; i++) {
            const double x = w->step[i] * loops->scale[k] - (i == j ? 1.0 : 0.0);
            sum += x * x;
        }
    }
    return sum <= TURNED * TURNED;
}

/* The posture w->trial is where the next step starts, straight to q; gives its length, in scales. */
static double arrive(const modeler_closure *loops, workspace *w, const double *q)
{
    const int n = loops->unknowns, m = loops->solved;
    const double *J = w->values + m;
    const factors at = w->at;
    double length;

    for (int k = 0; k < n; k++)
        w->start[k] = w->trial[k];
    for (int j = 0; j < loops->given; j++)
        w->change[j] = q[j] - w->start[loops->given_places[j]];
    for (int i = 0; i < m; i++) {
        double sum = 0.0;
        for (int j = 0; j < loops->given; j++)
            sum -= J[i * n + loops->given_places[j]] * w->change[j];
        w->values[i] = sum;
    }
    solve(m, &at, w->values, 1, w->along);
    w->at = w->first;
    w->first = at;
    length = largest(w->along, m);
    for (int j = 0; j < loops->given; j++) {
        const double own = fabs(w->change[j]) / loops->scale[loops->given_places[j]];
        if (!(own <= length))
            length = own;
    }
    return length;
}

/* Puts w->trial a share of the way ahead. */
static void advance(const modeler_closure *loops, workspace *w, const double *q, double share)
{
    for (int j = 0; j < loops->solved; j++) {
        const int k = loops->solved_places[j];
        w->trial[k] = w->start[k] + share * w->along[j] * loops->scale[k];
    }
    for (int j = 0; j < loops->given; j++) {
        const int k = loops->given_places[j];
        w->trial[k] = share >= 1.0 ? q[j] : w->start[k] + share * w->change[j];
    }
}

int modeler_close(const modeler_closure *loops, const double *q, const double *start, double *u,
                  double *work)
{
    workspace w = parts(loops, work);
    double share = 1.0;
    int evaluations = 0;

    for (int k = 0; k < loops->unknowns; k++)
        w.trial[k] = start[k];
    if (!corrected(loops, &w, INEXACT, &evaluations))
        return factor(loops, &w) ? MODELER_OPEN : MODELER_SINGULAR;
    for (;;) {
        const double length = arrive(loops, &w, q);

        if (!isfinite(length))
            return MODELER_UNFINISHED;
        share = fmin(1.0, 2.0 * share);
        if (share * length > STEP)
            share = STEP / length;
        for (;;) {
            advance(loops, &w, q, share);
            if (corrected(loops, &w, 0.5 * share * length + INEXACT, &evaluations)
                && alike(loops, &w) && closed(loops, &w))
                break;
            share *= 0.5;
            if (share < SHORTEST || evaluations > EVALUATIONS)
                return MODELER_OPEN;
        }
        if (share >= 1.0)
            break;
    }
    for (int k = 0; k < loops->unknowns; k++)
        u[k] = w.trial[k];
    return MODELER_CLOSED;
}

/* G from factors at hand; J stays in w->values. */
static void coupling(const modeler_closure *loops, workspace *w, double *G)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const double *J = w->values + m;

    for (int k = 0; k < n * g; k++)
        G[k] = 0.0;
    for (int j = 0; j < g; j++) {
        G[loops->given_places[j] * g + j] = 1.0;
        for (int i = 0; i < m; i++)
            w->values[i] = -J[i * n + loops->given_places[j]];
        solve(m, &w->at, w->values, 1, w->step);
        for (int i = 0; i < m; i++) {
            const int k = loops->solved_places[i];
            G[k * g + j] = w->step[i] * loops->scale[k];
        }
    }
}

int modeler_coupling(const modeler_closure *loops, const double *u, double *G, double *work)
{
    workspace w = parts(loops, work);

    loops->equations(u, w.values);
    if (!factor(loops, &w))
        return MODELER_SINGULAR;
    coupling(loops, &w, G);
    return MODELER_CLOSED;
}

int modeler_follow(const modeler_closure *loops,
                   void (*drift)(const double *u, const double *ud, double *values),
                   const double *u, const double *qd, const double *qdd, double *G, double *ud,
                   double *udd, double *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    workspace w = parts(loops, work);

    loops->equations(u, w.values);
    if (!factor(loops, &w))
        return MODELER_SINGULAR;
    coupling(loops, &w, G);
    for (int k = 0; k < n; k++) {
        ud[k] = udd[k] = 0.0;
        for (int j = 0; j < g; j++) {
            ud[k] += G[k * g + j] * qd[j];
            udd[k] += G[k * g + j] * qdd[j];
        }
    }
    drift(u, ud, w.values);
    solve(m, &w.at, w.values, 1, w.step);
    for (int i = 0; i < m; i++) {
        const int k = loops->solved_places[i];
        udd[k] -= w.step[i] * loops->scale[k];
    }
    return MODELER_CLOSED;
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

void modeler_nothing(double *out, size_t length)
{
    for (size_t i = 0; i < length; i++)
        out[i] = NAN;
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
