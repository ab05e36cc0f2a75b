"""`modeler physical ROBOT|MODEL`: physical parameters in closed form, values, sets, CAD."""

import argparse
from pathlib import Path

from modeler import formulas
from modeler.api.physical_parameters import UNITS, Physical, PhysicalValues, physical
from modeler.cli.console import (
    Json,
    print_lines,
    print_note,
    print_result,
    show_activity,
    show_progress,
)
from modeler.cli.documents import PhysicalReport
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.thresholds import THRESHOLDS
from modeler.codegen import derive
from modeler.core.json import select_attributes
from modeler.core.table import format_percent
from modeler.estimation import load_model

_PLURALS = {"mass": "masses", "centre": "mass centres"}  # of kinds; others take an s


def run_physical(args: argparse.Namespace) -> PhysicalReport:
    """Prints what was requested; what there is to know if nothing was."""
    model = load_model(args.source) if Path(args.source).suffix.lower() == ".json" else None
    thing = derive(read_robot_with_notes(args.source)) if model is None else model
    with show_activity(f"physical parameters of {args.source}"):
        subject = physical(thing, args.of)
    system = subject.system
    for line in () if model is None else model.warning:
        print_note(line)
    result: Json = {"robot": system.robot, "source": system.source}
    if args.known is not None:
        result |= _print_known(args, subject)
    cad = None if args.cad is None else subject.read_cad(args.cad)
    if args.sets is not None:
        result["sets"] = _print_sets(subject, None if args.sets is True else args.sets, cad)
    elif cad is not None:
        result["cad"] = _print_cad_comparison(subject, cad)
    if args.known is None and args.sets is None and args.cad is None:
        result |= _print_overview(system, args.source, model is not None)
    return result


def _print_overview(system: formulas.PhysicalSystem, source: str, fitted: bool) -> dict[str, Json]:
    """Parameters, quantities, and the easiest set."""
    number = formulas.count_smallest_set(system)
    print_result(
        f"{system.robot}: {len(system.data)} identified quantities, {len(system.letters)} physical "
        f"parameters with an effect, {len(system.vanishing)} without"
    )
    for kind in UNITS:
        letters = [x for x in system.letters if system.kinds[x] == kind]
        if letters:
            print_result(f"  {_PLURALS.get(kind, f'{kind}s')}: {', '.join(letters)}")
    if system.alone:
        print_result(f"  identified by themselves: {', '.join(system.alone)}")
    if system.constants:
        constants = ", ".join(f"{k} = {v:.6g}" for k, v in system.constants.items())
        print_result(f"  known from the table: {constants}")
    print_lines(f"  {name} = {text}" for name, text in system.abbreviations.items())
    print_lines(["", *formulas.format_definition_lines(system)])
    easiest = formulas.find_easiest_set(system)
    print_result()
    parameters = "parameter" if number == 1 else "parameters"
    print_result(f"at least {number} {parameters} must be known that all others follow")
    if number:
        print_result(f"easiest to measure: {','.join(easiest)}")
        known_text = ",".join(f"{x}=VALUE" if fitted else x for x in easiest)
        print_result(
            f"{'values' if fitted else 'formulas'}: modeler physical {source} --known {known_text}"
        )
    return {
        "parameters": {x: system.kinds[x] for x in system.letters},
        "without_effect": list(system.vanishing),
        "smallest_count": number,
        "suggested_set": list(easiest),
    }


def _print_known(args: argparse.Namespace, subject: Physical) -> dict[str, Json]:
    """Formulas; values if there is a model."""
    system, fitted = subject.system, subject.fitted
    known_values = formulas.parse_known_values(args.known, system)
    subject.check_known(known_values, args.near)
    with show_activity("solving"):
        solution = subject.derive_formulas(known_values)
    mark = {"python": "# ", "latex": "% ", "text": ""}[args.format]
    print_lines(system.map_lines, mark)
    if system.map_lines:
        print_result()
    print_lines([*formulas.format_solution_lines(solution, args.format), ""])
    unknown = len(system.letters) - len(solution.known)
    robots = formulas.THRESHOLDS.verified_robots
    print_result(
        f"{mark}{len(solution.steps)} of {unknown} unknown parameters follow; each formula holds "
        f"exactly for {robots} of {robots} random robots"
    )
    if solution.surplus:
        print_result(
            f"{mark}{solution.surplus} more known than these need: with a model they are tested"
        )
    print_lines(formulas.format_missing_lines(solution), mark)
    solution_document = formulas.serialise_solution(solution, {"robots": robots, "right": robots})
    if fitted is not None:
        near = formulas.parse_known_values(args.near or "", system, "--near")
        solution_document["values"] = _print_values(
            subject.evaluate_solution(solution, known_values, near.values)
        )
    return dict(solution_document)


def _print_values(values: PhysicalValues) -> Json:
    derived, doubts, rows = values.derived, values.doubts, []
    print_result()
    print_result(
        f"{'parameter':<10} {'value':>13} {'sigma':>10} {'%sigma':>8}  {'unit':<7} mostly from"
    )
    for k, letter in enumerate(derived.letters):
        value, sigma = float(derived.values[k]), float(derived.sigmas[k])
        unit, is_identified = UNITS[values.system.kinds[letter]], letter not in doubts
        if is_identified:
            percent = f"{100 * sigma / abs(value):.3g}" if value else "-"
            sources = values.describe_sources(k)
            print_result(
                f"{letter:<10} {value:>13.6g} {sigma:>10.3g} {percent:>8}  {unit:<7} {sources}"
            )
        else:
            print_result(f"{letter:<10} {'not told':>13}")
        slopes, shares = (
            {name: float(x) for name, x in zip(derived.inputs, row, strict=True) if x}
            for row in (derived.slopes[k], derived.shares[k])
        )
        rows.append(
            {
                "parameter": letter,
                "value": value if is_identified else None,
                "sigma": sigma if is_identified else None,
                "unit": unit,
                "warning": doubts.get(letter),
                "sensitivity": slopes,
                "variance_shares": shares,
            }
        )
    print_lines(doubts.values(), "not determined: ")
    _print_tested(values.tested)
    values.require_consistent()
    return {"parameters": rows, "known_against_fit": [vars(row) for row in values.tested]}


def _print_tested(tested: tuple[formulas.KnownAgainstFit, ...]) -> None:
    """The known parameters against the fit."""
    if not tested:
        return
    print_result()
    print_result(
        "more is known than needed; each known parameter against what the others and the fit say:"
    )
    for row in tested:
        print_result(
            f"  {row.letter:<8} given {row.known_value:<10.6g} follows {row.implied_value:.6g} +- "
            f"{row.implied_sigma:.2g}, {abs(row.z):.1f} sigma"
            f"{'  contradicts' * row.is_contradictory}"
        )


def _print_sets(subject: Physical, size: int | None, cad: formulas.KnownValues | None) -> Json:
    system = subject.system
    with show_progress("counting") as tell:
        known_sets = subject.find_known_sets(size, tell)
    print_result(
        f"{system.robot}: {known_sets.count} of {known_sets.candidate_count} sets of "
        f"{known_sets.size} known parameters "
        f"suffice; the smallest sets have {known_sets.smallest}"
    )
    for key, count in known_sets.classes.items():
        print_result(
            f"  {key[0]} masses and lengths, {key[1]} mass centres, {key[2]} inertias: {count}"
        )
    ratings = subject.rank_sets(known_sets, cad) if known_sets.count and cad is not None else ()
    if known_sets.easiest_sets:
        print_result(
            f"the {len(known_sets.easiest_sets)} with the fewest inertias, then the fewest mass "
            "centres"
            + (
                ", the least error first (1 % in all that is measured gives, median and worst):"
                if ratings
                else ":"
            )
        )
        lines = [
            f"  {','.join(r.known_parameters)}  {format_percent(r.median_error / 100)}, {r.letter} "
            f"{format_percent(r.largest_error / 100)}"
            for r in ratings
        ]
        lines = lines or [f"  {','.join(members)}" for members in known_sets.easiest_sets]
        print_lines(lines[: THRESHOLDS.listed_sets])
        if len(known_sets.easiest_sets) > THRESHOLDS.listed_sets:
            print_result(
                f"  and {len(known_sets.easiest_sets) - THRESHOLDS.listed_sets} more "
                "(all with --json)"
            )
    return {
        **select_attributes(known_sets, "size smallest candidate_count count"),
        "classes": [
            {"masses_and_lengths": k[0], "centres": k[1], "inertias": k[2], "count": n}
            for k, n in known_sets.classes.items()
        ],
        "contains": dict(known_sets.contains),
        "easiest_sets": [list(members) for members in known_sets.easiest_sets],
        "ratings": [vars(r) | {"known_parameters": list(r.known_parameters)} for r in ratings],
    }


def _print_cad_comparison(subject: Physical, cad: formulas.KnownValues) -> Json:
    comparison = subject.compare_with_cad(cad)
    print_result(
        f"{'quantity':<8} {'identified':>12} {'sigma':>9} {'CAD':>12} {'z':>8}  depends on"
    )
    for row in comparison.rows:
        line = (
            f"{row.name:<8} {row.identified_value:>12.5g} {row.sigma:>9.2g} {row.cad_value:>12.5g}"
        )
        line += f" {row.z:>8.1f}  {' '.join(row.letters)}  {'suspicious' * row.is_suspicious}"
        print_result(line.rstrip())
    print_lines(f"{name:<8} not compared: {why}" for name, why in comparison.not_compared.items())
    _print_explained(comparison)
    return {
        "rows": [vars(row) | {"letters": list(row.letters)} for row in comparison.rows],
        **select_attributes(comparison, "limit chi_squared"),
        "not_compared": dict(comparison.not_compared),
        "implicated_parameters": list(comparison.implicated_parameters),
        "explanations": [
            {
                **vars(e),
                "letters": list(e.letters),
                "cad_values": list(e.cad_values),
                "fitted_values": list(e.fitted_values),
            }
            for e in comparison.explanations
        ],
    }


def _print_explained(comparison: formulas.CadComparison) -> None:
    print_result()
    if not comparison.suspicious:
        print_result(
            f"all {len(comparison.rows)} agree with CAD (|z| below {comparison.limit:.2f})"
        )
        return
    print_result(
        f"{len(comparison.suspicious)} of {len(comparison.rows)} do not agree with CAD (|z| above "
        f"{comparison.limit:.2f}: 1 false alarm in 100 tables)"
    )
    if not any(e.is_sufficient for e in comparison.explanations):
        print_result(
            "no change of one or two CAD entries alone makes all agree; entries of suspicious "
            f"quantities only: {', '.join(comparison.implicated_parameters) or 'none'}"
        )
    for e in comparison.explanations:
        changes = " and ".join(
            f"{x} = {new:.5g} instead of {old:.5g}"
            for x, old, new in zip(e.letters, e.cad_values, e.fitted_values, strict=True)
        )
        chi2 = f"(chi2 {e.chi_squared:.4g} instead of {comparison.chi_squared:.4g})"
        print_result(
            f"{'all agree' if e.is_sufficient else 'most is explained'} if {changes} {chi2}"
        )
