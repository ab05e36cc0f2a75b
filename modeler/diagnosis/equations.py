"""Formulas of one joint that explain its residual: products of factors, and their scores."""

import itertools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares

from modeler.core.json import ShortRepr
from modeler.diagnosis import scoring
from modeler.diagnosis.candidates import Candidate, to_dense
from modeler.diagnosis.expressions import Formula, Term, list_factors
from modeler.diagnosis.generation import compute_joint_order_spectrum
from modeler.diagnosis.state import State, build_all_columns, build_columns, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
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


_Columns = Sequence[_ProductColumn]


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

    def rank_products(self, left: _Columns, keep: int, state: State | None = None) -> list[_Priced]:
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

    def rank_columns(self, columns: _Columns, state: State | None = None) -> list[_Priced]:
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
            least = [min(len(basis.T), len(x.T)) * alike**2 for x, _ in selected]
            shared = [float(np.linalg.norm((basis.T @ x).real)) ** 2 for x, _ in selected]
            if basis.size and all(a < b for a, b in zip(shared, least, strict=True)):
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
        """Returns whether a product is significant: laws resolve no waves and no memory."""
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

    def search_sums(self, first: ScoredFormula, seconds: _Columns) -> list[ScoredFormula]:
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
