"""A table of a paper or a spreadsheet, from the clipboard, as the table of a robot file.

Rows are lines; cells stand between tabs, semicolons or bars, or blanks. The first line may have
headings: letters with or without an index (`alpha_i-1`, `a(j)`, Greek or spelt), units behind them
(`[deg]`, `(mm)`). Nothing is evaluated: cells become text, which the reader of robot files judges.
"""

import csv
import io
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass

from modeler.core.errors import RobotError
from modeler.core.expression import FUNCTIONS
from modeler.core.toml_cells import join_names
from modeler.robot.edit import replace_limits
from modeler.robot.read import fill_template
from modeler.robot.robot_text import replace_table
from modeler.robot.table import ANGLES, CONVENTIONS, GREEK
from modeler.robot.thresholds import THRESHOLDS

_SIGNS = str.maketrans(
    "\u2212\u2013\u2014\u00a0\u2009\u202f\u00d7\u00b7\u22c5\u2217\u00ba\u2032"
    "\u2080\u2081\u2082\u2083\u2084\u2085\u2086\u2087\u2088\u2089",
    "---   ****\u00b0'0123456789",
    "\ufeff",
)
_GREEK: dict[str, str | int | None] = {"\u03c0": "pi", "\u03d1": "theta", **GREEK}
_WORDS = {
    "j": "j i k joint link axis n no nr row frame # gelenk achse",
    "a": "a ant antecedent",
    "parent": "parent",
    "mu": "mu",
    "sigma": "sigma type kind",
    "gamma": "gamma",
    "b": "b",
    "alpha": "alpha twist",
    "d": "d",
    "theta": "theta th angle",
    "r": "r",
}
_LETTER = {word: letter for letter, words in _WORDS.items() for word in words.split()}
_SPELLINGS = {"deg": "deg degree degrees grad \u00b0", "rad": "rad radians", "in": "in inch"}
_UNITS = {"mm": "mm", "cm": "cm", "m": "m"} | {
    spelling: unit for unit, spellings in _SPELLINGS.items() for spelling in spellings.split()
}
_MEASURE = re.compile(r"(?:\s*[\[(/,]\s*|\s+)(?:in\s+)?([a-z\u00b0]+)\s*[\])]?$")
_HEADING = re.compile(rf"({'|'.join(sorted(_LETTER, key=len, reverse=True))})([ijk](?:-1)?)?")
_SIGMAS = {"r": "0", "revolute": "0", "p": "1", "prismatic": "1", "t": "1", "f": "2", "fixed": "2"}
_GUESSED = {
    "khalil": {
        4: "alpha d theta r",
        5: "j alpha d theta r",
        7: "j a sigma alpha d theta r",
        6: "j sigma alpha d theta r",
        8: "j a mu sigma alpha d theta r",
        9: "j a sigma gamma b alpha d theta r",
        10: "j a mu sigma gamma b alpha d theta r",
    },
    "craig": {4: "alpha a d theta", 5: "j alpha a d theta", 6: "j sigma alpha a d theta"},
    "classical": {4: "theta d a alpha", 5: "j theta d a alpha", 6: "j sigma theta d a alpha"},
}
"""Columns of a table without headings, by how many it has."""
_GEOMETRY = ("gamma", "b", "alpha", "d", "theta", "r")
_UNIT = re.compile(r"\d\s*(deg|mm|cm|m|in)\b|pi\b")


@dataclass(frozen=True)
class PastedTable:
    """A table that was pasted.

    Attributes:
        convention: whose it is.
        columns: names, in its letters.
        rows: cells by column.
        symbols: names in it that need a value.
        headed: True if it had headings.
        notes: what was taken for what, one line each.
    """

    convention: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    symbols: tuple[str, ...]
    notes: tuple[str, ...]
    has_headings: bool


def parse_pasted_table(text: str, convention: str = "") -> PastedTable:
    """Returns the table in a text from the clipboard.

    Args:
        text: lines of cells.
        convention: whose table it is; "": what its headings say, Khalil's without any.

    Raises:
        RobotError: it has no cells, or columns that nobody can name.
    """
    lines = _parse_cells(_replace_signs(text))
    if not lines or max(map(len, lines)) < 2:
        raise RobotError(
            "pasted table: got no cells; expected lines of cells, as a spreadsheet copies them, "
            "such as `1  0  0  q1  0` under headings such as `j  alpha  d  theta  r`"
        )
    heads = [_parse_heading(cell) for cell in lines[0]]
    named = sum(head is not None and head[0] != "j" for head in heads) >= 2
    body = lines[1:] if named else lines
    if not body:
        raise RobotError("pasted table: got headings alone; expected a line for each joint below")
    notes: list[str] = []
    if named:
        unknown = [cell for cell, head in zip(lines[0], heads, strict=True) if head is None]
        if unknown:
            raise RobotError(
                f'pasted table, headings: got "{unknown[0]}"; expected letters among '
                f"{join_names(dict.fromkeys(_LETTER.values()))}, each with a unit or without"
            )
        known = [head for head in heads if head is not None]
        convention = convention or _infer_convention(known, body)
        columns, units = [head[0] for head in known], [head[2] for head in known]
    else:
        convention = convention or "khalil"
        columns = _GUESSED[convention].get(len(body[0]), "").split()
        units = [""] * len(columns)
        if not columns:
            raise RobotError(
                f"pasted table: got {len(body[0])} columns without headings; expected "
                f"{join_names(map(str, sorted(_GUESSED[convention])))} of them, or a first line "
                f"with headings among {join_names(CONVENTIONS[convention].values())}"
            )
        notes.append(f"no headings: taken as {' '.join(columns)}")
    if convention == "khalil":
        columns = ["a" if column == "parent" else column for column in columns]
    allowed = [*CONVENTIONS[convention].values()]
    if wrong := [c for c in columns if c not in allowed or columns.count(c) > 1]:
        raise RobotError(
            f"pasted table, headings: got {join_names(columns)}; expected each once, of a table of "
            f"convention {convention}: {join_names(allowed)}; {wrong[0]} is wrong or stands twice"
        )
    return _build_table(columns, units, body, convention, notes, named)


def _replace_signs(text: str) -> str:
    """Returns the text with ASCII signs and spelt Greek letters."""
    return text.translate(_SIGNS).translate(str.maketrans(_GREEK))


def _parse_cells(text: str) -> list[list[str]]:
    """Lines of cells, without those that are empty everywhere."""
    lines = [line for line in text.splitlines() if line.strip(" \t;|&\\")]
    mark = next((m for m in "\t;|&" if any(m in line for line in lines)), "")
    if mark:
        lines = [line.strip(" ").removesuffix("\\\\").strip(" ") for line in lines]
        lines = [line.strip("|") if mark == "|" else line for line in lines]
        rows = list(csv.reader(io.StringIO("\n".join(lines)), delimiter=mark))
        rows = [row for row in rows if any(cell.strip(" -:") for cell in row)]
    else:
        rows = [re.split(r"\s{2,}", line.strip()) for line in lines]
        if any(len(row) < 2 for row in rows):
            rows = [line.split() for line in lines]
    width = max(map(len, rows), default=0)
    full = [[" ".join(cell.split()) for cell in [*row, *[""] * (width - len(row))]] for row in rows]
    used_columns = [k for k in range(width) if any(row[k] for row in full)]
    return [[row[k] for k in used_columns] for row in full]


def _parse_heading(cell: str) -> tuple[str, str, str] | None:
    """Letter, index, unit of a heading; None of what is none."""
    text, unit = cell.lower().strip(), ""
    measure = _MEASURE.search(text)
    if measure is not None and measure[1] in _UNITS:
        text, unit = text[: measure.start()], _UNITS[measure[1]]
    heading = _HEADING.fullmatch(re.sub(r"[\s\\_{}()$.*]", "", text))
    return None if heading is None else (_LETTER[heading[1]], heading[2] or "", unit)


def _infer_convention(heads: Sequence[tuple[str, str, str]], body: Sequence[Sequence[str]]) -> str:
    """By the letters, their indices, their order; a of Khalil's is the name of the row above."""
    letters = [letter for letter, _, _ in heads]
    behind = {letter for letter, index, _ in heads if index.endswith("-1")}
    if {"r", "gamma", "b"} & set(letters) or not {"a", "d", "alpha", "theta"} <= set(letters):
        return "khalil"
    if "parent" in letters or "alpha" in behind:
        return "craig"
    above = [row[letters.index("j")] for row in body[:-1]] if "j" in letters else []
    if [row[letters.index("a")] for row in body[1:]] == above:
        return "khalil"
    return "classical" if letters.index("theta") < letters.index("alpha") else "craig"


def _build_table(
    columns: list[str],
    units: list[str],
    body: Sequence[Sequence[str]],
    convention: str,
    notes: list[str],
    headed: bool,
) -> PastedTable:
    khalil = {letter: column for column, letter in CONVENTIONS[convention].items()}
    kinds = [khalil[column] for column in columns]
    rows = [dict(zip(kinds, map(_clean_cell, row), strict=True)) for row in body]
    for number, row in enumerate(rows, start=1):
        row["j"] = re.sub(r"\W|_|^(joint|link|axis)", "", row.get("j", "").lower()) or str(number)
        row["sigma"] = _SIGMAS.get(row.get("sigma", "").lower(), row.get("sigma", ""))
    unit_of = dict(zip(kinds, units, strict=True))
    for kind in kinds:
        if kind in _GEOMETRY and not unit_of[kind]:
            unit_of[kind] = _infer_unit(kind, CONVENTIONS[convention][kind], rows, notes)
    for row in rows:
        _insert_variable(row)
        row |= {k: _append_unit(row[k], unit_of.get(k, "")) for k in _GEOMETRY if k in row}
        row["mu"] = row.get("mu") or ("0" if row["sigma"] == "2" else "1")
    letters = CONVENTIONS[convention]
    used = ["j", *(c for c in letters if c in kinds or any(row.get(c, "0") != "0" for row in rows))]
    used = [c for c in dict.fromkeys(used) if c != "mu" or "mu" in kinds]
    cells = tuple(tuple(row.get(column) or "0" for column in used) for row in rows)
    names = {row["j"] for row in rows}
    known = {*FUNCTIONS, "pi", "deg", "mm", "cm", "m", "in", *names, *(f"q{n}" for n in names)}
    cell_names = (n for row in cells for cell in row[1:] for n in re.findall(r"[A-Za-z]\w*", cell))
    symbols = tuple(dict.fromkeys(name for name in cell_names if name not in known))
    columns = [letters[column] for column in used]
    return PastedTable(convention, tuple(columns), cells, symbols, tuple(notes), headed)


def _clean_cell(cell: str) -> str:
    """A cell with points for decimal commas, degrees as `deg`, without marks of variables."""
    cell = re.sub(r"(?<=\d),(?=\d{3}(\D|$))(?=.*\.)", "", cell)  # 1,234.5
    cell = re.sub(r"(?<=\d),(?=\d)", ".", cell)
    cell = re.sub(r"\s*\u00b0", " deg", cell)
    cell = re.sub(r"\\(?=[a-z])|\$|[{}]", "", cell)
    cell = re.sub(r"(?<=[A-Za-z])_(?=\d)", "", cell)
    cell = re.sub(r"[\u2019'*]+$", "", cell.strip())  # q1*, the mark of a variable
    cell = re.sub(r"^\+\s*", "", cell)
    return "0" if cell in ("-", "--", "/") else cell


def _insert_variable(row: dict[str, str]) -> None:
    """The joint variable as q<j>, in its column; a number there is its offset."""
    name, variable = row["j"], f"q{row['j']}"
    turns = rf"\b(?:theta|th|q|t){re.escape(name)}\b|^(?:theta|q|var|variable)$"
    slides = rf"\b(?:d|r|q){re.escape(name)}\b|^(?:d|r|q|var|variable)$"
    theta, r = row.get("theta", ""), row.get("r", "")
    if not row["sigma"]:
        turning = re.search(turns, theta) is not None
        sliding = not turning and re.search(slides, r) is not None
        row["sigma"] = "1" if sliding else "0"
    if row["sigma"] == "2":
        return
    home, pattern = ("r", slides) if row["sigma"] == "1" else ("theta", turns)
    cell = re.sub(pattern, variable, row.get(home, ""))
    if variable not in cell:
        zero = not cell or re.fullmatch(r"[+-]?0(\.0*)?( *(deg|mm|cm|m|in))?", cell)
        cell = variable if zero else f"{variable} {'' if cell.startswith('-') else '+ '}{cell}"
        cell = re.sub(r" -(?=\S)", " - ", cell)
    row[home] = cell


def _infer_unit(kind: str, letter: str, rows: Sequence[dict[str, str]], notes: list[str]) -> str:
    """The unit of a column without one, where its numbers are too large for rad or m."""
    cells = [row.get(kind, "") for row in rows]
    if any(_UNIT.search(cell) for cell in cells):
        return ""
    numbers = r"(?<![\w.])\d+(?:\.\d*)?(?:[eE][+-]?\d+)?(?![\w.])"
    most = max((float(n) for cell in cells for n in re.findall(numbers, cell)), default=0.0)
    if kind in ANGLES and most > THRESHOLDS.max_angle_in_rad:
        notes.append(f"column {letter}: taken in degrees, for {most:g} rad is more than a turn")
        return "deg"
    if kind not in ANGLES and most > THRESHOLDS.max_length_in_m:
        notes.append(f"column {letter}: taken in mm, for {most:g} m is long")
        return "mm"
    return ""


def _append_unit(cell: str, unit: str) -> str:
    """The numbers of a cell with the unit of their column."""
    if unit in ("", "rad", "m") or _UNIT.search(cell):
        return cell

    def add_unit(number_match: "re.Match[str]") -> str:
        return number_match[0] if float(number_match[1]) == 0 else f"{number_match[0]} {unit}"

    terms = r"(?<![\w.*/])(?<![*/] )(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)(?![\w.])(?!\s*[*/(])"
    return re.sub(terms, add_unit, cell)


def build_pasted_robot(table: PastedTable, name: str) -> str:
    """Returns a robot file with that table, which derives as it is.

    Args:
        table: pasted.
        name: of the robot.
    """
    begun = fill_template(name, joints="P", convention=table.convention)
    return insert_pasted_table(replace_limits(begun, "1", ("",) * 4), table)


def format_symbol_line(name: str) -> str:
    """Returns a line of `[symbols]` for a name whose value is to be written yet."""
    angle = name.lower().startswith(("alpha", "theta", "gamma", "beta", "phi", "th"))
    unit = "rad" if angle else "m"
    return (
        f"{name} = {THRESHOLDS.placeholder_length}".ljust(38)
        + f"# {unit}: a placeholder, write the value"
    )


def insert_pasted_table(text: str, table: PastedTable) -> str:
    """Returns a robot file with another table, and lines for the symbols that it lacks.

    Raises:
        RobotError: the file has no table that can be replaced.
    """
    changed = replace_table(text, table.columns, table.rows, table.convention)
    known = tomllib.loads(changed).get("symbols", {})
    missing = [format_symbol_line(name) for name in table.symbols if name not in known]
    if not missing:
        return changed
    head = re.search(r"(?m)^[ \t]*\[[ \t]*symbols[ \t]*\][^\n]*\n", changed)
    if head is None:
        head = re.search(r"(?m)^(?=[ \t]*\[[ \t]*mdh[ \t]*\])", changed)
        missing = ["[symbols]", *missing, ""]
    assert head is not None  # or there was no table
    return changed[: head.end()] + "\n".join([*missing, changed[head.end() :]])


def parse_pasted_cells(text: str) -> list[list[str]]:
    """Returns a block of cells from the clipboard, with readable signs."""
    lines = io.StringIO(_replace_signs(text).strip("\r\n"))
    return [[_clean_cell(cell) for cell in row] for row in csv.reader(lines, delimiter="\t")]
