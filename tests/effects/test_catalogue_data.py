"""The catalogue's data holds what the reader takes on trust."""

from collections import Counter
from typing import get_args

import pytest

from modeler.core.toml_cells import TomlCell
from modeler.effects.catalogue import CATALOGUE, check_finite, find_effect
from modeler.effects.effect import SCALES, Effect, SignatureAxis
from modeler.robot.robot import INERTIAL


@pytest.mark.parametrize("effect", CATALOGUE, ids=lambda effect: effect.id)
def test_an_effect_of_the_catalogue_is_whole(effect: Effect) -> None:
    assert effect.signature_axis in get_args(SignatureAxis)
    assert effect.source != "the robot file"
    assert all(find_effect(other) for other in effect.equivalent_effects)
    assert effect.sign in (-1, 0, 1)
    for form in effect.forms:
        assert {part.scale for part in form.nonlinear_parameters} <= SCALES.keys() - {"own"}
        assert all(low <= high for low, high in (part.limits for part in form.nonlinear_parameters))
        if all(part.grid for part in form.nonlinear_parameters):
            check_finite(form, TomlCell(effect.id))
        else:  # its waves are found in the spectrum
            check_finite(
                form, TomlCell(effect.id), {part.name: 7.0 for part in form.nonlinear_parameters}
            )


def test_no_two_effects_share_a_name() -> None:
    names = [name for effect in CATALOGUE for name in (effect.id, *effect.aliases)]
    prefixes = [c.prefix for e in CATALOGUE for form in e.forms for c in form.columns]
    for name, count in Counter([*names, *prefixes, *INERTIAL]).items():
        assert count == 1, name
