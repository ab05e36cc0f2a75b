"""An arm whose file states its links, for tests of what is known beforehand."""

import numpy as np

from modeler.api import compile_model, derive, generate
from modeler.robot import parse_robot_text
from modeler.runtime import CompiledModel
from tests.bodies import ten_of_points

TABLE = """name = "stated"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "alpha", "d", "theta"]
rows = [["1", 0, 0, "q1"], ["2", "pi/2", 0.2, "q2"], ["3", 0, 0.6, "q3"]]
[effects]
viscous = "all"
coulomb = "all"
[limits]
1 = [-2.5, 2.5, 2, 8]
2 = [-1.2, 1.2, 2, 8]
3 = [-1.5, 1.5, 3, 12]
"""


def links(seed: int = 1) -> dict[str, float]:
    """Inertial parameters of three clouds of points, stretched along x as links are."""
    rng = np.random.default_rng(seed)
    values = {}
    for joint, mass, length in (("1", 40.0, 0.3), ("2", 25.0, 0.6), ("3", 12.0, 0.5)):
        places = rng.normal(size=(30, 3)) * [0.3, 0.12, 0.12] * length
        places[:, 0] += 0.5 * length
        body = ten_of_points(np.full(30, mass / 30), places)
        values |= {prefix + joint: value for prefix, value in body.items()}
    return values


def text(values, uncertainty=None, held=()):
    """The robot file."""
    lines = [TABLE, "[parameters]", *(f"{name} = {float(x)!r}" for name, x in values.items())]
    lines += [f"held = {list(held)!r}"] if held else []
    if uncertainty:
        lines += ["[parameters.uncertainty]"]
        lines += [f"{name} = {float(x)!r}" for name, x in uncertainty.items()]
    return "\n".join(lines) + "\n"


def compiled(robot: str) -> CompiledModel:
    """Its C."""
    return compile_model(generate(derive(parse_robot_text(robot, "stated.toml"))))


def drawn(share: float, rng: np.random.Generator, values: dict[str, float]) -> dict[str, float]:
    """Links that lie about the stated ones: m, c and I drawn, then moved to the joint's origin."""
    link_values = dict(values)
    for joint in "123":
        I, first, mass = moments(values, joint)
        centre = first / mass
        about = I - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        spread = np.trace(about)
        metre = max(np.linalg.norm(centre), (spread / mass) ** 0.5)
        noise = share * spread / 2.0 * np.triu(rng.normal(size=(3, 3)))
        about = about + noise + np.triu(noise, 1).T
        c = centre + share * metre * rng.normal(size=3)
        m = mass * (1.0 + share * rng.normal())
        moved = about + m * (c @ c * np.eye(3) - np.outer(c, c))
        ten = [*moved[np.triu_indices(3)], *(m * c), m]
        names = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
        link_values |= {f"{prefix}{joint}": float(x) for prefix, x in zip(names, ten, strict=True)}
    return link_values


def buildable(share: float, rng: np.random.Generator, values: dict[str, float]) -> dict[str, float]:
    """The first drawn links that could be built."""
    while True:
        candidate = drawn(share, rng, values)
        second = []
        for joint in "123":
            I, first, mass = moments(candidate, joint)
            second.append(np.trace(I) / 2.0 * np.eye(3) - I - np.outer(first, first) / mass)
        if min(np.linalg.eigvalsh(inertia)[0] for inertia in second) > 0.0:
            return candidate


def moments(values: dict[str, float], joint: str) -> tuple[np.ndarray, np.ndarray, float]:
    """Inertia about the origin, first moments, mass."""
    xx, xy, xz, yy, yz, zz, *first, mass = (
        values[f"{p}{joint}"] for p in ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
    )
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), np.array(first), mass
