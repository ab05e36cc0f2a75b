"""The effects, in the order in which their parameters stand after the link's own."""

from modeler.effects.bodies import BODIES
from modeler.effects.effect import Effect
from modeler.effects.friction import FRICTION
from modeler.effects.standard import STANDARD
from modeler.effects.transmission import TRANSMISSION

CATALOGUE: tuple[Effect, ...] = (*STANDARD, *FRICTION, *BODIES, *TRANSMISSION)


def effect_named(name: str) -> Effect | None:
    """The effect with that id or alias; None if there is none."""
    return next((e for e in CATALOGUE if name == e.id or name in e.aliases), None)
