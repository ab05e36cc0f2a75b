"""Equations proposed for what a diagnosis leaves: as text to paste, with what they are near to."""

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.table import percent
from modeler.core.toml_cells import Place, toml_text
from modeler.diagnosis.candidates import Candidate, over_grid
from modeler.diagnosis.discover import JointSearch, Scored
from modeler.diagnosis.effect_columns import dense
from modeler.diagnosis.expressions import Formula, parameter_unit, symbols_of
from modeler.diagnosis.judge import GATE, Judged, compared, holdout_residuals, vetoing
from modeler.diagnosis.learn import effect_id, free_name, learn
from modeler.diagnosis.orders import rival
from modeler.diagnosis.profile import profile_of, values_of
from modeler.diagnosis.result import Discovery, Finding, Pick, Proposal
from modeler.diagnosis.score import errors_of
from modeler.diagnosis.search import Search, Step, extended
from modeler.diagnosis.state import SearchData, State, all_columns_of, columns_of, state_of, visible
from modeler.effects import Acts, read_definition

MOST = 3
"""Equations offered on a joint."""

ALMOST = 0.98
"""Share of a column that another explains from which on they are nearly the same."""

LEAST = 0.01
"""Share by which one with more columns must be nearer."""

_JUDGED = 8  # formulas, the cheapest first, that are judged


def discover(
    found: Search, stated: Sequence[tuple[str, str | None]], other: SearchData | None,
    tick: Callable[[], None] = lambda: None,
) -> tuple[Discovery, ...]:  # fmt: skip
    """Equations for what the effects with names leave, by joint.

    On a joint where these are no more than a description, formulas are tried in their place too.

    Args:
        found: what a diagnosis named.
        stated: effects and joints that stay, whatever an equation says.
        other: held-out logs.
        tick: called whenever something is done.
    """
    every = []
    for j, joint in enumerate(found.spec.joints):
        if joint.actuated and len(found.end.y[j]):
            every.append(_on_joint(found, j, stated, other, tick))
    return tuple(every)


def _on_joint(
    found: Search, j: int, stated: Sequence[tuple[str, str | None]], other: SearchData | None,
    tick: Callable[[], None],
) -> Discovery:  # fmt: skip
    end, name = found.end, found.end.names[j]
    kept = tuple(p for p in end.picks if p.index != j or not p.local or p.key in stated)
    states = [end] + ([state_of(end.data, kept, end.beta)] if len(kept) < len(end.picks) else [])
    said = [_said(state, j) for state in states]
    tick()
    searches = [JointSearch(state, j, tick) for state in states]
    searches = [search for search, (share, _) in zip(searches, said, strict=True)
                if share > 0.0 or search.hinted()]  # fmt: skip
    if not searches:
        why = "nothing to find: neither a learned law nor a product says more than chance of it"
        return Discovery(name, 0.0, "", (), why)
    share, law = max(said)
    offered = _offered(searches, other)
    proposals = [_proposal(found, own, share, k, other) for k, own in enumerate(offered)]
    if not proposals:
        why = f"no small expression says what a learned law does ({percent(share)} of what is left)"
        return Discovery(name, share, law, (), why)
    return Discovery(name, share, law, _told_apart(proposals, [o.state for o in offered], j))


def _said(state: State, j: int) -> tuple[float, str]:
    """Share of the residual of a joint that a law explains, and of what; 0 within chance."""
    law, said = learn(state, j), rival(state, j, state.residual[j])
    if law is not None and law.significant:
        return law.gain, law.coordinates.told
    return (said.share, "") if said.sure and said.share > GATE else (0.0, "")


@dataclass(frozen=True, eq=False)
class _Offered:
    """A formula that was judged well."""

    state: State
    later: State
    item: Scored
    judged: Judged


def _offered(searches: Sequence[JointSearch], other: SearchData | None) -> list[_Offered]:
    """The best formulas beside all states that pass as effects with names must."""
    every = [(search, item) for search in searches for item in search.found()]
    for search in searches:  # costs beside one and the same model
        search.count, search.before = max(s.count for s in searches), searches[0].before
    every.sort(key=lambda pair: _whole_cost(*pair))
    veto, kept, seen = vetoing(other), list[_Offered](), set[str]()
    for search, item in every[:_JUDGED]:
        state = search.state
        best, later = search.judged(item.candidate), extended(state, item.candidate)
        if best is None or item.formula.text in seen or veto(state, later, best):
            continue
        seen.add(item.formula.text)
        kept.append(_Offered(state, later, item, best))
        if len(kept) == MOST:
            break
    return _by_held_out_error(kept, other)


def _by_held_out_error(kept: list[_Offered], other: SearchData | None) -> list[_Offered]:
    """The least held-out error first; of those that it does not surely beat, the shortest."""
    if len(kept) < 2:
        return kept
    left = [holdout_residuals(own.later, other) for own in kept]
    j, state = kept[0].item.candidate.index, kept[0].state
    errors = [errors_of(seen)[state.names[j]] for seen in left]
    best = left[int(np.argmin(errors))]

    def place(k: int) -> tuple[bool, float, float]:
        worse = compared(left[k], best, [j], state).whole.falls
        return worse, errors[k] if worse else kept[k].item.formula.symbols, errors[k]

    return [kept[k] for k in sorted(range(len(kept)), key=place)]


def _whole_cost(search: JointSearch, item: Scored) -> float:
    """Nats with the price of the effects of the catalogue beside which the formula stands."""
    named = [c.equation.text for p in search.state.picks for c in p.form.columns
             if p.index == search.j]  # fmt: skip
    symbols = item.formula.symbols + sum(map(symbols_of, named))
    return float(search.cost(item.left, symbols))


def _proposal(
    found: Search, own: _Offered, share: float, rank: int, other: SearchData | None
) -> Proposal:
    """An offer with its values, as text, and what it is near to."""
    state, later, item, k = own.state, own.later, own.item, len(own.state.picks)
    j, joint, formula = item.candidate.index, item.candidate.joint or "", item.formula
    known = state.data.known.catalogue
    name = effect_id("found", f"{joint}{'abc'[rank]}", {e.id for e in known})
    prefixes = {c.prefix for e in known for form in e.forms for c in form.columns}
    labels = [free_name(f"X{chr(97 + j % 26)}{'abc'[rank]}{x}", prefixes) for x in "abcd"]
    shapes = formula.shape_units(state.spec.joints[j].unit == "m")
    units = [parameter_unit(state.spec, j, item.candidate, i, shapes)
             for i in range(len(formula.columns))]  # fmt: skip
    table = formula.definition(labels)
    definition = {"title": formula.title, **table, "unit": units[0] if len(set(units)) == 1
                  else dict(zip(labels, units, strict=False))}  # fmt: skip
    place = Place("discover", value=definition)
    effect = read_definition(name, place, {}, joints=state.names)
    candidate = dataclasses.replace(item.candidate, effect=effect, form=effect.forms[0])
    left, along, values = later.residual[j] / state.sigma[j], profile_of(later, k), later.values[k]
    deviations = own.judged.deviations * float(np.sqrt(np.mean(left**2)))
    named = values_of(later, candidate, values, deviations if along is None else along.deviations())
    before, after = (holdout_residuals(s, other) for s in (state, later))
    change = compared(before, after, [j], state).whole
    finding = Finding(
        effect=name, joint=joint, error_before=change.before, error_after=change.after,
        parameters=named.value | dict(candidate.shapes),
        sigmas=named.deviation | ({} if along is None else along.shape_deviations()),
        units=dict(zip(named.value, units, strict=True)) | shapes, ties=(),
        evidence=formula.title, closure=None, refines=False,
        pick=Pick(candidate, values, later, own.judged.visible),
    )  # fmt: skip
    relative, likeness, differs = _relative(state, formula, candidate, values)
    stated = {"joint": joint, **{key: float(f"{x:.6g}") for key, x in candidate.shapes.items()}}
    judged = dataclasses.replace(own.judged, candidate=candidate)
    steps = (*(s for s in found.steps if s.pick in state.picks), Step(judged, (), state))
    return Proposal(
        finding=finding, definition=definition,
        equation=" + ".join(f"{c.prefix}{joint} {c.equation.text}" for c in effect.columns),
        effects_line=f"{name} = {toml_text([stated if candidate.shapes else joint])}",
        explained=min(1.0, own.judged.gain / share) if share else math.nan, symbols=formula.symbols,
        instead=tuple(p.effect.id for p in found.end.picks if p not in state.picks),
        relative=relative, likeness=likeness, differs=differs,
        drawn=dataclasses.replace(found, steps=steps, end=later),
    )  # fmt: skip


# The nearest effect with a name, and what tells it from the next.


def _relative(
    state: State, formula: Formula, candidate: Candidate, values: np.ndarray
) -> tuple[str, float, str]:
    """Id of the nearest effect of the catalogue, how near, and what differs."""
    named = _named(state, candidate.index)
    near, share = _nearest(_columns(state, candidate) @ values, named)
    told = f"{near.effect.title} ({near.effect.id})" if near is not None else "nothing"
    found = [(share, f"nearly {told}")] if share > ALMOST else []
    for term in formula.terms if len(formula.terms) == 1 else ():
        for i, part in enumerate(term):
            rest = Formula(((*term[:i], *term[i + 1 :]),))
            if rest.terms[0]:
                column = _columns(state, rest.candidate(state.names, candidate.index))
                head, alike = _nearest(column[:, 0], named)
                if head is not None and alike > ALMOST:
                    near, more = near or head, f", times {part.factor.title}"
                    found.append((alike, f"{head.effect.title} ({head.effect.id}){more}"))
    far = f"nearest is {told}, which explains {percent(share)} of it"
    return near.effect.id if near is not None else "", share, max(found)[1] if found else far


def _named(state: State, j: int) -> list[tuple[Candidate, np.ndarray]]:
    """Effects of the catalogue on a joint over their grids, with their columns."""
    name, warm = state.names[j], state.names[j] in state.reference.temperature
    every = [
        candidate
        for effect in state.data.known.catalogue if effect.acts is Acts.JOINT
        for form in effect.forms
        if (warm or "T" not in form.names) and not form.others
        for candidate in over_grid(effect, form, name, j, state.scales[j])
    ]  # fmt: skip
    columns = all_columns_of(state.rows, every)
    return [(c, dense(own, j, len(state.y[j]))) for c, own in zip(every, columns, strict=True)
            if visible(own)]  # fmt: skip


def _nearest(
    torque: np.ndarray, named: Sequence[tuple[Candidate, np.ndarray]]
) -> tuple[Candidate | None, float]:
    """The one whose columns explain most of a torque, and the share."""
    best, share = None, 0.0
    size = float(torque @ torque) or 1.0
    for candidate, columns in sorted(named, key=lambda own: own[1].shape[1]):
        if np.isfinite(columns).all():
            q = np.linalg.lstsq(columns, torque, rcond=1e-9)[0]
            own = 1.0 - float(np.sum((torque - columns @ q) ** 2)) / size
            if own > share + LEAST:
                best, share = candidate, own
    return best, share


def _columns(state: State, candidate: Candidate) -> np.ndarray:
    """(rows_j, k) on its joint."""
    return dense(columns_of(state.rows, candidate), candidate.index, len(state.y[candidate.index]))


def _told_apart(
    proposals: Sequence[Proposal], states: Sequence[State], j: int
) -> tuple[Proposal, ...]:
    """Each with the motion that tells it from the next, the last from the first."""
    if len(proposals) < 2:
        return tuple(proposals)
    torques = [_columns(state, p.finding.pick.candidate) @ p.finding.pick.values
               for p, state in zip(proposals, states, strict=True)
               if p.finding.pick is not None]  # fmt: skip
    rows, joint = states[0].rows, states[0].spec.joints[j]
    motion = rows.filtered(j, [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]])
                               for s in rows.signals])  # fmt: skip
    unit, effort, told = joint.unit, joint.effort_unit, list[Proposal]()
    for k, proposal in enumerate(proposals):
        other = (k + 1) % len(proposals)
        apart = np.abs(torques[k] - torques[other])
        q, v, load = motion[int(np.argmax(apart))]
        pair = ",".join(f"{proposals[i].finding.effect}@{joint.name}" for i in (k, other))
        told.append(dataclasses.replace(
            proposal, apart=f"modeler excite ROBOT.toml --between {pair} --out apart.csv",
            where=f"they differ most, by {apart.max():.3g} {effort}, near q = {q:.3g} {unit}, "
            f"v = {v:.3g} {unit}/s, load = {load:.3g} {effort}",
        ))  # fmt: skip
    return tuple(told)
