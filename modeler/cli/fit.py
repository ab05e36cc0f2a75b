"""`modeler fit ROBOT LOG... --out MODEL`."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from modeler.api.chain import compile_model, derive, generate, identified, read_logs
from modeler.api.ways import estimated, judged
from modeler.cli.console import Json, say, say_next, working
from modeler.cli.drive_gains import check_load, fit_with_gains
from modeler.cli.long_logs import fit_if_long
from modeler.cli.robots import robot_of
from modeler.cli.ways import asked, check_way
from modeler.core.choices import GAIN_METHOD
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.fit import FitResult, IdentifiedModel, save_model
from modeler.observation import Log, Observation, Processing, observe
from modeler.observation.apart import check_apart
from modeler.pages.following import after_fit
from modeler.robot import INERTIAL, Robot, robot_from_text
from modeler.robot.edit import with_parameters


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
    check_way(args)
    _check_robot_out(args)
    if args.method == GAIN_METHOD:
        check_load(args)
    processing = _processing(args)
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        emitted = generate(derivation)
        compiled = compile_model(emitted)
    if args.method == GAIN_METHOD:
        found = fit_with_gains(args, derivation, compiled, processing, _check_given)
        return _written(args, *found)
    if (long := fit_if_long(args, derivation, emitted, compiled, processing)) is not None:
        return _written(args, *long)
    with working("building the observation matrix"):
        logs = read_logs(compiled, args.logs, args.map)
        loaded = read_logs(compiled, args.payload_log, args.map)
        _check_given(args, logs, loaded)
        observation = observe(compiled, [*logs, *loaded], processing)
    with working("estimating"):
        way = estimated(asked(args, loaded), robot, compiled, observation)
    with working("judging the fit"):
        result = judged(compiled, observation, way)
    model = identified(derivation, emitted, observation, result)
    return _written(args, model, observation, way.lines) | way.further


def _written(
    args: argparse.Namespace,
    model: IdentifiedModel,
    observation: Observation,
    lines: Sequence[str] = (),
) -> Json:
    """Saves and prints the model."""
    save_model(args.out, model)
    *told, verdict = model.fit.lines()
    for line in (*observation.report.lines(), "", *lines, *told):
        say(line)
    say(f"written: {args.out}")
    if args.report is not None:
        from modeler.pages.fitted import write_fit  # pages take long to load

        following = after_fit(args.out, args.logs, args.robot, model.fit)
        place = write_fit(Path(args.report), model, observation.report.lines(), args.out, following)
        say(f"written: {place}")
    if args.robot_out is not None:
        stated = _own(robot_from_text(model.robot_text, "robot of the model"), model.fit)
        text = with_parameters(model.robot_text, stated) if stated else model.robot_text
        write_atomically(Path(args.robot_out), text)
        say(f"written: {args.robot_out}")
    say(verdict)
    say_next(after_fit(args.out, [*args.logs, *args.payload_log], args.robot, model.fit))
    return model.fit.to_json()


def _check_given(args: argparse.Namespace, logs: Sequence[Log], loaded: Sequence[Log]) -> None:
    check_apart([*logs, *loaded], places=[*args.logs, *args.payload_log])
    places = {log.name: place for place, log in zip(args.logs, logs, strict=True)}
    for place, log in zip(args.payload_log, loaded, strict=True):
        if log.name in places:
            raise DataError(
                f"{place}: carries the load, and {places[log.name]} has the same file name; "
                "rename one, loads are assigned by name"
            )


def _check_robot_out(args: argparse.Namespace) -> None:
    if args.robot_out is not None and args.method not in ("consistent", GAIN_METHOD):
        raise DataError(
            f"--robot-out: --method {args.method} ends in base parameters, of which many machines "
            "have the same; use --method consistent, which ends in all standard parameters, or "
            f"{GAIN_METHOD}, which finds drive gains"
        )


def _own(robot: Robot, result: FitResult) -> dict[str, float]:
    """The standard parameters that the robot file may state."""
    unfelt = {
        f"{prefix}{joint.name}": prefix in robot.inertial(joint.name)
        for joint in robot.moving
        for prefix in INERTIAL
    }
    return {name: value for name, value in result.standard.items() if unfelt.get(name, True)}
