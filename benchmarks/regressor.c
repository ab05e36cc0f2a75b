/* Nanoseconds per call of an emitted base regressor, states in cache; prints dense and compact.
 *
 * Compile with -DHEADER, -DPREFIX, -DMACRO; one argument: how often to measure.
 */
#define _POSIX_C_SOURCE 199309L
#include HEADER

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define JOINTS PASTE(MACRO, _JOINTS)

enum { STATES = 64, CALLS = 2048 };

static double q[STATES][JOINTS], qd[STATES][JOINTS], qdd[STATES][JOINTS];
static double phi[JOINTS * PASTE(MACRO, _BASE_PARAMETERS)], values[PASTE(MACRO, _NONZEROS)];

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static double random_number(void)
{
    return 4.0 * rand() / RAND_MAX - 2.0;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *numbers, size_t count)
{
    qsort(numbers, count, sizeof *numbers, ascending);
    return numbers[count / 2];
}

int main(int argc, char **argv)
{
    const size_t rounds = argc > 1 ? strtoul(argv[1], NULL, 10) : 15;
    double *dense = malloc(rounds * sizeof *dense), *compact = malloc(rounds * sizeof *compact);
    double sum = 0;

    if (!rounds || !dense || !compact) return 1;
    for (int i = 0; i < STATES; i++)
        for (int j = 0; j < JOINTS; j++) {
            q[i][j] = random_number();
            qd[i][j] = random_number();
            qdd[i][j] = random_number();
        }
    for (size_t round = 0; round < rounds; round++) {
        double start = now();
        for (int i = 0; i < CALLS; i++) {
            PASTE(PREFIX, _base_regressor)(q[i % STATES], qd[i % STATES], qdd[i % STATES], phi);
            sum += phi[0];
        }
        dense[round] = (now() - start) / CALLS;
        start = now();
        for (int i = 0; i < CALLS; i++) {
            PASTE(PREFIX, _base_regressor_nonzeros)(q[i % STATES], qd[i % STATES], qdd[i % STATES],
                                                    values);
            sum += values[0];
        }
        compact[round] = (now() - start) / CALLS;
    }
    fprintf(stderr, "%g\n", sum); /* so that the calls are not left out */
    printf("%g %g\n", median(dense, rounds), median(compact, rounds));
    return 0;
}
