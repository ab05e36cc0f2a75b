"""Single values of a robot file: expressions, numbers, names, lists."""

import ast
import keyword
import math
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any

from modeler.core.expression import (
    FUNCTIONS,
    LARGEST_EXPONENT,
    ROUNDED,
    Expression,
    compute_power,
    parse_expression,
)
from modeler.core.toml_cells import LARGEST, TomlCell, join_names, quote_value, suggest_name
from modeler.robot.thresholds import THRESHOLDS

Values = Mapping[str, float]
"""Numbers by name."""

_SINES = (
    0.0,
    math.sin(math.pi / 12),
    0.5,
    math.sqrt(0.5),
    math.sqrt(0.75),
    math.cos(math.pi / 12),
    1.0,
)
"""Of 0, pi/12, .. pi/2, each the double next to it."""


def recognise_angle(digits: str) -> str | None:
    """Returns multiple of pi/12 that the printed number is a rounding of; None if it is of none.

    Args:
        digits: a decimal number, rad.
    """
    count = count_twelfths(digits)
    return None if count is None else format_pi_multiple(Fraction(count, 12))


def count_twelfths(digits: str) -> int | None:
    """Returns how many twelfths of pi the printed number rounds; None if no whole number.

    `1.5708`, `1.571`, `1.57080` and the cut-off `3.1415` are: from the multiple to the number it
    is half a unit of its last digit, or towards 0 a whole one. Zeros at the end are taken for
    padding as long as enough decimals are left without them.

    Args:
        digits: a decimal number, rad.
    """
    number = abs(Decimal(digits))
    count = round(float(number) / (math.pi / 12))
    if count == 0 or count > 24:
        return None
    coarse = count % 6 == 0
    least = THRESHOLDS.min_coarse_angle_decimals if coarse else THRESHOLDS.min_fine_angle_decimals
    decimals = _count_decimals(number.normalize())
    if decimals < least:
        decimals = _count_decimals(number)
    if decimals < least:
        return None
    unit = 10.0 ** -min(decimals, 15)
    if not -unit <= float(number) - count * math.pi / 12 <= unit / 2:
        return None
    return -count if digits.startswith("-") else count


def compute_cosine_sine(angle: float) -> tuple[float, float]:
    """Returns cosine and sine, exact for multiples of pi/12: cos pi/2 is 0."""
    count = round(angle * 12 / math.pi)
    if abs(angle - count * math.pi / 12) > 2 * math.ulp(max(1.0, abs(angle))):
        return math.cos(angle), math.sin(angle)
    return _compute_twelfth_sine(count + 6), _compute_twelfth_sine(count)


def _compute_twelfth_sine(count: int) -> float:
    half, place = divmod(count % 24, 12)
    return (-1.0 if half and place else 1.0) * _SINES[min(place, 12 - place)]


def _count_decimals(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    assert isinstance(exponent, int)
    return -exponent


def recognise_angle_terms(tree: ast.expr, rounded: dict[str, str]) -> ast.expr:
    """Returns the angle with its decimal terms, and whole multiples of such, put as what they mean.

    Args:
        tree: of Python's arithmetic.
        rounded: grows by digits -> multiple, for what was put.
    """
    if isinstance(tree, ast.BinOp):
        sides = (tree.left, tree.right)
        whole = [isinstance(s, ast.Constant) and isinstance(s.value, int) for s in sides]
        if isinstance(tree.op, ast.Add | ast.Sub) or any(whole):
            left, right = (recognise_angle_terms(side, rounded) for side in sides)
            return ast.BinOp(left, tree.op, right)
    minus = isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub)
    number = tree.operand if isinstance(tree, ast.UnaryOp) else tree
    if isinstance(number, ast.Constant) and isinstance(number.value, float):
        digits = f"{'-' if minus else ''}{number.value!r}"
        angle = recognise_angle(digits)
        if angle is not None:
            rounded[digits] = angle
            return ast.parse(angle, mode="eval").body
    elif isinstance(tree, ast.UnaryOp):
        return ast.UnaryOp(tree.op, recognise_angle_terms(tree.operand, rounded))
    return tree


def describe_rounded_angles(rounded: dict[str, str]) -> str:
    """Returns what to show of them."""
    return "rounded angles are exact here: " + ", ".join(f"{d} is {a}" for d, a in rounded.items())


def format_pi_multiple(turns: Fraction) -> str:
    """Returns `turns` times pi as text: `pi/2`, `-pi`, `3*pi/4`, `0`."""
    if turns == 0:
        return "0"
    head = "" if abs(turns.numerator) == 1 else f"{abs(turns.numerator)}*"
    tail = "" if turns.denominator == 1 else f"/{turns.denominator}"
    return f"{'-' if turns < 0 else ''}{head}pi{tail}"


# Single values of a robot file: expressions, numbers, names, lists.


# Expressions that are linear in the joint variables, taken apart.


class NotLinear(ArithmeticError):
    """The expression is not linear in the variables."""


class HighPower(ArithmeticError):
    """An exponent beyond `LARGEST_EXPONENT`."""


@dataclass(frozen=True)
class Linear:
    """constant + sum of coefficient * variable."""

    constant: float
    coefficients: Mapping[str, float] = field(default_factory=dict)

    def __add__(self, other: "Linear") -> "Linear":
        names = {**self.coefficients, **other.coefficients}
        return Linear(
            self.constant + other.constant,
            {n: self.coefficients.get(n, 0.0) + other.coefficients.get(n, 0.0) for n in names},
        )

    def __neg__(self) -> "Linear":
        return self._multiply_by(-1.0)

    def __sub__(self, other: "Linear") -> "Linear":
        return self + -other

    def __mul__(self, other: "Linear") -> "Linear":
        if self.coefficients and other.coefficients:
            raise NotLinear
        if self.coefficients:
            return self._multiply_by(other.constant)
        return other._multiply_by(self.constant)

    def __truediv__(self, other: "Linear") -> "Linear":
        if other.coefficients:
            raise NotLinear
        if other.constant == 0.0:
            raise ZeroDivisionError
        shares = {name: c / other.constant for name, c in self.coefficients.items()}
        return Linear(self.constant / other.constant, shares)

    def __pow__(self, exponent: "Linear | int") -> "Linear":
        power = exponent if isinstance(exponent, int) else exponent._get_constant()
        if abs(power) > LARGEST_EXPONENT:
            raise HighPower
        value = compute_power(self._get_constant(), power)
        if isinstance(value, complex):
            raise ArithmeticError
        return Linear(float(value))

    def _multiply_by(self, factor: float) -> "Linear":
        return Linear(self.constant * factor, {n: c * factor for n, c in self.coefficients.items()})

    def _get_constant(self) -> float:
        if self.coefficients:
            raise NotLinear
        return self.constant


def extract_linear_form(expression: Expression, symbols: Values) -> Linear:
    """Returns expression as constant + sum of coefficient * variable; zero coefficients left out.

    Every name that is not among `symbols` is a variable.

    Raises:
        NotLinear: a variable stands in a product, a power or a function.
        HighPower: an exponent is beyond `LARGEST_EXPONENT`.
        ArithmeticError: division by zero, overflow, or no real value.
    """
    values = {name: Linear(0.0, {name: 1.0}) for name in expression.names}
    values |= {name: Linear(symbols[name]) for name in expression.names if name in symbols}
    form = expression.fold(values, _LIFTED, Linear(math.pi), lambda value: Linear(float(value)))
    form = Linear(form.constant, {n: c for n, c in form.coefficients.items() if c != 0.0})
    if not all(map(math.isfinite, (form.constant, *form.coefficients.values()))):
        raise OverflowError
    return form


def _lift_function(name: str) -> Callable[["Linear"], "Linear"]:
    function = ROUNDED[name]

    def apply_function(argument: Linear) -> Linear:
        try:
            return Linear(function(argument._get_constant()))
        except ValueError as error:  # sqrt(-1)
            raise ArithmeticError from error

    return apply_function


_LIFTED = {name: _lift_function(name) for name in FUNCTIONS}


LARGEST_LENGTH = 1e4
"""m, and of an acceleration of gravity, m/s2. Beside it a link of a few cm is lost in rounding."""

_MEASURED = {"rad": "an angle", "m": "a length"}
_QUARTER = math.pi / 2


def read_linear_form(
    expression: Expression, symbols: Values, place: TomlCell, example: str = "q5 + q6"
) -> Linear:
    """Returns the expression as a linear form in the names that are not among `symbols`.

    Raises:
        RobotError: not linear, or without a value (division by zero, overflow).
    """
    try:
        form = extract_linear_form(expression, symbols)
    except NotLinear:
        raise place.make_error(
            f"got {quote_value(expression.text)}, which is not linear in its variables; "
            f"expected a sum such as {quote_value(example)}"
        ) from None
    except HighPower:
        raise place.make_error(
            f"got {quote_value(expression.text)}, with a larger exponent; expected at most "
            f"{LARGEST_EXPONENT}: check the symbols in it"
        ) from None
    except ArithmeticError:
        raise place.make_error(
            f"got {quote_value(expression.text)}, which has no finite real value with the declared "
            "symbols; check the divisors, roots and powers"
        ) from None
    check_size(expression, (form.constant, *form.coefficients.values()), LARGEST, place)
    return form


def read_joint_sum(
    expression: Expression,
    symbols: Values,
    variables: Collection[str],
    place: TomlCell,
    example: str,
    only: str = "",
) -> Linear:
    """Returns the expression as a sum of joint variables, none of which is turned far up or down.

    Args:
        expression: of symbols and variables.
        symbols: their values.
        variables: names of the joint variables that may stand there.
        place: of the expression.
        example: of such a sum.
        only: what to say of a constant in it; empty where there may be one.

    Raises:
        RobotError: an unknown name, not linear, too large a coefficient, a constant.
    """
    check_declared(expression, {**symbols, **dict.fromkeys(variables, 0.0)}, place)
    form = read_linear_form(expression, symbols, place, example)
    check_size(expression, form.coefficients.values(), THRESHOLDS.max_joint_ratio, place)
    if only and form.constant != 0.0:
        raise place.make_error(
            f"got {quote_value(expression.text)}, with the constant {form.constant:g}; expected a "
            f"sum of joint variables only{only}"
        )
    return form


def read_length(expression: Expression, symbols: Values, place: TomlCell) -> float:
    """Returns value of a constant that is a length, m, or an acceleration of gravity, m/s2.

    Raises:
        RobotError: no finite value, or one beyond `LARGEST_LENGTH`.
    """
    constant = read_linear_form(expression, symbols, place).constant
    check_size(expression, (constant,), LARGEST_LENGTH, place)
    return constant


def check_size(
    expression: Expression, values: Iterable[float], most: float, place: TomlCell
) -> None:
    """Refuses values beyond `most`.

    Raises:
        RobotError: names the expression and its value.
    """
    for value in values:
        if abs(value) > most:
            raise place.make_error(
                f"got {quote_value(expression.text)}, which is {value:.4g}; expected at most "
                f"{most:g} in SI units: check the units, the divisors and the symbols in it"
            )


def check_count(count: int, most: int, what: str, place: TomlCell) -> None:
    """Refuses more of them than a table may have.

    Raises:
        RobotError: says how many there are.
    """
    if count > most:  # before any work that nobody could wait for
        raise place.make_error(
            f"got {count} {what}; expected at most {most}: model parts of the robot in files of "
            "their own"
        )


def check_declared(expression: Expression, known: Mapping[str, Any], place: TomlCell) -> None:
    """Refuses names that are not known: declared symbols, and joint variables where they may stand.

    Raises:
        RobotError: names the first undeclared one and those it looks like.
    """
    for name in sorted(expression.names):
        if name not in known:
            advice = suggest_name(name, known) or "; declare it in [symbols] with its value"
            raise place.make_error(
                f"got {quote_value(expression.text)}: {name} is not declared; expected numbers or "
                f"names among {join_names(list(known)[:12])}{advice}"
            )


def check_unit(
    expression: Expression, of: Mapping[str, Collection[str]], unit: str, place: TomlCell
) -> None:
    """Refuses a length where an angle stands, and an angle where a length stands.

    Args:
        expression: what stands there.
        of: what its symbols are measured in; see `Expression.infer_units`.
        unit: expected, rad or m.
        place: of the expression.

    Raises:
        RobotError: all that is in it is measured in the other unit.
    """
    other = {"rad": "m", "m": "rad"}.get(unit, "")
    if expression.infer_units(of) == {other}:
        raise place.make_error(
            f"got {quote_value(expression.text)}, {_MEASURED[other]}; expected {_MEASURED[unit]}, "
            f"{unit}: are two columns or entries swapped?"
        )


def read_number(place: TomlCell, symbols: Values, unit: str = "") -> float:
    """Returns the cell as a number, in `unit`; it may be an expression of the declared symbols.

    Raises:
        RobotError: not a number, or a name that is not declared.
    """
    expression = place.read_expression()
    check_unit(expression, {}, unit, place)
    check_declared(expression, symbols, place)
    return read_linear_form(expression, symbols, place).constant


def normalise_row_name(value: Any) -> Any:
    """Returns a row number without quotes as its name, 1 as "1"; anything else as it is."""
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 10**6:
        return str(value)
    return value


def choose_robot_name(*candidates: str) -> str:
    """Returns the first of these with the letters that names may have; `robot` if none has any."""
    for candidate in candidates:
        plain = unicodedata.normalize("NFKD", candidate).encode("ascii", "ignore").decode()
        name = re.sub(r"[^A-Za-z0-9_-]+", "-", plain).strip("-_")
        if name:
            return name
    return "robot"


def check_name_length(name: str, place: TomlCell) -> None:
    """Refuses a name of more than `THRESHOLDS.max_name_length`.

    Raises:
        RobotError: says how long it is.
    """
    if len(name) > THRESHOLDS.max_name_length:
        raise place.make_error(
            f"got the name {quote_value(name)} of {len(name)} letters; expected at most "
            f"{THRESHOLDS.max_name_length} (it becomes part of names in the C code)"
        )


def read_exact_angle(
    expression: Expression, variable: str | None, place: TomlCell, rounded: dict[str, str]
) -> Expression:
    """Returns the angle with decimals that are multiples of pi put as exactly these.

    `1.5707963267948966` becomes `pi/2`; so does `1.57`, which is reported. Rounding of the sine and
    cosine would otherwise hide relations between parameters. Symbols keep their values.

    Args:
        expression: of symbols and the variable.
        variable: of the joint, if it may stand there.
        place: of the expression.
        rounded: grows by digits -> multiple, for what has to be reported.

    Raises:
        RobotError: degrees.
    """
    if not expression.names - {variable}:
        form = read_linear_form(expression, {}, place)
        if abs(form.constant) > 4 * _QUARTER + THRESHOLDS.max_right_angle_rounding:
            raise place.make_error(
                f"got {quote_value(expression.text)}: {form.constant:g} rad is more than a turn; "
                'angles are in radians, write "90 deg" or "pi/2" for 90 degrees'
            )
        turns = round(form.constant / _QUARTER)
        is_right = abs(form.constant - turns * _QUARTER) <= THRESHOLDS.max_right_angle_rounding
        if is_right and not expression.uses_pi:
            multiple = format_pi_multiple(Fraction(turns, 2))
            if not form.coefficients:
                return parse_expression(multiple)
            head = f"{variable}" if form.coefficients[variable or ""] > 0 else f"-{variable}"
            angle = f"{head} + {multiple}".replace("+ -", "- ").removesuffix(" + 0")
            return parse_expression(angle)
    return expression.rewrite(lambda tree: recognise_angle_terms(tree, rounded))


# The `[symbols]` table and the gravity of a robot file.


Solved = tuple[dict[str, Expression], dict[str, float]]
"""Symbols and their values."""
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
# Symbols become names in C.
C_WORDS = """
    auto break case char const continue default do double else enum extern float for goto if
    inline int long register restrict return short signed sizeof static struct switch typedef
    union unsigned void volatile while
"""


def read_symbols(place: TomlCell, variables: Collection[str]) -> Solved:
    """Reads symbols and their values, each after those that its value uses.

    Args:
        place: the table.
        variables: names of the joint variables, which symbols must not shadow.

    Raises:
        RobotError: a bad name, a value that is no number, a circle of values.
    """
    table = place.read_table("[symbols] D3 = 0.45")
    symbols = {}
    for name, cell in table.items():
        if not _NAME.fullmatch(name):
            raise place.make_error(
                f"got the name {quote_value(name)}; expected a letter, then letters, digits or _, "
                "such as D3"
            )
        check_name_length(name, place)
        taken = {
            "a joint variable": name in variables,
            "the number pi": name == "pi",
            "a function": name in FUNCTIONS,
            "a word of the C language": name in C_WORDS.split(),
            "a word of the expression language": keyword.iskeyword(name),
        }
        for what, is_taken in taken.items():
            if is_taken:
                word = quote_value(name)
                raise place.make_error(f"{word} is the name of {what}; choose another name")
        symbols[name] = place.enter(name, cell).read_expression()
        check_declared(symbols[name], table, place.enter(name))
    return _resolve_symbols(symbols, place)


def read_gravity(
    place: TomlCell, variables: Collection[str], symbols: Values
) -> tuple[Expression, Expression, Expression]:
    """Returns acceleration of gravity in frame 0, m/s2.

    Raises:
        RobotError: not three entries, or entries that are not constants.
    """
    gravity = []
    for number, cell in enumerate(place.read_list('[0, 0, "-g"]', length=3), start=1):
        here = place.enter(f"entry {number}", cell)
        expression = here.read_expression()
        moving = sorted(expression.names & set(variables))
        if moving:
            raise here.make_error(
                f"got {quote_value(expression.text)}, which uses the joint variable {moving[0]}; "
                "gravity is constant in frame 0: expected numbers and symbols"
            )
        check_declared(expression, symbols, here)
        read_length(expression, symbols, here)
        gravity.append(expression)
    x, y, z = gravity
    return x, y, z


def _resolve_symbols(symbols: Mapping[str, Expression], place: TomlCell) -> Solved:
    ordered: dict[str, Expression] = {}
    values: dict[str, float] = {}
    waiting = dict(symbols)
    while waiting:
        ready = next((n for n, e in waiting.items() if e.names <= ordered.keys()), None)
        if ready is None:
            names = ", ".join(waiting)
            names = ", ".join(waiting)
            what = "refer to each other in a circle; give one of them a number"
            raise place.make_error(f"the values of {names} {what}")
        ordered[ready] = waiting.pop(ready)
        values[ready] = read_linear_form(ordered[ready], values, place.enter(ready)).constant
    return ordered, values
