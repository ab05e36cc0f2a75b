/* Least squares on the fly: triangles of [W_j y_j], joint by joint, without W.
 *
 * R of [W_j y_j] = Q R by Householder reflections, which keep what W^T W would lose: the singular
 * values of R are those of [W_j y_j] to a few roundings of the largest. Only the columns that can
 * enter the torque of joint j take part. Each function adds rows to a state and may be called again
 * with the next rows; a state of zeros is that of no rows.
 *
 * C99, no allocation, no global state, re-entrant. Arrays are row-major.
 */
#ifndef MODELER_FUSED_H
#define MODELER_FUSED_H

#include <stddef.h>

#include "modeler_batch.h"
#include "modeler_tile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Rows of a joint that are gathered before they are reduced. */
#ifndef MODELER_FUSED_ROWS
#define MODELER_FUSED_ROWS 256
#endif

/* Values from here on count as not finite: their squares could overflow. */
#define MODELER_FUSED_LARGEST 1e134

/* Which instructions: those of every processor, AVX2 with fused multiply-add, AVX-512. Results of
 * different ones agree to rounding only. A level above the best of this processor means the best. */
enum { MODELER_BASELINE = 1, MODELER_AVX2 = 2, MODELER_AVX512 = 3 };
int modeler_fused_level(int wanted);

/* The entries of a base regressor, from one of three functions; the others are NULL. */
typedef struct {
    int joints, signals, nonzeros;
    const int *row; /* of each entry, row after row */
    modeler_tile_function tile;
    modeler_function_3 entries;         /* of one sample */
    modeler_function_4 entries_signals; /* of one sample of a robot with signals */
} modeler_source;

/* What was measured, (samples, joints) each. A row whose `use` is 0 contributes nothing and may
 * hold anything; `weight` multiplies a row and its torque. s is (samples, signals). use, weight and
 * s may be NULL. */
typedef struct {
    const double *q, *qd, *qdd, *s, *tau;
    const unsigned char *use;
    const double *weight;
} modeler_samples;

/* Columns of joint j in the state: its entries, its torque, then columns of zeros. */
int modeler_fused_size(const modeler_source *source, int joint);

/* Number of doubles of a state: a triangle of size x size values for each joint, row-major. */
size_t modeler_fused_state(const modeler_source *source);

/* Number of bytes that the functions below work in; they need no content and no alignment. */
size_t modeler_fused_work(const modeler_source *source);

/* Adds samples to a state. Samples with a row in use that is not finite are left out.
 *
 * state: of modeler_fused_state(source) doubles.
 * rows: (joints), increased by the rows that were added.
 * bad: (samples), set to 1 for samples that were left out, else to 0; may be NULL.
 * Returns how many samples were left out. */
size_t modeler_fused_triangles(const modeler_source *source, size_t samples,
                               const modeler_samples *given, int level, double *state,
                               size_t *rows, unsigned char *bad, void *work);

/* Adds the rows of state `other` to `state`. */
void modeler_fused_merge(const modeler_source *source, int level, double *state,
                         const double *other, void *work);

/* Rows that stand in memory already: W[i*step + column[k]], torque y[i*y_step].
 * A row with use[i*use_step] == 0 is left out; use may be NULL. */
typedef struct {
    size_t rows, step, y_step, use_step;
    int columns;
    const int *column;
    const double *W, *y;
    const unsigned char *use;
} modeler_rows;

/* Size of the triangle of so many columns and a torque, and bytes of work for it. */
int modeler_rows_size(int columns);
size_t modeler_rows_work(int columns);

/* Adds rows to one triangle. Rows that are not finite are left out.
 *
 * triangle: (size, size) of modeler_rows_size(columns).
 * added: increased by the rows that were added.
 * Returns how many rows were left out. */
size_t modeler_rows_triangle(const modeler_rows *given, int level, double *triangle, size_t *added,
                             void *work);

/* Weighted means of samples: row after row its weights, from start[row] on, and their samples.
 * values are (samples, joints, columns), of which joint j has span[2j] up to span[2j+1]. A row of a
 * joint is a mean over samples with usable[sample*joints + j] where used[row*joints + j], else over
 * those with whole[sample]; 0 without any. */
typedef struct {
    size_t rows, joints, columns;
    const int *start, *sample, *span;
    const double *weight, *values;
    const unsigned char *usable, *whole, *used;
} modeler_means;

/* means: (rows, joints, columns); what lies beyond the span of a joint stays. */
void modeler_row_means(const modeler_means *given, int level, double *means);

/* Adds rows that are such means of a base regressor to a state; it is never in memory as a whole.
 * Rows that are not used are left out; samples of rows increase, as do the first and last of them.
 *
 * given: the motion of the samples; tau is that of the rows, (rows, joints); no use, no weight.
 * means: all but its columns, span, values and whole.
 * window: samples from the first to the last of a row, at most.
 * work: of modeler_mean_work bytes.
 * Returns how many rows were not finite. */
size_t modeler_mean_work(const modeler_source *source, size_t window);
size_t modeler_mean_triangles(const modeler_source *source, const modeler_samples *given,
                              const modeler_means *means, size_t window, int level, double *state,
                              size_t *rows, void *work);

#ifdef __cplusplus
}
#endif

#endif
