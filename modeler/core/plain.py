"""Dataclasses from plain data, every entry checked against the type that the class declares."""

import dataclasses
import types
from collections.abc import Mapping
from functools import cache
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from modeler.core.json_text import shown

T = TypeVar("T")


class PlainError(ValueError):
    """The entry that is not as declared: its place, what was got, what was expected."""


def built(cls: type[T], raw: Any, place: str = "") -> T:
    """An instance of a dataclass from a mapping, as JSON has it; lists become tuples.

    Args:
        cls: with fields of plain types: text, numbers, truth values, None, tuples, mappings,
            literals and other such dataclasses.
        raw: {field: value}.
        place: of it, for the message.

    Raises:
        PlainError: an entry is missing, unknown or of another type.
    """
    if not isinstance(raw, Mapping):
        raise _unlike(place or "it", raw, "an object")
    hints, head = _hints(cls), f"{place}." if place else ""
    for field in dataclasses.fields(cls):  # type: ignore[arg-type]
        required = field.default is field.default_factory is dataclasses.MISSING
        if required and field.name not in raw:
            raise PlainError(f"{head}{field.name} is missing")
    values = {}
    for name, value in raw.items():
        if name not in hints:
            raise PlainError(f"{head}{shown(name)} is unknown")
        values[name] = plain(hints[name], value, head + name)
    return cls(**values)


def check_fields(instance: Any, place: str = "") -> None:
    """Refuse an instance of a dataclass whose fields are not of the types that it declares.

    Raises:
        PlainError: names the first.
    """
    head = f"{place}." if place else ""
    for name, hint in _hints(type(instance)).items():
        plain(hint, getattr(instance, name), head + name)


def plain(hint: Any, value: Any, place: str) -> Any:
    """`value` as the type `hint`; other types than those of `built` are not looked into.

    Raises:
        PlainError: it is none.
    """
    if hint in _SIMPLE:
        kinds, expected = _SIMPLE[hint]
        if not isinstance(value, kinds) or (isinstance(value, bool) and hint is not bool):
            raise _unlike(place, value, expected)
        return value
    origin, arguments = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType):
        return _either(arguments, value, place)
    if origin is Literal:
        if not isinstance(value, str) or value not in arguments:
            raise _unlike(place, value, " or ".join(map(str, arguments)))
        return value
    if origin is tuple:
        return _tuple(arguments, value, place)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        if not isinstance(value, Mapping):
            raise _unlike(place, value, "an object")
        return {
            plain(arguments[0], key, place): plain(arguments[1], item, f"{place}.{shown(key)}")
            for key, item in value.items()
        }
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        if isinstance(value, hint):
            check_fields(value, place)
            return value
        return built(hint, value, place)
    return value


_SIMPLE: Mapping[Any, tuple[Any, str]] = {
    str: (str, "text"),
    int: (int, "a whole number"),
    float: ((int, float), "a number"),
    bool: (bool, "true or false"),
    type(None): (type(None), "null"),
}


def _tuple(arguments: tuple[Any, ...], value: Any, place: str) -> tuple[Any, ...]:
    """Of any length, all of one type; or of one type each."""
    if not isinstance(value, list | tuple):
        raise _unlike(place, value, "a list")
    if arguments[1:] == (Ellipsis,):
        arguments = (arguments[0],) * len(value)
    if len(value) != len(arguments):
        raise _unlike(place, value, f"{len(arguments)} values")
    pairs = zip(arguments, value, strict=True)
    return tuple(plain(part, item, f"{place}[{i}]") for i, (part, item) in enumerate(pairs))


def _either(options: tuple[Any, ...], value: Any, place: str) -> Any:
    if value is None and type(None) in options:
        return None
    others = [option for option in options if option is not type(None)]
    if len(others) == 1:
        return plain(others[0], value, place)
    for option in others:
        try:
            return plain(option, value, place)
        except PlainError:
            continue
    raise _unlike(place, value, " or ".join(str(option) for option in others))


def _unlike(place: str, value: Any, expected: str) -> PlainError:
    return PlainError(f"{place} is {shown(value)}, expected {expected}")


def _hints(cls: Any) -> Mapping[str, Any]:
    return _field_types(cls)


@cache
def _field_types(cls: Any) -> Mapping[str, Any]:
    names = {field.name for field in dataclasses.fields(cls)}
    return {name: hint for name, hint in get_type_hints(cls).items() if name in names}
