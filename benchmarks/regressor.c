/* Nanoseconds per sample of an emitted base regressor and of peers, interleaved, states in cache.
 *
 * Compile with -DHEADER, -DPREFIX, -DMACRO, with -DTILED=HEADER where there is a tile. Arguments:
 * how often to measure, a model for the peers, then their shared libraries. Prints for each way its
 * name and the shortest time.
 */
#define _GNU_SOURCE
#include HEADER
#ifdef TILE_HEADER
#include TILE_HEADER
#endif

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define JOINTS PASTE(MACRO, _JOINTS)

enum { STATES = 64, CALLS = 1024, MOST = 8, LANES = 8 };

typedef double (*peer_regressor)(void *, const double *, const double *, const double *, double *);
typedef void *(*peer_model)(const char *);

static double q[STATES][JOINTS], qd[STATES][JOINTS], qdd[STATES][JOINTS];
static double phi[JOINTS * PASTE(MACRO, _BASE_PARAMETERS)], values[PASTE(MACRO, _NONZEROS)];
static double block[LANES * PASTE(MACRO, _NONZEROS)] __attribute__((aligned(64)));
static double least[3 + MOST];
static volatile double sink;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void keep(int way, double start)
{
    const double each = (now() - start) / CALLS;

    if (least[way] == 0.0 || each < least[way])
        least[way] = each;
}

static double ours(void)
{
    double sum = 0.0, start = now();

    for (int i = 0; i < CALLS; i++) {
        PASTE(PREFIX, _base_regressor)(q[i % STATES], qd[i % STATES], qdd[i % STATES], phi);
        sum += phi[0];
    }
    keep(0, start);
    start = now();
    for (int i = 0; i < CALLS; i++) {
        PASTE(PREFIX, _base_regressor_nonzeros)(q[i % STATES], qd[i % STATES], qdd[i % STATES],
                                                values);
        sum += values[0];
    }
    keep(1, start);
#ifdef TILE_HEADER
    const modeler_tiled *const tiled = PASTE(PREFIX, _tiled)();
    start = now();
    for (int i = 0; i < CALLS; i += LANES) {
        const int k = i % STATES;
        tiled->tile(q[k], qd[k], qdd[k], NULL, block);
        sum += block[0];
    }
    keep(2, start);
#endif
    return sum;
}

static double peer(int way, peer_regressor regressor, void *model)
{
    double sum = 0.0;
    const double start = now();

    for (int i = 0; i < CALLS; i++)
        sum += regressor(model, q[i % STATES], qd[i % STATES], qdd[i % STATES], NULL);
    keep(way, start);
    return sum;
}

int main(int argc, char **argv)
{
    const long rounds = argc > 1 ? strtol(argv[1], NULL, 10) : 15;
    const int peers = argc > 3 ? (argc - 3 < MOST ? argc - 3 : MOST) : 0;
    peer_regressor regressors[MOST];
    void *models[MOST];

    for (int k = 0; k < peers; k++) {
        void *const library = dlopen(argv[3 + k], RTLD_NOW | RTLD_LOCAL);
        peer_model model;
        if (!library) {
            fprintf(stderr, "%s\n", dlerror());
            return 1;
        }
        *(void **)&model = dlsym(library, "peer_model");
        *(void **)&regressors[k] = dlsym(library, "peer_regressor");
        models[k] = model(argv[2]);
        if (!models[k] || !regressors[k])
            return 1;
    }
    for (int i = 0; i < STATES; i++)
        for (int j = 0; j < JOINTS; j++) {
            q[i][j] = 4.0 * rand() / RAND_MAX - 2.0;
            qd[i][j] = 4.0 * rand() / RAND_MAX - 2.0;
            qdd[i][j] = 4.0 * rand() / RAND_MAX - 2.0;
        }
    for (long round = 0; round < rounds; round++) {
        sink += ours();
        for (int k = 0; k < peers; k++)
            sink += peer(3 + k, regressors[k], models[k]);
    }
    printf("scalar %g\nnonzeros %g\ntile %g\n", least[0], least[1], least[2]);
    for (int k = 0; k < peers; k++)
        printf("%s %g\n", argv[3 + k], least[3 + k]);
    return 0;
}
