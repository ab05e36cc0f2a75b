"""`modeler fit ROBOT LOG... --out MODEL`, by one method or several; `modeler fleet ROBOT LOG`."""

import argparse
import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler.api import checks, fitting
from modeler.api.log_maps import resolve_mapping
from modeler.api.workflow import build_processing, compile_robot
from modeler.cli.console import draw_result, print_lines, print_result, show_activity, show_next
from modeler.cli.documents import FitReport, MethodsReport
from modeler.cli.lists import build_reporter, read_options, resolve_robot
from modeler.cli.parser import ALL, Methods
from modeler.core.choices import ABOUT, GAIN_METHOD
from modeler.core.files import write_atomically
from modeler.core.options import FitOptions, OptionError
from modeler.core.table import align_columns
from modeler.estimation import FitResult, IdentifiedModel, save_model
from modeler.formats import read_robot
from modeler.regression import Observation, Processing
from modeler.robot import replace_fitted_values
from modeler.views import (
    Page,
    build_estimators_page,
    collect_remarks,
    suggest_after_fit,
    tabulate_estimates,
    tabulate_estimators,
)

if TYPE_CHECKING:
    from modeler.validation import Fleet


def run_fit(args: argparse.Namespace) -> FitReport | MethodsReport:
    """Fits the logs, prints the table, saves the model."""
    options = read_options(args, FitOptions, "fit", read_robot(args.robot).fit)
    method = Methods(options.method)
    _check_files(args, method, options.model)
    processing = build_processing(vars(options))
    if method.is_several:
        return _compare_methods(args, method, processing)
    load = fitting.Load(args.payload_log, args.payload_mass, args.payload_link, args.payload_moved)
    fitting.check_options(options, load)
    fitting.check_dask(options, load, args.dask)
    robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        compiled_robot = compile_robot(robot)
    with show_activity("looking at the logs"):
        mapping, table = resolve_mapping(compiled_robot.compiled, args.logs, args.mapping)
    model, observation, outcome, _ = fitting.fit_logs(
        *(options, compiled_robot, args.logs, load, processing, mapping),
        reporter=build_reporter(),
        dask=args.dask,
    )
    fit = _write_model(args, table, model, observation, outcome.lines)
    return FitReport(fit, outcome.further.get("two_step"))


_OF_ONE = ("out", "robot_out", "payload_log", "window", "essential_below", "dask")


def _check_files(args: argparse.Namespace, method: Methods, model: str) -> None:
    """Raises an error for files and options that the method, or several, have no use for."""
    unused = [name for name in _OF_ONE if getattr(args, name)] + ["model"] * (model != "torque")
    consistent = [id for id, about in ABOUT.items() if about.is_consistent]
    refusals = {
        f"{{--{unused[0] if unused else 'out'}}}: got it with {{--method}} {method}, which "
        "compares methods and writes no model; leave it out, or choose one method": (
            method.is_several and bool(unused)
        ),
        f"{{--holdout}}: got it with {{--method}} {method}; errors on other logs are shown of "
        f"several methods, as in {{--method}} {ALL}, and of a model by `modeler compare`": (
            not method.is_several and bool(args.holdout)
        ),
        f"{{--robot_out}}: {{--method}} {method} ends in base parameters; use {{--method}} "
        "consistent, which ends in all standard parameters, or "
        f"{GAIN_METHOD}, which finds drive gains": (
            args.robot_out is not None and method not in (*consistent, GAIN_METHOD)
        ),
    }
    for why, refused in refusals.items():
        if refused:
            raise OptionError(why)


def _write_model(
    args: argparse.Namespace,
    mapping: Mapping[str, Any],
    model: IdentifiedModel,
    observation: Observation,
    lines: Sequence[str] = (),
) -> FitResult:
    """Saves and prints the model, which keeps the mapping."""
    model = dataclasses.replace(model, mapping=mapping)
    save_model(args.out, model)
    *result_lines, verdict = model.fit.format_lines()
    print_lines([*observation.report.format_lines(), "", *lines, *result_lines])
    print_result(f"written: {args.out}")

    def build_page() -> Page:
        from modeler.views import build_fit_page  # pages take long to load

        following = suggest_after_fit(args.out, args.logs, args.robot, model.fit, args.mapping)
        return build_fit_page(model, observation.report.format_lines(), args.out, following)

    draw_result(args, build_page)
    if args.robot_out is not None:
        text = replace_fitted_values(model.robot_text, model.fit.standard)
        write_atomically(Path(args.robot_out), text)
        print_result(f"written: {args.robot_out}")
    print_result(verdict)
    logs = [*args.logs, *args.payload_log]
    show_next(suggest_after_fit(args.out, logs, args.robot, model.fit, args.mapping))
    return model.fit


# Several methods on the same logs.


def _compare_methods(
    args: argparse.Namespace, method: Methods, processing: Processing
) -> MethodsReport:
    """Prints what each estimator makes of the logs; writes no model."""
    result = checks.compare_methods(
        *(resolve_robot(args), args.logs, args.holdout),
        None if method == ALL else method.split(","),
        mapping=args.mapping,
        processing=processing,
        reporter=build_reporter(),
    )
    tried, lines = result.results, result.data
    tables = (
        align_columns(table, (0,))
        for table in (tabulate_estimators(tried), tabulate_estimates(tried))
    )
    print_lines([*lines, *(row.rstrip() for table in tables for row in ("", *table)), ""])
    print_lines(f"{name}: {remark}" for name, remark in collect_remarks(tried))
    draw_result(args, lambda: build_estimators_page(args.robot, tried, lines))
    return {"training": list(args.logs), "holdout": list(args.holdout), "methods": list(tried)}


# Many machines and days.


def run_fleet(args: argparse.Namespace) -> "Fleet":
    """Prints what drifts; writes the page."""
    from modeler.api.fleets import fleet
    from modeler.validation import format_fleet
    from modeler.views import build_fleet_page

    result = fleet(
        *(resolve_robot(args), args.logs, args.name),
        listed=args.listed,
        processing=Processing(position_cutoff=args.cutoff, parallel_cutoff=args.parallel_cutoff),
        mapping=args.mapping,
        workers=args.workers,
        dask=args.dask,
        reporter=build_reporter(),
    )
    print_lines(format_fleet(result))
    draw_result(args, lambda: build_fleet_page(result))
    return result
