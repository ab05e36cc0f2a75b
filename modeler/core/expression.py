"""Expressions of robot files and effect equations, learned laws, exactly rounded functions."""

import ast
import math
import operator
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

_DIGITS = 40


@cache
def get_precise_context() -> Any:
    """Returns arithmetic with 40 digits, a context of mpmath of its own.

    No global precision is touched.
    """
    # Only here: most robot files have no sine among their numbers.
    import mpmath

    context = mpmath.MPContext()
    context.dps = _DIGITS
    return context


def compute_power(base: float, exponent: float) -> Any:
    """Returns the double next to base**exponent.

    What Python gives where that is no finite real number.

    Raises:
        ArithmeticError: 0 to a negative power, or an overflow.
    """
    rough = base**exponent
    if isinstance(rough, complex) or not math.isfinite(rough):
        return rough
    return float(
        get_precise_context().power(
            get_precise_context().mpf(base), get_precise_context().mpf(exponent)
        )
    )


def _round_function(name: str, rough: Callable[[float], float]) -> Callable[[float], float]:
    def evaluate(x: float) -> float:
        value = rough(x)  # raises what an argument outside the domain raises
        if not math.isfinite(value):
            return value
        return float(getattr(get_precise_context(), name)(get_precise_context().mpf(x)))

    return evaluate


ROUNDED: Mapping[str, Callable[[float], float]] = {
    "sin": _round_function("sin", math.sin),
    "cos": _round_function("cos", math.cos),
    "tan": _round_function("tan", math.tan),
    "sqrt": math.sqrt,
    "exp": _round_function("exp", math.exp),
    "abs": abs,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "tanh": _round_function("tanh", math.tanh),
}
"""The functions of the expression language, of doubles."""


# Expressions of robot files and effect equations, and laws that were learned.


BESIDE = 3
"""Coefficients along an axis more than cells."""

MOST = 10_000
"""Coefficients of a law."""


@dataclass(frozen=True)
class Law:
    """A table of one or two quantities; d axes.

    Attributes:
        low, high: (d,) ends of each axis, SI.
        cells: (d,) of equal width.
        values: (prod(cells + 3),) coefficients, the last axis first.
    """

    low: tuple[float, ...]
    high: tuple[float, ...]
    cells: tuple[int, ...]
    values: tuple[float, ...] = field(repr=False)

    @property
    def scales(self) -> tuple[float, ...]:
        """Returns the cells per unit, by axis."""
        ends = zip(self.low, self.high, self.cells, strict=True)
        return tuple(count / (high - low) for low, high, count in ends)

    @cached_property
    def coefficients(self) -> "np.ndarray":
        """Returns the coefficients, (cells + 3, ...) by axis."""
        import numpy as np  # robot files without laws do without it

        return np.array(self.values).reshape([count + BESIDE for count in self.cells])

    def __call__(self, *x: "np.ndarray | float", along: int | None = None) -> "np.ndarray":
        """Its values at x, arrays of one shape; not a number where one of x is not finite.

        Args:
            x: one for each axis.
            along: the derivative along this axis; None: the law itself.
        """
        import numpy as np

        every = np.broadcast_arrays(*x)
        places = [
            self.locate_cells(axis, points, along == axis) for axis, points in enumerate(every)
        ]
        total = np.zeros(every[0].shape)
        if len(places) == 1:
            ((k, weights),) = places
            for m, weight in enumerate(weights):
                total += weight * self.coefficients[k + m]
            return total
        (k, first), (l, second) = places
        for m, weight in enumerate(first):
            inner = sum(w * self.coefficients[k + m, l + n] for n, w in enumerate(second))
            total += weight * inner
        return total

    def locate_cells(
        self, axis: int, x: "np.ndarray", slope: bool = False
    ) -> tuple["np.ndarray", Sequence["np.ndarray"]]:
        """Returns the cell of each x (n,), and the weights of its four coefficients.

        Or their slopes.
        """
        import numpy as np

        scale, count = self.scales[axis], self.cells[axis]
        free = (x - self.low[axis]) * scale
        u = np.clip(free, 0.0, count)
        k = np.minimum(np.where(np.isnan(u), 0.0, u).astype(int), count - 1)
        with np.errstate(invalid="ignore"):
            f = u - k + (x - x)
        if not slope:
            return k, _compute_weights(f)
        rate = np.where(u == free, scale, 0.0)  # beyond the ends it is held
        return k, [rate * w for w in _compute_slopes(f)]


def _compute_weights(f: "np.ndarray") -> tuple["np.ndarray", ...]:
    g = 1.0 - f
    f2 = f * f
    first, last = g * g * g / 6.0, f2 * f / 6.0
    second = 2.0 / 3.0 - f2 + 0.5 * f2 * f
    return first, second, 1.0 - first - second - last, last


def _compute_slopes(f: "np.ndarray") -> tuple["np.ndarray", ...]:
    """Derivatives of the weights by f."""
    g = 1.0 - f
    first, second, last = -0.5 * g * g, f * (1.5 * f - 2.0), 0.5 * f * f
    return first, second, -first - second - last, last


# The little expression language of robot files and effect equations.
#
# `"q1 + pi/2"`, `"-b3"`, `"sqrt(a**2 + b**2)"`: numbers, names, `pi`, `+ - * / **`, parentheses and
# the functions below; `90 deg` is 90*pi/180, `60 mm` is 0.06. An `Expression` is parsed and checked
# once, and then folded over any algebra: numbers, numpy arrays, sympy, or the expression graph.


FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign", "tanh")
LAW = "law"
"""The function of a table, of as many arguments as the table has axes."""
_KNOWN = (*FUNCTIONS, LAW, "pi")
_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}

_PRINTED = str.maketrans({"\u2212": "-", "\u00b7": "*", "\u00d7": "*", "\u03c0": "pi"})
"""Signs of books as we write them."""
_LENGTHS = {"mm": "0.001", "cm": "0.01", "m": "1.0", "in": "0.0254"}
_MEASURED = re.compile(
    r"(\b\d[\d_.]*(?:[eE][+-]?\d+)?|\b[^\W\d]\w*(?=\s|°)|\))\s*(deg\b|°|(?:mm|cm|m|in)\b)"
)
"""What has a unit: a number, a name or a bracket before it."""
_CALL = re.compile(rf"\b(?:{'|'.join(FUNCTIONS)})\s*\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)")

MOST_LETTERS = 4000
MOST_OPERATIONS = 300
DEEPEST = 30
"""Parentheses, functions, powers and signs inside each other. Sums and products are not deep."""
LARGEST_EXPONENT = 100


class ExpressionError(ValueError):
    """What is wrong with the text, without its place; readers add file, row and column."""


@dataclass(frozen=True)
class Expression:
    """A checked expression; two are equal when their texts and their laws are equal.

    Attributes:
        text: as the user wrote it.
        names: the names it uses, `pi` and functions left out.
        law: what `law` stands for in it.
    """

    text: str
    names: frozenset[str]
    _tree: ast.expr = field(repr=False, compare=False)
    law: Law | None = None

    @property
    def uses_pi(self) -> bool:
        """Returns True if pi, or degrees, stand in it."""
        return any(isinstance(n, ast.Name) and n.id == "pi" for n in ast.walk(self._tree))

    @property
    def decimals(self) -> frozenset[Fraction]:
        """Returns the numbers with a decimal point in it, exactly."""
        nodes = (node for node in ast.walk(self._tree) if isinstance(node, ast.Constant))
        return frozenset(_parse_fraction(n, self.text) for n in nodes if isinstance(n.value, float))

    def rewrite(self, change: Callable[[ast.expr], ast.expr]) -> "Expression":
        """Returns the expression with a changed tree; itself if nothing was changed."""
        tree = change(self._tree)
        same = ast.dump(tree) == ast.dump(self._tree)
        return self if same else parse_expression(format_tree(tree), self.law)

    def infer_units(self, name_units: Mapping[str, Collection[str]]) -> set[str]:
        """Returns the units it is measured in: "rad" of degrees, "m".

        Not what stands in a function.

        Args:
            name_units: the same of the names in it.
        """
        outside = _CALL.sub("1", self.text)
        names = re.findall(r"[^\W\d]\w*", _MEASURED.sub(r"\1", outside))
        units = {"m" if unit in _LENGTHS else "rad" for _, unit in _MEASURED.findall(outside)}
        return units.union(*(name_units.get(name, ()) for name in names))

    @property
    def is_zero(self) -> bool:
        """Returns True if it is a number and that number is 0."""
        return not self.names and self.evaluate() == 0.0

    def evaluate(self, values: Mapping[str, float] | None = None) -> float:
        """Returns the value of the expression in floating point, with `values` for the names.

        The same on every machine.
        """
        return float(self.fold(values or {}, ROUNDED, math.pi, float, compute_power))

    def fold(
        self,
        values: Mapping[str, Any],
        functions: Mapping[str, Callable[..., Any]],
        pi: Any,
        constant: Callable[[Fraction], Any],
        power: Callable[[Any, Any], Any] = operator.pow,
    ) -> Any:
        """Evaluates over any algebra with Python operators.

        Args:
            values: what stands for each name.
            functions: what stands for each function of `FUNCTIONS` that is used; "law", of the law
                and its arguments, where it cannot be called with these.
            pi: what stands for pi.
            constant: turns an exact rational number into the algebra's constant.
            power: what stands for `**`; integer exponents stay Python integers.
        """
        every = dict(functions)
        if self.law is not None:
            law = every.get(LAW, Law.__call__)
            every[LAW] = partial(law, self.law)
        return _Algebra(self.text, values, every, pi, constant, power).evaluate(self._tree)


@dataclass(frozen=True, eq=False)
class _Algebra:
    """What the parts of an expression stand for.

    A class, for a function within another that calls itself would keep the values, arrays possibly,
    until the garbage is collected.
    """

    text: str
    values: Mapping[str, Any]
    functions: Mapping[str, Callable[..., Any]]
    pi: Any
    constant: Callable[[Fraction], Any]
    power: Callable[[Any, Any], Any]

    def evaluate(self, node: ast.expr) -> Any:
        """Returns the value of a part of an expression."""
        if isinstance(node, ast.Constant):
            return self.constant(_parse_fraction(node, self.text))
        if isinstance(node, ast.Name):
            return self.pi if node.id == "pi" else self.values[node.id]
        if isinstance(node, ast.UnaryOp):
            inner = self.evaluate(node.operand)
            return -inner if isinstance(node.op, ast.USub) else inner
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            return self.functions[node.func.id](*map(self.evaluate, node.args))
        assert isinstance(node, ast.BinOp)
        left = self.evaluate(node.left)
        if isinstance(node.op, ast.Pow):
            return self.power(left, _evaluate_exponent(node.right, self.evaluate))
        right = self.evaluate(node.right)
        return _BINARY[type(node.op)](left, right)


def parse_expression(value: str | int | float, law: Law | None = None) -> Expression:
    """Returns an `Expression` from a TOML cell (text or number).

    Args:
        value: the cell.
        law: what `law` stands for in it; None: there is none.

    Raises:
        ExpressionError: not a number or a valid expression; the message says what was got.
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ExpressionError(
            f'got {value!r}; expected a number or an expression such as "q1 + pi/2"'
        )
    if isinstance(value, float) and not math.isfinite(value):
        raise ExpressionError(f"got {value!r}; expected a finite number")
    try:
        text = value.strip() if isinstance(value, str) else repr(value)
    except ValueError:  # Python prints no integer of more than 4300 digits
        raise ExpressionError(
            "got a number of thousands of digits; expected a finite number"
        ) from None
    _check_text(text)
    try:
        spelled = _MEASURED.sub(_expand_unit, text.translate(_PRINTED))
        tree = ast.parse(spelled, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ExpressionError(
            f'got "{text}", which cannot be read; expected a number or an expression '
            'such as "q1 + pi/2"'
        ) from None
    _check_size(tree, text)
    names: set[str] = set()
    _check_node(tree, text, names, law)
    _check_exponents(tree, text)
    return Expression(text, frozenset(names), tree, law)


def _expand_unit(match: re.Match[str]) -> str:
    """`90*pi/180` of `90 deg`, `0.06` of `60 mm`; half an inch, `1/2*0.0254`, of `1/2 in`."""
    what, unit = match.groups()
    if unit not in _LENGTHS:
        return f"{what}*pi/180"
    if what[0].isdigit() and not match.string[: match.start()].rstrip().endswith(("/", "**", ".")):
        return repr(float(Fraction(repr(float(what))) * Fraction(_LENGTHS[unit])))
    return f"{what}*{_LENGTHS[unit]}"


def format_tree(tree: ast.expr) -> str:
    """Returns the expression of a tree as text: `b**2 + pi/2`."""
    return re.sub(r" (\*\*|\*|/) ", r"\1", ast.unparse(tree))


def format_decimal(value: Fraction, halves: bool = False) -> str | None:
    """Returns a number as an exact decimal, such as `0.1564`.

    None for a whole number and what has no end as a decimal, such as 1/3.

    Args:
        value: the number.
        halves: True to write 1/2, 3/4 and 5/8 as decimals too. They come from squared sines as
            often as from lengths: True where the file itself writes such numbers with a point.
    """
    rest, places = value.denominator, 0
    for prime in (2, 5):
        count = 0
        while rest % prime == 0:
            rest, count = rest // prime, count + 1
        places = max(places, count)
    if rest != 1 or places == 0 or not (halves or value.denominator % 5 == 0):
        return None
    digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
    return f"{'-' if value < 0 else ''}{digits[:-places]}.{digits[-places:]}"


def _check_text(text: str) -> None:
    """Refuse text that is too long, or too deep in parentheses, before it is parsed."""
    _check_count(len(text), MOST_LETTERS, "letters", text)
    depth = deepest = 0
    for letter in text:
        depth += (letter == "(") - (letter == ")")
        deepest = max(deepest, depth)
    if deepest > DEEPEST:
        raise ExpressionError(_describe_depth(text))


def _check_count(count: int, most: int, what: str, text: str) -> None:
    if count > most:
        raise ExpressionError(
            f'got "{text}" of {count} {what}; expected at most {most}: give its parts names in '
            "[symbols]"
        )


def _describe_depth(text: str) -> str:
    return (
        f'got "{text}", with parentheses, functions, powers or signs inside each other; expected '
        f"at most {DEEPEST}: give the inner ones names in [symbols]"
    )


def _check_size(tree: ast.expr, text: str) -> None:
    """Refuse trees that a recursion over them should not meet; itself without recursion."""
    count = 0
    left: list[tuple[ast.AST, int]] = [(tree, 0)]
    while left:
        node, depth = left.pop()
        if depth > DEEPEST:
            raise ExpressionError(_describe_depth(text))
        if not isinstance(node, ast.Constant | ast.Name):
            count += 1
        # The left side of a sum or product is the same sum or product: not deeper.
        chain = isinstance(node, ast.BinOp) and not isinstance(node.op, ast.Pow)
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.expr):
                same = chain and child is node.left  # type: ignore[attr-defined]
                left.append((child, depth + (not same)))
    _check_count(count, MOST_OPERATIONS, "operations", text)


def _check_exponents(tree: ast.expr, text: str) -> None:
    """Refuse exponents without names beyond `LARGEST_EXPONENT`: exact powers would fill memory."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Pow):
            continue
        if any(isinstance(n, ast.Name) and n.id not in _KNOWN for n in ast.walk(node.right)):
            continue
        try:
            size = abs(Expression(text, frozenset(), node.right).evaluate())
        except OverflowError:
            size = math.inf
        except (ArithmeticError, ValueError, TypeError):
            continue  # it has no value: reported where its value is requested
        if size > LARGEST_EXPONENT:
            raise ExpressionError(
                f'got "{text}", with an exponent of {size:.3g}; expected at most {LARGEST_EXPONENT}'
            )


def _check_node(node: ast.expr, text: str, names: set[str], law: Law | None) -> None:
    if isinstance(node, ast.Constant):
        _parse_fraction(node, text)
    elif isinstance(node, ast.Name):
        if node.id in FUNCTIONS or (law and node.id == LAW):
            raise ExpressionError(f'got "{text}": {node.id} needs an argument, as in {node.id}(x)')
        if node.id != "pi":
            names.add(node.id)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        _check_node(node.operand, text, names, law)
    elif isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        _check_node(node.left, text, names, law)
        _check_node(node.right, text, names, law)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        if node.func.id not in (*FUNCTIONS, *([LAW] if law else [])):
            table = ", and law of the table that stands under the key `law`" * (node.func.id == LAW)
            raise ExpressionError(
                f'got "{text}": no function {node.func.id}; there are {", ".join(FUNCTIONS)}{table}'
            )
        count = len(law.cells) if law and node.func.id == LAW else 1
        if len(node.args) != count or node.keywords:
            few = "one argument" if count == 1 else f"{count} arguments"
            raise ExpressionError(f'got "{text}": {node.func.id} takes {few}')
        for argument in node.args:
            _check_node(argument, text, names, law)
    else:
        hint = "; write powers as x**2" if "^" in text else ""
        raise ExpressionError(
            f'got "{text}", which is not arithmetic; expected numbers, names, + - * / ** and '
            f"{', '.join(FUNCTIONS)}{hint}"
        )


def _parse_fraction(node: ast.Constant, text: str) -> Fraction:
    if isinstance(node.value, bool) or not isinstance(node.value, int | float):
        raise ExpressionError(f'got "{text}": {node.value!r} is not a number')
    if isinstance(node.value, float) and not math.isfinite(node.value):  # 1e400 reads as inf
        raise ExpressionError(f'got "{text}": the number is too large; expected a finite number')
    return Fraction(repr(node.value))


def _evaluate_exponent(node: ast.expr, walk: Callable[[ast.expr], Any]) -> Any:
    sign, inner = 1, node
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        sign, inner = -1, node.operand
    if isinstance(inner, ast.Constant) and isinstance(inner.value, int):
        return sign * inner.value
    return walk(node)
