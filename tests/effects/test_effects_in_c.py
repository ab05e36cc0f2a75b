"""One definition, two evaluations: columns of the emitted C against the catalogue in numpy."""

import numpy as np
import pytest

from modeler.api import derive, generate, load
from modeler.core.expression import Expression
from modeler.effects.catalogue import CATALOGUE
from modeler.effects.effect import Acts, Effect
from modeler.robot.read import robot_from_text
from tests.modules import loaded

SAMPLES = 40
FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt,
    "exp": np.exp, "abs": np.abs, "sign": np.sign, "tanh": np.tanh,
}  # fmt: skip
SHAPES = {
    "h": 0.3, "vs": 0.3, "d": 1.3, "p": 1.7, "w": 0.5, "tau": 20.0, "b": 0.4, "q0": 0.8, "m": 3.0
}  # fmt: skip
REFERENCE = """
[reference]
ZZ1 = 1.2
ZZ2 = 3.0
MX2 = 3.0
MX3 = 1.1
ZZ3 = 0.4
Fv2 = 4.0
Fs2 = 2.0
"""


def written() -> list[tuple[Effect, int]]:
    """Every form of every effect on a joint that a robot file may name."""
    return [
        (effect, k)
        for effect in CATALOGUE
        for k in range(len(effect.forms))
        if effect.written and effect.acts is Acts.JOINT
    ]


def text_with(effect: Effect, form: int) -> str:
    """The demonstration arm with the effect on joint 2, beside viscous and Coulomb friction."""
    shapes = {s.name: SHAPES[s.name] for s in effect.forms[form].free}
    entry = ", ".join(['joint = "2"', *(f"{name} = {value}" for name, value in shapes.items())])
    text = load("demo-arm").text
    text = text[: text.index("[parameters]")]
    if effect.id in ("rotor_inertia", "viscous", "coulomb", "offset"):
        return text + REFERENCE
    lines = [line for line in text.splitlines() if not line.startswith(("rotor", "offset"))]
    place = lines.index("[effects]")
    lines.insert(place + 1, f"{effect.id} = [{{{entry}}}]")
    return "\n".join(lines) + REFERENCE


DAILY = ("stribeck", "load_friction", "presliding", "temperature_friction", "drive_gain")
"""One of each kind of quantity that an equation reads."""


def cases() -> list:
    """The first form of the daily ones; others rotate."""
    return [
        (effect, form)
        if effect.id in DAILY and form == 0
        else pytest.param(effect, form, marks=pytest.mark.rotating)
        for effect, form in written()
    ]


@pytest.mark.parametrize(("effect", "form"), cases(), ids=lambda x: getattr(x, "id", str(x)))
def test_c_computes_the_catalogues_equation(effect: Effect, form: int) -> None:
    robot = robot_from_text(text_with(effect, form), effect.id)
    derivation = derive(robot)
    assert derivation.base.proof.kind == "exact"
    assert derivation.base.proof.agreement < 1e-12
    compiled = loaded(generate(derivation))
    generator = np.random.default_rng(2)
    q, v, a = generator.uniform(-2.0, 2.0, (3, SAMPLES, 3))
    s = generator.uniform(0.1, 0.9, (SAMPLES, len(compiled.spec.signals)))
    signals = s if compiled.spec.signals else None
    phi = compiled.regressor(q, v, a, signals)
    names = [p.name for p in compiled.spec.standard]
    values = {"q": q[:, 1], "v": v[:, 1], "a": a[:, 1], **SHAPES, "k": 1.0}
    if effect.id == "counterbalance":
        values["m"] = 1.0
    chi = np.array([robot.reference.get(name, 0.0) for name in names])
    links = np.array([p.effect == "rigid_body" for p in compiled.spec.standard])
    load_torque = (phi @ (chi * links))[:, 1]
    still = np.zeros_like(q)
    weight = (compiled.regressor(q, still, still, signals) @ (chi * links))[:, 1]
    values |= {"load": load_torque, "static": weight, "torque": (phi @ chi)[:, 1]}
    for k, signal in enumerate(compiled.spec.signals):
        values[{"time": "t", "temperature": "T", "slip": "z"}[signal.kind]] = s[:, k]
    for column in effect.forms[form].columns:
        expected = evaluated(column.equation, values) * np.ones(SAMPLES)
        got = phi[:, 1, names.index(f"{column.prefix}2")]
        np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


def evaluated(equation: Expression, values: dict) -> np.ndarray:
    return np.asarray(equation.fold(values, FUNCTIONS, np.pi, float))


def test_every_id_of_the_contract_is_there() -> None:
    wanted = """
        viscous coulomb offset rotor_inertia asymmetric_viscous stribeck nonlinear_viscous
        load_friction position_friction presliding cable_hysteresis temperature_friction
        coupled_friction passive_friction spring counterbalance constant_force_spring payload
        link_inertia base_tilt external_force elasticity backlash motor_ripple joint_ripple
        encoder_offset encoder_eccentricity time_delay drive_gain drift coupled_inertia
    """
    assert {effect.id for effect in CATALOGUE} == {*wanted.split(), "torque_lag"}


def test_an_encoders_error_moves_links_and_rotor() -> None:
    """Column of the C against differences of the inverse dynamics, friction that jumps apart."""
    text = load("demo-arm").text
    text = text[: text.index("[parameters]")].replace(
        'viscous = "all"', 'viscous = "all"\nencoder_offset = ["2"]\nencoder_eccentricity = ["2"]'
    )
    robot = robot_from_text(text + REFERENCE + "Ia2 = 0.7\n", "offset")
    compiled = loaded(generate(derive(robot)))
    names = [p.name for p in compiled.spec.standard]
    chi = np.array([robot.reference.get(n, 0.0) for n in names])
    smooth = ("rigid_body", "viscous", "rotor_inertia")
    chi[[p.effect not in smooth for p in compiled.spec.standard]] = 0.0
    assert chi[names.index("Fv2")] == 4.0 and chi[names.index("Ia2")] == 0.7
    q, v, a = np.random.default_rng(4).uniform(-1.5, 1.5, (3, SAMPLES, 3))
    phi = compiled.regressor(q, v, a)
    step = np.array([0.0, 1e-6, 0.0])
    slope = (compiled.regressor(q + step, v, a) - compiled.regressor(q - step, v, a)) @ chi / 2e-6
    np.testing.assert_allclose(phi[:, :, names.index("dq2")], -slope, rtol=1e-6, atol=1e-6)
    moved = _moved_by_cosine(compiled, chi, q, v, a)
    np.testing.assert_allclose(phi[:, :, names.index("Ec2")], moved, rtol=1e-6, atol=1e-6)


def _moved_by_cosine(compiled, chi, q, v, a) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Torque for q2 + e cos q2, by differences in e."""
    e = 1e-6
    dq, dv, da = (np.zeros_like(q) for _ in range(3))
    dq[:, 1] = np.cos(q[:, 1])
    dv[:, 1] = -np.sin(q[:, 1]) * v[:, 1]
    da[:, 1] = -np.cos(q[:, 1]) * v[:, 1] ** 2 - np.sin(q[:, 1]) * a[:, 1]
    ahead = compiled.regressor(q + e * dq, v + e * dv, a + e * da) @ chi
    behind = compiled.regressor(q - e * dq, v - e * dv, a - e * da) @ chi
    return (ahead - behind) / (2.0 * e)
