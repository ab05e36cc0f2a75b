"""The standard parameters of a robot: which columns the regressor has, and in which order."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction

from modeler.effects import Acts, EffectColumn, Memory
from modeler.robot import Joint, Robot
from modeler.symbolic.geometry import Geometry

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
        shaft: for an effect, {k: coefficient}; the speed of the shaft is v = sum of coefficient *
            ud[k] over the free variables, and it turns them back with the same coefficients.
        acts: on what the effect acts.
        shapes: values of the effect's shape parameters.
        memory: of its inner state.
        others: columns of the same parameter on other rows, which similar legs share; the
            parameter's column is the sum of its `parts`.
    """

    name: str
    row: int
    prefix: str
    unit: str
    kind: str
    effect: str
    column: EffectColumn | None = None
    shaft: Mapping[int, Fraction] | None = None
    acts: Acts = Acts.JOINT
    shapes: Mapping[str, float] = field(default_factory=dict)
    memory: Memory | None = None
    others: tuple["StandardColumn", ...] = ()

    @property
    def parts(self) -> tuple["StandardColumn", ...]:
        """The column on every row that has the parameter."""
        return (self, *self.others)


def standard_columns(geometry: Geometry) -> tuple[StandardColumn, ...]:
    """All standard parameters: row after row, the link's, then those of the joint's effects.

    A shared parameter stands where its first member would.
    """
    robot = geometry.robot
    columns: list[StandardColumn] = []
    for row, joint in enumerate(robot.joints):
        if joint.moves:
            columns += [_inertial(prefix, row, joint) for prefix in robot.inertial(joint.name)]
            columns += _effect_columns(geometry, row, joint)
    return _shared(robot, columns)


def _shared(robot: Robot, columns: list[StandardColumn]) -> tuple[StandardColumn, ...]:
    by_name = {column.name: column for column in columns}
    for shared in robot.shared:
        first, *others = (by_name[name] for name in shared.members)
        by_name[shared.members[0]] = replace(first, name=shared.name, others=tuple(others))
        for other in others:
            del by_name[other.name]
    return tuple(by_name.values())


def _inertial(prefix: str, row: int, joint: Joint) -> StandardColumn:
    unit = _INERTIAL_UNITS.get(prefix, "kg")
    return StandardColumn(prefix + joint.name, row, prefix, unit, "inertial", "rigid_body")


def _effect_columns(geometry: Geometry, row: int, joint: Joint) -> list[StandardColumn]:
    found = []
    for effect, form, instance in geometry.robot.effects_on(joint.name):
        for column in form.columns:
            found.append(
                StandardColumn(
                    name=column.prefix + joint.name + instance.label,
                    row=row,
                    prefix=column.prefix,
                    unit=column.unit_revolute if joint.angular else column.unit_prismatic,
                    kind=column.kind,
                    effect=effect.id,
                    column=column,
                    shaft=_shaft(geometry, joint, effect.coupled),
                    acts=effect.acts,
                    shapes=instance.shapes,
                    memory=form.memory,
                )
            )
    return found


def _shaft(geometry: Geometry, joint: Joint, coupled: bool) -> dict[int, Fraction]:
    """The shaft's speed in the speeds of the free variables."""
    order = {moving.name: index for index, moving in enumerate(geometry.robot.moving)}
    coupling = geometry.robot.coupling[joint.name] if coupled else {joint.name: 1.0}
    total: dict[int, Fraction] = {}
    for name, factor in coupling.items():
        for k, coefficient in geometry.forms[order[name]].items():
            total[k] = total.get(k, Fraction(0)) + exact(factor) * coefficient
    return {k: coefficient for k, coefficient in total.items() if coefficient}


def exact(value: float) -> Fraction:
    """A coefficient of the robot file as the decimal fraction that was written."""
    return Fraction(repr(value))
