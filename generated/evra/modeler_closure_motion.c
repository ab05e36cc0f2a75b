/* The coupling of closed loops, and what it carries over; see modeler_closure.h. */
#include "modeler_workspace.h"

#include <math.h>

/* Nonzeros of G in solved rows, where the elimination is sparse. */
static const modeler_real *coupled(const modeler_closure *loops, const modeler_workspace *w)
{
    if (!w->kept->coupled) {
        loops->coupling(modeler_jacobian(loops, w, w->at), w->lu[w->at], w->coupled);
    }
    w->kept->coupled = 1;
    return w->coupled;
}

void modeler_coupling(const modeler_closure *loops, modeler_real *G, const modeler_work *work)
{
    const int n = loops->unknowns, m = loops->solved, g = loops->given;
    const modeler_workspace w = modeler_parts(loops, work);
    const modeler_real *const J = modeler_jacobian(loops, &w, w.at);

    for (int k = 0; k < n * g; k++) {
        G[k] = MODELER_REAL(0.0);
    }
    for (int j = 0; j < g; j++) {
        G[loops->given_places[j] * g + j] = MODELER_REAL(1.0);
    }
    if (!w.kept->dense[w.at]) {
        const modeler_real *const values = coupled(loops, &w);
        for (int k = 0; k < loops->couplings; k++) {
            G[loops->coupling_row[k] * g + loops->coupling_column[k]] = values[k];
        }
        return;
    }
    for (int j = 0; j < g; j++) {
        for (int i = 0; i < m; i++) {
            w.right[i] = MODELER_REAL(0.0);
        }
        for (int k = 0; k < loops->nonzeros; k++) {
            if (loops->column[k] == loops->given_places[j]) {
                w.right[loops->row[k]] = -J[k];
            }
        }
        modeler_solution(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++) {
            G[loops->solved_places[i] * g + j] = w.step[i];
        }
    }
}

void modeler_drift(const modeler_closure *loops, modeler_drift_function drift,
                   const modeler_real *u, const modeler_real *G, const modeler_real *qd,
                   modeler_real *ud, modeler_real *gamma, const modeler_work *work)
{
    const int n = loops->unknowns, g = loops->given;
    const modeler_workspace w = modeler_parts(loops, work);

    for (int k = 0; k < n; k++) {
        ud[k] = MODELER_REAL(0.0);
        gamma[k] = MODELER_REAL(0.0);
        for (int j = 0; j < g; j++) {
            ud[k] += G[k * g + j] * qd[j];
        }
    }
    drift(u, ud, w.right);
    modeler_solution(loops, &w, w.at, w.right, w.step);
    for (int i = 0; i < loops->solved; i++) {
        gamma[loops->solved_places[i]] = -w.step[i];
    }
}

void modeler_accelerations(const modeler_closure *loops, const modeler_real *G,
                           const modeler_real *gamma, const modeler_real *qdd, modeler_real *udd)
{
    const int g = loops->given;

    for (int k = 0; k < loops->unknowns; k++) {
        udd[k] = MODELER_REAL(0.0);
        for (int j = 0; j < g; j++) {
            udd[k] += G[k * g + j] * qdd[j];
        }
        udd[k] += gamma[k];
    }
}

static modeler_real widest(const modeler_closure *loops, const modeler_real *x)
{
    modeler_real found = MODELER_REAL(0.0);

    for (int k = 0; k < loops->unknowns; k++) {
        if (modeler_fabs(x[k]) / loops->scale[k] > found) {
            found = modeler_fabs(x[k]) / loops->scale[k];
        }
    }
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

    for (int k = 0; k < n * g; k++) {
        rate[k] = MODELER_REAL(0.0);
    }
    for (int j = 0; j < g && speed > MODELER_REAL(0.0); j++) {
        modeler_real size;

        for (int k = 0; k < n; k++) {
            w.start[k] = G[k * g + j];
        }
        size = widest(loops, w.start) / speed;
        for (int k = 0; k < n; k++) {
            w.whole[k] = ud[k] + w.start[k] / size;
        }
        drift(u, w.whole, w.along);
        for (int k = 0; k < n; k++) {
            w.whole[k] = ud[k] - w.start[k] / size;
        }
        drift(u, w.whole, w.right);
        for (int i = 0; i < m; i++) {
            w.right[i] = MODELER_REAL(0.25) * size * (w.right[i] - w.along[i]);
        }
        modeler_solution(loops, &w, w.at, w.right, w.step);
        for (int i = 0; i < m; i++) {
            rate[loops->solved_places[i] * g + j] = w.step[i];
        }
    }
}

int modeler_eliminated(const modeler_closure *loops, const modeler_work *work,
                       const modeler_real **values, const modeler_real **lu, const modeler_real **G)
{
    const modeler_workspace w = modeler_parts(loops, work);

    if (w.kept->dense[w.at] != 0) {
        return 0;
    }
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

    for (int k = 0; k < loops->unknowns; k++) {
        for (int j = 0; j < g; j++) {
            const modeler_real share = factor * G[k * g + j];
            if (share != MODELER_REAL(0.0)) {
                for (int c = 0; c < width; c++) {
                    out[j * width + c] += share * rows[k * width + c];
                }
            }
        }
    }
}

void modeler_project(const modeler_closure *loops, const modeler_real *G, const modeler_real *rows,
                     int width, modeler_real *out)
{
    for (int k = 0; k < loops->given * width; k++) {
        out[k] = MODELER_REAL(0.0);
    }
    modeler_project_more(loops, G, rows, width, MODELER_REAL(1.0), out);
}

void modeler_apply_more(const modeler_real *A, int rows, int inner, const modeler_real *x,
                        int width, modeler_real *out)
{
    for (int i = 0; i < rows; i++) {
        for (int k = 0; k < inner; k++) {
            const modeler_real share = A[i * inner + k];
            if (share != MODELER_REAL(0.0)) {
                for (int c = 0; c < width; c++) {
                    out[i * width + c] += share * x[k * width + c];
                }
            }
        }
    }
}
