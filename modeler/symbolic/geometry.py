"""The table with exact entries: every cell a sympy expression, every right angle exact."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

import sympy

from modeler.core.brief import Brief
from modeler.core.errors import DerivationError
from modeler.core.expression import Expression
from modeler.robot import Joint, Robot
from modeler.symbolic.folding import folded
from modeler.symbolic.relations import resolved_relations

_RIGHT_ANGLE_TOLERANCE = 1e-9
_QUARTER = math.pi / 2


def geometric_symbol(name: str) -> sympy.Symbol:
    """The symbol of that name; the only place where geometric symbols are made."""
    return sympy.Symbol(name, real=True)


@dataclass(frozen=True)
class Row(Brief):
    """One row of the table, exact.

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r), where theta = rate q + offset for a
    revolute joint, r = rate q + offset for a prismatic one.

    Attributes:
        parent: index of the antecedent row, None for the base.
        index: number of the row among those that move; None for a fixed frame.
        theta: constant part of theta.
        r: constant part of r.
        rate: +1 or -1.
    """

    joint: Joint
    parent: int | None
    index: int | None
    gamma: sympy.Expr
    b: sympy.Expr
    alpha: sympy.Expr
    d: sympy.Expr
    theta: sympy.Expr
    r: sympy.Expr
    rate: int


@dataclass(frozen=True)
class Geometry(Brief):
    """The exact table of a robot.

    Attributes:
        rows: in table order.
        gravity: acceleration of gravity in frame 0.
        values: number of every symbol that is left in the entries.
        forms: by `Row.index`: the row's variable as a sum of coefficient * u[k], where u are the
            variables of `robot.free`. Constants of relations stand in the row's theta or r.
    """

    robot: Robot
    rows: tuple[Row, ...]
    gravity: tuple[sympy.Expr, sympy.Expr, sympy.Expr]
    values: Mapping[str, float]
    forms: tuple[Mapping[int, Fraction], ...]

    @property
    def joints(self) -> int:
        """Number of rows that move."""
        return len(self.forms)

    @property
    def coordinates(self) -> int:
        """Number of free variables u."""
        return len(self.robot.free)

    @property
    def tied(self) -> bool:
        """True if rows follow others, so that u has fewer entries than rows move."""
        return bool(self.robot.relations)

    def ancestors(self, k: int) -> list[int]:
        """Rows from `k` down to the base, `k` first."""
        chain: list[int] = []
        at: int | None = k
        while at is not None:
            chain.append(at)
            at = self.rows[at].parent
        return chain


def exact_geometry(robot: Robot, at_nominal: bool = False) -> Geometry:
    """The table of `robot` with exact entries.

    Args:
        robot: as read.
        at_nominal: True to put the value of every symbol, as the decimal fraction that was written,
            in its place.

    A symbol keeps its letter unless its value decides the structure: a symbol worth 0 is 0, one
    within 1e-9 of a multiple of pi/2 is that multiple, one given by an expression is that
    expression.

    Raises:
        DerivationError: an entry is not finite, or a joint variable does not stand alone.
    """
    numbers = robot.symbol_values()
    symbols = _symbols(robot, numbers, at_nominal)
    forms, constants = resolved_relations(robot, symbols)
    cells = _Cells(symbols, numbers)
    rows = tuple(_moved(row, constants, cells) for row in _rows(robot, cells))
    try:
        gravity = tuple(folded(entry, symbols) for entry in robot.gravity)
    except DerivationError as error:
        raise DerivationError(f"gravity: {error}") from None
    used = {name for name, value in symbols.items() if value == geometric_symbol(name)}
    return Geometry(
        robot, rows, (gravity[0], gravity[1], gravity[2]),
        {name: numbers[name] for name in numbers if name in used}, forms,
    )  # fmt: skip


def _moved(row: Row, constants: Mapping[str, sympy.Expr], cells: "_Cells") -> Row:
    """The row with the constant of its variable's relation in theta or r."""
    constant = constants.get(row.joint.name, sympy.Integer(0))
    if constant == 0:
        return row
    if row.joint.angular:
        return replace(row, theta=cells.snapped(row.theta + row.rate * constant))
    return replace(row, r=sympy.expand(row.r + row.rate * constant))


def _rows(robot: Robot, cells: "_Cells") -> list[Row]:
    rows: list[Row] = []
    places = {"0": None} | {joint.name: i for i, joint in enumerate(robot.joints)}
    index = 0
    for joint in robot.joints:
        theta, rate_theta = cells.affine(joint, "theta")
        r, rate_r = cells.affine(joint, "r")
        rows.append(
            Row(
                joint=joint,
                parent=places[joint.antecedent],
                index=index if joint.moves else None,
                gamma=cells.angle(joint, "gamma"),
                b=cells.length(joint, "b"),
                alpha=cells.angle(joint, "alpha"),
                d=cells.length(joint, "d"),
                theta=theta,
                r=r,
                rate=(rate_theta if joint.angular else rate_r) if joint.moves else 1,
            )
        )
        index += joint.moves
    return rows


def _symbols(robot: Robot, numbers: Mapping[str, float], at_nominal: bool) -> dict[str, sympy.Expr]:
    found: dict[str, sympy.Expr] = {}
    for name, expression in robot.symbols.items():
        quarters = round(numbers[name] / _QUARTER)
        if numbers[name] == 0.0:
            found[name] = sympy.Integer(0)
        elif quarters and abs(numbers[name] - quarters * _QUARTER) < _RIGHT_ANGLE_TOLERANCE:
            found[name] = quarters * sympy.pi / 2
        elif expression.names or "pi" in expression.text or at_nominal:
            found[name] = _symbol(name, expression, found)
        else:
            found[name] = geometric_symbol(name)
    return found


def _symbol(name: str, expression: Expression, found: Mapping[str, sympy.Expr]) -> sympy.Expr:
    try:
        return folded(expression, found)
    except DerivationError as error:
        raise DerivationError(f"[symbols], {name}: {error}") from None


@dataclass(frozen=True)
class _Cells:
    symbols: Mapping[str, sympy.Expr]
    numbers: Mapping[str, float]

    def length(self, joint: Joint, column: str) -> sympy.Expr:
        return self._folded(joint, column, self.symbols)

    def angle(self, joint: Joint, column: str) -> sympy.Expr:
        return self.snapped(self._folded(joint, column, self.symbols))

    def affine(self, joint: Joint, column: str) -> tuple[sympy.Expr, int]:
        """(constant part, coefficient of the joint variable) of theta or r."""
        q = sympy.Symbol(joint.variable, real=True)
        value = sympy.expand(self._folded(joint, column, {**self.symbols, joint.variable: q}))
        rate = value.coeff(q, 1)
        constant = value - rate * q
        if constant.has(q) or rate not in (0, 1, -1):
            raise DerivationError(
                f"joint {joint.name}: got {getattr(joint, column).text}; expected {q} or -{q} plus "
                "a constant"
            )
        return (self.snapped(constant) if column == "theta" else constant), int(rate)

    def _folded(self, joint: Joint, column: str, symbols: Mapping[str, sympy.Expr]) -> sympy.Expr:
        try:
            return folded(getattr(joint, column), symbols)
        except DerivationError as error:
            raise DerivationError(f'row "{joint.name}", column {column}: {error}') from None

    def snapped(self, value: sympy.Expr) -> sympy.Expr:
        """The angle, exact where its value is a right angle."""
        if not value.free_symbols:
            return value
        values = {symbol: self.numbers[symbol.name] for symbol in value.free_symbols}
        turns = float(value.subs(values)) / float(sympy.pi / 2)
        if abs(turns - round(turns)) < _RIGHT_ANGLE_TOLERANCE:
            return round(turns) * sympy.pi / 2
        return value
