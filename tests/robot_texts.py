"""Texts of small robots that tests of several folders read: the files of `small_robots/`."""

from pathlib import Path

from modeler.robot.read import parse_robot_text
from modeler.robot.robot import Robot


def text_of(name: str) -> str:
    """Of `small_robots/<name>.toml`."""
    folder = Path(__file__).with_name("small_robots")
    return (folder / f"{name}.toml").read_text(encoding="utf-8")


PENDULUM, TWO_LINK, ARM, SIX = map(text_of, ("pendulum", "two_link", "arm", "six"))

TREE = text_of("tree")
"""A prismatic joint, a branch, a frame fixed on a link, and a joint after that frame."""

BACKWARDS = text_of("backwards")
"""As TREE, with joints of both kinds that run against z, first, between others and at the ends."""

CRANK = text_of("crank")
"""It drives a slider, without relations or limits; every length is known in closed form."""

PARALLELOGRAM, FOUR_BAR, PANTOGRAPH, OFFSET, RHOMBUS = map(
    text_of, ("parallelogram", "four_bar", "pantograph", "offset", "rhombus")
)

BENNETT = text_of("bennett")
"""Closed at these lengths only: three of five equations follow from the others near home."""


def robot(text: str, **changes: str) -> Robot:
    """The robot of the text, with further tables appended: robot(ARM, limits="1 = ...")."""
    tables = "".join(f"\n[{name}]\n{lines}\n" for name, lines in changes.items())
    return parse_robot_text(text + tables, "test.toml")
