"""Robot files: the text, the head, the table."""

from tests.bad_input.robot_texts import SERIAL, derived, edited, refusals, writes
from tests.bad_input.row import row

_NESTED = "[" * 2000 + "]" * 2000

TEXT = refusals(
    "toml", SERIAL,
    [
        ("unclosed quote", 'title = "Arm', 'title = "Arm\nx', "line 2", "toml"),
        ("decimal comma", "g = 9.81", "g = 9,81", "line 8", "toml"),
        ("equals missing", "g = 9.81", "g 9.81", "line 8", "toml"),
        ("table twice", "[parameters]", "[symbols]", "line", "toml"),
        ("date for a number", "g = 9.81", "g = 2024-01-01", "symbols"),
        ("time for a number", "g = 9.81", "g = 07:32:00", "symbols", "time"),
        ("nested 2000 deep", 'notes = "none"', f"notes = {_NESTED}", "nested"),
        ("integer of 5000 digits", "g = 9.81", f"g = {'9' * 5000}", "digits", "at most|shorter"),
    ],
)  # fmt: skip

FILES = [
    row("head: a name of 300 letters for a file of C", "refused", "generate arm.toml --out c",
        "long|at most", make=writes("arm.toml", edited(SERIAL, '"arm"', f'"{"a" * 300}"'))),
    row("head: a title that ends a comment of C", "works", "generate arm.toml --out c",
        make=writes("arm.toml", edited(SERIAL, "Arm with", "*/ #error /* ??/"))),
    row("toml: empty file", "refused", "derive bad.toml", "bad.toml", "missing",
        make=writes("bad.toml", "")),
    row("toml: only spaces", "refused", "derive bad.toml", "bad.toml", "missing",
        make=writes("bad.toml", " \n\n \t\n")),
    row("toml: UTF-16", "refused", "derive bad.toml", "bad.toml", "UTF-8",
        make=writes("bad.toml", SERIAL.encode("utf-16"))),
    row("toml: Latin-1 letters", "refused", "derive bad.toml", "bad.toml", "UTF-8",
        make=writes("bad.toml", SERIAL.replace("Arm", "Ärm").encode("latin-1"))),
    row("toml: random bytes", "refused", "derive bad.toml", "bad.toml",
        make=writes("bad.toml", bytes(range(256)))),
    row("toml: a Parquet log", "refused", "derive c.parquet", "c.parquet", "UTF-8|toml"),
    row("toml: a CSV log", "refused", "derive a.csv", "a.csv", "toml|table"),
    row("toml: a model file", "refused", "derive m.json", "m.json", "toml"),
    row("toml: a page", "refused", "derive page.html", "page.html", "toml|table"),
    row("toml: a SYMORO file", "refused", "derive arm.par", "arm.par", ".par",
        make=writes("arm.par", "(* Robotname = 'arm' *)\nNL = 3\n")),
    row("toml: a URDF without links", "refused", "derive arm.urdf", "arm.urdf", "no link",
        make=writes("arm.urdf", "<robot name='arm'/>")),
    row("toml: no such file", "refused", "derive nowhere.toml", "nowhere.toml"),
    row("toml: built-in misspelt", "refused", "derive wirst", "wirst", "did you mean", "wrist"),
    row("toml: built-in in capitals", "refused", "derive WRIST", "WRIST", "wrist"),
    row("toml: empty name", "refused", ("derive", ""), "robot", "empty|got \"\""),
    row("toml: a folder", "refused", "derive .", ". is|.: is", "folder|file"),
    row("toml: no read (a loop of links)", "refused", "derive loop.toml", "loop.toml",
        make=lambda y: y.path("loop.toml").symlink_to("loop.toml")),
    row("toml: a link to nowhere", "refused", "derive gone.toml", "gone.toml",
        make=lambda y: y.path("gone.toml").symlink_to("nowhere.toml")),
    row("toml: byte order mark", "works", "derive bom.toml --no-terms", "arm",
        make=writes("bom.toml", "\ufeff" + SERIAL)),
    row("toml: line ends of Windows", "works", "derive crlf.toml --no-terms", "arm",
        make=writes("crlf.toml", SERIAL.replace("\n", "\r\n"))),
    row("toml: no end of the last line", "works", "derive odd.toml --no-terms", "arm",
        make=writes("odd.toml", SERIAL.rstrip("\n"))),
    row("toml: a link to the file", "works", "derive link.toml --no-terms", "arm",
        make=lambda y: y.path("link.toml").symlink_to(y.write("real.toml", SERIAL))),
    row("toml: name of the file with spaces", "works",
        ("derive", "my robot (1).toml", "--no-terms"), "arm",
        make=writes("my robot (1).toml", SERIAL)),
    row("toml: name of the file in Greek", "works", "derive ρομπότ.toml --no-terms", "arm",
        make=writes("ρομπότ.toml", SERIAL)),
    row("toml: mistake in a file whose name has a line end", "refused",
        ("derive", "two\nlines.toml"), "two lines.toml", "name",
        make=writes("two\nlines.toml", "")),
]  # fmt: skip

HEAD = refusals(
    "head", SERIAL,
    [
        ("no name", 'name = "arm"\n', "", "name", "missing"),
        ("title a list", '"Arm with most of what a file may say"', "[1]", "title", "got [1]"),
        ("title of two lines", '"Arm with most of what a file may say"', '"a\\nb"', "title"),
        ("notes a number", 'notes = "none"', "notes = 1", "notes"),
        ("gravity of 4 entries", '[0, 0, "-g"]', "[0, 0, 0, 0]", "gravity", "4 entries"),
        ("gravity a text", '[0, 0, "-g"]', '"down"', "gravity", "down"),
        ("gravity nan", '[0, 0, "-g"]', "[0, 0, nan]", "gravity", "entry 3"),
        ("gravity inf", '[0, 0, "-g"]', "[0, 0, -inf]", "gravity", "entry 3"),
        ("gravity undeclared", '[0, 0, "-g"]', '[0, 0, "-G"]', "gravity", "G is not", '"g"'),
        ("gravity 1e300", '[0, 0, "-g"]', "[0, 0, -1e300]", "gravity", "large|1e300|1e+300"),
        ("key below a table", "[symbols]\n", "[symbols]\nlegs = [1]\n", "legs", "symbols"),
    ],
) + derived(
    "head", SERIAL,
    [
        ("title in Japanese", "Arm with most", "腕", "腕"),
        ("no gravity at all", '[0, 0, "-g"]', "[0, 0, 0]"),
        ("name with a dash and digits", '"arm"', '"6-arm_2"', "6-arm_2"),
        ("name in capitals", '"arm"', '"ARM"', "ARM"),
    ],
)  # fmt: skip

TABLE = refusals(
    "table", SERIAL,
    [
        ("mdh missing", "[mdh]", "[terms.x]", "mdh", "missing"),
        ("rows a number", 'rows = [\n  ["1"', 'rows = 3\nx = [\n  ["1"', "[mdh]"),
        ("row empty", '["1", "0", 1, 0, 0, 0, "q1", 0]', "[]", "row 1"),
        ("row a text", '["1", "0", 1, 0, 0, 0, "q1", 0]', '"1 0 1"', "row 1", "list"),
        ("antecedents in a circle", '["2", "1"', '["2", "3"', "circle"),
        ("sigma a list", '"1", "0", 1, 0', '"1", "0", 1, [0]', 'row "1"', "sigma"),
        ("mu yes", '"1", "0", 1, 0', '"1", "0", "yes", 0', 'row "1"', "mu"),
        ("length undeclared", '0, "D3"', '0, "D33"', 'row "3"', "D33", '"D3"'),
        ("length nan", '0, "D3"', "0, nan", 'row "3"', "nan", "finite"),
        ("length 1e200", '0, "D3"', "0, 1e200", 'row "3"', "1e200|1e+200", "large|at most|m"),
        ("length with decimal comma", '0, "D3"', '0, "0,45"', 'row "3"', "0,45"),
        ("length complex", '0, "D3"', '0, "1j"', 'row "3"', "1j"),
        ("tower of powers", '0, "D3"', '0, "9**9**9**9"', 'row "3"', "9**9"),
        ("power 1e9", '0, "D3"', '0, "2**1000000000"', 'row "3"', "finite|at most"),
        ("sin nested 200 times", '0, "D3"', f'0, "{"sin(" * 200}1{")" * 200}"', 'row "3"'),
        ("parentheses nested 5000", '0, "D3"', f'0, "{"(" * 5000}1{")" * 5000}"', 'row "3"'),
        ("minus signs 5000", '0, "D3"', f'0, "{"-" * 5000}1"', 'row "3"'),
        ("function unknown", '0, "D3"', '0, "cot(D3)"', 'row "3"', "cot"),
        ("function with two arguments", '0, "D3"', '0, "sin(D3, 1)"', 'row "3"', "sin"),
        ("function as a number", '0, "D3"', '0, "sin"', 'row "3"', "sin"),
        ("variable of another row", '"q1", 0]', '"q2", 0]', 'row "1"'),
        ("variable in words", '"q1", 0]', '"theta1", 0]', 'row "1"', "theta1"),
    ],
) + derived(
    "table", SERIAL,
    [
        ("row names as numbers", '["1", "0"', '[1, 0'),
        ("angle to the last digit", '"pi/2", 0, "pi', '1.5707963267948966, 0, "pi'),
        ("spaces in an expression", '"pi/2", 0, "pi', '" pi / 2 ", 0, "pi'),
        ("length as text", "0.1", '"0.1"'),
        ("length with exponent", "0.1", '"1e-1"'),
        ("length in hexadecimal", "0.1", '"0x1"'),
        ("variable turned round", '"q1", 0]', '"-q1", 0]'),
        ("function of a symbol", '0, "D3"', '0, "sqrt(D3**2)*cos(0)"'),
    ],
)  # fmt: skip

ROWS = [*TEXT, *FILES, *HEAD, *TABLE]
