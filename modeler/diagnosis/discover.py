"""An equation for what has no name: small expressions, judged as the effects of the catalogue are.

Columns are products of up to three factors (`expressions`), a formula is a sum of at most two of
them. Products are looked at where factors have passed the filter of the rows already, which is
quick and nearly right; the best are made anew, filtered as a whole, and their shapes refined.
What is compared is a length in nats (Rissanen 1978): with S the squared residual of the joint on
motion that was held out, S0 that of the model, n its rows that do not repeat each other,

    n/2 ln(S / S0) + PRICE (symbols + free numbers).
"""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares

from modeler.core.brief import Brief
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import dense
from modeler.diagnosis.expressions import Formula, Term, parts
from modeler.diagnosis.judge import Judged, decide, judged_at, tried
from modeler.diagnosis.orders import order_spectrum
from modeler.diagnosis.state import State, all_columns_of, columns_of, state_of, visible
from modeler.estimation import remembered
from modeler.numerics.spectra import order_spectrum as spectrum_of
from modeler.runtime import mapped

PRICE = 4.0
"""Nats of a symbol, which is one of about fifty, and of a free number: 1/2 ln n (Schwarz 1978)."""

SAME = 0.003
"""Share of its torque by which a formula must differ from a better one to be another."""

MORE = 0.9**2
"""Share of the squared residual that a second term must fall below: a tenth of the error."""

ALIKE = 0.995
"""Correlation of two columns, off the model, from which on the shorter one stands for both."""

NEAR = 0.97
"""The same where shapes are refined still."""

_AT_ONCE = 16  # columns, each with all factors
_MANY = 512  # columns
_BEAM = 30  # products of two that get a third factor
_HINTS = 4  # products that are judged before all else
_EXACT = 40  # columns that are made anew
_REFINED = 12
_FIRSTS = 4  # columns that get a second one beside them
_SECONDS = 1500  # products of two that are tried there
_BESIDE = 8
_STEPS = 20  # of refining
_NEAR, _ROUNDS, _CHANGED = 3, 3, 14
_PLAIN = ("sign(v)", "v", "abs(v)", "v*abs(v)", "load", "abs(load)")
_LOW = (0.5, 1.0, 1.5, 2.0, 2.5)  # waves in the stroke that no spectrum shows


@dataclass(frozen=True, eq=False)
class Scored(Brief):
    """A formula on its joint.

    Attributes:
        formula: terms and shapes.
        candidate: the same as an effect.
        left: squared residual of the joint on motion that was held out, (N m)^2 or N^2.
        cost: nats, beside that of the model without it.
    """

    formula: Formula
    candidate: Candidate
    left: float
    cost: float


@dataclass(frozen=True, eq=False)
class _Column:
    """A product at the rows of the joint: values (rows_j, k), scaled."""

    term: Term
    values: np.ndarray
    symbols: int


_Priced = tuple[float, _Column, _Column | None]
"""Nats, a column, and the factor that it is multiplied by."""


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
        self.before = float(state.sigma[j] ** 2 * np.sum(state.folded.left_out[j] ** 2))
        noise = np.random.default_rng(0).normal(size=len(state.y[j]))
        self.count = self._count(noise)  # what is missing is remembered, noise is not

    def _count(self, left: np.ndarray) -> float:
        """Rows of the joint that do not repeat each other, by what is left of it (rows_j,)."""
        observation = self.state.data.observation
        rows = np.flatnonzero(observation.used[:, self.j])
        r = remembered(observation, left, rows)
        return len(rows) / max(1.0, 2.0 * float(r.sum()) - 1.0)

    def cost(self, left: np.ndarray | float, symbols: np.ndarray | int) -> np.ndarray:
        """Nats of what is left of the squared residual by a formula of so many symbols."""
        share = np.maximum(np.asarray(left) / self.before, 1e-12)
        return np.asarray(0.5 * self.count * np.log(share) + PRICE * np.asarray(symbols))

    # Factors at the rows of the joint, and products of them.

    @cached_property
    def columns(self) -> list[_Column]:
        """Every factor at the first values of its shapes."""
        state, found = self.state, list[_Column]()
        warm = self.joint.name in state.reference.temperature
        stroke = 2.0 * np.pi / state.scales[self.j].range
        waves = [*(stroke * x for x in _LOW), *self.orders()]
        for own in parts(state.spec, state.scales, self.j, warm, waves):
            first = Formula(((own[0],),)).candidate(state.names, self.j)
            every = [dataclasses.replace(first, shapes=dict(part.shapes)) for part in own]
            made = all_columns_of(state.rows, every)
            shown = [pair for pair in zip(own, made, strict=True) if visible(pair[1])]
            found += [self._column((p,), dense(c, self.j, self._rows)) for p, c in shown]
            self._tick()
        return found

    @cached_property
    def atoms(self) -> list[_Column]:
        """Those that are no waves."""
        return [column for column in self.columns if column.values.shape[1] == 1]

    @property
    def _rows(self) -> int:
        return len(self.state.y[self.j])

    def _column(self, term: Term, values: np.ndarray) -> _Column:
        size = np.sqrt(np.mean(values**2, axis=0))
        return _Column(term, values / np.where(size > 0.0, size, 1.0), Formula((term,)).symbols)

    def _product(self, a: _Column, b: _Column) -> _Column:
        """Of a column and a factor that is no wave."""
        term = (*a.term, *b.term)
        return _Column(term, a.values * b.values, Formula((term,)).symbols)

    def orders(self) -> list[float]:
        """Waves that stand out in the residual, and in it turned by the motion or the load."""
        state, j = self.state, self.j
        own = order_spectrum(state, j)
        found = list(own.peaks) if own is not None else []
        x = state.rows.filtered(j, [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]])
                                    for s in state.rows.signals])  # fmt: skip
        cutoff = state.data.observation.report.processing.parallel_cutoff or 1e9
        reached = 2.0 * np.pi * cutoff / max(float(np.quantile(np.abs(x[:, 1]), 0.1)), 1e-9)
        for turned in (np.sign(x[:, 1]), x[:, 1], x[:, 2], np.abs(x[:, 2])):
            r = state.residual[j] * turned
            spectrum = spectrum_of(x[:, 0], r - r.mean(), self.joint.unit, reached)
            found += spectrum.peaks if spectrum is not None else ()
        once: list[float] = []
        for order in found:
            if all(abs(order - other) > 1.0 / state.scales[j].range for other in once):
                once.append(order)
        return once

    @cached_property
    def named(self) -> dict[str, _Column]:
        """Factors without shapes, by their text."""
        return {c.term[0].texts[0]: c for c in self.atoms if not c.term[0].shapes}

    def products(
        self, left: Sequence[_Column], right: Sequence[_Column], keep: int,
        state: State | None = None,
    ) -> list[_Priced]:  # fmt: skip
        """The cheapest products of a column and a factor that an effect can hold.

        Args:
            left: columns; of those among the factors, only with later factors.
            right: factors.
            keep: how many.
            state: what they stand beside; None: the model.
        """
        state, place = state or self.state, {id(c): k for k, c in enumerate(right)}
        values = np.stack([c.values[:, 0] for c in right])
        symbols = np.array([c.symbols for c in right])
        texts = np.array([c.term[0].texts[0] for c in right])

        def of(column: _Column) -> list[_Priced]:
            first = place.get(id(column), -1) + 1
            fit = ~np.isin(texts[first:], [part.texts[0] for part in column.term])
            who = first + np.flatnonzero(fit)
            made = column.values.T[None] * values[who][:, None]
            count = len(column.values.T)
            costs = self.priced(state, made, column.symbols + count * (symbols[who] - 1))
            best = np.argsort(costs)[:keep]
            return [(float(costs[k]), column, right[who[k]]) for k in best]

        found: list[_Priced] = []
        for some in (left[k : k + _AT_ONCE] for k in range(0, len(left), _AT_ONCE)):
            for own in mapped(of, some):
                found += own
            found = sorted(found, key=lambda item: item[0])[:keep]
            self._tick()
        return found

    def priced(self, state: State, made: np.ndarray, symbols: np.ndarray) -> np.ndarray:
        """(K,) nats of columns (K, k, rows_j) by what they explain of all rows beside a state."""
        whole = float(np.sum(state.residual[self.j] ** 2))
        fall = float(state.sigma[self.j] ** 2) * self.fall(state, made)
        return self.cost(whole - np.clip(fall, 0.0, whole), symbols)

    def fall(self, state: State, made: np.ndarray) -> np.ndarray:
        """(K,) fall of the squared residual, weighted, by columns (K, k, rows_j), on all rows."""
        base, e = state.base.columns[self.j], state.residual[self.j] / state.sigma[self.j]
        T = made @ base
        gram = made @ made.swapaxes(1, 2) - T @ T.swapaxes(1, 2)
        length = np.einsum("kii->ki", gram) + 1e-6 * np.einsum("kin,kin->ki", made, made) + 1e-30
        side = (made @ e) / np.sqrt(length)
        gram /= np.sqrt(length[:, :, None] * length[:, None])
        gram += 1e-6 * np.eye(gram.shape[1])
        fall = np.einsum("ki,ki->k", side, np.linalg.solve(gram, side[..., None])[..., 0])
        return np.nan_to_num(fall)

    def singles(self, columns: Sequence[_Column], state: State | None = None) -> list[_Priced]:
        """Columns as they are, the cheapest first."""
        found: list[_Priced] = []
        for k in range(0, len(columns), _MANY):
            some = columns[k : k + _MANY]
            for count in (1, 2):
                own = [c for c in some if len(c.values.T) == count]
                if own:
                    made = np.stack([c.values.T for c in own])
                    costs = self.priced(state or self.state, made,
                                        np.array([c.symbols for c in own]))  # fmt: skip
                    found += [(float(cost), c, None) for cost, c in zip(costs, own, strict=True)]
        return sorted(found, key=lambda item: item[0])

    def distinct(self, ranked: Sequence[_Priced], keep: int, alike: float = ALIKE) -> list[_Column]:
        """The cheapest that are not alike."""
        base = self.state.base.columns[self.j]
        found: list[tuple[np.ndarray, _Column]] = []
        for _, left, right in ranked:
            column = left if right is None else self._product(left, right)
            c = column.values
            own = np.vstack([c, 1j * (base.T @ c)])  # products are those of columns off the model
            own = own @ _root((own.T @ own).real)
            shared = (float(np.linalg.norm((own.T @ x).real) ** 2 / min(len(own.T), len(x.T)))
                      for x, _ in found)  # fmt: skip
            if own.size and all(share < alike**2 for share in shared):
                found.append((own, column))
            if len(found) == keep:
                break
        return [column for _, column in found]

    # Formulas, as effects.

    def scored(self, formulas: Sequence[Formula]) -> list[Scored]:
        """Formulas by the columns that they have as effects, the cheapest first."""
        made = [(f, f.candidate(self.state.names, self.j)) for f in formulas if f.possible]
        pairs = [(f, c, self.state.rows.columns(c)) for f, c in made]
        pairs = [own for own in pairs if visible(own[2])]
        if not pairs:
            return []
        trials = tried(self.state, [(c, columns) for _, c, columns in pairs])
        unit = float(self.state.sigma[self.j] ** 2)
        found = []
        for (formula, candidate, _), trial in zip(pairs, trials, strict=True):
            left = self.before - unit * trial.fall
            found.append(Scored(formula, candidate, left, float(self.cost(left, formula.symbols))))
        return sorted(found, key=lambda s: s.cost)

    def refined(self, item: Scored) -> Scored:
        """The same at its best shapes: variable projection (Kaufman 1975), on all rows."""
        formula, start = item.formula, np.array([*item.formula.shapes.values()])
        if not start.size:
            return item
        sizes = np.array([size for part, names in formula.parts for size in part.sizes()])
        base, e = self.state.base.columns[self.j], self.state.residual[self.j]

        def at(x: np.ndarray) -> Formula:
            return formula.with_shapes(dict(zip(formula.shapes, start + sizes * x, strict=True)))

        def left(x: np.ndarray) -> np.ndarray:
            candidate = dataclasses.replace(item.candidate, shapes=at(x).shapes)
            columns = self.state.rows.columns(candidate)
            if not visible(columns):
                return e
            c = dense(columns, self.j, self._rows)
            off = c - base @ (base.T @ c)
            return np.asarray(e - off @ np.linalg.lstsq(off, e, rcond=1e-9)[0])

        found = least_squares(left, np.zeros(start.size), diff_step=1e-3, max_nfev=_STEPS)
        self._tick()
        again = self.scored([at(found.x)])
        return again[0] if again and again[0].cost < item.cost else item

    def hinted(self) -> bool:
        """True if a product surely explains something: laws resolve no waves, and forget."""
        every = [*self.singles(self.columns), *self.products(self.columns, self.atoms, _EXACT)]
        ranked = sorted(every, key=lambda item: item[0])
        few = self.scored([Formula((c.term,)) for c in self.distinct(ranked, _HINTS)])
        return any(self.judged(item.candidate) is not None for item in few)

    def judged(self, candidate: Candidate) -> Judged | None:
        """It as an effect of the catalogue is judged; None if it is worth no name."""
        pair = candidate, columns_of(self.state.rows, candidate)
        return decide(self.state, judged_at(self.state, [pair])).best

    def found(self) -> list[Scored]:
        """Formulas that say more than they cost, the cheapest first; no two are alike."""
        atoms = self.atoms
        doubles = self.products(self.columns, atoms, _SECONDS)
        triples = self.products(self.distinct(doubles, _BEAM), atoms, _SECONDS)
        ranked = sorted([*self.singles(self.columns), *doubles, *triples],
                        key=lambda item: item[0])  # fmt: skip
        leading = [Formula((c.term,)) for c in self.distinct(ranked, _EXACT, NEAR)]
        single = self.best(self.scored(leading), _REFINED)
        # what explains little alone may do so beside the first
        plain = [self.named[text] for text in _PLAIN if text in self.named]
        further = [(0.0, c, p) for c in self.columns for p in (None, *plain) if p is not c]
        seconds = [left if right is None else self._product(left, right)
                   for _, left, right in [*ranked[:_SECONDS], *further]]  # fmt: skip
        pairs = [own for first in single[:_FIRSTS] for own in self.sums(first, seconds)]
        double = self.best(pairs, _REFINED)
        for term in double[0].formula.terms if double else ():  # each again beside the other
            double += self.best(self.sums(self.scored([Formula((term,))])[0], seconds), _NEAR)
        found = self.polished([*single, *double])
        return self.apart(self.priced_anew(found))

    def sums(self, first: Scored, seconds: Sequence[_Column]) -> list[Scored]:
        """A formula and a second term that surely adds to it."""
        beside = JointSearch(self._with(first.candidate), self.j, self._tick)
        near = self.distinct(self.singles(seconds, beside.state), _BESIDE, NEAR)
        others = beside.best(beside.scored([Formula((c.term,)) for c in near]), _BESIDE)
        sums = [Formula((*first.formula.terms, *s.formula.terms)) for s in others]
        return [s for s in self.scored(sums) if s.left < MORE * first.left]

    def polished(self, found: Sequence[Scored]) -> list[Scored]:
        """Formulas and their neighbours, as long as these are better."""
        seen, first = set[str](), np.inf
        for _ in range(_ROUNDS):
            found = sorted(found, key=lambda s: s.cost)
            if not found or found[0].cost >= first:
                break
            first, near = found[0].cost, list[list[Scored]]()
            for kind in zip(
                *(self.neighbours(item.formula) for item in found[:_NEAR]), strict=True
            ):
                new = {f.text: f for own in kind for f in own if f.text not in seen}
                seen |= new.keys()
                near.append(self.scored([*new.values()]))
            found = [*found, *(item for own in near for item in self.best(own, _CHANGED))]
        return list(found)

    def neighbours(self, formula: Formula) -> tuple[list[Formula], list[Formula]]:
        """It without a part or a term; with a plain factor in place of a part."""
        shorter = [Formula((term,)) for term in formula.terms if len(formula.terms) > 1]
        others = list[Formula]()
        for k, term in enumerate(formula.terms):
            for i in range(len(term)):
                rest = (*term[:i], *term[i + 1 :])
                taken = [part.texts[0] for part in term]
                plain = [self.named[text].term for text in _PLAIN
                         if text in self.named and text not in taken]  # fmt: skip
                for new in ((), *plain) if rest else plain:
                    terms = (*formula.terms[:k], (*new, *rest), *formula.terms[k + 1 :])
                    (others if new else shorter).append(Formula(terms))
        return shorter, [f for f in others if f.possible]

    def best(self, ranked: Sequence[Scored], count: int) -> list[Scored]:
        """The cheapest at their best shapes."""
        first = sorted(ranked, key=lambda s: s.cost)[:count]
        return sorted((self.refined(item) for item in first), key=lambda s: s.cost)

    def priced_anew(self, every: Sequence[Scored]) -> list[Scored]:
        """The cheapest first, by how many rows there are in what the best leaves."""
        if every:
            best = self._with(min(every, key=lambda s: s.left).candidate)
            self.count = self._count(best.residual[self.j])
        again = [dataclasses.replace(s, cost=float(self.cost(s.left, s.formula.symbols)))
                 for s in every]  # fmt: skip
        return sorted(again, key=lambda s: s.cost)

    def _with(self, candidate: Candidate) -> State:
        """The model with it."""
        state = self.state
        return state_of(state.data, [*state.picks, candidate], state.beta)

    def apart(self, ranked: Sequence[Scored]) -> list[Scored]:
        """Those below no cost whose torques differ from those of all cheaper ones.

        And whose second term adds to the best of one term.
        """
        one = [item.left for item in ranked if len(item.formula.terms) == 1]
        most = MORE * min(one, default=np.inf)
        found: list[tuple[np.ndarray, Scored]] = []
        for item in ranked:
            if item.cost >= 0.0:
                break
            if len(item.formula.terms) > 1 and item.left > most:
                continue
            torque = self.torque(item.candidate)
            if all(np.linalg.norm(torque - other) > SAME * np.linalg.norm(other)
                   for other, _ in found):  # fmt: skip
                found.append((torque, item))
        return [item for _, item in found]

    def torque(self, candidate: Candidate) -> np.ndarray:
        """(rows_j,) what it adds, off the model."""
        columns = dense(columns_of(self.state.rows, candidate), self.j, self._rows)
        (judged,) = judged_at(self.state, [(candidate, columns_of(self.state.rows, candidate))])
        whole = columns @ judged.values
        base = self.state.base.columns[self.j]
        return np.asarray(whole - base @ (base.T @ whole))


def _root(gram: np.ndarray) -> np.ndarray:
    """What makes columns of that Gram matrix orthonormal."""
    values, vectors = np.linalg.eigh(gram)
    kept = values > 1e-9 * max(float(values.max()), 1e-300)
    return np.asarray(vectors[:, kept] / np.sqrt(values[kept]))
