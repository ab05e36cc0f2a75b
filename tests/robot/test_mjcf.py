"""MJCF as body trees: what is read of each element, reported, or refused in one line."""

import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats.body_tree import BodyTree, Pose, TreeJoint
from modeler.formats.mjcf import read_mjcf_tree
from modeler.formats.tree_cuts import cut_tree
from modeler.formats.tree_text import convert_tree
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import JointKind
from tests.elementary_motions import turn
from tests.robot.spoilt_files import check_spoilt, most_memory
from tests.robot.texts import ARM_XML as ARM, edited
from tests.rotation import with_cases

mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: mujoco-core is not installed")


def read(folder: Path, text: str = ARM, exact_decimals: bool = False) -> BodyTree:
    path = folder / "arm.xml"
    path.write_text(text, encoding="utf-8")
    return read_mjcf_tree(path, exact_decimals)


def with_section(section: str, *pairs: tuple[str, str]) -> str:
    return edited(ARM, ("</mujoco>", f"{section}</mujoco>"), *pairs)


def joints(tree: BodyTree) -> dict[str, TreeJoint]:
    return {joint.name: joint for joint in tree.joints}


def notes_of(tree: BodyTree) -> str:
    return "\n".join(tree.notes)


# What is read.


def test_what_stands_in_the_file_is_in_the_tree(tmp_path: Path) -> None:
    tree = read(tmp_path)
    assert (tree.name, tree.format, tree.root) == ("arm", "MJCF", "world")
    assert tree.gravity.tolist() == [0, 0, -9.8]
    assert [joint.name for joint in tree.joints] == ["pan", "lift", "roll", "bend", "tip"]
    pan, lift, roll, bend, tip = tree.joints
    assert (pan.parent, pan.child, pan.kind) == ("world", "upper", JointKind.REVOLUTE)
    assert (pan.lower, pan.upper, pan.stiffness, pan.rest) == (-1.5, 2.0, 3.0, 0.2)
    # On the motor's side, through the gear: 0.02 + 50^2 2e-4, 0.7 + 50^2 1e-4.
    assert pan.armature == pytest.approx(0.52) and pan.damping == pytest.approx(0.95)
    assert pan.friction is None and pan.actuated and lift.actuated and not bend.actuated
    assert lift.kind is JointKind.PRISMATIC
    assert (lift.zero, lift.damping, lift.friction) == (0.1, 0.1, 0.3)
    assert lift.lower is None and lift.upper is None
    assert lift.axis.tolist() == [0, 0, 1] and roll.point.tolist() == [0, 0.05, 0]
    assert tip.kind is JointKind.FIXED and tip.parent == "fore"
    assert "motor" in notes_of(tree)


def test_roundings_of_angles_are_made_good_and_told(tmp_path: Path) -> None:
    tree = read(tmp_path)
    _, lift, roll, _, _ = tree.joints
    assert np.allclose(tree.joints[0].pose.rotation @ [0, 0, 1], [0, -1, 0], rtol=0, atol=4e-16)
    assert np.allclose(lift.pose.rotation @ [0, 0, 1], [1, 0, 0], rtol=0, atol=4e-16)
    assert lift.pose.position.tolist() == [0.3, 0, 0]
    assert np.allclose(roll.axis, [math.sqrt(0.75), 0.5, 0], rtol=0, atol=2e-16)
    for printed in ("1.5708 is pi/2", "0.866025 0.5 0 is of", "1 lengths,", "--exact-decimals"):
        assert printed in notes_of(tree)
    tree = read(tmp_path, exact_decimals=True)
    _, lift, roll, _, _ = tree.joints
    assert lift.pose.rotation[2, 2] == pytest.approx(math.cos(1.5708), rel=1e-9)
    assert lift.pose.position[2] == 1e-9 and "rounded" not in notes_of(tree)


C, S = 0.5, math.sqrt(0.75)
QUARTER_ABOUT_C0S = [[C * C, -S, C * S], [S, 0, -C], [C * S, C, S * S]]


def turned(*turns: tuple[int, float]) -> np.ndarray:
    """Of turns in degrees about x, y or z, one after the other."""
    return np.linalg.multi_dot([np.eye(4), *(turn(k, math.radians(x)) for k, x in turns)])[:3, :3]


@with_cases(
    "printed, expected",
    ('quat="0.653281 0.270598 0.653281 0.270598"', turned((1, 90), (2, 45))),
    ('quat="0.183013 0.683013 -0.683013 0.183013"', turned((0, 150), (2, 90))),
    ('quat="0.707105 0 0 0.707108"', turned((2, 90))),  # of 1.5708
    ('quat="0.976 0 0.216 0"', None),  # no multiple of 15 degrees: as printed
    ('axisangle="0.5 0 0.866025 1.5708"', QUARTER_ABOUT_C0S),
    ('euler="1e-8 0 -3.1416"', np.diag([-1, -1, 1])),
)
def test_printed_orientations(printed: str, expected: np.ndarray | None, tmp_path: Path) -> None:
    """What is made good is what the digits round, and is exact."""
    text = edited(ARM, ('quat="0.707107 0.707107 0 0"', printed))
    made, as_printed = (read(tmp_path, text, x).joints[0].pose.rotation for x in (False, True))
    change = np.abs(made - as_printed).max()
    least, most = (1e-8, 2e-4) if printed.startswith("quat") else (1e-7, 1e-5)
    assert change == 0 if expected is None else least < change < most
    assert expected is None or np.allclose(made, expected, rtol=0, atol=4e-16)


def test_degrees_frames_includes_and_names(tmp_path: Path) -> None:
    (tmp_path / "part.xml").write_text(
        '<mujocoinclude><body pos="1 0 0"><joint range="-90 30"/><geom size="0.1"/></body>'
        "</mujocoinclude>"
    )
    tree = read(
        tmp_path,
        '<mujoco><worldbody><frame euler="0 0 90"><body name="body2"><joint/><geom size="0.1"/>'
        '<include file="part.xml"/></body></frame></worldbody></mujoco>',
    )
    assert tree.name == "arm" and list(tree.bodies) == ["world", "body2", "body2_"]
    assert [joint.name for joint in tree.joints] == ["joint0", "joint1"]
    assert np.allclose(tree.joints[0].pose.rotation @ [1, 0, 0], [0, 1, 0], rtol=0, atol=4e-16)
    assert tree.joints[1].lower == pytest.approx(-math.pi / 2)
    assert not any(joint.actuated for joint in tree.joints)  # for the file has no actuator
    text = convert_tree(tree, "arm.xml")
    assert "the file states no motor: all joints are taken as actuated" in text.notes


def test_meshes_that_are_not_there_matter_where_they_weigh(tmp_path: Path) -> None:
    text = re.sub(r"<inertial.*/>", "", ARM)
    tree = read(tmp_path, text)
    assert tree.bodies["upper"] is None and tree.bodies["fore"] is not None
    assert 'no values of "upper (cover.stl)"' in notes_of(tree)
    weightless = edited(text, ('mesh="cover"', 'mesh="cover" mass="0"'))
    assert "cover" not in notes_of(read(tmp_path, weightless))
    robot = parse_robot_text(convert_tree(tree, "arm.xml").text, "arm.toml")
    assert "M1" not in robot.parameters and "M4" in robot.parameters


@with_cases(
    "tie, follower, leader, ratio, offset",
    # q1 - q1_0 = a0 + a1 (q2 - q2_0): of a joint without motor and one with
    ('<joint joint1="roll" joint2="lift" polycoef="0.2 3"/>', "roll", "lift", 3, -0.1),
    # turned round, for pan has a motor and roll has none
    ('<joint joint1="pan" joint2="roll" polycoef="0.2 -2"/>', "roll", "pan", -0.5, 0.1),
    ('<tendon tendon1="pair" polycoef="0.4"/>', "roll", "bend", -0.5, 0.2),
)
def test_linear_equalities_are_relations(tie, follower, leader, ratio, offset, tmp_path):
    pair = '<tendon><fixed name="pair"><joint joint="roll" coef="2"/><joint joint="bend" coef="1"/>'
    text = with_section(f"{pair}</fixed></tendon><equality>{tie}</equality>")
    joint = joints(read(tmp_path, text))[follower]
    assert (joint.leader, joint.actuated) == (leader, False)
    assert (joint.ratio, joint.offset) == pytest.approx((ratio, offset))
    # MuJoCo's own residual is 0 where the relation holds, and only there.
    bare = re.sub(r"<asset>.*</asset>|<geom type=.mesh.[^>]*>", "", text, flags=re.S)
    model = mujoco.MjModel.from_xml_string(bare)
    data = mujoco.MjData(model)
    for slip in (0.0, 0.1):
        data.joint(leader).qpos = 0.3
        data.joint(follower).qpos = joint.ratio * 0.3 + joint.offset + slip
        mujoco.mj_forward(model, data)
        (residual,) = data.efc_pos[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
        assert (abs(residual) < 1e-12) == (slip == 0.0)


def test_chains_of_equalities_and_joints_that_stand_still(tmp_path: Path) -> None:
    text = with_section(
        '<equality><joint joint1="bend" joint2="roll" polycoef="0 2"/>'
        '<joint joint1="roll" joint2="pan" polycoef="0.1 -1"/><joint joint1="lift" '
        'polycoef="0.3"/><joint joint1="pan" joint2="bend" polycoef="9 9 9" active="false"/>'
        "</equality>"
    )
    tree = read(tmp_path, text)
    bend, lift = joints(tree)["bend"], joints(tree)["lift"]
    assert (bend.leader, bend.ratio) == ("pan", -2) and bend.offset == pytest.approx(0.2)
    assert lift.kind is JointKind.FIXED and "lift stands still" in notes_of(tree)
    assert np.allclose(lift.pose.position, [0.6, 0, 0])  # along its axis, by what it is held at
    assert "1 inactive equalities" in notes_of(tree)


LOOP = edited(
    ARM,
    ('<body name="tip"', '<site name="a" pos="0 0 0.1"/><body name="tip"'),
    (
        "</worldbody>",
        '<body name="rod" pos="0.5 0 0.4"><joint name="free" axis="0 1 0"/>'
        '<site name="b" pos="0 0 1e-8"/><geom size="0.1"/></body></worldbody>',
    ),
)


def test_connect_is_a_meeting(tmp_path: Path) -> None:
    section = '<equality><connect name="pin" body1="tip" body2="rod" anchor="0 0 0.1"/></equality>'
    tree = read(tmp_path, edited(LOOP, ("</mujoco>", section + "</mujoco>")))
    (crossover,) = tree.loop_closures
    assert (crossover.name, crossover.body, crossover.other) == ("pin", "tip", "rod")
    poses = {"world": Pose()}  # where the file draws the robot, both points are one
    for joint in tree.joints:
        poses[joint.child] = poses[joint.parent] @ joint.pose
    one, other = crossover.pose.position, crossover.other_pose.position
    ends = poses["tip"].transform_point(one), poses["rod"].transform_point(other)
    assert np.allclose(*ends, rtol=0, atol=1e-15)
    assert tree.home == {"pan": 0, "lift": 0.1, "roll": 0, "bend": 0, "free": 0}


def test_connect_of_sites_and_the_posture_of_a_keyframe(tmp_path: Path) -> None:
    section = '<keyframe><key name="home" qpos="0.2 0.15 0 -0.3 0.4"/></keyframe><equality>'
    section += '<connect site1="a" site2="b"/></equality>'
    tree = read(tmp_path, edited(LOOP, ("</mujoco>", section + "</mujoco>")))
    (crossover,) = tree.loop_closures
    assert (crossover.body, crossover.other) == ("fore", "rod")
    assert crossover.pose.position.tolist() == [0, 0, 0.1]
    assert crossover.other_pose.position.tolist() == [0, 0, 0]
    assert tree.home == {"pan": 0.2, "lift": 0.15, "roll": 0, "bend": -0.3, "free": 0.4}
    text = convert_tree(tree, "arm.xml")
    home = parse_robot_text(text.text, "arm.toml").home
    assert [home[f"{k}"] for k in range(1, 6)] == list(tree.home.values())
    assert any("springs are left out" in note for note in text.notes)
    assert "spring =" not in text.text


FLOATING = """<mujoco><worldbody>
  <body name="table"><geom type="box" size="1 1 1"/></body>
  <body name="hand" mocap="true"/>
  <body name="cube" pos="1 0 0"><freejoint/><geom size="0.1"/></body>
  <body name="base" pos="0 0 1"><freejoint name="root"/><geom size="0.1"/>
    <body name="leg"><joint name="hip"/><geom size="0.1"/>
      <body name="foot" pos="0 0 1" gravcomp="1"><joint name="ankle" type="ball"/>
        <geom size="0.1"/></body></body></body>
  </worldbody><equality><weld body1="hand" body2="leg"/>
  <connect body1="cube" body2="leg" anchor="0 0 0"/>
  <weld body1="base"/></equality></mujoco>"""


def test_what_floats_stands_still_or_is_left_out(tmp_path: Path) -> None:
    tree = read(tmp_path, FLOATING)
    assert set(tree.bodies) == {"world", "table", "base", "leg", "foot"}
    assert joints(tree)["root"].kind is JointKind.FIXED
    assert joints(tree)["root"].pose.position.tolist() == [0, 0, 1]
    assert not tree.loop_closures
    for words in (
        "base floats; here it stands still",
        "cube floats; it is left out",
        "hand is dragged",
        "left out with what ties it",
        "move as one",
        'gravcomp of "foot"',
    ):
        assert words in notes_of(tree)


def test_ball_joints_wait_until_they_are_cut_off(tmp_path: Path) -> None:
    tree = read(tmp_path, FLOATING)
    assert list(tree.unsupported_joints) == ["ankle"]
    with pytest.raises(RobotError, match=r"joint ankle: ball joints are not read; cut it off"):
        cut_tree(tree)
    assert "foot" not in cut_tree(tree, tip="leg").bodies
    assert "foot" in cut_tree(tree, locks={"ankle": 0}).bodies


def test_what_is_left_out_is_told(tmp_path: Path) -> None:
    text = edited(
        ARM,
        ('gravity="0 0 -9.8"', 'viscosity="0.1"'),
        ('stiffness="3"', 'stiffness="3 1"'),
        (
            "</actuator>",
            '</actuator><tendon><fixed damping="1"><joint joint="pan" coef="1"/></fixed></tendon>',
        ),
    )
    notes = notes_of(read(tmp_path, text))
    for words in ("forces of the fluid", "of polynomial springs", "of tendons are left out"):
        assert words in notes
    assert "gear scales commands alone" in notes_of(
        read(tmp_path, edited(ARM, (' armature="2e-4"', ""), (' damping="1e-4"', "")))
    )


# What is refused.

TIE = "<equality>{}</equality>"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (with_section(TIE.format('<joint joint1="roll" joint2="pan" polycoef="0 1 2"/>')),
         "joint equality 1 lets roll follow pan by a polynomial; expected a straight line"),
        (with_section(TIE.format('<joint joint1="roll" joint2="bend"/>'
                                 '<joint joint1="bend" joint2="roll"/>')),
         "equalities let joint roll follow itself; take one out"),
        (with_section(TIE.format('<joint joint1="roll" joint2="pan"/>'
                                 '<joint joint1="roll" joint2="pan" polycoef="1 1"/>')),
         "joint equality 2: roll follows another joint already"),
        (with_section(TIE.format('<weld name="glue" body1="tip" body2="upper"/>')),
         "glue holds tip and upper rigidly; expected connect"),
        (with_section('<tendon><fixed name="t"><joint joint="pan" coef="1"/></fixed></tendon>'
                      + TIE.format('<tendon name="rope" tendon1="t"/>')),
         "rope holds a tendon; expected a fixed one over two joints"),
        (edited(ARM, ("<worldbody>", '<worldbody><include file="gone.xml"/>')),
         r"line 10: includes .*gone\.xml, which cannot be read \(No such file"),
        (edited(ARM, (' axis="0 1 0" range', ' axs="0 1 0" range')),
         r"MuJoCo does not take it: .*unrecognized attribute: 'axs' .*line 14; correct it there"),
        (edited(ARM, ("</worldbody>", "</worldbdy>")), "line 24: not well-formed XML"),
        ("<mujocoinclude/>", "got <mujocoinclude>; expected <mujoco>"),
        ("<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>",
         "no hinge or slide moves anything"),
        (edited(ARM, ("<geom size", '<replicate count="40"><replicate count="41"><geom size'),
                ("</body>\n      </body>", "</replicate></replicate></body></body>")),
         r'<replicate>: count: got "41"; expected at most 1000 in all'),
        (edited(ARM, ("<asset>", '<asset><hfield name="h" nrow="90000" ncol="90000"/>')),
         '<hfield>: nrow ncol: got "90000 90000"'),
        (edited(ARM, ("<geom size", '<composite type="cable" count="9 1 1"/><geom size')),
         "a soft body"),
        (edited(ARM, ('gear="50"', 'gear="1e200"')), r"actuator_gear: got more than 1e\+12"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_line(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(RobotError, match=message) as error:
        read(tmp_path, text)
    assert "\n" not in str(error.value) and str(tmp_path) in str(error.value)


def test_a_bomb_in_an_included_file_is_refused(tmp_path: Path) -> None:
    bomb = "<!DOCTYPE b [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><mujoco>&b;</mujoco>"
    (tmp_path / "bomb.xml").write_text(bomb)
    with pytest.raises(RobotError, match=r"bomb\.xml: line 1: <!DOCTYPE>"):
        read(tmp_path, edited(ARM, ("<asset>", '<include file="bomb.xml"/><asset>')))


def test_sizes_without_bound_cost_nothing(tmp_path: Path) -> None:
    sizes = '<size memory="1000G" nuserdata="2000000000" nuser_body="900000000"/>'
    picture = '<texture name="t" type="2d" builtin="flat" width="90000" height="90000"/>'
    before = most_memory()
    read(tmp_path, edited(ARM, ("<asset>", f"{sizes}<asset>{picture}")))
    assert most_memory() - before < 300e6


def test_without_mujoco_it_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(RobotError, match=r'run: pip install "modeler-robotics\[mjcf\]"'):
        read(tmp_path)


def test_nothing_is_printed_and_no_log_is_written(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    old = edited(
        ARM, ('autolimits="true"', 'autolimits="true" settotalmass="5"')
    )  # MuJoCo warns of it
    tree = read(tmp_path, old)
    assert sum(body.mass for body in tree.bodies.values() if body) == pytest.approx(5)
    with pytest.raises(RobotError):
        read(tmp_path, old.replace('mass="2"', 'mass="-2"'))
    assert capfd.readouterr() == ("", "") and not list(tmp_path.glob("MUJOCO*"))


@pytest.mark.parametrize("text", [LOOP, FLOATING], ids=["loop", "floating"])
def test_spoilt_files_are_read_or_told_in_one_line(text: str, tmp_path: Path) -> None:
    check_spoilt(text.encode(), tmp_path / "arm.xml")


# What MuJoCo does to a whole model, and what it switches off.

MOMENTS = "0.01 0.012 0.009"

SCENE = """<mujoco model="scene"><compiler angle="radian" %s/><worldbody>
<body name="ball" pos="1 0 1"><freejoint/><geom type="sphere" size="0.1" mass="%g"/>
  <body name="knob" pos="0 0 0.1"><geom size="0.02" mass="0.7"/></body></body>
<body name="dragged" mocap="true"><geom size="0.05" mass="0.4"/></body>
<body name="a" pos="0 0 0.5"><joint name="j1" axis="0 1 0"/>
  <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="%g"/>
  <geom type="box" size="0.1 0.1 0.1" pos="0.1 0 0" mass="0.6" group="3"/>
  <body name="b" pos="0.3 0 0"><joint name="j2" axis="0 1 0"/>
    <inertial pos="0.1 0.02 0" mass="%g" diaginertia="%s"/>
    <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03" mass="2"/>
    <body name="tool" pos="0.2 0 0"><geom size="0.03" mass="0.2"/></body>
</body></body></worldbody><actuator><motor joint="j1"/><motor joint="j2"/></actuator></mujoco>"""


@with_cases(
    "option",
    'settotalmass="10"',
    'settotalmass="0.3" inertiafromgeom="true"',
    'settotalmass="25" inertiagrouprange="0 2"',
    'settotalmass="4" fusestatic="true"',
    'settotalmass="4" discardvisual="true" boundmass="1.5"',
    'boundmass="0.5" boundinertia="0.004"',
    'balanceinertia="true"',
    'inertiafromgeom="auto" inertiagrouprange="3 3" settotalmass="0"',
)
def test_masses_are_those_that_mujoco_compiles(option: str, tmp_path: Path) -> None:
    """With bodies in the scene that are no part of the robot, and drawn masses."""
    masses = np.random.default_rng().uniform(0.5, 4, 3).round(3)
    moments = MOMENTS.replace("0.009", "0.05") if "balance" in option else MOMENTS
    text = SCENE % (option, *masses, moments)
    if "3 3" in option:  # the others weigh nothing by geoms of that group
        text = text.replace("<geom size", '<geom group="3" size')
        text = text.replace('"sphere"', '"sphere" group="3"')
    tree = read(tmp_path, text)
    # Fused bodies have no name of their own there.
    model = mujoco.MjModel.from_xml_string(text.replace('fusestatic="true"', ""))
    assert set(tree.bodies) == {"world", "a", "b", "tool"}
    for name in ("a", "b", "tool"):
        body, theirs = tree.bodies[name], model.body(name)
        assert body is not None
        assert body.mass == pytest.approx(theirs.mass[0], rel=1e-12)
        assert np.allclose(body.centre, theirs.ipos, rtol=0, atol=1e-12)
        moments = np.sort(np.linalg.eigvalsh(body.inertia))
        assert np.allclose(moments, np.sort(theirs.inertia), rtol=1e-9)


def test_a_total_mass_of_meshes_that_are_not_there_is_refused(tmp_path: Path) -> None:
    text = SCENE % ('settotalmass="10"', 3, 1, 1, MOMENTS)
    text = text.replace("<worldbody>", '<asset><mesh name="m" file="m.stl"/></asset><worldbody>')
    text = text.replace('<geom size="0.03" mass="0.2"/>', '<geom type="mesh" mesh="m"/>')
    with pytest.raises(
        RobotError, match=r'settotalmass shares 10 kg .* "tool \(m.stl\)"; put them'
    ):
        read(tmp_path, text)
    assert "no values of" in notes_of(read(tmp_path, text.replace('settotalmass="10"', "")))


@with_cases(
    "flag, gone",
    ("spring", ("stiffness",)),
    ("damper", ("damping",)),
    ("frictionloss", ("friction",)),
    ("constraint", ("friction", "leader")),
    ("equality", ("leader",)),
    ("contact", ()),
)
def test_what_a_flag_switches_off_is_not_there(flag: str, gone: tuple, tmp_path: Path) -> None:
    ties = '<equality><joint joint1="roll" joint2="pan" polycoef="0 2 0 0 0"/></equality>'
    off = f'<option><flag {flag}="disable"/></option>'
    more = ('name="pan"', 'name="pan" frictionloss="0.4"')
    plain, made = (joints(read(tmp_path, with_section(ties + flags, more))) for flags in ("", off))
    for key in ("stiffness", "damping", "friction"):
        assert plain["pan"].__getattribute__(key)
        assert (getattr(made["pan"], key) is None) == (key in gone)
    assert plain["roll"].leader == "pan" and bool(made["roll"].leader) == ("leader" not in gone)


ONE = '<joint joint="roll" coef="1"/></fixed></tendon>'
MUTANTS = (
    ("<option ", '<option density="1.2" '), ("<option ", '<option wind="1 0 0" '),
    ('gravity="0 0 -9.8"', 'gravity="1 0 -9.8"'),
    ("</mujoco>", '<option><flag gravity="disable"/></option></mujoco>'),
    ("<compiler ", '<compiler settotalmass="3" '), ("<compiler ", '<compiler boundmass="2.5" '),
    ('name="fore"', 'name="fore" gravcomp="1"'),
    ('name="pan"', 'name="pan" springyield="0.1"'), ('stiffness="3"', 'stiffness="3 0.5"'),
    ('stiffness="3"', 'stiffness="4"'), ('springref="0.2"', 'springref="0.3"'),
    ('name="pan"', 'name="pan" springdamper="0.1 1"'), ('damping="0.7"', 'damping="0.8"'),
    ('armature="2e-4"', 'armature="3e-4"'), ('gear="50"', 'gear="60"'),
    ('pos="0 0.05 0"', 'pos="0 0.06 0"'), ("<position joint", '<position armature="1" joint'),
    ("</mujoco>", '<equality><joint joint1="roll" polycoef="0.1 0 0 0 0"/></equality></mujoco>'),
    ("</mujoco>", f'<tendon><fixed stiffness="2">{ONE}</mujoco>'),
    ("</mujoco>", f'<tendon><fixed range="0 1">{ONE}</mujoco>'),
    ("</mujoco>", f'<tendon><fixed name="t">{ONE}<actuator>'
     '<motor tendon="t" armature="0.1"/></actuator></mujoco>'),
    ("</mujoco>", '<actuator><dcmotor joint="roll" motorconst="1" resistance="1" cogging="1 2 0"/>'
     "</actuator></mujoco>"),
)  # fmt: skip


def file_and_notes(folder: Path, text: str) -> tuple[str, tuple[str, ...]] | None:
    """The robot file and what is reported about it; None where it is refused."""
    try:
        made = convert_tree(cut_tree(read(folder, text)), "arm.xml")
    except RobotError as error:
        assert "schema" not in str(error).lower(), error
        return None
    return made.text, made.notes


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("mutants")


@pytest.fixture(scope="module")
def arm_and_notes(folder: Path) -> tuple[str, tuple[str, ...]] | None:
    return file_and_notes(folder, ARM)


@pytest.mark.parametrize("mutant", MUTANTS)
def test_no_mutant_is_read_as_the_file_itself(mutant: tuple, folder: Path, arm_and_notes) -> None:
    assert arm_and_notes not in (None, file_and_notes(folder, edited(ARM, mutant)))
