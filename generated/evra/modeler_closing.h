/* Closing the loops of MODELER_WIDTH samples together, for the version modeler_versions.h is at.
 *
 * Newton from the posture of the last sample before them, along its tangent and what that has
 * turned by; bounds and tests are those of modeler_closure.c, with sums of squares in the place of
 * largest values, which are stricter: each sample's posture must be like that of the sample before
 * it, so the assembly mode does not change. 0 wherever one of them is in doubt: then samples are
 * closed one after another.
 *
 * The functions closure, residual, factor, solve, turned and spread of the version come first, as
 * modeler_closure.h has them, and the lengths that are written here in capitals.
 */
#ifndef MODELER_CLOSING_H
#define MODELER_CLOSING_H

#define STEP MODELER_REAL(0.3)
#define NEWTON 8
#define POLISHED 2
#define INEXACT MODELER_REAL(1e-3)
#define TURNED MODELER_REAL(0.5)
#define TURNING MODELER_REAL(4.0)
#define NEAR MODELER_REAL(0.05)
#define SQUARE(x) ((x) * (x))

/* The vector before x in time: its first lane is a number, then come those of x. */
#define MODELER_BEFORE(first, x) MODELER_JOIN(MODELER_BEFORE_, MODELER_WIDTH)(first, x)
#define MODELER_BEFORE_1(first, x) ((void)(x), first)
#define MODELER_BEFORE_2(first, x) \
    MODELER_SHUFFLE(modeler_bits, modeler_lanes_spread(first), x, 0, 2)
#define MODELER_BEFORE_4(first, x) \
    MODELER_SHUFFLE(modeler_bits, modeler_lanes_spread(first), x, 0, 4, 5, 6)
#define MODELER_BEFORE_8(first, x) \
    MODELER_SHUFFLE(modeler_bits, modeler_lanes_spread(first), x, 0, 8, 9, 10, 11, 12, 13, 14)
#define MODELER_BEFORE_16(first, x) \
    MODELER_SHUFFLE(modeler_bits, modeler_lanes_spread(first), x, 0, 16, 17, 18, 19, 20, 21, 22, \
                    23, 24, 25, 26, 27, 28, 29, 30)

#define MODELER_LAST(x) (((const modeler_real *)(const void *)&(x))[MODELER_WIDTH - 1])

/* Where the next samples start: the posture of the last one. */
typedef struct {
    modeler_real u[UNKNOWNS], J[JACOBIAN], lu[FACTORS], G[COUPLINGS];
    modeler_real turned[COUPLINGS]; /* what G has changed by, */
    modeler_real last[GIVEN];       /* while the given variables changed by this */
    modeler_real share[UNKNOWNS];   /* 1/scale */
} modeler_anchor;

#endif

/* u along the tangent, bent as before; how far that is, squared. */
MODELER_INLINE modeler_lanes MODELER_VERSION(predicted)(const modeler_closure *loops,
                                                        const modeler_anchor *from,
                                                        const modeler_lanes *q, modeler_lanes *u)
{
    modeler_lanes change[GIVEN], reach = modeler_lanes_spread(0), both = reach;
    modeler_real last = MODELER_REAL(1e-30);

    for (int k = 0; k < UNKNOWNS; k++) {
        u[k] = modeler_lanes_spread(0);
    }
    for (int j = 0; j < GIVEN; j++) {
        const int k = loops->given_places[j];
        const modeler_real own = from->last[j] * from->share[k];

        change[j] = q[j] - from->u[k];
        reach += SQUARE(change[j] * from->share[k]);
        both += change[j] * (from->share[k] * own);
        last += own * own;
    }
    both = MODELER_REAL(0.5) * both / last;
    for (int k = 0; k < COUPLINGS; k++) {
        u[loops->coupling_row[k]] +=
            (from->G[k] + both * from->turned[k]) * change[loops->coupling_column[k]];
    }
    for (int k = 0; k < UNKNOWNS; k++) {
        reach += SQUARE(u[k] * from->share[k]);
        u[k] = u[k] + from->u[k];
    }
    for (int j = 0; j < GIVEN; j++) {
        u[loops->given_places[j]] = q[j];
    }
    return reach;
}

/* Takes a correction; its size, squared. */
MODELER_INLINE modeler_lanes MODELER_VERSION(corrected)(const modeler_closure *loops,
                                                        const modeler_anchor *from,
                                                        const modeler_lanes *step, modeler_lanes *u)
{
    modeler_lanes size = modeler_lanes_spread(0);

    for (int i = 0; i < SOLVED; i++) {
        const int k = loops->solved_places[i];
        size += SQUARE(step[i] * from->share[k]);
        u[k] = u[k] - step[i];
    }
    return size;
}

/* Newton with the factors at the start, as long as these contract well. */
MODELER_TARGET static int MODELER_VERSION(neared)(const modeler_closure *loops,
                                                  const modeler_anchor *from, modeler_lanes reach,
                                                  modeler_lanes *u)
{
    const modeler_real exact = SQUARE(MODELER_REAL(0.1) * MODELER_EXACT);
    modeler_lanes lu[FACTORS], right[SOLVED], step[SOLVED], before = reach;

    if (!MODELER_ALL_LESS(reach, SQUARE(NEAR))) {
        return 1;
    }
    for (int k = 0; k < FACTORS; k++) {
        lu[k] = modeler_lanes_spread(from->lu[k]);
    }
    for (int round = 0; round < NEWTON; round++) {
        MODELER_VERSION(residual)(u, right);
        MODELER_VERSION(solve)(lu, right, step);
        const modeler_lanes size = MODELER_VERSION(corrected)(loops, from, step, u);
        const modeler_lanes left = size - MODELER_REAL(0.25) * before;
        const modeler_lanes next = round == 0 ? size * reach * SQUARE(TURNING) - exact
                                              : size * size - exact * before;
        if (!MODELER_ALL_LESS(left, round == 0 ? SQUARE(INEXACT) : SQUARE(MODELER_CONVERGED))) {
            return 0;
        }
        if (MODELER_ALL_LESS(next, SQUARE(SQUARE(MODELER_EXACT))) ||
            (round > 0 && !MODELER_ALL_LESS(size - SQUARE(NEAR) * before, 0))) {
            return 1;
        }
        before = size;
    }
    return 1;
}

/* Newton; values and factors are those of u then. */
MODELER_TARGET static int MODELER_VERSION(solved)(const modeler_closure *loops,
                                                  const modeler_anchor *from, modeler_lanes reach,
                                                  modeler_lanes *u, modeler_lanes *values,
                                                  modeler_lanes *lu)
{
    modeler_lanes step[SOLVED], before = reach;
    int polished = 0;

    for (int round = 0; round < NEWTON; round++) {
        MODELER_VERSION(closure)(u, values);
        MODELER_VERSION(factor)(values + JACOBIAN_AT, lu);
        for (int j = 0; j < SOLVED; j++) {
            if (!MODELER_ALL_LESS(modeler_lanes_fabs(lu[j]), loops->limits[j])) {
                return 0;
            }
        }
        MODELER_VERSION(solve)(lu, values, step);
        modeler_lanes size = modeler_lanes_spread(0);
        for (int i = 0; i < SOLVED; i++) {
            size += SQUARE(step[i] * from->share[loops->solved_places[i]]);
        }
        if (MODELER_ALL_LESS(size, SOLVED * SQUARE(MODELER_EXACT)) ||
            (MODELER_ALL_LESS(size, SQUARE(MODELER_CONVERGED)) && polished++ >= POLISHED)) {
            return 1;
        }
        const modeler_lanes left = size - MODELER_REAL(0.25) * before;
        if (!MODELER_ALL_LESS(left, round == 0 ? SQUARE(INEXACT) : SQUARE(MODELER_CONVERGED))) {
            return 0;
        }
        MODELER_VERSION(corrected)(loops, from, step, u);
        before = size;
    }
    return 0;
}

/* 1 if each Jacobian is like that of the sample before. */
MODELER_TARGET static int MODELER_VERSION(alike)(const modeler_anchor *from,
                                                 const modeler_lanes *values,
                                                 const modeler_lanes *lu)
{
    const modeler_lanes *const K = values + JACOBIAN_AT;
    modeler_lanes J[JACOBIAN], before[FACTORS], x[SOLVED], sum = modeler_lanes_spread(0);

    for (int k = 0; k < JACOBIAN; k++) {
        J[k] = MODELER_BEFORE(from->J[k], K[k]);
    }
    for (int k = 0; k < FACTORS; k++) {
        before[k] = MODELER_BEFORE(from->lu[k], lu[k]);
    }
    MODELER_VERSION(turned)(J, K, before, x);
    for (int i = 0; i < SOLVED; i++) {
        sum += SQUARE(x[i]);
    }
    if (!MODELER_ALL_LESS(sum, SQUARE(TURNED))) {
        MODELER_VERSION(spread)(J, K, before, &sum);
    }
    return MODELER_ALL_LESS(sum, SQUARE(TURNED));
}

/* 1 if the loops of all are closed as those of the sample before; v, a: finite, or 0 is told. */
MODELER_TARGET static int MODELER_VERSION(together)(const modeler_closure *loops,
                                                    const modeler_anchor *from,
                                                    const modeler_lanes *q, const modeler_lanes *v,
                                                    const modeler_lanes *a, modeler_lanes *u,
                                                    modeler_lanes *values, modeler_lanes *lu)
{
    const modeler_lanes reach = MODELER_VERSION(predicted)(loops, from, q, u);
    modeler_lanes sum = modeler_lanes_spread(0), open = sum;

    for (int j = 0; j < GIVEN; j++) {
        const int k = loops->given_places[j];
        const modeler_lanes own = q[j] - MODELER_BEFORE(from->u[k], q[j]);
        sum += SQUARE(own * from->share[k]) + (v[j] - v[j]) + (a[j] - a[j]);
    }
    if (!MODELER_ALL_LESS(sum, SQUARE(STEP)) || !MODELER_ALL_LESS(reach, 1) ||
        !MODELER_VERSION(neared)(loops, from, reach, u) ||
        !MODELER_VERSION(solved)(loops, from, reach, u, values, lu)) {
        return 0;
    }
    for (int i = 0; i < loops->equations; i++) {
        open += SQUARE(values[i]);
    }
    for (int i = 0; i < loops->alignments; i++) {
        if (!MODELER_ALL_LESS(-values[loops->equations + i], 0)) {
            return 0;
        }
    }
    return MODELER_ALL_LESS(open, SQUARE(loops->tolerance)) &&
           MODELER_VERSION(alike)(from, values, lu);
}
