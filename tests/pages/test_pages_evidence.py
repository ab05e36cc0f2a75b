"""The data behind the evidence of a diagnosis: does it convince, and is it called by its name?"""

import dataclasses
import html
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.core.figure import Curve, Means, Panel, Picture
from modeler.core.style import COLOR_NAMES
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.effects.catalogue import CATALOGUE
from modeler.effects.effect import VARIABLES
from modeler.observation.log import Log
from modeler.observation.low_speed import bristle
from modeler.report.diagnosis import diagnosis_page
from modeler.report.effect_evidence import evidence_of, figures
from modeler.report.evidence import EFFECT, MEANS, RIVAL, ROWS, evidence_picture
from modeler.report.evidence_axes import bins_of, calm_rows
from modeler.report.page import write_page
from modeler.report.torque_picture import play_picture
from modeler.robot.read import robot_from_text
from tests.captions import assert_all_named
from tests.diagnose.conftest import Case, motion, on_joint
from tests.diagnose.test_diagnose_effects import drift, motor_ripple, spring, stribeck
from tests.rotation import ROTATING


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


def presliding(log: Log) -> np.ndarray:
    q, v = motion(log)
    return on_joint(log, 1, 3.0 * (bristle(q[:, 1], 0.02) - np.tanh(v[:, 1] / 0.002)))


HIDDEN: dict[str, tuple[Callable[..., np.ndarray], str]] = {
    "stribeck": (stribeck, "velocity [rad/s]"),
    "load_friction": (np.zeros_like, "|load| [N m]"),
    "spring": (spring, "position [rad]"),
    "motor_ripple": (motor_ripple, "place within one wave [deg]"),
    "drift": (drift, "time [s]"),
    "presliding": (presliding, "travel since the last reversal [rad]"),
}


@cache
def found(case: Case, torque: Callable[[Log], np.ndarray]) -> Diagnosis:
    """What is found of a hidden torque; several tests look at the same."""
    model, train, _ = case.hidden(torque)
    return diagnose(model, case.compiled, [train])


def panels(picture: Picture) -> dict[str, Panel]:
    return {panel.title: panel for panel in picture.panels[0]}


def series(panel: Panel, kind: type, label: str):
    return next(s for s in panel.series if isinstance(s, kind) and s.label.startswith(label))


@pytest.mark.rotating
@pytest.mark.parametrize(
    "effect", [pytest.param(e, marks=ROTATING * (e in ("drift", "presliding"))) for e in HIDDEN]
)
def test_the_picture_convinces(case: Case, effect: str) -> None:
    torque, label = HIDDEN[effect]
    search = found(case, load_friction(case) if effect == "load_friction" else torque).search
    step = search.steps[0]
    assert step.pick.effect.id == effect
    picture = evidence_picture(evidence_of(search, step))
    drawn = panels(picture)
    without, full = drawn["without the effect"], drawn["with it"]
    assert without.x_label == full.x_label == label
    assert ("sign of velocity" in without.y_label) == (effect in ("load_friction", "presliding"))
    assert without.x_range == full.x_range and without.y_range == full.y_range
    before, after = (series(panel, Means, "mean") for panel in (without, full))
    assert 8 <= len(before.x) <= 60 and np.isfinite(before.error).all()
    size = np.sqrt(np.mean(before.y**2))
    assert np.sqrt(np.mean(after.y**2)) < 0.4 * size  # before and after differ
    curve = series(without, Curve, effect)
    at = np.isfinite(curve.y)
    missed = np.abs(before.y - curve.y[at]) > before.error
    if effect != "presliding":  # which is hidden with a smooth sign: its picture shows the rest
        assert np.mean(missed) < 0.2  # the curve passes within the error bars
    low, high = without.y_range
    inside = (curve.x[at] >= without.x_range[0]) & (curve.x[at] <= without.x_range[1])
    assert np.all((curve.y[at][inside] > low) & (curve.y[at][inside] < high))
    assert np.ptp(curve.y[at][inside]) > 0.3 * (high - low)  # and fills the picture


def test_the_law_is_drawn_as_it_is(case: Case) -> None:
    """What the model imitates of a spring is not seen in residuals, but it is in its law."""
    search = found(case, spring).search
    law = panels(evidence_picture(evidence_of(search, search.steps[0])))["its law"]
    means = series(law, Means, "mean")
    slope, rest = np.polyfit(means.x, means.y, 1)
    assert slope == pytest.approx(1.5, rel=0.02)
    assert np.abs(means.y - slope * means.x - rest).max() < 0.02


def test_the_spectrum_of_a_ripple_loses_its_line(case: Case) -> None:
    search = found(case, motor_ripple).search
    spectrum = panels(evidence_picture(evidence_of(search, search.steps[0])))["order spectrum"]
    before, after = spectrum.series
    place = np.argmax(before.y)
    assert before.x[place] == pytest.approx(101.0, rel=0.01)
    assert after.y[place] < 0.1 * before.y[place]


@pytest.mark.parametrize("effect", ["stribeck", "motor_ripple"])
def test_captions_name_the_colours_that_are_drawn(case: Case, effect: str) -> None:
    search = found(case, HIDDEN[effect][0]).search
    assert_all_named(evidence_picture(evidence_of(search, search.steps[0])))
    assert_all_named(play_picture(search.end, 0))


def test_the_colours_have_different_names() -> None:
    styles = (ROWS, MEANS, EFFECT, RIVAL)
    assert len({style.named for style in styles}) == len(styles)
    assert len(set(COLOR_NAMES.values())) == len(COLOR_NAMES)


def test_figures_stand_by_the_picture(case: Case, tmp_path: Path) -> None:
    diagnosis = found(case, stribeck)
    item = evidence_of(diagnosis.search, diagnosis.search.steps[0])
    text = figures(item)
    sizes = [float(size) for size in re.findall(r"([\d.]+) N m \(", text)]
    before, after, rival = sizes
    assert after < 0.3 * before and after < 1.2 * rival < before
    size = float(np.sqrt(np.mean(item.after**2)))
    assert after == pytest.approx(size, rel=0.2)
    page = write_page(tmp_path / "page.html", diagnosis_page(diagnosis)).read_text()
    assert text in html.unescape(page)


def test_a_spike_flattens_nothing_and_is_told(case: Case) -> None:
    """40 ms of nonsense in a log: the axes stay, the rows are left out, a line says so."""

    def torn(log: Log) -> np.ndarray:
        torque = stribeck(log)
        torque[(log.time > 9.0) & (log.time < 9.04), 1] -= 350.0
        return torque

    quiet, loud = (found(case, torque) for torque in (stribeck, torn))
    assert [f.effect for f in loud.effects] == ["stribeck"]  # a spike is no push
    assert any("8.9 to 9.2 s: torques that come only once" in line for line in loud.data)
    pictures = [evidence_picture(evidence_of(s, s.steps[0])) for s in (quiet.search, loud.search)]
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
            bins = bins_of(x, x, block, np.ones(2400, dtype=bool))
            hits.append(np.mean(np.abs(bins.means(y)) < bins.errors(y, block)))
    assert np.mean(hits[:20]) == pytest.approx(0.95, abs=0.03)
    assert np.mean(hits[20:]) == pytest.approx(0.95, abs=0.03)


def test_bins_hold_several_blocks_and_one_sign() -> None:
    time = np.linspace(-10.0, 30.0, 4000)
    block = (time / 0.5).astype(int)
    bins = bins_of(time, np.ones(4000), block, np.ones(4000, dtype=bool))
    for k in range(bins.count):
        own = bins.place == k
        assert np.unique(block[own]).size >= 4
        assert len(set(np.sign(time[own]))) == 1


def test_what_returns_everywhere_is_not_wild() -> None:
    block = np.repeat(np.arange(40), 50)
    noise = np.random.default_rng(1).normal(size=2000)
    once, often = noise.copy(), noise.copy()
    once[200:204] = 60.0
    often[::50] = 60.0
    assert not calm_rows(once, block)[200:204].any() and calm_rows(once, block).sum() == 1996
    assert calm_rows(often, block).all()


def test_every_effect_says_where_it_shows_itself() -> None:
    axes = {*VARIABLES, "travel", "waves", "itself"} - {"z", "static"}
    for effect in CATALOGUE:
        assert effect.shows in axes, effect.id


@pytest.mark.parametrize(
    ("equation", "axis"),
    [("v*abs(v)", "v"), ("q*sign(v)", "q"), ("abs(load)*sign(v)", "load"), ("exp(-t)*v", "t"),
     ("a*abs(a)", "a"), ("T*v", "T")],
)  # fmt: skip
def test_an_effect_of_a_robot_file_shows_itself_on_its_variable(
    case: Case, equation: str, axis: str
) -> None:
    text = case.derivation.robot.text + f'\n[own_effects.brake]\ncolumns = {{Keb = "{equation}"}}\n'
    robot = robot_from_text(text, "own")
    assert dataclasses.replace(robot.own_effects[0]).shows == axis
