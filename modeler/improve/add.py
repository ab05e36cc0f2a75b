"""One effect more: described, derived, emitted, fitted, and with_verdict on other motion."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.compare.predict import on_rows
from modeler.compare.prediction import check_prediction, relative_error
from modeler.compiled import CompiledModel, load
from modeler.core.errors import DataError
from modeler.derivation import derive, generate
from modeler.diagnose.analyse import analysed
from modeler.diagnose.candidates import Candidate, Known
from modeler.diagnose.columns import body_parameters
from modeler.diagnose.diagnosis import kept_parameters
from modeler.diagnose.judge import Judged
from modeler.diagnose.search import surveyed
from modeler.diagnose.state import Data, State, state_of
from modeler.diagnose.timing import instrumental
from modeler.effects import Acts, Effect
from modeler.fit import Addition, IdentifiedModel, identify, provenance, with_verdict
from modeler.improve.ask import asked
from modeler.improve.describe import described
from modeler.improve.rows import Logs, Rows, rows_of
from modeler.improve.sure import with_shapes
from modeler.observation import Observation
from modeler.observation.torque import model_torque
from modeler.robot import robot_from_text

if TYPE_CHECKING:
    from modeler.diagnose import Finding

_HIDDEN = 0.01  # share of its columns below which the logs do not show an effect


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
    robot = robot_from_text(model.robot_text, "robot of the model")
    effect = asked(model, name, joint, robot.catalogue)
    rows = rows_of(compiled, logs, model.processing)
    observation = analysed(compiled, logs.fitted, model.processing, prepared=rows.prepared[0])
    kept = kept_parameters(model, compiled, logs.fitted, observation)
    if effect.acts is Acts.LINK and kept is None:
        kept = model.beta
    data = Data(compiled, observation, kept, Known(robot.catalogue, robot.coupling))
    state = state_of(data, (), model.beta)
    best = _best(state, effect, joint)
    values = best.values
    if effect.acts is Acts.TORQUE:  # least squares make delays too small
        values = instrumental(state, best.candidate)[0]
    return _added(model, rows, state, best.candidate, values)


def add_findings(
    model: IdentifiedModel, compiled: CompiledModel, findings: Sequence["Finding"], logs: Logs
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with the effects of a diagnosis, one after the other; why others are left out.

    A reason is one line that names the effect and its joint.
    """
    left_out = []
    for finding in findings:
        try:
            model = add_effect(model, compiled, finding.effect, finding.joint, logs)
        except DataError as error:
            place = f", joint {finding.joint}" if finding.joint is not None else ""
            left_out.append(f"left out: {finding.effect}{place} ({error})")
            continue
        compiled = load(model.spec, model.sources)
    return model, tuple(left_out)


def undone(model: IdentifiedModel, logs: Logs) -> IdentifiedModel:
    """The model without the effect that was added last, fitted again.

    Raises:
        DataError: none was added.
    """
    if len(model.history) < 2:
        raise DataError("undo: no effect was added to this model; name one to add")
    before = model.history[-2]
    processing = dataclasses.replace(model.processing, delay=before.delay)
    fitted, rows = _fitted(
        before.robot_text, lambda compiled: rows_of(compiled, Logs(logs.fitted), processing)
    )
    return _finished(fitted, model.history[:-1], rows)


def _best(state: State, effect: Effect, joint: str | None) -> Judged:
    """The effect at its best shapes."""
    found = surveyed(state, only=effect.id, joint=joint).judged().ranked
    if not found:
        raise DataError(
            f"{effect.id}: these logs show nothing of it; `modeler effects {effect.id}` says which "
            "motion would"
        )
    best = found[0]
    if best.visible < _HIDDEN:
        raise DataError(
            f"{effect.id}: cannot be told from what the model has on these logs "
            f"({100 * best.visible:.1g} % of it is left); {effect.look_alikes}"
        )
    return best


def _added(
    model: IdentifiedModel, rows: Rows, state: State, pick: Candidate, values: np.ndarray
) -> IdentifiedModel:
    history = model.history or (_step(model, None, rows),)
    if pick.effect.acts is Acts.LINK:
        felt = [p.name for p in body_parameters(pick, state.rows.signals[0])]
        better, seen = _loaded(model, rows.compiled, felt, values), rows
    elif pick.effect.acts is Acts.TORQUE:
        delay = model.processing.delay + float(values[0])
        processing = dataclasses.replace(model.processing, delay=delay)
        better, seen = _fitted(model.robot_text, lambda made: rows_of(made, rows.logs, processing))
    else:
        better, seen = _fitted(described(model.robot_text, pick, values, state.reference), rows.of)
    return _finished(better, (*history, _step(better, pick, seen)), seen)


def _finished(model: IdentifiedModel, history: Sequence[Addition], rows: Rows) -> IdentifiedModel:
    """The model with its history, the spread along its shapes, and its verdict."""
    model = dataclasses.replace(model, history=tuple(history))
    wide = analysed(rows.compiled, rows.logs.fitted, model.processing, prepared=rows.prepared[0])
    model = with_shapes(model, rows.compiled, wide)
    fit = with_verdict(rows.compiled, rows.fitted, model.fit)
    return dataclasses.replace(model, fit=fit)


def _fitted(text: str, seen: Callable[[CompiledModel], Rows]) -> tuple[IdentifiedModel, Rows]:
    """The robot of that file fitted to the logs, and their rows."""
    derivation = derive(robot_from_text(text, "robot with the effect"))
    emitted = generate(derivation)
    rows = seen(load(emitted.spec, emitted.files))
    fit, used = identify(rows.fitted), provenance(rows.fitted.report)
    return IdentifiedModel(text, emitted.spec, emitted.files, fit, used), rows


def _loaded(
    model: IdentifiedModel, compiled: CompiledModel, felt: Sequence[str], values: np.ndarray
) -> IdentifiedModel:
    """The model with a body more on a link: its base parameters, nothing else."""
    chi = np.zeros(len(model.spec.standard))
    for name, value in zip(felt, values, strict=True):
        chi[[p.name for p in model.spec.standard].index(name)] = value
    beta = model.beta + compiled.base_parameters(chi)
    pairs = zip(model.fit.parameters, beta, strict=True)
    parameters = tuple(dataclasses.replace(p, value=float(v)) for p, v in pairs)
    return dataclasses.replace(model, fit=dataclasses.replace(model.fit, parameters=parameters))


def _step(model: IdentifiedModel, pick: Candidate | None, rows: Rows) -> Addition:
    """The error of a model, as a step of its history."""
    training, *held_out = [_error(model, rows.compiled, seen) for seen in rows.seen]
    return Addition(
        effect=pick.effect.id if pick else "",
        joint=pick.joint if pick else None,
        shapes=dict(pick.shapes) if pick else {},
        error=held_out[0] if held_out else training,
        training_error=training,
        held_out=tuple(log.name for log in rows.logs.held_out),
        robot_text=model.robot_text,
        delay=model.processing.delay,
    )


def _error(model: IdentifiedModel, compiled: CompiledModel, seen: Observation) -> float:
    """Relative error over all joints."""
    prediction = on_rows(seen, model_torque(seen, compiled, model.beta))
    check_prediction(prediction)
    return relative_error(prediction)
