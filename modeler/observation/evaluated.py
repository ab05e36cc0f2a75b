"""A compiled model over the segments of an observation: its regressor, and what needs none."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.observation.motion import Segment
from modeler.observation.signals import signals_of
from modeler.observation.stretch import Stretch

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel
    from modeler.compiled.fused import Pattern, Triangles


class Evaluated:
    """The base regressor over the samples of a segment, with what its effects read."""

    def __init__(self, model: "CompiledModel", stretches: Sequence[Stretch]) -> None:
        self._model = model
        self._signals = {
            id(part.segment): signals_of(model.spec, part.segment) for part in stretches
        }

    def __call__(self, s: Segment, w: slice | np.ndarray) -> np.ndarray:
        """(b, n, c) for the b samples of a window, or of indices."""
        return self._model.base_regressor(s.q[w], s.qd[w], s.qdd[w], self._read(s, w))

    @property
    def pattern(self) -> "Pattern":
        """Which columns can enter the torque of each joint."""
        return self._model.pattern

    @property
    def multiplies(self) -> bool:
        """True if `products` can be had."""
        return self._model.emits_entries

    def torque(self, s: Segment, w: slice | np.ndarray, beta: np.ndarray) -> np.ndarray:
        """(b, n) torque of the model, by the inverse dynamics; w may be indices."""
        return self._model.inverse_dynamics(s.q[w], s.qd[w], s.qdd[w], beta, self._read(s, w))

    def triangles(self, part: Stretch, use: np.ndarray, state: "Triangles | None") -> "Triangles":
        """Triangles of the rows of a stretch whose rows are samples; use (rows, n) bool."""
        some = np.flatnonzero(use.any(axis=1))
        s, w = part.segment, near(part.rows.centres[some])
        found = self._model.triangles(
            s.q[w], s.qd[w], s.qdd[w], s.tau[w], use[near(some)], self._read(s, w), state=state
        )
        if found.left_out.any():  # the regressor says of which sample, and why
            bad = part.rows.centres[some][found.left_out]
            self._model.base_regressor(s.q[bad], s.qd[bad], s.qdd[bad], self._read(s, bad))
        return found

    def products(self, part: Stretch, use: np.ndarray, last: Sequence[int]) -> list[np.ndarray]:
        """Products of rows 1 .. last_j apart, of a stretch whose rows are samples."""
        s, w = part.segment, near(part.rows.centres)
        return self._model.products(
            s.q[w], s.qd[w], s.qdd[w], s.tau[w], last, use, self._read(s, w), first=1
        )

    def _read(self, s: Segment, w: slice | np.ndarray) -> np.ndarray | None:
        read = self._signals[id(s)]
        return None if read is None else read[w]


def near(places: np.ndarray) -> slice | np.ndarray:
    """The same places as a slice where they are neighbours: no copy."""
    if len(places) and places[-1] - places[0] == len(places) - 1:
        return slice(int(places[0]), int(places[-1]) + 1)
    return places
