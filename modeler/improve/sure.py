"""How sure a model is whose shapes were fitted too: sigmas and intervals that know of it."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.compiled import CompiledModel
from modeler.effects import Acts, Effect, effect_named
from modeler.fit import Addition, IdentifiedModel
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.profile import Problem, Profile, profile
from modeler.observation import Observation
from modeler.robot import robot_from_text
from modeler.scoring.state import Data, State, columns_of, state_of


def with_shapes(
    model: IdentifiedModel, compiled: CompiledModel, observation: Observation
) -> IdentifiedModel:
    """The model with standard deviations that know that shapes were fitted too.

    Covariance, sigmas of all parameters, intervals of the parameters and shapes of the effects in
    its history. The shapes of one effect are varied at a time.

    Args:
        model: as fitted, with its history.
        compiled: its robot.
        observation: of the logs that it was fitted to, in the band in which shapes are found.
    """
    catalogue = robot_from_text(model.robot_text, "robot of the model").catalogue
    state = None
    history = list(model.history)
    for i, step in enumerate(history):
        pick = _candidate(model, step, catalogue)
        if pick is None:
            continue
        state = state or state_of(Data(compiled, observation), (), model.beta)
        own = _own_columns(model, state, pick)
        along = profile(_problem(state, own, pick), pick) if own else None
        if along is None:
            continue
        model = _widened(model, along, own)
        history[i] = dataclasses.replace(
            step, shape_sigmas=along.shape_deviations(), shape_intervals=along.shape_intervals()
        )
    return dataclasses.replace(model, history=tuple(history))


def _candidate(
    model: IdentifiedModel, step: Addition, catalogue: Sequence[Effect]
) -> Candidate | None:
    """The effect of a step, if it has shapes on a joint."""
    effect = effect_named(step.effect, catalogue) if step.effect else None
    if effect is None or effect.acts is not Acts.JOINT or not step.shapes:
        return None
    forms = [f for f in effect.forms if {s.name for s in f.shapes} == set(step.shapes)]
    names = [joint.name for joint in model.spec.joints]
    if not forms or step.joint not in names:
        return None
    return Candidate(effect, forms[0], step.joint, names.index(step.joint), dict(step.shapes))


def _own_columns(model: IdentifiedModel, state: State, pick: Candidate) -> list[int]:
    """Base columns of the effect, in the order of its own; of several ripples, those alike."""
    found = columns_of(state.rows, pick, state.cache)[pick.index]
    effect = {p.name: (p.effect, p.joint) for p in model.spec.standard}
    free = [i for i, b in enumerate(model.spec.base) if effect[b.column_of] == pick.key]
    if found is None or len(free) < found.shape[1]:
        return []
    base = state.rows.W[pick.index]
    own = []
    for column in found.T:
        best = max(free, key=lambda i: _alike(base[:, i], column))
        own.append(best)
        free.remove(best)
    return own


def _alike(one: np.ndarray, other: np.ndarray) -> float:
    size = float(np.linalg.norm(one) * np.linalg.norm(other))
    return abs(float(one @ other)) / size if size > 0.0 else 0.0


def _problem(state: State, own: Sequence[int], pick: Candidate) -> Problem:
    rows = state.rows
    return Problem(
        rows,
        state.data.observation,
        tuple(np.delete(w, own, axis=1) for w in rows.W),
        rows.y,
        state.base.sigma,
        state.scales[pick.index],
    )


def _widened(model: IdentifiedModel, along: Profile, own: Sequence[int]) -> IdentifiedModel:
    """The model with the spread along the shapes of one effect in its covariance."""
    fit = model.fit
    order = [*(i for i in range(len(fit.parameters)) if i not in own), *own]
    extra = np.zeros(fit.covariance.shape)
    extra[np.ix_(order, order)] = along.extra()
    known = np.array([p.sigma is not None for p in fit.parameters])
    covariance = fit.covariance + np.where(np.outer(known, known), extra, 0.0)
    scale = np.ones(len(order))
    for i, sigma in zip(own, along.deviations(), strict=True):
        if covariance[i, i] > 0.0:
            scale[i] = max(1.0, float(sigma / np.sqrt(covariance[i, i])))
    covariance = covariance * np.outer(scale, scale)
    # the fit has a narrower band, and with it values that differ a little
    moved = fit.beta[own] - along.told.values
    ends = [(float(low), float(high)) for low, high in along.intervals() + moved[:, None]]
    intervals = dict(zip(own, ends, strict=True))
    parameters = tuple(
        p if p.sigma is None else dataclasses.replace(
            p,
            sigma=float(np.sqrt(covariance[i, i])),
            interval=intervals.get(i, p.interval),
        )
        for i, p in enumerate(fit.parameters)
    )  # fmt: skip
    better = dataclasses.replace(fit, parameters=parameters, covariance=covariance)
    return dataclasses.replace(model, fit=better)
