"""Training and held-out logs of simulated machines that changed in between, or did not.

A seed draws the robot, its joint and the size of the change; both logs have motions of their own.
"""

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from modeler.api import open_robot
from modeler.core.errors import DataError
from modeler.regression.log import Log
from modeler.robot.robot import Robot
from modeler.simulation import SimulationSettings, draw_plant_parameters, simulate
from modeler.simulation.trajectory import collect_motion_limits
from tests.chain import Chain, chain_of

ROBOTS = ("demo-arm", "scara", "puma560", "two-link", "ur10e")
NONE = "none"
KINDS = ("friction", "load", "offset", "gain")
COUNTS = (1_000_000, 65_536, 4096)
"""Of encoders, a turn."""
EFFECTS = """
[effects]
rotor_inertia = "all"
viscous = "all"
coulomb = "all"
"""
"""Of robots whose files state none."""


@cache
def open_machine(name: str) -> Chain:
    """The robot, derived and compiled once in a process."""
    text = open_robot(name).text
    return chain_of(text if "[effects]" in text else text + EFFECTS)


@dataclass(frozen=True)
class ChangedMachine:
    """Logs of a machine before and after.

    Attributes:
        robot: its name.
        before, after: logs.
        pattern: regular expression of what names the change; "" where nothing changed.
        about: what was changed, for people.
    """

    robot: str
    before: Log
    after: Log
    pattern: str
    about: str


@cache
def draw_parameters(name: str, seed: int) -> Mapping[str, float]:
    """All standard parameters of a machine of that kind."""
    robot = open_machine(name).derivation.robot
    return draw_plant_parameters(robot, collect_motion_limits(robot), seed).standard


def with_parameters(robot: Robot, values: Mapping[str, float]) -> Robot:
    """The robot with these standard parameters, others as they are."""
    return dataclasses.replace(robot, parameters={**robot.parameters, **values})


def add_body(values: Mapping[str, float], link: str, mass: float, centre: np.ndarray) -> dict:
    """Standard parameters of a link that carries a ball of that mass, with a radius of 4 cm."""
    J = mass * ((centre @ centre + 0.4 * 0.04**2) * np.eye(3) - np.outer(centre, centre))
    body = {"M": mass, **dict(zip(("MX", "MY", "MZ"), mass * centre, strict=True))}
    body |= {f"{a}{b}": J[i, k] for i, a in enumerate("XYZ") for k, b in enumerate("XYZ") if k >= i}
    return {f"{p}{link}": values.get(f"{p}{link}", 0.0) + x for p, x in body.items()}


def make_log(name: str, robot: Robot, settings: SimulationSettings) -> Log:
    """A simulated log; of a motion that the controller can follow."""
    try:
        made = simulate(robot, settings)
    except DataError:
        other = dataclasses.replace(settings, seed=settings.seed + 1000, rate=1000.0)
        return make_log(name, robot, other)
    content = f"{settings.seed} {settings.rate} {made.tau.sum()}"
    return Log(f"{name}.csv", made.joints, made.time, made.q, made.tau, content=content)


def draw_settings(rng: np.random.Generator, seed: int, unlike: bool) -> SimulationSettings:
    """Motion and sensors of one log; where unlike, the kind of motion is drawn too."""
    motions = ("exciting", "point-to-point") if unlike else ("exciting",)
    return SimulationSettings(
        motion=str(rng.choice(motions)),
        duration=float(rng.choice((10.0, 15.0, 20.0))),
        rate=float(rng.choice((200.0, 250.0, 500.0, 1000.0))),
        seed=seed,
        encoder_counts=int(rng.choice(COUNTS)),
        torque_noise=float(rng.choice((0.005, 0.01, 0.03))),
        process_noise=float(rng.choice((0.0, 0.005, 0.01))),
    )


def make_machine(kind: str, seed: int, counts: int | None = None) -> ChangedMachine:
    """Makes the logs of a seed with a change of `KINDS`, or without one.

    Args:
        kind: of the change.
        seed: of all that is drawn.
        counts: of the encoders; None: drawn, of changed machines no coarse ones.
    """
    rng = np.random.default_rng([seed, *kind.encode()])
    name = ROBOTS[seed % len(ROBOTS)]
    robot = open_machine(name).derivation.robot
    values = dict(draw_parameters(name, seed))
    before = draw_settings(rng, 2 * seed, False)
    after = draw_settings(rng, 2 * seed + 1, True)
    if kind != NONE:  # one machine has one kind of encoder, and one that shows the change
        counts = counts or int(rng.choice(COUNTS[:2]))
    if counts:
        before, after = (dataclasses.replace(x, encoder_counts=counts) for x in (before, after))
    first = make_log("before", with_parameters(robot, values), before)
    changed, pattern, about, scale = dict(values), "", "", np.ones(len(first.joints))
    joint = str(rng.choice([j.name for j in robot.moving_joints]))
    place = first.joints.index(joint)
    if kind == NONE:  # a machine that is a little warmer
        warmer = 1.0 + 0.03 * rng.uniform(-1.0, 1.0)
        changed |= {p: v * warmer for p, v in values.items() if re.match(r"F[sv]", p)}
        about = f"friction x {warmer:.3f}"
    elif kind == "friction":
        factor = float(rng.choice((0.5, 1.5, 1.7, 2.0)))
        which = [("Fs",), ("Fs", "Fv")][rng.integers(2)]
        changed |= {p: v * factor for p, v in values.items() if p in [f + joint for f in which]}
        pattern = rf"joint {joint}: (?:Coulomb|viscous|friction)"
        about = f"{', '.join(which)} of joint {joint} x {factor:g}"
    elif kind == "load":
        total = sum(value for p, value in values.items() if re.match(r"M\d", p))
        mass, centre = float(total * rng.uniform(0.03, 0.08)), rng.normal(size=3) * 0.05
        changed |= add_body(values, first.joints[-1], mass, centre)
        pattern = r"a load of "
        about = f"{mass:.3g} kg"
    torque = float(np.sqrt(np.mean(first.tau[:, place] ** 2)))
    if kind == "gain":
        scale[place] = float(rng.choice((0.85, 0.93, 1.08, 1.15)))
        pattern = rf"joint {joint}: drive gain"
        about = f"torque of joint {joint} x {scale[place]:g}"
    second = make_log("after", with_parameters(robot, changed), after)
    tau = second.tau * scale
    if kind == "offset":
        offset = float(rng.choice((-1, 1)) * rng.uniform(0.08, 0.25) * torque)
        tau[:, place] += offset
        pattern = rf"joint {joint}: offset"
        about = f"{offset:+.3g} N m on joint {joint}"
    second = dataclasses.replace(second, tau=tau)
    about = f"{about}; {before.motion} -> {after.motion}, {before.encoder_counts} counts"
    return ChangedMachine(name, first, second, pattern, about)
