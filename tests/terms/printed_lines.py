"""The printed lines of a sheet are run as they stand, and put together by their own definition."""

from collections.abc import Mapping, Sequence
from functools import cache
from math import cos, pi, sin, sqrt
from pathlib import Path

import numpy as np

from modeler.api import compile_model, derive, generate, load
from modeler.compiled import CompiledModel
from modeler.derivation import Derivation
from modeler.robot import robot_from_text
from modeler.terms.closed_form import function_name
from tests.terms.cases import TEXTS, TIED

SAMPLES = 5
FUNCTIONS = {"sin": sin, "cos": cos, "sqrt": sqrt, "pi": pi, "sign": np.sign, "abs": abs}


@cache
def derived(name: str | Path) -> Derivation:
    """A robot of `cases`, or built in, or of a file."""
    text = {**TEXTS, **TIED}.get(str(name))
    return derive(robot_from_text(text, str(name)) if text else load(name))


@cache
def compiled(name: str | Path) -> CompiledModel:
    return compile_model(generate(derived(name)))


def run_lines(lines: Sequence[str], values: Mapping[str, float]) -> dict[str, float]:
    """Every name that the lines define."""
    found = dict(values)
    exec("\n".join(lines), dict(FUNCTIONS), found)
    return found


def known(
    derivation: Derivation,
    u: Sequence[float],
    ud: Sequence[float] = (),
    udd: Sequence[float] = (),
    beta: Sequence[float] = (),
) -> dict[str, float]:
    """What the lines read: lengths, base parameters, positions and speeds of the free joints."""
    values = dict(derivation.model.geometry.values)
    names = [joint.name for joint in derivation.model.robot.free]
    for kind, numbers in (("q", u), ("qd", ud), ("qdd", udd)):
        values |= {f"{kind}{n}": float(x) for n, x in zip(names, numbers, strict=len(numbers) > 0)}
    bases = [parameter.name for parameter in derivation.base.parameters]
    return values | {n: float(x) for n, x in zip(bases, beta, strict=len(beta) > 0)}


def torque(
    found: Mapping[str, float], names: Sequence[str], ud: np.ndarray, udd: np.ndarray, chain: bool
) -> np.ndarray:
    """t_i = sum J_ij udd_j + sum_{j<=k} S_ijk ud_j ud_k + g_i.

    Args:
        found: what the lines define; what is missing is 0.
        names: of the free joints.
        ud: their speeds.
        udd: their accelerations.
        chain: S_kij = -S_jik and S_kii = -S_iik / 2 for i <= j <= k are not listed.
    """

    def value(letter: str, *at: int) -> float:
        return found.get(function_name(letter, [names[i] for i in at]), 0.0)

    def christoffel(i: int, j: int, k: int) -> float:
        if not chain or i <= k:
            return value("S", i, j, k)
        return -value("S", j, j, i) / 2 if j == k else -value("S", k, j, i)

    tau = np.zeros(len(names))
    for i in range(len(names)):
        tau[i] = value("g", i)
        for j in range(len(names)):
            tau[i] += value("J", min(i, j), max(i, j)) * udd[j]
            tau[i] += sum(
                christoffel(i, j, k) * ud[j] * ud[k] for k in range(j, len(names))
            )  # fmt: skip
    return tau
