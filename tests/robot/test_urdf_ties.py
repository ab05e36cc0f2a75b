"""Quaternions, couplings, loops, gears and springs of URDFs, in the ways that tools write them."""

import tomllib

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats.body_tree import BodyTree, Pose, compute_body_poses
from modeler.formats.tree_cuts import cut_tree
from modeler.formats.tree_text import convert_tree
from modeler.formats.urdf import read_urdf_tree
from modeler.robot.read import parse_robot_text
from tests.elementary_motions import frames
from tests.robot.poses import origin_pose
from tests.rotation import with_cases

BODY = (
    '<link name="%s"><inertial><origin xyz="0.1 0.02 -0.03"/><mass value="1"/><inertia ixx="0.02" '
    'ixy="0.001" ixz="-0.002" iyy="0.03" iyz="0.0015" izz="0.025"/></inertial></link>'
)
LIMIT = '<limit lower="-2" upper="2" velocity="3" effort="9"/>'


def joint(name: str, parent: str, child: str, more: str = "", kind: str = "revolute") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    axis = "" if "<axis" in more else '<axis xyz="0 1 0"/>'
    limit = LIMIT if kind == "revolute" else ""
    return f'<joint name="{name}" type="{kind}">{ends}{axis}{limit}{more}</joint>'


def urdf(*parts: str) -> str:
    """A base and links a, b, c, and what stands behind them."""
    bodies = "".join(BODY % name for name in "abc")
    return f'<robot name="arm"><link name="base"/>{bodies}{"".join(parts)}</robot>'


def read(text: str) -> BodyTree:
    return cut_tree(read_urdf_tree(text.encode(), "arm.urdf"))


def toml(text: str) -> str:
    """The robot file without its notes."""
    made = convert_tree(read(text), "arm.urdf").text
    return made[made.index("gravity =") :]


def notes_of(text: str) -> str:
    return "\n".join(convert_tree(read(text), "arm.urdf").notes)


# Quaternions.


def quaternion(roll: float, pitch: float, yaw: float) -> str:
    """x y z w of Rz(yaw) Ry(pitch) Rx(roll), by half angles."""
    wxyz = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip((2, 1, 0), (yaw, pitch, roll), strict=True):
        w, x, y, z = wxyz
        c, s = np.cos(angle / 2), np.eye(3)[axis] * np.sin(angle / 2)
        v = np.array([x, y, z])
        wxyz = np.array([w * c - v @ s, *(w * s + c * v + np.cross(v, s))])
    return " ".join(repr(float(x)) for x in (*wxyz[1:], wxyz[0]))


CHAIN = joint("j3", "b", "c", '<origin xyz="0 0 0.2"/>')


@with_cases(
    "angles",
    (np.pi / 2, 0, -np.pi / 6),
    (np.pi, np.pi / 4, 0),
    *np.random.default_rng().uniform(-1.2, 1.2, (1, 3)).tolist(),
)
def test_a_quaternion_says_what_angles_say(angles) -> None:
    """In joints and in inertials: the same table and frames, and the same masses."""
    rpy = " ".join(repr(float(x)) for x in angles)
    both = []
    for way in (f'rpy="{rpy}"', f'quat_xyzw="{quaternion(*angles)}"'):
        turned = joint("j2", "a", "b", f'<origin xyz="0.3 0.1 0" {way}/>')
        text = urdf(joint("j1", "base", "a"), turned, CHAIN)
        text = text.replace('<origin xyz="0.1 0.02 -0.03"/>', f'<origin xyz="0.1 0 0" {way}/>', 2)
        values = tomllib.loads(toml(text))["parameters"]
        tree, q = read(text), {"j1": 0.4, "j2": -0.7, "j3": 1.1}
        both.append((values, compute_body_poses(tree, q), tree.bodies))
    (one, here, bodies), (two, there, others) = both
    one, two = ({k: v for k, v in values.items() if k != "uncertainty"} for values in (one, two))
    assert one == pytest.approx(two, rel=1e-12, abs=1e-13)
    for name in "abc":
        assert np.allclose(here[name].rotation, there[name].rotation, rtol=0, atol=1e-14)
        assert np.allclose(bodies[name].inertia, others[name].inertia, rtol=0, atol=1e-15)


# Couplings: the relation that <mimic> gives.

TREE = (joint("j1", "base", "a"), joint("j2", "base", "b"), joint("j3", "b", "c"))
MIMIC = '<mimic joint="j1" multiplier="-1.5" offset="%s"/>'
PLUGIN = (
    '<gazebo><plugin filename="libroboticsgroup_upatras_gazebo_mimic_joint_plugin.so" name="m">'
    "<joint>j1</joint><mimicJoint>j2</mimicJoint><multiplier>-1.5</multiplier>"
    "<offset>0.1</offset></plugin></gazebo>"
)
CONTROL = (
    '<ros2_control name="r" type="system"><hardware><plugin>mock/System</plugin></hardware>'
    '<joint name="j2"><param name="mimic">j1</param><param name="multiplier">-1.5</param>%s'
    '<state_interface name="position"/></joint></ros2_control>'
)
COUPLING = (
    '<coupling name="c"><predecessor link="a"/><successor link="b"/><ratio value="-1.5"/>'
    "</coupling>"
)


def mimic(offset: str = "0.1") -> str:
    return urdf(TREE[0], joint("j2", "base", "b", MIMIC % offset), TREE[2])


@pytest.mark.parametrize(
    ("text", "offset"),
    [
        (mimic().replace("<mimic", "<drake:mimic"), "0.1"),
        (urdf(*TREE, PLUGIN), "0.1"),
        (urdf(*TREE, CONTROL % '<param name="offset">0.1</param>'), "0.1"),
        (urdf(*TREE, CONTROL % ""), "0"),
        (urdf(*TREE, COUPLING), "0"),
        (mimic().replace("</robot>", PLUGIN + "</robot>"), "0.1"),  # said twice, alike
    ],
)
def test_couplings_are_relations(text: str, offset: str) -> None:
    assert "[relations]" in toml(text) and toml(text) == toml(mimic(offset))


# Loops.

FOUR = (
    joint("ja", "base", "a", kind="continuous"),
    joint("jb", "a", "b", '<origin xyz="0 0 0.2"/>', "continuous"),
    joint("jc", "base", "c", '<origin xyz="0.4 0 0"/>', "continuous"),
)
AXIS = '<axis xyz="0 1 0"/>'
CLOSED = {
    "gazebo": '<gazebo><joint name="pin" type="%s"><parent>b</parent><child>c</child><pose>0.05 0 '
    "0.3 0 0 0</pose><axis><xyz>0 1 0</xyz></axis></joint></gazebo>",
    "plus": '<loop name="pin" type="%s"><predecessor link="b"><origin xyz="0.45 0 0.1"/>'
    f'</predecessor><successor link="c"><origin xyz="0.05 0 0.3"/></successor>{AXIS}</loop>',
    "links": '<loop name="pin" type="%s"><link1 link="b"><origin xyz="0.45 0 0.1"/></link1>'
    f'<link2 link="c"><origin xyz="0.05 0 0.3"/></link2>{AXIS}</loop>',
    "drake": '<loop_joint name="pin" type="%s"><link1 link="b" xyz="0.45 0 0.1"/>'
    f'<link2 link="c" xyz="0.05 0 0.3"/>{AXIS}</loop_joint>',
    "isaac": '<loop_joint name="pin" type="%s"><link1 link="b" xyz="0.45 0 0.1" rpy="0 0 0"/>'
    f'<link1 link="c" xyz="0.05 0 0.3" rpy="0 0 0"/>{AXIS}</loop_joint>',
    "constraint": '<constraint name="pin" type="%s"><parent link="b"/><parent_origin '
    'xyz="0.45 0 0.1"/><parent_axis xyz="0 1 0"/><child link="c"/><child_origin '
    'xyz="0.05 0 0.3"/><child_axis xyz="0 1 0"/></constraint>',
}
BALL = (
    '<drake:ball_constraint><drake:ball_constraint_body_A name="b"/><drake:ball_constraint_p_AP '
    'value="0.45 0 0.1"/><drake:ball_constraint_body_B name="c"/><drake:ball_constraint_p_BQ '
    'value="0.05 0 0.3"/></drake:ball_constraint>'
)
CONNECT = """<mujoco model="arm"><compiler angle="radian"/><worldbody>%s</worldbody><equality>
<connect name="pin" body1="b" body2="c" anchor="0.45 0 0.1"/></equality></mujoco>"""
INERTIAL = (
    '<inertial pos="0.1 0.02 -0.03" mass="1" fullinertia="0.02 0.03 0.025 0.001 -0.002 0.0015"/>'
)


def body(name: str, place: str, inner: str = "") -> str:
    turns = f'<joint name="j{name}" axis="0 1 0"/>'
    return f'<body name="{name}" pos="{place}">{turns}{INERTIAL}{inner}</body>'


def parts(text: str) -> str:
    """Table, loops and home."""
    return text[text.index("[mdh]") : text.index("[frames]")]


def test_loops_of_all_tools_are_one_loop(tmp_path) -> None:
    """A point that meets a point is what MuJoCo's connect is; a pin has an axis besides."""
    mjcf = pytest.importorskip("modeler.formats.mjcf")
    pytest.importorskip("mujoco", reason="NOT CHECKED: mujoco-core is not installed")
    path = tmp_path / "arm.xml"
    inner = body("b", "0 0 0.2")
    path.write_text(CONNECT % (body("a", "0 0 0", inner) + body("c", "0.4 0 0")))
    expected = parts(convert_tree(mjcf.read_mjcf_tree(path), "arm.xml").text)
    assert '"spherical"' in expected
    assert parts(toml(urdf(*FOUR, BALL)).replace("ball_constraint", "pin")) == expected
    for name, loop in CLOSED.items():
        for kind in ("ball", "spherical"):
            assert parts(toml(urdf(*FOUR, loop % kind))) == expected, name
    pins = {name: toml(urdf(*FOUR, loop % "revolute")) for name, loop in CLOSED.items()}
    assert len(set(pins.values())) == 1 and '"revolute"' in pins["plus"]
    notes = notes_of(urdf(*FOUR, CLOSED["plus"] % "revolute"))
    assert 'the file states no motor: "ja" are taken as actuated' in notes


DRIVES = '<transmission name="t"><joint name="{}"/><actuator name="m"/></transmission>'.format


@with_cases(
    "more, driven",
    (DRIVES("jc"), "3"),
    (
        '<ros2_control name="r"><joint name="jc"><command_interface name="effort"/></joint>'
        '<joint name="ja"><state_interface name="position"/></joint></ros2_control>',
        "3",
    ),
    ("", "1"),
    ("independent", "3"),
)
def test_motors_of_a_loop_are_those_that_the_file_names(more: str, driven: str) -> None:
    """Or those that move on their own; the posture that a simulator starts from is [home]."""
    at = '<gazebo reference="jb"><initial_joint_position>0.4</initial_joint_position></gazebo>'
    text = urdf(*FOUR, CLOSED["plus"] % "revolute", at, more * (more != "independent"))
    if more == "independent":
        text = text.replace('name="jc"', 'name="jc" independent="true"')
    robot = parse_robot_text(convert_tree(read(text), "arm.urdf").text, "arm.toml")
    assert [j.name for j in robot.moving_joints if j.actuated] == [driven]
    assert robot.home == {"1": 0.0, "2": 0.4, "3": 0.0}


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("kind", ["revolute", "fixed", "cylindrical"])
def test_frames_that_meet_stand_where_the_file_has_them(kind: str, seed: int) -> None:
    """Origins and axes, and all of a rigid one, of drawn frames on links of a spatial loop."""
    rng = np.random.default_rng()
    places, turns = rng.uniform(-0.4, 0.4, (2, 2, 3)).round(7)  # no roundings of pi/12
    axis = (rng.normal(size=3) if seed else np.array([0, 0, 1.0])).round(3)
    ends = "".join(
        f'<link{k} link="{link}"><origin xyz="{" ".join(map(str, places[k - 1]))}" '
        f'rpy="{" ".join(map(str, turns[k - 1]))}"/></link{k}>'
        for k, link in ((1, "b"), (2, "c"))
    )
    loop = f'<loop name="x" type="{kind}">{ends}<axis xyz="{" ".join(map(str, axis))}"/></loop>'
    chain = (
        TREE[0],
        joint("j2", "a", "b", '<origin xyz="0 0.1 0.3" rpy="1 0 0"/>'),
        TREE[2].replace('<parent link="b"/>', '<parent link="base"/>'),
    )
    tree = read(urdf(*chain, loop, *map(DRIVES, ("j1", "j2", "j3"))))
    robot = parse_robot_text(convert_tree(tree, "arm.urdf").text, "arm.toml")
    q = dict(zip(("j1", "j2", "j3"), rng.uniform(-2, 2, 3), strict=True))
    rows = frames(robot, dict(zip("123", q.values(), strict=True)))
    bodies = compute_body_poses(tree, q)
    axis = axis / np.linalg.norm(axis)
    for k, link in enumerate("bc"):
        local = origin_pose(places[k], turns[k])
        expected = bodies[link] @ Pose(local[:3, 3], local[:3, :3])
        got = rows[f"P1{'ab'[k]}"]
        assert np.allclose(got[:3, 3], expected.position, rtol=0, atol=1e-9)
        if kind == "fixed":
            assert np.allclose(got[:3, :3], expected.rotation, rtol=0, atol=1e-9)
        else:
            assert np.allclose(got[:3, 2], expected.rotation @ axis, rtol=0, atol=1e-9)


def test_a_joint_of_the_base_with_the_world_closes_nothing() -> None:
    still = CLOSED["gazebo"].replace("<parent>b", "<parent>world")
    text = urdf(*FOUR, still.replace("<child>c", "<child>base") % "fixed")
    assert "[loops]" not in toml(text)
    assert 'loops within one body are left out: "pin"' in notes_of(text)


# Gears and springs.

GEAR = "<mechanicalReduction>%s</mechanicalReduction>"
ROTOR = "<motorInertia>1e-4</motorInertia>"
MOTOR = f'<actuator name="m">%s{ROTOR}</actuator>'


@with_cases(
    "inner, expected",
    (f'<joint name="j1">{GEAR % 1}</joint>{MOTOR % (GEAR % 100)}', 1.0),
    (f'{MOTOR % (GEAR % 100)}<joint name="j1">{GEAR % 1}</joint>', 1.0),
    (f'{MOTOR % ""}<joint name="j1">{GEAR % -50}</joint>', 0.25),
    (f'{MOTOR % ""}<joint name="j1"/>{GEAR % 10}', 0.01),
    (f'{MOTOR % ""}<joint name="j1"/>', 1e-4),
    (
        '<joint name="j1"/><actuator name="m"><drake:gear_ratio value="20"/>'
        '<drake:rotor_inertia value="1e-3"/></actuator>',
        0.4,
    ),
)
def test_gears_of_actuator_and_joint_are_their_own(inner: str, expected: float) -> None:
    gear = f'<transmission name="t"><type>x/SimpleTransmission</type>{inner}</transmission>'
    text = urdf(*TREE, gear)
    (armature,) = [j.armature for j in read(text).joints if j.name == "j1"]
    assert armature == pytest.approx(expected)
    assert "armature is gear ratio squared" in notes_of(text)
    twice = text.replace("</robot>", f'<transmission name="u">{inner}</transmission></robot>')
    (armature,) = [j.armature for j in read(twice).joints if j.name == "j1"]
    assert armature == pytest.approx(2 * expected)  # a second motor
    assert not any(j.armature for j in read(text.replace(ROTOR, "")).joints) or ROTOR not in text


def test_transmissions_of_several_joints_are_told() -> None:
    parts = "".join(f'<actuator name="m{k}">{ROTOR}</actuator><joint name="j{k}"/>' for k in (1, 2))
    text = urdf(*TREE, f'<transmission name="wrist">{parts}</transmission>')
    assert 'several joints are left out, rotors too; [motors] states such: "wrist"' in notes_of(
        text
    )
    lost = f'<transmission name="t"><joint name="j9"/>{MOTOR % ""}</transmission>'
    assert 'rotors on joints that are not there are left out: "t"' in notes_of(urdf(*TREE, lost))


DYNAMICS = '<dynamics damping="0.5" spring_stiffness="20" spring_reference="0.3"/>'
GAZEBO = (
    '<gazebo reference="j1"><springStiffness>20</springStiffness><springReference>0.3'
    "</springReference></gazebo>"
)
SPRING = joint("j1", "base", "a", DYNAMICS)


def test_springs_are_the_effect() -> None:
    spring = urdf(SPRING, *TREE[1:])
    other = urdf(joint("j1", "base", "a", '<dynamics damping="0.5"/>'), *TREE[1:], GAZEBO)
    assert toml(spring) == toml(other) == toml(spring.replace("</robot>", GAZEBO + "</robot>"))
    for line in ('spring = [{joint = "1", q0 = 0.3, h = 0}]', "Ks1 = 20"):
        assert line in toml(spring)


# What is refused.

TWO_WAYS = '<origin rpy="0 0 1" quat_xyzw="0 0 0 1"/>'
NO_WAY = '<origin quat_xyzw="0 0 0 0"/>'


@with_cases(
    "parts, message",
    (
        (TREE[0], joint("j2", "a", "b", TWO_WAYS), CHAIN),
        "line 1: .*<origin>.* rpy and quat_xyzw; keep the one",
    ),
    ((TREE[0], joint("j2", "a", "b", NO_WAY), CHAIN), 'a quaternion such as "0 0 0 1"'),
    (
        (TREE[0], joint("j2", "base", "b", MIMIC % "0.2"), TREE[2], PLUGIN),
        'plugin "m": joint "j2" follows in two',
    ),
    ((*TREE, PLUGIN.replace("j2", "jj2")), 'there is no joint "jj2"'),
    ((*TREE, PLUGIN.replace("-1.5", "fast")), 'got "fast"; expected a number'),
    (
        (*TREE, COUPLING.replace('link="a"', 'link="c"')),
        "expected two links whose joints stand on one link",
    ),
    ((*TREE, COUPLING.replace("ratio", "gear")), "ratio is missing"),
    ((*TREE, '<joint_constraint name="t"/>'), "<joint_constraint> ties joints in a way"),
    ((*FOUR, CLOSED["plus"] % "gear"), 'got "gear"; expected a joint that closes a loop'),
    ((*FOUR, CLOSED["gazebo"] % "screw"), 'joint "pin", type: got "screw"'),
    ((*FOUR, CLOSED["plus"].replace('"c"', '"d"') % "ball"), 'there is no link "d"'),
    ((*FOUR, CLOSED["links"].replace('"b"', '""') % "ball"), "link is missing"),
    ((*FOUR, CLOSED["plus"].replace(AXIS, "") % "revolute"), "<axis>: is missing"),
    (
        (*FOUR, CLOSED["gazebo"].replace("<pose>", '<pose relative_to="b">') % "ball"),
        "another frame",
    ),
    ((*FOUR, '<drake:linear_bushing_rpy name="f"/>'), "<drake:linear_bushing_rpy> is a force"),
    ((*FOUR, '<gazebo><link name="w"/></gazebo>'), "is a body of Gazebo alone"),
    ((SPRING, *TREE[1:], GAZEBO.replace("20", "30")), 'joint "j1" has two springs that differ'),
    ((*TREE, GAZEBO.replace("20", "stiff")), 'got "stiff"'),
)
def test_what_is_not_plain_is_refused(parts: tuple[str, ...], message: str) -> None:
    with pytest.raises(RobotError, match=message):
        read(urdf(*parts))
