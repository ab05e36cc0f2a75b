"""Every mistake in a robot file is told: where, got, expected, what to do."""

import random
import re

import pytest

from modeler.core.builtin import builtin_names, builtin_text
from modeler.core.errors import RobotError
from modeler.robot.read import read_robot, robot_from_text

GOOD = """\
name = "arm"
title = "Arm for tests"
gravity = [0, 0, "-g"]
priority = ["ZZ*", "Ia?"]
notes = "none"

[symbols]
g = 9.81
D3 = 0.45
R4 = "D3 / 2"

[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1", 0],
  ["2", "1", 1, 0, "pi/2", 0, "pi/2 - q2", 0],
  ["3", "2", 1, 1, 0, "D3", 0, "q3 + R4"],
  ["4", "3", 0, 0, "-pi/2", 0, "-q4", "R4"],
  ["E", "4", 0, 2, 0, 0.1, "pi", 0],
]

[effects]
viscous = "all"
rotor_inertia = ["1", "2"]
coupled_friction = "all"

[coupling]
2 = "q1 + 2*q2"

[parameters]
ZZ1 = 0.5
Fv1 = 2

[drive_gains]
1 = 12.5

[limits]
1 = ["-pi", 2.5, 3, 10]

[physical.1]
mass = "m1"
centre = ["x1", 0, "z1 - D3"]
inertia = ["J1", 0, 0, "J2", 0, "J3"]

[terms]
PG1 = "m1*x1"
"""

_V, _U = "Fv1 = 2\n", "[parameters.uncertainty]"

# (what is wrong, old text, new text, pieces of the message in this order)
MISTAKES = [
    # the TOML text
    ("unclosed text", 'title = "Arm for tests"', 'title = "Arm', ["line 2, column 13", "not TOML"]),
    ("no comma", "[0, 0, ", "[0 0, ", ["line 3", "not TOML", "commas"]),
    ("file ends early", 'PG1 = "m1*x1"', 'PG1 = """', ["line", "not TOML"]),
    ("key twice", 'notes = "none"', 'name = "b"', ["line 5", "not TOML", "overwrite"]),
    # top level
    ("no name", 'name = "arm"\n', "", ["name: is missing", 'name = "arm"']),
    ("name no text", 'name = "arm"', "name = 3", ["name: got 3", "letters, digits"]),
    ("name with space", 'name = "arm"', 'name = "my arm"', ['name: got "my arm"', "expected"]),
    ("empty title", '"Arm for tests"', '""', ['title: got ""', "expected text"]),
    ("no gravity", 'gravity = [0, 0, "-g"]\n', "", ["gravity: is missing", "[0, 0, 0]"]),
    ("no table", "[mdh]", "[terms.x]", ["mdh: is missing", "add the table [mdh]"]),
    ("unknown key", "notes =", "note =", ['unknown key "note"', 'did you mean "notes"?']),
    ("unknown table", "[limits]", "[limit]", ['unknown key "limit"', '"limits"', "expected name"]),
    # columns and rows
    ("mdh no table", "[mdh]", "[terms.x]\n[[mdh]]", ["[mdh]: got [{", "expected a table"]),
    ("mdh key", "rows = [\n", "row = [\n", ["[mdh]", 'unknown key "row"', 'did you mean "rows"?']),
    ("no columns", "columns = [", "#", ["[mdh]: columns is missing", "columns = ["]),
    ("bad column", '"alpha", "d"', '"alfa", "d"', ["columns", '"alfa"', 'did you mean "alpha"?']),
    ("column twice", '"sigma", "alpha"', '"sigma", "d"', ['columns: "d" stands twice', "remove"]),
    ("no j", 'columns = ["j",', 'columns = ["b",', ['column "j"', "is missing", "add it"]),
    ("column no text", '"mu", "sigma"', '3, "sigma"', ["columns: entry 3 is 3", "expected names"]),
    ("short row", 'pi/2 - q2", 0]', 'pi/2 - q2"]', ['row 2 ("2")', "got 7 cells", "8", "add 1"]),
    ("long row", '"q1", 0]', '"q1", 0, 0]', ['row 1 ("1")', "got 9 cells, expected 8", "remove 1"]),
    ("row no list", '["1", "0", 1, 0, 0, 0, "q1", 0]', "7", ["row 1", "got 7", "expected a list"]),
    # names and antecedents
    ("row twice", '["2", "1"', '["1", "1"', ['row "1"', "rows 1 and 2", "its own name"]),
    ("row 0", '["1", "0"', '["0", "0"', ["row 1, column j", 'got "0"', "is the base"]),
    ("row name", '["1", "0"', '["1-a", "0"',
     ["row 1, column j", 'got "1-a"', "letters and digits"]),
    ("row name type", '["1", "0"', '[1.5, "0"', ["row 1, column j: got 1.5", "expected a name"]),
    ("row name true", '["1", "0"', '[true, "0"', ["column j: got true", "expected a name"]),
    ("q of another", '["E", "4"', '["d1", "4"', ['row "d1"', "qd1 mean two things", 'row "1"']),
    ("no antecedent", '["3", "2"', '["3", "7"', ['row "3", column a', 'got "7"', "(1, 2)"]),
    ("antecedent type", '["3", "2"', '["3", 0.5', ['row "3", column a: got 0.5', "expected"]),
    ("itself", '["3", "2"', '["3", "3"', ['row "3", column a', "circle 3 -> 3", "end at"]),
    ("circle", '["2", "1"', '["2", "4"', ['row "2"', "circle 2 -> 4 -> 3 -> 2", 'end at "0"']),
    # sigma, mu
    ("sigma 3", '"1", "0", 1, 0', '"1", "0", 1, 3', ['row "1", column sigma', "got 3", "0 (rev"]),
    ("sigma text", '"1", "0", 1, 0', '"1", "0", 1, "R"', ["column sigma", 'got "R"', "2 (fixed)"]),
    ("mu 2", '"1", "0", 1, 0', '"1", "0", 2, 0', ['row "1", column mu', "got 2", "0 (passive)"]),
    ("fixed motor", '"E", "4", 0', '"E", "4", 1', ['row "E", column mu', "got 1", "write 0"]),
    # cells
    ("undeclared", '0, "D3"', '0, "D33"', ['row "3", column d', 'got "D33"', 'mean "D3"?']),
    ("letter case", '0, "D3"', '0, "d3"', ['row "3", column d', "d3 is not", 'mean "D3"?']),
    ("far symbol", '0, "D3"', '0, "zeta"', ["zeta is not declared", "declare it in [symbols]"]),
    ("not arithmetic", '0, "D3"', '0, "D3^2"', ["column d", 'got "D3^2"', "powers as x**2"]),
    ("not an expression", '0, "D3"', '0, "D3 +"', ["column d", 'got "D3 +"', "cannot be read"]),
    ("no number", '0, "D3"', "0, [1]", ["column d", "got [1]", "expected a number"]),
    ("truth", '0, "D3"', "0, true", ["column d", "got True", "expected a number"]),
    ("infinite", '0, "D3"', "0, inf", ["column d", "got inf", "finite"]),
    ("huge", '0, "D3"', '0, "1e400"', ["column d", "1e400", "too large"]),
    ("division by 0", '0, "D3"', '0, "1/(D3-D3)"',
     ["column d", "no finite real value", "divisors"]),
    ("root of -1", '0, "D3"', '0, "sqrt(-D3)"', ["column d", "no finite real value", "roots"]),
    ("no real power", '0, "D3"', '0, "(-D3)**0.5"', ["column d", "no finite real value"]),
    ("deep", '0, "D3"', f'0, "{"1+" * 5000}1"', ["column d", "expected"]),
    # joint variables
    ("no q in theta", '0, 0, "q1", 0]', "0, 0, 0, 0]", ['row "1", column theta', 'got "0"', "q1"]),
    ("no q in r", '"q3 + R4"', '"R4"', ['row "3", column r', 'got "R4"', "expected q3"]),
    ("q in d", '0, 0, "q1", 0]', '0, "q1", "q1", 0]',
     ['row "1", column d', "column theta", "move"]),
    ("q in theta", '0, "q3 + R4"', '"q3", 0', ['row "3", column theta', "prismatic", "column r"]),
    ("q of another row", '"q1", 0]', '"q1 + q2", 0]', ['row "1"', "another row", "follows"]),
    ("q of fixed", '0.1, "pi", 0', '0.1, "qE", 0',
     ['row "E", column theta', "sigma 2", "remove qE"]),
    ("sin q", '0, "q1", 0]', '0, "sin(q1)", 0]',
     ["column theta", "sin(q1)", "not linear", "q1 + pi/2"]),
    ("q squared", '0, "q1", 0]', '0, "q1**2", 0]', ["column theta", "q1**2", "not linear"]),
    ("q times q", '0, "q1", 0]', '0, "q1*q1", 0]', ["column theta", "q1*q1", "not linear"]),
    ("1 over q", '0, "q1", 0]', '0, "1/q1", 0]', ["column theta", "1/q1", "not linear"]),
    ("2 q", '0, "q1", 0]', '0, "2*q1", 0]', ["column theta", "coefficient 2", "expected 1 or -1"]),
    ("0 q", '0, "q1", 0]', '0, "q1 - q1", 0]', ["column theta", "coefficient 0", "1 or -1"]),
    # angles
    ("degrees", '"pi/2", 0, "pi', '90, 0, "pi', ["alpha", "90 rad is more than a turn", "radians"]),
    # symbols
    ("symbol q1", "D3 = 0.45", "D3 = 0.45\nq1 = 1", ["[symbols]", '"q1"', "joint variable"]),
    ("symbol qd1", "D3 = 0.45", "D3 = 0.45\nqd1 = 1", ["[symbols]", '"qd1"', "joint variable"]),
    ("symbol pi", "D3 = 0.45", "D3 = 0.45\npi = 3", ["[symbols]", '"pi"', "number pi"]),
    ("symbol sin", "D3 = 0.45", "D3 = 0.45\nsin = 3", ["[symbols]", '"sin"', "a function"]),
    ("symbol MX1", "D3 = 0.45", "D3 = 0.45\nMX1 = 3", ["[symbols]", '"MX1"', "standard parameter"]),
    ("symbol Fv1", "D3 = 0.45", "D3 = 0.45\nFv1 = 3", ["[symbols]", '"Fv1"', "choose another"]),
    ("symbol double", "D3 = 0.45", "D3 = 0.45\ndouble = 3", ['"double"', "C language"]),
    ("symbol lambda", "D3 = 0.45", "D3 = 0.45\nlambda = 3", ['"lambda"', "choose another"]),
    ("symbol name", "D3 = 0.45", 'D3 = 0.45\n"a b" = 3',
     ["[symbols]", '"a b"', "expected a letter"]),
    ("symbol value", "D3 = 0.45", "D3 = [1]", ["[symbols], D3", "got [1]", "expected a number"]),
    ("symbol unknown", '"D3 / 2"', '"D4 / 2"',
     ["[symbols], R4", "D4 is not declared", "among g, D3, R4"]),
    ("symbol joint", '"D3 / 2"', '"q1 / 2"', ["[symbols], R4", "q1 is not declared", "among"]),
    ("symbols circle", "D3 = 0.45", 'D3 = "R4"', ["[symbols]", "D3, R4", "circle", "a number"]),
    ("symbol 1/0", "D3 = 0.45", 'D3 = "1/0"', ["[symbols], D3", "no finite real value"]),
    # gravity
    ("2 entries", '[0, 0, "-g"]', '[0, "-g"]', ["gravity: got 2 entries, expected 3", "add 1"]),
    ("a number", '[0, 0, "-g"]', "9.81", ["gravity: got 9.81", "expected a list"]),
    ("moving", '[0, 0, "-g"]', '[0, 0, "q1"]', ["gravity, entry 3", "joint variable q1"]),
    ("undeclared G", '[0, 0, "-g"]', '[0, 0, "-G"]', ["gravity, entry 3", "G is not", '"g"?']),
    # effects and coupling
    ("effect", "viscous =", "viscus =", ["[effects]", '"viscus"', 'did you mean "viscous"']),
    ("effects list", "[effects]", "[[effects]]", ["[effects]: got [{", "expected a table"]),
    ("alias twice", 'viscous = "all"', 'viscous = "all"\nback_emf = "all"',
     ["is viscous", "keep one"]),
    ("effect joint", '["1", "2"]', '["1", "5"]', ["rotor_inertia", 'joint "5"', "1, 2, 3, 4"]),
    ("effect on frame", '["1", "2"]', '["1", "E"]',
     ["rotor_inertia", 'moving joint "E"', "one of"]),
    ("joint twice", '["1", "2"]', '["1", "1"]', ["rotor_inertia", '"1" stands there twice']),
    ("joints word", '["1", "2"]', '"1"', ["rotor_inertia", 'got "1"', '"all" or ["1", "2"]']),
    ("no coupling", '[coupling]\n2 = "q1 + 2*q2"', "",
     ["coupled_friction", "add a table [coupling]"]),
    ("uncoupled motor", 'coupled_friction = "all"', 'coupled_friction = ["3"]',
     ["coupled_friction", 'joint "3" has no line in [coupling]', "has 2"]),
    ("coupling joint", '2 = "q1 +', '5 = "q1 +', ['[coupling], "5"', "no moving joint", "1, 2, 3"]),
    ("coupling product", '"q1 + 2*q2"', '"q1*q2"', ['[coupling], "2"', "not linear", "q5 + q6"]),
    ("coupling constant", '"q1 + 2*q2"', '"q2 + 1"', ['[coupling], "2"', "constant 1", "only"]),
    ("coupling own", '"q1 + 2*q2"', '"q1"', ['[coupling], "2"', "without q2", "own joint"]),
    ("coupling name", '"q1 + 2*q2"', '"q2 + q9"', ['[coupling], "2"', "q9 is not declared"]),
    # parameters, drives, limits
    ("priority", '"ZZ*"', '"zz1"', ["priority", '"zz1" matches no parameter', 'mean "ZZ1"']),
    ("priority number", '"ZZ*"', "3", ["priority: got 3", "expected text"]),
    ("priority text", '["ZZ*", "Ia?"]', '"ZZ*"', ["priority", 'got "ZZ*"', "expected a list"]),
    ("parameter", "ZZ1 = 0.5", "ZZ9 = 0.5", ["[parameters]", 'no parameter "ZZ9"', "did you mean"]),
    ("no such friction", "ZZ1 = 0.5", "Fs1 = 1", ["[parameters]", '"Fs1"', "where [effects] has"]),
    ("parameter text", "ZZ1 = 0.5", 'ZZ1 = "big"', ["[parameters], ZZ1", 'got "big"', "a number"]),
    ("parameter inf", "ZZ1 = 0.5", "ZZ1 = nan", ["[parameters], ZZ1", "got nan", "finite"]),
    ("uncertain text", _V, f"{_V}uncertainty.Fv1 = 'a'\n", [f"{_U}, Fv1", 'got "a"', "a number"]),
    ("sigma 0", _V, f"{_V}uncertainty.Fv1 = 0\n", [f"{_U}, Fv1", "got 0", "above 0", "held"]),
    ("sigma name", _V, f"{_V}uncertainty.Fv9 = 1\n", [_U, 'no parameter "Fv9"', "did you mean"]),
    ("uncertain word", _V, f"{_V}uncertainty.inertal = 1\n", [_U, 'did you mean "inertial"']),
    ("uncertain open", _V, f"{_V}uncertainty.ZZ2 = 1\n", [_U, "ZZ2 has no value", "write"]),
    ("percent", "ZZ1 = 0.5", "M2 = 3\nuncertainty.inertial = 10", [_U, "got 10", "0.10 for 10 %"]),
    ("no body", _V, f"{_V}uncertainty.inertial = 0.1\n", [_U, "no body", "state masses"]),
    ("held text", _V, f"{_V}held = 'Fv1'\n", ["[parameters], held", 'got "Fv1"', "a list"]),
    ("held number", _V, f"{_V}held = [3]\n", ["[parameters], held", "got 3", "text such as"]),
    ("held name", _V, f"{_V}held = ['ZZ8']\n", ["[parameters], held", '"ZZ8"', "did you mean"]),
    ("held without value", _V, f"{_V}held = ['ZZ2']\n", ["held: ZZ2 has no value; write ZZ2 = "]),
    ("held and uncertain", _V, f"{_V}held = ['Fv1']\nuncertainty.Fv1 = 1\n", ["one of both"]),
    ("gain joint", "1 = 12.5", "8 = 12.5", ['[drive_gains], "8"', "no moving joint", "one of 1"]),
    ("gain 0", "1 = 12.5", "1 = 0", ['[drive_gains], "1"', "got 0", "not zero"]),
    ("gain text", "1 = 12.5", '1 = "12"', ['[drive_gains], "1"', 'got "12"', "expected a number"]),
    ("limits joint", '1 = ["-pi",', '9 = ["-pi",', ['[limits], "9"', "no moving joint"]),
    ("limits short", ", 3, 10]", ", 3]", ['[limits], "1"', "got 3 entries, expected 4", "add 1"]),
    ("limits range", '["-pi", 2.5', '["pi", 2.5', ['[limits], "1"', "lower 3.14", "lower < upper"]),
    ("limits speed", "2.5, 3, 10", "2.5, 0, 10", ['[limits], "1"', "speed 0", "both positive"]),
    # letters of a paper
    ("physical joint", "[physical.1]", "[physical.7]", ['[physical], "7"', "no moving joint"]),
    ("physical key", 'mass = "m1"', 'mas = "m1"', ["[physical]", 'key "mas"', 'mean "mass"?']),
    ("physical missing", 'mass = "m1"\n', "", ['[physical], "1"', "mass is missing", "inertia"]),
    ("centre", '["x1", 0, "z1 - D3"]', '["x1"]', ["centre", "got 1 entries, expected 3"]),
    ("inertia", '"J2", 0, "J3"]', '"J2"]', ["inertia", "got 4 entries, expected 6", "YZ"]),
    ("physical q", 'mass = "m1"', 'mass = "q1"', ["[physical]", "joint variable q1", "rigid"]),
    ("physical text", 'mass = "m1"', 'mass = "m1 *"', ["mass", 'got "m1 *"', "cannot be read"]),
    ("physical value", "[physical.1]", "[physical]\n1 = 3\n[terms.x]", ['"1": got 3', "a table"]),
]  # fmt: skip


def test_the_good_file_is_read():
    robot = robot_from_text(GOOD, "arm.toml")
    assert [joint.name for joint in robot.moving] == ["1", "2", "3", "4"]


@pytest.mark.parametrize(
    ("old", "new", "pieces"), [pytest.param(*mistake[1:], id=mistake[0]) for mistake in MISTAKES]
)
def test_a_mistake_is_told(old, new, pieces):
    assert GOOD.count(old) >= 1
    pattern = ".*".join(re.escape(piece) for piece in pieces)
    with pytest.raises(RobotError, match=pattern) as caught:
        robot_from_text(GOOD.replace(old, new, 1), "arm.toml")
    message = str(caught.value)
    assert message.startswith("arm.toml: ")
    assert "\n" not in message
    assert len(message) < 500


def test_a_row_before_its_antecedent_is_told_where_to_go():
    text = GOOD.replace('["1", "0", 1, 0, 0, 0, "q1", 0],', "", 1).replace(
        '["E", "4"', '["1", "0", 1, 0, 0, 0, "q1", 0],\n["E", "4"'
    )
    with pytest.raises(RobotError, match=r'row "2", column a: got "1".*move row "1" above row "2"'):
        robot_from_text(text, "arm.toml")


def test_a_table_without_motion_is_refused():
    text = 'name = "rock"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "sigma"]\nrows = [["1", 2]]'
    with pytest.raises(RobotError, match=r'\[mdh\], row "1": no row of the table moves'):
        robot_from_text(text, "rock.toml")


def test_an_empty_table_is_refused():
    text = 'name = "rock"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j"]\nrows = []'
    with pytest.raises(RobotError, match=r"\[mdh\], rows: the table is empty; write one row"):
        robot_from_text(text, "rock.toml")


def test_row_names_that_make_two_parameters_one_are_refused():
    text = GOOD.replace('"E"', '"X1"').replace('"X1", "4", 0, 2', '"X1", "4", 0, 0')
    text = text.replace('0.1, "pi"', '0.1, "qX1"')
    with pytest.raises(RobotError, match=r'row "X1".*MX1 mean two parameters, with row "1"'):
        robot_from_text(text, "arm.toml")


def test_unknown_names_suggest_built_in_robots():
    with pytest.raises(RobotError, match=r'"pumma560" is neither.*did you mean "puma560".*wrist'):
        read_robot("pumma560")
    with pytest.raises(RobotError, match=r"wirst\.toml: there is no such file.*\"wrist\""):
        read_robot("wirst.toml")


def test_unreadable_files_are_told(tmp_path):
    with pytest.raises(RobotError, match="is a folder; expected a robot file"):
        read_robot(tmp_path)
    latin = tmp_path / "latin.toml"
    latin.write_bytes('name = "Stäubli"'.encode("latin-1"))
    with pytest.raises(RobotError, match=r"latin\.toml: byte 10 is not UTF-8"):
        read_robot(latin)
    with pytest.raises(RobotError, match=r"cannot be read \(File name too long\); check the path"):
        read_robot("x" * 300 + ".toml")


SHARDS = [
    *("", '"', "[", "]", "{}", "0", "-", ".", "=", "\n", "(", "**", "é", "true", "pi", "q1", "q2"),
    *("1e999", "9" * 5000, "0x" + "f" * 5000),
]


@pytest.mark.parametrize("seed", range(80))
def test_damaged_files_raise_nothing_but_robot_errors(seed):
    rng = random.Random(seed)
    text = rng.choice([GOOD, *map(builtin_text, builtin_names())])
    for _ in range(rng.randint(1, 4)):
        at, other = rng.randrange(len(text)), rng.randrange(len(text))
        length = rng.choice([0, 1, 1, 3, 20])
        copied = text[other : other + length]
        piece = rng.choice([*SHARDS, copied])
        text = text[:at] + piece + text[at + length :]
    try:
        robot = robot_from_text(text, "damaged.toml")
    except RobotError as error:
        assert str(error).startswith("damaged.toml: ")
        assert "\n" not in str(error)
    else:
        assert robot.moving


def test_a_row_name_that_reads_like_a_grouped_parameter_is_refused():
    text = (
        'name = "rock"\ngravity = [0, 0, 0]\n[mdh]\ncolumns = ["j", "theta"]\n'
        'rows = [["1", "q1"], ["1R", "q1R"]]'
    )
    with pytest.raises(RobotError, match=r'row "1R": the name makes XX1R a parameter, which is'):
        robot_from_text(text, "rock.toml")
