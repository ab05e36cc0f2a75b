"""The table with exact entries: every cell a sympy expression, every right angle exact."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, partial
from math import comb, prod

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import Expression
from modeler.core.json import ShortRepr
from modeler.derivation.thresholds import THRESHOLDS
from modeler.robot import Joint, LinkFrame, Robot, locate_written_cell

# Cosine and sine of constant angles, exactly, with as few different ones as possible.
#
# Sums and whole multiples are expanded, so that al, 2*al and al + pi/4 are made of the same two
# angles, and relations between them are seen.


Pair = tuple[sympy.Expr, sympy.Expr]
"""(cosine, sine)."""


@lru_cache(maxsize=1024)
def cos_sin(angle: sympy.Expr) -> Pair:
    """Returns cosine and sine: exact 0 and +-1 at right angles; other constants are left standing.

    They are not turned into radicals: cos(pi/3) and sin(pi/3) stay a point of the unit circle,
    which is what grouping has to know of them.
    """
    constant, rest = angle.as_independent(*angle.free_symbols, as_Add=True)
    if rest == 0 or not angle.free_symbols:
        return _evaluate_number(angle)
    if not is_short(rest):
        return _keep_unevaluated(angle)
    pair = tuple(sympy.expand_trig(f(rest)) for f in (sympy.cos, sympy.sin))
    return _add_angles((pair[0], pair[1]), _evaluate_number(constant))


def count_quarter_turns(angle: sympy.Expr) -> tuple[int, sympy.Expr]:
    """Returns the right angles in a constant, of `phi + 0.3 - pi/2` -1, and the rest."""
    terms = sympy.Add.make_args(angle)
    right = [term for term in terms if (term / (sympy.pi / 2)).is_Integer]
    return int(sum(right) / (sympy.pi / 2)), angle - sum(right)


def is_short(angle: sympy.Expr) -> bool:
    """Returns True if sums and whole multiples in the angle are few enough to be written out."""
    turns = 0
    for term in sympy.Add.make_args(angle):
        factor = term.as_coeff_Mul()[0]
        turns += abs(int(factor)) if factor.is_Integer else 1
    return turns <= THRESHOLDS.max_angle_terms


def _evaluate_number(angle: sympy.Expr) -> Pair:
    quarters = angle / (sympy.pi / 2)
    if quarters.is_Integer:
        return sympy.cos(angle), sympy.sin(angle)
    if angle.is_negative:
        c, s = _evaluate_number(-angle)
        return c, -s
    number, turned = angle.as_coeff_Add()
    if number and turned:  # 0.4 + pi/2 is made of the same angle as 0.4
        return _add_angles(_evaluate_number(number), _evaluate_number(turned))
    turns = angle / sympy.pi
    if turns.is_Rational and turns.q <= THRESHOLDS.max_pi_denominator:
        return _multiply_angle(_keep_unevaluated(sympy.pi / turns.q), int(turns.p))
    return _keep_unevaluated(angle)


def _keep_unevaluated(angle: sympy.Expr) -> Pair:
    return sympy.cos(angle, evaluate=False), sympy.sin(angle, evaluate=False)


def _multiply_angle(pair: Pair, n: int) -> Pair:
    total = pair
    for _ in range(n - 1):
        total = _add_angles(total, pair)
    return total


def _add_angles(a: Pair, b: Pair) -> Pair:
    # Products and sums only: sympy's own simplifications would evaluate what is left standing.
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


# Expressions of the robot file as exact sympy expressions.


_FUNCTIONS = {name: getattr(sympy, name) for name in ("sin", "cos", "sqrt", "exp", "sign", "tanh")}
_FUNCTIONS |= {"abs": sympy.Abs, "tan": lambda x: sympy.sin(x) / sympy.cos(x)}


def fold_expression(expression: Expression, values: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """Returns the expression with `values` for its names, decimals as exact fractions.

    Raises:
        DerivationError: it is not finite, or too long to be written out.
    """
    try:
        value = sympy.sympify(
            expression.fold(values, _FUNCTIONS, sympy.pi, sympy.Rational, compute_power)
        )
        check_length(value)
    except ExpressionTooLong as error:
        raise DerivationError(
            f'"{_shorten_text(expression.text)}" {error}; give its value as a number'
        ) from None
    if value.has(sympy.zoo, sympy.oo, sympy.nan):
        raise DerivationError(
            f'"{_shorten_text(expression.text)}" is not finite; expected a finite number'
        )
    turned = value.atoms(sympy.cos, sympy.sin)
    if not turned or not all(is_short(function.args[0]) for function in turned):
        return value
    return sympy.expand_trig(value)


def _shorten_text(text: str) -> str:
    start = text[: THRESHOLDS.quoted_letters]
    return text if text == start else f"{start} ..."


# Linear relations between joint variables: every row's variable in the free ones, exactly.


Form = Mapping[int, Fraction]
"""Sum of coefficient * u[k] over the free variables u."""


def resolve_relations(
    robot: Robot, symbols: Mapping[str, sympy.Expr]
) -> tuple[tuple[Form, ...], dict[str, sympy.Expr]]:
    """Returns the forms of the moving rows, in table order, and the relations' constants by row.

    q_row = sum of form[k] u[k] + constant. A symbol in a coefficient counts with its value: the
    coefficients are rational numbers.

    Raises:
        DerivationError: a relation is not linear.
    """
    numbers = {name: sympy.Rational(repr(x)) for name, x in robot.evaluate_symbols().items()}
    free = [_create_joint_symbol(joint) for joint in robot.free_joints]
    variables = {joint.variable: _create_joint_symbol(joint) for joint in robot.moving_joints}
    values = {symbol: symbol for symbol in free}
    waiting = {joint for joint in robot.moving_joints if joint.name in robot.relations}
    while waiting:
        for joint in sorted(waiting, key=lambda joint: joint.name):
            expression = robot.relations[joint.name]
            if all(variables[n] in values for n in expression.names if n in variables):
                value = fold_expression(expression, {**symbols, **variables})
                values[_create_joint_symbol(joint)] = sympy.expand(value.subs(values))
                waiting.discard(joint)
    forms, constants = [], {}
    places = {joint.name: k for k, joint in enumerate(robot.free_joints)}
    for joint in robot.moving_joints:
        if joint.name in places:  # it follows no other
            constants[joint.name] = sympy.Integer(0)
            forms.append({places[joint.name]: Fraction(1)})
            continue
        value = values[_create_joint_symbol(joint)]
        coefficients = {k: value.coeff(symbol, 1) for k, symbol in enumerate(free)}
        constant = value - sum(c * free[k] for k, c in coefficients.items())
        constant = sympy.expand(constant)
        if constant.free_symbols & set(variables.values()):
            raise DerivationError(
                f"the relation of joint {joint.name} is not linear; expected a sum such as q1 - q2"
            )
        constants[joint.name] = constant
        pairs = coefficients.items()
        forms.append({k: _convert_coefficient(c, numbers) for k, c in pairs if c != 0})
    return tuple(forms), constants


def _create_joint_symbol(joint: Joint) -> sympy.Symbol:
    return sympy.Symbol(joint.variable, real=True)


def _convert_coefficient(value: sympy.Expr, numbers: Mapping[str, sympy.Rational]) -> Fraction:
    at = sympy.nsimplify(value.subs({s: numbers[s.name] for s in value.free_symbols}))
    if not at.is_Rational:
        raise DerivationError(f"the coefficient {value} of a relation is not rational")
    return Fraction(int(at.p), int(at.q))


_QUARTER = math.pi / 2


def create_geometric_symbol(name: str) -> sympy.Symbol:
    """Returns the symbol of that name; geometric symbols are made only here."""
    return sympy.Symbol(name, real=True)


@dataclass(frozen=True)
class GeometryRow(ShortRepr):
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
class Geometry(ShortRepr):
    """The exact table of a robot.

    Attributes:
        rows: in table order.
        gravity: acceleration of gravity in frame 0.
        values: number of every symbol that is left in the entries.
        forms: by `Row.index`: the row's variable as a sum of coefficient * u[k], where u are the
            variables of `robot.free`. Constants of relations stand in the row's theta or r.
    """

    robot: Robot
    rows: tuple[GeometryRow, ...]
    gravity: tuple[sympy.Expr, sympy.Expr, sympy.Expr]
    values: Mapping[str, float]
    forms: tuple[Mapping[int, Fraction], ...]

    @property
    def joint_count(self) -> int:
        """Returns number of rows that move."""
        return len(self.forms)

    @property
    def coordinate_count(self) -> int:
        """Returns number of free variables u."""
        return len(self.robot.free_joints)

    @property
    def has_relations(self) -> bool:
        """Returns True if rows follow others, so that u has fewer entries than rows move."""
        return bool(self.robot.relations)

    def find_ancestors(self, k: int) -> list[int]:
        """Returns rows from `k` down to the base, `k` first."""
        chain: list[int] = []
        at: int | None = k
        while at is not None:
            chain.append(at)
            at = self.rows[at].parent
        return chain


def build_exact_geometry(robot: Robot, at_nominal: bool = False) -> Geometry:
    """Returns the table of `robot` with exact entries.

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
    numbers = robot.evaluate_symbols()
    symbols = _resolve_symbols(robot, numbers, at_nominal)
    forms, constants = resolve_relations(robot, symbols)
    cells = _Cells(symbols, numbers, partial(locate_written_cell, robot))
    rows = tuple(_add_relation_constant(row, constants, cells) for row in _build_rows(robot, cells))
    try:
        gravity = tuple(fold_expression(entry, symbols) for entry in robot.gravity)
    except DerivationError as error:
        raise DerivationError(f"gravity: {error}") from None
    used = {name for name, value in symbols.items() if value == create_geometric_symbol(name)}
    x, y, z = gravity
    lengths = {name: number for name, number in numbers.items() if name in used}
    return Geometry(robot, rows, (x, y, z), lengths, forms)


def compute_placement(
    robot: Robot, frame: LinkFrame
) -> tuple[tuple[sympy.Expr, ...], tuple[sympy.Expr, ...]]:
    """Returns position, m, and angles roll, pitch, yaw of a frame on its row, exact.

    Raises:
        DerivationError: a cell is not finite.
    """
    numbers = robot.evaluate_symbols()
    symbols = _resolve_symbols(robot, numbers, False)
    cells = _Cells(symbols, numbers, partial(locate_written_cell, robot))
    position = tuple(fold_expression(cell, cells.symbols) for cell in frame.position)
    folded = (fold_expression(cell, cells.symbols) for cell in frame.angles)
    return position, tuple(cells.snap_angle(angle) for angle in folded)


def _add_relation_constant(
    row: GeometryRow, constants: Mapping[str, sympy.Expr], cells: "_Cells"
) -> GeometryRow:
    """The row with the constant of its variable's relation in theta or r."""
    constant = constants.get(row.joint.name, sympy.Integer(0))
    if constant == 0:
        return row
    if row.joint.is_revolute:
        return replace(row, theta=cells.snap_angle(row.theta + row.rate * constant))
    return replace(row, r=sympy.expand(row.r + row.rate * constant))


def _build_rows(robot: Robot, cells: "_Cells") -> list[GeometryRow]:
    rows: list[GeometryRow] = []
    places = {"0": None} | {joint.name: i for i, joint in enumerate(robot.joints)}
    index = 0
    for joint in robot.joints:
        theta, rate_theta = cells.read_affine(joint, "theta")
        r, rate_r = cells.read_affine(joint, "r")
        rows.append(
            GeometryRow(
                joint=joint,
                parent=places[joint.antecedent],
                index=index if joint.is_moving else None,
                gamma=cells.read_angle(joint, "gamma"),
                b=cells.read_length(joint, "b"),
                alpha=cells.read_angle(joint, "alpha"),
                d=cells.read_length(joint, "d"),
                theta=theta,
                r=r,
                rate=(rate_theta if joint.is_revolute else rate_r) if joint.is_moving else 1,
            )
        )
        index += joint.is_moving
    return rows


def _resolve_symbols(
    robot: Robot, numbers: Mapping[str, float], at_nominal: bool
) -> dict[str, sympy.Expr]:
    resolved: dict[str, sympy.Expr] = {}
    for name, expression in robot.symbols.items():
        quarters = round(numbers[name] / _QUARTER)
        if numbers[name] == 0.0:
            resolved[name] = sympy.Integer(0)
        elif quarters and abs(numbers[name] - quarters * _QUARTER) < THRESHOLDS.right_angle:
            resolved[name] = quarters * sympy.pi / 2
        elif expression.names or expression.uses_pi or at_nominal:
            try:
                resolved[name] = fold_expression(expression, resolved)
            except DerivationError as error:
                raise DerivationError(f"[symbols], {name}: {error}") from None
        else:
            resolved[name] = create_geometric_symbol(name)
    return resolved


@dataclass(frozen=True)
class _Cells:
    symbols: Mapping[str, sympy.Expr]
    numbers: Mapping[str, float]
    where: Callable[[Joint, str], str]

    def read_length(self, joint: Joint, column: str) -> sympy.Expr:
        return self._fold_cell(joint, column, self.symbols)

    def read_angle(self, joint: Joint, column: str) -> sympy.Expr:
        return self.snap_angle(self._fold_cell(joint, column, self.symbols))

    def read_affine(self, joint: Joint, column: str) -> tuple[sympy.Expr, int]:
        """Returns (constant part, coefficient of the joint variable) of theta or r."""
        q = sympy.Symbol(joint.variable, real=True)
        value = sympy.expand(self._fold_cell(joint, column, {**self.symbols, joint.variable: q}))
        rate = value.coeff(q, 1)
        constant = value - rate * q
        if constant.has(q) or rate not in (0, 1, -1):
            raise DerivationError(
                f"joint {joint.name}: got {getattr(joint, column).text}; expected {q} or -{q} plus "
                "a constant"
            )
        return (self.snap_angle(constant) if column == "theta" else constant), int(rate)

    def _fold_cell(
        self, joint: Joint, column: str, symbols: Mapping[str, sympy.Expr]
    ) -> sympy.Expr:
        try:
            return fold_expression(getattr(joint, column), symbols)
        except DerivationError as error:
            raise DerivationError(f"{self.where(joint, column)}: {error}") from None

    def snap_angle(self, value: sympy.Expr) -> sympy.Expr:
        """Returns the angle, exact where its value is a right angle."""
        if not value.free_symbols:
            return value
        values = {symbol: self.numbers[symbol.name] for symbol in value.free_symbols}
        turns = float(value.subs(values)) / float(sympy.pi / 2)
        if abs(turns - round(turns)) < THRESHOLDS.right_angle:
            return round(turns) * sympy.pi / 2
        return value


# How large a constant becomes when it is written out, found without writing it out.


class ExpressionTooLong(ArithmeticError):
    """Says what of a constant is too long, and the bound."""


def check_length(value: sympy.Expr) -> None:
    """Refuses constants that nobody could write out.

    Every subexpression is looked at once, arguments first: what is shared costs nothing.

    Raises:
        TooLong: more terms or deeper than the bounds.
    """
    known: dict[sympy.Basic, tuple[int, int]] = {}  # terms, depth
    stack = [value]
    while stack:
        node = stack[-1]
        missing = [arg for arg in node.args if arg not in known]
        if missing:
            stack += missing
            continue
        stack.pop()
        depth = 1 + max((known[arg][1] for arg in node.args), default=0)
        terms = _count_terms(node, [known[arg][0] for arg in node.args])
        if depth > THRESHOLDS.max_constant_depth:
            raise ExpressionTooLong(
                f"has more than {THRESHOLDS.max_constant_depth} operations inside each other"
            )
        if terms > THRESHOLDS.max_constant_terms:
            raise ExpressionTooLong(
                f"has {terms} terms when written out, more than {THRESHOLDS.max_constant_terms}"
            )
        known[node] = terms, depth


def _count_terms(node: sympy.Basic, parts: list[int]) -> int:
    if isinstance(node, sympy.Add):
        return sum(parts)
    if isinstance(node, sympy.Mul):
        return prod(parts)
    if isinstance(node, sympy.Pow) and node.exp.is_Integer:
        n = abs(int(node.exp))
        small = n <= THRESHOLDS.max_constant_terms or parts[0] == 1
        return comb(n + parts[0] - 1, n) if small else n
    return 1


def compute_power(base: sympy.Expr, exponent: sympy.Expr | int) -> sympy.Expr:
    """Returns base**exponent.

    Raises:
        TooLong: an exact number of more than `THRESHOLDS.max_number_bits`.
    """
    exponent = sympy.sympify(exponent)
    if base.is_Rational and exponent.is_Rational:
        bits = max(int(base.p).bit_length(), int(base.q).bit_length()) * abs(exponent)
        if bits > THRESHOLDS.max_number_bits and base not in (0, 1, -1):
            raise ExpressionTooLong(
                f"holds an exact number of {int(bits)} bits, more than {THRESHOLDS.max_number_bits}"
            )
    return base**exponent
