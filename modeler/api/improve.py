"""Effects into a model: one by its name, all that a diagnosis names; the last one out again."""

from __future__ import annotations  # what a signature names need not be loaded

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path

from modeler import diagnosis
from modeler.api.log_maps import Mapped
from modeler.api.steps import Steps, silent
from modeler.api.workflow import Logs, M, read_logs, recompile
from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.observation import check_apart
from modeler.robot import Robot, SharedEffects, robot_from_text, shared_effects, with_own_effect
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
    """Which physical effect the model lacks on logs; errors from the held-out logs if given.

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
    more = shared_of(model, effects_from)
    compiled, given = logs_of(model, logs, holdout, mapping, spread=True)
    return missing(model, compiled, given, without, progress, discover, more)


def add_discoveries(
    model: M,
    found: diagnosis.Diagnosis,
    logs: Logs,
    holdout: Logs = (),
    mapping: Mapped = (),
    effects_from: str | Path | None = None,
) -> M:
    """The model with the first equation proposed for each joint, where that lowers the error.

    >>> found = diagnose(model, ["mon.parquet"], ["tue.parquet"], discover=True)
    >>> better = add_discoveries(model, found, ["mon.parquet"], ["tue.parquet"])
    >>> better.error("tue.parquet") <= model.error("tue.parquet")
    True

    Args:
        model: as it was diagnosed.
        found: the diagnosis, with `discover`.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        mapping: as of `read_logs`.
        effects_from: as of the diagnosis.
    """
    more = shared_of(model, effects_from)
    compiled, given = logs_of(model, logs, holdout, mapping)
    return like(model, discovered_added(model, compiled, given, found, more)[0])


def discovered_added(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.Logs,
    found: diagnosis.Diagnosis,
    more: SharedEffects = _NONE,
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """The model with the first proposal of each joint and the effects that it stands beside.

    And a line on what is left out.
    """
    firsts = [own.proposals[0] for own in found.discoveries or () if own.proposals]
    if not firsts:
        return model, ("left out: nothing was found",)
    text = more.written(model.robot_text, [f.effect for f in [*found.effects, *found.refinements]])
    for first in firsts:
        text = with_own_effect(text, first.finding.effect, first.definition)
    replaced = {(name, own.finding.joint) for own in firsts for name in own.instead}
    beside = [
        f for f in (*found.effects, *found.refinements) if (f.effect, f.joint) not in replaced
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
    law: diagnosis.LawAsked | None = None,
    effects_from: str | Path | None = None,
) -> M:
    """The model with one effect more, fitted to the logs; `table("waterfall")` says what it gained.

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
        DataError: no such effect, one that is there already, cannot be told from the logs, or
            cannot be added.
    """
    model = with_shared(model, shared_of(model, effects_from), effect)
    compiled, given = logs_of(model, logs, holdout, mapping)
    if effect == diagnosis.LEARNED:
        return like(
            model, diagnosis.add_learned(model, compiled, joint, given, law or diagnosis.ANY_LAW)
        )
    return like(model, diagnosis.add_effect(model, compiled, effect, joint, given))


def auto(
    model: M,
    logs: Logs,
    holdout: Logs = (),
    progress: Callable[[float], None] | None = None,
    mapping: Mapped = (),
    learned: bool = False,
    effects_from: str | Path | None = None,
) -> M:
    """The model with all that a diagnosis on these logs names and that lowers the error.

    >>> better = auto(model, ["mon.parquet"], ["tue.parquet"])
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
    more = shared_of(model, effects_from)
    compiled, given = logs_of(model, logs, holdout, mapping)
    return like(model, auto_added(model, compiled, given, progress, silent, learned, more)[0])


def undo(model: M, logs: Logs, mapping: Mapped = ()) -> M:
    """The model without the effect that was added last, fitted again to the logs.

    >>> better = add(model, "spring", ["mon.parquet"], joint="1")
    >>> [step.effect for step in undo(better, ["mon.parquet"]).history[1:]]
    []

    Raises:
        DataError: none was added.
    """
    return like(model, diagnosis.undone(model, logs_of(model, logs, (), mapping)[1]))


def like(model: M, made: IdentifiedModel) -> M:
    """What was made of a model, as an object of its class."""
    found = {f.name: getattr(made, f.name) for f in dataclasses.fields(IdentifiedModel)}
    return dataclasses.replace(model, **{**found, "mapping": model.mapping})


def auto_added(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.Logs,
    progress: Callable[[float], None] | None = None,
    working: Steps = silent,
    learned: bool = False,
    more: SharedEffects = _NONE,
) -> tuple[IdentifiedModel, tuple[str, ...], diagnosis.Diagnosis]:
    """The model with what a diagnosis names, why some of it is left out, and the diagnosis.

    Raises:
        DataError: nothing that can be added is missing.
    """
    found = missing(model, compiled, logs, (), progress, more=more)
    findings = [*found.effects, *found.refinements]
    named = dataclasses.replace(
        model, robot_text=more.written(model.robot_text, [f.effect for f in findings])
    )
    with working("adding what is missing"):
        better, left_out = diagnosis.add_findings(named, compiled, findings, logs)
    better = model if better is named else better
    if learned:
        with working("learning laws"):
            better, idle = diagnosis.add_laws(better, recompile(better), logs)
        left_out = (*left_out, *idle)
    if better is model and not left_out:
        raise DataError(
            "auto: nothing is added, because nothing that can be added is missing in this model "
            f"({found.sentences[0]})"
        )
    return better, left_out, found


def missing(
    model: IdentifiedModel,
    compiled: CompiledModel,
    logs: diagnosis.Logs,
    without: Sequence[str] = (),
    progress: Callable[[float], None] | None = None,
    equations: bool = False,
    more: SharedEffects = _NONE,
) -> diagnosis.Diagnosis:
    """What a diagnosis finds, which tries the effects that the robot file defines too.

    And those of a folder; why some of these are left out stands among its sentences.
    """
    robot = _robot_of(model)
    known = diagnosis.StatedEffects((*robot.catalogue, *more.effects), robot.coupling)
    found = diagnosis.diagnose(
        model, compiled, logs.fitted, logs.held_out, without, progress=progress, known=known,
        equations=equations,
    )  # fmt: skip
    laws = {e.id: "a learned law, no physics" for e in more.effects if e.learned}
    left = [f"left out: {name} ({why})" for name, why in {**more.left_out, **laws}.items()]
    return dataclasses.replace(found, sentences=(*found.sentences, *left))


def _robot_of(model: IdentifiedModel) -> Robot:
    return robot_from_text(model.robot_text, f"model of {model.spec.robot}, robot")


def shared_of(model: IdentifiedModel, folder: str | Path | None) -> SharedEffects:
    """Effects of a folder that the robot of the model may have too; without a folder none."""
    return _NONE if folder is None else shared_effects(_robot_of(model), folder)


def with_shared(model: M, more: SharedEffects, effect: str) -> M:
    """The model whose robot file defines that effect, if it is one of a folder.

    Raises:
        DataError: it is one that the robot cannot have.
    """
    if effect in more.left_out:
        raise DataError(f"{effect} of {more.left_out[effect]}; expected another effect")
    return dataclasses.replace(model, robot_text=more.written(model.robot_text, [effect]))


def logs_of(
    model: IdentifiedModel, logs: Logs, holdout: Logs, mapping: Mapped = (), spread: bool = False
) -> tuple[CompiledModel, diagnosis.Logs]:
    """The robot of a model, compiled, and the logs that it is held against.

    Of long logs stretches where `spread` is true, see `read_logs`.

    Raises:
        DataError: a log cannot be read, or rows are given twice.
    """
    compiled = recompile(model)
    every = (read_logs(compiled, some, mapping, spread) for some in (logs, holdout))
    given = diagnosis.Logs(*every)
    check_apart(given.fitted, given.held_out)
    return compiled, given
