"""Self-standing files in other programs: their inverse dynamics are those of our model."""

import dataclasses
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from modeler.api import export, load
from modeler.core.errors import DataError
from modeler.robot import Robot, parse_robot_text
from tests.codegen.fitted_library import robot_text
from tests.export.arms import MJCF, URDF, reread, same_physics, torques
from tests.rotation import rotating

pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: no Pinocchio")
mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: no MuJoCo")

STATES = 50

TREE = robot_text("tree")
"""Branches, a fixed row, a slide, variables with a minus, a joint that follows, tilted gravity."""


def a_body(rng: np.random.Generator) -> np.ndarray:
    """Ten parameters of points of mass."""
    points, mass = rng.normal(scale=0.1, size=(12, 3)), rng.uniform(0.05, 0.5, 12)
    tensor = sum(
        m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(mass, points, strict=True)
    )
    return np.array([*tensor[np.triu_indices(3)], *(mass @ points), mass.sum()])


@pytest.fixture(scope="module")
def tree() -> Robot:
    rng = np.random.default_rng()
    prefixes = ["XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"]
    lines = [
        f"{p}{row} = {x!r}"
        for row in "12345"
        for p, x in zip(prefixes, a_body(rng).tolist(), strict=True)
    ]
    lines += [f"{p}{row} = {rng.uniform(0.1, 2.0)!r}" for row in "1234" for p in ("Fv", "Ia")]
    return parse_robot_text(TREE + "\n".join([*lines, "Ks3 = 7.5"]), "tree.toml")


def whole_tree(robot: Robot) -> Robot:
    """The same with every joint free."""
    return dataclasses.replace(robot, relations={})


def states(robot: Robot):
    rng = np.random.default_rng()
    return (rng.uniform(-1.2, 1.2, (STATES, len(robot.moving_joints))) for _ in range(3))


def pinocchio_torques(text: bytes, joints: list[str], q, qd, qdd, g=9.81) -> np.ndarray:
    model = pin.buildModelFromXML(text.decode())
    model.gravity.linear = np.array([0.0, 0.0, -g])  # a URDF states none
    data, values = model.createData(), []
    order = [model.getJointId(name) for name in joints]
    for row in zip(q, qd, qdd, strict=True):
        full, v, a = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
        for k, i in enumerate(order):
            joint = model.joints[i]
            v[joint.idx_v], a[joint.idx_v] = row[1][k], row[2][k]
            at = joint.idx_q
            full[at : at + joint.nq] = (
                [row[0][k]] if joint.nq == 1 else [np.cos(row[0][k]), np.sin(row[0][k])]
            )
        tau = pin.rnea(model, data, full, v, a)
        values.append([tau[model.joints[i].idx_v] for i in order])
    return np.array(values)


def mujoco_torques(text: bytes, joints: list[str], q, qd, qdd) -> np.ndarray:
    """Without constraints and dry friction; with armature, damping, springs."""
    model = mujoco.MjModel.from_xml_string(text.decode())
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    data = mujoco.MjData(model)
    at = [model.joint(name) for name in joints]
    values = []
    for row in zip(q, qd, qdd, strict=True):
        for k, joint in enumerate(at):
            data.qpos[joint.qposadr] = row[0][k]
            data.qvel[joint.dofadr], data.qacc[joint.dofadr] = row[1][k], row[2][k]
        mujoco.mj_inverse(model, data)
        values.append([data.qfrc_inverse[joint.dofadr][0] for joint in at])
    return np.array(values)


def close(one: np.ndarray, other: np.ndarray, share: float = 1e-9) -> bool:
    return bool(np.abs(one - other).max() <= share * np.abs(other).max())


def test_urdf_of_a_table_is_the_model_in_pinocchio_and_mjcf_in_mujoco(tree) -> None:
    """The latter with damping, armature and spring; its bodies could be built."""
    robot, motion = whole_tree(tree), [*states(tree)]
    names = [f"joint_{joint.name}" for joint in robot.moving_joints]
    urdf, mjcf = export(tree, to="urdf"), export(tree, to="mjcf")
    assert "URDF cannot hold size of gravity (g = 9.233)" in urdf.summary()
    assert "gravity" not in mjcf.summary()
    theirs = pinocchio_torques(urdf.data, names, *motion, np.linalg.norm([0.5, 9.0, 2.0]))
    assert close(theirs, torques(robot, *motion, ("Fv", "Ia", "Ks")))
    assert close(mujoco_torques(mjcf.data, names, *motion), torques(robot, *motion))
    model = mujoco.MjModel.from_xml_string(mjcf.data.decode())
    for moments in np.sort(model.body_inertia[model.body_mass > 0.0]):
        assert moments[0] > 0.0 and moments[0] + moments[1] >= moments[2]


def test_joints_that_follow_are_held_there_by_mujoco(tree) -> None:
    text = export(tree, to="mjcf").data
    model = mujoco.MjModel.from_xml_string(text.decode())
    data = mujoco.MjData(model)
    data.qpos[model.joint("joint_4").qposadr] = 0.3
    data.qpos[model.joint("joint_5").qposadr] = -0.5
    mujoco.mj_forward(model, data)
    assert data.nefc == 1 and abs(data.efc_pos[0]) < 1e-12
    mimic = pin.buildModelFromXML(export(tree, to="urdf").data.decode(), mimic=True)
    assert mimic.nq < pin.buildModelFromXML(export(tree, to="urdf").data.decode()).nq


@pytest.mark.parametrize("name", ["demo-arm", *rotating("puma560", "wrist-coupled")])
def test_built_in_robots_weigh_in_both_what_they_state(name) -> None:
    robot = load(name)
    bodies = dataclasses.replace(rigid(robot), motors={}, relations={})
    if robot.motors:
        items = [j for j in robot.joints if j.name not in robot.motors]
        joints = tuple(dataclasses.replace(joint, actuated=True) for joint in items)
        bodies = dataclasses.replace(bodies, joints=joints)
    q, qd, qdd = states(bodies)
    ours = torques(bodies, q, qd, qdd)
    names = [f"joint_{joint.name}" for joint in bodies.moving_joints]
    assert close(pinocchio_torques(export(robot, to="urdf").data, names, q, qd, qdd), ours)
    assert close(mujoco_torques(export(bodies, to="mjcf").data, names, q, qd, qdd), ours)


def test_what_cannot_be_written_is_refused_in_one_line(tree) -> None:
    for call, word in (
        (lambda: export(load("five-bar"), to="urdf"), "URDF has no loops"),
        (lambda: export(load("emps"), to="urdf"), "a robot without values"),
        (lambda: export(tree, out="x.step"), "does not say the format"),
        (lambda: export(tree), "does not say the format"),
    ):
        with pytest.raises(DataError, match=word) as result:
            call()
        assert "\n" not in str(result.value)


def test_no_name_is_that_of_two_things(tmp_path) -> None:
    """Joints of the file have names that we would give, too."""
    for ours in ("upright", "world", "base", "link_1", "joint_2", "link_3"):
        text = MJCF.replace(b'"shoulder"', f'"{ours}"'.encode())
        robot = reread(tmp_path, "arm.xml", text.replace(b'gravity="0 0', b'gravity="3 1'))
        model = mujoco.MjModel.from_xml_string(export(robot, to="urdf").data.decode())
        assert model.njnt == len(robot.moving_joints)
        assert mujoco.MjModel.from_xml_string(export(robot, to="mjcf").data.decode()).njnt == 3
        for to in ("urdf", "sdf"):
            root = ET.fromstring(export(robot, to=to).data)
            parts = [e for e in root.iter() if e.tag in ("link", "joint", "frame")]
            names = [e.get("name") for e in parts if e.get("name")]
            assert len(names) == len(set(names)) and (to == "urdf") == ("world" in names)


def test_a_moving_link_without_mass_is_told_and_taken_by_mujoco(tmp_path) -> None:
    """Several joints in one body; as light as it may be where the robot is light."""
    arm = reread(tmp_path, "arm.xml", MJCF)
    for size in (1.0, 1e-3, 1e-9):
        values = {name: size * value for name, value in arm.parameters.items()}
        robot = dataclasses.replace(arm, parameters=values)
        result = export(robot, to="urdf")
        (note,) = (note for note in result.notes if note.startswith("link_2"))
        if size == 1e-9:
            assert "too small for MuJoCo" in note
            with pytest.raises(ValueError, match="inertia"):
                mujoco.MjModel.from_xml_string(result.data.decode())
            continue
        assert note.startswith("link_2: no body")
        mujoco.MjModel.from_xml_string(result.data.decode())
        again = reread(tmp_path, "again.urdf", result.data)
        assert same_physics(rigid(robot), rigid(again), 1e-6)


def rigid(robot: Robot) -> Robot:
    """Bodies alone."""
    return dataclasses.replace(
        robot,
        effects=(),
        parameters={
            k: x for k, x in robot.parameters.items() if not k.startswith(("Fv", "Fs", "Ia", "Off"))
        },
    )


def test_a_body_too_small_for_mujoco_is_told(tmp_path) -> None:
    for moment, small in ((3e-15, True), (3e-14, False)):
        text = re.sub(rb'(i[xyz]{2}=")[^"]*', rb"\g<1>0", URDF)
        text = re.sub(rb'(i([xyz])\2=")[^"]*', rf"\g<1>{moment}".encode(), text)
        text = re.sub(rb'<origin xyz="0.0[^>]*>|<origin xyz="0 0 0.05"/>', b"", text)
        text = text.replace(b"<mass value='2.50'/>", b'<mass value="1e-6"/>')
        files = export(reread(tmp_path, "arm.urdf", text), to="urdf")
        assert any("too small for MuJoCo" in note for note in files.notes) == small


def test_numbers_of_the_file_that_the_robot_came_from_are_told(tmp_path) -> None:
    written = export(reread(tmp_path, "a.urdf", URDF), to="urdf")
    values = {(v.part, v.quantity): v for v in written.values}
    assert values["shoulder", "damping"].before == 1.2
    assert values["shoulder", "friction"].before == 0.7
