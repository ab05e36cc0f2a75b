"""All candidates of a state: those of the effects' grids, and those that the data suggest."""

import dataclasses
from collections.abc import Sequence, Set

import numpy as np

from modeler.diagnose.candidates import Candidate, candidates
from modeler.diagnose.orders import ripple_candidates
from modeler.diagnose.state import State
from modeler.effects import RIPPLES, effect_named

_WAVES = (*RIPPLES, "encoder_eccentricity")


def proposals(
    state: State, only: str | None = None, without: Sequence[str] = (),
    keys: Set[tuple[str, str | None]] | None = None,
) -> list[Candidate]:  # fmt: skip
    """What could be missing in this state, without what was put in already.

    Args:
        state: it.
        only: id of the one effect that is asked for.
        without: ids of effects, or id@joint, that the user rules out.
        keys: effects and joints that count; None: all.
    """
    spec = state.data.compiled.spec
    temperature = {joint.name: joint.name in state.reference.temperature for joint in spec.joints}
    changed = state.data.kept is not None
    present = set() if changed else {(p.effect, p.joint) for p in spec.standard}
    known = state.data.known
    if only is not None:
        asked = [e for e in known.catalogue if e.id == only]
        known = dataclasses.replace(known, catalogue=asked)

    def allowed(effect: str, joint: str | None) -> bool:
        return not ruled_out(effect, joint, without)

    found = candidates(spec, state.scales, temperature, present, known, allowed)
    found = [c for c in found if _lasts(state, c)]
    if only is None or only in _WAVES:
        waves = None if keys is None else {joint for effect, joint in keys if effect in _WAVES}
        found += ripple_candidates(state, allowed, waves)
    if changed:
        found += load_candidates(state)
    taken = {
        (same, pick.joint) for pick in state.picks if pick.effect.id not in RIPPLES
        for same in (pick.effect.id, *pick.effect.same_as)
    }  # fmt: skip
    return [
        c for c in found
        if c.key not in taken and only in (None, c.effect.id) and allowed(*c.key)
    ]  # fmt: skip


def ruled_out(effect: str, joint: str | None, without: Sequence[str]) -> bool:
    """True if the user rules out the effect, everywhere or on that joint."""
    return effect in without or f"{effect}@{joint}" in without


def _lasts(state: State, candidate: Candidate) -> bool:
    """False for a warm-up much faster or slower than the logs can show."""
    if candidate.effect.id != "temperature_friction" or "tau" not in candidate.shapes:
        return True
    span = float(np.ptp(state.data.observation.time))
    return 0.1 * span <= candidate.shapes["tau"] <= 3.0 * span


def load_candidates(state: State) -> list[Candidate]:
    """A body on the last link, or on another: only where the links' parameters are kept."""
    spec = state.data.compiled.spec
    links = list(dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"))
    carrier = spec.closure.carrier if spec.closure is not None else ""
    last = carrier or links[-1]
    found = []
    for place, link in enumerate(links):
        effect = effect_named("payload" if link == last else "link_inertia")
        assert effect is not None
        joint = None if link == last else link
        found.append(Candidate(effect, effect.forms[0], joint, place, {}))
    return found
