"""Dynamics in closed form by composite bodies, abbreviated, and what formulas need of a model."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations_with_replacement, product

import sympy

from modeler.derivation import (
    BaseParameters,
    Composite,
    Expr,
    Geometry,
    GeometryRow,
    Graph,
    GraphAlgebra,
    Screw,
    ShaftColumn,
    SymbolicModel,
    Vector,
    compute_frame_gravity,
    compute_screws,
    count_quarter_turns,
    cross,
    derive_effect_entries,
    dot,
    is_in_block,
    plus,
    project_wrench,
)
from modeler.effects import EnergyBlock
from modeler.formulas.function_sheet import Sheet, SheetWriter


def copy_model(model: SymbolicModel) -> SymbolicModel:
    """Returns the same model on another graph, which knows the sines of sums over parallel axes.

    Lengths, gravity, speeds times these sines are known too: the recursions multiply by them first.
    The graph of `model` is left as it is: emitted code would read these sines otherwise.
    """
    formula_model = replace(model.rigid, graph=Graph())
    graph, geometry = formula_model.graph, formula_model.geometry
    graph.tables |= model.graph.tables
    lengths = {x for row in geometry.rows for x in (row.b, row.d, row.r)} | {*geometry.gravity}
    factors = [formula_model.algebra.static(x) for x in sorted(lengths, key=str) if not x.is_Number]
    factors += formula_model.get_inputs("qd") + formula_model.get_inputs("qdd")
    for angle in _collect_angles(geometry, formula_model.algebra):
        for turned in (graph.call("cos", angle), graph.call("sin", angle)):
            for factor in factors:
                graph.lift(factor * turned)
    return formula_model


def collect_symbol_names(model: SymbolicModel, parameters: Mapping[int, str]) -> dict[str, str]:
    """Returns {symbol of the graph: its text}: positions, speeds, signals, named columns."""
    symbol_names = {name: name for name in model.geometry.values}
    for k, joint in enumerate(model.robot.free_joints):
        symbol_names |= {f"{kind}[{k}]": f"{kind}{joint.name}" for kind in ("q", "qd", "qdd")}
    symbol_names |= {f"beta[{column}]": name for column, name in parameters.items()}
    return symbol_names | {f"s[{k}]": letter for k, letter in enumerate(get_signal_letters(model))}


def get_signal_letters(model: SymbolicModel) -> list[str]:
    """Returns the letters of the signals that effects read besides the motion: t1, T2, z3."""
    kinds = {"time": "t", "temperature": "T", "slip": "z", "direction": "w"}
    kinds |= {"since": "r", "followed": "x", "lag": "z", "bouc_wen": "z"}
    kinds |= {"windup": "e", "windup_rate": "ed", "windup_acceleration": "edd"}
    return [f"{kinds[signal.kind]}{k + 1}" for k, signal in enumerate(model.signals)]


def get_base_columns(base: BaseParameters) -> dict[int, str]:
    """Returns {column: the base parameter that has it}."""
    return {parameter.column: parameter.name for parameter in base.parameters}


def build_effects_sheet(model: SymbolicModel, parameters: Mapping[int, str]) -> Sheet:
    """Returns the sheet of `write_effects` alone, for the parameters of those columns."""
    model = copy_model(model)
    letters = collect_symbol_names(model, parameters)
    writer = SheetWriter(model.graph, letters, model.robot.has_binary_fractions)
    write_effects(model, parameters, writer)
    return writer.build_sheet()


def create_parameter_symbols(model: SymbolicModel, columns: Iterable[int]) -> dict[int, Expr]:
    """Returns {column: the symbol of its parameter}."""
    return {column: model.graph.symbol(f"beta[{column}]") for column in columns}


def write_effects(model: SymbolicModel, columns: Iterable[int], writer: SheetWriter) -> None:
    """Writes e<i>, the torques of effects along the free variables; rotor inertias are in J."""
    total = [model.graph.constant(0)] * len(model.robot.free_joints)
    for place, value in create_parameter_symbols(model, columns).items():
        for part in model.columns[place].parts:
            if isinstance(part, ShaftColumn) and not is_in_block(part, EnergyBlock.KINETIC):
                for k, entry in derive_effect_entries(model, part).items():
                    total[k] = total[k] + value * entry
    writer.open_section("friction, offsets and other effects")
    for joint, entry in zip(model.robot.free_joints, total, strict=True):
        writer.add_result(f"e{joint.name}", entry)


def _collect_angles(geometry: Geometry, algebra: GraphAlgebra) -> list[Expr]:
    """Angles of the rows that turn, and those between frames whose z axes are parallel."""
    angles: list[Expr] = []
    for k, row in enumerate(geometry.rows):
        angle = _extract_angle(row, algebra)
        angles.append(angle)
        at, sign = k, _compare_z_axes(row)
        while sign and (parent := geometry.rows[at].parent) is not None:
            at = parent
            before = _extract_angle(geometry.rows[at], algebra)
            angle = angle + (before if sign > 0 else -before)
            angles.append(angle)
            sign *= _compare_z_axes(geometry.rows[at])
    return angles


def _compare_z_axes(row: GeometryRow) -> int:
    """1 if z is parallel to that of the antecedent, -1 if opposite, 0 if neither."""
    quarters = row.alpha / (sympy.pi / 2)
    return {0: 1, 2: -1}.get(int(quarters) % 4, 0) if quarters.is_Integer else 0


def _extract_angle(row: GeometryRow, algebra: GraphAlgebra) -> Expr:
    """Rate * q and constant of a row that turns, right angles left out."""
    angle = algebra.graph.constant(0)
    if row.index is not None and row.joint.is_revolute:
        q = algebra.combine_variable("q", row)
        angle = q if row.rate > 0 else -q
    for constant in (row.theta, row.gamma):
        _, rest = count_quarter_turns(constant)
        if rest:
            angle = angle + algebra.static(rest)
    return angle


def format_function_name(letter: str, joints: Sequence[str]) -> str:
    """Returns name of a function: "J12"; "J1_12" where a joint's name has several characters."""
    return letter + ("" if all(len(name) == 1 for name in joints) else "_").join(joints)


_INERTIA = (("XX", 0, 0), ("XY", 0, 1), ("XZ", 0, 2), ("YY", 1, 1), ("YZ", 1, 2), ("ZZ", 2, 2))


_AXES = "xyz"


Triple = tuple[int, int, int]


@dataclass(frozen=True)
class _TreeQuantities:
    """Tree quantities by the index of the row's variable, zeros left out.

    Attributes:
        inertia: {(i, k): J_ik}, i <= k.
        turned: {(i, j, k): A_ijk}, i <= j <= k.
        carried: {(i, j, k): B_ijk}.
        gravity: {i: g_i}.
    """

    inertia: Mapping[tuple[int, int], Expr]
    turned: Mapping[Triple, Expr]
    carried: Mapping[Triple, Expr]
    gravity: Mapping[int, Expr]


def write_short_form(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """Writes J_ij (i <= j), S_ijk (j <= k), g_i and e_i by composite bodies.

    Where all joints are free, S_kij = -S_jik and S_kii = -S_iik/2 spare their lines.
    """
    beta = create_parameter_symbols(model, get_base_columns(base))
    bodies = _build_composites(model, beta, writer)
    rows = _derive_tree_quantities(model, bodies, writer)
    names = [joint.name for joint in model.robot.free_joints]
    shafts = _collect_shaft_inertias(model, beta)
    if model.geometry.has_relations:
        _write_tied(model, rows, shafts, names, writer)
    else:
        _write_chain(rows, shafts, names, writer)
    write_effects(model, beta, writer)


def _build_composites(
    model: SymbolicModel, beta: Mapping[int, Expr], writer: SheetWriter
) -> list[Composite]:
    """Every link with all that it carries, in its frame."""
    zero = model.graph.constant(0)
    links = [Composite(p, zero) for p in model.collect_link_parameters(beta)]
    rows = model.geometry.rows
    for k in reversed(range(len(links))):
        body, name = links[k], rows[k].joint.name
        writer.open_section(f"link {name} and all that it carries, in frame {name}")
        writer.propose_quantity(f"M{name}c", body.M)
        for axis, moment in zip("XYZ", body.MS, strict=True):
            writer.propose_quantity(f"M{axis}{name}c", moment)
        for prefix, i, j in _INERTIA:
            writer.propose_quantity(f"{prefix}{name}c", body.J[i][j])
        parent = rows[k].parent
        if parent is not None:
            links[parent].add_composite(body, model.frames[k])
    return links


def _derive_tree_quantities(
    model: SymbolicModel, bodies: Sequence[Composite], writer: SheetWriter
) -> _TreeQuantities:
    """J, A, B and g of the rows that move."""
    geometry = model.geometry
    down = compute_frame_gravity(geometry, model.frames, model.algebra)
    inertia: dict[tuple[int, int], Expr] = {}
    turned: dict[Triple, Expr] = {}
    carried: dict[Triple, Expr] = {}
    gravity: dict[int, Expr] = {}
    everything = compute_screws(geometry, model.frames, model.algebra)
    for row, body, g, chain in zip(geometry.rows, bodies, down, everything, strict=True):
        name, k = row.joint.name, row.index
        if k is None:
            continue
        writer.open_section(f"axes and gravity in frame {name}")
        for i, screw in sorted(chain.items()):
            other = geometry.robot.moving_joints[i].name
            propose_vector(writer, f"e{other}{{}}_{name}", screw.e)
            propose_vector(writer, f"m{other}{{}}_{name}", screw.m)
        propose_vector(writer, f"g{{}}_{name}", g)
        f, n = body.compute_momentum(row)
        pull = cross(body.MS, g)
        gravity[k] = -project_wrench(chain[k], [x * body.M for x in g], pull)
        for i, j in combinations_with_replacement(sorted(chain), 2):
            slope = _derive_inertia_slope(body, chain[i], chain[j], row.joint.is_revolute)
            turned[i, j, k] = slope * row.rate
            if j == k:
                inertia[i, k] = project_wrench(chain[i], f, n)
            if i < j:
                a, b = chain[j], chain[i]  # a x b: how screw b changes while all turns by a
                moved = Screw(cross(a.e, b.e), plus(cross(a.e, b.m), cross(a.m, b.e)))
                carried[i, j, k] = -project_wrench(moved, f, n)
    return _TreeQuantities(inertia, turned, carried, gravity)


def propose_vector(writer: SheetWriter, pattern: str, vector: Vector) -> None:
    """Proposes the pattern with x, y, z in its braces for the entries."""
    for axis, entry in zip(_AXES, vector, strict=True):
        writer.propose_quantity(pattern.format(axis), entry)


def _derive_inertia_slope(body: Composite, a: Screw, b: Screw, angular: bool) -> Expr:
    """a . (dI/dq) b, where the body turns about z or moves along it."""
    zero = body.M * 0
    x, y, z = body.MS
    J = body.J
    if angular:
        moments = [-y, x, zero]
        slope = [
            [-2 * J[0][1], J[0][0] - J[1][1], -J[1][2]],
            [J[0][0] - J[1][1], 2 * J[0][1], J[0][2]],
            [-J[1][2], J[0][2], zero],
        ]
    else:
        moments = [zero, zero, body.M]
        slope = [[2 * z, zero, -x], [zero, 2 * z, -y], [-x, -y, zero]]
    total: Expr = dot(a.e, [dot(line, b.e) for line in slope])
    return total + dot(moments, plus(cross(a.m, b.e), cross(b.m, a.e)))


def _collect_shaft_inertias(
    model: SymbolicModel, beta: Mapping[int, Expr]
) -> dict[tuple[int, int], Expr]:
    """Inertia that turns with shafts: {(i, j): value}, i <= j, of free variables."""
    sums: dict[tuple[int, int], Expr] = {}
    for place, value in beta.items():
        for part in model.columns[place].parts:
            if is_in_block(part, EnergyBlock.KINETIC):
                for i, j in combinations_with_replacement(sorted(part.shaft), 2):
                    added = value * (part.shaft[i] * part.shaft[j])
                    sums[i, j] = sums.get((i, j), model.graph.constant(0)) + added
    return sums


def _write_chain(
    rows: _TreeQuantities,
    shafts: Mapping[tuple[int, int], Expr],
    names: Sequence[str],
    writer: SheetWriter,
) -> None:
    """Results where every joint is free."""
    writer.open_section("inertia matrix, J_ji = J_ij")
    for (i, k), value in sorted(rows.inertia.items()):
        total = value + shafts[i, k] if (i, k) in shafts else value
        writer.add_result(format_function_name("J", [names[i], names[k]]), total)
    title = "Christoffel coefficients; S_kij = -S_jik and S_kii = -S_iik/2 for i <= j <= k"
    writer.open_section(title)
    for i, j, k in sorted(rows.turned):
        A, B = rows.turned[i, j, k], rows.carried.get((i, j, k))
        x, y, z = names[i], names[j], names[k]
        if B is None or j == k:
            writer.add_result(format_function_name("S", [x, y, z]), A)
            continue
        writer.propose_quantity(format_function_name("A", [x, y, z]), A)
        writer.propose_quantity(format_function_name("B", [x, y, z]), B)
        writer.add_result(format_function_name("S", [x, y, z]), A + B)
        writer.add_result(format_function_name("S", [y, x, z]), A - B)
    writer.open_section("gravity")
    for i, value in sorted(rows.gravity.items()):
        writer.add_result(format_function_name("g", [names[i]]), value)


def _write_tied(
    model: SymbolicModel,
    rows: _TreeQuantities,
    shafts: Mapping[tuple[int, int], Expr],
    names: Sequence[str],
    writer: SheetWriter,
) -> None:
    """Results along the free joints: J_u = E' J E, and so on."""
    moving = [joint.name for joint in model.robot.moving_joints]
    writer.open_section("as if every joint were free")
    for letter, entries in (("T", rows.inertia), ("A", rows.turned), ("B", rows.carried)):
        for place, value in sorted(entries.items()):
            writer.propose_quantity(format_function_name(letter, [moving[i] for i in place]), value)
    forms, zero = model.geometry.forms, model.graph.constant(0)
    inertia: dict[tuple[int, int], Expr] = dict(shafts)
    for (i, k), value in rows.inertia.items():
        for at in [(i, k)] if i == k else [(i, k), (k, i)]:
            for (a, x), (b, y) in product(forms[at[0]].items(), forms[at[1]].items()):
                if a <= b:
                    inertia[a, b] = inertia.get((a, b), zero) + value * (x * y)
    writer.open_section("inertia matrix, J_ji = J_ij")
    for at, value in sorted(inertia.items()):
        writer.add_result(format_function_name("J", [names[i] for i in at]), value)
    writer.open_section("Christoffel coefficients")
    for triple, value in sorted(_combine_christoffel(model, rows).items()):
        writer.add_result(format_function_name("S", [names[i] for i in triple]), value)
    writer.open_section("gravity")
    for a, name in enumerate(names):
        total = zero
        for i, value in rows.gravity.items():
            total = total + value * forms[i].get(a, Fraction(0))
        writer.add_result(format_function_name("g", [name]), total)


def _combine_christoffel(model: SymbolicModel, rows: _TreeQuantities) -> dict[Triple, Expr]:
    """S_abc, b <= c: sums over the rows of half the tree's coefficients, both orders of b, c."""
    forms, zero = model.geometry.forms, model.graph.constant(0)
    coefficients: dict[Triple, Expr] = {}
    for triple, value in _derive_christoffel_symbols(rows).items():
        for (a, x), (b, y), (c, z) in product(*(forms[i].items() for i in triple)):
            if b <= c:
                at, twice = (a, b, c), 1 if b == c else 2
                coefficients[at] = coefficients.get(at, zero) + value * (x * y * z * twice)
    return coefficients


def _derive_christoffel_symbols(rows: _TreeQuantities) -> dict[Triple, Expr]:
    """Christoffel symbols of the tree, {(i, j, k): [jk, i]}, both orders of j and k."""
    symbols: dict[Triple, Expr] = {}
    half = Fraction(1, 2)
    for (i, j, k), A in rows.turned.items():
        B = rows.carried.get((i, j, k))
        plus_, minus = (A * half, A * half) if B is None else ((A + B) * half, (A - B) * half)
        for at, value in (((i, j, k), plus_), ((j, i, k), minus), ((k, i, j), -minus)):
            symbols[at] = value
            symbols[at[0], at[2], at[1]] = value
    return symbols
