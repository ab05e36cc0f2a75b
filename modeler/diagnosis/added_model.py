"""The model with an effect: its robot file, its rows, how sure its values are, notes on it."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.learn import LEARNED, Learned, effect_id, free_name
from modeler.diagnosis.profile import Profile, is_linear, profile
from modeler.diagnosis.ranking import base_of, blocks_of
from modeler.diagnosis.result import Pick
from modeler.diagnosis.score import Residuals, error_changes, no_better
from modeler.diagnosis.sentences import where
from modeler.diagnosis.signals import SignalReference, tilt_axes
from modeler.diagnosis.state import SearchData, State, columns_of, state_of
from modeler.effects import PASSIVE_FRICTION, PASSIVE_FRICTION_IS, Acts, Effect, effect_named
from modeler.estimation import Addition, IdentifiedModel, ParameterEstimate, prior_of, spread_text
from modeler.numerics.least_squares import column_lengths
from modeler.observation import (
    Log,
    Observation,
    Prepared,
    Processing,
    model_torque,
    observed,
    observed_alike,
    prepare,
    shafts,
)
from modeler.robot import (
    robot_from_text,
    with_coupling,
    with_effect,
    with_gravity,
    with_own_effect,
    with_reference,
)
from modeler.runtime import CompiledModel


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
    state = None
    history = list(model.history)
    for i, step in enumerate(history):
        pick = _candidate(model, step)
        if pick is None:
            continue
        state = state or state_of(SearchData(compiled, observation), (), model.beta)
        own = _own_columns(model, state, pick)
        along = profile(state, pick, own) if own else None
        if along is None:
            continue
        model = _widened(model, along, own)
        history[i] = dataclasses.replace(
            step, shape_sigmas=along.shape_deviations(), shape_intervals=along.shape_intervals()
        )
    return dataclasses.replace(model, history=tuple(history))


def catalogue_of(model: IdentifiedModel) -> tuple[Effect, ...]:
    """The effects that there are for its robot."""
    return robot_from_text(model.robot_text, "robot of the model").catalogue


def _candidate(model: IdentifiedModel, step: Addition) -> Candidate | None:
    """The effect of a step, if it has shapes on a joint."""
    effect = effect_named(step.effect, catalogue_of(model))
    if effect is None or effect.acts is not Acts.JOINT or not step.shapes:
        return None
    forms = [f for f in effect.forms if {s.name for s in f.shapes} == set(step.shapes)]
    names = [joint.name for joint in model.spec.joints]
    if not forms or step.joint not in names:
        return None
    return Candidate(effect, forms[0], step.joint, names.index(step.joint), dict(step.shapes))


def _own_columns(model: IdentifiedModel, state: State, pick: Candidate) -> list[int]:
    """Base columns of the effect, in the order of its own; of several ripples, those alike."""
    from scipy.optimize import linear_sum_assignment  # it takes long to load

    found = columns_of(state.rows, pick)[pick.index]
    effect = {p.name: (p.effect, p.joint) for p in model.spec.standard}
    free = [i for i, b in enumerate(model.spec.base) if effect[b.column_of] == pick.key]
    if found is None or len(free) < found.shape[1]:
        return []
    base = state.rows.W[pick.index][:, free]
    alike = (found / column_lengths(found)).T @ (base / column_lengths(base))
    return [free[i] for i in linear_sum_assignment(-np.abs(alike))[1]]


def _widened(model: IdentifiedModel, along: Profile, own: Sequence[int]) -> IdentifiedModel:
    """The model with the spread along the shapes of one effect in its covariance."""
    fit = model.fit
    order = [*(i for i in range(len(fit.parameters)) if i not in own), *own]
    extra = np.zeros(fit.covariance.shape)
    extra[np.ix_(order, order)] = along.extra()
    known = np.array([p.sigma is not None for p in fit.parameters])
    covariance = fit.covariance + np.where(np.outer(known, known), extra, 0.0)
    scale = np.ones(len(order))
    for i, deviation in zip(own, along.deviations(), strict=True):
        if covariance[i, i] > 0.0:
            scale[i] = max(1.0, float(deviation / np.sqrt(covariance[i, i])))
    covariance = covariance * np.outer(scale, scale)
    # the fit has a narrower band, and with it values that differ a little
    moved = fit.beta[own] - along.told.values
    ends = [(float(low), float(high)) for low, high in along.intervals() + moved[:, None]]
    intervals, sigma = dict(zip(own, ends, strict=True)), np.sqrt(np.diag(covariance))
    parameters = tuple(
        dataclasses.replace(p, sigma=float(sigma[i]), interval=intervals.get(i, p.interval))
        if known[i]
        else p
        for i, p in enumerate(fit.parameters)
    )
    better = dataclasses.replace(fit, parameters=parameters, covariance=covariance)
    return dataclasses.replace(model, fit=better)


# The robot file with one effect more.


def described(text: str, pick: Candidate, values: np.ndarray, reference: SignalReference) -> str:
    """The robot file with the effect.

    Args:
        text: as it is.
        pick: effect, joint, shapes.
        values: of its parameters, for effects that change the description itself.
        reference: the model.

    Raises:
        DataError: its coupling cannot be written.
        RobotError: it stands there already.
    """
    effect = pick.effect
    if effect.acts is Acts.GRAVITY:
        return with_gravity(text, _tilted(text, values, reference).tolist())
    assert pick.joint is not None
    if effect.acts is Acts.PASSIVE:
        robot = robot_from_text(text, "robot of the model")
        everyone = [row.name for row in robot.moving if row.actuated]
        for name in PASSIVE_FRICTION_IS if effect.id == PASSIVE_FRICTION else (effect.id,):
            text = with_effect(text, name, pick.joint, {}, everyone)
        return text
    if effect.acts is Acts.MOTOR:
        text = _coupled(text, pick, reference)
    changed = with_effect(text, effect.id, pick.joint, _shapes(pick, reference))
    names = frozenset().union(*(form.names for form in effect.forms))
    depends = effect.acts is Acts.POSITION or not names.isdisjoint({"load", "static", "torque"})
    return with_reference(changed, _referred(reference)) if depends else changed


def _shapes(pick: Candidate, reference: SignalReference) -> dict[str, float]:
    """The shapes of a joint's effect, and where its temperature or time is 0."""
    fixed = {s.name: s.grid[0] for s in pick.form.shapes if len(s.grid) == 1}
    own = {} if pick.effect.acts is Acts.MOTOR else pick.shapes
    shapes = {name: value for name, value in own.items() if fixed.get(name) != value}
    moments = [shape.name for shape in pick.form.shapes if shape.scale == "moment"]
    if moments and _is_first_moment(pick, reference):
        shapes |= dict.fromkeys(moments, 0.0)
    if "T" in pick.form.names and pick.joint is not None:
        shapes["T0"] = reference.temperature[pick.joint]
    if "t" in pick.form.names:
        shapes["t0"] = reference.time
    return shapes


def _is_first_moment(pick: Candidate, reference: SignalReference) -> bool:
    """True if the model has sin(q - q0) on that joint already: gravity of its links."""
    model = reference.compiled
    joints = len(model.spec.joints)
    q, qd, qdd = np.random.default_rng(7).uniform(-2.0, 2.0, (3, 40 * joints, joints))
    signals = np.ones((len(q), len(model.spec.signals))) if model.spec.signals else None
    phi = model.base_regressor(q, qd, qdd, signals).reshape(q.size, -1)
    column = np.zeros(q.shape)
    column[:, pick.index] = np.sin(q[:, pick.index] - pick.shapes["q0"])
    target = column.ravel()
    solved = np.linalg.lstsq(phi, target, rcond=1e-10)[0]
    return bool(np.linalg.norm(phi @ solved - target) < 1e-6 * np.linalg.norm(target))


def _referred(reference: SignalReference) -> dict[str, float]:
    """Standard parameters with the torques of the model: each base parameter in its own column."""
    known = ("rigid_body", "rotor_inertia", "viscous", "coulomb", "offset")
    effects = {p.name: p.effect for p in reference.compiled.spec.standard}
    return {
        base.column_of: float(f"{value:.9g}")
        for base, value in zip(reference.compiled.spec.base, reference.beta, strict=True)
        if effects[base.column_of] in known
    }


def with_law(text: str, state: State, joint: str, learned: Learned) -> tuple[str, Pick]:
    """The robot file with the definition of a law, and the law as an effect to be put in.

    Args:
        text: of the robot file.
        state: in which it was learned.
        joint: name.
        learned: it.
    """
    effects = robot_from_text(text, "robot of the model").own_effects
    name = effect_id(LEARNED, joint, [e.id for e in effects])
    prefix = free_name("Lw", [column.prefix for e in effects for column in e.columns])
    law, j = learned.law, state.names.index(joint)
    definition = {
        "title": f"learned, not physics: a law of {learned.coordinates.told}",
        "columns": {prefix: learned.coordinates.equation},
        "unit": state.spec.joints[j].effort_unit.replace(" ", "*"),
        **learned.coordinates.further,
        "law": {"low": list(law.low), "high": list(law.high), "cells": list(law.cells),
                "values": list(law.values)},
    }  # fmt: skip
    text = with_own_effect(text, name, definition)
    effect = effect_named(name, robot_from_text(text, "robot with a law").catalogue)
    assert effect is not None
    shapes = {shape.name: shape.grid[0] for shape in effect.forms[0].shapes}
    candidate = Candidate(effect, effect.forms[0], joint, j, shapes)
    return text, Pick(candidate, np.array([learned.size]), state, 1.0)


def _tilted(text: str, values: np.ndarray, reference: SignalReference) -> np.ndarray:
    """Gravity with the tilt, of the length it had."""
    robot = robot_from_text(text, "robot of the model")
    symbols = {name: value.number() for name, value in robot.symbols.items()}
    gravity = np.array([entry.number(symbols) for entry in robot.gravity])
    axes = tilt_axes(reference)
    turned = gravity + values[: len(axes)] @ axes
    return turned * (np.linalg.norm(gravity) / np.linalg.norm(turned))


def _coupled(text: str, pick: Candidate, reference: SignalReference) -> str:
    """The file with the motor's coupling, if it has none for that joint."""
    if "c" not in pick.shapes:
        return text
    joints = reference.compiled.spec.joints
    here, before = joints[pick.index].name, joints[pick.index - 1].name
    sign = "+" if pick.shapes["c"] > 0.0 else "-"
    share = abs(pick.shapes["c"])
    times = "" if share == 1.0 else f"{share:g}*"
    try:
        return with_coupling(text, here, f"q{here} {sign} {times}q{before}")
    except RobotError as error:
        raise DataError(f"{pick.effect.id}: {error}") from None


# What the user should know of an effect that was added, beside its error.


def added(model: IdentifiedModel) -> list[str]:
    """Parameters that the step added last put into the model, with their units and shapes."""
    if len(model.history) < 2:
        return []
    last = model.history[-1]
    lines = [
        f"{p.name} = {p.value:.5g}{spread_text(p.value, p.sigma or 0.0, p.interval)} {p.unit}"
        for p in _parameters_of(model, last)
    ]
    if lines and last.shapes:
        units, sigmas, ends = _units(model, last), last.shape_sigmas, last.shape_intervals
        texts = [
            f"{k} = {v:.4g}{spread_text(v, sigmas.get(k, 0.0), ends.get(k))}{units.get(k, '')}"
            for k, v in last.shapes.items()
        ]
        lines.append("with " + ", ".join(texts))
    if last.moved:
        order = sorted(last.moved, key=lambda name: -last.moved[name])
        said = [f"{name} {last.moved[name]:.2g}" for name in order[:_SHOWN]]
        if len(order) > _SHOWN:
            said.append(f"all others less than {last.moved[order[_SHOWN - 1]]:.2g}")
        lines.append(f"moved by it, in their sigmas: {', '.join(said)}")
    return lines


_SHOWN = 8
"""Parameters of which is told by how much they moved."""


def _parameters_of(model: IdentifiedModel, step: Addition) -> list[ParameterEstimate]:
    """Base parameters that are an effect's own."""
    own = {p.name for p in model.spec.standard if (p.effect, p.joint) == (step.effect, step.joint)}
    base = {b.name for b in model.spec.base if b.column_of in own}
    return [p for p in model.fit.parameters if p.name in base]


def not_needed(model: IdentifiedModel, step: Addition) -> bool:
    """True of an effect whose parameters are all below their sigmas, beside all in the model."""
    own = _parameters_of(model, step)
    return bool(own) and all(abs(p.value) <= (p.sigma or 0.0) for p in own)


def _units(model: IdentifiedModel, step: Addition) -> dict[str, str]:
    """What stands behind the values of the shapes."""
    effect = effect_named(step.effect, catalogue_of(model))
    assert effect is not None
    shapes = [shape for form in effect.forms for shape in form.shapes]
    units = {shape.name: shape.unit(is_linear(model.spec, step.joint)) for shape in shapes}
    return {name: f" {unit}" for name, unit in units.items() if unit != "1"}


def notes(model: IdentifiedModel, since: int = -1) -> list[str]:
    """Sentences on steps that were added: which errors fall, and what is not as asked.

    Args:
        model: with its history.
        since: place of the first of them in the history.
    """
    if len(model.history) < 2:
        return []
    catalogue, found = catalogue_of(model), []
    for step in model.history[since:]:
        effect = effect_named(step.effect, catalogue)
        assert effect is not None
        name = f"{effect.id}, {where(step.joint)}"
        usual = effect.forms[0]
        if "T" in usual.names and {shape.name for shape in usual.shapes} != set(step.shapes):
            found.append(
                f"{name}: the logs have no column temperature{step.joint} or temperature, so the "
                "time since their start stands for it; log it to know more"
            )
        found.append(_change(name, step))
    return found


def _change(name: str, step: Addition) -> str:
    if step.falls:
        doubt = f"; it is perhaps missing and no more: {step.doubt}" if step.doubt else ""
        kind = "held-out" if step.held_out else "cross-validated"
        changes = error_changes(step.joints, step.changed)
        return f"{name}: the {kind} error falls: {changes}{doubt}"
    why = no_better(step.joints, step.changed)
    return f"{name}: {why}; `modeler add MODEL undo` takes the effect out again"


# The rows of logs for a robot, also with other effects, and what a model leaves of them.


@dataclass(frozen=True, eq=False)
class Logs:
    """What the model is fitted to, and what it is judged on."""

    fitted: Sequence[Log]
    held_out: Sequence[Log] = ()

    @property
    def sets(self) -> list[Sequence[Log]]:
        """Those that hold logs: the fitted ones first."""
        return [self.fitted, self.held_out] if self.held_out else [self.fitted]


@dataclass(frozen=True, eq=False)
class HoldoutRows:
    """Logs as one robot sees them.

    Attributes:
        logs: they.
        compiled: the robot.
        prepared: filtered and differentiated; those that are held out second, if there are any.
        seen: the observations, in that order.
    """

    logs: Logs
    compiled: CompiledModel
    prepared: tuple[Prepared, ...]
    seen: tuple[Observation, ...]

    @property
    def fitted(self) -> Observation:
        """What a model is fitted to."""
        return self.seen[0]

    def of(self, compiled: CompiledModel) -> "HoldoutRows":
        """The rows of the same robot with other effects; nothing is filtered again."""
        if shafts(compiled) == shafts(self.compiled):
            seen = tuple(observed_alike(compiled, observation) for observation in self.seen)
            return dataclasses.replace(self, compiled=compiled, seen=seen)
        return _rows(compiled, self.logs, self.prepared)


def rows_of(compiled: CompiledModel, logs: Logs, processing: Processing) -> HoldoutRows:
    """The rows of logs.

    Args:
        compiled: the robot.
        logs: read with its manifest.
        processing: that of the model.

    Raises:
        DataError: no usable row.
    """
    prepared = tuple(prepare(compiled.spec, some, processing) for some in logs.sets)
    return _rows(compiled, logs, prepared)


def _rows(compiled: CompiledModel, logs: Logs, prepared: tuple[Prepared, ...]) -> HoldoutRows:
    pairs = zip(logs.sets, prepared, strict=True)
    return HoldoutRows(logs, compiled, prepared, tuple(observed(compiled, *pair) for pair in pairs))


def left_of(model: IdentifiedModel, compiled: CompiledModel, observation: Observation) -> Residuals:
    """What it leaves of logs."""
    left = observation.torque - model_torque(observation, compiled, model.beta)
    return _unseen_of(observation, [left[own, j] for j, own in enumerate(observation.used.T)])


def left_out(
    model: IdentifiedModel, observation: Observation, free: np.ndarray | None = None
) -> Residuals:
    """What it leaves of its own logs, each eighth predicted from a fit to the others.

    Args:
        model: fitted.
        observation: of its logs.
        free: (c, k) the directions of beta that are fitted, beside the model; None: all of it.
    """
    used, blocks, known = observation.used.T, blocks_of(observation), None
    W = [observation.columns[own, j] for j, own in enumerate(used)]
    y = [observation.torque[own, j] for j, own in enumerate(used)]
    sigma = np.array([joint.sigma if joint.sigma > 0.0 else 1.0 for joint in model.fit.joints])
    if free is not None:
        y = [tau - w @ model.beta for w, tau in zip(W, y, strict=True)]
        W = [w @ free for w in W]
    elif (prior := prior_of(model.spec)) is not None:
        weighted = np.concatenate([w / s for w, s in zip(W, sigma, strict=True)])
        known = prior.beside(np.linalg.norm(weighted, axis=0))
    number = [blocks.number[own] for own in used]
    base = base_of(W, y, sigma, number, blocks.fold, prior=known)
    return _unseen_of(observation, [s * e for s, e in zip(sigma, base.left_out, strict=True)])


def _unseen_of(observation: Observation, left: list[np.ndarray]) -> Residuals:
    used = observation.used.T
    return Residuals(
        tuple(joint.name for joint in observation.joints),
        tuple(left),
        tuple(observation.torque[own, j] for j, own in enumerate(used)),
        tuple(observation.time[own] for own in used),
        tuple(observation.run[own] for own in used),
    )
