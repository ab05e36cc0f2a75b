"""Equations for what has no name: search, scores, proposals."""

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares

from modeler.core.brief import ShortRepr
from modeler.core.table import format_percent
from modeler.core.toml_cells import TomlCell, format_toml
from modeler.diagnosis import scoring
from modeler.diagnosis.candidates import Candidate, expand_grid, to_dense
from modeler.diagnosis.expressions import (
    Formula,
    Term,
    count_symbols,
    derive_parameter_unit,
    list_factors,
)
from modeler.diagnosis.generation import compute_joint_order_spectrum, fit_residual_baseline
from modeler.diagnosis.learn import choose_free_name, learn_law, make_effect_id
from modeler.diagnosis.profile import estimate_effect
from modeler.diagnosis.result import EquationProposal, Finding, FittedCandidate, JointDiscovery
from modeler.diagnosis.search import Search, SearchStep, extend_state
from modeler.diagnosis.state import (
    SearchData,
    State,
    build_all_columns,
    build_columns,
    build_state,
    is_visible,
)
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget, read_definition
from modeler.estimation import estimate_correlation
from modeler.numerics.spectra import compute_order_spectrum as spectrum_of
from modeler.runtime import map_parts

_PLAIN = ("sign(v)", "v", "abs(v)", "v*abs(v)", "load", "abs(load)")
_LOW = (0.5, 1.0, 1.5, 2.0, 2.5)  # waves in the stroke that no spectrum shows


@dataclass(frozen=True, eq=False)
class ScoredFormula(ShortRepr):
    """A formula on its joint.

    Attributes:
        formula: terms and nonlinear parameters.
        candidate: the same as an effect.
        left: squared residual of the joint on motion that was held out, (N m)^2 or N^2.
        cost: nats, beside that of the model without it.
    """

    formula: Formula
    candidate: Candidate
    left: float
    cost: float


@dataclass(frozen=True, eq=False)
class _ProductColumn:
    """A product at the rows of the joint: values (rows_j, k), scaled."""

    term: Term
    values: np.ndarray

    @cached_property
    def formula(self) -> Formula:
        return Formula((self.term,))

    @cached_property
    def symbols(self) -> int:
        return self.formula.symbol_count

    def __mul__(self, other: "_ProductColumn | None") -> "_ProductColumn":
        """With a factor that is no wave, if any."""
        if other is None:
            return self
        return _ProductColumn((*self.term, *other.term), self.values * other.values)


_Priced = tuple[float, _ProductColumn, _ProductColumn | None]
"""Nats, a column, and the factor that it is multiplied by."""


def _by_cost(formulas: Iterable[ScoredFormula]) -> list[ScoredFormula]:
    return sorted(formulas, key=lambda item: item.cost)


def _by_price(*ranked: Iterable[_Priced]) -> list[_Priced]:
    return sorted(itertools.chain(*ranked), key=lambda item: item[0])


class JointSearch:
    """The search on one joint beside a model.

    Args:
        state: the model.
        j: index of the joint.
        tick: called whenever something is done.
    """

    def __init__(self, state: State, j: int, tick: Callable[[], None] = lambda: None) -> None:
        self.state, self.j, self._tick = state, j, tick
        self.joint = state.spec.joints[j]
        self.before = float(state.sigma[j] ** 2 * np.sum(state.fold_grams.out_of_fold[j] ** 2))
        noise = np.random.default_rng(0).normal(size=len(state.y[j]))
        self.count = self._count_rows(noise)  # what is missing is autocorrelated, noise is not

    @property
    def base(self) -> np.ndarray:
        """Returns the orthonormal base columns of the joint, weighted, (rows_j, r)."""
        return self.state.gram_blocks.whitened_columns[self.j]

    def _count_rows(self, left: np.ndarray) -> float:
        """Independent rows of the joint, by what is left of it (rows_j,)."""
        observation = self.state.data.observation
        rows = np.flatnonzero(observation.used[:, self.j])
        r = estimate_correlation(observation, left, rows)
        return len(rows) / max(1.0, 2.0 * float(r.sum()) - 1.0)

    def compute_cost(self, left: np.ndarray | float, symbols: np.ndarray | int) -> np.ndarray:
        """Computes the nats of a squared residual and of so many symbols."""
        share = np.maximum(np.asarray(left) / self.before, 1e-12)
        price = THRESHOLDS.nats_per_symbol * np.asarray(symbols)
        return np.asarray(0.5 * self.count * np.log(share) + price)

    # Factors at the rows of the joint, and products of them.

    @cached_property
    def factor_columns(self) -> list[_ProductColumn]:
        """Evaluates every factor at the first values of its parameters."""
        state, columns = self.state, list[_ProductColumn]()
        warm = self.joint.name in state.reference.temperature
        stroke = 2.0 * np.pi / state.joint_scales[self.j].range
        waves = [*(stroke * x for x in _LOW), *self.find_orders()]
        for factors in list_factors(state.spec, state.joint_scales, self.j, warm, waves):
            first = Formula(((factors[0],),)).build_candidate(state.joint_names, self.j)
            values = [dict(part.nonlinear_parameters) for part in factors]
            every = [replace(first, nonlinear_parameters=value) for value in values]
            for part, made in zip(factors, build_all_columns(state.rows, every), strict=True):
                if is_visible(made):
                    column = to_dense(made, self.j, len(state.y[self.j]))
                    size = np.sqrt(np.mean(column**2, axis=0))
                    size = np.where(size > 0.0, size, 1.0)
                    columns.append(_ProductColumn((part,), column / size))
            self._tick()
        return columns

    @cached_property
    def wave_free_columns(self) -> list[_ProductColumn]:
        """Returns the factors that are no waves."""
        return [column for column in self.factor_columns if column.values.shape[1] == 1]

    def find_orders(self) -> list[float]:
        """Finds waves that stand out in the residual, also in its products with motion and load."""
        state, j = self.state, self.j
        first = compute_joint_order_spectrum(state, j)
        orders = list(first.peaks) if first is not None else []
        motion = [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]]) for s in state.rows.signals]
        q, v, load = state.rows.filter_samples(j, motion).T
        cutoff = state.data.observation.report.processing.parallel_cutoff or 1e9
        reached = 2.0 * np.pi * cutoff / max(float(np.quantile(np.abs(v), 0.1)), 1e-9)
        for factor in (np.sign(v), v, load, np.abs(load)):
            r = state.residual[j] * factor
            spectrum = spectrum_of(q, r - r.mean(), self.joint.unit, reached)
            orders += spectrum.peaks if spectrum is not None else ()
        once: list[float] = []
        for order in orders:
            if all(abs(order - other) > 1.0 / state.joint_scales[j].range for other in once):
                once.append(order)
        return once

    @cached_property
    def plain_factors(self) -> dict[str, _ProductColumn]:
        """Returns the plain factors, by their text."""
        parameter_free = (c for c in self.wave_free_columns if not c.term[0].nonlinear_parameters)
        columns = {c.term[0].equations[0]: c for c in parameter_free}
        return {text: columns[text] for text in _PLAIN if text in columns}

    def rank_products(
        self, left: Sequence[_ProductColumn], keep: int, state: State | None = None
    ) -> list[_Priced]:
        """Ranks the cheapest products of a column and a wave-free factor.

        Args:
            left: columns; of those among the factors, only with later factors.
            keep: how many.
            state: what they stand beside; None: the model.
        """
        right = self.wave_free_columns
        state, place = state or self.state, {id(c): k for k, c in enumerate(right)}
        values = np.stack([c.values[:, 0] for c in right])
        symbols = np.array([c.symbols for c in right])
        texts = np.array([c.term[0].equations[0] for c in right])

        def rank_column(column: _ProductColumn) -> list[_Priced]:
            first = place.get(id(column), -1) + 1
            fit = ~np.isin(texts[first:], [part.equations[0] for part in column.term])
            factors = first + np.flatnonzero(fit)
            made = column.values.T[None] * values[factors][:, None]
            count = column.symbols + len(column.values.T) * (symbols[factors] - 1)
            costs = self.estimate_costs(state, made, count)
            return [(float(costs[k]), column, right[factors[k]]) for k in np.argsort(costs)[:keep]]

        ranked, chunk = list[_Priced](), THRESHOLDS.product_chunk
        for some in (left[k : k + chunk] for k in range(0, len(left), chunk)):
            ranked = _by_price(ranked, *map_parts(rank_column, some))[:keep]
            self._tick()
        return ranked

    def estimate_costs(self, state: State, made: np.ndarray, symbols: np.ndarray) -> np.ndarray:
        """Estimates the nats (K,) of columns (K, k, rows_j) by what they explain of all rows."""
        whole = float(np.sum(state.residual[self.j] ** 2))
        fall = float(state.sigma[self.j] ** 2) * self.compute_falls(state, made)
        return self.compute_cost(whole - np.clip(fall, 0.0, whole), symbols)

    def compute_falls(self, state: State, made: np.ndarray) -> np.ndarray:
        """Computes the fall (K,) of the weighted squared residual by columns (K, k, rows_j)."""
        e = state.residual[self.j] / state.sigma[self.j]
        T = made @ state.gram_blocks.whitened_columns[self.j]
        gram = made @ made.swapaxes(1, 2) - T @ T.swapaxes(1, 2)
        length = np.einsum("kii->ki", gram) + 1e-6 * np.einsum("kin,kin->ki", made, made) + 1e-30
        side = (made @ e) / np.sqrt(length)
        gram /= np.sqrt(length[:, :, None] * length[:, None])
        gram += 1e-6 * np.eye(gram.shape[1])
        fall = np.einsum("ki,ki->k", side, np.linalg.solve(gram, side[..., None])[..., 0])
        return np.nan_to_num(fall)

    def rank_columns(
        self, columns: Sequence[_ProductColumn], state: State | None = None
    ) -> list[_Priced]:
        """Ranks columns as they are, the cheapest first."""
        ranked, chunk = list[_Priced](), THRESHOLDS.column_chunk
        for k, width in itertools.product(range(0, len(columns), chunk), (1, 2)):
            some = [c for c in columns[k : k + chunk] if len(c.values.T) == width]
            if some:
                made = np.stack([c.values.T for c in some])
                symbols = np.array([c.symbols for c in some])
                costs = self.estimate_costs(state or self.state, made, symbols)
                ranked += [(float(cost), c, None) for cost, c in zip(costs, some, strict=True)]
        return _by_price(ranked)

    def select_distinct(
        self, ranked: Sequence[_Priced], keep: int, alike: float = THRESHOLDS.max_column_correlation
    ) -> list[_ProductColumn]:
        """Selects the cheapest columns that are not alike."""
        base, selected = self.base, list[tuple[np.ndarray, _ProductColumn]]()
        for _, left, right in ranked:
            column = left * right
            c = column.values
            basis = np.vstack([c, 1j * (base.T @ c)])  # products are those of columns off the model
            basis = basis @ _compute_whitening((basis.T @ basis).real)
            shared = (
                float(np.linalg.norm((basis.T @ x).real) ** 2 / min(len(basis.T), len(x.T)))
                for x, _ in selected
            )
            if basis.size and all(share < alike**2 for share in shared):
                selected.append((basis, column))
            if len(selected) == keep:
                break
        return [column for _, column in selected]

    # Formulas, as effects.

    def score_formulas(self, formulas: Iterable[Formula]) -> list[ScoredFormula]:
        """Scores formulas by the columns that they have as effects, the cheapest first."""
        possible = [f for f in formulas if f.is_definable]
        made = [f.build_candidate(self.state.joint_names, self.j) for f in possible]
        pairs = [(c, self.state.rows.build_columns(c)) for c in made]
        shown = [k for k, (_, columns) in enumerate(pairs) if is_visible(columns)]
        if not shown:
            return []
        unit, scores = float(self.state.sigma[self.j] ** 2), []
        trials = scoring.fit_candidates(self.state, [pairs[k] for k in shown])
        for k, trial in zip(shown, trials, strict=True):
            left = self.before - unit * trial.total_reduction
            cost = float(self.compute_cost(left, possible[k].symbol_count))
            scores.append(ScoredFormula(possible[k], made[k], left, cost))
        return _by_cost(scores)

    def score_columns(self, columns: Iterable[_ProductColumn]) -> list[ScoredFormula]:
        """Scores columns as formulas of one term."""
        return self.score_formulas(column.formula for column in columns)

    def refine_formula(self, item: ScoredFormula) -> ScoredFormula:
        """Refines a formula's parameters on all rows by variable projection (Kaufman 1975)."""
        formula, start = item.formula, np.array([*item.formula.nonlinear_parameters.values()])
        if not start.size:
            return item
        steps = [size for part, _ in formula.named_factors for size in part.compute_step_sizes()]
        base, e, sizes = self.base, self.state.residual[self.j], np.array(steps)

        def apply_values(x: np.ndarray) -> Formula:
            values = zip(formula.nonlinear_parameters, start + sizes * x, strict=True)
            return formula.set_parameters(dict(values))

        def compute_residual(x: np.ndarray) -> np.ndarray:
            values = apply_values(x).nonlinear_parameters
            candidate = replace(item.candidate, nonlinear_parameters=values)
            columns = self.state.rows.build_columns(candidate)
            if not is_visible(columns):
                return e
            c = to_dense(columns, self.j, len(e))
            off = c - base @ (base.T @ c)
            return np.asarray(e - off @ np.linalg.lstsq(off, e, rcond=1e-9)[0])

        most = THRESHOLDS.max_formula_evaluations
        x = least_squares(compute_residual, 0.0 * start, diff_step=1e-3, max_nfev=most).x
        self._tick()
        again = self.score_formulas([apply_values(x)])
        return again[0] if again and again[0].cost < item.cost else item

    def has_significant_product(self) -> bool:
        """Tells whether a product is significant: laws resolve no waves and no memory."""
        columns, most = self.factor_columns, THRESHOLDS.max_exact_columns
        ranked = _by_price(self.rank_columns(columns), self.rank_products(columns, most))
        few = self.score_columns(self.select_distinct(ranked, THRESHOLDS.max_hint_products))
        return any(self.judge_candidate(item.candidate) is not None for item in few)

    def judge_candidate(self, candidate: Candidate) -> scoring.ScoredCandidate | None:
        """Scores a candidate as an effect of the catalogue; None if it is not significant."""
        pair = candidate, build_columns(self.state.rows, candidate)
        return scoring.select_best(self.state, scoring.score_candidates(self.state, [pair])).best

    def find_formulas(self) -> list[ScoredFormula]:
        """Finds formulas that gain more than they cost, the cheapest first; no two are alike."""
        limits, columns = THRESHOLDS, self.factor_columns
        doubles = self.rank_products(columns, limits.max_second_products)
        beam = self.select_distinct(doubles, limits.beam_width)
        triples = self.rank_products(beam, limits.max_second_products)
        ranked = _by_price(self.rank_columns(columns), doubles, triples)
        alike = limits.max_start_correlation
        leading = self.score_columns(self.select_distinct(ranked, limits.max_exact_columns, alike))
        single = self.refine_best(leading, limits.max_refined_formulas)
        # what explains little alone may do so beside the first
        plain = self.plain_factors.values()
        further = [(0.0, c, p) for c in columns for p in (None, *plain) if p is not c]
        products = [*ranked[: limits.max_second_products], *further]
        seconds = [left * right for _, left, right in products]
        firsts = single[: limits.max_first_terms]
        pairs = [pair for first in firsts for pair in self.search_sums(first, seconds)]
        double = self.refine_best(pairs, limits.max_refined_formulas)
        for term in double[0].formula.terms if double else ():  # each again beside the other
            (first,) = self.score_formulas([Formula((term,))])[:1]
            double += self.refine_best(self.search_sums(first, seconds), limits.max_varied_formulas)
        formulas = self.improve_formulas([*single, *double])
        return self.drop_equivalent(self.update_costs(formulas))

    def search_sums(
        self, first: ScoredFormula, seconds: Sequence[_ProductColumn]
    ) -> list[ScoredFormula]:
        """Searches a second term that adds significantly to a formula."""
        beside = JointSearch(self._extend_state(first.candidate), self.j, self._tick)
        ranked, keep = self.rank_columns(seconds, beside.state), THRESHOLDS.max_second_terms
        near = self.select_distinct(ranked, keep, THRESHOLDS.max_start_correlation)
        others = beside.refine_best(beside.score_columns(near), keep)
        sums = [Formula((*first.formula.terms, *s.formula.terms)) for s in others]
        most = THRESHOLDS.max_second_term_residual * first.left
        return [item for item in self.score_formulas(sums) if item.left < most]

    def improve_formulas(self, formulas: Sequence[ScoredFormula]) -> list[ScoredFormula]:
        """Improves formulas by their neighbours, as long as these are better."""
        known_texts, first = set[str](), np.inf
        for _ in range(THRESHOLDS.max_variation_rounds):
            formulas = _by_cost(formulas)
            if not formulas or formulas[0].cost >= first:
                break
            first, near = formulas[0].cost, list[ScoredFormula]()
            best = formulas[: THRESHOLDS.max_varied_formulas]
            for kind in zip(*(self.list_neighbours(item.formula) for item in best), strict=True):
                new = {f.text: f for group in kind for f in group if f.text not in known_texts}
                known_texts |= new.keys()
                scores = self.score_formulas(new.values())
                near += self.refine_best(scores, THRESHOLDS.max_refined_neighbours)
            formulas = [*formulas, *near]
        return list(formulas)

    def list_neighbours(self, formula: Formula) -> tuple[list[Formula], list[Formula]]:
        """Lists the formula without a factor or a term, and with a plain factor in place of one."""
        shorter = [Formula((term,)) for term in formula.terms if len(formula.terms) > 1]
        others = list[Formula]()
        for k, term in enumerate(formula.terms):
            taken = [part.equations[0] for part in term]
            plain = [c.term for text, c in self.plain_factors.items() if text not in taken]
            for i in range(len(term)):
                rest = (*term[:i], *term[i + 1 :])
                for new in ((), *plain) if rest else plain:
                    terms = (*formula.terms[:k], (*new, *rest), *formula.terms[k + 1 :])
                    (others if new else shorter).append(Formula(terms))
        return shorter, [f for f in others if f.is_definable]

    def refine_best(self, ranked: Sequence[ScoredFormula], count: int) -> list[ScoredFormula]:
        """Refines the cheapest formulas."""
        return _by_cost(self.refine_formula(item) for item in _by_cost(ranked)[:count])

    def update_costs(self, every: Sequence[ScoredFormula]) -> list[ScoredFormula]:
        """Updates all costs by the independent rows of what the best leaves."""
        if every:
            best = self._extend_state(min(every, key=lambda s: s.left).candidate)
            self.count = self._count_rows(best.residual[self.j])
        costs = [float(self.compute_cost(s.left, s.formula.symbol_count)) for s in every]
        return _by_cost(replace(s, cost=cost) for s, cost in zip(every, costs, strict=True))

    def _extend_state(self, candidate: Candidate) -> State:
        state = self.state
        return build_state(state.data, [*state.picks, candidate], state.beta)

    def drop_equivalent(self, ranked: Sequence[ScoredFormula]) -> list[ScoredFormula]:
        """Drops formulas that cost, and those whose torque equals that of a cheaper one.

        And those whose second term does not add to the best of one term.
        """
        one = [item.left for item in ranked if len(item.formula.terms) == 1]
        most = THRESHOLDS.max_second_term_residual * min(one, default=np.inf)
        selected: list[tuple[np.ndarray, ScoredFormula]] = []
        for item in ranked:
            if item.cost >= 0.0:
                break
            if len(item.formula.terms) > 1 and item.left > most:
                continue
            torque, least = self.compute_torque(item.candidate), THRESHOLDS.min_formula_difference
            if all(np.linalg.norm(torque - x) > least * np.linalg.norm(x) for x, _ in selected):
                selected.append((torque, item))
        return [item for _, item in selected]

    def compute_torque(self, candidate: Candidate) -> np.ndarray:
        """Computes the torque (rows_j,) that it adds, off the model."""
        columns, base = build_columns(self.state.rows, candidate), self.base
        (score,) = scoring.score_candidates(self.state, [(candidate, columns)])
        whole = to_dense(columns, self.j, len(base)) @ score.values
        return np.asarray(whole - base @ (base.T @ whole))


def _compute_whitening(gram: np.ndarray) -> np.ndarray:
    """What makes columns of that Gram matrix orthonormal."""
    values, vectors = np.linalg.eigh(gram)
    mask = values > 1e-9 * max(float(values.max()), 1e-300)
    return np.asarray(vectors[:, mask] / np.sqrt(values[mask]))


def discover_equations(
    effect_search: Search,
    stated: Sequence[tuple[str, str | None]],
    other: SearchData | None,
    tick: Callable[[], None] = lambda: None,
) -> tuple[JointDiscovery, ...]:
    """Proposes equations, by joint, for what the named effects leave.

    On a joint where these are no more than a description, formulas are tried in their place too.

    Args:
        effect_search: what a diagnosis named.
        stated: effects and joints that stay, whatever an equation says.
        other: held-out logs.
        tick: called whenever something is done.
    """
    every = []
    for j, joint in enumerate(effect_search.spec.joints):
        if joint.actuated and len(effect_search.end.y[j]):
            every.append(_search_joint(effect_search, j, stated, other, tick))
    return tuple(every)


def _search_joint(
    effect_search: Search,
    j: int,
    stated: Sequence[tuple[str, str | None]],
    other: SearchData | None,
    tick: Callable[[], None],
) -> JointDiscovery:
    end, name = effect_search.end, effect_search.end.joint_names[j]
    states, picks = (
        [end],
        [p for p in end.picks if p.index != j or not p.is_local or p.key in stated],
    )
    if len(picks) < len(end.picks):
        states.append(build_state(end.data, picks, end.beta))
    explanations = [_explain_residual(state, j) for state in states]
    tick()
    searches = [JointSearch(state, j, tick) for state in states]
    pairs = zip(searches, explanations, strict=True)
    searches = [s for s, (share, _) in pairs if share > 0.0 or s.has_significant_product()]
    if not searches:
        why = "nothing to find: neither a learned law nor a product says more than chance of it"
        return JointDiscovery(name, 0.0, "", (), why)
    share, law = max(explanations)
    accepted = _select_formulas(searches, other)
    proposals = [
        _build_proposal(effect_search, item, share, k, other) for k, item in enumerate(accepted)
    ]
    if not proposals:
        left = f"{format_percent(share)} of what is left"
        why = f"no small expression says what a learned law does ({left})"
        return JointDiscovery(name, share, law, (), why)
    states = [item.state for item in accepted]
    return JointDiscovery(name, share, law, _add_discriminating_motions(proposals, states, j))


def _explain_residual(state: State, j: int) -> tuple[float, str]:
    """Share of the residual of a joint that a law explains, and of what; 0 within chance."""
    law, baseline = learn_law(state, j), fit_residual_baseline(state, j, state.residual[j])
    if law is not None and law.is_significant:
        return law.variance_reduction, law.coordinates.description
    large = baseline.is_significant and baseline.share > THRESHOLDS.min_variance_reduction
    return (baseline.share if large else 0.0), ""


@dataclass(frozen=True, eq=False)
class _AcceptedFormula:
    """A significant formula, the states without and with it, its score as an effect."""

    state: State
    later: State
    item: ScoredFormula
    score: scoring.ScoredCandidate


def _select_formulas(
    searches: Sequence[JointSearch], other: SearchData | None
) -> list[_AcceptedFormula]:
    """The best formulas beside all states that pass as effects with names must."""
    every = [(search, item) for search in searches for item in search.find_formulas()]
    for search in searches:  # costs beside one and the same model
        search.count, search.before = max(s.count for s in searches), searches[0].before
    every.sort(key=lambda pair: _compute_total_cost(*pair))
    veto, accepted, texts = scoring.make_veto(other), list[_AcceptedFormula](), set[str]()
    for search, item in every[: THRESHOLDS.max_scored_formulas]:
        best = search.judge_candidate(item.candidate)
        later = extend_state(search.state, item.candidate)
        if best is None or item.formula.text in texts or veto(search.state, later, best):
            continue
        texts.add(item.formula.text)
        accepted.append(_AcceptedFormula(search.state, later, item, best))
        if len(accepted) == THRESHOLDS.max_proposals:
            break
    return _sort_by_held_out_error(accepted, other)


def _sort_by_held_out_error(
    formulas: list[_AcceptedFormula], other: SearchData | None
) -> list[_AcceptedFormula]:
    """The least held-out error first; of those that it does not surely beat, the shortest."""
    if len(formulas) < 2:
        return formulas
    left = [scoring.compute_holdout_residuals(formula.later, other) for formula in formulas]
    j, state = formulas[0].item.candidate.index, formulas[0].state
    errors = [scoring.compute_errors(residuals)[state.joint_names[j]] for residuals in left]
    best = left[int(np.argmin(errors))]

    def compute_sort_key(k: int) -> tuple[bool, float, float]:
        worse = scoring.compare_residuals(left[k], best, [j], state).whole.is_reduced
        return worse, errors[k] if worse else formulas[k].item.formula.symbol_count, errors[k]

    return [formulas[k] for k in sorted(range(len(formulas)), key=compute_sort_key)]


def _compute_total_cost(search: JointSearch, item: ScoredFormula) -> float:
    """Nats with the price of the effects of the catalogue beside which the formula stands."""
    picks = [p for p in search.state.picks if p.index == search.j]
    symbols = sum(count_symbols(c.equation.text) for p in picks for c in p.form.columns)
    return float(search.compute_cost(item.left, item.formula.symbol_count + symbols))


def _build_proposal(
    effect_search: Search,
    accepted: _AcceptedFormula,
    share: float,
    rank: int,
    other: SearchData | None,
) -> EquationProposal:
    """A proposal with its values, as text, and the effect that it is near to."""
    state, later, item, formula = (
        accepted.state,
        accepted.later,
        accepted.item,
        accepted.item.formula,
    )
    j, joint, k = item.candidate.index, item.candidate.joint or "", len(state.picks)
    known = state.data.stated_effects.catalogue
    name = make_effect_id("found", f"{joint}{'abc'[rank]}", {e.id for e in known})
    prefixes = {c.prefix for e in known for form in e.forms for c in form.columns}
    labels = [choose_free_name(f"X{chr(97 + j % 26)}{'abc'[rank]}{x}", prefixes) for x in "abcd"]
    shapes = formula.find_nonlinear_units(state.spec.joints[j].unit == "m")
    columns = range(len(formula.equations))
    units = [derive_parameter_unit(state.spec, j, item.candidate, i, shapes) for i in columns]
    unit = units[0] if len(set(units)) == 1 else dict(zip(labels, units, strict=False))
    definition = {"title": formula.title, **formula.build_definition(labels), "unit": unit}
    cell = TomlCell("discover", value=definition)
    effect = read_definition(name, cell, {}, joints=state.joint_names)
    candidate, values = (
        replace(item.candidate, effect=effect, form=effect.forms[0]),
        later.values[k],
    )
    rms = float(np.sqrt(np.mean((later.residual[j] / state.sigma[j]) ** 2)))
    estimate = estimate_effect(later, k, candidate, values, accepted.score.deviations * rms)
    before, after = (scoring.compute_holdout_residuals(s, other) for s in (state, later))
    change = scoring.compare_residuals(before, after, [j], state).whole
    finding = Finding(
        name,
        joint,
        change.before,
        change.after,
        estimate.parameters,
        estimate.sigmas,
        units=dict(zip(estimate.units, units, strict=False)) | shapes,
        equivalents=(),
        evidence=formula.title,
        closure=None,
        is_refinement=False,
        pick=FittedCandidate(candidate, values, later, accepted.score.visible_share),
    )
    relative, likeness, differs = _describe_nearest(state, formula, candidate, values)
    rounded = {key: float(f"{x:.6g}") for key, x in candidate.nonlinear_parameters.items()}
    entry = {"joint": joint, **rounded} if rounded else joint
    steps = [s for s in effect_search.steps if s.candidate in state.picks]
    steps.append(SearchStep(replace(accepted.score, candidate=candidate), (), state))
    return EquationProposal(
        finding=finding,
        definition=definition,
        equation=" + ".join(f"{c.prefix}{joint} {c.equation.text}" for c in effect.columns),
        effects_line=f"{name} = {format_toml([entry])}",
        explained=min(1.0, accepted.score.variance_reduction / share) if share else math.nan,
        symbols=formula.symbol_count,
        instead=tuple(p.effect.id for p in effect_search.end.picks if p not in state.picks),
        relative=relative,
        likeness=likeness,
        differs=differs,
        final_search=replace(effect_search, steps=tuple(steps), end=later),
    )


# The nearest effect with a name, and what tells it from the next.


def _describe_nearest(
    state: State, formula: Formula, candidate: Candidate, values: np.ndarray
) -> tuple[str, float, str]:
    """Id of the nearest effect of the catalogue, how near, and what differs."""
    named, least = _list_catalogue_columns(state, candidate.index), THRESHOLDS.min_likeness
    near, share = _find_nearest(_build_joint_columns(state, candidate) @ values, named)
    nearest_text = f"{near.effect.title} ({near.effect.id})" if near is not None else "nothing"
    matches = [(share, f"nearly {nearest_text}")] if share > least else []
    (term,) = formula.terms if len(formula.terms) == 1 else ((),)
    for i, part in enumerate(term) if len(term) > 1 else ():
        rest = Formula(((*term[:i], *term[i + 1 :]),))
        rest_effect = rest.build_candidate(state.joint_names, candidate.index)
        head, alike = _find_nearest(_build_joint_columns(state, rest_effect)[:, 0], named)
        if head is not None and alike > least:
            near = near or head
            text = f"{head.effect.title} ({head.effect.id}), times {part.effect.title}"
            matches.append((alike, text))
    far = f"nearest is {nearest_text}, which explains {format_percent(share)} of it"
    return near.effect.id if near is not None else "", share, max(matches)[1] if matches else far


def _list_catalogue_columns(state: State, j: int) -> list[tuple[Candidate, np.ndarray]]:
    """Effects of the catalogue on a joint over their grids, with their columns."""
    name, scale = state.joint_names[j], state.joint_scales[j]
    lacking = set() if name in state.reference.temperature else {"T"}
    every = [
        candidate
        for effect in state.data.stated_effects.catalogue
        if effect.acts is EffectTarget.JOINT
        for form in effect.forms
        if not lacking & form.names and not form.other_joint_names
        for candidate in expand_grid(effect, form, name, j, scale)
    ]
    pairs = zip(every, build_all_columns(state.rows, every), strict=True)
    return [(c, to_dense(made, j, len(state.y[j]))) for c, made in pairs if is_visible(made)]


def _find_nearest(
    torque: np.ndarray, named: Sequence[tuple[Candidate, np.ndarray]]
) -> tuple[Candidate | None, float]:
    """The one whose columns explain most of a torque, and the share."""
    best, share = None, 0.0
    size = float(torque @ torque) or 1.0
    for candidate, columns in sorted(named, key=lambda pair: pair[1].shape[1]):
        if np.isfinite(columns).all():
            q = np.linalg.lstsq(columns, torque, rcond=1e-9)[0]
            explained = 1.0 - float(np.sum((torque - columns @ q) ** 2)) / size
            if explained > share + THRESHOLDS.min_nearer_share:
                best, share = candidate, explained
    return best, share


def _build_joint_columns(state: State, candidate: Candidate) -> np.ndarray:
    """(rows_j, k) on its joint."""
    j = candidate.index
    return to_dense(build_columns(state.rows, candidate), j, len(state.y[j]))


def _add_discriminating_motions(
    proposals: Sequence[EquationProposal], states: Sequence[State], j: int
) -> tuple[EquationProposal, ...]:
    """Each with the motion that tells it from the next, the last from the first."""
    if len(proposals) < 2:
        return tuple(proposals)
    pairs = [(p.finding.pick, s) for p, s in zip(proposals, states, strict=True)]
    torques = [_build_joint_columns(s, p.candidate) @ p.values for p, s in pairs if p is not None]
    rows, joint, results = states[0].rows, states[0].spec.joints[j], list[EquationProposal]()
    signals = [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]]) for s in rows.signals]
    motion = rows.filter_samples(j, signals)
    unit, effort = joint.unit, joint.effort_unit
    for k, proposal in enumerate(proposals):
        other = (k + 1) % len(proposals)
        apart = np.abs(torques[k] - torques[other])
        q, v, load = motion[int(np.argmax(apart))]
        pair = ",".join(f"{proposals[i].finding.effect}@{joint.name}" for i in (k, other))
        command = f"modeler excite ROBOT.toml --between {pair} --out apart.csv"
        place = f"q = {q:.3g} {unit}, v = {v:.3g} {unit}/s, load = {load:.3g} {effort}"
        where = f"they differ most, by {apart.max():.3g} {effort}, near {place}"
        results.append(replace(proposal, apart=command, where=where))
    return tuple(results)
