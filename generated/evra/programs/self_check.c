/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
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

#include "evra.h"
#include "evra_batch.h"
#include "modeler_batch.h"
#include "modeler_closure.h"
#include "evra_tree.h"
#include "modeler_sincos.h"
#include "modeler_solve.h"
#include "evra_tile.h"

#define N 8
#define C 90
#define STATES 2
#define TOLERANCE 1e-9 /* of the largest number of an output ... */
#define LEAST 1e-3      /* ... or of this, where all are smaller */
#define ROUNDINGS 1.5e-14 /* 64 of them */

#if EVRA_JOINTS != N || EVRA_BASE_PARAMETERS != C \
    || EVRA_STANDARD_PARAMETERS != 210
#error the header has other lengths
#endif

/* Where -D replaces a length or a width, no stored number holds: then what the functions give is
 * taken for it, and checked by what else they give. */
#define REPLACED 0
#ifdef EVRA_GEO_g
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_RB
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_RP
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta1
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta5
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_beta6
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi1
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi2
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi3
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi4
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi5
#undef REPLACED
#define REPLACED 1
#endif
#ifdef EVRA_GEO_phi6
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
    enum { S = 18, Z = 132 };
    const modeler_closure *const loops = &evra_loops;
    const modeler_real *const scale = loops->scale;
    const int *const solved = loops->solved_places;
    static modeler_real lu[107], G[144], right[S], x[S], A[S * S], B[Z], sum;
    static modeler_real whole[26 * 8];
    modeler_real added = 0;

    evra_tree_factor(J, lu);
    for (int j = 0; j < S; j++) {
        if (!(modeler_fabs(lu[j]) <= loops->limits[j])) {
            return; /* rows are exchanged here */
        }
    }
    evra_tree_turned(J, J, lu, x);
    evra_tree_spread(J, J, lu, &sum);
    for (int i = 0; i < S; i++) {
        expect("a Jacobian that stays", x[i] == 0 && sum == 0);
    }
    evra_tree_coupling(J, lu, G);
    memset(whole, 0, sizeof(whole));
    for (int j = 0; j < 8; j++) {
        whole[loops->given_places[j] * 8 + j] = 1;
    }
    for (int k = 0; k < 144; k++) {
        whole[loops->coupling_row[k] * 8 + loops->coupling_column[k]] += G[k];
    }
    for (int j = 0; j < 8; j++) {
        memset(right, 0, sizeof(right));
        memset(x, 0, sizeof(x));
        for (int k = 0; k < Z; k++) {
            const modeler_real term = J[k] * whole[loops->column[k] * 8 + j];
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
        evra_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            expect("J^-1 J = 1", modeler_fabs(x[i] - (i == j)) * scale[solved[j]] <=
                                     1e-8 * scale[solved[i]]);
        }
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = K[k] - J[k];
            }
        }
        evra_tree_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            A[i * S + j] = x[i] * scale[solved[j]] / scale[solved[i]];
            added += A[i * S + j] * A[i * S + j];
        }
    }
    evra_tree_spread(J, K, lu, &sum);
    expect("how far a Jacobian turns", modeler_fabs(sum - added) <= 1e-9 * added);
    evra_tree_turned(J, K, lu, x);
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

        for (int j = 0; j < 8; j++) {
            given |= loops->given_places[j] == column;
        }
        memcpy(B, J, sizeof(B));
        B[k] = K[k];
        evra_tree_turned(J, B, lu, x);
        memset(right, 0, sizeof(right));
        right[loops->row[k]] = B[k] - J[k];
        evra_tree_solve(lu, right, A);
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
    enum { S = 18, Z = 132 };
    const modeler_closure *const loops = &evra_platform_loops;
    const modeler_real *const scale = loops->scale;
    const int *const solved = loops->solved_places;
    static modeler_real lu[54], G[144], right[S], x[S], A[S * S], B[Z], sum;
    static modeler_real whole[26 * 8];
    modeler_real added = 0;

    evra_tree_platform_factor(J, lu);
    for (int j = 0; j < S; j++) {
        if (!(modeler_fabs(lu[j]) <= loops->limits[j])) {
            return; /* rows are exchanged here */
        }
    }
    evra_tree_platform_turned(J, J, lu, x);
    evra_tree_platform_spread(J, J, lu, &sum);
    for (int i = 0; i < S; i++) {
        expect("a Jacobian that stays", x[i] == 0 && sum == 0);
    }
    evra_tree_platform_coupling(J, lu, G);
    memset(whole, 0, sizeof(whole));
    for (int j = 0; j < 8; j++) {
        whole[loops->given_places[j] * 8 + j] = 1;
    }
    for (int k = 0; k < 144; k++) {
        whole[loops->coupling_row[k] * 8 + loops->coupling_column[k]] += G[k];
    }
    for (int j = 0; j < 8; j++) {
        memset(right, 0, sizeof(right));
        memset(x, 0, sizeof(x));
        for (int k = 0; k < Z; k++) {
            const modeler_real term = J[k] * whole[loops->column[k] * 8 + j];
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
        evra_tree_platform_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            expect("J^-1 J = 1", modeler_fabs(x[i] - (i == j)) * scale[solved[j]] <=
                                     1e-8 * scale[solved[i]]);
        }
        for (int k = 0; k < Z; k++) {
            if (loops->column[k] == solved[j]) {
                right[loops->row[k]] = K[k] - J[k];
            }
        }
        evra_tree_platform_solve(lu, right, x);
        for (int i = 0; i < S; i++) {
            A[i * S + j] = x[i] * scale[solved[j]] / scale[solved[i]];
            added += A[i * S + j] * A[i * S + j];
        }
    }
    evra_tree_platform_spread(J, K, lu, &sum);
    expect("how far a Jacobian turns", modeler_fabs(sum - added) <= 1e-9 * added);
    evra_tree_platform_turned(J, K, lu, x);
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

        for (int j = 0; j < 8; j++) {
            given |= loops->given_places[j] == column;
        }
        memcpy(B, J, sizeof(B));
        B[k] = K[k];
        evra_tree_platform_turned(J, B, lu, x);
        memset(right, 0, sizeof(right));
        right[loops->row[k]] = B[k] - J[k];
        evra_tree_platform_solve(lu, right, A);
        for (int i = 0; i < S && given == 0; i++) {
            expect("a bound of each entry",
                   x[i] >= 0.999999999 * modeler_fabs(A[i]) *
                               scale[column] / scale[solved[i]]);
        }
    }
}


/* Inputs, one row for each state; and what the functions give at_ these. */
static double q[] = {
    0.017578125, -0.0106201171875, 0.82220458984375, 0.79095458984375, 0.78167724609375,
    0.79888916015625, 0.81884765625, 0.83587646484375, -0.00811767578125, 0.01751708984375,
    0.78228759765625, 0.80755615234375, 0.80303955078125, 0.8135986328125, 0.80938720703125,
    0.83319091796875
};
static double qd[] = {
    1.0, -1.3125, 1.625, -1.125, 1.4375, -1.75, 1.25, -1.5625, -0.0185546875, 0.0234375, -0.015625,
    0.0205078125, -0.025390625, 0.017578125, -0.0224609375, 0.02734375
};
static double qdd[] = {
    -2.125, -0.875, 0.375, 1.625, -2.875, -1.625, -0.375, 0.875, -0.375, 0.875, 2.125, -2.375,
    -1.125, 0.125, 1.375, 2.625
};
static double chi[] = {
    33.238525390625, 1.126953125, 1.015380859375, 33.90380859375, 1.792236328125, 33.6806640625,
    1.569091796875, 1.45751953125, 1.345947265625, 1.234375, 33.122802734375, 1.01123046875,
    1.899658203125, 33.7880859375, 1.676513671875, 33.56494140625, 1.453369140625, 1.341796875,
    1.230224609375, 1.11865234375, 33.007080078125, 1.8955078125, 1.783935546875, 33.67236328125,
    1.560791015625, 33.44921875, 1.337646484375, 1.22607421875, 1.114501953125, 1.0029296875,
    33.891357421875, 1.77978515625, 1.668212890625, 33.556640625, 1.445068359375, 33.33349609375,
    1.221923828125, 1.1103515625, 1.998779296875, 1.88720703125, 33.775634765625, 1.6640625,
    1.552490234375, 33.44091796875, 1.329345703125, 33.2177734375, 1.106201171875, 1.99462890625,
    1.883056640625, 1.771484375, 33.659912109375, 1.54833984375, 1.436767578125, 33.3251953125,
    1.213623046875, 33.10205078125, 1.990478515625, 1.87890625, 1.767333984375, 1.65576171875,
    33.544189453125, 1.4326171875, 1.321044921875, 33.20947265625, 1.097900390625, 33.986328125,
    1.874755859375, 1.76318359375, 1.651611328125, 1.5400390625, 33.428466796875, 1.31689453125,
    1.205322265625, 33.09375, 1.982177734375, 33.87060546875, 1.759033203125, 1.6474609375,
    1.535888671875, 1.42431640625, 33.312744140625, 1.201171875, 1.089599609375, 33.97802734375,
    1.866455078125, 33.7548828125, 1.643310546875, 1.53173828125, 1.420166015625, 1.30859375,
    33.197021484375, 1.08544921875, 1.973876953125, 33.8623046875, 1.750732421875, 33.63916015625,
    1.527587890625, 1.416015625, 1.304443359375, 1.19287109375, 33.081298828125, 1.9697265625,
    1.858154296875, 33.74658203125, 1.635009765625, 33.5234375, 1.411865234375, 1.30029296875,
    1.188720703125, 1.0771484375, 33.965576171875, 1.85400390625, 1.742431640625, 33.630859375,
    1.519287109375, 33.40771484375, 1.296142578125, 1.1845703125, 1.072998046875, 1.96142578125,
    33.849853515625, 1.73828125, 1.626708984375, 33.51513671875, 1.403564453125, 33.2919921875,
    1.180419921875, 1.06884765625, 1.957275390625, 1.845703125, 33.734130859375, 1.62255859375,
    1.510986328125, 33.3994140625, 1.287841796875, 33.17626953125, 1.064697265625, 1.953125,
    1.841552734375, 1.72998046875, 33.618408203125, 1.5068359375, 1.395263671875, 33.28369140625,
    1.172119140625, 33.060546875, 1.948974609375, 1.83740234375, 1.725830078125, 1.6142578125,
    33.502685546875, 1.39111328125, 1.279541015625, 33.16796875, 1.056396484375, 33.94482421875,
    1.833251953125, 1.7216796875, 1.610107421875, 1.49853515625, 33.386962890625, 1.275390625,
    1.163818359375, 33.05224609375, 1.940673828125, 33.8291015625, 1.717529296875, 1.60595703125,
    1.494384765625, 1.3828125, 33.271240234375, 1.15966796875, 1.048095703125, 33.9365234375,
    1.824951171875, 33.71337890625, 1.601806640625, 1.490234375, 1.378662109375, 1.26708984375,
    33.155517578125, 1.0439453125, 1.932373046875, 33.82080078125, 1.709228515625, 33.59765625,
    1.486083984375, 1.37451171875, 1.262939453125, 1.1513671875, 33.039794921875, 1.92822265625,
    1.816650390625, 33.705078125, 1.593505859375, 33.48193359375, 1.370361328125, 1.2587890625,
    1.147216796875, 1.03564453125, 33.924072265625, 1.8125, 1.700927734375, 33.58935546875,
    1.477783203125, 33.3662109375, 1.254638671875, 1.14306640625, 1.031494140625, 1.919921875
};
static double beta[] = {
    33.78738619855683, 1.1485235066744337, 1.015380859375, 34.5465115065213, 1.792236328125,
    34.87222778320312, 1.4493830272565889, 1.4214375112382882, 1.345947265625, 10.96142578125,
    1.11865234375, 18.5400390625, 99.87646484375, 1.221923828125, -0.772705078125, 0.892578125,
    0.227294921875, 3.100830078125, 0.11572265625, 66.54296875, 1.106201171875, 1.99462890625,
    1.990478515625, 1.87890625, 1.767333984375, 100.8349609375, 1.874755859375, 0.227294921875,
    -0.107421875, 0.227294921875, 2.406494140625, 0.11572265625, 67.8486328125, 1.759033203125,
    1.6474609375, 1.643310546875, 1.53173828125, 1.420166015625, 100.79345703125, 1.527587890625,
    0.227294921875, -0.107421875, 0.227294921875, 3.712158203125, 0.11572265625, 67.154296875,
    1.411865234375, 1.30029296875, 1.296142578125, 1.1845703125, 1.072998046875, 99.751953125,
    1.180419921875, -0.772705078125, 0.892578125, 0.227294921875, 3.017822265625, 0.11572265625,
    66.4599609375, 1.064697265625, 1.953125, 1.948974609375, 1.83740234375, 1.725830078125,
    100.71044921875, 1.833251953125, 0.227294921875, -0.107421875, 0.227294921875, 2.323486328125,
    0.11572265625, 67.765625, 1.717529296875, 1.60595703125, 1.601806640625, 1.490234375,
    1.378662109375, 100.6689453125, 1.486083984375, 0.227294921875, -0.107421875, 0.227294921875,
    3.629150390625, 0.11572265625, 67.0712890625, 1.370361328125, 1.2587890625, 1.254638671875,
    1.14306640625, 1.031494140625
};
static double x[] = {
    -0.00469970703125, 0.0018310546875, 0.70111083984375, -0.03790283203125, -0.05572509765625,
    -0.004150390625, 0.017578125, -0.0106201171875, -0.00811767578125, 0.0023193359375,
    0.70111083984375, -0.05340576171875, 0.00482177734375, -0.0594482421875, -0.00811767578125,
    0.01751708984375
};
static double xd[] = {
    1.0, -1.3125, 1.625, -1.125, 1.4375, -1.75, 1.25, -1.5625, -0.0185546875, 0.0234375, -0.015625,
    0.0205078125, -0.025390625, 0.017578125, -0.0224609375, 0.02734375
};
static double xdd[] = {
    -2.125, -0.875, 0.375, 1.625, -2.875, -1.625, -0.375, 0.875, -0.375, 0.875, 2.125, -2.375,
    -1.125, 0.125, 1.375, 2.625
};
static double start[] = {
    -0.008094130737027276, 0.002334498858967611, 0.7011161183035685, -0.05339893035822159,
    0.0048475476123692835, -0.0594208273999608, -0.00811767578125, 0.01751708984375,
    2.70330346152483, 0.24968419575457546, 0.78228759765625, 2.6561509738900195,
    -0.29550203718999307, 0.80755615234375, 2.6994010368451975, 0.2754762473938786,
    0.80303955078125, 2.698855775359899, -0.2876698145648972, 0.8135986328125, 2.739957667410457,
    0.2672396495011925, 0.80938720703125, 2.6942000109553144, -0.3112016046488061, 0.83319091796875,
    -0.004704353674880421, 0.001835888121362354, 0.7011045258315463, -0.037884416671847256,
    -0.05573539513091822, -0.004128591613370819, 0.017578125, -0.0106201171875, 2.678779606303682,
    0.2966718165333457, 0.82220458984375, 2.7181544607928383, -0.2677428585291169, 0.79095458984375,
    2.7160080945672553, 0.3027239696143293, 0.78167724609375, 2.694693101160413,
    -0.3187086584649846, 0.79888916015625, 2.705682351570816, 0.24466083622739948, 0.81884765625,
    2.682912357193885, -0.2627465667015268, 0.83587646484375
};
static double at_inverse_dynamics[] = {
    -171.15020687423484, -164.92486680541526, -1577.8612278530609, -318.77626639026647,
    -1961.397314706016, -873.0970134907452, -1309.1067301025028, -658.3547083569814,
    -43.19307641596145, 70.9945731083256, 1689.8115461111233, -1859.5197794822077,
    -225.16845860223498, 722.2165479232673, -778.9979395843377, 791.3038986219505
};
static double at_gravity[] = {
    0.0, 0.0, 13.581692185834086, 95.92015940865633, -17.576412291111264, 56.35114167285541,
    -13.152322428806245, 63.169517135768466, 0.0, 0.0, 27.65316287295377, 92.94980935744664,
    -21.67095217916871, 55.16530706089707, -8.538910414429221, 56.339570096602124
};
static double at_coriolis[] = {
    -109.26891796994082, -133.18509875637508, -1059.5290524148625, -1562.1271287853788,
    -882.1357465466099, -927.6566480723909, -1562.4272623216555, -744.6210983806046,
    -0.030172190800193142, -0.034476110802562306, -0.7244983485795023, -0.19370677882936949,
    -0.14166280578913162, -0.2684024617764946, -0.4226106724535499, 0.2693173652469425
};
static double at_friction[] = {
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};
static double at_inertia_matrix[] = {
    30.6201171875, 0.0, -7.048743260535092, 5.615268275051733, -3.6573004286902635,
    3.3519498018409886, 7.170092449426362, -6.48469456122623, 0.0, 29.50146484375,
    9.771314067133654, -8.853147839530935, -6.688169564372735, 6.81590144355196, 2.3703386508312208,
    -2.820153719353434, -7.048743260535092, 9.771314067133654, 549.990233984429, -367.9030067067764,
    -81.09711643624573, 187.3878922551663, -91.3642697995829, -125.32226869026483,
    5.615268275051733, -8.853147839530935, -367.9030067067764, 553.4108773950144,
    -138.06494807280603, -100.26191121378328, 203.73534506860537, -106.48455036742162,
    -3.6573004286902635, -6.688169564372735, -81.09711643624573, -138.06494807280603,
    552.4659638760261, -343.84261015631336, -115.87699124318208, 189.25648520821318,
    3.3519498018409886, 6.81590144355196, 187.3878922551663, -100.26191121378328,
    -343.84261015631336, 528.9876044756436, -125.93660948342695, -82.53534783456514,
    7.170092449426362, 2.3703386508312208, -91.3642697995829, 203.73534506860537,
    -115.87699124318208, -125.93660948342695, 560.195824447339, -389.42273509272917,
    -6.48469456122623, -2.820153719353434, -125.32226869026483, -106.48455036742162,
    189.25648520821318, -82.53534783456514, -389.42273509272917, 560.9616418621661, 30.6201171875,
    0.0, -6.846714791199375, 6.1175878437483515, -3.8950593645062606, 3.5000443414206397,
    7.316570067314557, -6.659638624743767, 0.0, 29.50146484375, 9.80483595805417,
    -8.725424894509874, -6.811409249028529, 6.530910405506367, 2.7283748761325133,
    -3.2661362723835254, -6.846714791199375, 9.80483595805417, 540.2886601175464,
    -344.9407868627922, -101.40618628924702, 185.06101198487994, -68.66724448704392,
    -136.53667214323556, 6.1175878437483515, -8.725424894509874, -344.9407868627922,
    551.4988549174515, -139.37868911251323, -83.28511608362372, 195.11799803847296,
    -119.70122680699701, -3.8950593645062606, -6.811409249028529, -101.40618628924702,
    -139.37868911251323, 569.5023407100474, -364.63387870487804, -112.97900569746663,
    200.84676282182613, 3.5000443414206397, 6.530910405506367, 185.06101198487994,
    -83.28511608362372, -364.63387870487804, 525.4219759119397, -117.84905283424142,
    -92.18575264914786, 7.316570067314557, 2.7283748761325133, -68.66724448704392,
    195.11799803847296, -112.97900569746663, -117.84905283424142, 548.4873063257284,
    -391.19892909170767, -6.659638624743767, -3.2661362723835254, -136.53667214323556,
    -119.70122680699701, 200.84676282182613, -92.18575264914786, -391.19892909170767,
    577.6304324985568
};
static double at_forward_kinematics[] = {
    0.0, 0.0, 1.0, -0.004704353674880421, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    -0.004704353674880421, 0.0, 0.0, 1.0, 0.001835888121362354, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    -0.004704353674880421, 0.0, 1.0, 0.0, 0.001835888121362354, 0.0, 0.0, 1.0, 0.7011045258315463,
    0.0, 0.0, 1.0, -0.004704353674880421, 0.9992824713110425, 0.037875355186393386, 0.0,
    0.001835888121362354, -0.037875355186393386, 0.9992824713110425, 0.0, 0.7011045258315463,
    -0.05570654322235922, 0.9984471849037462, 0.0, -0.004704353674880421, 0.03781654176308397,
    0.0021099051107530305, 0.9992824713110425, 0.001835888121362354, 0.9977307704041689,
    0.05566657217943453, -0.037875355186393386, 0.7011045258315463, 0.9984386755155535,
    0.004122168963384414, -0.05570654322235922, -0.004704353674880421, -0.0020157303812146296,
    0.9992826657158179, 0.03781654176308397, 0.001835888121362354, 0.05582246918381087,
    -0.03764520849890642, 0.9977307704041689, 0.7011045258315463, 0.0, 0.0, 1.0, 0.017578125, 1.0,
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.017578125, 0.0, 0.0, 1.0, -0.0106201171875,
    1.0, 0.0, 0.0, 0.0, -0.4396867008378282, 0.8812111980462061, -0.17361575258114187,
    0.6084662069275729, -0.07751370163045773, 0.15535139395531875, 0.9848134698792882,
    0.09354933436118512, 0.894800106820451, 0.44646698515580013, 0.0, 0.0, -0.03749371525416195,
    0.47123353632186443, -0.8812111980462061, 0.6084662069275729, 0.9644519202890509,
    -0.21377192951110682, -0.15535139395531875, 0.09354933436118512, -0.26158500485922753,
    -0.8557105330651764, -0.44646698515580013, 0.0, -0.03749371525416195, -0.8812111980462061,
    -0.47123353632186443, 0.22101583047543452, 0.9644519202890509, -0.15535139395531875,
    0.21377192951110682, 0.26931359598497173, -0.26158500485922753, -0.44646698515580013,
    0.8557105330651764, 0.7035691278638301, 0.1405497958847451, -0.311845869692599,
    -0.9396796839521556, -0.18765528593576283, -0.3861119508008035, 0.8566886656663674,
    -0.34205568489293803, 0.5531876931837933, 0.9116815871375018, 0.4108974125915684, 0.0, 0.0,
    -0.8690161522388965, -0.3841394026959088, 0.311845869692599, -0.18765528593576283,
    -0.4320164073528629, 0.2818622959828154, -0.8566886656663674, 0.5531876931837933,
    0.24119027950111963, -0.8791988201764867, -0.4108974125915684, 0.0, -0.8690161522388965,
    0.311845869692599, 0.3841394026959088, 0.11618153776640282, -0.4320164073528629,
    -0.8566886656663674, -0.2818622959828154, 0.33024741647228795, 0.24119027950111963,
    -0.4108974125915684, 0.8791988201764867, 0.6954063422038019, 0.26536810053883064,
    -0.5854298256228941, -0.766062458607365, -0.3680815584314913, -0.31627138889801315,
    0.6977278115799044, -0.6427661390524855, 0.449017357976919, 0.9107975514794354,
    0.41285326717741405, 0.0, 0.0, -0.8103399476588132, -0.02492164720598777, 0.5854298256228941,
    -0.3680815584314913, -0.5192509761595215, 0.49351223359234114, -0.6977278115799044,
    0.449017357976919, -0.27152825448872897, -0.8693817267433442, -0.41285326717741405, 0.0,
    -0.8103399476588132, 0.5854298256228941, 0.02492164720598777, -0.3486008738753948,
    -0.5192509761595215, -0.6977278115799044, -0.49351223359234114, 0.06325007430888235,
    -0.27152825448872897, -0.41285326717741405, 0.8693817267433442, 0.6795759139649664,
    0.27778044423679293, -0.5796308005007448, 0.7660719025721253, -0.3680748050189857,
    0.3310745650033059, -0.6908370229788988, -0.6427548833649762, -0.4702632587307752,
    0.9017913601313121, 0.4321716589418124, 0.0, 0.0, 0.8145330310812035, -0.02375029238837252,
    0.5796308005007448, -0.3680748050189857, -0.5066472133932591, -0.5158030717652792,
    0.6908370229788988, -0.4702632587307752, 0.28256776609959017, -0.8563779041807239,
    -0.4321716589418124, 0.0, 0.8145330310812035, 0.5796308005007448, 0.02375029238837252,
    -0.3491009538793734, -0.5066472133932591, 0.6908370229788988, 0.5158030717652792,
    -0.05819377592219735, 0.28256776609959017, -0.4321716589418124, 0.8563779041807239,
    0.684151024647308, 0.14442230980076573, -0.3100561932141464, 0.9396847096134765,
    -0.1876470019867048, 0.3967684802718098, -0.8518110861829412, -0.34204187831117466,
    -0.5744309429555858, 0.9064860558743362, 0.4222357522822882, 0.0, 0.0, 0.8767174398576841,
    -0.3677386132825053, 0.3100561932141464, -0.1876470019867048, -0.4279638602378462,
    -0.30210065836763605, 0.8518110861829412, -0.5744309429555858, -0.21957564751062278,
    -0.8794904800592789, -0.4222357522822882, 0.0, 0.8767174398576841, 0.3100561932141464,
    0.3677386132825053, 0.11347489961229974, -0.4279638602378462, 0.8518110861829412,
    0.30210065836763605, -0.32705652689966513, -0.21957564751062278, -0.4222357522822882,
    0.8794904800592789, 0.7201687182907279, -0.4360422594086778, 0.8830230702501194,
    0.17360128287494864, 0.6084677374068369, 0.07686460621235496, -0.15565743710998053,
    0.9848160206780615, -0.11478088691246918, 0.8966375969819662, 0.4427651970044677, 0.0, 0.0,
    0.054388401822159885, 0.4661675226281684, -0.8830230702501194, 0.6084677374068369,
    0.9709817150510214, 0.1815634085076879, 0.15565743710998053, -0.11478088691246918,
    0.23288712026174477, -0.8658652144172247, -0.4427651970044677, 0.0, 0.054388401822159885,
    -0.8830230702501194, -0.4661675226281684, 0.21880927656743468, 0.9709817150510214,
    0.15565743710998053, -0.1815634085076879, -0.266545466960857, 0.23288712026174477,
    -0.4427651970044677, 0.8658652144172247, 0.7237563544582454, 0.0, 0.0, 1.0,
    -0.008094130737027276, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    -0.008094130737027276, 0.0, 0.0, 1.0, 0.002334498858967611, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    -0.008094130737027276, 0.0, 1.0, 0.0, 0.002334498858967611, 0.0, 0.0, 1.0, 0.7011161183035685,
    0.0, 0.0, 1.0, -0.008094130737027276, 0.9985746158670559, 0.0533735566171274, 0.0,
    0.002334498858967611, -0.0533735566171274, 0.9985746158670559, 0.0, 0.7011161183035685,
    0.004847528627199319, 0.9999882506640808, 0.0, -0.008094130737027276, 0.0533729295132815,
    -0.0002587298436369687, 0.9985746158670559, 0.002334498858967611, 0.9985628832784537,
    -0.004840619036810117, -0.0533735566171274, 0.7011161183035685, 0.9982233734246246,
    0.05938516830801223, 0.004847528627199319, -0.008094130737027276, -0.059559491593168604,
    0.9967968686529536, 0.0533729295132815, 0.002334498858967611, -0.0016624409540599366,
    -0.05356682208882189, 0.9985628832784537, 0.7011161183035685, 0.0, 0.0, 1.0, -0.00811767578125,
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.00811767578125, 0.0, 0.0, 1.0,
    0.01751708984375, 1.0, 0.0, 0.0, 0.0, -0.4179459596688141, 0.8917279547329431,
    -0.17361575258114187, 0.5827704061463229, -0.07368096045136638, 0.1572054248786614,
    0.9848134698792882, 0.12168654139243512, 0.9054790394390575, 0.4243909861631392, 0.0, 0.0,
    -0.06495842156684602, 0.44788576469379576, -0.8917279547329431, 0.5827704061463229,
    0.9724813161670608, -0.17194924860173316, -0.1572054248786614, 0.12168654139243512,
    -0.22374202370928223, -0.8774005913435169, -0.4243909861631392, 0.0, -0.06495842156684602,
    -0.8917279547329431, -0.44788576469379576, 0.23239492725958097, 0.9724813161670608,
    -0.1572054248786614, 0.17194924860173316, 0.25620030599988225, -0.22374202370928223,
    -0.4243909861631392, 0.8774005913435169, 0.6863796007842929, 0.15960285998780416,
    -0.30253763179361726, -0.9396796839521556, -0.21335108671701283, -0.43845365434619704,
    0.8311175015741689, -0.34205568489293803, 0.5813249002150433, 0.8844689480553735,
    0.46659905692770215, 0.0, 0.0, -0.8524706926564837, -0.42633871453397787, 0.30253763179361726,
    -0.21335108671701283, -0.45491618865422495, 0.31983583269769034, -0.8311175015741689,
    0.5813249002150433, 0.2575751918607237, -0.8461325786258855, -0.46659905692770215, 0.0,
    -0.8524706926564837, 0.30253763179361726, 0.42633871453397787, 0.13094136518722674,
    -0.45491618865422495, -0.8311175015741689, -0.31983583269769034, 0.3230395057800372,
    0.2575751918607237, -0.46659905692770215, 0.8461325786258855, 0.6832995695678157,
    0.2750533278877227, -0.5809423175585748, -0.766062458607365, -0.3937773592127413,
    -0.3278144504009118, 0.6923795033042999, -0.6427661390524855, 0.477154565008169,
    0.9038159950599663, 0.4279213094410734, 0.0, 0.0, -0.8119946112092394, -0.05630963538177215,
    0.5809423175585748, -0.3937773592127413, -0.5293638791088097, 0.49029022721135745,
    -0.6923795033042999, 0.477154565008169, -0.24584270349560863, -0.8697383043560905,
    -0.4279213094410734, 0.0, -0.8119946112092394, 0.5809423175585748, 0.05630963538177215,
    -0.348558494911107, -0.5293638791088097, -0.6923795033042999, -0.49029022721135745,
    0.08343212119592353, -0.24584270349560863, -0.4279213094410734, 0.8697383043560905,
    0.698434257227361, 0.2753652303601031, -0.5807820847772868, 0.7660719025721253,
    -0.3937706058002357, 0.32819597545459955, -0.6922091891949136, -0.6427548833649762,
    -0.4421260516995252, 0.9035825317059484, 0.4284140618558975, 0.0, 0.0, 0.8127183937453913,
    -0.04670099002868694, 0.5807820847772868, -0.3937706058002357, -0.5232272482929827,
    -0.4970711066214507, 0.6922091891949136, -0.4421260516995252, 0.25636313914380204,
    -0.8664521524541715, -0.4284140618558975, 0.0, 0.8127183937453913, 0.5807820847772868,
    0.04670099002868694, -0.35577474416190585, -0.5232272482929827, 0.6922091891949136,
    0.4970711066214507, -0.037709678941716444, 0.25636313914380204, -0.4284140618558975,
    0.8664521524541715, 0.7049442866341618, 0.1337122913802902, -0.3148232355663552,
    0.9396847096134765, -0.2133428027679548, 0.36734506405420936, -0.8649074848770661,
    -0.34204187831117466, -0.5462937359243358, 0.9204230695983457, 0.3909237431407292, 0.0, 0.0,
    0.8710197722388411, -0.3771085874340819, 0.3148232355663552, -0.2133428027679548,
    -0.42690542725839115, -0.26398257287358595, 0.8649074848770661, -0.5462937359243358,
    -0.24305619215796145, -0.887751268375615, -0.3909237431407292, 0.0, 0.8710197722388411,
    0.3148232355663552, 0.3771085874340819, 0.09188406356281664, -0.42690542725839115,
    0.8649074848770661, 0.26398257287358595, -0.3326296185612607, -0.24305619215796145,
    -0.3909237431407292, 0.887751268375615, 0.7185345196489887, -0.42604743436059966,
    0.8878886068978037, 0.17360128287494864, 0.5827719366255869, 0.0751027396159298,
    -0.15651512360794337, 0.9848160206780615, -0.08664367988121918, 0.9015781508981527,
    0.432616270871852, 0.0, 0.0, 0.034805681215682796, 0.45873999857892234, -0.8878886068978037,
    0.5827719366255869, 0.9605083506068928, 0.2300580893957361, 0.15651512360794337,
    -0.08664367988121918, 0.2760657040806383, -0.8582720368317925, -0.432616270871852, 0.0,
    0.034805681215682796, -0.8878886068978037, -0.45873999857892234, 0.20055393610063152,
    0.9605083506068928, 0.15651512360794337, -0.2300580893957361, -0.27832599057098933,
    0.2760657040806383, -0.432616270871852, 0.8582720368317925, 0.71510446623479
};
static double at_close[] = {
    -0.004704353674880421, 0.001835888121362354, 0.7011045258315463, -0.037884416671847256,
    -0.05573539513091822, -0.004128591613370819, 0.017578125, -0.0106201171875, 2.678779606303682,
    0.2966718165333457, 0.82220458984375, 2.7181544607928383, -0.2677428585291169, 0.79095458984375,
    2.7160080945672553, 0.3027239696143293, 0.78167724609375, 2.694693101160413,
    -0.3187086584649846, 0.79888916015625, 2.705682351570816, 0.24466083622739948, 0.81884765625,
    2.682912357193885, -0.2627465667015268, 0.83587646484375, -0.008094130737027276,
    0.002334498858967611, 0.7011161183035685, -0.05339893035822159, 0.0048475476123692835,
    -0.0594208273999608, -0.00811767578125, 0.01751708984375, 2.70330346152483, 0.24968419575457546,
    0.78228759765625, 2.6561509738900195, -0.29550203718999307, 0.80755615234375,
    2.6994010368451975, 0.2754762473938786, 0.80303955078125, 2.698855775359899,
    -0.2876698145648972, 0.8135986328125, 2.739957667410457, 0.2672396495011925, 0.80938720703125,
    2.6942000109553144, -0.3112016046488061, 0.83319091796875
};
static double at_close_from[] = {
    -0.004704353674880421, 0.001835888121362354, 0.7011045258315463, -0.037884416671847256,
    -0.05573539513091822, -0.004128591613370819, 0.017578125, -0.0106201171875, 2.678779606303682,
    0.2966718165333457, 0.82220458984375, 2.7181544607928383, -0.2677428585291169, 0.79095458984375,
    2.7160080945672553, 0.3027239696143293, 0.78167724609375, 2.694693101160413,
    -0.3187086584649846, 0.79888916015625, 2.705682351570816, 0.24466083622739948, 0.81884765625,
    2.682912357193885, -0.2627465667015268, 0.83587646484375, -0.008094130737027276,
    0.002334498858967611, 0.7011161183035685, -0.05339893035822159, 0.0048475476123692835,
    -0.0594208273999608, -0.00811767578125, 0.01751708984375, 2.70330346152483, 0.24968419575457546,
    0.78228759765625, 2.6561509738900195, -0.29550203718999307, 0.80755615234375,
    2.6994010368451975, 0.2754762473938786, 0.80303955078125, 2.698855775359899,
    -0.2876698145648972, 0.8135986328125, 2.739957667410457, 0.2672396495011925, 0.80938720703125,
    2.6942000109553144, -0.3112016046488061, 0.83319091796875
};
static double at_coupling[] = {
    1.0, 0.0, -0.5272783165863525, 0.6604701680429921, -0.13453314392638221, -0.1351482867425567,
    0.6656186736610974, -0.5568922257482937, 0.0, 1.0, 0.4462856174437035, -0.24042605761525462,
    -0.6745957377659223, 0.6671189296635022, 0.2615188091285292, -0.44503116356657346, 0.0, 0.0,
    0.17298024759867614, 0.2123298789072798, 0.200966234306491, 0.1809508502612898,
    0.20367046806205133, 0.18073700046336133, 0.0, 0.0, 1.0847411874032826, 0.8799115635294399,
    -0.08310713885594002, 0.0950919874868904, -0.8894195915987313, -1.0726709402759684, 0.0, 0.0,
    -0.5024217594621092, -0.639962771836709, 1.114246830002057, 1.1694140362383625,
    -0.6808755775097302, -0.43743584354580783, 0.0, 0.0, 1.0369922599121937, -0.9652247573169587,
    0.9850642685994211, -0.9625112143649841, 0.9742796699749515, -1.0714530958934614, 1.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.4598859704282458,
    1.2789486639634724, -0.5751617670313773, 0.21997261265893367, 0.5965047069248834,
    -0.4343266950108438, 0.0, 0.0, 0.6607913874366335, -0.7703337443361776, -0.49393739441821755,
    0.5209734051960031, 0.5248800412206392, -0.790743564666189, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 1.3118299260285424, -0.465576223921698, -0.4379391504278425, 0.5868745981869917,
    0.2681816861828509, -0.6146882876386979, 0.0, 0.0, 0.8127358355075197, -0.6950562610489451,
    0.806244727757524, -0.4770877116109489, -0.589755267747484, 0.516106654385802, 0.0, 0.0, 0.0,
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.598369176748621, -0.45842044258584114, -0.4403091709921039,
    1.3472760864394493, -0.6222170004335543, 0.2547616261266519, 0.0, 0.0, 0.5062189877085521,
    -0.8405694172358851, 0.6856798687767166, -0.774641717668659, -0.5468705138995252,
    0.5852186055701525, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.22934347816797993,
    -0.6038055252722625, 1.330910162662156, -0.44072623994142635, -0.45124518084120613,
    0.6022779563842712, 0.0, 0.0, -0.5460526660082694, 0.5379519217707139, 0.7494453461930936,
    -0.6641940943049253, 0.8267726407389607, -0.5334484396662204, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.0, 0.0, 0.0, -0.57554788512982, 0.2556910990770337, 0.5831441784256993, -0.4126038211684903,
    -0.49557011160081094, 1.2489149326011784, 0.0, 0.0, -0.4615307381451987, 0.559694758711867,
    0.4741809464416021, -0.7600127631716087, 0.6849529568891508, -0.8420409738107547, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -0.40547740070642985, 0.5829464653098345, 0.2359167687174184,
    -0.5608812391215175, 1.2371528436408097, -0.49645961346268874, 0.0, 0.0, 0.748608039010804,
    -0.4905800172306742, -0.5317577133067783, 0.4543161071955988, 0.8148780988609535,
    -0.6630402610843648, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, -0.5038335930956308,
    0.667226424727718, -0.1205749371637214, -0.1189035787318825, 0.6433275500279272,
    -0.5659278728796109, 0.0, 1.0, 0.44340683029626826, -0.22921172888435623, -0.6991755082994446,
    0.6771510516845216, 0.24801576117037252, -0.4589424550503152, 0.0, 0.0, 0.2155556584484081,
    0.1789518525813965, 0.18842532868095632, 0.1949162719041088, 0.20566994849114958,
    0.16790042353372664, 0.0, 0.0, 1.0447042952205379, 0.8561637881666825, -0.04479487811321803,
    0.1990907282863673, -1.0009226239230504, -1.0323354856971378, 0.0, 0.0, -0.6394126586321683,
    -0.6397553053104817, 1.1180310838561858, 1.1485215048250506, -0.6959381407225977,
    -0.2882239667196971, 0.0, 0.0, 0.9503664968658312, -1.0172019567454085, 1.0236480660983858,
    -0.9766416314069766, 0.9841103266292258, -1.0380185462304294, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.3829573619513342, 1.3106777131217302,
    -0.6045473452519611, 0.22938077982118285, 0.622679766591991, -0.5113453055743887, 0.0, 0.0,
    0.7479204590421105, -0.8004084490141729, -0.5208596513875933, 0.5302650751841838,
    0.5315657991215536, -0.8660658017318429, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    1.3436533342819548, -0.4353325584942183, -0.42495487710063057, 0.5646294219963577,
    0.2571482934026128, -0.6460793397067154, 0.0, 0.0, 0.7184708716551631, -0.6773361438501362,
    0.7981232465935749, -0.4735257668625543, -0.5633316491887227, 0.556831893287518, 0.0, 0.0, 0.0,
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5930970200618487, -0.4600916592186616,
    -0.44512752555524043, 1.2748416739187898, -0.5659967531381518, 0.24198655809184377, 0.0, 0.0,
    0.4841974969783854, -0.8314238186997862, 0.7022519046956252, -0.8197599750497726,
    -0.4727312277757181, 0.5728889338603489, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.24393886286535604, -0.6147976388505777, 1.3027909123023749, -0.4918320326765916,
    -0.40412815924137924, 0.5908700653459548, 0.0, 0.0, -0.5386729636268133, 0.5243242482142169,
    0.7754583551962733, -0.6439142686033131, 0.7540439362133419, -0.5148093194973656, 0.0, 0.0, 0.0,
    0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -0.5440397429406787, 0.22902411831566552, 0.6200368542836083,
    -0.44118700765073465, -0.4974181243098147, 1.2454091518838917, 0.0, 0.0, -0.4517312483858711,
    0.5427596222983155, 0.5313721314457871, -0.7879064883551045, 0.6728998121274707,
    -0.8622359180337987, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -0.3655747190947734,
    0.5618310351065923, 0.25958791337900944, -0.5800499594669507, 1.2746013651930828,
    -0.5405255105259842, 0.0, 0.0, 0.7353275859979999, -0.4700556681400796, -0.5817511029295441,
    0.4825161784029279, 0.7909301510554109, -0.6179476438492054, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    1.0
};
static double at_platform_inverse_dynamics[] = {
    112.28925384164835, -1789.825525955963, -1423.9023323253184, -87.49919439742955,
    -432.25276807141023, -51.723293166351915, -173.38609597319734, 1791.393136050584,
    -1236.911337051722, -1283.5925219794387, 672.1092893273147, -139.84634013000667,
    -9.234860761342455, -1.113486149816079, 1251.8990283154499, 1353.2740010982227
};
static double at_platform_close[] = {
    -0.00469970703125, 0.0018310546875, 0.70111083984375, -0.03790283203125, -0.05572509765625,
    -0.004150390625, 0.017578125, -0.0106201171875, 2.678789302380171, 0.29665998611647265,
    0.8221971438853369, 2.7181408077978797, -0.2677518835609361, 0.7909608702098, 2.716010505623566,
    0.30271339634036865, 0.7816836021775835, 2.6946944545773506, -0.31870327333507253,
    0.7988996076794729, 2.705696713255243, 0.24465902026178293, 0.81885414711014,
    2.6829178211215647, -0.2627550912998803, 0.8358863065169471, -0.00811767578125, 0.0023193359375,
    0.70111083984375, -0.05340576171875, 0.00482177734375, -0.0594482421875, -0.00811767578125,
    0.01751708984375, 2.7032792541479744, 0.2496589642389118, 0.7822908641573604, 2.656134151389047,
    -0.29547703780408074, 0.8075527651828148, 2.699403062812976, 0.2755066454473032,
    0.8030283160956827, 2.6988716272674926, -0.2876951125161307, 0.8135819246948996,
    2.739990297544533, 0.26721380147543733, 0.8093700074771363, 2.69417038545587,
    -0.311225750647831, 0.8332119729992651
};
static double at_platform_close_from[] = {
    -0.00469970703125, 0.0018310546875, 0.70111083984375, -0.03790283203125, -0.05572509765625,
    -0.004150390625, 0.017578125, -0.0106201171875, 2.678789302380171, 0.29665998611647265,
    0.8221971438853369, 2.7181408077978797, -0.2677518835609361, 0.7909608702098, 2.716010505623566,
    0.30271339634036865, 0.7816836021775835, 2.6946944545773506, -0.31870327333507253,
    0.7988996076794729, 2.705696713255243, 0.24465902026178293, 0.81885414711014,
    2.6829178211215647, -0.2627550912998803, 0.8358863065169471, -0.00811767578125, 0.0023193359375,
    0.70111083984375, -0.05340576171875, 0.00482177734375, -0.0594482421875, -0.00811767578125,
    0.01751708984375, 2.7032792541479744, 0.2496589642389118, 0.7822908641573604, 2.656134151389047,
    -0.29547703780408074, 0.8075527651828148, 2.699403062812976, 0.2755066454473032,
    0.8030283160956827, 2.6988716272674926, -0.2876951125161307, 0.8135819246948996,
    2.739990297544533, 0.26721380147543733, 0.8093700074771363, 2.69417038545587,
    -0.311225750647831, 0.8332119729992651
};
static double at_platform_coupling[] = {
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.1207370348162902, 0.19757812996712731, 0.56780933097569,
    0.1513879045166235, -0.11565542933713348, -0.267765807652691, -1.1207370348162902,
    -0.19757812996712731, -0.045611673743796474, 1.1730203833365243, -0.31814285520442925,
    -0.08797767049558217, 0.06115369082121537, 0.2839654944178274, 0.045611673743796474,
    -1.1730203833365243, -0.4712249216416784, 0.2137619601325081, 0.8557177675052108,
    0.22835578891693334, -0.20078106282214422, 0.15382545796641178, 0.4712249216416784,
    -0.2137619601325081, -0.4088269220122171, 1.1231105630880396, 0.5387021706959826,
    0.18332182841684655, -0.07298071184255008, 0.2568397429936995, 0.4088269220122171,
    -1.1231105630880396, -1.0986783185495435, -0.5461990116727811, 0.304941418913434,
    0.09702937861255094, -0.04174587454644031, 0.28755308878808294, 1.0986783185495435,
    0.5461990116727811, 0.38415135148871005, -0.2818696765771414, 0.8791912332227245,
    0.2871260372736063, -0.10232992521024337, -0.17996730961857027, -0.38415135148871005,
    0.2818696765771414, -0.7846107066267098, 0.9351158538845173, 0.5533148509052637,
    0.05411507940857689, 0.21738324778366414, -0.26794533516977265, 0.7846107066267098,
    -0.9351158538845173, -1.0366589001829731, -0.6642798879564039, -0.3473519954223552,
    -0.035634419470926694, -0.10813679364745654, 0.2897624560796643, 1.0366589001829731,
    0.6642798879564039, 0.024928867825383456, -0.4935051376105518, 0.8693855477870188,
    0.042775507750784106, 0.29185359790606946, 0.17671035755209988, -0.024928867825383456,
    0.4935051376105518, -0.7640105821170963, -0.9105913550801242, 0.5696429068363698,
    -0.04962509796573299, 0.19883711233937237, 0.2778170898107686, 0.7640105821170963,
    0.9105913550801242, 1.0195682280165523, -0.6341851706371856, 0.35369067019851824,
    -0.031978275258736116, 0.09385900407441838, 0.28471042915752504, -1.0195682280165523,
    0.6341851706371856, 0.02375393377637207, 0.5157994554896809, 0.8563799812855836,
    -0.042659529860853765, 0.30099891033593257, -0.16229507295333792, -0.02375393377637207,
    -0.5157994554896809, -0.3902712424954405, -1.0721842628907037, 0.5314529822412902,
    -0.15434687746927458, -0.06052926893785744, -0.24854281223645255, 0.3902712424954405,
    1.0721842628907037, 1.0706658681129733, -0.5226331818448795, -0.2681497309351138,
    0.09815897789245803, 0.0410632237051967, 0.28622094652831986, -1.0706658681129733,
    0.5226331818448795, 0.36773270085786197, 0.30208956636528694, 0.8794967621390173,
    -0.29502229148845543, -0.10278604518631741, 0.16905311459049013, -0.36773270085786197,
    -0.30208956636528694, 1.0939403964315326, -0.19283749677273557, 0.5485157582202442,
    -0.14284529885696867, -0.10723715821268696, 0.25418414154357954, -1.0939403964315326,
    0.19283749677273557, 0.06506349093624109, 1.1616172424159015, 0.27862058268552936,
    -0.10109349944978974, -0.07125634995588545, 0.2797941052280669, -0.06506349093624109,
    -1.1616172424159015, -0.4661633270657809, -0.18157250704143907, 0.8658655653077147,
    -0.2282727176394461, -0.19766304301015925, -0.16032627662281626, 0.4661633270657809,
    0.18157250704143907, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.1763508754291307, 0.20738246255115408,
    0.5598839363042215, 0.1451869346272489, -0.138484360568072, -0.2558081531733201,
    -1.1763508754291307, -0.20738246255115408, -0.08304377816909424, 1.2431266159368168,
    -0.2859771951747922, -0.054284589976593, 0.05281565610419762, 0.3230632996428948,
    0.08304377816909424, -1.2431266159368168, -0.4479050425791578, 0.17192102384326582,
    0.8773962812736592, 0.22526803558573838, -0.2123971798675127, 0.145003122326786,
    0.4479050425791578, -0.17192102384326582, -0.3916025476456724, 1.0757925520861344,
    0.6039871028328511, 0.21286467463520573, -0.09158347980812152, 0.27169065456974056,
    0.3916025476456724, -1.0757925520861344, -1.0556336444269705, -0.5633220314026962,
    0.3189286995823041, 0.0922452559582649, -0.03939314293307995, 0.2589238092203607,
    1.0556336444269705, 0.5633220314026962, 0.42632227201561507, -0.31986058072829576,
    0.8461315082654712, 0.265657131008933, -0.11539378463714585, -0.1863410427941475,
    -0.42632227201561507, 0.31986058072829576, -0.7517920474612989, 0.8960018726074187,
    0.5537660839295074, 0.04732575945568539, 0.2033173659777169, -0.23332849538026137,
    0.7517920474612989, -0.8960018726074187, -1.011167335055604, -0.6591913958437834,
    -0.306177718327533, -0.026607325369635573, -0.1177334342378877, 0.30045405618528104,
    1.011167335055604, 0.6591913958437834, 0.05628381971572962, -0.4903049687778811,
    0.8697316650725834, 0.06922110597533065, 0.28687015686503337, 0.17826394182143143,
    -0.05628381971572962, 0.4903049687778811, -0.7444605287078044, -0.8872904872092557,
    0.5491290228907852, -0.018595886985130282, 0.17293431652842062, 0.28823952888026844,
    0.7444605287078044, 0.8872904872092557, 0.9989368470055857, -0.64310399584694,
    0.3151335810940232, -0.010160399473394182, 0.09914904456962459, 0.2692124722397433,
    -0.9989368470055857, 0.64310399584694, 0.0466716017498087, 0.4970738211431437,
    0.8664521786713109, -0.03658683021250433, 0.31012373755651096, -0.1547955410475545,
    -0.0466716017498087, -0.4970738211431437, -0.4032912600098457, -1.1079538927313388,
    0.5007312490150289, -0.1484238591434149, -0.04387937205286569, -0.24925959325002955,
    0.4032912600098457, 1.1079538927313388, 1.076185457695969, -0.5274363366537741,
    -0.3002787491709215, 0.10977311249080023, 0.032271617535012176, 0.31044913038183825,
    -1.076185457695969, 0.5274363366537741, 0.37707616494924673, 0.2639663868034534,
    0.887769853320723, -0.3019724511943239, -0.09021332889003347, 0.14663413833780667,
    -0.37707616494924673, -0.2639663868034534, 1.119382713074237, -0.19732241447893115,
    0.5454512584572071, -0.15032780297362666, -0.11256939590895694, 0.2666472984879765,
    -1.119382713074237, 0.19732241447893115, 0.04174993956997301, 1.1527729393952955,
    0.33134725847389673, -0.1091320323486575, -0.08191463834987558, 0.24768493822709925,
    -0.04174993956997301, -1.1527729393952955, -0.45876587914935246, -0.2300768677137321,
    0.8582531695667425, -0.23766217625202607, -0.17578700587670792, -0.18755636438092085,
    0.45876587914935246, 0.2300768677137321
};

static double out[STATES * 1680], worst;
static double product[STATES * N];
static int status[STATES];

/* Whether a part of the library belongs to the header. */
static int belongs(const char *part, const char *signature, const char *header)
{
    if (strcmp(signature, header) == 0) {
        return 1;
    }
    printf("evra: the %s is %s,\nthe header %s\n", part, signature, header);
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
    enum { STEPS = 40, U = 26 };
    static double values[STATES][180], f[18], at[N];
    static struct evra_posture sparse, dense;
    static struct evra_state state, other;
    static const double none[18] = {0};
    const double *const home = evra_home;
    static double phi[N * C], rows[U * C], torques[N];

    for (int i = 0; i < STATES; i++) {
        {
            const modeler_closure *const own = &evra_loops;
            modeler_closure loops = *own;

            loops.limits = none;
            expect("a stored state",
                   evra_posed(own, q + i * N, home, &sparse) ==
                       MODELER_CLOSED);
            expect("a state with rows exchanged",
                   evra_posed(&loops, q + i * N, home, &dense) ==
                       MODELER_CLOSED);
            evra_moved(&loops, qd + i * N, &sparse);
            evra_moved(&loops, qd + i * N, &dense);
            compare("postures, rows exchanged", dense.u, sparse.u, 1, U, TOLERANCE);
            compare("coupling, rows exchanged", dense.G, sparse.G, 1, U * 8, TOLERANCE);
            compare("drift, rows exchanged", dense.gamma, sparse.gamma, 1, U, TOLERANCE);
            other.at = dense;
        }
        {
            const modeler_closure *const own = &evra_platform_loops;
            modeler_closure loops = *own;

            loops.limits = none;
            expect("a stored state",
                   evra_posed(own, x + i * N, home, &sparse) ==
                       MODELER_CLOSED);
            expect("a state with rows exchanged",
                   evra_posed(&loops, x + i * N, home, &dense) ==
                       MODELER_CLOSED);
            evra_moved(&loops, qd + i * N, &sparse);
            evra_moved(&loops, qd + i * N, &dense);
            compare("postures, rows exchanged", dense.u, sparse.u, 1, U, TOLERANCE);
            compare("coupling, rows exchanged", dense.G, sparse.G, 1, U * 8, TOLERANCE);
            compare("drift, rows exchanged", dense.gamma, sparse.gamma, 1, U, TOLERANCE);
        }
        expect("a stored state",
               evra_state(q + i * N, qd + i * N, NULL, &state) ==
                   MODELER_CLOSED);
        expect("a state that is kept",
               evra_state(q + i * N, qd + i * N, other.at.u, &other) ==
                   MODELER_CLOSED);
        expect("rows exchanged", other.at.kept.dense[other.at.kept.at] != 0);
        expect("rates",
               evra_coupling_rate_at(&state, NULL) == MODELER_CLOSED);
        expect("rates, rows exchanged",
               evra_coupling_rate_at(&other, NULL) == MODELER_CLOSED);
        compare("rate, rows exchanged", other.rate, state.rate, 1, U * 8, TOLERANCE);
        dense = other.at;
        for (int k = 0; k < U * C; k++) {
            rows[k] = NAN;
        }
        for (int k = 0; k < N * C; k++) {
            phi[k] = NAN;
        }
        expect("rows of a regressor",
               evra_tree_next(q + i * N, qd + i * N, qdd + i * N, 1,
                   &dense, rows, phi) == MODELER_CLOSED);
        for (int j = 0; j < N; j++) {
            torques[j] = 0;
            for (int k = 0; k < C; k++) {
                torques[j] += phi[j * C + k] * beta[k];
            }
        }
        compare("regressor, rows exchanged", torques, at_inverse_dynamics + i * N, 1, N, TOLERANCE);
        evra_tree_closure(state.at.u, values[i]);
        evra_tree_residual(state.at.u, f);
        for (int k = 0; k < 18; k++) {
            expect("residuals", modeler_fabs(f[k] - values[i][k]) <= 1e-14);
        }
    }
    for (int i = 0; i <= STEPS; i++) { /* back to the first state */
        for (int j = 0; j < N; j++) {
            at[j] = i < STEPS ? q[N + j] + (double)i / (double)STEPS * (q[j] - q[N + j]) : q[j];
        }
        expect("a path",
               evra_state_with_bound(at, qd + 0, state.at.u, 50,
                   &state) == MODELER_CLOSED);
    }
    expect("its end",
           evra_state(q, qd + 0, NULL, &other) == MODELER_CLOSED);
    compare("a path", state.at.u, other.at.u, 1, U, TOLERANCE);
    compare("a path's coupling", state.at.G, other.at.G, 1, U * 8, TOLERANCE);
    at[0] = NAN;
    expect("a cycle that fails",
           evra_state(at, qd + 0, state.at.u, &state) ==
               MODELER_NOT_FINITE);
    compare("the last posture", state.at.u, other.at.u, 1, U, TOLERANCE);
    check_elimination(values[0] + 18, values[1] + 18);
    check_platform_elimination(values[0] + 18, values[1] + 18);
}

/* Many samples side by side against the same one after another, wherever the results begin; memory
 * around them must stay as it is. */
enum { MANY = 37, GUARD = 24, SPARE = 64, SIGNALS = 0 };
enum { LONG = N * C };
static double Q[MANY * N], QD[MANY * N], QDD[MANY * N], one[MANY * N * C];
static double results[3 * GUARD + (MANY * N + 3) * C];
static int told[MANY], closed[MANY], singles;

static int counted_next(const double *at, const double *speed, const double *acceleration, int next,
                        struct evra_posture *p, double *rows, double *phi)
{
    singles++;
    return evra_tree_next(at, speed, acceleration, next, p, rows, phi);
}

/* W by rows, W by columns, of so many samples, from a place on. */
static void compare_tile(int kind, int samples, int phase, unsigned char *work,
                         const modeler_closure *loops)
{
    const struct evra_single counted = {
        loops, evra_posed, counted_next, modeler_eliminated
    };
    modeler_tiled own = *evra_tiled();
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
    const size_t room = modeler_tile_work(evra_tiled());
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
        evra_observation(MANY, Q, QD, QDD, one, told);
        for (int k = 0; k < 2 * 5 * 8; k++) {
            compare_tile(k / 40, counts[k / 8 % 5], k % 8, work,
                         &evra_loops);
            expect("samples side by side", way > 0 || singles < 3);
        }
    }
    for (int j = 0; j <= 18; j++) { /* in doubt, they are closed one after another */
        double limits[18];
        modeler_closure strict = evra_loops;

        memcpy(limits, strict.limits, sizeof(limits));
        strict.limits = limits;
        if (j < 18) {
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
    if (!belongs("library", evra_signature(),
            EVRA_SIGNATURE)) {
        return 1;
    }
    if (!belongs("unit of tiles", evra_tile_signature(),
            EVRA_SIGNATURE)) {
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

        modeler_batch_1(evra_base_parameters, 1, inputs,
            out, 90);
    }
    if (REPLACED != 0) {
        memcpy(beta, out, sizeof(beta));
    }
    compare("evra_base_parameters", out,
            beta, 1, 90, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, {beta, 0}, };

        modeler_batch_status_4(evra_inverse_dynamics, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inverse_dynamics, out, sizeof(at_inverse_dynamics));
    }
    compare("evra_inverse_dynamics", out,
            at_inverse_dynamics, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {beta, 0}, };

        modeler_batch_status_2(evra_gravity, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_gravity, out, sizeof(at_gravity));
    }
    compare("evra_gravity", out,
            at_gravity, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {beta, 0}, };

        modeler_batch_status_3(evra_coriolis, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coriolis, out, sizeof(at_coriolis));
    }
    compare("evra_coriolis", out,
            at_coriolis, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {beta, 0}, };

        modeler_batch_status_3(evra_friction, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_friction, out, sizeof(at_friction));
    }
    compare("evra_friction", out,
            at_friction, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {beta, 0}, };

        modeler_batch_status_2(evra_inertia_matrix, 2, inputs,
            out, 64, status);
    }
    if (REPLACED != 0) {
        memcpy(at_inertia_matrix, out, sizeof(at_inertia_matrix));
    }
    compare("evra_inertia_matrix", out,
            at_inertia_matrix, 2, 64, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, };

        modeler_batch_status_1(evra_forward_kinematics, 2, inputs,
            out, 312, status);
    }
    if (REPLACED != 0) {
        memcpy(at_forward_kinematics, out, sizeof(at_forward_kinematics));
    }
    compare("evra_forward_kinematics", out,
            at_forward_kinematics, 2, 312, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, };

        modeler_batch_status_1(evra_close, 2, inputs,
            out, 26, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close, out, sizeof(at_close));
    }
    compare("evra_close", out,
            at_close, 2, 26, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {start, 26}, };

        modeler_batch_status_2(evra_close_from, 2, inputs,
            out, 26, status);
    }
    if (REPLACED != 0) {
        memcpy(at_close_from, out, sizeof(at_close_from));
    }
    compare("evra_close_from", out,
            at_close_from, 2, 26, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, };

        modeler_batch_status_1(evra_coupling, 2, inputs,
            out, 208, status);
    }
    if (REPLACED != 0) {
        memcpy(at_coupling, out, sizeof(at_coupling));
    }
    compare("evra_coupling", out,
            at_coupling, 2, 208, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 8}, {xd, 8}, {xdd, 8}, {beta, 0}, };

        modeler_batch_status_4(evra_platform_inverse_dynamics, 2, inputs,
            out, 8, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_inverse_dynamics, out, sizeof(at_platform_inverse_dynamics));
    }
    compare("evra_platform_inverse_dynamics", out,
            at_platform_inverse_dynamics, 2, 8, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 8}, };

        modeler_batch_status_1(evra_platform_close, 2, inputs,
            out, 26, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close, out, sizeof(at_platform_close));
    }
    compare("evra_platform_close", out,
            at_platform_close, 2, 26, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 8}, {start, 26}, };

        modeler_batch_status_2(evra_platform_close_from, 2, inputs,
            out, 26, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_close_from, out, sizeof(at_platform_close_from));
    }
    compare("evra_platform_close_from", out,
            at_platform_close_from, 2, 26, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 8}, };

        modeler_batch_status_1(evra_platform_coupling, 2, inputs,
            out, 208, status);
    }
    if (REPLACED != 0) {
        memcpy(at_platform_coupling, out, sizeof(at_platform_coupling));
    }
    compare("evra_platform_coupling", out,
            at_platform_coupling, 2, 208, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, };

        modeler_batch_status_3(evra_regressor, 2, inputs,
            out, 1680, status);
    }
    multiply(out, 210, chi);
    compare("evra_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {q, 8}, {qd, 8}, {qdd, 8}, };

        modeler_batch_status_3(evra_base_regressor, 2, inputs,
            out, 720, status);
    }
    multiply(out, 90, beta);
    compare("evra_base_regressor", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    {
        const modeler_input inputs[] = { {x, 8}, {xd, 8}, {xdd, 8}, };

        modeler_batch_status_3(evra_platform_base_regressor, 2, inputs,
            out, 720, status);
    }
    multiply(out, 90, beta);
    compare("evra_platform_base_regressor", product,
            at_platform_inverse_dynamics, STATES, N, TOLERANCE);
    empty();
    evra_observation(STATES, q, qd, qdd, out, status);
    multiply(out, C, beta);
    compare("evra_observation", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    add_up(at_inertia_matrix, at_coriolis, at_gravity,
           at_friction);
    compare("evra_inertia_matrix and others", product,
            at_inverse_dynamics, STATES, N, TOLERANCE);
    printf("evra %s:\n", EVRA_SIGNATURE);
    if (failed != 0) {
        printf("functions do not agree with the stored states; other compiler flags?\n");
        return 1;
    }
    printf("18 functions agree with the stored states to %.1e\n",
           worst);
    return 0;
}
