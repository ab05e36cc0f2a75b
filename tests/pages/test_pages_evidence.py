"""What the page of a diagnosis shows of an effect: does it convince, is it called by its name?"""

import html
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.core.figure import Band, Curve, Means, Panel, Picture
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.ranking import build_gram_blocks
from modeler.diagnosis.result import Diagnosis
from modeler.numerics.least_squares import compute_joint_whitening
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from modeler.views import evidence
from modeler.views.diagnosis import build_diagnosis_page
from modeler.views.effect_evidence import (
    Evidence,
    build_bins,
    collect_evidence,
    compute_covariance,
    describe_residuals,
    find_inliers,
)
from modeler.views.page import write_page
from tests.captions import assert_all_named
from tests.diagnose.conftest import Case, demonstration, motion, on_joint
from tests.diagnose.test_diagnose_effects import motor_ripple, spring, stribeck
from tests.rotation import rotating, slow_rotating
from tests.texts import read_rows


@cache
def load_friction(case: Case) -> Callable[[Log], np.ndarray]:
    """0.08 of the load, by the links that a fit finds."""
    model = case.fitted(case.train)
    links = np.array([b.kind == "inertial" for b in case.compiled.spec.base]) * model.beta

    def torque(log: Log) -> np.ndarray:
        q, v = motion(log)
        load = case.compiled.inverse_dynamics(q, v, np.gradient(v, log.time, axis=0), links)
        return on_joint(log, 1, 0.08 * np.abs(load[:, 1]) * np.tanh(v[:, 1] / 0.002))

    return torque


HIDDEN: dict[str, tuple[Callable[..., np.ndarray], str]] = {
    "stribeck": (stribeck, "velocity [rad/s]"),
    "load_friction": (np.zeros_like, "|load| [N m]"),
    "spring": (spring, "position [rad]"),
    "motor_ripple": (motor_ripple, "place within one wave [deg]"),
}


@cache
def diagnosis_of(case: Case, torque: Callable[[Log], np.ndarray]) -> Diagnosis:
    """What is found of a hidden torque; several tests look at the same."""
    model, train, _ = case.hidden(torque)
    return diagnose(model, case.compiled, [train])


def panels(picture: Picture) -> dict[str, Panel]:
    return {panel.title: panel for panel in picture.panels[0]}


def series(panel: Panel, kind: type, label: str):
    return next(s for s in panel.series if isinstance(s, kind) and s.label.startswith(label))


@pytest.mark.parametrize(
    "effect", ["stribeck", *rotating("spring", "motor_ripple", "load_friction")]
)
def test_the_picture_convinces(case: Case, effect: str) -> None:
    torque, label = HIDDEN[effect]
    search = diagnosis_of(case, load_friction(case) if effect == "load_friction" else torque).search
    step = search.steps[0]
    assert step.candidate.effect.id == effect
    picture = evidence.draw_evidence_picture(collect_evidence(search, step))
    drawn = panels(picture)
    without, full = drawn["without the effect"], drawn["with it"]
    assert without.x_label == full.x_label == label
    assert ("sign of velocity" in without.y_label) == (effect == "load_friction")
    assert without.x_range == full.x_range and without.y_range == full.y_range
    before, after = (series(panel, Means, "mean") for panel in (without, full))
    assert 8 <= len(before.x) <= 60 and np.isfinite(before.error).all()
    size = np.sqrt(np.mean(before.y**2))
    assert np.sqrt(np.mean(after.y**2)) < 0.4 * size  # before and after differ
    curve = series(without, Curve, effect)
    at = np.isfinite(curve.y)
    missed = np.abs(before.y - curve.y[at]) > before.error
    assert np.mean(missed) < 0.2  # the curve passes within the error bars
    low, high = without.y_range
    inside = (curve.x[at] >= without.x_range[0]) & (curve.x[at] <= without.x_range[1])
    assert np.all((curve.y[at][inside] > low) & (curve.y[at][inside] < high))
    assert np.ptp(curve.y[at][inside]) > 0.3 * (high - low)  # and fills the picture
    assert_all_named(picture)
    assert_all_named(evidence.draw_play_picture(search.end, 0))
    if effect == "spring":  # the model imitates it, so that residuals do not show all of it
        means = series(drawn["model of the effect"], Means, "mean")
        slope, rest = np.polyfit(means.x, means.y, 1)
        assert slope == pytest.approx(1.5, rel=0.02)
        assert np.abs(means.y - slope * means.x - rest).max() < 0.02
    if effect == "motor_ripple":
        before, after = drawn["order spectrum"].series
        place = np.argmax(before.y)
        assert before.x[place] == pytest.approx(101.0, rel=0.01)
        assert after.y[place] < 0.1 * before.y[place]


@slow_rotating("pages of effects")
def test_a_spring_is_as_sure_as_its_coefficient() -> None:
    """Its law is k (q - q0): far out its band grows as the deviation of k does."""
    diagnosis = diagnosis_of(demonstration(1000.0, seconds=(30.0, 20.0)), spring)
    item = collect_evidence(diagnosis.search, diagnosis.search.steps[0])
    finding = next(f for f in diagnosis.effects if f.effect == "spring")
    widest = int(np.argmax(np.abs(item.bins.centre)))
    ratio = item.effect_torque_sigma[widest] / abs(item.bins.centre[widest])
    assert 0.3 < ratio / next(iter(finding.sigmas.values())) < 3.0


@pytest.fixture(scope="module")
def item(case: Case) -> Evidence:
    search = diagnosis_of(case, stribeck).search
    return collect_evidence(search, search.steps[0])


def test_figures_stand_by_the_picture(case: Case, item: Evidence, tmp_path: Path) -> None:
    text = describe_residuals(item)
    before, after, other = (float(size) for size in re.findall(r"([\d.]+) N m \(", text))
    assert after < 0.3 * before and after < 1.2 * other < before
    assert after == pytest.approx(float(np.sqrt(np.mean(item.after**2))), rel=0.2)
    page = write_page(tmp_path / "page.html", build_diagnosis_page(diagnosis_of(case, stribeck)))
    assert text in html.unescape(page.read_text())


@pytest.mark.rotating("long tests of pages")
def test_a_spike_flattens_nothing_and_is_told(case: Case) -> None:
    """40 ms of nonsense in a log: the axes stay, the rows are left out, a line says so."""

    def torn(log: Log) -> np.ndarray:
        torque = stribeck(log)
        torque[(log.time > 9.0) & (log.time < 9.04), 1] -= 350.0
        return torque

    quiet, loud = (diagnosis_of(case, torque) for torque in (stribeck, torn))
    assert [f.effect for f in loud.effects] == ["stribeck"]  # a spike is no push
    assert any("8.9 to 9.2 s: torques that come only once" in line for line in loud.data_warnings)
    pictures = [
        evidence.draw_evidence_picture(collect_evidence(s, s.steps[0]))
        for s in (quiet.search, loud.search)
    ]
    spans = [np.ptp(panels(p)["without the effect"].y_range) for p in pictures]
    assert spans[1] < 1.5 * spans[0]


def test_errors_count_what_neighbouring_rows_share() -> None:
    """White noise, and noise that stays for a second: 95 % of the intervals hold the truth."""
    generator = np.random.default_rng(3)
    block = np.repeat(np.arange(120), 20)
    hits = []
    for hold in (1, 20):
        for _ in range(20):
            x = generator.uniform(-1.0, 1.0, 2400)
            y = np.repeat(generator.normal(size=2400 // hold), hold)
            bins = build_bins(x, x, block, np.ones(2400, dtype=bool))
            hits.append(np.mean(np.abs(bins.compute_means(y)) < bins.compute_errors(y, block)))
    assert np.mean(hits[:20]) == pytest.approx(0.95, abs=0.03)
    assert np.mean(hits[20:]) == pytest.approx(0.95, abs=0.03)


def test_bins_hold_several_blocks_and_one_sign() -> None:
    time = np.linspace(-10.0, 30.0, 4000)
    block = (time / 0.5).astype(int)
    bins = build_bins(time, np.ones(4000), block, np.ones(4000, dtype=bool))
    for k in range(bins.count):
        mask = bins.place == k
        assert np.unique(block[mask]).size >= 4
        assert len(set(np.sign(time[mask]))) == 1


def test_what_returns_everywhere_is_not_wild() -> None:
    block = np.repeat(np.arange(40), 50)
    noise = np.random.default_rng(1).normal(size=2000)
    once, often = noise.copy(), noise.copy()
    once[200:204] = 60.0
    often[::50] = 60.0
    assert not find_inliers(once, block)[200:204].any() and find_inliers(once, block).sum() == 1996
    assert find_inliers(often, block).all()


@pytest.mark.parametrize(
    ("equation", "axis"),
    read_rows("v*abs(v) v; q*sign(v) q; abs(load)*sign(v) load; exp(-t)*v t; a*abs(a) a; T*v T"),
)
def test_an_effect_of_a_robot_file_shows_itself_on_its_variable(case, equation, axis):
    text = case.derivation.robot.text + f'\n[own_effects.brake]\ncolumns = {{Keb = "{equation}"}}\n'
    robot = parse_robot_text(text, "own")
    assert robot.own_effects[0].signature_axis == axis


def test_the_model_after_is_nearer_where_the_model_before_was_worst(item: Evidence) -> None:
    picture = evidence.draw_torque_picture(item)
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
    log, start, end = evidence.find_worst_window(item)
    assert 0.3 < end - start <= 0.5
    time, square = item.without.rows.time[item.j], np.where(item.is_inlier, item.before, 0.0) ** 2
    worst = square[(time >= start) & (time <= end)].sum()
    sums = [square[(time >= t) & (time <= t + 0.5)].sum() for t in time]
    assert worst == pytest.approx(max(sums))
    assert log == 0


def test_rivals_are_of_the_same_joint(item: Evidence) -> None:
    step = item.step
    assert {alternative.candidate.joint for alternative in evidence.select_alternatives(step)} == {
        step.candidate.joint
    }
    other = next(
        (r for r in step.alternatives if r.candidate.joint != step.candidate.joint), None
    )  # the search has some, the page does not
    assert other is not None
    rows = evidence.tabulate_alternatives(step).rows
    items = [
        step.candidate.effect.id,
        *(r.candidate.effect.id for r in evidence.select_alternatives(step)[:7]),
    ]
    assert [row[0] for row in rows] == items


@pytest.mark.parametrize("hold", [1, 10])
def test_a_law_is_as_sure_as_repetition_shows(hold: int) -> None:
    """80 draws of white noise, and of noise that lasts for half a block, on two joints."""
    random = np.random.default_rng(1)
    W = [random.normal(size=(600, 4)) + np.array([0.0, 0.0, 1.0, 0.0]) for _ in range(2)]
    W = [w.cumsum(axis=0) / np.sqrt(np.arange(1, 601))[:, None] for w in W]
    block, truth = np.repeat(np.arange(30), 20), np.array([1.0, -2.0, 0.5, 3.0])
    values, said = [], []
    for _ in range(80):
        noise = [np.repeat(random.normal(size=600 // hold), hold) for _ in W]
        y = [w @ truth + e for w, e in zip(W, noise, strict=True)]
        whitener = compute_joint_whitening(W, np.ones(2))
        weights = np.ones(2), [block, block], np.arange(30) % 8, whitener, np.zeros((0, 5))
        base = build_gram_blocks(lambda values: [w @ values for w in W], y, *weights)
        theta = np.linalg.lstsq(np.vstack(W), np.concatenate(y), rcond=None)[0]
        values.append(theta)
        said.append(np.diag(compute_covariance(base)))
    spread = np.std(values, axis=0)
    np.testing.assert_allclose(np.sqrt(np.mean(said, axis=0)), spread, rtol=0.25)


def test_the_band_is_drawn_and_named(item: Evidence) -> None:
    picture = evidence.draw_evidence_picture(item)
    law = picture.panels[0][-1]
    bands = [series for series in law.series if isinstance(series, Band)]
    assert len(bands) == 1 and np.all((bands[0].high >= bands[0].low)[np.isfinite(bands[0].low)])
    assert "two standard deviations of the law" in picture.caption
    assert_all_named(picture)


def test_no_line_is_drawn_over_rows_that_do_not_count(item: Evidence) -> None:
    """Filtered rows of joint 2 leave out its reversals: the curves break there."""
    time = item.without.rows.time[item.j]
    step = np.median(np.diff(time))
    for row in evidence.draw_torque_picture(item).panels:
        for series in row[0].series:
            whole = np.isfinite(series.y[:-1]) & np.isfinite(series.y[1:])
            assert np.all(np.diff(series.x)[whole] <= 1.5 * step)
