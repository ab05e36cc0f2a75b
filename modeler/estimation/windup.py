"""Elastic joints: the windup between motor and link, and the fit of stiffness and damping.

With e = q_motor - q_link of E elastic joints, the logged motion q being the motors', and ID the
torque of the links alone, linear in beta (Spong 1987):

    K e + D e' = [ID(q - e, qd - e', qdd - e'')]_E,
    tau = ID(q - e, qd - e', qdd - e'') + Ia qdd + friction(qd) + offsets.

The first equation, driven by the measured motion, is stable. Its slopes are those of the torque of
the links by position, speed and acceleration of the elastic joints, G, B and M:

    M de'' + (D + B) de' + (K + G) de = r,  d tau = -(G de + B de' + M de''),

with r = [W_i]_E for the parameter beta_i of the links, -K e for ln K, -D e' for ln D. That is a
linear equation for Newton's steps on e, and for all slopes that a Gauss-Newton fit needs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.linalg import solve_banded

from modeler.core.errors import DataError
from modeler.core.json import ShortRepr
from modeler.estimation.parameters import ParameterEstimate
from modeler.estimation.result import FitResult
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import solve_scaled_least_squares
from modeler.regression import (
    FilteredSegment,
    Observation,
    compute_prior_weights,
    compute_signals,
    filter_segment,
    find_shafts,
    rebuild_observation,
)
from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class Motion(ShortRepr):
    """The motion of one segment at even times; n samples, J joints.

    Attributes:
        q, qd, qdd: (n, J).
        step: s.
        signals: (n, m) what effects read besides; None without any.
    """

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    step: float
    signals: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Windup(ShortRepr):
    """A robot with E elastic joints; c base parameters of its module, which may be rigid.

    Attributes:
        compiled: the module.
        joints: indices of the elastic joints.
        beta: (c,) base parameters.
        rotors: (E,) rotor inertias beside beta, kg m2 or kg; 0 where beta has them.
        stiffness: (E,) N m/rad or N/m.
        damping: (E,) N m s/rad or N s/m.
        spread: (2 E, 2 E) covariance of ln K, then ln D, from sums over blocks.
    """

    compiled: CompiledModel
    joints: tuple[int, ...]
    beta: np.ndarray
    rotors: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    spread: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))

    @cached_property
    def is_link_column(self) -> np.ndarray:
        """Returns (c,) True for the columns that the links move."""
        return np.array([base.kind == "inertial" for base in self.compiled.spec.base])

    @cached_property
    def lacks_rotor(self) -> np.ndarray:
        """Returns (E,) True where no base parameter is the rotor inertia alone."""
        spec = self.compiled.spec
        rotors = {p.name: p.joint for p in spec.standard if p.effect == "rotor_inertia"}
        alone = {rotors.get(base.column_of) for base in spec.base if len(base.terms) == 1}
        return np.array([spec.joints[j].name not in alone for j in self.joints])

    @cached_property
    def groups_rotor(self) -> np.ndarray:
        """Returns (E,) True where the rotor inertia is grouped with the links'."""
        spec = self.compiled.spec
        rotors = {p.joint for p in spec.standard if p.effect == "rotor_inertia"}
        here = np.array([spec.joints[j].name in rotors for j in self.joints])
        return self.lacks_rotor & here

    def _shift(self, motion: Motion, s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The motion of the links, for s (n, 3, E)."""
        moved = motion.q.copy(), motion.qd.copy(), motion.qdd.copy()
        for k, x in enumerate(moved):
            x[:, list(self.joints)] -= s[:, k]
        return moved

    def _read(self, motion: Motion) -> np.ndarray | None:
        return None if motion.signals is None else np.zeros_like(motion.signals)

    def compute_columns(self, motion: Motion, s: np.ndarray) -> np.ndarray:
        """Computes the columns (n, J, c + E): links where s has them, motors as measured."""
        n, J = motion.q.shape
        q, qd, qdd = self._shift(motion, s)
        links = self.compiled.base_regressor(q, qd, qdd, self._read(motion))
        motors = self.compiled.base_regressor(motion.q, motion.qd, motion.qdd, motion.signals)
        rotors = np.zeros((n, J, len(self.joints)))
        for k, j in enumerate(self.joints):
            if self.lacks_rotor[k]:
                rotors[:, j, k] = motion.qdd[:, j]
        return np.concatenate([np.where(self.is_link_column, links, motors), rotors], axis=2)

    def compute_slopes(self, motion: Motion, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Computes the links' torque (n, J), and its slopes G, B, M (3, n, J, E).

        The torque is quadratic in the speeds and linear in the accelerations.
        """
        links = np.where(self.is_link_column, self.beta, 0.0)
        q, qd, qdd = moved = self._shift(motion, s)
        read = self._read(motion)

        def evaluate(k: int, j: int, size: float) -> np.ndarray:
            there = list(moved)
            there[k] = there[k].copy()
            there[k][:, j] += size
            return self.compiled.inverse_dynamics(there[0], there[1], there[2], links, read)

        torque = self.compiled.inverse_dynamics(q, qd, qdd, links, read)
        slopes = np.empty((3, *torque.shape, len(self.joints)))
        for i, j in enumerate(self.joints):
            for k, size in enumerate((THRESHOLDS.windup_position_step, 1.0)):
                both = evaluate(k, j, size) - evaluate(k, j, -size)
                slopes[k, :, :, i] = both / (2.0 * size)
            slopes[2, :, :, i] = evaluate(2, j, 1.0) - torque
        return torque, slopes

    def solve_linear(self, step: float, slopes: np.ndarray, right: np.ndarray) -> np.ndarray:
        """Solves M x'' + (D + B) x' + (K + G) x = r (n, E, R): (n, 3, E, R).

        It starts where it rests under the first r, at the speed to rest under the next.


        By Newmark's method with beta = 1/12, gamma = 1/2: x_k = x + h v + h^2 (5/12 a + 1/12 a_k),
        v_k = v + h/2 (a + a_k). It is of fourth order but for that speed, to which the damping adds
        its error, h (a - a_k) / 12. All steps are one banded system.
        """
        G, B, M = slopes[:, :, self.joints]
        n, E, R = right.shape
        h, share = step, THRESHOLDS.windup_newmark_beta
        eye = np.broadcast_to(np.eye(E), (n, E, E))
        width, low, up = 3 * E, 4 * E, 2 * E
        damping = eye * self.damping + B
        later = damping * (-h / 12.0)
        later[0] = 0.0
        banded = np.zeros((low + up + 1, width * n))

        def put(block: np.ndarray, row: int, column: int, first: int = 0, back: int = 0) -> None:
            """Blocks (n, E, E) at a row and a column of E from sample first on, or before."""
            at = width * (np.arange(first, n) - back)
            for a in range(E):
                for b in range(E):
                    i, k = row * E + a + width * back, column * E + b
                    banded[up + i - k, at + k] = block[first:, a, b]

        put(eye, 0, 0)
        put(-h * h * share * eye, 0, 2, 1)
        put(eye, 1, 1)
        put(-0.5 * h * eye, 1, 2, 1)
        put(eye * self.stiffness + G, 2, 0)
        put(damping, 2, 1)
        put(M + later, 2, 2)
        before = [(0, 0, -1.0), (0, 1, -h), (0, 2, -h * h * (0.5 - share))]
        for row, column, value in (*before, (1, 1, -1.0), (1, 2, -0.5 * h)):
            put(value * eye, row, column, 1, 1)
        put(-later, 2, 2, 1, 1)
        sides = np.zeros((n, 3, E, R))
        sides[:, 2] = right
        flat = sides.reshape(width * n, R)
        try:
            still = np.linalg.solve(eye[:2] * self.stiffness + G[:2], right[:2])
            sides[0, :2] = still[0], (still[-1] - still[0]) / h
            sides[0, 2] += damping[0] @ sides[0, 1]
            x = solve_banded((low, up), banded, flat, check_finite=False, overwrite_ab=True)
        except np.linalg.LinAlgError:  # an inertia that is not positive
            x = np.full(flat.shape, np.nan)
        return np.asarray(x.reshape(n, 3, E, R))

    def advance_solution(self, motion: Motion, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Advances s (n, 3, E) by one step of Newton's method; and the slopes where it began."""
        torque, slopes = self.compute_slopes(motion, s)
        known = np.einsum("knab,nkb->na", slopes[:, :, self.joints], s)
        right = torque[:, self.joints] + known
        return self.solve_linear(motion.step, slopes, right[:, :, None])[..., 0], slopes

    def integrate(
        self, motion: Motion, near: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Integrates the windup, (n, 3, E) e, e', e'' along a motion, and the slopes there.

        By Newton's method from a windup near it, or from none; NaN where that is of no use.
        """
        s = np.zeros((len(motion.q), 3, len(self.joints))) if near is None else near
        for _ in range(THRESHOLDS.windup_newton_steps):
            (s, slopes), last = self.advance_solution(motion, s), s
            if not np.abs(s).max() < THRESHOLDS.max_windup:
                return np.full(s.shape, np.nan), slopes
            change = np.abs(s[:, 0] - last[:, 0]).max()
            if not change > THRESHOLDS.windup_tolerance * np.abs(s[:, 0]).max():
                break
        return s, slopes

    def compute_torque_change(self, motion: Motion) -> np.ndarray:
        """Computes (n, J) the torque beyond that of rigid joints with the same beta."""
        with np.errstate(all="ignore"):
            s, _ = self.integrate(motion)
        if not np.isfinite(s).all():
            return np.full(motion.q.shape, np.nan)
        columns = self.compute_columns(motion, s)
        rotors = columns[:, :, len(self.beta) :] * (self.rotors * ~self.groups_rotor)
        read = motion.signals
        rigid = self.compiled.base_regressor(motion.q, motion.qd, motion.qdd, read)
        change = (columns[:, :, : len(self.beta)] - rigid) @ self.beta
        return np.asarray(change + rotors.sum(axis=2))

    def compute_inertia(self, motions: Sequence[Motion]) -> np.ndarray:
        """Computes (E,) the median inertia of the links on each elastic joint."""
        links = np.where(self.is_link_column, self.beta, 0.0)
        q = np.concatenate([motion.q[::20] for motion in motions])
        diagonal = np.diagonal(self.compiled.inertia_matrix(q, links), axis1=1, axis2=2)
        return np.asarray(np.median(diagonal, axis=0)[list(self.joints)])

    def compute_resonances(self, motions: Sequence[Motion]) -> tuple[np.ndarray, np.ndarray]:
        """Computes frequencies (E,), Hz, motors locked, and damping ratios (E,)."""
        inertia = np.maximum(self.compute_inertia(motions), 1e-300)
        omega = np.sqrt(self.stiffness / inertia)
        return omega / (2.0 * np.pi), self.damping / (2.0 * omega * inertia)

    def add_joint(self, joint: int) -> "Windup":
        """Returns it with one elastic joint more, whose values are still to be set."""
        return replace(
            self,
            joints=(*self.joints, joint),
            rotors=np.append(self.rotors, 0.0),
            stiffness=np.append(self.stiffness, 1.0),
            damping=np.append(self.damping, 1.0),
        )

    def bound_resonances(self, motions: Sequence[Motion]) -> "Windup":
        """Returns it with resonances and damping ratios within bounds."""
        inertia = np.maximum(self.compute_inertia(motions), 1e-9)
        low, high = THRESHOLDS.windup_frequencies
        high = min(high, THRESHOLDS.max_windup_rate / max(motion.step for motion in motions))
        ends = (inertia * (2.0 * np.pi * f) ** 2 for f in (low, high))
        stiffness = np.clip(self.stiffness, *ends)
        critical = 2.0 * np.sqrt(stiffness * inertia)
        damping = np.clip(self.damping, *(critical * z for z in THRESHOLDS.windup_dampings))
        return replace(self, stiffness=stiffness, damping=damping)

    def set_resonances(
        self, motions: Sequence[Motion], frequency: float, joints: Sequence[int]
    ) -> "Windup":
        """Returns it with this resonance, Hz, of some joints."""
        inertia = np.maximum(self.compute_inertia(motions), 1e-9)
        some, omega = np.isin(self.joints, joints), 2.0 * np.pi * frequency
        stiffness = np.where(some, inertia * omega**2, self.stiffness)
        damping = np.where(some, 2.0 * THRESHOLDS.windup_damping * omega * inertia, self.damping)
        return replace(self, stiffness=stiffness, damping=damping)


def read_windup(compiled: CompiledModel, beta: np.ndarray) -> Windup:
    """Reads the elastic joints that a module has, with the values that it winds up with."""
    spec, E = compiled.spec, len(compiled.spec.windups)
    names = [joint.name for joint in spec.joints]
    joints = tuple(names.index(spec.signals[place].joint) for place in spec.windups)
    values = spec.elastic if compiled.windup_values is None else compiled.windup_values[1]
    stiffness, damping = np.array(values, dtype=float).reshape(2, E)
    return Windup(compiled, joints, beta, np.zeros(E), stiffness, damping)


@dataclass(frozen=True, eq=False)
class _Turn:
    """One evaluation of a fit."""

    windup: Windup
    states: list[np.ndarray]  # (n, 3, E) by segment
    extra_values: np.ndarray  # (m,)
    jacobian: np.ndarray  # (rows, free + m + E + 2 E)
    residual: np.ndarray  # (rows,)
    cost: float


@dataclass(frozen=True, eq=False)
class WindupProblem(ShortRepr):
    """Rows that beta, K and D are fitted to; J joints.

    Attributes:
        motions: by segment.
        filter_rows: from values (n, J, k) by segment to rows (rows_j, k) by joint.
        y: (rows_j,) torques by joint.
        block: (rows_j,) by joint, number of the block of time.
        free: indices of the base parameters that are fitted.
        extra: (rows_j, m) by joint, columns of further effects.
        prior: (p, free + m + 1) what is known beforehand, of weight 1.
        is_elastic_fixed: True if K and D stay as they are.
    """

    motions: Sequence[Motion]
    filter_rows: Callable[[Sequence[np.ndarray]], Sequence[np.ndarray]]
    y: Sequence[np.ndarray]
    block: Sequence[np.ndarray]
    free: np.ndarray
    extra: Sequence[np.ndarray]
    prior: np.ndarray
    is_elastic_fixed: bool = False

    @cached_property
    def row_joint(self) -> np.ndarray:
        """Returns the joint of each row, (rows,)."""
        return np.repeat(np.arange(len(self.y)), [len(y) for y in self.y])

    def evaluate(
        self, windup: Windup, states: Sequence[np.ndarray | None], extra: np.ndarray
    ) -> _Turn:
        """Evaluates residuals and slopes, from states (n, 3, E) of the segments near these."""
        c, E, after, every = len(windup.beta), len(windup.joints), [], []
        links = np.append(windup.is_link_column, np.zeros(E, dtype=bool))
        lost = _Turn(windup, [], extra, np.zeros((0, 0)), np.zeros(0), np.inf)
        for motion, near in zip(self.motions, states, strict=True):
            s, slopes = windup.integrate(motion, near)
            if not np.isfinite(s).all():
                return lost
            columns = windup.compute_columns(motion, s)
            forces = windup.stiffness * s[:, 0], windup.damping * s[:, 1]
            sides = [np.where(links, columns[:, list(windup.joints)], 0.0)[:, :, :c]]
            sides += [-force[:, :, None] * np.eye(E) for force in forces]
            moved = windup.solve_linear(motion.step, slopes, np.concatenate(sides, axis=2))
            along = np.moveaxis(slopes, 0, 2).reshape(*columns.shape[:2], 3 * E)
            change = -along @ moved.reshape(len(s), 3 * E, -1)
            torque = columns @ np.concatenate([windup.beta, windup.rotors])
            columns[:, :, :c] += change[:, :, :c]
            every.append(np.concatenate([columns, change[:, :, c:], torque[:, :, None]], axis=2))
            after.append(s)
        rows = np.concatenate(list(self.filter_rows(every)))
        extra_rows = np.concatenate(list(self.extra))
        order = [*self.free, *range(c, rows.shape[1] - 1)]
        m = len(self.free)
        jacobian = np.hstack([rows[:, order[:m]], extra_rows, rows[:, order[m:]]])
        residual = np.concatenate(list(self.y)) - rows[:, -1] - extra_rows @ extra
        finite = bool(np.isfinite(residual).all() and np.isfinite(jacobian).all())
        cost = self._compute_cost(residual) if finite else np.inf
        return _Turn(windup, after, extra, jacobian, residual, cost)

    def compute_sigma(self, residual: np.ndarray) -> np.ndarray:
        """Computes the rms (J,) of the rows of each joint; 1 without any."""
        count = np.bincount(self.row_joint, minlength=len(self.y))
        square = np.bincount(self.row_joint, residual**2, len(self.y))
        return np.sqrt(np.where(square > 0.0, square, 1.0) / np.maximum(count, 1))

    def _compute_cost(self, residual: np.ndarray) -> float:
        """Minus the logarithm of the likelihood, each joint with a sigma of its own."""
        sigma = self.compute_sigma(residual)
        return float(np.sum(np.log(sigma[self.row_joint])))

    def _solve(self, turn: _Turn) -> np.ndarray:
        """The next values: free beta, extra, rotors, changes of ln K and ln D."""
        weight = 1.0 / self.compute_sigma(turn.residual)[self.row_joint]
        windup, p = turn.windup, turn.jacobian.shape[1]
        now = np.concatenate([windup.beta[self.free], turn.extra_values, windup.rotors])
        now = np.append(now, np.zeros(p - len(now)))
        A = turn.jacobian * weight[:, None]
        b = (turn.residual + turn.jacobian @ now) * weight
        known = np.zeros((len(self.prior), p))
        known[:, : self.prior.shape[1] - 1] = self.prior[:, :-1]
        if self.is_elastic_fixed:
            A[:, p - 2 * len(windup.joints) :] = 0.0
        A, b = np.vstack([A, known]), np.append(b, self.prior[:, -1])
        R = np.asarray(np.linalg.qr(np.column_stack([A, b]), mode="r"))
        return solve_scaled_least_squares(R[:, :-1], R[:, -1], THRESHOLDS.windup_rank_share) - now

    def _move(self, turn: _Turn, step: np.ndarray, share: float) -> _Turn:
        """A turn with a share of a step taken."""
        windup, E, m = turn.windup, len(turn.windup.joints), len(turn.extra_values)
        step, f = share * step, len(self.free)
        beta = windup.beta.copy()
        beta[self.free] += step[:f]
        stiffness, damping = np.exp(step[-2 * E :]).reshape(2, E)
        after = replace(
            windup,
            beta=beta,
            rotors=windup.rotors + step[f + m : f + m + E],
            stiffness=windup.stiffness * stiffness,
            damping=windup.damping * damping,
        )
        with np.errstate(all="ignore"):
            after = after.bound_resonances(self.motions)
            return self.evaluate(after, turn.states, turn.extra_values + step[f : f + m])

    def iterate(self, turn: _Turn, turns: int) -> _Turn:
        """Improves a turn by steps of Gauss-Newton, each shortened until the cost falls."""
        E = len(turn.windup.joints)
        for _ in range(turns):
            step = self._solve(turn)
            far = float(np.abs(step[-2 * E :]).max())
            share = min(1.0, THRESHOLDS.max_windup_step / max(far, 1e-300))
            after = self._move(turn, step, share)
            while not after.cost < turn.cost and share * far > THRESHOLDS.windup_precision:
                share *= 0.4
                after = self._move(turn, step, share)
            if not after.cost < turn.cost:
                break
            turn = after
            if share * far < THRESHOLDS.windup_precision:
                break
        return turn

    def start_turn(self, windup: Windup) -> _Turn:
        """Evaluates values that no turn was near."""
        with np.errstate(all="ignore"):
            none = np.zeros(self.extra[0].shape[1])
            return self.evaluate(windup, [None] * len(self.motions), none)

    def solve_rigid(self, windup: Windup) -> np.ndarray:
        """Solves for beta (c,) of rigid joints, whose rotors are a part of the links."""
        still = [np.zeros((len(motion.q), 3, len(windup.joints))) for motion in self.motions]
        pairs = zip(self.motions, still, strict=True)
        columns = self.filter_rows([windup.compute_columns(*pair) for pair in pairs])
        weight = 1.0 / self.compute_sigma(np.concatenate(list(self.y)))[self.row_joint]
        c = len(windup.beta)
        A = np.concatenate(list(columns))[:, :c] * weight[:, None]
        A = np.vstack([A, self.prior[:, :-1]])
        b = np.append(np.concatenate(list(self.y)) * weight, self.prior[:, -1])
        return solve_scaled_least_squares(A, b, THRESHOLDS.windup_rank_share)

    def fit(self, start: Windup, free_joints: Sequence[int] = ()) -> Windup | None:
        """Fits beta, K and D; None where no start can be integrated.

        Args:
            start: with its K and D.
            free_joints: those whose K and D begin at several resonances; the best goes on.
        """
        loose = replace(start, damping=THRESHOLDS.start_damping_factor * start.damping)
        starts = [start, loose]  # whose cost has fewer minima
        if free_joints:
            of = THRESHOLDS.windup_starts
            starts = [start.set_resonances(self.motions, f, free_joints) for f in of]
        every = THRESHOLDS.max_windup_turns
        first, turns = THRESHOLDS.first_windup_turns if free_joints else every, []
        for windup in starts:
            turn = self.start_turn(windup)
            if np.isfinite(turn.cost):
                turns.append(self.iterate(turn, first))
        if not turns:
            return None
        best = self.iterate(min(turns, key=lambda turn: turn.cost), every)
        return replace(best.windup, spread=self._compute_spread(best))

    def _compute_spread(self, turn: _Turn) -> np.ndarray:
        """(2 E, 2 E) covariance of ln K and ln D, from sums over blocks of time."""
        weight = 1.0 / self.compute_sigma(turn.residual)[self.row_joint]
        A, block = turn.jacobian * weight[:, None], np.concatenate(list(self.block))
        size = np.linalg.norm(A, axis=0)
        A = A / np.where(size > 0.0, size, 1.0)
        inverse = np.linalg.pinv(A.T @ A, rcond=1e-12, hermitian=True)
        sums = np.zeros((int(block.max()) + 1, A.shape[1]))
        np.add.at(sums, block, A * (turn.residual * weight)[:, None])
        E = len(turn.windup.joints)
        root = (sums @ inverse / np.where(size > 0.0, size, 1.0))[:, -2 * E :]
        return np.asarray(root.T @ root)


# The rows of an observation, for a robot whose file has elastic joints.


@dataclass(frozen=True, eq=False)
class ElasticEstimate(ShortRepr):
    """Elastic joints of a robot file, fitted to an observation; s samples, J joints.

    Attributes:
        windup: the robot, with beta of the rows of the observation, K and D of a wider band.
        columns: (s, J, c) slopes of the torque by beta, the windup's own included.
        torque: (s, J) at beta.
        slopes: (c, 2 E) of beta by ln K and ln D.
    """

    windup: Windup
    columns: np.ndarray
    torque: np.ndarray
    slopes: np.ndarray

    @property
    def values(self) -> np.ndarray:
        """Returns (2 E,) stiffnesses, then dampings."""
        return np.concatenate([self.windup.stiffness, self.windup.damping])

    def list_estimates(self) -> tuple[ParameterEstimate, ...]:
        """Lists K of all elastic joints, then D, with their standard deviations."""
        joints = [self.windup.compiled.spec.joints[j] for j in self.windup.joints]
        sigmas = self.values * np.sqrt(np.diag(self.windup.spread))
        names = [f"{what}{joint.name}" for what in "KD" for joint in joints]
        tails = [f"/{joint.unit}" for joint in joints] + [f" s/{joint.unit}" for joint in joints]
        units = [f"{j.effort_unit}{tail}" for j, tail in zip(joints * 2, tails, strict=True)]
        every = zip(names, units, self.values.tolist(), sigmas.tolist(), strict=True)
        return tuple(ParameterEstimate(*one, True, "estimated") for one in every)

    def linearise_rows(self, observation: Observation) -> tuple[Observation, np.ndarray]:
        """Returns the observation with W the slopes by beta, and the y (rows,) that goes with W."""
        model = self.windup.compiled.set_windup(self.windup.beta, self.values)
        seen = rebuild_observation(model, observation)
        vars(seen)["columns"] = self.columns
        torque = observation.torque - self.torque + self.columns @ self.windup.beta
        return seen, torque[observation.used]

    def extend_fit(self, fit: FitResult) -> FitResult:
        """Returns the fit with K and D, and with what these leave open in its covariance."""
        is_known = np.array([p.sigma is not None for p in fit.parameters])
        more = self.slopes @ self.windup.spread @ self.slopes.T
        covariance = fit.covariance + more * np.outer(is_known, is_known)
        pairs = zip(fit.parameters, np.sqrt(np.diag(covariance)).tolist(), strict=True)
        every = tuple(p if p.sigma is None else replace(p, sigma=sigma) for p, sigma in pairs)
        elastic = self.list_estimates()
        return replace(fit, parameters=every, covariance=covariance, elastic=elastic)


def fit_elastic_joints(observation: Observation, model: CompiledModel) -> ElasticEstimate:
    """Fits the elastic joints of a robot file.

    K and D are those of rows up to the resonances, of the same samples; beta is that of the rows of
    the observation. Both begin with the values of the file.

    Args:
        observation: of the robot.
        model: it.

    Raises:
        DataError: no K and D near those of the file can be integrated.
    """
    start = read_windup(model, np.zeros(len(model.spec.base)))
    E = len(start.joints)
    parts = [_widen_rows(part, observation, model) for part in observation.stretches]
    wide_problem = _build_problem(parts, observation, model)
    beta = wide_problem.solve_rigid(start)
    wide = wide_problem.fit(replace(start, beta=beta))
    if wide is None:
        raise _build_error(observation, model)
    problem = _build_problem(observation.stretches, observation, model)
    problem = replace(problem, is_elastic_fixed=True)
    turn = problem.start_turn(wide)
    if not np.isfinite(turn.cost):
        raise _build_error(observation, model)
    turn = problem.iterate(turn, THRESHOLDS.max_windup_turns)
    windup, c = replace(turn.windup, spread=wide.spread), len(start.beta)
    weight = 1.0 / problem.compute_sigma(turn.residual)[problem.row_joint]
    weighted = turn.jacobian * weight[:, None]
    by_beta, by_elastic = weighted[:, :c], weighted[:, -2 * E :]
    slopes = -solve_scaled_least_squares(by_beta, by_elastic, THRESHOLDS.windup_rank_share)
    values = np.concatenate([windup.stiffness, windup.damping])
    rows = rebuild_observation(model.set_windup(windup.beta, values), observation)
    used, columns = observation.used, rows.columns.copy()
    for j in range(used.shape[1]):
        columns[used[:, j], j] = turn.jacobian[problem.row_joint == j, :c]
    return ElasticEstimate(windup, columns, rows.predict(windup.beta), slopes)


def _build_error(observation: Observation, model: CompiledModel) -> DataError:
    return DataError(
        f"{', '.join(observation.logs)}: no motion of the elastic joints of {model.spec.robot} "
        "fits these logs; check K and D in the robot file"
    )


def _widen_rows(
    part: FilteredSegment, observation: Observation, model: CompiledModel
) -> FilteredSegment:
    """The rows of a segment through a parallel filter that lets resonances pass."""
    chosen = observation.report.processing
    highest = chosen.position_cutoff or 0.5 / part.segment.step
    cutoff = max(chosen.parallel_cutoff, min(THRESHOLDS.windup_band, 0.5 * highest))
    wide = replace(chosen, parallel_cutoff=cutoff, decimation=None)
    return filter_segment(part.segment, find_shafts(model), wide)


def _build_problem(
    parts: Sequence[FilteredSegment], observation: Observation, model: CompiledModel
) -> WindupProblem:
    """The rows of segments, by joint; columns of a few samples, as far as these are smooth."""
    thin, motions = [], []
    for part in parts:
        step = part.segment.step
        every = max(1, int(THRESHOLDS.windup_sampling / step))
        read = compute_signals(model, part.segment)
        few = part.thin_samples(every, read) if every > 1 else part
        thin.append(few)
        s, read = few.segment, None if read is None else read[::every]
        motions.append(Motion(s.q, s.qd, s.qdd, s.step, read))
    used = np.concatenate([part.used for part in parts])
    torque = np.concatenate([part.filter_torque() for part in parts])
    time = np.concatenate([part.segment.time[part.rows.centres] for part in parts])
    run = np.concatenate([np.full(len(p.rows.centres), p.segment.run) for p in parts])
    number = np.floor(time / THRESHOLDS.windup_block).astype(int)
    block = np.unique(np.column_stack([run, number]), axis=0, return_inverse=True)[1].ravel()
    joints = range(used.shape[1])

    def filter_rows(values: Sequence[np.ndarray]) -> list[np.ndarray]:
        pairs = zip(thin, values, strict=True)
        rows = np.concatenate([part.filter_columns(x.__getitem__) for part, x in pairs])
        return [rows[used[:, j], j] for j in joints]

    weights = compute_prior_weights(observation)
    prior = np.column_stack([np.diag(weights), np.zeros(len(weights))])
    return WindupProblem(
        motions,
        filter_rows,
        [torque[used[:, j], j] for j in joints],
        [block[used[:, j]] for j in joints],
        np.arange(len(weights)),
        [np.zeros((int(used[:, j].sum()), 0)) for j in joints],
        prior[weights > 0.0],
    )
