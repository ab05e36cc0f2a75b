"""Sets of known parameters: counts against brute force and against an independent count."""

from itertools import combinations

import numpy as np
import pytest

from modeler.core.errors import ModelerError
from modeler.formulas.sufficient_sets import EASE, easiest_set, known_sets, smallest_number
from modeler.formulas.values import SolvedNumbers, rated
from tests.terms.physical_cases import data_of, example, random_letters, system_of

# Counted by another program: exact ranks modulo 2147483647 and 2147483629 at two points.
CLASSES = {
    (4, 2, 2): 44, (3, 3, 2): 286, (2, 4, 2): 605, (1, 5, 2): 462, (0, 6, 2): 88,
    (4, 1, 3): 166, (3, 2, 3): 1441, (2, 3, 3): 3877, (1, 4, 3): 3801, (0, 5, 3): 1084,
    (4, 0, 4): 129, (3, 1, 4): 1992, (2, 2, 4): 7538, (1, 3, 4): 9618, (0, 4, 4): 3587,
    (3, 0, 5): 765, (2, 1, 5): 5251, (1, 2, 5): 9426, (0, 3, 5): 4559,
    (2, 0, 6): 1043, (1, 1, 6): 3344, (0, 2, 6): 2203, (1, 0, 7): 285, (0, 1, 7): 285,
}  # fmt: skip


def jacobian(system) -> np.ndarray:
    """(data, letters) at a random robot."""
    point = np.zeros(len(system.names))
    letters = random_letters(system, np.random.default_rng(1))
    for x, value in (*system.constants.items(), *letters.items()):
        point[system.place[x]] = value
    J = np.array([SolvedNumbers(system.definitions[d]).slopes(point) for d in system.data])
    return J[:, [system.place[x] for x in system.letters]]


def brute_force(system, size: int) -> list[tuple[str, ...]]:
    """Sets whose complement has independent columns, by singular values."""
    J, n = jacobian(system), len(system.letters)
    found = []
    for known in combinations(range(n), size):
        others = [k for k in range(n) if k not in known]
        if len(others) <= len(J) and np.linalg.matrix_rank(J[:, others], tol=1e-9) == len(others):
            found.append(tuple(system.letters[k] for k in known))
    return found


def test_the_wrist_as_counted_elsewhere():
    found = known_sets(system_of("wrist"))
    assert (found.size, found.smallest, found.count, found.possible) == (8, 8, 61879, 1081575)
    assert dict(found.classes) == CLASSES
    contains = found.contains
    assert contains["cm"] == 9062 and contains["bl1"] == contains["ct1"] == 34516
    assert contains["aJ11"] == 34077 and contains["bt3"] == 14327 and contains["cJ12"] == 14306


def test_seven_never_suffice():
    found = known_sets(system_of("wrist"), 7)
    assert (found.count, found.possible, found.smallest) == (0, 480700, 8)


def class_of(system, members):
    """(masses, lengths and rotor inertias, centres, inertias) of a set."""
    eases = [EASE[system.kinds[x]] for x in members]
    return sum(e < 2 for e in eases), eases.count(2), eases.count(3)


@pytest.mark.parametrize(
    ("name", "size"), [("two-link", 1), ("two-link", 2), ("two-link", 4), ("two-link", 8),
                       ("scara", 8), ("emps", 0), ("emps", 1), ("weightless", 4)],
)  # fmt: skip
def test_counts_by_brute_force(name, size):
    system = system_of(name)
    expected = brute_force(system, size)
    found = known_sets(system, size)
    assert found.count == len(expected)
    assert found.contains == {} or all(
        found.contains[x] == sum(x in s for s in expected) for x in system.letters
    )
    for key, count in found.classes.items():
        members = [s for s in expected if class_of(system, s) == key]
        assert len(members) == count
        if key == next(iter(found.classes)):
            assert set(found.easiest) == set(members)


@pytest.mark.parametrize("name", ["scara", "puma560", "orthoglide-2003"])
def test_the_easiest_set_suffices_and_is_smallest(name):
    system, known = system_of(name), set(easiest_set(system_of(name)))
    J = jacobian(system)
    others = [k for k, x in enumerate(system.letters) if x not in known]
    assert len(known) == smallest_number(system) == len(system.letters) - len(others)
    assert np.linalg.matrix_rank(J[:, others]) == len(others) == np.linalg.matrix_rank(J)


def test_too_many_sets_and_sizes_that_are_none():
    with pytest.raises(ModelerError, match=r"puma560: about .*e\+13 sets to look at, more than 3e"):
        known_sets(system_of("puma560"))
    for size in (-1, 9):
        with pytest.raises(ModelerError, match=rf"got sets of {size}; expected 0 to 8"):
            known_sets(system_of("two-link"), size)


def test_rating_against_finite_differences():
    """One set, one input at a time: change it by 1 %, solve the quantities by Newton's method."""
    system, truth = system_of("wrist"), example()
    known = ("am", "bm", "bl1", "bt2", "ct1", "bJ33", "cJ33", "cm")
    (row,) = rated(system, [known], truth)
    unknown = [x for x in system.letters if x not in known]
    at = [system.place[x] for x in unknown]
    data = data_of(system, truth)
    squares = np.zeros(len(unknown))
    for k in range(len(data) + len(known)):
        wanted, letters = data.copy(), dict(truth)
        if k < len(data):
            wanted[k] *= 1 + 1e-6
        else:
            letters[known[k - len(data)]] *= 1 + 1e-6
        for _ in range(5):
            point = np.zeros(len(system.names))
            for x, value in letters.items():
                if x in system.place:
                    point[system.place[x]] = value
            J = np.array([SolvedNumbers(system.definitions[d]).slopes(point) for d in system.data])
            step = np.linalg.solve(J[:, at], wanted - data_of(system, letters))
            letters |= {x: letters[x] + dx for x, dx in zip(unknown, step, strict=True)}
        squares += [((letters[x] - truth[x]) / truth[x] / 1e-6) ** 2 for x in unknown]
    grown = dict(zip(unknown, np.sqrt(squares), strict=True))
    assert row.middle == pytest.approx(np.median(list(grown.values())), rel=1e-3)
    assert row.letter == max(grown, key=grown.__getitem__)
    assert row.worst == pytest.approx(grown[row.letter], rel=1e-3)
