"""Energy functions and Kane's form: the printed lines are run, beside moving points and frames."""

import json
from dataclasses import replace

import numpy as np
import pytest

from modeler.cli import main
from modeler.derivation import draw_random_states
from modeler.formulas import paper_forms as by_link
from modeler.formulas.function_sheet import format_sheet
from modeler.robot import parse_robot_text
from tests.json_schemas import check_schema
from tests.papers import mechanisms as m
from tests.papers.oracles import bodies, inertia_of, triads, wrist
from tests.rotation import rotating
from tests.terms.cases import model_of
from tests.terms.printed_lines import derived, run_lines

RNG = np.random.default_rng()


def states_of(model):
    return draw_random_states(model, 5, RNG)


def number(x, values):
    return float(x.subs({s: values[s.name] for s in x.free_symbols}))


def placed(model, u):
    """{row: frame in floats}; u are the values of the free variables."""
    geometry, values, items = model.geometry, model.geometry.values, {}
    for k, row in enumerate(geometry.rows):
        table = (row.gamma, row.b, row.alpha, row.d, row.theta, row.r)
        gamma, b, alpha, d, theta, r = (number(x, values) for x in table)
        if row.index is not None:
            q = row.rate * sum(float(c) * u[i] for i, c in geometry.forms[row.index].items())
            theta, r = (theta + q, r) if row.joint.is_revolute else (theta, r + q)
        before = m.GROUND if row.parent is None else items[row.parent]
        items[k] = before.then(gamma, b, alpha, d, theta, r)
    return items


@pytest.mark.parametrize("name", ["odd", "sr400", *rotating("wrist", "panda", "evra")])
def test_the_printed_energy_functions_are_those_of_moving_points(name):
    model = derived(name).model
    free = model.robot.free_joints
    states = states_of(model)
    equation, off = by_link.energy_functions(model, states)
    assert off < 1e-12
    u, speed = states[0][0], states[1][0]
    start = dict(model.robot.evaluate_symbols()) | dict(model.geometry.values)
    for joint, q, qd in zip(free, u, speed, strict=True):
        start |= {f"q{joint.name}": q, f"qd{joint.name}": qd}
    text = run_lines(format_sheet(equation.sheet).splitlines(), start)
    frames = m.moving(lambda u: m.Posture(placed(model, u), {}), u, speed).bodies
    gravity = np.array([number(x, start) for x in model.geometry.gravity])
    message = 0
    for k in by_link._find_body_rows(model):
        w, v = m.rigid(frames[k])[:2]
        h = m.kinetic(w, v) / 2
        h[6:] -= np.array([*(gravity @ frames[k].turn.real), gravity @ frames[k].place.real])
        names = [f"h{p}_{model.geometry.rows[k].joint.name}" for p in m.INERTIA]
        np.testing.assert_allclose([text.get(n, 0.0) for n in names], h, rtol=1e-10, atol=1e-11)
        message += sum(name in text for name in names)
    assert message > 10


def test_the_printed_form_of_kane_is_that_of_the_paper():
    """Velocities, beta and momenta by steps of the wrist's own places."""
    model = model_of("wrist")
    equation, off = by_link.kane_form(model, states_of(model))
    assert off < 1e-12
    p, (q, qd) = wrist(11), RNG.uniform(-2, 2, (2, 3))
    start = p | {f"q{k + 1}": x for k, x in enumerate(q)} | {"g": 9.81, "tau1": 1, "tau2": 2}
    start |= {f"qd{k + 1}": x for k, x in enumerate(qd)} | {"tau3": 4}
    axes = triads(q) | {"n": np.eye(3)}
    start |= {f"{b}_{k + 1}": turn[:, k] for b, turn in axes.items() for k in range(3)}
    text = run_lines(format_sheet(equation.sheet).splitlines(), start)
    none = np.zeros(3)
    power = 0.0
    for r, body in enumerate("abc"):
        v, w, turn = bodies(q, qd, p)[body]
        np.testing.assert_allclose(text[f"vCM{body}"], v, atol=1e-12)
        np.testing.assert_allclose(text[f"omega{body.upper()}"], turn @ w, atol=1e-12)
        np.testing.assert_allclose(text[f"p{2 * r + 1}"], p[f"{body}m"] * v, atol=1e-12)
        spin = turn @ inertia_of(body, p) @ w
        np.testing.assert_allclose(text[f"p{2 * r + 2}"], spin, atol=1e-12)
        for j, unit in enumerate(np.eye(3), 1):
            v1, w1, _ = bodies(q, unit, p)[body]
            np.testing.assert_allclose(text.get(f"beta{2 * r + 1}{j}", none), v1, atol=1e-12)
            np.testing.assert_allclose(text.get(f"beta{2 * r + 2}{j}", none), turn @ w1, atol=1e-12)
        power += text[f"F{2 * r + 2}"] @ turn @ w
    assert power == pytest.approx(qd @ [1, 2, 4])  # motors with their reactions


def test_slides_and_joints_that_follow_have_kanes_form_too():
    for name in ("scara", "sr400", "odd"):
        model = derived(name).model
        assert by_link.kane_form(model, states_of(model))[1] < 1e-12


def test_a_wrong_recursion_is_seen(monkeypatch):
    """Speeds without what the turning of the link before adds."""
    right, model = by_link._propagate_speeds, model_of("wrist")

    def without(model, qd):
        return [(w, [0 * x for x in V]) for w, V in right(model, qd)]

    monkeypatch.setattr(by_link, "_propagate_speeds", without)
    assert by_link.energy_functions(model, states_of(model))[1] > 1e-3
    wrong = lambda model, qd: [([2 * x for x in w], V) for w, V in right(model, qd)]  # noqa: E731
    monkeypatch.setattr(by_link, "_propagate_speeds", wrong)
    assert by_link.kane_form(model, states_of(model))[1] > 1e-3


def test_the_command_prints_and_writes_both(capsys, tmp_path):
    place = tmp_path / "w.json"
    assert main(["derive", "wrist", "--energy", "--kane", "--json", str(place)]) == 0
    out, text = capsys.readouterr().out, json.loads(place.read_text())
    assert "vCMa = -at3*qd1*a_2 + at2*qd1*a_3" in out and "hXX_2 = omega1_2**2/2" in out
    assert "PJ1" not in out
    check_schema("derive", text)
    assert max(text["energy"]["difference"], text["kane"]["difference"]) < 1e-12
    assert {"vCMc", "beta53", "F6"} <= {d["name"] for d in text["kane"]["definitions"]}
    assert main(["derive", "stewart", "--kane"]) == 1
    assert "--kane is written for robots without loops; leave it out" in capsys.readouterr().err


def test_triads_are_three_axes():
    from modeler.core.choices import read_builtin_robot

    for wrong in ('["a3", "a2"]', "3", '["a3", "-", "a1"]'):
        text = read_builtin_robot("wrist").replace('["a3", "-a2", "a1"]', wrong)
        with pytest.raises(Exception, match=r"\[terms\], triads, 1: got .* expected three axes"):
            model = model_of("wrist")
            model = replace(model, robot=parse_robot_text(text, "wrist"))
            by_link.kane_form(model, states_of(model))
