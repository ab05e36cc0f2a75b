#include "wrist_tile.c"
#include "wrist.h"
#include <math.h>

enum { N = WRIST_JOINTS, Z = WRIST_NONZEROS, SAMPLES = 13 };

int main(void)
{
    static double room[(Z + 1) * MODELER_LANES], q[SAMPLES * N], qd[SAMPLES * N], qdd[SAMPLES * N];
    double *const values = room + (8 - (size_t)room / 8 % 8) % 8;

    for (int i = 0; i < SAMPLES * N; i++) {
        q[i] = 3.0 * sin(1.0 + i);
        qd[i] = cos(3.0 * i);
        qdd[i] = 5.0 * cos(2.0 * i);
    }
    q[2 * N] = 1e7;
    for (size_t k = MODELER_BEST_VERSION; k < sizeof tiled / sizeof *tiled; k++) {
        tiled[k].tile(q, qd, qdd, NULL, values);
        for (int lane = 0; lane < 8; lane++) {
            double entries[Z], largest = 1.0;
            wrist_base_regressor_nonzeros(q + lane * N, qd + lane * N, qdd + lane * N, entries);
            for (int i = 0; i < Z; i++)
                largest = fmax(largest, fabs(entries[i]));
            for (int i = 0; i < Z; i++)
                if (!(fabs(values[i * 8 + lane] - entries[i]) <= 1.5e-14 * largest))
                    return 1 + (int)k;
        }
    }
    return 0;
}
