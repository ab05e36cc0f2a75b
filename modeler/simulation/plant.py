"""The simulated robot: rigid links and effects as one ordinary differential equation."""

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.robot.robot import Limits, Robot
from modeler.simulation.closing import tree_from_free, untied
from modeler.simulation.hidden import HiddenEffect
from modeler.simulation.parameters import PlantParameters
from modeler.simulation.portable_math import portable
from modeler.simulation.rigid import RigidDynamics, rigid_dynamics, tied_dynamics
from modeler.simulation.shafts import ShaftEffects, Transmissions, shaft_effects, transmissions_of

_LOAD_PASSES = 3  # friction of a share mu of the load is then exact to about mu^4


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
        resistance: (q, qd, z) -> torque that the effects take from the motors, of links that do
            not accelerate.
        energy: (q, qd), with loops (q, qd, z) -> (kinetic energy, rotors included; potential
            energy), J, of links that move with their motors.
        strain: (q, z) -> torques that pull on links behind transmissions at rest; none to the
            others.
        fastest: rate of inner states at top speed, 1/s; 0 if speed does not make them fast.
        temperatures: (z) -> readings of thermometers, degC, on the joints of `warmed`.
        warmed: names of these joints.
        closer: (q, z) -> z with the loops closed again, by one step of Newton; None without loops.
    """

    joints: tuple[str, ...]
    driven: np.ndarray
    states: int
    acceleration: ca.Function
    torque: ca.Function
    inertia: ca.Function
    resistance: ca.Function
    energy: ca.Function
    strain: ca.Function
    fastest: float
    temperatures: ca.Function
    warmed: tuple[str, ...]
    closer: ca.Function | None = None


def build_plant(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    hidden: tuple[HiddenEffect, ...] = (),
) -> Plant:
    """The plant with these parameters, in the coordinates of the free joints.

    Args:
        robot: without loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`; they set the speed scale of dry friction.
        hidden: further effects on shafts and in transmissions, all their values given.

    Raises:
        RobotError: a joint that nothing gives an inertia, or an effect that cannot be simulated.
    """
    links = rigid_dynamics(robot, parameters.bodies)
    tie = tree_from_free(robot)
    if robot.relations:
        links = tied_dynamics(links, *tie)
    giving = transmissions_of(robot, hidden)
    if giving.rows:
        links = tied_dynamics(links, giving.turns, np.zeros(len(robot.free)))
        tie = np.hstack([tie[0], np.zeros((len(tie[0]), len(giving.rows)))]), tie[1]
    effects = shaft_effects(robot, parameters, limits, links, tie, hidden)
    plant = _assembled(robot, links, effects, giving)
    _check_inertia(robot, plant, of_free(robot, limits))
    return plant


def _assembled(
    robot: Robot, links: RigidDynamics, effects: ShaftEffects, giving: Transmissions
) -> Plant:
    n, k = len(robot.free), len(giving.rows)
    q, qd = links.q[:n, :], links.qd[:n, :]
    ahead, ahead_rate = links.q[n:, :], links.qd[n:, :]
    z = ca.vertcat(ahead, ahead_rate, effects.state)
    tau, qdd = ca.SX.sym("tau", n), ca.SX.sym("qdd", n)
    inertia = links.inertia + ca.SX(effects.inertia)
    spring = ca.vertcat(ca.SX.zeros(n), giving.torque(ahead, ahead_rate))
    solved = _solved(links, effects, inertia, spring, ca.vertcat(tau, ca.SX.zeros(k)))
    z_rate = ca.vertcat(ahead_rate, solved[n:, :], effects.rate)
    rotors = ca.dot(qd, ca.SX(effects.inertia[:n, :n]) @ qd) / 2
    rest = ca.SX.zeros(n + k)
    at_rest = ca.substitute(links.bias + spring, links.qd, rest)[n:, :]

    def following(expression: ca.SX) -> ca.SX:
        """Of links that move with their motors."""
        both, zero = ca.vertcat(ahead, ahead_rate), ca.SX.zeros(2 * k)
        return ca.substitute(expression, both, zero) if k else expression

    asked = links.inertia[:n, :n] @ qdd + links.bias[:n, :]
    load = links.bias[:n, :] + _loaded(effects, ca.vertcat(asked, ca.SX.zeros(k)))[:n, :]
    still = _loaded(effects, links.bias)[:n, :]
    energies = [following(links.kinetic) + rotors, following(links.potential)]
    temperatures = ca.vertcat(ca.SX(0, 1), *effects.temperatures.values())
    return Plant(
        joints=tuple(joint.name for joint in robot.free),
        driven=np.array([joint.actuated for joint in robot.free]),
        states=z.shape[0],
        acceleration=_function("acceleration", [q, qd, z, tau], [ca.cse(solved[:n, :]), z_rate]),
        torque=_function("torque", [q, qd, qdd, z], [inertia[:n, :n] @ qdd + load]),
        inertia=_function("inertia", [q], [ca.densify(following(inertia[:n, :n]))]),
        resistance=_function("resistance", [q, qd, z], [still]),
        energy=_function("energy", [q, qd], energies),
        strain=_function("strain", [q, z], [at_rest]),
        fastest=effects.fastest,
        temperatures=_function("temperatures", [z], [temperatures]),
        warmed=tuple(effects.temperatures),
    )


def _solved(
    links: RigidDynamics, effects: ShaftEffects, inertia: ca.SX, spring: ca.SX, tau: ca.SX
) -> ca.SX:
    """Accelerations of all coordinates."""
    diagonal, lower, order = ca.ldl(inertia, False)  # M = L D L': no pivoting for M > 0

    def moved(load: ca.SX) -> ca.SX:
        resisting = links.bias + _loaded(effects, load)
        return ca.ldl_solve(tau - resisting - spring, diagonal, lower, order)

    solved = moved(links.bias)
    if not ca.depends_on(effects.torque, effects.load):
        return solved
    for _ in range(_LOAD_PASSES):  # friction slows the links, whose load makes the friction
        solved = moved(links.inertia @ solved + links.bias)
    return solved


def _loaded(effects: ShaftEffects, load: ca.SX) -> ca.SX:
    if not ca.depends_on(effects.torque, effects.load):
        return effects.torque
    return ca.substitute(effects.torque, effects.load, load)


def torque_function(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    hidden: tuple[HiddenEffect, ...] = (),
) -> tuple[ca.Function, int]:
    """(q, qd, qdd, z) -> tau of all moving rows, untied, and the number of states z."""
    links = rigid_dynamics(robot, parameters.bodies)
    effects = shaft_effects(robot, parameters, limits, links, untied(robot), hidden)
    qdd = ca.SX.sym("qdd", len(limits))
    torque = (links.inertia + ca.SX(effects.inertia)) @ qdd + links.bias + effects.torque
    inputs = [links.q, links.qd, qdd, effects.state]
    return _function("torque", inputs, [ca.cse(torque)]), effects.state.shape[0]


def _function(name: str, inputs: list[ca.SX], outputs: list[ca.SX]) -> ca.Function:
    return portable(ca.Function(name, inputs, outputs))


def felt_inertia(plant: Plant) -> ca.Function:
    """(q, z) -> (joints, joints) inertia that motors feel, joints without motor swinging freely.

    The Schur complement of the passive joints in M; rows and columns of passive joints are 0.
    """
    if plant.closer is not None:
        return plant.inertia
    q, z = ca.SX.sym("q", len(plant.joints)), ca.SX.sym("z", plant.states)
    if np.all(plant.driven):
        return ca.Function("felt", [q, z], [plant.inertia(q)])
    driven, passive = (list(map(int, np.flatnonzero(plant.driven == own))) for own in (True, False))
    inertia = plant.inertia(q)
    felt = ca.SX.zeros(inertia.shape)
    felt[driven, driven] = inertia[driven, driven] - inertia[driven, passive] @ ca.solve(
        inertia[passive, passive], inertia[passive, driven]
    )
    return ca.Function("felt", [q, z], [felt])


def of_free(robot: Robot, limits: tuple[Limits, ...]) -> tuple[Limits, ...]:
    """Those of `robot.free` among limits in the order of `robot.moving`."""
    pairs = zip(robot.moving, limits, strict=True)
    return tuple(limit for joint, limit in pairs if joint.name not in robot.relations)


def sample_poses(limits: tuple[Limits, ...], count: int = 16) -> np.ndarray:
    """(count, joints) poses spread over the range of motion, the middle first; always the same."""
    lower, upper = (np.array([getattr(li, k) for li in limits]) for k in ("lower", "upper"))
    share = np.random.default_rng(0).uniform(size=(count, len(limits)))
    share[0] = 0.5
    return lower + share * (upper - lower)


def _check_inertia(robot: Robot, plant: Plant, limits: tuple[Limits, ...]) -> None:
    for pose in sample_poses(limits):
        values, vectors = np.linalg.eigh(plant.inertia(pose).full())
        if values[0] <= 1e-12 * values[-1]:
            joint = plant.joints[int(np.argmax(np.abs(vectors[:, 0])))]
            raise RobotError(
                f"robot {robot.name}, joint {joint}: nothing gives it an inertia (smallest "
                f"eigenvalue {values[0]:.3g} of the inertia matrix); state a mass or a rotor "
                "inertia"
            )


# Fixed-step integration of the plant over one control tick.


_SLOWEST_STEP = 5e-4  # s: rigid motion of an arm is then exact to some 1e-10
_STABLE = 1.5  # of a step times the fastest mode; Runge-Kutta 4 is stable up to 2.78
_MOST_STEPS = 400  # per tick


def steps_per_tick(
    plant: Plant,
    limits: tuple[Limits, ...],
    tick: float,
    postures: tuple[np.ndarray, np.ndarray] | None = None,
) -> int:
    """Runge-Kutta steps inside one control tick of `tick` seconds.

    The fastest mode is the spectral radius of d(x')/dx at rest, where dry friction is stiffest,
    over poses of the whole range, or over `postures`: (k, joints) positions, (k, states) states.

    Raises:
        DataError: friction so stiff against the inertia that no sensible step follows it; names
            the joint.
    """
    fastest, joint = 0.0, 0
    if postures is None:
        poses = sample_poses(limits, 8)
        postures = poses, np.zeros((len(poses), plant.states))
    for pose, z in zip(*postures, strict=True):
        values, vectors = np.linalg.eig(_jacobian(plant, pose, z, limits))
        worst = int(np.argmax(np.abs(values)))
        if abs(values[worst]) > fastest:
            n = pose.size
            fastest, joint = abs(values[worst]), int(np.argmax(np.abs(vectors[n : 2 * n, worst])))
    if plant.fastest * tick / _STABLE > _MOST_STEPS:
        raise DataError(
            f"simulation: the state of a hidden effect follows at {plant.fastest:.1e} 1/s at top "
            f"speed; expected at most {_MOST_STEPS * _STABLE / tick:.1e}; give it a larger "
            "distance or width, or sample faster"
        )
    needed = tick * max(fastest, plant.fastest) / _STABLE
    steps = int(np.ceil(max(tick / _SLOWEST_STEP, needed)))
    if steps > _MOST_STEPS:
        raise DataError(
            f"simulation, joint {plant.joints[joint]}: friction stops it within "
            f"{1 / fastest:.1e} s; expected {tick / _STABLE / _MOST_STEPS:.1e} s or more; state a "
            "larger inertia (Ia) or a smaller Fs, or sample faster"
        )
    return steps


def tick_function(plant: Plant, tick: float, steps: int) -> ca.Function:
    """x, tau -> x one tick later under constant torque; x = (q, qd, z), Runge-Kutta of order 4.

    What is left open in loops, 1e-10 of the robot's size, is closed at the end of every tick.
    """
    n = len(plant.joints)
    x, tau = ca.MX.sym("x", 2 * n + plant.states), ca.MX.sym("tau", n)

    def rate(state: ca.MX) -> ca.MX:
        qdd, z_rate = plant.acceleration(state[:n], state[n : 2 * n], state[2 * n :], tau)
        return ca.vertcat(state[n : 2 * n], qdd, z_rate)

    h = tick / steps
    k1 = rate(x)
    k2 = rate(x + h / 2 * k1)
    k3 = rate(x + h / 2 * k2)
    k4 = rate(x + h * k3)
    step = ca.Function("step", [x, tau], [x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)])
    later = x
    for _ in range(steps):
        later = step(later, tau)
    if plant.closer is not None:
        later = ca.vertcat(later[: 2 * n], plant.closer(later[:n], later[2 * n :]))
    return ca.Function("tick", [x, tau], [later])


def _jacobian(
    plant: Plant, pose: np.ndarray, z: np.ndarray, limits: tuple[Limits, ...]
) -> np.ndarray:
    """d(qd, qdd, z')/d(q, qd, z) at rest, torque that holds the robot there; by differences."""
    n = pose.size
    rest = np.zeros(n)
    tau = plant.torque(pose, rest, rest, z).full().ravel()

    def rate(x: np.ndarray) -> np.ndarray:
        qdd, z_rate = plant.acceleration(x[:n], x[n : 2 * n], x[2 * n :], tau)
        return np.concatenate([x[n : 2 * n], qdd.full().ravel(), z_rate.full().ravel()])

    x = np.concatenate([pose, rest, z])
    # Steps well inside the smooth core of dry friction (1e-3 of the top speed).
    size = np.concatenate(
        [np.full(n, 1e-6), [1e-6 * limit.speed for limit in limits], np.full(z.size, 1e-6)]
    )
    columns = [
        (rate(x + h * unit) - rate(x - h * unit)) / (2 * h)
        for h, unit in zip(size, np.eye(x.size), strict=True)
    ]
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
        native: Any = compiled_where_possible(function)
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


def compiled_where_possible(function: ca.Function) -> ca.Function:
    """The same function, about ten times faster if a C compiler is found; else as it is."""
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
