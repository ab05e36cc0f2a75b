"""What is too large, deep or many in a robot file is reported at its place, before any work."""

import pytest

from modeler.core.errors import RobotError
from modeler.robot.read import parse_robot_text
from tests.rotation import with_cases


def arm(d: str) -> str:
    return (
        'name = "arm"\ngravity = [0, 0, -9.81]\n[symbols]\nL = 0.4\n[mdh]\n'
        f'columns = ["j", "d", "theta"]\nrows = [["1", 0, "q1"], ["2", "{d}", "q2"]]\n'
    )


@with_cases(
    "d",
    "sin(" * 30 + "L" + ")" * 30,
    "+".join(["L/300"] * 100),
    "*".join(["L"] * 300),
    *"1e-300*1e300*L L**100 1e4 -1e4".split(),
    "0.5**(2 + pi/pi)",
    "1e-200",
)
def test_what_is_large_and_allowed_is_read(d):
    value = parse_robot_text(arm(d), "arm.toml").joints[1].d
    assert abs(value.evaluate({"L": 0.4})) <= 1e4


def chain(rows: int) -> str:
    lines = ",".join(f'["{j}", "pi/2", "q{j}"]' for j in range(1, rows + 1))
    return (
        'name = "c"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "alpha", "theta"]\n'
        f"rows = [{lines}]\n"
    )


def test_the_longest_table_is_read_and_a_longer_one_is_not():
    assert len(parse_robot_text(chain(150), "c").joints) == 150
    with pytest.raises(RobotError, match=r"\[mdh\], rows: got 151 rows.*expected at most 150"):
        parse_robot_text(chain(151), "c")


def test_too_many_legs_and_loops_are_refused_before_they_are_written_out():
    legs = ", ".join(f'"L{i}"' for i in range(3000))
    with pytest.raises(RobotError, match="legs: got 3000 legs; expected at most 50"):
        parse_robot_text(f"legs = [{legs}]\n" + chain(2), "c")
    loops = ", ".join('["A", "1", "3", "rigid"]' for _ in range(51))
    with pytest.raises(RobotError, match=r"\[loops\], rows: got 51 loops.*expected at most 50"):
        parse_robot_text(chain(3) + f"[loops]\nrows = [{loops}]", "c")
