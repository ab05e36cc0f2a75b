"""A closed solution in numbers: exactly, to verify it, and with standard deviations of a fit."""

import math
import random
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.core.files import read_text
from modeler.core.json import parse_toml
from modeler.derivation import evaluate_modulo
from modeler.formulas.physical import read_printed_terms
from modeler.formulas.physical_system import NumericPolynomial, PhysicalSystem
from modeler.formulas.ring import Poly, evaluate_polynomial, find_places
from modeler.formulas.solve import ClosedSolution, SolvingStep, derive_values, solve
from modeler.formulas.thresholds import THRESHOLDS
from modeler.robot import Robot, suggest_name

# Values of physical parameters as people give them: "am=12+-0.1,bm=6", or a CAD file.


_CAD_KEY = "relative_sigma"


@dataclass(frozen=True)
class KnownValues:
    """Parameters that somebody knows.

    Attributes:
        names: in the order given.
        values: of those that came with one, SI units.
        sigmas: standard deviations of those that came with one.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    sigmas: Mapping[str, float]


def parse_known_values(text: str, system: PhysicalSystem, where: str = "--known") -> KnownValues:
    """Reads "am=12,bm=6+-0.1,bl1".

    Raises:
        RobotError: an unknown or repeated name, no number, or that of no body.
    """
    values: dict[str, float] = {}
    sigmas: dict[str, float] = {}
    names: list[str] = []
    for piece in filter(None, (part.strip() for part in text.split(","))):
        name, equals, rest = (part.strip() for part in piece.partition("="))
        check_symbol(name, system, where)
        if name in names:
            raise RobotError(f"{where}: {name} is given twice; expected each parameter once")
        names.append(name)
        if equals:
            value, spread, sigma = rest.replace("±", "+-").partition("+-")
            values[name] = _check_possible(
                name, _parse_number(value, f"{where}, {name}"), system, where
            )
            if spread:
                sigmas[name] = _parse_sigma(sigma, f"{where}, {name}")
    effective = tuple(name for name in names if name in system.letters)
    known = {name: values[name] for name in effective if name in values}
    return KnownValues(effective, known, {n: sigmas[n] for n in effective if n in sigmas})


def check_symbol(name: str, system: PhysicalSystem, where: str) -> None:
    """Refuses what is not a physical parameter or length of the robot.

    Raises:
        RobotError: shows what it may have meant.
    """
    names = (*system.letters, *system.vanishing, *system.alone, *system.constants)
    if name not in names:
        raise RobotError(
            f'{where}: got "{name}"{suggest_name(name, names)}; expected physical parameters of '
            f"{system.robot}: {', '.join(system.letters)}"
        )


def _parse_number(text: Any, where: str) -> float:
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if isinstance(text, bool) or not math.isfinite(value):
        raise RobotError(f"{where}: got {text!r}; expected a finite number, SI units")
    return value


def _check_possible(name: str, value: float, system: PhysicalSystem, where: str) -> float:
    if name in system.masses and value <= 0.0:
        raise RobotError(f"{where}, {name}: got the mass {value:g} kg; expected more than 0")
    if name in system.moments and value < 0.0:
        raise RobotError(f"{where}, {name}: got the moment {value:g} kg m^2; expected 0 or more")
    return value


def _parse_sigma(text: Any, where: str) -> float:
    value = _parse_number(text, f"{where}, standard deviation")
    if value < 0.0:
        raise RobotError(f"{where}: got the standard deviation {value:g}; expected 0 or more")
    return value


def read_cad_file(path: Path, system: PhysicalSystem) -> KnownValues:
    """Reads a TOML file: `am = 12.0`, `bm = [6.0, 0.1]` with a standard deviation.

    `relative_sigma = 0.02` gives every value without one that share of itself.

    Raises:
        RobotError: no such file, no TOML, an unknown name, no number.
    """
    try:
        raw = parse_toml(read_text(path))
    except OSError as error:
        raise RobotError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    except ValueError as error:
        raise RobotError(f"{path}: no TOML ({error}); expected lines such as am = 12.0") from None
    share = _parse_sigma(raw.pop(_CAD_KEY, 0.0), f"{path}, {_CAD_KEY}")
    values: dict[str, float] = {}
    sigmas: dict[str, float] = {}
    for name, cell in raw.items():
        check_symbol(name, system, str(path))
        where = f"{path}, {name}"
        if isinstance(cell, list):
            if len(cell) != 2:
                raise RobotError(f"{where}: got {cell}; expected [value, standard deviation]")
            values[name], sigmas[name] = _parse_number(cell[0], where), _parse_sigma(cell[1], where)
        else:
            values[name] = _parse_number(cell, where)
            sigmas[name] = share * abs(values[name])
    return _select_effective(values, sigmas, system, str(path))


def read_cad_example(robot: Robot, system: PhysicalSystem, where: str) -> KnownValues:
    """Reads the example of the robot file, `[terms.example]`; missing lengths are nominal.

    Raises:
        RobotError: it has none.
    """
    example = read_printed_terms(robot).example
    if not example:
        raise RobotError(
            f"{where}: the robot file has no values of physical parameters ([terms.example]); "
            "give a file, such as --cad cad.toml"
        )
    values = robot.evaluate_symbols() | {name: float(value) for name, value in example.items()}
    return _select_effective(values, {}, system, where)


def _select_effective(
    values: Mapping[str, float], sigmas: Mapping[str, float], system: PhysicalSystem, where: str
) -> KnownValues:
    effective_names: Collection[str] = [name for name in values if name in system.letters]
    if not effective_names:
        raise RobotError(
            f"{where}: no value of a parameter with an effect on the torques; expected some of "
            f"{', '.join(system.letters)}"
        )
    known = {name: values[name] for name in effective_names}
    sure = {name: sigmas[name] for name in effective_names if sigmas.get(name, 0.0) > 0.0}
    return KnownValues(tuple(effective_names), known, sure)


# Which sufficing set of known parameters lets errors grow least.


# Known parameters and CAD values against what a fit says.


def compute_z_limit(tests: int) -> float:
    """Returns the |z| above which one of so many tests is significant (normal, Bonferroni)."""
    return NormalDist().inv_cdf(1.0 - THRESHOLDS.false_alarm_rate / (2.0 * max(tests, 1)))


def compute_chi_squared_limit(freedom: int) -> float:
    """Returns the chi^2 that consistent values exceed at the false alarm rate."""
    if freedom <= 0:
        return 0.0
    part = 2.0 / (9.0 * freedom)
    z = NormalDist().inv_cdf(1.0 - THRESHOLDS.false_alarm_rate)
    return float(freedom * (1.0 - part + z * math.sqrt(part)) ** 3)


@dataclass(frozen=True)
class KnownAgainstFit:
    """A given value against what data and the other known parameters say.

    Attributes:
        letter: parameter.
        known_value, known_sigma: as known.
        implied_value, implied_sigma: as it follows.
        z: (given - implied) / standard deviation of the difference.
        is_contradictory: True if |z| is significant.
    """

    letter: str
    known_value: float
    known_sigma: float
    implied_value: float
    implied_sigma: float
    z: float
    is_contradictory: bool


def check_known(
    solution: ClosedSolution,
    data: Sequence[float],
    covariance: np.ndarray,
    known: Mapping[str, float],
    sigmas: Mapping[str, float],
) -> tuple[KnownAgainstFit, ...]:
    """Compares every known parameter that would follow from the others with what follows.

    Without a surplus of relations there is none. A parameter whose formula cannot be evaluated is
    left out.
    """
    if not solution.surplus:
        return ()
    tested_rows = []
    for letter in solution.known:
        others = [x for x in solution.known if x != letter]
        other = solve(solution.system, others)
        if letter not in other.solved_letters:
            continue
        other_values = {x: known[x] for x in others}
        try:
            derived = derive_values(other, data, covariance, other_values, sigmas)
        except DataError:
            continue
        if letter in derived.doubtful:
            continue
        value, sigma = derived.get_value(letter), derived.get_sigma(letter)
        known_sigma = sigmas.get(letter, 0.0)
        spread = math.hypot(sigma, known_sigma)
        z = _standardise_difference(known[letter] - value, spread)
        tested_rows.append((letter, known[letter], known_sigma, value, sigma, z))
    bound = compute_z_limit(len(tested_rows))
    return tuple(KnownAgainstFit(*row, abs(row[-1]) > bound) for row in tested_rows)


def _standardise_difference(difference: float, sigma: float) -> float:
    if sigma > 0.0:
        return difference / sigma
    return 0.0 if abs(difference) < 1e-12 else math.copysign(math.inf, difference)


@dataclass(frozen=True)
class CadRow:
    """One identified quantity against CAD.

    Attributes:
        name: base parameter or coefficient.
        identified_value, sigma: of the fit.
        cad_value, cad_sigma: from the CAD values and their tolerances.
        z: (identified - cad) / standard deviation of the difference.
        is_suspicious: |z| is significant.
        letters: parameters that it depends on.
    """

    name: str
    identified_value: float
    sigma: float
    cad_value: float
    cad_sigma: float
    z: float
    is_suspicious: bool
    letters: tuple[str, ...]


@dataclass(frozen=True)
class Explanation:
    """CAD entries that, changed alone, agree better with the fit.

    Attributes:
        letters: one or two parameters.
        cad_values: their CAD values.
        fitted_values: the values that agree best with the fit.
        chi_squared: what is left, in as many degrees of freedom as rows less letters.
        is_sufficient: chi^2 left is what noise leaves.
    """

    letters: tuple[str, ...]
    cad_values: tuple[float, ...]
    fitted_values: tuple[float, ...]
    chi_squared: float
    is_sufficient: bool


@dataclass(frozen=True)
class CadComparison:
    """Identified against CAD.

    Attributes:
        rows: all quantities that can be compared, most significant first.
        limit: |z| from which a row is suspicious.
        chi_squared: of all rows, correlations counted.
        not_compared: {quantity: why it is not compared}.
        implicated_parameters: parameters that enter suspicious rows and no good one.
        explanations: best first; if no change of one or two entries is enough, the best single
            one; empty if nothing is suspicious.
    """

    rows: tuple[CadRow, ...]
    limit: float
    chi_squared: float
    not_compared: Mapping[str, str]
    implicated_parameters: tuple[str, ...]
    explanations: tuple[Explanation, ...]

    @property
    def suspicious(self) -> tuple[CadRow, ...]:
        """Returns the rows that do not agree."""
        return tuple(row for row in self.rows if row.is_suspicious)


def compare_cad(
    system: PhysicalSystem,
    data: Sequence[float],
    covariance: np.ndarray,
    cad: Mapping[str, float],
    sigmas: Mapping[str, float] | None = None,
    unknown_data: Mapping[str, str] | None = None,
) -> CadComparison:
    """Returns which identified quantities disagree with CAD, and which CAD entry would explain it.

    z = (d - p(cad)) / sqrt(C_ii + (J S J')_ii); an explanation changes one entry, or two where
    one is not enough, so that chi^2 = r' (C + J S J')^-1 r is least; enough is a chi^2 below its
    limit.

    Args:
        system: data as polynomials p of the parameters, J their Jacobian.
        data: identified values d.
        covariance: of them, C.
        cad: values of parameters; a quantity is compared if all its parameters have one.
        sigmas: tolerances of CAD values, S their squares.
        unknown_data: {quantity: why it has no value}; these are left out.
    """
    places = {d: find_places(system.definitions[d]) for d in system.data}
    place = system.place
    depends = {d: tuple(x for x in system.letters if place[x] in places[d]) for d in system.data}
    missing = {d: [x for x in letters if x not in cad] for d, letters in depends.items()}
    left_out = {d: f"no CAD value of {', '.join(some)}" for d, some in missing.items() if some}
    left_out |= unknown_data or {}
    compared = [i for i, name in enumerate(system.data) if name not in left_out]
    problem = _CadProblem(system, compared, np.asarray(data), covariance, cad, sigmas or {})
    rows = problem.build_rows(covariance, depends)
    bad = {x for row in rows if row.is_suspicious for x in row.letters}
    good = {x for row in rows if not row.is_suspicious for x in row.letters}
    return CadComparison(
        tuple(rows),
        compute_z_limit(len(compared)),
        problem.compute_chi_squared(problem.start),
        left_out,
        tuple(x for x in system.letters if x in bad - good),
        _find_explanations(problem, [x for x in system.letters if x in bad]),
    )


class _CadProblem:
    """Residuals of the compared quantities for any values of the parameters."""

    def __init__(
        self,
        system: PhysicalSystem,
        compared: Sequence[int],
        data: np.ndarray,
        covariance: np.ndarray,
        cad: Mapping[str, float],
        sigmas: Mapping[str, float],
    ) -> None:
        self.system, self.compared = system, list(compared)
        self.data = data[self.compared]
        self.polys = [NumericPolynomial(system.definitions[system.data[i]]) for i in self.compared]
        self.start = system.build_point(cad)
        J = self.evaluate_jacobian(self.start)
        S = np.zeros(len(system.names))
        for name, value in sigmas.items():
            if name in system.place:
                S[system.place[name]] = value**2
        from_cad = (J * S) @ J.T
        self.cad = self.evaluate_quantities(self.start)
        self.cad_sigma = np.sqrt(np.diag(from_cad)) if self.compared else np.zeros(0)
        total = covariance[np.ix_(self.compared, self.compared)] + from_cad
        self.sigma = np.sqrt(np.diag(total)) if self.compared else np.zeros(0)
        self.weight = _compute_inverse_root(total)

    def build_rows(
        self, covariance: np.ndarray, depends: Mapping[str, tuple[str, ...]]
    ) -> list[CadRow]:
        """Builds the rows of the table, most significant first."""
        z, bound = self.compute_z(self.start), compute_z_limit(len(self.compared))
        rows = []
        for k, i in enumerate(self.compared):
            name, sigma = self.system.data[i], math.sqrt(max(covariance[i, i], 0.0))
            both = float(self.cad[k]), float(self.cad_sigma[k])
            suspicious = bool(abs(z[k]) > bound)
            datum = float(self.data[k])
            row = CadRow(name, datum, sigma, *both, float(z[k]), suspicious, depends[name])
            rows.append(row)
        return sorted(rows, key=lambda row: -abs(row.z))

    def evaluate_quantities(self, point: np.ndarray) -> np.ndarray:
        """Evaluates the compared quantities at a point of the parameters."""
        return np.array([poly.evaluate(point) for poly in self.polys])

    def evaluate_jacobian(self, point: np.ndarray) -> np.ndarray:
        """Evaluates the Jacobian (quantities, generators) at a point of the parameters."""
        slopes = [poly.evaluate_slopes(point) for poly in self.polys]
        return np.array(slopes).reshape(-1, len(point))

    def compute_z(self, point: np.ndarray) -> np.ndarray:
        """Computes the differences of data and quantities by their standard deviations."""
        difference = self.data - self.evaluate_quantities(point)
        pairs = zip(difference, self.sigma, strict=True)
        return np.array([_standardise_difference(a, b) for a, b in pairs])

    def compute_chi_squared(self, point: np.ndarray) -> float:
        """Computes the weighted sum of squares of the differences, correlations counted."""
        r = self.weight @ (self.data - self.evaluate_quantities(point))
        return float(r @ r)

    def select_promising_groups(self, letters: Sequence[str], size: int) -> list[tuple[str, ...]]:
        """Selects groups of that size that explain most to first order; all, if they are few."""
        groups = list(combinations(letters, size))
        if len(groups) <= THRESHOLDS.fitted_groups:
            return groups
        r = self.weight @ (self.data - self.evaluate_quantities(self.start))
        J = self.weight @ self.evaluate_jacobian(self.start)
        left = []
        for group in groups:
            columns = J[:, [self.system.place[x] for x in group]]
            rest = r - columns @ np.linalg.lstsq(columns, r, rcond=None)[0]
            left.append((float(rest @ rest), group))
        return [group for _, group in sorted(left)[: THRESHOLDS.fitted_groups]]

    def fit_letters(self, letters: Sequence[str]) -> np.ndarray:
        """Returns the point, those letters changed for least squares (Gauss-Newton)."""
        at = [self.system.place[x] for x in letters]
        point = self.start.copy()
        best = self.compute_chi_squared(point)
        for _ in range(THRESHOLDS.fit_rounds):
            r = self.weight @ (self.data - self.evaluate_quantities(point))
            J = self.weight @ self.evaluate_jacobian(point)[:, at]
            step = np.linalg.lstsq(J, r, rcond=None)[0]
            for _ in range(THRESHOLDS.fit_rounds):
                trial = point.copy()
                trial[at] += step
                if (chi := self.compute_chi_squared(trial)) <= best:
                    break
                step = step / 2.0
            else:
                break
            done = best - chi <= THRESHOLDS.fit_convergence * best
            point, best = trial, chi
            if done:
                break
        return point


def _compute_inverse_root(covariance: np.ndarray) -> np.ndarray:
    """W with W' W = covariance^-1 where it has variance (its pseudo-inverse elsewhere)."""
    if not len(covariance):
        return np.zeros((0, 0))
    scale = np.sqrt(np.diag(covariance))
    scale[scale == 0.0] = 1.0
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    keep = values > 1e-12 * values[-1] if values[-1] > 0 else values > 0
    return (vectors[:, keep] / np.sqrt(values[keep])).T / scale


def _find_explanations(
    problem: _CadProblem, letters: Sequence[str], most: int = 6
) -> tuple[Explanation, ...]:
    explanations: list[Explanation] = []
    for size in (1, 2):
        bound = compute_chi_squared_limit(len(problem.weight) - size)
        for group in problem.select_promising_groups(letters, size):
            at = [problem.system.place[x] for x in group]
            point = problem.fit_letters(group)
            chi = problem.compute_chi_squared(point)
            cad, new = tuple(problem.start[at].tolist()), tuple(point[at].tolist())
            explanations.append(Explanation(group, cad, new, chi, chi <= bound))
        explanations.sort(
            key=lambda e: (not e.is_sufficient, len(e.letters), e.chi_squared, e.letters)
        )
        if explanations and explanations[0].is_sufficient:
            return tuple(e for e in explanations if e.is_sufficient)[:most]
    return tuple(explanations[:1])


def verify_solution(
    solution: ClosedSolution, times: int = THRESHOLDS.verified_robots, seed: int = THRESHOLDS.seed
) -> int:
    """Returns the number of random robots for which every formula gives back the parameter.

    Exact: over Q; modulo a prime where the geometry has roots of numbers.
    """
    system, chance = solution.system, random.Random(seed)
    good = 0
    for _ in range(times):
        value: Callable[[Poly], Any]
        if any(name.startswith("sqrt(") for name in system.names):
            prime, point = system.draw_modular_point(chance)
            value = partial(evaluate_modulo, point=point, prime=prime)
        else:
            prime, point = 0, system.derive_consistent_values(draw_random_rationals(system, chance))
            value = partial(evaluate_polynomial, values=point)
        truths = ((step, point[system.place[step.letter]]) for step in solution.steps)
        good += all(_is_satisfied(step, value, truth, prime) for step, truth in truths)
    return good


def draw_random_rationals(system: PhysicalSystem, chance: random.Random) -> dict[str, Fraction]:
    """Draws letters and constants at random, cosine and sine on the circle."""
    values: dict[str, Fraction] = {}
    for name in (*system.letters, *system.constants):
        if name.startswith("cos("):
            t = Fraction(chance.randint(2, 40), chance.randint(41, 90))
            values[name] = (1 - t * t) / (1 + t * t)
            values["sin" + name[3:]] = 2 * t / (1 + t * t)
        elif name not in values:
            sign = 1 if name in system.masses else chance.choice((-1, 1))
            values[name] = sign * Fraction(chance.randint(1, 99), chance.randint(1, 99))
    return values


def _is_satisfied(step: SolvingStep, value: Callable[[Poly], Any], truth: Any, prime: int) -> bool:
    """If the formula gives `truth`: modulo the prime, or exactly where that is 0."""
    if step.equation is not None:
        return bool(value(step.equation) == 0)
    down = value(step.denominator)
    rest = value(step.numerator) - truth * down
    return bool(down != 0 and (rest % prime if prime else rest) == 0)
