"""Base regressors of many samples, by tiles: eight samples at once, in threads.

What a sample gives depends on nothing but that sample, so neither do results depend on the number
of threads. They are equal to those of the scalar functions but for roundings.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from modeler.compiled.bind import Library
from modeler.compiled.bind_tile import TileLibrary, tile_library
from modeler.compiled.threads import mapped, shares
from modeler.core.contract import FunctionSpec, ModuleSpec
from modeler.core.errors import ManifestError, ShapeError

TILED_FROM = 2**18
"""Samples from which on tiles are used: fewer are sooner done than tiles are compiled."""

_SLICE = 2**14  # samples that a thread is worth starting for


class Tiling:
    """What a compiled model makes of many samples."""

    spec: ModuleSpec
    _library: Library
    _functions: Mapping[str, FunctionSpec]
    _tile_files: Mapping[str, str]

    def nonzeros(
        self, q: Any, qd: Any, qdd: Any, s: Any = None, out: np.ndarray | None = None
    ) -> np.ndarray:
        """The entries of the base regressor that are not always 0, (n, len(spec.nonzeros)).

        values[:, k] = phi[:, joint, column] with (joint, column) = spec.nonzeros[k].

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            s: signals of effects, where there are any.
            out: is filled and returned if given.

        Raises:
            ManifestError: the robot has loops: all its entries can be something else than 0.
        """
        if self.spec.closure is not None:
            raise ManifestError(
                f"{self.spec.robot} has loops: every entry of its regressor can differ from 0; "
                "use base_regressor"
            )
        inputs = self._motion(q, qd, qdd, s)
        shape = (len(inputs[0]), len(self.spec.nonzeros))
        values = np.empty(shape) if out is None else checked_out(out, shape)
        if not self._fill(inputs, values, dense=False):
            self._library.batch(self._functions["base_regressor_nonzeros"], inputs, values)
        return values

    def _fill(self, inputs: Sequence[np.ndarray], out: np.ndarray, dense: bool) -> bool:
        """Fill `out` by tiles; False, and nothing done, for few samples or without tiles."""
        samples = len(inputs[0])
        tiles = self._tiles if samples >= TILED_FROM else None
        if tiles is None:
            return False
        rows = out.reshape(samples, -1)

        def part(piece: slice) -> None:
            tiles.fill([array[piece] for array in inputs], rows[piece], dense)

        for _ in mapped(part, shares(samples, _SLICE)):
            pass
        return True

    def _tile(self, samples: int) -> int:
        """The function of one tile, for so many samples; 0 for few, or without tiles."""
        tiles = self._tiles if samples >= TILED_FROM else None
        return 0 if tiles is None else tiles.tile

    @cached_property
    def _tiles(self) -> TileLibrary | None:
        """The library of tiles; None where there are none: with loops, or in older files."""
        wanted = self.spec.tile_sources
        if not wanted or not all(name in self._tile_files for name in wanted):
            return None
        return tile_library(self.spec, self._tile_files)

    def _motion(self, q: Any, qd: Any, qdd: Any, s: Any) -> tuple[np.ndarray, ...]:
        raise NotImplementedError


def checked_out(out: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """`out`, if it can be filled.

    Raises:
        ShapeError: says what it must be.
    """
    if not isinstance(out, np.ndarray) or out.shape != shape:
        got = out.shape if isinstance(out, np.ndarray) else type(out).__name__
        raise ShapeError(f"out: got {got}, expected an array {shape}")
    if out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
        raise ShapeError(
            f"out: got type {out.dtype}, expected a writeable C-contiguous float64 array; "
            f"make one with np.empty({shape})"
        )
    return out
