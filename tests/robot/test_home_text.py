"""[home] is written into robot files, and all else in them stays as it was."""

import tomllib

import pytest

from modeler.core.errors import RobotError
from modeler.robot.edit import replace_home
from modeler.robot.read import parse_robot_text

BEFORE = """\
name = "pair"                         # two sliders
gravity = [0, 0, -9.81]
legs = ["1", "2"]

[mdh]
columns = ["j", "a", "mu", "sigma", "theta", "r"]
rows = [
  ["1{i}", "0", 1, 1, 0, "q1{i}"],
  ["2{i}", "1{i}", 0, 0, "q2{i}", 0],
  ["e{i}", "2{i}", 0, 2, 0, 0],
]

[loops]
rows = [
["a{i}", "e{i}", "0", "position"]
]
"""
HOME = """
# about the home

[home]                                # as drawn
# the sliders
"q1{i}" = 0.2                         # m, both
q21 = "-pi/2"                         # rad

# what comes next
"""
AFTER = """
[effects]
viscous = "all"
"""
NEW = {"11": 0.25, "12": 0.25, "21": -1.5707963, "22": 0.7}


def stated(text: str) -> dict[str, float]:
    return dict(parse_robot_text(text, "pair.toml").home)


def changed(text: str, home: dict[str, float]) -> str:
    return replace_home(text, stated(text), home)


def test_values_change_in_their_lines_and_comments_stay() -> None:
    written = changed(BEFORE + HOME + AFTER, NEW)
    expected = HOME.replace('"q1{i}" = 0.2  ', '"q1{i}" = 0.25 ')
    expected = expected.replace("# rad\n", "# rad\nq22 = 0.7\n")
    assert written == BEFORE + expected + AFTER
    assert stated(written) == pytest.approx(NEW, abs=1e-6)


def test_legs_that_differ_get_lines_of_their_own() -> None:
    written = changed(BEFORE + HOME + AFTER, {**NEW, "12": 0.3})
    assert (
        'q21 = "-pi/2"                         # rad\nq22 = 0.7\nq11 = 0.25\nq12 = 0.3\n' in written
    )
    assert stated(written) == pytest.approx({**NEW, "12": 0.3}, abs=1e-6)


@pytest.mark.parametrize("after", [AFTER, "\n# the effects\n[effects]\n", ""])
def test_a_missing_table_comes_after_the_loops(after) -> None:
    written = changed(BEFORE + after, NEW)
    table = '[home]\nq11 = 0.25\nq12 = 0.25\nq21 = "-pi/2"\nq22 = 0.7\n'
    assert written.replace("\n" + table, "", 1).strip() == (BEFORE + after).strip()
    assert written.index("[loops]") < written.index("[home]")
    assert stated(written) == pytest.approx(NEW, abs=1e-6)


@pytest.mark.parametrize("value", [0.1 + 0.2, 1e-9, -0.7853981634])
def test_numbers_are_read_as_they_were_given(value) -> None:
    assert stated(changed(BEFORE, {**NEW, "22": value}))["22"] == pytest.approx(value, abs=1e-9)


def test_an_inline_table_stays_one() -> None:
    written = changed("home = {q22 = 0.1}\n" + BEFORE, NEW)
    assert stated(written) == pytest.approx(NEW, abs=1e-6)
    assert written.startswith("home = {q22 = 0.7") and written.endswith(BEFORE)


def test_dotted_keys_are_refused() -> None:
    with pytest.raises(RobotError, match=r"cannot be replaced; write them as a table \[home\]"):
        changed("home.q22 = 0.1\n" + BEFORE, NEW)


def test_a_head_within_a_text_is_no_head() -> None:
    notes = 'notes = """\n[home]\nnothing\n"""\n'
    text = BEFORE.replace("legs =", notes + "legs =")
    written = changed(text, NEW)
    assert tomllib.loads(written)["notes"] == tomllib.loads(text)["notes"]
    assert stated(written) == pytest.approx(NEW, abs=1e-6)
