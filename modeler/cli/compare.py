"""`modeler compare MODEL LOG...`: torques, several models on the same rows, positions."""

import argparse
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import modeler.api.checks as checks
from modeler import validation
from modeler.api.log_maps import Mapped
from modeler.api.model import is_model_file
from modeler.api.workflow import are_long, compile, read_logs
from modeler.cli.console import (
    Json,
    draw_page,
    draw_pictures,
    print_lines,
    print_note,
    show_activity,
    show_progress,
)
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import LogFile
from modeler.core.choices import LOG_ENDINGS, find_estimator_title
from modeler.core.errors import DataError
from modeler.estimation import (
    IdentifiedModel,
    add_known_load,
    find_log_faults,
    keep_essential,
    load_model,
)
from modeler.regression import DataWarning, Observation, check_no_overlap
from modeler.robot import Robot
from modeler.runtime import CompiledModel
from modeler.views import Origin, comparison as pages, suggest_after_compare, suggest_after_stated

_TRAINING = "training only: "


def run_compare(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes page and pictures."""
    others = [place for place in args.logs if not isinstance(place, LogFile)]
    _check_free_run(args, others)
    if args.free_run:
        return _run_free_run(args)
    if others:
        return _run_model_comparison(args, [args.model, *others])
    model = _open_with_load(args, args.model)
    with show_activity("predicting"):
        compiled = _compile_model(args, model)
    with show_progress("predicting") as bar:
        comparison, lines, findings = compare_with_findings(
            model, args.logs, compiled, args.map, bar
        )
    doubts = [fault.line for fault in findings]
    notes = [line for line in lines if line.startswith((_TRAINING, "long logs: ", "note: "))]
    beside = _compare_without_load(args, model, compiled)
    loads = [] if beside is None else ["", *validation.format_model_comparison(beside)]
    stated_lines = [] if model.logs else model.fit.sentences
    summary = [comparison.summary(), *loads, *stated_lines, ""]
    print_lines([*summary, *validation.write_verdict(comparison), *model.warning, *notes, *doubts])
    is_held_out = not any(line.startswith(_TRAINING) for line in lines)
    noise = all(validation.is_noise_like(item) for item in comparison.joints) and not model.warning
    folder = Path(args.model).parent
    fitted = dict.fromkeys(place for log in model.logs if (place := log.find_place(folder)))
    following = (
        suggest_after_compare(args.model, [*fitted], args.logs, is_held_out and bool(fitted), noise)
        if model.logs
        else suggest_after_stated(args.model, args.logs, args.map)
    )
    origin = Origin(args.model, comparison.prediction.logs, is_held_out, [following])
    draw_page(args.report, lambda: pages.build_comparison_page(comparison, lines, origin))
    comparison_pictures = [] if beside is None else pages.draw_model_pictures(beside)
    draw_pictures(
        args.picture, lambda: [*pages.draw_all_pictures(comparison), *comparison_pictures]
    )
    print_lines([following], "next: ")
    return comparison.to_json() | {"warnings": [*stated_lines[1:], *doubts]}


def compare_with_findings(
    model: IdentifiedModel, logs: list[str], compiled: CompiledModel, mapping: Mapped = (),
    share: Callable[[float], None] = lambda share: None,
) -> tuple[validation.Comparison, list[str], tuple[DataWarning, ...]]:  # fmt: skip
    """Compares on logs; returns the comparison, its provenance in lines, and the findings."""
    comparison, observation = checks.compare_logs(model, logs, compiled, mapping, share, print_note)
    fitted = ", ".join(log.name for log in model.logs)
    what = "" if model.fit.energy is None else "energy model, "
    lines = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, "
        f"{what}{find_estimator_title(model.fit.method)} on {fitted}; relative error there "
        f"{model.fit.format_error()}"
    ] if model.logs else [*model.fit.sentences]  # fmt: skip
    lines += [
        *model.warning,
        *_describe_training(model, observation),
        *observation.report.format_lines(),
    ]
    lines += observation.report.collect_notes()
    findings = find_log_faults(compiled, observation, model)
    lines += [fault.line for fault in findings if fault.is_certain]
    return comparison, lines, findings


def _describe_training(model: IdentifiedModel, observation: Observation) -> list[str]:
    """A line on the logs whose rows the model was fitted on, whatever the files are called."""
    training_logs = []
    for log in observation.report.logs:
        fitted = sorted({used.name for used in model.logs if used.has_rows_of(log)})
        if fitted == [log.name]:
            training_logs.append(log.name)
        elif fitted:
            training_logs.append(f"{', '.join(fitted)}, which shares rows with {log.name}")
    return (
        [f"{_TRAINING}the model was fitted on {'; '.join(training_logs)}"] if training_logs else []
    )


def _run_model_comparison(args: argparse.Namespace, places: Sequence[str]) -> Json:
    """Prints the errors by joint and model, and who is better; writes page and pictures."""
    logs = [place for place in args.logs if isinstance(place, LogFile)]
    models = checks.resolve_models([_open_place(args, place) for place in places])
    models = [_add_load(args, model) for model in models]
    if not logs:
        raise DataError(
            f"{', '.join(places)}: got models only; expected a log too, as in run.csv or "
            "run.parquet; name at least one after them"
        )
    names = _choose_names(places)
    validation.check_joints(models, names)
    with show_progress("predicting") as bar:
        compiled = []
        for k, model in enumerate(models):
            compiled.append(_compile_model(args, model))
            bar((k + 1) / (len(models) + 1))
        model_comparison, read = checks.compare_compiled_models(
            dict(zip(names, models, strict=True)), compiled, logs, args.map, logs
        )
    trained = [
        (name, log.name)
        for name, model in zip(names, models, strict=True)
        for log in read
        if any(used.has_rows_of(log) for used in model.logs)
    ]
    lines = [
        f"{name}: {model.spec.robot}, {len(model.beta)} base parameters, "
        + (f"fitted on {', '.join(log.name for log in model.logs)}" if model.logs
           else "; ".join(model.fit.sentences))
        for name, model in zip(names, models, strict=True)
    ]  # fmt: skip
    lines.append(f"logs: {', '.join(log.name for log in read)}, processed as those of {names[0]}")
    lines += [
        f"{_TRAINING}{name} was fitted on rows of {log}, which flatters it" for name, log in trained
    ]
    print_lines(
        [
            *validation.format_model_comparison(model_comparison),
            *lines,
            *(w for model in models for w in model.warning),
        ]
    )
    draw_page(
        args.report, lambda: pages.build_model_comparison_page(model_comparison, lines, not trained)
    )
    draw_pictures(args.picture, lambda: pages.draw_model_pictures(model_comparison))
    return validation.compare(model_comparison.predictions[0]).to_json() | {
        "models": model_comparison.as_dicts(),
        "warnings": [],
    }


def _open_place(args: argparse.Namespace, place: str) -> IdentifiedModel | Robot:
    if is_model_file(place):
        model = load_model(place)
        return keep_essential(model, place) if args.essential else model
    for option in ("essential", "run_embedded_c"):
        if getattr(args, option):
            raise DataError(
                f"--{option.replace('_', '-')}: {place} is a robot; expected a model file of "
                "`modeler fit`; leave the option out"
            )
    if Path(place).suffix.lower() in LOG_ENDINGS:
        raise DataError(f"{place}: not a model file, and no robot; write MODEL or ROBOT first, "
                        "logs next")  # fmt: skip
    return read_robot_with_notes(place)


def _open_without_load(args: argparse.Namespace, place: str) -> IdentifiedModel:
    return checks.resolve_models([_open_place(args, place)])[0]


def _open_with_load(args: argparse.Namespace, place: str) -> IdentifiedModel:
    return _add_load(args, _open_without_load(args, place))


def _add_load(args: argparse.Namespace, model: IdentifiedModel) -> IdentifiedModel:
    load = _parse_load(args)
    return model if load["mass"] is None else add_known_load(model, **load)


def _parse_load(args: argparse.Namespace) -> dict[str, Any]:
    """What `add_known_load` takes of the options."""
    load_options = {name: getattr(args, f"payload_{name}") for name in ("mass", "centre", "link")}
    for name in ("centre", "link"):
        if load_options["mass"] is None and load_options[name] is not None:
            raise DataError(f"--payload-{name}: no load; add --payload-mass KG, or leave it out")
    try:
        load_options["centre"] = [
            float(part) for part in (load_options["centre"] or "0,0,0").split(",")
        ]
    except ValueError:
        raise DataError(
            f"--payload-centre {load_options['centre']}: expected x, y and z in m, as in 0,0,0.05"
        ) from None
    return load_options


def _compare_without_load(
    args: argparse.Namespace, model: IdentifiedModel, compiled: CompiledModel
) -> validation.ModelComparison | None:
    """The model with its load beside the same without."""
    if args.payload_mass is None or are_long(args.logs):
        return None
    both = {
        f"with {args.payload_mass:g} kg": model,
        "without the load": _open_without_load(args, args.model),
    }
    return checks.compare_compiled_models(both, [compiled] * 2, args.logs, args.map, args.logs)[0]


def _compile_model(args: argparse.Namespace, model: IdentifiedModel) -> CompiledModel:
    return model.compile() if args.run_embedded_c else compile(model)


def _choose_names(places: Sequence[str]) -> list[str]:
    """File names, or paths where two are alike.

    Raises:
        DataError: one file is given twice.
    """
    for k, place in enumerate(places):
        if Path(place).resolve() in {Path(other).resolve() for other in places[:k]}:
            raise DataError(f"{place}: got this model twice; expected each model once")
    short = [Path(place).name for place in places]
    return short if len(set(short)) == len(short) else [str(place) for place in places]


# `--free-run`.


def _run_free_run(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes the pictures."""
    settings = validation.FreeRunSettings(
        gains=_parse_gains(args.controller), **_collect_typed(args, _SETTINGS)
    )
    model = _open_with_load(args, args.model)
    with show_activity("deriving the robot of the model"):
        compiled = _compile_model(args, model)
        logs = read_logs(compiled, args.logs, args.map)
    check_no_overlap(logs, places=args.logs)
    with show_progress("simulating") as bar:
        free_run = validation.simulate_free_run(model, logs, compiled, settings, bar)
    print_lines([*free_run.summary().splitlines(), *model.warning])
    draw_page(
        args.report, lambda: pages.build_free_run_page(free_run, Origin(args.model, free_run.logs))
    )
    draw_pictures(args.picture, lambda: validation.draw_free_run_pictures(free_run))
    return free_run.to_json()


_SETTINGS = ("window", "bound")


def _collect_typed(args: argparse.Namespace, names: Sequence[str]) -> dict[str, Any]:
    """Of these options those that were typed."""
    return {name: value for name in names if (value := getattr(args, name)) is not None}


def _check_free_run(args: argparse.Namespace, others: Sequence[str]) -> None:
    """Refuses what does not go with `--free-run`, or only with it."""
    typed_options = _collect_typed(args, (*_SETTINGS, "controller"))
    if not args.free_run:
        for name in typed_options:
            raise DataError(f"--{name}: is of --free-run; add that, or leave --{name} out")
    elif others:
        raise DataError(f"--free-run: got {others[0]} too; expected one model, and logs")


def _parse_gains(text: str | None) -> validation.Gains | None:
    """Of `--controller`."""
    if text is None:
        return None
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if not 2 <= len(values) <= 4 or not all(math.isfinite(v) and v >= 0.0 for v in values):
        raise DataError(
            f"--controller {text}: expected two to four numbers that are not negative, as in "
            "20,0.25 or 20,0.25,1,1: speed loop in Hz, ratio of the position loop, integral, "
            "feedforward"
        )
    if values[0] == 0.0 or values[1] == 0.0:
        raise DataError(
            f"--controller {text}: a loop of 0 holds nothing; expected a speed loop and a ratio "
            "above 0"
        )
    speed, ratio, integral, forward = [*values, 0.0, 0.0][:4]
    return speed, ratio, integral, forward
