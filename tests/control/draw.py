"""Robots drawn at random, and their states: chains and trees of turning and sliding joints."""

from functools import cache

import numpy as np

from modeler.api.workflow import load
from modeler.codegen import Control, derive, generate
from modeler.robot import Robot, parse_robot_text


def drawn(seed: int, tree: bool = False) -> Robot:
    """Three to six joints, some of which slide, count backwards or follow others."""
    rng = np.random.default_rng([31, seed])
    n, rows, carriers = int(rng.integers(3, 7)), [], ["0"]
    tied = tree and seed % 2
    for j in range(1, n + 1):
        slides, sign = rng.random() < 0.3, rng.choice(["", "-"])
        before = str(rng.choice(carriers[-3:])) if tree else str(j - 1)
        variable, number = f"{sign}q{j} + {rng.normal():.3f}", f"{rng.normal():.3f}"
        turn, along = ("pi/2", f"{rng.uniform(-3, 3):.3f}", 0), rng.normal(0, 0.3, 2).round(3)
        alpha, gamma = rng.choice(np.array(turn, dtype=object), 2)
        last = (number, variable) if slides else (variable, number)
        frame = (gamma, along[0], alpha, along[1])
        cells = [str(j), before, int(j < n or not tied), int(slides), *frame, *last]
        rows.append(
            "["
            + ", ".join(f'"{cell}"' if isinstance(cell, str) else str(cell) for cell in cells)
            + "]"
        )
        carriers.append(str(j))
    relation = f'[relations]\nq{n} = "q1/2 - q2"\n' if tied else ""
    return parse_robot_text(
        f"""name = "drawn-{seed}"
gravity = [1.2, -3.1, -9.0]
[mdh]
columns = ["j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]
rows = [{", ".join(rows)}]
{relation}[effects]
viscous = "all"
coulomb = "all"
rotor_inertia = "all"
offset = "all"
[tool]
row = "{n}"
x = 0.1
z = "0.3"
roll = 0.4
pitch = -0.7
yaw = 1.1
""",
        "drawn.toml",
    )


@cache
def emitted(robot, tree=False, single=False):
    """A built-in robot by its name, a drawn one by its seed, with the unit for controllers."""
    result = load(robot) if isinstance(robot, str) else drawn(robot, tree)
    names = (result.joints[0].name,)
    precision = "single" if single else "double"
    return result, generate(derive(result), control=Control(names), precision=precision)
