"""`modeler demo` and `modeler reproduce PAPER`: the whole chain on built-in robots."""

import argparse
import enum
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeler import papers
from modeler.api.checks import compare_with_provenance
from modeler.api.fitting import fit
from modeler.api.workflow import compile_model, derive, generate, load, observe, read_logs
from modeler.cli.console import (
    draw_pictures,
    print_lines,
    print_result,
    show_activity,
    show_progress,
)
from modeler.cli.documents import ReproducedPaper, StoryReport
from modeler.cli.improve import format_waterfall
from modeler.core.errors import ModelerError
from modeler.core.table import align_columns
from modeler.diagnosis import Diagnosis, LogSplit, add_findings, diagnose, format_lines
from modeler.estimation import IdentifiedModel, save_model
from modeler.runtime import CompiledModel
from modeler.simulation import HiddenEffect, SimulationSettings, check_settings, simulate, write_log
from modeler.validation import write_verdict
from modeler.views import (
    build_comparison_page,
    build_diagnosis_page,
    build_history_page,
    draw_all_pictures,
    page as pages,
    write_files,
)

_RUNS = (("train", 1), ("held_out", 2))


@dataclass(frozen=True)
class Story:
    """A built-in robot, and what its simulated machine has that the robot file lacks."""

    robot: str
    hidden: HiddenEffect
    noise: float


_STORIES = (
    Story("demo-arm", HiddenEffect("load_friction", "2"), 0.01),
    Story("orthoglide-2003", HiddenEffect("passive_friction", "31", {"Fv": 0.3, "Fs": 1.0}), 0.005),
)


def run_demo(args: argparse.Namespace) -> dict[str, StoryReport]:
    """Runs the demonstrations of both built-in stories, and returns their results."""
    check_settings(SimulationSettings(duration=args.duration), ())  # before anything is written
    results = {
        story.robot: _run_story(story, Path(args.out) / story.robot, args) for story in _STORIES
    }
    if (index := pages.write_index(Path(args.out), "modeler demo")) is not None:
        print_result(f"all pages: {index}")
    return results


def _run_story(story: Story, out: Path, args: argparse.Namespace) -> StoryReport:
    robot = load(story.robot)
    print_result(f"{robot.title}\n{'=' * len(robot.title)}")
    print_result(f"1. derive and emit C into {out / 'c'}")
    with show_activity("deriving"):
        derivation = derive(robot)
        emitted = generate(derivation, out / "c", force=args.force)
        compiled = compile_model(emitted)
    kinds = ", ".join(f"{count} {kind}" for kind, count in derivation.base.count_by_kind().items())
    print_result(
        f"   {derivation.base.rank} base parameters ({kinds}), proof: {derivation.base.proof.kind}"
    )
    print_result(
        f"2. simulate two runs of {args.duration:g} s; the machine has something the file lacks"
    )
    for name, seed in _RUNS:
        settings = SimulationSettings(
            duration=args.duration, seed=seed, torque_noise=story.noise, hidden=(story.hidden,)
        )
        with show_progress(f"simulating {name}") as report:
            write_log(out / f"{name}.parquet", simulate(load(story.robot), settings, report))
    train, held_out = (out / f"{name}.parquet" for name, _ in _RUNS)
    print_result(f"3. fit to {train.name}, compare with {held_out.name}")
    with show_activity("fitting"):
        model = fit(derivation, emitted, observe(compiled, [train]))
    save_model(out / "model.json", model)
    _compare_and_draw(model, compiled, out, held_out)
    print_result("4. diagnose: which effect is missing?")
    logs = LogSplit(read_logs(compiled, [train]), read_logs(compiled, [held_out]))
    with show_progress("looking for missing effects") as bar:
        diagnosis = diagnose(model, compiled, logs.training, logs.held_out, progress=bar)
    print_lines(format_lines(diagnosis), "   ")
    place = str(out / "model.json")
    following = pages.suggest_after_diagnosis(place, [str(train)], [str(held_out)], diagnosis)
    origin = pages.Origin(place, [train.name, held_out.name], True, following)
    pages.write_page(out / "diagnosis.html", build_diagnosis_page(diagnosis, (), origin))
    better = _improve_model(model, compiled, diagnosis, logs, out)
    print_result(f"   the truth: {story.hidden.effect} on joint {story.hidden.joint}\n")
    print_result(f"open {out / 'diagnosis.html'} and {out / 'improved.html'} in a browser\n")
    return StoryReport(diagnosis, better.history)


def _compare_and_draw(
    model: IdentifiedModel, compiled: CompiledModel, out: Path, log: Path
) -> None:
    with show_activity("predicting"):
        run = compare_with_provenance(model, [str(log)])
    comparison = run.comparison
    print_lines([*comparison.summary().splitlines(), *write_verdict(comparison)], "   ")
    with show_activity("drawing the page"):
        place, fitted = str(out / "model.json"), [str(out / "train.parquet")]
        following = pages.suggest_after_compare(place, fitted, [str(log)], held_out=True)
        origin = pages.Origin(place, comparison.prediction.logs, True, [following])
        pages.write_page(out / "compare.html", build_comparison_page(comparison, run.lines, origin))
    with show_progress("drawing pictures") as bar:
        write_files(out / "pictures", draw_all_pictures(comparison), bar)


def _improve_model(
    model: IdentifiedModel, compiled: CompiledModel, diagnosis: Diagnosis, logs: LogSplit, out: Path
) -> IdentifiedModel:
    print_result("5. add it: new robot file, new C, new fit")
    with show_activity("adding what is missing"):
        better, left_out = add_findings(model, compiled, diagnosis.effects, logs)
    save_model(out / "improved.json", better)
    print_lines([*format_waterfall(better), *left_out], "   ")
    if better.history:
        held_out = better.history[-1].held_out_logs
        place, train = str(out / "improved.json"), str(out / "train.parquet")
        others = [str(out / name) for name in held_out]
        origin = pages.Origin(
            place, held_out, True, pages.suggest_after_add(place, [train], others, better.fit)
        )
        pages.write_page(out / "improved.html", build_history_page(better, left_out, origin))
    return better


METHODS: dict[str, Callable[[papers.Paper, Callable[[float], None]], list[papers.MethodTable]]] = {
    "briot-2012": papers.reproduce_briot,
    "guegan-2003": papers.reproduce_guegan,
    "hanssen-2000": papers.reproduce_hanssen,
    "houda": papers.reproduce_houda,
}
"""Of a paper's identification, run again in simulation."""


def run_reproduce(args: argparse.Namespace) -> ReproducedPaper:
    """Prints the lines; raises if one is different."""
    paper = papers.read_paper(args.paper)
    if args.picture is not None and args.section == "print":
        raise ModelerError("--picture: figures are of the methods; leave out --section print")
    print_result(paper.title)
    args.after, args.different = check_reproduced, []
    result: ReproducedPaper = {"paper": paper.name}
    if args.section != "methods":
        lines = _check_lines(paper)
        args.different += [
            line.printed_text for line in lines if line.verdict is papers.LineVerdict.DIFFERENT
        ]
        result["lines"] = lines
    if args.section != "print":
        tables = _run_methods(paper)
        args.different += _collect_failed(tables)
        result["methods"] = tables
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
            print_result(f"  [{line.verdict.value}] {line.place}: {line.reason}")
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
        print_result(f"  [{line.verdict.value}{slip}] {line.place}: {line.printed_text}")
        if line.verdict in (papers.LineVerdict.MEASURED, papers.LineVerdict.CONSISTENT):
            print_result(f"      must hold: {line.derived_text}")
        if line.verdict in (papers.LineVerdict.MISPRINT, papers.LineVerdict.DIFFERENT):
            print_result(f"      derived: {line.derived_text}")
            if line.correction:
                print_result(f"      corrected, which holds: {line.correction}")
        if line.reason:
            print_result(f"      {line.reason}")


def _run_methods(paper: papers.Paper) -> list[papers.MethodTable]:
    with show_progress(f"simulating the experiment of {paper.name}") as report:
        tables = METHODS[paper.name](paper, report)
    for table in tables:
        print_lines(["", table.title])
        print_lines(table.settings, "  ")
        cells = [(row.quantity, row.printed_value, row.computed_value) for row in table.rows]
        head, *texts = align_columns([("", "printed", "ours"), *cells], (0, 1, 2))
        print_result(f"  {head.rstrip()}")
        for row, text in zip(table.rows, texts, strict=True):
            print_result(
                f"  {text}  [{row.outcome.value}]" + (f" {row.reason}" if row.reason else "")
            )
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
        f"{table.title}: {row.quantity}"
        for table in tables
        for row in table.rows
        if row.outcome is papers.Outcome.FAILED
    ]
