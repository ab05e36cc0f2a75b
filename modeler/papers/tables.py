"""Geometry as a paper prints it: table, closure, tied joints, the matrix G of their speeds."""

import re
from collections.abc import Mapping

import sympy

from modeler.papers.compared import Compared, joined
from modeler.papers.derived import Derived
from modeler.papers.motion import sum_of, turned, without_squared_sines
from modeler.papers.naming import difference_of, renamer
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import (
    Amount,
    Monomial,
    QuotationError,
    Sum,
    read_sum,
    replaced,
    sum_text,
)
from modeler.robot import Joint

_COLUMNS = ("j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r")


def row_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """A row of the table, cells between bars, against the robot's; cell r is called `inr`."""
    leg = line.legs[0]
    cells = [cell.strip() for cell in line.text.split("|")]
    if len(cells) != len(_COLUMNS):
        raise QuotationError(f"{len(cells)} cells are quoted, a row has {len(_COLUMNS)}")
    cells[:2] = [cell.replace("i", leg) for cell in cells[:2]]
    rename = renamer(paper, line, leg)
    printed = joined({c: read_sum(x, rename) for c, x in zip(_COLUMNS, cells, strict=True)})
    found = next((j for j in robots[line.robot].robot.joints if j.name == cells[0]), None)
    if found is None:
        raise QuotationError(f"there is no row {cells[0]}")
    own = {column: read_sum(text, str) for column, text in _cells(found).items()}
    text = " | ".join(sum_text(part) for part in own.values())
    return Compared(printed, joined(own), text, difference_of(line))


def _cells(joint: Joint) -> dict[str, str]:
    values = {
        "j": joint.name, "a": joint.antecedent, "mu": str(int(joint.actuated)),
        "sigma": str(int(joint.kind)), "gamma": joint.gamma.text, "b": joint.b.text,
        "alpha": joint.alpha.text, "d": joint.d.text, "theta": joint.theta.text, "r": joint.r.text,
    }  # fmt: skip
    return {column: values[column] for column in _COLUMNS}


def tied_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`q4i = -q3i, q7i = q3i`: joints that follow others; `of` is a cut joint, which has no row."""
    rename = renamer(paper, line, line.legs[0])
    printed: dict[str, Sum] = {}
    pairs = r"(\w+) (\w+) \+ (\w+) (\w+)"  # (a, b) + (c, d) = 0
    for equation in re.sub(pairs, r"\3 = -\1, \4 = -\2", line.text).split(","):
        left, equal, right = equation.partition("=")
        if not equal:
            raise QuotationError(f'"{equation}" is no equation')
        name = rename(left.strip())
        if name in printed:
            raise QuotationError(f"{name} is given twice")
        printed[name] = read_sum(right, rename)
    tied = dict(robots[line.robot].tied)
    if line.of:
        left, _, right = line.of.partition("=")
        tied[rename(left.strip())] = replaced(read_sum(right, rename), tied)
    lost = set(printed) - set(tied)
    if lost:
        raise QuotationError(f"there is no joint variable {', '.join(sorted(lost))}")
    derived: dict[str, Sum] = {name: tied[name] for name in printed}
    text = ", ".join(f"{name} = {sum_text(part)}" for name, part in derived.items())
    return Compared(joined(printed), joined(derived), text, difference_of(line))


def closure_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """The place of frame `gives[0]`, where a leg meets the platform, derived from the table.

    `d4 cos q2i cos q3i + a deltai; ...; ...`: along the axes of the leg's first frame, with deltai
    1 for leg 3 and 0 for the others, bardelta 1 - delta, legs counted in a circle. Without `;`:
    for each leg an expression in x, y, z that is 0 at that place, `|` between them.
    """
    printed: dict[str, Sum] = {}
    derived: dict[str, Sum] = {}
    texts = line.text.split("|") if "|" in line.text else [line.text] * len(line.legs)
    if len(texts) != len(line.legs):
        raise QuotationError(f"{len(texts)} expressions are quoted for {len(line.legs)} legs")
    for leg, text in zip(line.legs, texts, strict=True):
        rename = renamer(paper, line, leg)
        text = _with_deltas(text, int(leg))
        turn, place = _placed(robots[line.robot], line.gives[0].replace("{i}", leg), f"1{leg}")
        if ";" in text:
            printed |= {f"{leg}x{k}": read_sum(x, rename) for k, x in enumerate(text.split(";"))}
            along = enumerate(turn.T * place)
            derived |= {f"{leg}x{k}": sum_of(without_squared_sines(x)) for k, x in along}
        else:
            put = {symbol.name: symbol for symbol in place.free_symbols}
            put |= dict(zip("xyz", place, strict=True))
            left = sympy.sympify(sum_text(read_sum(text, rename)).replace("^", "**"), put)
            printed[leg] = sum_of(without_squared_sines(left))
    told = "; ".join(sum_text(part) for part in (derived or printed).values())
    return Compared(joined(printed), joined(derived), told, difference_of(line))


def _with_deltas(text: str, leg: int) -> str:
    def number(found: re.Match[str]) -> str:
        third = (leg + int(found[2] or 0)) % 3 == 0
        return str(int(third != bool(found[1])))

    return re.sub(r"(bar)?deltai(?:\+(\d))?", number, text)


def _placed(derived: Derived, name: str, first: str) -> tuple[sympy.Matrix, sympy.Matrix]:
    """(rotation of the row `first`, place of the origin of the row `name`), both in frame 0."""
    geometry = derived.model.geometry
    names = [row.joint.name for row in geometry.rows]
    free = [sympy.Symbol(joint.variable) for joint in geometry.robot.free]
    rotation, place, wanted = sympy.eye(3), sympy.zeros(3, 1), sympy.eye(3)
    for k in reversed(geometry.ancestors(names.index(name))):
        row = geometry.rows[k]
        form = {} if row.index is None else geometry.forms[row.index]
        moved = row.rate * sum(
            sympy.Rational(v.numerator, v.denominator) * free[u] for u, v in form.items()
        )
        angle, slide = (moved, 0) if row.joint.angular else (0, moved)
        turn = turned(row, row.theta + angle)
        shift = sympy.Matrix([row.d * sympy.cos(row.gamma), row.d * sympy.sin(row.gamma), row.b])
        place += rotation * (shift + turn * sympy.Matrix([0, 0, row.r + slide]))
        rotation = rotation * turn
        wanted = rotation if row.joint.name == first else wanted
    return wanted, place


def platform_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`phip = diag(ddotx, ...)`: what the platform's mass is multiplied with, its force.

    Newton: m (acceleration - gravity), a column; entry 2 of a column is `in2`, entry (2, 2) of a
    matrix `in2x2`.
    """
    found = re.fullmatch(r"phip = (diag)?\((.*)\)", line.text)
    if found is None:
        raise QuotationError(f'"{line.text}" is no list of forces')
    cells = [read_sum(cell, str) for cell in found[2].split(",")]
    printed = joined({f"{k}x{k}" if found[1] else str(k): c for k, c in enumerate(cells, 1)})
    force = [
        sum_of(sympy.Symbol(f"ddot{axis}") - part)
        for axis, part in zip("xyz", robots[line.robot].model.geometry.gravity, strict=True)
    ]
    derived = joined({str(k): part for k, part in enumerate(force, 1)})
    text = f"the column ({', '.join(sum_text(part) for part in force)})"
    return Compared(printed, derived, text, difference_of(line))


def matrix_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """Rows of G^T, `1 0 0; 0 1 -1`: G = d(all joints of `gives[1]`) / d(those of `gives[0]`)."""
    tied = robots[line.robot].tied
    above, below = line.gives[1].split(), line.gives[0].split()
    derived = _entries([[_slope(tied[name], by) for name in above] for by in below])
    rows = [[read_sum(cell, str) for cell in row.split()] for row in line.text.split(";")]
    printed = joined({f"{i}x{j}": cell for i, row in enumerate(rows) for j, cell in enumerate(row)})
    text = "; ".join(
        " ".join(sum_text(_slope(tied[name], by)) for name in above) for by in below
    )  # fmt: skip
    return Compared(printed, derived, text, difference_of(line))


def _entries(rows: list[list[Sum]]) -> Sum:
    return joined({f"{i}x{j}": cell for i, row in enumerate(rows) for j, cell in enumerate(row)})


def _slope(whole: Sum, name: str) -> Sum:
    key: Monomial = ((name, 1),)
    found: dict[Monomial, Amount] = {(): whole[key]} if key in whole else {}
    return found
