"""From logs to rows: repairs, cut-offs, and plain filters where they predict better.

Plain is what textbooks have: positions differentiated behind one low-pass, the same low-pass on
both sides of the regression, rows at all speeds. Chosen and plain rows are fitted to four fifths of
the time; the left-out fifth is predicted along one motion that belongs to neither, behind 5 Hz.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.choices import LOW_SPEED
from modeler.core.json import ShortRepr
from modeler.core.table import format_error_pair
from modeler.regression import prepare
from modeler.regression.block_fits import (
    BlockSums,
    compute_prior_weights,
    number_blocks,
    sum_blocks,
)
from modeler.regression.cutoffs import CutoffSearch, limit_cutoffs
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.motion_noise import build_bands
from modeler.regression.observation import Observation, build_observation
from modeler.regression.repairs import choose_repairs
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel


def observe(
    model: CompiledModel,
    logs: Sequence[Log],
    processing: Processing | None = None,
    is_compared: bool = True,
) -> Observation:
    """Returns the observation of logs: W, y, and which row is which.

    One parallel filter and decimation for the torque and every column (Guegan, Khalil and Lemoine
    2003, section 5.2). Samples below the speed floor, saturated or missing ones have no weight.

    Args:
        model: the compiled robot.
        logs: read with the same manifest.
        processing: None: automatic. For held-out logs `report.processing` of the fit.
        is_compared: False leaves plain filters aside, as for torques that a model made.

    Raises:
        DataError: no logs, of another robot, or no usable row.
        LoopError: hardly a sample closes the loops.
    """
    repair = prepare.LogRepair(logs, model.spec)
    asked = choose_repairs(model, logs, processing or Processing(), repair)
    prepared = prepare.prepare_logs(model.spec, logs, asked, repair)
    filters = choose_filters(model, logs, prepared, asked, repair) if is_compared else None
    return build_observation(model, logs, filters or limit_cutoffs(model, prepared, asked))


_OF_FILTERS = (
    "position_cutoff",
    "parallel_cutoff",
    "decimation",
    "derivatives",
    "low_speed",
    "speed_floors",
    "edge",
)


def choose_filters(
    model: CompiledModel,
    logs: Sequence[Log],
    prepared: prepare.PreparedLogs,
    asked: Processing,
    repair: prepare.LogRepair | None = None,
) -> prepare.PreparedLogs:
    """Returns the logs behind the filters that are fitted.

    Those of `limit_cutoffs`, or plain ones where the mean over joints of the log of their error is
    lower by 3 %, and by more than its standard error over five blocks of time: on all rows of the
    motion, and on those far from reversals, where friction hides no error of the inertias.

    Args:
        model: the compiled robot.
        logs: read with it.
        prepared: the logs, with the widest cut-offs.
        asked: the processing that was requested; what it states about filters rules.
        repair: of the logs, where it is shared.
    """
    chosen = limit_cutoffs(model, prepared, asked)
    stated = (getattr(asked, name) for name in _OF_FILTERS)
    defaults = (getattr(Processing(), name) for name in _OF_FILTERS)
    is_stated = tuple(stated) != tuple(defaults)
    # rows of a joint without a motor say 0 = W beta: no block shows what they are worth
    if is_stated or not prepared.noise.moving or not all(j.actuated for j in model.spec.joints):
        return chosen
    as_measured = dataclasses.replace(asked, derivatives="position", low_speed=0.0)
    plain = prepare.prepare_logs(model.spec, logs, as_measured, repair)
    comparison = _compare_filters(model, logs, chosen, plain)
    if comparison is None:
        return chosen
    errors = format_error_pair(*comparison.errors)
    said = (
        f"plain filters of {comparison.cutoff:g} Hz, rows at all speeds: fifths of the time, left "
        f"out of the fit, are predicted with {errors[1]} error (mean of the joints), behind the "
        f"filters above with {errors[0]}"
    )
    plain = plain.set_cutoffs(comparison.cutoff, comparison.cutoff)
    bands = dataclasses.replace(build_bands(plain.noise, plain.processing), reasons=(said,))
    return dataclasses.replace(plain, choices=(*chosen.choices, said), lowered=bands)


@dataclass(frozen=True)
class PlainFilters(ShortRepr):
    """Plain filters that predict better.

    Attributes:
        cutoff: Hz.
        errors: relative, left out of the fit, of the chosen filters and of these.
    """

    cutoff: float
    errors: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Referee(ShortRepr):
    """One motion, by which fits are judged.

    Attributes:
        logs: of it.
        prior: (c,) weights of the torque prior.
        seen: normal equations of all its rows, and of those far from reversals.
    """

    logs: Sequence[Log]
    prior: np.ndarray
    seen: tuple[BlockSums, ...]

    def compute_log_errors(self, rows: Observation) -> list[np.ndarray]:
        """Returns (J, B) log errors of fits to these rows without a block, in that block."""
        sums = sum_blocks(rows, number_blocks(rows, self.logs), self.prior)
        return [one.compute_log_errors(sums.solutions) for one in self.seen]


def _compare_filters(
    model: CompiledModel,
    logs: Sequence[Log],
    chosen: prepare.PreparedLogs,
    plain: prepare.PreparedLogs,
) -> PlainFilters | None:
    """Returns the best plain filters; None where the chosen ones do as well."""
    highest = THRESHOLDS.max_cutoff_share / max(piece.step for piece in plain.pieces)
    judged = min(THRESHOLDS.judged_cutoff, highest)
    smooth = min(max(plain.noise.cutoff, judged), highest)
    masked = dataclasses.replace(plain.processing, low_speed=LOW_SPEED)
    used, low = chosen.processing, dataclasses.replace(plain, processing=masked)
    search = CutoffSearch(model, plain)
    first = CutoffSearch(model, chosen).fit(used.position_cutoff, used.parallel_cutoff)
    judges = [each.fit(smooth, judged) for each in (search, CutoffSearch(model, low))]
    if first is None or None in judges:
        return None
    prior = compute_prior_weights(first.rows)
    seen = [sum_blocks(j.rows, number_blocks(j.rows, logs), prior) for j in judges if j is not None]
    referee = Referee(logs, prior, tuple(seen))
    before, best = referee.compute_log_errors(first.rows), (0.0, 0.0)
    for cutoff in THRESHOLDS.plain_cutoffs:
        fit = search.fit(cutoff, cutoff) if cutoff <= highest else None
        if fit is None or not fit.rows.driven:
            continue
        after = referee.compute_log_errors(fit.rows)
        changes = [_compute_change(a, b) for a, b in zip(after, before, strict=True)]
        best = min(best, (max(changes), cutoff))
    if best[0] >= np.log(THRESHOLDS.max_plain_ratio):
        return None
    known = np.isfinite(before[0])
    torque = 0.5 * np.log(seen[0].squares[known] / seen[0].count[known])
    error = float(np.exp(np.mean(before[0][known] - torque)))
    if error < THRESHOLDS.min_plain_error:
        return None
    return PlainFilters(best[1], (error, error * float(np.exp(best[0]))))


def _compute_change(after: np.ndarray, before: np.ndarray) -> float:
    """Returns the mean change of log errors (J, B); 0 within its standard error over blocks."""
    change = after - before
    known = np.isfinite(change)
    blocks = [np.mean(c[k]) for c, k in zip(change.T, known.T, strict=True) if k.any()]
    if len(blocks) < 2:
        return 0.0
    mean = float(np.mean(change[known]))
    return mean if mean < -np.std(blocks, ddof=1) / len(blocks) ** 0.5 else 0.0
