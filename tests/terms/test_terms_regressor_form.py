"""Base columns as they are printed, against the compiled C."""

import re

import numpy as np
import pytest

from modeler.formulas.function_sheet import sheet_latex, sheet_lines, sheet_markdown
from modeler.formulas.regressor_form import regressor_form
from tests.terms.printed_lines import SAMPLES, compiled, derived, known, run_lines

ROBOTS = ["puma560", "odd", "geared", "sr400"]


def printed_columns(derivation, found) -> np.ndarray:
    names = [joint.name for joint in derivation.model.robot.free]
    return np.array(
        [[found.get(f"phi{n}_{p.name}", 0.0) for p in derivation.base.parameters] for n in names]
    )


@pytest.mark.parametrize("name", ROBOTS)
def test_printed_columns_are_those_of_the_c(name):
    derivation, model = derived(name), compiled(name)
    lines = sheet_lines(regressor_form(derivation.model, derivation.base).sheet)
    rng = np.random.default_rng(6)
    for _ in range(SAMPLES):
        q, qd, qdd = rng.uniform(-2, 2, (3, len(derivation.model.robot.free)))
        found = printed_columns(derivation, run_lines(lines, known(derivation, q, qd, qdd)))
        expected = model.base_regressor(q[None], qd[None], qdd[None])[0]
        assert np.max(np.abs(found - expected)) < 1e-12 * np.max(np.abs(expected))


def test_columns_of_friction_and_rotors_are_there():
    derivation = derived("orthoglide-leg")
    lines = sheet_lines(regressor_form(derivation.model, derivation.base).sheet)
    assert {"phi1_Ia1R = qdd1", "phi1_Fv1 = qd1", "phi1_Fs1 = sign(qd1)"} <= set(lines)


def test_speeds_of_parallel_axes_are_products_with_known_sines():
    """Of link 3 of a PUMA, whose axis 1 is seen from frame 3 under q2 + q3."""
    derivation = derived("puma560")
    lines = sheet_lines(regressor_form(derivation.model, derivation.base).sheet)
    assert any("qd1**2*c23*s23" in line or "qd1**2*s23*c23" in line for line in lines)


@pytest.mark.parametrize("name", ["two-link", "odd", "sr400"])
def test_latex_and_markdown_have_every_column(name):
    derivation = derived(name)
    sheet = regressor_form(derivation.model, derivation.base).sheet
    latex, markdown = sheet_latex(sheet), sheet_markdown(sheet)
    assert latex.count("\\begin{align*}") == latex.count("\\end{align*}") > 3
    assert latex.count("{") == latex.count("}") and latex.count(r"\left") == latex.count(r"\right")
    formulas = "".join(line for line in latex.splitlines() if line[0] not in "%\\")
    assert not re.search(r"\*|(?<!\\)sin|\\_|mathit\{[we]", formulas)
    assert markdown.count("```") == 2 * markdown.count("```python")
    for parameter in derivation.base.parameters:
        assert f"% column of {parameter.name}" in latex
        assert f"## column of {parameter.name}" in markdown
