"""`modeler physical ROBOT|MODEL`: physical parameters in closed form, values, sets, CAD."""

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.cli.console import Json, note, progress, say, working
from modeler.cli.parsers.physical import NOMINAL
from modeler.cli.robots import read_told
from modeler.core.errors import DataError, ModelerError
from modeler.derivation import Derivation, derive
from modeler.fit import IdentifiedModel, load_model
from modeler.robot import robot_from_text
from modeler.terms.against_fit import CadComparison, KnownAgainstFit, compare_cad, test_known
from modeler.terms.given_values import Given, cad_from_file, cad_from_robot, given_from_text
from modeler.terms.known_sets import KnownSets, easiest_set, known_sets, smallest_number
from modeler.terms.physical_system import PhysicalSystem, physical_system
from modeler.terms.set_sensitivity import Rated, rated
from modeler.terms.solution_text import (
    definition_lines,
    missing_lines,
    solution_json,
    solution_lines,
)
from modeler.terms.solved_values import VERIFIED, Derived, derive_values, impossible, verify
from modeler.terms.solving import ClosedSolution, solve

_UNITS = {
    "mass": "kg", "length": "m", "centre": "m", "inertia": "kg m^2", "rotor inertia": "kg m^2",
}  # fmt: skip
_SHOWN = 10
_KINDS = {"mass": "masses", "length": "lengths", "centre": "mass centres", "inertia": "inertias",
          "rotor inertia": "rotor inertias"}  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Fitted:
    """Identified quantities of a model.

    Attributes:
        data: (data,) values.
        covariance: (data, data).
        aside: {quantity: why it has no value}.
    """

    data: np.ndarray
    covariance: np.ndarray
    aside: Mapping[str, str]


def run_physical(args: argparse.Namespace) -> Json:
    """Prints what was asked for; what there is to know if nothing was."""
    _check_usage(args)
    derivation, model = _read(args.source)
    with working(f"physical parameters of {derivation.robot.name}"):
        system = physical_system(derivation.model, derivation.base, args.of)
    fitted = None if model is None else _fitted(system, model)
    for line in () if model is None else model.warning:
        note(line)
    result: dict[str, Json] = {"robot": system.robot, "from": system.source}
    if args.known is not None:
        result |= _known(args, system, fitted)
    cad = None if args.cad is None else _cad(args.cad, system, derivation)
    if args.sets is not None:
        result["sets"] = _sets(system, None if args.sets is True else args.sets, cad)
    elif cad is not None:
        if fitted is None:
            raise DataError(
                f"--cad: {args.source} is a robot, with no identified values; expected a model "
                "file of `modeler fit`, or --sets"
            )
        result["cad"] = _against_cad(system, fitted, cad)
    if args.known is None and args.sets is None and args.cad is None:
        result |= _overview(system, args.source, model is not None)
    return result


def _check_usage(args: argparse.Namespace) -> None:
    """Before any long work."""
    if args.near is not None and args.known is None:
        raise DataError("--near: chooses between roots that --known leaves; add --known LIST")
    if args.sets is not None and args.sets is not True and args.sets < 1:
        raise DataError(
            f"--sets: got {args.sets}; expected 1 or more, or --sets alone for the smallest"
        )


def _read(source: str) -> tuple[Derivation, IdentifiedModel | None]:
    if Path(source).suffix.lower() != ".json":
        return derive(read_told(source)), None
    model = load_model(source)
    return derive(robot_from_text(model.robot_text, f"{source}, robot_text")), model


def _fitted(system: PhysicalSystem, model: IdentifiedModel) -> _Fitted:
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
    return _Fitted(T @ model.beta[at], T @ model.covariance[np.ix_(at, at)] @ T.T, why)


def _overview(system: PhysicalSystem, source: str, fitted: bool) -> dict[str, Json]:
    """Parameters, quantities, and the easiest set."""
    number = smallest_number(system)
    say(f"{system.robot}: {len(system.data)} identified quantities, {len(system.letters)} physical "
        f"parameters with an effect, {len(system.vanishing)} without")  # fmt: skip
    for kind, plural in _KINDS.items():
        letters = [x for x in system.letters if system.kinds[x] == kind]
        if letters:
            say(f"  {plural}: {', '.join(letters)}")
    if system.constants:
        say("  known from the table: "
            + ", ".join(f"{k} = {v:.6g}" for k, v in system.constants.items()))  # fmt: skip
    for name, text in system.abbreviations.items():
        say(f"  {name} = {text}")
    say()
    for line in definition_lines(system):
        say(line)
    easiest = easiest_set(system)
    say()
    parameters = "parameter" if number == 1 else "parameters"
    say(f"at least {number} {parameters} must be known that all others follow")
    if number:
        say(f"measured with the least trouble: {','.join(easiest)}")
        given = ",".join(f"{x}=VALUE" if fitted else x for x in easiest)
        say(f"{'values' if fitted else 'formulas'}: modeler physical {source} --known {given}")
    return {
        "parameters": {x: system.kinds[x] for x in system.letters},
        "without_effect": list(system.vanishing),
        "smallest_number": number,
        "easiest_set": list(easiest),
    }


def _known(
    args: argparse.Namespace, system: PhysicalSystem, fitted: _Fitted | None
) -> dict[str, Json]:
    """Formulas; values if there is a model."""
    given = given_from_text(args.known, system)
    _check_given(args, given, fitted is not None)
    with working("solving"):
        solution = solve(system, given.names)
        good = verify(solution)
    if good != VERIFIED:
        raise ModelerError(
            f"{system.robot}: the formulas failed {VERIFIED - good} of {VERIFIED} exact checks; "
            "please report these known parameters"
        )
    mark = {"python": "# ", "latex": "% ", "text": ""}[args.format]
    for line in system.map_lines:
        say(f"{mark}{line}")
    if system.map_lines:
        say()
    for line in solution_lines(solution, args.format):
        say(line)
    say()
    unknown = len(system.letters) - len(solution.known)
    say(f"{mark}{len(solution.steps)} of {unknown} unknown parameters follow; each formula holds "
        f"exactly for {good} of {VERIFIED} random robots")  # fmt: skip
    if solution.surplus:
        say(f"{mark}{solution.surplus} more known than these need: with a model they are tested")
    for line in missing_lines(solution):
        say(f"{mark}{line}")
    told = solution_json(solution, {"robots": VERIFIED, "right": good})
    if fitted is not None:
        near = given_from_text(args.near or "", system, "--near")
        told["values"] = _values(solution, fitted, given, near.values)
    return dict(told)


def _check_given(args: argparse.Namespace, given: Given, fitted: bool) -> None:
    """A model needs values of all that is known, a robot has no use for any."""
    if not fitted and (given.values or args.near is not None):
        raise DataError(
            f"{'--known' if given.values else '--near'}: got values, but {args.source} is a robot "
            "without identified ones; expected names alone, as am,bm, or a model file of "
            "`modeler fit`"
        )
    if fitted:
        missing = [x for x in given.names if x not in given.values]
        if missing:
            raise DataError(
                f"--known: no value of {', '.join(missing)}; expected {missing[0]}=VALUE, SI "
                "units, for every known parameter of a model"
            )


def _values(
    solution: ClosedSolution, fitted: _Fitted, given: Given, near: Mapping[str, float]
) -> Json:
    data = fitted.data.tolist()
    derived = derive_values(solution, data, fitted.covariance, given.values, given.sigmas, near)
    system = solution.system
    doubts = dict(derived.doubtful)
    for k, letter in enumerate(derived.letters):
        for name, why in fitted.aside.items():
            if derived.slopes[k, derived.inputs.index(name)] != 0.0:
                doubts[letter] = f"{letter} needs {name}, and {why}"
    doubts |= impossible(derived, system)
    say()
    say(f"{'parameter':<10} {'value':>13} {'sigma':>10} {'%sigma':>8}  {'unit':<7} mostly from")
    rows = [_row(derived, k, system, doubts) for k in range(len(derived.letters))]
    for row in rows:
        say(row)
    for text in doubts.values():
        say(f"not told: {text}")
    tested = test_known(solution, data, fitted.covariance, given.values, given.sigmas)
    _tell_tested(tested)
    return _values_json(derived, doubts, tested, system)


def _row(derived: Derived, k: int, system: PhysicalSystem, doubts: Mapping[str, str]) -> str:
    letter = derived.letters[k]
    unit = _UNITS[system.kinds[letter]]
    if letter in doubts:
        return f"{letter:<10} {'not told':>13}"
    value, sigma = derived.values[k], derived.sigmas[k]
    percent = f"{100 * sigma / abs(value):.3g}" if value else "-"
    order = np.argsort(-derived.shares[k])[:2]
    parts = [
        f"{derived.inputs[i]} {100 * derived.shares[k, i]:.0f} %"
        for i in order
        if derived.shares[k, i] > 0.05
    ]
    return f"{letter:<10} {value:>13.6g} {sigma:>10.3g} {percent:>8}  {unit:<7} {', '.join(parts)}"


def _tell_tested(tested: tuple[KnownAgainstFit, ...]) -> None:
    """The known parameters against the fit.

    Raises:
        DataError: one contradicts it.
    """
    if not tested:
        return
    say()
    say("more is known than needed; each known parameter against what the others and the fit say:")
    for row in tested:
        say(f"  {row.letter:<8} given {row.given:<10.6g} follows {row.implied:.6g} +- "
            f"{row.implied_sigma:.2g}, {abs(row.z):.1f} sigma"
            + ("  contradicts" if row.contradicts else ""))  # fmt: skip
    wrong = [row for row in tested if row.contradicts]
    if wrong:
        told = "; ".join(
            f"{r.letter} = {r.given:g} given, {r.implied:.6g} +- {r.implied_sigma:.2g} follows "
            f"({abs(r.z):.1f} sigma)"
            for r in sorted(wrong, key=lambda r: -abs(r.z))
        )
        raise DataError(
            f"--known contradicts the fit: {told}; measure these again, or leave one of them out"
        )


def _values_json(
    derived: Derived, doubts: Mapping[str, str], tested: tuple[KnownAgainstFit, ...],
    system: PhysicalSystem,
) -> Json:  # fmt: skip
    rows = []
    for k, letter in enumerate(derived.letters):
        told = letter not in doubts
        rows.append(
            {
                "parameter": letter,
                "value": float(derived.values[k]) if told else None,
                "sigma": float(derived.sigmas[k]) if told else None,
                "unit": _UNITS[system.kinds[letter]],
                "doubt": doubts.get(letter),
                "sensitivity": {
                    name: float(slope)
                    for name, slope in zip(derived.inputs, derived.slopes[k], strict=True)
                    if slope
                },
                "variance_shares": {
                    name: float(share)
                    for name, share in zip(derived.inputs, derived.shares[k], strict=True)
                    if share
                },
            }
        )
    return {"parameters": rows, "known_against_fit": [vars(row) for row in tested]}


def _cad(file: str, system: PhysicalSystem, derivation: Derivation) -> Given:
    if file != NOMINAL:
        return cad_from_file(Path(file), system)
    return cad_from_robot(derivation.robot, system, f"--cad, robot {system.robot}")


def _sets(system: PhysicalSystem, size: int | None, cad: Given | None) -> Json:
    with progress("counting") as tell:
        found = known_sets(system, size, tell)
    say(f"{system.robot}: {found.count} of {found.possible} sets of {found.size} known parameters "
        f"suffice; the smallest sets have {found.smallest}")  # fmt: skip
    for key, count in found.classes.items():
        say(f"  {key[0]} masses and lengths, {key[1]} mass centres, {key[2]} inertias: {count}")
    ratings: tuple[Rated, ...] = ()
    if found.count and cad is not None:
        missing = [x for x in system.letters if x not in cad.values]
        if missing:
            raise DataError(f"--cad: no value of {', '.join(missing)}; expected all parameters")
        ratings = rated(system, found.easiest, cad.values)
    _tell_easiest(found, ratings)
    return {
        "size": found.size,
        "smallest": found.smallest,
        "possible": found.possible,
        "count": found.count,
        "classes": [
            {"masses_and_lengths": k[0], "centres": k[1], "inertias": k[2], "count": n}
            for k, n in found.classes.items()
        ],
        "contains": dict(found.contains),
        "easiest": [list(members) for members in found.easiest],
        "rated": [vars(r) | {"known": list(r.known)} for r in ratings],
    }


def _tell_easiest(found: KnownSets, ratings: tuple[Rated, ...]) -> None:
    if not found.easiest:
        return
    say(f"the {len(found.easiest)} with the fewest inertias, then the fewest mass centres"
        + (", the least error first (1 % in all that is measured gives, median and worst):"
           if ratings else ":"))  # fmt: skip
    if ratings:
        for r in ratings[:_SHOWN]:
            say(f"  {','.join(r.known)}  {r.middle:.2g} %, {r.letter} {r.worst:.2g} %")
    else:
        for members in found.easiest[:_SHOWN]:
            say(f"  {','.join(members)}")
    if len(found.easiest) > _SHOWN:
        say(f"  and {len(found.easiest) - _SHOWN} more (all with --json)")


def _against_cad(system: PhysicalSystem, fitted: _Fitted, cad: Given) -> Json:
    found = compare_cad(
        system, fitted.data.tolist(), fitted.covariance, cad.values, cad.sigmas, fitted.aside
    )
    say(f"{'quantity':<8} {'identified':>12} {'sigma':>9} {'CAD':>12} {'z':>8}  depends on")
    for row in found.rows:
        mark = "suspicious" if row.suspicious else ""
        say(f"{row.name:<8} {row.identified:>12.5g} {row.sigma:>9.2g} {row.cad:>12.5g} "
            f"{row.z:>8.1f}  {' '.join(row.letters)}  {mark}".rstrip())  # fmt: skip
    for name, why in found.left_out.items():
        say(f"{name:<8} not compared: {why}")
    _tell_explained(found)
    return {
        "rows": [vars(row) | {"letters": list(row.letters)} for row in found.rows],
        "limit": found.limit,
        "chi_squared": found.chi_squared,
        "left_out": dict(found.left_out),
        "implicated": list(found.implicated),
        "explanations": [
            {**vars(e), "letters": list(e.letters), "cad": list(e.cad), "fitted": list(e.fitted)}
            for e in found.explanations
        ],
    }


def _tell_explained(found: CadComparison) -> None:
    say()
    if not found.suspicious:
        say(f"all {len(found.rows)} agree with CAD (|z| below {found.limit:.2f})")
        return
    say(f"{len(found.suspicious)} of {len(found.rows)} do not agree with CAD (|z| above "
        f"{found.limit:.2f}: 1 false alarm in 100 tables)")  # fmt: skip
    if not any(e.enough for e in found.explanations):
        say("no change of one or two CAD entries alone makes all agree; entries of suspicious "
            f"quantities only: {', '.join(found.implicated) or 'none'}")  # fmt: skip
    for e in found.explanations:
        changes = " and ".join(
            f"{x} = {new:.5g} instead of {old:.5g}"
            for x, old, new in zip(e.letters, e.cad, e.fitted, strict=True)
        )
        say(f"{'all agree' if e.enough else 'most is explained'} if {changes} "
            f"(chi2 {e.chi_squared:.4g} instead of {found.chi_squared:.4g})")  # fmt: skip
