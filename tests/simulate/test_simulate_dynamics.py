"""The plant against Pinocchio, closed forms and the laws of mechanics."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.robot.robot import INERTIAL, EffectUse, Robot
from modeler.simulation import PlantParameters, collect_motion_limits, draw_plant_parameters
from modeler.simulation.plant import Plant, build_plant
from tests.oracles.pinocchio_dynamics import pin, places_of
from tests.robot_texts import ARM, BACKWARDS, PENDULUM, SIX, TREE, TWO_LINK, robot

TEXTS = [
    pytest.param(BACKWARDS, id="backwards"),
    *(
        pytest.param(text, id=name, marks=pytest.mark.rotating)
        for name, text in (("arm", ARM), ("six", SIX), ("tree", TREE))
    ),
]
FRICTION = "Fv1 = 0.5\nFs1 = 0.7\nOff1 = -0.2\n"


def plant_of(source: Robot, seed: int = 0) -> tuple[Plant, PlantParameters]:
    limits = collect_motion_limits(source)
    parameters = draw_plant_parameters(source, limits, seed)
    return build_plant(source, parameters, limits), parameters


def friction_of(source: Robot, seed: int = 0) -> Callable[..., np.ndarray]:
    """(q, qd) -> what the effects take from the motors of links that do not accelerate."""
    limits = collect_motion_limits(source)
    parameters = draw_plant_parameters(source, limits, seed)
    bare = build_plant(dataclasses.replace(source, effects=()), parameters, limits)
    rubbing = build_plant(source, parameters, limits)

    def friction(q, qd):
        rest = np.zeros(len(bare.joints))
        return column(rubbing.torque, q, qd, rest, []) - column(bare.torque, q, qd, rest, [])

    return friction


def column(function, *arguments) -> np.ndarray:
    values = function(*arguments)
    return (values[0] if isinstance(values, tuple) else values).full().ravel()


@pytest.mark.parametrize("text", TEXTS)
def test_forward_dynamics_agree_with_pinocchio(text, seed=0):
    source = robot(text)
    plant, parameters = plant_of(source, seed)
    friction = friction_of(source, seed)
    model, places = places_of(source, parameters.standard)
    assert places == list(range(model.nv))
    data = model.createData()
    rng = np.random.default_rng(seed)
    for _ in range(20):
        q, qd, tau = rng.normal(size=(3, model.nv))
        resistance = friction(q, qd)
        ours = column(plant.acceleration, q, qd, [], tau + resistance)
        theirs = pin.aba(model, data, q, qd, tau)
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9 * np.abs(theirs).max())
        back = column(plant.torque, q, qd, theirs, [])
        scale = np.abs(back).max()
        np.testing.assert_allclose(back, tau + resistance, rtol=0, atol=1e-10 * max(scale, 1))


def test_pendulum_is_that_of_the_textbook():
    source = robot(
        PENDULUM,
        effects='rotor_inertia = "all"\nviscous = "all"\ncoulomb = "all"\noffset = "all"',
        parameters="XX1 = 0.1\nXY1 = 0\nXZ1 = 0\nYY1 = 0.95\nYZ1 = 0\nZZ1 = 0.9\n"
        "MX1 = 1.2\nMY1 = 0\nMZ1 = 0\nM1 = 2\nIa1 = 0.1\n" + FRICTION,
    )
    plant, parameters = plant_of(source)
    assert parameters.drawn == ()
    for q, qd, qdd in ((0.3, 1.1, -2.0), (-2.0, -0.4, 0.7)):
        expected = 1.0 * qdd + 9.81 * 1.2 * np.cos(q) + 0.5 * qd + 0.7 * np.sign(qd) - 0.2
        assert float(plant.torque(q, qd, qdd, [])) == pytest.approx(expected, rel=1e-12)


def test_friction_opposes_motion_and_is_full_at_two_percent_of_the_top_speed():
    source = robot(PENDULUM, effects='viscous = "all"\ncoulomb = "all"', parameters="Fs1 = 0.7")
    friction = friction_of(source)
    viscous = plant_of(source)[1].standard["Fv1"]
    for speed in (-1.0, -0.04, 0.04, 1.0):  # the default top speed is 2 rad/s
        (resistance,) = friction(0.0, speed)
        assert resistance == pytest.approx(viscous * speed + 0.7 * np.sign(speed), rel=1e-12)
    assert friction(0.0, 0.0)[0] == 0.0


def test_a_motor_that_turns_with_two_joints_loads_both():
    parameters = "Iam2 = 0.3\nFvm2 = 0.4\nFsm2 = 0.5"
    plain = robot(TWO_LINK)
    coupled = robot(
        TWO_LINK,
        effects='coupled_inertia = ["2"]\ncoupled_friction = ["2"]',
        coupling='2 = "2*q1 + q2"',
        parameters=parameters,
    )
    q, qd, qdd = np.random.default_rng(5).normal(size=(3, 2))
    with_motor = column(plant_of(coupled)[0].torque, q, qd, qdd, [])
    without = column(plant_of(plain)[0].torque, q, qd, qdd, [])
    shaft = np.array([2.0, 1.0])
    motor = 0.3 * shaft @ qdd + 0.4 * shaft @ qd + 0.5 * np.sign(shaft @ qd)
    np.testing.assert_allclose(with_motor - without, shaft * motor, rtol=1e-9)


COUPLED = dataclasses.replace(robot(TWO_LINK), effects=(EffectUse("coupled_inertia", ("2",)),))
NOTHING = "".join(f"{prefix}2 = 0\n" for prefix in INERTIAL)
MISTAKES = [
    (
        dataclasses.replace(robot(PENDULUM), effects=(EffectUse("levitation", ("1",)),)),
        "joint 1: effect levitation cannot be simulated",
    ),
    (COUPLED, r"joint 2: coupled_inertia .* coupling"),
    (robot(TWO_LINK, parameters=NOTHING), "joint 2: nothing gives it an inertia"),
]


@pytest.mark.parametrize(("source", "message"), MISTAKES)
def test_what_cannot_be_simulated_is_named(source, message):
    with pytest.raises(RobotError, match=message):
        plant_of(source)
