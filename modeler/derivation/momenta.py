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
from modeler.derivation.coriolis import about_z, coriolis_matrix as tree_coriolis_matrix
from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.graph import Expr, Vector
from modeler.derivation.kinematics import (
    Motion,
    Pose,
    Screw,
    cross,
    dot,
    gravity_in_frames,
    inverse_dynamics,
    link_wrench,
    plus,
    project,
    times,
    wrench_columns,
    wrenches,
)
from modeler.derivation.model import Entries, SymbolicModel, along, effect_entries

_HALF = Fraction(1, 2)


def coriolis_matrix(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[list[Expr]]:
    """C(q, qd) of the free variables, of Christoffel symbols: c = C qd, dM/dt = C + C^T.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    qd, zero = model.inputs("qd"), model.graph.constant(0)
    moved = model.link_motions(qd, [zero] * len(qd), gravity=False)
    rows = model.link_parameters(parameters)
    tree = tree_coriolis_matrix(model.geometry, model.frames, moved, model.of_rows(qd), rows, zero)
    half = [model.free_efforts(line) for line in zip(*tree, strict=True)]
    return [model.free_efforts([line[i] for line in half]) for i in range(len(qd))]


def _as_accelerations(model: SymbolicModel) -> list[Motion]:
    """Motions whose accelerations are the speeds: wd and vd are the twists of the links."""
    still = [model.graph.constant(0)] * model.geometry.coordinates
    with model.speeds_for_accelerations():
        return model.link_motions(still, model.inputs("qd"), gravity=False)


def momentum(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """M(q) qd along the free variables, rotor inertias included.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.link_parameters(parameters), model.graph.constant(0)
    moved, qd = _as_accelerations(model), model.inputs("qd")
    with model.speeds_for_accelerations():
        found = inverse_dynamics(model.geometry, model.frames, moved, rows, zero)
    found = model.free_efforts(found)
    for i, j, value in model.rotors(parameters):
        found[i] = found[i] + value * qd[j]
    return found


def coriolis_transpose(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """C(q, qd)^T qd along the free variables, which is dT/dq.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.link_parameters(parameters), model.graph.constant(0)
    moved = _as_accelerations(model)
    found = [zero] * model.geometry.joints
    with model.speeds_for_accelerations():
        momenta = list(
            wrenches(model.geometry, model.frames, lambda k: link_wrench(moved[k], rows[k], zero))
        )
    for k, f, n in momenta:
        row = model.geometry.rows[k]
        if row.index is not None:
            found[row.index] = project(_turned_twist(row, moved[k]), f, n)
    return model.free_efforts(found)


def _turned_twist(row: GeometryRow, motion: Motion) -> Screw:
    """d w/d q and d v/d q of the row's link for its own joint: (w x z, v x z), or (0, w x z)."""
    w, v = (times(-row.rate, about_z(x)) for x in (motion.wd, motion.vd))
    return Screw(w, v) if row.joint.angular else Screw([0 * x for x in w], w)


def _turned_twists(
    geometry: Geometry, frames: Sequence[Pose], moved: Sequence[Motion]
) -> list[dict[int, Screw]]:
    """For every row, how the twist of its link changes with each joint that moves it."""
    found: list[dict[int, Screw]] = []
    for k, row in enumerate(geometry.rows):
        before = {} if row.parent is None else found[row.parent]
        carried = {
            index: Screw(
                frames[k].to_link(s.e), frames[k].to_link(plus(s.m, cross(s.e, frames[k].p)))
            )
            for index, s in before.items()
        }
        if row.index is not None:
            carried[row.index] = _turned_twist(row, moved[k])
        found.append(carried)
    return found


def slotine_li_regressor(model: SymbolicModel) -> Entries:
    """Y of Y chi = M(q) a + C(q, qd) v + g(q) + f(v), over all standard columns.

    Slotine and Li 1987; by the recursion of Newton and Euler with two speeds. Friction takes v for
    qd, rotor inertia takes a.
    """
    qd, v, a = (model.inputs(kind) for kind in ("qd", "v", "a"))
    links = model.projected(model.link_motions(qd, a, v=v))
    return model.entries(links, partial(effect_entries, model, motion=("q", "v", "a")))


def momentum_regressor(model: SymbolicModel) -> Entries:
    """P of p = P chi, over all standard columns."""

    def shaft(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = along(model, part.shaft, "qd")
        return {k: speed * coefficient for k, coefficient in part.shaft.items()}

    moved = _as_accelerations(model)
    with model.speeds_for_accelerations():
        links = model.projected(moved)
    return model.entries(links, shaft)


def momentum_rest_regressor(model: SymbolicModel) -> Entries:
    """R of tau = d/dt (P chi) + R chi: gravity and friction less dT/dq, over all columns."""
    zero = model.graph.constant(0)
    still, moved = [zero] * model.geometry.coordinates, _as_accelerations(model)
    gravity = model.projected(model.link_motions(still, still))
    momenta = [wrench_columns(motion) for motion in moved]
    changes = _turned_twists(model.geometry, model.frames, moved)

    def link(part: LinkColumn) -> dict[int, Expr]:
        f, n = momenta[part.row][part.prefix]
        rows = [zero] * model.geometry.joints
        for index, change in changes[part.row].items():
            rows[index] = project(change, f, n)
        weight = gravity(part)
        return {k: weight.get(k, zero) - x for k, x in enumerate(model.free_efforts(rows))}

    return model.entries(link, partial(_losses, model))


def _losses(model: SymbolicModel, part: ShaftColumn) -> dict[int, Expr]:
    return {} if part.kind == "rotor_inertia" else effect_entries(model, part)


def energy_regressor(model: SymbolicModel) -> Entries:
    """h of T + U = h chi, one row: kinetic and potential energy, 0 at height 0 of frame 0."""
    geometry, algebra = model.geometry, model.algebra
    moved, down = _as_accelerations(model), gravity_in_frames(geometry, model.frames, algebra)
    momenta = [wrench_columns(motion) for motion in moved]
    base = [algebra.static(entry) for entry in geometry.gravity]
    heights: list[Expr] = []  # -g . p of the frames' origins
    for row, frame in zip(geometry.rows, model.frames, strict=True):
        below = base if row.parent is None else down[row.parent]
        before = model.graph.constant(0) if row.parent is None else heights[row.parent]
        heights.append(before - dot(below, frame.p))

    def link(part: LinkColumn) -> dict[int, Expr]:
        twist = Screw(moved[part.row].wd, moved[part.row].vd)
        kinetic = project(twist, *momenta[part.row][part.prefix]) * _HALF
        weight: Vector = down[part.row]
        potential = dict(zip(("MX", "MY", "MZ"), (-x for x in weight), strict=True))
        potential["M"] = heights[part.row]
        return {0: kinetic + potential.get(part.prefix, 0)}

    def shaft(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = along(model, part.shaft, "qd")
        return {0: speed * speed * _HALF}

    return model.entries(link, shaft)


def power_regressor(model: SymbolicModel) -> Entries:
    """d of tau . qd = d/dt (h chi) + d chi, one row: the power that friction and offsets take."""
    qd, zero = model.inputs("qd"), model.graph.constant(0)

    def shaft(part: ShaftColumn) -> dict[int, Expr]:
        return {0: sum((qd[k] * x for k, x in _losses(model, part).items()), zero)}

    return model.entries(lambda part: {}, shaft)
