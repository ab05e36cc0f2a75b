"""What controllers read of momentum, energy and speeds that are not the robot's own.

Momentum p = M qd is the torque that accelerations qd ask of a robot at rest without gravity, so the
recursions of the torque give it. With T = qd^T M qd/2, dT/dq = C^T qd and

    tau = M qdd + C qd + g + f = dp/dt - C^T qd + g + f,
    tau . qd = d/dt (T + U) + f . qd.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import partial

from modeler.derivation.columns import LinkColumn, ShaftColumn
from modeler.derivation.coriolis import compute_coriolis_matrix as tree_coriolis_matrix, cross_z
from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.graph import Expr, Vector
from modeler.derivation.kinematics import (
    Motion,
    Pose,
    Screw,
    accumulate_wrenches,
    compute_frame_gravity,
    compute_inverse_dynamics,
    compute_link_wrench,
    compute_wrench_columns,
    cross,
    dot,
    plus,
    project_wrench,
    times,
)
from modeler.derivation.model import (
    Entries,
    SymbolicModel,
    combine_along_shaft,
    derive_effect_entries,
)

_HALF = Fraction(1, 2)


def derive_coriolis_matrix(
    model: SymbolicModel, parameters: Mapping[int, Expr]
) -> list[list[Expr]]:
    """Returns C(q, qd) of the free variables by Christoffel symbols: dM/dt = C + C^T.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    qd, zero = model.get_inputs("qd"), model.graph.constant(0)
    moved = model.derive_link_motions(qd, [zero] * len(qd), gravity=False)
    rows = model.collect_link_parameters(parameters)
    tree = tree_coriolis_matrix(
        model.geometry, model.frames, moved, model.expand_to_rows(qd), rows, zero
    )
    half = [model.reduce_to_free(line) for line in zip(*tree, strict=True)]
    return [model.reduce_to_free([line[i] for line in half]) for i in range(len(qd))]


def _propagate_twists(model: SymbolicModel) -> list[Motion]:
    """Motions whose accelerations are the speeds: wd and vd are the twists of the links."""
    still = [model.graph.constant(0)] * model.geometry.coordinate_count
    with model.relabel_speeds():
        return model.derive_link_motions(still, model.get_inputs("qd"), gravity=False)


def derive_momentum(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """Returns M(q) qd along the free variables, rotor inertias included.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.collect_link_parameters(parameters), model.graph.constant(0)
    moved, qd = _propagate_twists(model), model.get_inputs("qd")
    with model.relabel_speeds():
        momenta = compute_inverse_dynamics(model.geometry, model.frames, moved, rows, zero)
    momenta = model.reduce_to_free(momenta)
    for i, j, value in model.enumerate_rotor_inertias(parameters):
        momenta[i] = momenta[i] + value * qd[j]
    return momenta


def derive_coriolis_transpose(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """Returns C(q, qd)^T qd along the free variables, which is dT/dq.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.collect_link_parameters(parameters), model.graph.constant(0)
    moved = _propagate_twists(model)
    row_torques = [zero] * model.geometry.joint_count
    with model.relabel_speeds():
        momenta = list(
            accumulate_wrenches(
                model.geometry, model.frames, lambda k: compute_link_wrench(moved[k], rows[k], zero)
            )
        )
    for k, f, n in momenta:
        row = model.geometry.rows[k]
        if row.index is not None:
            row_torques[row.index] = project_wrench(_differentiate_twist(row, moved[k]), f, n)
    return model.reduce_to_free(row_torques)


def _differentiate_twist(row: GeometryRow, motion: Motion) -> Screw:
    """d w/d q and d v/d q of the row's link for its own joint: (w x z, v x z), or (0, w x z)."""
    w, v = (times(-row.rate, cross_z(x)) for x in (motion.wd, motion.vd))
    return Screw(w, v) if row.joint.is_revolute else Screw([0 * x for x in w], w)


def _differentiate_twists(
    geometry: Geometry, frames: Sequence[Pose], moved: Sequence[Motion]
) -> list[dict[int, Screw]]:
    """For every row, how the twist of its link changes with each joint that moves it."""
    twist_changes: list[dict[int, Screw]] = []
    for k, row in enumerate(geometry.rows):
        before = {} if row.parent is None else twist_changes[row.parent]
        carried = {
            index: Screw(
                frames[k].rotate_to_link(s.e),
                frames[k].rotate_to_link(plus(s.m, cross(s.e, frames[k].p))),
            )
            for index, s in before.items()
        }
        if row.index is not None:
            carried[row.index] = _differentiate_twist(row, moved[k])
        twist_changes.append(carried)
    return twist_changes


def derive_slotine_li_regressor(model: SymbolicModel) -> Entries:
    """Returns Y of Y chi = M(q) a + C(q, qd) v + g(q) + f(v), over all standard columns.

    Slotine and Li 1987; by the recursion of Newton and Euler with two speeds. Friction takes v for
    qd, rotor inertia takes a.
    """
    qd, v, a = (model.get_inputs(kind) for kind in ("qd", "v", "a"))
    links = model.build_projection(model.derive_link_motions(qd, a, v=v))
    return model.assemble_entries(
        links, partial(derive_effect_entries, model, motion=("q", "v", "a"))
    )


def derive_momentum_regressor(model: SymbolicModel) -> Entries:
    """Returns P of p = P chi, over all standard columns."""

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = combine_along_shaft(model, part.shaft, "qd")
        return {k: speed * coefficient for k, coefficient in part.shaft.items()}

    moved = _propagate_twists(model)
    with model.relabel_speeds():
        links = model.build_projection(moved)
    return model.assemble_entries(links, build_shaft_entries)


def derive_momentum_rest_regressor(model: SymbolicModel) -> Entries:
    """Returns R of tau = d/dt (P chi) + R chi: gravity and friction less dT/dq."""
    zero = model.graph.constant(0)
    still, moved = [zero] * model.geometry.coordinate_count, _propagate_twists(model)
    gravity = model.build_projection(model.derive_link_motions(still, still))
    momenta = [compute_wrench_columns(motion) for motion in moved]
    changes = _differentiate_twists(model.geometry, model.frames, moved)

    def build_link_entries(part: LinkColumn) -> dict[int, Expr]:
        f, n = momenta[part.row][part.prefix]
        rows = [zero] * model.geometry.joint_count
        for index, change in changes[part.row].items():
            rows[index] = project_wrench(change, f, n)
        weight = gravity(part)
        return {k: weight.get(k, zero) - x for k, x in enumerate(model.reduce_to_free(rows))}

    return model.assemble_entries(build_link_entries, partial(_derive_losses, model))


def _derive_losses(model: SymbolicModel, part: ShaftColumn) -> dict[int, Expr]:
    return {} if part.kind == "rotor_inertia" else derive_effect_entries(model, part)


def derive_energy_regressor(model: SymbolicModel) -> Entries:
    """Returns h of T + U = h chi, one row; the energy is 0 at height 0 of frame 0."""
    geometry, algebra = model.geometry, model.algebra
    moved, down = _propagate_twists(model), compute_frame_gravity(geometry, model.frames, algebra)
    momenta = [compute_wrench_columns(motion) for motion in moved]
    base = [algebra.static(entry) for entry in geometry.gravity]
    heights: list[Expr] = []  # -g . p of the frames' origins
    for row, frame in zip(geometry.rows, model.frames, strict=True):
        below = base if row.parent is None else down[row.parent]
        before = model.graph.constant(0) if row.parent is None else heights[row.parent]
        heights.append(before - dot(below, frame.p))

    def build_link_entries(part: LinkColumn) -> dict[int, Expr]:
        twist = Screw(moved[part.row].wd, moved[part.row].vd)
        kinetic = project_wrench(twist, *momenta[part.row][part.prefix]) * _HALF
        weight: Vector = down[part.row]
        potential = dict(zip(("MX", "MY", "MZ"), (-x for x in weight), strict=True))
        potential["M"] = heights[part.row]
        return {0: kinetic + potential.get(part.prefix, 0)}

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = combine_along_shaft(model, part.shaft, "qd")
        return {0: speed * speed * _HALF}

    return model.assemble_entries(build_link_entries, build_shaft_entries)


def derive_power_regressor(model: SymbolicModel) -> Entries:
    """Returns d of tau .

    qd = d/dt (h chi) + d chi, one row: the power that friction and offsets take.
    """
    qd, zero = model.get_inputs("qd"), model.graph.constant(0)

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        return {0: sum((qd[k] * x for k, x in _derive_losses(model, part).items()), zero)}

    return model.assemble_entries(lambda part: {}, build_shaft_entries)
