"""Equations of effects have a finite real value wherever a joint may be."""

import itertools
import math
import random
from collections.abc import Iterator, Mapping, Sequence

from modeler.effects import VARIABLES, EffectColumn, Form, Shape
from modeler.robot.cells import LARGEST
from modeler.robot.place import Place, listed, shown

MOST = 100
"""Combinations of the first values of shapes: a diagnosis tries each on each joint."""

_STATES = 12


def check_combinations(shapes: Sequence[Shape], place: Place) -> None:
    """Refuse more combinations of shapes than a diagnosis should try.

    Raises:
        RobotError: more than `MOST`.
    """
    count = math.prod(len(shape.grid) for shape in shapes)
    if count > MOST:
        raise place.error(
            f"got {count} combinations of {listed(shape.name for shape in shapes)}; expected at "
            f"most {MOST}: give fewer values, they are refined"
        )


def check_finite(form: Form, place: Place, given: Mapping[str, float] | None = None) -> None:
    """Refuse equations that have no real value up to `LARGEST` at rest or in a random state.

    Args:
        form: of an effect.
        place: of its equations.
        given: values of its shapes; None for all combinations of their first values.

    Raises:
        RobotError: says the equation and where it has no value.
    """
    states = list(_states())
    for shapes in [given] if given is not None else _grid(form.shapes):
        for column, state in itertools.product(form.columns, states):
            if not _is_finite(column, {**state, **shapes}):
                used = column.equation.names
                values = {**{n: v for n, v in state.items() if n in used}, **shapes}
                raise place.error(
                    f"{column.prefix} = {shown(column.equation.text)} has no finite value at "
                    f"{listed(f'{name} = {value:.3g}' for name, value in values.items())}; "
                    f"expected one of at most {LARGEST:g} in every state of the joint, at rest too"
                )


def _grid(shapes: Sequence[Shape]) -> Iterator[Mapping[str, float]]:
    for values in itertools.product(*(shape.grid for shape in shapes)):
        yield {shape.name: value for shape, value in zip(shapes, values, strict=True)}


def _states() -> Iterator[Mapping[str, float]]:
    """Rest, and states with both signs of everything."""
    yield dict.fromkeys(VARIABLES, 0.0)
    draw = random.Random(0)
    for _ in range(_STATES):
        yield {name: draw.uniform(-3.0, 3.0) for name in VARIABLES}


def _is_finite(column: EffectColumn, values: Mapping[str, float]) -> bool:
    try:
        return abs(column.equation.number(values)) <= LARGEST
    except (ArithmeticError, ValueError, TypeError):  # a root of a negative number is complex
        return False
