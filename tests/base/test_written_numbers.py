"""Numbers of a robot file are printed as they were written, and stay exact."""

import re
from fractions import Fraction

import numpy as np
import sympy

from modeler import formulas
from modeler.codegen.workflow import derive
from modeler.core.expression import format_decimal
from modeler.derivation.relations import format_base_parameters, serialise_base_parameters
from modeler.robot.read import parse_robot_text
from tests.rotation import with_cases

BIG = re.compile(r"\d{3,}/\d{3,}|frac\{\d{3,}\}")


def arm(lengths, symbols=""):
    """Four joints, twists of 90, 60 and 0 degrees, these lengths in their cells."""
    a, b, c, d = lengths
    return parse_robot_text(
        f"""name = "arm"
gravity = [0, 0, -9.81]
[symbols]
{symbols}
[mdh]
columns = ["j", "alpha", "d", "theta", "r"]
rows = [["1", 0, 0, "q1", 0], ["2", "-pi/2", {a}, "q2", 0], ["3", "pi/3", {b}, "q3", {c}],
        ["4", 0, {d}, "q4", 0]]
""",
        "arm.toml",
    )


def coefficients(robot):
    data = serialise_base_parameters("arm", derive(robot).base)
    terms = [(base["name"], term) for base in data["base"] for term in base["terms"]]
    return {(name, term["parameter"]): term["coefficient"] for name, term in terms}


def test_numbers_are_those_of_the_letters_exactly():
    """The same robot with letters, derived by itself: its coefficients at the written values."""
    rng = np.random.default_rng(4318)
    for _ in range(2):
        drawn = rng.uniform(0.05, 0.9, 4)
        written = {f"A{k}": f"{x:.{k + 1}f}" for k, x in enumerate(drawn, 1)}
        numbers = coefficients(arm(written.values()))
        values = {name: sympy.Rational(x) for name, x in written.items()}
        symbols = "\n".join(f"{name} = {x}" for name, x in written.items())
        letters = coefficients(arm([f'"{name}"' for name in written], symbols))
        assert numbers.keys() == letters.keys()
        for key, text in numbers.items():
            exact = sympy.sympify(letters[key]).subs(values)
            assert sympy.simplify(sympy.sympify(text, rational=True) - exact) == 0
            assert not BIG.search(text), text


def test_relations_show_what_was_written():
    base = derive(arm([0.1564, 0.4318, 0, 0.33])).base
    text, latex = format_base_parameters(base), format_base_parameters(base, "latex")
    assert "0.4318*M3" in text and "0.18645124*M3" in text and "0.02446096*M2" in text
    assert "0.4318 M_{3}" in latex and "0.18645124 M_{3}" in latex
    assert not BIG.search(text) and not BIG.search(latex)
    assert re.search(r"[^.\d]3/4\*", text)  # of cos(60 deg), which nobody wrote


def test_halves_are_decimals_where_the_file_writes_them_so():
    halves, others = (
        format_base_parameters(derive(arm([x, "0.4", 0, 0.3])).base) for x in ("0.5", "0.6")
    )
    assert "0.75*YY3" in halves and "3/4" not in halves
    assert "3/4*YY3" in others and "0.75" not in others
    assert "0.36*M2" in others


def test_closed_forms_show_what_was_written():
    robot = parse_robot_text(
        'name = "flat"\ngravity = [0, -9.81, 0]\n[mdh]\ncolumns = ["j", "alpha", "d", "theta"]\n'
        'rows = [["1", 0, 0, "q1"], ["2", 0.35, 0.4318, "q2"]]',
        "flat.toml",
    )
    derived = derive(robot)
    form = formulas.derive_closed_form(derived.model, derived.base)
    sheet = formulas.derive_equation(derived.model, derived.base, motion=True, columns=True).sheet
    table = formulas.coefficients.build_coefficient_table(derived.model, derived.base)
    text, latex = (formulas.coefficients.format_closed_form(form, way) for way in ("text", "latex"))
    lines = formulas.coefficients.format_table_lines(table)
    rows = [" ".join(row[3:]) for row in lines if "PS" in row[0]]
    written = formulas.function_sheet.format_sheet(sheet, "markdown")
    for page in (text, latex, written, "\n".join(rows)):
        assert not BIG.search(page)
        assert "0.4318" in page and "7/20" not in page
    assert "9.81" in text and r"\cos{(0.35)}" in latex


@with_cases(
    "value, halves, text",
    ("0.1564", False, "0.1564"),
    ("12.5", False, None),
    ("12.5", True, "12.5"),
    ("1/3", True, None),
    ("1/1024", False, None),
    ("1/1024", True, "0.0009765625"),
    ("1e-9", False, "0.000000001"),
)
def test_decimals_are_exact_or_none(value, halves, text):
    assert format_decimal(Fraction(value), halves) == text


def test_every_decimal_comes_back():
    rng = np.random.default_rng(25)
    for _ in range(100):
        above, twos, fives = map(int, rng.integers((-(10**9), 0, 0), (10**9, 9, 9)))
        value = Fraction(above, 2**twos * 5**fives)
        text = format_decimal(value, True)
        assert (text is None) == (value.denominator == 1)
        assert text is None or Fraction(text) == value
