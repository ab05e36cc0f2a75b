"""Logs read in chunks, fits whose W is never built: rows, fit and report are those of the whole."""

import dataclasses
import subprocess
import sys
from functools import cache
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
from scipy.signal import lfilter
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError
from modeler.estimation import judge_fit, long_logs as streamed
from modeler.estimation.gravity import thin_rows
from modeler.estimation.identify import CrossValidation, identify
from modeler.estimation.long_logs import identify_long, reduce_chunk, stream_logs
from modeler.estimation.verdict import find_unexplained_joints
from modeler.regression import Log, observation as passing, observe, segments
from modeler.regression.motion import Processing
from modeler.regression.read import MemorySource, cut_rows
from modeler.regression.survey import KnownFacts, WholeLogNeeded, choose_from_windows
from modeler.runtime.model import CompiledModel
from tests.modules import compiled
from tests.rotation import rotating, slow_rotating, with_cases

ROWS = 1024  # of a chunk


def arm():
    return compiled("two-link")


@cache
def noisy_log(seconds=40.0, rate=200, logged=False, seed=0):
    """A motion with noise on torque and position, so that every choice of rows leaves a trace."""
    log = exact_log(arm(), some_beta(arm()), seed=seed, seconds=seconds, rate=rate, logged=logged)
    random = np.random.default_rng(100 + seed)
    return dataclasses.replace(
        log,
        tau=log.tau + random.normal(scale=0.1, size=log.tau.shape),
        q=log.q + random.normal(scale=1e-5, size=log.q.shape),
    )


def in_phase(log, processing=None):
    """The log without some last rows, so that the rows of W lie as from its beginning on."""
    every = observe(arm(), [log], processing).report.logs[0].decimation
    for shorter in range(2 * every):
        some = cut_rows(log, slice(0, log.rows - shorter))
        centres = observe(arm(), [some], processing).stretches[0].rows.centres
        if centres[0] % every == (every - 1) // 2:
            return some
    raise AssertionError("no such length")


def both(log, processing=None):
    """The fit of the whole log, and that of its chunks, with their reports."""
    seen = observe(arm(), [log], processing)
    long = streamed_log(log, processing)
    return identify(seen), identify_long(long), seen.report, long.observation.report


def streamed_log(log, processing=None, **columns):
    """What is made of the chunks of a log, some columns of which are others."""
    source = MemorySource(dataclasses.replace(log, **columns))
    return stream_logs(arm(), [source], processing, rows=ROWS)


def sigmas(fit):
    return np.array([parameter.sigma for parameter in fit.parameters])


def assert_same_counts(whole, chunked, *more):
    """What is reported about a log, and more of it."""
    (one,), (other,) = whole.logs, chunked.logs
    for name in ("rows", "missing", "saturated", "gaps", "pieces", "short", *more):
        assert getattr(one, name) == getattr(other, name), name
    assert [(d.column, d.kind, d.times) for d in one.damages] == [
        (d.column, d.kind, d.times) for d in other.damages
    ]


@pytest.mark.parametrize(
    ("logged", "cutoff"), [(False, None), *rotating((True, 0.0), (True, None))]
)
def test_a_log_in_chunks_gives_the_fit_of_the_whole_log(logged, cutoff):
    """To 1e-9 of sigma: what the position filter forgot beyond a margin is 3e-13 of the motion."""
    processing = Processing(parallel_cutoff=cutoff)
    log = in_phase(noisy_log(logged=logged), processing)
    whole, chunked, report, in_chunks = both(log, processing)
    np.testing.assert_allclose((chunked.beta - whole.beta) / sigmas(whole), 0.0, atol=1e-6)
    np.testing.assert_allclose(chunked.covariance, whole.covariance, rtol=1e-6)
    assert chunked.rows == whole.rows and chunked.samples == whole.samples
    assert chunked.relative_error == pytest.approx(whole.relative_error, rel=1e-9)
    # chunks of `ROWS`, or longer where the filters extend over more than a few of their rows
    assert 2 <= chunked.reading["chunks"] <= -(-log.rows // ROWS)
    assert chunked.reading["passes"] == 1
    more = ("samples", "derivatives", "decimation", "contradicted", "span")
    assert_same_counts(report, in_chunks, *more)
    assert [j.format_line() for j in report.joints] == [j.format_line() for j in in_chunks.joints]
    assert report.processing == in_chunks.processing
    assert any("chunks" in line for line in in_chunks.format_lines()[:4])


def test_gaps_holes_limits_spikes_and_segments_across_borders_are_as_in_the_whole_log():
    log = noisy_log(seconds=40.0)
    q, tau = log.q.copy(), log.tau.copy()
    q[ROWS - 3 : ROWS + 2, 0] = np.nan  # bridged across a border
    q[2 * ROWS - 40 : 2 * ROWS + 300, 1] = np.nan  # a gap over a border and beyond its margin
    tau[3 * ROWS - 10 : 3 * ROWS + 10, 0] = np.nan
    tau[:, 1] = np.clip(tau[:, 1], -np.inf, 0.7 * tau[:, 1].max())
    tau[4 * ROWS + 5, 0] += 40.0 * np.ptp(log.tau[:, 0])
    q[5 * ROWS - 1, 1] += 2.0
    segment = np.zeros(log.rows)
    segment[6 * ROWS + 100 :] = 1.0
    time = log.time.copy()
    time[4 * ROWS + 500 :] += 1.0
    damaged = dataclasses.replace(log, q=q, tau=tau, time=time, segment=segment)
    whole, chunked, *reports = both(damaged)
    assert_same_counts(*reports)
    assert chunked.rows == pytest.approx(whole.rows, abs=10)
    assert np.abs((chunked.beta - whole.beta) / sigmas(whole)).max() < 3.0


@pytest.fixture
def small_windows(monkeypatch):
    """A survey that sees little of a short log."""
    for name, value in (("WINDOW", 512), ("SECONDS", 1.0), ("WINDOWS", 4)):
        monkeypatch.setattr(sys.modules["modeler.regression.survey"], name, value)


def test_windows_choose_for_all_rows(small_windows):
    log = noisy_log(seconds=60.0)
    long = streamed_log(log)
    reading = long.passes.to_json()
    assert 2 <= reading.pop("chunks") <= -(-log.rows // ROWS)
    assert reading == {"passes": 1, "rows": log.rows, "windows": 4, "rows_in_windows": 4 * 512}
    assert 0.1 < long.observation.used.sum() / long.data.rows.sum() < 0.2
    fit = identify_long(long)
    assert np.sqrt(np.mean(((fit.beta - some_beta(arm())) / sigmas(fit)) ** 2)) < 2.5


@pytest.mark.parametrize("zero", [1.7e9, *rotating(-450.0)])
def test_the_zero_of_the_clock_changes_nothing(zero, monkeypatch):
    """Stamps differ by their rounding: 1e-13 s, or 2.4e-7 s where they count from 1970."""
    for name, value in (("WINDOW", 512), ("SECONDS", 0.0), ("WINDOWS", 8)):
        monkeypatch.setattr(sys.modules["modeler.regression.survey"], name, value)
    log = noisy_log(seconds=90.0)
    fast = log.time > 45.0  # half of the windows: their median must not hang on a digit
    q = np.where(fast[:, None], np.sin(7.0 * log.time)[:, None] * [0.5, 0.4], log.q)
    log = dataclasses.replace(log, q=q)
    one, other = streamed_log(log), streamed_log(log, time=log.time + zero)
    assert one.observation.report.choices == other.observation.report.choices
    assert one.passes.to_json() == other.passes.to_json()
    assert one.data.rows.tolist() == pytest.approx(other.data.rows.tolist(), abs=2)
    first, second = identify_long(one), identify_long(other)
    # a clock that counts from 1970 resolves 0.24 us, which plain filters of 40 Hz pass on
    assert np.abs((first.beta - second.beta) / sigmas(first)).max() < 1e-2


@pytest.fixture
def any_machine(monkeypatch):
    """Values drawn at random are of no real machine."""
    for name in ("check_time", "_find_impossible"):
        monkeypatch.setattr(f"modeler.estimation.verdict.{name}", lambda *_: [])


def verdict_of(log, **columns):
    """Of the fit in chunks, and the fit."""
    long = streamed_log(log, **columns)
    fit = identify_long(long)
    return judge_fit(arm(), long.observation, fit, data=long.data).verdict, fit


def test_what_the_windows_do_not_show_makes_a_fit_not_usable(small_windows, any_machine):
    """A torque wrong by half, in a thirtieth of the log, between two windows."""
    log = noisy_log(seconds=60.0)
    clean, _ = verdict_of(log)
    assert clean.valid and not [line for line in clean.lines if "windows" in line]
    tau = log.tau.copy()
    tau[2400:2800, 0] *= 1.5
    wrong, fit = verdict_of(log, tau=tau)
    assert fit.joints[0].relative_error > 0.03 and wrong.by_joint["1"].state == "undetermined"
    assert "joint 1 undetermined: fit error " in wrong.line and " on all rows, " in wrong.line
    # no verdict promises better than the error on all rows
    tau[2400:2800, 0] *= 1.003 / 1.5
    verdict, fit = verdict_of(log, tau=tau)
    assert verdict.valid
    promised = float(verdict.line.split(" % on every joint")[0].rsplit(" ", 1)[1])
    most = max(joint.relative_error for joint in fit.joints)
    assert promised >= float(f"{100.0 * most:.3g}")


def test_noise_is_a_larger_share_of_slower_motion_and_no_doubt(small_windows):
    """Fast in the windows, slow between them: four times the relative error, the same in N m."""
    fit = identify_long(streamed_log(noisy_log()))
    errors = np.array([joint.relative_error for joint in fit.joints]) / 4.0
    assert not find_unexplained_joints(fit, CrossValidation(errors), np.array([0.25, 0.25]))
    validated = CrossValidation(errors)
    assert len(find_unexplained_joints(fit, validated, np.array([1.0, 4.0]))) == 2


def test_a_drive_limit_that_the_windows_reach_and_others_exceed_costs_a_second_pass(small_windows):
    """A chunk alone takes its largest torque for the limit; the whole log knows better."""
    log = noisy_log(seconds=60.0)
    tau = log.tau.copy()
    at = 3 * ROWS + 600  # a run of one value with leaps into and out of it, but below the largest
    tau[at : at + 8, 0] = 1.5 * tau[3 * ROWS - 200 : 4 * ROWS + 200, 0].max()
    tau[7 * ROWS + 10 : 7 * ROWS + 60, 0] = 3.0 * np.abs(tau[:, 0]).max()
    long = streamed_log(log, Processing(keep_damaged=True), tau=tau)
    assert long.passes.passes == 2
    seen = observe(arm(), [dataclasses.replace(log, tau=tau)], Processing(keep_damaged=True))
    assert long.observation.report.logs[0].saturated == seen.report.logs[0].saturated == {"1": 50}


def test_a_joint_that_rests_where_windows_are_is_not_left_out(small_windows):
    log = noisy_log(seconds=60.0)
    moving = np.zeros(log.rows)
    moving[200:1000] = np.hanning(800)
    q = log.q.copy()
    q[:, 1] = 0.3 + 0.5 * moving * np.sin(8.0 * log.time)
    qd = np.gradient(q, log.step, axis=0)
    tau = arm().base_regressor(q, qd, np.gradient(qd, log.step, axis=0)) @ some_beta(arm())
    long = streamed_log(log, q=q, tau=tau + 0.01 * log.tau)
    assert long.passes.passes == 2
    assert 0.0 < long.observation.report.joints[1].speed_floor < np.inf
    assert long.data.rows[1] > 10


def test_windows_look_for_motion_in_a_log_that_mostly_rests(small_windows):
    log = noisy_log(seconds=120.0)
    moving = (np.arange(log.rows) // 700) % 6 == 1  # 3.5 s of every 21 s; no window's middle
    turn = np.cumsum(moving) * log.step
    like = noisy_log(seconds=float(turn[-1]) + 0.1)
    at = np.cumsum(moving).clip(0, like.rows - 1)
    long = streamed_log(log, q=like.q[at], tau=like.tau[at])
    assert long.observation.used.sum() > 20
    q = np.tile(log.q[:1], (log.rows, 1))
    q[400:480] = log.q[400:480]
    with pytest.raises(WholeLogNeeded, match="found in the 4 windows by which long"):
        streamed_log(log, q=q)


def test_what_is_wrong_in_one_window_is_not_said_of_all(small_windows):
    """One value that cannot be, in the first of four windows."""
    log = noisy_log(seconds=60.0)
    tau = log.tau.copy()
    tau[1600, 0] = 1e15
    with pytest.raises(WholeLogNeeded, match=r"tau of joint 1 is 1e\+15 at 8 s") as result:
        streamed_log(log, Processing(keep_damaged=True), tau=tau)
    assert "all windows" not in str(result.value)


def test_a_time_that_changes_its_unit_is_told_by_the_windows(small_windows, monkeypatch):
    log = noisy_log(seconds=60.0)
    time = log.time.copy()
    time[6000:] = time[6000] + 1e3 * (time[6000:] - time[6000])
    monkeypatch.setattr(streamed.reduce_by_threads, "__defaults__", (None,))  # no row is reduced
    with pytest.raises(DataError, match=r"column time: a row every 0\.005 s at 7\.5 s and every"):
        streamed_log(log, time=time)


def test_a_logger_that_is_slow_while_the_robot_rests_has_one_unit(small_windows):
    log = noisy_log(seconds=60.0)
    time, q = log.time.copy(), log.q.copy()
    time[9000:] = time[9000] + 200.0 * (time[9000:] - time[9000])
    q[9000:] = q[9000]
    slow = dataclasses.replace(log, time=time, q=q)
    chosen = choose_from_windows(arm(), [MemorySource(slow)], Processing(), KnownFacts(), ROWS)
    assert chosen.windows == 4


def test_threads_change_nothing(monkeypatch):
    log = noisy_log()
    one = streamed_log(log)
    monkeypatch.setattr("modeler.estimation.long_logs.cpu_count", lambda: 5)
    many = streamed_log(log)
    np.testing.assert_array_equal(one.data.triangles, many.data.triangles)


def test_an_error_or_an_interrupt_ends_the_threads(monkeypatch):
    log, begun = noisy_log(), []

    def broken(model, chunk, chosen):
        begun.append(chunk.number)
        if chunk.number == 1:
            raise KeyboardInterrupt
        return reduce_chunk(model, chunk, chosen)

    monkeypatch.setattr(streamed.reduce_by_threads, "__defaults__", (broken,))
    monkeypatch.setattr("modeler.estimation.long_logs.cpu_count", lambda: 1)
    with pytest.raises(KeyboardInterrupt):
        stream_logs(arm(), [MemorySource(log)], rows=512)
    assert len(begun) < 6 < log.rows / 512


def test_sigmas_of_windows_are_those_of_all_rows(small_windows):
    """Coloured residuals: the factor on the sigmas of all rows, from a sixth of them."""
    log = noisy_log(seconds=80.0)
    pole = np.exp(-log.step / 0.2)
    white = np.random.default_rng(8).normal(size=log.tau.shape)
    noise = np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)
    log = dataclasses.replace(log, tau=log.tau + noise)
    whole = identify(observe(arm(), [log]))
    long = identify_long(streamed_log(log))
    ratio = np.sqrt(np.diag(long.covariance) / np.diag(whole.covariance))
    assert np.all((ratio > 0.5) & (ratio < 2.0)) and np.median(ratio) == pytest.approx(1, abs=0.25)
    assert long.essential is not None


@pytest.mark.parametrize("each", [1.25, *rotating(2.0, 3.3)])
def test_rows_that_repeat_are_left_out_of_chunks_as_of_the_whole_log(each):
    """A recorder that is `each` times as fast as the robot; its rows lie elsewhere."""
    log = noisy_log(rate=100)
    rows = (np.arange(int(each * log.rows)) / each).astype(int)
    time = np.arange(len(rows)) / (100.0 * each)
    whole, chunked, *reports = both(dataclasses.replace(cut_rows(log, rows), time=time))
    (one,), (other,) = (report.logs for report in reports)
    assert [d.line for d in one.damages] == [d.line for d in other.damages]
    assert len(one.damages) == 1 and "gave about 100 rows a second" in one.damages[0].line
    assert one.samples == pytest.approx(other.samples, rel=0.02)
    assert (one.decimation, one.resampled) == (other.decimation, other.resampled)
    assert np.abs((chunked.beta - whole.beta) / sigmas(whole)).max() < 3.0
    np.testing.assert_allclose(sigmas(chunked), sigmas(whole), rtol=0.3)


_MEMORY = """
import resource, sys
from modeler.cli import main
main(["fit", "two-link", sys.argv[1], "--out", sys.argv[2]])
print("peak:", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
"""


@slow_rotating("memory of long logs")
def test_memory_does_not_grow_with_the_log(tmp_path):
    """Peak memory of a fit of 300 000 and of 1 200 000 rows: within 30 MB; read, they are 48 MB."""
    noise, peaks = np.random.default_rng(1).normal(scale=0.1, size=(2, 100_000)), []
    for parts in (3, 12):
        path, writer = tmp_path / f"run{parts}.parquet", None
        for part in range(parts):
            time = (np.arange(100_000) + part * 100_000) * 1e-3
            q = np.stack([np.sin(0.7 * time), np.cos(1.1 * time)]) + 1e-4 * noise
            columns = [time, *q, *(np.array([[5.0], [2.0]]) * q + noise)]
            table = pa.table(columns, names=["time", "q1", "q2", "tau1", "tau2"])
            writer = writer or pa.parquet.ParquetWriter(path, table.schema)
            writer.write_table(table)
        writer.close()
        words = [sys.executable, "-c", _MEMORY, str(path), str(tmp_path / "m.json")]
        done = subprocess.run(words, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr
        assert "chunks" in done.stdout
        peaks.append(int(done.stderr.rsplit("peak:", 1)[1]) / 1024)
    assert peaks[1] - peaks[0] < 30.0, peaks


def test_logs_of_other_columns_are_reported_together():
    """One with logged velocities, one without: their samples add up all the same."""
    logs = [noisy_log(logged=logged, seed=logged) for logged in (True, False)]
    long = stream_logs(arm(), [MemorySource(log) for log in logs], rows=ROWS)
    report = long.observation.report
    assert [one.rows for one in report.logs] == [log.rows for log in logs]
    assert [joint.samples for joint in report.joints] == [sum(log.rows for log in logs)] * 2


PASSED_RATE = 200.0


def passed_log(model: CompiledModel, memory: float, size: float = 1.0, seed: int = 1) -> Log:
    """Twelve seconds with a gap, missing torques and noise of that memory, s."""
    rng = np.random.default_rng(seed)
    n, time = len(model.spec.joints), np.arange(12 * PASSED_RATE) / PASSED_RATE
    time = np.where(time < 5.0, time, time + 0.7)
    w = 2 * np.pi * rng.uniform(0.2, 2.0, (n, 4))
    angle = time[:, None, None] * w + rng.uniform(0, 6.28, (n, 4))
    a = size * rng.uniform(0.1, 0.4, (n, 4))
    q, qd, qdd = (
        x.sum(2) for x in (np.sin(angle) * a, np.cos(angle) * a * w, -np.sin(angle) * a * w * w)
    )
    if model.spec.closure is not None:
        q = q + [model.spec.closure.home[i] for i in model.spec.closure.actuated]
    tau = model.inverse_dynamics(q, qd, qdd, rng.uniform(0.5, 2.0, len(model.spec.base)))
    pole = np.exp(-1.0 / (PASSED_RATE * memory)) if memory else 0.0
    noise = np.sqrt(1 - pole**2) * lfilter([1.0], [1.0, -pole], rng.normal(size=q.shape), axis=0)
    tau = tau + 0.05 * np.std(tau, axis=0) * noise
    tau[700:720, 0] = np.nan
    return Log("x.csv", tuple(j.name for j in model.spec.joints), time, q, tau, qd, qdd)


def fitted(model, log, processing, method):
    observation = observe(model, [log], processing)
    result = identify(observation, method, model)
    return observation, judge_fit(model, observation, result)


def assert_same(stored: Any, passed: Any, where: str = "") -> None:
    """Equal but for the rounding of numbers."""
    if isinstance(stored, dict | list | tuple):
        assert len(stored) == len(passed), where
        for key in stored if isinstance(stored, dict) else range(len(stored)):
            assert_same(stored[key], passed[key], f"{where}.{key}")
    elif isinstance(stored, float):
        assert passed == pytest.approx(stored, rel=1e-9, abs=1e-12), where
    else:
        assert passed == stored, where


PLAIN = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=1, derivatives="log")
THIRD = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=3, derivatives="log")
SMOOTH = Processing(position_cutoff=0.0, parallel_cutoff=20.0, derivatives="log")


@pytest.mark.digits
@with_cases(
    "name, processing, memory, method",
    ("wrist", PLAIN, 0.2, "weighted"),  # autocorrelated residuals
    ("wrist", PLAIN, 0.0, "robust"),  # reads rows, and has them
    ("five-bar", PLAIN, 0.0, "weighted"),
    *rotating(
        ("wrist", SMOOTH, 0.1, "ordinary"),
        ("wrist", THIRD, 0.0, "weighted"),
        ("wrist", PLAIN, 0.0, "ordinary"),
    ),
)
def test_a_fit_without_w_is_the_fit_with_it(monkeypatch, name, processing, memory, method):
    model = compiled(name)
    log = passed_log(model, memory, 1.0 if name == "wrist" else 0.1)
    stored, expected = fitted(model, log, processing, method)
    monkeypatch.setattr(passing, "KEPT", 0)
    limits = dataclasses.replace(segments.THRESHOLDS, filter_block_samples=50)
    monkeypatch.setattr(segments, "THRESHOLDS", limits)  # fewer samples than lags
    observation, fit = fitted(model, log, processing, method)
    assert len(stored.stretches) == 2 and not stored.used.all()
    assert "columns" in vars(stored)
    assert ("columns" in vars(observation)) is (method == "robust")
    np.testing.assert_array_equal(thin_rows(model, observation).W, thin_rows(model, stored).W)
    assert_same(expected.to_json(), fit.to_json())
