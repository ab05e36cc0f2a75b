"""A grouping relation as people read it: the one writer of all printed forms.

Every term is printed as the product it is, numerator * parameter / denominator, with brackets
around whatever binds less than its place in that product.
"""

import sympy
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from modeler.base.result import BaseParameter, Term
from modeler.core.latex import latex_name

_PRINTER = StrPrinter({"full_prec": False})  # decimal numbers without zeros behind them


def coefficient_text(coefficient: sympy.Expr) -> str:
    """`D8/D3`: a coefficient alone, as programs read it."""
    return _PRINTER.doprint(coefficient)


def relation_text(parameter: BaseParameter) -> str:
    """`ZZ2R = ZZ2 + YY3 + D4**2*M4`."""
    return f"{parameter.name} = {_sum([_text_term(term) for term in parameter.terms])}"


def relation_latex(parameter: BaseParameter) -> str:
    r"""`\mathit{ZZ}_{2R} = \mathit{ZZ}_{2} + \mathit{YY}_{3} + D_{4}^{2} M_{4}`."""
    return f"{latex_name(parameter.name)} = {_sum([_latex_term(t) for t in parameter.terms])}"


def _sum(terms: list[str]) -> str:
    text = terms[0]
    for term in terms[1:]:
        text += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
    return text


def _text_term(term: Term) -> str:
    """Numerator, parameter, denominator; a quotient of numbers alone stands in front."""
    sign, size = split_sign(term.coefficient)
    if size == 1:
        return sign + term.parameter
    top, bottom = sympy.fraction(size)
    if not bottom.free_symbols:
        top, bottom = size, sympy.Integer(1)
    front = "" if top == 1 else f"{_PRINTER.parenthesize(top, PRECEDENCE['Mul'], strict=True)}*"
    # Right of a division even a product needs brackets: a/b*c is (a/b)*c.
    below = _PRINTER.parenthesize(bottom, PRECEDENCE["Pow"], strict=True)
    back = "" if bottom == 1 else f"/{below}"
    return f"{sign}{front}{term.parameter}{back}"


def _latex_term(term: Term) -> str:
    sign, size = split_sign(term.coefficient)
    name = latex_name(term.parameter)
    if size == 1:
        return sign + name
    letters = {symbol: latex_name(symbol.name) for symbol in size.free_symbols}
    text = sympy.latex(size, symbol_names=letters)
    return f"{sign}\\left({text}\\right) {name}" if size.is_Add else f"{sign}{text} {name}"


def split_sign(coefficient: sympy.Expr) -> tuple[str, sympy.Expr]:
    """The sign to write in front, and what stays: sums keep theirs unless all terms are minus."""
    negative = (
        all(arg.could_extract_minus_sign() for arg in coefficient.args)
        if coefficient.is_Add
        else coefficient.could_extract_minus_sign()
    )
    return ("-", -coefficient) if negative else ("", coefficient)
