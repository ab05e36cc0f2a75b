"""Can these data tell the parameters apart?"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.table import percent

IDLE = 1e-12
"""A column this much smaller than the largest, each measured in its own torque, is idle."""

WEAK = 1e-2
"""Singular values of the scaled matrix below this share of the largest are weak directions."""


@dataclass(frozen=True)
class Direction:
    """A combination of parameters that the data hardly move.

    Attributes:
        strength: its singular value as a share of the largest, columns scaled to length one.
        parts: (parameter, weight) of the largest weights.
    """

    strength: float
    parts: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Excitation:
    """How well a trajectory excites a model.

    Attributes:
        condition_number: of W as it is, idle columns left out.
        condition_scaled: of W with columns of length one: free of units.
        idle: parameters whose column is zero.
        weak: the weakest directions, weakest first.
    """

    condition_number: float
    condition_scaled: float
    idle: tuple[str, ...]
    weak: tuple[Direction, ...]

    def lines(self) -> list[str]:
        """Lines of text."""
        lines = [
            f"condition number {self.condition_number:.4g} "
            f"({self.condition_scaled:.4g} with columns of length one)"
        ]
        if self.idle:
            lines.append(f"no motion excites {', '.join(self.idle)}")
        for direction in self.weak:
            parts = " ".join(f"{weight:+.2f} {name}" for name, weight in direction.parts)
            lines.append(f"weak ({direction.strength:.2g} of the strongest): {parts}")
        return lines


def excitation(W: np.ndarray, names: Sequence[str]) -> Excitation:
    """The excitation of an observation matrix.

    Args:
        W: (rows, c).
        names: (c,) of the columns.
    """
    lengths = np.linalg.norm(W, axis=0)
    active = lengths > IDLE * max(float(lengths.max(initial=0.0)), np.finfo(float).tiny)
    idle = tuple(name for name, on in zip(names, active, strict=True) if not on)
    if not active.any():
        return Excitation(float("inf"), float("inf"), idle, ())
    kept = [name for name, on in zip(names, active, strict=True) if on]
    # R of W = QR has the same singular values and is c by c.
    triangle = np.linalg.qr(W[:, active], mode="r")
    raw = np.linalg.svd(triangle, compute_uv=False)
    _, scaled, directions = np.linalg.svd(triangle / lengths[active])
    weak = [
        Direction(float(s / scaled[0]), _parts(v, kept))
        for s, v in zip(scaled[::-1], directions[: len(scaled)][::-1], strict=True)
        if s < WEAK * scaled[0]
    ]
    return Excitation(_ratio(raw), _ratio(scaled), idle, tuple(weak[:5]))


def _ratio(singular: np.ndarray) -> float:
    return float(singular[0] / singular[-1]) if singular[-1] > 0.0 else float("inf")


def _parts(direction: np.ndarray, names: Sequence[str]) -> tuple[tuple[str, float], ...]:
    order = np.argsort(-np.abs(direction))[:5]
    return tuple((names[i], float(direction[i])) for i in order if abs(direction[i]) > 0.1)


# Joints that ring far above their motion: a controller that oscillates, or a resonance.


LEAST = 30.0
"""Hz: below, it is motion."""

GAP = 4.0
"""Ratio of frequencies without energy between motion and ringing."""

MOTION = 1e-3
"""Energy of the motion over that of the ringing, at least: below, the robot only shakes."""

QUIET = 0.01
"""Energy in the gap over that of the motion, at most."""

HEARD = 0.01
"""Energy of the ringing over that of the motion, at least."""

_EDGES = LEAST / GAP * 1.25 ** np.arange(26)  # Hz where the motion may end


@dataclass(frozen=True)
class Ringing:
    """A joint that rings.

    Attributes:
        joint: its index.
        frequency: of the strongest line, Hz.
        share: of the velocity's energy.
    """

    joint: int
    frequency: float
    share: float

    def sentence(self, name: str) -> str:
        """For the report."""
        return (
            f"joint {name} rings at {self.frequency:.3g} Hz, with {percent(self.share)} of "
            "its velocity's energy, far above its motion; the cut-offs are chosen without it, and "
            "friction looks smoother than it is: look at the controller's gains"
        )


def ringing(frequency: np.ndarray, energy: np.ndarray, joint: int) -> tuple[Ringing | None, int]:
    """What rings, and the index of the first frequency that does; all of them if nothing does.

    Ringing is energy above `LEAST` Hz that an empty gap of two octaves parts from the motion.

    Args:
        frequency: (n,) Hz, from 0 on.
        energy: (n,) of the velocity, above the noise.
        joint: index.
    """
    whole = len(frequency)
    total = np.concatenate([[0.0], np.cumsum(energy)])
    for edge in _EDGES:
        low, high = np.searchsorted(frequency, [edge, GAP * edge])
        if high >= whole:
            continue
        motion, between, above = total[low], total[high] - total[low], total[-1] - total[high]
        if motion > MOTION * above and between < QUIET * motion and above > HEARD * motion:
            top = high + int(np.argmax(energy[high:]))
            share = float(above / total[-1])
            return Ringing(joint, float(frequency[top]), share), int(high)
    return None, whole
