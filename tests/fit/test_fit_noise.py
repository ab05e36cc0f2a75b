"""Noise of the positions: sigmas hold it, and what it would have bent is said.

The machine is simulated here: J qdd + Fv qd + Fs sign(qd) + Off, by the true motion, with 2 % of
white noise on the torque.
"""

import numpy as np
import pytest

from modeler.regression.log import Log
from tests.chain import chain_of
from tests.rotation import rotating

STAGE = """
name = "stage"
gravity = [0, 0, 0]
effects = {viscous = "all", coulomb = "all", offset = "all"}
[mdh]
columns = ["j", "a", "alpha", "d", "theta", "r"]
rows = [["1", "0", 0, 0, "q1", 0]]
"""
RATE, SECONDS = 1000.0, 20.0


def machine(draw):
    """Values of J, Fv, Fs and Off, and a motion up to 1.5 Hz: q, qd, qdd."""
    values = np.array([0.3, 0.5, 0.8, 0.1]) * draw.uniform(0.5, 1.5, 4)
    time = np.arange(round(RATE * SECONDS)) / RATE
    q, qd, qdd = np.zeros((3, len(time)))
    for f in (0.2, 0.45, 0.8, 1.1, 1.5):
        a, phase, w = draw.uniform(0.2, 0.5) / f**0.5, draw.uniform(0.0, 6.0), 2 * np.pi * f
        q += a * np.sin(w * time + phase)
        qd += a * w * np.cos(w * time + phase)
        qdd -= a * w**2 * np.sin(w * time + phase)
    return values, time, q, qd, qdd


def fitted(draw, measured):
    """The truth, and the fit to what is measured of the positions."""
    values, time, q, qd, qdd = machine(draw)
    tau = np.column_stack([qdd, qd, np.sign(qd), np.ones(len(q))]) @ values
    tau += draw.normal(0.0, 0.02 * np.std(tau), len(tau))
    log = Log("run", ("1",), time, measured(q, draw)[:, None], tau[:, None])
    fit = chain_of(STAGE).fit([log]).fit
    names = [parameter.name for parameter in fit.parameters]
    assert names == ["ZZ1", "Fv1", "Fs1", "Off1"]
    return values, fit


def counts(n):
    return lambda q, draw: np.round(q * n / (2 * np.pi)) * (2 * np.pi / n)


def white(size):
    return lambda q, draw: q + draw.normal(0.0, size, len(q))


def slow_noise(size):
    """Of a sensor that is slower than the motion's harmonics: 3 Hz."""

    def measured(q, draw):
        f = np.fft.rfftfreq(len(q), 1.0 / RATE)
        noise = np.fft.rfft(draw.normal(size=len(q))) / np.sqrt(1.0 + (f / 3.0) ** 8)
        noise = np.fft.irfft(noise)
        return q + noise * size / np.std(noise)

    return measured


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize(
    ("measured", "seed"), [*rotating((counts(2**20), 1), (counts(4096), 2)), (white(2e-3), 3)]
)
def test_sigmas_hold_the_noise_of_the_positions(measured, seed):
    """z = error over sigma of 10 machines: without it, 2 mrad alone give 5."""
    draw = np.random.default_rng(seed)
    z = []
    for _ in range(10):
        truth, fit = fitted(draw, measured)
        z.append((fit.beta - truth) / [parameter.sigma for parameter in fit.parameters])
    assert 0.5 < np.sqrt(np.mean(np.square(z))) < 1.4
    assert np.mean(np.abs(z) < 1.96) > 0.87


def test_what_the_noise_would_have_bent_is_said():
    _, fine = fitted(np.random.default_rng(4), counts(2**20))
    _, coarse = fitted(np.random.default_rng(4), white(5e-2))
    text = "the widest cut-offs and the chosen ones differ by"
    assert not any(text in line for line in fine.sentences)
    assert any(text in line and "sigma (" in line for line in coarse.sentences)
    assert coarse.processing.parallel_cutoff < fine.processing.parallel_cutoff
    assert coarse.bands.limiting_joint == "1" and fine.bands.limiting_joint is None
    assert fine.verdict.valid_for == "parameters"


def test_a_motion_that_is_mostly_noise_gives_no_values():
    _, fit = fitted(np.random.default_rng(5), slow_noise(0.3))
    assert fit.verdict.valid_for != "parameters"
    assert any("values may be biased towards zero" in line for line in fit.verdict.lines)
