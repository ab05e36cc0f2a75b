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

import numpy as np

from modeler.derivation.closed_states import closing_of
from modeler.derivation.model import SymbolicModel
from modeler.derivation.precise import Ball, BallFunction, exact_ball, flint

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
                BallFunction(model.graph, found, symbols) for found in functions
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
        Y = _matrix(_inverse(closing_of(self.model).jacobians(u[None])[0][:, solved]))
        q = self._settled(_exact(u), Y)
        if not all(abs(q[k] - float(u[k])) < _NEAR for k in solved):
            raise NotEnclosed(f"the loops do not close within {_NEAR:g} of a posture")
        radius = exact_ball(2.0 ** -(self.bits // 2))
        wide = _with(q, solved, [q[k] + flint().arb(0, radius) for k in solved])
        step = Y * _column(self.equations(_inputs(q=q)))
        rest = _matrix(np.eye(len(solved)).tolist()) - Y * self._inner(wide)
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

    def _inner(self, q: Sequence[Ball]) -> Ball:
        assert self.closure is not None
        return self._slopes(q, self.closure.solved)

    def _slopes(self, q: Sequence[Ball], places: Sequence[int]) -> Ball:
        """The columns of the Jacobian that `places` names, at a box."""
        flat, n = self.slopes(_inputs(q=q)), len(q)
        return _matrix([[flat[i + k] for k in places] for i in range(0, len(flat), n)])

    def _moved(self, q: list[Ball], qd: list[Ball], qdd: list[Ball]) -> EnclosedState:
        assert self.closure is not None
        given, solved = list(self.closure.given), list(self.closure.solved)
        try:
            follow = -self._inner(q).solve(self._slopes(q, given))
            G = [[exact_ball(0)] * len(given) for _ in q]
            for place, k in enumerate(given):
                G[k][place] = exact_ball(1)
            for place, k in enumerate(solved):
                G[k] = [follow[place, i] for i in range(len(given))]
            ud, udd = _times(G, qd), _times(G, qdd)
            drift = self._inner(q).solve(_column(self.drift(_inputs(q=q, qd=ud))))
        except ZeroDivisionError:
            raise NotEnclosed("the loops may be singular at a posture") from None
        for place, k in enumerate(solved):
            udd[k] = udd[k] - drift[place, 0]
        return EnclosedState(_inputs(q=q, qd=ud, qdd=udd), G)


def _inverse(matrix: np.ndarray) -> list[list[float]]:
    try:
        found: list[list[float]] = np.linalg.inv(matrix).tolist()
    except np.linalg.LinAlgError:
        raise NotEnclosed("the loops are singular at a posture") from None
    return found


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
