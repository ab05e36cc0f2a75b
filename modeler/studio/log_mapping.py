"""Which column of a log is which quantity of ours: as menus show it, and as words of `--map`."""

import dataclasses
import re
import tomllib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs import LogMap, MappedColumn, find_unit, map_from_table, map_from_words, si_unit

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
    "q": "position", "qd": "speed", "tau": "torque", "current": "current",
    "qc": "commanded position", "qdd": "acceleration", "duty": "duty", "voltage": "voltage",
    "temperature": "temperature",
}  # fmt: skip
"""What is known of joints, and what people call it; the first three always stand in the table."""

_RANGED = "# by its range"  # as a suggested [log] says it


@dataclass(frozen=True)
class Choice:
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
    choices: Mapping[str, Choice]
    ranged: tuple[str, ...]
    joints: int
    topic: str
    doubts: tuple[str, ...]


def anybody(count: int) -> tuple[JointSpec, ...]:
    """Joints of a robot that nobody has described yet."""
    return tuple(JointSpec(str(k + 1), "revolute", "rad", "N m", True, None) for k in range(count))


def names_of(joints: Sequence[JointSpec], kinds: Iterable[str]) -> list[str]:
    """Our names of those kinds, joint after joint; `time` goes before."""
    return ["time", *(f"{kind}{joint.name}" for joint in joints for kind in kinds)]


def kind_of(own: str, joints: Sequence[JointSpec]) -> tuple[str, JointSpec | None]:
    """`qd2` -> "qd" and joint 2; what is of no joint is a kind of its own."""
    for joint in joints:
        kind = own.removesuffix(joint.name)
        if kind != own and kind in KINDS:
            return kind, joint
    return own, None


def units_of(own: str, joints: Sequence[JointSpec]) -> tuple[str, ...]:
    """Units that a menu offers for one of ours; SI first."""
    kind, joint = kind_of(own, joints)
    if joint is not None and kind in ("q", "qd", "qdd", "qc"):
        return UNITS[f"{kind.replace('qc', 'q')} {joint.unit}"]
    if joint is not None and kind == "tau":
        return UNITS[f"tau {joint.effort_unit}"]
    return UNITS.get(kind, ("",))


def said(words: Sequence[str], stated: Mapping[str, Any], where: str) -> LogMap:
    """Words of `--map`, and under them the [log] of a robot file."""
    return map_from_words(words).overriding(map_from_table(stated, f"{where}: [log]"))


def choices(
    names: LogMap, joints: Sequence[JointSpec], columns: Collection[str]
) -> dict[str, Choice]:
    """Our name -> column, of a map, and of columns that are called as ours are."""
    every = names_of(joints, KINDS)
    found = {own: Choice(own) for own in every if own in columns}
    for own, entry in names.entries(joints).items():
        there = next((name for name in entry.columns if name in columns), None)
        if there is None and own in found and not entry.strict:
            continue  # what the robot file says is for other logs
        unit = "" if entry.unit is None else entry.unit.text
        if entry.scale != 1.0:
            unit = f"{entry.scale:.12g} {unit or units_of(own, joints)[0]}".rstrip()
        column = there or entry.columns[0].removesuffix(f" [{UNTOLD}]")
        found[own] = Choice(column, unit, int(entry.sign), entry.offset)
    return found


def words_of(
    wanted: Mapping[str, Choice], under: Mapping[str, Choice], joints: Sequence[JointSpec]
) -> tuple[str, ...]:
    """The words of `--map` that make a mapping of another one; patterns where all joints are alike.

    Args:
        wanted: our name -> column.
        under: what is so without any words: own names, [log] of the robot file.
        joints: of the robot.

    Raises:
        DataError: a name of a column that `--map` cannot take.
    """
    left = {own: one for own, one in wanted.items() if under.get(own) != one}
    words = []
    for kind in KINDS:
        own = {joint.name: left.get(f"{kind}{joint.name}") for joint in joints}
        pattern = _pattern(own, joints)
        if pattern is not None:
            words.append(_word(f"{kind}<j>", pattern, joints))
            for joint in own:
                del left[f"{kind}{joint}"]
    order = names_of(joints, KINDS)
    known = sorted(left, key=lambda own: order.index(own) if own in order else len(order))
    singles = [_word(own, left[own], joints) for own in known]
    return (*singles[: "time" in left], *words, *singles["time" in left :])


def _pattern(own: Mapping[str, Choice | None], joints: Sequence[JointSpec]) -> Choice | None:
    """The one choice with a placeholder that all joints are made of; None if there is none."""
    first = own[joints[0].name] if joints else None
    if first is None or len(joints) < 2:
        return None
    number = re.search(r"\d+(?!.*\d)", first.column)
    marks = {"{j}": joints[0].name}
    if number is not None:
        marks["{n}" if number[0] == "1" else f"{{n{int(number[0]) - 1:+d}}}"] = number[0]
    for mark, label in marks.items():
        head, found, tail = first.column.rpartition(label)
        pattern = dataclasses.replace(first, column=f"{head}{mark}{tail}")
        entry = MappedColumn((pattern.column,))
        made = [entry.of(joint.name, k, joint.name).columns[0] for k, joint in enumerate(joints)]
        every = [dataclasses.replace(first, column=column) for column in made]
        if found and every == list(own.values()):
            return pattern
    return None


def _word(own: str, one: Choice, joints: Sequence[JointSpec]) -> str:
    """`q2=-enc2:deg`; what is read back is what was meant."""
    word = f"{own}={'-' * (one.sign < 0)}{one.column}"
    word += f":{one.unit}" if one.unit else ""
    entry = map_from_words([word]).layers[0].get(own)
    unit = "" if entry is None or entry.unit is None else entry.unit.text
    kept = entry is not None and one.column in entry.columns and entry.sign == one.sign
    plain = units_of(own.replace("<j>", joints[0].name if joints else ""), joints)[0]
    if not kept and not one.unit and plain:  # a name that ends as if in a unit
        return _word(own, dataclasses.replace(one, unit=plain), joints)
    if not kept or (one.unit and unit != one.unit) or one.offset:
        raise DataError(
            f'{own}: a column called "{one.column}" cannot be named with --map; rename it, or say '
            "it in [log] of the robot file"
        )
    return word


def guess_from(
    text: str, joints: Sequence[JointSpec], columns: Collection[str]
) -> tuple[dict[str, Choice], tuple[str, ...]]:
    """The choices of a suggested [log], and our names whose unit rests on a range alone."""
    names = map_from_table(tomllib.loads(text)["log"], "guess") if text else LogMap()
    found = choices(names, joints, columns)
    told = [line.split(" =")[0].strip('"') for line in text.split("\n") if _RANGED in line]
    ranged = [o for o in found if o in told or f"{kind_of(o, joints)[0]}<j>" in told]
    return {own: one for own, one in found.items() if one != Choice(own)}, tuple(ranged)


def as_mapped(
    values: np.ndarray, stated: str, one: Choice, own: str, joints: Sequence[JointSpec]
) -> np.ndarray:
    """Values of a column as one of ours, SI.

    Args:
        values: in SI of the unit that the file states, as they are read without a mapping.
        stated: that unit; "" for none.
        one: what the column is taken as.
        own: our name.
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
        example = units_of(own, joints)[0]
        raise DataError(f'{own}: got unit "{one.unit}"; expected one such as {example}')
    if unit is None:
        return values
    known = si_unit(own, own, unit, joints)
    return (values + known.zero) * known.factor
