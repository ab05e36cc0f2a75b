"""The wrist: an independent derivation (tests/reference), its page, the misprints of the paper."""

import difflib
from pathlib import Path

import pytest
import sympy

from modeler.core.errors import RobotError
from modeler.core.files import write_atomically
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.formulas import ring
from modeler.formulas.coefficients import build_coefficient_table
from modeler.formulas.print_checks import (
    build_exact_state,
    check_friction,
    check_independent,
    check_solutions,
    check_twin,
    compute_power_balance,
    find_wrong_definitions,
    find_wrong_functions,
    write_terms_report,
)
from tests.rotation import with_cases
from tests.terms.cases import base_of, edited_wrist, model_of, table_of
from tests.texts import read_pairs

REFERENCE = Path(__file__).resolve().parents[1] / "reference"


def reference(name: str) -> list[str]:
    lines = (REFERENCE / name).read_text().splitlines()
    return [line for line in lines if line.strip() and not line.startswith("#")]


def coefficient_lines() -> list[tuple[str, str, str, str]]:
    values = []
    for line in reference("wrist_coefficients.txt"):
        left, right = line.split("=")
        name, function, monomial = left.split()
        values.append((name, function, monomial, right.strip()))
    return values


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
    values = {c.name: (c.function, sympified(c.monomial)) for c in table.coefficients}
    expected = {name: (f, sympified(m)) for name, f, m, _ in coefficient_lines()}
    assert len(expected) == 101
    assert values == expected


def test_every_coefficient_is_the_stated_combination_of_the_seventeen(table):
    for name, _, _, text in coefficient_lines():
        combination = table.relations.combinations[name]
        result = sum(
            sympy.Rational(v.numerator, v.denominator) * sympy.Symbol(k)
            for k, v in combination.items()
        )
        assert sympy.expand(result - sympy.sympify(text)) == 0, name


def test_definitions_in_the_papers_letters_and_in_base_parameters(table):
    static = table.closed.algebra.names[table.closed.algebra.moving :]
    for name, physical, base in definition_lines():
        item = table.by_name[name]
        text = ring.format_physical(item.physical, table.physical.names, table.physical.masses)
        assert sympy.expand(sympy.sympify(text) - sympy.sympify(physical)) == 0, name
        text = ring.format_linear_form(item.base, table.base_names, static)
        assert sympy.expand(sympy.sympify(text) - sympy.sympify(base)) == 0, name


def test_physical_parameters(table):
    result = table.identifiability
    assert len(result.letters) == 32
    assert len(result.appearing) == 25
    assert set(result.vanishing) == {"at1", "al1", "aJ12", "aJ13", "aJ22", "aJ23", "aJ33"}
    assert [dict(group) for group in result.sums] == [{"ct1": 1, "bl1": 1}]
    assert result.jacobian_rank == 17


def test_coefficients_fall_into_twenty_one_classes(table):
    assert len(ring.partition_by_ratio(table.relations)) == 21


def test_map_to_the_base_parameters_and_back(table):
    result = table.map
    assert result.rows == table.relations.independent
    assert len(result.columns) == 17
    assert abs(int(result.determinant.LC)) == 16 and result.determinant.is_ground
    expected = read_pairs("""
        ZZ1R PJ7-PJ16 MX1 -PG5 MY1R -PG6 XX2R PJ1+PJ3+PJ16 XY2 PJ6/2 XZ2 PJ10-PJ2/2 YZ2 PJ13
        ZZ2R PJ1+PJ19 MX2 -PG4 MY2R PG1 XX3R -PJ1 XY3 -PJ2/2 XZ3 PJ5/2-bl1*PG3 YZ3 bl1*PG2-PJ4/2
        ZZ3 PJ16 MX3 -PG3 MY3 PG2
    """)
    inverse = ring.invert_base_map(result, table.closed.algebra.static_ring)
    assert inverse is not None and inverse.keys() == expected.keys()
    plain = {s: sympy.Symbol(s.name) for s in sympy.symbols("g al1 bl1", real=True)}
    for name, row in inverse.items():
        text = sum(v.as_expr() * sympy.Symbol(k) for k, v in row.items())
        text = text.subs({s: plain.get(s, sympy.Symbol(s.name)) for s in text.free_symbols})
        assert sympy.expand(text - sympy.sympify(expected[name])) == 0, name


PAGE = Path(__file__).resolve().parents[2] / "docs" / "robots" / "wrist.md"
FIRST, LAST = "## The functions\n", "## All coefficients\n"


def test_page_of_the_wrist_is_current(regenerate):
    model = model_of("wrist")
    report = write_terms_report(model, derive_base_parameters(model))
    now = FIRST + report.split(FIRST)[1].split(LAST)[0].rstrip() + "\n"
    head, stored = PAGE.read_text(encoding="utf-8").split(FIRST)
    stored = FIRST + stored
    if regenerate:
        write_atomically(PAGE, head + now)
        return
    difference = "".join(
        difflib.unified_diff(
            stored.splitlines(True), now.splitlines(True), "docs/robots/wrist.md", "now"
        )
    )
    assert not difference, f"\n{difference}\nIf this change is meant: pytest --regenerate"


def table_with(*edits: tuple[str, str]):
    return build_coefficient_table(edited_wrist(*edits), base_of("wrist"))


def test_misprinted_functions(table):
    values = {check.name: check for check in find_wrong_functions(table)}
    assert values.keys() == {"S112", "S122", "S213", "S223", "S311"}
    assert dict(values["S213"].difference) == {"c2*s3": "-PJ4", "c2*c3": "-PJ5"}
    assert dict(values["S223"].difference) == {"c3*s3": "-2*PJ1", "c3**2": "-2*PJ2", "1": "PJ2"}
    assert dict(values["S112"].difference) == {"c2*c3*s2*s3": "2*PJ2", "c2*s2*s3": "-PJ5/2"}


def test_each_misprint_breaks_the_power_balance_and_the_derived_model_does_not(table):
    assert compute_power_balance(table, build_exact_state(table)) == 0
    for check in find_wrong_functions(table):
        assert check.power_defect is not None and abs(check.power_defect) > 1e-3


def test_misprinted_definition_and_its_contradiction(table):
    (check,) = find_wrong_definitions(table)
    assert check.name == "PJ5"
    checks = check_solutions(table, as_printed=True)
    spoilt = {c.letter: c.verdict for c in checks if c.verdict != "right"}
    assert spoilt.keys() == {"cm", "aJ11", "cJ13"}


def test_solutions(table):
    values = {check.letter: check for check in check_solutions(table)}
    assert len(values) == 18
    assert {k for k, c in values.items() if c.verdict != "right"} == {"cm", "aJ11"}
    assert values["cm"].denominator == "0" and values["cm"].verdict == "divides by 0"
    assert values["aJ11"].verdict == "returns -aJ11"


def test_seventeen_not_eighteen(table):
    assert len(table.printed.independent) == 18
    assert check_independent(table) == {"PS3": "2*PJ1 + 2*PJ3"}


def test_two_wrists_with_the_same_coefficients(table):
    check = check_twin(table)
    assert check.equal == 101 and not check.different
    letters = "cm aJ11 bt1 bJ11 bJ12 bJ13 bJ22 ct2 ct3 cJ11 cJ22 cJ23"
    assert set(check.changed) == set(letters.split())


def test_a_twin_that_is_none_is_found_out():
    check = check_twin(table_with(('cm = "21/5"', 'cm = "22/5"')))
    assert {"PG2", "PG3", "PJ16"} <= set(check.different)


def test_report_without_a_print_has_no_section_on_it():
    page = write_terms_report(model_of("two-link"), base_of("two-link"))
    assert "print is wrong" not in page
    assert "## All coefficients" in page


def test_wrist_friction_as_printed_takes_the_wrong_power(table):
    check = check_friction(table.printed.coupling)
    assert check.derived_power == check.dissipated != check.printed_power


@with_cases(
    "old, new, message",
    ("coulomb = [3, 2, 1.2]", "", r"printed, coupling: coulomb is missing; expected motor_fr"),
    ("coulomb = [3, 2, 1.2]", "coulomb = [3, 2]", r"coupling: got 3 rows of 3, 3, 3, 2 coul"),
    ("coulomb = [3, 2, 1.2]", 'coulomb = [3, 2, "x"]', r"coulomb, entry 3: got 'x'; expected"),
    ("count = 96", "count = 96.5", r"printed, count: got 96.5; expected a number"),
    ('missing = "PX" ', "missing = 3 ", r"missing: got 3; expected text"),
    ('cm = "21/5"', "cm = [1]", r"twin, cm: got \[1\]; expected a number"),
    ('missing = "PX" ', 'mising = "PX" ', r"\[terms\]: unknown key mising; expected source"),
    ("J33 = [1]", "J33 = 1", r"got 1; expected a list"),
    ("J33 = [1]", 'J33 = ["1 +"]', r'monomials, J33: got "1 \+", which cannot be read'),
    ("J33 = [1]", 'J33 = ["c1"]', r'monomials, J33: got "c1"; expected each at most once: 1'),
    ("J33 = [1]", "J34 = [1]", r"monomials, J34: no such function; the functions are g1"),
    ("am = 12", 'am = "12 kg"', r"example, am: got '12 kg'; expected a number such as 12"),
    ('ct2 = ["-PG2", "cm"]', "ct2 = [1, 2, 3]", r"solutions, ct2: got 3 entries; expected"),
)
def test_mistakes_in_terms(old, new, message):
    with pytest.raises(RobotError, match=message):
        table_with((old, new))


@with_cases(
    "old, new, check, message",
    (
        'J33 = "PJ22"',
        'J33 = "PJ77"',
        find_wrong_functions,
        r"functions, J33.*where PJ77 is unknown",
    ),
    (
        'J33 = "PJ22"',
        'J33 = "sin(PJ22)"',
        find_wrong_functions,
        r"J33: got .*expected a polynomial",
    ),
    ('J33 = "PJ22"', 'J77 = "PJ22"', find_wrong_functions, r"functions: there is no function J77"),
    ('PG2 = "-cm*ct2"', 'PG2 = "-cm*xx"', find_wrong_definitions, r"PG2.*where xx is unknown"),
    ('ct3 = ["-PG3", "cm"]', 'cx3 = "PG3"', check_solutions, r"cx3 is no physical parameter"),
    ('"PS3",', '"PS99",', check_independent, r"independent: there is no coefficient PS99"),
)
def test_mistakes_in_the_quoted_print(old, new, check, message):
    table = table_with((old, new))
    with pytest.raises(RobotError, match=message):
        check(table)
