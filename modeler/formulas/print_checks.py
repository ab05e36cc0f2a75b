"""A paper's print against the derived model: every claim is computed, none believed."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod
from typing import Any

from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.derivation import convert_to_fraction, find_linear_relations
from modeler.formulas.closed_form import Exponents, format_function_name
from modeler.formulas.coefficients import CoefficientTable, flatten_form
from modeler.formulas.ring import (
    Poly,
    convert_to_polynomial,
    evaluate_monomial,
    evaluate_polynomial,
    find_combination,
    get_generators,
)
from modeler.formulas.text import format_combination, format_monomial, format_polynomial


@dataclass(frozen=True)
class FunctionCheck:
    """A printed function that is not the derived one.

    Attributes:
        name: "S213".
        printed: as the robot file quotes it.
        difference: {monomial: derived minus printed, in independent coefficients}.
        power_defect: what the printed function alone adds to qd'S - qd' (dM/dt) qd / 2, which is 0
            for any mechanism, at the test state [W]; None for gravity and inertia functions.
    """

    name: str
    printed: str
    difference: Mapping[str, str]
    power_defect: Fraction | None


@dataclass(frozen=True)
class DefinitionCheck:
    """A printed definition that is not the derived one: derived minus printed, as text."""

    name: str
    printed: str
    difference: str


@dataclass(frozen=True)
class SolutionCheck:
    """A printed solution with the derived coefficients put in.

    Attributes:
        letter: the physical parameter.
        printed: as the robot file quotes it.
        verdict: "right", "divides by 0", "0/0", "returns -<letter>" or "wrong".
        numerator: after substitution, as text.
        denominator: after substitution, as text.
    """

    letter: str
    printed: str
    verdict: str
    numerator: str
    denominator: str


@dataclass(frozen=True)
class TwinCheck:
    """Two sets of physical parameters.

    Attributes:
        equal: number of coefficients that are exactly equal.
        different: names of the others.
        changed: letters with different values.
    """

    equal: int
    different: tuple[str, ...]
    changed: tuple[str, ...]


def find_wrong_functions(table: CoefficientTable) -> list[FunctionCheck]:
    """Returns printed functions that differ from the derived ones.

    Raises:
        RobotError: a printed function that is not a sum of coefficients times monomials.
    """
    checks = []
    for name, printed in table.printed.functions.items():
        joints = _find_joints(table, name)
        difference = _subtract_printed(table, name, printed)
        if difference:
            algebra = table.closed.algebra
            motion = algebra.names[: algebra.moving]
            texts = {
                format_monomial(at, motion): _express_in_coefficients(table, vector)
                for at, vector in sorted(difference.items(), reverse=True)
            }
            power = _compute_power_defect(table, joints, difference)
            checks.append(FunctionCheck(name, printed.text, texts, power))
    return checks


def _express_in_coefficients(table: CoefficientTable, vector: Mapping[Any, Any]) -> str:
    independent = {
        name: flatten_form(table.by_name[name].standard) for name in table.relations.independent
    }
    combination = find_combination(independent, vector)
    assert combination is not None, "a difference of coefficients is a combination of coefficients"
    return format_combination(combination)


def _subtract_printed(
    table: CoefficientTable, name: str, printed: Expression
) -> dict[Exponents, dict[Any, Any]]:
    """Derived minus printed as {monomial: vector over Q}, both in normal form."""
    terms = [(c.name, c.exponents, QQ(1)) for c in table.coefficients if c.function == name]
    terms += [(c, at, -value) for c, at, value in _parse_printed_terms(table, name, printed)]
    total: dict[str, dict[Exponents, Any]] = {}
    for coefficient, at, value in terms:
        part = total.setdefault(coefficient, {})
        part[at] = part.get(at, 0) + value
    algebra = table.closed.algebra
    rest = (0,) * algebra.static_ring.ngens
    differences: dict[Exponents, dict[Any, Any]] = {}
    for coefficient, part in total.items():
        poly = algebra.normalise_polynomial(
            algebra.ring.zero.new({at + rest: v for at, v in part.items() if v})
        )
        vector = flatten_form(table.by_name[coefficient].standard)
        for at, value in poly.items():
            sums = differences.setdefault(at[: algebra.moving], {})
            for place, factor in vector.items():
                sums[place] = sums.get(place, 0) + value * factor
    nonzero = {at: {p: v for p, v in sums.items() if v} for at, sums in differences.items()}
    return {at: sums for at, sums in nonzero.items() if sums}


def _parse_printed_terms(
    table: CoefficientTable, name: str, printed: Expression
) -> list[tuple[str, Exponents, Any]]:
    algebra = table.closed.algebra
    motion = list(algebra.names[: algebra.moving])
    names = list(table.by_name)
    ring = PolyRing(motion + names, QQ, lex)
    poly = _evaluate_text(table, get_generators(ring), ring, printed, f"functions, {name}")
    printed_terms = []
    for exponents, value in poly.items():
        which = exponents[len(motion) :]
        if sum(which) != 1:
            raise RobotError(
                f"robot {table.closed.robot.name}, [terms], printed, functions, {name}: got "
                f'"{printed.text}"; expected a sum of coefficients times monomials'
            )
        printed_terms.append((names[which.index(1)], exponents[: len(motion)], value))
    return printed_terms


def _evaluate_text(
    table: CoefficientTable, values: Mapping[str, Any], ring: PolyRing, text: Expression, where: str
) -> Poly:
    polynomial = convert_to_polynomial(text, values, ring)
    if polynomial is None:
        unknown = ", ".join(sorted(text.names - set(values)))
        raise RobotError(
            f'robot {table.closed.robot.name}, [terms], printed, {where}: got "{text.text}"'
            + (f", where {unknown} is unknown" if unknown else "")
            + "; expected a polynomial of this robot's coefficients, sines, cosines and parameters"
        )
    return polynomial


def _compute_power_defect(
    table: CoefficientTable,
    joints: tuple[int, ...],
    difference: Mapping[Exponents, Mapping[Any, Any]],
) -> Fraction | None:
    if not table.printed.example or len(joints) != 3:
        return None
    state = build_exact_state(table)
    balance = compute_power_balance(table, state)
    assert balance == 0, "the derived model keeps the power balance"
    added = -sum(state.evaluate_term(at, vector) for at, vector in difference.items())
    return balance + added * state.multiply_speeds(joints)


def _find_joints(table: CoefficientTable, name: str) -> tuple[int, ...]:
    """Indices of the joints of a function, of one that is zero too."""
    order = [joint.name for joint in table.closed.robot.free_joints]
    for letter, count in (("g", 1), ("J", 2), ("S", 3)):
        for at in product(range(len(order)), repeat=count):
            if format_function_name(letter, [order[i] for i in at]) == name:
                return at
    raise RobotError(
        f"robot {table.closed.robot.name}, [terms], printed, functions: there is no function "
        f"{name}; expected names such as {', '.join(list(table.closed.by_name)[:3])}"
    )


def find_wrong_definitions(table: CoefficientTable) -> list[DefinitionCheck]:
    """Returns printed definitions that differ from the derived ones."""
    ring, checks = table.physical.ring, []
    for name, printed in table.printed.definitions.items():
        _check_coefficient(table, name, "definitions")
        poly = _evaluate_text(table, get_generators(ring), ring, printed, f"definitions, {name}")
        rest = table.by_name[name].physical - poly
        if rest:
            text = format_polynomial(rest, table.physical.names)
            checks.append(DefinitionCheck(name, printed.text, text))
    return checks


def _check_coefficient(table: CoefficientTable, name: str, key: str) -> None:
    if name not in table.by_name:
        raise RobotError(
            f"robot {table.closed.robot.name}, [terms], printed, {key}: there is no coefficient "
            f"{name}; there are {len(table.coefficients)}, such as {table.coefficients[0].name}"
        )


def check_solutions(table: CoefficientTable, as_printed: bool = False) -> list[SolutionCheck]:
    """Checks every printed solution with the coefficients put in, exactly.

    Args:
        table: of the robot.
        as_printed: put in the printed definitions of the coefficients, where there are some.
    """
    ring = table.physical.ring
    letters = get_generators(ring)
    values = {name: c.physical for name, c in table.by_name.items()} | letters
    for name, text in table.printed.definitions.items() if as_printed else ():
        values[name] = _evaluate_text(table, letters, ring, text, f"definitions, {name}")
    checks = []
    for letter, (above, below) in table.printed.solutions.items():
        numerator = _evaluate_text(table, values, ring, above, f"solutions, {letter}")
        denominator = _evaluate_text(table, values, ring, below, f"solutions, {letter}")
        if letter not in letters:
            raise RobotError(
                f"robot {table.closed.robot.name}, [terms], printed, solutions: {letter} is no "
                f"physical parameter; expected one of {', '.join(table.physical.letters)}"
            )
        if not denominator:
            verdict = "divides by 0" if numerator else "0/0"
        elif numerator == denominator * letters[letter]:
            verdict = "right"
        else:
            opposite = numerator == -denominator * letters[letter]
            verdict = f"returns -{letter}" if opposite else "wrong"
        quoted = above.text if below.text == "1" else f"({above.text}) / ({below.text})"
        checks.append(
            SolutionCheck(
                letter,
                quoted,
                verdict,
                format_polynomial(numerator, table.physical.names),
                format_polynomial(denominator, table.physical.names),
            )
        )
    return checks


def check_independent(table: CoefficientTable) -> dict[str, str]:
    """Returns {name: combination} of coefficients wrongly printed as independent."""
    for name in table.printed.independent:
        _check_coefficient(table, name, "independent")
    relations = find_linear_relations(
        {name: flatten_form(table.by_name[name].standard) for name in table.printed.independent}
    )
    return {
        name: format_combination(combination)
        for name, combination in relations.combinations.items()
        if name not in relations.independent
    }


def check_twin(table: CoefficientTable) -> TwinCheck:
    """Compares all coefficients at the example and at its twin, exactly."""
    first, second = get_example_values(table), get_example_values(table, twin=True)
    points = [
        [values.get(name, Fraction(0)) for name in table.physical.names]
        for values in (first, second)
    ]
    different = tuple(
        c.name
        for c in table.coefficients
        if evaluate_polynomial(c.physical, points[0]) != evaluate_polynomial(c.physical, points[1])
    )
    changed = tuple(name for name in second if second[name] != first.get(name))
    return TwinCheck(len(table.coefficients) - len(different), different, changed)


# The power balance at one exact state: the law that exposes a wrong Christoffel coefficient.


_HALF_TANGENTS = (Fraction(1, 2), Fraction(-1, 3), Fraction(2, 5))
_SPEEDS = (Fraction(1), Fraction(-2), Fraction(3))
STATE = "tan(q/2) = (1/2, -1/3, 2/5), qd = (1, -2, 3) rad/s"
"""The state, for people; more joints repeat it."""


@dataclass(frozen=True)
class PowerState:
    """Rational numbers for everything, so that a law holds exactly or not at all.

    Attributes:
        motion: sines and cosines, rational points of the circle.
        speeds: (joints,).
        static: generators of the geometry.
        chi: {column: standard parameter}.
    """

    motion: tuple[Fraction, ...]
    speeds: tuple[Fraction, ...]
    static: tuple[Fraction, ...]
    chi: Mapping[int, Fraction]

    def evaluate_term(self, at: Exponents, vector: Mapping[Any, Any]) -> Fraction:
        """Returns monomial * linear form of the standard parameters."""
        total = Fraction(0)
        for (column, geometry), value in vector.items():
            total += (
                convert_to_fraction(value)
                * evaluate_monomial(geometry, self.static)
                * self.chi[column]
            )
        return total * evaluate_monomial(at, self.motion)

    def multiply_speeds(self, joints: tuple[int, ...]) -> Fraction:
        """Returns qd_i qd_j qd_k."""
        return prod((self.speeds[joint] for joint in joints), start=Fraction(1))


def get_example_values(table: CoefficientTable, twin: bool = False) -> dict[str, Fraction]:
    """Returns physical parameters of the example; lengths that it leaves out are nominal."""
    nominal = table.closed.algebra.geometry.values
    values = {name: Fraction(repr(float(value))) for name, value in nominal.items()}
    values |= table.printed.example
    return {**values, **table.printed.twin} if twin else values


def build_exact_state(table: CoefficientTable) -> PowerState:
    """Returns the test state of the example; physical parameters that it leaves out are 0."""
    motion: list[Fraction] = []
    for index, joint in enumerate(table.closed.algebra.motions):
        t = _HALF_TANGENTS[index % len(_HALF_TANGENTS)]
        turning = [2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)]
        motion += turning if joint.variable is None else [t]
    values = get_example_values(table)
    physical = [values.get(name, Fraction(0)) for name in table.physical.names]
    shift = len(physical) - table.closed.algebra.static_ring.ngens
    chi = {c: evaluate_polynomial(poly, physical) for c, poly in table.physical.standard.items()}
    count = table.closed.algebra.geometry.coordinate_count
    speeds = tuple(_SPEEDS[i % len(_SPEEDS)] for i in range(count))
    return PowerState(tuple(motion), speeds, tuple(physical[shift:]), chi)


def compute_power_balance(table: CoefficientTable, state: PowerState) -> Fraction:
    """Returns qd'S - qd' (dM/dt) qd / 2 of the derived functions: 0 W for any mechanism."""
    total = Fraction(0)
    for function in table.closed.functions:
        for at, form in function.terms.items():
            if function.kind == "christoffel":
                total += state.evaluate_term(at, flatten_form(form)) * state.multiply_speeds(
                    function.joints
                )
            elif function.kind == "inertia":
                total -= _compute_half_slope_power(
                    table, state, function.joints, at, flatten_form(form)
                )
    return total


def _compute_half_slope_power(
    table: CoefficientTable,
    state: PowerState,
    joints: tuple[int, ...],
    at: Exponents,
    vector: Mapping[Any, Any],
) -> Fraction:
    """One term's part of qd' (dM/dt) qd / 2; entries beside the diagonal stand there twice."""
    algebra = table.closed.algebra
    rest = (0,) * algebra.static_ring.ngens
    monomial = algebra.ring.zero.new({at + rest: QQ(1)})
    total = Fraction(0)
    for k in range(algebra.geometry.coordinate_count):
        for moved, value in algebra.differentiate_polynomial(monomial, k).items():
            slope = convert_to_fraction(value) * state.evaluate_term(
                moved[: algebra.moving], vector
            )
            total += slope * state.multiply_speeds((*joints, k))
    return total / 2 if joints[0] == joints[1] else total
