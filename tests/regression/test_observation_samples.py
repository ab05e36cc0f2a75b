"""Pieces, derivatives, the noise of the motion and the choice of filters, against closed forms."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.estimation.identify import identify
from modeler.numerics.channels import model_channel
from modeler.numerics.filters import apply_zero_phase_lowpass
from modeler.regression import prepare
from modeler.regression.log import Log, find_saturated, split_log
from modeler.regression.motion import ChosenProcessing, Processing, build_segment, read_processing
from modeler.regression.motion_noise import estimate_motion_noise
from modeler.regression.observe import observe
from tests.fleet.machines import compiled, motion, parameters
from tests.rotation import rotating

W0 = 2 * np.pi * 0.7  # rad/s


def log_of(time, q=None, tau=None, **more):
    q = np.sin(W0 * time)[:, None] if q is None else q
    tau = np.cos(W0 * time)[:, None] if tau is None else tau
    return Log("a.csv", ("1",), time, q, tau, **more)


def saturated(tau, q, logged=None):
    """Samples at a limit; `logged` is the torque before it was mended."""
    time = np.arange(len(q)) / 1000.0
    models = [model_channel(time, values) for values in (tau if logged is None else logged, q)]
    return find_saturated(tau, q, models)


def test_clipping_is_caught_and_clean_signals_are_not():
    t = np.arange(4000) / 1000.0
    noise = np.random.default_rng(0).normal(0, 0.01, t.shape)
    sine = np.sin(2 * np.pi * t)
    clipped = np.clip(1.5 * sine + noise, -1.0, 1.0)
    caught = saturated(clipped, t)
    assert caught.sum() > 0.9 * np.sum(np.abs(1.5 * sine) > 1.05)
    assert np.all(np.abs(clipped[caught]) == 1.0)
    one_sided = saturated(np.minimum(1.5 * sine, 1.0), t)
    assert one_sided.any() and not one_sided[sine < 0].any()
    switched = 10.0 * np.sign(np.round(sine))  # full torque, none, full torque back
    assert np.array_equal(saturated(switched, t), switched != 0.0)
    for resolution in (1e-4, 1e-3, 1e-2, 0.1):  # crests of 3 to 200 equal samples
        for scale in (1.0, 1.0 / 3.0):
            rounded = np.round(sine / resolution) * resolution * scale
            assert not saturated(rounded, t).any()
            assert not saturated(np.round((sine + noise) / resolution) * resolution, t).any()
    assert not saturated(np.full(100, 3.0), t[:100]).any()
    assert not saturated(np.array([np.nan] * 50), t[:50]).any()


def test_a_held_torque_and_that_of_a_joint_at_rest_are_not_at_a_limit():
    t = np.arange(4000) / 1000.0
    held = np.repeat(np.sin(2 * np.pi * t)[::20], 20)
    assert not saturated(held, t).any()
    fresh = np.random.default_rng(2).integers(-9, 10, 200)
    fresh[60:62] = 12  # twice the largest, which is a limit only where the log holds no value
    held, mended = np.repeat(fresh, 20), np.interp(t, t[::20], fresh)
    assert saturated(mended, t).any() and not saturated(mended, t, logged=held).any()
    random = np.random.default_rng(1)
    torque = np.where(t < 2.0, np.sin(9.0 * t) + 0.01 * random.normal(size=4000), 3.0)
    assert not saturated(torque, np.minimum(t, 2.0)).any()


def test_pieces_end_at_gaps_and_segment_changes():
    time = np.concatenate([np.arange(100), 200 + np.arange(50)]) * 0.01
    pieces, report = split_log(log_of(time), 0, False)
    assert [len(p.time) for p in pieces] == [100, 50]
    assert report.gaps == pytest.approx([2.0]) and report.widths == pytest.approx([1.01])
    assert not any(p.resampled for p in pieces) and report.jitter < 1e-9
    marked = log_of(np.arange(100) * 0.01, segment=np.repeat([0, 1, 2], [40, 57, 3]))
    pieces, report = split_log(marked, 0, False)
    assert [len(p.time) for p in pieces] == [40, 57]
    assert report.short == pytest.approx([0.97, 0.98, 0.99])


def test_short_losses_are_bridged_and_marked_long_ones_cut():
    time = np.arange(400) * 0.01
    q, tau = np.sin(W0 * time)[:, None], np.cos(W0 * time)[:, None]
    q[50:53] = np.nan  # 3 rows: bridged
    q[200:220] = np.nan  # 20 rows: a gap
    tau[300] = np.nan
    pieces, _ = split_log(log_of(time, q, tau), 0, False)
    assert len(pieces) == 2
    first, second = pieces
    np.testing.assert_allclose(first.time, time[:200], atol=1e-12)
    assert not first.valid[50:53].any() and first.valid[:50].all() and first.valid[53:].all()
    np.testing.assert_allclose(first.q[:, 0], np.sin(W0 * first.time), atol=1e-3)
    # 40 ms are longer than 0.4 periods of the filter: samples beside the bridge do not count. A
    # monotone cubic would bend there by 0.3 rad/s2.
    segment = build_segment(first, Processing(position_cutoff=30.0))
    counted = segment.valid[:, 0]
    wrong = np.abs(segment.qdd[:, 0] + W0**2 * np.sin(W0 * first.time))
    assert not counted[45:58].any() and wrong[49:54].max() < 0.05 and wrong[counted].max() < 0.15
    lost = np.flatnonzero(~second.valid[:, 0])
    np.testing.assert_allclose(second.time[lost], [3.0])
    assert np.isfinite(second.tau).all()


def test_jittered_stamps_come_out_on_a_uniform_grid():
    random = np.random.default_rng(1)
    time = np.cumsum(random.choice([0.008, 0.01, 0.012], 500))
    pieces, report = split_log(log_of(time), 0, False)
    piece = pieces[0]
    assert piece.resampled and report.jitter == pytest.approx(0.2)
    np.testing.assert_allclose(np.diff(piece.time), piece.step, rtol=1e-9)
    np.testing.assert_allclose(piece.q[:, 0], np.sin(W0 * piece.time), atol=3e-4)
    np.testing.assert_allclose(piece.tau[:, 0], np.cos(W0 * piece.time), atol=1e-3)
    assert piece.valid.all()


def test_derivatives_of_a_sine():
    time = np.arange(3000) * 1e-3
    piece = split_log(log_of(time), 0, False)[0][0]
    segment = build_segment(piece, Processing(position_cutoff=50.0))
    whole = segment.whole
    assert 0.95 < whole.mean() < 1.0
    expected = (np.sin(W0 * time), W0 * np.cos(W0 * time), -(W0**2) * np.sin(W0 * time))
    for got, want, scale, tolerance in zip(
        (segment.q, segment.qd, segment.qdd),
        expected,
        (1, W0, W0**2),
        (1e-5, 1e-4, 5e-3),
        strict=True,
    ):
        np.testing.assert_allclose(got[whole, 0], want[whole], atol=tolerance * scale)
    # No filter: central differences alone, one sample lost at each end.
    bare = build_segment(piece, Processing(position_cutoff=0.0))
    assert bare.whole.sum() == 2998
    np.testing.assert_allclose(bare.qdd[1:-1, 0], expected[2][1:-1], atol=1e-4 * W0**2)


def test_logged_derivatives_are_taken_as_asked():
    time = np.arange(1000) * 1e-3
    log = log_of(time, qd=np.full((1000, 1), 7.0), qdd=np.full((1000, 1), 9.0))
    processing = Processing(position_cutoff=50.0)
    both = build_segment(split_log(log, 0, True)[0][0], processing)
    assert np.all(both.qd == 7.0) and np.all(both.qdd == 9.0) and both.whole.all()
    speed = build_segment(split_log(dataclasses.replace(log, qdd=None), 0, True)[0][0], processing)
    np.testing.assert_allclose(speed.qd, 7.0)
    np.testing.assert_allclose(speed.qdd, 0.0, atol=1e-6)
    differentiated = build_segment(split_log(log, 0, False)[0][0], processing)
    assert np.max(np.abs(differentiated.qd)) < 5.0


def test_a_piece_that_is_all_edge_is_left_out():
    time = np.arange(20) * 1e-3
    pieces = split_log(log_of(time), 0, False)[0]
    assert build_segment(pieces[0], Processing(position_cutoff=30.0)) is None


def noise_in(*pieces):
    joints = [
        JointSpec(name, "revolute", "rad", "N m", True, None)
        for name in "1234567"[: pieces[0].q.shape[1]]
    ]
    return estimate_motion_noise(
        joints, pieces, prepare.estimate_joint_bands(pieces, prepare.compute_spectra(pieces))
    )


def band_of(piece):
    return noise_in(piece).band


def cutoffs_of(processing, *pieces):
    return prepare.choose_cutoffs(processing, pieces, noise_in(*pieces))


def rings_of(log):
    """Joints of a log that ring."""
    cuts, _ = split_log(log, 0, False)
    return prepare.find_ringing_joints(prepare.compute_spectra(cuts), [0.0] * len(log.joints), cuts)


def ringing_log(share, hertz, of=0.3):
    """Two joints; the second also rings with that share of its velocity's energy."""
    time = np.arange(20000) * 1e-3
    q = np.column_stack([np.sin(2 * np.pi * of * time), 0.2 * np.sin(2 * np.pi * 3.0 * time)])
    size = 0.2 * 3.0 / hertz * np.sqrt(share / (1.0 - share))
    q[:, 1] += size * np.sin(2 * np.pi * hertz * time)
    return Log("a", ("1", "2"), time, q + np.random.default_rng(2).normal(0.0, 1e-6, q.shape), q)


@pytest.mark.parametrize("share", [0.02, 0.17, 0.97])
def test_what_rings_far_above_the_motion_is_no_motion(share):
    piece = split_log(ringing_log(share, 93.0), 0, False)[0][0]
    (result,) = rings_of(ringing_log(share, 93.0))
    assert result.joint == 1
    assert result.frequency == pytest.approx(93.0, abs=0.1)
    assert result.share == pytest.approx(share, rel=0.02)
    assert "joint elbow rings at 93 Hz" in result.describe("elbow")
    assert band_of(piece) == pytest.approx(3.0, abs=0.15)


def test_what_is_no_ringing():
    """Little energy, a frequency near the motion, a robot that only shakes, or stands."""
    for share, hertz in ((0.001, 93.0), (0.5, 20.0)):
        assert rings_of(ringing_log(share, hertz)) == []
    time = np.arange(20000) * 1e-3
    log = log_of(time, np.sin(2 * np.pi * 60.0 * time)[:, None])
    piece = split_log(log, 0, False)[0][0]
    assert rings_of(log) == []
    assert band_of(piece) == pytest.approx(60.0, abs=0.5)
    still = log_of(time, np.full((len(time), 1), 0.4))
    assert band_of(split_log(still, 0, False)[0][0]) == 0.0


@pytest.mark.parametrize(
    ("hertz", "rate", "position", "parallel"),
    [(0.3, 1000, 80, 5), (3.0, 1000, 80, 12), (30.0, 5000, 240, 120), (3.0, 50, 20, 10)],
)
def test_automatic_cutoffs_follow_the_motion(hertz, rate, position, parallel):
    time = np.arange(20 * rate) / rate
    piece = split_log(log_of(time, np.sin(2 * np.pi * hertz * time)[:, None]), 0, False)[0][0]
    chosen = cutoffs_of(Processing(), piece)[0]
    assert chosen.position_cutoff == pytest.approx(position, rel=0.05)
    assert chosen.parallel_cutoff == pytest.approx(parallel, rel=0.05)
    inputs = Processing(position_cutoff=40.0, parallel_cutoff=7.0)
    read = cutoffs_of(inputs, piece)[0]
    assert (read.position_cutoff, read.parallel_cutoff, read.automatic_cutoffs) == (40.0, 7.0, ())
    assert chosen.automatic_cutoffs == ("position_cutoff", "parallel_cutoff")
    assert cutoffs_of(chosen, piece)[0] == chosen


def test_a_rate_too_low_for_the_motion_is_said():
    time = np.arange(400) / 20.0
    piece = split_log(log_of(time, np.sin(2 * np.pi * 3.0 * time)[:, None]), 0, False)[0][0]
    said = cutoffs_of(Processing(), piece)[1]
    assert any("less than 5 x the motion band of joint 1" in s for s in said)
    assert any("sample faster or move slower" in s for s in said)
    said = cutoffs_of(Processing(position_cutoff=8.0), piece)[1]
    assert any("give a higher --cutoff" in s for s in said)


def arm_log(noise=None, joint=3, joints=4, seed=5):
    """20 s at 200 Hz of joints that move to 0.6 Hz; noise (n,) on the position of one of them."""
    time, draw = np.arange(4000) / 200.0, np.random.default_rng(seed)
    q = np.zeros((len(time), joints))
    for j in range(joints):
        for f in (0.1, 0.2, 0.4, 0.6):
            q[:, j] += draw.normal() / f * np.sin(2 * np.pi * f * time + draw.uniform(0.0, 6.0))
        q[:, j] *= 0.5 / np.std(q[:, j])
    if noise is not None:
        q[:, joint] += noise
    return Log("a", tuple("1234567"[:joints]), time, q, q)


def noise_of(colour, size, seed=6):
    """20 s at 200 Hz of noise with that standard deviation."""
    noise = np.fft.rfft(np.random.default_rng(seed).normal(size=4000))
    f = np.fft.rfftfreq(4000, 0.005)
    gain = {
        "white": np.ones_like(f),
        "of a slow sensor": 1.0 / (1.0 + (f / 20.0) ** 8),
        "shaking": 1.0 / (1.0 + ((f - 18.0) / 2.0) ** 2),
        "pink": 1.0 / np.sqrt(np.maximum(f, 0.05)),
    }[colour]
    actual = np.fft.irfft(gain * noise)
    return size * actual / np.std(actual)


def first_piece(log):
    return split_log(log, 0, False)[0][0]


@pytest.mark.parametrize("colour", ["white", "of a slow sensor", "shaking", "pink"])
@pytest.mark.parametrize("joints", [2, 4])
def test_the_motion_band_does_not_follow_the_noise_of_a_joint(colour, joints):
    """Two joints cannot outvote one: pink noise of 5 mrad and more, without a gap, is motion."""
    quiet = band_of(first_piece(arm_log(joints=joints, joint=1)))
    assert quiet == pytest.approx(0.6, abs=0.05)
    sizes = (0.001, 0.003) if colour == "pink" and joints == 2 else (0.001, 0.003, 0.01)
    for size in sizes:
        noisy = arm_log(noise_of(colour, size), joint=1, joints=joints)
        assert band_of(first_piece(noisy)) == pytest.approx(quiet, abs=0.05), size


@pytest.mark.parametrize("colour", ["white", "of a slow sensor", "shaking"])
def test_joints_at_rest_do_not_count_whatever_their_noise(colour):
    log = arm_log()
    log.q[:, 1:] = 0.3 + np.column_stack([noise_of(colour, 1e-3, seed) for seed in range(3)])
    piece = first_piece(log)
    assert [joint.is_moving for joint in noise_in(piece).joints] == [True, False, False, False]
    assert band_of(piece) == pytest.approx(0.6, abs=0.05)
    said = cutoffs_of(Processing(), piece)[1]
    assert "joints 2, 3, 4 rest: not counted in the motion band" in said
    both = noise_in(piece, first_piece(arm_log()))
    assert all(joint.is_moving for joint in both.joints)


def test_a_commanded_joint_moves_no_faster_than_its_command():
    """Alone, a joint that shakes from 1 Hz on shows no gap: its command shows."""
    clean, noise = arm_log(joints=1), noise_of("pink", 0.03)
    shaken = arm_log(noise, joint=0, joints=1)
    assert band_of(first_piece(shaken)) > 2.0
    text = dataclasses.replace(shaken, commanded=clean.q)
    assert band_of(first_piece(text)) == pytest.approx(0.6, abs=0.05)
    unused = dataclasses.replace(shaken, commanded=np.zeros_like(clean.q))
    assert band_of(first_piece(unused)) == band_of(first_piece(shaken))


def test_a_motion_with_slow_and_fast_parts_is_motion():
    """A slow sweep, and strokes of a tenth of it at 3 Hz."""
    time = np.arange(20000) * 1e-3
    q = np.sin(2 * np.pi * 0.1 * time) + 0.1 * np.sin(2 * np.pi * 3.0 * time)
    assert band_of(first_piece(log_of(time, q[:, None]))) == pytest.approx(3.0, abs=0.1)


def test_processing_survives_json_and_refuses_nonsense():
    full = ChosenProcessing(
        30.0,
        5.0,
        4,
        "log",
        0.01,
        {"1": 0.2, "5+6": float("inf")},
        True,
        0.1,
        automatic_cutoffs=("parallel_cutoff",),
    )
    assert read_processing(full.to_json()) == full
    assert read_processing(Processing().to_json()) == Processing()
    for bad, words in (
        ({"derivatives": "best"}, 'derivatives is "best"; expected auto, log, position'),
        ({"cutoff": 1.0}, "processing has no setting cutoff"),
        ({"position_cutoff": "fast"}, "position_cutoff is fast; expected a number"),
        ({"speed_floors": [1]}, "expected numbers"),
        ({"delay": float("nan")}, "delay is nan; expected less than 1 s"),
    ):
        with pytest.raises(DataError, match=words):
            read_processing(bad)
    with pytest.raises(DataError, match=r"speed_floors is .*expected a speed by joint"):
        Processing(speed_floors=(0.1,))


JOINT = JointSpec("1", "revolute", "rad", "N m", True, None)


def smooth(time, seed=0):
    """A motion up to 2 Hz."""
    draw = np.random.default_rng(seed)
    return sum(
        draw.normal() / f * np.sin(2 * np.pi * f * time + draw.uniform(0.0, 6.0))
        for f in (0.2, 0.5, 0.9, 1.4, 2.0)
    )


def noise_found(q, rate, band=2.0):
    time = np.arange(len(q)) / rate
    log = Log("a", ("1",), time, q[:, None], q[:, None])
    return estimate_motion_noise([JOINT], split_log(log, 0, False)[0], np.array([band])).joints[0]


@pytest.mark.parametrize(
    ("rate", "size"), [(200.0, 1e-5), (1000.0, 3e-3), *rotating((1000.0, 1e-5), (200.0, 3e-4))]
)
def test_the_floor_is_the_density_of_white_noise(rate, size):
    time = np.arange(round(20 * rate)) / rate
    white = np.random.default_rng(1).normal(0.0, size, len(time))
    result = noise_found(smooth(time) + white, rate)
    assert result.density == pytest.approx(2.0 * size**2 / rate, rel=0.3)
    assert result.deviation == pytest.approx(size, rel=0.15)
    assert 2.0 < result.noise_crossover_hz < 30.0 and result.spectral_slope == 0.0
    # what is differentiated below a cut-off has the noise that is reported
    speed = np.gradient(
        apply_zero_phase_lowpass(white[:, None], 1 / rate, 20.0, 100)[:, 0], 1 / rate
    )
    assert result.compute_speed_deviation(20.0) == pytest.approx(np.std(speed), rel=0.3)


def test_a_finer_encoder_hides_the_motion_later():
    time = np.arange(20000) / 1000.0
    counts = [2**12, 2**16, 2**20]
    items = [
        noise_found(np.round(smooth(time) * n / (2 * np.pi)) * (2 * np.pi / n), 1e3) for n in counts
    ]
    assert items[0].noise_crossover_hz < items[1].noise_crossover_hz < items[2].noise_crossover_hz
    for item, n in zip(items, counts, strict=True):
        step = 2 * np.pi / n
        assert item.step == pytest.approx(step, rel=1e-6)
        assert item.deviation == pytest.approx(step / np.sqrt(12.0), rel=0.4)
    exact = noise_found(smooth(time), 1e3)
    assert exact.cutoff == 80.0 and exact.deviation < 1e-9


def test_noise_that_grows_towards_low_frequencies_is_told():
    time = np.arange(20000) / 1000.0
    f = np.maximum(np.fft.rfftfreq(len(time), 1e-3), 0.05)
    draw = np.random.default_rng(3).normal(0.0, 1e-4, len(time))
    coloured = np.fft.irfft(np.fft.rfft(draw) * (f / 100.0) ** -0.75)
    result = noise_found(smooth(time) + coloured, 1e3)
    assert result.spectral_slope == pytest.approx(1.5, abs=0.2)
    assert "growing as f^-1." in result.format_words()


def test_a_valley_between_two_lines_of_the_motion_is_no_floor():
    time = np.arange(20000) / 1000.0
    both = np.sin(2 * np.pi * 0.5 * time) + 0.01 * np.sin(2 * np.pi * 3.0 * time)
    white = np.random.default_rng(4).normal(0.0, 3e-4, len(time))
    assert noise_found(both + white, 1e3, 0.5).noise_crossover_hz > 3.0


def test_noise_of_logged_accelerations_lowers_the_parallel_filter_and_is_in_sigma():
    """White noise that no cut-off parts from the torque's: less of it bends inertias less."""
    model, z, cutoffs = compiled(), [], []
    for seed in range(2):
        rng, beta = np.random.default_rng([8, seed]), parameters(seed, model)
        time, q, qd, qdd = motion(rng, 2, 30.0)
        tau = model.base_regressor(q, qd, qdd) @ beta
        tau += 0.01 * np.std(tau, axis=0) * rng.normal(size=tau.shape)
        for size in (0.0, 2.0):
            seen = qdd + size * rng.normal(size=q.shape)
            log = Log("a", ("1", "2"), time, q, tau, qd=qd, qdd=seen)
            result = observe(model, [log], Processing(derivatives="log"))
            cutoffs.append(result.report.processing.parallel_cutoff)
        fit = identify(result, "weighted", model)
        z.append((fit.beta - beta) / np.sqrt(np.diag(fit.covariance)))
        assert "noise of the logged accelerations" in "\n".join(result.report.format_lines())
    assert max(cutoffs[1::2]) < 0.8 * min(cutoffs[::2])
    assert np.sqrt(np.mean(np.square(z))) < 1.6
