"""`modeler reproduce PAPER`: a paper's results beside the derived ones."""

import argparse
from dataclasses import asdict

from modeler.cli.console import Json, say, working
from modeler.core.errors import ModelerError
from modeler.derivation import Derivation, derive, load
from modeler.papers import Line, Paper, Verdict, check_paper, read_paper
from modeler.papers.check import Derived
from modeler.papers.coefficients import coefficient_lines


def run_reproduce(args: argparse.Namespace) -> Json:
    """Prints the lines; raises if one is different."""
    paper = read_paper(args.paper)
    found: dict[str, Derivation] = {}
    for name in paper.robots:
        with working(f"deriving {name}"):
            found[name] = derive(load(name))
    lines = check_paper(
        paper, {n: Derived(d.base, d.model.geometry.values) for n, d in found.items()}
    )
    for name in paper.coefficients:
        derivation = found[name]
        lines += coefficient_lines(derivation.model, derivation.base, paper.misprints)
    _print(paper, found, lines)
    args.after = after_reproduce
    args.different = [line for line in lines if line.verdict is Verdict.DIFFERENT]
    return {
        "paper": paper.name,
        "lines": [asdict(line) | {"verdict": line.verdict.value} for line in lines],
        "notes": list(paper.notes),
    }


def after_reproduce(args: argparse.Namespace) -> None:
    """Ends with status 1 if a line is different.

    Raises:
        ModelerError: names the lines.
    """
    if args.different:
        raise ModelerError(
            f"{args.paper}: {len(args.different)} lines are different: "
            + "; ".join(line.printed for line in args.different)
        )


def _print(paper: Paper, found: dict[str, Derivation], lines: list[Line]) -> None:
    say(paper.title)
    for name in paper.robots:
        base = found[name].base
        say()
        say(f"{name}: {found[name].robot.title}")
        say(f"  {len(base.columns)} standard parameters, {base.rank} base parameters")
        for line in (line for line in lines if line.robot == name):
            say(f"  [{line.verdict.value}] {line.place}: {line.printed}")
            if line.verdict not in (Verdict.EQUAL, Verdict.ROUNDED):
                say(f"      derived: {line.derived}")
            if line.why:
                say(f"      {line.why}")
    if paper.notes:
        say()
        say("Other slips of the print:")
    for note in paper.notes:
        say(f"  * {note}")
    say()
    counts = {v: sum(line.verdict is v for line in lines) for v in Verdict}
    say(", ".join(f"{count} {verdict.value}" for verdict, count in counts.items() if count))
