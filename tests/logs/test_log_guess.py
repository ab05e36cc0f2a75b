"""Columns that are named by words: which of them are one quantity of several joints."""

import numpy as np
import pytest

from modeler.logs.guess import format_log_table, guess_columns
from modeler.logs.mapping import find_unit
from tests.rotation import with_cases


def _found(names: list[str]) -> dict[str, tuple[str, tuple[str, ...]]]:
    draw = np.random.default_rng(3)
    columns = {name: draw.normal(size=50) for name in names}
    columns = {"t": np.arange(50.0)} | columns
    return {one.quantity: (one.template, one.labels) for one in guess_columns(columns, {})}


@with_cases(
    "names, local, template, labels",
    (
        ["Ellbogen Winkel [Grad]", "Schulter Winkel [Grad]"],
        "q",
        "{} Winkel [Grad]",
        ("Ellbogen", "Schulter"),
    ),
    (["elbow_torque", "shoulder_torque"], "tau", "{}_torque", ("elbow", "shoulder")),
    (["angle elbow (deg)", "angle shoulder (deg)"], "q", "angle {} (deg)", ("elbow", "shoulder")),
    (["shoulder pan pos", "shoulder lift pos"], "q", "{} pos", ("shoulder pan", "shoulder lift")),
)
def test_joints_that_are_words(names, local, template, labels) -> None:
    assert _found(names)[local] == (template, labels)


def test_one_such_column_alone_is_no_pattern() -> None:
    assert _found(["elbow angle", "door torque"])["q"] == ("elbow angle", ("",))


def test_numbers_tell_joints_apart_before_words() -> None:
    assert _found(["left pos 1", "left pos 2"])["q"] == ("left pos {}", ("1", "2"))


def test_german_units() -> None:
    same = {"Grad": "deg", "Nmm": "mN m", "Newtonmeter": "N m", "Grad/s": "deg/s"}
    for one, other in ((find_unit(text), find_unit(like)) for text, like in same.items()):
        assert one is not None and other is not None
        assert one.powers == other.powers and one.factor == pytest.approx(other.factor)


def test_joints_with_units_of_their_own_are_one_quantity() -> None:
    """A slide in mm beside axes in degrees; what has another kind stays another quantity."""
    columns = {"t": np.arange(50.0)}
    names = ("axis1 [deg]", "axis2 [deg]", "axis3 [mm]", "axis1 [A]", "axis2 [A]", "axis3 [A]")
    columns |= {name: np.sin(k + np.arange(50.0)) for k, name in enumerate(names)}
    table = guess_columns(columns, {})
    by = {one.quantity: one for one in table}
    assert by["q"].columns == names[:3] and by["q"].units == ("deg", "deg", "mm")
    assert by["current"].columns == names[3:]
    lines = format_log_table(table).splitlines()
    assert lines[2:4] == ['"q<j>" = "axis{j} [deg]"', 'q3 = "axis3 [mm]"']
