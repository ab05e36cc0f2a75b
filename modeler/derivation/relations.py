"""Base parameters as exact symbolic statements: grouping relations, proof, text, LaTeX, JSON."""

import fnmatch
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import Any

import sympy
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from modeler.core.errors import DerivationError
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
from modeler.core.json import ShortRepr
from modeler.derivation.model import StandardColumn


@dataclass(frozen=True)
class Term:
    """coefficient * parameter of a base parameter; the coefficient is exact."""

    coefficient: sympy.Expr
    parameter: str


@dataclass(frozen=True)
class BaseParameter(ShortRepr):
    """One base parameter: name = sum of terms; its regressor column is that of `column`.

    The first term is the parameter itself with coefficient 1. A parameter into which others group
    ends in R. Where `halves`, 1/2 is printed as 0.5: so the robot file writes its numbers.
    """

    name: str
    column: int  # index among the standard columns
    terms: tuple[Term, ...]
    halves: bool = False


@dataclass(frozen=True)
class Sampling:
    """The closed postures at which the torques of a robot with loops were sampled.

    Attributes:
        postures: their number.
        ranges: (lowest, highest) position of each actuated joint, rad or m, by name.
        distance: to the nearest singularity: least singular value of the loops' Jacobian by the
            passive joints, rows of usual length 1, travels in sizes of the robot.
    """

    postures: int
    ranges: Mapping[str, tuple[float, float]]
    distance: float


@dataclass(frozen=True)
class ModularRank:
    """Independence proven modulo a prime: a minor that is not 0 there is not 0.

    Attributes:
        rank: of the energy rows of the base columns.
        prime: modulus.
        points: random states and geometries, over all checks of the relations.
        seed: of these.
    """

    rank: int
    prime: int
    points: int
    seed: int


@dataclass(frozen=True)
class ExactState:
    """A state of a ball certificate: doubles that are meant to the last digit.

    Attributes:
        positions: of all free joints, rad or m, by name. With loops those of the actuated joints
            are exact; the passive ones are near to the posture that is meant.
        speeds: of the actuated joints, rad/s or m/s.
        accelerations: of the actuated joints, rad/s2 or m/s2.
        signals: what effects read besides the motion.
    """

    positions: Mapping[str, float]
    speeds: Mapping[str, float]
    accelerations: Mapping[str, float]
    signals: tuple[float, ...] = ()


@dataclass(frozen=True)
class BallRank(ShortRepr):
    """Independence proven in ball arithmetic: a minor of the torques whose ball excludes 0.

    Attributes:
        rank: of the torques of the base columns.
        bits: precision of the balls.
        seed: of the states.
        states: at which the rows are taken.
        rows: (number of the state, actuated joint) of every row of the minor.
    """

    rank: int
    bits: int
    seed: int
    states: tuple[ExactState, ...]
    rows: tuple[tuple[int, str], ...]


@dataclass(frozen=True)
class SampledRank:
    """Independence seen at random states in floating point, not proven.

    Attributes:
        rank: of the torques in floating point.
        seed: of the states.
        why: what a proof lacks.
    """

    rank: int
    seed: int
    why: str


Certificate = ModularRank | BallRank | SampledRank
"""Why the base columns are independent."""


@dataclass(frozen=True)
class Proof(ShortRepr):
    """Why the base parameters are right, and what anyone needs to check it again.

    Attributes:
        kind: "exact" if relations and independence are both proved.
        statement: the argument in one or two sentences.
        certificate: of the independence.
        seed: of all random states.
        numeric_rank: rank of the torque regressor in floating point at the nominal geometry.
        gap: (last kept, first dropped) singular value, columns scaled to unit length; the second is
            0.0 if nothing was dropped.
        tolerance: singular values above tolerance * largest are kept.
        scale: how rows and columns were scaled before.
        agreement: largest relative difference of standard and base torque at random states.
        sampling: how far the postures of the numeric rank went; None without loops.
    """

    kind: str
    statement: str
    certificate: Certificate
    seed: int
    numeric_rank: int
    gap: tuple[float, float]
    tolerance: float
    scale: str
    agreement: float
    sampling: Sampling | None = None


@dataclass(frozen=True)
class BaseParameters(ShortRepr):
    """The base parameters of a robot.

    Attributes:
        columns: all standard columns, in order.
        parameters: base parameters, in column order.
        unidentifiable: standard parameters without any effect on the torques.
        proof: certificate.
    """

    columns: tuple[StandardColumn, ...]
    parameters: tuple[BaseParameter, ...]
    unidentifiable: tuple[str, ...]
    proof: Proof

    @property
    def rank(self) -> int:
        """Returns number of base parameters."""
        return len(self.parameters)

    def count_by_kind(self) -> Mapping[str, int]:
        """Counts base parameters by the kind of the standard parameter of their column."""
        counts = dict.fromkeys(("inertial", "rotor_inertia", "friction", "offset"), 0)
        for parameter in self.parameters:
            kind = self.columns[parameter.column].kind
            counts[kind] = counts.get(kind, 0) + 1
        return counts


def sort_by_priority(names: Sequence[str], patterns: Sequence[str]) -> list[int]:
    """Returns the columns in the order of keeping: those of the patterns first.

    Raises:
        DerivationError: a pattern matches no parameter.
    """
    order: list[int] = []
    for pattern in patterns:
        matching = [i for i, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
        if not matching:
            raise DerivationError(
                f'priority: "{pattern}" matches no parameter; expected names or patterns such as '
                f'"{names[0]}" or "{names[0][:2]}*"'
            )
        order += [i for i in matching if i not in order]
    return order + [i for i in range(len(names)) if i not in order]


def build_named_parameters(
    columns: Sequence[StandardColumn], terms: Mapping[int, Sequence[Term]], halves: bool
) -> tuple[BaseParameter, ...]:
    """Builds base parameters of {column: terms}; names of grouped ones end in R."""
    names = {b: columns[b].name + ("R" if len(group) > 1 else "") for b, group in terms.items()}
    return tuple(BaseParameter(names[b], b, tuple(group), halves) for b, group in terms.items())


# All base parameters as people and programs read them: text, LaTeX, Markdown, JSON.


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
    """Returns the digits of a number that is written as a decimal; None of any other expression."""
    if not value.is_Rational:
        return None
    return format_decimal(Fraction(int(value.p), int(value.q)), halves)


def format_coefficient(coefficient: sympy.Expr, halves: bool = False) -> str:
    """Returns `D8/D3`: a coefficient alone, as programs read it."""
    return _TextPrinter(halves).doprint(coefficient)


def format_relation(parameter: BaseParameter) -> str:
    """Returns `ZZ2R = ZZ2 + YY3 + D4**2*M4`."""
    terms = [_format_term(term, parameter.halves) for term in parameter.terms]
    return f"{parameter.name} = {_format_sum(terms)}"


def format_relation_latex(parameter: BaseParameter) -> str:
    r"""Returns `\mathit{ZZ}_{2R} = \mathit{ZZ}_{2} + \mathit{YY}_{3} + D_{4}^{2} M_{4}`."""
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
    """Returns the sign to write in front, and what stays; sums of minus terms give theirs."""
    parts = coefficient.args if coefficient.is_Add else (coefficient,)
    negative = all(part.could_extract_minus_sign() for part in parts)
    return ("-", -coefficient) if negative else ("", coefficient)


_WIDTH = 96


def format_base_parameters(base: BaseParameters, form: str = "text") -> str:
    """Returns all relations as text, as a Markdown table, or as an align environment."""
    if form == "latex":
        sides = [format_relation_latex(p).split(" = ", 1) for p in base.parameters]
        rows = [DisplayedEquation(left, (right,)) for left, right in sides]
        return format_display(rows, numbered=True)
    lines = [format_relation(parameter) for parameter in base.parameters]
    if form == "text":
        return "\n".join([*lines, "", f"no effect: {' '.join(base.unidentifiable) or 'none'}"])
    table = ["| base parameter | is | unit |", "| --- | --- | --- |"]
    for parameter, line in zip(base.parameters, lines, strict=True):
        unit = base.columns[parameter.column].unit
        table.append(f"| {parameter.name} | `{line.split(' = ', 1)[1]}` | {unit} |")
    return "\n".join([*table, "", f"Without effect: {', '.join(base.unidentifiable) or 'none'}."])


def serialise_base_parameters(robot: str, base: BaseParameters) -> dict[str, Any]:
    """Returns the JSON of `modeler derive --json` (contract section 5)."""
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
    """Parses a base parameter as JSON states it; its place among the columns is not known."""
    terms = []
    for term in entry["terms"]:
        read = parse_expression(str(term["coefficient"]))
        letters = {letter: sympy.Symbol(letter) for letter in read.names}
        functions = {known: getattr(sympy, known) for known in ("sin", "cos", "tan", "sqrt", "exp")}
        exact = read.fold(letters, functions, sympy.pi, sympy.Rational)
        terms.append(Term(exact, term["parameter"]))
    return BaseParameter(entry["name"], -1, tuple(terms), halves)


def _serialise_proof(proof: Proof) -> dict[str, Any]:
    certificate, sampling = proof.certificate, proof.sampling
    modular = certificate if isinstance(certificate, ModularRank) else None
    independence: dict[str, Any] = {"rank": certificate.rank, "seed": certificate.seed}
    if isinstance(certificate, ModularRank):
        counts = {"prime": certificate.prime, "points": certificate.points}
        independence = {"kind": "modular", **independence, **counts}
    elif isinstance(certificate, SampledRank):
        independence = {"kind": "sampled", **independence, "why": certificate.why}
    else:
        states = [asdict(state) | {"signals": list(state.signals)} for state in certificate.states]
        rows = [list(row) for row in certificate.rows]
        independence = {"kind": "balls", **independence, "bits": certificate.bits}
        independence |= {"states": states, "rows": rows}
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
    """Returns the proof in a few lines."""
    return "\n".join(textwrap.fill(text, _WIDTH) for text in format_proof_paragraphs(proof))


def format_proof_paragraphs(proof: Proof) -> list[str]:
    """Returns the proof, a paragraph for each of its parts."""
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
            f"points, seed {certificate.seed})"
        )
    if isinstance(certificate, BallRank):
        return (
            f"rank {certificate.rank} in balls of {certificate.bits} bits (a minor of "
            f"{certificate.rank} rows at {len(certificate.states)} exact states, seed "
            f"{certificate.seed}; --json lists them)"
        )
    seed = f"(seed {certificate.seed})"
    return f"rank {certificate.rank} in floating point only {seed}: {certificate.why}"


def _format_sampling(sampling: Sampling, seed: int) -> str:
    ranges = ", ".join(f"q{n} {low:.3g}..{high:.3g}" for n, (low, high) in sampling.ranges.items())
    return (
        f"at {sampling.postures} closed postures on walks from [home] (seed {seed}): {ranges}; "
        f"distance to the nearest singularity {sampling.distance:.2g} (least singular value of the "
        "loops' Jacobian by the passive joints, rows of usual length 1)"
    )


# A grouping relation as a formula that a page can set.


def build_relation_formula(parameter: BaseParameter) -> tuple[Formula, ...]:
    """Returns `ZZ2R =`, then one formula a term, between which a page may break."""
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
        above = make_row(*_build_prefix(top, halves), parameter)
        return (Formula("fraction", parts=(above, below)),)
    return (*_build_prefix(size, halves), parameter)


def _build_prefix(size: sympy.Expr, halves: bool) -> tuple[Formula, ...]:
    """A factor as it stands before a letter; 1 is not written."""
    return () if size == 1 else (_build_fenced_sum(size, halves),)


def _build_fenced_sum(factor: sympy.Expr, halves: bool) -> Formula:
    """A factor of a product: a sum in brackets."""
    inner = build_expression_formula(factor, halves)
    return Formula("fenced", parts=(inner,)) if factor.is_Add else inner


def build_expression_formula(expression: sympy.Expr, halves: bool = False) -> Formula:
    """Returns sums, products, quotients, powers, numbers, symbols and functions of one argument."""
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
        above, below = (build_expression_formula(x, halves) for x in (top, bottom))
        return Formula("fraction", parts=(above, below))
    if expression.is_Number:
        sign = "-" if expression.is_negative else ""
        text = f"{sign}{digits}" if digits else _TextPrinter(halves).doprint(expression)
        if text.startswith("-"):
            return make_row(make_operator("-"), make_number(text[1:]))
        return make_number(text)
    if expression.is_Mul:
        sign, size = separate_sign(expression)
        factors = size.as_ordered_factors() if size.is_Mul else [size]
        fenced = (_build_fenced_sum(factor, halves) for factor in factors)
        return make_row(*([make_operator("-")] if sign else []), *fenced)
    if expression.is_Pow:
        base, exponent = expression.args
        below = build_expression_formula(base, halves)
        if not (base.is_Symbol or (base.is_Number and not base.is_negative)):
            below = Formula("fenced", parts=(below,))
        return Formula("sup", parts=(below, build_expression_formula(exponent, halves)))
    inner = tuple(build_expression_formula(argument, halves) for argument in expression.args)
    return make_row(make_name(expression.func.__name__), Formula("fenced", parts=inner))
