"""The model of a loaded robot is that of the bare one, and the force that a point mass needs."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.estimation import with_load
from tests.modules import module, plain


@dataclass(frozen=True)
class Value:
    value: float


@dataclass(frozen=True)
class Fit:
    parameters: tuple[Value, ...]


@dataclass(frozen=True)
class Model:
    spec: Any
    fit: Fit


def bare(name, seed):
    compiled = plain(name)
    values = np.random.default_rng(seed).normal(size=len(compiled.spec.base))
    return compiled, Model(compiled.spec, Fit(tuple(Value(v) for v in values)))


def moved(compiled, row, c, q):
    """(n, 3) place of the point c of a link, in frame 0."""
    pose = compiled.forward_kinematics(q)[:, row]
    return pose[:, :, :3] @ c + pose[:, :, 3]


CASES = [("orthoglide-2012", "6", (0, 9.81, 0), 0.01), ("puma560", "6", (0, 0, -9.81), 0.8)]


@pytest.mark.parametrize(("name", "link", "g", "reach"), CASES)
def test_the_load_takes_the_force_of_a_point_mass(name, link, g, reach):
    """J'm (a - g), by differences of the place of the point along q(t) and by each joint."""
    compiled, model = bare(name, 3)
    rng, mass, c = np.random.default_rng(7), 1.7, np.array([0.03, -0.05, 0.08])
    closure = compiled.spec.closure
    home = 0.0 if closure is None else np.array(closure.home)[list(closure.given)]
    n, joints = 6, len(compiled.spec.joints)
    q, qd, qdd = (home * k + reach * rng.uniform(-1, 1, (n, joints)) for k in (1, 0, 0))
    row, h = [joint.name for joint in module(name).model.robot.moving].index(link), 1e-4
    place = [moved(compiled, row, c, q + t * qd + 0.5 * t * t * qdd) for t in (-h, 0.0, h)]
    a = (place[0] - 2 * place[1] + place[2]) / h**2
    J = np.stack([
        (moved(compiled, row, c, q + h * e) - moved(compiled, row, c, q - h * e)) / (2 * h)
        for e in np.eye(joints)
    ], axis=2)  # fmt: skip
    expected = np.einsum("nxj,nx->nj", J, mass * (a - np.array(g)))
    loaded = with_load(model, mass, c)  # the link that carries is found
    change = np.array([p.value for p in loaded.fit.parameters])
    change -= [p.value for p in model.fit.parameters]
    found = compiled.base_regressor(q, qd, qdd) @ change
    np.testing.assert_allclose(found, expected, atol=2e-5 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("mass", "centre", "link", "told"),
    [
        (0.0, (0, 0, 0), None, "got 0 kg at 0, 0, 0; expected a mass above 0"),
        (1.0, (0, 0, np.inf), None, "x, y, z of its centre"),
        (1.0, (0, 0), None, "x, y, z of its centre"),
        (1.0, (0, 0, 0), "9", "no link 9; puma560 has 1, 2, 3, 4, 5, 6"),
    ],
)
def test_what_can_be_no_load_is_refused(mass, centre, link, told):
    with pytest.raises(DataError, match=told):
        with_load(bare("puma560", 1)[1], mass, centre, link)
