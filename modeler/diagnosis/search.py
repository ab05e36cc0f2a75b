"""The search: name the best effect, refine it, put it in, look again; drop what is not needed."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from modeler.core.json import ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.diagnosis import plausibility
from modeler.diagnosis.candidates import Candidate, encode_parameter
from modeler.diagnosis.elastic_joints import fit_elastic_joint
from modeler.diagnosis.generation import find_slowest_ringing, generate_candidates
from modeler.diagnosis.profile import (
    build_reduction_function,
    name_parameters,
    polish_nonlinear_parameters,
)
from modeler.diagnosis.scoring import (
    CandidateFit,
    RankedCandidates,
    ScoredCandidate,
    fit_candidates,
    score_candidates,
    select_alternatives,
    select_best,
    select_best_fits,
)
from modeler.diagnosis.state import SearchData, State, batch_candidates, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, NonlinearParameter, Requirement

_Reduction = Callable[[Candidate], float]


def refine_nonlinear_parameters(
    state: State, candidate: Candidate, compute_reduction: _Reduction | None = None
) -> Candidate:
    """Refines the nonlinear parameters by variable projection.

    Args:
        state: of the model.
        candidate: where to begin.
        compute_reduction: by shapes; None: by motion left out of the fit.
    """
    if candidate.elastic is not None:
        return candidate
    compute_reduction = compute_reduction or partial(_compute_reduction, state)
    smooth = [shape for shape in candidate.form.nonlinear_parameters if candidate.can_refine(shape)]
    if not smooth:
        return candidate
    scale = state.joint_scales[candidate.scale_index]
    start = candidate.encode_parameters(smooth)
    reach = np.array([_compute_search_range(state, candidate, shape) for shape in smooth])
    if smooth[0].scale == "waves":
        low, high = np.zeros(1), np.full(1, np.inf)
    else:
        limits = [[scale.scale_value(shape, x) for x in shape.limits] for shape in smooth]
        pairs = list(zip(smooth, limits, strict=True))
        low, high = (np.array([encode_parameter(s, x[k]) for s, x in pairs]) for k in (0, 1))
        if candidate.effect.is_oscillator:
            hertz, slowest = [s.scale == "hertz" for s in smooth], find_slowest_ringing(state)
            least = [encode_parameter(shape, slowest) for shape in smooth]
            low = np.maximum(low, np.where(hertz, least, -np.inf))

    def compute_loss(x: np.ndarray) -> float:
        return -compute_reduction(candidate.set_parameters(smooth, np.clip(x, low, high)))

    steps = THRESHOLDS.refinement_steps
    if len(smooth) == 1:
        ends = max(start[0] - reach[0], low[0]), min(start[0] + reach[0], high[0])
        how = {"method": "bounded", "options": {"maxiter": steps}, "bounds": ends}
        solution = minimize_scalar(lambda x: compute_loss(np.array([x])), **how)
        x, score = np.array([solution.x]), float(solution.fun)
        whole, share = np.round(x), THRESHOLDS.whole_order_share
        if smooth[0].scale == "waves" and compute_loss(whole) < share * score:
            return candidate.set_parameters(smooth, whole)
    else:
        corners = np.vstack([start, start + 0.5 * np.diag(reach)])
        options = {"maxfev": 4 * steps, "initial_simplex": corners}
        solution = minimize(compute_loss, start, method="Nelder-Mead", options=options)
        x, score = solution.x, float(solution.fun)
    better = score < compute_loss(start)
    return candidate.set_parameters(smooth, np.clip(x, low, high)) if better else candidate


def _compute_search_range(state: State, candidate: Candidate, shape: NonlinearParameter) -> float:
    """How far a value may lie from that of the grid: to the next; half a wave in the stroke."""
    if shape.scale == "angle":
        return 0.3
    if shape.scale == "waves":
        return float(np.pi / state.joint_scales[candidate.index].range)
    if len(shape.grid) == 1:
        return np.log(2.0)
    unit = state.joint_scales[candidate.index].get_unit(shape)
    gaps = np.diff([encode_parameter(shape, unit * value) for value in shape.grid])
    return float(gaps.max() if shape.scale == "own" else gaps[0])


def _compute_reduction(state: State, candidate: Candidate) -> float:
    """Fall of the squared residual, weighted, in held-out blocks; 0 of values that cannot be."""
    columns = state.rows.build_columns(candidate)
    if not is_visible(columns):
        return 0.0
    trial = fit_candidates(state, [(candidate, columns)])[0]
    return trial.total_reduction if trial.is_possible else 0.0


# Every hypothesis in a state: at the best of its shapes, the leading ones refined.

Scores = Sequence[ScoredCandidate]
Tick = Callable[[], None]
"""Called whenever something is done."""


@dataclass(frozen=True, eq=False)
class CandidateScan:
    """Every candidate in a state.

    Attributes:
        state: it.
        fits: candidates that show.
        best: every effect on every joint at the best of its shapes, none refined, best first.
        refined_scores: effects that were refined, by the shapes that this began with.
        rigid_joints: joints, and their resonance by the column for slow motion, whose fitted
            windup was none of an elastic joint in this search: they are not fitted again.
    """

    state: State
    fits: Sequence[CandidateFit]
    best: Sequence[ScoredCandidate]
    refined_scores: dict[tuple[Any, ...], ScoredCandidate] = field(default_factory=dict)
    rigid_joints: set[tuple[str | None, float]] = field(default_factory=set)

    def list_still_refused(self, refused: Sequence[ScoredCandidate]) -> list[ScoredCandidate]:
        """Lists vetoed effects that have not become far better since."""
        gains = {score.key: score.variance_reduction for score in self.best}
        most = THRESHOLDS.max_reconsidered_residual

        def is_refused(score: ScoredCandidate) -> bool:
            left = 1.0 - gains.get(score.key, 0.0)
            return score.refines_model_term or left > most * (1.0 - score.variance_reduction)

        return [score for score in refused if is_refused(score)]

    def exclude_vetoed(self, vetoed: Sequence[ScoredCandidate]) -> "CandidateScan":
        """Returns the scan without the candidates that were vetoed."""
        touched = {t.candidate.key for t in self.fits if is_vetoed(t.candidate, vetoed)}
        if not touched:
            return self
        left = [t for t in self.fits if not is_vetoed(t.candidate, vetoed)]
        again = [t.candidate for t in select_best_fits(left) if t.candidate.key in touched]
        scores = score_candidates(self.state, plausibility.pair_columns(self.state, again))
        best = [*(j for j in self.best if j.key not in touched), *scores]
        best.sort(key=lambda j: -j.total_reduction)
        return replace(self, fits=left, best=best)

    def judge_candidates(
        self, vetoed: Sequence[ScoredCandidate] = (), tick: Tick = lambda: None
    ) -> RankedCandidates:
        """Ranks all but what was vetoed; the leading ones are refined, with a tick after each."""
        left = self.exclude_vetoed(vetoed)
        leading = left.best[: THRESHOLDS.max_refined_alternatives]
        least = THRESHOLDS.min_refined_gain
        close = [j for j in leading if j.is_possible and j.is_near(leading[0])]
        close = [j for j in close if j.variance_reduction > least]
        close += [j for j in self._list_likely_windups(left.best) if j not in close]
        # Of effects that were not refined, only the best shapes may win still.
        refined = {}
        for item in close:
            starts = left.list_starts(item.candidate)
            key = tuple((*c.key, *c.nonlinear_parameters.items()) for c in starts)
            if key not in self.refined_scores:
                self.refined_scores[key] = left.refine_candidate(item, starts)
            refined[item.key] = self.refined_scores[key]
            tick()
        best = [refined.get(j.key, j) for j in left.best]
        # the column for slow motion says where to look, and is no effect
        best = [j for j in best if j.candidate.elastic or not j.candidate.effect.is_oscillator]
        return select_best(self.state, sorted(best, key=lambda j: -j.total_reduction))

    def _list_likely_windups(self, best: Sequence[ScoredCandidate]) -> list[ScoredCandidate]:
        """Lists joints that may be elastic by a column that is right for slow motion only.

        Beside another elastic joint that column says nothing.
        """
        state, share = self.state, THRESHOLDS.min_windup_share
        rings = [j for j in best if j.candidate.effect.is_oscillator and j.is_possible]
        if not rings:
            return []
        others = any(pick.elastic is not None for pick in state.picks) or state.spec.windups
        rings = rings[: THRESHOLDS.max_fitted_windups]
        rings = [j for j in rings if _key_resonance(j.candidate) not in self.rigid_joints]
        if others:
            return rings
        likely = [j for j in rings if j.total_share > share * best[0].total_share]
        return [j for j in likely if j.variance_reduction > THRESHOLDS.min_refined_gain]

    def refine_candidate(
        self, score: ScoredCandidate, starts: Sequence[Candidate]
    ) -> ScoredCandidate:
        """Refines the best parameters of an effect, or takes the next best."""
        state, first = self.state, score.candidate
        if first.effect.is_oscillator:
            return self._fit_elastic_joint(score)
        better = [refine_nonlinear_parameters(state, start) for start in starts]
        if better == [first]:
            return score
        others = [t for t in self.fits if t.candidate.key == first.key]
        pairs = [(candidate, state.rows.build_columns(candidate)) for candidate in better]
        shown = [pair for pair in pairs if is_visible(pair[1])]
        (best,) = select_best_fits([*fit_candidates(state, shown), *others])
        pair = next((pair for pair in shown if pair[0] is best.candidate), None)
        if pair is None:
            (pair,) = plausibility.pair_columns(state, [best.candidate])
        return score_candidates(state, [pair])[0]

    def _fit_elastic_joint(self, score: ScoredCandidate) -> ScoredCandidate:
        """The joint with its windup; as it was where that cannot be fitted."""
        candidate = fit_elastic_joint(self.state, score.candidate)
        if candidate is None:
            return score
        if candidate.elastic is not None and not candidate.elastic.is_plausible:
            self.rigid_joints.add(_key_resonance(score.candidate))
        columns = self.state.rows.build_columns(candidate)
        pairs = [(candidate, columns)]
        return score_candidates(self.state, pairs)[0] if is_visible(columns) else score

    def list_starts(self, first: Candidate) -> list[Candidate]:
        """Lists the parameters of one effect from which refining starts, the best first.

        With one shape to refine, the best for each value of the others, if it comes near; with
        more, the best few.
        """
        shapes = first.form.nonlinear_parameters
        refined = [s.name for s in shapes if s.is_continuous and len(s.grid) > 1]
        if len(shapes) < 2 or not refined:
            return [first]
        every = [t for t in self.fits if t.candidate.key == first.key]
        possible_fits = [t for t in every if t.is_possible] or every
        falls = np.array([trial.total_reduction for trial in possible_fits])
        least = THRESHOLDS.start_share * float(falls.max()) if len(refined) == 1 else -np.inf
        near = [possible_fits[k].candidate for k in np.argsort(-falls) if falls[k] >= least]
        order = [first, *(c for c in near if c is not first)]
        if len(refined) > 1:
            return order[: THRESHOLDS.max_starts]
        best: dict[tuple[float, ...], Candidate] = {}
        for c in order:
            others = (v for n, v in c.nonlinear_parameters.items() if n != refined[0])
            best.setdefault(tuple(others), c)
        return list(best.values())


def _key_resonance(candidate: Candidate) -> tuple[str | None, float]:
    return candidate.joint, candidate.nonlinear_parameters.get("f", 0.0)


def scan_catalogue(
    state: State, without: Sequence[str] = (), only: str | None = None, joint: str | None = None
) -> CandidateScan:
    """Scans all candidates in a state, or those of one effect, or of one joint."""
    every = generate_candidates(state, only, without)
    return scan_candidates(state, [c for c in every if joint in (None, c.joint)])


def scan_candidates(state: State, candidates: Sequence[Candidate]) -> CandidateScan:
    """Scans some candidates in a state."""
    trials, best = dict[int, CandidateFit](), dict[int, ScoredCandidate]()
    place = {id(candidate): k for k, candidate in enumerate(candidates)}
    for some in batch_candidates(candidates, THRESHOLDS.scan_chunk):  # memory
        pairs = plausibility.pair_columns(state, some)
        shown = {id(pair[0]): pair for pair in pairs if is_visible(pair[1])}
        fits = fit_candidates(state, [*shown.values()]) if shown else []
        trials |= {place[id(t.candidate)]: t for t in fits}
        leading = [shown[id(t.candidate)] for t in select_best_fits(fits)]
        best |= {id(j.candidate): j for j in score_candidates(state, leading)}
    in_order = [trials[k] for k in sorted(trials)]
    first = [best[id(t.candidate)] for t in select_best_fits(in_order)]
    return CandidateScan(state, in_order, sorted(first, key=lambda j: -j.total_reduction))


def is_vetoed(candidate: Candidate, vetoed: Sequence[ScoredCandidate]) -> bool:
    """Returns whether it was vetoed; of ripples, all orders within a tenth."""
    others = [score.candidate for score in vetoed]
    if not candidate.effect.is_repeatable:
        return any(c.key == candidate.key for c in others if not c.effect.is_repeatable)
    order = candidate.wave_order
    orders = [c.wave_order for c in others if c.effect.is_repeatable]
    return any(abs(order - m) < 0.1 * m for m in orders)


Veto = Callable[[State, State, ScoredCandidate], bool]
"""True if an effect does not lower the error on held-out logs: state without it, with it, the
effect as it was judged."""


@dataclass(frozen=True, eq=False)
class SearchStep(ShortRepr):
    """One effect that was put in.

    Attributes:
        score: the effect, and its numbers when it was chosen.
        alternatives: the others then, best first.
        before: the state it was chosen in.
        equivalents: alternatives that the data do not distinguish from it.
    """

    score: ScoredCandidate
    alternatives: tuple[ScoredCandidate, ...]
    before: State
    equivalents: tuple[ScoredCandidate, ...] = ()

    @property
    def candidate(self) -> Candidate:
        """Returns the effect on its joint, with its parameters."""
        return self.score.candidate


@dataclass(frozen=True, eq=False)
class Search(ShortRepr):
    """What a search found.

    Attributes:
        start: the model as given.
        steps: effects put in, in order; those that later ones made unnecessary are left out.
        end: the model with them.
        last: the judgement that ended it.
        vetoed_candidates: effects that would have raised the error on held-out logs, when they led.
        without: what the user ruled out.
        prior_steps: effects put in before, in another look; the start has them.
    """

    start: State
    steps: tuple[SearchStep, ...]
    end: State
    last: RankedCandidates
    vetoed_candidates: tuple[ScoredCandidate, ...] = ()
    without: tuple[str, ...] = ()
    prior_steps: tuple[SearchStep, ...] = ()

    @property
    def spec(self) -> ModuleSpec:
        """Returns the manifest of the robot."""
        return self.start.spec

    @property
    def catalogue(self) -> Sequence[Effect]:
        """Returns the effects that may be missing."""
        return self.start.data.stated_effects.catalogue

    @property
    def ranked(self) -> tuple[ScoredCandidate, ...]:
        """Returns alternatives of the first effect, or all where none was put in; best first."""
        return self.steps[0].alternatives if self.steps else self.last.ranked


def search_effects(
    data: SearchData,
    beta: np.ndarray,
    without: Sequence[str] = (),
    most: int = THRESHOLDS.max_effects,
    veto: Veto | None = None,
    tick: Tick = lambda: None,
    prior_steps: Sequence[SearchStep] = (),
) -> Search:
    """Searches the effects that the model lacks, one by one.

    Args:
        data: training logs.
        beta: (c,) parameters of the model, where effects are linearised first.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most; with 0 nothing is judged.
        veto: looks at held-out logs.
        tick: called whenever something is done.
        prior_steps: effects that another look has put in.
    """
    picks, nothing = [step.candidate for step in prior_steps], RankedCandidates((), None)
    start = state = linearise_state(build_state(data, picks, beta))
    steps, refused, every = list[SearchStep](), list[ScoredCandidate](), list[ScoredCandidate]()
    if not most:
        return Search(start, (), state, nothing, (), tuple(without), tuple(prior_steps))
    survey = scan_catalogue(state, without)
    judgement = survey.judge_candidates((), tick)
    limit = THRESHOLDS.max_rejections
    while judgement.best is not None and len(steps) < most and len(every) < limit:
        best = _choose_likeliest_gain(state, judgement.best, refused, without)
        best = _choose_beside_prior(state, best, judgement, refused)
        best, later = accept_candidate(state, best, veto)
        other = _choose_alternative(survey, refused, best, later, tick)
        if other is not None or later is None:
            refused, every = [*refused, best], [*every, best]
            judgement = other or nothing
            continue
        survey = replace(scan_catalogue(later, without), rigid_joints=survey.rigid_joints)
        doubted = _find_displaced_candidates(refused, best)
        refused = survey.list_still_refused(refused)
        after = survey.judge_candidates(refused, tick)
        rivals = tuple(j for j in judgement.ranked if j.key != best.key)
        equals = select_alternatives(best, rivals, after)
        ties = (*(other for other in equals if _is_covered(state, other, best)), *doubted)
        steps.append(SearchStep(best, rivals, state, ties))
        state, judgement = later, after
    needed_steps, state = _prune_steps(state, steps, start.picks, tick)
    looked = judgement, tuple(every), tuple(without), tuple(prior_steps)
    return Search(start, tuple(needed_steps), state, *looked)


def _is_covered(state: State, other: ScoredCandidate, best: ScoredCandidate) -> bool:
    """True if with the other effect put in, little is left for the best one."""
    beside = build_state(state.data, [*state.picks, other.candidate], state.beta)
    left = _score_candidate(beside, best.candidate).total_reduction
    return left < THRESHOLDS.equivalence_share * best.total_reduction


def _find_displaced_candidates(refused: Scores, best: ScoredCandidate) -> list[ScoredCandidate]:
    """What gave way to an effect that explains as much: for the data it is a tie."""
    least, share = THRESHOLDS.parsimony_share, best.total_share
    doubted = [score for score in refused if score.reason not in ("", plausibility.DRIVES)]
    return [s for s in doubted if least * s.total_share < share < s.total_share / least]


def accept_candidate(
    state: State, best: ScoredCandidate, veto: Veto | None
) -> tuple[ScoredCandidate, State | None]:
    """Returns a leading effect with its caveat, and the state with it.

    The state is None where it is refused: `why` says why, if it is not by held-out motion.
    """
    later = extend_state(state, best.candidate)
    if plausibility.is_friction_driving(state, later, best.candidate):
        return replace(best, is_possible=False, reason=plausibility.DRIVES), None
    if veto is not None and veto(state, later, best):
        return best, None
    if plausibility.is_gain(best.candidate):  # a unit or a sign is reported with it
        return best, later
    pick, values = later.picks[-1], later.values[-1]
    why = plausibility.find_caveat(later, pick, name_parameters(later, pick, values))
    tau = pick.nonlinear_parameters.get("tau", np.inf)
    short = Requirement.LAG in pick.effect.needs and pick.joint is None
    short = short and float(values[0]) * tau < THRESHOLDS.max_short_delay
    # A lag of no certain kind would take the place of what rounds torques too.
    unsure = short or why.endswith(plausibility.EITHER)
    refused = why and (unsure or Requirement.TILT in pick.effect.needs)
    return replace(best, reason=why) if why else best, None if refused else later


def _choose_alternative(
    survey: CandidateScan, refused: Scores, score: ScoredCandidate, later: State | None, tick: Tick
) -> RankedCandidates | None:
    """What leads without an effect that was refused, or is doubted, if another explains as much.

    Or if the doubted one explains little. None where the effect is put in.
    """
    if later is not None and not score.reason:
        return None
    without = survey.judge_candidates([*refused, score], tick)
    if later is None or score.variance_reduction < THRESHOLDS.min_description_gain:
        return without
    best = without.best
    least = THRESHOLDS.parsimony_share * score.total_share
    return without if best is not None and best.total_share > least else None


def _choose_beside_prior(
    state: State, best: ScoredCandidate, judgement: RankedCandidates, vetoed: Scores
) -> ScoredCandidate:
    """The best effect; of equals on its joint, one that clearly leaves less once it is put in.

    While an effect is missing, its joint says little beside the prior, and bodies stay where that
    has them: an effect that stands in for their error looks as good as the true one, and the shapes
    of that do so too. They are sought again with the weights that the effect leaves.
    """
    first = judgement.best
    assert first is not None
    near = [j for j in judgement.ranked if j.is_significant and j.is_near(first)]
    every = {j.key: j for j in (best, first, *near) if not is_vetoed(j.candidate, vetoed)}
    if state.data.prior is None or not best.candidate.is_local:
        return best
    errors = {}
    for key, item in every.items():
        if key[1] == best.key[1] and item.candidate.is_local:
            later = extend_state(state, item.candidate)
            scan = scan_catalogue(state.replace_weights(later), (), *key)
            if not scan.best:  # it shows with the weights of the state alone
                continue
            least = scan.best[0]
            again = scan.refine_candidate(least, scan.list_starts(least.candidate)).candidate
            later = extend_state(state, again)
            error = float(np.linalg.norm(later.gram_blocks.out_of_fold[again.index]))
            errors[key] = error * float(later.sigma[again.index]), again
    if not errors:
        return best
    likely = first.key if first.key in errors else best.key
    ratio = THRESHOLDS.min_clear_ratio
    ends = [(e * (1.0 if key == likely else ratio), c) for key, (e, c) in errors.items()]
    return _score_candidate(state, min(ends, key=lambda pair: pair[0])[1])


def _choose_likeliest_gain(
    state: State, best: ScoredCandidate, vetoed: Sequence[ScoredCandidate], without: Sequence[str]
) -> ScoredCandidate:
    """The best effect; of drive gains, the likeliest.

    Ranks weigh the joints by what a model bent by a wrong gain leaves.
    """
    if not plausibility.is_gain(best.candidate):
        return best
    every = generate_candidates(state, best.candidate.effect.id, without)
    gains = [c for c in every if not is_vetoed(c, vetoed)]
    return _score_candidate(state, plausibility.select_likeliest(state, gains) or best.candidate)


def _score_candidate(state: State, candidate: Candidate) -> ScoredCandidate:
    pairs = plausibility.pair_columns(state, [candidate])
    return select_best(state, score_candidates(state, pairs)).ranked[0]


def extend_state(state: State, pick: Candidate) -> State:
    """Extends the state by one effect, linearised about its own parameters."""
    picks, about = (*state.picks, pick), plausibility.solve_parameters(state, pick)
    once = build_state(state.data, picks, state.beta if about is None else about)
    return linearise_state(once)


def linearise_state(state: State) -> State:
    """Linearises the state about its own parameters."""
    about = plausibility.solve_parameters(state)
    return build_state(state.data, state.picks, state.beta if about is None else about)


class _Pruning:
    """Drops and refines steps of a search beside picks that stay."""

    def __init__(self, state: State, prior_picks: Sequence[Candidate], tick: Tick) -> None:
        self.state, self.prior_picks, self.tick = state, prior_picks, tick

    def build_state(self, steps: Iterable[SearchStep]) -> State:
        """Builds the state with these steps."""
        picks = [*self.prior_picks, *(step.candidate for step in steps)]
        return build_state(self.state.data, picks, self.state.beta)

    def score_step(
        self, steps: Sequence[SearchStep], step: SearchStep, candidate: Candidate | None = None
    ) -> ScoredCandidate:
        """Scores one of the steps, or another candidate in its place, beside the others."""
        others = self.build_state(item for item in steps if item is not step)
        return _score_candidate(others, candidate or step.candidate)

    def drop_unneeded(self, steps: Sequence[SearchStep]) -> list[SearchStep]:
        """Drops steps that the others made unnecessary, the weakest first, and scores the rest."""
        needed = list(steps)
        while needed and len(needed) + len(self.prior_picks) > 1:
            scores = []
            for step in needed:
                scores.append(self.score_step(needed, step))
                self.tick()
            weakest = int(np.argmin([score.variance_reduction for score in scores]))
            if scores[weakest].is_significant:
                break
            del needed[weakest]
            self.state = self.build_state(needed)
        if len(needed) < len(steps):
            needed = [replace(s, score=self.score_step(needed, s)) for s in needed]
        return needed

    def drop_weakest(self, steps: Sequence[SearchStep]) -> list[SearchStep] | None:
        """Drops the weakest step that others describe at other parameters; None without any."""
        for step in sorted(steps, key=lambda step: step.score.variance_reduction):
            rest = [item for item in steps if item is not step]
            refined = [s for s in rest if s.candidate.joint == step.candidate.joint and _is_free(s)]
            if refined:
                rest = self.refine(rest, refined)
                beside = self.build_state(rest)
                candidate = refine_nonlinear_parameters(beside, step.candidate)
                if not _score_candidate(beside, candidate).is_significant:
                    return rest
        return None

    def refine(self, steps: Sequence[SearchStep], which: Sequence[SearchStep]) -> list[SearchStep]:
        """Refines the parameters of some steps beside the others, in turn."""
        refined = list(steps)
        for i, step in enumerate(steps):
            if step not in which:
                continue
            whole, candidate = self.build_state(refined), step.candidate
            place = len(self.prior_picks) + i
            if candidate.loop:
                candidate = polish_nonlinear_parameters(whole, place)
            reduction = build_reduction_function(whole, place)
            for _ in range(THRESHOLDS.refinement_turns):  # each begins with large steps again
                last = candidate
                candidate = refine_nonlinear_parameters(whole, candidate, reduction)
                if candidate == last:
                    break
            score = self.score_step(refined, refined[i], candidate)
            refined[i] = replace(step, score=score)
            self.tick()
        return refined


def _is_free(step: SearchStep) -> bool:
    if step.candidate.elastic is not None:
        return False
    return any(step.candidate.can_refine(s) for s in step.candidate.form.nonlinear_parameters)


def _prune_steps(
    state: State, steps: Sequence[SearchStep], prior_picks: Sequence[Candidate], tick: Tick
) -> tuple[list[SearchStep], State]:
    """The effects that are needed, each at the parameters that are best beside all the others.

    Parameters that were sought while others were missing leave what one more effect describes: that
    is dropped if the others on its joint, refined again without it, leave it nothing.
    """
    pruning = _Pruning(state, prior_picks, tick)
    needed = pruning.drop_unneeded(steps)
    while (fewer := pruning.drop_weakest(needed)) is not None:
        needed = fewer
    several = len(needed) + len(prior_picks) > 1
    which = [s for s in needed if (several and _is_free(s)) or s.candidate.loop]
    needed = pruning.refine(needed, which)
    picks = [*prior_picks, *(step.candidate for step in needed)]
    unchanged = picks == list(pruning.state.picks)
    return needed, pruning.state if unchanged else pruning.build_state(needed)
