"""Where in a robot file something stands, and how a mistake there is told."""

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from modeler.core.errors import RobotError

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


def near(name: str, names: Iterable[str]) -> str:
    """` (did you mean "viscous"?)` for a misspelt name, else nothing."""
    # Letter case is the commonest slip: d3 for D3.
    known = {known.lower(): known for known in names}
    found = difflib.get_close_matches(name.lower(), known, n=2, cutoff=0.6)
    if not found:
        return ""
    return f" (did you mean {' or '.join(shown(known[key]) for key in found)}?)"
