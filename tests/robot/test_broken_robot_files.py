"""Robot files of other programs that are broken: one clear line, in bounded memory and time."""

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from modeler.core.errors import RobotError
from modeler.formats import read_robot
from tests.robot.public_robots import public_urdf
from tests.robot.spoilt_files import check_spoilt
from tests.robot.test_urdf import INERTIA
from tests.robot.texts import ARM_URDF as ARM, edited
from tests.rotation import with_cases

ELBOW = '<parent link="upper"/><child link="fore"/>'
BROKEN = [
    ("cycle", '<parent link="base"/>', '<parent link="left"/>', "of its own parents; mend"),
    ("two parents", ELBOW, '<parent link="fore"/><child link="upper"/>', '"shoulder" too; '),
    ("two first links", "<link ", '<link name="camera"/><link ', "no joint leads to 2 links"),
    ("unknown parent", ELBOW, '<parent link="uper"/><child link="fore"/>', 'mean "upper"'),
    ("no child", ELBOW, '<parent link="upper"/>', 'joint "elbow": <child> is missing'),
    ("link twice", '<link name="left"/>', '<link name="base"/>', "the first is in line 3: rename"),
    ("no name", '<link name="left"/>', "<link/>", '<link>: name is missing; write name="'),
    ("no type", ' type="continuous"', "", 'joint "elbow": type is missing'),
    ("type", '"continuous"', '"continous"', 'got "continous"; .* mean "continuous"'),
    ("axis 0", '<axis xyz="0 0 2"/>', '<axis xyz="0 0 0"/>', "expected a direction such as"),
    ("comma", 'xyz="0 0 0.4"', 'xyz="0 0 0,4"', 'got "0,4"; expected 3 numbers such as'),
    ("two numbers", 'xyz="0 0 0.4"', 'xyz="0 0.4"', 'got "0 0.4"; expected 3 numbers'),
    ("nan", 'rpy="0 0.7854 0.25"', 'rpy="0 nan 0"', 'rpy: got "nan"; expected 3 numbers'),
    ("huge", 'xyz="0 0 0.4"', 'xyz="0 0 1e300"', "expected at most 10000 in SI units"),
    ("mass", '<mass value="0.5"/>', "<mass/>", 'link "flange" .*: value is missing; write'),
    ("no mass", '<mass value="0.5"/>', "", 'link "flange" <inertial>: <mass> is missing'),
    ("inertia", 'iyz="0.0005"', "", 'link "upper" .*: iyz is missing; write iyz="0.01"'),
    ("two inertials", "</inertial>", "</inertial><inertial/>", "a second <inertial>"),
    ("mimic itself", 'mimic joint="finger"', 'mimic joint="other"', "follows itself by"),
    (
        "xacro",
        '<mass value="0.5"/>',
        '<mass value="${m}"/>',
        r"<mass> is of xacro, not of URDF; expand it first: xacro \S*arm.urdf > \S*_expanded.urdf",
    ),
    ("macro", "</robot>", "<xacro:gripper/></robot>", "<xacro:gripper> is of xacro"),
]


def message_of(text: bytes | str, path: Path) -> str:
    """What is reported about a file, which is one line and not longer than one reads."""
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(RobotError) as error:
        read_robot(path)
    result = str(error.value)
    assert result.startswith(str(path)), result
    assert len(result.splitlines()) == 1, result
    return result


@pytest.mark.parametrize(
    ("old", "new", "expected"), [pytest.param(*row[1:], id=row[0]) for row in BROKEN]
)
def test_mistakes_are_told_with_their_place(old: str, new: str, expected: str, tmp_path: Path):
    text = message_of(edited(ARM, (old, new)), tmp_path / "arm.urdf")
    assert re.search(expected, text), text
    assert re.search(r": line \d+: ", text), text


@with_cases(
    "text, message",
    ("<sdf version='1.7'><model name='a'/></sdf>", "SDF"),
    ("<html><body/></html>", "URDF"),
    ("<robot name='a'><!-- <link name='b'/> --></robot>", "line 1: <robot> has no link"),
    ('<robot xmlns:xacro="x"><xacro:include filename="a"/></robot>', "> .*/arm.urdf$"),
)
def test_other_formats_are_named(text: str, message: str, tmp_path: Path):
    path = tmp_path / ("arm.urdf.xacro" if "xacro" in text else "arm.urdf")
    assert re.search(message, message_of(text, path))


def test_what_can_be_read_is_read(tmp_path: Path):
    """A link without inertial, an axis that is not of length 1, an impossible inertia: reported."""
    path = tmp_path / "arm.urdf"
    path.write_text(edited(ARM, (INERTIA, INERTIA.replace('izz="0.001"', 'izz="0.5"'))))
    text = " ".join(read_robot(path).readings)
    for words in ("no inertia is", "not of length 1", "principal moments 0.001, 0.001, 0.5 kg m2"):
        assert words in text


LAUGHS = "".join(f'<!ENTITY l{i + 1} "{f"&l{i};" * 10}">' for i in range(12))
BOMBS: dict[str, Callable[[], bytes]] = {
    "billion laughs": lambda: f"""<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]>
        <robot name="&l12;"/>""".encode(),
    "quadratic": lambda: f"""<!DOCTYPE robot [<!ENTITY a "{"a" * 100_000}">]>
        <robot name="{"&a;" * 100_000}"/>""".encode(),
    "external": lambda: b"""<!DOCTYPE robot SYSTEM "http://localhost/robot.dtd"><robot/>""",
    "deep": lambda: b"<robot>" * 3_000_000,
    "many": lambda: b"<robot>" + b"<link/>" * 1_500_000 + b"</robot>",
    "attributes": lambda: b"<robot " + b"".join(b'a%d="" ' % i for i in range(1_000_000)) + b"/>",
    "long value": lambda: b'<robot name="' + b"a" * 40_000_000 + b'"/>',
    "long number": lambda: edited(ARM, ('"0 0 0.4"', f'"0 0 {"9" * 5_000_000}"')).encode(),
    "comment": lambda: b"<robot><!--" + b"a" * 40_000_000,
    "comments": lambda: b"<!---->" * 5000 + b"<robot>",
    "large": lambda: b"<robot>" + b" " * 70_000_000 + b"</robot>",
}
CHILD = """
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (int(sys.argv[1]), int(sys.argv[1])))
from modeler.core.errors import RobotError
from modeler.formats import read_robot
for path in sys.argv[2:]:
    try:
        read_robot(path)
    except RobotError as error:
        print(error)
"""


@pytest.mark.rotating("long tests of robot")
@pytest.mark.skipif(sys.platform != "linux", reason="NOT CHECKED: memory limits are of Linux")
def test_bombs_are_refused_in_bounded_memory(tmp_path: Path):
    """In a process that may take 1 GiB of addresses, the libraries included, and 60 s."""
    paths = [tmp_path / f"{bomb.replace(' ', '-')}.urdf" for bomb in BOMBS]
    for path, made in zip(paths, BOMBS.values(), strict=True):
        path.write_bytes(made())
    done = subprocess.run(
        [sys.executable, "-c", CHILD, str(2**30), *map(str, paths)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    for path in paths:
        path.unlink()
    assert done.returncode == 0, done.stderr[-2000:]
    lines = done.stdout.splitlines()
    assert [line.partition(":")[0] for line in lines] == [str(path) for path in paths], lines


SPOILT = ("ur5_robot", "panda", "allegro_left_hand", "talos_left_arm")


@pytest.mark.parametrize(
    "name", ["arm", "so101", *(pytest.param(name, marks=pytest.mark.rotating) for name in SPOILT)]
)
def test_spoilt_files_are_read_or_told_in_one_line(name: str, tmp_path: Path):
    data = ARM.encode() if name == "arm" else public_urdf(f"{name}.urdf").read_bytes()
    check_spoilt(data, tmp_path / f"{name}.urdf")
