"""`modeler compare MODEL LOG...`: torques, several models on the same rows, positions."""

import argparse
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import modeler.api.checks as checks
from modeler import validation
from modeler.api.log_maps import Mapped
from modeler.api.model import holds_model
from modeler.api.workflow import are_long, read_logs, recompile
from modeler.cli.console import Json, draw_page, draw_pictures, note, progress, say_lines, working
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import LogFile
from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import DataError
from modeler.core.estimators import titled
from modeler.estimation import (
    IdentifiedModel,
    load_model,
    log_findings,
    with_essential_only,
    with_load,
)
from modeler.observation import Doubt, Observation, check_apart
from modeler.report import Origin, after_compare, after_stated, comparison as pages
from modeler.robot import Robot
from modeler.runtime import CompiledModel

_TRAINING = "training only: "


def run_compare(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes page and pictures."""
    others = [place for place in args.logs if not isinstance(place, LogFile)]
    _check_free_run(args, others)
    if args.free_run:
        return _run_free(args)
    if others:
        return _run_contest(args, [args.model, *others])
    model = _loaded(args, args.model)
    with working("predicting"):
        compiled = _compiled(args, model)
    with progress("predicting") as bar:
        comparison, lines, found = judged(model, args.logs, compiled, args.map, bar)
    doubts = [fault.line for fault in found]
    told = [line for line in lines if line.startswith((_TRAINING, "long logs: ", "note: "))]
    beside = _without_load(args, model, compiled)
    loads = [] if beside is None else ["", *validation.contest_lines(beside)]
    said = [] if model.logs else model.fit.sentences
    summary = [comparison.summary(), *loads, *said, ""]
    say_lines([*summary, *validation.verdict(comparison), *model.warning, *told, *doubts])
    held = not any(line.startswith(_TRAINING) for line in lines)
    noise = (
        all(validation.looks_like_noise(item) for item in comparison.joints) and not model.warning
    )
    folder = Path(args.model).parent
    fitted = dict.fromkeys(place for log in model.logs if (place := log.place(folder)))
    following = (
        after_compare(args.model, [*fitted], args.logs, held and bool(fitted), noise)
        if model.logs
        else after_stated(args.model, args.logs, args.map)
    )
    origin = Origin(args.model, comparison.prediction.logs, held, [following])
    draw_page(args.report, lambda: pages.comparison_page(comparison, lines, origin))
    more = [] if beside is None else pages.contest_pictures(beside)
    draw_pictures(args.picture, lambda: [*pages.all_pictures(comparison), *more])
    say_lines([following], "next: ")
    return comparison.to_json() | {"doubts": [*said[1:], *doubts]}


def judged(
    model: IdentifiedModel, logs: list[str], compiled: CompiledModel, mapping: Mapped = (),
    share: Callable[[float], None] = lambda share: None,
) -> tuple[validation.Comparison, list[str], tuple[Doubt, ...]]:  # fmt: skip
    """The comparison on logs, where everything came from, in lines, and what is wrong with it."""
    comparison, observation = checks.compared(model, logs, compiled, mapping, share, note)
    fitted = ", ".join(log.name for log in model.logs)
    what = "" if model.fit.energy is None else "energy model, "
    lines = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, "
        f"{what}{titled(model.fit.method)} on {fitted}; relative error there "
        f"{model.fit.error_told()}"
    ] if model.logs else [*model.fit.sentences]  # fmt: skip
    lines += [*model.warning, *_training(model, observation), *observation.report.lines()]
    lines += observation.report.notes()
    found = log_findings(compiled, observation, model)
    lines += [fault.line for fault in found if fault.certain]
    return comparison, lines, found


def _training(model: IdentifiedModel, observation: Observation) -> list[str]:
    """A line on the logs whose rows the model was fitted on, whatever the files are called."""
    seen = []
    for log in observation.report.logs:
        fitted = sorted({used.name for used in model.logs if used.shares_rows(log)})
        if fitted == [log.name]:
            seen.append(log.name)
        elif fitted:
            seen.append(f"{', '.join(fitted)}, which shares rows with {log.name}")
    return [f"{_TRAINING}the model was fitted on {'; '.join(seen)}"] if seen else []


def _run_contest(args: argparse.Namespace, places: Sequence[str]) -> Json:
    """Prints the errors by joint and model, and who is better; writes page and pictures."""
    logs = [place for place in args.logs if isinstance(place, LogFile)]
    models = checks.with_stated([_opened(args, place) for place in places])
    models = [_with_load(args, model) for model in models]
    if not logs:
        raise DataError(
            f"{', '.join(places)}: got models only; expected a log too, as in run.csv or "
            "run.parquet; name at least one after them"
        )
    names = _names(places)
    validation.check_joints(models, names)
    with progress("predicting") as bar:
        compiled = []
        for k, model in enumerate(models):
            compiled.append(_compiled(args, model))
            bar((k + 1) / (len(models) + 1))
        found, read = checks.contested(
            dict(zip(names, models, strict=True)), compiled, logs, args.map, logs
        )
    trained = [
        (name, log.name)
        for name, model in zip(names, models, strict=True)
        for log in read
        if any(used.shares_rows(log) for used in model.logs)
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
    say_lines(
        [*validation.contest_lines(found), *lines, *(w for model in models for w in model.warning)]
    )
    draw_page(args.report, lambda: pages.contest_page(found, lines, not trained))
    draw_pictures(args.picture, lambda: pages.contest_pictures(found))
    return validation.compare(found.predictions[0]).to_json() | {
        "models": found.as_dicts(),
        "doubts": [],
    }


def _opened(args: argparse.Namespace, place: str) -> IdentifiedModel | Robot:
    if holds_model(place):
        model = load_model(place)
        return with_essential_only(model, place) if args.essential else model
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


def _bare(args: argparse.Namespace, place: str) -> IdentifiedModel:
    return checks.with_stated([_opened(args, place)])[0]


def _loaded(args: argparse.Namespace, place: str) -> IdentifiedModel:
    return _with_load(args, _bare(args, place))


def _with_load(args: argparse.Namespace, model: IdentifiedModel) -> IdentifiedModel:
    load = _load(args)
    return model if load["mass"] is None else with_load(model, **load)


def _load(args: argparse.Namespace) -> dict[str, Any]:
    """What `with_load` takes of the options."""
    given = {name: getattr(args, f"payload_{name}") for name in ("mass", "centre", "link")}
    for name in ("centre", "link"):
        if given["mass"] is None and given[name] is not None:
            raise DataError(f"--payload-{name}: no load; add --payload-mass KG, or leave it out")
    try:
        given["centre"] = [float(part) for part in (given["centre"] or "0,0,0").split(",")]
    except ValueError:
        raise DataError(
            f"--payload-centre {given['centre']}: expected x, y and z in m, as in 0,0,0.05"
        ) from None
    return given


def _without_load(
    args: argparse.Namespace, model: IdentifiedModel, compiled: CompiledModel
) -> validation.Contest | None:
    """The model with its load beside the same without."""
    if args.payload_mass is None or are_long(args.logs):
        return None
    both = {f"with {args.payload_mass:g} kg": model, "without the load": _bare(args, args.model)}
    return checks.contested(both, [compiled] * 2, args.logs, args.map, args.logs)[0]


def _compiled(args: argparse.Namespace, model: IdentifiedModel) -> CompiledModel:
    return model.compile() if args.run_embedded_c else recompile(model)


def _names(places: Sequence[str]) -> list[str]:
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


def _run_free(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes the pictures."""
    asked = validation.FreeRunSettings(gains=_gains(args.controller), **_given(args, _SETTINGS))
    model = _loaded(args, args.model)
    with working("deriving the robot of the model"):
        compiled = _compiled(args, model)
        logs = read_logs(compiled, args.logs, args.map)
    check_apart(logs, places=args.logs)
    with progress("simulating") as bar:
        found = validation.free_run(model, logs, compiled, asked, bar)
    say_lines([*found.summary().splitlines(), *model.warning])
    draw_page(args.report, lambda: pages.free_run_page(found, Origin(args.model, found.logs)))
    draw_pictures(args.picture, lambda: validation.free_run_pictures(found))
    return found.to_json()


_SETTINGS = ("window", "bound")


def _given(args: argparse.Namespace, names: Sequence[str]) -> dict[str, Any]:
    """Of these options those that were typed."""
    return {name: value for name in names if (value := getattr(args, name)) is not None}


def _check_free_run(args: argparse.Namespace, others: Sequence[str]) -> None:
    """Refuses what does not go with `--free-run`, or only with it."""
    given = _given(args, (*_SETTINGS, "controller"))
    if not args.free_run:
        for name in given:
            raise DataError(f"--{name}: is of --free-run; add that, or leave --{name} out")
    elif others:
        raise DataError(f"--free-run: got {others[0]} too; expected one model, and logs")


def _gains(text: str | None) -> validation.Gains | None:
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
