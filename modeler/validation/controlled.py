"""The fitted robot under a controller that follows the logged commands."""

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.estimation.direct_model import ControlLoop, DirectModel
from modeler.observation.observation import Observation
from modeler.runtime.model import CompiledModel
from modeler.validation.free_run_result import Controlled
from modeler.validation.stability import fit_percentage

Gains = tuple[float, float, float, float]
"""Speed loop, Hz; ratio of the position loop; integral action; feedforward."""

_NONE_NEARER = "no controller that was tried brings the robot nearer to the log than the command is"
_LOST = "no controller that was tried holds the robot with the fitted values all along the log"


def controlled(
    model: CompiledModel, beta: np.ndarray, observation: Observation, gains: Gains | None
) -> tuple[Controlled | None, str]:
    """The robot under the given controller, or under one that comes nearest to the log.

    The controller of a log is not known; it is estimated as for `didim`, see `direct_model`.

    Returns:
        What became of it, and a doubt, "" without one. None: no commands were logged and none is
        asked for, or none that was tried holds the robot.

    Raises:
        DataError: gains are given, and no commands were logged or the robot is lost.
    """
    robot = DirectModel(model, observation)
    if not robot.commanded:
        if gains is None:
            return None, ""
        raise DataError(
            f"--controller: {observation.logs[0]}: no complete columns "
            f"qc{observation.joints[0].name} ...; expected commanded positions of all joints, "
            "which the controller is to follow; log them, or leave --controller out"
        )
    if gains is None and not all(joint.actuated for joint in model.spec.joints):
        return None, "a joint has no motor, so no controller is looked for"
    try:
        loop = (
            robot.chosen(beta) if gains is None else ControlLoop(2 * np.pi * gains[0], *gains[1:])
        )
        if np.isinf(loop.speed):
            return None, _NONE_NEARER
        motions = robot.followed(beta, loop)
        return _measured(observation, robot, loop, motions, beta, gains is not None), ""
    except (DataError, LoopError):
        if gains is not None:
            raise DataError(
                f"--controller: with these gains {model.spec.robot} is lost; expected those of a "
                "controller that holds it, as the speed loop in Hz and the ratio of the position "
                "loop; try slower loops, or leave --controller out"
            ) from None
        return None, _LOST


def _measured(
    observation: Observation,
    robot: DirectModel,
    loop: ControlLoop,
    motions: list[np.ndarray],
    beta: np.ndarray,
    given: bool,
) -> Controlled:
    kept = [segment.whole for segment in robot.segments]
    q = np.concatenate([s.q[own] for s, own in zip(robot.segments, kept, strict=True)])
    simulated = np.concatenate([m[0][own] for m, own in zip(motions, kept, strict=True)])
    wanted = np.concatenate([r[0][own] for r, own in zip(robot.references, kept, strict=True)])
    rows, torque = observation.row_joint, robot.columns(motions) @ beta
    fit, tracking, effort = (dict[str, float | None]() for _ in range(3))
    for j, joint in enumerate(observation.joints):
        fit[joint.name] = fit_percentage(q[:, j], simulated[:, j])
        left = float(np.linalg.norm(q[:, j] - wanted[:, j]))
        error = float(np.linalg.norm(q[:, j] - simulated[:, j]))
        tracking[joint.name] = 100.0 * (1.0 - error / left) if left > 0.0 else None
        own = rows == j
        effort[joint.name] = fit_percentage(observation.y[own], torque[own]) if own.any() else None
    return Controlled(
        loop.speed / (2 * np.pi), loop.ratio, loop.integral, loop.forward, given,
        fit, tracking, effort,
    )  # fmt: skip
