"""Physical parameters: which follow from which, their values from a fit, a fit against CAD."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from modeler.codegen import Derivation, derive
from modeler.core.errors import DataError, ModelerError
from modeler.core.result import Presentation, Presented, present
from modeler.core.table import Table, percent
from modeler.estimation import IdentifiedModel
from modeler.formulas import (
    VERIFIED,
    CadComparison,
    ClosedSolution,
    DerivedValue,
    KnownAgainstFit,
    KnownSets,
    KnownValues,
    PhysicalSystem,
    Rated,
    check_known,
    compare_cad,
    easiest_set,
    known_from_text,
    known_sets,
    physical_system,
    rated,
    smallest_number,
    solve,
    values as rules,
)
from modeler.robot import Robot, robot_from_text

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
    aside: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class PhysicalValues(Presented):
    """Physical parameters of a model.

    Attributes:
        system: they, and the identified quantities.
        derived: values, sigmas, and from what they follow.
        doubts: {parameter: why it is not told}.
        tested: known parameters against what the others and the fit say, where more are known than
            needed.
    """

    system: PhysicalSystem
    derived: DerivedValue
    doubts: Mapping[str, str]
    tested: tuple[KnownAgainstFit, ...]

    def sources(self, k: int) -> str:
        """From which the variance of parameter k mostly comes, "ZZ2R 80 %, am 15 %"."""
        shares = self.derived.shares[k]
        return ", ".join(
            f"{self.derived.inputs[i]} {percent(shares[i])}"
            for i in np.argsort(-shares)[:2]
            if shares[i] > 0.05
        )


@dataclass(frozen=True, eq=False)
class Physical(Presented):
    """What is known of the physical parameters of a robot (docs/how-to/physical-parameters.md).

    Attributes:
        system: identified quantities as polynomials of the parameters.
        derivation: of the robot.
        fitted: values of the quantities; None for a robot.
    """

    system: PhysicalSystem
    derivation: Derivation
    fitted: FittedSource | None

    def formulas(self, known: str | KnownValues) -> ClosedSolution:
        """The other parameters in closed form, checked exactly on random robots.

        Args:
            known: names, as "am,bm".

        Raises:
            RobotError: a name that is none.
        """
        given = known_from_text(known, self.system, "known") if isinstance(known, str) else known
        solution = solve(self.system, given.names)
        good = rules.verify(solution)
        if good != VERIFIED:
            raise ModelerError(
                f"{self.system.robot}: the formulas failed {VERIFIED - good} of {VERIFIED} exact "
                "checks; please report these known parameters"
            )
        return solution

    def values(self, known: str, near: str = "") -> PhysicalValues:
        """Values of the other parameters from the fit; their `table()` lists them.

        Args:
            known: values, as "am=12,bm=6+-0.1", SI units.
            near: chooses between roots, as "M2=3".

        Raises:
            DataError: of a robot, or a known parameter without a value.
            RobotError: a name that is none.
        """
        given = known_from_text(known, self.system, "known")
        for name in given.names:
            if name not in given.values:
                raise DataError(f"known: no value of {name}; expected {name}=VALUE, SI units")
        hints = known_from_text(near, self.system, "near")
        return self.solved(self.formulas(given), given, hints.values)

    def solved(
        self, solution: ClosedSolution, given: KnownValues, near: Mapping[str, float]
    ) -> PhysicalValues:
        """The values of formulas."""
        fitted = self._with_values()
        data = fitted.data.tolist()
        derived = rules.derive_values(
            solution, data, fitted.covariance, given.values, given.sigmas, near
        )
        doubts = dict(derived.doubtful)
        for k, letter in enumerate(derived.letters):
            for name, why in fitted.aside.items():
                if derived.slopes[k, derived.inputs.index(name)] != 0.0:
                    doubts[letter] = f"{letter} needs {name}, and {why}"
        doubts |= rules.impossible(derived, self.system)
        tested = check_known(solution, data, fitted.covariance, given.values, given.sigmas)
        return PhysicalValues(self.system, derived, doubts, tuple(tested))

    def sets(
        self, size: int | None = None, progress: Callable[[float], None] | None = None
    ) -> KnownSets:
        """All sets of `size` parameters from which the others follow; None: the smallest."""
        return known_sets(self.system, size, progress or (lambda share: None))

    def rated(self, found: KnownSets, cad: KnownValues) -> tuple[Rated, ...]:
        """The easiest of these sets, the least error first.

        Raises:
            DataError: a parameter without a CAD value.
        """
        missing = [x for x in self.system.letters if x not in cad.values]
        if missing:
            raise DataError(f"--cad: no value of {', '.join(missing)}; expected all parameters")
        return rated(self.system, found.easiest, cad.values)

    def cad(self, file: str | Path = NOMINAL) -> KnownValues:
        """CAD values from a file, or, without one, those that the robot file states."""
        if str(file) != NOMINAL:
            return rules.cad_from_file(Path(file), self.system)
        robot = self.derivation.robot
        return rules.cad_from_robot(robot, self.system, f"--cad, robot {self.system.robot}")

    def against(self, cad: KnownValues | str | Path = NOMINAL) -> CadComparison:
        """The identified quantities against CAD.

        Raises:
            DataError: of a robot.
        """
        given = cad if isinstance(cad, KnownValues) else self.cad(cad)
        fitted = self._with_values()
        return compare_cad(
            self.system, fitted.data.tolist(), fitted.covariance, given.values, given.sigmas,
            fitted.aside,
        )  # fmt: skip

    def __reduce__(self) -> tuple[Any, ...]:
        """Found anew where it lands: rings of polynomials do not travel."""
        return _again, (self.derivation, self.system.source, self.fitted)

    def _with_values(self) -> FittedSource:
        if self.fitted is None:
            raise DataError(
                f"{self.system.robot}: a robot, with no identified values; expected a model"
            )
        return self.fitted


def physical(thing: Robot | Derivation | IdentifiedModel, of: Source | None = None) -> Physical:
    """The physical parameters of a robot, or of a model with values.

    >>> physical(load("wrist")).system.letters[:3]
    ('am', 'at2', 'at3')

    Args:
        thing: it.
        of: what is identified: "base" or "coefficients"; None: see `physical_system`.

    Raises:
        DataError: a model that lacks a base parameter.
    """
    model = thing if isinstance(thing, IdentifiedModel) else None
    if isinstance(thing, IdentifiedModel):
        thing = robot_from_text(thing.robot_text, f"model of {thing.spec.robot}, robot_text")
    derivation = derive(thing) if isinstance(thing, Robot) else thing
    system = physical_system(derivation.model, derivation.base, of)
    return Physical(system, derivation, None if model is None else _fitted(system, model))


def _again(derivation: Derivation, of: Source, fitted: FittedSource | None) -> Physical:
    return Physical(physical_system(derivation.model, derivation.base, of), derivation, fitted)


def _fitted(system: PhysicalSystem, model: IdentifiedModel) -> FittedSource:
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
        told = [system.base[k] for k in aside if T[i, k] != 0.0]
        if told:
            why[name] = f"the fit set {', '.join(told)} aside"
    return FittedSource(T @ model.beta[at], T @ model.covariance[np.ix_(at, at)] @ T.T, why)


def values_table(found: PhysicalValues) -> Table:
    """Value, sigma and source of every parameter that is told."""
    derived, rows = found.derived, []
    for k, letter in enumerate(derived.letters):
        unit, told = UNITS[found.system.kinds[letter]], letter not in found.doubts
        value, sigma = float(derived.values[k]), float(derived.sigmas[k])
        rows.append(
            (letter, value, sigma, unit, found.sources(k)) if told
            else (letter, None, None, unit, found.doubts[letter])
        )  # fmt: skip
    title = f"{found.system.robot}: physical parameters"
    return Table.of(title, "parameter, value, sigma, unit, mostly from", rows)


def _values_summary(found: PhysicalValues) -> str:
    told = len(found.derived.letters) - len(found.doubts)
    first = f"{found.system.robot}: {told} of {len(found.derived.letters)} physical parameters told"
    return "\n".join([first, *found.doubts.values()])


def _physical_summary(found: Physical) -> str:
    system, easiest = found.system, easiest_set(found.system)
    first = (f"{system.robot}: {len(system.data)} identified quantities, {len(system.letters)} "
             f"physical parameters with an effect")  # fmt: skip
    return "\n".join([
        first,
        f"at least {smallest_number(system)} must be known that all others follow: "
        f"{','.join(easiest)}",
    ])  # fmt: skip


def _symbols_table(found: Physical) -> Table:
    system = found.system
    rows = [(x, system.kinds[x], UNITS[system.kinds[x]]) for x in system.letters]
    return Table.of(f"{system.robot}: physical parameters", "parameter, kind, unit", rows)


present({
    PhysicalValues: Presentation("a set of physical parameters", _values_summary,
                                 lambda v: {"values": lambda: values_table(v)}),
    Physical: Presentation("a system of physical parameters", _physical_summary,
                           lambda p: {"parameters": lambda: _symbols_table(p)}),
})  # fmt: skip
