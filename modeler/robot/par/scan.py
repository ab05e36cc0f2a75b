"""The statements of a `.par` file: `KEY = {entry, entry}` and `KEY = number`, with their lines."""

import codecs
import re
from dataclasses import dataclass

from modeler.robot.place import Place, listed, near, shown

SCALARS = ("NF", "NL", "NJ", "Type", "is_mobile", "is_floating")
FRAMES = ("Ant", "Sigma", "b", "d", "r", "gamma", "alpha", "Mu", "theta")
"""Lists of one entry for each frame."""
INERTIA = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
FRICTION = ("IA", "FV", "FS")
FORCES = ("FX", "FY", "FZ", "CX", "CY", "CZ")
BODIES = (*INERTIA, *FRICTION, *FORCES)
"""Lists of one entry for each link."""
JOINTS = ("QP", "QDP", "GAM", "eta", "k")
BASE = ("W0", "WP0", "V0", "VP0", "Z", "G")
KEYS = (*SCALARS, *FRAMES, *BODIES, *JOINTS, *BASE)

_KEY = {key.lower(): key for key in KEYS}
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
_NAME = re.compile(r"Robotname\s*=\s*'([^'\n]*)'", re.IGNORECASE)
_HEAD = re.compile(r"[\s;]*([^\W\d]\w*)[ \t]*=\s*")
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


@dataclass(frozen=True)
class Statement:
    """One statement.

    Attributes:
        key: as `KEYS` spells it.
        entries: of the list, or the one value.
        place: file and line.
    """

    key: str
    entries: tuple[str, ...]
    place: Place

    def entry_place(self, number: int) -> Place:
        """Where entry `number`, counted from 1, stands."""
        return self.place.at(f"{self.key}, entry {number}")


@dataclass(frozen=True)
class Statements:
    """What a file says.

    Attributes:
        name: of the robot, as a comment of the file gives it; "" without one.
        by_key: the statements.
        place: the file.
    """

    name: str
    by_key: dict[str, Statement]
    place: Place

    def entries(self, key: str) -> tuple[str, ...]:
        """The list of that key; empty if the file has none."""
        statement = self.by_key.get(key)
        return statement.entries if statement else ()


def scan(data: bytes, where: str) -> Statements:
    """The statements of a file.

    Keys may be written in capitals or not, and in any order; line ends and encoding are found.

    Raises:
        RobotError: it is no such file; an unknown key, a key twice, a list that is not closed.
    """
    place = Place(where)
    text = _decoded(data, place)
    named = _NAME.search(text)
    bare = _COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    opened = bare.find("(*")
    if opened >= 0:
        raise _line(place, bare, opened).error('the comment "(*" is not closed; end it with "*)"')
    by_key: dict[str, Statement] = {}
    at = 0
    while re.search(r"[^\s;]", bare[at:]):
        statement, at = _statement(bare, at, place)
        if statement.key in by_key:
            raise statement.place.error(
                f"{statement.key} stands twice, first on {by_key[statement.key].place.spot}; "
                "remove one"
            )
        by_key[statement.key] = statement
    if "Ant" not in by_key:
        raise place.error(
            "is no SYMORO file: the list Ant is missing; expected Ant = {0,1,...}, the antecedent "
            "of every frame, beside Sigma, d, r, alpha, theta"
        )
    return Statements(named[1].strip() if named else "", by_key, place)


def _decoded(data: bytes, place: Place) -> str:
    """The text; comments of old files are in the encoding of Windows."""
    if data.startswith(_UTF16):
        text = data.decode("utf-16", errors="replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        raise place.error("is no text; expected a SYMORO file, such as KEY = {0,1,2} line by line")
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\x1a")  # end of file in DOS


def _line(place: Place, text: str, at: int) -> Place:
    return place.at(f"line {text.count(chr(10), 0, at) + 1}")


def _statement(text: str, at: int, place: Place) -> tuple[Statement, int]:
    """The statement that starts at or after `at`, and where it ends."""
    head = _HEAD.match(text, at)
    start = at + len(text[at:]) - len(re.sub(r"^[\s;]*", "", text[at:]))
    here = _line(place, text, start)
    if head is None:
        got = text[start:].splitlines()[0].strip()
        raise here.error(f"got {shown(got)}; expected KEY = {{...}} or KEY = number")
    key = _KEY.get(head[1].lower())
    if key is None:
        raise here.error(
            f"unknown keyword {shown(head[1])}{near(head[1], KEYS)}; expected one of {listed(KEYS)}"
        )
    here = place.at(here.spot)
    if text[head.end() : head.end() + 1] != "{":
        value = re.compile(r"[^\n;]*").match(text, head.end())
        assert value is not None
        if key not in SCALARS:
            raise here.error(f"{key}: got {shown(value[0].strip())}; expected a list in braces")
        return Statement(key, (value[0].strip(),), here), value.end()
    end = text.find("}", head.end())
    inner = text[head.end() + 1 : end]
    if end < 0 or "=" in inner or "{" in inner:
        raise here.error(f"{key}: the list is not closed; end it with }}")
    if key in SCALARS:
        raise here.error(f"{key}: got a list; expected one number, as in {key} = 6")
    return Statement(key, _entries(inner, key, here), here), end + 1


def _entries(inner: str, key: str, place: Place) -> tuple[str, ...]:
    """The entries between commas that stand in no parentheses."""
    entries, depth = [""], 0
    for letter in inner:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            entries.append("")
        else:
            entries[-1] += letter
    entries = [" ".join(entry.split()) for entry in entries]
    if entries == [""]:
        return ()
    for number, entry in enumerate(entries, start=1):
        if not entry:
            raise place.at(f"{key}, entry {number}").error(
                "is empty; expected a number, a letter or an expression"
            )
    return tuple(entries)
