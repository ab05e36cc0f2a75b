"""Physical parameters: which follow from which, their values from a fit, a fit against CAD."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from modeler.codegen import Derivation, derive
from modeler.core.errors import DataError, ModelerError
from modeler.core.options import OptionError
from modeler.core.result import Presentation, Result, register_presentations
from modeler.core.table import Table, format_percent
from modeler.estimation import IdentifiedModel
from modeler.formulas import (
    THRESHOLDS,
    CadComparison,
    ClosedSolution,
    DerivedValue,
    KnownAgainstFit,
    KnownSets,
    KnownValues,
    PhysicalSystem,
    RatedSet,
    build_physical_system,
    check_known,
    compare_cad,
    count_smallest_set,
    derive_values,
    find_easiest_set,
    find_impossible,
    find_known_sets,
    parse_known_values,
    rate_sets,
    read_cad_example,
    read_cad_file,
    solve,
    verify_solution,
)
from modeler.robot import Robot, parse_robot_text

UNITS = {
    "mass": "kg", "length": "m", "centre": "m", "inertia": "kg m^2", "rotor inertia": "kg m^2",
}  # fmt: skip
"""Of a parameter of that kind."""

NOMINAL = ""
"""In place of a CAD file: the values of the robot file."""


Source = Literal["base", "coefficients"]


@dataclass(frozen=True, eq=False)
class FittedSource:
    """Identified quantities of a model.

    Attributes:
        data: (data,) values.
        covariance: (data, data).
        aside: {quantity: why it has no value}.
    """

    data: np.ndarray
    covariance: np.ndarray
    unidentified: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class PhysicalValues(Result):
    """Physical parameters of a model.

    Attributes:
        system: they, and the identified quantities.
        derived: values, sigmas, and from what they follow.
        doubts: {parameter: why it is not reported}.
        tested: known parameters against what the others and the fit say, where more are known than
            needed.
    """

    system: PhysicalSystem
    derived: DerivedValue
    doubts: Mapping[str, str]
    tested: tuple[KnownAgainstFit, ...]

    def describe_sources(self, k: int) -> str:
        """Describes the main sources of the variance of parameter k, "ZZ2R 80 %, am 15 %"."""
        shares = self.derived.shares[k]
        return ", ".join(
            f"{self.derived.inputs[i]} {format_percent(shares[i])}"
            for i in np.argsort(-shares)[:2]
            if shares[i] > 0.05
        )

    def require_consistent(self) -> None:
        """Raises an error if a known parameter contradicts the fit."""
        wrong = sorted(
            (row for row in self.tested if row.is_contradictory), key=lambda r: -abs(r.z)
        )
        if wrong:
            contradictions = "; ".join(
                f"{r.letter} = {r.known_value:g} given, {r.implied_value:.6g} +- "
                f"{r.implied_sigma:.2g} follows ({abs(r.z):.1f} sigma)"
                for r in wrong
            )
            raise OptionError(
                f"{{--known}} contradicts the fit: {contradictions}; measure these again, or leave "
                "one of them out"
            )


@dataclass(frozen=True, eq=False)
class Physical(Result):
    """What is known of the physical parameters of a robot (docs/how-to/physical-parameters.md).

    Attributes:
        system: identified quantities as polynomials of the parameters.
        derivation: of the robot.
        fitted: values of the quantities; None for a robot.
    """

    system: PhysicalSystem
    derivation: Derivation
    fitted: FittedSource | None

    def derive_formulas(self, known: str | KnownValues) -> ClosedSolution:
        """Derives the other parameters in closed form, verified exactly on random robots.

        Args:
            known: names, as "am,bm".

        Raises:
            RobotError: a name that is none.
        """
        known_values = (
            parse_known_values(known, self.system, "known") if isinstance(known, str) else known
        )
        solution = solve(self.system, known_values.names)
        good = verify_solution(solution)
        if good != THRESHOLDS.verified_robots:
            raise ModelerError(
                f"{self.system.robot}: the formulas failed {THRESHOLDS.verified_robots - good} of "
                f"{THRESHOLDS.verified_robots} exact checks; please report these known parameters"
            )
        return solution

    def compute_values(self, known: str, near: str = "") -> PhysicalValues:
        """Computes the other parameters from the fit; `table()` lists them.

        Args:
            known: values, as "am=12,bm=6+-0.1", SI units.
            near: chooses between roots, as "M2=3".

        Raises:
            DataError: of a robot, or a known parameter without a value.
            RobotError: a name that is none.
        """
        known_values = parse_known_values(known, self.system, "known")
        self.check_known(known_values, near)
        hints = parse_known_values(near, self.system, "near")
        return self.evaluate_solution(
            self.derive_formulas(known_values), known_values, hints.values
        )

    def check_known(self, known: KnownValues, near: str | None) -> None:
        """Raises an error unless a model has values of all that is known, and a robot none."""
        if self.fitted is None and (known.values or near):
            option = "{--known}" if known.values else "{--near}"
            raise OptionError(
                f"{option}: got values, but {self.system.robot} is a robot without identified "
                "ones; expected names alone, as am,bm, or a model file of `modeler fit`"
            )
        missing = [name for name in known.names if name not in known.values]
        if self.fitted is not None and missing:
            raise OptionError(
                f"{{--known}}: no value of {', '.join(missing)}; expected {missing[0]}=VALUE, SI "
                "units, for every known parameter of a model"
            )

    def evaluate_solution(
        self, solution: ClosedSolution, known_values: KnownValues, near: Mapping[str, float]
    ) -> PhysicalValues:
        """Evaluates closed-form formulas with the values of the fit."""
        fitted = self._require_fitted()
        data = fitted.data.tolist()
        derived = derive_values(
            solution, data, fitted.covariance, known_values.values, known_values.sigmas, near
        )
        doubts = dict(derived.doubtful)
        for k, letter in enumerate(derived.letters):
            for name, why in fitted.unidentified.items():
                if derived.slopes[k, derived.inputs.index(name)] != 0.0:
                    doubts[letter] = f"{letter} needs {name}, and {why}"
        doubts |= find_impossible(derived, self.system)
        tested = check_known(
            solution, data, fitted.covariance, known_values.values, known_values.sigmas
        )
        return PhysicalValues(self.system, derived, doubts, tuple(tested))

    def find_known_sets(
        self, size: int | None = None, progress: Callable[[float], None] | None = None
    ) -> KnownSets:
        """Finds all sets of `size` parameters that determine the others; None: the smallest."""
        if size is not None and size < 1:
            raise OptionError(
                f"{{--sets}}: got {size}; expected 1 or more, or {{--sets}} alone for the smallest"
            )
        return find_known_sets(self.system, size, progress or (lambda share: None))

    def rank_sets(self, candidate_sets: KnownSets, cad: KnownValues) -> tuple[RatedSet, ...]:
        """Ranks the easiest of these sets by their error.

        Raises:
            DataError: a parameter without a CAD value.
        """
        missing = [x for x in self.system.letters if x not in cad.values]
        if missing:
            raise OptionError(
                f"{{--cad}}: no value of {', '.join(missing)}; expected all parameters"
            )
        return rate_sets(self.system, candidate_sets.easiest_sets, cad.values)

    def read_cad(self, file: str | Path = NOMINAL) -> KnownValues:
        """Reads CAD values from a file; without one from the robot file."""
        if str(file) != NOMINAL:
            return read_cad_file(Path(file), self.system)
        robot = self.derivation.robot
        return read_cad_example(robot, self.system, f"--cad, robot {self.system.robot}")

    def compare_with_cad(self, cad: KnownValues | str | Path = NOMINAL) -> CadComparison:
        """Compares the identified quantities with CAD values.

        Raises:
            DataError: of a robot.
        """
        cad_values = cad if isinstance(cad, KnownValues) else self.read_cad(cad)
        fitted = self._require_fitted("{--cad}: ")
        return compare_cad(
            self.system,
            fitted.data.tolist(),
            fitted.covariance,
            cad_values.values,
            cad_values.sigmas,
            fitted.unidentified,
        )

    def __reduce__(self) -> tuple[Any, ...]:
        """Found anew where it lands: rings of polynomials do not travel."""
        return _rebuild_physical, (self.derivation, self.system.source, self.fitted)

    def _require_fitted(self, where: str = "") -> FittedSource:
        if self.fitted is None:
            raise OptionError(
                f"{where}{self.system.robot} is a robot, with no identified values; expected a "
                "model of `modeler fit`"
            )
        return self.fitted


def physical(thing: Robot | Derivation | IdentifiedModel, of: Source | None = None) -> Physical:
    """Returns the physical parameters of a robot, or of a model with values.

    >>> physical(load("wrist")).system.letters[:3]
    ('am', 'at2', 'at3')

    Args:
        thing: it.
        of: what is identified: "base" or "coefficients"; None: see `build_physical_system`.

    Raises:
        DataError: a model that lacks a base parameter.
    """
    model = thing if isinstance(thing, IdentifiedModel) else None
    if isinstance(thing, IdentifiedModel):
        thing = parse_robot_text(thing.robot_text, f"model of {thing.spec.robot}, robot_text")
    derivation = derive(thing) if isinstance(thing, Robot) else thing
    system = build_physical_system(derivation.model, derivation.base, of)
    return Physical(
        system, derivation, None if model is None else _compute_fitted_source(system, model)
    )


def _rebuild_physical(derivation: Derivation, of: Source, fitted: FittedSource | None) -> Physical:
    return Physical(
        build_physical_system(derivation.model, derivation.base, of), derivation, fitted
    )


def _compute_fitted_source(system: PhysicalSystem, model: IdentifiedModel) -> FittedSource:
    """data = T beta, C = T C_beta T'."""
    names = [parameter.name for parameter in model.fit.parameters]
    missing = [name for name in system.base if name not in names]
    if missing:
        raise DataError(
            f"the model has no value of {', '.join(missing)}; it was fitted by another version: "
            "fit it again"
        )
    at = [names.index(name) for name in system.base]
    T = system.to_data
    aside = [k for k, i in enumerate(at) if model.fit.parameters[i].sigma is None]
    why: dict[str, str] = {}
    for i, name in enumerate(system.data):
        fixed_parameters = [system.base[k] for k in aside if T[i, k] != 0.0]
        if fixed_parameters:
            why[name] = f"the fit set {', '.join(fixed_parameters)} aside"
    return FittedSource(T @ model.beta[at], T @ model.covariance[np.ix_(at, at)] @ T.T, why)


def tabulate_values(values: PhysicalValues) -> Table:
    """Returns the table of value, sigma and source of every parameter."""
    derived, doubts, rows = values.derived, values.doubts, []
    for k, letter in enumerate(derived.letters):
        unit, is_identified = UNITS[values.system.kinds[letter]], letter not in doubts
        value, sigma = float(derived.values[k]), float(derived.sigmas[k])
        cells = (value, sigma, unit, values.describe_sources(k))
        rows.append((letter, *(cells if is_identified else (None, None, unit, doubts[letter]))))
    title = f"{values.system.robot}: physical parameters"
    return Table.build(title, "parameter, value, sigma, unit, mostly from", rows)


def _summarise_values(values: PhysicalValues) -> str:
    identified_count = len(values.derived.letters) - len(values.doubts)
    first = (
        f"{values.system.robot}: {identified_count} of {len(values.derived.letters)} "
        "physical parameters determined"
    )
    return "\n".join([first, *values.doubts.values()])


def _summarise_parameters(parameters: Physical) -> str:
    system, easiest = parameters.system, find_easiest_set(parameters.system)
    return (
        f"{system.robot}: {len(system.data)} identified quantities, {len(system.letters)} "
        f"physical parameters with an effect\nat least {count_smallest_set(system)} must be known "
        f"that all others follow: {','.join(easiest)}"
    )


def _tabulate_symbols(parameters: Physical) -> Table:
    system = parameters.system
    rows = [(x, system.kinds[x], UNITS[system.kinds[x]]) for x in system.letters]
    return Table.build(f"{system.robot}: physical parameters", "parameter, kind, unit", rows)


_OF_VALUES = Presentation(
    "a set of physical parameters",
    _summarise_values,
    lambda values: {"values": lambda: tabulate_values(values)},
)
_OF_SYMBOLS = Presentation(
    "a system of physical parameters",
    _summarise_parameters,
    lambda parameters: {"parameters": lambda: _tabulate_symbols(parameters)},
)
register_presentations({PhysicalValues: _OF_VALUES, Physical: _OF_SYMBOLS})
