"""The model with an effect: its robot file, its rows, uncertainties of its values, notes on it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler import regression
from modeler.core.errors import DataError, RobotError
from modeler.core.table import format_percent
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.learn import LEARNED, LearnedLaw, choose_free_name, make_effect_id
from modeler.diagnosis.messages import format_location
from modeler.diagnosis.profile import Profile, compute_profile, is_prismatic
from modeler.diagnosis.ranking import build_gram_blocks, build_time_blocks
from modeler.diagnosis.result import FittedCandidate
from modeler.diagnosis.scoring import Residuals, explain_no_improvement, format_error_changes
from modeler.diagnosis.signals import SignalReference, compute_tilt_axes
from modeler.diagnosis.state import SearchData, State, build_columns, build_state
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import PASSIVE_FRICTION, PASSIVE_FRICTION_IS, Effect, EffectTarget, find_effect
from modeler.estimation import (
    Addition,
    IdentifiedModel,
    ParameterEstimate,
    build_prior,
    format_spread,
)
from modeler.numerics.least_squares import compute_column_norms, compute_joint_whitening
from modeler.robot import (
    insert_coupling,
    insert_effect,
    insert_own_effect,
    parse_robot_text,
    replace_gravity,
    replace_reference,
)
from modeler.runtime import CompiledModel


def add_nonlinear_uncertainty(
    model: IdentifiedModel, compiled: CompiledModel, observation: regression.Observation
) -> IdentifiedModel:
    """Adds the uncertainty of fitted nonlinear parameters to all standard deviations.

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
        pick = _rebuild_candidate(model, step)
        if pick is None:
            continue
        state = state or build_state(SearchData(compiled, observation), (), model.beta)
        effect_columns = _find_effect_columns(model, state, pick)
        along = compute_profile(state, pick, effect_columns) if effect_columns else None
        if along is None:
            continue
        model = _widen_covariance(model, along, effect_columns)
        sigmas, ends = along.compute_nonlinear_deviations(), along.compute_nonlinear_intervals()
        history[i] = replace(step, nonlinear_sigmas=sigmas, nonlinear_intervals=ends)
    return replace(model, history=tuple(history))


def read_catalogue(model: IdentifiedModel) -> tuple[Effect, ...]:
    """Reads the effects that exist for its robot."""
    return parse_robot_text(model.robot_text, "robot of the model").catalogue


def _rebuild_candidate(model: IdentifiedModel, step: Addition) -> Candidate | None:
    """The effect of a step, if it has shapes on a joint."""
    effect = find_effect(step.effect, read_catalogue(model))
    if effect is None or effect.acts is not EffectTarget.JOINT or not step.nonlinear_parameters:
        return None
    named = set(step.nonlinear_parameters)
    forms = [f for f in effect.forms if {s.name for s in f.nonlinear_parameters} == named]
    names = [joint.name for joint in model.spec.joints]
    if not forms or step.joint not in names:
        return None
    return Candidate(
        effect, forms[0], step.joint, names.index(step.joint), dict(step.nonlinear_parameters)
    )


def _find_effect_columns(model: IdentifiedModel, state: State, pick: Candidate) -> list[int]:
    """Base columns of the effect, in the order of its own; of several ripples, those alike."""
    from scipy.optimize import linear_sum_assignment  # it takes long to load

    joint_columns = build_columns(state.rows, pick)[pick.index]
    effect = {p.name: (p.effect, p.joint) for p in model.spec.standard}
    free = [i for i, b in enumerate(model.spec.base) if effect[b.column_of] == pick.key]
    if joint_columns is None or len(free) < joint_columns.shape[1]:
        return []
    base = state.rows.W[pick.index][:, free]
    left, right = (x / compute_column_norms(x) for x in (joint_columns, base))
    alike = left.T @ right
    return [free[i] for i in linear_sum_assignment(-np.abs(alike))[1]]


def _widen_covariance(
    model: IdentifiedModel, along: Profile, effect_columns: Sequence[int]
) -> IdentifiedModel:
    """The model with the spread along the shapes of one effect in its covariance."""
    fit = model.fit
    order = [*(i for i in range(len(fit.parameters)) if i not in effect_columns), *effect_columns]
    extra = np.zeros(fit.covariance.shape)
    extra[np.ix_(order, order)] = along.compute_extra_covariance()
    known = np.array([p.sigma is not None for p in fit.parameters])
    covariance = fit.covariance + np.where(np.outer(known, known), extra, 0.0)
    scale = np.ones(len(order))
    for i, deviation in zip(effect_columns, along.compute_deviations(), strict=True):
        if covariance[i, i] > 0.0:
            scale[i] = max(1.0, float(deviation / np.sqrt(covariance[i, i])))
    covariance = covariance * np.outer(scale, scale)
    # the fit has a narrower band, and with it values that differ a little
    values, sigma = along.reported_point.values, np.sqrt(np.diag(covariance))
    wider = np.maximum(1.0, sigma[effect_columns] / along.compute_deviations())[:, None]
    reach = wider * (along.compute_intervals() - values[:, None])
    ends = [(float(low), float(high)) for low, high in fit.beta[effect_columns, None] + reach]
    intervals = dict(zip(effect_columns, ends, strict=True))
    parameters = tuple(
        replace(p, sigma=float(sigma[i]), interval=intervals.get(i, p.interval)) if known[i] else p
        for i, p in enumerate(fit.parameters)
    )
    return replace(model, fit=replace(fit, parameters=parameters, covariance=covariance))


# The robot file with one effect more.


def insert_candidate(
    text: str, pick: Candidate, values: np.ndarray, reference: SignalReference
) -> str:
    """Inserts the effect into the robot file.

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
    if effect.acts is EffectTarget.GRAVITY:
        return replace_gravity(text, _tilt_gravity(text, values, reference).tolist())
    assert pick.joint is not None
    if effect.acts is EffectTarget.PASSIVE:
        robot = parse_robot_text(text, "robot of the model")
        everyone = [row.name for row in robot.moving_joints if row.actuated]
        for name in PASSIVE_FRICTION_IS if effect.id == PASSIVE_FRICTION else (effect.id,):
            text = insert_effect(text, name, pick.joint, {}, everyone)
        return text
    if effect.acts is EffectTarget.MOTOR:
        text = _insert_coupling(text, pick, reference)
    parameters = _collect_nonlinear_parameters(pick, reference)
    if pick.elastic is not None:
        having = {(p.effect, p.joint) for p in reference.compiled.spec.standard}
        if ("rotor_inertia", pick.joint) not in having:
            text = insert_effect(text, "rotor_inertia", pick.joint, {})
        return insert_effect(text, effect.id, pick.joint, parameters)
    changed = insert_effect(text, effect.id, pick.joint, parameters)
    depends = any(form.names & {"load", "static", "torque"} for form in effect.forms)
    depends = depends or effect.acts is EffectTarget.POSITION
    return replace_reference(changed, _build_reference(reference)) if depends else changed


def _collect_nonlinear_parameters(pick: Candidate, reference: SignalReference) -> dict[str, float]:
    """The shapes of a joint's effect, and where its temperature or time is 0."""
    fixed = {s.name: s.grid[0] for s in pick.form.nonlinear_parameters if len(s.grid) == 1}
    candidate_values = {} if pick.effect.acts is EffectTarget.MOTOR else pick.nonlinear_parameters
    shapes = {name: value for name, value in candidate_values.items() if fixed.get(name) != value}
    moments = [shape.name for shape in pick.form.nonlinear_parameters if shape.scale == "moment"]
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
    column[:, pick.index] = np.sin(q[:, pick.index] - pick.nonlinear_parameters["q0"])
    target = column.ravel()
    solved = np.linalg.lstsq(phi, target, rcond=1e-10)[0]
    return bool(np.linalg.norm(phi @ solved - target) < 1e-6 * np.linalg.norm(target))


def _build_reference(reference: SignalReference) -> dict[str, float]:
    """Standard parameters with the torques of the model: each base parameter in its own column."""
    known = ("rigid_body", "rotor_inertia", "viscous", "coulomb", "offset")
    effects = {p.name: p.effect for p in reference.compiled.spec.standard}
    pairs = zip((b.column_of for b in reference.compiled.spec.base), reference.beta, strict=True)
    return {name: float(f"{value:.9g}") for name, value in pairs if effects[name] in known}


def insert_law(
    text: str, state: State, joint: str, learned: LearnedLaw
) -> tuple[str, FittedCandidate]:
    """Inserts a law into the robot file; returns the text, and the law as a fitted candidate.

    Args:
        text: of the robot file.
        state: in which it was learned.
        joint: name.
        learned: it.
    """
    effects = parse_robot_text(text, "robot of the model").own_effects
    name = make_effect_id(LEARNED, joint, [e.id for e in effects])
    prefix = choose_free_name("Lw", [column.prefix for e in effects for column in e.columns])
    law, j = learned.law, state.joint_names.index(joint)
    definition = {
        "title": f"learned, not physics: a law of {learned.coordinates.description}",
        "columns": {prefix: learned.coordinates.equation},
        "unit": state.spec.joints[j].effort_unit.replace(" ", "*"),
        **learned.coordinates.further,
        "law": {name: list(getattr(law, name)) for name in ("low", "high", "cells", "values")},
    }
    text = insert_own_effect(text, name, definition)
    effect = find_effect(name, parse_robot_text(text, "robot with a law").catalogue)
    assert effect is not None
    shapes = {shape.name: shape.grid[0] for shape in effect.forms[0].nonlinear_parameters}
    candidate = Candidate(effect, effect.forms[0], joint, j, shapes)
    return text, FittedCandidate(candidate, np.array([learned.size]), state, 1.0)


def _tilt_gravity(text: str, values: np.ndarray, reference: SignalReference) -> np.ndarray:
    """Gravity with the tilt, of the length it had."""
    robot = parse_robot_text(text, "robot of the model")
    symbols = {name: value.evaluate() for name, value in robot.symbols.items()}
    gravity = np.array([entry.evaluate(symbols) for entry in robot.gravity])
    axes = compute_tilt_axes(reference)
    turned = gravity + values[: len(axes)] @ axes
    return turned * (np.linalg.norm(gravity) / np.linalg.norm(turned))


def _insert_coupling(text: str, pick: Candidate, reference: SignalReference) -> str:
    """The file with the motor's coupling, if it has none for that joint."""
    if "c" not in pick.nonlinear_parameters:
        return text
    joints = reference.compiled.spec.joints
    here, before = joints[pick.index].name, joints[pick.index - 1].name
    sign = "+" if pick.nonlinear_parameters["c"] > 0.0 else "-"
    share = abs(pick.nonlinear_parameters["c"])
    times = "" if share == 1.0 else f"{share:g}*"
    try:
        return insert_coupling(text, here, f"q{here} {sign} {times}q{before}")
    except RobotError as error:
        raise DataError(f"{pick.effect.id}: {error}") from None


# What the user should know of an effect that was added, beside its error.


def describe_last_addition(model: IdentifiedModel) -> list[str]:
    """Describes the parameters that the last step added, with units."""
    if len(model.history) < 2:
        return []
    last = model.history[-1]
    lines = [
        f"{p.name} = {p.value:.5g}{format_spread(p.value, p.sigma or 0.0, p.interval)}"
        + f" {p.unit}" * (p.unit != "1")
        for p in _find_parameters(model, last)
    ]
    fitted = {p.name for p in model.fit.elastic}
    shapes = {f"{name}{last.joint}" for name in last.nonlinear_parameters}
    if lines and last.nonlinear_parameters and not shapes <= fitted:
        units, sigmas = _format_nonlinear_units(model, last), last.nonlinear_sigmas
        ends = last.nonlinear_intervals
        texts = [
            f"{k} = {v:.4g}{format_spread(v, sigmas.get(k, 0.0), ends.get(k))}{units.get(k, '')}"
            for k, v in last.nonlinear_parameters.items()
        ]
        lines.append("with " + ", ".join(texts))
    if last.shifts_in_sigmas:
        order = sorted(last.shifts_in_sigmas, key=lambda name: -last.shifts_in_sigmas[name])
        count = THRESHOLDS.max_listed_shifts
        shifts = [f"{name} {last.shifts_in_sigmas[name]:.2g}" for name in order[:count]]
        if len(order) > count:
            shifts.append(f"all others less than {last.shifts_in_sigmas[order[count - 1]]:.2g}")
        lines.append(f"shifts of other parameters, in standard deviations: {', '.join(shifts)}")
    return lines


def _find_parameters(model: IdentifiedModel, step: Addition) -> list[ParameterEstimate]:
    """Base parameters that are an effect's own."""
    key = step.effect, step.joint
    standard_names = {p.name for p in model.spec.standard if (p.effect, p.joint) == key}
    base = {b.name for b in model.spec.base if b.column_of in standard_names}
    if step.nonlinear_parameters.keys() == {"K", "D"}:  # an elastic joint has no column
        base |= {f"{name}{step.joint}" for name in step.nonlinear_parameters}
    return [p for p in (*model.fit.parameters, *model.fit.elastic) if p.name in base]


def is_unneeded(model: IdentifiedModel, step: Addition) -> bool:
    """Returns whether all parameters of an effect are below their standard deviations."""
    estimates = _find_parameters(model, step)
    return bool(estimates) and all(abs(p.value) <= (p.sigma or 0.0) for p in estimates)


def _format_nonlinear_units(model: IdentifiedModel, step: Addition) -> dict[str, str]:
    """What stands behind the values of the shapes."""
    effect, linear = find_effect(step.effect, read_catalogue(model)), step.joint
    assert effect is not None
    shapes = [shape for form in effect.forms for shape in form.nonlinear_parameters]
    units = {shape.name: shape.get_unit(is_prismatic(model.spec, linear)) for shape in shapes}
    return {name: f" {unit}" for name, unit in units.items() if unit != "1"}


def describe_additions(model: IdentifiedModel, since: int = -1) -> list[str]:
    """Describes added steps: which errors fall, and what differs from the request.

    Args:
        model: with its history.
        since: place of the first of them in the history.
    """
    if len(model.history) < 2:
        return []
    catalogue, lines = read_catalogue(model), []
    for step in model.history[since:]:
        effect = find_effect(step.effect, catalogue)
        assert effect is not None
        name = f"{effect.id}, {format_location(step.joint)}"
        usual = effect.forms[0]
        shapes = {shape.name for shape in usual.nonlinear_parameters}
        if "T" in usual.names and shapes != set(step.nonlinear_parameters):
            lines.append(
                f"{name}: the logs have no column temperature{step.joint} or temperature, so the "
                "time since their start stands for it; log it to know more"
            )
        lines += [*step.left_out, _describe_error_change(name, step)]
    return lines


def _describe_error_change(name: str, step: Addition) -> str:
    if step.left_out and not step.changed_joints:
        errors = ", ".join(f"joint {j} {format_percent(e)}" for j, (_, e) in step.joints.items())
        return f"{name}: error of the rest: {errors}; the fit is not significantly better there"
    if step.is_improvement:
        doubt = f"; the evidence that it is missing is weak: {step.warning}" if step.warning else ""
        kind = "held-out" if step.held_out_logs else "cross-validated"
        changes = format_error_changes(step.joints, step.changed_joints)
        return f"{name}: the {kind} error falls: {changes}{doubt}"
    why = explain_no_improvement(step.joints, step.changed_joints)
    return f"{name}: {why}; `modeler add MODEL undo` takes the effect out again"


# The rows of logs for a robot, also with other effects, and what a model leaves of them.


@dataclass(frozen=True, eq=False)
class LogSplit:
    """What the model is fitted to, and what it is judged on."""

    training: Sequence[regression.Log]
    held_out: Sequence[regression.Log] = ()

    @property
    def log_sets(self) -> list[Sequence[regression.Log]]:
        """Returns the sets that hold logs: the training logs first."""
        return [self.training, self.held_out] if self.held_out else [self.training]


@dataclass(frozen=True, eq=False)
class LogRows:
    """Logs as one robot sees them.

    Attributes:
        logs: they.
        compiled: the robot.
        prepared: filtered and differentiated; those that are held out second, if there are any.
        observations: the observations, in that order.
    """

    logs: LogSplit
    compiled: CompiledModel
    prepared: tuple[regression.PreparedLogs, ...]
    observations: tuple[regression.Observation, ...]

    @property
    def fit_observation(self) -> regression.Observation:
        """Returns the observation that a model is fitted to."""
        return self.observations[0]

    def rebuild_for(self, compiled: CompiledModel) -> "LogRows":
        """Returns the rows of the same robot with other effects; nothing is filtered again."""
        same = compiled.spec.signals == self.compiled.spec.signals  # and so are unknown states
        if same and regression.find_shafts(compiled) == regression.find_shafts(self.compiled):
            seen = tuple(regression.rebuild_observation(compiled, x) for x in self.observations)
            return replace(self, compiled=compiled, observations=seen)
        return _observe_rows(compiled, self.logs, self.prepared)

    def restrict_to(self, other: "LogRows") -> "LogRows":
        """Returns the rows that count in others of the same logs too."""
        pairs = zip(self.observations, other.observations, strict=True)
        return replace(self, observations=tuple(x.select_rows(x.used & y.used) for x, y in pairs))


def build_rows(
    compiled: CompiledModel, logs: LogSplit, processing: regression.Processing
) -> LogRows:
    """Builds the rows of logs.

    Args:
        compiled: the robot.
        logs: read with its manifest.
        processing: that of the model.

    Raises:
        DataError: no usable row.
    """
    spec, sets = compiled.spec, logs.log_sets
    prepared = tuple(regression.prepare_logs(spec, some, processing) for some in sets)
    return _observe_rows(compiled, logs, prepared)


def _observe_rows(
    compiled: CompiledModel, logs: LogSplit, prepared: tuple[regression.PreparedLogs, ...]
) -> LogRows:
    pairs = zip(logs.log_sets, prepared, strict=True)
    observations = tuple(regression.build_observation(compiled, *pair) for pair in pairs)
    return LogRows(logs, compiled, prepared, observations)


def compute_residuals(
    model: IdentifiedModel, compiled: CompiledModel, observation: regression.Observation
) -> Residuals:
    """Computes the residuals of the model on logs."""
    left = observation.torque - regression.compute_model_torque(observation, compiled, model.beta)
    parts = [left[used, j] for j, used in enumerate(observation.used.T)]
    return _build_residuals(observation, parts)


def cross_validate_residuals(
    model: IdentifiedModel, observation: regression.Observation, free: np.ndarray | None = None
) -> Residuals:
    """Computes cross-validated residuals: each eighth predicted from a fit to the others.

    Args:
        model: fitted.
        observation: of its logs.
        free: (c, k) the directions of beta that are fitted, beside the model; None: all of it.
    """
    used, blocks = observation.used.T, build_time_blocks(observation)
    W = [observation.columns[used_rows, j] for j, used_rows in enumerate(used)]
    y = [observation.torque[used_rows, j] for j, used_rows in enumerate(used)]
    sigma = np.array([joint.sigma if joint.sigma > 0.0 else 1.0 for joint in model.fit.joints])
    if free is not None:
        y = [tau - w @ model.beta for w, tau in zip(W, y, strict=True)]
        W = [w @ free for w in W]
    known = np.zeros((0, W[0].shape[1] + 1))
    if free is None and (prior := build_prior(model.spec)) is not None:
        weighted = np.concatenate([w / s for w, s in zip(W, sigma, strict=True)])
        known = prior.extend_rows(np.linalg.norm(weighted, axis=0))
    number = [blocks.number[used_rows] for used_rows in used]
    whitener = compute_joint_whitening([*W, known[:, :-1]], np.append(sigma, 1.0))
    weights = sigma, number, blocks.fold, whitener, known
    base = build_gram_blocks(lambda values: [w @ values for w in W], y, *weights)
    parts = [s * e for s, e in zip(sigma, base.out_of_fold, strict=True)]
    return _build_residuals(observation, parts)


def _build_residuals(observation: regression.Observation, left: list[np.ndarray]) -> Residuals:
    used, names = observation.used.T, tuple(joint.name for joint in observation.joints)
    torque = tuple(observation.torque[rows, j] for j, rows in enumerate(used))
    time, run = (tuple(of[rows] for rows in used) for of in (observation.time, observation.run))
    return Residuals(names, tuple(left), torque, time, run)
