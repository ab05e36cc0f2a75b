"""One effect more: described, derived, emitted, fitted, and judged on other motion."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.codegen import derive, generate
from modeler.core.errors import DataError, RobotError
from modeler.core.manifest import ModuleSpec
from modeler.core.table import percent
from modeler.diagnosis.added_model import (
    HoldoutRows,
    Logs,
    catalogue_of,
    described,
    left_of,
    left_out,
    not_needed,
    rows_of,
    with_law,
    with_shapes,
)
from modeler.diagnosis.candidates import Candidate, StatedEffects, links_of, passive_joints
from modeler.diagnosis.diagnosis import kept_parameters
from modeler.diagnosis.drive_gains import gain_visible, is_gain
from modeler.diagnosis.effect_columns import body_parameters
from modeler.diagnosis.learn import ANY_LAW, LawAsked, Learned, learn
from modeler.diagnosis.plausible import objection
from modeler.diagnosis.profile import values_of
from modeler.diagnosis.result import HIDDEN, JOINTED, Pick, doubt, why_not_added
from modeler.diagnosis.score import Residuals, Score, errors_of, no_better, rms_error, scored
from modeler.diagnosis.search import extended, scan_candidates, scan_catalogue
from modeler.diagnosis.sentences import where
from modeler.diagnosis.state import SearchData, State, analysed, state_of
from modeler.diagnosis.timing import instrumental
from modeler.effects import Acts, Effect, effect_named
from modeler.estimation import Addition, IdentifiedModel, identify, provenance, with_verdict
from modeler.robot import listed, near, robot_from_text
from modeler.runtime import CompiledModel, load

if TYPE_CHECKING:
    from modeler.diagnosis.result import Finding


# Effects on joints without motor: robot files may have them there.


def reads_speed_only(effect: Effect) -> bool:
    """True for effects of a joint that read its speed and have no shapes."""
    form = effect.forms[0]
    return effect.acts is Acts.JOINT and not form.shapes and form.names <= {"v"}


# What `add` is asked for, checked before any log is looked at.


def requested_effect(model: IdentifiedModel, name: str, joint: str | None) -> Effect:
    """The effect of that name, if it can go into the model on that joint.

    Args:
        model: as it is.
        name: id or alias of the effect.
        joint: name; None: whichever, or the whole robot.

    Raises:
        DataError: no such effect or joint, one that cannot be added, that is there already, or
            that acts on the whole robot while a joint is named.
    """
    catalogue = catalogue_of(model)
    effect = effect_named(name, catalogue)
    if effect is None:
        raise DataError(
            f"{name}: no such effect{near(name, [known.id for known in catalogue])}; `modeler "
            "effects` lists them, with --robot FILE those of a robot file too"
        )
    if why := why_not_added(effect, model.spec):
        raise DataError(f"{effect.id}: cannot be added ({why})")
    jointed = effect.acts in JOINTED
    if joint is not None:
        _check_joint(model.spec, effect, joint)
    if effect.several or not jointed:  # there may be several orders of ripples
        return effect
    present = {p.joint for p in model.spec.standard if p.effect == effect.id}
    motors = {joint.name for joint in model.spec.joints if joint.actuated}
    if joint in present or (joint is None and present and present >= motors):
        where_it_is = "every joint" if joint is None else f"joint {joint}"
        raise DataError(f"{effect.id}: {where_it_is} has it in this model already")
    return effect


def _check_joint(spec: ModuleSpec, effect: Effect, joint: str) -> None:
    """Effects act on joints with a motor, on joints that loops leave over, or on links."""
    jointed, passive = effect.acts in JOINTED, list(passive_joints(spec))
    if not jointed and (effect.acts is not Acts.LINK or effect.last_link):
        raise DataError(
            f"--joint {joint}: {effect.id} acts on the whole robot, not on one joint; leave "
            "--joint out"
        )
    usual = [own.name for own in spec.joints if own.actuated]
    usual += passive if reads_speed_only(effect) else []
    names = {Acts.LINK: links_of(spec), Acts.PASSIVE: passive}.get(effect.acts, usual)
    if joint not in names and joint in passive and jointed:
        raise DataError(
            f"--joint {joint}: it has no motor, and there {effect.id} cannot be found from logs; "
            "write it into the robot file, or add viscous, coulomb or passive_friction"
        )
    if joint not in names:
        raise DataError(f"--joint {joint}: no such joint; expected one of {listed(names)}")
    if read := effect.forms[0].reads_as_other(joint):
        raise DataError(
            f"--joint {joint}: {effect.id} reads {listed(read)} of it as of another joint; name "
            "another, or leave --joint out"
        )


@dataclass(frozen=True, eq=False)
class _Fitted:
    """A model, and the logs as its robot sees them.

    Attributes:
        model: as fitted; its last effect has no verdict yet.
        rows: of the logs.
        free: (c, k) base parameters that were fitted, by what they are made of; None: all.
    """

    model: IdentifiedModel
    rows: HoldoutRows
    free: np.ndarray | None = None

    def unseen(self, refitted: bool) -> Residuals:
        """What it leaves of held-out logs; where there are none, of its own logs in turn."""
        if not self.rows.logs.held_out and (refitted or self.free is not None):
            return left_out(self.model, self.rows.fitted, self.free)
        return left_of(self.model, self.rows.compiled, self.rows.seen[-1])

    def with_history(self, steps: tuple[Addition, ...]) -> "_Fitted":
        """The same model by these steps."""
        model = dataclasses.replace(self.model, history=steps)
        return dataclasses.replace(self, model=model)


@threadpool_limits.wrap(limits=1, user_api="blas")  # small matrices: a second thread only waits
def add_effect(
    model: IdentifiedModel, compiled: CompiledModel, name: str, joint: str | None, logs: Logs
) -> IdentifiedModel:
    """The model with one effect more, fitted to the logs.

    Its shapes are those that explain the logs best.

    Args:
        model: as it is.
        compiled: its robot.
        name: id or alias of the effect.
        joint: None: the joint that it explains most on, or the whole robot.
        logs: to fit, and to judge on.

    Raises:
        DataError: no such effect, one that is there already, cannot be told from the logs, or
            cannot be added.
    """
    effect = requested_effect(model, name, joint)
    before = _Fitted(model, rows_of(compiled, logs, model.processing))
    pick = _found(before, effect, joint)
    after, score = _judged(before, pick)
    *steps, last = after.model.history
    moved = _moved(model, after.model) if effect.learned else {}
    last = dataclasses.replace(last, moved=moved, doubt=_why_perhaps(pick, score))
    return _finished(after.with_history((*steps, last)))


@threadpool_limits.wrap(limits=1, user_api="blas")
def add_learned(
    model: IdentifiedModel, compiled: CompiledModel, joint: str | None, logs: Logs,
    asked: LawAsked = ANY_LAW, progress: Callable[[float], None] | None = None,
) -> IdentifiedModel:  # fmt: skip
    """The model with a learned law more, fitted together with its parameters.

    Args:
        model: as it is.
        compiled: its robot.
        joint: None: the one on which a law explains most.
        logs: to fit, and to judge on.
        asked: of what the law is a function, and its form.
        progress: called with the share that is done.

    Raises:
        DataError: no such joint or quantity, or no law that lowers the error by more than chance.
    """
    motors = [own.name for own in model.spec.joints if own.actuated]
    if joint is not None and joint not in motors:
        raise DataError(f"--joint {joint}: no such joint; expected one of {listed(motors)}")
    before = _Fitted(model, rows_of(compiled, logs, model.processing))
    state, every = _state(before), [joint] if joint is not None else motors
    laws = list[tuple[str, Learned]]()
    for count, name in enumerate(every):
        law = learn(state, state.names.index(name), asked)
        laws += [(name, law)] if law is not None and law.significant else []
        if progress is not None:
            progress((count + 1) / len(every))
    on = where(joint) if joint is not None else "any joint"
    if not laws:
        raise DataError(
            f"learned: nothing is added: no law{asked.told} explains more than chance on {on}"
        )
    name, law = max(laws, key=lambda found: float(found[1].drop.sum()))
    text, pick = with_law(model.robot_text, state, name, law)
    named = dataclasses.replace(before, model=dataclasses.replace(model, robot_text=text))
    after, score = _judged(named, pick)
    if not score.better:
        raise DataError(
            f"learned: nothing is added: with a law of {law.coordinates.told} on {where(name)} "
            f"{no_better(score.errors, score.changed)}"
        )
    *steps, last = after.model.history
    moved = _moved(model, after.model)
    far = [f"{own} by {moved[own]:.2g}" for own in moved if moved[own] > MOVED]
    doubt = f"it moves {listed(far)} of their sigmas: the law says what these said" if far else ""
    return _finished(
        after.with_history((*steps, dataclasses.replace(last, moved=moved, doubt=doubt)))
    )


def add_laws(
    model: IdentifiedModel, compiled: CompiledModel, logs: Logs
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with a learned law on every joint where that lowers the error; why not on others.

    One after the other, each judged beside those that were put in before it.
    """
    left = []
    for joint in [own.name for own in model.spec.joints if own.actuated]:
        try:
            model = add_learned(model, compiled, joint, logs)
        except DataError as error:
            left.append(f"left out: learned, {where(joint)} ({str(error).split(': ', 2)[-1]})")
        else:
            compiled = load(model.spec, model.sources)
    return model, tuple(left)


MOVED = 2.0
"""Sigmas beyond which a law that is learned changes what a parameter means."""


def _moved(before: IdentifiedModel, after: IdentifiedModel) -> dict[str, float]:
    """Of every base parameter of both, how many of its sigmas it moved."""
    now = {p.name: p.value for p in after.fit.parameters}
    return {
        p.name: abs(now[p.name] - p.value) / p.sigma
        for p in before.fit.parameters if p.sigma and p.name in now
    }  # fmt: skip


def _why_perhaps(pick: Pick, score: Score) -> str:
    """Why an effect that was asked for is no more than a perhaps; empty if it may be named."""
    candidate, whole = pick.candidate, score.whole
    errors = score.errors.get(candidate.joint or "", (whole.before, whole.after))
    against = ""
    if candidate in pick.state.picks:
        named = values_of(pick.state, candidate, pick.values, np.zeros(len(pick.values)))
        against = objection(pick.state, candidate, named.value | dict(candidate.shapes))
    return doubt(candidate, errors, against)


@threadpool_limits.wrap(limits=1, user_api="blas")
def add_findings(
    model: IdentifiedModel, compiled: CompiledModel, findings: Sequence["Finding"], logs: Logs
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with the effects of a diagnosis that lower the error; why others are left out.

    What a diagnosis says with a doubt is left out. One after the other; each is judged beside those
    that were put in before it, by `scored`. Drive gains come first and are judged together where
    that lowers the error: one of two wrong gains alone may spoil other joints. What has no value
    above its sigma once everything is in is taken out again. A reason is one line that names the
    effect and its joint.
    """
    left = [
        f"left out: {f.effect}, {where(f.joint)} (perhaps and no more: {f.doubt})"
        for f in findings if f.doubt
    ]  # fmt: skip
    best = _Fitted(model, rows_of(compiled, logs, model.processing))
    best, rest = _with_gains(best, [f for f in findings if not f.doubt])
    for finding in rest:
        try:
            requested_effect(best.model, finding.effect, finding.joint)
            assert finding.pick is not None  # `requested_effect` refuses what is no column
            after, score = _judged(best, finding.pick)
        except (DataError, RobotError) as error:
            left.append(f"left out: {finding.effect}, {where(finding.joint)} ({error})")
            continue
        if score.better:
            best = after
        else:
            why = no_better(score.errors, score.changed)
            left.append(f"left out: {finding.effect}, {where(finding.joint)} ({why})")
    if best.model is model:
        return model, tuple(left)
    better = _finished(best)
    idle = [(s.effect, s.joint) for s in better.history[1:] if not_needed(better, s)]
    for finding in reversed(findings):  # one after the other, the last that was found first
        if (finding.effect, finding.joint) in idle:
            needed = [f for f in findings if f is not finding]
            better, others = add_findings(model, compiled, needed, logs)
            why = "with the others in, none of its values is above its sigma"
            return better, (*others, f"left out: {finding.effect}, {where(finding.joint)} ({why})")
    return better, tuple(left)


def _with_gains(
    before: _Fitted, findings: Sequence["Finding"]
) -> tuple[_Fitted, Sequence["Finding"]]:
    """The model with all drive gains, if there are several and it is better; what is left."""
    gains = [f for f in findings if f.pick is not None and is_gain(f.pick.candidate)]
    if len(gains) < 2:
        return before, findings
    after = before
    try:
        for finding in gains:
            assert finding.pick is not None
            after = _judged(after, finding.pick)[0]
    except (DataError, RobotError):
        return before, findings
    if not scored(before.unseen(True), after.unseen(True)).better:
        return before, findings
    steps = after.model.history
    done = [dataclasses.replace(step, falls=True) for step in steps[-len(gains) :]]
    after = after.with_history((*steps[: -len(gains)], *done))
    return after, [f for f in findings if f not in gains]


def undone(model: IdentifiedModel, logs: Logs) -> IdentifiedModel:
    """The model without the effect that was added last, fitted again.

    Raises:
        DataError: none was added.
    """
    if len(model.history) < 2:
        raise DataError("undo: no effect was added to this model; name one to add")
    before = model.history[-2]
    processing = dataclasses.replace(model.processing, delay=before.delay)
    fitted = _fitted(
        model, before.robot_text, lambda made: rows_of(made, Logs(logs.fitted), processing)
    )
    return _finished(fitted.with_history(model.history[:-1]))


def _state(before: _Fitted, effect: Effect | None = None) -> State:
    """What the model leaves of the logs, in the band of a diagnosis."""
    model, rows = before.model, before.rows
    robot = robot_from_text(model.robot_text, "robot of the model")
    observation = analysed(
        rows.compiled, rows.logs.fitted, model.processing, prepared=rows.prepared[0]
    )
    kept = kept_parameters(model, rows.compiled, rows.logs.fitted, observation)
    if effect is not None and effect.acts is Acts.LINK and kept is None:
        kept = model.beta
    data = SearchData(
        rows.compiled, observation, kept, StatedEffects(robot.catalogue, robot.coupling)
    )
    return state_of(data, (), model.beta)


def _found(before: _Fitted, effect: Effect, joint: str | None) -> Pick:
    """The effect at its best shapes, about the model with it."""
    state = _state(before, effect)
    place = passive_joints(state.spec).get(joint or "")
    if place is not None and reads_speed_only(effect):
        if state.spec.closure is not None:  # felt by all motors, by the speed that loops give it
            effect = dataclasses.replace(effect, acts=Acts.PASSIVE)
        scan = scan_candidates(state, [Candidate(effect, effect.forms[0], joint, place)])
    else:
        scan = scan_catalogue(state, only=effect.id, joint=joint)
    ranked = scan.judged().ranked
    if not ranked:
        raise DataError(
            f"{effect.id}: these logs show nothing of it; `modeler effects {effect.id}` says which "
            "motion would"
        )
    candidate, visible = ranked[0].candidate, ranked[0].visible
    if effect.acts is Acts.TORQUE:  # least squares make delays too small
        return Pick(candidate, instrumental(state, candidate)[0], state, visible)
    later = extended(state, candidate)  # a wrong gain bends the model whose torques it scales
    if is_gain(candidate):
        visible = gain_visible(later, 0)
    return Pick(candidate, later.values[0], later, visible)


def _judged(before: _Fitted, pick: Pick) -> tuple[_Fitted, Score]:
    """The model with the effect, and whether it is the better one."""
    effect = pick.candidate.effect
    if pick.visible < HIDDEN:  # it would take its values from the model that is there
        raise DataError(
            f"{effect.id}: cannot be told from what the model has on these logs "
            f"({percent(pick.visible)} of it is left); {effect.look_alikes}"
        )
    after, refitted = _with(before, pick), effect.acts is not Acts.LINK
    score = scored(before.unseen(refitted), after.unseen(refitted))
    if not score.joints:
        raise DataError("no joint has a torque in these logs; expected logs of a robot that moves")
    history = before.model.history or (_step(before, {n: a for n, (a, _) in score.errors.items()}),)
    step = dataclasses.replace(
        _step(after, {n: b for n, (_, b) in score.errors.items()}),
        effect=effect.id,
        joint=pick.candidate.joint,
        shapes=dict(pick.candidate.shapes),
        joints=score.errors,
        changed=score.changed,
        falls=score.better,
    )
    return after.with_history((*history, step)), score


def _step(fitted: _Fitted, errors: Mapping[str, float]) -> Addition:
    """A model as a step of its history.

    Args:
        fitted: it.
        errors: relative, by joint, on unseen motion.
    """
    training = errors_of(left_of(fitted.model, fitted.rows.compiled, fitted.rows.fitted))
    return Addition(
        effect="",
        joint=None,
        shapes={},
        error=rms_error(errors.values()),
        training_error=rms_error(training.values()),
        held_out=tuple(log.name for log in fitted.rows.logs.held_out),
        robot_text=fitted.model.robot_text,
        delay=fitted.model.processing.delay,
        joints={name: (error, error) for name, error in errors.items()},
    )


def _with(before: _Fitted, pick: Pick) -> _Fitted:
    """The model with the effect, fitted; with a body more on a link, nothing else is."""
    model, rows, effect = before.model, before.rows, pick.candidate.effect
    if effect.acts is Acts.LINK:
        felt = [p.name for p in body_parameters(pick.candidate, pick.state.rows.signals[0])]
        names = [p.name for p in model.spec.standard]
        chi = np.eye(len(names))[[names.index(name) for name in felt]]
        free = np.column_stack([rows.compiled.base_parameters(one) for one in chi])
        pairs = zip(model.fit.parameters, model.beta + free @ pick.values, strict=True)
        parameters = tuple(dataclasses.replace(p, value=float(v)) for p, v in pairs)
        fit = dataclasses.replace(model.fit, parameters=parameters)
        return _Fitted(dataclasses.replace(model, fit=fit), rows, free)
    if effect.acts is Acts.TORQUE:
        seen = pick.state.data.observation.report.processing
        processing = dataclasses.replace(model.processing, delay=seen.delay + float(pick.values[0]))
        return _fitted(model, model.robot_text, lambda made: rows_of(made, rows.logs, processing))
    text = described(model.robot_text, pick.candidate, pick.values, pick.state.reference)
    return _fitted(model, text, rows.of)


def _finished(fitted: _Fitted) -> IdentifiedModel:
    """The model with the spread along its shapes, and its verdict."""
    model, rows = fitted.model, fitted.rows
    wide = analysed(rows.compiled, rows.logs.fitted, model.processing, prepared=rows.prepared[0])
    model = with_shapes(model, rows.compiled, wide)
    fit = with_verdict(rows.compiled, rows.fitted, model.fit)
    return dataclasses.replace(model, fit=fit)


def _fitted(
    before: IdentifiedModel, text: str, seen: Callable[[CompiledModel], HoldoutRows]
) -> _Fitted:
    """The robot of that file fitted to the logs, which are read as those of the model before."""
    derivation = derive(robot_from_text(text, "robot with the effect"))
    emitted = generate(derivation)
    rows = seen(load(emitted.spec, emitted.code))
    fit, used = identify(rows.fitted, "weighted", rows.compiled), provenance(rows.fitted.report)
    model = IdentifiedModel(text, emitted.spec, emitted.code, fit, used, mapping=before.mapping)
    return _Fitted(model, rows)
