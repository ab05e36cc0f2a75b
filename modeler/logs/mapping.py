"""Whose column is which: names, units and signs of a log, said once in [log] or by --map."""

import dataclasses
import difflib
import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from modeler.core.errors import DataError
from modeler.core.files import read_text
from modeler.core.json import parse_toml, shorten_value
from modeler.core.manifest import JointSpec
from modeler.logs.thresholds import THRESHOLDS

# Units by name, as factors to SI (`deg`, `N m`, `rev/8192`), and which a column may be in.


GRAVITY = 9.80665
"""m/s2, standard: what makes a kg or a lb into a force (3rd CGPM, 1901)."""

Powers = tuple[int, ...]
"""Exponents of (m, kg, s, rad, A, K)."""

_UNITS: Mapping[str, Any] = tomllib.loads(Path(__file__).with_name("units.toml").read_text("utf-8"))

_POWERS: Mapping[str, Powers] = {name: tuple(p) for name, p in _UNITS["powers"].items()}
NONE, LENGTH = _POWERS["plain number"], _POWERS["length"]
TIME, ANGLE, HEAT = _POWERS["time"], _POWERS["angle"], _POWERS["temperature"]
CURRENT, VOLTAGE = _POWERS["current"], _POWERS["voltage"]
FORCE, TORQUE = _POWERS["force"], _POWERS["torque"]

_NAMED = list(_POWERS.items())[:10]
_KINDS = {powers: f"{'an' if name[0] == 'a' else 'a'} {name}" for name, powers in _NAMED}

_PREFIXED = {"m", "g", "s", "rad", "deg", "A", "V", "N", "Nm", "Hz"}
_FACTOR = re.compile(
    r"\s*([*/·.]?)\s*([A-Za-zµμ°%]+|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)(?:\^?(-?\d+))?"
)
EXAMPLES = "deg, rev, rpm, deg/s, mm, ms, us, N m, mN m, kN, kg cm, lb in, mA, A, rev/8192"
"""Units that a message names."""


@dataclass(frozen=True)
class Unit:
    """A unit: SI value = factor * (value + zero).

    Attributes:
        text: as it was written.
        factor: to SI.
        powers: of the SI units that it is made of.
        zero: of a scale of temperature, whose SI value is in degrees Celsius; else 0.
    """

    text: str
    factor: float
    powers: Powers
    zero: float = 0.0

    @property
    def kind(self) -> str:
        """Returns what it measures, in words."""
        if self.powers in _KINDS:
            return _KINDS[self.powers]
        letters = zip(("m", "kg", "s", "rad", "A", "K"), self.powers, strict=True)
        return "a " + " ".join(x if power == 1 else f"{x}^{power}" for x, power in letters if power)

    def convert_to_quantity(self, powers: Powers) -> "Unit | None":
        """Returns the unit as one of that quantity; None if it measures something else.

        A kg or lb where a force is due means its weight.
        """
        if self.powers == powers:
            return self
        weighed = (self.powers[0] + 1, self.powers[1], self.powers[2] - 2, *self.powers[3:])
        if self.powers[1] == 1 and weighed == powers:
            return Unit(self.text, self.factor * GRAVITY, powers)
        return None


def _make_unit(factor: float, powers: Powers, zero: float = 0.0) -> Unit:
    return Unit("", factor, powers, zero)


def _units() -> Iterator[tuple[str, Unit]]:
    for quantity, names in _UNITS["units"].items():
        for name, factor in names.items():
            numbers = factor if isinstance(factor, list) else [factor]
            yield name, _make_unit(numbers[0], _POWERS[quantity], *numbers[1:])


_TABLE: Mapping[str, Unit] = dict(_units())


def parse_unit(text: str) -> Unit:
    """Returns the unit of a text: names with products, quotients and powers, `deg/s^2`, `rev/8192`.

    Raises:
        DataError: a name that is unknown; says which units there are.
    """
    unit = find_unit(text)
    if unit is None:
        raise DataError(f'got unit "{text}"; expected a unit such as {EXAMPLES}')
    return unit


def find_unit(text: str) -> Unit | None:
    """Returns the unit of that text; None if it is no unit."""
    at, factor, powers, zero = 0, 1.0, NONE, 0.0
    text, count = text.strip().replace("²", "^2"), 0
    while at < len(text):
        match = _FACTOR.match(text, at)
        one = None if match is None else _parse_simple_unit(match[2])
        if match is None or one is None or (match[1] and count == 0):
            return None
        if len(match[3] or "") > len("-9") or abs(int(match[3] or 1)) > 9:
            return None
        power = int(match[3] or 1) * (-1 if match[1] == "/" else 1)
        if abs(power * math.log10(one.factor)) > THRESHOLDS.max_unit_decades:
            return None
        factor *= one.factor**power
        powers = tuple(a + power * b for a, b in zip(powers, one.powers, strict=True))
        zero = one.zero
        at, count = match.end(), count + 1
    if count == 0 or not 0.0 < factor < math.inf:
        return None
    return Unit(text, factor, powers, zero if count == 1 and powers == HEAT else 0.0)


def _parse_simple_unit(name: str) -> Unit | None:
    """A number, a unit of the table, or one with a prefix."""
    if name[0].isdigit():
        return _make_unit(float(name), NONE) if float(name) > 0.0 else None
    name = _UNITS["synonyms"].get(name.lower(), name)
    if name in _TABLE:
        return _TABLE[name]
    prefix, rest = name[0], name[1:]
    if prefix in _UNITS["prefixes"] and rest in _PREFIXED:
        base = _TABLE[rest]
        return _make_unit(_UNITS["prefixes"][prefix] * base.factor, base.powers)
    return None


def resolve_si_unit(our_name: str, where: str, unit: Unit, joints: Sequence[JointSpec]) -> Unit:
    """Returns the unit of an entry as one of what our column measures.

    Raises:
        DataError: it measures something else; names the entry, the joint and what was expected.
    """
    wanted, what, example = _find_expected(our_name, joints)
    if wanted is None:
        return unit
    if wanted == CURRENT and unit.powers in (NONE, VOLTAGE):
        return unit  # drive units: what the drive gain is of
    converted = unit.convert_to_quantity(wanted)
    if converted is None:
        also = "; a current is called current<j>" if unit.powers == CURRENT else ""
        raise DataError(
            f'{where}: got unit "{unit.text}", which is {unit.kind}; {our_name} is {what}: '
            f"expected a unit such as {example}{also}"
        )
    return converted


def _find_expected(our_name: str, joints: Sequence[JointSpec]) -> tuple[Powers | None, str, str]:
    """Powers, in words, and examples of units; None for a column that may measure anything."""
    if our_name == "time":
        return TIME, "a time", "s, ms, us, ns"
    if our_name.startswith("temperature"):
        return HEAT, "a temperature", "degC, K, degF"
    for joint in joints:
        columns, kinds = _UNITS["columns"], ("drive", joint.effort_unit, joint.unit)
        of_joint = {name: row for key in kinds for name, row in columns[key].items()}
        for prefix, (powers, what, example) in of_joint.items():
            if our_name == f"{prefix}{joint.name}":
                what = f"{what} of joint {joint.name}, which is {joint.kind}"
                return _POWERS[powers], what, example
    return None, "", ""


_KEYS = ("column", "unit", "sign", "scale", "offset")
_SETTINGS = ("topic", "names", "rate", "files")
AUTO = "auto"
"""What `--map` is given for the guess."""
_TOKEN = re.compile(r"\{(?:j|name|n([+-]\d{1,3})?)\}")
_BRACKETS = re.compile(r"(.*\S)\s+\[([^\[\]]+)\]")
JOINT = "<j>"
"""Stands for every joint of the robot in our name of a column."""


@dataclass(frozen=True)
class MappedColumn:
    """A column of ours from one of the file: value [unit] = sign * scale * number + offset.

    Attributes:
        columns: names that the file may have for it; in patterns `{j}` is the joint's name, `{n}`
            its place counted from 1, `{n-1}` from 0, `{n+6}` from 7, `{name}` its name in the log.
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

    def has_same_scale(self, other: "MappedColumn") -> bool:
        """Returns True if the same number means the same to both."""
        scale_fields = ("unit", "sign", "scale", "offset")
        return all(getattr(self, name) == getattr(other, name) for name in scale_fields)

    def expand_for_joint(self, joint: str, place: int, name: str) -> "MappedColumn":
        """Returns the entry of a pattern for one joint."""

        def replace_token(token: re.Match[str]) -> str:
            words = {"{j}": joint, "{name}": name}
            return words.get(token[0]) or f"{place + 1 + int(token[1] or 0)}"

        written = [_TOKEN.sub(replace_token, column) for column in self.columns]
        return dataclasses.replace(self, columns=tuple(written))

    def build_table(self) -> str | dict[str, Any]:
        """Returns the entry as [log] has it."""
        column = self.columns[0]
        if (self.sign, self.scale, self.offset) == (1.0, 1.0, 0.0):
            plain_name = self.unit is None or len(self.columns) > 1  # its name ends in its unit
            return column if plain_name else f"{column} [{self.unit.text}]"  # type: ignore[union-attr]
        said: dict[str, Any] = {"unit": self.unit and self.unit.text, "sign": int(self.sign)}
        said |= {"scale": self.scale, "offset": self.offset}
        plain = {"unit": None, "sign": 1, "scale": 1.0, "offset": 0.0}
        return {"column": column} | {k: v for k, v in said.items() if v != plain[k]}


@dataclass(frozen=True)
class LogMap:
    """What is said of the columns of logs: the robot file first, --map over it.

    Attributes:
        layers: {our name, or a pattern with `<j>`: entry} each; a later one wins.
        names: joint -> its name in logs.
        topic: of a bag, or group of a file, that holds the motion; "" if there is one only.
        rate: Hz, of a log without a time column.
        files: of logs in several files, our name -> how the name of the file ends.
        auto: what these leave open is to be guessed.
        guess_notes: what was guessed, one line each.
    """

    layers: tuple[Mapping[str, MappedColumn], ...] = ()
    names: Mapping[str, str] = field(default_factory=dict)
    topic: str = ""
    rate: float | None = None
    files: Mapping[str, str] = field(default_factory=dict)
    auto: bool = False
    guess_notes: tuple[str, ...] = ()

    def merge_over(self, other: "LogMap") -> "LogMap":
        """Returns this map laid over another."""
        return LogMap(
            (*other.layers, *self.layers),
            {**other.names, **self.names},
            self.topic or other.topic,
            self.rate or other.rate,
            self.files or other.files,
            self.auto or other.auto,
            (*other.guess_notes, *self.guess_notes),
        )

    def build_table(self, joints: Sequence[JointSpec] = ()) -> dict[str, Any]:
        """Returns what is said, as one table [log]: `map_from_table` of it reads logs alike.

        A pattern of a layer goes before entries of lower layers for single joints of a robot.
        """
        entries: dict[str, MappedColumn] = {}
        for layer in self.layers:
            for key in (key for key in layer if JOINT in key):
                for joint_key in (key.replace(JOINT, joint.name) for joint in joints):
                    entries.pop(joint_key, None)
            entries |= layer
        said = {
            "topic": self.topic,
            "rate": self.rate,
            "names": dict(self.names),
            "files": dict(self.files),
        }
        return {k: v for k, v in said.items() if v} | {
            k: e.build_table() for k, e in entries.items()
        }

    def expand_entries(self, joints: Sequence[JointSpec]) -> dict[str, MappedColumn]:
        """Returns our name -> entry, for the joints of a robot.

        An entry of its own beats a pattern.
        """
        entries: dict[str, MappedColumn] = {}
        for layer in self.layers:
            for key in sorted(layer, key=lambda key: JOINT not in key):
                if JOINT not in key:
                    entries[key] = layer[key]
                    continue
                for place, joint in enumerate(joints):
                    name = self.names.get(joint.name, joint.name)
                    joint_key = key.replace(JOINT, joint.name)
                    entries[joint_key] = layer[key].expand_for_joint(joint.name, place, name)
        return entries


def build_map(table: Any, where: str, strict: bool = False) -> LogMap:
    """Returns the map that a table [log] states.

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
        key: dataclasses.replace(_parse_entry(value, f"{where}, {key}", key), strict=strict)
        for key, value in table.items()
        if key not in _SETTINGS
    }
    topic = table.get("topic", "")
    if not isinstance(topic, str):
        raise DataError(
            f'{where}, topic: got {shorten_value(topic)}; expected a name such as "/joint_states"'
        )
    names, rate = table.get("names", {}), None
    if not isinstance(names, Mapping) or not all(isinstance(n, str) for n in names.values()):
        raise DataError(
            f"{where}, names: got {shorten_value(names)}; expected a table such as "
            '{1 = "waist", 2 = "shoulder"}'
        )
    if table.get("rate") is not None and (rate := _parse_float(table, "rate", where)) <= 0.0:
        raise DataError(f"{where}: rate is {rate:g}; expected the samples in a second, such as 500")
    files = table.get("files", {})
    if not isinstance(files, Mapping) or not all(map(_is_ending, files.values())):
        raise DataError(
            f"{where}, files: got {shorten_value(files)}; expected how the names of the files "
            "of one log "
            'end, such as {q = "_q.csv", tau = "_tau.csv"}'
        )
    named = {str(joint): name for joint, name in names.items()}
    return LogMap((entries,) if entries else (), named, topic, rate, dict(files))


def _is_ending(name: Any) -> bool:
    """Whether it may end the name of a file: it leads to no other folder."""
    return isinstance(name, str) and not name.startswith("/") and ".." not in name.split("/")


def parse_map_options(words: Sequence[str]) -> LogMap:
    """Returns the map that `--map` states, several times over: FILE.toml, or NAME=COLUMN[:UNIT].

    Raises:
        DataError: a word that is neither, or a file that cannot be read.
    """
    log_map = LogMap()
    for word in words:
        log_map = _parse_map_option(word).merge_over(log_map)
    return log_map


def _parse_map_option(word: str) -> LogMap:
    where = f"mapping {word}"
    if word.endswith(".toml") and "=" not in word:
        path = Path(word)
        try:
            document = parse_toml(read_text(path))
        except OSError as error:
            why = f"cannot be read ({error.strerror}); check the path"
            raise DataError(f"mapping {path}: {why}") from None
        except ValueError as error:  # of TOML, or of UTF-8
            raise DataError(f"mapping {path}: not TOML ({error}); correct that line") from None
        return build_map(document.get("log", document), f"{path}: [log]", strict=True)
    if word.strip() == AUTO:
        return LogMap(auto=True)
    key, equals, column = (part.strip() for part in word.partition("="))
    if not (key and equals and column):
        raise DataError(
            f"{where}: expected NAME=COLUMN[:UNIT] such as 'q<j>=position_{{j}}:deg', the name of "
            "a .toml file, or auto"
        )
    if key == "rate":
        try:
            return build_map({"rate": float(column)}, where)
        except ValueError:
            raise DataError(f"{where}: got {column}; expected a number") from None
    if key == "topic":
        return build_map({"topic": column}, where)
    if key == "names":
        return build_map({"names": dict(_parse_pair(p, where) for p in column.split(","))}, where)
    table: dict[str, Any] = {"column": column}
    head, colon, unit = column.rpartition(":")
    if colon and head and find_unit(unit) is not None:
        table = {"column": head.strip(), "unit": unit.strip()}
    if table["column"].startswith("-"):
        table |= {"column": table["column"][1:].strip(), "sign": -1}
    return build_map({key: table}, "mapping", strict=True)


def _parse_pair(text: str, where: str) -> tuple[str, str]:
    joint, colon, name = (part.strip() for part in text.partition(":"))
    if not (joint and colon and name):
        raise DataError(f"{where}: got {text}; expected JOINT:NAME,JOINT:NAME such as 1:waist")
    return joint, name


def _parse_entry(value: Any, where: str, key: str) -> MappedColumn:
    if key.count(JOINT) > 1 or not key.strip():
        raise DataError(f"{where}: expected a name such as q2, or a pattern such as q{JOINT}")
    table = {"column": value} if isinstance(value, str) else value
    if not isinstance(table, Mapping):
        raise DataError(
            f"{where}: got {shorten_value(value)}; expected the name of a column, or a table "
            "such as "
            '{column = "position_2", unit = "deg", sign = -1}'
        )
    for name in table:
        if name not in _KEYS:
            raise DataError(
                f"{where}: unknown key {name}{suggest_name(name, _KEYS)}; expected "
                f"{', '.join(_KEYS)}"
            )
    column = table.get("column", key.replace(JOINT, "{j}"))
    if not isinstance(column, str) or not column.strip():
        raise DataError(
            f'{where}: column is {shorten_value(column)}; expected a name such as "position_2"'
        )
    columns: tuple[str, ...] = (column.strip(),)
    stated, unit = table.get("unit"), None
    match = _BRACKETS.fullmatch(column.strip())
    if match is not None and find_unit(match[2]) is not None:
        columns, stated = (column.strip(), match[1]), table.get("unit", match[2])
    if stated is not None:
        unit = find_unit(stated) if isinstance(stated, str) else None
    sign, scale, offset = (_parse_float(table, name, where) for name in ("sign", "scale", "offset"))
    if abs(sign) != 1.0:
        raise DataError(f"{where}: sign is {sign:g}; expected 1 or -1; a factor is called scale")
    if scale == 0.0:
        raise DataError(f"{where}: scale is 0; expected what the number is multiplied by")
    if stated is not None and unit is None:
        raise DataError(
            f"{where}: got unit {shorten_value(stated)}; expected a unit such as {EXAMPLES}"
        )
    return MappedColumn(columns, unit, sign, scale, offset, where)


def _parse_float(table: Mapping[str, Any], name: str, where: str) -> float:
    value = table.get(name, 0.0 if name == "offset" else 1.0)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not -THRESHOLDS.max_scale <= value <= THRESHOLDS.max_scale:
        raise DataError(f"{where}: {name} is {shorten_value(value)}; expected a number")
    return float(value)


def suggest_name(name: str, names: Sequence[str]) -> str:
    """Returns ` (did you mean q1?)` for a misspelt name, else nothing."""
    matches = difflib.get_close_matches(name, names, n=2, cutoff=0.6)
    return f" (did you mean {' or '.join(matches)}?)" if matches else ""
