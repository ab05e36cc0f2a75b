"""What the standard parameters of a robot are, in plain words, and which rows they belong to."""

from collections.abc import Iterator
from dataclasses import dataclass

from modeler.effects import Effect, EffectColumn
from modeler.robot.robot import Joint, Robot


@dataclass(frozen=True)
class ParameterDescription:
    """A standard parameter.

    Attributes:
        words: what it is.
        unit: SI.
        rows: of the table, that it belongs to.
    """

    words: str
    unit: str
    rows: tuple[str, ...]


def describe_parameters(robot: Robot) -> dict[str, ParameterDescription]:
    """Every standard parameter of the robot, by its name; shared ones besides their members."""
    descriptions = dict(_iterate_descriptions(robot))
    for shared in robot.shared:
        members = [descriptions[name] for name in shared.members if name in descriptions]
        if members:
            rows = tuple(row for member in members for row in member.rows)
            same = f"of the links {', '.join(rows)} alike"
            words = members[0].words.replace(f"of link {rows[0]}", same)
            descriptions[shared.name] = ParameterDescription(words, members[0].unit, rows)
    return descriptions


def _iterate_descriptions(robot: Robot) -> Iterator[tuple[str, ParameterDescription]]:
    for joint in robot.moving_joints:
        for prefix in robot.get_inertial_prefixes(joint.name):
            yield prefix + joint.name, _describe_inertial(prefix, joint.name)
        for effect, form, instance in robot.find_joint_effects(joint.name):
            for column in form.columns:
                name = f"{column.prefix}{joint.name}{instance.label}"
                yield name, _describe_effect_parameter(effect, column, joint)


def _describe_inertial(prefix: str, link: str) -> ParameterDescription:
    where = f"of link {link}"
    if prefix == "M":
        return ParameterDescription(f"mass {where}", "kg", (link,))
    axes = [letter.lower() + link for letter in prefix.removeprefix("M")]
    if prefix.startswith("M"):
        words = f"first moment {where} along {axes[0]}: mass times centre"
        return ParameterDescription(words, "kg m", (link,))
    if axes[0] == axes[1]:
        words = f"moment of inertia {where} about {axes[0]}, at the origin of frame {link}"
    else:
        words = f"product of inertia {where}, of {axes[0]} and {axes[1]}"
    return ParameterDescription(words, "kg m\u00b2", (link,))


def _describe_effect_parameter(
    effect: Effect, column: EffectColumn, joint: Joint
) -> ParameterDescription:
    unit = column.unit_revolute if joint.is_revolute else column.unit_prismatic
    unit = unit.replace("^2", "\u00b2").replace("*", " ")
    return ParameterDescription(f"{effect.title}, joint {joint.name}", unit, (joint.name,))
