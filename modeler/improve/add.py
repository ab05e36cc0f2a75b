"""One effect more: described, derived, emitted, fitted, and judged on other motion."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.compiled import CompiledModel, load
from modeler.core.errors import DataError, RobotError
from modeler.derivation import derive, generate
from modeler.diagnose.analyse import analysed
from modeler.diagnose.diagnosis import kept_parameters
from modeler.diagnose.judge import Judged
from modeler.diagnose.result import Pick
from modeler.diagnose.search import extended
from modeler.diagnose.sentences import where
from modeler.diagnose.survey import survey_of, surveyed
from modeler.effects import Acts, Effect
from modeler.fit import Addition, IdentifiedModel, identify, provenance, with_verdict
from modeler.hypotheses.candidates import Known
from modeler.hypotheses.columns import body_parameters
from modeler.improve.ask import asked
from modeler.improve.describe import described
from modeler.improve.passive import on_passive
from modeler.improve.rows import Logs, Rows, left_of, left_out, rows_of
from modeler.improve.sure import with_shapes
from modeler.robot import robot_from_text
from modeler.scoring.gains import gain_visible, is_gain
from modeler.scoring.score import Score, Unseen, errors_of, printed, rms_error, scored, told
from modeler.scoring.state import Data, State, state_of
from modeler.scoring.timing import instrumental

if TYPE_CHECKING:
    from modeler.diagnose import Finding

_HIDDEN = 0.01  # share of its columns below which the logs do not show an effect


@dataclass(frozen=True, eq=False)
class _Fitted:
    """A model, and the logs as its robot sees them.

    Attributes:
        model: as fitted; its last effect has no verdict yet.
        rows: of the logs.
        free: (c, k) base parameters that were fitted, by what they are made of; None: all.
    """

    model: IdentifiedModel
    rows: Rows
    free: np.ndarray | None = None

    def unseen(self, refitted: bool) -> Unseen:
        """What it leaves of held-out logs; where there are none, of its own logs in turn."""
        if not self.rows.held_out and (refitted or self.free is not None):
            return left_out(self.model, self.rows.fitted, self.free)
        return left_of(self.model, self.rows.compiled, self.rows.seen[-1])


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
    effect = asked(model, name, joint, robot_from_text(model.robot_text, "robot").catalogue)
    before = _Fitted(model, rows_of(compiled, logs, model.processing))
    after, _ = _judged(before, _found(before, effect, joint))
    return _finished(after)


@threadpool_limits.wrap(limits=1, user_api="blas")
def add_findings(
    model: IdentifiedModel, compiled: CompiledModel, findings: Sequence["Finding"], logs: Logs
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with the effects of a diagnosis that lower the error; why others are left out.

    One after the other; each is judged beside those that were put in before it, by `scored`. Drive
    gains come first and are judged together where that lowers the error: one of two wrong gains
    alone may spoil other joints. A reason is one line that names the effect and its joint.
    """
    left, best = [], _Fitted(model, rows_of(compiled, logs, model.processing))
    best, findings = _with_gains(best, findings)
    for finding in findings:
        try:
            catalogue = robot_from_text(best.model.robot_text, "robot").catalogue
            asked(best.model, finding.effect, finding.joint, catalogue)
            assert finding.pick is not None  # `asked` refuses what is no column
            after, score = _judged(best, finding.pick)
        except (DataError, RobotError) as error:
            left.append(f"left out: {finding.effect}, {where(finding.joint)} ({error})")
            continue
        if score.better:
            best = after
        else:
            left.append(f"left out: {finding.effect}, {where(finding.joint)} ({_refused(score)})")
    return model if best.model is model else _finished(best), tuple(left)


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
    model = dataclasses.replace(after.model, history=(*steps[: -len(gains)], *done))
    return dataclasses.replace(after, model=model), [f for f in findings if f not in gains]


def _refused(score: Score) -> str:
    """Why a change is none for the better."""
    if score.spoilt:
        return f"the error rises: {told(score.errors, score.changed)}"
    total = " -> ".join(printed(score.whole.before, score.whole.after))
    return (
        "the error does not fall by more than chance: "
        f"{total} over all joints; {told(score.errors, score.changed)}"
    )


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
        before.robot_text, lambda compiled: rows_of(compiled, Logs(logs.fitted), processing)
    )
    history = dataclasses.replace(fitted.model, history=model.history[:-1])
    return _finished(dataclasses.replace(fitted, model=history))


def _found(before: _Fitted, effect: Effect, joint: str | None) -> Pick:
    """The effect at its best shapes, about the model with it."""
    model, rows = before.model, before.rows
    robot = robot_from_text(model.robot_text, "robot of the model")
    observation = analysed(
        rows.compiled, rows.logs.fitted, model.processing, prepared=rows.prepared[0]
    )
    kept = kept_parameters(model, rows.compiled, rows.logs.fitted, observation)
    if effect.acts is Acts.LINK and kept is None:
        kept = model.beta
    data = Data(rows.compiled, observation, kept, Known(robot.catalogue, robot.coupling))
    state = state_of(data, (), model.beta)
    best = _best(state, effect, joint)
    if effect.acts is Acts.TORQUE:  # least squares make delays too small
        values = instrumental(state, best.candidate)[0]
        return Pick(best.candidate, values, state, best.visible)
    later = extended(state, best.candidate)  # a wrong gain bends the model whose torques it scales
    visible = gain_visible(later, 0) if is_gain(best.candidate) else best.visible
    return Pick(best.candidate, later.values[0], later, visible)


def _best(state: State, effect: Effect, joint: str | None) -> Judged:
    """The effect at its best shapes."""
    passive = on_passive(state.data.compiled.spec, effect, joint)
    asked_for = (
        surveyed(state, only=effect.id, joint=joint) if passive is None
        else survey_of(state, [passive])
    )  # fmt: skip
    found = asked_for.judged().ranked
    if not found:
        raise DataError(
            f"{effect.id}: these logs show nothing of it; `modeler effects {effect.id}` says which "
            "motion would"
        )
    return found[0]


def _check_seen(pick: Pick) -> None:
    """Refuse what would take its values from the model that is there."""
    if pick.visible < _HIDDEN:
        effect = pick.candidate.effect
        raise DataError(
            f"{effect.id}: cannot be told from what the model has on these logs "
            f"({100 * pick.visible:.1g} % of it is left); {effect.look_alikes}"
        )


def _judged(before: _Fitted, pick: Pick) -> tuple[_Fitted, Score]:
    """The model with the effect, and whether it is the better one."""
    _check_seen(pick)
    after = _with(before, pick)
    refitted = pick.candidate.effect.acts is not Acts.LINK
    score = scored(before.unseen(refitted), after.unseen(refitted))
    if not score.joints:
        raise DataError("no joint has a torque in these logs; expected logs of a robot that moves")
    history = before.model.history or (_step(before, {n: a for n, (a, _) in score.errors.items()}),)
    step = dataclasses.replace(
        _step(after, {n: b for n, (_, b) in score.errors.items()}),
        effect=pick.candidate.effect.id,
        joint=pick.candidate.joint,
        shapes=dict(pick.candidate.shapes),
        joints=score.errors,
        changed=score.changed,
        falls=score.better,
    )
    model = dataclasses.replace(after.model, history=(*history, step))
    return dataclasses.replace(after, model=model), score


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
    """The model with the effect, fitted."""
    model, rows, effect = before.model, before.rows, pick.candidate.effect
    if effect.acts is Acts.LINK:
        felt = [p.name for p in body_parameters(pick.candidate, pick.state.rows.signals[0])]
        names = [p.name for p in model.spec.standard]
        chi = np.eye(len(names))[[names.index(name) for name in felt]]
        free = np.column_stack([rows.compiled.base_parameters(one) for one in chi])
        return _Fitted(_loaded(model, free @ pick.values), rows, free)
    if effect.acts is Acts.TORQUE:
        seen = pick.state.data.observation.report.processing
        processing = dataclasses.replace(model.processing, delay=seen.delay + float(pick.values[0]))
        return _fitted(model.robot_text, lambda made: rows_of(made, rows.logs, processing))
    text = described(model.robot_text, pick.candidate, pick.values, pick.state.reference)
    return _fitted(text, rows.of)


def _finished(fitted: _Fitted) -> IdentifiedModel:
    """The model with the spread along its shapes, and its verdict."""
    model, rows = fitted.model, fitted.rows
    wide = analysed(rows.compiled, rows.logs.fitted, model.processing, prepared=rows.prepared[0])
    model = with_shapes(model, rows.compiled, wide)
    fit = with_verdict(rows.compiled, rows.fitted, model.fit)
    return dataclasses.replace(model, fit=fit)


def _fitted(text: str, seen: Callable[[CompiledModel], Rows]) -> _Fitted:
    """The robot of that file fitted to the logs."""
    derivation = derive(robot_from_text(text, "robot with the effect"))
    emitted = generate(derivation)
    rows = seen(load(emitted.spec, emitted.code))
    fit, used = identify(rows.fitted), provenance(rows.fitted.report)
    return _Fitted(IdentifiedModel(text, emitted.spec, emitted.code, fit, used), rows)


def _loaded(model: IdentifiedModel, body: np.ndarray) -> IdentifiedModel:
    """The model with a body more on a link: its base parameters (c,), nothing else."""
    pairs = zip(model.fit.parameters, model.beta + body, strict=True)
    parameters = tuple(dataclasses.replace(p, value=float(v)) for p, v in pairs)
    return dataclasses.replace(model, fit=dataclasses.replace(model.fit, parameters=parameters))
