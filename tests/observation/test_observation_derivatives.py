"""Which velocity is taken: the logged one, or that of the position."""

import numpy as np
import pytest

from modeler.observation.consistency import quieter
from modeler.observation.prepare import without_speeds
from modeler.observation.segments import Piece

TIME = np.arange(2000) * 0.002
CUTOFF = 50.0  # Hz


def piece(position_noise, velocity_noise, seed=1):
    draw = np.random.default_rng(seed).normal
    q, qd = np.sin(2.0 * TIME), 2.0 * np.cos(2.0 * TIME)
    both = [q + position_noise * draw(size=len(q)), qd + velocity_noise * draw(size=len(q))]
    flags = np.zeros(len(TIME), dtype=bool)
    return Piece(
        run=0, time=TIME, step=0.002, q=both[0][:, None], tau=np.zeros((len(TIME), 1)),
        qd=both[1][:, None], qdd=None, extra={}, valid=np.ones((len(TIME), 1), dtype=bool),
        bridged=flags, contradicted=flags, clipped=np.zeros((len(TIME), 1), dtype=bool),
        resampled=False,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("position", "velocity", "taken"),
    [(1e-6, 1e-2, True), (1e-4, 1e-2, False), (1e-5, 1e-3, False), (1e-6, 1e-5, False)],
)
def test_the_position_is_differentiated_where_that_is_clearly_quieter(position, velocity, taken):
    """Noise s_q of the position is 2 pi f s_q / sqrt 3 = 181 s_q on the velocity."""
    assert quieter([piece(position, velocity)], CUTOFF) is taken


def test_without_logged_velocities_there_is_no_choice():
    pieces = tuple(map(without_speeds, [piece(1e-6, 1e-2)]))
    assert pieces[0].qd is None
    assert not quieter(pieces, CUTOFF)
    assert not quieter([], CUTOFF)
