"""The page of a derivation says what was derived: its MathML is read back and compared."""

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import sympy

from modeler.cli import main
from modeler.core.formula import Formula
from modeler.derivation.relations import build_expression_formula
from modeler.views.page import FormulaBlock, Page, Section, render_template
from tests.rotation import rotating

_ENDS = {"\u03b1": "alpha", "\u03b2": "beta", "\u03b3": "gamma", "\u03b8": "theta", "\u03c0": "pi"}


def read(node: ET.Element) -> str:
    """The expression of a MathML element, in Python's words."""
    parts = list(node)
    if node.tag == "mi":
        return _ENDS.get(node.text or "", node.text or "")
    if node.tag == "mn":
        return node.text or ""
    if node.tag == "mo":
        return (node.text or "").replace("\u2212", "-")
    if node.tag == "msub":
        return read(parts[0]) + read(parts[1])
    if node.tag == "msup":
        return f"({read(parts[0])})**({read(parts[1])})"
    if node.tag == "mfrac":
        return f"(({read(parts[0])})/({read(parts[1])}))"
    text = ""
    for part in parts:
        word = read(part)
        after = text[-1:] not in ("", "(", "+", "-", "=")
        called = re.search(r"(?:sin|cos|sqrt)$", text) is not None
        text += (
            f"*{word}" if after and word[:1] not in (")", "+", "-", "=") and not called else word
        )
    return text


def shown(formula: Formula) -> str:
    """As the template sets it."""
    sheet = Page("t", ("1", "x"), [Section("s", [FormulaBlock([((formula,), "m")])])])
    return str(re.findall(r"<math[^>]*>.*?</math>", render_template("sheet", sheet=sheet), re.S)[0])


def value(text: str) -> sympy.Expr:
    names = {name: sympy.Symbol(name) for name in re.findall(r"[A-Za-z]\w*", text)}
    for items in ("sin", "cos", "sqrt", "pi"):
        names.pop(items, None)
    return sympy.sympify(text, locals=names)


a, b, d = sympy.symbols("a b D41")


@pytest.mark.parametrize(
    "expression",
    [a, -a, a + b, a - b, -a * b, a * (a + b), a / d, -(a**2) / (b + d), 1 / d, a**-2, 2 * a / 3,
     (a + b) ** 2, sympy.cos(a) * sympy.sin(-b), sympy.Rational(-1, 2), sympy.Float("0.25") * a,
     sympy.sqrt(a * b), sympy.pi / 2 - a, (-2) ** a, sympy.Symbol("al1") ** 3],
    ids=str,
)  # fmt: skip
def test_an_expression_is_set_as_it_is(expression: sympy.Expr) -> None:
    back = value(read(ET.fromstring(shown(build_expression_formula(expression)))))
    assert sympy.simplify(back - expression) == 0


@pytest.mark.parametrize("robot", ["wrist", *rotating("puma560", "orthoglide-2003")])
def test_the_relations_on_the_page_are_those_of_the_result(robot: str, tmp_path: Path) -> None:
    place, output = tmp_path / "page.html", tmp_path / "result.json"
    assert main(["derive", robot, "--report", str(place), "--json", str(output)]) == 0
    result, page = json.loads(output.read_text()), place.read_text(encoding="utf-8")
    rows = re.findall(r"<tr><td>((?:<math.*?</math>\s*)+)</td>", page, re.S)
    assert len(rows) == result["rank"]
    for row, base in zip(rows, result["base"], strict=True):
        pieces = re.findall(r"<math.*?</math>", row, re.S)
        text = "".join(read(ET.fromstring(piece)) for piece in pieces)
        left, _, right = text.partition("=")
        terms = " + ".join(f"({t['coefficient']})*{t['parameter']}" for t in base["terms"])
        assert left == base["name"]
        assert sympy.expand(value(right) - value(terms)) == 0
    assert page.count("<td") > 10 and len(page) < 100_000
    assert 'id="plotly"' not in page  # nothing to draw, so nothing to draw with
