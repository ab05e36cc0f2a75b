"""What noise does not do, from residuals made by hand."""

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.numerics.noise import (
    compute_noise_memory,
    estimate_burst_share,
    estimate_recurring_share,
    estimate_robust_deviation,
    estimate_white_noise,
)

STEP = 0.0125
TIME = np.arange(3200) * STEP  # 40 s in two logs


RUN = (TIME >= 20.0).astype(int)
BLOCK = (TIME / 0.5).astype(int)


def lasts(residual: np.ndarray) -> float:
    fit = estimate_recurring_share(TIME, residual, RUN, [compute_noise_memory(30.0)] * 2)
    assert fit is not None
    return fit


def noise(seed: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=len(TIME))


def coloured(seconds: float) -> np.ndarray:
    """Noise that is forgotten within some seconds."""
    return np.asarray(lfilter([1.0], [1.0, -np.exp(-STEP / seconds)], noise()))


@pytest.mark.parametrize("residual", [noise(), coloured(0.03), noise() * (1.0 + np.sin(TIME))])
def test_noise_neither_lasts_nor_knocks(residual: np.ndarray) -> None:
    assert lasts(residual) < 0.1
    assert estimate_burst_share(residual, BLOCK) == 0.0


def test_a_brake_that_drags_lasts() -> None:
    dragging = 3.0 * (np.sin(0.4 * TIME) > 0.3) * np.sign(np.sin(0.9 * TIME))
    share = float(np.mean(dragging**2) / np.mean((noise() + dragging) ** 2))
    assert lasts(noise() + dragging) == pytest.approx(share, abs=0.2)


def test_a_loose_part_knocks_and_does_not_last() -> None:
    knocks = 20.0 * noise(4) * (np.abs(np.sin(0.7 * TIME)) > 0.995)
    assert estimate_burst_share(noise() + knocks, BLOCK) > 0.85
    assert lasts(noise() + knocks) < 0.2


def test_what_returns_is_a_share_of_the_variance() -> None:
    """A residual that grows, and rows far apart: between 0 and 1, and not blind."""
    assert lasts(np.exp(0.1 * TIME)) == pytest.approx(1.0, abs=0.05)
    far = TIME[::20]
    assert estimate_recurring_share(far, np.ones(far.size), RUN[::20], [0.2, 0.2]) == pytest.approx(
        1.0
    )


def test_what_returns_in_the_next_lap() -> None:
    """Laps of 4 s in the first log only: half of its variance is the same in each."""
    residual = noise() + np.sqrt(2.0) * np.sin(2.0 * np.pi * 2.0 * TIME)
    assert estimate_recurring_share(TIME, residual, RUN, (4.0, 0.0)) == pytest.approx(0.5, abs=0.05)
    assert estimate_recurring_share(TIME, noise(), RUN, (4.0, 0.0)) == pytest.approx(0.0, abs=0.05)
    assert estimate_recurring_share(TIME, residual, RUN, (0.0, 0.0)) is None


def test_what_comes_back_by_chance_is_no_share() -> None:
    """Few rows of a narrow band, as many as a log of half a minute has."""
    few = slice(None, None, 8)
    chance = [
        estimate_recurring_share(TIME[few], noise(seed)[few], RUN[few], (0.4, 0.4))
        for seed in range(40)
    ]
    assert sum(share == 0.0 for share in chance) >= 34


def test_too_few_rows_say_nothing() -> None:
    assert estimate_burst_share(noise()[:50], BLOCK[:50]) == 0.0


def test_noise_is_told_from_what_is_far_off_and_from_motion() -> None:
    noise = 0.2 * np.random.default_rng(6).normal(size=20_000)
    noise[::50] = 30.0
    assert estimate_robust_deviation(noise) == pytest.approx(0.2, rel=0.05)
    smooth = np.sin(np.linspace(0.0, 20.0, len(noise)))
    clean = 0.2 * np.random.default_rng(7).normal(size=len(noise))
    assert estimate_white_noise(smooth + clean) == pytest.approx(0.2, rel=0.05)
