"""The low-pass of positions against scipy's."""

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from modeler.numerics.filters import forwards_and_backwards
from modeler.observation.motion import low_pass

# samples, cut-off in Hz, rate in Hz, padding, largest difference relative to the values
CASES = {
    "usual": (5000, 10.0, 1000.0, 200, 1e-11),
    "slow": (20_000, 0.5, 1000.0, 4000, 1e-9),
    "as far as it goes": (300, 0.05, 100.0, 299, 1e-9),
    "high": (1000, 400.0, 1000.0, 15, 1e-11),
    "beside Nyquist": (500, 499.0, 1000.0, 15, 1e-10),
    "few": (4, 20.0, 100.0, 3, 1e-11),
}


@pytest.mark.parametrize("case", CASES)
def test_it_is_that_of_scipy(case: str) -> None:
    samples, cutoff, rate, padding, bound = CASES[case]
    walk = np.random.default_rng(len(case)).normal(size=(samples, 3)).cumsum(axis=0) + 50.0
    theirs = sosfiltfilt(butter(4, cutoff, fs=rate, output="sos"), walk, axis=0, padlen=padding)
    ours = forwards_and_backwards(walk, 1.0 / rate, cutoff, padding)
    assert np.abs(ours - theirs).max() < bound * np.abs(walk).max()


def test_it_halves_at_the_cutoff_and_shifts_nothing() -> None:
    time = np.arange(20_000) * 1e-3
    wave = np.sin(2.0 * np.pi * 5.0 * time)
    passed = low_pass(wave, 1e-3, 5.0)
    inside = slice(5000, 15_000)
    assert passed.shape == wave.shape
    assert np.abs(passed - 0.5 * wave)[inside].max() < 1e-6


def test_what_stands_still_stays() -> None:
    still = np.full((100, 2, 2), 3.25)
    assert (low_pass(still, 1e-3, 20.0) == still).all()
    assert low_pass(still, 1e-3, 0.0) is still
