/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * torques that are computed in three ways agree. Prints one line; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "evra.h"

#define N EVRA_JOINTS
#define C EVRA_BASE_PARAMETERS
#define STATES 5
#define TOLERANCE 1e-9 /* of the sum of the sizes of what is added up */

/* A posture in which the loops close; the others lie near it. */
static const double home[N] = { 0.0, 0.0, 0.8067, 0.8067, 0.8067, 0.8067, 0.8067, 0.8067 };
#define SPREAD 0.01

/* Largest difference of the three torques, relative; above 1 if they are not to be had. */
static double difference(int state)
{
    double q[N], qd[N], qdd[N], beta[C], phi[N * C], M[N * N], tau[N], g[N], c[N], f[N];
    const double at = (double)state;
    double worst = 0.0;
    int status = 0;

    for (int i = 0; i < N; i++) {
        const double own = (double)i;

        q[i] = home[i] + SPREAD * at * sin(1.0 + own);
        qd[i] = (i % 2 ? -1.0 : 1.0) * (1.0 + 0.1 * own + 0.2 * at);
        qdd[i] = 3.0 * cos(2.0 * own + at);
    }
    for (int k = 0; k < C; k++)
        beta[k] = 1.0 + 0.1 * (double)k;
    status |= evra_base_regressor(q, qd, qdd, phi);
    status |= evra_inverse_dynamics(q, qd, qdd, beta, tau);
    status |= evra_inertia_matrix(q, beta, M);
    status |= evra_gravity(q, beta, g);
    status |= evra_coriolis(q, qd, beta, c);
    status |= evra_friction(q, qd, beta, f);
    if (status != 0)
        return 2.0;
    for (int i = 0; i < N; i++) {
        double linear = 0.0, parts = g[i] + c[i] + f[i];
        double size = fabs(g[i]) + fabs(c[i]) + fabs(f[i]) + fabs(tau[i]);

        for (int k = 0; k < C; k++) {
            linear += phi[i * C + k] * beta[k];
            size += fabs(phi[i * C + k] * beta[k]);
        }
        for (int k = 0; k < N; k++) {
            parts += M[i * N + k] * qdd[k];
            size += fabs(M[i * N + k] * qdd[k]);
        }
        const double apart = fabs(linear - tau[i]) + fabs(parts - tau[i]);
        if (!(apart <= TOLERANCE * size))
            return 1.0; /* NaN too */
        if (apart > worst * size)
            worst = apart / size;
    }
    return worst;
}

int main(void)
{
    double worst = 0.0;
    const char *const signature = evra_signature();

    if (strcmp(signature, EVRA_SIGNATURE) != 0) {
        printf("evra: the library is %s,\n", signature);
        printf("the header %s\n", EVRA_SIGNATURE);
        return 1;
    }
    for (int state = 0; state < STATES; state++) {
        const double found = difference(state);

        if (found > 1.0 && state > 0)
            break; /* does not reach so far */
        worst = fmax(worst, found);
    }
    printf("evra %s:\n", signature);
    if (worst > TOLERANCE) {
        printf("three ways to the torques do not agree; other compiler flags?\n");
        return 1;
    }
    printf("three ways to the torques agree to %.1e\n", worst);
    return 0;
}
