"""The printed lines of a sheet are run as they stand, and put together by their own definition."""

from collections.abc import Mapping, Sequence
from functools import cache
from math import cos, pi, sin, sqrt
from pathlib import Path

import numpy as np

from modeler.api import derive, generate, load
from modeler.codegen.workflow import Derivation
from modeler.formulas.short_form import format_function_name
from modeler.runtime.model import CompiledModel
from tests import modules
from tests.robots import ROBOTS
from tests.terms.cases import base_of, model_of

FUNCTIONS = {"sin": sin, "cos": cos, "sqrt": sqrt, "pi": pi, "sign": np.sign, "abs": abs}


@cache
def derived(name: str | Path) -> Derivation:
    """A robot of `cases`, or built in, or of a file."""
    if isinstance(name, Path):
        return derive(load(name))
    return Derivation(model_of(name).robot, model_of(name), base_of(name))


@cache
def compiled(name: str | Path) -> CompiledModel:
    if name in ROBOTS:
        return modules.plain(str(name))
    return modules.loaded(generate(derived(name)))


def run_lines(lines: Sequence[str], values: Mapping[str, float]) -> dict[str, float]:
    """Every name that the lines define."""
    table = dict(values)
    exec("\n".join(lines), dict(FUNCTIONS), table)
    return table


def known(derivation, u, ud=(), udd=(), beta=()):
    """What the lines read: lengths, base parameters, positions and speeds of the free joints."""
    values = dict(derivation.model.geometry.values)
    names = [joint.name for joint in derivation.model.robot.free_joints]
    for kind, numbers in (("q", u), ("qd", ud), ("qdd", udd)):
        values |= {f"{kind}{n}": float(x) for n, x in zip(names, numbers, strict=len(numbers) > 0)}
    bases = [parameter.name for parameter in derivation.base.parameters]
    return values | {n: float(x) for n, x in zip(bases, beta, strict=len(beta) > 0)}


def torque(found, names, ud, udd, chain):
    """t_i = sum J_ij udd_j + sum_{j<=k} S_ijk ud_j ud_k + g_i + e_i.

    Args:
        found: what the lines define; what is missing is 0.
        names: of the free joints.
        ud: their speeds.
        udd: their accelerations.
        chain: S_kij = -S_jik and S_kii = -S_iik / 2 for i <= j <= k are not listed.
    """

    def value(letter: str, *at: int) -> float:
        return found.get(format_function_name(letter, [names[i] for i in at]), 0.0)

    def christoffel(i: int, j: int, k: int) -> float:
        if not chain or i <= k:
            return value("S", i, j, k)
        return -value("S", j, j, i) / 2 if j == k else -value("S", k, j, i)

    tau = np.zeros(len(names))
    for i in range(len(names)):
        tau[i] = value("g", i) + found.get(f"e{names[i]}", 0.0)
        for j in range(len(names)):
            tau[i] += value("J", min(i, j), max(i, j)) * udd[j]
            tau[i] += sum(christoffel(i, j, k) * ud[j] * ud[k] for k in range(j, len(names)))
    return tau


def printed_coupling(derivation, found):
    """J_t and b of u' = J_t q', u'' = J_t q'' + b, as the words above the lines say."""
    closure, names = derivation.model.closure, [j.name for j in derivation.model.robot.free_joints]
    assert closure is not None
    inputs, solved, count = list(closure.actuated), list(closure.solved), len(names)

    def matrix(letter: str, rows: Sequence[str], columns: Sequence[int]) -> np.ndarray:
        entries = [found.get(f"{letter}{r}_{names[k]}", 0.0) for r in rows for k in columns]
        return np.reshape(entries, (len(rows), len(columns)))

    J, b = np.zeros((count, len(inputs))), np.array([found.get(f"b{n}", 0.0) for n in names])
    platform = list(closure.platform or ())
    if any(name.startswith("Jt") for name in found):
        J[solved] = matrix("Jt", [names[u] for u in solved], inputs)
        rows = [p for p in platform if p in solved]
        J[rows] = matrix("Jp", [names[p] for p in rows], inputs)
        J[inputs] = np.eye(len(inputs))
        return J, b
    numbers = [str(r + 1) for r in range(len(closure.equations))]
    F = matrix("F", numbers, range(count))
    h = np.array([found.get(f"h{r}", 0.0) for r in numbers])
    b[solved] = np.linalg.solve(F[:, solved], -h)
    J[inputs], J[solved] = np.eye(len(inputs)), -np.linalg.solve(F[:, solved], F[:, inputs])
    return J, b
