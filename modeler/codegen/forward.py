"""Functions of a controller that solve for accelerations, and can fail: robots without loops.

The equations of forward dynamics are eliminated in the graph, from the last joint to the first,
where no branch fills another's zeros (Featherstone 2008, 6.5): straight-line code that shares what
M and the torques have in common, and gives its pivots beside the solution. What is written around
it in C looks at these.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from modeler.codegen.functions import Arguments, CFunction, Composed, format_comment, list_entries
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import Expr, SymbolicModel, differentiate

UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""

TURNS = 30
"""Corrections of the accelerations, at most, where effects read them."""


_WITHOUT_VALUES = ("jacobian",)
"""Functions that others call and that read no parameters."""


@dataclass(frozen=True)
class Efforts:
    """tau = M qdd + bias(q, qd) + f(q, qd, qdd), as matrix and right side of one equation.

    Attributes:
        matrix: d tau/d qdd, (n, n).
        rest: tau at qdd = 0; at the qdd that is read, where it `is_implicit`.
        turns: True if effects read qdd otherwise than linearly, or not by a symmetric matrix.
    """

    matrix: Sequence[Sequence[Expr]]
    bias: Sequence[Expr]
    is_implicit: bool


def build_efforts(model: SymbolicModel, beta: Mapping[int, Expr]) -> Efforts:
    """Of the robot with these parameters by column."""
    graph, n = model.graph, model.geometry.coordinate_count
    matrix = model.derive_inertia_matrix(beta)
    losses = {k: v for k, v in beta.items() if model.columns[k].kind != "rotor_inertia"}
    rest = model.derive_torque(losses, accelerations=False)
    symbols = {graph.symbol(f"qdd[{j}]").ref: j for j in range(n)}
    if symbols.keys().isdisjoint(graph.find_reachable(rest)):
        return Efforts(matrix, rest, is_implicit=False)
    one, more = graph.constant(1), model.derive_torque(losses, links=False)
    slopes = [differentiate(more, {f"qdd[{j}]": one}, kinks=True) for j in range(n)]
    matrix = [[entry + slopes[j][i] for j, entry in enumerate(row)] for i, row in enumerate(matrix)]
    return Efforts(matrix, model.derive_torque(beta), is_implicit=True)


def solve_linear(
    matrix: Sequence[Sequence[Expr]], right: Sequence[Expr]
) -> tuple[list[Expr], list[Expr]]:
    """x of matrix x = right, and the pivots; one that is always 0 counts as 1 in x.

    Gauss's elimination from the last row to the first. Equal expressions are one node of the graph,
    so that a symmetric matrix costs half of one that is not.
    """
    n, one = len(right), right[0].graph.constant(1)
    A, x = [list(row) for row in matrix], list(right)
    inverse = [one] * n
    for k in reversed(range(n)):
        inverse[k] = one if A[k][k].is_zero else 1 / A[k][k]
        for i in range(k):
            if not A[i][k].is_zero:
                share = A[i][k] * inverse[k]
                A[i][:k] = [A[i][j] - share * A[k][j] for j in range(k)]
                x[i] = x[i] - share * x[k]
    for k in range(n):
        for j in range(k):
            x[k] = x[k] - A[k][j] * x[j]
        x[k] = x[k] * inverse[k]
    return x, [A[k][k] for k in range(n)]


def build_forward_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Forward dynamics, its derivatives, inertia of the tool; internal functions first."""
    n = model.geometry.coordinate_count
    efforts = build_efforts(model, beta)
    correction, pivots = solve_linear(
        efforts.matrix, [-r + model.graph.symbol(f"tau[{j}]") for j, r in enumerate(efforts.bias)]
    )
    diagonal = [efforts.matrix[k][k] for k in range(n)]
    accelerations = (arguments.qdd,) if efforts.is_implicit else ()
    motion = (arguments.q, arguments.qd, *accelerations, arguments.tau, *arguments.signals)
    step = CFunction(
        UNIT, "forward_step", "Accelerations of these torques, pivots and diagonal of M.",
        "M qdd = tau - c - g - f", (*motion, arguments.beta),
        ArgumentSpec("step", (3 * n,), "SI", "accelerations, pivots, diagonal"),
        list_entries([*correction, *pivots, *diagonal]), internal=True,
    )  # fmt: skip
    slopes = CFunction(
        UNIT, "effort_slopes", "Derivatives of the torques by accelerations.",
        "d tau/d qdd", (*arguments.motion, arguments.beta),
        ArgumentSpec("A", (n, n), "SI", "derivatives"),
        list_entries([x for row in efforts.matrix for x in row]), internal=True,
    )  # fmt: skip
    inputs = (arguments.q, arguments.qd, arguments.tau, *arguments.signals, arguments.beta)
    matrix = slopes.role if efforts.is_implicit else "inertia_matrix"
    damping = ArgumentSpec("damping", (1,), "as J M^-1/2", "0, or what keeps L finite")
    space, roles = (
        (arguments.q, arguments.beta, damping),
        {"matrix": "inertia_matrix", "J": "jacobian"},
    )

    def make_composed(role: str, does: str, equation: str, reads: tuple[ArgumentSpec, ...],
                 output: ArgumentSpec, **calls: str) -> CFunction:  # fmt: skip
        made = Composed(role, calls, TURNS if efforts.is_implicit else 1)
        return CFunction(
            UNIT, role, format_comment(does), equation, reads, output, (), composed=made
        )

    return (
        step, *((slopes,) if efforts.is_implicit else ()),
        make_composed(
            "forward_dynamics", "Joint accelerations under these torques, friction included.",
            "M(q) qdd = tau - c(q, qd) - g(q) - f(qd)", inputs, arguments.qdd, step=step.role,
        ),
        make_composed(
            "forward_derivatives",
            "Derivatives of the accelerations by positions, speeds and torques. A leap of friction "
            "counts as level.", "D = [d qdd/d q, d qdd/d qd, d qdd/d tau]", inputs,
            ArgumentSpec("D", (3, n, n), "acceleration per unit of q, qd, tau", "derivatives"),
            step=step.role, dynamics="forward_dynamics", slopes="derivatives", matrix=matrix,
        ),
        make_composed(
            "operational_inertia",
            "Inertia that the tool's frame has for forces and moments on it, rows as of the "
            "Jacobian.", "L = (J M^-1 J^T + damping^2 1)^-1", space,
            ArgumentSpec("L", (6, 6), "kg, kg m, kg m2", "operational-space inertia"), **roles,
        ),
        make_composed(
            "operational_inverse",
            "Inverse of the Jacobian that moves the tool with the least kinetic energy (Khatib).",
            "Jbar = M^-1 J^T (J M^-1 J^T + damping^2 1)^-1", space,
            ArgumentSpec("Jbar", (n, 6), "unit of q per m or rad", "inverse Jacobian"), **roles,
        ),
    )  # fmt: skip


def remove_beta(function: CFunction) -> CFunction:
    """The twin of a function that reads beta, for the fitted values."""
    made = function.composed
    if made is not None:
        roles = {word: _name_twin(role) for word, role in made.roles.items()}
        made = dataclasses.replace(made, roles=roles)
    inputs = tuple(a for a in function.inputs if a.name != "beta")
    return dataclasses.replace(
        function, role=_name_twin(function.role), inputs=inputs, composed=made
    )


def _name_twin(role: str) -> str:
    return role if role in _WITHOUT_VALUES else f"fitted_{role}"
