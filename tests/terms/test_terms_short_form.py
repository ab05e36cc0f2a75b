"""Short forms as they are printed, against the compiled C, laws and a published model."""

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formulas.function_sheet import sheet_lines
from modeler.formulas.regressor_form import nonzero_base, short_form
from tests.terms.printed_lines import derived, known, run_lines

LINES = {"puma560": 300, "rx90": 280, "ur10e": 260, "sr400": 340, "orthoglide-leg": 40}


@pytest.mark.parametrize("name", LINES)
def test_short_forms_are_short(name):
    """The expanded form of a PUMA 560 has 7376 lines, that of an SR400 2678."""
    derivation = derived(name)
    lines = sheet_lines(short_form(derivation.model, derivation.base).sheet)
    assert len(lines) <= LINES[name] and max(map(len, lines)) <= 100


def test_every_name_is_defined_once_and_before_it_is_read():
    derivation = derived("sr400")
    lines = sheet_lines(short_form(derivation.model, derivation.base).sheet)
    run_lines(lines, known(derivation, [0.1] * 6, beta=[1.0] * 39))  # NameError otherwise
    names = [line.split(" = ")[0] for line in lines if " = " in line and line[0] not in " #sc"]
    assert len(names) == len(set(names)) > 150


def test_emitted_code_does_not_change():
    model = derived("puma560").model
    before = len(model.graph.nodes)
    short_form(model, derived("puma560").base)
    assert len(model.graph.nodes) == before


def test_known_subexpressions_have_their_names():
    """Axes 2, 3 and 4 of a UR10e are parallel, 2 and 3 of a PUMA; those of an SR400 follow q7."""
    text = {}
    for name in ("ur10e", "puma560", "sr400"):
        found = short_form(derived(name).model, derived(name).base)
        text[name] = "\n".join(sheet_lines(found.sheet))
    assert "s234 = sin(q2 + q3 + q4)" in text["ur10e"]
    assert "s23 = sin(q2 + q3)" in text["puma560"] and "gx_4 = g*s23*c4" in text["puma560"]
    assert "J44 = ZZ4c" in text["puma560"] and "S334 = S324" in text["puma560"]
    assert "s2m7 = sin(q2 - q7)" in text["sr400"] and "q3" not in text["sr400"]


# B. Armstrong, O. Khatib, J. Burdick 1986, abbreviated expressions: what is below 1 % is left out.
PUBLISHED = {
    "J12": "0.690*S2 - 0.134*C23 + 0.0238*C2",
    "J13": "-0.134*C23 - 0.00397*S23",
    "J22": "6.79 - 4.71 + 0.744*S3",
    "J23": "0.333 + 0.372*S3 - 0.011*C3",
    "S113": "0.744*C2*C23 + 0.60*S23*C23 + 0.022*C2*S23 - 0.0213*(1 - 2*S23**2)",
    "S122": "0.690*C2 + 0.134*S23 - 0.0238*S2",
    "S123": "0.267*S23 - 0.00758*C23",
    "S223": "0.022*S3 + 0.744*C3",
    "S233": "0.372*C3 + 0.011*S3",
    "g2": "-37.2*C2 - 8.4*S23 + 1.02*S2",
    "g3": "-8.4*S23 + 0.25*C23",
    "g5": "-0.028*(C23*S5 + S23*C4*C5)",
}


def nominal_beta(derivation) -> list[float]:
    """Base parameters at the nominal values of the file; lengths nominal too."""
    lengths, known_ = derivation.model.geometry.values, derivation.robot.parameters
    return [
        sum(
            float(t.coefficient.subs({s: lengths[s.name] for s in t.coefficient.free_symbols}))
            * known_.get(t.parameter, 0.0)
            for t in parameter.terms
        )
        for parameter in derivation.base.parameters
    ]


def test_puma_is_the_published_one():
    """Within what their abbreviation leaves out; 4.71 is the motor of axis 2, which we lack."""
    derivation = derived("puma560")
    beta = nominal_beta(derivation)
    base = nonzero_base(derivation.model, derivation.base)
    assert base.rank == 20
    lines = sheet_lines(short_form(derivation.model, base).sheet)
    assert len(lines) <= 180
    rng = np.random.default_rng(3)
    pairs: dict[str, list[tuple[float, float]]] = {name: [] for name in PUBLISHED}
    for q in rng.uniform(-3, 3, (20, 6)):
        found = run_lines(lines, known(derivation, q, beta=beta))
        letters = {
            f"{f}{label}": getattr(np, "sin" if f == "S" else "cos")(angle)
            for f in "SC"
            for label, angle in (
                ("2", q[1]), ("3", q[2]), ("23", q[1] + q[2]), ("4", q[3]), ("5", q[4])
            )
        }  # fmt: skip
        for name, text in PUBLISHED.items():
            pairs[name].append((found[name], eval(text, {}, letters)))
    for name, values in pairs.items():
        ours, theirs = np.array(values).T
        limit = 0.03 * np.max(np.abs(theirs)) + 0.02 * np.ptp(theirs)
        assert np.max(np.abs(ours - theirs)) < limit, name


def test_effects_are_never_left_out():
    derivation = derived("two-link")
    kept = nonzero_base(derivation.model, derivation.base).parameters
    assert [p.name for p in kept] == ["ZZ1R", "MX1R", "Fv1", "Fs1", "ZZ2", "MX2", "Fv2", "Fs2"]


def test_nonzero_needs_nominal_values():
    derivation = derived("rx90")
    with pytest.raises(RobotError, match=r"rx90: all inertial base parameters are 0.*\[parameters"):
        nonzero_base(derivation.model, derivation.base)
