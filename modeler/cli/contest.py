"""`modeler compare MODEL MODEL... LOG...`: models side by side."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from modeler.api.chain import read_logs, recompile
from modeler.cli.console import Json, progress, say, working
from modeler.cli.places import ModelFile
from modeler.compare import compare
from modeler.compare.together import check_joints, predict_together
from modeler.core.errors import DataError
from modeler.fit import IdentifiedModel, load_model
from modeler.fit.reduced import with_essential_only
from modeler.observation import Log
from modeler.observation.apart import check_apart
from modeler.pages.contest import write_contest, write_overlays
from modeler.scoring.contest import contest
from modeler.scoring.contest_text import contest_lines


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
