"""`modeler estimators`: the list of them, or all of them on the same logs."""

import argparse
from pathlib import Path

from modeler.api.fitting import chosen_methods, observed_apart
from modeler.api.workflow import compile_model, derive, generate
from modeler.cli.console import Json, progress, say, working
from modeler.cli.lists import robot_of
from modeler.core.errors import DataError, Method
from modeler.core.estimators import ABOUT
from modeler.core.table import aligned
from modeler.estimation.side_by_side import Tried, side_by_side
from modeler.report.estimators import remarks_of, table_of, values_of, write_estimators


def run_estimators(args: argparse.Namespace) -> Json:
    """Prints the list, or the comparison."""
    methods = _chosen(args.methods)
    if args.robot is None:
        return _listed(methods)
    if not args.logs:
        raise DataError(
            f"estimators: got robot {args.robot} and no log; expected logs to fit, as in "
            f"`modeler estimators {args.robot} run.parquet`"
        )
    tried, lines = _compared(args, methods)
    for line in (*lines, "", *_aligned(table_of(tried)), "", *_aligned(values_of(tried)), ""):
        say(line)
    for method, remark in remarks_of(tried):
        say(f"{method}: {remark}")
    if args.report is not None:
        with working("drawing the page"):
            place = write_estimators(Path(args.report), args.robot, tried, lines)
        say(f"written: {place}")
    return {
        "training": list(args.logs),
        "holdout": list(args.holdout),
        "methods": [own.to_json() for own in tried],
    }


def _compared(
    args: argparse.Namespace, methods: list[Method]
) -> tuple[tuple[Tried, ...], tuple[str, ...]]:
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        compiled = compile_model(generate(derive(robot)))
    with working("building the observation matrix"):
        observation, held = observed_apart(compiled, args.logs, args.holdout, args.map)
    with progress("fitting") as bar:
        tried = side_by_side(observation, compiled, held, methods, bar)
    return tried, tuple(observation.report.lines())


def _chosen(text: str | None) -> list[Method]:
    if text is None:
        return chosen_methods(None)
    names = [name.strip() for name in text.split(",") if name.strip()]
    return chosen_methods(names, "--methods")


def _listed(methods: list[Method]) -> Json:
    chosen = [ABOUT[method] for method in methods]
    for about in chosen:
        say(f"{about.id:<10} {about.title}")
        say(f"  law        {about.law}")
        say(f"  source     {about.source}")
        say(f"  not        {about.avoid}")
    return [
        {
            "method": about.id,
            "title": about.title,
            "law": about.law,
            "source": about.source,
            "avoid": about.avoid,
        }
        for about in chosen
    ]


def _aligned(rows: list[list[str]]) -> list[str]:
    return [line.rstrip() for line in aligned(rows, (0,))]
