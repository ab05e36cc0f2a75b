"""A closed solution in numbers: exactly, to verify it, and with standard deviations of a fit."""

import math
import random
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.core.files import read_text
from modeler.core.json import parse_toml
from modeler.derivation import collect_powers, convert_to_fraction, evaluate_modulo
from modeler.formulas.physical_system import PhysicalSystem
from modeler.formulas.printed import read_printed_terms
from modeler.formulas.ring import Poly, evaluate_polynomial
from modeler.formulas.solve import ClosedSolution, SolvingStep
from modeler.formulas.thresholds import THRESHOLDS
from modeler.robot import Robot, suggest_name


@dataclass(frozen=True, eq=False)
class DerivedValue:
    """Physical parameters with values.

    Attributes:
        letters: in the order of the steps.
        values: (n,) SI units.
        sigmas: (n,) standard deviations, to first order.
        inputs: names of data, then of known parameters.
        slopes: (n, inputs) d letter / d input.
        shares: (n, inputs) part of the variance that the uncertainty of each input brings;
            correlated data share their covariance by halves, so rows add up to 1.
        doubtful: {letter: why its quotient may be one by zero}.
    """

    letters: tuple[str, ...]
    values: np.ndarray
    sigmas: np.ndarray
    inputs: tuple[str, ...]
    slopes: np.ndarray
    shares: np.ndarray
    doubtful: Mapping[str, str]

    def get_value(self, letter: str) -> float:
        """Returns the value of one parameter."""
        return float(self.values[self.letters.index(letter)])

    def get_sigma(self, letter: str) -> float:
        """Returns the standard deviation of one parameter."""
        return float(self.sigmas[self.letters.index(letter)])


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
        good += all(_is_satisfied(step, value, point[system.place[step.letter]], prime)
                    for step in solution.steps)  # fmt: skip
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


class NumericPolynomial:
    """Polynomials of a system as arrays: values and slopes quickly."""

    def __init__(self, poly: Poly) -> None:
        self.powers = np.array(list(poly), dtype=int).reshape(len(poly), poly.ring.ngens)
        self.factors = np.array([float(convert_to_fraction(value)) for value in poly.values()])

    def evaluate(self, point: np.ndarray) -> float:
        """Returns the value at a point of all generators."""
        return float(self.factors @ np.prod(point**self.powers, axis=1))

    def evaluate_slopes(self, point: np.ndarray) -> np.ndarray:
        """Returns (generators,) derivatives at a point."""
        slopes = np.zeros(len(point))
        for k in np.flatnonzero(self.powers.any(axis=0)):
            lower = self.powers.copy()
            lower[:, k] = np.maximum(lower[:, k] - 1, 0)
            terms = self.factors * self.powers[:, k] * np.prod(point**lower, axis=1)
            slopes[k] = terms.sum()
        return slopes


def derive_values(
    solution: ClosedSolution,
    data: Sequence[float],
    covariance: np.ndarray,
    known: Mapping[str, float],
    sigmas: Mapping[str, float] | None = None,
    near: Mapping[str, float] | None = None,
) -> DerivedValue:
    """Computes the parameters that follow, with their standard deviations.

    x = g(data, known); var x = G_d C G_d' + sum (G_k sigma_k)^2, G = dg along the steps.

    Args:
        solution: formulas.
        data: (data,) identified values, in the order of `solution.system.data`.
        covariance: (data, data) of them.
        known: values of the known parameters, SI units.
        sigmas: their standard deviations, 0 where not given; all errors are independent.
        near: about what value a parameter has, to choose between roots.

    Raises:
        DataError: a quotient by exactly 0, or an equation without a root or with several.
    """
    system = solution.system
    inputs = (*system.data, *solution.known)
    spread = [(sigmas or {}).get(name, 0.0) ** 2 for name in solution.known]
    C = np.diag([0.0] * len(data) + spread)
    C[: len(data), : len(data)] = covariance
    # Values of all generators before the first step, and their slopes by the inputs.
    point = system.build_point(known)
    point[: len(data)] = data
    gradient = np.zeros((len(point), len(inputs)))
    for i, name in enumerate(inputs):
        gradient[system.place[name], i] = 1.0
    doubtful: dict[str, str] = {}
    for step in solution.steps:
        _evaluate_step(step, solution, point, gradient, C, doubtful, near or {})
    at = [system.place[letter] for letter in solution.solved_letters]
    slopes = gradient[at]
    parts = slopes * (slopes @ C)
    variance = np.maximum(parts.sum(axis=1), 0.0)
    shares = np.divide(
        parts, variance[:, None], out=np.zeros_like(parts), where=variance[:, None] > 0
    )
    return DerivedValue(
        solution.solved_letters, point[at], np.sqrt(variance), inputs, slopes, shares, doubtful
    )


def find_impossible(derived: DerivedValue, system: PhysicalSystem) -> dict[str, str]:
    """Tells which values no body can have: a mass not above 0, a moment of inertia below 0.

    A moment may be 0; it is told if it is below by more than 3 sigma.
    """
    kinds = {}
    for k, letter in enumerate(derived.letters):
        value, sigma = derived.values[k], derived.sigmas[k]
        if letter in system.masses and value <= 0.0:
            kinds[letter] = "mass"
        elif letter in system.moments and value < -THRESHOLDS.sure_sigmas * sigma:
            kinds[letter] = "moment of inertia"
    return {
        letter: f"{letter} = {derived.get_value(letter):.4g} "
        f"+- {derived.get_sigma(letter):.2g} is no "
        f"{what}: a known value or the fit is wrong, or the fit is not sure enough"
        for letter, what in kinds.items()
    }


def _evaluate_step(
    step: SolvingStep, solution: ClosedSolution, point: np.ndarray, gradient: np.ndarray,
    C: np.ndarray, doubtful: dict[str, str], near: Mapping[str, float],
) -> None:  # fmt: skip
    """One step more: value and slopes of its letter."""
    system = solution.system
    at = system.place[step.letter]
    if step.equation is not None:
        point[at] = _select_root(step, system, point, near)
        slopes = NumericPolynomial(step.equation).evaluate_slopes(point)
        letter_slope, slopes[at] = slopes[at], 0.0
        gradient[at] = -(slopes @ gradient) / letter_slope
        return
    up, down = NumericPolynomial(step.numerator), NumericPolynomial(step.denominator)
    bottom = down.evaluate(point)
    if bottom == 0.0:
        raise DataError(
            f"{system.robot}: {step.letter} is a quotient by {step.denominator}, which is 0 in "
            f"this fit; {step.letter} cannot be told, add it to the known parameters"
        )
    spread = down.evaluate_slopes(point) @ gradient
    sigma = float(np.sqrt(max(spread @ C @ spread, 0.0)))
    if abs(bottom) < THRESHOLDS.sure_sigmas * sigma:
        doubtful[step.letter] = (
            f"{step.letter} is a quotient by {step.denominator} = {bottom:.3g} +- {sigma:.2g}, "
            "which may be 0: these data do not tell it"
        )
    point[at] = up.evaluate(point) / bottom
    slopes = (up.evaluate_slopes(point) - point[at] * down.evaluate_slopes(point)) / bottom
    gradient[at] = slopes @ gradient


def find_roots(step: SolvingStep, system: PhysicalSystem, point: np.ndarray) -> list[float]:
    """Returns the real roots of a step's equation at a point; only positive ones for a mass."""
    assert step.equation is not None
    parts = collect_powers(step.equation, system.place[step.letter])
    factors = [
        NumericPolynomial(parts[k]).evaluate(point) if k in parts else 0.0
        for k in range(max(parts), -1, -1)
    ]
    complex_roots = np.roots(factors)
    real = [float(x.real) for x in complex_roots if abs(x.imag) <= THRESHOLDS.real_root * abs(x)]
    return sorted(x for x in real if x > 0 or step.letter not in system.masses)


def _select_root(
    step: SolvingStep, system: PhysicalSystem, point: np.ndarray, near: Mapping[str, float]
) -> float:
    real_roots = find_roots(step, system, point)
    if real_roots and step.letter in near:
        return min(real_roots, key=lambda x: abs(x - near[step.letter]))
    if len(real_roots) == 1:
        return real_roots[0]
    kind = "positive " if step.letter in system.masses else ""
    if not real_roots:
        raise DataError(
            f"{system.robot}: the equation of {step.letter} has no {kind}root with these values; "
            "a known value or the fit is wrong"
        )
    root_list = ", ".join(f"{x:.6g}" for x in real_roots)
    raise DataError(
        f"{system.robot}: the equation of {step.letter} has {len(real_roots)} {kind}roots "
        f"({root_list}); "
        f"each fits the data; say which with --near {step.letter}={real_roots[-1]:.3g}, or add a "
        "parameter to the known ones"
    )


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
    return KnownValues(
        effective,
        {name: values[name] for name in effective if name in values},
        {name: sigmas[name] for name in effective if name in sigmas},
    )


def check_symbol(name: str, system: PhysicalSystem, where: str) -> None:
    """Refuses what is no physical parameter or length of the robot.

    Raises:
        RobotError: tells what it may have meant.
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
    return KnownValues(
        tuple(effective_names),
        {name: values[name] for name in effective_names},
        {name: sigmas[name] for name in effective_names if sigmas.get(name, 0.0) > 0.0},
    )


# Which sufficing set of known parameters lets errors grow least.


@dataclass(frozen=True)
class RatedSet:
    """How errors grow with one set of known parameters.

    Attributes:
        known: the set.
        middle: median over the parameters that follow: per cent of error, root mean square, for
            independent errors of 1 % in every identified quantity and every known parameter.
        worst: the largest.
        letter: whose that is.
    """

    known: tuple[str, ...]
    middle: float
    worst: float
    letter: str


def rate_sets(
    system: PhysicalSystem, sets: Sequence[Sequence[str]], values: Mapping[str, float]
) -> tuple[RatedSet, ...]:
    """Rates the sets by how little errors grow at one robot, the least median first.

    dU = J_U^-1 (dd - J_K dK), d data, U unknowns, K known; parameters that are 0 have no per cent.

    Args:
        system: data as polynomials of the parameters.
        sets: smallest sufficing sets.
        values: of all parameters, SI units; sets that fail there are left out.
    """
    point = system.build_point(values)
    polys = [NumericPolynomial(system.definitions[d]) for d in system.data]
    J = np.array([poly.evaluate_slopes(point) for poly in polys])
    data = np.array([poly.evaluate(point) for poly in polys])
    ratings = []
    for known in sets:
        U = [system.place[x] for x in system.letters if x not in known]
        K = [system.place[x] for x in known]
        inner = J[:, U]
        if inner.shape[0] != inner.shape[1] or np.linalg.matrix_rank(inner) < len(U):
            continue
        G = np.linalg.solve(inner, np.hstack([np.diag(data), -J[:, K] * point[K]]))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.linalg.norm(G, axis=1) / np.abs(point[U])
        share[~np.isfinite(share)] = np.nan
        k = int(np.nanargmax(share))
        middle, letter = float(np.nanmedian(share)), system.names[U[k]]
        ratings.append(RatedSet(tuple(known), middle, float(share[k]), letter))
    return tuple(sorted(ratings, key=lambda r: (r.middle, r.worst)))
