"""The page of a derivation: table, base parameters with their relations typeset, proof."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeler.core.formula import Formula
from modeler.pages.sheet import (
    Block,
    Cell,
    Formulas,
    Lead,
    Origin,
    Section,
    Sheet,
    Table,
    write_page,
)
from modeler.robot import Robot
from modeler.show.table import table_head, table_rows


@dataclass(frozen=True)
class Derived:
    """What a derivation says, without its symbols.

    Attributes:
        relations: the formula of each base parameter in pieces, and its unit.
        standard: number of standard parameters.
        counts: of base parameters by the kind of their column.
        unidentifiable: names of parameters without effect.
        tied: how joints move each other, in lines.
        proof: kind of proof, and its lines.
    """

    relations: Sequence[tuple[Sequence[Formula], str]]
    standard: int
    counts: Mapping[str, int]
    unidentifiable: Sequence[str]
    tied: Sequence[str]
    proof: tuple[str, Sequence[str]]


def write_derivation(path: Path, robot: Robot, derived: Derived, given: str) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `derive.html`.
        robot: as it was derived.
        derived: what was found.
        given: file or name that the robot was read from.

    Raises:
        ModelerError: the place cannot be written.
    """
    kind, lines = derived.proof
    counts = ", ".join(f"{n} {what}" for what, n in derived.counts.items() if n)
    none = ", ".join(derived.unidentifiable) or "none"
    sheet = Sheet(
        title=f"{robot.name}: {robot.title}" if robot.title else robot.name,
        headline=(
            str(len(derived.relations)),
            f"base parameters of {derived.standard} standard parameters; proof: {kind}",
        ),
        sections=[
            Section("Table", _table(robot, derived.tied)),
            Section("Base parameters", [Formulas(derived.relations)]),
            Section("Parameters without effect", [Lead(f"{none}.")]),
            Section("Proof", [Lead(line) for line in lines]),
        ],
        origin=Origin(given),
        facts=[("Base parameters", counts), ("Without effect", f"{len(derived.unidentifiable)}")],
        next=[f"modeler generate {given} --out {robot.name}_c"],
        command="derive",
    )
    return write_page(path, sheet, "derive.html")


def _table(robot: Robot, tied: Sequence[str]) -> list[Block]:
    head = [Cell(text) for text in table_head(robot)[:-1]]
    rows = [
        [Cell(text) for text in (*row.cells, *(text for _, text in row.entries))]
        for row in table_rows(robot)
    ]
    note = (
        "Lengths in m, angles in rad. \u03bc 1: actuated. \u03c3 0 revolute, 1 prismatic, 2 fixed."
    )
    blocks: list[Block] = [Table(head, rows, note)]
    return blocks + [Lead(line) for line in tied]
