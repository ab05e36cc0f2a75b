"""A table: named columns with units, rows of numbers and texts; as text, HTML, Markdown, LaTeX.

Every table that a result gives is one of these. Whatever a user wrote (a title, a name) is escaped
here and nowhere else.
"""

import html
import io
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from modeler.core.errors import DataError, suggest_install
from modeler.core.formula import escape_latex
from modeler.core.json import ShortRepr
from modeler.core.thresholds import THRESHOLDS


@dataclass(frozen=True)
class MathCell:
    """A formula in a cell: as plain text, and as LaTeX without dollars."""

    text: str
    latex: str


Cell = str | int | float | bool | MathCell | None
"""None, and a number that is not finite, are shown as a dash."""


@dataclass(frozen=True, eq=False)
class Table(ShortRepr):
    """A table with a title, and columns that have names and units.

    >>> print(Table("links", (("name", ""), ("mass", "kg")), (("arm", 1.5), ("hand", 0.25))))
    links
    name  mass [kg]
    arm         1.5
    hand       0.25

    Attributes:
        title: in plain text.
        columns: (name, unit); the unit is empty where there is none, or where each row has its own.
        rows: as long as `columns`.
        note: a sentence below it.
    """

    title: str
    columns: tuple[tuple[str, str], ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""

    @classmethod
    def build(
        cls, title: str, head: str | Iterable[str], rows: Iterable[Iterable[Any]], note: str = ""
    ) -> "Table":
        """Returns a table whose head is written as "name, mass [kg]".

        Or as such names one by one.
        """
        columns = []
        for text in head.split(", ") if isinstance(head, str) else head:
            name, _, unit = text.removesuffix("]").rpartition(" [")
            columns.append((name, unit) if name and text.endswith("]") else (text, ""))
        return cls(title, tuple(columns), tuple(map(tuple, rows)), note)

    @classmethod
    def of_rows(
        cls, title: str, columns: Sequence["Column"], things: Iterable[Any], note: str = ""
    ) -> "Table":
        """Returns the table of what each column reads of each row."""
        rows = ([column.get_value(thing) for column in columns] for thing in things)
        return cls.build(title, [column.head for column in columns], rows, note)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, str | float | None]]:
        """Its rows, cells by the names of their columns: `DataFrame(table)` is `to_frame`."""
        names = [name for name, _ in self.columns]
        return (dict(zip(names, map(_get_value, row), strict=True)) for row in self.rows)

    def __str__(self) -> str:
        return self.to_text()

    def to_text(self) -> str:
        """Returns aligned columns of plain text, every row; numbers to the right."""
        head = tuple(_format_head(name, unit) for name, unit in self.columns)
        cells = [head, *(tuple(_format_cell(cell) for cell in row) for row in self.rows)]
        left = [k for k in range(len(head)) if not self._is_numeric(k)]
        lines = [line.rstrip() for line in align_columns(cells, left)]
        return "\n".join([self.title, *lines, *([self.note] if self.note else [])])

    def to_html(self) -> str:
        """Returns an HTML table.

        Of a long one its first and last rows, and how many are left out.
        """
        head = "".join(f"<th>{html.escape(_format_head(*column))}</th>" for column in self.columns)
        half = THRESHOLDS.max_page_rows // 2
        rows = [
            f"<tr>{''.join(f'<td>{html.escape(_format_formula(cell))}</td>' for cell in row)}</tr>"
            for row in (
                self.rows
                if len(self) <= THRESHOLDS.max_page_rows
                else self.rows[:half] + self.rows[-half:]
            )
        ]
        if len(self) > THRESHOLDS.max_page_rows:
            hidden = len(self) - THRESHOLDS.max_page_rows
            gap = f'<tr><td colspan="{len(self.columns)}">... {hidden} rows more'
            rows.insert(half, f"{gap} ...</td></tr>")
        caption = f"<caption>{html.escape(self.title)}</caption>" if self.title else ""
        note = f"<p>{html.escape(self.note)}</p>" if self.note else ""
        head, body = f"<thead><tr>{head}</tr></thead>", "\n".join(rows)
        return f"<table>{caption}\n{head}\n<tbody>\n{body}\n</tbody></table>{note}"

    def _repr_html_(self) -> str:
        return self.to_html()

    def to_markdown(self) -> str:
        """Returns a Markdown table."""
        cells = [[_format_head(*column) for column in self.columns], ["---"] * len(self.columns)]
        for row in self.rows:
            cells.append(
                [_format_formula(cell).replace("|", r"\|").replace("\n", " ") for cell in row]
            )
        return "\n".join("| " + " | ".join(row) + " |" for row in cells)

    def to_latex(self) -> str:
        """Returns a tabular environment; formulas in dollars."""
        kinds = "".join("r" if self._is_numeric(k) else "l" for k in range(len(self.columns)))
        cells = [[escape_latex(_format_head(*column)) for column in self.columns]]
        for row in self.rows:
            formulas = (isinstance(cell, MathCell) for cell in row)
            texts = map(_format_formula, row)
            cells.append(
                [t if f else escape_latex(t) for t, f in zip(texts, formulas, strict=True)]
            )
        head, *body = [" & ".join(row) + r" \\" for row in cells]
        lines = [rf"\begin{{tabular}}{{{kinds}}}", r"\hline", head, r"\hline", *body, r"\hline"]
        return "\n".join([*lines, r"\end{tabular}"])

    def to_csv(self) -> str:
        """Returns comma-separated values, the names with their units.

        Texts that need it are quoted.
        """
        import csv

        written = io.StringIO()
        rows = csv.writer(written, lineterminator="\n")
        rows.writerow(_format_head(*column) for column in self.columns)
        rows.writerows(
            [None if cell is None else _get_value(cell) for cell in row] for row in self.rows
        )
        return written.getvalue()

    def to_dict(self) -> dict[str, Any]:
        """Returns plain data: title, units, and the cells of every column by its name."""
        names = [name for name, _ in self.columns]
        cells = zip(*([_get_value(cell) for cell in row] for row in self.rows), strict=True)
        columns = dict(zip(names, map(list, cells), strict=True)) if self.rows else {}
        return {"title": self.title, "units": dict(self.columns), "columns": columns}

    def to_frame(self) -> Any:
        """Returns a pandas DataFrame.

        Columns by name without units, `frame.attrs["units"]` has them.

        Raises:
            DataError: pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise DataError(
                f"to_frame: pandas is not installed; {suggest_install('notebook')}"
            ) from None
        names = [name for name, _ in self.columns]
        rows = [[_get_value(cell) for cell in row] for row in self.rows]
        frame = pandas.DataFrame(rows, columns=names)
        frame.attrs["title"], frame.attrs["units"] = self.title, dict(self.columns)
        return frame

    def column(self, name: str) -> list[Cell]:
        """Returns the cells of one column.

        Raises:
            DataError: no such column.
        """
        names = [label for label, _ in self.columns]
        if name not in names:
            raise DataError(f"column: got {name}; this table has {', '.join(names)}")
        return [row[names.index(name)] for row in self.rows]

    def _is_numeric(self, k: int) -> bool:
        cells = [row[k] for row in self.rows if row[k] is not None]
        return all(isinstance(cell, int | float) for cell in cells)


@dataclass(frozen=True)
class Column:
    """A column of the rows that a result has, stated once for text, pages, files and notebooks.

    Attributes:
        head: name, with the unit of all cells, as in "mass [kg]".
        read: path of the attribute, as in "largest.value", or what reads a row; None is a dash.
        show: how a person reads it: a format; "%" for a share in percent; "" as it is; or what
            makes a text of the row. None: in files and notebooks only.
        unit: path of the unit of a cell, where each row has its own: shown in the cell.
        kind: of the column of a page: "text"; "bar" for a bar before the number.
        short: its head in a text.
    """

    head: str
    read: str | Callable[[Any], Any]
    show: str | Callable[[Any], str] | None = ""
    unit: str = ""
    kind: str = ""
    short: str = ""

    def get_value(self, thing: Any) -> Any:
        """Returns the cell of a row."""
        return self.read(thing) if callable(self.read) else _follow_path(thing, self.read)

    def format(self, thing: Any) -> str:
        """Returns the cell of a row as text."""
        if callable(self.show):
            return self.show(thing)
        value = self.get_value(thing)
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            return "-"
        text = format_percent(value) if self.show == "%" else format(value, self.show or "")
        return f"{text} {_follow_path(thing, self.unit):<3}" if self.unit else text


def _follow_path(thing: Any, path: str) -> Any:
    """Attributes, and numbers of items; None where it ends at one."""
    for name in path.split("."):
        if thing is not None:
            thing = thing[int(name)] if name.isdigit() else getattr(thing, name)
    return thing


def format_rows(columns: Sequence[Column], things: Iterable[Any]) -> list[list[str]]:
    """Returns heads and rows of the columns that a person reads."""
    shown = [column for column in columns if column.show is not None]
    rows = [[column.format(thing) for column in shown] for thing in things]
    return [[column.short or column.head for column in shown], *rows]


def select_columns(columns: Sequence[Column], names: str) -> list[Column]:
    """Returns the columns of these heads, which stand between commas."""
    by_head = {column.head: column for column in columns}
    return [by_head[name] for name in names.split(", ")]


def align_columns(rows: Sequence[Sequence[str]], left: Sequence[int]) -> list[str]:
    """Returns columns as wide as what stands in them, two spaces between; numbers to the right."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return [
        "  ".join(
            f"{cell:<{width}}" if k in left else f"{cell:>{width}}"
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    ]


def _format_head(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _get_value(cell: Cell) -> str | float | None:
    return cell.text if isinstance(cell, MathCell) else cell


def _format_cell(cell: Cell) -> str:
    if isinstance(cell, MathCell):
        return cell.text
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if cell is None or (isinstance(cell, float) and not math.isfinite(cell)):
        return "-"
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def _format_formula(cell: Cell) -> str:
    """A cell as text, a formula between dollars."""
    return f"${cell.latex}$" if isinstance(cell, MathCell) else _format_cell(cell)


def label_values(values: Any, index: Any, columns: Sequence[str] | None = None) -> Any:
    """Returns numbers by name.

    A Series or DataFrame of pandas where that is installed, else bare ones.

    Args:
        values: (n,), or (n, m) with columns.
        index: (n,) names; or, by the name of each level, (n,) values.
        columns: (m,) names.

    Returns:
        Without pandas: {name: value} of a vector, {column: (n,) array} of a matrix, with the levels
        of the index before.
    """
    levels = index if isinstance(index, Mapping) else {}
    try:
        import pandas
    except ImportError:
        if columns is None:
            return dict(zip(index, values, strict=True))
        return {**levels, **{name: values[:, k] for k, name in enumerate(columns)}}
    if levels:
        index = pandas.MultiIndex.from_arrays(list(levels.values()), names=list(levels))
        index = index if len(levels) > 1 else index.get_level_values(0)
    if columns is None:
        return pandas.Series(values, index=index)
    return pandas.DataFrame(values, index=index, columns=list(columns))


# Relative errors of joints whose efforts have different units: N m and N are never one number.


WORDS = {"N m": "torque", "N": "force"}
"""What an effort is called, by its unit."""

Part = tuple[str, float, float]
"""Of one joint: unit of its effort, summed squared residual, summed squared measured effort."""


def pool_errors_by_unit(parts: Iterable[Part]) -> dict[str, float]:
    """Returns ||residual|| / ||effort|| over all joints of one unit, by unit.

    N m first, NaN without any.

    Args:
        parts: of the joints.
    """
    sums: dict[str, tuple[float, float]] = {}
    for unit, left, size in parts:
        before = sums.get(unit, (0.0, 0.0))
        sums[unit] = (before[0] + left, before[1] + size)
    return {
        unit: math.sqrt(left / size) if size > 0.0 else math.nan
        for unit, (left, size) in sorted(sums.items(), reverse=True)
    }


def format_errors_by_unit(errors: Mapping[str, float]) -> str:
    """Returns errors as text: "2.1 % of the torques (N m), 3 % of the forces (N)".

    Of one unit: "2.1 %".
    """
    if len(errors) == 1:
        return format_percent(next(iter(errors.values())))
    return ", ".join(
        f"{format_percent(e)} of the {WORDS[unit]}s ({unit})" for unit, e in errors.items()
    )


POOLED = (
    "relative_error pools all rows as numbers, N m and N alike: ||measured - predicted|| / "
    "||measured||; by_unit holds one error per unit"
)
"""How the pooled error of a robot with both units comes about."""


DIGITS = 4
"""Most significant digits of an error that is printed: what does not differ in them is the same."""


def format_joints(names: Sequence[str]) -> str:
    """Returns "joint 3" or "joints 1 to 5, 7": three numbers in a row and more are a range."""
    runs = list[list[str]]()
    for name in names:
        last = runs[-1][-1] if runs else ""
        if name.isdigit() and last.isdigit() and int(name) == int(last) + 1:
            runs[-1].append(name)
        else:
            runs.append([name])
    parts = [f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(run) for run in runs]
    return f"joint{'s' * (len(names) > 1)} {', '.join(parts)}"


def format_percent(share: float | None, digits: int = 3) -> str:
    """Returns a share in percent, as in "3.41 %"; "-" where it is not known.

    What is less than a part in a million is 0: no measurement shows it.
    """
    if share is None or not math.isfinite(share):
        return "-"
    value = 100.0 * share if abs(share) >= 1e-6 else 0.0
    return f"{value:.{digits}g} %" if abs(value) < 10**digits - 0.5 else f"{value:.0f} %"


def format_error_pair(before: float, after: float) -> tuple[str, str]:
    """Returns two errors in percent, with a digit more where they are alike in three."""
    pair, finer = (
        (format_percent(before, digits), format_percent(after, digits)) for digits in (3, DIGITS)
    )
    return finer if pair[0] == pair[1] and finer[0] != finer[1] else pair
