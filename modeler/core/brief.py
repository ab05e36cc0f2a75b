"""What an object prints of itself: one short line, however much it holds."""

from collections.abc import Collection, Mapping
from typing import Any

from modeler.core.thresholds import THRESHOLDS


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
