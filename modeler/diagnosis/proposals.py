"""Equations proposed for what a diagnosis leaves: as text to paste, with what they are near to."""

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.table import format_percent
from modeler.core.toml_cells import TomlCell, format_toml
from modeler.diagnosis.candidates import Candidate, expand_grid
from modeler.diagnosis.discover import JointSearch, ScoredFormula
from modeler.diagnosis.effect_columns import expand_columns
from modeler.diagnosis.expressions import Formula, count_symbols, derive_parameter_unit
from modeler.diagnosis.judge import (
    ScoredCandidate,
    compare_residuals,
    compute_holdout_residuals,
    make_veto,
)
from modeler.diagnosis.learn import choose_free_name, learn_law, make_effect_id
from modeler.diagnosis.orders import fit_residual_baseline
from modeler.diagnosis.profile import compute_effect_profile, describe_values
from modeler.diagnosis.result import EquationProposal, Finding, FittedCandidate, JointDiscovery
from modeler.diagnosis.score import compute_errors
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


def discover_equations(
    effect_search: Search,
    stated: Sequence[tuple[str, str | None]],
    other: SearchData | None,
    tick: Callable[[], None] = lambda: None,
) -> tuple[JointDiscovery, ...]:
    """Equations for what the effects with names leave, by joint.

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
    other_picks = tuple(p for p in end.picks if p.index != j or not p.is_local or p.key in stated)
    states = [end] + (
        [build_state(end.data, other_picks, end.beta)] if len(other_picks) < len(end.picks) else []
    )
    explanations = [_explain_residual(state, j) for state in states]
    tick()
    searches = [JointSearch(state, j, tick) for state in states]
    searches = [
        search
        for search, (share, _) in zip(searches, explanations, strict=True)
        if share > 0.0 or search.has_significant_product()
    ]
    if not searches:
        why = "nothing to find: neither a learned law nor a product says more than chance of it"
        return JointDiscovery(name, 0.0, "", (), why)
    share, law = max(explanations)
    accepted_formulas = _select_formulas(searches, other)
    proposals = [
        _build_proposal(effect_search, formula, share, k, other)
        for k, formula in enumerate(accepted_formulas)
    ]
    if not proposals:
        why = (
            f"no small expression says what a learned law does ({format_percent(share)} of "
            "what is left)"
        )
        return JointDiscovery(name, share, law, (), why)
    return JointDiscovery(
        name,
        share,
        law,
        _add_discriminating_motions(proposals, [o.state for o in accepted_formulas], j),
    )


def _explain_residual(state: State, j: int) -> tuple[float, str]:
    """Share of the residual of a joint that a law explains, and of what; 0 within chance."""
    law, baseline = learn_law(state, j), fit_residual_baseline(state, j, state.residual[j])
    if law is not None and law.is_significant:
        return law.variance_reduction, law.coordinates.description
    return (
        (baseline.share, "")
        if baseline.is_significant and baseline.share > THRESHOLDS.min_variance_reduction
        else (0.0, "")
    )


@dataclass(frozen=True, eq=False)
class _AcceptedFormula:
    """A formula that was judged well."""

    state: State
    later: State
    item: ScoredFormula
    score: ScoredCandidate


def _select_formulas(
    searches: Sequence[JointSearch], other: SearchData | None
) -> list[_AcceptedFormula]:
    """The best formulas beside all states that pass as effects with names must."""
    every = [(search, item) for search in searches for item in search.find_formulas()]
    for search in searches:  # costs beside one and the same model
        search.count, search.before = max(s.count for s in searches), searches[0].before
    every.sort(key=lambda pair: _compute_total_cost(*pair))
    veto, accepted_formulas, texts = make_veto(other), list[_AcceptedFormula](), set[str]()
    for search, item in every[: THRESHOLDS.max_scored_formulas]:
        state = search.state
        best, later = search.judge_candidate(item.candidate), extend_state(state, item.candidate)
        if best is None or item.formula.text in texts or veto(state, later, best):
            continue
        texts.add(item.formula.text)
        accepted_formulas.append(_AcceptedFormula(state, later, item, best))
        if len(accepted_formulas) == THRESHOLDS.max_proposals:
            break
    return _sort_by_held_out_error(accepted_formulas, other)


def _sort_by_held_out_error(
    formulas: list[_AcceptedFormula], other: SearchData | None
) -> list[_AcceptedFormula]:
    """The least held-out error first; of those that it does not surely beat, the shortest."""
    if len(formulas) < 2:
        return formulas
    left = [compute_holdout_residuals(formula.later, other) for formula in formulas]
    j, state = formulas[0].item.candidate.index, formulas[0].state
    errors = [compute_errors(residuals)[state.joint_names[j]] for residuals in left]
    best = left[int(np.argmin(errors))]

    def compute_sort_key(k: int) -> tuple[bool, float, float]:
        worse = compare_residuals(left[k], best, [j], state).whole.is_reduced
        return worse, errors[k] if worse else formulas[k].item.formula.symbol_count, errors[k]

    return [formulas[k] for k in sorted(range(len(formulas)), key=compute_sort_key)]


def _compute_total_cost(search: JointSearch, item: ScoredFormula) -> float:
    """Nats with the price of the effects of the catalogue beside which the formula stands."""
    named = [
        c.equation.text for p in search.state.picks for c in p.form.columns if p.index == search.j
    ]
    symbols = item.formula.symbol_count + sum(map(count_symbols, named))
    return float(search.compute_cost(item.left, symbols))


def _build_proposal(
    effect_search: Search,
    accepted: _AcceptedFormula,
    share: float,
    rank: int,
    other: SearchData | None,
) -> EquationProposal:
    """An offer with its values, as text, and what it is near to."""
    state, later, item, k = accepted.state, accepted.later, accepted.item, len(accepted.state.picks)
    j, joint, formula = item.candidate.index, item.candidate.joint or "", item.formula
    known = state.data.stated_effects.catalogue
    name = make_effect_id("found", f"{joint}{'abc'[rank]}", {e.id for e in known})
    prefixes = {c.prefix for e in known for form in e.forms for c in form.columns}
    labels = [choose_free_name(f"X{chr(97 + j % 26)}{'abc'[rank]}{x}", prefixes) for x in "abcd"]
    shapes = formula.find_nonlinear_units(state.spec.joints[j].unit == "m")
    units = [
        derive_parameter_unit(state.spec, j, item.candidate, i, shapes)
        for i in range(len(formula.equations))
    ]
    table = formula.build_definition(labels)
    definition = {
        "title": formula.title,
        **table,
        "unit": units[0] if len(set(units)) == 1 else dict(zip(labels, units, strict=False)),
    }
    place = TomlCell("discover", value=definition)
    effect = read_definition(name, place, {}, joints=state.joint_names)
    candidate = dataclasses.replace(item.candidate, effect=effect, form=effect.forms[0])
    left, along, values = (
        later.residual[j] / state.sigma[j],
        compute_effect_profile(later, k),
        later.values[k],
    )
    deviations = accepted.score.deviations * float(np.sqrt(np.mean(left**2)))
    effect_values = describe_values(
        later, candidate, values, deviations if along is None else along.compute_deviations()
    )
    before, after = (compute_holdout_residuals(s, other) for s in (state, later))
    change = compare_residuals(before, after, [j], state).whole
    finding = Finding(
        effect=name,
        joint=joint,
        error_before=change.before,
        error_after=change.after,
        parameters=effect_values.value | dict(candidate.nonlinear_parameters),
        sigmas=effect_values.deviation
        | ({} if along is None else along.compute_nonlinear_deviations()),
        units=dict(zip(effect_values.value, units, strict=True)) | shapes,
        equivalents=(),
        evidence=formula.title,
        closure=None,
        is_refinement=False,
        pick=FittedCandidate(candidate, values, later, accepted.score.visible_share),
    )
    relative, likeness, differs = _describe_nearest(state, formula, candidate, values)
    stated = {
        "joint": joint,
        **{key: float(f"{x:.6g}") for key, x in candidate.nonlinear_parameters.items()},
    }
    candidate_score = dataclasses.replace(accepted.score, candidate=candidate)
    steps = (
        *(s for s in effect_search.steps if s.candidate in state.picks),
        SearchStep(candidate_score, (), state),
    )
    entry = stated if candidate.nonlinear_parameters else joint
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
        final_search=dataclasses.replace(effect_search, steps=steps, end=later),
    )


# The nearest effect with a name, and what tells it from the next.


def _describe_nearest(
    state: State, formula: Formula, candidate: Candidate, values: np.ndarray
) -> tuple[str, float, str]:
    """Id of the nearest effect of the catalogue, how near, and what differs."""
    named = _list_catalogue_columns(state, candidate.index)
    near, share = _find_nearest(_build_joint_columns(state, candidate) @ values, named)
    nearest_text = f"{near.effect.title} ({near.effect.id})" if near is not None else "nothing"
    matches = [(share, f"nearly {nearest_text}")] if share > THRESHOLDS.min_likeness else []
    for term in formula.terms if len(formula.terms) == 1 else ():
        for i, part in enumerate(term):
            rest = Formula(((*term[:i], *term[i + 1 :]),))
            if rest.terms[0]:
                column = _build_joint_columns(
                    state, rest.build_candidate(state.joint_names, candidate.index)
                )
                head, alike = _find_nearest(column[:, 0], named)
                if head is not None and alike > THRESHOLDS.min_likeness:
                    near, more = near or head, f", times {part.effect.title}"
                    matches.append((alike, f"{head.effect.title} ({head.effect.id}){more}"))
    far = f"nearest is {nearest_text}, which explains {format_percent(share)} of it"
    return near.effect.id if near is not None else "", share, max(matches)[1] if matches else far


def _list_catalogue_columns(state: State, j: int) -> list[tuple[Candidate, np.ndarray]]:
    """Effects of the catalogue on a joint over their grids, with their columns."""
    name, warm = state.joint_names[j], state.joint_names[j] in state.reference.temperature
    every = [
        candidate
        for effect in state.data.stated_effects.catalogue
        if effect.acts is EffectTarget.JOINT
        for form in effect.forms
        if (warm or "T" not in form.names) and not form.other_joint_names
        for candidate in expand_grid(effect, form, name, j, state.joint_scales[j])
    ]
    columns = build_all_columns(state.rows, every)
    return [
        (c, expand_columns(effect_columns, j, len(state.y[j])))
        for c, effect_columns in zip(every, columns, strict=True)
        if is_visible(effect_columns)
    ]


def _find_nearest(
    torque: np.ndarray, named: Sequence[tuple[Candidate, np.ndarray]]
) -> tuple[Candidate | None, float]:
    """The one whose columns explain most of a torque, and the share."""
    best, share = None, 0.0
    size = float(torque @ torque) or 1.0
    for candidate, columns in sorted(named, key=lambda explained: explained[1].shape[1]):
        if np.isfinite(columns).all():
            q = np.linalg.lstsq(columns, torque, rcond=1e-9)[0]
            explained = 1.0 - float(np.sum((torque - columns @ q) ** 2)) / size
            if explained > share + THRESHOLDS.min_nearer_share:
                best, share = candidate, explained
    return best, share


def _build_joint_columns(state: State, candidate: Candidate) -> np.ndarray:
    """(rows_j, k) on its joint."""
    return expand_columns(
        build_columns(state.rows, candidate), candidate.index, len(state.y[candidate.index])
    )


def _add_discriminating_motions(
    proposals: Sequence[EquationProposal], states: Sequence[State], j: int
) -> tuple[EquationProposal, ...]:
    """Each with the motion that tells it from the next, the last from the first."""
    if len(proposals) < 2:
        return tuple(proposals)
    torques = [
        _build_joint_columns(state, p.finding.pick.candidate) @ p.finding.pick.values
        for p, state in zip(proposals, states, strict=True)
        if p.finding.pick is not None
    ]
    rows, joint = states[0].rows, states[0].spec.joints[j]
    motion = rows.filter_samples(
        j, [np.column_stack([s.q[:, j], s.v[:, j], s.load[:, j]]) for s in rows.signals]
    )
    unit, effort, results = joint.unit, joint.effort_unit, list[EquationProposal]()
    for k, proposal in enumerate(proposals):
        other = (k + 1) % len(proposals)
        apart = np.abs(torques[k] - torques[other])
        q, v, load = motion[int(np.argmax(apart))]
        pair = ",".join(f"{proposals[i].finding.effect}@{joint.name}" for i in (k, other))
        results.append(
            dataclasses.replace(
                proposal,
                apart=f"modeler excite ROBOT.toml --between {pair} --out apart.csv",
                where=f"they differ most, by {apart.max():.3g} {effort}, near q = {q:.3g} {unit}, "
                f"v = {v:.3g} {unit}/s, load = {load:.3g} {effort}",
            )
        )
    return tuple(results)
