"""Effects into a model: one by its name, all that a diagnosis names; the last one out again."""

from __future__ import annotations  # what a signature names need not be loaded

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from modeler import diagnosis
from modeler.api.log_maps import Mapped
from modeler.api.workflow import Logs, M, compile, read_logs
from modeler.core.errors import DataError
from modeler.core.jobs import SILENT, Reporter
from modeler.core.options import AddOptions, DiagnoseOptions, OptionError
from modeler.diagnosis import ANY_LAW, LEARNED, LawRequest
from modeler.effects import find_effect
from modeler.estimation import IdentifiedModel
from modeler.regression import check_no_overlap
from modeler.robot import (
    Robot,
    SharedEffects,
    collect_shared_effects,
    insert_own_effect,
    parse_robot_text,
    suggest_name,
)
from modeler.runtime import CompiledModel

ALL_MISSING, LAST = "auto", "undo"
"""In place of an effect to add: all that a diagnosis names; the last one out again."""


def diagnose(
    model: IdentifiedModel,
    logs: Logs,
    holdout: Logs = (),
    *,
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
    **options: Any,
) -> diagnosis.Diagnosis:
    """Finds the physical effects that the model lacks; errors come from held-out logs if any.

    >>> found = diagnose(model, ["mon.parquet"], ["tue.parquet"])
    >>> found.effects[0].effect, found.effects[0].joint
    ('spring', '1')

    Args:
        model: as it is.
        logs: to explain.
        holdout: logs of other motion to judge on.
        mapping: as of `read_logs`.
        reporter: of the progress.
        options: of `DiagnoseOptions`: without (effects to leave out, as "spring@2"), effects_from
            (folder of effects to try besides), discover (propose equations for what has no name,
            `discoveries` of the result).

    Raises:
        DataError: an option that is none; an effect or joint to leave out that there is not.
    """
    chosen = DiagnoseOptions.from_keywords("diagnose", options)
    return diagnose_logs(model, logs, holdout, chosen, mapping, reporter)[0]


@dataclasses.dataclass(frozen=True, eq=False)
class ModelOnLogs:
    """Holds a model with its logs.

    Attributes:
        model: as it is.
        compiled: its robot.
        logs: to fit to, and to judge on.
        shared: effects of a folder that the robot may have too.
        reporter: of the progress.
    """

    model: IdentifiedModel
    compiled: CompiledModel
    logs: diagnosis.LogSplit
    shared: SharedEffects = dataclasses.field(default_factory=SharedEffects)
    reporter: Reporter = SILENT


def diagnose_logs(
    model: IdentifiedModel,
    logs: Logs,
    holdout: Logs,
    options: DiagnoseOptions,
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
) -> tuple[diagnosis.Diagnosis, ModelOnLogs]:
    """Diagnoses as `diagnose` does, and returns what `add_proposals` takes besides."""
    shared = _read_shared_effects(model, options.effects_from)
    _check_without(model, shared, options.without)
    case = _open_model(model, logs, holdout, mapping, shared, reporter, spread=True)
    return _find_missing(case, options), case


def _check_without(model: IdentifiedModel, shared: SharedEffects, without: Sequence[str]) -> None:
    """Refuses effects that there are not, then joints."""
    catalogue = (*_read_model_robot(model).catalogue, *shared.effects)
    ids = [effect.id for effect in catalogue]
    joints = [joint.name for joint in model.spec.joints]
    passive = () if model.spec.closure is None else model.spec.closure.variables
    pairs = [(text, *text.partition("@")) for text in without]
    for text, name, _, _ in pairs:
        if find_effect(name, catalogue) is None:
            raise OptionError(
                f"{{--without}} {text}: no such effect{suggest_name(name, ids)}; expected one of "
                f"{', '.join(ids)}"
            )
    for text, _, at, joint in pairs:
        if at and joint not in {*joints, *passive}:
            raise OptionError(
                f"{{--without}} {text}: no joint {joint}; expected one of {', '.join(joints)}"
            )


def add_discoveries(
    model: M,
    diagnosis_result: diagnosis.Diagnosis,
    logs: Logs,
    holdout: Logs = (),
    *,
    mapping: Mapped = (),
    **options: Any,
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
        options: as of the diagnosis.

    Raises:
        DataError: an option that is none.
    """
    chosen = DiagnoseOptions.from_keywords("add_discoveries", options)
    shared = _read_shared_effects(model, chosen.effects_from)
    case = _open_model(model, logs, holdout, mapping, shared)
    return _restore_class(model, add_proposals(case, diagnosis_result)[0])


def add_proposals(
    case: ModelOnLogs, diagnosis_result: diagnosis.Diagnosis
) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """Adds the first proposal of each joint and the effects that it stands beside.

    And a line on what is left out.
    """
    model = case.model
    firsts = [
        discovery.proposals[0]
        for discovery in diagnosis_result.discoveries or ()
        if discovery.proposals
    ]
    if not firsts:
        return model, ("left out: nothing was found",)
    text = case.shared.insert_definitions(
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
    better, left_out = diagnosis.add_findings(named, case.compiled, findings, case.logs)
    return (model if better is named else better), left_out


def add(
    model: M,
    effect: str,
    logs: Logs,
    holdout: Logs = (),
    *,
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
    **options: Any,
) -> M:
    """Adds one effect and fits again; `table("waterfall")` lists the errors.

    >>> better = add(model, "spring", ["mon.parquet"], ["tue.parquet"], joint="1")
    >>> better.table("waterfall").column("effect")
    ['as fitted', 'spring']

    Args:
        model: as it is.
        effect: id, see `effects()`; "learned": a smooth law, for what has no name; "auto": as
            `add_all`; "undo": as `remove_last`.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        mapping: as of `read_logs`.
        reporter: of the progress.
        options: of `AddOptions`: joint (where it explains most if left out), effects_from (folder
            of effects to choose from besides); of a learned law: of ("q", "v" ...), odd, monotone
            ("rising" or "falling"); of "auto": learned (a law for what is left).

    Raises:
        DataError: no such effect, one that is there already, cannot be distinguished from the logs,
            or cannot be added; options that are none, or that this effect has no use for.
    """
    chosen = AddOptions.from_keywords("add", options)
    return add_to_model(model, effect, logs, holdout, chosen, mapping, reporter)[0]


def add_all(
    model: M,
    logs: Logs,
    holdout: Logs = (),
    *,
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
    **options: Any,
) -> M:
    """Adds all effects that a diagnosis finds and that lower the error; see `add`.

    >>> better = add_all(model, ["mon.parquet"], ["tue.parquet"])
    >>> [step.effect for step in better.history[1:]]
    ['spring']

    Args:
        model: as it is.
        logs: to fit to.
        holdout: logs of other motion to judge on.
        mapping: as of `read_logs`.
        reporter: of the progress.
        options: of `AddOptions`: effects_from, learned.

    Raises:
        DataError: nothing that can be added is missing; an option that is none, or of one effect.
    """
    chosen = AddOptions.from_keywords("add_all", options)
    return add_to_model(model, ALL_MISSING, logs, holdout, chosen, mapping, reporter)[0]


def remove_last(model: M, logs: Logs, mapping: Mapped = ()) -> M:
    """Removes the effect that was added last and fits again.

    >>> better = add(model, "spring", ["mon.parquet"], joint="1")
    >>> [step.effect for step in remove_last(better, ["mon.parquet"]).history[1:]]
    []

    Raises:
        DataError: none was added.
    """
    return add_to_model(model, LAST, logs, mapping=mapping)[0]


def add_to_model(
    model: M,
    effect: str,
    logs: Logs,
    holdout: Logs = (),
    options: AddOptions = AddOptions(),
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
) -> tuple[M, tuple[str, ...]]:
    """Adds as `add` does, and returns lines on what is left out too."""
    _check_additions(effect, options)
    shared = _read_shared_effects(model, options.effects_from)
    case = _open_model(model, logs, holdout, mapping, shared, reporter)
    compiled, split, left_out = case.compiled, case.logs, tuple[str, ...]()
    if effect == ALL_MISSING:
        better, left_out = _add_missing(case, options.learned)
    elif effect == LEARNED:
        with reporter.show_progress("learning a law") as bar:
            law = _build_law(options)
            better = diagnosis.add_learned_law(model, compiled, options.joint, split, law, bar)
    elif effect == LAST:
        with reporter.report_step("fitting without the last effect"):
            better = diagnosis.remove_last_effect(model, split)
    else:
        with reporter.report_step(f"adding {effect}"):
            defined = _define_shared_effect(model, shared, effect)
            better = diagnosis.add_effect(defined, compiled, effect, options.joint, split)
    return _restore_class(model, better), left_out


def _check_additions(effect: str, options: AddOptions) -> None:
    """Refuses options that an effect has no use for."""
    if options.joint is not None and effect in (ALL_MISSING, LAST):
        raise OptionError(
            f"{{--joint}} {options.joint}: `{effect}` takes no joint; expected one effect with "
            "{--joint}, or leave it out"
        )
    if options.effects_from is not None and effect in (LEARNED, LAST):
        raise OptionError(
            f"{{--effects_from}} {options.effects_from}: got it with {effect}; expected an effect "
            "of the folder, or auto"
        )
    if effect != LEARNED and _build_law(options) != ANY_LAW:
        raise OptionError(
            f"{{--of}}, {{--odd}}, {{--monotone}}: got them with {effect}; expected the effect "
            f"{LEARNED}"
        )
    if options.learned and effect != ALL_MISSING:
        raise OptionError(f"{{--learned}}: got it with {effect}; expected the effect {ALL_MISSING}")


def _build_law(options: AddOptions) -> LawRequest:
    rising = {"rising": 1, "falling": -1, None: 0}[options.monotone]
    return LawRequest(options.of, options.odd, rising)


def _restore_class(model: M, result: IdentifiedModel) -> M:
    """Returns the result as an object of the class of the model."""
    fields = {f.name: getattr(result, f.name) for f in dataclasses.fields(IdentifiedModel)}
    return dataclasses.replace(model, **{**fields, "mapping": model.mapping})


def _add_missing(case: ModelOnLogs, learned: bool) -> tuple[IdentifiedModel, tuple[str, ...]]:
    """Adds what a diagnosis finds; returns the model, and why some is left out.

    Raises:
        DataError: nothing that can be added is missing.
    """
    model, result = case.model, _find_missing(case, DiagnoseOptions())
    findings = [*result.effects, *result.refinements]
    text = case.shared.insert_definitions(model.robot_text, [f.effect for f in findings])
    named = dataclasses.replace(model, robot_text=text)
    with case.reporter.report_step("adding what is missing"):
        better, left_out = diagnosis.add_findings(named, case.compiled, findings, case.logs)
    better = model if better is named else better
    if learned:
        with case.reporter.report_step("learning laws"):
            better, idle = diagnosis.add_learned_laws(better, compile(better), case.logs)
        left_out = (*left_out, *idle)
    if better is model and not left_out:
        raise DataError(
            "auto: nothing is added, because nothing that can be added is missing in this model "
            f"({result.sentences[0]})"
        )
    return better, left_out


def _find_missing(case: ModelOnLogs, options: DiagnoseOptions) -> diagnosis.Diagnosis:
    """Runs a diagnosis that also tries the effects that the robot file defines.

    And those of a folder; why some of these are left out stands among its sentences.
    """
    robot, shared = _read_model_robot(case.model), case.shared
    known = diagnosis.StatedEffects((*robot.catalogue, *shared.effects), robot.coupling)
    with case.reporter.show_progress("looking for missing effects") as bar:
        result = diagnosis.diagnose(
            *(case.model, case.compiled, case.logs.training, case.logs.held_out, options.without),
            progress=bar,
            known=known,
            equations=options.discover,
        )
    laws = {e.id: "a learned law, no physics" for e in shared.effects if e.is_learned}
    left = [f"left out: {name} ({why})" for name, why in {**shared.left_out, **laws}.items()]
    return dataclasses.replace(result, sentences=(*result.sentences, *left))


def _read_model_robot(model: IdentifiedModel) -> Robot:
    return parse_robot_text(model.robot_text, f"model of {model.spec.robot}, robot")


def _read_shared_effects(model: IdentifiedModel, folder: str | Path | None) -> SharedEffects:
    """Reads the effects of a folder that the robot may have too; none without a folder."""
    if folder is None:
        return SharedEffects()
    return collect_shared_effects(_read_model_robot(model), folder)


def _define_shared_effect(model: M, shared: SharedEffects, effect: str) -> M:
    """Adds the definition of an effect of a folder to the robot text of a model.

    Raises:
        DataError: it is one that the robot cannot have.
    """
    if effect in shared.left_out:
        raise DataError(f"{effect} of {shared.left_out[effect]}; expected another effect")
    text = shared.insert_definitions(model.robot_text, [effect])
    return dataclasses.replace(model, robot_text=text)


def _open_model(
    model: IdentifiedModel,
    logs: Logs,
    holdout: Logs,
    mapping: Mapped,
    shared: SharedEffects,
    reporter: Reporter = SILENT,
    spread: bool = False,
) -> ModelOnLogs:
    """Compiles the robot of a model and reads its logs.

    Of long logs segments where `spread` is true, see `read_logs`.

    Raises:
        DataError: a log cannot be read, or rows are given twice.
    """
    with reporter.report_step("deriving the robot of the model"):
        compiled = compile(model)
        every = (read_logs(compiled, some, mapping, spread) for some in (logs, holdout))
        log_sets = diagnosis.LogSplit(*every)
    check_no_overlap(log_sets.training, log_sets.held_out)
    return ModelOnLogs(model, compiled, log_sets, shared, reporter)
