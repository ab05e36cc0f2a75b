/* Statuses and evaluations of the closure equations of an emitted robot; lines of numbers in, lines
 * out. TREE is its header of what closes the loops, TABLE the loops, HOME and POSTURE
 * of it, MOST how many evaluations a call makes. */
#include <stdio.h>
#include TREE

static long evaluations;

static void counted_closure(const double *u, double *values)
{
    evaluations++;
    TABLE.closure(u, values);
}

static void counted_residual(const double *u, double *f)
{
    evaluations++;
    TABLE.residual(u, f);
}

int main(void)
{
    static struct POSTURE p;
    modeler_closure own = TABLE;
    double q[sizeof(p.qd) / sizeof(*p.qd)];
    int i = 0;

    own.closure = counted_closure;
    own.residual = counted_residual;
    while (scanf("%lf", &q[i]) == 1) {
        if (++i < own.given)
            continue;
        i = 0;
        evaluations = 0;
        const int status = POSED(&own, q, HOME, &p);
        printf("%d %ld\n", status, evaluations);
    }
    printf("%d\n", MOST);
    return 0;
}
