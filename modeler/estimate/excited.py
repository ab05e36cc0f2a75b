"""Persistent excitation of a two-step fit: the singular values of Phi, joint by joint."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.compiled import CompiledModel
from modeler.estimate.alone import Directions
from modeler.estimate.two_step import Configuration
from modeler.observation import Observation

_ZERO = 1e-8  # of the largest singular value
_POSES = 4  # per column, at which the largest possible rank is found
_SEED = 1872


@dataclass(frozen=True)
class Excitation:
    """Phi of the inertia of one joint: J(configuration) = Phi beta.

    Attributes:
        joint: name.
        configurations: at which it moved alone.
        values: singular values of Phi, those that are 0 left out, largest first.
        possible: rank of Phi at ever so many configurations.
        usual: last of the singular values over the first at ever so many configurations.
    """

    joint: str
    configurations: int
    values: tuple[float, ...]
    possible: int
    usual: float

    @property
    def persistent(self) -> bool:
        """True if more configurations tell no further parameter."""
        return len(self.values) >= self.possible

    def line(self) -> str:
        """For people."""
        values = " ".join(f"{value:.3g}" for value in self.values)
        ratio = self.values[-1] / self.values[0] if self.values else 0.0
        return (
            f"J of joint {self.joint} at {self.configurations} configurations: rank "
            f"{len(self.values)} of {self.possible}, singular values of Phi {values} (last "
            f"{ratio:.2g} of the first; {self.usual:.2g} at many random ones)"
        )

    def sentence(self) -> str:
        """What to do where it is not persistent."""
        missing = self.possible - len(self.values)
        return (
            f"joint {self.joint} moves alone at {self.configurations} configurations, which tell "
            f"{len(self.values)} of the {self.possible} combinations in its inertia: not "
            f"persistently exciting; move it at {missing} or more further configurations of the "
            "other joints"
        )

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "joint": self.joint,
            "configurations": self.configurations,
            "singular_values": list(self.values),
            "rank": len(self.values),
            "possible_rank": self.possible,
            "usual_ratio": self.usual,
        }


def excitations(
    model: CompiledModel,
    observation: Observation,
    directions: Directions,
    configurations: Sequence[Configuration],
) -> tuple[Excitation, ...]:
    """Of every joint that moved alone; what is possible is what random poses give.

    Robots with loops cannot take any pose: theirs are those of the logs.
    """
    columns = len(observation.names)
    if model.spec.closure is None:
        rng = np.random.default_rng(_SEED)
        poses = rng.uniform(-np.pi, np.pi, (_POSES * columns, len(directions.names)))
    else:
        spread = np.linspace(0, len(observation.q) - 1, _POSES * columns).astype(int)
        poses = observation.q[spread]
    found = []
    for i in sorted({c.joint for c in configurations}):
        own = np.array([c.pose for c in configurations if c.joint == i]) @ directions.rows
        rows, best = (inertia_rows(model, q, directions.rows[i]) for q in (own, poses))
        every = _values(best)
        usual = every[-1] / every[0]
        found.append(Excitation(directions.names[i], len(own), _values(rows), len(every), usual))
    return tuple(found)


def inertia_rows(model: CompiledModel, q: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(t, c) Phi of J = d^T M(q) d = Phi beta at poses q (t, n)."""
    still, moved = np.zeros_like(q), np.tile(direction, (len(q), 1))
    rows = model.base_regressor(q, still, moved) - model.base_regressor(q, still, still)
    return np.einsum("tjc,j->tc", rows, direction)


def _values(rows: np.ndarray) -> tuple[float, ...]:
    values = np.linalg.svd(rows, compute_uv=False)
    return tuple(float(value) for value in values if value > _ZERO * values[0])
