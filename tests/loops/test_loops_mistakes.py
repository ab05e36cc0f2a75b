"""Loops that leave too much or too little free, cannot close, or are singular: one line each."""

import pytest

from modeler.cli import main
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import LoopError
from modeler.derivation.derive import derive_model
from modeler.derivation.geometry import build_exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.model import SymbolicModel
from modeler.robot.read import parse_robot_text
from tests.robot_texts import CRANK, PARALLELOGRAM

MISTAKES = [
    ("two motors", '"3", "0", 0, 1', '"3", "0", 1, 1', "1 degree of freedom, 2 joints are actuated "
     r"\(1, 3\): over-constrained by loop \"pin\"; close it by a joint that leaves more degrees"),
    ("loop that closes nothing", '"tip", "3", "position"', '"tip", "0", "planar"',
     r"leave 3 degrees of freedom, 1 joints are actuated \(1\): under-constrained, joints 2, 3"),
    ("lengths that never meet", '"R", "q2", 0]', '"R", "q2", 0.2]',
     r'\[home\]: loop "pin" cannot close near that posture \(open by 0.2\), nor from 300 others '
     "without being singular; check the lengths, and the joints of"),
    ("axes that never meet", '"position"', '"revolute"', 'loop "pin" cannot close near'),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "text"), [pytest.param(*m[1:], id=m[0]) for m in MISTAKES])
def test_what_is_wrong_with_a_loop_is_told(old, new, text):
    assert CRANK.count(old) == 1
    with pytest.raises(LoopError, match=text) as caught:
        derive_model(parse_robot_text(CRANK.replace(old, new), "crank.toml"))
    assert str(caught.value).startswith("crank: ") and "\n" not in str(caught.value)


def test_opposite_axes_are_not_a_closed_loop():
    """The parallelogram's frames 9 and 10 must coincide, not stand back to back."""
    text = read_builtin_robot("sr400").replace('q9 = "1.3 + pi"', "q9 = 1.3")
    relations = derive_model(parse_robot_text(text, "sr400.toml")).robot.relations
    assert relations["9"].text in ("-q2 + q7 + pi", "-q2 + q7 - pi")


def test_coefficients_of_robots_with_loops_are_refused(capsys):
    assert main(["derive", "five-bar", "--closed-form", "--expanded"]) == 1
    text = capsys.readouterr().err
    assert text.count("\n") == 1 and text.startswith("modeler: five-bar: coefficients and expanded")
    assert "leave out --terms" in text and "--closed-form, which has J_t" in text


@pytest.mark.parametrize("lean", [0.0, 1e-7])
def test_a_flat_parallelogram_is_singular(lean):
    """All bars on one line: the closing equation along it changes in second order only."""
    home = f"[home]\nq1 = {lean}\nq2 = {-lean}\nq4 = {lean}\n"
    flat = parse_robot_text(PARALLELOGRAM + home, "parallelogram.toml")
    upright = parse_robot_text(PARALLELOGRAM + "[home]\nq1 = 1\nq2 = -1\nq4 = 1\n", "p.toml")
    assert SymbolicModel(upright, build_exact_geometry(upright), Graph(), ()).closure is not None
    with pytest.raises(LoopError, match=r"the loops are singular at \[home\]: joints 2, 4 could"):
        _ = SymbolicModel(flat, build_exact_geometry(flat), Graph(), ()).closure
    with pytest.raises(LoopError, match=r"the loops are singular at \[home\]: joints 2, 4 could"):
        derive_model(flat)


def test_angles_do_not_count_as_lengths():
    turned = PARALLELOGRAM.replace('"q1"', '"q1 + turn"').replace("B = 0.7", "B = 0.7\nturn = 3")
    robot = parse_robot_text(turned + "[home]\nq1 = 1\nq2 = -1\nq4 = 4\n", "parallelogram.toml")
    closure = SymbolicModel(robot, build_exact_geometry(robot), Graph(), ()).closure
    assert closure is not None and closure.size == 0.7
