"""The true parameters of a simulated robot: as the robot file states them, the rest drawn."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from modeler.core.errors import RobotError
from modeler.robot.robot import INERTIAL, Limits, Robot
from modeler.simulation.completion import completed
from modeler.simulation.physics import PHYSICS, EffectPhysics, ShaftScale
from modeler.simulation.portable_math import ten_digits
from modeler.simulation.rigid import (
    BASE,
    Body,
    body_from_standard,
    rigid_dynamics,
    standard_from_body,
    world_frames,
)

_STATES = 64  # random states from which the typical torque of a joint is taken
_IDLE = 1e-9  # of the largest torque: joints below it move no mass
_OF_LARGEST = 0.02  # their scale instead


@dataclass(frozen=True)
class PlantParameters:
    """What the simulated robot is made of.

    Attributes:
        standard: every standard parameter by name, row after row of the table, SI units: those of
            the link, then those of the joint's effects; of all legs, also where they share some.
        bodies: the same links as mass, centre and inertia about the centre, by joint name.
        drawn: names that the robot file leaves open and that were drawn.
    """

    standard: Mapping[str, float]
    bodies: Mapping[str, Body]
    drawn: tuple[str, ...]


def plant_parameters(robot: Robot, limits: tuple[Limits, ...], seed: int = 0) -> PlantParameters:
    """Parameters of the robot file, completed by plausible ones from the seed.

    Friction, offsets and rotor inertias are drawn as shares of the torque and inertia which the
    links themselves need within `limits` (order of `robot.moving`).

    Raises:
        RobotError: numbers that no rigid body has, a negative friction or rotor inertia, or an
            effect that cannot be simulated; names the link or joint.
    """
    robot, similar = unshared(robot), robot
    rng = np.random.default_rng([seed, 1])
    middle = np.array([(limit.lower + limit.upper) / 2 for limit in limits])
    links, drawn_links = link_parameters(robot, middle, rng)
    bodies = {name: body_from_standard(values) for name, values in links.items()}
    scales = joint_scales(robot, bodies, limits, rng)
    standard: dict[str, float] = {}
    drawn = list(drawn_links)
    for joint, scale in zip(robot.moving, scales, strict=True):
        name = joint.name
        standard |= {p + name: links[name][p] for p in robot.inertial(name)}
        for effect in effects_of(robot, name):
            for prefix, value in effect.draw(rng, scale).items():
                stated = robot.parameters.get(prefix + name)
                if stated is None:
                    drawn.append(prefix + name)
                standard[prefix + name] = ten_digits(value) if stated is None else float(stated)
                _check_sign(robot, effect, prefix + name, prefix, standard[prefix + name])
    standard, bodies = alike(similar, standard, bodies)
    return PlantParameters(standard, bodies, tuple(name for name in standard if name in drawn))


def effects_of(robot: Robot, joint: str) -> list[EffectPhysics]:
    """The physics of the effects of that joint, in the order of the robot's effects.

    Raises:
        RobotError: an effect without physics here.
    """
    found = []
    for use in robot.effects:
        if joint in use.joints:
            if use.effect not in PHYSICS:
                raise RobotError(
                    f"robot {robot.name}, joint {joint}: effect {use.effect} cannot be simulated; "
                    f"expected one of {', '.join(PHYSICS)}; leave it out of the robot file"
                )
            found.append(PHYSICS[use.effect])
    return found


def _check_sign(robot: Robot, effect: EffectPhysics, name: str, prefix: str, value: float) -> None:
    if not np.isfinite(value) or (value < 0 and prefix not in effect.signed):
        raise RobotError(
            f"robot {robot.name}: {name} = {value:g} would drive the joint by itself "
            f"({effect.effect}); expected 0 or more"
        )


def joint_scales(
    robot: Robot,
    bodies: Mapping[str, Body],
    limits: tuple[Limits, ...],
    rng: np.random.Generator,
) -> list[ShaftScale]:
    """What is large and small on each moving row, by the torques of the links in random states."""
    dynamics = rigid_dynamics(robot, bodies)
    q, qd = dynamics.q, dynamics.qd
    qdd = ca.SX.sym("qdd", q.shape[0])
    torque = ca.Function("torque", [q, qd, qdd], [dynamics.inertia @ qdd + dynamics.bias])
    diagonal = ca.Function("diagonal", [q], [ca.diag(dynamics.inertia)])
    low, high = (np.array([[getattr(li, k)] for li in limits]) for k in ("lower", "upper"))
    speed, lift = (np.array([[getattr(li, k)] for li in limits]) for k in ("speed", "acceleration"))
    shape = (len(limits), _STATES)
    poses = rng.uniform(low, high, shape)
    torques = torque.map(_STATES)(
        poses, 0.5 * speed * rng.uniform(-1, 1, shape), 0.5 * lift * rng.uniform(-1, 1, shape)
    ).full()
    inertias = diagonal.map(_STATES)(poses).full()
    rms, inertia = np.sqrt(np.mean(torques**2, axis=1)), np.median(inertias, axis=1)
    # A motor that stands on the base and turns joints by gears moves no link of its own.
    idle = rms <= _IDLE * rms.max()
    rms[idle] = _OF_LARGEST * rms.max()
    inertia[idle] = rms[idle] / lift[idle, 0]
    return [
        ShaftScale(float(torque), limit.speed, float(mass))
        for torque, mass, limit in zip(rms, inertia, limits, strict=True)
    ]


# The links: as stated, the rest drawn.


_DENSITY = 30.0  # kg per squared metre of reach: an arm of 1 m weighs 30 kg
_THINNING = 0.7  # mass per length of a link, relative to the link before it
_SHORTEST = 0.15  # m, where the table holds no length at all
_OF_MEAN = 0.35  # length of a link without extent, relative to the mean of the others


def stated_inertia(robot: Robot, joint: str) -> dict[str, float]:
    """Inertial parameters of that link that the robot file gives a number for, by prefix.

    A standard parameter under `[parameters]` wins over the letters of a paper.
    """
    stated = {}
    symbols = robot.symbol_values()
    physical = robot.physical.get(joint)
    if physical is not None:
        cells = (physical.mass, *physical.centre, *physical.inertia)
        if all(cell.names <= symbols.keys() for cell in cells):
            mass, cx, cy, cz, xx, xy, xz, yy, yz, zz = (cell.number(symbols) for cell in cells)
            about_centre = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            stated = standard_from_body(Body(mass, np.array([cx, cy, cz]), about_centre))
    for prefix in INERTIAL:
        if f"{prefix}{joint}" in robot.parameters:
            stated[prefix] = float(robot.parameters[f"{prefix}{joint}"])
    return stated


def link_parameters(
    robot: Robot, pose: np.ndarray, rng: np.random.Generator
) -> tuple[dict[str, dict[str, float]], tuple[str, ...]]:
    """Ten parameters of each moving link by joint and prefix, and the names that were drawn.

    Sizes follow from the lengths of the table at `pose`, masses from the reach; a box of uneven
    density stands for each link, so that the ten parameters are those of a real body.

    Raises:
        RobotError: stated numbers that no distribution of mass has, or that none was found for;
            names the link.
    """
    drawn = _drawn_bodies(robot, pose, rng)
    links: dict[str, dict[str, float]] = {}
    names: list[str] = []
    for joint in robot.moving:
        stated = stated_inertia(robot, joint.name)
        own = robot.inertial(joint.name)
        if len(own) < len(INERTIAL):
            guess = standard_from_body(drawn[joint.name])
            links[joint.name] = {p: stated.get(p, guess[p] if p in own else 0.0) for p in INERTIAL}
            _check_few(robot, joint.name, links[joint.name])
            names += [f"{prefix}{joint.name}" for prefix in own if prefix not in stated]
            continue
        completion = completed(stated, standard_from_body(drawn[joint.name]))
        values = completion.values
        if values is None:
            raise _no_body(robot, joint.name, stated, completion.impossible)
        links[joint.name] = {prefix: values[prefix] for prefix in INERTIAL}
        names += [f"{prefix}{joint.name}" for prefix in INERTIAL if prefix not in stated]
    drawn_values = set(names)
    return {
        joint: {
            prefix: ten_digits(value) if f"{prefix}{joint}" in drawn_values else value
            for prefix, value in values.items()
        }
        for joint, values in links.items()
    }, tuple(names)


def _no_body(robot: Robot, link: str, stated: dict[str, float], impossible: bool) -> RobotError:
    numbers = ", ".join(f"{prefix}{link} = {v:g}" for prefix, v in stated.items())
    where = f"robot {robot.name}, link {link}"
    if impossible:
        return RobotError(
            f"{where}: no rigid body has the stated {numbers}; expected a mass above 0 and "
            "inertias that some distribution of that mass can have; correct them, or leave out "
            "what you do not know"
        )
    return RobotError(
        f"{where}: found no rigid body with the stated {numbers}, nor a proof that there is none; "
        "state all ten parameters of the link, or fewer"
    )


def _check_few(robot: Robot, link: str, values: dict[str, float]) -> None:
    """Nothing, unless a link without mass has first moments."""
    moments = [f"{prefix}{link}" for prefix in ("MX", "MY", "MZ") if values[prefix]]
    if moments and not values["M"]:
        raise RobotError(
            f"robot {robot.name}, link {link}: {', '.join(moments)} without a mass, which no body "
            f"has; add M{link} under [links] and [parameters]"
        )


def _drawn_bodies(robot: Robot, pose: np.ndarray, rng: np.random.Generator) -> dict[str, Body]:
    tips = _tips(robot, pose)
    lengths = np.array([np.linalg.norm(tip) for tip in tips.values()])
    depth = _depths(robot)
    weights = (lengths + 0.2 * lengths.mean()) * _THINNING ** np.array(
        [depth[name] for name in tips]
    )
    # The longest chain weighs what an arm of its reach weighs; other branches as this one.
    chain = _longest_chain(robot, dict(zip(tips, lengths, strict=True)))
    on_it = np.array([name in chain for name in tips])
    total = _DENSITY * lengths[on_it].sum() ** 2
    masses = total * weights / weights[on_it].sum()
    return {
        name: _box(mass * rng.uniform(0.8, 1.2), tip, rng)
        for (name, tip), mass in zip(tips.items(), masses, strict=True)
    }


def _box(mass: float, tip: np.ndarray, rng: np.random.Generator) -> Body:
    """A box along the link, turned a little so that no product of inertia vanishes."""
    length = float(np.linalg.norm(tip))
    sides = length * np.array([1.0, rng.uniform(0.25, 0.5), rng.uniform(0.25, 0.5)])
    along, _ = Rotation.align_vectors(tip[None] / length, np.array([[1.0, 0.0, 0.0]]))
    axes = (along * Rotation.from_rotvec(rng.normal(scale=0.2, size=3))).as_matrix()
    principal = mass / 12 * (np.sum(sides**2) - sides**2)
    centre = tip * rng.uniform(0.35, 0.6) + rng.normal(scale=0.08 * length, size=3)
    return Body(float(mass), centre, axes @ np.diag(principal) @ axes.T)


def _tips(robot: Robot, pose: np.ndarray) -> dict[str, np.ndarray]:
    """Vector from joint to the far end of each moving link, in its frame j, m."""
    q = ca.SX.sym("q", len(robot.moving))
    frames = world_frames(robot, q)
    values = ca.Function("frames", [q], [ca.horzcat(*(f.position for f in frames.values()))])
    turned = ca.Function("turned", [q], [ca.horzcat(*(f.rotation for f in frames.values()))])
    origins = dict(zip(frames, values(pose).full().T, strict=True))
    axes = dict(zip(frames, np.split(turned(pose).full(), len(frames), axis=1), strict=True))
    owner = _owners(robot)
    tips = {joint.name: np.zeros(3) for joint in robot.moving}
    for joint in robot.joints:
        link = owner[joint.antecedent]
        if link == BASE:
            continue
        end = axes[link].T @ (origins[joint.name] - origins[link])
        if np.linalg.norm(end) > np.linalg.norm(tips[link]):
            tips[link] = end
    lengths = np.array([np.linalg.norm(tip) for tip in tips.values()])
    real = lengths[lengths > 1e-6]
    short = _OF_MEAN * real.mean() if real.size else _SHORTEST
    return {
        name: tip if np.linalg.norm(tip) >= short else np.array([0.0, 0.0, short])
        for name, tip in tips.items()
    }


def _owners(robot: Robot) -> dict[str, str]:
    """The moving link (or the base) on which each frame is fixed."""
    owner = {BASE: BASE}
    for joint in robot.joints:
        owner[joint.name] = joint.name if joint.moves else owner[joint.antecedent]
    return owner


def _longest_chain(robot: Robot, lengths: dict[str, float]) -> set[str]:
    """The moving links from the base to the farthest tip, bars straightened out."""
    reach, path = {BASE: 0.0}, {BASE: frozenset[str]()}
    for joint in robot.joints:
        own = {joint.name} if joint.moves else set()
        reach[joint.name] = reach[joint.antecedent] + lengths.get(joint.name, 0.0)
        path[joint.name] = path[joint.antecedent] | own
    return set(path[max(reach, key=lambda name: reach[name])])


def _depths(robot: Robot) -> dict[str, int]:
    depth = {BASE: -1}
    for joint in robot.joints:
        depth[joint.name] = depth[joint.antecedent] + int(joint.moves)
    return depth


# Parameters that legs have in common: the first leg's links on all legs, told once.


def unshared(robot: Robot) -> Robot:
    """The robot with the values of shared parameters stated for each of their rows."""
    values = dict(robot.parameters)
    for shared in robot.shared:
        if shared.name in values:
            value = values.pop(shared.name)
            values |= dict.fromkeys(shared.members, value)
    return dataclasses.replace(robot, parameters=values, shared=())


def alike(
    robot: Robot, standard: Mapping[str, float], bodies: Mapping[str, Body]
) -> tuple[dict[str, float], dict[str, Body]]:
    """Standard parameters and bodies, with the first leg's values where legs share them."""
    values = dict(standard)
    for shared in robot.shared:
        values |= dict.fromkeys(shared.members, values[shared.members[0]])
    if not robot.shared:
        return values, dict(bodies)
    return values, {
        row: body_from_standard({p: values.get(f"{p}{row}", 0.0) for p in INERTIAL})
        for row in bodies
    }


def told_once(
    robot: Robot, standard: Mapping[str, float], drawn: tuple[str, ...]
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Values and drawn ones by the robot's own names: XX2 where legs share XX21, XX22, XX23."""
    first = {shared.members[0]: shared.name for shared in robot.shared}
    gone = {member for shared in robot.shared for member in shared.members[1:]}
    return (
        {first.get(n, n): value for n, value in standard.items() if n not in gone},
        tuple(first.get(n, n) for n in drawn if n not in gone),
    )
