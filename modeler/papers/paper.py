"""What a paper prints, as short quotations, what we conclude from it, and the robots it derives.

One file per paper in `library/`. A quotation is the print letter by letter, without the marks of
typesetting: subscripts stand on the line, `^` is a power. What is compared is read from the
quotation itself. Where the print is not what is derived, the file states the difference, derived
minus printed, and the reason; nothing else passes.
"""

import ast
import itertools
import math
import operator
import re
import string
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import sympy

from modeler import derivation, formulas
from modeler.core.choices import list_papers
from modeler.core.errors import RobotError
from modeler.core.expression import parse_expression
from modeler.core.json import build_instance
from modeler.papers.quotation import (
    Amount,
    Monomial,
    QuotationError,
    Sum,
    add_sums,
    format_sum,
    multiply_monomials,
    read_sum,
)
from modeler.robot import Robot, read_robot

_FOLDER = Path(__file__).parent / "library"

SLIPS = {
    "misprint": "a misprint",
    "omission": "an omission",
    "error": "the statement is wrong",
    "count": "counted otherwise, no error",
    "scan": "the scanned text may be at fault, not the paper",
}
"""Why a print differs, as it is reported."""


@dataclass(frozen=True)
class PrintedLine:
    """One statement about a robot: quoted, or ours.

    Attributes:
        robot: built-in robot, or one of `Paper.variants`; that of the file's head if it has none.
        place: in the paper: section, equation or table.
        quote: the print; "" if the statement is our consequence.
        consequence: our consequence, in our names; "" if it is printed.
        check: how it is compared: one of `modeler.papers.readings.READINGS`.
        assumptions: further quotations that it rests on: assumptions, or sums put in.
        legs: what stands for i; one line each.
        expected: what is derived, one expression per number, or the expression of a set.
        difference: derived minus printed, in our names; "" if they are to be the same.
        correction: the quotation as it should read, which must hold.
        slip: one of `SLIPS`, where there is a difference.
        reason: reason of the difference, or a remark.
        substitution: "M13R = Off13/g - Off13R/g": what a left side is that the robot does not have,
            in base parameters or in joint variables.
        relation_robot: robot whose base parameters stand on the right side of a relation, leg by
            leg.
        suffix: ending of names that the robot lacks, a leg that stands alone.
        checksum: fingerprint of a quotation that holds measured numbers.
        is_measured: nothing derives its numbers; `gives` says what must hold of them.
    """

    robot: str
    place: str
    check: str
    quote: str = ""
    consequence: str = ""
    assumptions: tuple[str, ...] = ()
    legs: tuple[str, ...] = ("",)
    expected: tuple[str, ...] = ()
    difference: str = ""
    correction: str = ""
    slip: str = ""
    reason: str = ""
    substitution: str = ""
    relation_robot: str = ""
    suffix: str = ""
    checksum: str = ""
    is_measured: bool = False

    @property
    def text(self) -> str:
        """Returns what is stated: the paper's own words, or else ours."""
        return self.quote or self.consequence


@dataclass(frozen=True)
class Variant:
    """A built-in robot with gravity along another axis, or as its virtual tree."""

    robot: str
    gravity: tuple[str, ...] = ()
    as_tree: bool = False


@dataclass(frozen=True)
class Paper:
    """A paper and what it prints.

    Attributes:
        name: of the command, "guegan-2003".
        title: authors, title, year.
        robots: in the order in which they are shown.
        variants: robots that no file describes, by name.
        lines: all statements, in the order of the paper.
        names: the paper's names where they are not ours with another index: print -> ours.
        coefficients: robot whose file quotes the paper's coefficient functions, or "".
        slips: of these quotations: "function S112" -> kind, difference, reason.
        unchecked: what nothing here computes: place -> why.
    """

    name: str
    title: str
    robots: tuple[str, ...]
    variants: Mapping[str, Variant]
    lines: tuple[PrintedLine, ...]
    names: Mapping[str, str]
    coefficients: str = ""
    slips: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unchecked: Mapping[str, str] = field(default_factory=dict)


def read_paper(name: str) -> Paper:
    """Reads the paper of that name, or that derives the robot of that name.

    Raises:
        RobotError: there is none; lists those there are.
    """
    texts = {paper: (_FOLDER / f"{paper}.toml").read_text("utf-8") for paper in list_papers()}
    name = next((paper for paper in texts if f'\nrobot = "{name}"\n' in texts[paper]), name)
    if name not in texts:
        raise RobotError(f'there is no paper "{name}"; expected one of {", ".join(texts)}')
    document = tomllib.loads(texts[name])
    lines = []
    for entry in document["line"]:
        # One line, or one for each of `quotes`: quotation -> its seal, or "" without one.
        common = {"robot": document["robot"]} | entry
        quotes = common.pop("quotes", None)
        seals = [{}] if quotes is None else [{"quote": q, "checksum": s} for q, s in quotes.items()]
        lines += [_build_line(common | quotation) for quotation in seals]
    coefficients = document.get("coefficients", "")
    named = [name for line in lines for name in (line.robot, line.relation_robot) if name]
    robots = dict.fromkeys(named + [coefficients] * bool(coefficients))
    return Paper(
        name=name,
        title=document["title"],
        robots=tuple(robots),
        variants={
            key: build_instance(Variant, entry)
            for key, entry in document.get("variants", {}).items()
        },
        lines=tuple(lines),
        names=document.get("names", {}),
        coefficients=coefficients,
        slips=document.get("slips", {}),
        unchecked=document.get("unchecked", {}),
    )


def _build_line(entry: Mapping[str, Any]) -> PrintedLine:
    assert bool(entry.get("quote")) != bool(entry.get("consequence")), f"{entry} is quoted or ours"
    assert entry.get("slip", "scan") in SLIPS, f"{entry['slip']} is no slip"
    return build_instance(PrintedLine, entry)


# What is derived of a robot, in the form in which quotations are compared with it.
#
# Numbers and sets of names are requested in a small arithmetic: `count(zero("*11"))`,
# `count(base) - 3`, `100*b/abs(a)`: names, calls, sums and products, and comparisons for what must
# hold.


@dataclass(frozen=True)
class DerivedRobot:
    """A robot with its model and base parameters."""

    robot: Robot
    model: derivation.SymbolicModel
    base: derivation.BaseParameters

    @property
    def values(self) -> Mapping[str, float]:
        """Returns nominal values of the geometric symbols."""
        return self.model.geometry.values

    @cached_property
    def relations(self) -> Mapping[str, Sum]:
        """Returns every base parameter as a sum of standard parameters."""
        return {
            p.name: {
                multiply_monomials(monomial, ((term.parameter, 1),)): value
                for term in p.terms
                for monomial, value in expand_to_sum(term.coefficient).items()
            }
            for p in self.base.parameters
        }

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """Returns names of the standard parameters."""
        return tuple(column.name for column in self.base.columns)

    @cached_property
    def independent_parameters(self) -> frozenset[str]:
        """Returns standard parameters whose columns are those of base parameters."""
        return frozenset(self.base.columns[p.column].name for p in self.base.parameters)

    @cached_property
    def grouping(self) -> Mapping[str, list[sympy.Rational]]:
        """Returns how much of each standard parameter is in each base parameter, nominally."""
        shares = {name: [sympy.S.Zero] * self.base.rank for name in self.standard}
        for k, parameter in enumerate(self.base.parameters):
            for term in parameter.terms:
                put = {s: self.values[s.name] for s in term.coefficient.free_symbols}
                shares[term.parameter][k] = sympy.Rational(float(term.coefficient.subs(put)))
        return shares

    @cached_property
    def table(self) -> formulas.CoefficientTable:
        """Returns coefficients of the closed form."""
        return formulas.build_coefficient_table(self.model, self.base)

    @cached_property
    def kane(self) -> Mapping[str, str]:
        """Returns formulas of Kane's form, by name."""
        sheet = formulas.function_sheet.serialise_sheet(self.forms["kane"][0].sheet)
        return {each["name"]: each["formula"] for each in sheet["definitions"]}

    @cached_property
    def forms(self) -> Mapping[str, tuple[formulas.Equation, float]]:
        """Returns energy functions, without loops Kane's form too, and their errors."""
        states = derivation.draw_random_states(self.model, 20, np.random.default_rng(2000))
        equations = {"energy": formulas.energy_functions(self.model, states)}
        if self.robot.loops:
            return equations
        return equations | {"kane": formulas.kane_form(self.model, states)}

    @cached_property
    def dependent_variables(self) -> Mapping[str, Sum]:
        """Returns joint variables that follow others, and those that follow themselves."""
        free = {j.variable: read_sum(j.variable, str) for j in self.robot.moving_joints}
        tied = {f"q{name}": read_sum(text.text, str) for name, text in self.robot.relations.items()}
        return free | tied


def derive_robot(name: str, variant: Variant | None = None) -> DerivedRobot:
    """Derives a built-in robot, or a new one that differs from it as `variant` says."""
    robot = read_robot(name if variant is None else variant.robot)
    if variant is not None:
        robot = replace(robot.open_loops() if variant.as_tree else robot, name=name)
        if variant.gravity:
            x, y, z = (parse_expression(text) for text in variant.gravity)
            robot = replace(robot, gravity=(x, y, z))
    model = derivation.derive_model(robot)
    return DerivedRobot(robot, model, derivation.derive_base_parameters(model))


def expand_to_sum(expression: sympy.Expr) -> Sum:
    """Expands an expression of symbols, sines and cosines to a sum."""
    monomials: dict[Monomial, Amount] = {}
    for term in sympy.Add.make_args(sympy.expand(expression)):
        number, rest = term.as_coeff_Mul()
        if number:
            value = sympy.Rational(number)
            powers = sorted((str(b), int(e)) for b, e in rest.as_powers_dict().items() if b != 1)
            monomials[tuple(powers)] = Amount(Fraction(int(value.p), int(value.q)))
    return monomials


def build_expression(whole: Sum, symbols: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """Builds an expression of a sum, with these for its names where they are given."""
    return sympy.sympify(format_sum(whole).replace("^", "**"), symbols)


def eliminate_squared_sines(expression: sympy.Expr) -> sympy.Expr:
    """Returns the normal form in which an expression that is zero for all angles is 0."""
    reduced = sympy.expand(expression)
    for sine in reduced.atoms(sympy.sin):
        s, square = sympy.Dummy(), 1 - sympy.cos(sine.args[0]) ** 2
        reduced = sympy.rem(reduced.subs(sine, s), s**2 - square, s).subs(s, sine)
    return sympy.expand(reduced)


_BINARY: Mapping[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.Mod: operator.mod,
}
_COMPARED: Mapping[type, Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
}


def evaluate_expression(text: str, values: Mapping[str, Any]) -> Any:
    """Evaluates an expression of the language above.

    Args:
        text: of the language above.
        values: of its names; functions are values too.

    Raises:
        QuotationError: it asks for what there is not.
    """
    return _evaluate_node(ast.parse(text, mode="eval").body, values, text)


def _evaluate_node(node: ast.expr, values: Mapping[str, Any], text: str) -> Any:
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name) and node.id in values:
        return values[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_evaluate_node(node.operand, values, text)
    if isinstance(node, ast.BinOp):
        left, right = (_evaluate_node(side, values, text) for side in (node.left, node.right))
        return _BINARY[type(node.op)](left, right)
    if isinstance(node, ast.Compare):
        chain = [_evaluate_node(part, values, text) for part in (node.left, *node.comparators)]
        steps = zip(node.ops, chain, chain[1:], strict=False)
        return all(_COMPARED[type(op)](a, b) for op, a, b in steps)
    if isinstance(node, ast.Call):
        arguments = [_evaluate_node(argument, values, text) for argument in node.args]
        return _evaluate_node(node.func, values, text)(*arguments)
    raise QuotationError(f'"{text}" asks for {ast.unparse(node)}, which is not known here')


_ARITHMETIC: Mapping[str, Any] = {
    "abs": abs,
    "pi": math.pi,
    "count": len,
    "mean": lambda *x: sum(x) / len(x),
    "falling": lambda *x: all(a >= b for a, b in itertools.pairwise(x)),
}


def collect_quantities(derived: DerivedRobot) -> dict[str, Any]:
    """Collects the quantities of a robot: sets of names, by pattern, and their counts.

    `standard`, `base`, `zero` (without effect), `grouped` (neither base nor zero), `joints`,
    `actuated`, `passive` (of the table, the platform's left out), `links`; `within(a, b)`: what of
    a is grouped with b.
    """
    robot, base = derived.robot, derived.base
    joints = [joint for joint in robot.moving_joints if joint.name not in robot.platform]
    zero = frozenset(base.unidentifiable)
    standard = frozenset(derived.standard)
    sets: dict[str, frozenset[str]] = {
        "standard": standard,
        "base": frozenset(derived.relations),
        "zero": zero,
        "grouped": standard - zero - derived.independent_parameters,
        "joints": frozenset(joint.name for joint in joints),
        "actuated": frozenset(joint.name for joint in joints if joint.actuated),
        "passive": frozenset(joint.name for joint in joints if not joint.actuated),
        "links": frozenset(robot.joints[c.row].name for c in base.columns if c.kind == "inertial"),
    }
    known = {**_ARITHMETIC, **{name: _build_matcher(members) for name, members in sets.items()}}
    columns = base.columns
    known["prefix"] = lambda names: frozenset(c.prefix for c in columns if c.name in names)
    known["efforts"] = lambda names: frozenset(f"Gamma{name}" for name in names)
    known["within"] = lambda candidates, others: _find_within(derived, candidates, others)
    known["terms"] = lambda name: len(derived.relations.get(name, ()))
    return known | (_collect_coefficients(derived) if robot.physical else {})


def _build_matcher(members: frozenset[str]) -> Callable[..., frozenset[str]]:
    def select_names(*patterns: str) -> frozenset[str]:
        if not patterns:
            return members
        return frozenset(n for n in members if any(fnmatchcase(n, p) for p in patterns))

    return select_names


def _find_within(
    derived: DerivedRobot, candidates: frozenset[str], others: frozenset[str]
) -> frozenset[str]:
    """The `candidates` that are grouped and combinations of `others` and of kept ones."""
    columns = derived.grouping
    basis = [
        columns[name]
        for name in sorted(others | (candidates & derived.independent_parameters))
        if any(columns[name])
    ]
    rank = sympy.Matrix(basis).rank()
    grouped = (name for name in candidates - derived.independent_parameters if any(columns[name]))
    return frozenset(n for n in grouped if sympy.Matrix([*basis, columns[n]]).rank() == rank)


def _collect_coefficients(derived: DerivedRobot) -> dict[str, Any]:
    """Of a robot whose links have a paper's letters."""
    table = derived.table
    known = table.identifiability
    names = [joint.name for joint in derived.robot.moving_joints]
    return {
        "coefficients": len(table.coefficients),
        "independent": len(table.relations.independent),
        "letters": len(known.letters),
        "appearing": len(known.appearing),
        "vanishing": frozenset(known.vanishing),
        "identifiable": known.jacobian_rank,
        # Functions that are zero: S_ijk with j > k by convention, and those that vanish.
        "missing": lambda letter: frozenset(
            {letter + "".join(ijk) for ijk in itertools.product(names, repeat=3)}
            - set(table.closed.by_name)
        ),
        "monomials": lambda name: sum(c.function == name for c in table.coefficients),
    }


# Two sums, printed and derived, in our names, and the difference that is known between them.


_SLACK = 1 + 1e-9


@dataclass(frozen=True)
class LineComparison:
    """What a line prints and what is derived.

    Attributes:
        printed: as read from the quotation, our names.
        derived: the same, derived.
        text: the derived one as people read it.
        values: of the names that stand in coefficients, for decimals.
        settled: the difference that the paper's file states is taken into account already.
        weak: something is only larger or smaller, nothing says that it is equal.
    """

    printed: Sum
    derived: Sum
    text: str
    values: Mapping[str, float] = field(default_factory=dict)
    is_difference_included: bool = False
    is_inequality: bool = False


Robots = Mapping[str, DerivedRobot]
Reading = Callable[[Paper, PrintedLine, Robots], LineComparison]


def join_sums(parts: Mapping[str, Sum]) -> Sum:
    """Joins sums of several places: every term has its place as a factor `in<place>`."""
    return {
        multiply_monomials(monomial, ((f"in{place}", 1),)): value
        for place, part in parts.items()
        for monomial, value in part.items()
    }


def join_in_order(parts: Iterable[Sum]) -> Sum:
    """Joins sums by their order: each term of the second has the factor `in2`."""
    return join_sums({str(k): part for k, part in enumerate(parts, 1)})


def join_numbers(values: Iterable[Amount | int]) -> Sum:
    """Joins numbers by their order: the second is called `in2`."""
    amounts = (v if isinstance(v, Amount) else Amount(Fraction(v)) for v in values)
    return add_sums(join_in_order({(): value} for value in amounts))


def compare_line(comparison: LineComparison, line: PrintedLine) -> tuple[bool, bool]:
    """Returns whether printed + known difference is what is derived, and whether exactly.

    A coefficient that is printed with a point is compared as a number, to half a unit of its last
    digit; all others exactly.
    """
    # Derived minus printed, as the paper's file states it in our names.
    stated = line.difference.replace("{i}", line.legs[0])
    difference = "" if comparison.is_difference_included else stated
    known = read_sum(difference, str) if difference else {}
    printed = _group_by_name(add_sums(comparison.printed, known), comparison.values)
    derived = _group_by_name(comparison.derived, comparison.values)
    if printed.keys() != derived.keys():
        return False, False
    exact = True
    for name, parts in printed.items():
        if any(value.half for value in parts.values()):
            exact = False
            wanted, left = (_evaluate_amount(p, comparison.values) for p in (derived[name], parts))
            if abs(wanted.value - left.value) > left.half * Fraction(_SLACK):
                return False, False
        elif {m: v.value for m, v in parts.items()} != {
            m: v.value for m, v in derived[name].items()
        }:
            return False, False
    return True, exact


def _group_by_name(
    whole: Sum, values: Mapping[str, float]
) -> dict[Monomial, dict[Monomial, Amount]]:
    """{names that are no symbols: {symbols: coefficient}}."""
    groups: dict[Monomial, dict[Monomial, Amount]] = {}
    for monomial, value in whole.items():
        name = tuple(part for part in monomial if part[0] not in values)
        rest = tuple(part for part in monomial if part[0] in values)
        groups.setdefault(name, {})[rest] = value
    return groups


def _evaluate_amount(parts: Mapping[Monomial, Amount], values: Mapping[str, float]) -> Amount:
    total = Amount(Fraction(0))
    for monomial, value in parts.items():
        factor = 1.0
        for name, power in monomial:
            factor *= values[name] ** power
        total = total + value * Amount(Fraction(factor))
    return total


def build_renamer(paper: Paper, line: PrintedLine, leg: str = "") -> Callable[[str], str]:
    """Builds the function from a printed name to ours.

    `i` at the end is the leg; the index of a leg that follows R goes in front of it
    (`ZZ2R1` is our `ZZ21R`); letters that the paper's file names are exchanged, in quotations.
    """

    def rename(name: str) -> str:
        if name.endswith("i") and name != "pi":
            name = name[:-1] + leg
        if not line.consequence:
            letters = name[: len(name) - len(name.lstrip(string.ascii_letters))]
            name = paper.names.get(name) or paper.names.get(letters, letters) + name[len(letters) :]
        name = re.sub(r"^([A-Za-z]+\d+)R(\d)$", r"\1\2R", name)
        if line.suffix:
            name = re.sub(rf"^([A-Za-z]+\d){line.suffix}(R?)$", r"\1\2", name)
        return name

    return rename
