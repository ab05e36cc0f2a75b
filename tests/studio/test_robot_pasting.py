"""Tables from the clipboard of a spreadsheet: the robot they mean, whatever letters and units."""

import math

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.robot import (
    build_pasted_robot,
    insert_pasted_table,
    parse_pasted_cells,
    parse_pasted_table,
    parse_robot_text,
    read_symbol_texts,
)
from modeler.views.robot_skeleton import build_skeleton, compute_poses
from tests.elementary_motions import row_pose
from tests.rotation import with_cases


def hand(kind: str, rows: np.ndarray, q: np.ndarray) -> np.ndarray:
    """The last frame by the book: rows are alpha, a (d of Khalil's), theta, d (r), rad and m."""
    pose = np.eye(4)
    for (alpha, a, theta, d), item in zip(rows, q, strict=True):
        if kind == "classical":
            pose = pose @ row_pose(gamma=theta + item, b=d, d=a, alpha=alpha)
        else:
            pose = pose @ row_pose(alpha=alpha, d=a, theta=theta + item, r=d)
    return pose


def frame_of(text: str, q: np.ndarray) -> np.ndarray:
    return np.asarray(compute_poses(build_skeleton(parse_robot_text(text, "pasted")), q)[-1])


HEADS = {
    "classical": ["Joint", "\u03b8i [deg]", "di [mm]", "ai [mm]", "\u03b1i [deg]"],
    "craig": ["i", "\u03b1i\u22121 (\u00b0)", "ai\u22121 (mm)", "di (mm)", "\u03b8i (\u00b0)"],
    "khalil": ["j", "alpha_j [deg]", "d_j [mm]", "theta_j [deg]", "r_j [mm]"],
}


@pytest.mark.parametrize("comma", [",", "."])
@pytest.mark.parametrize("kind", HEADS)
@pytest.mark.parametrize("seed", [1, 2])
def test_degrees_and_mm_by_their_headings(kind: str, comma: str, seed: int) -> None:
    """As a German spreadsheet has them, and an English one; the joints' zeros are the thetas."""
    rng = np.random.default_rng([seed, len(kind)])
    count = int(rng.integers(3, 8))
    rows = np.column_stack(
        [
            rng.choice([-90, 0, 90, 37.5], count),
            np.round(rng.uniform(-400, 400, count), 1),
            rng.choice([-90, 0, 90, 12.25], count),
            np.round(rng.uniform(-400, 400, count), 2),
        ]
    )
    order = {"classical": (2, 3, 1, 0), "craig": (0, 1, 3, 2), "khalil": (0, 1, 2, 3)}[kind]
    lines = ["\t".join(HEADS[kind])]
    for j, row in enumerate(rows, start=1):
        cells = [f"{row[k]:g}".replace(".", comma).replace("-", "\u2212") for k in order]
        lines.append("\t".join([str(j), *cells]))
    table = parse_pasted_table("\r\n".join(lines) + "\r\n")
    assert table.convention == kind and table.has_headings and table.symbols == ()
    robot = parse_robot_text(build_pasted_robot(table, "pasted"), "pasted")
    assert len(robot.coordinates) == count
    si = rows * [math.radians(1), 1e-3, math.radians(1), 1e-3]
    q = rng.uniform(-2, 2, count)
    result = frame_of(build_pasted_robot(table, "pasted"), q)
    np.testing.assert_allclose(result, hand(kind, si, q), atol=1e-12)


PUMA = (  # Craig, Introduction to Robotics, table of the PUMA 560
    "i\t\u03b1i-1\tai-1\tdi\t\u03b8i\n1\t0\t0\t0\t\u03b81\n2\t\u221290\u00b0\t0\t0\t\u03b82\n"
    "3\t0\ta2\td3\t\u03b83\n4\t\u221290\u00b0\ta3\td4\t\u03b84\n5\t90\u00b0\t0\t0\t\u03b85\n"
    "6\t\u221290\u00b0\t0\t0\t\u03b86"
)


def test_letters_of_a_book_become_symbols() -> None:
    table = parse_pasted_table(PUMA)
    assert table.convention == "craig" and table.symbols == ("a2", "d3", "a3", "d4")
    text = build_pasted_robot(table, "puma")
    assert set(read_symbol_texts(text)) == {"g", "a2", "d3", "a3", "d4"}
    actual = frame_of(text, np.zeros(6))
    a = 0.1  # all of them, until somebody writes the value
    alpha = [0, -90, 0, -90, 90, -90]
    lengths = [(0, 0), (0, 0), (a, a), (a, a), (0, 0), (0, 0)]
    rows = np.array([[math.radians(x), y, 0, z] for x, (y, z) in zip(alpha, lengths, strict=True)])
    np.testing.assert_allclose(actual, hand("craig", rows, np.zeros(6)), atol=1e-12)


@with_cases(
    "text",
    "j\ta(j)\t\u03c3j\t\u03b1j\tdj\t\u03b8j\trj\n1\t0\t0\t0\t0\t\u03b81\t0,2\n2\t1\t1\t\u03c0/2\t0\t0\tr2",
    "j;a;sigma;alpha;d;theta;r\n1;0;0;0;0;q1;0.2\n2;1;P;90 deg;0;0;q2",
    "| j | sigma | alpha | d | theta | r |\n|---|---|---|---|---|---|\n"
    "| 1 | R | 0 | 0 | q1* | 0.2 |\n"
    "| 2 | P | 90 | 0 | 0 | q2* |",
    "$j$ & $\\sigma_j$ & $\\alpha_j$ & $d_j$ & $\\theta_j$ & $r_j$ \\\\\n"
    "1 & 0 & 0 & 0 & $\\theta_1$ & 0.2 \\\\\n2 & 1 & $\\pi/2$ & 0 & 0 & $r_2$ \\\\",
)
def test_one_table_in_many_dresses(text: str) -> None:
    """Of a spreadsheet, with semicolons, of a page in Markdown, of a paper's LaTeX."""
    table = parse_pasted_table(text)
    assert table.convention == "khalil" and table.symbols == ()
    q = np.array([0.3, 0.15])
    expected = row_pose(gamma=0.3, b=0.2, alpha=math.pi / 2, r=0.15)
    np.testing.assert_allclose(frame_of(build_pasted_robot(table, "x"), q), expected, atol=1e-12)


def test_without_headings_the_convention_is_the_users() -> None:
    text = "90\t0.2\t0\t0\n0\t0\t0.3\t0.1"
    khalil, craig = parse_pasted_table(text), parse_pasted_table(text, "craig")
    by_gamma = parse_pasted_table("parent\tgamma\talpha\td\ttheta\n0\t0\t0\t0\tq1")
    assert by_gamma.columns[1] == "a"  # Khalil's
    assert khalil.columns == ("j", "alpha", "d", "theta", "r") and not khalil.has_headings
    assert craig.columns == ("j", "alpha", "a", "d", "theta")
    assert khalil.notes[0] == "no headings: taken as alpha d theta r"
    assert khalil.notes[1] == "column alpha: taken in degrees, for 90 rad is more than a turn"
    rows = np.array([[math.pi / 2, 0.2, 0, 0], [0, 0, 0.1, 0.3]])
    actual = frame_of(build_pasted_robot(craig, "x"), np.array([0.1, 0.2]))
    np.testing.assert_allclose(actual, hand("craig", rows, np.array([0.1, 0.2])), atol=1e-12)


def test_a_file_gets_another_table_and_keeps_the_rest() -> None:
    before = build_pasted_robot(parse_pasted_table("1\t0\t0\tq1\t0\n2\t0\tL\tq2\t0"), "mine")
    before = before.replace("L = 0.1", "L = 0.7").replace('viscous = "all"', 'viscous = ["1"]')
    after = insert_pasted_table(before, parse_pasted_table(PUMA))
    robot = parse_robot_text(after, "mine")
    assert robot.convention == "craig" and robot.name == "mine" and len(robot.coordinates) == 6
    values = robot.evaluate_symbols()
    assert values["L"] == 0.7 and {"a2", "d3", "a3", "d4"} <= values.keys()
    assert robot.has_effect("viscous", "1") and not robot.has_effect("viscous", "2")


@with_cases(
    "text, line",
    ("", "pasted table: got no cells"),
    ("hello", "pasted table: got no cells"),
    ("alpha\td\ttheta\tr", "pasted table: got headings alone"),
    ("alpha\td\ttheta\tr\tcolour\n0\t0\tq1\t0\tred", 'pasted table, headings: got "colour"'),
    (
        "alpha\td\td\ttheta\n0\t0\t0\tq1",
        "pasted table, headings: got alpha, d, d, theta; expected each once",
    ),
    ("\t".join("0" * 12), "pasted table: got 12 columns without headings"),
)
def test_what_cannot_be_a_table_is_told(text: str, line: str) -> None:
    with pytest.raises(RobotError) as result:
        parse_pasted_table(text)
    assert str(result.value).startswith(line) and "; expected " in str(result.value)


def test_nothing_in_a_table_is_evaluated(tmp_path, monkeypatch) -> None:
    """Words of Python are names without a value, for the reader to refuse."""
    monkeypatch.chdir(tmp_path)
    evil = '__import__("os").system("touch evil")'
    table = parse_pasted_table(f"alpha\td\ttheta\tr\n0\t{evil}\tq1\t0\n=1+1\t0\tq2\t0")
    with pytest.raises(RobotError):
        parse_robot_text(build_pasted_robot(table, "x"), "x")
    assert not [*tmp_path.iterdir()]


def test_a_block_for_some_cells_keeps_what_it_says() -> None:
    assert parse_pasted_cells("1,5\t90\u00b0\r\n\u22122\tL1\r\n") == [
        ["1.5", "90 deg"],
        ["-2", "L1"],
    ]
