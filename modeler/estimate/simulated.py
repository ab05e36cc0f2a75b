"""Estimators along a motion that was not measured: commanded (iv), simulated (iv-direct, didim)."""

import dataclasses
from collections.abc import Callable

import numpy as np

from modeler.core.errors import DataError
from modeler.estimate.compressed import compress
from modeler.estimate.direct import DirectModel, Loop, Motion
from modeler.estimate.instruments import with_instruments
from modeler.estimate.least_squares import Estimate, Influence, least_squares
from modeler.estimate.problem import Problem

_ITERATIONS = 12
_WORSE = 1.5  # error along the logged motion over that of the start, from which on it is told
_NEAR = 0.1  # step, in standard deviations, at which the simulation need not be repeated


def iv(problem: Problem) -> Estimate:
    """Instruments by the inverse model: the regressor along the commanded motion.

    Noise of the encoders is in W and not in what was commanded; see `with_instruments`.

    Raises:
        DataError: a log without commanded positions.
    """
    observation = problem.observation
    robot = DirectModel(problem.robot("iv"), observation)
    for segment in robot.segments:
        if segment.commanded is None:
            raise DataError(
                f'{observation.logs[segment.run]}: method "iv" needs commanded positions; got no '
                f"complete columns qc{observation.joints[0].name} ...; log those of all joints, "
                'or use method "weighted" or "iv-direct"'
            )
    return with_instruments(problem, robot.columns(robot.references), "iv")


def iv_direct(problem: Problem) -> Estimate:
    """Instruments by the direct model: the regressor along the simulated motion, repeated.

    The robot with the values of the last estimate follows the log (`estimate.direct`); the first
    estimate is the weighted fit (Janot, Vandanjon and Gautier 2014).

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    return _repeated(problem, "iv-direct", lambda Z: with_instruments(problem, Z, "iv-direct"))


def didim(problem: Problem) -> Estimate:
    """min sum_j |y_j - W_j(q_s(beta)) beta|^2 / sigma_j^2, q_s the simulated motion.

    Gauss-Newton: q_s hardly depends on beta, as the controller holds the motion, so each step is
    the weighted fit of the measured torque to the columns along the last simulated motion
    (Gautier, Janot and Vandanjon 2013). The logged motion is used to choose the controller, and the
    rows, alone; and for the covariance: d d^T is added to it, d = P (W(q_s) - W(q)) beta with P the
    pseudo-inverse of the fit. By d the values move if the logged motion is right and the simulated
    one is not, as where the controller of the log is another one.

    Raises:
        DataError: a joint without a motor, or a fit that cannot be simulated.
    """
    return _repeated(problem, "didim", lambda W: _along(problem, W))


def _along(problem: Problem, W: np.ndarray) -> Estimate:
    """The weighted fit of the torques to columns along another motion."""
    counted, free = problem.counted, np.flatnonzero(problem.data.free)
    data = compress(
        W[counted], problem.y[counted], problem.joint[counted],
        len(problem.data.rows), problem.names, free.tolist(),
    )  # fmt: skip
    found = least_squares(data, "weighted")
    weight = np.where(counted, 1.0 / found.sigma[problem.joint] ** 2, 0.0)
    pull = (W @ found.covariance) * weight[:, None]
    shift = pull.T @ ((W - problem.W) @ found.beta)
    return dataclasses.replace(
        found,
        covariance=found.covariance + np.outer(shift, shift),
        influence=Influence(pull, problem.y - W @ found.beta),
        whole=data.whole(found.sigma),
    )


def _misfit(problem: Problem, start: Estimate, W: np.ndarray, beta: np.ndarray) -> float:
    """rms of (y_j - W_j beta) / sigma_j over the counted rows, sigma_j of `start`."""
    rows = problem.counted
    residual = (problem.y[rows] - W[rows] @ beta) / start.sigma[problem.joint[rows]]
    return float(np.sqrt(np.mean(residual**2)))


def _loop(problem: Problem, robot: DirectModel, start: Estimate, beta: np.ndarray) -> Loop:
    if robot.commanded:
        return robot.chosen(beta)
    return robot.gentlest(beta, lambda way: _misfit(problem, start, robot.columns(way), beta))


def _followed(
    problem: Problem, robot: DirectModel, start: Estimate, beta: np.ndarray, loop: Loop
) -> tuple[list[Motion], Loop]:
    """The simulated motion; where the loop was not in the log, by another one if it must be."""
    try:
        return robot.followed(beta, loop), loop
    except DataError:
        if robot.commanded:
            raise
    loop = _loop(problem, robot, start, beta)
    return robot.followed(beta, loop), loop


def _repeated(
    problem: Problem, method: str, estimate: Callable[[np.ndarray], Estimate]
) -> Estimate:
    """Simulate, estimate, until the step is small beside the standard deviations."""
    model = problem.robot(method)
    idle = [joint.name for joint in model.spec.joints if not joint.actuated]
    if idle:
        raise DataError(
            f'method "{method}": joint {idle[0]} of {model.spec.robot} has no motor; expected one '
            "motor a joint, so that a controller can hold the robot; use another method"
        )
    robot = DirectModel(model, problem.observation)
    start = least_squares(problem.data, "weighted")
    beta, settled = start.beta, False
    loop = _loop(problem, robot, start, beta)
    for _ in range(_ITERATIONS):
        motions, loop = _followed(problem, robot, start, beta, loop)
        found = estimate(robot.columns(motions))
        sigma = np.sqrt(np.diag(found.covariance))
        step = np.abs(found.beta - beta) / np.where(sigma > 0.0, sigma, np.inf)
        beta, settled = found.beta, bool(step.max(initial=0.0) < _NEAR)
        if settled or np.isinf(loop.speed):
            break
    said = _worse(problem, method, start, beta) + _told(problem, robot, loop, robot.error(motions))
    if not settled and np.isfinite(loop.speed):
        said.append(
            f"the values still move by up to {step.max():.2g} sigma from one simulation to the "
            f"next after {_ITERATIONS}; add that to their uncertainty"
        )
    return dataclasses.replace(
        found,
        settled=found.settled and (settled or bool(np.isinf(loop.speed))),
        sentences=(*said, *found.sentences),
    )


def _worse(problem: Problem, method: str, start: Estimate, beta: np.ndarray) -> list[str]:
    """Whether the method ends clearly worse than it started, by its criterion on the log."""
    before, after = (_misfit(problem, start, problem.W, own) for own in (start.beta, beta))
    if after <= _WORSE * before:
        return []
    return [
        f"along the logged motion the values leave {after / before:.3g} times the error of "
        f'"weighted", from which method "{method}" starts: the simulated motion is not that of '
        'the log; take the values of method "weighted"'
    ]


def _told(problem: Problem, robot: DirectModel, loop: Loop, error: np.ndarray) -> list[str]:
    worst = int(np.argmax(error))
    joint = problem.observation.joints[worst].name
    near = f"within {100 * error[worst]:.2g} % of the range of joint {joint}, the farthest"
    if np.isinf(loop.speed):
        how = (
            "the commanded motion is nearer to the log than what any controller that was tried "
            "makes of it"
            if robot.commanded
            else "none that was tried holds the robot with the fitted values, and the logged "
            "motion, smoothed, stands for the simulated one"
        )
    else:
        parts = [("integral action", loop.integral), ("feedforward", loop.forward)]
        fed = " and ".join(f"{'with' if there else 'no'} {name}" for name, there in parts)
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
            f"the fitted inertia matrix is not positive definite in {100 * robot.raised:.0f} % of "
            f"the postures, most at joint {light}: it was raised for the simulation; record "
            "more motion, or leave out parameters that are not essential"
        )
    return said
