"""`modeler convert`, and files of other programs wherever a command reads a robot."""

import json

import pytest

from modeler.core.builtin import builtin_file
from modeler.robot import urdf, xml_source
from modeler.robot.read import read_robot
from modeler.robot.xml_source import parse_xml
from tests.cli.running import answer, refusal, run
from tests.robot.par_files import par_text

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


def test_convert_writes_a_robot_file_and_says_what_it_decided(capsys, par, tmp_path):
    out = tmp_path / "arm.toml"
    told = answer(capsys, "convert", par, "--out", out, "--json", tmp_path / "c.json")
    assert told.startswith(f"arm: 2 joints, written to {out}\n* ")
    result = json.loads((tmp_path / "c.json").read_text())
    assert result["robot"] == "arm" and result["joints"] == ["1", "2"] and result["loops"] == []
    assert [f"* {note}" for note in result["notes"]] == told.splitlines()[1:]
    assert read_robot(out).symbols.keys() == {"L", "g"}


def test_a_file_is_written_over_only_by_force(capsys, par, tmp_path):
    out = tmp_path / "arm.toml"
    answer(capsys, "convert", par, "--out", out)
    answer(capsys, "convert", par, "--out", out)  # nothing would be lost
    edited = out.read_text().replace("# no value in the file", "# measured")
    out.write_text(edited)
    assert "--force" in refusal(capsys, "convert", par, "--out", out)
    assert out.read_text() == edited
    answer(capsys, "convert", par, "--out", out, "--force")
    assert "# measured" not in out.read_text()


@pytest.mark.parametrize(
    ("name", "out", "told"),
    [
        ("arm.urdf", "new.toml", "<robot> has no link"),
        ("macro.xacro", "new.toml", "xacro macro.xacro > macro.urdf"),
        ("world.sdf", "new.toml", "is SDF, which is not read; give the URDF"),
        ("still.urdf", "new.toml", "no joint of the robot moves"),
        ("page.xml", "new.toml", "<html> is no URDF"),
        ("arm.toml", "new.toml", "is a robot file already"),
        ("arm.par --tip hand", "new.toml", "--lock and --exact-decimals are for URDF and MJCF"),
        ("turn.urdf --tip hand", "new.toml", '--tip: "hand": no link of that name'),
        ("turn.urdf --lock j", "new.toml", 'expected joint=position such as "elbow=0.3"'),
        ("none.par", "new.toml", "cannot be read"),
        ("arm.par", "other.par", "got .par, which is another program's robot file"),
        ("arm.par", "arm.par", "this is the robot file that is read"),
        ("bad.par", "new.toml", "d: got 3 entries, expected 2"),
    ],
)
def test_what_is_refused(capsys, par, monkeypatch, name, out, told):
    monkeypatch.chdir(par.parent)
    texts = {
        "arm.urdf": "<robot/>\n", "macro.xacro": "<robot><xacro:include/></robot>",
        "world.sdf": "<sdf/>", "still.urdf": "<robot><link name='a'/></robot>",
        "page.xml": "<html/>", "arm.toml": "name = 'arm'", "turn.urdf": TURN,
    }  # fmt: skip
    for other, text in texts.items():
        (par.parent / other).write_text(text)
    (par.parent / "bad.par").write_text(TWO.replace("0,L", "0,L,0"))
    before = {path.name: path.read_bytes() for path in par.parent.iterdir()}
    assert told in refusal(capsys, "convert", *name.split(), "--out", out)
    assert before == {path.name: path.read_bytes() for path in par.parent.iterdir()}


@pytest.mark.parametrize(
    ("name", "text", "kept"), [("arm.par", TWO, "[mdh]"), ("turn.urdf", TURN, "[frames]")]
)
def test_every_command_reads_files_of_others(capsys, tmp_path, monkeypatch, name, text, kept):
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
    assert kept in json.loads((tmp_path / "m.json").read_text())["robot_text"]


def test_a_mistake_in_a_par_is_one_line_of_every_command(capsys, tmp_path):
    bad = tmp_path / "bad.par"
    bad.write_text(TWO.replace("Ant", "Antt"))
    for argv in (["derive", bad], ["robots", bad], ["effects", "--robot", bad]):
        assert f'{bad}: line 12: unknown keyword "Antt"' in refusal(capsys, *argv)


def test_a_par_is_shown_as_a_robot_file(capsys, par):
    out = run(capsys, "robots", par)[1]
    assert out.startswith('name = "arm"\n') and "[mdh]" in out


def test_a_suffix_in_capitals_is_the_same(capsys, par):
    status, out, _ = run(capsys, "derive", par.rename(par.with_name("ARM.PAR")), "--no-terms")
    assert status == 0 and "ZZ1R = ZZ1 + L**2*M2" in out


@pytest.mark.parametrize("name", ["arm.urdf", "arm.xml", "arm", "arm.txt", "ARM.URDF", "arm.toml"])
def test_a_urdf_is_known_by_its_first_element(capsys, tmp_path, name):
    path = tmp_path / name
    path.write_text("<?xml version='1.0'?>\n<!-- made by hand -->\n" + TURN)
    status, out, err = run(capsys, "derive", path, "--no-terms")
    assert status == 0 and out.startswith("turn\n") and "ZZ1R = ZZ1 + Ia1 + YY2 + D2**2*M2" in out
    first, *others = err.splitlines()
    assert first == f"modeler: {path}, read as a robot file:"
    assert others and all(line.startswith("  * ") for line in others)


def test_a_file_is_parsed_once(capsys, tmp_path, monkeypatch):
    """And its first element is found behind a licence of any length."""
    path = tmp_path / "arm.urdf"
    path.write_text(f"<!-- {'all rights ' * 9000} -->\n{TURN}")
    parsed = []
    monkeypatch.setattr(urdf, "parse_xml", lambda *a: parsed.append(a) or parse_xml(*a))
    monkeypatch.setattr(xml_source, "parse_xml", None)
    assert run(capsys, "derive", path, "--no-terms")[0] == 0 and len(parsed) == 1
    path.write_text(f"<!-- {'all rights ' * 9000} --><sdf/>")
    assert "is SDF" in run(capsys, "derive", path)[2]


def test_another_program_s_ending_with_our_text_is_no_urdf(capsys, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(builtin_file("rx90").read_text())
    assert "arm.urdf: line 1" in refusal(capsys, "derive", path)


def test_a_urdf_is_cut_and_its_decimals_kept(capsys, tmp_path):
    path, out = tmp_path / "turn.urdf", tmp_path / "turn.toml"
    path.write_text(TURN)
    rows = {}
    for words in ("", "--tip mid", "--base mid", "--lock k=90deg", "--exact-decimals"):
        assert run(capsys, "convert", path, "--out", out, "--force", *words.split())[0] == 0
        rows[words] = read_robot(out)
    one = rows[""]
    assert [j.name for j in one.moving] == ["1", "2"] and one.joints[1].alpha.text == "pi/2"
    assert one.frames["tip"].joint == "k" and one.frames["mid"].row == "1"
    assert [f.joint for f in rows["--tip mid"].frames.values()] == ["", "j"]
    assert len(rows["--tip mid"].moving) == len(rows["--base mid"].moving) == 1
    assert rows["--lock k=90deg"].frames["tip"].row == "1"
    measured = rows["--exact-decimals"]
    angle = measured.joints[1].alpha.number(measured.symbol_values())
    assert angle == pytest.approx(1.5708, abs=1e-15) and angle != one.joints[1].alpha.number({})
