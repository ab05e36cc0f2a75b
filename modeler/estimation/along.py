"""What a model says of one joint that moves alone: known functions of its motion, and weights.

While joint i moves alone, with position a, speed v and acceleration u, the torque of any joint k is
a sum of the functions u, v^2 and 1, each times 1, sin a or cos a, and of friction: what turns about
one axis is one rigid body. For joint i itself that is J u + A sin a + B cos a + friction, four or
five columns; for the others it holds J_ki and the centrifugal S_kii too (Hanssen, Hovland and
Brogardh 2000, sections 2.2 and 5). Their weights are linear in the base parameters.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.runtime.model import CompiledModel

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

    def columns(self, a: np.ndarray, v: np.ndarray, u: np.ndarray) -> np.ndarray:
        """(samples, p) of position, speed and acceleration of the joint that moves."""
        return np.column_stack([FUNCTIONS[name](a, v, u) for name in self.names])


@dataclass(frozen=True, eq=False)
class Alone:
    """A joint that moves alone.

    Attributes:
        q: (n,) coordinates at some place of its motion.
        a: its position there.
        way: (n,) speed of the coordinates at its speed 1.
        span: range of its positions, for robots with loops.
    """

    q: np.ndarray
    a: float
    way: np.ndarray
    span: tuple[float, float]


def along(
    model: CompiledModel, alone: Alone, felt: np.ndarray
) -> tuple[SingleJointMotion | None, ...]:
    """The torques felt by some joints while one moves alone; None for what is no such sum.

    Args:
        model: the robot.
        alone: the joint that moves.
        felt: (k, n) directions of the joints that feel it.

    Raises:
        DataError: the model has effects that read more than the motion.
    """
    if model.spec.signals:
        raise DataError(
            f"{model.spec.robot}: the two-step fit knows friction that depends on the speed, and "
            "some effect of the robot reads time, temperature or travel; use --method weighted"
        )
    rng = np.random.default_rng(_SEED)
    span = (alone.a - _REACH, alone.a + _REACH) if model.spec.closure is None else alone.span
    a = rng.uniform(*span, _POINTS)
    v, u = rng.uniform(-1.0, 1.0, (2, _POINTS))
    q = alone.q + (a - alone.a)[:, None] * alone.way
    rows = model.base_regressor(q, v[:, None] * alone.way, u[:, None] * alone.way)
    matrix = np.column_stack([function(a, v, u) for function in FUNCTIONS.values()])
    return tuple(_along(matrix, np.einsum("tjc,j->tc", rows, way)) for way in felt)


def _along(matrix: np.ndarray, values: np.ndarray) -> SingleJointMotion | None:
    """values (t, c) = matrix (t, functions) V, functions without weight left out.

    None where other functions are needed, and where nothing is felt.
    """
    weights = np.linalg.lstsq(matrix, values, rcond=None)[0]
    size = np.abs(values).max()
    if size == 0.0 or np.abs(matrix @ weights - values).max() > _EXACT * size:
        return None
    kept = np.flatnonzero(np.abs(weights).max(axis=1) > _EXACT * size)
    return SingleJointMotion(tuple(np.array([*FUNCTIONS])[kept].tolist()), weights[kept])
