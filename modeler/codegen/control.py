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
from modeler.codegen.closed_control import build_closed_control_functions, build_fitted_closed
from modeler.codegen.forward import build_forward_functions, remove_beta
from modeler.codegen.functions import Arguments, CFunction, Closed, list_entries
from modeler.codegen.parameter_set import build_smooth_functions
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


def select_roles(functions: Sequence[CFunction], only: Sequence[str], robot: str) -> frozenset[str]:
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
    selected: set[str] = set()
    while waiting:
        role = waiting.pop()
        if role in called and role not in selected:
            selected.add(role)
            made = called[role]
            waiting += made.calls if made is not None else ()
            if isinstance(made, Closed):
                head = made.loops.removesuffix("loops")
                waiting += [f"tree_{head}{part}" for part in _OF_LOOPS]
                waiting += _ROWS if made.kind == "rows" else ()
    return frozenset(selected)


def build_control_functions(
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
    model = _isolate_graph(model)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    beta = layout.make_beta_symbols(model, base)
    functions = (
        *_build_dynamics(model, beta, arguments),
        *_build_regressors(model, base, arguments),
        *_build_frames(model, control, arguments),
    )
    if model.closure is not None:
        return build_closed_control_functions(model, base, functions)
    return (
        *functions,
        _build_derivatives(model, beta, arguments),
        *build_forward_functions(model, beta, arguments),
        *build_smooth_functions(model, beta, arguments),
    )


def build_fitted_control_functions(
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
        return build_fitted_closed(plain)
    model = _isolate_graph(model)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    values = {
        parameter.column: model.graph.constant(Fraction(repr(float(known.value))))
        for parameter, known in zip(base.parameters, fitted.parameters, strict=True)
    }
    functions = (
        *_build_dynamics(model, values, arguments),
        _build_derivatives(model, values, arguments),
        *build_forward_functions(model, values, arguments),
    )
    return tuple(map(remove_beta, functions))


def _isolate_graph(model: SymbolicModel) -> SymbolicModel:
    """The model in a graph of its own, so that what others left there cannot change the C."""
    graph = Graph(apart=True)
    graph.tables |= model.graph.tables  # one law has one name in all C
    return dataclasses.replace(model, graph=graph)


def _build_dynamics(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Functions that read beta, of a robot without loops."""
    n = model.geometry.coordinate_count
    matrix = derivation.derive_coriolis_matrix(model, beta)
    state = (arguments.q, arguments.qd, arguments.beta)
    momenta = _format_momentum_unit(arguments.tau.unit)
    return (
        CFunction(
            UNIT, "coriolis_matrix", "Coriolis matrix of Christoffel symbols: dM/dt = C + C^T.",
            "C qd = c(q, qd)", state,
            ArgumentSpec("C", (n, n), "kg m2/s, kg m/s or kg/s", "Coriolis matrix"),
            list_entries([value for row in matrix for value in row]),
        ),
        CFunction(
            UNIT, "coriolis_transpose",
            "What a momentum observer adds to the torques: dp/dt = tau + C^T qd - g - f.",
            "C^T qd = dT/dq with the kinetic energy T", state,
            dataclasses.replace(arguments.tau, name="out", meaning="product of C^T with qd"),
            list_entries(derivation.derive_coriolis_transpose(model, beta)),
        ),
        CFunction(
            UNIT, "momentum", "Momentum along the joints, rotor inertias included.",
            "p = M(q) qd", state, ArgumentSpec("p", (n,), momenta, "generalised momentum"),
            list_entries(derivation.derive_momentum(model, beta)),
        ),
    )  # fmt: skip


def _build_derivatives(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> CFunction:
    return CFunction(
        UNIT,
        "derivatives",
        layout.format_comment(
            "Derivatives of the torques by positions and by speeds; those by qdd are M. A leap "
            "of friction counts as level."
        ),
        "D = [d tau/d q, d tau/d qd]",
        (*arguments.motion, arguments.beta),
        ArgumentSpec(
            "D",
            (2, *arguments.q.shape, *arguments.q.shape),
            "torque per unit of q, of qd",
            "derivatives",
        ),
        list_entries(_differentiate_torques(model, beta)),
    )


def _format_momentum_unit(effort: str) -> str:
    return " or ".join(f"{unit} s" for unit in effort.split(" or "))


def _differentiate_torques(model: SymbolicModel, beta: Mapping[int, Expr]) -> list[Expr]:
    n, torque, one = (
        model.geometry.coordinate_count,
        model.derive_torque(beta),
        model.graph.constant(1),
    )
    slopes = []
    for kind in ("q", "qd"):
        columns = [derivation.differentiate(torque, {f"{kind}[{j}]": one}, True) for j in range(n)]
        slopes += [columns[j][i] for i in range(n) for j in range(n)]
    return slopes


# Regressors of a controller that adapts, or identifies without accelerations.


def _build_regressors(
    model: SymbolicModel, base: BaseParameters, arguments: Arguments
) -> tuple[CFunction, ...]:
    if layout.needs_more_than_speed(model):
        return ()
    n, c = model.geometry.coordinate_count, base.rank
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    second = dataclasses.replace(arguments.qd, name="v", meaning="reference velocities")
    reference = dataclasses.replace(arguments.qdd, name="a", meaning="reference accelerations")

    def make_regressor(role: str, does: str, equation: str, name: str, rows: int, entries: Entries,
                  *more: ArgumentSpec) -> CFunction:  # fmt: skip
        base_entries = {(row, place[k]): value for (row, k), value in entries.items() if k in place}
        return CFunction(
            UNIT, role, does, equation, (arguments.q, arguments.qd, *more),
            ArgumentSpec(name, (rows, c), "SI", "per unit of each base parameter"),
            tuple((row * c + i, value) for (row, i), value in layout.sort_by_column(base_entries)),
        )  # fmt: skip

    return (
        make_regressor(
            "slotine_li_regressor",
            "Regressor of adaptive control (Slotine and Li); friction takes v for qd.",
            "Y beta = M(q) a + C(q, qd) v + g(q) + f(v)",
            "Y",
            n,
            derivation.derive_slotine_li_regressor(model),
            second,
            reference,
        ),
        make_regressor(
            "momentum_regressor",
            "Regressor of the momentum.",
            "M(q) qd = P beta",
            "P",
            n,
            derivation.derive_momentum_regressor(model),
        ),
        make_regressor(
            "momentum_rest_regressor",
            "What the torque is besides the momentum's rate.",
            "tau = d/dt (P beta) + R beta",
            "R",
            n,
            derivation.derive_momentum_rest_regressor(model),
        ),
        make_regressor(
            "energy_regressor",
            "Regressor of the kinetic and potential energy.",
            "T + U = h beta, but for a constant",
            "h",
            1,
            derivation.derive_energy_regressor(model),
        ),
        make_regressor(
            "power_regressor",
            "Regressor of the power that friction and offsets take.",
            "tau . qd = d/dt (h beta) + d beta",
            "d",
            1,
            derivation.derive_power_regressor(model),
        ),
    )


# Frames that a controller steers.


def _build_frames(model: SymbolicModel, control: Control, arguments: Arguments) -> list[CFunction]:
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
        for function in _build_frame_functions(model, name, suffix, arguments)
    ]


def _build_frame_functions(
    model: SymbolicModel, name: str, suffix: str, arguments: Arguments
) -> Sequence[CFunction]:
    frame = derivation.find_body_frame(model, name)
    row, n = model.robot.joints[frame.row].name, model.geometry.coordinate_count
    of = f"frame {name}" if name else "the tool" if model.robot.tool else f"the frame of row {row}"
    of = layout.format_comment(of)
    speed, turn = "rows 0-2 velocity of its origin, 3-5 angular", "in axes of frame 0"

    def make_function(role: str, does: str, equation: str, reads: tuple[ArgumentSpec, ...],
                 output: ArgumentSpec, values: Sequence[Expr]) -> CFunction:  # fmt: skip
        return CFunction(UNIT, f"{role}{suffix}", f"{does} of {of}.", equation, reads, output,
                         list_entries(values))  # fmt: skip

    q, qd = arguments.q, arguments.qd
    return (
        make_function(
            "pose",
            "Pose",
            "x0 = R x + p with T = [R | p], for a point x of the frame",
            (q,),
            ArgumentSpec("T", (3, 4), "1 | m", "pose [R | p] in frame 0"),
            [x for line in derivation.derive_frame_pose(model, frame) for x in line],
        ),
        make_function(
            "jacobian",
            "Jacobian",
            "[velocity; angular velocity] = J qd",
            (q,),
            ArgumentSpec("J", (6, n), "m or rad per unit of q", f"{speed}, {turn}"),
            [x for line in derivation.derive_jacobian(model, frame) for x in line],
        ),
        make_function(
            "jacobian_dot_qd",
            "Product of the Jacobian's rate with qd",
            "[acceleration; angular acceleration] = J qdd + a",
            (q, qd),
            ArgumentSpec("a", (6,), "m/s2 | rad/s2", f"acceleration for qdd = 0, {turn}"),
            derivation.derive_jacobian_dot_qd(model, frame),
        ),
        make_function(
            "twist",
            "Twist",
            "V = [R^T 0; 0 R^T] J qd",
            (q, qd),
            ArgumentSpec("V", (6,), "m/s | rad/s", f"{speed}, in its own axes"),
            derivation.derive_twist(model, frame),
        ),
    )
