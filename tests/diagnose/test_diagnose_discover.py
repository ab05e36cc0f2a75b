"""Equations proposed: hidden expressions come back, a clean log yields none."""

import dataclasses
import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.api.improve import ModelOnLogs, add_proposals
from modeler.diagnosis import proposals
from modeler.diagnosis.added_model import LogSplit
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.equations import JointSearch
from modeler.diagnosis.expressions import Factor, Formula, derive_parameter_unit, list_factors
from modeler.diagnosis.proposals import discover_equations
from modeler.diagnosis.result import Diagnosis, EquationProposal
from modeler.diagnosis.signals import SignalReference
from modeler.diagnosis.state import SearchData, State, analyse_logs, build_state
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from modeler.views.diagnosis import build_diagnosis_page
from tests.diagnose.conftest import Case, Run, demonstration, motion, nothing, on_joint
from tests.json_schemas import check_schema

CHURN = 0.08  # s/rad, times load and speed of joint 2


def two_links() -> Case:
    """Short runs of an arm of two joints: few quantities and rows to search in."""
    return demonstration(robot="two-link", seconds=(8.0, 5.0))


@pytest.fixture(scope="module")
def case() -> Case:
    return two_links()


@cache
def _links() -> SignalReference:
    case = two_links()
    return SignalReference(case.compiled, case.fitted(case.train).beta, 0.0, {})


def churning(log: Log) -> np.ndarray:
    """Drag of joint 2 that grows with its load, with its sign: no effect of the catalogue."""
    q, v = motion(log)
    load = two_links().compiled.inverse_dynamics(
        q, v, np.gradient(v, log.time, axis=0), _links().link_parameters
    )
    return on_joint(log, 1, CHURN * load[:, 1] * v[:, 1])


def reaching(log: Log) -> np.ndarray:
    """Drag of joint 1 where joint 2 stands about one place."""
    q, v = motion(log)
    return on_joint(log, 0, 2.0 * v[:, 0] * np.exp(-(((q[:, 1] - 0.5) / 0.7) ** 2)))


@pytest.fixture(scope="module")
def found(case: Case) -> Diagnosis:
    """A diagnosis of churning with equations."""
    model, train, holdout = case.hidden(churning)
    return diagnose(model, case.compiled, [train], [holdout], equations=True)


def first_of(found: Diagnosis) -> EquationProposal:
    """The best proposal for joint 2."""
    every = {own.joint: own for own in found.discoveries or ()}
    assert not every["1"].proposals
    assert "nothing to find" in every["1"].reason
    return every["2"].proposals[0]


def state(case: Case, torque: object) -> State:
    """What the model leaves of the training run with a hidden torque."""
    model, train, _ = case.hidden(torque)  # type: ignore[arg-type]
    seen = analyse_logs(case.compiled, [train], model.processing)
    return build_state(SearchData(case.compiled, seen), (), model.beta)


UNITS = {
    ("speed",): "N*m*s/rad",
    ("direction", "load"): "1",
    ("speed", "load"): "s/rad",
    ("direction", "root_of_load"): "N^0.5*m^0.5",
    ("drag", "fall"): "N*m*s^2/rad^2",
    ("speed", "other_sine"): "N*m*s/rad",
    ("direction", "late_size"): "N*m*s/rad",
    ("time", "direction"): "N*m/s",
    ("place", "memory"): "N*m/rad",
}


def test_units_follow_from_what_is_read(case: Case) -> None:
    spec = case.compiled.spec
    every: dict[str, Factor] = {}
    for some in list_factors(spec, state(case, nothing).joint_scales, 1, False, [5.0]):
        every.setdefault(some[0].effect.id, some[0])
    for names, unit in UNITS.items():
        formula = Formula((tuple(every[name] for name in names),))
        candidate = formula.build_candidate([joint.name for joint in spec.joints], 1)
        units = formula.find_nonlinear_units(False)
        assert derive_parameter_unit(spec, 1, candidate, 0, units) == unit, names
        assert all(math.isfinite(value) for value in formula.nonlinear_parameters.values())


def test_the_hidden_equation_is_the_first_with_its_value(found: Diagnosis) -> None:
    """No effect of the catalogue is stated in its place."""
    assert found.verdict in ("closest description", "unexplained")
    best = first_of(found)
    (equation,) = best.definition["columns"].values()
    assert sorted(equation.split("*")) == ["load", "v"]
    value, sigma = (next(iter(x.values())) for x in (best.finding.parameters, best.finding.sigmas))
    assert abs(value - CHURN) < 0.1 * CHURN and 0.0 < sigma < 0.1 * CHURN
    assert best.finding.error_after < 0.3 * best.finding.error_before
    assert best.definition["unit"] == "s/rad" and best.explained_share > 0.9
    assert "viscous" in best.difference and "times the load" in best.difference


def test_every_symbol_has_its_price(found: Diagnosis) -> None:
    """A term more leaves less of these logs, by chance, and stands behind it all the same."""
    search = JointSearch(found.search.start, 1)
    stem = (*search.plain_factors["load"].term, *search.plain_factors["v"].term)
    longer = [Formula((stem, own.term)) for own in search.wave_free_columns]
    every = search.score_formulas([Formula((stem,)), *longer])
    assert every[0].formula.text == "load*v"
    assert min(own.left for own in every[1:]) < every[0].left


def test_what_is_proposed_can_be_pasted_and_added(case: Case, found: Diagnosis) -> None:
    model, train, holdout = case.hidden(churning)
    first = first_of(found)
    pasted = parse_robot_text(f"{model.robot_text}\n{first.text}\n", "pasted")
    assert [e.id for e in pasted.own_effects] == [first.finding.effect]
    assert first.effects_line == f'{first.finding.effect} = ["2"]'
    opened = ModelOnLogs(model, case.compiled, LogSplit([train], [holdout]))
    better, left_out = add_proposals(opened, found)
    assert (better.history[-1].effect, better.history[-1].joint) == (first.finding.effect, "2")
    assert better.history[-1].error < 0.5 * better.history[0].error and not left_out
    unproven = dataclasses.replace(found, discoveries=())
    same, why = add_proposals(opened, unproven)
    assert same is model and why == ("left out: nothing was found",)


def test_what_is_found_is_told_to_machines_and_on_the_page(found: Diagnosis) -> None:
    told = found.to_json()
    check_schema("diagnose", {"schema": "urn:modeler:schema:diagnose:1", "not_added": [], **told})
    json.dumps(told, allow_nan=False)
    offered = {own["joint"]: own["proposals"] for own in told["discoveries"]}["2"]
    assert 1 <= len(offered) <= 3
    assert offered[0]["text"].startswith("[own_effects.found_2a]")
    if len(offered) > 1:
        assert "--between found_2a@2,found_2b@2" in offered[0]["discriminating_command"]
    page = build_diagnosis_page(found)
    assert any(section.title.startswith("Xbaa2") for section in page.sections)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_place_of_another_joint_is_found(case: Case) -> None:
    best = JointSearch(state(case, reaching), 0).find_formulas()[0]
    assert best.formula.equations == ["v*exp(-((q2 - c)/b)**2)"]
    assert best.formula.nonlinear_parameters["c"] == pytest.approx(0.5, abs=0.1)
    assert best.formula.nonlinear_parameters["b"] == pytest.approx(0.7, rel=0.1)


@pytest.mark.rotating("diagnoses of simulated runs")
def test_the_least_held_out_error_stands_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """In runs that are long enough to be sure of it."""
    monkeypatch.setattr(  # the worst
        proposals, "_compute_total_cost", lambda search, item: -item.cost
    )
    search = demonstration(robot="two-link").found(churning).search
    every = discover_equations(search, (), None)[1].proposals
    assert len(every) > 1, "several are offered"
    errors = [own.finding.error_after for own in every]
    least = min(errors)
    assert errors[0] < 1.1 * least, errors
    assert errors[0] == least or every[0].symbols <= every[errors.index(least)].symbols


@pytest.mark.rotating("diagnoses of simulated runs")
def test_nothing_is_proposed_where_nothing_is_hidden(case: Case) -> None:
    every = discover_equations(case.found(nothing).search, (), None)
    assert [own.joint for own in every] == ["1", "2"]
    assert all(not own.proposals and "nothing to find" in own.reason for own in every)


def test_add_wants_discover(run: Run, tmp_path: Path) -> None:
    for words, told in (
        (["--add", "--out", tmp_path / "m2.json"], "--add: needs --discover; give both"),
        (["--discover", "--add"], "--add: needs --out; give both, or leave --add out"),
    ):
        status, _, err = run("diagnose", "m.json", "log.csv", *words)
        assert status == 1 and told in err
