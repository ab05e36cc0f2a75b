"""What the standard parameters of a robot are, in plain words, and which rows they belong to."""

from collections.abc import Iterator
from dataclasses import dataclass

from modeler.effects import Effect, EffectColumn
from modeler.robot.robot import Joint, Robot


@dataclass(frozen=True)
class ParameterWords:
    """A standard parameter.

    Attributes:
        words: what it is.
        unit: SI.
        rows: of the table, that it belongs to.
    """

    words: str
    unit: str
    rows: tuple[str, ...]


def parameter_words(robot: Robot) -> dict[str, ParameterWords]:
    """Every standard parameter of the robot, by its name; shared ones besides their members."""
    found = dict(_single(robot))
    for shared in robot.shared:
        members = [found[name] for name in shared.members if name in found]
        if members:
            rows = tuple(row for member in members for row in member.rows)
            same = f"of the links {', '.join(rows)} alike"
            words = members[0].words.replace(f"of link {rows[0]}", same)
            found[shared.name] = ParameterWords(words, members[0].unit, rows)
    return found


def _single(robot: Robot) -> Iterator[tuple[str, ParameterWords]]:
    for joint in robot.moving:
        for prefix in robot.inertial(joint.name):
            yield prefix + joint.name, _inertial(prefix, joint.name)
        for effect, form, instance in robot.effects_on(joint.name):
            for column in form.columns:
                name = f"{column.prefix}{joint.name}{instance.label}"
                yield name, _of_effect(effect, column, joint)


def _inertial(prefix: str, link: str) -> ParameterWords:
    where = f"of link {link}"
    if prefix == "M":
        return ParameterWords(f"mass {where}", "kg", (link,))
    axes = [letter.lower() + link for letter in prefix.removeprefix("M")]
    if prefix.startswith("M"):
        words = f"first moment {where} along {axes[0]}: mass times centre"
        return ParameterWords(words, "kg m", (link,))
    if axes[0] == axes[1]:
        words = f"moment of inertia {where} about {axes[0]}, at the origin of frame {link}"
    else:
        words = f"product of inertia {where}, of {axes[0]} and {axes[1]}"
    return ParameterWords(words, "kg m\u00b2", (link,))


def _of_effect(effect: Effect, column: EffectColumn, joint: Joint) -> ParameterWords:
    unit = column.unit_revolute if joint.angular else column.unit_prismatic
    unit = unit.replace("^2", "\u00b2").replace("*", " ")
    return ParameterWords(f"{effect.title}, joint {joint.name}", unit, (joint.name,))
