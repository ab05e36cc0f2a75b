"""Rows of random trees: poses and torques by Pinocchio, cells that are 0, axes nearly parallel."""

import math
from fractions import Fraction

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import base_parameters
from modeler.derivation.derive import derive_model
from modeler.estimation.prior import prior_of
from modeler.robot import mdh_rows
from modeler.robot.body_tree import (
    BodyTree,
    Inertial,
    Meeting,
    Pose,
    TreeJoint,
    about_origin,
    moving_links,
)
from modeler.robot.mdh_rows import MdhTable, exact_length, exact_turn, mdh_table, roll_pitch_yaw
from modeler.robot.read import robot_from_text
from modeler.robot.robot import JointKind as Kind, Robot
from modeler.robot.tree_text import tree_to_toml
from tests.elementary_motions import row_pose

pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: Pinocchio (PyPI: pin) is not installed")

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
        angles = [rng.uniform(-3, 3, 3), rng.integers(-6, 7, 3) * math.pi / 12, np.zeros(3)][
            way % 3
        ]
        position = np.round(rng.uniform(-0.5, 0.5, 3) * rng.integers(0, 2, 3), 4)
        turn = pin.rpy.rpyToMatrix(*angles)
        axis = rng.choice([-1.0, 1.0]) * np.eye(3)[rng.integers(3)]
        if way == 0:
            axis = rng.normal(size=3)
            axis /= np.linalg.norm(axis)
        if tilt:
            turn, axis = rotation([*rng.normal(size=2), 0.0], tilt * (k % 2)), np.eye(3)[2]
        zero = float(rng.choice([0.0, 0.0, math.pi / 2, 0.3]))
        point = np.round(rng.uniform(-0.1, 0.1, 3), 3) * (rng.random() < 0.3)
        joint = TreeJoint(
            f"j{k}", kind, parent, f"b{k}", Pose(position, turn), axis, point, zero
        )  # fmt: skip
        joints.append(joint)
        bodies[f"b{k}"] = random_body(rng) if rng.random() < 0.9 else None
    gravity = np.array([0.3, 0.2, -9.81])
    return BodyTree("drawn", "URDF", "base", bodies, tuple(joints), gravity=gravity)


class Peer:
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
        found = np.zeros(self.model.nv)
        found[self.rows] = q
        return found

    def torque(self, q, qd, qdd):
        state = (self.in_order(q - self.zero), self.in_order(qd), self.in_order(qdd))
        return pin.rnea(self.model, self.data, *state)[self.rows]

    def poses(self, q) -> dict[str, np.ndarray]:
        pin.forwardKinematics(self.model, self.data, self.in_order(q - self.zero))
        return {
            body: (self.data.oMi[index] * place).homogeneous
            for body, (index, place) in self.at.items()
        }


def homogeneous(pose: Pose) -> np.ndarray:
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = pose.rotation, pose.position
    return found


def placed_rows(table: MdhTable, q) -> dict[str, np.ndarray]:
    poses, left = {"0": np.eye(4)}, iter(q)
    for row in table.rows:
        cells = dict(row.cells)
        if row.joint is not None:
            column = "theta" if row.kind is TURNS else "r"
            cells[column] += next(left)
        poses[row.name] = poses[row.antecedent] @ row_pose(**cells)
    return poses


def torques_of_rows(tree: BodyTree, table: MdhTable) -> Peer:
    """Of the rows alone, with the standard parameters about their origins."""
    links = moving_links(tree)
    joints = []
    bodies: dict[str, Inertial | None] = {"0": None}
    for row in table.rows:
        first = {c: row.cells.get(c, 0.0) for c in ("gamma", "b", "alpha", "d", "theta", "r")}
        M = row_pose(**first)
        name, axis = row.joint.name if row.joint else row.name, np.array([0.0, 0.0, 1.0])
        pose = Pose(M[:3, 3], M[:3, :3])
        joints.append(TreeJoint(name, row.kind, row.antecedent, row.name, pose, axis))
        bodies[row.name] = None
    peer = Peer(BodyTree("rows", "", "0", bodies, tuple(joints), gravity=tree.gravity))
    for link, name, place in zip(links, table.names, table.places, strict=True):
        if link.inertial is not None and name != "0":
            ten = about_origin(link.inertial.seen_from(place))
            dynamic = ten[[9, 6, 7, 8, 0, 1, 3, 2, 4, 5]]
            inertia = pin.Inertia.FromDynamicParameters(dynamic)
            peer.model.inertias[peer.at[name][0]] = inertia
    return peer


def errors(tree: BodyTree, rng) -> tuple[float, float]:
    """Largest error of a pose, and of a torque over the largest torque."""
    links = moving_links(tree)
    table = mdh_table(links)
    one, other = Peer(tree), torques_of_rows(tree, table)
    pose = torque = 0.0
    for _ in range(3):
        q, qd, qdd = rng.uniform(-2, 2, (3, len(links) - 1))
        theirs, rows = one.poses(q), placed_rows(table, q)
        for link, name, place in zip(links, table.names, table.places, strict=True):
            for body, inner in link.bodies.items():
                ours = rows[name] @ homogeneous(place @ inner)
                pose = max(pose, np.abs(ours - theirs[body]).max())
        tau = one.torque(q, qd, qdd)
        wrong = np.abs(other.torque(q, qd, qdd) - tau).max()
        torque = max(torque, wrong / (np.abs(tau).max() or 1.0))
    return pose, torque


def trees(seed: int, count: int, **drawn):
    found = (random_tree(np.random.default_rng([seed, k]), **drawn) for k in range(count))
    return [tree for tree in found if any(j.kind is not FIXED for j in tree.joints)]


def test_random_trees_have_their_poses_and_torques():
    rng = np.random.default_rng(31)
    for tree in trees(71, 120):
        pose, torque = errors(tree, rng)
        assert pose < 2e-12 and torque < 1e-11, tree.joints


def test_serial_chains_need_neither_gamma_nor_b():
    """But for the first row, which starts from a frame that is given, and sliding joints."""
    for tree in trees(72, 60, serial=True):
        if any(joint.kind is SLIDES for joint in tree.joints):
            continue
        for row in mdh_table(moving_links(tree)).rows[1:]:
            assert row.cells["gamma"] == row.cells["b"] == 0.0


@pytest.mark.parametrize("tilt", [1e-2, 1e-3, 1e-4, 1e-6])
def test_nearly_parallel_axes_keep_their_accuracy(tilt):
    """A foot 100 m to 100 km away would lose up to all digits; a fixed row loses none."""
    rng = np.random.default_rng(33)
    for tree in trees(73, 25, tilt=tilt, serial=True):
        pose, torque = errors(tree, rng)
        assert pose < 2e-9  # an angle within 1e-9 of a right one is one
        assert torque < 2e-9
        table, ways = mdh_table(moving_links(tree)), [np.abs(j.pose.position) for j in tree.joints]
        most = mdh_rows.FAR * 3 * (max(map(np.max, ways)) or 1.0)
        for row in table.rows:
            assert max(abs(row.cells.get(c, 0.0)) for c in "bdr") < most


def test_without_fixed_rows_they_lose_it(monkeypatch):
    """What the rule is for, at axes that are parallel but for 1e-4."""
    rng = np.random.default_rng(34)
    drawn = trees(74, 25, tilt=3e-5, serial=True)
    within = max(errors(tree, rng)[1] for tree in drawn)
    monkeypatch.setattr(mdh_rows, "FAR", math.inf)
    assert max(errors(tree, rng)[1] for tree in drawn) > 1e3 * within


def test_numbers_are_exact_where_they_are():
    assert exact_length(0.1 + 0.2) == 0.3 and str(exact_length(-1e-17)) == "0.0"
    assert exact_length(1 / 3) == 1 / 3
    assert exact_turn(3 * math.pi / 2) == -math.pi / 2
    assert exact_turn(-math.pi) == exact_turn(math.pi) == math.pi
    assert exact_turn(0.7) == 0.7 and exact_turn(math.pi / 12 + 1e-8) != math.pi / 12
    rng = np.random.default_rng(5)
    for angles in [*rng.uniform(-3, 3, (20, 3)), (0.3, math.pi / 2, 0.4), (1.0, -math.pi / 2, 2)]:
        R = pin.rpy.rpyToMatrix(*map(float, angles))
        found = pin.rpy.rpyToMatrix(*roll_pitch_yaw(R))
        np.testing.assert_allclose(found, R, rtol=0, atol=1e-14)


# The text of a tree.


def tree_of(*joints: TreeJoint, **further) -> BodyTree:
    rng = np.random.default_rng(9)
    bodies = {"base": None} | {joint.child: random_body(rng) for joint in joints}
    bodies |= further.pop("bodies", {})
    return BodyTree("drawn", "MJCF", "base", bodies, joints, **further)


def turning(name: str, parent: str, at=(0.0, 0.0, 0.0), **further) -> TreeJoint:
    return TreeJoint(name, TURNS, parent, f"{name}_link", Pose(np.array(at, float)), **further)


def read(tree: BodyTree) -> Robot:
    robot = robot_from_text(tree_to_toml(tree, "drawn.xml").text, "drawn.toml")
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
        "rotor_inertia": ("1", "2"), "viscous": ("1", "2"), "coulomb": ("1", "2"), "spring": ("2",),
        "offset": ("1", "2"),
    }  # fmt: skip
    assert uses["spring"].shaped[0].shapes == {"q0": 0.1, "h": 0.0}
    assert robot.uncertainty == {"inertial": 0.3}
    assert robot.limits.keys() == {"2"} and robot.limits["2"].upper == 2.0
    assert {f.joint for f in robot.frames.values()} == {"", "a", "b", "c"}


@pytest.mark.parametrize(
    ("pull", "cells"),
    [
        ((1e-16, 0.0, -9.81), ["0", "0", "-g"]),
        ((9.80665, 0.0, 0.0), ["g", "0", "0"]),
        ((-3.1, 2e-5, -1.62), ["-3.1", "2e-05", "-1.62"]),
        ((0.0, 0.0, 0.0), ["0", "0", "0"]),
    ],
)
def test_gravity_is_a_symbol_along_an_axis(pull, cells):
    robot = read(tree_of(turning("a", "base"), gravity=np.array(pull)))
    values = robot.symbol_values()
    assert [e.number(values) for e in robot.gravity] == pytest.approx(pull, abs=1e-15)
    assert [cell.text for cell in robot.gravity] == cells


def test_bodies_without_values_have_no_prior():
    """Nothing stated, hidden between joints, placeholders; a frame without mass does no harm.

    What a file states of one body stays, however odd: no fit makes a prior of it. Among others
    it would be believed.
    """
    ways = ("base", "a_link", "b_link", "c_link", "d_link")
    joints = [
        turning(name, parent, (0.1, 0, 0)) for name, parent in zip("abcde", ways, strict=True)
    ]
    frame = TreeJoint("mount", FIXED, "e_link", "flange", Pose(np.array([0.1, 0.0, 0.0])))
    fake = TreeJoint("glue", FIXED, "d_link", "marker", Pose(np.array([0.1, 0.0, 0.0])))
    nothing = Inertial(0.0, np.zeros(3), np.zeros((3, 3)))
    tree = tree_of(
        *joints,
        frame,
        fake,
        bodies={
            "a_link": None, "b_link": None, "c_link": Inertial(1.0, np.zeros(3), np.eye(3)),
            "flange": nothing, "marker": Inertial(1.0, np.zeros(3), np.eye(3)),
        },
        hidden=frozenset({"b_link"}),
        doubted={name: "the identity as inertia" for name in ("c_link", "marker")}
        | {"flange": "mass 0"},
    )  # fmt: skip
    made = tree_to_toml(tree, "drawn.xml")
    robot = robot_from_text(made.text, "drawn.toml")
    assert {n[1:] for n in robot.parameters if n.startswith("M") and n[1:].isdigit()} == {"3", "5"}
    assert robot.links == {"2": ()}
    assert 'no inertia is stated of "a_link"; they weigh nothing' in made.notes
    told = 'no values of "d_link", "marker", which move as one with such a body'
    assert told in made.notes
    model = derive_model(robot)
    without = prior_of(emit(model, base_parameters(model)).spec).without
    assert without["link 3"] == "identity inertia" and "link 5" not in without
    assert robot.frames["flange"].row == "5" and robot.frames["flange"].joint == ""


def test_lumped_bodies_are_one():
    """A body on a fixed joint is counted to the link that carries it, in the frame of the row."""
    upper, tool = turning("a", "base"), TreeJoint("t", FIXED, "a_link", "tool")
    arm = Inertial(2.0, np.array([0.1, 0.0, 0.0]), np.diag([0.01, 0.02, 0.03]))
    load = Inertial(1.0, np.array([0.4, 0.0, 0.0]), np.diag([0.001, 0.001, 0.001]))
    robot = read(tree_of(upper, tool, bodies={"a_link": arm, "tool": load}))
    assert robot.parameters["M1"] == 3.0
    assert robot.parameters["MX1"] == pytest.approx(0.2 + 0.4)
    assert robot.parameters["ZZ1"] == pytest.approx(0.03 + 2 * 0.01 + 0.001 + 0.16)


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
        text = tree_to_toml(
            tree_of(turning("a", "base"), lever, bodies={"a_link": None, "tool": body}), "drawn.xml"
        ).text
        c = [x + step for x, step in zip(way, TOOL, strict=True)]
        for i, row in enumerate(["XX1 XY1 XZ1", "XY1 YY1 YZ1", "XZ1 YZ1 ZZ1"]):
            for k, name in enumerate(row.split()):
                exact = (moment + m * sum(x * x for x in c)) * (i == k) - m * c[i] * c[k]
                assert f"{name} = {float(exact)!r}\n" in text
        for x, name in zip(c, ("MX1", "MY1", "MZ1"), strict=True):
            assert f"{name} = {float(m * x)!r}\n" in text


def test_points_that_meet_close_a_loop():
    crank = turning("a", "base")
    coupler, rocker = (
        turning("b", "a_link", (0.2, 0, 0), actuated=False),
        turning("c", "base", (0.5, -0.3, 0), actuated=False, damping=0.1),
    )
    meeting = Meeting(
        "pin", "b_link", Pose(np.array([0.3, 0, 0])), "c_link", Pose(np.array([0, 0.3, 0]))
    )
    tree = tree_of(crank, coupler, rocker, meetings=(meeting,))
    robot, notes = read(tree), tree_to_toml(tree, "drawn.xml").notes
    assert any(note.startswith("added to the actuated joints: rotor_inertia,") for note in notes)
    assert [(loop.frame, loop.meets, loop.kind) for loop in robot.loops] == [
        ("P1a", "P1b", "spherical")
    ]
    assert robot.home == {"1": 0.0, "2": 0.0, "3": 0.0}
    assert [joint.name for joint in robot.coordinates] == ["1"]
    values = robot.symbol_values() | dict.fromkeys(("q1", "q2", "q3"), 0.0)
    ends = {"0": np.eye(4)}
    for row in robot.joints:
        cells = {
            c: getattr(row, c).number(values) for c in ("gamma", "b", "alpha", "d", "theta", "r")
        }
        ends[row.name] = ends[row.antecedent] @ row_pose(**cells)
    for name in ("P1a", "P1b"):
        np.testing.assert_allclose(ends[name][:3, 3], [0.5, 0, 0], atol=1e-15)
    assert {use.effect: use.joints for use in robot.effects}["viscous"] == ("1", "3")
    assert len(robot.symbols) == 6  # one for both lengths of 0.3


def test_a_file_without_motors_has_one_on_every_joint():
    made = tree_to_toml(tree_of(turning("a", "base", actuated=False)), "drawn.xml")
    assert robot_from_text(made.text, "x").joints[0].actuated
    assert "the file states no motor: all joints are taken as actuated" in made.notes


def test_a_robot_that_does_not_move_is_refused():
    still = TreeJoint("t", FIXED, "base", "tool")
    with pytest.raises(RobotError, match=r"drawn\.xml: no joint of the robot moves"):
        tree_to_toml(tree_of(still), "drawn.xml")


def test_odd_names_stay_in_one_line():
    tree = tree_of(turning('a "b" \\ \t#', "base"))
    robot = read(tree)
    assert robot.frames['a "b" \\ \t#_link'].joint == 'a "b" \\ \t#'


# `[frames]` of a robot file.

FRAMES = """
name = "f"
gravity = [0, 0, 0]
[symbols]
L = 0.2
[mdh]
columns = ["j", "theta"]
rows = [["1", "q1"]]
[frames]
columns = ["link", "row", "joint", "x", "yaw"]
rows = [["hand", "1", "wrist", "L/2", "90 deg"], ["base", 0, "", 0, 0]]
"""


def test_frames_are_read():
    robot = robot_from_text(FRAMES, "f.toml")
    hand, values = robot.frames["hand"], robot.symbol_values()
    assert (hand.row, hand.joint) == ("1", "wrist")
    assert [x.number(values) for x in hand.position] == [0.1, 0.0, 0.0]
    assert [x.number(values) for x in hand.angles] == [0.0, 0.0, math.pi / 2]
    assert robot.frames["base"].row == "0"


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"link", "row"', '"link", "link"', r"\[frames\], columns: got .*; expected link, row and"),
        ('"yaw"]', '"jaw"]', r"expected link, row and any of joint, x, y, z"),
        ('"hand", "1"', '"hand", "7"', r'row 1 \("hand"\), column row: got "7"; expected the name'),
        ('"base", 0', '"hand", 0', r'row 2 \("hand"\): the link stands there twice'),
        ('"base", 0', '"", 0', r'column link: got ""; expected text such as "hand"'),
        ('"wrist"', "7", r'column joint: got 7; expected a name, or ""'),
        ('"L/2"', '"L/K"', r"column x: .*K is not declared"),
        ('"L/2"', '"q1"', r"column x: .*q1"),
        ('"90 deg"', '"0.2 m"', r'column yaw: got "0.2 m"'),
        (", 0, 0]]", "]]", r"row 2: got 3 entries, expected 5"),
        ('rows = [["hand"', 'lines = [["hand"', r'unknown key "lines"'),
    ],
)
def test_mistakes_in_frames_are_told(old, new, told):
    assert old in FRAMES
    with pytest.raises(RobotError, match=told):
        robot_from_text(FRAMES.replace(old, new, 1), "f.toml")
