"""No element that changes the mechanics is passed over: tables, schemas, mutated files."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats.body_tree import BodyTree, compute_body_poses
from modeler.formats.read import convert_robot_file
from modeler.formats.urdf import read_urdf_tree
from modeler.formats.xml_source import load_element_table
from modeler.robot.robot import JointKind
from tests.robot.public_robots import public_urdfs

MECHANICS = ("read", "reported", "refused")


def test_the_schema_of_urdf_is_known() -> None:
    """Of each path of `files/urdf_schema.txt` the attributes, behind "mechanics:" what weighs."""
    table = load_element_table("urdf")
    schema = Path(__file__).with_name("files").joinpath("urdf_schema.txt").read_text("utf-8")
    for line in schema.splitlines()[2:]:
        path, _, names = line.partition(" ")
        plain, matters, heavy = names.partition("mechanics:")
        assert table.classify_path(path), path
        if matters:
            assert table.classify_path(path) in MECHANICS, path
        for name in plain.split():
            assert table.classify_path(path, name), (path, name)
        for name in heavy.split():
            assert table.classify_path(path, name) in MECHANICS, (path, name)


SAME = {"(world)body": "body", "worldbody": "body", "frame": "body", "replicate": "body"}
HEAVY = {
    "joint": "type axis pos range ref stiffness damping armature frictionloss springdamper "
    "springref springyield",
    "inertial": "mass pos quat diaginertia fullinertia",
    "geom": "type size mass density fromto pos quat mesh shellinertia group",
    "body": "pos quat gravcomp mocap",
    "compiler": "angle settotalmass boundmass boundinertia balanceinertia inertiafromgeom "
    "inertiagrouprange fusestatic discardvisual eulerseq",
    "option": "gravity density viscosity wind",
    "flag": "gravity spring damper frictionloss equality constraint",
    "spatial": "stiffness damping frictionloss armature range",
    "fixed": "stiffness damping frictionloss armature range",
    "connect": "body1 body2 anchor active site1 site2",
    "weld": "body1 body2 active",
    "motor": "gear armature damping joint",
    "dcmotor": "gear armature damping cogging lugre",
    "mesh": "file inertia scale refpos refquat",
}
"""Attributes of MJCF that change masses, poses or torques."""


def mjcf_schema(text: str) -> dict[str, set[str]]:
    """Path -> attributes, of what MuJoCo prints of its schema."""
    schema: dict[str, set[str]] = {}
    way: list[str] = []
    for line in filter(str.strip, text.splitlines()):
        if head := re.match(r"( *)(\S+) \(.\) *(.*)", line):
            depth, tag = len(head[1]) // 3, SAME.get(head[2], head[2])
            way = [*way[:depth], tag]
            schema.setdefault("/".join(way), set())
        schema["/".join(way)] |= set((head[3] if head else line).split())
    return schema


def test_the_schema_of_mjcf_is_known() -> None:
    mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: mujoco-core is not installed")
    table, heavy = load_element_table("mjcf"), 0
    for path, names in mjcf_schema(mujoco.mj_printSchema(False, False)).items():
        ways = [path.rsplit("/", k)[0] for k in range(path.count("/") + 1)]
        if any(table.classify_path(way) in ("idle", "refused") for way in ways):
            continue
        assert table.classify_path(path) or mujoco.mj_version() > 4_000_000, path
        for name in names:
            verdict = table.classify_path(path, name)
            assert verdict or mujoco.mj_version() > 4_000_000, (path, name)
            if name in HEAVY.get(path.rsplit("/", 1)[-1], "").split():
                assert verdict in MECHANICS, (path, name)
                heavy += 1
    assert heavy > 80


# Mutated files.

LOOP = (
    '<loop name="x" type="%s"><link1 link="{child}"><origin xyz="0.1 0 0"/></link1>'
    '<link2 link="{root}"/>'
)
TIES = (
    LOOP % "revolute" + '<axis xyz="0 1 0"/></loop>',
    LOOP % "ball" + "</loop>",
    '<loop_joint name="x" type="spherical"><link1 link="{child}"/><link2 link="{root}"/>'
    "</loop_joint>",
    '<constraint name="x" type="fixed"><parent link="{root}"/><child link="{child}"/></constraint>',
    '<drake:ball_constraint xmlns:drake="d"><drake:ball_constraint_body_A name="{child}"/>'
    '<drake:ball_constraint_body_B name="{root}"/></drake:ball_constraint>',
    '<gazebo><joint name="x" type="revolute"><parent>{root}</parent><child>{child}</child>'
    "<axis><xyz>0 1 0</xyz></axis></joint></gazebo>",
    '<gazebo><joint name="x" type="gearbox"><parent>{root}</parent><child>{child}</child></joint>'
    "</gazebo>",
    '<coupling name="x"><predecessor link="{root}"/><successor link="{child}"/><ratio value="2"/>'
    "</coupling>",
    '<joint_constraint name="x"/>',
    '<drake:linear_bushing_rpy xmlns:drake="d" name="x"/>',
    '<gazebo><plugin filename="libmimic_joint_plugin.so"><joint>{first}</joint><mimicJoint>{joint}'
    "</mimicJoint><multiplier>0.3</multiplier></plugin></gazebo>",
    '<gazebo><plugin filename="libspring.so"/></gazebo>',
    '<ros2_control name="x"><joint name="{joint}"><param name="mimic">{first}</param></joint>'
    "</ros2_control>",
    '<gazebo reference="{joint}"><springStiffness>7.5</springStiffness></gazebo>',
    '<gazebo reference="{child}"><gravity>0</gravity></gazebo>',
    '<gazebo reference="{child}"><turnGravityOff>true</turnGravityOff></gazebo>',
    '<gazebo reference="{child}"><dampingFactor>0.1</dampingFactor></gazebo>',
    '<gazebo reference="{joint}"><cfmDamper>1</cfmDamper></gazebo>',
    '<transmission name="x"><joint name="{joint}"/><actuator name="m"><motorInertia>1e-3'
    "</motorInertia><mechanicalReduction>30</mechanicalReduction></actuator></transmission>",
    '<transmission name="x"><joint name="{joint}"/><joint name="{first}"/><actuator name="m"/>'
    '<actuator name="n"/></transmission>',
    '<gravity value="0 0 -1.62"/>',
    '<force name="x"/>',
    '<mujoco><option gravity="0 0 0"/></mujoco>',
)
"""What is put behind the last link."""
INSIDE = (
    '<drake:mimic xmlns:drake="d" joint="{first}" multiplier="0.5"/>',
    '<stiffness value="3"/>',
    '<limit lower="-0.31" upper="0.29" velocity="1" effort="1" acceleration="0.7"/>',
    '<limit lower="-0.31" upper="0.29" velocity="1" effort="1" jerk="9"/>',
    '<dynamics damping="0.123" friction="0.0456"/>',
    '<dynamics spring_stiffness="3"/>',
    '<dynamics gear="3"/>',
    '<safety_controller soft_lower_limit="-0.01" soft_upper_limit="0.011" k_velocity="1"/>',
    '<origin quat_xyzw="0.1 0.2 0.3 0.9"/>',
    '<axis xyz="0.6 0 0.8"/>',
    '<axis xyz="0 0 1" frame="x"/>',
)
"""What is put into a joint in place of such an element, or beside it."""
CHANGES: dict[str, Callable[[str], str]] = {
    r'<mass\s+value="([^"]*)"': lambda text: f"{1.37 * float(text) + 0.01:.6g}",
    r'ixx="([^"]*)"': lambda text: f"{1.5 * float(text) + 0.02:.6g}",
}


def has_range(joint: str) -> bool:
    """Whether limits leave a range; where they do not, soft limits are reported with them."""
    ends = dict(re.findall(r'\b(lower|upper)\s*=\s*"([^"]*)"', joint))
    return "continuous" in joint or float(ends.get("lower", 0)) < float(ends.get("upper", 0))


def mutants(text: str, rng: np.random.Generator) -> list[str]:
    """Mutants of a URDF: an element more, another one, twice the same, another number."""
    moves = r'<joint\b[^>]*\btype\s*=\s*"(?:revolute|continuous|prismatic)"[^>]*>.*?</joint>'
    joints = re.findall(moves, text, re.DOTALL)
    joints = [one for one in joints if "<mimic" not in one and "<!--" not in one]
    if not joints:
        return []
    one, first = joints[rng.integers(len(joints))], joints[0]
    name, leader = (re.search(r'<joint\b[^>]*\bname\s*=\s*"([^"]*)"', j) for j in (one, first))
    child = re.search(r'<child\s+link\s*=\s*"([^"]*)"', one)
    assert name and leader and child
    root = read_urdf_tree(text.encode(), "x.urdf").root
    names = dict(joint=name[1], first=leader[1], child=child[1], root=root)
    changed = [text.replace("</robot>", tie.format(**names) + "</robot>") for tie in TIES]
    for more in INSIDE:
        tag = re.match(r"<([\w:]+)", more)
        assert tag
        if tag[1] == "safety_controller" and not has_range(one):
            continue
        bare = re.sub(rf"<{tag[1]}\b[^>]*?(/>|>.*?</{tag[1]}>)", "", one, flags=re.DOTALL)
        more = more.format(**names)
        for joint in (
            bare.replace("</joint>", f"{more}</joint>"),
            one.replace("</joint>", f"{more * 2}</joint>"),
        ):
            changed.append(text.replace(one, joint, 1))
    named = rf'<link\s+name\s*=\s*"{re.escape(child[1])}"[^>]*>.*?</link>'
    link = re.search(named, text, re.DOTALL)
    for pattern, change in CHANGES.items():
        if link and (spot := re.compile(pattern).search(text, link.start(), link.end())):
            changed.append(text[: spot.start(1)] + change(spot[1]) + text[spot.end(1) :])
    return changed


def file_and_notes(path: Path) -> tuple[str, tuple[str, ...]] | None:
    """The robot file and notes of a file; None if it is refused, in one line."""
    try:
        made = convert_robot_file(path)
    except RobotError as error:
        assert len(str(error).splitlines()) == 1
        return None
    return made.text, made.notes


def check_mutants(texts: list[str], path: Path, before: tuple[str, tuple[str, ...]]) -> None:
    for text in texts:
        path.write_text(text, encoding="utf-8")
        after = file_and_notes(path)
        assert after != before, (path.name, text)


def drawn_urdfs(count: int, joints: int = 25) -> list[Path]:
    """Of those of up to so many joints, fixed ones included."""
    paths = [p for p in public_urdfs() if 0 < p.read_bytes().count(b"<joint ") <= joints]
    if not paths:
        pytest.skip("NOT CHECKED: public URDFs, for example-robot-data is not installed")
    rng = np.random.default_rng()
    return [paths[k] for k in rng.permutation(len(paths))[:count]]


@pytest.mark.parametrize(("files", "each"), [(5, 4), pytest.param(60, 60, marks=pytest.mark.slow)])
def test_no_mutant_of_a_public_urdf_is_read_as_the_file_itself(files, each, tmp_path):
    """Read, refused or reported: the robot file or its notes are others."""
    rng = np.random.default_rng()
    for original in drawn_urdfs(files, 25 if files == 5 else 60):
        path = tmp_path / original.name
        text = original.read_bytes().decode()
        path.write_text(text, encoding="utf-8")
        if (before := file_and_notes(path)) is None:
            continue
        made = mutants(text, rng)
        chosen = rng.permutation(len(made))[:each]
        check_mutants([made[k] for k in chosen], path, before)


def centre(tree: BodyTree, q: dict[str, float]) -> np.ndarray:
    """(4,) first moments and mass of what moves."""
    poses, total = compute_body_poses(tree, q), np.zeros(4)
    for name, inertial in tree.bodies.items():
        if inertial is not None:
            total += inertial.mass * np.array([*poses[name].transform_point(inertial.centre), 1.0])
    return total


def test_what_pinocchio_reads_of_a_mutant_is_what_is_read(tmp_path: Path) -> None:
    """Mass and centre of masses, quaternions of URDF 1.1 among what has changed."""
    pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: Pinocchio is not installed")
    rng, checked = np.random.default_rng(), 0
    for original in drawn_urdfs(60):
        text = original.read_bytes().decode()
        if checked > 15:
            return
        if "mimic" in text or file_and_notes(original) is None or "floating" in text:
            continue
        path = tmp_path / original.name
        for mutant in [m for m in mutants(text, rng) if "</gazebo>" not in m[-300:]]:
            if rng.uniform() > 0.3 or "drake:" in mutant or "limit" in mutant[-200:]:
                continue
            path.write_text(re.sub(r"<robot\b", '<robot version="1.1"', mutant, count=1))
            try:
                tree = read_urdf_tree(path.read_bytes(), path.name, exact_decimals=True)
                model = pin.buildModelFromUrdf(str(path))
            except (RobotError, ValueError, RuntimeError):
                continue
            data, q = model.createData(), pin.neutral(model)
            moving = [j for j in tree.joints if j.kind is not JointKind.FIXED]
            if (
                len(moving) != model.njoints - 1
                or tree.loop_closures
                or any(j.leader for j in moving)
            ):
                continue
            at = {}
            for joint in moving:
                theirs = model.joints[model.getJointId(joint.name)]
                at[joint.name] = x = float(rng.uniform(-1, 1))
                actual = [np.cos(x), np.sin(x)] if theirs.nq == 2 else [x]
                q[theirs.idx_q : theirs.idx_q + theirs.nq] = actual
            pin.forwardKinematics(model, data, q)
            theirs = np.zeros(4)
            for inertia, pose in zip(model.inertias, data.oMi, strict=True):
                theirs += inertia.mass * np.array([*pose.act(inertia.lever), 1.0])
            ours = centre(tree, at)
            assert np.allclose(ours, theirs, rtol=1e-7, atol=1e-7), (original.name, mutant[-300:])
            checked += 1
    raise AssertionError(f"only {checked} mutants")
