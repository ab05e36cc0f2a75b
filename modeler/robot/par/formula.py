"""Entries of a `.par` file as formulas: read in its spelling, written in that of robot files."""

import ast
import keyword
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from modeler.core.expression import FUNCTIONS, ExpressionError, parse
from modeler.robot.place import Place, shown

INVERSE: dict[str, Callable[..., float]] = {
    "atan2": math.atan2, "atan": math.atan, "acos": math.acos, "asin": math.asin,
}  # fmt: skip
"""Functions of `.par` files that robot files do not have."""

_FUNCTION = {name: name for name in (*FUNCTIONS, *INVERSE)} | {
    "arctan": "atan", "arctan2": "atan2", "arccos": "acos", "arcsin": "asin",
}  # fmt: skip
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:(?:[eE]|\*\^)[+-]?\d+)?"
_TOKEN = re.compile(rf"({_NUMBER})|([^\W\d]\w*)(\s*[(\[])?|(\*\*|\^|[-+*/()\[\],])|(\s+)|(.)")
_PLAIN = re.compile(rf"[+-]?\s*{_NUMBER}")


@dataclass(frozen=True)
class Formula:
    """A checked formula.

    Attributes:
        tree: of Python's arithmetic; functions are those of robot files and `INVERSE`.
        written: the entry as the file has it.
    """

    tree: ast.expr
    written: str

    @property
    def names(self) -> frozenset[str]:
        """The letters in it; pi and functions are none."""
        called = {id(n.func) for n in ast.walk(self.tree) if isinstance(n, ast.Call)}
        names = (n for n in ast.walk(self.tree) if isinstance(n, ast.Name) and id(n) not in called)
        return frozenset(name.id for name in names if name.id != "pi")

    @property
    def literal(self) -> str | None:
        """The number as its digits are written, if it is nothing but a number."""
        if not _PLAIN.fullmatch(self.written):
            return None
        return self.written.replace(" ", "").replace("*^", "e")

    @property
    def is_zero(self) -> bool:
        """True of 0 in any spelling."""
        return self.literal is not None and float(self.literal) == 0

    @property
    def text(self) -> str:
        """As robot files spell it."""
        return written(self.tree)

    def replaced(self, tree: ast.expr) -> "Formula":
        """Another formula in its place."""
        return Formula(tree, written(tree))


def written(tree: ast.expr) -> str:
    """The formula as text: `b**2 + pi/2`."""
    return re.sub(r" (\*\*|\*|/) ", r"\1", ast.unparse(tree))


def formula(entry: str, place: Place) -> Formula:
    """The formula of an entry: `-Pi/2`, `Sqrt[b^2 + d6^2]`, `0.45`.

    Raises:
        RobotError: it is none.
    """
    try:
        tree = ast.parse(_spelled(entry), mode="eval").body
        plain = _with_stand_ins(tree)
        parse(ast.unparse(plain))
    except (SyntaxError, ValueError, RecursionError, MemoryError, ExpressionError):
        raise place.error(
            f"got {shown(entry)}; expected a number, a letter, or arithmetic of these with "
            f"{', '.join(sorted({*FUNCTIONS, *INVERSE}))}"
        ) from None
    return Formula(tree, entry)


def value(tree: ast.expr, values: Mapping[str, float]) -> float:
    """The number that a formula without `INVERSE` functions is worth."""
    return parse(ast.unparse(tree)).number(values)


class Each(ast.NodeTransformer):
    """Replaces the calls of functions, innermost first."""

    def __init__(self, replace: Callable[[ast.Call], ast.expr]) -> None:
        self.replace = replace

    def visit_Call(self, node: ast.Call) -> ast.expr:
        """One call."""
        self.generic_visit(node)
        return self.replace(node)


def renamed(tree: ast.expr, names: Mapping[str, str]) -> ast.expr:
    """The formula with other names."""

    class Rename(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            return ast.Name(names.get(node.id, node.id), ast.Load())

    result: ast.expr = Rename().visit(ast.parse(ast.unparse(tree), mode="eval").body)
    return result


def _spelled(entry: str) -> str:
    """The entry in Python's spelling."""
    parts = []
    for number, name, opened, operator, space, other in _TOKEN.findall(entry):
        if other:
            raise ValueError(other)
        if number:
            parts.append(number.replace("*^", "e"))
        elif name:
            is_pi = name.lower() == "pi"
            known = _FUNCTION.get(name.lower()) if opened else None
            letter = f"{name}_" if keyword.iskeyword(name) else name
            parts.append(("pi" if is_pi else known or letter) + ("(" if opened else ""))
        else:
            parts.append({"^": "**", "[": "(", "]": ")"}.get(operator, operator) or space)
    return _two_arguments("".join(parts).strip())


def _two_arguments(text: str) -> str:
    """Mathematica's ArcTan[x, y] is atan2(y, x)."""

    def turned(call: ast.Call) -> ast.expr:
        if isinstance(call.func, ast.Name) and call.func.id == "atan" and len(call.args) == 2:
            return ast.Call(ast.Name("atan2", ast.Load()), call.args[::-1], [])
        return call

    if "atan(" not in text:
        return text
    return ast.unparse(Each(turned).visit(ast.parse(text, mode="eval").body))


def _with_stand_ins(tree: ast.expr) -> ast.expr:
    """The formula with functions that robot files have: to be checked by their grammar."""

    def plain(call: ast.Call) -> ast.expr:
        name = call.func.id if isinstance(call.func, ast.Name) else ""
        if name in INVERSE and not call.keywords:
            if len(call.args) != (2 if name == "atan2" else 1):
                raise ValueError(name)
            joined = call.args[0]
            for other in call.args[1:]:
                joined = ast.BinOp(joined, ast.Add(), other)
            return joined
        return call

    result: ast.expr = Each(plain).visit(ast.parse(ast.unparse(tree), mode="eval").body)
    return result
