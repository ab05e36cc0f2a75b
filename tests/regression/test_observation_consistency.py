"""Logged velocities and accelerations that are the derivatives of the positions, or are not."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.regression.consistency import check_derivatives
from modeler.regression.log import Log, split_log
from modeler.regression.motion import Processing, read_processing
from modeler.regression.observe import observe
from modeler.regression.read import read_log
from tests.measured_sets.sets import DATA
from tests.oracles.numpy_model import NumpyModel, Row, planar_arm
from tests.rotation import rotating, with_cases

measured = pytest.mark.skipif(not DATA.is_dir(), reason=f"NOT CHECKED: no measured logs in {DATA}")


def sines(rate=100, seconds=20.0):
    """Two joints, (time, q, qd, qdd) in closed form."""
    t = np.arange(int(rate * seconds)) / rate
    w, a = 2 * np.pi * np.array([[0.3, 0.45], [0.8, 0.7]]), np.array([[1.0, 0.7], [0.2, 0.3]])
    angle = t[:, None, None] * w + np.array([[0.0, 1.0], [2.0, 0.5]])
    sine, cosine = np.sin(angle), np.cos(angle)
    return t, (a * sine).sum(1), (a * w * cosine).sum(1), -(a * w**2 * sine).sum(1)


def log_of(t, q, qd, qdd=None, **more):
    return Log("run", tuple(str(j + 1) for j in range(q.shape[1])), t, q, 1.0 + q, qd, qdd, **more)


def checked(log, cutoff=5.0, refuse=True):
    pieces, _ = split_log(log, 0, True)
    result = check_derivatives(log, pieces, cutoff, refuse)
    return result, np.concatenate(result.bad)


def switched(rate=100):
    """Acceleration +1, -1, 0 by turns, and its exact integrals: moving 10 % of the time."""
    t = np.arange(40 * rate) / rate
    phase = t % 10.0
    qdd = np.where(phase < 0.5, 1.0, np.where(phase < 1.0, -1.0, 0.0))
    qd = np.where(phase < 0.5, phase, np.where(phase < 1.0, 1.0 - phase, 0.0))
    q = np.where(phase < 0.5, phase**2 / 2, 0.25 - np.maximum(1.0 - phase, 0.0) ** 2 / 2)
    q = q + 0.25 * np.floor(t / 10.0)
    return t, q[:, None], qd[:, None], qdd[:, None]


def noisy(columns, q=0.0, qd=0.0, qdd=0.0):
    rng = np.random.default_rng(4)
    t, *values = columns
    return t, *(v + s * rng.normal(size=v.shape) for v, s in zip(values, (q, qd, qdd), strict=True))


def rounded(columns, q=1e-9, qd=1e-9, qdd=1e-9):
    t, *values = columns
    return t, *(np.round(v / s) * s for v, s in zip(values, (q, qd, qdd), strict=True))


def jittered(columns):
    """Rows where the clock happened to fall: values true, stamps irregular, 1e-4 rounding."""
    t, q, qd, qdd = rounded(sines(1000), q=1e-4, qd=1e-4)
    rows = np.cumsum(np.random.default_rng(2).choice([8, 10, 12], 1900))
    return t[rows], q[rows], qd[rows], qdd[rows]


HONEST = {
    "exact": sines(),
    "slowly sampled": sines(25),
    "fast": sines(1000),
    "switching": switched(),
    "switching, fast": switched(1000),
    "noisy positions": noisy(sines(), q=1e-3),
    "noisy velocities": noisy(sines(), qd=0.03),
    "very noisy velocities": noisy(sines(), qd=0.5),
    "a little noise": noisy(sines(), qd=0.01),
    "noisy accelerations": noisy(sines(), qdd=5.0),
    "rounded": rounded(sines(), 1e-4, 1e-4, 1e-2),
    "coarse": rounded(sines(), 5e-3, 2e-2, 0.2),
    "switching, rounded": rounded(switched(), 1e-3, 1e-3, 0.1),
    "noise at rest": noisy(
        tuple(v if k == 0 else 0 * v for k, v in enumerate(sines())), 1e-4, 1e-3, 1e-2
    ),
    "jitter": jittered(sines()),
}


@pytest.mark.parametrize("cutoff", [5.0, *rotating(0.0, 20.0)])
@pytest.mark.parametrize("case", HONEST)
def test_honest_logs_lose_nothing_and_nothing_is_said(case, cutoff):
    result, bad = checked(log_of(*HONEST[case]), cutoff)
    assert not bad.any() and result.contradictions == () and result.notes == ()


@pytest.mark.parametrize("unit", [1e-3, *rotating(1.0, 1e4)])
@pytest.mark.parametrize("case", ["exact", "a little noise", "rounded", "fast"])
def test_a_transient_of_an_estimator_is_found_where_it_is(case, unit):
    """As in logs whose accelerations start from a wrong state: large, and decaying."""
    t, q, qd, qdd = HONEST[case]
    size = np.sqrt(np.mean(qdd[:, 0] ** 2))
    defect = 3.0 * size * np.exp(-t / 0.2)
    spoilt = qdd.copy()
    spoilt[:, 0] += defect
    log = log_of(t, unit * q, unit * qd, unit * spoilt)
    result, bad = checked(log, 10.0)
    assert bad[defect > 0.7 * size].all()
    assert not bad[t > 1.0].any()
    (line,) = result.contradictions
    assert (line.column, line.of, line.samples) == ("qdd1", "qd1", bad.sum())
    assert line.largest == pytest.approx(3.0 * size * unit, rel=0.35) and line.time < 0.2
    assert line.largest > line.limit > 0.2 * size * unit


def test_every_piece_is_judged_by_itself():
    """No difference across the gap: a leap of the position there is no contradiction."""
    t, q, qd, qdd = sines()
    segment = np.repeat(np.arange(40), 50)
    q = q + segment[:, None]
    assert not checked(log_of(t, q, qd, qdd, segment=segment))[1].any()
    spoilt = qdd.copy()
    spoilt[500:506, 1] += 20.0  # the start of the eleventh piece
    _, bad = checked(log_of(t, q, qd, spoilt, segment=segment))
    assert bad[500:506].all() and bad[:500].sum() == 0 and bad[550:].sum() == 0


def test_contradicted_samples_reach_no_row_of_any_joint():
    model = planar_arm()
    t, q, qd, qdd = sines(200)
    beta = np.random.default_rng(5).uniform(0.5, 2.0, len(model.spec.base))
    tau = model.base_regressor(q, qd, qdd) @ beta
    spoilt = qdd.copy()
    spoilt[800:840, 1] += 30.0
    log = dataclasses.replace(log_of(t, q, qd, spoilt), tau=tau)
    seen = observe(model, [log])
    np.testing.assert_allclose(seen.W @ beta, seen.y, atol=1e-9)
    part = seen.stretches[0]
    assert not part.usable[800:840].any()  # joint 1 as well
    text = "\n".join(seen.report.format_lines())
    report = seen.report.logs[0]
    assert 40 <= report.contradicted < 100
    for words in (
        f"{report.contradicted} samples with impossible derivatives",
        "qdd2: ",
        "of qd2",
        "are not used: over a window",
        "8 robust",
        "25 %",
    ):
        assert words in text
    rows = observe(model, [log], Processing(derivatives="log", keep_contradicted=True))
    assert np.max(np.abs(rows.W @ beta - rows.y)) > 1.0
    assert "impossible derivatives are used" in "\n".join(rows.report.format_lines())
    again = read_processing(rows.report.processing.to_json())
    assert again.keep_contradicted


def test_a_wrong_velocity_takes_its_surroundings_with_it_where_it_is_differentiated():
    model = planar_arm()
    t, q, qd, qdd = sines(200)
    spoilt = qd.copy()
    spoilt[1000:1010, 0] += 3.0
    seen = observe(model, [log_of(t, q, spoilt)], Processing(position_cutoff=30.0))
    segment = seen.stretches[0].segment
    wrong = np.max(np.abs(segment.qdd - qdd), axis=1)
    counted = segment.valid[:, 0]
    assert wrong.max() > 50.0 and wrong[counted].max() < 0.3
    assert counted.mean() > 0.9


@pytest.mark.parametrize("samples", [1.0, 2.0, -1.5])
@pytest.mark.parametrize("columns", [sines(100), sines(500), rounded(sines(100), 1e-4, 1e-4, 1e-3)])
def test_a_delay_is_told_and_costs_no_sample(columns, samples):
    t, q, qd, _ = columns
    delay = samples * t[1]
    later = np.column_stack([np.interp(t - delay, t, v) for v in qd.T])
    result, bad = checked(log_of(t, q, later), 10.0)
    assert not bad.any()
    way = "lags behind" if samples > 0 else "runs ahead of"
    (note,) = result.notes
    assert (
        f"qd {way} the derivative of q by {abs(delay):.3g} s ({abs(samples):.2g} samples)" in note
    )


def test_a_delayed_switching_acceleration_is_told_and_kept():
    t, q, qd, qdd = switched()
    qdd[1:] = 0.5 * (qdd[1:] + qdd[:-1])  # at a switch between two samples neither early nor late
    result, bad = checked(log_of(t, q, qd, np.roll(qdd, 2, axis=0)))
    assert not bad.any() and len(result.notes) == 1
    delay = float(result.notes[0].split(" by ")[1].split(" s ")[0])
    assert delay == pytest.approx(0.02, abs=0.002)


def changed(column, change):
    t, q, qd, qdd = sines()
    values = {"qd": qd.copy(), "qdd": qdd.copy()}
    values[column] = change(values[column])
    return log_of(t, q, values["qd"], values["qdd"])


def first(factor):
    return lambda v: v * [factor, 1.0]


WRONG = {
    "degrees": (changed("qd", first(180 / np.pi)), "qd1 .* it is 57.3 times that: .*degrees"),
    "sign": (changed("qdd", first(-1.0)), r"qdd1 .* of qd1; it is -1 times that: is its sign"),
    "clock": (
        changed("qd", lambda v: 20.0 * v),
        "the logged speeds of all joints are 20 times .*"
        "the clock seems to be wrong by that factor, and the rows to come at",
    ),
    "exchanged": (changed("qdd", lambda v: v[:, ::-1]), "qdd1 .*; it is that of qd2: are columns"),
    "unplugged": (changed("qd", first(0.0)), "qd1 .*; it follows no q;"),
    "position in degrees": (changed("qd", first(np.pi / 180)), "qd1 .* position in degrees"),
    "motor side": (changed("qd", first(32.0)), "qd1 .* 32 times that: .* motor's side of the gear"),
    "noise": (
        changed("qd", lambda v: np.random.default_rng(1).normal(size=v.shape)),
        "qd1 .*; it follows no q;",
    ),
}


@pytest.mark.parametrize("case", [*[*WRONG][:5], *rotating(*[*WRONG][5:])])
def test_a_column_that_is_wrong_throughout_is_refused_with_a_guess(case):
    log, words = WRONG[case]
    model = planar_arm()
    with pytest.raises(DataError, match="^run: " + words) as error:
        observe(model, [log])
    assert "fit with --derivatives position" in str(error.value)
    if case == "degrees":
        assert observe(model, [log], Processing(derivatives="position")).used.any()
        assert observe(model, [log], Processing(keep_contradicted=True)).used.any()


def kinova(name):
    alpha = np.array([2, 1, -1, 1, -1, 1, -1]) * np.pi / 2
    r = [-0.28481, -0.01175, -0.42076, -0.01275, -0.31436, -0.00035, -0.10593]
    arm = NumpyModel([Row(a, r=x) for a, x in zip(alpha, r, strict=True)])
    return read_log(DATA / "kinova_gen3" / f"{name}.parquet", arm.spec)


@pytest.mark.measured
@measured
@pytest.mark.parametrize("number", [1, *rotating(2, 3, 4, 5)])
def test_the_transients_at_both_ends_of_measured_runs(number):
    """The source's accelerations start and end with a transient, its joint 4 most of all."""
    log = kinova(f"traj_{number}")
    pieces, _ = split_log(log, 0, True)
    result = check_derivatives(log, pieces, 20.0)
    counts = [int(bad.sum()) for bad in result.bad]
    assert not any(counts[2:-1])
    start = np.concatenate([p.time[b] for p, b in zip(pieces[:2], result.bad[:2], strict=True)])
    assert start.size >= 10 and start.max() < log.time[0] + 0.35
    assert sum(counts) < 0.04 * log.rows
    assert "qdd4" in {line.column for line in result.contradictions}
    assert result.notes == ()


@pytest.mark.measured
@measured
@with_cases(
    "name", "02_19_14harm50sec", *rotating("01_17-ptp_10_points", "01_22-joint_1", "01_22-joint_5")
)
def test_rounded_measured_velocities_are_believed(name):
    rows = [Row(), Row(1.0), Row(d=1.0), Row(d=1.0), Row(1.0), Row(1.0)]
    log = read_log(
        DATA / "ur10e" / f"ur-20_{name}.parquet", NumpyModel(rows, gains=(1.0,) * 6).spec
    )
    for cutoff in (5.0, 20.0):
        result, bad = checked(log, cutoff)
        assert not bad.any() and result.notes == ()
