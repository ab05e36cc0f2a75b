"""Repairs of logs that a fit confirms: it predicts left-out rows better with them."""

import dataclasses
from collections.abc import Iterator, Sequence

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.regression import prepare
from modeler.regression.block_fits import predict_left_out
from modeler.regression.faults import ALWAYS, Defects, find_column
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observation import Observation, build_observation
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel

SEVERAL = ("held", "lost")
"""Kinds that befall several joints alike: one hypothesis."""


def choose_repairs(
    model: CompiledModel,
    logs: Sequence[Log],
    asked: Processing,
    repair: prepare.LogRepair | None = None,
) -> Processing:
    """Returns the processing with the score of every repair; what is known already stays.

    A repair is a hypothesis. Its score is the error out of block of a weighted fit to the log that
    it mends, over that to the log without it: behind the same filters, on rows that both have. It
    is made if that is below `CONFIRMED`; then the others are tried beside it.

    Args:
        model: the compiled robot.
        logs: read with it.
        asked: processing of them.
        repair: of the same logs, where it is shared.
    """
    prepare.check_logs(model.spec, logs, asked)
    if asked.repairs is not None or asked.keep_damaged:
        return asked
    repair = repair or prepare.LogRepair(logs, model.spec)
    open_ = [
        (log, tried)
        for run, log in enumerate(logs)
        for tried in _propose_repairs(log, model, repair.get_repaired(run, asked)[1])
    ]
    chosen = dataclasses.replace(asked, repairs={})
    if not open_:
        return chosen
    try:
        every = dict.fromkeys((f"{log.name}: {key}" for log, keys in open_ for key in keys), 0.0)
        whole = prepare.prepare_logs(
            model.spec, logs, dataclasses.replace(asked, repairs=every), repair
        )
        cutoffs = whole.processing.position_cutoff, whole.processing.parallel_cutoff
        base = _fit_blocks(model, logs, chosen, repair, cutoffs)
    except (DataError, LoopError):
        return chosen
    is_new = True
    while is_new and open_:
        is_new = False
        for log, keys in tuple(open_):
            names = [f"{log.name}: {key}" for key in keys]
            known = dict(chosen.repairs or {})
            tried = dataclasses.replace(chosen, repairs=known | dict.fromkeys(names, 0.0))
            try:
                mended = _fit_blocks(model, logs, tried, repair, cutoffs)
                score = _compute_score(mended, base)
            except (DataError, LoopError):
                continue
            chosen = dataclasses.replace(chosen, repairs=known | dict.fromkeys(names, score))
            if score < THRESHOLDS.max_repair_ratio:
                base, is_new = mended, True
                open_.remove((log, keys))
    return chosen


def _propose_repairs(
    log: Log, model: CompiledModel, by_channel: Defects
) -> Iterator[tuple[str, ...]]:
    """Yields names of defects, as "q2 zero", that are mended together."""
    several: dict[str, list[str]] = {}
    for name, by_joint in by_channel.items():
        for j, channel in enumerate(by_joint):
            for kind in dict.fromkeys(one.kind for one in channel if one.kind not in ALWAYS):
                key = f"{find_column(log, model.spec, name, j)} {kind}"
                if kind in SEVERAL:
                    several.setdefault(f"{name} {kind}", []).append(key)
                else:
                    yield (key,)
    yield from map(tuple, several.values())


@dataclasses.dataclass(frozen=True, eq=False)
class BlockFit:
    """Rows of logs, and what a fit to other blocks leaves of each (s, n)."""

    rows: Observation
    residual: np.ndarray


def _fit_blocks(
    model: CompiledModel,
    logs: Sequence[Log],
    processing: Processing,
    repair: prepare.LogRepair,
    cutoffs: tuple[float, float],
) -> BlockFit:
    prepared = prepare.prepare_logs(model.spec, logs, processing, repair).set_cutoffs(*cutoffs)
    rows = build_observation(model, logs, prepared)
    return BlockFit(rows, predict_left_out(rows, logs))


def _compute_score(mended: BlockFit, logged: BlockFit) -> float:
    """Returns geometric mean over joints of the ratio of errors on rows that both have."""
    a, b = mended.rows, logged.rows
    start, span = float(a.time.min()), float(np.ptp(np.append(a.time, b.time))) + 1.0
    one, other = (fit_rows.time - start + 2.0 * span * fit_rows.run for fit_rows in (a, b))
    order = np.argsort(other)
    place = np.clip(np.searchsorted(other[order], one), 1, len(order) - 1)
    nearest = order[place - (one - other[order[place - 1]] < other[order[place]] - one)]
    close = np.abs(other[nearest] - one) <= 0.6 * np.median(np.diff(other[order]))
    ratios = []
    for j in range(a.torque.shape[1]):
        left = np.stack([mended.residual[close, j], logged.residual[nearest[close], j]])
        left = left[:, np.isfinite(left).all(axis=0)]
        if left.shape[1] > THRESHOLDS.time_blocks:
            errors = np.maximum(np.sqrt(np.mean(left**2, axis=1)), 1e-300)
            ratios.append(np.log(errors[0] / errors[1]))
    return float(np.exp(np.mean(ratios))) if ratios else float("nan")
