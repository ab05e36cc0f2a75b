"""How a text file writes its columns: determined from its first lines."""

import codecs
import csv
import dataclasses
import io
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from modeler.core.errors import DataError
from modeler.logs.columns import find_first_seconds, is_beyond, is_clock, parse_moment
from modeler.logs.mapping import find_unit
from modeler.logs.thresholds import THRESHOLDS

TEXTS = (".csv", ".txt", ".dat", ".tsv", ".log", ".asc", ".lvm")
"""How the names of text files end."""

_BLANKS = " "
_ENTRY = "\x1f"  # between entries of a list, while columns are counted
_DELIMITERS = {",": "commas", ";": ";", "\t": "tabs", "|": "|", _BLANKS: "blanks"}
_EPOCH = (10**9, 4 * 10**9)  # s since 1970, 2001 to 2096
_WHOLE = re.compile(r"(?:\d{17,18}|[1-8]\d{18})$")  # that no float holds
_EMPTY = {"", "null", "none", "na", "n/a", "#n/a", "nan", "-nan", "+nan"}
_NUMBERS = {
    decimal: re.compile(rf"[+-]?(?:(?:\d+{mark}?\d*|{mark}\d+)(?:e[+-]?\d+)?|inf(?:inity)?)")
    for decimal, mark in ((".", r"\."), (",", ","), ("", "[.,]"))
}
"""What is a number, by its decimal; "": by either."""
_PROSE = re.compile(r"[^,;\t|]*\w:(?:\s|$)")  # as in "Operator: me"
_COMMENT = re.compile(r"^\s*(?:#|%|//)+\s*")
_LIST = re.compile(
    rb"""(?<![^\s,;|"])"?(?:(?:array|tensor)\()?\[\s*((?:[-+.\d]|nan|inf|['"])[^\[\]]*)\]\)?"?"""
    rb"""|"\(\s*([-+.\d][^()"]*)\)\""""
)
"""A list as Python, numpy or JSON print it, with its quotes; a tuple in quotes."""
_RATE = re.compile(
    r"(?i)(?:sampl\w*|rate|freq\w*|abtast\w*|\bfs\b).*?(\d+(?:[.,]\d+)?)[\s;]*(k?)hz\b"
)
_STEP = re.compile(
    r"(?i)(?:delta[_ ]?[xt]|(?:sampl\w*|cycle|abtast\w*|zyklus)[ _-]*(?:time|period|interval|zeit)"
    r"|zykluszeit|\bdt|\bts)\s*(?:[\[(](\w+)[\])])?[\s:=;,\"]+(\d+(?:[.,]\d+)?(?:e[+-]?\d+)?)"
    r"\s*([nuµm]?s\b|sec)?"
)


@dataclass(frozen=True)
class TableHead:
    """What stands above the rows of a table.

    Attributes:
        names: of the columns; `c1`, `c2` ... where it has none.
        first: line of the first row, counted from 0.
        units: that a line under the names states, by column.
        rate: Hz, that a line before them states.
        notes: what was found, in words; nothing of names in the first line.
    """

    names: tuple[str, ...]
    first: int
    units: Mapping[str, str] = field(default_factory=dict)
    rate: float | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Dialect:
    """How a text file writes its columns.

    Attributes:
        head: what stands above the rows.
        start: bytes before the rows.
        delimiter: between columns; a blank means any run of blanks.
        decimal: of numbers, a point or a comma.
        encoding: of the text.
        clocks: columns of times as texts, with their first row, from which they are counted, ns.
        wholes: the same of whole numbers that no float holds.
        lists: True if cells hold lists, whose entries are columns.
    """

    head: TableHead
    start: int
    delimiter: str = ","
    decimal: str = "."
    encoding: str = "utf-8"
    clocks: Mapping[str, int] = field(default_factory=dict)
    wholes: Mapping[str, int] = field(default_factory=dict)
    lists: bool = False

    @property
    def reading_notes(self) -> tuple[str, ...]:
        """Returns what is unlike commas, points, and names in the first line.

        One sentence, or nothing.
        """
        counted = [*self.clocks, *(n for n, first in self.wholes.items() if is_beyond(first))]
        parts = [
            *([f"{_DELIMITERS[self.delimiter]} between columns"] * (self.delimiter != ",")),
            *(["decimal commas"] * (self.decimal == ",")),
            *self.head.notes,
            *(["a column for each entry of lists"] * self.lists),
            *([f"in {self.encoding}"] * (not self.encoding.startswith("utf-8"))),
            *([f"{', '.join(counted)} counted from the first row"] * bool(counted)),
        ]
        return (f"read with {', '.join(parts)}",) if parts else ()

    def open_text(self, path: Path) -> BinaryIO:
        """Returns the file as bytes of UTF-8, or of an encoding that has the same digits."""
        if self.encoding.startswith("utf-16"):
            return io.BytesIO(path.read_bytes().decode(self.encoding, "replace").encode())
        return path.open("rb")

    def normalise_rows(self, text: bytes) -> bytes:
        """Returns whole lines with one mark between their columns."""
        if self.lists:
            text = expand_lists(text, self.delimiter.encode())
        if self.delimiter != _BLANKS:
            return text
        text = b" " + text.replace(b"\t", b" ").replace(b"\r", b"")
        while b"  " in text:
            text = text.replace(b"  ", b" ")
        return text.replace(b"\n ", b"\n").replace(b" \n", b"\n").strip(b" ")


def detect_dialect(path: Path) -> Dialect:
    """Returns what the first lines of a text file say of all others.

    Raises:
        DataError: it is no text, a quote is left open, or names and rows are of other numbers.
        OSError: it cannot be read.
    """
    with path.open("rb") as file:
        raw = file.read(THRESHOLDS.sampled_bytes)
        while raw.count(b"\n") + raw.count(b"\r") < 2 and len(raw) < THRESHOLDS.max_line_bytes:
            if not (more := file.read(THRESHOLDS.sampled_bytes)):
                break
            raw += more
        whole = not file.read(1)
    encoding = "utf-16" if raw[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE) else "utf-8"
    if encoding == "utf-8" and raw[:200].count(b"\0") >= len(raw[:200]) // 3 > 0:
        encoding = "utf-16-le" if raw[1:2] == b"\0" else "utf-16-be"
    if encoding != "utf-8":
        raw = raw.decode(encoding, "replace").encode()
    if b"\0" in raw:
        line = raw[: raw.index(b"\0")].count(b"\n") + 1
        raise DataError(
            f"{path}: line {line} holds bytes that are not text; expected a text with columns of "
            "numbers; it is damaged, or another kind of file: give it the ending of its format"
        )
    lists = _LIST.search(raw) is not None
    lines, starts = _split_lines(expand_lists(raw, _ENTRY.encode()) if lists else raw, whole)
    joined = b"\n".join(lines)
    try:
        text = joined.decode().removeprefix("\ufeff").split("\n")
    except UnicodeDecodeError:
        encoding, text = "latin-1", joined.decode("latin-1").split("\n")
    if not any(line.strip() for line in lines):
        raise DataError(
            f"{path}: the first line does not end within {THRESHOLDS.max_line_bytes >> 20} MiB, or "
            "is empty; expected the names of the columns; write the file again"
        )
    plain = [re.sub(f"{_ENTRY}[^{_ENTRY},;|\t]*", "", line) for line in text] if lists else text
    delimiter, decimal = _detect_marks(plain, path)
    rows = [split_entries(line, delimiter) for line in plain]
    head = detect_head(plain, rows, delimiter, decimal, str(path))
    if lists and head.first < len(text):
        rows = [split_entries(line, delimiter) for line in text]
        counts = [entry.count(_ENTRY) + 1 for entry in rows[head.first]]
        head = dataclasses.replace(head, names=_name_entries(head.names, counts))
        rows = [[e for entry in row for e in entry.split(_ENTRY)] for row in rows]
    row = rows[head.first] if head.first < len(rows) else []
    firsts = list(zip(head.names, row, strict=False))
    clocks = {name: parse_moment(entry) for name, entry in firsts if is_clock(entry)}
    wholes = {name: int(entry) for name, entry in firsts if _WHOLE.match(entry)}
    wholes |= find_first_seconds(head.names, dict(firsts))
    start = starts[head.first] if head.first < len(starts) else starts[-1] + len(lines[-1])
    return Dialect(head, start, delimiter, decimal, encoding, clocks, wholes, lists)


def _name_entries(names: Sequence[str], counts: Sequence[int]) -> tuple[str, ...]:
    """`q` of three entries: `q[1]`, `q[2]`, `q[3]`."""
    pairs = zip(names, counts, strict=True)
    return tuple(
        f"{name}[{k + 1}]" if count > 1 else name for name, count in pairs for k in range(count)
    )


def _split_lines(raw: bytes, whole: bool) -> tuple[list[bytes], list[int]]:
    """Lines, and where each begins; without one that is cut off."""
    split_lines = re.finditer(rb"([^\r\n]*)(\r\n|\n|\r|$)", raw)
    matches = [m for m in split_lines if m[2] or (whole and m[1])]
    return [match[1] for match in matches], [match.start() for match in matches]


def split_entries(line: str, delimiter: str) -> list[str]:
    """Returns the entries of a line, without blanks and quotes around them."""
    if delimiter == _BLANKS:
        return line.split()
    is_quoted = '"' in line
    entries = next(csv.reader([line], delimiter=delimiter)) if is_quoted else line.split(delimiter)
    return [strip_quotes(entry) for entry in entries]


def strip_quotes(name: str) -> str:
    """Returns a text without blanks and quotes around it: `"time", "q1"` leaves both."""
    name = name.strip()
    if len(name) > 1 and name[0] == name[-1] and name[0] in "\"'":
        name = name[1:-1].strip()
    return name


def parse_decimal(entry: str) -> float | None:
    """Returns the number that an entry is, with a decimal point or comma; None if it is none."""
    known = _NUMBERS[""].fullmatch(entry.lower()) is not None
    return float(entry.replace(",", ".")) if known else None


def _is_value(entry: str, decimal: str) -> bool:
    """True of a number, a date or a time of day."""
    return _NUMBERS[decimal].fullmatch(entry.lower()) is not None or is_clock(entry)


def _detect_marks(lines: Sequence[str], path: Path) -> tuple[str, str]:
    """What stands between columns, and before decimals: where most entries become numbers."""
    last = [line for line in lines if line.strip()][-THRESHOLDS.sampled_rows :]

    def compute_score(marks: tuple[str, str]) -> tuple[float, ...]:
        delimiter, decimal = marks
        rows = [split_entries(line, delimiter) for line in last]
        width, count = Counter(map(len, rows)).most_common(1)[0]
        even = [row for row in rows if len(row) == width]
        values = sum(_is_value(e, decimal) for row in even for e in row)
        return values / len(rows), values / (width * count)

    kinds = [(d, m) for d in _DELIMITERS for m in ".," if d != "," or m == "."]
    best = max(kinds, key=lambda marks: (*compute_score(marks), -kinds.index(marks)))
    if compute_score(best)[0] == 0.0:
        return ",", "."
    delimiter, decimal = best
    if delimiter != "," and decimal == "." and not re.search(r"\d\.\d", "\n".join(last)):
        with path.open("rb") as file:  # whole numbers here: others may show
            file.seek(path.stat().st_size // 2)
            later = file.read(THRESHOLDS.sampled_bytes)
        if re.search(rb"\d,\d", later):
            return delimiter, ","
    return delimiter, decimal


def detect_head(
    lines: Sequence[str], rows: Sequence[Sequence[str]], delimiter: str, decimal: str, where: str
) -> TableHead:
    """Finds where the rows of numbers begin, and what stands above them.

    Args:
        lines: of the file, from the first on.
        rows: their entries.
        delimiter: between these.
        decimal: of the numbers; "" for either.
        where: name of the file, for messages.

    Raises:
        DataError: a quote is left open, or names and rows are of other numbers.
    """
    last = [row for row in rows if any(row)][-THRESHOLDS.sampled_rows :]
    valued = [row for row in last if any(_is_value(e, decimal) for e in row)] or last
    width = Counter(map(len, valued)).most_common(1)[0][0]
    even = [row for row in valued if len(row) == width]
    shares = [sum(_is_value(row[k], decimal) for row in even) / len(even) for k in range(width)]
    places = [k for k, share in enumerate(shares) if share > 0.5]

    def is_row(row: Sequence[str]) -> bool:
        held = [row[k] for k in places] if len(row) == width else []
        fine = [_is_value(e, decimal) or e.lower() in _EMPTY for e in held]
        return any(_is_value(e, decimal) for e in held) and fine[0] and 2 * sum(fine) > len(fine)

    first = next((i for i, row in enumerate(rows) if is_row(row)), min(1, len(rows)))
    if first and lines[first - 1].count('"') % 2:
        raise DataError(
            f'{where}: the line above the rows has a quote (") that is not closed; expected the '
            "names of the columns; close it, or delete it"
        )
    ends = not any(row[-1] for row in even)  # with a mark, which names may lack
    above = [_split_names(rows[i], lines[i], width, ends) for i in range(first)]
    units = _find_units_line(above)
    at = _find_names_line(above, decimal, units)
    rate = _parse_rate(lines[:first])
    if at is None:
        for i in [i for i in range(first) if any(rows[i])][-1:]:
            _refuse_other_count(rows[i], lines[i], width, delimiter, decimal, where)
        notes = [f"{_format_line_count(first)} before the rows"] * (first > 0)
        numbered = first == 0 and len(rows) > 1 and [*rows[0]] == [str(k) for k in range(width)]
        names = tuple(f"c{k + 1}" for k in range(width))
        if (echoed := _name_echo_columns(rows[first] if first < len(rows) else [], names)) != names:
            notes.append("columns named as in ROS messages with a header")
            return TableHead(echoed, first, rate=rate, notes=tuple(notes))
        notes.append(f"no names: columns are called c1 to c{width}" if width > 1 else "no name: c1")
        return TableHead(names, first + numbered, rate=rate, notes=tuple(notes))
    names = _make_distinct(above[at] or [], above[at - 1] if at else None)
    stated = {}
    notes = [f"{_format_line_count(at)} before the names"] * (at > 0)
    if units is not None and units != at:
        pairs = zip(names, above[units] or (), strict=True)
        stated = {n: u for n, e in pairs if (u := _parse_unit(e))}
        notes.append(f"units in line {units + 1}")
    between = first - at - 1 - (units is not None and units > at)
    notes += [f"{_format_line_count(between)} between names and rows"] * (between > 0)
    return TableHead(names, first, stated, rate, tuple(notes))


def _name_echo_columns(row: Sequence[str], names: tuple[str, ...]) -> tuple[str, ...]:
    """What the columns of `ros2 topic echo --csv` are of a message that begins with a header.

    Of a sensor_msgs/JointState with names, positions, velocities and efforts also those.
    """
    stamp = [int(e) if re.fullmatch(r"\d{1,10}", e) else -1 for e in row[:2]]
    if len(stamp) < 2 or not (_EPOCH[0] < stamp[0] < _EPOCH[1] and 0 <= stamp[1] < 10**9):
        return names
    head = ("header.stamp.sec", "header.stamp.nanosec", "header.frame_id")
    texts = [k for k, e in enumerate(row[3:]) if not e or _is_value(e, ".")]
    count = texts[0] if texts else 0
    if not count or len(row) != 3 + 4 * count:
        return (*head[:2], *names[2:])
    fields = ("name", "position", "velocity", "effort")
    return (*head, *(f"{field}[{k + 1}]" for field in fields for k in range(count)))


def _make_distinct(names: Sequence[str], over: Sequence[str] | None) -> tuple[str, ...]:
    """Names, `Position[J1]` where they repeat under groups; `c3` of a column without."""
    twice = len(set(names) - {""}) < len([name for name in names if name])
    if twice and over is not None:
        groups = [next((g for g in reversed(over[: k + 1]) if g), "") for k in range(len(names))]
        names = [f"{g}[{n}]" if g and n else g or n for g, n in zip(groups, names, strict=True)]
    return tuple(name or f"c{k + 1}" for k, name in enumerate(names))


def _format_line_count(lines: int) -> str:
    return f"{lines} line{'s' * (lines > 1)}"


def _split_names(row: Sequence[str], line: str, width: int, ends: bool) -> list[str] | None:
    """The entries of a line as one for each column; None if it has not so many."""
    plain = _COMMENT.sub("", line)
    if _PROSE.match(plain):
        return None
    marks = (r"\s*[,;\t|]\s*", r"\s{2,}", r"\s+")
    others = ([strip_quotes(e) for e in re.split(mark, plain.strip())] for mark in marks)
    for entries in (list(row), *others):
        entries = [_COMMENT.sub("", e) if k == 0 else e for k, e in enumerate(entries)]
        if len(entries) == width + 1 and entries[-1].lower() in ("", "comment"):
            entries = entries[:-1]  # a mark at the end of the line, or what LabVIEW adds
        if len(entries) == width - 1 and ends:
            entries.append("")
        if len(entries) == width:
            return entries
    return None


def _parse_unit(entry: str) -> str:
    text = re.sub(r"^[\[(]\s*|\s*[\])]$", "", entry)
    return text if re.search(r"[^\W\d]|[°%]", text) and find_unit(text) is not None else ""


def _find_units_line(above: Sequence[list[str] | None]) -> int | None:
    """The last line in which most entries are units, and that is not the only one."""
    for i in reversed(range(len(above))):
        entries = [e for e in above[i] or () if e.strip("-[]() ")]
        known = sum(bool(_parse_unit(e)) for e in entries)
        if entries and 2 * known > len(entries) and sum(row is not None for row in above) > 1:
            return i
    return None


def _find_names_line(
    above: Sequence[list[str] | None], decimal: str, units: int | None
) -> int | None:
    """The line of the names: the last one whose entries differ; else the last of so many."""
    words = [
        i
        for i, row in enumerate(above)
        if row is not None
        and i != units
        and len(row) > 0
        and 2 * sum(bool(e) and not _is_value(e, decimal) for e in row) > len(row)
    ]
    unlike = [i for i in words if len({e for e in above[i] or () if e}) >= len(above[i] or ()) - 1]
    return max(unlike or words, default=None)


def _refuse_other_count(
    row: Sequence[str], line: str, width: int, delimiter: str, decimal: str, where: str
) -> None:
    """Names directly above the rows, but not as many as there are columns."""
    words = [e for e in row if e and not _is_value(e, decimal)]
    prose = _COMMENT.match(line) or _PROSE.match(line) or (delimiter == _BLANKS and "=" in line)
    alone = len(row) < 2 and not (width == 2 and delimiter == ",")  # else a decimal comma
    if prose or alone or len(words) < len(row) or len(row) == width:
        return
    raise DataError(
        f"{where}: row 1: got {width} entries for {len(row)} columns; expected one each; write "
        "decimal points where numbers have decimal commas, or a name for every column"
    )


def _parse_rate(lines: Sequence[str]) -> float | None:
    """Samples in a second, as a line above the rows states it."""
    for line in lines:
        if match := _RATE.search(line):
            return float(match[1].replace(",", ".")) * (1e3 if match[2] else 1.0)
        if match := _STEP.search(line):
            unit = find_unit(match[1] or match[3] or "s")
            step = float(match[2].replace(",", ".")) * (unit.factor if unit else 1.0)
            if step > 0.0:
                return 1.0 / step
    return None


def expand_lists(text: bytes, between: bytes) -> bytes:
    r"""Returns the text with the entries of each list in place of it, something between them.

    >>> with_lists_as(b'0.1,"[1.0, 2.0]",[3. 4.\n 5.]', b",")
    b'0.1,1.0,2.0,3.,4.,5.'
    """

    def replace_list(match: re.Match[bytes]) -> bytes:
        inside = re.split(rb"[\s,;]+", (match[1] or match[2]).strip(b" \r\n\t,"))
        return between.join(entry.strip(b"'\"") for entry in inside)

    return _LIST.sub(replace_list, text)
