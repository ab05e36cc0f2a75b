"""An elastic joint as a candidate: its windup is fitted with the model, and is one column then."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from modeler.diagnosis.candidates import Candidate, ElasticFit, describe_motion, to_dense
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.estimation import WindupProblem, read_windup


def fit_elastic_joint(state: State, candidate: Candidate) -> Candidate | None:
    """Fits K and D of a joint, with those of the elastic joints of the state; None if that fails.

    Args:
        state: without the candidate.
        candidate: an elastic joint, with any parameters.
    """
    form = next((form for form in candidate.effect.forms if form.is_windup), None)
    if form is None:
        return None
    known = [pick.elastic.windup for pick in state.picks if pick.elastic is not None]
    others = max(known, key=lambda windup: len(windup.joints), default=None)
    start = others or read_windup(state.data.compiled, state.beta)
    problem = build_windup_problem(state)
    fitted = problem.fit(start.add_joint(candidate.index), [candidate.index])
    if fitted is None:
        return None
    place = fitted.joints.index(candidate.index)
    frequency, ratio = (float(x[place]) for x in fitted.compute_resonances(problem.motions))
    bounds = {s.name: s.limits for s in candidate.effect.forms[0].nonlinear_parameters}
    low, high = bounds["f"]
    slowest = THRESHOLDS.min_resonance_ratio * state.data.observation.report.band
    rings = max(low, slowest) < frequency < high and bounds["zeta"][0] < ratio < bounds["zeta"][1]
    spread = float(np.sqrt(fitted.spread[place, place]))
    certain = spread < THRESHOLDS.max_stiffness_spread
    has_rotor = not fitted.lacks_rotor[place] or fitted.rotors[place] > 0.0
    values = {"K": float(fitted.stiffness[place]), "D": float(fitted.damping[place])}
    elastic = ElasticFit(fitted, others, bool(rings and certain and has_rotor))
    return replace(candidate, form=form, nonlinear_parameters=values, elastic=elastic)


def build_windup_problem(state: State) -> WindupProblem:
    """Builds the rows of a state, to which an elastic joint is fitted with all else."""
    rows, plain = state.rows, [k for k, pick in enumerate(state.picks) if pick.elastic is None]
    first = len(state.data.free_columns)
    sizes = [len(values) for values in state.values]
    ends = first + np.cumsum([0, *sizes])
    every = [np.arange(first), *(np.arange(ends[k], ends[k + 1]) for k in plain)]
    columns = [
        np.hstack([np.zeros((len(y), 0)), *(to_dense(state.extra[k], j, len(y)) for k in plain)])
        for j, y in enumerate(state.y)
    ]

    def filter_rows(values: Sequence[np.ndarray]) -> list[np.ndarray]:
        joints = range(rows.joint_count)
        return [rows.filter_samples(j, [v[:, j] for v in values]) for j in joints]

    return WindupProblem(
        [describe_motion(s) for s in rows.signals],
        filter_rows,
        state.rows.y,
        state.data.block_numbers,
        state.data.free_columns,
        columns,
        state.prior[:, [*np.concatenate(every), -1]],
    )


def describe_elastic_joint(
    picks: Sequence[Candidate], pick: Candidate
) -> tuple[dict[str, float], dict[str, float]]:
    """Returns K and D of an elastic joint beside all effects that were put in, and their sigmas.

    Args:
        picks: all of them.
        pick: the elastic joint.
    """
    windups = [p.elastic.windup for p in picks if p.elastic is not None]
    with_it = [windup for windup in windups if pick.index in windup.joints]
    windup = max(with_it, key=lambda windup: len(windup.joints))
    k, E = windup.joints.index(pick.index), len(windup.joints)
    values = {"K": float(windup.stiffness[k]), "D": float(windup.damping[k])}
    spread = np.sqrt(np.diag(windup.spread))[[k, E + k]].tolist()
    return values, {name: values[name] * s for name, s in zip(values, spread, strict=True)}
