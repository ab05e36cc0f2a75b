/* Functions of a library of tiles, as Python calls them: read by cffi; PREFIX is the robot's. */
typedef struct {
    int joints, columns, signals, nonzeros;
    const int *row, *column;
    void *tile, *closing;
    size_t room;
    const void *singles;
} modeler_tiled;
const modeler_tiled *PREFIX_tiled(void);
const char *PREFIX_tile_signature(void);
size_t modeler_tile_work(const modeler_tiled *);
void modeler_tile_observation(const modeler_tiled *, size_t, const double *, const double *,
                              const double *, const double *, double *, void *);
void modeler_tile_nonzeros(const modeler_tiled *, size_t, const double *, const double *,
                           const double *, const double *, double *, void *);
void modeler_tile_columns(const modeler_tiled *, size_t, const double *, const double *,
                          const double *, const double *, double *, size_t, void *);
void modeler_tile_closed(const modeler_tiled *, size_t, const double *, const double *,
                         const double *, double *, size_t, int *, void *);
