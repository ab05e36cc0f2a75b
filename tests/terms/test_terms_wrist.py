"""The wrist's coefficients against an independent derivation (tests/reference)."""

from pathlib import Path

import pytest
import sympy

from modeler.formulas.ring import classes, inverse_map
from modeler.formulas.text import form_text, physical_text
from tests.terms.cases import table_of

REFERENCE = Path(__file__).resolve().parents[1] / "reference"


def reference(name: str) -> list[str]:
    lines = (REFERENCE / name).read_text().splitlines()
    return [line for line in lines if line.strip() and not line.startswith("#")]


def coefficient_lines() -> list[tuple[str, str, str, str]]:
    found = []
    for line in reference("wrist_coefficients.txt"):
        left, right = line.split("=")
        name, function, monomial = left.split()
        found.append((name, function, monomial, right.strip()))
    return found


def definition_lines() -> list[tuple[str, str, str]]:
    return [
        (name.strip(), physical.strip(), base.strip())
        for name, physical, base in (x.split("=") for x in reference("wrist_definitions.txt"))
    ]


def sympified(text: str) -> sympy.Expr:
    names = {str(s): s for s in sympy.symbols("c1 c2 c3 s1 s2 s3")}
    return sympy.expand(sympy.sympify(text, locals=names))


@pytest.fixture(scope="module")
def table():
    return table_of("wrist")


def test_names_functions_and_monomials_are_those_of_the_table(table):
    found = {c.name: (c.function, sympified(c.monomial)) for c in table.coefficients}
    expected = {name: (f, sympified(m)) for name, f, m, _ in coefficient_lines()}
    assert len(expected) == 101
    assert found == expected


def test_every_coefficient_is_the_stated_combination_of_the_seventeen(table):
    for name, _, _, text in coefficient_lines():
        combination = table.relations.combinations[name]
        found = sum(
            sympy.Rational(v.numerator, v.denominator) * sympy.Symbol(k)
            for k, v in combination.items()
        )
        assert sympy.expand(found - sympy.sympify(text)) == 0, name


def test_rank_is_seventeen_and_ps3_is_not_independent(table):
    names = [name for name, _, _ in definition_lines()]
    assert table.relations.rank == 17
    assert list(table.relations.independent) == names
    assert table.relations.combinations["PS3"] == {"PJ1": 2, "PJ3": 2}


def test_definitions_in_the_papers_letters(table):
    for name, physical, _ in definition_lines():
        found = physical_text(
            table.by_name[name].physical, table.physical.names, table.physical.masses
        )
        assert sympy.expand(sympy.sympify(found) - sympy.sympify(physical)) == 0, name


def test_definitions_in_base_parameters(table):
    static = table.closed.algebra.names[table.closed.algebra.moving :]
    for name, _, base in definition_lines():
        found = form_text(table.by_name[name].base, table.base_names, static)
        assert sympy.expand(sympy.sympify(found) - sympy.sympify(base)) == 0, name


def test_counts_by_kind_and_vanishing_functions(table):
    sizes = {f.name: len(f.terms) for f in table.closed.functions}
    assert sizes == {
        "g1": 8, "g2": 4, "g3": 4,
        "J11": 7, "J12": 6, "J13": 3, "J22": 3, "J23": 2, "J33": 1,
        "S112": 9, "S113": 8, "S122": 6, "S123": 3, "S133": 2, "S211": 9, "S213": 5, "S223": 3,
        "S233": 2, "S311": 8, "S312": 5, "S322": 3,
    }  # fmt: skip


def test_physical_parameters(table):
    found = table.identifiability
    assert len(found.letters) == 32
    assert len(found.appearing) == 25
    assert set(found.vanishing) == {"at1", "al1", "aJ12", "aJ13", "aJ22", "aJ23", "aJ33"}
    assert [dict(group) for group in found.sums] == [{"ct1": 1, "bl1": 1}]
    assert found.jacobian_rank == 17


def test_coefficients_fall_into_twenty_one_classes(table):
    assert len(classes(table.relations)) == 21


def test_map_to_the_base_parameters_and_back(table):
    found = table.map
    assert found.rows == table.relations.independent
    assert len(found.columns) == 17
    assert abs(int(found.determinant.LC)) == 16 and found.determinant.is_ground
    expected = {
        "ZZ1R": "PJ7-PJ16", "MX1": "-PG5", "MY1R": "-PG6", "XX2R": "PJ1+PJ3+PJ16", "XY2": "PJ6/2",
        "XZ2": "PJ10-PJ2/2", "YZ2": "PJ13", "ZZ2R": "PJ1+PJ19", "MX2": "-PG4", "MY2R": "PG1",
        "XX3R": "-PJ1", "XY3": "-PJ2/2", "XZ3": "PJ5/2-bl1*PG3", "YZ3": "bl1*PG2-PJ4/2",
        "ZZ3": "PJ16", "MX3": "-PG3", "MY3": "PG2",
    }  # fmt: skip
    inverse = inverse_map(found, table.closed.algebra.static_ring)
    assert inverse is not None and inverse.keys() == expected.keys()
    plain = {s: sympy.Symbol(s.name) for s in sympy.symbols("g al1 bl1", real=True)}
    for name, row in inverse.items():
        text = sum(v.as_expr() * sympy.Symbol(k) for k, v in row.items())
        text = text.subs({s: plain.get(s, sympy.Symbol(s.name)) for s in text.free_symbols})
        assert sympy.expand(text - sympy.sympify(expected[name])) == 0, name


def test_grouped_parameters_are_khalils(table):
    found = {
        p.name: sum(t.coefficient * sympy.Symbol(t.parameter) for t in p.terms)
        for p in table.base.parameters
        if len(p.terms) > 1
    }
    expected = {
        "ZZ1R": "ZZ1+YY2", "MY1R": "MY1-MZ2", "XX2R": "XX2-YY2+YY3+2*bl1*MZ3+bl1**2*M3",
        "ZZ2R": "ZZ2+YY3+2*bl1*MZ3+bl1**2*M3", "MY2R": "MY2+MZ3+bl1*M3", "XX3R": "XX3-YY3",
    }  # fmt: skip
    assert found.keys() == expected.keys()
    for name, text in expected.items():
        same = {s: sympy.Symbol(s.name) for s in found[name].free_symbols}
        assert sympy.expand(found[name].subs(same) - sympy.sympify(text)) == 0
