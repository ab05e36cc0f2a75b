/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Closing the loops around the functions of the opened tree; see orthoglide_2003.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2003.h"

#include "modeler_closure.h"
#include "orthoglide_2003_tree.h"

#if MODELER_CLOSURE_PLACES(12, 9) != 30 \
    || MODELER_CLOSURE_NUMBERS(12, 9, 48, 25) != 458
#error the runtime has other limits
#endif

/* Free variables u: Px, Py, P, 11, 12, 13, 21, 31, 22, 32, 23, 33. */
const double orthoglide_2003_home[12] = {
    0.0, 0.0, 0.6, 0.19, 0.19, 0.19, -1.5707963267948966, 0.0, -1.5707963267948966, 0.0, -1.5707963267948966, 0.0
};
static const double scale[12] = {
    0.848528137423857, 0.848528137423857, 0.848528137423857, 0.848528137423857, 0.848528137423857, 0.848528137423857, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0
};
/* Equation and place in u of the nonzeros of df/du. */
static const int row[27] = {
    0, 0, 0, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 5, 5, 6, 6, 7, 7, 7, 7, 8, 8, 8
};
static const int column[27] = {
    0, 6, 7, 1, 7, 2, 3, 6, 7, 0, 4, 8, 9, 1, 8, 9, 2, 9, 0, 11, 1, 5, 10, 11, 2, 10, 11
};

static const int given[3] = { 3, 4, 5 };
static const int solved[9] = { 0, 1, 2, 6, 7, 8, 9, 10, 11 };
/* Largest sizes of 1/pivot. */
static const double limits[9] = {
    100.0, 100.0, 100.0, 100.0, 84.8528137423857, 100.0, 84.8528137423857, 100.0, 84.8528137423857
};
/* Places in u and among the given of the nonzeros of G in solved rows. */
static const int coupling_row[27] = {
    0, 1, 2, 6, 7, 8, 9, 10, 11, 0, 1, 2, 6, 7, 8, 9, 10, 11, 0, 1, 2, 6, 7, 8, 9, 10, 11
};
static const int coupling_column[27] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2
};
const modeler_closure orthoglide_2003_loops = {
    12, 3, 9, given, solved, scale,
    9, 0, 8.485281374238571e-10, 27, row, column, 48,
    orthoglide_2003_tree_closure, orthoglide_2003_tree_residual,
    25, limits, orthoglide_2003_tree_factor, orthoglide_2003_tree_solve,
    27, coupling_row, coupling_column,
    orthoglide_2003_tree_coupling, orthoglide_2003_tree_turned, orthoglide_2003_tree_spread
};

static const int platform_given[3] = { 0, 1, 2 };
static const int platform_solved[9] = { 3, 4, 5, 6, 7, 8, 9, 10, 11 };
/* Largest sizes of 1/pivot. */
static const double platform_limits[9] = {
    100.0, 100.0, 84.8528137423857, 84.8528137423857, 100.0, 100.0, 100.0, 84.8528137423857, 100.0
};
/* Places in u and among the given of the nonzeros of G in solved rows. */
static const int platform_coupling_row[18] = {
    3, 4, 5, 6, 10, 11, 3, 4, 5, 6, 7, 8, 3, 4, 5, 8, 9, 10
};
static const int platform_coupling_column[18] = {
    0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2
};
const modeler_closure orthoglide_2003_platform_loops = {
    12, 3, 9, platform_given, platform_solved, scale,
    9, 0, 8.485281374238571e-10, 27, row, column, 48,
    orthoglide_2003_tree_closure, orthoglide_2003_tree_residual,
    18, platform_limits, orthoglide_2003_tree_platform_factor, orthoglide_2003_tree_platform_solve,
    18, platform_coupling_row, platform_coupling_column,
    orthoglide_2003_tree_platform_coupling, orthoglide_2003_tree_platform_turned, orthoglide_2003_tree_platform_spread
};

static modeler_work work_of(struct orthoglide_2003_posture *p)
{
    modeler_work work;

    work.kept = &p->kept;
    work.places = p->places;
    work.numbers = p->numbers;
    work.evaluations = ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS;
    return work;
}

int orthoglide_2003_posed(const modeler_closure *loops, const double *q, const double *start,
    struct orthoglide_2003_posture *p)
{
    const modeler_work work = work_of(p);

    return modeler_close(loops, q, start, p->u, &work);
}

void orthoglide_2003_moved(const modeler_closure *loops, const double *qd,
    struct orthoglide_2003_posture *p)
{
    const modeler_work work = work_of(p);

    modeler_coupling(loops, p->G, &work);
    if (qd == NULL) {
        return;
    }
    modeler_drift(loops, orthoglide_2003_tree_drift, p->u, p->G, qd, p->ud, p->gamma,
                  &work);
    for (int k = 0; k < 3; k++) {
        p->qd[k] = qd[k];
    }
}

/* Regressor of the base parameters at the closed posture p. */
static void base_rows(struct orthoglide_2003_posture *p, double *rows, const double *qd,
                      const double *qdd, double *phi)
{
    const modeler_work work = work_of(p);
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&orthoglide_2003_loops, &work, &values, &lu, &G_nonzeros) != 0) {
        orthoglide_2003_tree_rows(p->u, values + 36, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double udd[12];

        orthoglide_2003_moved(&orthoglide_2003_loops, qd, p);
        modeler_accelerations(&orthoglide_2003_loops, p->G, p->gamma, qdd, udd);
        orthoglide_2003_tree_base_regressor(p->u, p->ud, udd, rows);
        modeler_project(&orthoglide_2003_loops, p->G, rows, ORTHOGLIDE_2003_BASE_PARAMETERS, phi);
    }
}

const char *orthoglide_2003_signature(void)
{
    return "8b4d899ee4120f16";
}

int orthoglide_2003_tree_next(const double *q, const double *qd, const double *qdd, int next,
    struct orthoglide_2003_posture *p, double *rows, double *phi)
{
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(qdd, 3) != 0) {
        if (next != 0) {
            const modeler_work work = work_of(p);

            status = modeler_close_next(&orthoglide_2003_loops, q, p->u, &work);
        }
        if (status != MODELER_CLOSED) {
            status = orthoglide_2003_posed(&orthoglide_2003_loops, q, orthoglide_2003_home, p);
        }
    }
    if (status == MODELER_CLOSED) {
        base_rows(p, rows, qd, qdd, phi);
    }
    return modeler_told(status, phi, ORTHOGLIDE_2003_JOINTS * ORTHOGLIDE_2003_BASE_PARAMETERS);
}

int orthoglide_2003_state(const double *q, const double *qd, const double *previous,
    struct orthoglide_2003_state *state)
{
    return orthoglide_2003_state_with_bound(q, qd, previous, ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS, state);
}

int orthoglide_2003_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct orthoglide_2003_state *state)
{
    struct orthoglide_2003_posture *const p = &state->at;
    modeler_work work = work_of(p);
    const int reached = previous == p->u && (p->kept.valid != 0 || p->kept.reached != 0);
    int status = MODELER_NOT_FINITE;

    if (evaluations < work.evaluations) {
        work.evaluations = evaluations;
    }
    if (modeler_finite(qd, 3) != 0) {
        if (previous == p->u && !reached) {
            previous = NULL;
        }
        if (reached && p->kept.valid != 0) {
            status = modeler_close_soon(&orthoglide_2003_loops, q, p->u, &work);
        } else {
            status = modeler_close(&orthoglide_2003_loops, q,
                                   previous == NULL ? orthoglide_2003_home : previous, p->u, &work);
        }
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, qd, p);
    }
    p->kept.reached = reached || status == MODELER_CLOSED;
    state->closed = status == MODELER_CLOSED;
    state->status = status;
    state->rated = 0;
    return status;
}

int orthoglide_2003_coupling_rate_at(struct orthoglide_2003_state *state, double *rate)
{
    struct orthoglide_2003_posture *const p = &state->at;
    const int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !state->rated) {
        const modeler_work work = work_of(p);

        modeler_coupling_rate(&orthoglide_2003_loops, orthoglide_2003_tree_drift, p->u, p->G, p->ud,
                              state->rate, &work);
        state->rated = 1;
    }
    for (int k = 0; rate != NULL && k < 36; k++) {
        rate[k] = state->rate[k];
    }
    return rate == NULL ? status : modeler_told(status, rate, 36);
}

/* Regressor of the standard parameters. */
static void made_regressor(struct orthoglide_2003_posture *p, double *rows,
                           const double qdd[ORTHOGLIDE_2003_JOINTS],
                           double MODELER_OUT(phi, 3 * 163))
{
    double udd[12];

    modeler_accelerations(&orthoglide_2003_loops, p->G, p->gamma, qdd, udd);
    orthoglide_2003_tree_regressor(p->u, p->ud, udd, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 163, phi);
}

int orthoglide_2003_regressor(const double q[ORTHOGLIDE_2003_JOINTS],
                              const double qd[ORTHOGLIDE_2003_JOINTS],
                              const double qdd[ORTHOGLIDE_2003_JOINTS],
                              double MODELER_OUT(phi, 3 * 163))
{
    struct orthoglide_2003_posture p;
    double rows[1956];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(qdd, 3) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, qd, &p);
        made_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 489);
}

/* Regressor of the base parameters. */
static void made_base_regressor(struct orthoglide_2003_posture *p, double *rows,
                                const double qdd[ORTHOGLIDE_2003_JOINTS],
                                double MODELER_OUT(phi, 3 * 43))
{
    (void)rows;
    base_rows(p, rows, p->qd, qdd, phi);
}

int orthoglide_2003_base_regressor(const double q[ORTHOGLIDE_2003_JOINTS],
                                   const double qd[ORTHOGLIDE_2003_JOINTS],
                                   const double qdd[ORTHOGLIDE_2003_JOINTS],
                                   double MODELER_OUT(phi, 3 * 43))
{
    struct orthoglide_2003_posture p;
    double rows[516];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(qdd, 3) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 3; k++) {
            p.qd[k] = qd[k];
        }
        made_base_regressor(&p, rows, qdd, phi);
    }
    return modeler_told(status, phi, 129);
}

int orthoglide_2003_base_regressor_at(struct orthoglide_2003_state *state,
                                      const double qdd[ORTHOGLIDE_2003_JOINTS],
                                      double MODELER_OUT(phi, 3 * 43))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 3) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_base_regressor(&state->at, state->rows, qdd, phi);
    }
    return modeler_told(status, phi, 129);
}

/* Torques that move the closed robot so. */
static void made_inverse_dynamics(struct orthoglide_2003_posture *p, double *rows,
                                  const double qdd[ORTHOGLIDE_2003_JOINTS],
                                  const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                  double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    double udd[12];

    modeler_accelerations(&orthoglide_2003_loops, p->G, p->gamma, qdd, udd);
    orthoglide_2003_tree_inverse_dynamics(p->u, p->ud, udd, beta, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 1, tau);
}

int orthoglide_2003_inverse_dynamics(const double q[ORTHOGLIDE_2003_JOINTS],
                                     const double qd[ORTHOGLIDE_2003_JOINTS],
                                     const double qdd[ORTHOGLIDE_2003_JOINTS],
                                     const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                     double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    struct orthoglide_2003_posture p;
    double rows[12];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(qdd, 3) != 0 && modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, qd, &p);
        made_inverse_dynamics(&p, rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

int orthoglide_2003_inverse_dynamics_at(struct orthoglide_2003_state *state,
                                        const double qdd[ORTHOGLIDE_2003_JOINTS],
                                        const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                        double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(qdd, 3) != 0 && modeler_finite(beta, 43) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inverse_dynamics(&state->at, state->rows, qdd, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Torques that hold the robot still, without friction. */
static void made_gravity(struct orthoglide_2003_posture *p, double *rows,
                         const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                         double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    orthoglide_2003_tree_gravity(p->u, beta, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 1, tau);
}

int orthoglide_2003_gravity(const double q[ORTHOGLIDE_2003_JOINTS],
                            const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                            double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    struct orthoglide_2003_posture p;
    double rows[12];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, NULL, &p);
        made_gravity(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

int orthoglide_2003_gravity_at(struct orthoglide_2003_state *state,
                               const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                               double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 43) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_gravity(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Coriolis and centripetal torques. */
static void made_coriolis(struct orthoglide_2003_posture *p, double *rows,
                          const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                          double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    orthoglide_2003_tree_coriolis(p->u, p->ud, p->gamma, beta, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 1, tau);
}

int orthoglide_2003_coriolis(const double q[ORTHOGLIDE_2003_JOINTS],
                             const double qd[ORTHOGLIDE_2003_JOINTS],
                             const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                             double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    struct orthoglide_2003_posture p;
    double rows[12];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, qd, &p);
        made_coriolis(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

int orthoglide_2003_coriolis_at(struct orthoglide_2003_state *state,
                                const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 43) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_coriolis(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
static void made_friction(struct orthoglide_2003_posture *p, double *rows,
                          const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                          double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    orthoglide_2003_tree_friction(p->ud, beta, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 1, tau);
}

int orthoglide_2003_friction(const double q[ORTHOGLIDE_2003_JOINTS],
                             const double qd[ORTHOGLIDE_2003_JOINTS],
                             const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                             double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    struct orthoglide_2003_posture p;
    double rows[12];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) != 0 && modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, qd, &p);
        made_friction(&p, rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

int orthoglide_2003_friction_at(struct orthoglide_2003_state *state,
                                const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                double MODELER_OUT(tau, ORTHOGLIDE_2003_JOINTS))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 43) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_friction(&state->at, state->rows, beta, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Inertia matrix, rotor inertias included; symmetric. */
static void made_inertia_matrix(struct orthoglide_2003_posture *p, double *rows,
                                const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                double MODELER_OUT(M, 3 * 3))
{
    double *const half = rows + 144;

    orthoglide_2003_tree_inertia_matrix(p->u, beta, rows);
    modeler_project(&orthoglide_2003_loops, p->G, rows, 12, half);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 12; k++) {
            rows[k * 3 + i] = half[i * 12 + k];
        }
    }
    modeler_project(&orthoglide_2003_loops, p->G, rows, 3, M);
}

int orthoglide_2003_inertia_matrix(const double q[ORTHOGLIDE_2003_JOINTS],
                                   const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                   double MODELER_OUT(M, 3 * 3))
{
    struct orthoglide_2003_posture p;
    double rows[180];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, NULL, &p);
        made_inertia_matrix(&p, rows, beta, M);
    }
    return modeler_told(status, M, 9);
}

int orthoglide_2003_inertia_matrix_at(struct orthoglide_2003_state *state,
                                      const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                      double MODELER_OUT(M, 3 * 3))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED && !(modeler_finite(beta, 43) != 0)) {
        status = MODELER_NOT_FINITE;
    }
    if (status == MODELER_CLOSED) {
        made_inertia_matrix(&state->at, state->rows, beta, M);
    }
    return modeler_told(status, M, 9);
}

/* Pose of the frame of every moving row of the table. */
static void made_forward_kinematics(struct orthoglide_2003_posture *p, double *rows,
                                    double MODELER_OUT(T, 21 * 3 * 4))
{
    (void)rows;
    orthoglide_2003_tree_forward_kinematics(p->u, T);
}

int orthoglide_2003_forward_kinematics(const double q[ORTHOGLIDE_2003_JOINTS],
                                       double MODELER_OUT(T, 21 * 3 * 4))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
        orthoglide_2003_home, &p);
    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&p, NULL, T);
    }
    return modeler_told(status, T, 252);
}

int orthoglide_2003_forward_kinematics_at(struct orthoglide_2003_state *state,
                                          double MODELER_OUT(T, 21 * 3 * 4))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_forward_kinematics(&state->at, state->rows, T);
    }
    return modeler_told(status, T, 252);
}

/* Closed posture, on a straight way from home. */
int orthoglide_2003_close(const double q[ORTHOGLIDE_2003_JOINTS], double MODELER_OUT(u, 12))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
        orthoglide_2003_home, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 12; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 12);
}

/* Closed posture, on a straight way from another one, such as the last. */
int orthoglide_2003_close_from(const double q[ORTHOGLIDE_2003_JOINTS], const double start[12],
                               double MODELER_OUT(u, 12))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
        start, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 12; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 12);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
static void made_coupling(struct orthoglide_2003_posture *p, double *rows,
                          double MODELER_OUT(G, 12 * 3))
{
    (void)rows;
    for (int k = 0; k < 36; k++) {
        G[k] = p->G[k];
    }
}

int orthoglide_2003_coupling(const double q[ORTHOGLIDE_2003_JOINTS], double MODELER_OUT(G, 12 * 3))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_loops, q,
        orthoglide_2003_home, &p);
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_loops, NULL, &p);
        made_coupling(&p, NULL, G);
    }
    return modeler_told(status, G, 36);
}

int orthoglide_2003_coupling_at(struct orthoglide_2003_state *state, double MODELER_OUT(G, 12 * 3))
{
    int status = state->closed != 0 ? MODELER_CLOSED : modeler_first(state->status, MODELER_OPEN);

    if (status == MODELER_CLOSED) {
        made_coupling(&state->at, state->rows, G);
    }
    return modeler_told(status, G, 36);
}

/* Regressor of the base parameters. */
static void made_platform_base_regressor(struct orthoglide_2003_posture *p, double *rows,
                                         const double xdd[3], double MODELER_OUT(phi, 3 * 43))
{
    double udd[12];

    modeler_accelerations(&orthoglide_2003_platform_loops, p->G, p->gamma, xdd, udd);
    orthoglide_2003_tree_base_regressor(p->u, p->ud, udd, rows);
    modeler_project(&orthoglide_2003_platform_loops, p->G, rows, 43, phi);
}

int orthoglide_2003_platform_base_regressor(const double x[3], const double xd[3],
                                            const double xdd[3], double MODELER_OUT(phi, 3 * 43))
{
    struct orthoglide_2003_posture p;
    double rows[516];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 3) != 0 && modeler_finite(xdd, 3) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_platform_loops, x,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_platform_loops, xd, &p);
        made_platform_base_regressor(&p, rows, xdd, phi);
    }
    return modeler_told(status, phi, 129);
}

/* Torques that move the closed robot so. */
static void made_platform_inverse_dynamics(struct orthoglide_2003_posture *p, double *rows,
                                           const double xdd[3],
                                           const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                           double MODELER_OUT(f, 3))
{
    double udd[12];

    modeler_accelerations(&orthoglide_2003_platform_loops, p->G, p->gamma, xdd, udd);
    orthoglide_2003_tree_inverse_dynamics(p->u, p->ud, udd, beta, rows);
    modeler_project(&orthoglide_2003_platform_loops, p->G, rows, 1, f);
}

int orthoglide_2003_platform_inverse_dynamics(const double x[3], const double xd[3],
                                              const double xdd[3],
                                              const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                              double MODELER_OUT(f, 3))
{
    struct orthoglide_2003_posture p;
    double rows[12];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 3) != 0 && modeler_finite(xdd, 3) != 0 && modeler_finite(beta, 43) != 0) {
        status = orthoglide_2003_posed(&orthoglide_2003_platform_loops, x,
            orthoglide_2003_home, &p);
    }
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_platform_loops, xd, &p);
        made_platform_inverse_dynamics(&p, rows, xdd, beta, f);
    }
    return modeler_told(status, f, 3);
}

/* Closed posture, on a straight way from home. */
int orthoglide_2003_platform_close(const double x[3], double MODELER_OUT(u, 12))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_platform_loops, x,
        orthoglide_2003_home, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 12; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 12);
}

/* Closed posture, on a straight way from another one, such as the last. */
int orthoglide_2003_platform_close_from(const double x[3], const double start[12],
                                        double MODELER_OUT(u, 12))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_platform_loops, x,
        start, &p);
    if (status == MODELER_CLOSED) {
        for (int k = 0; k < 12; k++) {
            u[k] = p.u[k];
        }
    }
    return modeler_told(status, u, 12);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
static void made_platform_coupling(struct orthoglide_2003_posture *p, double *rows,
                                   double MODELER_OUT(G, 12 * 3))
{
    (void)rows;
    for (int k = 0; k < 36; k++) {
        G[k] = p->G[k];
    }
}

int orthoglide_2003_platform_coupling(const double x[3], double MODELER_OUT(G, 12 * 3))
{
    struct orthoglide_2003_posture p;
    int status = MODELER_NOT_FINITE;

    status = orthoglide_2003_posed(&orthoglide_2003_platform_loops, x,
        orthoglide_2003_home, &p);
    if (status == MODELER_CLOSED) {
        orthoglide_2003_moved(&orthoglide_2003_platform_loops, NULL, &p);
        made_platform_coupling(&p, NULL, G);
    }
    return modeler_told(status, G, 36);
}

