"""The machine nearest to a fit: at no distance where there is one, at a known one elsewhere."""

import numpy as np
import pytest

from modeler.estimation.nearest_body import carried_by, machine_of, nearest_possible
from modeler.robot.robot import INERTIAL
from tests.bodies import buildable
from tests.modules import compiled

_KINDS = ("two-link", "dvrk-psm", "sr400", "orthoglide-2003")


@pytest.mark.parametrize("name", _KINDS)
def test_a_machine_that_could_be_built_is_at_no_distance(name):
    machine = machine_of(compiled(name).spec)
    chi = buildable(compiled(name).spec, np.random.default_rng(41))
    beta = machine.K[:, : len(chi)] @ chi
    np.testing.assert_allclose(beta, compiled(name).base_parameters(chi), rtol=1e-9)
    root = np.diag(1.0 / (0.01 * np.abs(beta) + 1e-6))  # one percent
    found = nearest_possible(machine, beta, root)
    assert found is not None and found.distance < 1e-2  # standard deviations


def test_a_friction_below_zero_is_as_far_as_it_is_below():
    spec = compiled("two-link").spec
    machine = machine_of(spec)
    names = [base.name for base in spec.base]
    chi = buildable(spec, np.random.default_rng(42))
    beta = machine.K[:, : len(chi)] @ chi
    sigma = 0.05 * np.ones(len(beta))
    beta[names.index("Fv2")] = -0.4
    found = nearest_possible(machine, beta, np.diag(1.0 / sigma))
    assert found is not None
    assert found.distance == pytest.approx(0.4 / 0.05, rel=1e-3)
    assert found.beta[names.index("Fv2")] == pytest.approx(0.0, abs=1e-4)
    assert carried_by(machine, beta, np.diag(1.0 / sigma), found.distance) == ["Fv2"]


def test_a_moment_of_inertia_below_zero_and_who_carries_it():
    # ZZ2 is a base parameter by itself; however heavy link 2 is, ZZ2 M2 >= MX2^2 keeps it above 0.
    spec = compiled("two-link").spec
    machine = machine_of(spec)
    names = [base.name for base in spec.base]
    chi = buildable(spec, np.random.default_rng(43))
    beta = machine.K[:, : len(chi)] @ chi
    beta[names.index("ZZ2")] = -0.3
    weights = np.full(len(beta), 1e-3)  # all else is free to follow
    weights[names.index("ZZ2")] = 10.0
    root = np.diag(weights)
    found = nearest_possible(machine, beta, root)
    assert found is not None
    assert found.distance == pytest.approx(3.0, rel=1e-2)
    assert carried_by(machine, beta, root, found.distance) == ["2"]


def test_links_share_their_faults_as_their_parameters_do():
    # M2 is in ZZ1R and MX1R, with L1: a body of link 2 cannot take what it has not.
    spec = compiled("two-link").spec
    machine = machine_of(spec)
    chi = buildable(spec, np.random.default_rng(44))
    beta = machine.K[:, : len(chi)] @ chi
    names = [base.name for base in spec.base]
    beta[names.index("MX1R")] *= 40.0  # far out, with the inertia that it had
    alone = nearest_possible(machine, beta, 100.0 * np.eye(len(beta)))
    assert alone is not None
    free = nearest_possible(machine, beta, 100.0 * np.eye(len(beta)), machine.bounds)
    assert free is not None and free.distance < 1e-2  # nothing bounds it then
    some = nearest_possible(machine, beta, 100.0 * np.eye(len(beta)), ["1"])
    assert some is not None and some.distance <= alone.distance + 1e-3


def test_links_have_ten_parameters_each_even_if_torques_feel_two():
    machine = machine_of(compiled("scara").spec)
    for link, own in machine.links.items():
        assert {machine.names[place] for place in own} == {f"{p}{link}" for p in INERTIAL}
    places = [place for own in machine.links.values() for place in own]
    assert len(set(places)) == len(places) <= machine.K.shape[1]
