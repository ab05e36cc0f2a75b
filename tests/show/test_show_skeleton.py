"""The skeleton against the simulator's geometry, which shares only the robot file."""

import functools

import casadi as ca
import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.robot.read import parse_robot_text, read_robot
from modeler.simulation.closing import build_constraints, compute_closed_postures
from modeler.simulation.rigid import compute_world_frames
from modeler.views import robot_skeleton
from modeler.views.robot_scene import choose_view, collect_joint_points
from tests.further_robots import FurtherRobots
from tests.robot.texts import edited
from tests.robots import LOOPED, ROBOTS, TIED


def variables(skeleton, u):
    """(moving rows,) by the relations' own expressions."""
    robot = skeleton.robot
    values = {
        **robot.evaluate_symbols(),
        **{f"q{n}": x for n, x in zip(skeleton.free, u, strict=True)},
    }
    left = dict(robot.relations)
    while left:
        for name in list(left):
            if left[name].names <= values.keys():
                values[f"q{name}"] = left.pop(name).evaluate(values)
    return np.array([values[joint.variable] for joint in robot.moving_joints])


@functools.cache
def standing(name: str) -> tuple[robot_skeleton.Skeleton, robot_skeleton.Posture]:
    """A built-in robot and its posture at home."""
    skeleton = robot_skeleton.build_skeleton(read_robot(name))
    return skeleton, robot_skeleton.find_home_posture(skeleton)


@pytest.mark.parametrize("name", ROBOTS)
def test_frames_are_where_the_simulator_has_them(name: str) -> None:
    skeleton, _ = standing(name)
    u = np.random.default_rng(1).uniform(-2.0, 2.0, len(skeleton.free))
    q = ca.SX.sym("q", len(skeleton.robot.moving_joints))
    frames = compute_world_frames(skeleton.robot, q)
    for row, pose in zip(
        skeleton.robot.joints, robot_skeleton.compute_poses(skeleton, u), strict=True
    ):
        frame = frames[row.name]
        both = ca.Function("pose", [q], [ca.horzcat(frame.rotation, frame.position)])
        np.testing.assert_allclose(pose[:3], both(variables(skeleton, u)).full(), atol=1e-12)
        np.testing.assert_array_equal(pose[3], [0, 0, 0, 1])


@pytest.mark.parametrize("name", TIED)
def test_home_is_the_posture_that_the_simulator_closes(name: str) -> None:
    skeleton, home = standing(name)
    assert home.is_closed and home.is_as_stated and home.loose_joints == ()
    start = home.u[list(skeleton.independent_places)]
    theirs = compute_closed_postures(
        skeleton.robot, build_constraints(skeleton.robot), start[None]
    )[0]
    np.testing.assert_allclose(variables(skeleton, home.u), theirs, atol=1e-8)
    gaps = robot_skeleton.compute_gaps(skeleton, home.u)
    assert all(gap.distance < 1e-9 and gap.angle < 1e-7 for gap in gaps)
    again = robot_skeleton.solve_closure(skeleton, home.u, skeleton.dependent_places, home.size)
    np.testing.assert_allclose(again, home.u, atol=1e-9)


@pytest.mark.parametrize("name", LOOPED)
def test_slopes_are_those_of_the_residuals(name: str) -> None:
    skeleton, home = standing(name)
    u = home.u + np.random.default_rng(2).uniform(-0.2, 0.2, len(home.u))
    J = robot_skeleton.compute_jacobian(skeleton, u, home.size, range(len(u)))
    way = np.random.default_rng(3).uniform(-1.0, 1.0, len(u))
    ahead, behind = (
        robot_skeleton.compute_residuals(skeleton, u + s * 1e-6 * way, home.size) for s in (1, -1)
    )
    np.testing.assert_allclose(J @ way, (ahead - behind) / 2e-6, atol=1e-8)


@pytest.mark.parametrize("kind", ["universal", "cylindrical", "prismatic", "planar", "rigid"])
def test_a_gap_is_what_a_joint_does_not_let_free(kind: str) -> None:
    """A body on six free joints beside the base, moved by what the joint forbids, and allows."""
    text = f"""
name = "free"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "a", "mu", "sigma", "theta"]
rows = [["0e", "0", 0, 2, 0], ["1", "0", 1, 0, "q1"]]
[platform]
name = "P"
motion = "free"
[loops]
rows = [["L", "P", "0e", "{kind}"]]
"""
    robot = parse_robot_text(text, "free")
    skeleton = robot_skeleton.build_skeleton(robot)
    u = dict.fromkeys(skeleton.free, 0.0)
    if kind == "universal":  # the axes of the cross are perpendicular
        u["Pa"] = np.pi / 2

    def gap(**moved: float) -> tuple[float, float]:
        values = np.array([{**u, **moved}[name] for name in skeleton.free])
        loop = robot_skeleton.compute_gaps(skeleton, values)[0]
        return loop.distance, loop.angle

    allowed = dict(
        universal=[], cylindrical=["Pz", "P"], prismatic=["Pz"], planar=["Px", "Py", "P"], rigid=[]
    )[kind]
    assert gap() == pytest.approx((0.0, 0.0), abs=1e-12)
    for name in set(skeleton.free) - {"1"}:
        if kind == "universal" and name in ("P", "Pb"):
            continue
        distance, angle = gap(**{name: u[name] + 0.1})
        expected = 0.0 if name in allowed else 0.1
        turn = name in ("Pa", "Pb", "P")
        assert (angle if turn else distance) == pytest.approx(expected, abs=1e-9), name


def five_bar(*changes: tuple[str, str]) -> tuple[robot_skeleton.Skeleton, robot_skeleton.Posture]:
    """The five-bar with other values, and its posture at home."""
    skeleton = robot_skeleton.build_skeleton(
        parse_robot_text(edited(read_builtin_robot("five-bar"), *changes), "five-bar")
    )
    return skeleton, robot_skeleton.find_home_posture(skeleton)


def test_loops_that_cannot_close_are_seen_open() -> None:
    skeleton, posture = five_bar(("L0 = 0.20", "L0 = 5.0"))
    assert not posture.is_closed
    np.testing.assert_array_equal(posture.u, skeleton.stated)
    assert robot_skeleton.compute_gaps(skeleton, posture.u)[0].distance > 3.0


def test_actuated_joints_that_are_stated_wrongly_are_told() -> None:
    wrong = ("q11 = 2.2", "q11 = -2.2"), ("q12 = 0.9", "q12 = 0.2"), ("L2 = 0.40", "L2 = 0.2")
    _, posture = five_bar(*wrong)
    assert posture.is_closed and not posture.is_as_stated


def test_what_could_move_with_the_motors_locked_is_told(loop_robots_folder: FurtherRobots) -> None:
    singular = robot_skeleton.build_skeleton(read_robot(loop_robots_folder / "3rpr_singular.toml"))
    assert {"P"} <= set(
        robot_skeleton.find_home_posture(singular).loose_joints
    )  # cylinders through one point: it turns
    other = robot_skeleton.build_skeleton(read_robot(loop_robots_folder / "3rpr_sim.toml"))
    assert robot_skeleton.find_home_posture(other).loose_joints == ()


def test_a_stretched_linkage_is_singular() -> None:
    flat = ("q11 = 2.2", "q11 = 0.0"), ("q21 = -1.37", "q21 = 0.0"), ("q22 = 1.46", "q22 = 0.0")
    _, posture = five_bar(("L0 = 0.20", "L0 = 1.43"), ("q12 = 0.9", 'q12 = "pi"'), *flat)
    assert posture.is_closed and set(posture.loose_joints) == {"21", "22"}


def test_opposite_axes_are_not_closed() -> None:
    row = '["9",  "8",  0,    0,       0,       '
    text = edited(read_builtin_robot("sr400"), (row + "0, ", row + '"pi", '))
    skeleton = robot_skeleton.build_skeleton(parse_robot_text(text, "sr400"))
    pose = robot_skeleton.find_home_posture(skeleton)
    assert not pose.is_closed
    assert robot_skeleton.compute_gaps(skeleton, pose.u)[0].angle == pytest.approx(np.pi)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_view_is_a_rotation_that_shows_the_robot(name: str) -> None:
    skeleton, posture = standing(name)
    view = choose_view(skeleton, posture)
    np.testing.assert_allclose(view.rotation @ view.rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(view.rotation) == pytest.approx(1.0)
    points = collect_joint_points(skeleton, posture.u)
    seen = points @ view.rotation[:2].T
    assert np.ptp(seen, axis=0).max() >= 0.5 * np.ptp(points, axis=0).max()
    if name in ("five-bar", "3rrr"):  # planar: straight on
        assert abs(view.rotation[2, 2]) == pytest.approx(1.0)
    if name == "five-bar":
        assert skeleton.gravity @ view.rotation[1] < 0.0  # down is down
