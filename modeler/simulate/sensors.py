"""What encoders read."""

from collections.abc import Sequence

import numpy as np

from modeler.robot import Joint
from modeler.simulate.settings import SimulationSettings


def encoder_resolution(joints: Sequence[Joint], settings: SimulationSettings) -> np.ndarray:
    """(joints,) rad or m per count; 0 for an ideal encoder."""
    return np.array([
        2 * np.pi / settings.encoder_counts if joint.angular and settings.encoder_counts
        else 0.0 if joint.angular else settings.linear_resolution
        for joint in joints
    ])  # fmt: skip


def quantised(position: np.ndarray, resolution: np.ndarray) -> np.ndarray:
    """What an encoder of that resolution reads; a resolution of 0 reads the position itself."""
    step = np.where(resolution > 0, resolution, 1.0)
    return np.where(resolution > 0, np.round(position / step) * step, position)
