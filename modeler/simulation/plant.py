"""The simulated robot: rigid links and effects as one ordinary differential equation."""

import dataclasses
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from modeler.core.errors import DataError, RobotError
from modeler.core.expression import parse_expression
from modeler.robot import Joint, Limits, Robot
from modeler.simulation.closing import Constraints, build_identity_map, compute_tree_map
from modeler.simulation.log import HiddenEffect
from modeler.simulation.parameters import PlantParameters
from modeler.simulation.physics import HIDDEN
from modeler.simulation.portable_math import make_portable, round_to_ten_digits
from modeler.simulation.rigid import (
    Body,
    RigidDynamics,
    build_rigid_dynamics,
    compute_body,
    compute_gravity_vector,
    compute_standard_parameters,
    reduce_dynamics,
)
from modeler.simulation.shafts import (
    ShaftEffects,
    Transmissions,
    combine_shaft_effects,
    find_transmissions,
)
from modeler.simulation.thresholds import THRESHOLDS


def apply_hidden_loads(
    robot: Robot, parameters: PlantParameters, effects: Sequence[HiddenEffect]
) -> tuple[Robot, PlantParameters]:
    """Returns the robot with hidden loads on its links, on a base that stands askew."""
    bodies = dict(parameters.bodies)
    for effect in effects:
        role, values = HIDDEN[effect.effect].role, effect.values
        if role == "gravity":
            robot = _rotate_gravity(robot, values["angle"], values["heading"])
        elif role == "body":  # a ball of that radius of gyration: all ten parameters change
            name = effect.joint or find_last_link(robot)
            inertia = values["mass"] * values["radius"] ** 2 * np.eye(3)
            ball = Body(values["mass"], np.array([values[k] for k in "xyz"]), inertia)
            one = compute_standard_parameters(bodies[name])
            other = compute_standard_parameters(ball)
            bodies[name] = compute_body({p: one[p] + other[p] for p in one})
    return robot, dataclasses.replace(parameters, bodies=bodies)


def find_last_link(robot: Robot) -> str:
    """Returns the row that carries a load: the platform, or the last one that moves."""
    return robot.platform[-1] if robot.platform else robot.moving_joints[-1].name


def _rotate_gravity(robot: Robot, angle: float, heading: float) -> Robot:
    """Gravity turned by `angle` about a horizontal axis, `heading` away from the first one.

    The horizontal axes are the world's two that are farther from gravity, made square to it.
    """
    gravity = compute_gravity_vector(robot)
    down = gravity / np.linalg.norm(gravity)
    first, second = (np.eye(3)[i] for i in np.sort(np.argsort(np.abs(down), kind="stable")[:2]))
    first = first - (first @ down) * down
    first /= np.linalg.norm(first)
    second = second - (second @ down) * down - (second @ first) * first
    second /= np.linalg.norm(second)
    axis = np.cos(heading) * first + np.sin(heading) * second
    turned = Rotation.from_rotvec(angle * axis).apply(gravity)
    x, y, z = (parse_expression(round_to_ten_digits(component)) for component in turned)
    return dataclasses.replace(robot, gravity=(x, y, z))


@dataclass(frozen=True)
class Plant:
    """M(q) qdd + h(q, qd) + friction(q, qd, z) = tau, and z' = f(q, qd, z) of inner states.

    All functions take and give CasADi columns: q, qd, qdd, tau (joints), z (states). Where a
    transmission gives way, q is the position of the motor; how far the link is ahead of it, and
    how fast, are the first of the inner states. With loops, q are the coordinates, and the joints
    that follow them the first of the inner states.

    Attributes:
        joints: names, in the order of q.
        driven: (joints,) True where a motor sits.
        states: number of inner states z; those of effects are 0 at the start, but see `strain`.
        acceleration: (q, qd, z, tau) -> (qdd, z').
        torque: (q, qd, qdd, z) -> tau, of links that accelerate with their motors.
        inertia: (q), with loops (q, z) -> M, rotors included, of links that move with their motors.

        strain: (q, z) -> torques that pull on links behind transmissions at rest; none to the
            others.
        fastest: rate of inner states at top speed, 1/s; 0 if speed does not make them fast.
        temperatures: (z) -> readings of thermometers, degC, on the joints of `thermometer_joints`.
        warmed: names of these joints.
        closer: (q, z) -> z with the loops closed again, by one step of Newton; None without loops.
    """

    joints: tuple[str, ...]
    driven: np.ndarray
    states: int
    acceleration: ca.Function
    torque: ca.Function
    inertia: ca.Function

    strain: ca.Function
    fastest: float
    temperatures: ca.Function
    thermometer_joints: tuple[str, ...]
    closer: ca.Function | None = None


def build_plant(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    hidden: tuple[HiddenEffect, ...] = (),
    constraints: Constraints | None = None,
) -> Plant:
    """Returns the plant with these parameters, in the coordinates.

    Args:
        robot: its table and effects.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`; they set the speed scale of dry friction.
        hidden: further effects on shafts and in transmissions, all their values given.
        constraints: of a robot with loops.

    Raises:
        RobotError: a joint that nothing gives an inertia, or an effect that cannot be simulated.
    """
    links = build_rigid_dynamics(robot, parameters.bodies)
    if constraints is not None:
        effects = combine_shaft_effects(
            robot, parameters, limits, links, build_identity_map(robot), hidden
        )
        return _build_closed_plant(robot, links, effects, constraints)
    tie = compute_tree_map(robot)
    if robot.relations:
        links = reduce_dynamics(links, *tie)
    giving = find_transmissions(robot, hidden)
    if giving.rows:
        links = reduce_dynamics(links, giving.turns, np.zeros(len(robot.free_joints)))
        tie = np.hstack([tie[0], np.zeros((len(tie[0]), len(giving.rows)))]), tie[1]
    effects = combine_shaft_effects(robot, parameters, limits, links, tie, hidden)
    plant = _build_open_plant(robot, links, effects, giving)
    for pose in generate_poses(select_free_limits(robot, limits)):
        values, vectors = np.linalg.eigh(plant.inertia(pose).full())
        if values[0] <= 1e-12 * values[-1]:
            joint = plant.joints[int(np.argmax(np.abs(vectors[:, 0])))]
            raise RobotError(
                f"robot {robot.name}, joint {joint}: nothing gives it an inertia (smallest "
                f"eigenvalue {values[0]:.3g} of the inertia matrix); state a mass or a rotor "
                "inertia"
            )
    return plant


def _build_open_plant(
    robot: Robot, links: RigidDynamics, effects: ShaftEffects, giving: Transmissions
) -> Plant:
    """Without loops, in the coordinates of the free joints."""
    n, k = len(robot.free_joints), len(giving.rows)
    q, qd = links.q[:n, :], links.qd[:n, :]
    ahead, ahead_rate = links.q[n:, :], links.qd[n:, :]
    z = ca.vertcat(ahead, ahead_rate, effects.state)
    tau, qdd = ca.SX.sym("tau", n), ca.SX.sym("qdd", n)
    inertia = links.inertia + ca.SX(effects.inertia)
    spring = ca.vertcat(ca.SX.zeros(n), giving.compute_torque(ahead, ahead_rate))
    solved = _solve_accelerations(links, effects, inertia, spring, ca.vertcat(tau, ca.SX.zeros(k)))

    at_rest = ca.substitute(links.bias + spring, links.qd, ca.SX.zeros(n + k))[n:, :]

    following = inertia[:n, :n]  # of links that move with their motors
    if k:
        following = ca.substitute(following, ahead, ca.SX.zeros(k))
    required_torque = links.inertia[:n, :n] @ qdd + links.bias[:n, :]
    torque = ca.vertcat(required_torque, ca.SX.zeros(k))
    load = links.bias[:n, :] + _apply_load(effects, torque)[:n, :]
    z_rate = ca.vertcat(ahead_rate, solved[n:, :], effects.rate)
    return _assemble_plant(
        robot.free_joints,
        effects,
        {"q": q, "qd": qd, "qdd": qdd, "z": z, "tau": tau},
        acceleration=("q qd z tau", solved[:n, :], z_rate),
        torque=("q qd qdd z", inertia[:n, :n] @ qdd + load),
        inertia=("q", ca.densify(following)),
        strain=("q z", at_rest),
        temperatures=("z", ca.vertcat(ca.SX(0, 1), *effects.temperatures.values())),
    )


def _assemble_plant(
    joints: Sequence[Joint],
    effects: ShaftEffects,
    symbols: dict[str, ca.SX],
    **functions: tuple[Any, ...],
) -> Plant:
    """The plant with these functions: names of their inputs, and their results."""
    casadi_functions = {
        name: make_portable(
            ca.Function(
                name,
                [symbols[k] for k in input_names.split()],
                [ca.cse(result) for result in results],
            )
        )
        for name, (input_names, *results) in functions.items()
    }
    return Plant(
        joints=tuple(joint.name for joint in joints),
        driven=np.array([joint.actuated for joint in joints]),
        states=symbols["z"].shape[0],
        fastest=effects.fastest,
        thermometer_joints=tuple(effects.temperatures),
        **casadi_functions,
    )


def _solve_accelerations(
    links: RigidDynamics, effects: ShaftEffects, inertia: ca.SX, spring: ca.SX, tau: ca.SX
) -> ca.SX:
    """Accelerations of all coordinates."""
    diagonal, lower, order = ca.ldl(inertia, False)  # M = L D L': no pivoting for M > 0

    def solve_with_load(load: ca.SX) -> ca.SX:
        resisting = links.bias + _apply_load(effects, load)
        return ca.ldl_solve(tau - resisting - spring, diagonal, lower, order)

    solved = solve_with_load(links.bias)
    if ca.depends_on(effects.torque, effects.load):
        for _ in range(
            THRESHOLDS.load_friction_passes
        ):  # friction slows the links, whose load makes the friction
            solved = solve_with_load(links.inertia @ solved + links.bias)
    return solved


def _apply_load(effects: ShaftEffects, load: ca.SX) -> ca.SX:
    if not ca.depends_on(effects.torque, effects.load):
        return effects.torque
    return ca.substitute(effects.torque, effects.load, load)


def _build_closed_plant(
    robot: Robot, links: RigidDynamics, effects: ShaftEffects, constraints: Constraints
) -> Plant:
    """With loops; the joints that follow the coordinates are the first of the inner states.

    With J the constraints' slope, vd = G qd and vdd = G qdd + g in all moving rows, where
    J_s G_s = -J_q and J_s g_s = -J' vd by least squares. The principle of virtual work gives
    G^T M G qdd + G^T (M g + h) = tau: no constraint force does work.
    """
    free = constraints.coordinate_rows
    others = constraints.passive_rows
    rows = len(robot.moving_joints)
    q, qd, qdd, tau = (ca.SX.sym(name, len(free)) for name in ("q", "qd", "qdd", "tau"))
    follow = ca.SX.sym("follow", len(others))
    v, G, g = ca.SX.zeros(rows), ca.SX.zeros(rows, len(free)), ca.SX.zeros(rows)
    v[free], v[others] = q, follow
    slope = _expand_function(constraints.jacobian, v)
    inner = slope[:, others]
    factors = ca.ldl(inner.T @ inner, False)  # L D L' without pivoting: away from singularities

    def solve_least_squares(right: ca.SX) -> ca.SX:
        return ca.ldl_solve(inner.T @ right, *factors)

    G[free, :], G[others, :] = (ca.SX.eye(len(free)), -solve_least_squares(slope[:, free]))
    vd = G @ qd
    g[others] = -solve_least_squares(_expand_function(constraints.curvature, v, vd))
    closer = follow - solve_least_squares(_expand_function(constraints.residual, v))
    z = ca.vertcat(follow, effects.state)
    tree = [links.inertia + ca.SX(effects.inertia), links.bias, effects.torque, effects.rate]
    tree += effects.temperatures.values()
    M, bias, friction, rate, *readings = ca.substitute(tree, [links.q, links.qd], [v, vd])
    inertia, load = G.T @ M @ G, G.T @ (M @ g + bias + friction)

    solved = ca.ldl_solve(tau - load, *ca.ldl(inertia, False))
    return _assemble_plant(
        robot.coordinates,
        effects,
        {"q": q, "qd": qd, "qdd": qdd, "z": z, "tau": tau},
        acceleration=("q qd z tau", solved, ca.vertcat(vd[others], rate)),
        torque=("q qd qdd z", inertia @ qdd + load),
        inertia=("q z", ca.densify(inertia)),
        strain=("q z", ca.SX(0, 1)),
        temperatures=("z", ca.vertcat(ca.SX(0, 1), *readings)),
        closer=("q z", ca.densify(ca.vertcat(closer, effects.state))),
    )


def _expand_function(function: ca.Function, *arguments: ca.SX) -> ca.SX:
    """What the function computes, in place of a call of it."""
    return function.call(list(arguments), True, False)[0]


def compute_inner_states(plant: Plant, constraints: Constraints, v: np.ndarray) -> np.ndarray:
    """Returns (n, plant.states) of a plant with loops at rest in postures v (n, moving rows)."""
    z = np.zeros((len(v), plant.states))
    z[:, : len(constraints.passive_rows)] = v[:, constraints.passive_rows]
    return z


def build_torque_function(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    hidden: tuple[HiddenEffect, ...] = (),
) -> tuple[ca.Function, int]:
    """Returns (q, qd, qdd, z) -> tau of all moving rows, untied, and the number of states z."""
    links = build_rigid_dynamics(robot, parameters.bodies)
    effects = combine_shaft_effects(
        robot, parameters, limits, links, build_identity_map(robot), hidden
    )
    qdd = ca.SX.sym("qdd", len(limits))
    torque = (links.inertia + ca.SX(effects.inertia)) @ qdd + links.bias + effects.torque
    function = ca.Function("torque", [links.q, links.qd, qdd, effects.state], [ca.cse(torque)])
    return make_portable(function), effects.state.shape[0]


def build_motor_inertia(plant: Plant) -> ca.Function:
    """Builds (q, z) -> (joints, joints) inertia that motors accelerate.

    The Schur complement of the passive joints in M; rows and columns of passive joints are 0.
    """
    if plant.closer is not None:
        return plant.inertia
    q, z = ca.SX.sym("q", len(plant.joints)), ca.SX.sym("z", plant.states)
    if np.all(plant.driven):
        return ca.Function("felt", [q, z], [plant.inertia(q)])
    is_driven = plant.driven
    driven, passive = (list(map(int, np.flatnonzero(x))) for x in (is_driven, ~is_driven))
    inertia = plant.inertia(q)
    motor_inertia = ca.SX.zeros(inertia.shape)
    motor_inertia[driven, driven] = inertia[driven, driven] - inertia[driven, passive] @ ca.solve(
        inertia[passive, passive], inertia[passive, driven]
    )
    return ca.Function("felt", [q, z], [motor_inertia])


def select_free_limits(robot: Robot, limits: tuple[Limits, ...]) -> tuple[Limits, ...]:
    """Selects the limits of `robot.free` among those in the order of `robot.moving`."""
    pairs = zip(robot.moving_joints, limits, strict=True)
    return tuple(limit for joint, limit in pairs if joint.name not in robot.relations)


def generate_poses(limits: tuple[Limits, ...], count: int = 16) -> np.ndarray:
    """Returns (count, joints) fixed poses over the range of motion, the middle first."""
    lower, upper = (np.array([getattr(li, k) for li in limits]) for k in ("lower", "upper"))
    share = np.random.default_rng(0).uniform(size=(count, len(limits)))
    share[0] = 0.5
    return lower + share * (upper - lower)


# Fixed-step integration of the plant over one control tick.


def choose_steps_per_tick(
    plant: Plant,
    limits: tuple[Limits, ...],
    tick: float,
    postures: tuple[np.ndarray, np.ndarray] | None = None,
) -> int:
    """Returns Runge-Kutta steps inside one control tick of `tick` seconds.

    The fastest mode is the spectral radius of d(x')/dx at rest, where dry friction is stiffest,
    over poses of the whole range, or over `postures`: (k, joints) positions, (k, states) states.

    Raises:
        DataError: friction so stiff against the inertia that no sensible step follows it; names
            the joint.
    """
    fastest, joint = 0.0, 0
    if postures is None:
        poses = generate_poses(limits, 8)
        postures = poses, np.zeros((len(poses), plant.states))
    for pose, z in zip(*postures, strict=True):
        values, vectors = np.linalg.eig(_compute_jacobian(plant, pose, z, limits))
        worst = int(np.argmax(np.abs(values)))
        if abs(values[worst]) > fastest:
            n = pose.size
            fastest, joint = abs(values[worst]), int(np.argmax(np.abs(vectors[n : 2 * n, worst])))
    if plant.fastest * tick / THRESHOLDS.max_step_times_rate > THRESHOLDS.max_steps_per_tick:
        raise DataError(
            f"simulation: the state of a hidden effect follows at {plant.fastest:.1e} 1/s at top "
            f"speed; expected at most "
            f"{THRESHOLDS.max_steps_per_tick * THRESHOLDS.max_step_times_rate / tick:.1e}; give "
            f"it a larger "
            "distance or width, or sample faster"
        )
    needed = tick * max(fastest, plant.fastest) / THRESHOLDS.max_step_times_rate
    steps = int(np.ceil(max(tick / THRESHOLDS.max_step, needed)))
    if steps > THRESHOLDS.max_steps_per_tick:
        raise DataError(
            f"simulation, joint {plant.joints[joint]}: friction stops it within "
            f"{1 / fastest:.1e} s; expected "
            f"{tick / THRESHOLDS.max_step_times_rate / THRESHOLDS.max_steps_per_tick:.1e} s or "
            f"more; state a "
            "larger inertia (Ia) or a smaller Fs, or sample faster"
        )
    return steps


def build_tick_function(plant: Plant, tick: float, steps: int) -> ca.Function:
    """Builds x, tau -> x one tick later at constant torque; x = (q, qd, z), Runge-Kutta 4.

    What is left open in loops, 1e-10 of the robot's size, is closed at the end of every tick.
    """
    n = len(plant.joints)
    x, tau = ca.MX.sym("x", 2 * n + plant.states), ca.MX.sym("tau", n)

    def compute_rate(state: ca.MX) -> ca.MX:
        qdd, z_rate = plant.acceleration(state[:n], state[n : 2 * n], state[2 * n :], tau)
        return ca.vertcat(state[n : 2 * n], qdd, z_rate)

    h = tick / steps
    k1 = compute_rate(x)
    k2 = compute_rate(x + h / 2 * k1)
    k3 = compute_rate(x + h / 2 * k2)
    k4 = compute_rate(x + h * k3)
    step = ca.Function("step", [x, tau], [x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)])
    later = x
    for _ in range(steps):
        later = step(later, tau)
    if plant.closer is not None:
        later = ca.vertcat(later[: 2 * n], plant.closer(later[:n], later[2 * n :]))
    return ca.Function("tick", [x, tau], [later])


def _compute_jacobian(
    plant: Plant, pose: np.ndarray, z: np.ndarray, limits: tuple[Limits, ...]
) -> np.ndarray:
    """d(qd, qdd, z')/d(q, qd, z) at rest, torque that holds the robot there; by differences."""
    n = pose.size
    rest = np.zeros(n)
    tau = plant.torque(pose, rest, rest, z).full().ravel()

    def compute_rate(x: np.ndarray) -> np.ndarray:
        qdd, z_rate = plant.acceleration(x[:n], x[n : 2 * n], x[2 * n :], tau)
        return np.concatenate([x[n : 2 * n], qdd.full().ravel(), z_rate.full().ravel()])

    x = np.concatenate([pose, rest, z])
    # Steps well inside the smooth core of dry friction (1e-3 of the top speed).
    speeds = [1e-6 * limit.speed for limit in limits]
    size = np.concatenate([np.full(n, 1e-6), speeds, np.full(z.size, 1e-6)])
    pairs = zip(size, np.eye(x.size), strict=True)
    columns = [(compute_rate(x + h * e) - compute_rate(x - h * e)) / (2 * h) for h, e in pairs]
    return np.column_stack(columns)


# CasADi functions as machine code where there is a C compiler, called without conversions.


# No fused multiply-add: the machine code gives the same bits as CasADi's own evaluation, so that
# a seed means the same measurement with and without a compiler.
_FLAGS = ("-O1", "-ffp-contract=off", "-fPIC", "-shared")


class FastFunction:
    """A CasADi function with one dense result, called with numpy vectors.

    A call through CasADi's own conversions takes 100 us, ten times the arithmetic of an arm.
    """

    def __init__(self, function: ca.Function) -> None:
        native: Any = compile_if_possible(function)
        assert native.n_out() == 1 and native.sparsity_out(0).is_dense()
        self._inputs = [np.zeros(native.nnz_in(i)) for i in range(native.n_in())]
        self._output = np.zeros(native.nnz_out(0))
        # CasADi does not keep the buffer alive for the callable made of it.
        self._buffer, self._evaluate = native.buffer()
        for i, values in enumerate(self._inputs):
            self._buffer.set_arg(i, values.data)
        self._buffer.set_res(0, self._output.data)

    def __call__(self, *arguments: np.ndarray) -> np.ndarray:
        """The result's elements, column after column."""
        for values, argument in zip(self._inputs, arguments, strict=True):
            values[:] = argument
        self._evaluate()
        return self._output.copy()


def compile_if_possible(function: ca.Function) -> ca.Function:
    """Returns the same function, about ten times faster if a C compiler is found; else as it is."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        return function
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        source, library = Path(folder) / "plant.c", Path(folder) / "plant.so"
        generator = ca.CodeGenerator(source.name)
        generator.add(function)
        generator.generate(f"{folder}/")
        command = [compiler, *_FLAGS, str(source), "-o", str(library), "-lm"]
        if subprocess.run(command, capture_output=True, check=False).returncode != 0:
            return function
        return ca.external(function.name(), str(library))
