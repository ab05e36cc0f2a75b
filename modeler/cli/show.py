"""`modeler show ROBOT`, and `modeler convert FILE --out ROBOT.toml`."""

import argparse
from pathlib import Path

from modeler.cli.console import Json, say, say_lines, working
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import Output, check_places
from modeler.core.errors import ModelerError
from modeler.core.files import Kind, destination, write_atomically
from modeler.report import posture_json, posture_lines, show
from modeler.robot import converted, robot_from_text


def run_convert(args: argparse.Namespace) -> Json:
    """Writes the robot file, when it has been read as one; prints the notes."""
    found = converted(Path(args.file))
    out = Path(args.out)
    robot = robot_from_text(found.text, f"{args.file}, as a robot file")
    there = destination(out).kind is Kind.FILE
    if not args.force and there and out.read_bytes() != found.text.encode():
        raise ModelerError(
            f"--out {out}: there is such a file with another content; choose another name, or "
            "write over it with --force"
        )
    write_atomically(out, found.text)
    loops = f", {len(robot.loops)} loops" if robot.loops else ""
    say(f"{robot.name}: {len(robot.moving)} joints{loops}, written to {out}")
    say_lines(found.notes, "* ")
    return {
        "robot": robot.name,
        "file": str(args.file),
        "out": str(out),
        "joints": [joint.name for joint in robot.moving],
        "loops": [loop.name for loop in robot.loops],
        "notes": list(found.notes),
    }


# `modeler show`.


def run_show(args: argparse.Namespace) -> Json:
    """Writes the page and the picture; prints the frames at home and whether the loops close."""
    robot = read_robot_with_notes(args.robot)
    if args.out is None and (args.picture is None or args.open):
        args.out = Output(f"{robot.name}.html")
        check_places(args)
    with working(f"drawing {robot.name}"):
        found = show(robot, args.out, args.picture)
    say_lines(posture_lines(found.skeleton, found.posture))
    places = {"page": args.out, "picture": args.picture}
    written = {what: str(place) for what, place in places.items() if place is not None}
    say_lines(f"{what}: {place}" for what, place in written.items())
    return {**posture_json(found.skeleton, found.posture), **written}
