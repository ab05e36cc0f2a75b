"""The true parameters of a simulated robot: as the robot file states them, the rest drawn."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from modeler.core.errors import RobotError
from modeler.robot import INERTIAL, Limits, Robot
from modeler.simulation.completion import complete_body
from modeler.simulation.physics import PHYSICS, EffectPhysics, ShaftScale
from modeler.simulation.portable_math import round_to_ten_digits
from modeler.simulation.rigid import (
    BASE,
    Body,
    build_rigid_dynamics,
    compute_body,
    compute_standard_parameters,
    compute_world_frames,
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


def draw_plant_parameters(
    robot: Robot, limits: tuple[Limits, ...], seed: int = 0
) -> PlantParameters:
    """Parameters of the robot file, completed by plausible ones from the seed.

    Friction, offsets and rotor inertias are drawn as shares of the torque and inertia which the
    links themselves need within `limits` (order of `robot.moving`).

    Raises:
        RobotError: numbers that no rigid body has, a negative friction or rotor inertia, or an
            effect that cannot be simulated; names the link or joint.
    """
    similar, values = robot, dict(robot.parameters)
    for shared in similar.shared:  # stated for each of its rows
        if shared.name in values:
            values |= dict.fromkeys(shared.members, values.pop(shared.name))
    robot = dataclasses.replace(similar, parameters=values, shared=())
    rng = np.random.default_rng([seed, 1])
    middle = np.array([(limit.lower + limit.upper) / 2 for limit in limits])
    links, drawn_links = complete_link_parameters(robot, middle, rng)
    bodies = {name: compute_body(values) for name, values in links.items()}
    scales = estimate_joint_scales(robot, bodies, limits, rng)
    standard: dict[str, float] = {}
    drawn = list(drawn_links)
    for joint, scale in zip(robot.moving_joints, scales, strict=True):
        name = joint.name
        standard |= {p + name: links[name][p] for p in robot.get_inertial_prefixes(name)}
        for effect in find_joint_physics(robot, name):
            for prefix, value in effect.draw(rng, scale).items():
                stated = robot.parameters.get(prefix + name)
                if stated is None:
                    drawn.append(prefix + name)
                value = round_to_ten_digits(value) if stated is None else float(stated)
                if not np.isfinite(value) or (value < 0 and prefix not in effect.signed):
                    raise RobotError(
                        f"robot {robot.name}: {prefix}{name} = {value:g} would drive the joint by "
                        f"itself ({effect.effect}); expected 0 or more"
                    )
                standard[prefix + name] = value
    if similar.shared:  # the first leg's links on all legs
        for shared in similar.shared:
            standard |= dict.fromkeys(shared.members, standard[shared.members[0]])
        bodies = {
            row: compute_body({p: standard.get(f"{p}{row}", 0.0) for p in INERTIAL})
            for row in bodies
        }
    return PlantParameters(standard, bodies, tuple(name for name in standard if name in drawn))


def find_joint_physics(robot: Robot, joint: str) -> list[EffectPhysics]:
    """The physics of the effects of that joint, in the order of the robot's effects.

    Raises:
        RobotError: an effect without physics here.
    """
    joint_physics = []
    for use in robot.effects:
        if joint in use.joints:
            if use.effect not in PHYSICS:
                raise RobotError(
                    f"robot {robot.name}, joint {joint}: effect {use.effect} cannot be simulated; "
                    f"expected one of {', '.join(PHYSICS)}; leave it out of the robot file"
                )
            joint_physics.append(PHYSICS[use.effect])
    return joint_physics


def estimate_joint_scales(
    robot: Robot, bodies: Mapping[str, Body], limits: tuple[Limits, ...], rng: np.random.Generator
) -> list[ShaftScale]:
    """What is large and small on each moving row, by the torques of the links in random states."""
    dynamics = build_rigid_dynamics(robot, bodies)
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


def collect_stated_inertia(robot: Robot, joint: str) -> dict[str, float]:
    """Inertial parameters of that link that the robot file gives a number for, by prefix.

    A standard parameter under `[parameters]` wins over the letters of a paper.
    """
    stated = {}
    symbols = robot.evaluate_symbols()
    physical = robot.physical.get(joint)
    if physical is not None:
        cells = (physical.mass, *physical.centre, *physical.inertia)
        if all(cell.names <= symbols.keys() for cell in cells):
            mass, cx, cy, cz, xx, xy, xz, yy, yz, zz = (cell.evaluate(symbols) for cell in cells)
            about_centre = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            stated = compute_standard_parameters(Body(mass, np.array([cx, cy, cz]), about_centre))
    for prefix in INERTIAL:
        if f"{prefix}{joint}" in robot.parameters:
            stated[prefix] = float(robot.parameters[f"{prefix}{joint}"])
    return stated


def complete_link_parameters(
    robot: Robot, pose: np.ndarray, rng: np.random.Generator
) -> tuple[dict[str, dict[str, float]], tuple[str, ...]]:
    """Ten parameters of each moving link by joint and prefix, and the names that were drawn.

    Sizes follow from the lengths of the table at `pose`, masses from the reach; a box of uneven
    density stands for each link, so that the ten parameters are those of a real body.

    Raises:
        RobotError: stated numbers that no distribution of mass has, or that none was found for;
            names the link.
    """
    drawn = _draw_bodies(robot, pose, rng)
    links: dict[str, dict[str, float]] = {}
    names: list[str] = []
    for link in (joint.name for joint in robot.moving_joints):
        stated, prefixes = collect_stated_inertia(robot, link), robot.get_inertial_prefixes(link)
        guess = compute_standard_parameters(drawn[link])
        where = f"robot {robot.name}, link {link}"
        if len(prefixes) < len(INERTIAL):
            values = {p: stated.get(p, guess[p] if p in prefixes else 0.0) for p in INERTIAL}
            moments = [f"{prefix}{link}" for prefix in ("MX", "MY", "MZ") if values[prefix]]
            if moments and not values["M"]:
                raise RobotError(
                    f"{where}: {', '.join(moments)} without a mass, which no body "
                    f"has; add M{link} under [links] and [parameters]"
                )
        else:
            completion = complete_body(stated, guess)
            numbers = ", ".join(f"{prefix}{link} = {v:g}" for prefix, v in stated.items())
            if completion.values is None and completion.is_impossible:
                raise RobotError(
                    f"{where}: no rigid body has the stated {numbers}; expected a mass above 0 and "
                    "inertias that some distribution of that mass can have; correct them, or leave "
                    "out what you do not know"
                )
            if completion.values is None:
                raise RobotError(
                    f"{where}: found no rigid body with the stated {numbers}, nor a proof that "
                    "there is none; state all ten parameters of the link, or fewer"
                )
            values = completion.values
        open_ = {p for p in prefixes if p not in stated}
        links[link] = {
            p: round_to_ten_digits(values[p]) if p in open_ else values[p] for p in INERTIAL
        }
        names += [f"{prefix}{link}" for prefix in prefixes if prefix in open_]
    return links, tuple(names)


def _draw_bodies(robot: Robot, pose: np.ndarray, rng: np.random.Generator) -> dict[str, Body]:
    tips = _find_tips(robot, pose)
    lengths = {name: float(np.linalg.norm(tip)) for name, tip in tips.items()}
    # From the base: how many links, how far with bars straightened out, over which links.
    depth, reach, path = {BASE: -1}, {BASE: 0.0}, {BASE: frozenset[str]()}
    for joint in robot.joints:
        name, before = joint.name, joint.antecedent
        depth[name] = depth[before] + int(joint.is_moving)
        reach[name] = reach[before] + lengths.get(name, 0.0)
        path[name] = path[before] | ({name} if joint.is_moving else set())
    length = np.array([*lengths.values()])
    thinner = _THINNING ** np.array([depth[name] for name in tips])
    weights = (length + 0.2 * length.mean()) * thinner
    # The longest chain weighs what an arm of its reach weighs; other branches as this one.
    chain = path[max(reach, key=lambda name: reach[name])]
    on_it = np.array([name in chain for name in tips])
    masses = _DENSITY * length[on_it].sum() ** 2 * weights / weights[on_it].sum()
    return {
        name: _draw_box(mass * rng.uniform(0.8, 1.2), tip, rng)
        for (name, tip), mass in zip(tips.items(), masses, strict=True)
    }


def _draw_box(mass: float, tip: np.ndarray, rng: np.random.Generator) -> Body:
    """A box along the link, turned a little so that no product of inertia vanishes."""
    length = float(np.linalg.norm(tip))
    sides = length * np.array([1.0, rng.uniform(0.25, 0.5), rng.uniform(0.25, 0.5)])
    along, _ = Rotation.align_vectors(tip[None] / length, np.array([[1.0, 0.0, 0.0]]))
    axes = (along * Rotation.from_rotvec(rng.normal(scale=0.2, size=3))).as_matrix()
    principal = mass / 12 * (np.sum(sides**2) - sides**2)
    centre = tip * rng.uniform(0.35, 0.6) + rng.normal(scale=0.08 * length, size=3)
    return Body(float(mass), centre, axes @ np.diag(principal) @ axes.T)


def _find_tips(robot: Robot, pose: np.ndarray) -> dict[str, np.ndarray]:
    """Vector from joint to the far end of each moving link, in its frame j, m."""
    q = ca.SX.sym("q", len(robot.moving_joints))
    frames = compute_world_frames(robot, q)
    values = ca.Function("frames", [q], [ca.horzcat(*(f.position for f in frames.values()))])
    turned = ca.Function("turned", [q], [ca.horzcat(*(f.rotation for f in frames.values()))])
    origins = dict(zip(frames, values(pose).full().T, strict=True))
    axes = dict(zip(frames, np.split(turned(pose).full(), len(frames), axis=1), strict=True))
    owner = {BASE: BASE}  # the moving link (or the base) on which each frame is fixed
    tips = {joint.name: np.zeros(3) for joint in robot.moving_joints}
    for joint in robot.joints:
        link = owner[joint.antecedent]
        owner[joint.name] = joint.name if joint.is_moving else link
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


def merge_shared_names(
    robot: Robot, parameters: PlantParameters
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Values and drawn ones by the robot's own names: XX2 where legs share XX21, XX22, XX23."""
    first = {shared.members[0]: shared.name for shared in robot.shared}
    merged_names = {member for shared in robot.shared for member in shared.members[1:]}
    return (
        {
            first.get(n, n): value
            for n, value in parameters.standard.items()
            if n not in merged_names
        },
        tuple(first.get(n, n) for n in parameters.drawn if n not in merged_names),
    )
