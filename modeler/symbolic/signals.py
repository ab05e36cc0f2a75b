"""What effects read besides the motion: time, temperatures, inner states. Inputs `s` of the C."""

from collections.abc import Sequence
from dataclasses import dataclass

from modeler.core.errors import DerivationError
from modeler.symbolic.columns import ShaftColumn, StandardColumn


@dataclass(frozen=True)
class Signal:
    """One entry of the input `s`.

    Attributes:
        kind: "time" [s], "temperature" [K or degC], or "slip", the bristle of a joint [1].
        row: of the joint whose temperature or bristle it is; -1 for the time.
        value: travel over which the bristle turns, rad or m; 0 for the others.
    """

    kind: str
    row: int
    value: float = 0.0


def signals_of(columns: Sequence[StandardColumn]) -> tuple[Signal, ...]:
    """The signals that any column reads, each once, in the order of the columns."""
    found: dict[Signal, None] = {}
    for column in columns:
        if isinstance(column, ShaftColumn):
            for part in column.parts:
                found |= dict.fromkeys(signals_read(part))
    return tuple(found)


def signals_read(column: ShaftColumn) -> list[Signal]:
    """Those that one column reads."""
    names = column.equation.names
    found = []
    if "t" in names:
        found.append(Signal("time", -1))
    if "T" in names:
        found.append(Signal("temperature", column.row))
    if "z" in names:
        if column.memory is None or column.memory.kind != "slip":
            raise DerivationError(f"{column.name}: its inner state has no form in C")
        found.append(Signal("slip", column.row, column.shapes[column.memory.shape]))
    return found
