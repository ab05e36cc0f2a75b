"""The papers' mechanisms by other means: frames in floats, speeds by complex steps.

A column of a standard parameter is its row of 2T and of dU/dt, of Rayleigh's function and of |qd|
at random states: a combination of parameters is without effect if that of their columns is 0.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import NamedTuple

import numpy as np

STEP = 1e-30
INERTIA = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
A, D4, D6, B3, B7 = 0.6, 0.31, 0.1, -0.04, 0.04


class Frame(NamedTuple):
    turn: np.ndarray
    place: np.ndarray

    def then(self, gamma, b, alpha, d, theta, r):
        """The next frame by the table's row: Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r)."""
        base = about_z(gamma)
        turn = base @ about_x(alpha) @ about_z(theta)
        shift = base @ np.array([d, 0, 0]) + np.array([0, 0, b]) + turn @ np.array([0, 0, r])
        return Frame(self.turn @ turn, self.place + self.turn @ shift)


GROUND = Frame(np.eye(3), np.zeros(3))


def about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def about_x(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def about_y(angle):
    return np.roll(about_x(angle), (1, 1), (0, 1))


class Posture(NamedTuple):
    bodies: Mapping[str, Frame]
    joints: Mapping[str, complex]


def orthoglide_leg(at, end, leg, sign=-1.0):
    """Rows 1 to 5 of a leg whose frame 5 ends at `end`; `sign` is that of a in r13 = q13 +- a."""
    first = {
        "1": (0, 0, 0, 0, 0),
        "2": (np.pi / 2, A, np.pi / 2, 0, 0),
        "3": (0, A, -np.pi / 2, 0, -np.pi / 2),
    }[leg]
    x, y, z = {"1": end, "2": end[[1, 2, 0]] - [0, A, -A], "3": end[[2, 0, 1]] - [A, 0, -A]}[leg]
    q3 = -np.arcsin(y / D4)
    q2 = -np.arccos(x / (D4 * np.cos(q3)))
    q1 = z + D4 * np.sin(q2) * np.cos(q3) - D6
    slide = q1 + {"1": 0, "2": -A, "3": sign * A}[leg]
    return at.then(*first, slide), (q1, q2, q3)


def rows_2012(first, q2, q3, leg):
    table = {f"1{leg}": first}
    table[f"2{leg}"] = first.then(0, 0, -np.pi / 2, 0, q2, 0)
    table[f"3{leg}"] = table[f"2{leg}"].then(0, 0, -np.pi / 2, 0, q3, 0)
    table[f"4{leg}"] = table[f"3{leg}"].then(0, 0, 0, D4, -q3, 0)
    table[f"5{leg}"] = table[f"4{leg}"].then(0, 0, np.pi / 2, 0, -q2, 0)
    return table


def orthoglide_2012(u):
    bodies, joints = {"6": Frame(np.eye(3), u)}, {}
    for leg in "123":
        first, (q1, q2, q3) = orthoglide_leg(GROUND, u, leg)
        bodies |= rows_2012(first, q2, q3, leg)
        for k, q in zip("12345", (q1, q2, q3, -q3, -q2), strict=True):
            joints[f"{k}{leg}"] = q
    return Posture(bodies, joints)


def rows_2003(first, q2, q3, leg):
    table = {f"1{leg}": first}
    table[f"2{leg}"] = first.then(0, 0, -np.pi / 2, 0, q2, 0)
    table[f"3{leg}"] = table[f"2{leg}"].then(0, B3, -np.pi / 2, 0, q3, 0)
    table[f"4{leg}"] = table[f"3{leg}"].then(0, 0, 0, D4, -q3, 0)
    table[f"7{leg}"] = table[f"2{leg}"].then(0, B7, -np.pi / 2, 0, q3, 0)
    return table


def orthoglide_2003(u):
    bodies, joints = {"P": Frame(np.eye(3), u)}, {}
    for leg in "123":
        first, (q1, q2, q3) = orthoglide_leg(GROUND, u, leg)
        bodies |= rows_2003(first, q2, q3, leg)
        joints[f"1{leg}"] = q1
    return Posture(bodies, joints)


def leg_2003(u):
    first = GROUND.then(0, 0, 0, 0, 0, u[0])
    return Posture(rows_2003(first, u[1] - np.pi / 2, u[2], ""), {"1": u[0]})


EVRA = {
    "beta": (0.1745, 1.9199, 2.2689, 4.0143, 4.3633, 6.1087),
    "phi": (0.8727, 1.2217, 2.9671, 3.3161, 5.0615, 5.4105),
    "RB": 0.6,
    "RP": 0.35,
}


def evra(u):
    s1 = GROUND.then(np.pi / 2, 0, np.pi / 2, 0, 0, u[0])
    s2 = s1.then(np.pi / 2, 0, np.pi / 2, 0, 0, u[1])
    floor = s2.then(np.pi / 2, 0, np.pi / 2, 0, 0, 0)
    turn = about_z(u[5]) @ about_x(u[6]) @ about_z(u[7])
    platform = Frame(turn, floor.place + np.array([u[2], u[3], u[4] + 0.7]))
    bodies = {"s1": s1, "s2": s2, "P": platform}
    joints = {"s1": u[0], "s2": u[1]}
    for k in range(6):
        base = floor.then(EVRA["beta"][k], 0, 0, EVRA["RB"], 0, 0)
        phi = EVRA["phi"][k]
        point = platform.place + turn @ np.array([np.cos(phi), np.sin(phi), 0]) * EVRA["RP"]
        x, y, z = base.turn.T @ (point - base.place)
        length = np.sqrt(x * x + y * y + z * z)
        q2 = np.arcsin(y / length)
        q1 = np.pi - np.arcsin(-x / (length * np.cos(q2)))
        leg = str(k + 1)
        bodies[f"1{leg}"] = base.then(0, 0, -np.pi / 2, 0, q1 + np.pi / 2, 0)
        bodies[f"2{leg}"] = bodies[f"1{leg}"].then(0, 0, np.pi / 2, 0, q2 + np.pi / 2, 0)
        bodies[f"3{leg}"] = bodies[f"2{leg}"].then(0, 0, np.pi / 2, 0, 0, length)
        assert np.allclose(bodies[f"3{leg}"].place, point)
        joints[f"3{leg}"] = length
    return Posture(bodies, joints)


class Robot(NamedTuple):
    posture: Callable
    gravity: tuple
    low: tuple
    high: tuple
    lone: tuple = ()
    """Bodies of which only the mass counts."""
    rotors: bool = False
    """Every joint has Ia, Fv, Fs; offsets where the flag `offsets` says so."""
    offsets: bool = False


ORTHOGLIDE = ((-0.08, -0.08, 0.52), (0.08, 0.08, 0.68))
ROBOTS = {
    "orthoglide-2012": Robot(orthoglide_2012, (0, 9.81, 0), *ORTHOGLIDE, ("6",), True),
    "orthoglide-2003": Robot(orthoglide_2003, (0, 9.81, 0), *ORTHOGLIDE, ("P",), True, True),
    "orthoglide-leg": Robot(leg_2003, (0, 9.81, 0), (-0.3,) * 3, (0.3,) * 3, (), True),
    "evra": Robot(evra, (0, 0, -9.81), (-0.05,) * 8, (0.05,) * 8),
}


def moving(function, u, speed):
    """Values and speeds of a nested dict of complex arrays along u + t speed."""
    return function(u + 1j * STEP * speed)


def rigid(frame):
    """(w, v in the frame; speeds of its axes and of its origin in frame 0)."""
    turn, rate = frame.turn.real, frame.turn.imag / STEP
    spin = turn.T @ rate
    w = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
    return w, turn.T @ frame.place.imag / STEP, rate, frame.place.imag / STEP


def kinetic(w, v):
    """Twice what the ten parameters are multiplied with in the kinetic energy, from points.

    Ten sets of point masses, each with its energy sum m |v + w x r|^2, give the ten factors.
    """
    return np.linalg.solve(PARAMETERS, POINTS_AS_PARAMETERS @ point_energies(w, v))


def point_energies(w, v):
    return np.array([np.sum((v + np.cross(w, r)) ** 2) for r in POINTS])


POINTS = np.random.default_rng(3).normal(0, 1, (12, 3))


def parameters_of(r):
    x, y, z = r
    second = (y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y)
    return np.array([*second, x, y, z, 1.0])


POINTS_AS_PARAMETERS = np.array([parameters_of(r) for r in POINTS]).T
PARAMETERS = POINTS_AS_PARAMETERS @ POINTS_AS_PARAMETERS.T


@cache
def columns(name, samples=70, seed=5):
    """{standard parameter: its column}."""
    robot, rng = ROBOTS[name], np.random.default_rng(seed)
    gravity = np.array(robot.gravity)
    table = {}
    for _ in range(samples):
        u = rng.uniform(robot.low, robot.high)
        posture = moving(robot.posture, u, rng.normal(0, 1, u.size))
        row = {}
        for body, frame in posture.bodies.items():
            w, v, rate, speed = rigid(frame)
            twice = kinetic(w, v)
            power = np.concatenate([np.zeros(6), -gravity @ rate, [-gravity @ speed]])
            for k, prefix in enumerate(INERTIA):
                if body not in robot.lone or prefix == "M":
                    row[f"{prefix}{body}"] = (twice[k], power[k], 0.0, 0.0)
        for joint, q in posture.joints.items() if robot.rotors else ():
            qd = q.imag / STEP
            row[f"Ia{joint}"] = (qd**2, 0.0, 0.0, 0.0)
            row[f"Fv{joint}"] = (0.0, 0.0, qd**2, 0.0)
            row[f"Fs{joint}"] = (0.0, 0.0, 0.0, abs(qd))
            if robot.offsets:
                row[f"Off{joint}"] = (0.0, qd, 0.0, 0.0)
        for parameter, values in row.items():
            table.setdefault(parameter, []).extend(values)
    return {parameter: np.array(values) for parameter, values in table.items()}


def rank(vectors):
    matrix = np.array(vectors).T
    sizes = np.linalg.norm(matrix, axis=0)
    stored = matrix[:, sizes > 1e-9] / sizes[sizes > 1e-9]
    values = np.linalg.svd(stored, compute_uv=False)
    count = int(np.sum(values > 1e-8 * values[0]))
    assert count == len(values) or values[count] < 1e-3 * values[count - 1]
    return count


def within(vector, others):
    """True if a column is a combination of others."""
    matrix = np.array(others).T
    rest = vector - matrix @ np.linalg.lstsq(matrix, vector, rcond=None)[0]
    return bool(np.linalg.norm(rest) < 1e-7 * max(np.linalg.norm(vector), 1e-9))


def grouping(name, stored):
    """{standard parameter: {kept parameter: how much of it is grouped there}}."""
    values, order = columns(name), sorted(stored)
    basis = np.array([values[parameter] for parameter in order]).T
    scale = np.linalg.norm(basis, axis=0)
    assert rank([values[parameter] for parameter in order]) == len(order)
    every = np.array(list(values.values())).T
    factors = np.linalg.lstsq(basis / scale, every, rcond=None)[0] / scale[:, None]
    assert np.allclose(basis @ factors, every, atol=1e-6 * np.abs(every).max())
    return {p: dict(zip(order, factors[:, i], strict=True)) for i, p in enumerate(values)}
