"""A lower bound of the rank of the torques, proven in ball arithmetic.

At closed states in balls (`modeler.derivation.enclosed`) some rows of the torque regressor of the
base columns make a square matrix; if it is regular for all numbers in its balls, these columns are
independent. States are chosen in floating point and are written into the proof with few digits:
whoever checks it needs nothing else.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from modeler.derivation.closed_states import closing_of
from modeler.derivation.enclosed import Enclosures, NotEnclosed
from modeler.derivation.model import SymbolicModel
from modeler.derivation.numeric_rank import Sample, States, carried, regressor_values, signal_values
from modeler.derivation.precise import (
    BallFunction,
    exact_ball,
    flint,
    proven_regular,
    surely_zero,
    symbol_balls,
)
from modeler.derivation.result import BallRank, ExactState, SampledRank

_BITS = (128, 256, 512)
_DIGITS = 6
"""Decimals of rad or m of the postures."""
_SPARE = 4
_EIGHTHS = 16
"""Speeds and accelerations are up to so many eighths."""


def ball_rank(
    model: SymbolicModel, kept: Sequence[int], sample: Sample, seed: int
) -> BallRank | SampledRank:
    """The proof that the columns `kept` are independent, or why there is none.

    Args:
        model: of the robot, at its given lengths and angles.
        kept: numbers of columns.
        sample: whose closed postures are used.
        seed: of the states.
    """
    over = model.closure.others if model.closure else ()
    count = sum(not surely_zero(equation, model.robot) for equation in over)
    if count:
        why = f"{count} closure equations seem to follow from the others, unproven"
        return SampledRank(len(kept), seed, why)
    choice = _Choice(model, kept, sample, seed)
    if len(choice.rows) < len(kept):
        why = f"the states tried span {len(choice.rows)} of {len(kept)} columns"
        return SampledRank(len(kept), seed, why)
    for bits in _BITS:
        with flint().ctx.workprec(bits):
            try:
                matrix = choice.matrix()
            except NotEnclosed as error:
                why = str(error)
                continue
            if proven_regular(matrix):
                return BallRank(len(kept), bits, seed, choice.exact_states(), choice.places())
            why = f"the balls of a minor of {len(kept)} rows hold a singular matrix"
    return SampledRank(len(kept), seed, f"{why} ({_BITS[-1]} bits)")


class _Choice:
    """Rows of the regressor at exact states that are as independent as can be."""

    def __init__(
        self, model: SymbolicModel, kept: Sequence[int], sample: Sample, seed: int
    ) -> None:
        self.model, self.kept = model, list(kept)
        self.closure = model.closure
        rng = np.random.default_rng(seed)
        width = len(model.robot.coordinates)
        count = _SPARE + -(-3 * len(kept) // (2 * max(1, width)))
        self.u = self._postures(sample, count, rng)
        shape = (2, len(self.u), width)
        self.qd, self.qdd = rng.integers(1, _EIGHTHS + 1, shape) * rng.choice([-1, 1], shape) / 8
        self.signals = signal_values(model, len(self.u))
        phi = regressor_values(model, self._states())[:, :, self.kept]
        self.rows, self.scale = _independent_rows(phi.reshape(-1, len(self.kept)))
        self.width = phi.shape[1]

    def _postures(self, sample: Sample, count: int, rng: np.random.Generator) -> np.ndarray:
        """(n, len(u)) exact in the actuated joints, closed in floating point."""
        if sample.walk is None:
            angular = np.array([joint.angular for joint in self.model.robot.free])
            reach = np.where(angular, np.pi, 1.0)
            drawn = rng.uniform(-reach, reach, (count, len(reach)))
            return np.asarray(np.round(drawn, _DIGITS))
        u = closing_of(self.model).closed(np.round(sample.walk.postures[:count], _DIGITS))
        return np.asarray(u[np.all(np.isfinite(u), axis=1)])

    def _states(self) -> States:
        if self.closure is None:
            return self.u, self.qd, self.qdd
        return carried(self.model, self.u, self.qd, self.qdd)

    @property
    def used(self) -> list[int]:
        """Numbers of the states whose rows are chosen."""
        return sorted({row // self.width for row in self.rows})

    def places(self) -> tuple[tuple[int, str], ...]:
        """(number among the used states, joint) of every row."""
        order = {state: place for place, state in enumerate(self.used)}
        names = [joint.name for joint in self.model.robot.coordinates]
        return tuple((order[row // self.width], names[row % self.width]) for row in self.rows)

    def exact_states(self) -> tuple[ExactState, ...]:
        """The states whose rows are chosen."""
        free = [joint.name for joint in self.model.robot.free]
        names = [joint.name for joint in self.model.robot.coordinates]
        return tuple(
            ExactState(
                dict(zip(free, np.round(self.u[i], _DIGITS).tolist(), strict=True)),
                dict(zip(names, self.qd[i].tolist(), strict=True)),
                dict(zip(names, self.qdd[i].tolist(), strict=True)),
                tuple(self.signals[:, i].tolist()),
            )
            for i in self.used
        )

    def matrix(self) -> list[list[Any]]:
        """The chosen rows in balls, columns scaled.

        Raises:
            NotEnclosed: a posture is not proven to exist.
        """
        model = self.model
        symbols = symbol_balls(model.robot)
        enclosures = Enclosures(model, symbols)
        place = {column: i for i, column in enumerate(self.kept)}
        entries = {at: x for at, x in model.regressor.items() if at[1] in place}
        regressor = BallFunction(model.graph, list(entries.values()), symbols)
        found = {}
        for i in self.used:
            state = enclosures.state(self.u[i], self.qd[i], self.qdd[i])
            signals = {f"s[{k}]": exact_ball(float(x)) for k, x in enumerate(self.signals[:, i])}
            values = regressor({**state.inputs, **signals})
            for k in range(self.width):
                row = [exact_ball(0)] * len(place)
                for (joint, column), value in zip(entries, values, strict=True):
                    row[place[column]] += state.coupling[joint][k] * value
                found[i * self.width + k] = row
        scale = [exact_ball(float(x)) for x in self.scale]
        return [[x * y for x, y in zip(found[row], scale, strict=True)] for row in self.rows]


def _independent_rows(matrix: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Rows, each the longest of what those before leave, and the factors of the columns."""
    lengths = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / np.where(lengths > 0.0, lengths, 1.0)
    rest = matrix * scale
    sizes = np.linalg.norm(rest, axis=1)
    rest = rest / np.where(sizes > 0.0, sizes, 1.0)[:, None]
    rows: list[int] = []
    for _ in range(matrix.shape[1]):
        left = np.linalg.norm(rest, axis=1)
        best = int(np.argmax(left))
        if left[best] == 0.0:
            break
        rows.append(best)
        direction = rest[best] / left[best]
        rest -= np.outer(rest @ direction, direction)
    return rows, scale
