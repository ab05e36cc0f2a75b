"""True parameters: stated ones kept, others drawn as bodies that could be built."""

import dataclasses

import numpy as np
import pytest

from modeler.core.choices import list_builtin_robots
from modeler.core.errors import RobotError
from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL, Limits
from modeler.simulation import collect_motion_limits, draw_plant_parameters, rigid
from modeler.simulation.parameters import Completion, complete_body
from tests.bodies import ten_of_points
from tests.robot_texts import ARM, PENDULUM, SIX, TREE, robot
from tests.robots import kinds_first
from tests.rotation import with_cases


def cloud(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Point masses (k,) and their places (k, 3)."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.1, 2, 6), rng.normal(size=(6, 3))


@pytest.mark.parametrize("seed", range(3))
def test_body_of_a_cloud_of_points(seed):
    masses, places = cloud(seed)
    standard = ten_of_points(masses, places)
    body = rigid.compute_body(standard)
    centre = masses @ places / masses.sum()
    apart = places - centre
    about = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, apart))  # noqa: B905
    np.testing.assert_allclose(body.centre, centre, rtol=1e-12)
    np.testing.assert_allclose(body.inertia, about, rtol=1e-10, atol=1e-12)
    assert list(rigid.compute_standard_parameters(body)) == list(INERTIAL)
    assert rigid.compute_standard_parameters(body) == pytest.approx(standard, rel=1e-12)
    second = sum(m * np.outer(p, p) for m, p in zip(masses, places))  # noqa: B905
    actual = rigid.compute_pseudo_inertia(standard)[:3, :3]
    np.testing.assert_allclose(actual, second, rtol=1e-10, atol=1e-12)
    matrix = rigid.compute_pseudo_inertia(standard)
    assert rigid.convert_pseudo_inertia(matrix) == pytest.approx(standard)


def test_points_rods_and_nothing_are_physical_but_no_less():
    masses, places = cloud(0)
    for count in (6, 2, 1):
        assert rigid.is_physical(ten_of_points(masses[:count], places[:count]))
    assert rigid.is_physical(dict.fromkeys(INERTIAL, 0.0))
    lighter = ten_of_points(masses, places) | {"M": 0.5}
    assert not rigid.is_physical(lighter)
    assert not rigid.is_physical(dict.fromkeys(INERTIAL, 0.0) | {"MX": 1.0})
    triangle = dict.fromkeys(INERTIAL, 0.0) | {"M": 1.0, "XX": 1.0, "YY": 1.0, "ZZ": 2.1}
    assert not rigid.is_physical(triangle)
    assert rigid.is_physical(triangle | {"ZZ": 2.0})


@pytest.mark.parametrize("text", [PENDULUM, ARM, SIX, TREE])
@pytest.mark.parametrize("seed", range(2))
def test_drawn_links_are_physical_and_friction_is_in_proportion(text, seed):
    source = robot(text)
    parameters = draw_plant_parameters(source, collect_motion_limits(source), seed)
    assert set(parameters.drawn) == set(parameters.standard)
    for joint in source.moving_joints:
        values = {p: parameters.standard[p + joint.name] for p in INERTIAL}
        assert np.linalg.eigvalsh(rigid.compute_pseudo_inertia(values))[0] > 0
        assert 0.01 < values["M"] < 300
        assert parameters.standard.get(f"Fs{joint.name}", 1.0) > 0
        for off in ("XY", "XZ", "YZ", "MX"):
            assert values[off] != 0.0


def test_order_is_that_of_the_table():
    names = list(draw_plant_parameters(robot(ARM), collect_motion_limits(robot(ARM))).standard)
    of_joint = [*INERTIAL, "Ia", "Fv", "Fs", "Off"]
    assert names == [prefix + joint for joint in "123" for prefix in of_joint]


def test_stated_numbers_are_kept_and_the_rest_is_drawn():
    stated = "M2 = 4.5\nZZ2 = 0.31\nMX2 = 0.8\nFs2 = 1.25"
    source = robot(ARM, parameters=stated)
    parameters = draw_plant_parameters(source, collect_motion_limits(source))
    chosen = {name: parameters.standard[name] for name in ("M2", "ZZ2", "MX2", "Fs2")}
    assert chosen == {"M2": 4.5, "ZZ2": 0.31, "MX2": 0.8, "Fs2": 1.25}
    assert not set(chosen) & set(parameters.drawn)
    assert {"XX2", "MY2", "Fv2", "M1"} <= set(parameters.drawn)
    link = {p: parameters.standard[p + "2"] for p in INERTIAL}
    assert rigid.is_physical(link, tolerance=0)


def test_letters_of_a_paper_count_where_they_have_numbers():
    letters = '[physical.1]\nmass = "m"\ncentre = ["c", 0, 0]\n'
    letters += 'inertia = [0.02, 0, 0, 0.03, 0, "J"]\n'
    text = PENDULUM.replace("[mdh]", "[symbols]\nm = 3.0\nc = 0.2\nJ = 0.04\n[mdh]") + letters
    source = robot(text)
    parameters = draw_plant_parameters(source, collect_motion_limits(source))
    assert parameters.drawn == ()
    assert parameters.standard["ZZ1"] == pytest.approx(0.04 + 3.0 * 0.2**2)
    assert parameters.standard["MX1"] == pytest.approx(0.6)


@pytest.mark.parametrize("name", kinds_first(list_builtin_robots()))
def test_every_built_in_robot_can_be_filled_in(name):
    source = read_robot(name)
    parameters = draw_plant_parameters(source, collect_motion_limits(source))
    stated = {k: v for k, v in source.parameters.items() if k in parameters.standard}
    assert stated.items() <= parameters.standard.items()
    assert all(np.isfinite(value) for value in parameters.standard.values())


REFERENCE = rigid.compute_standard_parameters(
    rigid.Body(8.0, np.array([0.2, 0.01, 0.02]), np.diag([0.1, 0.3, 0.35]) + 0.01)
)


@pytest.mark.parametrize("count", range(1, 8))
def test_whatever_a_real_body_has_can_be_stated(count):
    """Points, rods, plates and bodies, light or heavy, near or far: any part of their numbers."""
    for seed in range(6):
        rng = np.random.default_rng([count, seed])
        masses = rng.uniform(0.1, 2, count) * 10 ** rng.uniform(-3, 2)
        places = rng.normal(size=(count, 3)) * 10 ** rng.uniform(-2, 1)
        if seed % 3 == 1:
            places[:, rng.integers(3)] = 0.0
        real = ten_of_points(masses, places)
        share = rng.choice([0.3, 0.6, 0.9])
        stated = {p: real[p] for p in INERTIAL if rng.random() < share}
        values = complete_body(stated, REFERENCE).values
        assert values is not None, (seed, stated)
        assert stated.items() <= values.items()
        second = rigid.compute_pseudo_inertia(
            values
        )  # positive up to rounding, by an oracle of its own
        size = np.sqrt(np.abs(np.diag(second)) + 1e-9 * np.abs(np.diag(second)).max())
        assert np.linalg.eigvalsh(second / np.outer(size, size))[0] > -1e-4, (seed, stated)


@with_cases(
    "stated",
    {"M": 0.0, "MX": 1.0},
    {"M": 1.0, "MX": 1.0, "ZZ": 5.0, "YY": 0.9},
    {"XX": 1.0, "YY": 1.0, "ZZ": 2.1},
    {"XX": 1.0, "YY": 1.0, "ZZ": 1.0, "XY": 0.6},
    {"XX": 0.0, "MY": 0.1},
    {"ZZ": 1.0, "XY": 0.6},
    {"ZZ": 0.1, "MX": -34.0, "MZ": 0.01, "M": 0.004},
    {"XX": 1.0, "YY": 1.0, "ZZ": 1.0, "XY": -0.4, "XZ": -0.4, "YZ": 0.4, "MX": 1e-3},
    {"ZZ": 1.0, "M": 1.0, "MX": 0.8, "MY": 0.8},
    {p: float(p in ("XX", "YY", "M")) for p in INERTIAL if p != "ZZ"} | {"ZZ": 2.01},
)
def test_links_that_cannot_exist_are_proved_impossible(stated):
    """By hand: an inequality of Cauchy and Schwarz, or the triangle inequality, fails for each."""
    assert complete_body(stated, REFERENCE) == Completion(None, is_impossible=True)


def test_the_completion_is_the_reference_where_that_fits():
    stated = {p: REFERENCE[p] for p in ("ZZ", "MX", "MY", "M")}
    assert complete_body(stated, REFERENCE).values == pytest.approx(REFERENCE, rel=1e-6, abs=1e-8)


def test_a_search_that_fails_does_not_claim_that_no_body_exists(monkeypatch):
    monkeypatch.setattr(
        "modeler.simulation.parameters.complete_body", lambda stated, reference: Completion(None)
    )
    source = robot(ARM, parameters="M1 = 1.0")
    with pytest.raises(RobotError, match=r"link 1: found no rigid body .*M1 = 1, nor a proof"):
        draw_plant_parameters(source, collect_motion_limits(source))


def test_impossible_links_are_named():
    source = robot(ARM, parameters="M2 = 1.0\nMX2 = 1.0\nYY2 = 0.1")
    with pytest.raises(RobotError, match=r"link 2: no rigid body has the stated .*M2 = 1"):
        draw_plant_parameters(source, collect_motion_limits(source))
    negative = robot(ARM, parameters="M3 = -1.0")
    with pytest.raises(RobotError, match=r"link 3: no rigid body has the stated M3 = -1"):
        draw_plant_parameters(negative, collect_motion_limits(negative))


@pytest.mark.parametrize("name", ["Fv1", "Fs1", "Ia1"])
def test_friction_that_drives_is_refused(name):
    source = dataclasses.replace(robot(ARM), parameters={name: -0.5})
    with pytest.raises(RobotError, match=f"{name} = -0.5 would drive the joint"):
        draw_plant_parameters(source, collect_motion_limits(source))


def test_limits():
    source = robot(TREE, limits="1 = [-1, 2, 3, 4]")
    changed = Limits(0.0, 0.1, 0.2, 0.3)
    limits = collect_motion_limits(source, {"2": changed})
    assert limits[0] == Limits(-1, 2, 3, 4)
    assert limits[1] == changed
    assert (limits[2].lower, limits[2].upper) == (-1.5, 1.5)
    assert collect_motion_limits(source)[1].upper == 0.3
    with pytest.raises(RobotError, match=r"limits of joint 9: no such moving joint.*1, 2, 3, 4"):
        collect_motion_limits(source, {"9": changed})
    with pytest.raises(RobotError, match=r"joint 1: got lower 1, upper 1; expected lower < upper"):
        collect_motion_limits(source, {"1": Limits(1, 1, 1, 1)})
    with pytest.raises(RobotError, match=r"joint 1: got speed 0, .*expected both above 0"):
        collect_motion_limits(source, {"1": Limits(0, 1, 0, 1)})
    with pytest.raises(RobotError, match=r"joint 1: .*expected finite numbers"):
        collect_motion_limits(source, {"1": Limits(0, float("inf"), 1, 1)})
