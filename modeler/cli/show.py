"""`modeler show ROBOT`."""

import argparse

from modeler.cli.console import Json, print_lines, show_activity
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import Output, check_places
from modeler.views import describe_posture, serialise_posture, show


def run_show(args: argparse.Namespace) -> Json:
    """Writes the page and the picture; prints the frames at home and whether the loops close."""
    robot = read_robot_with_notes(args.robot)
    if args.out is None and (args.picture is None or args.open):
        args.out = Output(f"{robot.name}.html")
        check_places(args)
    with show_activity(f"drawing {robot.name}"):
        drawing = show(robot, args.out, args.picture)
    print_lines(describe_posture(drawing.skeleton, drawing.posture))
    places = {"page": args.out, "picture": args.picture}
    written = {what: str(place) for what, place in places.items() if place is not None}
    print_lines(f"{what}: {place}" for what, place in written.items())
    return {**serialise_posture(drawing.skeleton, drawing.posture), **written}
