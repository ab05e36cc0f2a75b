"""Known parameters: sets counted by brute force and elsewhere, values with sigma, CAD compared."""

from itertools import combinations

import numpy as np
import pytest

from modeler.core.errors import DataError, ModelerError, RobotError
from modeler.formulas import known_values, sufficient_sets
from modeler.formulas.solve import derive_values, solve
from tests.rotation import rotating, with_cases
from tests.terms.cases import model_of
from tests.terms.physical_cases import SEVEN, data_of, example, random_letters, slopes_of, system_of
from tests.texts import read_rows


def covariance_of(data: np.ndarray, rng: np.random.Generator, share: float) -> np.ndarray:
    """A correlated covariance, standard deviations a share of the values."""
    A = rng.normal(size=(len(data), 2 * len(data)))
    C = A @ A.T
    scale = share * np.abs(data) / np.sqrt(np.diag(C))
    return C * np.outer(scale, scale)


CASES = [
    ("two-link", ("m1", "m2"), 0.01),
    ("wrist", (*SEVEN, "cm"), 0.001),
    pytest.param("wrist", (*SEVEN, "cJ11"), 0.001, marks=pytest.mark.rotating),
    ("wrist", (*SEVEN, "bJ11"), 0.0001),
]


@pytest.mark.parametrize(("name", "known", "share"), CASES)
def test_values_and_sigmas_stand_a_monte_carlo_test(name, known, share):
    """120 fits and measured parameters by chance: mean and spread are those that are reported."""
    system, rng = system_of(name), np.random.default_rng(7)
    solution = solve(system, known)
    truth = random_letters(system, rng)
    data = data_of(system, truth)
    C = covariance_of(data, rng, share)
    cells = {x: truth[x] for x in solution.known}
    sigmas = {solution.known[0]: share * abs(truth[solution.known[0]])}
    result = derive_values(solution, data, C, cells, sigmas, truth)
    assert result.values == pytest.approx([truth[x] for x in result.letters], rel=1e-9)
    assert result.shares.sum(axis=1) == pytest.approx(1.0)
    L = np.linalg.cholesky(C)
    draws = []
    for _ in range(120):
        noisy = {x: v + sigmas.get(x, 0.0) * rng.normal() for x, v in cells.items()}
        sample = data + L @ rng.normal(size=len(data))
        draws.append(derive_values(solution, sample, C, noisy, sigmas, truth).values)
    z = (np.array(draws) - result.values) / result.sigmas
    assert np.all(np.abs(z.std(axis=0) - 1) < 0.25), result.letters
    assert np.all(np.abs(z.mean(axis=0)) < 0.35)


def test_a_quotient_that_may_be_by_zero_is_doubted_or_refused():
    system, truth = system_of("wrist"), example()
    solution = solve(system, (*SEVEN, "ct2"))
    cells = {x: truth[x] for x in solution.known}
    data = data_of(system, truth)
    small = cells | {"ct2": 0.001}
    sigmas = {"ct2": 0.001}
    result = derive_values(solution, data, np.eye(len(data)) * 1e-12, small, sigmas)
    assert result.doubtful["cm"].startswith(
        "cm is a quotient by ct2 = 0.001 +- 0.001, which may be 0"
    )
    with pytest.raises(DataError, match="wrist: cm is a quotient by ct2, which is 0 in this fit"):
        derive_values(solution, data, np.zeros((len(data),) * 2), cells | {"ct2": 0.0})


def test_several_roots_are_told_and_none_is_chosen():
    """With bJ11 for cm the example has two wrists of the same quantities: cm = 4 and 1.943."""
    system, truth = system_of("wrist"), example()
    solution = solve(system, (*SEVEN, "bJ11"))
    data, C = data_of(system, truth), np.zeros((len(system.data),) * 2)
    with pytest.raises(
        DataError, match=r"cm has 2 positive roots \(1.943, 4\); each fits the data"
    ):
        derive_values(solution, data, C, {x: truth[x] for x in solution.known})
    known = {x: truth[x] for x in solution.known}
    for near, values in ((3.9, truth), (2.0, None)):
        result = derive_values(solution, data, C, known, near={"cm": near})
        letters = known | dict(zip(result.letters, map(float, result.values), strict=True))
        assert data_of(system, letters) == pytest.approx(data, abs=1e-9)
        assert values is None or result.get_value("cJ11") == pytest.approx(truth["cJ11"])


@pytest.mark.rotating("long tests of terms")
def test_known_parameters_are_tested_and_the_test_is_honest():
    """z of consistent known values: root mean square 1; one that is 5 % off is reported."""
    system, truth, rng = system_of("wrist"), example(), np.random.default_rng(9)
    solution = solve(system, (*SEVEN, "cm", "ct2", "bt1"))
    assert solution.surplus == 2
    data = data_of(system, truth)
    C = covariance_of(data, rng, 0.001)
    L, z = np.linalg.cholesky(C), []
    sigmas = {"cm": 0.004}
    for _ in range(30):
        cells = {x: truth[x] + sigmas.get(x, 0.0) * rng.normal() for x in solution.known}
        sample = data + L @ rng.normal(size=len(data))
        rows = known_values.check_known(solution, sample, C, cells, sigmas)
        assert {"cm", "ct2", "bt1"} <= {row.letter for row in rows}
        z.append([row.z for row in rows])
    assert 0.8 < np.sqrt(np.mean(np.square(z))) < 1.2
    wrong = {x: truth[x] for x in solution.known} | {"ct2": truth["ct2"] * 1.05}
    content = {
        row.letter: row for row in known_values.check_known(solution, data, C, wrong, sigmas)
    }
    assert content["ct2"].is_contradictory and content["ct2"].implied_value == pytest.approx(
        truth["ct2"], rel=0.01
    )
    assert not known_values.check_known(solve(system, (*SEVEN, "cm")), data, C, wrong, sigmas)


def test_cad_false_alarms_are_as_rare_as_told():
    system, truth, rng = system_of("wrist"), example(), np.random.default_rng(10)
    data = data_of(system, truth)
    C = covariance_of(data, rng, 0.01)
    L, alarms = np.linalg.cholesky(C), 0
    for _ in range(150):
        sample = data + L @ rng.normal(size=len(data))
        alarms += bool(known_values.compare_cad(system, sample, C, truth).suspicious)
    assert alarms <= 6  # 1.5 expected


@pytest.mark.parametrize("seed", range(2))
def test_a_wrong_cad_entry_is_found(seed):
    """A parameter by chance, changed by 15 sigma of what shows it best: among those named, and
    the best of them, or one that enters in the same way, has the value of the truth.
    """
    system, rng = system_of("wrist"), np.random.default_rng(seed)
    truth = random_letters(system, rng)
    data = data_of(system, truth)
    C = covariance_of(data, rng, 0.01)
    sample = data + np.linalg.cholesky(C) @ rng.normal(size=len(data))
    letter = str(rng.choice(system.letters))
    h = 1e-6
    slope = np.abs(data_of(system, truth | {letter: truth[letter] + h}) - data) / h
    size = 15 / np.max(slope / np.sqrt(np.diag(C)))
    result = known_values.compare_cad(system, sample, C, truth | {letter: truth[letter] + size})
    named = {
        e.letters[0]: e for e in result.explanations if len(e.letters) == 1 and e.is_sufficient
    }
    assert letter in named, (letter, result.suspicious, result.explanations)
    assert named[letter].fitted_values[0] == pytest.approx(truth[letter], abs=size / 3)
    assert named[letter].chi_squared < result.chi_squared / 3


def test_two_wrong_cad_entries_are_found_as_a_pair():
    system, truth, rng = system_of("wrist"), example(), np.random.default_rng(4)
    data = data_of(system, truth)
    C = covariance_of(data, rng, 0.001)
    wrong = truth | {"at3": truth["at3"] * 1.1, "bJ12": truth["bJ12"] * 1.2}
    result = known_values.compare_cad(system, data, C, wrong)
    assert {"at3", "bJ12"} in [set(e.letters) for e in result.explanations]
    assert not [e for e in result.explanations if len(e.letters) == 1]


def test_cad_tolerances_widen_and_missing_values_are_told():
    system, truth, rng = system_of("wrist"), example(), np.random.default_rng(6)
    data = data_of(system, truth)
    C = covariance_of(data, rng, 0.001)
    off = truth | {"at3": truth["at3"] * 1.05}
    assert known_values.compare_cad(system, data, C, off).suspicious
    loose = known_values.compare_cad(system, data, C, off, {"at3": 0.05 * abs(truth["at3"])})
    assert not loose.suspicious
    partial = {x: v for x, v in truth.items() if x != "cJ22"}
    left = known_values.compare_cad(system, data, C, partial, {}, {"PG1": "set aside"}).not_compared
    assert left == {"PG1": "set aside", "PJ1": "no CAD value of cJ22"}
    assert known_values.compute_z_limit(1) == pytest.approx(2.576, abs=1e-3)
    assert [known_values.compute_chi_squared_limit(k) for k in (0, 5, 17, 100)] == pytest.approx(
        [0, 15.09, 33.41, 135.81], rel=3e-3
    )


@with_cases(
    "text, message",
    ("am=nan", "--known, am: got 'nan'; expected a finite number"),
    ("am=12+-", "--known, am, standard deviation: got ''; expected a finite number"),
    ("am,am", "--known: am is given twice"),
    ("aM=3", r'--known: got "aM" \(did you mean "am"\?\); expected physical parameters of wr'),
)
def test_known_parameters_as_they_are_typed(text, message):
    known = known_values.parse_known_values(
        " am=12+-0.1, bm = 6e0 ,al1=0.2,cm,", system_of("wrist")
    )
    assert known.names == ("am", "bm", "cm")  # al1 has no effect
    assert known.values == {"am": 12.0, "bm": 6.0} and known.sigmas == {"am": 0.1}
    with pytest.raises(RobotError, match=message):
        known_values.parse_known_values(text, system_of("wrist"))


@with_cases(
    "text, message",
    ("am = ", "cad.toml: no TOML"),
    ("mass = 12", 'cad.toml: got "mass"'),
    ("am = [12, 0.1, 3]", r"cad.toml, am: got \[12, 0.1, 3\]; expected \[value, standard dev"),
    ("am = 'heavy'", "cad.toml, am: got 'heavy'; expected a finite number"),
    ("relative_sigma = -1\nam = 2", "relative_sigma: got the standard deviation -1"),
    ("al1 = 0.2", "cad.toml: no value of a parameter with an effect"),
)
def test_cad_files_that_are_none(tmp_path, text, message):
    path = tmp_path / "cad.toml"
    path.write_text(text)
    with pytest.raises(RobotError, match=message):
        known_values.read_cad_file(path, system_of("wrist"))


def test_cad_files_as_they_are_written(tmp_path):
    path = tmp_path / "cad.toml"
    path.write_text("relative_sigma = 0.1\nam = 12\nbm = [6.0, 0.2]\n")
    known = known_values.read_cad_file(path, system_of("wrist"))
    assert known.values == {"am": 12.0, "bm": 6.0}
    assert known.sigmas == pytest.approx({"am": 1.2, "bm": 0.2})
    with pytest.raises(RobotError, match=r"none\.toml: cannot be read"):
        known_values.read_cad_file(tmp_path / "none.toml", system_of("wrist"))
    with pytest.raises(RobotError, match=r"here: the robot file has no values .*terms.example"):
        known_values.read_cad_example(model_of("two-link").robot, system_of("two-link"), "here")
    nominal = known_values.read_cad_example(model_of("wrist").robot, system_of("wrist"), "here")
    assert nominal.values["bl1"] == 0.1 and set(nominal.values) == set(system_of("wrist").letters)


# Counted by another program: exact ranks modulo 2147483647 and 2147483629 at two points.
WRITTEN = read_rows(
    """4 2 2 44; 3 3 2 286; 2 4 2 605; 1 5 2 462; 0 6 2 88; 4 1 3 166; 3 2 3 1441; 2 3 3 3877;
    1 4 3 3801; 0 5 3 1084; 4 0 4 129; 3 1 4 1992; 2 2 4 7538; 1 3 4 9618; 0 4 4 3587; 3 0 5 765;
    2 1 5 5251; 1 2 5 9426; 0 3 5 4559; 2 0 6 1043; 1 1 6 3344; 0 2 6 2203; 1 0 7 285; 0 1 7 285"""
)
CLASSES = {row[:-1]: row[-1] for row in WRITTEN}


def jacobian(system) -> np.ndarray:
    """(data, letters) at a random robot."""
    return slopes_of(system, random_letters(system, np.random.default_rng(1)))


def brute_force(system, size: int) -> list[tuple[str, ...]]:
    """Sets whose complement has independent columns, by singular values."""
    J, n = jacobian(system), len(system.letters)
    values = []
    for known in combinations(range(n), size):
        others = [k for k in range(n) if k not in known]
        if len(others) <= len(J) and np.linalg.matrix_rank(J[:, others], tol=1e-9) == len(others):
            values.append(tuple(system.letters[k] for k in known))
    return values


@pytest.mark.rotating("long tests of terms")
def test_the_wrist_as_counted_elsewhere():
    matches = sufficient_sets.find_known_sets(system_of("wrist"))
    assert (matches.size, matches.smallest, matches.count, matches.candidate_count) == (
        8,
        8,
        61879,
        1081575,
    )
    assert dict(matches.classes) == CLASSES
    contains = matches.contains
    assert contains["cm"] == 9062 and contains["bl1"] == contains["ct1"] == 34516
    assert contains["aJ11"] == 34077 and contains["bt3"] == 14327 and contains["cJ12"] == 14306


def test_seven_never_suffice():
    matches = sufficient_sets.find_known_sets(system_of("wrist"), 7)
    assert (matches.count, matches.candidate_count, matches.smallest) == (0, 480700, 8)


def class_of(system, members):
    """(masses, lengths and rotor inertias, centres, inertias) of a set."""
    eases = [sufficient_sets.EASE[system.kinds[x]] for x in members]
    return sum(e < 2 for e in eases), eases.count(2), eases.count(3)


@with_cases(
    "name, size",
    ("two-link", 1),
    ("two-link", 2),
    ("two-link", 4),
    ("two-link", 8),
    ("scara", 8),
    ("emps", 0),
    ("emps", 1),
    ("weightless", 4),
)
def test_counts_by_brute_force(name, size):
    system = system_of(name)
    expected = brute_force(system, size)
    matches = sufficient_sets.find_known_sets(system, size)
    assert matches.count == len(expected)
    assert matches.contains == {} or all(
        matches.contains[x] == sum(x in s for s in expected) for x in system.letters
    )
    for key, count in matches.classes.items():
        members = [s for s in expected if class_of(system, s) == key]
        assert len(members) == count
        if key == next(iter(matches.classes)):
            assert set(matches.easiest_sets) == set(members)


@pytest.mark.parametrize("name", ["scara", *rotating("puma560", "orthoglide-2003")])
def test_the_easiest_set_suffices_and_is_smallest(name):
    system, known = system_of(name), set(sufficient_sets.find_easiest_set(system_of(name)))
    J = jacobian(system)
    others = [k for k, x in enumerate(system.letters) if x not in known]
    assert (
        len(known)
        == sufficient_sets.count_smallest_set(system)
        == len(system.letters) - len(others)
    )
    assert np.linalg.matrix_rank(J[:, others]) == len(others) == np.linalg.matrix_rank(J)


def test_too_many_sets_and_sizes_that_are_none():
    with pytest.raises(ModelerError, match=r"puma560: about .*e\+13 sets to look at, more than 3e"):
        sufficient_sets.find_known_sets(system_of("puma560"))
    for size in (-1, 9):
        with pytest.raises(ModelerError, match=rf"got sets of {size}; expected 0 to 8"):
            sufficient_sets.find_known_sets(system_of("two-link"), size)


def test_rating_against_finite_differences():
    """One set, one input at a time: change it by 1 %, solve the quantities by Newton's method."""
    system, truth = system_of("wrist"), example()
    known = ("am", "bm", "bl1", "bt2", "ct1", "bJ33", "cJ33", "cm")
    (row,) = sufficient_sets.rate_sets(system, [known], truth)
    unknown = [x for x in system.letters if x not in known]
    at = [system.letters.index(x) for x in unknown]
    data = data_of(system, truth)
    squares = np.zeros(len(unknown))
    for k in range(len(data) + len(known)):
        wanted, letters = data.copy(), dict(truth)
        if k < len(data):
            wanted[k] *= 1 + 1e-6
        else:
            letters[known[k - len(data)]] *= 1 + 1e-6
        for _ in range(5):
            J = slopes_of(system, letters)[:, at]
            step = np.linalg.solve(J, wanted - data_of(system, letters))
            letters |= {x: letters[x] + dx for x, dx in zip(unknown, step, strict=True)}
        squares += [((letters[x] - truth[x]) / truth[x] / 1e-6) ** 2 for x in unknown]
    grown = dict(zip(unknown, np.sqrt(squares), strict=True))
    assert row.median_error == pytest.approx(np.median(list(grown.values())), rel=1e-3)
    assert row.letter == max(grown, key=grown.__getitem__)
    assert row.largest_error == pytest.approx(grown[row.letter], rel=1e-3)
