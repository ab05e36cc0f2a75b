"""All base parameters as people and programs read them: text, LaTeX, Markdown, JSON."""

import textwrap
from collections.abc import Mapping
from dataclasses import asdict
from fractions import Fraction
from typing import Any

import sympy
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from modeler.core.expression import format_decimal, parse_expression
from modeler.core.formula import (
    DisplayedEquation,
    Formula,
    format_display,
    format_latex_name,
    make_name,
    make_number,
    make_operator,
    make_row,
)
from modeler.derivation.result import (
    BallRank,
    BaseParameter,
    BaseParameters,
    Certificate,
    ModularRank,
    Proof,
    SampledRank,
    Sampling,
    Term,
)

# A grouping relation as people read it: the one writer of all printed forms.
#
# Every term is printed as the product it is, numerator * parameter / denominator, with brackets
# around whatever binds less than its place in that product.


class _DecimalPrinter:
    """A printer of sympy that writes numbers by their digits where they end, not as fractions."""

    halves: bool

    def _print_Rational(self, expr: sympy.Rational) -> str:
        return format_exact_decimal(expr, self.halves) or str(super()._print_Rational(expr))  # type: ignore[misc]

    def _print_Mul(self, expr: sympy.Mul) -> str:
        number, rest = expr.as_coeff_Mul()
        digits = format_exact_decimal(number, self.halves)
        if digits is None:
            return str(super()._print_Mul(expr))  # type: ignore[misc]
        return self._write_product(digits, rest)

    def _write_product(self, digits: str, rest: sympy.Expr) -> str:
        raise NotImplementedError


class _TextPrinter(_DecimalPrinter, StrPrinter):
    """As text."""

    def __init__(self, halves: bool) -> None:
        super().__init__({"full_prec": False})  # decimal numbers without zeros behind them
        self.halves = halves

    def _write_product(self, digits: str, rest: sympy.Expr) -> str:
        text = self.parenthesize(rest, PRECEDENCE["Mul"], strict=True)
        return f"{digits}{text[1:]}" if text.startswith("1/") else f"{digits}*{text}"


class _LatexPrinter(_DecimalPrinter, LatexPrinter):
    """In LaTeX."""

    def __init__(self, halves: bool, letters: Mapping[sympy.Symbol, str]) -> None:
        super().__init__({"symbol_names": letters})
        self.halves = halves

    def _write_product(self, digits: str, rest: sympy.Expr) -> str:
        top, bottom = sympy.fraction(rest)
        text = self.parenthesize(top, PRECEDENCE["Mul"], strict=True)
        times = r" \cdot " if text[0].isdigit() else " "
        above = digits if top == 1 else f"{digits}{times}{text}"
        return above if bottom == 1 else rf"\frac{{{above}}}{{{self._print(bottom)}}}"


def format_exact_decimal(value: sympy.Expr, halves: bool) -> str | None:
    """The digits of a number that is written as a decimal; None of any other expression."""
    if not value.is_Rational:
        return None
    return format_decimal(Fraction(int(value.p), int(value.q)), halves)


def format_coefficient(coefficient: sympy.Expr, halves: bool = False) -> str:
    """`D8/D3`: a coefficient alone, as programs read it."""
    return _TextPrinter(halves).doprint(coefficient)


def format_relation(parameter: BaseParameter) -> str:
    """`ZZ2R = ZZ2 + YY3 + D4**2*M4`."""
    terms = [_format_term(term, parameter.halves) for term in parameter.terms]
    return f"{parameter.name} = {_format_sum(terms)}"


def format_relation_latex(parameter: BaseParameter) -> str:
    r"""`\mathit{ZZ}_{2R} = \mathit{ZZ}_{2} + \mathit{YY}_{3} + D_{4}^{2} M_{4}`."""
    terms = [_format_latex_term(term, parameter.halves) for term in parameter.terms]
    return f"{format_latex_name(parameter.name)} = {_format_sum(terms)}"


def _format_sum(terms: list[str]) -> str:
    text = terms[0]
    for term in terms[1:]:
        text += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
    return text


def _format_term(term: Term, halves: bool) -> str:
    """Numerator, parameter, denominator; a quotient of numbers alone stands in front."""
    sign, size = separate_sign(term.coefficient)
    if size == 1:
        return sign + term.parameter
    printer = _TextPrinter(halves)
    top, bottom = _separate_fraction(size, halves)
    if not bottom.free_symbols:
        top, bottom = size, sympy.Integer(1)
    front = "" if top == 1 else f"{printer.parenthesize(top, PRECEDENCE['Mul'], strict=True)}*"
    # Right of a division even a product needs brackets: a/b*c is (a/b)*c.
    below = printer.parenthesize(bottom, PRECEDENCE["Pow"], strict=True)
    back = "" if bottom == 1 else f"/{below}"
    return f"{sign}{front}{term.parameter}{back}"


def _format_latex_term(term: Term, halves: bool) -> str:
    sign, size = separate_sign(term.coefficient)
    name = format_latex_name(term.parameter)
    if size == 1:
        return sign + name
    letters = {symbol: format_latex_name(symbol.name) for symbol in size.free_symbols}
    text = _LatexPrinter(halves, letters).doprint(size)
    return f"{sign}\\left({text}\\right) {name}" if size.is_Add else f"{sign}{text} {name}"


def _separate_fraction(value: sympy.Expr, halves: bool) -> tuple[sympy.Expr, sympy.Expr]:
    """Numerator and denominator; a decimal factor stays in the numerator."""
    number, rest = value.as_coeff_Mul()
    if format_exact_decimal(number, halves) is None:
        top, bottom = sympy.fraction(value)
        return top, bottom
    top, bottom = sympy.fraction(rest)
    return number * top, bottom


def separate_sign(coefficient: sympy.Expr) -> tuple[str, sympy.Expr]:
    """The sign to write in front, and what stays: sums keep theirs unless all terms are minus."""
    negative = (
        all(arg.could_extract_minus_sign() for arg in coefficient.args)
        if coefficient.is_Add
        else coefficient.could_extract_minus_sign()
    )
    return ("-", -coefficient) if negative else ("", coefficient)


_WIDTH = 96


def as_text(base: BaseParameters) -> str:
    """All relations, one line each, then the parameters without effect."""
    lines = [format_relation(parameter) for parameter in base.parameters]
    return "\n".join([*lines, "", f"no effect: {' '.join(base.unidentifiable) or 'none'}"])


def as_markdown(base: BaseParameters) -> str:
    """A table of the relations, for a page."""
    lines = ["| base parameter | is | unit |", "| --- | --- | --- |"]
    for parameter in base.parameters:
        right = format_relation(parameter).split(" = ", 1)[1]
        lines.append(f"| {parameter.name} | `{right}` | {base.columns[parameter.column].unit} |")
    lines += ["", f"Without effect: {', '.join(base.unidentifiable) or 'none'}."]
    return "\n".join(lines)


def as_latex(base: BaseParameters) -> str:
    """The relations as an align environment, in lines that fit the page."""
    sides = [format_relation_latex(p).split(" = ", 1) for p in base.parameters]
    return format_display(
        [DisplayedEquation(left, (right,)) for left, right in sides], numbered=True
    )


def serialise_base_parameters(robot: str, base: BaseParameters) -> dict[str, Any]:
    """What `modeler derive --json` writes (contract section 5)."""
    return {
        "robot": robot,
        "standard": [column.name for column in base.columns],
        "base": [
            {
                "name": parameter.name,
                "column_of": base.columns[parameter.column].name,
                "unit": base.columns[parameter.column].unit,
                "terms": [
                    {
                        "coefficient": format_coefficient(term.coefficient, parameter.halves),
                        "parameter": term.parameter,
                    }
                    for term in parameter.terms
                ],
            }
            for parameter in base.parameters
        ],
        "unidentifiable": list(base.unidentifiable),
        "rank": base.rank,
        "counts": dict(base.count_by_kind()),
        "rank_gap": [value or None for value in base.proof.gap],  # 0: there is none
        "proof": base.proof.kind,
        "certificate": _serialise_proof(base.proof),
    }


def parse_base_parameter(entry: Mapping[str, Any], halves: bool = False) -> BaseParameter:
    """A base parameter as `serialise_base_parameters` wrote it.

    Its place among the columns is " "not kept.
    """
    terms = []
    for term in entry["terms"]:
        read = parse_expression(str(term["coefficient"]))
        letters = {letter: sympy.Symbol(letter) for letter in read.names}
        functions = {known: getattr(sympy, known) for known in ("sin", "cos", "tan", "sqrt", "exp")}
        exact = read.fold(letters, functions, sympy.pi, _convert_rational)
        terms.append(Term(exact, term["parameter"]))
    return BaseParameter(entry["name"], -1, tuple(terms), halves)


def _convert_rational(value: Fraction) -> sympy.Rational:
    return sympy.Rational(value.numerator, value.denominator)


def _serialise_proof(proof: Proof) -> dict[str, Any]:
    certificate, sampling = proof.certificate, proof.sampling
    modular = certificate if isinstance(certificate, ModularRank) else None
    independence: dict[str, Any] = {"rank": certificate.rank, "seed": certificate.seed}
    if isinstance(certificate, ModularRank):
        independence = {
            "kind": "modular",
            **independence,
            "prime": certificate.prime,
            "points": certificate.points,
        }
    elif isinstance(certificate, SampledRank):
        independence = {"kind": "sampled", **independence, "why": certificate.why}
    else:
        states = [asdict(state) | {"signals": list(state.signals)} for state in certificate.states]
        rows = [list(row) for row in certificate.rows]
        independence = {
            "kind": "balls",
            **independence,
            "bits": certificate.bits,
            "states": states,
            "rows": rows,
        }
    return {
        "statement": proof.statement,
        "prime": modular and modular.prime,
        "points": modular and modular.points,
        "seed": proof.seed,
        "exact_rank": None if isinstance(certificate, SampledRank) else certificate.rank,
        "independence": independence,
        "numeric_rank": proof.numeric_rank,
        "tolerance": proof.tolerance,
        "scale": proof.scale,
        "base_against_standard_torque": proof.agreement,
        "sampling": sampling
        and {
            "postures": sampling.postures,
            "ranges": {name: list(ends) for name, ends in sampling.ranges.items()},
            "distance_to_singularity": sampling.distance,
        },
    }


def format_proof(proof: Proof) -> str:
    """The proof in a few lines."""
    return "\n".join(textwrap.fill(text, _WIDTH) for text in format_proof_paragraphs(proof))


def format_proof_paragraphs(proof: Proof) -> list[str]:
    """The proof, a paragraph for each of its parts."""
    return [
        f"proof: {proof.kind}. {proof.statement}",
        _format_independence(proof.certificate),
        f"rank {proof.numeric_rank} in floating point at the nominal geometry: singular values "
        f"{proof.gap[0]:.3g} (last kept) and {proof.gap[1]:.1e} (first dropped), tolerance "
        f"{proof.tolerance:g} of the largest; {proof.scale}",
        *([] if proof.sampling is None else [_format_sampling(proof.sampling, proof.seed)]),
        f"base torque against standard torque: {proof.agreement:.1e} of the largest",
    ]


def _format_independence(certificate: Certificate) -> str:
    if isinstance(certificate, ModularRank):
        return (
            f"rank {certificate.rank} modulo {certificate.prime} ({certificate.points} random "
            "points, seed "
            f"{certificate.seed})"
        )
    if isinstance(certificate, BallRank):
        return (
            f"rank {certificate.rank} in balls of {certificate.bits} bits (a minor of "
            f"{certificate.rank} rows at "
            f"{len(certificate.states)} exact states, seed {certificate.seed}; --json lists them)"
        )
    return (
        f"rank {certificate.rank} in floating point only (seed {certificate.seed}): "
        f"{certificate.why}"
    )


def _format_sampling(sampling: Sampling, seed: int) -> str:
    ranges = ", ".join(f"q{n} {low:.3g}..{high:.3g}" for n, (low, high) in sampling.ranges.items())
    return (
        f"at {sampling.postures} closed postures on walks from [home] (seed {seed}): {ranges}; "
        f"distance to the nearest singularity {sampling.distance:.2g} (least singular value of the "
        "loops' Jacobian by the passive joints, rows of usual length 1)"
    )


# A grouping relation as a formula that a page can set.


def build_relation_formula(parameter: BaseParameter) -> tuple[Formula, ...]:
    """`ZZ2R =`, then one formula a term with its sign in front: a page may break between them."""
    lines = [make_row(make_name(parameter.name), make_operator("="))]
    for k, term in enumerate(parameter.terms):
        sign, size = separate_sign(term.coefficient)
        head = (make_operator(sign or "+"),) if k or sign else ()
        lines.append(make_row(*head, *_build_product(size, term, parameter.halves)))
    return tuple(lines)


def _build_product(size: sympy.Expr, term: Term, halves: bool) -> tuple[Formula, ...]:
    parameter = make_name(term.parameter)
    top, bottom = _separate_fraction(size, halves)
    if bottom.free_symbols:
        below = build_expression_formula(bottom, halves)
        return (
            Formula("fraction", parts=(make_row(*_build_prefix(top, halves), parameter), below)),
        )
    return (*_build_prefix(size, halves), parameter)


def _build_prefix(size: sympy.Expr, halves: bool) -> tuple[Formula, ...]:
    """A factor as it stands before a letter; 1 is not written."""
    return () if size == 1 else (_build_fenced_sum(size, halves),)


def _build_fenced_sum(factor: sympy.Expr, halves: bool) -> Formula:
    """A factor of a product: a sum in brackets."""
    inner = build_expression_formula(factor, halves)
    return Formula("fenced", parts=(inner,)) if factor.is_Add else inner


def build_expression_formula(expression: sympy.Expr, halves: bool = False) -> Formula:
    """Sums, products, quotients, powers, numbers, symbols and functions of one argument."""
    if expression.is_Symbol or expression is sympy.pi:
        return make_name(str(expression))
    if expression.is_Add:
        parts: list[Formula] = []
        for k, term in enumerate(expression.as_ordered_terms()):
            sign, size = separate_sign(term)
            parts += [make_operator(sign or "+")] if k or sign else []
            parts.append(build_expression_formula(size, halves))
        return make_row(*parts)
    digits = format_exact_decimal(abs(expression), halves) if expression.is_Rational else None
    top, bottom = _separate_fraction(expression, halves)
    if digits is None and bottom != 1:
        return Formula(
            "fraction",
            parts=(build_expression_formula(top, halves), build_expression_formula(bottom, halves)),
        )
    if expression.is_Number:
        sign = "-" if expression.is_negative else ""
        text = f"{sign}{digits}" if digits else _TextPrinter(halves).doprint(expression)
        return (
            make_row(make_operator("-"), make_number(text[1:]))
            if text.startswith("-")
            else make_number(text)
        )
    if expression.is_Mul:
        sign, size = separate_sign(expression)
        factors = size.as_ordered_factors() if size.is_Mul else [size]
        return make_row(
            *([make_operator("-")] if sign else []),
            *(_build_fenced_sum(factor, halves) for factor in factors),
        )
    if expression.is_Pow:
        base, exponent = expression.args
        below = build_expression_formula(base, halves)
        if not (base.is_Symbol or (base.is_Number and not base.is_negative)):
            below = Formula("fenced", parts=(below,))
        return Formula("sup", parts=(below, build_expression_formula(exponent, halves)))
    inner = tuple(build_expression_formula(argument, halves) for argument in expression.args)
    return make_row(make_name(expression.func.__name__), Formula("fenced", parts=inner))
