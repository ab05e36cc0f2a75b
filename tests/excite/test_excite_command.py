"""`modeler excite`, and `modeler simulate --motion FILE`, as a user types them."""

import json

import numpy as np
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
import pytest

from modeler.cli import main
from modeler.simulation import read_motion, resample_motion


def run(capsys, *argv) -> tuple[int, str, str]:
    status = main([str(word) for word in argv])
    out, err = capsys.readouterr()
    return status, out, err


def refused(capsys, *argv) -> str:
    status, _, err = run(capsys, *argv)
    assert status == 1 and err.count("\n") == 1, err
    return err


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A motion of the demonstration arm, a log along it, a model fitted to that."""
    place = tmp_path_factory.mktemp("excite")
    for words in (
        f"excite demo-arm --duration 6 --starts 1 --out {place}/motion.csv "
        f"--json {place}/motion.json",
        f"simulate demo-arm --motion {place}/motion.csv --rate 500 --noise 0.05 "
        f"--out {place}/log.parquet",
        f"fit demo-arm {place}/log.parquet --out {place}/m.json",
    ):
        assert main(words.split()) == 0
    return place


@pytest.mark.rotating("long tests of excite")
def test_what_is_written_is_the_motion_and_what_it_uses(folder):
    raw = json.loads((folder / "motion.json").read_text())
    table = pacsv.read_csv(folder / "motion.csv")
    assert table.column_names == ["time", *(f"{p}{j}" for p in ("q", "qd", "qdd") for j in "123")]
    assert raw["condition_scaled"] < raw["random_motions"]["condition_scaled_best"]
    for name, joint in raw["joints"].items():
        q = table[f"q{name}"].to_numpy()
        assert q.max() == pytest.approx(joint["upper"]["value"], abs=1e-3)
        assert joint["lower"]["slack"] > 0 and joint["speed"]["slack"] > 0
        waves = raw["series"]["coefficients"][name]
        phase = np.outer(table["time"].to_numpy(), np.arange(1, len(waves["cos"]) + 1))
        phase = 2 * np.pi * phase / raw["series"]["period"]
        again = waves["constant"] + np.cos(phase) @ waves["cos"] + np.sin(phase) @ waves["sin"]
        assert np.allclose(again, q, atol=1e-9)
        assert abs(table[f"qd{name}"][0].as_py()) == 0.0


def test_a_log_is_a_motion_by_its_commands(folder):
    motion = read_motion(folder / "log.parquet", ["1", "2", "3"])
    exact = read_motion(folder / "motion.csv", ["1", "2", "3"])
    there = resample_motion(exact, 500.0)
    assert np.allclose(motion.q, there.q, atol=1e-7)
    inner = slice(20, -20)
    assert np.allclose(motion.qdd[inner], there.qdd[inner], atol=2e-3)


def test_a_model_is_excited_in_its_essential_parameters(capsys, folder, tmp_path):
    model = json.loads((folder / "m.json").read_text())
    essential = [p["name"] for p in model["fit"]["parameters"] if p["essential"]]
    words = f"--duration 4 --starts 1 --laps 2 --limit 2=-0.6,2.4,2,8,60 --out {tmp_path}/m.parquet"
    status, _, err = run(
        capsys, "excite", folder / "m.json", *words.split(), "--json", tmp_path / "j"
    )
    assert (status, err) == (0, "")
    raw = json.loads((tmp_path / "j").read_text())
    assert raw["parameters"] == essential
    assert 0 < raw["joints"]["2"]["torque"]["value"] < 60
    assert raw["joints"]["1"]["torque"]["limit"] is None
    table = pq.read_table(tmp_path / "m.parquet")
    q = table["q1"].to_numpy()
    assert len(q) == 1601 and np.allclose(q[:800], q[800:1600]) and q[0] == q[-1]


@pytest.mark.rotating("long tests of excite")
def test_two_effects_are_told_apart_better_than_by_chance(capsys, folder, tmp_path):
    status, out, err = run(
        capsys,
        *f"""
            excite {folder}/m.json --duration 4 --harmonics 3 --starts 1 --between
            load_friction@2,position_friction@2 --out {tmp_path}/b.csv --json {tmp_path}/b.json
        """.split(),
    )
    assert (status, err) == (0, "") and "load_friction@2" in out
    result = json.loads((tmp_path / "b.json").read_text())["discrimination"]
    gains = [effect["gain"] for effect in result.values()]
    assert np.sqrt(np.prod(gains)) > 1.15 and min(gains) > 0.9
    assert all(0 < effect["unexplained_share"] <= 1 for effect in result.values())


def test_the_best_of_given_motions_is_chosen(capsys, folder, tmp_path):
    logs = [folder / "motion.csv", tmp_path / "short.parquet"]
    words = ("simulate", "demo-arm", "--duration", 2, "--rate", 200, "--out", logs[1])
    assert run(capsys, *words)[0] == 0
    words = ("excite", "demo-arm", "--choose", 1, "--json", tmp_path / "c")
    words = (*words, "--from", logs[0], "--from", logs[1])
    assert run(capsys, *words)[0] == 0
    raw = json.loads((tmp_path / "c").read_text())
    assert raw["chosen_motions"] == [str(logs[0])]
    assert raw["condition_scaled"] == min(raw["single_conditions"])


@pytest.mark.rotating("long tests of excite")
def test_the_motion_that_a_fit_asks_for_determines_the_joint_that_rested(
    capsys, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    time = np.arange(0.0, 12.0, 0.01)
    swing = np.sin(np.pi * time / 12.0) ** 2 * (np.sin(3.0 * time) + 0.5 * np.sin(7.0 * time))
    columns = np.column_stack([time, 0.0 * time, swing])
    np.savetxt("rest.csv", columns, "%.9g", ",", header="time,q1,q2", comments="")

    def record_log(motion, log):
        words = ("--rate", 250, "--noise", 0.01, "--out", log)
        assert run(capsys, "simulate", "two-link", "--motion", motion, *words)[0] == 0

    record_log("rest.csv", "rest.parquet")
    _, out, _ = run(capsys, "fit", "two-link", "rest.parquet", "--out", "m.json")
    *_, verdict, following = out.splitlines()
    assert verdict.startswith("Valid for prediction on joint 2; joint 1 ")
    assert "too little motion in these logs; record the motion of `modeler excite`. " in verdict
    assert following == "next: modeler excite m.json --from rest.parquet --out m-motion.csv"
    assert run(capsys, *following.split()[2:])[0] == 0
    record_log("m-motion.csv", "b.parquet")
    words = ("--out", "m2.json", "--json", "m2.fit.json")
    assert run(capsys, "fit", "two-link", "rest.parquet", "b.parquet", *words)[0] == 0
    result = json.loads((tmp_path / "m2.fit.json").read_text())
    assert {joint["state"] for joint in result["joints"].values()} == {"good"}


OF_A_ROBOT = {
    "--limit 1=1,-1,2,8": "lower 1.0, upper -1.0",
    "--limit 1=-1,1,0,8": "speed 0.0",
    "--limit 1=-1,1,2,-8": "acceleration -8.0",
    "--limit 1=-1,1,2": "LOWER,UPPER,SPEED,ACCELERATION",
    "--limit 1=-1,1,2,nan": "nan",
    "--limit 1=-1,1,2,x": "numbers",
    "--limit 9=-1,1,2,8": "no moving joint 9",
    "--box 3=0,1,0,1": "X0,X1",
    "--box 3=1,0,0,1,0,1": "lower < upper",
    "--box 3=5,6,0,1,0,1": "no posture was found",
    "--duration nan": "duration",
    "--harmonics 1": "harmonics: got 1",
    "--starts 0": "starts: got 0",
    "--seed -1": "seed: got -1",
    "--laps 0": "laps: got 0",
    "--rate 0": "--rate: got 0",
    "--time-limit 0": "time limit",
    "--picture p.bmp": ".png, .svg or .pdf",
    "--choose 1": "--choose: needs --from; give both",
    "--choose 1 --from a.csv": "--out: got it with --choose; leave one",
    "--between stribeck@2,spring@2": "has no values",
    "--between stribeck@2,spring@2 --from a.csv": "--from: got it with --between",
    "--check a.csv": "--out: got it with --check; leave one",
    "--report p.html": "--report: no two links are looked at",
    "--clearance -1": "clearance: got -1 m; expected 0 or more",
    "--position-noise 1e-4": "--position-noise: demo-arm: sigmas follow from",
}
OF_A_MODEL = {
    "--between stribek@2,spring@2": "no such effect",
    "--between stribeck@9,spring@2": "got joint 9",
    "--between stribeck@2": "expected two effects",
    "--between coulomb@2,spring@2": "has coulomb on joint 2 already",
    "--between stribeck@2,payload@2": "no torque of one joint",
    "--limit 2=-0.6,2.4,2,8,0.01": "no posture was found",
    "--limit 2=-0.6,2.4,2,8,0": "torque 0",
    "--effects viscous": "of a robot file only",
}


@pytest.mark.parametrize(
    ("model", "words"),
    [(model, words) for model in (False, True) for words in (OF_A_MODEL if model else OF_A_ROBOT)],
)
def test_one_line_for_what_cannot_be(capsys, folder, tmp_path, monkeypatch, model, words):
    monkeypatch.chdir(tmp_path)
    what = folder / "m.json" if model else "demo-arm"
    line = refused(capsys, "excite", what, *words.split(), "--out", "m.csv")
    assert (OF_A_MODEL if model else OF_A_ROBOT)[words] in line
    assert not (tmp_path / "m.csv").exists()


@pytest.mark.rotating("long tests of excite")
def test_sigmas_of_a_model_are_forecast(capsys, folder, tmp_path):
    words = ("--duration", 3, "--starts", 1, "--rate", 500, "--out", tmp_path / "m.csv")
    page = tmp_path / "j.json"
    status, out, _ = run(
        capsys, "excite", folder / "m.json", "--encoder-counts", 4096, *words, "--json", page
    )
    raw = json.loads(page.read_text())["forecast"]
    assert status == 0 and "forecast of a log at 500 Hz, positions of 4096 counts a turn" in out
    assert raw["encoder_counts"] == 4096 and f"torques at {raw['parallel_cutoff']:g} Hz" in out
    assert all(sigma > 0.0 for sigma in raw["sigmas"].values())


def test_a_motion_of_a_file_is_as_long_as_it_is(capsys, folder, tmp_path):
    words = ("simulate", "demo-arm", "--motion", folder / "motion.csv", "--out", tmp_path / "l.csv")
    text = refused(capsys, *words, "--duration", 3)
    assert "--duration: got 3 s with --motion" in text and "as long as it is" in text


def test_one_line_for_a_file_that_is_no_motion_and_for_none(capsys, tmp_path):
    with pytest.raises(SystemExit) as stop:
        main(["excite", "demo-arm"])
    assert stop.value.code == 2 and "arguments are required: --out" in capsys.readouterr().err
    words = ("excite", "scara", "--limit", "1=-1,1,2,8,50", "--out", tmp_path / "m.csv")
    assert "limits of torques need values" in refused(capsys, *words)
    assert ".txt" in refused(capsys, "excite", "demo-arm", "--out", tmp_path / "m.txt")
    header, rows = "time,q1,q2,q3", [f"{k / 100},0,{k / 1000},0" for k in range(20)]
    place, log = tmp_path / "motion.csv", tmp_path / "log.csv"
    words = ("simulate", "demo-arm", "--motion", place, "--out", log)
    assert "cannot be read" in refused(capsys, *words)
    for text, lines in {
        "no column q3": ["time,q1,q2", *(f"{k},0,0" for k in range(9))],
        "time does not increase": [header, *rows, rows[3]],
        "q2 is empty, or not below 1e+12": [header, *rows[:5], "0.05,0,nan,0", *rows[6:]],
        "expected 6 or more": [header, *rows[:3]],
        "row 9: q2 is 'a'; expected a number": [header, *rows[:7], "0.07,0,a,0"],
        "got no rows": [header],
    }.items():
        place.write_text("\n".join(lines) + "\n")
        line = refused(capsys, *words)
        assert text in line and "motion.csv" in line


def test_home_outside_of_the_limits_and_loops_that_do_not_close(capsys, tmp_path):
    out = ("--out", tmp_path / "m.csv")
    line = refused(capsys, "excite", "orthoglide-2003", "--limit", "11=0.25,0.28,1,8", *out)
    assert "[home]" in line and "joint 11" in line
    rows = [f"{k / 100},{0.19 + 0.05 * k},0.19,0.19" for k in range(40)]
    (tmp_path / "far.csv").write_text("\n".join(["time,q11,q12,q13", *rows]) + "\n")
    words = ("simulate", "orthoglide-2003", "--motion", tmp_path / "far.csv")
    assert "do not close" in refused(capsys, *words, "--out", tmp_path / "l.csv")
