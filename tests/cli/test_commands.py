"""The commands as a user types them: exit status, stdout, stderr, JSON, files."""

import json
import shlex
import shutil
import subprocess
import sys

import pytest

from modeler.cli import main
from modeler.estimation.model_file import checksums


def run(capsys, *argv: str) -> tuple[int, str, str]:
    status = main([str(a) for a in argv])
    out, err = capsys.readouterr()
    return status, out, err


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """Simulated logs of the demonstration arm and a model fitted on two of them."""
    folder = tmp_path_factory.mktemp("arm")
    for name, seed in (("a", 1), ("b", 2), ("held", 3)):
        argv = ["simulate", "demo-arm", "--duration", "8", "--rate", "500", "--seed", seed]
        assert main([*map(str, argv), "--out", str(folder / f"{name}.parquet")]) == 0
    logs = [str(folder / "a.parquet"), str(folder / "b.parquet")]
    assert main(["fit", "demo-arm", *logs, "--out", str(folder / "m.json")]) == 0
    return folder


@pytest.mark.parametrize(
    "argv", [[], ["dance"], ["derive"], ["generate", "wrist"], ["fit", "emps"]]
)
def test_wrong_usage_is_status_2(capsys, argv):
    with pytest.raises(SystemExit) as stop:
        main(argv)
    assert stop.value.code == 2
    assert capsys.readouterr().out == ""


def test_derive_says_what_a_script_reads(capsys, tmp_path):
    status, out, err = run(capsys, "derive", "scara", "--json", tmp_path / "d.json")
    assert (status, err) == (0, "")
    raw = json.loads((tmp_path / "d.json").read_text())
    assert raw["robot"] == "scara" and raw["proof"] == "exact"
    assert raw["rank"] == len(raw["base"]) == sum(raw["counts"].values())
    assert set(raw["counts"]) == {"inertial", "rotor_inertia", "friction", "offset"}
    assert raw["rank_gap"][0] > 1e6 * raw["rank_gap"][1]
    assert raw["newton_euler_against_lagrange"] < 1e-12
    assert raw["base"][0]["terms"][0] == {
        "coefficient": "1", "parameter": raw["base"][0]["column_of"],
    }  # fmt: skip
    for entry in raw["base"]:
        assert f"{entry['name']} = " in out


def test_json_on_stdout_is_only_json(capsys):
    status, out, _ = run(capsys, "derive", "two-link", "--json", "-")
    assert status == 0 and json.loads(out)["robot"] == "two-link"


def test_derive_wrist_prints_all_coefficients(capsys):
    status, out, _ = run(capsys, "derive", "wrist", "--terms")
    assert status == 0
    names = [line.split()[0] for line in out.splitlines() if line[:2] in ("PG", "PJ", "PS", "PX")]
    assert len(names) == 101
    assert "17 base parameters (17 inertial)" in out


@pytest.mark.parametrize(("form", "sign"), [("latex", "\\begin{align}"), ("markdown", "| --- |")])
def test_formats(capsys, form, sign):
    status, out, _ = run(capsys, "derive", "two-link", "--format", form, "--closed-form")
    assert status == 0 and sign in out


def test_closed_forms_and_columns(capsys, tmp_path):
    """Of a robot whose loop is linear relations; the JSON has the same lines."""
    path = tmp_path / "d.json"
    asked = ("--closed-form", "--regressor", "--json", path)
    status, out, err = run(capsys, "derive", "sr400", *asked)
    assert (status, err) == (0, "") and "J66 = ZZ6" in out and "# column of XX2R" in out
    found = json.loads(path.read_text())
    for key, result in (("closed_form", "J66"), ("regressor", "phi6_ZZ6")):
        lines = {d["name"]: d["formula"] for d in found[key]["definitions"] if d["result"]}
        assert f"{result} = {lines[result]}" in out.splitlines()
        assert found[key]["angles"]["2m7"] == "q2 - q7" and found[key]["equation"]


def test_expanded_and_nonzero_forms(capsys):
    _, short, _ = run(capsys, "derive", "two-link", "--closed-form", "--nonzero")
    _, expanded, _ = run(capsys, "derive", "two-link", "--closed-form", "--expanded")
    assert "S112 = -2*L1*k2" not in short and "S112 = -2*L1*MX2*s2" in short
    assert "S112 =\n" in expanded and "k2" not in expanded


@pytest.mark.parametrize("asked", [("--nonzero",), ("--expanded",), ("--nonzero", "--terms")])
def test_options_that_would_do_nothing_are_refused(capsys, asked):
    status, out, err = run(capsys, "derive", "two-link", *asked)
    assert (status, out) == (1, "") and err.count("\n") == 1
    assert err.startswith(f"modeler: {asked[0]} changes nothing by itself; add --closed-form")


def test_nonzero_without_nominal_values_is_refused(capsys):
    status, _, err = run(capsys, "derive", "rx90", "--closed-form", "--nonzero")
    assert status == 1 and err.startswith("modeler: robot rx90: all inertial base parameters are 0")
    assert "state them in [parameters]" in err


def test_effects_may_be_changed_for_a_run(capsys, tmp_path):
    run(capsys, "derive", "puma560", "--effects", "viscous,coulomb", "--json", tmp_path / "d.json")
    counts = json.loads((tmp_path / "d.json").read_text())["counts"]
    assert counts == {"inertial": 36, "rotor_inertia": 0, "friction": 12, "offset": 0}
    status, _, err = run(capsys, "derive", "puma560", "--effects", "viscuous")
    assert status == 1 and err.startswith("modeler: --effects: got viscuous (did you mean")


def test_generate_writes_a_folder(capsys, tmp_path):
    status, out, _ = run(capsys, "generate", "scara", "--out", tmp_path / "c")
    written = {path.name for path in (tmp_path / "c").rglob("*") if path.is_file()}
    assert status == 0
    assert {"scara.c", "scara.h", "manifest.json", "Makefile", "CMakeLists.txt"} <= written
    assert "scara_base_regressor: " in out


def test_generate_leaves_the_files_of_others(capsys, tmp_path):
    (tmp_path / "Makefile").write_text("mine")
    status, out, err = run(capsys, "generate", "emps", "--out", tmp_path)
    assert (status, out) == (1, "") and err.count("\n") == 1
    assert f"{tmp_path}: would write over Makefile, not known" in err and "--force" in err
    assert [path.name for path in tmp_path.iterdir()] == ["Makefile"]
    assert run(capsys, "generate", "emps", "--out", tmp_path, "--force")[0] == 0
    assert (tmp_path / "Makefile").read_text().startswith("# make: static library")
    assert run(capsys, "generate", "emps", "--out", tmp_path)[0] == 0
    (tmp_path / "emps.h").write_text("edited")
    status, _, err = run(capsys, "generate", "emps", "--out", tmp_path)
    assert status == 1 and "over emps.h, edited since an earlier generate" in err


def test_fit_and_compare(capsys, arm):
    status, out, err = run(
        capsys, "compare", arm / "m.json", arm / "held.parquet", "--json", arm / "c.json",
        "--report", arm / "page.html",
    )  # fmt: skip
    assert (status, err) == (0, "")
    raw = json.loads((arm / "c.json").read_text())
    assert set(raw["joints"]) == {"1", "2", "3"}
    for joint in raw["joints"].values():
        assert joint["relative_error"] < 0.01 and {"rms", "max", "r2"} <= set(joint)
        assert joint["explained"] == joint["r2"] and joint["samples"] < 200
        assert joint["systematic"] is joint["floor"] is joint["method"] is None  # too few samples
    assert raw["by_log"][0]["log"] == "held.parquet" and raw["repeated"] == []
    assert "Joint 1: " in out and "repeatable" in out.splitlines()[0]
    assert "<html" in (arm / "page.html").read_text()[:500]


def test_fit_json_and_windows(capsys, arm):
    status, out, _ = run(
        capsys, "fit", "demo-arm", f"{arm / 'a.parquet'}@0:4", f"{arm / 'b.parquet'}@2:",
        "--out", arm / "w.json", "--json", "-", "--method", "ordinary",
    )  # fmt: skip
    raw = json.loads(out)
    assert status == 0 and raw["method"] == "ordinary"
    assert raw["relative_error"] < 0.01 and raw["condition_number"] > 1
    assert {"name", "value", "sigma", "relative_sigma_percent", "essential"} <= set(
        raw["parameters"][0]
    )
    status, out, _ = run(capsys, "compare", arm / "w.json", f"{arm / 'a.parquet'}@4:")
    assert status == 0 and "a.parquet@4:" in out


def training_lines(out: str) -> list[str]:
    return [line for line in out.splitlines() if line.startswith("training only")]


def test_comparing_with_the_training_log_is_told(capsys, arm, tmp_path):
    argv = ("compare", arm / "m.json", arm / "a.parquet", "--report", tmp_path / "p.html")
    _, out, _ = run(capsys, *argv)
    assert training_lines(out) == ["training only: the model was fitted on a.parquet"]
    assert "training only: the model was fitted on a.parquet" in (tmp_path / "p.html").read_text()


def test_training_rows_are_known_by_what_they_hold(capsys, arm, tmp_path):
    renamed = shutil.copy(arm / "a.parquet", tmp_path / "other.parquet")
    for place, name in (
        (f"{arm / 'a.parquet'}@0:3", "a.parquet@0:3"),
        (renamed, "other.parquet"),
        (f"{renamed}@5:", "other.parquet@5:"),
    ):
        _, out, _ = run(capsys, "compare", arm / "m.json", place)
        told = f"training only: the model was fitted on a.parquet, which shares rows with {name}"
        assert training_lines(out) == [told]


def test_a_log_that_is_only_called_like_a_training_log_is_not_one(capsys, arm, tmp_path):
    namesake = shutil.copy(arm / "held.parquet", tmp_path / "a.parquet")
    status, out, _ = run(capsys, "compare", arm / "m.json", namesake)
    assert status == 0 and training_lines(out) == []


def test_only_the_window_that_was_fitted_is_training(capsys, arm, tmp_path):
    log = arm / "a.parquet"
    assert run(capsys, "fit", "demo-arm", f"{log}@0:5", "--out", tmp_path / "m.json")[0] == 0
    _, out, _ = run(capsys, "compare", tmp_path / "m.json", f"{log}@5:")
    assert training_lines(out) == []
    _, out, _ = run(capsys, "compare", tmp_path / "m.json", f"{log}@4:")
    assert len(training_lines(out)) == 1


def test_robots_and_effects(capsys):
    status, out, _ = run(capsys, "robots")
    assert status == 0
    for name in ("wrist", "rx90", "puma560", "scara", "panda", "sr400-tree", "ur10e", "emps"):
        assert f"\n{name} " in f"\n{out}"
    status, out, _ = run(capsys, "robots", "wrist")
    assert 'name = "wrist"' in out
    status, out, _ = run(capsys, "effects", "asymmetric_coulomb")
    assert status == 0 and "offset" in out
    status, _, err = run(capsys, "effects", "stricktion")
    assert status == 1 and "got stricktion (did you mean" in err


def test_wrong_logs_are_told(capsys, arm, tmp_path):
    status, _, err = run(capsys, "compare", arm / "m.json", f"{arm / 'a.parquet'}@900:901")
    assert status == 1 and "no rows from 900 to 901 s; its times go from 0 to 7.998 s" in err
    status, _, err = run(
        capsys, "fit", "demo-arm", arm / "a.parquet", "--payload-mass", "2", "--out", tmp_path / "m"
    )
    assert status == 1 and "--payload-mass: no loaded log" in err


def test_a_row_counts_once(capsys, arm, tmp_path, monkeypatch):
    monkeypatch.chdir(arm)
    copy = shutil.copy("a.parquet", tmp_path / "copy.parquet")
    for first, again in (
        ("a.parquet", "a.parquet"),
        ("a.parquet", "./a.parquet"),
        ("a.parquet", "a.parquet@0:3"),
        ("a.parquet@0:4", "a.parquet@3:"),
        ("a.parquet", str(copy)),
    ):
        argv = ("fit", "demo-arm", "b.parquet", first, again, "--out", tmp_path / "m")
        status, _, err = run(capsys, *argv)
        assert status == 1 and f"{again}: got rows of {first} again; rows that repeat" in err
    argv = ("fit", "demo-arm", "a.parquet", "--payload-log", "./a.parquet")
    status, _, err = run(capsys, *argv, "--out", tmp_path / "m")
    assert status == 1 and "./a.parquet: got rows of a.parquet again" in err


def test_a_row_is_compared_once(capsys, arm):
    place = arm / "held.parquet"
    status, _, err = run(capsys, "compare", arm / "m.json", place, f"{place}@2:4")
    assert status == 1 and err.count("\n") == 1
    assert f"{place}@2:4: got rows of {place} again; rows that repeat count twice" in err


def test_errors_of_several_logs(capsys, arm):
    logs = [arm / "held.parquet", arm / "b.parquet"]
    argv = ("compare", arm / "m.json", *logs, "--json", arm / "several.json")
    status, out, _ = run(capsys, *argv)
    assert status == 0
    for joint in json.loads((arm / "several.json").read_text())["joints"].values():
        parts = [joint[name] for name in ("explained", "systematic", "floor")]
        assert sum(parts) == pytest.approx(1.0) and joint["method"] == "smooth"
    table = out.splitlines()
    start = next(k for k, line in enumerate(table) if line.startswith("log "))
    assert table[start].split() == ["log", "samples", "error", "joint", "1", "joint", "2", "joint",
                                    "3"]  # fmt: skip
    assert [line.split()[0] for line in table[start + 1 : start + 3]] == [log.name for log in logs]


def test_a_cutoff_above_nyquist_is_one_line(capsys, arm, tmp_path):
    """Logs at 500 Hz; then a log that is too slow for the filter of the model."""
    argv = ("fit", "demo-arm", arm / "a.parquet", "--cutoff", "250", "--out", tmp_path / "m.json")
    status, _, err = run(capsys, *argv)
    assert status == 1 and err.count("\n") == 1 and not (tmp_path / "m.json").exists()
    assert "a.parquet: position filter (--cutoff) of 250 Hz on a log sampled at 500 Hz" in err
    slow = tmp_path / "slow.csv"
    argv = ("simulate", "demo-arm", "--duration", "8", "--rate", "50", "--seed", "3", "--out", slow)
    assert run(capsys, *argv)[0] == 0
    for command in ("compare", "diagnose"):
        status, _, err = run(capsys, command, arm / "m.json", slow)
        assert status == 1 and err.count("\n") == 1
        assert "slow.csv: position filter" in err and "Nyquist frequency of 25 Hz" in err


def test_bare_and_loaded_logs_have_names_of_their_own(capsys, arm, tmp_path):
    loaded = shutil.copy(arm / "b.parquet", tmp_path / "a.parquet")
    argv = ("fit", "demo-arm", arm / "a.parquet", "--payload-log", loaded)
    status, _, err = run(capsys, *argv, "--out", tmp_path / "m")
    assert status == 1 and f"{loaded}: carries the load, and {arm / 'a.parquet'} has" in err


def test_effects_can_be_left_out_of_a_robot_with_values_for_them(capsys):
    status, out, err = run(capsys, "derive", "demo-arm", "--effects", "viscous", "--no-terms")
    assert (status, err) == (0, "")
    assert "Fv3" in out and "Fs3" not in out and "Off3" not in out and "Ia3" not in out


NO_CLOSED_FORM = """\
name = "arm"
title = "second joint at a length that is no polynomial"
gravity = ["-g", 0, 0]
[symbols]
g = 9.81
L = 0.40
[mdh]
columns = ["j", "a", "sigma", "d", "theta"]
rows = [
          ["1", "0",  0,       0,  "q1"],
          ["2", "1",  0, "sqrt(L)", "q2"],
]
"""


def test_coefficients_that_nobody_asked_for_are_no_error(capsys, tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text(NO_CLOSED_FORM)
    status, out, err = run(capsys, "derive", path, "--json", tmp_path / "d.json")
    assert (status, err) == (0, "")
    assert "ZZ1R = " in out and "no coefficients: got sqrt(L) in the table; closed forms" in out
    assert json.loads((tmp_path / "d.json").read_text())["robot"] == "arm"
    for asked in (("--terms",), ("--coefficients-out", tmp_path / "page.md")):
        status, _, err = run(capsys, "derive", path, *asked)
        assert status == 1 and err.startswith("modeler: got sqrt(L) in the table")
    assert not (tmp_path / "page.md").exists()


def test_the_c_in_a_model_file_runs_only_when_asked(capsys, arm, tmp_path):
    """A model file may be mailed: its robot text is derived anew, its C is not run."""
    raw = json.loads((arm / "m.json").read_text())
    raw["sources"] = {
        name: "#error not to be compiled\n" if name.endswith(".c") else text
        for name, text in raw["sources"].items()
    }
    write_sealed(tmp_path / "mailed.json", raw)
    status, _, err = run(capsys, "compare", tmp_path / "mailed.json", arm / "held.parquet")
    assert (status, err) == (0, "")
    status, _, err = run(
        capsys, "compare", tmp_path / "mailed.json", arm / "held.parquet", "--run-embedded-c"
    )
    assert status == 1 and "not to be compiled" in err


def write_sealed(place, raw):
    """A model file whose checksums fit, as one has it who wants to deceive."""
    place.write_text(json.dumps({**raw, "checksums": checksums(raw)}))


@pytest.mark.parametrize(("old", "new"), [("D3 = ", "D3 = 1"), ('"-g"', "-1.62"), ('"D3"', "0.35")])
def test_another_robot_text_is_not_taken_for_the_fitted_one(capsys, arm, tmp_path, old, new):
    """Gravity of the moon, or a length as a number in the table: the manifest is the same."""
    raw = json.loads((arm / "m.json").read_text())
    assert old in raw["robot_text"]
    raw["robot_text"] = raw["robot_text"].replace(old, new)
    place = tmp_path / "mailed.json"
    place.write_text(json.dumps(raw))
    status, _, err = run(capsys, "compare", place, arm / "held.parquet")
    assert status == 1 and "the checksum does not fit: robot_text (the robot file" in err
    write_sealed(place, raw)
    status, _, err = run(capsys, "compare", place, arm / "held.parquet")
    assert status == 1 and "made by another version of modeler, or changed since" in err


def test_a_reader_that_stops_is_no_error():
    command = f"{shlex.quote(sys.executable)} -m modeler derive wrist | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert done.stdout.startswith("wrist: ") and done.stderr == ""


@pytest.mark.parametrize(
    ("window", "piece"),
    [
        ("@5", "got @5 after the file; expected @START:END in seconds"),
        ("@a:b", "got @a:b after the file"),
        ("@5:2", "got the window 5:2, which ends before it starts"),
    ],
)
def test_windows_that_are_none(capsys, arm, window, piece):
    status, _, err = run(capsys, "compare", arm / "m.json", f"{arm / 'a.parquet'}{window}")
    assert status == 1 and piece in err
