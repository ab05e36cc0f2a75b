"""`modeler simulate ROBOT --out LOG`."""

import argparse

from modeler.cli.parsers.options import Commands, Run, add_json, add_number, add_robot
from modeler.cli.places import MotionOrKind, NewLog, Output, Word
from modeler.effects import CATALOGUE
from modeler.simulate.settings import SimulationSettings


def add_simulate(commands: Commands) -> None:
    """`modeler simulate`."""
    parser = commands.add_parser(
        "simulate",
        help="measurements by forward simulation in closed loop",
        description="Simulates ROBOT under a controller that sees quantised encoders, and writes "
        "the log that its logger would have written; a robot with loops carries out the commanded "
        "motion exactly, unless --controller is given. Parameters that the robot file leaves open "
        "are drawn from the seed.",
        epilog="example: modeler simulate demo-arm --duration 30 --seed 1 --out run1.parquet",
    )
    add_robot(parser)
    parser.add_argument(
        "--out", metavar="LOG", required=True, type=NewLog, help="log to write, .parquet or .csv"
    )
    parser.add_argument(
        "--truth", metavar="FILE", type=Output, help="write the true parameters as JSON"
    )
    _add_settings(parser, SimulationSettings())
    parser.add_argument(
        "--hide", metavar="EFFECT[@JOINT][:NAME=VALUE,...]", action="append", default=[], type=Word,
        help="physics that the machine has and the robot file lacks; may be repeated; joint and "
        f"values left out are drawn from --parameter-seed: {', '.join(e.id for e in CATALOGUE)}",
    )  # fmt: skip
    parser.add_argument(
        "--drive-gain", metavar="JOINT=VALUE", action="append", default=[], type=Word,
        help="true torque per drive unit of a joint; its current is logged in place of its torque; "
        "may be repeated",
    )  # fmt: skip
    add_json(parser, "write what was simulated for machines")
    parser.set_defaults(load=_simulate)


def _add_settings(parser: argparse.ArgumentParser, default: SimulationSettings) -> None:
    parser.add_argument(
        "--motion", metavar="MOTION", type=MotionOrKind, default=default.motion,
        help="exciting: at several speeds, and a Fourier series; point-to-point: as fast as "
        "[limits] allow; one-joint: one after the other alone; or a file of `modeler excite` or a "
        "log, whose (commanded) positions are then the motion, as long as it is (default "
        "%(default)s)",
    )  # fmt: skip
    add_number(
        parser, "--duration", "S", float,
        f"seconds (default {default.duration:g}); not of a file, which is as long as it is",
    )  # fmt: skip
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
    parser.add_argument(
        "--controller", action="store_true",
        help="a robot with loops is moved by a controller too, as others always are",
    )  # fmt: skip
    add_number(
        parser, "--encoder-counts", "N", int,
        "per turn, 0 for an ideal encoder", default.encoder_counts,
    )  # fmt: skip


def _simulate() -> Run:
    from modeler.cli.simulate import run_simulate

    return run_simulate
