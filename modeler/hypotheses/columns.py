"""The columns of a candidate over the samples of a segment: the catalogue's equations in numpy."""

from collections.abc import Sequence

import numpy as np

from modeler.core.contract import ModuleSpec, ParameterSpec
from modeler.effects import Acts, Memory
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.signals import EVERY, Signals
from modeler.hypotheses.tilt import tilt_columns

FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp,
    "abs": np.abs, "sign": np.sign, "tanh": np.tanh,
}  # fmt: skip

UNFELT = 1e-12
"""Columns that are nowhere larger are felt by no joint."""


def own_columns(candidate: Candidate, signals: Signals, window: slice = EVERY) -> np.ndarray:
    """(n, k) equations of its k columns on its joint, over a window of the samples."""
    values: dict[str, object] = {**candidate.shapes, **_read(candidate, signals, window)}
    memory = candidate.form.memory
    if memory is not None:
        values["z"] = _state(memory, candidate, signals)[window]
    ones = np.ones(len(signals.q[window]))
    with np.errstate(all="ignore"):  # columns that are not finite are not looked at
        return np.column_stack(
            [
                ones * column.equation.fold(values, FUNCTIONS, np.pi, float)
                for column in candidate.form.columns
            ]
        )


def _read(candidate: Candidate, signals: Signals, window: slice) -> dict[str, np.ndarray | None]:
    """(n,) what its equations read of the motion and the model, by name."""
    j, names = candidate.index, candidate.form.names
    values: dict[str, np.ndarray | None]
    motion = {"q": signals.q, "v": signals.v, "a": signals.a}
    values = {name: x[window, j] for name, x in motion.items()}
    for name in ("load", "static", "torque", "rate"):
        if name in names:
            values[name] = getattr(signals, name)[window, j]
    if "t" in names:
        values["t"] = signals.time[window]
    if "T" in names:
        warmth = signals.temperature(candidate.joint or "")
        values["T"] = None if warmth is None else warmth[window]
    return values


def own_columns_of(
    candidates: Sequence[Candidate], signals: Signals, window: slice = EVERY
) -> np.ndarray:
    """(n, k) of candidates of one form on one joint, that of the first, then the next."""
    first = candidates[0]
    if first.form.memory is not None or len(candidates) == 1 or not first.shapes:
        return np.hstack([own_columns(candidate, signals, window) for candidate in candidates])
    values: dict[str, object] = {
        name: np.array([candidate.shapes[name] for candidate in candidates])
        for name in first.shapes
    }
    values |= {
        name: value[:, None]
        for name, value in _read(first, signals, window).items() if value is not None
    }  # fmt: skip
    found = np.empty((len(signals.q[window]), len(candidates), len(first.form.columns)))
    with np.errstate(all="ignore"):
        for k, column in enumerate(first.form.columns):
            found[:, :, k] = column.equation.fold(values, FUNCTIONS, np.pi, float)
    return found.reshape(len(found), -1)


def _state(memory: Memory, candidate: Candidate, signals: Signals) -> np.ndarray:
    return signals.state(memory, candidate.index, candidate.shapes)


def all_columns(candidate: Candidate, signals: Signals, window: slice = EVERY) -> np.ndarray:
    """(n, J, k) torques of its columns on every joint, over a window of the samples."""
    acts = candidate.effect.acts
    if acts is Acts.TORQUE:
        return signals.rate[window, :, None]
    if acts is Acts.GRAVITY:
        return tilt_columns(signals, window)
    if acts is Acts.LINK:
        return _body(candidate, signals, window)
    if acts is Acts.MOTOR:
        return _motor(candidate, signals, window)
    if acts is Acts.PASSIVE:
        return _passive(candidate, signals, window)
    if acts is Acts.POSITION:
        dq = own_columns(candidate, signals)
        return signals.moved(candidate.index, dq, candidate.effect.whole_axis, window)
    own = own_columns(candidate, signals, window)
    result = np.zeros((len(own), signals.q.shape[1], own.shape[1]))
    result[:, candidate.index] = own
    return result


def _shaft(candidate: Candidate, speed: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
    """(n, k) equations of a shaft that is no joint of the model."""
    values = {"v": speed, "a": acceleration}
    return np.column_stack(
        [c.equation.fold(values, FUNCTIONS, np.pi, float) for c in candidate.form.columns]
    )


def _motor(candidate: Candidate, signals: Signals, window: slice) -> np.ndarray:
    turn = np.zeros(signals.q.shape[1])
    turn[list(candidate.turn)] = list(candidate.turn.values())
    own = _shaft(candidate, signals.v[window] @ turn, signals.a[window] @ turn)
    return own[:, None, :] * turn[None, :, None]


def _body(candidate: Candidate, signals: Signals, window: slice) -> np.ndarray:
    """Columns of the ten inertial parameters of a link, those that any joint feels."""
    every = _inertial(candidate, signals.reference.compiled.spec)
    own = [i for i, _ in every if signals.largest[i] > UNFELT]
    return signals.regressor(window)[:, :, own]


def body_parameters(candidate: Candidate, signals: Signals) -> list[ParameterSpec]:
    """The standard parameters of the columns of a body on a link."""
    every = _inertial(candidate, signals.reference.compiled.spec)
    return [parameter for i, parameter in every if signals.largest[i] > UNFELT]


def _inertial(candidate: Candidate, spec: ModuleSpec) -> list[tuple[int, ParameterSpec]]:
    """Inertial parameters of the link that a candidate loads, with their places."""
    links = [p.joint for p in spec.standard if p.effect == "rigid_body"]
    own = list(dict.fromkeys(links))[candidate.index]
    return [
        (i, p) for i, p in enumerate(spec.standard) if p.effect == "rigid_body" and p.joint == own
    ]


def _passive(candidate: Candidate, signals: Signals, window: slice) -> np.ndarray:
    row = signals.coupling[window, candidate.index]
    speed = np.einsum("nj,nj->n", row, signals.v[window])
    own = _shaft(candidate, speed, np.zeros_like(speed))
    return own[:, None, :] * row[:, :, None]
