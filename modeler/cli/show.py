"""`modeler show ROBOT`."""

import argparse

from modeler.cli.console import Json, say_lines, working
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import Output, check_places
from modeler.report import posture_json, posture_lines, show


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
