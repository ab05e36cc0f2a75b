"""`modeler fit ROBOT LOG... --out MODEL`; with several methods: all of them on the same logs."""

import argparse
import dataclasses
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import modeler.api.fitting as fitting
from modeler.api.identifying import fit_logs
from modeler.api.log_maps import resolve_mapping
from modeler.api.long_logs import Reporter
from modeler.api.workflow import build_processing, compile_model, derive, generate
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
from modeler.cli.options import ALL, Methods
from modeler.core.choices import GAIN_METHOD
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.jobs import Workers, open_workers
from modeler.core.table import align_columns
from modeler.estimation import OF_TRIANGLES, IdentifiedModel, compare_methods, save_model
from modeler.regression import Log, Observation, Processing, check_no_overlap
from modeler.robot import read_robot, replace_fitted_values
from modeler.views import (
    build_estimators_page,
    collect_remarks,
    suggest_after_fit,
    tabulate_estimates,
    tabulate_estimators,
)


def run_fit(args: argparse.Namespace) -> Json:
    """Fits, prints the table, saves the model."""
    apply_stated_options(args, "fit", read_robot(args.robot).fit)
    args.method = Methods(args.method)
    _check_options(args)
    processing = build_processing(vars(args))
    if args.method.is_several:
        return _compare_methods(args, processing)
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        derivation = derive(robot)
        emitted = generate(derivation)
        compiled = compile_model(emitted)
    with show_activity("looking at the logs"):
        mapping, stored_mapping = resolve_mapping(compiled, args.logs, args.map)
    load = fitting.Load(args.payload_log, args.payload_mass, args.payload_link, args.payload_moved)
    energy, below = args.model == "energy", args.essential_below
    request = fitting.FitRequest(args.method, energy, args.window, (), below)
    model, observation, outcome, _ = fit_logs(
        request, derivation, emitted, compiled, args.logs, load, processing, mapping,
        lambda logs, loaded: _check_log_names(args, logs, loaded),
        Reporter(show_activity, show_progress, print_note, _open_cluster(args)),
    )  # fmt: skip
    return _write_model(args, stored_mapping, model, observation, outcome.lines) | outcome.further


def _check_options(args: argparse.Namespace) -> None:
    """Refuses options that do not go together."""
    for option in ("payload_mass", "payload_link", "payload_moved"):
        value = getattr(args, option)
        if value is not None and value is not False and not args.payload_log:  # 0 is given too
            flag = "--" + option.replace("_", "-")
            raise DataError(f"{flag}: no loaded log; name it with --payload-log LOG")
    _check_several(args)
    method, energy, gains = args.method, args.model == "energy", args.method == GAIN_METHOD
    refusals = (
        (args.payload_log and method in fitting.WITHOUT_LOADS,
         f"--payload-log: got it with --method {method}, which knows no loads; expected --method "
         "weighted, ordinary, robust, ridge or tls"),
        (gains and args.essential_below is not None,
         f"--essential-below: got it with --method {GAIN_METHOD}; leave it out"),
        (not energy and args.window is not None,
         "--window: only windows of --model energy have a length; add that option"),
        (energy and method not in fitting.OF_WINDOWS,
         f"--method {method}: got it with --model energy, whose rows are windows; expected "
         "--method weighted or ordinary"),
        (energy and args.payload_log,
         "--payload-log: the energy model takes logs without load; leave out --model energy"),
        (args.robot_out is not None and method not in (*fitting.BUILDABLE, GAIN_METHOD),
         f"--robot-out: --method {method} ends in base parameters, of which many machines have "
         "the same; use --method consistent, which ends in all standard parameters, or "
         f"{GAIN_METHOD}, which finds drive gains"),
        (gains and not args.payload_log,
         "--method tls: no loaded log; the gains of drives show in what a load of known mass adds "
         "to their currents; add --payload-log LOG --payload-mass KG"),
        (gains and args.payload_mass is None,
         "--method tls: no --payload-mass; without a known mass all gains and all parameters may "
         "be larger by one factor; weigh the load and give its mass in kg"),
    )  # fmt: skip
    for refused, why in refusals:
        if refused:
            raise DataError(why)


_OF_ONE = ("out", "robot_out", "payload_log", "window", "essential_below", "dask")


def _check_several(args: argparse.Namespace) -> None:
    """Several methods are compared on the rows of the torque model; one has no use for others."""
    if not args.method.is_several:
        if args.holdout:
            raise DataError(
                f"--holdout: got it with --method {args.method}; errors on other logs are shown of "
                f"several methods, as in --method {ALL}, and of a model by `modeler compare`"
            )
        return
    unused_options = [name for name in _OF_ONE if getattr(args, name)]
    unused_options += ["model"] * (args.model != "torque")
    if unused_options:
        raise DataError(
            f"--{unused_options[0].replace('_', '-')}: got it with --method {args.method}, which "
            "compares "
            "methods and writes no model; leave it out, or choose one method"
        )


def _check_log_names(args: argparse.Namespace, logs: Sequence[Log], loaded: Sequence[Log]) -> None:
    check_no_overlap([*logs, *loaded], places=[*args.logs, *args.payload_log])
    places = {log.name: place for place, log in zip(args.logs, logs, strict=True)}
    for place, log in zip(args.payload_log, loaded, strict=True):
        if log.name in places:
            raise DataError(
                f"{place}: carries the load, and {places[log.name]} has the same file name; "
                "rename one, loads are assigned by name"
            )


def _open_cluster(args: argparse.Namespace) -> AbstractContextManager[Workers] | None:
    """Of `--dask`; None without.

    Raises:
        DataError: the fit needs all rows in one memory.
    """
    if args.dask is None:
        return None
    why = (
        "--payload-log" if args.payload_log
        else "--essential-below" if args.essential_below is not None
        else "--model energy" if args.model == "energy"
        else f"--method {args.method}" if args.method not in OF_TRIANGLES
        else ""
    )  # fmt: skip
    if why:
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
    methods = fitting.select_methods(None if args.method == ALL else args.method.split(","))
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        compiled = compile_model(generate(derive(robot)))
    with show_activity("building the observation matrix"):
        observation, held_out = fitting.observe_held_out(
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
