"""Objects as text: JSON both ways, every entry checked, without NaN; a `repr` of one line."""

import dataclasses
import enum
import json
import math
import reprlib
import sys
import tomllib
import types
from collections.abc import Collection, Mapping
from functools import cache
from operator import attrgetter
from typing import Any, ClassVar, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from modeler.core.thresholds import THRESHOLDS

# JSON and TOML that others wrote, read strictly; JSON that we write, without false numbers.


_LARGEST = 2**63
_BYTE_ORDER = (b"\xff\xfe", b"\xfe\xff")


class JsonError(ValueError):
    """What is wrong with the text, without its place; readers add the file and what to do."""


class TomlError(ValueError):
    """What is wrong with a TOML text, without its place."""


def parse_json(data: bytes | str) -> Any:
    """Returns the value of a JSON text in UTF-8.

    Stricter than `json.loads`: what is no number (NaN, Infinity), what no double or 64-bit integer
    holds, an entry given twice, and half a character are refused.

    Raises:
        JsonError: not such a text; says why, where if that is known.
    """
    text = data if isinstance(data, str) else _decode_text(data)
    if not text.strip():
        raise JsonError("is empty" if not text else "is blank")
    try:
        value = json.loads(
            text,
            parse_int=_parse_integer,
            parse_float=_parse_float,
            parse_constant=_reject_constant,
            object_pairs_hook=_parse_object,
        )
        json.dumps(value, ensure_ascii=False).encode()
    except json.JSONDecodeError as error:
        raise JsonError(
            f"is not JSON, or cut off: {error.msg}, line {error.lineno}, column {error.colno}"
        ) from None
    except RecursionError:
        raise JsonError("is nested too deep") from None
    except UnicodeEncodeError:
        raise JsonError("has an escape \\ud800 to \\udfff that is half a character") from None
    return value


def convert_to_plain(content: Any) -> Any:
    """Returns plain data with null for every number that is not finite.

    Arrays and tuples become lists; a result is what its `to_json` says, another dataclass an
    object with its fields.
    """
    if isinstance(content, enum.Enum):
        content = content.value
    elif hasattr(content, "tolist"):
        content = content.tolist()
    elif dataclasses.is_dataclass(content):
        content = content.to_json() if hasattr(content, "to_json") else vars(content)
    if isinstance(content, Mapping):
        return {key: convert_to_plain(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [convert_to_plain(value) for value in content]
    unknown = isinstance(content, float) and not math.isfinite(content)
    return None if unknown else content


def format_json(value: Any, indent: str = "", width: int = 160) -> str:
    """Returns JSON text in which an object or list that fits into a line stands on one."""
    line = json.dumps(value, allow_nan=False)
    if len(indent) + len(line) <= width or not value or not isinstance(value, dict | list):
        return line
    inner, keys = indent + " ", isinstance(value, dict)
    parts = [
        inner + (f"{json.dumps(key)}: " if keys else "") + format_json(value[key], inner, width)
        for key in (value if keys else range(len(value)))
    ]
    first, last = "{}" if keys else "[]"
    return f"{first}\n" + ",\n".join(parts) + f"\n{indent}{last}"


class Document:
    """A base class of results whose JSON is an object.

    Attributes:
        KEYS: of the object, spaces between. `rms` is the attribute of that name;
            `max=largest.value` another, null where a part of its path is None; with
            `joints=joints[name]` the entries of a sequence become an object by their names; `*fit`
            stands for the keys of another document.
    """

    KEYS: ClassVar[str] = ""

    def to_json(self) -> dict[str, Any]:
        """Returns what scripts read: plain data, null for numbers that mean nothing."""
        document: dict[str, Any] = {}
        for key, path in parse_keys(self.KEYS).items():
            value = convert_to_plain(_follow_path(self, path))
            document |= (value or {}) if key.startswith("*") else {key: value}
        return document


@dataclasses.dataclass(frozen=True)
class Change:
    """A number before and after something; None where it is not known."""

    before: float | None
    after: float | None


def parse_keys(keys: str) -> dict[str, str]:
    """Returns {key: path of its attribute} of `Document.KEYS`; of `*fit` {"*fit": "fit"}."""
    pairs = (word.partition("=") for word in keys.split())
    return {key: path or key.removeprefix("*") for key, _, path in pairs}


def _follow_path(thing: Any, path: str) -> Any:
    path, _, name = path.partition("[")
    for attribute in path.split("."):
        thing = None if thing is None else getattr(thing, attribute)
    return {attrgetter(name[:-1])(entry): entry for entry in thing} if name else thing


def select_attributes(thing: Any, names: str) -> dict[str, Any]:
    """Returns attributes by name, as JSON names them too; the names with spaces between."""
    return {name: getattr(thing, name) for name in names.split()}


def parse_toml(text: str) -> dict[str, Any]:
    """Returns the table of a TOML text.

    Raises:
        TomlError: not such a text; says why, where if that is known.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise TomlError(str(error)) from None
    except RecursionError:
        raise TomlError("lists or tables are nested too deep; write them flat") from None
    except ValueError:  # the one that is left: Python's limit against endless conversions
        most = sys.get_int_max_str_digits()
        raise TomlError(f"an integer has more than {most} digits; write a shorter one") from None


def shorten_value(value: Any) -> str:
    """Returns the value for a message: short, however long it is."""
    return reprlib.repr(value)


def _decode_text(data: bytes) -> str:
    if data.startswith(_BYTE_ORDER) or b"\x00" in data[:4]:
        raise JsonError("is UTF-16, UTF-32 or binary; expected text in UTF-8")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise JsonError(f"is not valid UTF-8 (byte {error.start + 1})") from None


def _parse_integer(text: str) -> int:
    if len(text) > len(str(_LARGEST)) + 1 or abs(int(text)) >= _LARGEST:
        raise JsonError(
            f"has a whole number of {len(text.lstrip('-'))} digits: {shorten_value(text)}"
        )
    return int(text)


def _parse_float(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise JsonError(f"has the number {shorten_value(text)}, too large for double precision")
    return value


def _reject_constant(text: str) -> float:
    raise JsonError(f"has {text}, which is not a JSON number")


def _parse_object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in members if names.count(name) > 1)
        raise JsonError(f"has the entry {shorten_value(twice)} twice")
    return members


T = TypeVar("T")


class SchemaError(ValueError):
    """The entry that is not as declared: its place, what was got, what was expected."""


def build_instance(cls: type[T], raw: Any, place: str = "") -> T:
    """Returns an instance of a dataclass from a mapping, as JSON has it; lists become tuples.

    Args:
        cls: with fields of plain types: text, numbers, truth values, None, tuples, mappings,
            literals and other such dataclasses.
        raw: {field: value}.
        place: of it, for the message.

    Raises:
        PlainError: an entry is missing, unknown or of another type.
    """
    if not isinstance(raw, Mapping):
        raise _describe_mismatch(place or "it", raw, "an object")
    hints, head = _get_field_types(cls), f"{place}." if place else ""  # type: ignore[arg-type]
    for field in dataclasses.fields(cls):  # type: ignore[arg-type]
        required = field.default is field.default_factory is dataclasses.MISSING
        if required and field.name not in raw:
            raise SchemaError(f"{head}{field.name} is missing")
    values = {}
    for name, value in raw.items():
        if name not in hints:
            raise SchemaError(f"{head}{shorten_value(name)} is unknown")
        values[name] = convert_value(hints[name], value, head + name)
    return cls(**values)


def check_fields(instance: Any, place: str = "") -> None:
    """Refuses an instance of a dataclass whose fields are not of the types that it declares.

    Raises:
        PlainError: names the first.
    """
    head = f"{place}." if place else ""
    for name, hint in _get_field_types(type(instance)).items():  # type: ignore[arg-type]
        convert_value(hint, getattr(instance, name), head + name)


def convert_value(hint: Any, value: Any, place: str) -> Any:
    """Returns `value` as the type `hint`; other types than those of `built` are not looked into.

    Raises:
        PlainError: it is none.
    """
    if hint in _SIMPLE:
        kinds, expected = _SIMPLE[hint]
        if not isinstance(value, kinds) or (isinstance(value, bool) and hint is not bool):
            raise _describe_mismatch(place, value, expected)
        return value
    origin, arguments = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType):
        return _convert_union(arguments, value, place)
    if origin is Literal:
        if not isinstance(value, str) or value not in arguments:
            raise _describe_mismatch(place, value, " or ".join(map(str, arguments)))
        return value
    if origin is tuple:
        return _convert_tuple(arguments, value, place)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        if not isinstance(value, Mapping):
            raise _describe_mismatch(place, value, "an object")
        return {
            convert_value(arguments[0], key, place): convert_value(
                arguments[1], item, f"{place}.{shorten_value(key)}"
            )
            for key, item in value.items()
        }
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        if isinstance(value, hint):
            check_fields(value, place)
            return value
        return build_instance(hint, value, place)
    return value


_SIMPLE: Mapping[Any, tuple[Any, str]] = {
    str: (str, "text"),
    int: (int, "a whole number"),
    float: ((int, float), "a number"),
    bool: (bool, "true or false"),
    type(None): (type(None), "null"),
}


def _convert_tuple(arguments: tuple[Any, ...], value: Any, place: str) -> tuple[Any, ...]:
    """Of any length, all of one type; or of one type each."""
    if not isinstance(value, list | tuple):
        raise _describe_mismatch(place, value, "a list")
    if arguments[1:] == (Ellipsis,):
        arguments = (arguments[0],) * len(value)
    if len(value) != len(arguments):
        raise _describe_mismatch(place, value, f"{len(arguments)} values")
    pairs = zip(arguments, value, strict=True)
    return tuple(convert_value(part, item, f"{place}[{i}]") for i, (part, item) in enumerate(pairs))


def _convert_union(options: tuple[Any, ...], value: Any, place: str) -> Any:
    if value is None and type(None) in options:
        return None
    others = [option for option in options if option is not type(None)]
    if len(others) == 1:
        return convert_value(others[0], value, place)
    for option in others:
        try:
            return convert_value(option, value, place)
        except SchemaError:
            continue
    raise _describe_mismatch(place, value, " or ".join(str(option) for option in others))


def _describe_mismatch(place: str, value: Any, expected: str) -> SchemaError:
    return SchemaError(f"{place} is {shorten_value(value)}, expected {expected}")


@cache
def _get_field_types(cls: Any) -> Mapping[str, Any]:
    names = {field.name for field in dataclasses.fields(cls)}
    return {name: hint for name, hint in get_type_hints(cls).items() if name in names}


# What an object prints of itself: one short line, however much it holds.


class ShortRepr:
    """A base class: `repr` is one short line; dataclasses of it get no repr of their own."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = format_repr  # type: ignore[method-assign]  # or @dataclass writes a long one


def format_repr(thing: object) -> str:
    """Returns `Name(field=value, ...)` as far as it fits.

    Arrays by their shape, many entries counted.
    """
    name, line = type(thing).__name__, ""
    for key, value in vars(thing).items():
        if key.startswith("_"):
            continue
        part = f"{', ' if line else ''}{key}={_format_value(value)}"
        if len(line) + len(part) > THRESHOLDS.max_repr_length:
            return f"{name}({line}, ...)"
        line += part
    return f"{name}({line})"


def _format_value(value: Any) -> str:
    if isinstance(value, str):
        text = repr(value)
        return (
            text
            if len(text) <= THRESHOLDS.max_repr_text
            else f"{text[: THRESHOLDS.max_repr_text - 4]}...'"
        )
    if value is None or isinstance(value, bool | int):
        return repr(value)
    if isinstance(value, float):
        return f"{value:.6g}"
    if hasattr(value, "shape") and hasattr(value, "dtype"):
        return f"array{tuple(value.shape)}".replace(",)", ")")
    if isinstance(value, Mapping):
        return f"<{len(value)} entries>"
    if isinstance(value, tuple | list | set | frozenset):
        return _format_items(value)
    return type(value).__name__


def _format_items(items: Collection[Any]) -> str:
    if len(items) <= THRESHOLDS.max_repr_items and all(
        isinstance(x, str | int | float) for x in items
    ):
        text = f"({', '.join(_format_value(x) for x in items)})"
        if len(text) <= THRESHOLDS.max_repr_text:
            return text
    return f"<{len(items)} items>"
