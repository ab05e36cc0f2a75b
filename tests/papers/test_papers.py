"""What papers print, beside what is derived."""

import dataclasses
import json
import re
from functools import cache

import pytest

from modeler.cli import main
from modeler.core.choices import list_papers
from modeler.papers.paper import PrintedLine, read_paper
from modeler.papers.quotation import QuotationError, format_sum, read_numbers, read_sum
from modeler.papers.readings import LineVerdict, check_line, check_paper
from tests.papers.derived_papers import robots_of
from tests.rotation import with_cases

CLOSED = "orthoglide-2012"
DIFFERENT = {"guegan-2003": 9, "briot-2012": 6, "houda": 11, "hanssen-2000": 19}


@cache
def lines_of(name):
    return check_paper(read_paper(name), robots_of(name))


def one(name, **changes):
    """The verdict on a line of the paper's first robot."""
    paper = read_paper(name)
    line = PrintedLine(**({"robot": paper.robots[0], "place": "", "legs": ("",)} | changes))
    return check_line(paper, line, robots_of(name))


@pytest.mark.rotating("long tests of papers")
@pytest.mark.parametrize("name", list_papers())
def test_nothing_differs_but_what_is_known_to(name):
    lines = lines_of(name)
    assert [line for line in lines if line.verdict is LineVerdict.DIFFERENT] == []
    different = [line for line in lines if line.verdict is LineVerdict.MISPRINT]
    assert len(different) == DIFFERENT[name]
    assert all(line.slip and line.reason for line in different)
    for line in lines:  # what is called equal is checked exactly
        exact = line.verdict in (LineVerdict.EQUAL, LineVerdict.ROUNDED)
        assert not (exact and any(sign in line.derived_text for sign in "<>")), line


def test_the_command_ends_well(capsys, tmp_path):
    place = tmp_path / "lines.json"
    assert main(["reproduce", "briot-2012", "--section", "print", "--json", str(place)]) == 0
    assert "printed and equal" in capsys.readouterr().out
    data = json.loads(place.read_text())
    assert {line["verdict"] for line in data["lines"]} >= {"printed and different"}
    assert "methods" not in data


def test_a_line_that_differs_ends_with_status_1(capsys, monkeypatch):
    paper = read_paper("hanssen-2000")
    wrong = dataclasses.replace(paper.lines[1], quote="as many as 33 physical parameters")
    changed = dataclasses.replace(paper, lines=(wrong,))
    monkeypatch.setattr("modeler.papers.read_paper", lambda name: changed)
    assert main(["reproduce", "hanssen-2000", "--section", "print"]) == 1
    assert "1 line is different: as many as 33 physical" in capsys.readouterr().err


def test_a_known_difference_that_is_not_there_is_a_difference():
    right = {"robot": CLOSED, "check": "relation", "quote": "Fv21R = Fv21 + Fv51"}
    assert one("briot-2012", **right).verdict is LineVerdict.EQUAL
    result = one("briot-2012", **right, difference="Fv31", slip="omission")
    assert result.verdict is LineVerdict.DIFFERENT


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("briot-2012", {"robot": "orthoglide-2012-tree", "check": "row", "legs": ("1",),
                        "quote": "2i | 1i | 1 | 0 | 0 | 0 | -pi/2 | 0 | q2i | 0",
                        "difference": "-1 inmu", "slip": "error"}),
        ("guegan-2003", {"check": "effort", "quote": "^0Jp^T (^0Fp", "slip": "scan",
                         "expected": ("platform", "motors", "Fp"),
                         "difference": "Fp Jpinv - Fp Jp"}),
        ("houda", {"check": "element", "quote": "h2^4 = (cos theta2 qd1)^2",
                   "expected": ("11", "21")}),
        ("houda", {"check": "recursion", "expected": ("angular",), "quote": "qdk (^kak"}),
        ("houda", {"check": "energy", "expected": ("XY",), "quote": "1/2 omega1 omega2",
                   "difference": "1/2 w1 w2 inXY", "slip": "misprint",
                   "correction": "2 omega1 omega2"}),
        ("hanssen-2000", {"check": "velocity", "expected": ("vCMa",), "quote": "-at3 qd1"}),
        ("hanssen-2000", {"check": "indices", "quote": "Jij ddotqi + gi = taui"}),
    ],
)  # fmt: skip
def test_a_wrong_charge_or_a_wrong_equality_is_different(name, changes):
    """Charges and equalities that earlier versions reported, and some that would be like them."""
    assert one(name, **changes).verdict is LineVerdict.DIFFERENT


NUMBERED = {"guegan-2003": (44, 3), "briot-2012": (4, 3), "houda": (19, 2), "hanssen-2000": (3, 0)}
"""Equations and tables with a number."""


@pytest.mark.parametrize("name", list_papers())
def test_nothing_of_the_paper_is_passed_over(name):
    """Every equation and table stands in a line, or among what is not checked with its reason."""
    paper = read_paper(name)
    assert all(paper.unchecked.values())
    data = {"eq": set(), "Table": set()}
    listed = r"(eq|Table)s?\.? (\(?\d+\)?(?:(?:-|, | and )\(?\d+\)?)*)"
    for place in (*(line.place for line in paper.lines), *paper.unchecked):
        for kind, numbers in re.findall(listed, place):
            for first, last in re.findall(r"(\d+)\)?(?:-\(?(\d+))?", numbers):
                data[kind] |= set(range(int(first), int(last or first) + 1))
    equations, tables = NUMBERED[name]
    assert set(range(1, equations + 1)) - data["eq"] == set()
    assert set(range(1, tables + 1)) - data["Table"] == set()


def test_decimals_hold_to_their_printed_digits():
    text = "M13R = M13 + M23 - {}MX33 + M33"
    table = {
        number: one("briot-2012", robot=CLOSED, check="relation", quote=text.format(number)).verdict
        for number in ("3.2258", "3.226", "3.23", "3.2", "3.2257", "3.22", "3.3")
    }
    equal = {number for number, verdict in table.items() if verdict is LineVerdict.ROUNDED}
    assert equal == {"3.2258", "3.226", "3.23", "3.2"}


def test_a_sealed_quotation_may_not_be_touched():
    line = next(line for line in read_paper("guegan-2003").lines if line.is_measured)
    paper, robots = read_paper("guegan-2003"), robots_of("guegan-2003")
    assert check_line(paper, line, robots).verdict is LineVerdict.MEASURED
    touched = dataclasses.replace(line, quote=line.quote.replace("4805.57", "4805.58"))
    out = check_line(paper, touched, robots)
    assert out.verdict is LineVerdict.DIFFERENT and "not those that were read" in out.derived_text


@with_cases(
    "check, quote, gives, text",
    ("relation", "M11R + M12", (), "is no equation"),
    ("relation", "M99R = M11", (), "M99R is no base parameter"),
    ("relation", "M11R = M11 +", (), 'got "the end"; expected a name or a number'),
    ("relation", "M11R = M11^x", (), 'got the exponent "x"'),
    ("relation", "M11R = M11/(M12 + M13)", (), "below a fraction line"),
    ("numbers", "7 and 8", ("1",), "2 numbers are quoted, 1 are derived"),
    ("numbers", "7", ("count(ghosts())",), "asks for ghosts, which is not known here"),
    ("names", "M11, 5", ("base()",), "is no list of names"),
    ("arithmetic", "7", ("b = 2*a",), "has no number b"),
    ("row", "11 | 0", (), "2 cells are quoted, a row has 10"),
    ("row", "99 | 0 | 1 | 1 | 0 | 0 | 0 | 0 | 0 | q99", (), "there is no row 99"),
    ("tied", "q99 = q11", (), "there is no joint variable q99"),
    ("tied", "q41 = -q31, q41 = -q31", (), "q41 is given twice"),
)
def test_what_cannot_be_read_is_different_and_says_why(check, quote, gives, text):
    result = one("briot-2012", robot=CLOSED, check=check, quote=quote, expected=gives)
    assert result.verdict is LineVerdict.DIFFERENT
    assert text in result.derived_text


def test_sums_are_read_as_they_are_printed():
    assert format_sum(read_sum("ZZ2 + D4^2 M4 - MX3/D4", str)) == "ZZ2 + D4^2*M4 - MX3/D4"
    assert format_sum(read_sum("- sin theta2 qd1", str)) == "-qd1*sin(theta2)"
    legs = format_sum(read_sum("sum_i [ M4i + 1/2 M3i ]", str, "12"))
    assert legs == "M41 + 1/2*M31 + M42 + 1/2*M32"
    with pytest.raises(QuotationError, match="expected a name or a number"):
        read_sum("+", str)


def test_numbers_are_those_between_the_words():
    text = "50 000 of M7, qp in R^12, 33,7 and (160x1), -3.5 in r2 = 10"
    assert [float(n.value) for n in read_numbers(text)] == [50000, 12, 33.7, 160, -3.5, 10]
