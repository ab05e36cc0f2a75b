/* Nanoseconds per sample of an emitted tile, states in cache: -DTILE_HEADER, -DPREFIX, -DMACRO. */
#define _GNU_SOURCE
#include HEADER
#include TILE_HEADER

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)

enum { N = PASTE(MACRO, _JOINTS), STATES = 64, SAMPLES = 1024 };

static modeler_real q[STATES * N], qd[STATES * N], qdd[STATES * N];
static modeler_real values[MODELER_LANES * PASTE(MACRO, _NONZEROS)] __attribute__((aligned(64)));

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

int main(int argc, char **argv)
{
    const long rounds = argc > 1 ? strtol(argv[1], NULL, 10) : 15;
    const modeler_tiled *const robot = PASTE(PREFIX, _tiled)();
    double least = 1e9;
    volatile modeler_real sink = 0;

    for (int i = 0; i < STATES * N; i++) {
        q[i] = (modeler_real)(4.0 * rand() / RAND_MAX - 2.0);
        qd[i] = (modeler_real)(4.0 * rand() / RAND_MAX - 2.0);
        qdd[i] = (modeler_real)(4.0 * rand() / RAND_MAX - 2.0);
    }
    for (long round = 0; round < rounds; round++) {
        const double start = now();
        for (int i = 0; i < SAMPLES; i += MODELER_LANES) {
            const int k = i % STATES * N;
            robot->tile(q + k, qd + k, qdd + k, NULL, values);
            sink += values[0];
        }
        const double each = (now() - start) / SAMPLES;
        least = each < least ? each : least;
    }
    printf("%g\n", least);
    return 0;
}
