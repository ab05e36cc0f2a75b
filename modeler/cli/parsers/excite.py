"""`modeler excite ROBOT --out MOTION`."""

import argparse

from modeler.cli.parsers.options import Commands, Run, add_json, add_number, add_several
from modeler.cli.places import MotionFile, NewLog, Output, RobotOrModel, Word


def add_excite(commands: Commands) -> None:
    """`modeler excite`."""
    parser = commands.add_parser(
        "excite",
        help="a motion within limits that tells the parameters apart",
        description="Finds a motion of ROBOT within its [limits] along which the parameters are "
        "well told apart, and writes it as a table for a controller or `modeler simulate "
        "--motion`. Of a MODEL: its essential parameters, its torque noise. With --between: the "
        "motion that tells two effects apart. With --choose: the best of motions that there are.",
        epilog="example: modeler excite panda --duration 10 --out motion.csv --picture motion.png",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotOrModel,
        help="a robot file, the name of a built-in robot, or a model file of `modeler fit`",
    )  # fmt: skip
    parser.add_argument(
        "--effects", metavar="LIST", type=Word,
        help='effects instead of those of the file, for all joints: "viscous,coulomb"; "" for none',
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="MOTION", type=NewLog,
        help="motion to write, .csv or .parquet: time, q, qd and qdd of every joint",
    )  # fmt: skip
    parser.add_argument(
        "--picture", metavar="FILE", type=Output,
        help="draw it against its limits, .png, .svg or .pdf",
    )  # fmt: skip
    _add_motion(parser)
    _add_limits(parser)
    parser.add_argument(
        "--between", metavar="EFFECT@J,EFFECT@J", type=Word,
        help="make what the first effect alone explains large, and the second: of a MODEL",
    )  # fmt: skip
    _add_choice(parser)
    add_json(parser, "write what was found for machines")
    parser.set_defaults(load=_excite)


def _add_motion(parser: argparse.ArgumentParser) -> None:
    add_number(parser, "--duration", "S", float, "seconds, from rest to rest", 10.0)
    add_number(parser, "--laps", "N", int, "times that this motion is driven in MOTION", 1)
    add_number(parser, "--rate", "HZ", float, "samples per second of MOTION", 200.0)
    add_number(
        parser, "--harmonics", "N", int, "of the Fourier series; default: 5 to 10, by the limits"
    )
    parser.add_argument(
        "--objective", choices=("both", "condition", "information"), default="both",
        help="condition: the condition number, columns of length one; information: log det of "
        "the information matrix; both: the sum of their logarithms (default %(default)s)",
    )  # fmt: skip
    add_number(parser, "--starts", "N", int, "searches, from the best of 50 random motions", 6)
    add_number(parser, "--seed", "N", int, "of the random motions", 0)
    add_number(parser, "--time-limit", "S", float, "take the best after so many seconds")


def _add_limits(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--limit", metavar="J=LOWER,UPPER,SPEED,ACCELERATION[,TORQUE]", action="append",
        default=[], type=Word,
        help="of a joint, instead of those of the file, SI units; may be repeated; torques need "
        "values of the parameters",
    )  # fmt: skip
    parser.add_argument(
        "--box", metavar="FRAME=X0,X1,Y0,Y1,Z0,Z1", action="append", default=[], type=Word,
        help="where the origin of a frame must stay, m, in frame 0; may be repeated",
    )  # fmt: skip


def _add_choice(parser: argparse.ArgumentParser) -> None:
    add_number(parser, "--choose", "N", int, "take N of the motions of --from; takes no --out")
    add_several(parser, "--from", "LOG", MotionFile, "logs or motions to choose from", "candidates")


def _excite() -> Run:
    from modeler.cli.excite import run_excite

    return run_excite
