"""Printed forms of robots with loops: blocks of Guegan, Khalil and Lemoine 2003 (eqs. (1), (2),
(23) to (30)), J_t, J_p and the torque, against the compiled C.
"""

import re
from dataclasses import replace

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formulas import derive_block_form
from modeler.formulas.function_sheet import format_sheet
from modeler.formulas.regressor_form import derive_short_form
from tests.rotation import rotating
from tests.terms.cases import base_of, model_of
from tests.terms.printed_lines import compiled, derived, known, run_lines
from tests.terms.test_terms_whole_torque import check, motions_of


def printed(name):
    """(words, lines, {block: (rows, columns)}) as they are printed."""
    form = derive_block_form(derived(name).model, derived(name).base)
    lines = format_sheet(form.sheet).splitlines()
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
    solved, inputs = list(closure.solved), list(closure.actuated)
    for q, qd, qdd in motions_of(derived(name)):
        u, ud = model.close(q[None]), model.coupling(q[None])[0] @ qd
        F = closure.compute_jacobians(u)[0]
        drift = closure.evaluate_expressions(closure.drift, u, ud[None])[0]
        udd = np.zeros(len(ud))
        udd[inputs] = qdd
        udd[solved] = -np.linalg.solve(F[:, solved], F[:, inputs] @ qdd + drift)
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


QUICK = rotating("orthoglide-2003", "orthoglide-2012")
SLOW = [pytest.param(n, marks=pytest.mark.slow) for n in ("3rrr", "delta", "stewart")]


@pytest.mark.parametrize("name", ["orthoglide-2003-similar-legs", *QUICK, *SLOW])
def test_blocks_make_the_regressor_of_the_c(name):
    assert distance(name) < 1e-12


def test_without_the_inverse_as_scanned_they_do_not():
    """Eqs. (27) to (29) letter by letter: J_p^T J_i^T D_Li."""
    assert distance("orthoglide-2003", np.linalg.inv) > 0.1


def test_sizes_and_order_are_the_paper_s():
    words, _, sides = printed("orthoglide-2003")
    text = "\n".join(words)
    assert "(23) tau = DBrob KBrob, DBrob = [DP DB1 DB2 DB3]: 3 x 43" in text
    assert "(29) DB3 = [Dm3 on row 13, else 0 | Jp^T J3^-T DL3]: 3 x 14" in text
    assert sides["Dm2"] == (["12"], ["Ia12R", "Fv12", "Fs12", "Off12"])  # eq. (25)
    assert sides["DL1"][1] == "ZZ21R MX21 MY21R XX31R XY31R XZ31R YZ31R ZZ31R MY31R MX41".split()
    alike = "\n".join(printed("orthoglide-2003-similar-legs")[0])
    assert "Dsym = [DP | Dmi on the rows of their motors | DLS]: 3 x 23" in alike
    assert "DLS = Jp^T sum_i (Ji^-T DLi): 3 x 10" in alike


@pytest.mark.parametrize(
    ("name", "what"),
    [("five-bar", "no platform"), pytest.param("evra", "all its motors", marks=pytest.mark.slow)],
)
def test_robots_without_such_blocks_are_refused(name, what):
    with pytest.raises(RobotError, match=what):
        derive_block_form(model_of(name), base_of(name))


@pytest.mark.slow
def test_a_block_of_four_equations(loop_robots_folder):
    check(loop_robots_folder / "rccc.toml")


def test_guegan_relations_stand_beside_the_formulas():
    """Eq. 42: G says q4 = -q3, q5 = -q2 - pi/2, q7 = q3 of every leg."""
    form = derive_short_form(derived("orthoglide-2003").model, derived("orthoglide-2003").base)
    assert form.loops is not None
    text = "\n".join(form.loops)
    assert "q41 = -q31; q51 = -q21 - pi/2; q71 = q31" in text
    assert "rows of J_t: Jp<p>_<a> of p, Jt<u>_<a> of the others; of motors: 1 and 0" in text
    assert "tau = J_t' t, t: torques of the opened tree along u" in text


# S. Briot, M. Gautier, 2012, part 2: f_p, the spheres on which the bars hold the platform.
SPHERES = [
    "x**2 + y**2 + (z - q11 - d6)**2 - d4**2",
    "(x - q12 - d6 + a)**2 + y**2 + (z - a)**2 - d4**2",
    "x**2 + (y - q13 - d6 + a)**2 + (z - a)**2 - d4**2",
]


def test_spheres_are_those_of_the_paper():
    derivation = derived("orthoglide-2012")
    lines = format_sheet(derive_short_form(derivation.model, derivation.base).sheet).splitlines()
    names, rng = [j.name for j in derivation.model.robot.free_joints], np.random.default_rng(2)
    u = rng.uniform(-1, 1, len(names))
    out = run_lines(lines, known(derivation, u, u, beta=[0.0] * derivation.base.rank))
    values = out | {"x": out["q6x"], "y": out["q6y"], "z": out["q6"]}
    for k, text in enumerate(SPHERES, start=1):
        assert out[f"fp{k}"] == pytest.approx(eval(text, {}, values), abs=1e-12)


def test_six_motors_leave_the_inverse_of_k_to_a_solver():
    """J_t = L K^-1 of a Stewart platform, L and K printed, against the closure's Jacobian."""
    model = model_of("stewart")
    none = replace(derived("five-bar").base, parameters=())
    form = derive_short_form(model, none)
    assert any("F J_t = 0" in line for line in form.loops)
    closure, names = model.closure, [joint.name for joint in model.robot.free_joints]
    assert closure is not None and closure.platform is not None
    posture = {f"q{name}": u for name, u in zip(names, closure.home, strict=True)}
    still = {f"qd{name}": 0.0 for name in names}
    out = run_lines(
        format_sheet(form.sheet).splitlines(), {**model.geometry.values, **posture, **still}
    )
    L = np.array(
        [
            [out.get(f"L{x}_{names[p]}", float(x == names[p])) for p in closure.platform]
            for x in names
        ]
    )
    entries = [entry for line in closure.jacobian for entry in line]
    inputs = {f"q[{k}]": u for k, u in enumerate(closure.home)}
    values = model.graph.evaluate_outputs(entries, {**model.geometry.values, **inputs})
    F = np.array(values, dtype=float).reshape(len(closure.equations), len(names))
    expected = -np.linalg.solve(F[:, list(closure.solved)], F[:, list(closure.actuated)])
    J = L @ np.linalg.inv(L[list(closure.actuated)])
    assert np.max(np.abs(J[list(closure.solved)] - expected)) < 1e-11 * np.max(np.abs(expected))
