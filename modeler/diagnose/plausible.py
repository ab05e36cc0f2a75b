"""Do the values of an effect belong to this robot?"""

from collections.abc import Mapping

import numpy as np

from modeler.diagnose.candidates import Candidate
from modeler.diagnose.state import State

LOOSE = 5.0
"""Ratio of the inertia that an elastic joint rings with to that of the model, either way, from
which on it is not this joint that rings."""


def objection(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """Why the values cannot be those of the effect named; empty if they can.

    A joint of stiffness K rings, with its motor held, at f = sqrt(K/J)/(2 pi), J the inertia that
    the model has on its axis: something else that rings (a sloshing load, a soft base) has another
    J (Spong 1987).

    Args:
        state: with the effect.
        pick: it.
        parameters: its parameters and shapes by name, SI.
    """
    if pick.effect.id != "elasticity":
        return ""
    compliance = parameters[pick.parameter_names()[0]]
    q = np.concatenate([s.q[::20] for s in state.rows.signals])
    inertia = state.data.compiled.inertia_matrix(q, state.reference.links)
    own = float(np.median(inertia[:, pick.index, pick.index]))
    rings = 1.0 / max(compliance * (2.0 * np.pi * parameters["f"]) ** 2, 1e-300)
    if own <= 0.0 or max(rings / own, own / rings) < LOOSE:
        return ""
    unit = "kg m2" if state.data.compiled.spec.joints[pick.index].unit == "rad" else "kg"
    return (
        f"what rings has {rings:.3g} {unit} on this axis, and the links have {own:.3g} {unit}: "
        "something else rings"
    )
