"""Tables of laws that were learned, as the emitted code reads them; see modeler_law.h."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.codegen.functions import wrap_names
from modeler.codegen.targets import Target
from modeler.core.files import locate_resources
from modeler.core.law import Law


@dataclass(frozen=True)
class LawTable:
    """The finished strings of one law.

    Attributes:
        name: in C.
        values: lines of its table.
        count: of its numbers.
        low, scale, cells: of both axes; of one axis the second is 0.
        step: how many coefficients lie along the second axis.
    """

    name: str
    values: list[str]
    count: int
    low: list[str]
    scale: list[str]
    cells: list[str]
    step: int


def read_law_source() -> str:
    """What reads the tables, for code that includes nothing."""
    text = (locate_resources("csrc") / "include" / "modeler_law.h").read_text("utf-8")
    return text.replace('#include "modeler_runtime.h"\n\n', "")


def build_law_tables(read: Iterable[Any], target: Target) -> list[LawTable]:
    """Those that the functions of a file read, each once.

    Args:
        read: what has `laws`, by name.
        target: the number type.

    Raises:
        EmitError: a number is too large for it.
    """
    every: dict[str, Law] = {}
    for each in read:
        every |= each.laws
    return [_build_table(name, every[name], target.constant_target) for name in sorted(every)]


def _build_table(name: str, law: Law, target: Target) -> LawTable:
    strips = compute_law_strips(law)

    def format_numbers(values: Iterable[float]) -> list[str]:
        # What rounding left of a 0 may be too small for the target.
        return [
            target.format_literal(x if abs(x) > float(target.smallest) else 0.0) for x in values
        ]

    def format_axes(values: Iterable[float]) -> list[str]:
        return format_numbers([*values, 0.0][:2])

    lines = wrap_names(format_numbers(strips.ravel().tolist()))
    cells = format_axes(map(float, law.cells))
    return LawTable(
        name,
        lines,
        strips.size,
        format_axes(law.low),
        format_axes(law.scales),
        cells,
        strips.shape[2],
    )


def compute_law_strips(law: Law) -> np.ndarray:
    """(cells + 1, 4, coefficients): of the powers of the place in each cell of the first axis.

    The last cell is the end itself. There is one coefficient of a law of one quantity; along a
    second axis those of its spline stand, and one more that counts 0 at its end.
    """
    c = law.coefficients.reshape(law.cells[0] + 3, -1)
    if len(law.cells) > 1:
        c = np.pad(c, ((0, 0), (0, 1)))
    a, b, c, d = c[:-3], c[1:-2], c[2:-1], c[3:]
    powers = [(a + 4 * b + c) / 6, (c - a) / 2, (a - 2 * b + c) / 2, (d - a + 3 * (b - c)) / 6]
    inside = np.stack(powers, axis=1)
    end = np.zeros_like(inside[:1])
    end[0, 0] = (b[-1] + 4 * c[-1] + d[-1]) / 6
    return np.concatenate([inside, end])
