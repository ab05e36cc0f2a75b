"""What is said of a recording is true of it: holds, gaps, dry friction, coarse speeds."""

import dataclasses

import numpy as np
import pytest

from modeler.cli import main
from modeler.numerics import channels
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observe import observe
from tests.oracles.numpy_model import planar_arm
from tests.regression.motions import fourier, noisy_torque, write
from tests.rotation import rotating

COUNTS = 2 * np.pi / 2**14
STEP = 2e-3


def motion(seconds=12.0, step=STEP, seed=0):
    """Time, positions, speeds and accelerations of two joints."""
    t = np.arange(0.0, seconds, step)
    return fourier(np.random.default_rng(seed), t, 2, 0.7, (0.2, 0.5))


def recorded(seed=0, **more):
    """A log of the planar arm with an encoder and 1 % of noise, and its parameters."""
    t, q, qd, qdd = motion(seed=seed)
    tau, beta = noisy_torque(np.random.default_rng([seed, 1]), planar_arm(), q, qd, qdd, 0.01)
    return Log("run", ("1", "2"), t, np.round(q / COUNTS) * COUNTS, tau, **more), beta


def held(values, rows):
    """(n, J) each value for so many rows."""
    return values[np.arange(len(values)) // rows * rows]


def report_text(seen):
    return "\n".join([*seen.report.format_lines(), *seen.report.collect_warnings()])


def relative_error(log, beta, processing=None):
    """Of the true parameters, on the rows that an observation of the log has."""
    seen = observe(planar_arm(), [log], processing)
    return float(np.linalg.norm(seen.W @ beta - seen.y) / np.linalg.norm(seen.y))


WRONG = ("jumps", "rings", "stays at", "stuck at its limit", "repeats", "spike")


@pytest.mark.rotating("long tests of observation")
@pytest.mark.parametrize(
    ("channel", "rows"), [("q", 4), *rotating(("tau", 10), ("qd", 4), ("q", 10), ("tau", 4))]
)
def test_a_held_channel_is_named_with_its_rate_and_interpolated(channel, rows):
    log, beta = recorded(rows)
    log = dataclasses.replace(log, qd=motion(seed=rows)[2])
    log = dataclasses.replace(log, **{channel: held(getattr(log, channel), rows)})
    seen = observe(planar_arm(), [log])
    text = report_text(seen)
    assert f"holds each value for {rows} rows: sampled at {500 / rows:.3g} Hz, not 500 Hz" in text
    assert not any(word in text.replace("repeats it", "") for word in WRONG), text
    if channel != "qd":  # of logged speeds, positions may serve as well
        assert "interpolated between new values, held-out error x 0." in text
        assert relative_error(log, beta) < 0.05
        raw = Processing(keep_damaged=True)
        assert relative_error(log, beta) < 0.6 * relative_error(log, beta, raw)


def test_channels_with_holds_of_their_own_are_no_slow_robot():
    log, _ = recorded(1)
    q = np.column_stack([held(log.q[:, 0], 7), held(log.q[:, 1], 5)])
    tau = np.column_stack([held(log.tau[:, 0], 11), held(log.tau[:, 1], 6)])
    assert not channels.find_repeated_rows(q, tau).any()
    assert [channels.estimate_hold_length(x) for x in (*q.T, *tau.T)] == [7, 5, 11, 6]
    together = channels.find_repeated_rows(held(log.q, 3), held(log.tau, 3))
    assert together.mean() == pytest.approx(2 / 3, abs=0.01)


def test_clean_channels_coarse_encoders_and_switched_torques_are_not_held():
    random, (t, q, _, _) = np.random.default_rng(0), motion(step=1e-3)
    for counts in (1e-2, 1e-3, 1e-5):
        for slow in (1.0, 0.02):
            assert channels.estimate_hold_length(np.round(slow * q[:, 0] / counts) * counts) == 1
    noisy = np.round(random.normal(size=t.size) * 3.0) / 10.0
    assert (
        channels.estimate_hold_length(noisy)
        == channels.estimate_hold_length(np.sign(np.sin(9.0 * t)))
        == channels.estimate_hold_length(0.0 * t)
        == 1
    )


@pytest.mark.parametrize("seed", [0, *rotating(1, 2)])
def test_a_pause_of_the_bus_and_a_step_of_stick_slip_are_no_new_zero(seed):
    log, _ = recorded(seed)
    random = np.random.default_rng(seed)
    keep = np.ones(log.rows, dtype=bool)
    for start in random.integers(300, log.rows - 300, 6):
        keep[start : start + 75] = False  # 0.15 s
    q = log.q.copy()
    slip = 0.01 * np.clip((np.arange(log.rows) - 2500) / 4.0, 0.0, 1.0)
    q[:, 1] += np.round(slip / COUNTS) * COUNTS
    log = dataclasses.replace(log, time=log.time[keep], q=q[keep], tau=log.tau[keep])
    seen = observe(planar_arm(), [log])
    assert not any(word in report_text(seen) for word in ("jumps", "rows are missing", "stays"))
    raw = observe(planar_arm(), [log], Processing(keep_damaged=True))
    np.testing.assert_array_equal(seen.q, raw.q)


def test_a_joint_that_sticks_before_it_turns_back_is_not_clipped():
    t = np.arange(0.0, 20.0, 0.03)
    swing = 0.4 * np.sin(1.3 * t)
    for stick in (0.05, 0.2):  # friction stops it so far from the turn
        way = np.cos(1.3 * t)
        stopped = np.where(np.abs(way) < stick, 0.4 * np.sign(swing) * np.sqrt(1 - stick**2), swing)
        q = np.round(stopped / 3.8e-4) * 3.8e-4
        assert channels.find_clips(t, q, 1e-4) == ()
    cut = np.clip(0.4 * np.sin(1.3 * t), -0.3, 0.25)
    clips = [(clip.value, clip.upper) for clip in channels.find_clips(t, cut, 0.0)]
    assert clips == [(0.25, True), (-0.3, False)]


def test_a_claim_that_the_fit_does_not_confirm_changes_nothing():
    """A spike of logged speeds that nobody reads; a leap of positions beside it is mended.

    The spike is not even told: it makes no difference.
    """
    log, _ = recorded(4)
    qd = motion(seed=4)[2]
    qd[1000, 0] += 9.0
    log.q[4000:, 1] -= 0.9 * np.sign(qd[4000, 1])
    log = dataclasses.replace(log, qd=qd)
    seen = observe(planar_arm(), [log], Processing(derivatives="position"))
    assert "qd1: jumps" not in report_text(seen)
    as_logged = Processing(derivatives="position", keep_damaged=True)
    raw = observe(planar_arm(), [log], as_logged)
    assert "qd1: jumps by 8.99 rad/s and back, at 2 s; used as logged" in report_text(raw)
    assert any("q2: jumps by 0.9 rad" in doubt for doubt in seen.report.collect_warnings())
    scores = seen.report.processing.repairs
    assert scores["run: q2 zero"] < 0.95 < scores["run: qd1 spike"]
    again = observe(planar_arm(), [log], seen.report.processing)
    np.testing.assert_array_equal(again.q, seen.q)
    other = dataclasses.replace(log, name="other")  # nothing is mended that no fit has tried
    assert not np.array_equal(observe(planar_arm(), [other], seen.report.processing).q, seen.q)


def test_speeds_in_coarse_steps_have_their_own_unit_and_mask():
    step = 0.05
    log, _ = recorded(2)
    speeds = np.round(motion(seed=2)[2] / step) * step
    log = dataclasses.replace(log, qd=speeds)
    seen = observe(planar_arm(), [log], Processing(derivatives="log"))
    (line,) = (x for x in seen.report.noise.format_channels() if "joint 1" in x)
    assert "in steps of 50 mrad/s" in line
    floors = seen.report.processing.speed_floors
    assert all(floor >= 0.99 * step for floor in floors.values())


def test_no_low_speed_is_masked_where_none_is_asked_for():
    log, _ = recorded(3)
    seen = observe(planar_arm(), [log], Processing(low_speed=0.0))
    assert {*seen.report.processing.speed_floors.values()} == {0.0}
    assert "never moves" not in report_text(seen) and seen.used.all()


def test_a_lattice_is_found_below_single_precision_and_no_rounding_is_one():
    t, q, _, _ = motion(step=1e-3)
    for counts in (2**12, 2**16, 2**19):
        step = 2 * np.pi / counts
        exact = np.round(q[:, 0] / step) * step
        degrees = np.float32(np.rad2deg(exact)).astype(float) * np.pi / 180.0
        for values in (exact, np.float32(exact).astype(float), degrees):
            assert channels.estimate_lattice_step(values) == pytest.approx(step, rel=1e-4)
    assert (
        channels.estimate_lattice_step(q[:, 0])
        == channels.estimate_lattice_step(np.float32(q[:, 0]).astype(float))
        == 0.0
    )
    assert channels.estimate_lattice_step(0.3 * t) == 0.0


def test_one_line_lists_what_never_changes_and_stands_last(tmp_path, capsys):
    """Torques of joints that move; not what nobody measures, nor a joint at rest."""
    log, _ = recorded(5)
    log = dataclasses.replace(log, qd=-motion(seed=5)[2], tau=0.0 * log.tau)
    log.q[:, 1] = log.qd[:, 1] = 0.5
    place = write(tmp_path / "a.csv", log, spare1=0.0 * log.time)
    assert main(["log", place]) == 0
    doubts = [x for x in capsys.readouterr().out.splitlines() if x.startswith("warning: ")]
    assert doubts[-1] == "warning: tau1 never changes: is it connected?"
    assert "qd1 has the other sign" in doubts[0] and len(doubts) == 2


def test_positions_without_noise_are_planned_filtered_or_simulated(tmp_path, capsys):
    t, q, qd, _ = motion(seed=7)
    assert main(["log", write(tmp_path / "a.csv", Log("a", ("1", "2"), t, q, qd))]) == 0
    text = capsys.readouterr().out
    assert "joints q1, q2 have no measurement noise: they are planned, filtered or simul" in text
    assert "noise of the positions" not in text


@pytest.mark.parametrize("coarse", [0.02, *rotating(0.1)])
def test_coarse_speeds_and_coarse_positions_belong_together(tmp_path, capsys, coarse):
    log, _ = recorded(8)
    q = np.round(0.1 * log.q / 4e-4) * 4e-4
    speeds = np.round(0.1 * motion(seed=8)[2] / (0.1 * coarse)) * 0.1 * coarse
    log = dataclasses.replace(log, q=q, qd=speeds)
    assert main(["log", write(tmp_path / "a.csv", log)]) == 0
    assert "is not the derivative" not in capsys.readouterr().out
