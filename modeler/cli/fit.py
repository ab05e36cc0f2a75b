"""`modeler fit ROBOT LOG... --out MODEL`; with several methods: all of them on the same logs."""

import argparse
import dataclasses
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import modeler.api.fitting as fitting
from modeler.api.checks import observe_held_out, select_methods
from modeler.api.log_maps import resolve_mapping
from modeler.api.workflow import build_processing, compile_robot
from modeler.cli.console import (
    Json,
    draw_page,
    draw_pictures,
    print_lines,
    print_note,
    print_result,
    show_activity,
    show_next,
    show_progress,
)
from modeler.cli.lists import apply_stated_options, resolve_robot
from modeler.cli.parser import ALL, Methods
from modeler.core.choices import ABOUT, GAIN_METHOD
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.fit_options import FitOptions
from modeler.core.jobs import Workers, open_workers
from modeler.core.table import align_columns
from modeler.estimation import OF_TRIANGLES, IdentifiedModel, compare_methods, save_model
from modeler.formats import read_robot
from modeler.regression import Log, Observation, Processing, check_no_overlap
from modeler.robot import replace_fitted_values
from modeler.views import (
    build_estimators_page,
    collect_remarks,
    suggest_after_fit,
    tabulate_estimates,
    tabulate_estimators,
)


def run_fit(args: argparse.Namespace) -> Json:
    """Fits the logs, prints the table, saves the model."""
    apply_stated_options(args, "fit", read_robot(args.robot).fit)
    method = Methods(args.method)
    _check_files(args, method)
    processing = build_processing(vars(args))
    if method.is_several:
        return _compare_methods(args, processing)
    load = fitting.Load(args.payload_log, args.payload_mass, args.payload_link, args.payload_moved)
    options = FitOptions.from_names(vars(args))
    fitting.check_options(options, load)
    cluster = _open_cluster(args, options)
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        compiled_robot = compile_robot(robot)
    with show_activity("looking at the logs"):
        mapping, table = resolve_mapping(compiled_robot.compiled, args.logs, args.map)
    model, observation, outcome, _ = fitting.fit_logs(
        *(options, compiled_robot, args.logs, load, processing, mapping),
        lambda logs, loaded: _check_log_names(args, logs, loaded),
        fitting.Reporter(show_activity, show_progress, print_note, cluster),
    )
    return _write_model(args, table, model, observation, outcome.lines) | outcome.further


_OF_ONE = ("out", "robot_out", "payload_log", "window", "essential_below", "dask")


def _check_files(args: argparse.Namespace, method: Methods) -> None:
    """Raises an error for files and options that the method, or several, have no use for."""
    unused = [name for name in _OF_ONE if getattr(args, name)] + ["model"] * (
        args.model != "torque"
    )
    consistent = [id for id, about in ABOUT.items() if about.is_consistent]
    refusals = {
        f"--{unused[0].replace('_', '-') if unused else ''}: got it with --method {method}, which "
        "compares methods and writes no model; leave it out, or choose one method": (
            method.is_several and bool(unused)
        ),
        f"--holdout: got it with --method {method}; errors on other logs are shown of several "
        f"methods, as in --method {ALL}, and of a model by `modeler compare`": (
            not method.is_several and bool(args.holdout)
        ),
        f"--robot-out: --method {method} ends in base parameters; use --method consistent, which "
        f"ends in all standard parameters, or {GAIN_METHOD}, which finds drive gains": (
            args.robot_out is not None and method not in (*consistent, GAIN_METHOD)
        ),
    }
    for why, refused in refusals.items():
        if refused:
            raise DataError(why)


def _check_log_names(args: argparse.Namespace, logs: Sequence[Log], loaded: Sequence[Log]) -> None:
    check_no_overlap([*logs, *loaded], places=[*args.logs, *args.payload_log])
    places = {log.name: place for place, log in zip(args.logs, logs, strict=True)}
    for place, log in zip(args.payload_log, loaded, strict=True):
        if log.name in places:
            raise DataError(
                f"{place}: carries the load, and {places[log.name]} has the same file name; "
                "rename one, loads are assigned by name"
            )


def _open_cluster(
    args: argparse.Namespace, options: FitOptions
) -> AbstractContextManager[Workers] | None:
    """Opens the workers of `--dask`; None without.

    Raises:
        DataError: the fit needs all rows in one memory.
    """
    if args.dask is None:
        return None
    if why := fitting.describe_whole_fit(options, args.payload_log):
        raise DataError(
            f"--dask {args.dask}: got {why}, which needs all rows in one memory; expected --method "
            f"{' or '.join(OF_TRIANGLES)} of the torque model; leave --dask out"
        )
    return open_workers(args.dask)


def _write_model(
    args: argparse.Namespace,
    mapping: Mapping[str, Any],
    model: IdentifiedModel,
    observation: Observation,
    lines: Sequence[str] = (),
) -> Json:
    """Saves and prints the model, which keeps the mapping."""
    model = dataclasses.replace(model, mapping=mapping)
    save_model(args.out, model)
    *result_lines, verdict = model.fit.format_lines()
    print_lines([*observation.report.format_lines(), "", *lines, *result_lines])
    print_result(f"written: {args.out}")
    if args.report is not None or args.picture is not None:
        from modeler.views import build_fit_page  # pages take long to load

        following = suggest_after_fit(args.out, args.logs, args.robot, model.fit, args.map)
        page = build_fit_page(model, observation.report.format_lines(), args.out, following)
        draw_page(args.report, lambda: page)
        draw_pictures(args.picture, page.collect_pictures)
    if args.robot_out is not None:
        text = replace_fitted_values(model.robot_text, model.fit.standard)
        write_atomically(Path(args.robot_out), text)
        print_result(f"written: {args.robot_out}")
    print_result(verdict)
    logs = [*args.logs, *args.payload_log]
    show_next(suggest_after_fit(args.out, logs, args.robot, model.fit, args.map))
    return model.fit.to_json()


# Several methods on the same logs.


def _compare_methods(args: argparse.Namespace, processing: Processing) -> Json:
    """Prints what each estimator makes of the logs; writes no model."""
    methods = select_methods(None if args.method == ALL else args.method.split(","))
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        compiled = compile_robot(robot).compiled
    with show_activity("building the observation matrix"):
        observation, held_out = observe_held_out(
            compiled, args.logs, args.holdout, args.map, processing
        )
    with show_progress("fitting") as bar:
        tried = compare_methods(observation, compiled, held_out, methods, bar)
    lines = tuple(observation.report.format_lines())
    tables = (
        align_columns(table, (0,))
        for table in (tabulate_estimators(tried), tabulate_estimates(tried))
    )
    print_lines([*lines, *(row.rstrip() for table in tables for row in ("", *table)), ""])
    print_lines(f"{method}: {remark}" for method, remark in collect_remarks(tried))
    if args.report is not None or args.picture is not None:
        page = build_estimators_page(args.robot, tried, lines)
        draw_page(args.report, lambda: page)
        draw_pictures(args.picture, page.collect_pictures)
    return {
        "training": list(args.logs),
        "holdout": list(args.holdout),
        "methods": [trial.to_json() for trial in tried],
    }
