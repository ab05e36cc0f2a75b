"""`modeler show`."""

import argparse

from modeler.cli.console import Json, say, working
from modeler.cli.places import Output, check_places
from modeler.cli.robots import read_told
from modeler.show import described, told
from modeler.showing import show


def run_show(args: argparse.Namespace) -> Json:
    """Writes the page and the picture; prints the frames at home and whether the loops close."""
    robot = read_told(args.robot)
    if args.out is None and args.png is None:
        args.out = Output(f"{robot.name}.html")
        check_places(args)
    with working(f"drawing {robot.name}"):
        found = show(robot, args.out, args.png)
    for line in told(found.skeleton, found.posture):
        say(line)
    places = {"page": args.out, "picture": args.png}
    written = {what: str(place) for what, place in places.items() if place is not None}
    for what, place in written.items():
        say(f"{what}: {place}")
    return {**described(found.skeleton, found.posture), **written}
