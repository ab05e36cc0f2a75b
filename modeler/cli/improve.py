"""`modeler diagnose MODEL LOG...` and `modeler add MODEL EFFECT LOG... --out MODEL2`."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import modeler.api.improve as improve
from modeler import views
from modeler.cli.console import (
    Json,
    draw_page,
    draw_pictures,
    print_lines,
    print_result,
    show_activity,
    show_next,
    show_progress,
    write_pictures,
)
from modeler.cli.lists import apply_stated_options
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.table import DIGITS, format_percent
from modeler.diagnosis import (
    ANY_LAW,
    LEARNED,
    LawRequest,
    add_effect,
    add_learned_law,
    describe_additions,
    describe_last_addition,
    format_lines,
    remove_last_effect,
)
from modeler.effects import Effect, find_effect
from modeler.estimation import IdentifiedModel, load_model, save_model
from modeler.robot import parse_robot_text, suggest_name

_WIDTH = 40  # characters of the longest bar


def run_diagnose(args: argparse.Namespace) -> Json:
    """Prints the verdict, the effects and what cannot be determined."""
    if args.add and not args.discover:
        raise DataError("--add: adds what --discover finds; give both, or neither")
    if args.add is not (args.out is not None):
        raise DataError("--add, --out MODEL2: got one of them; give both, or neither")
    model = load_model(args.model)
    robot = parse_robot_text(model.robot_text, f"{args.model}, robot")
    apply_stated_options(args, "diagnose", robot.diagnose)
    shared_effects = improve.read_shared_effects(model, args.effects_from)
    _check_without(args, (*robot.catalogue, *shared_effects.effects), model)
    with show_activity("deriving the robot of the model"):
        compiled, logs = improve.read_log_sets(model, args.logs, args.holdout, args.map, True)
    with show_progress("looking for missing effects") as bar:
        diagnosis = improve.find_missing(
            model, compiled, logs, args.without, bar, args.discover, shared_effects
        )
    better, left_out = model, tuple[str, ...]()
    if args.add:
        with show_activity("adding what was found"):
            better, left_out = improve.add_proposals(
                model, compiled, logs, diagnosis, shared_effects
            )
        save_model(args.out, better)
    following = views.suggest_after_diagnosis(
        args.model, args.logs, args.holdout, diagnosis, args.effects_from
    )
    if args.report is not None or args.picture is not None:
        file_names = [Path(place).name for place in (*args.logs, *args.holdout)]
        provenance = [
            f"model: {model.spec.robot}, {len(model.beta)} base parameters, fitted on "
            f"{', '.join(log.name for log in model.logs)}",
            f"logs explained: {', '.join(file_names[: len(args.logs)])}",
            *model.warning,
        ]
        origin = views.Origin(args.model, file_names, bool(diagnosis.held_out_logs), following)
        with show_activity("drawing"):
            page = views.build_diagnosis_page(diagnosis, provenance, origin)
    print_lines([*format_lines(diagnosis), *model.warning])
    draw_page(args.report, lambda: page)
    draw_pictures(args.picture, lambda: page.collect_pictures())
    if args.add:
        print_lines([*format_waterfall(better), *describe_last_addition(better), *left_out])
        print_lines([args.out], "written: ")
        return diagnosis.to_json() | {"not_added": list(left_out)}
    show_next(following)
    return diagnosis.to_json()


def _check_without(
    args: argparse.Namespace, catalogue: Sequence[Effect], model: IdentifiedModel
) -> None:
    """Refuses effects that there are not, then joints."""
    known = [effect.id for effect in catalogue]
    names = [joint.name for joint in model.spec.joints]
    closure = model.spec.closure
    passive = closure.variables if closure is not None else ()
    for text in args.without:
        name = text.partition("@")[0]
        if find_effect(name, catalogue) is None:
            raise DataError(
                f"--without {text}: no such effect{suggest_name(name, known)}; expected one of "
                f"{', '.join(known)}"
            )
    for text in args.without:
        joint = text.partition("@")[2]
        if "@" in text and joint not in {*names, *passive}:
            raise DataError(
                f"--without {text}: no joint {joint}; expected one of {', '.join(names)}"
            )


def run_add(args: argparse.Namespace) -> Json:
    """Adds, saves, draws the waterfall."""
    if args.joint is not None and args.effect in ("auto", "undo"):
        raise DataError(
            f"--joint {args.joint}: `{args.effect}` takes no joint; expected one effect with "
            "--joint, or leave it out"
        )
    if args.effects_from is not None and args.effect in (LEARNED, "undo"):
        raise DataError(
            f"--effects-from {args.effects_from}: got it with {args.effect}; expected an effect of "
            "the folder, or auto"
        )
    law = _parse_law(args)
    model = load_model(args.model)
    shared_effects = improve.read_shared_effects(model, args.effects_from)
    with show_activity("deriving the robot of the model"):
        compiled, logs = improve.read_log_sets(model, args.logs, args.holdout, args.map)
    left_out: tuple[str, ...] = ()
    if args.effect == "auto":
        with show_progress("looking for missing effects") as bar:
            better, left_out, _ = improve.add_all_missing(
                model, compiled, logs, bar, show_activity, args.learned, shared_effects
            )
    elif args.effect == LEARNED:
        with show_progress("learning a law") as bar:
            better = add_learned_law(model, compiled, args.joint, logs, law, bar)
    elif args.effect == "undo":
        with show_activity("fitting without the last effect"):
            better = remove_last_effect(model, logs)
    else:
        with show_activity(f"adding {args.effect}"):
            model = improve.define_shared_effect(model, shared_effects, args.effect)
            better = add_effect(model, compiled, args.effect, args.joint, logs)
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
    steps = [step.to_json() for step in better.history]
    return better.fit.to_json() | {"waterfall": steps, "not_added": list(left_out)}


def _parse_law(args: argparse.Namespace) -> LawRequest:
    """What the options say of a law.

    Raises:
        DataError: some stand beside another effect.
    """
    rising = {"rising": 1, "falling": -1, None: 0}[args.monotone]
    of = tuple(part.strip() for part in (args.of or "").split(",") if part.strip())
    law = LawRequest(of, args.odd, rising)
    if args.effect != LEARNED and law != ANY_LAW:
        raise DataError(
            f"--of, --odd, --monotone: got them with {args.effect}; expected `modeler add MODEL "
            f"{LEARNED}`"
        )
    if args.learned and args.effect != "auto":
        raise DataError(f"--learned: got it with {args.effect}; expected `modeler add MODEL auto`")
    return law


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
