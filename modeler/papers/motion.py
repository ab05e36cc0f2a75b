"""Angular velocities and the energy's row of functions, as a paper prints them."""

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

_HALF, _ONE = Amount(Fraction(1, 2)), Amount(Fraction(1))
_INERTIA = {"XX": (1, 1), "XY": (1, 2), "XZ": (1, 3), "YY": (2, 2), "YZ": (2, 3), "ZZ": (3, 3)}
_MOMENT = {"MX": (2, 3), "MY": (3, 1), "MZ": (1, 2)}


def rotation_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`sin theta2 qd1; cos theta2 qd1; qd2`: a link's angular velocity, in its own frame.

    The link is the last of `gives`, reached from a base at rest over the rows before it; their
    angles are theta1, theta2, ..., their speeds qd1, qd2, ...; component 1 is called `in1`.
    """
    found = _rotation(robots[line.robot], line.gives)
    rename = renamer(paper, line)
    printed = {str(k + 1): read_sum(x, rename) for k, x in enumerate(line.text.split(";"))}
    derived = {str(k + 1): part for k, part in enumerate(found)}
    text = "; ".join(sum_text(part) for part in found)
    return Compared(joined(printed), joined(derived), text, difference_of(line))


def square_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """`h3^1 = (cos theta2 qd1)^2`: element 1 (XX), 4 (YY) or 6 (ZZ) of the last link of `gives`.

    The element of the rotational energy without its factor 1/2: the square of w1, w2 or w3.
    """
    left, _, right = line.text.partition("=")
    place = re.fullmatch(r"h(\d)\^([146])", left.strip())
    if place is None or int(place.group(1)) != len(line.gives):
        raise QuotationError(f"got {left.strip()}; expected XX, YY or ZZ of link {len(line.gives)}")
    component = {"1": 0, "4": 1, "6": 2}[place.group(2)]
    part = _rotation(robots[line.robot], line.gives)[component]
    printed = read_sum(right, renamer(paper, line))
    derived = read_sum(f"({sum_text(part)})^2", str)
    return Compared(printed, derived, sum_text(derived), difference_of(line))


def _rotation(derived: Derived, rows: tuple[str, ...]) -> list[Sum]:
    """w_j = R^T w_(j-1) + qd_j z_j from a base at rest; a slide adds nothing."""
    by_name = {row.joint.name: row for row in derived.model.geometry.rows}
    w = sympy.zeros(3, 1)
    for index, name in enumerate(rows, 1):
        row = by_name[name]
        for angle, turn in ((row.gamma, _z), (row.alpha, _x)):
            w = turn(*cos_sin(angle)).T * w
        if row.joint.angular:
            theta = sympy.Symbol(f"theta{index}")
            w = _z(sympy.cos(theta), sympy.sin(theta)).T * w
            w += sympy.Matrix([0, 0, sympy.Symbol(f"qd{index}")])
        else:
            w = _z(*cos_sin(row.theta)).T * w
    return [_sum_of(sympy.expand(part)) for part in w]


def _z(c: sympy.Expr, s: sympy.Expr) -> sympy.Matrix:
    return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _x(c: sympy.Expr, s: sympy.Expr) -> sympy.Matrix:
    return sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]])


def _sum_of(expression: sympy.Expr) -> Sum:
    found: dict[Monomial, Amount] = {}
    for term in sympy.Add.make_args(expression):
        number, rest = term.as_coeff_Mul()
        if number:
            powers = sorted((str(b), int(e)) for b, e in rest.as_powers_dict().items() if b != 1)
            found[tuple(powers)] = Amount(Fraction(int(number.p), int(number.q)))
    return found


def energy_reading(paper: Paper, line: PrintedLine, robots: Mapping[str, Derived]) -> Compared:
    """A link's kinetic energy for one parameter, `1/2 w1 w1`.

    E = w'Jw/2 + M v'v/2 + MS.(v x w), J symmetric: products of inertia come twice.
    """
    parameter = line.gives[0]
    derived: dict[Monomial, Amount] = {}
    if parameter in _INERTIA:
        a, b = _INERTIA[parameter]
        key = (((f"w{a}", 2),) if a == b else ((f"w{a}", 1), (f"w{b}", 1)))  # fmt: skip
        derived[key] = _HALF if a == b else _ONE
    elif parameter in _MOMENT:
        a, b = _MOMENT[parameter]
        derived[((f"v{a}", 1), (f"w{b}", 1))] = _ONE
        derived[((f"v{b}", 1), (f"w{a}", 1))] = -_ONE
    else:
        derived |= {((f"v{k}", 2),): _HALF for k in (1, 2, 3)}
    printed = read_sum(line.text, renamer(paper, line))
    return Compared(printed, derived, sum_text(derived), difference_of(line))
