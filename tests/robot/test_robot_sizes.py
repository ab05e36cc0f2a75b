"""What is too large, too deep or too many in a robot file is told at its place, before any work."""

import pytest

from modeler.core.errors import RobotError
from modeler.robot.read import robot_from_text


def arm(d: str = "0.3", symbols: str = "", further: str = "", alpha: str = "0") -> str:
    return (
        'name = "arm"\ngravity = [0, 0, "-g"]\n'
        f"[symbols]\ng = 9.81\nL = 0.4\n{symbols}\n[mdh]\n"
        'columns = ["j", "alpha", "d", "theta"]\n'
        f'rows = [["1", 0, 0, "q1"], ["2", "{alpha}", "{d}", "q2"]]\n{further}\n'
    )


def nested(function: str, depth: int) -> str:
    return f"{function}(" * depth + "L" + ")" * depth


CELL = r'arm.toml: \[mdh\], row "2", column d: got '
MOST = r"expected at most "


@pytest.mark.parametrize(
    ("d", "told"),
    [
        (nested("sin", 31), MOST + "30"),
        (nested("sin", 2000), MOST + "4000"),
        (nested("", 500), MOST + "30"),
        ("-" * 100 + "L", MOST + "30"),
        ("+".join(["L"] * 400), "of 399 operations; " + MOST + "300"),
        ("2**2**2**2**2", "an exponent of 6.55e\\+04; " + MOST + "100"),
        ("L**(50 + 51)", "an exponent of 101; " + MOST + "100"),
        ("L**-101", "an exponent of 101; " + MOST + "100"),
        ("L**(10.0**400)", "an exponent of inf; " + MOST + "100"),
        ("10**99*10**99", "which is 1e\\+198; " + MOST),
        ("1e5", "which is 1e\\+05; " + MOST + "10000"),
        ("0**-1", "no finite real value"),
    ],
)
def test_a_cell_that_is_too_much_is_told(d, told):
    with pytest.raises(RobotError, match=CELL + ".*" + told) as caught:
        robot_from_text(arm(d), "arm.toml")
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    "d",
    [
        nested("sin", 30), "+".join(["L/300"] * 100), "*".join(["L"] * 300),
        "1e-300*1e300*L", "L**100", "1e4", "-1e4", "0.5**(2 + pi/pi)", "1e-200",
    ],
)  # fmt: skip
def test_what_is_large_and_allowed_is_read(d):
    value = robot_from_text(arm(d), "arm.toml").joints[1].d
    assert abs(value.number({"L": 0.4, "g": 9.81})) <= 1e4


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (arm("D", 'D = "0.5**N"\nN = 1000000000'), r"\[symbols\], D: got .*a larger exponent"),
        (arm(symbols="D = 1e200"), r"\[symbols\], D: got .*at most 1e\+12"),
        (arm("D", "D = 1e11"), r'column d: got "D", which is 1e\+11; expected at most 10000'),
        (arm(symbols=f"{'D' * 64} = 1"), "of 64 letters; expected at most 63"),
        (arm().replace('"arm"', f'"{"a" * 64}"'), "name: got .*of 64 letters"),
        (arm().replace('"2"', f'"{"2" * 64}"'), "column j: got .*of 64 letters"),
        (arm().replace('"-g"', '"-1e9*g"'), "gravity, entry 3: got .*at most 10000"),
        (arm(further="[parameters]\nM2 = 1e300"), r"\[parameters\], M2: got 1e\+300; .*1e\+12"),
        (arm(further="[coupling]\n2 = '1e5*q1 + q2'"), r'\[coupling\], "2": .*at most 10000'),
        (arm(further="[relations]\nq2 = '1e5*q1'"), r'\[relations\], "q2": .*at most 10000'),
        (
            arm(further='[own_effects.k]\ncolumns = {Kz = "1e300*v"}'),
            r"Kz = .*one of at most 1e\+12",
        ),
    ],
)
def test_names_and_numbers_are_bounded(text, told):
    with pytest.raises(RobotError, match=told):
        robot_from_text(text, "arm.toml")


def chain(rows: int) -> str:
    lines = ",".join(f'["{j}", "pi/2", "q{j}"]' for j in range(1, rows + 1))
    return (
        'name = "c"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "alpha", "theta"]\n'
        f"rows = [{lines}]\n"
    )


def test_the_longest_table_is_read_and_a_longer_one_is_not():
    assert len(robot_from_text(chain(150), "c").joints) == 150
    with pytest.raises(RobotError, match=r"\[mdh\], rows: got 151 rows.*expected at most 150"):
        robot_from_text(chain(151), "c")


def test_too_many_legs_and_loops_are_refused_before_they_are_written_out():
    legs = ", ".join(f'"L{i}"' for i in range(3000))
    with pytest.raises(RobotError, match="legs: got 3000 legs; expected at most 50"):
        robot_from_text(f"legs = [{legs}]\n" + chain(2), "c")
    loops = ", ".join('["A", "1", "3", "rigid"]' for _ in range(51))
    with pytest.raises(RobotError, match=r"\[loops\], rows: got 51 loops.*expected at most 50"):
        robot_from_text(chain(3) + f"[loops]\nrows = [{loops}]", "c")
