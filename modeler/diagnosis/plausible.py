"""Do the values of an effect belong to this robot?"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from modeler.core.table import format_percent
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import expand_columns, list_body_parameters
from modeler.diagnosis.judge import PLAIN
from modeler.diagnosis.profile import ProfileProblem, find_effect_columns
from modeler.diagnosis.state import State, build_all_columns, build_columns, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Requirement
from modeler.estimation import define_body, project_parameters

# Friction brakes: does that of a model with an effect, on the motion seen and where it has faded?
#
# The friction of a joint takes energy: its torque times the speed is not negative, at any speed,
# load and temperature of the logs (what turns gradually, as bristles do, gives back a little
# after a reversal and is left out). What reads more than the motion of its joint may be absent:
# friction that grows with the load, or fades as the joint warms up, adds to that of the unloaded
# or warm joint, which brakes too. An effect with values that make friction drive describes
# something else.


DRIVES = "with it the friction of its joint would drive instead of brake"
"""Why such an effect is refused."""

FADES = frozenset({"t", "load", "static"})
"""What may be absent while a joint moves: time since the start, load."""


def is_friction_driving(before: State, after: State, pick: Candidate) -> bool:
    """True if friction drives with the effect by more than the model leaves, and not without it.

    Args:
        before: the state without the effect.
        after: with it, as the last that was put in.
        pick: the effect.
    """
    if pick.effect.family != "friction" or not pick.is_local:
        return False
    j = pick.index
    if not has_friction(after, j):
        return False  # a model without friction says nothing of the whole
    left = float(np.sqrt(np.mean(after.residual[j] ** 2)))
    braking_picks = _list_friction_picks(after, j)
    worst = _compute_driving_torque(after, j, braking_picks)
    if pick.form.names & FADES:
        worst = max(worst, _compute_driving_torque(after, j, braking_picks[:-1]))
    return worst > max(left, _compute_driving_torque(before, j, _list_friction_picks(before, j)))


def has_friction(state: State, j: int) -> bool:
    """True if the model has friction of joint j alone."""
    return bool(_find_friction_columns(state, j))


def _list_friction_picks(state: State, j: int) -> list[int]:
    """Places of the picks that are friction of that joint without memory."""
    return [
        k
        for k, pick in enumerate(state.picks)
        if pick.effect.family == "friction"
        and pick.is_local
        and pick.form.internal_state is None
        and pick.index == j
    ]


def compute_largest_friction(state: State, j: int) -> float:
    """The largest friction torque of joint j on its rows, but for one in fifty, N m or N."""
    torque = np.abs(_compute_friction(state, j, _list_friction_picks(state, j)))
    return float(np.quantile(torque, 0.98)) if torque.size else 0.0


def is_torque_computed(state: State) -> bool:
    """True if no joint rubs: the torques were computed from the motion.

    By medians over the joints of Coulomb and viscous friction; those that the model lacks are
    fitted beside it.
    """
    present = {(p.effect, p.joint) for p in state.spec.standard}
    plain = [e for e in state.data.stated_effects.catalogue if e.id in PLAIN]
    moved = [j for j, joint in enumerate(state.spec.joints) if joint.actuated and state.y[j].size]
    picks = [
        Candidate(effect, effect.forms[0], name, j)
        for j in moved
        for effect in plain
        if (effect.id, name := state.joint_names[j]) not in present
    ]
    shown = [p for p in picks if is_visible(build_columns(state.rows, p))]
    full = build_state(state.data, [*state.picks, *shown], state.beta)
    sizes = [
        [
            np.linalg.norm(x)
            for x in (
                _compute_friction(full, j, _list_friction_picks(full, j)),
                y,
                full.residual[j],
            )
        ]
        for j in moved
        if (y := state.y[j]).any() and (has_friction(full, j) or _list_friction_picks(full, j))
    ]
    if not sizes:  # friction in loops is no column of one joint alone
        return False
    friction, torque, left = np.maximum(np.array(sizes).T, 1e-300)
    return bool(
        np.median(friction / torque) < THRESHOLDS.min_friction_share
        and np.median(friction / left) < THRESHOLDS.min_friction_residual_ratio
    )


def _compute_driving_torque(state: State, j: int, picks: Sequence[int]) -> float:
    """Rms of the friction torque of joint j where it drives, N m or N; with some of the picks."""
    direction = np.sign(state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals]))
    return float(
        np.sqrt(np.mean(np.minimum(0.0, _compute_friction(state, j, picks) * direction) ** 2))
    )


def _find_friction_columns(state: State, j: int) -> list[int]:
    """Base columns of the friction of joint j alone."""
    base = state.spec.base
    return [i for i, b in enumerate(base) if b.kind == "friction" and b.rows == (j,)]


def _compute_friction(state: State, j: int, picks: Sequence[int]) -> np.ndarray:
    """(rows_j,) friction torque of joint j, N m or N: of the model and some of the picks."""
    base_columns = _find_friction_columns(state, j)
    torque = state.rows.W[j][:, base_columns] @ state.beta[base_columns]
    for k in picks:
        columns = state.extra[k][j]
        assert columns is not None, "it acts on its joint"
        torque = torque + columns @ state.values[k]
    return torque


def find_caveat(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """Why the values cannot be those of the effect named; empty if they can.

    A joint of stiffness K rings, with its motor held, at f = sqrt(K/J)/(2 pi), J the inertia that
    the model has on its axis: something else that rings (a sloshing load, a soft base) has another
    J (Spong 1987). And where no gravity turns a joint, nothing balances it; nor is a lever seen
    where a straight line describes its torque as well.

    Args:
        state: with the effect.
        pick: it.
        parameters: its parameters and shapes by name, SI.
    """
    doubts = (_CHECKS[need](state, pick, parameters) for need in pick.effect.needs)
    return next((doubt for doubt in doubts if doubt), "")


def _check_friction_size(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A part of the friction that is larger than all of it."""
    part, unit = (
        parameters[pick.list_parameter_names()[0]],
        "N m" if _is_revolute(state, pick) else "N",
    )
    whole = compute_largest_friction(state, pick.index)
    if part <= THRESHOLDS.max_friction_part * whole:
        return ""
    return f"all friction of its joint is {whole:.3g} {unit}, and this part of it {part:.3g} {unit}"


def _is_revolute(state: State, pick: Candidate) -> bool:
    return state.spec.joints[pick.index].unit == "rad"


def _check_rest_position(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """Far from its rest a spring is a constant torque, unless the model has one already."""
    having = {(p.effect, p.joint) for p in state.spec.standard}
    scale = state.joint_scales[pick.index]
    if ("offset", pick.joint) in having or abs(
        pick.nonlinear_parameters["q0"] - scale.middle
    ) < 0.5 * scale.range:
        return ""
    return f"its rest lies outside of all that joint {pick.joint} moves over: a constant torque"


def _check_body(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """What a body that can be built explains, over what these parameters do."""
    mass = parameters.get("mass", 0.0)
    if mass < 0.0:
        return f"no body has a mass of {mass:.3g} kg"
    # a root of the information on its parameters, beside all else
    weighted = list(zip(state.rows.W, state.sigma, strict=True))
    columns = build_columns(state.rows, pick)
    weighted_columns = np.vstack(
        [expand_columns(columns, j, len(w)) / s for j, (w, s) in enumerate(weighted)]
    )
    others = np.vstack([w[:, state.data.free_columns] / s for w, s in weighted])
    left = (
        weighted_columns - others @ np.linalg.lstsq(others, weighted_columns, rcond=None)[0]
        if others.size
        else weighted_columns
    )
    root = np.asarray(np.linalg.qr(left, mode="r"))
    body_specs = list_body_parameters(pick, state.rows.signals[0])
    values = np.array([parameters[name] for name in list(parameters)[: len(body_specs)]])
    nearest = project_parameters(define_body(body_specs), values, root)
    if nearest is None or nearest.distance < THRESHOLDS.max_body_misfit * float(
        np.linalg.norm(root @ values)
    ):
        return ""
    return "no body has these inertial parameters: its pseudo-inertia would be negative"


def _check_gain(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A torque of the other sign, or off by that much, is no matter of its torque constant."""
    eps = parameters[pick.list_parameter_names()[0]]
    if 1.0 / THRESHOLDS.max_gain_factor < 1.0 - eps < THRESHOLDS.max_gain_factor:
        return ""
    true = f"{1.0 / (1.0 - eps):.2g} times" if eps != 1.0 else "infinitely many times"
    return f"the true gain would be {true} the given one: check sign and unit of that torque"


def _check_tilt(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A base that stands askew turns gravity, and changes it by no more than that."""
    change, (column,) = float(np.linalg.norm(list(parameters.values()))), pick.form.columns
    if change <= column.largest:
        return ""
    return (
        f"gravity would change by {change:.3g} {column.unit_revolute}, and a tilted base turns it"
    )


EITHER = "describes it as well"
"""Ends the objection to a filter that these data do not tell from a delay."""


def _check_lag(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A torque that is only late, or of which a part alone is filtered.

    1 + lag (1/(tau s + 1) - 1) is a first-order filter for lag = 1, and for lag = 2 the Pade
    approximation of a delay of 2 tau.
    """
    problem = ProfileProblem(state, pick, find_effect_columns(state, state.picks.index(pick)))
    share, tau = parameters[pick.list_parameter_names()[0]], parameters["tau"]

    def minimise_squares(lag: float) -> tuple[float, float]:
        every = share * tau / lag * np.geomspace(0.5, 2.0, 25)
        picks = (
            (dataclasses.replace(pick, nonlinear_parameters={"tau": float(x)}), x) for x in every
        )
        return min(
            (problem.compute_squares(lagged_pick, np.array([lag])), float(x))
            for lagged_pick, x in picks
        )

    (filtered, _), (late, half) = minimise_squares(1.0), minimise_squares(2.0)
    if late < THRESHOLDS.max_equal_residual_ratio * filtered:
        how = (
            EITHER
            if filtered < THRESHOLDS.max_equal_residual_ratio * late
            else "describes it better"
        )
        return f"a pure delay of {2e3 * half:.2g} ms {how}"
    if filtered > THRESHOLDS.max_equal_residual_ratio * problem.compute_squares(
        pick, np.array([share])
    ):
        return (
            f"a filter that only {format_percent(share)} of the torque passes describes it better"
        )
    return ""


def find_gravity_confounders(start: State, candidates: Sequence[Candidate]) -> list[str]:
    """Joints on which the links' own gravity imitates what balances it, most of it at any shape.

    Of most shapes, less than a tenth of the torque is left beside inertias that are free.

    Args:
        start: the model as given.
        candidates: of such an effect.
    """
    joints = []
    for joint in dict.fromkeys(c.joint for c in candidates):
        joint_candidates = [c for c in candidates if c.joint == joint]
        columns = [c for c in build_all_columns(start.rows, joint_candidates) if is_visible(c)]
        if joint is None or not columns or _check_gravity_load(start, joint_candidates[0], {}):
            continue
        if (
            float(np.median(start.rank_columns(columns).visible_shares))
            < THRESHOLDS.min_balance_share
        ):
            joints.append(joint)
    return joints


def _check_gravity_load(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A lever with a spring is built where gravity turns a joint."""
    weight = np.concatenate([s.static[::20, pick.index] for s in state.rows.signals])
    torque = state.rows.y[pick.index]
    if np.mean(weight**2) > THRESHOLDS.min_gravity_share**2 * np.mean(torque**2):
        return ""
    return f"gravity does not turn joint {pick.joint}, so no spring balances it"


def _check_lever(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """What the residual covers of its torque beside a straight line over the stroke is not seen.

    With link data that is `GATE` of its variance: no free inertia bends so.
    """
    j = pick.index
    column = build_columns(state.rows, pick)[j]
    assert column is not None, "it acts on its own joint"
    torque = column @ [parameters[name] for name in pick.list_parameter_names()]
    line = np.vander(state.rows.filter_samples(j, [s.q[:, j] for s in state.rows.signals]), 2)
    nonlinear_part = torque - line @ np.linalg.lstsq(line, torque, rcond=None)[0]
    least = (
        THRESHOLDS.min_variance_reduction
        if state.data.prior and state.data.prior.has_bodies
        else 1.0
    )
    if np.mean(nonlinear_part**2) > least * np.mean(state.residual[j] ** 2):
        return ""
    return "over this stroke its torque is a straight line in q: another spring gives it too"


def _check_oscillator(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    compliance = parameters[pick.list_parameter_names()[0]]
    q = np.concatenate([s.q[::20] for s in state.rows.signals])
    inertia = state.data.compiled.inertia_matrix(q, state.reference.link_parameters)
    link_inertia = float(np.median(inertia[:, pick.index, pick.index]))
    rings = 1.0 / max(compliance * (2.0 * np.pi * parameters["f"]) ** 2, 1e-300)
    if (
        link_inertia <= 0.0
        or max(rings / link_inertia, link_inertia / rings) < THRESHOLDS.max_inertia_ratio
    ):
        return ""
    unit = "kg m2" if _is_revolute(state, pick) else "kg"
    return (
        f"what rings has {rings:.3g} {unit} on this axis, and the links have {link_inertia:.3g} "
        f"{unit}: "
        "something else rings"
    )


_CHECKS: Mapping[Requirement, Callable[[State, Candidate, Mapping[str, float]], str]] = {
    Requirement.GRAVITY: _check_gravity_load,
    Requirement.CURVE: _check_lever,
    Requirement.REST: _check_rest_position,
    Requirement.MASS: _check_body,
    Requirement.INERTIA: _check_oscillator,
    Requirement.GAIN: _check_gain,
    Requirement.LAG: _check_lag,
    Requirement.TILT: _check_tilt,
    Requirement.FRICTION: _check_friction_size,
}
"""A sentence where the robot is not so; empty where it is."""
