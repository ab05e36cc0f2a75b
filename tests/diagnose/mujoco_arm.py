"""A 3R arm that MuJoCo moves: logs from outside, with effects that the robot file does not name.

Bodies, friction, rotor inertia and springs are MuJoCo's own; the controller sees an encoder with
steps and knows the rigid body only.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import mujoco
import numpy as np

from tests.hidden_effects.motion import Bounds, motion

G = 9.81  # m/s2
TICK, STEPS = 1e-3, 2  # s; MuJoCo steps in a control tick
COUNT = 2 * np.pi / 2**20  # rad, of the encoder
NOISE = 0.005  # of a joint's rms torque
MIDDLE = np.array([0.0, 0.9, 0.0])  # rad
BOUNDS = Bounds(
    angle=np.array([2.6, 1.5, 2.4]),
    speed=np.array([2.5, 2.0, 3.0]),
    acceleration=np.array([10.0, 8.0, 12.0]),
)
ROWS = [1, 2, 3]
DRY = 'solreffriction="0.002 1" solimpfriction="0.99 0.999 0.001 0.5 2"'
"""MuJoCo's dry friction is a constraint that gives way; at its usual settings it is viscous below
some 0.05 rad/s, faster than what counts as standing still. This is ten times harder."""


@dataclass(frozen=True)
class Body:
    """Mass, centre (3,) in its frame, inertia (3, 3) about the centre; kg, m, kg m2."""

    mass: float
    centre: np.ndarray
    inertia: np.ndarray


def random_body(rng: np.random.Generator, mass: float, low: Sequence, high: Sequence) -> Body:
    """The body of twenty random points in a box: masses and inertias that a body can have."""
    weights = rng.uniform(0.5, 1.5, 20)
    weights *= mass / weights.sum()
    points = rng.uniform(low, high, (20, 3))
    centre = weights @ points / mass
    r = points - centre
    inertia = np.trace(r.T * weights @ r) * np.eye(3) - r.T * weights @ r
    return Body(mass, centre, inertia)


@dataclass(frozen=True)
class Arm:
    """What is true. MDH rows: alpha, d, r; joint arrays (3,), SI."""

    table: tuple[tuple[float, float, float], ...]
    bodies: tuple[Body, ...]
    damping: np.ndarray
    frictionloss: np.ndarray
    armature: np.ndarray
    stiffness: np.ndarray = field(default_factory=lambda: np.zeros(3))
    gravity: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, -G]))
    payload: Body | None = None


def random_arm(seed: int) -> Arm:
    """Waist upright, shoulder, elbow; reach near 0.8 m."""
    rng = np.random.default_rng([seed, 1])
    before, upper = rng.uniform(0.04, 0.10), rng.uniform(0.35, 0.45)
    return Arm(
        table=((0.0, 0.0, 0.0), (np.pi / 2, before, 0.0), (0.0, upper, rng.uniform(0.02, 0.06))),
        bodies=(
            random_body(rng, rng.uniform(10, 14), [-0.1, -0.1, -0.3], [0.15, 0.1, 0.05]),
            random_body(rng, rng.uniform(6, 9), [-0.1, -0.07, -0.05], [upper, 0.07, 0.1]),
            random_body(rng, rng.uniform(3, 5), [-0.05, -0.06, -0.06], [0.35, 0.06, 0.04]),
        ),
        damping=np.array([6.0, 5.0, 2.0]) * rng.uniform(0.8, 1.2, 3),
        frictionloss=np.array([7.0, 8.0, 3.5]) * rng.uniform(0.8, 1.2, 3),
        armature=np.array([1.3, 1.1, 0.35]) * rng.uniform(0.8, 1.2, 3),
    )


def mjcf(arm: Arm) -> str:
    """The arm as MuJoCo reads it."""
    text = ""
    for j, ((alpha, d, r), body) in enumerate(zip(arm.table, arm.bodies, strict=True)):
        place = [d, -r * np.sin(alpha), r * np.cos(alpha)]
        turn = [np.cos(alpha / 2), np.sin(alpha / 2), 0.0, 0.0]
        text += (
            f'<body pos="{_numbers(place)}" quat="{_numbers(turn)}">'
            f'<joint name="{j + 1}" type="hinge" axis="0 0 1" damping="{arm.damping[j]}" '
            f'frictionloss="{arm.frictionloss[j]}" armature="{arm.armature[j]}" '
            f'stiffness="{arm.stiffness[j]}" {DRY}/>{_inertial(body)}'
        )
    if arm.payload is not None:
        text += f"<body>{_inertial(arm.payload)}</body>"
    motors = "".join(f'<motor joint="{j}"/>' for j in ROWS)
    return (
        f'<mujoco><compiler angle="radian" inertiafromgeom="false"/>'
        f'<option timestep="{TICK / STEPS}" integrator="implicitfast" '
        f'gravity="{_numbers(arm.gravity)}"/>'
        f"<worldbody>{text}{'</body>' * 3}</worldbody><actuator>{motors}</actuator></mujoco>"
    )


def _numbers(values: Sequence[float] | np.ndarray) -> str:
    return " ".join(f"{x:.17g}" for x in values)


def _inertial(body: Body) -> str:
    full = body.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return (
        f'<inertial pos="{_numbers(body.centre)}" mass="{body.mass:.17g}" '
        f'fullinertia="{_numbers(full)}"/>'
    )


def robot_text(arm: Arm, effects: Mapping[str, Sequence[int]]) -> str:
    """The robot file: the table of the arm, gravity straight down, and these effects."""
    rows = "".join(
        f'["{j}", "{j - 1}", {"0" if alpha == 0.0 else chr(34) + "pi/2" + chr(34)}, '
        f'{d!r}, "q{j}", {r!r}],\n'
        for j, (alpha, d, r) in zip(ROWS, arm.table, strict=True)
    )
    named = "".join(f"{name} = {[str(j) for j in joints]}\n" for name, joints in effects.items())
    return (
        f'name = "outside"\ngravity = [0, 0, {-G}]\n[mdh]\n'
        f'columns = ["j", "a", "alpha", "d", "theta", "r"]\nrows = [\n{rows}]\n[effects]\n{named}'
    )


def run(arm: Arm, seed: int, half: float) -> dict[str, np.ndarray]:
    """Columns of a log: the arm under a controller that follows moves and a Fourier series.

    The torque of a row is that from its time to the next row, as a drive holds it.
    """
    rng = np.random.default_rng([seed, 2])
    wanted = MIDDLE + motion(rng, half, BOUNDS)
    speed = np.gradient(wanted, TICK, axis=0)
    ahead = _feedforward(wanted, speed)
    model = mujoco.MjModel.from_xml_string(mjcf(arm))
    data = mujoco.MjData(model)
    data.qpos[:] = wanted[0]
    q, tau = np.empty_like(wanted), np.empty_like(wanted)
    stiff, damp = np.array([4000.0, 4000.0, 1200.0]), np.array([130.0, 130.0, 40.0])
    last, slow = np.round(wanted[0] / COUNT) * COUNT, np.zeros(3)
    for k in range(len(wanted)):
        seen = np.round(data.qpos / COUNT) * COUNT
        slow += 0.4 * ((seen - last) / TICK - slow)  # low-pass near 80 Hz
        last = seen
        data.ctrl[:] = ahead[k] + stiff * (wanted[k] - seen) + damp * (speed[k] - slow)
        force = 0.0
        for _ in range(STEPS):
            mujoco.mj_step(model, data)
            force = force + data.actuator_force
        q[k], tau[k] = seen, force / STEPS
    tau += NOISE * np.sqrt(np.mean(tau**2, axis=0)) * rng.standard_normal(tau.shape)
    columns = {"time": TICK * np.arange(len(q))}
    columns |= {f"q{j}": q[:, j - 1] for j in ROWS}
    return columns | {f"tau{j}": tau[:, j - 1] for j in ROWS}


def _feedforward(wanted: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """(n, 3) torques of an average arm: what a maker would have programmed, not this arm."""
    model = mujoco.MjModel.from_xml_string(mjcf(random_arm(0)))
    model.dof_frictionloss[:] = 0.0
    data = mujoco.MjData(model)
    actual = np.empty_like(wanted)
    lift = np.gradient(speed, TICK, axis=0)
    for k in range(len(wanted)):
        data.qpos[:], data.qvel[:], data.qacc[:] = wanted[k], speed[k], lift[k]
        mujoco.mj_inverse(model, data)
        actual[k] = data.qfrc_inverse
    return actual
