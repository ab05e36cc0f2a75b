"""Two-step identification: first the torques while one joint moves alone, then the parameters.

Step 1: at each configuration of the others, joint i moves alone, and least squares of its torque on
[qdd, sin q, cos q, sign qd] give its inertia J_ii, gravity and friction there; those of the other
joints give J_ki and S_kii wherever their motors turn, or have no dry friction. Step 2: all these
coefficients are linear in the base parameters, theta = Phi beta, with Phi from the model, and beta
is the least squares of them, weighted by the covariance of step 1 (Hanssen, Hovland and Brogardh
2000, section 5, with Phi of the closed form; here it is that of the emitted base regressor).
"""

import dataclasses
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from modeler.core.choices import TWO_STEPS
from modeler.core.errors import DataError
from modeler.core.json import Document, select_attributes
from modeler.core.table import format_percent
from modeler.estimation import single_joint
from modeler.estimation.covariance import estimate_autocorrelation
from modeler.estimation.identify import (
    build_base_equations,
    build_result,
    compress_all_rows,
    identify,
)
from modeler.estimation.least_squares import Estimate, solve_least_squares
from modeler.estimation.parameters import select_essential_parameters
from modeler.estimation.result import FitResult
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.filters import LEAST_WEIGHT
from modeler.numerics.least_squares import CompressedRegression, compress_rows
from modeler.regression import DataWarning, Observation
from modeler.runtime import CompiledModel

# Step 1 and step 2.


@dataclass(frozen=True, eq=False)
class FirstStep:
    """Holds step 1 for the torque of one joint: y = Q R theta + residual; p coefficients.

    Attributes:
        joint: index.
        along: the functions and what they weigh.
        Q: (rows, p) orthonormal.
        R: (p, p).
        projected: (p,) Q^T y.
        residual: (rows,) N m or N.
    """

    joint: int
    along: single_joint.SingleJointMotion
    Q: np.ndarray
    R: np.ndarray
    projected: np.ndarray
    residual: np.ndarray


@dataclass(frozen=True, eq=False)
class Configuration:
    """Holds step 1 at one configuration of the joints that stand.

    Attributes:
        log: name.
        start, end: s.
        joint: index of the joint that moves.
        pose: (n,) positions of all joints, its own in the middle of its motion.
        first_steps: its own torque first, then those of other joints.
        noise: (torques, torques) covariance of their residuals, autocorrelation included.
    """

    log: str
    start: float
    end: float
    joint: int
    pose: np.ndarray
    first_steps: tuple[FirstStep, ...]
    noise: np.ndarray

    def compute_coefficients(self, k: int) -> list[tuple[str, float, float]]:
        """Returns function, theta and its standard deviation, of the k-th torque."""
        step = self.first_steps[k]
        theta = np.linalg.solve(step.R, step.projected)
        sigma = np.linalg.norm(np.linalg.inv(step.R), axis=1) * self.noise[k, k] ** 0.5
        return list(zip(step.along.names, theta.tolist(), sigma.tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class TwoStepEstimate:
    """Holds both steps of the estimate.

    Attributes:
        directions: how the coordinates move with each joint.
        configurations: step 1.
        left_out: pieces that were not used: reason -> how many.
        simultaneous_time: s, motion of several joints at a time.
        data: step 2, rows of standard deviation 1.
        estimate: of the base parameters.
    """

    directions: single_joint.JointDirections
    configurations: tuple[Configuration, ...]
    left_out: Mapping[str, int]
    simultaneous_time: float
    data: CompressedRegression
    estimate: Estimate


def estimate_two_steps(
    model: CompiledModel, observation: Observation, directions: single_joint.JointDirections
) -> TwoStepEstimate:
    """Returns the two-step estimate.

    Args:
        model: the robot.
        observation: of logs in which joints move one at a time.
        directions: how the coordinates move with each joint.

    Raises:
        DataError: no piece in which one joint moves and the others stand, or none long enough.
    """
    moves, several, total = single_joint.find_single_joint_moves(observation, directions)
    steps = [_solve_first_step(model, observation, directions, move) for move in moves]
    left_out = Counter(step for step in steps if isinstance(step, str))
    alike: dict[tuple[int, ...], list[Configuration]] = {}  # by who moves, and whose torque is used
    for step in steps:
        if isinstance(step, Configuration):
            alike.setdefault((step.joint, *(f.joint for f in step.first_steps)), []).append(step)
    if not alike:
        why = "".join(f"; {count} left out: {reason}" for reason, count in left_out.items())
        raise DataError(
            f"{', '.join(observation.logs)}: no piece in which one joint moves and the others "
            f"stand ({several:.3g} of {total:.3g} s are motion of several){why}; expected joints "
            "that move one after the other, as by `modeler simulate --motion one-joint`; use "
            "--method weighted for these logs"
        )
    configurations = [c for group in alike.values() for c in _estimate_noise(group)]
    data, estimate = _solve_second_step(observation, configurations)
    configurations.sort(key=lambda c: (c.joint, c.log, c.start))
    return TwoStepEstimate(directions, tuple(configurations), left_out, several, data, estimate)


def _solve_second_step(
    observation: Observation, configurations: Sequence[Configuration]
) -> tuple[CompressedRegression, Estimate]:
    """Returns base parameters from rows of standard deviation 1, and their covariance.

    Its scale is 1 as far as the residuals of step 1 show, which stand in the data as one row. It
    is raised where the configurations contradict each other by more.
    """
    rows, values = zip(*map(_whiten_rows, configurations), strict=True)
    W, y = np.vstack(rows), np.hstack(values)
    spare = sum(len(f.residual) - len(f.projected) for c in configurations for f in c.first_steps)
    every, alike = np.append(y, np.sqrt(spare)), np.zeros(len(y) + 1, dtype=int)
    data = compress_rows(np.vstack([W, 0.0 * W[:1]]), every, alike, 1, observation.names)
    data = dataclasses.replace(data, rows=np.array([len(y) + spare]))
    estimate = solve_least_squares(data, "ordinary")
    degrees = len(y) - len(estimate.rank.kept_columns)
    misfit = float(np.sum((y - W @ estimate.beta) ** 2)) / max(1, degrees)
    raised = max(1.0, misfit / float(estimate.sigma[0] ** 2))
    return data, dataclasses.replace(estimate, covariance=raised * estimate.covariance)


def _solve_first_step(
    model: CompiledModel,
    observation: Observation,
    directions: single_joint.JointDirections,
    move: single_joint.SingleJointMove,
) -> Configuration | str:
    """Returns least squares of torques while one joint moves; a text where that cannot be."""
    part, i = observation.stretches[move.part], move.joint
    segment, window, way = part.segment, move.window, directions.rows[i]
    if not all(observation.joints[k].actuated for k in np.flatnonzero(way)):
        return "the joint has no motor"
    inside = np.zeros((segment.samples, 1), dtype=bool)
    inside[window] = True
    share = part.rows.compute_usable_share(inside)[:, 0]
    numbers = np.flatnonzero(share >= THRESHOLDS.whole_weight)
    if not numbers.size:
        return "too short for the parallel filter"
    motion = (x[window] for x in (segment.q, segment.qd, segment.qdd))
    a, v, u = (directions.convert_to_joints(x) for x in motion)
    pose, span = np.median(a, axis=0), (a[:, i].min(), a[:, i].max())
    rows = part.rows.extract_rows(slice(int(numbers[0]), int(numbers[-1]) + 1), window)
    usable, others = _find_usable(part.usable[window], directions, i)
    used = rows.compute_usable_share(usable[:, None])[:, 0] >= LEAST_WEIGHT
    order, first_steps = [i, *others], list[FirstStep]()
    motions = single_joint.fit_single_joint_motions(
        model, pose @ directions.rows, pose[i], way, span, directions.rows[order]
    )
    for k, along in zip(order, motions, strict=True):
        if along is not None:
            columns = along.evaluate_columns(a[:, i], v[:, i], u[:, i])
            values = np.column_stack([columns, segment.tau[window] @ directions.rows[k]])
            filtered = rows.average_samples(values, usable)[used]
            if (solved := _fit_first_step(k, along, filtered)) is not None:
                first_steps.append(solved)
        if k == i and not first_steps:
            return (
                "other functions than those of one body that turns"
                if along is None
                else "too short to distinguish inertia, gravity and friction"
            )
    log, times = observation.logs[segment.run], segment.time[window]
    start, end, noise = float(times[0]), float(times[-1]), np.eye(len(first_steps))
    return Configuration(log, start, end, i, pose, tuple(first_steps), noise)


def _find_usable(
    usable: np.ndarray, directions: single_joint.JointDirections, i: int
) -> tuple[np.ndarray, list[int]]:
    """Returns (samples,) at which torques count, and the other joints whose torques do too.

    The torque of a joint is made of those of some motors. A motor with dry friction that stands
    says nothing: its samples are not usable.
    """
    rows = np.all(usable[:, directions.rows[i] != 0], axis=1)
    least = THRESHOLDS.min_seen_share * max(1, int(rows.sum()))
    others: list[int] = []
    for k, way in enumerate(directions.rows):
        both = rows & np.all(usable[:, way != 0], axis=1)
        if k != i and both.sum() >= least:
            rows = both
            others.append(k)
    return rows, others


def _fit_first_step(
    joint: int, along: single_joint.SingleJointMotion, filtered: np.ndarray
) -> FirstStep | None:
    """Returns step 1 from its columns and torque; None where coefficients are not identifiable."""
    X, y = filtered[:, :-1], filtered[:, -1]
    rows, count = X.shape
    lengths = np.linalg.norm(X, axis=0)
    if not count or rows < THRESHOLDS.min_rows_per_column * count or not lengths.all():
        return None
    values = np.linalg.svd(X / lengths, compute_uv=False)
    if values[-1] < THRESHOLDS.min_singular_share * values[0]:
        return None
    Q, R = np.linalg.qr(X)
    projected = Q.T @ y
    return FirstStep(joint, along, Q, R, projected, y - Q @ projected)


def _estimate_noise(alike: list[Configuration]) -> list[Configuration]:
    """Returns configurations with the same torques, with the covariance of their noise.

    Of one motion of the same joint the noise of its torques is the same at every configuration;
    torques that are made of the same motors share theirs.
    """
    count = len(alike[0].first_steps)
    products, degrees = np.zeros((count, count)), np.zeros(count)
    for c in alike:
        residual = np.column_stack([f.residual for f in c.first_steps])
        products += residual.T @ residual
        degrees += [len(f.residual) - len(f.projected) for f in c.first_steps]
    noise = products / np.sqrt(np.outer(degrees, degrees))
    noise[~np.eye(count, dtype=bool)] *= THRESHOLDS.max_correlation
    pieces = np.repeat(np.arange(len(alike)), [len(c.first_steps[0].residual) for c in alike])
    for k in range(count):
        largest = max(np.abs(c.first_steps[k].projected).max() for c in alike)
        noise[k, k] = max(noise[k, k], (THRESHOLDS.tiny_share * largest) ** 2)
        every = np.concatenate([c.first_steps[k].residual for c in alike])
        r = estimate_autocorrelation(every, np.arange(len(every)), pieces)
        longer = np.sqrt(max(1.0, 1.0 + 2.0 * float(np.sum(r[1:]))))
        noise[k] *= longer
        noise[:, k] *= longer
    return [dataclasses.replace(c, noise=noise) for c in alike]


def _whiten_rows(configuration: Configuration) -> tuple[np.ndarray, np.ndarray]:
    """Returns rows of step 2 of standard deviation 1: R V beta = Q^T y, covariance taken out."""
    steps, noise = configuration.first_steps, configuration.noise
    scale = np.sqrt(np.diag(noise))
    joined = np.hstack([f.Q for f in steps])
    which = np.repeat(np.arange(len(steps)), [len(f.projected) for f in steps])
    correlation = noise / np.outer(scale, scale)
    root = cholesky(joined.T @ joined * correlation[np.ix_(which, which)], lower=True)
    W = np.vstack([f.R @ f.along.weights / s for f, s in zip(steps, scale, strict=True)])
    y = np.concatenate([f.projected / s for f, s in zip(steps, scale, strict=True)])
    return solve_triangular(root, W, lower=True), solve_triangular(root, y, lower=True)


# Persistent excitation of a two-step fit: the singular values of Phi, joint by joint.


_POSES_SEED = 1872


@dataclass(frozen=True)
class PersistentExcitation(Document):
    """Describes Phi of the inertia of one joint: J(configuration) = Phi beta.

    Attributes:
        joint: name.
        configurations: at which it moved alone.
        singular_values: of Phi, those that are 0 left out, largest first.
        max_rank: of Phi at ever so many configurations.
        typical_ratio: last of the singular values over the first at ever so many configurations.
    """

    KEYS = "joint configurations singular_values rank max_rank typical_ratio"

    joint: str
    configurations: int
    singular_values: tuple[float, ...]
    max_rank: int
    typical_ratio: float

    @property
    def rank(self) -> int:
        """Returns the rank of Phi at these configurations."""
        return len(self.singular_values)

    def format_line(self) -> str:
        """Returns the rank and the singular values as text."""
        values = self.singular_values
        listed = " ".join(f"{value:.3g}" for value in values)
        ratio = values[-1] / values[0] if values else 0.0
        return (
            f"J of joint {self.joint} at {self.configurations} configurations: rank "
            f"{self.rank} of {self.max_rank}, singular values of Phi {listed} (last "
            f"{ratio:.2g} of the first; {self.typical_ratio:.2g} at many random ones)"
        )

    def describe(self) -> str:
        """Returns what to do where it is not persistent."""
        return (
            f"joint {self.joint} moves alone at {self.configurations} configurations, rank "
            f"{self.rank} of {self.max_rank} in its inertia: not persistently exciting; move "
            f"it at {self.max_rank - self.rank} or more further configurations of the others"
        )


def compute_excitations(
    model: CompiledModel, observation: Observation, steps: TwoStepEstimate
) -> tuple[PersistentExcitation, ...]:
    """Returns that of every joint that moved alone; what is possible is what random poses give.

    Robots with loops cannot take any pose: theirs are those of the logs.
    """
    directions, count = steps.directions, THRESHOLDS.poses_per_column * len(observation.names)
    if model.spec.closure is None:
        rng = np.random.default_rng(_POSES_SEED)
        poses = rng.uniform(-np.pi, np.pi, (count, len(directions.names)))
    else:
        poses = observation.q[np.linspace(0, len(observation.q) - 1, count).astype(int)]
    results = []
    for i in sorted({c.joint for c in steps.configurations}):
        logged = np.array([c.pose for c in steps.configurations if c.joint == i]) @ directions.rows
        rows = (build_inertia_rows(model, q, directions.rows[i]) for q in (logged, poses))
        values, every = map(_compute_singular_values, rows)
        name, ratio = directions.names[i], every[-1] / every[0]
        results.append(PersistentExcitation(name, len(logged), values, len(every), ratio))
    return tuple(results)


def build_inertia_rows(model: CompiledModel, q: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Returns (t, c) Phi of J = d^T M(q) d = Phi beta at poses q (t, n)."""
    still, moved = np.zeros_like(q), np.tile(direction, (len(q), 1))
    rows = model.base_regressor(q, still, moved) - model.base_regressor(q, still, still)
    return np.einsum("tjc,j->tc", rows, direction)


def _compute_singular_values(rows: np.ndarray) -> tuple[float, ...]:
    values = np.linalg.svd(rows, compute_uv=False)
    return tuple(values[values > THRESHOLDS.min_singular_share * values[0]].tolist())


@dataclass(frozen=True, eq=False)
class TwoStepFit:
    """Holds a two-step fit beside the one-step fit of the same logs.

    Attributes:
        result: of the two steps, for the model file.
        steps: configurations and Phi.
        excitation: of each joint that moved alone.
        one_step: the weighted least squares of all rows.
    """

    result: FitResult
    steps: TwoStepEstimate
    excitation: tuple[PersistentExcitation, ...]
    one_step: FitResult

    def format_lines(self) -> list[str]:
        """Returns lines: step 1 by configuration, singular values of Phi, both fits."""
        pieces = [(f"{n} piece{'s' * (n > 1)}", why) for why, n in self.steps.left_out.items()]
        unused = [f"{some} not used: {why}" for some, why in pieces]
        if self.steps.simultaneous_time > 0.0:
            time = self.steps.simultaneous_time
            unused.append(f"{time:.3g} s not used: several joints move")
        first = (*map(self._format_line, self.steps.configurations), *unused)
        return [
            "step 1: one joint moves, the others stand",
            *(f"  {line}" for line in first),
            "step 2: theta = Phi beta",
            *(f"  {excitation.format_line()}" for excitation in self.excitation),
            *self._compare_fits(),
        ]

    def collect_warnings(self) -> list[DataWarning]:
        """Returns a warning on joints that never moved alone, and whose torque misses it."""
        used = {c.joint for c in self.steps.configurations}
        never = [name for k, name in enumerate(self.steps.directions.names) if k not in used]
        short = all(why.startswith("too short") for why in self.steps.left_out)
        worst = max(joint.relative_error or 0.0 for joint in self.result.joints)
        if not never or not short or worst <= THRESHOLDS.max_fit_error:
            return []
        line = (
            f"joint {', '.join(never)} never moved alone for long enough, and the two steps use no "
            "other motion; record more motion of it alone, or use --method weighted"
        )
        largest = THRESHOLDS.half_variance_error
        lost = [j.name for j in self.result.joints if (j.relative_error or 0.0) > largest]
        code = "no_single_motion"
        return [DataWarning(line, bool(lost), not lost, joints=tuple(lost), code=code)]

    def _format_line(self, c: Configuration) -> str:
        names = self.steps.directions.names
        where = ", ".join(f"q{name} {x:.2f}" for name, x in self._collect_others(c).items())
        every = [("J" if n == "qdd" else n, x, s) for n, x, s in c.compute_coefficients(0)]
        cells = [f"{name} {x:.5g} +- {s:.2g}" for name, x, s in every]
        further = [names[f.joint] for f in c.first_steps[1:]]
        also = f"; torque of joint {', '.join(further)} too" if further else ""
        return (
            f"{c.log}, {c.start:.2f} to {c.end:.2f} s: joint {names[c.joint]} at {where or '-'}: "
            f"{', '.join(cells)}{also}"
        )

    def _collect_others(self, c: Configuration) -> dict[str, float]:
        names = self.steps.directions.names
        return {names[k]: float(x) for k, x in enumerate(c.pose) if k != c.joint}

    def _compare_fits(self) -> list[str]:
        width = max([9, *(len(p.name) for p in self.result.parameters)])
        head = f"{'two-step':>12} {'sigma':>9} {'one-step':>12} {'sigma':>9}"
        lines = [f"{'parameter':<{width}} {head}"]
        for pair in zip(self.result.parameters, self.one_step.parameters, strict=True):
            both = [(p.value, p.sigma) for p in pair]
            none = f"{'set aside':>12} {'':>9}"
            cells = [none if s is None else f"{x:>12.6g} {s:>9.3g}" for x, s in both]
            lines.append(f"{pair[0].name:<{width}} {cells[0]} {cells[1]}")
        two, one = (format_percent(f.relative_error) for f in (self.result, self.one_step))
        return [*lines, f"relative error {two} in two steps, {one} in one"]

    def to_json(self) -> dict[str, Any]:
        """Returns the object `two_step` beside that of the fit."""
        names = self.steps.directions.names

        def describe(c: Configuration) -> dict[str, Any]:
            plain = select_attributes(c, "log start end") | {"joint": names[c.joint]}
            plain |= {"others": self._collect_others(c), "rows": len(c.first_steps[0].residual)}
            torques = {}
            for k, f in enumerate(c.first_steps):
                rows = c.compute_coefficients(k)
                torques[names[f.joint]] = {name: {"value": x, "sigma": s} for name, x, s in rows}
            return plain | {"torques": torques}

        return {
            "configurations": [describe(c) for c in self.steps.configurations],
            "skipped_logs": dict(self.steps.left_out),
            "simultaneous_motion_time": self.steps.simultaneous_time,
            "excitation": [excitation.to_json() for excitation in self.excitation],
            "one_step": [parameter.to_json() for parameter in self.one_step.parameters],
        }


def identify_in_two_steps(
    model: CompiledModel,
    observation: Observation,
    directions: single_joint.JointDirections,
    below: float | None = None,
) -> TwoStepFit:
    """Returns the two-step fit of an observation, and the one-step fit beside it.

    Args:
        model: the robot.
        observation: of logs in which joints move one at a time.
        directions: how the coordinates move with each joint.
        below: as for `identify`.

    Raises:
        DataError: no piece in which one joint moves and the others stand, or what `identify` says.
    """
    one = identify(observation)
    steps = estimate_two_steps(model, observation, directions)
    excitation = compute_excitations(model, observation, steps)
    estimate, equations = steps.estimate, build_base_equations(observation)
    essential = select_essential_parameters(steps.data, estimate, "ordinary", below)
    notes = [e.describe() for e in excitation if e.rank < e.max_rank]
    notes += [dropped.describe() for dropped in estimate.rank.dropped_columns]
    result = build_result(
        equations,
        TWO_STEPS,
        estimate,
        essential,
        compress_all_rows(observation),
        rows=sum(len(f.residual) for c in steps.configurations for f in c.first_steps),
        sentences=tuple(notes),
    )
    return TwoStepFit(result, steps, excitation, one)
