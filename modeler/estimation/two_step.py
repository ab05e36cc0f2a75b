"""Two-step identification: first what is felt while one joint moves alone, then the parameters.

Step 1: at each configuration of the others, joint i moves alone, and least squares of its torque on
[qdd, sin q, cos q, sign qd] give its inertia J_ii, gravity and friction there; those of the other
joints give J_ki and S_kii wherever their motors turn, or have no dry friction. Step 2: all these
coefficients are linear in the base parameters, theta = Phi beta, with Phi from the model, and beta
is the least squares of them, weighted by the covariance of step 1 (Hanssen, Hovland and Brogardh
2000, section 5, with Phi of the closed form; here it is that of the emitted base regressor).
"""

import dataclasses
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from modeler.core.errors import DataError
from modeler.estimation.covariance import estimate_autocorrelation
from modeler.estimation.least_squares import Estimate, solve_least_squares
from modeler.numerics.filters import LEAST_WEIGHT
from modeler.numerics.least_squares import CompressedRegression, compress_rows
from modeler.regression import Observation, find_runs
from modeler.runtime import CompiledModel

# Where one joint moves and the others stand: the pieces of logs that a two-step fit uses.


STANDS = 0.02
"""A joint stands below this share of the top speed of the fastest joint of its unit."""

_TOP = 0.98  # quantile of the speeds that is the top speed
_SEVERAL, _NONE = -2, -1


class JointDirections:
    """How the coordinates move with each joint: q = a D, a the positions of the joints.

    For logs of the joints D is the identity; for logs of motors its rows are the columns of G,
    q_m = G q_a (Hanssen, Hovland and Brogardh 2000, section 5).

    Attributes:
        names: (n,) of the joints.
        rows: (n, n) D; row i is the speed of the coordinates at speed 1 of joint i alone.
    """

    def __init__(self, ways: Mapping[str, tuple[float, ...]]) -> None:
        self.names = tuple(ways)
        self.rows = np.array([*ways.values()])
        self._inverse = np.linalg.inv(self.rows)

    def convert_to_joints(self, coordinates: np.ndarray) -> np.ndarray:
        """(..., n) positions, speeds or accelerations of the joints."""
        return coordinates @ self._inverse


@dataclass(frozen=True)
class SingleJointMove:
    """A piece of motion of one joint alone.

    Attributes:
        joint: its index.
        part: index of the stretch of the observation.
        window: samples of that stretch.
    """

    joint: int
    part: int
    window: slice


def find_single_joint_moves(
    observation: Observation, directions: JointDirections
) -> tuple[list[SingleJointMove], float, float]:
    """All pieces in which one joint moves and the others stand, in order of time.

    And for how long several move at a time, of all the time, s.

    A joint stands while its speed is below `STANDS` times the top speed of the fastest joint of
    its unit. A piece begins and ends at standstill of all; its joint may pause and turn back in
    between, and any motion of another one ends it.

    Args:
        observation: of the logs.
        directions: of its joints.
    """
    segments = [part.segment for part in observation.stretches]
    speeds = np.concatenate([directions.convert_to_joints(s.qd[s.whole]) for s in segments])
    tops = np.quantile(np.abs(speeds), _TOP, axis=0) if speeds.size else np.ones(speeds.shape[1])
    main = np.argmax(np.abs(directions.rows), axis=1)
    units = np.array([observation.joints[k].unit for k in main])
    floors = STANDS * np.array([tops[units == unit].max() for unit in units])
    single_moves: list[SingleJointMove] = []
    several = total = 0.0
    for number, segment in enumerate(segments):
        moves = np.abs(directions.convert_to_joints(segment.qd)) > floors
        count = moves.sum(axis=1)
        labels = np.where(count > 1, _SEVERAL, np.where(count == 0, _NONE, moves.argmax(axis=1)))
        labels = np.where(segment.whole, labels, _SEVERAL)
        several += segment.step * float(np.sum((labels == _SEVERAL) & segment.whole))
        total += segment.step * float(np.sum(segment.whole))
        single_moves += [SingleJointMove(i, number, window) for i, window in _find_episodes(labels)]
    return single_moves, several, total


def _find_episodes(labels: np.ndarray) -> list[tuple[int, slice]]:
    """(joint, samples) from standstill to standstill in which one joint moves alone.

    Those of one joint that follow each other are one. Joints that come to rest together do so one
    after the other, and the last is not alone: where several move at any time, all is left out.
    """
    episodes: list[tuple[int, slice]] = []
    before = _SEVERAL
    for start, stop in find_runs(labels != _NONE):
        joint = int(labels[start]) if np.ptp(labels[start:stop]) == 0 else _SEVERAL
        if joint != _SEVERAL:
            first = episodes.pop()[1].start if joint == before else start
            episodes.append((joint, slice(first, stop)))
        before = joint
    return episodes


# What a model says of one joint that moves alone: known functions of its motion, and weights.
#
# While joint i moves alone, with position a, speed v and acceleration u, the torque of any joint k
# is a sum of the functions u, v^2 and 1, each times 1, sin a or cos a, and of friction: what turns
# about one axis is one rigid body. For joint i itself that is J u + A sin a + B cos a + friction,
# four or five columns; for the others it holds J_ki and the centrifugal S_kii too (Hanssen, Hovland
# and Brogardh 2000, sections 2.2 and 5). Their weights are linear in the base parameters.


_EXACT = 1e-8  # relative; what is no sum of the functions differs by far more
_POINTS = 60
_REACH = 1.5  # rad or m
_SEED = 1788

_Function = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]

FUNCTIONS: dict[str, _Function] = {
    "qdd": lambda a, v, u: u,
    "qdd sin": lambda a, v, u: u * np.sin(a),
    "qdd cos": lambda a, v, u: u * np.cos(a),
    "qd^2": lambda a, v, u: v**2,
    "qd^2 sin": lambda a, v, u: v**2 * np.sin(a),
    "qd^2 cos": lambda a, v, u: v**2 * np.cos(a),
    "sin": lambda a, v, u: np.sin(a),
    "cos": lambda a, v, u: np.cos(a),
    "1": lambda a, v, u: np.ones_like(a),
    "sign qd": lambda a, v, u: np.sign(v),
    "qd": lambda a, v, u: v,
    "|qd|": lambda a, v, u: np.abs(v),
}
"""Of position, speed and acceleration of the joint that moves; the first is its inertia."""


@dataclass(frozen=True, eq=False)
class SingleJointMotion:
    """The torque of one joint while one moves alone: sum of theta * function, theta = V beta.

    Attributes:
        names: (p,) of `FUNCTIONS`, those that occur.
        weights: (p, c) V.
    """

    names: tuple[str, ...]
    weights: np.ndarray

    def evaluate_columns(self, a: np.ndarray, v: np.ndarray, u: np.ndarray) -> np.ndarray:
        """(samples, p) of position, speed and acceleration of the joint that moves."""
        return np.column_stack([FUNCTIONS[name](a, v, u) for name in self.names])


def fit_single_joint_motions(
    model: CompiledModel,
    q: np.ndarray,
    a: float,
    way: np.ndarray,
    span: tuple[float, float],
    directions: np.ndarray,
) -> list[SingleJointMotion | None]:
    """The torques felt by some joints while one moves alone; None for what is no such sum.

    None also where nothing is felt.

    Args:
        model: the robot.
        q: (n,) coordinates at some place of the motion.
        a: position of the joint there.
        way: (n,) speed of the coordinates at its speed 1.
        span: range of its positions, for robots with loops.
        directions: (k, n) directions of the joints that feel it.

    Raises:
        DataError: the model has effects that read more than the motion.
    """
    if model.spec.signals:
        raise DataError(
            f"{model.spec.robot}: the two-step fit knows friction that depends on the speed, and "
            "some effect of the robot reads time, temperature or travel; use --method weighted"
        )
    rng = np.random.default_rng(_SEED)
    if model.spec.closure is None:
        span = (a - _REACH, a + _REACH)
    places = rng.uniform(*span, _POINTS)
    v, u = rng.uniform(-1.0, 1.0, (2, _POINTS))
    moved = q + (places - a)[:, None] * way
    rows = model.base_regressor(moved, v[:, None] * way, u[:, None] * way)
    matrix = np.column_stack([function(places, v, u) for function in FUNCTIONS.values()])
    motions: list[SingleJointMotion | None] = []
    for direction in directions:
        values = np.einsum("tjc,j->tc", rows, direction)
        weights = np.linalg.lstsq(matrix, values, rcond=None)[0]
        size = np.abs(values).max()
        if size == 0.0 or np.abs(matrix @ weights - values).max() > _EXACT * size:
            motions.append(None)
            continue
        used_functions = np.flatnonzero(np.abs(weights).max(axis=1) > _EXACT * size)
        names = tuple(np.array([*FUNCTIONS])[used_functions].tolist())
        motions.append(SingleJointMotion(names, weights[used_functions]))
    return motions


# Step 1 and step 2.


_ROWS_PER_COLUMN = 3
_WHOLE = 1.0 - 1e-9
_SINGULAR = 1e-8  # of the scaled columns of step 1
_LEAST = 1e-12  # of the coefficients: exact data would otherwise divide by zero
_CORRELATED = 1.0 - 1e-6  # so that exact data leave a matrix that has an inverse
_SEEN = 0.9  # of the rows of the joint that moves


@dataclass(frozen=True, eq=False)
class FirstStep:
    """Step 1 for the torque of one joint: y = Q R theta + residual; p coefficients.

    Attributes:
        joint: index.
        along: the functions and what they weigh.
        Q: (rows, p) orthonormal.
        R: (p, p).
        projected: (p,) Q^T y.
        residual: (rows,) N m or N.
    """

    joint: int
    along: SingleJointMotion
    Q: np.ndarray
    R: np.ndarray
    projected: np.ndarray
    residual: np.ndarray

    @property
    def theta(self) -> np.ndarray:
        """(p,) coefficients."""
        return np.linalg.solve(self.R, self.projected)


@dataclass(frozen=True, eq=False)
class Configuration:
    """Step 1 at one configuration of the joints that stand.

    Attributes:
        log: name.
        start, end: s.
        joint: index of the joint that moves.
        pose: (n,) positions of all joints, its own in the middle of its motion.
        felt: its own torque first, then those of other joints.
        noise: (felt, felt) covariance of their residuals, memory counted.
    """

    log: str
    start: float
    end: float
    joint: int
    pose: np.ndarray
    first_steps: tuple[FirstStep, ...]
    noise: np.ndarray

    def compute_coefficients(self, k: int) -> list[tuple[str, float, float]]:
        """Function, theta and its standard deviation, of the k-th torque that is felt."""
        step = self.first_steps[k]
        sigma = np.linalg.norm(np.linalg.inv(step.R), axis=1) * self.noise[k, k] ** 0.5
        return list(zip(step.along.names, step.theta.tolist(), sigma.tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class TwoStepEstimate:
    """Both steps.

    Attributes:
        directions: how the coordinates move with each joint.
        configurations: step 1.
        left_out: pieces that were not used: reason -> how many.
        several: s, motion of several joints at a time.
        data: step 2, rows of standard deviation 1.
        estimate: of the base parameters.
    """

    directions: JointDirections
    configurations: tuple[Configuration, ...]
    left_out: Mapping[str, int]
    simultaneous_time: float
    data: CompressedRegression
    estimate: Estimate


def estimate_two_steps(
    model: CompiledModel, observation: Observation, directions: JointDirections
) -> TwoStepEstimate:
    """The two-step estimate.

    Args:
        model: the robot.
        observation: of logs in which joints move one at a time.
        directions: how the coordinates move with each joint.

    Raises:
        DataError: no piece in which one joint moves and the others stand, or none that tells it.
    """
    moves, several, total = find_single_joint_moves(observation, directions)
    steps = [_solve_first_step(model, observation, directions, move) for move in moves]
    left_out = Counter(step for step in steps if isinstance(step, str))
    candidates = [step for step in steps if isinstance(step, Configuration)]
    if not candidates:
        why = "".join(f"; {count} left out: {reason}" for reason, count in left_out.items())
        raise DataError(
            f"{', '.join(observation.logs)}: no piece in which one joint moves and the others "
            f"stand ({several:.3g} of {total:.3g} s are motion of several){why}; "
            "expected joints that move one after the other, at several configurations of the "
            "others, as `modeler simulate --motion one-joint` makes them; use --method weighted "
            "for these logs"
        )
    alike: dict[tuple[int, ...], list[Configuration]] = {}  # by who moves, and whose torque is felt
    for c in candidates:
        alike.setdefault((c.joint, *(f.joint for f in c.first_steps)), []).append(c)
    configurations = [c for group in alike.values() for c in _estimate_noise(group)]
    data, estimate = _solve_second_step(observation, configurations)
    configurations.sort(key=lambda c: (c.joint, c.log, c.start))
    return TwoStepEstimate(directions, tuple(configurations), left_out, several, data, estimate)


def _solve_second_step(
    observation: Observation, configurations: Sequence[Configuration]
) -> tuple[CompressedRegression, Estimate]:
    """The base parameters from rows of standard deviation 1, and their covariance.

    Its scale is 1 as far as the residuals of step 1 tell, which stand in the data as one row. It
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
    directions: JointDirections,
    move: SingleJointMove,
) -> Configuration | str:
    """Least squares of the torques while one joint moves; a text where that cannot be."""
    part, i = observation.stretches[move.part], move.joint
    segment, window, way = part.segment, move.window, directions.rows[move.joint]
    if not all(observation.joints[k].actuated for k in np.flatnonzero(way)):
        return "the joint has no motor"
    inside = np.zeros((segment.samples, 1), dtype=bool)
    inside[window] = True
    numbers = np.flatnonzero(part.rows.compute_usable_share(inside)[:, 0] >= _WHOLE)
    if not numbers.size:
        return "too short for the parallel filter"
    a, v, u = (
        directions.convert_to_joints(x[window]) for x in (segment.q, segment.qd, segment.qdd)
    )
    pose = np.median(a, axis=0)
    span = a[:, i].min(), a[:, i].max()
    rows = part.rows.extract_rows(slice(int(numbers[0]), int(numbers[-1]) + 1), window)
    usable, others = _find_usable(part.usable[window], directions, i)
    used = rows.compute_usable_share(usable[:, None])[:, 0] >= LEAST_WEIGHT
    order = [i, *others]
    first_steps: list[FirstStep] = []
    motions = fit_single_joint_motions(
        model, pose @ directions.rows, pose[i], way, span, directions.rows[order]
    )
    for k, motion in zip(order, motions, strict=True):
        if motion is not None:
            columns = motion.evaluate_columns(a[:, i], v[:, i], u[:, i])
            values = np.column_stack([columns, segment.tau[window] @ directions.rows[k]])
            filtered = rows.average_samples(values, usable)[used]
            if (solved := _fit_first_step(k, motion, filtered)) is not None:
                first_steps.append(solved)
        if k == i and not first_steps:
            return (
                "other functions than those of one body that turns"
                if motion is None
                else "too short to tell inertia, gravity and friction apart"
            )
    return Configuration(
        observation.logs[segment.run], float(segment.time[window][0]),
        float(segment.time[window][-1]), i, pose, tuple(first_steps), np.eye(len(first_steps)),
    )  # fmt: skip


def _find_usable(
    usable: np.ndarray, directions: JointDirections, i: int
) -> tuple[np.ndarray, list[int]]:
    """(samples,) at which the torques count, and the other joints whose torques do then too.

    The torque of a joint is made of those of some motors. A motor with dry friction that stands
    says nothing: its samples are not usable.
    """
    usable_rows = np.all(usable[:, directions.rows[i] != 0], axis=1)
    count = max(1, int(usable_rows.sum()))
    others: list[int] = []
    for k, way in enumerate(directions.rows):
        both = np.logical_and(usable_rows, np.all(usable[:, way != 0], axis=1))
        if k != i and both.sum() >= _SEEN * count:
            usable_rows = both
            others.append(k)
    return usable_rows, others


def _fit_first_step(
    joint: int, motion: SingleJointMotion, filtered: np.ndarray
) -> FirstStep | None:
    """Step 1 from its columns and torque; None where the rows do not tell the coefficients."""
    X, y = filtered[:, :-1], filtered[:, -1]
    rows, count = X.shape
    lengths = np.linalg.norm(X, axis=0)
    if not count or rows < _ROWS_PER_COLUMN * count or not lengths.all():
        return None
    values = np.linalg.svd(X / lengths, compute_uv=False)
    if values[-1] < _SINGULAR * values[0]:
        return None
    Q, R = np.linalg.qr(X)
    projected = Q.T @ y
    return FirstStep(joint, motion, Q, R, projected, y - Q @ projected)


def _estimate_noise(alike: list[Configuration]) -> list[Configuration]:
    """Configurations in which the same torques were used, with the covariance of their noise.

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
    noise[~np.eye(count, dtype=bool)] *= _CORRELATED
    pieces = np.repeat(np.arange(len(alike)), [len(c.first_steps[0].residual) for c in alike])
    for k in range(count):
        least = _LEAST * max(np.abs(c.first_steps[k].projected).max() for c in alike)
        noise[k, k] = max(noise[k, k], least**2)
        every = np.concatenate([c.first_steps[k].residual for c in alike])
        r = estimate_autocorrelation(every, np.arange(len(every)), pieces)
        longer = np.sqrt(max(1.0, 1.0 + 2.0 * float(np.sum(r[1:]))))
        noise[k] *= longer
        noise[:, k] *= longer
    return [dataclasses.replace(c, noise=noise) for c in alike]


def _whiten_rows(configuration: Configuration) -> tuple[np.ndarray, np.ndarray]:
    """Rows of step 2 of standard deviation 1: R V beta = Q^T y, their covariance taken out."""
    first_steps, noise = configuration.first_steps, configuration.noise
    scale = np.sqrt(np.diag(noise))
    joined = np.hstack([f.Q for f in first_steps])
    which = np.repeat(np.arange(len(first_steps)), [len(f.projected) for f in first_steps])
    correlation = noise / np.outer(scale, scale)
    C = joined.T @ joined * correlation[np.ix_(which, which)]
    root = cholesky(C, lower=True)
    W = np.vstack([f.R @ f.along.weights / s for f, s in zip(first_steps, scale, strict=True)])
    y = np.concatenate([f.projected / s for f, s in zip(first_steps, scale, strict=True)])
    return solve_triangular(root, W, lower=True), solve_triangular(root, y, lower=True)
