"""Robot files: through the whole command, and what tests/robot/ has no message for.

The mistakes in tests/robot/test_robot_mistakes.py, _own_effects.py and _loops.py are not here
again: a row stands for what is refused elsewhere in the code, or may take long.
"""

import re
from collections.abc import Callable, Iterable
from functools import partial

from modeler.api import derive
from modeler.core.builtin import builtin_text
from modeler.robot.read import robot_from_text
from tests.bad_input.row import Make, Row, row
from tests.bad_input.workdir import Workdir
from tests.robot.texts import PLANAR
from tests.robot_texts import CRANK

SERIAL = """\
name = "arm"
title = "Arm with most of what a file may say"
notes = "none"
gravity = [0, 0, "-g"]
priority = ["ZZ*", "Ia?"]

[symbols]
g = 9.81
D3 = 0.45
R4 = "D3 / 2"
tilt = "pi/6"

[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1", 0],
  ["2", "1", 1, 0, "pi/2", 0, "pi/2 - q2", 0],
  ["3", "2", 1, 1, 0, "D3", 0, "q3 + R4"],
  ["E", "3", 0, 2, "tilt", 0.1, "pi", 0],
]

[effects]
viscous = "all"
coulomb = ["1", "2"]
rotor_inertia = ["1"]
coupled_friction = "all"
stribeck = [{joint = "1", vs = 0.1, d = 2}]
motor_ripple = [{joint = "2", m = 7}, {joint = "2", m = 14}]
eddy_brake = [{joint = "2", c = 0.7, w = 0.2}]

[own_effects.eddy_brake]
title = "drag of a magnet that the joint passes"
columns = { Keb = "v*exp(-((q - c)/w)**2)" }
shapes = { c = [-1, 0, 1], w = [0.1, 0.3] }
unit = "N*m*s/rad"
nonnegative = true

[coupling]
2 = "q1 + 2*q2"

[parameters]
ZZ1 = 0.5
Fv1 = 2

[drive_gains]
1 = 12.5

[limits]
1 = ["-pi", 2.5, 3, 10]
"""
DERIVE = "derive {} --no-terms"

Edit = tuple[str, ...]
"""What is wrong, the old text, the new one, and words of the line."""


def edited(text: str, *edits: str) -> str:
    """The text with the first of every `old, new` exchanged; each `old` must be there."""
    for old, new in zip(edits[::2], edits[1::2], strict=True):
        assert old in text, f"the good file has no {old!r}"
        text = text.replace(old, new, 1)
    return text


def writes(name: str, content: str | bytes) -> Make:
    """Makes a file of that content."""
    return lambda workdir: workdir.write(name, content)


def refusals(theme: str, text: str, edits: Iterable[Edit]) -> list[Row]:
    """A row for every edit of a good robot file that must be refused.

    The first goes through a command, the others are only read.
    """
    rows = []
    for what, old, new, *words in edits:
        content = edited(text, old, new)
        name = _file(content)
        run: str | Callable[[Workdir], object] = f"{DERIVE.format(name)} --json d.json"
        if rows:
            run = partial(_read, name, content)
        rows.append(row(f"{theme}: {what}", "refused", run, *words, make=writes(name, content)))
    return rows


def lists(*tables: str) -> list[Edit]:
    """Lists of tables where one table must stand."""
    return [(f"{table} a list", f"[{table}]", f"[[{table}]]", f"[{table}]") for table in tables]


def _read(name: str, content: str, workdir: Workdir) -> object:
    return derive(robot_from_text(content, name))


def _file(content: str) -> str:
    """A name for a robot file: that of the good file, by which messages call the robot too."""
    found = re.search(r'^name = "(\w+)"$', content, re.MULTILINE)
    return f"{found[1][:20] if found else 'bad'}.toml"


def derived(what: str, text: str, edits: Iterable[str], *words: str) -> Row:
    """A row of a robot file that must work with all these edits; its words are in the output."""
    make = writes("odd.toml", edited(text, *edits))
    return row(what, "works", DERIVE.format("odd.toml"), *words, make=make)


_NESTED = "[" * 2000 + "]" * 2000
_DEEP = "sin(" * 200 + "q" + ")" * 200

FILES = [
    row("toml: UTF-16", "refused", "derive bad.toml", "bad.toml", "UTF-8",
        make=writes("bad.toml", SERIAL.encode("utf-16"))),
    row("toml: a model file", "refused", "derive m.json", "m.json", "toml"),
    row("toml: a SYMORO file", "refused", "derive arm.par", "arm.par", ".par",
        make=writes("arm.par", "(* Robotname = 'arm' *)\nNL = 3\n")),
    row("toml: no such file", "refused", "derive nowhere.toml", "nowhere.toml"),
    row("toml: built-in in capitals", "refused", "derive WRIST", "WRIST", "did you mean", "wrist"),
    row("toml: empty name", "refused", ("derive", ""), "robot", "empty|got \"\""),
    row("toml: a folder", "refused", "derive .", ". is|.: is", "folder|file"),
    row("toml: a loop of links", "refused", "derive loop.toml", "loop.toml",
        make=lambda w: w.path("loop.toml").symlink_to("loop.toml")),
    row("toml: mistake in a file whose name has a line end", "refused",
        ("derive", "two\nlines.toml"), "two lines.toml", "name",
        make=writes("two\nlines.toml", "")),
    row("toml: byte order mark and line ends of Windows", "works", "derive odd.toml --no-terms",
        "arm", make=writes("odd.toml", "\ufeff" + SERIAL.replace("\n", "\r\n"))),
    row("toml: a link to a file in Greek", "works", "derive link.toml --no-terms", "arm",
        make=lambda w: w.path("link.toml").symlink_to(w.write("ρομπότ (1).toml", SERIAL))),
    row("head: a name of 300 letters for a file of C", "refused", "generate arm.toml --out c",
        "long|at most", make=writes("arm.toml", edited(SERIAL, '"arm"', f'"{"a" * 300}"'))),
    row("head: a title that ends a comment of C", "works", "generate arm.toml --out c",
        make=writes("arm.toml", edited(SERIAL, "Arm with", "*/ #error /* ??/"))),
    row("own effects: equation nested 200 deep", "ends", "derive arm.toml --no-terms", "arm",
        make=writes("arm.toml", edited(SERIAL, "v*exp", f"{_DEEP}*exp"))),
]  # fmt: skip

TABLES = [
    *refusals(
        "text", SERIAL,
        [
            ("unclosed quote", 'title = "Arm', 'title = "Arm\nx', "line 2", "toml"),
            ("time for a number", "g = 9.81", "g = 07:32:00", "symbols", "time"),
            ("nested 2000 deep", 'notes = "none"', f"notes = {_NESTED}", "nested"),
            ("integer of 5000 digits", "g = 9.81", f"g = {'9' * 5000}", "digits", "at most|short"),
            ("title of two lines", '"Arm with most of what a file may say"', '"a\\nb"', "title"),
            ("gravity 1e300", '[0, 0, "-g"]', "[0, 0, -1e300]", "gravity", "large|1e300|1e+300"),
            ("symbols a list", "[symbols]", "[terms.x]\n[[symbols]]", "[symbols]", "table"),
            ("terms a list", "[limits]", "[[terms]]\n[limits]", "[terms]"),
            *lists("own_effects.eddy_brake", "parameters"),
        ],
    ),
    *refusals(
        "table", SERIAL,
        [
            ("length 1e200", '0, "D3"', "0, 1e200", 'row "3"', "1e200|1e+200", "large|at most|m"),
            ("length complex", '0, "D3"', '0, "1j"', 'row "3"', "1j"),
            ("tower of powers", '0, "D3"', '0, "9**9**9**9"', 'row "3"', "9**9"),
            ("sin nested 200 times", '0, "D3"', f'0, "{"sin(" * 200}1{")" * 200}"', 'row "3"'),
            ("parentheses nested 5000", '0, "D3"', f'0, "{"(" * 5000}1{")" * 5000}"', 'row "3"'),
        ],
    ),
    *refusals(
        "effects", SERIAL,
        [
            ("shape a text", "vs = 0.1", 'vs = "fast"', "stribeck", "vs"),
            ("shape negative", "vs = 0.1", "vs = -0.1", "stribeck", "vs"),
            ("shapes without joint", '{joint = "1", vs', '{vs', "stribeck", "joint"),
            ("ripple twice the same", '{joint = "2", m = 14}', '{joint = "2", m = 7}',
             "motor_ripple"),
            ("no column: payload", 'viscous = "all"', 'payload = "all"', "payload"),
            ("own: load without reference", "v*exp(-((q - c)/w)**2)", "load*c*w", "reference"),
        ],
    ),
    *refusals(
        "values", SERIAL,
        [
            ("sigma true", "Fv1 = 2\n", "Fv1 = 2\nuncertainty = true\n", "uncertainty]"),
            ("limits inf", "2.5, 3, 10", "inf, 3, 10", "[limits]", "inf"),
            ("limits a number", '["-pi", 2.5, 3, 10]', "3", "[limits]", "got 3"),
            ("reference of an unknown", "[limits]", "[reference]\nZZ77 = 1\n[limits]", "ZZ77"),
            ("reference a text", "[limits]", '[reference]\nZZ1 = "x"\n[limits]', "[reference]"),
        ],
    ),
    *refusals(
        "loops", CRANK,
        [
            ("rows empty", '[["pin", "tip", "3", "position"]]', "[]", "[loops]"),
            ("name twice", '"position"]', '"position"], ["pin", "tip", "3", "position"]', "pin"),
            ("too few motors", '["1", "0", 1', '["1", "0", 0', "actuated"),
            ("too many motors", '["3", "0", 0', '["3", "0", 1', "over-constrained", "pin"),
            ("rigid where it cannot be", '"position"]', '"rigid"]', "over-constrained|pin"),
            ("home in degrees", "q2 = -1.86", "q2 = -106", "home"),
            *lists("loops", "home"),
        ],
    ),
    *refusals(
        "legs", PLANAR,
        [
            ("shared a text", 'shared = ["*2{i}"]', 'shared = "*2{i}"', "shared", "list"),
            ("links a text", 'P = ["M", "MX"]', 'P = "M"', "[links]", "list"),
            *lists("relations", "platform"),
        ],
    ),
]  # fmt: skip

LEGS = row(
    "loops: 3000 legs", "refused", "derive legs.toml", "legs|rows|joints", "3000|6000|9000",
    make=writes("legs.toml", re.sub(
        r"(?m)^legs = .*$", f"legs = {[str(k) for k in range(3000)]}",
        builtin_text("orthoglide-2012"))),
)  # fmt: skip

WORKS = [
    derived("table: numbers, names and variables in odd ways", SERIAL,
        ('"pi/2", 0, "pi', '1.5707963267948966, 0, "pi', '["1", "0"', '[1, 0', "0.1", '"0x1"',
         '"q1", 0]', '"-q1", 0]', '0, "D3"', '0, "sqrt(D3**2)*cos(0)"')),
    derived("values: of symbols, masses, titles and effects in odd ways", SERIAL,
        ("D3 = 0.45", "D3 = 0", 'tilt = "pi/6"', "tilt = 1.5707963267948966",
         "ZZ1 = 0.5", "M1 = -3", "[limits]", "[home]\nq1 = 0.1\n[limits]", "Arm with most", "腕",
         '"arm"', '"6-arm_2"', "viscous =", "back_emf =", 'coulomb = ["1", "2"]', "coulomb = []"),
        "腕", "6-arm_2"),
    *(derived(f"loops: {what}", CRANK, edits, *words, "6 base") for what, edits, *words in (
        ("home out of reach", ("L = 0.35", "L = 0.01"), "[home] completed"),
        ("home with the rod in line with the crank", ("q2 = -1.86", "q2 = 0")),
        ("described from the other side", ('"tip", "3"', '"3", "tip"')))),
]  # fmt: skip

ROWS = [*FILES, *TABLES, LEGS, *WORKS]
