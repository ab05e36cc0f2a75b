"""Findings that are no columns: a contact, play in a gear."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.diagnose.bursts import BURST, LOUD, burst_ratio
from modeler.diagnose.contact import Window
from modeler.diagnose.errors import over
from modeler.diagnose.noise import knocking, lasting
from modeler.diagnose.propose import ruled_out
from modeler.diagnose.result import Finding, finite
from modeler.diagnose.search import Search
from modeler.diagnose.state import State

KNOCKS = 0.85
"""Share of a residual's energy in outbursts from which on something knocks."""

BRIEF = 0.2
"""Autocorrelation of a residual below which its outbursts are knocks, and no torque that lasts."""


WEAK = 0.5
"""Gain of a column below which play that is loud without it comes first on its joint."""


def detected(
    found: Search,
    window: Window | None,
    errors: Sequence[np.ndarray],
    findings: Sequence[Finding],
) -> list[Finding]:
    """The findings with contact and play among them.

    Play goes ahead of columns that explain little on its joint: while a gear floats in its gap,
    elasticity describes some of it. And one of its knocks is no contact.

    Args:
        found: of the training logs.
        window: of a contact that was masked.
        errors: (J,) by number of effects put in.
        findings: that are columns.
    """
    contact = [_contact(found, window, errors)] if window is not None else []
    alone = all(f.refines for f in findings)
    play = _play(found, found.end, errors, BURST if alone else LOUD)
    if play:
        loud = _play(found, found.end, errors, LOUD)
        return [*findings, *([] if loud else contact), *play]
    first = _play(found, found.start, errors, LOUD) or _knocks(found, errors)
    if not first or contact:
        return [*findings, *contact]
    own = [f for f in findings if f.joint == first[0].joint]
    if any(f.gain > WEAK and not f.refines for f in own):
        return list(findings)
    rest = [dataclasses.replace(f, refines=True) if f in own else f for f in findings]
    return [*first, *rest] if own or alone else [*rest, *first]


def _contact(found: Search, window: Window, errors: Sequence[np.ndarray]) -> Finding:
    force = window.force if window.force is not None else np.zeros(3)
    names = ("fx", "fy", "fz")
    before, after = (finite(over(found.end, range(len(e)), e)) for e in (errors[0], errors[-1]))
    return Finding(
        "external_force", None, 1.0 - 1.0 / window.ratio, before, after,
        {"t0": window.start, "t1": window.end} | dict(zip(names, map(float, force), strict=True)),
        {}, dict.fromkeys(names, "N"), (),
        f"the residuals of several joints burst from {window.start:.1f} to {window.end:.1f} s, "
        f"{window.ratio:.0f} times the energy of any other moment; these rows are left out of "
        "everything else",
        None, False,
    )  # fmt: skip


def _asked(found: Search) -> list[int]:
    """Joints whose gear may have play."""
    return [
        j for j, joint in enumerate(found.end.data.compiled.spec.joints)
        if joint.actuated and not ruled_out("backlash", joint.name, found.without)
    ]  # fmt: skip


def _play(found: Search, state: State, errors: Sequence[np.ndarray], least: float) -> list[Finding]:
    """Play in a gear, on the joint whose bursts its column describes best."""
    ratios = {j: burst_ratio(state, j) for j in _asked(found)}
    bursting = [j for j, ratio in ratios.items() if ratio > least]
    if not bursting:
        return []
    described = {
        item.candidate.index: item.gain
        for item in found.last.ranked if item.candidate.effect.id == "backlash"
    }  # fmt: skip
    j = max(bursting, key=lambda k: (described.get(k, 0.0), ratios[k]))
    text = (
        f"{ratios[j]:.0f} times the residual energy within 0.1 s after the load changes sign, "
        "while the joint moves on"
    )
    return [_backlash(found, errors, [j, *bursting], 1.0 - 1.0 / ratios[j], text)]


def _knocks(found: Search, errors: Sequence[np.ndarray]) -> list[Finding]:
    """Outbursts that do not last and that nothing else explains: play, or a loose part."""
    state = found.end
    shares = {j: knocking(state, j) for j in _asked(found)}
    loud = [j for j, s in shares.items() if s > KNOCKS and lasting(state, j) < BRIEF]
    if not loud:
        return []
    loud.sort(key=lambda j: -shares[j])
    text = (
        f"{100.0 * shares[loud[0]]:.0f} % of the residual's energy comes in brief outbursts that "
        "no function of the motion predicts"
    )
    doubt = "its outbursts do not follow the sign of the load"
    return [_backlash(found, errors, loud, shares[loud[0]], text, doubt)]


def _backlash(
    found: Search,
    errors: Sequence[np.ndarray],
    bursting: Sequence[int],
    gain: float,
    text: str,
    objection: str = "",
) -> Finding:
    """Play on the first of some joints; any of the others may be the one."""
    names = [joint.name for joint in found.end.data.compiled.spec.joints]
    first = bursting[0]
    others = tuple(("backlash", names[k]) for k in bursting if k != first)
    before, after = float(errors[0][first]), float(errors[-1][first])
    return Finding(
        "backlash", names[first], gain, before, after, {}, {}, {}, others,
        f"joint {names[first]}: {text}", None, False, objection,
    )  # fmt: skip
