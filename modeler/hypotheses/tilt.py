"""Gravity from another direction: torques for unit gravity across the one the model has."""

from typing import TYPE_CHECKING

import numpy as np

from modeler.hypotheses.signals import Reference, Signals

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

_STATES = 64
_STEP = 1e-5  # rad or m, of central differences
_SEEN = 1e-6


def tilt_columns(signals: Signals, window: slice = slice(None)) -> np.ndarray:
    """(n, J, k): first the torques of unit gravity along two axes across the model's gravity.

    The others belong to first moments that the model's gravity hides (those of a vertical first
    axis): the tilt makes them felt. Empty without gravity, and for robots with loops.
    """
    weights = tilt_weights(signals.reference)
    q = signals.q[window]
    if weights is None:
        return np.zeros((*q.shape, 0))
    return frame_slopes(signals.reference.compiled, q).reshape(*q.shape, -1) @ weights


def tilt_weights(reference: Reference) -> np.ndarray | None:
    """(rows 3 4, k): `tilt_columns` of the entries of `frame_slopes`; None if it has none."""
    basis = tilt_basis(reference)
    if basis is None:
        return None
    return -np.column_stack([_weights(axis, chi) for axis, chi in basis])


def frame_slopes(model: "CompiledModel", q: np.ndarray) -> np.ndarray:
    """(n, J, rows, 3, 4) d/dq_j of [R | p] of every moving row, by differences; q is (n, J)."""
    found: np.ndarray | None = None
    for j in range(q.shape[1]):
        step = np.zeros(q.shape[1])
        step[j] = _STEP
        ahead, behind = model.forward_kinematics(q + step), model.forward_kinematics(q - step)
        if found is None:
            found = np.empty((len(q), q.shape[1], *ahead.shape[1:]))
        np.subtract(ahead, behind, out=found[:, j])
    assert found is not None, "a robot has joints"
    return found / (2.0 * _STEP)


def gravity_torque(slopes: np.ndarray, axis: np.ndarray, chi: np.ndarray) -> np.ndarray:
    """(n, J) torque for gravity `axis`: -d/dq of axis . sum (M p + R MS).

    Args:
        slopes: (n, J, rows, 3, 4) of `frame_slopes`.
        axis: (3,) m/s^2 in frame 0.
        chi: (rows, 4) M, MX, MY, MZ of every moving row.
    """
    return -slopes.reshape(*slopes.shape[:2], -1) @ _weights(axis, chi)


def _weights(axis: np.ndarray, chi: np.ndarray) -> np.ndarray:
    """(rows 3 4,) of the frames' entries in axis . sum (M p + R MS)."""
    moments = np.column_stack([chi[:, 1:], chi[:, 0]])
    return (axis[None, :, None] * moments[:, None, :]).ravel()


def tilt_basis(reference: Reference) -> list[tuple[np.ndarray, np.ndarray]] | None:
    """Axes and first moments of the columns of `tilt_columns`."""
    model = reference.compiled
    if model.spec.closure is not None:
        return None
    rows = [p.joint for p in model.spec.standard if p.effect == "rigid_body" and p.name[0] == "M"]
    rows = list(dict.fromkeys(rows))
    if len(rows) != model.forward_kinematics(np.zeros((1, len(model.spec.joints)))).shape[1]:
        return None  # virtual rows: which frame is whose is not in the manifest
    chi = _stands_for(reference, rows)
    q = np.random.default_rng(3).uniform(-1.5, 1.5, (_STATES, len(model.spec.joints)))
    unit = np.eye(3)
    slopes = frame_slopes(model, q)
    along = np.column_stack([gravity_torque(slopes, e, chi).ravel() for e in unit])
    target = model.gravity(q, reference.links).ravel()
    if np.linalg.norm(target) <= _SEEN or np.linalg.norm(along) <= _SEEN:
        return None
    gravity = np.linalg.lstsq(along, target, rcond=None)[0]
    down = gravity / np.linalg.norm(gravity)
    first = unit[int(np.argmin(np.abs(down)))]
    across = first - down * (down @ first)
    across = across / np.linalg.norm(across)
    axes = (across, np.cross(down, across))
    found = [(axis, chi) for axis in axes]
    return found + _woken(slopes, axes, down, len(rows))


def _stands_for(reference: Reference, rows: list[str]) -> np.ndarray:
    """(rows, 4) first moments and masses that give the model's torques: the base columns' own."""
    chi = np.zeros((len(rows), 4))
    for base, value in zip(reference.compiled.spec.base, reference.links, strict=True):
        for k, prefix in enumerate(("M", "MX", "MY", "MZ")):
            for r, row in enumerate(rows):
                if base.column_of == f"{prefix}{row}":
                    chi[r, k] = value
    return chi


def _woken(
    slopes: np.ndarray, axes: tuple[np.ndarray, np.ndarray], down: np.ndarray, rows: int
) -> list[tuple[np.ndarray, np.ndarray]]:
    """First moments without torque under the model's gravity that the others make felt."""
    found: list[tuple[np.ndarray, np.ndarray]] = []
    known = np.zeros((slopes.shape[0] * slopes.shape[1], 0))
    for r in range(rows):
        for k in (1, 2, 3):
            chi = np.zeros((rows, 4))
            chi[r, k] = 1.0
            if np.linalg.norm(gravity_torque(slopes, down, chi)) > _SEEN:
                continue
            for axis in axes:
                column = gravity_torque(slopes, axis, chi).ravel()
                rest = column - known @ (known.T @ column)
                if np.linalg.norm(rest) > 1e-3 * max(1.0, float(np.linalg.norm(column))):
                    known = np.column_stack([known, rest / np.linalg.norm(rest)])
                    found.append((axis, chi))
    return found
