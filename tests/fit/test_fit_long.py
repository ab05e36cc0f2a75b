"""Logs read in chunks, fits whose W is never built: rows, fit and report are those of the whole."""

import dataclasses
import pickle
import subprocess
import sys
from functools import cache, reduce
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
from scipy.signal import lfilter
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError
from modeler.estimation import long_logs as streamed
from modeler.estimation.doubts import unexplained_joints
from modeler.estimation.identify import CrossValidation, identify
from modeler.estimation.long_logs import Partial, identify_long, reduce_chunk, stream
from modeler.estimation.result import FitResult
from modeler.estimation.verdict import with_verdict
from modeler.numerics.filters import spacing
from modeler.observation import reduce as passing, stretch
from modeler.observation.channels import thinned
from modeler.observation.chunk import chunks, margin
from modeler.observation.log import Log
from modeler.observation.motion import low_pass
from modeler.observation.observation import Evaluated, Observation
from modeler.observation.observe import observe
from modeler.observation.read import MemorySource, cut
from modeler.observation.segments import split
from modeler.observation.settings import Processing
from modeler.observation.survey import FactsSoFar, WholeLogNeeded, survey
from modeler.runtime.model import CompiledModel
from tests.modules import compiled
from tests.oracles.numpy_model import planar_arm
from tests.rotation import rotating, rotating_with

ROWS = 1024  # of a chunk
ARM = planar_arm()
BETA = some_beta(ARM)


@cache
def noisy_log(seconds=40.0, rate=200, logged=False, seed=0):
    """A motion with noise on torque and position, so that every choice of rows leaves a trace."""
    log = exact_log(ARM, BETA, seed=seed, seconds=seconds, rate=rate, logged=logged)
    random = np.random.default_rng(100 + seed)
    return dataclasses.replace(
        log,
        tau=log.tau + random.normal(scale=0.1, size=log.tau.shape),
        q=log.q + random.normal(scale=1e-5, size=log.q.shape),
    )


def in_phase(log, processing=None):
    """The log without some last rows, so that the rows of W lie as from its beginning on."""
    every = observe(ARM, [log], processing).report.logs[0].decimation
    for shorter in range(2 * every):
        some = cut(log, slice(0, log.rows - shorter))
        centres = observe(ARM, [some], processing).stretches[0].rows.centres
        if centres[0] % every == (every - 1) // 2:
            return some
    raise AssertionError("no such length")


def both(log, processing=None, rows=ROWS):
    """The fit of the whole log, and that of its chunks, with their reports."""
    seen = observe(ARM, [log], processing)
    long = stream(ARM, [MemorySource(log)], processing, rows=rows)
    return identify(seen), identify_long(long), seen.report, long.observation.report


def same_counts(whole, chunked):
    """What is told of the logs and of the joints."""
    for one, other in zip(whole.logs, chunked.logs, strict=True):
        for name in ("rows", "missing", "saturated", "gaps", "pieces", "short", "samples",
                     "derivatives", "decimation", "contradicted", "span"):  # fmt: skip
            assert getattr(one, name) == getattr(other, name), name
        assert one.longest_gap == pytest.approx(other.longest_gap)
        assert [(d.column, d.kind, d.times, d.samples, d.line) for d in one.damages] == [
            (d.column, d.kind, d.times, d.samples, d.line) for d in other.damages
        ]
    assert [j.line() for j in whole.joints] == [j.line() for j in chunked.joints]
    assert whole.processing == chunked.processing


@pytest.mark.parametrize(
    ("logged", "cutoff"), [(False, None), *rotating((True, 0.0), (True, None))]
)
def test_a_log_in_chunks_gives_the_fit_of_the_whole_log(logged, cutoff):
    """To 1e-9 of sigma: what the position filter forgot beyond a margin is 3e-13 of the motion."""
    processing = Processing(parallel_cutoff=cutoff)
    log = in_phase(noisy_log(logged=logged), processing)
    whole, chunked, told, told_chunked = both(log, processing)
    sigma = np.array([parameter.sigma for parameter in whole.parameters])
    np.testing.assert_allclose((chunked.beta - whole.beta) / sigma, 0.0, atol=1e-6)
    np.testing.assert_allclose(chunked.covariance, whole.covariance, rtol=1e-6)
    assert chunked.rows == whole.rows and chunked.samples == whole.samples
    assert chunked.relative_error == pytest.approx(whole.relative_error, rel=1e-9)
    # chunks of `ROWS`, or longer where the filters remember more than a few of their rows
    assert 2 <= chunked.reading["chunks"] <= -(-log.rows // ROWS)
    assert chunked.reading["passes"] == 1
    same_counts(told, told_chunked)
    assert any("chunks" in line for line in told_chunked.lines()[:4])


def test_a_chunk_is_filtered_as_the_whole_log_but_for_what_the_filter_forgot():
    """exp(-2.4 x 12) = 3e-13 of the leap that the extension at the margin's end makes."""
    random = np.random.default_rng(3)
    values = np.cumsum(random.normal(size=(6000, 2)), axis=0)
    for cutoff in (3.0, 30.0, 80.0):
        beside = margin(Processing(position_cutoff=cutoff, parallel_cutoff=0.0), 5e-3)
        whole = low_pass(values, 5e-3, cutoff)
        part = low_pass(values[3000 - beside : 4000 + beside], 5e-3, cutoff)
        left = np.abs(part[beside:-beside] - whole[3000:4000]).max()
        assert left < 1e-11 * np.ptp(values[3000 - beside : 4000 + beside])
        short = low_pass(values[3000 - beside // 8 : 4000 + beside // 8], 5e-3, cutoff)
        assert np.abs(short[beside // 8 : -(beside // 8)] - whole[3000:4000]).max() > 1e3 * left


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
    whole, chunked, told, told_chunked = both(damaged)
    for one, other in zip(told.logs, told_chunked.logs, strict=True):
        for name in ("rows", "missing", "saturated", "gaps", "pieces", "short"):
            assert getattr(one, name) == getattr(other, name), name
        assert [(d.column, d.kind, d.times) for d in one.damages] == [
            (d.column, d.kind, d.times) for d in other.damages
        ]
    assert chunked.rows == pytest.approx(whole.rows, abs=10)
    sigma = np.array([parameter.sigma for parameter in whole.parameters])
    assert np.abs((chunked.beta - whole.beta) / sigma).max() < 3.0


@pytest.fixture
def small_windows(monkeypatch):
    """A survey that sees little of a short log."""
    for name, value in (("WINDOW", 512), ("SECONDS", 1.0), ("WINDOWS", 4)):
        monkeypatch.setattr(sys.modules["modeler.observation.survey"], name, value)


def test_windows_choose_for_all_rows(small_windows):
    log = noisy_log(seconds=60.0)
    long = stream(ARM, [MemorySource(log)], rows=ROWS)
    reading = long.passes.to_json()
    assert 2 <= reading.pop("chunks") <= -(-log.rows // ROWS)
    assert reading == {"passes": 1, "rows": log.rows, "windows": 4, "rows_in_windows": 4 * 512}
    assert 0.1 < long.observation.used.sum() / long.data.rows.sum() < 0.2
    fit = identify_long(long)
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    assert np.sqrt(np.mean(((fit.beta - BETA) / sigma) ** 2)) < 2.5


@pytest.mark.parametrize("zero", [1.7e9, *rotating(-450.0)])
def test_the_zero_of_the_clock_changes_nothing(zero, monkeypatch):
    """Stamps differ by their rounding: 1e-13 s, or 2.4e-7 s where they count from 1970."""
    for name, value in (("WINDOW", 512), ("SECONDS", 0.0), ("WINDOWS", 8)):
        monkeypatch.setattr(sys.modules["modeler.observation.survey"], name, value)
    log = noisy_log(seconds=90.0)
    fast = log.time > 45.0  # half of the windows: their median must not hang on a digit
    q = np.where(fast[:, None], np.sin(7.0 * log.time)[:, None] * [0.5, 0.4], log.q)
    log = dataclasses.replace(log, q=q)
    moved = dataclasses.replace(log, time=log.time + zero)
    one, other = (stream(ARM, [MemorySource(each)], rows=ROWS) for each in (log, moved))
    assert one.observation.report.choices == other.observation.report.choices
    assert one.passes.to_json() == other.passes.to_json()
    assert one.data.rows.tolist() == pytest.approx(other.data.rows.tolist(), abs=2)
    first, second = identify_long(one), identify_long(other)
    sigma = np.array([parameter.sigma for parameter in first.parameters])
    assert np.abs((first.beta - second.beta) / sigma).max() < 1e-3


def test_steps_of_a_coarse_clock_are_those_of_a_fine_one():
    """Of 16 384 rows of 1 ms, the median step since 1970 would make 16 385."""
    time = np.arange(16_384) * 1e-3
    log = dataclasses.replace(noisy_log(seconds=5.0), time=time + 1.7e9)
    assert (len(time) - 1) * log.step == pytest.approx(time[-1], abs=1e-6)
    late = dataclasses.replace(log, time=np.concatenate([time, time + 100.0]) + 1.7e9)
    assert late.step == pytest.approx(1e-3, rel=1e-7)
    q = np.column_stack([np.sin(time), np.cos(time)])
    pieces, _ = split(dataclasses.replace(log, q=q, tau=q), 0, False)
    assert [len(piece.time) for piece in pieces] == [len(time)] and not pieces[0].resampled
    assert pieces[0].step == pytest.approx(1e-3, rel=1e-7)  # inertias go with its square
    for rounding in (1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.0 + 1e-8):  # 62.5 samples
        assert spacing(1e-3 * rounding, 6.4, None) == 63


@pytest.fixture
def any_machine(monkeypatch):
    """A stand-in has no reach to judge the unit of the time by, and values of no real machine."""
    for name in ("time_doubts", "_impossible"):
        monkeypatch.setattr(f"modeler.estimation.verdict.{name}", lambda *given: [])


def verdict_of(log):
    """Of the fit in chunks, and the fit."""
    long = stream(ARM, [MemorySource(log)], rows=ROWS)
    fit = identify_long(long)
    return with_verdict(ARM, long.observation, fit, data=long.data).verdict, fit


def test_what_the_windows_do_not_show_makes_a_fit_not_usable(small_windows, any_machine):
    """A torque wrong by half, in a thirtieth of the log, between two windows."""
    log = noisy_log(seconds=60.0)
    clean, _ = verdict_of(log)
    assert clean.usable and not [line for line in clean.doubts if "windows" in line]
    tau = log.tau.copy()
    tau[2400:2800, 0] *= 1.5
    wrong, fit = verdict_of(dataclasses.replace(log, tau=tau))
    assert fit.joints[0].relative_error > 0.03 and not wrong.usable
    assert "joint 1: all rows are described to" in wrong.line and "the windows to" in wrong.line


def test_no_verdict_promises_better_than_the_error_on_all_rows(small_windows, any_machine):
    log = noisy_log(seconds=60.0)
    tau = log.tau.copy()
    tau[2400:2800, 0] *= 1.003
    verdict, fit = verdict_of(dataclasses.replace(log, tau=tau))
    assert verdict.usable
    promised = float(verdict.line.split(" % on every joint")[0].rsplit(" ", 1)[1])
    most = max(joint.relative_error for joint in fit.joints)
    assert promised >= float(f"{100.0 * most:.3g}")


def test_noise_is_a_larger_share_of_slower_motion_and_no_doubt(small_windows):
    """Fast in the windows, slow between them: four times the relative error, the same in N m."""
    long = stream(ARM, [MemorySource(noisy_log())], rows=ROWS)
    fit = identify_long(long)
    errors = np.array([joint.relative_error for joint in fit.joints]) / 4.0
    assert not unexplained_joints(fit, CrossValidation(errors, 1.0, 9), np.array([0.25, 0.25]))
    assert len(unexplained_joints(fit, CrossValidation(errors, 1.0, 9), np.array([1.0, 4.0]))) == 2


def test_a_drive_limit_that_the_windows_reach_and_others_exceed_costs_a_second_pass(small_windows):
    """A chunk alone takes its largest torque for the limit; the whole log knows better."""
    log = noisy_log(seconds=60.0)
    tau = log.tau.copy()
    at = 3 * ROWS + 600  # a run of one value with leaps into and out of it, but below the largest
    tau[at : at + 8, 0] = 1.5 * tau[3 * ROWS - 200 : 4 * ROWS + 200, 0].max()
    tau[7 * ROWS + 10 : 7 * ROWS + 60, 0] = 3.0 * np.abs(tau[:, 0]).max()
    limited = dataclasses.replace(log, tau=tau)
    long = stream(ARM, [MemorySource(limited)], Processing(keep_damaged=True), rows=ROWS)
    assert long.passes.passes == 2
    seen = observe(ARM, [limited], Processing(keep_damaged=True))
    assert long.observation.report.logs[0].saturated == seen.report.logs[0].saturated == {"1": 50}


def test_a_joint_that_rests_where_windows_are_is_not_left_out(small_windows):
    log = noisy_log(seconds=60.0)
    moving = np.zeros(log.rows)
    moving[200:1000] = np.hanning(800)
    q = log.q.copy()
    q[:, 1] = 0.3 + 0.5 * moving * np.sin(8.0 * log.time)
    qd = np.gradient(q, log.step, axis=0)
    tau = ARM.base_regressor(q, qd, np.gradient(qd, log.step, axis=0)) @ BETA
    resting = dataclasses.replace(log, q=q, tau=tau + 0.01 * log.tau)
    long = stream(ARM, [MemorySource(resting)], rows=ROWS)
    assert long.passes.passes == 2
    assert 0.0 < long.observation.report.joints[1].speed_floor < np.inf
    assert long.data.rows[1] > 10


def test_windows_look_for_motion_in_a_log_that_mostly_rests(small_windows):
    log = noisy_log(seconds=120.0)
    moving = (np.arange(log.rows) // 700) % 6 == 1  # 3.5 s of every 21 s; no window's middle
    turn = np.cumsum(moving) * log.step
    like = noisy_log(seconds=float(turn[-1]) + 0.1)
    at = np.cumsum(moving).clip(0, like.rows - 1)
    resting = dataclasses.replace(log, q=like.q[at], tau=like.tau[at])
    long = stream(ARM, [MemorySource(resting)], rows=ROWS)
    assert long.observation.used.sum() > 20


def test_windows_that_all_rest_need_the_whole_log(small_windows):
    log = noisy_log(seconds=120.0)
    q = np.tile(log.q[:1], (log.rows, 1))
    q[400:480] = log.q[400:480]
    with pytest.raises(WholeLogNeeded, match="found in the 4 windows by which long"):
        stream(ARM, [MemorySource(dataclasses.replace(log, q=q))], rows=ROWS)


def test_what_is_wrong_in_one_window_is_not_said_of_all(small_windows):
    """One value that cannot be, in the first of four windows."""
    log = noisy_log(seconds=60.0)
    tau = log.tau.copy()
    tau[1600, 0] = 1e15
    with pytest.raises(WholeLogNeeded, match=r"tau of joint 1 is 1e\+15 at 8 s") as told:
        stream(ARM, [MemorySource(dataclasses.replace(log, tau=tau))],
               Processing(keep_damaged=True), rows=ROWS)  # fmt: skip
    assert "all windows" not in str(told.value)


def test_a_time_that_changes_its_unit_is_told_by_the_windows(small_windows, monkeypatch):
    log = noisy_log(seconds=60.0)
    time = log.time.copy()
    time[6000:] = time[6000] + 1e3 * (time[6000:] - time[6000])
    monkeypatch.setattr(streamed.by_threads, "__defaults__", (None,))  # no row is reduced
    with pytest.raises(DataError, match=r"column time: a row every 0\.005 s at 7\.5 s and every"):
        stream(ARM, [MemorySource(dataclasses.replace(log, time=time))], rows=ROWS)


def test_a_logger_that_is_slow_while_the_robot_rests_has_one_unit(small_windows):
    log = noisy_log(seconds=60.0)
    time, q = log.time.copy(), log.q.copy()
    time[9000:] = time[9000] + 200.0 * (time[9000:] - time[9000])
    q[9000:] = q[9000]
    slow = dataclasses.replace(log, time=time, q=q)
    assert survey(ARM, [MemorySource(slow)], Processing(), FactsSoFar(), ROWS).windows == 4


def test_another_zero_of_an_encoder_needs_the_whole_log():
    log = noisy_log()
    q = log.q.copy()
    q[3 * ROWS :, 0] += 0.7
    with pytest.raises(
        WholeLogNeeded, match=r"q1 counts from another zero from 15\.36 s on.*@:15.36"
    ):
        stream(ARM, [MemorySource(dataclasses.replace(log, q=q))], rows=ROWS)


def test_threads_change_nothing_and_chunks_can_be_sent_away(monkeypatch):
    log = noisy_log()
    one = stream(ARM, [MemorySource(log)], rows=ROWS)
    monkeypatch.setattr("modeler.estimation.long_logs.cpu_count", lambda: 5)
    many = stream(ARM, [MemorySource(log)], rows=ROWS)
    np.testing.assert_array_equal(one.data.triangles, many.data.triangles)
    source = MemorySource(log)
    chosen = survey(ARM, [source], Processing(), FactsSoFar(), ROWS).chosen[0]
    parts = []
    for chunk in chunks(source, chosen.own, chosen.beside):
        sent = pickle.loads(pickle.dumps((chunk, chosen)))
        parts.append(pickle.loads(pickle.dumps(reduce_chunk(ARM, *sent))))
    np.testing.assert_array_equal(
        reduce(Partial.merged_with, parts).data.triangles, one.data.triangles
    )


def test_an_error_or_an_interrupt_ends_the_threads(monkeypatch):
    log, begun = noisy_log(), []

    def broken(model, chunk, chosen):
        begun.append(chunk.number)
        if chunk.number == 1:
            raise KeyboardInterrupt
        return reduce_chunk(model, chunk, chosen)

    monkeypatch.setattr(streamed.by_threads, "__defaults__", (broken,))
    monkeypatch.setattr("modeler.estimation.long_logs.cpu_count", lambda: 1)
    with pytest.raises(KeyboardInterrupt):
        stream(ARM, [MemorySource(log)], rows=512)
    assert len(begun) < 6 < log.rows / 512


def test_sigmas_of_windows_are_those_of_all_rows(small_windows):
    """Coloured residuals: the factor on the sigmas of all rows, from a sixth of them."""
    log = noisy_log(seconds=80.0)
    pole = np.exp(-log.step / 0.2)
    white = np.random.default_rng(8).normal(size=log.tau.shape)
    noise = np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)
    log = dataclasses.replace(log, tau=log.tau + noise)
    whole = identify(observe(ARM, [log]))
    long = identify_long(stream(ARM, [MemorySource(log)], rows=ROWS))
    ratio = np.sqrt(np.diag(long.covariance) / np.diag(whole.covariance))
    assert np.all((ratio > 0.5) & (ratio < 2.0)) and np.median(ratio) == pytest.approx(1, abs=0.25)
    assert long.essential is not None


@pytest.mark.parametrize("each", [1.25, *rotating(2.0, 3.3)])
def test_rows_that_repeat_are_left_out_of_chunks_as_of_the_whole_log(each):
    """A recorder that is `each` times as fast as the robot; its rows lie elsewhere."""
    log = noisy_log(rate=100)
    rows = (np.arange(int(each * log.rows)) / each).astype(int)
    time = np.arange(len(rows)) / (100.0 * each)
    whole, chunked, told, told_chunked = both(dataclasses.replace(cut(log, rows), time=time))
    (one,), (other,) = told.logs, told_chunked.logs
    assert [d.line for d in one.damages] == [d.line for d in other.damages]
    assert len(one.damages) == 1 and "gave about 100 rows a second" in one.damages[0].line
    assert one.samples == pytest.approx(other.samples, rel=0.02)
    assert (one.decimation, one.resampled) == (other.decimation, other.resampled)
    sigma = np.array([parameter.sigma for parameter in whole.parameters])
    assert np.abs((chunked.beta - whole.beta) / sigma).max() < 3.0
    found = [parameter.sigma for parameter in chunked.parameters]
    np.testing.assert_allclose(found, sigma, rtol=0.3)


def written_in_parts(path, rows, part=100_000):
    """Noise on a motion that no fit has to like, at 1 kHz."""
    random, writer = np.random.default_rng(1), None
    for first in range(0, rows, part):
        time = np.arange(first, first + part) * 1e-3
        noise = random.normal(scale=0.1, size=(2, part))
        q = np.stack([np.sin(0.7 * time), np.cos(1.1 * time)]) + 1e-4 * noise
        table = pa.table({"time": time, "q1": q[0], "q2": q[1], "tau1": 5.0 * q[0] + noise[0],
                          "tau2": 2.0 * q[1] + noise[1]})  # fmt: skip
        writer = writer or pa.parquet.ParquetWriter(path, table.schema)
        writer.write_table(table)
    writer.close()


_MEMORY = """
import resource, sys
from modeler.cli import main
main(["fit", "two-link", sys.argv[1], "--out", sys.argv[2]])
print("peak:", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
"""


@rotating_with("memory of long logs")
def test_memory_does_not_grow_with_the_log(tmp_path):
    """Peak memory of a fit of 300 000 and of 1 200 000 rows: within 30 MB; read, they are 48 MB."""
    peaks = []
    for rows in (300_000, 1_200_000):
        path = tmp_path / f"run{rows}.parquet"
        written_in_parts(path, rows)
        words = [sys.executable, "-c", _MEMORY, str(path), str(tmp_path / "m.json")]
        done = subprocess.run(words, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr
        assert "chunks" in done.stdout
        peaks.append(int(done.stderr.rsplit("peak:", 1)[1]) / 1024)
    assert peaks[1] - peaks[0] < 30.0, peaks


def test_logs_of_other_columns_are_reported_together():
    """One with logged velocities, one without: their samples add up all the same."""
    logs = [noisy_log(logged=logged, seed=logged) for logged in (True, False)]
    long = stream(ARM, [MemorySource(log) for log in logs], rows=ROWS)
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
    q, qd, qdd = (x.sum(2) for x in (np.sin(angle) * a, np.cos(angle) * a * w,
                                     -np.sin(angle) * a * w * w))  # fmt: skip
    if model.spec.closure is not None:
        q = q + [model.spec.closure.home[i] for i in model.spec.closure.given]
    tau = model.inverse_dynamics(q, qd, qdd, rng.uniform(0.5, 2.0, len(model.spec.base)))
    pole = np.exp(-1.0 / (PASSED_RATE * memory)) if memory else 0.0
    noise = np.sqrt(1 - pole**2) * lfilter([1.0], [1.0, -pole], rng.normal(size=q.shape), axis=0)
    tau = tau + 0.05 * np.std(tau, axis=0) * noise
    tau[700:720, 0] = np.nan
    return Log("x.csv", tuple(j.name for j in model.spec.joints), time, q, tau, qd, qdd)


def fitted(
    model: CompiledModel, log: Log, processing: Processing, method: Any
) -> tuple[Observation, FitResult]:
    observation = observe(model, [log], processing)
    result = identify(observation, method, model)
    return observation, with_verdict(model, observation, result)


def same(kept: Any, passed: Any, where: str = "") -> None:
    """Equal but for the rounding of numbers."""
    if isinstance(kept, dict):
        assert kept.keys() == passed.keys(), where
        for key in kept:
            same(kept[key], passed[key], f"{where}.{key}")
    elif isinstance(kept, list | tuple):
        assert len(kept) == len(passed), where
        for one, other in zip(kept, passed, strict=True):
            same(one, other, where)
    elif isinstance(kept, float):
        assert passed == pytest.approx(kept, rel=1e-9, abs=1e-12), where
    else:
        assert passed == kept, where


PLAIN = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=1, derivatives="log")
THIRD = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=3, derivatives="log")
SMOOTH = Processing(position_cutoff=0.0, parallel_cutoff=20.0, derivatives="log")


@pytest.mark.digits
@pytest.mark.parametrize(
    ("name", "processing", "memory", "method"),
    [
        ("wrist", PLAIN, 0.2, "weighted"),  # residuals that remember
        ("wrist", SMOOTH, 0.1, "ordinary"),
        ("five-bar", PLAIN, 0.0, "weighted"),
        *rotating(("wrist", THIRD, 0.0, "weighted"), ("wrist", PLAIN, 0.0, "ordinary")),
    ],
)
def test_a_fit_without_w_is_the_fit_with_it(monkeypatch, name, processing, memory, method):
    model = compiled(name)
    log = passed_log(model, memory, 1.0 if name == "wrist" else 0.1)
    kept, expected = fitted(model, log, processing, method)
    monkeypatch.setattr(passing, "KEPT", 0)
    monkeypatch.setattr(stretch, "_BLOCK", 50)  # fewer samples than lags
    observation, found = fitted(model, log, processing, method)
    assert len(kept.stretches) == 2 and not kept.used.all()
    assert "columns" in vars(kept) and "columns" not in vars(observation)
    same(expected.to_json(), found.to_json())


@pytest.mark.parametrize("processing", [PLAIN, THIRD, SMOOTH])
def test_rows_are_picked_and_explained_without_w(monkeypatch, processing):
    model = compiled("wrist")
    log = passed_log(model, 0.0)
    kept = observe(model, [log], processing)
    columns, rows = kept.columns, thinned(model, kept)
    monkeypatch.setattr(passing, "KEPT", 0)
    observation = observe(model, [log], processing)
    np.testing.assert_array_equal(thinned(model, observation).W, rows.W)
    beta = np.arange(1.0, columns.shape[2] + 1)
    scale = np.abs(columns * beta).max()
    keep = np.arange(len(columns))[:, None] % 3 == [0, 1, 1]
    for own in (keep | True, keep, keep & False):
        found = passing.fitted_torque(observation, beta, own)
        assert np.abs(found - np.where(own, columns @ beta, 0.0)).max() < 1e-12 * scale
    assert passing.is_streamed(observation)


def test_a_regressor_of_another_kind_is_kept(monkeypatch):
    """One that picks columns of the robot's: no compiled function evaluates it."""
    model = compiled("wrist")
    observation = observe(model, [passed_log(model, 0.0)], PLAIN)
    whole = observation.regressor
    assert isinstance(whole, Evaluated)
    fewer = dataclasses.replace(
        observation,
        names=observation.names[2:],
        units=observation.units[2:],
        regressor=lambda segment, window: whole(segment, window)[..., 2:],
    )
    expected = identify(dataclasses.replace(fewer))
    monkeypatch.setattr(passing, "KEPT", 0)
    found = identify(fewer)
    assert "columns" in vars(fewer)
    same(expected.to_json(), found.to_json())


def test_a_method_that_reads_rows_has_them(monkeypatch):
    model = compiled("wrist")
    log = passed_log(model, 0.0)
    _, expected = fitted(model, log, PLAIN, "robust")
    monkeypatch.setattr(passing, "KEPT", 0)
    observation, found = fitted(model, log, PLAIN, "robust")
    assert "columns" in vars(observation)
    same(expected.to_json(), found.to_json())
