"""The simulated arms against other people's mechanics, and the laws that they must keep."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from tests.hidden_effects.drives import equip
from tests.hidden_effects.effects import BASE, EFFECTS, hide
from tests.hidden_effects.motion import draw_bounds, motion
from tests.hidden_effects.plant import TICK, rate
from tests.hidden_effects.robots import KINDS, draw_arm
from tests.hidden_effects.sensors import logged_torque
from tests.hidden_effects.visibility import Trial, left_over, visibility
from tests.rotation import rotating

pytestmark = pytest.mark.usefixtures("plant_compiler")


@cache
def drawn(kind, seed, seconds):
    rng = np.random.default_rng(seed)
    plant, _ = draw_arm(rng, kind)
    bounds = draw_bounds(rng, plant.joints)
    path = motion(rng, seconds, bounds)
    return plant, path, equip(plant, bounds, path, "med", rng)


def arm(kind="3R", seed=3, seconds=6.0):
    """An equipped arm of one's own, its path and its scales."""
    plant, path, scales = drawn(kind, seed, seconds)
    return plant.copy(), path, scales


def moved(plant, path):
    """A run without noise.

    Attributes: q, v, a: (ticks, n) true motion; torque: of the motors; load: that of the links;
    rubbed: friction that every arm has; extra: torque beyond links, rotors and that friction;
    steady: (ticks,) where differences over ticks do not blur a change of sign.
    """
    plant.noise_torque, plant.encoder_step = 0, 1e-9
    run = plant.run(path, np.zeros(plant.joints), 1)
    q, v, a, torque = run.link, rate(run.link), np.zeros_like(run.link), logged_torque(run, 0.0)
    a[1:-1] = np.diff(q, 2, axis=0) / TICK**2
    load = plant.inverse_dynamics(q, v, a)[0]
    rubbed = plant.viscous * v + plant.coulomb * np.tanh(v / plant.coulomb_width) + plant.offset
    extra = torque - load - plant.rotor_inertia * a - rubbed
    steady = (np.abs(v) > 0.05).all(1)
    steady[:50] = steady[-50:] = False
    return SimpleNamespace(
        q=q, v=v, a=a, torque=torque, load=load, rubbed=rubbed, extra=extra, steady=steady
    )


def pinocchio_model(pin, plant):
    model, parent = pin.Model(), 0
    model.gravity.linear = plant.gravity.copy()
    for j in range(plant.joints):
        (ca, sa), (ct, st) = ((np.cos(x), np.sin(x)) for x in (plant.alpha[j], plant.theta0[j]))
        about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
        about_z = np.array([[ct, -st, 0], [st, ct, 0], [0, 0, 1]])
        place = pin.SE3(about_x, np.array([plant.d[j], 0, 0]))
        place *= pin.SE3(about_z, np.array([0, 0, plant.r[j]]))
        parent = model.addJoint(parent, pin.JointModelRZ(), place, f"joint {j}")
        body = pin.Inertia(plant.mass[j], plant.centre[j], plant.inertia[j].reshape(3, 3))
        model.appendBodyToJoint(parent, body, pin.SE3.Identity())
    return model


@pytest.mark.parametrize("kind", KINDS)
def test_links_move_as_in_pinocchio(kind):
    pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: pinocchio is not installed")
    plant, _ = draw_arm(np.random.default_rng(5), kind)
    model = pinocchio_model(pin, plant)
    data = model.createData()
    q, v, a = np.random.default_rng(6).normal(size=(3, 20, plant.joints))
    torque, diagonal, gravity = plant.inverse_dynamics(q, v, a)
    for row in range(20):
        theirs = pin.rnea(model, data, q[row], v[row], a[row])
        np.testing.assert_allclose(torque[row], theirs, rtol=0, atol=1e-12 * abs(torque).max())
        theirs = np.diag(pin.crba(model, data, q[row]))
        np.testing.assert_allclose(diagonal[row], theirs, rtol=1e-11)
        theirs = pin.computeGeneralizedGravity(model, data, q[row])
        np.testing.assert_allclose(gravity[row], theirs, rtol=0, atol=1e-12 * abs(torque).max())


def test_motors_drive_links_rotors_and_friction():
    """torque = links(q, v, a) + Ia a + friction along a motion: the integration is right."""
    plant, path, _ = arm("3R")
    x = moved(plant, path)
    left = x.extra.std(0) / x.torque.std(0)
    assert left.max() < 5e-3
    assert (x.rubbed.std(0) / x.torque.std(0)).min() > 5 * left.max()


def test_a_clean_arm_hides_nothing_and_a_spring_is_seen():
    plant, path, scales = arm("2R", seconds=10.0)
    admitted = {name: [0, 1] for name in BASE}
    more = (admitted, 0.0, Trial(path, np.zeros(2), 1))
    assert visibility(left_over(plant, plant, "spring", *more), scales) < 0.25
    sprung = plant.copy()
    hide("spring", sprung, scales, np.random.default_rng(1))
    assert visibility(left_over(sprung, plant, "spring", *more), scales) > 0.5


@pytest.mark.parametrize("name", ["spring", *rotating(*(n for n in EFFECTS if n != "spring"))])
def test_every_effect_changes_the_logged_torque(name):
    plant, path, scales = arm("3R", seconds=4.0)
    if name == "external_force":
        scales = replace(scales, seconds=4.0)
    changed = plant.copy()
    if name == "rotor_inertia":
        plant.rotor_inertia[2] *= 0.5
        changed.rotor_inertia[2] *= 0.5
    if name in ("viscous", "coulomb", "offset"):
        for bare in (plant, changed):
            setattr(bare, name, getattr(bare, name) * 0.01)
    hidden = hide(name, changed, scales, np.random.default_rng(4))
    before, after = (
        logged_torque(x.run(path, np.full(3, 22.0), 1), d)
        for x, d in ((plant, 0.0), (changed, hidden.delay))
    )
    joints = range(3) if hidden.joint is None else [hidden.joint]
    assert hidden.values
    assert max(np.abs(after - before)[:, j].max() / scales.rated[j] for j in joints) > 0.01


def test_a_motion_starts_and_ends_at_rest_within_its_bounds():
    rng = np.random.default_rng(9)
    bounds = draw_bounds(rng, 4)
    path = motion(rng, 10.0, bounds)
    assert path.shape == (20_000, 4)
    assert not path[0].any() and abs(path[-1]).max() < 1e-3
    assert (abs(path).max(0) <= bounds.angle * 1.001).all()
    assert (abs(rate(path)).max(0) <= bounds.speed * 1.05).all()
