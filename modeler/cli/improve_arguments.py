"""What is typed after diagnose, add, excite, simulate and completion."""

import argparse

from modeler.cli.options import (
    Commands,
    Run,
    add_json,
    add_map,
    add_number,
    add_page,
    add_robot,
    add_several,
)
from modeler.cli.places import (
    LogFile,
    ModelFile,
    MotionFile,
    MotionOrKind,
    NewLog,
    Output,
    RobotOrModel,
    Word,
)
from modeler.core.builtin import EFFECTS, MOTIONS, SIMULATED


def add_diagnose(commands: Commands) -> None:
    """`modeler diagnose`."""
    parser = commands.add_parser(
        "diagnose",
        help="which physical effect is missing",
        description="Looks for the physical effects that MODEL lacks on the logs: which, on which "
        "joint, how large, what adding them would gain on motion not used for the fit, what they "
        "could be mistaken for, and what these logs cannot show.",
        epilog="example: modeler diagnose arm.model.json train.parquet --holdout other.parquet",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "logs", metavar="LOG", nargs="+", type=LogFile,
        help="logs to explain; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    add_several(
        parser,
        "--holdout",
        "LOG",
        LogFile,
        "logs of other motion: errors come from them, nothing is fitted to them",
    )
    parser.add_argument(
        "--without", metavar="EFFECT[@J]", action="append", default=[], type=Word,
        help="an effect that this robot does not have, on one joint or at all",
    )  # fmt: skip
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_diagnose)


def _diagnose() -> Run:
    from modeler.cli.diagnose import run_diagnose

    return run_diagnose


# `modeler add MODEL EFFECT LOG... --out MODEL2`.


def add_add(commands: Commands) -> None:
    """`modeler add`."""
    parser = commands.add_parser(
        "add",
        help="put a physical effect into a model and watch the error fall",
        description="Adds EFFECT to the robot of MODEL, derives and emits it anew, fits it to the "
        "logs and shows the error before and after. EFFECT may also be `auto`: all that `modeler "
        "diagnose` names, or `undo`: without the last one.",
        epilog="example: modeler add arm.model.json load_friction --joint 2 train.parquet "
        "--holdout other.parquet --out arm2.model.json",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "effect", metavar="EFFECT", type=Word, help="see `modeler effects`; auto; undo"
    )
    parser.add_argument("logs", metavar="LOG", nargs="+", type=LogFile, help="logs to fit to")
    parser.add_argument("--joint", metavar="J", type=Word, help="default: where it explains most")
    parser.add_argument(
        "--out", metavar="MODEL2", required=True, type=Output, help="model file to write"
    )
    add_several(parser, "--holdout", "LOG", LogFile, "logs of other motion to judge on")
    parser.add_argument("--robot", metavar="FILE", type=Output, help="write the new robot file too")
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_add)


def _add() -> Run:
    from modeler.cli.add import run_add

    return run_add


# `modeler excite ROBOT --out MOTION`.


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


# `modeler simulate ROBOT --out LOG`.


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
    _add_settings(parser)
    parser.add_argument(
        "--hide", metavar="EFFECT[@JOINT][:NAME=VALUE,...]", action="append", default=[], type=Word,
        help="physics that the machine has and the robot file lacks; may be repeated; joint and "
        f"values left out are drawn from --parameter-seed: {', '.join(EFFECTS)}",
    )  # fmt: skip
    parser.add_argument(
        "--drive-gain", metavar="JOINT=VALUE", action="append", default=[], type=Word,
        help="true torque per drive unit of a joint; its current is logged in place of its torque; "
        "may be repeated",
    )  # fmt: skip
    add_json(parser, "write what was simulated for machines")
    parser.set_defaults(load=_simulate)


def _add_settings(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--motion", metavar="MOTION", type=MotionOrKind, default=MOTIONS[0],
        help="exciting: at several speeds, and a Fourier series; point-to-point: as fast as "
        "[limits] allow; one-joint: one after the other alone; or a file of `modeler excite` or a "
        "log, whose (commanded) positions are then the motion, as long as it is (default "
        "%(default)s)",
    )  # fmt: skip
    add_number(
        parser, "--duration", "S", float,
        f"seconds (default {SIMULATED['duration']:g}); not of a file, which is as long as it is",
    )  # fmt: skip
    add_number(parser, "--rate", "HZ", float, "samples per second", SIMULATED["rate"])
    add_number(parser, "--seed", "N", int, "of motion and noise", SIMULATED["seed"])
    add_number(
        parser, "--parameter-seed", "N", int,
        "of parameters the file leaves open", SIMULATED["parameter_seed"],
    )  # fmt: skip
    add_number(
        parser, "--noise", "SHARE", float,
        "torque noise, share of the rms torque", SIMULATED["torque_noise"],
    )  # fmt: skip
    add_number(
        parser, "--process-noise", "SHARE", float,
        "random torque on the machine, share of the rms torque", SIMULATED["process_noise"],
    )  # fmt: skip
    parser.add_argument(
        "--controller", action="store_true",
        help="a robot with loops is moved by a controller too, as others always are",
    )  # fmt: skip
    add_number(
        parser, "--encoder-counts", "N", int,
        "per turn, 0 for an ideal encoder", SIMULATED["encoder_counts"],
    )  # fmt: skip


def _simulate() -> Run:
    from modeler.cli.simulate import run_simulate

    return run_simulate


# `modeler completion SHELL`.


SHELLS = ("bash", "zsh", "fish")


def add_completion(commands: Commands) -> None:
    """`modeler completion`."""
    parser = commands.add_parser(
        "completion",
        help="a script that lets a shell complete what you type",
        description="Prints a script for bash, zsh or fish: with it, the Tab key completes "
        "commands, options, built-in robots, effects, and files of the right kind.",
        epilog='example: eval "$(modeler completion bash)"',
    )
    parser.add_argument("shell", metavar="SHELL", choices=SHELLS, help=", ".join(SHELLS))
    parser.add_argument(
        "--words", nargs=argparse.REMAINDER, type=Word, help=argparse.SUPPRESS
    )  # what the scripts call: the line so far, its last word unfinished
    add_json(parser, "write the script for machines")
    parser.set_defaults(load=_completion)


def _completion() -> Run:
    from modeler.cli.completion import run_completion

    return run_completion
