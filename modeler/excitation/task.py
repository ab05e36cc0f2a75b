"""One search for a motion: its variables, what it is to make small, the walls it stays within."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.excitation.criterion import NEAR_REST, Criterion, MotionColumns
from modeler.excitation.families import Series
from modeler.excitation.motion import Bounds, PostureLimits
from modeler.numerics.optimize import evolve

_POSTURES = 200  # drawn, to rest in
_GENERATIONS = 40  # of evolution from the best of them
_MIDST = 0.9  # of the ranges: how far a robot may rest from their middle
_HALVINGS = 5  # of a motion's size, to come near the largest

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]
"""(n, J) q, qd and qdd."""


@dataclass(frozen=True, eq=False)
class Task:
    """A motion is (J, 2 K - 1) coefficients x; see `Series`.

    Attributes:
        columns: of the model.
        bounds: limits.
        series: the basis, over one period.
        criterion: of the rows of `kept` columns, weighted.
        weights: (J,) of the rows of each joint: one over the sigma of its torque.
        kept: (k,) columns that matter.
        posture: what positions alone must keep to, besides their ranges.
        beta: (c,) for torques; None where no parameters are known.
        share: (J,) of the torque limits that is used, to be sure between samples.
    """

    columns: MotionColumns
    bounds: Bounds
    series: Series
    criterion: Criterion
    weights: np.ndarray
    kept: np.ndarray
    posture: PostureLimits
    beta: np.ndarray | None = None
    share: float = 0.98

    def kinematic(self, x: np.ndarray) -> np.ndarray:
        """(3, n, J) position, speed and acceleration as shares of their limits: |.| <= room."""
        b = self.bounds
        q, qd, qdd = self.series.motion(x)
        return np.stack([(q - b.middle) / b.half, qd / b.speed, qdd / b.acceleration])

    def reach(self, x: np.ndarray, way: np.ndarray) -> float:
        """How many lengths of `way` may be gone until a kinematic limit."""
        here = self.kinematic(x)
        turn = self.kinematic(x + way) - here
        with np.errstate(divide="ignore", invalid="ignore"):
            left = np.where(
                turn == 0.0, np.inf, (self.series.room - np.sign(turn) * here) / np.abs(turn)
            )
        return float(left.min())

    def phi(self, motion: Motion) -> np.ndarray:
        """(n, J, c) the columns of the model, with dry friction as it is."""
        s = self.columns.read(motion, self.series.time)
        return self.columns.exact(*motion, s)

    def weighted(self, phi: np.ndarray) -> np.ndarray:
        """(n J, k) weighted rows of the kept columns."""
        return (phi[:, :, self.kept] * self.weights[:, None]).reshape(-1, len(self.kept))

    def rows(self, motion: Motion) -> np.ndarray:
        """(n J, k) the same of a motion."""
        return self.weighted(self.phi(motion))

    def torques(self, phi: np.ndarray) -> np.ndarray:
        """(n, J) as shares of their limits: |.| < share; (n, 0) where none is limited."""
        if self.beta is None or not np.isfinite(self.bounds.torque).any():
            return np.zeros((len(phi), 0))
        return phi @ self.beta / self.bounds.torque

    def keeps(self, x: np.ndarray) -> bool:
        """True if no limit is broken at the samples."""
        motion = self.series.motion(x)
        if np.abs(self.kinematic(x)).max() >= self.series.room:
            return False
        try:
            parts = [self.posture.shares(motion[0])]
            if self.beta is not None and np.isfinite(self.bounds.torque).any():
                parts.append(self.torques(self.phi(motion)))
        except LoopError:
            return False
        return all(np.abs(part).max(initial=0.0) < self.share for part in parts)

    @cached_property
    def still(self) -> np.ndarray:
        """(J, 2 K - 1) the motion that rests where limits leave most room for small ones.

        Raises:
            DataError: they leave none anywhere.
        """
        b = self.bounds
        middle = b.middle if b.home is None else b.home
        place = np.clip((middle - b.middle) / b.half, -_MIDST, _MIDST)
        if self._load(place) > 0.0:
            rng = np.random.default_rng(0)
            drawn = rng.uniform(-_MIDST, _MIDST, (_POSTURES, len(place)))
            place = min((place, *drawn), key=self._load)
            place = evolve(self._load, place, 0.1, _GENERATIONS, rng, lambda generation: True)
        x = np.zeros((len(place), self.series.values.shape[1]))
        x[:, 0] = b.middle + b.half * place
        if not self._load(place) < self.share:
            told = ", ".join(f"q{j} = {q:.3g}" for j, q in zip(b.joints, x[:, 0], strict=True))
            raise DataError(
                f"{self.columns.compiled.spec.robot}: no posture was found in which limits of "
                f"torques, boxes and clearance leave room to move, not even slowly; {told} takes "
                f"{self._load(place):.3g} times what they allow; expected wider ones"
            )
        return x

    def _load(self, place: np.ndarray) -> float:
        """The largest share of a limit that ever smaller motions around a posture come to.

        What remains of their torques is gravity, and dry friction with all signs: that does not
        shrink with the speed.

        Args:
            place: (J,) the posture, in half ranges from their middle.
        """
        b, J = self.bounds, len(place)
        if np.abs(place).max() > _MIDST:
            return np.inf
        q = np.tile(b.middle + b.half * place, (2 * J + 1, 1))
        qd = np.vstack([np.zeros(J), np.eye(J), -np.eye(J)]) * NEAR_REST * b.speed
        # Effects of time grow one way.
        ends = (0.0, self.series.duration) if self.columns.compiled.spec.signals else (0.0,)
        try:
            share = float(np.abs(self.posture.shares(q[:1])).max(initial=0.0))
            read = [self.columns.read((q, qd, 0.0 * q), np.full(len(q), time)) for time in ends]
            loads = [self.torques(self.columns.exact(q, qd, 0.0 * q, s)) for s in read]
        except LoopError:
            return np.inf
        rest = np.hstack(loads)
        turned = (rest[1:] - rest[0]).reshape(2, J, -1)
        most = rest[0] + turned.max(axis=0).clip(min=0.0).sum(axis=0)
        least = rest[0] + turned.min(axis=0).clip(max=0.0).sum(axis=0)
        return float(np.abs([most, least]).max(initial=share))

    def drawn_in(self, x: np.ndarray, judge: "Task | None" = None) -> np.ndarray:
        """A motion; of one beyond limits, the largest found between `still` and it that keeps them.

        It ends, since `still` leaves room for every motion that is small enough.

        Args:
            x: the motion.
            judge: the same task at other samples, which says whether limits are kept.
        """
        keeps, way = (judge or self).keeps, x - self.still
        whole = size = min(1.0, 0.999 * self.reach(self.still, way))
        while not keeps(self.still + size * way):
            size *= 0.5
        more = size
        for _ in range(_HALVINGS if size < whole else 0):
            more *= 0.5
            size += more * keeps(self.still + (size + more) * way)
        return self.still + size * way


@dataclass(eq=False)
class Walled:
    """The criterion plus a barrier at every limit: value and slope, for `descend`.

    Attributes:
        task: the search.
        height: of the barrier, -log(1 - share^2) averaged over the samples.
    """

    task: Task
    height: float
    _state: tuple = field(default=(), init=False, repr=False)

    def value(self, flat: np.ndarray) -> float:
        """Infinite where a limit is broken."""
        task = self.task
        x = flat.reshape(len(task.bounds.joints), -1)
        shares = task.kinematic(x) / task.series.room
        if not np.abs(shares).max() < 1.0:
            return np.inf
        motion = task.series.motion(x)
        try:
            posture = task.posture.shares(motion[0]) / task.share
            if not np.abs(posture).max(initial=0.0) < 1.0:
                return np.inf
            s = task.columns.read(motion, task.series.time)
            phi = task.columns.smooth(*motion, s)
        except LoopError:
            return np.inf
        loads = task.torques(phi) / task.share
        if not np.abs(loads).max(initial=0.0) < 1.0:
            return np.inf
        value, pull = task.criterion(task.weighted(phi))
        if not np.isfinite(value):
            return np.inf
        self._state = (motion, s, phi, pull, shares, posture, loads)
        walls = sum(-np.sum(np.log1p(-(part**2))) for part in (shares, posture, loads))
        return float(value + self.height * walls / len(motion[0]))

    def slope(self) -> np.ndarray:
        """The gradient at the point whose value was asked for last."""
        task = self.task
        motion, s, phi, pull, shares, posture, loads = self._state
        n = len(motion[0])
        whole = np.zeros_like(phi)
        whole[:, :, task.kept] = pull.reshape(n, -1, len(task.kept)) * task.weights[:, None]
        if task.beta is not None and loads.size:
            push = self._push(loads, n) / (task.bounds.torque * task.share)
            whole += push[:, :, None] * task.beta
        slopes = task.columns.pulled_back(motion, s, whole)
        b = task.bounds
        for k, unit in enumerate((b.half, b.speed, b.acceleration)):
            slopes[k] += self._push(shares[k], n) / (unit * task.series.room)
        slopes[0] += task.posture.pulled_back(motion[0], self._push(posture, n) / task.share)
        basis = (task.series.values, task.series.slopes, task.series.bends)
        total = sum(g.T @ V for g, V in zip(slopes, basis, strict=True))
        return np.ravel(total)

    def _push(self, shares: np.ndarray, n: int) -> np.ndarray:
        return self.height / n * 2.0 * shares / (1.0 - shares**2)
