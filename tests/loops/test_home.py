"""[home] that is missing or poor is found, a singular one is refused."""

import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import LoopError
from modeler.derivation.assembly_modes import ClosedHome, HomeModes, complete_home, find_modes_near
from modeler.derivation.derive import derive_model
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import build_linkage
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import Robot
from tests.robot_texts import CRANK, PARALLELOGRAM
from tests.robots import one_always
from tests.rotation import ROTATING

RPR = (Path(__file__).parent / "rpr.toml").read_text(encoding="utf-8")
BUILT_IN = one_always(("five-bar", "sr400", "delta", "evra", "stewart"), "five-bar")
SHARED = ("twoloops", *(pytest.param(n, marks=ROTATING) for n in ("excavator_bucket", "rccc")))
CLOSED = 1e-9


def without_home(text: str) -> str:
    """The robot file without the table."""
    stored, table = [], ""
    for line in text.splitlines():
        table = line.split("#")[0].strip() if line.startswith("[") else table
        if table != "[home]":
            stored.append(line)
    assert "home" not in tomllib.loads("\n".join(stored))
    return "\n".join(stored)


@cache
def of_text(text: str) -> Robot:
    return parse_robot_text(text, "robot.toml")


def check(found: HomeModes) -> None:
    """Laws of assembly modes: closed, regular, with the actuated joints together, all different."""
    linkage = found.linkage
    u = np.array([mode.posture for mode in found.modes])
    assert np.max(np.abs(linkage.loops.compute_residuals(u))) < CLOSED * linkage.loops.size
    assert np.all(linkage.loops.are_aligned(u))
    assert np.min(linkage.loops.compute_singularity_distance(u)) > THRESHOLDS.min_singular_value
    inputs = list(linkage.loops.actuated)
    assert np.ptp(u[:, inputs], axis=0).max() == 0.0
    shapes = linkage.compute_shape(u)
    apart = np.max(np.abs(shapes[:, None] - shapes), axis=2) + np.eye(len(u))
    assert apart.min() > 1e-5
    letters = [mode.letter for mode in found.modes]
    assert letters[0] == "A" and len(set(letters)) == len(letters)


def check_found(text: str) -> None:
    """The file's home stays; without, one is found, and the file's is among the modes at its q."""
    robot, bare = of_text(text), of_text(without_home(text))
    assert complete_home(robot) == ClosedHome(robot)
    home = complete_home(bare)
    assert "[home] found: mode A" in home.message
    model = derive_model(bare)
    assert model.robot.home == home.robot.home
    check(find_modes_near(bare, {}))
    actuated = {joint.name: robot.home.get(joint.name, 0.0) for joint in robot.coordinates}
    matches = find_modes_near(robot, actuated)
    check(matches)
    assert matches.stated_index is not None


@pytest.mark.parametrize("name", BUILT_IN)
def test_home_is_found_for_built_in_robots(name) -> None:
    check_found(read_builtin_robot(name))


@pytest.mark.rotating("long tests of loops")
@pytest.mark.parametrize("name", SHARED)
def test_home_is_found_for_further_robots(loop_robots_folder, name) -> None:
    text = (loop_robots_folder / f"{name}.toml").read_text(encoding="utf-8")
    if name == "rccc":  # its [home] is one that must be polished
        robot = complete_home(of_text(text)).robot
        lines = [f"q{row} = {value!r}" for row, value in robot.home.items()]
        text = without_home(text) + "\n[home]\n" + "\n".join(lines)
    check_found(text)


def test_modes_do_not_depend_on_the_unit_of_length(factor=1e-3) -> None:
    larger = CRANK.replace("R = 0.10", f"R = {0.10 * factor}").replace("0.35", f"{0.35 * factor}")
    larger = larger.replace("q3 = 0.33", f"q3 = {0.33 * factor}")
    one, other = find_modes_near(of_text(CRANK), {}), find_modes_near(of_text(larger), {})
    check(other)
    scale = np.where(one.linkage.is_travel, factor, 1.0)
    for mode, same in zip(one.modes, other.modes, strict=True):
        assert same.posture / scale == pytest.approx(mode.posture, abs=1e-9)
        assert same.singularity_distance == pytest.approx(mode.singularity_distance, rel=1e-3)


def platform_angles(lengths: np.ndarray, R: float, r: float) -> list[float]:
    """Angles of a planar 3-RPR platform with these legs, by a scan that knows no Newton.

    For an angle of the platform, its place is where the circles of two legs meet; the third leg
    says whether the angle is one.
    """
    feet = R * np.exp(1j * (np.pi / 2 + 2 * np.pi / 3 * np.arange(3)))
    corners = feet / R * r
    turn = np.linspace(-np.pi, np.pi, 200_001)
    # Leg i: |p + corner_i e^(i turn) - foot_i| = length_i: circles of p around foot - corner.
    centres = feet[:, None] - corners[:, None] * np.exp(1j * turn)
    between = centres[1] - centres[0]
    distance = np.abs(between)
    along = (lengths[0] ** 2 - lengths[1] ** 2 + distance**2) / (2 * distance)
    square = lengths[0] ** 2 - along**2
    across = np.sqrt(np.where(square >= 0, square, np.nan))
    angles = []
    for side in (1, -1):
        p = centres[0] + between / distance * (along + side * 1j * across)
        miss = np.abs(p - centres[2]) - lengths[2]
        angles += list(turn[:-1][miss[:-1] * miss[1:] < 0])
    return sorted(angles)


@pytest.mark.parametrize(
    "lengths", [(0.75, 0.95, 0.85), pytest.param((0.7, 0.75, 0.65), marks=pytest.mark.rotating)]
)
def test_all_modes_of_a_planar_platform_are_found(lengths) -> None:
    matches = find_modes_near(of_text(RPR), dict(zip(("21", "22", "23"), lengths, strict=True)))
    check(matches)
    place = [joint.name for joint in matches.linkage.free].index("P")
    turns = sorted(mode.posture[place] for mode in matches.modes)
    expected = platform_angles(np.array(lengths), 0.8, 0.2)
    assert len(expected) >= 2
    assert turns == pytest.approx(expected, abs=1e-4)


def test_a_cylinder_is_longer_than_zero() -> None:
    """Of two ways to write a leg, [1.2, -0.7] and [1.2 - pi, 0.7], the second is meant."""
    home = complete_home(of_text(RPR)).robot.home
    assert all(home[name] > 0.0 for name in ("21", "22", "23"))


def test_hints_choose_the_mode() -> None:
    """A sign of one passive joint is enough; the joints that are stated stay where they can."""
    left = CRANK[: CRANK.index("[home]")]
    for way in (1, -1):
        home = complete_home(of_text(left + f"[home]\nq1 = 0.7\nq3 = {way * 0.3}\n")).robot.home
        assert home["1"] == 0.7 and np.sign(home["3"]) == way


def test_limits_choose_the_posture() -> None:
    text = CRANK[: CRANK.index("[home]")] + "[limits]\n1 = [2.0, 2.4, 1, 1]\n3 = [-1, 0, 1, 1]\n"
    home = complete_home(of_text(text)).robot.home
    assert home["1"] == pytest.approx(2.2) and home["3"] < 0.0


def test_limits_that_cannot_be_kept_are_told() -> None:
    bare = CRANK[: CRANK.index("[home]")]
    for least, text in ((0.2, False), (0.5, True)):  # the slider reaches 0.45
        home = complete_home(of_text(f"{bare}[limits]\n3 = [{least}, 0.6, 1, 1]\n"))
        assert ("; it is outside [limits], which none keeps there: check" in home.message) is text


def test_a_home_out_of_reach_is_moved_and_told() -> None:
    home = complete_home(of_text(CRANK.replace("R = 0.10", "R = 0.45")))
    assert "crank: [home] completed: moved q1 1.571 -> " in home.message
    assert abs(0.45 * np.sin(home.robot.home["1"])) < 0.35
    derive_model(of_text(CRANK.replace("R = 0.10", "R = 0.45")))


def test_a_poor_home_is_polished_to_the_mode_that_is_near(loop_robots_folder) -> None:
    text = (loop_robots_folder / "twoloops_poorhome.toml").read_text(encoding="utf-8")
    good = (loop_robots_folder / "twoloops.toml").read_text(encoding="utf-8")
    home = complete_home(of_text(text))
    assert "[home] completed: what it leaves out was found; mode A of" in home.message
    expected = of_text(good).home
    moved = [home.robot.home[name] - value for name, value in expected.items()]
    assert np.array(moved) == pytest.approx(0.0, abs=1e-5)


def test_a_singular_home_is_refused_with_what_is_lost() -> None:
    """Three legs that meet in the middle of the platform let it turn; a little longer, they do not.

    The posture that is offered is good as it stands.
    """
    text = RPR + '[home]\nqP = 0.1\n"q1{i}" = 1.5\n"q2{i}" = LENGTH\n'
    with pytest.raises(LoopError) as caught:
        derive_model(of_text(text.replace("LENGTH", "0.6")))
    message = str(caught.value)
    assert "the loops are singular at [home]: joints P, 11, 12, 13 could move there" in message
    assert "(qP : q11 : q12 : q13 = 1 : -0.33 : -0.33 : -0.33; singular value " in message
    stated = "\n".join(message.split("such as ")[1].split(", "))
    again = of_text(f"{RPR}[home]\n{stated}\n")
    assert complete_home(again).robot is again
    model = derive_model(of_text(text.replace("LENGTH", "0.61")))
    bars = build_linkage(model)
    assert bars is not None and model.closure is not None
    assert 0.01 < bars.loops.compute_singularity_distance(np.array([model.closure.home]))[0] < 0.3


def test_a_found_home_is_the_same_as_a_written_one() -> None:
    """Signatures are of the emitted text: to the last digit."""
    bare = of_text(without_home(read_builtin_robot("five-bar")))
    result = derive_model(bare)
    lines = [f"q{name} = {value!r}" for name, value in complete_home(bare).robot.home.items()]
    stated = derive_model(of_text(bare.text + "\n[home]\n" + "\n".join(lines)))
    assert result.closure is not None and stated.closure is not None
    assert result.closure.home == stated.closure.home
    assert result.robot.relations.keys() == stated.robot.relations.keys()


def test_a_home_is_far_from_where_a_parallelogram_could_cross() -> None:
    """In the middle of the limits it is flat; so it stands elsewhere within them, uncrossed."""
    matches = find_modes_near(of_text(PARALLELOGRAM + "[limits]\n1 = [-0.6, 0.6, 1, 1]\n"), {})
    check(matches)
    q1, q2, q4 = matches.modes[0].posture
    assert 0.3 < abs(q1) <= 0.6 and matches.modes[0].is_within_limits
    assert (q2, q4) == pytest.approx((-q1, q1), abs=1e-9)
    assert len(matches.modes) == 2 and matches.modes[0].singularity_distance > 0.1


@pytest.mark.parametrize("name", ["wrist", "orthoglide-leg"])
def test_without_a_loop_to_close_there_are_no_modes(name) -> None:
    robot = of_text(read_builtin_robot(name))
    assert complete_home(robot).robot is robot
    with pytest.raises(LoopError, match=r"there is no loop to close; \[home\] applies to robots"):
        find_modes_near(robot, {})
