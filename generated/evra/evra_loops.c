/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Closing the loops around the functions of the opened tree; see evra.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "evra.h"

#include "modeler_closure.h"
#include "evra_tree.h"

#if MODELER_CLOSURE_PLACES(26, 18) != 62 \
    || MODELER_CLOSURE_NUMBERS(26, 18, 180, 107) != 1622
#error the runtime has other limits
#endif

/* Free variables u: Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32, 13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36. */
const double evra_home[26] = {
    0.0, 0.0, 0.6999893688975267, 0.0, 0.0, 0.0, 0.0, 0.0, 2.698838242015122, 0.28265536649639905, 0.8067, 2.698838242015122, -0.28265536649639905, 0.8067, 2.698838242015122, 0.28265536649639905, 0.8067, 2.698838242015122, -0.28265536649639905, 0.8067, 2.698838242015122, 0.28265536649639905, 0.8067, 2.698838242015122, -0.28265536649639905, 0.8067
};
static const double scale[26] = {
    0.6, 0.6, 0.6, 1.0, 1.0, 1.0, 0.6, 0.6, 1.0, 1.0, 0.6, 1.0, 1.0, 0.6, 1.0, 1.0, 0.6, 1.0, 1.0, 0.6, 1.0, 1.0, 0.6, 1.0, 1.0, 0.6
};
/* Equation and place in u of the nonzeros of df/du. */
static const int row[132] = {
    0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4,
    4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 7, 8, 8, 8, 8, 8,
    8, 8, 9, 9, 9, 9, 9, 9, 9, 10, 10, 10, 10, 10, 10, 10, 10, 11, 11, 11, 11, 11, 11, 11, 12, 12,
    12, 12, 12, 12, 12, 13, 13, 13, 13, 13, 13, 13, 13, 14, 14, 14, 14, 14, 14, 14, 15, 15, 15, 15,
    15, 15, 15, 16, 16, 16, 16, 16, 16, 16, 16, 17, 17, 17, 17, 17, 17, 17
};
static const int column[132] = {
    0, 4, 5, 6, 8, 9, 10, 1, 3, 4, 5, 7, 8, 9, 10, 2, 3, 4, 5, 8, 9, 10, 0, 4, 5, 6, 11, 12, 13, 1,
    3, 4, 5, 7, 11, 12, 13, 2, 3, 4, 5, 11, 12, 13, 0, 4, 5, 6, 14, 15, 16, 1, 3, 4, 5, 7, 14, 15,
    16, 2, 3, 4, 5, 14, 15, 16, 0, 4, 5, 6, 17, 18, 19, 1, 3, 4, 5, 7, 17, 18, 19, 2, 3, 4, 5, 17,
    18, 19, 0, 4, 5, 6, 20, 21, 22, 1, 3, 4, 5, 7, 20, 21, 22, 2, 3, 4, 5, 20, 21, 22, 0, 4, 5, 6,
    23, 24, 25, 1, 3, 4, 5, 7, 23, 24, 25, 2, 3, 4, 5, 23, 24, 25
};

static const int given[8] = { 6, 7, 10, 13, 16, 19, 22, 25 };
static const int solved[18] = { 0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24 };
/* Largest sizes of 1/pivot. */
static const double limits[18] = {
    100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 60.0, 60.0,
    60.0, 100.0, 100.0, 100.0
};
/* Places in u and among the given of the nonzeros of G in solved rows. */
static const int coupling_row[144] = {
    0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24, 0, 1, 2, 3, 4, 5, 8, 9, 11, 12,
    14, 15, 17, 18, 20, 21, 23, 24, 0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24,
    0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24, 0, 1, 2, 3, 4, 5, 8, 9, 11, 12,
    14, 15, 17, 18, 20, 21, 23, 24, 0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24,
    0, 1, 2, 3, 4, 5, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24, 0, 1, 2, 3, 4, 5, 8, 9, 11, 12,
    14, 15, 17, 18, 20, 21, 23, 24
};
static const int coupling_column[144] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 7, 7,
    7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7
};
const modeler_closure evra_loops = {
    26, 8, 18, given, solved, scale,
    18, 0, 6e-10, 132, row, column, 180,
    evra_tree_closure, evra_tree_residual,
    107, limits, evra_tree_factor, evra_tree_solve,
    144, coupling_row, coupling_column,
    evra_tree_coupling, evra_tree_turned, evra_tree_spread
};

static const int platform_given[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
static const int platform_solved[18] = { 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25 };
/* Largest sizes of 1/pivot. */
static const double platform_limits[18] = {
    100.0, 100.0, 60.0, 100.0, 100.0, 60.0, 100.0, 100.0, 60.0, 100.0, 100.0, 60.0, 100.0, 100.0,
    60.0, 100.0, 100.0, 60.0
};
/* Places in u and among the given of the nonzeros of G in solved rows. */
static const int platform_coupling_row[144] = {
    8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14,
    15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20,
    21, 22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 8, 9,
    10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14, 15,
    16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
    22, 23, 24, 25, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25
};
static const int platform_coupling_column[144] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 7, 7,
    7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7
};
const modeler_closure evra_platform_loops = {
    26, 8, 18, platform_given, platform_solved, scale,
    18, 0, 6e-10, 132, row, column, 180,
    evra_tree_closure, evra_tree_residual,
    54, platform_limits, evra_tree_platform_factor, evra_tree_platform_solve,
    144, platform_coupling_row, platform_coupling_column,
    evra_tree_platform_coupling, evra_tree_platform_turned, evra_tree_platform_spread
};

static modeler_work work_of(struct evra_posture *p)
{
    modeler_work work;

    work.kept = &p->kept;
    work.places = p->places;
    work.numbers = p->numbers;
    work.evaluations = EVRA_MAX_CLOSURE_EVALUATIONS;
    return work;
}

int evra_posed(const modeler_closure *loops, const double *q, const double *start,
    struct evra_posture *p)
{
    const modeler_work work = work_of(p);

    return modeler_close(loops, q, start, p->u, &work);
}

void evra_moved(const modeler_closure *loops, const double *qd,
    struct evra_posture *p)
{
    const modeler_work work = work_of(p);

    modeler_coupling(loops, p->G, &work);
    if (qd == NULL) {
        return;
    }
    modeler_drift(loops, evra_tree_drift, p->u, p->G, qd, p->ud, p->gamma,
                  &work);
    for (int k = 0; k < 8; k++) {
        p->qd[k] = qd[k];
    }
}

/* Regressor of the base parameters at the closed posture p. */
static void base_rows(struct evra_posture *p, double *rows, const double *qd,
                      const double *qdd, double *phi)
{
    const modeler_work work = work_of(p);
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&evra_loops, &work, &values, &lu, &G_nonzeros) != 0) {
        evra_tree_rows(p->u, values + 150, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double udd[26];

        evra_moved(&evra_loops, qd, p);
        modeler_accelerations(&evra_loops, p->G, p->gamma, qdd, udd);
        evra_tree_base_regressor(p->u, p->ud, udd, rows);
        modeler_project(&evra_loops, p->G, rows, EVRA_BASE_PARAMETERS, phi);
    }
}

const char *evra_signature(void)
{
    return "e1952a67b957d79a";
}

int evra_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct evra_posture *p, double *rows, double *phi)
{
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(qdd, 8) != 0) {
        if (next != 0) {
            const modeler_work work = work_of(p);

            status = modeler_close_next(&evra_loops, q, p->u, &work);
        }
        if (status != MODELER_CLOSED) {
            status = evra_posed(&evra_loops, q, evra_home, p);
        }
    }
    if (status == MODELER_CLOSED) {
        base_rows(p, rows, qd, qdd, phi);
    }
    return modeler_told(status, phi, EVRA_JOINTS * EVRA_BASE_PARAMETERS);
}

int evra_state(const double *q, const double *qd, const double *previous,
    struct evra_state *state)
{
    return evra_state_with_bound(q, qd, previous, EVRA_MAX_CLOSURE_EVALUATIONS, state);
}

int evra_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct evra_state *state)
{
    struct evra_posture *const p = &state->at;
    modeler_work work = work_of(p);
    const int reached = previous == p->u && (p->kept.valid != 0 || p->kept.reached != 0);
    int status = MODELER_NOT_FINITE;

    if (evaluations < work.evaluations) {
        work.evaluations = evaluations;
    }
    if (modeler_finite(qd, 8) != 0) {
        if (previous == p->u && !reached) {
            previous = NULL;
        }
        if (reached && p->kept.valid != 0) {
            status = modeler_close_soon(&evra_loops, q, p->u, &work);
        } else {
            status = modeler_close(&evra_loops, q,
                                   previous == NULL ? evra_home : previous, p->u, &work);
        }
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, qd, p);
    }
    p->kept.reached = reached || status == MODELER_CLOSED;
    state->closed = status == MODELER_CLOSED;
    state->status = status;
    state->rated = 0;
    return status;
}

int evra_coupling_rate_at(struct evra_state *state, double *rate)
{
    struct evra_posture *const p = &state->at;
    const int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !state->rated) {
        const modeler_work work = work_of(p);

        modeler_coupling_rate(&evra_loops, evra_tree_drift, p->u, p->G, p->ud,
                              state->rate, &work);
        state->rated = 1;
    }
    for (int k = 0; rate != NULL && k < 208; k++) {
        rate[k] = state->rate[k];
    }
    return rate == NULL ? status : modeler_told(status, rate, 208);
}

/* Regressor of the standard parameters. */
static void made_regressor(struct evra_posture *p, double *rows, const double qdd[EVRA_JOINTS],
                           double MODELER_OUT(phi, 8 * 210))
{
    double udd[26];

    modeler_accelerations(&evra_loops, p->G, p->gamma, qdd, udd);
    evra_tree_regressor(p->u, p->ud, udd, rows);
    modeler_project(&evra_loops, p->G, rows, 210, phi);
}

int evra_regressor(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                   const double qdd[EVRA_JOINTS], double MODELER_OUT(phi, 8 * 210))
{
    struct evra_posture p;
    double rows[5460];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(qdd, 8) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, qd, &p);
        made_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 1680);
}

/* Regressor of the base parameters. */
static void made_base_regressor(struct evra_posture *p, double *rows,
                                const double qdd[EVRA_JOINTS], double MODELER_OUT(phi, 8 * 90))
{
    (void)rows;
    base_rows(p, rows, p->qd, qdd, phi);
}

int evra_base_regressor(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                        const double qdd[EVRA_JOINTS], double MODELER_OUT(phi, 8 * 90))
{
    struct evra_posture p;
    double rows[2340];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(qdd, 8) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 8; k++) {
            p.qd[k] = qd[k];
        }
        made_base_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 720);
}

int evra_base_regressor_at(struct evra_state *state, const double qdd[EVRA_JOINTS],
                           double MODELER_OUT(phi, 8 * 90))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 8) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_base_regressor(&state->at, state->rows, qdd, phi);
    }
    return modeler_told(status, phi, 720);
}

/* Torques that move the closed robot so. */
static void made_inverse_dynamics(struct evra_posture *p, double *rows,
                                  const double qdd[EVRA_JOINTS],
                                  const double beta[EVRA_BASE_PARAMETERS],
                                  double MODELER_OUT(tau, EVRA_JOINTS))
{
    double udd[26];

    modeler_accelerations(&evra_loops, p->G, p->gamma, qdd, udd);
    evra_tree_inverse_dynamics(p->u, p->ud, udd, beta, rows);
    modeler_project(&evra_loops, p->G, rows, 1, tau);
}

int evra_inverse_dynamics(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                          const double qdd[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                          double MODELER_OUT(tau, EVRA_JOINTS))
{
    struct evra_posture p;
    double rows[26];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(qdd, 8) != 0 && modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, qd, &p);
        made_inverse_dynamics(&p, rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

int evra_inverse_dynamics_at(struct evra_state *state, const double qdd[EVRA_JOINTS],
                             const double beta[EVRA_BASE_PARAMETERS],
                             double MODELER_OUT(tau, EVRA_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 8) != 0 && modeler_finite(beta, 90) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inverse_dynamics(&state->at, state->rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Torques that hold the robot still, without friction. */
static void made_gravity(struct evra_posture *p, double *rows,
                         const double beta[EVRA_BASE_PARAMETERS],
                         double MODELER_OUT(tau, EVRA_JOINTS))
{
    evra_tree_gravity(p->u, beta, rows);
    modeler_project(&evra_loops, p->G, rows, 1, tau);
}

int evra_gravity(const double q[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                 double MODELER_OUT(tau, EVRA_JOINTS))
{
    struct evra_posture p;
    double rows[26];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, NULL, &p);
        made_gravity(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

int evra_gravity_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                    double MODELER_OUT(tau, EVRA_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 90) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_gravity(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Coriolis and centripetal torques. */
static void made_coriolis(struct evra_posture *p, double *rows,
                          const double beta[EVRA_BASE_PARAMETERS],
                          double MODELER_OUT(tau, EVRA_JOINTS))
{
    evra_tree_coriolis(p->u, p->ud, p->gamma, beta, rows);
    modeler_project(&evra_loops, p->G, rows, 1, tau);
}

int evra_coriolis(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                  const double beta[EVRA_BASE_PARAMETERS], double MODELER_OUT(tau, EVRA_JOINTS))
{
    struct evra_posture p;
    double rows[26];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, qd, &p);
        made_coriolis(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

int evra_coriolis_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                     double MODELER_OUT(tau, EVRA_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 90) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_coriolis(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
static void made_friction(struct evra_posture *p, double *rows,
                          const double beta[EVRA_BASE_PARAMETERS],
                          double MODELER_OUT(tau, EVRA_JOINTS))
{
    evra_tree_friction(p->ud, beta, rows);
    modeler_project(&evra_loops, p->G, rows, 1, tau);
}

int evra_friction(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                  const double beta[EVRA_BASE_PARAMETERS], double MODELER_OUT(tau, EVRA_JOINTS))
{
    struct evra_posture p;
    double rows[26];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) != 0 && modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, qd, &p);
        made_friction(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

int evra_friction_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                     double MODELER_OUT(tau, EVRA_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 90) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_friction(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Inertia matrix, rotor inertias included; symmetric. */
static void made_inertia_matrix(struct evra_posture *p, double *rows,
                                const double beta[EVRA_BASE_PARAMETERS],
                                double MODELER_OUT(M, 8 * 8))
{
    double *const half = rows + 676;

    evra_tree_inertia_matrix(p->u, beta, rows);
    modeler_project(&evra_loops, p->G, rows, 26, half);
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 26; k++) {
            rows[k * 8 + i] = half[i * 26 + k];
        }
    }
    modeler_project(&evra_loops, p->G, rows, 8, M);
}

int evra_inertia_matrix(const double q[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                        double MODELER_OUT(M, 8 * 8))
{
    struct evra_posture p;
    double rows[884];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_loops, q,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, NULL, &p);
        made_inertia_matrix(&p, rows, beta, M);
    }
    return modeler_told(status, M, 64);
}

int evra_inertia_matrix_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                           double MODELER_OUT(M, 8 * 8))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 90) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inertia_matrix(&state->at, state->rows, beta, M);
    }
    return modeler_told(status, M, 64);
}

/* Pose of the frame of every moving row of the table. */
static void made_forward_kinematics(struct evra_posture *p, double *rows,
                                    double MODELER_OUT(T, 26 * 3 * 4))
{
    (void)rows;
    evra_tree_forward_kinematics(p->u, T);
}

int evra_forward_kinematics(const double q[EVRA_JOINTS], double MODELER_OUT(T, 26 * 3 * 4))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_loops, q,
        evra_home, &p);
    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&p, NULL, T);
    }
    return modeler_told(status, T, 312);
}

int evra_forward_kinematics_at(struct evra_state *state, double MODELER_OUT(T, 26 * 3 * 4))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&state->at, state->rows, T);
    }
    return modeler_told(status, T, 312);
}

/* Closed posture, on a straight way from home. */
int evra_close(const double q[EVRA_JOINTS], double MODELER_OUT(u, 26))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_loops, q,
        evra_home, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 26; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 26);
}

/* Closed posture, on a straight way from another one, such as the last. */
int evra_close_from(const double q[EVRA_JOINTS], const double start[26], double MODELER_OUT(u, 26))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_loops, q,
        start, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 26; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 26);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
static void made_coupling(struct evra_posture *p, double *rows, double MODELER_OUT(G, 26 * 8))
{
    (void)rows;
    for (int k = 0; k < 208; k++) {
        G[k] = p->G[k];
    }
}

int evra_coupling(const double q[EVRA_JOINTS], double MODELER_OUT(G, 26 * 8))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_loops, q,
        evra_home, &p);
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_loops, NULL, &p);
        made_coupling(&p, NULL, G);
    }
    return modeler_told(status, G, 208);
}

int evra_coupling_at(struct evra_state *state, double MODELER_OUT(G, 26 * 8))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_coupling(&state->at, state->rows, G);
    }
    return modeler_told(status, G, 208);
}

/* Regressor of the base parameters. */
static void made_platform_base_regressor(struct evra_posture *p, double *rows, const double xdd[8],
                                         double MODELER_OUT(phi, 8 * 90))
{
    double udd[26];

    modeler_accelerations(&evra_platform_loops, p->G, p->gamma, xdd, udd);
    evra_tree_base_regressor(p->u, p->ud, udd, rows);
    modeler_project(&evra_platform_loops, p->G, rows, 90, phi);
}

int evra_platform_base_regressor(const double x[8], const double xd[8], const double xdd[8],
                                 double MODELER_OUT(phi, 8 * 90))
{
    struct evra_posture p;
    double rows[2340];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 8) != 0 && modeler_finite(xdd, 8) != 0) {
        status = evra_posed(&evra_platform_loops, x,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_platform_loops, xd, &p);
        made_platform_base_regressor(&p, rows, xdd, phi);
    }
    return modeler_told(status, phi, 720);
}

/* Torques that move the closed robot so. */
static void made_platform_inverse_dynamics(struct evra_posture *p, double *rows,
                                           const double xdd[8],
                                           const double beta[EVRA_BASE_PARAMETERS],
                                           double MODELER_OUT(f, 8))
{
    double udd[26];

    modeler_accelerations(&evra_platform_loops, p->G, p->gamma, xdd, udd);
    evra_tree_inverse_dynamics(p->u, p->ud, udd, beta, rows);
    modeler_project(&evra_platform_loops, p->G, rows, 1, f);
}

int evra_platform_inverse_dynamics(const double x[8], const double xd[8], const double xdd[8],
                                   const double beta[EVRA_BASE_PARAMETERS],
                                   double MODELER_OUT(f, 8))
{
    struct evra_posture p;
    double rows[26];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 8) != 0 && modeler_finite(xdd, 8) != 0 && modeler_finite(beta, 90) != 0) {
        status = evra_posed(&evra_platform_loops, x,
            evra_home, &p);
    }
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_platform_loops, xd, &p);
        made_platform_inverse_dynamics(&p, rows, xdd, beta, f);
    }
    return modeler_told(status, f, 8);
}

/* Closed posture, on a straight way from home. */
int evra_platform_close(const double x[8], double MODELER_OUT(u, 26))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_platform_loops, x,
        evra_home, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 26; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 26);
}

/* Closed posture, on a straight way from another one, such as the last. */
int evra_platform_close_from(const double x[8], const double start[26], double MODELER_OUT(u, 26))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_platform_loops, x,
        start, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 26; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 26);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
static void made_platform_coupling(struct evra_posture *p, double *rows,
                                   double MODELER_OUT(G, 26 * 8))
{
    (void)rows;
    for (int k = 0; k < 208; k++) {
        G[k] = p->G[k];
    }
}

int evra_platform_coupling(const double x[8], double MODELER_OUT(G, 26 * 8))
{
    struct evra_posture p;
    int status = MODELER_NOT_FINITE;

    status = evra_posed(&evra_platform_loops, x,
        evra_home, &p);
    if (status == MODELER_CLOSED) {
        evra_moved(&evra_platform_loops, NULL, &p);
        made_platform_coupling(&p, NULL, G);
    }
    return modeler_told(status, G, 208);
}

