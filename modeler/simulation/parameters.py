"""The true parameters of a simulated robot: as the robot file states them, the rest drawn."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from modeler.core.errors import RobotError
from modeler.numerics.least_squares import minimize_over_cones
from modeler.robot import INERTIAL, Limits, Robot
from modeler.simulation.physics import PHYSICS, EffectPhysics, ShaftScale
from modeler.simulation.portable_math import round_to_ten_digits
from modeler.simulation.rigid import (
    BASE,
    Body,
    build_rigid_dynamics,
    compute_body,
    compute_pseudo_inertia,
    compute_standard_parameters,
    compute_world_frames,
    convert_pseudo_inertia,
    is_physical,
)
from modeler.simulation.thresholds import THRESHOLDS

_SUMS = {"XX": (1, 2), "YY": (0, 2), "ZZ": (0, 1)}  # XX = int y2 dm + int z2 dm, ...
_OUTSIDE = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2), "MX": (0, 3), "MY": (1, 3), "MZ": (2, 3)}
_TOLERANCES: dict[str, Any] = {f"tol_{what}": 1e-11 for what in ("gap_abs", "gap_rel", "feas")}


@dataclass(frozen=True)
class Completion:
    """Outcome of a search for a body.

    Attributes:
        values: all ten parameters by prefix, the stated ones as stated; None if none were found.
        impossible: True if it is proved that no body has the stated values.
    """

    values: dict[str, float] | None
    is_impossible: bool = False


@dataclass(frozen=True)
class _BodyProblem:
    """S(x) = origin + sum x_k directions[k], the scaled pseudo-inertia without its zero rows."""

    origin: np.ndarray  # (m, m)
    directions: np.ndarray  # (k, m, m), orthonormal as vectors
    scale: np.ndarray  # (4,) S_ij = P_ij / (scale_i scale_j)
    rows: np.ndarray  # (m,) those of the pseudo-inertia that are not zero


def complete_body(stated: Mapping[str, float], reference: Mapping[str, float]) -> Completion:
    """Returns the stated parameters, and for the others those of the nearest possible body.

    Nearest: least log-determinant divergence tr(P R^-1) - log det(P R^-1) from the reference R,
    brought to the stated mass; a body with an inside is preferred to plates, rods and points.

    Args:
        stated: some of the ten, by prefix.
        reference: all ten, of a body with an inside.
    """
    if not stated:
        return Completion(dict(reference))
    if len(stated) == len(INERTIAL):
        return Completion(dict(stated)) if is_physical(stated) else Completion(None, True)
    scale = stated["M"] / reference["M"] if stated.get("M", 0.0) > 0 else 1.0
    near = compute_pseudo_inertia(reference) * scale
    problem = _build_problem(stated, near)
    if problem is None:
        return Completion(None, is_impossible=True)
    if not problem.rows.size:
        return Completion(dict.fromkeys(INERTIAL, 0.0) | dict(stated))
    x = _find_feasible(problem)
    if x is None:
        return Completion(None)
    least = _compute_smallest_eigenvalue(_build_matrix(problem, x))
    if x.size and least > THRESHOLDS.min_strict_eigenvalue:
        x = _find_nearest(problem, near, x)
    elif x.size:
        x = _flatten_solution(problem, x)
    if _compute_smallest_eigenvalue(_build_matrix(problem, x)) < -THRESHOLDS.max_edge_violation:
        return Completion(None, is_impossible=True)
    scale = problem.scale[problem.rows]
    completed = np.zeros((4, 4))
    matrix = _build_matrix(problem, x) * np.outer(scale, scale)
    completed[np.ix_(problem.rows, problem.rows)] = matrix
    values = {**convert_pseudo_inertia(completed), **stated}
    return Completion(values if is_physical(values, THRESHOLDS.max_edge_violation) else None)


def _build_problem(stated: Mapping[str, float], near: np.ndarray) -> _BodyProblem | None:
    """The stated values as constraints; None if two of them exclude each other."""
    known = _compute_known_diagonal(stated)
    if _is_contradictory(stated, known):
        return None
    rows = np.array([i for i in range(4) if known.get(i) != 0.0], dtype=int)
    scale = _compute_scale(stated, known, near)
    pairs = [(i, j) for a, i in enumerate(rows) for j in rows[a:]]
    basis = np.zeros((len(pairs), 4, 4))
    for element, (i, j) in zip(basis, pairs, strict=True):
        element[i, j] = element[j, i] = 1.0 if i == j else np.sqrt(0.5)
    parameters = [convert_pseudo_inertia(e * np.outer(scale, scale)) for e in basis]
    equations, targets = [], []
    for prefix, value in stated.items():
        row = np.array([p[prefix] for p in parameters])
        size = float(np.linalg.norm(row))
        if size == 0.0:
            if abs(value) > THRESHOLDS.max_stated_rounding * max(map(abs, stated.values())):
                return None
            continue
        equations.append(row / size)
        targets.append(value / size)
    matrix = np.array(equations).reshape(-1, len(pairs))
    point = np.linalg.lstsq(matrix, np.array(targets), rcond=None)[0]
    _, singular, right = np.linalg.svd(matrix, full_matrices=True)
    free = right[int(np.sum(singular > 1e-12)) :]
    small = basis[:, rows][:, :, rows]
    return _BodyProblem(
        np.tensordot(point, small, 1), np.tensordot(free, small, 1), scale=scale, rows=rows
    )


def _compute_known_diagonal(stated: Mapping[str, float]) -> dict[int, float]:
    """Diagonal elements of the pseudo-inertia that the stated values fix; exactly 0 if so."""
    known = {3: float(stated["M"])} if "M" in stated else {}
    sums = {pair: stated[p] for p, pair in _SUMS.items() if p in stated}
    size = max(map(abs, sums.values()), default=0.0)
    if len(sums) == 3:
        half = sum(sums.values()) / 2
        known |= {i: half - stated[p] for i, p in enumerate(_SUMS)}
    for (i, j), value in sums.items():
        if value == 0.0:  # both are 0, as none is negative
            known |= {i: 0.0, j: 0.0}
    for _ in range(2):
        for (i, j), value in sums.items():
            for one, other in ((i, j), (j, i)):
                if one in known and other not in known:
                    known[other] = value - known[one]
    most = THRESHOLDS.max_stated_rounding * size
    return {i: 0.0 if i < 3 and abs(v) <= most else v for i, v in known.items()}


def _is_contradictory(stated: Mapping[str, float], known: Mapping[int, float]) -> bool:
    """True if a diagonal element is negative, or P_ii P_jj >= P_ij^2 cannot hold for a stated one.

    Says at once what is wrong by far; the multiplier of the search proves the rest.
    """
    most = {i: np.inf for i in range(4)}
    for prefix, pair in _SUMS.items():
        most |= {i: min(most[i], stated[prefix]) for i in pair if prefix in stated}
    most |= known
    if min(most.values()) < 0:
        return True
    for prefix, (i, j) in _OUTSIDE.items():
        product = most[i] * most[j] if most[i] and most[j] else 0.0
        for total in (stated[p] for p, pair in _SUMS.items() if pair == (i, j) and p in stated):
            product = min(product, total**2 / 4)  # the largest a b of a + b
        if stated.get(prefix, 0.0) ** 2 > product * (1 + 1e-9):
            return True
    return False


def _compute_scale(
    stated: Mapping[str, float], known: Mapping[int, float], near: np.ndarray
) -> np.ndarray:
    """(4,) roots of what the diagonal elements are about, so that S is of order 1."""
    size, unbounded = np.diag(near).copy(), []
    for i in range(4):
        sums = [abs(stated[p]) for p, pair in _SUMS.items() if p in stated and i in pair]
        bound = abs(known.get(i, 0.0)) or min(sums, default=0.0)
        size[i] = bound or size[i]
        unbounded += [] if bound else [i]
    for _ in range(3):  # P_ii P_jj > P_ij^2
        for prefix, (i, j) in _OUTSIDE.items():
            for one, other in ((i, j), (j, i)):
                if one in unbounded:
                    size[one] = max(size[one], 2 * stated.get(prefix, 0.0) ** 2 / size[other])
    return np.sqrt(size)


def _find_feasible(problem: _BodyProblem) -> np.ndarray | None:
    """The x of the largest t up to 1 with S(x) - t 1 >= 0; None if the solver finds none.

    Least S(x) below 0 then means that none is above.
    """
    count, rows = len(problem.directions), np.eye(len(problem.rows))
    if not count:
        return np.zeros(0)
    # The trace keeps free elements from running away.
    pull = THRESHOLDS.trace_weight * np.trace(problem.directions, axis1=1, axis2=2)
    x = minimize_over_cones(
        (np.zeros((0, count + 1)), np.zeros(0)),
        (-np.eye(count + 1)[count:], np.ones(1)),
        [(problem.origin, np.concatenate([problem.directions, -rows[None]]))],
        linear=np.append(pull, -1.0),
        **_TOLERANCES,
    )
    return None if x is None else x[:count]


def _flatten_solution(problem: _BodyProblem, x: np.ndarray) -> np.ndarray:
    """The same plate, rod or point with exact zeros: S(x) times what it nearly vanishes on."""
    for _ in range(THRESHOLDS.newton_steps):
        values, vectors = np.linalg.eigh(_build_matrix(problem, x))
        thin = vectors[:, values < THRESHOLDS.max_thin_eigenvalue]
        slope = (problem.directions @ thin).reshape(len(x), -1).T
        rest = (_build_matrix(problem, x) @ thin).ravel()
        flat = x - np.linalg.lstsq(slope, rest, rcond=1e-9)[0]
        both = [
            (_compute_smallest_eigenvalue(_build_matrix(problem, each)), each) for each in (x, flat)
        ]
        value, x = max(both, key=lambda pair: pair[0])
        if value > -THRESHOLDS.max_final_violation:
            break
    return x


def _find_nearest(problem: _BodyProblem, near: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The x with S(x) > 0 of least divergence from the reference, to all digits.

    Damped Newton: tr(W S) - log det S is self-concordant, so that it gets there from any x inside
    (Boyd and Vandenberghe 2004, section 9.6).
    """
    reference = (near / np.outer(problem.scale, problem.scale))[np.ix_(problem.rows, problem.rows)]
    weight = np.linalg.inv(reference)
    pull = np.tensordot(problem.directions, weight, 2)
    left = THRESHOLDS.newton_steps
    for _ in range(THRESHOLDS.max_damped_steps):
        turned = np.linalg.inv(_build_matrix(problem, x)) @ problem.directions
        slope = pull - np.trace(turned, axis1=1, axis2=2)
        curvature = np.einsum("kij,lji->kl", turned, turned)
        step = np.linalg.lstsq(curvature, slope, rcond=None)[0]
        decrement = np.sqrt(max(float(slope @ step), 0.0))
        at_the_end = decrement < 0.25
        step /= 1.0 if at_the_end else 1.0 + decrement
        left -= at_the_end
        if not _compute_smallest_eigenvalue(_build_matrix(problem, x - step)) > 0.0:
            break
        x = x - step
        if not left:
            break
    return x


def _build_matrix(problem: _BodyProblem, x: np.ndarray) -> np.ndarray:
    return np.asarray(problem.origin + np.tensordot(x, problem.directions, 1))


def _compute_smallest_eigenvalue(matrix: np.ndarray) -> float:
    return float(np.linalg.eigvalsh(matrix)[0])


# The true parameters of a simulated robot: as the robot file states them, the rest drawn.


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
    """Returns parameters of the robot file, completed by plausible ones from the seed.

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
        for row in bodies:
            bodies[row] = compute_body({p: standard.get(f"{p}{row}", 0.0) for p in INERTIAL})
    return PlantParameters(standard, bodies, tuple(name for name in standard if name in drawn))


def find_joint_physics(robot: Robot, joint: str) -> list[EffectPhysics]:
    """Returns the physics of the effects of that joint, in the order of the robot's effects.

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
    """Estimates the scales of every moving row, by torques of the links in random states."""
    dynamics = build_rigid_dynamics(robot, bodies)
    q, qd = dynamics.q, dynamics.qd
    qdd = ca.SX.sym("qdd", q.shape[0])
    torque = ca.Function("torque", [q, qd, qdd], [dynamics.inertia @ qdd + dynamics.bias])
    diagonal = ca.Function("diagonal", [q], [ca.diag(dynamics.inertia)])
    low, high = (np.array([[getattr(li, k)] for li in limits]) for k in ("lower", "upper"))
    speed, lift = (np.array([[getattr(li, k)] for li in limits]) for k in ("speed", "acceleration"))
    shape = (len(limits), THRESHOLDS.random_states)
    poses = rng.uniform(low, high, shape)
    torques = torque.map(THRESHOLDS.random_states)(
        poses, 0.5 * speed * rng.uniform(-1, 1, shape), 0.5 * lift * rng.uniform(-1, 1, shape)
    ).full()
    inertias = diagonal.map(THRESHOLDS.random_states)(poses).full()
    rms, inertia = np.sqrt(np.mean(torques**2, axis=1)), np.median(inertias, axis=1)
    # A motor that stands on the base and turns joints by gears moves no link of its own.
    idle = rms <= THRESHOLDS.max_idle_torque_share * rms.max()
    rms[idle] = THRESHOLDS.idle_torque_share * rms.max()
    inertia[idle] = rms[idle] / lift[idle, 0]
    rows = zip(rms.tolist(), inertia.tolist(), limits, strict=True)
    return [ShaftScale(torque, limit.speed, mass) for torque, mass, limit in rows]


# The links: as stated, the rest drawn.


def collect_stated_inertia(robot: Robot, joint: str) -> dict[str, float]:
    """Returns inertial parameters of that link that the robot file gives a number for, by prefix.

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
    """Completes the ten parameters of each moving link; returns the drawn names too.

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
    thinner = THRESHOLDS.link_mass_reduction ** np.array([depth[name] for name in tips])
    weights = (length + 0.2 * length.mean()) * thinner
    # The longest chain weighs what an arm of its reach weighs; other branches as this one.
    chain = path[max(reach, key=lambda name: reach[name])]
    on_it = np.array([name in chain for name in tips])
    total = THRESHOLDS.mass_per_squared_reach * length[on_it].sum() ** 2
    masses = total * weights / weights[on_it].sum()
    links = zip(tips.items(), masses, strict=True)
    return {name: _draw_box(m * rng.uniform(0.8, 1.2), tip, rng) for (name, tip), m in links}


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
    default = THRESHOLDS.default_link_length
    short = THRESHOLDS.short_link_share * real.mean() if real.size else default
    up = np.array([0.0, 0.0, short])
    return {name: tip if np.linalg.norm(tip) >= short else up.copy() for name, tip in tips.items()}


def merge_shared_names(
    robot: Robot, parameters: PlantParameters
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Returns values and drawn names by the robot's own names: XX2 for XX21, XX22, XX23."""
    first = {shared.members[0]: shared.name for shared in robot.shared}
    merged_names = {member for shared in robot.shared for member in shared.members[1:]}
    values, drawn = parameters.standard, parameters.drawn
    renamed = {first.get(n, n): value for n, value in values.items() if n not in merged_names}
    return renamed, tuple(first.get(n, n) for n in drawn if n not in merged_names)
