"""Friction by direction, against a regression on one column for each direction."""

import json

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate
from modeler.core.builtin import builtin_text
from modeler.estimation.identify import identify
from modeler.estimation.result import fit_from_json
from modeler.estimation.verdict import with_verdict
from modeler.observation.log import Log
from modeler.observation.observe import observe
from modeler.observation.settings import Processing
from modeler.robot.edit import with_effects
from modeler.robot.read import robot_from_text

EVERY = ("viscous", "coulomb", "asymmetric_viscous", "offset")


def fitted(effects):
    text = with_effects(builtin_text("two-link"), dict.fromkeys(effects, "all"))
    compiled = compile_model(generate(derive(robot_from_text(text, "two-link"))))
    t = np.arange(3000) / 150.0
    w = 2 * np.pi * np.array([0.31, 0.53])
    q, qd = np.sin(t[:, None] * w), w * np.cos(t[:, None] * w)
    qdd = -(w**2) * q
    beta = np.linspace(0.5, 1.5, len(compiled.spec.base))
    tau = compiled.base_regressor(q, qd, qdd) @ beta
    tau += 0.1 * np.random.default_rng(2).normal(size=tau.shape)
    seen = observe(compiled, [Log("run", ("1", "2"), t, q, tau, qd, qdd)],
                   Processing(parallel_cutoff=0.0))  # fmt: skip
    return compiled, seen, with_verdict(compiled, seen, identify(seen, "ordinary"))


def test_the_values_are_those_of_columns_for_each_direction():
    """Houda et al., Table 1: qd and sign(qd) where qd > 0, and where qd < 0; the same law."""
    _, seen, fit = fitted(EVERY)
    smooth = [i for i, name in enumerate(seen.names) if name[:2] not in ("Fv", "Fs", "Of")]
    qd = seen.qd[seen.row_sample, seen.row_joint]
    columns, names = [seen.W[:, i] for i in smooth], [seen.names[i] for i in smooth]
    for j, joint in enumerate(seen.joints):
        for sign, one in (("+", 1.0), ("-", -1.0)):
            there = (seen.row_joint == j) & (qd * one > 0.0)
            columns += [np.where(there, qd, 0.0), np.where(there, one, 0.0)]
            names += [f"Fv{joint.name}{sign}", f"Fs{joint.name}{sign}"]
    W = np.column_stack(columns)
    beta, squares, _, _ = np.linalg.lstsq(W, seen.y, rcond=None)
    C = squares[0] / (len(seen.y) - W.shape[1]) * np.linalg.inv(W.T @ W)
    found = {item.name: item for item in fit.directions}
    assert set(found) == {name for name in names if name[-1] in "+-"}
    for i, name in enumerate(names):
        if name in found:
            assert found[name].value == pytest.approx(beta[i], rel=1e-8)
            # The sigmas of the fit are raised for residuals with a memory, by a little.
            assert 0.99 < found[name].sigma / C[i, i] ** 0.5 < 1.3
    assert found["Fv1-"].relation == "Fv1- = Fv1 - Fva1" and found["Fv1-"].unit == "N m s/rad"
    assert found["Fs2+"].relation == "Fs2+ = Fs2 + Off2" and found["Fs2+"].unit == "N m"


def test_they_are_printed_and_saved():
    _, _, fit = fitted(EVERY)
    text = "\n".join(fit.lines())
    assert "Fv1+ = Fv1 + Fva1" in text
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    first = raw["directions"][0]
    assert {"name", "value", "sigma", "relative_sigma_percent", "unit", "relation"} == set(first)
    assert fit_from_json(raw, fit.covariance).directions == fit.directions


def test_where_friction_has_one_law_there_is_nothing_to_tell():
    _, _, fit = fitted(("viscous", "coulomb", "offset"))
    assert fit.directions == () and "direction" not in "\n".join(fit.lines())


def test_without_an_offset_both_levels_are_the_coulomb_friction():
    _, _, fit = fitted(("viscous", "coulomb", "asymmetric_viscous"))
    found = {item.name: item for item in fit.directions}
    assert found["Fs1+"].value == found["Fs1-"].value and found["Fs1+"].relation == "Fs1+ = Fs1"
    assert found["Fv1+"].value != found["Fv1-"].value
