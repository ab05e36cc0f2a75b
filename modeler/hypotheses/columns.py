"""The columns of a candidate over the samples of a segment: the catalogue's equations in numpy."""

from collections.abc import Sequence

import numpy as np

from modeler.core.contract import ModuleSpec, ParameterSpec
from modeler.effects import Acts, Memory
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.signals import Signals
from modeler.hypotheses.tilt import tilt_columns

FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp,
    "abs": np.abs, "sign": np.sign, "tanh": np.tanh,
}  # fmt: skip

UNFELT = 1e-12
"""Columns that are nowhere larger are felt by no joint."""


def own_columns(candidate: Candidate, signals: Signals) -> np.ndarray:
    """(n, k) equations of its k columns on its joint."""
    values: dict[str, object] = {**candidate.shapes, **_read(candidate, signals)}
    memory = candidate.form.memory
    if memory is not None:
        values["z"] = _state(memory, candidate, signals)
    ones = np.ones(len(signals.q))
    with np.errstate(all="ignore"):  # columns that are not finite are not looked at
        return np.column_stack(
            [
                ones * column.equation.fold(values, FUNCTIONS, np.pi, float)
                for column in candidate.form.columns
            ]
        )


def _read(candidate: Candidate, signals: Signals) -> dict[str, np.ndarray | None]:
    """(n,) what its equations read of the motion and the model, by name."""
    j, names = candidate.index, candidate.form.names
    values: dict[str, np.ndarray | None]
    values = {"q": signals.q[:, j], "v": signals.v[:, j], "a": signals.a[:, j]}
    for name in ("load", "static", "torque", "rate"):
        if name in names:
            values[name] = getattr(signals, name)[:, j]
    if "t" in names:
        values["t"] = signals.time
    if "T" in names:
        values["T"] = signals.temperature(candidate.joint or "")
    return values


def own_columns_of(candidates: Sequence[Candidate], signals: Signals) -> np.ndarray:
    """(n, k) of candidates of one form on one joint, that of the first, then the next."""
    first = candidates[0]
    if first.form.memory is not None or len(candidates) == 1 or not first.shapes:
        return np.hstack([own_columns(candidate, signals) for candidate in candidates])
    values: dict[str, object] = {
        name: np.array([candidate.shapes[name] for candidate in candidates])
        for name in first.shapes
    }
    values |= {
        name: value[:, None]
        for name, value in _read(first, signals).items() if value is not None
    }  # fmt: skip
    whole = np.ones((len(signals.q), len(candidates)))
    with np.errstate(all="ignore"):
        found = [
            whole * column.equation.fold(values, FUNCTIONS, np.pi, float)
            for column in first.form.columns
        ]
    return np.stack(found, axis=2).reshape(len(whole), -1)


def _state(memory: Memory, candidate: Candidate, signals: Signals) -> np.ndarray:
    return signals.state(memory, candidate.index, candidate.shapes)


def all_columns(candidate: Candidate, signals: Signals) -> np.ndarray:
    """(n, J, k) torques of its columns on every joint."""
    acts = candidate.effect.acts
    n, joints = signals.q.shape
    if acts is Acts.TORQUE:
        return signals.rate[:, :, None]
    if acts is Acts.GRAVITY:
        return tilt_columns(signals)
    if acts is Acts.LINK:
        return _body(candidate, signals)
    if acts is Acts.MOTOR:
        return _motor(candidate, signals)
    if acts is Acts.PASSIVE:
        return _passive(candidate, signals)
    if acts is Acts.POSITION:
        return moved_columns([candidate], signals)
    own = own_columns(candidate, signals)
    result = np.zeros((n, joints, own.shape[1]))
    result[:, candidate.index] = own
    return result


def moved_columns(candidates: Sequence[Candidate], signals: Signals) -> np.ndarray:
    """(n, J, k) of candidates of one effect that moves the position of one joint."""
    first = candidates[0]
    own = own_columns_of(candidates, signals)
    return signals.all_moved(first.index, own, first.effect.whole_axis)


def _shaft(candidate: Candidate, speed: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
    """(n, k) equations of a shaft that is no joint of the model."""
    values = {"v": speed, "a": acceleration}
    return np.column_stack(
        [c.equation.fold(values, FUNCTIONS, np.pi, float) for c in candidate.form.columns]
    )


def _motor(candidate: Candidate, signals: Signals) -> np.ndarray:
    turn = np.zeros(signals.q.shape[1])
    turn[list(candidate.turn)] = list(candidate.turn.values())
    own = _shaft(candidate, signals.v @ turn, signals.a @ turn)
    return own[:, None, :] * turn[None, :, None]


def _body(candidate: Candidate, signals: Signals) -> np.ndarray:
    """Columns of the ten inertial parameters of a link, those that any joint feels."""
    model = signals.reference.compiled
    own = [i for i, _ in _inertial(candidate, model.spec)]
    columns = model.regressor(signals.q, signals.v, signals.a, signals.read)[:, :, own]
    return columns[:, :, np.abs(columns).max(axis=(0, 1)) > UNFELT]


def body_parameters(candidate: Candidate, signals: Signals) -> list[ParameterSpec]:
    """The standard parameters of the columns of a body on a link."""
    model = signals.reference.compiled
    every = _inertial(candidate, model.spec)
    columns = model.regressor(signals.q, signals.v, signals.a, signals.read)
    largest = np.abs(columns).max(axis=(0, 1))
    return [parameter for i, parameter in every if largest[i] > UNFELT]


def _inertial(candidate: Candidate, spec: ModuleSpec) -> list[tuple[int, ParameterSpec]]:
    """Inertial parameters of the link that a candidate loads, with their places."""
    links = [p.joint for p in spec.standard if p.effect == "rigid_body"]
    own = list(dict.fromkeys(links))[candidate.index]
    return [
        (i, p) for i, p in enumerate(spec.standard) if p.effect == "rigid_body" and p.joint == own
    ]


def _passive(candidate: Candidate, signals: Signals) -> np.ndarray:
    row = signals.coupling[:, candidate.index]
    speed = np.einsum("nj,nj->n", row, signals.v)
    own = _shaft(candidate, speed, np.zeros_like(speed))
    return own[:, None, :] * row[:, :, None]
