"""Robot files: through the whole command, and what tests/robot/ has no message for."""

import re
from collections.abc import Callable, Iterable
from functools import partial

from modeler.api import derive
from modeler.robot.read import parse_robot_text
from tests.bad_input.row import Make, Row, row
from tests.bad_input.workdir import Workdir
from tests.robot.texts import ARM, OWN_EFFECTS, PLANAR
from tests.robot_texts import CRANK

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
    return derive(parse_robot_text(content, name))


def _file(content: str) -> str:
    """A name for a robot file: that of the good file, by which messages call the robot too."""
    result = re.search(r'^name = "(\w+)"$', content, re.MULTILINE)
    return f"{result[1][:20] if result else 'bad'}.toml"


def derived(what: str, text: str, edits: Iterable[str], *words: str) -> Row:
    """A row of a robot file that must work with all these edits; its words are in the output."""
    make = writes("odd.toml", edited(text, *edits))
    return row(what, "works", DERIVE.format("odd.toml"), *words, make=make)


def _effect(line: str) -> tuple[str, str]:
    """The edit that adds a line to [effects]."""
    return "[effects]", f"[effects]\n{line}"


_RIPPLE = 'motor_ripple = [{joint = "2", m = 7}, {joint = "2", m = 7}]'
_NESTED = "[" * 2000 + "]" * 2000
_DEEP = "sin(" * 200 + "q" + ")" * 200

FILES = [
    row("toml: a model file", "refused", "derive m.json", "m.json", "toml"),
    row("toml: empty name", "refused", ("derive", ""), "robot", "empty|got \"\""),
    row("toml: a loop of links", "refused", "derive loop.toml", "loop.toml",
        make=lambda w: w.path("loop.toml").symlink_to("loop.toml")),
    row("toml: mistake in a file whose name has a line end", "refused",
        ("derive", "two\nlines.toml"), "two lines.toml", "name",
        make=writes("two\nlines.toml", "")),
    row("toml: byte order mark and line ends of Windows", "works", "derive odd.toml --no-terms",
        "arm", make=writes("odd.toml", "\ufeff" + ARM.replace("\n", "\r\n"))),
    row("toml: a link to a file in Greek", "works", "derive link.toml --no-terms", "arm",
        make=lambda w: w.path("link.toml").symlink_to(w.write("ρομπότ (1).toml", ARM))),
    row("toml: titles that end a comment or a text of C", "works", "generate arm.toml --out c",
        make=writes("arm.toml", edited(OWN_EFFECTS, "gravity", 'title = "*/ #error ??/"\ngravity',
                                       "drag of", 'the \\"fan\\" \\\\ of\\t'))),
    row("toml: equation nested 200 deep", "ends", "derive arm.toml --no-terms", "arm",
        make=writes("arm.toml", edited(OWN_EFFECTS, "v*exp", f"{_DEEP}*exp"))),
]  # fmt: skip

# What tests/robot/ has no message for, or what may take long.
TABLES = [
    *refusals(
        "robot",
        ARM,
        [
            ("unclosed quote", 'title = "Arm', 'title = "Arm\nx', "line 2", "toml"),
            ("nested 2000 deep", 'notes = "none"', f"notes = {_NESTED}", "nested"),
            ("integer of 5000 digits", "g = 9.81", f"g = {'9' * 5000}", "digits", "at most|short"),
            ("tower of powers", '0, "D3"', '0, "9**9**9**9"', 'row "3"', "9**9"),
            ("sin nested 200 times", '0, "D3"', f'0, "{"sin(" * 200}1{")" * 200}"', 'row "3"'),
            ("parentheses nested 5000", '0, "D3"', f'0, "{"(" * 5000}1{")" * 5000}"', 'row "3"'),
            ("shape negative", *_effect('stribeck = [{joint = "1", vs = -0.1}]'), "stribeck", "vs"),
            ("shapes without joint", *_effect("stribeck = [{vs = 0.1}]"), "stribeck", "joint"),
            ("ripple twice", *_effect(_RIPPLE), "motor_ripple"),
            ("no column", *_effect('payload = "all"'), "payload"),
            *lists("symbols", "parameters", "limits", "drive_gains"),
        ],
    ),
    *refusals(
        "loops",
        CRANK,
        [
            ("rows empty", '[["pin", "tip", "3", "position"]]', "[]", "[loops]"),
            ("name twice", '"position"]', '"position"], ["pin", "tip", "3", "position"]', "pin"),
            ("too many motors", '["3", "0", 0', '["3", "0", 1', "over-constrained", "pin"),
            ("rigid where it cannot be", '"position"]', '"rigid"]', "over-constrained|pin"),
            ("home in degrees", "q2 = -1.86", "q2 = -106", "home"),
            *lists("loops", "home"),
        ],
    ),
    *refusals("legs", PLANAR, lists("relations", "platform", "links")),
]

WORKS = [
    derived("table: numbers, names and variables in odd ways", ARM,
        ('"pi/2", 0, "pi', '1.5707963267948966, 0, "pi', '["1", "0"', '[1, 0', "0.1", '"0x1"',
         '"q1", 0]', '"-q1", 0]', '0, "D3"', '0, "sqrt(D3**2)*cos(0)"')),
    derived("values: of symbols, masses, titles and effects in odd ways", ARM,
        ("D3 = 0.45", "D3 = 0", "ZZ1 = 0.5", "M1 = -3", "[limits]", "[home]\nq1 = 0.1\n[limits]",
         "Arm for tests", "腕", '"arm"', '"6-arm_2"', "viscous =", "back_emf =",
         'rotor_inertia = ["1", "2"]', "rotor_inertia = []"),
        "腕", "6-arm_2"),
    *(derived(f"loops: {what}", CRANK, edits, *words, "6 base") for what, edits, *words in (
        ("home out of reach", ("L = 0.35", "L = 0.01"), "[home] completed"),
        ("home with the rod in line with the crank", ("q2 = -1.86", "q2 = 0")),
        ("described from the other side", ('"tip", "3"', '"3", "tip"')))),
]  # fmt: skip

ROWS = [*FILES, *TABLES, *WORKS]
