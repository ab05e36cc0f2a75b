"""Where a paper's print is wrong, and how one sees it."""

from fractions import Fraction

from modeler.symbolic import SymbolicModel
from modeler.terms.checks import (
    SolutionCheck,
    check_independent,
    check_solutions,
    check_twin,
    projected_motor_torques,
    wrong_definitions,
    wrong_functions,
)
from modeler.terms.coefficients import CoefficientTable
from modeler.terms.friction import check_friction
from modeler.terms.power import STATE, exact_state, example_values, power_balance
from modeler.terms.printed import Coupling


def print_sections(model: SymbolicModel, table: CoefficientTable) -> list[str]:
    """Sections of the page about the print; none if the robot file quotes none."""
    printed = table.printed
    quoted = (printed.functions, printed.definitions, printed.solutions, printed.independent)
    if not any(quoted):
        return []
    sections = [
        "## Where the print is wrong, and how one sees it\n",
        _independent(table),
        _definitions(table),
        _functions(table),
        _solutions(table),
        _vanishing(table),
        _forces(model),
    ]
    if printed.coupling is not None:
        sections.append(_friction(printed.coupling))
    if printed.twin:
        sections.append(_twin(table))
    return [section for section in sections if section]


def _independent(table: CoefficientTable) -> str:
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


def _definitions(table: CoefficientTable) -> str:
    wrong, count = wrong_definitions(table), len(table.printed.definitions)
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


def _functions(table: CoefficientTable) -> str:
    wrong = wrong_functions(table)
    if not wrong:
        return ""
    lines = ["### Functions", ""]
    count, true = table.printed.count, len(table.coefficients)
    if count is not None and count != true:
        lines += [f"The print counts {count} coefficients, there are **{true}**.", ""]
    lines += [
        "A mechanism keeps its power balance, qd'S = qd' (dM/dt) qd / 2. With the example of the "
        f"robot file at {STATE},",
    ]
    if table.printed.example:
        balance = power_balance(table, exact_state(table))
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
            own = {c.name for c in table.coefficients if c.function == name}
            holders = [f for f, text in table.printed.functions.items() if own & text.names]
            where = f"; its terms stand in {', '.join(holders)}" if holders else ""
            lines += [f"Without a name of its own in the print: {name}{where}.", ""]
    return "\n".join(lines)


def _solutions(table: CoefficientTable) -> str:
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
    lines += [f"* {check.letter} = `{check.printed}`: {_explained(check)}" for check in wrong]
    return "\n".join([*lines, ""])


def _explained(check: SolutionCheck) -> str:
    if check.denominator == "0":
        return (
            f"**{check.verdict}**: the denominator is the zero polynomial, the numerator "
            f"`{check.numerator}`."
        )
    if check.verdict.startswith("returns"):
        return f"**{check.verdict}**, the overall sign is wrong."
    return f"**{check.verdict}**: it gives `({check.numerator}) / ({check.denominator})`."


def _vanishing(table: CoefficientTable) -> str:
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


def _forces(model: SymbolicModel) -> str:
    forces = projected_motor_torques(model)
    if all(
        text == f"tau{joint.name}" for text, joint in zip(forces, model.robot.moving, strict=True)
    ):
        return ""
    return "\n".join(
        [
            "### Reactions of the motors",
            "",
            "If every motor torque acted on its own link without reaction on the one below, the "
            "generalised forces would be",
            "",
            "```text",
            *(
                f"F{joint.name} = {text}"
                for joint, text in zip(model.robot.moving, forces, strict=True)
            ),
            "```",
            "",
            "With the reactions they are the motor torques themselves.",
            "",
        ]
    )


def _friction(coupling: Coupling) -> str:
    check = check_friction(coupling)

    def row(values: tuple[Fraction, ...]) -> str:
        return ", ".join(f"{float(value):g}" for value in values)

    matrix = "; ".join(row(line) for line in coupling.motor_from_joint)
    return "\n".join(
        [
            "### Friction of coupled motors",
            "",
            "Printed: G_ii C_i sgn(qd_i), C being diagonal. Virtual work gives "
            "(G^T C sgn(G qd))_i, with the signs of the motor speeds G qd; what friction takes "
            "must be sum C_i |(G qd)_i|.",
            "",
            f"With G = [{matrix}], C = ({row(coupling.coulomb)}) N m, qd = ({row(coupling.speed)}) "
            f"rad/s the motors take {float(check.dissipated):g} W:",
            "",
            "| | joint torques, N m | power, W |",
            "|---|---|---|",
            f"| printed | {row(check.printed)} | {float(check.printed_power):g} |",
            f"| derived | {row(check.derived)} | {float(check.derived_power):g} |",
            "",
        ]
    )


def _twin(table: CoefficientTable) -> str:
    check = check_twin(table)
    first, second = example_values(table), example_values(table, twin=True)
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
