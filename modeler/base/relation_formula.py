"""A grouping relation as a formula that a page can set."""

import sympy

from modeler.base.relation_text import split_sign
from modeler.base.result import BaseParameter, Term
from modeler.core.formula import Formula, name, number, operator, row


def relation_formula(parameter: BaseParameter) -> tuple[Formula, ...]:
    """`ZZ2R =`, then one formula a term with its sign in front: a page may break between them."""
    lines = [row(name(parameter.name), operator("="))]
    for k, term in enumerate(parameter.terms):
        sign, size = split_sign(term.coefficient)
        head = (operator(sign or "+"),) if k or sign else ()
        lines.append(row(*head, *_product(size, term)))
    return tuple(lines)


def _product(size: sympy.Expr, term: Term) -> tuple[Formula, ...]:
    own = name(term.parameter)
    top, bottom = sympy.fraction(size)
    if bottom.free_symbols:
        return (Formula("fraction", parts=(row(*_before(top), own), expression_formula(bottom))),)
    return (*_before(size), own)


def _before(size: sympy.Expr) -> tuple[Formula, ...]:
    """A factor as it stands before a letter; 1 is not written."""
    if size == 1:
        return ()
    front = expression_formula(size)
    return (Formula("fenced", parts=(front,)) if size.is_Add else front,)


def expression_formula(expression: sympy.Expr) -> Formula:
    """Sums, products, quotients, powers, numbers, symbols and functions of one argument."""
    if expression.is_Symbol or expression is sympy.pi:
        return name(str(expression))
    if expression.is_Add:
        return _sum(expression)
    top, bottom = sympy.fraction(expression)
    if bottom != 1:
        return Formula("fraction", parts=(expression_formula(top), expression_formula(bottom)))
    if expression.is_Number:
        text = str(expression)
        return row(operator("-"), number(text[1:])) if text.startswith("-") else number(text)
    if expression.is_Mul:
        return _factors(expression)
    if expression.is_Pow:
        base, exponent = expression.args
        below = expression_formula(base)
        if not (base.is_Symbol or (base.is_Number and not base.is_negative)):
            below = Formula("fenced", parts=(below,))
        return Formula("sup", parts=(below, expression_formula(exponent)))
    inner = tuple(expression_formula(argument) for argument in expression.args)
    return row(name(expression.func.__name__), Formula("fenced", parts=inner))


def _sum(expression: sympy.Expr) -> Formula:
    parts: list[Formula] = []
    for k, term in enumerate(expression.as_ordered_terms()):
        sign, size = split_sign(term)
        parts += [operator(sign or "+")] if k or sign else []
        parts.append(expression_formula(size))
    return row(*parts)


def _factors(expression: sympy.Expr) -> Formula:
    sign, size = split_sign(expression)
    parts = [operator("-")] if sign else []
    for factor in size.as_ordered_factors() if size.is_Mul else [size]:
        inner = expression_formula(factor)
        parts.append(Formula("fenced", parts=(inner,)) if factor.is_Add else inner)
    return row(*parts)
