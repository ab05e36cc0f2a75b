"""Causes outside the catalogue: every one is the law of its docstring, computed another way."""

import numpy as np
import pytest
from scipy.signal import lsim

from tests.hidden_effects.effects import EFFECTS, hide
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.plant import TICK, rate
from tests.hidden_effects.test_generator import arm, moved

pytestmark = pytest.mark.usefixtures("plant_compiler")


def places(plant, q, link, point):
    """(samples, 3): a point of a link in the base frame, by the table."""
    place = np.broadcast_to(np.asarray(point, float), (len(q), 3))
    for j in range(link, -1, -1):
        ca, sa = np.cos(plant.alpha[j]), np.sin(plant.alpha[j])
        ct, st = (f(q[:, j] + plant.theta0[j]) for f in (np.cos, np.sin))
        x = ct * place[:, 0] - st * place[:, 1] + plant.d[j]
        y = st * place[:, 0] + ct * place[:, 1]
        z = place[:, 2] + plant.r[j]
        place = np.stack([x, ca * y - sa * z, sa * y + ca * z], 1)
    return place


def slopes(function, q):
    """(samples, n, ...): d function / d q by differences."""
    steps = 1e-5 * np.eye(q.shape[1])
    return np.stack([(function(q + e) - function(q - e)) / 2e-5 for e in steps], 1)


def across(plant, q, v, j):
    """(samples,): moment across the axis of joint j, without acceleration."""
    return np.hypot(*(_moment_about(plant, q, v, j, side) for side in (0, 1)))


def _moment_about(plant, q, v, j, side):
    """Moment about x (0) or y (1) of frame j at its origin, of all links from j on."""
    total = np.zeros(len(q))
    h = 1e-4
    frame = [places(plant, q, j, e) - places(plant, q, j, np.zeros(3)) for e in np.eye(3)]
    origin = places(plant, q, j, np.zeros(3))
    for k in range(j, plant.joints):
        # m c'' - m g at the centre, and d(I w)/dt, along the path q + v t at t = 0.
        paths = [places(plant, q + t * v, k, plant.centre[k]) for t in (-h, 0, h)]
        force = plant.mass[k] * ((paths[0] - 2 * paths[1] + paths[2]) / h**2 - plant.gravity)
        spins = [_momentum(plant, q + t * v, v, k) for t in (-h, h)]
        moment = np.cross(paths[1] - origin, force) + (spins[1] - spins[0]) / (2 * h)
        total += (moment * frame[side]).sum(1)
    return total


def _momentum(plant, q, v, k):
    """(samples, 3): angular momentum of link k about its centre."""
    spin = np.zeros((len(q), 3))
    for j in range(k + 1):
        axis = places(plant, q, j, [0, 0, 1]) - places(plant, q, j, np.zeros(3))
        spin += v[:, [j]] * axis
    axes = np.stack(
        [places(plant, q, k, e) - places(plant, q, k, np.zeros(3)) for e in np.eye(3)], 2
    )
    tensor = axes @ plant.inertia[k].reshape(3, 3) @ axes.transpose(0, 2, 1)
    return (tensor @ spin[:, :, None])[:, :, 0]


def ran(name):
    """A run of an arm with one such cause, on joint j, or k besides."""
    plant, path, scales = arm(seconds=6.0)
    hidden = hide(name, plant, scales, np.random.default_rng(4), HELD_OUT_EFFECTS)
    x, values = moved(plant, path), hidden.values
    x.j = 0 if hidden.joint is None else hidden.joint
    x.k = int(values.get("with_joint", x.j + 1)) - 1
    x.plant, x.values, x.time = plant, values, np.arange(len(x.q)) * TICK
    x.way = np.tanh(x.v / plant.coulomb_width)[:, x.j]
    return x


def law(name, x):
    """(samples, n): the torque of a docstring."""
    torque, values, q, v = np.zeros_like(x.q), x.values, x.q[:, x.j], x.v[:, x.j]
    if name == "pinched_dress":
        beyond = (x.q[:, x.k] - values["q0"]) / values["w"]
        torque[:, x.j] = values["F"] * x.way / (1 + np.exp(-beyond))
    elif name == "hose_across":
        pulled = values["k"] * (q + values["c"] * x.q[:, x.k] - values["s"])
        torque[:, x.j], torque[:, x.k] = pulled, values["c"] * pulled
    elif name == "grease_pocket":
        torque[:, x.j] = values["Fv"] * np.cos((q - values["q0"]) / 2) ** 2 * v
    elif name == "lifting_seal":
        lifted = (np.abs(v) - values["v1"]) / values["w"]
        torque[:, x.j] = values["F"] * x.way * (1 - np.tanh(lifted / 2)) / 2
    elif name == "saturating_motor":
        t = x.torque[:, x.j]
        torque[:, x.j] = t - values["s"] * np.tanh(t / values["s"])
    elif name == "dead_band":
        torque[:, x.j] = values["b"] * np.tanh(x.torque[:, x.j] / values["b"])
    elif name == "crosstalk":
        torque[:, x.j] = values["c"] * x.torque[:, x.k]
    elif name == "dragging_brake":
        since = (x.time - values["start"]) % values["period"]
        drags = (since < values["lasts"]) & (x.time > values["start"])
        torque[:, x.j] = values["F"] * x.way * drags
    elif name == "bearing_moment":
        torque[:, x.j] = values["c"] * across(x.plant, x.q, x.v, x.j) * x.way
    elif name == "back_driven_gear":
        onward = x.way * np.tanh(x.load[:, x.j] / x.plant.back_driven_load[x.j])
        torque[:, x.j] = values["F"] * x.way * (1 - onward) / 2
    elif name == "strap_to_base":
        torque = slopes(lambda some: strap_energy(x, some), x.q)
    else:
        torque = swinging(x)
    return torque


def strap_energy(x, q):
    length = np.linalg.norm(places(x.plant, q, x.j, x.values["point"]) - x.values["base"], axis=1)
    return x.values["k"] / 2 * np.maximum(0, length - x.values["free"]) ** 2


def swinging(x):
    """Torque of a mass in a spring, of which the run gives the place where it is held."""
    plant, omega, mass = x.plant, 2 * np.pi * x.values["f_Hz"], x.values["mass"]
    damping, last = 2 * x.values["damping"] * omega, plant.joints - 1
    held = places(plant, x.q, last, plant.slosh_point)
    speed, force = rate(held), np.zeros_like(held)
    states = ([[0, 1], [-(omega**2), -damping]], [[0, 0, 0], [omega**2, damping, 1]])
    for i, g in enumerate(plant.gravity):
        values = np.stack([held[:, i], speed[:, i], np.full(len(held), g)], 1)
        start = [held[0, i] + g / omega**2, 0]
        _, _, path = lsim((*states, np.eye(2), np.zeros((2, 3))), values, x.time, start)
        force[:, i] = omega**2 * (path[:, 0] - held[:, i]) + damping * (path[:, 1] - speed[:, i])
    lever = slopes(lambda q: places(plant, q, last, plant.slosh_point), x.q)
    return -mass * (lever * force[:, None]).sum(2)


@pytest.mark.parametrize("name", HELD_OUT_EFFECTS)
def test_a_cause_is_what_its_docstring_says(name):
    x = ran(name)
    assert name not in EFFECTS and np.abs(x.q[:20]).max() < 1e-6  # it starts at rest
    expected, scale = law(name, x), x.torque.std(0)
    error = (x.extra - expected)[x.steady].std(0) / scale
    assert error.max() < 5e-3
    assert (expected.std(0) / scale).max() > 5 * error.max()
