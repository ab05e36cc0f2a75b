"""Rows of random trees: poses and torques by Pinocchio, cells that are 0, axes nearly parallel."""

import math
from fractions import Fraction

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats import mdh_rows
from modeler.formats.body_tree import BodyTree, Inertial, Pose, TreeJoint, collect_moving_links
from modeler.formats.thresholds import THRESHOLDS
from modeler.formats.tree_text import convert_tree
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import JointKind as Kind, Robot
from tests.oracles.pinocchio_dynamics import pin, places_of
from tests.robot.poses import link_poses
from tests.rotation import with_cases

TURNS, SLIDES, FIXED = Kind.REVOLUTE, Kind.PRISMATIC, Kind.FIXED


def rotation(axis, angle: float) -> np.ndarray:
    axis = np.asarray(axis, float)
    return pin.AngleAxis(angle, axis / np.linalg.norm(axis)).toRotationMatrix()


def random_body(rng) -> Inertial:
    mass, A = rng.uniform(0.5, 5), 0.1 * rng.normal(size=(3, 3))
    second = mass * A @ A.T
    return Inertial(mass, rng.uniform(-0.1, 0.1, 3), np.trace(second) * np.eye(3) - second)


def random_tree(rng, tilt: float = 0.0, serial: bool = False, count: int = 7) -> BodyTree:
    """Right angles, twelfths of pi, and any; points beside the origin; other zeros; fixed bodies.

    Args:
        rng: draws it.
        tilt: every second axis is turned by so much against the one before, else along it.
        serial: no branches.
        count: of joints.
    """
    bodies: dict[str, Inertial | None] = {"base": None}
    joints = []
    for k in range(count):
        parent = list(bodies)[-1] if serial or rng.random() < 0.75 else rng.choice(list(bodies))
        kind = (TURNS, TURNS, TURNS, SLIDES, FIXED)[rng.integers(5)]
        way = rng.integers(4)
        angles = rng.uniform(-3, 3, 3), rng.integers(-6, 7, 3) * math.pi / 12, np.zeros(3)
        position = np.round(rng.uniform(-0.5, 0.5, 3) * rng.integers(0, 2, 3), 4)
        turn = pin.rpy.rpyToMatrix(*angles[way % 3])
        axis = rng.choice([-1.0, 1.0]) * np.eye(3)[rng.integers(3)]
        if way == 0:
            axis = rng.normal(size=3)
            axis /= np.linalg.norm(axis)
        if tilt:
            turn, axis = rotation([*rng.normal(size=2), 0.0], tilt * (k % 2)), np.eye(3)[2]
        zero = float(rng.choice([0.0, 0.0, math.pi / 2, 0.3]))
        point = np.round(rng.uniform(-0.1, 0.1, 3), 3) * (rng.random() < 0.3)
        place = Pose(position, turn)
        joints.append(TreeJoint(f"j{k}", kind, parent, f"b{k}", place, axis, point, zero))
        bodies[f"b{k}"] = random_body(rng) if rng.random() < 0.9 else None
    gravity = np.array([0.3, 0.2, -9.81])
    return BodyTree("drawn", "URDF", "base", bodies, tuple(joints), gravity=gravity)


class PinocchioModel:
    """Pinocchio's model of the tree as it stands, q counted from the file's zero."""

    def __init__(self, tree: BodyTree):
        self.model = pin.Model()
        self.model.gravity.linear = tree.gravity
        self.at = {tree.root: (0, pin.SE3.Identity())}
        rows = []
        for joint in tree.joints:
            above, before = self.at[joint.parent]
            here = before * pin.SE3(joint.pose.rotation, joint.pose.position)
            if joint.kind is FIXED:
                self.at[joint.child] = above, here
            else:
                kinds = (pin.JointModelRevoluteUnaligned, pin.JointModelPrismaticUnaligned)
                centre = pin.SE3(np.eye(3), np.asarray(joint.point, float))
                kind = kinds[joint.kind](np.asarray(joint.axis, float))
                index = self.model.addJoint(above, kind, here * centre, joint.name)
                self.at[joint.child] = index, centre.inverse()
                rows.append((index, joint.zero))
            body, (index, place) = tree.bodies[joint.child], self.at[joint.child]
            if body is not None:
                inertia = pin.Inertia(body.mass, body.centre, body.inertia)
                self.model.appendBodyToJoint(index, inertia, place)
        self.rows = [self.model.idx_vs[index] for index, _ in rows]
        self.zero = np.array([zero for _, zero in rows])
        self.data = self.model.createData()

    def in_order(self, q) -> np.ndarray:
        ordered = np.zeros(self.model.nv)
        ordered[self.rows] = q
        return ordered

    def torque(self, q, qd, qdd):
        state = (self.in_order(q - self.zero), self.in_order(qd), self.in_order(qdd))
        return pin.rnea(self.model, self.data, *state)[self.rows]

    def poses(self, q) -> dict[str, np.ndarray]:
        pin.forwardKinematics(self.model, self.data, self.in_order(q - self.zero))
        return {
            body: (self.data.oMi[index] * place).homogeneous
            for body, (index, place) in self.at.items()
        }


def torques_of_table(robot: Robot):
    """Of the robot file alone, its values and rows, by Pinocchio: (q, qd, qdd) -> tau."""
    model, rows = places_of(robot, robot.parameters)
    data = model.createData()

    def torque(*state) -> np.ndarray:
        full = np.zeros((3, model.nv))
        full[:, rows] = state
        return pin.rnea(model, data, *full)[rows]

    return torque


def errors(tree: BodyTree, rng) -> tuple[float, float]:
    """Largest error of a pose, and of a torque over the largest torque."""
    robot = parse_robot_text(convert_tree(tree, "drawn.xml").text, "drawn.toml")
    one, other, pose, torque = PinocchioModel(tree), torques_of_table(robot), 0.0, 0.0
    for _ in range(3):
        q, qd, qdd = rng.uniform(-2, 2, (3, len(robot.moving_joints)))
        theirs = one.poses(q)
        for body, ours in link_poses(robot, q).items():
            pose = max(pose, np.abs(ours - theirs[body]).max())
        tau = one.torque(q, qd, qdd)
        wrong = np.abs(other(q, qd, qdd) - tau).max()
        torque = max(torque, wrong / (np.abs(tau).max() or 1.0))
    return pose, torque


def trees(seed: int, count: int, **drawn):
    every = (random_tree(np.random.default_rng([seed, k]), **drawn) for k in range(count))
    return [tree for tree in every if any(j.kind is not FIXED for j in tree.joints)]


def test_random_trees_have_their_poses_and_torques():
    rng = np.random.default_rng(31)
    for tree in trees(71, 30):
        pose, torque = errors(tree, rng)
        assert pose < 2e-12 and torque < 1e-11, tree.joints


def test_serial_chains_need_neither_gamma_nor_b():
    """But for the first row, which starts from a frame that is given, and sliding joints."""
    for tree in trees(72, 40, serial=True):
        if any(joint.kind is SLIDES for joint in tree.joints):
            continue
        for row in mdh_rows.build_mdh_table(collect_moving_links(tree)).rows[1:]:
            assert row.cells["gamma"] == row.cells["b"] == 0.0


@pytest.mark.parametrize("tilt", [1e-2, 1e-4, 1e-6])
def test_nearly_parallel_axes_keep_their_accuracy(tilt):
    """A foot 100 m to 100 km away would lose up to all digits; a fixed row loses none."""
    rng = np.random.default_rng(33)
    for tree in trees(73, 6, tilt=tilt, serial=True):
        pose, torque = errors(tree, rng)
        assert pose < 2e-9  # an angle within 1e-9 of a right one is one
        assert torque < 2e-9
        table = mdh_rows.build_mdh_table(collect_moving_links(tree))
        ways = [np.abs(j.pose.position) for j in tree.joints]
        most = THRESHOLDS.max_foot_distance_ratio * 3 * (max(map(np.max, ways)) or 1.0)
        for row in table.rows:
            assert max(abs(row.cells.get(c, 0.0)) for c in "bdr") < most


def test_numbers_are_exact_where_they_are():
    assert mdh_rows.snap_length(0.1 + 0.2) == 0.3 and str(mdh_rows.snap_length(-1e-17)) == "0.0"
    assert mdh_rows.snap_length(1 / 3) == 1 / 3
    assert mdh_rows.snap_angle(3 * math.pi / 2) == -math.pi / 2
    assert mdh_rows.snap_angle(-math.pi) == mdh_rows.snap_angle(math.pi) == math.pi
    assert mdh_rows.snap_angle(0.7) == 0.7
    assert mdh_rows.snap_angle(math.pi / 12 + 1e-8) != math.pi / 12
    rng = np.random.default_rng(5)
    for angles in [*rng.uniform(-3, 3, (20, 3)), (0.3, math.pi / 2, 0.4), (1.0, -math.pi / 2, 2)]:
        R = pin.rpy.rpyToMatrix(*map(float, angles))
        again = pin.rpy.rpyToMatrix(*mdh_rows.compute_roll_pitch_yaw(R))
        np.testing.assert_allclose(again, R, rtol=0, atol=1e-14)


# The text of a tree.


def tree_of(*joints: TreeJoint, **further) -> BodyTree:
    rng = np.random.default_rng(9)
    bodies = {"base": None} | {joint.child: random_body(rng) for joint in joints}
    bodies |= further.pop("bodies", {})
    return BodyTree("drawn", "MJCF", "base", bodies, joints, **further)


def turning(name: str, parent: str, at=(0.0, 0.0, 0.0), **further) -> TreeJoint:
    return TreeJoint(name, TURNS, parent, f"{name}_link", Pose(np.array(at, float)), **further)


def read(tree: BodyTree) -> Robot:
    robot = parse_robot_text(convert_tree(tree, "drawn.xml").text, "drawn.toml")
    assert not robot.readings
    return robot


def test_text_of_a_tree():
    joint = turning("a", "base", (0, 0, 0.4), damping=0.5, friction=0.2, armature=0.1, zero=0.3)
    spring = turning("b", "a_link", (0.3, 0, 0), stiffness=2.0, rest=0.1, lower=-1.0, upper=2.0)
    led = turning("c", "b_link", (0.2, 0, 0), leader="b", ratio=-0.5, offset=math.pi / 2)
    robot = read(tree_of(joint, spring, led, gravity=np.array([0.0, -9.8, 0.0])))
    assert [e.text for e in robot.gravity] == ["0", "-g", "0"]
    assert robot.relations["3"].text == "-0.5*q2 + pi/2"
    values = {name: robot.parameters[name] for name in ("Fv1", "Fs1", "Ia1", "Ks2")}
    assert values == {"Fv1": 0.5, "Fs1": 0.2, "Ia1": 0.1, "Ks2": 2.0}
    uses = {use.effect: use for use in robot.effects}
    assert {name: use.joints for name, use in uses.items()} == {
        "rotor_inertia": ("1", "2"),
        "viscous": ("1", "2"),
        "coulomb": ("1", "2"),
        "spring": ("2",),
        "offset": ("1", "2"),
    }
    assert uses["spring"].stated_instances[0].nonlinear_parameters == {"q0": 0.1, "h": 0.0}
    assert robot.uncertainty == {"inertial": 0.3}
    assert robot.limits.keys() == {"2"} and robot.limits["2"].upper == 2.0
    assert {f.joint for f in robot.frames.values()} == {"", "a", "b", "c"}


@with_cases(
    "pull, cells",
    ((1e-16, 0.0, -9.81), ["0", "0", "-g"]),
    ((9.80665, 0.0, 0.0), ["g", "0", "0"]),
    ((-3.1, 2e-5, -1.62), ["-3.1", "2e-05", "-1.62"]),
    ((0.0, 0.0, 0.0), ["0", "0", "0"]),
)
def test_gravity_is_a_symbol_along_an_axis(pull, cells):
    robot = read(tree_of(turning("a", "base"), gravity=np.array(pull)))
    values = robot.evaluate_symbols()
    assert [e.evaluate(values) for e in robot.gravity] == pytest.approx(pull, abs=1e-15)
    assert [cell.text for cell in robot.gravity] == cells


def test_bodies_without_values_have_no_prior():
    """Nothing stated, hidden between joints, placeholders; a frame without mass does no harm.

    What a file states of one body stays, however odd: no fit makes a prior of it. Among others
    it would be believed.
    """
    ways = ("base", "a_link", "b_link", "c_link", "d_link")
    joints = [turning(n, parent, (0.1, 0, 0)) for n, parent in zip("abcde", ways, strict=True)]
    frame = TreeJoint("mount", FIXED, "e_link", "flange", Pose(np.array([0.1, 0.0, 0.0])))
    fake = TreeJoint("glue", FIXED, "d_link", "marker", Pose(np.array([0.1, 0.0, 0.0])))
    nothing = Inertial(0.0, np.zeros(3), np.zeros((3, 3)))
    tree = tree_of(
        *joints,
        frame,
        fake,
        bodies={
            "a_link": None,
            "b_link": None,
            "c_link": Inertial(1.0, np.zeros(3), np.eye(3)),
            "flange": nothing,
            "marker": Inertial(1.0, np.zeros(3), np.eye(3)),
        },
        auxiliary_bodies=frozenset({"b_link"}),
        unreliable_bodies={name: "the identity as inertia" for name in ("c_link", "marker")}
        | {"flange": "mass 0"},
    )
    made = convert_tree(tree, "drawn.xml")
    robot = parse_robot_text(made.text, "drawn.toml")
    assert {n[1:] for n in robot.parameters if n.startswith("M") and n[1:].isdigit()} == {"3", "5"}
    assert robot.links == {"2": ()}
    assert 'no inertia is stated of "a_link"; they weigh nothing' in made.notes
    text = 'no values of "d_link", "marker", which move as one with such a body'
    assert text in made.notes
    assert robot.frames["flange"].row == "5" and robot.frames["flange"].joint == ""


TOOL = (Fraction(1, 10), -Fraction(1, 5), Fraction(7, 10))


def test_sums_of_decimals_are_decimals():
    """J + m (c.c 1 - c c') of printed numbers has the digits that exact arithmetic finds."""
    rng = np.random.default_rng()
    for _ in range(50):
        m, *way = (Fraction(int(n), 1000) for n in rng.integers(-900, 900, 4))
        m, moment = abs(m) + 1, Fraction(int(rng.integers(100, 900)), 10**5)
        centre = np.array([float(x) for x in way])
        body = Inertial(float(m), centre, float(moment) * np.eye(3))
        lever = TreeJoint("t", FIXED, "a_link", "tool", Pose(np.array(TOOL, float)))
        text = convert_tree(
            tree_of(turning("a", "base"), lever, bodies={"a_link": None, "tool": body}), "drawn.xml"
        ).text
        c = [x + step for x, step in zip(way, TOOL, strict=True)]
        for i, row in enumerate(["XX1 XY1 XZ1", "XY1 YY1 YZ1", "XZ1 YZ1 ZZ1"]):
            for k, name in enumerate(row.split()):
                exact = (moment + m * sum(x * x for x in c)) * (i == k) - m * c[i] * c[k]
                assert f"{name} = {float(exact)!r}\n" in text
        for x, name in zip(c, ("MX1", "MY1", "MZ1"), strict=True):
            assert f"{name} = {float(m * x)!r}\n" in text


def test_a_robot_that_does_not_move_is_refused():
    still = TreeJoint("t", FIXED, "base", "tool")
    with pytest.raises(RobotError, match=r"drawn\.xml: no joint of the robot moves"):
        convert_tree(tree_of(still), "drawn.xml")


def test_odd_names_stay_in_one_line():
    tree = tree_of(turning('a "b" \\ \t#', "base"))
    robot = read(tree)
    assert robot.frames['a "b" \\ \t#_link'].joint == 'a "b" \\ \t#'
