"""What noise does not do, from residuals made by hand."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from modeler.diagnose import diagnose
from modeler.diagnose.analyse import analysis_processing, bands_line
from modeler.diagnose.noise import knocking, lasting
from modeler.observation import Log, Processing
from tests.diagnose.conftest import Case

STEP = 0.0125
TIME = np.arange(3200) * STEP  # 40 s in two logs


def state(residual: np.ndarray) -> SimpleNamespace:
    run = (TIME >= 20.0).astype(int)
    processing = SimpleNamespace(parallel_cutoff=30.0)
    observation = SimpleNamespace(
        logs=("first", "second"), report=SimpleNamespace(processing=processing)
    )
    return SimpleNamespace(
        data=SimpleNamespace(observation=observation),
        residual=(residual,),
        rows=SimpleNamespace(run=[run], time=[TIME]),
        base=SimpleNamespace(block=[(TIME / 0.5).astype(int)]),
    )


def noise(seed: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=len(TIME))


def coloured(seconds: float) -> np.ndarray:
    """Noise that is forgotten within some seconds."""
    keep, drawn = np.exp(-STEP / seconds), noise()
    found = np.zeros_like(drawn)
    for k in range(1, len(drawn)):
        found[k] = keep * found[k - 1] + drawn[k]
    return found


@pytest.mark.parametrize("residual", [noise(), coloured(0.03), noise() * (1.0 + np.sin(TIME))])
def test_noise_neither_lasts_nor_knocks(residual: np.ndarray) -> None:
    assert lasting(state(residual), 0) < 0.1
    assert knocking(state(residual), 0) == 0.0


def test_a_brake_that_drags_lasts() -> None:
    dragging = 3.0 * (np.sin(0.4 * TIME) > 0.3) * np.sign(np.sin(0.9 * TIME))
    share = float(np.mean(dragging**2) / np.mean((noise() + dragging) ** 2))
    assert lasting(state(noise() + dragging), 0) == pytest.approx(share, abs=0.2)


def test_a_loose_part_knocks_and_does_not_last() -> None:
    knocks = 20.0 * noise(4) * (np.abs(np.sin(0.7 * TIME)) > 0.995)
    assert knocking(state(noise() + knocks), 0) > 0.85
    assert lasting(state(noise() + knocks), 0) < 0.2


def test_what_returns_is_a_share_of_the_variance() -> None:
    """A residual that grows, and rows far apart: between 0 and 1, and not blind."""
    assert lasting(state(np.exp(0.1 * TIME)), 0) == pytest.approx(1.0, abs=0.05)
    wide = state(np.ones(len(TIME)))
    wide.rows.time, wide.rows.run = [TIME[::20]], [wide.rows.run[0][::20]]
    wide.residual = (np.ones(len(TIME[::20])),)
    assert lasting(wide, 0) == pytest.approx(1.0)


def test_too_few_rows_say_nothing() -> None:
    few = state(noise())
    few.residual = (noise()[:50],)
    few.base.block = [few.base.block[0][:50]]
    assert knocking(few, 0) == 0.0


def test_noise_of_the_positions_is_told_with_what_helps(case: Case) -> None:
    def shaking(log: Log) -> Log:
        q = log.q + np.random.default_rng(6).normal(0.0, 5e-4, log.q.shape)
        return dataclasses.replace(log, q=q, qd=None, qdd=None)

    for log, told in ((shaking(case.train), 1), (case.train, 0)):
        diagnosis = diagnose(case.fitted(log), case.compiled, [log], most=0)
        lines = [line for line in diagnosis.data if "trembles" in line]
        assert len(lines) == told
        assert all("noise of the positions" in x and "--cutoff below" in x for x in lines)


def test_a_parallel_filter_that_was_given_rules_the_diagnosis():
    given = Processing(position_cutoff=30.0, parallel_cutoff=5.0, decimation=3)
    automatic = dataclasses.replace(given, chosen=("position_cutoff", "parallel_cutoff"))
    for fitted, band, lines in ((given, 5.0, 0), (automatic, 24.0, 1)):
        seen = analysis_processing(fitted)
        assert (seen.parallel_cutoff, seen.decimation) == (pytest.approx(band), None)
        said = bands_line(fitted, seen)
        assert len(said) == lines
        assert all("up to 24 Hz" in line and "fit up to 5 Hz" in line for line in said)
    low = dataclasses.replace(automatic, position_cutoff=10.0)
    assert analysis_processing(low).parallel_cutoff == pytest.approx(8.0)
