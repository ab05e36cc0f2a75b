"""Cells of a TOML file that people write: where they stand, what they hold, what is wrong there."""

import difflib
import json
import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression, ExpressionError, Law, parse_expression
from modeler.core.thresholds import THRESHOLDS

LARGEST = 1e12
"""Size of any number, in SI units: squares and products of larger ones leave double precision."""


@dataclass(frozen=True)
class TomlCell:
    """A place in a robot file, `arm.toml: [mdh] row "3", column theta`, and what stands there.

    Its methods give that value as what it has to be; each raises a `RobotError` if it is not.
    """

    file: str
    location: str = ""
    value: Any = None

    def enter(self, spot: str, value: Any = None) -> "TomlCell":
        """Returns the place inside this one."""
        return TomlCell(self.file, f"{self.location}, {spot}" if self.location else spot, value)

    def with_value(self, value: Any) -> "TomlCell":
        """Returns the same place with another value: one of the entries that stand there."""
        return TomlCell(self.file, self.location, value)

    def make_error(self, what: str) -> RobotError:
        """Returns the error to raise: the place and `what`, as one line."""
        where = f"{self.file}: {self.location}" if self.location else self.file
        words = (
            w
            if len(w) <= THRESHOLDS.max_quoted_letters
            else f"{w[: THRESHOLDS.max_quoted_letters]}..."
            for w in what.split()
        )
        return RobotError(" ".join([*f"{where}:".split(), *words]))

    def make_mismatch(self, expected: str) -> RobotError:
        """Returns the error to raise where something else stands than is expected."""
        return self.make_error(f"got {quote_value(self.value)}; expected {expected}")

    def read_expression(self, law: Law | None = None) -> Expression:
        """Returns an `Expression` or a number; names are not checked. `law` may stand in it."""
        try:
            return parse_expression(self.value, law)
        except ExpressionError as error:
            message = str(error)
            if isinstance(self.value, str):
                message = message.replace(
                    f'"{self.value.strip()}"', quote_value(self.value.strip())
                )
            raise self.make_error(message) from None

    def read_number(self, example: str) -> float:
        """Returns a finite number, not an expression."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            raise self.make_mismatch(f"a number such as {example}")
        try:
            number = float(self.value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self.make_mismatch(f"a finite number such as {example}")
        if abs(number) > LARGEST:
            raise self.make_mismatch(f"at most {LARGEST:g} in SI units, such as {example}")
        return number

    def read_text(self, example: str) -> str:
        """Returns a TOML string that is not empty."""
        if not isinstance(self.value, str) or not self.value.strip():
            raise self.make_mismatch(f"text such as {example}")
        return self.value

    def read_list(self, example: str, length: int | None = None) -> list[Any]:
        """Returns a TOML array, of `length` entries if that is given."""
        if not isinstance(self.value, list):
            raise self.make_mismatch(f"a list such as {example}")
        count = len(self.value)
        if length is not None and count != length:
            raise self.make_error(
                f"got {count} entries, expected {length}, as in {example}; "
                f"{'add' if count < length else 'remove'} {abs(count - length)}"
            )
        return self.value

    def read_table(self, example: str) -> dict[str, Any]:
        """Returns a TOML table."""
        if not isinstance(self.value, dict):
            raise self.make_mismatch(f"a table, as in {example}")
        return self.value

    def read_items(self, example: str) -> "Iterator[tuple[str, TomlCell]]":
        """Yields the keys of a TOML table, each with the cell of its value."""
        for key, value in self.read_table(example).items():
            yield key, self.enter(quote_value(key), value)

    def read_checked_table(
        self, keys: Collection[str], example: str, unknown: str = "", missing: str = ""
    ) -> dict[str, Any]:
        """Returns a TOML table with the keys that it may have and those that it needs.

        Args:
            keys: that it may have.
            example: of a table.
            unknown: what to do about another one; by default `keys` are listed.
            missing: what to do about one that is missing; empty if all may be.
        """
        table = self.read_table(example)
        for key in table:
            if key not in keys:
                advice = unknown or f"expected {join_names(keys)}"
                raise self.make_error(
                    f"unknown key {quote_value(key)}{suggest_name(key, keys)}; {advice}"
                )
        for key in keys:
            if missing and key not in table:
                raise self.make_error(f"{key} is missing; {missing}")
        return table


def quote_value(value: Any) -> str:
    """Returns the user's value as he wrote it, shortened: `"q1"`, `1.57`, `[1, 2]`."""
    if isinstance(value, bool):
        text = str(value).lower()
    elif isinstance(value, str):
        text = f'"{value}"'
    else:
        try:
            text = f"{value!r}"
        except ValueError:  # Python prints no integer of more than 4300 digits
            text = "a number of thousands of digits"
    return (
        text
        if len(text) <= THRESHOLDS.max_quoted_letters
        else f"{text[: THRESHOLDS.max_quoted_letters - 4]} ..."
    )


def join_names(names: Iterable[str]) -> str:
    """Returns `a, b, c`; `none` if there is nothing to list."""
    return ", ".join(names) or "none"


def suggest_name(name: Any, names: Iterable[str]) -> str:
    """Returns ` (did you mean "viscous"?)` for a misspelt name, else nothing."""
    if not isinstance(name, str):
        return ""
    # Letter case is the commonest slip: d3 for D3.
    known = {known.lower(): known for known in names}
    matches = difflib.get_close_matches(name.lower(), known, n=2, cutoff=0.6)
    if not matches:
        return ""
    return f" (did you mean {' or '.join(quote_value(known[key]) for key in matches)}?)"


def format_toml(value: object) -> str:
    """Returns a value as it stands in a robot file."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        entries = ", ".join(
            f"{format_toml_key(key)} = {format_toml(entry)}" for key, entry in value.items()
        )
        return f"{{{entries}}}"
    if isinstance(value, list):
        return "[" + ", ".join(format_toml(entry) for entry in value) + "]"
    return repr(value)


def format_toml_key(key: str) -> str:
    """Returns a key as it stands there, in quotes where it needs them."""
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)
