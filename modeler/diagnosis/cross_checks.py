"""Other looks at the same machine: what names an effect must lead in all of them.

The first look is at the training logs, in the band of the diagnosis. The others change what has
nothing to do with the robot: the held-out logs take the place of the training logs, and the filters
cut off at `FACTORS` times the frequency. What leads in one and not in the other is a matter of the
look, so it is not stated as fact. Diagnoses of one machine with training and held-out logs
exchanged, or with such another cut-off, then state two names only where the one is not among the
nearest rivals of the other: each looks at what the other was made from. And what the user ruled
out is asked beside every effect: if it would have been named instead, the effect stands in for it.
"""

import dataclasses
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.generate import generate_candidates, ruled_out
from modeler.diagnosis.judge import Judged, decide, numbers, tied
from modeler.diagnosis.search import Search, Step, Tick, about_itself, scan_candidates
from modeler.diagnosis.state import SearchData, State, analysed, state_of
from modeler.observation import HIGHEST, LogRepair, Observation

FACTORS = (0.7, 1.4)
"""Cut-offs of the other looks, over those of the diagnosis."""

RIVALS = 8
"""Effects that are asked again in the other looks: those that came nearest."""


Key = tuple[str, str | None]
"""Effect and joint; the joint of an effect of the whole robot is None."""


@dataclass(frozen=True)
class CrossCheck:
    """What another look says of one effect.

    Attributes:
        what: which look, in words.
        leads: effect and joint that lead there; None if nothing surely does.
        agrees: True if that is the effect, if the data there do not tell it from the effect, or if
            nothing is sure there.
    """

    what: str
    leads: Key | None
    agrees: bool

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        leads = (
            None if self.leads is None else dict(zip(("effect", "joint"), self.leads, strict=True))
        )
        return {"what": self.what, "leads": leads, "agrees": self.agrees}


def other_observations(
    data: SearchData, mending: LogRepair, other: SearchData | None
) -> Iterator[tuple[str, SearchData]]:
    """The same robot's data, looked at otherwise.

    Args:
        data: the training logs.
        mending: of them.
        other: held-out logs in the same band.
    """
    if other is not None:
        yield "the held-out logs", other
    for factor, seen in cut_off_otherwise(data, mending):
        yield f"cut-offs x {factor:g}", dataclasses.replace(data, observation=seen)
        del seen  # or it would live beside the next


def cut_off_otherwise(data: SearchData, mending: LogRepair) -> Iterator[tuple[float, Observation]]:
    """The training logs with the filters elsewhere, by `FACTORS`."""
    processing, logs = data.observation.report.processing, mending.logs
    highest = HIGHEST / max(log.step for log in logs)
    for factor in FACTORS:
        cut = {
            name: min(factor * value, highest)
            for name in ("position_cutoff", "parallel_cutoff")
            if (value := getattr(processing, name))
        }
        changed = dataclasses.replace(processing, **cut, decimation=None, edge=None)
        yield factor, analysed(data.compiled, logs, changed, chosen=True, mending=mending)


def recheck_effects(
    found: Search, looks: Iterable[tuple[str, SearchData]], tick: Tick = lambda: None
) -> list[tuple[CrossCheck, ...]]:
    """What the other looks say of every effect that was put in, in order.

    Args:
        found: the search in the first look.
        looks: others, one after the other: each is let go before the next is made.
        tick: called after each.
    """
    said: list[list[CrossCheck]] = [[] for _ in found.steps]
    for what, data in looks if found.steps else ():
        for place, own in enumerate(said):
            own.append(_observe_otherwise(what, data, found, place))
            tick()
        del data
    return [(*own, *_ruled_out(found, s)) for own, s in zip(said, found.steps, strict=True)]


def _ruled_out(found: Search, step: Step) -> list[CrossCheck]:
    """What would have been named had the user ruled nothing out, or explains as much as simply."""
    if not found.without:
        return []
    state = step.before
    barred = [c for c in generate_candidates(state) if ruled_out(*c.key, found.without)]
    if not barred:
        return []
    asked = scan_candidates(state, [step.pick, *barred]).judged()
    own = [j for j in asked.ranked if j.key == step.pick.key]
    least = own[0].fall if own else 0.0
    alike = (
        j for j in asked.ranked
        if j not in own and j.significant and j.fall >= least
        and numbers(j.candidate) <= numbers(step.pick)
    )  # fmt: skip
    best = next(alike, asked.best)
    if best is None or best.key == step.pick.key:
        return []
    return [CrossCheck("ruled out", best.key, False)]


def _observe_otherwise(what: str, data: SearchData, found: Search, place: int) -> CrossCheck:
    step = found.steps[place]
    picks = [s.pick for s in found.steps[: place + 1]]
    if not all(_logged(data, pick) for pick in picks):
        return CrossCheck(what, None, True)
    # the state in which the effect was chosen, from other data
    state = about_itself(state_of(data, picks[:-1], step.before.beta))
    judged = _recheck(state, step, found)
    best = decide(state, judged).best
    if best is None:
        return CrossCheck(what, None, True)
    alike = {best.key, *(j.key for j in tied(best, judged))}
    return CrossCheck(what, best.key, step.pick.key in alike)


def _logged(data: SearchData, candidate: Candidate) -> bool:
    """False for what reads a temperature that these logs lack."""
    temperature = data.rows.signals[0].reference.temperature
    return "T" not in candidate.form.names or candidate.joint in temperature


def _recheck(state: State, step: Step, found: Search) -> list[Judged]:
    """The effect and its nearest rivals, each at the best of its shapes."""
    refused = {j.key for j in found.vetoed}
    rivals = [j.candidate for j in step.rivals if j.key not in refused][:RIVALS]
    first = [step.pick, *rivals]
    keys = {c.key for c in first}
    again = [c for c in generate_candidates(state, None, found.without, keys) if c.key in keys]
    return list(
        scan_candidates(state, [c for c in (*first, *again) if _logged(state.data, c)]).best
    )
