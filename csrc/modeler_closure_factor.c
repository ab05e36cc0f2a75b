/* Factors and solution of the loops' equations; see modeler_closure.h. */
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
    w.left = work->evaluations;
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

    for (int k = 0; k < loops->unknowns; k++) {
        w->places[k] = -1;
    }
    for (int j = 0; j < m; j++) {
        w->places[loops->solved_places[j]] = j;
    }
    for (int i = 0; i < m; i++) {
        norm[i] = MODELER_REAL(0.0);
        order[i] = i;
    }
    for (int k = 0; k < m * m; k++) {
        lu[k] = MODELER_REAL(0.0);
    }
    for (int k = 0; k < loops->nonzeros; k++) {
        const int place = w->places[loops->column[k]];
        const modeler_real value = J[k] * loops->scale[loops->column[k]];
        norm[loops->row[k]] += value * value;
        if (place >= 0) {
            lu[loops->row[k] * m + place] = value;
        }
    }
    for (int i = 0; i < m; i++) {
        norm[i] = modeler_sqrt(norm[i]);
        if (!(norm[i] > MODELER_REAL(0.0))) {
            return 0;
        }
        for (int j = 0; j < m; j++) {
            lu[i * m + j] /= norm[i];
        }
    }
    for (int j = 0; j < m; j++) {
        int pivot = j;
        for (int i = j + 1; i < m; i++) {
            if (modeler_fabs(lu[i * m + j]) > modeler_fabs(lu[pivot * m + j])) {
                pivot = i;
            }
        }
        if (modeler_fabs(lu[pivot * m + j]) > largest) {
            largest = modeler_fabs(lu[pivot * m + j]);
        }
        if (!(modeler_fabs(lu[pivot * m + j]) > MODELER_FLAT * largest)) {
            return 0;
        }
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
            for (int k = j + 1; k < m; k++) {
                lu[i * m + k] -= share * lu[j * m + k];
            }
        }
    }
    return 1;
}

int modeler_factors(const modeler_closure *loops, const modeler_workspace *w, int at)
{
    int small = 0;

    loops->factor(modeler_jacobian(loops, w, at), w->lu[at]);
    for (int j = 0; j < loops->solved; j++) {
        small |= !(modeler_fabs(w->lu[at][j]) <= loops->limits[j]);
    }
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
        for (int k = 0; k < i; k++) {
            x[i] -= lu[i * m + k] * x[k];
        }
    }
    for (int i = m - 1; i >= 0; i--) {
        for (int k = i + 1; k < m; k++) {
            x[i] -= lu[i * m + k] * x[k];
        }
        x[i] /= lu[i * m + i];
    }
    for (int i = 0; i < m; i++) {
        x[i] *= loops->scale[loops->solved_places[i]];
    }
}
