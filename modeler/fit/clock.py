"""Is the time of the logs in seconds? The clock that a robot carries with it is gravity."""

from typing import TYPE_CHECKING

import numpy as np

from modeler.core.errors import LoopError
from modeler.fit.doubts import Doubt
from modeler.fit.result import FitResult
from modeler.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

SLOW = 0.2
"""s; with fewer than five rows a second neither accelerations nor reversals are seen."""

ABSURD = 100.0
"""Length of the pendulum that a joint and its links swing like, over the reach of the robot."""

LOADED = 0.1
"""Gravity over torque of a joint, from which on it swings."""

_GRAVITY = 9.81  # m/s^2
_POSES = 40
_UNITS = (("milliseconds", 1e-3), ("microseconds", 1e-6), ("nanoseconds", 1e-9), ("minutes", 60.0),
          ("hours", 3600.0))  # fmt: skip
_USUAL = (20.0, 2e4)  # Hz; rates at which robots are logged


def time_doubts(model: "CompiledModel", observation: Observation, result: FitResult) -> list[Doubt]:
    """Time steps that no log of a robot has, and inertias that belong to another unit of time.

    Accelerations scale with 1/time^2, gravity does not. With the time in milliseconds inertias
    come out a million times too large beside first moments: a joint with its links, inertia J and
    greatest gravity torque m, is a pendulum as long as J g / m, which is about as long as the
    links are, counterweights and rotors included. A hundred times the robot's reach, on all joints
    that gravity loads, is another unit of time.
    """
    found = [
        doubt for log in observation.report.logs for doubt in _odd_step(log.name, 1.0 / log.rate)
    ]
    ratio = _pendulum(model, observation, result)
    if not found and ratio > ABSURD:
        found.append(
            Doubt(
                f"the inertias are {ratio:.2g} times those of links of this reach under this "
                f"gravity: the time of the logs runs about {ratio**0.5:.2g} times too slowly, or "
                "the lengths of the table are not in metres; give seconds and metres",
                certain=True,
            )
        )
    return found


def _odd_step(name: str, step: float) -> list[Doubt]:
    if step > SLOW:
        what = "with which neither accelerations nor reversals are seen"
        return [Doubt(f"{name}: median time step {step:.3g} s, {what}: {_unit(step)}", True)]
    if step < 1.0 / _USUAL[1]:
        what = "faster than robots are logged"
        line = f"{name}: median time step {step:.3g} s, {what}: {_unit(step)}"
        return [Doubt(line, values=True)]
    return []


def _unit(step: float) -> str:
    """What the unit may be, and what to do."""
    for name, seconds in _UNITS:
        rate = 1.0 / (step * seconds)
        if _USUAL[0] <= rate <= _USUAL[1]:
            return (
                f"were the column time in {name}, the rows came at {rate:.4g} Hz; multiply it by "
                f"{seconds:g} if they are"
            )
    return "is the column time in seconds, or a count of rows? give seconds"


def _pendulum(model: "CompiledModel", observation: Observation, result: FitResult) -> float:
    """Least J g / m over the reach, over the joints that turn and that gravity loads; 0 if none."""
    q = _poses(model, observation)
    kinds = np.array([base.kind for base in model.spec.base])
    links = np.where(kinds == "inertial", result.beta, 0.0)
    if not len(q):
        return 0.0
    reach = _reach(model.forward_kinematics(q)[..., 3])
    weight = np.abs(model.gravity(q, links)).max(axis=0)
    inertia = np.median(
        np.abs(np.diagonal(model.inertia_matrix(q, result.beta), axis1=1, axis2=2)), axis=0
    )
    torque = np.sqrt(np.mean(observation.torque**2, axis=0))
    turns = np.array([joint.unit == "rad" and joint.actuated for joint in model.spec.joints])
    loaded = turns & (weight > LOADED * torque) & (weight > 0.0)
    if reach == 0.0 or not loaded.any():
        return 0.0
    return float(np.min(inertia[loaded] * _GRAVITY / weight[loaded]) / reach)


def _poses(model: "CompiledModel", observation: Observation) -> np.ndarray:
    """(n, joints) logged poses, at most 40 of them; those in which the loops close."""
    q = observation.q[:: max(1, len(observation.q) // _POSES)]
    if model.spec.closure is None:
        return q
    return np.array([pose for pose in q if _closes(model, pose)]).reshape(-1, q.shape[1])


def _closes(model: "CompiledModel", pose: np.ndarray) -> bool:
    try:
        model.coupling(pose[None])
    except LoopError:
        return False
    return True


def _reach(origins: np.ndarray) -> float:
    """m; the largest distance of two frames in any of the poses (n, rows, 3)."""
    return float(np.linalg.norm(origins[:, :, None] - origins[:, None], axis=-1).max())
