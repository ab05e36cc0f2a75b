"""The standard parameters of a robot: which columns the regressor has, and in which order."""

from collections.abc import Mapping
from dataclasses import dataclass

from modeler.effects import CATALOGUE, EffectColumn
from modeler.robot import INERTIAL, Joint, Robot

_INERTIAL_UNITS = dict.fromkeys(("XX", "XY", "XZ", "YY", "YZ", "ZZ"), "kg m2") | dict.fromkeys(
    ("MX", "MY", "MZ"), "kg m"
)


@dataclass(frozen=True)
class StandardColumn:
    """One standard parameter.

    Attributes:
        name: "XX2", "Fv1".
        row: index of its row in the table.
        prefix: "XX", "Fv".
        unit: of the parameter.
        kind: inertial | rotor_inertia | friction | offset.
        effect: "rigid_body" or the id of the effect.
        column: the effect's column; None for the ten inertial parameters.
        shaft: for an effect, {index of the joint variable: coefficient}; the speed of the shaft is
            v = sum of coefficient * qd, and it turns the joints back with the same coefficients.
    """

    name: str
    row: int
    prefix: str
    unit: str
    kind: str
    effect: str
    column: EffectColumn | None = None
    shaft: Mapping[int, float] | None = None


def standard_columns(robot: Robot) -> tuple[StandardColumn, ...]:
    """All standard parameters: row after row, the link's ten, then those of the joint's effects."""
    columns: list[StandardColumn] = []
    for row, joint in enumerate(robot.joints):
        if joint.moves:
            columns += [_inertial(prefix, row, joint) for prefix in INERTIAL]
            columns += _effect_columns(robot, row, joint)
    return tuple(columns)


def _inertial(prefix: str, row: int, joint: Joint) -> StandardColumn:
    unit = _INERTIAL_UNITS.get(prefix, "kg")
    return StandardColumn(prefix + joint.name, row, prefix, unit, "inertial", "rigid_body")


def _effect_columns(robot: Robot, row: int, joint: Joint) -> list[StandardColumn]:
    found = []
    for effect in CATALOGUE:
        if robot.has_effect(effect.id, joint.name):
            for column in effect.columns:
                unit = column.unit_revolute if joint.angular else column.unit_prismatic
                shaft = _shaft(robot, joint, effect.coupled)
                found.append(
                    StandardColumn(
                        column.prefix + joint.name,
                        row,
                        column.prefix,
                        unit,
                        column.kind,
                        effect.id,
                        column,
                        shaft,
                    )
                )
    return found


def _shaft(robot: Robot, joint: Joint, coupled: bool) -> dict[int, float]:
    order = {moving.name: index for index, moving in enumerate(robot.moving)}
    if not coupled:
        return {order[joint.name]: 1}
    return {order[name]: c for name, c in robot.coupling[joint.name].items()}
