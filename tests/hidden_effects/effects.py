"""Hiding an effect in an arm: by name, on a joint and with values that are drawn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.hidden_effects.drives import Scales
from tests.hidden_effects.plant import Plant


class Impossible(Exception):
    """This arm cannot have this effect; draw another."""


@dataclass(frozen=True)
class Hidden:
    """What was hidden.

    Attributes:
        joint: index; None for an effect of the whole robot.
        values: true values, SI.
        delay: s; the logged torque is that so much later.
    """

    joint: int | None
    values: dict[str, Any]
    delay: float = 0.0


@dataclass
class Draw:
    """An arm that is about to get an effect, and what it is drawn with.

    Attributes:
        plant: changed in place.
        scales: of its joints.
        rng: of this effect.
        joint: index of the joint, drawn already.
        n: joints.
    """

    plant: Plant
    scales: Scales
    rng: np.random.Generator
    n: int = field(init=False)
    joint: int = field(init=False)

    def __post_init__(self) -> None:
        self.n = self.plant.joints
        self.joint = self.pick(range(self.n))

    def pick(self, joints: Sequence[int]) -> int:
        """One of these joints."""
        if not len(joints):
            raise Impossible
        return int(self.rng.choice(joints))

    def sign(self) -> float:
        """1 or -1."""
        return 1.0 if self.rng.uniform() < 0.5 else -1.0

    def between(self, low: float, high: float) -> float:
        """Uniform."""
        return float(self.rng.uniform(low, high))

    @property
    def rated(self) -> float:
        """Torque of the joint."""
        return float(self.scales.rated[self.joint])

    @property
    def speed(self) -> float:
        """Top speed of the joint."""
        return float(self.scales.bounds.speed[self.joint])

    @property
    def angle(self) -> float:
        """Largest angle of the joint to either side."""
        return float(self.scales.bounds.angle[self.joint])


Hide = Callable[[Draw], Hidden]
EFFECTS: dict[str, Hide] = {}
"""How to hide an effect, by name; modules of effects add theirs."""

BASE = ("viscous", "coulomb", "offset", "rotor_inertia")
"""Every arm has these: hidden means missing in the robot file."""

LOADS = ("payload", "link_inertia")
"""The fit has the arm without them."""


def effect(name: str, known: dict[str, Hide] = EFFECTS) -> Callable[[Hide], Hide]:
    """Put what follows into `EFFECTS`, or into others."""

    def add(hide: Hide) -> Hide:
        known[name] = hide
        return hide

    return add


def hide(name, plant, scales, rng, known=EFFECTS):
    """Change the plant; the name is one of those that are known.

    Raises:
        Impossible: this arm cannot have it.
    """
    hidden = known[name](Draw(plant, scales, rng))
    values = {
        key: value if isinstance(value, str) else np.asarray(value, float).tolist()
        for key, value in hidden.values.items()
    }
    return Hidden(hidden.joint, values, hidden.delay)
