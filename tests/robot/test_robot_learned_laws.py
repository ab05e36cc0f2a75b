"""The key `law` of [own_effects]: mistakes are told in one line, tables of any size are read."""

import re
import time

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.core.law import MOST, Law
from modeler.robot.read import robot_from_text
from tests.learned import drawn, text_with

TABLE = "{low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}"
MISTAKES = {
    "no table": ("law(q)", "", r"columns, Kw: got \"law\(q\)\": no function law; .*key `law`"),
    "a name": ("law*q", TABLE, r"law needs an argument, as in law\(x\)"),
    "two for one": ("law(q, v)", TABLE, "law takes one argument"),
    "one for two": (
        "law(q)", "{low = [0, 0], high = [1, 1], cells = [1, 1], values = [%s]}" % ("1, " * 16),
        "law takes 2 arguments",
    ),
    "not called": ("q", TABLE, "law: no equation calls law; use it, as in law"),
    "no list": ("law(q)", TABLE.replace("[2]", "2"), "law, cells: got 2; expected a list of num"),
    "a word": ("law(q)", TABLE.replace("[-1]", '["a"]'), "law, low: got \"a\"; expected"),
    "no number": ("law(q)", TABLE.replace("[-1]", "[nan]"), "law, low: got nan; expected"),
    "a key too many": ("law(q)", TABLE[:-1] + ", odd = true}", "law: .*odd"),
    "a key too few": ("law(q)", "{low = [0], high = [1], cells = [1]}", "law: .*values.*missing"),
    "no axis": ("law(q)", TABLE.replace("[-1]", "[]"), "law: got 0, 1 and 1 entries of low, hi"),
    "three axes": (
        "law(q)", "{low = [0, 0, 0], high = [1, 1, 1], cells = [1, 1, 1], values = []}",
        "got 3, 3 and 3 entries .* which has one or two",
    ),
    "turned": ("law(q)", TABLE.replace("[-1]", "[1]"), "got an axis from 1 to 1 of 2 cells; exp"),
    "too narrow": (
        "law(q)", TABLE.replace("[-1]", "[0]").replace("[1]", "[1e-315]"), "got an axis from 0 to",
    ),
    "half a cell": ("law(q)", TABLE.replace("[2]", "[2.5]"), "of 2.5 cells; expected low < high"),
    "no cell": ("law(q)", TABLE.replace("[2]", "[0]"), "of 0 cells; expected"),
    "too few": ("law(q)", TABLE.replace("[2]", "[3]"), "values: got 5 numbers; expected 6, 3 more"),
    "too many": (
        "law(q)", TABLE.replace("[2]", "[1e12]"), "values: got 5 numbers; expected 1000000000003",
    ),
}  # fmt: skip


def text_of(equation: str, table: str) -> str:
    own = f'[own_effects.brake]\ncolumns = {{Kw = "{equation}"}}\n'
    text = text_with("two-link", {}, 'brake = ["2"]\n')
    return text.replace("[effects]\n", f"{own}{'law = ' * bool(table)}{table}\n\n[effects]\n")


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told_in_one_line(mistake: str) -> None:
    equation, table, message = MISTAKES[mistake]
    with pytest.raises(RobotError) as told:
        robot_from_text(text_of(equation, table), "arm")
    assert "[own_effects.brake]" in str(told.value) and "\n" not in str(told.value)
    assert re.search(message, str(told.value)), str(told.value)


def test_a_message_never_shows_a_whole_table() -> None:
    cells = [float(x) for x in np.linspace(0, 1, 3000)]
    for wrong in (f"{{low = {cells}}}", f"{cells}", TABLE.replace("[2]", str(cells))):
        with pytest.raises(RobotError) as told:
            robot_from_text(text_of("law(q)", wrong), "arm")
        assert len(str(told.value)) < 500


def test_the_largest_table_is_read() -> None:
    law = drawn(np.random.default_rng(1), 2, (97, 97))
    assert len(law.values) == MOST
    text = text_with("two-link", {"1": ("law(q, v)", law)})
    begin = time.process_time()
    robot = robot_from_text(text, "arm")
    assert time.process_time() - begin < 10
    (effect,) = robot.own_effects
    assert effect.columns[0].equation.law == law
    assert isinstance(effect.columns[0].equation.law, Law)
