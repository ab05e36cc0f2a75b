"""URDFs as body trees: against Pinocchio on public robots; what the schema says of each element."""

import math
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats.body_tree import (
    BodyTree,
    collect_moving_links,
    compute_body_poses,
    compute_standard_parameters,
)
from modeler.formats.tree_cuts import cut_tree, parse_lock_values
from modeler.formats.tree_text import convert_tree
from modeler.formats.urdf import read_urdf_tree
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import JointKind
from tests.robot.public_robots import each_public_urdf
from tests.robot.texts import ARM_URDF as ARM, edited
from tests.rotation import with_cases


def read(text: str = ARM, exact_decimals: bool = False) -> BodyTree:
    return read_urdf_tree(text.encode(), "arm.urdf", exact_decimals)


def positions(tree: BodyTree, seed: int) -> dict[str, float]:
    """Random positions of the joints, followers where their leader puts them."""
    rng = np.random.default_rng(seed)
    q = {joint.name: float(rng.uniform(-2, 2)) for joint in tree.joints}
    for joint in tree.joints:
        if joint.leader:
            q[joint.name] = joint.ratio * q[joint.leader] + joint.offset
    return q


def soft_limits(data: bytes, name: str) -> tuple[float, float]:
    """Of the safety_controller, by the standard library; Pinocchio does not read it."""
    joint = ElementTree.fromstring(data).find(f"joint[@name='{name}']/safety_controller")
    inputs = {} if joint is None else joint.attrib
    low, high = (float(inputs.get(f"soft_{end}_limit", 0.0)) for end in ("lower", "upper"))
    return (low, high) if low < high else (-math.inf, math.inf)


def joint_of(tree: BodyTree, name: str):
    return next(joint for joint in tree.joints if joint.name == name)


@each_public_urdf()
def test_public_robots_are_those_of_pinocchio(path: Path):
    """Every link at random positions, the lumped bodies, dampings and limits."""
    pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: Pinocchio is not installed")
    data = path.read_bytes()
    if b"<link" not in data:
        with pytest.raises(RobotError, match="has no link"):
            read_urdf_tree(data, path.name)
        return
    tree = cut_tree(read_urdf_tree(data, path.name, exact_decimals=True))
    model = pin.buildModelFromUrdf(str(path))
    state, q = pin.neutral(model), positions(tree, seed=zlib.crc32(path.stem.encode()))
    moving = [joint for joint in tree.joints if joint.kind is not JointKind.FIXED]
    assert {joint.name for joint in moving} == set(model.names) - {"universe"}
    for joint in moving:
        theirs = model.joints[model.getJointId(joint.name)]
        at = theirs.idx_q
        if theirs.nq == 2:
            state[at : at + 2] = math.cos(q[joint.name]), math.sin(q[joint.name])
        else:
            state[at] = q[joint.name]
            if joint.lower is not None and joint.upper is not None:
                soft = soft_limits(data, joint.name)
                assert max(model.lowerPositionLimit[at], soft[0]) == joint.lower
                assert min(model.upperPositionLimit[at], soft[1]) == joint.upper
        if joint.damping is not None:
            assert model.damping[theirs.idx_v] == joint.damping
        if joint.effort is not None:
            assert model.effortLimit[theirs.idx_v] == joint.effort
    known = model.createData()
    pin.framesForwardKinematics(model, known, state)
    for name, pose in compute_body_poses(tree, q).items():
        theirs = known.oMf[model.getFrameId(name, pin.FrameType.BODY)]
        assert np.allclose(pose.position, theirs.translation, rtol=0, atol=1e-12), name
        assert np.allclose(pose.rotation, theirs.rotation, rtol=0, atol=1e-12), name
    for link in collect_moving_links(tree):
        number = 0 if link.joint is None else model.getJointId(link.joint.name)
        theirs = model.inertias[number].toDynamicParameters()  # m, mc, xx xy yy xz yz zz
        ours = np.zeros(10) if link.inertial is None else compute_standard_parameters(link.inertial)
        order = [9, 6, 7, 8, 0, 1, 3, 2, 4, 5]
        assert np.allclose(ours[order], theirs, rtol=1e-11, atol=1e-13), link.bodies


def test_right_angles_are_exact():
    tree = read()
    shoulder = joint_of(tree, "shoulder").pose.rotation
    assert np.array_equal(shoulder, [[0, 0, -1], [-1, 0, 0], [0, 1, 0]])
    assert not np.signbit(shoulder[shoulder == 0]).any()
    elbow = joint_of(tree, "elbow").pose
    assert np.array_equal(elbow.position, [0.3, 0, 0])
    assert elbow.rotation[2, 0] == -math.sqrt(0.5)
    lines = [note for note in tree.notes if "exact here" in note]
    assert len(lines) == 1 and "1.5708 is pi/2" in lines[0] and "0.7854 is pi/4" in lines[0]
    assert any("1 lengths, angles" in note for note in tree.notes)
    stored = joint_of(read(exact_decimals=True), "shoulder").pose.rotation
    assert stored[2, 2] == pytest.approx(math.cos(1.5708), rel=1e-9)
    assert stored[2, 2] != 0


def test_elements_of_the_schema():
    tree = read()
    assert (tree.name, tree.format, tree.root) == ("arm", "URDF", "base")
    shoulder, elbow, _, finger, other = tree.joints
    assert (shoulder.lower, shoulder.upper, shoulder.speed, shoulder.effort) == (-1.5, 2, 3, 40)
    assert (shoulder.damping, shoulder.friction, shoulder.armature) == (0.7, 1.5, None)
    assert np.array_equal(shoulder.axis, [0, 0, 1])
    assert any("length 1" in note and "shoulder" in note for note in tree.notes)
    assert np.array_equal(elbow.axis, [1, 0, 0]) and elbow.lower is elbow.damping is None
    assert (finger.lower, finger.upper, finger.speed, finger.effort) == (0, 0.04, None, None)
    assert (other.leader, other.ratio, other.offset) == ("finger", -2, 0.01)
    assert (other.actuated, finger.actuated) == (False, True)
    assert tree.bodies["base"] is None
    assert not any("weigh nothing" in note for note in cut_tree(tree, tip="flange").notes)


def test_joints_are_sorted_only_as_far_as_must_be():
    head, *joints = ARM.removesuffix("</robot>\n").split("  <joint ")
    moved = [*joints[1:4], joints[0], joints[4], "</robot>"]
    tree = read(head + "  <joint ".join(["", *moved[:-1]]) + moved[-1])
    order = ["shoulder", "elbow", "wrist", "finger", "other"]
    assert [joint.name for joint in tree.joints] == order


def test_mimic_joints_have_one_leader():
    led = '<mimic joint="elbow" multiplier="3" offset="1"/><limit'
    other = joint_of(read(edited(ARM, ('<axis xyz="0 1 0"/><limit', led))), "other")
    assert (other.leader, other.ratio) == ("elbow", -6)
    assert other.offset == pytest.approx(-2 + 0.01)
    still = read(edited(ARM, ('multiplier="-2"', 'multiplier="0"')))
    assert joint_of(still, "other").kind is JointKind.FIXED
    assert np.allclose(joint_of(still, "other").pose.position, [0, 0.01, 0])
    lost = read(edited(ARM, ('mimic joint="finger"', 'mimic joint="finge"')))
    assert not joint_of(lost, "other").leader
    assert any('"other of finge"' in note for note in lost.notes)


FREE = ('type="continuous"', 'type="floating"')


def test_a_floating_base_stands_still():
    tree = cut_tree(read(edited(ARM, ('type="revolute"', 'type="floating"'))))
    assert joint_of(tree, "shoulder").kind is JointKind.FIXED
    assert any("shoulder" in note and "floating" in note for note in tree.notes)
    assert not tree.unsupported_joints


def test_other_joints_are_refused_cut_off_or_held():
    text = edited(ARM, FREE)
    message = 'arm.urdf: line 22: joint "elbow": floating joints are.*--lock elbow=0'
    with pytest.raises(RobotError, match=message):
        cut_tree(read(text))
    held = cut_tree(read(text), locks={"elbow": 0})
    assert len(collect_moving_links(held)) == 4
    assert len(cut_tree(read(text), tip="upper").joints) == 1
    base = cut_tree(read(text), base="fore")
    assert {joint.name for joint in base.joints} == {"wrist", "finger", "other"}
    with pytest.raises(RobotError, match="expected 0: a floating joint"):
        cut_tree(read(text), locks={"elbow": 0.1})


def test_gravity_is_seen_from_the_new_base():
    """It points where it pointed, and frames stand to each other as before."""
    tree, base = read(), cut_tree(read(), base="upper")
    q = positions(tree, 3) | {"shoulder": 0.0}
    before, after = compute_body_poses(tree, q), compute_body_poses(base, q)
    assert np.allclose(before["upper"].rotation @ base.gravity, tree.gravity, atol=1e-15)
    for name, pose in after.items():
        expected = before["upper"].inverse() @ before[name]
        assert np.allclose(pose.position, expected.position, atol=1e-14)
    assert any("gravity" in note for note in base.notes) and "base" not in base.bodies


def test_a_tip_keeps_what_is_fixed_on_the_way():
    tree = cut_tree(read(), tip="left")
    assert set(tree.bodies) == set(read().bodies) - {"right"}
    short = cut_tree(read(), tip="fore")
    assert set(short.bodies) == {"base", "upper", "fore", "flange"}
    assert sum(link.inertial.mass for link in collect_moving_links(short) if link.inertial) == 4.0
    gone = cut_tree(read(), tip="upper")
    assert any("1.5 kg" in note and "--lock" in note for note in gone.notes)
    led = cut_tree(read(), tip="right")
    assert joint_of(led, "other").kind is JointKind.FIXED


def test_locked_joints_lump_their_bodies():
    """Placements are those of the tree at that position; the mass stays."""
    tree = read()
    locked = cut_tree(tree, locks={"elbow": "30 deg", "finger": "20 mm"})
    q = positions(tree, 5) | {"elbow": math.pi / 6, "finger": 0.02, "other": -0.03}
    ours, theirs = compute_body_poses(locked, q), compute_body_poses(tree, q)
    for name, pose in ours.items():
        assert np.allclose(pose.position, theirs[name].position, atol=1e-14), name
        assert np.allclose(pose.rotation, theirs[name].rotation, atol=1e-14), name
    _, link = collect_moving_links(locked)
    assert link.inertial is not None and link.inertial.mass == 4.0
    assert any("outside" in note for note in cut_tree(tree, locks={"shoulder": 3}).notes)


def test_followers_with_an_offset_stop_with_their_leader():
    """By a relation in the text, which is gone where the leader is locked."""
    ratio, shift, at = np.random.default_rng().uniform(-1, 1, 3).round(3).tolist()
    text = edited(ARM, ('multiplier="-2" offset="0.01"', f'multiplier="{ratio}" offset="{shift}"'))
    robot = parse_robot_text(convert_tree(cut_tree(read(text)), "arm.urdf").text, "arm.toml")
    assert robot.relations["4"].evaluate({"q3": at}) == pytest.approx(ratio * at + shift, abs=1e-15)
    made = convert_tree(cut_tree(read(text), locks={"finger": at}), "arm.urdf")
    assert not parse_robot_text(made.text, "arm.toml").relations


def test_cuts_name_what_they_do_not_find():
    for cuts, text in (
        ({"base": "uper"}, r'--base: "uper": no link of that name in arm \(did you mean "upper"'),
        ({"tip": "elbow"}, '--tip: "elbow": is a joint; expected a link'),
        ({"locks": {"elbo": 1}}, r'"elbo": no joint of .*\(did you mean "elbow".* of .*finger'),
        ({"locks": {"other": 1}}, 'follows joint "finger"; lock that one'),
        ({"locks": {"finger": "30 deg"}}, 'got "30 deg"; expected a position in m'),
        ({"locks": {"elbow": "30 mm"}}, "expected a position in rad"),
        ({"locks": {"elbow": "far"}}, "expected a position in rad or m"),
        ({"locks": {"elbow": "1/0"}}, "expected a position in rad or m"),
    ):
        with pytest.raises(RobotError, match=text):
            cut_tree(read(), **cuts)
    assert parse_lock_values(["a=b=30 deg", "c = 1"]) == {"a=b": "30 deg", "c": "1"}
    for texts in (["elbow"], ["=1"], ["a=1", "a=2"]):
        with pytest.raises(RobotError, match="--lock"):
            parse_lock_values(texts)


def notes_of(text: str, **cuts: str) -> tuple[str, ...]:
    return convert_tree(cut_tree(read(text), **cuts), "arm.urdf").notes


def test_only_moving_bodies_without_mass_are_told():
    """No base, no frame on a body that weighs something; a moving link of which nothing does."""
    frames = '<link name="tool0"/><joint name="t" type="fixed"><parent link="%s"/><child link='
    frames += '"tool0"/></joint><link name="camera"/><joint name="c" type="fixed"><parent link='
    frames += '"base"/><child link="camera"/></joint></robot>'
    on_arm, on_finger = (edited(ARM, ("</robot>", frames % link)) for link in ("flange", "left"))
    assert [n for n in notes_of(on_arm) if "weigh nothing" in n] == [
        'no inertia is stated of "left", "right"; they weigh nothing'
    ]
    assert any('of "left", "tool0", "right"; they weigh' in n for n in notes_of(on_finger))
    light = edited(ARM, ('<mass value="0.5"/>', '<mass value="0"/>'))
    assert not any("mass 0" in note for note in notes_of(light))
    alone = edited(light, ('<mass value="1"/>', '<mass value="0"/>'))
    assert 'mass 0: "fore", "flange"' in notes_of(alone)
    assert not any("mass 0" in n for n in notes_of(alone, base="fore"))  # they stand still then


INERTIA = 'ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"'


@with_cases(
    "mass, inertia, message",
    ("0", INERTIA, "mass 0"),
    ("-1", INERTIA, "mass -1 kg is negative"),
    ("1", INERTIA.replace("0.001", "0"), "inertia 0"),
    ("1", INERTIA.replace("0.001", "1"), "identity"),
    ("1", INERTIA.replace('izz="0.001"', 'izz="0.0031"'), "0.001, 0.001, 0.0031 kg m2"),
    ("1", INERTIA.replace('iyy="0.001"', 'iyy="-0.001"'), "negative"),
    ("1", INERTIA, ""),
    # 0.0014 + 0.0014 > 0.0026: within what the printed digits say.
    ("1", INERTIA.replace('izz="0.001"', 'izz="0.003"'), ""),
)
def test_doubted_bodies_are_told(mass: str, inertia: str, message: str):
    text = edited(ARM, (INERTIA, inertia), ('mass value="0.5"', f'mass value="{mass}"'))
    tree = cut_tree(read(text))
    assert message in tree.unreliable_bodies.get("flange", "")
    assert bool(message) == bool(tree.unreliable_bodies)
    notes = [note for note in notes_of(text) if '"flange"' in note and "move as one" not in note]
    if message and message != "mass 0":
        assert len(notes) == 1 and message in notes[0]
        message = [note for note in notes_of(text, base="flange") if "gravity" not in note]
        assert not any('"flange"' in note for note in message)
    else:
        assert not notes
