"""The commands as a user types them: exit status, stdout, stderr, JSON, files."""

import json
import shutil

import pytest

from modeler.estimation.model_file import compute_checksums
from tests.cli.running import answer, complaint, refusal
from tests.rotation import with_cases


def test_derive_says_what_a_script_reads(capsys, tmp_path):
    out = answer(capsys, "derive", "scara", "--json", tmp_path / "d.json")
    raw = json.loads((tmp_path / "d.json").read_text())
    assert raw["robot"] == "scara" and raw["proof"] == "exact"
    assert raw["rank"] == len(raw["base"]) == sum(raw["counts"].values())
    assert set(raw["counts"]) == {"inertial", "rotor_inertia", "friction", "offset"}
    assert raw["rank_gap"][0] > 1e6 * raw["rank_gap"][1]
    assert raw["newton_euler_against_lagrange"] < 1e-12
    first = raw["base"][0]
    assert first["terms"][0] == {"coefficient": "1", "parameter": first["column_of"]}
    for entry in raw["base"]:
        assert f"{entry['name']} = " in out


def test_closed_forms_and_columns(capsys, tmp_path):
    """Of a robot whose loop is linear relations; the JSON has the same lines."""
    path = tmp_path / "d.json"
    out = answer(capsys, "derive", "sr400", "--closed-form", "--regressor", "--json", path)
    assert "J66 = ZZ6" in out and "# column of XX2R" in out
    data = json.loads(path.read_text())
    for key, result in (("closed_form", "J66"), ("regressor", "phi6_ZZ6")):
        lines = {d["name"]: d["formula"] for d in data[key]["definitions"] if d["result"]}
        assert f"{result} = {lines[result]}" in out.splitlines()
        assert data[key]["angles"]["2m7"] == "q2 - q7" and data[key]["equation"]


@with_cases(
    "options, shown",
    ("--format latex", "\\begin{align}"),
    ("--format markdown", "| --- |"),
    ("--expanded", "S112 =\n"),
    ("--nonzero", "S112 = -2*L1*MX2*s2"),
)
def test_forms_of_closed_forms(capsys, options, shown):
    assert shown in answer(capsys, "derive", "two-link", "--closed-form", *options.split())


def test_effects_are_shown(capsys):
    out = answer(capsys, "effects", "asymmetric_coulomb")
    assert "offset" in out
    assert "got stricktion (did you mean" in refusal(capsys, "effects", "stricktion")


@pytest.mark.parametrize("asked", [("--nonzero",), ("--expanded",), ("--nonzero", "--terms")])
def test_options_that_would_do_nothing_are_refused(capsys, asked):
    err = refusal(capsys, "derive", "two-link", *asked)
    assert err.startswith(f"modeler: {asked[0]}: needs --closed-form or --")


@pytest.mark.rotating("long tests of cli")
def test_fit_and_compare(capsys, two_link, tmp_path):
    out = answer(
        capsys,
        "compare",
        two_link / "m.json",
        two_link / "held.parquet",
        "--json",
        tmp_path / "c.json",
        "--report",
        tmp_path / "page.html",
    )
    raw = json.loads((tmp_path / "c.json").read_text())
    assert set(raw["joints"]) == {"1", "2"}
    for joint in raw["joints"].values():
        assert joint["relative_error"] < 0.01 and {"rms", "max", "r2"} <= set(joint)
        assert joint["explained_share"] == joint["r2"] and joint["samples"] < 200
        assert (
            joint["systematic_share"] is joint["noise_share"] is joint["method"] is None
        )  # too few samples
    assert raw["by_log"][0]["log"] == "held.parquet" and raw["repeated_motions"] == []
    assert "Joint 1: " in out and "repeatable" in out.splitlines()[0]
    assert "<html" in (tmp_path / "page.html").read_text()[:500]


@pytest.mark.rotating("long tests of cli")
def test_fit_json_and_windows(capsys, two_link, tmp_path):
    out = answer(
        capsys,
        "fit",
        "two-link",
        f"{two_link / 'a.parquet'}@0:4",
        f"{two_link / 'b.parquet'}@2:",
        "--out",
        tmp_path / "w.json",
        *"--json - --method ordinary".split(),
    )
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


def training_lines(out: str) -> list[str]:
    return [line for line in out.splitlines() if line.startswith("training only")]


def test_training_rows_are_known_by_what_they_hold(capsys, two_link, tmp_path):
    """Not by the name of their file; the page says so too."""
    model, log, page = two_link / "m.json", two_link / "a.parquet", tmp_path / "p.html"
    line = "training only: the model was fitted on a.parquet"
    assert training_lines(answer(capsys, "compare", model, log, "--report", page)) == [line]
    assert line in page.read_text()
    renamed = shutil.copy(log, tmp_path / "other.parquet")
    shared = training_lines(answer(capsys, "compare", model, f"{renamed}@5:"))
    assert shared == [f"{line}, which shares rows with other.parquet@5:"]
    namesake = shutil.copy(two_link / "held.parquet", tmp_path / "a.parquet")
    assert training_lines(answer(capsys, "compare", model, namesake)) == []


def test_a_row_counts_once(capsys, two_link, tmp_path, monkeypatch):
    monkeypatch.chdir(two_link)
    fit = ("fit", "two-link", "a.parquet", "--out", tmp_path / "m")
    loaded = shutil.copy("b.parquet", tmp_path / "a.parquet")
    again = "got rows of a.parquet again; rows that repeat"
    for words, message in (
        (("./a.parquet",), f"./a.parquet: {again}"),
        (("a.parquet@3:",), f"a.parquet@3:: {again}"),
        (("--payload-log", "./a.parquet"), "./a.parquet: got rows of a.parquet again"),
        (("--payload-log", loaded), "carries the load, and a.parquet has"),
        (("--payload-mass", "2"), "name it with --payload-log LOG"),
    ):
        assert message in refusal(capsys, *fit, *words)
    err = refusal(capsys, "compare", "m.json", "held.parquet", "held.parquet@2:4")
    assert "held.parquet@2:4: got rows of held.parquet again; rows that repeat count twice" in err


@pytest.mark.parametrize(("old", "new"), [("9.81", "1.62"), ('"L1"', "0.4")])
def test_a_model_file_that_was_sealed_again_is_not_believed(capsys, two_link, tmp_path, old, new):
    """Its C is not run unasked; gravity of the moon, or a length as a number, is noticed."""
    raw = json.loads((two_link / "m.json").read_text())
    place = tmp_path / "mailed.json"
    words = ("compare", place, two_link / "held.parquet")

    def seal(**changes) -> None:
        content = raw | changes
        place.write_text(json.dumps({**content, "checksums": compute_checksums(content)}))

    seal(sources={n: "#error\n" if n.endswith(".c") else t for n, t in raw["sources"].items()})
    answer(capsys, *words)
    assert "#error" in refusal(capsys, *words, "--run-embedded-c")
    seal(robot_text=raw["robot_text"].replace(old, new))
    err = refusal(capsys, *words)
    assert "made by another version of modeler, or changed since" in err
