"""`modeler diagnose MODEL LOG...`."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from modeler.api.workflow import read_logs, recompile
from modeler.cli.console import Json, progress, say, say_next, working
from modeler.core.errors import DataError
from modeler.diagnosis.candidates import Known
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.diagnosis.sentences import lines
from modeler.effects.catalogue import effect_named
from modeler.effects.effect import Effect
from modeler.estimation.model_file import IdentifiedModel, load_model
from modeler.observation.log import check_apart
from modeler.report.diagnosis import write_diagnosis
from modeler.report.page import Origin, after_diagnosis
from modeler.robot.read import robot_from_text
from modeler.robot.robot import near


def run_diagnose(args: argparse.Namespace) -> Json:
    """Prints the verdict, the effects and what cannot be told."""
    model = load_model(args.model)
    robot = robot_from_text(model.robot_text, f"{args.model}, robot")
    _check_effects(args.without, robot.catalogue)
    _check_joints(args.without, model)
    with working("deriving the robot of the model"):
        compiled = recompile(model)
        logs = read_logs(compiled, args.logs, args.map)
        holdout = read_logs(compiled, args.holdout, args.map)
    check_apart(logs, holdout)
    with progress("looking for missing effects") as bar:
        diagnosis = diagnose(
            model, compiled, logs, holdout, args.without, progress=bar,
            known=Known(robot.catalogue, robot.coupling),
        )  # fmt: skip
    written = []
    following = after_diagnosis(args.model, args.logs, args.holdout, diagnosis)
    if args.report is not None:
        with working("drawing"):
            written = [_page(args, diagnosis, _provenance(model, args), following)]
    wrote = (f"written: {place}" for place in written)
    for line in (*lines(diagnosis), *model.warning, *wrote):
        say(line)
    say_next(following)
    return diagnosis.to_json()


def _page(
    args: argparse.Namespace, diagnosis: Diagnosis, lines: Sequence[str], following: Sequence[str]
) -> Path:
    logs = [Path(place).name for place in (*args.logs, *args.holdout)]
    origin = Origin(args.model, logs, bool(diagnosis.held_out))
    return write_diagnosis(Path(args.report), diagnosis, lines, origin, following)


def _provenance(model: IdentifiedModel, args: argparse.Namespace) -> list[str]:
    fitted = ", ".join(log.name for log in model.logs)
    shown = ", ".join(Path(place).name for place in args.logs)
    return [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, fitted on {fitted}",
        f"logs explained: {shown}",
        *model.warning,
    ]


def _check_effects(given: Sequence[str], catalogue: Sequence[Effect]) -> None:
    known = [effect.id for effect in catalogue]
    for text in given:
        name = text.partition("@")[0]
        if effect_named(name, catalogue) is None:
            raise DataError(
                f"--without {text}: no such effect{near(name, known)}; expected one of "
                f"{', '.join(known)}"
            )


def _check_joints(given: Sequence[str], model: IdentifiedModel) -> None:
    spec = model.spec
    names = [joint.name for joint in spec.joints]
    passive = spec.closure.variables if spec.closure is not None else ()
    for text in given:
        joint = text.partition("@")[2]
        if "@" in text and joint not in {*names, *passive}:
            raise DataError(
                f"--without {text}: no joint {joint}; expected one of {', '.join(names)}"
            )
