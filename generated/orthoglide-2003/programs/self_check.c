/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
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

#include "orthoglide_2003.h"
#include "orthoglide_2003_batch.h"
#include "modeler_batch.h"
#include "modeler_closure.h"
#include "orthoglide_2003_tree.h"
#include "modeler_sincos.h"
#include "modeler_solve.h"
#include "orthoglide_2003_tile.h"

#define N 3
#define C 43
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if ORTHOGLIDE_2003_JOINTS != N || ORTHOGLIDE_2003_BASE_PARAMETERS != C \
    || ORTHOGLIDE_2003_STANDARD_PARAMETERS != 163
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef ORTHOGLIDE_2003_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D41
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D42
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_D43
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_b3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_b7
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_a
#undef REPLACED
#define REPLACED 1
#endif
#ifdef ORTHOGLIDE_2003_GEO_d6
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
    enum { S = 9, Z = 27 };
    const modeler_closure *const loops = &orthoglide_2003_loops;
    const modeler_real *const scale = loops->scale;
    const int *const solved = loops->solved_places;
    static modeler_real lu[25], G[27], right[S], x[S], A[S * S], B[Z], sum;
    static modeler_real whole[12 * 3];
    modeler_real added = 0;

    orthoglide_2003_tree_factor(J, lu);
    for (int j = 0; j < S; j++) {
        if (!(modeler_fabs(lu[j]) <= loops->limits[j])) {
            return; /* rows are exchanged here */
        }
    }
    orthoglide_2003_tree_turned(J, J, lu, x);
    orthoglide_2003_tree_spread(J, J, lu, &sum);
    for (int i = 0; i < S; i++) {
        expect("a Jacobian that stays", x[i] == 0 && sum == 0);
    }
    orthoglide_2003_tree_coupling(J, lu, G);
    memset(whole, 0, sizeof(whole));
    for (int j = 0; j < 3; j++) {
        whole[loops->given_places[j] * 3 + j] = 1;
    }
    for (int k = 0; k < 27; k++) {
        whole[loops->coupling_row[k] * 3 + loops->coupling_column[k]] += G[k];
    }
    for (int j = 0; j < 3; j++) {
        memset(right, 0, sizeof(right));
        memset(x, 0, sizeof(x));
        for (int k = 0; k < Z; k++) {
            const modeler_real term = J[k] * whole[loops->column[k] * 3 + j];
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
        orthoglide_2003_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            expect("J^-1 J = 1", modeler_fabs(x[i] - (i == j)) * scale[solved[j]] <=
                                     1e-8 * scale[solved[i]]);
        }
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = K[k] - J[k];
            }
        }
        orthoglide_2003_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            A[i * S + j] = x[i] * scale[solved[j]] / scale[solved[i]];
            added += A[i * S + j] * A[i * S + j];
        }
    }
    orthoglide_2003_tree_spread(J, K, lu, &sum);
    expect("how far a Jacobian turns", modeler_fabs(sum - added) <= 1e-9 * added);
    orthoglide_2003_tree_turned(J, K, lu, x);
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

        for (int j = 0; j < 3; j++) {
            given |= loops->given_places[j] == column;
        }
        memcpy(B, J, sizeof(B));
        B[k] = K[k];
        orthoglide_2003_tree_turned(J, B, lu, x);
        memset(right, 0, sizeof(right));
        right[loops->row[k]] = B[k] - J[k];
        orthoglide_2003_tree_solve(lu, right, A);
        for (int i = 0; i < S && given == 0; i++) {
            expect("a bound of each entry",
                   x[i] >= 0.999999999 * modeler_fabs(A[i]) *
                               scale[column] / scale[solved[i]]);
        }
    }
}

/* What the elimination of the platform's coordinates gives, put into its equations:
 * J at one posture, K at another. */
static void check_platform_elimination(const modeler_real *J, const modeler_real *K)
{
    enum { S = 9, Z = 27 };
    const modeler_closure *const loops = &orthoglide_2003_platform_loops;
    const modeler_real *const scale = loops->scale;
    const int *const solved = loops->solved_places;
    static modeler_real lu[18], G[18], right[S], x[S], A[S * S], B[Z], sum;
    static modeler_real whole[12 * 3];
    modeler_real added = 0;

    orthoglide_2003_tree_platform_factor(J, lu);
    for (int j = 0; j < S; j++) {
        if (!(modeler_fabs(lu[j]) <= loops->limits[j])) {
            return; /* rows are exchanged here */
        }
    }
    orthoglide_2003_tree_platform_turned(J, J, lu, x);
    orthoglide_2003_tree_platform_spread(J, J, lu, &sum);
    for (int i = 0; i < S; i++) {
        expect("a Jacobian that stays", x[i] == 0 && sum == 0);
    }
    orthoglide_2003_tree_platform_coupling(J, lu, G);
    memset(whole, 0, sizeof(whole));
    for (int j = 0; j < 3; j++) {
        whole[loops->given_places[j] * 3 + j] = 1;
    }
    for (int k = 0; k < 18; k++) {
        whole[loops->coupling_row[k] * 3 + loops->coupling_column[k]] += G[k];
    }
    for (int j = 0; j < 3; j++) {
        memset(right, 0, sizeof(right));
        memset(x, 0, sizeof(x));
        for (int k = 0; k < Z; k++) {
            const modeler_real term = J[k] * whole[loops->column[k] * 3 + j];
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
        orthoglide_2003_tree_platform_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            expect("J^-1 J = 1", modeler_fabs(x[i] - (i == j)) * scale[solved[j]] <=
                                     1e-8 * scale[solved[i]]);
        }
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = K[k] - J[k];
            }
        }
        orthoglide_2003_tree_platform_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            A[i * S + j] = x[i] * scale[solved[j]] / scale[solved[i]];
            added += A[i * S + j] * A[i * S + j];
        }
    }
    orthoglide_2003_tree_platform_spread(J, K, lu, &sum);
    expect("how far a Jacobian turns", modeler_fabs(sum - added) <= 1e-9 * added);
    orthoglide_2003_tree_platform_turned(J, K, lu, x);
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

        for (int j = 0; j < 3; j++) {
            given |= loops->given_places[j] == column;
        }
        memcpy(B, J, sizeof(B));
        B[k] = K[k];
        orthoglide_2003_tree_platform_turned(J, B, lu, x);
        memset(right, 0, sizeof(right));
        right[loops->row[k]] = B[k] - J[k];
        orthoglide_2003_tree_platform_solve(lu, right, A);
        for (int i = 0; i < S && given == 0; i++) {
            expect("a bound of each entry",
                   x[i] >= 0.999999999 * modeler_fabs(A[i]) *
                               scale[column] / scale[solved[i]]);
        }
    }
}


/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    0.17962646484375, 0.1942138671875, 0.19122314453125, 0.21099853515625, 0.20684814453125,
    0.206787109375
};
static double qd[] = {
    1.0, -1.3125, 1.625, -0.0185546875, 0.0234375, -0.015625
};
static double qdd[] = {
    -2.125, -0.875, 0.375, -0.375, 0.875, 2.125
};
static double chi[] = {
    1.238525390625, 33.126953125, 1.015380859375, 1.90380859375, 33.792236328125, 1.6806640625,
    33.569091796875, 1.45751953125, 1.345947265625, 1.234375, 1.122802734375, 1.01123046875,
    1.899658203125, 1.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    33.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 1.67236328125,
    1.560791015625, 1.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 33.0029296875,
    1.891357421875, 1.77978515625, 33.668212890625, 1.556640625, 33.445068359375, 1.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 1.775634765625, 1.6640625,
    1.552490234375, 33.44091796875, 1.329345703125, 1.2177734375, 33.106201171875, 1.99462890625,
    33.883056640625, 1.771484375, 1.659912109375, 1.54833984375, 1.436767578125, 33.3251953125,
    1.213623046875, 1.10205078125, 33.990478515625, 1.87890625, 33.767333984375, 1.65576171875,
    1.544189453125, 1.4326171875, 1.321044921875, 33.20947265625, 1.097900390625, 1.986328125,
    33.874755859375, 1.76318359375, 33.651611328125, 1.5400390625, 1.428466796875, 1.31689453125,
    1.205322265625, 33.09375, 1.982177734375, 1.87060546875, 33.759033203125, 1.6474609375,
    33.535888671875, 1.42431640625, 1.312744140625, 1.201171875, 1.089599609375, 33.97802734375,
    1.866455078125, 1.7548828125, 33.643310546875, 1.53173828125, 33.420166015625, 1.30859375,
    1.197021484375, 1.08544921875, 1.973876953125, 33.8623046875, 1.750732421875, 1.63916015625,
    33.527587890625, 1.416015625, 33.304443359375, 1.19287109375, 1.081298828125, 1.9697265625,
    1.858154296875, 33.74658203125, 1.635009765625, 1.5234375, 33.411865234375, 1.30029296875,
    33.188720703125, 1.0771484375, 1.965576171875, 1.85400390625, 1.742431640625, 33.630859375,
    1.519287109375, 1.40771484375, 33.296142578125, 1.1845703125, 33.072998046875, 1.96142578125,
    1.849853515625, 1.73828125, 1.626708984375, 33.51513671875, 1.403564453125, 1.2919921875,
    33.180419921875, 1.06884765625, 33.957275390625, 1.845703125, 1.734130859375, 1.62255859375,
    1.510986328125, 33.3994140625, 1.287841796875, 1.17626953125, 33.064697265625, 1.953125,
    33.841552734375, 1.72998046875, 1.618408203125, 1.5068359375, 1.395263671875, 33.28369140625,
    1.172119140625, 1.060546875, 33.948974609375, 1.83740234375, 33.725830078125, 1.6142578125,
    1.502685546875, 1.39111328125, 1.279541015625, 33.16796875, 1.056396484375, 1.94482421875,
    33.833251953125, 1.7216796875, 33.610107421875, 1.49853515625, 1.386962890625, 1.275390625,
    1.163818359375
};
static double beta[] = {
    35.991273941532256, -3.954290574596774, 1.899658203125, 1.7880859375, 1.676513671875,
    -1.7064012096774193, 1.337646484375, 1.22607421875, 1.114501953125, -2.4585118447580645,
    1.775634765625, 1.6640625, 44.18399240801411, 134.5525, 1.771484375, 5.610595703125,
    -0.3757421875, 3.19580078125, 2.5644189453125, 3.5263671875, 66.3483984375, 2.85693359375,
    1.5400390625, 132.6779296875, 1.30859375, 6.759033203125, 1.647265625, 3.27001953125,
    2.4721337890625, 2.6005859375, 65.399609375, 2.93115234375, 1.0771484375, 133.803359375,
    1.845703125, 5.907470703125, 0.6702734375, 2.34423828125, 2.6898486328125, 3.6748046875,
    66.4508203125, 3.00537109375, 1.6142578125
};
static double x[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.01580810546875, 0.0157470703125,
    0.62017822265625
};
static double xd[] = {
    1.0, -1.3125, 1.625, -0.0185546875, 0.0234375, -0.015625
};
static double xdd[] = {
    -2.125, -0.875, 0.375, -0.375, 0.875, 2.125
};
static double start[] = {
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702,
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277
};
static double at_inverse_dynamics[] = {
    -36953.492868904905, -29136.34657460355, -19958.218322897672, -1228.2477154045914,
    1514.0859057250161, 4089.4459775604882
};
static double at_gravity[] = {
    165.5817799481417, -91.74539880362852, -425.3354424814579, 223.64967646011584,
    -83.41305227329865, -435.5986756113111
};
static double at_coriolis[] = {
    -32580.598485956347, -27019.90901316419, -20208.77082456491, -5.080119407460269,
    -3.0019877050328745, -5.7895013290993615
};
static double at_friction[] = {
    5.3642578125, -1.8672332763671875, 48.73346140215474, -0.1468198299407959, 2.371927261352539,
    42.49218561480122
};
static double at_inertia_matrix[] = {
    2123.47508138438, 71.43063794569414, 82.78916116023528, 71.43063794569414, 2133.4128563706563,
    -11.462865067841603, 82.78916116023528, -11.462865067841603, 2114.8038487404665,
    2162.0091533676905, -203.2251908334089, -215.57410735773624, -203.2251908334089,
    2169.601613343639, -177.16792460998468, -215.57410735773624, -177.16792460998468,
    2147.0699353697332
};
static double at_forward_kinematics[] = {
    0.0, 0.0, 1.0, 0.004037629021999144, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.004037629021999144, 0.0, 0.0, 1.0, 0.001022282701586299, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.004037629021999144, 0.0, 1.0, 0.0, 0.001022282701586299, 0.0, 0.0, 1.0, 0.5895984837260335,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.17962646484375, 0.0, 0.0, 1.0,
    -0.4057861328125, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    -0.40877685546875, 1.0, 0.0, 0.0, 0.6, 0.013024680568544137, 0.9999151752504246, 0.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.9999151752504246, -0.013024680568544137, 0.0, 0.17962646484375,
    0.013024609748384337, 4.295130851261249e-05, 0.9999151752504246, 0.0, 0.003297686134149352,
    -0.9999945626182978, 0.0, -0.04, 0.9999097383299469, 0.0032974064087488444,
    -0.013024680568544137, 0.17962646484375, 0.013024680568544137, 0.0, 0.9999151752504246,
    0.004037629021999144, 0.0, -1.0, 0.0, -0.0389777172984137, 0.9999151752504246, 0.0,
    -0.013024680568544137, 0.48959848372603354, 0.0, 1.0, 0.0, 0.004037629021999144, 0.0, 0.0, 1.0,
    -0.0389777172984137, 1.0, 0.0, 0.0, 0.48959848372603354, 0.013024609748384337,
    4.295130851261249e-05, 0.9999151752504246, 0.0, 0.003297686134149352, -0.9999945626182978, 0.0,
    0.04, 0.9999097383299469, 0.0032974064087488444, -0.013024680568544137, 0.17962646484375,
    0.999994556489855, -0.0032995440076223695, 0.0, -0.4057861328125, 0.0032995440076223695,
    0.999994556489855, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6, 0.9994314897887069, -0.03355309565550675,
    -0.0032995440076223695, -0.4057861328125, 0.003297686134149352, -0.00011071051836113731,
    0.999994556489855, 0.0, -0.03355327830311759, -0.999436930233776, 0.0, 0.56, 0.999994556489855,
    0.0, -0.0032995440076223695, -0.09596237097800085, 0.0032995440076223695, 0.0,
    0.999994556489855, 0.001022282701586299, 0.0, -1.0, 0.0, 0.5495984837260336, 1.0, 0.0, 0.0,
    -0.09596237097800085, 0.0, 1.0, 0.0, 0.001022282701586299, 0.0, 0.0, 1.0, 0.5495984837260336,
    0.9994314897887069, -0.03355309565550675, -0.0032995440076223695, -0.4057861328125,
    0.003297686134149352, -0.00011071051836113731, 0.999994556489855, 0.0, -0.03355327830311759,
    -0.999436930233776, 0.0, 0.64, 0.0, 0.0, 1.0, 0.0, 0.9994368346712392, 0.033556124662033726,
    0.0, -0.40877685546875, -0.033556124662033726, 0.9994368346712392, 0.0, 0.6,
    0.013024609748384337, -0.9999151761729104, 0.0, -0.04, 0.999352058613988, 0.013017274739753407,
    0.033556124662033726, -0.40877685546875, -0.03355327830311759, -0.00043705542839112444,
    0.9994368346712392, 0.6, 0.0, -1.0, 0.0, -0.035962370978000854, 0.9994368346712392, 0.0,
    0.033556124662033726, -0.0989777172984137, -0.033556124662033726, 0.0, 0.9994368346712392,
    0.5895984837260335, 0.0, 0.0, 1.0, -0.035962370978000854, 1.0, 0.0, 0.0, -0.0989777172984137,
    0.0, 1.0, 0.0, 0.5895984837260335, 0.013024609748384337, -0.9999151761729104, 0.0, 0.04,
    0.999352058613988, 0.013017274739753407, 0.033556124662033726, -0.40877685546875,
    -0.03355327830311759, -0.00043705542839112444, 0.9994368346712392, 0.6, 0.0, 0.0, 1.0,
    0.015789588283663156, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.015789588283663156, 0.0, 0.0, 1.0, 0.01572527272135455, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.015789588283663156, 0.0, 1.0, 0.0, 0.01572527272135455, 0.0, 0.0, 1.0, 0.6201965375748805,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.21099853515625, 0.0, 0.0, 1.0,
    -0.39315185546875, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    -0.393212890625, 1.0, 0.0, 0.0, 0.6, 0.05099981429577978, 0.9986986627315548, 0.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.9986986627315548, -0.05099981429577978, 0.0, 0.21099853515625,
    0.05093415575375212, 0.0025870515759341085, 0.9986986627315548, 0.0, 0.05072668619791791,
    -0.9987125729194452, 0.0, -0.04, 0.9974129110278404, 0.05066067367066384, -0.05099981429577978,
    0.21099853515625, 0.05099981429577978, 0.0, 0.9986986627315548, 0.015789588283663156, 0.0, -1.0,
    0.0, -0.024274727278645446, 0.9986986627315548, 0.0, -0.05099981429577978, 0.5201965375748805,
    0.0, 1.0, 0.0, 0.015789588283663156, 0.0, 0.0, 1.0, -0.024274727278645446, 1.0, 0.0, 0.0,
    0.5201965375748805, 0.05093415575375212, 0.0025870515759341085, 0.9986986627315548, 0.0,
    0.05072668619791791, -0.9987125729194452, 0.0, 0.04, 0.9974129110278404, 0.05066067367066384,
    -0.05099981429577978, 0.21099853515625, 0.998707081540371, -0.05083468580717974, 0.0,
    -0.39315185546875, 0.05083468580717974, 0.998707081540371, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6,
    0.9965853024271392, 0.06506588741493337, -0.05083468580717974, -0.39315185546875,
    0.05072668619791791, 0.0033118859419740314, 0.998707081540371, 0.0, 0.06515012120929192,
    -0.9978754740479469, 0.0, 0.56, 0.998707081540371, 0.0, -0.05083468580717974,
    -0.08421041171633684, 0.05083468580717974, 0.0, 0.998707081540371, 0.01572527272135455, 0.0,
    -1.0, 0.0, 0.5801965375748805, 1.0, 0.0, 0.0, -0.08421041171633684, 0.0, 1.0, 0.0,
    0.01572527272135455, 0.0, 0.0, 1.0, 0.5801965375748805, 0.9965853024271392, 0.06506588741493337,
    -0.05083468580717974, -0.39315185546875, 0.05072668619791791, 0.0033118859419740314,
    0.998707081540371, 0.0, 0.06515012120929192, -0.9978754740479469, 0.0, 0.64, 0.0, 0.0, 1.0, 0.0,
    0.9978699421814733, -0.065234795092368, 0.0, -0.393212890625, 0.065234795092368,
    0.9978699421814733, 0.0, 0.6, 0.05093415575375212, -0.9987020135043548, 0.0, -0.04,
    0.9965747204721115, 0.05082566305705878, -0.065234795092368, -0.393212890625,
    0.06515012120929192, 0.003322679213798776, 0.9978699421814733, 0.6, 0.0, -1.0, 0.0,
    -0.02421041171633684, 0.9978699421814733, 0.0, -0.065234795092368, -0.08427472727864545,
    0.065234795092368, 0.0, 0.9978699421814733, 0.6201965375748805, 0.0, 0.0, 1.0,
    -0.02421041171633684, 1.0, 0.0, 0.0, -0.08427472727864545, 0.0, 1.0, 0.0, 0.6201965375748805,
    0.05093415575375212, -0.9987020135043548, 0.0, 0.04, 0.9965747204721115, 0.05082566305705878,
    -0.065234795092368, -0.393212890625, 0.06515012120929192, 0.003322679213798776,
    0.9978699421814733, 0.6
};
static double at_close[] = {
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277,
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702
};
static double at_close_from[] = {
    0.004037629021999144, 0.001022282701586299, 0.5895984837260335, 0.17962646484375,
    0.1942138671875, 0.19122314453125, -1.5577712779421007, -0.0032976921110884332,
    -1.5674967768002275, 0.03355957733404803, -1.6043587520915985, -0.013024978026628277,
    0.015789588283663156, 0.01572527272135455, 0.6201965375748805, 0.21099853515625,
    0.20684814453125, 0.206787109375, -1.5197743783240687, -0.050748466384330684,
    -1.519939721283252, -0.06519629816109111, -1.5055151742407185, -0.0509562044838702
};
static double at_coupling[] = {
    0.03344478743718129, 0.999608779471041, -0.003408571480129206, 0.03312085097060254,
    -0.013463634857979558, 0.999935192067077, 0.999455123343039, -0.012976286672988871,
    -0.003253370759277447, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.10790073939385604,
    3.2248336633468138, -0.010857827534915227, -0.10684203568480903, 0.0434313163396756,
    -3.225614932664378, 0.10654488939609275, -0.04345114576582606, 3.2274333851336596,
    -3.2258651721258844, 0.04188257207777473, 0.010500656987240963, 3.2260919471235696,
    -0.043296467049250865, -0.010496739653437339, -0.10789556320227839, -3.2248179913102746,
    0.01099632462172287, -0.06260451377307497, 1.0056504335023029, -0.04800414916191437,
    -0.06259148202582829, -0.04820099548875443, 1.0056367485099913, 1.0063802728563385,
    -0.04890339647898126, -0.04869354348989963, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,
    -0.20299823871033304, 3.2520442125380584, -0.14682876648560259, 0.20216828345788293,
    0.1556875185492732, -3.2481712950100294, -0.19178834821190352, -0.15654520869298447,
    3.2545815980172508, -3.2532996965911454, 0.15808875553153603, 0.1574103691560059,
    3.2568717858935967, -0.14746510885859226, -0.15813278829118418, 0.2022125135411009,
    -3.2482498408869946, 0.15505335122668829
};
static double at_platform_inverse_dynamics[] = {
    -4282.624960303166, -1543.5470954401403, 59.79139171622435, -805.1580010715252,
    1498.8382501708452, 4710.676409632289
};
static double at_platform_close[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.17962752026605516, 0.19420457160050866,
    0.19123830051323304, -1.5578013066089245, -0.0033470954633180554, -1.5674473460229505,
    0.033555944162842376, -1.6043551054948433, -0.012994947390024759, 0.01580810546875,
    0.0157470703125, 0.62017822265625, 0.21098227575839357, 0.20686657522879023, 0.2068086571426197,
    -1.5197143074849013, -0.0508188719623078, -1.5198693623587485, -0.06513709210776798,
    -1.5055742582206773, -0.05101601506345277
};
static double at_platform_close_from[] = {
    0.0040283203125, 0.00103759765625, 0.589599609375, 0.17962752026605516, 0.19420457160050866,
    0.19123830051323304, -1.5578013066089245, -0.0033470954633180554, -1.5674473460229505,
    0.033555944162842376, -1.6043551054948433, -0.012994947390024759, 0.01580810546875,
    0.0157470703125, 0.62017822265625, 0.21098227575839357, 0.20686657522879023, 0.2068086571426197,
    -1.5197143074849013, -0.0508188719623078, -1.5198693623587485, -0.06513709210776798,
    -1.5055742582206773, -0.05101601506345277
};
static double at_platform_coupling[] = {
    1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.012995751727453693, 0.003347390596465345, 1.0,
    1.0, 0.0033489932923590664, -0.03356873276576382, 0.013003000167041536, 1.0,
    -0.03357138224945269, 3.2260969136757773, 0.0001403175088521454, 0.0, 0.0, -3.225824521129574,
    0.0, 0.0, 3.227641535412409, -0.00036285210690062674, 0.0, 0.0, -3.227623435344588,
    -0.0014074830465624641, 0.0, 3.2278962838910386, -3.2260788395813096, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.05112649640899802, 0.05092909680896328, 1.0, 1.0,
    0.05097103746546799, 0.06531405033365781, 0.0511691158977287, 1.0, 0.06531470932737107,
    3.234195046969203, 0.00839932691734234, 0.0, 0.0, -3.2299763543081985, 0.0, 0.0,
    3.2368584412179358, 0.010747982296217236, 0.0, 0.0, -3.232661861999762, 0.010772046901964785,
    0.0, 3.2368910998779423, -3.230008805095861, 0.0, 0.0
};

static double out[STATES * 489], worst;
static double product[STATES * N];
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("orthoglide_2003: the %s is %s,\nthe header %s\n", part, signature, header);
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
    enum { STEPS = 40, U = 12 };
    static double values[STATES][48], f[9], at[N];
    static struct orthoglide_2003_posture sparse, dense;
    static struct orthoglide_2003_state state, other;
    static const double none[9] = {0};
    const double *const home = orthoglide_2003_home;
    static double phi[N * C], rows[U * C], torques[N];

    for (int i = 0; i < STATES; i++) {
        {
            const modeler_closure *const own = &orthoglide_2003_loops;
            modeler_closure loops = *own;

            loops.limits = none;
            expect("a stored state",
                   orthoglide_2003_posed(own, q + i * N, home, &sparse) ==
                       MODELER_CLOSED);
            expect("a state with rows exchanged",
                   orthoglide_2003_posed(&loops, q + i * N, home, &dense) ==
                       MODELER_CLOSED);
            orthoglide_2003_moved(&loops, qd + i * N, &sparse);
            orthoglide_2003_moved(&loops, qd + i * N, &dense);
            compare("postures, rows exchanged", dense.u, sparse.u, 1, U, TOLERANCE);
            compare("coupling, rows exchanged", dense.G, sparse.G, 1, U * 3, TOLERANCE);
            compare("drift, rows exchanged", dense.gamma, sparse.gamma, 1, U, TOLERANCE);
            other.at = dense;
        }
        {
            const modeler_closure *const own = &orthoglide_2003_platform_loops;
            modeler_closure loops = *own;

            loops.limits = none;
            expect("a stored state",
                   orthoglide_2003_posed(own, x + i * N, home, &sparse) ==
                       MODELER_CLOSED);
            expect("a state with rows exchanged",
                   orthoglide_2003_posed(&loops, x + i * N, home, &dense) ==
                       MODELER_CLOSED);
            orthoglide_2003_moved(&loops, qd + i * N, &sparse);
            orthoglide_2003_moved(&loops, qd + i * N, &dense);
            compare("postures, rows exchanged", dense.u, sparse.u, 1, U, TOLERANCE);
            compare("coupling, rows exchanged", dense.G, sparse.G, 1, U * 3, TOLERANCE);
            compare("drift, rows exchanged", dense.gamma, sparse.gamma, 1, U, TOLERANCE);
        }
        expect("a stored state",
               orthoglide_2003_state(q + i * N, qd + i * N, NULL, &state) ==
                   MODELER_CLOSED);
        expect("a state that is kept",
               orthoglide_2003_state(q + i * N, qd + i * N, other.at.u, &other) ==
                   MODELER_CLOSED);
        expect("rows exchanged", other.at.kept.dense[other.at.kept.at] != 0);
        expect("rates",
               orthoglide_2003_coupling_rate_at(&state, NULL) == MODELER_CLOSED);
        expect("rates, rows exchanged",
               orthoglide_2003_coupling_rate_at(&other, NULL) == MODELER_CLOSED);
        compare("rate, rows exchanged", other.rate, state.rate, 1, U * 3, TOLERANCE);
        dense = other.at;
        for (int k = 0; k < U * C; k++) {
            rows[k] = NAN;
        }
        for (int k = 0; k < N * C; k++) {
            phi[k] = NAN;
        }
        expect("rows of a regressor",
               orthoglide_2003_tree_next(q + i * N, qd + i * N, qdd + i * N, 1,
                   &dense, rows, phi) == MODELER_CLOSED);
        for (int j = 0; j < N; j++) {
            torques[j] = 0;
            for (int k = 0; k < C; k++) {
                torques[j] += phi[j * C + k] * beta[k];
            }
        }
        compare("regressor, rows exchanged", torques, at_inverse_dynamics + i * N, 1, N, TOLERANCE);
        orthoglide_2003_tree_closure(state.at.u, values[i]);
        orthoglide_2003_tree_residual(state.at.u, f);
        for (int k = 0; k < 9; k++) {
            expect("residuals", modeler_fabs(f[k] - values[i][k]) <= 1e-14);
        }
    }
    for (int i = 0; i <= STEPS; i++) { /* back to the first state */
        for (int j = 0; j < N; j++) {
            at[j] = i < STEPS ? q[N + j] + (double)i / (double)STEPS * (q[j] - q[N + j]) : q[j];
        }
        expect("a path",
               orthoglide_2003_state_with_bound(at, qd + 0, state.at.u, 50,
                   &state) == MODELER_CLOSED);
    }
    expect("its end",
           orthoglide_2003_state(q, qd + 0, NULL, &other) == MODELER_CLOSED);
    compare("a path", state.at.u, other.at.u, 1, U, TOLERANCE);
    compare("a path's coupling", state.at.G, other.at.G, 1, U * 3, TOLERANCE);
    at[0] = NAN;
    expect("a cycle that fails",
           orthoglide_2003_state(at, qd + 0, state.at.u, &state) ==
               MODELER_NOT_FINITE);
    compare("the last posture", state.at.u, other.at.u, 1, U, TOLERANCE);
    check_elimination(values[0] + 9, values[1] + 9);
    check_platform_elimination(values[0] + 9, values[1] + 9);
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = N * C };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static int told[MANY], closed[MANY], singles;

static int counted_next(const double *at, const double *speed, const double *acceleration, int next,
                        struct orthoglide_2003_posture *p, double *rows, double *phi)
{
    singles++;
    return orthoglide_2003_tree_next(at, speed, acceleration, next, p, rows, phi);
}

/* W by rows, W by columns, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work,
                         const modeler_closure *loops)
{
    const struct orthoglide_2003_single counted = {
        loops, orthoglide_2003_posed, counted_next, modeler_eliminated
    };
    modeler_tiled own = *orthoglide_2003_tiled();
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
    const size_t room = modeler_tile_work(orthoglide_2003_tiled());
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
        orthoglide_2003_observation(MANY, Q, QD, QDD, one, told);
        for (int k = 0; k < 2 * 5 * 8; k++) {
            compare_tile(k / 40, counts[k / 8 % 5], k % 8, work,
                         &orthoglide_2003_loops);
            expect("samples side by side", way > 0 || singles < 3);
        }
    }
    for (int j = 0; j <= 9; j++) { /* in doubt, they are closed one after another */
        double limits[9];
        modeler_closure strict = orthoglide_2003_loops;

        memcpy(limits, strict.limits, sizeof(limits));
        strict.limits = limits;
        if (j < 9) {
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
    if (!belongs("library", orthoglide_2003_signature(),
            ORTHOGLIDE_2003_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", orthoglide_2003_tile_signature(),
            ORTHOGLIDE_2003_SIGNATURE)) {
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

        modeler_batch_1(orthoglide_2003_base_parameters, 1, inputs,
            out, 43);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("orthoglide_2003_base_parameters", out,
            beta, 1, 43, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2003_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("orthoglide_2003_inverse_dynamics", out,
            at_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2003_gravity, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("orthoglide_2003_gravity", out,
            at_gravity, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2003_coriolis, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("orthoglide_2003_coriolis", out,
            at_coriolis, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {beta, 0}, };

        modeler_batch_status_3(orthoglide_2003_friction, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("orthoglide_2003_friction", out,
            at_friction, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {beta, 0}, };

        modeler_batch_status_2(orthoglide_2003_inertia_matrix, 2, inputs,
            out, 9, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("orthoglide_2003_inertia_matrix", out,
            at_inertia_matrix, 2, 9, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_forward_kinematics, 2, inputs,
            out, 252, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("orthoglide_2003_forward_kinematics", out,
            at_forward_kinematics, 2, 252, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("orthoglide_2003_close", out,
            at_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2003_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("orthoglide_2003_close_from", out,
            at_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, };

        modeler_batch_status_1(orthoglide_2003_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("orthoglide_2003_coupling", out,
            at_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, {beta, 0}, };

        modeler_batch_status_4(orthoglide_2003_platform_inverse_dynamics, 2, inputs,
            out, 3, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_inverse_dynamics, out, sizeof(at_platform_inverse_dynamics));
    }
    compare("orthoglide_2003_platform_inverse_dynamics", out,
            at_platform_inverse_dynamics, 2, 3, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2003_platform_close, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close, out, sizeof(at_platform_close));
    }
    compare("orthoglide_2003_platform_close", out,
            at_platform_close, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {start, 12}, };

        modeler_batch_status_2(orthoglide_2003_platform_close_from, 2, inputs,
            out, 12, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close_from, out, sizeof(at_platform_close_from));
    }
    compare("orthoglide_2003_platform_close_from", out,
            at_platform_close_from, 2, 12, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, };

        modeler_batch_status_1(orthoglide_2003_platform_coupling, 2, inputs,
            out, 36, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_coupling, out, sizeof(at_platform_coupling));
    }
    compare("orthoglide_2003_platform_coupling", out,
            at_platform_coupling, 2, 36, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_regressor, 2, inputs,
            out, 489, status);
    }
    multiply(out, 163, chi);
    compare("orthoglide_2003_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 3}, {qd, 3}, {qdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_base_regressor, 2, inputs,
            out, 129, status);
    }
    multiply(out, 43, beta);
    compare("orthoglide_2003_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 3}, {xd, 3}, {xdd, 3}, };

        modeler_batch_status_3(orthoglide_2003_platform_base_regressor, 2, inputs,
            out, 129, status);
    }
    multiply(out, 43, beta);
    compare("orthoglide_2003_platform_base_regressor", product,
            at_platform_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    orthoglide_2003_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("orthoglide_2003_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("orthoglide_2003_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("orthoglide_2003 %s:\n", ORTHOGLIDE_2003_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("18 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
