"""Which velocity is the quieter one: the logged, or that of the logged position?"""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.observation.consistency import white_noise
from modeler.observation.segments import Piece

TIMES = 2.0
"""Noise of the logged velocity over that of the differentiated position from which on that is
taken: below, a measured velocity has no delay and no quantisation of its own to fear."""


def quieter(pieces: Sequence[Piece], cutoff: float) -> bool:
    """True if differentiating the position is quieter than the logged velocity on most joints.

    White noise of standard deviation s_q on the position, through the position filter of cut-off
    f, is noise of (2 pi f) s_q / sqrt(3) on the velocity.

    Args:
        pieces: with logged velocities, of all logs.
        cutoff: of the position filter, Hz.
    """
    moved, logged = [], []
    for piece in pieces:
        if piece.qd is None or piece.qdd is not None or len(piece.time) < 8:
            return False
        own = 2.0 * np.pi * min(cutoff, 0.5 / piece.step) / np.sqrt(3.0)
        moved.append([own * white_noise(column) for column in piece.q.T])
        logged.append([white_noise(column) for column in piece.qd.T])
    if not logged:
        return False
    return bool(
        np.mean(np.median(logged, axis=0) > TIMES * np.median(moved, axis=0)) > 0.5
    )  # fmt: skip


def without_velocities(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """The pieces with their velocities to be taken from the positions."""
    return tuple(dataclasses.replace(piece, qd=None) for piece in pieces)
