"""`modeler excite ROBOT --out MOTION` and `modeler simulate ROBOT --out LOG`."""

import argparse
import dataclasses
from pathlib import Path

import modeler.api.motion as motions
from modeler import excitation, simulation
from modeler.api.motion_bounds import MotionCheck, judge_motion
from modeler.api.thresholds import THRESHOLDS
from modeler.cli.console import print_lines, print_result, show_activity
from modeler.cli.documents import SimulatedRun
from modeler.cli.lists import build_reporter, read_robot_or_model, resolve_robot
from modeler.core.files import write_atomically
from modeler.core.json import select_attributes
from modeler.core.options import ExciteOptions, OptionError
from modeler.core.table import format_percent
from modeler.robot import Robot


def run_excite(
    args: argparse.Namespace,
) -> motions.FoundMotion | MotionCheck | motions.MotionChoice:
    """Finds a motion and writes it, or chooses among motions, or looks at one."""
    if args.out is not None:
        simulation.check_suffix(Path(args.out))
    picture_kind = None if args.picture is None else excitation.check_picture_kind(args.picture)
    options = ExciteOptions.from_names(vars(args))
    if options.clearance is None and args.check is not None:
        options = dataclasses.replace(options, clearance=THRESHOLDS.link_clearance)
    thing = read_robot_or_model(args)
    name = thing.name if isinstance(thing, Robot) else "the robot of the model"
    with show_activity(f"deriving {name}"):
        subject, bounds = motions.prepare_search(thing, options, args.limits, args.boxes)
    if args.report is not None and not (bounds.clearance and len(bounds.clearance.solids.pairs)):
        raise OptionError(
            "{--report}: no two links are looked at; expected {--clearance}, or [capsules] of the "
            "robot file, and links that may meet"
        )
    if args.choose is not None:
        with show_activity("building the rows of the motions"):
            choice = motions.choose_motions(subject, args.logs, args.choose)
        print_lines(choice.format_lines())
        return choice
    if args.check is not None:
        with show_activity(f"looking at {args.check}"):
            check = judge_motion(subject.robot, subject.compiled, bounds, args.check, args.limits)
        print_lines(check.format_lines())
        _draw_nearest(args, subject.robot, bounds, check.closest_approach)
        check.require_passed()
        return check
    result = motions.search_motion(
        subject, bounds, options, args.logs, between=args.between, reporter=build_reporter()
    )
    motion = result.motion
    print_lines(result.format_lines())
    columns = motion.sample_motion(options.rate)
    is_text = args.out.endswith(".csv")
    encode = excitation.format_csv if is_text else excitation.encode_parquet
    write_atomically(Path(args.out), encode(columns))
    print_result(
        f"written: {args.out}, {len(columns['time'])} samples, {motion.seconds:.1f} s of search"
    )
    _draw_nearest(args, subject.robot, bounds, motion.closest_approach)
    if picture_kind is not None:
        with show_activity("drawing"):
            drawn = excitation.draw_motion(motion, subject.compiled, picture_kind)
        write_atomically(Path(args.picture), drawn)
        print_result(f"written: {args.picture}")
    return result


def _draw_nearest(
    args: argparse.Namespace,
    robot: Robot,
    bounds: excitation.MotionBounds,
    near: excitation.ClosestApproach | None,
) -> None:
    """The page of the robot where two come nearest, if it is wanted and there are two."""
    if args.report is not None and near is not None:
        from modeler.views import render_nearest_page  # which takes long to load

        write_atomically(Path(args.report), render_nearest_page(robot, bounds, near))
        print_result(f"written: {args.report}")


_SETTINGS = "rate seed parameter_seed encoder_counts process_noise controller"
"""Options of `modeler simulate` that are settings of the simulation by the same name."""


def run_simulate(args: argparse.Namespace) -> SimulatedRun:
    """Simulates and writes the log."""
    simulation.check_suffix(Path(args.out))
    robot = resolve_robot(args)
    settings = select_attributes(args, _SETTINGS) | {"torque_noise": args.noise}
    if args.duration is not None:
        settings["duration"] = args.duration
    log = motions.simulate(
        *(robot, args.out),
        hide=args.hide,
        motion=args.motion,
        reporter=build_reporter(),
        drive_gains=args.drive_gain,
        **settings,
    )
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
            f"limits: farther, the loops come nearer than {format_percent(simulation.KEPT)} of "
            "home's distance to a singular posture, or do not close"
        )
    print_result(f"written: {args.out}")
    return {
        "robot": robot.name,
        "samples": len(log.time),
        "joints": list(log.joints),
        "parameters": dict(log.truth.parameters),
        "random_parameters": list(log.truth.random_parameters),
        "hidden_effects": list(log.truth.hidden_effects),
        "range_share": log.range_share,
    }
