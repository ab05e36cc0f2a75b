"""`modeler compare MODEL LOG...`."""

import argparse
from collections.abc import Callable
from pathlib import Path

from modeler.api.chain import Mapped, recompile
from modeler.api.judging import compared
from modeler.cli.console import Json, note, progress, say, say_next, working
from modeler.cli.contest import models_of, run_contest
from modeler.compare import Comparison, verdict, write_pictures
from modeler.compare.verdict import looks_like_noise
from modeler.compiled import CompiledModel
from modeler.core.estimators import titled
from modeler.fit import IdentifiedModel, load_model
from modeler.fit.reduced import with_essential_only
from modeler.observation import Observation
from modeler.observation.channels import Fault
from modeler.observation.findings import findings_of_prediction
from modeler.pages.comparison import write_report
from modeler.pages.following import after_compare
from modeler.pages.sheet import Origin

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
        f"{model.fit.error_told('{:.2f} %')}"
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
