"""Proposals of laws: the search joint by joint, and the nearest effect that has a name."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler.core.table import format_percent
from modeler.core.toml_cells import TomlCell, format_toml
from modeler.diagnosis import scoring
from modeler.diagnosis.candidates import Candidate, expand_grid, to_dense
from modeler.diagnosis.equations import JointSearch, ScoredFormula
from modeler.diagnosis.expressions import Formula, count_symbols, derive_parameter_unit
from modeler.diagnosis.generation import fit_residual_baseline
from modeler.diagnosis.learn import choose_free_name, learn_law, make_effect_id
from modeler.diagnosis.profile import estimate_effect
from modeler.diagnosis.result import EquationProposal, Finding, FittedCandidate, JointDiscovery, Key
from modeler.diagnosis.search import Search, SearchStep, Tick, extend_state
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


def discover_equations(
    search: Search, stated: Sequence[Key], other: SearchData | None, tick: Tick = lambda: None
) -> tuple[JointDiscovery, ...]:
    """Proposes equations, by joint, for what the named effects leave.

    On a joint where these are no more than a description, formulas are tried in their place too.

    Args:
        search: what a diagnosis named.
        stated: effects and joints that stay, whatever an equation says.
        other: held-out logs.
        tick: called whenever something is done.
    """
    every = []
    for j, joint in enumerate(search.spec.joints):
        if joint.actuated and len(search.end.y[j]):
            every.append(_search_joint(search, j, stated, other, tick))
    return tuple(every)


def _search_joint(
    search: Search, j: int, stated: Sequence[Key], other: SearchData | None, tick: Tick
) -> JointDiscovery:
    end, name = search.end, search.end.joint_names[j]
    states = [end]
    picks = [p for p in end.picks if p.index != j or not p.is_local or p.key in stated]
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
    every = enumerate(accepted)
    proposals = [_build_proposal(search, item, share, k, other) for k, item in every]
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
    """The least held-out error first; of those not significantly worse, the shortest."""
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
    search: Search, accepted: _AcceptedFormula, share: float, rank: int, other: SearchData | None
) -> EquationProposal:
    """A proposal with its values, as text, and the effect that it is near to."""
    state, later, item = accepted.state, accepted.later, accepted.item
    formula = item.formula
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
    candidate = replace(item.candidate, effect=effect, form=effect.forms[0])
    values = later.values[k]
    rms = float(np.sqrt(np.mean((later.residual[j] / state.sigma[j]) ** 2)))
    estimate = estimate_effect(later, k, candidate, values, accepted.score.deviations * rms)
    before, after = (scoring.compute_holdout_residuals(s, other) for s in (state, later))
    change = scoring.compare_residuals(before, after, [j], state).whole
    numbers = change.before, change.after, estimate.parameters, estimate.sigmas
    all_units = dict(zip(estimate.units, units, strict=False)) | shapes
    pick = FittedCandidate(candidate, values, later, accepted.score.visible_share)
    finding = Finding(name, joint, *numbers, all_units, (), formula.title, None, False, pick=pick)
    relative, likeness, differs = _describe_nearest(state, formula, candidate, values)
    rounded = {key: float(f"{x:.6g}") for key, x in candidate.nonlinear_parameters.items()}
    entry = {"joint": joint, **rounded} if rounded else joint
    steps = [s for s in search.steps if s.candidate in state.picks]
    steps.append(SearchStep(replace(accepted.score, candidate=candidate), (), state))
    return EquationProposal(
        finding=finding,
        definition=definition,
        equation=" + ".join(f"{c.prefix}{joint} {c.equation.text}" for c in effect.columns),
        effects_line=f"{name} = {format_toml([entry])}",
        explained_share=min(1.0, accepted.score.variance_reduction / share) if share else math.nan,
        symbols=formula.symbol_count,
        replaced_effects=tuple(p.effect.id for p in search.end.picks if p not in state.picks),
        nearest_effect=relative,
        similarity=likeness,
        difference=differs,
        final_search=replace(search, steps=tuple(steps), end=later),
    )


# The nearest effect with a name, and what distinguishes it from the next.


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
    local = [e for e in state.data.stated_effects.catalogue if e.acts is EffectTarget.JOINT]
    forms = [(e, form) for e in local for form in e.forms if not form.other_joint_names]
    forms = [(e, form) for e, form in forms if not lacking & form.names]
    every = [c for pair in forms for c in expand_grid(*pair, name, j, scale)]
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
    """Each with the motion that distinguishes it from the next, the last from the first."""
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
        results.append(
            replace(proposal, discriminating_command=command, discriminating_state=where)
        )
    return tuple(results)
