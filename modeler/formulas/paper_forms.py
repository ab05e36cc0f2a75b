"""The model of a parallel robot in blocks: Jacobians, columns of motors, legs and platform.

Guegan, Khalil and Lemoine 2003, eqs. 1, 2 and 23 to 30, for every robot whose legs stand alone once
the platform is given. With V the speeds of the platform's coordinates and qd_i those of leg i,

    qd_i = J_i^-1 V,    Ld = J_p^-1 V,
    tau = D_m K + J_p^T (W_P + sum_i J_i^-T D_Li) K,

where a column of D_m acts on a motor alone, D_Li are torques of leg i as if its end were free, and
J_p^T W_P = D_P. Equal power carries torques of a leg to the platform and from there to the motors:
F^T qd_i = G^T V = G^T J_p Ld for all V, so G = J_i^-T F and tau = J_p^T G.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
from sympy.polys.domains import QQ
from sympy.polys.fields import field

from modeler.core.errors import RobotError
from modeler.core.expression import Expression
from modeler.derivation import (
    OPERATIONS,
    BaseParameters,
    Expr,
    LinkColumn,
    Plan,
    SymbolicModel,
    Vector,
    combine_along_shaft,
    compute_base_poses,
    cross,
    dot,
    evaluate_regressor,
    is_in_block,
    plus,
    replace_square,
    times,
)
from modeler.effects import EnergyBlock
from modeler.formulas.function_sheet import VECTOR, SheetWriter
from modeler.formulas.physical import get_physical_link, move_to_origin
from modeler.formulas.regressor_form import (
    Equation,
    compute_cofactor,
    find_connected_blocks,
    invert_matrix,
    multiply_rows,
    propose_motion,
)
from modeler.formulas.ring import evaluate_polynomial
from modeler.formulas.short_form import (
    collect_symbol_names,
    copy_model,
    format_function_name,
    get_base_columns,
    propose_vector,
)
from modeler.formulas.thresholds import THRESHOLDS

_PRINTED = 3
"""Legs of the paper, one equation each."""

Matrix = Mapping[tuple[str, str], Expr]
"""{(row, column): entry}; what is not there is 0."""


@dataclass(frozen=True, eq=False)
class LegBlock:
    """One matrix block in the paper's equations of a robot with legs.

    Attributes:
        name: "J1inv", "Jpinv", "Jp", "WP", "Dm1" or "DL1": the paper's, in letters of a program.
        told: its equation in the paper, and what it is.
        rows, columns: joints, coordinates of the platform or base parameters, in order.
        entries: that are not 0.
    """

    name: str
    description: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    entries: Matrix

    @property
    def heading(self) -> str:
        """Returns what the block is, its size, its rows and columns."""
        size = f"{len(self.rows)} x {len(self.columns)}"
        sides = f"rows {' '.join(self.rows)}; columns {' '.join(self.columns)}"
        return f"{self.name}, {self.description}: {size}, {sides}"


def derive_block_form(model: SymbolicModel, base: BaseParameters) -> Equation:
    """Returns the blocks as formulas, entry after entry, with the words that put them together.

    Raises:
        RobotError: the robot has no platform, or its legs do not stand alone.
    """
    model = copy_model(model)
    letters = collect_symbol_names(model, get_base_columns(base))
    writer, proposed = SheetWriter(model.graph, letters, model.robot.has_binary_fractions), False
    blocks = derive_leg_blocks(model, base, writer)
    for block in blocks:
        if block.name[0] != "J" and not proposed:
            propose_motion(model, writer)
            proposed = True
        writer.open_section(block.heading)
        for (row, column), entry in block.entries.items():
            writer.add_result(f"{block.name}_{row}_{column}", entry)
    return Equation(_describe_blocks(base, blocks), writer.build_sheet(), ())


def _describe_blocks(base: BaseParameters, blocks: Sequence[LegBlock]) -> tuple[str, ...]:
    """How the blocks make the regressor."""
    known = {block.name: block for block in blocks}
    motors, V = known["Jpinv"].rows, known["Jpinv"].columns
    n, legs = len(motors), [name[2:] for name in known if name.startswith("DL")]
    wide = {name: len(block.columns) for name, block in known.items()}
    parts = ["DP"] * ("WP" in known) + [f"DB{k}" for k in legs]
    words = [
        "equations as numbered by Guegan, Khalil and Lemoine 2003; <block>_<row>_<column>, what is "
        f"not listed is 0; V = ({', '.join(f'qd{p}' for p in V)}), Ld = "
        f"({', '.join(f'qd{a}' for a in motors)})",
        f"(23) tau = DBrob KBrob, DBrob = [{' '.join(parts)}]: {n} x {base.rank}",
        "(24) Hi = [Dmi on the motor's row, else 0 | DLi] KBi: torques of leg i, its end free",
    ]
    if "WP" in known:
        words.append(f"(26) DP = Jp^T WP: {n} x {wide['WP']}")
    for number, k in enumerate(legs, 27):
        drive = known.get(f"Dm{k}")
        motor_part = f"Dm{k} on row {' '.join(drive.rows)}, else 0 | " if drive else ""
        size = f"{n} x {wide.get(f'Dm{k}', 0) + wide[f'DL{k}']}"
        equation = f"({number}) " if len(legs) == _PRINTED else ""
        words.append(f"{equation}DB{k} = [{motor_part}Jp^T J{k}^-T DL{k}]: {size}")
    shared = {c for k in legs for c in known[f"DL{k}"].columns}
    if len(shared) < sum(wide[f"DL{k}"] for k in legs):
        words.append(
            f"(30) legs alike: Dsym = [DP | Dmi on the rows of their motors | DLS]: {n} x "
            f"{base.rank}, DLS = Jp^T sum_i (Ji^-T DLi): {n} x {len(shared)}"
        )
    if len(legs) == _PRINTED:
        words.append(
            "Ji^-T, where eqs. (27) to (30) have Ji^T in the scan: equal power, F^T qdi = G^T V "
            "for all V with qdi = Ji^-1 V, makes G = Ji^-T F"
        )
    if "Jp" not in known:
        words.append("Jp, the inverse of Jpinv, is too large to write")
    return tuple(words)


def derive_leg_blocks(
    model: SymbolicModel, base: BaseParameters, writer: SheetWriter
) -> list[LegBlock]:
    """Derives inverse Jacobians of the legs, their inverse, W_P, D_m and D_L.

    Raises:
        RobotError: as `derive_block_form`.
    """
    closure, robot = model.closure, model.robot
    if closure is None or not closure.platform:
        raise RobotError(
            f"--blocks: {robot.name} has no platform that its legs meet; blocks of legs and "
            "platform are those of a parallel robot; leave --blocks out"
        )
    names = [joint.name for joint in robot.free_joints]
    V, motors = [names[p] for p in closure.platform], [names[a] for a in closure.actuated]
    legs, blocks = find_connected_blocks(closure, closure.platform, len(names)), list[LegBlock]()
    rates: dict[int, list[Expr]] = {}
    entries = [entry for line in closure.jacobian for entry in line]
    values, write_expression = _convert_to_fractions(entries)
    for k, (equations, unknown) in enumerate(legs, 1):
        if not 0 < len(unknown) <= THRESHOLDS.max_block_equations:
            raise RobotError(
                f"--blocks: leg {k} of {robot.name} has {len(unknown)} unknown speeds where the "
                f"platform is given; expected {THRESHOLDS.max_block_equations} at most; leave "
                "--blocks out"
            )
        lines = [closure.jacobian[r] for r in equations]
        sides = (unknown, closure.platform)
        B, A = ([[values[line[u].ref] for u in at] for line in lines] for at in sides)
        cofactors = [[compute_cofactor(B, i, j) for j in range(len(B))] for i in range(len(B))]
        size = multiply_rows(B[0], cofactors[0])
        for j, u in enumerate(unknown):
            line = [row[j] for row in cofactors]
            speeds = (-multiply_rows(line, [a[p] for a in A]) / size for p in range(len(V)))
            rates[u] = list(map(write_expression, speeds))
        description = f"eq. (2), qd{k} = J{k}^-1 V"
        rows = [rates[u] for u in unknown]
        blocks.append(_build_block(f"J{k}inv", description, [names[u] for u in unknown], V, rows))
    if not {*closure.actuated} <= {*rates}:
        raise RobotError(
            f"--blocks: the platform of {robot.name} does not give the speeds of all its motors; "
            "blocks are those of legs with their motors; leave --blocks out"
        )
    K = [rates[a] for a in closure.actuated]
    blocks.append(_build_block("Jpinv", "eq. (1), Ld = Jp^-1 V", motors, V, K))
    if len(motors) <= THRESHOLDS.max_block_equations:
        writer.open_section("parts of the inverse of Jpinv")
        Jp = invert_matrix(K, "Dp", writer)
        blocks.append(_build_block("Jp", "the inverse of Jpinv, V = Jp Ld", V, motors, Jp))
    return blocks + _build_column_blocks(model, base, legs)


def _build_block(
    name: str,
    description: str,
    rows: Sequence[str],
    columns: Sequence[str],
    lines: list[list[Expr]],
) -> LegBlock:
    entries = {
        (row, column): entry
        for row, line in zip(rows, lines, strict=True)
        for column, entry in zip(columns, line, strict=True)
        if not entry.is_zero
    }
    return LegBlock(name, description, tuple(rows), tuple(columns), entries)


def _build_column_blocks(
    model: SymbolicModel, base: BaseParameters, legs: Sequence[tuple[list[int], list[int]]]
) -> list[LegBlock]:
    """W_P, D_mi and D_Li: the columns of the opened tree, sorted by where they act."""
    closure, zero = model.closure, model.graph.constant(0)
    assert closure is not None and closure.platform is not None
    names = [joint.name for joint in model.robot.free_joints]
    places = range(len(names))
    acts = {p: {u for u in places if (u, p.column) in model.regressor} for p in base.parameters}

    def select_block(
        name: str, description: str, places: Sequence[int], drive: bool | None = None
    ) -> LegBlock:
        motors = {*closure.actuated}
        touching = {p: rows for p, rows in acts.items() if rows & {*places}}
        chosen = [p for p, at in touching.items() if drive is None or (at <= motors) is drive]
        rows = [u for u in places if not drive or u in motors]
        lines = [[model.regressor.get((u, p.column), zero) for p in chosen] for u in rows]
        columns = [p.name for p in chosen]
        return _build_block(name, description, [names[u] for u in rows], columns, lines)

    blocks = [select_block("WP", "eq. (26), DP = Jp^T WP", closure.platform)]
    for k, (_, unknown) in enumerate(legs, 1):
        blocks.append(select_block(f"Dm{k}", "eq. (25), columns of the motor", unknown, True))
        others = "eq. (24), the other columns of the leg"
        blocks.append(select_block(f"DL{k}", others, unknown, False))
    return [one for one in blocks if one.columns]


def _convert_to_fractions(
    expressions: Sequence[Expr],
) -> tuple[dict[int, Any], Callable[[Any], Expr]]:
    """{reference: rational function of sines, cosines and letters}, and the way back.

    There and back sin^2 becomes 1 - cos^2, and common factors are gone.
    """
    graph = expressions[0].graph
    reached = graph.find_reachable(expressions)
    atoms = [n for n in reached if graph.nodes[n].op not in ("num", *OPERATIONS)]
    functions, *letters = field([f"x{n}" for n in atoms], QQ)
    values: dict[int, Any] = {0: functions(0), **dict(zip(atoms, letters, strict=True))}
    place = {(graph.nodes[n].op, graph.nodes[n].args): k for k, n in enumerate(atoms)}
    cosines = {k: place.get(("cos", args)) for (op, args), k in place.items() if op == "sin"}
    squares = {k: 1 - functions.ring.gens[c] ** 2 for k, c in cosines.items() if c is not None}
    for n in reached:
        op, args = graph.nodes[n].op, graph.nodes[n].args
        if op == "num":
            values[n] = functions(QQ(args[0].numerator, args[0].denominator))
        elif n not in values:
            values[n] = OPERATIONS[op](*(values[ref] for ref in args))
        values[-n] = -values[n]

    def write_expression(value: Any) -> Expr:
        parts = [value.numer, value.denom]
        for k, square in squares.items():
            parts = [replace_square(part, k, square) for part in parts]
        quotient, known = functions(parts[0]) / functions(parts[1]), [Expr(graph, n) for n in atoms]
        parts = [quotient.numer, quotient.denom]
        above, below = (evaluate_polynomial(part, known) for part in parts)
        return (graph.constant(0) + above) / below

    return values, write_expression


# Velocities, energies and momenta link by link, in the forms in which papers write them.
#
# Energy functions (Houda, Amouri, Beji and Malem; Gautier and Khalil 1988): with omega and V of a
# link in its own frame, [s n a] its axes and P its origin in frame 0, its energy is h xi, linear in
# XX XY XZ YY YZ ZZ MX MY MZ M:
#
#     omega_k = R omega_k-1 + bar sigma_k qd_k a,   V_k = R (V_k-1 + omega_k-1 x P) + sigma_k qd_k a
#     E = (omega'J omega + M V'V + 2 MS'(V x omega))/2,   U = -g'(M P + [s n a] MS)
#
# Kane's form (Hanssen, Hovland and Brogardh 2000, section 2): velocities v of mass centres and
# angular velocities, tangent vectors beta = dv/d(qd), momenta p, forces F with the reactions of the
# motors, and (F - dp/dt) . beta = 0.


States = tuple[np.ndarray, np.ndarray, np.ndarray]

_HALF = Fraction(1, 2)


def _evaluate_complex(
    model: SymbolicModel, expressions: Sequence[Expr], states: States, **letters: float
) -> np.ndarray:
    """(samples, expressions) at these states, moved on by an imaginary time."""
    q, qd, qdd = states
    step = 1j * THRESHOLDS.imaginary_step
    moved = (("q", q + step * qd), ("qd", qd + step * qdd))
    values: dict[str, Any] = {**model.robot.evaluate_symbols(), **model.geometry.values, **letters}
    values |= {f"{kind}[{k}]": x[:, k] for kind, x in moved for k in range(q.shape[1])}
    outputs = Plan(model.graph, expressions)(values)
    return np.stack([np.broadcast_to(np.asarray(x, complex), len(q)) for x in outputs], axis=1)


# Energy functions.


PARAMETERS = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""Of a link, in the order of xi."""


def energy_functions(model: SymbolicModel, states: States) -> tuple[Equation, float]:
    """Returns velocities of every link by the recursion and its energy functions h.

    And how far d/dt h is from the powers qd'W of the derivation's torques, of the largest power.

    Args:
        model: any robot; with loops the powers are those of the motors.
        states: for the difference; closed if the robot has loops.
    """
    phi = evaluate_regressor(model, states)
    moves = range(phi.shape[1]) if model.closure is None else model.closure.actuated
    power = np.einsum("njc,nj->nc", phi, states[1][:, [*moves]])
    model = copy_model(model)
    letters = collect_symbol_names(model, {})
    writer = SheetWriter(model.graph, letters, model.robot.has_binary_fractions, abbreviate=False)
    links = _write_energies(model, writer)
    energy_rates = np.zeros_like(power)
    for place, column in enumerate(model.columns):
        parts = [links[p.row, p.prefix] for p in column.parts if isinstance(p, LinkColumn)]
        if is_in_block(column, EnergyBlock.KINETIC):  # a rotor
            speed = combine_along_shaft(model, column.shaft, "qd")
            parts.append(_HALF * speed * speed)
            writer.open_section("energy functions of rotors")
            writer.add_result(f"h{column.name}", parts[-1], read=False)
        if parts:
            energy_rates[:, place] = (
                _evaluate_complex(model, parts, states).imag.sum(axis=1) / THRESHOLDS.imaginary_step
            )
        else:
            power[:, place] = 0.0  # friction and the like take energy, they have none
    words = (
        "H = sum_k h_k xi_k, xi = (XX XY XZ YY YZ ZZ MX MY MZ M); h = e + u: kinetic energy and "
        "potential of gravity; Delta H = int (tau less friction and other effects)' qd dt; what "
        "is not listed is 0, and what is constant has no effect",
        "omega<i>_<k>, V<i>_<k>: angular velocity of link k and velocity of its origin, in frame "
        "k; s, n, a, P: its axes and its origin, in frame 0",
    )
    off = np.abs(energy_rates - power).max() / np.abs(power).max(initial=np.finfo(float).tiny)
    return Equation(words, writer.build_sheet(), ()), float(off)


def _write_energies(model: SymbolicModel, writer: SheetWriter) -> dict[tuple[int, str], Expr]:
    """{(row, parameter): h}, written with what they need, the platform last."""
    speeds = _propagate_speeds(model, model.expand_to_rows(model.get_inputs("qd")))
    placed = compute_base_poses(model.geometry, model.frames, model.algebra)
    gravity = [model.algebra.static(x) for x in model.geometry.gravity]
    rows, bodies = model.geometry.rows, _find_body_rows(model)
    energies: dict[tuple[int, str], Expr] = {}
    for k in sorted(range(len(rows)), key=lambda k: rows[k].joint.name in model.robot.platform):
        name, (w, V), (axes, origin) = rows[k].joint.name, speeds[k], placed[k]
        for letter, vector in zip("snaP", (*axes, origin), strict=True):
            writer.open_section(f"axes and origin of frame {name}, in frame 0")
            propose_vector(writer, f"{letter}{{}}_{name}", vector)
        writer.open_section(f"velocities of link {name}, in frame {name}")
        for (letter, vector), i in product((("omega", w), ("V", V)), range(3)):
            write = writer.add_result if k in bodies else writer.propose_quantity
            write(f"{letter}{i + 1}_{name}", vector[i])
        if k in bodies:
            u = [-dot(gravity, v) for v in (*axes, origin)]
            h = [w[i] * w[j] * (_HALF if i == j else 1) for i in range(3) for j in range(i, 3)]
            h += [*plus(cross(V, w), u[:3]), _HALF * dot(V, V) + u[3]]
            writer.open_section(f"energy functions of link {name}")
            for parameter, value in zip(PARAMETERS, h, strict=True):
                writer.add_result(f"h{parameter}_{name}", value, read=False)
                energies[k, parameter] = value
    return energies


def _find_body_rows(model: SymbolicModel) -> list[int]:
    """Rows with inertial parameters."""
    parts = (part for column in model.columns for part in column.parts)
    return sorted({part.row for part in parts if isinstance(part, LinkColumn)})


def _propagate_speeds(model: SymbolicModel, qd: Sequence[Expr]) -> list[tuple[Vector, Vector]]:
    """(omega, V) of every row in its frame."""
    zero = model.graph.constant(0)
    link_speeds: list[tuple[Vector, Vector]] = []
    for row, frame in zip(model.geometry.rows, model.frames, strict=True):
        w, V = ([zero] * 3, [zero] * 3) if row.parent is None else link_speeds[row.parent]
        w, V = frame.rotate_to_link(w), frame.rotate_to_link(plus(V, cross(w, frame.p)))
        if row.index is not None:
            moved = w if row.joint.is_revolute else V
            moved[2] = moved[2] + qd[row.index] * row.rate
        link_speeds.append((w, V))
    return link_speeds


# Kane's form. A vector is kept along the axes of several frames, as papers write it.


Along = Mapping[tuple[int, int], Expr]
"""{(row of the frame, -1 for frame 0; axis): component}."""


@dataclass(frozen=True)
class _Body:
    """A link with its letters; pairs are of its mass centre and of its rotation.

    Attributes:
        name: as the paper calls it, "a".
        mass: its letter.
        v: velocity and angular velocity.
        beta: (joints) the same for unit speed of one joint.
        p: momentum, and angular momentum about the mass centre.
        F: weight, and torques of motors with their reactions; these are left out where joints
            slide or follow others.
        standard: {parameter: in these letters}.
    """

    name: str
    mass: Expr
    v: tuple[Along, Along]
    beta: tuple[tuple[Along, Along], ...]
    p: tuple[Along, Along]
    F: tuple[Along, Along]
    standard: Mapping[str, Expr]


def kane_form(model: SymbolicModel, states: States) -> tuple[Equation, float]:
    """Returns v, beta, p and F of a robot without loops along the triads of `[terms]`.

    And how far the torques of (F - dp/dt) . beta = 0 are from the derivation's, of the largest, for
    random letters.

    Args:
        model: its letters are those of `[physical]`, or m1, cx1, ..., Ixx1, ...
        states: for the difference.

    Raises:
        RobotError: `[terms] triads` gives a frame other than three axes.
    """
    copy = copy_model(model)
    bodies, triads = _build_bodies(copy), _read_triads(copy)
    names = [joint.name for joint in copy.robot.free_joints]
    letters = collect_symbol_names(copy, {}) | {VECTOR + n: n for _, n in triads.values()}
    writer = SheetWriter(copy.graph, letters, copy.robot.has_binary_fractions, abbreviate=False)

    def write_vector(vector: Along) -> Expr:
        total = copy.graph.constant(0)
        for key, entry in vector.items():
            sign, axis = triads[key]
            total = total + entry * sign * copy.graph.symbol(VECTOR + axis)
        return total

    rows = list(enumerate(product([*bodies.values()], (0, 1)), 1))
    writer.open_section("v: velocities of mass centres, angular velocities")
    for _, (body, k) in rows:
        name = f"omega{body.name.upper()}" if k else f"vCM{body.name}"
        writer.add_result(name, write_vector(body.v[k]), read=not k)
    writer.open_section("beta: tangent vectors, v = beta qd")
    for (r, (body, k)), (j, name) in product(rows, enumerate(names)):
        value = write_vector(body.beta[j][k])
        writer.add_result(format_function_name("beta", [str(r), name]), value, read=False)
    writer.open_section("p: momenta, angular momenta about the mass centres")
    for r, (body, k) in rows:
        p = write_vector(body.p[1]) if k else body.mass * write_vector(body.v[0])
        writer.add_result(f"p{r}", p, read=False)
    writer.open_section("F: weights, torques of the motors with their reactions")
    for r, (body, k) in rows:
        writer.add_result(f"F{r}", write_vector(body.F[k]), read=False)
    words = (
        "rows, by body: mass centre, rotation; what is not listed is 0",
        "(F - dp/dt) . beta = 0: one equation a joint",
    )
    return Equation(words, writer.build_sheet(), ()), _compare_kane_torques(
        copy, bodies, model, states
    )


def _compare_kane_torques(
    formula_model: SymbolicModel, bodies: Mapping[int, _Body], model: SymbolicModel, states: States
) -> float:
    graph, rng = formula_model.graph, np.random.default_rng(THRESHOLDS.kane_seed)
    placed = compute_base_poses(formula_model.geometry, formula_model.frames, formula_model.algebra)
    axes = dict(enumerate((turn for turn, _ in placed)))
    axes[-1] = [[graph.constant(int(i == j)) for j in range(3)] for i in range(3)]
    parts = [p for c in model.columns for p in c.parts if isinstance(p, LinkColumn)]
    standard = [bodies[p.row].standard[p.prefix] for p in parts]
    nodes = (graph.nodes[n] for n in graph.find_reachable(standard))
    values = {node.args[0]: float(rng.uniform(0.1, 1.0)) for node in nodes if node.op == "sym"}
    values |= formula_model.robot.evaluate_symbols()
    needed: list[Expr] = []
    for body, k in product(bodies.values(), (0, 1)):
        weight: Along = {} if k else body.F[0]
        for vector in (body.p[k], weight, *(beta[k] for beta in body.beta)):
            total = [graph.constant(0)] * 3
            for (row, i), entry in vector.items():
                total = plus(total, times(entry, axes[row][i]))
            needed += total
    samples = _evaluate_complex(formula_model, needed, states, **values)
    samples = samples.reshape(len(states[0]), 2 * len(bodies), -1, 3)
    force = samples[:, :, 0].imag / THRESHOLDS.imaginary_step - samples[:, :, 1].real
    tau = np.einsum("nri,nrji->nj", force, samples[:, :, 2:].real)
    chi = np.zeros(len(model.columns))
    numbers = iter(_evaluate_complex(formula_model, standard, states, **values)[0].real)
    for c, column in enumerate(model.columns):
        chi[c] = sum(next(numbers) for p in column.parts if isinstance(p, LinkColumn))
    wanted = evaluate_regressor(model, states) @ chi
    return float(np.abs(tau - wanted).max() / np.abs(wanted).max())


def _build_bodies(model: SymbolicModel) -> dict[int, _Body]:
    """By row."""
    rows, free = model.geometry.rows, model.robot.free_joints
    triads, torques = _read_triads(model), _collect_motor_torques(model)
    units = [[model.graph.constant(int(a is b)) for a in free] for b in free]
    speeds = map(model.expand_to_rows, (model.get_inputs("qd"), *units))
    ways = [_resolve_along_frames(model, qd) for qd in speeds]
    gravity, bodies = [model.algebra.static(x) for x in model.geometry.gravity], {}

    def read_entry(entry: Expression, _: str = "") -> Expr:
        values = {name: model.graph.symbol(name, static=True) for name in entry.names}
        constant = model.graph.constant
        return constant(0) + entry.fold(values, {}, model.graph.pi(), constant)

    for k in _find_body_rows(model):
        link = get_physical_link(model, rows[k].joint)
        m, c = read_entry(link.mass), [read_entry(x) for x in link.centre]
        XX, XY, XZ, YY, YZ, ZZ = (read_entry(x) for x in link.inertia)
        moved = (way[k] for way in ways)
        pairs = [
            (_add_components(V, _express_in_row(k, cross(w, c))), turn) for V, turn, w in moved
        ]
        spin = [dot(line, ways[0][k][2]) for line in ([XX, XY, XZ], [XY, YY, YZ], [XZ, YZ, ZZ])]
        letters = {triads[k, i][1].split("_")[0] for i in range(3)}
        bodies[k] = _Body(
            rows[k].joint.name if len(letters) > 1 else letters.pop(),
            m,
            pairs[0],
            tuple(pairs[1:]),
            ({at: m * x for at, x in pairs[0][0].items()}, _express_in_row(k, spin)),
            (_express_in_row(-1, times(m, gravity)), torques.get(k, {})),
            move_to_origin(link, "", read_entry),
        )
    return bodies


def _collect_motor_torques(model: SymbolicModel) -> dict[int, Along]:
    """Torque of a motor on the row that it turns, and its reaction on the body before it."""
    rows, motor_torques = model.geometry.rows, dict[int, Along]()
    moving = [k for k, row in enumerate(rows) if row.index is not None]
    if model.robot.relations or not all(rows[k].joint.is_revolute for k in moving):
        return {}
    for k in moving:
        chain = [row for row in model.geometry.find_ancestors(k) if row in moving]
        tau = model.graph.symbol(f"tau{rows[k].joint.name}") * rows[k].rate
        for row, torque in zip(chain[:2], (tau, -tau), strict=False):
            motor_torques[row] = {**motor_torques.get(row, {}), (k, 2): torque}
    return motor_torques


def _resolve_along_frames(
    model: SymbolicModel, qd: Sequence[Expr]
) -> list[tuple[Along, Along, Vector]]:
    """Of every row: velocity of the origin and rotation along the frames, rotation in its own."""
    row_motions: list[tuple[Along, Along, Vector]] = []
    rows = zip(model.geometry.rows, _propagate_speeds(model, qd), strict=True)
    for k, (row, (w, _)) in enumerate(rows):
        V: Along = {}
        turn: Along = {}
        if row.parent is not None:
            V, turn, before = row_motions[row.parent]
            V = _add_components(V, _express_in_row(row.parent, cross(before, model.frames[k].p)))
        if row.index is not None:
            joint_rate = {(k, 2): qd[row.index] * row.rate}
            if row.joint.is_revolute:
                turn = _add_components(turn, joint_rate)
            else:
                V = _add_components(V, joint_rate)
        row_motions.append((V, turn, w))
    return row_motions


def _express_in_row(row: int, vector: Vector) -> Along:
    return {(row, i): entry for i, entry in enumerate(vector) if entry.ref}


def _add_components(a: Along, b: Along) -> Along:
    return {**a, **{at: a[at] + x if at in a else x for at, x in b.items()}}


def _read_triads(model: SymbolicModel) -> dict[tuple[int, int], tuple[int, str]]:
    """{(row, -1 for frame 0; axis): (sign, how the unit vector is written)}."""
    stated_triads: Any = model.robot.terms.get("triads", {})
    triads = {}
    for k, name in enumerate(["0", *(row.joint.name for row in model.geometry.rows)], -1):
        axes = stated_triads.get(name) if isinstance(stated_triads, dict) else stated_triads
        listed = axes if isinstance(axes, list) else [] if axes else [f"{x}_{name}" for x in "xyz"]
        written = [re.fullmatch(r"(-?)([A-Za-z]+?)_?(\d\w*|(?<=_)\w+)", str(x)) for x in listed]
        read = [match.groups() for match in written if match is not None]
        if len(read) != len(listed) or len(read) != 3:
            raise RobotError(
                f"robot {model.robot.name}, [terms], triads, {name}: got {axes!r}; expected three "
                'axes such as ["a3", "-a2", "a1"]'
            )
        for i, (sign, letter, index) in enumerate(read):
            triads[k, i] = (-1 if sign else 1, f"{letter}_{index}")
    return triads
