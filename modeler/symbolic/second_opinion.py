"""Torques of the links by Lagrange, for any robot: tied joints and loops included."""

import numpy as np

from modeler.symbolic.closed_states import closed_motion
from modeler.symbolic.columns import LinkColumn
from modeler.symbolic.lagrange import lagrange_model
from modeler.symbolic.model import SymbolicModel


def lagrange_torque(
    model: SymbolicModel, u: np.ndarray, ud: np.ndarray, udd: np.ndarray, chi: np.ndarray
) -> np.ndarray:
    """(n, coordinates) torques of the links with the standard parameters chi; effects are left out.

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
    tree = lagrange_model(geometry)
    values: dict[tuple[int, str], float] = {}
    for column, value in zip(model.columns, chi, strict=True):
        if isinstance(column, LinkColumn):
            for part in column.parts:
                values[part.row, part.prefix] = value
    links = np.array([values.get(at, 0.0) for at in tree.parameters])
    F = np.zeros((geometry.joints, geometry.coordinates))
    for row, form in enumerate(geometry.forms):
        for k, coefficient in form.items():
            F[row, k] = float(coefficient)
    tau = tree.torque(u @ F.T, ud @ F.T, udd @ F.T, links) @ F
    if model.closure is None:
        return tau
    none = np.zeros((len(u), len(model.closure.given)))
    return np.einsum("nij,ni->nj", closed_motion(model, u, none).coupling, tau)
