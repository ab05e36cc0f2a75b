/* Planar five-bar, two actuated joints at the base
 *
 * Functions of five_bar_tile.h.
 * This file includes itself once for every instruction set.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "five_bar_tile.h"

#include <string.h>

#include "five_bar_tree.h"

/* Lengths of five_bar_loops. */
#define GIVEN 2
#define UNKNOWNS 4
#define SOLVED 2
#define FACTORS 4
#define COUPLINGS 4
#define JACOBIAN 8
#define JACOBIAN_AT 3
#define TURNS_AT 11
#define LENGTH 19

/* Geometry; see five_bar.c. */
#ifndef FIVE_BAR_GEO_g
#define FIVE_BAR_GEO_g 9.81
#endif
#ifndef FIVE_BAR_GEO_L0
#define FIVE_BAR_GEO_L0 0.2
#endif
#ifndef FIVE_BAR_GEO_L1
#define FIVE_BAR_GEO_L1 0.3
#endif
#ifndef FIVE_BAR_GEO_L2
#define FIVE_BAR_GEO_L2 0.4
#endif
#ifndef FIVE_BAR_GEO_L3
#define FIVE_BAR_GEO_L3 0.31
#endif
#ifndef FIVE_BAR_GEO_L4
#define FIVE_BAR_GEO_L4 0.42
#endif

static const double five_bar_geo_g = FIVE_BAR_GEO_g;
static const double five_bar_geo_L0 = FIVE_BAR_GEO_L0;
static const double five_bar_geo_L1 = FIVE_BAR_GEO_L1;
static const double five_bar_geo_L2 = FIVE_BAR_GEO_L2;
static const double five_bar_geo_L3 = FIVE_BAR_GEO_L3;
static const double five_bar_geo_L4 = FIVE_BAR_GEO_L4;

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1
};

static const int column[] = {
    0, 1, 2, 3, 4, 5, 9, 10, 3, 4, 5, 6, 7, 8, 9, 10
};

#define ENTRIES 16

#define MODELER_BODY "five_bar_tile.c"
#include "modeler_versions.h"

#ifdef MODELER_APART /* who loads this library has them in another one */
#define SINGLES NULL
#else
static const struct five_bar_single singles = {&five_bar_loops, five_bar_posed, five_bar_tree_next, modeler_eliminated};
#define SINGLES &singles
#endif

#define TILED(version) \
    {2, 11, 0, ENTRIES, row, column, NULL, closing_##version, sizeof(closing_state), SINGLES}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *five_bar_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *five_bar_tile_signature(void)
{
    return "d1c82fb9d880dc4b";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

MODELER_TARGET static void MODELER_VERSION(closure)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT values)
{
    modeler_lanes s0, c0;
    modeler_lanes_sincos(q[0], &s0, &c0);
    modeler_lanes s1, c1;
    modeler_lanes_sincos(q[1], &s1, &c1);
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q[2], &s2, &c2);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q[3], &s3, &c3);
    const modeler_lanes o31d_q1y = five_bar_geo_L2*(c0*c1 - s0*s1);
    /* link 31: origin of the frame in frame 0, o31 = o21 + [x21 y21 z21] p31 */
const modeler_lanes o31_x = five_bar_geo_L1*c0 + o31d_q1y;
    const modeler_lanes o22d_q2y = five_bar_geo_L3*c2;
    const modeler_lanes o32d_q3y = five_bar_geo_L4*(c2*c3 - s2*s3);
    values[0] = o31_x - (five_bar_geo_L0 + o22d_q2y + o32d_q3y);
    const modeler_lanes minus_o31d_q1x = five_bar_geo_L2*(s0*c1 + c0*s1);
    const modeler_lanes o31_y = five_bar_geo_L1*s0 + minus_o31d_q1x;
    const modeler_lanes minus_o32d_q3x = five_bar_geo_L4*(s2*c3 + c2*s3);
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
const modeler_lanes o32_y = five_bar_geo_L3*s2 + minus_o32d_q3x;
    values[1] = o31_y - o32_y;
    values[2] = modeler_lanes_spread(1.0);
    values[3] = -o31_y;
    values[4] = -minus_o31d_q1x;
    values[5] = o32_y;
    values[6] = minus_o32d_q3x;
    values[7] = o31_x;
    values[8] = o31d_q1y;
    values[9] = -(o22d_q2y + o32d_q3y);
    values[10] = -o32d_q3y;
    values[11] = c0;
    values[12] = s0;
    values[13] = c1;
    values[14] = s1;
    values[15] = c2;
    values[16] = s2;
    values[17] = c3;
    values[18] = s3;
}

MODELER_TARGET static void MODELER_VERSION(residual)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT f)
{
    modeler_lanes s0, c0;
    modeler_lanes_sincos(q[0], &s0, &c0);
    modeler_lanes s1, c1;
    modeler_lanes_sincos(q[1], &s1, &c1);
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q[2], &s2, &c2);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q[3], &s3, &c3);
    /* link 32: origin of the frame in frame 0, o32 = o22 + [x22 y22 z22] p32 */
const modeler_lanes o32_x = five_bar_geo_L0 + five_bar_geo_L3*c2 + five_bar_geo_L4*(c2*c3 -
    s2*s3);
    f[0] = five_bar_geo_L1*c0 + five_bar_geo_L2*(c0*c1 - s0*s1) - o32_x;
    /* link 31: origin of the frame in frame 0, o31 = o21 + [x21 y21 z21] p31 */
const modeler_lanes o31_y = five_bar_geo_L1*s0 + five_bar_geo_L2*(s0*c1 + c0*s1);
    f[1] = o31_y - (five_bar_geo_L3*s2 + five_bar_geo_L4*(s2*c3 + c2*s3));
}

MODELER_TARGET static void MODELER_VERSION(factor)(
const modeler_lanes *J, modeler_lanes *MODELER_RESTRICT lu)
{
    const modeler_lanes t1 = 1.0/J[1];
    lu[0] = t1;
    const modeler_lanes t2 = J[5]*t1;
    lu[1] = 1.0/(J[7] - J[3]*t2);
    lu[2] = J[3];
    lu[3] = t2;
}

MODELER_TARGET static void MODELER_VERSION(solve)(
const modeler_lanes *lu, const modeler_lanes *right, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = lu[1]*(right[1] - lu[3]*right[0]);
    x[0] = lu[0]*(right[0] - lu[2]*t1);
    x[1] = t1;
}

MODELER_TARGET static void MODELER_VERSION(coupling)(
const modeler_lanes *J, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT G)
{
    const modeler_lanes t1 = lu[1]*(J[4] - J[0]*lu[3]);
    G[0] = -lu[0]*(J[0] - lu[2]*t1);
    G[1] = -t1;
    const modeler_lanes t2 = lu[1]*(J[6] - J[2]*lu[3]);
    G[2] = -lu[0]*(J[2] - lu[2]*t2);
    G[3] = -t2;
}

MODELER_TARGET static void MODELER_VERSION(turned)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = modeler_lanes_fabs(J[1] - K[1]) + modeler_lanes_fabs(J[3] - K[3]);
    const modeler_lanes t2 = modeler_lanes_fabs(J[5] - K[5]) + modeler_lanes_fabs(J[7] - K[7]);
    const modeler_lanes t3 = (t2 + t1*modeler_lanes_fabs(lu[3]))*modeler_lanes_fabs(lu[1]);
    x[0] = (t1 + t3*modeler_lanes_fabs(lu[2]))*modeler_lanes_fabs(lu[0]);
    x[1] = t3;
}

MODELER_TARGET static void MODELER_VERSION(spread)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = J[1] - K[1];
    const modeler_lanes t2 = lu[1]*(J[5] - K[5] - lu[3]*t1);
    const modeler_lanes t3 = lu[0]*(t1 - lu[2]*t2);
    const modeler_lanes t4 = J[3] - K[3];
    const modeler_lanes t5 = lu[1]*(J[7] - K[7] - lu[3]*t4);
    const modeler_lanes t6 = lu[0]*(t4 - lu[2]*t5);
    x[0] = t3*t3 + t2*t2 + t6*t6 + t5*t5;
}

MODELER_TARGET static void MODELER_VERSION(rows)(
const modeler_lanes *q, const modeler_lanes *t, const modeler_lanes *G, const modeler_lanes *lu, const modeler_lanes *v, const modeler_lanes *a, double *values)
{
    (void)q;
    MODELER_PUT(0) = a[0];
    const modeler_lanes t1 = five_bar_geo_g*t[0];
    MODELER_PUT(1) = t1;
    const modeler_lanes t2 = five_bar_geo_g*t[1];
    MODELER_PUT(2) = -t2;
    const modeler_lanes t3 = five_bar_geo_L2*(t[0]*t[2] - t[1]*t[3]);
    const modeler_lanes t4 = G[0]*v[0] + G[2]*v[1];
    const modeler_lanes t5 = t[0]*v[0];
    const modeler_lanes t6 = t[3]*t4;
    const modeler_lanes t7 = t[1]*v[0];
    const modeler_lanes t8 = t[2]*t4;
    const modeler_lanes t9 = five_bar_geo_L2*(t[2]*t5 - t[1]*t6 + (t[0]*t8 - t[3]*t7))*t4;
    const modeler_lanes t10 = t[4]*v[1];
    const modeler_lanes t11 = G[1]*v[0] + G[3]*v[1];
    const modeler_lanes t12 = t[7]*t11;
    const modeler_lanes t13 = t[5]*v[1];
    const modeler_lanes t14 = t[6]*t11;
    const modeler_lanes t15 = five_bar_geo_L4*(t[6]*t10 - t[5]*t12 + (t[4]*t14 - t[7]*t13));
    const modeler_lanes t16 = v[0]*(v[0]*(five_bar_geo_L1*t[0] + t3) + t4*t3) + t9;
    const modeler_lanes t17 = t16 - v[1]*(five_bar_geo_L3*t10 + t15) - t11*t15;
    const modeler_lanes t18 = five_bar_geo_L2*(t[1]*t[2] + t[0]*t[3]);
    const modeler_lanes t19 = five_bar_geo_L2*(t[2]*t7 + t[0]*t6 + (t[3]*t5 + t[1]*t8))*t4;
    const modeler_lanes t20 = five_bar_geo_L4*(t[6]*t13 + t[4]*t12 + (t[7]*t10 + t[5]*t14));
    const modeler_lanes t21 = v[0]*(v[0]*(five_bar_geo_L1*t[1] + t18) + t4*t18) + t19;
    const modeler_lanes t22 = lu[1]*(t21 - v[1]*(five_bar_geo_L3*t13 + t20) - t11*t20 - lu[3]*t17);
    const modeler_lanes t23 = G[0]*a[0] + G[2]*a[1] + lu[0]*(t17 - lu[2]*t22) + a[0];
    MODELER_PUT(3) = t23 + G[0]*t23;
    MODELER_PUT(8) = G[2]*t23;
    const modeler_lanes t24 = t1 + five_bar_geo_L1*a[0];
    const modeler_lanes t25 = t2 - v[0]*v[0]*five_bar_geo_L1;
    const modeler_lanes t26 = t[2]*t24 - t[3]*t25;
    const modeler_lanes t27 = v[0] + t4;
    const modeler_lanes t28 = t27*t27;
    const modeler_lanes t29 = five_bar_geo_L1*t[3];
    const modeler_lanes t30 = five_bar_geo_L1*t[2];
    MODELER_PUT(4) = t23*t30 - t28*t29 + t26 + G[0]*t26;
    MODELER_PUT(9) = G[2]*t26;
    const modeler_lanes t31 = t[2]*t25 + t[3]*t24;
    MODELER_PUT(5) = -(t23*t29 + t28*t30 + t31 + G[0]*t31);
    MODELER_PUT(10) = -G[2]*t31;
    MODELER_PUT(11) = a[1];
    const modeler_lanes t32 = five_bar_geo_g*t[4];
    MODELER_PUT(12) = t32;
    const modeler_lanes t33 = five_bar_geo_g*t[5];
    MODELER_PUT(13) = -t33;
    const modeler_lanes t34 = G[1]*a[0] + G[3]*a[1] + t22 + a[1];
    MODELER_PUT(6) = G[1]*t34;
    MODELER_PUT(14) = t34 + G[3]*t34;
    const modeler_lanes t35 = t[6]*(t33 - v[1]*v[1]*five_bar_geo_L3) + t[7]*(t32 +
    five_bar_geo_L3*a[1]);
    MODELER_PUT(7) = -G[1]*t35;
    const modeler_lanes t36 = v[1] + t11;
    MODELER_PUT(15) = -(five_bar_geo_L3*t[7]*t34 + t36*t36*(five_bar_geo_L3*t[6]) + t35 + G[3]*t35);
}

#include "modeler_closing.h"

#ifndef ONE_BY_ONE
#define ONE_BY_ONE

typedef struct {
    int anchored; /* tiles can start from `from` */
    int posed;    /* p is the last posture, and `from` is not later */
    modeler_anchor from;
    struct five_bar_posture p;
    double rows[UNKNOWNS * FIVE_BAR_BASE_PARAMETERS], phi[GIVEN * FIVE_BAR_BASE_PARAMETERS];
} closing_state;

/* Samples one after another, from the posture of the last one. */
static void one_by_one(const struct five_bar_single *one, const double *q, const double *qd, const double *qdd,
                       size_t samples, closing_state *state, double *values, int *status)
{
    const modeler_closure *const loops = one->loops;
    modeler_anchor *const from = &state->from;
    const double *f, *lu, *G;
    int next = state->posed;

    if (state->anchored && !next) {
        double at[GIVEN];

        for (int j = 0; j < GIVEN; j++) {
            at[j] = from->u[loops->given_places[j]];
        }
        next = one->posed(loops, at, from->u, &state->p) == MODELER_CLOSED;
    }
    for (size_t i = 0; i < samples; i++) {
        status[i] = one->next(q + i * GIVEN, qd + i * GIVEN, qdd + i * GIVEN, next, &state->p,
                              state->rows, state->phi);
        next = status[i] == MODELER_CLOSED;
        for (size_t k = 0; k < ENTRIES; k++) {
            values[k * MODELER_LANES + i] = state->phi[row[k] * FIVE_BAR_BASE_PARAMETERS + column[k]];
        }
    }
    state->posed = next;
    state->anchored = 0;
    if (next != 0) {
        const modeler_work work = {&state->p.kept, state->p.places, state->p.numbers, 0};

        state->anchored = one->eliminated(loops, &work, &f, &lu, &G);
    }
    if (state->anchored != 0) {
        memset(from, 0, sizeof *from);
        memcpy(from->u, state->p.u, sizeof from->u);
        memcpy(from->J, f + JACOBIAN_AT, sizeof from->J);
        memcpy(from->lu, lu, sizeof from->lu);
        memcpy(from->G, G, sizeof from->G);
        for (int k = 0; k < UNKNOWNS; k++) {
            from->share[k] = 1 / loops->scale[k];
        }
    }
}

#endif

/* MODELER_WIDTH samples together; 0, and nothing done, where that is not safe. */
MODELER_TARGET static int MODELER_VERSION(vector)(const modeler_closure *loops,
                                                  const double *q, const double *qd,
                                                  const double *qdd, modeler_anchor *from,
                                                  double *values)
{
    const modeler_lanes given[] = {
        MODELER_ROWS(q, 2, 0),
        MODELER_ROWS(q, 2, 1),
    };
    const modeler_lanes v[] = {
        MODELER_ROWS(qd, 2, 0),
        MODELER_ROWS(qd, 2, 1),
    };
    const modeler_lanes a[] = {
        MODELER_ROWS(qdd, 2, 0),
        MODELER_ROWS(qdd, 2, 1),
    };
    modeler_lanes u[UNKNOWNS], f[LENGTH], lu[FACTORS], G[COUPLINGS];

    if (!MODELER_VERSION(together)(loops, from, given, v, a, u, f, lu)) {
        return 0;
    }
    MODELER_VERSION(coupling)(f + JACOBIAN_AT, lu, G);
    MODELER_VERSION(rows)(u, f + TURNS_AT, G, lu, v, a, values);
    for (int j = 0; j < GIVEN; j++) {
        from->last[j] = MODELER_LAST(given[j]) - from->u[loops->given_places[j]];
    }
    for (int k = 0; k < UNKNOWNS; k++) {
        from->u[k] = MODELER_LAST(u[k]);
    }
    for (int k = 0; k < JACOBIAN; k++) {
        from->J[k] = MODELER_LAST(f[JACOBIAN_AT + k]);
    }
    for (int k = 0; k < FACTORS; k++) {
        from->lu[k] = MODELER_LAST(lu[k]);
    }
    for (int k = 0; k < COUPLINGS; k++) {
        from->turned[k] = MODELER_LAST(G[k]) - from->G[k];
        from->G[k] = MODELER_LAST(G[k]);
    }
    return 1;
}

static void MODELER_VERSION(closing)(const modeler_tiled *robot, const double *q, const double *qd,
                                     const double *qdd, size_t samples, void *memory,
                                     double *values, int *status)
{
    const struct five_bar_single *const one = (const struct five_bar_single *)robot->singles;
    closing_state *const state = (closing_state *)memory;

    for (size_t i = 0; i < samples; i += MODELER_WIDTH) {
        const size_t now = samples - i < MODELER_WIDTH ? samples - i : MODELER_WIDTH;

        size_t done = 0;

        if (!state->anchored) {
            one_by_one(one, q, qd, qdd, 1, state, values + i, status + i);
            done = 1;
        }
        if (state->anchored && MODELER_VERSION(vector)(one->loops, q, qd, qdd, &state->from, values + i)) {
            state->posed = 0;
            for (size_t k = 0; k < now; k++) {
                status[i + k] = MODELER_CLOSED;
            }
        } else if (done < now) {
            one_by_one(one, q + done * GIVEN, qd + done * GIVEN, qdd + done * GIVEN, now - done, state,
                       values + i + done, status + i + done);
        }
        q += MODELER_WIDTH * GIVEN;
        qd += MODELER_WIDTH * GIVEN;
        qdd += MODELER_WIDTH * GIVEN;
    }
}

#endif
