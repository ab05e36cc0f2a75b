"""Grouping relations as people and programs read them: text, LaTeX, Markdown, JSON."""

import re
import textwrap
from typing import Any

import sympy

from modeler.base.result import BaseParameter, BaseParameters, Proof, Term

_WIDTH = 96


def relation_text(parameter: BaseParameter) -> str:
    """`ZZ2R = ZZ2 + YY3 + D4**2*M4`."""
    return f"{parameter.name} = {_sum([_text_term(term) for term in parameter.terms])}"


def relation_latex(parameter: BaseParameter) -> str:
    """`ZZ_{2R} = ZZ_{2} + YY_{3} + D_{4}^{2} M_{4}`."""
    terms = [_latex_term(term) for term in parameter.terms]
    return f"{name_latex(parameter.name)} = {_sum(terms)}"


def name_latex(name: str) -> str:
    """`ZZ2R` as `ZZ_{2R}`."""
    match = re.fullmatch(r"([A-Za-z]+)(\d\w*)", name)
    return f"{match[1]}_{{{match[2]}}}" if match else name


def as_text(base: BaseParameters) -> str:
    """All relations, one line each, then the parameters without effect."""
    lines = [relation_text(parameter) for parameter in base.parameters]
    return "\n".join([*lines, "", f"no effect: {' '.join(base.unidentifiable) or 'none'}"])


def as_markdown(base: BaseParameters) -> str:
    """A table of the relations, for a page."""
    lines = ["| base parameter | is | unit |", "| --- | --- | --- |"]
    for parameter in base.parameters:
        right = relation_text(parameter).split(" = ", 1)[1]
        lines.append(f"| {parameter.name} | `{right}` | {base.columns[parameter.column].unit} |")
    lines += ["", f"Without effect: {', '.join(base.unidentifiable) or 'none'}."]
    return "\n".join(lines)


def as_latex(base: BaseParameters) -> str:
    """The relations as an align environment."""
    lines = [relation_latex(p).replace(" = ", " &= ", 1) for p in base.parameters]
    return "\\begin{align}\n" + " \\\\\n".join(lines) + "\n\\end{align}"


def as_json(robot: str, base: BaseParameters) -> dict[str, Any]:
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
                    {"coefficient": str(term.coefficient), "parameter": term.parameter}
                    for term in parameter.terms
                ],
            }
            for parameter in base.parameters
        ],
        "unidentifiable": list(base.unidentifiable),
        "rank": base.rank,
        "counts": dict(base.counts()),
        "rank_gap": list(base.proof.gap),
        "proof": base.proof.kind,
        "certificate": _certificate(base.proof),
    }


def _certificate(proof: Proof) -> dict[str, Any]:
    return {
        "statement": proof.statement,
        "prime": proof.prime,
        "points": proof.points,
        "seed": proof.seed,
        "exact_rank": proof.exact_rank,
        "numeric_rank": proof.numeric_rank,
        "tolerance": proof.tolerance,
        "scale": proof.scale,
        "base_against_standard_torque": proof.agreement,
    }


def proof_text(proof: Proof) -> str:
    """The proof in a few lines."""
    paragraphs = [f"proof: {proof.kind}. {proof.statement}"]
    if proof.points:
        paragraphs.append(
            f"rank {proof.exact_rank} modulo {proof.prime} ({proof.points} random points, seed "
            f"{proof.seed})"
        )
    paragraphs += [
        f"rank {proof.numeric_rank} in floating point at the nominal geometry: singular values "
        f"{proof.gap[0]:.3g} (last kept) and {proof.gap[1]:.1e} (first dropped), tolerance "
        f"{proof.tolerance:g} of the largest; {proof.scale}",
        f"base torque against standard torque: {proof.agreement:.1e} of the largest",
    ]
    return "\n".join(textwrap.fill(text, _WIDTH) for text in paragraphs)


def _sum(terms: list[str]) -> str:
    text = terms[0]
    for term in terms[1:]:
        text += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
    return text


def _text_term(term: Term) -> str:
    sign, size = _sign(term.coefficient)
    if size == 1:
        return sign + term.parameter
    top, bottom = sympy.fraction(size)
    if not bottom.free_symbols:
        top, bottom = size, sympy.Integer(1)
    front = "" if top == 1 else f"{_in_product(top)}*"
    back = "" if bottom == 1 else f"/{_in_product(bottom)}"
    return f"{sign}{front}{term.parameter}{back}"


def _in_product(size: sympy.Expr) -> str:
    return f"({size})" if size.is_Add else str(size)


def _latex_term(term: Term) -> str:
    sign, size = _sign(term.coefficient)
    name = name_latex(term.parameter)
    if size == 1:
        return sign + name
    letters = {symbol: name_latex(symbol.name) for symbol in size.free_symbols}
    text = sympy.latex(size, symbol_names=letters)
    return f"{sign}\\left({text}\\right) {name}" if size.is_Add else f"{sign}{text} {name}"


def _sign(coefficient: sympy.Expr) -> tuple[str, sympy.Expr]:
    """The sign to write in front, and what stays: sums keep theirs unless all terms are minus."""
    negative = (
        all(arg.could_extract_minus_sign() for arg in coefficient.args)
        if coefficient.is_Add
        else coefficient.could_extract_minus_sign()
    )
    return ("-", -coefficient) if negative else ("", coefficient)
