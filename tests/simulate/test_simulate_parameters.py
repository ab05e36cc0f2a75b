"""True parameters: stated ones kept, others drawn as bodies that could be built."""

import dataclasses

import numpy as np
import pytest
from simulated_robots import ARM, PENDULUM, SIX, TREE, robot

from modeler.core.errors import RobotError
from modeler.robot import INERTIAL, Limits, builtin_names, read_robot
from modeler.simulate import motion_limits, plant_parameters
from modeler.simulate.body import (
    body_from_standard,
    is_physical,
    pseudo_inertia,
    standard_from_body,
    standard_from_pseudo_inertia,
)


def cloud(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Point masses (k,) and their places (k, 3)."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.1, 2, 6), rng.normal(size=(6, 3))


def standard_of_cloud(masses: np.ndarray, places: np.ndarray) -> dict[str, float]:
    """The ten parameters by their definition as sums over point masses (Khalil and Dombre)."""
    x, y, z = places.T
    sums = {
        "XX": y * y + z * z, "XY": -x * y, "XZ": -x * z, "YY": x * x + z * z,
        "YZ": -y * z, "ZZ": x * x + y * y, "MX": x, "MY": y, "MZ": z, "M": np.ones(len(x)),
    }  # fmt: skip
    return {name: float(masses @ value) for name, value in sums.items()}


@pytest.mark.parametrize("seed", range(3))
def test_body_of_a_cloud_of_points(seed):
    masses, places = cloud(seed)
    standard = standard_of_cloud(masses, places)
    body = body_from_standard(standard)
    centre = masses @ places / masses.sum()
    apart = places - centre
    about = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, apart))  # noqa: B905
    np.testing.assert_allclose(body.centre, centre, rtol=1e-12)
    np.testing.assert_allclose(body.inertia, about, rtol=1e-10, atol=1e-12)
    assert list(standard_from_body(body)) == list(INERTIAL)
    assert standard_from_body(body) == pytest.approx(standard, rel=1e-12)
    second = sum(m * np.outer(p, p) for m, p in zip(masses, places))  # noqa: B905
    np.testing.assert_allclose(pseudo_inertia(standard)[:3, :3], second, rtol=1e-10, atol=1e-12)
    assert standard_from_pseudo_inertia(pseudo_inertia(standard)) == pytest.approx(standard)


def test_points_rods_and_nothing_are_physical_but_no_less():
    masses, places = cloud(0)
    for count in (6, 2, 1):
        assert is_physical(standard_of_cloud(masses[:count], places[:count]))
    assert is_physical(dict.fromkeys(INERTIAL, 0.0))
    lighter = standard_of_cloud(masses, places) | {"M": 0.5}
    assert not is_physical(lighter)
    assert not is_physical(dict.fromkeys(INERTIAL, 0.0) | {"MX": 1.0})
    triangle = dict.fromkeys(INERTIAL, 0.0) | {"M": 1.0, "XX": 1.0, "YY": 1.0, "ZZ": 2.1}
    assert not is_physical(triangle)
    assert is_physical(triangle | {"ZZ": 2.0})


@pytest.mark.parametrize("text", [PENDULUM, ARM, SIX, TREE])
@pytest.mark.parametrize("seed", range(4))
def test_drawn_links_are_physical_and_friction_is_in_proportion(text, seed):
    source = robot(text)
    parameters = plant_parameters(source, motion_limits(source), seed)
    assert set(parameters.drawn) == set(parameters.standard)
    for joint in source.moving:
        values = {p: parameters.standard[p + joint.name] for p in INERTIAL}
        assert np.linalg.eigvalsh(pseudo_inertia(values))[0] > 0
        assert 0.01 < values["M"] < 300
        assert parameters.standard.get(f"Fs{joint.name}", 1.0) > 0
        for off in ("XY", "XZ", "YZ", "MX"):
            assert values[off] != 0.0


def test_order_is_that_of_the_table():
    names = list(plant_parameters(robot(ARM), motion_limits(robot(ARM))).standard)
    of_joint = [*INERTIAL, "Ia", "Fv", "Fs", "Off"]
    assert names == [prefix + joint for joint in "123" for prefix in of_joint]


def test_stated_numbers_are_kept_and_the_rest_is_drawn():
    stated = "M2 = 4.5\nZZ2 = 0.31\nMX2 = 0.8\nFs2 = 1.25"
    source = robot(ARM, parameters=stated)
    parameters = plant_parameters(source, motion_limits(source))
    chosen = {name: parameters.standard[name] for name in ("M2", "ZZ2", "MX2", "Fs2")}
    assert chosen == {"M2": 4.5, "ZZ2": 0.31, "MX2": 0.8, "Fs2": 1.25}
    assert not set(chosen) & set(parameters.drawn)
    assert {"XX2", "MY2", "Fv2", "M1"} <= set(parameters.drawn)
    link = {p: parameters.standard[p + "2"] for p in INERTIAL}
    assert is_physical(link, tolerance=0)


def test_letters_of_a_paper_count_where_they_have_numbers():
    letters = '[physical.1]\nmass = "m"\ncentre = ["c", 0, 0]\n'
    letters += 'inertia = [0.02, 0, 0, 0.03, 0, "J"]\n'
    text = PENDULUM.replace("[mdh]", "[symbols]\nm = 3.0\nc = 0.2\nJ = 0.04\n[mdh]") + letters
    source = robot(text)
    parameters = plant_parameters(source, motion_limits(source))
    assert parameters.drawn == ()
    assert parameters.standard["ZZ1"] == pytest.approx(0.04 + 3.0 * 0.2**2)
    assert parameters.standard["MX1"] == pytest.approx(0.6)


def test_seeds():
    source = robot(ARM)
    first, again, other = (
        plant_parameters(source, motion_limits(source), seed).standard for seed in (7, 7, 8)
    )
    assert first == again
    assert all(first[name] != other[name] for name in first)


@pytest.mark.parametrize("name", builtin_names())
def test_every_built_in_robot_can_be_filled_in(name):
    source = read_robot(name)
    parameters = plant_parameters(source, motion_limits(source))
    stated = {k: v for k, v in source.parameters.items() if k in parameters.standard}
    assert stated.items() <= parameters.standard.items()
    assert all(np.isfinite(value) for value in parameters.standard.values())


def test_impossible_links_are_named():
    source = robot(ARM, parameters="M2 = 1.0\nMX2 = 1.0\nYY2 = 0.1")
    with pytest.raises(RobotError, match=r"link 2: no rigid body has the stated .*M2 = 1"):
        plant_parameters(source, motion_limits(source))
    negative = robot(ARM, parameters="M3 = -1.0")
    with pytest.raises(RobotError, match=r"link 3: no rigid body has the stated M3 = -1"):
        plant_parameters(negative, motion_limits(negative))


@pytest.mark.parametrize("name", ["Fv1", "Fs1", "Ia1"])
def test_friction_that_drives_is_refused(name):
    source = dataclasses.replace(robot(ARM), parameters={name: -0.5})
    with pytest.raises(RobotError, match=f"{name} = -0.5 would drive the joint"):
        plant_parameters(source, motion_limits(source))


def test_limits():
    source = robot(TREE, limits="1 = [-1, 2, 3, 4]")
    changed = Limits(0.0, 0.1, 0.2, 0.3)
    limits = motion_limits(source, {"2": changed})
    assert limits[0] == Limits(-1, 2, 3, 4)
    assert limits[1] == changed
    assert (limits[2].lower, limits[2].upper) == (-1.5, 1.5)
    assert motion_limits(source)[1].upper == 0.3
    with pytest.raises(RobotError, match=r"limits of joint 9: no such moving joint.*1, 2, 3, 4"):
        motion_limits(source, {"9": changed})
    with pytest.raises(RobotError, match=r"joint 1: got lower 1, upper 1; expected lower < upper"):
        motion_limits(source, {"1": Limits(1, 1, 1, 1)})
    with pytest.raises(RobotError, match=r"joint 1: got speed 0, .*expected both above 0"):
        motion_limits(source, {"1": Limits(0, 1, 0, 1)})
    with pytest.raises(RobotError, match=r"joint 1: .*expected finite numbers"):
        motion_limits(source, {"1": Limits(0, float("inf"), 1, 1)})
