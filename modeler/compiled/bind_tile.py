"""The library of tiles, see csrc/modeler_tile.h, made callable; knows cffi.

It is a library of its own, which is compiled when it is first asked for: small work does without.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cffi
import numpy as np

from modeler.compiled.build import build_library
from modeler.core.contract import ModuleSpec
from modeler.core.errors import BuildError, ManifestError

_DECLARED = """
typedef struct {{
    int joints, columns, signals, nonzeros;
    const int *row, *column;
    void *tile;
}} modeler_tiled;
const modeler_tiled *{prefix}_tiled(void);
const char *{prefix}_tile_signature(void);
size_t modeler_tile_work(const modeler_tiled *);
void modeler_tile_observation(const modeler_tiled *, size_t, const double *, const double *,
                              const double *, const double *, double *, void *);
void modeler_tile_nonzeros(const modeler_tiled *, size_t, const double *, const double *,
                           const double *, const double *, double *, void *);
"""


class TileLibrary:
    """A loaded library; its functions release the interpreter lock and may run in threads."""

    def __init__(self, spec: ModuleSpec, path: Path) -> None:
        """Load the library at `path`.

        Raises:
            BuildError: it cannot be loaded.
            ManifestError: it was emitted with another manifest.
        """
        self._ffi = cffi.FFI()
        self._ffi.cdef(_DECLARED.format(prefix=spec.prefix))
        try:
            self._library: Any = self._ffi.dlopen(str(path))
        except OSError as error:
            raise BuildError(
                f"{path}: the compiled library cannot be loaded ({error}); delete it and try again"
            ) from error
        answer = getattr(self._library, f"{spec.prefix}_tile_signature")()
        if (got := self._ffi.string(answer).decode()) != spec.signature():
            raise ManifestError(
                f"{spec.robot}: the code of the tiles answers {got}, the manifest expects "
                f"{spec.signature()}; one of them is older, generate both again"
            )
        self._tiled = getattr(self._library, f"{spec.prefix}_tiled")()

    @property
    def tile(self) -> int:
        """Where the function of one tile stands, for C that calls it; the caller holds this."""
        return int(self._ffi.cast("uintptr_t", self._tiled.tile))

    def fill(self, inputs: Sequence[np.ndarray], out: np.ndarray, dense: bool) -> None:
        """Evaluate samples.

        Args:
            inputs: q, qd, qdd and, with signals, s: (n, ...), C-contiguous.
            out: C-contiguous, n rows: whole regressors if `dense`, else entries.
            dense: with what is always 0.
        """
        pointers = [self._doubles(array) for array in inputs]
        pointers += [self._ffi.NULL] * (4 - len(inputs))
        work = np.empty(self._library.modeler_tile_work(self._tiled), dtype=np.uint8)
        start = self._ffi.cast("void *", work.ctypes.data)
        name = "observation" if dense else "nonzeros"
        function = getattr(self._library, f"modeler_tile_{name}")
        function(self._tiled, len(inputs[0]), *pointers, self._doubles(out), start)

    def _doubles(self, array: np.ndarray) -> Any:
        assert array.flags.c_contiguous and array.dtype == np.float64
        return self._ffi.cast("double *", array.ctypes.data)


def tile_library(spec: ModuleSpec, files: Mapping[str, str]) -> TileLibrary:
    """The library of these files, compiled once and then taken from the cache.

    Raises:
        BuildError: no compiler, or it refused.
        ManifestError: the files belong to another manifest.
    """
    return TileLibrary(spec, build_library({name: files[name] for name in spec.tile_sources}))
