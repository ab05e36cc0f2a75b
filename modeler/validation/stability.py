"""Whether errors of a free run grow by the robot's nature, whatever the model.

Along the logged motion a small error x = (dq, dqd) obeys x' = A(t) x, A the derivative of

    (qd, M(q)^-1 (tau - h(q, qd) - C^T a sigma))

with the torques as logged and dry friction as it is (it can only hold). Over a run of T seconds x
becomes Phi x. Its rate is ln(spectral radius of Phi) / T, 1/s: Lyapunov's first exponent if T is
long, the largest real part of an eigenvalue if A is constant; it does not hang on units. Errors
double in ln 2 / rate. A joint that nothing pulls back to a place has a rate of 0 at best, and an
error of its torque is integrated twice.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from modeler.core.brief import ShortRepr
from modeler.validation.forward_dynamics import FittedPlant

_STEP = 1e-5  # of a difference quotient, rad or m, and rad/s or m/s
_GROWN = np.log(10.0)  # an error that becomes tenfold in the run is told
_FADED = np.log(2.0)  # and one that becomes half


@dataclass(frozen=True, eq=False)
class LoggedMotion:
    """States of one uninterrupted motion, p of them at equal times.

    Attributes:
        name: of the log.
        time: (p,) s.
        q, qd, tau: (p, n).
        signals: (p, m) or None.
    """

    name: str
    time: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    tau: np.ndarray
    signals: np.ndarray | None


@dataclass(frozen=True)
class Stability(ShortRepr):
    """What becomes of small errors along the motion.

    Attributes:
        rate: 1/s, of the run in which it is largest; below 0 they fade.
        seconds: of that run.
        steepest: 1/s, largest real part of an eigenvalue of A at one time of all runs.
        log: where that was.
        at: s, when.
        fastest: 1/s, largest absolute value of an eigenvalue: how fine a step must be.
    """

    rate: float
    seconds: float
    steepest: float
    log: str
    steepest_time: float
    fastest: float

    @property
    def doubling_time(self) -> float | None:
        """S in which an error doubles; None if none does."""
        return float(np.log(2.0) / self.rate) if self.rate > 0.0 else None

    @property
    def unstable(self) -> bool:
        """True if an error becomes tenfold and more in that run."""
        return bool(self.rate * self.seconds > _GROWN)

    def describe(self) -> str:
        """In words."""
        growth = self.rate * self.seconds
        if self.unstable:
            tens = f"1e{growth / np.log(10.0):.0f}"
            times = f"{np.exp(growth):.2g}" if growth < 25.0 else tens
            return (
                "unstable by nature: along this motion any error doubles every "
                f"{self.doubling_time:.2g} s, {times} times in "
                f"{self.seconds:.3g} s, whatever the model; steepest at {self.steepest_time:.4g} s "
                "of "
                f"{self.log}. A long free run says nothing here: judge by the windows"
            )
        if growth < -_FADED:
            return (
                "stable by nature: along this motion errors of the start fade, to a half in "
                f"{np.log(2.0) / -self.rate:.2g} s"
            )
        return (
            "neither unstable nor stable by nature: nothing pulls the robot back to its path, so "
            "an error of the torque is integrated twice, and a long free run drifts with any model"
        )


def analyse_stability(plant: FittedPlant, runs: Sequence[LoggedMotion]) -> Stability:
    """Of the linearised robot along logged motions."""
    results: list[Stability] = []
    for run in runs:
        A = compute_jacobians(plant, run)
        values = np.linalg.eigvals(A)
        steep = values.real.max(axis=1)
        worst = int(np.argmax(steep))
        growth = _compute_growth(A, float(run.time[1] - run.time[0]))
        seconds = float(run.time[-1] - run.time[0])
        results.append(
            Stability(
                growth / seconds, seconds, float(steep[worst]), run.name, float(run.time[worst]),
                float(np.abs(values).max()),
            )
        )  # fmt: skip
    grown = max(results, key=lambda result: result.rate * result.seconds)
    steepest = max(results, key=lambda result: result.steepest)
    return Stability(
        grown.rate, grown.seconds, steepest.steepest, steepest.log, steepest.steepest_time,
        max(result.fastest for result in results),
    )  # fmt: skip


def compute_jacobians(plant: FittedPlant, run: LoggedMotion) -> np.ndarray:
    """(p, 2n, 2n) A, by central differences."""
    p, n = run.q.shape
    forces = plant.compute_forces(run.q, run.qd, np.zeros_like(run.q), run.signals)
    speeds = np.einsum("bkn,bn->bk", forces.C, run.qd)
    held = np.einsum("bkn,bk->bn", forces.C, forces.dry * np.sign(speeds))

    def compute_acceleration(q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        M, h = plant.compute_smooth_forces(forces, q, qd, run.signals)
        return np.asarray(np.linalg.solve(M, (run.tau - h - held)[:, :, None])[:, :, 0])

    A = np.zeros((p, 2 * n, 2 * n))
    A[:, :n, n:] = np.eye(n)
    for j in range(n):
        e = np.zeros(n)
        e[j] = _STEP
        by_q = compute_acceleration(run.q + e, run.qd) - compute_acceleration(run.q - e, run.qd)
        by_qd = compute_acceleration(run.q, run.qd + e) - compute_acceleration(run.q, run.qd - e)
        A[:, n:, j], A[:, n:, n + j] = by_q / (2 * _STEP), by_qd / (2 * _STEP)
    return A


def _compute_growth(A: np.ndarray, step: float) -> float:
    """ln of the spectral radius of the product of exp(A step), first to last but one."""
    product, log = np.eye(A.shape[1]), 0.0
    for each in expm(step * 0.5 * (A[1:] + A[:-1])):
        product = each @ product
        size = float(np.abs(product).max())
        product, log = product / size, log + np.log(size)
    radius = float(np.abs(np.linalg.eigvals(product)).max())
    return float(log) + float(np.log(max(radius, 1e-300)))


# How far simulated positions are from measured ones.


_IDLE = {"rad": 1e-3, "m": 1e-4}  # a joint that moves less stands still


def compute_fit_percentage(measured: np.ndarray, simulated: np.ndarray) -> float | None:
    """100 (1 - |q - q_s| / |q - mean q|), %, of samples (p,), as MATLAB's `compare` has it.

    None if nothing moves. A simulated value that is not finite, of a robot that was lost, counts as
    far away as the farthest that is.
    """
    spread = float(np.linalg.norm(measured - measured.mean()))
    if spread == 0.0:
        return None
    error = np.abs(measured - simulated)
    lost = ~np.isfinite(error)
    if lost.any():
        error[lost] = max(float(error[~lost].max(initial=0.0)), float(np.ptp(measured)))
    return 100.0 * (1.0 - float(np.linalg.norm(error)) / spread)


def compute_horizons(error: np.ndarray, bound: np.ndarray, step: float) -> np.ndarray:
    """(b, n) s until |error| (samples, b, n) first passes `bound` (n,); infinite: it never does.

    What is not finite has passed it; samples after the end of a start are 0.
    """
    passed = ~(np.abs(error) <= bound)
    first = np.argmax(passed, axis=0).astype(float) * step
    return np.where(passed.any(axis=0), first, np.inf)


def compute_ranges(q: np.ndarray, units: list[str]) -> np.ndarray:
    """(n,) ranges of positions (p, n); NaN for a joint that hardly moves."""
    ranges = np.ptp(q, axis=0)
    least = np.array([_IDLE[unit] for unit in units])
    return np.where(ranges > least, ranges, np.nan)
