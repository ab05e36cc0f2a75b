"""Values that cannot be those of the joint: from one link of known inertia, made by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from modeler.diagnosis import plausible
from modeler.diagnosis.candidates import Candidate, JointScale
from modeler.diagnosis.plausible import objection
from modeler.diagnosis.signals import SignalReference, tilt_axes
from modeler.effects.catalogue import effect_named
from tests.chain import chain_of

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
        reference=SimpleNamespace(links=np.zeros(1)),
    )


def pick(name):
    effect = effect_named(name)
    return Candidate(effect, effect.forms[0], "1", 0, {"f": 10.0})


def rung(inertia):
    """Compliance of a joint that rings at 10 Hz with that inertia, rad/(N m)."""
    return {"Cj1": 1.0 / (inertia * (2 * np.pi * 10.0) ** 2), "f": 10.0}


@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_a_joint_that_rings_with_its_own_inertia_is_plausible(ratio):
    assert objection(state(), pick("elasticity"), rung(ratio * INERTIA)) == ""


@pytest.mark.parametrize(("unit", "named"), [("rad", "20 kg m2"), ("m", "20 kg on this")])
def test_ten_times_the_inertia_is_not_this_joint(unit, named):
    text = objection(state(unit), pick("elasticity"), rung(10.0 * INERTIA))
    assert named in text and "the links have 2 kg" in text and "something else rings" in text
    assert objection(state(unit), pick("elasticity"), rung(0.1 * INERTIA))


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
    text = objection(made, pick("presliding"), {"Fz1": level, "d": 0.01})
    assert ("all friction of its joint is 3 N m" in text) is said, text


def levered(curve, weight=0.5, noise=0.1):
    """A state whose candidate has that torque over q from -1 to 1 rad."""
    made = state(weight=weight)
    q = np.linspace(-1.0, 1.0, 100)
    made.rows.signals[0].q = q[:, None]
    made.rows.filtered = lambda j, values: np.concatenate(values)
    made.rows.columns = lambda candidate: (curve(q)[:, None],)
    made.residual = [noise * np.cos(50.0 * q)]
    made.rows.cache = {}
    return made


@pytest.mark.parametrize(("weight", "doubted"), [(0.5, False), (0.01, True)])
def test_a_spring_balances_only_a_joint_that_gravity_turns(weight, doubted):
    said = objection(levered(np.square, weight), pick("constant_force_spring"), {"Kgl1": 1.0})
    assert ("gravity does not turn joint 1" in said) is doubted


@pytest.mark.parametrize(
    ("bent", "links", "doubted"),
    [(0.5, False, False), (0.1, False, True), (0.1, True, False), (0.02, True, True)],
)
def test_a_lever_that_a_straight_line_describes_is_doubted(bent, links, doubted):
    """With link data a bend is seen that free inertias could make."""
    made = levered(lambda q: 3.0 + q + bent * q**2)
    made.data.prior = SimpleNamespace(has_bodies=links)
    said = objection(made, pick("constant_force_spring"), {"Kgl1": 1.0})
    assert ("a straight line in q" in said) is doubted


def test_other_effects_are_not_asked():
    assert objection(state(), pick("offset"), {"Off1": 1.0}) == ""


@pytest.mark.parametrize(
    ("rest", "having", "doubted"), [(0.5, [], False), (2.5, [], True), (2.5, ["offset"], False)]
)
def test_a_spring_that_is_never_near_its_rest_is_a_constant_torque(rest, having, doubted):
    made = state()
    made.data.compiled.spec.standard = [SimpleNamespace(effect=e, joint="1") for e in having]
    made.scales = [JointScale(speed=1.0, range=1.5, load=1.0, angular=True, middle=0.0)]
    effect = effect_named("spring")
    spring = Candidate(effect, effect.forms[0], "1", 0, {"q0": rest, "h": 0.0})
    assert ("a constant torque" in objection(made, spring, {"Ks1": 1.0})) is doubted


def felt_of(state, felt, values):
    """A state with a body of these parameters on link 1, each felt alike and alone."""
    state.picks, state.values = (pick("payload"),), [np.array(values)]
    state.rows.signals, state.rows.W = [None], [np.zeros((100, 0))]
    state.sigma, state.data.free = np.ones(1), []
    return state, state.picks[0], dict(zip(felt, values, strict=True))


@pytest.mark.parametrize(
    ("inertia", "built"), [((0.2, 0.3, 0.4), True), ((0.2, 0.3, 2.5), False), ((-2, 3, 4), False)]
)
def test_a_body_has_the_inertia_of_a_body(monkeypatch, inertia, built):
    names = ["XX", "YY", "ZZ", "MX", "M"]
    columns = np.random.default_rng(1).normal(size=(100, 5))
    felt = [SimpleNamespace(name=f"{name}1", joint="1") for name in names]
    monkeypatch.setattr(plausible, "body_parameters", lambda candidate, signals: felt)
    monkeypatch.setattr(plausible, "columns_of", lambda rows, candidate: (columns,))
    made = felt_of(state(), [*names[:4], "mass"], [*inertia, 0.1, 1.0])
    assert (objection(*made) == "") is built


def test_no_body_has_a_negative_mass():
    assert "no body has a mass of -4 kg" in objection(state(), pick("payload"), {"mass": -4.0})


def test_a_gain_that_is_far_off_is_a_matter_of_sign_or_unit():
    assert objection(state(), pick("drive_gain"), {"eps1": 0.2}) == ""
    assert "-1 times" in objection(state(), pick("drive_gain"), {"eps1": 2.0})
    assert "check sign and unit" in objection(state(), pick("drive_gain"), {"eps1": 1.0})


@pytest.mark.parametrize(("robot", "axes"), [("two-link", 1), ("demo-arm", 2)])
def test_an_arm_that_moves_in_a_plane_feels_a_tilt_in_it_alone(robot: str, axes: int) -> None:
    compiled = chain_of(robot).compiled
    links = np.random.default_rng(2).uniform(1.0, 2.0, len(compiled.spec.base))
    reference = SignalReference(compiled, links, 0.0, {})
    found = tilt_axes(reference)
    assert len(found) == axes
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0)
