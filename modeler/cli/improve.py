"""`modeler diagnose MODEL LOG...` and `modeler add MODEL EFFECT LOG... --out MODEL2`."""

import argparse
from pathlib import Path

import modeler.api.improve as improve
from modeler import views
from modeler.cli.console import (
    draw_result,
    print_lines,
    print_result,
    show_activity,
    show_next,
    write_pictures,
)
from modeler.cli.documents import AdditionReport, DiagnosisReport
from modeler.cli.lists import build_reporter, read_options
from modeler.core.files import write_atomically
from modeler.core.options import AddOptions, DiagnoseOptions
from modeler.core.table import DIGITS, format_percent
from modeler.diagnosis import Diagnosis, describe_additions, describe_last_addition, format_lines
from modeler.estimation import IdentifiedModel, load_model, save_model
from modeler.robot import parse_robot_text

_WIDTH = 40  # characters of the longest bar


def run_diagnose(args: argparse.Namespace) -> DiagnosisReport:
    """Prints the verdict, the effects and what cannot be determined."""
    model = load_model(args.model)
    robot = parse_robot_text(model.robot_text, f"{args.model}, robot")
    options = read_options(args, DiagnoseOptions, "diagnose", robot.diagnose)
    diagnosis, case = improve.diagnose_logs(
        model, args.logs, args.holdout, options, args.mapping, build_reporter()
    )
    needs_motion = model.fit.verdict is not None and model.fit.verdict.needs_motion
    following = views.suggest_after_diagnosis(
        args.model, args.logs, args.holdout, diagnosis, args.effects_from, needs_motion
    )
    print_lines([*format_lines(diagnosis), *model.warning])
    draw_result(args, lambda: _build_page(args, model, diagnosis, following))
    if not args.add:
        show_next(following)
        return DiagnosisReport(diagnosis)
    with show_activity("adding what was found"):
        better, left_out = improve.add_proposals(case, diagnosis)
    save_model(args.out, better)
    print_lines([*format_waterfall(better), *describe_last_addition(better), *left_out])
    print_lines([args.out], "written: ")
    return DiagnosisReport(diagnosis, left_out)


def _build_page(
    args: argparse.Namespace, model: IdentifiedModel, diagnosis: Diagnosis, following: list[str]
) -> views.Page:
    file_names = [Path(place).name for place in (*args.logs, *args.holdout)]
    provenance = [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, fitted on "
        f"{', '.join(log.name for log in model.logs)}",
        f"logs explained: {', '.join(file_names[: len(args.logs)])}",
        *model.warning,
    ]
    origin = views.Origin(args.model, file_names, bool(diagnosis.held_out_logs), following)
    return views.build_diagnosis_page(diagnosis, provenance, origin)


def run_add(args: argparse.Namespace) -> AdditionReport:
    """Adds, saves, draws the waterfall."""
    model = load_model(args.model)
    better, left_out = improve.add_to_model(
        *(model, args.effect, args.logs, args.holdout),
        *(AddOptions.from_names(vars(args)), args.mapping, build_reporter()),
    )
    save_model(args.out, better)
    following = views.suggest_after_add(args.out, args.logs, args.holdout, better.fit)
    places = [args.out]
    if args.robot_out is not None:
        write_atomically(Path(args.robot_out), better.robot_text)
        places.append(args.robot_out)
    pictures = []
    if (args.report is not None or args.picture is not None) and better.history:
        held_out = better.history[-1].held_out_logs
        origin = views.Origin(args.out, held_out or args.logs, bool(held_out), following)
        page = views.build_history_page(better, left_out, origin)
        if args.report is not None:
            places.append(str(views.write_page(Path(args.report), page)))
        pictures = page.collect_pictures()
    if args.picture is not None:
        places.append(write_pictures(args.picture, pictures))
    print_lines([*format_waterfall(better), *describe_last_addition(better), *left_out])
    joint_errors = (f"joint {j.name} {format_percent(j.relative_error)}" for j in better.fit.joints)
    print_result(f"error of the model on the logs of the fit: {', '.join(joint_errors)}")
    print_lines([*describe_additions(better, max(1, len(model.history))), *model.warning])
    if better.fit.verdict is not None:
        print_result(f"now: {better.fit.verdict.line}")
    print_lines(places, "written: ")
    show_next(following)
    return AdditionReport(better.fit, better.history, left_out)


def format_waterfall(model: IdentifiedModel) -> list[str]:
    """Returns the error after every added effect as lines with bars."""
    if not model.history:
        return ["nothing is added: the model stays as it was fitted"]
    last = model.history[-1]
    held_out = bool(last.held_out_logs)
    title = "held-out error" if held_out else "cross-validated error"
    if len(last.joints) > 1:
        title += ", rms over the joints"
    lines = [f"{'':<30} {title}"]
    largest = max(step.error for step in model.history) or 1.0
    for step in model.history:
        name = views.format_step_name(step) if step.effect else "model as fitted"
        bar = ("~" if step.is_learned else "#") * round(_WIDTH * step.error / largest)
        training = format_percent(step.training_error, DIGITS)
        fitted = f"(fit error {training}{', learned' * step.is_learned})"
        lines.append(f"{name:<30} {format_percent(step.error, DIGITS):>8} {bar}  {fitted}")
    if (parts := model.error_reduction_shares) is not None:
        lines.append(f"{'':<30} ~ learned, not physics")
        physics, learned = (100.0 * part for part in parts)
        lines.append(
            f"of the fall by {physics + learned:.2g} points, {physics:.2g} are physics and "
            f"{learned:.2g} learned"
        )
    return lines
