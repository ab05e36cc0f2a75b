"""The geometry of a `.par` file as the cells of `[mdh]`: exact angles, lengths with letters."""

import ast
import itertools
import keyword
import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from modeler.core.expression import FUNCTIONS, ExpressionError, format_tree, parse_expression
from modeler.core.toml_cells import TomlCell, join_names
from modeler.effects import CATALOGUE
from modeler.formats.par_text import (
    BODIES,
    FRAMES,
    INERTIA,
    INVERSE,
    JOINTS,
    ParFormula,
    Statements,
    get_called_name,
    parse_formula,
    parse_python,
    rename_letters,
    rewrite_tree,
)
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import (
    ANGLES,
    C_WORDS,
    GEOMETRY,
    collect_parameter_owners,
    describe_rounded_angles,
    recognise_angle,
    recognise_angle_terms,
)

# The frames of a `.par` file: how many there are, what carries them, where their joints are.


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
        """Returns NF: every cut joint has a second frame, on the other side."""
        return 2 * self.joints - self.links

    @property
    def loops(self) -> int:
        """Returns the number of cut joints."""
        return self.joints - self.links


@dataclass
class ParFrame:
    """One frame of a .par file.

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
    def variable_column(self) -> str | None:
        """Returns the column of the joint variable."""
        return {0: "theta", 1: "r"}.get(self.sigma)


Frames = list[ParFrame]


def read_counts(statements: Statements) -> Counts:
    """Returns the numbers that the file states, checked against the lengths of its lists.

    Raises:
        RobotError: they are no counts, or a list is shorter or longer.
    """
    frames = len(statements.get_entries("Ant"))
    joints = _read_count("NJ", statements)
    links = _read_count("NL", statements)
    stated = _read_count("NF", statements)
    if joints is None:
        joints = links if links is not None else frames
    links = joints if links is None else links
    floating = any(
        statements.read_scalar(key, "0|1|true|false", "0 or 1") in ("1", "true")
        for key in ("is_mobile", "is_floating")
    )
    counts = Counts(links, joints, floating)
    if not 1 <= links <= joints:
        place = statements.by_key["NL" if "NL" in statements.by_key else "NJ"].place
        raise place.make_error(f"got NL = {links}, NJ = {joints}; expected 1 <= NL <= NJ")
    if stated is not None and stated != counts.frames:
        raise statements.by_key["NF"].place.make_error(
            f"NF: got {stated}, expected {counts.frames}, which is 2 NJ - NL for NJ = {joints}, "
            f"NL = {links}"
        )
    _check_lengths(statements, counts)
    return counts


def read_par_frames(statements: Statements, counts: Counts) -> Frames:
    """Returns the frames with their cells.

    Raises:
        RobotError: an entry is no formula, no frame, or no 0, 1, 2.
    """
    frames = []
    for k in range(counts.frames):
        cells = {key: statements.read_formula(key, k, "0") for key in GEOMETRY}
        expected = "the base, 0, or a frame before it"
        antecedent = _read_whole_number(statements, "Ant", k, range(k + 1), expected)
        expected = "0 revolute, 1 prismatic or 2 fixed"
        sigma = _read_whole_number(statements, "Sigma", k, range(3), expected)
        mu = _read_whole_number(statements, "Mu", k, range(2), "1 actuated or 0 passive")
        frames.append(ParFrame(k + 1, antecedent, sigma, mu if sigma < 2 else 0, cells))
    return frames


def find_joint_variables(frames: Frames, statements: Statements) -> dict[str, str]:
    """Returns letter of a joint variable in the file -> `q<j>`; frames without one get theirs.

    The variable of frame j is the letter with its number (th3, t3, q3, r3), else the only letter
    of theta (revolute) or r (prismatic) that no frame before has. An entry without letters is the
    constant part.

    Raises:
        RobotError: several letters could be it.
    """
    variables: dict[str, str] = {}
    moving = [frame for frame in frames if frame.variable_column is not None]
    for frame in moving:
        for name in sorted(frame.cells[frame.variable_column or ""].names):
            usual = _USUAL.fullmatch(name)
            if usual and int(usual[1]) == frame.number:
                variables[name] = f"q{frame.number}"
    for frame in moving:
        column = frame.variable_column or ""
        letters = frame.cells[column].names
        has_variable = any(variables.get(letter) == f"q{frame.number}" for letter in letters)
        names = letters - variables.keys()
        if has_variable or not names:
            continue  # or it follows joints before
        if len(names) > 1:
            here = statements.by_key[column].locate_entry(frame.number)
            raise here.make_error(
                f'got "{frame.cells[column].source_text}"; expected the joint variable and no '
                f"other letter that could be it: write q{frame.number}"
            )
        variables |= dict.fromkeys(names, f"q{frame.number}")
    return variables


def _read_count(key: str, statements: Statements) -> int | None:
    text = statements.read_scalar(key, r"\d{1,4}", f"a count such as {key} = 6")
    return int(text) if text else None


def _check_lengths(statements: Statements, counts: Counts) -> None:
    lengths = dict.fromkeys(FRAMES, (counts.frames, "NF = 2 NJ - NL"))
    lengths |= dict.fromkeys(JOINTS, (counts.joints, "NJ"))
    lengths |= dict.fromkeys(BODIES, (counts.links + counts.floating, "NL"))
    lengths |= dict.fromkeys(("W0", "WP0", "V0", "VP0", "G"), (3, "x, y, z"))
    lengths["Z"] = (16, "a matrix of 4 by 4")
    for key, statement in statements.by_key.items():
        expected, why = lengths.get(key, (len(statement.entries), ""))
        if len(statement.entries) != expected:
            why += " and the base" if key in BODIES and counts.floating else ""
            raise statement.place.make_error(
                f"{key}: got {len(statement.entries)} entries, expected {expected} ({why}); "
                f"{'add' if len(statement.entries) < expected else 'remove'} "
                f"{abs(len(statement.entries) - expected)}"
            )


def _read_whole_number(
    statements: Statements, key: str, k: int, allowed: range, expected: str
) -> int:
    """An entry that is a whole number; a list that is missing is 0, or 1 for Mu."""
    statement = statements.by_key.get(key)
    if statement is None:
        return int(key == "Mu")
    text = statement.entries[k]
    if not re.fullmatch(r"\d{1,4}", text) or int(text) not in allowed:
        raise statement.locate_entry(k + 1).make_error(f'got "{text}"; expected {expected}')
    return int(text)


# Letters as declared symbols: their names here, and values.


_PRIMES = [n for n in range(29, 1000) if all(n % k for k in range(2, 32) if k < n)]
_TAKEN = {"pi", *FUNCTIONS, *INVERSE, *C_WORDS.split()}


@dataclass
class Symbols:
    """The symbols of the robot file that is written, in order.

    Attributes:
        values: name -> number, or expression of other symbols.
        comments: name -> what is said beside it.
        notes: what was made of the letters of the file, for people.
    """

    values: dict[str, float | str] = field(default_factory=dict)
    comments: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def add_symbol(self, preferred_name: str, number: float, comment: str) -> str:
        """Returns a symbol for a number, under that name or one like it; returns the name."""
        name, count = preferred_name, 1
        while name in self.values or name in _TAKEN:
            count += 1
            name = f"{preferred_name}_{count}"
        self.values[name] = number
        self.comments[name] = comment
        return name

    def evaluate_symbol(self, name: str) -> float:
        """Returns the value of a symbol."""
        value = self.values[name]
        if isinstance(value, float):
            return value
        return self.evaluate_formula(parse_python(value))

    def evaluate_formula(self, tree: ast.expr) -> float:
        """Returns what a formula without `INVERSE` functions is worth."""
        names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        values = {name: self.evaluate_symbol(name) for name in names & self.values.keys()}
        return parse_expression(ast.unparse(tree)).evaluate(values)


def collect_reserved_names(rows: int) -> set[str]:
    """Collects the names that no symbol can have in a robot of rows 1, 2, ..."""
    owners = collect_parameter_owners(CATALOGUE)
    columns = (prefix for prefix in owners if prefix[0].isupper())  # the others are no columns
    prefixes = ("q", "qc", "qd", "qdd", *INERTIA, *columns)
    return _TAKEN | {f"{prefix}{j}" for prefix in prefixes for j in range(1, rows + 1)}


def choose_symbol_names(
    letters: Iterable[str], taken: Collection[str], symbols: Symbols
) -> dict[str, str]:
    """Chooses names of symbols for letters that cannot keep their own; notes grow."""
    letters = list(letters)
    names: dict[str, str] = {}
    for letter in letters:
        base = letter if letter.isascii() else "s1"
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", base):
            base = f"s{re.sub(r'[^A-Za-z0-9_]', '', base)}"
        name = base
        while name in taken or (name != letter and name in {*letters, *names.values()}):
            name += "_"
        if name != letter:
            names[letter] = name
        was = letter[:-1] if keyword.iskeyword(letter[:-1]) else letter
        if name != was:
            symbols.notes.append(f"{was} is called {name} here: the name has a meaning of its own")
    return names


def replace_inverse_functions(
    cells: list[ParFormula], symbols: Symbols, place: TomlCell
) -> list[ParFormula]:
    """Returns the formulas without atan2, atan, acos and asin, which robot files do not have.

    `atan2(y, x)` of two letters becomes an angle A, with y = L*sin(A) and x = L*cos(A): exact,
    and `sqrt(x**2 + y**2)` is L. Any other becomes a symbol with its number.

    Raises:
        RobotError: one of a joint variable, or without a value.
    """
    polar: dict[frozenset[str], tuple[str, str]] = {}

    def replace_angle(call: ast.expr) -> ast.expr:
        name = get_called_name(call)
        if not isinstance(call, ast.Call) or name not in INVERSE:
            return call
        signed = [_parse_signed_name(argument) for argument in call.args]
        if name == "atan2" and all(one and one[1] in symbols.values for one in signed):
            (up, y), (along, x) = (one for one in signed if one is not None)
            if y != x and _make_polar(y, x, polar, symbols):
                # atan2(up*sin A, along*cos A)
                forms = {(1, 1): "{}", (-1, 1): "-{}", (1, -1): "pi - {}", (-1, -1): "{} - pi"}
                return parse_python(forms[up, along].format(polar[frozenset((y, x))][1]))
        if moving := ParFormula(call, "").names - symbols.values.keys():
            raise place.make_error(
                f"got {format_tree(call)}, which moves with {join_names(sorted(moving))}; robot "
                f"files have no {name}: expected one of lengths and numbers only"
            )
        try:
            value = INVERSE[name](*(symbols.evaluate_formula(argument) for argument in call.args))
        except ValueError:
            what = f"got {format_tree(call)}, which has no value at these lengths"
            raise place.make_error(what) from None
        symbol = symbols.add_symbol("ang1", float(f"{value:.12g}"), f"rad, {format_tree(call)}")
        symbols.notes.append(
            f"{format_tree(call)} is a symbol {symbol} with the value at the lengths above: change "
            "it with them"
        )
        return ast.Name(symbol, ast.Load())

    def replace_length(call: ast.expr) -> ast.expr:
        """Returns the name L for a call that is sqrt(x**2 + y**2), else the call."""
        for pair, (name, _) in polar.items():
            one, other = sorted(pair)
            sums = (f"sqrt({one}**2 + {other}**2)", f"sqrt({other}**2 + {one}**2)")
            if format_tree(call) in sums:
                return ast.Name(name, ast.Load())
        return call

    formulas = [one.replace_tree(rewrite_tree(one.tree, replace_angle)) for one in cells]
    return [one.replace_tree(rewrite_tree(one.tree, replace_length)) for one in formulas]


def _parse_signed_name(tree: ast.expr) -> tuple[int, str] | None:
    """1 and `b` of `b`, -1 and `b` of `-b`."""
    if isinstance(tree, ast.Name):
        return 1, tree.id
    if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub):
        return (-1, tree.operand.id) if isinstance(tree.operand, ast.Name) else None
    return None


def _make_polar(
    y: str, x: str, polar: dict[frozenset[str], tuple[str, str]], symbols: Symbols
) -> bool:
    """Have y and x as L*sin(A) and L*cos(A); False if one of them is so with another letter."""
    if frozenset((y, x)) in polar:
        return symbols.values[y] == "{}*sin({})".format(*polar[frozenset((y, x))])
    across, along = symbols.values[y], symbols.values[x]
    if isinstance(across, str) or isinstance(along, str):
        return False
    length = symbols.add_symbol("L1", round(math.hypot(across, along), 4), "m")
    angle = symbols.add_symbol("A1", round(math.atan2(across, along), 4), "rad")
    polar[frozenset((y, x))] = (length, angle)
    for name, function in ((y, "sin"), (x, "cos")):
        symbols.values[name] = f"{length}*{function}({angle})"
        symbols.comments.pop(name, None)
    symbols.notes.append(
        f"{y} = {length}*sin({angle}) and {x} = {length}*cos({angle}): {length} and {angle} take "
        f"the place of these letters, so that atan2 is exact"
    )
    return True


# The cells of the frames as those of a robot file.


LETTER = {"gamma": "gam", "alpha": "alp", "theta": "off", "b": "B", "d": "D", "r": "R"}


def convert_table_cells(
    frames: Frames, counts: Counts, variables: dict[str, str], symbols: Symbols, place: TomlCell
) -> None:
    """Turns the cells of the frames into those of a robot file; symbols and notes grow.

    Decimals near a multiple of pi/12 become it; other numbers become symbols with that value, in
    a robot with loops the same one wherever the length is the same; letters become symbols; joint
    variables become `q<j>`.
    """
    _declare_letters(frames, counts, variables, symbols)
    cells = [(frame, column) for frame in frames for column in GEOMETRY]
    formulas = [frame.cells[column] for frame, column in cells]
    exact = replace_inverse_functions(formulas, symbols, place)
    for (frame, column), cell in zip(cells, exact, strict=True):
        frame.cells[column] = cell
    rounded: dict[str, str] = {}
    looped = _find_loop_frames(frames, counts)
    equal: dict[float, list[str]] = {}
    for frame, column in cells:
        cell = frame.cells[column]
        if column in ANGLES:
            cell = _snap_cell_angle(cell, rounded)
        if cell.literal is not None and not cell.is_zero:
            same = equal if frame.number in looped and column not in ANGLES else {}
            cell = _declare_number(cell, frame, column, symbols, same, place)
        frame.cells[column] = cell
    _add_variables(frames, symbols)
    if rounded:
        symbols.notes.append(describe_rounded_angles(rounded))
    shared = [names for names in equal.values() if len(names) > 1]
    if shared:
        symbols.notes.append(
            "lengths of one loop that are equal are taken as one: "
            + "; ".join(f"{names[0]} for {join_names(names[1:])}" for names in shared)
        )


def _find_loop_frames(frames: Frames, counts: Counts) -> set[int]:
    """Frames between a cut joint and its second frame, through the tree."""
    numbers: set[int] = set()
    for k in range(counts.loops):
        sides = []
        for start in (counts.links + k + 1, counts.joints + k + 1):
            branch = {start}
            while (start := frames[start - 1].antecedent) != 0:
                branch.add(start)
            sides.append(branch)
        numbers |= sides[0] ^ sides[1]
    return numbers


def _declare_letters(
    frames: Frames, counts: Counts, variables: dict[str, str], symbols: Symbols
) -> None:
    """Declare the letters of the geometry by distinct stand-ins; put our names for theirs."""
    cells = [(frame.cells[column], column) for frame in frames for column in GEOMETRY]
    places = [(x, column) for cell, column in cells for x in sorted(cell.names - variables.keys())]
    letters = list(dict.fromkeys(letter for letter, _ in places))
    names = choose_symbol_names(letters, collect_reserved_names(counts.frames), symbols)
    lengths = {letter for letter, column in places if column not in ANGLES}
    stand_ins = {}
    for k, letter in enumerate(letter for letter in letters if letter in lengths):
        stand_ins[names.get(letter, letter)] = _PRIMES[k % len(_PRIMES)] / 100
    for k, letter in enumerate(letter for letter in letters if letter not in lengths):
        value = round(_PRIMES[k % len(_PRIMES)] / 100 + 0.05, 2)
        stand_ins[names.get(letter, letter)] = value
    symbols.values |= stand_ins
    symbols.comments |= dict.fromkeys(stand_ins, "no value in the file")
    if stand_ins:
        symbols.notes.append(
            f"no values in the file: {join_names(stand_ins)}; [symbols] holds stand-ins, write the "
            "true ones there (relations keep the letters)"
        )
    for frame in frames:
        for column in GEOMETRY:
            cell = frame.cells[column]
            if cell.names:
                tree = rename_letters(cell.tree, names | variables)
                frame.cells[column] = cell.replace_tree(tree)


def _snap_cell_angle(cell: ParFormula, rounded: dict[str, str]) -> ParFormula:
    """The angle with its decimal terms put as the multiples of pi/12 that they mean."""
    if cell.literal is None:
        return cell.replace_tree(recognise_angle_terms(cell.tree, rounded))
    angle = recognise_angle(cell.literal)  # all its digits, zeros at the end too
    if angle is None:
        return cell
    rounded[cell.literal] = angle
    return ParFormula(parse_python(angle), angle)


def _declare_number(
    cell: ParFormula,
    frame: ParFrame,
    column: str,
    symbols: Symbols,
    equal: dict[float, list[str]],
    place: TomlCell,
) -> ParFormula:
    """A number as a symbol with that value: positive, with its sign in the cell.

    `equal` grows: the value -> its symbol, and the entries of the file that share it.
    """
    number = float(cell.literal or 0)
    if column in ANGLES and abs(number) > THRESHOLDS.max_par_angle:
        raise place.enter(f"{column}, entry {frame.number}").make_error(
            f"got {cell.source_text}, which is more than a turn; angles are in radians: write Pi/2 "
            "for 90 degrees"
        )
    if abs(number) not in equal:
        unit = "rad" if column in ANGLES else "m"
        name = f"{LETTER[column]}{frame.number}"
        equal[abs(number)] = [symbols.add_symbol(name, abs(number), unit)]
    else:
        equal[abs(number)].append(f"{column} of frame {frame.number}")
    name = equal[abs(number)][0]
    text = f"-{name}" if number < 0 else name
    return ParFormula(parse_python(text), text)


def _add_variables(frames: Frames, symbols: Symbols) -> None:
    """`q<j>` where the file leaves the joint variable to be understood."""
    missing = []
    for frame in frames:
        if frame.variable_column is None:
            continue
        cell = frame.cells[frame.variable_column]
        if any(name.startswith("q") and name[1:].isdigit() for name in cell.names):
            continue
        rest = "" if cell.is_zero else f" + ({cell.text})"
        tree = parse_python(f"q{frame.number}{rest}")
        frame.cells[frame.variable_column] = ParFormula(tree, format_tree(tree))
        missing.append(f"q{frame.number}")
    if missing:
        names = join_names(missing)
        symbols.notes.append(f"joint variables that the file leaves out are added: {names}")


def convert_gravity(entries: tuple[str, ...], symbols: Symbols, place: TomlCell) -> list[str]:
    """Returns the cells of `convert_gravity`: numbers with the letter g where they are about 9.81.

    Letters have stand-ins: by these gravity has the usual size, along -z0 where the third entry has
    letters, else as the sign of the entry says; it is reported.
    """
    cells, letters = list[ParFormula](), list[str]()
    taken = set(symbols.values) | collect_reserved_names(0)
    for k, entry in enumerate(entries):
        cell = parse_formula(entry, place.enter(f"G, entry {k + 1}"))
        if cell.literal is not None:
            number = float(cell.literal)
            name = symbols.add_symbol("g", abs(number), "m/s^2") if 9.7 < abs(number) < 9.9 else ""
            text = f"{'-' * (number < 0)}{name}" if name else cell.text if number else "0"
            cells.append(ParFormula(parse_python(text), text))
            continue
        new_letters = sorted(cell.names - symbols.values.keys())
        names = choose_symbol_names(new_letters, taken, symbols)
        cells.append(cell.replace_tree(rename_letters(cell.tree, names)))
        letters += [names.get(letter, letter) for letter in new_letters]
    if letters:
        _assign_gravity_values(cells, list(dict.fromkeys(letters)), symbols)
    return [cell.text for cell in cells]


def _assign_gravity_values(
    cells: Sequence[ParFormula], letters: Sequence[str], symbols: Symbols
) -> None:
    """Give the letters of gravity values; shows where it points by them."""
    known: dict[str, float | str] = {}

    def evaluate_entry(k: int, values: Mapping[str, float] = MappingProxyType({})) -> float:
        symbols.values |= {**dict.fromkeys(letters, 1.0), **known, **values}
        try:
            return symbols.evaluate_formula(cells[k].tree)
        except (ArithmeticError, ValueError, ExpressionError):
            return math.nan

    entry_indices = [k for k in (2, 1, 0) if cells[k].names & {*letters}]
    fixed = any(evaluate_entry(k) for k in range(3) if k not in entry_indices)
    for k in entry_indices:
        unknown_letters = [x for x in letters if x in cells[k].names and x not in known]
        for first, rest in itertools.product(unknown_letters, (0.0, 1.0)):
            others = dict.fromkeys([x for x in unknown_letters if x != first], rest)
            at = [evaluate_entry(k, {**others, first: x}) for x in (0.0, 1.0, 2.0)]
            slope = at[1] - at[0]
            if abs(slope) > 0.0 and math.isclose(at[2] - at[1], slope):
                pull = 0.0 if fixed or k != entry_indices[0] else -THRESHOLDS.usual_gravity
                pull = pull if k == 2 else math.copysign(pull, slope)
                known |= {**others, first: round((pull - at[0]) / slope, 12)}
                break
    pulls = [evaluate_entry(k) for k in range(3)]
    symbols.comments |= dict.fromkeys(letters, "of gravity, no value in the file")
    values = join_names(f"{letter} = {symbols.evaluate_symbol(letter):g}" for letter in letters)
    along = [f"{'-' * (x < 0)}{axis}0" for axis, x in zip("xyz", pulls, strict=True) if x]
    direction = f"along {along[0]}" if len(along) == 1 else ", ".join(f"{x:.4g}" for x in pulls)
    symbols.notes.append(
        f"no value in the file: with {values}, a stand-in, gravity is taken {direction}, "
        f"{math.hypot(*pulls):.4g} m/s2"
    )
