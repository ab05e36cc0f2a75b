/* Closing loops by Newton along a path; see modeler_closure.h. */
#include "modeler_closure.h"

#include <math.h>

#define STEP 0.3          /* longest change of a solved variable in one step, in its scale */
#define SHORTEST 1e-7     /* share of the way; where shorter steps fail too, the way ends */
#define EVALUATIONS 600   /* of the equations, at most */
#define NEWTON 12         /* corrections of one step, at most */
#define CONVERGED 1e-8    /* a correction after which the error is its square */
#define FLAT 1e-11        /* pivots below this share of the largest are zero */
#define INEXACT 1e-3     /* how far from closed a start may be, in its scale */

/* The parts of `work`. */
typedef struct {
    double *values;  /* residuals and Jacobian */
    double *lu;      /* of the solved columns, rows and columns scaled */
    double *norm;    /* of the rows */
    double *order;   /* of the rows */
    double *step;
    double *change;
    double *trial;   /* posture */
    double *first;   /* posture at the start of a step */
    double sign;     /* of the determinant */
} workspace;

static workspace parts(const modeler_closure *loops, double *work)
{
    const int n = loops->unknowns, m = loops->solved;
    workspace w;

    w.values = work;
    w.lu = w.values + m + m * n;
    w.norm = w.lu + m * m;
    w.order = w.norm + m;
    w.step = w.order + m;
    w.change = w.step + m;
    w.trial = w.change + n;
    w.first = w.trial + n;
    w.sign = 0.0;
    return w;
}

/* Factors of the solved columns of the Jacobian; 0 if they are singular. */
static int factor(const modeler_closure *loops, workspace *w)
{
    const int n = loops->unknowns, m = loops->solved;
    const double *J = w->values + m;
    double largest = 0.0;

    w->sign = 1.0;
    for (int i = 0; i < m; i++) {
        double sum = 0.0;
        for (int k = 0; k < n; k++)
            sum += J[i * n + k] * J[i * n + k] * loops->scale[k] * loops->scale[k];
        w->norm[i] = sqrt(sum);
        if (!(w->norm[i] > 0.0))
            return 0;
        for (int j = 0; j < m; j++) {
            const int k = loops->solved_places[j];
            w->lu[i * m + j] = J[i * n + k] * loops->scale[k] / w->norm[i];
        }
        w->order[i] = (double)i;
    }
    for (int j = 0; j < m; j++) {
        int pivot = j;
        for (int i = j + 1; i < m; i++)
            if (fabs(w->lu[i * m + j]) > fabs(w->lu[pivot * m + j]))
                pivot = i;
        if (fabs(w->lu[pivot * m + j]) > largest)
            largest = fabs(w->lu[pivot * m + j]);
        if (!(fabs(w->lu[pivot * m + j]) > FLAT * largest))
            return 0;
        if (pivot != j) {
            const double row = w->order[j];
            w->order[j] = w->order[pivot];
            w->order[pivot] = row;
            for (int k = 0; k < m; k++) {
                const double value = w->lu[j * m + k];
                w->lu[j * m + k] = w->lu[pivot * m + k];
                w->lu[pivot * m + k] = value;
            }
            w->sign = -w->sign;
        }
        if (w->lu[j * m + j] < 0.0)
            w->sign = -w->sign;
        for (int i = j + 1; i < m; i++) {
            const double share = w->lu[i * m + j] / w->lu[j * m + j];
            w->lu[i * m + j] = share;
            for (int k = j + 1; k < m; k++)
                w->lu[i * m + k] -= share * w->lu[j * m + k];
        }
    }
    return 1;
}

/* x with J_solved x = right, in scaled variables; right in the order of the equations. */
static void solve(const modeler_closure *loops, const workspace *w, const double *right, double *x)
{
    const int m = loops->solved;

    for (int i = 0; i < m; i++) {
        const int row = (int)w->order[i];
        x[i] = right[row] / w->norm[row];
        for (int k = 0; k < i; k++)
            x[i] -= w->lu[i * m + k] * x[k];
    }
    for (int i = m - 1; i >= 0; i--) {
        for (int k = i + 1; k < m; k++)
            x[i] -= w->lu[i * m + k] * x[k];
        x[i] /= w->lu[i * m + i];
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

/* Newton on w->trial with the given variables held; the residuals there are evaluated already.
 * 1 if it contracts to a closed posture of the same sign, within a move of `allowed`. */
static int corrected(const modeler_closure *loops, workspace *w, double sign, double allowed,
                     int *evaluations)
{
    const int m = loops->solved;
    double before = 0.0;

    for (int round = 0; round < NEWTON; round++) {
        loops->equations(w->trial, w->values);
        ++*evaluations;
        if (!factor(loops, w) || w->sign != sign)
            return 0;
        solve(loops, w, w->values, w->step);
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

/* Scaled change of the solved variables for the change of the given ones in w->change. */
static void predict(const modeler_closure *loops, workspace *w)
{
    const int n = loops->unknowns, m = loops->solved;
    const double *J = w->values + m;

    for (int i = 0; i < m; i++) {
        double sum = 0.0;
        for (int j = 0; j < loops->given; j++)
            sum -= J[i * n + loops->given_places[j]] * w->change[j];
        w->values[i] = sum;
    }
    solve(loops, w, w->values, w->step);
}

int modeler_close(const modeler_closure *loops, const double *q, const double *start, double *u,
                  double *work)
{
    const int n = loops->unknowns, m = loops->solved;
    workspace w = parts(loops, work);
    double share = 1.0;
    int evaluations = 1;

    for (int k = 0; k < n; k++)
        w.first[k] = start[k];
    loops->equations(w.first, w.values);
    if (!factor(loops, &w))
        return MODELER_SINGULAR;
    const double sign = w.sign;
    for (;;) {
        double move;
        int last;

        for (int j = 0; j < loops->given; j++)
            w.change[j] = q[j] - w.first[loops->given_places[j]];
        predict(loops, &w);
        move = largest(w.step, m);
        for (int j = 0; j < loops->given; j++) {
            const double own = fabs(w.change[j]) / loops->scale[loops->given_places[j]];
            if (!(own <= move))
                move = own;
        }
        if (!isfinite(move))
            return MODELER_UNFINISHED;
        if (share * move > STEP)
            share = STEP / move;
        last = share >= 1.0;
        for (int k = 0; k < n; k++)
            w.trial[k] = w.first[k];
        for (int j = 0; j < m; j++) {
            const int k = loops->solved_places[j];
            w.trial[k] += share * w.step[j] * loops->scale[k];
        }
        for (int j = 0; j < loops->given; j++) {
            const int k = loops->given_places[j];
            w.trial[k] = last ? q[j] : w.first[k] + share * w.change[j];
        }
        if (corrected(loops, &w, sign, 0.5 * share * move + INEXACT, &evaluations)) {
            for (int k = 0; k < n; k++)
                w.first[k] = w.trial[k];
            if (last)
                break;
            share *= 2.0;
            if (share > 1.0)
                share = 1.0;
        } else {
            share *= 0.5;
            if (share < SHORTEST)
                return MODELER_OPEN;
        }
        if (evaluations > EVALUATIONS)
            return MODELER_OPEN;
        loops->equations(w.first, w.values);
        evaluations++;
        if (!factor(loops, &w))
            return MODELER_SINGULAR;
    }
    for (int k = 0; k < n; k++)
        u[k] = w.first[k];
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
        solve(loops, w, w->values, w->step);
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
    solve(loops, &w, w.values, w.step);
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
