/* Loops over many samples on the tiles of a robot; see modeler_tile.h.
 *
 * The values of a tile are turned into rows, a few at a time, so that all stays in the first cache.
 * From there whole lines go to memory past the caches: plain stores would read each line before
 * they write it, which takes longer than all the computing.
 * This file includes itself once for every instruction set.
 */
#ifndef MODELER_VERSION

#include "modeler_tile.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#define LINE MODELER_LANES /* numbers in a line of the cache */
#define FEW 4              /* rows that are turned at once, and neighbours in a row */
#define TILES 8

#ifdef MODELER_SINGLE
#define WHOLE int /* a whole number as wide */
#else
#define WHOLE long long
#endif

/* What becomes of a tile's values. */
typedef struct {
    size_t width;         /* of a row */
    size_t entries;       /* how many values of each sample are in it */
    size_t blocks;        /* of FEW neighbours, some of which are not always 0; 0: rows are short */
    int *place;           /* of each entry, in a row */
    int *first;           /* place of each block's first */
    int *source;          /* values of each block, of each entry of short rows */
    modeler_real *values; /* of a tile; after the last one is always 0 */
    modeler_real *rows;   /* FEW rows; places that are always 0 stay so */
} plan;

/* Where rows go: `held` numbers stand before plan.rows, those of a line that is not yet whole. */
typedef struct {
    modeler_real *line; /* the next to be written, aligned */
    size_t held;
    size_t foreign;     /* of these, how many are not ours */
} place_ahead;

/* Samples that are left, and the memory for the last of them. */
typedef struct {
    const modeler_tiled *robot;
    size_t left;
    const modeler_real *q, *qd, *qdd, *s;
    modeler_real *room;
    void *state;
    int *status;
} supply;

/* The values of FEW samples as rows, one number after another. */
static void scatter(const plan *p, const modeler_real *values)
{
    const size_t entries = p->blocks > 0 ? FEW * p->blocks : p->entries;

    for (size_t i = 0; i < FEW; i++) {
        for (size_t k = 0; k < entries; k++) {
            const int to = p->blocks > 0 ? p->first[k / FEW] + (int)(k % FEW) : p->place[k];
            p->rows[i * p->width + (size_t)to] = values[(size_t)p->source[k] * MODELER_LANES + i];
        }
    }
}

#define MODELER_BODY "modeler_tile.c"
#include "modeler_versions.h"

typedef void (*turn_function)(const plan *p, const modeler_real *values);
typedef void (*column_function)(const plan *p, const modeler_real *values, size_t length,
                                size_t samples);
typedef void (*stream_function)(const modeler_real *from, modeler_real *to, size_t lines);

#define TURN(version) turn_##version
#define COLUMN(version) column_##version
#define STREAM(version) stream_##version

static const turn_function turns[] = {MODELER_EACH_VERSION(TURN)};
static const column_function turned[] = {MODELER_EACH_VERSION(COLUMN)};
static const stream_function streams[] = {MODELER_EACH_VERSION(STREAM)};

static size_t whole_lines(size_t numbers)
{
    return (numbers + LINE - 1) / LINE * LINE;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

static size_t values_length(const modeler_tiled *robot)
{
    return ((size_t)robot->nonzeros + 1) * MODELER_LANES;
}

static size_t inputs_length(const modeler_tiled *robot)
{
    return MODELER_LANES * (size_t)(3 * robot->joints + robot->signals);
}

static size_t state_length(const modeler_tiled *robot)
{
    return whole_lines((robot->room + sizeof(modeler_real) - 1) / sizeof(modeler_real));
}

/* Of rows; of columns. */
static size_t rows_length(const modeler_tiled *robot)
{
    const size_t joints = (size_t)robot->joints, dense = joints * (size_t)robot->columns;
    const size_t rows = FEW * larger(dense, (size_t)robot->nonzeros);

    return whole_lines(larger(rows, TILES * MODELER_LANES * joints) + 3 * LINE);
}

static size_t blocks_of(size_t joints)
{
    return (joints + FEW - 1) / FEW;
}

size_t modeler_tile_work(const modeler_tiled *robot)
{
    const size_t numbers = state_length(robot) + inputs_length(robot)
        + TILES * values_length(robot) + rows_length(robot) + LINE * (size_t)robot->columns;
    const size_t joints = (size_t)robot->joints;
    const size_t columns = (FEW * (size_t)robot->columns + 1) * blocks_of(joints);
    const size_t rows = (2 + FEW) * (size_t)robot->nonzeros;

    return (numbers + LINE) * sizeof(modeler_real)
        + larger(rows, columns) * sizeof(int);
}

/* The samples; returns what follows in `work`. */
static modeler_real *supplied(supply *all, const modeler_tiled *robot, int *status, void *room)
{
    const size_t past = (uintptr_t)room % (LINE * sizeof(modeler_real));
    modeler_real *const work = (modeler_real *)(void *)((char *)room
        + (LINE * sizeof(modeler_real) - past));

    all->robot = robot;
    all->state = work;
    all->status = status;
    memset(work, 0, state_length(robot) * sizeof(modeler_real));
    all->room = work + state_length(robot);
    return all->room + inputs_length(robot);
}

/* The last samples, and after them the last one again, as a tile's inputs; returns what follows. */
static modeler_real *padded(modeler_real *to, const modeler_real **input, size_t samples,
                            size_t length)
{
    if (*input == NULL) {
        return to;
    }
    for (size_t i = 0; i < MODELER_LANES; i++) {
        memcpy(to + i * length, *input + (i < samples ? i : samples - 1) * length,
               length * sizeof(modeler_real));
    }
    *input = to;
    return to + MODELER_LANES * length;
}

/* The values of the next tile; returns how many of its samples there are. */
static size_t evaluated(supply *all, modeler_real *values)
{
    const modeler_tiled *const robot = all->robot;
    const size_t joints = (size_t)robot->joints, signals = (size_t)robot->signals;
    const size_t now = all->left < MODELER_LANES ? all->left : MODELER_LANES;

    if (now < MODELER_LANES) {
        modeler_real *to = padded(all->room, &all->q, now, joints);
        to = padded(to, &all->qd, now, joints);
        to = padded(to, &all->qdd, now, joints);
        padded(to, &all->s, now, signals);
    }
    if (robot->tile != NULL) {
        robot->tile(all->q, all->qd, all->qdd, all->s, values);
    } else {
        robot->closing(robot, all->q, all->qd, all->qdd, now, all->state, values, all->status);
        all->status += now;
    }
    all->left -= now;
    all->q += now * joints;
    all->qd += now * joints;
    all->qdd += now * joints;
    if (all->s != NULL) {
        all->s += now * signals;
    }
    return now;
}

/* Blocks that hold every entry. */
static void cover(plan *p)
{
    const int entries = (int)p->entries, width = (int)p->width;

    p->blocks = 0;
    for (int k = 0; k < entries && width < FEW; k++) {
        p->source[k] = k;
    }
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
static plan planned(const modeler_tiled *robot, const modeler_real *out, modeler_real *work,
                    int dense)
{
    const size_t phase = (uintptr_t)out / sizeof(modeler_real) % LINE;
    plan p;

    p.entries = (size_t)robot->nonzeros;
    p.width = dense ? (size_t)robot->joints * (size_t)robot->columns : p.entries;
    p.values = work;
    memset(p.values + p.entries * MODELER_LANES, 0, MODELER_LANES * sizeof(modeler_real));
    work += TILES * values_length(robot);
    memset(work, 0, (FEW * p.width + 3 * LINE) * sizeof(modeler_real));
    p.rows = work + LINE + phase;
    p.place = (int *)(void *)(work + rows_length(robot));
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
    const modeler_real *from = p->rows - ahead->held;
    const size_t all = ahead->held + rows * p->width, lines = all / LINE;

    if (lines > 0) {
        const size_t cut = ahead->foreign > 0;
        if (cut > 0) {
            memcpy(ahead->line + ahead->foreign, from + ahead->foreign,
                   (LINE - ahead->foreign) * sizeof(modeler_real));
        }
        stream(from + cut * LINE, ahead->line + cut * LINE, lines - cut);
        ahead->line += lines * LINE;
        ahead->foreign = 0;
    }
    ahead->held = all - lines * LINE;
    memmove(p->rows - ahead->held, from + lines * LINE, ahead->held * sizeof(modeler_real));
}

static void by_rows(supply *all, modeler_real *out, modeler_real *work, int dense)
{
    const int version = MODELER_BEST_VERSION;
    const plan p = planned(all->robot, out, work, dense);
    const size_t phase = (uintptr_t)out / sizeof(modeler_real) % LINE;
    place_ahead ahead = {out - phase, phase, phase};

    while (all->left > 0) {
        const size_t now = evaluated(all, p.values);
        for (size_t lane = 0; lane < now; lane += FEW) {
            turns[version](&p, p.values + lane);
            push(&p, &ahead, now - lane < FEW ? now - lane : FEW, streams[version]);
        }
    }
    memcpy(ahead.line + ahead.foreign, p.rows - ahead.held + ahead.foreign,
           (ahead.held - ahead.foreign) * sizeof(modeler_real));
    MODELER_FENCE;
}

/* A column is a row of one number of each joint, short ones in one block that the next row covers;
 * `source` are those of all columns. */
static plan planned_columns(const modeler_tiled *robot, modeler_real *work)
{
    const size_t joints = (size_t)robot->joints, blocks = blocks_of(joints);
    const size_t entries = (size_t)robot->nonzeros;
    plan p = {joints, joints, blocks, NULL, NULL, NULL, work, work + TILES * values_length(robot)};

    for (size_t k = 0; k < TILES; k++) {
        memset(work + k * values_length(robot) + entries * MODELER_LANES, 0,
               MODELER_LANES * sizeof(modeler_real));
    }
    p.first = (int *)(void *)(p.rows + rows_length(robot) + LINE * (size_t)robot->columns);
    p.source = p.first + blocks;
    for (size_t b = 0; b < blocks; b++) {
        p.first[b] = (int)(b == 0 || (b + 1) * FEW <= joints ? b * FEW : joints - FEW);
    }
    for (size_t k = 0; k < (size_t)robot->columns * FEW * blocks; k++) {
        p.source[k] = (int)entries;
    }
    for (size_t k = 0; k < entries; k++) {
        for (size_t b = 0; b < blocks; b++) {
            const int place = robot->row[k] - p.first[b];
            if (place >= 0 && place < FEW) {
                p.source[((size_t)robot->column[k] * blocks + b) * FEW + (size_t)place] = (int)k;
            }
        }
    }
    return p;
}

static void by_columns(supply *all, modeler_real *W, size_t rows, modeler_real *work)
{
    const int version = MODELER_BEST_VERSION;
    const size_t columns = (size_t)all->robot->columns, length = values_length(all->robot);
    plan p = planned_columns(all->robot, work);
    modeler_real *const buffer = p.rows;
    modeler_real *const kept = buffer + rows_length(all->robot); /* lines that are not yet whole */
    int *const source = p.source;

    for (size_t done = 0; all->left > 0;) {
        size_t now = 0;
        for (size_t k = 0; k < TILES && all->left > 0; k++) {
            now += evaluated(all, p.values + k * length);
        }
        for (size_t c = 0; c < columns; c++) {
            modeler_real *const to = W + c * rows + done, *const rest = kept + c * LINE;
            const size_t phase = (uintptr_t)to / sizeof(modeler_real) % LINE;
            const size_t whole = phase + now * p.width, lines = whole / LINE;
            const size_t foreign = done == 0 && phase > 0; /* what stands before is not ours */

            memcpy(buffer, rest, LINE * sizeof(modeler_real));
            p.source = source + c * FEW * p.blocks;
            p.rows = buffer + phase;
            turned[version](&p, p.values, length, now);
            if (foreign > 0) {
                const size_t ours = whole < LINE ? now * p.width : LINE - phase;
                memcpy(to, p.rows, ours * sizeof(modeler_real));
            }
            if (lines > foreign) {
                streams[version](buffer + foreign * LINE, to - phase + foreign * LINE,
                                 lines - foreign);
            }
            memcpy(rest, buffer + lines * LINE, LINE * sizeof(modeler_real));
            if (all->left == 0 && lines >= foreign) {
                memcpy(to - phase + lines * LINE, rest,
                       (whole - lines * LINE) * sizeof(modeler_real));
            }
        }
        done += now * p.width;
    }
    MODELER_FENCE;
}

void modeler_tile_observation(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                              const modeler_real *qd, const modeler_real *qdd,
                              const modeler_real *s, modeler_real *W, void *work)
{
    supply all = {robot, samples, q, qd, qdd, s, NULL, NULL, NULL};

    by_rows(&all, W, supplied(&all, robot, NULL, work), 1);
}

void modeler_tile_columns(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                          const modeler_real *qd, const modeler_real *qdd, const modeler_real *s,
                          modeler_real *W, size_t rows, void *work)
{
    supply all = {robot, samples, q, qd, qdd, s, NULL, NULL, NULL};

    by_columns(&all, W, rows, supplied(&all, robot, NULL, work));
}

void modeler_tile_nonzeros(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                           const modeler_real *qd, const modeler_real *qdd, const modeler_real *s,
                           modeler_real *values, void *work)
{
    supply all = {robot, samples, q, qd, qdd, s, NULL, NULL, NULL};

    by_rows(&all, values, supplied(&all, robot, NULL, work), 0);
}

void modeler_tile_closed(const modeler_tiled *robot, size_t samples, const modeler_real *q,
                         const modeler_real *qd, const modeler_real *qdd, modeler_real *W,
                         size_t rows, int *status, void *work)
{
    supply all = {robot, samples, q, qd, qdd, NULL, NULL, NULL, NULL};
    modeler_real *const rest = supplied(&all, robot, status, work);
    const size_t joints = (size_t)robot->joints, columns = (size_t)robot->columns;

    if (rows == 0) {
        by_rows(&all, W, rest, 1);
    } else {
        by_columns(&all, W, rows, rest);
    }
    for (size_t i = 0; i < samples; i++) {
        for (size_t k = 0; status[i] != 0 && k < joints * columns; k++) {
            const size_t row = i * joints + k / columns, column = k % columns;
            W[rows == 0 ? row * columns + column : column * rows + row] = NAN;
        }
    }
}

#else /* for one instruction set */

#if MODELER_WIDTH >= FEW

typedef modeler_real MODELER_VERSION(four)
    __attribute__((vector_size(FEW * sizeof(modeler_real)), aligned(sizeof(modeler_real)),
                   may_alias));
typedef WHOLE MODELER_VERSION(places) __attribute__((vector_size(FEW * sizeof(modeler_real))));

/* A square of FEW entries and FEW samples is turned in the registers. */
#undef SHUFFLE
#define SHUFFLE(...) MODELER_SHUFFLE(MODELER_VERSION(places), __VA_ARGS__)
MODELER_TARGET static inline void MODELER_VERSION(square)(const modeler_real *A,
                                                          const modeler_real *B,
                                                          const modeler_real *C,
                                                          const modeler_real *D, modeler_real *to,
                                                          size_t width)
{
    typedef MODELER_VERSION(four) four;
    const four a0 = *(const four *)A, a1 = *(const four *)B;
    const four a2 = *(const four *)C, a3 = *(const four *)D;
    const four b0 = SHUFFLE(a0, a1, 0, 4, 2, 6), b1 = SHUFFLE(a0, a1, 1, 5, 3, 7);
    const four b2 = SHUFFLE(a2, a3, 0, 4, 2, 6), b3 = SHUFFLE(a2, a3, 1, 5, 3, 7);

    *(four *)to = SHUFFLE(b0, b2, 0, 1, 4, 5);
    *(four *)(to + width) = SHUFFLE(b1, b3, 0, 1, 4, 5);
    *(four *)(to + 2 * width) = SHUFFLE(b0, b2, 2, 3, 6, 7);
    *(four *)(to + 3 * width) = SHUFFLE(b1, b3, 2, 3, 6, 7);
}

MODELER_TARGET static void MODELER_VERSION(turn)(const plan *p, const modeler_real *values)
{
    if (p->blocks == 0) {
        scatter(p, values);
    }
    for (size_t b = 0; b < p->blocks; b++) {
        const int *const source = p->source + b * FEW;
        modeler_real *const to = p->rows + p->first[b];

        MODELER_VERSION(square)(values + source[0] * MODELER_LANES,
                                values + source[1] * MODELER_LANES,
                                values + source[2] * MODELER_LANES,
                                values + source[3] * MODELER_LANES, to, p->width);
    }
}

/* One column of the samples of some tiles, whose values are `length` apart. */
MODELER_TARGET static void MODELER_VERSION(column)(const plan *p, const modeler_real *values,
                                                   size_t length, size_t samples)
{
    const size_t width = p->width;

    for (size_t b = 0; b < p->blocks; b++) {
        const int *const source = p->source + b * FEW;
        const modeler_real *A = values + source[0] * MODELER_LANES;
        const modeler_real *B = values + source[1] * MODELER_LANES;
        const modeler_real *C = values + source[2] * MODELER_LANES;
        const modeler_real *D = values + source[3] * MODELER_LANES;
        modeler_real *to = p->rows + p->first[b];

        for (size_t i = 0; i < samples; i += MODELER_LANES) {
            for (int lane = 0; lane < MODELER_LANES; lane += FEW) {
                MODELER_VERSION(square)(A + lane, B + lane, C + lane, D + lane, to, width);
                to += FEW * width;
            }
            A += length;
            B += length;
            C += length;
            D += length;
        }
    }
}

#else

static void MODELER_VERSION(turn)(const plan *p, const modeler_real *values)
{
    scatter(p, values);
}

static void MODELER_VERSION(column)(const plan *p, const modeler_real *values, size_t length,
                                    size_t samples)
{
    plan own = *p;

    for (size_t i = 0; i < samples; i += FEW) {
        scatter(&own, values + i / MODELER_LANES * length + i % MODELER_LANES);
        own.rows += FEW * own.width;
    }
}

#endif

#if MODELER_WIDTH > 1

typedef modeler_real MODELER_VERSION(wide) __attribute__((
    vector_size(sizeof(modeler_real) * MODELER_WIDTH), aligned(sizeof(modeler_real)), may_alias));
typedef modeler_real MODELER_VERSION(straight)
    __attribute__((vector_size(sizeof(modeler_real) * MODELER_WIDTH), may_alias));

MODELER_TARGET static void MODELER_VERSION(stream)(const modeler_real *from, modeler_real *to,
                                                   size_t lines)
{
    for (size_t i = 0; i < lines * LINE; i += MODELER_WIDTH) {
        MODELER_STREAM((MODELER_VERSION(straight) *)(void *)(to + i),
                       *(const MODELER_VERSION(wide) *)(from + i));
    }
}

#else

static void MODELER_VERSION(stream)(const modeler_real *from, modeler_real *to,
                                                   size_t lines)
{
    memcpy(to, from, lines * LINE * sizeof(modeler_real));
}

#endif

#endif
