"""The simulated robot with loops as one ordinary differential equation in its coordinates."""

import casadi as ca
import numpy as np

from modeler.robot import Limits, Robot
from modeler.simulate.constraints import Constraints
from modeler.simulate.elementary import portable
from modeler.simulate.hidden import HiddenEffect
from modeler.simulate.parameters import PlantParameters
from modeler.simulate.plant import Plant
from modeler.simulate.rigid import RigidDynamics, rigid_dynamics
from modeler.simulate.shafts import ShaftEffects, shaft_effects
from modeler.simulate.ties import untied


def build_closed_plant(
    robot: Robot,
    parameters: PlantParameters,
    limits: tuple[Limits, ...],
    constraints: Constraints,
    hidden: tuple[HiddenEffect, ...] = (),
) -> Plant:
    """The plant whose q are the coordinates; the other joints are the first of its inner states.

    With J the constraints' slope, vd = G qd and vdd = G qdd + g in all moving rows, where
    J_s G_s = -J_q and J_s g_s = -J' vd by least squares. The principle of virtual work gives
    G^T M G qdd + G^T (M g + h) = tau: no constraint force does work.

    Args:
        robot: with loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`.
        constraints: its loops and relations.
        hidden: further effects on shafts, all their values given.
    """
    links = rigid_dynamics(robot, parameters.bodies)
    effects = shaft_effects(robot, parameters, limits, links, untied(robot), hidden)
    return _assembled(robot, links, effects, constraints)


def inner_states(plant: Plant, constraints: Constraints, v: np.ndarray) -> np.ndarray:
    """(n, plant.states) of a plant at rest in postures v (n, moving rows)."""
    z = np.zeros((len(v), plant.states))
    z[:, : len(constraints.others)] = v[:, constraints.others]
    return z


def _assembled(
    robot: Robot, links: RigidDynamics, effects: ShaftEffects, constraints: Constraints
) -> Plant:
    given, others = constraints.given, constraints.others
    n = len(given)
    q, qd, qdd, tau = (ca.SX.sym(name, n) for name in ("q", "qd", "qdd", "tau"))
    follow = ca.SX.sym("follow", len(others))
    z = ca.vertcat(follow, effects.state)
    v = ca.SX.zeros(links.q.shape[0])
    v[given], v[others] = q, follow
    solve, slope = _least_squares(constraints, v)
    G = ca.SX.zeros(v.shape[0], n)
    G[given, :], G[others, :] = ca.SX.eye(n), -solve(slope[:, given])
    vd = G @ qd
    g = ca.SX.zeros(v.shape[0])
    g[others] = -solve(constraints.curvature.call([v, vd], True, False)[0])
    tree = [links.inertia + ca.SX(effects.inertia), links.bias, effects.torque, effects.rate]
    tree += [links.kinetic, links.potential, *effects.temperatures.values()]
    M, bias, friction, rate, kinetic, potential, *readings = ca.substitute(
        tree, [links.q, links.qd], [v, vd]
    )
    inertia, load = G.T @ M @ G, G.T @ (M @ g + bias + friction)
    rotors = ca.dot(vd, ca.SX(effects.inertia) @ vd) / 2
    solved = ca.ldl_solve(tau - load, *ca.ldl(inertia, False))
    closer = follow - solve(constraints.value.call([v], True, False)[0])
    return Plant(
        joints=tuple(joint.name for joint in robot.coordinates),
        driven=np.array([joint.actuated for joint in robot.coordinates]),
        states=z.shape[0],
        acceleration=_function("acceleration", [q, qd, z, tau],
                               [solved, ca.vertcat(G[others, :] @ qd, rate)]),
        torque=_function("torque", [q, qd, qdd, z], [inertia @ qdd + load]),
        inertia=_function("inertia", [q, z], [ca.densify(inertia)]),
        resistance=_function("resistance", [q, qd, z], [G.T @ friction]),
        energy=_function("energy", [q, qd, z], [kinetic + rotors, potential]),
        strain=_function("strain", [q, z], [ca.SX(0, 1)]),
        fastest=effects.fastest,
        temperatures=_function("temperatures", [z], [ca.vertcat(ca.SX(0, 1), *readings)]),
        warmed=tuple(effects.temperatures),
        closer=_function("closer", [q, z], [ca.densify(ca.vertcat(closer, effects.state))]),
    )  # fmt: skip


def _least_squares(constraints: Constraints, v: ca.SX):  # type: ignore[no-untyped-def]
    """b -> x of least ||J_s x - b||, by the normal equations, and J."""
    slope = constraints.slope.call([v], True, False)[0]
    inner = slope[:, constraints.others]
    factors = ca.ldl(inner.T @ inner, False)
    return (lambda b: ca.ldl_solve(inner.T @ b, *factors)), slope


def _function(name: str, inputs: list[ca.SX], outputs: list[ca.SX]) -> ca.Function:
    return portable(ca.Function(name, inputs, [ca.cse(output) for output in outputs]))
