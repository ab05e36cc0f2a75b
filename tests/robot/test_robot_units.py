"""Units of lengths, swapped units, and slips of a table that are reported."""

import re
from fractions import Fraction

import pytest

from modeler.cli import main
from modeler.core.expression import parse_expression
from modeler.robot.read import parse_robot_text

METRES = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": 1, "in": Fraction(254, 10000)}


def arm(rows, columns='"j", "theta", "alpha", "d"', further=""):
    head = 'name = "arm"\ngravity = [0, 0, -9.81]\n'
    return parse_robot_text(f"{head}{further}\n[mdh]\ncolumns = [{columns}]\nrows = [{rows}]", "a")


def exact(text):
    return parse_expression(text).fold({}, {}, None, lambda value: value)


@pytest.mark.parametrize("unit", METRES)
@pytest.mark.parametrize("digits", ["60", "12.5", "1e-2"])
@pytest.mark.parametrize("gap", [" ", ""])
def test_lengths_with_units_are_exact(unit, digits, gap):
    worth = Fraction(digits) * METRES[unit]
    assert exact(f"{digits}{gap}{unit}") == worth
    assert exact(f"-{digits} {unit} + 3/8 in") == -worth + Fraction(3, 8) * METRES["in"]
    assert parse_expression(f"{digits} {unit}").evaluate() == float(worth)


def test_units_stand_wherever_degrees_do():
    text = '[symbols]\nD2 = "60 mm"\nL = "D2 + 40 mm"\n[limits]\n2 = ["-10 cm", "0.2 m", 1, 1]\n'
    text += '[home]\nq2 = "12 mm"'
    rows = '["1", 0, "q1", 0, "D2"], ["2", 1, 0, 0, "q2 + 400 mm"]'
    robot = arm(rows, '"j", "sigma", "theta", "d", "r"', text)
    assert robot.evaluate_symbols() == {"D2": 0.06, "L": 0.1}
    assert (robot.limits["2"].lower, robot.home["2"]) == (-0.1, 0.012)
    assert robot.get_joint("2").r.evaluate({"q2": 0.0}) == 0.4
    assert robot.readings == ()


@pytest.mark.parametrize("cell", ["R*sin(30 deg)", "R*(30 deg)", "cos((A)) * 3 m"])
def test_angles_within_lengths_are_fine(cell):
    robot = arm(f'["1", "q1", 0, "{cell}"]', further='[symbols]\nR = 0.2\nA = "30 deg"')
    assert robot.get_joint("1").d.names


def test_lengths_in_mm_are_told():
    rows = '["1", "q1", 0, 60], ["2", "q2", 0, "D3"]'
    (text,) = arm(rows, further="[symbols]\nD3 = 400").readings
    assert 'row "2", column d, is 400 m' in text and '"400 mm"' in text
    assert arm('["1", "q1", 0, 19]').readings == ()
    assert arm('["1", "q1", 0, "60 m"]').readings == ()


def test_a_variable_in_two_rows_is_told_unless_it_is_meant():
    slip = '["1", "q1", 0, 0], ["2", "q2", 0, 0.3], ["3", "q2", 0, 0.4]'
    (text,) = arm(slip).readings
    assert text.startswith('row "3" moves with q2') and "write q3" in text
    assert arm(slip.replace('["3", "q2"', '["3", "-q2"')).readings == ()
    meant = re.sub(r"(\d)\]", r"\1, 1]", slip).replace("0.4, 1]", "0.4, 0]")
    assert arm(meant, '"j", "theta", "alpha", "d", "mu"').readings == ()
    stated = slip.replace('["3", "q2"', '["3", "q3"')
    assert arm(stated, further='[relations]\nq3 = "q2"').readings == ()


def test_a_robot_without_title_prints_its_name_once(capsys, tmp_path):
    rows = '["1", "q1", 0, 0], ["2", "q2", "pi/2", 0.06], ["3", "q3", 0, 0.4]'
    path = tmp_path / "arm.toml"
    path.write_text(arm(rows).text, encoding="utf-8")
    assert main(["derive", str(path)]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[0] == "arm"
    # what would fill more than a page is counted
    (line,) = [line for line in out.splitlines() if "PG/PJ/PS" in line]
    assert int(line.split()[0]) > 40 and "--terms" in line and "PJ1 " not in out
