/* Loops over many samples on the tiles of a robot; see modeler_tile.h.
 *
 * The values of a tile are turned into rows, a few at a time, so that all stays in the first cache.
 * From there whole lines go to memory past the caches: plain stores would read each line before
 * they write it, which takes longer than all the computing.
 * This file includes itself once for every instruction set.
 */
#ifndef MODELER_VERSION

#include "modeler_tile.h"

#include <stdint.h>
#include <string.h>

#define LINE 8 /* doubles in a line of the cache */
#define FEW 4  /* rows that are turned at once, and neighbours in a row */

/* What becomes of a tile's values. */
typedef struct {
    size_t width;         /* of a row */
    size_t entries;       /* how many values there are of each sample */
    size_t blocks;        /* of FEW neighbours, some of which are not always 0; 0: rows are short */
    int *place;           /* of each entry, in a row */
    int *first;           /* place of each block's first */
    int *source;          /* entries of each block; the one after the last is always 0 */
    double *values;       /* of a tile */
    double *rows;         /* FEW rows; places that are always 0 stay so */
} plan;

/* Where rows go: `held` doubles stand before plan.rows, those of a line that is not yet whole. */
typedef struct {
    double *line;   /* the next to be written, aligned */
    size_t held;
    size_t foreign; /* of these, how many are not ours */
} place_ahead;

/* The values of FEW samples as rows, one double after another. */
static void scatter(const plan *p, const double *values)
{
    for (size_t k = 0; k < p->entries; k++) {
        for (size_t i = 0; i < FEW; i++) {
            p->rows[i * p->width + (size_t)p->place[k]] = values[k * MODELER_LANES + i];
        }
    }
}

#define MODELER_BODY "modeler_tile.c"
#include "modeler_versions.h"

typedef void (*turn_function)(const plan *p, const double *values);
typedef void (*stream_function)(const double *from, double *to, size_t lines);

#define TURN(version) turn_##version
#define STREAM(version) stream_##version

static const turn_function turns[] = {MODELER_EACH_VERSION(TURN)};
static const stream_function streams[] = {MODELER_EACH_VERSION(STREAM)};

static size_t whole_lines(size_t doubles)
{
    return (doubles + LINE - 1) / LINE * LINE;
}

static size_t widest(const modeler_tiled *robot)
{
    const size_t dense = (size_t)robot->joints * (size_t)robot->columns;

    return dense > (size_t)robot->nonzeros ? dense : (size_t)robot->nonzeros;
}

static size_t values_length(const modeler_tiled *robot)
{
    return ((size_t)robot->nonzeros + 1) * MODELER_LANES;
}

static size_t inputs_length(const modeler_tiled *robot)
{
    return MODELER_LANES * (size_t)(3 * robot->joints + robot->signals);
}

size_t modeler_tile_work(const modeler_tiled *robot)
{
    const size_t doubles = values_length(robot) + whole_lines(FEW * widest(robot) + 3 * LINE)
        + inputs_length(robot);

    return (doubles + LINE) * sizeof(double) + (2 + FEW) * (size_t)robot->nonzeros * sizeof(int);
}

/* Blocks that hold every entry. */
static void cover(plan *p)
{
    const int entries = (int)p->entries, width = (int)p->width;

    p->blocks = 0;
    for (int k = 0; k < entries && width >= FEW; k++) {
        int *source = p->source + p->blocks * FEW;
        if (p->blocks == 0 || p->place[k] >= p->first[p->blocks - 1] + FEW) {
            const int first = p->place[k] + FEW <= width ? p->place[k] : width - FEW;
            for (int i = 0; i < FEW; i++) {
                source[i] = entries;
            }
            for (int i = k - 1; i >= 0 && p->place[i] >= first; i--) {
                source[p->place[i] - first] = i;
            }
            p->first[p->blocks++] = first;
        } else {
            source -= FEW;
        }
        source[p->place[k] - p->first[p->blocks - 1]] = k;
    }
}

/* The parts of `work`; `dense`: rows hold what is always 0 too. */
static plan planned(const modeler_tiled *robot, const double *out, double *work, int dense)
{
    const size_t phase = (uintptr_t)out / sizeof(double) % LINE;
    plan p;

    p.entries = (size_t)robot->nonzeros;
    p.width = dense ? (size_t)robot->joints * (size_t)robot->columns : p.entries;
    p.values = work;
    memset(p.values + p.entries * MODELER_LANES, 0, MODELER_LANES * sizeof(double));
    work += values_length(robot) + inputs_length(robot);
    memset(work, 0, (FEW * p.width + 3 * LINE) * sizeof(double));
    p.rows = work + LINE + phase;
    work += whole_lines(FEW * widest(robot) + 3 * LINE);
    p.place = (int *)(void *)work;
    p.first = p.place + p.entries;
    p.source = p.first + p.entries;
    for (size_t k = 0; k < p.entries; k++) {
        p.place[k] = dense ? robot->row[k] * robot->columns + robot->column[k] : (int)k;
    }
    cover(&p);
    return p;
}

/* Writes the whole lines that the first rows of the buffer complete, and keeps the rest. */
static void push(const plan *p, place_ahead *ahead, size_t rows, stream_function stream)
{
    const double *from = p->rows - ahead->held;
    const size_t all = ahead->held + rows * p->width, lines = all / LINE;

    if (lines > 0) {
        const size_t cut = ahead->foreign > 0;
        if (cut > 0) {
            memcpy(ahead->line + ahead->foreign, from + ahead->foreign,
                   (LINE - ahead->foreign) * sizeof(double));
        }
        stream(from + cut * LINE, ahead->line + cut * LINE, lines - cut);
        ahead->line += lines * LINE;
        ahead->foreign = 0;
    }
    ahead->held = all - lines * LINE;
    memmove(p->rows - ahead->held, from + lines * LINE, ahead->held * sizeof(double));
}

/* The last samples, and after them the last one again, as a tile's inputs; returns what follows. */
static double *padded(double *to, const double **input, size_t samples, size_t length)
{
    if (*input == NULL) {
        return to;
    }
    for (size_t i = 0; i < MODELER_LANES; i++) {
        memcpy(to + i * length, *input + (i < samples ? i : samples - 1) * length,
               length * sizeof(double));
    }
    *input = to;
    return to + MODELER_LANES * length;
}

static void evaluate(const modeler_tiled *robot, size_t samples, const double *q, const double *qd,
                     const double *qdd, const double *s, double *out, void *room, int dense)
{
    const size_t joints = (size_t)robot->joints, signals = (size_t)robot->signals;
    const size_t past = (uintptr_t)room % (LINE * sizeof(double));
    double *const work = (double *)(void *)((char *)room + (LINE * sizeof(double) - past));
    const int version = MODELER_BEST_VERSION;
    const plan p = planned(robot, out, work, dense);
    const size_t phase = (size_t)(p.rows - work) % LINE;
    place_ahead ahead = {out - phase, phase, phase};

    for (size_t left = samples; left > 0;) {
        const size_t now = left < MODELER_LANES ? left : MODELER_LANES;
        if (now < MODELER_LANES) {
            double *to = work + values_length(robot);
            to = padded(to, &q, now, joints);
            to = padded(to, &qd, now, joints);
            to = padded(to, &qdd, now, joints);
            padded(to, &s, now, signals);
        }
        robot->tile(q, qd, qdd, s, p.values);
        for (size_t lane = 0; lane < now; lane += FEW) {
            turns[version](&p, p.values + lane);
            push(&p, &ahead, now - lane < FEW ? now - lane : FEW, streams[version]);
        }
        left -= now;
        q += now * joints;
        qd += now * joints;
        qdd += now * joints;
        if (s != NULL) {
            s += now * signals;
        }
    }
    memcpy(ahead.line + ahead.foreign, p.rows - ahead.held + ahead.foreign,
           (ahead.held - ahead.foreign) * sizeof(double));
    MODELER_FENCE;
}

void modeler_tile_observation(const modeler_tiled *robot, size_t samples, const double *q,
                              const double *qd, const double *qdd, const double *s, double *W,
                              void *work)
{
    evaluate(robot, samples, q, qd, qdd, s, W, work, 1);
}

void modeler_tile_nonzeros(const modeler_tiled *robot, size_t samples, const double *q,
                           const double *qd, const double *qdd, const double *s, double *values,
                           void *work)
{
    evaluate(robot, samples, q, qd, qdd, s, values, work, 0);
}

#else /* for one instruction set */

#if MODELER_WIDTH >= FEW

typedef double MODELER_VERSION(four) __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long MODELER_VERSION(places) __attribute__((vector_size(32)));

/* A square of FEW entries and FEW samples is turned in the registers. */
#undef SHUFFLE
#define SHUFFLE(...) MODELER_SHUFFLE(MODELER_VERSION(places), __VA_ARGS__)
MODELER_TARGET static void MODELER_VERSION(turn)(const plan *p, const double *values)
{
    typedef MODELER_VERSION(four) four;
    const size_t width = p->width;

    if (p->blocks == 0) {
        scatter(p, values);
    }
    for (size_t b = 0; b < p->blocks; b++) {
        const int *const source = p->source + b * FEW;
        double *const to = p->rows + p->first[b];
        const four a0 = *(const four *)(values + source[0] * MODELER_LANES);
        const four a1 = *(const four *)(values + source[1] * MODELER_LANES);
        const four a2 = *(const four *)(values + source[2] * MODELER_LANES);
        const four a3 = *(const four *)(values + source[3] * MODELER_LANES);
        const four b0 = SHUFFLE(a0, a1, 0, 4, 2, 6), b1 = SHUFFLE(a0, a1, 1, 5, 3, 7);
        const four b2 = SHUFFLE(a2, a3, 0, 4, 2, 6), b3 = SHUFFLE(a2, a3, 1, 5, 3, 7);

        *(four *)to = SHUFFLE(b0, b2, 0, 1, 4, 5);
        *(four *)(to + width) = SHUFFLE(b1, b3, 0, 1, 4, 5);
        *(four *)(to + 2 * width) = SHUFFLE(b0, b2, 2, 3, 6, 7);
        *(four *)(to + 3 * width) = SHUFFLE(b1, b3, 2, 3, 6, 7);
    }
}

#else

static void MODELER_VERSION(turn)(const plan *p, const double *values)
{
    scatter(p, values);
}

#endif

#if MODELER_WIDTH > 1

typedef double MODELER_VERSION(wide)
    __attribute__((vector_size(8 * MODELER_WIDTH), aligned(8), may_alias));
typedef double MODELER_VERSION(straight) __attribute__((vector_size(8 * MODELER_WIDTH), may_alias));

MODELER_TARGET static void MODELER_VERSION(stream)(const double *from, double *to, size_t lines)
{
    for (size_t i = 0; i < lines * LINE; i += MODELER_WIDTH) {
        MODELER_STREAM((MODELER_VERSION(straight) *)(void *)(to + i),
                       *(const MODELER_VERSION(wide) *)(from + i));
    }
}

#else

static void MODELER_VERSION(stream)(const double *from, double *to, size_t lines)
{
    memcpy(to, from, lines * LINE * sizeof(double));
}

#endif

#endif
