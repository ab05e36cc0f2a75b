"""Speeds, energies and forces as a paper prints them."""

import re
from collections.abc import Mapping
from fractions import Fraction

import sympy

from modeler.papers.compared import Compared, joined
from modeler.papers.derived import Derived
from modeler.papers.naming import difference_of, renamer
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import Amount, Monomial, QuotationError, Sum, read_sum, sum_text
from modeler.symbolic.angles import cos_sin
from modeler.symbolic.geometry import Row

ELEMENTS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""Parameters of a link in the order of its row of functions."""


def rotation_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`sin theta2 qd1; cos theta2 qd1; qd2`: a link's angular velocity, in its own frame.

    The link is the last of `gives`, reached from a base at rest over the rows before it; their
    angles are theta1, theta2, ..., their speeds qd1, qd2, ...; component 1 is called `in1`.
    """
    found = [sum_of(part) for part in _rotation(robots[line.robot], line.gives)]
    rename = renamer(paper, line)
    printed = {str(k + 1): read_sum(x, rename) for k, x in enumerate(line.text.split(";"))}
    derived = {str(k + 1): part for k, part in enumerate(found)}
    text = "; ".join(sum_text(part) for part in found)
    return Compared(joined(printed), joined(derived), text, difference_of(line))


def element_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`h3^1 = (cos theta2 qd1)^2`: an element (1 to 6) of the row of the last link of `gives`."""
    left, _, right = line.text.partition("=")
    place = re.fullmatch(r"h(\d)\^([1-6])", left.strip())
    if place is None or int(place.group(1)) != len(line.gives):
        raise QuotationError(f"got {left.strip()}; expected 1 to 6 of link {len(line.gives)}")
    derived = sum_of(_elements(robots[line.robot], line.gives)[int(place.group(2)) - 1])
    printed = read_sum(right, renamer(paper, line))
    return Compared(printed, derived, sum_text(derived), difference_of(line))


def column_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`alpha2 = [0 0 0 1 ...]^T`: which elements of a link give the first one of the next.

    The links are the last two of `gives`; entry 4 is called `in4`, their number `entries`.
    """
    cells = re.fullmatch(r"alpha(\d) = \[([\d ]*)\]\^T", line.text)
    if cells is None or int(cells[1]) != len(line.gives) - 1:
        raise QuotationError(f'"{line.text}" is no column of digits')
    numbers = [int(cell) for cell in cells[2].split()]
    before, after = (_elements(robots[line.robot], line.gives[:n]) for n in (-1, None))
    alike = [int(sympy.expand(part - after[0]) == 0) for part in before]
    alike += [0] * (len(ELEMENTS) - len(alike))
    told = f"[{' '.join(map(str, alike))}]^T"
    return Compared(_column(numbers), _column(alike), told, difference_of(line))


def _column(numbers: list[int]) -> Sum:
    found: dict[Monomial, Amount] = {(("entries", 1),): Amount(Fraction(len(numbers)))}
    for place, number in enumerate(numbers, 1):
        if number:
            found[((f"in{place}", 1),)] = Amount(Fraction(number))
    return found


def _elements(derived: Derived, rows: tuple[str, ...]) -> list[sympy.Expr]:
    """What the six inertias of the last link are multiplied with in its kinetic energy."""
    w = dict(zip(_W, _rotation(derived, rows), strict=True))
    return [sympy.expand(_ENERGY.diff(p).subs(w)) for p in _PARAMETERS[:6]]


def _rotation(derived: Derived, rows: tuple[str, ...]) -> list[sympy.Expr]:
    """w_j = R^T w_(j-1) + qd_j z_j from a base at rest; a slide adds nothing."""
    by_name = {row.joint.name: row for row in derived.model.geometry.rows}
    w = sympy.zeros(3, 1)
    for index, name in enumerate(rows, 1):
        row = by_name[name]
        moves = row.joint.angular
        w = turned(row, sympy.Symbol(f"theta{index}") if moves else row.theta).T * w
        w += sympy.Matrix([0, 0, sympy.Symbol(f"qd{index}") if moves else 0])
    return [sympy.expand(part) for part in w]


def _z(c: sympy.Expr, s: sympy.Expr) -> sympy.Matrix:
    return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _x(c: sympy.Expr, s: sympy.Expr) -> sympy.Matrix:
    return sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]])


def sum_of(expression: sympy.Expr) -> Sum:
    """An expression of symbols, sines and cosines as a sum."""
    found: dict[Monomial, Amount] = {}
    for term in sympy.Add.make_args(sympy.expand(expression)):
        number, rest = term.as_coeff_Mul()
        if number:
            powers = sorted((str(b), int(e)) for b, e in rest.as_powers_dict().items() if b != 1)
            found[tuple(powers)] = Amount(Fraction(int(number.p), int(number.q)))
    return found


def without_squared_sines(expression: sympy.Expr) -> sympy.Expr:
    """The normal form in which an expression that is zero for all angles is 0."""
    found = sympy.expand(expression)
    for sine in found.atoms(sympy.sin):
        s, square = sympy.Dummy(), 1 - sympy.cos(sine.args[0]) ** 2
        found = sympy.rem(found.subs(sine, s), s**2 - square, s).subs(s, sine)
    return sympy.expand(found)


def turned(row: Row, angle: sympy.Expr) -> sympy.Matrix:
    """Rotation Rz(gamma) Rx(alpha) Rz(angle) of a row, from its antecedent."""
    c, s = cos_sin(row.gamma)
    return _z(c, s) * _x(*cos_sin(row.alpha)) * _z(sympy.cos(angle), sympy.sin(angle))


def _vector(name: str) -> sympy.Matrix:
    return sympy.Matrix(sympy.symbols(f"{name}1:4"))


_PARAMETERS = sympy.symbols(" ".join(ELEMENTS))
_XX, _XY, _XZ, _YY, _YZ, _ZZ, *_MS, _M = _PARAMETERS
_W, _V, _G, _P = (_vector(name) for name in "wvgP")
_INERTIA = sympy.Matrix([[_XX, _XY, _XZ], [_XY, _YY, _YZ], [_XZ, _YZ, _ZZ]])
_ENERGY = sympy.expand(
    (_W.T * _INERTIA * _W)[0] / 2 + _M * _V.dot(_V) / 2 + sympy.Matrix(_MS).dot(_V.cross(_W))
)
_AXES = [_vector(name) for name in "sna"]
_HEIGHT = -sympy.expand(
    _G.dot(_M * _P + sum((m * axis for m, axis in zip(_MS, _AXES, strict=True)), sympy.zeros(3, 1)))
)


def energy_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """What a parameter of a link is multiplied with in its energy: `1/2 w1 w1`, `-^0g^T0sk`.

    E = w'Jw/2 + M v'v/2 + MS.(v x w), U = -g.(M P + A MS), A = [s n a]; J is symmetric, products
    of inertia come twice. `gives` are the parameters; `ek ... | ...` is a row of E, `uk` one of U.
    """
    energy = _HEIGHT if line.text.startswith("uk ") else _ENERGY
    found = {name: sum_of(energy.diff(sympy.Symbol(name))) for name in line.gives}
    text = re.sub(
        r"\^[0k]([A-Za-z])k?\^T ?\^?[0k]([A-Za-z])k?",
        lambda found: f"({' + '.join(f'{found[1]}{n} {found[2]}{n}' for n in '123')})",
        re.sub(r"^([eu]k |hs\^1 = )", "", line.text).replace(",s", ""),
    )
    rename = renamer(paper, line)
    cells = [read_sum(cell, rename) for cell in text.split("|")]
    if len(cells) != len(line.gives):
        raise QuotationError(f"{len(cells)} elements are quoted, {len(line.gives)} are derived")
    printed = dict(zip(line.gives, cells, strict=True))
    told = " | ".join(sum_text(part) for part in found.values())
    return Compared(joined(printed), joined(found), told, difference_of(line))


def speed_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`barsigmak qdk ^kak`: what a joint's own speed adds to `gives`, "angular" or "linear".

    Both kinds of joints are derived from R(q) and P(q); sigma is 0 where one turns and 1 where one
    slides, and what it adds is along z in frame k, so a sum in sigma is found from the two.
    """
    q = sympy.Symbol("q")
    found = []
    for theta, r in ((q, 0), (0, q)):
        turn = _z(sympy.cos(theta), sympy.sin(theta))
        spin = turn.T * turn.diff(q)
        slide = turn.T * sympy.Matrix([0, 0, r]).diff(q)
        found.append(sympy.simplify(spin[1, 0] if line.gives[0] == "angular" else slide[2]))
    sigma, speed = sympy.symbols("sigmak qdk")
    derived = sum_of((found[0] + (found[1] - found[0]) * sigma) * speed * sympy.Symbol("ak"))
    text = line.text.replace("^kak", "ak").replace("barsigmak", "(1 - sigmak)")
    printed = read_sum(text, renamer(paper, line))
    return Compared(printed, derived, sum_text(derived), difference_of(line))


def effort_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`^0Jp^T ^0J1^T DL1`: `gives[2]`, forces at `gives[0]`, as forces at `gives[1]`.

    Places are "motors", with speeds Jp^-1 V, "leg", Ji^-1 V, and "platform", V. Equal power,
    F'A^-1 V = G'B^-1 V for all V, makes G = B' A'^-1 F: from a leg to the motors Jp' Ji'^-1.
    """
    here, there, what = line.gives
    names = {"motors": "Jp", "leg": f"J{what[-1]}"}
    wanted = [names[there]] if there in names else []
    wanted += [f"{names[here]}inv"] if here in names else []
    given = re.findall(r"\^0(J\w)\^T", line.text)
    rest = re.sub(r"\^0J\w\^T|sum_i|\^0|[\[\]( =]", "", line.text)
    printed, derived = (
        {tuple((name, 1) for name in sorted(chain)): Amount(Fraction(1))}
        for chain in ([*given, rest], [*wanted, what])
    )
    shown = " ".join(f"{name.removesuffix('inv')}^{'-' * name.endswith('inv')}T" for name in wanted)
    return Compared(printed, derived, f"{shown} {what}", difference_of(line))
