"""Which defects of logs are mended: those whose mending lets a fit predict left-out rows better."""

import dataclasses
from collections.abc import Iterator, Sequence

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.regression.log import Log
from modeler.regression.observation import Observation, build_observation
from modeler.regression.outliers import ALWAYS, CONFIRMED, Defects, find_column
from modeler.regression.prepare import LogRepair, PreparedLogs, check_logs, prepare_logs
from modeler.regression.settings import Processing
from modeler.runtime import CompiledModel

BLOCKS = 5
"""Of time; each is predicted from the others."""

WEIGHTINGS = 3
"""Fits in which the weights of the joints settle."""

SEVERAL = ("held", "lost")
"""Kinds that befall several joints alike: one hypothesis."""


def choose_repairs(model: CompiledModel, logs: Sequence[Log], asked: Processing) -> Processing:
    """The processing with the score of every repair; what is known already stays.

    A repair is a hypothesis. Its score is the error out of block of a weighted fit to the log that
    it mends, over that to the log without it: behind the same filters, on rows that both have. It
    is made if that is below `CONFIRMED`; then the others are tried beside it.

    Args:
        model: the compiled robot.
        logs: read with it.
        asked: processing of them.
    """
    check_logs(model.spec, logs, asked)
    if asked.repairs is not None or asked.keep_damaged:
        return asked
    repair = LogRepair(logs, model.spec)
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
        whole = prepare_logs(model.spec, logs, dataclasses.replace(asked, repairs=every), repair)
        cutoffs = whole.processing.position_cutoff, whole.processing.parallel_cutoff
        base = _fit_blocks(model, logs, chosen, repair, cutoffs)
    except (DataError, LoopError):
        return chosen
    is_new = True
    while is_new and open_:
        is_new = False
        for log, keys in tuple(open_):
            names = [f"{log.name}: {key}" for key in keys]
            tried = dataclasses.replace(
                chosen, repairs={**(chosen.repairs or {}), **dict.fromkeys(names, 0.0)}
            )
            try:
                mended = _fit_blocks(model, logs, tried, repair, cutoffs)
                score = _compute_score(mended, base)
            except (DataError, LoopError):
                continue
            scores = {**(chosen.repairs or {}), **dict.fromkeys(names, score)}
            chosen = dataclasses.replace(chosen, repairs=scores)
            if score < CONFIRMED:
                base, is_new = mended, True
                open_.remove((log, keys))
    return chosen


def _propose_repairs(
    log: Log, model: CompiledModel, defects_by_channel: Defects
) -> Iterator[tuple[str, ...]]:
    """Names of defects, as "q2 zero", that are mended together."""
    several: dict[str, list[str]] = {}
    for name, by_joint in defects_by_channel.items():
        for j, channel in enumerate(by_joint if name != "rows" else ()):
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
    model: CompiledModel, logs: Sequence[Log], processing: Processing, repair: LogRepair,
    cutoffs: tuple[float, float],
) -> BlockFit:  # fmt: skip
    prepared: PreparedLogs = prepare_logs(model.spec, logs, processing, repair).set_cutoffs(
        *cutoffs
    )
    rows = build_observation(model, logs, prepared)
    return BlockFit(rows, compute_left_out_residual(rows))


def compute_left_out_residual(rows: Observation) -> np.ndarray:
    """(s, n) torque less what a weighted fit to the other blocks of time predicts.

    No parameter makes more torque than the joint has: what a motion does not show is near 0.
    """
    W, y, used = rows.columns, rows.torque, rows.used
    block = np.arange(len(y)) * BLOCKS // max(1, len(y))
    driven = [j for j in rows.driven if used[:, j].sum() > BLOCKS]
    sigma = {j: float(np.sqrt(np.mean(y[used[:, j], j] ** 2))) for j in driven}
    size = [np.mean(W[used[:, j], j] ** 2, axis=0) / sigma[j] ** 2 for j in driven]
    if not size:
        raise DataError("no row")
    weak, left = np.maximum(np.max(size, axis=0), 1e-12), np.full(y.shape, np.nan)
    scale = 1.0 / np.sqrt(weak)
    parts = {
        (j, b): (W[is_used, j] * scale, y[is_used, j], is_used)
        for j in driven for b in range(BLOCKS) if (is_used := used[:, j] & (block == b)).any()
    }  # fmt: skip
    least = {j: 1e-9 * sigma[j] for j in driven}
    for _ in range(WEIGHTINGS):
        sums = {
            key: (A.T @ A / sigma[key[0]] ** 2, A.T @ t / sigma[key[0]] ** 2)
            for key, (A, t, _) in parts.items()
        }
        for b in range(BLOCKS):
            some = [both for (_, other), both in sums.items() if other != b]
            if not some:
                continue
            gram = np.sum([g for g, _ in some], axis=0) + np.eye(len(scale))
            beta = np.linalg.solve(gram, np.sum([r for _, r in some], axis=0))
            for (j, other), (A, t, is_used) in parts.items():
                if other == b:
                    left[is_used, j] = t - A @ beta
        for j in driven:
            sigma[j] = max(float(np.sqrt(np.nanmean(left[:, j] ** 2))), least[j])
    return left


def _compute_score(mended: BlockFit, logged: BlockFit) -> float:
    """Geometric mean over joints of the ratio of errors on rows that both have."""
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
        if left.shape[1] > BLOCKS:
            errors = np.maximum(np.sqrt(np.mean(left**2, axis=1)), 1e-300)
            ratios.append(np.log(errors[0] / errors[1]))
    return float(np.exp(np.mean(ratios))) if ratios else float("nan")
