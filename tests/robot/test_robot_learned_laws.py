"""The key `law` of [own_effects]: mistakes are told in one line, tables of any size are read."""

import time

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.core.law import MOST, Law
from modeler.robot.read import robot_from_text
from tests.learned import drawn, text_with
from tests.robot.texts import LAW

TABLE = "{low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}"


def test_a_message_never_shows_a_whole_table() -> None:
    cells = [float(x) for x in np.linspace(0, 1, 3000)]
    for wrong in (f"{{low = {cells}}}", f"{cells}", TABLE.replace("[2]", str(cells))):
        with pytest.raises(RobotError) as told:
            robot_from_text(LAW.replace(TABLE, wrong), "arm")
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
