"""What a controller calls besides torques and regressors: functions of the unit `<prefix>_control`.

Fits do without them, so they are emitted only where a folder for a controller is written.
"""

import dataclasses
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from modeler import derivation
from modeler.codegen import functions as layout
from modeler.codegen.closed_control import closed_control_functions, fitted_closed
from modeler.codegen.forward import forward_functions, without_beta
from modeler.codegen.functions import Arguments, CFunction, Closed, entries_of
from modeler.codegen.parameter_set import smooth_functions
from modeler.core.errors import EmitError
from modeler.core.manifest import ArgumentSpec, FittedSpec
from modeler.derivation import BaseParameters, Entries, Expr, Graph, SymbolicModel

UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""


@dataclass(frozen=True)
class Control:
    """What of the controller's unit is emitted.

    Attributes:
        frames: names of further frames whose Jacobians are wanted: rows, links of [frames].
        only: roles of the functions that are wanted, and `observation`; empty: all.
        vectors: add the table of `vectors.vector_lines` and the program that reads it.
        structured_text: add the function blocks of `codegen.structured_text`.
        a2l: add the description of the parameter set, of `codegen.a2l`.
    """

    frames: tuple[str, ...] = ()
    only: tuple[str, ...] = ()
    vectors: bool = False
    structured_text: bool = False
    a2l: bool = False


OBSERVATION = "observation"
"""Of many samples; it stands in the library for these and calls the base regressor."""

_OF_LOOPS = ("closure", "residual", "factor", "solve", "coupling", "turned", "spread")
_ROWS = ("base_regressor", "base_regressor_nonzeros", "tree_base_regressor", "tree_rows")


def chosen(functions: Sequence[CFunction], only: Sequence[str], robot: str) -> frozenset[str]:
    """Roles of the functions that stay: those that are asked for, and what they call.

    A role stands for its twin with fitted values too.

    Args:
        functions: of the module, all units.
        only: roles.
        robot: name, for messages.

    Raises:
        EmitError: a role is none of the robot's; the message lists them.
    """
    public = [f.role for f in functions if not f.internal]
    unknown = [role for role in only if role not in (*public, OBSERVATION)]
    if unknown:
        raise EmitError(
            f"--only: {robot} has no function {', '.join(unknown)}; expected some of "
            f"{', '.join([*public, OBSERVATION])}"
        )
    called = {f.role: f.closed or f.composed for f in functions}
    waiting = [role for role in public if role in only or role.removeprefix("fitted_") in only]
    waiting += _ROWS if OBSERVATION in only else ()
    waiting += ["tree_drift", *(f"tree_{part}" for part in _OF_LOOPS)]  # the state's
    kept: set[str] = set()
    while waiting:
        role = waiting.pop()
        if role in called and role not in kept:
            kept.add(role)
            made = called[role]
            waiting += made.calls if made is not None else ()
            if isinstance(made, Closed):
                head = made.loops.removesuffix("loops")
                waiting += [f"tree_{head}{part}" for part in _OF_LOOPS]
                waiting += _ROWS if made.kind == "rows" else ()
    return frozenset(kept)


def control_functions(
    model: SymbolicModel, base: BaseParameters, control: Control
) -> tuple[CFunction, ...]:
    """The functions of the unit, those that read the parameters with their argument beta.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        control: what is wanted.

    Raises:
        EmitError: a frame is unknown, or two have one name in C.
    """
    model = _apart(model)
    given = layout.arguments_of(model.robot.free, model, base)
    beta = layout.beta_symbols(model, base)
    found = (
        *_dynamics(model, beta, given),
        *_regressors(model, base, given),
        *_frames(model, control, given),
    )
    if model.closure is not None:
        return closed_control_functions(model, base, found)
    return (
        *found,
        _derivatives(model, beta, given),
        *forward_functions(model, beta, given),
        *smooth_functions(model, beta, given),
    )


def fitted_control_functions(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec, plain: Sequence[CFunction]
) -> tuple[CFunction, ...]:
    """Twins of those that read beta, without it: the values are written into them.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        fitted: their values.
        plain: the functions that read beta.
    """
    if model.closure is not None:
        return fitted_closed(plain)
    model = _apart(model)
    given = layout.arguments_of(model.robot.free, model, base)
    values = {
        parameter.column: model.graph.constant(Fraction(repr(float(known.value))))
        for parameter, known in zip(base.parameters, fitted.parameters, strict=True)
    }
    found = (
        *_dynamics(model, values, given),
        _derivatives(model, values, given),
        *forward_functions(model, values, given),
    )
    return tuple(map(without_beta, found))


def _apart(model: SymbolicModel) -> SymbolicModel:
    """The model in a graph of its own, so that what others left there cannot change the C."""
    graph = Graph(apart=True)
    graph.tables |= model.graph.tables  # one law has one name in all C
    return dataclasses.replace(model, graph=graph)


def _dynamics(
    model: SymbolicModel, beta: Mapping[int, Expr], given: Arguments
) -> tuple[CFunction, ...]:
    """Functions that read beta, of a robot without loops."""
    n = model.geometry.coordinates
    matrix = derivation.coriolis_matrix(model, beta)
    state = (given.q, given.qd, given.beta)
    momenta = _momentum_unit(given.tau.unit)
    return (
        CFunction(
            UNIT, "coriolis_matrix", "Coriolis matrix of Christoffel symbols: dM/dt = C + C^T.",
            "C qd = c(q, qd)", state,
            ArgumentSpec("C", (n, n), "kg m2/s, kg m/s or kg/s", "Coriolis matrix"),
            entries_of([value for row in matrix for value in row]),
        ),
        CFunction(
            UNIT, "coriolis_transpose",
            "What a momentum observer adds to the torques: dp/dt = tau + C^T qd - g - f.",
            "C^T qd = dT/dq with the kinetic energy T", state,
            dataclasses.replace(given.tau, name="out", meaning="product of C^T with qd"),
            entries_of(derivation.coriolis_transpose(model, beta)),
        ),
        CFunction(
            UNIT, "momentum", "Momentum along the joints, rotor inertias included.",
            "p = M(q) qd", state, ArgumentSpec("p", (n,), momenta, "generalised momentum"),
            entries_of(derivation.momentum(model, beta)),
        ),
    )  # fmt: skip


def _derivatives(model: SymbolicModel, beta: Mapping[int, Expr], given: Arguments) -> CFunction:
    return CFunction(
        UNIT, "derivatives",
        layout.comment_text(
            "Derivatives of the torques by positions and by speeds; those by qdd are M. A leap "
            "of friction counts as level."
        ),
        "D = [d tau/d q, d tau/d qd]", (*given.motion, given.beta),
        ArgumentSpec("D", (2, *given.q.shape, *given.q.shape), "torque per unit of q, of qd",
                     "derivatives"),
        entries_of(_slopes(model, beta)),
    )  # fmt: skip


def _momentum_unit(effort: str) -> str:
    return " or ".join(f"{unit} s" for unit in effort.split(" or "))


def _slopes(model: SymbolicModel, beta: Mapping[int, Expr]) -> list[Expr]:
    n, torque, one = model.geometry.coordinates, model.torque(beta), model.graph.constant(1)
    found = []
    for kind in ("q", "qd"):
        columns = [derivation.derivatives(torque, {f"{kind}[{j}]": one}, True) for j in range(n)]
        found += [columns[j][i] for i in range(n) for j in range(n)]
    return found


# Regressors of a controller that adapts, or identifies without accelerations.


def _regressors(
    model: SymbolicModel, base: BaseParameters, given: Arguments
) -> tuple[CFunction, ...]:
    if layout.reads_more(model):
        return ()
    n, c = model.geometry.coordinates, base.rank
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    second = dataclasses.replace(given.qd, name="v", meaning="reference velocities")
    reference = dataclasses.replace(given.qdd, name="a", meaning="reference accelerations")

    def regressor(role: str, does: str, equation: str, name: str, rows: int, entries: Entries,
                  *more: ArgumentSpec) -> CFunction:  # fmt: skip
        kept = {(row, place[k]): value for (row, k), value in entries.items() if k in place}
        return CFunction(
            UNIT, role, does, equation, (given.q, given.qd, *more),
            ArgumentSpec(name, (rows, c), "SI", "per unit of each base parameter"),
            tuple((row * c + i, value) for (row, i), value in layout.by_column(kept)),
        )  # fmt: skip

    return (
        regressor(
            "slotine_li_regressor",
            "Regressor of adaptive control (Slotine and Li); friction takes v for qd.",
            "Y beta = M(q) a + C(q, qd) v + g(q) + f(v)", "Y", n,
            derivation.slotine_li_regressor(model), second, reference,
        ),
        regressor("momentum_regressor", "Regressor of the momentum.", "M(q) qd = P beta", "P", n,
                  derivation.momentum_regressor(model)),
        regressor("momentum_rest_regressor", "What the torque is besides the momentum's rate.",
                  "tau = d/dt (P beta) + R beta", "R", n,
                  derivation.momentum_rest_regressor(model)),
        regressor("energy_regressor", "Regressor of the kinetic and potential energy.",
                  "T + U = h beta, but for a constant", "h", 1,
                  derivation.energy_regressor(model)),
        regressor("power_regressor", "Regressor of the power that friction and offsets take.",
                  "tau . qd = d/dt (h beta) + d beta", "d", 1, derivation.power_regressor(model)),
    )  # fmt: skip


# Frames that a controller steers.


def _frames(model: SymbolicModel, control: Control, given: Arguments) -> list[CFunction]:
    suffixes = {"": ""}
    for name in control.frames:
        suffix = "_" + re.sub(r"[^A-Za-z0-9_]", "_", name).lower()
        if suffixes.setdefault(suffix, name) != name or suffix == "_dot_qd":
            raise EmitError(
                f'frame "{name}": functions of another frame or role end in {suffix} too; rename it'
            )
    return [
        function
        for suffix, name in suffixes.items()
        for function in _functions_of(model, name, suffix, given)
    ]


def _functions_of(
    model: SymbolicModel, name: str, suffix: str, given: Arguments
) -> Sequence[CFunction]:
    frame = derivation.body_frame(model, name)
    row, n = model.robot.joints[frame.row].name, model.geometry.coordinates
    of = f"frame {name}" if name else "the tool" if model.robot.tool else f"the frame of row {row}"
    of = layout.comment_text(of)
    speed, turn = "rows 0-2 velocity of its origin, 3-5 angular", "in axes of frame 0"

    def function(role: str, does: str, equation: str, reads: tuple[ArgumentSpec, ...],
                 output: ArgumentSpec, values: Sequence[Expr]) -> CFunction:  # fmt: skip
        return CFunction(UNIT, f"{role}{suffix}", f"{does} of {of}.", equation, reads, output,
                         entries_of(values))  # fmt: skip

    q, qd = given.q, given.qd
    return (
        function("pose", "Pose", "x0 = R x + p with T = [R | p], for a point x of the frame", (q,),
                 ArgumentSpec("T", (3, 4), "1 | m", "pose [R | p] in frame 0"),
                 [x for line in derivation.frame_pose(model, frame) for x in line]),
        function("jacobian", "Jacobian", "[velocity; angular velocity] = J qd", (q,),
                 ArgumentSpec("J", (6, n), "m or rad per unit of q", f"{speed}, {turn}"),
                 [x for line in derivation.jacobian(model, frame) for x in line]),
        function("jacobian_dot_qd", "Product of the Jacobian's rate with qd",
                 "[acceleration; angular acceleration] = J qdd + a", (q, qd),
                 ArgumentSpec("a", (6,), "m/s2 | rad/s2", f"acceleration for qdd = 0, {turn}"),
                 derivation.jacobian_dot_qd(model, frame)),
        function("twist", "Twist", "V = [R^T 0; 0 R^T] J qd", (q, qd),
                 ArgumentSpec("V", (6,), "m/s | rad/s", f"{speed}, in its own axes"),
                 derivation.twist(model, frame)),
    )  # fmt: skip
