"""`--map auto`, what a model keeps of it, `log --write`, and [fit] and [diagnose] of a robot."""

import json
import shlex
import shutil

import numpy as np
import pytest

from modeler.api import read_logs
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError, RobotError
from modeler.estimation import load_model
from modeler.logs.mapping import build_map
from modeler.robot import parse_robot_text
from tests.logs.programs import german_excel, joined
from tests.logs.test_log_commands import values
from tests.logs.writers import parquet

TABLES = [
    {"time": "t [ms]", "q<j>": "pos[{n}] [deg]", "tau<j>": {"column": "load_{j}", "sign": -1}},
    {
        "q2": {"column": "enc 2 [x]", "unit": "rev/8192", "scale": 0.01, "sign": -1, "offset": 3.5},
        "rate": 500.0,
        "topic": "/joint_states",
        "names": {"1": "waist"},
        "q<j>": "p.{name}",
    },
    {"files": {"q": "_q.csv", "tau": "_tau.csv"}, "current<j>": "c{n+6}", "time": "pos [deg] [s]"},
]


@pytest.mark.parametrize("table", TABLES)
def test_a_table_of_a_map_reads_alike(table, case):
    joints = case.compiled.spec.joints
    before = build_map(table, "[log]")
    again = build_map(json.loads(json.dumps(before.build_table(joints))), "model")
    for item, entry in before.expand_entries(joints).items():
        other = again.expand_entries(joints)[item]
        assert entry.has_same_scale(other) and entry.columns[-1] == other.columns[-1]
    for name in ("names", "topic", "rate", "files"):
        assert getattr(again, name) == getattr(before, name)


def test_a_pattern_over_a_joint_replaces_it(case):
    low = build_map({"q2": "enc2", "q<j>": "a{j}", "x": "force"}, "robot")
    high = build_map({"q<j>": "b{j}"}, "--map")
    joints = case.compiled.spec.joints
    assert high.merge_over(low).build_table(joints) == {"q<j>": "b{j}", "x": "force"}


def degrees(case) -> dict[str, np.ndarray]:
    """Names that show a role, ranges that show a unit."""
    table = {"stamp": case.table["time"] * 1e3}
    for k, column in enumerate(np.rad2deg(joined(case.table, "q")).T):
        table[f"winkel_{k}"] = column
    for k, column in enumerate(joined(case.table, "tau").T):
        table[f"moment_{k}"] = column
    return table


def test_a_unit_by_range_is_believed_where_it_fits(case, tmp_path):
    path = parquet(tmp_path / "a.parquet", degrees(case))
    log = case.check(path, ["auto"])
    (lines,) = [line for line in log.reading_notes if "auto" in line]
    assert "q<j> = winkel_{n-1} [deg]" in lines and "time = stamp [ms]" in lines
    assert not any("auto" in line for line in log.notes)  # which would be warnings


def test_what_is_stated_goes_over_the_guess(case, tmp_path):
    table = degrees(case)
    table["winkel_1"] *= -1.0
    case.check(parquet(tmp_path / "a.parquet", table), ["auto", "q2=-winkel_1:deg"])


def test_every_log_has_its_own_guess(case, tmp_path):
    first = parquet(tmp_path / "a.parquet", degrees(case))
    second = german_excel(tmp_path, case.table)
    one, other = read_logs(case.compiled, [first, second], ["auto"])
    assert one.q == pytest.approx(other.q, abs=1e-9)
    assert other.reading_notes[-1].endswith("(of this log; the model keeps that of the first)")


@pytest.mark.rotating("long tests of logs")
def test_what_is_told_to_be_next_reads_the_log_again(slide, tmp_path, run, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a.txt", "b.txt"):
        shutil.copy(slide / name, name)
    argv = ["fit", "emps", "a.txt", "--map", "auto", "--out", "m.json"]
    status, out, err = run(*argv)
    assert (status, err) == (0, "") and "read with ; between columns, decimal commas" in out
    assert values(tmp_path / "m.json") == pytest.approx(values(slide / "p.json"), rel=1e-7)
    assert load_model("m.json").mapping["q1"] == "Weg [mm]"
    for _ in range(3):  # fit, then compare and diagnose, then what these say
        following = [shlex.split(line[6:]) for line in out.splitlines() if line[:6] == "next: "]
        assert following
        out = ""
        for words in following:
            status, more, err = run(*words[1:])
            assert (status, err) == (0, ""), words
            out += more
    argv = ["add", "m.json", "asymmetric_viscous", slide / "a.txt", "--out", "better.json"]
    assert run(*argv)[0] == 0
    assert load_model("better.json").mapping == load_model("m.json").mapping
    assert run("add", "better.json", "undo", slide / "a.txt", "--out", "u.json")[0] == 0
    assert run("compare", "u.json", slide / "b.parquet")[0] == 0  # our own names serve


LOG = """# mine
[log]  # of last year
time = "t"

[log.names]
1 = "waist"

[drive_gains]
1 = 2.0
"""


def test_the_guess_is_written_into_the_robot_file(slide, tmp_path, run, monkeypatch):
    monkeypatch.chdir(tmp_path)
    before = read_builtin_robot("emps").replace("[drive_gains]", "[x]").split("[x]")[0] + LOG
    (tmp_path / "emps.toml").write_text(before)
    argv = ["log", slide / "a.txt", "--robot", "emps.toml", "--write"]
    status, out, err = run(*argv)
    assert (status, err) == (0, "")
    assert "written: [log] in emps.toml in place of its own" in out
    after = (tmp_path / "emps.toml").read_text()
    assert after.startswith(before.partition("[log]")[0]) and "waist" not in after
    assert parse_robot_text(after, "emps.toml").drive_gains == {"1": 2.0}
    assert run("fit", "emps.toml", slide / "a.txt", "--out", "m.json")[0] == 0
    assert load_model("m.json").mapping == {}


WRITES = [
    (["log", "{a}", "--write"], "--write: needs --robot; give both"),
    (["log", "{a}", "--robot", "emps", "--write"], "--write: emps is built in; save it"),
    (["log", "{a}", "--robot", "arm.par", "--write"], "another program's file"),
]


@pytest.mark.parametrize(("words", "line"), WRITES)
def test_what_cannot_be_written_into_is_one_line(slide, run, words, line):
    status, _, err = run(*[word.format(a=slide / "a.txt") for word in words])
    assert status == 1 and line in err and err.count("\n") == 1


def test_options_stand_in_the_robot_file(slide, tmp_path, run, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = read_builtin_robot("emps") + '\n[fit]\nmethod = "ordinary"\ncutoff = 40\ndecimate = 7\n'
    text += '[diagnose]\nwithout = ["asymmetric_viscous", "spring@1"]\n'
    (tmp_path / "emps.toml").write_text(text)
    log = slide / "a.parquet"
    _, out, err = run("fit", "emps.toml", log, "--out", "m.json")
    said = 'by [fit] of the robot file: method = "ordinary", cutoff = 40, decimate = 7'
    assert said in out + err
    model = load_model("m.json")
    assert model.fit.method == "ordinary"
    assert (model.processing.position_cutoff, model.processing.decimation) == (40, 7)
    run("fit", "emps.toml", log, "--out", "n.json", "--cutoff", "60", "--method=weighted")
    model = load_model("n.json")
    assert (model.fit.method, model.processing.position_cutoff) == ("weighted", 60)
    assert model.processing.decimation == 7
    argv = ["fit", "emps", log, *"--out p.json --method ordinary --cutoff 40 --decimate 7".split()]
    run(*argv)
    assert values(tmp_path / "m.json") == pytest.approx(values(tmp_path / "p.json"), rel=1e-12)
    _, out, err = run("diagnose", "m.json", log, "--json", "d.json")
    assert "by [diagnose] of the robot file" in out + err
    report = json.loads((tmp_path / "d.json").read_text())
    assert "asymmetric_viscous" not in json.dumps(report["effects"])


SECTIONS = [
    ("[fit]\ncutof = 40\n", r"\[fit\]: unknown key \"cutof\" \(did you mean \"?cutoff"),
    ('[fit]\nmethod = "robus"\n', r"\[fit\], method: got \"robus\"; expected .*did you mean"),
    ("[fit]\ncutoff = -1\n", r"\[fit\], cutoff: got -1; expected a number of 0 or more"),
    ("[fit]\ndecimate = 2.5\n", r"\[fit\], decimate: got 2.5; expected a whole number from 1"),
    ("[fit]\ndecimate = true\n", r"\[fit\], decimate: got true; expected a whole number from 1"),
    ("[fit]\nlow_speed = 1.5\n", r"\[fit\], low_speed: got 1.5; expected a share"),
    ("[fit]\nkeep_damaged = 1\n", r"\[fit\], keep_damaged: got 1; expected true or false"),
    ('[diagnose]\nwithout = "spring"\n', r"\[diagnose\], without: got \"spring\"; expected a list"),
    ("[diagnose]\nholdout = 1\n", r"\[diagnose\]: unknown key \"holdout\""),
    ("fit = 1\n", r"\[fit\]: got 1; expected a table"),
]


@pytest.mark.parametrize(("text", "line"), SECTIONS)
def test_a_mistake_in_these_tables_is_one_line(text, line):
    robot = read_builtin_robot("emps")
    text = text + robot if text.startswith("fit =") else f"{robot}\n{text}"
    with pytest.raises(RobotError, match=line) as result:
        parse_robot_text(text, "emps.toml")
    assert "\n" not in str(result.value)


def test_what_a_guess_did_not_find_is_not_sent_to_guess_again(case, tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DataError, match=r"mapping automatic: expected .*, or auto"):
        read_logs(case.compiled, [], ["automatic"])
    rows = "".join(f"{k / 100:.2f};1;2;3;4\n" for k in range(60))
    (tmp_path / "log.csv").write_text(f"zeit;Drehung_Ist A;Drehung_Ist B;tauA;tauB\n{rows}")
    words = ["fit", "two-link", "log.csv", "--out", "model.json"]
    assert "or let it be guessed, --map auto" in run(*words)[2]
    assert "say which it is, --map q1=COLUMN, or add it" in run(*words, "--map", "auto")[2]
