"""Why a row does not count, for those who draw it."""

import numpy as np

from modeler.observation.motion import BRIDGES, CAUSES, CONTRADICTED, EDGE, MISSING, OPEN, SATURATED
from modeler.observation.observation import Observation
from modeler.observation.stretch import Stretch

MASKS = (
    "low speed", "torque at its limit", "no good value", "impossible derivative", "filter end",
    "loops open",
)  # fmt: skip
"""In short, for legends."""

WHY = {
    "low speed": "the joint moves so slowly that the sign of its friction is doubtful",
    "torque at its limit": "the drive gave all it could, so the torque is not what was asked",
    "no good value": "a position or torque is missing or damaged, or lies beside one that is",
    "impossible derivative": "a logged speed or acceleration is not that of the positions",
    "filter end": "the position filter still starts up there",
    "loops open": "the loops cannot be closed with these positions",
}
"""In a sentence."""

_OF = {
    SATURATED: "torque at its limit",
    MISSING: "no good value",
    BRIDGES: "no good value",
    CONTRADICTED: "impossible derivative",
    EDGE: "filter end",
    OPEN: "loops open",
}


def masks_of(observation: Observation) -> np.ndarray:
    """(s, n) place in MASKS of what most weight of a row falls on; -1 where the row counts.

    Args:
        observation: of logs.
    """
    return np.concatenate([_masks(part) for part in observation.stretches])


def _masks(part: Stretch) -> np.ndarray:
    """(rows, n)."""
    cause = part.segment.cause
    of = np.array([MASKS.index(_OF[name]) for name in CAUSES] + [0])  # the last: low speed
    flags = np.where(part.usable, -1, of[-1] if cause is None else of[cause])
    shares = np.stack([part.rows.share(flags == k) for k in range(len(MASKS))])
    return np.where(part.used, -1, np.argmax(shares, axis=0)).astype(np.int8)
