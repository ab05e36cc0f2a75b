/* SR400, 6R arm with a parallelogram
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * torques that are computed in three ways agree. Prints one line; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "sr400.h"
#include "sr400_tile.h"

#define N SR400_JOINTS
#define C SR400_BASE_PARAMETERS
#define STATES 5
#define TOLERANCE 1e-9 /* of the sum of the sizes of what is added up */

static const double home[N] = {0.0};
#define SPREAD 0.7

/* Largest difference of the three torques, relative; above 1 if they are not to be had. */
static double difference(int state)
{
    double q[N], qd[N], qdd[N], beta[C], phi[N * C], M[N * N], tau[N], g[N], c[N], f[N];
    const double at = (double)state;
    double worst = 0.0;

    for (int i = 0; i < N; i++) {
        const double own = (double)i;

        q[i] = home[i] + SPREAD * at * sin(1.0 + own);
        qd[i] = (i % 2 ? -1.0 : 1.0) * (1.0 + 0.1 * own + 0.2 * at);
        qdd[i] = 3.0 * cos(2.0 * own + at);
    }
    for (int k = 0; k < C; k++)
        beta[k] = 1.0 + 0.1 * (double)k;
    sr400_base_regressor(q, qd, qdd, phi);
    sr400_inverse_dynamics(q, qd, qdd, beta, tau);
    sr400_inertia_matrix(q, beta, M);
    sr400_gravity(q, beta, g);
    sr400_coriolis(q, qd, beta, c);
    sr400_friction(qd, beta, f);
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

/* Largest difference of a tile from the same entries one sample after another, relative to the
 * largest of the sample. */
static double tile_difference(void)
{
    static double room[(SR400_NONZEROS + 1) * MODELER_LANES];
    const size_t past = (uintptr_t)room / sizeof(double) % MODELER_LANES;
    double *const values = room + (MODELER_LANES - past) % MODELER_LANES;
    double q[MODELER_LANES * N], qd[MODELER_LANES * N], qdd[MODELER_LANES * N];
    double entries[SR400_NONZEROS], worst = 0.0;

    for (int i = 0; i < MODELER_LANES * N; i++) {
        q[i] = 0.7 * sin(1.0 + i);
        qd[i] = 2.0 * cos(3.0 * i);
        qdd[i] = 3.0 * cos(2.0 * i);
    }
    sr400_tiled()->tile(q, qd, qdd, NULL, values);
    for (int lane = 0; lane < MODELER_LANES; lane++) {
        double largest = 0.0, apart = 0.0;

        sr400_base_regressor_nonzeros(q + lane * N, qd + lane * N, qdd + lane * N,
entries);
        for (int k = 0; k < SR400_NONZEROS; k++) {
            largest = fmax(largest, fabs(entries[k]));
            apart = fmax(apart, fabs(values[k * MODELER_LANES + lane] - entries[k]));
        }
        if (!(apart <= worst * largest))
            worst = apart / largest;
    }
    return worst;
}

int main(void)
{
    double worst = 0.0;
    const char *const signature = sr400_signature();

    if (strcmp(signature, SR400_SIGNATURE) != 0) {
        printf("sr400: the library is %s,\n", signature);
        printf("the header %s\n", SR400_SIGNATURE);
        return 1;
    }
    for (int state = 0; state < STATES; state++) {
        const double found = difference(state);

        worst = fmax(worst, found);
    }
    printf("sr400 %s:\n", signature);
    if (strcmp(sr400_tile_signature(), signature) != 0
        || !(tile_difference() <= TOLERANCE)) {
        printf("tiles do not agree with single samples; other files or compiler flags?\n");
        return 1;
    }
    if (worst > TOLERANCE) {
        printf("three ways to the torques do not agree; other compiler flags?\n");
        return 1;
    }
    printf("three ways to the torques agree to %.1e\n", worst);
    return 0;
}
