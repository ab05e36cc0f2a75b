"""How large a constant becomes when it is written out, found without writing it out."""

from math import comb, prod

import sympy

MOST_TERMS = 1000
"""Terms of a constant written out as a sum of products."""
DEEPEST = 60
"""Operations inside each other, symbols that stand for expressions replaced by these."""
MOST_BITS = 10_000
"""Of an exact number."""


class TooLong(ArithmeticError):
    """Says what of a constant is too long, and the bound."""


def check_length(value: sympy.Expr) -> None:
    """Refuse constants that nobody could write out.

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
        terms = _terms(node, [known[arg][0] for arg in node.args])
        if depth > DEEPEST:
            raise TooLong(f"has more than {DEEPEST} operations inside each other")
        if terms > MOST_TERMS:
            raise TooLong(f"has {terms} terms when it is written out, more than {MOST_TERMS}")
        known[node] = terms, depth


def _terms(node: sympy.Basic, parts: list[int]) -> int:
    if isinstance(node, sympy.Add):
        return sum(parts)
    if isinstance(node, sympy.Mul):
        return prod(parts)
    if isinstance(node, sympy.Pow) and node.exp.is_Integer:
        n = abs(int(node.exp))
        return comb(n + parts[0] - 1, n) if n <= MOST_TERMS or parts[0] == 1 else n
    return 1


def power(base: sympy.Expr, exponent: sympy.Expr | int) -> sympy.Expr:
    """base**exponent.

    Raises:
        TooLong: an exact number of more than `MOST_BITS`.
    """
    exponent = sympy.sympify(exponent)
    if base.is_Rational and exponent.is_Rational:
        bits = max(int(base.p).bit_length(), int(base.q).bit_length()) * abs(exponent)
        if bits > MOST_BITS and base not in (0, 1, -1):
            raise TooLong(f"holds an exact number of {int(bits)} bits, more than {MOST_BITS}")
    return base**exponent
