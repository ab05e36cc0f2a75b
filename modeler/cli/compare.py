"""`modeler compare MODEL LOG...`: torques, several models on the same rows, positions."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import modeler.api.checks as checks
from modeler import validation
from modeler.api.model import is_model_file
from modeler.cli.console import draw_page, draw_pictures, print_lines
from modeler.cli.documents import ComparisonReport
from modeler.cli.lists import build_reporter, read_robot_with_notes
from modeler.cli.places import LogFile
from modeler.core.choices import LOG_ENDINGS
from modeler.core.errors import DataError
from modeler.core.options import CompareOptions, OptionError
from modeler.estimation import IdentifiedModel, load_model
from modeler.robot import Robot
from modeler.views import Origin, comparison as pages, suggest_after_compare, suggest_after_stated


def run_compare(
    args: argparse.Namespace,
) -> checks.ComparisonRun | ComparisonReport | validation.FreeRun:
    """Prints the table and the verdict; writes page and pictures."""
    options = CompareOptions.from_names(vars(args))
    others = [place for place in args.logs if not isinstance(place, LogFile)]
    if options.free_run and others:
        raise OptionError(f"{{--free_run}}: got {others[0]} too; expected one model, and logs")
    if options.free_run:
        return _run_free_run(args, options)
    if others:
        return _run_model_comparison(args, [args.model, *others], options)
    run = checks.compare_with_provenance(
        _read_model(args.model), args.logs, options, args.mapping, build_reporter()
    )
    print_lines(run.format_lines())
    following, comparison = _suggest_next(args, run), run.comparison
    origin = Origin(args.model, comparison.prediction.logs, run.is_held_out, [following])
    draw_page(args.report, lambda: pages.build_comparison_page(comparison, run.lines, origin))
    beside = [] if run.beside is None else pages.draw_model_pictures(run.beside)
    draw_pictures(args.picture, lambda: [*pages.draw_all_pictures(comparison), *beside])
    print_lines([following], "next: ")
    return run


def _suggest_next(args: argparse.Namespace, run: checks.ComparisonRun) -> str:
    if not run.model.logs:
        return suggest_after_stated(args.model, args.logs, args.mapping)
    folder = Path(args.model).parent
    fitted = dict.fromkeys(place for log in run.model.logs if (place := log.find_place(folder)))
    is_held_out = run.is_held_out and bool(fitted)
    return suggest_after_compare(args.model, [*fitted], args.logs, is_held_out, run.is_noise_like)


def _run_model_comparison(
    args: argparse.Namespace, places: Sequence[str], options: CompareOptions
) -> ComparisonReport:
    """Prints the errors by joint and model, and who is better; writes page and pictures."""
    logs = [place for place in args.logs if isinstance(place, LogFile)]
    things = [_read_model(place) for place in places]
    if not logs:
        raise DataError(
            f"{', '.join(places)}: got models only; expected a log too, as in run.csv or "
            "run.parquet; name at least one after them"
        )
    named = dict(zip(checks.choose_names(places), things, strict=True))
    comparison, lines, models, is_held_out = checks.compare_named_models(
        named, logs, options, args.mapping, build_reporter()
    )
    warnings = (line for model in models for line in model.warning)
    print_lines([*validation.format_model_comparison(comparison), *lines, *warnings])
    draw_page(
        args.report, lambda: pages.build_model_comparison_page(comparison, lines, is_held_out)
    )
    draw_pictures(args.picture, lambda: pages.draw_model_pictures(comparison))
    first = validation.compare(comparison.predictions[0])
    return ComparisonReport(first, comparison.models, [])


def _read_model(place: str) -> IdentifiedModel | Robot:
    if is_model_file(place):
        return load_model(place)
    if Path(place).suffix.lower() in LOG_ENDINGS:
        raise DataError(
            f"{place}: not a model file, and no robot; write MODEL or ROBOT first, logs next"
        )
    return read_robot_with_notes(place)


def _run_free_run(args: argparse.Namespace, options: CompareOptions) -> validation.FreeRun:
    """Prints the table and the verdict; writes the pictures."""
    settings = checks.build_free_run_settings(options)
    run, model = checks.simulate_positions(
        _read_model(args.model), args.logs, options, settings, args.mapping, build_reporter()
    )
    print_lines([*run.summary().splitlines(), *model.warning])
    draw_page(args.report, lambda: pages.build_free_run_page(run, Origin(args.model, run.logs)))
    draw_pictures(args.picture, lambda: validation.draw_free_run_pictures(run))
    return run
