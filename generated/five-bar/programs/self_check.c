/* Planar five-bar, two actuated joints at the base
 *
 * Checks the library as it was compiled for this machine: header and library belong together, and
 * every function gives at stored states what the equations of motion give there, evaluated with 40
 * digits and not by this code. Prints what differs and one line more; returns 0 if all is well.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "five_bar.h"
#include "five_bar_batch.h"
#include "modeler_batch.h"
#include "modeler_closure.h"
#include "five_bar_tree.h"
#include "modeler_sincos.h"
#include "modeler_solve.h"
#include "five_bar_tile.h"

#define N 2
#define C 11
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if FIVE_BAR_JOINTS != N || FIVE_BAR_BASE_PARAMETERS != C \
    || FIVE_BAR_STANDARD_PARAMETERS != 40
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef FIVE_BAR_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L0
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L1
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef FIVE_BAR_GEO_L4
#undef REPLACED
#define REPLACED 1
#endif
#define WIDE 0

/* A closure whose answers are known: a = u[0] and b = u[3] are given, and
 *     p = u[4] = sqrt(a^2 - gap^2),  r = u[1] = b/p,  s = u[2] = a b + r^2;
 * there is none where |a| < gap. A fourth equation follows from the others; `wrong` is added. */
enum { UNKNOWNS = 5, SOLVED = 3, GIVEN = 2, LENGTH = 14, FACTORS = 5, COUPLINGS = 5, MOST = 5000 };
static int failed;
static void compare(const char *name, const double *given, const double *expected, int states,
                    int length, double tolerance);
static modeler_real gap, wrong;
static int evaluations;

static void known_residual(const modeler_real *u, modeler_real *f)
{
    evaluations++;
    f[0] = u[4] * u[4] - u[0] * u[0] + gap * gap;
    f[1] = u[1] * u[4] - u[3];
    f[2] = u[2] - u[0] * u[3] - u[1] * u[1];
}

static void known_closure(const modeler_real *u, modeler_real *values)
{
    const modeler_real J[] = {
        MODELER_REAL(-2.0) * u[0], MODELER_REAL(2.0) * u[4], u[4], MODELER_REAL(-1.0), u[1],
        -u[3], MODELER_REAL(-2.0) * u[1], MODELER_REAL(1.0), -u[0]
    };

    known_residual(u, values);
    values[3] = (u[2] - u[0] * u[3]) * u[4] * u[4] - u[3] * u[3] + wrong;
    values[4] = u[4];
    memcpy(values + 5, J, sizeof(J));
}

static void known_factor(const modeler_real *J, modeler_real *lu)
{
    lu[0] = 1 / J[2];
    lu[1] = 1 / J[7];
    lu[2] = 1 / J[1];
    lu[3] = J[6];
    lu[4] = J[4];
}

static void known_solve(const modeler_real *lu, const modeler_real *right, modeler_real *x)
{
    x[2] = right[0] * lu[2];
    x[0] = (right[1] - lu[4] * x[2]) * lu[0];
    x[1] = (right[2] - lu[3] * x[0]) * lu[1];
}

static void known_coupling(const modeler_real *J, const modeler_real *lu, modeler_real *G)
{
    G[0] = -J[0] * lu[2];
    G[1] = -lu[4] * G[0] * lu[0];
    G[2] = -J[3] * lu[0];
    G[3] = -(J[5] + lu[3] * G[1]) * lu[1];
    G[4] = -(J[8] + lu[3] * G[2]) * lu[1];
}

static const modeler_real known_scale[UNKNOWNS] = {1, 1, 2, MODELER_REAL(0.5), 1};
static const int known_given[GIVEN] = {0, 3}, known_solved[SOLVED] = {1, 2, 4};

/* J^-1 (K - J) in scaled variables. */
static void known_change(const modeler_real *J, const modeler_real *K, const modeler_real *lu,
                         modeler_real A[SOLVED][SOLVED])
{
    const modeler_real right[SOLVED][SOLVED] = {
        {0, K[2] - J[2], K[6] - J[6]}, {0, 0, K[7] - J[7]}, {K[1] - J[1], K[4] - J[4], 0}
    };

    for (int j = 0; j < SOLVED; j++) {
        modeler_real x[SOLVED];

        known_solve(lu, right[j], x);
        for (int i = 0; i < SOLVED; i++) {
            A[i][j] = x[i] * known_scale[known_solved[j]] / known_scale[known_solved[i]];
        }
    }
}

static void known_turned(const modeler_real *J, const modeler_real *K, const modeler_real *lu,
                         modeler_real *x)
{
    modeler_real A[SOLVED][SOLVED];

    known_change(J, K, lu, A);
    for (int i = 0; i < SOLVED; i++) {
        x[i] = modeler_fabs(A[i][0]) + modeler_fabs(A[i][1]) + modeler_fabs(A[i][2]);
    }
}

static void known_spread(const modeler_real *J, const modeler_real *K, const modeler_real *lu,
                         modeler_real *sum)
{
    modeler_real A[SOLVED][SOLVED];

    known_change(J, K, lu, A);
    *sum = 0;
    for (int k = 0; k < SOLVED * SOLVED; k++) {
        *sum += A[k / SOLVED][k % SOLVED] * A[k / SOLVED][k % SOLVED];
    }
}

static void known_drift(const modeler_real *u, const modeler_real *ud, modeler_real *values)
{
    (void)u;
    values[0] = MODELER_REAL(2.0) * (ud[4] * ud[4] - ud[0] * ud[0]);
    values[1] = MODELER_REAL(2.0) * ud[1] * ud[4];
    values[2] = MODELER_REAL(-2.0) * (ud[0] * ud[3] + ud[1] * ud[1]);
}

static void known_posture(modeler_real a, modeler_real b, modeler_real *u)
{
    u[0] = a;
    u[3] = b;
    u[4] = modeler_sqrt(a * a - gap * gap);
    u[1] = b / u[4];
    u[2] = a * b + u[1] * u[1];
}

static modeler_kept known_kept;
static int known_places[MODELER_CLOSURE_PLACES(UNKNOWNS, SOLVED)];
static modeler_real known_numbers[MODELER_CLOSURE_NUMBERS(UNKNOWNS, SOLVED, LENGTH, FACTORS)];

/* The closure, its equations solved in one order, or densely: all pivots too small, or one. */
static modeler_closure known_loops(int dense)
{
    static const int row[] = {0, 0, 1, 1, 1, 2, 2, 2, 2}, column[] = {0, 4, 1, 3, 4, 0, 1, 2, 3};
    static const modeler_real limits[][SOLVED] = {
        {100, 100, 100}, {0, 0, 0}, {0, 100, 100}, {100, 0, 100}, {100, 100, 0}
    };
    static const int coupling_row[] = {4, 1, 1, 2, 2}, coupling_column[] = {0, 0, 1, 0, 1};
    const modeler_closure loops = {
        UNKNOWNS, GIVEN, SOLVED, known_given, known_solved, known_scale, 4, 1,
        1e-9, 9, row, column, LENGTH, known_closure, known_residual, FACTORS, limits[dense],
        known_factor, known_solve, COUPLINGS, coupling_row, coupling_column, known_coupling,
        known_turned, known_spread
    };

    return loops;
}

static modeler_work known_work(int most)
{
    modeler_work work;

    work.kept = &known_kept;
    work.places = known_places;
    work.numbers = known_numbers;
    work.evaluations = most;
    return work;
}

static void expect(const char *what, int holds)
{
    if (!holds && !failed) {
        printf("closing loops: %s\n", what);
    }
    failed |= !holds;
}

/* Status of closing from (a, b) to (c, d), with at most so many evaluations; the posture must be
 * the known one, or stay where it was. */
static int known_way(const modeler_closure *loops, const modeler_real *way, int most)
{
    const modeler_work work = known_work(most);
    const modeler_real *const limits = loops->limits;
    modeler_real u[UNKNOWNS], expected[UNKNOWNS];
    int status;

    known_posture(way[0], way[1], u);
    memcpy(expected, u, sizeof(u));
    evaluations = 0;
    status = modeler_close(loops, way + 2, u, u, &work);
    if (status == MODELER_CLOSED) {
        known_posture(way[2], way[3], expected);
    }
    compare("closing", u, expected, 1, UNKNOWNS, 1e-12);
    expect("more evaluations than allowed", evaluations <= most);
    expect("rows exchanged where a pivot is small",
           status != MODELER_CLOSED || known_kept.dense[known_kept.at] ==
                                           (limits[0] + limits[1] + limits[2] < 300));
    return status;
}

/* Evaluations of a way in `steps`, around a circle or straight, as fast as `soon` says. */
static int known_steps(const modeler_closure *loops, int steps, modeler_real length, int straight,
                       int soon)
{
    const modeler_work work = known_work(MOST);
    modeler_real way[4] = {1, MODELER_REAL(0.2), 1, MODELER_REAL(0.2)};
    modeler_real u[UNKNOWNS], expected[UNKNOWNS], x = 1, y = 0;

    expect("a posture that is closed", known_way(loops, way, MOST) == MODELER_CLOSED);
    known_posture(way[0], way[1], u);
    evaluations = 0;
    for (int k = 0; k < steps; k++) {
        const modeler_real size = straight != 0 && k % 3 == 2 ? MODELER_REAL(0.6) * length : length;

        way[2] += size * x;
        way[3] += size * y;
        if (straight == 0) { /* turns by some degrees: (x, y) stays about as long */
            x -= MODELER_REAL(0.15) * y;
            y += MODELER_REAL(0.15) * x;
        }
        expect("a short step", (soon != 0 ? modeler_close_soon : modeler_close_next)(
                                   loops, way + 2, u, &work) == MODELER_CLOSED);
        known_posture(way[2], way[3], expected);
        compare("closing in steps", u, expected, 1, UNKNOWNS, 1e-12);
    }
    return evaluations;
}

/* Where loops close, where they must not, and after how many evaluations. */
static void check_ways(int dense)
{
    static const modeler_real near[] = {0.8, 0.3, 1.3, -0.2};
    static const modeler_real fold[] = {0.8, 0.3, 0.2, 0.3};
    static const modeler_real across[] = {0.8, 0.3, -0.8, 0.3};
    static const modeler_real leap[] = {0.13, 0.01, -0.13, 0.01};
    static const modeler_real wide[] = {1, 0.2, 2.5, 1.5};
    static const modeler_real far[] = {1, 0, 1e6, 0};
    static const modeler_real tight[] = {0.8, 0.1, 0.31, 0.1};
    static const int counts[8] = { 21, 35, 822, 312, 255, 120, 60, 59 };
    const modeler_closure loops = known_loops(dense);
    const modeler_work work = known_work(MOST);
    modeler_real u[UNKNOWNS], target[GIVEN];
    int found[8], needed;

    gap = MODELER_REAL(0.3);
    for (int k = 0; k < SOLVED; k++) {
        const modeler_closure one_small = known_loops(2 + k);

        expect("a small pivot", known_way(&one_small, near, MOST) == MODELER_CLOSED);
    }
    expect("a way that is free", known_way(&loops, near, MOST) == MODELER_CLOSED);
    needed = evaluations;
    found[0] = needed;
    for (int most = 0; most < needed; most++) {
        expect("a bound", known_way(&loops, near, most) == MODELER_UNFINISHED);
    }
    expect("a bound that does", known_way(&loops, near, needed) == MODELER_CLOSED);
    expect("a way too far", known_way(&loops, far, 100) == MODELER_UNFINISHED && evaluations < 4);
    expect("a way to nowhere", known_way(&loops, fold, MOST) != MODELER_CLOSED);
    expect("a way across a gap", known_way(&loops, across, MOST) != MODELER_CLOSED);
    expect("nothing after it", modeler_close_next(&loops, near, u, &work) == MODELER_OPEN);
    expect("a way to a narrow place", known_way(&loops, tight, MOST) == MODELER_CLOSED);
    found[2] = evaluations;
    expect("a long way", known_way(&loops, wide, MOST) == MODELER_CLOSED);
    found[1] = evaluations;
    gap = MODELER_REAL(0.05);
    expect("a leap to another mode", known_way(&loops, leap, MOST) != MODELER_CLOSED);
    gap = MODELER_REAL(0.3);
    wrong = 10 * loops.tolerance;
    expect("an equation that follows", known_way(&loops, near, MOST) == MODELER_OPEN);
    wrong = MODELER_REAL(0.3) * loops.tolerance;
    expect("its tolerance", known_way(&loops, near, MOST) == MODELER_CLOSED);
    wrong = 0;
    found[3] = known_steps(&loops, 40, MODELER_REAL(0.02), 0, 0);
    found[4] = known_steps(&loops, 40, MODELER_REAL(0.02), 1, 0);
    found[5] = known_steps(&loops, 40, MODELER_REAL(0.02), 1, 1);
    found[6] = known_steps(&loops, 12, MODELER_REAL(0.08), 1, 0);
    found[7] = known_steps(&loops, 12, MODELER_REAL(0.2), 0, 1);
    for (int k = 0; k < 8; k++) {
        const int apart = found[k] - counts[k];

        if (apart < -2 || apart > 2) {
            printf("closing loops: way %d takes %d evaluations, expected %d\n", k, found[k],
                   counts[k]);
            failed = 1;
        }
    }
    /* An axis that points the other way; a singular posture; what is not finite. */
    known_posture(near[0], near[1], u);
    u[4] = -u[4];
    u[1] = -u[1];
    expect("an axis turned", modeler_close(&loops, near + 2, u, u, &work) == MODELER_OPEN);
    known_posture(gap + 5e-5, MODELER_REAL(0.001), u);
    target[0] = u[0];
    target[1] = u[3];
    expect("an axis that is nearly at a right angle",
           modeler_close(&loops, target, u, u, &work) == MODELER_CLOSED);
    memset(u, 0, sizeof(u));
    u[0] = gap;
    expect("a singular posture", modeler_close(&loops, near, u, u, &work) == MODELER_SINGULAR);
    known_posture(near[0], near[1], u);
    for (int k = 0; k < UNKNOWNS; k++) {
        const modeler_real before = u[k];

        u[k] = NAN;
        expect("a start that is none",
               modeler_close(&loops, near, u, u, &work) == MODELER_NOT_FINITE);
        u[k] = before;
    }
    for (int k = 0; k < GIVEN; k++) {
        memcpy(target, near, sizeof(target));
        target[k] = INFINITY;
        expect("a target that is none",
               modeler_close(&loops, target, u, u, &work) == MODELER_NOT_FINITE);
        expect("the next one", modeler_close_next(&loops, target, u, &work) == MODELER_NOT_FINITE);
    }
}

/* Speeds, accelerations and forces that a closed posture carries over. */
static void check_motion(int dense)
{
    static const modeler_real way[] = {0.8, 0.3, 0.9, 0.4};
    static const modeler_real speed[] = {0.7, -1.1}, pull[] = {2, -3};
    const modeler_closure loops = known_loops(dense);
    const modeler_work work = known_work(MOST);
    const modeler_real *values, *lu, *nonzeros;
    modeler_real u[UNKNOWNS], G[UNKNOWNS * GIVEN], ud[UNKNOWNS], gamma[UNKNOWNS], udd[UNKNOWNS];
    modeler_real rate[UNKNOWNS * GIVEN], forces[GIVEN * GIVEN], square[GIVEN * GIVEN];

    gap = MODELER_REAL(0.3);
    expect("a short way", known_way(&loops, way, MOST) == MODELER_CLOSED);
    known_posture(way[2], way[3], u);
    expect("what was eliminated",
           modeler_eliminated(&loops, &work, &values, &lu, &nonzeros) == (dense == 0));
    {
        const modeler_real a = u[0], b = u[3], r = u[1], p = u[4], v = speed[0], w = speed[1];
        const modeler_real right[] = {1, 0, -r * a / p / p, 1 / p, b - 2 * r * r * a / p / p,
                                      a + 2 * r / p, 0, 1, a / p, 0};
        const modeler_real ps = a * v / p, rs = right[2] * v + w / p; /* speeds of p and r */
        const modeler_real ap = (v * p - a * ps) / p / p;             /* d/dt a/p */
        const modeler_real ra = (rs * a / p + r * ap) / p - r * a * ps / p / p / p;
        const modeler_real rates[] = {0, 0, -ra, -ps / p / p, w - 2 * (rs * r * a / p / p + r * ra),
                                      v + 2 * (rs - r * ps / p) / p, 0, 0, ap, 0};

        for (int k = 0; k < UNKNOWNS * GIVEN; k++) {
            G[k] = NAN;
            rate[k] = NAN;
        }
        for (int k = 0; k < UNKNOWNS; k++) {
            ud[k] = NAN;
            gamma[k] = NAN;
            udd[k] = NAN;
        }
        for (int k = 0; k < GIVEN * GIVEN; k++) {
            forces[k] = NAN;
        }
        modeler_coupling(&loops, G, &work);
        compare("coupling", G, right, 1, UNKNOWNS * GIVEN, 1e-12);
        modeler_drift(&loops, known_drift, u, G, speed, ud, gamma, &work);
        modeler_coupling_rate(&loops, known_drift, u, G, ud, rate, &work);
        compare("its rate", rate, rates, 1, UNKNOWNS * GIVEN, 1e-12);
        modeler_accelerations(&loops, G, gamma, pull, udd);
        for (int k = 0; k < UNKNOWNS; k++) {
            ud[k] -= right[k * GIVEN] * v + right[k * GIVEN + 1] * w;
            gamma[k] -= rates[k * GIVEN] * v + rates[k * GIVEN + 1] * w;
            udd[k] -= right[k * GIVEN] * pull[0] + right[k * GIVEN + 1] * pull[1] +
                      rates[k * GIVEN] * v + rates[k * GIVEN + 1] * w;
            expect("speeds and accelerations",
                   modeler_fabs(ud[k]) + modeler_fabs(gamma[k]) + modeler_fabs(udd[k]) <
                       1e-11);
        }
        memset(square, 0, sizeof(square));
        for (int k = 0; k < UNKNOWNS * GIVEN * GIVEN; k++) {
            square[k / GIVEN % GIVEN * GIVEN + k % GIVEN] +=
                right[k / GIVEN / GIVEN * GIVEN + k / GIVEN % GIVEN] *
                rates[k / GIVEN / GIVEN * GIVEN + k % GIVEN];
        }
        modeler_project(&loops, G, rate, GIVEN, forces);
        compare("forces", forces, square, 1, GIVEN * GIVEN, 1e-12);
        modeler_project_more(&loops, G, rate, GIVEN, 2, forces);
        for (int k = 0; k < GIVEN * GIVEN; k++) {
            square[k] *= 3;
        }
        compare("more forces", forces, square, 1, GIVEN * GIVEN, 1e-12);
        memset(udd, 0, sizeof(udd));
        modeler_apply_more(G, UNKNOWNS, GIVEN, pull, 1, udd);
        modeler_apply_more(G, UNKNOWNS, GIVEN, pull, 1, udd);
        for (int k = 0; k < UNKNOWNS; k++) {
            ud[k] = 2 * (right[k * GIVEN] * pull[0] + right[k * GIVEN + 1] * pull[1]);
        }
        compare("products", udd, ud, 1, UNKNOWNS, 1e-12);
    }
}

/* What the elimination gives, put into its equations:
 * J at one posture, K at another. */
static void check_elimination(const modeler_real *J, const modeler_real *K)
{
    enum { S = 2, Z = 8 };
    const modeler_closure *const loops = &five_bar_loops;
    const modeler_real *const scale = loops->scale;
    const int *const solved = loops->solved_places;
    static modeler_real lu[4], G[4], right[S], x[S], A[S * S], B[Z], sum;
    static modeler_real whole[4 * 2];
    modeler_real added = 0;

    five_bar_tree_factor(J, lu);
    for (int j = 0; j < S; j++) {
        if (!(modeler_fabs(lu[j]) <= loops->limits[j])) {
            return; /* rows are exchanged here */
        }
    }
    five_bar_tree_turned(J, J, lu, x);
    five_bar_tree_spread(J, J, lu, &sum);
    for (int i = 0; i < S; i++) {
        expect("a Jacobian that stays", x[i] == 0 && sum == 0);
    }
    five_bar_tree_coupling(J, lu, G);
    memset(whole, 0, sizeof(whole));
    for (int j = 0; j < 2; j++) {
        whole[loops->given_places[j] * 2 + j] = 1;
    }
    for (int k = 0; k < 4; k++) {
        whole[loops->coupling_row[k] * 2 + loops->coupling_column[k]] += G[k];
    }
    for (int j = 0; j < 2; j++) {
        memset(right, 0, sizeof(right));
        memset(x, 0, sizeof(x));
        for (int k = 0; k < Z; k++) {
            const modeler_real term = J[k] * whole[loops->column[k] * 2 + j];
            right[loops->row[k]] += term;
            x[loops->row[k]] += modeler_fabs(term);
        }
        for (int i = 0; i < S; i++) {
            expect("J G = 0", modeler_fabs(right[i]) <= 1e-9 * (x[i] + LEAST));
        }
    }
    for (int j = 0; j < S; j++) { /* column by column */
        memset(right, 0, sizeof(right));
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = J[k];
            }
        }
        five_bar_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            expect("J^-1 J = 1", modeler_fabs(x[i] - (i == j)) * scale[solved[j]] <=
                                     1e-8 * scale[solved[i]]);
        }
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = K[k] - J[k];
            }
        }
        five_bar_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            A[i * S + j] = x[i] * scale[solved[j]] / scale[solved[i]];
            added += A[i * S + j] * A[i * S + j];
        }
    }
    five_bar_tree_spread(J, K, lu, &sum);
    expect("how far a Jacobian turns", modeler_fabs(sum - added) <= 1e-9 * added);
    five_bar_tree_turned(J, K, lu, x);
    for (int i = 0; i < S; i++) {
        added = 0;
        for (int j = 0; j < S; j++) {
            added += modeler_fabs(A[i * S + j]);
        }
        expect("a bound of that", x[i] >= 0.999999999 * added);
    }
    for (int k = 0; k < Z; k++) { /* the same entry by entry */
        const int column = loops->column[k];
        int given = 0;

        for (int j = 0; j < 2; j++) {
            given |= loops->given_places[j] == column;
        }
        memcpy(B, J, sizeof(B));
        B[k] = K[k];
        five_bar_tree_turned(J, B, lu, x);
        memset(right, 0, sizeof(right));
        right[loops->row[k]] = B[k] - J[k];
        five_bar_tree_solve(lu, right, A);
        for (int i = 0; i < S && given == 0; i++) {
            expect("a bound of each entry",
                   x[i] >= 0.999999999 * modeler_fabs(A[i]) *
                               scale[column] / scale[solved[i]]);
        }
    }
}


/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    2.21038818359375, 0.94146728515625, 2.1495361328125, 0.8919677734375
};
static double qd[] = {
    1.0, -1.3125, -0.0185546875, 0.0234375
};
static double qdd[] = {
    -2.125, -0.875, -0.375, 0.875
};
static double chi[] = {
    33.238525390625, 1.126953125, 1.015380859375, 33.90380859375, 1.792236328125, 33.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 33.122802734375, 1.01123046875,
    1.899658203125, 33.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 33.67236328125,
    1.560791015625, 33.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    33.891357421875, 1.77978515625, 1.668212890625, 33.556640625, 1.445068359375, 33.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125
};
static double beta[] = {
    34.04318359375, 2.777490234375, 1.45751953125, 34.030436197916664, 2.6171061197916665,
    1.341796875, 33.35099153645833, 1.0207845052083333, 1.22607421875, 32.8202880859375,
    1.1103515625
};
static double start[] = {
    2.1495361328125, -1.319676666861738, 0.8919677734375, 1.4368442870263094, 2.21038818359375,
    -1.350132251110884, 0.94146728515625, 1.4270768889925665
};
static double at_inverse_dynamics[] = {
    -134.76945474141746, -36.83154365182733, -56.04163732168564, 51.71165524392496
};
static double at_gravity[] = {
    -33.84787879730468, 1.8281897924623383, -33.38160824854484, 3.155057060920931
};
static double at_coriolis[] = {
    2.420399765868296, -0.8349636927842448, 0.0012407967559906986, 0.0003433504053242518
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0
};
static double at_inertia_matrix[] = {
    50.3915093272485, -4.274264697625131, -4.274264697625131, 53.60866541023866, 50.29058576362389,
    -4.345485952614664, -4.345485952614664, 53.63051154327795
};
static double at_forward_kinematics[] = {
    -0.5968680217005637, -0.8023394323297686, 0.0, 0.0, 0.8023394323297686, -0.5968680217005637,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6522434902696306, -0.7580095180147083, 0.0,
    -0.17906040651016913, 0.7580095180147083, 0.6522434902696306, 0.0, 0.24070182969893059, 0.0,
    0.0, 1.0, 0.0, 0.5886024725579445, -0.808422618002907, 0.0, 0.2, 0.808422618002907,
    0.5886024725579445, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.7157851830839993, -0.6983205364855065, 0.0,
    0.3824667664929628, 0.6983205364855065, -0.7157851830839993, 0.0, 0.25061101158090116, 0.0, 0.0,
    1.0, 0.0, -0.5469693967176524, -0.8371526020113222, 0.0, 0.0, 0.8371526020113222,
    -0.5469693967176524, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6749794578902304, -0.7378365207999741, 0.0,
    -0.16409081901529574, 0.7378365207999741, 0.6749794578902304, 0.0, 0.2511457806033967, 0.0, 0.0,
    1.0, 0.0, 0.6278817078337691, -0.7783087825328386, 0.0, 0.2, 0.7783087825328386,
    0.6278817078337691, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.6874818221135047, -0.7262015865195389, 0.0,
    0.3946433294284684, 0.7262015865195389, -0.6874818221135047, 0.0, 0.24127572258517996, 0.0, 0.0,
    1.0, 0.0
};
static double at_close[] = {
    2.21038818359375, -1.350132251110884, 0.94146728515625, 1.4270768889925665, 2.1495361328125,
    -1.319676666861738, 0.8919677734375, 1.4368442870263094
};
static double at_close_from[] = {
    2.21038818359375, -1.350132251110884, 0.94146728515625, 1.4270768889925665, 2.1495361328125,
    -1.319676666861738, 0.8919677734375, 1.4368442870263094
};
static double at_coupling[] = {
    1.0, 0.0, -1.1183542554446448, 0.7685107448112802, 0.0, 1.0, 0.6983297720607691,
    -1.0599930116552918, 1.0, 0.0, -1.1340837537066526, 0.7700438645571115, 0.0, 1.0,
    0.6936714346412841, -1.0459308652490307
};

static double out[STATES * 80], worst;
static double product[STATES * N];
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("five_bar: the %s is %s,\nthe header %s\n", part, signature, header);
    return 0;
}

static void empty(void)
{
    volatile double stack[4096]; /* what functions do not write must show there too */

    for (int i = 0; i < 4096; i++) {
        stack[i] = NAN;
    }
    worst = fmax(worst, stack[4095]);
    for (size_t i = 0; i < sizeof(out) / sizeof(*out); i++) {
        out[i] = NAN;
    }
}

/* Compares what a function gave with what it should. */
static void compare(const char *name, const double *given, const double *expected, int states,
                    int length, double tolerance)
{
    for (int k = 0; k < states * length; k++) {
        const double *const state = expected + k / length * length;
        double largest = LEAST, apart;

        for (int i = 0; i < length; i++) {
            largest = fmax(largest, fabs(state[i]));
        }
        apart = fabs(given[k] - expected[k]) / largest;
        if (!(apart <= tolerance)) {
            printf("%s: state %d, number %d: %.12g, expected %.12g\n", name, k / length, k % length,
                   given[k], expected[k]);
            failed = 1;
            return;
        }
        worst = fmax(worst, apart);
    }
    for (int i = 0; i < STATES; i++) {
        if (status[i] != 0) {
            printf("%s: state %d: status %d\n", name, i, status[i]);
            failed = 1;
        }
    }
}

/* Rows times parameters, into `product`. */
static void multiply(const double *rows, int columns, const double *parameters)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = 0.0;
        for (int k = 0; k < columns; k++) {
            product[i] += rows[i * columns + k] * parameters[k];
        }
    }
}

/* M qdd + c + g + f, into `product`. */
static void add_up(const double *M, const double *c, const double *g, const double *f)
{
    for (int i = 0; i < STATES * N; i++) {
        product[i] = c[i] + g[i] + f[i];
        for (int k = 0; k < N; k++) {
            product[i] += M[i * N + k] * qdd[i / N * N + k];
        }
    }
}

/* The same postures by other ways: with rows exchanged, and step by step. */
static void check_postures(void)
{
    enum { STEPS = 40, U = 4 };
    static double values[STATES][19], f[2], at[N];
    static struct five_bar_posture sparse, dense;
    static struct five_bar_state state, other;
    static const double none[2] = {0};
    const double *const home = five_bar_home;
    static double phi[N * C], rows[U * C], torques[N];

    for (int i = 0; i < STATES; i++) {
        {
            const modeler_closure *const own = &five_bar_loops;
            modeler_closure loops = *own;

            loops.limits = none;
            expect("a stored state",
                   five_bar_posed(own, q + i * N, home, &sparse) ==
                       MODELER_CLOSED);
            expect("a state with rows exchanged",
                   five_bar_posed(&loops, q + i * N, home, &dense) ==
                       MODELER_CLOSED);
            five_bar_moved(&loops, qd + i * N, &sparse);
            five_bar_moved(&loops, qd + i * N, &dense);
            compare("postures, rows exchanged", dense.u, sparse.u, 1, U, TOLERANCE);
            compare("coupling, rows exchanged", dense.G, sparse.G, 1, U * 2, TOLERANCE);
            compare("drift, rows exchanged", dense.gamma, sparse.gamma, 1, U, TOLERANCE);
            other.at = dense;
        }
        expect("a stored state",
               five_bar_state(q + i * N, qd + i * N, NULL, &state) ==
                   MODELER_CLOSED);
        expect("a state that is kept",
               five_bar_state(q + i * N, qd + i * N, other.at.u, &other) ==
                   MODELER_CLOSED);
        expect("rows exchanged", other.at.kept.dense[other.at.kept.at] != 0);
        expect("rates",
               five_bar_coupling_rate_at(&state, NULL) == MODELER_CLOSED);
        expect("rates, rows exchanged",
               five_bar_coupling_rate_at(&other, NULL) == MODELER_CLOSED);
        compare("rate, rows exchanged", other.rate, state.rate, 1, U * 2, TOLERANCE);
        dense = other.at;
        for (int k = 0; k < U * C; k++) {
            rows[k] = NAN;
        }
        for (int k = 0; k < N * C; k++) {
            phi[k] = NAN;
        }
        expect("rows of a regressor",
               five_bar_tree_next(q + i * N, qd + i * N, qdd + i * N, 1,
                   &dense, rows, phi) == MODELER_CLOSED);
        for (int j = 0; j < N; j++) {
            torques[j] = 0;
            for (int k = 0; k < C; k++) {
                torques[j] += phi[j * C + k] * beta[k];
            }
        }
        compare("regressor, rows exchanged", torques, at_inverse_dynamics + i * N, 1, N, TOLERANCE);
        five_bar_tree_closure(state.at.u, values[i]);
        five_bar_tree_residual(state.at.u, f);
        for (int k = 0; k < 2; k++) {
            expect("residuals", modeler_fabs(f[k] - values[i][k]) <= 1e-14);
        }
    }
    for (int i = 0; i <= STEPS; i++) { /* back to the first state */
        for (int j = 0; j < N; j++) {
            at[j] = i < STEPS ? q[N + j] + (double)i / (double)STEPS * (q[j] - q[N + j]) : q[j];
        }
        expect("a path",
               five_bar_state_with_bound(at, qd + 0, state.at.u, 50,
                   &state) == MODELER_CLOSED);
    }
    expect("its end",
           five_bar_state(q, qd + 0, NULL, &other) == MODELER_CLOSED);
    compare("a path", state.at.u, other.at.u, 1, U, TOLERANCE);
    compare("a path's coupling", state.at.G, other.at.G, 1, U * 2, TOLERANCE);
    at[0] = NAN;
    expect("a cycle that fails",
           five_bar_state(at, qd + 0, state.at.u, &state) ==
               MODELER_NOT_FINITE);
    compare("the last posture", state.at.u, other.at.u, 1, U, TOLERANCE);
    check_elimination(values[0] + 3, values[1] + 3);
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = N * C };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static int told[MANY], closed[MANY], singles;

static int counted_next(const double *at, const double *speed, const double *acceleration, int next,
                        struct five_bar_posture *p, double *rows, double *phi)
{
    singles++;
    return five_bar_tree_next(at, speed, acceleration, next, p, rows, phi);
}

/* W by rows, W by columns, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work,
                         const modeler_closure *loops)
{
    const struct five_bar_single counted = {
        loops, five_bar_posed, counted_next, modeler_eliminated
    };
    modeler_tiled own = *five_bar_tiled();
    const modeler_tiled *const robot = &own;
    const size_t room = modeler_tile_work(robot), rows = kind == 1 ? (size_t)(samples * N + 3) : 0;
    const int length = kind == 2 ? LONG : N * C;
    double *const W = results + GUARD + phase;
    int touched = 0;

    memset(work, 0xff, room);
    memset(work + room, 0x5a, SPARE);
    for (size_t i = 0; i < sizeof(results) / sizeof(*results); i++) {
        results[i] = -7;
    }
    own.singles = &counted;
    singles = 0;
    modeler_tile_closed(robot, (size_t)samples, Q, QD, QDD, W, rows, closed, work);
    for (int i = 0; i < samples; i++) {
        const double *const right = one + i * N * C;
        double largest = LEAST;

        for (int k = 0; k < length; k++) {
            largest = fmax(largest, fabs(right[k]));
        }
        for (int k = 0; k < length; k++) {
            const size_t place = kind == 1 ? (size_t)(k % C) * rows + (size_t)(i * N + k / C)
                                           : (size_t)(i * length + k);
            double *const given = W + place;

            touched |= told[i] != closed[i] ||
                       (told[i] == 0
                            ? !(fabs(*given - right[k]) <= 1e-11 * largest)
                            : !isnan(*given));
            *given = -7;
        }
    }
    for (size_t i = 0; i < sizeof(results) / sizeof(*results); i++) {
        touched |= !(results[i] + 7 == 0);
    }
    for (int i = 0; i < SPARE; i++) {
        touched |= work[room + (size_t)i] != 0x5a;
    }
    if (touched != 0 && !failed) {
        printf("tiles: %d samples, kind %d, place %d: not what single samples give\n", samples,
               kind, phase);
    }
    failed |= touched;
}

static void compare_tiles(void)
{
    static const int counts[] = {1, 7, 8, 9, MANY};
    const size_t room = modeler_tile_work(five_bar_tiled());
    unsigned char *const work = (unsigned char *)malloc(room + SPARE);

    if (work == NULL) {
        failed = 1;
        return;
    }
    for (int way = 0; way < 4; way++) {
        for (int i = 0; i < MANY * N; i++) {
            /* Slowly; from the first state to the second; so far that steps are taken; and not
             * closed. */
            static const double steps[] = {1e-4, 0, 2e-2, 1e-4};

            Q[i] = q[i % N] + steps[way] * (double)(i / N % 9);
            if (way == 1) {
                Q[i] += (double)(i / N) / (MANY - 1) * (q[N + i % N] - q[i % N]);
            }
            QD[i] = qd[i % N] + 0.1 * (double)(i / N);
            QDD[i] = qdd[i % N] - 0.1 * (double)(i / N);
        }
        if (way == 3) { /* each among eight of its own */
            Q[5 * N] = NAN;
            QD[13 * N] = INFINITY;
            QDD[19 * N + N - 1] = NAN;
            Q[27 * N] += 1000;
        }
        five_bar_observation(MANY, Q, QD, QDD, one, told);
        for (int k = 0; k < 2 * 5 * 8; k++) {
            compare_tile(k / 40, counts[k / 8 % 5], k % 8, work,
                         &five_bar_loops);
            expect("samples side by side", way > 0 || singles < 3);
        }
    }
    for (int j = 0; j <= 2; j++) { /* in doubt, they are closed one after another */
        double limits[2];
        modeler_closure strict = five_bar_loops;

        memcpy(limits, strict.limits, sizeof(limits));
        strict.limits = limits;
        if (j < 2) {
            limits[j] = 0;
        } else {
            strict.tolerance = 0;
        }
        compare_tile(0, 16, 0, work, &strict);
        expect("samples one after another", singles == 16);
    }
    free(work);
}

/* Sines and cosines against those of <math.h>. */
static void compare_sines(void)
{
    for (int i = -400; i <= 400 && !failed; i++) {
        const double angle = 0.37 * (double)i, expected[] = {sin(angle), cos(angle)};
        double given[2];

        modeler_sincos(angle, given, given + 1);
        compare("modeler_sincos", given, expected, 1, 2, 1e-15);
    }
    /* Where a sine is small, its digits count. */
    for (int i = -60000; i <= 60000 && !failed; i += 997) {
        const double angle = 1.5707963267948966 * i, expected[] = {sin(angle), cos(angle)};
        double given[2];

        modeler_sincos(angle, given, given + 1);
        for (int k = 0; k < 2; k++) {
            failed |= !(fabs(given[k] - expected[k]) <= 1e-9 * fabs(expected[k]));
        }
        if (failed != 0) {
            printf("modeler_sincos: %.17g\n", angle);
        }
    }
}

/* A x = b with a known A = L D L', and matrices that have no such factors. */
static void check_solutions(void)
{
    static const double matrix[] = {4, 2, -2, 2, 10, 2, -2, 2, 9}, known[] = {1, -2, 3, 5, -4, 7};
    double A[9], b[6];

    memcpy(A, matrix, sizeof(A));
    for (int i = 0; i < 6; i++) {
        b[i] = 0;
        for (int k = 0; k < 3; k++) {
            b[i] += matrix[i / 2 * 3 + k] * known[k * 2 + i % 2];
        }
    }
    failed |= modeler_factor(A, 3) != MODELER_DONE;
    modeler_solve(A, 3, b, 2);
    compare("modeler_solve", b, known, 1, 6, 1e-13);
    memcpy(A, matrix, sizeof(A));
    A[8] = 2;
    failed |= modeler_factor(A, 3) != MODELER_SINGULAR;
    memcpy(A, matrix, sizeof(A));
    A[8] = NAN;
    failed |= modeler_factor(A, 3) != MODELER_NOT_FINITE || modeler_finite(A, 9) ||
              !modeler_finite(matrix, 9);
}

int main(void)
{
    if (!belongs("library", five_bar_signature(),
            FIVE_BAR_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", five_bar_tile_signature(),
            FIVE_BAR_SIGNATURE)) {
        return 1;
    }
    compare_tiles();
    compare_sines();
    check_solutions();
    for (int dense = 0; dense < 2; dense++) {
        check_ways(dense);
        check_motion(dense);
    }
    check_postures();
    empty();
    {
        const modeler_input inputs[] = { {chi, 0}, };

        modeler_batch_1(five_bar_base_parameters, 1, inputs,
            out, 11);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("five_bar_base_parameters", out,
            beta, 1, 11, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, {beta, 0}, };

        modeler_batch_status_4(five_bar_inverse_dynamics, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("five_bar_inverse_dynamics", out,
            at_inverse_dynamics, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {beta, 0}, };

        modeler_batch_status_2(five_bar_gravity, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("five_bar_gravity", out,
            at_gravity, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {beta, 0}, };

        modeler_batch_status_3(five_bar_coriolis, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("five_bar_coriolis", out,
            at_coriolis, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {beta, 0}, };

        modeler_batch_status_3(five_bar_friction, 2, inputs,
            out, 2, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("five_bar_friction", out,
            at_friction, 2, 2, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {beta, 0}, };

        modeler_batch_status_2(five_bar_inertia_matrix, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("five_bar_inertia_matrix", out,
            at_inertia_matrix, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_forward_kinematics, 2, inputs,
            out, 48, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("five_bar_forward_kinematics", out,
            at_forward_kinematics, 2, 48, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_close, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("five_bar_close", out,
            at_close, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {start, 4}, };

        modeler_batch_status_2(five_bar_close_from, 2, inputs,
            out, 4, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("five_bar_close_from", out,
            at_close_from, 2, 4, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, };

        modeler_batch_status_1(five_bar_coupling, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("five_bar_coupling", out,
            at_coupling, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, };

        modeler_batch_status_3(five_bar_regressor, 2, inputs,
            out, 80, status);
    }
    multiply(out, 40, chi);
    compare("five_bar_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 2}, {qd, 2}, {qdd, 2}, };

        modeler_batch_status_3(five_bar_base_regressor, 2, inputs,
            out, 22, status);
    }
    multiply(out, 11, beta);
    compare("five_bar_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    five_bar_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("five_bar_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("five_bar_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("five_bar %s:\n", FIVE_BAR_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("13 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
