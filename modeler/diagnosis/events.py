"""Findings that occur only once or in bursts: pushes, backlash."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler import regression
from modeler.core.table import format_error_pair, format_percent
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.generation import compute_burst_share, is_ruled_out
from modeler.diagnosis.result import Finding, PushWindow
from modeler.diagnosis.scoring import (
    Residuals,
    Score,
    ScoredCandidate,
    compare_residuals,
    compute_residuals,
)
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import SearchData, State, build_state
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget

_LENGTHS = range(2, 31)  # cells of a window; one of the longest is no push


@dataclass(frozen=True, eq=False)
class _WindowEnergies:
    """All windows of some lengths within the logs.

    Attributes:
        run: (windows,) index of the log.
        start, end: (windows,) s.
        energy: (windows,) of a steady torque, in units of each joint's median residual.
    """

    run: np.ndarray
    start: np.ndarray
    end: np.ndarray
    energy: np.ndarray


def detect_pushes(
    end: State, data: SearchData, other: SearchData | None
) -> tuple[PushWindow | None, PushWindow | None]:
    """Detects when something pushed in logs, and in held-out ones.

    With its first part left out of the fit, more of it may show.

    Args:
        end: fitted to the logs.
        data: they.
        other: held-out logs.
    """

    def fit(rest: SearchData) -> State:
        return build_state(rest, end.picks, end.beta)

    # a gear may have so much play that one of its impacts looks like a push
    most, joints = THRESHOLDS.min_burst_ratio, range(end.rows.joint_count)
    rattles = any(compute_burst_ratio(end, j) > most for j in joints)
    window = None if rattles else _find_whole_push(end, data, fit)
    if other is None:
        return window, None
    state = end if window is None else fit(leave_out(data, window))
    held_out = _find_whole_push(state, other, lambda rest: state)
    held_out = held_out if held_out is not None and held_out.change is not None else None
    if window is not None and held_out is not None:
        window = replace(window, held_out_push=held_out.describe(other.observation.logs))
    return window, held_out


def _find_whole_push(
    state: State, data: SearchData, refit: Callable[[SearchData], State]
) -> PushWindow | None:
    window = more = find_contact_window(compute_residuals(state, data))
    if window is None:
        return None
    while more is not None:
        window, rest = more, leave_out(data, more)
        state = refit(rest)
        later = find_contact_window(compute_residuals(state, rest))
        more = window.merge_part(later) if later is not None else None
    return fit_push_torque(window, state, data)


def leave_out(
    data: SearchData, window: PushWindow | None, candidates: Iterable[Candidate] = ()
) -> SearchData:
    """Returns the data without the rows of a push, and a little around it.

    Also without those in which the state of bristles and cables is unknown yet.
    """
    observation, used = data.observation, data.observation.used.copy()
    if window is not None:
        start, end = window.span
        hit = (observation.time > start) & (observation.time < end)
        used[hit & (observation.run == window.log)] = False
    ends = np.cumsum([len(part.used) for part in observation.stretches])[:-1]
    for candidate in candidates:
        j, loop = candidate.index, candidate.loop
        by_part = zip(np.split(used, ends), np.split(observation.time, ends), strict=True)
        for part, (rows, time) in zip(observation.stretches, by_part, strict=True):
            q = part.segment.q[:, j]
            count = regression.count_unsettled_samples(q, *loop)
            rows[time < part.segment.time[min(count, len(q) - 1)], j] = False
    return replace(data, observation=observation.select_rows(used))


def find_contact_window(left: Residuals) -> PushWindow | None:
    """Finds the window in which a steady torque stands out in residuals; None if none does.

    A push gives joint j a mean residual m_j over the n_j rows of its window, of energy
    sum_j n_j m_j^2 / s_j^2 (s_j the joint's median residual): largest over the very window of the
    push. What acts more than once, as friction or a wrong model do, is as large elsewhere.
    """
    windows = _enumerate_windows(left)
    if windows is None:
        return None
    top = int(np.argmax(windows.energy))
    run, start, end = int(windows.run[top]), float(windows.start[top]), float(windows.end[top])
    same = windows.run == run
    apart = THRESHOLDS.push_separation
    near = same & (windows.end > start - apart) & (windows.start < end + apart)
    elsewhere = max(float(windows.energy[~near].max(initial=0.0)), 1e-300)
    ratio = float(windows.energy[top]) / elsewhere
    if ratio < THRESHOLDS.min_push_ratio or near.all():
        return None
    adjoining = same & (windows.energy > THRESHOLDS.min_adjoining_ratio * elsewhere)
    longest = _LENGTHS[-1] * THRESHOLDS.push_cell
    whole = _extend_window(windows, adjoining, start, end)
    if whole[1] - whole[0] < longest:  # else the fit that it spoils leaves much around it
        start, end = whole
    began = float(windows.start[same].min())
    if start - began < THRESHOLDS.settling_time or end - start >= longest:
        return None
    return PushWindow(run, start, end, ratio)


def _extend_window(
    windows: _WindowEnergies, loud: np.ndarray, start: float, end: float
) -> tuple[float, float]:
    """The push with what adjoins it: as the robot moves, the torque of a push changes its sign."""
    while True:
        after = loud & (np.abs(windows.start - end) < THRESHOLDS.max_push_gap)
        before = loud & (np.abs(windows.end - start) < THRESHOLDS.max_push_gap)
        if not (after | before).any():
            return start, end
        best = int(np.argmax(np.where(after | before, windows.energy, 0.0)))
        start = min(start, float(windows.start[best]))
        end = max(end, float(windows.end[best]))
        gap = THRESHOLDS.max_push_gap
        loud = loud & ((windows.end <= start + gap) | (windows.start >= end - gap))


def _enumerate_windows(left: Residuals) -> _WindowEnergies | None:
    """The windows, from sums over cells of a tenth of a second; None where none fits."""
    run, number, total, rows = _accumulate_cells(left)
    parts = []
    for length in _LENGTHS:
        last = np.arange(length - 1, len(run))
        first = last - length + 1
        whole = (run[first] == run[last]) & (number[last] - number[first] <= length)
        first, last = first[whole], last[whole]
        count = rows[last + 1] - rows[first]
        square = (total[last + 1] - total[first]) ** 2
        energy = np.divide(square, count, out=np.zeros_like(square), where=count > 0).sum(axis=1)
        start, end = number[first] * THRESHOLDS.push_cell, (number[last] + 1) * THRESHOLDS.push_cell
        parts.append((run[first], start, end, energy))
    windows = _WindowEnergies(*(np.concatenate(part) for part in zip(*parts, strict=True)))
    return windows if len(windows.run) else None


def _accumulate_cells(left: Residuals) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Log and number of each cell (cells,); sums before it of residuals and rows (cells + 1, J)."""
    cell_keys = [
        np.column_stack([run, np.floor(time / THRESHOLDS.push_cell).astype(int)])
        for run, time in zip(left.run, left.time, strict=True)
    ]
    cells, place = np.unique(np.concatenate(cell_keys), axis=0, return_inverse=True)
    total, count = np.zeros((2, len(cells) + 1, len(left.names)))
    ends = np.cumsum([len(keys) for keys in cell_keys])[:-1]
    for j, at in enumerate(np.split(np.ravel(place), ends)):
        size = float(np.median(np.abs(left.residual[j]))) if len(at) else 0.0
        if size > 0.0:
            total[1:, j] = np.bincount(at, left.residual[j] / size, len(cells))
            count[1:, j] = np.bincount(at, minlength=len(cells))
    return cells[:, 0], cells[:, 1], np.cumsum(total, axis=0), np.cumsum(count, axis=0)


def fit_push_torque(window: PushWindow, state: State, data: SearchData) -> PushWindow:
    """Fits the torques of a push, if they lower the error significantly.

    A torque of each joint that changes steadily is fitted to the residuals of the window, that of
    each twentieth of a second to those around.

    Args:
        window: of the push.
        state: fitted to the logs without the window.
        data: the logs with it.
    """
    left = compute_residuals(state, data)
    inside = [
        np.flatnonzero((run == window.log) & (time >= window.start) & (time < window.end))
        for run, time in zip(left.run, left.time, strict=True)
    ]
    after = [residual.copy() for residual in left.residual]
    for rest, time, rows in zip(after, left.time, inside, strict=True):
        rest[rows] -= _predict_from_neighbours(time[rows] - window.start, rest[rows])
    pushed = replace(left, residual=tuple(after))
    score = compare_residuals(left, pushed, range(len(after)), state, THRESHOLDS.prediction_cell)
    if not score.is_better:
        return window
    parts = zip(left.names, left.residual, inside, strict=True)
    torque = {name: float(np.mean(residual[rows])) for name, residual, rows in parts if rows.size}
    return replace(window, torque=torque, change=score.whole)


def _predict_from_neighbours(since: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(r,) what a straight line through the values in the cells around says of those in one."""
    cell, line = np.floor(since / THRESHOLDS.prediction_cell), np.vander(since, 2)
    prediction = np.zeros(len(values))
    for c in np.unique(cell):
        out, beside = cell == c, (cell != c) & (np.abs(cell - c) <= THRESHOLDS.prediction_reach)
        prediction[out] = line[out] @ np.linalg.lstsq(line[beside], values[beside], rcond=None)[0]
    return prediction


# Play in a gear: bursts of the residual where the load changes sign, not the speed.


def compute_burst_ratio(state: State, j: int) -> float:
    """Computes the mean squared residual just after sign changes of the load, over the rest.

    The loudest fifth of the events, and of the rows elsewhere the loudest hundredth, are left out:
    play bursts every time. 0 where the load changes sign, far from speed reversals, less than
    `EVENTS` times.
    """
    event, events = [], 0  # of each row, 0 for none: that of the sample amid its weights
    signals = state.rows.signals
    numbers = state.rows.filter_samples(j, [np.arange(len(s.q)) for s in signals])
    middle = np.round(numbers).astype(int)
    for k, (s, turns) in enumerate(zip(signals, find_load_reversals(state, j), strict=True)):
        span = max(1, round(THRESHOLDS.burst_duration / s.step))
        flags = np.zeros(len(s.q))
        for turn in turns:
            events += 1
            flags[turn : turn + span] = events
        event.append(flags[middle[state.rows.segment[j] == k].clip(0, len(flags) - 1)])
    if events < THRESHOLDS.min_load_reversals:
        return 0.0
    return _compute_energy_ratio(state.residual[j] ** 2, np.concatenate(event), events)


def find_load_reversals(state: State, j: int) -> list[np.ndarray]:
    """Finds samples, by segment, where the load changes sign while the joint moves on."""
    reversals = []
    for s in state.rows.signals:
        span = max(1, round(THRESHOLDS.burst_duration / s.step))
        least = 0.02 * state.joint_scales[j].speed
        turns = np.flatnonzero(np.diff(np.sign(s.load[:, j])) != 0)
        speed = np.abs(s.v[:, j])
        moving = [turn for turn in turns if speed[turn : turn + span].min() > least]
        reversals.append(np.array(moving, dtype=int))
    return reversals


def _compute_energy_ratio(square: np.ndarray, event: np.ndarray, events: int) -> float:
    loud = np.sort([square[event == k].mean() for k in range(1, events + 1) if (event == k).any()])
    quiet = np.sort(square[event == 0])
    if len(loud) < THRESHOLDS.min_load_reversals or len(quiet) < 8:
        return 0.0
    trimmed_loud = loud[: len(loud) - max(1, len(loud) // 5)]
    rest = quiet[: len(quiet) - len(quiet) // 100]
    return float(trimmed_loud.mean() / max(float(rest.mean()), 1e-300))


_NO_FALL = "no column of play significantly lowers the error"


def detect_events(
    search: Search,
    window: PushWindow | None,
    errors: Mapping[str, float],
    score_candidate: Callable[[Candidate], Score],
    findings: Sequence[Finding],
) -> list[Finding]:
    """Adds contact and backlash to the findings.

    Its impacts ring like a spring: where there is play, elasticity that explains little is no
    effect of its own. Play that is heard only before columns on its joint were put in goes ahead of
    those that explain little.

    Args:
        search: of the training logs.
        window: of a contact that was masked.
        errors: relative, by joint, with all effects put in.
        score_candidate: the score of a column beside them.
        findings: that are columns.
    """
    contact = [] if window is None else _detect_contact(search, window, errors)
    alone = all(f.is_refinement for f in findings)
    rings = any(_is_ringing(f) for f in findings)
    least = THRESHOLDS.min_faint_burst_ratio if alone else THRESHOLDS.min_faint_burst_ratio_beside
    play = _detect_backlash(search, search.end, THRESHOLDS.min_burst_ratio)
    play = play or _detect_faint_backlash(search, least, knocks=not rings)
    if play is not None:
        weak = [_is_ringing(f) and f.gain < THRESHOLDS.max_weak_gain for f in findings]
        pairs = zip(findings, weak, strict=True)
        beside = [replace(f, is_refinement=f.is_refinement or is_weak) for f, is_weak in pairs]
        return [*beside, *contact, _score_backlash(search, play, errors, score_candidate)]
    play = _detect_backlash(search, search.start, THRESHOLDS.min_loud_burst_ratio)
    if play is None or contact:
        return [*findings, *contact]
    play = _score_backlash(search, play, errors, score_candidate)
    same_joint = [f for f in findings if f.joint == play.joint]
    if any(f.gain > THRESHOLDS.max_weak_gain and not f.is_refinement for f in same_joint):
        return list(findings)
    rest = [replace(f, is_refinement=True) if f in same_joint else f for f in findings]
    return [play, *rest] if same_joint or alone else [*rest, play]


def _is_ringing(finding: Finding) -> bool:
    return finding.pick is not None and finding.pick.candidate.effect.is_oscillator


def _find_impact_effects(search: Search) -> list[Effect]:
    """Effects with impacts; one at most."""
    return [e for e in search.catalogue if e.has_impacts][:1]


def _detect_contact(
    search: Search, window: PushWindow, errors: Mapping[str, float]
) -> list[Finding]:
    """The push, if it lowers the error; held-out motion that is not explained speaks against it."""
    if window.change is None:
        return []
    event = next(e for e in search.catalogue if e.acts is EffectTarget.WINDOW)
    units = {f"tau{j.name}": j.effort_unit for j in search.spec.joints}
    torque = {f"tau{name}": value for name, value in window.torque.items()}
    ends, doubt = (window.change.before, window.change.after), ""
    if window.held_out_push:
        doubt = (
            f"{window.held_out_push}, in the held-out motion too: if its pose returns, it is a law"
        )
    end, ratio = search.end, THRESHOLDS.min_recurrence_ratio
    for name, y, r in zip(end.joint_names, end.rows.y, end.residual, strict=True):
        least = ratio * np.linalg.norm(r) / max(float(np.linalg.norm(y)), 1e-300)
        if y.size and errors.get(name, 0.0) > least and not doubt:
            doubt = f"something unexplained acts on joint {name} in the held-out motion too"
    text = (
        f"a torque acts from {window.start:.1f} to {window.end:.1f} s that the motion does not "
        f"explain, {window.ratio:.0f} times the energy of any other window: with it the error of "
        f"these logs is {' -> '.join(format_error_pair(*ends))}; these rows are left out of "
        "everything else"
    )
    values = {"t0": window.start, "t1": window.end} | torque
    units = {"t0": "s", "t1": "s"} | units
    numbers = *ends, values, dict[str, float](), units
    return [Finding(event.id, None, *numbers, (), text, None, False, doubt, is_event=True)]


def _list_backlash_joints(search: Search) -> list[int]:
    """Joints whose gear may have play."""
    joints = [(j, joint.name) for j, joint in enumerate(search.spec.joints) if joint.actuated]
    ids = [effect.id for effect in _find_impact_effects(search)]
    return [j for j, name in joints for x in ids if not is_ruled_out(x, name, search.without)]


def _detect_backlash(search: Search, state: State, least: float) -> Finding | None:
    """Play in a gear, on the joint that bursts most and whose column describes most."""
    ratios = {j: compute_burst_ratio(state, j) for j in _list_backlash_joints(search)}
    bursting = [j for j, ratio in ratios.items() if ratio > least]
    if not bursting:
        return None
    columns, floor = _collect_backlash_columns(search), THRESHOLDS.floor_backlash_share
    shares = {k: score.total_share for k, score in columns.items()}
    j = max(bursting, key=lambda k: ratios[k] * max(shares.get(k, 0.0), floor))
    return _build_backlash_finding(search, [j, *bursting], _format_burst_ratio(ratios[j]))


def _format_burst_ratio(ratio: float) -> str:
    return (
        f"{ratio:.0f} times the residual energy of other moments within 0.1 s after the load "
        "changes sign, while the joint moves on"
    )


def _collect_backlash_columns(search: Search) -> dict[int, ScoredCandidate]:
    """What the column of play explains, by joint."""
    return {j.candidate.index: j for j in search.last.ranked if j.candidate.effect.has_impacts}


def _detect_faint_backlash(search: Search, least: float, knocks: bool) -> Finding | None:
    """Play whose bursts noise covers, or whose impacts follow no rule: its column shows it then.

    Args:
        search: of the training logs.
        least: ratio of the bursts.
        knocks: False where something else may have impacts.
    """
    joints, columns = _list_backlash_joints(search), _collect_backlash_columns(search).items()
    sure, smallest = THRESHOLDS.min_t_ratio, THRESHOLDS.min_variance_reduction
    large = [(j, s) for j, s in columns if s.t_ratio > sure and s.variance_reduction > smallest]
    shares = {j: score.total_share for j, score in large if j in joints}
    for j in sorted(shares, key=lambda j: -shares[j]):
        ratio, share = compute_burst_ratio(search.end, j), compute_burst_share(search.end, j)
        if ratio > least:
            return _build_backlash_finding(search, [j], _format_burst_ratio(ratio))
        if knocks and share > THRESHOLDS.min_burst_share:
            text = f"{format_percent(share)} of the residual energy is concentrated in short bursts"
            doubt = "its bursts do not follow the sign of the load"
            return _build_backlash_finding(search, [j], text, doubt)
    return None


def _build_backlash_finding(
    search: Search, bursting: Sequence[int], text: str, caveat: str = ""
) -> Finding:
    """Play on the first of some joints; any of the others may be the one."""
    (effect,), names, first = _find_impact_effects(search), search.end.joint_names, bursting[0]
    others = tuple((effect.id, names[k]) for k in bursting if k != first)
    joint, text = names[first], f"joint {names[first]}: {text}"
    errors: tuple[float, float] = (math.nan, math.nan)
    return Finding(effect.id, joint, *errors, {}, {}, {}, others, text, None, False, caveat)


def _score_backlash(
    search: Search,
    play: Finding,
    errors: Mapping[str, float],
    score_candidate: Callable[[Candidate], Score],
) -> Finding:
    """Play with its errors; where its column does not lower them, it is a description at most."""
    column = _collect_backlash_columns(search).get(search.end.joint_names.index(str(play.joint)))
    score = None if column is None else score_candidate(column.candidate)
    if score is not None and score.is_better:
        ends = score.whole.before, score.whole.after
        text = f"{play.evidence}; error {' -> '.join(format_error_pair(*ends))}"
        return replace(play, error_before=ends[0], error_after=ends[1], evidence=text)
    before, doubt = errors.get(str(play.joint), math.nan), play.caveat or _NO_FALL
    return replace(play, error_before=before, caveat=doubt)
