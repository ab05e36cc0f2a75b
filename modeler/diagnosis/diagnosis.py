"""Which physical effect is missing: from a model and logs to a diagnosis."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.core.errors import DataError
from modeler.diagnosis.assemble import BandSearch, assembled, band_search
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.cross_checks import (
    OtherLook,
    ParameterChange,
    changed_parameters,
    recheck_effects,
)
from modeler.diagnosis.data_checks import faults_of, without_friction
from modeler.diagnosis.effect_columns import coarser
from modeler.diagnosis.events import BURST, MARGIN, Window, burst_ratio, contact_window, explained
from modeler.diagnosis.generate import generate_candidates
from modeler.diagnosis.judge import vetoing
from modeler.diagnosis.plausible import gravity_like
from modeler.diagnosis.proposals import discover
from modeler.diagnosis.result import Diagnosis
from modeler.diagnosis.search import MOST, Search, Step, search
from modeler.diagnosis.state import (
    BAND,
    SearchData,
    again,
    analysed,
    bands_line,
    cutoff,
    in_band,
    seen_in,
    state_of,
)
from modeler.diagnosis.timing import logger_shift
from modeler.effects import Acts, Effect, Needs, effect_named
from modeler.estimation import IdentifiedModel, relative_errors
from modeler.observation import Log, LogRepair, Observation, observed, prepare

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel

CHANGED = 1.3
"""Ratio of the residual variances with kept and with refitted parameters from which on the robot
has changed since the fit."""

_READ, _SEARCHED, _NAMED = 0.05, 0.7, 0.75  # shares of the work when these are done


_STRIDE = 0.04  # of what is left of a stage


class Meter:
    """A share between 0 and 1 that only grows.

    Args:
        tell: called with the share.
        end: of the first stage.
    """

    def __init__(self, tell: Callable[[float], None] | None, end: float) -> None:
        self._tell = tell or (lambda share: None)
        self._share, self._end = 0.0, end
        self._tell(0.0)

    def stage(self, end: float) -> None:
        """What comes next ends at that share; nothing changes if it is the same stage again."""
        if end > self._end:
            self._share, self._end = self._end, end
        self._tell(self._share)

    def tick(self) -> None:
        """A piece of work is done: nearer to the end of the stage, never there."""
        self._share += _STRIDE * (self._end - self._share)
        self._tell(self._share)


@threadpool_limits.wrap(limits=1, user_api="blas")  # small matrices: a second thread only waits
def diagnose(
    model: IdentifiedModel, compiled: "CompiledModel", logs: Sequence[Log],
    holdout: Sequence[Log] = (), without: Sequence[str] = (), most: int = MOST,
    progress: Callable[[float], None] | None = None, known: StatedEffects | None = None,
    equations: bool = False,
) -> Diagnosis:  # fmt: skip
    """The effects that the model lacks on these logs, with what they would gain.

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
    meter = Meter(progress, _READ)
    mending = LogRepair(logs, compiled.spec)
    known = known or StatedEffects()
    without = _ids(without, known.catalogue)
    prepared = prepare(compiled.spec, logs, model.processing, mending)
    errors = relative_errors(observed(compiled, logs, prepared), model.beta)
    seen = analysed(compiled, logs, model.processing, prepared=prepared, mending=mending)
    del prepared
    doubted = faults_of(model, compiled, seen)
    seen = coarser(seen, compiled)  # all samples, and all columns of a log, are there but once
    data = SearchData(compiled, seen, kept_parameters(model, compiled, logs, seen), known)
    if (fewer := without_friction(data, model.beta)) is not None:
        data = dataclasses.replace(data, known=fewer)
    other = None
    if holdout:
        held = again(compiled, holdout, seen.report.processing)
        doubted += faults_of(model, compiled, held, "held out: ")
        other = dataclasses.replace(data, observation=coarser(held, compiled))
        del held
    beyond = _other_band(data, model, mending)
    mending = LogRepair(logs, compiled.spec)  # pieces and spectra have served
    limit = 0 if any(fault.certain for fault in doubted) else most

    def searched(data: SearchData, other: SearchData | None, given: Sequence[Step] = ()) -> Search:
        meter.stage(_SEARCHED)
        most = limit - len(given) if limit else 0
        return search(data, model.beta, without, most, vetoing(other), meter.tick, given)

    def bands() -> list[BandSearch]:
        """The search in the band of the diagnosis, and that in a wider one, with what is named."""
        made: list[BandSearch] = []
        far = beyond if beyond is not None and cutoff(beyond) > cutoff(data) else None
        for own, held in ((data, other), (far, None if far is None else _held_out(far, holdout))):
            if own is None:
                continue
            found = searched(own, held, made[0].named if made else ())
            second = data if made else beyond
            around = [] if held is None else [OtherLook("in the held-out logs", held, False)]
            if second is not None:
                around.append(OtherLook(f"up to {cutoff(second):.2g} Hz", second))
            looks = recheck_effects(found, around, meter.tick)
            made.append(band_search(found, held, looks, meter.tick))
        return made

    found = bands()
    aligned = _aligned(data, found[0].found, model, mending)
    if aligned is not None:
        data, other = aligned, _held_out(aligned, holdout)
        beyond = _other_band(data, model, mending)
        found = bands()
    may_push = [e for e in data.known.catalogue if e.acts is Acts.WINDOW and e.id not in without]
    window = _push(found[-1].found) if may_push else None
    if window is not None:
        data = _masked(data, window)
        beyond = None if beyond is None else _masked(beyond, window)
        found = bands()
    meter.stage(_NAMED if equations else 1.0)
    moved = tuple[ParameterChange, ...]()
    if other is not None and limit:
        moved = changed_parameters(model, found[0].found, other, found[0].seen[-1], holdout)
    diagnosis = assembled(model, found, window, doubted, moved)
    if equations and limit:
        meter.stage(1.0)
        facts = [(f.effect, f.joint) for f in diagnosis.effects if f.status == "fact"]
        own = discover(found[0].found, facts, found[0].other, meter.tick)
        diagnosis = dataclasses.replace(diagnosis, discoveries=own)
    if progress is not None:
        progress(1.0)

    line = bands_line(model.processing, data.observation.report.processing)
    line += _like_gravity(diagnosis, found[0].found, without)
    said = (*diagnosis.sentences, *line)
    return dataclasses.replace(diagnosis, sentences=said, errors=errors)


WIDER = 1.3
"""Ratio of two cut-offs from which on one shows what the other does not."""


def _other_band(data: SearchData, model: IdentifiedModel, mending: LogRepair) -> SearchData | None:
    """The same logs in a wider band, or else in that of the motion; None if none differs."""
    for band in (0.8 * BAND, 0.0):
        look = in_band(data.compiled, mending.logs, model.processing, band, mending=mending)
        other = look.processing.parallel_cutoff or 0.0
        if max(other / cutoff(data), cutoff(data) / other) > WIDER:
            seen = coarser(seen_in(data.compiled, mending.logs, look), data.compiled)
            return dataclasses.replace(data, observation=seen)
    return None


def _like_gravity(diagnosis: Diagnosis, found: Search, without: Sequence[str]) -> list[str]:
    """A line on joints where free inertias stand in for a spring that balances gravity."""
    start, prior = found.start, found.start.data.prior
    bodies = prior is not None and prior.has_bodies
    if diagnosis.contradicted or start.data.kept is not None or bodies:
        return []
    catalogue = start.data.known.catalogue
    balancing = next((e for e in catalogue if Needs.GRAVITY in e.needs), None)
    if balancing is None:
        return []
    family = {e.id for e in catalogue if e.family == balancing.family}
    named = {e.joint for e in diagnosis.effects if e.effect in family and e.status != "perhaps"}
    joints = gravity_like(start, generate_candidates(start, balancing.id, without))
    return [
        f"a {balancing.id} on joint {joint} cannot be told from gravity: give link data "
        "([parameters] with an uncertainty), or a motion that turns this joint over more of its "
        "range, and the joints before it fast"
        for joint in joints
        if joint not in named
    ]


def _aligned(
    data: SearchData, found: Search, model: IdentifiedModel, mending: LogRepair
) -> SearchData | None:
    """The data without a delay that is a convention of the logger; None if there is none."""
    delays = [j for j in found.ranked if j.candidate.delays and not j.confirmed]
    shift = logger_shift(found.start, delays[0].candidate, delays[0].values) if delays else 0.0
    if shift == 0.0:
        return None
    moved = dataclasses.replace(model.processing, delay=model.processing.delay + shift)
    seen = analysed(data.compiled, mending.logs, moved, mending=mending)
    return dataclasses.replace(data, observation=coarser(seen, data.compiled))


def _ids(without: Sequence[str], catalogue: Sequence[Effect]) -> tuple[str, ...]:
    """What the user rules out, by ids in place of aliases."""
    found = []
    for entry in without:
        name, at, joint = entry.partition("@")
        effect = effect_named(name, catalogue)
        if effect is None:
            raise DataError(
                f"without {entry}: no such effect; expected one of "
                f"{', '.join(known.id for known in catalogue)}"
            )
        found.append(f"{effect.id}{at}{joint}")
    return tuple(found)


def _held_out(data: SearchData, holdout: Sequence[Log]) -> SearchData | None:
    """Held-out logs in the band of the training logs."""
    if not holdout:
        return None
    processing = data.observation.report.processing
    seen = again(data.compiled, holdout, processing)
    return dataclasses.replace(data, observation=coarser(seen, data.compiled))


def kept_parameters(
    model: IdentifiedModel, compiled: "CompiledModel", logs: Sequence[Log], seen: Observation
) -> np.ndarray | None:
    """The model's parameters if these logs are of a robot that has changed since; else None."""
    if any(used.shares_rows(log) for used in model.logs for log in logs):
        return None
    free = state_of(SearchData(compiled, seen), (), model.beta)
    fitted = float(free.ranked([]).before.sum())
    given = sum(
        float(np.sum(((y - w @ model.beta) / s) ** 2))
        for y, w, s in zip(free.rows.y, free.rows.W, free.sigma, strict=True)
    )
    return model.beta if given > CHANGED * fitted else None


def _push(found: Search) -> Window | None:
    """When something pushed; with its first part left out of the fit, more of it may show."""
    end, data = found.end, found.start.data
    # a gear may have so much play that one of its knocks looks like a push
    rattles = any(burst_ratio(end, j) > BURST for j in range(end.rows.joints))
    window = more = None if rattles or not found.last.ranked else contact_window(end)
    if window is None:
        return None
    while more is not None:
        window = more
        later = contact_window(state_of(_masked(data, window), end.picks, end.beta))
        more = window.with_part(later) if later is not None else None
    return explained(window, state_of(_masked(data, window), end.picks, end.beta), data)


def _masked(data: SearchData, window: Window) -> SearchData:
    """The data without the rows of a window, and a little around it."""
    observation = data.observation
    hit = (observation.run == window.log) & (observation.time > window.start - MARGIN)
    hit &= observation.time < window.end + MARGIN
    rest = observation.with_rows(observation.used & ~hit[:, None])
    return dataclasses.replace(data, observation=rest)
