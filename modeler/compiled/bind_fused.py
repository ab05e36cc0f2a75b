"""The least squares of csrc/modeler_fused.c, made callable; with bind.py all that knows cffi."""

import os
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import cffi
import numpy as np

from modeler.compiled.build import build_library
from modeler.core.errors import BuildError
from modeler.core.resources import resource_dir

_SOURCES = ("modeler_fused.c",)
_HEADERS = ("modeler_fused.h", "modeler_fused_body.h", "modeler_tile.h", "modeler_runtime.h")
_DECISIVE = ("CC", "CFLAGS", "PATH", "MODELER_CACHE", "XDG_CACHE_HOME", "HOME")
"""Variables that decide which library is meant, and where it is kept."""

_DECLARED = """
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
int modeler_fused_level(int);
size_t modeler_fused_work(const modeler_source *);
size_t modeler_fused_triangles(const modeler_source *, size_t, const modeler_samples *, int,
                               double *, size_t *, unsigned char *, void *);
size_t modeler_fused_products_work(const modeler_source *);
size_t modeler_fused_products(const modeler_source *, size_t, size_t, const modeler_samples *, int,
                              int, const int *, double *, unsigned char *, void *);
void modeler_fused_merge(const modeler_source *, int, double *, const double *, void *);
size_t modeler_rows_work(int);
size_t modeler_rows_triangle(const modeler_rows *, int, double *, size_t *, void *);
"""


class Functions(NamedTuple):
    """Addresses of the functions that evaluate a base regressor's entries; 0 for none.

    Attributes:
        entries: of one sample, as `<prefix>_base_regressor_nonzeros`.
        signals: how many it reads besides.
        tile: of several samples, see modeler_tile.h.
    """

    entries: int
    signals: int = 0
    tile: int = 0


class Samples(NamedTuple):
    """Arrays of one call, C-contiguous, one row per sample; see `modeler_samples`."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    s: np.ndarray | None
    use: np.ndarray | None
    weight: np.ndarray | None

    def part(self, block: slice) -> "Samples":
        """The samples of a block."""
        s, use, weight = (x if x is None else x[block] for x in (self.s, self.use, self.weight))
        return Samples(
            self.q[block], self.qd[block], self.qdd[block], self.tau[block], s, use, weight
        )


class FusedLibrary:
    """The loaded library; its functions release the interpreter lock and keep nothing."""

    def __init__(self, path: Path) -> None:
        """Load the library at `path`.

        Raises:
            BuildError: it cannot be loaded.
        """
        self._ffi = cffi.FFI()
        self._ffi.cdef(_DECLARED)
        try:
            self._library: Any = self._ffi.dlopen(str(path))
        except OSError as error:
            raise BuildError(
                f"{path}: the compiled library cannot be loaded ({error}); delete it and try again"
            ) from error

    def level(self, wanted: int = 0) -> int:
        """Which instructions a wanted level means here; 0: the best.

        1: those of every processor of its kind, 2: AVX2, 3: AVX-512.
        """
        return int(self._library.modeler_fused_level(wanted))

    def triangles(
        self, rows_of_entries: np.ndarray, functions: Functions, given: Samples, level: int,
        state: np.ndarray, rows: np.ndarray,
    ) -> np.ndarray:  # fmt: skip
        """Add samples to a state; (samples,) True for those that were left out.

        Args:
            rows_of_entries: (entries,) C int, row after row.
            functions: that evaluate the entries.
            given: the samples.
            level: of instructions.
            state: triangles of all joints one after another, changed.
            rows: (joints,) of numpy.uintp, increased.
        """
        joints = given.q.shape[1]
        source = self._source(rows_of_entries, functions, joints)
        work = self._work(self._library.modeler_fused_work(source))
        bad = np.zeros(len(given.q), dtype=np.uint8)
        self._library.modeler_fused_triangles(
            source, len(given.q), self._samples(given), level,
            self._pointer(state), self._pointer(rows), self._pointer(bad), self._pointer(work),
        )  # fmt: skip
        return bad.view(bool)

    def products(
        self, rows_of_entries: np.ndarray, functions: Functions, given: Samples, past: int,
        level: int, first: int, last: np.ndarray, out: np.ndarray,
    ) -> np.ndarray:  # fmt: skip
        """Add products of rows some samples apart; (samples,) True for those counted as zeros.

        Args:
            rows_of_entries: (entries,) C int, row after row.
            functions: that evaluate the entries.
            given: the samples.
            past: how many of them only stand before the others.
            level: of instructions.
            first: smallest lag.
            last: (joints,) C int, largest lag of each joint.
            out: products of all joints and lags one after another, changed.
        """
        source = self._source(rows_of_entries, functions, given.q.shape[1])
        work = self._work(self._library.modeler_fused_products_work(source))
        bad = np.zeros(len(given.q), dtype=np.uint8)
        self._library.modeler_fused_products(
            source, len(given.q), past, self._samples(given), level, first, self._pointer(last),
            self._pointer(out), self._pointer(bad), self._pointer(work),
        )  # fmt: skip
        return bad.view(bool)

    def merge(
        self, rows_of_entries: np.ndarray, joints: int, state: np.ndarray, other: np.ndarray
    ) -> None:
        """Add the rows of another state to a state."""
        source = self._source(rows_of_entries, Functions(0), joints)
        work = self._work(self._library.modeler_fused_work(source))
        self._library.modeler_fused_merge(
            source, 0, self._pointer(state), self._pointer(other), self._pointer(work)
        )

    def rows(
        self, W: np.ndarray, y: np.ndarray, use: np.ndarray | None, columns: np.ndarray,
        level: int, triangle: np.ndarray,
    ) -> tuple[int, int]:  # fmt: skip
        """Add rows that stand in memory to one triangle; rows added, rows left out.

        Args:
            W: (rows, c) rows one after another in memory, any step.
            y: (rows,) any step.
            use: (rows,) bytes, any step; None for all.
            columns: (k,) C int, the columns to use.
            level: of instructions.
            triangle: of these columns, changed.
        """
        assert W.strides[1] == 8 and W.dtype == y.dtype == np.float64
        given = {
            "rows": len(W), "step": W.strides[0] // 8, "y_step": y.strides[0] // 8,
            "use_step": 0 if use is None else use.strides[0], "columns": len(columns),
            "column": self._pointer(columns), "W": self._pointer(W), "y": self._pointer(y),
            "use": self._pointer(use),
        }  # fmt: skip
        added = np.zeros(1, dtype=np.uintp)
        work = self._work(self._library.modeler_rows_work(len(columns)))
        left = self._library.modeler_rows_triangle(
            self._ffi.new("modeler_rows *", given), level, self._pointer(triangle),
            self._pointer(added), self._pointer(work),
        )  # fmt: skip
        return int(added[0]), int(left)

    def _source(self, rows_of_entries: np.ndarray, functions: Functions, joints: int) -> Any:
        plain, reads = functions.entries, functions.signals
        return self._ffi.new(
            "modeler_source *",
            {
                "joints": joints, "signals": reads, "nonzeros": len(rows_of_entries),
                "row": self._pointer(rows_of_entries),
                "tile": self._ffi.cast("void *", functions.tile),
                "entries": self._ffi.cast("void *", 0 if reads else plain),
                "entries_signals": self._ffi.cast("void *", plain if reads else 0),
            },
        )  # fmt: skip

    def _samples(self, given: Samples) -> Any:
        arrays = {name: self._pointer(array) for name, array in given._asdict().items()}
        return self._ffi.new("modeler_samples *", arrays)

    def _pointer(self, array: np.ndarray | None) -> Any:
        # The caller holds the array.
        return self._ffi.cast("void *", 0 if array is None else array.ctypes.data)

    @staticmethod
    def _work(size: int) -> np.ndarray:
        return np.empty(size, dtype=np.uint8)


def fused_library() -> FusedLibrary:
    """The library, compiled once per machine and then taken from the cache.

    Raises:
        BuildError: no compiler, or it refused.
    """
    return _loaded(tuple(os.environ.get(name, "") for name in _DECISIVE))


@lru_cache(maxsize=4)
def _loaded(environment: tuple[str, ...]) -> FusedLibrary:
    """For variables of these values."""
    folder = resource_dir("csrc")
    texts = {name: (folder / name).read_text("utf-8") for name in _SOURCES}
    texts |= {name: (folder / "include" / name).read_text("utf-8") for name in _HEADERS}
    return FusedLibrary(build_library(texts))
