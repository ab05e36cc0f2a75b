"""`modeler convert`, and files of other programs wherever a command reads a robot."""

import json

import pytest

from modeler.core.choices import read_builtin_robot
from modeler.formats import read_robot
from tests.cli.running import answer, refusal, run
from tests.robot.par_files import par_text
from tests.rotation import with_cases

TWO = par_text({"Ant": "0,1", "d": "0,L", "Theta": "t1,t2", "G": "-9.81,0,0"}, "arm")

TURN = """<robot name="turn"><link name="base"/>
<link name="mid"><inertial><mass value="2"/><origin xyz="0.1 0 0"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
<link name="tip"><inertial><mass value="1"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
<joint name="j" type="continuous"><parent link="base"/><child link="mid"/>
<axis xyz="0 0 1"/></joint>
<joint name="k" type="continuous"><parent link="mid"/><child link="tip"/>
<origin xyz="0.3 0 0" rpy="1.5708 0 0"/><axis xyz="0 0 1"/></joint></robot>"""


@pytest.fixture
def par(tmp_path):
    path = tmp_path / "arm.par"
    path.write_text(TWO)
    return path


def test_a_robot_file_is_written_and_written_over_only_by_force(capsys, par, tmp_path):
    out = tmp_path / "arm.toml"
    printed = answer(capsys, "convert", par, "--out", out, "--json", tmp_path / "c.json")
    assert printed.startswith(f"arm: 2 joints, written to {out}\n* ")
    result = json.loads((tmp_path / "c.json").read_text())
    assert result["robot"] == "arm" and result["joints"] == ["1", "2"] and result["loops"] == []
    assert [f"* {note}" for note in result["notes"]] == printed.splitlines()[1:]
    assert read_robot(out).symbols.keys() == {"L", "g"}
    answer(capsys, "convert", par, "--out", out)  # nothing would be lost
    edited = out.read_text().replace("# no value in the file", "# measured")
    out.write_text(edited)
    assert "--force" in refusal(capsys, "convert", par, "--out", out)
    assert out.read_text() == edited
    answer(capsys, "convert", par, "--out", out, "--force")
    assert "# measured" not in out.read_text()


@with_cases(
    "words, out, message",
    ("macro.xacro", "new.toml", "xacro macro.xacro > macro.urdf"),
    ("world.sdf", "new.toml", "is SDF, which is not read; give the URDF"),
    ("page.xml", "new.toml", "<html> is no URDF"),
    ("arm.toml", "new.toml", "is a robot file already"),
    ("ours.urdf", "new.toml", "ours.urdf: line 1"),
    ("arm.par --tip hand", "new.toml", "--lock and --exact-decimals are for URDF and MJCF"),
    ("turn.urdf --tip hand", "new.toml", '--tip: "hand": no link of that name'),
    ("turn.urdf --lock j", "new.toml", 'expected joint=position such as "elbow=0.3"'),
    ("none.par", "new.toml", "cannot be read"),
    ("arm.par", "other.par", "got .par, which is another program's robot file"),
    ("arm.par", "arm.par", "this is the robot file that is read"),
    ("bad.par", "new.toml", "d: got 3 entries, expected 2"),
)
def test_what_is_refused(capsys, par, monkeypatch, words, out, message):
    folder = par.parent
    monkeypatch.chdir(folder)
    for name, text in {
        "macro.xacro": "<robot><xacro:include/></robot>",
        "page.xml": "<html/>",
        "world.sdf": f"<!-- {'all rights ' * 9000} --><sdf/>",
        "arm.toml": "name = 'arm'",
        "turn.urdf": TURN,
        "bad.par": TWO.replace("0,L", "0,L,0"),
        "ours.urdf": read_builtin_robot("rx90"),
    }.items():
        (folder / name).write_text(text)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert message in refusal(capsys, "convert", *words.split(), "--out", out)
    assert before == {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize(
    ("name", "text", "table"), [("arm.par", TWO, "[mdh]"), ("turn.urdf", TURN, "[frames]")]
)
def test_commands_read_files_of_other_programs(capsys, tmp_path, monkeypatch, name, text, table):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / name
    path.write_text(text)
    status, _, err = run(capsys, "simulate", path, "--duration", "6", "--out", "a.parquet")
    first, *others = err.splitlines()
    assert status == 0 and first == f"modeler: {path}, read as a robot file:"
    assert others and all(line.startswith("  * ") for line in others)
    assert "no values in the file: L" in err or name != "arm.par"
    status, out, _ = run(capsys, "fit", path, "a.parquet", "--out", "m.json")
    assert status == 0 and ("prior" in out or name == "arm.par")
    path.unlink()  # the model holds all of it: it is mailed alone
    assert run(capsys, "compare", "m.json", "a.parquet")[0] == 0
    assert table in json.loads((tmp_path / "m.json").read_text())["robot_text"]


def test_a_suffix_in_capitals_is_the_same(capsys, par):
    status, out, _ = run(capsys, "derive", par.rename(par.with_name("ARM.PAR")), "--no-terms")
    assert status == 0 and "ZZ1R = ZZ1 + L**2*M2" in out


@pytest.mark.parametrize("name", ["arm.xml", "arm", "ARM.URDF", "arm.toml"])
def test_a_urdf_is_known_by_its_first_element(capsys, tmp_path, name):
    path = tmp_path / name
    path.write_text("<?xml version='1.0'?>\n<!-- made by hand -->\n" + TURN)
    status, out, _ = run(capsys, "derive", path, "--no-terms")
    assert status == 0 and out.startswith("turn\n") and "ZZ1R = ZZ1 + Ia1 + YY2 + D2**2*M2" in out


def test_a_urdf_is_cut_and_its_decimals_kept(capsys, tmp_path):
    path, out = tmp_path / "turn.urdf", tmp_path / "turn.toml"
    path.write_text(TURN)

    def converted(*options):
        assert run(capsys, "convert", path, "--out", out, "--force", *options)[0] == 0
        return read_robot(out)

    assert [frame.joint for frame in converted("--tip", "mid").frames.values()] == ["", "j"]
    assert len(converted("--base", "mid").moving_joints) == 1
    assert converted("--lock", "k=90deg").frames["tip"].row == "1"
    exact = converted("--exact-decimals")
    angle = exact.joints[1].alpha.evaluate(exact.evaluate_symbols())
    assert angle == pytest.approx(1.5708, abs=1e-15) and converted().joints[1].alpha.text == "pi/2"
