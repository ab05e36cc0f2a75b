"""The effects, in the order in which their parameters stand after the link's own."""

from collections.abc import Sequence

from modeler.effects.bodies import BODIES
from modeler.effects.effect import Effect
from modeler.effects.friction import FRICTION
from modeler.effects.standard import STANDARD
from modeler.effects.transmission import TRANSMISSION

CATALOGUE: tuple[Effect, ...] = (*STANDARD, *FRICTION, *BODIES, *TRANSMISSION)


ENCODERS = tuple(effect.id for effect in CATALOGUE if effect.whole_axis)
"""What moves the position of the whole axis, motor and links: the encoder shows it wrongly."""

PASSIVE_FRICTION = "passive_friction"
PASSIVE_FRICTION_IS = ("viscous", "coulomb")
"""What friction of a joint without motor is made of: a robot file that names it has these two."""


def effect_named(name: str, among: Sequence[Effect] = CATALOGUE) -> Effect | None:
    """The effect with that id or alias; None if there is none.

    Args:
        name: as in robot files.
        among: the catalogue, or that of a robot with effects of its own (`Robot.catalogue`).
    """
    return next((e for e in among if name == e.id or name in e.aliases), None)
