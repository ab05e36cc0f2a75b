"""One definition, two evaluations: columns of the emitted C against the catalogue in numpy."""

import numpy as np
import pytest

from modeler.api import derive, generate, load
from modeler.effects.catalogue import CATALOGUE
from modeler.effects.effect import Effect, EffectTarget
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text
from tests.modules import loaded
from tests.texts import read_pairs

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]
SAMPLES = 40
FUNCTIONS = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "abs": np.abs,
    "sign": np.sign,
    "tanh": np.tanh,
}
SHAPES = read_pairs("h 0.3 vs 0.3 d 1.3 p 1.7 w 0.5 tau 20.0 b 0.4 q0 0.8 m 3.0")
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
    named = [law for law in CATALOGUE if law.can_be_stated and law.acts is EffectTarget.JOINT]
    return [(law, k) for law in named for k in range(len(law.forms))]


def text_with(effect: Effect, form: int) -> str:
    """The demonstration arm with the effect on joint 2, beside viscous and Coulomb friction."""
    text = load("demo-arm").text
    text = text[: text.index("[parameters]")]
    if effect.id not in ("rotor_inertia", "viscous", "coulomb", "offset"):
        shapes = {shape.name: SHAPES[shape.name] for shape in effect.forms[form].free_parameters}
        effects = dict.fromkeys(("viscous", "coulomb"), "all")
        text = replace_effects(text, effects | {effect.id: [{"joint": "2", **shapes}]})
    return text + REFERENCE


DAILY = ("stribeck", "load_friction", "presliding", "temperature_friction", "drive_gain")
"""One of each kind of quantity that an equation reads."""


CASES = [
    pytest.param(*case, marks=[pytest.mark.rotating] * (case[0].id not in DAILY or case[1] > 0))
    for case in written()
]  # the first form of the daily ones; others rotate


@pytest.mark.parametrize(("effect", "form"), CASES, ids=lambda x: getattr(x, "id", str(x)))
def test_c_computes_the_catalogues_equation(effect: Effect, form: int) -> None:
    robot = parse_robot_text(text_with(effect, form), effect.id)
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
        values[{"time": "t", "temperature": "T", "slip": "z", "bouc_wen": "z"}[signal.kind]] = s[
            :, k
        ]
    for column in effect.forms[form].columns:
        expected = np.ones(SAMPLES) * column.equation.fold(values, FUNCTIONS, np.pi, float)
        got = phi[:, 1, names.index(f"{column.prefix}2")]
        np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


def test_an_encoders_error_moves_links_and_rotor() -> None:
    """Column of the C against differences of the inverse dynamics, friction that jumps apart."""
    text = load("demo-arm").text
    text = text[: text.index("[parameters]")].replace(
        'viscous = "all"', 'viscous = "all"\nencoder_offset = ["2"]\nencoder_eccentricity = ["2"]'
    )
    robot = parse_robot_text(text + REFERENCE + "Ia2 = 0.7\n", "offset")
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
    by = (np.cos(q), -np.sin(q), -np.cos(q))
    moved = moved_torque(compiled, chi, (q, v, a), by)
    np.testing.assert_allclose(phi[:, :, names.index("Ec2")], moved, rtol=1e-6, atol=1e-6)


def moved_torque(compiled, chi, motion, by, e=1e-6):
    """Slope in e of the torque for q2 + e f(q2), by differences; `by` is f, f' and f''."""
    q, v, a = motion
    f, slope, curve = (x[:, 1] for x in by)
    d = np.zeros((3, *q.shape))
    d[:, :, 1] = f, slope * v[:, 1], curve * v[:, 1] ** 2 + slope * a[:, 1]
    ahead, behind = (compiled.regressor(*(np.array(motion) + h * d)) @ chi for h in (e, -e))
    return (ahead - behind) / (2.0 * e)
