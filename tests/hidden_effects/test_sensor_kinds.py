"""Sensors of real machines: what they do to a motion and to a log."""

from dataclasses import replace

import numpy as np
import pyarrow.parquet
import pytest

from tests.hidden_effects.case import Case, make_case
from tests.hidden_effects.plant import TICK
from tests.hidden_effects.sensor_kinds import SENSORS, computed_torque
from tests.hidden_effects.test_generator import arm
from tests.hidden_effects.visibility import Left, shown

JOINTS = 2


def columns(rows=3000):
    """A log of two joints without any noise."""
    time = np.arange(rows) * TICK
    q = {f"q{j + 1}": np.sin((j + 1) * time) for j in range(JOINTS)}
    tau = {f"tau{j + 1}": np.cos((j + 1) * time) for j in range(JOINTS)}
    return {"time": time} | q | {f"qc{j + 1}": q[f"q{j + 1}"] for j in range(JOINTS)} | tau


def logged(kind):
    return SENSORS[kind].logged(columns(), 1, np.random.default_rng(3))


@pytest.mark.parametrize(
    ("kind", "size"), [("white", 0.44e-3), ("white2", 2e-3), ("coloured", 1e-3)]
)
def test_noise_is_in_the_logged_positions_only(kind, size):
    before, after = columns(), logged(kind)
    noise = after["q1"] - before["q1"]
    assert noise.std() == pytest.approx(size, rel=0.3)
    assert abs(np.corrcoef(noise, after["q2"] - before["q2"])[0, 1]) < 0.3
    assert {name for name in before if (after[name] != before[name]).any()} == {"q1", "q2"}
    share = np.abs(np.fft.rfft(noise)) ** 2
    low = share[np.fft.rfftfreq(len(noise), TICK) < 30].sum() / share.sum()
    assert low > 0.6 if kind == "coloured" else low == pytest.approx(0.06, abs=0.02)


def test_a_late_position_a_wrong_unit_and_a_recorder_that_repeats_rows():
    before, late, wrong = columns(), logged("late"), logged("millinewton")
    for after, name in ((late, "q2"), (wrong, "tau2")):
        assert {each for each in before if (after[each] != before[each]).any()} == {name}
    np.testing.assert_array_equal(late["q2"][5:], before["q2"][:-5])
    np.testing.assert_allclose(wrong["tau2"], 1000 * before["tau2"])
    for kind in ("repeat", "repeat3"):
        after, faster = logged(kind), SENSORS[kind].faster
        np.testing.assert_allclose(np.diff(after["time"]), TICK / faster, rtol=1e-6)
        assert after["time"][-1] == pytest.approx(before["time"][-1], abs=TICK)
        same = np.all([np.diff(after[name]) == 0 for name in ("q1", "q2", "tau1", "tau2")], axis=0)
        assert same.mean() == pytest.approx(1 - 1 / faster, abs=1e-2)
        assert np.abs(after["q1"] - np.sin(after["time"])).max() < 1.1 * TICK


def test_a_coarse_encoder_is_in_the_loop():
    """The drive answers its steps, but follows its path; a step is that of the encoder."""
    plant, path, _ = arm("2R", seconds=4.0)
    fine = plant.run(path, np.zeros(JOINTS), 1)
    SENSORS["coarse"].equip(plant)
    run = plant.run(path, np.zeros(JOINTS), 1)
    counts = run.encoder * 4096 / (2 * np.pi)
    np.testing.assert_allclose(counts, np.round(counts), atol=1e-6)
    trembling = [np.diff(r.torque[::4], axis=0).std(0) for r in (fine, run)]
    assert (trembling[1] > 2 * trembling[0]).all()
    assert (run.torque.std(0) < 1.5 * fine.torque.std(0)).all()
    assert np.abs(run.link - path).max() < 0.1


def test_computed_torques_have_no_friction():
    plant, path, _ = arm("2R", seconds=4.0)
    run = plant.run(path, np.zeros(JOINTS), 1)
    share = (run.torque[::4] - computed_torque(plant, run.link)).std(0) / run.torque.std(0)
    assert (share > 0.01).all() and (share < 0.5).all()


def test_what_positions_bury_is_not_visible():
    """Visible is what a fine encoder shows, or less; fast effects are buried before slow ones."""
    plant, path, scales = arm("2R", seconds=4.0)
    time = np.arange(len(path))[100:-100:12] * TICK
    seen = {}
    for hertz in (0.5, 12.0):
        wave = np.sin(2 * np.pi * hertz * time)[:, None] * 0.02 * scales.motors
        left = Left(wave, np.ones(wave.shape, bool), path)
        for kind in ("white", "white2"):
            read = SENSORS[kind].read(path, np.random.default_rng(1))
            seen[hertz, kind] = shown(left, plant, read, "med", scales)
        exact = shown(left, plant, path, "med", scales)
        assert exact == pytest.approx(2 / np.sqrt(2), rel=0.1)
        assert exact >= seen[hertz, "white"] > seen[hertz, "white2"]
    assert seen[0.5, "white2"] > 3 * seen[12.0, "white2"]


@pytest.mark.rotating("long tests of hidden_effects")
def test_a_seed_is_a_case_and_a_kind_of_sensor_the_same_arm(tmp_path):
    fine = Case(("coulomb",), "med", 3, "2R")
    cases = {"late": replace(fine, sensor="late"), "fine": fine, "again": fine}
    truth, plain, again = (make_case(c, tmp_path / n, visible=0.25) for n, c in cases.items())
    assert cases["late"].folder == "coulomb-med-3-late" and fine.folder == "coulomb-med-3"
    assert truth["plant"] == plain["plant"] and truth["visible"] == plain["visible"]
    logs = [pyarrow.parquet.read_table(tmp_path / k / "train.parquet") for k in ("late", "fine")]
    other = [name for name in logs[0].column_names if logs[0][name] != logs[1][name]]
    assert other == [f"q{truth['sensor']['joint']}"] and "joint" not in plain["sensor"]
    assert plain == again
    for path in (tmp_path / "fine").iterdir():
        assert path.read_bytes() == (tmp_path / "again" / path.name).read_bytes()
    other = {"1": "2", "2": "1"}[plain["hidden"][0]["joint"]]
    text = (tmp_path / "fine" / "robot.toml").read_text()
    assert f'coulomb = ["{other}"]' in text and 'viscous = "all"' in text
    assert "M1" not in text and "parameters" not in text
