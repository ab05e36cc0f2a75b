/* Least squares on the fly under sanitizers: every set of instructions, threads, odd sizes. */
#include "modeler_fused.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JOINTS 3
#define SAMPLES 523

static const int row[] = {0, 0, 0, 0, 0, 1, 1, 1, 2};
enum { ENTRIES = sizeof row / sizeof *row };

static double q[SAMPLES * JOINTS], qd[SAMPLES * JOINTS], qdd[SAMPLES * JOINTS];
static double s[SAMPLES], tau[SAMPLES * JOINTS], weight[SAMPLES * JOINTS];
static unsigned char use[SAMPLES * JOINTS];

static void entries_signals(const double *a, const double *b, const double *c, const double *d,
                            double *values)
{
    for (int k = 0; k < ENTRIES; k++)
        values[k] = (k + 1) * a[k % JOINTS] + b[(k / 2) % JOINTS] * c[k % 2] + (k == 4) * d[0];
}

static void entries(const double *a, const double *b, const double *c, double *values)
{
    const double none = 0.0;
    entries_signals(a, b, c, &none, values);
}

static void tile(const double *a, const double *b, const double *c, const double *d, double *values)
{
    double one[ENTRIES];
    for (int lane = 0; lane < MODELER_LANES; lane++) {
        const int at = lane * JOINTS;
        entries_signals(a + at, b + at, c + at, d + lane, one);
        for (int k = 0; k < ENTRIES; k++)
            values[k * MODELER_LANES + lane] = one[k];
    }
}

static const modeler_source plain = {JOINTS, 0, ENTRIES, row, NULL, entries, NULL};
static const modeler_source reads = {JOINTS, 1, ENTRIES, row, NULL, NULL, entries_signals};
static const modeler_source tiled = {JOINTS, 1, ENTRIES, row, tile, NULL, NULL};

static void require(int good, const char *what)
{
    if (!good) {
        printf("wrong: %s\n", what);
        exit(1);
    }
}

static void fill(void)
{
    unsigned state = 7;
    double *arrays[] = {q, qd, qdd, tau, weight};
    for (int a = 0; a < 5; a++)
        for (int k = 0; k < SAMPLES * JOINTS; k++) {
            state = state * 1664525u + 1013904223u;
            arrays[a][k] = (double)state / 4294967296.0 - (a < 4 ? 0.5 : -0.1);
        }
    for (int k = 0; k < SAMPLES * JOINTS; k++)
        use[k] = (unsigned char)(k % 7 != 3);
    for (int k = 0; k < SAMPLES; k++)
        s[k] = k * 1e-3;
    tau[5 * JOINTS + 1] = NAN, use[5 * JOINTS + 1] = 0; /* out of use: may be anything */
    q[400 * JOINTS] = INFINITY;
}

/* Sum over the samples of x x^T of joint j, columns a and b. */
static double product(const modeler_source *source, int j, int a, int b, int weighted)
{
    int first = 0, count = 0;
    double one[ENTRIES], sum = 0.0;
    for (int k = 0; k < ENTRIES; k++) {
        first += row[k] < j;
        count += row[k] == j;
    }
    for (int i = 0; i < SAMPLES; i++) {
        const int at = i * JOINTS;
        const double none = 0.0;
        entries_signals(q + at, qd + at, qdd + at, source->signals ? s + i : &none, one);
        const double factor = weighted ? weight[at + j] : 1.0;
        const double left = factor * (a < count ? one[first + a] : tau[at + j]);
        const double right = factor * (b < count ? one[first + b] : tau[at + j]);
        sum += use[at + j] && i != 400 ? left * right : 0.0;
    }
    return sum;
}

static void check_state(const modeler_source *source, const double *state, int weighted)
{
    for (int j = 0; j < JOINTS; j++) {
        const int p = modeler_fused_size(source, j);
        int columns = 1;
        for (int k = 0; k < ENTRIES; k++)
            columns += row[k] == j;
        for (int a = 0; a < columns; a++)
            for (int b = a; b < columns; b++) {
                double sum = 0.0;
                for (int k = 0; k <= a; k++)
                    sum += state[k * p + a] * state[k * p + b];
                require(fabs(sum - product(source, j, a, b, weighted)) < 1e-9, "R^T R");
                require(b == a || state[b * p + a] == 0.0, "triangle");
            }
        state += p * p;
    }
}

static void check(const modeler_source *source, int level, int weighted)
{
    const size_t size = modeler_fused_state(source);
    const modeler_samples given = {q, qd, qdd, s, tau, use, weighted ? weight : NULL};
    double *state = calloc(size, sizeof *state), *other = calloc(size, sizeof *other);
    void *work = malloc(modeler_fused_work(source));
    unsigned char bad[SAMPLES];
    size_t rows[JOINTS] = {0}, expected[JOINTS] = {0}, half = 301;
    modeler_samples rest = given;
    rest.q += half * JOINTS, rest.qd += half * JOINTS, rest.qdd += half * JOINTS, rest.s += half;
    rest.tau += half * JOINTS, rest.use += half * JOINTS;
    rest.weight = weighted ? weight + half * JOINTS : NULL;

    require(modeler_fused_triangles(source, SAMPLES, &given, level, state, rows, bad, work) == 1,
            "one is left out");
    for (int i = 0; i < SAMPLES; i++) {
        require(bad[i] == (i == 400), "which is left out");
        for (int j = 0; j < JOINTS; j++)
            expected[j] += use[i * JOINTS + j] && i != 400;
    }
    require(memcmp(rows, expected, sizeof rows) == 0, "rows");
    check_state(source, state, weighted);

    memset(state, 0, size * sizeof *state);
    modeler_fused_triangles(source, half, &given, level, state, rows, NULL, work);
    modeler_fused_triangles(source, SAMPLES - half, &rest, level, other, rows, NULL, work);
    modeler_fused_merge(source, level, state, other, work);
    check_state(source, state, weighted);
    free(state), free(other), free(work);
}

static void check_rows(int level)
{
    const int column[] = {0, 2};
    const int p = modeler_rows_size(2);
    double *triangle = calloc((size_t)(p * p), sizeof *triangle), *work;
    modeler_rows given = {SAMPLES, JOINTS, JOINTS, JOINTS, 2, column, qd, tau, use};
    size_t added = 0, rows = 0;
    double sum = 0.0;
    work = malloc(modeler_rows_work(2));
    given.y = tau + 1, given.use = use + 1;
    require(modeler_rows_triangle(&given, level, triangle, &added, work) == 0, "rows left out");
    for (int i = 0; i < SAMPLES; i++)
        if (use[i * JOINTS + 1]) {
            sum += qd[i * JOINTS + 2] * tau[i * JOINTS + 1];
            rows++;
        }
    require(added == rows, "rows added");
    require(fabs(triangle[1] * triangle[2] + triangle[p + 1] * triangle[p + 2] - sum) < 1e-9,
            "triangle of rows");
    free(triangle), free(work);
}

/* Rows whose weight is on their first sample: as that sample, but for 400, which is no number. */
static void check_means(const modeler_source *source, int level)
{
    enum { WINDOW = 40 };
    static const double weights[WINDOW] = {1.0};
    const modeler_samples given = {q, qd, qdd, s, tau, NULL, NULL};
    int *start = malloc((SAMPLES + 1) * sizeof *start), count = 0;
    int *sample = malloc(SAMPLES * WINDOW * sizeof *sample);
    double *weight_of = malloc(SAMPLES * WINDOW * sizeof *weight_of);
    double *state = calloc(modeler_fused_state(source), sizeof *state);
    unsigned char usable[SAMPLES * JOINTS], used[SAMPLES * JOINTS];
    size_t rows[JOINTS] = {0};
    void *work = malloc(modeler_mean_work(source, WINDOW));
    memset(usable, 1, sizeof usable), memset(usable + 400 * JOINTS, 0, JOINTS);
    memcpy(used, use, sizeof used), memset(used + 400 * JOINTS, 0, JOINTS);
    for (int i = 0; i < SAMPLES; i++) {
        start[i] = count;
        for (int k = 0; k < WINDOW && i + k < SAMPLES; k++) {
            weight_of[count] = weights[k];
            sample[count++] = i + k;
        }
    }
    start[SAMPLES] = count;
    const modeler_means means = {SAMPLES,   JOINTS, 0,      start, sample, NULL,
                                 weight_of, NULL,   usable, NULL,  used};
    require(modeler_mean_triangles(source, &given, &means, WINDOW, level, state, rows, work) == 0,
            "means left out");
    check_state(source, state, 0);
    free(start), free(sample), free(weight_of), free(state), free(work);
}

static void *all(void *level)
{
    for (int weighted = 0; weighted < 2; weighted++) {
        check(&plain, *(int *)level, weighted);
        check(&reads, *(int *)level, weighted);
        check(&tiled, *(int *)level, weighted);
    }
    check_rows(*(int *)level);
    check_means(&plain, *(int *)level);
    check_means(&reads, *(int *)level);
    return NULL;
}

int main(void)
{
    int levels[] = {MODELER_BASELINE, MODELER_AVX2, MODELER_AVX512, 0};
    pthread_t threads[4];
    fill();
    for (int k = 0; k < 4; k++)
        require(pthread_create(threads + k, NULL, all, levels + k) == 0, "thread");
    for (int k = 0; k < 4; k++)
        pthread_join(threads[k], NULL);
    return 0;
}
