"""Every hypothesis in a state: at the best of its shapes, the leading ones refined."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np

from modeler.diagnose.judge import (
    Judged,
    Judgement,
    Order,
    decide,
    judged_at,
    leading,
    sift,
)
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.rows import Columns
from modeler.scoring.gains import all_columns_about
from modeler.scoring.polish import best_polished
from modeler.scoring.propose import proposals
from modeler.scoring.state import State, columns_of, visible

_T = TypeVar("_T")

STARTS = 4
"""Grid values from which an effect with two shapes is refined: its fit has several summits."""

NEAR = 0.95
"""Share of the best fall with which another fixed shape of an effect is refined too."""

CLOSE = 0.7
"""Rivals with this share of the best fall are refined before the best is chosen: up to `MANY`."""

MANY = 5

BETTER = 0.5
"""What a refused effect may leave, over what it left then, to be asked for again: of two wrong
drive gains, the second mends the first."""

WORTH = 0.02
"""Gain below which nothing is refined."""


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

    def still(self, refused: Sequence[Judged]) -> list[Judged]:
        """Vetoed effects that have not become far better by the effect put in since."""
        gains = {judged.candidate.key: judged.gain for judged in self.best}
        return [
            j for j in refused
            if j.mends or 1.0 - gains.get(j.candidate.key, 0.0) > BETTER * (1.0 - j.gain)
        ]  # fmt: skip

    def but(self, vetoed: Sequence[Judged]) -> "Survey":
        """The same without what was vetoed."""
        left = [i for i, c in enumerate(self.found) if not among(c, vetoed)]
        if len(left) == len(self.found):
            return self
        found, columns = _picked(self.found, left), _picked(self.columns, left)
        order = _picked(self.order, left)
        touched = {c.key for c in self.found if among(c, vetoed)}
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
    columns = all_columns_about(state, found)
    seen = [i for i, c in enumerate(columns) if visible(c)]
    found, columns = _picked(found, seen), _picked(columns, seen)
    if not found:
        return Survey(state, (), (), (), ())
    order = sift(state, found, columns)
    best = judged_at(state, found, columns, leading(found, order))
    return Survey(state, found, columns, best, order)


def _picked(items: Sequence[_T], places: Sequence[int]) -> list[_T]:
    return [items[i] for i in places]


def among(candidate: Candidate, vetoed: Sequence[Judged]) -> bool:
    """True if it was vetoed; of ripples, all orders that differ by less than a tenth."""
    others = [judged.candidate for judged in vetoed]
    if not candidate.effect.several:
        return any(c.key == candidate.key for c in others if not c.effect.several)
    order = candidate.order
    orders = [c.order for c in others if c.effect.several]
    return any(abs(order - m) < 0.1 * m for m in orders)
