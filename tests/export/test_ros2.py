"""The package for ROS 2: its core tracks a motion without ROS, the rest compiles on stand-ins."""

import xml.etree.ElementTree as ET
from functools import partial
from pathlib import Path

import pytest

from modeler.api import export, load
from modeler.cli import main
from modeler.core.errors import ModelerError
from modeler.robot import parse_robot_text
from tests.csrc import emitted_folders
from tests.rotation import rotating

ROS2 = Path(__file__).with_name("ros2")
"""A program around the core, and headers of ROS 2 Jazzy as far as the controller uses them."""

HOT = '[effects]\ntemperature_friction = "all"'
run = partial(emitted_folders.run, where=ROS2)
WARNED = ("-Wall", "-Wextra", "-Wconversion", "-Werror")


@pytest.fixture(scope="module", params=["demo-arm", *rotating("five-bar")])
def package(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ros2") / "package"
    return export(load(request.param), folder, to="ros2"), folder


def test_the_core_tracks_a_motion_without_ros(package, tmp_path) -> None:
    result, folder = package
    if result.robot != "demo-arm":
        pytest.skip("the harness is for trees")
    name = ET.parse(folder / "package.xml").getroot().findtext("name")
    text = (ROS2 / "harness.cpp").read_text().replace("PACKAGE", name).replace("PREFIX", "demo_arm")
    (tmp_path / "harness.cpp").write_text(text)
    sources = sorted((folder / "src").glob("*.c"))
    for source in sources:
        run("gcc", "-std=c99", "-O1", "-c", source, "-o", tmp_path / f"{source.stem}.o")
    files = (tmp_path / "harness.cpp", *tmp_path.glob("*.o"), "-o", tmp_path / "harness")
    run("g++", "-std=c++17", "-O1", *WARNED, "-I", folder / "src", *files)
    right, largest, *message = map(float, run(tmp_path / "harness", 1.0, 0.0).split())
    wrong = float(run(tmp_path / "harness", 0.7, 0.0).split()[0])
    assert right < 2e-3 < wrong  # rad; it begins 0.1 rad away
    assert message == [3.0, 0.0, 3.0, 0.0]  # a position, then a limit that is no number
    limited = float(run(tmp_path / "harness", 1.0, largest / 3).split()[1])
    assert limited == pytest.approx(largest / 3, rel=1e-5)


def test_the_controller_compiles_on_stand_ins_of_ros(package, tmp_path) -> None:
    _, folder = package
    flags = ("-std=c++17", "-fsyntax-only", *WARNED, "-Wno-sign-conversion")
    headers = ("-isystem", ROS2 / "headers", "-I", folder / "src")
    run("g++", *flags, *headers, folder / "src" / "controller.cpp")


def test_the_files_name_one_another(package) -> None:
    result, folder = package
    name = ET.parse(folder / "package.xml").getroot().findtext("name")
    made = ET.parse(folder / "plugin.xml").getroot()
    assert made.get("path") == name
    assert made.find("class").get("type") == f"{name}::Controller"
    source = result.files["src/controller.cpp"].decode()
    assert f"PLUGINLIB_EXPORT_CLASS({name}::Controller" in source
    cmake = result.files["CMakeLists.txt"].decode()
    assert all(f"src/{p.name}\n" in cmake for p in (folder / "src").glob("*.c"))
    assert f"type: {name}/Controller" in result.files["config/controller.yaml"].decode()


def test_a_package_is_written_again(tmp_path, capsys) -> None:
    words = ["export", "two-link", "--to", "ros2", "--out", str(tmp_path / "p")]
    assert main(words) == main(words) == 0
    (tmp_path / "p" / "README.md").write_text("mine")
    assert main(words) == 1
    assert "README.md: there is such a file with another content" in capsys.readouterr().err
    assert main([*words, "--force"]) == 0
    assert (tmp_path / "p" / "README.md").read_text() != "mine"
    assert main([*words[:2], "--to", "urdf", "--out", str(tmp_path / "p")]) == 1
    assert "p: is a folder; expected the name of a file" in capsys.readouterr().err


def test_what_is_refused(tmp_path) -> None:
    text = load("demo-arm").text
    robot = parse_robot_text(text.replace("[effects]", HOT), "hot")
    with pytest.raises(ModelerError, match="is for robot files, and --to says casadi"):
        export(robot, to="casadi", like="arm.urdf")
    for to in ("ros2", "fmu"):
        with pytest.raises(ModelerError, match="its effects read temperature, which"):
            export(robot, tmp_path / "p", to=to)
        with pytest.raises(ModelerError, match="wrist: a robot without values; write"):
            export(load("wrist"), tmp_path / "p", to=to)
        with pytest.raises(ModelerError, match=f"arm.urdf: is for robot files, and --to says {to}"):
            export(robot, tmp_path / "p", to=to, like="arm.urdf")
