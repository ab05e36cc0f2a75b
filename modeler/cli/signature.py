"""The signature of an effect, drawn in characters: torque against what it depends on."""

import numpy as np

from modeler.effects import Acts, Effect, Form

_WIDTH, _HEIGHT = 61, 13
_FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt,
    "exp": np.exp, "abs": np.abs, "sign": np.sign, "tanh": np.tanh,
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
    x = np.linspace(-1.0, 1.0, 6 * _WIDTH)
    y = _torque(form, axis, x)
    top = float(np.max(np.abs(y))) or 1.0
    grid = [[" "] * _WIDTH for _ in range(_HEIGHT)]
    grid[_HEIGHT // 2] = ["-"] * _WIDTH
    for row in grid:
        row[_WIDTH // 2] = "|"
    for a, b in zip(x, y, strict=True):
        column = round((a + 1.0) / 2.0 * (_WIDTH - 1))
        line = round((1.0 - b / top) / 2.0 * (_HEIGHT - 1))
        grid[line][column] = "*"
    return ["", *("  " + "".join(row).rstrip() for row in grid), f"  torque against {_AXES[axis]}"]


def _torque(form: Form, axis: str, x: np.ndarray) -> np.ndarray:
    """The sum of the columns along the axis, other variables at 1."""
    values: dict[str, object] = {}
    for shape in form.shapes:
        values[shape.name] = shape.grid[-1] if shape.grid else 6.0
    values |= dict.fromkeys(("v", "a", "q", "load", "static", "torque", "t", "T", "z"), 1.0)
    if axis == "load":  # both directions, the load growing outwards
        values |= {"load": np.abs(x), "static": np.abs(x), "v": np.sign(x)}
    elif axis == "z":
        values |= {"z": np.where(x < 0.0, 1 - 2 * np.exp(-4 * (x + 1)), 2 * np.exp(-4 * x) - 1)}
        values["v"] = np.where(x < 0.0, 1.0, -1.0)
    elif axis == "q":
        values["q"] = np.pi * x
    else:
        values[axis] = x
    column = form.columns[-1] if axis == "q" else form.columns[0]
    with np.errstate(all="ignore"):
        result = column.equation.fold(values, _FUNCTIONS, np.pi, float)
    return np.nan_to_num(result * np.ones_like(x), posinf=0.0, neginf=0.0)
