"""The signature of an effect, drawn in characters: torque against what it depends on."""

import math
from collections.abc import Callable

from modeler.effects import Acts, Effect, Form

_WIDTH, _HEIGHT = 61, 13
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "exp": math.exp,
    "abs": abs, "sign": lambda x: (x > 0) - (x < 0), "tanh": math.tanh,
}  # fmt: skip
_AXES = {
    "v": "speed, in top speeds", "q": "position, half a turn each way", "a": "acceleration",
    "load": "load times direction of motion", "t": "time", "T": "temperature above its mean",
    "torque": "predicted torque", "z": "position, back and forth",
}  # fmt: skip


def signature_lines(effect: Effect) -> list[str]:
    """A picture of the first column, units left out; empty for effects that have none."""
    form = effect.forms[0]
    if effect.acts not in (Acts.JOINT, Acts.MOTOR, Acts.PASSIVE):
        return []
    order = ("T", "t", "load", "z", "q", "torque", "a", "v")
    axis = next((name for name in order if name in form.names), "v")
    points = 6 * _WIDTH
    x = [2.0 * k / (points - 1) - 1.0 for k in range(points)]
    y = [_torque(form, axis, at) for at in x]
    top = max(map(abs, y)) or 1.0
    grid = [[" "] * _WIDTH for _ in range(_HEIGHT)]
    grid[_HEIGHT // 2] = ["-"] * _WIDTH
    for row in grid:
        row[_WIDTH // 2] = "|"
    for a, b in zip(x, y, strict=True):
        column = round((a + 1.0) / 2.0 * (_WIDTH - 1))
        line = round((1.0 - b / top) / 2.0 * (_HEIGHT - 1))
        grid[line][column] = "*"
    return ["", *("  " + "".join(row).rstrip() for row in grid), f"  torque against {_AXES[axis]}"]


def _torque(form: Form, axis: str, x: float) -> float:
    """The column that is drawn, at one point of the axis, other variables at 1; 0 where it ends."""
    values: dict[str, float] = {}
    for shape in form.shapes:
        values[shape.name] = shape.grid[-1] if shape.grid else 6.0
    values |= dict.fromkeys(("v", "a", "q", "load", "static", "torque", "t", "T", "z"), 1.0)
    if axis == "load":  # both directions, the load growing outwards
        values |= {"load": abs(x), "static": abs(x), "v": _FUNCTIONS["sign"](x)}
    elif axis == "z":
        back = x < 0.0
        values["z"] = 1 - 2 * math.exp(-4 * (x + 1)) if back else 2 * math.exp(-4 * x) - 1
        values["v"] = 1.0 if back else -1.0
    elif axis == "q":
        values["q"] = math.pi * x
    else:
        values[axis] = x
    column = form.columns[-1] if axis == "q" else form.columns[0]
    try:
        result = column.equation.fold(values, _FUNCTIONS, math.pi, float)
    except (ValueError, OverflowError, ZeroDivisionError):
        return 0.0
    return result if isinstance(result, int | float) and math.isfinite(result) else 0.0
