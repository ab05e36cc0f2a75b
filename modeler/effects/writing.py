"""Short forms for writing the catalogue."""

import math

from modeler.core.expression import parse
from modeler.effects.effect import EffectColumn, EnergyBlock, Form, Memory, Shape

_PER = {
    "torque": ("N m", "N"),
    "speed": ("N m s/rad", "N s/m"),
    "position": ("N m/rad", "N/m"),
    "ratio": ("1", "1"),
    "time": ("N m/s", "N/s"),
    "seconds": ("s", "s"),
    "angle": ("rad", "m"),
    "compliance": ("rad/(N m)", "m/N"),
    "heat": ("N m/K", "N/K"),
    "heat_speed": ("N m s/(rad K)", "N s/(m K)"),
}


def column(
    prefix: str, equation: str, per: str, kind: str = "friction", nonnegative: bool = False,
    largest: float = math.inf,
) -> EffectColumn:  # fmt: skip
    """A column that never groups with another; `per` says what its parameter multiplies."""
    revolute, prismatic = _PER[per]
    return EffectColumn(
        prefix, parse(equation), revolute, prismatic, kind, EnergyBlock.OWN, nonnegative,
        largest,
    )  # fmt: skip


def form(
    *columns: EffectColumn, shapes: tuple[Shape, ...] = (), memory: Memory | None = None
) -> Form:
    """A form of an effect."""
    return Form(columns, shapes, memory)
