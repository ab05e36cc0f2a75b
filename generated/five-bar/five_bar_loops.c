/* Planar five-bar, two actuated joints at the base
 *
 * Closing the loops around the functions of the opened tree; see five_bar.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "five_bar.h"

#include "modeler_closure.h"
#include "five_bar_tree.h"

#if FIVE_BAR_EVALUATIONS != MODELER_EVALUATIONS
#error the runtime has another limit
#endif

#define WORK MODELER_CLOSURE_WORK(4, 2, 19, 4)

/* Free variables u: 11, 21, 12, 22. */
static const double home[4] = {
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
static const modeler_closure loops = {
    4, 2, 2, given, solved, scale,
    2, 1, 4.2e-10, 8, row, column, 19,
    five_bar_tree_closure, five_bar_tree_residual,
    4, limits, five_bar_tree_factor, five_bar_tree_solve,
    4, coupling_row, coupling_column,
    five_bar_tree_coupling, five_bar_tree_turned, five_bar_tree_spread
};

static const double standing[2] = {0.0};

/* Regressor of the base parameters at the closed posture u that was found last. */
static void base_rows(const double *u, const double *qd, const double *qdd, double *work, double *phi)
{
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&loops, work, &values, &lu, &G_nonzeros)) {
        five_bar_tree_rows(u, values + 11, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double ud[4], udd[4], G[8];
        double rows[4 * FIVE_BAR_BASE_PARAMETERS];

        modeler_follow(&loops, five_bar_tree_drift, u, qd, qdd, G, ud, udd, work);
        five_bar_tree_base_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, FIVE_BAR_BASE_PARAMETERS, phi);
    }
}

const char *five_bar_signature(void)
{
    return "c7cd854564dea4f6";
}

/* Each sample starts from the one before; where that fails, from home. */
void five_bar_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                          double *MODELER_RESTRICT W, int *status)
{
    double u[4], work[WORK];
    const size_t width = (size_t)FIVE_BAR_JOINTS * FIVE_BAR_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * FIVE_BAR_JOINTS;
        int found = MODELER_NOT_FINITE;

        if (modeler_finite(qd + at, 2) && modeler_finite(qdd + at, 2)) {
            if (i > 0 && status[i - 1] == MODELER_CLOSED)
                found = modeler_close_next(&loops, q + at, u, work);
            if (found != MODELER_CLOSED)
                found = modeler_close(&loops, q + at, home, u, work);
        }
        if (found == MODELER_CLOSED)
            base_rows(u, qd + at, qdd + at, work, W + i * width);
        status[i] = modeler_told(found, W + i * width, width);
    }
}

/* Regressor of the standard parameters. */
int five_bar_regressor(const double *q, const double *qd, const double *qdd,
                       double *MODELER_RESTRICT phi)
{
    double G[8], ud[4], udd[4], rows[160];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) && modeler_finite(qdd, 2))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, five_bar_tree_drift, u, qd, qdd, G, ud, udd, work);
        five_bar_tree_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, 40, phi);
    }
    return modeler_told(status, phi, 80);
}

/* Regressor of the base parameters. */
int five_bar_base_regressor(const double *q, const double *qd, const double *qdd,
                            double *MODELER_RESTRICT phi)
{
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) && modeler_finite(qdd, 2))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        base_rows(u, qd, qdd, work, phi);
    }
    return modeler_told(status, phi, 22);
}

/* Torques that move the closed robot so. */
int five_bar_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                              const double *beta, double *MODELER_RESTRICT tau)
{
    double G[8], ud[4], udd[4], rows[4];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) && modeler_finite(qdd, 2) && modeler_finite(beta, 11))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, five_bar_tree_drift, u, qd, qdd, G, ud, udd, work);
        five_bar_tree_inverse_dynamics(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Torques that hold the robot still, without friction. */
int five_bar_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    double G[8], rows[4];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 11))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        five_bar_tree_gravity(u, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Coriolis and centripetal torques. */
int five_bar_coriolis(const double *q, const double *qd, const double *beta,
                      double *MODELER_RESTRICT tau)
{
    double G[8], ud[4], udd[4], rows[4];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) && modeler_finite(beta, 11))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, five_bar_tree_drift, u, qd, standing, G, ud, udd, work);
        five_bar_tree_coriolis(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
int five_bar_friction(const double *q, const double *qd, const double *beta,
                      double *MODELER_RESTRICT tau)
{
    double G[8], ud[4], udd[4], rows[4];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 2) && modeler_finite(beta, 11))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, five_bar_tree_drift, u, qd, standing, G, ud, udd, work);
        five_bar_tree_friction(ud, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 2);
}

/* Inertia matrix, rotor inertias included; symmetric. */
int five_bar_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    double G[8], rows[16], half[8];
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 11))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        five_bar_tree_inertia_matrix(u, beta, rows);
        modeler_project(&loops, G, rows, 4, half);
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 4; k++)
                rows[k * 2 + i] = half[i * 4 + k];
        modeler_project(&loops, G, rows, 2, M);
    }
    return modeler_told(status, M, 4);
}

/* Pose of the frame of every moving row of the table. */
int five_bar_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        five_bar_tree_forward_kinematics(u, T);
    }
    return modeler_told(status, T, 48);
}

/* Closed posture, on a straight way from home. */
int five_bar_close(const double *q, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    return modeler_told(status, u, 4);
}

/* Closed posture, on a straight way from another one, such as the last. */
int five_bar_close_from(const double *q, const double *start, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, start, u, work);
    return modeler_told(status, u, 4);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
int five_bar_coupling(const double *q, double *MODELER_RESTRICT G)
{
    double u[4], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
    }
    return modeler_told(status, G, 8);
}
