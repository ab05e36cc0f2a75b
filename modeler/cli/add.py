"""`modeler add MODEL EFFECT LOG... --out MODEL2`."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from modeler.api.improve import auto_added
from modeler.api.workflow import read_logs, recompile
from modeler.cli.console import Json, progress, say, say_next, working
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.table import DIGITS, percent
from modeler.diagnosis.add import add_effect, undone
from modeler.diagnosis.added_model import Logs, added, notes
from modeler.estimation.model_file import IdentifiedModel, load_model, save_model
from modeler.observation.log import check_apart
from modeler.report.history import write_additions
from modeler.report.page import Origin, after_add
from modeler.runtime.model import CompiledModel

_WIDTH = 40  # characters of the longest bar


def run_add(args: argparse.Namespace) -> Json:
    """Adds, saves, draws the waterfall."""
    _check(args)
    model = load_model(args.model)
    with working("deriving the robot of the model"):
        compiled = recompile(model)
        logs = Logs(*(read_logs(compiled, p, args.map) for p in (args.logs, args.holdout)))
    check_apart(logs.fitted, logs.held_out)
    better, left_out = _better(model, compiled, args, logs)
    written = _written(args, better, left_out)
    for line in (
        *waterfall(better),
        *added(better),
        *left_out,
        *notes(better, max(1, len(model.history))),
        *model.warning,
        *_ending(better),
        *(f"written: {place}" for place in written),
    ):
        say(line)
    say_next(after_add(args.out, args.holdout))
    waterfall_ = [step.to_json() for step in better.history]
    return better.fit.to_json() | {"waterfall": waterfall_, "left_out": list(left_out)}


def _ending(better: IdentifiedModel) -> list[str]:
    """Whether the new model is usable."""
    return [] if better.fit.verdict is None else [f"now: {better.fit.verdict.line}"]


def _written(
    args: argparse.Namespace, better: IdentifiedModel, left_out: Sequence[str]
) -> list[str]:
    """Writes the model, and robot file and page if they are asked for; their places."""
    save_model(args.out, better)
    places = [args.out]
    if args.robot is not None:
        write_atomically(Path(args.robot), better.robot_text)
        places.append(args.robot)
    if args.report is not None and better.history:
        held = better.history[-1].held_out
        origin = Origin(args.out, held or args.logs, bool(held))
        following = after_add(args.out, args.holdout)
        write_additions(Path(args.report), better, left_out, origin, following)
        places.append(args.report)
    return places


def _check(args: argparse.Namespace) -> None:
    """What can be refused before anything is computed."""
    if args.joint is not None and args.effect in ("auto", "undo"):
        raise DataError(
            f"--joint {args.joint}: `{args.effect}` takes no joint; expected one effect with "
            "--joint, or leave it out"
        )


def _better(
    model: IdentifiedModel, compiled: CompiledModel, args: argparse.Namespace, logs: Logs
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with the effect, with all that a diagnosis names, or without the last one.

    And why effects that the diagnosis names are left out.
    """
    if args.effect == "undo":
        with working("fitting without the last effect"):
            return undone(model, logs), ()
    if args.effect != "auto":
        with working(f"adding {args.effect}"):
            return add_effect(model, compiled, args.effect, args.joint, logs), ()
    with progress("looking for missing effects") as bar:
        better, left_out, _ = auto_added(model, compiled, logs, bar, working)
    return better, left_out


def waterfall(model: IdentifiedModel) -> list[str]:
    """The error after every effect that was added, as bars."""
    if not model.history:
        return ["nothing is added: the model stays as it was fitted"]
    held_out = bool(model.history and model.history[-1].held_out)
    title = "held-out error" if held_out else "error on parts of the fitted logs, left out in turn"
    if len(model.history[-1].joints) > 1:
        title += ", rms over the joints"
    lines = [f"{'':<30} {title}"]
    largest = max((step.error for step in model.history), default=0.0) or 1.0
    for step in model.history:
        name = f"+ {step.effect}" if step.effect else "model as fitted"
        name += f" @{step.joint}" if step.joint else ""
        bar = "#" * round(_WIDTH * step.error / largest)
        fitted = percent(step.training_error, DIGITS)
        lines.append(f"{name:<30} {percent(step.error, DIGITS):>8} {bar}  (fitted {fitted})")
    return lines
