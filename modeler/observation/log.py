"""A log: what one run of the robot left behind, before any processing."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

_NONE: Mapping = MappingProxyType({})


@dataclass(frozen=True, eq=False)
class Log:
    """One measured run; n rows, joints in the order of the manifest, SI units.

    A missing measurement is NaN and stays in its row; nothing has been filtered or left out.

    Attributes:
        name: file name without its folder.
        joints: joint names, the order of the columns below.
        time: (n,) s, strictly increasing.
        q: (n, joints) rad or m.
        tau: (n, joints) N m or N; 0 for passive joints without a column.
        qd: (n, joints) logged velocities, or None.
        qdd: (n, joints) logged accelerations, or None.
        commanded: (n, joints) commanded positions, or None.
        segment: (n,) number of the piece of motion each row belongs to, or None.
        extra: further numeric columns, (n,) each.
        torque_source: where each joint's torque comes from, in words.
        missing: column -> rows without a finite value; only columns that have any.
        notes: doubtful but usable things seen while reading, one sentence each.
    """

    name: str
    joints: tuple[str, ...]
    time: np.ndarray
    q: np.ndarray
    tau: np.ndarray
    qd: np.ndarray | None = None
    qdd: np.ndarray | None = None
    commanded: np.ndarray | None = None
    segment: np.ndarray | None = None
    extra: Mapping[str, np.ndarray] = field(default_factory=lambda: _NONE)
    torque_source: tuple[str, ...] = ()
    missing: Mapping[str, int] = field(default_factory=lambda: _NONE)
    notes: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """Number of rows, n."""
        return len(self.time)

    @property
    def step(self) -> float:
        """Median time step, s."""
        return float(np.median(np.diff(self.time)))
