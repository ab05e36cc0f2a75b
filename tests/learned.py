"""Robot files with laws that were learned, and what scipy says of these."""

from collections.abc import Mapping

import numpy as np
from scipy.interpolate import BSpline

from modeler.core.choices import read_builtin_robot
from modeler.core.expression import Law


def drawn(rng: np.random.Generator, axes: int, cells: tuple[int, ...] = ()) -> Law:
    """A law of any table, which does not come to rest at its ends."""
    cells = cells or tuple(int(count) for count in rng.integers(1, 9, axes))
    low, high = rng.uniform(-2.0, -0.4, axes), rng.uniform(0.3, 2.0, axes)
    values = rng.normal(size=np.prod([count + 3 for count in cells]))
    return Law(tuple(low.tolist()), tuple(high.tolist()), cells, tuple(values.tolist()))


def scipy_value(law: Law, *x: np.ndarray) -> np.ndarray:
    """The law by scipy, held at the ends; another evaluation, of knots and coefficients."""
    splines = []
    for low, high, count in zip(law.low, law.high, law.cells, strict=True):
        width = (high - low) / count
        knots = low + width * np.arange(-3, count + 4)
        splines.append(BSpline(knots, np.eye(count + 3), 3))
    weights = [
        spline(np.clip(column, low, high))
        for spline, column, low, high in zip(splines, x, law.low, law.high, strict=True)
    ]
    table = np.array(law.values).reshape([count + 3 for count in law.cells])
    if len(weights) == 1:
        return weights[0] @ table
    return np.einsum("ni,nj,ij->n", *weights, table)


def text_with(robot: str, laws: Mapping[str, tuple[str, Law]], more: str = "") -> str:
    """The file of a built-in robot with an effect of one column for each joint.

    Args:
        robot: its name.
        laws: {joint: (equation, its law)}.
        more: lines of [effects].
    """
    text, tables, lines = read_builtin_robot(robot), [], more
    for k, (joint, (equation, law)) in enumerate(laws.items()):
        name, prefix = f"learned_{joint}", f"Law{'abcdef'[k]}"
        tables += [
            f"[own_effects.{name}]",
            f'columns = {{{prefix} = "{equation}"}}',
            'unit = "N*m"',
            f"law = {{low = {list(law.low)}, high = {list(law.high)}, cells = {list(law.cells)}, "
            f"values = {list(law.values)}}}",
            "",
        ]
        lines += f'{name} = ["{joint}"]\n'
    head, section, rest = text.partition("[effects]\n")
    return "\n".join([head, *tables, section or "[effects]\n"]) + lines + rest
