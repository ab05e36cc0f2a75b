"""The controller's functions of a robot with loops, in its coordinates: made of the opened tree's.

With ud = G qd and udd = G qdd + G' qd, G' = dG/dt, a quantity of the tree carries over as

    C = G^T (C_u G + M_u G'),  p = G^T p_u,  C^T qd = G^T C_u^T ud + G'^T p_u,
    Y(q, qd, v, a) = G^T Y_u(u, G qd, G v, G a + G' v),  J = J_u G,

since G' is linear in qd and symmetric, as a second derivative of u(q). Every function exists at a
state too (`<role>_at`), of which the loops are closed already.
"""

import dataclasses
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from modeler.codegen import functions as layout
from modeler.codegen.forward import TURNS, UNIT
from modeler.codegen.functions import CFunction, Composed
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import BaseParameters, SymbolicModel

_FORMS = {
    "coriolis_matrix": "coriolis_matrix", "coriolis_transpose": "coriolis_transpose",
    "momentum": "projected", "slotine_li_regressor": "slotine_li",
    "momentum_regressor": "projected", "momentum_rest_regressor": "momentum_rest",
    "energy_regressor": "direct", "power_regressor": "direct",
}  # fmt: skip
"""How those of the tree carry over; what is not here belongs to a frame, or has no such form."""

_FRAMES = {
    "jacobian_dot_qd": "jacobian_dot_qd", "jacobian": "jacobian",
    "pose": "direct", "twist": "direct",
}  # fmt: skip
"""Those of a frame, by the start of their names: the longer ones first."""

_BESIDE = {
    "coriolis_matrix": "tree_inertia_matrix", "coriolis_transpose": "tree_momentum",
    "momentum_rest": "tree_momentum_regressor",
}  # fmt: skip
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
    """The tree's functions that are needed, internal; then those of the closed robot.

    Args:
        model: with loops.
        base: its base parameters.
        tree: the controller's functions of the opened tree.
    """
    arguments = layout.make_arguments(model.robot.coordinates, model, base)
    names = {argument.name: argument for argument in (arguments.q, arguments.qd, arguments.beta)}
    n, g = len(model.robot.free_joints), arguments.q.size
    inner, public = list[CFunction](), list[CFunction]()
    for f in tree:
        form = _FORMS.get(f.role) or next(
            (form for start, form in _FRAMES.items() if f.role.startswith(start)), None
        )
        if form is None:
            continue
        names |= {a.name: dataclasses.replace(a, shape=(g,)) for a in f.inputs if a.name in "va"}
        shape = {
            "direct": f.output.shape, "coriolis_matrix": (g, g), "jacobian": (6, g),
            "jacobian_dot_qd": (6,),
        }.get(form, (g, *f.output.shape[1:]))  # fmt: skip
        role = f"tree_{f.role}"
        beside = _BESIDE.get(form, role.replace("jacobian_dot_qd", "jacobian"))
        made = AtState(
            "at_state", {"made": role, "beside": beside}, form=form,
            reads=", ".join(_READS.get(a.name, a.name) for a in f.inputs),
            width=f.output.shape[1] if len(f.output.shape) > 1 else 1,
        )  # fmt: skip
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
    rate = ArgumentSpec("rate", (n, g), "SI", "d/dt of the coupling G")
    parts = {"matrix": "inertia_matrix", "torques": "inverse_dynamics"}
    public += [
        CFunction(
            UNIT,
            "coupling_rate",
            "Rate of the coupling: udd = G qdd + dG/dt qd.",
            "dG/dt",
            (arguments.q, arguments.qd),
            rate,
            (),
            composed=AtState("at_state", {}, form="rate"),
        ),
        CFunction(
            UNIT,
            "forward_dynamics",
            "Accelerations under these torques, friction included.",
            "M(q) qdd = tau - c(q, qd) - g(q) - f(qd)",
            (arguments.q, arguments.qd, arguments.tau, arguments.beta),
            arguments.qdd,
            (),
            composed=AtState("at_state", parts, TURNS, form="forward_dynamics"),
        ),
    ]
    return (*inner, *public)


def build_fitted_closed(functions: Sequence[CFunction]) -> tuple[CFunction, ...]:
    """Twins of those that read beta, with the fitted values."""
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
    """Prototypes where loops are closed: made of a posture; of a state, declared and defined."""
    closed = function.closed
    if closed is None and not isinstance(function.composed, AtState):
        return "", "", ""
    motion = (closed.q, closed.qd, closed.start) if closed is not None else ("q", "qd")
    reduced = dataclasses.replace(
        function, inputs=tuple(a for a in function.inputs if a.name not in motion)
    )
    name = f"{prefix}_{function.role}_at"
    plain, state = layout.format_arguments(reduced, number, prefix), f"struct {prefix}_state *state"
    posture = [f"struct {prefix}_posture *p", f"{number} *rows"]
    defined_arguments = layout.format_arguments(reduced, number, prefix, defined=True)
    return (
        layout.format_prototype(
            f"made_{function.role}", [*posture, *defined_arguments], "static void"
        ),
        layout.format_prototype(name, [state, *plain], "int"),
        layout.format_prototype(name, [state, *defined_arguments], "int"),
    )
