"""The units of controllers and of fitted models, made of the functions of the regressors.

The controller's: forward dynamics, Coriolis matrices, momenta, regressors, frames.

The fitted model's: functions with the values in the place of beta. The values are numbers to the
graph, so products of values and lengths are constants, and what a value of 0 multiplies is gone.
Only there may the sign of a speed be smooth: functions that read beta stay those of the regressors,
phi beta, which fits and their checks rely on.
"""

import dataclasses
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from modeler import derivation
from modeler.codegen import functions as layout
from modeler.codegen.advance import build_advance_functions, solve_linear
from modeler.codegen.block import OF_PRECISION
from modeler.codegen.closed import build_closed_dynamics
from modeler.codegen.functions import Arguments, CFunction, Closed, Composed
from modeler.core.errors import EmitError
from modeler.core.manifest import FittedSpec, ModuleSpec
from modeler.derivation import (
    BaseParameters,
    Entries,
    Expr,
    Graph,
    ShaftColumn,
    SymbolicModel,
    combine_along_shaft,
    differentiate,
)

FITTED_UNIT = "_fitted"
"""C file of these functions, without the robot's name and `.c`."""

_TREE = "fitted_tree"


@dataclass(frozen=True)
class Width:
    """The width over which dry friction of a joint, or of its motor, turns.

    Attributes:
        macro: that says it.
        constant: C constant that the macro initialises.
        unit: "rad/s" or "m/s".
    """

    macro: str
    constant: str
    unit: str


def check_values(base: BaseParameters, fitted: FittedSpec) -> None:
    """Checks that there is one finite value of every base parameter, in order.

    Raises:
        EmitError: says what is there instead.
    """
    names = [parameter.name for parameter in base.parameters]
    fitted_names = [parameter.name for parameter in fitted.parameters]
    if fitted_names != names:
        raise EmitError(
            f"values of {', '.join(fitted_names)}; expected those of the base parameters "
            f"{', '.join(names)}; fit the model again"
        )
    for parameter in fitted.parameters:
        if not math.isfinite(parameter.value):
            raise EmitError(
                f"{parameter.name}: got the value {parameter.value}; expected a number; fit the "
                "model again"
            )


def build_fitted_functions(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec
) -> tuple[CFunction, ...]:
    """Returns the twins without their argument beta: internal ones, then those of the header."""
    values = fitted_constants(model, base, fitted)
    if model.closure is None:
        arguments = layout.make_arguments(model.robot.free_joints, model, base)
        stated = [s.value for order in (0, 1) for s in (w[order] for w in model.windups.values())]
        sizes = (Fraction(repr(float(value))) for value in fitted.elastic or stated)
        elastic = [model.graph.constant(value) for value in sizes]
        twins = [*layout.build_dynamics_functions(model, values, arguments)]
        twins += build_advance_functions(model, base, values, elastic) if elastic else ()
        return tuple(remove_beta(f, FITTED_UNIT) for f in twins)
    tree, public = build_closed_dynamics(model, base, values)
    inner = [
        replace(remove_beta(f, FITTED_UNIT), role=f"{_TREE}_{f.role}", internal=True) for f in tree
    ]
    return (*inner, *(remove_beta(f, FITTED_UNIT) for f in public))


def fitted_constants(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec
) -> dict[int, Expr]:
    """Returns the fitted values as constants of the graph, by standard column."""
    values = (Fraction(repr(float(known.value))) for known in fitted.parameters)
    pairs = zip(base.parameters, values, strict=True)
    return {parameter.column: model.graph.constant(value) for parameter, value in pairs}


def remove_beta(function: CFunction, unit: str) -> CFunction:
    """Returns the twin of a function that reads beta, for the fitted values."""
    closed, composed = function.closed, function.composed
    if closed is not None:
        reads = ", ".join(name for name in closed.reads.split(", ") if name != "beta")
        closed = replace(closed, tree=_TREE, reads=reads)
    if composed is not None:
        roles = {word: _twin(role) for word, role in composed.roles.items()}
        composed = replace(composed, roles=roles)
    inputs = tuple(a for a in function.inputs if a.name not in ("beta", "elastic"))
    role = _twin(function.role)
    changed = replace(function, unit=unit, role=role, inputs=inputs)
    return replace(changed, closed=closed, composed=composed)


def _twin(role: str) -> str:
    return role if role == "jacobian" else f"fitted_{role}"  # which reads no parameters


def find_widths(
    prefix: str, model: SymbolicModel, functions: Sequence[CFunction]
) -> Mapping[int, Width]:
    """Returns {speed: its width} of joints and motors of whose speed functions read the sign.

    Joints that always move alike have one speed, and the width of the first of them; a joint and
    its motor have one width. A sign of anything else than such a speed leaps where it did.
    """
    values = [value for function in functions for _, value in function.entries]
    if values:
        model = replace(model, graph=values[0].graph)
    nodes = [model.graph.nodes[index] for index in model.graph.find_reachable(values)]
    read = {node.args[0] for node in nodes if node.op == "sign"}
    widths: dict[int, Width] = {}
    for column in model.columns:
        for part in column.parts if isinstance(column, ShaftColumn) else ():
            speed = abs(combine_along_shaft(model, part.shaft, "qd").ref)
            if speed in read and speed not in widths:
                joint = model.robot.joints[part.row]
                macro, name = (
                    f"{prefix.upper()}_COULOMB_WIDTH_{joint.name}",
                    f"{prefix}_width_{joint.name}",
                )
                widths[speed] = Width(macro, name, f"{joint.unit}/s")
    return widths


def format_fitted_texts(
    spec: ModuleSpec, fitted: FittedSpec, widths: Sequence[Width]
) -> dict[str, Any]:
    """Returns finished strings for the templates of the unit."""
    line = fitted.verdict or "one that nobody has judged"
    verdict = f"The fit of this model is {line[:1].lower()}{line[1:]}"
    doubts = [f"Doubt: {doubt}" for doubt in fitted.warnings if doubt not in fitted.verdict]
    warning = "" if fitted.valid else "WARNING. "
    # Lines of the C table: the value, which it is, its unit, its uncertainty.
    places = layout.name_enumerators(spec.prefix, "beta", [base.name for base in spec.base])
    lines, literal = list[str](), OF_PRECISION[spec.precision].format_literal
    for parameter, place in zip(fitted.parameters, places, strict=True):
        sure = "set aside: the logs do not identify it"
        if parameter.sigma is not None:
            sure = f"sigma {parameter.sigma:.2g}{'' if parameter.essential else ', not essential'}"
        comma = "," if len(lines) + 1 < len(fitted.parameters) else " "
        about = layout.format_comment_line(f"{place} [{parameter.unit}], {sure}")
        lines.append(f"    {literal(parameter.value):>24}{comma} /* {about} */")
    sizes, count = fitted.elastic or spec.elastic, len(spec.windups)
    springs = [
        f"Elastic joint {spec.signals[k].joint}: stiffness {sizes[i]:.6g}, damping "
        f"{sizes[count + i]:.6g}."
        for i, k in enumerate(spec.windups)
    ]
    remarks = [f"{warning}{verdict}", *doubts, *springs, *fitted.notes]
    return {
        "widths": widths,
        "remarks": layout.format_comment_lines(remarks),
        "effort": " or ".join(dict.fromkeys(joint.effort_unit for joint in spec.joints)),
        "lines": lines,
        "gains": layout.wrap_names([literal(gain) for gain in fitted.gains]),
    }


# The controller's unit.


TURNS = 30
"""Corrections of the accelerations, at most, where effects read them."""


@dataclass(frozen=True)
class Efforts:
    """tau = M qdd + bias(q, qd) + f(q, qd, qdd), as matrix and right side of one equation.

    Attributes:
        matrix: d tau/d qdd, (n, n).
        bias: tau at qdd = 0; at the qdd that is read, where it is implicit.
        is_implicit: True if effects read qdd otherwise than linearly, or not by a symmetric matrix.
    """

    matrix: Sequence[Sequence[Expr]]
    bias: Sequence[Expr]
    is_implicit: bool


def build_efforts(model: SymbolicModel, beta: Mapping[int, Expr]) -> Efforts:
    """Returns the matrix and the rest of the torques of a robot with these parameters by column."""
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


def build_forward_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Returns forward dynamics, its derivatives, inertia of the tool; internal functions first.

    A robot with elastic joints has the last alone.
    """
    n, arguments = model.geometry.coordinate_count, arguments.extend("control")
    tool = {"matrix": "inertia_matrix", "J": "jacobian"}
    tools = [
        arguments.declare(role, composed=Composed(role, tool))
        for role in ("operational_inertia", "operational_inverse")
    ]
    if model.windups:  # accelerations follow from the windup too, which moves by itself
        return tuple(tools)
    efforts = build_efforts(model, beta)
    correction, pivots = solve_linear(
        efforts.matrix, [-r + model.graph.symbol(f"tau[{j}]") for j, r in enumerate(efforts.bias)]
    )
    diagonal = [efforts.matrix[k][k] for k in range(n)]
    words = {"step": 3 * n, "motion": "q qd qdd" if efforts.is_implicit else "q qd"}
    numbers = [*correction, *pivots, *diagonal]
    functions = [arguments.declare("forward_step", numbers, words, internal=True)]
    matrix = "inertia_matrix"
    if efforts.is_implicit:
        matrix, numbers = "effort_slopes", [x for row in efforts.matrix for x in row]
        functions.append(arguments.declare(matrix, numbers, internal=True))
    step = {"step": "forward_step"}
    slopes = {"dynamics": "forward_dynamics", "slopes": "derivatives", "matrix": matrix}
    calls = {"forward_dynamics": step, "forward_derivatives": step | slopes}
    turns = TURNS if efforts.is_implicit else 1
    for role, parts in calls.items():
        functions.append(arguments.declare(role, composed=Composed(role, parts, turns)))
    return (*functions, *tools)


# Functions that take the widths of dry friction while they run, beside the parameters.
#
# With beta they are what a parameter set of a controller holds; see templates/parameter_set.jinja.


SMOOTH = "smooth_"
"""Start of their roles."""


def build_smooth_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Returns inverse dynamics and friction with an argument `widths`.

    None where no friction leaps.
    """
    every = layout.build_dynamics_functions(model, beta, arguments)
    functions = [f for f in every if f.role in ("inverse_dynamics", "friction")]
    count = len(dict.fromkeys(find_widths("", model, functions).values()))
    spec = arguments.extend("smooth", widths=count)["widths"]
    return tuple(
        dataclasses.replace(
            function, unit=UNIT, role=f"{SMOOTH}{function.role}", inputs=(*function.inputs, spec)
        )
        for function in functions
        if count
    )


def list_turning_joints(model: SymbolicModel, base: BaseParameters) -> list[str]:
    """Returns names of the joints, or motors, that `widths` are of, in its order."""
    beta = layout.make_beta_symbols(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    widths = find_widths("", model, build_smooth_functions(model, beta, arguments))
    return [get_turning_joint(width) for width in dict.fromkeys(widths.values())]


def get_turning_joint(width: Width) -> str:
    """Returns the name of the joint, or motor, that a width is of."""
    return width.macro.partition("_COULOMB_WIDTH_")[2]


# The controller's functions of a robot with loops, in its coordinates: made of the opened tree's.
#
# With ud = G qd and udd = G qdd + G' qd, G' = dG/dt, a quantity of the tree carries over as
#
#     C = G^T (C_u G + M_u G'),  p = G^T p_u,  C^T qd = G^T C_u^T ud + G'^T p_u,
#     Y(q, qd, v, a) = G^T Y_u(u, G qd, G v, G a + G' v),  J = J_u G,
#
# since G' is linear in qd and symmetric, as a second derivative of u(q). Every function exists at a
# state too (`<role>_at`), of which the loops are closed already.


_BESIDE = {
    "coriolis_matrix": "tree_inertia_matrix",
    "coriolis_transpose": "tree_momentum",
    "momentum_rest": "tree_momentum_regressor",
}
"""What a form calls besides the tree's function of the same name."""

_READS = {"q": "now->u", "qd": "now->ud", "v": "vu", "a": "au"}


@dataclass(frozen=True, kw_only=True)
class AtState(Composed):
    """A function that is made at a closed posture, from a state of the robot.

    Attributes:
        form: which macro of the template makes it.
        reads: what the tree's function reads, as C.
        width: columns that are projected.
    """

    form: str
    reads: str = ""
    width: int = 1


def build_closed_control_functions(
    model: SymbolicModel, base: BaseParameters, tree: Iterable[CFunction]
) -> tuple[CFunction, ...]:
    """Returns the tree's functions that are needed, internal; then those of the closed robot.

    Args:
        model: with loops.
        base: its base parameters.
        tree: the controller's functions of the opened tree.
    """
    arguments = layout.make_arguments(model.robot.coordinates, model, base)
    arguments = arguments.extend("control", u=len(model.robot.free_joints))
    names, g = {name: arguments[name] for name in ("q", "qd", "beta")}, arguments.words["n"]
    inner, public = list[CFunction](), list[CFunction]()
    forms = dict(sorted(layout.read_catalogue()["control"].items(), reverse=True))
    for f in tree:
        rows = (form for role, form in forms.items() if f"{f.role}_".startswith(f"{role}_"))
        row = next(rows, None)
        form = row and row.get("form")
        if form is None:
            continue
        names |= {a.name: dataclasses.replace(a, shape=(g,)) for a in f.inputs if a.name in "va"}
        shape = {
            "direct": f.output.shape,
            "coriolis_matrix": (g, g),
            "jacobian": (6, g),
            "jacobian_dot_qd": (6,),
        }.get(form, (g, *f.output.shape[1:]))
        role = f"tree_{f.role}"
        beside = _BESIDE.get(form, role.replace("jacobian_dot_qd", "jacobian"))
        made = AtState(
            "at_state",
            {"made": role, "beside": beside},
            form=form,
            reads=", ".join(_READS.get(a.name, a.name) for a in f.inputs),
            width=f.output.shape[1] if len(f.output.shape) > 1 else 1,
        )
        inner.append(dataclasses.replace(f, role=role, internal=True))
        public.append(
            dataclasses.replace(
                f,
                inputs=tuple(names[a.name] for a in f.inputs),
                output=dataclasses.replace(f.output, shape=shape),
                entries=(),
                composed=made,
            )
        )
    parts = {"matrix": "inertia_matrix", "torques": "inverse_dynamics"}
    forward = AtState("at_state", parts, TURNS, form="forward_dynamics")
    public += [
        arguments.declare("coupling_rate", composed=AtState("at_state", {}, form="rate")),
        arguments.declare("forward_dynamics", row="closed_forward_dynamics", composed=forward),
    ]
    return (*inner, *public)


def build_fitted_closed(functions: Sequence[CFunction]) -> tuple[CFunction, ...]:
    """Builds the twins, with the fitted values, of the functions that read beta."""
    twins = []
    for f in functions:
        if f.composed is None or all(a.name != "beta" for a in f.inputs):
            continue
        made = AtState("at_state", {"made": f.role}, form="fitted")
        if f.role == "forward_dynamics":  # friction turns over its widths
            parts = {word: f"fitted_{role}" for word, role in f.composed.roles.items()}
            made = AtState("at_state", parts, TURNS, form="forward_dynamics")
        inputs = tuple(a for a in f.inputs if a.name != "beta")
        twins.append(dataclasses.replace(f, role=f"fitted_{f.role}", inputs=inputs, composed=made))
    return tuple(twins)


def format_state_prototypes(prefix: str, function: CFunction, number: str) -> tuple[str, str, str]:
    """Returns prototypes where loops are closed: made of a posture.

    Of a state, declared and defined.
    """
    closed = function.closed
    if closed is None and not isinstance(function.composed, AtState):
        return "", "", ""
    motion = (closed.q, closed.qd, closed.start) if closed is not None else ("q", "qd")
    inputs = tuple(a for a in function.inputs if a.name not in motion)
    reduced = dataclasses.replace(function, inputs=inputs)
    name = f"{prefix}_{function.role}_at"
    plain, state = layout.format_arguments(reduced, number, prefix), f"struct {prefix}_state *state"
    posture = [f"struct {prefix}_posture *p", f"{number} *rows"]
    defined = layout.format_arguments(reduced, number, prefix, defined=True)
    made = [*posture, *defined]
    return (
        layout.format_prototype(f"made_{function.role}", made, "static void"),
        layout.format_prototype(name, [state, *plain], "int"),
        layout.format_prototype(name, [state, *defined], "int"),
    )


# What a controller calls besides torques and regressors: functions of the unit `<prefix>_control`.
#
# Fits do without them, so they are emitted only where a folder for a controller is written.


UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""


@dataclass(frozen=True)
class Control:
    """What of the controller's unit is emitted.

    Attributes:
        frames: names of further frames whose Jacobians are wanted: rows, links of [frames].
        only: roles of the functions that are wanted, and `observation`; empty: all.
        vectors: add the table of `vectors.vector_lines` and the program that reads it.
        structured_text: add the function blocks of `codegen.printers`.
        a2l: add the description of the parameter set, of `codegen.printers`.
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
    """Selects the roles of the functions that stay: those requested, and what they call.

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
    """Returns the functions of the unit, those that read the parameters with their argument beta.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        control: what is wanted.

    Raises:
        EmitError: a frame is unknown, or two have one name in C.
    """
    model = _isolate_graph(model)
    arguments = layout.make_arguments(model.robot.free_joints, model, base).extend("control")
    beta = layout.make_beta_symbols(model, base)
    functions = (
        *_build_dynamics(model.rigid, beta, arguments),
        *_build_regressors(model.rigid, base, arguments),
        *_build_frames(model.rigid, control, arguments),
    )
    if model.closure is not None:
        return build_closed_control_functions(model, base, functions)
    return (
        *functions,
        arguments.declare("derivatives", _differentiate_torques(model, beta)),
        *build_forward_functions(model, beta, arguments),
        *build_smooth_functions(model, beta, arguments),
    )


def build_fitted_control_functions(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec, plain: Sequence[CFunction]
) -> tuple[CFunction, ...]:
    """Builds the twins of functions that read beta, with the values written into them.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        fitted: their values.
        plain: the functions that read beta.
    """
    if model.closure is not None:
        return build_fitted_closed(plain)
    model = _isolate_graph(model)
    arguments = layout.make_arguments(model.robot.free_joints, model, base).extend("control")
    values = fitted_constants(model, base, fitted)
    functions = (
        *_build_dynamics(model.rigid, values, arguments),
        arguments.declare("derivatives", _differentiate_torques(model, values)),
        *build_forward_functions(model, values, arguments),
    )
    return tuple(remove_beta(f, UNIT) for f in functions)


def _isolate_graph(model: SymbolicModel) -> SymbolicModel:
    """The model in a graph of its own, so that what others left there cannot change the C."""
    graph = Graph(apart=True)
    graph.tables |= model.graph.tables  # one law has one name in all C
    return dataclasses.replace(model, graph=graph)


def _build_dynamics(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Functions that read beta, of a robot without loops."""
    matrix = derivation.derive_coriolis_matrix(model, beta)
    values = {
        "coriolis_matrix": [value for row in matrix for value in row],
        "coriolis_transpose": derivation.derive_coriolis_transpose(model, beta),
        "momentum": derivation.derive_momentum(model, beta),
    }
    momenta = " or ".join(f"{unit} s" for unit in arguments["tau"].unit.split(" or "))
    return tuple(
        arguments.declare(role, each, {"momenta": momenta}) for role, each in values.items()
    )


def _differentiate_torques(model: SymbolicModel, beta: Mapping[int, Expr]) -> list[Expr]:
    n, one = model.geometry.coordinate_count, model.graph.constant(1)
    torque = model.derive_torque(beta)
    slopes = []
    for kind in ("q", "qd"):
        columns = [derivation.differentiate(torque, {f"{kind}[{j}]": one}, True) for j in range(n)]
        slopes += [columns[j][i] for i in range(n) for j in range(n)]
    return slopes


# Regressors of a controller that adapts, or identifies without accelerations.


def _build_regressors(
    model: SymbolicModel, base: BaseParameters, arguments: Arguments
) -> tuple[CFunction, ...]:
    if layout.needs_more_than_speed(model) or model.windups:
        return ()
    place = {parameter.column: i for i, parameter in enumerate(base.parameters)}
    functions = []
    regressors: dict[str, Callable[[SymbolicModel], Entries]] = {
        "slotine_li_regressor": derivation.derive_slotine_li_regressor,
        "momentum_regressor": derivation.derive_momentum_regressor,
        "momentum_rest_regressor": derivation.derive_momentum_rest_regressor,
        "energy_regressor": derivation.derive_energy_regressor,
        "power_regressor": derivation.derive_power_regressor,
    }
    for role, make_regressor in regressors.items():
        entries = make_regressor(model)
        based = {(row, place[k]): value for (row, k), value in entries.items() if k in place}
        places = [(row * base.rank + i, value) for (row, i), value in layout.sort_by_column(based)]
        functions.append(arguments.declare(role, entries=tuple(places)))
    return tuple(functions)


# Frames that a controller steers.


def _build_frames(model: SymbolicModel, control: Control, arguments: Arguments) -> list[CFunction]:
    suffixes = {"": ""}
    for name in control.frames:
        suffix = "_" + re.sub(r"[^A-Za-z0-9_]", "_", name).lower()
        if suffixes.setdefault(suffix, name) != name or suffix == "_dot_qd":
            raise EmitError(
                f'frame "{name}": functions of another frame or role end in {suffix} too; rename it'
            )
    names = suffixes.items()
    listed = (_build_frame_functions(model, name, suffix, arguments) for suffix, name in names)
    return [function for functions in listed for function in functions]


def _build_frame_functions(
    model: SymbolicModel, name: str, suffix: str, arguments: Arguments
) -> Sequence[CFunction]:
    frame = derivation.find_body_frame(model, name)
    row = model.robot.joints[frame.row].name
    of = f"frame {name}" if name else "the tool" if model.robot.tool else f"the frame of row {row}"
    values = {
        "pose": [x for line in derivation.derive_frame_pose(model, frame) for x in line],
        "jacobian": [x for line in derivation.derive_jacobian(model, frame) for x in line],
        "jacobian_dot_qd": derivation.derive_jacobian_dot_qd(model, frame),
        "twist": derivation.derive_twist(model, frame),
    }
    more = {"frame": of}
    return [arguments.declare(f"{r}{suffix}", x, more, row=r) for r, x in values.items()]
