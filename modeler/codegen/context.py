"""What the printers of a module share: symbols, tables of laws, functions as finished strings."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
import sympy

from modeler.codegen import functions as layout
from modeler.codegen.block import Block, Target, format_float, format_legend, make_block
from modeler.codegen.control import format_state_prototypes
from modeler.codegen.functions import CFunction, wrap_names
from modeler.codegen.package import render
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.expression import Expression, Law
from modeler.core.files import locate_resources
from modeler.core.manifest import ModuleSpec
from modeler.derivation import (
    BaseParameters,
    Geometry,
    Label,
    SymbolicModel,
    create_geometric_symbol,
)
from modeler.robot import Robot

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
        """Returns the macros of all symbols."""
        return (*(name for name, _ in self.free), *self.fixed)


def build_symbol_lines(
    model: SymbolicModel, base: BaseParameters, macros: Mapping[str, str], target: Target
) -> SymbolLines:
    """Returns what is written of every declared symbol.

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
    """Finds the symbols in the geometry that cannot change without changing its structure.

    `d = "L1 + L2 - L3"` worth 0 is left out of the table, an angle `"a1 + a2"` worth pi/2 is that
    right angle: with another L1 or a1 the entries would not be those of the table any more. So the
    symbols are moved a little, and the entries compared with the cells as they were written.
    """
    robot = geometry.robot
    pairs = enumerate(geometry.values.items())
    moved = {name: value * (1 + 1 / (97 + 12 * place)) for place, (name, value) in pairs}
    numbers: dict[str, float] = {}  # of all symbols and joint variables, some symbols moved
    for name, expression in robot.symbols.items():
        try:
            numbers[name] = moved[name] if name in moved else expression.evaluate(numbers)
        except (ArithmeticError, ValueError):
            numbers[name] = math.nan  # equal to nothing
    numbers |= {joint.variable: 0.0 for joint in robot.joints}
    columns = ("gamma", "b", "alpha", "d", "theta", "r")
    cells: list[tuple[Expression, sympy.Expr]] = []
    for row in geometry.rows:
        cells += [(getattr(row.joint, column), getattr(row, column)) for column in columns]
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
        if not abs(written - exact) <= THRESHOLDS.max_relative_rounding * max(
            abs(written), *map(abs, leaves.values())
        ):
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


# Tables of laws that were learned, as the emitted code reads them; see modeler_law.h.


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
    """Returns the C that reads the tables, for code that includes nothing."""
    text = (locate_resources("csrc") / "include" / "modeler_law.h").read_text("utf-8")
    return text.replace('#include "modeler_runtime.h"\n\n', "")


def build_law_tables(read: Iterable[Any], target: Target) -> list[LawTable]:
    """Returns the tables that the functions of a file read, each once.

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
        least = float(target.smallest)
        return [target.format_literal(x if abs(x) > least else 0.0) for x in values]

    def format_axes(values: Iterable[float]) -> list[str]:
        return format_numbers([*values, 0.0][:2])

    lines = wrap_names(format_numbers(strips.ravel().tolist()))
    cells = format_axes(map(float, law.cells))
    low, scales = format_axes(law.low), format_axes(law.scales)
    return LawTable(name, lines, strips.size, low, scales, cells, strips.shape[2])


def compute_law_strips(law: Law) -> np.ndarray:
    """Returns (cells + 1, 4, coefficients).

    Of the powers of the place in each cell of the first axis.

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


@dataclass(frozen=True, kw_only=True)
class WrittenFunction(CFunction):
    """One function with its finished strings.

    Attributes:
        name: in C.
        arguments: comment lines.
        declaration, definition: prototypes.
        made: prototype of what is made of a closed posture.
        at_declaration, at_definition: prototypes of what is made of a state.
        lines: statements.
        block: the statements by parts, and what they read.
    """

    name: str
    arguments: list[str]
    declaration: str
    definition: str
    made: str
    at_declaration: str
    at_definition: str
    lines: list[str]
    block: Block


@dataclass
class ModuleContext:
    """What the units of a module share.

    Attributes:
        model: as derived.
        base: its base parameters.
        target: the number type.
        spec: the manifest, as far as it is known.
        places: C text of every symbol of the graphs.
        names: {geometric symbol: C constant}.
        symbols: the geometric symbols.
        values: what all templates are given besides.
        written: functions of all units written so far.
    """

    model: SymbolicModel
    base: BaseParameters
    target: Target
    spec: ModuleSpec
    places: Mapping[str, str]
    names: Mapping[str, str]
    symbols: SymbolLines
    values: dict[str, Any] = field(default_factory=dict)
    written: list[WrittenFunction] = field(default_factory=list)

    def render(self, template: str, **more: Any) -> str:
        """Returns the text of a template."""
        return render(template, **{**self.values, "spec": self.spec, **more})

    def write(
        self,
        function: CFunction,
        labels: Mapping[int, Label],
        turning: Mapping[int, str] = MappingProxyType({}),
    ) -> WrittenFunction:
        """Returns a function as C; `turning` are widths over which signs of speeds turn."""
        output, prefix, number = function.output.name, self.spec.prefix, self.target.number
        outputs = [(f"{output}[{index}]", value) for index, value in function.entries]
        shared = outputs and outputs[0][1].graph is self.model.graph
        block = make_block(outputs, self.places, turning, self.target, labels if shared else None)
        returns = "int" if function.status else "void"
        tree = self.model.closure is not None and function.unit not in ("_fitted", "_control")
        if function.internal and not tree:
            returns = "static void"
        made, declared, defined = format_state_prototypes(prefix, function, number)
        name = f"{prefix}_{function.role}"
        written = WrittenFunction(
            **vars(function),
            name=name,
            arguments=layout.format_argument_lines(function),
            declaration=layout.format_prototype(
                name, layout.format_arguments(function, number, prefix), returns
            ),
            definition=layout.format_prototype(
                name, layout.format_arguments(function, number, prefix, defined=True), returns
            ),
            made=made,
            at_declaration=declared,
            at_definition=defined,
            lines=[] if function.status else layout.format_body(function, block, self.target),
            block=block,
        )
        self.written.append(written)
        return written

    def unit(
        self, functions: Sequence[WrittenFunction], initial: Mapping[str, str]
    ) -> dict[str, Any]:
        """Returns what templates read of the functions of a file, and of their constants."""
        blocks = [function.block for function in functions]
        return {
            "functions": functions,
            "constants": self.constants(blocks, initial),
            "laws": build_law_tables(blocks, self.target),
            "letters": format_legend(letter for block in blocks for letter in block.letters),
        }

    def constants(self, read: Iterable[Any], initial: Mapping[str, str]) -> list[tuple[str, str]]:
        """Returns (name, initial value) of the geometric constants that are read."""
        symbols = frozenset[str]().union(*(each.symbols for each in read))
        return [(self.names[name], text) for name, text in initial.items() if name in symbols]
