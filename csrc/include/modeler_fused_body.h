/* Householder reflections for one width of vectors; included by modeler_fused.c once per width.
 *
 * OWN(name)   name of a function of this width
 * TARGET      attribute of its functions
 * LANES       doubles of a vector: 8, 4 or 2
 * KEEP(v)     keeps a vector in its register: gcc would load it again for every use
 * COLUMNS     columns that are reflected at once: 4 or 2
 *
 * A tile holds rows column after column, `stride` apart; p columns, p a multiple of 4. Four
 * reflections are made at a time (a panel) and applied together to the columns right of it, so that
 * every column is read and written once for four reflections. The reflection i of a panel at column
 * k is I - b v v^T, v = (z in row k + i of R, x_i in the tile), b = 2 / v^T v.
 */

#define VECTOR OWN(vector)
__extension__ typedef double VECTOR __attribute__((vector_size(8 * LANES), may_alias));

#define AT(column, r) (*(VECTOR *)(void *)((column) + (r)))
#define SEEN(column, r) (*(const VECTOR *)(const void *)((column) + (r)))

typedef struct {
    double z[4], b[4], g[4][4]; /* g[i][j] = x_i . x_j, i < j */
} OWN(panel);

/* out[i] = sum of the lanes of the i-th vector. */
TARGET static inline void OWN(sums)(double out[4], const VECTOR *a)
{
#if LANES == 8 && MODELER_SHUFFLES
    const VECTOR ab = __builtin_shufflevector(a[0], a[1], 0, 8, 2, 10, 4, 12, 6, 14) +
                      __builtin_shufflevector(a[0], a[1], 1, 9, 3, 11, 5, 13, 7, 15);
    const VECTOR cd = __builtin_shufflevector(a[2], a[3], 0, 8, 2, 10, 4, 12, 6, 14) +
                      __builtin_shufflevector(a[2], a[3], 1, 9, 3, 11, 5, 13, 7, 15);
    const VECTOR u = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13) +
                     __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
    const VECTOR v = u + __builtin_shufflevector(u, u, 4, 5, 6, 7, 0, 1, 2, 3);
    out[0] = v[0], out[1] = v[1], out[2] = v[2], out[3] = v[3];
#elif LANES == 4 && MODELER_SHUFFLES
    const VECTOR ab = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6) +
                      __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7);
    const VECTOR cd = __builtin_shufflevector(a[2], a[3], 0, 4, 2, 6) +
                      __builtin_shufflevector(a[2], a[3], 1, 5, 3, 7);
    const VECTOR u =
        __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    out[0] = u[0], out[1] = u[1], out[2] = u[2], out[3] = u[3];
#else
    out[0] = a[0][0], out[1] = a[1][0], out[2] = a[2][0], out[3] = a[3][0];
    for (int lane = 1; lane < LANES; lane++) {
        out[0] += a[0][lane], out[1] += a[1][lane], out[2] += a[2][lane], out[3] += a[3][lane];
    }
#endif
}

/* d[j] = x_i . x_j of four columns; x_i is column i of them. */
TARGET static inline void OWN(products)(size_t rows, size_t stride, const double *x, int i,
                                        double d[4])
{
    const double *x0 = x, *x1 = x + stride, *x2 = x1 + stride, *x3 = x2 + stride;
    const double *own = x + (size_t)i * stride;
    VECTOR even[4] = {{0}}, odd[4] = {{0}};
    for (size_t r = 0; r < rows; r += 2 * LANES) {
        const VECTOR v = SEEN(own, r), w = SEEN(own, r + LANES);
        even[0] += v * SEEN(x0, r), odd[0] += w * SEEN(x0, r + LANES);
        even[1] += v * SEEN(x1, r), odd[1] += w * SEEN(x1, r + LANES);
        even[2] += v * SEEN(x2, r), odd[2] += w * SEEN(x2, r + LANES);
        even[3] += v * SEEN(x3, r), odd[3] += w * SEEN(x3, r + LANES);
    }
    even[0] += odd[0], even[1] += odd[1], even[2] += odd[2], even[3] += odd[3];
    OWN(sums)(d, even);
}

/* Makes the four reflections that clear the columns x under the square at R. */
TARGET static void OWN(reflections)(size_t rows, size_t stride, size_t p, double *R, double *x,
                                    OWN(panel) *made)
{
    for (int i = 0; i < 4; i++) {
        double d[4], *row = R + (size_t)i * p;
        OWN(products)(rows, stride, x, i, d);
        const double alpha = row[i], square = alpha * alpha + d[i];
        made->z[i] = 0.0;
        made->b[i] = 0.0;
        for (int j = 0; j < i; j++) {
            made->g[j][i] = d[j];
        }
        if (!(d[i] > 0.0 && square > SMALLEST_SQUARE)) {
            continue;
        }
        const double nu = alpha > 0.0 ? -sqrt(square) : sqrt(square);
        const double z = alpha - nu, b = -1.0 / (nu * z);
        made->z[i] = z, made->b[i] = b, row[i] = nu;
        const double *own = x + (size_t)i * stride;
        for (int j = i + 1; j < 4; j++) {
            const double w = b * (z * row[j] + d[j]);
            double *other = x + (size_t)j * stride;
            row[j] -= w * z;
            for (size_t r = 0; r < rows; r += LANES) {
                AT(other, r) -= w * SEEN(own, r);
            }
        }
    }
}

/* w[i][c] of column c: how much of v_i is taken from it; R is the place of the panel's first row
 * and of the first column. */
TARGET static inline void OWN(shares)(size_t p, double *R, const OWN(panel) *made,
                                      double d[COLUMNS][4], double w[4][COLUMNS])
{
    for (int c = 0; c < COLUMNS; c++) {
        for (int i = 0; i < 4; i++) {
            double sum = d[c][i] + made->z[i] * R[(size_t)i * p + (size_t)c];
            for (int j = 0; j < i; j++) {
                sum -= w[j][c] * made->g[j][i];
            }
            w[i][c] = made->b[i] * sum;
            R[(size_t)i * p + (size_t)c] -= w[i][c] * made->z[i];
        }
    }
}

/* Applies the reflections of the panel x to COLUMNS columns. */
TARGET static void OWN(reflect)(size_t rows, size_t stride, size_t p, double *R, const double *x,
                                double *columns, const OWN(panel) *made)
{
    const double *x0 = x, *x1 = x + stride, *x2 = x1 + stride, *x3 = x2 + stride;
    double d[COLUMNS][4], w[4][COLUMNS];
    double *c0 = columns, *c1 = c0 + stride;
    VECTOR a[4] = {{0}}, b[4] = {{0}};
#if COLUMNS == 4
    double *c2 = c1 + stride, *c3 = c2 + stride;
    VECTOR e[4] = {{0}}, f[4] = {{0}};
#endif
    for (size_t r = 0; r < rows; r += LANES) {
        VECTOR v0 = SEEN(x0, r), v1 = SEEN(x1, r), v2 = SEEN(x2, r), v3 = SEEN(x3, r);
        KEEP(v0);
        KEEP(v1);
        KEEP(v2);
        KEEP(v3);
        VECTOR y = SEEN(c0, r);
        KEEP(y);
        a[0] += v0 * y, a[1] += v1 * y, a[2] += v2 * y, a[3] += v3 * y;
        y = SEEN(c1, r);
        KEEP(y);
        b[0] += v0 * y, b[1] += v1 * y, b[2] += v2 * y, b[3] += v3 * y;
#if COLUMNS == 4
        y = SEEN(c2, r);
        KEEP(y);
        e[0] += v0 * y, e[1] += v1 * y, e[2] += v2 * y, e[3] += v3 * y;
        y = SEEN(c3, r);
        KEEP(y);
        f[0] += v0 * y, f[1] += v1 * y, f[2] += v2 * y, f[3] += v3 * y;
#endif
    }
    OWN(sums)(d[0], a), OWN(sums)(d[1], b);
#if COLUMNS == 4
    OWN(sums)(d[2], e), OWN(sums)(d[3], f);
#endif
    OWN(shares)(p, R, made, d, w);
    for (size_t r = 0; r < rows; r += LANES) {
        VECTOR v0 = SEEN(x0, r), v1 = SEEN(x1, r), v2 = SEEN(x2, r), v3 = SEEN(x3, r);
        KEEP(v0);
        KEEP(v1);
        KEEP(v2);
        KEEP(v3);
        AT(c0, r) = AT(c0, r) - w[0][0] * v0 - w[1][0] * v1 - w[2][0] * v2 - w[3][0] * v3;
        AT(c1, r) = AT(c1, r) - w[0][1] * v0 - w[1][1] * v1 - w[2][1] * v2 - w[3][1] * v3;
#if COLUMNS == 4
        AT(c2, r) = AT(c2, r) - w[0][2] * v0 - w[1][2] * v1 - w[2][2] * v2 - w[3][2] * v3;
        AT(c3, r) = AT(c3, r) - w[0][3] * v0 - w[1][3] * v1 - w[2][3] * v2 - w[3][3] * v3;
#endif
    }
}

/* R of [R; tile]; the tile is overwritten. rows is a multiple of 2*LANES. */
TARGET static void OWN(absorb)(size_t rows, size_t stride, size_t p, double *R, double *tile)
{
    OWN(panel) made;
    for (size_t k = 0; k < p; k += 4) {
        double *x = tile + k * stride;
        OWN(reflections)(rows, stride, p, R + k * p + k, x, &made);
        for (size_t c = k + 4; c < p; c += COLUMNS) {
            OWN(reflect)(rows, stride, p, R + k * p + c, x, tile + c * stride, &made);
        }
    }
}

/* lanes += 0, or NaN where a value of the lane, or what stands there, is not finite or too large. */
TARGET static void OWN(spoilt)(int entries, const double *values, double lanes[MODELER_LANES])
{
    for (int lane = 0; lane < MODELER_LANES; lane += LANES) {
        VECTOR scaled, sum = {0};
        memcpy(&scaled, lanes + lane, sizeof scaled);
        scaled = scaled * OVERFLOWS;
        sum += scaled * scaled * 0.0;
        for (int k = 0; k < entries; k++) {
            scaled = SEEN(values, k * MODELER_LANES + lane) * OVERFLOWS;
            sum += scaled * scaled * 0.0;
        }
        memcpy(lanes + lane, &sum, sizeof sum);
    }
}

/* Values of any place in memory. */
#define LOOSE OWN(loose)
__extension__ typedef double LOOSE __attribute__((vector_size(8 * LANES), may_alias, aligned(8)));

/* mean[k] = sum of w x[k] over the samples in use, over the sum of w; 0 without any. The values
 * are those of the samples from `first` on. */
TARGET static void OWN(average)(size_t weights, const int *sample, const double *weight,
                                const unsigned char *use, size_t use_step, const double *values,
                                size_t first, size_t step, size_t columns, double *mean)
{
    double total = 0.0;
    memset(mean, 0, columns * sizeof *mean);
    for (size_t i = 0; i < weights; i++) {
        const size_t at = (size_t)sample[i];
        if (!use[at * use_step]) {
            continue;
        }
        const double w = weight[i], *x = values + (at - first) * step;
        size_t k = 0;
        total += w;
        for (; k + LANES <= columns; k += LANES) {
            *(LOOSE *)(void *)(mean + k) += w * *(const LOOSE *)(const void *)(x + k);
        }
        for (; k < columns; k++) {
            mean[k] += w * x[k];
        }
    }
    for (size_t k = 0; k < columns && total > 0.0; k++) {
        mean[k] /= total;
    }
}

#undef LOOSE
#undef VECTOR
#undef AT
#undef SEEN
#undef OWN
#undef TARGET
#undef LANES
#undef COLUMNS
#undef KEEP
