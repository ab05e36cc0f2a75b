"""Originals with other numbers: what is no number stays, what is one is the model's."""

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

from modeler.api import export
from modeler.cli import main
from modeler.core.errors import DataError, ModelerError, RobotError
from modeler.estimation import PREFIXES
from modeler.formats import convert, read_robot
from modeler.robot import Robot, parse_robot_text, replace_gravity
from tests.export.arms import (
    MJCF,
    SDF,
    URDF,
    changed,
    reread,
    same_physics,
    without_comment,
    without_numbers,
    written,
)
from tests.robot.public_robots import each_public_urdf, public_urdf
from tests.rotation import rotating, with_cases

pytest.importorskip("mujoco", reason="NOT CHECKED: no MuJoCo")
ARMS = {"arm.urdf": URDF, "arm.xml": MJCF}


@pytest.fixture
def urdf(tmp_path):
    """The arm as a file."""
    return written(tmp_path, "arm.urdf", URDF)


@pytest.fixture
def mjcf(tmp_path):
    return written(tmp_path, "arm.xml", MJCF)


def other_values(place: Path, rows: str = "") -> Robot:
    """The robot of the file with other bodies and other friction."""
    return changed(read_robot(place), np.random.default_rng(), rows)


def valued(robot: Robot, **values: float) -> Robot:
    return dataclasses.replace(robot, parameters=robot.parameters | values)


def refused(word: str, robot: Robot, like: Path, to: str | None = None) -> None:
    with pytest.raises(DataError, match=word) as error:
        export(robot, like=like, to=to)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ARMS)
def test_other_values_read_back_as_they_are_and_none_leave_the_file_as_it_is(tmp_path, name):
    place = written(tmp_path, name, ARMS[name])
    same = export(read_robot(place), like=place)
    assert same.data == ARMS[name] and not any(value.is_changed for value in same.values)
    robot = other_values(place)
    data = export(robot, like=place).data
    again = reread(tmp_path, f"again_{name}", data)
    assert same_physics(robot, again)
    assert not same_physics(read_robot(place), again)
    moved = export(again, like=tmp_path / f"again_{name}")
    assert moved.data == data  # and nothing moves any more
    back = export(read_robot(place), like=tmp_path / f"again_{name}").data
    assert data.count(b"modeler export") == back.count(b"modeler export") == 1
    assert same_physics(read_robot(place), reread(tmp_path, name, back))


def test_odd_xml_and_a_quaternion_of_an_inertial_are_kept(tmp_path) -> None:
    """A declaration that is not first, -- in a comment, Latin-1, a tensor along turned axes."""
    head = b'\r\n<?xml version="1.0" encoding="ISO-8859-1"?>\n<!---- bras \xe9 -- 1 ---->\n'
    turn = b'quat_xyzw="0.1 -0.2 0.3 0.9"'
    text = re.sub(rb'(<inertial>\s*<origin[^>]*?)rpy="[^"]*"', rb"\1" + turn, URDF)
    text = head + text.split(b"?>", 1)[1].lstrip()
    place = written(tmp_path, "arm.urdf", text)
    assert turn in text and export(read_robot(place), like=place).data == text
    robot = other_values(place)
    data = export(robot, like=place).data
    assert same_physics(robot, reread(tmp_path, "again.urdf", data))
    assert turn in data and without_comment(data).startswith(head[:40]) and b"bras \xe9" in data


def test_urdf_outside_the_numbers_is_the_same_text(tmp_path) -> None:
    place = written(tmp_path, "arm.urdf", URDF.replace(b"\n", b"\r\n"))
    data = export(valued(other_values(place), Fv2=0.25), like=place).data
    assert data.startswith(b"<?xml version='1.0'?>\r\n<!-- modeler export: ")
    assert data.count(b"\r\n") == data.count(b"\n")
    lines = without_numbers(without_comment(data)).splitlines()
    before = without_numbers(URDF).splitlines()
    assert not [line for line in lines if line not in before]
    # one joint had no <dynamics>, one body no <origin>
    added = [line.strip() for line in lines if b"<dynamics" in line]
    both = b'<dynamics friction="N" damping="N"/>'
    assert sorted(added) == [b'<dynamics damping="N"/>'] * 2 + [both]
    gone = [line for line in before if line not in lines]
    assert gone == [b'    <inertial><mass value="N"/>']


def test_lumped_bodies_keep_their_numbers_and_one_without_mass_leaves_the_change(urdf) -> None:
    """To what hangs on it."""
    result = export(other_values(urdf, "2"), like=urdf)
    parts = {value.part for value in result.values if value.is_changed and value.quantity == "mass"}
    assert parts == {"fore"} and any("tool as before" in note for note in result.notes)
    tool = result.data[result.data.index(b'<link name="tool">') :][:300]
    assert tool == URDF[URDF.index(b'<link name="tool">') :][:300]
    robot = read_robot(urdf)
    heavier = export(valued(robot, M3=robot.parameters["M3"] + 0.1), like=urdf)
    mass = next(v for v in heavier.values if v.quantity == "mass" and v.is_changed)
    assert (mass.part, mass.before) == ("finger", 0.2) and mass.after == pytest.approx(0.3)


def test_mjcf_writes_what_defaults_and_geoms_said(mjcf) -> None:
    text = export(other_values(mjcf), like=mjcf).data.decode()
    assert text.count("<inertial") == 3 and text.count("fullinertia") == 3
    assert 'euler="5 10 20"' not in text and "diaginertia" not in text.split("-->", 1)[1]
    for name in ("shoulder", "roll", "elbow"):
        line = next(x for x in text.splitlines() if f'joint name="{name}"' in x)
        assert "damping=" in line and "armature=" in line
    assert '<default class="stiff"><joint damping="2" frictionloss="0.3"/></default>' in text


def test_a_body_of_geoms_gets_all_that_an_inertial_must_have(tmp_path) -> None:
    """Its mass changes, its centre does not."""
    start = MJCF.index(b'<inertial pos="0.01 0 0.15"')
    text = MJCF[:start] + MJCF[MJCF.index(b"/>", start) + 2 :]
    place = written(tmp_path, "arm.xml", text)
    robot = read_robot(place)
    heavy = {f"{prefix}1": 1.1 * robot.parameters[f"{prefix}1"] for prefix in PREFIXES}
    robot = valued(robot, **heavy)
    again = reread(tmp_path, "again.xml", export(robot, like=place).data)
    assert again.parameters["M1"] == pytest.approx(heavy["M1"]) and same_physics(robot, again)


def test_sdf_is_matched_by_its_links(urdf, tmp_path) -> None:
    robot = read_robot(urdf)
    values = {k: v for k, v in robot.parameters.items() if k != "M2"} | {"M1": 3.5, "Fv1": 0.5}
    sdf = written(tmp_path, "arm.sdf", SDF)
    data = export(dataclasses.replace(robot, parameters=values), like=sdf).data
    assert b"<mass>3.5</mass>" in data and b"<damping>0.5</damping><friction>0.7" in data
    for old, new, word in (
        (b"<pose>0 0 0.3 0 0.4 0", b"<pose>0 0 0.4 0 0.4 0", "link upper stands elsewhere at 0"),
        (b'"slider"', b'"sled"', "it has no link slider"),
    ):
        refused(word, robot, written(tmp_path, "other.sdf", SDF.replace(old, new)))


def test_a_table_without_frames_is_matched_by_its_geometry(urdf, tmp_path) -> None:
    robot = dataclasses.replace(other_values(urdf), frames={})
    assert same_physics(robot, reread(tmp_path, "again.urdf", export(robot, like=urdf).data))
    longer = written(tmp_path, "longer.urdf", URDF.replace(b"0.05 0 0.3", b"0.05 0 0.4"))
    refused("link fore is placed otherwise on upper", robot, longer)


@with_cases(
    "old, new, word",
    (b'xyz="0.05 0 0.3"', b'xyz="0.05 0 0.31"', "link fore is placed otherwise on upper"),
    (b'axis xyz="0 0 -1"', b'axis xyz="0 0 1"', "link fore is placed otherwise on upper"),
    (b'"tool"', b'"gripper"', "it has no link tool"),
)
def test_another_robot_is_refused(urdf, tmp_path, old, new, word) -> None:
    refused(word, read_robot(urdf), written(tmp_path, "other.urdf", URDF.replace(old, new)))


def test_another_gravity_is_told(urdf, mjcf, tmp_path) -> None:
    tilted = written(tmp_path, "tilted.xml", MJCF.replace(b"0 0 -9.81", b"3 1 -9"))
    wall = parse_robot_text(replace_gravity(read_robot(urdf).text, [-9.81, 0.0, 0.0]), "wall.toml")
    for robot, like, says in (
        (read_robot(mjcf), tilted, "[3, 1, -9] m/s2 in tilted.xml and [0, 0, -9.81] in the robot"),
        (wall, urdf, "in the robot, in frame 0"),
        (read_robot(tilted), tilted, ""),
        (read_robot(urdf), urdf, ""),
        (convert(urdf, base="upper"), urdf, ""),  # which has it turned
    ):
        notes = [note for note in export(robot, like=like).notes if "gravity" in note]
        assert bool(notes) == bool(says) and all(says in note for note in notes)


@with_cases(
    "first, second, word",
    (b"", b'<mimic joint="shoulder"/>', "joint elbow follows shoulder there, and is free"),
    (b'<mimic joint="shoulder"/>', b"", "joint elbow is free there, and follows"),
    (
        b'<mimic joint="shoulder" offset="0.1"/>',
        b'<mimic joint="shoulder" multiplier="2"/>',
        "joint elbow follows shoulder otherwise",
    ),
)
def test_joints_that_follow_otherwise_are_refused(tmp_path, first, second, word) -> None:
    axis = b'<axis xyz="0 0 -1"/>'
    texts = [URDF.replace(axis, axis + x) for x in (first, second)]
    one, other = (written(tmp_path, f"{k}.urdf", text) for k, text in enumerate(texts))
    robot = read_robot(one)
    assert export(robot, like=one).data == texts[0]
    refused(word, robot, other)


def test_joints_without_a_name_are_found_by_their_links(mjcf, tmp_path) -> None:
    robot = other_values(mjcf)
    text = MJCF.replace(b'name="elbow" ', b"")
    text = text.replace(b'<motor joint="elbow" gear="2"/>', b"")
    result = export(robot, like=written(tmp_path, "nameless.xml", text))
    assert ("joint2", "damping") in {(v.part, v.quantity) for v in result.values}
    assert same_physics(robot, reread(tmp_path, "again.xml", result.data))
    turned = text.replace(b'axis="0 0 1" pos="0 0.02 0"', b'axis="0 1 0"')
    refused("link fore is placed otherwise", robot, written(tmp_path, "turned.xml", turned))


def test_rounding_is_no_change(tmp_path) -> None:
    """Bodies turned against their links, far from their joints, with zeros: none has changed."""
    rng = np.random.default_rng()
    for _ in range(5):
        turn, far = (" ".join(map(repr, rng.normal(size=3).tolist())) for _ in range(2))
        turned = f'<origin xyz="0 0 0.05" rpy="{turn}"/>'
        text = URDF.replace(b'<origin xyz="0 0 0.05"/>', turned.encode())
        text = text.replace(b'<origin xyz="0.05 0 0.3"', f'<origin xyz="{far}"'.encode())
        place = written(tmp_path, "arm.urdf", text)
        robot = read_robot(place)
        result = export(robot, like=place)
        assert result.data == text and not any(value.is_changed for value in result.values)
        heavy = valued(robot, M2=robot.parameters["M2"] * (1 + 1e-7))
        assert any(value.is_changed for value in export(heavy, like=place).values)
        negative = [v for v in result.values if v.after == 0.0 and np.signbit(v.after)]
        assert not negative and not any(0.0 < abs(v.after) < 1e-12 for v in result.values)


def test_only_changed_numbers_are_listed(urdf, tmp_path, capsys) -> None:
    other = written(tmp_path, "other.urdf", URDF.replace(b'damping="4"', b'damping="5"'))
    assert main(["export", str(other), "--like", str(urdf), "--out", str(tmp_path / "n.urdf")]) == 0
    text = capsys.readouterr().out
    assert "1 of " in text and "others are as they were" in text
    assert "slide" in text and "mass" not in text.split("cannot hold")[0]


@with_cases(
    "name, old, new, word",
    ("a.xml", b'angle="degree"', b'angle="degree" inertiafromgeom="true"', 'write "auto" there'),
    ("a.xml", b'angle="degree"', b'angle="degree" settotalmass="9"', "settotalmass changes"),
    ("a.xml", b'armature="0.05"', b'springdamper="1 1"', "springdamper makes damping"),
    ("a.xml", b'gear="2"', b'gear="2" armature="0.1"', "actuators state armature or damping"),
    ("a.txt", MJCF, b"<x/>", r"expected <robot> \(URDF\)"),
    ("a.urdf", MJCF, URDF, "URDF, and --to or the ending of --out says mjcf"),
)
def test_what_cannot_be_replaced_is_refused(mjcf, tmp_path, name, old, new, word) -> None:
    base = (
        MJCF
        if new == URDF
        else MJCF.replace(
            b'fullinertia="0.0004 0.0004 0.0002 1e-5 0 0"', b'diaginertia="0.0004 0.0004 0.0002"'
        )
    )
    place = written(tmp_path, name, new if old == MJCF else base.replace(old, new))
    refused(word, other_values(mjcf), place, "mjcf" if name.endswith("urdf") else None)


def test_a_body_of_an_included_file_is_refused(tmp_path) -> None:
    start, end = MJCF.index(b'<body name="fore"'), MJCF.index(b"    </body>\n  </worldbody>")
    part = b"<mujocoinclude>" + MJCF[start:end] + b"</mujocoinclude>"
    written(tmp_path, "fore.xml", part)
    place = written(tmp_path, "arm.xml", MJCF[:start] + b'<include file="fore.xml"/>' + MJCF[end:])
    assert export(read_robot(place), like=place).data == place.read_bytes()
    refused("link fore does not stand in the file itself", other_values(place), place)


def test_nothing_is_written_over_unasked(urdf, tmp_path) -> None:
    robot = other_values(urdf)
    with pytest.raises(ModelerError, match=r"\(force=True\)"):
        export(robot, urdf, like=urdf)
    export(robot, tmp_path / "new.urdf", like=urdf)
    refused("cannot be read", robot, tmp_path / "none.urdf")


@pytest.mark.parametrize(
    "name", ["so101.urdf", "panda.urdf", *rotating("allegro_left_hand.urdf", "baxter.urdf")]
)
def test_public_urdfs_stay_as_they_are(name) -> None:
    path = public_urdf(name)
    assert export(read_robot(path), like=path).data == path.read_bytes()


@pytest.mark.slow
@pytest.mark.rotating
@each_public_urdf()
def test_every_public_urdf_stays_as_it_is(path) -> None:
    try:
        robot = read_robot(path)
    except RobotError as error:
        assert "no joint of the robot moves" in str(error) or "<robot> has no link" in str(error)
        pytest.skip(str(error))
    if not any(name.startswith("M") for name in robot.parameters):
        pytest.skip("no values")
    assert export(robot, like=path).data == path.read_bytes()
