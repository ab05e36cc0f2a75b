"""The commands as a user types them: exit status, stdout, stderr, JSON, files."""

import json
import shutil

import pytest

from modeler.estimation.model_file import checksums
from tests.cli.running import answer, complaint, refusal, run


def test_derive_says_what_a_script_reads(capsys, tmp_path):
    out = answer(capsys, "derive", "scara", "--json", tmp_path / "d.json")
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


def test_derive_wrist_prints_all_coefficients(capsys):
    out = answer(capsys, "derive", "wrist", "--terms")
    names = [line.split()[0] for line in out.splitlines() if line[:2] in ("PG", "PJ", "PS", "PX")]
    assert len(names) == 101
    assert "17 base parameters (17 inertial)" in out


@pytest.mark.parametrize(("form", "sign"), [("latex", "\\begin{align}"), ("markdown", "| --- |")])
def test_formats(capsys, form, sign):
    assert sign in answer(capsys, "derive", "two-link", "--format", form, "--closed-form")


def test_closed_forms_and_columns(capsys, tmp_path):
    """Of a robot whose loop is linear relations; the JSON has the same lines."""
    path = tmp_path / "d.json"
    out = answer(capsys, "derive", "sr400", "--closed-form", "--regressor", "--json", path)
    assert "J66 = ZZ6" in out and "# column of XX2R" in out
    found = json.loads(path.read_text())
    for key, result in (("closed_form", "J66"), ("regressor", "phi6_ZZ6")):
        lines = {d["name"]: d["formula"] for d in found[key]["definitions"] if d["result"]}
        assert f"{result} = {lines[result]}" in out.splitlines()
        assert found[key]["angles"]["2m7"] == "q2 - q7" and found[key]["equation"]


def test_expanded_and_nonzero_forms(capsys):
    short = answer(capsys, "derive", "two-link", "--closed-form", "--nonzero")
    expanded = answer(capsys, "derive", "two-link", "--closed-form", "--expanded")
    assert "S112 = -2*L1*k2" not in short and "S112 = -2*L1*MX2*s2" in short
    assert "S112 =\n" in expanded and "k2" not in expanded


@pytest.mark.parametrize("asked", [("--nonzero",), ("--expanded",), ("--nonzero", "--terms")])
def test_options_that_would_do_nothing_are_refused(capsys, asked):
    err = refusal(capsys, "derive", "two-link", *asked)
    assert err.startswith(f"modeler: {asked[0]} changes nothing by itself; add --closed-form")


def test_nonzero_without_nominal_values_is_refused(capsys):
    err = complaint(capsys, "derive", "rx90", "--closed-form", "--nonzero")
    assert err.startswith("modeler: robot rx90: all inertial base parameters are 0")
    assert "state them in [parameters]" in err


def test_effects_may_be_changed_for_a_run(capsys, tmp_path):
    run(capsys, "derive", "puma560", "--effects", "viscous,coulomb", "--json", tmp_path / "d.json")
    counts = json.loads((tmp_path / "d.json").read_text())["counts"]
    assert counts == {"inertial": 36, "rotor_inertia": 0, "friction": 12, "offset": 0}
    err = refusal(capsys, "derive", "puma560", "--effects", "viscuous")
    assert err.startswith("modeler: --effects: got viscuous (did you mean")


def test_generate_leaves_the_files_of_others(capsys, tmp_path):
    (tmp_path / "Makefile").write_text("mine")
    err = refusal(capsys, "generate", "emps", "--out", tmp_path)
    assert f"{tmp_path}: would write over Makefile, not known" in err and "--force" in err
    assert [path.name for path in tmp_path.iterdir()] == ["Makefile"]
    assert "emps_base_regressor: " in answer(
        capsys, "generate", "emps", "--out", tmp_path, "--force"
    )
    assert (tmp_path / "Makefile").read_text().startswith("# make: static library")
    answer(capsys, "generate", "emps", "--out", tmp_path)
    (tmp_path / "emps.h").write_text("edited")
    err = refusal(capsys, "generate", "emps", "--out", tmp_path)
    assert "over emps.h, edited since an earlier generate" in err


@pytest.mark.rotating("long tests of cli")
def test_fit_and_compare(capsys, two_link, tmp_path):
    out = answer(
        capsys, "compare", two_link / "m.json", two_link / "held.parquet",
        "--json", tmp_path / "c.json", "--report", tmp_path / "page.html",
    )  # fmt: skip
    raw = json.loads((tmp_path / "c.json").read_text())
    assert set(raw["joints"]) == {"1", "2"}
    for joint in raw["joints"].values():
        assert joint["relative_error"] < 0.01 and {"rms", "max", "r2"} <= set(joint)
        assert joint["explained"] == joint["r2"] and joint["samples"] < 200
        assert joint["systematic"] is joint["floor"] is joint["method"] is None  # too few samples
    assert raw["by_log"][0]["log"] == "held.parquet" and raw["repeated"] == []
    assert "Joint 1: " in out and "repeatable" in out.splitlines()[0]
    assert "<html" in (tmp_path / "page.html").read_text()[:500]


@pytest.mark.rotating("long tests of cli")
def test_fit_json_and_windows(capsys, two_link, tmp_path):
    out = answer(
        capsys, "fit", "two-link", f"{two_link / 'a.parquet'}@0:4", f"{two_link / 'b.parquet'}@2:",
        "--out", tmp_path / "w.json", "--json", "-", "--method", "ordinary",
    )  # fmt: skip
    raw = json.loads(out)
    assert raw["method"] == "ordinary"
    assert raw["relative_error"] < 0.01 and raw["condition_number"] > 1
    assert {"name", "value", "sigma", "relative_sigma_percent", "essential"} <= set(
        raw["parameters"][0]
    )
    # Only the window that was fitted is training.
    for window, training in (("@4:", 0), ("@3:", 1)):
        out = answer(capsys, "compare", tmp_path / "w.json", f"{two_link / 'a.parquet'}{window}")
        assert f"a.parquet{window}" in out and len(training_lines(out)) == training


def training_lines(out: str) -> list[str]:
    return [line for line in out.splitlines() if line.startswith("training only")]


def test_training_rows_are_known_by_what_they_hold(capsys, two_link, tmp_path):
    """Not by the name of their file; the page says so too."""
    model, log, page = two_link / "m.json", two_link / "a.parquet", tmp_path / "p.html"
    told = "training only: the model was fitted on a.parquet"
    assert training_lines(answer(capsys, "compare", model, log, "--report", page)) == [told]
    assert told in page.read_text()
    renamed = shutil.copy(log, tmp_path / "other.parquet")
    for place, name in ((f"{log}@0:3", "a.parquet@0:3"), (f"{renamed}@5:", "other.parquet@5:")):
        shared = training_lines(answer(capsys, "compare", model, place))
        assert shared == [f"{told}, which shares rows with {name}"]
    namesake = shutil.copy(two_link / "held.parquet", tmp_path / "a.parquet")
    assert training_lines(answer(capsys, "compare", model, namesake)) == []


def test_robots_and_effects(capsys):
    out = answer(capsys, "robots")
    for name in ("wrist", "rx90", "puma560", "scara", "panda", "sr400-tree", "ur10e", "emps"):
        assert f"\n{name} " in f"\n{out}"
    assert 'name = "wrist"' in answer(capsys, "robots", "wrist")
    assert "offset" in answer(capsys, "effects", "asymmetric_coulomb")
    assert "got stricktion (did you mean" in refusal(capsys, "effects", "stricktion")


def test_a_row_counts_once(capsys, two_link, tmp_path, monkeypatch):
    monkeypatch.chdir(two_link)
    copy = shutil.copy("a.parquet", tmp_path / "copy.parquet")
    out = ("--out", tmp_path / "m")
    for first, again in (
        ("a.parquet", "./a.parquet"), ("a.parquet@0:4", "a.parquet@3:"), ("a.parquet", str(copy)),
    ):  # fmt: skip
        err = refusal(capsys, "fit", "two-link", "b.parquet", first, again, *out)
        assert f"{again}: got rows of {first} again; rows that repeat" in err
    err = refusal(capsys, "compare", "m.json", "held.parquet", "held.parquet@2:4")
    assert "held.parquet@2:4: got rows of held.parquet again; rows that repeat count twice" in err
    for loaded, told in (
        ("./a.parquet", "./a.parquet: got rows of a.parquet again"),
        (shutil.copy("b.parquet", tmp_path / "a.parquet"), "carries the load, and a.parquet has"),
    ):
        assert told in refusal(
            capsys, "fit", "two-link", "a.parquet", "--payload-log", loaded, *out
        )
    err = refusal(capsys, "fit", "two-link", "a.parquet", "--payload-mass", "2", *out)
    assert "--payload-mass: no loaded log" in err


def test_errors_of_several_logs(capsys, two_link, tmp_path):
    logs = [two_link / "held.parquet", two_link / "b.parquet"]
    out = answer(capsys, "compare", two_link / "m.json", *logs, "--json", tmp_path / "several")
    for joint in json.loads((tmp_path / "several").read_text())["joints"].values():
        parts = [joint[name] for name in ("explained", "systematic", "floor")]
        assert sum(parts) == pytest.approx(1.0) and joint["method"] == "smooth"
    table = out.splitlines()
    start = next(k for k, line in enumerate(table) if line.startswith("log "))
    assert table[start].split() == ["log", "samples", "error", "joint", "1", "joint", "2"]
    assert [line.split()[0] for line in table[start + 1 : start + 3]] == [log.name for log in logs]


def test_a_cutoff_above_nyquist_is_one_line(capsys, two_link, tmp_path):
    """Logs at 200 Hz; then a log that is too slow for the filter of the model."""
    log, model = two_link / "a.parquet", tmp_path / "m.json"
    err = refusal(capsys, "fit", "two-link", log, "--cutoff", "100", "--out", model)
    assert not model.exists()
    assert "a.parquet: position filter (--cutoff) of 100 Hz on a log sampled at 200 Hz" in err
    answer(capsys, "fit", "two-link", log, "--cutoff", "60", "--out", model)
    slow = tmp_path / "slow.csv"
    answer(capsys, "simulate", "two-link", "--duration", "8", "--rate", "50", "--out", slow)
    for command in ("compare", "diagnose"):
        err = refusal(capsys, command, model, slow)
        assert "slow.csv: position filter" in err and "Nyquist frequency of 25 Hz" in err


NO_CLOSED_FORM = """\
name = "arm"
gravity = [-9.81, 0, 0]
[symbols]
L = 0.40
[mdh]
columns = ["j", "a", "d", "theta"]
rows = [["1", "0", 0, "q1"], ["2", "1", "sqrt(L)", "q2"]]
"""


def test_coefficients_that_nobody_asked_for_are_no_error(capsys, tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text(NO_CLOSED_FORM)
    out = answer(capsys, "derive", path, "--json", tmp_path / "d.json")
    assert "ZZ1R = " in out and "no coefficients: got sqrt(L) in the table; closed forms" in out
    assert json.loads((tmp_path / "d.json").read_text())["robot"] == "arm"
    for asked in (("--terms",), ("--coefficients-out", tmp_path / "page.md")):
        err = complaint(capsys, "derive", path, *asked)
        assert err.startswith("modeler: got sqrt(L) in the table")
    assert not (tmp_path / "page.md").exists()


def write_sealed(place, raw):
    """A model file whose checksums fit, as one has it who wants to deceive."""
    place.write_text(json.dumps({**raw, "checksums": checksums(raw)}))


def test_the_c_in_a_model_file_runs_only_when_asked(capsys, two_link, tmp_path):
    """A model file may be mailed: its robot text is derived anew, its C is not run."""
    raw = json.loads((two_link / "m.json").read_text())
    raw["sources"] = {
        name: "#error not to be compiled\n" if name.endswith(".c") else text
        for name, text in raw["sources"].items()
    }
    write_sealed(tmp_path / "mailed.json", raw)
    words = ("compare", tmp_path / "mailed.json", two_link / "held.parquet")
    answer(capsys, *words)
    assert "not to be compiled" in refusal(capsys, *words, "--run-embedded-c")


@pytest.mark.parametrize(("old", "new"), [("9.81", "1.62"), ('"L1"', "0.4")])
def test_another_robot_text_is_not_taken_for_the_fitted_one(capsys, two_link, tmp_path, old, new):
    """Gravity of the moon, or a length as a number in the table: the manifest is the same."""
    raw = json.loads((two_link / "m.json").read_text())
    assert old in raw["robot_text"]
    raw["robot_text"] = raw["robot_text"].replace(old, new)
    place = tmp_path / "mailed.json"
    place.write_text(json.dumps(raw))
    err = refusal(capsys, "compare", place, two_link / "held.parquet")
    assert "the checksum does not fit: robot_text (the robot file" in err
    write_sealed(place, raw)
    err = refusal(capsys, "compare", place, two_link / "held.parquet")
    assert "made by another version of modeler, or changed since" in err
