"""`modeler compare MODEL LOG...`, and several models on the same rows."""

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.api.checks import compared
from modeler.api.workflow import Mapped, read_logs, recompile
from modeler.cli.console import Json, note, progress, say, say_next, working
from modeler.cli.places import ModelFile
from modeler.core.errors import DataError
from modeler.core.estimators import titled
from modeler.estimation.model_file import IdentifiedModel, load_model, with_essential_only
from modeler.observation.channels import Fault
from modeler.observation.findings import findings_of_prediction
from modeler.observation.log import Log, check_apart
from modeler.observation.observation import Observation
from modeler.report.comparison import write_contest, write_overlays, write_pictures, write_report
from modeler.report.page import Origin, after_compare
from modeler.runtime.model import CompiledModel
from modeler.validation.comparison import Comparison, compare
from modeler.validation.models import check_joints, contest, contest_lines, predict_together
from modeler.validation.verdict import looks_like_noise, verdict

_TRAINING = "training only: "


def run_compare(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes page and pictures."""
    if len(models_of(args)) > 1:
        return run_contest(args)
    model = load_model(args.model)
    if args.essential:
        model = with_essential_only(model, args.model)
    with working("predicting"):
        compiled = model.compile() if args.run_embedded_c else recompile(model)
    with progress("predicting") as bar:
        comparison, lines, found = judged(model, args.logs, compiled, args.map, bar)
    say(comparison.summary())
    say()
    for sentence in (*verdict(comparison), *model.warning):
        say(sentence)
    for line in lines:
        if line.startswith((_TRAINING, "long logs: ")):
            say(line)
    for fault in found:
        say(fault.line)
    held = not any(line.startswith(_TRAINING) for line in lines)
    noise = all(looks_like_noise(item) for item in comparison.joints) and not model.warning
    fitted = [log.name for log in model.logs]
    following = after_compare(args.model, fitted, args.logs, held, noise)
    if args.report is not None:
        with working("drawing the page"):
            origin = Origin(args.model, comparison.prediction.logs, held)
            place = write_report(Path(args.report), comparison, lines, origin, [following])
        say(f"written: {place}")
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_pictures(Path(args.pictures), comparison, bar)
        say(f"written: {len(written)} files in {args.pictures}")
    say_next([following])
    return comparison.as_dict() | {"doubts": [fault.line for fault in found]}


def judged(
    model: IdentifiedModel, logs: list[str], compiled: CompiledModel, mapping: Mapped = (),
    share: Callable[[float], None] = lambda share: None,
) -> tuple[Comparison, list[str], tuple[Fault, ...]]:  # fmt: skip
    """The comparison on logs, where everything came from, in lines, and what is wrong with it."""
    comparison, observation = compared(model, logs, compiled, mapping, share, note)
    fitted = ", ".join(log.name for log in model.logs)
    what = "" if model.fit.energy is None else "energy model, "
    lines = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, "
        f"{what}{titled(model.fit.method)} on {fitted}; relative error there "
        f"{model.fit.error_told()}"
    ]
    lines += [*model.warning, *_training(model, observation), *observation.report.lines()]
    found = findings_of_prediction(compiled, observation, model.beta)
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


def models_of(args: argparse.Namespace) -> list[str]:
    """All models that were typed: the first, and those among the logs."""
    return [args.model, *(place for place in args.logs if isinstance(place, ModelFile))]


def run_contest(args: argparse.Namespace) -> Json:
    """Prints the errors by joint and model, and who is better; writes page and pictures."""
    places = models_of(args)
    logs = [place for place in args.logs if not isinstance(place, ModelFile)]
    models = [_loaded(place, args.essential) for place in places]
    if not logs:
        raise DataError(
            f"{', '.join(places)}: got models only; expected a log too, as in run.csv or "
            "run.parquet; name at least one after them"
        )
    names = _names(places)
    check_joints(models, names)
    with progress("predicting") as bar:
        compiled = []
        for k, model in enumerate(models):
            compiled.append(model.compile() if args.run_embedded_c else recompile(model))
            bar((k + 1) / (len(models) + 1))
        read = [read_logs(own, logs, args.map) for own in compiled]
        check_apart(read[0], places=logs)
        predictions, _ = predict_together(models, compiled, read, names)
        found = contest(names, predictions)
    lines = _provenance(names, models, read[0])
    for line in (*contest_lines(found), *lines, *(w for model in models for w in model.warning)):
        say(line)
    if args.report is not None:
        with working("drawing the page"):
            place = write_contest(Path(args.report), found, lines, not _trained(models, read[0]))
        say(f"written: {place}")
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_overlays(Path(args.pictures), found, bar)
        say(f"written: {len(written)} files in {args.pictures}")
    return compare(predictions[0]).as_dict() | {"models": found.as_dicts(), "doubts": []}


def _loaded(place: str, essential: bool) -> IdentifiedModel:
    model = load_model(place)
    return with_essential_only(model, place) if essential else model


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


def _trained(models: Sequence[IdentifiedModel], logs: Sequence[Log]) -> list[tuple[int, str]]:
    """Models and logs whose rows they were fitted on."""
    return [
        (k, log.name)
        for k, model in enumerate(models)
        for log in logs
        if any(used.shares_rows(log) for used in model.logs)
    ]


def _provenance(
    names: Sequence[str], models: Sequence[IdentifiedModel], logs: Sequence[Log]
) -> list[str]:
    lines = [
        f"{name}: {model.spec.robot}, {len(model.beta)} base parameters, fitted on "
        f"{', '.join(log.name for log in model.logs)}"
        for name, model in zip(names, models, strict=True)
    ]
    lines.append(f"logs: {', '.join(log.name for log in logs)}, processed as those of {names[0]}")
    return lines + [
        f"training only: {names[k]} was fitted on rows of {log}, which flatters it"
        for k, log in _trained(models, logs)
    ]
