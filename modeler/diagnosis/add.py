"""One effect more: described, derived, emitted, fitted, and judged on other motion."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.codegen import derive, generate
from modeler.core.errors import DataError, RobotError
from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.diagnosis import candidates, result, scoring
from modeler.diagnosis.added_model import (
    LogRows,
    LogSplit,
    add_nonlinear_uncertainty,
    build_rows,
    compute_residuals,
    cross_validate_residuals,
    insert_candidate,
    insert_law,
    is_unneeded,
    read_catalogue,
)
from modeler.diagnosis.diagnosis import find_fixed_parameters
from modeler.diagnosis.events import detect_pushes, leave_out
from modeler.diagnosis.generation import estimate_instrumental
from modeler.diagnosis.learn import ANY_LAW, LawRequest, LearnedLaw, learn_law
from modeler.diagnosis.messages import format_location
from modeler.diagnosis.plausibility import compute_gain_visibility, find_caveat, is_gain
from modeler.diagnosis.profile import name_parameters, polish_nonlinear_parameters
from modeler.diagnosis.search import extend_state, scan_candidates, scan_catalogue
from modeler.diagnosis.state import SearchData, State, analyse_logs, build_state, observe_in_band
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget, find_effect
from modeler.estimation import Addition, IdentifiedModel, collect_provenance, identify, judge_fit
from modeler.regression import Observation
from modeler.robot import join_names, parse_robot_text, suggest_name
from modeler.runtime import CompiledModel, load_module

# Effects on joints without motor: robot files may have them there.


def is_speed_effect(effect: Effect) -> bool:
    """Returns whether an effect of a joint depends on its speed alone."""
    form, local = effect.forms[0], effect.acts is EffectTarget.JOINT
    return local and not form.nonlinear_parameters and form.names <= {"v"}


# What `add` is requested, checked before any log is looked at.


def resolve_effect(model: IdentifiedModel, name: str, joint: str | None) -> Effect:
    """Returns the effect of that name, if it can go into the model on that joint.

    Args:
        model: as it is.
        name: id or alias of the effect.
        joint: name; None: whichever, or the whole robot.

    Raises:
        DataError: no such effect or joint, one that cannot be added, that is there already, or
            that acts on the whole robot while a joint is named.
    """
    catalogue = read_catalogue(model)
    effect = find_effect(name, catalogue)
    if effect is None:
        near = suggest_name(name, [known.id for known in catalogue])
        raise DataError(
            f"{name}: no such effect{near}; "
            "`modeler effects` lists them, with --robot FILE those of a robot file too"
        )
    if why := result.explain_exclusion(effect, model.spec):
        raise DataError(f"{effect.id}: cannot be added ({why})")
    if joint is not None:
        _check_joint(model.spec, effect, joint)
    if (
        effect.is_repeatable or effect.acts not in result.JOINTED
    ):  # several orders of ripples may be
        return effect
    present = {p.joint for p in model.spec.standard if p.effect == effect.id}
    if joint in present or (joint is None and present and present >= {*_list_motors(model.spec)}):
        where_it_is = "every joint" if joint is None else f"joint {joint}"
        raise DataError(f"{effect.id}: {where_it_is} has it in this model already")
    return effect


def _check_joint(spec: ModuleSpec, effect: Effect, joint: str) -> None:
    """Effects act on joints with a motor, on joints that loops leave over, or on links."""
    jointed, passive = effect.acts in result.JOINTED, list(candidates.find_passive_joints(spec))
    if not jointed and (effect.acts is not EffectTarget.LINK or effect.is_on_last_link):
        raise DataError(
            f"--joint {joint}: {effect.id} acts on the whole robot, not on one joint; leave "
            "--joint out"
        )
    names = _list_motors(spec) + (passive if is_speed_effect(effect) else [])
    if effect.acts in (EffectTarget.LINK, EffectTarget.PASSIVE):
        names = candidates.list_links(spec) if effect.acts is EffectTarget.LINK else passive
    if joint not in names and joint in passive and jointed:
        raise DataError(
            f"--joint {joint}: it has no motor, and there {effect.id} cannot be found from logs; "
            "write it into the robot file, or add viscous, coulomb or passive_friction"
        )
    if joint not in names:
        raise DataError(f"--joint {joint}: no such joint; expected one of {join_names(names)}")
    if read := effect.forms[0].find_references_to(joint):
        raise DataError(
            f"--joint {joint}: {effect.id} reads {join_names(read)} of it as of another joint; "
            "name another, or leave --joint out"
        )


def _list_motors(spec: ModuleSpec) -> list[str]:
    return [joint.name for joint in spec.joints if joint.actuated]


_Findings = Sequence[result.Finding]


@dataclass(frozen=True, eq=False)
class _FittedModel:
    """A model, and the logs as its robot sees them.

    Attributes:
        model: as fitted; its last effect has no verdict yet.
        rows: of the logs.
        free: (c, k) base parameters that were fitted, by what they are made of; None: all.
    """

    model: IdentifiedModel
    rows: LogRows
    free: np.ndarray | None = None

    def compute_held_out_residuals(self, refitted: bool) -> scoring.Residuals:
        """Returns residuals on held-out logs; without any, cross-validated ones of its own logs."""
        if not self.rows.logs.held_out and (refitted or self.free is not None):
            return cross_validate_residuals(self.model, self.rows.fit_observation, self.free)
        return compute_residuals(self.model, self.rows.compiled, self.rows.observations[-1])

    def analyse(self) -> Observation:
        """Analyses the training logs, in the band of a diagnosis."""
        logs, first = self.rows.logs.training, self.rows.prepared[0]
        return analyse_logs(self.rows.compiled, logs, self.model.processing, prepared=first)

    def replace_history(self, steps: tuple[Addition, ...]) -> "_FittedModel":
        """Returns the model with another history."""
        return replace(self, model=replace(self.model, history=steps))

    def complete_step(self, **notes: Any) -> IdentifiedModel:
        """Completes the model, with notes on its last step."""
        *steps, last = self.model.history
        return _complete_model(self.replace_history((*steps, replace(last, **notes))))


@threadpool_limits.wrap(limits=1, user_api="blas")  # small matrices: a second thread only waits
def add_effect(
    model: IdentifiedModel, compiled: CompiledModel, name: str, joint: str | None, logs: LogSplit
) -> IdentifiedModel:
    """Adds one effect to the model and fits it to the logs.

    Its shapes are those that explain the logs best.

    Args:
        model: as it is.
        compiled: its robot.
        name: id or alias of the effect.
        joint: None: the joint that it explains most on, or the whole robot.
        logs: to fit, and to judge on.

    Raises:
        DataError: no such effect, one that is there already, cannot be distinguished from the logs,
            or cannot be added.
    """
    effect = resolve_effect(model, name, joint)
    before = _FittedModel(model, build_rows(compiled, logs, model.processing))
    if effect.acts is EffectTarget.WINDOW:
        return _leave_out_pushes(before, effect)[0].complete_step()
    pick = _select_candidate(before, effect, joint)
    after, score = _score_addition(before, pick)
    moved = _compute_parameter_shifts(model, after.model) if effect.is_learned else {}
    return after.complete_step(shifts_in_sigmas=moved, warning=_explain_weak_evidence(pick, score))


@threadpool_limits.wrap(limits=1, user_api="blas")
def add_learned_law(
    model: IdentifiedModel,
    compiled: CompiledModel,
    joint: str | None,
    logs: LogSplit,
    request: LawRequest = ANY_LAW,
    progress: Callable[[float], None] | None = None,
) -> IdentifiedModel:
    """Adds a learned law to the model and fits both together.

    Args:
        model: as it is.
        compiled: its robot.
        joint: None: the one on which a law explains most.
        logs: to fit, and to judge on.
        request: of what the law is a function, and its form.
        progress: called with the share that is done.

    Raises:
        DataError: no such joint or quantity, or no law that lowers the error by more than chance.
    """
    motors = _list_motors(model.spec)
    if joint is not None and joint not in motors:
        raise DataError(f"--joint {joint}: no such joint; expected one of {join_names(motors)}")
    before = _FittedModel(model, build_rows(compiled, logs, model.processing))
    state, every = _build_state(before), [joint] if joint is not None else motors
    laws = list[tuple[str, LearnedLaw]]()
    for count, name in enumerate(every):
        law = learn_law(state, state.joint_names.index(name), request)
        laws += [(name, law)] if law is not None and law.is_significant else []
        if progress is not None:
            progress((count + 1) / len(every))
    if not laws:
        place = format_location(joint) if joint is not None else "any joint"
        what = f"no law{request.description} explains more than chance on {place}"
        raise DataError(f"learned: nothing is added: {what}")
    name, law = max(laws, key=lambda pair: float(pair[1].reductions.sum()))
    text, pick = insert_law(model.robot_text, state, name, law)
    named = replace(before, model=replace(model, robot_text=text))
    after, score = _score_addition(named, pick)
    if not score.is_better:
        what = f"a law of {law.coordinates.description} on {format_location(name)}"
        why = scoring.explain_no_improvement(score.errors, score.changed_joints)
        raise DataError(f"learned: nothing is added: with {what} {why}")
    moved = _compute_parameter_shifts(model, after.model)
    most = THRESHOLDS.max_parameter_shift
    far = [f"{name} by {shift:.2g}" for name, shift in moved.items() if shift > most]
    doubt = (
        f"it moves {join_names(far)} of their sigmas: the law says what these said" if far else ""
    )
    return after.complete_step(shifts_in_sigmas=moved, warning=doubt)


def add_learned_laws(
    model: IdentifiedModel, compiled: CompiledModel, logs: LogSplit
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """Adds a learned law on every joint where it lowers the error; says why not on others.

    One after the other, each judged beside those that were put in before it.
    """
    left = []
    for joint in _list_motors(model.spec):
        try:
            model = add_learned_law(model, compiled, joint, logs)
        except DataError as error:
            left.append(_describe_omission("learned", joint, str(error).split(": ", 2)[-1]))
        else:
            compiled = load_module(model.spec, model.sources)
    return model, tuple(left)


def _describe_omission(effect: str, joint: str | None, why: object) -> str:
    return f"left out: {effect}, {format_location(joint)} ({why})"


def _compute_parameter_shifts(before: IdentifiedModel, after: IdentifiedModel) -> dict[str, float]:
    """Of every base parameter of both, how many of its sigmas it moved."""
    now = {p.name: p.value for p in after.fit.parameters}
    known = (p for p in before.fit.parameters if p.sigma and p.name in now)
    return {p.name: abs(now[p.name] - p.value) / p.sigma for p in known if p.sigma}


def _explain_weak_evidence(pick: result.FittedCandidate, score: scoring.Score) -> str:
    """Why an effect that was requested is possible only; empty if it may be named."""
    candidate, whole = pick.candidate, score.whole
    errors = whole.before, whole.after
    if candidate.elastic is None:  # an elastic joint moves all links behind it
        errors = score.errors.get(candidate.joint or "", errors)
    against = ""
    if candidate in pick.state.picks:
        parameters = name_parameters(pick.state, candidate, pick.values)
        against = find_caveat(pick.state, candidate, parameters)
    return result.explain_weak_evidence(candidate, errors, against)


@threadpool_limits.wrap(limits=1, user_api="blas")
def add_findings(
    model: IdentifiedModel, compiled: CompiledModel, findings: _Findings, logs: LogSplit
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """Adds the effects of a diagnosis that lower the error; says why others are left out.

    What a diagnosis says with a warning is left out. One after the other; each is judged beside
    those that were put in before it, by `score_change`. Drive gains come first and are judged
    together
    where that lowers the error: one of two wrong gains alone may spoil other joints. What has no
    value above its sigma once everything is in is taken out again. A reason is one line that names
    the effect and its joint.
    """
    doubted = [f for f in findings if f.warning]
    left = [_describe_omission(f.effect, f.joint, f"weak evidence: {f.warning}") for f in doubted]
    best = _FittedModel(model, build_rows(compiled, logs, model.processing))
    best, rest = _add_drive_gains(best, [f for f in findings if not f.warning])
    for finding in sorted(rest, key=lambda one: not one.is_event):  # all others are found beside it
        try:
            effect = resolve_effect(best.model, finding.effect, finding.joint)
            if finding.pick is None:  # `resolve_effect` refuses what is neither column nor event
                after, score = _leave_out_pushes(best, effect)
            else:
                after, score = _score_addition(best, finding.pick)
        except (DataError, RobotError) as error:
            left.append(_describe_omission(finding.effect, finding.joint, error))
            continue
        if score.is_better:
            best = after
        else:
            why = scoring.explain_no_improvement(score.errors, score.changed_joints)
            left.append(_describe_omission(finding.effect, finding.joint, why))
    if best.model is model:
        return model, tuple(left)
    better = _complete_model(best)
    idle = [(s.effect, s.joint) for s in better.history[1:] if is_unneeded(better, s)]
    for finding in reversed(findings):  # one after the other, the last that was found first
        if (finding.effect, finding.joint) in idle:
            needed = [f for f in findings if f is not finding]
            better, others = add_findings(model, compiled, needed, logs)
            why = "with the others in, none of its values is above its sigma"
            return better, (*others, _describe_omission(finding.effect, finding.joint, why))
    return better, tuple(left)


def _add_drive_gains(before: _FittedModel, findings: _Findings) -> tuple[_FittedModel, _Findings]:
    """The model with all drive gains, if there are several and it is better; what is left."""
    gains = {id(f): f.pick for f in findings if f.pick is not None and is_gain(f.pick.candidate)}
    if len(gains) < 2:
        return before, findings
    after = before
    try:
        for pick in gains.values():
            after = _score_addition(after, pick)[0]
    except (DataError, RobotError):
        return before, findings
    first, last = (one.compute_held_out_residuals(True) for one in (before, after))
    if not scoring.score_change(first, last).is_better:
        return before, findings
    steps = after.model.history
    done = [replace(step, is_improvement=True) for step in steps[-len(gains) :]]
    after = after.replace_history((*steps[: -len(gains)], *done))
    return after, [f for f in findings if id(f) not in gains]


def remove_last_effect(model: IdentifiedModel, logs: LogSplit) -> IdentifiedModel:
    """Removes the effect that was added last and fits the rest again.

    Raises:
        DataError: none was added.
    """
    if len(model.history) < 2:
        raise DataError("undo: no effect was added to this model; name one to add")
    before, training = model.history[-2], LogSplit(logs.training)
    processing = replace(model.processing, delay=before.delay, pushes=before.pushes)
    build = partial(build_rows, logs=training, processing=processing)
    fitted = _fit_robot_file(model, before.robot_text, build)
    return _complete_model(fitted.replace_history(model.history[:-1]))


def _build_state(before: _FittedModel, effect: Effect | None = None) -> State:
    """What the model leaves of the logs, in the band of a diagnosis."""
    model, rows = before.model, before.rows
    robot = parse_robot_text(model.robot_text, "robot of the model")
    observation = before.analyse()
    fixed = find_fixed_parameters(model, rows.compiled, rows.logs.training, observation)
    if effect is not None and effect.acts is EffectTarget.LINK and fixed is None:
        fixed = model.beta
    known = candidates.StatedEffects(robot.catalogue, robot.coupling)
    return build_state(SearchData(rows.compiled, observation, fixed, known), (), model.beta)


def _select_candidate(
    before: _FittedModel, effect: Effect, joint: str | None
) -> result.FittedCandidate:
    """The effect at its best shapes, about the model with it."""
    state = _build_state(before, effect)
    place = candidates.find_passive_joints(state.spec).get(joint or "")
    if place is not None and is_speed_effect(effect):
        if state.spec.closure is not None:  # acting on all motors, by the speed that loops give it
            effect = replace(effect, acts=EffectTarget.PASSIVE)
        scan = scan_candidates(state, [candidates.Candidate(effect, effect.forms[0], joint, place)])
    else:
        scan = scan_catalogue(state, only=effect.id, joint=joint)
    ranked = scan.judge_candidates().ranked
    if not ranked:
        raise DataError(
            f"{effect.id}: these logs show nothing of it; `modeler effects {effect.id}` says which "
            "motion would"
        )
    candidate, visible = ranked[0].candidate, ranked[0].visible_share
    if effect.is_oscillator and candidate.elastic is None:
        raise DataError(
            f"{effect.id}: no resonance of {format_location(candidate.joint)} explains these logs; "
            "move faster, with more changes of acceleration"
        )
    if effect.acts is EffectTarget.TORQUE:  # least squares make delays too small
        delay = estimate_instrumental(state, candidate)[0]
        return result.FittedCandidate(candidate, delay, state, visible)
    later = extend_state(state, candidate)  # a wrong gain bends the model whose torques it scales
    if candidate.loop:
        state = build_state(leave_out(state.data, None, [candidate]), (), state.beta)
        candidate = polish_nonlinear_parameters(extend_state(state, candidate), 0)
        later = extend_state(state, candidate)
    if is_gain(candidate):
        visible = compute_gain_visibility(later, 0)
    return result.FittedCandidate(candidate, later.values[0], later, visible)


def _score_addition(
    before: _FittedModel, pick: result.FittedCandidate
) -> tuple[_FittedModel, scoring.Score]:
    """The model with the effect, and whether it is the better one."""
    effect = pick.candidate.effect
    if pick.visible_share < THRESHOLDS.min_addable_share:  # the model would give it its values
        raise DataError(
            f"{effect.id}: cannot be distinguished from what the model has on these logs "
            f"({format_percent(pick.visible_share)} of it is left); {effect.confounders}"
        )
    after, refitted = _fit_with_candidate(before, pick), effect.acts is not EffectTarget.LINK
    same = before
    if before.model.spec.signals != after.model.spec.signals:  # states are unknown in other rows
        same = replace(before, rows=before.rows.restrict_to(after.rows))
    first, last = (one.compute_held_out_residuals(refitted) for one in (same, after))
    score = scoring.score_change(first, last)
    if not score.joints:
        raise DataError("no joint has a torque in these logs; expected logs of a robot that moves")
    shapes = dict(pick.candidate.nonlinear_parameters)
    notes = {"joint": pick.candidate.joint, "nonlinear_parameters": shapes}
    return _append_step(before, after, score, effect=effect.id, **notes), score


def _append_step(
    before: _FittedModel, after: _FittedModel, score: scoring.Score, **notes: Any
) -> _FittedModel:
    """The model after a change, with that as a step of its history."""
    history = before.model.history or (_build_history_step(before, score, 0),)
    changed, notes = score.changed_joints, {"is_improvement": score.is_better, **notes}
    step = _build_history_step(after, score, 1)
    step = replace(step, joints=score.errors, changed_joints=changed, **notes)
    return after.replace_history((*history, step))


def _leave_out_pushes(before: _FittedModel, effect: Effect) -> tuple[_FittedModel, scoring.Score]:
    """The model fitted without the windows in which something pushed, and whether it is better.

    Both are judged on the rows that are left; held-out logs have windows of their own.
    """
    state, model, logs = _build_state(before), before.model, before.rows.logs
    data, other, processing = state.data, None, model.processing
    if logs.held_out:
        used = data.observation.report.processing
        seen = observe_in_band(before.rows.compiled, logs.held_out, used)
        other = replace(data, observation=seen)
    window, held_out = detect_pushes(state, data, other)
    for some, push in ((logs.training, window), (logs.held_out, held_out)):
        if push is not None and push.change is not None:
            processing = processing.add_push(some[push.log], *push.span)
    if processing is model.processing:
        raise DataError(
            f"{effect.id}: no torque acts once in these logs and stands out from what the model "
            "leaves elsewhere; nothing is left out"
        )
    build = partial(build_rows, logs=logs, processing=processing)
    after = _fit_robot_file(model, model.robot_text, build)
    rest = replace(before, rows=after.rows)
    first, last = rest.compute_held_out_residuals(False), after.compute_held_out_residuals(True)
    score, reports = scoring.score_change(first, last), [x.report for x in after.rows.observations]
    said = tuple(line for report in reports for line in report.describe_pushes())
    falls = score.is_better or window is None  # then the fit is as it was
    notes = {"effect": effect.id, "left_out": said, "is_improvement": falls}
    return _append_step(before, after, score, **notes), score


def _build_history_step(fitted: _FittedModel, score: scoring.Score, side: int) -> Addition:
    """A model as a step of its history, with the errors of one side of a score."""
    model, rows = fitted.model, fitted.rows
    left = compute_residuals(model, rows.compiled, rows.fit_observation)
    errors = {name: pair[side] for name, pair in score.errors.items()}
    error, every = scoring.compute_rms_error(errors.values()), scoring.compute_errors(left)
    fit_errors = [value for name, value in every.items() if name in errors]
    held_out = tuple(log.name for log in rows.logs.held_out)
    joints = {name: (error, error) for name, error in errors.items()}
    shapes = dict[str, float]()
    start = "", None, shapes, error, scoring.compute_rms_error(fit_errors), held_out
    used = model.processing
    return Addition(*start, model.robot_text, used.delay, joints=joints, pushes=used.pushes)


def _fit_with_candidate(before: _FittedModel, pick: result.FittedCandidate) -> _FittedModel:
    """The model with the effect, fitted; with a body more on a link, nothing else is."""
    model, rows, effect = before.model, before.rows, pick.candidate.effect
    if effect.acts is EffectTarget.LINK:
        body = candidates.list_body_parameters(pick.candidate, pick.state.rows.signals[0])
        names = [p.name for p in model.spec.standard]
        chi = np.eye(len(names))[[names.index(p.name) for p in body]]
        free = np.column_stack([rows.compiled.base_parameters(one) for one in chi])
        pairs = zip(model.fit.parameters, model.beta + free @ pick.values, strict=True)
        parameters = tuple(replace(p, value=float(v)) for p, v in pairs)
        fit = replace(model.fit, parameters=parameters)
        return _FittedModel(replace(model, fit=fit), rows, free)
    if effect.acts is EffectTarget.TORQUE:
        seen = pick.state.data.observation.report.processing
        processing = replace(model.processing, delay=seen.delay + float(pick.values[0]))
        build = partial(build_rows, logs=rows.logs, processing=processing)
        return _fit_robot_file(model, model.robot_text, build)
    text = insert_candidate(model.robot_text, pick.candidate, pick.values, pick.state.reference)
    return _fit_robot_file(model, text, rows.rebuild_for)


def _complete_model(fitted: _FittedModel) -> IdentifiedModel:
    """The model with the spread along its shapes, and its verdict."""
    model, rows = fitted.model, fitted.rows
    model = add_nonlinear_uncertainty(model, rows.compiled, fitted.analyse())
    return replace(model, fit=judge_fit(rows.compiled, rows.fit_observation, model.fit))


def _fit_robot_file(
    before: IdentifiedModel, text: str, observe: Callable[[CompiledModel], LogRows]
) -> _FittedModel:
    """The robot of that file fitted to the logs, which are read as those of the model before."""
    emitted = generate(derive(parse_robot_text(text, "robot with the effect")))
    rows = observe(load_module(emitted.spec, emitted.code))
    fit = identify(rows.fit_observation, "weighted", rows.compiled)
    if fit.elastic:
        rows = rows.rebuild_for(rows.compiled.set_windup(fit.beta, fit.elastic_values))
    used = collect_provenance(rows.fit_observation.report)
    model = IdentifiedModel(text, emitted.spec, emitted.code, fit, used, mapping=before.mapping)
    return _FittedModel(model, rows)
