"""Every printed form of every relation is read back and is the exact relation."""

from operator import add, mul, sub, truediv

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from modeler.core.formula import format_latex_name
from modeler.core.manifest import EmittedModule
from modeler.derivation.relations import (
    BaseParameter,
    BaseParameters,
    Term,
    format_relation,
    format_relation_latex,
)
from tests.base.formulas import UnreadableError, latex_value, name_of_latex, text_value
from tests.base.printed_relations import Exact, printed_forms
from tests.modules import module
from tests.robots import ROBOTS
from tests.rotation import with_cases

NEAR = 1e-12
FORMS = 7
LETTERS = {"D4": 0.3, "rP": 0.4, "L_a": 0.55, "gam13": 0.7, "b": 0.85, "B2_x": 1.1}


def wrong(robot: str, base: BaseParameters, emitted: EmittedModule, seed: int) -> list[str]:
    """What is printed of a robot and is not its relation."""
    exact, values, forms = Exact(base.parameters, seed), [], 0
    for form, relations, read in printed_forms(robot, base, emitted):
        forms += 1
        if [name for name, _ in relations] != [p.name for p in base.parameters]:
            values.append(f"{robot}, {form}: {[name for name, _ in relations]}")
            continue
        for parameter, (name, printed) in zip(base.parameters, relations, strict=True):
            if not exact.differences(parameter, printed, read) <= NEAR:
                values.append(f"{robot}, {form}: {name} = {printed}")
    assert forms == FORMS
    return values


@pytest.mark.parametrize("name", ROBOTS)
def test_all_printed_forms_are_the_exact_relations(name):
    _, base, emitted = module(name)
    assert wrong(name, base, emitted, seed=14) == []


def numbers() -> st.SearchStrategy[sympy.Expr]:
    return st.fractions(-3, 3, max_denominator=6).filter(bool).map(sympy.Rational)


def coefficients() -> st.SearchStrategy[sympy.Expr]:
    """Products, quotients, sums, powers and functions of lengths and angles, never 0."""
    letters = st.sampled_from([sympy.Symbol(name) for name in LETTERS])
    roots = st.sampled_from([sympy.sqrt(2), sympy.sqrt(3), sympy.pi])
    leaves = numbers() | letters | roots
    return st.recursive(leaves, _larger, max_leaves=6).filter(_sound)


def _larger(e: st.SearchStrategy[sympy.Expr]) -> st.SearchStrategy[sympy.Expr]:
    nonzero = e.filter(bool)
    pairs = ((add, e), (sub, e), (mul, e), (truediv, nonzero))
    functions = (sympy.sin, sympy.cos, lambda x: sympy.sqrt(1 + x**2))
    return st.one_of(
        *(st.builds(pair, e, other) for pair, other in pairs),
        st.builds(pow, nonzero, st.sampled_from([-2, -1, 2, 3])),
        *(e.map(function) for function in functions),
    )


def _sound(value: sympy.Expr) -> bool:
    """No part of it is so large at `LETTERS` that rounding could pass for a difference."""
    parts = [_at_letters(part) for part in sympy.preorder_traversal(value)]
    return all(p.is_real and abs(p) < 1e3 for p in parts) and abs(parts[0]) > 1e-3


def _at_letters(value: sympy.Expr) -> sympy.Expr:
    at = {sympy.Symbol(n): sympy.Float(v, 40) for n, v in LETTERS.items()}
    return value.xreplace(at).evalf(40)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.lists(coefficients(), min_size=1, max_size=3), st.booleans())
def test_any_coefficient_is_printed_as_it_is(found, halves):
    terms = (Term(sympy.Integer(1), "ZZ2"), *(Term(c, f"M{i}") for i, c in enumerate(found)))
    one = BaseParameter("ZZ2R", 0, terms, halves)
    text, latex = (write(one).split(" = ")[1] for write in (format_relation, format_relation_latex))
    for i, coefficient in enumerate(found):
        values = LETTERS | {term.parameter: 0.0 for term in terms} | {f"M{i}": 0.7}
        wanted = 0.7 * float(_at_letters(coefficient))
        for printed, read in ((text, text_value), (latex, latex_value)):
            assert abs(read(printed, values) - wanted) <= 1e-9 * max(abs(wanted), 1.0), printed


@with_cases(
    "coefficient, text",
    ("1/(D13*sin(gam13))", "MY7/(D13*sin(gam13))"),
    ("-a - b", "-(a + b)*MY7"),
    ("a/b + c", "(a/b + c)*MY7"),
    ("sqrt(3)/2", "sqrt(3)/2*MY7"),
    (sympy.Float(13.73), "13.73*MY7"),
)
def test_what_is_divided_by_stays_together(coefficient, text):
    parameter = BaseParameter("MY7R", 0, (Term(sympy.sympify(coefficient), "MY7"),))
    assert format_relation(parameter) == f"MY7R = {text}"


@pytest.mark.parametrize("name", ["ZZ2R", "L_1", "L1", "a_b_c", "phi1", "alpha"])
def test_names_differ_in_latex_and_are_read_back(name):
    assert name_of_latex(format_latex_name(name)) == name


@pytest.mark.parametrize("text", ["M5 + ", "M5*", "(M5", "M5)", "M5 $ M6", "M5 M6", "sin*M5"])
def test_the_readers_refuse_what_is_no_formula(text):
    with pytest.raises(UnreadableError):
        text_value(text, {"M5": 1.0, "M6": 1.0})


def test_a_lost_bracket_would_be_seen():
    terms = (Term(sympy.Integer(1), "MX7"), Term(sympy.sympify("rP/(2*L2)"), "MY7"))
    parameter = BaseParameter("MX7R", 0, terms)
    exact = Exact([parameter], seed=1)
    right = format_relation(parameter).split(" = ")[1]
    assert exact.differences(parameter, right, text_value) <= NEAR
    assert exact.differences(parameter, right.replace("/(2*L2)", "/2*L2"), text_value) > 0.01
