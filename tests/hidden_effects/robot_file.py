"""The robot file of an arm: its table, its gravity and the effects that it admits; no inertias."""

from collections.abc import Mapping, Sequence

import numpy as np

from tests.hidden_effects.plant import Plant
from tests.hidden_effects.robots import UP, G


def robot_text(name: str, plant: Plant, effects: Mapping[str, Sequence[int]]) -> str:
    """TOML; effects: indices of joints by name."""
    lengths: dict[str, float] = {}
    rows = []
    for j in range(plant.joints):
        cells = [f'"{j + 1}"', f'"{j}"', "1", "0", _angle(plant.alpha[j])]
        cells.append(_length(f"D{j + 1}", plant.d[j], lengths))
        cells.append(f'"q{j + 1}{_shift(plant.theta0[j])}"')
        cells.append(_length(f"RL{j + 1}", plant.r[j], lengths))
        rows.append(f"  [{', '.join(cells)}],")
    lines = [f'name = "{name}"', f'title = "random arm with {plant.joints} joints"']
    lines += [f"gravity = [{', '.join(_gravity(x) for x in plant.gravity)}]", ""]
    lines += ["[symbols]", f"g = {G}", *(f"{k} = {v!r}" for k, v in lengths.items()), "", "[mdh]"]
    lines += ['columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]', "rows = ["]
    lines += [*rows, "]", "", "[effects]"]
    for effect, joints in effects.items():
        if len(joints) == plant.joints:
            lines.append(f'{effect} = "all"')
        elif joints:
            named = ", ".join(f'"{j + 1}"' for j in joints)
            lines.append(f"{effect} = [{named}]")
    return "\n".join(lines) + "\n"


def _right(x: float) -> bool:
    return abs(abs(x) - UP) < 1e-9


def _angle(x: float) -> str:
    if _right(x):
        return '"pi/2"' if x > 0 else '"-pi/2"'
    return "0" if abs(x) < 1e-12 else repr(float(x))


def _shift(x: float) -> str:
    if abs(x) < 1e-12:
        return ""
    size = "pi/2" if _right(x) else repr(abs(float(x)))
    return f" {'+' if x > 0 else '-'} {size}"


def _length(symbol: str, value: float, lengths: dict[str, float]) -> str:
    """A symbol for a length that is not zero."""
    if value == 0:
        return "0"
    lengths[symbol] = float(value)
    return f'"{symbol}"'


def _gravity(x: float) -> str:
    if abs(x) < 1e-12:
        return "0"
    if np.isclose(abs(x), G, rtol=0, atol=1e-9):
        return '"g"' if x > 0 else '"-g"'
    return repr(float(x))
