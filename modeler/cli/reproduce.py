"""`modeler reproduce PAPER`: a paper's results beside the derived ones, its methods run again."""

import argparse
import enum
from collections.abc import Callable, Sequence
from dataclasses import asdict

from modeler import papers
from modeler.cli.console import Json, draw_pictures, progress, say, say_lines, working
from modeler.core.errors import ModelerError
from modeler.core.table import aligned

METHODS: dict[str, Callable[[papers.Paper, Callable[[float], None]], list[papers.MethodTable]]] = {
    "briot-2012": papers.briot_methods,
    "guegan-2003": papers.guegan_methods,
    "hanssen-2000": papers.hanssen_methods,
    "houda": papers.houda_methods,
}
"""Of a paper's identification, run again in simulation."""


def run_reproduce(args: argparse.Namespace) -> Json:
    """Prints the lines; raises if one is different."""
    paper = papers.read_paper(args.paper)
    if args.picture is not None and args.section == "print":
        raise ModelerError("--picture: figures are of the methods; leave out --section print")
    say(paper.title)
    args.after, args.different = after_reproduce, []
    found: dict[str, object] = {"paper": paper.name}
    if args.section != "methods":
        lines = _lines(paper)
        args.different += [
            line.printed for line in lines if line.verdict is papers.LineVerdict.DIFFERENT
        ]
        found["lines"] = [asdict(line) | {"verdict": line.verdict.value} for line in lines]
    if args.section != "print":
        tables = _methods(paper)
        args.different += _failed(tables)
        found["methods"] = [_table_json(table) for table in tables]
        drawn = [table.picture for table in tables if table.picture is not None]
        if args.picture is not None and not drawn:
            raise ModelerError(f"--picture: {paper.name} has no figure to draw; leave it out")
        draw_pictures(args.picture, lambda: drawn)
    return found


def after_reproduce(args: argparse.Namespace) -> None:
    """Ends with status 1 if a line is different.

    Raises:
        ModelerError: names the lines.
    """
    if args.different:
        count = len(args.different)
        raise ModelerError(
            f"{args.paper}: {count} line{'s are' if count > 1 else ' is'} different: "
            + "; ".join(args.different)
        )


def _lines(paper: papers.Paper) -> list[papers.Line]:
    found: dict[str, papers.DerivedPaper] = {}
    for name in paper.robots:
        with working(f"deriving {name}"):
            found[name] = papers.derived_robot(name, paper.variants.get(name))
    lines = papers.check_paper(paper, found)
    for name in paper.robots:
        _print_robot(name, found[name], [line for line in lines if line.robot == name])
    say()
    for line in lines:
        if line.verdict is papers.LineVerdict.UNCHECKED:
            say(f"  [{line.verdict.value}] {line.place}: {line.why}")
    say()
    say(_counted([line.verdict for line in lines]))
    return lines


def _print_robot(name: str, derived: papers.DerivedPaper, lines: Sequence[papers.Line]) -> None:
    say()
    say(f"{name}: {derived.robot.title}")
    for line in lines:
        slip = f": {papers.SLIPS[line.slip]}" if line.verdict is papers.LineVerdict.MISPRINT else ""
        say(f"  [{line.verdict.value}{slip}] {line.place}: {line.printed}")
        if line.verdict in (papers.LineVerdict.MEASURED, papers.LineVerdict.CONSISTENT):
            say(f"      must hold: {line.derived}")
        if line.verdict in (papers.LineVerdict.MISPRINT, papers.LineVerdict.DIFFERENT):
            say(f"      derived: {line.derived}")
            if line.corrected:
                say(f"      corrected, which holds: {line.corrected}")
        if line.why:
            say(f"      {line.why}")


def _methods(paper: papers.Paper) -> list[papers.MethodTable]:
    with progress(f"simulating the experiment of {paper.name}") as report:
        tables = METHODS[paper.name](paper, report)
    for table in tables:
        say_lines(["", table.title])
        say_lines(table.setting, "  ")
        cells = [(row.what, row.printed, row.ours) for row in table.rows]
        head, *texts = aligned([("", "printed", "ours"), *cells], (0, 1, 2))
        say(f"  {head.rstrip()}")
        for row, text in zip(table.rows, texts, strict=True):
            say(f"  {text}  [{row.outcome.value}]" + (f" {row.why}" if row.why else ""))
    say()
    say(f"methods: {_counted([row.outcome for table in tables for row in table.rows])}")
    return tables


def _counted(found: Sequence[enum.Enum]) -> str:
    counts = {kind: found.count(kind) for kind in (type(found[0]) if found else ())}
    return ", ".join(f"{count} {kind.value}" for kind, count in counts.items() if count)


def _failed(tables: Sequence[papers.MethodTable]) -> list[str]:
    return [
        f"{table.title}: {row.what}"
        for table in tables
        for row in table.rows
        if row.outcome is papers.Outcome.FAILED
    ]


def _table_json(table: papers.MethodTable) -> dict[str, object]:
    rows = [asdict(row) | {"outcome": row.outcome.value} for row in table.rows]
    return {"title": table.title, "setting": list(table.setting), "rows": rows}
