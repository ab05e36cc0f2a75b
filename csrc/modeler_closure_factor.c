/* Factors of the loops' equations, and what is solved with them; see modeler_closure.h. */
#include "modeler_workspace.h"

#include <math.h>

static modeler_real *take(modeler_real **numbers, int length)
{
    modeler_real *const part = *numbers;

    *numbers += length;
    return part;
}

modeler_workspace modeler_parts(const modeler_closure *loops, const modeler_work *work)
{
    const int n = loops->unknowns, m = loops->solved;
    modeler_real *numbers = work->numbers;
    modeler_workspace w;

    w.kept = work->kept;
    for (int k = 0; k < 2; k++) {
        w.order[k] = work->places + k * m;
        w.values[k] = take(&numbers, loops->length);
        w.lu[k] = take(&numbers, loops->factors);
        w.dense[k] = take(&numbers, m * m);
        w.norm[k] = take(&numbers, m);
    }
    w.places = work->places + 2 * m;
    w.step = take(&numbers, m);
    w.right = take(&numbers, m);
    w.along = take(&numbers, m);
    w.bend = take(&numbers, m);
    w.share = take(&numbers, m);
    w.coupled = take(&numbers, m * (n - m));
    w.whole = take(&numbers, n);
    w.change = take(&numbers, n);
    w.last = take(&numbers, n);
    w.trial = take(&numbers, n);
    w.start = take(&numbers, n);
    w.at = w.kept->at;
    w.left = MODELER_EVALUATIONS;
    w.brief = 0;
    return w;
}

const modeler_real *modeler_jacobian(const modeler_closure *loops, const modeler_workspace *w,
                                     int at)
{
    return w->values[at] + loops->equations + loops->alignments;
}

/* Dense factors of the solved columns; 0 if they are singular. */
static int pivoted(const modeler_closure *loops, const modeler_workspace *w, int at)
{
    const int m = loops->solved;
    const modeler_real *J = modeler_jacobian(loops, w, at);
    modeler_real *const lu = w->dense[at], *const norm = w->norm[at];
    int *const order = w->order[at];
    modeler_real largest = MODELER_REAL(0.0);

    for (int k = 0; k < loops->unknowns; k++)
        w->places[k] = -1;
    for (int j = 0; j < m; j++)
        w->places[loops->solved_places[j]] = j;
    for (int i = 0; i < m; i++) {
        norm[i] = MODELER_REAL(0.0);
        order[i] = i;
    }
    for (int k = 0; k < m * m; k++)
        lu[k] = MODELER_REAL(0.0);
    for (int k = 0; k < loops->nonzeros; k++) {
        const int place = w->places[loops->column[k]];
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
            const int row = order[j];
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

int modeler_factors(const modeler_closure *loops, const modeler_workspace *w, int at)
{
    int small = 0;

    loops->factor(modeler_jacobian(loops, w, at), w->lu[at]);
    for (int j = 0; j < loops->solved; j++)
        small |= !(modeler_fabs(w->lu[at][j]) <= loops->limits[j]);
    w->kept->dense[at] = small;
    return !small || pivoted(loops, w, at);
}

void modeler_solution(const modeler_closure *loops, const modeler_workspace *w, int at,
                  const modeler_real *right, modeler_real *x)
{
    const int m = loops->solved;
    const modeler_real *const lu = w->dense[at];

    if (!w->kept->dense[at]) {
        loops->solve(w->lu[at], right, x);
        return;
    }
    for (int i = 0; i < m; i++) {
        const int row = w->order[at][i];
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

/* Nonzeros of G in solved rows, where the elimination is sparse. */
static const modeler_real *coupled(const modeler_closure *loops, const modeler_workspace *w)
{
    if (!w->kept->coupled)
        loops->coupling(modeler_jacobian(loops, w, w->at), w->lu[w->at], w->coupled);
    w->kept->coupled = 1;
    return w->coupled;
}

void modeler_coupling(const modeler_closure *loops, modeler_real *G, const modeler_work *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const modeler_workspace w = modeler_parts(loops, work);
    const modeler_real *const J = modeler_jacobian(loops, &w, w.at);

    for (int k = 0; k < n * g; k++)
        G[k] = MODELER_REAL(0.0);
    for (int j = 0; j < g; j++)
        G[loops->given_places[j] * g + j] = MODELER_REAL(1.0);
    if (!w.kept->dense[w.at]) {
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
        modeler_solution(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++)
            G[loops->solved_places[i] * g + j] = w.step[i];
    }
}

void modeler_drift(const modeler_closure *loops, modeler_drift_function drift,
                   const modeler_real *u, const modeler_real *G, const modeler_real *qd,
                   modeler_real *ud, modeler_real *gamma, const modeler_work *work)
{
    const int n = loops->unknowns, g = loops->given;
    const modeler_workspace w = modeler_parts(loops, work);

    for (int k = 0; k < n; k++) {
        ud[k] = gamma[k] = MODELER_REAL(0.0);
        for (int j = 0; j < g; j++)
            ud[k] += G[k * g + j] * qd[j];
    }
    drift(u, ud, w.right);
    modeler_solution(loops, &w, w.at, w.right, w.step);
    for (int i = 0; i < loops->solved; i++)
        gamma[loops->solved_places[i]] = -w.step[i];
}

void modeler_accelerations(const modeler_closure *loops, const modeler_real *G,
                           const modeler_real *gamma, const modeler_real *qdd, modeler_real *udd)
{
    const int g = loops->given;

    for (int k = 0; k < loops->unknowns; k++) {
        udd[k] = MODELER_REAL(0.0);
        for (int j = 0; j < g; j++)
            udd[k] += G[k * g + j] * qdd[j];
        udd[k] += gamma[k];
    }
}

static modeler_real widest(const modeler_closure *loops, const modeler_real *x)
{
    modeler_real found = MODELER_REAL(0.0);

    for (int k = 0; k < loops->unknowns; k++)
        if (modeler_fabs(x[k]) / loops->scale[k] > found)
            found = modeler_fabs(x[k]) / loops->scale[k];
    return found;
}

/* The drift is a square of the speeds, d/dt(J) v a product of two of them: by polarisation, with
 * speeds v of the size of ud, so that no digits are lost. */
void modeler_coupling_rate(const modeler_closure *loops, modeler_drift_function drift,
                           const modeler_real *u, const modeler_real *G, const modeler_real *ud,
                           modeler_real *rate, const modeler_work *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const modeler_workspace w = modeler_parts(loops, work);
    const modeler_real speed = widest(loops, ud);

    for (int k = 0; k < n * g; k++)
        rate[k] = MODELER_REAL(0.0);
    for (int j = 0; j < g && speed > MODELER_REAL(0.0); j++) {
        modeler_real size;

        for (int k = 0; k < n; k++)
            w.start[k] = G[k * g + j];
        size = widest(loops, w.start) / speed;
        for (int k = 0; k < n; k++)
            w.whole[k] = ud[k] + w.start[k] / size;
        drift(u, w.whole, w.along);
        for (int k = 0; k < n; k++)
            w.whole[k] = ud[k] - w.start[k] / size;
        drift(u, w.whole, w.right);
        for (int i = 0; i < m; i++)
            w.right[i] = MODELER_REAL(0.25) * size * (w.right[i] - w.along[i]);
        modeler_solution(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++)
            rate[loops->solved_places[i] * g + j] = w.step[i];
    }
}

int modeler_eliminated(const modeler_closure *loops, const modeler_work *work,
                       const modeler_real **values, const modeler_real **lu, const modeler_real **G)
{
    const modeler_workspace w = modeler_parts(loops, work);

    if (w.kept->dense[w.at])
        return 0;
    *values = w.values[w.at];
    *lu = w.lu[w.at];
    *G = coupled(loops, &w);
    return 1;
}

void modeler_project_more(const modeler_closure *loops, const modeler_real *G,
                          const modeler_real *rows, int width, modeler_real factor,
                          modeler_real *out)
{
    const int g = loops->given;

    for (int k = 0; k < loops->unknowns; k++)
        for (int j = 0; j < g; j++) {
            const modeler_real share = factor * G[k * g + j];
            if (share != MODELER_REAL(0.0))
                for (int c = 0; c < width; c++)
                    out[j * width + c] += share * rows[k * width + c];
        }
}

void modeler_project(const modeler_closure *loops, const modeler_real *G, const modeler_real *rows,
                     int width, modeler_real *out)
{
    for (int k = 0; k < loops->given * width; k++)
        out[k] = MODELER_REAL(0.0);
    modeler_project_more(loops, G, rows, width, MODELER_REAL(1.0), out);
}

void modeler_apply_more(const modeler_real *A, int rows, int inner, const modeler_real *x,
                        int width, modeler_real *out)
{
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < inner; k++) {
            const modeler_real share = A[i * inner + k];
            if (share != MODELER_REAL(0.0))
                for (int c = 0; c < width; c++)
                    out[i * width + c] += share * x[k * width + c];
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
