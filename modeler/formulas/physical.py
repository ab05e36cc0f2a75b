"""Standard parameters as polynomials of masses, mass centres and inertias about them."""

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import sympy
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.core.errors import RobotError
from modeler.core.expression import Expression, ExpressionError, parse_expression
from modeler.derivation import LinkColumn, SymbolicModel, evaluate_modulo, is_in_block
from modeler.effects import EnergyBlock
from modeler.formulas.ring import (
    Poly,
    TrigRing,
    convert_to_polynomial,
    find_independent_modulo,
    get_generators,
)
from modeler.formulas.thresholds import THRESHOLDS
from modeler.robot import Joint, PhysicalLink, Robot

_GENERIC = ("m", "cx", "cy", "cz", "Ixx", "Ixy", "Ixz", "Iyy", "Iyz", "Izz")
_DIAGONAL = (0, 3, 5)  # of XX XY XZ YY YZ ZZ


@dataclass(frozen=True)
class PhysicalParameters:
    """What a workshop would measure.

    Attributes:
        ring: letters of the links, then the generators of the geometry.
        letters: names of the physical parameters in order: per link mass, mass centre, inertia
            about the mass centre, rotor inertia; then lengths and angles, gravity left out.
        masses: those letters that stand alone as the mass of a link.
        moments: those that stand alone as a moment of inertia of a link or a rotor.
        standard: {column: the standard parameter as a polynomial}.
        kinds: {letter: "mass", "centre", "inertia", "rotor inertia" or "length"}.
    """

    ring: PolyRing
    letters: tuple[str, ...]
    masses: tuple[str, ...]
    moments: tuple[str, ...]
    standard: Mapping[int, Poly]
    kinds: Mapping[str, str]

    @property
    def names(self) -> tuple[str, ...]:
        """Returns names of all generators."""
        return tuple(str(symbol) for symbol in self.ring.symbols)

    def convert_form(self, form: Mapping[int, Poly]) -> Poly:
        """Returns a linear form of standard parameters in physical parameters."""
        total = self.ring.zero
        for column, factor in form.items():
            total = total + self.lift_polynomial(factor) * self.standard[column]
        return total

    def differentiate_polynomial(self, poly: Poly, letter: str) -> Poly:
        """Returns d poly / d letter; for an angle by its cosine and sine."""
        places = get_generators(self.ring)
        if letter in places:
            return poly.diff(places[letter])
        c, s = places[f"cos({letter})"], places[f"sin({letter})"]
        return c * poly.diff(s) - s * poly.diff(c)

    def lift_polynomial(self, factor: Poly) -> Poly:
        """Returns a polynomial of the geometry in this ring."""
        return factor.set_ring(self.ring)


def derive_physical_parameters(model: SymbolicModel, algebra: TrigRing) -> PhysicalParameters:
    """Derives the physical parameters of a robot: letters of `[physical]`, or m1, cx1, ...

    Huygens and Steiner: MS = m c, J = J_c + m (c.c 1 - c c').

    Raises:
        RobotError: an entry of `[physical]` is no polynomial, or uses the name of a joint's sine.
    """
    static = [str(symbol) for symbol in algebra.static_ring.symbols]
    bodies = {column.row for column in model.columns if isinstance(column, LinkColumn)}
    joints = (joint for row, joint in enumerate(model.robot.joints) if row in bodies)
    links = {joint.name: get_physical_link(model, joint) for joint in joints}
    rotors = [c.name for c in model.columns if is_in_block(c, EnergyBlock.KINETIC)]
    zeros = {name for name, value in model.robot.evaluate_symbols().items() if value == 0.0}
    groups = [g for x in links.values() for g in ((x.mass,), x.centre, x.inertia)]
    named = (name for g in groups for name in sorted(set().union(*(entry.names for entry in g))))
    known = {*static, *zeros}
    letters = [name for name in dict.fromkeys(named) if name not in known] + rotors
    ring = PolyRing(letters + static, QQ, lex)
    # Symbols given by an expression are no letters of the formulas.
    derived = set(model.robot.symbols) - set(model.geometry.values) - zeros
    values = get_generators(ring) | dict.fromkeys(zeros, ring.zero)

    def read_entry(entry: Expression, joint: str) -> Poly:
        """Returns an entry of `[physical]` as a polynomial."""
        polynomial = None if entry.names & derived else convert_to_polynomial(entry, values, ring)
        if polynomial is None:
            raise RobotError(
                f'robot {model.robot.name}, [physical.{joint}]: got "{entry.text}"; expected '
                "a polynomial of the link's letters and of symbols that are given by a number"
            )
        return polynomial

    standard: dict[int, Poly] = {}
    tables: dict[int, dict[str, Poly]] = {}
    for place, column in enumerate(model.columns):
        if isinstance(column, LinkColumn):
            if column.row not in tables:
                name = model.robot.joints[column.row].name
                tables[column.row] = move_to_origin(links[name], name, read_entry)
            standard[place] = tables[column.row][column.prefix]
        elif is_in_block(column, EnergyBlock.KINETIC):
            standard[place] = read_entry(parse_expression(column.name), column.name)
    masses = [x.mass.text for x in links.values() if x.mass.text in letters]
    alone = {x.inertia[i].text for x in links.values() for i in _DIAGONAL} | set(rotors)
    moments = tuple(name for name in letters if name in alone)
    lengths = _find_lengths(algebra)
    kinds: dict[str, str] = {}  # one that is several is what is measured with more trouble
    centres = [entry for x in links.values() for entry in x.centre]
    inertias = [entry for x in links.values() for entry in x.inertia]
    masses_of = [x.mass for x in links.values()]
    for kind, entries in (("mass", masses_of), ("centre", centres), ("inertia", inertias)):
        kinds |= {name: kind for entry in entries for name in entry.names}
    kinds |= dict.fromkeys(rotors, "rotor inertia") | dict.fromkeys(lengths, "length")
    return PhysicalParameters(
        ring, tuple(letters + lengths), tuple(masses), moments, standard, kinds
    )


def get_physical_link(model: SymbolicModel, joint: Joint) -> PhysicalLink:
    """Returns the letters of a link."""
    stated_link = model.robot.physical.get(joint.name)
    if stated_link is not None:
        return stated_link
    mass, x, y, z, *inertia = (parse_expression(f"{letter}{joint.name}") for letter in _GENERIC)
    for entry in (mass, x, y, z, *inertia):
        if entry.text in model.robot.symbols:
            raise RobotError(
                f"robot {model.robot.name}: the symbol {entry.text} is also the name of a physical "
                f"parameter of link {joint.name}; rename it in [symbols], or give the link's "
                f"letters in [physical.{joint.name}]"
            )
    return PhysicalLink(mass, (x, y, z), tuple(inertia))


def _find_lengths(algebra: TrigRing) -> list[str]:
    """Letters of the geometry without those of gravity; an angle stands for its cosine and sine."""
    geometry = algebra.geometry
    gravity = {symbol.name for entry in geometry.gravity for symbol in entry.free_symbols}
    for row in geometry.rows:
        for entry in (row.gamma, row.b, row.alpha, row.d, row.theta, row.r):
            gravity -= {symbol.name for symbol in entry.free_symbols}
    lengths: dict[str, None] = {}
    for atom in algebra.static_atoms:
        if atom.is_Symbol and atom.name != "pi":
            lengths.setdefault(atom.name)
        elif isinstance(atom, sympy.cos) and atom.free_symbols:
            lengths.setdefault(str(atom.args[0]))
    return [name for name in lengths if name not in gravity]


def move_to_origin(
    link: PhysicalLink, joint: str, read: Callable[[Expression, str], Any]
) -> dict[str, Any]:
    """Returns the standard parameters of a link by Huygens and Steiner, in any algebra."""
    m = read(link.mass, joint)
    x, y, z = (read(entry, joint) for entry in link.centre)
    names = ("XX", "XY", "XZ", "YY", "YZ", "ZZ")
    J = {name: read(entry, joint) for name, entry in zip(names, link.inertia, strict=True)}
    return {
        "XX": J["XX"] + m * (y * y + z * z),
        "XY": J["XY"] - m * x * y,
        "XZ": J["XZ"] - m * x * z,
        "YY": J["YY"] + m * (x * x + z * z),
        "YZ": J["YZ"] - m * y * z,
        "ZZ": J["ZZ"] + m * (x * x + y * y),
        "MX": m * x,
        "MY": m * y,
        "MZ": m * z,
        "M": m,
    }


# Which physical parameters the coefficients show, and how many of them at most.


_LARGEST = 2**31


@dataclass(frozen=True)
class Identifiability:
    """What the coefficients determine of the physical parameters.

    Attributes:
        letters: all physical parameters.
        appearing: those that some coefficient depends on.
        vanishing: the others.
        sums: groups that enter only together, as {letter: +1 or -1}: bl1 and ct1 as bl1 + ct1.
        jacobian_rank: generic rank of d coefficients / d appearing parameters: so many of them
            follow at most from the coefficients; the others must be known.
        points: number of random points, modulo a prime, of which the highest rank was taken.
        seed: of the points.
    """

    letters: tuple[str, ...]
    appearing: tuple[str, ...]
    vanishing: tuple[str, ...]
    sums: tuple[Mapping[str, int], ...]
    jacobian_rank: int
    points: int
    seed: int


def analyse_identifiability(
    physical: PhysicalParameters,
    coefficients: Sequence[Poly],
    points: int = 2,
    seed: int = THRESHOLDS.seed,
) -> Identifiability:
    """Returns which physical parameters those coefficients determine."""
    slopes = {
        letter: tuple(physical.differentiate_polynomial(poly, letter) for poly in coefficients)
        for letter in physical.letters
    }
    appearing = tuple(letter for letter, column in slopes.items() if any(column))
    chance = random.Random(seed)
    ranks = [_compute_rank([slopes[x] for x in appearing], physical, chance) for _ in range(points)]
    vanishing = tuple(letter for letter in physical.letters if letter not in appearing)
    sums = _find_sums({letter: slopes[letter] for letter in appearing})
    return Identifiability(physical.letters, appearing, vanishing, sums, max(ranks), points, seed)


def _find_sums(slopes: Mapping[str, tuple[Poly, ...]]) -> tuple[dict[str, int], ...]:
    """Letters whose columns of the Jacobian are the same polynomials up to the sign."""
    groups: list[tuple[tuple[Poly, ...], dict[str, int]]] = []
    for letter, column in slopes.items():
        for other, members in groups:
            if column == other:
                members[letter] = 1
                break
            if all(a == -b for a, b in zip(column, other, strict=True)):
                members[letter] = -1
                break
        else:
            groups.append((column, {letter: 1}))
    return tuple(members for _, members in groups if len(members) > 1)


def _compute_rank(
    columns: Sequence[Sequence[Poly]], physical: PhysicalParameters, chance: random.Random
) -> int:
    prime, point = draw_random_point(physical.names, chance)
    vectors = []
    for column in columns:
        vectors.append({i: evaluate_modulo(p, point, prime) for i, p in enumerate(column) if p})
    return len(find_independent_modulo(vectors, prime))


def draw_random_point(names: Sequence[str], chance: random.Random) -> tuple[int, list[int]]:
    """Returns (prime, values modulo it) of random letters, angles on the circle, and roots."""
    numbers = {name: sympy.sympify(name).args[0] for name in names if name.startswith("sqrt(")}
    prime = sympy.prevprime(chance.randrange(_LARGEST // 2, _LARGEST))
    while not all(sympy.is_quad_residue(_reduce_modulo(x, prime), prime) for x in numbers.values()):
        prime = sympy.prevprime(prime)
    values: dict[str, int] = {}
    for name in names:
        if name in numbers:
            values[name] = int(sympy.sqrt_mod(_reduce_modulo(numbers[name], prime), prime))
        elif name.startswith("cos("):
            t = chance.randrange(2, 10**6)
            down = pow(1 + t * t, -1, prime)
            values[name] = (1 - t * t) * down % prime
            values["sin" + name[3:]] = 2 * t * down % prime
        elif name not in values:
            values[name] = chance.randrange(1, prime)
    return prime, [values[name] for name in names]


def _reduce_modulo(value: sympy.Rational, prime: int) -> int:
    return int(value.p) * pow(int(value.q), -1, prime) % prime


# What a robot file says in `[terms]`: how a paper prints its coefficients.
#
# Keys, all optional:
#
# * `source`: the citation.
# * `keep_sine_squares = ["J11"]`: functions printed with squares of sines, not of cosines.
# * `[terms.monomials]`: function -> its monomials in the paper's order, by which coefficients are
#   numbered; coefficients that the paper lacks are called by `missing = "PX"`.
# * `[terms.printed]`: the print letter by letter, to be checked: `count` of coefficients,
#   `independent` coefficients, `vanishing` parameters, and the tables `functions`, `definitions`,
#   `solutions` (a fraction as [numerator, denominator]).
# * `[terms.printed.coupling]`: an example at which a printed Coulomb friction G_ii C_i sgn(qd_i) is
#   tried: `motor_from_joint` (rows of G, from joint to motor speeds), `coulomb` (C), `speed` (qd).
# * `[terms.example]` and `[terms.twin]`: two sets of physical parameters, as exact fractions.


_KEYS = (
    "source",
    "keep_sine_squares",
    "missing",
    "monomials",
    "printed",
    "example",
    "twin",
    "triads",
)
_COUPLING = ("motor_from_joint", "coulomb", "speed")
_PRINTED = tuple(
    ["count", "independent", "vanishing", "functions", "definitions", "solutions", "coupling"]
)


@dataclass(frozen=True)
class Coupling:
    """Motors that turn with several joints, and one motion.

    Attributes:
        motor_from_joint: G, rows of motors: motor speed = G qd.
        coulomb: (motors,) N m.
        speed: (joints,) rad/s.
    """

    motor_from_joint: tuple[tuple[Fraction, ...], ...]
    coulomb: tuple[Fraction, ...]
    speed: tuple[Fraction, ...]


@dataclass(frozen=True)
class PrintedTerms:
    """`[terms]` of a robot file, read.

    Attributes:
        source: citation, "" if there is none.
        missing: prefix of coefficients that the paper lacks.
        monomials: function -> monomials in printed order; empty if the file gives none.
        count: number of coefficients that the paper counts; None if it does not say.
        independent: coefficients that the paper calls independent.
        vanishing: parameters that vanish, in the paper's letters.
        functions: function -> as printed.
        definitions: coefficient -> as printed.
        solutions: physical parameter -> (numerator, denominator) as printed.
        example: physical parameters of an example.
        twin: changes to it which, the robot file claims, leave all coefficients as they are.
        coupling: an example of motors that turn with several joints.
    """

    source: str = ""
    missing: str = "PX"
    monomials: Mapping[str, tuple[Expression, ...]] = field(default_factory=dict)
    count: int | None = None
    independent: tuple[str, ...] = ()
    vanishing: tuple[str, ...] = ()
    functions: Mapping[str, Expression] = field(default_factory=dict)
    definitions: Mapping[str, Expression] = field(default_factory=dict)
    solutions: Mapping[str, tuple[Expression, Expression]] = field(default_factory=dict)
    example: Mapping[str, Fraction] = field(default_factory=dict)
    twin: Mapping[str, Fraction] = field(default_factory=dict)
    coupling: Coupling | None = None


def read_printed_terms(robot: Robot) -> PrintedTerms:
    """Reads `[terms]` of the robot.

    Raises:
        RobotError: an unknown key, or a value of the wrong kind; says where and what is expected.
    """
    where = f"robot {robot.name}, [terms]"
    terms = _check_table(robot.terms, where, _KEYS)
    printed = _check_table(terms.get("printed", {}), f"{where}, printed", _PRINTED)
    count = printed.get("count")
    if count is not None and (isinstance(count, bool) or not isinstance(count, int)):
        raise RobotError(f"{where}, printed, count: got {count!r}; expected a number such as 96")
    place = f"{where}, monomials"
    return PrintedTerms(
        source=_check_text(terms.get("source", ""), f"{where}, source"),
        missing=_check_text(terms.get("missing", "PX"), f"{where}, missing"),
        monomials={
            name: tuple(_parse_expression(x, f"{place}, {name}") for x in _check_list(cell, where))
            for name, cell in _check_table(terms.get("monomials", {}), place).items()
        },
        count=count,
        independent=_parse_names(printed.get("independent", []), f"{where}, printed, independent"),
        vanishing=_parse_names(printed.get("vanishing", []), f"{where}, printed, vanishing"),
        functions=_parse_expressions(printed, "functions", where),
        definitions=_parse_expressions(printed, "definitions", where),
        solutions=_parse_solutions(printed, where),
        example=_parse_numbers(terms.get("example", {}), f"{where}, example"),
        twin=_parse_numbers(terms.get("twin", {}), f"{where}, twin"),
        coupling=_parse_coupling(printed, f"{where}, printed, coupling"),
    )


def _parse_coupling(printed: Mapping[str, Any], where: str) -> Coupling | None:
    if "coupling" not in printed:
        return None
    table = _check_table(printed["coupling"], where, _COUPLING)
    for key in _COUPLING:
        if key not in table:
            raise RobotError(f"{where}: {key} is missing; expected {', '.join(_COUPLING)}")
    speed = _parse_row(table["speed"], f"{where}, speed")
    coulomb = _parse_row(table["coulomb"], f"{where}, coulomb")
    place = f"{where}, motor_from_joint"
    rows = tuple(_parse_row(row, place) for row in _check_list(table["motor_from_joint"], place))
    if {len(rows), len(coulomb), *(len(row) for row in rows)} != {len(speed)}:
        raise RobotError(
            f"{where}: got {len(rows)} rows of {', '.join(str(len(row)) for row in rows)}, "
            f"{len(coulomb)} coulomb, {len(speed)} speed; expected as many motors as joints"
        )
    return Coupling(rows, coulomb, speed)


def _parse_row(value: Any, where: str) -> tuple[Fraction, ...]:
    cells = {f"entry {i}": cell for i, cell in enumerate(_check_list(value, where), start=1)}
    return tuple(_parse_numbers(cells, where).values())


def _check_table(value: Any, where: str, keys: tuple[str, ...] = ()) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise RobotError(f"{where}: got {value!r}; expected a table of names")
    for key in value:
        if keys and key not in keys:
            raise RobotError(f"{where}: unknown key {key}; expected {', '.join(keys)}")
    return value


def _check_list(value: Any, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise RobotError(f'{where}: got {value!r}; expected a list such as ["s1*s2", "c1"]')
    return value


def _check_text(value: Any, where: str) -> str:
    if not isinstance(value, str):
        raise RobotError(f"{where}: got {value!r}; expected text")
    return value


def _parse_names(value: Any, where: str) -> tuple[str, ...]:
    return tuple(_check_text(entry, where) for entry in _check_list(value, where))


def _parse_expression(value: Any, where: str) -> Expression:
    try:
        return parse_expression(value)
    except ExpressionError as error:
        raise RobotError(f"{where}: {error}") from None


def _parse_expressions(printed: Mapping[str, Any], key: str, where: str) -> dict[str, Expression]:
    here = f"{where}, printed, {key}"
    table = _check_table(printed.get(key, {}), here)
    return {name: _parse_expression(cell, f"{here}, {name}") for name, cell in table.items()}


def _parse_solutions(
    printed: Mapping[str, Any], where: str
) -> dict[str, tuple[Expression, Expression]]:
    here = f"{where}, printed, solutions"
    solutions = {}
    for name, cell in _check_table(printed.get("solutions", {}), here).items():
        parts = cell if isinstance(cell, list) else [cell, 1]
        if len(parts) != 2:
            raise RobotError(
                f"{here}, {name}: got {len(parts)} entries; expected [numerator, denominator]"
            )
        above, below = (_parse_expression(part, f"{here}, {name}") for part in parts)
        solutions[name] = (above, below)
    return solutions


def _parse_numbers(value: Any, where: str) -> dict[str, Fraction]:
    numbers = {}
    for name, cell in _check_table(value, where).items():
        try:
            numbers[name] = Fraction(cell if isinstance(cell, str) else repr(cell))
        except (ValueError, ZeroDivisionError):
            raise RobotError(
                f'{where}, {name}: got {cell!r}; expected a number such as 12 or "1063/52500"'
            ) from None
    return numbers
