"""Instrumental variables along a motion that was not measured: commanded, or simulated."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.table import percent
from modeler.estimation.consistent import as_buildable, buildable
from modeler.estimation.direct_model import ControlLoop, DirectModel
from modeler.estimation.least_squares import Estimate, Problem, least_sigma, least_squares, placed
from modeler.estimation.robust import robust
from modeler.numerics.least_squares import column_lengths, compress, independent_columns, triangle

# Instrumental variables: what the noise of the measured motion cannot bias.


_ITERATIONS = 200
_SETTLED = 1e-9  # relative change of the weights
_BLIND = 1e-6  # smallest singular value of Qz^T Qw at which instruments tell nothing of a column
_WEAK = 0.3  # and at which they tell so little that it is said


@dataclass(frozen=True, eq=False)
class _Solved:
    """beta = P S^-1/2 y, k columns kept."""

    beta: np.ndarray
    P: np.ndarray  # (k, rows)
    cosine: float  # between the spaces of W and of the instruments, the smallest
    worst: int  # the column that they carry least of
    whole: np.ndarray  # (k, k + 1) projected equations


def with_instruments(problem: Problem, Z: np.ndarray, method: str) -> Estimate:
    """beta = (Z^T S^-1 W)^-1 Z^T S^-1 y, S = diag sigma_j^2 of y - W beta, iterated.

    Consistent where the instruments Z are uncorrelated with the noise of y and of W; the covariance
    is (Z^T S^-1 W)^-1 Z^T S^-1 Z (W^T S^-1 Z)^-1 (Young 2011; Janot, Vandanjon and Gautier 2014,
    IEEE Trans. Control Systems Technology 22(1)).

    Args:
        problem: beta in the units of its columns, y N m or N.
        Z: (rows, c) the columns of W along a motion that the noise did not touch.
        method: for the refusal, DataError, of instruments that tell nothing of a parameter.
    """
    data, counted, joint = problem.data, problem.counted, problem.joint[problem.counted]
    start = least_squares(problem.data, "weighted")
    kept = np.asarray(start.rank.kept, dtype=int)
    W, Z, y = problem.W[counted][:, kept], Z[counted][:, kept], problem.y[counted]
    # Instruments that depend on each other where the columns do not.
    aside = independent_columns(triangle(Z), [problem.names[i] for i in kept]).aside
    if aside:
        raise DataError(_refusal(method, aside[0].name))
    sigma, settled, iterations = start.sigma, False, 0
    while not settled and iterations < _ITERATIONS:
        found = _solved(W, Z, y, sigma[joint])
        if found.cosine < _BLIND:
            raise DataError(_refusal(method, problem.names[kept[found.worst]]))
        # sigma_j^2 = |r_j|^2 / (rows_j - h_j), h_j the trace of joint j's part of W P.
        hat = np.einsum("rk,kr->r", W / sigma[joint][:, None], found.P)
        squares = np.bincount(joint, (y - W @ found.beta) ** 2, len(data.rows))
        degrees = data.rows - np.bincount(joint, hat, len(data.rows))
        spread = np.sqrt(squares / np.maximum(degrees, 0.5))
        spread = np.where(data.free | (data.rows == 0), start.sigma, spread)
        before, sigma = sigma, np.maximum(spread, least_sigma(data))
        settled = bool(np.all(np.abs(sigma / before - 1.0) < _SETTLED))
        iterations += 1
    beta, covariance = placed(len(start.beta), kept, found.beta, found.P @ found.P.T)
    # Qz^T S^-1/2 W beta = Qz^T S^-1/2 y, which beta satisfies, above what it leaves.
    whole = np.zeros((len(kept) + 1, len(beta) + 1))
    whole[:-1, [*kept, -1]] = found.whole
    whole[-1, -1] = np.linalg.norm((y - W @ found.beta) / sigma[joint])
    weak = (
        f"the instruments are weak: of one combination of parameters they carry {found.cosine:.2g} "
        "of its column; noise then biases it as without instruments, and its sigma is too small",
    )
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=sigma,
        iterations=iterations,
        settled=settled,
        sentences=weak if found.cosine <= _WEAK else (),
        pull=problem.scattered(kept, (found.P / sigma[joint]).T),
        whole=whole,
    )


def _solved(W: np.ndarray, Z: np.ndarray, y: np.ndarray, sigma: np.ndarray) -> _Solved:
    lengths = np.linalg.norm(W / sigma[:, None], axis=0)
    X, y = W / sigma[:, None] / lengths, y / sigma
    instruments = Z / sigma[:, None]
    Qz, _ = np.linalg.qr(instruments / column_lengths(instruments))
    Qw, Rw = np.linalg.qr(X)
    cosine = float(np.linalg.svd(Qz.T @ Qw, compute_uv=False).min(initial=1.0))
    across = Qz.T @ Qw @ Rw
    worst = int(np.argmin(np.linalg.norm(across, axis=0)))
    P = np.linalg.lstsq(across, Qz.T, rcond=None)[0] / lengths[:, None]
    whole = np.column_stack([across * lengths, Qz.T @ y])
    return _Solved(P @ y, P, cosine, worst, whole)


def _refusal(method: str, name: str) -> str:
    return (
        f'method "{method}": the instruments tell nothing of a parameter; got it for {name}; '
        'expected a commanded motion that moves all joints as the log does; use method "weighted"'
    )


_SIMULATIONS = 12
_WORSE = 1.5  # error along the logged motion over that of the start, from which on it is told
_NEAR = 0.1  # step, in standard deviations, at which the simulation need not be repeated


def iv(problem: Problem, method: str = "iv") -> Estimate:
    """Instruments by the inverse model: the regressor along the commanded motion.

    Noise of the encoders is in W and not in what was commanded; see `with_instruments`.

    Raises:
        DataError: a log without commanded positions.
    """
    observation = problem.observation
    robot = DirectModel(problem.robot(method), observation)
    for segment in robot.segments:
        if segment.commanded is None:
            raise DataError(
                f'{observation.logs[segment.run]}: method "{method}" needs commanded positions; '
                f"got no complete columns qc{observation.joints[0].name} ...; log those of all "
                'joints, or use method "weighted" or "iv-direct"'
            )
    return with_instruments(problem, robot.columns(robot.references), method)


def iv_consistent(problem: Problem) -> Estimate:
    """The machine that could be built nearest to `iv`, in the metric of its own equations."""
    return as_buildable(problem, iv(problem, "iv-consistent"), "iv-consistent")


def iv_direct(problem: Problem) -> Estimate:
    """Instruments by the direct model: the regressor along the simulated motion, repeated.

    The robot with the values of the last estimate follows the log (`direct_model`); the first
    estimate is the weighted fit (Janot, Vandanjon and Gautier 2014).

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    method = "iv-direct"
    return _repeated(problem, method, _weighted, lambda Z: with_instruments(problem, Z, method))


def iv_direct_consistent(problem: Problem) -> Estimate:
    """The same, and every machine that is simulated could be built."""
    method = "iv-direct-consistent"

    def estimate(Z: np.ndarray) -> Estimate:
        return as_buildable(problem, with_instruments(problem, Z, method), method)

    return _repeated(problem, method, buildable, estimate)


def _weighted(problem: Problem) -> Estimate:
    return least_squares(problem.data, "weighted")


def didim(
    problem: Problem, method: str = "didim", solve: Callable[[Problem], Estimate] = _weighted
) -> Estimate:
    """min sum_j |y_j - W_j(q_s(beta)) beta|^2 / sigma_j^2, q_s the simulated motion.

    Gauss-Newton: q_s hardly depends on beta, as the controller holds the motion, so each step is
    the fit of the measured torque to the columns along the last simulated motion (Gautier, Janot
    and Vandanjon 2013): the weighted one, or that of another law. The logged motion is used to
    choose the controller, and the rows, alone; and for the covariance: d d^T is added to it,
    d = P (W(q_s) - W(q)) beta with P the pull of the fit. By d the values move if the logged motion
    is right and the simulated one is not, as where the controller of the log is another one.

    Args:
        problem: beta in the units of its columns, y N m or N.
        method: for the refusals.
        solve: each step, and the fit along the logged motion from which they start.

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    return _repeated(problem, method, solve, lambda W: _along(problem, W, solve))


def didim_robust(problem: Problem) -> Estimate:
    """`didim` whose steps are `robust` fits: rows that do not fit lose their say in each of them.

    A push or a spike is in the torques and not in the simulated motion.
    """
    return didim(problem, "didim-robust", robust)


def didim_consistent(problem: Problem) -> Estimate:
    """`didim` whose steps are machines that could be built: their inertia matrices are such."""
    return didim(problem, "didim-consistent", buildable)


def _along(problem: Problem, W: np.ndarray, solve: Callable[[Problem], Estimate]) -> Estimate:
    """The fit of the torques to columns along another motion."""
    counted, free = problem.counted, np.flatnonzero(problem.data.free)
    data = compress(
        W[counted], problem.y[counted], problem.joint[counted],
        len(problem.data.rows), problem.names, free.tolist(),
    )  # fmt: skip
    found = solve(dataclasses.replace(problem, given=W, data=data))
    pull = found.pull
    if pull is None:
        pull = np.where(counted[:, None], W @ found.covariance, 0.0)
        pull /= found.sigma[problem.joint][:, None] ** 2
    weight = 1.0 if found.weight is None else found.weight
    shift = pull.T @ (weight * ((W - problem.W) @ found.beta))
    return dataclasses.replace(
        found,
        covariance=found.covariance + np.outer(shift, shift),
        pull=pull,
        residual=problem.y - W @ found.beta if found.residual is None else found.residual,
        whole=data.whole(found.sigma) if found.whole is None else found.whole,
    )


def _misfit(problem: Problem, start: Estimate, W: np.ndarray, beta: np.ndarray) -> float:
    """rms of (y_j - W_j beta) / sigma_j over the counted rows, sigma_j of `start`."""
    rows = problem.counted
    residual = (problem.y[rows] - W[rows] @ beta) / start.sigma[problem.joint[rows]]
    return float(np.sqrt(np.mean(residual**2)))


def _repeated(
    problem: Problem,
    method: str,
    first: Callable[[Problem], Estimate],
    estimate: Callable[[np.ndarray], Estimate],
) -> Estimate:
    """Simulate, estimate, from the first on, until the step is small beside the sigmas."""
    model = problem.robot(method)
    idle = [joint.name for joint in model.spec.joints if not joint.actuated]
    if idle:
        raise DataError(
            f'method "{method}": joint {idle[0]} of {model.spec.robot} has no motor; expected one '
            "motor a joint, so that a controller can hold the robot; use another method"
        )
    robot = DirectModel(model, problem.observation)
    start = first(problem)
    beta, settled = start.beta, False

    def chosen() -> ControlLoop:
        if robot.commanded:
            return robot.chosen(beta)
        return robot.gentlest(beta, lambda way: _misfit(problem, start, robot.columns(way), beta))

    loop = chosen()
    for _ in range(_SIMULATIONS):
        try:
            motions = robot.followed(beta, loop)
        except DataError:
            if robot.commanded:
                raise
            loop = chosen()  # this one was not in the log; another one holds the robot
            motions = robot.followed(beta, loop)
        found = estimate(robot.columns(motions))
        sigma = np.sqrt(np.diag(found.covariance))
        step = np.abs(found.beta - beta) / np.where(sigma > 0.0, sigma, np.inf)
        beta, settled = found.beta, bool(np.isinf(loop.speed) or step.max(initial=0.0) < _NEAR)
        if settled:
            break
    said = []
    before, after = (_misfit(problem, start, problem.W, own) for own in (start.beta, beta))
    if after > _WORSE * before:
        said.append(
            f"along the logged motion the values leave {after / before:.3g} times the error of "
            f'"weighted", from which method "{method}" starts: the simulated motion is not that of '
            'the log; take the values of method "weighted"'
        )
    said += _sentences(problem, robot, loop, robot.error(motions))
    if not settled:
        said.append(
            f"the values still move by up to {step.max():.2g} sigma from one simulation to the "
            f"next after {_SIMULATIONS}; add that to their uncertainty"
        )
    settled = found.settled and settled
    return dataclasses.replace(found, settled=settled, sentences=(*said, *found.sentences))


def _sentences(
    problem: Problem, robot: DirectModel, loop: ControlLoop, error: np.ndarray
) -> list[str]:
    worst = int(np.argmax(error))
    joint = problem.observation.joints[worst].name
    near = f"within {percent(error[worst])} of the range of joint {joint}, the farthest"
    if np.isinf(loop.speed):
        how = (
            "the commanded motion is nearer to the log than what any controller that was tried "
            "makes of it"
            if robot.commanded
            else "none that was tried holds the robot with the fitted values, and the logged "
            "motion, smoothed, stands for the simulated one"
        )
    else:
        parts = {"integral action": loop.integral, "feedforward": loop.forward}
        fed = " and ".join(f"{'with' if there else 'no'} {name}" for name, there in parts.items())
        best = "comes nearest to the log" if robot.commanded else "explains the torques best"
        how = (
            f"the simulated one that {best} has speed loops of "
            f"{loop.speed / 2 / np.pi:.3g} Hz, position loops of {loop.ratio:.2g} times that, {fed}"
        )
    said = [f"the controller of the log is not known: {how}, {near}"]
    if not robot.commanded:
        said.append(
            "no commanded positions in these logs: the simulated robot follows the logged motion, "
            "smoothed; its noise below the band of that stays, and is no better off than with "
            'method "weighted"'
        )
    if robot.raised > 0.0:
        light = problem.observation.joints[robot.lightest].name
        said.append(
            "the fitted inertia matrix is nearly singular or not positive definite in "
            f"{percent(robot.raised)} of the postures, most at joint {light}: it was raised for "
            "the simulation; record more motion, or leave out parameters that are not essential"
        )
    return said
