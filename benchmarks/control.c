/* Nanoseconds of an emitted module's functions for controllers and of a peer's, interleaved, in turn
 * ours first and the peer first, states in cache.
 *
 * Compile with -DHEADER, -DPREFIX, -DMACRO. Arguments: how often to measure, a file with chi, a model
 * for the peer, its shared library. Prints for each function its name, our shortest time, the peer's
 * (0 if it has none), and how far the outputs are apart, over the largest number.
 */
#define _GNU_SOURCE
#include HEADER

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define OURS(name) PASTE(PREFIX, _##name)
#define N PASTE(MACRO, _JOINTS)
#define P PASTE(MACRO, _STANDARD_PARAMETERS)
#define C PASTE(MACRO, _BASE_PARAMETERS)

enum { STATES = 64, CALLS = 256, FUNCTIONS = 20, LARGEST = N * C + 3 * N * N + 64 };

typedef double (*peer_function)(void *, int, const double *, const double *, const double *, double *);

static double q[STATES][N], qd[STATES][N], qdd[STATES][N], beta[C], out[LARGEST], theirs[LARGEST];
static volatile double sink;

static void inverse_dynamics(int k) { OURS(inverse_dynamics)(q[k], qd[k], qdd[k], beta, out); }
static void inertia_matrix(int k) { OURS(inertia_matrix)(q[k], beta, out); }
static void gravity(int k) { OURS(gravity)(q[k], beta, out); }
static void coriolis_matrix(int k) { OURS(coriolis_matrix)(q[k], qd[k], beta, out); }
static void coriolis_transpose(int k) { OURS(coriolis_transpose)(q[k], qd[k], beta, out); }
static void momentum(int k) { OURS(momentum)(q[k], qd[k], beta, out); }
static void pose(int k) { OURS(pose)(q[k], out); }
static void jacobian(int k) { OURS(jacobian)(q[k], out); }
static void jacobian_dot_qd(int k) { OURS(jacobian_dot_qd)(q[k], qd[k], out); }
static void twist(int k) { OURS(twist)(q[k], qd[k], out); }
static void derivatives(int k) { OURS(derivatives)(q[k], qd[k], qdd[k], beta, out); }
static void forward_dynamics(int k) { (void)OURS(forward_dynamics)(q[k], qd[k], qdd[k], beta, out); }
static void forward_derivatives(int k)
{
    (void)OURS(forward_derivatives)(q[k], qd[k], qdd[k], beta, out);
}
static void operational_inertia(int k)
{
    const double none[1] = {0.0};

    (void)OURS(operational_inertia)(q[k], beta, none, out);
}
static void slotine_li_regressor(int k)
{
    OURS(slotine_li_regressor)(q[k], qd[k], qd[(k + 1) % STATES], qdd[k], out);
}

static const struct {
    const char *name;
    void (*call)(int);
    int size;
} functions[] = {
    {"inverse_dynamics", inverse_dynamics, N},
    {"inertia_matrix", inertia_matrix, N * N},
    {"gravity", gravity, N},
    {"coriolis_matrix", coriolis_matrix, N * N},
    {"coriolis_transpose", coriolis_transpose, N},
    {"momentum", momentum, N},
    {"pose", pose, 12},
    {"jacobian", jacobian, 6 * N},
    {"jacobian_dot_qd", jacobian_dot_qd, 6},
    {"twist", twist, 6},
    {"derivatives", derivatives, 2 * N * N},
    {"forward_dynamics", forward_dynamics, N},
    {"forward_derivatives", forward_derivatives, 3 * N * N},
    {"operational_inertia", operational_inertia, 36},
    {"slotine_li_regressor", slotine_li_regressor, N * C},
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void keep(double *least, double start)
{
    const double each = (now() - start) / CALLS;

    if (*least == 0.0 || each < *least)
        *least = each;
}

int main(int argc, char **argv)
{
    enum { MANY = sizeof(functions) / sizeof(*functions) };
    static double chi[P], mine[MANY], other[MANY], apart[MANY];
    int which[MANY];
    FILE *const file = argc > 4 ? fopen(argv[2], "r") : NULL;
    void *const library = argc > 4 ? dlopen(argv[4], RTLD_NOW | RTLD_LOCAL) : NULL;
    int (*number)(const char *);
    peer_function call;
    void *(*made)(const char *);
    void *model;

    if (!file || !library)
        return 1;
    for (int k = 0; k < P; k++)
        if (fscanf(file, "%lf", &chi[k]) != 1)
            return 1;
    fclose(file);
    OURS(base_parameters)(chi, beta);
    *(void **)&made = dlsym(library, "peer_model");
    *(void **)&number = dlsym(library, "peer_which");
    *(void **)&call = dlsym(library, "peer_call");
    model = made(argv[3]);
    for (int k = 0; k < STATES; k++)
        for (int j = 0; j < N; j++) {
            q[k][j] = 4.0 * rand() / RAND_MAX - 2.0;
            qd[k][j] = 4.0 * rand() / RAND_MAX - 2.0;
            qdd[k][j] = 4.0 * rand() / RAND_MAX - 2.0;
        }
    for (int f = 0; f < MANY; f++) {
        double largest = 0.0;

        which[f] = number(functions[f].name);
        for (int i = 0; i < LARGEST; i++)
            out[i] = theirs[i] = 0.0;
        functions[f].call(1);
        if (which[f] < 0)
            continue;
        call(model, which[f], q[1], qd[1], qdd[1], theirs);
        for (int i = 0; i < functions[f].size; i++)
            largest = fmax(largest, fabs(theirs[i]));
        for (int i = 0; i < functions[f].size; i++)
            apart[f] = fmax(apart[f], fabs(out[i] - theirs[i]) / largest);
    }
    for (long round = 0; round < strtol(argv[1], NULL, 10); round++)
        for (int f = 0; f < MANY; f++)
            for (int turn = 0; turn < 2; turn++) {
                const double start = now();
                if ((turn + round) % 2 == 0) {
                    for (int i = 0; i < CALLS; i++) {
                        functions[f].call(i % STATES);
                        sink += out[0];
                    }
                    keep(&mine[f], start);
                } else if (which[f] >= 0) {
                    for (int i = 0; i < CALLS; i++)
                        sink += call(model, which[f], q[i % STATES], qd[i % STATES],
                                     qdd[i % STATES], NULL);
                    keep(&other[f], start);
                }
            }
    for (int f = 0; f < MANY; f++)
        printf("%s %g %g %g\n", functions[f].name, mine[f], other[f], apart[f]);
    return 0;
}
