"""The dynamics as formulas with as few trigonometric monomials as we find."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TypeAlias

from modeler.base import BaseParameters
from modeler.core.errors import RobotError
from modeler.robot import Robot
from modeler.symbolic import SymbolicModel
from modeler.terms.energy import Entries, dynamics
from modeler.terms.fresh import effects_sheet
from modeler.terms.ring import Poly, TrigRing, without_squares
from modeler.terms.sheet import Sheet

Exponents: TypeAlias = tuple[int, ...]
Form: TypeAlias = Mapping[int, Poly]
"""Linear form of standard parameters: {column: factor, a polynomial of the geometry}."""

KINDS = {"g": "gravity", "J": "inertia", "S": "christoffel"}
_EXHAUSTIVE = 4  # joints with squares up to which every combination is tried


@dataclass(frozen=True)
class Function:
    """One function of the configuration.

    Attributes:
        name: "g1", "J12", "S213"; joints with longer names are joined as in "J1_12".
        kind: "gravity" (N m per unit of the factored-out letter), "inertia" or "christoffel".
        joints: indices of the joint variables.
        terms: {exponents of the motion generators: linear form of the parameters}, in the order
            in which they are printed.
    """

    name: str
    kind: str
    joints: tuple[int, ...]
    terms: Mapping[Exponents, Form]


@dataclass(frozen=True)
class ClosedForm:
    """tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k + g_i + e_i, where they are not zero.

    J is the inertia matrix, S_ijk the full coefficient of qd_j qd_k, e what effects take.

    Attributes:
        robot: its description.
        parameters: names of the parameters by column: the standard ones, or the base parameters at
            the columns that they have.
        algebra: the generators of the functions.
        gravity_factor: name of the letter taken out of all gravity functions, "" if there is none:
            the gravity torque of joint i is that letter times g_i.
        functions: g, J, S in order of their indices.
        effects: e, which is no polynomial.
    """

    robot: Robot
    parameters: tuple[str, ...]
    algebra: TrigRing
    gravity_factor: str
    functions: tuple[Function, ...]
    effects: Sheet

    @cached_property
    def by_name(self) -> Mapping[str, Function]:
        """Functions by name."""
        return {function.name: function for function in self.functions}

    @property
    def monomials(self) -> int:
        """Number of monomials of all functions."""
        return sum(len(function.terms) for function in self.functions)


def closed_form(model: SymbolicModel, base: BaseParameters | None = None) -> ClosedForm:
    """The dynamics of a robot as polynomials in sines and cosines of its joints.

    Per function and per joint, either squares of the sine or squares of the cosine are eliminated,
    whichever leaves fewer monomials; where both leave as many, squares of cosines are kept. All
    choices are tried for up to four joints, beyond that one joint after the other. A robot file may
    fix the choice: the functions of `[terms] keep_sine_squares` keep squares of sines, all others
    squares of cosines.

    Args:
        model: any serial or tree-structured robot; joints may follow others by linear relations.
            Of a robot with loops, the opened tree: torques are those along its free variables.
        base: write it in the base parameters: factors of their columns only.

    Raises:
        DerivationError: too many joints to be printed; lengths that are not polynomials.
        RobotError: `keep_sine_squares` names a function that is not there.
    """
    algebra = TrigRing(model.geometry)
    everything: Sequence[int] = range(len(model.columns))
    columns = everything if base is None else [p.column for p in base.parameters]
    found = dynamics(model, algebra, columns)
    factor = _gravity_factor(algebra)
    names = [joint.name for joint in model.robot.free]
    keep = _kept_by_paper(model.robot)
    functions = [
        _function("g", names, at, _divided(entry, factor, algebra), algebra, keep)
        for at, entry in found.gravity.items()
    ]
    for letter, entries in (("J", found.inertia), ("S", found.christoffel)):
        functions += _functions(letter, names, entries, algebra, keep)
    _check_names(model.robot, keep, functions)
    letter = str(algebra.ring.symbols[factor]) if factor is not None else ""
    parameters = list(model.names)
    for parameter in base.parameters if base is not None else ():
        parameters[parameter.column] = parameter.name
    effects = effects_sheet(model, {column: parameters[column] for column in columns})
    return ClosedForm(model.robot, tuple(parameters), algebra, letter, tuple(functions), effects)


def function_name(letter: str, joints: Sequence[str]) -> str:
    """Name of a function: "J12"; "J1_12" where a joint's name has several characters."""
    return letter + ("" if all(len(name) == 1 for name in joints) else "_").join(joints)


def _functions(
    letter: str,
    names: Sequence[str],
    entries: Entries,
    algebra: TrigRing,
    keep: frozenset[str] | None,
) -> list[Function]:
    return [_function(letter, names, at, entry, algebra, keep) for at, entry in entries.items()]


def _function(
    letter: str,
    names: Sequence[str],
    at: tuple[int, ...],
    entry: Form,
    algebra: TrigRing,
    keep: frozenset[str] | None,
) -> Function:
    name = function_name(letter, [names[i] for i in at])
    if keep is None:
        entry = _fewest(entry, algebra)
    elif name in keep:
        entry = _all_sines(entry, algebra)
    terms = collect(entry, algebra)
    order = sorted(terms, reverse=True)
    return Function(name, KINDS[letter], at, {exponents: terms[exponents] for exponents in order})


def collect(entry: Form, algebra: TrigRing) -> dict[Exponents, dict[int, Poly]]:
    """{parameter: polynomial} sorted by monomials: {monomial: {parameter: factor}}."""
    terms: dict[Exponents, dict[int, Poly]] = {}
    for column, poly in entry.items():
        for exponents, factor in algebra.split(poly).items():
            terms.setdefault(exponents, {})[column] = factor
    return terms


def _fewest(entry: Form, algebra: TrigRing) -> Form:
    """The same function with the squares of sines kept where that saves monomials."""
    squared = [
        index
        for index, motion in enumerate(algebra.motions)
        if motion.cosine is not None
        and any(exponents[motion.cosine] > 1 for poly in entry.values() for exponents in poly)
    ]
    if len(squared) <= _EXHAUSTIVE:
        sets = [c for n in range(len(squared) + 1) for c in combinations(squared, n)]
        choices = [_with_sines(entry, algebra, chosen) for chosen in sets]
        return min(choices, key=lambda choice: _count(choice, algebra))
    best, count = entry, _count(entry, algebra)
    for index in squared:
        other = _with_sines(best, algebra, (index,))
        if (fewer := _count(other, algebra)) < count:
            best, count = other, fewer
    return best


def _all_sines(entry: Form, algebra: TrigRing) -> Form:
    turning = [i for i, motion in enumerate(algebra.motions) if motion.sine is not None]
    return _with_sines(entry, algebra, turning)


def _with_sines(entry: Form, algebra: TrigRing, joints: Sequence[int]) -> Form:
    for index in joints:
        motion = algebra.motions[index]
        assert motion.sine is not None and motion.cosine is not None
        entry = {
            column: without_squares(poly, motion.cosine, motion.sine)
            for column, poly in entry.items()
        }
    return entry


def _count(entry: Form, algebra: TrigRing) -> int:
    return len({exponents[: algebra.moving] for poly in entry.values() for exponents in poly})


def _gravity_factor(algebra: TrigRing) -> int | None:
    """Place of the first letter that divides every component of gravity."""
    entries = [algebra.static(entry) for entry in algebra.geometry.gravity]
    terms = [exponents for entry in entries for exponents in entry]
    places = range(algebra.moving, len(algebra.ring.symbols))
    if not terms:
        return None
    return next((place for place in places if all(t[place] for t in terms)), None)


def _divided(entry: Form, place: int | None, algebra: TrigRing) -> Form:
    if place is None:
        return entry
    return {column: poly.exquo(algebra.ring.gens[place]) for column, poly in entry.items()}


def _kept_by_paper(robot: Robot) -> frozenset[str] | None:
    names = robot.terms.get("keep_sine_squares")
    if names is None:
        return None
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise RobotError(
            f"robot {robot.name}, [terms], keep_sine_squares: got {names!r}; expected a list of "
            'functions such as ["J11", "J12"]'
        )
    return frozenset(names)


def _check_names(robot: Robot, keep: frozenset[str] | None, functions: Sequence[Function]) -> None:
    known = [function.name for function in functions]
    for name in sorted((keep or set()) - set(known)):
        raise RobotError(
            f"robot {robot.name}, [terms], keep_sine_squares: got {name}, which is zero or no "
            f"function of this robot; expected names among {', '.join(known)}"
        )
