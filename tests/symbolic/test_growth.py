"""How much work a longer robot is, counted, and constants that would not end."""

import pytest
import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import parse_expression
from modeler.derivation import field as field_module
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.geometry import fold_expression
from modeler.derivation.graph import Graph
from modeler.robot.read import parse_robot_text
from tests.rotation import with_cases


def chain(rows: int) -> str:
    symbols = "".join(f"d{j} = {0.1 + 0.01 * j}\nr{j} = {0.2 + 0.01 * j}\n" for j in range(rows))
    lines = ",".join(
        f'["{j + 1}", "{("pi/2", "-pi/2", "0")[j % 3]}", "d{j}", "q{j + 1}", "r{j}"]'
        for j in range(rows)
    )
    return (
        'name = "c"\ngravity = [0, 0, "-g"]\n[symbols]\ng = 9.81\n' + symbols + "[mdh]\n"
        f'columns = ["j", "alpha", "d", "theta", "r"]\nrows = [{lines}]\n'
    )


def counted(monkeypatch, rows: int) -> tuple[int, int]:
    """(nodes of the regressor's graph, coefficients turned back from tangents)."""
    calls, text = [], field_module.express_in_cosines

    def counted_call(*args):
        calls.append(args)
        return text(*args)

    monkeypatch.setattr(field_module, "express_in_cosines", counted_call)
    model = derive_model(parse_robot_text(chain(rows), "c"))
    assert derive_base_parameters(model).proof.kind == "exact"
    monkeypatch.undo()
    return len(model.graph.nodes), len(calls)


def test_the_work_grows_with_the_square_of_the_rows(monkeypatch):
    """A regressor has 10 n (n + 1) / 2 entries: twice the rows, about four times the nodes."""
    short, long = counted(monkeypatch, 6), counted(monkeypatch, 12)
    assert long[0] < 4.5 * short[0]
    assert long[1] < 3.0 * short[1]  # of the coefficients most are the same few


LETTERS = {name: sympy.Symbol(name, real=True) for name in "abcde"}


@with_cases(
    "text, message",
    ("(a + b + c + d + e)**60", "has 635376 terms"),
    ("*".join(f"(a + b + c + {k}*d)" for k in range(1, 6)), "has 1024 terms when written"),
    ("(0.999**100)**100", "an exact number of .* bits"),
    ("a*tan(pi/2)", "not finite"),
)
def test_constants_that_would_not_end_are_refused(text, message):
    with pytest.raises(DerivationError, match=message):
        fold_expression(parse_expression(text), LETTERS)


def test_symbols_in_symbols_are_as_deep_as_what_they_stand_for():
    text = "s0 = 0.3\n" + "".join(f's{k} = "sin(s{k - 1})"\n' for k in range(1, 200))
    with pytest.raises(DerivationError, match=r"c: \[symbols\], s\d+: .*inside each other"):
        derive_model(parse_robot_text(chain(2).replace("g = 9.81\n", f"g = 9.81\n{text}"), "c"))


def test_the_refusal_names_row_and_column():
    text = chain(2).replace('"d1"', '"(d0 + d1 + r0 + r1 + 1)**60/1e30"')
    with pytest.raises(DerivationError, match=r'^c: row "2", column d: "'):
        derive_model(parse_robot_text(text, "c"))


def test_a_robot_with_a_long_angle_has_an_exact_answer():
    long = chain(3).replace('"-pi/2"', '"d0 + d1 + d2 + r0 + r1 + r2"')
    named = chain(3).replace('"-pi/2"', '"t"').replace("[mdh]", "t = 0.99\n[mdh]")
    result, other = (
        derive_base_parameters(derive_model(parse_robot_text(x, "c"))) for x in (long, named)
    )
    assert result.proof.kind == "exact" and result.rank == other.rank


def test_a_high_power_is_one_node():
    graph = Graph()
    x = graph.symbol("x")
    before = len(graph.nodes)
    graph.power(x, graph.constant(10**9))
    assert len(graph.nodes) <= before + 2
    assert graph.power(x, graph.constant(3)).ref == (x * x * x).ref
