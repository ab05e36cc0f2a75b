"""What people and machines read says the same as the formulas."""

import re
from fractions import Fraction
from math import cos, sin

import pytest
import sympy

from modeler.formulas.closed_form import closed_form
from modeler.formulas.render import (
    closed_form_latex,
    closed_form_markdown,
    closed_form_text,
    coefficients_latex,
    coefficients_markdown,
    coefficients_text,
    determinant_text,
    table_lines,
)
from modeler.formulas.text import LATEX, combination_text, latex_symbol, signed_sum
from tests.base.formulas import written_value
from tests.terms.cases import model_of, table_of
from tests.terms.closed_form_values import evaluate

ROBOTS = ["odd"]


def numbers_of(name: str) -> tuple[dict[str, float], list[float], dict[str, float]]:
    """(all names that a printed formula may use, q, parameters)."""
    model = model_of(name)
    q = [0.4, -0.7, 1.3][: model.geometry.joints]
    values = dict(model.geometry.values)
    for joint, angle in zip(model.robot.moving, q, strict=True):
        values |= {
            f"s{joint.name}": sin(angle),
            f"c{joint.name}": cos(angle),
            f"q{joint.name}": angle,
        }
    chi = {column: 0.1 * (i % 7) - 0.25 for i, column in enumerate(model.names)}
    return {**values, **chi}, q, chi


def printed_functions(text: str) -> dict[str, str]:
    blocks = text.split("\n\n")[1:]
    return {
        b.split(" =\n")[0].strip(): " ".join(b.split(" =\n")[1].split())
        for b in blocks
        if " =\n" in b
    }


def value(text: str, names: dict[str, float]) -> float:
    local = {n: sympy.Symbol(n) for n in names}
    expression = sympy.sympify(text, locals=local)
    return float(expression.subs({local[n]: v for n, v in names.items()}))


def expected(name: str, function: str, q: list[float], chi: dict[str, float]) -> float:
    closed = closed_form(model_of(name))
    found, at = evaluate(closed, q, chi), closed.by_name[function]
    if at.kind == "gravity":
        factor = closed.algebra.geometry.values.get(closed.gravity_factor, 1.0)
        return found.gravity[at.joints[0]] / factor
    return found.inertia[at.joints] if at.kind == "inertia" else found.christoffel[at.joints]


@pytest.mark.parametrize("name", ROBOTS)
def test_text_can_be_read_back(name):
    names, q, chi = numbers_of(name)
    printed = printed_functions(closed_form_text(closed_form(model_of(name))))
    for function, text in list(printed.items())[::8]:
        assert value(text, names) == pytest.approx(expected(name, function, q, chi), rel=1e-9)


def test_equation_names_the_factored_letter():
    assert "+ g*g_i" in closed_form_text(closed_form(model_of("wrist")))
    assert "+ g_i" in closed_form_text(closed_form(model_of("odd")))


def test_markdown_has_a_row_per_monomial():
    closed = closed_form(model_of("wrist"))
    page = closed_form_markdown(closed)
    assert page.count("\n| `") == closed.monomials == 101
    assert "| `s2**2*s3**2` | `-XX3 + YY3` |" in page


@pytest.mark.parametrize("name", ["odd"])
def test_latex_has_the_values_of_the_text(name):
    closed = closed_form(model_of(name))
    names, _, _ = numbers_of(name)
    letters = {latex_symbol(key): value for key, value in names.items()}
    blocks = closed_form_latex(closed).split("\\begin{align*}\n")[1:]
    text = printed_functions(closed_form_text(closed))
    assert len(blocks) >= len(closed.functions) == len(text)
    for block, function in zip(blocks, text.values(), strict=False):
        _, right = block.split("\n\\end{align*}")[0].split(" ={}& ")
        found = written_value(right.replace(" \\\\\n& ", " "), letters)
        assert found == pytest.approx(value(function, names), rel=1e-9, abs=1e-12)


def test_combinations_and_sums_are_known():
    table = table_of("wrist")
    assert table.relations.rank == 17 and len(table.coefficients) == 101
    assert combination_text(table.relations.combinations["PS41"]) == "-PJ4/2"
    base = next(line[4] for line in table_lines(table) if line[0] == "PJ4")
    assert base == "-2*YZ3 + 2*bl1*MY3" and determinant_text(table) == "-16"
    assert table.identifiability.sums == ({"ct1": 1, "bl1": 1},)


def test_coefficients_as_tables():
    table = table_of("wrist")
    lines = coefficients_text(table).splitlines()
    assert len(lines) == 102 and lines[0].split()[:3] == ["name", "in", "monomial"]
    assert re.search(r"^PS3 +S112 +c2\*s2 +2\*PJ1 \+ 2\*PJ3 ", "\n".join(lines), re.M)
    page = coefficients_markdown(table)
    assert page.count("\n") == 103 and page.count("| independent |") == 17
    latex = coefficients_latex(table)
    assert latex.count(" ={}& ") == latex.count(r"\text{ in }") == 101
    assert r"\mathit{PS}_{3} ={}& 2\,\mathit{PJ}_{1} + 2\,\mathit{PJ}_{3} \quad" in latex


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("cJ23", r"\mathit{cJ}_{23}"),
        ("XX3R", r"\mathit{XX}_{3R}"),
        ("g", "g"),
        ("al1", r"\mathit{al}_{1}"),
        ("alpha2", r"\alpha_{2}"),
        ("cos(al)", r"\cos{(\mathit{al})}"),
        ("two_words", r"\mathit{two\_words}"),
    ],
)
def test_latex_names(name, expected):
    assert latex_symbol(name) == expected


@pytest.mark.parametrize(
    ("terms", "text"),
    [
        ([], "0"),
        ([(1, "a"), (-1, "b")], "a - b"),
        ([(-2, "a"), (3, "")], "-2*a + 3"),
        ([(Fraction(-1, 2), "a"), (Fraction(3, 2), "b"), (Fraction(-1, 3), "")],
         "-a/2 + 3*b/2 - 1/3"),
    ],
)  # fmt: skip
def test_signed_sums(terms, text):
    assert signed_sum([(Fraction(value), name) for value, name in terms]) == text


def test_signed_sum_in_latex():
    assert signed_sum([(Fraction(-3, 2), "a")], LATEX) == r"-\tfrac{3}{2}\,a"
