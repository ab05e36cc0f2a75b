"""Cells of a table changed in the text of a robot file, and the cell that an error is about."""

import tomllib

import numpy as np
import pytest

from modeler.core.choices import list_builtin_robots, read_builtin_robot
from modeler.core.errors import RobotError
from modeler.robot import (
    find_table_text,
    insert_row,
    locate_error_cell,
    parse_robot_text,
    read_limit_texts,
    read_symbol_texts,
    remove_row,
    replace_cell,
    replace_limits,
    replace_symbol,
    set_joint_effect,
)
from modeler.studio.robot_views import robot_look
from tests.rotation import with_cases


def others(text: str) -> dict:
    """All that a file says but for its rows."""
    document = tomllib.loads(text)
    return {**document, "mdh": {k: v for k, v in document["mdh"].items() if k != "rows"}}


def comments(text: str) -> list[str]:
    return [line.partition("#")[2] for line in text.splitlines() if "#" in line]


@pytest.mark.parametrize("name", list_builtin_robots())
def test_a_cell_changes_alone_and_back(name: str) -> None:
    text, rng = read_builtin_robot(name), np.random.default_rng(len(name))
    table = find_table_text(text)
    assert table is not None
    document = tomllib.loads(text)["mdh"]
    assert list(table.columns) == document["columns"]
    assert [list(row) for row in table.rows] == [list(map(str, r)) for r in document["rows"]]
    for _ in range(6):
        row, column = int(rng.integers(len(table.rows))), int(rng.integers(len(table.columns)))
        changed = replace_cell(text, row, column, 'x + "1"')
        result = find_table_text(changed)
        assert result is not None
        expected = [[*cells] for cells in table.rows]
        expected[row][column] = 'x + "1"'
        assert [[*cells] for cells in result.rows] == expected
        assert others(changed) == others(text) and comments(changed) == comments(text)
        back = replace_cell(changed, row, column, table.rows[row][column])
        assert tomllib.loads(back) == tomllib.loads(text)
        grown = insert_row(text, row, table.rows[row])
        assert find_table_text(grown).rows[row + 1] == table.rows[row]
        assert tomllib.loads(remove_row(grown, row + 1)) == tomllib.loads(text)
        assert comments(grown) == comments(text)


def test_tables_in_one_line_and_with_comments() -> None:
    text = (
        'name = "x"\n[mdh]\ncolumns = ["j", "theta"] # c\nrows = [["1", "q1"], ["2", "q2"]] # d\n'
    )
    assert insert_row(text, 1, ["3", "q3"]).count("# d") == 1
    assert find_table_text(insert_row(text, 0, ["3", "q3"])).rows[1] == ("3", "q3")
    assert find_table_text(remove_row(text, 1)).rows == (("1", "q1"),)
    rows = '  ["1"], # the first, "not a cell", [nor] this\n  ["2"]\n'
    text = f'[mdh]\ncolumns = ["j"]\nrows = [\n{rows}]\n'
    assert find_table_text(text).rows == (("1",), ("2",))
    assert "the first" in insert_row(text, 0, ["9"])
    assert find_table_text(insert_row(text, 1, ["9"])).rows[2:]
    assert find_table_text(remove_row(text, 0)).rows == (("2",),)


@with_cases("change", lambda t: replace_cell(t, 9, 0, "1"), lambda t: remove_row(t, 9))
def test_a_row_that_is_not_there_is_told(change) -> None:
    with pytest.raises(RobotError, match=r"\[mdh\]: there is no row 10; edit the file as text"):
        change(read_builtin_robot("demo-arm"))
    with pytest.raises(RobotError, match=r"the text has no table \[mdh\]|columns and rows are not"):
        change('name = "x"\n')


ARM = read_builtin_robot("demo-arm")  # columns j a sigma alpha d theta r
CRAIG = """name = "c"
gravity = [0, 0, -9.81]
[mdh]
convention = "craig"
columns = ["j", "alpha", "a", "d", "theta"]
rows = [
    ["1", 0, 0, 0, "q1"],
    ["2", "-90 deg", 0.4, 0.1, "q2"],
]
"""
DH = (
    CRAIG.replace("craig", "classical")
    .replace('"j", "alpha", "a", "d", "theta"', '"j", "theta", "d", "a", "alpha"')
    .replace('0, 0, 0, "q1"', '"q1", 0.2, 0.3, "90 deg"')
    .replace('"-90 deg", 0.4, 0.1, "q2"', '"q2", 0, 0.4, 0')
)
MISTAKES = {
    "a name that is not declared": (ARM, 1, 4, "D9", (1, 4)),
    "no expression": (ARM, 2, 4, "0.4 +", (2, 4)),
    "an unknown antecedent": (ARM, 1, 1, "7", (1, 1)),
    "a later antecedent": (ARM, 0, 1, "3", (0, 1)),
    "the variable of another row": (ARM, 2, 5, "q3 + q1", (2, 5)),
    "no variable": (ARM, 2, 5, "0", (2, 5)),
    "the variable in the wrong column": (ARM, 2, 6, "q3", (2, 6)),
    "a gear ratio": (ARM, 0, 5, "2*q1", (0, 5)),
    "a kind that is none": (ARM, 0, 2, "5", (0, 2)),
    "a length for an angle": (ARM, 1, 3, "40 mm", (1, 3)),
    "an angle for a length": (ARM, 1, 4, "40 deg", (1, 4)),
    "more than a turn": (ARM, 1, 3, "90", (1, 3)),
    "a length of a mile": (ARM, 1, 4, "20000", (1, 4)),
    "a name twice": (ARM, 2, 0, "2", (2, 0)),
    "a name that is none": (ARM, 2, 0, "a b", (2, 0)),
    "a function that is none": (ARM, 1, 4, "open(1)", (1, 4)),
    "a column that is none": (ARM, -1, 3, "alfa", (-1, -1)),
    "Craig's a": (CRAIG, 1, 2, "A2", (1, 2)),
    "Craig's d": (CRAIG, 1, 3, "q2", (1, 3)),
    "a of Denavit and Hartenberg": (DH, 0, 3, "L1", (0, 3)),
    "alpha of the last row": (DH, 1, 4, "beta", (1, 4)),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_an_error_is_at_its_cell(mistake: str) -> None:
    """The cell that was spoilt is the one that is named, and the last text is kept as it is."""
    text, row, column, cell, expected = MISTAKES[mistake]
    assert not robot_look(text).error
    spoilt = replace_cell(text, row, column, cell)
    look = robot_look(spoilt)
    assert look.error and look.content is None, look.error
    assert look.wrong_cell == expected, look.error
    assert "\n" not in look.error
    with pytest.raises(RobotError) as result:
        parse_robot_text(spoilt, "robot.toml")
    assert str(result.value) == look.error


def test_errors_of_legs_are_at_the_row_that_they_are_written_in() -> None:
    text = read_builtin_robot("orthoglide-2003")
    look = robot_look(replace_cell(text, 4, 5, "b33"))
    assert look.wrong_cell == (4, 5) and 'row "31"' in look.error
    good = robot_look(text)
    assert good.names[3:5] == (("21", "22", "23"), ("31", "32", "33"))
    assert (
        locate_error_cell("something else", text) is None
        and locate_error_cell('[mdh], row "zz": x', text) is None
    )


def test_what_stands_elsewhere_is_named_too() -> None:
    assert robot_look(replace_symbol(ARM, "D2", "D7")).named == ("symbols", "D2")
    assert robot_look(replace_limits(ARM, "2", ["5", "1", "1", "1"])).named == ("limits", "2")
    look = robot_look(ARM.replace("rows = [", "rows = ["))
    assert look.named == () and robot_look(ARM.replace("gravity", "gravty")).wrong_cell is None
    broken = robot_look(ARM.replace('"q1",     0],', '"q1",     0,'))
    assert "not TOML" in broken.error


@pytest.mark.parametrize("name", list_builtin_robots())
def test_letters_limits_and_effects_change_alone(name: str) -> None:
    text = read_builtin_robot(name)
    before = tomllib.loads(text)
    for letter, value in read_symbol_texts(text).items():
        changed = replace_symbol(text, letter, value)
        assert tomllib.loads(changed) == before and comments(changed) == comments(text)
        assert read_symbol_texts(replace_symbol(text, letter, "1.5 mm"))[letter] == "1.5 mm"
    look = robot_look(text)
    joint = look.joints[0].name
    changed = replace_limits(text, joint, ["-0.1", "0.2", "1", "2"])
    assert read_limit_texts(changed)[joint] == ("-0.1", "0.2", "1", "2")
    assert tomllib.loads(changed) | {"limits": 0} == before | {"limits": 0}
    assert joint not in read_limit_texts(replace_limits(changed, joint, ["", "", "", ""]))
    viscous = ["viscous" in joint.effects for joint in look.joints]
    turned = set_joint_effect(text, "viscous", joint, not viscous[0], look.everyone)
    try:
        robot = parse_robot_text(turned, name)
    except RobotError as error:  # a value or a priority of that effect stands elsewhere
        assert "Fv" in str(error) or "passive" in str(error)
    else:
        assert robot.has_effect("viscous", joint) is not viscous[0]
        back = set_joint_effect(turned, "viscous", joint, viscous[0], look.everyone)
        robot = parse_robot_text(back, name)
        assert [robot.has_effect("viscous", joint.name) for joint in look.joints] == viscous
