"""The geometry of a `.par` file as the cells of `[mdh]`: exact angles, lengths with letters."""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from modeler.core.toml_cells import Place, listed
from modeler.robot.letters import Symbols, declare, new_names, reserved, without_inverse
from modeler.robot.par_text import (
    BODIES,
    FRAMES,
    JOINTS,
    ParFormula,
    Statements,
    exact_angle,
    formula,
    renamed,
    written,
)

# The frames of a `.par` file: how many there are, what carries them, where their joints are.


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
class ParFrame:
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
    cells: dict[str, ParFormula]

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


def frames(statements: Statements, found: Counts) -> list[ParFrame]:
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
        made.append(ParFrame(k + 1, antecedent, sigma, mu if sigma < 2 else 0, cells))
    return made


def variables(made: list[ParFrame], statements: Statements) -> dict[str, str]:
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


def _cell(statements: Statements, key: str, k: int) -> ParFormula:
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


_LETTER = {"gamma": "gam", "alpha": "alp", "theta": "off", "b": "B", "d": "D", "r": "R"}
_TURN = 6.29  # rad


def table_cells(
    made: list[ParFrame], found: Counts, variables: dict[str, str], symbols: Symbols, place: Place
) -> None:
    """Turn the cells of the frames into those of a robot file; symbols and notes grow.

    Decimals near a multiple of pi/12 become it; other numbers become symbols with that value, in
    a robot with loops the same one wherever the length is the same; letters become symbols; joint
    variables become `q<j>`.
    """
    _name_letters(made, found, variables, symbols)
    cells = [(frame, column) for frame in made for column in GEOMETRY]
    exact = without_inverse([frame.cells[column] for frame, column in cells], symbols)
    for (frame, column), cell in zip(cells, exact, strict=True):
        frame.cells[column] = cell
    rounded: dict[str, str] = {}
    looped = _on_loops(made, found)
    equal: dict[float, list[str]] = {}
    for frame, column in cells:
        cell = frame.cells[column]
        if column in ANGLES:
            cell = _exact_terms(cell, rounded)
        if cell.literal is not None and not cell.is_zero:
            same = equal if frame.number in looped and column not in ANGLES else {}
            cell = _as_symbol(cell, frame, column, symbols, same, place)
        frame.cells[column] = cell
    _add_variables(made, symbols)
    if rounded:
        symbols.notes.append(
            "rounded angles are exact here: "
            + listed(f"{digits} is {angle}" for digits, angle in rounded.items())
        )
    shared = [names for names in equal.values() if len(names) > 1]
    if shared:
        symbols.notes.append(
            "lengths of one loop that are equal are taken as one: "
            + "; ".join(f"{names[0]} for {listed(names[1:])}" for names in shared)
        )


def _on_loops(made: list[ParFrame], found: Counts) -> set[int]:
    """Frames between a cut joint and its second frame, through the tree."""
    numbers: set[int] = set()
    for k in range(found.loops):
        sides = []
        for start in (found.links + k + 1, found.joints + k + 1):
            way = {start}
            while (start := made[start - 1].antecedent) != 0:
                way.add(start)
            sides.append(way)
        numbers |= sides[0] ^ sides[1]
    return numbers


def _name_letters(
    made: list[ParFrame], found: Counts, variables: dict[str, str], symbols: Symbols
) -> None:
    """Declare the letters of the geometry, and put our names for theirs."""
    places = list(_letters(made, variables))
    letters = list(dict.fromkeys(letter for letter, _ in places))
    names = new_names(letters, reserved(found.frames), symbols)
    lengths = dict.fromkeys(letter for letter, column in places if column not in ANGLES)
    declare(
        [names.get(letter, letter) for letter in letters if letter in lengths],
        [names.get(letter, letter) for letter in letters if letter not in lengths],
        symbols,
    )
    for frame in made:
        for column in GEOMETRY:
            cell = frame.cells[column]
            if cell.names:
                frame.cells[column] = cell.replaced(renamed(cell.tree, names | variables))


def _letters(made: list[ParFrame], variables: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Every letter that is no joint variable, with its column."""
    for frame in made:
        for column in GEOMETRY:
            for letter in sorted(frame.cells[column].names - variables.keys()):
                yield letter, column


def _exact_terms(cell: ParFormula, rounded: dict[str, str]) -> ParFormula:
    """The angle with its decimal terms put as the multiples of pi/12 that they mean."""
    if cell.literal is not None:
        angle = exact_angle(cell.literal)
        if angle is None:
            return cell
        rounded[cell.literal] = angle
        return ParFormula(ast.parse(angle, mode="eval").body, angle)

    def exact(node: ast.expr) -> ast.expr:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
            return ast.BinOp(exact(node.left), node.op, exact(node.right))
        if isinstance(node, ast.UnaryOp):
            return ast.UnaryOp(node.op, exact(node.operand))
        if isinstance(node, ast.Constant) and isinstance(node.value, float):
            angle = exact_angle(repr(node.value))
            if angle is not None:
                rounded[repr(node.value)] = angle
                return ast.parse(angle, mode="eval").body
        return node

    return cell.replaced(exact(cell.tree))


def _as_symbol(
    cell: ParFormula,
    frame: ParFrame,
    column: str,
    symbols: Symbols,
    equal: dict[float, list[str]],
    place: Place,
) -> ParFormula:
    """A number as a symbol with that value: positive, with its sign in the cell.

    `equal` grows: the value -> its symbol, and the entries of the file that share it.
    """
    number = float(cell.literal or 0)
    if column in ANGLES and abs(number) > _TURN:
        raise place.at(f"{column}, entry {frame.number}").error(
            f"got {cell.written}, which is more than a turn; angles are in radians: write Pi/2 for "
            "90 degrees"
        )
    if abs(number) not in equal:
        unit = "rad" if column in ANGLES else "m"
        equal[abs(number)] = [symbols.add(f"{_LETTER[column]}{frame.number}", abs(number), unit)]
    else:
        equal[abs(number)].append(f"{column} of frame {frame.number}")
    name = equal[abs(number)][0]
    text = f"-{name}" if number < 0 else name
    return ParFormula(ast.parse(text, mode="eval").body, text)


def _add_variables(made: list[ParFrame], symbols: Symbols) -> None:
    """`q<j>` where the file leaves the joint variable to be understood."""
    missing = []
    for frame in made:
        if frame.home is None:
            continue
        cell = frame.cells[frame.home]
        if any(name.startswith("q") and name[1:].isdigit() for name in cell.names):
            continue
        rest = "" if cell.is_zero else f" + ({cell.text})"
        text = f"q{frame.number}{rest}"
        tree = ast.parse(text, mode="eval").body
        frame.cells[frame.home] = ParFormula(tree, written(tree))
        missing.append(f"q{frame.number}")
    if missing:
        symbols.notes.append(
            f"joint variables that the file leaves out are added: {listed(missing)}"
        )


def gravity(entries: tuple[str, ...], symbols: Symbols, place: Place) -> list[str]:
    """The cells of `gravity`: numbers with the letter g where they are about 9.81.

    Letters have stand-ins: the third the usual one, so that z points up.
    """
    cells = []
    taken = set(symbols.values) | reserved(0)
    for k, entry in enumerate(entries):
        cell = formula(entry, place.at(f"G, entry {k + 1}"))
        if cell.literal is not None:
            number = float(cell.literal)
            if 9.7 < abs(number) < 9.9:
                name = symbols.add("g", abs(number), "m/s^2")
                cells.append(f"-{name}" if number < 0 else name)
            else:
                cells.append("0" if number == 0 else cell.text)
            continue
        names = new_names(sorted(cell.names - symbols.values.keys()), taken, symbols)
        for letter in sorted(cell.names - symbols.values.keys()):
            name = names.get(letter, letter)
            symbols.values[name] = (0.5, 0.7, -9.81)[k]
            symbols.comments[name] = "m/s^2, no value in the file"
            symbols.notes.append(f"{name} has no value in the file; gravity is taken along -z0")
        cells.append(written(renamed(cell.tree, names)))
    return cells
