"""What an object prints of itself: one short line, however much it holds."""

from collections.abc import Collection, Mapping
from typing import Any

LONGEST = 160
"""Characters of the line, the name of the class aside."""

_TEXT = 40  # characters of a text
_FEW = 4  # entries of a tuple that are shown


class Brief:
    """A base class: `repr` is one short line; dataclasses of it get no repr of their own."""

    def __init_subclass__(cls, **given: Any) -> None:
        super().__init_subclass__(**given)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = brief  # type: ignore[method-assign]  # or @dataclass writes a long one


def brief(thing: object) -> str:
    """`Name(field=value, ...)` as far as it fits; arrays by their shape, many entries counted."""
    name, line = type(thing).__name__, ""
    for key, value in vars(thing).items():
        if key.startswith("_"):
            continue
        part = f"{', ' if line else ''}{key}={_shown(value)}"
        if len(line) + len(part) > LONGEST:
            return f"{name}({line}, ...)"
        line += part
    return f"{name}({line})"


def _shown(value: Any) -> str:
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
        return _several(value)
    return type(value).__name__


def _several(found: Collection[Any]) -> str:
    if len(found) <= _FEW and all(isinstance(x, str | int | float) for x in found):
        text = f"({', '.join(_shown(x) for x in found)})"
        if len(text) <= _TEXT:
            return text
    return f"<{len(found)} items>"
