"""Rows of logs as they would be with other channels: turned, in other units, at other times."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.sparse import block_diag, csr_array, diags_array

from modeler.core.brief import ShortRepr
from modeler.numerics.filters import restrict_weights
from modeler.regression.low_speed import compute_signals
from modeler.regression.motion import Segment
from modeler.regression.observation import Observation
from modeler.regression.prepare import find_nearest_closed
from modeler.regression.reduce import evaluate_columns_at
from modeler.runtime import CompiledModel

MOST = 400
"""Rows: enough for any fit, and quick with every motion that is tried."""

_CELLS = 8000  # joints times rows, at most: many joints make many pairs to exchange
_CLOCKS = (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)  # are off by
_TAPS = 16  # samples of each row, of the many over which the parallel filter takes its mean


@dataclass(frozen=True)
class DataWarning(ShortRepr):
    """Why a log, or a fit to it, may not be what it looks like.

    Attributes:
        line: where and what; after the last semicolon what to do.
        certain: True if no physics can look like it: then the model is not valid, and nothing can
            be said of physics.
        values: True if it leaves the prediction of torques of like motion untouched, and only the
            values of parameters are in doubt.
        joint: index of the joint whose torque has another scale; -1 for other doubts.
        unseen: True if it is no doubt, but tells which faults these logs would not show.
        about: names of the joints that it is about; empty: the whole robot.
    """

    line: str
    is_certain: bool = False
    affects_values: bool = False
    joint: int = -1
    is_undetectable: bool = False
    joints: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class ThinnedRows:
    """Some rows of an observation, and some of the samples that those reach, of all stretches.

    Attributes:
        W: (m, n, c).
        tau: (m, n).
        used: (m, n) that count.
        means: by joint, (m, samples) weights of the samples in each row; they sum to one.
        samples: by stretch, its segment and places in it.
        read: (samples, k) other inputs of the model; None without any.
    """

    W: np.ndarray
    tau: np.ndarray
    used: np.ndarray
    means: tuple[csr_array, ...]
    samples: tuple[tuple[Segment, np.ndarray], ...]
    read: np.ndarray | None

    @property
    def motion(self) -> np.ndarray:
        """(3, samples, n) q, qd, qdd."""
        every = [np.stack([s.q[k], s.qd[k], s.qdd[k]]) for s, k in self.samples]
        return np.concatenate(every, axis=1)

    def filter_values(self, values: np.ndarray) -> np.ndarray:
        """(m, n, k) rows of what the samples have, (samples, n, k)."""
        return np.stack([mean @ values[:, j] for j, mean in enumerate(self.means)], axis=1)

    def transform_columns(self, compiled: CompiledModel, turn: "MotionTransform") -> np.ndarray:
        """(m, n, c) columns of the motion with other positions, or by another clock."""
        q, qd, qdd = self.motion @ turn.motion
        moved = q + turn.offset, turn.speed * qd, turn.speed**2 * qdd
        return self._filter_function(compiled, compiled.base_regressor, *moved)

    def shift_columns(
        self, compiled: CompiledModel, shift: np.ndarray, beta: np.ndarray | None = None
    ) -> np.ndarray:
        """(m, n, c) columns of the motion of each joint, shift (n,) s later.

        With parameters beta (c,) their torques, (m, n).
        """
        motions = []
        for s, k in self.samples:
            place = (s.time[k, None] + shift - s.time[0]) / s.step
            below = np.clip(place.astype(int), 0, s.samples - 2)
            above = np.clip(place - below, 0.0, 1.0)
            joint = np.arange(len(shift))
            motions.append(np.stack([
                x[below, joint] * (1.0 - above) + x[below + 1, joint] * above
                for x in (s.q, s.qd, s.qdd)
            ]))  # fmt: skip
        of = compiled.base_regressor if beta is None else partial(_compute_torque, compiled, beta)
        return self._filter_function(compiled, of, *np.concatenate(motions, axis=1))

    def _filter_function(
        self, compiled: CompiledModel, of: Callable[..., np.ndarray],
        q: np.ndarray, qd: np.ndarray, qdd: np.ndarray,
    ) -> np.ndarray:  # fmt: skip
        """(m, n, ...) filtered values of a function of a motion of the samples."""
        nearest = find_nearest_closed(
            compiled, q
        )  # a motion that was changed may leave what closes
        if nearest is not None:
            q = np.ascontiguousarray(q[nearest])
        values = of(q, qd, qdd, self.read)
        out = np.zeros((self.means[0].shape[0], *values.shape[1:]))
        spans = compiled.pattern.spans
        for j, mean in enumerate(self.means):
            index = (slice(None), j, spans[j]) if values.ndim == 3 else (slice(None), j)
            out[index] = mean @ values[index]
        return out


def _compute_torque(
    compiled: CompiledModel, beta: np.ndarray, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray,
    read: np.ndarray | None,
) -> np.ndarray:  # fmt: skip
    return compiled.inverse_dynamics(q, qd, qdd, beta, read)


def thin_rows(compiled: CompiledModel, observation: Observation) -> ThinnedRows:
    """At most so many of the rows of the observation, evenly; fewer of many joints."""
    most = max(1, min(MOST, _CELLS // len(observation.joints)))
    every = max(1, -(-len(observation.time) // most))
    means: list[list[csr_array]] = [[] for _ in observation.joints]
    samples, read, chosen, at = [], [], [], 0
    for part in observation.stretches:
        rows = np.arange(-at % every, len(part.used), every)
        chosen.append(at + rows)
        at += len(part.used)
        if not rows.size:
            continue
        weights = part.rows.weights[rows]
        width = max(1, int(np.max(np.diff(weights.indptr))))
        reached = np.unique(weights.indices)
        reached = reached[reached % max(1, width // _TAPS) == 0]
        weights = weights[:, reached]
        for joint_means, usable in zip(means, part.usable[reached].T, strict=True):
            masked = restrict_weights(weights, usable)
            total = masked.sum(axis=1)
            joint_means.append(diags_array(1.0 / np.where(total > 0.0, total, 1.0)) @ masked)
        samples.append((part.segment, reached))
        signals = compute_signals(compiled, part.segment)
        read += [] if signals is None else [signals[reached]]
    place = np.concatenate(chosen)
    return ThinnedRows(
        W=evaluate_columns_at(observation, place),
        tau=observation.torque[place],
        used=observation.used[place],
        means=tuple(block_diag(joint_means, format="csr") for joint_means in means),
        samples=tuple(samples),
        read=np.concatenate(read) if read else None,
    )


@dataclass(frozen=True)
class MotionTransform:
    """What may be wrong with positions, or with the clock, and what mends it.

    Attributes:
        line: what, and what to do.
        motion: (J, J) q = measured q motion + offset, and its derivatives alike.
        offset: (J,) rad or m.
        torque: (J,) tau_j = measured tau[torque[j]].
        speed: times that of the log.
    """

    line: str
    motion: np.ndarray
    offset: np.ndarray
    torque: np.ndarray
    speed: float = 1.0


def propose_clocks(observation: Observation) -> Iterator[MotionTransform]:
    """All motion faster or slower than it is logged."""
    same = np.eye(len(observation.joints))
    for speed in _CLOCKS:
        line = (
            f"the clock seems to be wrong: with all motion {speed:g} times as fast, torques are "
            "those of a machine; check the time column, its unit and rate"
        )
        yield MotionTransform(line, same, np.zeros(len(same)), np.arange(len(same)), speed)


def propose_zero(observation: Observation, j: int, degrees: int) -> MotionTransform:
    """Positions of a joint that turns, counted from another zero."""
    line = (
        f"joint {observation.joints[j].name}: its zero seems to be off by {degrees} degrees, by "
        "gravity and the other joints; check the zero of that encoder against the table"
    )
    same = np.eye(len(observation.joints))
    return MotionTransform(line, same, -np.deg2rad(degrees) * same[j], np.arange(len(same)))


def propose_transforms(
    observation: Observation, zeros_only: bool = False
) -> Iterator[MotionTransform]:
    """Positions from another zero; in other units, reversed, exchanged, or with the torques too."""
    for j, joint in enumerate(observation.joints):
        for degrees in (90, -90, 180) if joint.unit == "rad" else ():
            yield propose_zero(observation, j, degrees)
    if zeros_only:
        return
    joints, names = observation.joints, [joint.name for joint in observation.joints]
    same, none = np.arange(len(joints)), np.zeros(len(joints))
    expected = "expected rad and m; convert the position, and the speeds if they are logged"
    for rad, metre in ((("degrees", np.pi / 180.0), ("mm", 1e-3)),
                       (("turns", 2.0 * np.pi), ("cm", 1e-2))):  # fmt: skip
        units = [rad if joint.unit == "rad" else metre for joint in joints]
        factors = np.array([factor for _, factor in units])
        units_text = " or ".join(dict.fromkeys(unit for unit, _ in units))
        yield MotionTransform(
            f"the positions look like {units_text}; {expected}", np.diag(factors), none, same
        )
        for j, (unit, factor) in enumerate(units):
            line = f"joint {names[j]}: its position looks like {unit}; {expected}"
            yield MotionTransform(line, np.diag(np.where(same == j, factor, 1.0)), none, same)
    for j in range(len(joints)):
        line = f"joint {names[j]}: its position seems to be counted the other way; check its sign"
        yield MotionTransform(line, np.diag(np.where(same == j, -1.0, 1.0)), none, same)
        for k in range(j):
            order = same.copy()
            order[[j, k]] = order[[k, j]]
            swap = np.eye(len(joints))[order]
            for what, torque in (("positions", same), ("columns, torques too,", order)):
                line = (
                    f"joints {names[k]} and {names[j]}: their {what} look exchanged; check the "
                    "order of the columns"
                )
                yield MotionTransform(line, swap, none, torque)
