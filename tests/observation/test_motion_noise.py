"""The noise of the motion against what was put there, and the cut-offs and sigmas that follow."""

import numpy as np
import pytest

from modeler.core.manifest import JointSpec
from modeler.estimation.identify import identify
from modeler.numerics.filters import forwards_and_backwards
from modeler.observation.log import Log
from modeler.observation.motion_noise import motion_noise
from modeler.observation.observe import observe
from modeler.observation.segments import split
from tests.fleet.machines import compiled, motion, parameters

JOINT = JointSpec("1", "revolute", "rad", "N m", True, None)


def smooth(time, seed=0):
    """A motion up to 2 Hz."""
    draw = np.random.default_rng(seed)
    return sum(
        draw.normal() / f * np.sin(2 * np.pi * f * time + draw.uniform(0.0, 6.0))
        for f in (0.2, 0.5, 0.9, 1.4, 2.0)
    )


def noise_of(q, rate, band=2.0):
    time = np.arange(len(q)) / rate
    log = Log("a", ("1",), time, q[:, None], q[:, None])
    return motion_noise([JOINT], split(log, 0, False)[0], np.array([band])).joints[0]


@pytest.mark.parametrize("rate", [200.0, 1000.0])
@pytest.mark.parametrize("size", [1e-5, 3e-4, 3e-3])
def test_the_floor_is_the_density_of_white_noise(rate, size):
    time = np.arange(round(20 * rate)) / rate
    white = np.random.default_rng(1).normal(0.0, size, len(time))
    found = noise_of(smooth(time) + white, rate)
    assert found.density == pytest.approx(2.0 * size**2 / rate, rel=0.3)
    assert found.deviation == pytest.approx(size, rel=0.15)
    assert 2.0 < found.hides_above_hz < 30.0 and found.colour == 0.0
    # what is differentiated below a cut-off has the noise that is told
    speed = np.gradient(forwards_and_backwards(white[:, None], 1 / rate, 20.0, 100)[:, 0], 1 / rate)
    assert found.speed_deviation(20.0) == pytest.approx(np.std(speed), rel=0.3)


def test_a_finer_encoder_hides_the_motion_later():
    time = np.arange(20000) / 1000.0
    counts = [2**12, 2**16, 2**20]
    found = [
        noise_of(np.round(smooth(time) * n / (2 * np.pi)) * (2 * np.pi / n), 1e3) for n in counts
    ]
    assert found[0].hides_above_hz < found[1].hides_above_hz < found[2].hides_above_hz
    for own, n in zip(found, counts, strict=True):
        step = 2 * np.pi / n
        assert own.step == pytest.approx(step, rel=1e-6)
        assert own.deviation == pytest.approx(step / np.sqrt(12.0), rel=0.4)


def test_exact_positions_have_no_noise_that_matters():
    time = np.arange(20000) / 1000.0
    found = noise_of(smooth(time), 1e3)
    assert found.cutoff == 80.0 and found.deviation < 1e-9


def test_noise_that_grows_towards_low_frequencies_is_told():
    time = np.arange(20000) / 1000.0
    f = np.maximum(np.fft.rfftfreq(len(time), 1e-3), 0.05)
    draw = np.random.default_rng(3).normal(0.0, 1e-4, len(time))
    coloured = np.fft.irfft(np.fft.rfft(draw) * (f / 100.0) ** -0.75)
    found = noise_of(smooth(time) + coloured, 1e3)
    assert found.colour == pytest.approx(1.5, abs=0.2)
    assert "growing as f^-1." in found.words()


def test_a_valley_between_two_lines_of_the_motion_is_no_floor():
    time = np.arange(20000) / 1000.0
    both = np.sin(2 * np.pi * 0.5 * time) + 0.01 * np.sin(2 * np.pi * 3.0 * time)
    white = np.random.default_rng(4).normal(0.0, 3e-4, len(time))
    assert noise_of(both + white, 1e3, 0.5).hides_above_hz > 3.0


def test_noise_of_logged_accelerations_lowers_the_parallel_filter_and_is_in_sigma():
    """White noise that no cut-off parts from the torque's: less of it bends inertias less."""
    model, z, cutoffs = compiled(), [], []
    for seed in range(4):
        rng, beta = np.random.default_rng([8, seed]), parameters(seed, model)
        time, q, qd, qdd = motion(rng, 2, 30.0)
        tau = model.base_regressor(q, qd, qdd) @ beta
        tau += 0.01 * np.std(tau, axis=0) * rng.normal(size=tau.shape)
        for size in (0.0, 2.0):
            seen = qdd + size * rng.normal(size=q.shape)
            found = observe(model, [Log("a", ("1", "2"), time, q, tau, qd=qd, qdd=seen)])
            cutoffs.append(found.report.processing.parallel_cutoff)
        fit = identify(found, "weighted", model)
        z.append((fit.beta - beta) / np.sqrt(np.diag(fit.covariance)))
        assert "noise of the logged accelerations" in "\n".join(found.report.lines())
    assert max(cutoffs[1::2]) < 0.8 * min(cutoffs[::2])
    assert np.sqrt(np.mean(np.square(z))) < 1.6
