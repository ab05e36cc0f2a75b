"""`modeler fit ROBOT LOG... --out MODEL` and `modeler compare MODEL LOG...`."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from modeler.api import compile_model, derive, generate, identified, read_logs, recompile
from modeler.cli.console import Json, progress, say, working
from modeler.cli.options import add_number
from modeler.cli.robots import add_robot, robot_of
from modeler.compare import Comparison, compare, verdict, write_pictures, write_report
from modeler.compare.predict import predict
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.fit import (
    IdentifiedModel,
    Payload,
    doubts,
    identify,
    identify_with_payloads,
    load_model,
    save_model,
)
from modeler.observation import Log, Processing, observe
from modeler.observation.log import shared_rows

_LOGS = "Parquet or CSV logs; FILE@START:END takes the rows between these seconds"

_TRAINING = "training only: "

Given = tuple[str, Log]
"""A log and what the user typed for it."""


def add_fit(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler fit`."""
    parser = commands.add_parser(
        "fit",
        help="estimate the base parameters from logs",
        description="Filters the logs, builds the observation matrix and estimates the base "
        "parameters of ROBOT: value, sigma, %sigma, errors per joint; saves a model file.",
        epilog="example: modeler fit ur10e run1.parquet run2.parquet --out ur10e.model.json",
    )
    add_robot(parser)
    parser.add_argument("logs", metavar="LOG", nargs="+", help=_LOGS)
    parser.add_argument("--out", metavar="MODEL", required=True, help="model file to write")
    parser.add_argument(
        "--method",
        choices=("weighted", "ordinary"),
        default="weighted",
        help="least squares with one weight per joint, iterated, or without weights",
    )
    _add_processing(parser)
    _add_load(parser)
    parser.add_argument("--json", metavar="FILE", help="write the result for machines")
    parser.set_defaults(run=run_fit)


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
        choices=("auto", "log", "position"),
        default="auto",
        help="logged velocities, or positions differentiated; auto: the quieter",
    )
    add_number(
        group, "--low-speed", "SHARE", float,
        "leave out rows below this share of the joint's top speed, where the sign of the speed is "
        "doubtful",
        Processing.low_speed,
    )  # fmt: skip
    group.add_argument(
        "--keep-saturated", action="store_true", help="use rows whose torque is stuck at its limit"
    )
    group.add_argument(
        "--keep-contradicted",
        action="store_true",
        help="use rows whose logged derivatives contradict the signals below them",
    )


def _add_load(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("load", "some of the logs carry a load on a link")
    group.add_argument(
        "--payload-log",
        metavar="LOG",
        action="append",
        default=[],
        help="a further log, with the load; may be given several times",
    )
    add_number(group, "--payload-mass", "KG", float, "its mass, if it is known")
    group.add_argument(
        "--payload-link", metavar="J", help="the link that carries it; default: the last"
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
    )


def run_fit(args: argparse.Namespace) -> Json:
    """Fits, prints the table, saves the model."""
    _check_out(args)
    _check_load(args)
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        emitted = generate(derivation)
        compiled = compile_model(emitted)
    with working("building the observation matrix"):
        logs = read_logs(compiled, args.logs)
        loaded = read_logs(compiled, args.payload_log)
        _check_logs(_given(args.logs, logs), _given(args.payload_log, loaded))
        observation = observe(compiled, [*logs, *loaded], _processing(args))
    if loaded:
        payload = Payload(tuple(log.name for log in loaded), args.payload_link, args.payload_mass)
        result = identify_with_payloads(compiled, observation, [payload], args.method)
    else:
        result = identify(observation, args.method)
    save_model(args.out, identified(derivation, emitted, observation, result))
    doubtful = doubts(emitted.spec, result)
    for line in (*observation.report.summary(), "", *result.summary(), *doubtful):
        say(line)
    say(f"written: {args.out}")
    return result.to_json() | {"doubts": list(doubtful)}


def _given(places: Sequence[str], logs: Sequence[Log]) -> list[Given]:
    return list(zip(places, logs, strict=True))


def _check_out(args: argparse.Namespace) -> None:
    """A model never takes the place of a measurement."""
    out = Path(args.out)
    taken = {Path(place.rpartition("@")[0] or place).resolve() for place in args.logs}
    if out.suffix.lower() in (".csv", ".parquet") or out.resolve() in taken:
        raise DataError(
            f"--out {args.out}: this is the name of a log; expected a model file, as in "
            f"{out.with_suffix('.model.json').name}"
        )


def _check_load(args: argparse.Namespace) -> None:
    for option in ("payload_mass", "payload_link"):
        if getattr(args, option) is not None and not args.payload_log:
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


def add_compare(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler compare`."""
    parser = commands.add_parser(
        "compare",
        help="measured against predicted torque: how good, where it fails",
        description="Predicts the torques of the logs with MODEL and shows per joint how good it "
        "is, where it fails, and whether the rest still has structure.",
        epilog="example: modeler compare ur10e.model.json held_out.parquet --report page.html",
    )
    parser.add_argument("model", metavar="MODEL", help="a model file of `modeler fit`")
    parser.add_argument("logs", metavar="LOG", nargs="+", help=_LOGS)
    parser.add_argument("--report", metavar="PAGE.html", help="write one self-contained page")
    parser.add_argument("--pictures", metavar="DIR", help="write every picture as PNG, SVG and CSV")
    parser.add_argument(
        "--run-embedded-c",
        action="store_true",
        help="compile the C in MODEL instead of emitting it anew: only for files that you trust",
    )
    parser.add_argument("--json", metavar="FILE", help="write the result for machines")
    parser.set_defaults(run=run_compare)


def run_compare(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes page and pictures."""
    model = load_model(args.model)
    with working("predicting"):
        compiled = model.compile() if args.run_embedded_c else recompile(model)
        comparison, lines = judged(model, args.logs, compiled)
    say(comparison.summary())
    say()
    for sentence in verdict(comparison):
        say(sentence)
    for line in lines:
        if line.startswith(_TRAINING):
            say(line)
    if args.report is not None:
        with working("drawing the page"):
            place = write_report(Path(args.report), comparison, lines)
        say(f"written: {place}")
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_pictures(Path(args.pictures), comparison, bar)
        say(f"written: {len(written)} files in {args.pictures}")
    return comparison.as_dict()


def judged(
    model: IdentifiedModel, logs: list[str], compiled: CompiledModel
) -> tuple[Comparison, list[str]]:
    """The comparison on logs, and where everything came from, in lines."""
    read = read_logs(compiled, logs)
    _check_logs(_given(logs, read), [])
    prediction, observation = predict(model, read, compiled)
    fitted = ", ".join(log.name for log in model.logs)
    lines = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, {model.fit.method} least "
        f"squares on {fitted}; relative error there {100 * model.fit.relative_error:.2f} %"
    ]
    return compare(prediction), lines + _training(model, read) + observation.report.summary()


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
