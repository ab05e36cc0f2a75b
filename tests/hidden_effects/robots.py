"""Random arms: the table of their frames, and links that bodies can have."""

import numpy as np

from tests.hidden_effects.plant import Plant

KINDS = ("3R", "2R", "4R", "6R")
SHARES = (0.68, 0.10, 0.12, 0.10)
FORMS_3R = ("elbow", "wrist", "elbow_offset", "skew")
G = 9.81  # m/s2
UP = np.pi / 2

Rows = tuple[list[float], list[float], list[float], list[float]]  # alpha, d, r, theta0


def draw_arm(rng: np.random.Generator, kind: str | None = None) -> tuple[Plant, str]:
    """An arm without friction, motors and sensors, and its kind."""
    kind = kind or str(rng.choice(KINDS, p=SHARES))
    gravity = [0.0, 0.0, -G]
    if kind == "2R":
        gravity = [0, -G, 0] if rng.uniform() < 0.5 else [-G, 0, 0]
        rows: Rows = ([0, 0], [0, rng.uniform(0.25, 0.6)], [0, 0], [0, 0])
    elif kind == "3R":
        rows, gravity = _three_joints(rng)
    elif kind == "4R":
        d = [0, 0, rng.uniform(0.35, 0.6), rng.uniform(0, 0.1)]
        rows = ([0, UP, 0, UP], d, [0, 0, 0, rng.uniform(0.3, 0.5)], [0, 0, UP, 0])
    else:
        d = [0, 0, rng.uniform(0.35, 0.6), rng.uniform(0, 0.1), 0, 0]
        rows = ([0, UP, 0, -UP, UP, -UP], d, [0, 0, 0, rng.uniform(0.35, 0.5), 0, 0], [0.0] * 6)
    plant = Plant(len(rows[0]))
    plant.alpha, plant.d, plant.r, plant.theta0 = (_as_written(row) for row in rows)
    plant.gravity = np.round(gravity, 9)
    _draw_links(plant, rows, rng)
    return plant, kind


def _three_joints(rng: np.random.Generator) -> tuple[Rows, list[float]]:
    """An elbow, a wrist or axes at any angle; upright, on a wall, or on a slope."""
    u = rng.uniform
    form = rng.choice(FORMS_3R, p=[0.55, 0.2, 0.15, 0.10])
    side = 1 if u() < 0.5 else -1
    theta0 = [0.0, 0.0, 0.0]
    if form == "elbow":
        alpha, d, r = [0, side * UP, 0], [0, 0, u(0.3, 0.7)], [0.0, 0.0, 0.0]
    elif form == "elbow_offset":
        alpha, d = [0, side * UP, 0], [0, u(0.05, 0.25), u(0.3, 0.7)]
        r = [u(0.2, 0.5), u(-0.1, 0.1), 0]
    elif form == "wrist":
        alpha, d, theta0 = [0, UP, -UP], [0, 0, 0], [UP, 0, 0]
        r = [u(0.1, 0.3), 0, u(0.1, 0.3)]
    else:
        alpha, d = [0, side * u(0.6, 1.2), u(-0.5, 0.5)], [0, u(0, 0.2), u(0.3, 0.6)]
        r = [0, u(-0.1, 0.1), 0]
    gravity = [0.0, 0.0, -G]
    if u() < 0.2:
        gravity = [0, -G, 0]
    elif u() < 0.12:
        gravity = [0, G * np.sin(0.5), -G * np.cos(0.5)]
    if form == "wrist" and gravity[1] == 0 and u() < 0.7:
        gravity = [0, -G, 0]
    if u() < 0.4:
        theta0 = [theta0[0], -UP, 0]
    return (alpha, d, r, theta0), gravity


def _as_written(row: list[float]) -> list[float]:
    """The numbers that a robot file holds: six decimals, or a right angle exactly."""
    return [x if abs(abs(x) - UP) < 1e-9 else round(float(x), 6) for x in row]


def _draw_links(plant: Plant, rows: Rows, rng: np.random.Generator) -> None:
    """Every link 14 points between its joint and the next: inertias are physical by themselves."""
    n = plant.joints
    first = np.exp(rng.uniform(np.log(4), np.log(50)))
    for j in range(n):
        mass = first * 0.62**j * rng.uniform(0.7, 1.4)
        if n == 6 and j >= 3:
            mass *= 0.5
        end = _far_end(rows, j, rng)
        points = rng.uniform(-0.1, 1.05, (14, 1)) * end
        width = (0.05 + 0.06 * np.linalg.norm(end)) * (0.6 if j > 2 else 1)
        points = points + rng.normal(size=(14, 3)) * width
        weights = rng.uniform(0.3, 1, 14)
        weights *= mass / weights.sum()
        centre = weights @ points / mass
        plant.mass[j], plant.centre[j] = mass, centre
        plant.inertia[j] = sum(
            point_inertia(w, x) for w, x in zip(weights, points - centre, strict=True)
        )


def _far_end(rows: Rows, j: int, rng: np.random.Generator) -> np.ndarray:
    """Where link j ends, in its frame: at the next joint, or at a tool."""
    alpha, d, r, _ = rows
    if j + 1 < len(alpha):
        sine, cosine = np.sin(alpha[j + 1]), np.cos(alpha[j + 1])
        end = np.array([d[j + 1], -r[j + 1] * sine, r[j + 1] * cosine])
        return end + rng.normal(size=3) * 0.12 if np.linalg.norm(end) < 0.1 else end
    if abs(r[j]) < 0.01 and len(alpha) < 6:
        return np.array([rng.uniform(0.15, 0.4), 0, rng.uniform(-0.1, 0.1)])
    return rng.normal(size=3) * 0.07 + [0, 0, 0.08]


def point_inertia(mass: float, place: np.ndarray) -> np.ndarray:
    """m (x'x 1 - x x'), row by row (9,)."""
    return (mass * ((place @ place) * np.eye(3) - np.outer(place, place))).ravel()
