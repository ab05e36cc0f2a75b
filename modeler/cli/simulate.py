"""`modeler simulate ROBOT --out LOG`."""

import argparse
from pathlib import Path

from modeler.cli.console import Json, progress, say
from modeler.cli.options import add_number
from modeler.cli.robots import add_robot, robot_of
from modeler.simulate import (
    HIDDEN,
    MOTIONS,
    SimulationSettings,
    check_suffix,
    hidden_from_text,
    simulate,
    told_hidden,
    write_log,
    write_truth,
)


def add_simulate(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler simulate`."""
    parser = commands.add_parser(
        "simulate",
        help="measurements by forward simulation in closed loop",
        description="Simulates ROBOT under a controller that sees quantised encoders, and writes "
        "the log that its logger would have written; a robot with loops carries out the commanded "
        "motion exactly. Parameters that the robot file leaves open are drawn from the seed.",
        epilog="example: modeler simulate demo-arm --duration 30 --seed 1 --out run1.parquet",
    )
    add_robot(parser)
    parser.add_argument(
        "--out", metavar="LOG", required=True, help="log to write, .parquet or .csv"
    )
    parser.add_argument("--truth", metavar="FILE", help="write the true parameters as JSON")
    _add_settings(parser, SimulationSettings())
    parser.add_argument(
        "--hide", metavar="EFFECT[@JOINT][:NAME=VALUE,...]", action="append", default=[],
        help="physics that the machine has and the robot file lacks; may be repeated; joint and "
        f"values left out are drawn from --parameter-seed: {', '.join(HIDDEN)}",
    )  # fmt: skip
    parser.add_argument("--json", metavar="FILE", help="write what was simulated for machines")
    parser.set_defaults(run=run_simulate)


def _add_settings(parser: argparse.ArgumentParser, default: SimulationSettings) -> None:
    parser.add_argument(
        "--motion", choices=MOTIONS, default=default.motion,
        help="exciting: at several speeds, and a Fourier series; point-to-point: as fast as "
        "[limits] allow (default %(default)s)",
    )  # fmt: skip
    add_number(parser, "--duration", "S", float, "seconds", default.duration)
    add_number(parser, "--rate", "HZ", float, "samples per second", default.rate)
    add_number(parser, "--seed", "N", int, "of motion and noise", default.seed)
    add_number(
        parser, "--parameter-seed", "N", int,
        "of parameters the file leaves open", default.parameter_seed,
    )  # fmt: skip
    add_number(
        parser, "--noise", "SHARE", float,
        "torque noise, share of the rms torque", default.torque_noise,
    )  # fmt: skip
    add_number(
        parser, "--process-noise", "SHARE", float,
        "random torque on the machine, share of the rms torque", default.process_noise,
    )  # fmt: skip
    add_number(
        parser, "--encoder-counts", "N", int,
        "per turn, 0 for an ideal encoder", default.encoder_counts,
    )  # fmt: skip


def run_simulate(args: argparse.Namespace) -> Json:
    """Simulates and writes the log."""
    check_suffix(Path(args.out))
    robot = robot_of(args)
    settings = SimulationSettings(
        motion=args.motion,
        duration=args.duration,
        rate=args.rate,
        seed=args.seed,
        parameter_seed=args.parameter_seed,
        torque_noise=args.noise,
        encoder_counts=args.encoder_counts,
        process_noise=args.process_noise,
        hidden=tuple(hidden_from_text(text) for text in args.hide),
    )
    with progress(f"simulating {robot.name}") as report:
        log = simulate(robot, settings, report)
    write_log(Path(args.out), log)
    if args.truth is not None:
        write_truth(Path(args.truth), log)
    drawn = f", {len(log.truth.drawn)} parameters drawn" if log.truth.drawn else ""
    say(f"{robot.name}: {len(log.time)} samples of {len(log.joints)} joints{drawn}")
    for effect in log.truth.hidden:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        say(f"hidden: {effect.effect}{where}: {values}")
    say(f"written: {args.out}")
    return {
        "robot": robot.name,
        "samples": len(log.time),
        "joints": list(log.joints),
        "parameters": dict(log.truth.parameters),
        "drawn": list(log.truth.drawn),
        "hidden": told_hidden(log),
    }
