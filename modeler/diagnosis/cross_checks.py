"""Other looks at the same machine: what names an effect must hold in all of them.

The first look is at the training logs, in the band of the diagnosis. The others change what has
nothing to do with the robot: the held-out logs take the place of the training logs, and the band is
another, wide or narrow. An effect that another one on its joint surely beats there, or that no
longer explains anything, is a matter of the look. And what the user ruled out is asked beside every
effect: if it would have been named instead, the effect stands in for it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.json import entries
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import dense
from modeler.diagnosis.generate import generate_candidates, ruled_out
from modeler.diagnosis.judge import (
    NEARLY,
    Judged,
    decide,
    holdout_residuals,
    numbers,
    on_logs,
    refines,
    tied,
)
from modeler.diagnosis.score import Residuals, errors_of
from modeler.diagnosis.search import Search, Step, Tick, about_itself, scan_candidates
from modeler.diagnosis.state import SearchData, State, columns_of, state_of
from modeler.diagnosis.timing import smoothed
from modeler.estimation import IdentifiedModel, identify
from modeler.observation import Log, observed, prepare

RIVALS = 8
"""Effects that are asked again in the other looks: those that came nearest."""


Key = tuple[str, str | None]
"""Effect and joint; the joint of an effect of the whole robot is None."""


@dataclass(frozen=True)
class CrossCheck:
    """What another look says of one effect.

    Attributes:
        what: which look, in words.
        leads: effect and joint that lead there on its joint; None if nothing surely does.
        agrees: True if that is the effect, if the data there do not tell it from the effect, or if
            nothing is sure there.
        gain: fall of the residual variance of its joints there, cross-validated; NaN if unknown.
        expected: what the values that it was named with let expect of it there; 0 if unknown.
    """

    what: str
    leads: Key | None
    agrees: bool
    gain: float = math.nan
    expected: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        leads = (
            None if self.leads is None else dict(zip(("effect", "joint"), self.leads, strict=True))
        )
        return {"leads": leads, **entries(self, "what agrees gain expected")}


@dataclass(frozen=True, eq=False)
class OtherLook:
    """Another look.

    Attributes:
        what: which, in words.
        data: the logs in it.
        asks: True if an effect must show there; held-out logs have vetoed what does not.
    """

    what: str
    data: SearchData
    asks: bool = True


def recheck_effects(
    found: Search, looks: Sequence[OtherLook], tick: Tick = lambda: None
) -> list[tuple[CrossCheck, ...]]:
    """What the other looks say of every effect that was put in, in order.

    Args:
        found: the search in the first look.
        looks: others.
        tick: called after each.
    """
    said: list[list[CrossCheck]] = [[] for _ in found.steps]
    for look in looks:
        for place, own in enumerate(said):
            own.append(_observe_otherwise(look, found, place))
            tick()
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
    least = NEARLY * own[0].fall if own else 0.0
    alike = (
        j for j in asked.ranked
        if j not in own and j.significant and j.fall >= least
        and numbers(j.candidate) <= numbers(step.pick)
    )  # fmt: skip
    best = next(alike, asked.best)
    if best is None or best.key == step.pick.key:
        return []
    return [CrossCheck("ruled out", best.key, False)]


def _observe_otherwise(look: OtherLook, found: Search, place: int) -> CrossCheck:
    what, data, step = look.what, look.data, found.steps[place]
    picks = [*found.start.picks, *(s.pick for s in found.steps[: place + 1])]
    if not all(_logged(data, pick) for pick in picks):
        return CrossCheck(what, None, True)
    # the state in which the effect was chosen, from other data
    state = about_itself(state_of(data, picks[:-1], step.before.beta))
    judged = _recheck(state, step, found)
    own = [j.gain for j in judged if j.key == step.pick.key]
    gain = own[0] if own else 0.0
    expected = _expected(state, step) if look.asks else 0.0
    joint = step.pick.joint
    near = [j for j in judged if joint is None or j.key[1] in (None, joint)]
    best = decide(state, near).best
    if best is None:
        return CrossCheck(what, None, True, gain, expected)
    alike = {best.key, *(j.key for j in tied(best, judged))}
    if refines(best.candidate, step.pick):
        alike.add(step.pick.key)
    return CrossCheck(what, best.key, step.pick.key in alike, gain, expected)


def _expected(state: State, step: Step) -> float:
    """Fall of the residual variance of its joints that the values of an effect let expect.

    Of the smooth motion: what the noise of the positions does to its columns explains nothing.
    """
    columns, base = columns_of(smoothed(state), step.pick), state.base
    felt = [
        dense(columns, j, len(y)) @ step.judged.values / s
        for j, (y, s) in enumerate(zip(base.y, base.sigma, strict=True))
    ]
    hidden = sum(own.T @ torque for own, torque in zip(base.columns, felt, strict=True))
    fall = sum(float(torque @ torque) for torque in felt) - float(np.sum(hidden**2))
    before = state.ranked([]).before[step.pick.concerns(len(felt))]
    return fall / max(float(before.sum()), 1e-300)


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


# Is the machine of the held-out logs that of the training logs?


DIFFERS = 2.0
"""Ratio of the held-out error of a joint to that of a fit to the held-out logs alone, and to that
of the training logs (both cross-validated), from which on the machine may differ."""

MOVED = 5.0
"""Standard deviations of the difference from which on a parameter has changed."""

FELT = 0.005
"""Least rms torque of its change, over that of a joint, on the held-out logs."""


@dataclass(frozen=True)
class ParameterChange:
    """A base parameter that differs between the training and the held-out logs.

    Attributes:
        name: of the parameter.
        before, after: fitted to the training logs, and to the held-out logs alone.
        sigma_before, sigma_after: standard deviations.
        unit: of all four.
        share: rms torque of the change over that of the joint where it is largest.
    """

    name: str
    before: float
    after: float
    sigma_before: float
    sigma_after: float
    unit: str
    share: float


def changed_parameters(
    model: IdentifiedModel, found: Search, other: SearchData, left: Residuals, logs: Sequence[Log]
) -> tuple[ParameterChange, ...]:
    """Parameters in which the machine of the held-out logs differs, the most important first.

    Args:
        model: as given.
        found: the search on the training logs.
        other: the held-out logs.
        left: what the model with all effects leaves of these.
        logs: the same logs.
    """
    there = on_logs(found.end, other)
    alone, own = (errors_of(holdout_residuals(state, None)) for state in (there, found.end))
    most = {joint: DIFFERS * max(alone[joint], own.get(joint, 0.0)) for joint in alone}
    misses = any(error > most.get(joint, math.inf) for joint, error in errors_of(left).items())
    if not misses or other.kept is not None:
        return ()
    rows = observed(other.compiled, logs, prepare(other.spec, logs, model.processing))
    fitted = identify(rows, "weighted", other.compiled).parameters
    moved = []
    for i, (a, b) in enumerate(zip(model.fit.parameters, fitted, strict=True)):
        change = b.value - a.value
        share = max(
            abs(change) * float(np.linalg.norm(w[:, i])) / (float(np.linalg.norm(y)) or math.inf)
            for w, y in zip(there.rows.W, there.rows.y, strict=True)
        )
        if a.sigma is None or b.sigma is None or share < FELT:
            continue
        if abs(change) > MOVED * math.hypot(a.sigma, b.sigma):
            moved.append(ParameterChange(a.name, a.value, b.value, a.sigma, b.sigma, a.unit, share))
    return tuple(sorted(moved, key=lambda own: -own.share))
