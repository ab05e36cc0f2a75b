"""`modeler simulate ROBOT --out LOG`."""

import argparse
import math
from pathlib import Path

from modeler.cli.console import Json, progress, say
from modeler.cli.lists import robot_of
from modeler.core.builtin import MOTIONS
from modeler.core.errors import DataError
from modeler.core.table import percent
from modeler.robot.robot import Robot
from modeler.simulation import (
    KEPT,
    Reference,
    SimulationSettings,
    at_rate,
    check_suffix,
    drive_gains,
    hidden_from_text,
    read_motion,
    simulate,
    told_hidden,
    write_log,
    write_truth,
)


def run_simulate(args: argparse.Namespace) -> Json:
    """Simulates and writes the log."""
    check_suffix(Path(args.out))
    robot = robot_of(args)
    settings = SimulationSettings(
        motion=args.motion if args.motion in MOTIONS else "exciting",
        duration=_duration(args),
        rate=args.rate,
        seed=args.seed,
        parameter_seed=args.parameter_seed,
        torque_noise=args.noise,
        encoder_counts=args.encoder_counts,
        process_noise=args.process_noise,
        controller=args.controller,
        hidden=tuple(hidden_from_text(text) for text in args.hide),
        drive_gains=drive_gains(args.drive_gain, robot),
        commanded=None if args.motion in MOTIONS else _commanded(args, robot),
    )
    try:
        with progress(f"simulating {robot.name}") as report:
            log = simulate(robot, settings, report)
    except DataError as error:
        raise error if args.motion in MOTIONS else DataError(f"{args.motion}: {error}") from None
    write_log(Path(args.out), log)
    if args.truth is not None:
        write_truth(Path(args.truth), log)
    drawn = f", {len(log.truth.drawn)} parameters drawn" if log.truth.drawn else ""
    say(f"{robot.name}: {len(log.time)} samples of {len(log.joints)} joints{drawn}")
    for effect in log.truth.hidden:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        say(f"hidden: {effect.effect}{where}: {values}")
    _say_narrowed(log.range_share)
    say(f"written: {args.out}")
    return {
        "robot": robot.name,
        "samples": len(log.time),
        "joints": list(log.joints),
        "parameters": dict(log.truth.parameters),
        "drawn": list(log.truth.drawn),
        "hidden": told_hidden(log),
        "range_share": log.range_share,
    }


def _duration(args: argparse.Namespace) -> float:
    """Of a motion that is made; a file has its own."""
    if args.duration is None:
        return SimulationSettings().duration
    if args.motion not in MOTIONS:
        raise DataError(
            f"--duration: got {args.duration:g} s with --motion {args.motion}, which is as long as "
            "it is; leave --duration out"
        )
    return float(args.duration)


def _commanded(args: argparse.Namespace, robot: Robot) -> Reference:
    """The motion of the file, at the rate that is asked for."""
    if not (math.isfinite(args.rate) and args.rate > 0.0):
        raise DataError(f"--rate: got {args.rate:g}; expected a number above 0")
    return at_rate(read_motion(args.motion, [joint.name for joint in robot.coordinates]), args.rate)


def _say_narrowed(share: float) -> None:
    """How much of its range a motion was given, if not all."""
    if share < 1.0:
        say(f"motion: within {percent(share)} of the way from [home] to the limits: farther, the "
            f"loops come nearer than {percent(KEPT)} of home's distance to a singular posture, or "
            "do not close")  # fmt: skip
