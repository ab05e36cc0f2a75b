"""Robots and what is derived from them: page, tables and figures of a notebook."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.codegen import Derivation
from modeler.core.files import write_atomically
from modeler.core.manifest import EmittedModule, ModuleSpec
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import MathCell, Table
from modeler.derivation import HomeModes, express_as_home, relations
from modeler.robot import JointKind, Robot, build_written_table, describe_parameters
from modeler.runtime import CompiledModel
from modeler.views import page
from modeler.views.figures import draw_robot
from modeler.views.robot_page import build_table_head, build_table_rows, render_robot


def _summarise_robot(robot: Robot) -> str:
    kinds = Counter("passive" if not j.actuated else "actuated" for j in robot.moving_joints)
    joints = ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items()))
    lines = [robot.heading]
    lines.append(
        f"{len(robot.moving_joints)} joints ({joints}), {len(robot.coordinates)} coordinates, "
        f"{len(robot.loops)} loops"
    )
    for use in robot.effects:
        lines.append(f"effect {use.effect}: {', '.join(use.joints)}")
    if robot.symbols:
        symbol_texts = [f"{name} = {value}" for name, value in robot.evaluate_symbols().items()]
        lines.append(f"symbols: {', '.join(symbol_texts)}")
    lines += robot.readings
    return "\n".join(lines)


def _collect_robot_tables(robot: Robot) -> Tables:
    tables = {"mdh": lambda: _tabulate_dh_rows(robot)}
    if robot.parameters:
        tables["parameters"] = lambda: Table.build(
            f"{robot.name}: nominal parameters", "parameter, value [SI]", robot.parameters.items()
        )
    return tables


def _tabulate_dh_rows(robot: Robot) -> Table:
    table = build_written_table(robot)
    antecedent_head = [table.antecedent] if table.antecedent else []
    rows = [
        (
            joint.name,
            *([joint.antecedent] if antecedent_head else []),
            int(joint.actuated),
            int(JointKind(joint.kind)),
            *(cell.expression.text for cell in cells.values()),
        )
        for joint, cells in table.rows
    ]
    units = [f"{letter} [{unit}]" for letter, unit in table.units.items()]
    return Table.build(
        robot.heading,
        ["j", *antecedent_head, "mu", "sigma", *units],
        rows,
        f"{table.step}; sigma 0 revolute, 1 prismatic, 2 fixed; mu 1 actuated",
    )


def _collect_robot_figures(robot: Robot) -> Figures:
    return {"skeleton": lambda: draw_robot(robot)}


def _summarise_derivation(derivation: Derivation) -> str:
    base, robot = derivation.base, derivation.robot
    return "\n".join(
        [
            f"{robot.name}: {len(base.columns)} standard parameters, {base.rank} base parameters "
            f"({_count_kinds(derivation)})",
            f"proof: {base.proof.kind}; rank {base.proof.numeric_rank} in floating point, singular "
            f"values {base.proof.gap[0]:.3g} (last kept) and {base.proof.gap[1]:.1e} "
            "(first dropped)",
            f"no effect: {' '.join(base.unidentifiable) or 'none'}",
        ]
    )


def _collect_derivation_tables(derivation: Derivation) -> Tables:
    return {
        "base": lambda: _tabulate_base_parameters(derivation),
        "standard": lambda: _tabulate_standard_parameters(derivation),
        **_collect_robot_tables(derivation.robot),
    }


def _tabulate_base_parameters(derivation: Derivation) -> Table:
    base, rows = derivation.base, list[tuple[Any, ...]]()
    for parameter in base.parameters:
        left, right = relations.format_relation_latex(parameter).split(" = ", 1)
        column = base.columns[parameter.column]
        rows.append(
            (
                MathCell(parameter.name, left),
                MathCell(relations.format_relation(parameter).split(" = ", 1)[1], right),
                column.unit,
                column.kind.replace("_", " "),
            )
        )
    title = f"{derivation.robot.name}: base parameters"
    return Table.build(title, "base parameter, is, unit, kind", rows)


def _tabulate_standard_parameters(derivation: Derivation) -> Table:
    base = derivation.base
    grouped = {term.parameter: p.name for p in base.parameters for term in p.terms}
    rows = [
        (
            c.name,
            c.unit,
            c.kind.replace("_", " "),
            "no effect" if c.name in base.unidentifiable else grouped.get(c.name, "-"),
        )
        for c in base.columns
    ]
    title = f"{derivation.robot.name}: standard parameters"
    return Table.build(title, "parameter, unit, kind, goes into", rows)


def _summarise_emitted(emitted: EmittedModule) -> str:
    spec, size = emitted.spec, sum(len(text) for text in emitted.files.values())
    count = len(spec.every_function)
    lines = [
        f"C of {spec.robot}: {count} functions in {len(emitted.files)} files, "
        f"{size / 1000:.0f} kB, signature {spec.compute_signature()[:12]}"
    ]
    return "\n".join([*lines, _collect_function_tables(spec)["functions"]().to_text()])


def _collect_emitted_tables(emitted: EmittedModule) -> Tables:
    sizes = [(name, len(text)) for name, text in sorted(emitted.files.items())]
    files = Table.build(f"files of {emitted.spec.robot}", "file, size [bytes]", sizes)
    return {**_collect_function_tables(emitted.spec), "files": lambda: files}


def _collect_function_tables(spec: ModuleSpec) -> Tables:
    rows = [(f.name, f.equation, f.additions, f.multiplications) for f in spec.every_function]
    head = "function, equation, additions, multiplications"
    return {"functions": lambda: Table.build(f"functions of {spec.robot}", head, rows)}


def _summarise_compiled(compiled: CompiledModel) -> str:
    spec = compiled.spec
    joints = ", ".join(f"{joint.name} [{joint.unit}]" for joint in spec.joints)
    return "\n".join(
        [
            f"compiled {spec.robot}: {len(spec.base)} base parameters, "
            f"{len(spec.standard)} standard",
            f"joints in order: {joints}",
            "base parameters in order: " + " ".join(base.name for base in spec.base),
        ]
    )


def _summarise_modes(modes: HomeModes) -> str:
    robot_mode = "none" if modes.stated_index is None else modes.modes[modes.stated_index].letter
    count = len(modes.modes)
    return (
        f"{modes.linkage.robot.name}: {count} assembly mode{'s' if count > 1 else ''}, the "
        f"robot's own: {robot_mode}"
    )


def _collect_modes_tables(modes: HomeModes) -> Tables:
    free = modes.linkage.free
    rows = [
        (mode.letter, mode.singularity_distance, mode.is_within_limits, mode.copy_count, *angles)
        for mode in modes.modes
        for home in [express_as_home(modes.linkage, mode.posture)]
        for angles in [[float(home.get(joint.name, 0.0)) for joint in free]]
    ]
    head = ["mode", "singular value", "within limits", "copies"]
    head += [f"q{joint.name} [{joint.unit}]" for joint in free]
    return {"modes": lambda: Table.build(f"{modes.linkage.robot.name}: assembly modes", head, rows)}


PRESENTATIONS = {
    Robot: Presentation(
        "a robot",
        _summarise_robot,
        _collect_robot_tables,
        _collect_robot_figures,
        document=lambda robot, notes: render_robot(robot),
        files={".toml": lambda path, robot: write_atomically(path, robot.text)},
    ),
    Derivation: Presentation(
        "a derivation",
        _summarise_derivation,
        _collect_derivation_tables,
        lambda d: _collect_robot_figures(d.robot),
    ),
    EmittedModule: Presentation("an emitted module", _summarise_emitted, _collect_emitted_tables),
    CompiledModel: Presentation(
        "a compiled model", _summarise_compiled, lambda m: _collect_function_tables(m.spec)
    ),
    HomeModes: Presentation("a set of assembly modes", _summarise_modes, _collect_modes_tables),
}


# The page of a derivation: table, base parameters with their relations typeset, proof.


def build_derivation_page(
    derivation: Derivation, relation_lines: Sequence[str], agreement: str, source: str
) -> page.Page:
    """Builds the page of a derivation.

    Args:
        derivation: of the robot.
        relation_lines: how joints move each other, in lines.
        agreement: of both derivations, a line.
        source: file or name that the robot was read from.
    """
    robot, base = derivation.robot, derivation.base
    none = ", ".join(base.unidentifiable) or "none"
    formulas = [
        (relations.build_relation_formula(parameter), base.columns[parameter.column].unit)
        for parameter in base.parameters
    ]
    proof = [*relations.format_proof_paragraphs(base.proof), agreement]
    return page.Page(
        title=robot.heading,
        headline=(
            str(len(formulas)),
            f"base parameters of {len(base.columns)} standard parameters; proof: {base.proof.kind}",
        ),
        sections=[
            page.Section("Table", _build_table_blocks(robot, relation_lines)),
            page.Section("Base parameters", [page.FormulaBlock(formulas)]),
            page.Section("Parameters without effect", [page.Paragraph(f"{none}.")]),
            page.Section("Proof", [page.Paragraph(line) for line in proof]),
        ],
        origin=page.Origin(source, next=[f"modeler generate {source} --out {robot.name}_c"]),
        facts=[
            ("Base parameters", _count_kinds(derivation)),
            ("Without effect", f"{len(base.unidentifiable)}"),
        ],
        command="derive",
    )


def _count_kinds(derivation: Derivation) -> str:
    """Of base parameters by the kind of their column."""
    return ", ".join(f"{n} {kind}" for kind, n in derivation.base.count_by_kind().items() if n)


def _build_table_blocks(robot: Robot, relation_lines: Sequence[str]) -> list[page.Block]:
    head = build_table_head(robot)[:-1]
    rows = [(*row.cells, *(text for _, text, _ in row.entries)) for row in build_table_rows(robot)]
    note = (
        f"{build_written_table(robot).step}. Lengths in m, angles in rad. \u03bc 1: actuated. "
        "\u03c3 0 revolute, 1 prismatic, 2 fixed."
    )
    blocks: list[page.Block] = [page.PageTable(head, rows, note, dict.fromkeys(head, "number"))]
    return blocks + [page.Paragraph(line) for line in relation_lines]


def render_relations(result: Mapping[str, Any], robot: Robot) -> str:
    """Renders the base parameters of a result of `modeler derive --json`, as part of a page.

    Each names the rows that it is about, and says what every term is.

    Args:
        result: as JSON has it.
        robot: that was derived.
    """
    words = describe_parameters(robot)
    entries = []
    for entry in result["base"]:
        parameter = relations.parse_base_parameter(entry, robot.has_binary_fractions)
        first, *terms = relations.build_relation_formula(parameter)
        known = [(term.parameter, words.get(term.parameter)) for term in parameter.terms]
        rows = dict.fromkeys(row for _, word in known if word for row in word.rows)
        unit = next((word.unit for _, word in known if word), entry.get("unit", ""))
        term_words = list(zip(terms, known, strict=True))
        entries.append(
            {
                "name": entry["name"],
                "pieces": (first, *terms),
                "unit": unit,
                "rows": " ".join(rows),
                "terms": term_words,
            }
        )
    without = [(name, words.get(name)) for name in result["unidentifiable"]]
    return page.render_template("relations", entries=entries, without=without)
