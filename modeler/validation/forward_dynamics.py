"""Forward dynamics of a fitted robot: M(q) qdd = tau - h(q, qd) - C(q)^T (a sign(C qd)).

All from the compiled C: M is its inertia matrix; h + C^T a sign is its inverse dynamics less M qdd.
What leaps where a shaft changes its direction is dry friction: C holds the shafts, a their torques,
found by evaluating the C at both sides of standstill. They are apart because at standstill dry
friction is no function of the speed: it takes any value between its bounds that holds the shaft.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from modeler.core.errors import DataError
from modeler.core.json import Document, ShortRepr
from modeler.core.table import format_percent
from modeler.estimation import scale_inertia
from modeler.regression import find_shafts
from modeler.runtime import CompiledModel
from modeler.validation.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class Forces:
    """What acts in states, b of them side by side, n joints, k shafts.

    Attributes:
        M: (b, n, n) inertia matrix.
        smooth: (b, n) h, N m or N: all but inertia and dry friction.
        C: (b, k, n) speeds of the shafts are C qd.
        dry: (b, k) a, bounds of dry friction on the shafts.
    """

    M: np.ndarray
    smooth: np.ndarray
    C: np.ndarray
    dry: np.ndarray


class ElasticModel:
    """The motors and what E elastic joints wind up, (q, e), as n + E coordinates of one robot.

    With the links' inertia matrix L, J that of the rotors and E the elastic joints,

        M = [L + J, -L_.E; -L_E., L_EE],  forces on e: K e + D e' - links_E.

    Args:
        model: its C.
        beta: (c,) base parameters.
    """

    def __init__(self, model: CompiledModel, beta: np.ndarray) -> None:
        self.spec, self._model, spec = model.spec, model, model.spec
        names, self.windups = [joint.name for joint in spec.joints], list(spec.windups)
        elastic = [spec.signals[k].joint for k in self.windups]
        self._joints = [names.index(name) for name in elastic]
        rotors = {p.joint: p.name for p in spec.standard if p.effect == "rotor_inertia"}
        columns = [base.column_of for base in spec.base]
        self._rotors = np.array([beta[columns.index(rotors[name])] for name in elastic])
        _, values = model.windup_values or (None, spec.elastic)
        self._stiffness, self._damping = np.reshape(values, (2, -1))

    def inertia_matrix(self, q: np.ndarray, beta: np.ndarray) -> np.ndarray:
        """Returns (b, n + E, n + E)."""
        n, at = len(self.spec.joints), self._joints
        links = q[:, :n].copy()
        links[:, at] -= q[:, n:]
        M = self._model.inertia_matrix(links, beta)
        bodies = M.copy()
        bodies[:, at, at] -= self._rotors
        across = -bodies[:, :, at]
        return np.block([[M, across], [across.transpose(0, 2, 1), bodies[:, at][:, :, at]]])

    def inverse_dynamics(
        self, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, beta: np.ndarray, s: np.ndarray | None
    ) -> np.ndarray:
        """Returns (b, n + E) torques of the motors, and forces on e, which are 0 in free motion."""
        n, at = len(self.spec.joints), self._joints
        read = np.array(s)
        for order, x in enumerate((q, qd, qdd)):
            read[:, [k + order for k in self.windups]] = x[:, n:]
        spring = self._stiffness * q[:, n:] + self._damping * qd[:, n:]
        q, qd, qdd = (x[:, :n] for x in (q, qd, qdd))
        tau = self._model.inverse_dynamics(q, qd, qdd, beta, read)
        motors = self._model.friction(qd, beta, q, qdd, read)[:, at] + self._rotors * qdd[:, at]
        return np.hstack([tau, spring - (tau[:, at] - motors)])

    def advance(self, dq: np.ndarray, dt: float, s: np.ndarray, *motion: np.ndarray) -> np.ndarray:
        """Returns (b, m) the signals after a step; those of elastic joints are coordinates."""
        n = len(self.spec.joints)
        q, qd, qdd = (x[:, :n] for x in motion)
        values = np.ones(len(self.spec.base)), np.append(self._stiffness, self._damping)
        return self._model.advance(dq[:, :n], dt, s, q, qd, qdd, *values)


class FittedPlant:
    """The robot of a model with its values; what elastic joints wind up are coordinates of it too.

    Args:
        model: its C.
        beta: (c,) base parameters, SI units.

    Attributes:
        joints: n, of all coordinates.
        shafts: k.
    """

    def __init__(self, model: CompiledModel, beta: np.ndarray) -> None:
        self.beta = np.asarray(beta, dtype=float)
        self.robot = model
        self.model = ElasticModel(model, self.beta) if model.spec.windups else model
        self.joints = len(model.spec.joints) + len(model.spec.windups)
        closure = model.spec.closure
        rubbing = {p.joint for p in model.spec.standard if p.kind == "friction"}
        if closure is None:
            self._rows = np.array([part.coefficients for part in find_shafts(model)])
            self._rows = self._rows.reshape(-1, len(model.spec.joints))
            self._rows = np.pad(self._rows, ((0, 0), (0, len(model.spec.windups))))
            self._places: list[int] = []
            self.shafts = len(self._rows)
        else:
            self._places = [i for i, name in enumerate(closure.variables) if name in rubbing]
            self.shafts = len(self._places)
        self.inner = [
            i
            for i, signal in enumerate(model.spec.signals)
            if signal.is_internal_state and not signal.kind.startswith("windup")
        ]
        """Places in s of what is part of the state."""

    def extend(self, x: np.ndarray, s: np.ndarray | None, order: int) -> np.ndarray:
        """Returns (..., n) coordinates of joints (..., j) and signals, or derivatives of an order.

        Of an order above 1 the windups have none: what acts on them from outside.
        """
        places = [k + order for k in self.model.spec.windups]
        if not places or s is None:
            return x
        return np.concatenate([x, s[..., places] if order < 2 else 0.0 * s[..., places]], axis=-1)

    def can_close(self, q: np.ndarray) -> np.ndarray:
        """Returns (b,) True where the loops close; everywhere without loops."""
        if self.model.spec.closure is None:
            return np.ones(len(q), dtype=bool)
        return np.asarray(self.robot.closing_status(q) == 0)

    def check_inertia(self, q: np.ndarray) -> None:
        """Refuses values with which some posture among q (b, n) has no inertia.

        Raises:
            DataError: says how often, and which joint is lightest.
        """
        still = np.zeros((len(q), len(self.model.spec.signals)))
        _, least, light = scale_inertia(
            self.model.inertia_matrix(self.extend(q, still, 0), self.beta)
        )
        names = [joint.name for joint in self.model.spec.joints]
        names += [self.model.spec.signals[k].joint for k in self.model.spec.windups]
        if (bad := least < THRESHOLDS.min_inertia_eigenvalue).any():
            raise DataError(
                f"{self.model.spec.robot}: with the fitted values the inertia matrix is not "
                f"positive definite in {format_percent(float(np.mean(bad)))} of the postures, most "
                f"at joint {names[light]}, so no motion follows from a "
                "torque; expected the inertia of a body; fit with `--method consistent`, or record "
                "more motion of that joint"
            )

    def compute_forces(
        self,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        s: np.ndarray | None,
        dry: np.ndarray | None = None,
    ) -> Forces:
        """Computes the forces that act in states.

        Args:
            q: (b, n) positions.
            qd: (b, n) speeds.
            qdd: about what the acceleration is: it enters friction that depends on the load.
            s: (b, m) signals.
            dry: (b, k) bounds of dry friction where they are known from a state nearby.
        """
        M = self.model.inertia_matrix(q, self.beta)
        C = self.compute_shaft_directions(q)
        if not self.shafts:
            return Forces(M, self._compute_smooth_part(M, q, qd, qdd, s), C, np.zeros((len(q), 0)))
        away = _add_creep(C, qd)
        if dry is None:
            dry = self._estimate_dry_bounds(M, C, q, away, qdd, s)
        friction = np.einsum("bkn,bk->bn", C, dry * np.sign(_compute_shaft_speeds(C, away)))
        return Forces(M, self._compute_smooth_part(M, q, away, qdd, s) - friction, C, dry)

    def compute_smooth_forces(
        self, forces: Forces, q: np.ndarray, qd: np.ndarray, s: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Computes M (b, n, n) and h (b, n) beside a state of known forces, dry friction unchanged.

        For difference quotients: steps that are small beside the state, or cross standstill.
        """
        M = self.model.inertia_matrix(q, self.beta)
        rest = self._compute_smooth_part(M, q, qd, np.zeros_like(q), s)
        C = forces.C if self.model.spec.closure is None else self.compute_shaft_directions(q)
        friction = np.einsum("bkn,bk->bn", C, forces.dry * np.sign(_compute_shaft_speeds(C, qd)))
        return M, rest - friction

    def compute_shaft_directions(self, q: np.ndarray) -> np.ndarray:
        """Returns (b, k, n) rows of C."""
        if self.model.spec.closure is None:
            return np.broadcast_to(self._rows, (len(q), *self._rows.shape))
        return self.robot.coupling(q)[:, self._places]

    def advance_signals(
        self, s: np.ndarray, step: np.ndarray, dt: float, motion: Sequence[np.ndarray]
    ) -> np.ndarray:
        """Returns (b, m) signals dt s later: joints moved by `step` to `motion` (q, qd, qdd)."""
        return self.model.advance(step, dt, s, *motion) if self.inner else s

    def _compute_smooth_part(
        self, M: np.ndarray, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, s: np.ndarray | None
    ) -> np.ndarray:
        tau = self.model.inverse_dynamics(q, qd, qdd, self.beta, s)
        return np.asarray(tau - np.einsum("bij,bj->bi", M, qdd))

    def _estimate_dry_bounds(
        self,
        M: np.ndarray,
        C: np.ndarray,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        s: np.ndarray | None,
    ) -> np.ndarray:
        """(b, k) half the leap of the torque where one shaft after the other turns."""
        b, k, n = C.shape
        way = np.linalg.solve(M, C.transpose(0, 2, 1))  # (b, n, k)
        shaft_compliance = np.einsum("bkn,bnk->bk", C, way)
        way = way / np.where(shaft_compliance > 0.0, shaft_compliance, 1.0)[:, None, :]
        still = qd[:, None, :] - (way * _compute_shaft_speeds(C, qd)[:, None, :]).transpose(0, 2, 1)
        apart = THRESHOLDS.creep_speed * way.transpose(0, 2, 1)
        states = np.stack([still + apart, still - apart]).reshape(-1, n)  # (2 b k, n)

        def repeat_for_shafts(values: np.ndarray) -> np.ndarray:
            return np.tile(np.repeat(values, k, axis=0), (2, 1))

        tau = self.model.inverse_dynamics(
            repeat_for_shafts(q),
            states,
            repeat_for_shafts(qdd),
            self.beta,
            None if s is None else repeat_for_shafts(s),
        )
        leap = tau.reshape(2, b, k, n)
        half = 0.5 * (leap[0] - leap[1])
        squared = np.einsum("bkn,bkn->bk", C, C)
        along = np.einsum("bkn,bkn->bk", C, half) / np.where(squared > 0.0, squared, 1.0)
        return np.maximum(along, 0.0)  # below 0: no friction, but a fault of the fit; it stays in h


def _compute_shaft_speeds(C: np.ndarray, qd: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("bkn,bn->bk", C, qd))


def _add_creep(C: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """qd with shafts that stand made to creep, so that the C and we see the same sign."""
    speeds = _compute_shaft_speeds(C, qd)
    standing = np.abs(speeds) < THRESHOLDS.max_still_speed
    if not standing.any():
        return qd
    there = standing.any(axis=1)
    pushed = np.where(standing[there], THRESHOLDS.creep_speed, 0.0)
    moved = qd.copy()
    moved[there] += np.einsum("bnk,bk->bn", np.linalg.pinv(C[there]), pushed)
    return moved


# Whether errors of a free run grow by the robot's nature, whatever the model.
#
# Along the logged motion a small error x = (dq, dqd) obeys x' = A(t) x, A the derivative of
#
#     (qd, M(q)^-1 (tau - h(q, qd) - C^T a sigma))
#
# with the torques as logged and dry friction as it is (it can only hold). Over a run of T seconds x
# becomes Phi x. Its rate is ln(spectral radius of Phi) / T, 1/s: Lyapunov's first exponent if T is
# long, the largest real part of an eigenvalue if A is constant; it does not hang on units. Errors
# double in ln 2 / rate. A joint that nothing pulls back to a place has a rate of 0 at best, and an
# error of its torque is integrated twice.


_GROWN = np.log(10.0)  # an error that becomes tenfold in the run is reported
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
class SteepestGrowth:
    """The moment at which a small error grows fastest.

    Attributes:
        rate: 1/s, largest real part of an eigenvalue of A.
        log: its name.
        time: s, in the log.
    """

    rate: float
    log: str
    time: float


@dataclass(frozen=True)
class Stability(ShortRepr, Document):
    """What becomes of small errors along the motion.

    Attributes:
        rate: 1/s, of the run in which it is largest; below 0 they fade.
        seconds: of that run.
        steepest: 1/s, largest real part of an eigenvalue of A at one time of all runs.
        log: where that was.
        at: s, when.
        fastest: 1/s, largest absolute value of an eigenvalue: how fine a step must be.
    """

    KEYS = "is_unstable rate doubling_time seconds steepest=steepest_growth"

    rate: float
    seconds: float
    steepest: float
    log: str
    steepest_time: float
    fastest: float

    @property
    def doubling_time(self) -> float | None:
        """Returns the time, s, in which an error doubles; None if none does."""
        return float(np.log(2.0) / self.rate) if self.rate > 0.0 else None

    @property
    def is_unstable(self) -> bool:
        """Returns True if an error grows at least tenfold in that run."""
        return bool(self.rate * self.seconds > _GROWN)

    def describe(self) -> str:
        """Describes the growth of errors in a sentence."""
        growth = self.rate * self.seconds
        if self.is_unstable:
            tens = f"1e{growth / np.log(10.0):.0f}"
            times = f"{np.exp(growth):.2g}" if growth < 25.0 else tens
            return (
                "unstable by nature: along this motion any error doubles every "
                f"{self.doubling_time:.2g} s, {times} times in {self.seconds:.3g} s, whatever the "
                f"model; steepest at {self.steepest_time:.4g} s of {self.log}. A long free run "
                "says nothing here: judge by the windows"
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

    @property
    def steepest_growth(self) -> "SteepestGrowth":
        """Returns where an error grows fastest."""
        return SteepestGrowth(self.steepest, self.log, self.steepest_time)


def analyse_stability(plant: FittedPlant, runs: Sequence[LoggedMotion]) -> Stability:
    """Analyses the stability of the robot linearised along logged motions."""
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
                growth / seconds,
                seconds,
                float(steep[worst]),
                run.name,
                float(run.time[worst]),
                float(np.abs(values).max()),
            )
        )
    grown = max(results, key=lambda result: result.rate * result.seconds)
    steepest = max(results, key=lambda result: result.steepest)
    return Stability(
        grown.rate,
        grown.seconds,
        steepest.steepest,
        steepest.log,
        steepest.steepest_time,
        max(result.fastest for result in results),
    )


def compute_jacobians(plant: FittedPlant, run: LoggedMotion) -> np.ndarray:
    """Computes (p, 2n, 2n) A by central differences."""
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
        e[j] = THRESHOLDS.difference_step
        by_q = compute_acceleration(run.q + e, run.qd) - compute_acceleration(run.q - e, run.qd)
        by_qd = compute_acceleration(run.q, run.qd + e) - compute_acceleration(run.q, run.qd - e)
        A[:, n:, j], A[:, n:, n + j] = (
            by_q / (2 * THRESHOLDS.difference_step),
            by_qd / (2 * THRESHOLDS.difference_step),
        )
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
    """Returns 100 (1 - |q - q_s| / |q - mean q|), %, of samples (p,), as MATLAB's `compare` does.

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
    """Returns (b, n) s until |error| (samples, b, n) first exceeds `bound` (n,); else infinite.

    What is not finite has passed it; samples after the end of a start are 0.
    """
    passed = ~(np.abs(error) <= bound)
    first = np.argmax(passed, axis=0).astype(float) * step
    return np.where(passed.any(axis=0), first, np.inf)


def compute_ranges(q: np.ndarray, units: list[str]) -> np.ndarray:
    """Returns (n,) ranges of positions (p, n); NaN for a joint that hardly moves."""
    ranges = np.ptp(q, axis=0)
    least = np.array([_IDLE[unit] for unit in units])
    return np.where(ranges > least, ranges, np.nan)
