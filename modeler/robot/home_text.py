"""Writing `[home]` into a robot file, and changing nothing else in it."""

import json
import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from modeler.core.errors import RobotError
from modeler.robot.legs import MARK, expanded, leg_names
from modeler.robot.place import Place

_HEADER = re.compile(r"\s*\[\s*(?:[\w.-]+|\"[^\"]*\")\s*\]\s*(?:#.*)?")
_ENTRY = re.compile(
    r"(?P<key>\s*(?P<name>[\w.-]+|\"[^\"]*\"|'[^']*')\s*=\s*)"
    r"(?P<value>\"[^\"]*\"|'[^']*'|[^#\s\"']+)(?P<rest>\s*(?:#.*)?)"
)
_WHERE = Place("robot file").at("[home]")
_KEPT = 1e-6
"""Values that differ by less are left as they are written: -pi/2 stays -pi/2."""


def with_home_text(text: str, stated: Mapping[str, float], home: Mapping[str, float]) -> str:
    """The robot file with that `[home]`; comments, and values that stay, as they were written.

    Args:
        text: of the file.
        stated: what its [home] says now, by row.
        home: what it is to say, by row.

    Raises:
        RobotError: the file's own [home] is written in a way that cannot be replaced line by line.
    """
    legs = leg_names(tomllib.loads(text).get("legs"), _WHERE)
    for lines in _written(text.splitlines(), stated, home, legs):
        changed = "\n".join(lines) + "\n"
        if _says(changed, text, home):
            return changed
    raise RobotError(
        "[home] cannot be replaced; write it as a table of its own, one joint a line, such as "
        'q2 = "-pi/2"'
    )


def home_lines(home: Mapping[str, float]) -> list[str]:
    """`q2 = -1.2` for every row."""
    return [f"{_key(f'q{name}')} = {_number(value)}" for name, value in home.items()]


def _written(
    lines: Sequence[str],
    stated: Mapping[str, float],
    home: Mapping[str, float],
    legs: Sequence[str],
) -> Iterator[list[str]]:
    """The lines as they are to be; where the first do not say so, the next may.

    What looks like the head of a table may stand in a text.
    """
    begin = next((i for i, line in enumerate(lines) if _is_header(line, "home")), None)
    if begin is not None:
        end = _end(lines, begin + 1)
        body = _body(lines[begin + 1 : end], stated, home, legs)
        yield [*lines[: begin + 1], *body, *lines[end:]]
    table = ["[home]", *home_lines(home), ""]
    after = next((i for i, line in enumerate(lines) if _is_header(line, "loops")), None)
    if after is not None:
        place = next(
            (i for i in range(after + 1, len(lines)) if _HEADER.fullmatch(lines[i])), len(lines)
        )
        while place > after and lines[place - 1].lstrip().startswith("#"):
            place -= 1  # a comment above a table belongs to it
        gap = [] if not lines[place - 1].strip() else [""]
        yield [*lines[:place], *gap, *table, *lines[place:]]
    yield [*lines, "", *table[:-1]]


def _is_header(line: str, name: str) -> bool:
    return bool(_HEADER.fullmatch(line)) and line.split("#")[0].strip(" []\t\"'") == name


def _end(lines: Sequence[str], begin: int) -> int:
    """Where the table's entries end; blank lines and comments after them belong to the next."""
    end = next((i for i in range(begin, len(lines)) if _HEADER.fullmatch(lines[i])), len(lines))
    while end > begin and (not lines[end - 1].strip() or lines[end - 1].lstrip().startswith("#")):
        end -= 1
    return end


def _body(
    lines: Sequence[str],
    stated: Mapping[str, float],
    home: Mapping[str, float],
    legs: Sequence[str],
) -> list[str]:
    """The entries of the table: changed in place, then those that it lacks."""
    left, body = dict(home), list[str]()
    for line in lines:
        found = _ENTRY.fullmatch(line)
        if found is None:
            body.append(line)
            continue
        pattern = found["name"].strip("\"'")
        filled = [pattern.replace(MARK, leg) for leg in legs] if MARK in pattern else [pattern]
        names = [name.removeprefix("q") for name in filled]
        values = {name: left.pop(name) for name in names if name in left}
        if all(_same(stated.get(name), value) for name, value in values.items()):
            body.append(line)
        elif len(values) == len(names) and len({_number(v) for v in values.values()}) == 1:
            body.append(found["key"] + _number(values[names[0]]) + found["rest"])
        else:
            first, *others = home_lines(values)
            body += [first + found["rest"], *others]
    return body + home_lines(left)


def _same(before: float | None, after: float) -> bool:
    return before is not None and abs(before - after) < _KEPT


def _number(value: float) -> str:
    """As short as it may be; multiples of pi/6 and pi/4 as such."""
    twelfths = value / (math.pi / 12)
    whole = round(twelfths)
    if whole and (whole % 2 == 0 or whole % 3 == 0) and abs(value - whole * math.pi / 12) < _KEPT:
        shared = math.gcd(whole, 12)
        times, over = whole // shared, 12 // shared
        sign = "-" if times < 0 else ""
        factor = "" if abs(times) == 1 else f"{abs(times)}*"
        return json.dumps(f"{sign}{factor}pi" + (f"/{over}" if over > 1 else ""))
    return repr(float(f"{value:.12g}") + 0.0)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name)


def _says(changed: str, text: str, home: Mapping[str, float]) -> bool:
    """True if the changed text states that home, and else what the text states."""
    try:
        after, before = tomllib.loads(changed), tomllib.loads(text)
        stated = expanded(after, _WHERE).get("home", {})
    except (tomllib.TOMLDecodeError, RobotError):
        return False
    after.pop("home", None)
    before.pop("home", None)
    return _plain(after) == _plain(before) and {f"q{name}" for name in home} <= stated.keys()


def _plain(document: Mapping[str, Any]) -> str:
    return json.dumps(document, default=str)
