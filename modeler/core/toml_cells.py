"""Cells of a TOML file that people write: where they stand, what they hold, what is wrong there."""

import difflib
import math
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression, ExpressionError, parse

LARGEST = 1e12
"""Size of any number, in SI units: squares and products of larger ones leave double precision."""

_LONGEST = 60  # letters of the user's text that are quoted


@dataclass(frozen=True)
class Place:
    """A place in a robot file: `arm.toml: [mdh] row "3", column theta`."""

    file: str
    spot: str = ""

    def at(self, spot: str) -> "Place":
        """The place inside this one."""
        return Place(self.file, f"{self.spot}, {spot}" if self.spot else spot)

    def error(self, what: str) -> RobotError:
        """The error to raise: the place and `what`, as one line."""
        where = f"{self.file}: {self.spot}" if self.spot else self.file
        words = (w if len(w) <= _LONGEST else f"{w[:_LONGEST]}..." for w in what.split())
        return RobotError(" ".join([*f"{where}:".split(), *words]))

    def mismatch(self, value: Any, expected: str) -> RobotError:
        """The error to raise where `value` stands and not what is expected."""
        return self.error(f"got {shown(value)}; expected {expected}")


def shown(value: Any) -> str:
    """The user's value as he wrote it, shortened: `"q1"`, `1.57`, `[1, 2]`."""
    if isinstance(value, bool):
        text = str(value).lower()
    elif isinstance(value, str):
        text = f'"{value}"'
    else:
        try:
            text = f"{value!r}"
        except ValueError:  # Python prints no integer of more than 4300 digits
            text = "a number of thousands of digits"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 4]} ..."


def listed(names: Iterable[str]) -> str:
    """`a, b, c`; `none` if there is nothing to list."""
    return ", ".join(names) or "none"


def near(name: Any, names: Iterable[str]) -> str:
    """` (did you mean "viscous"?)` for a misspelt name, else nothing."""
    if not isinstance(name, str):
        return ""
    # Letter case is the commonest slip: d3 for D3.
    known = {known.lower(): known for known in names}
    found = difflib.get_close_matches(name.lower(), known, n=2, cutoff=0.6)
    if not found:
        return ""
    return f" (did you mean {' or '.join(shown(known[key]) for key in found)}?)"


def expression_at(value: Any, place: Place) -> Expression:
    """The cell as an `Expression`; names are not checked.

    Raises:
        RobotError: not a number or an expression.
    """
    try:
        return parse(value)
    except ExpressionError as error:
        told = str(error)
        if isinstance(value, str):
            told = told.replace(f'"{value.strip()}"', shown(value.strip()))
        raise place.error(told) from None


def plain_number(value: Any, place: Place, example: str) -> float:
    """A finite number, not an expression.

    Raises:
        RobotError: anything else.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise place.mismatch(value, f"a number such as {example}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise place.mismatch(value, f"a finite number such as {example}")
    if abs(number) > LARGEST:
        raise place.mismatch(value, f"at most {LARGEST:g} in SI units, such as {example}")
    return number


def table_at(value: Any, place: Place, example: str) -> dict[str, Any]:
    """A TOML table.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, dict):
        raise place.mismatch(value, f"a table, as in {example}")
    return value


def check_keys(
    table: Collection[str],
    keys: Collection[str],
    place: Place,
    unknown: str = "",
    missing: str = "",
) -> None:
    """Refuse a table with keys that it does not have, or without those that it needs.

    Args:
        table: its keys.
        keys: those that it may have.
        place: of the table.
        unknown: what to do about one that is unknown; by default `keys` are listed.
        missing: what to do about one that is missing; empty if all may be.

    Raises:
        RobotError: names the first.
    """
    for key in table:
        if key not in keys:
            told = unknown or f"expected {listed(keys)}"
            raise place.error(f"unknown key {shown(key)}{near(key, keys)}; {told}")
    for key in keys:
        if missing and key not in table:
            raise place.error(f"{key} is missing; {missing}")


def list_at(value: Any, place: Place, example: str, length: int | None = None) -> list[Any]:
    """A TOML array, of `length` entries if that is given.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, list):
        raise place.mismatch(value, f"a list such as {example}")
    if length is not None and len(value) != length:
        raise place.error(
            f"got {len(value)} entries, expected {length}, as in {example}; "
            f"{'add' if len(value) < length else 'remove'} {abs(len(value) - length)}"
        )
    return value


def text_at(value: Any, place: Place, example: str) -> str:
    """A TOML string that is not empty.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, str) or not value.strip():
        raise place.mismatch(value, f"text such as {example}")
    return value
