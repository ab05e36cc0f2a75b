"""The search: name the best effect, refine it, put it in, look again; drop what is not needed."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from modeler.core.brief import Brief
from modeler.core.manifest import ModuleSpec
from modeler.diagnosis.candidates import Candidate, coded
from modeler.diagnosis.drive_gains import all_columns_about, is_gain, likeliest, settled_parameters
from modeler.diagnosis.generate import generate_candidates, slowest_ringing
from modeler.diagnosis.judge import (
    NEARLY,
    SAME,
    Judged,
    Judgement,
    Trial,
    alternatives,
    decide,
    judged_at,
    leading,
    tried,
)
from modeler.diagnosis.plausible import DRIVES, EITHER, drives, objection
from modeler.diagnosis.profile import explained_by, values_of
from modeler.diagnosis.state import SearchData, State, state_of, together, visible
from modeler.effects import Effect, Needs, Shape

_STEPS = 8
_TURNS = 5

WHOLE = 0.85
"""Share of the best fall with which a whole number of waves per turn is preferred: teeth, poles and
rollers are counted."""


def refined(
    state: State, candidate: Candidate, explained: Callable[[Candidate], float] | None = None
) -> Candidate:
    """The candidate at the shapes that explain most: variable projection.

    Args:
        state: of the model.
        candidate: where to begin.
        explained: by shapes; None: by motion left out of the fit.
    """
    explained = explained or partial(_explained, state)
    smooth = [shape for shape in candidate.form.shapes if candidate.refinable(shape)]
    if not smooth:
        return candidate
    scale = state.scales[candidate.scaled]
    start = np.array([coded(shape, candidate.shapes[shape.name]) for shape in smooth])
    reach = np.array([_reach(state, candidate, shape) for shape in smooth])
    if smooth[0].scale == "waves":
        low, high = np.zeros(1), np.full(1, np.inf)
    else:
        low, high = (
            np.array([coded(shape, scale.value(shape, shape.limits[k])) for shape in smooth])
            for k in (0, 1)
        )
        if candidate.effect.rings:
            low = np.maximum(low, [_lowest(state, shape) for shape in smooth])

    def lost(x: np.ndarray) -> float:
        return -explained(candidate.moved(smooth, np.clip(x, low, high)))

    if len(smooth) == 1:
        found = minimize_scalar(
            lambda x: lost(np.array([x])),
            bounds=(max(start[0] - reach[0], low[0]), min(start[0] + reach[0], high[0])),
            method="bounded",
            options={"maxiter": _STEPS},
        )
        x, score = np.array([found.x]), float(found.fun)
        whole = np.round(x)
        if smooth[0].scale == "waves" and lost(whole) < WHOLE * score:
            return candidate.moved(smooth, whole)
    else:
        corners = np.vstack([start, start + 0.5 * np.diag(reach)])
        found = minimize(
            lost, start, method="Nelder-Mead",
            options={"maxfev": _STEPS * 4, "initial_simplex": corners},
        )  # fmt: skip
        x, score = found.x, float(found.fun)
    better = score < lost(start)
    return candidate.moved(smooth, np.clip(x, low, high)) if better else candidate


def _lowest(state: State, shape: Shape) -> float:
    """Coded; of a frequency the least at which a joint rings."""
    return coded(shape, slowest_ringing(state)) if shape.scale == "hertz" else -np.inf


def _reach(state: State, candidate: Candidate, shape: Shape) -> float:
    """How far a value may lie from that of the grid: to the next; half a wave in the stroke."""
    if shape.scale == "angle":
        return 0.3
    if shape.scale == "waves":
        return float(np.pi / state.scales[candidate.index].range)
    if len(shape.grid) == 1:
        return np.log(2.0)
    unit = state.scales[candidate.index].unit(shape)
    gaps = np.diff([coded(shape, unit * value) for value in shape.grid])
    return float(gaps.max() if shape.scale == "own" else gaps[0])


def _explained(state: State, candidate: Candidate) -> float:
    """Fall of the squared residual, weighted, in held-out blocks; 0 of values that cannot be."""
    columns = state.rows.columns(candidate)
    if not visible(columns):
        return 0.0
    trial = tried(state, [(candidate, columns)])[0]
    return trial.fall if trial.possible else 0.0


# Every hypothesis in a state: at the best of its shapes, the leading ones refined.

Tick = Callable[[], None]
"""Called whenever something is done."""

STARTS = 4
"""Grid values from which an effect with two shapes is refined: its fit has several summits."""

AT_ONCE = 96
"""Candidates whose columns are in memory together."""

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
class HypothesisScan:
    """Every candidate in a state.

    Attributes:
        state: it.
        trials: candidates that show.
        best: every effect on every joint at the best of its shapes, none refined, best first.
        refined: effects that were refined, by the shapes that this began with.
    """

    state: State
    trials: Sequence[Trial]
    best: Sequence[Judged]
    refined: dict[tuple[Any, ...], Judged] = field(default_factory=dict)

    def still_refused(self, refused: Sequence[Judged]) -> list[Judged]:
        """Vetoed effects that have not become far better by the effect put in since."""
        gains = {judged.key: judged.gain for judged in self.best}
        return [
            j for j in refused if j.mends or 1.0 - gains.get(j.key, 0.0) > BETTER * (1.0 - j.gain)
        ]

    def excluding(self, vetoed: Sequence[Judged]) -> "HypothesisScan":
        """The same without what was vetoed."""
        touched = {t.candidate.key for t in self.trials if is_vetoed(t.candidate, vetoed)}
        if not touched:
            return self
        left = [t for t in self.trials if not is_vetoed(t.candidate, vetoed)]
        again = [t.candidate for t in leading(left) if t.candidate.key in touched]
        columns = all_columns_about(self.state, again)
        judged = judged_at(self.state, [*zip(again, columns, strict=True)])
        best = [*(j for j in self.best if j.key not in touched), *judged]
        best.sort(key=lambda j: -j.fall)
        return HypothesisScan(self.state, left, best, self.refined)

    def judged(self, vetoed: Sequence[Judged] = (), tick: Tick = lambda: None) -> Judgement:
        """All but what was vetoed; the leading ones refined, with a tick after each."""
        left = self.excluding(vetoed)
        close = [
            j for j in left.best[:MANY]
            if j.possible and j.share > CLOSE * left.best[0].share and j.gain > WORTH
        ]  # fmt: skip
        # Of effects that were not refined, only the best shapes may win still.
        refined = {}
        for item in close:
            starts = left.starts(item.candidate)
            key = tuple((*c.key, *c.shapes.items()) for c in starts)
            if key not in self.refined:
                self.refined[key] = left.at_best(item, starts)
            refined[item.key] = self.refined[key]
            tick()
        best = [refined.get(j.key, j) for j in left.best]
        return decide(self.state, sorted(best, key=lambda j: -j.fall))

    def at_best(self, judged: Judged, starts: Sequence[Candidate]) -> Judged:
        """An effect with its best shapes refined, or with the next best if these do better."""
        state, first = self.state, judged.candidate
        better = [refined(state, start) for start in starts]
        if better == [first]:
            return judged
        others = [t for t in self.trials if t.candidate.key == first.key]
        pairs = [(candidate, state.rows.columns(candidate)) for candidate in better]
        shown = [pair for pair in pairs if visible(pair[1])]
        (best,) = leading([*tried(state, shown), *others])
        columns = next((own for candidate, own in shown if candidate is best.candidate), None)
        if columns is None:
            (columns,) = all_columns_about(state, [best.candidate])
        return judged_at(state, [(best.candidate, columns)])[0]

    def starts(self, first: Candidate) -> list[Candidate]:
        """Shapes of one effect from which refining starts, the best first.

        With one shape to refine, the best for each value of the others, if it comes near; with
        more, the best few.
        """
        refined = [s.name for s in first.form.shapes if s.smooth and len(s.grid) > 1]
        if len(first.form.shapes) < 2 or not refined:
            return [first]
        every = [t for t in self.trials if t.candidate.key == first.key]
        own = [t for t in every if t.possible] or every
        falls = np.array([trial.fall for trial in own])
        least = NEAR * float(falls.max()) if len(refined) == 1 else -np.inf
        near = [own[k].candidate for k in np.argsort(-falls) if falls[k] >= least]
        order = [first, *(c for c in near if c is not first)]
        if len(refined) > 1:
            return order[:STARTS]
        best: dict[tuple[float, ...], Candidate] = {}
        for c in order:
            best.setdefault(tuple(v for n, v in c.shapes.items() if n != refined[0]), c)
        return list(best.values())


def scan_catalogue(
    state: State, without: Sequence[str] = (), only: str | None = None, joint: str | None = None
) -> HypothesisScan:
    """All candidates in a state, or those of one effect, or of one joint."""
    return scan_candidates(
        state, [c for c in generate_candidates(state, only, without) if joint in (None, c.joint)]
    )


def scan_candidates(state: State, found: Sequence[Candidate]) -> HypothesisScan:
    """Some candidates in a state; those that show."""
    trials, best = dict[int, Trial](), dict[int, Judged]()
    place = {id(candidate): k for k, candidate in enumerate(found)}
    for some in together(found, AT_ONCE):  # their columns are never there all at once
        every = zip(some, all_columns_about(state, some), strict=True)
        shown = {id(own[0]): own for own in every if visible(own[1])}
        own = tried(state, [*shown.values()]) if shown else []
        trials |= {place[id(t.candidate)]: t for t in own}
        judged = judged_at(state, [shown[id(t.candidate)] for t in leading(own)])
        best |= {id(j.candidate): j for j in judged}
    in_order = [trials[k] for k in sorted(trials)]
    first = [best[id(t.candidate)] for t in leading(in_order)]
    return HypothesisScan(state, in_order, sorted(first, key=lambda j: -j.fall))


def is_vetoed(candidate: Candidate, vetoed: Sequence[Judged]) -> bool:
    """True if it was vetoed; of ripples, all orders that differ by less than a tenth."""
    others = [judged.candidate for judged in vetoed]
    if not candidate.effect.several:
        return any(c.key == candidate.key for c in others if not c.effect.several)
    order = candidate.order
    orders = [c.order for c in others if c.effect.several]
    return any(abs(order - m) < 0.1 * m for m in orders)


MOST = 8
"""Effects named in one diagnosis."""

MUCH = 0.15
"""Gain from which on an effect whose values are not those of this robot is a description still."""

ASKED = 20
"""Effects that are refused in one diagnosis before it ends: where held-out motion refuses that
many, it is other motion, or the logs hold nothing that returns."""


Veto = Callable[[State, State, Judged], bool]
"""True if an effect does not lower the error on held-out logs: state without it, with it, the
effect as it was judged."""

CLEAR = 1.01
"""Ratio of two errors that decides."""


@dataclass(frozen=True, eq=False)
class Step(Brief):
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
class Search(Brief):
    """What a search found.

    Attributes:
        start: the model as given.
        steps: effects put in, in order; those that later ones made unnecessary are left out.
        end: the model with them.
        last: the judgement that ended it.
        vetoed: effects that would have raised the error on held-out logs, when they led.
        without: what the user ruled out.
        given: effects put in before, in another look; the start has them.
    """

    start: State
    steps: tuple[Step, ...]
    end: State
    last: Judgement
    vetoed: tuple[Judged, ...] = ()
    without: tuple[str, ...] = ()
    given: tuple[Step, ...] = ()

    @property
    def spec(self) -> ModuleSpec:
        """What the robot is made of."""
        return self.start.spec

    @property
    def catalogue(self) -> Sequence[Effect]:
        """The effects that may be missing."""
        return self.start.data.known.catalogue

    @property
    def ranked(self) -> tuple[Judged, ...]:
        """Rivals of the first effect that was put in, or all where none was; best first."""
        return self.steps[0].rivals if self.steps else self.last.ranked


def search(
    data: SearchData,
    beta: np.ndarray,
    without: Sequence[str] = (),
    most: int = MOST,
    veto: Veto | None = None,
    tick: Tick = lambda: None,
    given: Sequence[Step] = (),
) -> Search:
    """Effects that the model lacks, one by one.

    Args:
        data: training logs.
        beta: (c,) parameters of the model, where effects are linearised first.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most; with 0 nothing is judged.
        veto: looks at held-out logs.
        tick: called whenever something is done.
        given: effects that another look has put in.
    """
    start = state = about_itself(state_of(data, [step.pick for step in given], beta))
    steps, refused, every = list[Step](), list[Judged](), list[Judged]()
    if not most:
        return Search(start, (), state, Judgement((), None), (), tuple(without), tuple(given))
    survey = scan_catalogue(state, without)
    judgement = survey.judged((), tick)
    while judgement.best is not None and len(steps) < most and len(every) < ASKED:
        best = _named(state, judgement.best, refused, without)
        best, later = put_in(state, _beside_prior(state, best, judgement, refused), veto)
        other = _instead(survey, refused, best, later, tick)
        if other is not None or later is None:
            refused, every = [*refused, best], [*every, best]
            judgement = other or Judgement((), None)
            continue
        survey = scan_catalogue(later, without)
        doubted, refused = _doubted(refused, best), survey.still_refused(refused)
        after = survey.judged(refused, tick)
        rivals = tuple(j for j in judgement.ranked if j.key != best.key)
        equals = [o for o in alternatives(best, rivals, after) if _covers(state, o, best)]
        ties = (*equals, *doubted)
        steps.append(Step(best, rivals, state, ties))
        state, judgement = later, after
    kept, state = _settled(state, steps, start.picks, tick)
    looked = judgement, tuple(every), tuple(without), tuple(given)
    return Search(start, tuple(kept), state, *looked)


def _covers(state: State, other: Judged, best: Judged) -> bool:
    """True if with the other effect put in, little is left for the best one."""
    beside = state_of(state.data, [*state.picks, other.candidate], state.beta)
    return _judged_again(beside, best.candidate).fall < SAME * best.fall


def _doubted(refused: Sequence[Judged], best: Judged) -> list[Judged]:
    """What gave way to an effect that explains as much: for the data it is a tie."""
    return [
        judged for judged in refused
        if judged.why not in ("", DRIVES)
        and NEARLY * judged.share < best.share < judged.share / NEARLY
    ]  # fmt: skip


SHORT = 0.01
"""s: a delay of all torques below is linear in the band of a diagnosis, and has a name there."""


def put_in(state: State, best: Judged, veto: Veto | None) -> tuple[Judged, State | None]:
    """An effect that led, with what speaks against its values, and the state with it.

    The state is None where it is refused: `why` says why, if it is not by held-out motion.
    """
    later = extended(state, best.candidate)
    if drives(state, later, best.candidate):
        return dataclasses.replace(best, possible=False, why=DRIVES), None
    if veto is not None and veto(state, later, best):
        return best, None
    if is_gain(best.candidate):  # of all, the likeliest; a unit or a sign is told with it
        return best, later
    pick, values = later.picks[-1], later.values[-1]
    named = values_of(later, pick, values, np.zeros(len(values)))
    why = objection(later, pick, named.value | dict(pick.shapes))
    lags = Needs.LAG in pick.effect.needs
    short = lags and pick.joint is None and float(values[0]) * pick.shapes["tau"] < SHORT
    # A lag of no certain kind would take the place of what rounds torques too.
    if why and (short or why.endswith(EITHER) or Needs.TILT in pick.effect.needs):
        return dataclasses.replace(best, why=why), None
    return dataclasses.replace(best, why=why) if why else best, later


def _instead(
    survey: HypothesisScan,
    refused: Sequence[Judged],
    asked: Judged,
    later: State | None,
    tick: Tick,
) -> Judgement | None:
    """What leads without an effect that was refused, or is doubted, if another explains as much.

    Or if the doubted one explains little. None where the effect is put in.
    """
    if later is not None and not asked.why:
        return None
    without = survey.judged([*refused, asked], tick)
    if later is None or asked.gain < MUCH:
        return without
    best = without.best
    return without if best is not None and best.share > NEARLY * asked.share else None


def _beside_prior(
    state: State, best: Judged, judgement: Judgement, vetoed: Sequence[Judged]
) -> Judged:
    """The best effect; of equals on its joint, one that clearly leaves less once it is put in.

    While an effect is missing, its joint says little beside the prior, and bodies stay where that
    has them: an effect that stands in for their error looks as good as the true one, and the shapes
    of that do so too. They are sought again with the weights that the effect leaves.
    """
    first = judgement.best
    assert first is not None
    near = [j for j in judgement.ranked if j.significant and j.share > CLOSE * first.share]
    every = {j.key: j for j in (best, first, *near) if not is_vetoed(j.candidate, vetoed)}
    if state.data.prior is None or not best.candidate.local:
        return best
    found = {}
    for key, judged in every.items():
        if key[1] == best.key[1] and judged.candidate.local:
            later = extended(state, judged.candidate)
            scan = scan_catalogue(state.weighed_as(later), (), *key)
            if not scan.best:  # it shows with the weights of the state alone
                continue
            least = scan.best[0]
            again = scan.at_best(least, scan.starts(least.candidate)).candidate
            later = extended(state, again)
            error = float(np.linalg.norm(later.base.left_out[again.index]))
            found[key] = error * float(later.sigma[again.index]), again
    if not found:
        return best
    likely = first.key if first.key in found else best.key
    key = min(found, key=lambda key: found[key][0] * (1.0 if key == likely else CLEAR))
    return _judged_again(state, found[key][1])


def _named(state: State, best: Judged, vetoed: Sequence[Judged], without: Sequence[str]) -> Judged:
    """The best effect; of drive gains, the likeliest.

    Ranks weigh the joints by what a model bent by a wrong gain leaves.
    """
    if not is_gain(best.candidate):
        return best
    every = generate_candidates(state, best.candidate.effect.id, without)
    gains = [c for c in every if not is_vetoed(c, vetoed)]
    return _judged_again(state, likeliest(state, gains) or best.candidate)


def _judged_again(state: State, candidate: Candidate) -> Judged:
    (columns,) = all_columns_about(state, [candidate])
    return decide(state, judged_at(state, [(candidate, columns)])).ranked[0]


def extended(state: State, pick: Candidate) -> State:
    """The state with one effect more, linearised about its own parameters."""
    picks, about = (*state.picks, pick), settled_parameters(state, pick)
    once = state_of(state.data, picks, state.beta if about is None else about)
    return about_itself(once)


def about_itself(state: State) -> State:
    """The state linearised about its own parameters."""
    about = settled_parameters(state)
    return state_of(state.data, state.picks, state.beta if about is None else about)


def _settled(
    state: State, steps: Sequence[Step], given: Sequence[Candidate], tick: Tick
) -> tuple[list[Step], State]:
    """The effects that are needed, each at the shapes that are best beside all the others.

    A shape that was sought while others were missing leaves what one more effect describes: that is
    dropped if the others on its joint, at shapes sought again without it, leave it nothing.
    """
    kept, state = _backward(state, steps, given, tick)
    while (fewer := _with_one_less(state, given, kept, tick)) is not None:
        kept = fewer
    if len(kept) + len(given) > 1:
        kept = _reshaped(state, given, kept, [own for own in kept if _bends(own.pick)], tick)
    picks = [*given, *(step.pick for step in kept)]
    return kept, state if picks == list(state.picks) else state_of(state.data, picks, state.beta)


def _with_one_less(
    state: State, given: Sequence[Candidate], kept: Sequence[Step], tick: Tick
) -> list[Step] | None:
    """Without the weakest effect that others describe at other shapes; None if there is none."""
    for step in sorted(kept, key=lambda step: step.judged.gain):
        rest = [own for own in kept if own is not step]
        bent = [own for own in rest if own.pick.joint == step.pick.joint and _bends(own.pick)]
        if bent:
            rest = _reshaped(state, given, rest, bent, tick)
            beside = state_of(state.data, [*given, *(s.pick for s in rest)], state.beta)
            if not _judged_again(beside, refined(beside, step.pick)).significant:
                return rest
    return None


def _bends(pick: Candidate) -> bool:
    """True if its shapes may be others."""
    return any(pick.refinable(shape) for shape in pick.form.shapes)


def _reshaped(
    state: State, given: Sequence[Candidate], kept: Sequence[Step], bent: Sequence[Step], tick: Tick
) -> list[Step]:
    """The effects kept; some of them at their best shapes beside the others, in turn."""
    found = list(kept)
    for i, step in enumerate(kept):
        if step in bent:
            picks = [*given, *(own.pick for own in found)]
            whole = state_of(state.data, picks, state.beta)
            explained, pick = explained_by(whole, len(given) + i), step.pick
            for _ in range(_TURNS):  # each begins with steps as large as those of the grid
                pick, last = refined(whole, pick, explained), pick
                if pick == last:
                    break
            judged = _judged_again(_without(state, given, found, found[i]), pick)
            found[i] = dataclasses.replace(step, judged=judged)
            tick()
    return found


def _backward(
    state: State, steps: Sequence[Step], given: Sequence[Candidate], tick: Tick
) -> tuple[list[Step], State]:
    """Drops effects that the others made unnecessary, the weakest first; those given stay.

    What the others gain is judged again then, beside those that are left.
    """
    kept = list(steps)
    while kept and len(kept) + len(given) > 1:
        judged = []
        for step in kept:
            judged.append(_beside(state, given, kept, step))
            tick()
        weakest = int(np.argmin([j.gain for j in judged]))
        if judged[weakest].significant:
            break
        del kept[weakest]
        state = state_of(state.data, [*given, *(s.pick for s in kept)], state.beta)
    if len(kept) < len(steps):
        kept = [dataclasses.replace(s, judged=_beside(state, given, kept, s)) for s in kept]
    return kept, state


def _beside(state: State, given: Sequence[Candidate], kept: Sequence[Step], step: Step) -> Judged:
    """One of the effects, judged in the model with the others."""
    return _judged_again(_without(state, given, kept, step), step.pick)


def _without(state: State, given: Sequence[Candidate], kept: Sequence[Step], step: Step) -> State:
    """The state with all of the effects but one."""
    others = [*given, *(s.pick for s in kept if s is not step)]
    return state_of(state.data, others, state.beta)
