/* The least squares of csrc/modeler_fused.c, as Python calls them: read by cffi. */
typedef struct {
    int joints, signals, nonzeros;
    const int *row;
    void *tile, *entries, *entries_signals;
} modeler_source;
typedef struct {
    const double *q, *qd, *qdd, *s, *tau;
    const unsigned char *use;
    const double *weight;
} modeler_samples;
typedef struct {
    size_t rows, step, y_step, use_step;
    int columns;
    const int *column;
    const double *W, *y;
    const unsigned char *use;
} modeler_rows;
typedef struct {
    size_t rows, joints, columns;
    const int *start, *sample, *span;
    const double *weight, *values;
    const unsigned char *usable, *whole, *used;
} modeler_means;
int modeler_fused_level(int);
size_t modeler_fused_work(const modeler_source *);
size_t modeler_fused_triangles(const modeler_source *, size_t, const modeler_samples *, int,
                               double *, size_t *, unsigned char *, void *);
void modeler_fused_merge(const modeler_source *, int, double *, const double *, void *);
size_t modeler_rows_work(int);
size_t modeler_rows_triangle(const modeler_rows *, int, double *, size_t *, void *);
void modeler_row_means(const modeler_means *, int, double *);
size_t modeler_mean_work(const modeler_source *, size_t);
size_t modeler_mean_triangles(const modeler_source *, const modeler_samples *,
                              const modeler_means *, size_t, int, double *, size_t *, void *);
