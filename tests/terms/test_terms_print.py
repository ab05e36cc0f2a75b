"""What is wrong in the paper's print, and that a right print is not called wrong."""

import dataclasses
from fractions import Fraction

import pytest

from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import base_parameters
from modeler.formulas.coefficients import coefficient_table
from modeler.formulas.print_checks import (
    check_independent,
    check_solutions,
    check_twin,
    exact_state,
    power_balance,
    wrong_definitions,
    wrong_functions,
)
from modeler.formulas.print_report import check_friction, terms_report
from modeler.formulas.printed import Coupling
from tests.terms.cases import edited_wrist, model_of, table_of

CORRECTED = [
    ("PS18*s3*s2*c2 + PS2*c3", "PS1*s3*c3*s2*c2 + PS2*c3"),
    ("PS21*s3*c3 + PS22*c3**2 + PS23*s2*c3", "PS21*s3*c3*c2 + PS22*c3**2*c2 + PS23*c2"),
    ('PS40*s2"', 'PS40*s2 - PJ4*c2*s3 - PJ5*c2*c3"'),
    ('S223 = "0"', 'S223 = "-2*PJ1*s3*c3 - 2*PJ2*c3**2 + PJ2"'),
    ("PS45*c3*s3 + ", "PS45*c3*s3*c2**2 + "),
    (
        'PS50*c3*c3 + PS51*s3*c3*s2 + PS52*c3**2*s2 + PS53*s2 + PS54*c2*s3 + PS55*c2*c3"""',
        'PS50"""\nS312 = "PS51*s3*c3*s2 + PS52*c3**2*s2 + PS53*s2 + PS54*c2*s3 + PS55*c2*c3"',
    ),
    ('PJ5 = "2*(cJ13 - cm*ct2*', 'PJ5 = "2*(cJ13 - cm*ct3*'),
    ('cm = ["-PG2**2 + PG3**2", "PJ3 - PS3/2 + PJ1"]', 'cm = ["PG2**2 + PG3**2", "PJ16 - cJ11"]'),
    ('aJ11 = "-PJ7 +', 'aJ11 = ["-PJ7 +'),
    ('+ ct3**2)"\n\n[terms.printed.c', '+ ct3**2)", -1]\n\n[terms.printed.c'),
    ('"PJ10", "PJ13", "PJ16", "PJ19", "PS3",', '"PJ10", "PJ13", "PJ16", "PJ19",'),
]  # fmt: skip


def table_with(*edits: tuple[str, str]):
    model = edited_wrist(*edits)
    return coefficient_table(model, base_parameters(model))


@pytest.fixture(scope="module")
def table():
    return table_of("wrist")


def test_misprinted_functions(table):
    found = {check.name: check for check in wrong_functions(table)}
    assert found.keys() == {"S112", "S122", "S213", "S223", "S311"}
    assert dict(found["S213"].difference) == {"c2*s3": "-PJ4", "c2*c3": "-PJ5"}
    assert dict(found["S223"].difference) == {"c3*s3": "-2*PJ1", "c3**2": "-2*PJ2", "1": "PJ2"}
    assert dict(found["S112"].difference) == {"c2*c3*s2*s3": "2*PJ2", "c2*s2*s3": "-PJ5/2"}


def test_each_misprint_breaks_the_power_balance_and_the_derived_model_does_not(table):
    assert power_balance(table, exact_state(table)) == 0
    for check in wrong_functions(table):
        assert check.power_defect is not None and abs(check.power_defect) > 1e-3


def test_power_defect_of_the_truncated_s213_by_hand(table):
    # -(derived - printed) qd1 qd2 qd3 with PJ4, PJ5 of the example and s, c at the rational state
    cm, ct2, ct3, e, cJ12, cJ13 = 4, 0.02, 0.03, 0.16, 0.002, -0.003
    PJ4, PJ5 = 2 * (cJ12 - cm * ct2 * e), 2 * (cJ13 - cm * ct3 * e)
    c2, s3, c3 = (1 - 1 / 9) / (1 + 1 / 9), 0.8 / (1 + 0.16), (1 - 0.16) / (1 + 0.16)
    expected = (PJ4 * c2 * s3 + PJ5 * c2 * c3) * (1 * -2 * 3)
    found = next(check for check in wrong_functions(table) if check.name == "S213")
    assert float(found.power_defect) == pytest.approx(expected, rel=1e-12)


def test_misprinted_definition_and_its_contradiction(table):
    (check,) = wrong_definitions(table)
    assert check.name == "PJ5"
    spoilt = {
        c.letter: c.verdict for c in check_solutions(table, as_printed=True) if c.verdict != "right"
    }
    assert spoilt.keys() == {"cm", "aJ11", "cJ13"}


def test_solutions(table):
    found = {check.letter: check for check in check_solutions(table)}
    assert len(found) == 18
    assert {k for k, c in found.items() if c.verdict != "right"} == {"cm", "aJ11"}
    assert found["cm"].denominator == "0" and found["cm"].verdict == "divides by 0"
    assert found["aJ11"].verdict == "returns -aJ11"


def test_seventeen_not_eighteen(table):
    assert len(table.printed.independent) == 18
    assert check_independent(table) == {"PS3": "2*PJ1 + 2*PJ3"}


def test_two_wrists_with_the_same_coefficients(table):
    check = check_twin(table)
    assert check.equal == 101 and not check.different
    assert set(check.changed) == {
        "cm", "aJ11", "bt1", "bJ11", "bJ12", "bJ13", "bJ22", "ct2", "ct3", "cJ11", "cJ22", "cJ23",
    }  # fmt: skip


def test_a_twin_that_is_none_is_found_out():
    check = check_twin(table_with(('cm = "21/5"', 'cm = "22/5"')))
    assert {"PG2", "PG3", "PJ16"} <= set(check.different)


def test_a_right_print_is_not_called_wrong():
    table = table_with(*CORRECTED)
    assert wrong_functions(table) == []
    assert wrong_definitions(table) == []
    assert check_independent(table) == {}
    assert {check.verdict for check in check_solutions(table)} == {"right"}


def test_report_without_a_print_has_no_section_on_it():
    model = model_of("two-link")
    page = terms_report(model, base_parameters(model))
    assert "print is wrong" not in page
    assert "## All coefficients" in page


def test_printed_friction_of_coupled_motors_does_not_take_its_power():
    coupling = Coupling(
        ((Fraction(1), Fraction(0)), (Fraction(-1), Fraction(2))),
        (Fraction(3), Fraction(5)),
        (Fraction(1), Fraction(1)),
    )
    check = check_friction(coupling)
    # motor speeds 1 and 1: torques 3 and 5 on the motor side, by hand
    assert check.derived == (3 - 5, 10)
    assert check.derived_power == check.dissipated == 8
    assert check.printed == (3, 10) and check.printed_power == 13
    uncoupled = dataclasses.replace(coupling, motor_from_joint=((1, 0), (0, 2)))
    assert check_friction(uncoupled).printed == check_friction(uncoupled).derived


def test_wrist_friction_as_printed_takes_the_wrong_power(table):
    check = check_friction(table.printed.coupling)
    assert check.derived_power == check.dissipated != check.printed_power


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("coulomb = [3, 2, 1.2]", "", r"printed, coupling: coulomb is missing; expected motor_fr"),
        ("coulomb = [3, 2, 1.2]", "coulomb = [3, 2]", r"coupling: got 3 rows of 3, 3, 3, 2 coul"),
        ("coulomb = [3, 2, 1.2]", 'coulomb = [3, 2, "x"]', r"coulomb, entry 3: got 'x'; expected"),
        ("coulomb = [3, 2, 1.2]", "coulomb = 3", r"coupling, coulomb: got 3; expected a list"),
        ('missing = "PX" ', 'mising = "PX" ', r"\[terms\]: unknown key mising; expected source"),
        ("count = 96", "count = 96.5", r"printed, count: got 96.5; expected a number"),
        ("count = 96", "conut = 96", r"printed: unknown key conut; expected count"),
        ('missing = "PX" ', "missing = 3 ", r"missing: got 3; expected text"),
        ("J33 = [1]", "J33 = 1", r"got 1; expected a list"),
        ("J33 = [1]", 'J33 = ["1 +"]', r'monomials, J33: got "1 \+", which cannot be read'),
        ("J33 = [1]", 'J33 = ["c1"]', r'monomials, J33: got "c1"; expected each at most once: 1'),
        ("J33 = [1]", "J33 = [1, 1]", r'monomials, J33: got "1"; expected each at most once: 1'),
        ("J33 = [1]", "J33 = [2]", r'monomials, J33: got "2"; expected each'),
        ("J33 = [1]", 'J33 = ["x"]', r'monomials, J33: got "x"; expected each'),
        ("J33 = [1]", "J34 = [1]", r"monomials, J34: no such function; the functions are g1"),
        ("am = 12", 'am = "12 kg"', r"example, am: got '12 kg'; expected a number such as 12"),
        ('cm = "21/5"', "cm = [1]", r"twin, cm: got \[1\]; expected a number"),
        ('ct2 = ["-PG2", "cm"]', "ct2 = [1, 2, 3]", r"solutions, ct2: got 3 entries; expected"),
        ("[terms.twin] ", "[terms.twin.a] ", r"twin, a: got \{.*expected a number"),
    ],
)
def test_mistakes_in_terms(old, new, message):
    model = edited_wrist((old, new))
    with pytest.raises(RobotError, match=message):
        coefficient_table(model, base_parameters(model))


@pytest.mark.parametrize(
    ("old", "new", "check", "message"),
    [
        ('J33 = "PJ22"', 'J33 = "PJ77"', wrong_functions, r"functions, J33.*where PJ77 is unknown"),
        ('J33 = "PJ22"', 'J33 = "PJ22 + 1"', wrong_functions, r"J33: got .*expected a sum of coef"),
        ('J33 = "PJ22"', 'J33 = "sin(PJ22)"', wrong_functions, r"J33: got .*expected a polynomial"),
        ('J33 = "PJ22"', 'J77 = "PJ22"', wrong_functions, r"functions: there is no function J77"),
        ('PG2 = "-cm*ct2"', 'PG2 = "-cm*xx"', wrong_definitions, r"PG2.*where xx is unknown"),
        ('PG2 = "-cm*ct2"', 'PG0 = "-cm*ct2"', wrong_definitions, r"there is no coefficient PG0"),
        ('ct3 = ["-PG3", "cm"]', 'cx3 = "PG3"', check_solutions, r"cx3 is no physical parameter"),
        ('"PS3",', '"PS99",', check_independent, r"independent: there is no coefficient PS99"),
    ],
)
def test_mistakes_in_the_quoted_print(old, new, check, message):
    table = table_with((old, new))
    with pytest.raises(RobotError, match=message):
        check(table)
