"""The blocks of Guegan, Khalil and Lemoine 2003, eqs. (1), (2), (23) to (30), as printed."""

import re

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formulas import block_form
from modeler.formulas.function_sheet import sheet_latex, sheet_lines
from tests.terms.cases import base_of, model_of
from tests.terms.printed_lines import compiled, derived, known, run_lines
from tests.terms.test_terms_loop_form import motor_states


def printed(name):
    """(words, lines, {block: (rows, columns)}) as they are printed."""
    form = block_form(derived(name).model, derived(name).base)
    lines = sheet_lines(form.sheet)
    head = r"^# (\w+), .*: (\d+) x (\d+), rows (.*); columns (.*)$"
    heads = re.findall(head, "\n".join(lines), re.M)
    sides = {block: (rows.split(), columns.split()) for block, _, _, rows, columns in heads}
    for block, n, m, _, _ in heads:
        assert (int(n), int(m)) == tuple(map(len, sides[block]))
    return form.words, lines, sides


def matrices(sides, found):
    return {
        block: np.array([[found.get(f"{block}_{r}_{c}", 0.0) for c in columns] for r in rows])
        for block, (rows, columns) in sides.items()
    }


def assembled(name, sides, M, turned):
    """D_Brob of the words: J_p^T [W_P + J_i^-T D_Li] + D_mi, columns by their parameter."""
    names = [p.name for p in derived(name).base.parameters]
    motors = sides["Jpinv"][0]
    Jp = M.get("Jp", np.linalg.inv(M["Jpinv"]))
    D = np.zeros((len(motors), len(names)))
    for block, (rows, columns) in sides.items():
        at = [names.index(c) for c in columns if c in names]
        if block == "WP":
            D[:, at] += Jp.T @ M[block]
        elif block.startswith("DL"):
            D[:, at] += Jp.T @ turned(M[f"J{block[2:]}inv"]).T @ M[block]
        elif block.startswith("Dm"):
            D[np.ix_([motors.index(r) for r in rows], at)] += M[block]
    return D


def states(name):
    """((q, qd, qdd) of the motors, what the lines read) at closed states near home."""
    derivation, model = derived(name), compiled(name)
    closure = derivation.model.closure
    solved, given = list(closure.solved), list(closure.given)
    for q, qd, qdd in motor_states(name):
        u, ud = model.close(q[None]), model.coupling(q[None])[0] @ qd
        F = closure.jacobians(u)[0]
        drift = closure.evaluate(closure.drift, u, ud[None])[0]
        udd = np.zeros(len(ud))
        udd[given] = qdd
        udd[solved] = -np.linalg.solve(F[:, solved], F[:, given] @ qdd + drift)
        yield (q, qd, qdd), known(derivation, u[0], ud, udd)


def distance(name, turned=np.array):
    """Of the assembled blocks from the base regressor of the emitted C, over its largest entry."""
    _, lines, sides = printed(name)
    worst = 0.0
    for motion, values in states(name):
        D = assembled(name, sides, matrices(sides, run_lines(lines, values)), turned)
        expected = compiled(name).base_regressor(*(x[None] for x in motion))[0]
        worst = max(worst, np.max(np.abs(D - expected)) / np.max(np.abs(expected)))
    return worst


SLOW = [pytest.param(n, marks=pytest.mark.slow) for n in ("3rrr", "delta", "stewart")]


@pytest.mark.parametrize(
    "name", ["orthoglide-2003", "orthoglide-2003-similar-legs", "orthoglide-2012", *SLOW]
)
def test_blocks_make_the_regressor_of_the_c(name):
    assert distance(name) < 1e-12


def test_without_the_inverse_as_scanned_they_do_not():
    """Eqs. (27) to (29) letter by letter: J_p^T J_i^T D_Li."""
    assert distance("orthoglide-2003", np.linalg.inv) > 0.1


def test_jacobians_are_the_slopes_of_the_spheres():
    """Bars hold the platform on spheres: L_i = p_i + 1/2 - sqrt(D^2 - p_j^2 - p_k^2)."""
    D, name = 0.31, "orthoglide-2003"
    _, lines, sides = printed(name)
    axes = {"11": "P", "12": "Px", "13": "Py"}
    for (q, _, _), values in states(name):
        M = matrices(sides, run_lines(lines, values))
        p = {"Px": values["qPx"], "Py": values["qPy"], "P": values["qP"] - values["a"]}
        for i, (motor, own) in enumerate(axes.items()):
            rest = [axis for axis in p if axis != own]
            root = np.sqrt(D**2 - sum(p[axis] ** 2 for axis in rest))
            assert q[i] == pytest.approx(p[own] + 0.5 - root, abs=1e-9)
            slopes = [1.0 if axis == own else p[axis] / root for axis in ("Px", "Py", "P")]
            np.testing.assert_allclose(M["Jpinv"][i], slopes, atol=1e-9)
            np.testing.assert_allclose(M[f"J{motor[1]}inv"][0], slopes, atol=1e-9)
        np.testing.assert_allclose(M["Jp"] @ M["Jpinv"], np.eye(3), atol=1e-12)


def test_sizes_and_order_are_the_paper_s():
    words, _, sides = printed("orthoglide-2003")
    told = "\n".join(words)
    assert "(23) tau = DBrob KBrob, DBrob = [DP DB1 DB2 DB3]: 3 x 43" in told
    assert "(29) DB3 = [Dm3 on row 13, else 0 | Jp^T J3^-T DL3]: 3 x 14" in told
    assert sides["Dm2"] == (["12"], ["Ia12R", "Fv12", "Fs12", "Off12"])  # eq. (25)
    assert sides["DL1"][1] == [
        "ZZ21R", "MX21", "MY21R", "XX31R", "XY31R", "XZ31R", "YZ31R", "ZZ31R", "MY31R", "MX41"
    ]  # fmt: skip
    alike = "\n".join(printed("orthoglide-2003-similar-legs")[0])
    assert "Dsym = [DP | Dmi on the rows of their motors | DLS]: 3 x 23" in alike
    assert "DLS = Jp^T sum_i (Ji^-T DLi): 3 x 10" in alike


def test_latex_has_the_names_of_the_paper():
    form = block_form(derived("orthoglide-2003").model, derived("orthoglide-2003").base)
    latex = sheet_latex(form.sheet)
    for name in ("J^{-1}_{1;21,Px}", "J^{p}_{Px,11}", "D^{L1}_{11,MX21}", "W^{P}_{Py,MPR}"):
        assert f"{name} =" in latex
    assert latex.count("{") == latex.count("}")


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("five-bar", "no platform"),
        ("puma560", "no platform"),
        pytest.param("evra", "all its motors", marks=pytest.mark.slow),
    ],
)
def test_robots_without_such_blocks_are_refused(name, what):
    with pytest.raises(RobotError, match=what):
        block_form(model_of(name), base_of(name))
