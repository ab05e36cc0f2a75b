"""What an object prints of itself: one short line, however much it holds."""

from collections.abc import Collection, Mapping
from typing import Any

LONGEST = 160
"""Characters of the line, the name of the class aside."""

_TEXT = 40  # characters of a text
_FEW = 4  # entries of a tuple that are shown


class ShortRepr:
    """A base class: `repr` is one short line; dataclasses of it get no repr of their own."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = format_repr  # type: ignore[method-assign]  # or @dataclass writes a long one


def format_repr(thing: object) -> str:
    """`Name(field=value, ...)` as far as it fits; arrays by their shape, many entries counted."""
    name, line = type(thing).__name__, ""
    for key, value in vars(thing).items():
        if key.startswith("_"):
            continue
        part = f"{', ' if line else ''}{key}={_format_value(value)}"
        if len(line) + len(part) > LONGEST:
            return f"{name}({line}, ...)"
        line += part
    return f"{name}({line})"


def _format_value(value: Any) -> str:
    if isinstance(value, str):
        text = repr(value)
        return text if len(text) <= _TEXT else f"{text[: _TEXT - 4]}...'"
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
    if len(items) <= _FEW and all(isinstance(x, str | int | float) for x in items):
        text = f"({', '.join(_format_value(x) for x in items)})"
        if len(text) <= _TEXT:
            return text
    return f"<{len(items)} items>"
