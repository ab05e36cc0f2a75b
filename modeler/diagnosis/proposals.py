"""Equations proposed for what a diagnosis leaves: as text to paste, with what they are near to."""

import dataclasses
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.table import percent
from modeler.core.toml_cells import Place
from modeler.diagnosis.candidates import Candidate, over_grid
from modeler.diagnosis.discover import JointSearch, Scored
from modeler.diagnosis.effect_columns import dense
from modeler.diagnosis.expressions import Formula
from modeler.diagnosis.judge import (
    GATE,
    Judged,
    compared,
    decide,
    holdout_residuals,
    judged_at,
    vetoing,
)
from modeler.diagnosis.learn import learn
from modeler.diagnosis.orders import rival
from modeler.diagnosis.profile import profile_of, shape_units, values_of
from modeler.diagnosis.result import Discovery, Finding, Pick, Proposal
from modeler.diagnosis.search import Search, Step, extended
from modeler.diagnosis.state import SearchData, State, all_columns_of, columns_of, state_of
from modeler.effects import Acts, read_definition

MOST = 3
"""Equations offered on a joint."""

ALMOST = 0.98
"""Share of a column that another explains from which on they are nearly the same."""

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
    share, law = 0.0, ""
    for state in states:
        learned = learn(state, j)
        said = rival(state, j, state.residual[j])
        tick()
        own = max(learned.gain if learned is not None and learned.significant else 0.0,
                  said.share if said.sure and said.share > GATE else 0.0)  # fmt: skip
        if own == 0.0:
            states.remove(state)
        elif own > share:
            share = own
            law = learned.coordinates.told if learned is not None and own == learned.gain else ""
    if not states:
        why = "nothing to find: a learned law says nothing of what is left beyond chance"
        return Discovery(name, 0.0, "", (), why)
    offered = _offered(states, j, other, tick)
    proposals = [
        _proposal(found, offered[k], share, k, other) for k in range(len(offered))
    ]  # fmt: skip
    if not proposals:
        why = f"no small expression says what a learned law does ({percent(share)} of what is left)"
        return Discovery(name, share, law, (), why)
    return Discovery(name, share, law, _told_apart(proposals, [o.state for o in offered], j))


@dataclass(frozen=True, eq=False)
class _Offered:
    """A formula that was judged well."""

    state: State
    later: State
    item: Scored
    judged: Judged


def _offered(
    states: Sequence[State], j: int, other: SearchData | None, tick: Callable[[], None]
) -> list[_Offered]:
    """The best formulas of all states that pass as effects with names must."""
    searches = [JointSearch(state, j, tick) for state in states]
    every = [(search, item) for search in searches for item in search.found()]
    count = max(search.count for search in searches)
    for search in searches:
        search.count = count
    ranked = sorted(every, key=lambda pair: _whole_cost(*pair, searches[0]))
    veto, kept = vetoing(other), list[_Offered]()
    for search, item in ranked[:_JUDGED]:
        state = search.state
        columns = columns_of(state.rows, item.candidate)
        best = decide(state, judged_at(state, [(item.candidate, columns)])).best
        later = extended(state, item.candidate)
        if best is not None and not veto(state, later, best):
            kept.append(_Offered(state, later, item, best))
        if len(kept) == MOST:
            break
    return kept


def _whole_cost(search: JointSearch, item: Scored, first: JointSearch) -> float:
    """Nats beside the model without effects of the catalogue that the formula replaces."""
    texts = [c.equation.text for p in search.state.picks for c in p.form.columns
             if p.index == search.j]  # fmt: skip
    named = sum(len(re.findall(r"\w+", text)) + 1 for text in texts)
    return float(first.cost(item.left, item.formula.symbols + named))


def _proposal(found: Search, own: _Offered, share: float, rank: int,
              other: SearchData | None) -> Proposal:  # fmt: skip
    state, later, item = own.state, own.later, own.item
    j, k, joint = item.candidate.index, len(state.picks), item.candidate.joint or ""
    taken = {e.id for e in state.data.known.catalogue}
    stem = f"found_{re.sub(r'[^a-z0-9]', '_', joint.lower())}"
    name = next(
        n for n in (f"{stem}{'abc'[rank]}{mark}" for mark in ("", *"defghij")) if n not in taken
    )
    prefixes = {c.prefix for e in state.data.known.catalogue for f in e.forms for c in f.columns}
    mark = next(x for x in "XYZUHNB" if not any(
        p.startswith(f"{x}{chr(97 + j)}{'abc'[rank]}") for p in prefixes))  # fmt: skip
    formula = item.formula
    labels = [f"{mark}{chr(97 + j)}{'abc'[rank]}{letter}" for letter in "abcd"]
    definition = {"title": formula.title, **formula.definition(labels)}
    effect = read_definition(name, Place("discover", value=definition), {}, joints=state.names)
    candidate = dataclasses.replace(item.candidate, effect=effect, form=effect.forms[0])
    deviations = own.judged.deviations * float(np.sqrt(np.mean(
        (later.residual[j] / state.sigma[j]) ** 2)))  # fmt: skip
    along = profile_of(later, k)
    if along is not None:
        deviations = along.deviations()
    values = later.values[k]
    named = values_of(later, candidate, values, deviations)
    before, after = (holdout_residuals(s, other) for s in (state, later))
    change = compared(before, after, [j], state).whole
    units = {**named.unit, **shape_units(later, candidate)}
    finding = Finding(
        effect=name, joint=joint, error_before=change.before, error_after=change.after,
        parameters=named.value | dict(candidate.shapes),
        sigmas=named.deviation | ({} if along is None else along.shape_deviations()),
        units=units, ties=(), evidence=formula.title, closure=None, refines=False,
        pick=Pick(candidate, values, later, own.judged.visible),
    )  # fmt: skip
    relative, likeness, differs = _relative(state, item.formula, candidate, values)
    gone = [p.effect.id for p in found.end.picks if p not in state.picks]
    equation = " + ".join(f"{c.prefix}{joint} {c.equation.text}" for c in effect.columns)
    shapes = ", ".join([f'joint = "{joint}"', *(f"{key} = {float(f'{value:.6g}')!r}"
                                                for key, value in candidate.shapes.items())])  # fmt: skip
    line = f"{name} = [{{{shapes}}}]" if candidate.shapes else f'{name} = ["{joint}"]'
    step = Step(own.judged, (), state)
    drawn = dataclasses.replace(found, start=state, steps=(step,), end=later)
    return Proposal(
        finding=finding, definition=definition, equation=equation, effects_line=line,
        explained=min(1.0, own.judged.gain / share), symbols=formula.symbols,
        instead=tuple(gone), relative=relative, likeness=likeness, differs=differs, drawn=drawn,
    )  # fmt: skip


# The nearest effect with a name, and what tells it from the next.


def _relative(
    state: State, formula: Formula, candidate: Candidate, values: np.ndarray
) -> tuple[str, float, str]:
    """Id of the nearest effect of the catalogue, how near, and what differs."""
    torque = _columns(state, candidate) @ values
    named = _named(state, candidate.index)
    near, share = _nearest(torque, named)
    best = (share, near, "") if near is not None else (0.0, None, "")
    told = f"{best[1].effect.title} ({best[1].effect.id})" if best[1] is not None else ""
    if best[1] is None or share > ALMOST:
        said = f"nearly {told}" if told else "nothing in the catalogue is near"
        return (best[1].effect.id if best[1] is not None else ""), share, said
    factors: tuple[float, str] = (ALMOST, "")
    for term in formula.terms if len(formula.terms) == 1 else ():
        for i, part in enumerate(term):
            rest = Formula(((*term[:i], *term[i + 1 :]),), formula.effort)
            if rest.terms[0]:
                column = _columns(state, rest.candidate(state.names, candidate.index))
                head, alike = _nearest(column[:, 0], named)
                if head is not None and alike > factors[0]:
                    factors = (
                        alike,
                        f"{head.effect.title} ({head.effect.id}), times {part.factor.words}",
                    )
    if factors[1]:
        return best[1].effect.id, share, factors[1]
    return best[1].effect.id, share, f"nearest is {told}, which explains {percent(share)} of it"


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
    return [(c, dense(own, j, len(state.y[j]))) for c, own in zip(every, columns, strict=True)]


def _nearest(
    torque: np.ndarray, named: Sequence[tuple[Candidate, np.ndarray]]
) -> tuple[Candidate | None, float]:
    """The one whose columns explain most of a torque, and the share."""
    best, share = None, 0.0
    size = float(torque @ torque) or 1.0
    for candidate, columns in named:
        if np.isfinite(columns).all():
            q = np.linalg.lstsq(columns, torque, rcond=1e-9)[0]
            own = 1.0 - float(np.sum((torque - columns @ q) ** 2)) / size
            if own > share + 1e-9:
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
    torques = []
    for proposal, state in zip(proposals, states, strict=True):
        pick = proposal.finding.pick
        assert pick is not None
        torques.append(_columns(state, pick.candidate) @ pick.values)
    rows, joint = states[0].rows, states[0].spec.joints[j]
    state = rows.filtered(j, [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]])
                              for s in rows.signals])  # fmt: skip
    told = []
    for k, proposal in enumerate(proposals):
        other = (k + 1) % len(proposals)
        apart = np.abs(torques[k] - torques[other])
        at, unit = state[int(np.argmax(apart))], joint.unit
        names = [f"{proposals[i].finding.effect}@{joint.name}" for i in (k, other)]
        told.append(dataclasses.replace(
            proposal,
            apart=f"modeler excite ROBOT.toml --between {','.join(names)} --out apart.csv",
            where=f"they differ most, by {apart.max():.3g} {joint.effort_unit}, near q = {at[0]:.3g} "
            f"{unit}, v = {at[1]:.3g} {unit}/s, load = {at[2]:.3g} {joint.effort_unit}",
        ))  # fmt: skip
    return tuple(told)
