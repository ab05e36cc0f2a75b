/* Tests of csrc/: loops over samples. Ends with the number of failed checks. */
#include "modeler_batch.h"

#include <stdio.h>
#include <stdlib.h>

static int failures = 0;

#define CHECK(condition)                                              \
    do {                                                              \
        if (!(condition)) {                                           \
            printf("line %d: %s\n", __LINE__, #condition);            \
            failures++;                                               \
        }                                                             \
    } while (0)

static void one(const double *a, double *out)
{
    out[0] = a[1] - a[0];
    out[1] = 3*a[0];
}

/* Two values per sample, so that steps of one would be noticed. */
static void two(const double *a, const double *b, double *out)
{
    out[0] = a[0] + 10*b[0];
    out[1] = a[1] - b[0];
}

static void three(const double *a, const double *b, const double *c, double *out)
{
    out[0] = a[0] + 10*b[0] + 100*c[0];
}

static void four(const double *a, const double *b, const double *c, const double *d, double *out)
{
    out[0] = a[0] + 10*b[0] + 100*c[0] + 1000*d[0];
}

static void never(const double *a, const double *b, double *out)
{
    (void)a, (void)b, (void)out;
    abort();
}

/* Exactly as long as needed: the address sanitizer sees every step too far. */
static double *numbers(size_t count, double first)
{
    double *made = malloc(count * sizeof *made);
    if (!made) abort();
    for (size_t i = 0; i < count; i++) made[i] = first + (double)i;
    return made;
}

int main(void)
{
    const size_t samples = 5;
    double *a = numbers(2*samples, 0), *b = numbers(samples, 100), *shared = numbers(1, 7);
    double *out = numbers(2*samples, -1);

    const modeler_input single[1] = {{a, 2}};
    modeler_batch_1(one, samples, single, out, 2);
    for (size_t i = 0; i < samples; i++) {
        CHECK(out[2*i] == 1);
        CHECK(out[2*i + 1] == 6*(double)i);
    }

    const modeler_input pair[2] = {{a, 2}, {b, 1}};
    modeler_batch_2(two, samples, pair, out, 2);
    for (size_t i = 0; i < samples; i++) {
        CHECK(out[2*i] == 2*(double)i + 10*(100 + (double)i));
        CHECK(out[2*i + 1] == 2*(double)i + 1 - (100 + (double)i));
    }

    const modeler_input triple[3] = {{b, 1}, {shared, 0}, {a, 2}};
    modeler_batch_3(three, samples, triple, out, 1);
    for (size_t i = 0; i < samples; i++)
        CHECK(out[i] == 100 + (double)i + 70 + 200*(double)i);

    const modeler_input quadruple[4] = {{b, 1}, {a, 2}, {b, 1}, {shared, 0}};
    modeler_batch_4(four, samples, quadruple, out, 2);
    for (size_t i = 0; i < samples; i++)
        CHECK(out[2*i] == (100 + (double)i)*101 + 20*(double)i + 7000);

    modeler_batch_2(never, 0, pair, out, 2);

    free(a), free(b), free(shared), free(out);
    return failures;
}
