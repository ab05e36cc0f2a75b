"""Arms made up for these tests: as a URDF, as an MJCF, and as MuJoCo moves them."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.signal import savgol_filter
from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Link:
    """A body, and the joint that moves it; SI units."""

    joint: str
    xyz: tuple[float, float, float]
    rpy: tuple[float, float, float]
    axis: tuple[float, float, float]
    mass: float
    centre: tuple[float, float, float]
    inertia: tuple[float, ...]  # xx yy zz xy xz yz about the centre
    damping: float
    friction: float
    armature: float
    range: tuple[float, float]
    speed: float
    effort: float


def rod(mass: float, size: Sequence[float]) -> tuple[float, ...]:
    """Inertia of a box about its centre."""
    x, y, z = np.square(size) * mass / 12.0
    return (y + z, x + z, x + y, 0.0, 0.0, 0.0)


_HALF = np.pi / 2

ARM7 = (
    Link("base_yaw", (0, 0, 0.20), (0, 0, 0), (0, 0, 1), 4.2, (0.002, -0.03, 0.09),
         rod(4.2, (0.12, 0.14, 0.24)), 1.4, 1.8, 0.42, (-2.8, 2.8), 2.0, 120),
    Link("shoulder_pitch", (0, 0, 0.15), (0, 0, 0), (0, 1, 0), 3.9, (0.01, 0.04, 0.13),
         rod(3.9, (0.11, 0.13, 0.30)), 1.6, 2.1, 0.40, (-1.9, 1.9), 2.0, 120),
    Link("arm_roll", (0, 0, 0.26), (0, 0, 0), (0, 0, 1), 2.8, (0.015, 0.006, 0.07),
         rod(2.8, (0.10, 0.10, 0.22)), 0.9, 1.2, 0.28, (-2.8, 2.8), 2.2, 80),
    Link("elbow_pitch", (0.04, 0, 0.19), (0, 0, 0), (0, -1, 0), 2.5, (-0.02, 0.03, 0.10),
         rod(2.5, (0.09, 0.11, 0.24)), 0.8, 1.1, 0.26, (-0.1, 2.6), 2.2, 80),
    Link("wrist_roll", (-0.04, 0, 0.21), (0, 0, 0), (0, 0, 1), 1.6, (0.004, -0.01, 0.08),
         rod(1.6, (0.08, 0.08, 0.20)), 0.4, 0.6, 0.11, (-2.8, 2.8), 2.8, 40),
    Link("wrist_pitch", (0, 0, 0.18), (0, 0, 0), (0, 1, 0), 1.3, (0.01, 0.012, 0.03),
         rod(1.3, (0.08, 0.09, 0.10)), 0.35, 0.5, 0.10, (-1.8, 1.8), 2.8, 40),
    Link("flange_roll", (0.07, 0, 0.06), (0, _HALF, 0), (0, 0, 1), 0.7, (0.02, 0.008, 0.06),
         rod(0.7, (0.07, 0.06, 0.09)), 0.2, 0.3, 0.06, (-2.8, 2.8), 2.8, 25),
)  # fmt: skip
"""A 7R arm of the size that people work beside."""


def spoilt(links: Sequence[Link], seed: int, share: float = 0.3) -> tuple[Link, ...]:
    """Every mass, centre, inertia, damping, friction and armature wrong by up to that share."""
    draw = np.random.default_rng(seed)

    def wrong(value: float) -> float:
        return float(value) * (1.0 + draw.uniform(-share, share))

    values = []
    for link in links:
        stated = {k: wrong(getattr(link, k)) for k in ("mass", "damping", "friction", "armature")}
        ratio = wrong(1.0)  # one for all moments of a body: it could be built
        inertia = tuple(float(x) * ratio for x in link.inertia)
        centre = tuple(map(wrong, link.centre))
        values.append(dataclasses.replace(link, **stated, inertia=inertia, centre=centre))
    return tuple(values)


def _text(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)


def urdf(name: str, links: Sequence[Link]) -> str:
    """The arm as a URDF."""
    lines = ['<?xml version="1.0"?>', f'<robot name="{name}">', '  <link name="base"/>']
    parent = "base"
    for link in links:
        child = f"{link.joint}_link"
        xx, yy, zz, xy, xz, yz = link.inertia
        lines += [
            f'  <link name="{child}">',
            "    <inertial>",
            f'      <origin xyz="{_text(link.centre)}" rpy="0 0 0"/>',
            f'      <mass value="{link.mass:.9g}"/>',
            f'      <inertia ixx="{xx:.9g}" ixy="{xy:.9g}" ixz="{xz:.9g}" iyy="{yy:.9g}" '
            f'iyz="{yz:.9g}" izz="{zz:.9g}"/>',
            "    </inertial>",
            "  </link>",
            f'  <joint name="{link.joint}" type="revolute">',
            f'    <origin xyz="{_text(link.xyz)}" rpy="{_text(link.rpy)}"/>',
            f'    <parent link="{parent}"/>',
            f'    <child link="{child}"/>',
            f'    <axis xyz="{_text(link.axis)}"/>',
            f'    <limit lower="{link.range[0]:g}" upper="{link.range[1]:g}" '
            f'effort="{link.effort:g}" velocity="{link.speed:g}"/>',
            f'    <dynamics damping="{link.damping:.9g}" friction="{link.friction:.9g}"/>',
            "  </joint>",
        ]
        parent = child
    return "\n".join([*lines, "</robot>", ""])


def mjcf(name: str, links: Sequence[Link], step: float = 0.0005) -> str:
    """The arm as an MJCF: motors on all joints."""
    head = [
        f'<mujoco model="{name}">',
        f'  <option timestep="{step:g}" integrator="implicitfast" gravity="0 0 -9.81"/>',
        "  <!-- a comment that stays -->",
        "  <worldbody>",
    ]
    body, tail, pad = [], [], "    "
    for link in links:
        w = Rotation.from_euler("xyz", link.rpy).as_quat()
        body += [
            f'{pad}<body name="{link.joint}_link" pos="{_text(link.xyz)}" '
            f'quat="{_text([w[3], *w[:3]])}">',
            f'{pad}  <inertial pos="{_text(link.centre)}" mass="{link.mass:.9g}" '
            f'fullinertia="{_text(link.inertia)}"/>',
            f'{pad}  <joint name="{link.joint}" type="hinge" axis="{_text(link.axis)}" '
            f'range="{_text(link.range)}" limited="false" damping="{link.damping:.9g}" '
            f'frictionloss="{link.friction:.9g}" armature="{link.armature:.9g}"/>',
        ]
        tail.insert(0, f"{pad}</body>")
        pad += "  "
    motors = [f'    <motor name="{link.joint}" joint="{link.joint}"/>' for link in links]
    close = ["  </worldbody>", "  <actuator>", *motors, "  </actuator>", "</mujoco>", ""]
    return "\n".join([*head, *body, *tail, *close])


def logged(truth, believed, links, seed, seconds, rate=1000.0):
    """A log of an MJCF under computed torques of another, on a sum of sines within its ranges.

    Torques are held between the rows, as a drive holds them. By joints' names in any order:
    positions in counts of 18 bits, torques with noise of a hundredth of their rms.
    """
    import mujoco

    plant, model = mujoco.MjModel.from_xml_string(truth), mujoco.MjModel.from_xml_string(believed)
    data, guess = mujoco.MjData(plant), mujoco.MjData(model)
    time = np.arange(int(seconds * rate)) / rate
    asked = sines(links, seed, time)
    every = round(1.0 / rate / plant.opt.timestep)
    data.qpos[:], data.qvel[:] = asked[0, 0], asked[1, 0]
    q, tau = (np.zeros((len(time), len(links))) for _ in range(2))
    stiff, damp = 18.0**2, 2 * 0.9 * 18.0
    mass = np.zeros((plant.nv, plant.nv))
    limits = np.array([link.effort for link in links])
    for k in range(len(time)):
        q[k] = data.qpos
        guess.qpos[:], guess.qvel[:] = data.qpos, data.qvel
        mujoco.mj_forward(model, guess)
        mujoco.mj_fullM(model, guess, mass)
        wanted = asked[2, k] + damp * (asked[1, k] - data.qvel) + stiff * (asked[0, k] - data.qpos)
        sign = np.tanh(asked[1, k] / 0.05)
        friction = model.dof_damping * data.qvel + model.dof_frictionloss * sign
        tau[k] = np.clip(mass @ wanted + guess.qfrc_bias + friction, -limits, limits)
        data.ctrl[:] = tau[k]
        mujoco.mj_step(plant, data, every)
    draw, step = np.random.default_rng(seed), 2 * np.pi / 2**18
    tau += 0.01 * np.sqrt(np.mean(tau**2, axis=0)) * draw.normal(size=tau.shape)
    columns = {"time": time}
    for j in draw.permutation(len(links)):  # a recorder knows no order
        columns[f"{links[j].joint}_position"] = np.round(q[:, j] / step) * step
        columns[f"{links[j].joint}_effort"] = tau[:, j]
    return columns


def sines(links: Sequence[Link], seed: int, time: np.ndarray) -> np.ndarray:
    """(3, n, joints) positions, speeds, accelerations of sums of five sines, within the ranges."""
    draw = np.random.default_rng(seed)
    actual = np.zeros((3, len(time), len(links)))
    for j, link in enumerate(links):
        frequencies = 2 * np.pi * (0.08 * np.arange(1, 6) + draw.uniform(0.0, 0.03, 5))
        weights = draw.normal(size=5) / np.arange(1, 6) ** 0.5
        phases = draw.uniform(0, 2 * np.pi, 5)
        turn = frequencies * time[:, None] + phases
        value = np.stack(
            [
                np.sin(turn) @ weights,
                np.cos(turn) @ (weights * frequencies),
                -np.sin(turn) @ (weights * frequencies**2),
            ]
        )
        low, high = link.range
        room = 0.45 * (high - low) / np.ptp(value[0])
        fast = 0.8 * link.speed / np.abs(value[1]).max()
        value *= min(2 * room, fast)
        value[0] += 0.5 * (low + high) - 0.5 * (value[0].max() + value[0].min())
        actual[:, :, j] = value
    return actual


def followed(xml, links, log, seconds=1.0):
    """(windows, joints) rms distance of positions, each window from the logged state on.

    MuJoCo runs the file under the logged torques.
    """
    import mujoco

    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    q, tau = (
        np.column_stack([log[f"{link.joint}_{kind}"] for link in links])
        for kind in ("position", "effort")
    )
    step = float(np.median(np.diff(log["time"])))
    every, length = round(step / model.opt.timestep), round(seconds / step)
    qd = savgol_filter(q, 21, 3, deriv=1, delta=step, axis=0)
    values = []
    for first in range(length // 2, len(q) - length, length):
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = q[first], qd[first]
        errors = np.zeros((length, q.shape[1]))
        for k in range(length):
            data.ctrl[:] = tau[first + k]
            mujoco.mj_step(model, data, every)
            errors[k] = data.qpos - q[first + k + 1]
        values.append(np.sqrt(np.mean(errors**2, axis=0)))
    return np.array(values)
