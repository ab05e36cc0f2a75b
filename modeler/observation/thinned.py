"""Some rows of an observation, whose columns can be built anew of a motion that was changed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.numerics.filters import RowFilter
from modeler.observation.low_speed import signals_of
from modeler.observation.motion import Segment
from modeler.observation.observation import Observation
from modeler.observation.prepare import nearest_closed
from modeler.observation.reduce import columns_at
from modeler.observation.stretch import Stretch
from modeler.runtime.model import CompiledModel

_MOST = 1200  # rows: enough for any fit, and quick with every change that is tried
_CELLS = 8000  # joints times rows, at most: many joints make many pairs to exchange
_TAPS = 16  # samples of each row, of the many over which the parallel filter takes its mean


@dataclass(frozen=True, eq=False)
class ThinnedPart:
    """A stretch with some of its rows, and some of the samples that those reach."""

    segment: Segment
    samples: np.ndarray
    rows: RowFilter
    usable: np.ndarray
    used: np.ndarray
    read: np.ndarray | None

    def motion(self) -> tuple[np.ndarray, ...]:
        """q, qd, qdd of the samples."""
        s = self.segment
        return s.q[self.samples], s.qd[self.samples], s.qdd[self.samples]

    def means(self, values: np.ndarray, j: int) -> np.ndarray:
        """(m, ...) of values (samples, ...) of a joint, through the filter of its rows."""
        whole = self.segment.whole[self.samples]
        return self.rows.means(values, self.usable[:, j], self.used[:, j], whole)

    def columns(self, compiled: CompiledModel, motion: Sequence[np.ndarray]) -> np.ndarray:
        """(m, n, c) filtered columns of a motion q, qd, qdd of the samples."""
        q, qd, qdd = motion
        nearest = nearest_closed(compiled, q)  # a motion that was changed may leave what closes
        if nearest is not None:
            q = np.ascontiguousarray(q[nearest])
        values = compiled.base_regressor(q, qd, qdd, self.read)
        return np.stack([self.means(own, j) for j, own in enumerate(values.swapaxes(0, 1))], axis=1)


@dataclass(frozen=True, eq=False)
class ThinnedRows:
    """Some rows of an observation.

    Attributes:
        W: (m, n, c).
        tau: (m, n).
        used: (m, n) that count.
        speed: (m, n).
        parts: to build W anew of a motion that was changed.
    """

    W: np.ndarray
    tau: np.ndarray
    used: np.ndarray
    speed: np.ndarray
    parts: tuple[ThinnedPart, ...]

    def turned(self, compiled: CompiledModel, turn: np.ndarray) -> np.ndarray:
        """(m, n, c) columns of the motion q turn."""
        return np.concatenate(
            [part.columns(compiled, [x @ turn for x in part.motion()]) for part in self.parts]
        )

    def shifted(self, compiled: CompiledModel, shift: np.ndarray) -> np.ndarray:
        """(m, n, c) columns of the motion of each joint, shift (n,) s later."""
        found = []
        for part in self.parts:
            s = part.segment
            at = (s.time[part.samples][:, None] + shift).T
            motion = [
                np.column_stack([np.interp(t, s.time, own) for t, own in zip(at, x.T, strict=True)])
                for x in (s.q, s.qd, s.qdd)
            ]
            found.append(part.columns(compiled, motion))
        return np.concatenate(found)


def thinned(compiled: CompiledModel, observation: Observation) -> ThinnedRows:
    """At most 1200 of the rows of the observation, evenly; fewer of many joints."""
    most = max(1, min(_MOST, _CELLS // len(observation.joints)))
    every = max(1, -(-len(observation.time) // most))
    parts, chosen, at = [], [], 0
    for part in observation.stretches:
        rows = np.arange(-at % every, len(part.used), every)
        chosen.append(at + rows)
        at += len(part.used)
        if rows.size:
            parts.append(_part(compiled, part, rows))
    place = np.concatenate(chosen)
    return ThinnedRows(
        W=columns_at(observation, place),
        tau=observation.torque[place],
        used=observation.used[place],
        speed=observation.qd[place],
        parts=tuple(parts),
    )


def _part(compiled: CompiledModel, part: Stretch, rows: np.ndarray) -> ThinnedPart:
    weights = part.rows.weights[rows]
    width = max(1, int(np.max(np.diff(weights.indptr))))
    reached = np.unique(weights.indices)
    samples = reached[reached % max(1, width // _TAPS) == 0]
    read = signals_of(compiled.spec, part.segment)
    return ThinnedPart(
        segment=part.segment,
        samples=samples,
        rows=RowFilter(weights[:, samples], part.rows.centres[rows]),
        usable=part.usable[samples],
        used=part.used[rows],
        read=None if read is None else read[samples],
    )
