"""`modeler physical ROBOT|MODEL`: physical parameters in closed form, values, sets, CAD."""

import argparse
from pathlib import Path

from modeler import formulas
from modeler.api.physical_parameters import UNITS, Physical, PhysicalValues, physical
from modeler.cli.console import Json, note, progress, say, say_lines, working
from modeler.cli.lists import read_robot_with_notes
from modeler.codegen import derive
from modeler.core.errors import DataError
from modeler.core.json import entries
from modeler.core.table import percent
from modeler.estimation import load_model

_SHOWN = 10
_KINDS = {"mass": "masses", "length": "lengths", "centre": "mass centres", "inertia": "inertias",
          "rotor inertia": "rotor inertias"}  # fmt: skip


def run_physical(args: argparse.Namespace) -> Json:
    """Prints what was asked for; what there is to know if nothing was."""
    if args.near is not None and args.known is None:
        raise DataError("--near: chooses between roots that --known leaves; add --known LIST")
    if args.sets is not None and args.sets is not True and args.sets < 1:
        raise DataError(
            f"--sets: got {args.sets}; expected 1 or more, or --sets alone for the smallest"
        )
    model = load_model(args.source) if Path(args.source).suffix.lower() == ".json" else None
    thing = derive(read_robot_with_notes(args.source)) if model is None else model
    with working(f"physical parameters of {args.source}"):
        subject = physical(thing, args.of)
    system = subject.system
    for line in () if model is None else model.warning:
        note(line)
    result: dict[str, Json] = {"robot": system.robot, "from": system.source}
    if args.known is not None:
        result |= _known(args, subject)
    cad = None if args.cad is None else subject.cad(args.cad)
    if args.sets is not None:
        result["sets"] = _sets(subject, None if args.sets is True else args.sets, cad)
    elif cad is not None:
        if subject.fitted is None:
            raise DataError(
                f"--cad: {args.source} is a robot, with no identified values; expected a model "
                "file of `modeler fit`, or --sets"
            )
        result["cad"] = _against_cad(subject, cad)
    if args.known is None and args.sets is None and args.cad is None:
        result |= _overview(system, args.source, model is not None)
    return result


def _overview(system: formulas.PhysicalSystem, source: str, fitted: bool) -> dict[str, Json]:
    """Parameters, quantities, and the easiest set."""
    number = formulas.smallest_number(system)
    say(f"{system.robot}: {len(system.data)} identified quantities, {len(system.letters)} physical "
        f"parameters with an effect, {len(system.vanishing)} without")  # fmt: skip
    for kind, plural in _KINDS.items():
        letters = [x for x in system.letters if system.kinds[x] == kind]
        if letters:
            say(f"  {plural}: {', '.join(letters)}")
    if system.alone:
        say(f"  identified by themselves: {', '.join(system.alone)}")
    if system.constants:
        say("  known from the table: "
            + ", ".join(f"{k} = {v:.6g}" for k, v in system.constants.items()))  # fmt: skip
    say_lines(f"  {name} = {text}" for name, text in system.abbreviations.items())
    say_lines(["", *formulas.definition_lines(system)])
    easiest = formulas.easiest_set(system)
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


def _known(args: argparse.Namespace, subject: Physical) -> dict[str, Json]:
    """Formulas; values if there is a model."""
    system, fitted = subject.system, subject.fitted
    given = formulas.known_from_text(args.known, system)
    _check_given(args, given, fitted is not None)
    with working("solving"):
        solution = subject.formulas(given)
    mark = {"python": "# ", "latex": "% ", "text": ""}[args.format]
    say_lines(system.map_lines, mark)
    if system.map_lines:
        say()
    say_lines([*formulas.solution_lines(solution, args.format), ""])
    unknown = len(system.letters) - len(solution.known)
    say(f"{mark}{len(solution.steps)} of {unknown} unknown parameters follow; each formula holds "
        f"exactly for {formulas.VERIFIED} of {formulas.VERIFIED} random robots")  # fmt: skip
    if solution.surplus:
        say(f"{mark}{solution.surplus} more known than these need: with a model they are tested")
    say_lines(formulas.missing_lines(solution), mark)
    told = formulas.solution_json(
        solution, {"robots": formulas.VERIFIED, "right": formulas.VERIFIED}
    )
    if fitted is not None:
        near = formulas.known_from_text(args.near or "", system, "--near")
        told["values"] = _values(subject.solved(solution, given, near.values))
    return dict(told)


def _check_given(args: argparse.Namespace, given: formulas.KnownValues, fitted: bool) -> None:
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


def _values(found: PhysicalValues) -> Json:
    derived, doubts, rows = found.derived, found.doubts, []
    say()
    say(f"{'parameter':<10} {'value':>13} {'sigma':>10} {'%sigma':>8}  {'unit':<7} mostly from")
    for k, letter in enumerate(derived.letters):
        value, sigma = float(derived.values[k]), float(derived.sigmas[k])
        unit, told = UNITS[found.system.kinds[letter]], letter not in doubts
        if told:
            percent = f"{100 * sigma / abs(value):.3g}" if value else "-"
            say(f"{letter:<10} {value:>13.6g} {sigma:>10.3g} {percent:>8}  {unit:<7} "
                f"{found.sources(k)}")  # fmt: skip
        else:
            say(f"{letter:<10} {'not told':>13}")
        slopes, shares = (
            {name: float(x) for name, x in zip(derived.inputs, row, strict=True) if x}
            for row in (derived.slopes[k], derived.shares[k])
        )
        rows.append(
            {
                "parameter": letter,
                "value": value if told else None,
                "sigma": sigma if told else None,
                "unit": unit,
                "doubt": doubts.get(letter),
                "sensitivity": slopes,
                "variance_shares": shares,
            }
        )
    say_lines(doubts.values(), "not told: ")
    _print_tested(found.tested)
    return {"parameters": rows, "known_against_fit": [vars(row) for row in found.tested]}


def _print_tested(tested: tuple[formulas.KnownAgainstFit, ...]) -> None:
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


def _sets(subject: Physical, size: int | None, cad: formulas.KnownValues | None) -> Json:
    system = subject.system
    with progress("counting") as tell:
        found = subject.sets(size, tell)
    say(f"{system.robot}: {found.count} of {found.possible} sets of {found.size} known parameters "
        f"suffice; the smallest sets have {found.smallest}")  # fmt: skip
    for key, count in found.classes.items():
        say(f"  {key[0]} masses and lengths, {key[1]} mass centres, {key[2]} inertias: {count}")
    ratings = subject.rated(found, cad) if found.count and cad is not None else ()
    if found.easiest:
        say(f"the {len(found.easiest)} with the fewest inertias, then the fewest mass centres"
            + (", the least error first (1 % in all that is measured gives, median and worst):"
               if ratings else ":"))  # fmt: skip
        lines = [
            f"  {','.join(r.known)}  {percent(r.middle / 100)}, {r.letter} {percent(r.worst / 100)}"
            for r in ratings
        ]
        lines = lines or [f"  {','.join(members)}" for members in found.easiest]
        say_lines(lines[:_SHOWN])
        if len(found.easiest) > _SHOWN:
            say(f"  and {len(found.easiest) - _SHOWN} more (all with --json)")
    return {
        **entries(found, "size smallest possible count"),
        "classes": [
            {"masses_and_lengths": k[0], "centres": k[1], "inertias": k[2], "count": n}
            for k, n in found.classes.items()
        ],
        "contains": dict(found.contains),
        "easiest": [list(members) for members in found.easiest],
        "rated": [vars(r) | {"known": list(r.known)} for r in ratings],
    }


def _against_cad(subject: Physical, cad: formulas.KnownValues) -> Json:
    found = subject.against(cad)
    say(f"{'quantity':<8} {'identified':>12} {'sigma':>9} {'CAD':>12} {'z':>8}  depends on")
    for row in found.rows:
        mark = "suspicious" if row.suspicious else ""
        say(f"{row.name:<8} {row.identified:>12.5g} {row.sigma:>9.2g} {row.cad:>12.5g} "
            f"{row.z:>8.1f}  {' '.join(row.letters)}  {mark}".rstrip())  # fmt: skip
    say_lines(f"{name:<8} not compared: {why}" for name, why in found.left_out.items())
    _print_explained(found)
    return {
        "rows": [vars(row) | {"letters": list(row.letters)} for row in found.rows],
        **entries(found, "limit chi_squared"),
        "left_out": dict(found.left_out),
        "implicated": list(found.implicated),
        "explanations": [
            {**vars(e), "letters": list(e.letters), "cad": list(e.cad), "fitted": list(e.fitted)}
            for e in found.explanations
        ],
    }


def _print_explained(found: formulas.CadComparison) -> None:
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
