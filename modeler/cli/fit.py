"""`modeler fit ROBOT LOG... --out MODEL` and `modeler compare MODEL LOG...`."""

import argparse
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from modeler.api import compile_model, derive, generate, identified, read_logs, recompile
from modeler.cli.console import Json, progress, say, working
from modeler.cli.drive_gains import carried, check_load, fit_with_gains
from modeler.cli.robots import robot_of
from modeler.compare import Comparison, compare, verdict, write_pictures, write_report
from modeler.compare.predict import predict
from modeler.compiled import CompiledModel
from modeler.core.choices import GAIN_METHOD
from modeler.core.errors import DataError
from modeler.core.estimators import titled
from modeler.core.files import write_atomically
from modeler.fit import (
    FitResult,
    IdentifiedModel,
    are_currents,
    identify,
    identify_with_payloads,
    known_doubts,
    load_model,
    save_model,
    with_verdict,
)
from modeler.fit.doubts import Told
from modeler.observation import Log, Observation, Processing, observe
from modeler.observation.channels import Fault
from modeler.observation.findings import findings_of_fit, findings_of_prediction
from modeler.observation.log import shared_rows
from modeler.robot import INERTIAL, Robot
from modeler.robot.edit import with_parameters

_TRAINING = "training only: "

Given = tuple[str, Log]
"""A log and what the user typed for it."""


def _processing(args: argparse.Namespace) -> Processing:
    return Processing(
        position_cutoff=args.cutoff,
        parallel_cutoff=args.parallel_cutoff,
        decimation=args.decimate,
        derivatives=args.derivatives,
        low_speed=args.low_speed,
        keep_saturated=args.keep_saturated,
        keep_contradicted=args.keep_contradicted,
        keep_damaged=args.keep_damaged,
    )


def run_fit(args: argparse.Namespace) -> Json:
    """Fits, prints the table, saves the model."""
    _check_load(args)
    if args.method == GAIN_METHOD:
        check_load(args)
    _check_robot_out(args)
    processing = _processing(args)
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        emitted = generate(derivation)
        compiled = compile_model(emitted)
    save = partial(_written, args, robot)
    if args.method == GAIN_METHOD:
        return save(*fit_with_gains(args, derivation, compiled, processing, _check_given))
    with working("building the observation matrix"):
        logs = read_logs(compiled, args.logs)
        loaded = read_logs(compiled, args.payload_log)
        _check_given(args, logs, loaded)
        observation = observe(compiled, [*logs, *loaded], processing)
    told: list[Told] = []
    if loaded:
        payloads = carried(args, loaded)
        result = identify_with_payloads(compiled, observation, payloads, args.method)
        told += known_doubts(compiled, observation, payloads, are_currents([*logs, *loaded]))
    else:
        result = identify(observation, args.method, compiled)
    with working("judging the fit"):
        told += findings_of_fit(compiled, observation, result.beta)
        bare = [log.name for log in logs]
        result = with_verdict(compiled, observation, result, told, bare)
    return save(identified(derivation, emitted, observation, result), observation)


def _written(
    args: argparse.Namespace, robot: Robot, model: IdentifiedModel, observation: Observation
) -> Json:
    """Saves and prints the model."""
    save_model(args.out, model)
    for line in (*observation.report.summary(), "", *model.fit.summary()):
        say(line)
    say(f"written: {args.out}")
    if args.robot_out is not None:
        consistent = args.method == "consistent"
        text = with_parameters(robot.text, _own(robot, model.fit)) if consistent else None
        write_atomically(Path(args.robot_out), text or model.robot_text)
        say(f"written: {args.robot_out}")
    return model.fit.to_json()


def _check_given(args: argparse.Namespace, logs: Sequence[Log], loaded: Sequence[Log]) -> None:
    _check_logs(_given(args.logs, logs), _given(args.payload_log, loaded))


def _check_robot_out(args: argparse.Namespace) -> None:
    if args.robot_out is not None and args.method not in ("consistent", GAIN_METHOD):
        raise DataError(
            f"--robot-out: --method {args.method} ends in base parameters, of which many machines "
            "have the same; use --method consistent, which ends in all standard parameters, or "
            "--method tls, which ends in drive gains"
        )


def _own(robot: Robot, result: FitResult) -> dict[str, float]:
    """The standard parameters that the robot file may state."""
    unfelt = {
        f"{prefix}{joint.name}": prefix in robot.inertial(joint.name)
        for joint in robot.moving
        for prefix in INERTIAL
    }
    return {name: value for name, value in result.standard.items() if unfelt.get(name, True)}


def _given(places: Sequence[str], logs: Sequence[Log]) -> list[Given]:
    return list(zip(places, logs, strict=True))


def _check_load(args: argparse.Namespace) -> None:
    for option in ("payload_mass", "payload_link", "payload_moved"):
        value = getattr(args, option)
        if value is not None and value is not False and not args.payload_log:  # 0 is given too
            flag = "--" + option.replace("_", "-")
            raise DataError(f"{flag}: no loaded log; name it with --payload-log LOG")


def _check_logs(bare: Sequence[Given], loaded: Sequence[Given]) -> None:
    """Refuse rows that are given twice, and a loaded log named like a bare one."""
    given = [*bare, *loaded]
    for index, (place, log) in enumerate(given):
        for first, other in given[:index]:
            if shared_rows(log, other.content, other.time[0], other.time[-1]):
                raise DataError(
                    f"{place}: got rows of {first} again; rows that repeat count twice, and their "
                    "noise looks like something that returns; give each row once"
                )
    places = {log.name: place for place, log in bare}
    for place, log in loaded:
        if log.name in places:
            raise DataError(
                f"{place}: carries the load, and {places[log.name]} has the same file name; "
                "rename one, loads are assigned by name"
            )


def run_compare(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes page and pictures."""
    model = load_model(args.model)
    with working("predicting"):
        compiled = model.compile() if args.run_embedded_c else recompile(model)
        comparison, lines, found = judged(model, args.logs, compiled)
    say(comparison.summary())
    say()
    for sentence in (*verdict(comparison), *model.warning):
        say(sentence)
    for line in lines:
        if line.startswith(_TRAINING):
            say(line)
    for fault in found:
        say(fault.line)
    if args.report is not None:
        with working("drawing the page"):
            place = write_report(Path(args.report), comparison, lines)
        say(f"written: {place}")
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_pictures(Path(args.pictures), comparison, bar)
        say(f"written: {len(written)} files in {args.pictures}")
    return comparison.as_dict() | {"doubts": [fault.line for fault in found]}


def judged(
    model: IdentifiedModel, logs: list[str], compiled: CompiledModel
) -> tuple[Comparison, list[str], tuple[Fault, ...]]:
    """The comparison on logs, where everything came from, in lines, and what is wrong with it."""
    read = read_logs(compiled, logs)
    _check_logs(_given(logs, read), [])
    prediction, observation = predict(model, read, compiled)
    fitted = ", ".join(log.name for log in model.logs)
    lines = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, {titled(model.fit.method)} "
        f"on {fitted}; relative error there {100 * model.fit.relative_error:.2f} %"
    ]
    lines += [*model.warning, *_training(model, read), *observation.report.summary()]
    found = findings_of_prediction(compiled, observation, model.beta)
    lines += [fault.line for fault in found if fault.certain]
    return compare(prediction), lines, found


def _training(model: IdentifiedModel, logs: Sequence[Log]) -> list[str]:
    """A line on the logs whose rows the model was fitted on, whatever the files are called."""
    seen = []
    for log in logs:
        fitted = sorted({used.name for used in model.logs if used.shares_rows(log)})
        if fitted == [log.name]:
            seen.append(log.name)
        elif fitted:
            seen.append(f"{', '.join(fitted)}, which shares rows with {log.name}")
    return [f"{_TRAINING}the model was fitted on {'; '.join(seen)}"] if seen else []
