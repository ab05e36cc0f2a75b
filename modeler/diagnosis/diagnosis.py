"""Which physical effect is missing: from a model and logs to a diagnosis."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.core.errors import DataError
from modeler.diagnosis import findings
from modeler.diagnosis.candidates import Candidate, StatedEffects, thin_samples
from modeler.diagnosis.events import detect_pushes, leave_out
from modeler.diagnosis.generation import estimate_logger_shift, generate_candidates
from modeler.diagnosis.messages import exclude_friction, find_faults
from modeler.diagnosis.plausibility import find_gravity_confounders
from modeler.diagnosis.result import Diagnosis
from modeler.diagnosis.scoring import make_veto
from modeler.diagnosis.search import Search, SearchStep, search_effects
from modeler.diagnosis.state import (
    SearchData,
    analyse_logs,
    build_state,
    choose_band,
    describe_bands,
    get_cutoff,
    observe_in_band,
    observe_logs,
)
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget, Requirement, find_effect
from modeler.estimation import IdentifiedModel, MachineComparison, compute_relative_errors
from modeler.regression import (
    DataWarning,
    Log,
    LogRepair,
    Observation,
    build_observation,
    prepare_logs,
)

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


_READ, _SEARCHED, _NAMED = 0.05, 0.7, 0.75  # shares of the work when these are done


class Progress:
    """A share between 0 and 1 that only grows.

    Args:
        tell: called with the share.
        end: of the first stage.
    """

    def __init__(self, tell: Callable[[float], None] | None, end: float) -> None:
        self._tell = tell or (lambda share: None)
        self._share, self._end = 0.0, end
        self._tell(0.0)

    def begin_stage(self, end: float) -> None:
        """Begins a stage that ends at that share; a stage that has begun goes on."""
        if end > self._end:
            self._share, self._end = self._end, end
        self._tell(self._share)

    def advance(self) -> None:
        """Advances towards the end of the stage, never to it."""
        self._share += THRESHOLDS.progress_step * (self._end - self._share)
        self._tell(self._share)


@threadpool_limits.wrap(limits=1, user_api="blas")  # small matrices: a second thread only waits
def diagnose(
    model: IdentifiedModel,
    compiled: "CompiledModel",
    logs: Sequence[Log],
    holdout: Sequence[Log] = (),
    without: Sequence[str] = (),
    most: int = THRESHOLDS.max_effects,
    progress: Callable[[float], None] | None = None,
    known: StatedEffects | None = None,
    equations: bool = False,
) -> Diagnosis:
    """Finds the effects that the model lacks on these logs, and what each would gain.

    Args:
        model: fitted.
        compiled: its robot.
        logs: to explain.
        holdout: other motion, from which the errors come: it never chooses an effect, but vetoes.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most.
        progress: called with a share between 0 and 1.
        known: the effects to try, and how motors are coupled, by the robot file.
        equations: True to propose some for what has no name.

    Raises:
        DataError: no usable row.
    """
    stages = Progress(progress, _READ)
    repair = LogRepair(logs, compiled.spec)
    known = known or StatedEffects()
    without = _resolve_ids(without, known.catalogue)
    prepared = prepare_logs(compiled.spec, logs, model.processing, repair)
    errors = compute_relative_errors(build_observation(compiled, logs, prepared), model.beta)
    observation = analyse_logs(compiled, logs, model.processing, prepared=prepared, repair=repair)
    del prepared
    faults = find_faults(model, compiled, observation)
    observation = thin_samples(observation, compiled)  # all samples are in memory but once
    fixed = find_fixed_parameters(model, compiled, logs, observation)
    data = SearchData(compiled, observation, fixed, known)
    if (fewer := exclude_friction(data, model.beta)) is not None:
        data = replace(data, stated_effects=fewer)
    other = None
    if holdout:
        held = observe_in_band(compiled, holdout, observation.report.processing)
        faults += find_faults(model, compiled, held, "held out: ")
        other = replace(data, observation=thin_samples(held, compiled))
        del held
    beyond = _find_other_band(data, model, repair)
    repair = LogRepair(logs, compiled.spec)  # pieces and spectra have served
    limit = 0 if any(fault.is_certain for fault in faults) else most

    def run_search(
        data: SearchData, other: SearchData | None, named_steps: Sequence[SearchStep] = ()
    ) -> Search:
        stages.begin_stage(_SEARCHED)
        most = limit - len(named_steps) if limit else 0
        veto = make_veto(other)
        return search_effects(data, model.beta, without, most, veto, stages.advance, named_steps)

    machine: MachineComparison | None = None

    def search_bands() -> list[findings.BandSearch]:
        """Searches the band of the diagnosis, then a wider one with all that is named."""
        made: list[findings.BandSearch] = []
        far = beyond if beyond is not None and get_cutoff(beyond) > get_cutoff(data) else None
        far_held_out = None if far is None else _prepare_holdout(far, holdout, machine)
        far_held_out = far_held_out and leave_out(far_held_out, held_push, named)
        for band_data, held in ((data, other), (far, far_held_out)):
            if band_data is None:
                continue
            unseen = None if machine is not None and machine.unexplained else held
            search = run_search(band_data, unseen, made[0].named_steps if made else ())
            second = data if made else beyond
            check_data = list[findings.CrossCheckData]()
            if held is not None:
                check_data.append(findings.CrossCheckData("in the held-out logs", held, False))
            if second is not None:
                check_data.append(
                    findings.CrossCheckData(f"up to {get_cutoff(second):.2g} Hz", second)
                )
            checks = findings.cross_check_effects(search, check_data, stages.advance)
            made.append(findings.evaluate_search(search, unseen, checks, stages.advance))
        return made

    held_push, named = None, list[Candidate]()
    bands = search_bands()
    aligned = _align_logger_delay(data, bands[0].search, model, repair)
    if aligned is not None:
        data, other = aligned, _prepare_holdout(aligned, holdout)
        beyond = _find_other_band(data, model, repair)
        bands = search_bands()
    pushes = [e for e in data.stated_effects.catalogue if e.acts is EffectTarget.WINDOW]
    may_push = [effect for effect in pushes if effect.id not in without]
    window, last = None, bands[-1].search
    if may_push and last.last.ranked:
        window, held_push = detect_pushes(last.end, last.start.data, other)
    if other is not None and held_push is not None:
        where = held_push.describe(other.observation.logs)
        faults += (DataWarning(f"held out: {where}; left out of the errors"),)
    steps = (step for band in bands for step in band.search.steps)
    named = [step.candidate for step in steps if step.candidate.loop]
    if window is not None or held_push is not None or named:
        data = leave_out(data, window, named)
        beyond = beyond and leave_out(beyond, window, named)
        other = other and leave_out(other, held_push, named)
        bands = search_bands()
    if other is not None and limit:
        machine = findings.compare_holdout(bands[0].search, other)
    if machine is not None and machine.differs:
        other = other if other is None else findings.remove_changes(other, machine)
        bands = search_bands()
    stages.begin_stage(_NAMED if equations else 1.0)
    diagnosis = findings.assemble_diagnosis(model, bands, window, faults, machine)
    if equations and limit:
        from modeler.diagnosis.proposals import discover_equations  # few runs search equations

        stages.begin_stage(1.0)
        facts = [(f.effect, f.joint) for f in diagnosis.effects if f.status == "confirmed"]
        band = bands[0]
        discoveries = discover_equations(band.search, facts, band.other, stages.advance)
        diagnosis = replace(diagnosis, discoveries=discoveries)
    if progress is not None:
        progress(1.0)

    line = describe_bands(model.processing, data.observation.report.processing)
    line += _describe_gravity_confounders(diagnosis, bands[0].search, without)
    sentences = (*diagnosis.sentences, *line)
    return replace(diagnosis, sentences=sentences, errors=errors)


def _find_other_band(
    data: SearchData, model: IdentifiedModel, repair: LogRepair
) -> SearchData | None:
    """The same logs in a wider band, or else in that of the motion; None if none differs."""
    for band in (0.8 * THRESHOLDS.max_band, 0.0):
        prepared = choose_band(data.compiled, repair.logs, model.processing, band, repair=repair)
        other = prepared.processing.parallel_cutoff or 0.0
        if max(other / get_cutoff(data), get_cutoff(data) / other) > THRESHOLDS.min_cutoff_ratio:
            observation = observe_logs(data.compiled, repair.logs, prepared)
            observation = thin_samples(observation, data.compiled)
            return replace(data, observation=observation)
    return None


def _describe_gravity_confounders(
    diagnosis: Diagnosis, search: Search, without: Sequence[str]
) -> list[str]:
    """A line on joints where free inertias stand in for a spring that balances gravity."""
    start, prior = search.start, search.start.data.prior
    bodies = prior is not None and prior.has_bodies
    if diagnosis.has_contradictions or start.data.fixed_parameters is not None or bodies:
        return []
    catalogue = start.data.stated_effects.catalogue
    balancing = next((e for e in catalogue if Requirement.GRAVITY in e.needs), None)
    if balancing is None:
        return []
    family = {e.id for e in catalogue if e.family == balancing.family}
    named = {e.joint for e in diagnosis.effects if e.effect in family and e.status != "possible"}
    joints = find_gravity_confounders(start, generate_candidates(start, balancing.id, without))
    return [
        f"a {balancing.id} on joint {joint} cannot be distinguished from gravity: give link data "
        "([parameters] with an uncertainty), or a motion that turns this joint over more of its "
        "range, and the joints before it fast"
        for joint in joints
        if joint not in named
    ]


def _align_logger_delay(
    data: SearchData, search: Search, model: IdentifiedModel, repair: LogRepair
) -> SearchData | None:
    """The data without a delay that is a convention of the logger; None if there is none."""
    delays = [j for j in search.ranked if j.candidate.is_delay and not j.is_confirmed]
    if not delays:
        return None
    shift = estimate_logger_shift(search.start, delays[0].candidate, delays[0].values)
    if shift == 0.0:
        return None
    processing = replace(model.processing, delay=model.processing.delay + shift)
    observation = analyse_logs(data.compiled, repair.logs, processing, repair=repair)
    return replace(data, observation=thin_samples(observation, data.compiled))


def _resolve_ids(without: Sequence[str], catalogue: Sequence[Effect]) -> tuple[str, ...]:
    """What the user rules out, by ids in place of aliases."""
    ids = []
    for entry in without:
        name, at, joint = entry.partition("@")
        effect = find_effect(name, catalogue)
        if effect is None:
            raise DataError(
                f"without {entry}: no such effect; expected one of "
                f"{', '.join(known.id for known in catalogue)}"
            )
        ids.append(f"{effect.id}{at}{joint}")
    return tuple(ids)


def _prepare_holdout(
    data: SearchData, holdout: Sequence[Log], machine: MachineComparison | None = None
) -> SearchData | None:
    """Held-out logs in the band of the training logs, of the machine as it was in these."""
    if not holdout:
        return None
    processing = data.observation.report.processing
    observation = observe_in_band(data.compiled, holdout, processing)
    held = replace(data, observation=thin_samples(observation, data.compiled))
    return held if machine is None else findings.remove_changes(held, machine)


def find_fixed_parameters(
    model: IdentifiedModel, compiled: "CompiledModel", logs: Sequence[Log], observation: Observation
) -> np.ndarray | None:
    """Returns the model's parameters if the robot has changed since its fit; else None."""
    if any(used.has_rows_of(log) for used in model.logs for log in logs):
        return None
    free = build_state(SearchData(compiled, observation), (), model.beta)
    fitted = float(free.rank_columns([]).before.sum())
    rows = zip(free.rows.y, free.rows.W, free.sigma, strict=True)
    fixed_cost = sum(float(np.sum(((y - w @ model.beta) / s) ** 2)) for y, w, s in rows)
    return model.beta if fixed_cost > THRESHOLDS.min_refit_variance_ratio * fitted else None
