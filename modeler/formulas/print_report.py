"""Where a paper's print is wrong, and how one sees it."""

import dataclasses
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from modeler.derivation import BaseParameters, SymbolicModel, format_relation
from modeler.formulas.closed_form import derive_closed_form
from modeler.formulas.coefficients import (
    CoefficientTable,
    build_coefficient_table,
    collect_by_function,
)
from modeler.formulas.print_checks import (
    STATE,
    build_exact_state,
    check_independent,
    check_solutions,
    check_twin,
    compute_power_balance,
    find_wrong_definitions,
    find_wrong_functions,
    get_example_values,
)
from modeler.formulas.printed import Coupling
from modeler.formulas.render import (
    coefficients_markdown,
    format_backward_map,
    format_determinant,
    format_equation,
    format_forward_map,
)
from modeler.formulas.ring import partition_by_ratio
from modeler.formulas.text import format_signed_sum

# Coulomb friction of motors that turn with several joints: a printed term and virtual work.


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
    motor = G @ qd
    printed, derived = np.diag(G) * C * _compute_signs(qd), G.T @ (C * _compute_signs(motor))
    return FrictionCheck(
        tuple(printed), tuple(derived), qd @ printed, C @ np.abs(motor), qd @ derived
    )


def _compute_signs(values: np.ndarray) -> np.ndarray:
    return (values > 0).astype(int) - (values < 0).astype(int)


def write_print_sections(table: CoefficientTable) -> list[str]:
    """Writes the sections about the print; none if the robot file quotes none."""
    printed = table.printed
    quoted = (printed.functions, printed.definitions, printed.solutions, printed.independent)
    if not any(quoted):
        return []
    sections = [
        "## Where the print is wrong, and how one sees it\n",
        _write_independent(table),
        _write_definitions(table),
        _write_function_section(table),
        _write_solutions(table),
        _write_vanishing(table),
    ]
    if printed.coupling is not None:
        sections.append(_write_friction(printed.coupling))
    if printed.twin:
        sections.append(_write_twin(table))
    return [section for section in sections if section]


def _write_independent(table: CoefficientTable) -> str:
    printed, dependent = table.printed.independent, check_independent(table)
    if not dependent:
        return ""
    lines = [
        "### Independent coefficients",
        "",
        f"{len(printed)} are printed as independent; their rank over Q is "
        f"**{len(printed) - len(dependent)}**; that of all {len(table.coefficients)} is "
        f"**{table.relations.rank}**:",
        "",
    ]
    lines += [f"* `{name} = {text}`, identically." for name, text in dependent.items()]
    return "\n".join([*lines, ""])


def _write_definitions(table: CoefficientTable) -> str:
    wrong, count = find_wrong_definitions(table), len(table.printed.definitions)
    lines = [
        "### Definitions",
        "",
        f"{count - len(wrong)} of {count} printed definitions are the derived polynomials. The "
        "others:",
        "",
    ]
    for check in wrong:
        lines.append(
            f"* {check.name}, printed `{check.printed}`: derived minus printed is "
            f"`{check.difference}`."
        )
    derived = {check.letter: check.verdict for check in check_solutions(table)}
    spoilt = [
        check.letter
        for check in check_solutions(table, as_printed=True)
        if derived[check.letter] == "right" != check.verdict
    ]
    if spoilt:
        lines += [
            "",
            "The print contradicts itself: with the printed definitions its own solutions for "
            f"{', '.join(spoilt)} do not return their parameter, with the derived ones they do.",
        ]
    return "\n".join([*lines, ""]) if wrong else ""


def _write_function_section(table: CoefficientTable) -> str:
    wrong = find_wrong_functions(table)
    if not wrong:
        return ""
    lines = ["### Functions", ""]
    count, true = table.printed.count, len(table.coefficients)
    if count is not None and count != true:
        lines += [f"The print counts {count} coefficients, there are **{true}**.", ""]
    lines += [
        "A mechanism keeps its power balance, qd'S = qd' (dM/dt) qd / 2. With the example of the "
        f"robot file at {STATE},"
    ]
    if table.printed.example:
        balance = compute_power_balance(table, build_exact_state(table))
        lines += [f"the derived functions miss it by {balance} W, in exact arithmetic.", ""]
    lines += ["| function | derived minus printed | print misses by |", "|---|---|---|"]
    for check in wrong:
        rest = "; ".join(f"`({text})*{at}`" for at, text in check.difference.items())
        power = "" if check.power_defect is None else f"{float(check.power_defect):.4f} W"
        lines.append(f"| {check.name} | {rest} | {power} |")
    lines += ["", "As printed:", "", "```text"]
    lines += [f"{check.name} = {check.printed}" for check in wrong]
    lines += ["```", ""]
    for name in table.closed.by_name:
        if name not in table.printed.functions:
            coefficient_names = {c.name for c in table.coefficients if c.function == name}
            holders = [
                f for f, text in table.printed.functions.items() if coefficient_names & text.names
            ]
            where = f"; its terms stand in {', '.join(holders)}" if holders else ""
            lines += [f"Without a name of its own in the print: {name}{where}.", ""]
    return "\n".join(lines)


def _write_solutions(table: CoefficientTable) -> str:
    checks = check_solutions(table)
    wrong = [check for check in checks if check.verdict != "right"]
    if not wrong:
        return ""
    lines = [
        "### Solutions for the physical parameters",
        "",
        f"With the derived coefficients put in, {len(checks) - len(wrong)} of {len(checks)} "
        "printed solutions return their parameter. The others:",
        "",
    ]
    for check in wrong:
        why = f"it gives `({check.numerator}) / ({check.denominator})`"
        if check.denominator == "0":
            why = f"the denominator is the zero polynomial, the numerator `{check.numerator}`"
        sign = ", the overall sign is wrong" if check.verdict.startswith("returns") else f": {why}"
        lines.append(f"* {check.letter} = `{check.printed}`: **{check.verdict}**{sign}.")
    return "\n".join([*lines, ""])


def _write_vanishing(table: CoefficientTable) -> str:
    printed, derived = set(table.printed.vanishing), set(table.identifiability.vanishing)
    if not printed or printed == derived:
        return ""
    known = set(table.identifiability.letters)
    strange = sorted(printed - known)
    lines = [
        "### Parameters without effect",
        "",
        f"Printed: {', '.join(table.printed.vanishing)}. Derived, because no coefficient "
        f"depends on them: {', '.join(table.identifiability.vanishing)}.",
    ]
    if strange:
        lines.append(f"No parameters at all: {', '.join(strange)}.")
    return "\n".join([*lines, ""])


def _write_friction(coupling: Coupling) -> str:
    check = check_friction(coupling)

    def format_row(values: tuple[Fraction, ...]) -> str:
        return ", ".join(f"{float(value):g}" for value in values)

    matrix = "; ".join(format_row(line) for line in coupling.motor_from_joint)
    return "\n".join(
        [
            "### Friction of coupled motors",
            "",
            "Printed: G_ii C_i sgn(qd_i), C being diagonal. Virtual work: (G^T C sgn(G qd))_i, "
            "with the motor speeds G qd; friction must take sum C_i |(G qd)_i|.",
            "",
            f"With G = [{matrix}], C = ({format_row(coupling.coulomb)}) N m, qd = "
            f"({format_row(coupling.speed)}) "
            f"rad/s the motors take {float(check.dissipated):g} W:",
            "",
            "| | joint torques, N m | power, W |",
            "|---|---|---|",
            f"| printed | {format_row(check.printed)} | {float(check.printed_power):g} |",
            f"| derived | {format_row(check.derived)} | {float(check.derived_power):g} |",
            "",
        ]
    )


def _write_twin(table: CoefficientTable) -> str:
    check = check_twin(table)
    first, second = get_example_values(table), get_example_values(table, twin=True)
    lines = [
        "### Two different robots with the same torques",
        "",
        f"These two differ in {len(check.changed)} parameters; **{check.equal} of "
        f"{len(table.coefficients)}** coefficients are equal, in exact arithmetic."
        + ("" if check.different else " No motion tells them apart."),
        "",
        "| parameter | first | second |",
        "|---|---|---|",
    ]
    lines += [f"| {name} | {first.get(name, 0)} | {second[name]} |" for name in check.changed]
    return "\n".join([*lines, ""])


# The page about a robot's coefficients, computed while it is written.


_WIDTH = 96


def write_terms_report(model: SymbolicModel, base: BaseParameters) -> str:
    """Writes the page as Markdown: functions, relations, map, print, all coefficients.

    Raises:
        DerivationError: the robot has no closed form worth printing.
        RobotError: `[terms]` or `[physical]` of the robot file is wrong.
    """
    table = build_coefficient_table(model, base)
    parts = [
        _write_head(table),
        _write_functions(table),
        _write_relations(model, table),
        _write_map(table),
    ]
    parts += write_print_sections(table)
    parts.append("## All coefficients\n\n" + coefficients_markdown(table))
    return "\n".join(parts)


def _write_head(table: CoefficientTable) -> str:
    closed = table.closed
    factor = ""
    if closed.gravity_factor:
        factor = f" Gravity torques are {closed.gravity_factor} times g_i."
    lines = [
        f"# Coefficients of the closed form: {closed.robot.title}",
        "",
        "All formulas and numbers below are computed from the robot file when this page is made; "
        "only what is called printed is quoted.",
        "",
        f"`{format_equation(closed)}`",
        "",
        "J is the inertia matrix (symmetric), S_ijk (j <= k) the full coefficient of qd_j qd_k; s "
        f"and c are sine and cosine of a joint angle.{factor} Functions not listed are zero.",
        "",
    ]
    if table.printed.source:
        lines += [f"Source of the print: {table.printed.source}.", ""]
    return "\n".join(lines)


def _write_functions(table: CoefficientTable) -> str:
    lines = ["## The functions", "", "```text"]
    for function, coefficients in collect_by_function(table):
        terms = [c.name if c.monomial == "1" else f"{c.name}*{c.monomial}" for c in coefficients]
        lines += _wrap_terms(f"{function.name} = ", terms)
    return "\n".join([*lines, "```", ""])


def _wrap_terms(head: str, terms: list[str]) -> list[str]:
    lines, line = [], head
    for index, term in enumerate(terms):
        piece = term if index == 0 else f" + {term}"
        if len(line) + len(piece) > _WIDTH:
            lines.append(line)
            line = "     "
        line += piece
    return [*lines, line]


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
    identifiability, relations = table.identifiability, table.relations
    kinds = {"gravity": 0, "inertia": 0, "christoffel": 0}
    for function in table.closed.functions:
        kinds[function.kind] += len(function.terms)
    appearing, rank = len(identifiability.appearing), identifiability.jacobian_rank
    lines = [
        "## Relations",
        "",
        f"* {kinds['gravity']} + {kinds['inertia']} + {kinds['christoffel']} = "
        f"**{len(table.coefficients)}** coefficients (gravity, inertia matrix, Christoffel). Up to "
        f"constant factors they are {len(partition_by_ratio(relations))} different functions of "
        "the "
        "parameters.",
        *_describe_fewest_monomials(model),
        f"* Rank over Q, exact, with all lengths unknown: **{relations.rank}**; the first that are "
        "independent stand in the map below.",
        f"* Rank with the geometry known: {len(table.known_geometry)}; base parameters: "
        f"{table.base.rank}.",
        f"* {len(identifiability.letters)} physical parameters, of which {appearing} appear. The "
        f"{len(identifiability.vanishing)} without effect on any torque: "
        f"**{', '.join(identifiability.vanishing) or 'none'}**.",
    ]
    if identifiability.sums:
        sums = (
            format_signed_sum((Fraction(v), k) for k, v in group.items())
            for group in identifiability.sums
        )
        lines.append(f"* Only together: {', '.join(f'`{text}`' for text in sums)}.")
    lines += [
        f"* Generic rank of d coefficients / d parameters, over the {appearing} that appear: "
        f"**{rank}** (modulo a prime at {identifiability.points} random points, seed "
        f"{identifiability.seed}). So at "
        f"least {appearing - rank} of the {appearing} must be known to find the others.",
        "",
    ]
    return "\n".join(lines)


def _write_map(table: CoefficientTable) -> str:
    lines = ["## Map to the base parameters", ""]
    grouped = [format_relation(p) for p in table.base.parameters if p.terms[1:]]
    if grouped:
        lines += ["Grouped parameters:", "", "```text", *grouped, "```", ""]
    lines += ["```text", *format_forward_map(table), "```", ""]
    determinant, size = format_determinant(table), len(table.map.rows)
    if determinant is None:
        why = (
            "not square" if size != len(table.map.columns) else "its determinant too long to print"
        )
        lines.append(f"This map is {size} x {len(table.map.columns)}, {why}.")
    else:
        lines.append(f"Determinant of this {size} x {size} map: **{determinant}**.")
        lines += ["", "Backwards:", "", "```text", *format_backward_map(table), "```"]
    return "\n".join([*lines, ""])
