"""The frames of a `.par` file: how many there are, what carries them, where their joints are."""

import re
from dataclasses import dataclass

from modeler.robot.par.formula import Formula, formula
from modeler.robot.par.scan import BODIES, FRAMES, JOINTS, Statements

GEOMETRY = ("gamma", "b", "alpha", "d", "theta", "r")
ANGLES = ("gamma", "alpha", "theta")
_USUAL = re.compile(r"(?:theta|th|t|q|r|d|x)_?(\d+)", re.IGNORECASE)


@dataclass(frozen=True)
class Counts:
    """How many links, joints and frames; frames NL + 1 .. NJ are those of the cut joints.

    Attributes:
        links: NL.
        joints: NJ.
        floating: the base moves, and its own parameters stand before those of link 1.
    """

    links: int
    joints: int
    floating: bool

    @property
    def frames(self) -> int:
        """NF: every cut joint has a second frame, on the other side."""
        return 2 * self.joints - self.links

    @property
    def loops(self) -> int:
        """Cut joints."""
        return self.joints - self.links


@dataclass
class Frame:
    """One frame.

    Attributes:
        number: 1, 2, ...
        antecedent: number of the frame that carries it, 0 for the base.
        sigma: 0 revolute, 1 prismatic, 2 fixed.
        mu: 1 actuated, 0 passive.
        cells: the geometry by column.
    """

    number: int
    antecedent: int
    sigma: int
    mu: int
    cells: dict[str, Formula]

    @property
    def home(self) -> str | None:
        """The column of the joint variable."""
        return {0: "theta", 1: "r"}.get(self.sigma)


def counts(statements: Statements) -> Counts:
    """The numbers that the file states, checked against the lengths of its lists.

    Raises:
        RobotError: they are no counts, or a list is shorter or longer.
    """
    frames = len(statements.entries("Ant"))
    joints = _count("NJ", statements)
    links = _count("NL", statements)
    stated = _count("NF", statements)
    if joints is None:
        joints = links if links is not None else frames
    links = joints if links is None else links
    floating = any(_is_true(key, statements) for key in ("is_mobile", "is_floating"))
    found = Counts(links, joints, floating)
    if not 1 <= links <= joints:
        place = statements.by_key["NL" if "NL" in statements.by_key else "NJ"].place
        raise place.error(f"got NL = {links}, NJ = {joints}; expected 1 <= NL <= NJ")
    if stated is not None and stated != found.frames:
        raise statements.by_key["NF"].place.error(
            f"NF: got {stated}, expected {found.frames}, which is 2 NJ - NL for NJ = {joints}, "
            f"NL = {links}"
        )
    _check_lengths(statements, found)
    return found


def frames(statements: Statements, found: Counts) -> list[Frame]:
    """The frames with their cells.

    Raises:
        RobotError: an entry is no formula, no frame, or no 0, 1, 2.
    """
    made = []
    for k in range(found.frames):
        cells = {key: _cell(statements, key, k) for key in GEOMETRY}
        antecedent = _whole(statements, "Ant", k, range(k + 1), "the base, 0, or a frame before it")
        sigma = _whole(statements, "Sigma", k, range(3), "0 revolute, 1 prismatic or 2 fixed")
        mu = _whole(statements, "Mu", k, range(2), "1 actuated or 0 passive")
        made.append(Frame(k + 1, antecedent, sigma, mu if sigma < 2 else 0, cells))
    return made


def variables(made: list[Frame], statements: Statements) -> dict[str, str]:
    """Letter of a joint variable in the file -> `q<j>`; frames without one get theirs.

    The variable of frame j is the letter with its number (th3, t3, q3, r3), else the only letter
    of theta (revolute) or r (prismatic) that no frame before has. An entry without letters is the
    constant part.

    Raises:
        RobotError: several letters could be it.
    """
    found: dict[str, str] = {}
    moving = [frame for frame in made if frame.home is not None]
    for frame in moving:
        for name in sorted(frame.cells[frame.home or ""].names):
            usual = _USUAL.fullmatch(name)
            if usual and int(usual[1]) == frame.number:
                found[name] = f"q{frame.number}"
    for frame in moving:
        column = frame.home or ""
        letters = frame.cells[column].names
        own = any(found.get(letter) == f"q{frame.number}" for letter in letters)
        names = letters - found.keys()
        if own or not names:
            continue  # or it follows joints before
        if len(names) > 1:
            here = statements.by_key[column].entry_place(frame.number)
            raise here.error(
                f'got "{frame.cells[column].written}"; expected the joint variable and no other '
                f"letter that could be it: write q{frame.number}"
            )
        found |= dict.fromkeys(names, f"q{frame.number}")
    return found


def _count(key: str, statements: Statements) -> int | None:
    statement = statements.by_key.get(key)
    if statement is None:
        return None
    text = statement.entries[0]
    if not re.fullmatch(r"\d{1,4}", text):
        raise statement.place.error(f'{key}: got "{text}"; expected a count such as {key} = 6')
    return int(text)


def _is_true(key: str, statements: Statements) -> bool:
    statement = statements.by_key.get(key)
    if statement is None:
        return False
    text = statement.entries[0].lower()
    if text not in ("0", "1", "true", "false"):
        raise statement.place.error(f'{key}: got "{statement.entries[0]}"; expected 0 or 1')
    return text in ("1", "true")


def _check_lengths(statements: Statements, found: Counts) -> None:
    lengths = dict.fromkeys(FRAMES, (found.frames, "NF = 2 NJ - NL"))
    lengths |= dict.fromkeys(JOINTS, (found.joints, "NJ"))
    lengths |= dict.fromkeys(BODIES, (found.links + found.floating, "NL"))
    lengths |= dict.fromkeys(("W0", "WP0", "V0", "VP0", "G"), (3, "x, y, z"))
    lengths["Z"] = (16, "a matrix of 4 by 4")
    for key, statement in statements.by_key.items():
        expected, why = lengths.get(key, (len(statement.entries), ""))
        if len(statement.entries) != expected:
            why += " and the base" if key in BODIES and found.floating else ""
            raise statement.place.error(
                f"{key}: got {len(statement.entries)} entries, expected {expected} ({why}); "
                f"{'add' if len(statement.entries) < expected else 'remove'} "
                f"{abs(len(statement.entries) - expected)}"
            )


def _cell(statements: Statements, key: str, k: int) -> Formula:
    statement = statements.by_key.get(key)
    if statement is None:
        return formula("0", statements.place)
    return formula(statement.entries[k], statement.entry_place(k + 1))


def _whole(statements: Statements, key: str, k: int, allowed: range, told: str) -> int:
    """An entry that is a whole number; a list that is missing is 0, or 1 for Mu."""
    statement = statements.by_key.get(key)
    if statement is None:
        return int(key == "Mu")
    text = statement.entries[k]
    if not re.fullmatch(r"\d{1,4}", text) or int(text) not in allowed:
        raise statement.entry_place(k + 1).error(f'got "{text}"; expected {told}')
    return int(text)
