"""Printed equations are the whole torque of the emitted C, term by term, and those of a paper.

The text is run as it stands, and put together as the words above it say; the parameters are random.
"""

import ast
import re
from collections import Counter

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formulas.function_sheet import format_sheet
from modeler.formulas.regressor_form import (
    derive_equation,
    derive_regressor_form,
    derive_short_form,
    drop_zero_parameters,
)
from tests.robots import ROBOTS, kinds_first
from tests.rotation import rotating
from tests.terms.printed_lines import compiled, derived, known, printed_coupling, run_lines, torque

SAMPLES = 3
SIGNALS = np.array([0.3, 0.5, 0.7])


def motions_of(derivation):
    """Motors near home where loops close, anywhere else; random speeds and accelerations."""
    rng, closure = np.random.default_rng(17), derivation.model.closure
    for _ in range(SAMPLES):
        if closure is None:
            yield rng.uniform(-2, 2, (3, len(derivation.robot.coordinates)))
        else:
            home = np.array(closure.home)[list(closure.actuated)]
            q = home + rng.uniform(-0.03, 0.03, len(home))
            yield np.array([q, *rng.uniform(-1, 1, (2, len(home)))])


def monomials(node: ast.expr, sign: int = 1) -> list[tuple[int, tuple[str, ...]]]:
    """Terms of a printed sum, a product with one bracket multiplied out: (sign, factors)."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
        other = sign if isinstance(node.op, ast.Add) else -sign
        return monomials(node.left, sign) + monomials(node.right, other)
    if isinstance(node, ast.UnaryOp):
        return monomials(node.operand, -sign)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        left, right = monomials(node.left, sign), monomials(node.right)
        if len(left) == 1 or len(right) == 1:
            return [(a * b, tuple(sorted(f + g))) for a, f in left for b, g in right]
    return [(sign, (ast.unparse(node),))]


def check_sums(name) -> None:
    """Nothing cancels within a sum.

    S315 of a PUMA was ... + MX5c*(k34 + k51) - MX5c*(k34 - k51): 2*MX5c*k51.
    """
    for statement in ast.parse(derived(name).closed_form().text).body:
        terms = monomials(statement.value)
        gone = {f for sign, f in terms if sign > 0} & {f for sign, f in terms if sign < 0}
        assert not gone, ast.unparse(statement)


def ran(derivation, model, lines, motion, beta=()):
    """What the lines define at a motion of the motors, speeds and accelerations of the free joints
    by the printed coupling, and J_t.
    """
    q, qd, qdd = motion
    values_of_signals = SIGNALS[: len(derivation.model.signals)]
    signals = {f"{kind}{k + 1}": x for k, x in enumerate(values_of_signals) for kind in "tTz"}
    if derivation.model.closure is None:
        values = known(derivation, q, qd, qdd, beta) | signals
        return run_lines(lines, values), qd, qdd, np.eye(len(q))
    u, G = model.close(q[None])[0], model.coupling(q[None])[0]
    first = run_lines(lines, known(derivation, u, G @ qd, G @ qdd, beta) | signals)
    J, b = printed_coupling(derivation, first)
    ud, udd = J @ qd, J @ qdd + b
    return run_lines(lines, known(derivation, u, ud, udd, beta) | signals), ud, udd, J


def check(name) -> None:
    """The torque of the printed lines is that of the C."""
    derivation, model = derived(name), compiled(name)
    text = derivation.closed_form().text
    names = [joint.name for joint in derivation.model.robot.free_joints]
    rng, s = np.random.default_rng(5), SIGNALS[: len(derivation.model.signals)]
    for motion in motions_of(derivation):
        beta = rng.normal(size=derivation.base.rank)
        expected = model.inverse_dynamics(*motion[:, None], beta, s[None] if len(s) else None)[0]
        actual, ud, udd, J = ran(derivation, model, text.splitlines(), motion, beta)
        tau = J.T @ torque(actual, names, ud, udd, "S_kij = -S_jik" in text)
        assert np.max(np.abs(tau - expected)) < 1e-12 * np.max(np.abs(expected))


@pytest.mark.parametrize("name", kinds_first(ROBOTS))
def test_printed_lines_are_the_whole_torque_of_the_c(name):
    check(name)
    check_sums(name)


@pytest.mark.parametrize("name", ["odd", "askew", "geared"])
def test_printed_lines_of_awkward_robots(name):
    check(name)
    check_sums(name)


@pytest.mark.slow
@pytest.mark.parametrize("file", ["offset_parallelogram.toml", "twoloops.toml"])
def test_printed_lines_of_further_robots(loop_robots_folder, file):
    check(loop_robots_folder / file)


@pytest.mark.parametrize("name", ["orthoglide-2003", *rotating("puma560", "sr400")])
def test_a_document_of_both_has_one_thing_under_each_name(name):
    """The torque and the columns on one sheet: names are given once, and before they are read."""
    derivation = derived(name)
    result = derive_equation(derivation.model, derivation.base, motion=True, columns=True)
    tree = ast.parse(format_sheet(result.sheet))
    names = [node.targets[0].id for node in tree.body if isinstance(node, ast.Assign)]
    assert max(Counter(names).values()) == 1
    free = range(len(derivation.model.robot.free_joints))
    values = known(derivation, *([0.5 + 0.1 * k for k in free],) * 3, [1.0] * derivation.base.rank)
    run_lines(format_sheet(result.sheet).splitlines(), values)  # NameError otherwise
    read = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    assert not set(names) & set(values)
    assert {d.name for d in result.sheet.definitions if not d.result} <= read


LINES = {"puma560": 300, "rx90": 280, "ur10e": 260, "sr400": 340, "orthoglide-leg": 40}


@pytest.mark.parametrize("name", LINES)
def test_short_forms_are_short(name):
    """The expanded form of a PUMA 560 has 7376 lines, that of an SR400 2678."""
    derivation = derived(name)
    lines = format_sheet(derive_short_form(derivation.model, derivation.base).sheet).splitlines()
    assert len(lines) <= LINES[name] and max(map(len, lines)) <= 100


def test_known_subexpressions_have_their_names():
    """Axes 2, 3 and 4 of a UR10e are parallel, 2 and 3 of a PUMA; those of an SR400 follow q7."""
    text = {}
    for name in ("ur10e", "puma560", "sr400"):
        result = derive_short_form(derived(name).model, derived(name).base)
        text[name] = format_sheet(result.sheet)
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
    base = drop_zero_parameters(derivation.model, derivation.base)
    assert base.rank == 20
    lines = format_sheet(derive_short_form(derivation.model, base).sheet).splitlines()
    assert len(lines) <= 180
    rng = np.random.default_rng(3)
    pairs: dict[str, list[tuple[float, float]]] = {name: [] for name in PUBLISHED}
    for q in rng.uniform(-3, 3, (20, 6)):
        out = run_lines(lines, known(derivation, q, beta=beta))
        angles = {"2": q[1], "3": q[2], "23": q[1] + q[2], "4": q[3], "5": q[4]}
        letters = {
            f"{f}{label}": getattr(np, "sin" if f == "S" else "cos")(angle)
            for f in "SC"
            for label, angle in angles.items()
        }
        for name, text in PUBLISHED.items():
            pairs[name].append((out[name], eval(text, {}, letters)))
    for name, values in pairs.items():
        ours, theirs = np.array(values).T
        limit = 0.03 * np.max(np.abs(theirs)) + 0.02 * np.ptp(theirs)
        assert np.max(np.abs(ours - theirs)) < limit, name


def test_effects_are_never_left_out():
    derivation = derived("two-link")
    stored = drop_zero_parameters(derivation.model, derivation.base).parameters
    assert [p.name for p in stored] == ["ZZ1R", "MX1R", "Fv1", "Fs1", "ZZ2", "MX2", "Fv2", "Fs2"]


def test_nonzero_needs_nominal_values():
    derivation = derived("rx90")
    with pytest.raises(RobotError, match=r"rx90: all inertial base parameters are 0.*\[parameters"):
        drop_zero_parameters(derivation.model, derivation.base)


def printed_columns(derivation, found) -> np.ndarray:
    names = [joint.name for joint in derivation.model.robot.free_joints]
    columns = derivation.base.parameters
    return np.array([[found.get(f"phi{n}_{p.name}", 0.0) for p in columns] for n in names])


@pytest.mark.parametrize("name", ["odd", "sr400", "five-bar", *rotating("puma560", "geared")])
def test_printed_columns_are_those_of_the_c(name):
    """Those of a robot with loops are the tree's, projected."""
    derivation, model = derived(name), compiled(name)
    form = derive_regressor_form(derivation.model, derivation.base)
    lines = format_sheet(form.sheet).splitlines()
    for motion in motions_of(derivation):
        result, _, _, J = ran(derivation, model, lines, motion)
        expected = model.base_regressor(*motion[:, None])[0]
        columns = J.T @ printed_columns(derivation, result)
        assert np.max(np.abs(columns - expected)) < 1e-12 * np.max(np.abs(expected))


@pytest.mark.parametrize("name", ["odd", "sr400"])
def test_latex_and_markdown_have_every_column(name):
    derivation = derived(name)
    sheet = derive_regressor_form(derivation.model, derivation.base).sheet
    latex, markdown = format_sheet(sheet, "latex"), format_sheet(sheet, "markdown")
    assert latex.count("\\begin{align*}") == latex.count("\\end{align*}") > 3
    assert latex.count("{") == latex.count("}") and latex.count(r"\left") == latex.count(r"\right")
    formulas = "".join(line for line in latex.splitlines() if line[0] not in "%\\")
    assert not re.search(r"\*|(?<!\\)sin|\\_|mathit\{[we]", formulas)
    assert markdown.count("```") == 2 * markdown.count("```python")
    for parameter in derivation.base.parameters:
        assert f"% column of {parameter.name}" in latex
        assert f"## column of {parameter.name}" in markdown
