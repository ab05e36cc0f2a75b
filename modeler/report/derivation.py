"""Robots and what is derived from them: page, tables and figures of a notebook."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.codegen import Derivation
from modeler.core.files import write_atomically
from modeler.core.manifest import Emitted, ModuleSpec
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import MathCell, Table
from modeler.derivation import HomeModes, relations, written
from modeler.report.blocks import Block, FormulaBlock, PageTable, Paragraph
from modeler.report.figures import robot_figure
from modeler.report.page import Origin, Page, Section, render
from modeler.report.robot_page import robot_text, table_head, table_rows
from modeler.robot import JointKind, Robot, parameter_words, written_table
from modeler.runtime import CompiledModel


def _robot_summary(robot: Robot) -> str:
    kinds = Counter("passive" if not j.actuated else "actuated" for j in robot.moving)
    joints = ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items()))
    lines = [robot.heading]
    lines.append(f"{len(robot.moving)} joints ({joints}), {len(robot.coordinates)} coordinates, "
                 f"{len(robot.loops)} loops")  # fmt: skip
    for use in robot.effects:
        lines.append(f"effect {use.effect}: {', '.join(use.joints)}")
    if robot.symbols:
        told = [f"{name} = {value}" for name, value in robot.symbol_values().items()]
        lines.append(f"symbols: {', '.join(told)}")
    lines += robot.readings
    return "\n".join(lines)


def _robot_tables(robot: Robot) -> Tables:
    found = {"mdh": lambda: _mdh(robot)}
    if robot.parameters:
        found["parameters"] = lambda: Table.of(
            f"{robot.name}: nominal parameters", "parameter, value [SI]", robot.parameters.items()
        )
    return found


def _mdh(robot: Robot) -> Table:
    table = written_table(robot)
    given = [table.antecedent] if table.antecedent else []
    rows = [
        (joint.name, *([joint.antecedent] if given else []), int(joint.actuated),
         int(JointKind(joint.kind)), *(cell.expression.text for cell in cells.values()))
        for joint, cells in table.rows
    ]  # fmt: skip
    units = [f"{letter} [{unit}]" for letter, unit in table.units.items()]
    return Table.of(
        robot.heading, ["j", *given, "mu", "sigma", *units], rows,
        f"{table.step}; sigma 0 revolute, 1 prismatic, 2 fixed; mu 1 actuated",
    )  # fmt: skip


def _robot_figures(robot: Robot) -> Figures:
    return {"skeleton": lambda: robot_figure(robot)}


def _derivation_summary(derivation: Derivation) -> str:
    base, robot = derivation.base, derivation.robot
    return "\n".join([
        f"{robot.name}: {len(base.columns)} standard parameters, {base.rank} base parameters "
        f"({_counts(derivation)})",
        f"proof: {base.proof.kind}; rank {base.proof.numeric_rank} in floating point, singular "
        f"values {base.proof.gap[0]:.3g} (last kept) and {base.proof.gap[1]:.1e} (first dropped)",
        f"no effect: {' '.join(base.unidentifiable) or 'none'}",
    ])  # fmt: skip


def _derivation_tables(derivation: Derivation) -> Tables:
    return {
        "base": lambda: _base_table(derivation),
        "standard": lambda: _standard_table(derivation),
        **_robot_tables(derivation.robot),
    }


def _base_table(derivation: Derivation) -> Table:
    base, rows = derivation.base, list[tuple[Any, ...]]()
    for parameter in base.parameters:
        left, right = relations.relation_latex(parameter).split(" = ", 1)
        column = base.columns[parameter.column]
        rows.append((
            MathCell(parameter.name, left),
            MathCell(relations.relation_text(parameter).split(" = ", 1)[1], right),
            column.unit, column.kind.replace("_", " "),
        ))  # fmt: skip
    title = f"{derivation.robot.name}: base parameters"
    return Table.of(title, "base parameter, is, unit, kind", rows)


def _standard_table(derivation: Derivation) -> Table:
    base = derivation.base
    grouped = {term.parameter: p.name for p in base.parameters for term in p.terms}
    rows = [
        (c.name, c.unit, c.kind.replace("_", " "),
         "no effect" if c.name in base.unidentifiable else grouped.get(c.name, "-"))
        for c in base.columns
    ]  # fmt: skip
    title = f"{derivation.robot.name}: standard parameters"
    return Table.of(title, "parameter, unit, kind, goes into", rows)


def _emitted_summary(emitted: Emitted) -> str:
    spec, size = emitted.spec, sum(len(text) for text in emitted.files.values())
    count = len(spec.every_function)
    lines = [f"C of {spec.robot}: {count} functions in {len(emitted.files)} files, "
             f"{size / 1000:.0f} kB, signature {spec.signature()[:12]}"]  # fmt: skip
    return "\n".join([*lines, _functions(spec)["functions"]().text()])


def _emitted_tables(emitted: Emitted) -> Tables:
    sizes = [(name, len(text)) for name, text in sorted(emitted.files.items())]
    files = Table.of(f"files of {emitted.spec.robot}", "file, size [bytes]", sizes)
    return {**_functions(emitted.spec), "files": lambda: files}


def _functions(spec: ModuleSpec) -> Tables:
    rows = [(f.name, f.equation, f.additions, f.multiplications) for f in spec.every_function]
    head = "function, equation, additions, multiplications"
    return {"functions": lambda: Table.of(f"functions of {spec.robot}", head, rows)}


def _compiled_summary(compiled: CompiledModel) -> str:
    spec = compiled.spec
    joints = ", ".join(f"{joint.name} [{joint.unit}]" for joint in spec.joints)
    return "\n".join([
        f"compiled {spec.robot}: {len(spec.base)} base parameters, {len(spec.standard)} standard",
        f"joints in order: {joints}",
        "base parameters in order: " + " ".join(base.name for base in spec.base),
    ])  # fmt: skip


def _modes_summary(found: HomeModes) -> str:
    own = "none" if found.own is None else found.modes[found.own].letter
    count = len(found.modes)
    return (f"{found.linkage.robot.name}: {count} assembly mode{'s' if count > 1 else ''}, the "
            f"robot's own: {own}")  # fmt: skip


def _modes_tables(found: HomeModes) -> Tables:
    free = found.linkage.free
    rows = [
        (mode.letter, mode.sigma, mode.kept, mode.copies,
         *(float(written(found.linkage, mode.posture).get(joint.name, 0.0)) for joint in free))
        for mode in found.modes
    ]  # fmt: skip
    head = ["mode", "singular value", "within limits", "copies"]
    head += [f"q{joint.name} [{joint.unit}]" for joint in free]
    return {"modes": lambda: Table.of(f"{found.linkage.robot.name}: assembly modes", head, rows)}


PRESENTATIONS = {
    Robot: Presentation("a robot", _robot_summary, _robot_tables, _robot_figures,
                        document=lambda robot, notes: robot_text(robot),
                        files={".toml": lambda path, robot: write_atomically(path, robot.text)}),
    Derivation: Presentation("a derivation", _derivation_summary, _derivation_tables,
                             lambda d: _robot_figures(d.robot)),
    Emitted: Presentation("an emitted module", _emitted_summary, _emitted_tables),
    CompiledModel: Presentation("a compiled model", _compiled_summary,
                                lambda m: _functions(m.spec)),
    HomeModes: Presentation("a set of assembly modes", _modes_summary, _modes_tables),
}  # fmt: skip


# The page of a derivation: table, base parameters with their relations typeset, proof.


def derivation_page(
    derivation: Derivation, tied: Sequence[str], agreement: str, given: str
) -> Page:
    """The page of a derivation.

    Args:
        derivation: of the robot.
        tied: how joints move each other, in lines.
        agreement: of both derivations, a line.
        given: file or name that the robot was read from.
    """
    robot, base = derivation.robot, derivation.base
    none = ", ".join(base.unidentifiable) or "none"
    formulas = [(relations.relation_formula(parameter), base.columns[parameter.column].unit)
                 for parameter in base.parameters]  # fmt: skip
    proof = [*relations.proof_paragraphs(base.proof), agreement]
    return Page(
        title=robot.heading,
        headline=(
            str(len(formulas)),
            f"base parameters of {len(base.columns)} standard parameters; proof: {base.proof.kind}",
        ),
        sections=[
            Section("Table", _table(robot, tied)),
            Section("Base parameters", [FormulaBlock(formulas)]),
            Section("Parameters without effect", [Paragraph(f"{none}.")]),
            Section("Proof", [Paragraph(line) for line in proof]),
        ],
        origin=Origin(given, next=[f"modeler generate {given} --out {robot.name}_c"]),
        facts=[("Base parameters", _counts(derivation)),
               ("Without effect", f"{len(base.unidentifiable)}")],
        command="derive",
    )  # fmt: skip


def _counts(derivation: Derivation) -> str:
    """Of base parameters by the kind of their column."""
    return ", ".join(f"{n} {kind}" for kind, n in derivation.base.counts().items() if n)


def _table(robot: Robot, tied: Sequence[str]) -> list[Block]:
    head = table_head(robot)[:-1]
    rows = [(*row.cells, *(text for _, text, _ in row.entries)) for row in table_rows(robot)]
    note = (
        f"{written_table(robot).step}. Lengths in m, angles in rad. \u03bc 1: actuated. "
        "\u03c3 0 revolute, 1 prismatic, 2 fixed."
    )
    blocks: list[Block] = [PageTable(head, rows, note, dict.fromkeys(head, "number"))]
    return blocks + [Paragraph(line) for line in tied]


def relations_html(result: Mapping[str, Any], robot: Robot) -> str:
    """The base parameters of a result of `modeler derive --json`, typeset, as a part of a page.

    Each names the rows that it is about, and says what every term is.

    Args:
        result: as JSON has it.
        robot: that was derived.
    """
    words = parameter_words(robot)
    entries = []
    for entry in result["base"]:
        parameter = relations.from_json(entry, robot.halves)
        first, *terms = relations.relation_formula(parameter)
        known = [(term.parameter, words.get(term.parameter)) for term in parameter.terms]
        rows = dict.fromkeys(row for _, word in known if word for row in word.rows)
        unit = next((word.unit for _, word in known if word), entry.get("unit", ""))
        told = list(zip(terms, known, strict=True))
        entries.append({"name": entry["name"], "pieces": (first, *terms), "unit": unit,
                        "rows": " ".join(rows), "terms": told})  # fmt: skip
    without = [(name, words.get(name)) for name in result["unidentifiable"]]
    return render("relations", entries=entries, without=without)
