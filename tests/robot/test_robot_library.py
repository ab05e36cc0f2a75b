"""The built-in tables against published poses, other conventions and laws."""

import numpy as np
import pytest

from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL
from tests.elementary_motions import frames, row_pose, shift, turn
from tests.robots import LOOPED, ROBOTS, TIED
from tests.rotation import with_cases

PI = np.pi


def standard_dh(rows, q):
    """Rz(theta) Tz(d) Tx(a) Rx(alpha), row after row: (a, alpha, d)."""
    pose = np.eye(4)
    for (a, alpha, d), angle in zip(rows, q, strict=True):
        pose = pose @ turn(2, angle) @ shift(2, d) @ shift(0, a) @ turn(0, alpha)
    return pose


def near(actual, expected, tolerance=1e-12):
    np.testing.assert_allclose(actual, expected, rtol=0, atol=tolerance)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_built_in_robot_is_complete(name):
    robot = read_robot(name)
    assert robot.title != robot.name == name
    assert len(robot.notes) > 40  # its source
    assert robot.moving_joints
    assert (name in LOOPED) == bool(robot.loops)
    assert (name in TIED) == bool(robot.loops or robot.relations)
    columns = ("gamma", "b", "alpha", "d", "theta", "r")
    cells = [getattr(joint, column) for joint in robot.joints for column in columns]
    used = set().union(*(e.names for e in (*robot.gravity, *robot.symbols.values(), *cells)))
    assert set(robot.symbols) <= used, "a symbol that nothing uses"


def test_rigid_robots_have_no_effects():
    rigid = ("wrist", "rx90", "puma560", "scara", "panda", "lwr", "sr400-tree")
    assert all(read_robot(name).effects == () for name in rigid)


def test_measured_robots_carry_friction():
    for name in ("emps", "odrive", "tx40", "ur10e", "kinova_gen3"):
        robot = read_robot(name)
        every = tuple(joint.name for joint in robot.moving_joints)
        uses = {use.effect: use.joints for use in robot.effects}
        assert all(uses[effect] == every for effect in ("viscous", "coulomb"))
        # The offset of joint 1 does not carry over between the Kinova's runs, that of 7 does.
        assert uses["offset"] == (("7",) if name == "kinova_gen3" else every)
        assert ("rotor_inertia" in uses) == (name not in ("emps", "odrive"))
    tx40 = read_robot("tx40")
    assert tx40.coupling == {"6": {"5": 1.0, "6": 1.0}}
    assert tx40.has_effect("coupled_inertia", "6")
    assert tx40.has_effect("coupled_friction", "6")


def test_panda_poses_of_its_manufacturer():
    flange = shift(2, 0.107)
    upright = frames("panda", np.zeros(7))["7"] @ flange
    near(upright[:3, 3], [0.088, 0.0, 0.926])
    near(upright[:3, 2], [0.0, 0.0, -1.0])
    # The ready pose of the control interface's examples: O_T_EE with the 0.1034 m hand.
    ready = [0, -PI / 4, 0, -3 * PI / 4, 0, PI / 2, PI / 4]
    hand = frames("panda", ready)["7"] @ flange @ turn(2, -PI / 4) @ shift(2, 0.1034)
    near(hand[:3, :3], np.diag([1.0, -1.0, -1.0]))
    near(hand[:3, 3], [0.306891, 0.0, 0.486882], 1e-6)


def test_ur10e_is_the_manufacturers_denavit_hartenberg_table():
    q = np.random.default_rng(3).uniform(-PI, PI, 6)
    rows = [(0, PI / 2, 0.181), (-0.613, 0, 0), (-0.571, 0, 0)]
    rows += [(0, PI / 2, 0.174), (0, -PI / 2, 0.120), (0, 0, 0.117)]
    near(frames("ur10e", q)["6"], standard_dh(rows, q))


def test_puma560_is_the_table_of_armstrong():
    q = np.random.default_rng(3).uniform(-PI, PI, 6)
    rows = [{}, {"alpha": -PI / 2, "r": 0.2435}, {"d": 0.4318, "r": -0.0934}]
    rows += [{"alpha": PI / 2, "d": -0.0203, "r": 0.4331}, {"alpha": -PI / 2}, {"alpha": PI / 2}]
    pose = np.eye(4)
    poses = frames("puma560", q)
    for number, (row, angle) in enumerate(zip(rows, q, strict=True), start=1):
        pose = pose @ row_pose(theta=angle, **row)
        # Frame 2 stands elsewhere on the same axis.
        moved = pose @ shift(2, -0.2435) if number == 2 else pose
        near(poses[str(number)], moved)


@with_cases(
    "name, q, place",
    ("kinova_gen3", np.zeros(7), [0, -0.02485, 0.28481 + 0.42076 + 0.31436 + 0.10593]),
    ("lwr", np.zeros(7), [0, 0, 0.3105 + 0.4 + 0.39]),
    ("rx90", [0, PI / 2, -PI / 2, 0, 0, 0], [0, 0, 0.9]),
    ("tx40", [0, -PI / 2, PI / 2, 0, 0, 0], [0, 0.035, 0.45]),
)
def test_arms_straight_up(name, q, place):
    poses = frames(name, q)
    near(poses[f"{len(q)}"][:3, 3], place)
    if name == "kinova_gen3":
        near(poses["7"][:3, 2], [0, 0, -1])


def test_lwr_wrist_distance_depends_on_the_elbow_only():
    q = np.random.default_rng(4).uniform(-PI, PI, 7)
    wrist = frames("lwr", q)["7"][:3, 3]
    law_of_cosines = 0.4**2 + 0.39**2 + 2 * 0.4 * 0.39 * np.cos(q[3])
    near(np.sum((wrist - [0, 0, 0.3105]) ** 2), law_of_cosines)


def test_scara_moves_in_the_plane_and_slides_vertically():
    q1, q2 = 0.4, -1.1
    pose = frames("scara", [q1, q2, 0.2, 0.3])["4"]
    elbow = 0.425 * np.array([np.cos(q1), np.sin(q1)])
    hand = elbow + 0.375 * np.array([np.cos(q1 + q2), np.sin(q1 + q2)])
    near(pose[:3, 3], [*hand, 0.2])
    near(pose[:3, 0], [np.cos(q1 + q2 + 0.3), np.sin(q1 + q2 + 0.3), 0])


def test_wrist_frames_are_those_of_the_paper():
    poses = frames("wrist", [0, 0, 0])
    n1, n2, n3 = np.eye(3)[:, [2, 0, 1]].T  # frame 0 = (n2, n3, n1)
    # With all joints at zero the paper's triads a, b, c lie along n.
    near(poses["1"][:3, :3], np.stack([n3, -n2, n1], axis=1))
    near(poses["2"][:3, :3], np.stack([n3, n1, n2], axis=1))
    near(poses["3"][:3, :3], np.stack([n3, -n2, n1], axis=1))
    near(poses["2"][:3, 3], 0.2 * n1)
    near(poses["3"][:3, 3], 0.3 * n1)
    gravity = [entry.evaluate({"g": 9.81}) for entry in read_robot("wrist").gravity]
    near(gravity, -9.81 * n3)


def test_sr400_parallelogram_closes():
    q1, q2, q7 = np.random.default_rng(3).uniform(-1, 1, 3)
    q = [q1, q2, PI / 2 - q2 + q7, 0, 0, 0, q7, q2 - q7]
    poses = frames("sr400-tree", q)
    # Both sides of the cut joint: frame 9 on link 8, frame 10 on link 3.
    values = read_robot("sr400-tree").evaluate_symbols()
    side9 = poses["8"] @ row_pose(d=values["D3"])
    side10 = poses["3"] @ row_pose(gamma=PI / 2, d=-values["D8"])
    near(side9[:3, 3], side10[:3, 3])


def test_orthoglide_parallelogram_closes():
    q1, q2, q3 = np.random.default_rng(3).uniform(-1, 1, 3)
    q = {"1": q1, "2": q2, "3": q3, "4": -q3, "5": -q2 - PI / 2, "7": q3}
    poses = frames("orthoglide-leg-tree", q)
    d4, b3, b7 = (
        read_robot("orthoglide-leg-tree").evaluate_symbols()[s] for s in ("D4", "b3", "b7")
    )
    x, z = (d4 * turned * np.cos(q3) for turned in (np.cos(q2), np.sin(q2)))
    near(poses["4"][:3, 3], [x, b3 - d4 * np.sin(q3), q1 - z])
    # The platform translates: x5 = z1, y5 = x1, z5 = y1 at every posture.
    near(poses["5"][:3, :3], np.eye(3)[:, [2, 0, 1]])
    side8 = poses["7"] @ row_pose(d=d4, theta=-q3)
    side9 = poses["4"] @ row_pose(gamma=-PI / 2, d=b7 - b3, theta=PI / 2)
    near(side8, side9)


def body(name, joint):
    """Mass, first moments and inertia matrix of a link at the origin of its frame."""
    values = read_robot(name).parameters
    xx, xy, xz, yy, yz, zz, mx, my, mz, mass = (values[f"{p}{joint}"] for p in INERTIAL)
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return mass, np.array([mx, my, mz]), inertia


@pytest.mark.parametrize(
    ("name", "joints"), [("demo-arm", "123"), ("two-link", "12"), ("puma560", "23456")]
)
def test_nominal_links_are_bodies(name, joints):
    """Density nowhere negative: the pseudo-inertia is positive definite (Wensing 2018)."""
    for joint in joints:
        mass, first, inertia = body(name, joint)
        second = np.trace(inertia) / 2 * np.eye(3) - inertia
        pseudo = np.block([[second, first[:, None]], [first[None, :], np.array([[mass]])]])
        assert np.linalg.eigvalsh(pseudo)[0] > 0


@with_cases(
    "joint, mass, centre, inertia",
    ("2", 17.4, [0.068, 0.006, -0.016 + 0.2435], [0.13, 0.524, 0.539]),
    ("3", 4.8, [0, -0.070, 0.014], [0.066, 0.0125, 0.066]),
    ("4", 0.82, [0, 0, -0.019], [1.8e-3, 1.8e-3, 1.3e-3]),
    ("5", 0.34, [0, 0, 0], [0.3e-3, 0.3e-3, 0.4e-3]),
    ("6", 0.09, [0, 0, 0.032], [0.15e-3, 0.15e-3, 0.04e-3]),
)
def test_puma560_links_are_those_of_armstrong(joint, mass, centre, inertia):
    """Steiner backwards: about the mass centre the published values come out."""
    read_mass, first, at_origin = body("puma560", joint)
    assert read_mass == mass
    near(first / mass, centre, 1e-9)
    c = first / mass
    about_centre = at_origin - mass * (c @ c * np.eye(3) - np.outer(c, c))
    near(about_centre, np.diag(inertia), 1e-8)
