"""Single values of a robot file: expressions, numbers, names, lists."""

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any

from modeler.core.expression import LARGEST_EXPONENT, Expression, ExpressionError, parse
from modeler.robot.linear import HighPower, Linear, NotLinear, linear_form
from modeler.robot.place import Place, listed, near, shown

LARGEST = 1e12
"""Size of any number, in SI units: squares and products of larger ones leave double precision."""
LARGEST_LENGTH = 1e4
"""m, and of an acceleration of gravity, m/s2. Beside it a link of a few cm is lost in rounding."""
LARGEST_RATIO = 1e4
"""Of the motion of a joint or motor and that of a joint which it follows."""
MOST_NAME_LETTERS = 63
"""Of a name that goes into C, which tells names apart by as many letters (C99, 5.2.4.1)."""

_QUARTER = math.pi / 2
_EXACT = 1e-9  # rad; nearer to a multiple of pi/2 than this is that multiple
_ROUNDED = 5e-3  # rad; nearer than this, and written with few digits: 1.57, 3.14


def expression_at(value: Any, place: Place) -> Expression:
    """The cell as an `Expression`; names are not checked.

    Raises:
        RobotError: not a number or an expression.
    """
    try:
        return parse(value)
    except ExpressionError as error:
        told = str(error)
        if isinstance(value, str):
            told = told.replace(f'"{value.strip()}"', shown(value.strip()))
        raise place.error(told) from None


def form_at(
    expression: Expression,
    symbols: Mapping[str, float],
    place: Place,
    example: str = "q5 + q6",
) -> Linear:
    """The expression as a linear form in the names that are not among `symbols`.

    Raises:
        RobotError: not linear, or without a value (division by zero, overflow).
    """
    try:
        form = linear_form(expression, symbols)
    except NotLinear:
        raise place.error(
            f"got {shown(expression.text)}, which is not linear in its variables; "
            f"expected a sum such as {shown(example)}"
        ) from None
    except HighPower:
        raise place.error(
            f"got {shown(expression.text)}, with a larger exponent; expected at most "
            f"{LARGEST_EXPONENT}: check the symbols in it"
        ) from None
    except ArithmeticError:
        raise place.error(
            f"got {shown(expression.text)}, which has no finite real value with the declared "
            "symbols; check the divisors, roots and powers"
        ) from None
    check_size(expression, (form.constant, *form.coefficients.values()), LARGEST, place)
    return form


def length_at(expression: Expression, symbols: Mapping[str, float], place: Place) -> float:
    """Value of a constant that is a length, m, or an acceleration of gravity, m/s2.

    Raises:
        RobotError: no finite value, or one beyond `LARGEST_LENGTH`.
    """
    constant = form_at(expression, symbols, place).constant
    check_size(expression, (constant,), LARGEST_LENGTH, place)
    return constant


def check_size(expression: Expression, values: Iterable[float], most: float, place: Place) -> None:
    """Refuse values beyond `most`.

    Raises:
        RobotError: names the expression and its value.
    """
    for value in values:
        if abs(value) > most:
            raise place.error(
                f"got {shown(expression.text)}, which is {value:.4g}; expected at most {most:g} in "
                "SI units: check the units, the divisors and the symbols in it"
            )


def check_declared(expression: Expression, known: Mapping[str, Any], place: Place) -> None:
    """Refuse names that are not known: declared symbols, and joint variables where they may stand.

    Raises:
        RobotError: names the first undeclared one and those it looks like.
    """
    for name in sorted(expression.names):
        if name not in known:
            advice = near(name, known) or "; declare it in [symbols] with its value"
            raise place.error(
                f"got {shown(expression.text)}: {name} is not declared; expected numbers or names "
                f"among {listed(list(known)[:12])}{advice}"
            )


def number_at(value: Any, symbols: Mapping[str, float], place: Place) -> float:
    """The cell as a number; it may be an expression of the declared symbols.

    Raises:
        RobotError: not a number, or a name that is not declared.
    """
    expression = expression_at(value, place)
    check_declared(expression, symbols, place)
    return form_at(expression, symbols, place).constant


def plain_number(value: Any, place: Place, example: str) -> float:
    """A finite number, not an expression.

    Raises:
        RobotError: anything else.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise place.error(f"got {shown(value)}; expected a number such as {example}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise place.error(f"got {shown(value)}; expected a finite number such as {example}")
    if abs(number) > LARGEST:
        raise place.error(
            f"got {shown(value)}; expected at most {LARGEST:g} in SI units, such as {example}"
        )
    return number


def table_at(value: Any, place: Place, example: str) -> dict[str, Any]:
    """A TOML table.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, dict):
        raise place.error(f"got {shown(value)}; expected a table, as in {example}")
    return value


def list_at(value: Any, place: Place, example: str, length: int | None = None) -> list[Any]:
    """A TOML array, of `length` entries if that is given.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, list):
        raise place.error(f"got {shown(value)}; expected a list such as {example}")
    if length is not None and len(value) != length:
        raise place.error(
            f"got {len(value)} entries, expected {length}, as in {example}; "
            f"{'add' if len(value) < length else 'remove'} {abs(len(value) - length)}"
        )
    return value


def text_at(value: Any, place: Place, example: str) -> str:
    """A TOML string that is not empty.

    Raises:
        RobotError: anything else.
    """
    if not isinstance(value, str) or not value.strip():
        raise place.error(f"got {shown(value)}; expected text such as {example}")
    return value


def name_of(value: Any) -> Any:
    """A row number that stands without quotes as its name: 1 as "1"; anything else as it is."""
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 10**6:
        return str(value)
    return value


def check_name_length(name: str, place: Place) -> None:
    """Refuse a name of more than `MOST_NAME_LETTERS`.

    Raises:
        RobotError: says how long it is.
    """
    if len(name) > MOST_NAME_LETTERS:
        raise place.error(
            f"got the name {shown(name)} of {len(name)} letters; expected at most "
            f"{MOST_NAME_LETTERS} (it becomes part of names in the C code)"
        )


def exact_angle(expression: Expression, variable: str | None, place: Place) -> Expression:
    """The angle with a decimal multiple of pi/2 put as exactly that multiple.

    `1.5707963267948966` becomes `pi/2`; `q1 - 1.5707963267948966` becomes `q1 - pi/2`. Rounding
    of the sine and cosine would otherwise hide relations between parameters. Symbols keep their
    values.

    Raises:
        RobotError: a rounded multiple (1.57), or degrees.
    """
    if expression.names - {variable}:
        return expression
    form = form_at(expression, {}, place)
    turns = round(form.constant / _QUARTER)
    error = abs(form.constant - turns * _QUARTER)
    if abs(form.constant) > 4 * _QUARTER + _EXACT:
        raise place.error(
            f"got {shown(expression.text)}: {form.constant:g} rad is more than a turn; angles are "
            'in radians, write "pi/2" for 90 degrees'
        )
    if "pi" in re.findall(r"[A-Za-z_]\w*", expression.text):
        return expression
    if error <= _EXACT:
        return _with_quarters(form, variable, turns)
    multiple = _quarters(turns)
    if turns != 0 and error <= min(_ROUNDED, _last_digit(expression.text)):
        raise place.error(
            f"got {shown(expression.text)}, a rounded {multiple}; write {multiple} where the angle "
            "is exact, or declare a measured angle among [symbols] and use its name"
        )
    return expression


def _with_quarters(form: Linear, variable: str | None, turns: int) -> Expression:
    if not form.coefficients:
        return parse(_quarters(turns))
    head = f"{variable}" if form.coefficients[variable or ""] > 0 else f"-{variable}"
    if turns == 0:
        return parse(head)
    return parse(f"{head} {'-' if turns < 0 else '+'} {_quarters(abs(turns))}")


def _quarters(turns: int) -> str:
    """`turns` times pi/2 as text: `0`, `pi/2`, `-pi`, `3*pi/2`."""
    if turns == 0:
        return "0"
    sign = "-" if turns < 0 else ""
    size = abs(turns)
    count, half = (size // 2, "") if size % 2 == 0 else (size, "/2")
    return f"{sign}{'' if count == 1 else f'{count}*'}pi{half}"


def _last_digit(text: str) -> float:
    """One unit of the last decimal that is written: 0.01 for 1.57."""
    decimals = [len(digits) for digits in re.findall(r"\.(\d*)", text)]
    return 10.0 ** -max(decimals, default=0)
