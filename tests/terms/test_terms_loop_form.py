"""J_t, J_p and the torque of robots with loops, as they are printed, against the compiled C."""

from dataclasses import replace

import numpy as np
import pytest

from modeler.formulas.function_sheet import sheet_lines
from modeler.formulas.regressor_form import regressor_form, short_form
from tests.terms.cases import model_of
from tests.terms.printed_lines import compiled, derived, known, printed_coupling, run_lines
from tests.terms.test_terms_regressor_form import printed_columns
from tests.terms.test_terms_whole_torque import check


def motor_states(name):
    """Motors near home, their speeds and accelerations."""
    closure = derived(name).model.closure
    home, rng = np.array(closure.home)[list(closure.given)], np.random.default_rng(8)
    for _ in range(3):
        yield (home + rng.uniform(-0.03, 0.03, len(home)), *rng.uniform(-1, 1, (2, len(home))))


@pytest.mark.slow
def test_a_block_of_four_equations(loop_robots_folder):
    check(loop_robots_folder / "rccc.toml")


def test_orthoglide_is_isotropic_where_its_legs_are_straight():
    """J_p is the identity where every bar lies along its slide: motors and platform move alike."""
    derivation = derived("orthoglide-2003")
    lines = sheet_lines(short_form(derivation.model, derivation.base).sheet)
    u = {"21": -np.pi / 2, "22": -np.pi / 2, "23": -np.pi / 2}
    names = [joint.name for joint in derivation.model.robot.free]
    zeros = [0.0] * len(names)
    found = run_lines(
        lines, known(derivation, [u.get(n, 0.0) for n in names], zeros, beta=[0.0] * 43)
    )
    axes = {"11": "P", "12": "Px", "13": "Py"}
    for a, axis in axes.items():
        for p in ("Px", "Py", "P"):
            assert found.get(f"Jp{p}_{a}", 0.0) == pytest.approx(float(p == axis), abs=1e-12)


def test_guegan_relations_stand_beside_the_formulas():
    """Eq. 42: G says q4 = -q3, q5 = -q2 - pi/2, q7 = q3 of every leg."""
    form = short_form(derived("orthoglide-2003").model, derived("orthoglide-2003").base)
    assert form.loops is not None
    told = "\n".join(form.loops)
    assert "q41 = -q31; q51 = -q21 - pi/2; q71 = q31" in told
    assert "rows of J_t: Jp<p>_<a> of p, Jt<u>_<a> of the others; of motors: 1 and 0" in told
    assert "tau = J_t' t, t: torques of the opened tree along u" in told


# S. Briot, M. Gautier, 2012, part 2: f_p, the spheres on which the bars hold the platform.
SPHERES = [
    "x**2 + y**2 + (z - q11 - d6)**2 - d4**2",
    "(x - q12 - d6 + a)**2 + y**2 + (z - a)**2 - d4**2",
    "x**2 + (y - q13 - d6 + a)**2 + (z - a)**2 - d4**2",
]


def test_spheres_are_those_of_the_paper():
    derivation = derived("orthoglide-2012")
    lines = sheet_lines(short_form(derivation.model, derivation.base).sheet)
    names, rng = [j.name for j in derivation.model.robot.free], np.random.default_rng(2)
    u = rng.uniform(-1, 1, len(names))
    found = run_lines(lines, known(derivation, u, u, beta=[0.0] * derivation.base.rank))
    values = found | {"x": found["q6x"], "y": found["q6y"], "z": found["q6"]}
    for k, text in enumerate(SPHERES, start=1):
        assert found[f"fp{k}"] == pytest.approx(eval(text, {}, values), abs=1e-12)


@pytest.mark.parametrize(
    "name",
    [
        "orthoglide-2003",
        "3rrr",
        *(pytest.param(n, marks=pytest.mark.slow) for n in ("delta", "stewart")),
    ],
)
def test_spheres_vanish_where_the_loops_are_closed(name):
    derivation, model = derived(name), compiled(name)
    none = replace(derivation.base, parameters=())
    lines = sheet_lines(short_form(derivation.model, none).sheet)
    closure = derivation.model.closure
    for q, _, _ in motor_states(name):
        for step in (0.0, 1e-3):
            u = model.close(q[None] + step)[0]
            found = run_lines(lines, known(derivation, u, 0 * u))
            spheres = [found[f"fp{k + 1}"] for k in range(len(closure.given))]
            assert np.max(np.abs(spheres)) < 1e-12


def test_six_motors_leave_the_inverse_of_k_to_a_solver():
    """J_t = L K^-1 of a Stewart platform, L and K printed, against the closure's Jacobian."""
    model = model_of("stewart")
    none = replace(derived("five-bar").base, parameters=())
    form = short_form(model, none)
    assert any("F J_t = 0" in line for line in form.loops)
    closure, names = model.closure, [joint.name for joint in model.robot.free]
    assert closure is not None and closure.platform is not None
    posture = {f"q{name}": u for name, u in zip(names, closure.home, strict=True)}
    still = {f"qd{name}": 0.0 for name in names}
    found = run_lines(sheet_lines(form.sheet), {**model.geometry.values, **posture, **still})
    L = np.array(
        [
            [found.get(f"L{x}_{names[p]}", float(x == names[p])) for p in closure.platform]
            for x in names
        ]
    )
    entries = [entry for line in closure.jacobian for entry in line]
    inputs = {f"q[{k}]": u for k, u in enumerate(closure.home)}
    values = model.graph.evaluate(entries, {**model.geometry.values, **inputs})
    F = np.array(values, dtype=float).reshape(len(closure.equations), len(names))
    expected = -np.linalg.solve(F[:, list(closure.solved)], F[:, list(closure.given)])
    J = L @ np.linalg.inv(L[list(closure.given)])
    assert np.max(np.abs(J[list(closure.solved)] - expected)) < 1e-11 * np.max(np.abs(expected))


def test_columns_of_a_loop_robot_are_the_tree_s_projected():
    name = "five-bar"
    derivation, model = derived(name), compiled(name)
    lines = sheet_lines(regressor_form(derivation.model, derivation.base).sheet)
    for q, qd, qdd in motor_states(name):
        u, G = model.close(q[None])[0], model.coupling(q[None])[0]
        first = run_lines(lines, known(derivation, u, G @ qd, [0.0] * len(u)))
        J, bias = printed_coupling(derivation, first)
        found = run_lines(lines, known(derivation, u, J @ qd, J @ qdd + bias))
        expected = model.base_regressor(q[None], qd[None], qdd[None])[0]
        printed = J.T @ printed_columns(derivation, found)
        assert np.max(np.abs(printed - expected)) < 1e-12 * np.max(np.abs(expected))
