"""One search for a motion: its variables, what it is to make small, the walls it stays within."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.excitation.criterion import Criterion, MotionColumns
from modeler.excitation.families import MotionSeries
from modeler.excitation.motion import MotionBounds, PostureLimits
from modeler.excitation.thresholds import THRESHOLDS
from modeler.numerics.optimize import minimise_cma_es

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]
"""(n, J) q, qd and qdd."""


@dataclass(frozen=True, eq=False)
class ExcitationTask:
    """A motion is (J, 2 K - 1) coefficients x; see `MotionSeries`.

    Attributes:
        columns: of the model.
        bounds: limits.
        series: the basis, over one period.
        criterion: of the rows of `column_indices` columns, weighted.
        weights: (J,) of the rows of each joint: one over the sigma of its torque.
        kept: (k,) columns that matter.
        posture: what positions alone must keep to, besides their ranges.
        beta: (c,) for torques; None where no parameters are known.
        share: (J,) of the torque limits that is used, to be sure between samples.
    """

    columns: MotionColumns
    bounds: MotionBounds
    series: MotionSeries
    criterion: Criterion
    weights: np.ndarray
    column_indices: np.ndarray
    posture: PostureLimits
    beta: np.ndarray | None = None
    share: float = 0.98

    def compute_kinematic_shares(self, x: np.ndarray) -> np.ndarray:
        """(3, n, J) position, speed and acceleration as shares of their limits: |.| <= room."""
        b = self.bounds
        q, qd, qdd = self.series.evaluate_motion(x)
        return np.stack([(q - b.mid_range) / b.half_range, qd / b.speed, qdd / b.acceleration])

    def compute_reach(self, x: np.ndarray, direction: np.ndarray) -> float:
        """How many lengths of `direction` may be gone until a kinematic limit."""
        here = self.compute_kinematic_shares(x)
        turn = self.compute_kinematic_shares(x + direction) - here
        with np.errstate(divide="ignore", invalid="ignore"):
            left = np.where(
                turn == 0.0, np.inf, (self.series.room - np.sign(turn) * here) / np.abs(turn)
            )
        return float(left.min())

    def compute_columns(self, motion: Motion) -> np.ndarray:
        """(n, J, c) the columns of the model, with dry friction as it is."""
        s = self.columns.read_signals(motion, self.series.time)
        return self.columns.evaluate_exact(*motion, s)

    def weigh_columns(self, phi: np.ndarray) -> np.ndarray:
        """(n J, k) weighted rows of the kept columns."""
        return (phi[:, :, self.column_indices] * self.weights[:, None]).reshape(
            -1, len(self.column_indices)
        )

    def compute_rows(self, motion: Motion) -> np.ndarray:
        """(n J, k) the same of a motion."""
        return self.weigh_columns(self.compute_columns(motion))

    def compute_torque_shares(self, phi: np.ndarray) -> np.ndarray:
        """(n, J) as shares of their limits: |.| < share; (n, 0) where none is limited."""
        if self.beta is None or not np.isfinite(self.bounds.torque).any():
            return np.zeros((len(phi), 0))
        return phi @ self.beta / self.bounds.torque

    def is_feasible(self, x: np.ndarray) -> bool:
        """True if no limit is broken at the samples."""
        motion = self.series.evaluate_motion(x)
        if np.abs(self.compute_kinematic_shares(x)).max() >= self.series.room:
            return False
        try:
            parts = [self.posture.compute_shares(motion[0])]
            if self.beta is not None and np.isfinite(self.bounds.torque).any():
                parts.append(self.compute_torque_shares(self.compute_columns(motion)))
        except LoopError:
            return False
        return all(np.abs(part).max(initial=0.0) < self.share for part in parts)

    @cached_property
    def rest_motion(self) -> np.ndarray:
        """(J, 2 K - 1) the motion that rests where limits leave most room for small ones.

        Raises:
            DataError: they leave none anywhere.
        """
        b = self.bounds
        middle = b.mid_range if b.home is None else b.home
        place = np.clip(
            (middle - b.mid_range) / b.half_range,
            -THRESHOLDS.max_rest_offset,
            THRESHOLDS.max_rest_offset,
        )
        if self._compute_rest_load(place) > 0.0:
            rng = np.random.default_rng(0)
            postures = rng.uniform(
                -THRESHOLDS.max_rest_offset,
                THRESHOLDS.max_rest_offset,
                (THRESHOLDS.rest_postures, len(place)),
            )
            place = min((place, *postures), key=self._compute_rest_load)
            place = minimise_cma_es(
                self._compute_rest_load,
                place,
                0.1,
                THRESHOLDS.rest_generations,
                rng,
                lambda generation: True,
            )
        x = np.zeros((len(place), self.series.values.shape[1]))
        x[:, 0] = b.mid_range + b.half_range * place
        if not self._compute_rest_load(place) < self.share:
            posture = ", ".join(f"q{j} = {q:.3g}" for j, q in zip(b.joints, x[:, 0], strict=True))
            raise DataError(
                f"{self.columns.compiled.spec.robot}: no posture was found in which limits of "
                f"torques, boxes and clearance leave room to move, not even slowly; {posture} "
                "takes "
                f"{self._compute_rest_load(place):.3g} times what they allow; expected wider ones"
            )
        return x

    def _compute_rest_load(self, place: np.ndarray) -> float:
        """The largest share of a limit that ever smaller motions around a posture come to.

        What remains of their torques is gravity, and dry friction with all signs: that does not
        shrink with the speed.

        Args:
            place: (J,) the posture, in half ranges from their middle.
        """
        b, J = self.bounds, len(place)
        if np.abs(place).max() > THRESHOLDS.max_rest_offset:
            return np.inf
        q = np.tile(b.mid_range + b.half_range * place, (2 * J + 1, 1))
        qd = np.vstack([np.zeros(J), np.eye(J), -np.eye(J)]) * THRESHOLDS.rest_speed * b.speed
        # Effects of time grow one way.
        ends = (0.0, self.series.duration) if self.columns.compiled.spec.signals else (0.0,)
        try:
            share = float(np.abs(self.posture.compute_shares(q[:1])).max(initial=0.0))
            read = [
                self.columns.read_signals((q, qd, 0.0 * q), np.full(len(q), time)) for time in ends
            ]
            loads = [
                self.compute_torque_shares(self.columns.evaluate_exact(q, qd, 0.0 * q, s))
                for s in read
            ]
        except LoopError:
            return np.inf
        rest = np.hstack(loads)
        turned = (rest[1:] - rest[0]).reshape(2, J, -1)
        most = rest[0] + turned.max(axis=0).clip(min=0.0).sum(axis=0)
        least = rest[0] + turned.min(axis=0).clip(max=0.0).sum(axis=0)
        return float(np.abs([most, least]).max(initial=share))

    def shrink_to_limits(
        self, x: np.ndarray, checking_task: "ExcitationTask | None" = None
    ) -> np.ndarray:
        """A motion; of one beyond limits.

        The largest found between `rest_motion` and it that keeps them.

        It ends, since `rest_motion` leaves room for every motion that is small enough.

        Args:
            x: the motion.
            checking_task: the same task at other samples, which says whether limits are kept.
        """
        is_feasible, direction = (checking_task or self).is_feasible, x - self.rest_motion
        whole = size = min(1.0, 0.999 * self.compute_reach(self.rest_motion, direction))
        while not is_feasible(self.rest_motion + size * direction):
            size *= 0.5
        more = size
        for _ in range(THRESHOLDS.size_halvings if size < whole else 0):
            more *= 0.5
            size += more * is_feasible(self.rest_motion + (size + more) * direction)
        return self.rest_motion + size * direction


@dataclass(eq=False)
class BarrierProblem:
    """The criterion plus a barrier at every limit: value and slope, for `descend`.

    Attributes:
        task: the search.
        height: of the barrier, -log(1 - share^2) averaged over the samples.
    """

    task: ExcitationTask
    height: float
    _state: tuple = field(default=(), init=False, repr=False)

    def compute_value(self, flat: np.ndarray) -> float:
        """Infinite where a limit is broken."""
        task = self.task
        x = flat.reshape(len(task.bounds.joints), -1)
        shares = task.compute_kinematic_shares(x) / task.series.room
        if not np.abs(shares).max() < 1.0:
            return np.inf
        motion = task.series.evaluate_motion(x)
        try:
            posture = task.posture.compute_shares(motion[0]) / task.share
            if not np.abs(posture).max(initial=0.0) < 1.0:
                return np.inf
            s = task.columns.read_signals(motion, task.series.time)
            phi = task.columns.evaluate_smooth(*motion, s)
        except LoopError:
            return np.inf
        loads = task.compute_torque_shares(phi) / task.share
        if not np.abs(loads).max(initial=0.0) < 1.0:
            return np.inf
        value, pull = task.criterion(task.weigh_columns(phi))
        if not np.isfinite(value):
            return np.inf
        self._state = (motion, s, phi, pull, shares, posture, loads)
        walls = sum(-np.sum(np.log1p(-(part**2))) for part in (shares, posture, loads))
        return float(value + self.height * walls / len(motion[0]))

    def compute_gradient(self) -> np.ndarray:
        """The gradient at the point whose value was asked for last."""
        task = self.task
        motion, s, phi, pull, shares, posture, loads = self._state
        n = len(motion[0])
        whole = np.zeros_like(phi)
        whole[:, :, task.column_indices] = (
            pull.reshape(n, -1, len(task.column_indices)) * task.weights[:, None]
        )
        if task.beta is not None and loads.size:
            push = self._compute_barrier_slope(loads, n) / (task.bounds.torque * task.share)
            whole += push[:, :, None] * task.beta
        slopes = task.columns.pull_back_gradient(motion, s, whole)
        b = task.bounds
        for k, unit in enumerate((b.half_range, b.speed, b.acceleration)):
            slopes[k] += self._compute_barrier_slope(shares[k], n) / (unit * task.series.room)
        slopes[0] += task.posture.pull_back_gradient(
            motion[0], self._compute_barrier_slope(posture, n) / task.share
        )
        basis = (task.series.values, task.series.slopes, task.series.bends)
        total = sum(g.T @ V for g, V in zip(slopes, basis, strict=True))
        return np.ravel(total)

    def _compute_barrier_slope(self, shares: np.ndarray, n: int) -> np.ndarray:
        return self.height / n * 2.0 * shares / (1.0 - shares**2)
