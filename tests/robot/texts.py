"""Robot files that several tests of this folder read, and the check of a mistake in one."""

import re
from pathlib import Path

import pytest

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import RobotError
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text
from tests.learned import text_with

ARM, PLANAR, OWN_EFFECTS, ARM_URDF, ARM_XML = (
    Path(__file__).with_name("files").joinpath(name).read_text(encoding="utf-8")
    for name in ("arm.toml", "planar.toml", "own_effects.toml", "arm.urdf", "arm.xml")
)
"""The texts of `files/`."""

LAW = text_with("two-link", {}, 'brake = ["2"]\n').replace(
    "[effects]\n",
    '[own_effects.brake]\ncolumns = {Kw = "law(q)"}\n'
    "law = {low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}\n\n[effects]\n",
)

MOTORS = 'm1 = "q1"\nm2 = "q2 - 0.4*q1"\nm3 = "q3 - 0.5*q2 + 0.2*q1"\n'
COUPLED = read_builtin_robot("wrist-coupled").split("[parameters]")[0]

FIVE_BAR = replace_effects(read_builtin_robot("five-bar"), {})
"""Without effects."""


def edited(text: str, *pairs: tuple[str, str]) -> str:
    """With `new` once in place of `old`, of every pair."""
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def check_mistake(text: str, old: str, new: str, told: str) -> None:
    """With `new` in place of `old` the file is refused in a line that has the pieces of `told`.

    Args:
        text: of a robot file that is right.
        old: part of it.
        new: what stands there instead.
        told: pieces of the message in this order, with ` .. ` between them.
    """
    assert old in text
    pattern = ".*".join(map(re.escape, told.split(" .. ")))
    with pytest.raises(RobotError, match=pattern) as caught:
        parse_robot_text(text.replace(old, new, 1), "arm.toml")
    message = str(caught.value)
    assert message.startswith("arm.toml: ") and "\n" not in message and len(message) < 500
