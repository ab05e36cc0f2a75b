"""`modeler excite ROBOT --out MOTION` and `modeler simulate ROBOT --out LOG`."""

import argparse
import math
from collections.abc import Sequence
from pathlib import Path

import modeler.api.motion as motions
from modeler import excitation, simulation
from modeler.api.motion import find_nearest_along
from modeler.api.thresholds import THRESHOLDS as API_THRESHOLDS
from modeler.cli.console import Json, print_lines, print_result, show_activity, show_progress
from modeler.cli.lists import resolve_robot
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.choices import MOTIONS
from modeler.core.errors import DataError
from modeler.core.expression import parse_expression
from modeler.core.files import write_atomically
from modeler.core.json import select_attributes
from modeler.core.table import format_percent
from modeler.estimation import load_model
from modeler.robot import Robot, suggest_name
from modeler.runtime import CompiledModel


def run_excite(args: argparse.Namespace) -> Json:
    """Finds a motion and writes it, or chooses among motions."""
    _check_usage(args)
    subject = _read_subject(args)
    encoders = motions.Encoders(args.encoder_counts or 0, args.position_noise or 0.0)
    if encoders != motions.Encoders():
        subject.check_known_noise("--encoder-counts, --position-noise: ")
    margin = args.clearance
    if margin is None and args.check is not None:
        margin = API_THRESHOLDS.link_clearance
    bounds = parse_bounds(subject.robot, subject.compiled, args.limit, args.box, margin)
    if args.report is not None and not (bounds.clearance and len(bounds.clearance.solids.pairs)):
        raise DataError(
            "--report: no two links are looked at; expected --clearance, or [capsules] of the "
            "robot file, and links that may meet"
        )
    if args.choose is not None:
        return _choose_motions(args, subject)
    if args.check is not None:
        return _check_motion(args, subject, bounds)
    recorded_logs = None
    if args.candidates:
        with show_activity("fitting the logs that there are"):
            recorded_logs = motions.fit_recorded_logs(subject, args.candidates)
        subject = recorded_logs.subject
    harmonics = args.harmonics
    if harmonics is None:
        harmonics = excitation.choose_harmonics(bounds, args.duration)
    wish = excitation.MotionRequest(
        args.duration, harmonics, args.objective or ("information" if recorded_logs else "both"),
        args.starts, args.seed, args.time_limit, args.laps, args.family,
    )  # fmt: skip
    extra: dict[str, Json] = {}
    with show_progress(f"looking for a motion of {subject.robot.name}") as bar:
        if args.between is not None:
            question = motions.parse_question(subject, args.between)
            motion, separation = excitation.design_discriminating_motion(
                subject.compiled, bounds, wish, question, bar
            )
            lines, extra = (
                [*separation.format_lines(), *motion.format_lines()[2:]],
                {"discrimination": separation.to_json()},
            )
        else:
            motion = subject.search_motion(
                bounds, wish, bar, recorded_logs.known_information if recorded_logs else None
            )
            if recorded_logs is not None:
                motion = recorded_logs.predict_gain(motion, args.rate, encoders)
            lines = motion.format_lines()
    if recorded_logs is None and subject.sigma is not None:
        with show_activity("forecasting sigmas"):
            forecast_text, extra["forecast"] = describe_expected_sigmas(
                subject, motion, args.rate, encoders
            )
        lines.append(forecast_text)
    print_lines(lines)
    columns = motion.sample_motion(args.rate)
    table = (
        excitation.format_csv(columns)
        if args.out.endswith(".csv")
        else excitation.encode_parquet(columns)
    )
    write_atomically(Path(args.out), table)
    print_result(
        f"written: {args.out}, {len(columns['time'])} samples, {motion.seconds:.1f} s of search"
    )
    _draw_nearest(args, subject.robot, bounds, motion.closest_approach)
    if args.picture is not None:
        with show_activity("drawing"):
            drawn = excitation.draw_motion(
                motion, subject.compiled, excitation.check_picture_kind(args.picture)
            )
        write_atomically(Path(args.picture), drawn)
        print_result(f"written: {args.picture}")
    return motion.to_json() | {"effects": [u.effect for u in subject.robot.effects]} | extra


def _check_motion(
    args: argparse.Namespace, subject: motions.Subject, bounds: excitation.MotionBounds
) -> Json:
    """Does the motion of a file keep to the limits, and do links keep their distance?"""
    clearance, joints = bounds.clearance, subject.compiled.spec.joints
    assert clearance is not None
    with show_activity(f"looking at {args.check}"):
        motion = simulation.read_motion(args.check, bounds.joints)
        stated = (motion.qd, motion.qdd) if motion.is_complete else None
        units = tuple(joint.unit for joint in joints)
        excess = excitation.find_exceeded_limits(bounds, units, motion.time, motion.q, stated)
        near = find_nearest_along(subject.compiled, clearance, motion)
    lines = [f"{args.check}: {each.format_line()}" for each in excess]
    print_lines(lines or [f"{args.check}: within the limits of position, speed and acceleration"])
    typed = {text.partition("=")[0] for text in args.limit}
    if assumed := [name for name in bounds.joints if name not in {*subject.robot.limits, *typed}]:
        print_result(
            f"joint {', '.join(assumed)}: no [limits] in the robot file; these are assumed"
        )
    print_result(f"{args.check}: {clearance.format_line(near)}")
    _draw_nearest(args, subject.robot, bounds, near)
    if near is not None and near.bound < clearance.margin:
        raise DataError(
            f"{args.check}, {near.time:.4g} s: {near.pair[0]} and {near.pair[1]} are "
            f"{1e3 * near.distance:.1f} mm apart; expected {1e3 * clearance.margin:g} mm or more; "
            "take "
            "another motion, or a smaller --clearance"
        )
    wrong = [each for each in excess if not (motion.is_measured and "speed at" in each.quantity)]
    if wrong:
        raise DataError(
            f"{args.check}, {wrong[0].format_line()}; limits exceeded: {len(wrong)}; take another "
            "motion, "
            "or state other limits: [limits] of the robot file, or --limit"
        )
    exceeded = [each.to_json() for each in excess]
    return {
        "robot": subject.robot.name,
        "clearance": clearance.to_json(near),
        "exceeded_limits": exceeded,
    }


def _draw_nearest(
    args: argparse.Namespace, robot: Robot, bounds: excitation.MotionBounds,
    near: excitation.ClosestApproach | None,
) -> None:  # fmt: skip
    """The page of the robot where two come nearest, if it is wanted and there are two."""
    if args.report is not None and near is not None:
        from modeler.views import render_nearest_page  # which takes long to load

        write_atomically(Path(args.report), render_nearest_page(robot, bounds, near))
        print_result(f"written: {args.report}")


def describe_expected_sigmas(
    subject: motions.Subject,
    motion: excitation.ExcitingMotion,
    rate: float,
    encoders: motions.Encoders,
) -> tuple[str, Json | None]:
    """Describes the expected sigmas of a motion: a sentence, and values for JSON."""
    about = (
        f"forecast of a log at {rate:g} Hz, {encoders.describe()}, torques as noisy as the model's"
    )
    try:
        fit = subject.predict_fit(motion, rate, encoders)
    except DataError as error:
        return f"{about}: it cannot be fitted: {error}", None
    shares = {p.name: p.relative_sigma_percent for p in fit.parameters}
    sure = [
        name
        for name, share in shares.items()
        if share is not None and share < THRESHOLDS.max_determined_sigma
    ]
    worse = sorted(set(shares) - set(sure), key=lambda name: -(shares[name] or math.inf))
    uncertain = [
        f"{name} ({'not determined' if shares[name] is None else f'{shares[name]:.3g} %'})"
        for name in worse[: THRESHOLDS.named_parameters]
    ]
    chosen = fit.processing
    sentence = (
        f"{about}: the fit filters positions at {chosen.position_cutoff:g} Hz and torques at "
        f"{chosen.parallel_cutoff:g} Hz; sigma is below {THRESHOLDS.max_determined_sigma:g} % for "
        f"{len(sure)} of {len(shares)} parameters"
        f"{'; least sure: ' * bool(uncertain)}{', '.join(uncertain)}"
    )
    return sentence, {
        "rate": rate, "encoder_counts": encoders.counts, "position_noise": encoders.noise,
        "position_cutoff": chosen.position_cutoff, "parallel_cutoff": chosen.parallel_cutoff,
        "sigmas": {p.name: p.sigma for p in fit.parameters},
    }  # fmt: skip


def _check_usage(args: argparse.Namespace) -> None:
    """Before any long work."""
    if args.choose is None and args.check is None and args.out is None:
        raise DataError("--out: missing; expected the file of the motion, .csv or .parquet")
    if args.choose is not None and not args.candidates:
        raise DataError("--choose needs --from: --choose 1 --from a.csv --from b.csv")
    if args.candidates and args.choose is None and args.between is not None:
        raise DataError("--between: got it with --from, which adds to its logs; leave one out")
    names = ("out", "picture", "between", "encoder_counts", "position_noise")
    for name in names if args.choose is not None or args.check is not None else ():
        if getattr(args, name) is not None:
            option = f"--{name.replace('_', '-')}"
            other = "--check, which looks at a motion and writes none"
            if args.choose is not None:
                other = "--choose, which names motions of --from and writes none"
            raise DataError(f"{option}: got it with {other}; leave {option} out")
    if args.out is not None:
        simulation.check_suffix(Path(args.out))
    if args.picture is not None:
        excitation.check_picture_kind(args.picture)
    if not (math.isfinite(args.rate) and 0.0 < args.rate <= 1e5):
        raise DataError(f"--rate: got {args.rate:g}; expected more than 0, at most 1e5")


def _read_subject(args: argparse.Namespace) -> motions.Subject:
    if not args.robot.endswith(".json"):
        if args.between is not None:
            raise DataError(
                f"--between: {args.robot} has no values; expected a model file of `modeler fit`"
            )
        robot = resolve_robot(args)
        with show_activity(f"deriving {robot.name}"):
            return motions.build_subject(robot)
    if args.effects is not None:
        raise DataError(
            "--effects: of a robot file only; a model has the effects it was fitted with"
        )
    model = load_model(args.robot)
    with show_activity("deriving the robot of the model"):
        return motions.build_subject(model)


def parse_bounds(
    robot: Robot, compiled: CompiledModel, limits: Sequence[str], boxes: Sequence[str],
    clearance: float | None = None,
) -> excitation.MotionBounds:  # fmt: skip
    """Returns the limits of the robot file, replaced by those of the command line.

    Raises:
        DataError: a text that cannot be read, a joint or frame that is not there.
        RobotError: an empty range.
    """
    moving = [joint.name for joint in robot.moving_joints]
    form = "LOWER,UPPER,SPEED,ACCELERATION"
    return motions.build_bounds(
        robot, compiled,
        dict(_parse_assignment("--limit", text, moving, (4, 5), form) for text in limits),
        dict(_parse_assignment("--box", text, moving, (6,), "X0,X1,Y0,Y1,Z0,Z1") for text in boxes),
        clearance,
    )  # fmt: skip


def _parse_assignment(
    option: str, text: str, names: list[str], counts: tuple[int, ...], form: str
) -> tuple[str, list[float]]:
    name, equals, cells = text.partition("=")
    try:
        values = [_parse_number(cell) for cell in cells.split(",")]
    except (ValueError, ArithmeticError):
        values = []
    if not equals or len(values) not in counts:
        raise DataError(f"{option} {text}: expected {names[0]}={form}, numbers in SI units")
    if name not in names:
        raise DataError(
            f"{option} {text}: no moving joint {name}{suggest_name(name, names)}; expected one of "
            f"{', '.join(names)}"
        )
    if any(math.isnan(value) for value in values):
        raise DataError(f"{option} {text}: got nan; expected numbers")
    return name, values


def _parse_number(cell: str) -> float:
    """A number, or an angle as `90 deg` or `pi/2`."""
    try:
        return float(cell)
    except ValueError:
        expression = parse_expression(cell)
        if expression.names:
            raise
        return expression.evaluate()


def _choose_motions(args: argparse.Namespace, subject: motions.Subject) -> Json:
    compiled = subject.compiled
    names = [joint.name for joint in compiled.spec.joints]
    essential_columns = (
        slice(None) if subject.essential_columns is None else subject.essential_columns
    )
    weights = 1.0 if subject.sigma is None else 1.0 / subject.sigma[:, None]
    rows = []
    with show_activity("building the rows of the motions"):
        for place in args.candidates:
            motion = simulation.read_motion(place, names)
            states = (motion.q, motion.qd, motion.qdd)
            s = excitation.compute_signals(compiled, states, motion.time)
            phi = compiled.base_regressor(*states, s)[:, :, essential_columns]
            rows.append((phi * weights).reshape(-1, phi.shape[2]))
        choice = excitation.choose_motions(rows, args.choose)
    for k, place in enumerate(args.candidates):
        mark = "chosen  " if k in choice.places else "        "
        print_result(f"{mark}{place}: condition number {choice.single_conditions[k]:.4g} by itself")
    print_result(
        f"{len(choice.places)} chosen: condition number {choice.condition:.4g} together, all "
        f"{len(rows)} {choice.whole:.4g}, columns of length one"
    )
    return {
        "robot": subject.robot.name,
        "chosen_motions": [str(args.candidates[k]) for k in choice.places],
        "condition_scaled": choice.condition,
        "condition_scaled_of_all": choice.whole if math.isfinite(choice.whole) else None,
        "single_conditions": [
            value if math.isfinite(value) else None for value in choice.single_conditions
        ],
        "is_exhaustive": choice.is_exhaustive,
    }


_SETTINGS = "rate seed parameter_seed encoder_counts process_noise controller"
"""Options of `modeler simulate` that are settings of the simulation by the same name."""


def run_simulate(args: argparse.Namespace) -> Json:
    """Simulates and writes the log."""
    simulation.check_suffix(Path(args.out))
    robot = resolve_robot(args)
    options = select_attributes(args, _SETTINGS) | {"torque_noise": args.noise}
    is_generated = args.motion in MOTIONS
    if args.duration is not None:
        if not is_generated:
            raise DataError(
                f"--duration: got {args.duration:g} s with --motion {args.motion}, which is as "
                "long as it is; leave --duration out"
            )
        options["duration"] = args.duration
    options["drive_gains"] = simulation.parse_drive_gains(args.drive_gain, robot)
    if not is_generated and not (math.isfinite(args.rate) and args.rate > 0.0):
        raise DataError(f"--rate: got {args.rate:g}; expected a number above 0")
    settings = motions.build_settings(robot, args.hide, args.motion, options)
    try:
        with show_progress(f"simulating {robot.name}") as report:
            log = simulation.simulate(robot, settings, report)
    except DataError as error:
        raise error if is_generated else DataError(f"{args.motion}: {error}") from None
    simulation.write_log(Path(args.out), log)
    if args.truth_out is not None:
        simulation.write_truth(Path(args.truth_out), log)
    drawn_text = (
        f", {len(log.truth.random_parameters)} parameters drawn"
        if log.truth.random_parameters
        else ""
    )
    print_result(f"{robot.name}: {len(log.time)} samples of {len(log.joints)} joints{drawn_text}")
    for effect in log.truth.hidden_effects:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        print_result(f"hidden: {effect.effect}{where}: {values}")
    if log.range_share < 1.0:
        print_result(
            f"motion: within {format_percent(log.range_share)} of the way from [home] to the "
            "limits: "
            f"farther, the loops come nearer than {format_percent(simulation.KEPT)} of home's "
            "distance to "
            "a singular posture, or do not close"
        )
    print_result(f"written: {args.out}")
    return {
        "robot": robot.name,
        "samples": len(log.time),
        "joints": list(log.joints),
        "parameters": dict(log.truth.parameters),
        "random_parameters": list(log.truth.random_parameters),
        "hidden_effects": simulation.serialise_hidden_effects(log),
        "range_share": log.range_share,
    }
