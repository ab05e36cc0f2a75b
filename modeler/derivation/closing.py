"""Closing loops in floating point, for many postures at once.

Newton on all equations, redundant ones included, in the sense of least squares; what the emitted C
does with an independent set of them is checked against this.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import LoopError
from modeler.core.rounded import precise
from modeler.derivation.graph import Expr, Graph
from modeler.derivation.precise import decimal, precise_values
from modeler.robot.robot import Robot

SINGULAR = 1e-4
"""Of `Closing.sigma`. Newton's method that ends at a residual of 1e-9 leaves a posture of loops
that only touch wrong by the square root of that: a posture whose value is of this order cannot be
told from a singular one."""

_CLOSED = 1e-12
"""Residual of a closed loop, relative to the robot's size."""
_ZERO = 1e-9
"""Length of a row of the Jacobian that counts as none, over the longest."""
_ITERATIONS = 60
_STEPS = 12
_SEED = 7
_ROWS = 1876  # Reuleaux
_SAMPLES = 32
_STARTS = 200
_PLACES = 6
"""Decimals of rad and m in which two closed postures are told apart."""
_POLISHED = 1e-25
"""Last step of the polishing, in sizes of the robot or rad: far below the digits of a double."""
_POLISHING = 20


@dataclass(frozen=True)
class Closing(Brief):
    """The closure equations as functions of arrays.

    Attributes:
        graph: of the expressions.
        values: of the geometric symbols.
        equations: all, redundant ones included.
        jacobian: their derivatives by u.
        given: places in u of the coordinates q.
        solved: places in u of the others.
        lengths: by u, True for a travel in m.
        size: of the robot, m: the longest way from a frame to the next with all joints at 0.
        alignments: positive where the loops are closed as meant.
        others: equations that follow from `equations` where the loops are closed, but perhaps not
            where these alone hold.
    """

    graph: Graph
    values: Mapping[str, float]
    equations: Sequence[Expr]
    jacobian: Sequence[Sequence[Expr]]
    given: tuple[int, ...]
    solved: tuple[int, ...]
    lengths: tuple[bool, ...]
    size: float
    alignments: Sequence[Expr] = ()
    others: Sequence[Expr] = ()

    @property
    def unknowns(self) -> int:
        """Number of free variables u."""
        return len(self.lengths)

    @property
    def scale(self) -> np.ndarray:
        """By u, what counts as 1: a rad, or `size`."""
        return np.where(self.lengths, self.size, 1.0)

    @cached_property
    def rows(self) -> np.ndarray:
        """(equations,) usual lengths of the rows of the Jacobian.

        Those at a posture would not do: an equation that changes only in second order there, as
        along a stretched chain, makes it singular, however small the row is.
        """
        u = np.random.default_rng(_ROWS).uniform(-np.pi, np.pi, (_SAMPLES, self.unknowns))
        J = self.jacobians(u * self.scale) * self.scale
        length = np.median(np.linalg.norm(J, axis=2), axis=0)
        # An equation that follows from relations is 0 = 0 up to rounding: not to be scaled up.
        return np.where(length > _ZERO * np.max(length, initial=0.0), length, np.inf)

    def residuals(self, u: np.ndarray) -> np.ndarray:
        """(n, equations) of (n, unknowns)."""
        return self.evaluate(self.equations, u)

    def openness(self, u: np.ndarray) -> np.ndarray:
        """(n,) largest residual, that of the other equations included."""
        found = self.evaluate([*self.equations, *self.others], u)
        return np.asarray(np.max(np.abs(found), axis=1, initial=0.0))

    def aligned(self, u: np.ndarray) -> np.ndarray:
        """(n,) True where no loop is closed with axes opposite; NaN postures are not."""
        values = self.evaluate(self.alignments, u)
        return np.all(np.isfinite(u), axis=1) & np.all(values > 0.0, axis=1)

    def jacobians(self, u: np.ndarray) -> np.ndarray:
        """(n, equations, unknowns)."""
        flat = self.evaluate([entry for line in self.jacobian for entry in line], u)
        return flat.reshape(len(u), len(self.equations), self.unknowns)

    def linearised(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """`residuals`, `openness` and `jacobians` of (n, unknowns), which share most steps."""
        slopes = [entry for line in self.jacobian for entry in line]
        count, every = len(self.equations), len(self.equations) + len(self.others)
        found = self.evaluate([*self.equations, *self.others, *slopes], u)
        openness = np.max(np.abs(found[:, :every]), axis=1, initial=0.0)
        return found[:, :count], openness, found[:, every:].reshape(len(u), count, self.unknowns)

    def scaled_jacobian(self, u: np.ndarray) -> np.ndarray:
        """Jacobians with travels counted in sizes of the robot and rows of usual length 1."""
        return np.asarray(self.jacobians(u) * self.scale / self.rows[:, None])

    def inner(self, u: np.ndarray) -> np.ndarray:
        """(n, equations, solved) columns of `scaled_jacobian` of the joints that follow."""
        return self.scaled_jacobian(u)[:, :, list(self.solved)]

    def sigma(self, u: np.ndarray) -> np.ndarray:
        """(n,) distances to a singularity: smallest singular values of `inner`.

        0 where joints can move with the actuated ones locked.
        """
        return np.asarray(np.linalg.svd(self.inner(u), compute_uv=False)[:, -1])

    def following(self, u: np.ndarray, f: np.ndarray) -> np.ndarray:
        """(n, solved, ...) J_s^-1 f of (n, equations, ...): what of the joints that follow does f.

        For independent equations, as many as joints follow.
        """
        inner = self.jacobians(u)[:, :, list(self.solved)]
        return np.linalg.solve(inner, f.reshape(len(u), len(self.equations), -1)).reshape(f.shape)

    def evaluate(
        self, expressions: Sequence[Expr], u: np.ndarray, ud: np.ndarray | None = None
    ) -> np.ndarray:
        """(n, expressions) at postures, and speeds if they read these, (n, unknowns)."""
        inputs = {f"q[{k}]": u[:, k] for k in range(self.unknowns)}
        if ud is not None:
            inputs |= {f"qd[{k}]": ud[:, k] for k in range(self.unknowns)}
        found = self.graph.evaluate(list(expressions), {**self.values, **inputs})
        out = np.empty((len(u), len(expressions)))
        for i, value in enumerate(found):
            out[:, i] = value
        return out

    def closed(self, u: np.ndarray, solved: Sequence[int] | None = None) -> np.ndarray:
        """Newton from u with the others held; rows that do not close come back as NaN."""
        places = list(self.solved if solved is None else solved)
        u = np.array(u, dtype=float)
        scale = self.scale[places]
        for _ in range(_ITERATIONS):
            f = self.residuals(u)
            if np.all(np.max(np.abs(f), axis=1, initial=0.0) < _CLOSED * self.size):
                break
            J = self.jacobians(u)[:, :, places] * scale
            step = -np.einsum("nij,nj->ni", np.linalg.pinv(J, rcond=1e-12), f)
            longest = np.max(np.abs(step), axis=1, keepdims=True)
            step *= np.minimum(1.0, 0.4 / np.maximum(longest, 1e-300))
            u[:, places] += step * scale
        bad = ~(np.max(np.abs(self.residuals(u)), axis=1, initial=0.0) < 1e-9 * self.size)
        u[bad] = np.nan
        return u


def open_loop(closing: Closing, u: np.ndarray, owners: Sequence[str]) -> str:
    """Which loop cannot close near a posture: the one that is open furthest there."""
    f = np.abs(closing.residuals(u[None])[0])
    worst = int(np.argmax(f))
    return f'loop "{owners[worst]}" cannot close near that posture (open by {f[worst]:.3g})'


def nearest_closed(closing: Closing, start: np.ndarray) -> np.ndarray | None:
    """The closed posture that Newton finds from `start`; where its axes are opposite, another near.

    Other starts differ in the solved angles.
    """
    home = closing.closed(start[None])
    if closing.aligned(home)[0]:
        return home[0]
    if not np.all(np.isfinite(home)):
        return None
    rng = np.random.default_rng(_SEED)
    others = np.tile(start, (_STARTS, 1))
    angles = [k for k in closing.solved if not closing.lengths[k]]
    others[:, angles] += rng.uniform(-np.pi, np.pi, (_STARTS, len(angles)))
    found = closing.closed(others)
    found = found[closing.aligned(found)]
    if len(found) == 0:
        return None
    found[:, angles] = start[angles] + wrapped(found[:, angles] - start[angles])
    # Mirrored postures may be equally near: digits that no rounding reaches decide then.
    near = np.round(np.sum(np.abs(found - start), axis=1), _PLACES)
    return found[min(range(len(found)), key=lambda i: (near[i], *np.round(found[i], _PLACES)))]


def wrapped(angle: np.ndarray) -> np.ndarray:
    """Angles in [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def polished(
    closing: Closing, home: np.ndarray, chosen: Sequence[int], robot: Robot
) -> tuple[float, ...]:
    """The doubles next to the closed posture that `home` is up to rounding: the same everywhere.

    Newton on the independent equations, their residuals with 40 digits, the given variables held.

    Args:
        closing: the loops.
        home: a closed posture.
        chosen: numbers of the independent equations.
        robot: for the message.

    Raises:
        LoopError: it does not settle; loops so near to singular have no certain digits.
    """
    mp, solved = precise(), list(closing.solved)
    count = len(solved)
    equations = [closing.equations[i] for i in chosen]
    slopes = [closing.jacobian[i][k] for i in chosen for k in solved]
    u = [decimal(float(x)) for x in home]
    for _ in range(_POLISHING):
        inputs = {f"q[{k}]": x for k, x in enumerate(u)}
        found = precise_values(closing.graph, [*equations, *slopes], {**closing.values, **inputs})
        # The step is good to a double, what is left is known to 40 digits: so it goes on shrinking.
        f, J = (np.array(part, dtype=float) for part in (found[:count], found[count:]))
        try:
            step = np.linalg.solve(J.reshape(count, count), f)
        except np.linalg.LinAlgError:
            break
        for k, change in zip(solved, step, strict=True):
            u[k] -= float(change)
        if max(abs(change) for change in step) < _POLISHED * closing.size:
            for k in solved:  # what should be 0 is left at the size of the last step, not at 0
                u[k] = mp.nint(u[k] / _POLISHED) * _POLISHED
            return tuple(float(x) for x in u)
    raise LoopError(
        f"{robot.name}: [home]: the closed posture is not certain to the last digit, the loops are "
        "all but singular there; state another posture"
    )


def moved_postures(
    closing: Closing, home: np.ndarray, rng: np.random.Generator, samples: int, reach: float = 0.3
) -> np.ndarray:
    """(samples, unknowns) closed postures around home: random actuated motion, in small steps.

    A sample stops where the loops would not close any further.
    """
    scale = closing.scale * reach
    scale = np.where(closing.lengths, 0.5 * scale, scale)
    u = np.tile(home, (samples, 1))
    target = rng.uniform(-1.0, 1.0, u.shape) * scale
    step = _tangent(closing, u, target) / _STEPS
    for _ in range(_STEPS):
        trial = closing.closed(u + step, range(closing.unknowns))
        jump = np.max(np.abs(trial - u) / closing.scale, axis=1)
        good = np.isfinite(jump) & (jump < 4 * reach / _STEPS * 3)
        u[good] = trial[good]
        step = _tangent(closing, u, target) / _STEPS
    return u


def _tangent(closing: Closing, u: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """`wanted` projected on the motions that the loops allow."""
    scale = closing.scale
    J = closing.jacobians(u) * scale
    w = wanted / scale
    along = np.einsum("nij,nj->ni", np.linalg.pinv(J, rcond=1e-9), np.einsum("nij,nj->ni", J, w))
    return (w - along) * scale
