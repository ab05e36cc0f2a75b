"""`modeler show`."""

import argparse
from pathlib import Path

from modeler.cli.console import Json, say
from modeler.cli.places import Output, check_places
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.robot import read_robot
from modeler.show import (
    PICTURE_KINDS,
    Posture,
    Skeleton,
    described,
    home_posture,
    page_html,
    picture,
    skeleton_of,
    told,
)


def run_show(args: argparse.Namespace) -> Json:
    """Writes the page and the picture; prints the frames at home and whether the loops close."""
    kind = "" if args.png is None else Path(args.png).suffix.lower()
    if args.png is not None and kind not in PICTURE_KINDS:
        raise DataError(
            f"--png {args.png}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(PICTURE_KINDS)}"
        )
    robot = read_robot(args.robot)
    if args.out is None and args.png is None:
        args.out = Output(f"{robot.name}.html")
        check_places(args)
    skeleton = skeleton_of(robot)
    posture = home_posture(skeleton)
    written = _write(args, skeleton, posture, kind)
    for line in told(skeleton, posture):
        say(line)
    for what, place in written.items():
        say(f"{what}: {place}")
    return {**described(skeleton, posture), **written}


def _write(
    args: argparse.Namespace, skeleton: Skeleton, posture: Posture, kind: str
) -> dict[str, str]:
    """What was written where."""
    contents: dict[str, tuple[str, str | bytes]] = {}
    if args.out is not None:
        contents["page"] = (args.out, page_html(skeleton, posture))
    if args.png is not None:
        contents["picture"] = (args.png, picture(skeleton, posture, kind))
    for place, content in contents.values():
        write_atomically(Path(place), content)
    return {what: str(place) for what, (place, _) in contents.items()}
