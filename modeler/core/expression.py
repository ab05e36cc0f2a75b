"""The little expression language of robot files and effect equations.

`"q1 + pi/2"`, `"-b3"`, `"sqrt(a**2 + b**2)"`: numbers, names, `pi`, `+ - * / **`, parentheses and
the functions below. An `Expression` is parsed and checked once, and then folded over any algebra:
numbers, numpy arrays, sympy, or the expression graph.
"""

import ast
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign", "tanh")
_BINARY = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}


class ExpressionError(ValueError):
    """What is wrong with the text, without its place; readers add file, row and column."""


@dataclass(frozen=True)
class Expression:
    """A checked expression; two are equal when their texts are equal.

    Attributes:
        text: as the user wrote it.
        names: the names it uses, `pi` and functions left out.
    """

    text: str
    names: frozenset[str]
    _tree: ast.expr = field(repr=False, compare=False)

    @property
    def is_zero(self) -> bool:
        """True if it is a number and that number is 0."""
        return not self.names and self.number() == 0.0

    def number(self, values: Mapping[str, float] | None = None) -> float:
        """Its value in floating point, with `values` for the names."""
        functions: dict[str, Callable[[Any], Any]] = {
            "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt,
            "exp": math.exp, "abs": abs, "tanh": math.tanh,
            "sign": lambda x: float((x > 0) - (x < 0)),
        }  # fmt: skip
        return float(self.fold(values or {}, functions, math.pi, float))

    def fold(
        self,
        values: Mapping[str, Any],
        functions: Mapping[str, Callable[[Any], Any]],
        pi: Any,
        constant: Callable[[Fraction], Any],
    ) -> Any:
        """Evaluate over any algebra with Python operators.

        Args:
            values: what stands for each name.
            functions: what stands for each function of `FUNCTIONS` that is used.
            pi: what stands for pi.
            constant: turns an exact rational number into the algebra's constant. Integer
                exponents stay Python integers.
        """

        def walk(node: ast.expr) -> Any:
            if isinstance(node, ast.Constant):
                return constant(_exact(node, self.text))
            if isinstance(node, ast.Name):
                return pi if node.id == "pi" else values[node.id]
            if isinstance(node, ast.UnaryOp):
                inner = walk(node.operand)
                return -inner if isinstance(node.op, ast.USub) else inner
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                return functions[node.func.id](walk(node.args[0]))
            assert isinstance(node, ast.BinOp)
            left = walk(node.left)
            if isinstance(node.op, ast.Pow):
                return left ** _exponent(node.right, walk)
            right = walk(node.right)
            if isinstance(node.op, ast.Add):
                return left + right
            if isinstance(node.op, ast.Sub):
                return left - right
            return left * right if isinstance(node.op, ast.Mult) else left / right

        return walk(self._tree)


def parse(value: str | int | float) -> Expression:
    """An `Expression` from a TOML cell (text or number).

    Raises:
        ExpressionError: not a number or a valid expression; the message says what was got.
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ExpressionError(
            f'got {value!r}; expected a number or an expression such as "q1 + pi/2"'
        )
    if isinstance(value, float) and not math.isfinite(value):
        raise ExpressionError(f"got {value!r}; expected a finite number")
    text = value.strip() if isinstance(value, str) else repr(value)
    try:
        tree = ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ExpressionError(
            f'got "{text}", which cannot be read; expected a number or an expression '
            'such as "q1 + pi/2"'
        ) from None
    names: set[str] = set()
    _check(tree, text, names)
    return Expression(text, frozenset(names), tree)


def _check(node: ast.expr, text: str, names: set[str]) -> None:
    if isinstance(node, ast.Constant):
        _exact(node, text)
    elif isinstance(node, ast.Name):
        if node.id in FUNCTIONS:
            raise ExpressionError(f'got "{text}": {node.id} needs an argument, as in {node.id}(x)')
        if node.id != "pi":
            names.add(node.id)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        _check(node.operand, text, names)
    elif isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        _check(node.left, text, names)
        _check(node.right, text, names)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        if node.func.id not in FUNCTIONS:
            raise ExpressionError(
                f'got "{text}": no function {node.func.id}; there are {", ".join(FUNCTIONS)}'
            )
        if len(node.args) != 1 or node.keywords:
            raise ExpressionError(f'got "{text}": {node.func.id} takes one argument')
        _check(node.args[0], text, names)
    else:
        hint = "; write powers as x**2" if "^" in text else ""
        raise ExpressionError(
            f'got "{text}", which is not arithmetic; expected numbers, names, + - * / ** and '
            f"{', '.join(FUNCTIONS)}{hint}"
        )


def _exact(node: ast.Constant, text: str) -> Fraction:
    if isinstance(node.value, bool) or not isinstance(node.value, int | float):
        raise ExpressionError(f'got "{text}": {node.value!r} is not a number')
    if isinstance(node.value, float) and not math.isfinite(node.value):  # 1e400 reads as inf
        raise ExpressionError(f'got "{text}": the number is too large; expected a finite number')
    return Fraction(repr(node.value))


def _exponent(node: ast.expr, walk: Callable[[ast.expr], Any]) -> Any:
    sign, inner = 1, node
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        sign, inner = -1, node.operand
    if isinstance(inner, ast.Constant) and isinstance(inner.value, int):
        return sign * inner.value
    return walk(node)
