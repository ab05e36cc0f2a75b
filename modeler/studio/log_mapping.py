"""Which column of a log is which quantity of ours: as menus show it, and as words of `--map`."""

import dataclasses
import re
import tomllib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.api.front_end import (
    DataError,
    JointSpec,
    LogMap,
    MappedColumn,
    build_map,
    find_unit,
    parse_map_options,
    resolve_si_unit,
)

UNTOLD = "rev/COUNTS"
"""What a guess calls the unit of an encoder of which nobody said how many counts a turn are."""

UNITS: Mapping[str, tuple[str, ...]] = {
    "time": ("s", "ms", "us", "ns"),
    "q rad": ("rad", "deg", "rev", "mrad"), "q m": ("m", "mm", "in"),
    "qd rad": ("rad/s", "deg/s", "rpm", "rev/s"), "qd m": ("m/s", "mm/s"),
    "qdd rad": ("rad/s^2", "deg/s^2"), "qdd m": ("m/s^2", "mm/s^2"),
    "tau N m": ("N m", "mN m", "kN m", "kg cm", "lb in"), "tau N": ("N", "mN", "kN", "kgf", "lbf"),
    "current": ("", "A", "mA", "%"), "duty": ("", "%", "0.1 %"), "voltage": ("V", "mV"),
    "temperature": ("degC", "K", "degF"),
}  # fmt: skip
"""Units that menus offer, SI first; "" is what the drive has. Any other one can be typed."""

KINDS: Mapping[str, str] = {
    "q": "position",
    "qd": "speed",
    "tau": "torque",
    "current": "current",
    "qc": "commanded position",
    "qdd": "acceleration",
    **{name: name for name in ("duty", "voltage", "temperature")},
}
"""What is known of joints, and what people call it; the first three always stand in the table."""

_RANGED = "# by its range"  # as a suggested [log] says it


@dataclass(frozen=True)
class ColumnChoice:
    """A column of a file that is one of ours.

    Attributes:
        column: its name in the file.
        unit: that its numbers are in, a factor in it; "" for SI, or what the file says.
        sign: 1 or -1.
        offset: added, in the unit; only a robot file can say that.
    """

    column: str
    unit: str = ""
    sign: int = 1
    offset: float = 0.0


@dataclass(frozen=True)
class LogGuess:
    """What a log is by its names and ranges.

    Attributes:
        columns: of the file, those with numbers, and units that it states of them; "" for none.
        choices: our name -> column; without those that are called so in the file already.
        ranged: our names whose unit rests on a range alone.
        joints: how many positions there are.
        topic: of a bag with several, "" else.
        doubts: of the log, as `modeler log` says them without a fit.
    """

    columns: Mapping[str, str]
    choices: Mapping[str, ColumnChoice]
    ranged: tuple[str, ...]
    joints: int
    topic: str
    doubts: tuple[str, ...]


def build_default_joints(count: int) -> tuple[JointSpec, ...]:
    """Builds the joints of a robot that is not described yet."""
    return tuple(JointSpec(str(k + 1), "revolute", "rad", "N m", True, None) for k in range(count))


def collect_names(joints: Sequence[JointSpec], kinds: Iterable[str]) -> list[str]:
    """Collects `time` and the quantities of these kinds, joint after joint."""
    return ["time", *(f"{kind}{joint.name}" for joint in joints for kind in kinds)]


def split_quantity(quantity: str, joints: Sequence[JointSpec]) -> tuple[str, JointSpec | None]:
    """Splits `qd2` into "qd" and joint 2; other names have no joint."""
    for joint in joints:
        kind = quantity.removesuffix(joint.name)
        if kind != quantity and kind in KINDS:
            return kind, joint
    return quantity, None


def select_units(quantity: str, joints: Sequence[JointSpec]) -> tuple[str, ...]:
    """Returns the units that a menu offers for a quantity, SI first."""
    kind, joint = split_quantity(quantity, joints)
    if joint is not None and kind in ("q", "qd", "qdd", "qc"):
        return UNITS[f"{kind.replace('qc', 'q')} {joint.unit}"]
    if joint is not None and kind == "tau":
        return UNITS[f"tau {joint.effort_unit}"]
    return UNITS.get(kind, ("",))


def merge_map(words: Sequence[str], stated: Mapping[str, Any], where: str) -> LogMap:
    """Merges words of `--map` over the [log] of a robot file."""
    return parse_map_options(words).merge_over(build_map(stated, f"{where}: [log]"))


def build_choices(
    names: LogMap, joints: Sequence[JointSpec], columns: Collection[str]
) -> dict[str, ColumnChoice]:
    """Builds the column of each quantity from a map and from equal names."""
    choices = {name: ColumnChoice(name) for name in collect_names(joints, KINDS) if name in columns}
    for quantity, entry in names.expand_entries(joints).items():
        present = next((name for name in entry.columns if name in columns), None)
        if present is None and quantity in choices and not entry.strict:
            continue  # what the robot file says is for other logs
        unit = "" if entry.unit is None else entry.unit.text
        if entry.scale != 1.0:
            unit = f"{entry.scale:.12g} {unit or select_units(quantity, joints)[0]}".rstrip()
        column = present or entry.columns[0].removesuffix(f" [{UNTOLD}]")
        choices[quantity] = ColumnChoice(column, unit, int(entry.sign), entry.offset)
    return choices


def build_map_words(
    target: Mapping[str, ColumnChoice],
    under: Mapping[str, ColumnChoice],
    joints: Sequence[JointSpec],
) -> tuple[str, ...]:
    """Builds the words of `--map` that change one mapping into another.

    Args:
        target: our name -> column.
        under: what is so without any words: own names, [log] of the robot file.
        joints: of the robot.

    Raises:
        DataError: a name of a column that `--map` cannot take.
    """
    left = {quantity: one for quantity, one in target.items() if under.get(quantity) != one}
    words = []
    for kind in KINDS:
        quantity = {joint.name: left.get(f"{kind}{joint.name}") for joint in joints}
        pattern = _find_pattern(quantity, joints)
        if pattern is not None:
            words.append(_format_word(f"{kind}<j>", pattern, joints))
            for joint in quantity:
                del left[f"{kind}{joint}"]
    order = collect_names(joints, KINDS)
    known = sorted(left, key=lambda name: order.index(name) if name in order else len(order))
    singles = [_format_word(quantity, left[quantity], joints) for quantity in known]
    return (*singles[: "time" in left], *words, *singles["time" in left :])


def _find_pattern(
    joint_choices: Mapping[str, ColumnChoice | None], joints: Sequence[JointSpec]
) -> ColumnChoice | None:
    """The one choice with a placeholder that all joints are made of; None if there is none."""
    first = joint_choices[joints[0].name] if joints else None
    if first is None or len(joints) < 2:
        return None
    number = re.search(r"\d+(?!.*\d)", first.column)
    marks = {"{j}": joints[0].name}
    if number is not None:
        marks["{n}" if number[0] == "1" else f"{{n{int(number[0]) - 1:+d}}}"] = number[0]
    for mark, label in marks.items():
        head, matched, tail = first.column.rpartition(label)
        pattern = dataclasses.replace(first, column=f"{head}{mark}{tail}")
        entry = MappedColumn((pattern.column,))
        every = [
            dataclasses.replace(first, column=entry.expand_for_joint(name, k, name).columns[0])
            for k, name in enumerate(joint_choices)
        ]
        if matched and every == list(joint_choices.values()):
            return pattern
    return None


def _format_word(quantity: str, one: ColumnChoice, joints: Sequence[JointSpec]) -> str:
    """`q2=-enc2:deg`; what is read back is what was meant."""
    word = f"{quantity}={'-' * (one.sign < 0)}{one.column}"
    word += f":{one.unit}" if one.unit else ""
    entry = parse_map_options([word]).layers[0].get(quantity)
    unit = "" if entry is None or entry.unit is None else entry.unit.text
    is_preserved = entry is not None and one.column in entry.columns and entry.sign == one.sign
    plain = select_units(quantity.replace("<j>", joints[0].name if joints else ""), joints)[0]
    if not is_preserved and not one.unit and plain:  # a name that ends as if in a unit
        return _format_word(quantity, dataclasses.replace(one, unit=plain), joints)
    if not is_preserved or (one.unit and unit != one.unit) or one.offset:
        raise DataError(
            f'{quantity}: a column called "{one.column}" cannot be named with --map; rename it, or '
            "say it in [log] of the robot file"
        )
    return word


def parse_guess(
    text: str, joints: Sequence[JointSpec], columns: Collection[str]
) -> tuple[dict[str, ColumnChoice], tuple[str, ...]]:
    """Parses a suggested [log]: choices, and quantities whose unit is guessed by range."""
    names = build_map(tomllib.loads(text)["log"], "guess") if text else LogMap()
    choices = build_choices(names, joints, columns)
    ranged_lines = [line.split(" =")[0].strip('"') for line in text.split("\n") if _RANGED in line]
    patterns = {name: f"{split_quantity(name, joints)[0]}<j>" for name in choices}
    ranged = [name for name in choices if {name, patterns[name]} & {*ranged_lines}]
    choices = {name: one for name, one in choices.items() if one != ColumnChoice(name)}
    return choices, tuple(ranged)


def apply_choice(
    values: np.ndarray, stated: str, one: ColumnChoice, quantity: str, joints: Sequence[JointSpec]
) -> np.ndarray:
    """Converts the values of a column to a quantity in SI units.

    Args:
        values: in SI of the unit that the file states, as they are read without a mapping.
        stated: that unit; "" for none.
        one: what the column is taken as.
        quantity: our name.
        joints: of the robot.

    Raises:
        DataError: a unit that cannot be.
    """
    before = find_unit(stated) if stated else None
    if before is not None:
        values = values / before.factor - before.zero
    values = one.sign * values + one.offset
    unit = find_unit(one.unit) if one.unit else before
    if unit is None and one.unit:
        example = select_units(quantity, joints)[0]
        raise DataError(f'{quantity}: got unit "{one.unit}"; expected one such as {example}')
    if unit is None:
        return values
    known = resolve_si_unit(quantity, quantity, unit, joints)
    return (values + known.zero) * known.factor
