"""The letters of a `.par` file as declared symbols: their names here, and values."""

import ast
import keyword
import math
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

from modeler.core.expression import FUNCTIONS
from modeler.core.toml_cells import listed
from modeler.effects.catalogue import CATALOGUE
from modeler.robot.cells import C_WORDS
from modeler.robot.par_text import INERTIA, INVERSE, Each, ParFormula, renamed, value, written

GRAVITY = 9.81  # m/s2
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

    def add(self, wanted: str, number: float, comment: str) -> str:
        """A symbol for a number, under that name or one like it; returns the name."""
        name, count = wanted, 1
        while name in self.values or name in _TAKEN:
            count += 1
            name = f"{wanted}_{count}"
        self.values[name] = number
        self.comments[name] = comment
        return name

    def number(self, name: str) -> float:
        """What it is worth."""
        worth = self.values[name]
        if isinstance(worth, float):
            return worth
        tree = ast.parse(worth, mode="eval").body
        names = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} & self.values.keys()
        return value(tree, {other: self.number(other) for other in names})


def reserved(rows: int) -> set[str]:
    """Names that a symbol cannot have in a robot of rows 1, 2, ...: variables and parameters."""
    effects = {column.prefix for e in CATALOGUE for form in e.forms for column in form.columns}
    columns = (prefix for prefix in effects if prefix[0].isupper())  # the others are no columns
    prefixes = ("q", "qc", "qd", "qdd", *INERTIA, *columns)
    return _TAKEN | {f"{prefix}{j}" for prefix in prefixes for j in range(1, rows + 1)}


def new_names(letters: Iterable[str], taken: Collection[str], symbols: Symbols) -> dict[str, str]:
    """Letter of the file -> name of the symbol, where it cannot keep its own; told in the notes."""
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


def declare(lengths: Iterable[str], angles: Iterable[str], symbols: Symbols) -> None:
    """Declare letters without a value in the file: distinct stand-ins, told in the notes."""
    stand_ins = []
    for k, name in enumerate(lengths):
        symbols.values[name] = _PRIMES[k % len(_PRIMES)] / 100
        stand_ins.append(name)
    for k, name in enumerate(angles):
        symbols.values[name] = round(_PRIMES[k % len(_PRIMES)] / 100 + 0.05, 2)
        stand_ins.append(name)
    for name in stand_ins:
        symbols.comments[name] = "no value in the file"
    if stand_ins:
        symbols.notes.append(
            f"no values in the file: {listed(stand_ins)}; [symbols] holds stand-ins, write the "
            "true ones there (relations keep the letters)"
        )


def without_inverse(cells: list[ParFormula], symbols: Symbols) -> list[ParFormula]:
    """The formulas without atan2, atan, acos and asin, which robot files do not have.

    `atan2(y, x)` of two letters becomes an angle A, with y = L*sin(A) and x = L*cos(A): exact,
    and `sqrt(x**2 + y**2)` is L. Any other becomes a symbol with its number.
    """
    polar: dict[frozenset[str], tuple[str, str]] = {}

    def angle(call: ast.Call) -> ast.expr:
        name = call.func.id if isinstance(call.func, ast.Name) else ""
        if name not in INVERSE:
            return call
        signed = [_signed(argument) for argument in call.args]
        if name == "atan2" and all(one and one[1] in symbols.values for one in signed):
            (up, y), (along, x) = (one for one in signed if one is not None)
            if y != x and _make_polar(y, x, polar, symbols):
                return _turned(polar[frozenset((y, x))][1], up, along)
        worth = INVERSE[name](*(_value(argument, symbols) for argument in call.args))
        made = symbols.add("ang1", float(f"{worth:.12g}"), f"rad, {written(call)}")
        symbols.notes.append(
            f"{written(call)} is a symbol {made} with the value at the lengths above: change it "
            "with them"
        )
        return ast.Name(made, ast.Load())

    found = [one.replaced(Each(angle).visit(renamed(one.tree, {}))) for one in cells]
    return [one.replaced(_lengths(one.tree, polar)) for one in found]


def _value(tree: ast.expr, symbols: Symbols) -> float:
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return value(tree, {name: symbols.number(name) for name in names & symbols.values.keys()})


def _signed(tree: ast.expr) -> tuple[int, str] | None:
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
        return symbols.values[y] == _polar_text(*polar[frozenset((y, x))], "sin")
    across, along = symbols.values[y], symbols.values[x]
    if isinstance(across, str) or isinstance(along, str):
        return False
    length = symbols.add("L1", round(math.hypot(across, along), 4), "m")
    angle = symbols.add("A1", round(math.atan2(across, along), 4), "rad")
    polar[frozenset((y, x))] = (length, angle)
    for name, function in ((y, "sin"), (x, "cos")):
        symbols.values[name] = _polar_text(length, angle, function)
        symbols.comments.pop(name, None)
    symbols.notes.append(
        f"{y} = {length}*sin({angle}) and {x} = {length}*cos({angle}): {length} and {angle} take "
        f"the place of these letters, so that atan2 is exact"
    )
    return True


def _polar_text(length: str, angle: str, function: str) -> str:
    return f"{length}*{function}({angle})"


def _turned(angle: str, up: int, along: int) -> ast.expr:
    """atan2(up*sin A, along*cos A)."""
    forms = {(1, 1): "{}", (-1, 1): "-{}", (1, -1): "pi - {}", (-1, -1): "{} - pi"}
    return ast.parse(forms[up, along].format(angle), mode="eval").body


def _lengths(tree: ast.expr, polar: Mapping[frozenset[str], tuple[str, str]]) -> ast.expr:
    """The formula with L for sqrt(x**2 + y**2)."""

    def shorter(call: ast.Call) -> ast.expr:
        for pair, (length, _) in polar.items():
            one, other = sorted(pair)
            sums = (f"sqrt({one}**2 + {other}**2)", f"sqrt({other}**2 + {one}**2)")
            if written(call) in sums:
                return ast.Name(length, ast.Load())
        return call

    result: ast.expr = Each(shorter).visit(tree)
    return result
