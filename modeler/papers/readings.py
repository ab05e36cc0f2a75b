"""How the statements of a paper are read and compared: one function for each kind."""

import enum
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
import sympy

from modeler.core.errors import RobotError
from modeler.core.expression import ExpressionError
from modeler.derivation import GeometryRow, compute_base_poses, compute_pose, compute_poses
from modeler.papers.paper import (
    DerivedRobot,
    LineComparison,
    Paper,
    PrintedLine,
    Reading,
    Robots,
    build_expression,
    build_renamer,
    collect_quantities,
    compare_line,
    eliminate_squared_sines,
    evaluate_expression,
    expand_to_sum,
    join_in_order,
    join_numbers,
    join_sums,
)
from modeler.papers.quotation import (
    Amount,
    Monomial,
    QuotationError,
    Sum,
    add_sums,
    format_sum,
    read_numbers,
    read_sum,
    replace_names,
    separate_sides,
)
from modeler.papers.wrist import WRIST_READINGS, collect_coefficient_quotations

_LEGS = "123456"
_ONE = Amount(Fraction(1))

ELEMENTS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""Parameters of a link in the order of its row of functions."""


def _compare_relation(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`ZZ2Ri = ZZ2i + ...`: a base parameter, or a combination of them, as a sum."""
    robot, leg = robots[line.robot], line.legs[0]
    left, right = separate_sides(line.text)
    rename = build_renamer(paper, line, leg)
    puts = _read_assumptions(paper, line)
    printed = read_sum(right, rename, _LEGS[:3])
    if line.relation_robot:
        printed = replace_names(printed, _expand_leg_relations(robots[line.relation_robot], robot))
    target = rename(left)
    left_name, _, combination = line.substitution.partition(" = ")
    wanted = read_sum(combination if left_name == target else target, str)
    lost = {name for m in wanted for name, _ in m} - set(robot.relations) - set(robot.standard)
    if lost - set(robot.values) or (left_name != target and target not in robot.relations):
        return LineComparison(printed, {}, f"{target} is no base parameter")
    derived = replace_names(wanted, robot.relations)
    return LineComparison(
        replace_names(printed, puts),
        replace_names(derived, puts),
        f"{target} = {format_sum(derived)}",
        robot.values,
    )


def _read_assumptions(paper: Paper, line: PrintedLine) -> dict[str, Sum]:
    """What the quotations of `given` put in for a name, for every leg."""
    puts: dict[str, Sum] = {}
    for text in line.assumptions:
        left, right = separate_sides(text)
        for leg in _LEGS:
            rename = build_renamer(paper, line, leg)
            puts[rename(left)] = read_sum(right, rename)
    return puts


def _expand_leg_relations(leg: DerivedRobot, whole: DerivedRobot) -> dict[str, Sum]:
    """Base parameters of an isolated leg, written for every leg of the robot."""
    common = leg.values.keys() & whole.values.keys()
    return {
        f"{name[:-1]}{index}R": {
            tuple(sorted((n if n in common else n + index, p) for n, p in m)): value
            for m, value in terms.items()
        }
        for index in _LEGS[:3]
        for name, terms in leg.relations.items()
        if name.endswith("R")
    }


def _compare_numbers(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """Every number of the quotation, in order, against an expression of `gives`."""
    numbers = read_numbers(line.text)
    if len(numbers) != len(line.expected):
        raise QuotationError(f"{len(numbers)} numbers are quoted, {len(line.expected)} are derived")
    known = collect_quantities(robots[line.robot])
    values = [Fraction(evaluate_expression(text, known)) for text in line.expected]
    text = ", ".join(str(value) for value in values)
    derived = join_numbers(Amount(value) for value in values)
    return LineComparison(join_numbers(numbers), derived, text)


def _compare_names(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """The names of the quotation, over all legs, against a set."""
    if any(number.value for number in read_numbers(line.text)):
        raise QuotationError(f'"{line.text}" is no list of names, nor of names that are 0')
    printed: dict[Monomial, Amount] = {}
    for leg in line.legs:
        rename = build_renamer(paper, line, leg)
        for name in re.findall(r"\b(?!and\b)[A-Za-z][A-Za-z0-9]*", line.text):
            printed[((rename(name), 1),)] = _ONE
    names = evaluate_expression(line.expected[0], collect_quantities(robots[line.robot]))
    derived: Sum = {((name, 1),): _ONE for name in sorted(names)}
    return LineComparison(printed, derived, ", ".join(sorted(names)))


def _compare_arithmetic(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """Numbers of the quotation, called a, b, c, ..., that follow from each other.

    Each entry of `gives` is `c = 100*b/abs(a)`, to half a unit of the last digit of c, or a
    comparison that must hold.
    """
    text = "; ".join((line.text, *line.assumptions))
    numbers = {chr(ord("a") + i): n for i, n in enumerate(read_numbers(text))}
    floats: dict[str, Any] = {name: float(number.value) for name, number in numbers.items()}
    known = collect_quantities(robots[line.robot])
    printed: dict[Monomial, Amount] = {}
    derived: dict[Monomial, Amount] = {}
    texts = []
    for entry in line.expected:
        letter, equal, formula = entry.partition(" = ")
        if equal:
            number = numbers.get(letter)
            if number is None:
                raise QuotationError(f"the quotation has no number {letter}")
            value = Fraction(evaluate_expression(formula, known | floats))
            half = number.half or Fraction(1, 2)
            for name, other in numbers.items():  # how far the rounding of each may move it
                moved = known | floats | {name: float(other.value + other.half)}
                half += abs(Fraction(evaluate_expression(formula, moved)) - value)
            printed[((letter, 1),)] = Amount(number.value, half)
            derived[((letter, 1),)] = Amount(value)
            texts.append(f"{letter} = {float(value):.4g}")
        else:
            holds = evaluate_expression(entry, known | floats)
            printed[((entry, 1),)] = _ONE
            derived = derived | ({((entry, 1),): _ONE} if holds else {})
            texts.append(f"{entry}: {'yes' if holds else 'no'}")
    weak = any(re.search("[<>]", entry) for entry in line.expected)
    return LineComparison(printed, derived, ", ".join(texts), is_inequality=weak)


def _compare_rotation(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`sin theta2 qd1; cos theta2 qd1; qd2`: a link's angular velocity, in its own frame.

    The link is the last of `gives`, reached from a base at rest over the rows before it; their
    angles are theta1, theta2, ..., their speeds qd1, qd2, ...; component 1 is called `in1`.
    """
    components = [
        expand_to_sum(part) for part in _compute_rotation(robots[line.robot], line.expected)
    ]
    rename = build_renamer(paper, line)
    printed = join_in_order(read_sum(part, rename) for part in line.text.split(";"))
    text = "; ".join(format_sum(part) for part in components)
    return LineComparison(printed, join_in_order(components), text)


def _compare_element(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`h3^1 = (cos theta2 qd1)^2`: an element (1 to 6) of the row of the last link of `gives`."""
    left, _, right = line.text.partition("=")
    place = re.fullmatch(r"h(\d)\^([1-6])", left.strip())
    if place is None or int(place.group(1)) != len(line.expected):
        raise QuotationError(f"got {left.strip()}; expected 1 to 6 of link {len(line.expected)}")
    elements = _compute_elements(robots[line.robot], line.expected)
    derived = expand_to_sum(elements[int(place.group(2)) - 1])
    printed = read_sum(right, build_renamer(paper, line))
    return LineComparison(printed, derived, format_sum(derived))


def _compare_column(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`alpha2 = [0 0 0 1 ...]^T`: which elements of a link give the first one of the next.

    The links are the last two of `gives`; entry 4 is called `in4`, their number `entries`.
    """
    cells = re.fullmatch(r"alpha(\d) = \[([\d ]*)\]\^T", line.text)
    if cells is None or int(cells[1]) != len(line.expected) - 1:
        raise QuotationError(f'"{line.text}" is no column of digits')
    numbers = [int(cell) for cell in cells[2].split()]
    before, after = (_compute_elements(robots[line.robot], line.expected[:n]) for n in (-1, None))
    alike = [int(sympy.expand(part - after[0]) == 0) for part in before]
    alike += [0] * (len(ELEMENTS) - len(alike))
    column_text = f"[{' '.join(map(str, alike))}]^T"
    return LineComparison(_build_column_sum(numbers), _build_column_sum(alike), column_text)


def _build_column_sum(numbers: list[int]) -> Sum:
    return add_sums(join_numbers(numbers), {(("entries", 1),): Amount(Fraction(len(numbers)))})


def _compute_elements(derived: DerivedRobot, rows: tuple[str, ...]) -> list[sympy.Expr]:
    """What the six inertias of the last link are multiplied with in its kinetic energy."""
    w = dict(zip(_W, _compute_rotation(derived, rows), strict=True))
    return [sympy.expand(_ENERGY.diff(p).subs(w)) for p in _PARAMETERS[:6]]


def _compute_rotation(derived: DerivedRobot, rows: tuple[str, ...]) -> list[sympy.Expr]:
    """w_j = R^T w_(j-1) + qd_j z_j from a base at rest; a slide adds nothing."""
    by_name = {row.joint.name: row for row in derived.model.geometry.rows}
    w = [sympy.Integer(0)] * 3
    for index, name in enumerate(rows, 1):
        row = by_name[name]
        moved = {name: sympy.Symbol(f"theta{index}") - row.theta} if row.joint.is_revolute else {}
        w = compute_pose(row, _SympyAlgebra(moved)).rotate_to_link(w)
        w[2] += sympy.Symbol(f"qd{index}") * len(moved)
    return [sympy.expand(part) for part in w]


@dataclass(frozen=True)
class _SympyAlgebra:
    """Algebra of the recursions over sympy: rows at these values of rate * q, 0 without one."""

    values: Mapping[str, sympy.Expr]

    def static(self, value: sympy.Expr) -> sympy.Expr:
        return value

    def variable(self, row: GeometryRow) -> sympy.Expr:
        return row.r + self.values.get(row.joint.name, 0)

    def cos_sin(self, row: GeometryRow) -> tuple[sympy.Expr, sympy.Expr]:
        angle = row.theta + int(row.joint.is_revolute) * self.values.get(row.joint.name, 0)
        return sympy.cos(angle), sympy.sin(angle)


def _build_vector(name: str) -> sympy.Matrix:
    return sympy.Matrix(sympy.symbols(f"{name}1:4"))


_PARAMETERS = sympy.symbols(" ".join(ELEMENTS))
_XX, _XY, _XZ, _YY, _YZ, _ZZ, *_MS, _M = _PARAMETERS
_W, _V, _G, _P, _R, _S = (_build_vector(name) for name in "wvgPrS")
_AXES = sympy.Matrix.hstack(*(_build_vector(name) for name in "sna"))
_INERTIA = sympy.Matrix([[_XX, _XY, _XZ], [_XY, _YY, _YZ], [_XZ, _YZ, _ZZ]])
_MOMENTS = {(0, 0, 0): _M, (1, 0, 0): _MS[0], (0, 1, 0): _MS[1], (0, 0, 1): _MS[2]}
_MOMENTS |= {(1, 1, 0): -_XY, (1, 0, 1): -_XZ, (0, 1, 1): -_YZ}
_MOMENTS |= {(2, 0, 0): _YY + _ZZ - _XX, (0, 2, 0): _XX + _ZZ - _YY, (0, 0, 2): _XX + _YY - _ZZ}


def _integrate_over_mass(density: sympy.Expr) -> sympy.Expr:
    """Over the masses of a body at r in its frame: J is int |r|^2 - r r' dm, MS int r dm."""
    integral = sympy.Integer(0)
    for powers, factor in sympy.Poly(sympy.expand(density), *_R).terms():
        integral += factor * _MOMENTS[powers] / (2 if 2 in powers else 1)
    return sympy.expand(integral)


_SPEED = _V + _W.cross(_R)
_ENERGY = _integrate_over_mass(_SPEED.dot(_SPEED) / 2)
_HEIGHT = -_integrate_over_mass(_G.dot(_P + _AXES * _R))


def _evaluate_text(text: str, names: Mapping[str, Any]) -> Any:
    """The value of `omegak^T Jk omegak + ...`: letters by `names`, side by side or with x."""
    known: dict[str, Any] = {"cross": lambda a, b: a.cross(b)}
    for k, word in enumerate(sorted(names, key=len, reverse=True)):
        text, known[f"n{k}"] = text.replace(word, f" n{k} "), names[word]
    text = re.sub(r"(n\d+) +x +(n\d+)", r"cross(\1, \2)", text.translate({91: "(", 93: ")"}))
    text = re.sub(r"(?<=[\w)])\s+(?=[\w(])", "*", text.strip())
    try:
        return evaluate_expression(text, known)
    except (SyntaxError, TypeError, ValueError) as error:  # of shapes that do not fit, too
        raise QuotationError(f'"{text}" cannot be read: {error}') from error


def _compare_body(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`1/2 [omegak^T Jk omegak + ...]`: `gives` "E" or "U" of a body, from those of its masses."""
    height = _HEIGHT.subs(dict(zip(_MS, _M * _S, strict=True)))
    derived_form = {"E": _ENERGY, "U": height}[line.expected[0]]
    names = {"omegak^T": _W.T, "omegak": _W, "Jk": _INERTIA, "Mk": _M, "Vk^T": _V.T, "Vk": _V}
    names |= {"MSk^T": sympy.Matrix(_MS).T, "^0g^T": _G.T, "^0Pk": _P, "^0Ak": _AXES, "^kSk": _S}
    both = (_evaluate_text(line.text, names)[0], derived_form)
    printed, derived = (expand_to_sum(sympy.expand(x)) for x in both)
    return LineComparison(printed, derived, format_sum(derived))


def _compare_recursion(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`^kRk-1 ^k-1omegak-1 + barsigmak qdk ^kak`: "angular" or "linear" velocity of link k.

    Of T_k = T_k-1 A(q) comes T_k^-1 T_k' = A^-1 (T_k-1^-1 T_k-1') A + A^-1 A'; sigma is 0 where q
    turns and 1 where it slides, and what is linear in sigma is found from the two.
    """
    qd, sigma, alpha, d, theta, r = sympy.symbols("qd sigma alpha d theta r")
    R = sympy.rot_axis1(-alpha) * sympy.rot_axis3(-theta)
    P, last = sympy.Matrix([d, 0, 0]) + R[:, 2] * r, sympy.Matrix([[0, 0, 0, 1]])
    A, back = R.row_join(P).col_join(last), R.T.row_join(-R.T * P).col_join(last)
    before = _W.hat().row_join(_V).col_join(0 * last)
    turned, slid = (back * (before * A + A.diff(moved) * qd) for moved in (theta, r))
    twist = turned + (slid - turned) * sigma
    velocities = {"angular": [twist[2, 1], twist[0, 2], twist[1, 0]], "linear": [*twist[:3, 3]]}
    names = {"^kRk-1": R.T, "^k-1omegak-1": _W, "^komegak-1": R.T * _W, "^k-1Vk-1": _V}
    names |= {"^k-1Pk": P, "barsigmak": 1 - sigma, "sigmak": sigma, "qdk": qd}
    names["^kak"] = sympy.Matrix([0, 0, 1])
    printed, derived = (
        join_in_order(expand_to_sum(eliminate_squared_sines(x)) for x in v)
        for v in (_evaluate_text(line.text, names), velocities[line.expected[0]])
    )
    return LineComparison(printed, derived, "A^-1 twist A + A^-1 A' of frames k-1 and k")


def _compare_energy(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """What a parameter of a link is multiplied with in its energy: `1/2 w1 w1`, `-^0g^T0sk`.

    E = w'Jw/2 + M v'v/2 + MS.(v x w), U = -g.(M P + A MS), A = [s n a]; J is symmetric, products
    of inertia come twice. `gives` are the parameters; `ek ... | ...` is a row of E, `uk` one of U.
    """
    energy = _HEIGHT if line.text.startswith("uk ") else _ENERGY
    energy_terms = {name: expand_to_sum(energy.diff(sympy.Symbol(name))) for name in line.expected}
    text = re.sub(
        r"\^[0k]([A-Za-z])k?\^T ?\^?[0k]([A-Za-z])k?",
        lambda energy_terms: (
            f"({' + '.join(f'{energy_terms[1]}{n} {energy_terms[2]}{n}' for n in '123')})"
        ),
        re.sub(r"^([eu]k |hs\^1 = )", "", line.text).replace(",s", ""),
    )
    rename = build_renamer(paper, line)
    cells = [read_sum(cell, rename) for cell in text.split("|")]
    if len(cells) != len(line.expected):
        raise QuotationError(f"{len(cells)} elements are quoted, {len(line.expected)} are derived")
    printed = dict(zip(line.expected, cells, strict=True))
    derived_text = " | ".join(format_sum(part) for part in energy_terms.values())
    return LineComparison(join_sums(printed), join_sums(energy_terms), derived_text)


def _compare_effort(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`^0Jp^T ^0J1^T DL1`: `gives[2]`, forces at `gives[0]`, as forces at `gives[1]`.

    Places are "motors", with speeds Jp^-1 V, "leg", Ji^-1 V, and "platform", V. Equal power,
    F'A^-1 V = G'B^-1 V for all V, makes G = B' A'^-1 F: from a leg to the motors Jp' Ji'^-1.
    """
    here, there, what = line.expected
    names = {"motors": "Jp", "leg": f"J{what[-1]}"}
    wanted = [names[there]] if there in names else []
    wanted += [f"{names[here]}inv"] if here in names else []
    jacobians = re.findall(r"\^0(J\w)\^T", line.text)
    rest = re.sub(r"\^0J\w\^T|sum_i|\^0|[\[\]( =]", "", line.text)
    printed, derived = (
        {tuple((name, 1) for name in sorted(chain)): Amount(Fraction(1))}
        for chain in ([*jacobians, rest], [*wanted, what])
    )
    shown = " ".join(f"{name.removesuffix('inv')}^{'-' * name.endswith('inv')}T" for name in wanted)
    return LineComparison(printed, derived, f"{shown} {what}")


def _compare_digits(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`12`: digits that agree, 12 or more, of a form, "energy" or "kane", and the derivation."""
    off = robots[line.robot].forms[line.expected[0]][1]
    digits = join_numbers([min(12, int(-np.log10(off + 1e-16)))])
    printed = join_numbers(read_numbers(line.text))
    return LineComparison(printed, digits, f"{off:.0e} of the largest")


_COLUMNS = ("j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r")


def _compare_row(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """A row of the table, cells between bars, against the robot's; cell r is called `inr`."""
    leg = line.legs[0]
    cells = [cell.strip() for cell in line.text.split("|")]
    if len(cells) != len(_COLUMNS):
        raise QuotationError(f"{len(cells)} cells are quoted, a row has {len(_COLUMNS)}")
    cells[:2] = [cell.replace("i", leg) for cell in cells[:2]]
    rename = build_renamer(paper, line, leg)
    printed = join_sums({c: read_sum(x, rename) for c, x in zip(_COLUMNS, cells, strict=True)})
    joint = next((j for j in robots[line.robot].robot.joints if j.name == cells[0]), None)
    if joint is None:
        raise QuotationError(f"there is no row {cells[0]}")
    cells = [joint.name, joint.antecedent, str(int(joint.actuated)), str(int(joint.kind))]
    cells += [getattr(joint, column).text for column in _COLUMNS[4:]]
    row_sums = {c: read_sum(text, str) for c, text in zip(_COLUMNS, cells, strict=True)}
    text = " | ".join(format_sum(part) for part in row_sums.values())
    return LineComparison(printed, join_sums(row_sums), text)


def _compare_tied(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`q4i = -q3i, q7i = q3i`: joints that follow others; `of` is a cut joint, which has no row."""
    rename = build_renamer(paper, line, line.legs[0])
    printed: dict[str, Sum] = {}
    pairs = r"(\w+) (\w+) \+ (\w+) (\w+)"  # (a, b) + (c, d) = 0
    for equation in re.sub(pairs, r"\3 = -\1, \4 = -\2", line.text).split(","):
        left, right = separate_sides(equation)
        name = rename(left)
        if name in printed:
            raise QuotationError(f"{name} is given twice")
        printed[name] = read_sum(right, rename)
    tied = dict(robots[line.robot].dependent_variables)
    if line.substitution:
        left, _, right = line.substitution.partition("=")
        tied[rename(left.strip())] = replace_names(read_sum(right, rename), tied)
    lost = set(printed) - set(tied)
    if lost:
        raise QuotationError(f"there is no joint variable {', '.join(sorted(lost))}")
    derived: dict[str, Sum] = {name: tied[name] for name in printed}
    text = ", ".join(f"{name} = {format_sum(part)}" for name, part in derived.items())
    return LineComparison(join_sums(printed), join_sums(derived), text)


def _compare_closure(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """The place of frame `gives[0]`, where a leg meets the platform, derived from the table.

    `d4 cos q2i cos q3i + a deltai; ...; ...`: along the axes of the leg's first frame, with deltai
    1 for leg 3 and 0 for the others, bardelta 1 - delta, legs counted in a circle. Without `;`:
    for each leg an expression in x, y, z that is 0 at that place, `|` between them.
    """
    printed: dict[str, Sum] = {}
    derived: dict[str, Sum] = {}
    texts = line.text.split("|") if "|" in line.text else [line.text] * len(line.legs)
    if len(texts) != len(line.legs):
        raise QuotationError(f"{len(texts)} expressions are quoted for {len(line.legs)} legs")
    for leg, text in zip(line.legs, texts, strict=True):
        rename = build_renamer(paper, line, leg)
        text = _replace_deltas(text, int(leg))
        frame = line.expected[0].replace("{i}", leg)
        turn, place = _compute_place(robots[line.robot], frame, f"1{leg}")
        if ";" in text:
            printed |= {f"{leg}x{k}": read_sum(x, rename) for k, x in enumerate(text.split(";"))}
            along = enumerate(turn.T * place)
            derived |= {f"{leg}x{k}": expand_to_sum(eliminate_squared_sines(x)) for k, x in along}
        else:
            put = {symbol.name: symbol for symbol in place.free_symbols}
            put |= dict(zip("xyz", place, strict=True))
            left = build_expression(read_sum(text, rename), put)
            printed[leg] = expand_to_sum(eliminate_squared_sines(left))
    derived_text = "; ".join(format_sum(part) for part in (derived or printed).values())
    return LineComparison(join_sums(printed), join_sums(derived), derived_text)


def _replace_deltas(text: str, leg: int) -> str:
    def replace_delta(match: re.Match[str]) -> str:
        third = (leg + int(match[2] or 0)) % 3 == 0
        return str(int(third != bool(match[1])))

    return re.sub(r"(bar)?deltai(?:\+(\d))?", replace_delta, text)


def _compute_place(
    derived: DerivedRobot, name: str, first: str
) -> tuple[sympy.Matrix, sympy.Matrix]:
    """(rotation of the row `first`, place of the origin of the row `name`), both in frame 0."""
    geometry = derived.model.geometry
    free = [sympy.Symbol(joint.variable) for joint in geometry.robot.free_joints]
    moving = [row for row in geometry.rows if row.index is not None]
    moved = _SympyAlgebra(
        {
            row.joint.name: row.rate * sum(sympy.Rational(v) * free[u] for u, v in form.items())
            for row, form in zip(moving, geometry.forms, strict=True)
        }
    )
    frame_poses = compute_base_poses(geometry, compute_poses(geometry, moved), moved)
    places = {row.joint.name: place for row, place in zip(geometry.rows, frame_poses, strict=True)}
    return sympy.Matrix(places[first][0]).T, sympy.Matrix(places[name][1])


def _compare_platform(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """`phip = diag(ddotx, ...)`: what the platform's mass is multiplied with, its force.

    Newton: m (acceleration - gravity), a column; entry 2 of a column is `in2`, entry (2, 2) of a
    matrix `in2x2`.
    """
    match = re.fullmatch(r"phip = (diag)?\((.*)\)", line.text)
    if match is None:
        raise QuotationError(f'"{line.text}" is no list of forces')
    cells = [read_sum(cell, str) for cell in match[2].split(",")]
    printed = join_sums({f"{k}x{k}" if match[1] else str(k): c for k, c in enumerate(cells, 1)})
    force = [
        expand_to_sum(sympy.Symbol(f"ddot{axis}") - part)
        for axis, part in zip("xyz", robots[line.robot].model.geometry.gravity, strict=True)
    ]
    text = f"the column ({', '.join(format_sum(part) for part in force)})"
    return LineComparison(printed, join_in_order(force), text)


def _compare_matrix(paper: Paper, line: PrintedLine, robots: Robots) -> LineComparison:
    """Rows of G^T, `1 0 0; 0 1 -1`: G = d(all joints of `gives[1]`) / d(those of `gives[0]`)."""
    tied = robots[line.robot].dependent_variables
    above, below = line.expected[1].split(), line.expected[0].split()
    derived = [[_find_slope(tied[name], by) for name in above] for by in below]
    printed = [[read_sum(cell, str) for cell in row.split()] for row in line.text.split(";")]
    text = "; ".join(" ".join(map(format_sum, row)) for row in derived)
    return LineComparison(_join_entries(printed), _join_entries(derived), text)


def _join_entries(rows: list[list[Sum]]) -> Sum:
    return join_sums({f"{i}x{j}": cell for i, row in enumerate(rows) for j, cell in enumerate(row)})


def _find_slope(whole: Sum, name: str) -> Sum:
    key = ((name, 1),)
    return {(): whole[key]} if key in whole else {}


_COMPARED: tuple[Any, ...] = (
    *(_compare_relation, _compare_numbers, _compare_names, _compare_arithmetic, _compare_row),
    *(_compare_tied, _compare_rotation, _compare_element, _compare_column, _compare_energy),
    *(_compare_body, _compare_recursion, _compare_digits, _compare_effort, _compare_closure),
    _compare_platform,
)
READINGS: Mapping[str, Reading] = {
    **{compare.__name__.removeprefix("_compare_"): compare for compare in _COMPARED},
    **{"rows": _compare_matrix},
    **WRIST_READINGS,
}


# Derived against printed, line by line.


class LineVerdict(enum.Enum):
    """How a line stands to what is derived."""

    EQUAL = "printed and equal"
    ROUNDED = "printed and equal to the printed digits"
    MISPRINT = "printed and different"
    CONSISTENT = "printed and consistent, no equality"
    MEASURED = "printed, measured: nothing derives it"
    OURS = "our consequence, not printed"
    UNCHECKED = "not checked"
    DIFFERENT = "DIFFERENT"


@dataclass(frozen=True)
class CheckedLine:
    """One statement and its verdict.

    Attributes:
        robot: that it is about.
        place: in the paper.
        printed_text: the quotation, or our consequence.
        derived_text: what is derived.
        verdict: how they stand to each other.
        slip: one of `modeler.papers.paper.SLIPS` where the print is known to differ, or "".
        reason: reason of a difference, or a remark.
        correction: how it should read, which holds; "" if nothing is stated.
    """

    robot: str
    place: str
    printed_text: str
    derived_text: str
    verdict: LineVerdict
    slip: str
    reason: str
    correction: str = ""


def check_paper(paper: Paper, derived: Robots) -> list[CheckedLine]:
    """Returns all lines with their verdicts.

    Args:
        paper: as read.
        derived: its robots, by name.
    """
    lines = [*paper.lines, *collect_coefficient_quotations(paper, derived)]
    checked = [check_line(paper, one, derived) for line in lines for one in expand_legs(line)]
    return checked + [
        CheckedLine("", place, "", "", LineVerdict.UNCHECKED, "", why)
        for place, why in paper.unchecked.items()
    ]


def expand_legs(line: PrintedLine) -> list[PrintedLine]:
    """Returns one line for each leg, except for statements about all legs together."""
    together = line.check in ("names", "closure")
    return [line] if together else [replace(line, legs=(leg,)) for leg in line.legs]


def check_line(paper: Paper, line: PrintedLine, derived: Robots) -> CheckedLine:
    """Checks one line of one leg."""
    try:
        if line.checksum and compute_checksum(line) != line.checksum:
            raise QuotationError("the numbers are not those that were read from the paper")
        comparison = READINGS[line.check](paper, line, derived)
        equal, exact = compare_line(comparison, line)
        if equal and line.correction:
            right = replace(line, quote=line.correction, difference="")
            if not compare_line(READINGS[line.check](paper, right, derived), right)[0]:
                raise QuotationError(f"the corrected form does not hold: {line.correction}")
    except (QuotationError, ExpressionError, RobotError) as error:
        return _build_checked_line(line, str(error), LineVerdict.DIFFERENT)
    verdict = _classify_line(line, equal, exact, comparison.is_inequality)
    return _build_checked_line(line, comparison.text, verdict)


def _classify_line(line: PrintedLine, equal: bool, exact: bool, weak: bool) -> LineVerdict:
    if not equal:
        return LineVerdict.DIFFERENT
    if line.consequence:
        return LineVerdict.OURS
    if line.slip:
        return LineVerdict.MISPRINT
    if line.is_measured:
        return LineVerdict.MEASURED
    if weak:
        return LineVerdict.CONSISTENT
    return LineVerdict.EQUAL if exact else LineVerdict.ROUNDED


def _build_checked_line(line: PrintedLine, derived: str, verdict: LineVerdict) -> CheckedLine:
    leg = line.legs[0] if len(line.legs) == 1 else ""
    place = line.place + (f", i = {leg}" if leg else "")
    printed = "; ".join((line.text, *line.assumptions))
    return CheckedLine(
        line.robot, place, printed, derived, verdict, line.slip, line.reason, line.correction
    )


def compute_checksum(line: PrintedLine) -> str:
    """Returns the checksum of the quotation without spaces."""
    text = "".join("".join((line.quote, *line.assumptions)).split())
    return f"{zlib.crc32(text.encode()):08x}"
