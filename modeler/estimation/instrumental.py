"""Instrumental variables along a motion that was not measured: commanded, or simulated."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.estimation.consistent import estimate_consistent, make_consistent
from modeler.estimation.direct_model import ControlLoop, DirectModel
from modeler.estimation.least_squares import (
    Estimate,
    Problem,
    compute_least_sigma,
    expand_columns,
    solve_least_squares,
)
from modeler.estimation.robust import estimate_robust
from modeler.numerics.least_squares import (
    compress_rows,
    compute_column_norms,
    compute_triangle,
    find_independent_columns,
)

# Instrumental variables: what the noise of the measured motion cannot bias.


_ITERATIONS = 200
_SETTLED = 1e-9  # relative change of the weights
_BLIND = 1e-6  # smallest singular value of Qz^T Qw at which instruments tell nothing of a column
_WEAK = 0.3  # and at which they tell so little that it is said


@dataclass(frozen=True, eq=False)
class _InstrumentalSolution:
    """beta = P S^-1/2 y, k columns kept."""

    beta: np.ndarray
    P: np.ndarray  # (k, rows)
    cosine: float  # between the spaces of W and of the instruments, the smallest
    worst: int  # the column that they carry least of
    whole: np.ndarray  # (k, k + 1) projected equations


def estimate_with_instruments(problem: Problem, Z: np.ndarray, method: str) -> Estimate:
    """beta = (Z^T S^-1 W)^-1 Z^T S^-1 y, S = diag sigma_j^2 of y - W beta, iterated.

    Consistent where the instruments Z are uncorrelated with the noise of y and of W; the covariance
    is (Z^T S^-1 W)^-1 Z^T S^-1 Z (W^T S^-1 Z)^-1 (Young 2011; Janot, Vandanjon and Gautier 2014,
    IEEE Trans. Control Systems Technology 22(1)).

    Args:
        problem: beta in the units of its columns, y N m or N.
        Z: (rows, c) the columns of W along a motion that the noise did not touch.
        method: for the refusal, DataError, of instruments that tell nothing of a parameter.
    """
    data, counted, joint = problem.data, problem.counted, problem.row_joint[problem.counted]
    start = solve_least_squares(problem.data, "weighted")
    kept_columns = np.asarray(start.rank.kept_columns, dtype=int)
    W, Z, y = problem.W[counted][:, kept_columns], Z[counted][:, kept_columns], problem.y[counted]
    # Instruments that depend on each other where the columns do not.
    aside = find_independent_columns(
        compute_triangle(Z), [problem.names[i] for i in kept_columns]
    ).dropped_columns
    if aside:
        raise DataError(_format_refusal(method, aside[0].name))
    sigma, settled, iterations = start.sigma, False, 0
    while not settled and iterations < _ITERATIONS:
        solution = _solve_instruments(W, Z, y, sigma[joint])
        if solution.cosine < _BLIND:
            raise DataError(_format_refusal(method, problem.names[kept_columns[solution.worst]]))
        # sigma_j^2 = |r_j|^2 / (rows_j - h_j), h_j the trace of joint j's part of W P.
        hat = np.einsum("rk,kr->r", W / sigma[joint][:, None], solution.P)
        squares = np.bincount(joint, (y - W @ solution.beta) ** 2, len(data.rows))
        degrees = data.rows - np.bincount(joint, hat, len(data.rows))
        spread = np.sqrt(squares / np.maximum(degrees, 0.5))
        spread = np.where(data.free | (data.rows == 0), start.sigma, spread)
        before, sigma = sigma, np.maximum(spread, compute_least_sigma(data))
        settled = bool(np.all(np.abs(sigma / before - 1.0) < _SETTLED))
        iterations += 1
    beta, covariance = expand_columns(
        len(start.beta), kept_columns, solution.beta, solution.P @ solution.P.T
    )
    # Qz^T S^-1/2 W beta = Qz^T S^-1/2 y, which beta satisfies, above what it leaves.
    whole = np.zeros((len(kept_columns) + 1, len(beta) + 1))
    whole[:-1, [*kept_columns, -1]] = solution.whole
    whole[-1, -1] = np.linalg.norm((y - W @ solution.beta) / sigma[joint])
    weak = (
        "the instruments are weak: of one combination of parameters they carry "
        f"{solution.cosine:.2g} "
        "of its column; noise then biases it as without instruments, and its sigma is too small",
    )
    return dataclasses.replace(
        start,
        beta=beta,
        covariance=covariance,
        sigma=sigma,
        iterations=iterations,
        is_converged=settled,
        sentences=weak if solution.cosine <= _WEAK else (),
        influence=problem.expand_rows(kept_columns, (solution.P / sigma[joint]).T),
        whole=whole,
    )


def _solve_instruments(
    W: np.ndarray, Z: np.ndarray, y: np.ndarray, sigma: np.ndarray
) -> _InstrumentalSolution:
    lengths = np.linalg.norm(W / sigma[:, None], axis=0)
    X, y = W / sigma[:, None] / lengths, y / sigma
    instruments = Z / sigma[:, None]
    Qz, _ = np.linalg.qr(instruments / compute_column_norms(instruments))
    Qw, Rw = np.linalg.qr(X)
    cosine = float(np.linalg.svd(Qz.T @ Qw, compute_uv=False).min(initial=1.0))
    across = Qz.T @ Qw @ Rw
    worst = int(np.argmin(np.linalg.norm(across, axis=0)))
    P = np.linalg.lstsq(across, Qz.T, rcond=None)[0] / lengths[:, None]
    whole = np.column_stack([across * lengths, Qz.T @ y])
    return _InstrumentalSolution(P @ y, P, cosine, worst, whole)


def _format_refusal(method: str, name: str) -> str:
    return (
        f'method "{method}": the instruments tell nothing of a parameter; got it for {name}; '
        'expected a commanded motion that moves all joints as the log does; use method "weighted"'
    )


_SIMULATIONS = 12
_WORSE = 1.5  # error along the logged motion over that of the start, from which on it is told
_NEAR = 0.1  # step, in standard deviations, at which the simulation need not be repeated


def estimate_iv(problem: Problem, method: str = "iv") -> Estimate:
    """Instruments by the inverse model: the regressor along the commanded motion.

    Noise of the encoders is in W and not in what was commanded; see `estimate_with_instruments`.

    Raises:
        DataError: a log without commanded positions.
    """
    observation = problem.observation
    robot = DirectModel(problem.require_robot(method), observation)
    for segment in robot.segments:
        if segment.commanded is None:
            raise DataError(
                f'{observation.logs[segment.run]}: method "{method}" needs commanded positions; '
                f"got no complete columns qc{observation.joints[0].name} ...; log those of all "
                'joints, or use method "weighted" or "iv-direct"'
            )
    return estimate_with_instruments(problem, robot.evaluate_columns(robot.references), method)


def estimate_iv_consistent(problem: Problem) -> Estimate:
    """The machine that could be built nearest to `estimate_iv`.

    In the metric of its own " "equations.
    """
    return make_consistent(problem, estimate_iv(problem, "iv-consistent"), "iv-consistent")


def estimate_iv_direct(problem: Problem) -> Estimate:
    """Instruments by the direct model: the regressor along the simulated motion, repeated.

    The robot with the values of the last estimate follows the log (`direct_model`); the first
    estimate is the weighted fit (Janot, Vandanjon and Gautier 2014).

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    method = "iv-direct"
    return _iterate_simulation(
        problem, method, _fit_weighted, lambda Z: estimate_with_instruments(problem, Z, method)
    )


def estimate_iv_direct_consistent(problem: Problem) -> Estimate:
    """The same, and every machine that is simulated could be built."""
    method = "iv-direct-consistent"

    def estimate(Z: np.ndarray) -> Estimate:
        return make_consistent(problem, estimate_with_instruments(problem, Z, method), method)

    return _iterate_simulation(problem, method, estimate_consistent, estimate)


def _fit_weighted(problem: Problem) -> Estimate:
    return solve_least_squares(problem.data, "weighted")


def estimate_didim(
    problem: Problem, method: str = "didim", solve: Callable[[Problem], Estimate] = _fit_weighted
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
    return _iterate_simulation(problem, method, solve, lambda W: _fit_along(problem, W, solve))


def estimate_didim_robust(problem: Problem) -> Estimate:
    """`estimate_didim` whose steps are `estimate_robust` fits.

    Rows that do not fit lose their say in each of them.

    A push or a spike is in the torques and not in the simulated motion.
    """
    return estimate_didim(problem, "didim-robust", estimate_robust)


def estimate_didim_consistent(problem: Problem) -> Estimate:
    """`estimate_didim` whose steps are machines that could be built.

    Their inertia matrices are " "such.
    """
    return estimate_didim(problem, "didim-consistent", estimate_consistent)


def _fit_along(problem: Problem, W: np.ndarray, solve: Callable[[Problem], Estimate]) -> Estimate:
    """The fit of the torques to columns along another motion."""
    counted, free = problem.counted, np.flatnonzero(problem.data.free)
    data = compress_rows(
        W[counted], problem.y[counted], problem.row_joint[counted],
        len(problem.data.rows), problem.names, free.tolist(),
    )  # fmt: skip
    estimate = solve(dataclasses.replace(problem, matrix=W, data=data))
    pull = estimate.influence
    if pull is None:
        pull = np.where(counted[:, None], W @ estimate.covariance, 0.0)
        pull /= estimate.sigma[problem.row_joint][:, None] ** 2
    weight = 1.0 if estimate.weight is None else estimate.weight
    shift = pull.T @ (weight * ((W - problem.W) @ estimate.beta))
    return dataclasses.replace(
        estimate,
        covariance=estimate.covariance + np.outer(shift, shift),
        influence=pull,
        residual=problem.y - W @ estimate.beta if estimate.residual is None else estimate.residual,
        whole=data.combine_joints(estimate.sigma) if estimate.whole is None else estimate.whole,
    )


def _compute_misfit(problem: Problem, start: Estimate, W: np.ndarray, beta: np.ndarray) -> float:
    """rms of (y_j - W_j beta) / sigma_j over the counted rows, sigma_j of `start`."""
    rows = problem.counted
    residual = (problem.y[rows] - W[rows] @ beta) / start.sigma[problem.row_joint[rows]]
    return float(np.sqrt(np.mean(residual**2)))


def _iterate_simulation(
    problem: Problem,
    method: str,
    first: Callable[[Problem], Estimate],
    estimate: Callable[[np.ndarray], Estimate],
) -> Estimate:
    """Simulate, estimate, from the first on, until the step is small beside the sigmas."""
    model = problem.require_robot(method)
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
            return robot.choose_loop(beta)
        return robot.choose_loop_by_misfit(
            beta, lambda way: _compute_misfit(problem, start, robot.evaluate_columns(way), beta)
        )

    loop = chosen()
    for _ in range(_SIMULATIONS):
        try:
            motions = robot.simulate_motions(beta, loop)
        except DataError:
            if robot.commanded:
                raise
            loop = chosen()  # this one was not in the log; another one holds the robot
            motions = robot.simulate_motions(beta, loop)
        current = estimate(robot.evaluate_columns(motions))
        sigma = np.sqrt(np.diag(current.covariance))
        step = np.abs(current.beta - beta) / np.where(sigma > 0.0, sigma, np.inf)
        beta, settled = current.beta, bool(np.isinf(loop.speed) or step.max(initial=0.0) < _NEAR)
        if settled:
            break
    said = []
    before, after = (
        _compute_misfit(problem, start, problem.W, values) for values in (start.beta, beta)
    )
    if after > _WORSE * before:
        said.append(
            f"along the logged motion the values leave {after / before:.3g} times the error of "
            f'"weighted", from which method "{method}" starts: the simulated motion is not that of '
            'the log; take the values of method "weighted"'
        )
    said += _describe_controller(problem, robot, loop, robot.compute_position_error(motions))
    if not settled:
        said.append(
            f"the values still move by up to {step.max():.2g} sigma from one simulation to the "
            f"next after {_SIMULATIONS}; add that to their uncertainty"
        )
    settled = current.is_converged and settled
    return dataclasses.replace(current, is_converged=settled, sentences=(*said, *current.sentences))


def _describe_controller(
    problem: Problem, robot: DirectModel, loop: ControlLoop, error: np.ndarray
) -> list[str]:
    worst = int(np.argmax(error))
    joint = problem.observation.joints[worst].name
    near = f"within {format_percent(error[worst])} of the range of joint {joint}, the farthest"
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
            f"{format_percent(robot.raised)} of the postures, most at joint {light}: it was raised "
            "for "
            "the simulation; record more motion, or leave out parameters that are not essential"
        )
    return said
