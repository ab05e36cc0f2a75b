"""The parameters of an effect that was found: names, values, deviations, units."""

from dataclasses import dataclass

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import body_parameters
from modeler.diagnosis.profile import Profile, ProfileProblem, profile
from modeler.diagnosis.signals import tilt_basis
from modeler.diagnosis.state import State
from modeler.effects.effect import Acts


@dataclass(frozen=True)
class EffectValues:
    """By name of the parameter: value, its standard deviation, unit; SI."""

    value: dict[str, float]
    deviation: dict[str, float]
    unit: dict[str, str]


def values_of(
    state: State, pick: Candidate, values: np.ndarray, deviations: np.ndarray
) -> EffectValues:
    """What people read of an effect.

    A body on a link has its mass and the inertial parameters that the robot feels; a tilted base
    the change of gravity in frame 0, m/s^2.

    Args:
        state: with the effect.
        pick: it.
        values: of its columns.
        deviations: theirs.
    """
    if pick.effect.acts is Acts.GRAVITY:
        return _tilt(state, values, deviations)
    units = _units(state, pick)
    return EffectValues(
        dict(zip(units, map(float, values), strict=True)),
        dict(zip(units, map(float, deviations), strict=False)),
        units,
    )


def profile_of(state: State, place: int) -> Profile | None:
    """The likelihood along the shapes of an effect that was put in.

    Args:
        state: with the effect.
        place: of it among the effects of the state.
    """
    sizes = [len(values) for values in state.values]
    first = state.W[0].shape[1] - sum(sizes[place:])
    own = slice(first, first + sizes[place])
    pick = state.picks[place]
    problem = ProfileProblem(
        state.rows,
        state.data.observation,
        tuple(np.delete(w, own, axis=1) for w in state.W),
        state.y,
        state.sigma,
        state.scales[pick.scaled],
    )
    return profile(problem, pick)


def named_intervals(along: Profile, named: EffectValues) -> dict[str, tuple[float, float]]:
    """95 % intervals of the parameters and shapes of an effect, by name."""
    own = zip(named.value, along.intervals(), strict=False)
    found = {name: (float(low), float(high)) for name, (low, high) in own}
    return found | along.shape_intervals()


def _units(state: State, pick: Candidate) -> dict[str, str]:
    """Names of the parameters, in the order of the columns, and their units."""
    if pick.effect.acts is Acts.LINK:
        felt = body_parameters(pick, state.rows.signals[0])
        names = [p.name.removesuffix(p.joint) for p in felt]
        return {
            "mass" if name == "M" else name: p.unit for name, p in zip(names, felt, strict=True)
        }
    linear = _linear(state, pick)
    return {
        name: column.unit_prismatic if linear else column.unit_revolute
        for name, column in zip(pick.parameter_names(), pick.form.columns, strict=True)
    }


def _linear(state: State, pick: Candidate) -> bool:
    """True on a prismatic joint."""
    joints = state.spec.joints
    return any(joint.name == pick.joint and joint.unit == "m" for joint in joints)


def shape_units(state: State, pick: Candidate) -> dict[str, str]:
    """Units of the shapes, by name."""
    return {shape.name: shape.unit(_linear(state, pick)) for shape in pick.form.shapes}


def _tilt(state: State, values: np.ndarray, deviations: np.ndarray) -> EffectValues:
    basis = tilt_basis(state.reference)
    assert basis is not None
    axes = np.array([axis for axis, _ in basis[:2]])
    change = values[:2] @ axes
    spread = np.sqrt(deviations[:2] ** 2 @ axes**2)
    names = ("gx", "gy", "gz")
    return EffectValues(
        dict(zip(names, map(float, change), strict=True)),
        dict(zip(names, map(float, spread), strict=True)),
        dict.fromkeys(names, "m/s^2"),
    )
