"""Physical parameters in closed form: given which are known, which others follow, and how.

Elimination over Q: a quantity with one unknown gives it; where none is left, an unknown that
stands linearly in a quantity is taken out of the others. A factor that is zero, or that cannot be
zero, is recognised by its value at a consistent random point modulo a prime: so no quotient is 0/0.
"""

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from modeler.core.errors import DataError, ModelerError
from modeler.core.formula import DisplayedEquation, escape_latex, format_display, format_latex_name
from modeler.derivation import collect_powers, evaluate_modulo
from modeler.formulas.physical_system import NumericPolynomial, PhysicalSystem
from modeler.formulas.ring import (
    LATEX,
    TEXT,
    Poly,
    TextStyle,
    find_independent_modulo,
    find_places,
    format_physical,
    format_polynomial,
)
from modeler.formulas.sufficient_sets import EASE
from modeler.formulas.thresholds import THRESHOLDS

_EASY = ("mass", "length", "centre", "inertia", "rotor inertia")


@dataclass(frozen=True)
class SolvingStep:
    """One parameter that follows.

    Attributes:
        letter: its name.
        numerator, denominator: letter = numerator / denominator, polynomials of data, constants,
            known letters and letters of earlier steps.
        equation: a polynomial of degree 2 or more in the letter that is zero, where there is no
            quotient; None otherwise.
    """

    letter: str
    numerator: Poly
    denominator: Poly
    equation: Poly | None = None


@dataclass(frozen=True)
class ClosedSolution:
    """What follows from the data and the known parameters.

    Attributes:
        system: data and parameters.
        known: parameters that are given.
        steps: in an order in which each can be computed.
        undetermined: parameters that do not follow: adding any one of them to the known ones makes
            `missing` one less.
        without_formula: parameters that the data determine, in equations that were not brought to
            one unknown.
        missing: how many parameters more must be known that all follow.
        surplus: number of relations that known parameters and data must satisfy by themselves.
    """

    system: PhysicalSystem
    known: tuple[str, ...]
    steps: tuple[SolvingStep, ...]
    undetermined: tuple[str, ...]
    without_formula: tuple[str, ...]
    missing: int
    surplus: int

    @property
    def solved_letters(self) -> tuple[str, ...]:
        """Returns parameters with a formula, in order."""
        return tuple(step.letter for step in self.steps)


def find_determined(
    system: PhysicalSystem, known: Iterable[str], seed: int = THRESHOLDS.seed
) -> tuple[list[str], int]:
    """Returns the parameters that the data determine generically, and the Jacobian's rank.

    An unknown x follows if its column of d data / d unknowns is no combination of the others.
    """
    known_letters = set(known)
    unknown = [x for x in system.letters if x not in known_letters]
    prime, columns = system.compute_jacobian_modulo(random.Random(seed))
    vectors = [columns[x] for x in unknown]
    rank = len(find_independent_modulo(vectors, prime))
    if rank == len(unknown):
        return unknown, rank
    determined_letters = []
    for i, x in enumerate(unknown):
        others = vectors[:i] + vectors[i + 1 :]
        if len(find_independent_modulo(others, prime)) < rank:
            determined_letters.append(x)
    return determined_letters, rank


def solve(
    system: PhysicalSystem, known: Iterable[str], seed: int = THRESHOLDS.seed
) -> ClosedSolution:
    """Solves for the parameters that follow from data and known parameters, in closed form.

    Args:
        system: data as polynomials of the parameters.
        known: names of parameters of it.
        seed: of the random points.
    """
    known_letters = tuple(x for x in system.letters if x in set(known))
    follow, rank = find_determined(system, known_letters, seed)
    unknown = [x for x in system.letters if x not in known_letters]
    steps = _Elimination(system, unknown, follow, random.Random(seed)).run()
    have = {step.letter for step in steps}
    free, surplus = len(unknown) - rank, len(system.data) - rank
    undetermined = tuple(x for x in unknown if x not in follow)
    without = tuple(x for x in follow if x not in have)
    return ClosedSolution(system, known_letters, tuple(steps), undetermined, without, free, surplus)


class _Elimination:
    """Unknowns get formulas one by one; each has the equations as defined to begin with.

    An unknown with a formula counts as known for the others: so formulas stay short.
    """

    def __init__(
        self,
        system: PhysicalSystem,
        unknown: Sequence[str],
        follow: Sequence[str],
        chance: random.Random,
    ) -> None:
        self.system = system
        self.place = system.place
        self.prime, self.point = system.draw_modular_point(chance)
        gens = system.ring.gens
        self.defined = [p - gens[self.place[d]] for d, p in system.definitions.items()]
        self.equations = self.defined
        self.open, self.wanted = set(unknown), set(follow)

    def run(self) -> list[SolvingStep]:
        """Runs the elimination, and returns its steps in order."""
        steps: list[SolvingStep] = []
        while self.wanted:
            step = self._solve_directly(self.wanted) or self._solve_from_several()
            if step is None:
                break
            steps.append(step)
            self.open.discard(step.letter)
            self.wanted.discard(step.letter)
        return steps

    def _solve_from_several(self) -> SolvingStep | None:
        """The unknown that the fewest equations determine, by elimination in these."""
        unsolved = set(self.open)
        for letter, needed in self._find_needed_equations():
            self.equations, self.open = [self.defined[i] for i in needed], set(unsolved)
            step = self._solve_directly({letter})
            while step is None and self._eliminate_unknown(letter):
                step = self._solve_directly({letter})
            step = step or self._find_root_equation(letter)
            self.equations, self.open = self.defined, set(unsolved)
            if step is not None:
                return step
        return None

    def _find_needed_equations(self) -> list[tuple[str, list[int]]]:
        """(letter, equations that determine it, none of them too many), the fewest first.

        They determine x if the unit vector of x is a combination of their rows of the Jacobian.
        """
        letters = [x for x in self.system.letters if x in self.open]
        columns = [self.system.slopes[x] for x in letters]
        places = range(len(self.defined))
        entries = ({k: c[i] for k, c in enumerate(columns) if c[i]} for i in places)
        rows = [
            {k: evaluate_modulo(p, self.point, self.prime) for k, p in line.items()}
            for line in entries
        ]
        order = sorted(range(len(rows)), key=lambda i: -len(self.defined[i]))
        candidates = []
        for letter in sorted(self.wanted):
            at = letters.index(letter)
            keep = [i for i in order if rows[i]]
            for i in list(keep):
                fewer = [k for k in keep if k != i]
                # Is the unit vector of that place a combination of the fewer rows?
                left = [rows[k] for k in fewer]
                ranks = (find_independent_modulo(r, self.prime) for r in (left, [*left, {at: 1}]))
                if len({len(rank) for rank in ranks}) == 1:
                    keep = fewer
            kind = _EASY.index(self.system.kinds[letter])
            candidates.append((len(keep), kind, letter, sorted(keep)))
        return [(letter, keep) for _, _, letter, keep in sorted(candidates)]

    def _find_unknowns(self, poly: Poly) -> set[str]:
        """Unknowns in it that have no formula yet."""
        return {self.system.names[i] for i in find_places(poly)} & self.open

    def _is_zero(self, poly: Poly) -> bool:
        """Is it zero for every robot, as far as a consistent random point shows?"""
        return evaluate_modulo(poly, self.point, self.prime) == 0

    def _solve_directly(self, wanted: set[str]) -> SolvingStep | None:
        """A quotient for an unknown that stands alone in an equation, the shortest first."""
        for poly in sorted(self.equations, key=len):
            letters = self._find_unknowns(poly)
            if len(letters) == 1 and letters <= wanted:
                step = self._derive_quotient(poly, next(iter(letters)))
                if step is not None:
                    return step
        return None

    def _find_root_equation(self, letter: str) -> SolvingStep | None:
        """A polynomial of the one unknown, of the lowest degree."""
        alone = [p for p in self.equations if self._find_unknowns(p) == {letter}]
        if not alone:
            return None
        ring = self.system.ring
        best = min(alone, key=lambda p: (_get_degree(p, self.place[letter]), len(p)))
        return SolvingStep(letter, ring.zero, ring.one, best)

    def _derive_quotient(self, poly: Poly, letter: str) -> SolvingStep | None:
        """The letter from a linear equation; None if it is not linear or determines nothing."""
        place = self.place[letter]
        if _get_degree(poly, place) != 1:
            return None
        parts, ring = collect_powers(poly, place), poly.ring
        rest, slope = parts.get(0, ring.zero), parts[1]
        if self._is_zero(slope):
            return None
        if slope.is_ground:
            return SolvingStep(letter, (-rest).quo_ground(slope.LC), ring.one)
        # In lowest terms, the denominator with whole numbers and a positive lead.
        _, top, bottom = (-rest).cofactors(slope) if rest else (slope, rest, ring.one)
        content, bottom = bottom.primitive()
        if bottom.LC < 0:
            content, bottom = -content, -bottom
        return SolvingStep(letter, top.quo_ground(content), bottom)

    def _eliminate_unknown(self, wanted: str) -> bool:
        """Take an unknown out of all equations but one, where that is linear in it."""
        choices = []
        for at, poly in enumerate(self.equations):
            letters = self._find_unknowns(poly)
            for letter in letters - {wanted}:
                if _get_degree(poly, self.place[letter]) == 1:
                    choices.append((self._estimate_cost(poly, letter), at, letter))
        for _, at, letter in sorted(choices):
            step = self._derive_quotient(self.equations[at], letter)
            if step is None:
                continue
            others = self.equations[:at] + self.equations[at + 1 :]
            self.open.discard(letter)
            self.equations = [self._insert_step(poly, step) for poly in others]
            self.equations = [poly for poly in self.equations if poly]
            return all(len(poly) <= THRESHOLDS.max_factored_terms for poly in self.equations)
        return False

    def _estimate_cost(self, poly: Poly, letter: str) -> tuple[int, ...]:
        """Small for what is quickly done: few other unknowns, few other places."""
        place = self.place[letter]
        slope = collect_powers(poly, place)[1]
        return (
            len(self._find_unknowns(poly)),
            len(self._find_unknowns(slope)),
            sum(_get_degree(other, place) for other in self.equations),
            -_EASY.index(self.system.kinds[letter]),
            len(poly),
        )

    def _insert_step(self, poly: Poly, step: SolvingStep) -> Poly:
        """The equation with the step put in, and only its factor that is zero."""
        place = self.place[step.letter]
        top = _get_degree(poly, place)
        if top == 0:
            return poly
        total = poly.ring.zero
        for degree, part in collect_powers(poly, place).items():
            total += part * step.numerator**degree * step.denominator ** (top - degree)
        total = self.system.normalise_polynomial(total)
        if not self._find_unknowns(total):
            return poly.ring.zero
        if len(total) > THRESHOLDS.max_factored_terms:
            return total
        for factor, _ in total.factor_list()[1]:
            if self._is_zero(factor):
                return factor
        raise ModelerError(
            f"{self.system.robot}: no factor of {total} is zero at a random point; another seed"
        )


def _get_degree(poly: Poly, place: int) -> int:
    return max((at[place] for at in poly), default=0)


# A closed solution as text, LaTeX and Python, in an order that a person can check.


SolutionForm = Literal["text", "latex", "python"]
"""How formulas are printed."""


def format_formula(step: SolvingStep, system: PhysicalSystem, style: TextStyle = TEXT) -> str:
    """Returns the right side of a step's formula, else the polynomial that is zero."""
    if step.equation is not None:
        parts = []
        factors = collect_powers(step.equation, system.place[step.letter]).items()
        for power, factor in sorted(factors):
            text = format_polynomial(factor, system.names, style)
            if power:
                text = (
                    style.add_brackets(text) + style.times + style.format_power(step.letter, power)
                )
            parts.append(text)
        return " + ".join(reversed(parts))
    top = format_physical(step.numerator, system.names, system.masses, style)
    if step.denominator == system.ring.one:
        return top
    bottom = format_physical(step.denominator, system.names, system.masses, style)
    if style.latex:
        return rf"\frac{{{top}}}{{{bottom}}}"
    return f"{_add_brackets(top)}/{_add_brackets(bottom, factors=True)}"


def _add_brackets(text: str, factors: bool = False) -> str:
    """In brackets if it is a sum, or, below a line, a product."""
    inside = text.removeprefix("-")
    plain = " + " not in inside and " - " not in inside
    if plain and not (factors and any(sign in text for sign in "*/-")):
        return text
    return f"({text})"


def format_solution_lines(solution: ClosedSolution, form: SolutionForm = "text") -> list[str]:
    """Returns all formulas, one a line, each from data, known parameters and those before."""
    return {"text": _format_text, "latex": _format_latex, "python": _format_python}[form](solution)


def _format_text(solution: ClosedSolution) -> list[str]:
    system = solution.system
    lines = [f"{name} = {text}" for name, text in system.abbreviations.items()]
    for step in solution.steps:
        right = format_formula(step, system)
        if step.equation is None:
            lines.append(f"{step.letter} = {right}")
        else:
            lines.append(f"{step.letter}: root of {right} = 0")
    return lines


def _format_latex(solution: ClosedSolution) -> list[str]:
    system = solution.system
    rows = []
    for name, text in system.abbreviations.items():
        right = rf"\text{{{escape_latex(text)}}}"
        if name in system.inverse:
            below = format_polynomial(system.inverse[name], system.names, LATEX)
            right = rf"\frac{{1}}{{{below}}}"
        rows.append(DisplayedEquation(format_latex_name(name), (right,)))
    for step in solution.steps:
        left = format_latex_name(step.letter) if step.equation is None else "0"
        rows.append(DisplayedEquation(left, (format_formula(step, system, LATEX),)))
    lines = format_display(rows).splitlines() if rows else []
    return [r"\begingroup\allowdisplaybreaks", *lines, r"\endgroup"]


_ROOTS = """def real_roots(factors, positive=False):
    found = [x for x in roots(factors) if abs(x.imag) <= 1e-6*abs(x)]
    return [float(x.real) for x in found if x.real > 0 or not positive]"""


def _format_python(solution: ClosedSolution) -> list[str]:
    """A function of data and known parameters that returns a dict, with roots a list of them."""
    system = solution.system
    rooted = any(step.equation is not None for step in solution.steps)
    polys = [p for s in solution.steps for p in (s.numerator, s.denominator, s.equation) if p]
    read = find_places(*polys)
    data = [name for name in system.data if system.place[name] in read]
    sources = (*system.constants, *system.abbreviations.values())
    symbols = (w for text in sources for w in _extract_symbols(text))
    made_of = [w for w in symbols if w not in system.abbreviations]
    arguments = [*data, *solution.known, *dict.fromkeys(made_of)]
    where = "base parameters" if system.source == "base" else "coefficients PG, PJ"
    more = ": a list, every robot that fits" if rooted else ""
    lines = [f"def physical_parameters({', '.join(arguments)}):"]
    lines += [f'    """Physical parameters of {system.robot} from {where}, SI units{more}."""']
    lines += [f"    {name} = {text}" for name, text in system.abbreviations.items()]
    lines += ["    found = []"] if rooted else []
    indent = "    "
    for step in solution.steps:
        if step.equation is None:
            lines.append(f"{indent}{step.letter} = {format_formula(step, system)}")
        else:
            factors = collect_powers(step.equation, system.place[step.letter])
            parts = (factors.get(k, system.ring.zero) for k in range(max(factors), -1, -1))
            texts = (format_polynomial(part, system.names) for part in parts)
            positive = ", positive=True" if step.letter in system.masses else ""
            root_call = f"real_roots([{', '.join(texts)}]{positive})"
            lines.append(f"{indent}for {step.letter} in {root_call}:")
            indent += "    "
    result_text = "{" + ", ".join(f'"{x}": {x}' for x in solution.solved_letters) + "}"
    if rooted:
        lines += [f"{indent}found.append({result_text})", "    return found"]
    else:
        lines.append(f"    return {result_text}")
    used = set(_extract_symbols("\n".join(lines), functions=True))
    some = [name for name in ("cos", "pi", "sin", "sqrt") if name in used]
    head = [f"from math import {', '.join(some)}"] if some else []
    head += ["from numpy import roots", "", "", _ROOTS] if rooted else []
    return [*head, "", "", *lines] if head else lines


def _extract_symbols(text: str, functions: bool = False) -> list[str]:
    """Names in a text, those of functions and of pi only if they are wanted."""
    word = "".join(c if c.isalnum() or c == "_" else " " for c in text).split()
    known = () if functions else ("cos", "sin", "sqrt", "pi")
    return [w for w in word if not w[0].isdigit() and w not in known]


def format_definition_lines(system: PhysicalSystem) -> list[str]:
    """Returns the data as polynomials of the parameters, one a line."""
    names, masses = system.names, system.masses
    items = system.definitions.items()
    return [f"{name} = {format_physical(poly, names, masses)}" for name, poly in items]


def format_missing_lines(solution: ClosedSolution) -> list[str]:
    """Returns what does not follow, and what to add; empty if all follows."""
    lines = []
    if solution.undetermined:
        easy = sorted(solution.undetermined, key=lambda x: EASE[solution.system.kinds[x]])
        lines = [
            f"undetermined: {', '.join(solution.undetermined)}",
            f"to determine them, {solution.missing} more must be known: one of "
            f"{', '.join(easy)} (easiest first)"
            + ("" if solution.missing == 1 else ", then one of those that are left"),
        ]
    if solution.without_formula:
        lines.append(
            f"determined, but in equations of high degree, without a formula: "
            f"{', '.join(solution.without_formula)}; add one of them to the known parameters"
        )
    return lines


def serialise_solution(solution: ClosedSolution, verified: Mapping[str, int] | None = None) -> Any:
    """Returns the JSON of a solution: formulas as text, known and undetermined parameters."""
    system = solution.system
    return {
        "robot": system.robot,
        "source": system.source,
        "coefficients": list(system.map_lines),
        "known_parameters": list(solution.known),
        "lengths": dict(system.constants),
        "abbreviations": dict(system.abbreviations),
        "formulas": [
            {
                "parameter": step.letter,
                "kind": system.kinds[step.letter],
                "quotient" if step.equation is None else "zero": format_formula(step, system),
            }
            for step in solution.steps
        ],
        "undetermined_parameters": list(solution.undetermined),
        "without_formula": list(solution.without_formula),
        "missing_count": solution.missing,
        "redundant_count": solution.surplus,
        "without_effect": list(system.vanishing),
        "verification": dict(verified) if verified else None,
    }


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
    doubts: dict[str, str] = {}
    for step in solution.steps:
        place = system.place[step.letter]
        if step.equation is not None:
            point[place] = _select_root(step, system, point, near or {})
            slopes = NumericPolynomial(step.equation).evaluate_slopes(point)
            letter_slope, slopes[place] = slopes[place], 0.0
            gradient[place] = -(slopes @ gradient) / letter_slope
        elif doubt := _evaluate_quotient(step, system, point, gradient, C):
            doubts[step.letter] = doubt
    at = [system.place[letter] for letter in solution.solved_letters]
    slopes = gradient[at]
    parts = slopes * (slopes @ C)
    variance = np.maximum(parts.sum(axis=1), 0.0)
    total = variance[:, None]
    shares = np.divide(parts, total, out=np.zeros_like(parts), where=total > 0)
    letters, sigmas_of = solution.solved_letters, np.sqrt(variance)
    return DerivedValue(letters, point[at], sigmas_of, inputs, slopes, shares, doubts)


def find_impossible(derived: DerivedValue, system: PhysicalSystem) -> dict[str, str]:
    """Returns which values no body can have: a mass not above 0, a moment of inertia below 0.

    A moment may be 0; it is reported if it is below by more than 3 sigma.
    """
    kinds = {}
    for k, letter in enumerate(derived.letters):
        value, sigma = derived.values[k], derived.sigmas[k]
        if letter in system.masses and value <= 0.0:
            kinds[letter] = "mass"
        elif letter in system.moments and value < -THRESHOLDS.sure_sigmas * sigma:
            kinds[letter] = "moment of inertia"
    why = "a known value or the fit is wrong, or the fit is too uncertain"
    values = {x: f"{derived.get_value(x):.4g} +- {derived.get_sigma(x):.2g}" for x in kinds}
    return {x: f"{x} = {values[x]} is not a possible {what}: {why}" for x, what in kinds.items()}


def _evaluate_quotient(
    step: SolvingStep,
    system: PhysicalSystem,
    point: np.ndarray,
    gradient: np.ndarray,
    C: np.ndarray,
) -> str:
    """Value and slopes of the letter of a step; why its quotient may be one by zero, or ""."""
    up, down = NumericPolynomial(step.numerator), NumericPolynomial(step.denominator)
    at, bottom = system.place[step.letter], down.evaluate(point)
    quotient = f"{step.letter} is a quotient by {step.denominator}"
    if bottom == 0.0:
        raise DataError(
            f"{system.robot}: {quotient}, which is 0 in this fit; {step.letter} is not "
            "identifiable here; add it to the known parameters"
        )
    spread = down.evaluate_slopes(point) @ gradient
    sigma = float(np.sqrt(max(spread @ C @ spread, 0.0)))
    point[at] = up.evaluate(point) / bottom
    slopes = (up.evaluate_slopes(point) - point[at] * down.evaluate_slopes(point)) / bottom
    gradient[at] = slopes @ gradient
    if abs(bottom) < THRESHOLDS.sure_sigmas * sigma:
        value = f"{bottom:.3g} +- {sigma:.2g}"
        return f"{quotient} = {value}, which may be 0: not identifiable from these data"
    return ""


def find_roots(step: SolvingStep, system: PhysicalSystem, point: np.ndarray) -> list[float]:
    """Returns the real roots of a step's equation at a point; only positive ones for a mass."""
    assert step.equation is not None
    parts = collect_powers(step.equation, system.place[step.letter])
    values = {k: NumericPolynomial(part).evaluate(point) for k, part in parts.items()}
    complex_roots = np.roots([values.get(k, 0.0) for k in range(max(parts), -1, -1)])
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
        f"({root_list}); each fits the data; choose one with "
        f"--near {step.letter}={real_roots[-1]:.3g}, or add a parameter to the known ones"
    )
