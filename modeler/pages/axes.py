"""The axis on which a residual shows an effect, as the effect's definition names it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.effects import Acts, Shows
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.signals import Signals
from modeler.observation.travel import travel_since_reversal
from modeler.scoring.state import State


@dataclass(frozen=True, eq=False)
class Axis:
    """Of one joint.

    Attributes:
        shows: what it is.
        label: with unit.
        x: (rows_j,) by row.
        way: (rows_j,) 1 or -1 by the direction of motion, that the residual is multiplied by; None
            where the direction is no matter.
    """

    shows: Shows
    label: str
    x: np.ndarray
    way: np.ndarray | None

    @property
    def times(self) -> str:
        """Behind the word residual."""
        return "" if self.way is None else " x sign of velocity"

    def turned(self, y: np.ndarray) -> np.ndarray:
        """(rows_j,) y, times the direction of motion where that matters."""
        return y if self.way is None else y * self.way


def axis_of(state: State, pick: Candidate, j: int, own: np.ndarray) -> Axis:
    """The axis of an effect on joint j.

    Args:
        state: rows and model.
        pick: the effect.
        j: index of the joint that is drawn.
        own: (rows_j,) torque of the effect there, N m or N.
    """
    shows = _shown(pick, j)
    joint = state.data.compiled.spec.joints[j]
    if shows == "itself":
        return Axis(shows, f"what the effect adds [{joint.effort_unit}]", own, None)
    way = np.sign(state.rows.filtered(j, [_speed(pick, s, j) for s in state.rows.signals]))
    turns = _turns(pick, shows)
    values = [_VALUES[shows](pick, s, j) for s in state.rows.signals]
    if shows == "load" and turns:
        values = [np.abs(value) for value in values]
    label = _label(shows, pick, joint.unit, joint.effort_unit, turns)
    return Axis(shows, label, state.rows.filtered(j, values), way if turns else None)


def _shown(pick: Candidate, j: int) -> Shows:
    """The axis of the effect; of a joint that it reaches only through others, its own torque."""
    shows = pick.effect.shows
    if pick.local and j != pick.index:
        return "itself"
    return "t" if shows == "T" and "T" not in pick.form.names else shows


def _turns(pick: Candidate, shows: Shows) -> bool:
    """True if the effect turns with the motion and the axis does not say which way it goes."""
    if shows in ("v", "a", "waves"):
        return False
    slips = pick.form.memory is not None and pick.form.memory.kind == "slip"
    return "v" in pick.form.names or slips


def _speed(pick: Candidate, signals: Signals, j: int) -> np.ndarray:
    return _of_shaft(pick, signals.v, j)


def _of_shaft(pick: Candidate, motion: np.ndarray, j: int) -> np.ndarray:
    """(n,) of joint j, or of the motor that turns with several joints."""
    if pick.effect.acts is not Acts.MOTOR:
        return motion[:, j]
    return np.asarray(sum(factor * motion[:, k] for k, factor in pick.turn.items()))


def _load(pick: Candidate, signals: Signals, j: int) -> np.ndarray:
    """Of gravity, and of inertia as far as the effect's share w counts it."""
    share = pick.shapes.get("w", 1.0) if "static" in pick.form.names else 1.0
    static = signals.static[:, j]
    return np.asarray(static + share * (signals.load[:, j] - static))


def _temperature(pick: Candidate, signals: Signals, j: int) -> np.ndarray:
    heat = signals.temperature(pick.joint or "")
    return np.zeros(len(signals.q)) if heat is None else heat


_VALUES: dict[Shows, Callable[[Candidate, Signals, int], np.ndarray]] = {
    "q": lambda pick, s, j: s.q[:, j],
    "v": _speed,
    "a": lambda pick, s, j: _of_shaft(pick, s.a, j),
    "load": _load,
    "torque": lambda pick, s, j: s.torque[:, j],
    "rate": lambda pick, s, j: s.rate[:, j],
    "t": lambda pick, s, j: s.time,
    "T": _temperature,
    "travel": lambda pick, s, j: travel_since_reversal(s.q[:, j]),
    "waves": lambda pick, s, j: np.degrees((pick.shapes["m"] * s.q[:, j]) % (2.0 * np.pi)),
}


def _label(shows: Shows, pick: Candidate, unit: str, effort: str, turns: bool) -> str:
    of = " of the motor" if pick.effect.acts is Acts.MOTOR else ""
    return {
        "q": f"position [{unit}]",
        "v": f"velocity{of} [{unit}/s]",
        "a": f"acceleration{of} [{unit}/s2]",
        "load": f"|load| [{effort}]" if turns else f"load [{effort}]",
        "torque": f"predicted torque [{effort}]",
        "rate": f"rate of the predicted torque [{effort}/s]",
        "t": "time [s]",
        "T": "temperature less its mean [K]",
        "travel": f"travel since the last reversal [{unit}]",
        "waves": "place within one wave [deg]",
        "itself": "",
    }[shows]
