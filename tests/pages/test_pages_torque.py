"""Before and after, bands and rivals: what the page of a diagnosis shows of an effect."""

import numpy as np
import pytest

from modeler.core.figure import Band, Curve
from modeler.diagnosis.ranking import base_of
from modeler.report.effect_evidence import Evidence, covariance_of, evidence_of
from modeler.report.evidence import evidence_picture, rivals_of, rivals_table
from modeler.report.torque_picture import torque_picture, worst_stretch
from tests.captions import assert_all_named
from tests.diagnose.conftest import Case
from tests.diagnose.test_diagnose_effects import spring, stribeck
from tests.pages.test_pages_evidence import found


@pytest.fixture(scope="module")
def item(case: Case) -> Evidence:
    search = found(case, stribeck).search
    return evidence_of(search, search.steps[0])


def test_the_model_after_is_nearer_where_the_model_before_was_worst(item: Evidence) -> None:
    picture = torque_picture(item)
    above, below = (row[0] for row in picture.panels)
    assert all(isinstance(series, Curve) for series in (*above.series, *below.series))
    measured, before, after = (series.y for series in above.series)
    np.testing.assert_allclose(measured - before, below.series[0].y, atol=1e-9)
    np.testing.assert_allclose(measured - after, below.series[1].y, atol=1e-9)
    start, end = above.shade
    inside = (above.series[0].x >= start) & (above.series[0].x <= end)
    left = [np.sqrt(np.nanmean(series.y[inside] ** 2)) for series in below.series]
    assert left[1] < 0.3 * left[0]
    assert f"falls from {left[0]:.3g} to {left[1]:.3g} N m" in picture.caption
    assert_all_named(picture)


def test_no_other_half_second_is_worse(item: Evidence) -> None:
    log, start, end = worst_stretch(item)
    assert 0.3 < end - start <= 0.5
    time, square = item.without.rows.time[item.j], np.where(item.calm, item.before, 0.0) ** 2
    worst = square[(time >= start) & (time <= end)].sum()
    sums = [square[(time >= t) & (time <= t + 0.5)].sum() for t in time]
    assert worst == pytest.approx(max(sums))
    assert log == 0


def test_rivals_are_of_the_same_joint(item: Evidence) -> None:
    step = item.step
    assert {rival.candidate.joint for rival in rivals_of(step)} == {step.pick.joint}
    other = next(
        (r for r in step.rivals if r.candidate.joint != step.pick.joint), None
    )  # the search has some, the page does not
    assert other is not None
    rows = rivals_table(step).rows
    own = [step.pick.effect.id, *(r.candidate.effect.id for r in rivals_of(step)[:7])]
    assert [row[0] for row in rows] == own


@pytest.mark.parametrize("hold", [1, 10])
def test_a_law_is_as_sure_as_repetition_shows(hold: int) -> None:
    """80 draws of white noise, and of noise that lasts for half a block, on two joints."""
    random = np.random.default_rng(1)
    W = [random.normal(size=(600, 4)) + np.array([0.0, 0.0, 1.0, 0.0]) for _ in range(2)]
    W = [w.cumsum(axis=0) / np.sqrt(np.arange(1, 601))[:, None] for w in W]
    block, truth = np.repeat(np.arange(30), 20), np.array([1.0, -2.0, 0.5, 3.0])
    found, said = [], []
    for _ in range(80):
        noise = [np.repeat(random.normal(size=600 // hold), hold) for _ in W]
        y = [w @ truth + e for w, e in zip(W, noise, strict=True)]
        base = base_of(W, y, np.ones(2), [block, block], np.arange(30) % 8)
        theta = np.linalg.lstsq(np.vstack(W), np.concatenate(y), rcond=None)[0]
        found.append(theta)
        said.append(np.diag(covariance_of(base)))
    spread = np.std(found, axis=0)
    np.testing.assert_allclose(np.sqrt(np.mean(said, axis=0)), spread, rtol=0.25)


def test_a_spring_is_as_sure_as_its_coefficient(case: Case) -> None:
    """Its law is k (q - q0): far out its band grows as the deviation of k does."""
    diagnosis = found(case, spring)
    search = diagnosis.search
    step = next(s for s in search.steps if s.pick.effect.id == "spring")
    own = evidence_of(search, step)
    assert own.own_sigma is not None
    finding = next(f for f in diagnosis.effects if f.effect == "spring")
    widest = int(np.argmax(np.abs(own.bins.centre)))
    ratio = own.own_sigma[widest] / abs(own.bins.centre[widest])
    assert 0.3 < ratio / next(iter(finding.sigmas.values())) < 3.0


def test_the_band_is_drawn_and_named(item: Evidence) -> None:
    picture = evidence_picture(item)
    law = picture.panels[0][-1]
    bands = [series for series in law.series if isinstance(series, Band)]
    assert len(bands) == 1 and np.all((bands[0].high >= bands[0].low)[np.isfinite(bands[0].low)])
    assert "two standard deviations of the law" in picture.caption
    assert_all_named(picture)


def test_no_line_is_drawn_over_rows_that_do_not_count(item: Evidence) -> None:
    """Filtered rows of joint 2 leave out its reversals: the curves break there."""
    time = item.without.rows.time[item.j]
    step = np.median(np.diff(time))
    for row in torque_picture(item).panels:
        for series in row[0].series:
            whole = np.isfinite(series.y[:-1]) & np.isfinite(series.y[1:])
            assert np.all(np.diff(series.x)[whole] <= 1.5 * step)
