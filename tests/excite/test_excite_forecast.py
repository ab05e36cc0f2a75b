"""Expected accuracy of a motion, before it is run: forecast sigmas beside those of its logs."""

import numpy as np
import pytest

from modeler.api import excite, expected_sigmas
from modeler.api.motion import Encoders, build_subject, describe_expected_sigmas
from modeler.core.errors import DataError
from modeler.regression.log import Log
from tests.chain import chain_of

RATE, NOISE = 500.0, np.array([0.6, 0.2])  # Hz; N m, white


@pytest.fixture(scope="module")
def arm():
    """A function that fits logs of a two-link arm, its columns and values, and its noise's rng."""
    chain, rng = chain_of("two-link"), np.random.default_rng(20)
    compiled = chain.compiled
    beta = compiled.base_parameters([p.nominal for p in compiled.spec.standard])

    def fitted(columns: dict[str, np.ndarray], step: float):
        q, qd, qdd = (np.column_stack([columns[p + j] for j in "12"]) for p in ("q", "qd", "qdd"))
        tau = compiled.base_regressor(q, qd, qdd) @ beta + NOISE * rng.normal(size=q.shape)
        seen = np.floor(q / step) * step if step else q
        return chain.fit([Log("made", ("1", "2"), columns["time"], seen, tau)])

    return fitted


@pytest.fixture(scope="module")
def known(arm):
    """A model of a log without noise of positions, and a motion found for it."""
    at = np.arange(0.0, 20.0, 1.0 / RATE)
    columns = {"time": at}
    for j, phases in (("1", (0.3, 1.2)), ("2", (2.0, 0.7))):
        waves = [(1.0, 2.1, phases[0]), (0.4, 4.9, phases[1])]
        columns["q" + j] = sum(a * np.sin(w * at + p) for a, w, p in waves)
        columns["qd" + j] = sum(a * w * np.cos(w * at + p) for a, w, p in waves)
        columns["qdd" + j] = sum(-a * w**2 * np.sin(w * at + p) for a, w, p in waves)
    model = arm(columns, 0.0)
    return model, excite(model, duration=8.0, starts=1, seed=4)


def sigmas(fitted) -> np.ndarray:
    return np.array([parameter.sigma for parameter in fitted.parameters])


@pytest.mark.rotating("long tests of excite")
@pytest.mark.parametrize("counts", [0, 4096])
def test_forecast_sigmas_are_those_that_fits_find(arm, known, counts) -> None:
    model, motion = known
    result = expected_sigmas(model, motion, rate=RATE, counts=counts)
    step = 2.0 * np.pi / counts if counts else 0.0
    values = [arm(motion.sample_motion(RATE), step).fit for _ in range(4)]
    ratio = sigmas(result) / np.median([sigmas(each) for each in values], axis=0)
    assert ratio.min() > 0.7 and ratio.max() < 1.4
    cutoffs = [each.processing.parallel_cutoff for each in values]
    assert result.processing.parallel_cutoff == pytest.approx(np.median(cutoffs), rel=0.25)


def test_a_coarse_encoder_costs_sigma_and_white_noise_as_much(known) -> None:
    """The noise of 512 counts a turn is uniform within a step, of deviation step / sqrt 12."""
    model, motion = known
    exact, coarse = (expected_sigmas(model, motion, rate=RATE, counts=c) for c in (0, 512))
    like = expected_sigmas(model, motion, rate=RATE, noise=2.0 * np.pi / 512 / 12**0.5)
    assert coarse.processing.position_cutoff < exact.processing.position_cutoff
    costs = np.log(sigmas(coarse) / sigmas(exact))
    assert np.mean(costs) > 0.1 and costs.min() > -0.1
    assert np.exp(np.mean(np.log(sigmas(coarse) / sigmas(like)))) < 2.0


def test_positions_of_joints_that_slide_have_no_turns() -> None:
    q = np.array([[0.0101, 0.0101], [0.0139, 0.0139]])
    seen = Encoders(500).quantise_positions(q, ["rad", "m"], np.random.default_rng(0))
    assert np.allclose(seen[:, 0], 2.0 * np.pi / 500) and np.array_equal(seen[:, 1], q[:, 1])
    for encoders in (Encoders(-1), Encoders(0, float("nan"))):
        with pytest.raises(DataError, match="expected neither below 0"):
            encoders.quantise_positions(q, ["rad", "m"], np.random.default_rng(0))


def test_a_log_that_could_not_be_fitted_is_told_in_a_line(known) -> None:
    """Eight seconds at 1 Hz: fewer rows than the filters need."""
    model, motion = known
    line, raw = describe_expected_sigmas(build_subject(model), motion, 1.0, Encoders(100, 1e-4))
    assert raw is None and "of 100 counts a turn and with noise of 0.0001 rad (m)" in line
    assert "it cannot be fitted: no more than 8 s" in line
