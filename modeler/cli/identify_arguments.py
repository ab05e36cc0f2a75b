"""What is typed after the commands on logs: fit, compare, log, estimators, free-run, fleet."""

import argparse
from typing import get_args

from modeler.cli.options import (
    Commands,
    Run,
    add_dask,
    add_json,
    add_map,
    add_number,
    add_page,
    add_robot,
    add_several,
)
from modeler.cli.places import (
    ListFile,
    LogFile,
    LogPictures,
    ModelFile,
    Output,
    PageOrFolder,
    PictureFolder,
    RobotFile,
    Word,
    model_or_log,
)
from modeler.core.errors import GAIN_METHOD, LOW_SPEED, TWO_STEPS, Derivatives, Method, ModelKind
from modeler.core.estimators import ABOUT, APART

_LOGS = (
    "Parquet, CSV, MAT, HDF5 or MCAP logs, ROS bags; FILE@START:END takes the rows between these "
    "seconds"
)


def add_fit(commands: Commands) -> None:
    """`modeler fit`."""
    parser = commands.add_parser(
        "fit",
        help="estimate the base parameters from logs",
        description="Filters the logs, builds the observation matrix and estimates the base "
        "parameters of ROBOT: value, sigma, %sigma, errors per joint; saves a model file.",
        epilog="example: modeler fit ur10e run1.parquet run2.parquet --out ur10e.model.json",
    )
    add_robot(parser)
    parser.add_argument("logs", metavar="LOG", nargs="+", type=LogFile, help=_LOGS)
    add_map(parser)
    parser.add_argument(
        "--out", metavar="MODEL", required=True, type=Output, help="model file to write"
    )
    parser.add_argument(
        "--method",
        choices=(*get_args(Method), GAIN_METHOD, TWO_STEPS),
        default="weighted",
        help="; ".join(f"{a.id}: {a.title}" for a in (*ABOUT.values(), *APART))
        + "; `modeler estimators` says when each is the wrong one (default %(default)s)",
    )
    parser.add_argument(
        "--robot-out",
        metavar="FILE.toml",
        type=Output,
        help="write the robot file with the values found, for simulators (--method consistent), "
        "or with the drive gains found (--method tls)",
    )
    _add_model(parser)
    _add_processing(parser)
    _add_load(parser)
    add_dask(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_fit)


def _add_model(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--model",
        choices=get_args(ModelKind),
        default="torque",
        help="one equation a joint and sample, or the energy balance of windows (default "
        "%(default)s)",
    )
    add_number(
        parser, "--window", "S", float,
        "length of a window of --model energy; left out: the spacing of the torque model's rows",
    )  # fmt: skip
    add_number(
        parser, "--essential-below", "PERCENT", float,
        "keep in the reduced model what has a sigma below this share of its value (papers: 15); "
        "left out: what an F-test misses",
    )  # fmt: skip


def _add_processing(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("processing", "chosen from the logs and told where left out")
    add_number(group, "--cutoff", "HZ", float,
               "low-pass of the positions (zero phase, Butterworth order 4)")  # fmt: skip
    add_number(
        group, "--parallel-cutoff", "HZ", float, "the one low-pass of torques and all columns"
    )
    add_number(group, "--decimate", "N", int, "keep every N-th row after it")
    group.add_argument(
        "--derivatives",
        choices=get_args(Derivatives),
        default="auto",
        help="logged velocities, or positions differentiated; auto: the quieter",
    )
    add_number(
        group, "--low-speed", "SHARE", float,
        "leave out rows below this share of the joint's top speed, where the sign of the speed is "
        "doubtful",
        LOW_SPEED,
    )  # fmt: skip
    group.add_argument(
        "--keep-saturated", action="store_true", help="use rows whose torque is stuck at its limit"
    )
    group.add_argument(
        "--keep-contradicted",
        action="store_true",
        help="use rows whose logged derivatives contradict the signals below them",
    )
    group.add_argument(
        "--keep-damaged",
        action="store_true",
        help="use leaps, spikes and repeated values, which no robot can have made, as logged",
    )


def _add_load(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("load", "some of the logs carry a load on a link")
    group.add_argument(
        "--payload-log",
        metavar="LOG",
        action="append",
        default=[],
        type=LogFile,
        help="a further log, with the load; may be given several times",
    )
    add_number(group, "--payload-mass", "KG", float, "its mass, if it is known")
    group.add_argument(
        "--payload-moved",
        action="store_true",
        help="it was taken off between the loaded logs: the same mass, but its own centre and "
        "inertia in each",
    )
    group.add_argument(
        "--payload-link", metavar="J", type=Word,
        help="the link that carries it; default: the last",
    )  # fmt: skip


def _fit() -> Run:
    from modeler.cli.fit import run_fit

    return run_fit


def add_compare(commands: Commands) -> None:
    """`modeler compare`."""
    parser = commands.add_parser(
        "compare",
        help="measured against predicted torque: how good, where it fails",
        description="Predicts the torques of the logs with MODEL and shows per joint how good it "
        "is, where it fails, and whether the rest still has structure. Of several models: whose "
        "error is smaller on which joint, and where that is beyond doubt.",
        epilog="example: modeler compare ur10e.model.json held_out.parquet --report page.html; "
        "modeler compare ur10e.model.json better.model.json held_out.parquet",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "logs", metavar="LOG", nargs="+", type=model_or_log,
        help=f"{_LOGS}; before them perhaps further models, which are set beside the first",
    )  # fmt: skip
    add_map(parser)
    add_page(parser, PageOrFolder)
    parser.add_argument(
        "--pictures", metavar="DIR", type=PictureFolder,
        help="write every picture as PNG, SVG and CSV",
    )  # fmt: skip
    parser.add_argument(
        "--essential",
        action="store_true",
        help="predict with the reduced model of the fit: its essential parameters, all others 0",
    )
    parser.add_argument(
        "--run-embedded-c",
        action="store_true",
        help="compile the C in MODEL instead of emitting it anew: only for files that you trust",
    )
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_compare)


def _compare() -> Run:
    from modeler.cli.compare import run_compare

    return run_compare


# `modeler log FILE`.


def add_log(commands: Commands) -> None:
    """`modeler log`."""
    parser = commands.add_parser(
        "log",
        help="what is in a log: channels, rates, gaps, doubts, pictures",
        description="Lists what FILE holds: topics and columns, rate, jitter, gaps, ranges, "
        "resolution, missing values, limits. Names doubts, and suggests a [log] to start from, "
        "guessed from names and ranges. With a robot: fits it, and says what contradicts it.",
        epilog="example: modeler log run1.mat --robot arm.toml --page run1.html",
    )
    parser.add_argument(
        "log", metavar="FILE", type=LogFile,
        help="Parquet, CSV, MAT, HDF5, numpy or MCAP file, or ROS bag; FILE@START:END takes the "
        "rows between these seconds",
    )  # fmt: skip
    parser.add_argument(
        "--robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot: its [log], its joints, and doubts "
        "that a fit shows",
    )  # fmt: skip
    add_map(parser)
    parser.add_argument("--page", metavar="PAGE.html", type=Output, help="write one page")
    parser.add_argument(
        "--pictures", metavar="DIR", type=LogPictures,
        help="write every picture as PNG, SVG and CSV",
    )  # fmt: skip
    add_json(parser, "write what is in it for machines")
    parser.set_defaults(load=_log)


def _log() -> Run:
    from modeler.cli.log import run_log

    return run_log


# `modeler estimators [ROBOT LOG...]`.


def add_estimators(commands: Commands) -> None:
    """`modeler estimators`."""
    parser = commands.add_parser(
        "estimators",
        help="the ways to estimate, and all of them on the same logs",
        description="Lists the estimators of `modeler fit --method`: law, source, and when not to "
        "use each. With ROBOT and logs, fits all of them to the same rows and shows values, "
        "errors, seconds and warnings side by side; no model is written.",
        epilog="example: modeler estimators emps train.parquet --holdout pulses.parquet",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", nargs="?", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "logs", metavar="LOG", nargs="*", type=LogFile,
        help="logs to fit; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    parser.add_argument(
        "--effects", metavar="LIST", type=Word,
        help='effects instead of those of the file, for all joints: "viscous,coulomb"',
    )  # fmt: skip
    add_several(
        parser, "--holdout", "LOG", LogFile, "logs of other motion, not fitted: their error"
    )
    parser.add_argument(
        "--methods", metavar="LIST", type=Word,
        help="some of them, with commas between; default: all",
    )  # fmt: skip
    add_map(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_estimators)


def _estimators() -> Run:
    from modeler.cli.estimators import run_estimators

    return run_estimators


# `modeler free-run MODEL LOG...`.


def add_free_run(commands: Commands) -> None:
    """`modeler free-run`."""
    parser = commands.add_parser(
        "free-run",
        help="positions that the fitted robot takes under the logged torques",
        description="Simulates the robot of MODEL under the torques of the logs, window after "
        "window from the measured state, and compares positions: fit per joint, how long the error "
        "stays within a bound, and whether errors grow by the robot's nature whatever the model. "
        "Where commanded positions were logged, also under a controller that follows them.",
        epilog="example: modeler free-run ur10e.model.json held_out.parquet --pictures free_run",
    )
    parser.add_argument(
        "model", metavar="MODEL", type=ModelFile, help="a model file of `modeler fit`"
    )
    parser.add_argument(
        "logs", metavar="LOG", nargs="+", type=LogFile,
        help="logs; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    add_number(parser, "--window", "S", float, "seconds from one measured state to the next", 1.0)
    add_number(
        parser, "--bound", "SHARE", float,
        "of a joint's range of motion: an error above it ends the horizon", 0.05,
    )  # fmt: skip
    parser.add_argument(
        "--controller", metavar="HZ,RATIO[,INTEGRAL[,FORWARD]]", type=Word,
        help="the controller that follows the commands: speed loop, ratio of the position loop to "
        "it, integral action and feedforward (1 or 0); default: the one that comes nearest",
    )  # fmt: skip
    parser.add_argument(
        "--pictures", metavar="DIR", type=PictureFolder,
        help="write every picture as PNG, SVG and CSV",
    )  # fmt: skip
    add_map(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_free_run)


def _free_run() -> Run:
    from modeler.cli.free_run import run_free_run

    return run_free_run


# `modeler fleet ROBOT LOG...`.


def add_fleet(commands: Commands) -> None:
    """`modeler fleet`."""
    parser = commands.add_parser(
        "fleet",
        help="one robot kind, many machines and days: what drifts where",
        description="Fits all logs of machines of one kind together: inertial parameters in "
        "common, friction, offset and drive gain of every joint log by log. Says which of them "
        "drifts, leaps, or is apart from those of the other machines, beyond doubt.",
        epilog="example: modeler fleet ur10e plant/*/*.parquet --page fleet.html",
    )
    add_robot(parser)
    parser.add_argument(
        "logs", metavar="LOG", nargs="*", type=LogFile,
        help="logs, or folders of logs; FILE@START:END takes the rows between these seconds",
    )  # fmt: skip
    _add_names(parser)
    add_map(parser)
    group = parser.add_argument_group("processing", "chosen from the first log, for all alike")
    add_number(group, "--cutoff", "HZ", float, "low-pass of the positions")
    add_number(
        group, "--parallel-cutoff", "HZ", float, "the one low-pass of torques and all columns"
    )
    add_workers(parser)
    add_page(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_fleet)


def _add_names(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("names", "which machine and period a log is of")
    group.add_argument(
        "--name", metavar="PATTERN", type=Word,
        help="how paths end, as '{machine}-{period}.csv'; left out: the folder is the machine, the "
        "file the period",
    )  # fmt: skip
    group.add_argument(
        "--list", metavar="FILE", type=ListFile,
        help="logs by name, in place of LOG: .csv with machine, period, log in its first line, or "
        ".toml with [[log]] tables",
    )  # fmt: skip


def add_workers(parser: argparse.ArgumentParser) -> None:
    """`--workers` and `--dask`, of commands that read many logs."""
    group = parser.add_argument_group("workers")
    add_number(
        group, "--workers", "N", int,
        "processes that read logs; left out: one for few logs, all processors for many",
    )  # fmt: skip
    add_dask(group)


def _fleet() -> Run:
    from modeler.cli.fleet import run_fleet

    return run_fleet
