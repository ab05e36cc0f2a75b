/* Statuses and evaluations of the closure equations of an emitted robot, LOOPS; lines of numbers in,
 * lines out. It includes the unit that closes the loops, whose closure it puts its own counters in. */
#include <stdio.h>
#include LOOPS

static long evaluations;

static void counted_closure(const double *u, double *values)
{
    evaluations++;
    loops.closure(u, values);
}

static void counted_residual(const double *u, double *f)
{
    evaluations++;
    loops.residual(u, f);
}

int main(void)
{
    modeler_closure own = loops;
    double q[sizeof(given) / sizeof(*given)], u[sizeof(home) / sizeof(*home)], work[WORK];
    int i = 0;

    own.closure = counted_closure;
    own.residual = counted_residual;
    while (scanf("%lf", &q[i]) == 1) {
        if (++i < own.given)
            continue;
        i = 0;
        evaluations = 0;
        const int status = modeler_close(&own, q, home, u, work);
        printf("%d %ld\n", status, evaluations);
    }
    printf("%d\n", MODELER_EVALUATIONS);
    return 0;
}
