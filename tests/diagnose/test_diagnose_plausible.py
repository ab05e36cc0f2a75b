"""Values that cannot be those of the joint: from one link of known inertia, made by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from modeler.diagnosis import plausibility
from modeler.diagnosis.candidates import Candidate, JointScale
from modeler.diagnosis.plausibility import find_caveat
from modeler.diagnosis.signals import SignalReference, compute_tilt_axes
from modeler.effects.catalogue import find_effect
from tests.chain import chain_of
from tests.rotation import with_cases

INERTIA = 2.0  # kg m^2


def state(unit="rad", weight=0.0):
    spec = SimpleNamespace(joints=[SimpleNamespace(unit=unit)])
    compiled = SimpleNamespace(
        inertia_matrix=lambda q, beta: np.full((len(q), 1, 1), INERTIA), spec=spec
    )
    return SimpleNamespace(
        rows=SimpleNamespace(
            signals=[SimpleNamespace(q=np.zeros((100, 1)), static=np.full((100, 1), weight))],
            y=[np.ones(100)],
        ),
        data=SimpleNamespace(compiled=compiled, prior=None),
        spec=spec,
        reference=SimpleNamespace(link_parameters=np.zeros(1)),
    )


def pick(name):
    effect = find_effect(name)
    return Candidate(effect, effect.forms[0], "1", 0, {"f": 10.0})


@pytest.mark.parametrize(("level", "said"), [(2.0, False), (5.0, True)])
def test_a_part_of_the_friction_is_no_larger_than_all_of_it(level, said):
    friction = [
        SimpleNamespace(kind="friction", rows=(0,)),
        SimpleNamespace(kind="inertial", rows=(0,)),
    ]
    made = state()
    made.spec.base = friction
    made.rows.W = [np.column_stack([np.sign(np.sin(np.arange(100.0))), np.full(100, 50.0)])]
    made.beta, made.picks = np.array([3.0, 1.0]), (pick("presliding"),)
    text = find_caveat(made, pick("presliding"), {"Fz1": level, "d": 0.01})
    assert ("all friction of its joint is 3 N m" in text) is said, text


def levered(curve, weight=0.5, noise=0.1):
    """A state whose candidate has that torque over q from -1 to 1 rad."""
    made = state(weight=weight)
    q = np.linspace(-1.0, 1.0, 100)
    made.rows.signals[0].q = q[:, None]
    made.rows.filter_samples = lambda j, values: np.concatenate(values)
    made.rows.build_columns = lambda candidate: (curve(q)[:, None],)
    made.residual = [noise * np.cos(50.0 * q)]
    made.rows.cache = {}
    return made


@with_cases(
    "bent, weight, links, doubt",
    (0.5, 0.5, False, ""),
    (0.5, 0.01, False, "gravity does not turn joint 1"),
    (0.1, 0.5, False, "a straight line in q"),
    (0.1, 0.5, True, ""),
    (0.02, 0.5, True, "a straight line in q"),
)
def test_a_lever_balances_gravity_and_is_no_straight_line(bent, weight, links, doubt):
    """With link data a bend is seen that free inertias could make."""
    made = levered(lambda q: 3.0 + q + bent * q**2, weight)
    made.data.prior = SimpleNamespace(has_bodies=links)
    said = find_caveat(made, pick("constant_force_spring"), {"Kgl1": 1.0})
    assert doubt in said and bool(said) is bool(doubt)


@pytest.mark.parametrize(
    ("rest", "having", "doubted"), [(0.5, [], False), (2.5, [], True), (2.5, ["offset"], False)]
)
def test_a_spring_that_is_never_near_its_rest_is_a_constant_torque(rest, having, doubted):
    made = state()
    made.data.compiled.spec.standard = [SimpleNamespace(effect=e, joint="1") for e in having]
    made.joint_scales = [JointScale(speed=1.0, range=1.5, load=1.0, angular=True, middle=0.0)]
    effect = find_effect("spring")
    spring = Candidate(effect, effect.forms[0], "1", 0, {"q0": rest, "h": 0.0})
    assert ("a constant torque" in find_caveat(made, spring, {"Ks1": 1.0})) is doubted


@pytest.mark.parametrize(
    ("inertia", "built"), [((0.2, 0.3, 0.4), True), ((0.2, 0.3, 2.5), False), ((-2, 3, 4), False)]
)
def test_a_body_has_the_inertia_of_a_body(monkeypatch, inertia, built):
    """Parameters of a body on link 1, each observed alike and alone."""
    names, values = ["XX1", "YY1", "ZZ1", "MX1", "M1"], [*inertia, 0.1, 1.0]
    felt = [SimpleNamespace(name=name, joint="1") for name in names]
    columns = np.random.default_rng(1).normal(size=(100, 5))
    monkeypatch.setattr(plausibility, "list_body_parameters", lambda candidate, signals: felt)
    monkeypatch.setattr(plausibility, "build_columns", lambda rows, candidate: (columns,))
    made, payload = state(), pick("payload")
    made.picks, made.values = (payload,), [np.array(values)]
    made.sigma, made.data.free_columns = [1.0], []
    made.rows.signals, made.rows.W = [None], [np.zeros((100, 0))]
    said = dict(zip(["XX", "YY", "ZZ", "MX", "mass"], values, strict=True))
    assert (find_caveat(made, payload, said) == "") is built


@with_cases(
    "effect, values, said",
    ("payload", {"mass": -4.0}, "no body has a mass of -4 kg"),
    ("drive_gain", {"eps1": 2.0}, "-1 times"),
    ("drive_gain", {"eps1": 1.0}, "check sign and unit"),
    ("drive_gain", {"eps1": 0.2}, ""),
    ("offset", {"Off1": 1.0}, ""),
)
def test_masses_gains_and_others(effect, values, said):
    """A gain that is far off is a matter of sign or unit; of most effects nothing is asked."""
    text = find_caveat(state(), pick(effect), values)
    assert said in text and bool(said) is bool(text)


@pytest.mark.parametrize(("robot", "axes"), [("two-link", 1), ("demo-arm", 2)])
def test_an_arm_that_moves_in_a_plane_feels_a_tilt_in_it_alone(robot: str, axes: int) -> None:
    compiled = chain_of(robot).compiled
    links = np.random.default_rng(2).uniform(1.0, 2.0, len(compiled.spec.base))
    reference = SignalReference(compiled, links, 0.0, {})
    value = compute_tilt_axes(reference)
    assert len(value) == axes
    np.testing.assert_allclose(np.linalg.norm(value, axis=1), 1.0)
