"""Geometry as a paper prints it: rows of its table, tied joints, the matrix G of their speeds."""

from collections.abc import Mapping

from modeler.papers.compared import Compared, joined
from modeler.papers.derived import Derived
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
    for equation in line.text.split(","):
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
