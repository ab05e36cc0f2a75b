"""All candidates of a state: those of the effects' grids, and those that the data suggest."""

import dataclasses
from collections.abc import Sequence, Set

from modeler.diagnosis.candidates import Candidate, list_candidates, list_links
from modeler.diagnosis.orders import list_ripple_candidates
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget


def generate_candidates(
    state: State,
    only: str | None = None,
    without: Sequence[str] = (),
    keys: Set[tuple[str, str | None]] | None = None,
) -> list[Candidate]:
    """What could be missing in this state, without what was put in already.

    Args:
        state: it.
        only: id of the one effect that is asked for.
        without: ids of effects, or id@joint, that the user rules out.
        keys: effects and joints that count; None: all.
    """
    spec = state.spec
    temperature = {joint.name: joint.name in state.reference.temperature for joint in spec.joints}
    changed = state.data.fixed_parameters is not None
    present = set() if changed else {(p.effect, p.joint) for p in spec.standard}
    every = state.data.stated_effects.catalogue
    asked = [e for e in every if (only is None and not e.is_learned) or e.id == only]
    known = dataclasses.replace(state.data.stated_effects, catalogue=asked)

    def is_allowed(effect: str, joint: str | None) -> bool:
        return not is_ruled_out(effect, joint, without)

    results = list_candidates(spec, state.joint_scales, temperature, present, known, is_allowed)
    slowest = find_slowest_ringing(state)
    results = [
        c for c in results if not c.effect.is_oscillator or c.nonlinear_parameters["f"] >= slowest
    ]
    if waving := {effect.id for effect in known.catalogue if effect.orders}:
        waves = None if keys is None else {joint for effect, joint in keys if effect in waving}
        results += list_ripple_candidates(state, is_allowed, waves)
    if changed:
        results += list_load_candidates(state)
    taken = {
        (same, pick.joint)
        for pick in state.picks
        if not pick.effect.several
        for same in (pick.effect.id, *pick.effect.same_as)
    }
    results = [c for c in results if only in (None, c.effect.id) and is_allowed(*c.key)]
    return [c for c in results if c.key not in taken]


def is_ruled_out(effect: str, joint: str | None, without: Sequence[str]) -> bool:
    """True if the user rules out the effect, everywhere or on that joint."""
    return effect in without or f"{effect}@{joint}" in without


def find_slowest_ringing(state: State) -> float:
    """Hz from which on an elastic joint may ring."""
    return THRESHOLDS.min_resonance_ratio * state.data.observation.report.band


def list_load_candidates(state: State) -> list[Candidate]:
    """A body on the last link, or on another: only where the links' parameters are kept."""
    spec = state.spec
    links = list_links(spec)
    carrier = spec.closure.carrier if spec.closure is not None else ""
    last = carrier or links[-1]
    return [
        Candidate(effect, effect.forms[0], None if effect.last_link else link, place, {})
        for effect in state.data.stated_effects.catalogue
        if effect.acts is EffectTarget.LINK
        for place, link in enumerate(links)
        if effect.last_link is (link == last)
    ]
