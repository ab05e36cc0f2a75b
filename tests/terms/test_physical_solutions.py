"""Physical parameters in closed form: against the paper, against numbers, as Python that runs."""

import dataclasses
import itertools
import random

import numpy as np
import pytest
import sympy

from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import draw_random_states, evaluate_regressor
from modeler.formulas.known_values import verify_solution
from modeler.formulas.physical import read_printed_terms
from modeler.formulas.physical_system import build_physical_system
from modeler.formulas.solve import (
    derive_values,
    find_determined,
    format_formula,
    format_missing_lines,
    format_solution_lines,
    solve,
)
from modeler.formulas.sufficient_sets import count_smallest_set
from modeler.robot.read import parse_robot_text
from tests.robots import ROBOTS, one_always
from tests.rotation import rotating
from tests.terms.cases import TEXTS, edited_wrist, model_of
from tests.terms.physical_cases import SEVEN, data_of, random_letters, slopes_of, system_of

# How cm follows if one parameter more than the paper's seven is known; derived by hand from
# PG1 = cm (bl1 + ct1) + bm bt1, PG2 = -cm ct2, PG3 = -cm ct3, PJ1, PJ2, PJ6, PJ13, PJ16.
CM = {
    "ct2": "-PG2/ct2",
    "cJ11": "(PG2**2 + PG3**2)/(PJ16 - cJ11)",
    "cJ22": "(PG3**2 - PG2**2)/(PJ1 - cJ22 + cJ33)",
    "bt1": "(PG1 - bm*bt1)/(bl1 + ct1)",
    "bJ13": "(PG1 + bm*(bJ13 - PJ6/2)/PG4)/(bl1 + ct1)",
}


def expression(text: str) -> sympy.Expr:
    names = (*system_of("wrist").names, *SEVEN)
    return sympy.sympify(text, {name: sympy.Symbol(name) for name in names})


def in_known(solution, letter: str) -> sympy.Expr:
    """A formula with all earlier ones put in."""
    table: dict[sympy.Symbol, sympy.Expr] = {}
    for step in solution.steps:
        value = expression(format_formula(step, solution.system)).subs(table)
        table[sympy.Symbol(step.letter)] = value
        if step.letter == letter:
            return value
    raise AssertionError(letter)


@pytest.mark.parametrize(
    "eighth",
    [x if x in ("cJ22", "bt1") else pytest.param(x, marks=pytest.mark.rotating) for x in CM],
)
def test_cm_follows_as_by_hand(eighth):
    solution = solve(system_of("wrist"), (*SEVEN, eighth))
    assert sympy.cancel(in_known(solution, "cm") - expression(CM[eighth])) == 0
    assert len(solution.steps) == 17 and not solution.missing
    assert verify_solution(solution) == 20


def test_formulas_are_those_of_the_paper():
    """With cm known: the paper's other seventeen, but for aJ11, whose sign is a misprint."""
    printed = read_printed_terms(model_of("wrist").robot).solutions
    solution = solve(system_of("wrist"), (*SEVEN, "cm"))
    ours = {s.letter: expression(format_formula(s, solution.system)) for s in solution.steps}
    assert set(ours) == set(printed) - {"cm"}
    for letter, value in ours.items():
        top, bottom = printed[letter]
        theirs = expression(top.text) / expression(bottom.text if bottom else "1")
        if letter == "aJ11":
            theirs = -theirs
        assert sympy.cancel(value - theirs) == 0, letter


@pytest.mark.parametrize("eighth", ["bJ11", pytest.param("aJ11", marks=pytest.mark.rotating)])
def test_cm_as_the_root_of_a_cubic(eighth):
    solution = solve(system_of("wrist"), (*SEVEN, eighth))
    (step,) = [step for step in solution.steps if step.equation is not None]
    place = solution.system.place["cm"]
    assert step.letter == "cm" and max(at[place] for at in step.equation) == 3
    assert verify_solution(solution) == 20 and not solution.undetermined
    assert check("wrist", (*SEVEN, eighth)) >= 1


@pytest.mark.parametrize("eighth", ["at2", pytest.param("bJ23", marks=pytest.mark.rotating)])
def test_what_does_not_help_is_told(eighth):
    """cm cannot follow from the seven, nor with any of these: the paper's formula is 0/0."""
    solution = solve(system_of("wrist"), (*SEVEN, eighth))
    assert solution.missing == 1
    letters = "cm ct2 ct3 bt1 cJ11 cJ22 cJ23 bJ11 bJ12 bJ13 bJ22 aJ11"
    assert set(solution.undetermined) == set(letters.split())
    assert not set(solution.solved_letters) & set(solution.undetermined)
    first, second = format_missing_lines(solution)
    assert first.startswith("undetermined: aJ11") and "1 more must be known: one of cm, " in second
    for more in solution.undetermined:
        assert len(find_determined(system_of("wrist"), (*SEVEN, eighth, more))[0]) == 16, more


def test_a_wrong_formula_is_not_verified():
    solution = solve(system_of("wrist"), (*SEVEN, "cm"))
    for k, step in enumerate(solution.steps):
        wrong = dataclasses.replace(step, numerator=step.numerator * 2)
        steps = (*solution.steps[:k], wrong, *solution.steps[k + 1 :])
        assert verify_solution(dataclasses.replace(solution, steps=steps)) == 0, step.letter


def test_a_quotient_of_zeros_is_not_verified():
    """The paper's cm, by coefficients: PJ3 + PJ1 - PS3/2 is the zero polynomial."""
    solution = solve(system_of("wrist"), (*SEVEN, "cm"))
    ring = solution.system.ring
    steps = (dataclasses.replace(solution.steps[0], numerator=ring.zero, denominator=ring.zero),)
    assert verify_solution(dataclasses.replace(solution, steps=steps)) == 0


@pytest.mark.parametrize("name", ["wrist", pytest.param("odd", marks=pytest.mark.rotating)])
def test_determined_as_the_null_space_says(name):
    """In floating point: x follows if every vector of the kernel is zero at x."""
    system, rng = system_of(name), np.random.default_rng(5)
    J = slopes_of(system, random_letters(system, rng))
    for _ in range(20):
        known = set(rng.choice(system.letters, rng.integers(0, len(system.letters)), replace=False))
        unknown = [x for x in system.letters if x not in known]
        _, s, Vt = np.linalg.svd(J[:, [system.letters.index(x) for x in unknown]])
        kernel = Vt[int((s > 1e-9 * s[0]).sum()) if len(s) else 0 :]
        size = np.abs(kernel).max(axis=0, initial=0)
        free = {x for k, x in enumerate(unknown) if size[k] > 1e-7}
        assert set(find_determined(system, known)[0]) == set(unknown) - free


def test_two_links_as_in_a_textbook():
    solution = solve(system_of("two-link"), ("m1", "m2"))
    assert set(format_solution_lines(solution)) == {
        "cx2 = MX2/m2",
        "cy2 = MY2/m2",
        "cy1 = MY1/m1",
        "cx1 = (MX1R - m2*L1)/m1",
        "Izz2 = ZZ2 - m2*(cx2**2 + cy2**2)",
        "Izz1 = ZZ1R - m1*(cx1**2 + cy1**2) - m2*L1**2",
    }


def test_only_a_length_that_no_fit_needs_is_unknown():
    assert system_of("wrist").source == "coefficients" and "bl1" in system_of("wrist").letters
    assert system_of("two-link").source == "base"
    assert system_of("two-link").constants == {"L1": 0.4}
    assert system_of("wrist", "base").constants == {"bl1": 0.1}


def test_a_fit_with_a_wrong_length_gives_the_right_coefficients():
    """Torques of a wrist with bl1 = 0.15 fitted with bl1 = 0.10: no error, and PG, PJ are true."""
    true = edited_wrist(("bl1 = 0.10", "bl1 = 0.15"))
    system, rng = system_of("wrist"), np.random.default_rng(3)
    letters = random_letters(system, rng) | {"bl1": 0.15}
    base = derive_base_parameters(true)
    item = build_physical_system(true, base, "base")
    columns = {p.name: p.column for p in base.parameters}
    states = draw_random_states(true, 60, rng)
    true_W, W = (
        evaluate_regressor(m, states)[..., [columns[d] for d in system.base]].reshape(-1, 17)
        for m in (true, model_of("wrist"))
    )
    assert item.data == system.base
    tau = true_W @ data_of(item, letters)
    beta, *_ = np.linalg.lstsq(W, tau, rcond=None)
    assert np.abs(tau - W @ beta).max() < 1e-9 * np.abs(tau).max()
    assert system.to_data @ beta == pytest.approx(data_of(system, letters), rel=1e-9, abs=1e-9)


@pytest.mark.rotating("long tests of terms")
def test_quotients_of_lengths_have_names():
    system = system_of("orthoglide-2003")
    assert system.abbreviations["k1"] == "1/D41"
    assert system.constants["k1"] == pytest.approx(1 / 0.31)
    masses = [x for x in system.letters if system.kinds[x] == "mass"]
    lines = format_solution_lines(solve(system, masses))
    assert lines[0] == "k1 = 1/D41"


def test_coefficients_of_a_tied_robot_are_refused():
    with pytest.raises(RobotError, match="five-bar: coefficients are written for serial"):
        system_of("five-bar", "coefficients")


def test_a_letter_that_is_the_name_of_a_base_parameter_is_refused():
    text = TEXTS["weightless"].replace("11", "1").replace("12", "2")
    link = '[physical.2]\nmass = "ZZ2"\ncentre = [0, 0, 0]\ninertia = [0, 0, 0, 0, 0, "k"]\n'
    model = derive_model(parse_robot_text(text + link, "weightless"))
    with pytest.raises(RobotError, match="letter ZZ2 is also the name of an identified quantity"):
        build_physical_system(model, derive_base_parameters(model), "base")


EVERY = ("two-link", "emps")
"""Robots of which all smallest sets are tried."""
SAMPLED = {"wrist": 1, "scara": 2, "odrive": 2, "five-bar": 2, "3rrr": 1}
"""Of these some, by chance."""
DONE = {*EVERY, *SAMPLED, "evra", "stewart"}
"""The last two take 30 s, and have no quotient of another kind than the others."""


def sets_of(name: str) -> list[tuple[str, ...]]:
    """Smallest sets that suffice."""
    system, chance = system_of(name), random.Random(4)
    size = count_smallest_set(system)
    tried = (tuple(chance.sample(system.letters, size)) for _ in itertools.count())
    every = itertools.combinations(system.letters, size) if name in EVERY else tried
    wanted = len(system.letters) - size
    values = (known for known in every if len(find_determined(system, known)[0]) == wanted)
    return list(itertools.islice(values, SAMPLED.get(name)))


def check(name: str, known: tuple[str, ...]) -> int:
    """Runs what is printed; the number of robots that fit, of which one is the true one."""
    system = system_of(name)
    solution = solve(system, known)
    truth = random_letters(system, np.random.default_rng(1))
    data, place = data_of(system, truth), dict[str, object]()
    exec("\n".join(format_solution_lines(solution, "python")), place)
    function = place["physical_parameters"]
    values = model_of(name).robot.evaluate_symbols() | truth
    values |= dict(zip(system.data, data, strict=True))
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    result = function(**{x: values[x] for x in names})
    assert isinstance(result, list) == any(step.equation is not None for step in solution.steps)
    robots = result if isinstance(result, list) else [result]
    best = min(robots, key=lambda robot: max([abs(robot[x] - truth[x]) for x in robot] or [0.0]))
    assert verify_solution(solution, 5) == 5 and not solution.without_formula
    assert {*solution.solved_letters, *solution.undetermined} == {*system.letters} - {*known}
    if solution.missing:
        rank = find_determined(system, known)[1]
        assert find_determined(system, [*known, solution.undetermined[0]])[1] == rank
    exact = np.zeros((len(data),) * 2)
    item = derive_values(solution, data, exact, {x: truth[x] for x in known}, near=truth)
    assert set(best) == set(solution.solved_letters) == set(item.letters)
    for x, value in best.items():
        assert value == pytest.approx(truth[x], rel=1e-5, abs=1e-5), (x, known)
        assert value == pytest.approx(item.get_value(x), rel=1e-5, abs=1e-5), (x, known)
    for robot in robots if not solution.undetermined else ():  # each of them has the same data
        assert data_of(system, truth | robot) == pytest.approx(data, rel=1e-5, abs=1e-5), known
    return len(robots)


@pytest.mark.parametrize("name", [*EVERY, "wrist", *rotating(*sorted({*SAMPLED} - {"wrist"}))])
def test_printed_python_of_smallest_sets(name):
    for known in sets_of(name):
        check(name, known)


@pytest.mark.parametrize("name", one_always(sorted({*ROBOTS} - DONE), "sr400"))
def test_printed_python_with_masses_and_centres_known(name):
    system = system_of(name)
    check(name, tuple(x for x in system.letters if system.kinds[x] in ("mass", "centre")))


def test_rotor_inertias_that_group_with_nothing_are_told():
    """They have the name of their base parameter, and are no unknown."""
    system = system_of("demo-arm")
    assert system.alone and not {*system.alone} & {*system.letters, *system.vanishing, *system.data}


def test_quotients_of_the_same_lengths_are_told_apart():
    """m21 (L1**2 L1/L4 - L1 L1**2/L4) is 0: with quotients as letters of their own it gave m21."""
    for known in (("cx12", "cx11", "Izz11", "m22", "cy11"), ("cx11", "m11", "m22", "m12", "Izz11")):
        assert len(find_determined(system_of("five-bar"), known)[0]) < 11
