"""Numbers and sets of names that a paper's line is compared with: a small arithmetic.

`count(zero("*11"))`, `count(base) - 3`, `100*b/abs(a)`: names, calls, sums and products, and
comparisons for what must hold.
"""

import ast
import itertools
import math
import operator
from collections.abc import Callable, Mapping
from fnmatch import fnmatchcase
from typing import Any

import sympy

from modeler.papers.derived import Derived
from modeler.papers.quotation import QuotationError

_BINARY: Mapping[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv, ast.Pow: operator.pow, ast.Mod: operator.mod,
}  # fmt: skip
_COMPARED: Mapping[type, Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge,
    ast.Eq: operator.eq,
}  # fmt: skip


def evaluate(text: str, values: Mapping[str, Any]) -> Any:
    """The value of an expression.

    Args:
        text: of the language above.
        values: of its names; functions are values too.

    Raises:
        QuotationError: it asks for what there is not.
    """
    return _walk(ast.parse(text, mode="eval").body, values, text)


def _walk(node: ast.expr, values: Mapping[str, Any], text: str) -> Any:
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name) and node.id in values:
        return values[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_walk(node.operand, values, text)
    if isinstance(node, ast.BinOp):
        left, right = (_walk(side, values, text) for side in (node.left, node.right))
        return _BINARY[type(node.op)](left, right)
    if isinstance(node, ast.Compare):
        chain = [_walk(part, values, text) for part in (node.left, *node.comparators)]
        steps = zip(node.ops, chain, chain[1:], strict=False)
        return all(_COMPARED[type(op)](a, b) for op, a, b in steps)
    if isinstance(node, ast.Call):
        arguments = [_walk(argument, values, text) for argument in node.args]
        return _walk(node.func, values, text)(*arguments)
    raise QuotationError(f'"{text}" asks for {ast.unparse(node)}, which is not known here')


_ARITHMETIC: Mapping[str, Any] = {
    "abs": abs, "pi": math.pi, "count": len,
    "mean": lambda *x: sum(x) / len(x),
    "falling": lambda *x: all(a >= b for a, b in itertools.pairwise(x)),
}  # fmt: skip


def quantities(derived: Derived) -> dict[str, Any]:
    """What can be asked of a robot: sets of names, by pattern, and what counts them.

    `standard`, `base`, `zero` (without effect), `grouped` (neither base nor zero), `joints`,
    `actuated`, `passive` (of the table, the platform's left out), `links`; `within(a, b)`: what of
    a is grouped with b.
    """
    robot, base = derived.robot, derived.base
    joints = [joint for joint in robot.moving if joint.name not in robot.platform]
    zero = frozenset(base.unidentifiable)
    standard = frozenset(derived.standard)
    sets: dict[str, frozenset[str]] = {
        "standard": standard,
        "base": frozenset(derived.relations),
        "zero": zero,
        "grouped": standard - zero - derived.kept,
        "joints": frozenset(joint.name for joint in joints),
        "actuated": frozenset(joint.name for joint in joints if joint.actuated),
        "passive": frozenset(joint.name for joint in joints if not joint.actuated),
        "links": frozenset(
            robot.joints[c.row].name for c in base.columns if c.kind == "inertial"
        ),
    }  # fmt: skip
    found = {**_ARITHMETIC, **{name: _pattern(members) for name, members in sets.items()}}
    found["prefix"] = lambda names: frozenset(
        column.prefix for column in base.columns if column.name in names
    )
    found["efforts"] = lambda names: frozenset(f"Gamma{name}" for name in names)
    found["within"] = lambda own, others: _within(derived, own, others)
    found["terms"] = lambda name: len(derived.relations.get(name, ()))
    return found | (_coefficients(derived) if robot.physical else {})


def _pattern(members: frozenset[str]) -> Callable[..., frozenset[str]]:
    def chosen(*patterns: str) -> frozenset[str]:
        if not patterns:
            return members
        return frozenset(n for n in members if any(fnmatchcase(n, p) for p in patterns))

    return chosen


def _within(derived: Derived, own: frozenset[str], others: frozenset[str]) -> frozenset[str]:
    """What of `own` is grouped and a combination of `others` and of what is kept of `own`."""
    columns = derived.grouping
    basis = [columns[name] for name in sorted(others | (own & derived.kept)) if any(columns[name])]
    rank = sympy.Matrix(basis).rank()
    grouped = (name for name in own - derived.kept if any(columns[name]))
    return frozenset(n for n in grouped if sympy.Matrix([*basis, columns[n]]).rank() == rank)


def _coefficients(derived: Derived) -> dict[str, Any]:
    """Of a robot whose links have a paper's letters."""
    table = derived.table
    known = table.identifiability
    return {
        "coefficients": len(table.coefficients),
        "independent": len(table.relations.independent),
        "letters": len(known.letters),
        "appearing": len(known.appearing),
        "vanishing": frozenset(known.vanishing),
        "identifiable": known.jacobian_rank,
        "missing": lambda letter: _missing(derived, letter),
        "monomials": lambda name: sum(c.function == name for c in table.coefficients),
    }


def _missing(derived: Derived, letter: str) -> frozenset[str]:
    """Functions that are zero: S_ijk with j > k by convention, and those that vanish."""
    names = [joint.name for joint in derived.robot.moving]
    every = {letter + i + j + k for i in names for j in names for k in names}
    return frozenset(every - set(derived.table.closed.by_name))
