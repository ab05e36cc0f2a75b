"""One search for a motion: its variables, what it is to make small, the walls it stays within."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from modeler.core.errors import LoopError
from modeler.excite.bounds import Bounds
from modeler.excite.columns import Columns
from modeler.excite.criterion import Criterion
from modeler.excite.posture import Posture
from modeler.excite.series import Series

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

    columns: Columns
    bounds: Bounds
    series: Series
    criterion: Criterion
    weights: np.ndarray
    kept: np.ndarray
    posture: Posture
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

    def rows(self, motion: Motion, smooth: bool = False) -> np.ndarray:
        """(n J, k) weighted rows of the kept columns."""
        s = self.columns.read(motion[0], self.series.time)
        phi = (self.columns.smooth if smooth else self.columns.exact)(*motion, s)
        return (phi[:, :, self.kept] * self.weights[:, None]).reshape(-1, len(self.kept))

    def torques(self, phi: np.ndarray) -> np.ndarray | None:
        """(n, J) as shares of their limits: |.| < share; None where none is limited."""
        if self.beta is None or not np.isfinite(self.bounds.torque).any():
            return None
        return (phi @ self.beta) / self.bounds.torque

    def keeps(self, x: np.ndarray) -> bool:
        """True if no limit is broken at the samples."""
        motion = self.series.motion(x)
        if np.abs(self.kinematic(x)).max() >= self.series.room:
            return False
        try:
            if np.abs(self.posture.shares(motion[0])).max(initial=0.0) >= self.share:
                return False
            if self.beta is None:
                return True
            s = self.columns.read(motion[0], self.series.time)
            loads = self.torques(self.columns.exact(*motion, s))
        except LoopError:
            return False
        return loads is None or bool(np.abs(loads).max() < self.share)


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
            s = task.columns.read(motion[0], task.series.time)
            phi = task.columns.smooth(*motion, s)
        except LoopError:
            return np.inf
        torques = task.torques(phi)
        loads = np.zeros((1, 0)) if torques is None else torques / task.share
        if not np.abs(loads).max(initial=0.0) < 1.0:
            return np.inf
        W = (phi[:, :, task.kept] * task.weights[:, None]).reshape(-1, len(task.kept))
        value, pull = task.criterion(W)
        if not np.isfinite(value):
            return np.inf
        self._state = (motion, s, phi, pull, shares, posture, loads)
        walls = sum(-np.sum(np.log1p(-(part**2))) for part in (shares, posture, loads))
        return float(value + self.height * walls / len(motion[0]))

    def slope(self, flat: np.ndarray) -> np.ndarray:
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


Progress = Callable[[float], None]
