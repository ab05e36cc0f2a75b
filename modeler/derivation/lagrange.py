"""The second opinion: torques from energies, by automatic differentiation.

Own kinematics (homogeneous transformations in the base frame), own equations (Lagrange), own
expression system (CasADi): nothing here is shared with the Newton-Euler recursion but the table.
"""

from collections.abc import Mapping, Sequence

import casadi as ca
import numpy as np
import sympy

from modeler.derivation.geometry import Geometry
from modeler.derivation.model import LinkColumn, SymbolicModel
from modeler.derivation.walks import compute_closed_motion
from modeler.robot import INERTIAL


def _build_torque_function(
    geometry: Geometry, parameters: Sequence[tuple[int, str]]
) -> ca.Function:
    """(q, qd, qdd, chi) -> tau of the rigid links at the nominal geometry.

    tau = d/dt (dT/dqd) - dT/dq + dU/dq with T = 1/2 qd' M qd, which is M qdd + C qd + dU/dq; the
    Coriolis and centripetal part is the Jacobian of dT/dqd times qd, minus dT/dq.

    Args:
        geometry: the exact table.
        parameters: (row, prefix) of each entry of chi, ten for every link.
    """
    q, qd, qdd = (ca.SX.sym(name, geometry.joint_count) for name in ("q", "qd", "qdd"))
    chi = ca.SX.sym("chi", len(parameters))
    transforms = _build_base_transforms(geometry, q)
    T, U = ca.SX(0), ca.SX(0)
    gravity = ca.SX([_evaluate_number(entry, geometry.values) for entry in geometry.gravity])
    for link, k in enumerate(dict.fromkeys(k for k, _ in parameters)):
        J, MS, M = _unpack_inertia(chi[10 * link : 10 * link + 10])
        R, p = transforms[k][:3, :3], transforms[k][:3, 3]
        w, v = _derive_velocities(R, p, q, qd)
        T += 0.5 * (w.T @ J @ w + M * v.T @ v) + ca.dot(v, ca.cross(w, MS))
        U -= ca.dot(gravity, M * p + R @ MS)
    momentum = ca.gradient(T, qd)
    tau = ca.jtimes(momentum, qd, qdd) + ca.jtimes(momentum, q, qd)
    tau = tau - ca.gradient(T, q) + ca.gradient(U, q)
    return ca.Function("tau", [q, qd, qdd, chi], [tau])


def _evaluate_number(value: sympy.Expr, values: Mapping[str, float]) -> float:
    return float(value.subs({symbol: values[symbol.name] for symbol in value.free_symbols}))


def _build_base_transforms(geometry: Geometry, q: ca.SX) -> list[ca.SX]:
    transforms: list[ca.SX] = []
    for row in geometry.rows:
        cells = {name: getattr(row, name) for name in ("gamma", "b", "alpha", "d", "theta", "r")}
        entries = {name: ca.SX(_evaluate_number(x, geometry.values)) for name, x in cells.items()}
        if row.index is not None:
            moving = "theta" if row.joint.is_revolute else "r"
            entries[moving] += row.rate * q[row.index]
        T = ca.SX.eye(4) if row.parent is None else transforms[row.parent]
        T = T @ _build_rotation(2, entries["gamma"]) @ _build_translation(2, entries["b"])
        T = T @ _build_rotation(0, entries["alpha"]) @ _build_translation(0, entries["d"])
        turn, slide = _build_rotation(2, entries["theta"]), _build_translation(2, entries["r"])
        transforms.append(T @ turn @ slide)
    return transforms


def _build_rotation(axis: int, angle: ca.SX) -> ca.SX:
    T = ca.SX.eye(4)
    i, j = ((1, 2), (2, 0), (0, 1))[axis]
    c, s = ca.cos(angle), ca.sin(angle)
    T[i, i], T[j, j], T[i, j], T[j, i] = c, c, -s, s
    return T


def _build_translation(axis: int, length: ca.SX) -> ca.SX:
    T = ca.SX.eye(4)
    T[axis, 3] = length
    return T


def _unpack_inertia(chi: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    XX, XY, XZ, YY, YZ, ZZ = (chi[i] for i in range(6))
    rows: Sequence[Sequence[ca.SX]] = ((XX, XY, XZ), (XY, YY, YZ), (XZ, YZ, ZZ))
    return ca.vertcat(*(ca.horzcat(*row) for row in rows)), chi[6:9], chi[9]


def _derive_velocities(R: ca.SX, p: ca.SX, q: ca.SX, qd: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Angular and linear velocity of a frame, in the frame: from d/dt of R and p."""
    Rd = ca.reshape(ca.jtimes(ca.vec(R), q, qd), 3, 3)
    W = R.T @ Rd
    w = ca.vertcat(W[2, 1], W[0, 2], W[1, 0])
    return w, R.T @ ca.jtimes(p, q, qd)


# Torques of the links by Lagrange, for any robot: tied joints and loops included.


def compute_lagrange_torque(
    model: SymbolicModel, u: np.ndarray, ud: np.ndarray, udd: np.ndarray, chi: np.ndarray
) -> np.ndarray:
    """Returns (n, coordinates) torques of the links alone at the standard parameters chi.

    Equations of Lagrange of the opened tree, whose rows move by q_t = F u; projected by F, and
    where there are loops by the coupling G.

    Args:
        model: of any robot.
        u: (n, free variables) closed postures.
        ud: speeds that the loops allow.
        udd: accelerations that the loops allow.
        chi: (columns,) standard parameters.
    """
    geometry = model.geometry
    moving = [k for k, row in enumerate(geometry.rows) if row.index is not None]
    parameters = [(k, prefix) for k in moving for prefix in INERTIAL]
    values: dict[tuple[int, str], float] = {}
    for column, value in zip(model.columns, chi, strict=True):
        if isinstance(column, LinkColumn):
            for part in column.parts:
                values[part.row, part.prefix] = value
    links = np.array([values.get(at, 0.0) for at in parameters])
    F = np.zeros((geometry.joint_count, geometry.coordinate_count))
    for row, form in enumerate(geometry.forms):
        for k, coefficient in form.items():
            F[row, k] = float(coefficient)
    function = _build_torque_function(geometry, parameters).map(len(u))
    inputs = (F @ u.T, F @ ud.T, F @ udd.T, np.tile(links[:, None], len(u)))
    tau = np.array(function(*inputs)).T @ F
    if model.closure is None:
        return tau
    none = np.zeros((len(u), len(model.closure.actuated)))
    return np.einsum("nij,ni->nj", compute_closed_motion(model, u, none).coupling, tau)
