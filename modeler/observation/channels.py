"""Rows of logs as they would be with other channels: turned, in other units, at other times."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.numerics.filters import RowFilter
from modeler.observation.low_speed import signals_of
from modeler.observation.motion import Segment
from modeler.observation.observation import Observation
from modeler.observation.prepare import nearest_closed
from modeler.observation.reduce import columns_at
from modeler.observation.stretch import Stretch
from modeler.runtime import CompiledModel

MOST = 1200
"""Rows: enough for any fit, and quick with every change that is tried."""

_CELLS = 8000  # joints times rows, at most: many joints make many pairs to exchange
_TAPS = 16  # samples of each row, of the many over which the parallel filter takes its mean


@dataclass(frozen=True)
class Fault:
    """A doubt about a log.

    Attributes:
        line: where, what, and what to do.
        certain: True if no physics can look like it: then nothing can be said of physics.
        joint: index of the joint whose torque has another scale; -1 for other doubts.
        unseen: True if it is no doubt, but tells which faults these logs would not show.
    """

    line: str
    certain: bool
    joint: int = -1
    unseen: bool = False


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
        parts: to build W anew of a motion that was changed.
    """

    W: np.ndarray
    tau: np.ndarray
    used: np.ndarray
    parts: tuple[ThinnedPart, ...]

    def turned(self, compiled: CompiledModel, turn: "Turn") -> np.ndarray:
        """(m, n, c) columns of the motion with other positions."""
        found = []
        for part in self.parts:
            q, qd, qdd = (x @ turn.motion for x in part.motion())
            found.append(part.columns(compiled, [q + turn.offset, qd, qdd]))
        return np.concatenate(found)

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


def thinned(compiled: CompiledModel, observation: Observation, most: int = MOST) -> ThinnedRows:
    """At most so many of the rows of the observation, evenly; fewer of many joints."""
    most = max(1, min(most, _CELLS // len(observation.joints)))
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


@dataclass(frozen=True)
class Turn:
    """What may be wrong with positions, and what mends it.

    Attributes:
        line: what, and what to do.
        motion: (J, J) q = measured q motion + offset, and its derivatives alike.
        offset: (J,) rad or m.
        torque: (J,) tau_j = measured tau[torque[j]].
    """

    line: str
    motion: np.ndarray
    offset: np.ndarray
    torque: np.ndarray


def zeros(observation: Observation, degrees: Sequence[int] = (90, -90, 180)) -> Iterator[Turn]:
    """Positions of joints that turn, counted from another zero."""
    joints = observation.joints
    for j, joint in enumerate(joints):
        for angle in degrees if joint.unit == "rad" else ():
            line = (
                f"joint {joint.name}: its zero seems to be off by {angle} degrees, by gravity and "
                "the other joints; check the zero of that encoder against the table"
            )
            offset = -np.deg2rad(angle) * np.eye(len(joints))[j]
            yield Turn(line, np.eye(len(joints)), offset, np.arange(len(joints)))


def turns(observation: Observation) -> Iterator[Turn]:
    """Positions in other units, reversed, exchanged, and exchanged together with the torques."""
    joints, names = observation.joints, [joint.name for joint in observation.joints]
    same, none = np.arange(len(joints)), np.zeros(len(joints))
    expected = "expected rad and m; convert the position, and the speeds if they are logged"
    for rad, metre in ((("degrees", np.pi / 180.0), ("mm", 1e-3)),
                       (("turns", 2.0 * np.pi), ("cm", 1e-2))):  # fmt: skip
        units = [rad if joint.unit == "rad" else metre for joint in joints]
        factors = np.array([factor for _, factor in units])
        told = " or ".join(dict.fromkeys(unit for unit, _ in units))
        yield Turn(f"the positions look like {told}; {expected}", np.diag(factors), none, same)
        for j, (unit, factor) in enumerate(units):
            line = f"joint {names[j]}: its position looks like {unit}; {expected}"
            yield Turn(line, np.diag(np.where(same == j, factor, 1.0)), none, same)
    for j in range(len(joints)):
        line = f"joint {names[j]}: its position seems to be counted the other way; check its sign"
        yield Turn(line, np.diag(np.where(same == j, -1.0, 1.0)), none, same)
        for k in range(j):
            order = same.copy()
            order[[j, k]] = order[[k, j]]
            swap = np.eye(len(joints))[order]
            for what, torque in (("positions", same), ("columns, torques too,", order)):
                line = (
                    f"joints {names[k]} and {names[j]}: their {what} look exchanged; check the "
                    "order of the columns"
                )
                yield Turn(line, swap, none, torque)
