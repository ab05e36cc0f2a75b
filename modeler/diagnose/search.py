"""The search: name the best effect, refine it, put it in, look again; drop what is not needed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.judge import Judged, Judgement, alternatives, judge
from modeler.diagnose.polish import polished
from modeler.diagnose.propose import proposals
from modeler.diagnose.state import Data, State, columns_of, state_of, visible
from modeler.effects import RIPPLES

MOST = 8
"""Effects named in one diagnosis."""

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
    start = state_of(data, (), beta)
    state = start = state_of(data, (), start.beta, start.cache)
    steps: list[Step] = []
    vetoed: list[Candidate] = []
    judgement = judged_state(state, without, vetoed) if most else Judgement((), None)
    while judgement.best is not None and len(steps) < most:
        best = judgement.best
        later = extended(state, best.candidate)
        if veto is not None and veto(state, later, best):
            vetoed.append(best.candidate)
            judgement = judged_state(state, without, vetoed)
            continue
        after = judged_state(later, without, vetoed)
        rivals = judgement.others(best)
        ties = tuple(alternatives(best, rivals, after))
        steps.append(Step(best.candidate, best, rivals, state, ties))
        state, judgement = later, after
        if progress is not None:
            progress(len(steps) / (most + 1))
    kept, state = _backward(state, steps)
    return Search(start, tuple(kept), state, judgement, tuple(vetoed), tuple(without))


def judged_state(
    state: State,
    without: Sequence[str] = (),
    vetoed: Sequence[Candidate] = (),
    only: str | None = None,
) -> Judgement:
    """All candidates in a state, or those of one effect; the leading ones refined."""
    gone = {c.key for c in vetoed if not _ripples(c)}
    orders = [c.shapes["m"] for c in vetoed if _ripples(c)]
    found = [
        c for c in proposals(state)
        if only in (None, c.effect.id) and c.key not in gone
        and not ruled_out(c.effect.id, c.joint, without)
        and not (_ripples(c) and any(abs(c.shapes["m"] - m) < 0.1 * m for m in orders))
    ]  # fmt: skip
    columns = [columns_of(state.rows, c, state.cache) for c in found]
    seen = [i for i, c in enumerate(columns) if visible(c)]
    found, columns = [found[i] for i in seen], [columns[i] for i in seen]
    first = judge(state, found, columns)
    leading = [
        j for j in first.ranked[:5]
        if j.possible and j.gain > CLOSE * first.ranked[0].gain and j.gain > 0.02
    ]  # fmt: skip
    for item in leading:
        better = polished(state, item.candidate)
        if better is not item.candidate:
            place = next(i for i, c in enumerate(found) if c is item.candidate)
            found[place], columns[place] = better, columns_of(state.rows, better, {})
    if not leading:
        return first
    again = _contenders(found, first, leading)
    return judge(state, [found[i] for i in again], [columns[i] for i in again])


def _contenders(
    found: Sequence[Candidate], first: Judgement, leading: Sequence[Judged]
) -> list[int]:
    """Places of what may win still: of effects that were not refined, the best shapes only."""
    refined = {j.candidate.key for j in leading}
    best = {id(j.candidate) for j in first.ranked}
    return [i for i, c in enumerate(found) if c.key in refined or id(c) in best]


def _ripples(candidate: Candidate) -> bool:
    return candidate.effect.id in RIPPLES


def ruled_out(effect: str, joint: str | None, without: Sequence[str]) -> bool:
    """True if the user rules out the effect, everywhere or on that joint."""
    return effect in without or f"{effect}@{joint}" in without


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
