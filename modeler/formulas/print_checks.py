"""A paper's print against the derived model: every claim is computed, none believed."""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod
from typing import Any

import numpy as np
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.derivation import (
    BaseParameters,
    SymbolicModel,
    convert_to_fraction,
    find_linear_relations,
    format_relation,
)
from modeler.formulas.closed_form import Exponents, derive_closed_form
from modeler.formulas.coefficients import (
    CoefficientTable,
    build_coefficient_table,
    collect_by_function,
    flatten_form,
    format_backward_map,
    format_coefficients,
    format_determinant,
    format_equation,
    format_forward_map,
)
from modeler.formulas.physical import Coupling
from modeler.formulas.ring import (
    Poly,
    convert_to_polynomial,
    evaluate_monomial,
    evaluate_polynomial,
    find_combination,
    format_combination,
    format_monomial,
    format_polynomial,
    format_signed_sum,
    get_generators,
    partition_by_ratio,
)
from modeler.formulas.short_form import format_function_name


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
    """A comparison of the coefficients of two sets of physical parameters.

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
    checks, algebra = [], table.closed.algebra
    motion = algebra.names[: algebra.moving]
    for name, printed in table.printed.functions.items():
        joints = _find_joints(table, name)
        difference = _subtract_printed(table, name, printed)
        items = sorted(difference.items(), reverse=True)
        texts = {format_monomial(at, motion): _express_in_coefficients(table, x) for at, x in items}
        if difference:
            power = _compute_power_defect(table, joints, difference)
            checks.append(FunctionCheck(name, printed.text, texts, power))
    return checks


def _express_in_coefficients(table: CoefficientTable, vector: Mapping[Any, Any]) -> str:
    combination = find_combination(_collect_vectors(table, table.relations.independent), vector)
    assert combination is not None, "a difference of coefficients is a combination of coefficients"
    return format_combination(combination)


def _collect_vectors(table: CoefficientTable, names: Iterable[str]) -> dict[str, dict[Any, Any]]:
    return {name: flatten_form(table.by_name[name].standard) for name in names}


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
        printed_part = {at + rest: v for at, v in part.items() if v}
        poly = algebra.normalise_polynomial(algebra.ring.zero.new(printed_part))
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
        sides = (format_polynomial(x, table.physical.names) for x in (numerator, denominator))
        checks.append(SolutionCheck(letter, quoted, verdict, *sides))
    return checks


def check_independent(table: CoefficientTable) -> dict[str, str]:
    """Returns {name: combination} of coefficients wrongly printed as independent."""
    for name in table.printed.independent:
        _check_coefficient(table, name, "independent")
    relations = find_linear_relations(_collect_vectors(table, table.printed.independent))
    combinations = relations.combinations
    dependent = (name for name in combinations if name not in relations.independent)
    return {name: format_combination(combinations[name]) for name in dependent}


def check_twin(table: CoefficientTable) -> TwinCheck:
    """Compares all coefficients at the example and at its twin, exactly."""
    first, second = get_example_values(table), get_example_values(table, twin=True)
    names, zero = table.physical.names, Fraction(0)
    points = [[values.get(name, zero) for name in names] for values in (first, second)]
    values = ([evaluate_polynomial(c.physical, x) for x in points[:2]] for c in table.coefficients)
    pairs = zip(table.coefficients, values, strict=True)
    different = tuple(c.name for c, (first, second) in pairs if first != second)
    changed = tuple(name for name in second if second[name] != first.get(name))
    return TwinCheck(len(table.coefficients) - len(different), different, changed)


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
            factor = convert_to_fraction(value) * evaluate_monomial(geometry, self.static)
            total += factor * self.chi[column]
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
                speeds = state.multiply_speeds(function.joints)
                total += state.evaluate_term(at, flatten_form(form)) * speeds
            elif function.kind == "inertia":
                vector = flatten_form(form)
                total -= _compute_half_slope_power(table, state, function.joints, at, vector)
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
            term = state.evaluate_term(moved[: algebra.moving], vector)
            slope = convert_to_fraction(value) * term
            total += slope * state.multiply_speeds((*joints, k))
    return total / 2 if joints[0] == joints[1] else total


@dataclass(frozen=True)
class FrictionCheck:
    """Coulomb friction of coupled motors at one motion, joint side.

    Attributes:
        printed: (joints,) G_ii C_i sign(qd_i), N m.
        derived: (joints,) (G^T C sign(G qd))_i, N m.
        printed_power: qd' printed, W.
        dissipated: sum C_i |motor speed_i|, W: what friction must take.
        derived_power: qd' derived, W.
    """

    printed: tuple[Fraction, ...]
    derived: tuple[Fraction, ...]
    printed_power: Fraction
    dissipated: Fraction
    derived_power: Fraction


def check_friction(coupling: Coupling) -> FrictionCheck:
    """Compares the printed friction term with that of virtual work, at one motion."""
    G, C, qd = map(np.array, (coupling.motor_from_joint, coupling.coulomb, coupling.speed))
    joint_signs, motor_signs = ((x > 0).astype(int) - (x < 0) for x in (qd, G @ qd))
    printed, derived = np.diag(G) * C * joint_signs, G.T @ (C * motor_signs)
    powers = qd @ printed, C @ np.abs(G @ qd), qd @ derived
    return FrictionCheck(tuple(printed), tuple(derived), *powers)


def _format_section(title: str, intro: str, lines: Iterable[str]) -> str:
    return "\n".join([title, "", intro, "", *lines, ""])


def write_print_sections(table: CoefficientTable) -> list[str]:
    """Writes the sections about the print; none if the robot file quotes none."""
    printed = table.printed
    quoted = (printed.functions, printed.definitions, printed.solutions, printed.independent)
    if not any(quoted):
        return []
    writers = (
        _write_independent,
        _write_definitions,
        _write_function_section,
        _write_solutions,
        _write_vanishing,
        _write_friction,
        _write_twin,
    )
    sections = (write(table) for write in writers)
    title = "## Where the print is wrong, and how one sees it\n"
    return [title, *(section for section in sections if section)]


def _write_independent(table: CoefficientTable) -> str:
    printed, dependent = table.printed.independent, check_independent(table)
    intro = (
        f"{len(printed)} are printed as independent; their rank over Q is "
        f"**{len(printed) - len(dependent)}**; that of all {len(table.coefficients)} is "
        f"**{table.relations.rank}**:"
    )
    lines = [f"* `{name} = {text}`, identically." for name, text in dependent.items()]
    return _format_section("### Independent coefficients", intro, lines) if lines else ""


def _write_definitions(table: CoefficientTable) -> str:
    wrong, count = find_wrong_definitions(table), len(table.printed.definitions)
    lines = [
        f"* {check.name}, printed `{check.printed}`: derived minus printed is `{check.difference}`."
        for check in wrong
    ]
    verdicts = {check.letter: check.verdict for check in check_solutions(table)}
    printed = check_solutions(table, as_printed=True)
    spoilt = [c.letter for c in printed if verdicts[c.letter] == "right" != c.verdict]
    if spoilt:
        lines += [
            "",
            "The print contradicts itself: with the printed definitions its own solutions for "
            f"{', '.join(spoilt)} do not return their parameter, with the derived ones they do.",
        ]
    right = f"{count - len(wrong)} of {count} printed definitions are the derived polynomials."
    return _format_section("### Definitions", f"{right} The others:", lines) if wrong else ""


def _write_function_section(table: CoefficientTable) -> str:
    wrong, printed = find_wrong_functions(table), table.printed
    if not wrong:
        return ""
    lines = ["### Functions", ""]
    true = len(table.coefficients)
    if printed.count not in (None, true):
        lines += [f"The print counts {printed.count} coefficients, there are **{true}**.", ""]
    lines += [
        "A mechanism keeps its power balance, qd'S = qd' (dM/dt) qd / 2. With the example of the "
        f"robot file at {STATE},"
    ]
    if printed.example:
        balance = compute_power_balance(table, build_exact_state(table))
        lines += [f"the derived functions miss it by {balance} W, in exact arithmetic.", ""]
    lines += ["| function | derived minus printed | print misses by |", "|---|---|---|"]
    for check in wrong:
        rest = "; ".join(f"`({text})*{at}`" for at, text in check.difference.items())
        power = "" if check.power_defect is None else f"{float(check.power_defect):.4f} W"
        lines.append(f"| {check.name} | {rest} | {power} |")
    quotes = [f"{check.name} = {check.printed}" for check in wrong]
    lines += ["", "As printed:", "", "```text", *quotes, "```", ""]
    for name in (n for n in table.closed.by_name if n not in printed.functions):
        names = {c.name for c in table.coefficients if c.function == name}
        holders = [f for f, text in printed.functions.items() if names & text.names]
        where = f"; its terms stand in {', '.join(holders)}" if holders else ""
        lines += [f"Without a name of its own in the print: {name}{where}.", ""]
    return "\n".join(lines)


def _write_solutions(table: CoefficientTable) -> str:
    checks, lines = check_solutions(table), []
    for check in (check for check in checks if check.verdict != "right"):
        why = f": it gives `({check.numerator}) / ({check.denominator})`"
        if check.verdict.startswith("returns"):
            why = ", the overall sign is wrong"
        elif check.denominator == "0":
            why = f": the denominator is the zero polynomial, the numerator `{check.numerator}`"
        lines.append(f"* {check.letter} = `{check.printed}`: **{check.verdict}**{why}.")
    intro = (
        f"With the derived coefficients put in, {len(checks) - len(lines)} of {len(checks)} "
        "printed solutions return their parameter. The others:"
    )
    title = "### Solutions for the physical parameters"
    return _format_section(title, intro, lines) if lines else ""


def _write_vanishing(table: CoefficientTable) -> str:
    printed, derived = table.printed.vanishing, table.identifiability.vanishing
    if not printed or set(printed) == set(derived):
        return ""
    text = (
        f"Printed: {', '.join(printed)}. Derived, because no coefficient depends on them: "
        f"{', '.join(derived)}.\n"
    )
    strange = sorted(set(printed) - set(table.identifiability.letters))
    text += f"No parameters at all: {', '.join(strange)}.\n" if strange else ""
    return f"### Parameters without effect\n\n{text}"


def _write_friction(table: CoefficientTable) -> str:
    coupling = table.printed.coupling
    if coupling is None:
        return ""
    check = check_friction(coupling)

    def format_row(values: tuple[Fraction, ...]) -> str:
        return ", ".join(f"{float(value):g}" for value in values)

    matrix = "; ".join(map(format_row, coupling.motor_from_joint))
    intro = (
        "Printed: G_ii C_i sgn(qd_i), C being diagonal. Virtual work: (G^T C sgn(G qd))_i, "
        "with the motor speeds G qd; friction must take sum C_i |(G qd)_i|.\n\n"
        f"With G = [{matrix}], C = ({format_row(coupling.coulomb)}) N m, qd = "
        f"({format_row(coupling.speed)}) rad/s the motors take {float(check.dissipated):g} W:"
    )
    rows = [("printed", check.printed, check.printed_power)]
    rows += [("derived", check.derived, check.derived_power)]
    lines = [f"| {name} | {format_row(x)} | {float(power):g} |" for name, x, power in rows]
    heads = ["| | joint torques, N m | power, W |", "|---|---|---|"]
    return _format_section("### Friction of coupled motors", intro, [*heads, *lines])


def _write_twin(table: CoefficientTable) -> str:
    if not table.printed.twin:
        return ""
    check = check_twin(table)
    first, second = get_example_values(table), get_example_values(table, twin=True)
    intro = (
        f"These two differ in {len(check.changed)} parameters; **{check.equal} of "
        f"{len(table.coefficients)}** coefficients are equal, in exact arithmetic."
        + ("" if check.different else " No motion distinguishes them.")
    )
    heads = ["| parameter | first | second |", "|---|---|---|"]
    lines = [f"| {name} | {first.get(name, 0)} | {second[name]} |" for name in check.changed]
    title = "### Two different robots with the same torques"
    return _format_section(title, intro, [*heads, *lines])


_WIDTH = 96


def write_terms_report(model: SymbolicModel, base: BaseParameters) -> str:
    """Writes the page as Markdown: functions, relations, map, print, all coefficients.

    Raises:
        DerivationError: the robot has no closed form worth printing.
        RobotError: `[terms]` or `[physical]` of the robot file is wrong.
    """
    table = build_coefficient_table(model, base)
    parts = [_write_head(table), _write_functions(table), _write_relations(model, table)]
    parts += [_write_map(table), *write_print_sections(table)]
    parts.append("## All coefficients\n\n" + format_coefficients(table, "markdown"))
    return "\n".join(parts)


def _write_head(table: CoefficientTable) -> str:
    closed, source = table.closed, table.printed.source
    factor, sign = "", closed.gravity_factor
    if sign:
        factor = f" Gravity torques are {sign} times g_i."
    lines = [
        "All formulas and numbers below are computed from the robot file when this page is made; "
        "only what is called printed is quoted.\n",
        f"`{format_equation(closed)}`\n",
        "J is the inertia matrix (symmetric), S_ijk (j <= k) the full coefficient of qd_j qd_k; s "
        f"and c are sine and cosine of a joint angle.{factor} Functions not listed are zero.\n",
        *([f"Source of the print: {source}.\n"] if source else []),
    ]
    return "\n".join([f"# Coefficients of the closed form: {closed.robot.title}\n", *lines])


def _write_functions(table: CoefficientTable) -> str:
    lines = ["## The functions", "", "```text"]
    for function, coefficients in collect_by_function(table):
        terms = [c.name if c.monomial == "1" else f"{c.name}*{c.monomial}" for c in coefficients]
        line = f"{function.name} = {terms[0] if terms else ''}"
        for piece in (f" + {term}" for term in terms[1:]):
            if len(line) + len(piece) > _WIDTH:
                lines.append(line)
                line = "     "
            line += piece
        lines.append(line)
    return "\n".join([*lines, "```", ""])


def _describe_fewest_monomials(model: SymbolicModel) -> list[str]:
    """How many monomials the free choice of squares needs, where a paper's choice is followed."""
    if "keep_sine_squares" not in model.robot.terms:
        return []
    robot = dataclasses.replace(model.robot, terms={})
    count = derive_closed_form(dataclasses.replace(model, robot=robot)).monomial_count
    return [
        f"* The squares of sines and cosines are those of the print; the best choice per function "
        f"and joint needs {count} monomials."
    ]


def _write_relations(model: SymbolicModel, table: CoefficientTable) -> str:
    seen, relations = table.identifiability, table.relations
    kinds = {"gravity": 0, "inertia": 0, "christoffel": 0}
    for function in table.closed.functions:
        kinds[function.kind] += len(function.terms)
    appearing, rank = len(seen.appearing), seen.jacobian_rank
    lines = [
        "## Relations",
        "",
        f"* {' + '.join(map(str, kinds.values()))} = "
        f"**{len(table.coefficients)}** coefficients (gravity, inertia matrix, Christoffel). Up to "
        f"constant factors they are {len(partition_by_ratio(relations))} different functions of "
        "the parameters.",
        *_describe_fewest_monomials(model),
        f"* Rank over Q, exact, with all lengths unknown: **{relations.rank}**; the first that are "
        "independent stand in the map below.",
        f"* Rank with the geometry known: {len(table.known_geometry)}; base parameters: "
        f"{table.base.rank}.",
        f"* {len(seen.letters)} physical parameters, of which {appearing} appear. The "
        f"{len(seen.vanishing)} without effect on any torque: "
        f"**{', '.join(seen.vanishing) or 'none'}**.",
    ]
    if seen.sums:
        groups = [[(Fraction(v), k) for k, v in group.items()] for group in seen.sums]
        sums = ", ".join(f"`{format_signed_sum(group)}`" for group in groups)
        lines.append(f"* Only together: {sums}.")
    lines.append(
        f"* Generic rank of d coefficients / d parameters, over the {appearing} that appear: "
        f"**{rank}** (modulo a prime at {seen.points} random points, seed {seen.seed}). So at "
        f"least {appearing - rank} of the {appearing} must be known to find the others.\n"
    )
    return "\n".join(lines)


def _write_map(table: CoefficientTable) -> str:
    lines = ["## Map to the base parameters", ""]
    grouped = [format_relation(p) for p in table.base.parameters if p.terms[1:]]
    if grouped:
        lines += ["Grouped parameters:", "", "```text", *grouped, "```", ""]
    lines += ["```text", *format_forward_map(table), "```", ""]
    determinant = format_determinant(table)
    rows, columns = len(table.map.rows), len(table.map.columns)
    if determinant is None:
        why = "not square" if rows != columns else "its determinant too long to print"
        lines.append(f"This map is {rows} x {columns}, {why}.")
    else:
        lines.append(f"Determinant of this {rows} x {rows} map: **{determinant}**.")
        lines += ["", "Backwards:", "", "```text", *format_backward_map(table), "```"]
    return "\n".join([*lines, ""])
