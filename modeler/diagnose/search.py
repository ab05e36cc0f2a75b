"""The search: name the best effect, refine it, put it in, look again; drop what is not needed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.judge import (
    Judged,
    Judgement,
    alternatives,
    best_shapes,
    decide,
    judge,
)
from modeler.diagnose.polish import best_polished
from modeler.diagnose.propose import proposals
from modeler.diagnose.rows import Columns
from modeler.diagnose.state import Data, State, columns_of, state_of, visible
from modeler.effects import RIPPLES

_T = TypeVar("_T")

MOST = 8
"""Effects named in one diagnosis."""

STARTS = 4
"""Grid values from which an effect with two shapes is refined: its fit has several summits."""

CLOSE = 0.7
"""Rivals with this share of the best gain are refined before the best is chosen."""


@dataclass(frozen=True, eq=False)
class Step:
    """One effect that was put in.

    Attributes:
        pick: refined.
        judged: its numbers when it was chosen.
        rivals: the others then, best first.
        before: the state it was chosen in.
        ties: rivals that the data do not tell from it.
    """

    pick: Candidate
    judged: Judged
    rivals: tuple[Judged, ...]
    before: State
    ties: tuple[Judged, ...] = ()


@dataclass(frozen=True, eq=False)
class Search:
    """What a search found.

    Attributes:
        start: the model as given.
        steps: effects put in, in order; those that later ones made unnecessary are left out.
        end: the model with them.
        last: the judgement that ended it.
        vetoed: effects that would have raised the error on held-out logs.
        without: what the user ruled out.
    """

    start: State
    steps: tuple[Step, ...]
    end: State
    last: Judgement
    vetoed: tuple[Candidate, ...] = ()
    without: tuple[str, ...] = ()


Veto = Callable[[State, State, Judged], bool]
"""True if an effect does not lower the error on held-out logs: state without it, with it, the
effect as it was judged."""


def search(
    data: Data,
    beta: np.ndarray,
    without: Sequence[str] = (),
    most: int = MOST,
    veto: Veto | None = None,
    progress: Callable[[float], None] | None = None,
) -> Search:
    """Effects that the model lacks, one after the other.

    Args:
        data: training logs.
        beta: (c,) parameters of the model, where effects are linearised first.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most; with 0 nothing is judged.
        veto: looks at held-out logs.
        progress: called with a share between 0 and 1.
    """
    state = start = _started(data, beta)
    steps: list[Step] = []
    vetoed: list[Candidate] = []
    survey = surveyed(state, without) if most else None
    judgement = survey.judged() if survey is not None else Judgement((), None)
    while survey is not None and judgement.best is not None and len(steps) < most:
        best = judgement.best
        later = extended(state, best.candidate)
        if veto is not None and veto(state, later, best):
            vetoed.append(best.candidate)
            judgement = survey.judged(vetoed)
            continue
        survey = surveyed(later, without)
        after = survey.judged(vetoed)
        rivals = judgement.others(best)
        ties = tuple(alternatives(best, rivals, after))
        steps.append(Step(best.candidate, best, rivals, state, ties))
        state, judgement = later, after
        if progress is not None:
            progress(len(steps) / (most + 1))
    kept, state = _backward(state, steps)
    return Search(start, tuple(kept), state, judgement, tuple(vetoed), tuple(without))


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
    """

    state: State
    found: Sequence[Candidate]
    columns: Sequence[Columns]
    best: Sequence[Judged]

    def but(self, vetoed: Sequence[Candidate]) -> "Survey":
        """The same without what was vetoed."""
        left = [i for i, c in enumerate(self.found) if not _among(c, vetoed)]
        if len(left) == len(self.found):
            return self
        kept = _picked(self.found, left), _picked(self.columns, left)
        touched = {c.key for c in self.found if _among(c, vetoed)}
        again = [i for i in left if self.found[i].key in touched]
        best = [j for j in self.best if j.candidate.key not in touched]
        if again:
            columns = _picked(self.columns, again)
            best += best_shapes(self.state, _picked(self.found, again), columns)
        return Survey(self.state, *kept, sorted(best, key=lambda j: -float(j.drop.sum())))

    def judged(self, vetoed: Sequence[Candidate] = ()) -> Judgement:
        """All but what was vetoed; the leading ones refined."""
        left = self.but(vetoed)
        state, found, columns = self.state, list(left.found), list(left.columns)
        leading = [
            j for j in left.best[:5]
            if j.possible and j.gain > CLOSE * left.best[0].gain and j.gain > 0.02
        ]  # fmt: skip
        if not leading:
            return decide(state, list(left.best))
        for item in leading:
            better = best_polished(state, self._starts(item.candidate))
            if better is not item.candidate:
                place = next(i for i, c in enumerate(found) if c is item.candidate)
                found[place], columns[place] = better, columns_of(state.rows, better, {})
        # Of effects that were not refined, only the best shapes may win still.
        keys, best = {j.candidate.key for j in leading}, {id(j.candidate) for j in left.best}
        again = [i for i, c in enumerate(found) if c.key in keys or id(c) in best]
        return judge(state, _picked(found, again), _picked(columns, again))

    def _starts(self, first: Candidate) -> list[Candidate]:
        """Shapes of one effect from which refining starts, the best first."""
        if sum(shape.smooth for shape in first.form.shapes) < 2:
            return [first]
        own = [i for i, c in enumerate(self.found) if c.key == first.key]
        total = self.state.ranked(_picked(self.columns, own))[1].drop.sum(axis=0)
        order = [self.found[own[k]] for k in np.argsort(-total)]
        return [first, *(c for c in order if c is not first)][:STARTS]


def surveyed(state: State, without: Sequence[str] = (), only: str | None = None) -> Survey:
    """All candidates in a state, or those of one effect."""
    found = proposals(state, only, without)
    columns = [columns_of(state.rows, c, state.cache) for c in found]
    seen = [i for i, c in enumerate(columns) if visible(c)]
    found, columns = _picked(found, seen), _picked(columns, seen)
    return Survey(state, found, columns, best_shapes(state, found, columns))


def _picked(items: Sequence[_T], places: Sequence[int]) -> list[_T]:
    return [items[i] for i in places]


def _among(candidate: Candidate, vetoed: Sequence[Candidate]) -> bool:
    """True if it was vetoed; of ripples, all orders that differ by less than a tenth."""
    if not _ripples(candidate):
        return any(c.key == candidate.key for c in vetoed if not _ripples(c))
    order = candidate.shapes["m"]
    orders = [c.shapes["m"] for c in vetoed if _ripples(c)]
    return any(abs(order - m) < 0.1 * m for m in orders)


def _ripples(candidate: Candidate) -> bool:
    return candidate.effect.id in RIPPLES


def extended(state: State, pick: Candidate) -> State:
    """The state with one effect more, linearised about its own parameters."""
    picks = (*state.picks, pick)
    once = state_of(state.data, picks, state.beta, state.cache)
    return state_of(state.data, picks, once.beta, state.cache)


def _backward(state: State, steps: Sequence[Step]) -> tuple[list[Step], State]:
    """Drops effects that the others made unnecessary, the weakest first."""
    kept = list(steps)
    while len(kept) > 1:
        gains = []
        for step in kept:
            others = [s.pick for s in kept if s is not step]
            less = state_of(state.data, others, state.beta, state.cache)
            columns = [columns_of(less.rows, step.pick, state.cache)]
            gains.append(judge(less, [step.pick], columns).ranked[0])
        weakest = int(np.argmin([g.gain for g in gains]))
        if gains[weakest].significant:
            break
        del kept[weakest]
        state = state_of(state.data, [s.pick for s in kept], state.beta, state.cache)
    return kept, state
