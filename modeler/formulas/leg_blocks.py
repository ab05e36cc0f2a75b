"""The model of a parallel robot in blocks: Jacobians, columns of motors, legs and platform.

Guegan, Khalil and Lemoine 2003, eqs. 1, 2 and 23 to 30, for every robot whose legs stand alone once
the platform is given. With V the speeds of the platform's coordinates and qd_i those of leg i,

    qd_i = J_i^-1 V,    Ld = J_p^-1 V,
    tau = D_m K + J_p^T (W_P + sum_i J_i^-T D_Li) K,

where a column of D_m acts on a motor alone, D_Li are torques of leg i as if its end were free, and
J_p^T W_P = D_P. Equal power carries torques of a leg to the platform and from there to the motors:
F^T qd_i = G^T V = G^T J_p Ld for all V, so G = J_i^-T F and tau = J_p^T G.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sympy.polys.domains import QQ
from sympy.polys.fields import field

from modeler.core.errors import RobotError
from modeler.derivation import OPERATIONS, BaseParameters, Expr, SymbolicModel, replace_square
from modeler.formulas.closed_form import collect_symbol_names, copy_model, get_base_columns
from modeler.formulas.function_sheet import SheetWriter
from modeler.formulas.regressor_form import (
    Equation,
    compute_cofactor,
    find_connected_blocks,
    invert_matrix,
    multiply_rows,
    propose_motion,
)
from modeler.formulas.ring import evaluate_polynomial
from modeler.formulas.thresholds import THRESHOLDS

_PRINTED = 3
"""Legs of the paper, one equation each."""

Matrix = Mapping[tuple[str, str], Expr]
"""{(row, column): entry}; what is not there is 0."""


@dataclass(frozen=True, eq=False)
class LegBlock:
    """One block.

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
    values, write_expression = _convert_to_fractions(
        [entry for line in closure.jacobian for entry in line]
    )
    for k, (equations, unknown) in enumerate(legs, 1):
        if not 0 < len(unknown) <= THRESHOLDS.max_block_equations:
            raise RobotError(
                f"--blocks: leg {k} of {robot.name} has {len(unknown)} unknown speeds where the "
                f"platform is given; expected {THRESHOLDS.max_block_equations} at most; leave "
                "--blocks out"
            )
        B, A = ([[values[closure.jacobian[r][u].ref] for u in at] for r in equations]
                for at in (unknown, closure.platform))  # fmt: skip
        cofactors = [[compute_cofactor(B, i, j) for j in range(len(B))] for i in range(len(B))]
        size = multiply_rows(B[0], cofactors[0])
        for j, u in enumerate(unknown):
            line = [row[j] for row in cofactors]
            rates[u] = [write_expression(-multiply_rows(line, [a[p] for a in A]) / size)
                        for p in range(len(V))]  # fmt: skip
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
    acts = {p: {u for u in range(len(names)) if (u, p.column) in model.regressor}
            for p in base.parameters}  # fmt: skip

    def select_block(
        name: str, description: str, places: Sequence[int], drive: bool | None = None
    ) -> LegBlock:
        motors = {*closure.actuated}
        chosen = [p for p, rows in acts.items() if rows & {*places}
                  and (drive is None or (rows <= motors) is drive)]  # fmt: skip
        rows = [u for u in places if not drive or u in motors]
        lines = [[model.regressor.get((u, p.column), zero) for p in chosen] for u in rows]
        return _build_block(
            name, description, [names[u] for u in rows], [p.name for p in chosen], lines
        )

    blocks = [select_block("WP", "eq. (26), DP = Jp^T WP", closure.platform)]
    for k, (_, unknown) in enumerate(legs, 1):
        blocks.append(select_block(f"Dm{k}", "eq. (25), columns of the motor", unknown, True))
        blocks.append(
            select_block(f"DL{k}", "eq. (24), the other columns of the leg", unknown, False)
        )
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
    squares = {
        k: 1 - functions.ring.gens[place["cos", args]] ** 2
        for (op, args), k in place.items()
        if op == "sin" and ("cos", args) in place
    }
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
        above, below = (
            evaluate_polynomial(part, known) for part in (quotient.numer, quotient.denom)
        )
        return (graph.constant(0) + above) / below

    return values, write_expression
