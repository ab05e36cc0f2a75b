"""Geometric symbols in C: which of them -D may replace, and why the others not."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from modeler.codegen.block import format_float
from modeler.codegen.targets import Target
from modeler.core.expression import Expression
from modeler.derivation import BaseParameters, Geometry, SymbolicModel, create_geometric_symbol
from modeler.robot import Robot

_SAME = 1e-12  # relative: a cell and its exact entry differ by rounding

_SOME = "Their values decide which terms there are."
_ALL = "The base parameters hold for these values only."


@dataclass(frozen=True)
class SymbolLines:
    """Finished names and values of the geometric symbols.

    Attributes:
        free: (macro, value) of those that -D replaces.
        fixed: macros of those that must stay.
        why: why these must stay, one sentence.
        initial: {symbol: what its constant is initialised with}: the macro, or the value.
        texts: {symbol: its value}.
    """

    free: tuple[tuple[str, str], ...]
    fixed: tuple[str, ...]
    why: str
    initial: Mapping[str, str]
    texts: Mapping[str, str]

    @property
    def macros(self) -> tuple[str, ...]:
        """All of them."""
        return (*(name for name, _ in self.free), *self.fixed)


def build_symbol_lines(
    model: SymbolicModel, base: BaseParameters, macros: Mapping[str, str], target: Target
) -> SymbolLines:
    """What is written of every declared symbol.

    Relations proved for the letters hold for any value of them. Where they are not, or where a
    value decides the structure (worth 0, a right angle), the code would be wrong for another one.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        macros: of all declared symbols.
        target: the number type.
    """
    values = model.geometry.values
    exact = base.proof.kind == "exact"
    stay = find_deciding_symbols(model.geometry) if exact else frozenset(values)
    texts = {name: format_float(value, target) for name, value in values.items()}
    return SymbolLines(
        free=tuple((macros[name], text) for name, text in texts.items() if name not in stay),
        fixed=tuple(
            macros[name] for name in model.robot.symbols if name in stay or name not in texts
        ),
        why=_SOME if exact else _ALL,
        initial={name: text if name in stay else macros[name] for name, text in texts.items()},
        texts=texts,
    )


def find_deciding_symbols(geometry: Geometry) -> frozenset[str]:
    """Symbols left in the geometry that cannot change without changing its structure.

    `d = "L1 + L2 - L3"` worth 0 is left out of the table, an angle `"a1 + a2"` worth pi/2 is that
    right angle: with another L1 or a1 the entries would not be those of the table any more. So the
    symbols are moved a little, and the entries compared with the cells as they were written.
    """
    robot = geometry.robot
    moved = {
        name: value * (1 + 1 / (97 + 12 * place))
        for place, (name, value) in enumerate(geometry.values.items())
    }
    numbers: dict[str, float] = {}  # of all symbols and joint variables, some symbols moved
    for name, expression in robot.symbols.items():
        try:
            numbers[name] = moved[name] if name in moved else expression.evaluate(numbers)
        except (ArithmeticError, ValueError):
            numbers[name] = math.nan  # equal to nothing
    numbers |= {joint.variable: 0.0 for joint in robot.joints}
    columns = ("gamma", "b", "alpha", "d", "theta", "r")
    cells: list[tuple[Expression, sympy.Expr]] = [
        (getattr(row.joint, column), getattr(row, column))
        for row in geometry.rows
        for column in columns
    ]
    deciding: set[str] = set()
    for cell, entry in (*cells, *zip(robot.gravity, geometry.gravity, strict=True)):
        leaves = {name: moved[name] for name in _find_leaves(robot, cell) if name in moved}
        deciding |= leaves.keys() - {symbol.name for symbol in entry.free_symbols}
        if not leaves:
            continue
        symbols = {create_geometric_symbol(name): value for name, value in leaves.items()}
        try:
            written, exact = cell.evaluate(numbers), complex(entry.evalf(subs=symbols))
        except (ArithmeticError, ValueError, TypeError):
            written, exact = math.nan, 0j
        if not abs(written - exact) <= _SAME * max(abs(written), *map(abs, leaves.values())):
            deciding |= leaves.keys()
    return frozenset(deciding)


def _find_leaves(robot: Robot, cell: Expression) -> set[str]:
    """Declared symbols that the cell depends on, through those given by expressions too."""
    leaves: set[str] = set()
    waiting = [name for name in cell.names if name in robot.symbols]
    while waiting:
        name = waiting.pop()
        if name not in leaves:
            leaves.add(name)
            waiting += robot.symbols[name].names
    return leaves
