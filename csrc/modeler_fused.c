/* Least squares on the fly; see modeler_fused.h. */
#include "modeler_fused.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Columns of a tile are this far apart: 2 KB would put them all on the same lines of a cache. */
#define STRIDE (MODELER_FUSED_ROWS + 8)

/* A column this small beside an R this small is left: b would not be exact to rounding. */
#define SMALLEST_SQUARE 1e-250

/* Largest times this, squared, overflows. */
#define OVERFLOWS (1.4e154 / MODELER_FUSED_LARGEST)

#if defined(__clang__)
#define MODELER_SHUFFLES 1
#elif defined(__GNUC__)
#define MODELER_SHUFFLES (__GNUC__ >= 12)
#endif

#if defined(__GNUC__) && defined(__x86_64__)
#define DISPATCHED 1
#define OWN(name) name##_avx512
#define TARGET __attribute__((target("avx512f,avx512vl,avx512dq,avx2,fma")))
#define LANES 8
#define COLUMNS 4
#define KEEP(v) __asm__("" : "+v"(v))
#include "modeler_fused_body.h"
#define OWN(name) name##_avx2
#define TARGET __attribute__((target("avx2,fma")))
#define LANES 4
#define COLUMNS 2
#define KEEP(v) __asm__("" : "+x"(v))
#include "modeler_fused_body.h"
#endif

#define OWN(name) name##_baseline
#define TARGET
#define LANES 2
#define COLUMNS 2
#define KEEP(v) (void)0
#include "modeler_fused_body.h"

int modeler_fused_level(int wanted)
{
    int best = MODELER_BASELINE;
#ifdef DISPATCHED
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        best = MODELER_AVX2;
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq")) {
            best = MODELER_AVX512;
        }
    }
#endif
    return wanted < best && wanted >= MODELER_BASELINE ? wanted : best;
}

/* How a joint's part of a state stands while samples pass. */
typedef struct {
    int first, entries; /* of the source */
    size_t p, filled;
    double *R, *tile;
} shaft;

static size_t padded(int entries)
{
    return ((size_t)entries + 1 + 3) / 4 * 4;
}

/* R of [R; tile]; the tile is empty then. */
static void absorb(int level, shaft *own)
{
    const size_t whole = (own->filled + 15) / 16 * 16, entries = (size_t)own->entries;
    if (whole == 0) {
        return;
    }
    for (size_t k = 0; k <= entries && whole > own->filled; k++) {
        memset(own->tile + k * STRIDE + own->filled, 0, (whole - own->filled) * sizeof(double));
    }
    own->filled = 0;
#ifdef DISPATCHED
    if (level == MODELER_AVX512) {
        absorb_avx512(whole, STRIDE, own->p, own->R, own->tile);
        return;
    }
    if (level == MODELER_AVX2) {
        absorb_avx2(whole, STRIDE, own->p, own->R, own->tile);
        return;
    }
#endif
    (void)level;
    absorb_baseline(whole, STRIDE, own->p, own->R, own->tile);
}

/* 0 or NaN for each lane: NaN if a value of it is not finite or too large to be squared. */
static void spoilt(int level, int entries, const double *values, double lanes[MODELER_LANES])
{
#ifdef DISPATCHED
    if (level == MODELER_AVX512) {
        spoilt_avx512(entries, values, lanes);
        return;
    }
    if (level == MODELER_AVX2) {
        spoilt_avx2(entries, values, lanes);
        return;
    }
#endif
    (void)level;
    spoilt_baseline(entries, values, lanes);
}

int modeler_fused_size(const modeler_source *source, int joint)
{
    int entries = 0;
    for (int k = 0; k < source->nonzeros; k++) {
        entries += source->row[k] == joint;
    }
    return (int)padded(entries);
}

size_t modeler_fused_state(const modeler_source *source)
{
    size_t doubles = 0;
    for (int j = 0; j < source->joints; j++) {
        const size_t p = (size_t)modeler_fused_size(source, j);
        doubles += p * p;
    }
    return doubles;
}

/* Lanes of one group of samples. */
typedef struct {
    double *values;           /* (nonzeros, lanes) */
    double *q, *qd, *qdd, *s; /* (lanes, joints), (lanes, signals): of the last group */
    double *torque;           /* (joints, lanes) */
    double *one;              /* (nonzeros,) of one sample */
    unsigned char *use;       /* (joints, lanes) */
    shaft *shafts;
} group;

static size_t group_doubles(const modeler_source *source)
{
    const size_t n = (size_t)source->joints, m = (size_t)source->signals;
    return MODELER_LANES * ((size_t)source->nonzeros + 4 * n + m) + (size_t)source->nonzeros;
}

static size_t tile_doubles(const modeler_source *source)
{
    size_t columns = 0;
    for (int j = 0; j < source->joints; j++) {
        columns += (size_t)modeler_fused_size(source, j);
    }
    return columns * STRIDE;
}

size_t modeler_fused_work(const modeler_source *source)
{
    const size_t doubles = group_doubles(source) + tile_doubles(source);
    return 64 + doubles * sizeof(double) + (size_t)source->joints * (sizeof(shaft) + MODELER_LANES);
}

static void *aligned(void *work)
{
    return (void *)(((uintptr_t)work + 63) / 64 * 64);
}

/* Divides the work memory, and the state, among the joints. Tiles begin with zeros. */
static group divided(const modeler_source *source, double *state, void *work)
{
    const size_t n = (size_t)source->joints, m = (size_t)source->signals;
    group own;
    double *tile = aligned(work);
    own.values = tile + tile_doubles(source);
    memset(tile, 0, tile_doubles(source) * sizeof *tile);
    own.torque = own.values + MODELER_LANES * (size_t)source->nonzeros;
    own.q = own.torque + MODELER_LANES * n;
    own.qd = own.q + MODELER_LANES * n;
    own.qdd = own.qd + MODELER_LANES * n;
    own.s = own.qdd + MODELER_LANES * n;
    own.one = own.s + MODELER_LANES * m;
    own.shafts = (shaft *)(void *)(own.one + source->nonzeros);
    own.use = (unsigned char *)(own.shafts + n);
    int entry = 0;
    for (int j = 0; j < source->joints; j++) {
        shaft *joint = own.shafts + j;
        joint->first = entry;
        while (entry < source->nonzeros && source->row[entry] == j) {
            entry++;
        }
        joint->entries = entry - joint->first;
        joint->p = padded(joint->entries);
        joint->filled = 0;
        joint->R = state;
        joint->tile = tile;
        state += joint->p * joint->p;
        tile += joint->p * STRIDE;
    }
    return own;
}

/* Rows of `width` values from sample `first` on; the last group repeats its last sample. */
static const double *lanes_of(const double *rows, size_t width, size_t first, size_t count,
                              double *copy)
{
    if (count == MODELER_LANES || rows == NULL) {
        return rows == NULL ? NULL : rows + first * width;
    }
    for (size_t lane = 0; lane < MODELER_LANES; lane++) {
        const size_t sample = first + (lane < count ? lane : count - 1);
        memcpy(copy + lane * width, rows + sample * width, width * sizeof *copy);
    }
    return copy;
}

/* The entries of one of some samples. */
static void entries_of(const modeler_source *source, const double *q, const double *qd,
                       const double *qdd, const double *s, size_t at, double *entries)
{
    const size_t n = (size_t)source->joints, m = (size_t)source->signals;
    q += at * n, qd += at * n, qdd += at * n;
    if (source->entries_signals != NULL) {
        source->entries_signals(q, qd, qdd, s + at * m, entries);
    } else {
        source->entries(q, qd, qdd, entries);
    }
}

static void evaluate(const modeler_source *source, const modeler_samples *given, size_t first,
                     size_t count, const group *own)
{
    const size_t n = (size_t)source->joints, m = (size_t)source->signals;
    const size_t entries = (size_t)source->nonzeros;
    const double *q = lanes_of(given->q, n, first, count, own->q);
    const double *qd = lanes_of(given->qd, n, first, count, own->qd);
    const double *qdd = lanes_of(given->qdd, n, first, count, own->qdd);
    const double *s = lanes_of(given->s, m, first, count, own->s);
    if (source->tile != NULL) {
        source->tile(q, qd, qdd, s, own->values);
        return;
    }
    /* One sample after the other. */
    double *one = own->one;
    for (size_t lane = 0; lane < MODELER_LANES; lane++) {
        entries_of(source, q, qd, qdd, s, lane, one);
        for (size_t k = 0; k < entries; k++) {
            own->values[k * MODELER_LANES + lane] = one[k];
        }
    }
}

/* Torques, weights and masks of a group, lane by lane; weights multiply the entries. */
static void measure(const modeler_source *source, const modeler_samples *given, size_t first,
                    size_t count, const group *own)
{
    const size_t n = (size_t)source->joints;
    for (size_t j = 0; j < n; j++) {
        for (size_t lane = 0; lane < MODELER_LANES; lane++) {
            const size_t at = (first + (lane < count ? lane : count - 1)) * n + j;
            const int used = lane < count && (given->use == NULL || given->use[at]);
            own->use[j * MODELER_LANES + lane] = (unsigned char)used;
            own->torque[j * MODELER_LANES + lane] = given->tau[at];
        }
    }
    if (given->weight == NULL) {
        return;
    }
    for (size_t j = 0; j < n; j++) {
        const shaft *joint = own->shafts + j;
        double *values = own->values + MODELER_LANES * (size_t)joint->first;
        double weight[MODELER_LANES];
        for (size_t lane = 0; lane < MODELER_LANES; lane++) {
            weight[lane] = given->weight[(first + (lane < count ? lane : count - 1)) * n + j];
            own->torque[j * MODELER_LANES + lane] *= weight[lane];
        }
        for (int k = 0; k < joint->entries; k++, values += MODELER_LANES) {
            for (size_t lane = 0; lane < MODELER_LANES; lane++) {
                values[lane] *= weight[lane];
            }
        }
    }
}

/* Leaves out samples with a used row that is not finite; marks them in bad, returns how many. */
static size_t leave_out(const modeler_source *source, size_t count, int level, const group *own,
                        unsigned char bad[MODELER_LANES])
{
    const size_t n = (size_t)source->joints;
    double lanes[MODELER_LANES];
    size_t left = 0;
    memset(bad, 0, MODELER_LANES);
    for (size_t j = 0; j < n; j++) {
        const shaft *joint = own->shafts + j;
        const unsigned char *use = own->use + j * MODELER_LANES;
        memcpy(lanes, own->torque + j * MODELER_LANES, sizeof lanes);
        spoilt(level, joint->entries, own->values + MODELER_LANES * (size_t)joint->first, lanes);
        for (size_t lane = 0; lane < MODELER_LANES; lane++) {
            bad[lane] |= (unsigned char)(use[lane] && !(lanes[lane] == 0.0));
        }
    }
    for (size_t lane = 0; lane < count; lane++) {
        left += bad[lane];
    }
    for (size_t k = 0; left > 0 && k < n * MODELER_LANES; k++) {
        own->use[k] = (unsigned char)(own->use[k] && !bad[k % MODELER_LANES]);
    }
    return left;
}

/* Puts the rows in use behind those that wait in the tile; reduces them where it is full. */
static size_t append(shaft *joint, const double *values, const double *torque,
                     const unsigned char *use, int level)
{
    const size_t entries = (size_t)joint->entries;
    size_t used = 0;
    for (size_t lane = 0; lane < MODELER_LANES; lane++) {
        used += use[lane];
    }
    if (joint->filled + MODELER_LANES > MODELER_FUSED_ROWS) {
        absorb(level, joint);
    }
    if (used == MODELER_LANES) {
        double *place = joint->tile + joint->filled;
        for (size_t k = 0; k < entries; k++) {
            memcpy(place + k * STRIDE, values + k * MODELER_LANES, MODELER_LANES * sizeof *place);
        }
        memcpy(place + entries * STRIDE, torque, MODELER_LANES * sizeof *place);
        joint->filled += MODELER_LANES;
        return used;
    }
    for (size_t lane = 0; lane < MODELER_LANES && used > 0; lane++) {
        if (!use[lane]) {
            continue;
        }
        double *place = joint->tile + joint->filled++;
        for (size_t k = 0; k < entries; k++) {
            place[k * STRIDE] = values[k * MODELER_LANES + lane];
        }
        place[entries * STRIDE] = torque[lane];
    }
    return used;
}

size_t modeler_fused_triangles(const modeler_source *source, size_t samples,
                               const modeler_samples *given, int level, double *state,
                               size_t *rows, unsigned char *bad, void *work)
{
    const group own = divided(source, state, work);
    unsigned char left[MODELER_LANES];
    size_t left_out = 0;
    level = modeler_fused_level(level);
    for (size_t first = 0; first < samples; first += MODELER_LANES) {
        const size_t more = samples - first, count = more < MODELER_LANES ? more : MODELER_LANES;
        evaluate(source, given, first, count, &own);
        measure(source, given, first, count, &own);
        left_out += leave_out(source, count, level, &own, left);
        if (bad != NULL) {
            memcpy(bad + first, left, count);
        }
        for (int j = 0; j < source->joints; j++) {
            shaft *joint = own.shafts + j;
            const size_t at = MODELER_LANES * (size_t)j;
            rows[j] += append(joint, own.values + MODELER_LANES * (size_t)joint->first,
                              own.torque + at, own.use + at, level);
        }
    }
    for (int j = 0; j < source->joints; j++) {
        absorb(level, own.shafts + j);
    }
    return left_out;
}

void modeler_fused_merge(const modeler_source *source, int level, double *state,
                         const double *other, void *work)
{
    const group own = divided(source, state, work);
    level = modeler_fused_level(level);
    for (int j = 0; j < source->joints; j++) {
        shaft *joint = own.shafts + j;
        for (size_t i = 0; i < joint->p; i++, other += joint->p) {
            if (joint->filled == MODELER_FUSED_ROWS) {
                absorb(level, joint);
            }
            for (size_t k = 0; k < joint->p; k++) {
                joint->tile[k * STRIDE + joint->filled] = other[k];
            }
            joint->filled++;
        }
        absorb(level, joint);
    }
}

int modeler_rows_size(int columns)
{
    return (int)padded(columns);
}

size_t modeler_rows_work(int columns)
{
    return 64 + padded(columns) * STRIDE * sizeof(double);
}

/* Puts a row behind those that wait in the tile; 0 if it is not finite. */
static size_t append_row(int level, shaft *joint, const double *row, const int *column, double y)
{
    double *place = joint->tile + joint->filled, good = 0.0;
    const size_t entries = (size_t)joint->entries;
    for (size_t k = 0; k <= entries; k++) {
        const double value = k == entries ? y : row[column == NULL ? k : (size_t)column[k]];
        const double scaled = value * OVERFLOWS;
        good += scaled * scaled * 0.0;
        place[k * STRIDE] = value;
    }
    if (!(good == 0.0)) {
        return 0;
    }
    if (++joint->filled == MODELER_FUSED_ROWS) {
        absorb(level, joint);
    }
    return 1;
}

size_t modeler_rows_triangle(const modeler_rows *given, int level, double *triangle, size_t *added,
                             void *work)
{
    const size_t p = padded(given->columns);
    shaft own = {0, given->columns, p, 0, triangle, aligned(work)};
    size_t left_out = 0;
    level = modeler_fused_level(level);
    memset(own.tile, 0, p * STRIDE * sizeof *own.tile);
    for (size_t i = 0; i < given->rows; i++) {
        if (given->use != NULL && !given->use[i * given->use_step]) {
            continue;
        }
        const double *row = given->W + i * given->step, y = given->y[i * given->y_step];
        const size_t good = append_row(level, &own, row, given->column, y);
        *added += good;
        left_out += 1 - good;
    }
    absorb(level, &own);
    return left_out;
}

/* The instructions of a level. */
static void average(int level, size_t weights, const int *sample, const double *weight,
                    const unsigned char *use, size_t use_step, const double *values, size_t first,
                    size_t step, size_t columns, double *mean)
{
#ifdef DISPATCHED
    if (level == MODELER_AVX512) {
        average_avx512(weights, sample, weight, use, use_step, values, first, step, columns,
                       mean);
        return;
    }
    if (level == MODELER_AVX2) {
        average_avx2(weights, sample, weight, use, use_step, values, first, step, columns,
                     mean);
        return;
    }
#endif
    (void)level;
    average_baseline(weights, sample, weight, use, use_step, values, first, step, columns,
                     mean);
}

void modeler_row_means(const modeler_means *given, int level, double *means)
{
    const size_t n = given->joints, c = given->columns;
    level = modeler_fused_level(level);
    for (size_t row = 0; row < given->rows; row++) {
        const size_t start = (size_t)given->start[row];
        const size_t weights = (size_t)given->start[row + 1] - start;
        for (size_t j = 0; j < n; j++) {
            const int used = given->used[row * n + j];
            const size_t first = (size_t)given->span[2 * j];
            average(level, weights, given->sample + start, given->weight + start,
                    used ? given->usable + j : given->whole, used ? n : 1,
                    given->values + j * c + first, 0, n * c, (size_t)given->span[2 * j + 1] - first,
                    means + (row * n + j) * c + first);
        }
    }
}

/* Samples whose entries are kept besides those of a row, so that they seldom move. */
#define SPARE 64

size_t modeler_mean_work(const modeler_source *source, size_t window)
{
    return modeler_fused_work(source) +
           (window + SPARE) * (size_t)source->nonzeros * sizeof(double) + 64;
}

size_t modeler_mean_triangles(const modeler_source *source, const modeler_samples *given,
                              const modeler_means *means, size_t window, int level, double *state,
                              size_t *rows, void *work)
{
    const size_t n = (size_t)source->joints, c = (size_t)source->nonzeros;
    double *values = aligned(work);
    const group own = divided(source, state, values + (window + SPARE) * c);
    size_t base = 0, next = 0, left_out = 0; /* samples from base to next have their entries */
    level = modeler_fused_level(level);
    for (size_t row = 0; row < means->rows; row++) {
        const size_t start = (size_t)means->start[row];
        const size_t weights = (size_t)means->start[row + 1] - start;
        const int *sample = means->sample + start;
        if (weights == 0) {
            continue;
        }
        const size_t low = (size_t)sample[0], high = (size_t)sample[weights - 1] + 1;
        if (next < low) {
            next = low;
            base = low;
        }
        if (high - base > window + SPARE) {
            memmove(values, values + (low - base) * c, (next - low) * c * sizeof *values);
            base = low;
        }
        for (; next < high; next++) {
            entries_of(source, given->q, given->qd, given->qdd, given->s, next,
                       values + (next - base) * c);
        }
        for (size_t j = 0; j < n; j++) {
            shaft *joint = own.shafts + j;
            if (!means->used[row * n + j]) {
                continue;
            }
            average(level, weights, sample, means->weight + start, means->usable + j, n,
                    values + joint->first, base, c, (size_t)joint->entries, own.one);
            const size_t good = append_row(level, joint, own.one, NULL, given->tau[row * n + j]);
            rows[j] += good;
            left_out += 1 - good;
        }
    }
    for (size_t j = 0; j < n; j++) {
        absorb(level, own.shafts + j);
    }
    return left_out;
}
