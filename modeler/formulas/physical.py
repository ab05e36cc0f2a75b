"""Standard parameters as polynomials of masses, mass centres and inertias about them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.polyerrors import ExactQuotientFailed
from sympy.polys.rings import PolyRing

from modeler.core.errors import RobotError
from modeler.core.expression import FUNCTIONS, Expression, parse
from modeler.derivation.columns import LinkColumn, in_block
from modeler.derivation.model import SymbolicModel
from modeler.effects.effect import EnergyBlock
from modeler.formulas.ring import Poly, TrigRing
from modeler.robot.robot import Joint, PhysicalLink

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
        """Names of all generators."""
        return tuple(str(symbol) for symbol in self.ring.symbols)

    def of(self, form: Mapping[int, Poly]) -> Poly:
        """A linear form of standard parameters in physical parameters."""
        total = self.ring.zero
        for column, factor in form.items():
            total = total + self.lifted(factor) * self.standard[column]
        return total

    def derivative(self, poly: Poly, letter: str) -> Poly:
        """D poly / d letter; that of an angle by its cosine and sine."""
        places = {name: x for name, x in zip(self.names, self.ring.gens, strict=True)}
        if letter in places:
            return poly.diff(places[letter])
        c, s = places[f"cos({letter})"], places[f"sin({letter})"]
        return c * poly.diff(s) - s * poly.diff(c)

    def lifted(self, factor: Poly) -> Poly:
        """A polynomial of the geometry in this ring."""
        shift = (0,) * (self.ring.ngens - factor.ring.ngens)
        return self.ring.zero.new({shift + at: value for at, value in factor.items()})


def physical_parameters(model: SymbolicModel, algebra: TrigRing) -> PhysicalParameters:
    """The physical parameters of a robot: the letters of `[physical]`, or m1, cx1, ..., Ixx1, ...

    Huygens and Steiner: MS = m c, J = J_c + m (c.c 1 - c c').

    Raises:
        RobotError: an entry of `[physical]` is no polynomial, or uses the name of a joint's sine.
    """
    static = [str(symbol) for symbol in algebra.static_ring.symbols]
    bodies = {column.row for column in model.columns if isinstance(column, LinkColumn)}
    links = {
        joint.name: _link(model, joint)
        for row, joint in enumerate(model.robot.joints)
        if row in bodies
    }
    rotors = [c.name for c in model.columns if in_block(c, EnergyBlock.KINETIC)]
    zeros = _zero_symbols(model)
    known = {*static, *zeros}
    letters = [name for name in _letters(links.values()) if name not in known] + rotors
    ring = PolyRing(letters + static, QQ, lex)
    standard = _standard(model, links, _PhysicalReader(model, ring, zeros))
    masses = [x.mass.text for x in links.values() if x.mass.text in letters]
    alone = {x.inertia[i].text for x in links.values() for i in _DIAGONAL} | set(rotors)
    moments = tuple(name for name in letters if name in alone)
    gravity = _gravity_only(algebra)
    lengths = [name for name in _lengths(algebra) if name not in gravity]
    kinds = dict.fromkeys(rotors, "rotor inertia") | dict.fromkeys(lengths, "length")
    kinds = _kinds(links.values()) | kinds
    return PhysicalParameters(
        ring, tuple(letters + lengths), tuple(masses), moments, standard, kinds
    )


def _link(model: SymbolicModel, joint: Joint) -> PhysicalLink:
    found = model.robot.physical.get(joint.name)
    if found is not None:
        return found
    mass, x, y, z, *inertia = (parse(f"{letter}{joint.name}") for letter in _GENERIC)
    for entry in (mass, x, y, z, *inertia):
        if entry.text in model.robot.symbols:
            raise RobotError(
                f"robot {model.robot.name}: the symbol {entry.text} is also the name of a physical "
                f"parameter of link {joint.name}; rename it in [symbols], or give the link's "
                f"letters in [physical.{joint.name}]"
            )
    return PhysicalLink(mass, (x, y, z), tuple(inertia))


def _letters(links: Any) -> list[str]:
    found: dict[str, None] = {}
    for link in links:
        for group in ((link.mass,), link.centre, link.inertia):
            for name in sorted(set().union(*(entry.names for entry in group))):
                found.setdefault(name)
    return list(found)


def _kinds(links: Any) -> dict[str, str]:
    """What each letter is; one that is several is what is measured with more trouble."""
    found: dict[str, str] = {}
    for kind in ("mass", "centre", "inertia"):
        for link in links:
            entries = (link.mass,) if kind == "mass" else getattr(link, kind)
            for entry in entries:
                found |= dict.fromkeys(entry.names, kind)
    return found


def _zero_symbols(model: SymbolicModel) -> frozenset[str]:
    values = model.robot.symbol_values()
    return frozenset(name for name, value in values.items() if value == 0.0)


def _lengths(algebra: TrigRing) -> list[str]:
    """Letters of the geometry; an angle stands for its cosine and sine."""
    found: dict[str, None] = {}
    for atom in algebra.static_atoms:
        if atom.is_Symbol and atom.name != "pi":
            found.setdefault(atom.name)
        elif isinstance(atom, sympy.cos) and atom.free_symbols:
            found.setdefault(str(atom.args[0]))
    return list(found)


def _gravity_only(algebra: TrigRing) -> frozenset[str]:
    geometry = algebra.geometry
    used = {symbol.name for entry in geometry.gravity for symbol in entry.free_symbols}
    for row in geometry.rows:
        for entry in (row.gamma, row.b, row.alpha, row.d, row.theta, row.r):
            used -= {symbol.name for symbol in entry.free_symbols}
    return frozenset(used)


@dataclass(frozen=True)
class _PhysicalReader:
    """Reads entries of `[physical]` as polynomials of `ring`."""

    model: SymbolicModel
    ring: PolyRing
    zeros: frozenset[str]

    def __call__(self, entry: Expression, joint: str) -> Poly:
        generators = {
            str(symbol): x for symbol, x in zip(self.ring.symbols, self.ring.gens, strict=True)
        }
        values = {name: QQ(0) if name in self.zeros else generators[name] for name in entry.names}
        try:
            derived = entry.names & self._derived()
            if derived:
                raise ValueError
            return self.ring(entry.fold(values, _refused(), None, _rational))
        except (TypeError, ValueError, ZeroDivisionError, ExactQuotientFailed):
            raise RobotError(
                f'robot {self.model.robot.name}, [physical.{joint}]: got "{entry.text}"; expected '
                "a polynomial of the link's letters and of symbols that are given by a number"
            ) from None

    def _derived(self) -> set[str]:
        """Symbols given by an expression: they are no letters of the formulas."""
        geometry = self.model.geometry
        return set(self.model.robot.symbols) - set(geometry.values) - self.zeros


def _refused() -> dict[str, Callable[[Any], Any]]:
    def refuse(_: Any) -> Any:
        raise ValueError

    return dict.fromkeys(FUNCTIONS, refuse)


def _rational(value: Fraction) -> Any:
    return QQ(value.numerator, value.denominator)


def _standard(
    model: SymbolicModel, links: Mapping[str, PhysicalLink], read: _PhysicalReader
) -> dict[int, Poly]:
    found: dict[int, Poly] = {}
    tables: dict[int, dict[str, Poly]] = {}
    for place, column in enumerate(model.columns):
        if isinstance(column, LinkColumn):
            if column.row not in tables:
                name = model.robot.joints[column.row].name
                tables[column.row] = _at_origin(links[name], name, read)
            found[place] = tables[column.row][column.prefix]
        elif in_block(column, EnergyBlock.KINETIC):
            found[place] = read(parse(column.name), column.name)
    return found


def _at_origin(link: PhysicalLink, joint: str, read: _PhysicalReader) -> dict[str, Poly]:
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
