"""`modeler fit ROBOT LOG... --out MODEL`."""

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.api.fitting import Load, found_with_gains
from modeler.api.ways import OF_WINDOWS, WITHOUT_LOADS, FitRequest, estimated, judged
from modeler.api.workflow import compile_model, derive, generate, identified, read_logs
from modeler.cli.console import Json, say, say_next, working
from modeler.cli.lists import robot_of
from modeler.cli.long_logs import fit_if_long
from modeler.codegen.derivation import Derivation
from modeler.core.errors import GAIN_METHOD, DataError
from modeler.core.files import write_atomically
from modeler.estimation.model_file import IdentifiedModel, save_model
from modeler.estimation.payload import Payload
from modeler.estimation.result import FitResult
from modeler.observation.log import Log, check_apart
from modeler.observation.observation import Observation, observe
from modeler.observation.processing import Processing
from modeler.report.page import after_fit
from modeler.robot.edit import with_parameters
from modeler.robot.read import robot_from_text
from modeler.robot.robot import INERTIAL, Robot
from modeler.runtime.model import CompiledModel

# `modeler fit ROBOT LOG... --payload-log LOG --payload-mass KG --method tls`.


Checked = Callable[[argparse.Namespace, Sequence[Log], Sequence[Log]], None]
"""Refuses logs that do not belong together."""


def fit_with_gains(
    args: argparse.Namespace,
    derivation: Derivation,
    compiled: CompiledModel,
    processing: Processing,
    check: Checked,
) -> tuple[IdentifiedModel, Observation]:
    """The model whose robot file has the drive gains that the logs tell."""
    check_load(args)
    return found_with_gains(
        derivation, compiled, args.logs, _load(args), processing,
        lambda logs, loaded: check(args, logs, loaded), working, args.map,
    )  # fmt: skip


def check_load(args: argparse.Namespace) -> None:
    """Nothing, if a loaded log and the mass of its load are given.

    Raises:
        DataError: says which is missing.
    """
    if not args.payload_log:
        raise DataError(
            "--method tls: no loaded log; the gains of drives show in what a load of known mass "
            "adds to their currents; add --payload-log LOG --payload-mass KG"
        )
    if args.payload_mass is None:
        raise DataError(
            "--method tls: no --payload-mass; without a known mass all gains and all parameters "
            "may be larger by one factor; weigh the load and give its mass in kg"
        )


def carried(args: argparse.Namespace, loaded: Sequence[Log]) -> list[Payload]:
    """The load of the loaded logs; one for each if it was taken off in between."""
    return _load(args).payloads(loaded)


def _load(args: argparse.Namespace) -> Load:
    return Load(args.payload_log, args.payload_mass, args.payload_link, args.payload_moved)


# The options of `modeler fit` that choose a way to fit.


def asked(args: argparse.Namespace, loaded: Sequence[Log]) -> FitRequest:
    """What the options ask for."""
    payloads = tuple(carried(args, loaded)) if loaded else ()
    return FitRequest(
        args.method, args.model == "energy", args.window, payloads, args.essential_below
    )


def check_way(args: argparse.Namespace) -> None:
    """Refuse options that do not go together."""
    for option in ("payload_mass", "payload_link", "payload_moved"):
        value = getattr(args, option)
        if value is not None and value is not False and not args.payload_log:  # 0 is given too
            flag = "--" + option.replace("_", "-")
            raise DataError(f"{flag}: no loaded log; name it with --payload-log LOG")
    if args.payload_log and args.method in WITHOUT_LOADS:
        raise DataError(
            f"--payload-log: got it with --method {args.method}, which knows no loads; expected "
            "--method weighted, ordinary, robust, ridge or tls"
        )
    if args.method == GAIN_METHOD and args.essential_below is not None:
        raise DataError(f"--essential-below: got it with --method {GAIN_METHOD}; leave it out")
    if args.model != "energy" and args.window is not None:
        raise DataError("--window: only windows of --model energy have a length; add that option")
    if args.model == "energy" and args.method not in OF_WINDOWS:
        raise DataError(
            f"--method {args.method}: got it with --model energy, whose rows are windows; expected "
            "--method weighted or ordinary"
        )
    if args.model == "energy" and args.payload_log:
        raise DataError(
            "--payload-log: the energy model takes logs without load; leave out --model energy"
        )


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
        from modeler.report.fit import write_fit  # pages take long to load

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
