/* Planar five-bar, two actuated joints at the base
 *
 * Closing the loops around the functions of the opened tree; see five_bar.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "five_bar.h"

#include "modeler_closure.h"
#include "five_bar_tree.h"

#if MODELER_CLOSURE_PLACES(4, 2) != 8 \
    || MODELER_CLOSURE_NUMBERS(4, 2, 19, 4) != 92
#error the runtime has other limits
#endif

/* Free variables u: 11, 21, 12, 22. */
const double five_bar_home[4] = {
    2.2, -1.370417319700625, 0.9, 1.4635998467408842
};
static const double scale[4] = {
    1.0, 1.0, 1.0, 1.0
};
/* Equation and place in u of the nonzeros of df/du. */
static const int row[8] = {
    0, 0, 0, 0, 1, 1, 1, 1
};
static const int column[8] = {
    0, 1, 2, 3, 0, 1, 2, 3
};

static const int given[2] = { 0, 2 };
static const int solved[2] = { 1, 3 };
/* Largest sizes of 1/pivot. */
static const double limits[2] = {
    100.0, 200.0
};
/* Places in u and among the given of the nonzeros of G in solved rows. */
static const int coupling_row[4] = {
    1, 3, 1, 3
};
static const int coupling_column[4] = {
    0, 0, 1, 1
};
const modeler_closure five_bar_loops = {
    4, 2, 2, given, solved, scale,
    2, 1, 4.2e-10, 8, row, column, 19,
    five_bar_tree_closure, five_bar_tree_residual,
    4, limits, five_bar_tree_factor, five_bar_tree_solve,
    4, coupling_row, coupling_column,
    five_bar_tree_coupling, five_bar_tree_turned, five_bar_tree_spread
};

static modeler_work work_of(struct five_bar_posture *p)
{
    modeler_work work;

    work.kept = &p->kept;
    work.places = p->places;
    work.numbers = p->numbers;
    work.evaluations = FIVE_BAR_MAX_CLOSURE_EVALUATIONS;
    return work;
}

int five_bar_posed(const modeler_closure *loops, const double *q, const double *start,
    struct five_bar_posture *p)
{
    const modeler_work work = work_of(p);

    return modeler_close(loops, q, start, p->u, &work);
}

void five_bar_moved(const modeler_closure *loops, const double *qd,
    struct five_bar_posture *p)
{
    const modeler_work work = work_of(p);

    modeler_coupling(loops, p->G, &work);
    if (qd == NULL) {
        return;
    }
    modeler_drift(loops, five_bar_tree_drift, p->u, p->G, qd, p->ud, p->gamma,
                  &work);
    for (int k = 0; k < 2; k++) {
        p->qd[k] = qd[k];
    }
}

/* Regressor of the base parameters at the closed posture p. */
static void base_rows(struct five_bar_posture *p, double *rows, const double *qd,
                      const double *qdd, double *phi)
{
    const modeler_work work = work_of(p);
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&five_bar_loops, &work, &values, &lu, &G_nonzeros) != 0) {
        five_bar_tree_rows(p->u, values + 11, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double udd[4];

        five_bar_moved(&five_bar_loops, qd, p);
        modeler_accelerations(&five_bar_loops, p->G, p->gamma, qdd, udd);
        five_bar_tree_base_regressor(p->u, p->ud, udd, rows);
        modeler_project(&five_bar_loops, p->G, rows, FIVE_BAR_BASE_PARAMETERS, phi);
    }
}

const char *five_bar_signature(void)
{
    return "d1c82fb9d880dc4b";
}

int five_bar_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct five_bar_posture *p, double *rows, double *phi)
{
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(qdd, 2) != 0) {
        if (next != 0) {
            const modeler_work work = work_of(p);

            status = modeler_close_next(&five_bar_loops, q, p->u, &work);
        }
        if (status != MODELER_CLOSED) {
            status = five_bar_posed(&five_bar_loops, q, five_bar_home, p);
        }
    }
    if (status == MODELER_CLOSED) {
        base_rows(p, rows, qd, qdd, phi);
    }
    return modeler_told(status, phi, FIVE_BAR_JOINTS * FIVE_BAR_BASE_PARAMETERS);
}

int five_bar_state(const double *q, const double *qd, const double *previous,
    struct five_bar_state *state)
{
    return five_bar_state_with_bound(q, qd, previous, FIVE_BAR_MAX_CLOSURE_EVALUATIONS, state);
}

int five_bar_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct five_bar_state *state)
{
    struct five_bar_posture *const p = &state->at;
    modeler_work work = work_of(p);
    const int reached = previous == p->u && (p->kept.valid != 0 || p->kept.reached != 0);
    int status = MODELER_NOT_FINITE;

    if (evaluations < work.evaluations) {
        work.evaluations = evaluations;
    }
    if (modeler_finite(qd, 2) != 0) {
        if (previous == p->u && !reached) {
            previous = NULL;
        }
        if (reached && p->kept.valid != 0) {
            status = modeler_close_soon(&five_bar_loops, q, p->u, &work);
        } else {
            status = modeler_close(&five_bar_loops, q,
                                   previous == NULL ? five_bar_home : previous, p->u, &work);
        }
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, qd, p);
    }
    p->kept.reached = reached || status == MODELER_CLOSED;
    state->closed = status == MODELER_CLOSED;
    state->status = status;
    state->rated = 0;
    return status;
}

int five_bar_coupling_rate_at(struct five_bar_state *state, double *rate)
{
    struct five_bar_posture *const p = &state->at;
    const int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !state->rated) {
        const modeler_work work = work_of(p);

        modeler_coupling_rate(&five_bar_loops, five_bar_tree_drift, p->u, p->G, p->ud,
                              state->rate, &work);
        state->rated = 1;
    }
    for (int k = 0; rate != NULL && k < 8; k++) {
        rate[k] = state->rate[k];
    }
    return rate == NULL ? status : modeler_told(status, rate, 8);
}

/* Regressor of the standard parameters. */
static void made_regressor(struct five_bar_posture *p, double *rows,
                           const double qdd[FIVE_BAR_JOINTS], double MODELER_OUT(phi, 2 * 40))
{
    double udd[4];

    modeler_accelerations(&five_bar_loops, p->G, p->gamma, qdd, udd);
    five_bar_tree_regressor(p->u, p->ud, udd, rows);
    modeler_project(&five_bar_loops, p->G, rows, 40, phi);
}

int five_bar_regressor(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                       const double qdd[FIVE_BAR_JOINTS], double MODELER_OUT(phi, 2 * 40))
{
    struct five_bar_posture p;
    double rows[160];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(qdd, 2) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, qd, &p);
        made_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 80);
}

/* Regressor of the base parameters. */
static void made_base_regressor(struct five_bar_posture *p, double *rows,
                                const double qdd[FIVE_BAR_JOINTS], double MODELER_OUT(phi, 2 * 11))
{
    (void)rows;
    base_rows(p, rows, p->qd, qdd, phi);
}

int five_bar_base_regressor(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                            const double qdd[FIVE_BAR_JOINTS], double MODELER_OUT(phi, 2 * 11))
{
    struct five_bar_posture p;
    double rows[44];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(qdd, 2) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 2; k++) {
            p.qd[k] = qd[k];
        }
        made_base_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 22);
}

int five_bar_base_regressor_at(struct five_bar_state *state, const double qdd[FIVE_BAR_JOINTS],
                               double MODELER_OUT(phi, 2 * 11))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 2) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_base_regressor(&state->at, state->rows, qdd, phi);
    }
    return modeler_told(status, phi, 22);
}

/* Torques that move the closed robot so. */
static void made_inverse_dynamics(struct five_bar_posture *p, double *rows,
                                  const double qdd[FIVE_BAR_JOINTS],
                                  const double beta[FIVE_BAR_BASE_PARAMETERS],
                                  double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    double udd[4];

    modeler_accelerations(&five_bar_loops, p->G, p->gamma, qdd, udd);
    five_bar_tree_inverse_dynamics(p->u, p->ud, udd, beta, rows);
    modeler_project(&five_bar_loops, p->G, rows, 1, tau);
}

int five_bar_inverse_dynamics(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                              const double qdd[FIVE_BAR_JOINTS],
                              const double beta[FIVE_BAR_BASE_PARAMETERS],
                              double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    struct five_bar_posture p;
    double rows[4];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(qdd, 2) != 0 && modeler_finite(beta, 11) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, qd, &p);
        made_inverse_dynamics(&p, rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

int five_bar_inverse_dynamics_at(struct five_bar_state *state, const double qdd[FIVE_BAR_JOINTS],
                                 const double beta[FIVE_BAR_BASE_PARAMETERS],
                                 double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 2) != 0 && modeler_finite(beta, 11) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inverse_dynamics(&state->at, state->rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Torques that hold the robot still, without friction. */
static void made_gravity(struct five_bar_posture *p, double *rows,
                         const double beta[FIVE_BAR_BASE_PARAMETERS],
                         double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    five_bar_tree_gravity(p->u, beta, rows);
    modeler_project(&five_bar_loops, p->G, rows, 1, tau);
}

int five_bar_gravity(const double q[FIVE_BAR_JOINTS], const double beta[FIVE_BAR_BASE_PARAMETERS],
                     double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    struct five_bar_posture p;
    double rows[4];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 11) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, NULL, &p);
        made_gravity(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

int five_bar_gravity_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                        double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 11) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_gravity(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Coriolis and centripetal torques. */
static void made_coriolis(struct five_bar_posture *p, double *rows,
                          const double beta[FIVE_BAR_BASE_PARAMETERS],
                          double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    five_bar_tree_coriolis(p->u, p->ud, p->gamma, beta, rows);
    modeler_project(&five_bar_loops, p->G, rows, 1, tau);
}

int five_bar_coriolis(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                      const double beta[FIVE_BAR_BASE_PARAMETERS],
                      double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    struct five_bar_posture p;
    double rows[4];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(beta, 11) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, qd, &p);
        made_coriolis(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

int five_bar_coriolis_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                         double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 11) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_coriolis(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
static void made_friction(struct five_bar_posture *p, double *rows,
                          const double beta[FIVE_BAR_BASE_PARAMETERS],
                          double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    five_bar_tree_friction(p->ud, beta, rows);
    modeler_project(&five_bar_loops, p->G, rows, 1, tau);
}

int five_bar_friction(const double q[FIVE_BAR_JOINTS], const double qd[FIVE_BAR_JOINTS],
                      const double beta[FIVE_BAR_BASE_PARAMETERS],
                      double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    struct five_bar_posture p;
    double rows[4];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) != 0 && modeler_finite(beta, 11) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, qd, &p);
        made_friction(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

int five_bar_friction_at(struct five_bar_state *state, const double beta[FIVE_BAR_BASE_PARAMETERS],
                         double MODELER_OUT(tau, FIVE_BAR_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 11) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_friction(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Inertia matrix, rotor inertias included; symmetric. */
static void made_inertia_matrix(struct five_bar_posture *p, double *rows,
                                const double beta[FIVE_BAR_BASE_PARAMETERS],
                                double MODELER_OUT(M, 2 * 2))
{
    double *const half = rows + 16;

    five_bar_tree_inertia_matrix(p->u, beta, rows);
    modeler_project(&five_bar_loops, p->G, rows, 4, half);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 4; k++) {
            rows[k * 2 + i] = half[i * 4 + k];
        }
    }
    modeler_project(&five_bar_loops, p->G, rows, 2, M);
}

int five_bar_inertia_matrix(const double q[FIVE_BAR_JOINTS],
                            const double beta[FIVE_BAR_BASE_PARAMETERS],
                            double MODELER_OUT(M, 2 * 2))
{
    struct five_bar_posture p;
    double rows[24];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 11) != 0) {
        status = five_bar_posed(&five_bar_loops, q,
            five_bar_home, &p);
    }
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, NULL, &p);
        made_inertia_matrix(&p, rows, beta, M);
    }
    return modeler_told(status, M, 4);
}

int five_bar_inertia_matrix_at(struct five_bar_state *state,
                               const double beta[FIVE_BAR_BASE_PARAMETERS],
                               double MODELER_OUT(M, 2 * 2))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 11) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inertia_matrix(&state->at, state->rows, beta, M);
    }
    return modeler_told(status, M, 4);
}

/* Pose of the frame of every moving row of the table. */
static void made_forward_kinematics(struct five_bar_posture *p, double *rows,
                                    double MODELER_OUT(T, 4 * 3 * 4))
{
    (void)rows;
    five_bar_tree_forward_kinematics(p->u, T);
}

int five_bar_forward_kinematics(const double q[FIVE_BAR_JOINTS], double MODELER_OUT(T, 4 * 3 * 4))
{
    struct five_bar_posture p;
    int status = MODELER_NOT_FINITE;

    status = five_bar_posed(&five_bar_loops, q,
        five_bar_home, &p);
    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&p, NULL, T);
    }
    return modeler_told(status, T, 48);
}

int five_bar_forward_kinematics_at(struct five_bar_state *state, double MODELER_OUT(T, 4 * 3 * 4))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&state->at, state->rows, T);
    }
    return modeler_told(status, T, 48);
}

/* Closed posture, on a straight way from home. */
int five_bar_close(const double q[FIVE_BAR_JOINTS], double MODELER_OUT(u, 4))
{
    struct five_bar_posture p;
    int status = MODELER_NOT_FINITE;

    status = five_bar_posed(&five_bar_loops, q,
        five_bar_home, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 4; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 4);
}

/* Closed posture, on a straight way from another one, such as the last. */
int five_bar_close_from(const double q[FIVE_BAR_JOINTS], const double start[4],
                        double MODELER_OUT(u, 4))
{
    struct five_bar_posture p;
    int status = MODELER_NOT_FINITE;

    status = five_bar_posed(&five_bar_loops, q,
        start, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 4; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 4);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
static void made_coupling(struct five_bar_posture *p, double *rows, double MODELER_OUT(G, 4 * 2))
{
    (void)rows;
    for (int k = 0; k < 8; k++) {
        G[k] = p->G[k];
    }
}

int five_bar_coupling(const double q[FIVE_BAR_JOINTS], double MODELER_OUT(G, 4 * 2))
{
    struct five_bar_posture p;
    int status = MODELER_NOT_FINITE;

    status = five_bar_posed(&five_bar_loops, q,
        five_bar_home, &p);
    if (status == MODELER_CLOSED) {
        five_bar_moved(&five_bar_loops, NULL, &p);
        made_coupling(&p, NULL, G);
    }
    return modeler_told(status, G, 8);
}

int five_bar_coupling_at(struct five_bar_state *state, double MODELER_OUT(G, 4 * 2))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_coupling(&state->at, state->rows, G);
    }
    return modeler_told(status, G, 8);
}

