"""Whose column is which: names, units and signs of a log, said once in [log] or by --map."""

import dataclasses
import difflib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError
from modeler.core.files import read_text
from modeler.core.json_text import parse_toml, shown
from modeler.logs.units import EXAMPLES, Unit, find_unit

_NONE: Mapping = MappingProxyType({})
_LARGEST = 1e100  # beyond, products are no numbers any more
_KEYS = ("column", "unit", "sign", "scale", "offset")
_SETTINGS = ("topic", "names", "rate")
_BRACKETS = re.compile(r"(.*\S)\s+\[([^\[\]]+)\]")
JOINT = "<j>"
"""Stands for every joint of the robot in our name of a column."""


@dataclass(frozen=True)
class Entry:
    """A column of ours from one of the file: value [unit] = sign * scale * number + offset.

    Attributes:
        columns: names that the file may have for it; in patterns `{j}` is the joint's name, `{n}`
            its place counted from 1, `{n-1}` from 0, `{name}` its name in the log.
        unit: of the value; None: SI, or what the file says.
        sign, scale, offset: of the equation; the offset in that unit.
        where: place of the entry, for messages.
        strict: the column must be there; else our own name serves as well.
    """

    columns: tuple[str, ...]
    unit: Unit | None = None
    sign: float = 1.0
    scale: float = 1.0
    offset: float = 0.0
    where: str = ""
    strict: bool = False

    def like(self, other: "Entry") -> bool:
        """True if the same number means the same to both."""
        kept = ("unit", "sign", "scale", "offset")
        return all(getattr(self, name) == getattr(other, name) for name in kept)

    def of(self, joint: str, place: int, name: str) -> "Entry":
        """The entry of a pattern for one joint."""
        tokens = {"{j}": joint, "{n}": f"{place + 1}", "{n-1}": f"{place}", "{name}": name}
        written = []
        for column in self.columns:
            for token, text in tokens.items():
                column = column.replace(token, text)
            written.append(column)
        return dataclasses.replace(self, columns=tuple(written))


@dataclass(frozen=True)
class LogMap:
    """What is said of the columns of logs: the robot file first, --map over it.

    Attributes:
        layers: {our name, or a pattern with `<j>`: entry} each; a later one wins.
        names: joint -> its name in logs.
        topic: of a bag, or group of a file, that holds the motion; "" if there is one only.
        rate: Hz, of a log without a time column.
    """

    layers: tuple[Mapping[str, Entry], ...] = ()
    names: Mapping[str, str] = field(default_factory=lambda: _NONE)
    topic: str = ""
    rate: float | None = None

    def over(self, other: "LogMap") -> "LogMap":
        """This one, and under it another."""
        return LogMap(
            (*other.layers, *self.layers),
            {**other.names, **self.names},
            self.topic or other.topic,
            self.rate or other.rate,
        )

    def entries(self, joints: Sequence[JointSpec]) -> dict[str, Entry]:
        """Our name -> entry, for the joints of a robot; an entry of its own beats a pattern."""
        found: dict[str, Entry] = {}
        for layer in self.layers:
            for key in sorted(layer, key=lambda key: JOINT not in key):
                if JOINT not in key:
                    found[key] = layer[key]
                    continue
                for place, joint in enumerate(joints):
                    name = self.names.get(joint.name, joint.name)
                    own = key.replace(JOINT, joint.name)
                    found[own] = layer[key].of(joint.name, place, name)
        return found


def map_from_table(table: Any, where: str, strict: bool = False) -> LogMap:
    """The map that a table [log] states.

    Args:
        table: {our name: "column", "column [unit]", or {column, unit, sign, scale, offset}}, and
            the settings topic, names, rate.
        where: of the table, for messages.
        strict: every column must be there.

    Raises:
        DataError: an entry that is not like that; says what was expected.
    """
    if not isinstance(table, Mapping):
        raise DataError(f'{where}: expected a table, such as "q<j>" = "position_{{j}} [deg]"')
    entries = {
        key: dataclasses.replace(_entry(value, f"{where}, {key}", key), strict=strict)
        for key, value in table.items()
        if key not in _SETTINGS
    }
    topic = table.get("topic", "")
    if not isinstance(topic, str):
        raise DataError(
            f'{where}, topic: got {shown(topic)}; expected a name such as "/joint_states"'
        )
    layers = (entries,) if entries else ()
    return LogMap(layers, _names(table.get("names", {}), where), topic, _rate(table, where))


def map_from_words(words: Sequence[str]) -> LogMap:
    """The map that `--map` states, several times over: FILE.toml, or NAME=COLUMN[:UNIT].

    Raises:
        DataError: a word that is neither, or a file that cannot be read.
    """
    found = LogMap()
    for word in words:
        found = _of_word(word).over(found)
    return found


def _of_word(word: str) -> LogMap:
    where = f"--map {word}"
    if word.endswith(".toml") and "=" not in word:
        return _of_file(Path(word))
    key, equals, column = (part.strip() for part in word.partition("="))
    if not (key and equals and column):
        raise DataError(
            f"{where}: expected NAME=COLUMN[:UNIT] such as 'q<j>=position_{{j}}:deg', or the name "
            "of a .toml file"
        )
    if key == "rate":
        return map_from_table({"rate": _number(column, where)}, where)
    if key == "topic":
        return map_from_table({"topic": column}, where)
    if key == "names":
        return map_from_table({"names": dict(_pair(p, where) for p in column.split(","))}, where)
    table: dict[str, Any] = {"column": column}
    head, colon, unit = column.rpartition(":")
    if colon and head and find_unit(unit) is not None:
        table = {"column": head.strip(), "unit": unit.strip()}
    if table["column"].startswith("-"):
        table |= {"column": table["column"][1:].strip(), "sign": -1}
    return map_from_table({key: table}, "--map", strict=True)


def _pair(text: str, where: str) -> tuple[str, str]:
    joint, colon, name = (part.strip() for part in text.partition(":"))
    if not (joint and colon and name):
        raise DataError(f"{where}: got {text}; expected JOINT:NAME,JOINT:NAME such as 1:waist")
    return joint, name


def _number(text: str, where: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise DataError(f"{where}: got {text}; expected a number") from None


def _of_file(path: Path) -> LogMap:
    try:
        document = parse_toml(read_text(path))
    except OSError as error:
        raise DataError(
            f"--map {path}: cannot be read ({error.strerror}); check the path"
        ) from None
    except ValueError as error:  # of TOML, or of UTF-8
        raise DataError(f"--map {path}: not TOML ({error}); correct that line") from None
    return map_from_table(document.get("log", document), f"{path}: [log]", strict=True)


def _entry(value: Any, where: str, key: str) -> Entry:
    if key.count(JOINT) > 1 or not key.strip():
        raise DataError(f"{where}: expected a name such as q2, or a pattern such as q{JOINT}")
    table = {"column": value} if isinstance(value, str) else value
    if not isinstance(table, Mapping):
        raise DataError(
            f"{where}: got {shown(value)}; expected the name of a column, or a table such as "
            '{column = "position_2", unit = "deg", sign = -1}'
        )
    for name in table:
        if name not in _KEYS:
            raise DataError(
                f"{where}: unknown key {name}{near(name, _KEYS)}; expected {', '.join(_KEYS)}"
            )
    column = table.get("column", key.replace(JOINT, "{j}"))
    if not isinstance(column, str) or not column.strip():
        raise DataError(f'{where}: column is {shown(column)}; expected a name such as "position_2"')
    columns, bracket = _bracket(column)
    unit = table.get("unit", bracket)
    sign, scale, offset = (_float(table, name, where) for name in ("sign", "scale", "offset"))
    if abs(sign) != 1.0:
        raise DataError(f"{where}: sign is {sign:g}; expected 1 or -1; a factor is called scale")
    if scale == 0.0:
        raise DataError(f"{where}: scale is 0; expected what the number is multiplied by")
    return Entry(columns, _unit(unit, where), sign, scale, offset, where)


def _bracket(column: str) -> tuple[tuple[str, ...], str | None]:
    """`t [ms]`: a column of that name, or `t`; its unit."""
    match = _BRACKETS.fullmatch(column.strip())
    if match is None or find_unit(match[2]) is None:
        return (column.strip(),), None
    return (column.strip(), match[1]), match[2]


def _unit(text: Any, where: str) -> Unit | None:
    if text is None:
        return None
    unit = find_unit(text) if isinstance(text, str) else None
    if unit is None:
        raise DataError(f"{where}: got unit {shown(text)}; expected a unit such as {EXAMPLES}")
    return unit


def _float(table: Mapping[str, Any], name: str, where: str) -> float:
    value = table.get(name, 0.0 if name == "offset" else 1.0)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not -_LARGEST <= value <= _LARGEST:
        raise DataError(f"{where}: {name} is {shown(value)}; expected a number")
    return float(value)


def _rate(table: Mapping[str, Any], where: str) -> float | None:
    rate = table.get("rate")
    if rate is None:
        return None
    rate = _float(table, "rate", where)
    if rate <= 0.0:
        raise DataError(f"{where}: rate is {rate:g}; expected the samples in a second, such as 500")
    return rate


def _names(value: Any, where: str) -> dict[str, str]:
    if isinstance(value, Mapping) and all(isinstance(name, str) for name in value.values()):
        return {str(joint): name for joint, name in value.items()}
    raise DataError(
        f"{where}, names: got {shown(value)}; expected a table such as "
        '{1 = "waist", 2 = "shoulder"}'
    )


def near(name: str, names: Sequence[str]) -> str:
    """` (did you mean q1?)` for a misspelt name, else nothing."""
    found = difflib.get_close_matches(name, names, n=2, cutoff=0.6)
    return f" (did you mean {' or '.join(found)}?)" if found else ""
