"""Closed states in ball arithmetic: postures that exist for certain, and motions of the loops.

The actuated joints of a posture are exact numbers. That the passive joints x can close the loops
f(x) = 0 there is Krawczyk's theorem: with x0 near the solution, any matrix Y and a box X around x0,

    K = x0 - Y f(x0) + (1 - Y f'(X)) (X - x0),

if K lies in the interior of X, there is one solution in X, and it lies in K (Krawczyk 1969;
Neumaier 1990, 5.1). Y is the inverse of f'(x0) in floating point. Speeds and accelerations follow
by solving the linear equations of `modeler.derivation.closure` in balls.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from modeler.derivation.closure import spanning_rows
from modeler.derivation.model import SymbolicModel
from modeler.derivation.numeric_rank import Sample, States, carried, regressor_values, signal_values
from modeler.derivation.precise import (
    Ball,
    ball_function,
    exact_ball,
    flint,
    proven_regular,
    surely_zero,
    symbol_balls,
)
from modeler.derivation.result import BallRank, ExactState, SampledRank

_STEPS = 40
_NEAR = 1e-6
"""Largest distance of a passive joint to where it was said to be, rad or m."""


@dataclass(frozen=True)
class EnclosedState:
    """Balls of a state of the free variables u.

    Attributes:
        inputs: positions, speeds and accelerations by name, as `q[0]`, `qd[0]`, `qdd[0]`.
        coupling: G of ud = G qd, (len(u), len(q)).
    """

    inputs: Mapping[str, Ball]
    coupling: Sequence[Sequence[Ball]]


class NotEnclosed(Exception):
    """No closed posture is proven near a posture; says why."""


class Enclosures:
    """States of a model in balls, at the precision of the caller."""

    def __init__(
        self,
        model: SymbolicModel,
        symbols: Mapping[str, Ball],
        given: tuple[int, ...] | None = None,
    ) -> None:
        """For a model, with or without loops.

        Args:
            model: of the robot.
            symbols: balls of its symbols.
            given: places in u of the variables that move the loops; None for the coordinates q.
        """
        self.model, self.closure = model, model.closure
        self.symbols = symbols
        self.bits = int(flint().ctx.prec)
        if self.closure is not None:
            if given is not None:
                solved = tuple(k for k in range(len(self.closure.home)) if k not in given)
                self.closure = replace(self.closure, given=given, solved=solved)
            slopes = [entry for line in self.closure.jacobian for entry in line]
            closure = self.closure
            functions = (closure.equations, slopes, closure.drift, closure.alignments)
            self.equations, self.slopes, self.drift, self.alignments = (
                ball_function(model.graph, found, symbols) for found in functions
            )

    def state(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> EnclosedState:
        """The motion of all free variables.

        Args:
            u: (len(u),) a posture closed in floating point; its actuated joints are exact.
            qd: (len(q),) speeds of the coordinates, exact.
            qdd: (len(q),) their accelerations, exact.

        Raises:
            NotEnclosed: there may be no closed posture at these u.
        """
        if self.closure is None:
            n = len(u)
            unit = [[exact_ball(int(i == k)) for k in range(n)] for i in range(n)]
            return EnclosedState(_inputs(q=_exact(u), qd=_exact(qd), qdd=_exact(qdd)), unit)
        q = self.posture(u)
        return self._moved(q, _exact(qd), _exact(qdd))

    def posture(self, u: np.ndarray) -> list[Ball]:
        """Balls of the closed posture next to `u` that has the same actuated joints.

        Raises:
            NotEnclosed: there may be none.
        """
        assert self.closure is not None
        solved = list(self.closure.solved)
        try:
            inner = self.closure.jacobians(u[None])[0][:, solved]
            Y = _matrix(np.linalg.inv(inner).tolist())
        except np.linalg.LinAlgError:
            raise NotEnclosed("the loops are singular at a posture") from None
        q = self._settled(_exact(u), Y)
        if not all(abs(q[k] - float(u[k])) < _NEAR for k in solved):
            raise NotEnclosed(f"the loops do not close within {_NEAR:g} of a posture")
        radius = exact_ball(2.0 ** -(self.bits // 2))
        wide = _with(q, solved, [q[k] + flint().arb(0, radius) for k in solved])
        step = Y * _column(self.equations(_inputs(q=q)))
        rest = _matrix(np.eye(len(solved)).tolist()) - Y * self._slopes(wide, solved)
        turned = rest * _column([wide[k] - q[k] for k in solved])
        image = [q[k] - step[i, 0] + turned[i, 0] for i, k in enumerate(solved)]
        if not all(wide[k].contains_interior(x) for k, x in zip(solved, image, strict=True)):
            raise NotEnclosed("the box of a posture is not mapped into itself")
        q = _with(q, solved, image)
        if not all(x > 0 for x in self.alignments(_inputs(q=q))):
            raise NotEnclosed("a loop may be closed with axes opposite")
        return q

    def _settled(self, q: list[Ball], Y: Ball) -> list[Ball]:
        """Newton with the same slope all the way, on the midpoints."""
        assert self.closure is not None
        solved = list(self.closure.solved)
        enough = exact_ball(2.0 ** -(self.bits * 3 // 4))
        for _ in range(_STEPS):
            step = (Y * _column(self.equations(_inputs(q=q)))).mid()
            q = _with(q, solved, [(q[k] - step[i, 0]).mid() for i, k in enumerate(solved)])
            if all(abs(x) < enough for x in step.entries()):
                return q
        raise NotEnclosed("the loops do not close at a posture")

    def _slopes(self, q: Sequence[Ball], places: Sequence[int]) -> Ball:
        """The columns of the Jacobian that `places` names, at a box."""
        flat, n = self.slopes(_inputs(q=q)), len(q)
        return _matrix([[flat[i + k] for k in places] for i in range(0, len(flat), n)])

    def _moved(self, q: list[Ball], qd: list[Ball], qdd: list[Ball]) -> EnclosedState:
        assert self.closure is not None
        given, solved = list(self.closure.given), list(self.closure.solved)
        try:
            inner = self._slopes(q, solved)
            follow = -inner.solve(self._slopes(q, given))
            G = [[exact_ball(0)] * len(given) for _ in q]
            for place, k in enumerate(given):
                G[k][place] = exact_ball(1)
            for place, k in enumerate(solved):
                G[k] = [follow[place, i] for i in range(len(given))]
            ud, udd = _times(G, qd), _times(G, qdd)
            drift = inner.solve(_column(self.drift(_inputs(q=q, qd=ud))))
        except ZeroDivisionError:
            raise NotEnclosed("the loops may be singular at a posture") from None
        for place, k in enumerate(solved):
            udd[k] = udd[k] - drift[place, 0]
        return EnclosedState(_inputs(q=q, qd=ud, qdd=udd), G)


def _exact(values: np.ndarray) -> list[Ball]:
    return [exact_ball(float(value)) for value in values]


def _inputs(**kinds: Sequence[Ball]) -> dict[str, Ball]:
    return {f"{kind}[{k}]": x for kind, values in kinds.items() for k, x in enumerate(values)}


def _with(q: Sequence[Ball], places: Sequence[int], values: Sequence[Ball]) -> list[Ball]:
    changed = list(q)
    for k, value in zip(places, values, strict=True):
        changed[k] = value
    return changed


def _matrix(rows: Sequence[Sequence[Ball]]) -> Ball:
    return flint().arb_mat(rows)


def _column(values: Sequence[Ball]) -> Ball:
    return flint().arb_mat([[value] for value in values])


def _times(matrix: Sequence[Sequence[Ball]], vector: Sequence[Ball]) -> list[Ball]:
    return [
        sum((x * y for x, y in zip(line, vector, strict=True)), exact_ball(0)) for line in matrix
    ]


# A lower bound of the rank of the torques, proven in ball arithmetic.
#
# At closed states in balls some rows of the torque regressor of the base columns make a square
# matrix; if it is regular for all numbers in its balls, these columns are independent. States are
# chosen in floating point and are written into the proof with few digits: whoever checks it needs
# nothing else.


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
                matrix = choice.matrix(choice.kept)
            except NotEnclosed as error:
                why = str(error)
                continue
            if proven_regular(matrix):
                return BallRank(len(kept), bits, seed, choice.exact_states(), choice.places())
            why = f"the balls of a minor of {len(kept)} rows hold a singular matrix"
    return SampledRank(len(kept), seed, f"{why} ({_BITS[-1]} bits)")


def enclosed_factors(
    model: SymbolicModel, sample: Sample, seed: int, kept: Sequence[int], dropped: Sequence[int]
) -> list[list[Ball]] | None:
    """(kept, dropped) factors of the columns that depend on the kept ones, as balls.

    Args:
        model: of the robot, at its given lengths and angles.
        sample: whose closed postures are used.
        seed: of the states.
        kept: numbers of independent columns.
        dropped: numbers of columns that are sums of these.

    Returns:
        None where a posture is not proven to exist, or the states do not span the columns.
    """
    choice = _Choice(model, kept, sample, seed)
    if len(choice.rows) < len(kept) or not dropped:
        return None
    with flint().ctx.workprec(_BITS[-1]):
        try:
            rows = flint().arb_mat(choice.matrix([*kept, *dropped])).tolist()
            scaled, right = ([row[part] for row in rows] for part in
                             (slice(None, len(kept)), slice(len(kept), None)))  # fmt: skip
            factors = flint().arb_mat(scaled).solve(flint().arb_mat(right)).tolist()
        except (NotEnclosed, ZeroDivisionError):
            return None
        scale = [exact_ball(float(x)) for x in choice.scale]
        return [[x * by for x in row] for row, by in zip(factors, scale, strict=True)]


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
        states: States = self.u, self.qd, self.qdd
        if self.closure is not None:
            states = carried(model, *states)
        phi = regressor_values(model, states)[:, :, self.kept]
        self.rows, self.scale = _independent_rows(phi.reshape(-1, len(self.kept)))
        self.width = phi.shape[1]

    def _postures(self, sample: Sample, count: int, rng: np.random.Generator) -> np.ndarray:
        """(n, len(u)) exact in the actuated joints, closed in floating point."""
        if sample.walk is None:
            angular = np.array([joint.angular for joint in self.model.robot.free])
            reach = np.where(angular, np.pi, 1.0)
            drawn = rng.uniform(-reach, reach, (count, len(reach)))
            return np.asarray(np.round(drawn, _DIGITS))
        assert self.closure is not None
        u = self.closure.closed(np.round(sample.walk.postures[:count], _DIGITS))
        return np.asarray(u[np.all(np.isfinite(u), axis=1)])

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

    def matrix(self, columns: Sequence[int]) -> list[list[Any]]:
        """The chosen rows of these columns in balls; those of the base columns are scaled.

        Raises:
            NotEnclosed: a posture is not proven to exist.
        """
        model = self.model
        symbols = symbol_balls(model.robot)
        enclosures = Enclosures(model, symbols)
        place = {column: i for i, column in enumerate(columns)}
        entries = {at: x for at, x in model.regressor.items() if at[1] in place}
        regressor = ball_function(model.graph, list(entries.values()), symbols)
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
        known = dict(zip(self.kept, self.scale.tolist(), strict=True))
        scale = [exact_ball(known.get(column, 1.0)) for column in columns]
        return [[x * y for x, y in zip(found[row], scale, strict=True)] for row in self.rows]


def _independent_rows(matrix: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Rows, each the longest of what those before leave, and the factors of the columns."""
    lengths = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / np.where(lengths > 0.0, lengths, 1.0)
    rest = matrix * scale
    sizes = np.linalg.norm(rest, axis=1)
    rest = rest / np.where(sizes > 0.0, sizes, 1.0)[:, None]
    return spanning_rows(rest, matrix.shape[1]), scale
