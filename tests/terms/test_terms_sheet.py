"""Which quantities of a sheet get a line, in which order, and how they look."""

import pytest

from modeler.derivation.graph import Graph
from modeler.formulas.function_sheet import SheetWriter, format_sheet

LETTERS = {"q[0]": "q1", "q[1]": "q2", "qd[0]": "qd1", "a": "a", "b": "b", "k1": "k1"}


@pytest.fixture
def graph() -> Graph:
    return Graph()


def symbols(graph: Graph, *names: str):
    return [graph.symbol(name, static=name in "ab") for name in names]


def formulas(writer: SheetWriter) -> list[str]:
    lines = format_sheet(writer.build_sheet()).splitlines()
    return [line for line in lines if line and line[0] != "#"]


def test_what_is_read_once_and_short_is_written_where_it_is_read(graph):
    x, y, a = symbols(graph, "x", "y", "a")
    writer = SheetWriter(graph, LETTERS)
    writer.propose_quantity("once", x + y)
    writer.add_result("r", a * (x + y))
    assert formulas(writer) == ["r = a*(x + y)"]


def test_what_is_read_twice_has_a_line_before_its_readers(graph):
    x, y, a, b = symbols(graph, "x", "y", "a", "b")
    shared = a * x * x + b * y * y + 1
    writer = SheetWriter(graph, LETTERS)
    writer.add_result("r", shared * x)
    writer.add_result("t", -shared * y)
    assert formulas(writer) == ["k2 = a*x**2 + b*y**2 + 1", "r = x*k2", "t = -y*k2"]


def test_a_name_of_the_robot_is_not_taken(graph):
    x, y, a = symbols(graph, "x", "y", "a")
    shared = x * y + a + 1
    writer = SheetWriter(graph, LETTERS)
    writer.propose_quantity("b", shared)
    writer.add_result("r", shared * x)
    writer.add_result("t", shared * y)
    assert formulas(writer)[0] == "b_ = a + x*y + 1" and formulas(writer)[1] == "r = x*b_"


def test_equal_results_refer_to_each_other(graph):
    x, y = symbols(graph, "x", "y")
    writer = SheetWriter(graph, LETTERS)
    writer.add_result("r", x * x + y)
    writer.add_result("t", -(x * x) - y)
    writer.add_result("nothing", x - x)
    assert formulas(writer) == ["r = y + x**2", "t = -r"]
