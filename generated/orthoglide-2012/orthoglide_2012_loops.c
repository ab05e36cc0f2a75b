/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Closing the loops around the functions of the opened tree; see orthoglide_2012.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2012.h"

#include "modeler_closure.h"
#include "orthoglide_2012_tree.h"

#if ORTHOGLIDE_2012_EVALUATIONS != MODELER_EVALUATIONS
#error the runtime has another limit
#endif

#define WORK MODELER_CLOSURE_WORK(12, 9, 48, 25)

/* Free variables u: 6x, 6y, 6, 11, 12, 13, 21, 31, 22, 32, 23, 33. */
static const double home[12] = {
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
static const modeler_closure loops = {
    12, 3, 9, given, solved, scale,
    9, 0, 8.485281374238571e-10, 27, row, column, 48,
    orthoglide_2012_tree_closure, orthoglide_2012_tree_residual,
    25, limits, orthoglide_2012_tree_factor, orthoglide_2012_tree_solve,
    27, coupling_row, coupling_column,
    orthoglide_2012_tree_coupling, orthoglide_2012_tree_turned, orthoglide_2012_tree_spread
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
static const modeler_closure platform_loops = {
    12, 3, 9, platform_given, platform_solved, scale,
    9, 0, 8.485281374238571e-10, 27, row, column, 48,
    orthoglide_2012_tree_closure, orthoglide_2012_tree_residual,
    18, platform_limits, orthoglide_2012_tree_platform_factor, orthoglide_2012_tree_platform_solve,
    18, platform_coupling_row, platform_coupling_column,
    orthoglide_2012_tree_platform_coupling, orthoglide_2012_tree_platform_turned, orthoglide_2012_tree_platform_spread
};

static const double standing[3] = {0.0};

/* Regressor of the base parameters at the closed posture u that was found last. */
static void base_rows(const double *u, const double *qd, const double *qdd, double *work, double *phi)
{
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&loops, work, &values, &lu, &G_nonzeros)) {
        orthoglide_2012_tree_rows(u, values + 36, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double ud[12], udd[12], G[36];
        double rows[12 * ORTHOGLIDE_2012_BASE_PARAMETERS];

        modeler_follow(&loops, orthoglide_2012_tree_drift, u, qd, qdd, G, ud, udd, work);
        orthoglide_2012_tree_base_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, ORTHOGLIDE_2012_BASE_PARAMETERS, phi);
    }
}

const char *orthoglide_2012_signature(void)
{
    return "2f8df8789e1ed002";
}

/* Each sample starts from the one before; where that fails, from home. */
void orthoglide_2012_observation(size_t samples, const double *q, const double *qd,
                                 const double *qdd, double *MODELER_RESTRICT W, int *status)
{
    double u[12], work[WORK];
    const size_t width = (size_t)ORTHOGLIDE_2012_JOINTS * ORTHOGLIDE_2012_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * ORTHOGLIDE_2012_JOINTS;
        int found = MODELER_NOT_FINITE;

        if (modeler_finite(qd + at, 3) && modeler_finite(qdd + at, 3)) {
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
int orthoglide_2012_regressor(const double *q, const double *qd, const double *qdd,
                              double *MODELER_RESTRICT phi)
{
    double G[36], ud[12], udd[12], rows[2352];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) && modeler_finite(qdd, 3))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, orthoglide_2012_tree_drift, u, qd, qdd, G, ud, udd, work);
        orthoglide_2012_tree_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, 196, phi);
    }
    return modeler_told(status, phi, 588);
}

/* Regressor of the base parameters. */
int orthoglide_2012_base_regressor(const double *q, const double *qd, const double *qdd,
                                   double *MODELER_RESTRICT phi)
{
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) && modeler_finite(qdd, 3))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        base_rows(u, qd, qdd, work, phi);
    }
    return modeler_told(status, phi, 159);
}

/* Torques that move the closed robot so. */
int orthoglide_2012_inverse_dynamics(const double *q, const double *qd, const double *qdd,
                                     const double *beta, double *MODELER_RESTRICT tau)
{
    double G[36], ud[12], udd[12], rows[12];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) && modeler_finite(qdd, 3) && modeler_finite(beta, 53))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, orthoglide_2012_tree_drift, u, qd, qdd, G, ud, udd, work);
        orthoglide_2012_tree_inverse_dynamics(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Torques that hold the robot still, without friction. */
int orthoglide_2012_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    double G[36], rows[12];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 53))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        orthoglide_2012_tree_gravity(u, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Coriolis and centripetal torques. */
int orthoglide_2012_coriolis(const double *q, const double *qd, const double *beta,
                             double *MODELER_RESTRICT tau)
{
    double G[36], ud[12], udd[12], rows[12];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) && modeler_finite(beta, 53))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, orthoglide_2012_tree_drift, u, qd, standing, G, ud, udd, work);
        orthoglide_2012_tree_coriolis(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
int orthoglide_2012_friction(const double *q, const double *qd, const double *beta,
                             double *MODELER_RESTRICT tau)
{
    double G[36], ud[12], udd[12], rows[12];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 3) && modeler_finite(beta, 53))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, orthoglide_2012_tree_drift, u, qd, standing, G, ud, udd, work);
        orthoglide_2012_tree_friction(ud, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 3);
}

/* Inertia matrix, rotor inertias included; symmetric. */
int orthoglide_2012_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    double G[36], rows[144], half[36];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 53))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        orthoglide_2012_tree_inertia_matrix(u, beta, rows);
        modeler_project(&loops, G, rows, 12, half);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 12; k++)
                rows[k * 3 + i] = half[i * 12 + k];
        modeler_project(&loops, G, rows, 3, M);
    }
    return modeler_told(status, M, 9);
}

/* Pose of the frame of every moving row of the table. */
int orthoglide_2012_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        orthoglide_2012_tree_forward_kinematics(u, T);
    }
    return modeler_told(status, T, 216);
}

/* Closed posture, on a straight way from home. */
int orthoglide_2012_close(const double *q, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    return modeler_told(status, u, 12);
}

/* Closed posture, on a straight way from another one, such as the last. */
int orthoglide_2012_close_from(const double *q, const double *start, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, start, u, work);
    return modeler_told(status, u, 12);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
int orthoglide_2012_coupling(const double *q, double *MODELER_RESTRICT G)
{
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
    }
    return modeler_told(status, G, 36);
}

/* Regressor of the base parameters. */
int orthoglide_2012_platform_base_regressor(const double *x, const double *xd, const double *xdd,
                                            double *MODELER_RESTRICT phi)
{
    double G[36], ud[12], udd[12], rows[636];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 3) && modeler_finite(xdd, 3))
        status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&platform_loops, orthoglide_2012_tree_drift, u, xd, xdd, G, ud, udd, work);
        orthoglide_2012_tree_base_regressor(u, ud, udd, rows);
        modeler_project(&platform_loops, G, rows, 53, phi);
    }
    return modeler_told(status, phi, 159);
}

/* Torques that move the closed robot so. */
int orthoglide_2012_platform_inverse_dynamics(const double *x, const double *xd, const double *xdd,
                                              const double *beta, double *MODELER_RESTRICT f)
{
    double G[36], ud[12], udd[12], rows[12];
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 3) && modeler_finite(xdd, 3) && modeler_finite(beta, 53))
        status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&platform_loops, orthoglide_2012_tree_drift, u, xd, xdd, G, ud, udd, work);
        orthoglide_2012_tree_inverse_dynamics(u, ud, udd, beta, rows);
        modeler_project(&platform_loops, G, rows, 1, f);
    }
    return modeler_told(status, f, 3);
}

/* Closed posture, on a straight way from home. */
int orthoglide_2012_platform_close(const double *x, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, home, u, work);
    return modeler_told(status, u, 12);
}

/* Closed posture, on a straight way from another one, such as the last. */
int orthoglide_2012_platform_close_from(const double *x, const double *start,
                                        double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, start, u, work);
    return modeler_told(status, u, 12);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
int orthoglide_2012_platform_coupling(const double *x, double *MODELER_RESTRICT G)
{
    double u[12], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&platform_loops, G, work);
    }
    return modeler_told(status, G, 36);
}
