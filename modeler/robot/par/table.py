"""The geometry of a `.par` file as the cells of `[mdh]`: exact angles, lengths with letters."""

import ast
from collections.abc import Iterator

from modeler.robot.par.angles import exact_angle
from modeler.robot.par.formula import Formula, formula, renamed, written
from modeler.robot.par.frames import ANGLES, GEOMETRY, Counts, Frame
from modeler.robot.par.letters import Symbols, declare, new_names, reserved, without_inverse
from modeler.robot.place import Place, listed

_LETTER = {"gamma": "gam", "alpha": "alp", "theta": "off", "b": "B", "d": "D", "r": "R"}
_TURN = 6.29  # rad


def table_cells(
    made: list[Frame], found: Counts, variables: dict[str, str], symbols: Symbols, place: Place
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


def _on_loops(made: list[Frame], found: Counts) -> set[int]:
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
    made: list[Frame], found: Counts, variables: dict[str, str], symbols: Symbols
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


def _letters(made: list[Frame], variables: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Every letter that is no joint variable, with its column."""
    for frame in made:
        for column in GEOMETRY:
            for letter in sorted(frame.cells[column].names - variables.keys()):
                yield letter, column


def _exact_terms(cell: Formula, rounded: dict[str, str]) -> Formula:
    """The angle with its decimal terms put as the multiples of pi/12 that they mean."""
    if cell.literal is not None:
        angle = exact_angle(cell.literal)
        if angle is None:
            return cell
        rounded[cell.literal] = angle
        return Formula(ast.parse(angle, mode="eval").body, angle)

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
    cell: Formula,
    frame: Frame,
    column: str,
    symbols: Symbols,
    equal: dict[float, list[str]],
    place: Place,
) -> Formula:
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
    return Formula(ast.parse(text, mode="eval").body, text)


def _add_variables(made: list[Frame], symbols: Symbols) -> None:
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
        frame.cells[frame.home] = Formula(tree, written(tree))
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
