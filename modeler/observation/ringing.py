"""Joints that ring far above their motion: a controller that oscillates, or a resonance."""

from dataclasses import dataclass

import numpy as np

from modeler.core.table import percent

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
