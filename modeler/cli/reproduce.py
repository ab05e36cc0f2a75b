"""`modeler reproduce PAPER`: a paper's results beside the derived ones, its methods run again."""

import argparse
import enum
from collections.abc import Callable, Sequence
from dataclasses import asdict

from modeler import papers
from modeler.cli.console import (
    Json,
    draw_pictures,
    print_lines,
    print_result,
    show_activity,
    show_progress,
)
from modeler.core.errors import ModelerError
from modeler.core.table import align_columns

METHODS: dict[str, Callable[[papers.Paper, Callable[[float], None]], list[papers.MethodTable]]] = {
    "briot-2012": papers.reproduce_briot,
    "guegan-2003": papers.reproduce_guegan,
    "hanssen-2000": papers.reproduce_hanssen,
    "houda": papers.reproduce_houda,
}
"""Of a paper's identification, run again in simulation."""


def run_reproduce(args: argparse.Namespace) -> Json:
    """Prints the lines; raises if one is different."""
    paper = papers.read_paper(args.paper)
    if args.picture is not None and args.section == "print":
        raise ModelerError("--picture: figures are of the methods; leave out --section print")
    print_result(paper.title)
    args.after, args.different = check_reproduced, []
    result: dict[str, object] = {"paper": paper.name}
    if args.section != "methods":
        lines = _check_lines(paper)
        args.different += [
            line.printed for line in lines if line.verdict is papers.LineVerdict.DIFFERENT
        ]
        result["lines"] = [asdict(line) | {"verdict": line.verdict.value} for line in lines]
    if args.section != "print":
        tables = _run_methods(paper)
        args.different += _collect_failed(tables)
        result["methods"] = [_convert_table(table) for table in tables]
        pictures = [table.picture for table in tables if table.picture is not None]
        if args.picture is not None and not pictures:
            raise ModelerError(f"--picture: {paper.name} has no figure to draw; leave it out")
        draw_pictures(args.picture, lambda: pictures)
    return result


def check_reproduced(args: argparse.Namespace) -> None:
    """Raises an error if a line differs from the paper.

    Raises:
        ModelerError: names the lines.
    """
    if args.different:
        count = len(args.different)
        raise ModelerError(
            f"{args.paper}: {count} line{'s are' if count > 1 else ' is'} different: "
            + "; ".join(args.different)
        )


def _check_lines(paper: papers.Paper) -> list[papers.CheckedLine]:
    derived_robots: dict[str, papers.DerivedRobot] = {}
    for name in paper.robots:
        with show_activity(f"deriving {name}"):
            derived_robots[name] = papers.derive_robot(name, paper.variants.get(name))
    lines = papers.check_paper(paper, derived_robots)
    for name in paper.robots:
        _print_robot(name, derived_robots[name], [line for line in lines if line.robot == name])
    print_result()
    for line in lines:
        if line.verdict is papers.LineVerdict.UNCHECKED:
            print_result(f"  [{line.verdict.value}] {line.place}: {line.why}")
    print_result()
    print_result(_count_outcomes([line.verdict for line in lines]))
    return lines


def _print_robot(
    name: str, derived: papers.DerivedRobot, lines: Sequence[papers.CheckedLine]
) -> None:
    print_result()
    print_result(f"{name}: {derived.robot.title}")
    for line in lines:
        slip = f": {papers.SLIPS[line.slip]}" if line.verdict is papers.LineVerdict.MISPRINT else ""
        print_result(f"  [{line.verdict.value}{slip}] {line.place}: {line.printed}")
        if line.verdict in (papers.LineVerdict.MEASURED, papers.LineVerdict.CONSISTENT):
            print_result(f"      must hold: {line.derived}")
        if line.verdict in (papers.LineVerdict.MISPRINT, papers.LineVerdict.DIFFERENT):
            print_result(f"      derived: {line.derived}")
            if line.corrected:
                print_result(f"      corrected, which holds: {line.corrected}")
        if line.why:
            print_result(f"      {line.why}")


def _run_methods(paper: papers.Paper) -> list[papers.MethodTable]:
    with show_progress(f"simulating the experiment of {paper.name}") as report:
        tables = METHODS[paper.name](paper, report)
    for table in tables:
        print_lines(["", table.title])
        print_lines(table.setting, "  ")
        cells = [(row.what, row.printed, row.ours) for row in table.rows]
        head, *texts = align_columns([("", "printed", "ours"), *cells], (0, 1, 2))
        print_result(f"  {head.rstrip()}")
        for row, text in zip(table.rows, texts, strict=True):
            print_result(f"  {text}  [{row.outcome.value}]" + (f" {row.why}" if row.why else ""))
    print_result()
    print_result(
        f"methods: {_count_outcomes([row.outcome for table in tables for row in table.rows])}"
    )
    return tables


def _count_outcomes(outcomes: Sequence[enum.Enum]) -> str:
    counts = {kind: outcomes.count(kind) for kind in (type(outcomes[0]) if outcomes else ())}
    return ", ".join(f"{count} {kind.value}" for kind, count in counts.items() if count)


def _collect_failed(tables: Sequence[papers.MethodTable]) -> list[str]:
    return [
        f"{table.title}: {row.what}"
        for table in tables
        for row in table.rows
        if row.outcome is papers.Outcome.FAILED
    ]


def _convert_table(table: papers.MethodTable) -> dict[str, object]:
    rows = [asdict(row) | {"outcome": row.outcome.value} for row in table.rows]
    return {"title": table.title, "setting": list(table.setting), "rows": rows}
