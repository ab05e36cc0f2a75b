/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Closing the loops around the functions of the opened tree; see evra.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "evra.h"

#include "modeler_closure.h"
#include "evra_tree.h"

#if EVRA_EVALUATIONS != MODELER_EVALUATIONS
#error the runtime has another limit
#endif

#define WORK MODELER_CLOSURE_WORK(26, 18, 180, 107)

/* Free variables u: Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32, 13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36. */
static const double home[26] = {
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
static const modeler_closure loops = {
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
static const modeler_closure platform_loops = {
    26, 8, 18, platform_given, platform_solved, scale,
    18, 0, 6e-10, 132, row, column, 180,
    evra_tree_closure, evra_tree_residual,
    54, platform_limits, evra_tree_platform_factor, evra_tree_platform_solve,
    144, platform_coupling_row, platform_coupling_column,
    evra_tree_platform_coupling, evra_tree_platform_turned, evra_tree_platform_spread
};

static const double standing[8] = {0.0};

/* Regressor of the base parameters at the closed posture u that was found last. */
static void base_rows(const double *u, const double *qd, const double *qdd, double *work, double *phi)
{
    const double *values, *lu, *G_nonzeros;

    if (modeler_eliminated(&loops, work, &values, &lu, &G_nonzeros)) {
        evra_tree_rows(u, values + 150, G_nonzeros, lu, qd, qdd, phi);
    } else {
        double ud[26], udd[26], G[208];
        double rows[26 * EVRA_BASE_PARAMETERS];

        modeler_follow(&loops, evra_tree_drift, u, qd, qdd, G, ud, udd, work);
        evra_tree_base_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, EVRA_BASE_PARAMETERS, phi);
    }
}

const char *evra_signature(void)
{
    return "cfc2542b09605c49";
}

/* Each sample starts from the one before; where that fails, from home. */
void evra_observation(size_t samples, const double *q, const double *qd, const double *qdd,
                      double *MODELER_RESTRICT W, int *status)
{
    double u[26], work[WORK];
    const size_t width = (size_t)EVRA_JOINTS * EVRA_BASE_PARAMETERS;

    for (size_t i = 0; i < samples; i++) {
        const size_t at = i * EVRA_JOINTS;
        int found = MODELER_NOT_FINITE;

        if (modeler_finite(qd + at, 8) && modeler_finite(qdd + at, 8)) {
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
int evra_regressor(const double *q, const double *qd, const double *qdd,
                   double *MODELER_RESTRICT phi)
{
    double G[208], ud[26], udd[26], rows[5460];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) && modeler_finite(qdd, 8))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, evra_tree_drift, u, qd, qdd, G, ud, udd, work);
        evra_tree_regressor(u, ud, udd, rows);
        modeler_project(&loops, G, rows, 210, phi);
    }
    return modeler_told(status, phi, 1680);
}

/* Regressor of the base parameters. */
int evra_base_regressor(const double *q, const double *qd, const double *qdd,
                        double *MODELER_RESTRICT phi)
{
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) && modeler_finite(qdd, 8))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        base_rows(u, qd, qdd, work, phi);
    }
    return modeler_told(status, phi, 720);
}

/* Torques that move the closed robot so. */
int evra_inverse_dynamics(const double *q, const double *qd, const double *qdd, const double *beta,
                          double *MODELER_RESTRICT tau)
{
    double G[208], ud[26], udd[26], rows[26];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) && modeler_finite(qdd, 8) && modeler_finite(beta, 90))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, evra_tree_drift, u, qd, qdd, G, ud, udd, work);
        evra_tree_inverse_dynamics(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Torques that hold the robot still, without friction. */
int evra_gravity(const double *q, const double *beta, double *MODELER_RESTRICT tau)
{
    double G[208], rows[26];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 90))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        evra_tree_gravity(u, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Coriolis and centripetal torques. */
int evra_coriolis(const double *q, const double *qd, const double *beta,
                  double *MODELER_RESTRICT tau)
{
    double G[208], ud[26], udd[26], rows[26];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) && modeler_finite(beta, 90))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, evra_tree_drift, u, qd, standing, G, ud, udd, work);
        evra_tree_coriolis(u, ud, udd, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Torques of all effects but rotor inertias: friction, offsets. */
int evra_friction(const double *q, const double *qd, const double *beta,
                  double *MODELER_RESTRICT tau)
{
    double G[208], ud[26], udd[26], rows[26];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(qd, 8) && modeler_finite(beta, 90))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&loops, evra_tree_drift, u, qd, standing, G, ud, udd, work);
        evra_tree_friction(ud, beta, rows);
        modeler_project(&loops, G, rows, 1, tau);
    }
    return modeler_told(status, tau, 8);
}

/* Inertia matrix, rotor inertias included; symmetric. */
int evra_inertia_matrix(const double *q, const double *beta, double *MODELER_RESTRICT M)
{
    double G[208], rows[676], half[208];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(beta, 90))
        status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
        evra_tree_inertia_matrix(u, beta, rows);
        modeler_project(&loops, G, rows, 26, half);
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 26; k++)
                rows[k * 8 + i] = half[i * 26 + k];
        modeler_project(&loops, G, rows, 8, M);
    }
    return modeler_told(status, M, 64);
}

/* Pose of the frame of every moving row of the table. */
int evra_forward_kinematics(const double *q, double *MODELER_RESTRICT T)
{
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        evra_tree_forward_kinematics(u, T);
    }
    return modeler_told(status, T, 312);
}

/* Closed posture, on a straight way from home. */
int evra_close(const double *q, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    return modeler_told(status, u, 26);
}

/* Closed posture, on a straight way from another one, such as the last. */
int evra_close_from(const double *q, const double *start, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, start, u, work);
    return modeler_told(status, u, 26);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
int evra_coupling(const double *q, double *MODELER_RESTRICT G)
{
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&loops, q, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&loops, G, work);
    }
    return modeler_told(status, G, 208);
}

/* Regressor of the base parameters. */
int evra_platform_base_regressor(const double *x, const double *xd, const double *xdd,
                                 double *MODELER_RESTRICT phi)
{
    double G[208], ud[26], udd[26], rows[2340];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 8) && modeler_finite(xdd, 8))
        status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&platform_loops, evra_tree_drift, u, xd, xdd, G, ud, udd, work);
        evra_tree_base_regressor(u, ud, udd, rows);
        modeler_project(&platform_loops, G, rows, 90, phi);
    }
    return modeler_told(status, phi, 720);
}

/* Torques that move the closed robot so. */
int evra_platform_inverse_dynamics(const double *x, const double *xd, const double *xdd,
                                   const double *beta, double *MODELER_RESTRICT f)
{
    double G[208], ud[26], udd[26], rows[26];
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    if (modeler_finite(xd, 8) && modeler_finite(xdd, 8) && modeler_finite(beta, 90))
        status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_follow(&platform_loops, evra_tree_drift, u, xd, xdd, G, ud, udd, work);
        evra_tree_inverse_dynamics(u, ud, udd, beta, rows);
        modeler_project(&platform_loops, G, rows, 1, f);
    }
    return modeler_told(status, f, 8);
}

/* Closed posture, on a straight way from home. */
int evra_platform_close(const double *x, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, home, u, work);
    return modeler_told(status, u, 26);
}

/* Closed posture, on a straight way from another one, such as the last. */
int evra_platform_close_from(const double *x, const double *start, double *MODELER_RESTRICT u)
{
    double work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, start, u, work);
    return modeler_told(status, u, 26);
}

/* Speeds of the free variables; rows of the platform are its Jacobian. */
int evra_platform_coupling(const double *x, double *MODELER_RESTRICT G)
{
    double u[26], work[WORK];
    int status = MODELER_NOT_FINITE;

    status = modeler_close(&platform_loops, x, home, u, work);
    if (status == MODELER_CLOSED) {
        modeler_coupling(&platform_loops, G, work);
    }
    return modeler_told(status, G, 208);
}
