"""Where the links are: frames of a modified Denavit-Hartenberg table in the world frame."""

from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.core.expression import Expression
from modeler.robot import Joint, Robot
from modeler.simulate.elementary import sine_and_cosine

FUNCTIONS = {
    "sin": ca.sin, "cos": ca.cos, "tan": ca.tan, "sqrt": ca.sqrt, "exp": ca.exp,
    "abs": ca.fabs, "sign": ca.sign, "tanh": ca.tanh,
}  # fmt: skip


@dataclass(frozen=True)
class Frame:
    """Frame j seen from the world (frame 0).

    Attributes:
        rotation: (3, 3), columns are the axes of frame j; a joint moves about or along column 2.
        position: (3, 1) origin of frame j, m.
        axis: (3, 1) turn or shift per unit of the joint variable: column 2, or its opposite where
            the table says -q; zeros where nothing moves.
    """

    rotation: ca.SX
    position: ca.SX
    axis: ca.SX


BASE = "0"
"""Name of the frame that stands still."""


def world_frames(robot: Robot, q: ca.SX) -> dict[str, Frame]:
    """Every frame of the table by row name, and frame "0", in table order.

    0_T_j = 0_T_a Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986).

    Args:
        robot: its table.
        q: (joints, 1) joint variables in the order of `robot.moving`.
    """
    symbols = robot.symbol_values()
    variables = {joint.name: q[i] for i, joint in enumerate(robot.moving)}
    frames = {BASE: Frame(ca.SX(np.eye(3)), ca.SX(np.zeros((3, 1))), ca.SX.zeros(3))}
    for joint in robot.joints:
        frames[joint.name] = _placed(
            frames[joint.antecedent], joint, symbols, variables.get(joint.name)
        )
    return frames


def gravity_vector(robot: Robot) -> np.ndarray:
    """(3,) acceleration of gravity in the world frame, m/s2."""
    symbols = robot.symbol_values()
    return np.array([component.number(symbols) for component in robot.gravity])


def _placed(
    antecedent: Frame, joint: Joint, symbols: dict[str, float], variable: ca.SX | None
) -> Frame:
    def cell(expression: Expression) -> ca.SX | float:
        if joint.variable not in expression.names:
            return expression.number(symbols)
        values = {**symbols, joint.variable: variable}
        return expression.fold(values, FUNCTIONS, float(np.pi), float)

    swing = antecedent.rotation @ _rotation_z(cell(joint.gamma))
    tilt = swing @ _rotation_x(cell(joint.alpha))
    theta, r = cell(joint.theta), cell(joint.r)
    rotation = tilt @ _rotation_z(theta)
    position = (
        antecedent.position
        + swing[:, 2] * cell(joint.b)
        + tilt[:, 0] * cell(joint.d)
        + rotation[:, 2] * r
    )
    rate = ca.SX(0) if variable is None else ca.jacobian(ca.SX(theta + r), variable)
    return Frame(rotation, position, rotation[:, 2] * rate)


def _rotation_z(angle: ca.SX | float) -> ca.SX:
    c, s = _cosine_and_sine(angle)
    return ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))


def _rotation_x(angle: ca.SX | float) -> ca.SX:
    c, s = _cosine_and_sine(angle)
    return ca.vertcat(ca.horzcat(1, 0, 0), ca.horzcat(0, c, -s), ca.horzcat(0, s, c))


def _cosine_and_sine(angle: ca.SX | float) -> tuple[ca.SX, ca.SX]:
    if isinstance(angle, ca.SX):
        return ca.cos(angle), ca.sin(angle)
    # cos(pi/2) is 6e-17 in floating point; an exact 0 keeps the expressions small.
    s, c = (float(value) for value in sine_and_cosine(angle))
    return ca.SX(c if abs(c) > 1e-15 else 0.0), ca.SX(s if abs(s) > 1e-15 else 0.0)
