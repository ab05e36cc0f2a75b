"""Effects into a model: one by its name, all that a diagnosis names; the last one out again."""

from __future__ import annotations  # what a signature names need not be loaded

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path

from modeler import diagnosis
from modeler.api.log_maps import Mapped
from modeler.api.workflow import Logs, M, Steps, compile, ignore_step, read_logs
from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.regression import check_no_overlap
from modeler.robot import (
    Robot,
    SharedEffects,
    collect_shared_effects,
    insert_own_effect,
    parse_robot_text,
)
from modeler.runtime import CompiledModel

_NONE = SharedEffects()


def diagnose(
    model: IdentifiedModel,
    logs: Logs,
    holdout: Logs = (),
    without: Sequence[str] = (),
    progress: Callable[[float], None] | None = None,
    mapping: Mapped = (),
    discover: bool = False,
    effects_from: str | Path | None = None,
) -> diagnosis.Diagnosis:
    """Finds the physical effects that the model lacks; errors come from held-out logs if any.

    >>> found = diagnose(model, ["mon.parquet"], ["tue.parquet"])
    >>> found.effects[0].effect, found.effects[0].joint
    ('spring', '1')

    Args:
        model: as it is.
        logs: to explain.
        holdout: logs of other motion to judge on.
        without: ids of effects, or id@joint, that the robot does not have.
        progress: called with the share that is done.
        mapping: as of `read_logs`.
        discover: True to propose equations for what has no name: `discoveries` of the result.
        effects_from: folder of files that `modeler effects --export` wrote, whose effects the robot
            may have too.
    """
    shared_effects = read_shared_effects(model, effects_from)
    compiled, log_sets = read_log_sets(model, logs, holdout, mapping, spread=True)
    return find_missing(model, compiled, log_sets, without, progress, discover, shared_effects)


def add_discoveries(
    model: M,
    diagnosis_result: diagnosis.Diagnosis,
    logs: Logs,
    holdout: Logs = (),
    mapping: Mapped = (),
    effects_from: str | Path | None = None,
) -> M:
    """Adds the first proposed equation of each joint where that lowers the error.

    >>> found = diagnose(model, ["mon.parquet"], ["tue.parquet"], discover=True)
    >>> better = add_discoveries(model, found, ["mon.parquet"], ["tue.parquet"])
    >>> better.error("tue.parquet") <= model.error("tue.parquet")
    True

    Args:
        model: as it was diagnosed.
        diagnosis_result: the diagnosis, with `discover`.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        mapping: as of `read_logs`.
        effects_from: as of the diagnosis.
    """
    shared_effects = read_shared_effects(model, effects_from)
    compiled, log_sets = read_log_sets(model, logs, holdout, mapping)
    return restore_class(
        model, add_proposals(model, compiled, log_sets, diagnosis_result, shared_effects)[0]
    )


def add_proposals(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.LogSplit,
    diagnosis_result: diagnosis.Diagnosis,
    more: SharedEffects = _NONE,
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """Adds the first proposal of each joint and the effects that it stands beside.

    And a line on what is left out.
    """
    firsts = [
        discovery.proposals[0]
        for discovery in diagnosis_result.discoveries or ()
        if discovery.proposals
    ]
    if not firsts:
        return model, ("left out: nothing was found",)
    text = more.insert_definitions(
        model.robot_text,
        [f.effect for f in [*diagnosis_result.effects, *diagnosis_result.refinements]],
    )
    for first in firsts:
        text = insert_own_effect(text, first.finding.effect, first.definition)
    replaced = {
        (name, discovery.finding.joint)
        for discovery in firsts
        for name in discovery.replaced_effects
    }
    beside = [
        f
        for f in (*diagnosis_result.effects, *diagnosis_result.refinements)
        if (f.effect, f.joint) not in replaced
    ]
    named = dataclasses.replace(model, robot_text=text)
    findings = [*beside, *(first.finding for first in firsts)]
    better, left_out = diagnosis.add_findings(named, compiled, findings, logs)
    return (model if better is named else better), left_out


def add(
    model: M,
    effect: str,
    logs: Logs,
    holdout: Logs = (),
    joint: str | None = None,
    mapping: Mapped = (),
    law: diagnosis.LawRequest | None = None,
    effects_from: str | Path | None = None,
) -> M:
    """Adds one effect and fits again; `table("waterfall")` lists the errors.

    >>> better = add(model, "spring", ["mon.parquet"], ["tue.parquet"], joint="1")
    >>> better.table("waterfall").column("effect")
    ['as fitted', 'spring']

    Args:
        model: as it is.
        effect: id, see `effects()`; "learned": a smooth law, for what has no name.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        joint: None: where it explains most.
        mapping: as of `read_logs`.
        law: of what a learned law is a function, and its form; None: whatever predicts best.
        effects_from: folder of files that `modeler effects --export` wrote, whose effects the robot
            may have too.

    Raises:
        DataError: no such effect, one that is there already, cannot be distinguished from the logs,
            or cannot be added.
    """
    model = define_shared_effect(model, read_shared_effects(model, effects_from), effect)
    compiled, log_sets = read_log_sets(model, logs, holdout, mapping)
    if effect == diagnosis.LEARNED:
        return restore_class(
            model,
            diagnosis.add_learned_law(model, compiled, joint, log_sets, law or diagnosis.ANY_LAW),
        )
    return restore_class(model, diagnosis.add_effect(model, compiled, effect, joint, log_sets))


def add_all(
    model: M,
    logs: Logs,
    holdout: Logs = (),
    progress: Callable[[float], None] | None = None,
    mapping: Mapped = (),
    learned: bool = False,
    effects_from: str | Path | None = None,
) -> M:
    """Adds all effects that a diagnosis finds and that lower the error.

    >>> better = add_all(model, ["mon.parquet"], ["tue.parquet"])
    >>> [step.effect for step in better.history[1:]]
    ['spring']

    Args:
        model: as it is.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        progress: called with the share that is done.
        mapping: as of `read_logs`.
        learned: True for a learned law of each joint at last, of what is left.
        effects_from: folder of files that `modeler effects --export` wrote, whose effects the robot
            may have too.

    Raises:
        DataError: nothing that can be added is missing.
    """
    shared_effects = read_shared_effects(model, effects_from)
    compiled, log_sets = read_log_sets(model, logs, holdout, mapping)
    return restore_class(
        model,
        add_all_missing(model, compiled, log_sets, progress, ignore_step, learned, shared_effects)[
            0
        ],
    )


def remove_last(model: M, logs: Logs, mapping: Mapped = ()) -> M:
    """Removes the effect that was added last and fits again.

    >>> better = add(model, "spring", ["mon.parquet"], joint="1")
    >>> [step.effect for step in remove_last(better, ["mon.parquet"]).history[1:]]
    []

    Raises:
        DataError: none was added.
    """
    return restore_class(
        model, diagnosis.remove_last_effect(model, read_log_sets(model, logs, (), mapping)[1])
    )


def restore_class(model: M, result: IdentifiedModel) -> M:
    """Returns the result as an object of the class of the model."""
    fields = {f.name: getattr(result, f.name) for f in dataclasses.fields(IdentifiedModel)}
    return dataclasses.replace(model, **{**fields, "mapping": model.mapping})


def add_all_missing(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.LogSplit,
    progress: Callable[[float], None] | None = None,
    report_step: Steps = ignore_step,
    learned: bool = False,
    more: SharedEffects = _NONE,
) -> tuple[IdentifiedModel, tuple[str, ...], diagnosis.Diagnosis]:
    """Adds what a diagnosis finds; returns the model, why some is left out, and the diagnosis.

    Raises:
        DataError: nothing that can be added is missing.
    """
    diagnosis_result = find_missing(model, compiled, logs, (), progress, more=more)
    findings = [*diagnosis_result.effects, *diagnosis_result.refinements]
    named = dataclasses.replace(
        model, robot_text=more.insert_definitions(model.robot_text, [f.effect for f in findings])
    )
    with report_step("adding what is missing"):
        better, left_out = diagnosis.add_findings(named, compiled, findings, logs)
    better = model if better is named else better
    if learned:
        with report_step("learning laws"):
            better, idle = diagnosis.add_learned_laws(better, compile(better), logs)
        left_out = (*left_out, *idle)
    if better is model and not left_out:
        raise DataError(
            "auto: nothing is added, because nothing that can be added is missing in this model "
            f"({diagnosis_result.sentences[0]})"
        )
    return better, left_out, diagnosis_result


def find_missing(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.LogSplit,
    without: Sequence[str] = (),
    progress: Callable[[float], None] | None = None,
    equations: bool = False,
    more: SharedEffects = _NONE,
) -> diagnosis.Diagnosis:
    """Runs a diagnosis that also tries the effects that the robot file defines.

    And those of a folder; why some of these are left out stands among its sentences.
    """
    robot = _read_model_robot(model)
    known = diagnosis.StatedEffects((*robot.catalogue, *more.effects), robot.coupling)
    diagnosis_result = diagnosis.diagnose(
        model, compiled, logs.training, logs.held_out, without, progress=progress, known=known,
        equations=equations,
    )  # fmt: skip
    laws = {e.id: "a learned law, no physics" for e in more.effects if e.is_learned}
    left = [f"left out: {name} ({why})" for name, why in {**more.left_out, **laws}.items()]
    return dataclasses.replace(diagnosis_result, sentences=(*diagnosis_result.sentences, *left))


def _read_model_robot(model: IdentifiedModel) -> Robot:
    return parse_robot_text(model.robot_text, f"model of {model.spec.robot}, robot")


def read_shared_effects(model: IdentifiedModel, folder: str | Path | None) -> SharedEffects:
    """Reads the effects of a folder that the robot may have too; none without a folder."""
    return _NONE if folder is None else collect_shared_effects(_read_model_robot(model), folder)


def define_shared_effect(model: M, more: SharedEffects, effect: str) -> M:
    """Adds the definition of an effect of a folder to the robot text of a model.

    Raises:
        DataError: it is one that the robot cannot have.
    """
    if effect in more.left_out:
        raise DataError(f"{effect} of {more.left_out[effect]}; expected another effect")
    return dataclasses.replace(
        model, robot_text=more.insert_definitions(model.robot_text, [effect])
    )


def read_log_sets(
    model: IdentifiedModel, logs: Logs, holdout: Logs, mapping: Mapped = (), spread: bool = False
) -> tuple[CompiledModel, diagnosis.LogSplit]:
    """Compiles the robot of a model and reads its logs.

    Of long logs segments where `spread` is true, see `read_logs`.

    Raises:
        DataError: a log cannot be read, or rows are given twice.
    """
    compiled = compile(model)
    every = (read_logs(compiled, some, mapping, spread) for some in (logs, holdout))
    log_sets = diagnosis.LogSplit(*every)
    check_no_overlap(log_sets.training, log_sets.held_out)
    return compiled, log_sets
