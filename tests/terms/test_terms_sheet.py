"""Which quantities of a sheet get a line, in which order, and how they look."""

from fractions import Fraction

import pytest

from modeler.derivation.graph import Graph
from modeler.formulas.function_sheet import (
    SheetWriter,
    sheet_json,
    sheet_latex,
    sheet_lines,
    sheet_markdown,
)

LETTERS = {"q[0]": "q1", "q[1]": "q2", "qd[0]": "qd1", "a": "a", "b": "b", "k1": "k1"}


@pytest.fixture
def graph() -> Graph:
    return Graph()


def symbols(graph: Graph, *names: str):
    return [graph.symbol(name, static=name in "ab") for name in names]


def formulas(writer: SheetWriter) -> list[str]:
    return [line for line in sheet_lines(writer.finished()) if line and line[0] != "#"]


def test_what_is_read_once_and_short_is_written_where_it_is_read(graph):
    x, y, a = symbols(graph, "x", "y", "a")
    writer = SheetWriter(graph, LETTERS)
    writer.propose("once", x + y)
    writer.result("r", a * (x + y))
    assert formulas(writer) == ["r = a*(x + y)"]


def test_what_is_read_twice_has_a_line_before_its_readers(graph):
    x, y, a, b = symbols(graph, "x", "y", "a", "b")
    shared = a * x * x + b * y * y + 1
    writer = SheetWriter(graph, LETTERS)
    writer.result("r", shared * x)
    writer.result("t", -shared * y)
    assert formulas(writer) == ["k2 = a*x**2 + b*y**2 + 1", "r = x*k2", "t = -y*k2"]


def test_a_name_of_the_robot_is_not_taken(graph):
    x, y, a = symbols(graph, "x", "y", "a")
    shared = x * y + a + 1
    writer = SheetWriter(graph, LETTERS)
    writer.propose("b", shared)
    writer.result("r", shared * x)
    writer.result("t", shared * y)
    assert formulas(writer)[0] == "b_ = a + x*y + 1" and formulas(writer)[1] == "r = x*b_"


def test_equal_results_refer_to_each_other(graph):
    x, y = symbols(graph, "x", "y")
    writer = SheetWriter(graph, LETTERS)
    writer.result("r", x * x + y)
    writer.result("t", -(x * x) - y)
    writer.result("nothing", x - x)
    assert formulas(writer) == ["r = y + x**2", "t = -r"]


def test_results_stay_in_their_section(graph):
    x, y, a = symbols(graph, "x", "y", "a")
    early = x + a * y + x * y
    writer = SheetWriter(graph, LETTERS)
    writer.section("first")
    writer.result("r", early * early * x)
    writer.section("second")
    writer.result("t", early)
    lines = sheet_lines(writer.finished())
    assert lines[0] == "# first" and lines[1].startswith("k2 = ")
    assert lines[-2:] == ["# second", "t = k2"]


def test_sines_of_sums_are_known(graph):
    q1, q2 = symbols(graph, "q[0]", "q[1]")
    s, c = (lambda x: graph.call("sin", x)), (lambda x: graph.call("cos", x))
    s(q1 + q2), c(q1 - q2)
    writer = SheetWriter(graph, LETTERS)
    writer.result("r", s(q1) * c(q2) + c(q1) * s(q2))
    writer.result("t", c(q1) * c(q2) + s(q1) * s(q2))
    found = formulas(writer)
    assert found == ["s12 = sin(q1 + q2); c1m2 = cos(q1 - q2)", "r = s12", "t = c1m2"]


def test_numbers_quotients_and_functions_in_text_and_latex(graph):
    x, v, a = symbols(graph, "x", "qd[0]", "a")
    writer = SheetWriter(graph, LETTERS)
    writer.result("J1_12", Fraction(1, 2) * a * x + graph.call("sqrt", a))
    writer.result("g1", -(x + 1) / (v * v + 1) + graph.call("sign", v))
    assert formulas(writer) == [
        "J1_12 = a*x/2 + sqrt(a)",
        "g1 = sign(qd1) - (x + 1)/(qd1**2 + 1)",
    ]
    latex = sheet_latex(writer.finished())
    assert r"J_{1,12} ={}& \tfrac{1}{2}\,a\,x + \sqrt{a}" in latex
    assert r"\operatorname{sign}(\dot{q}_{1}) - \frac{x + 1}{\dot{q}_{1}^{2} + 1}" in latex


def test_markdown_and_json_say_the_same(graph):
    (q1,) = symbols(graph, "q[0]")
    writer = SheetWriter(graph, LETTERS)
    writer.section("all")
    writer.result("r", 2 * graph.call("sin", q1))
    sheet = writer.finished()
    assert sheet_markdown(sheet).splitlines()[-3:] == ["```python", "r = 2*s1", "```"]
    assert sheet_json(sheet) == {
        "angles": {"1": "q1"},
        "definitions": [{"section": "all", "name": "r", "formula": "2*s1", "result": True}],
    }
