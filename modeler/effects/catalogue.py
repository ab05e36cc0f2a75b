"""The catalogue of physical effects, as `catalogue.toml` defines them."""

import tomllib
from collections.abc import Sequence
from pathlib import Path

from modeler.core.toml_cells import TomlCell
from modeler.effects.definition import read_definition
from modeler.effects.effect import Effect


def _read_catalogue() -> tuple[Effect, ...]:
    file = Path(__file__).with_name("catalogue.toml")
    effects: list[Effect] = []
    for name, table in tomllib.loads(file.read_text(encoding="utf-8")).items():
        effects.append(
            read_definition(
                name, TomlCell(file.name, f"[{name}]", table), {}, is_user_defined=False
            )
        )
    return tuple(effects)


CATALOGUE: tuple[Effect, ...] = _read_catalogue()
"""The effects, in the order in which their parameters stand after the link's own."""

ENCODERS = tuple(effect.id for effect in CATALOGUE if effect.whole_axis)
"""What moves the position of the whole axis, motor and links: the encoder shows it wrongly."""

PASSIVE_FRICTION = "passive_friction"
PASSIVE_FRICTION_IS = ("viscous", "coulomb")
"""What friction of a joint without motor is made of: a robot file that names it has these two."""


def find_effect(name: str, among: Sequence[Effect] = CATALOGUE) -> Effect | None:
    """The effect with that id or alias; None if there is none.

    Args:
        name: as in robot files.
        among: the catalogue, or that of a robot with effects of its own (`Robot.catalogue`).
    """
    return next((e for e in among if name == e.id or name in e.aliases), None)
