"""The table with exact entries: every cell a sympy expression, every right angle exact."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import Expression
from modeler.robot import Joint, Robot

_FUNCTIONS = {
    "sin": sympy.sin, "cos": sympy.cos, "sqrt": sympy.sqrt,
    "tan": lambda x: sympy.sin(x) / sympy.cos(x),
    "exp": sympy.exp, "abs": sympy.Abs, "sign": sympy.sign, "tanh": sympy.tanh,
}  # fmt: skip
_RIGHT_ANGLE_TOLERANCE = 1e-9
_QUARTER = math.pi / 2


def geometric_symbol(name: str) -> sympy.Symbol:
    """The symbol of that name; the only place where geometric symbols are made."""
    return sympy.Symbol(name, real=True)


@dataclass(frozen=True)
class Row:
    """One row of the table, exact.

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r), where theta = rate q + offset for a
    revolute joint, r = rate q + offset for a prismatic one.

    Attributes:
        parent: index of the antecedent row, None for the base.
        index: index of the joint variable in q; None for a fixed frame.
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
class Geometry:
    """The exact table of a robot.

    Attributes:
        rows: in table order.
        gravity: acceleration of gravity in frame 0.
        values: number of every symbol that is left in the entries.
    """

    robot: Robot
    rows: tuple[Row, ...]
    gravity: tuple[sympy.Expr, sympy.Expr, sympy.Expr]
    values: Mapping[str, float]

    @property
    def joints(self) -> int:
        """Number of joint variables."""
        return sum(row.index is not None for row in self.rows)

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
    rows = _rows(robot, symbols, numbers)
    gravity = tuple(_fold(entry, symbols) for entry in robot.gravity)
    used = {name for name, value in symbols.items() if value == geometric_symbol(name)}
    return Geometry(
        robot, tuple(rows), (gravity[0], gravity[1], gravity[2]),
        {name: numbers[name] for name in numbers if name in used},
    )  # fmt: skip


def _rows(
    robot: Robot, symbols: Mapping[str, sympy.Expr], numbers: Mapping[str, float]
) -> list[Row]:
    rows: list[Row] = []
    places = {"0": None} | {joint.name: i for i, joint in enumerate(robot.joints)}
    index = 0
    for joint in robot.joints:
        cells = _Cells(joint, symbols, numbers)
        theta, rate_theta = cells.affine(joint.theta, angle=True)
        r, rate_r = cells.affine(joint.r, angle=False)
        rows.append(
            Row(
                joint=joint,
                parent=places[joint.antecedent],
                index=index if joint.moves else None,
                gamma=cells.angle(joint.gamma),
                b=cells.length(joint.b),
                alpha=cells.angle(joint.alpha),
                d=cells.length(joint.d),
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
            found[name] = _fold(expression, found)
        else:
            found[name] = geometric_symbol(name)
    return found


def _fold(expression: Expression, values: Mapping[str, sympy.Expr]) -> sympy.Expr:
    folded = sympy.sympify(
        expression.fold(
            values, _FUNCTIONS, sympy.pi, lambda x: sympy.Rational(x.numerator, x.denominator)
        )
    )
    if folded.has(sympy.zoo, sympy.oo, sympy.nan):
        raise DerivationError(f'"{expression.text}" is not finite; expected a finite number')
    return sympy.expand_trig(folded) if folded.has(sympy.cos, sympy.sin) else folded


@dataclass(frozen=True)
class _Cells:
    joint: Joint
    symbols: Mapping[str, sympy.Expr]
    numbers: Mapping[str, float]

    def length(self, cell: Expression) -> sympy.Expr:
        return _fold(cell, self.symbols)

    def angle(self, cell: Expression) -> sympy.Expr:
        return self._snap(_fold(cell, self.symbols))

    def affine(self, cell: Expression, angle: bool) -> tuple[sympy.Expr, int]:
        """(constant part, coefficient of the joint variable)."""
        q = sympy.Symbol(self.joint.variable, real=True)
        folded = sympy.expand(_fold(cell, {**self.symbols, self.joint.variable: q}))
        rate = folded.coeff(q, 1)
        constant = folded - rate * q
        if constant.has(q) or rate not in (0, 1, -1):
            raise DerivationError(
                f"joint {self.joint.name}: got {cell.text}; expected {q} or -{q} plus a constant"
            )
        return (self._snap(constant) if angle else constant), int(rate)

    def _snap(self, value: sympy.Expr) -> sympy.Expr:
        turns = float(value.subs(self._values())) / float(sympy.pi / 2)
        if value.free_symbols and abs(turns - round(turns)) < _RIGHT_ANGLE_TOLERANCE:
            return round(turns) * sympy.pi / 2
        return value

    def _values(self) -> dict[sympy.Symbol, float]:
        return {geometric_symbol(name): value for name, value in self.numbers.items()}
