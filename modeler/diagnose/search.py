"""The search: name the best effect, refine it, put it in, look again; drop what is not needed."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np

from modeler.diagnose.braking import DRIVES, drives
from modeler.diagnose.judge import (
    Judged,
    Judgement,
    Order,
    alternatives,
    decide,
    judge,
    judged_at,
    leading,
    sift,
)
from modeler.diagnose.levers import constant_force
from modeler.diagnose.plausible import objection
from modeler.diagnose.values import values_of
from modeler.effects import effect_named
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.rows import Columns
from modeler.scoring.polish import best_polished
from modeler.scoring.propose import proposals, ruled_out
from modeler.scoring.state import Data, State, all_columns_of, columns_of, state_of, visible

_T = TypeVar("_T")

MOST = 8
"""Effects named in one diagnosis."""

ASKED = 20
"""Effects that are refused in one diagnosis before it ends: where held-out motion refuses that
many, it is other motion, or the logs hold nothing that returns."""

STARTS = 4
"""Grid values from which an effect with two shapes is refined: its fit has several summits."""

NEAR = 0.95
"""Share of the best fall with which another fixed shape of an effect is refined too."""

CLOSE = 0.7
"""Rivals with this share of the best fall are refined before the best is chosen: up to `MANY`."""

MANY = 5

WORTH = 0.02
"""Gain below which nothing is refined."""


@dataclass(frozen=True, eq=False)
class Step:
    """One effect that was put in.

    Attributes:
        judged: the effect, and its numbers when it was chosen.
        rivals: the others then, best first.
        before: the state it was chosen in.
        ties: rivals that the data do not tell from it.
    """

    judged: Judged
    rivals: tuple[Judged, ...]
    before: State
    ties: tuple[Judged, ...] = ()

    @property
    def pick(self) -> Candidate:
        """The effect on its joint, with its shapes."""
        return self.judged.candidate


@dataclass(frozen=True, eq=False)
class Search:
    """What a search found.

    Attributes:
        start: the model as given.
        steps: effects put in, in order; those that later ones made unnecessary are left out.
        end: the model with them.
        last: the judgement that ended it.
        vetoed: effects that would have raised the error on held-out logs, when they led.
        without: what the user ruled out.
    """

    start: State
    steps: tuple[Step, ...]
    end: State
    last: Judgement
    vetoed: tuple[Judged, ...] = ()
    without: tuple[str, ...] = ()


Veto = Callable[[State, State], bool]
"""True if an effect does not lower the error on held-out logs: state without it, and with it."""


def search(
    data: Data,
    beta: np.ndarray,
    without: Sequence[str] = (),
    most: int = MOST,
    veto: Veto | None = None,
    tick: Callable[[], None] = lambda: None,
) -> Search:
    """Effects that the model lacks, one by one.

    Args:
        data: training logs.
        beta: (c,) parameters of the model, where effects are linearised first.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most; with 0 nothing is judged.
        veto: looks at held-out logs.
        tick: called whenever something is done.
    """
    start = state = _started(data, beta)
    steps, refused = list[Step](), list[Judged]()
    survey = surveyed(state, without) if most else None
    judgement = survey.judged((), tick) if survey else Judgement((), None)
    while survey is not None and judgement.best is not None and len(steps) < most:
        if len(refused) == ASKED:
            break
        first = judgement.best
        accepted = put_in(state, _named(state, first, refused, without), veto)
        if isinstance(accepted, Refused):
            refused.append(accepted.judged)
            judgement = survey.judged(refused, tick)
            continue
        (best, later), survey = accepted, surveyed(accepted[1], without)
        after = survey.judged(refused, tick)
        steps.append(_step(state, best, judgement.others(first), after))
        state, judgement = later, after
    if not steps and (described := _description(start, refused, judgement)):
        steps, state = [described], extended(start, described.pick)
    kept, state = _backward(state, steps, veto, tick)
    return Search(start, tuple(kept), state, judgement, tuple(refused), tuple(without))


def _description(start: State, refused: Sequence[Judged], last: Judgement) -> Step | None:
    """Where nothing was named, what describes the logs best though it cannot be the cause."""
    doubted = [judged for judged in refused if judged.why not in ("", DRIVES)]
    if not doubted:
        return None
    best = max(doubted, key=lambda judged: judged.share)
    return Step(best, last.others(best), start)


def _step(state: State, best: Judged, rivals: tuple[Judged, ...], after: Judgement) -> Step:
    return Step(best, rivals, state, tuple(alternatives(best, rivals, after)))


@dataclass(frozen=True, eq=False)
class Refused:
    """An effect that was not put in; `judged.why` says why if physics refused it."""

    judged: Judged


def put_in(state: State, best: Judged, veto: Veto | None) -> tuple[Judged, State] | Refused:
    """The effect, and the state with it."""
    later = extended(state, best.candidate)
    why = DRIVES if drives(state, later, best.candidate) else _objection(later)
    if why:
        return Refused(dataclasses.replace(best, possible=False, why=why))
    return Refused(best) if veto is not None and veto(state, later) else (best, later)


def _objection(later: State) -> str:
    """Why the values of the last effect cannot be those of this robot; empty if they can."""
    pick, values = later.picks[-1], later.values[-1]
    named = values_of(later, pick, values, np.zeros(len(values)))
    return objection(later, pick, named.value | dict(pick.shapes))


def _named(state: State, best: Judged, vetoed: Sequence[Judged], without: Sequence[str]) -> Judged:
    """The best effect, or its twin of another law where that explains the same with less."""
    other = effect_named(best.candidate.effect.twin, state.data.known.catalogue)
    joint = best.candidate.joint
    if other is None or ruled_out(other.id, joint, without):
        return best
    pull = constant_force(state, best.candidate, other)
    if pull is None or _among(pull, vetoed):
        return best
    return judge(state, [pull], [columns_of(state.rows, pull, state.cache)]).ranked[0]


def _started(data: Data, beta: np.ndarray) -> State:
    """Without any effect, linearised about its own parameters."""
    given = state_of(data, (), beta)
    return state_of(data, (), given.beta, given.cache)


@dataclass(frozen=True, eq=False)
class Survey:
    """Every candidate in a state.

    Attributes:
        state: it.
        found: candidates that show.
        columns: theirs.
        best: every effect on every joint at the best of its shapes, none refined, best first.
        order: what chooses among the shapes of `found`.
        refined: effects that were refined, by the shapes that this began with.
    """

    state: State
    found: Sequence[Candidate]
    columns: Sequence[Columns]
    best: Sequence[Judged]
    order: Sequence[Order] = ()
    refined: dict[tuple[Any, ...], Judged] = field(default_factory=dict)

    def but(self, vetoed: Sequence[Judged]) -> "Survey":
        """The same without what was vetoed."""
        left = [i for i, c in enumerate(self.found) if not _among(c, vetoed)]
        if len(left) == len(self.found):
            return self
        found, columns = _picked(self.found, left), _picked(self.columns, left)
        order = _picked(self.order, left)
        touched = {c.key for c in self.found if _among(c, vetoed)}
        again = [i for i in leading(found, order) if found[i].key in touched]
        best = [j for j in self.best if j.candidate.key not in touched]
        best += judged_at(self.state, found, columns, again)
        best.sort(key=lambda j: -float(j.drop.sum()))
        return Survey(self.state, found, columns, best, order, self.refined)

    def judged(
        self, vetoed: Sequence[Judged] = (), tick: Callable[[], None] = lambda: None
    ) -> Judgement:
        """All but what was vetoed; the leading ones refined, with a tick after each."""
        left = self.but(vetoed)
        close = [
            j for j in left.best[:MANY]
            if j.possible and j.share > CLOSE * left.best[0].share and j.gain > WORTH
        ]  # fmt: skip
        # Of effects that were not refined, only the best shapes may win still.
        refined = {}
        for item in close:
            refined[item.candidate.key] = left.at_best(item)
            tick()
        best = [refined.get(j.candidate.key, j) for j in left.best]
        return decide(self.state, sorted(best, key=lambda j: -float(j.drop.sum())))

    def at_best(self, judged: Judged) -> Judged:
        """An effect with its best shapes refined, or with the next best if these do better."""
        starts = self.starts(judged.candidate)
        key = tuple((*c.key, *c.shapes.items()) for c in starts)
        if key not in self.refined:
            self.refined[key] = self._refined(judged, starts)
        return self.refined[key]

    def _refined(self, judged: Judged, starts: Sequence[Candidate]) -> Judged:
        better = best_polished(self.state, starts)
        if better is judged.candidate:
            return judged
        first = judged.candidate
        others = [i for i, c in enumerate(self.found) if c.key == first.key and c is not first]
        found = [better, *_picked(self.found, others)]
        columns = [columns_of(self.state.rows, better, {}), *_picked(self.columns, others)]
        order = [*sift(self.state, found[:1], columns[:1]), *_picked(self.order, others)]
        return judged_at(self.state, found, columns, leading(found, order))[0]

    def starts(self, first: Candidate) -> list[Candidate]:
        """Shapes of one effect from which refining starts, the best first.

        With one shape to refine, the best for each value of the others, if it comes near; with
        more, the best few.
        """
        refined = [s.name for s in first.form.shapes if s.smooth and len(s.grid) > 1]
        if len(first.form.shapes) < 2 or not refined:
            return [first]
        own = [i for i, c in enumerate(self.found) if c.key == first.key]
        total = np.array([self.order[i][1] for i in own])
        least = NEAR * float(total.max()) if len(refined) == 1 else -np.inf
        places = [own[k] for k in np.argsort(-total) if total[k] >= least]
        order = [first, *(c for c in (self.found[i] for i in places) if c is not first)]
        if len(refined) > 1:
            return order[:STARTS]
        best: dict[tuple[float, ...], Candidate] = {}
        for c in order:
            best.setdefault(tuple(v for n, v in c.shapes.items() if n != refined[0]), c)
        return list(best.values())


def surveyed(
    state: State, without: Sequence[str] = (), only: str | None = None, joint: str | None = None
) -> Survey:
    """All candidates in a state, or those of one effect, or of one joint."""
    return survey_of(
        state, [c for c in proposals(state, only, without) if joint in (None, c.joint)]
    )


def survey_of(state: State, found: Sequence[Candidate]) -> Survey:
    """Some candidates in a state; those that show."""
    columns = all_columns_of(state.rows, found, state.cache)
    seen = [i for i, c in enumerate(columns) if visible(c)]
    found, columns = _picked(found, seen), _picked(columns, seen)
    order = sift(state, found, columns)
    best = judged_at(state, found, columns, leading(found, order))
    return Survey(state, found, columns, best, order)


def _picked(items: Sequence[_T], places: Sequence[int]) -> list[_T]:
    return [items[i] for i in places]


def _among(candidate: Candidate, vetoed: Sequence[Judged]) -> bool:
    """True if it was vetoed; of ripples, all orders that differ by less than a tenth."""
    others = [judged.candidate for judged in vetoed]
    if not _ripples(candidate):
        return any(c.key == candidate.key for c in others if not _ripples(c))
    order = candidate.order
    orders = [c.order for c in others if _ripples(c)]
    return any(abs(order - m) < 0.1 * m for m in orders)


def _ripples(candidate: Candidate) -> bool:
    return candidate.effect.several


def extended(state: State, pick: Candidate) -> State:
    """The state with one effect more, linearised about its own parameters."""
    picks = (*state.picks, pick)
    once = state_of(state.data, picks, state.beta, state.cache)
    return state_of(state.data, picks, once.beta, state.cache)


def _backward(
    state: State, steps: Sequence[Step], veto: Veto | None, tick: Callable[[], None]
) -> tuple[list[Step], State]:
    """Drops effects that the others made unnecessary, the weakest first.

    What the others gain is judged again then, beside those that are left.
    """
    kept = list(steps)
    while len(kept) > 1:
        idle = {}
        for k, step in enumerate(kept):
            judged, less = _beside(state, kept, step)
            if not judged.significant or (veto is not None and veto(less, state)):
                idle[k] = judged.gain
            tick()
        if not idle:
            break
        del kept[min(idle, key=lambda k: idle[k])]
        state = state_of(state.data, [s.pick for s in kept], state.beta, state.cache)
    if len(kept) < len(steps):
        kept = [dataclasses.replace(s, judged=_beside(state, kept, s)[0]) for s in kept]
    return kept, state


def _beside(state: State, kept: Sequence[Step], step: Step) -> tuple[Judged, State]:
    """One of the effects, judged in the model with the others, and that model."""
    others = [s.pick for s in kept if s is not step]
    less = state_of(state.data, others, state.beta, state.cache)
    columns = columns_of(less.rows, step.pick, state.cache)
    return judge(less, [step.pick], [columns]).ranked[0], less
