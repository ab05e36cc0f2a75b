"""Which machine and which period a log is of: by its folder, by a pattern, or by a list."""

import csv
import itertools
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeler.core.errors import DataError
from modeler.core.files import read_text
from modeler.core.json import parse_toml

PATTERN = "{machine}/{period}.*"
"""How logs are named where nobody says it: the folder is the machine, the file the period."""

_FIELD = re.compile(r"(\{[^{}]*\}|\*)")
_COLUMNS = ("machine", "period", "log")


@dataclass(frozen=True)
class LogName:
    """A log with its names.

    Attributes:
        machine: which of the robots.
        period: when, as a day or a number; unique within the machine.
        place: as it was given, FILE or FILE@START:END.
    """

    machine: str
    period: str
    place: str


def name_logs(places: Sequence[tuple[str, str]], pattern: str | None = None) -> tuple[LogName, ...]:
    """Logs with machine and period, those of one machine together, periods in natural order.

    A log that the pattern does not fit is an error: a log that is left out unsaid looks like a
    machine that is well.

    Args:
        places: (file, window) of each log; window "" or "0:10".
        pattern: of the end of the path, with {machine} and {period}; `*` is any text without a
            slash. None: the folder is the machine, the name of the file without ending the period.

    Raises:
        DataError: no such pattern, a path that it does not fit, or two logs of one machine and
            period.
    """
    expression = re.compile(_build_expression(PATTERN if pattern is None else pattern))
    log_names = []
    for place, window in places:
        at = f"@{window}" if window else ""
        path = Path(place)
        text = (path if path.parent.name else path.absolute()).as_posix()
        match = expression.search(text)
        if match is None:
            raise DataError(
                f"{place}: does not fit --name {pattern or PATTERN}; expected a path that ends so; "
                "give another pattern, or a --list"
            )
        parts = match.groupdict()
        machine = parts.get("machine") or path.absolute().parent.name
        log_names.append(LogName(machine, (parts.get("period") or path.stem) + at, place + at))
    return arrange_logs(log_names)


def arrange_logs(log_names: Iterable[LogName]) -> tuple[LogName, ...]:
    """Machine after machine, period after period; numbers within names count as numbers.

    Raises:
        DataError: two logs of one machine and period.
    """
    ordered = sorted(
        log_names, key=lambda log: (make_natural_key(log.machine), make_natural_key(log.period))
    )
    for one, other in itertools.pairwise(ordered):
        if (one.machine, one.period) == (other.machine, other.period):
            raise DataError(
                f"{other.place}: machine {one.machine}, period {one.period}, which {one.place} is "
                "too; expected one log each; rename one, or name the periods apart with --name or "
                "--list"
            )
    return tuple(ordered)


def make_natural_key(text: str) -> list[tuple[int, int, str]]:
    """A key that sorts day2 before day10."""
    return [
        (0, int(part), part) if part.isdecimal() else (1, 0, part)
        for part in re.split(r"(\d+)", text)
        if part
    ]


def _build_expression(pattern: str) -> str:
    """The regular expression of a pattern, for the end of a path."""
    parts, fields = [], set()
    for piece in _FIELD.split(pattern):
        if piece in ("{machine}", "{period}") and piece not in fields:
            fields.add(piece)
            parts.append(f"(?P<{piece[1:-1]}>[^/]+)")
        elif piece == "*":
            parts.append("[^/]*")
        elif "{" in piece or "}" in piece:
            what = "twice" if piece in fields else "which says nothing"
            raise DataError(
                f"--name {pattern}: got {piece}, {what}; expected {{machine}} and {{period}}, each "
                f"once at most, as in {PATTERN}"
            )
        else:
            parts.append(re.escape(piece))
    if not fields:
        raise DataError(
            f"--name {pattern}: neither {{machine}} nor {{period}} stands in it; expected a "
            f"pattern such as {PATTERN}"
        )
    if "{period}" not in fields:
        raise DataError(
            f"--name {pattern}: no {{period}} stands in it; expected one, as in {PATTERN}"
        )
    return f"(?:^|/){''.join(parts)}$" if not pattern.startswith("/") else f"^{''.join(parts)}$"


def read_log_list(path: Path) -> tuple[LogName, ...]:
    """Logs of a list: CSV with the columns machine, period, log; or TOML with [[log]] tables.

    Places are relative to the folder of the list.

    Raises:
        DataError: it cannot be read, or an entry is missing; says where.
    """
    try:
        text = read_text(path)
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); expected a list of logs"
        ) from None
    except UnicodeDecodeError:
        raise DataError(f"{path}: no text; expected a list of logs, .csv or .toml") from None
    rows = (
        _read_toml_rows(path, text)
        if path.suffix.lower() == ".toml"
        else _read_csv_rows(path, text)
    )
    if not rows:
        raise DataError(f"{path}: no logs in it; expected rows of machine, period, log")
    return arrange_logs(
        LogName(machine, period, str(path.parent / log)) for machine, period, log in rows
    )


def _read_csv_rows(path: Path, text: str) -> list[tuple[str, ...]]:
    reader = csv.DictReader(text.splitlines(), skipinitialspace=True)
    missing = [name for name in _COLUMNS if name not in (reader.fieldnames or ())]
    if missing:
        raise DataError(
            f"{path}: no column {missing[0]} in its first line; expected {', '.join(_COLUMNS)}"
        )
    return [_check_row(path, f"line {reader.line_num}", row) for row in reader]


def _read_toml_rows(path: Path, text: str) -> list[tuple[str, ...]]:
    try:
        entries = parse_toml(text).get("log", [])
    except ValueError as error:
        raise DataError(f"{path}: {error}; expected TOML with [[log]] tables") from None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise DataError(f"{path}: log is no list of tables; expected [[log]] before each log")
    return [_check_row(path, f"log {k}", entry) for k, entry in enumerate(entries, start=1)]


def _check_row(path: Path, where: str, row: dict) -> tuple[str, ...]:
    values = tuple("" if row.get(name) is None else str(row[name]).strip() for name in _COLUMNS)
    for name, value in zip(_COLUMNS, values, strict=True):
        if not value:
            raise DataError(f"{path}, {where}: no {name}; expected machine, period and log")
    return values
