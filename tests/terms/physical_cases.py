"""Physical systems of robots, built once."""

from functools import cache

import numpy as np

from modeler.formulas.physical import read_printed_terms
from modeler.formulas.physical_system import (
    NumericPolynomial,
    PhysicalSystem,
    build_physical_system,
)
from tests.terms.cases import base_of, model_of

SEVEN = ("am", "bm", "bl1", "bt2", "ct1", "bJ33", "cJ33")
"""What Hanssen, Hovland and Brogardh take as known."""


@cache
def system_of(name: str, source: str | None = None) -> PhysicalSystem:
    return build_physical_system(model_of(name), base_of(name), source)


def example() -> dict[str, float]:
    """The wrist of `[terms.example]`."""
    result = read_printed_terms(model_of("wrist").robot).example
    return {name: float(value) for name, value in result.items()}


def point_of(system: PhysicalSystem, letters: dict[str, float]) -> np.ndarray:
    """The system's variables of a robot with these parameters."""
    point = np.zeros(len(system.names))
    for name, value in (*system.constants.items(), *letters.items()):
        if name in system.place:
            point[system.place[name]] = value
    return point


def data_of(system: PhysicalSystem, letters: dict[str, float]) -> np.ndarray:
    """The identified quantities of a robot with these parameters."""
    point = point_of(system, letters)
    return np.array(
        [NumericPolynomial(system.definitions[name]).evaluate(point) for name in system.data]
    )


def slopes_of(system: PhysicalSystem, letters: dict[str, float]) -> np.ndarray:
    """(data, letters) of the identified quantities by the letters."""
    point = point_of(system, letters)
    J = np.array(
        [NumericPolynomial(system.definitions[d]).evaluate_slopes(point) for d in system.data]
    )
    return J[:, [system.place[x] for x in system.letters]]


def random_letters(system: PhysicalSystem, rng: np.random.Generator) -> dict[str, float]:
    """A made-up robot; masses are positive, moments of inertia not negative."""
    drawn = {
        x: float(rng.uniform(1, 5) if x in system.masses else rng.uniform(-1, 1))
        for x in system.letters
    }
    return {x: abs(value) if x in system.moments else value for x, value in drawn.items()}
