"""`modeler fit --method tls` as a user types it; the paper itself: `reproduce briot-2012`."""

import json
import re

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.estimation.model_file import load_model
from tests.cli.inputs import folder_after
from tests.cli.running import answer, complaint, run
from tests.rotation import with_cases

ARM_MAKER = "\n[drive_gains]\n" + "".join(f"{joint} = 1.9\n" for joint in "123")


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """Short logs of an arm: currents bare and loaded, and torques; the model of a fit of gains."""
    folder = tmp_path_factory.mktemp("arm")
    (folder / "maker.toml").write_text(read_builtin_robot("demo-arm") + ARM_MAKER)
    torque = "simulate demo-arm --duration 8 --rate 200"
    current = f"{torque} --drive-gain 1=2 --drive-gain 2=2 --drive-gain 3=2"
    folder_after(
        folder,
        f"{torque} --seed 6 --out {{}}/torque.parquet",
        f"{current} --seed 4 --out {{}}/bare.parquet",
        f"{current} --seed 6 --hide payload:mass=2 --out {{}}/loaded.parquet",
        f"{current} --seed 7 --hide payload:mass=1.2,x=0.3,y=0,z=0 --out {{}}/second.parquet",
    )
    table = pq.read_table(folder / "loaded.parquet")
    values = table["current2"].to_numpy()
    holes = pa.array(np.where(np.arange(len(values)) % 50, values, np.nan))
    table = table.set_column(table.column_names.index("current2"), "current2", holes)
    pq.write_table(table, folder / "holes.parquet")
    return folder_after(
        folder,
        "fit {0}/maker.toml {0}/bare.parquet --payload-log {0}/holes.parquet --payload-mass 2 "
        "--method tls --out {0}/model.json --json {0}/fit.json --robot-out {0}/found.toml",
    )


@pytest.mark.rotating("long tests of cli")
def test_gains_are_found_and_weigh_a_second_load(arm, capsys):
    """Missing values do no harm; the model and the robot that are written have the gains."""
    gains = json.loads((arm / "fit.json").read_text())["gains"]
    assert [entry["name"] for entry in gains] == ["g_tau1", "g_tau2", "g_tau3"]
    for entry in gains:
        assert abs(entry["value"] - 2.0) < 5.0 * entry["sigma"] < 0.2
    model = load_model(arm / "model.json")
    for joint, item in zip(model.spec.joints, model.fit.gains, strict=True):
        assert joint.drive_gain == pytest.approx(item.value, rel=1e-6)
    for robot, gain in (("found", 2.0), ("maker", 1.9)):  # the load is 1.2 kg, 0.3 m away
        words = (
            "fit",
            arm / f"{robot}.toml",
            arm / "bare.parquet",
            "--out",
            arm / "weighed.json",
            "--payload-log",
            arm / "second.parquet",
            "--json",
            arm / "loads.json",
        )
        assert run(capsys, *words)[0] == 0
        loads = json.loads((arm / "loads.json").read_text())["loads"]
        (moment,) = [entry["value"] for entry in loads if entry["name"] == "MX3_load"]
        assert moment == pytest.approx(1.2 * 0.3 * gain / 2.0, rel=0.02)
    out = answer(capsys, "compare", arm / "model.json", arm / "bare.parquet")
    errors = re.findall(r"^[123] +([\d.]+) %", out, re.MULTILINE)
    assert len(errors) == 3 and all(float(error) < 1.0 for error in errors)


@pytest.mark.rotating("long tests of cli")
def test_a_log_with_a_known_load_is_predicted_with_it(arm, tmp_path, capsys):
    """Figure 3 of the paper, with a load that no fit has seen."""
    place, drawn = tmp_path / "c.json", tmp_path / "p.json"
    words = ("compare", arm / "model.json", arm / "second.parquet", "--json", place)
    carried = ("--payload-mass", 1.2, "--payload-centre", "0.3,0,0")
    assert run(capsys, *words)[0] == 0
    bare = json.loads(place.read_text())["joints"]
    printed = answer(capsys, *words, *carried, "--picture", drawn)
    loaded = json.loads(place.read_text())["joints"]
    assert all(loaded[j]["relative_error"] < 0.02 for j in loaded)
    assert loaded["2"]["rms"] < 0.25 * bare["2"]["rms"]  # along gravity
    assert "with 1.2 kg  without the load" in printed and "significantly better" in printed
    names = {picture["name"] for picture in json.loads(drawn.read_text())["pictures"]}
    assert {f"joint_{j}_models" for j in "123"} < names


@with_cases(
    "words, message",
    ("--payload-link 3", "--payload-link: needs --payload-mass; give both"),
    ("--payload-centre 0,0,0", "--payload-centre: needs --payload-mass; give both"),
    ("--payload-mass 1 --payload-centre 1,a", "expected x, y and z in m"),
    ("--payload-mass 1 --payload-link 99", "payload: no link 99"),
    ("--payload-mass -1", "expected a mass above 0"),
)
def test_a_load_that_makes_no_sense_is_refused(arm, capsys, words, message):
    model = (arm / "model.json", arm / "second.parquet")
    assert message in complaint(capsys, "compare", *model, *words.split())


MISTAKES = {
    "": "method tls needs a log with a load .* give --payload-log LOG --payload-mass KG",
    "--payload-log loaded.parquet": "method tls needs the mass of the load, .* --payload-mass KG",
    "--payload-log loaded.parquet --payload-mass 0": "mass 0.0 kg; expected above 0",
    "--payload-log torque.parquet --payload-mass 2": "torque.parquet: got tau1, a torque; .* log",
    "--payload-moved": "need a log with the load; name it",
    "--method weighted": "let `modeler fit --method tls` find it",
}


@pytest.mark.parametrize("words", MISTAKES)
def test_a_mistake_is_one_line(arm, monkeypatch, capsys, words):
    monkeypatch.chdir(arm)
    fit = ("fit", "demo-arm", "bare.parquet", "--method", "tls", "--out", "m.json")
    assert re.search(MISTAKES[words], complaint(capsys, *fit, *words.split()))
    assert not (arm / "m.json").exists()


@with_cases(
    "gain, words",
    ("7=2", "no joint 7 with a motor; expected one of 1, 2, 3"),
    ("1", "expected each joint once as JOINT=VALUE, as in 1=12.5"),
    ("1=0", "got 0; expected torque per drive unit, a number other than 0"),
    ("1=much", "got much"),
)
def test_a_gain_that_cannot_be_simulated(tmp_path, capsys, gain, words):
    out = tmp_path / "a.parquet"
    assert words in complaint(capsys, "simulate", "demo-arm", "--drive-gain", gain, "--out", out)
    assert not out.exists()


def test_robot_out_is_refused_of_a_fit_that_ends_in_base_parameters(arm, tmp_path, capsys):
    words = ("fit", "demo-arm", arm / "torque.parquet", "--out", tmp_path / "m.json")
    assert "--robot-out" in complaint(capsys, *words, "--robot-out", tmp_path / "r.toml")
