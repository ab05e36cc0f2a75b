"""Leaps, wraps, spikes and repeated values: named with joint, time and size, and mended."""

import re
from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pyarrow.parquet as pq
import pytest
from rough_joint import KINDS, rough_log

from modeler.numerics.noise import can_depart, subtract_running_median
from modeler.regression.defects import can_jump, scan_jumps
from modeler.regression.faults import repair_log
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observe import observe
from modeler.regression.read import read_log
from modeler.regression.report import describe_damages
from tests.oracles.numpy_model import NumpyModel, Row, planar_arm, rotor, slider
from tests.regression.motions import fourier, manifest_of, noisy_torque, root_mean_square
from tests.rotation import rotating, with_cases

ARMS = {
    "slider": slider(),
    "rotor": rotor(),
    "planar": planar_arm(),
    "four": NumpyModel([Row(), Row(np.pi / 2), Row(d=0.4), Row(-np.pi / 2)]),
}


def repaired(log, spec):
    """The log mended of all that looks like a defect, and that in words."""
    mended, result, _ = repair_log(log, spec)
    confirmed = {"all channels repeated": 0.5}
    return mended, describe_damages(log, log.rows, spec, result, confirmed)


def drawn(random, name, rate=None, noise=None):
    """A log of Fourier motion of one of the arms, and the parameters that made its torques."""
    arm = ARMS[name]
    joints = len(arm.rows)
    rate = rate or random.choice([100, 200, 500, 1000, 2000])
    t = np.arange(int(6.0 * rate)) / rate
    t, q, qd, qdd = fourier(random, t, joints, 0.9, (0.2, 0.8), falling=True)
    tau, beta = noisy_torque(random, arm, q, qd, qdd, noise)
    counts = 2 * np.pi / 10 ** random.uniform(3.5, 6.0)
    measured = np.round((q + 0.3 * counts * random.normal(size=q.shape)) / counts) * counts
    return Log("run", tuple(j.name for j in arm.spec.joints), t, measured, tau), beta


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("rate", [100, *rotating(500, 2000)])
def test_honest_logs_are_left_as_they_are(name, rate):
    """Coulomb friction leaps at every reversal; noise and steps of the encoder are drawn."""
    for seed in range(2):
        log, _ = drawn(np.random.default_rng([seed, rate]), name, rate)
        mended, result = repaired(log, ARMS[name].spec)
        assert result == ()
        assert np.array_equal(mended.q, log.q) and np.array_equal(mended.tau, log.tau)
        assert mended.segment is None


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [0, *rotating(1)])
def test_blows_stops_sticking_and_kicks_are_physics(kind, seed):
    log = rough_log(seed, 1000, kind)
    spec = rotor().spec
    for every in (1, 2, 10):
        slower = replace(log, time=log.time[::every], q=log.q[::every], tau=log.tau[::every])
        assert repaired(slower, spec)[1] == ()


def leap(random, log, j, k, size):
    log.q[k:, j] += size * random.choice([-1, 1])


def spike(random, log, j, k, size):
    log.q[k : k + random.integers(1, 6), j] += size * random.choice([-1, 1])


def turn(random, log, j, k, size):
    log.q[k:, j] += 2 * np.pi * random.choice([-1, 1])


def wrap(random, log, j, k, size):
    log.q[:, j] = np.mod(log.q[:, j] - 0.5 * (log.q[k, j] + log.q[k - 1, j]), 2 * np.pi)


def glitch(random, log, j, k, size):
    low, high = np.quantile(log.tau[:, j], [0.01, 0.99])
    stop = k + random.integers(1, 4)
    log.tau[k:stop, j] += random.uniform(0.5, 5.0) * (high - low) * random.choice([-1, 1])


def frozen(random, log, j, k, size):
    log.q[k : k + random.integers(5, 25), j] = log.q[k, j]


def stuck(random, log, j, k, size):
    log.tau[k : k + round(0.3 / log.step), j] = log.tau[k, j]


def clipped(random, log, j, k, size):
    share = random.uniform(0.02, 0.08)
    np.clip(log.q[:, j], *np.quantile(log.q[:, j], [share, 1.0 - share]), out=log.q[:, j])


DEFECTS = {
    "zero": leap,
    "spike": spike,
    "turn": turn,
    "wrap": wrap,
    "glitch": glitch,
    "frozen": frozen,
    "stuck": stuck,
    "clipped": clipped,
}
NAMED = {"turn": {"wrap"}, "stuck": {"frozen"}, "glitch": {"spike"}, "zero": {"zero", "lost"}}


def damaged(random, defect, name):
    """A log with one defect: the log, its joint and its time; None where it would not show."""
    log, _ = drawn(random, name)
    j, k = int(random.integers(len(log.joints))), int(random.integers(40, log.rows - 60))
    top = np.quantile(np.abs(np.diff(log.q[:, j])), 0.98)
    size = max(10 ** random.uniform(np.log10(0.02), 0.0), 2.0 * top)
    if defect in ("turn", "wrap") and ARMS[name].spec.joints[j].kind == "prismatic":
        return None
    if defect == "frozen" and abs(log.q[k + 4, j] - log.q[k, j]) < 2.5 * top:
        return None  # it hardly moved: what was repeated was true
    if defect == "stuck" and abs(log.q[k + 40, j] - log.q[k, j]) < 0.02:
        return None
    DEFECTS[defect](random, log, j, k, size)
    if defect == "clipped":
        k = int(np.flatnonzero(log.q[:, j] == log.q[:, j].max())[0])
    if defect == "wrap":  # wherever it comes by: the first time counts, if it is not the start
        k = int(np.flatnonzero(np.abs(np.diff(log.q[:, j])) > 3.0)[0]) + 1
    return log, log.joints[j], log.time[k]


@pytest.mark.rotating
@pytest.mark.parametrize("defect", DEFECTS)
def test_defects_drawn_at_random_are_named_with_joint_and_time(defect):
    """Of 24 each at least 19, and nothing besides."""
    random, seen = np.random.default_rng(list(DEFECTS).index(defect)), Counter()
    while seen.total() < 24:
        name = str(random.choice(list(ARMS)))
        drawn_one = damaged(random, defect, name)
        if drawn_one is None:
            continue
        log, joint, time = drawn_one
        _, result = repaired(log, ARMS[name].spec)
        right = [
            one
            for one in result
            if one.kind in NAMED.get(defect, {defect})
            and one.joint == joint
            and (defect == "clipped" or min(abs(np.subtract(one.times, time))) < 3 * log.step)
        ]
        assert len(result) == len(right), [one.line for one in result]
        seen[bool(right)] += 1
    assert seen[True] >= 19


@pytest.mark.parametrize("each", [1.25, *rotating(3, 8)])
def test_rows_that_a_recorder_repeats_are_left_out(each):
    """The robot gives 125 rows a second, the recorder writes `each` times as many."""
    random = np.random.default_rng(round(10 * each))
    for name in ARMS:
        log, _ = drawn(random, name, 125, 1e-3)
        rows = (np.arange(int(each * log.rows)) / each).astype(int)
        again = replace(
            log, time=np.arange(len(rows)) / (125.0 * each), q=log.q[rows], tau=log.tau[rows]
        )
        mended, result = repaired(again, ARMS[name].spec)
        assert [one.kind for one in result] == ["repeated"]
        assert "gave about 125 rows a second" in result[0].line
        assert mended.rows == len(set(rows)) == len(rows) - result[0].samples
        seen = observe(ARMS[name], [again])
        assert not any("rings" in line for line in seen.report.collect_warnings())


def sample(defect, name="planar", joint=1, row=3000, size=0.5):
    """A quiet log of 1 kHz with one defect of known size."""
    log, beta = drawn(np.random.default_rng(3), name, 1000, 1e-3)
    q, tau = log.q, log.tau
    if defect == "spike":
        q[row : row + 3, joint] += size
    if defect == "zero":
        q[row:, joint] += size
    if defect == "wrap":
        cut = q[row, joint] + 1e-4
        q[:, joint] = cut + np.mod(q[:, joint] - cut, 2 * np.pi)
    if defect == "glitch":
        tau[row, joint] += 100.0 * size
    if defect == "lost":
        keep = np.r_[:row, row + 60 : log.rows]
        log = replace(log, time=log.time[: len(keep)], q=q[keep], tau=tau[keep])
    return log, beta


@cache
def clean_observation():
    return observe(planar_arm(), [drawn(np.random.default_rng(3), "planar", 1000, 1e-3)[0]])


LINES = dict(
    spike=r"q2: jumps by 0\.[45]\d* rad and back, at 3 s; 3 samples \(0\.05 % of the rows\) "
    r"not used, held-out error x 0\.\d\d; check the sensor",
    zero=r"q2: jumps by 0\.5 rad at 3 s and goes on from there; joined to the longest part, "
    r"held-out error x 0\.",
    wrap=r"q2: wraps by 2 pi rad, .* first at [\d.]+ s; unwrapped",
    glitch=r"tau2: spike of (49|50)[\d.]* N m, at 3 s, that no other joint shows; 1 sample "
    r"\(0\.0167 % of the rows\) not used, held-out error x 0\.",
    lost=r"q[12]: jumps along its motion by .*, at 3 s; no filter runs across, held-out error",
)


@pytest.mark.parametrize("defect", ["zero", *rotating("spike", "lost", "wrap", "glitch")])
def test_the_report_names_the_defect_and_the_rest_stays_usable(defect):
    model = planar_arm()
    log, beta = sample(defect)
    seen = observe(model, [log])
    text = "\n".join(seen.report.format_lines())
    lines = [line for line in text.splitlines() if line.startswith("  ")]
    assert any(re.search(LINES[defect], line) for line in lines), text
    assert "--keep-damaged uses all as logged" in text and "resampled" not in text
    (doubt, *_) = seen.report.collect_warnings()
    assert doubt.startswith("run: ")
    raw = observe(model, [log], Processing(keep_damaged=True))
    assert "all values are used as logged" in "\n".join(raw.report.format_lines())
    clean = clean_observation()
    honest = root_mean_square(clean, beta)
    assert root_mean_square(seen, beta) < 2.0 * honest
    assert root_mean_square(raw, beta) > 2.0 * root_mean_square(seen, beta) or defect == "glitch"
    assert seen.used.mean() > 0.9 * clean.used.mean()


def test_a_new_zero_is_joined_to_the_longest_stretch():
    log, _ = sample("zero", row=4000)
    whole, _ = drawn(np.random.default_rng(3), "planar", 1000, 1e-3)
    mended, (result,) = repaired(log, planar_arm().spec)
    assert (result.kind, result.size) == ("zero", pytest.approx(0.5, abs=0.01))
    assert np.max(np.abs(mended.q - whole.q)) < 0.01
    early, _ = sample("zero", row=1000)
    mended, _ = repaired(early, planar_arm().spec)
    assert np.allclose(mended.q[1000:], early.q[1000:])  # the later part is the longer one
    assert np.max(np.abs(mended.q[:1000] - whole.q[:1000] - [0.0, 0.5])) < 0.01


def test_where_rows_are_lost_a_piece_begins():
    log, _ = sample("lost")
    seen = observe(planar_arm(), [log])
    assert seen.report.logs[0].pieces == 2
    assert {part.segment.time[0] for part in seen.stretches} == {0.0, 3.0}


def test_spikes_of_logged_velocities_are_left_out():
    model = planar_arm()
    random = np.random.default_rng(8)
    log, _ = drawn(random, "planar", 500, 1e-3)
    qd = np.gradient(log.q, log.time, axis=0) + 1e-3 * random.normal(size=log.q.shape)
    qd[1000, 0] += 5.0
    log = replace(log, qd=qd)
    (result,) = repaired(log, model.spec)[1]
    assert (result.column, result.unit, result.times) == ("qd1", "rad/s", (2.0,))


@pytest.mark.measured
@with_cases(
    "folder",
    "panda",
    "tx40",
    *rotating("emps", "odrive_cogging", "ur10e", "dualarm7", "dvrk_psm", "kinova_gen3"),
)
def test_nothing_is_found_in_measured_logs(measured_folder, folder):
    """Each was looked at: that of panda repeats rows, none has another defect.

    Kicks, sticking and stops they do have.
    """
    logs = [
        path
        for path in sorted((measured_folder / folder).glob("*.parquet"))
        if "static_map" not in path.name and path.name != "log_motor.parquet"
    ]  # the others are no time series of joints
    assert logs
    for path in logs:
        columns = pq.read_schema(path).names
        names = [str(j) for j in range(1, 10) if f"q{j}" in columns]
        spec = manifest_of(names, {"emps": "1", "dvrk_psm": "3"}.get(folder, ""))
        result = repaired(read_log(path, spec), spec)[1]
        assert [one.kind for one in result] == ["repeated"] * (folder == "panda"), path.name


def test_what_is_passed_over_has_no_departure_and_no_leap():
    """Values that rise, stay and leap at random, so that all orders come; also at the ends."""
    random, passed = np.random.default_rng(9), 0
    for _ in range(300):
        walk = random.normal(size=60) * random.choice([0.0, 0.1, 1.0], 60)
        values = np.cumsum(walk) if random.random() < 0.5 else walk
        time = np.cumsum(random.uniform(0.5, 1.5, 60))
        floor = random.uniform(0.5, 4.0) * float(np.abs(np.diff(values)).max())
        if not can_depart(values, floor):
            passed += 1
            assert np.abs(subtract_running_median(values)).max() <= floor
        positions, least = values[:, None], np.array([floor])
        scan = scan_jumps(time, positions, np.ones(1, bool), np.zeros((60, 1)))
        if not can_jump(time, positions, least):
            passed += 1
            assert np.abs(scan.excess).max() <= floor and not scan.turns.any()
    assert 100 < passed < 500
