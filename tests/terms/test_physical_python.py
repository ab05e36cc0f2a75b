"""The Python that is printed runs for every set of known parameters, and finds the robot."""

import itertools
import random

import numpy as np
import pytest

from modeler.formulas.solve import determined, solution_lines, solve
from modeler.formulas.sufficient_sets import smallest_number
from modeler.formulas.values import derive_values
from tests.robots import ROBOTS, kinds_first
from tests.terms.cases import model_of
from tests.terms.physical_cases import SEVEN, data_of, random_letters, system_of

EVERY = ("two-link", "emps")
"""Robots of which all smallest sets are tried."""
SAMPLED = {"wrist": 3, "scara": 2, "odrive": 2, "five-bar": 2, "3rrr": 1}
"""Of these some, by chance."""
DONE = {*EVERY, *SAMPLED, "evra", "stewart"}
"""The last two take 30 s, and have no quotient of another kind than the others."""
ROOTS = [("wrist", (*SEVEN, x)) for x in ("bJ11", "aJ11")]


def sets_of(name: str) -> list[tuple[str, ...]]:
    """Smallest sets that suffice."""
    system, chance = system_of(name), random.Random(4)
    size = smallest_number(system)
    tried = (tuple(chance.sample(system.letters, size)) for _ in itertools.count())
    every = itertools.combinations(system.letters, size) if name in EVERY else tried
    wanted = len(system.letters) - size
    found = (known for known in every if len(determined(system, known)[0]) == wanted)
    return list(itertools.islice(found, SAMPLED.get(name)))


def check(name: str, known: tuple[str, ...]) -> int:
    """Runs what is printed; the number of robots that fit, of which one is the true one."""
    system = system_of(name)
    solution = solve(system, known)
    truth = random_letters(system, np.random.default_rng(1))
    data, place = data_of(system, truth), dict[str, object]()
    exec("\n".join(solution_lines(solution, "python")), place)
    function = place["physical_parameters"]
    given = model_of(name).robot.symbol_values() | truth
    given |= dict(zip(system.data, data, strict=True))
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    found = function(**{x: given[x] for x in names})
    assert isinstance(found, list) == any(step.equation is not None for step in solution.steps)
    robots = found if isinstance(found, list) else [found]
    best = min(robots, key=lambda robot: max([abs(robot[x] - truth[x]) for x in robot] or [0.0]))
    own = derive_values(
        solution, data, np.zeros((len(data),) * 2), {x: truth[x] for x in known}, near=truth
    )
    assert set(best) == set(solution.follows) == set(own.letters)
    for x, value in best.items():
        assert value == pytest.approx(truth[x], rel=1e-5, abs=1e-5), (x, known)
        assert value == pytest.approx(own.value(x), rel=1e-5, abs=1e-5), (x, known)
    for robot in robots if not solution.undetermined else ():  # each of them has the same data
        assert data_of(system, truth | robot) == pytest.approx(data, rel=1e-5, abs=1e-5), known
    return len(robots)


@pytest.mark.parametrize("name", [*EVERY, *SAMPLED])
def test_printed_python_of_smallest_sets(name):
    for known in sets_of(name):
        check(name, known)


@pytest.mark.parametrize(("name", "known"), ROOTS, ids=lambda x: x[-1])
def test_printed_python_of_roots(name, known):
    assert check(name, known) >= 1


@pytest.mark.parametrize("name", kinds_first(sorted({*ROBOTS} - DONE)))
def test_printed_python_with_masses_and_centres_known(name):
    system = system_of(name)
    check(name, tuple(x for x in system.letters if system.kinds[x] in ("mass", "centre")))


@pytest.mark.parametrize("name", ["demo-arm", "tx40", "wrist-coupled"])
def test_rotor_inertias_that_group_with_nothing_are_told(name):
    """They have the name of their base parameter, and are no unknown."""
    system = system_of(name)
    assert system.alone and not {*system.alone} & {*system.letters, *system.vanishing, *system.data}


def test_quotients_of_the_same_lengths_are_told_apart():
    """m21 (L1**2 L1/L4 - L1 L1**2/L4) is 0: with quotients as letters of their own it told m21."""
    for known in (("cx12", "cx11", "Izz11", "m22", "cy11"), ("cx11", "m11", "m22", "m12", "Izz11")):
        assert len(determined(system_of("five-bar"), known)[0]) < 11
