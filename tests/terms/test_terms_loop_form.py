"""J_t, J_p and the torque of robots with loops, as they are printed, against the compiled C."""

from dataclasses import replace

import numpy as np
import pytest

from modeler.api import load
from modeler.symbolic import derive_model
from modeler.terms import regressor_form, sheet_lines, short_form
from tests.terms.printed_lines import compiled, derived, known, run_lines, torque
from tests.terms.test_terms_regressor_form import printed_columns
from tests.terms.test_terms_short_form import moving_parts

COMPLETE = ["five-bar", "orthoglide-2003"]


def motor_states(name):
    """Motors near home, their speeds and accelerations."""
    closure = derived(name).model.closure
    home, rng = np.array(closure.home)[list(closure.given)], np.random.default_rng(8)
    for _ in range(3):
        yield (home + rng.uniform(-0.03, 0.03, len(home)), *rng.uniform(-1, 1, (2, len(home))))


def printed_coupling(derivation, found) -> tuple[np.ndarray, np.ndarray]:
    """J_t with the rows of the motors and of the platform, and the bias of the accelerations."""
    closure, names = derivation.model.closure, [j.name for j in derivation.model.robot.free]
    J = np.zeros((len(names), len(closure.given)))
    for i, a in enumerate(closure.given):
        J[a, i] = 1.0
        for u in closure.solved:
            at = f"{names[u]}_{names[a]}"
            J[u, i] = found.get(f"Jt{at}", found.get(f"Jp{at}", 0.0))
    return J, np.array([found.get(f"b{name}", 0.0) for name in names])


def check(name) -> None:
    derivation, model = derived(name), compiled(name)
    form = short_form(derivation.model, derivation.base)
    lines, names = sheet_lines(form.sheet), [j.name for j in derivation.model.robot.free]
    beta = np.random.default_rng(9).normal(size=derivation.base.rank) * moving_parts(name)
    assert form.loops is not None and form.loops.complete
    for q, qd, qdd in motor_states(name):
        u, G = model.close(q[None])[0], model.coupling(q[None])[0]
        found = run_lines(lines, known(derivation, u, G @ qd, beta=beta))
        J, bias = printed_coupling(derivation, found)
        assert np.max(np.abs(J - G)) < 1e-12 * np.max(np.abs(G))
        tau = J.T @ torque(found, names, G @ qd, J @ qdd + bias, form.chain)
        expected = model.base_regressor(q[None], qd[None], qdd[None])[0] @ beta
        assert np.max(np.abs(tau - expected)) < 1e-11 * np.max(np.abs(expected))


@pytest.mark.parametrize("name", COMPLETE)
def test_printed_lines_give_coupling_and_torque_of_the_c(name):
    check(name)


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
    told = "\n".join(form.loops.lines)
    assert "q41 = -q31; q51 = -q21 - pi/2; q71 = q31" in told
    assert "tau_a = t_a + sum_u Jt_ua t_u + sum_p Jp_pa f_p" in told


def test_six_motors_leave_the_inverse_of_k_to_a_solver():
    """J_t = L K^-1 of a Stewart platform, L and K printed, against the closure's Jacobian."""
    model = derive_model(load("stewart"))
    none = replace(derived("five-bar").base, parameters=())
    form = short_form(model, none)
    assert form.loops is not None and not form.loops.complete
    assert any("J_p = K^-1" in line for line in form.loops.lines)
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
