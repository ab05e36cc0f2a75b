"""Rows of y = W beta that pass by: what is made of W where W would be large.

Up to `KEPT` bytes W is built once and kept. Beyond, every stage asks for what it makes of the rows,
and they are evaluated as often as that: cheaper than to write them to memory and read them back.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np

from modeler.regression.observation import ModelRegressor, Observation
from modeler.regression.stretch import FilteredSegment
from modeler.runtime import Triangles, make_empty_triangles, reduce_rows

KEPT = 2**26
"""Bytes of the filtered regressor up to which it is kept."""

_ADDED = 4096  # samples evaluated at a time for triangles of filtered rows


def is_streamed(observation: Observation) -> bool:
    """True if W is not built: it would be large, and nobody has asked for it yet.

    What passes by is the regressor of a compiled model; another one is kept.
    """
    large = 8 * observation.used.size * len(observation.names) > KEPT
    compiled = isinstance(observation.regressor, ModelRegressor)
    return large and compiled and "columns" not in vars(observation)


def iterate_blocks(observation: Observation) -> Iterator[tuple[slice, np.ndarray]]:
    """Samples (b of them) and their filtered regressor (b, n, c), in order."""
    for part, part_rows in _iterate_stretches(observation):
        for rows, columns in part.iterate_blocks(partial(observation.regressor, part.segment)):
            yield slice(part_rows.start + rows.start, part_rows.start + rows.stop), columns


def evaluate_columns_at(observation: Observation, places: np.ndarray) -> np.ndarray:
    """(m, n, c) filtered regressor of some samples (m,), ascending."""
    if not is_streamed(observation):
        return np.asarray(observation.columns[places])
    columns = []
    for part, part_rows in _iterate_stretches(observation):
        rows = places[(places >= part_rows.start) & (places < part_rows.stop)] - part_rows.start
        if is_unfiltered(part):
            columns.append(observation.regressor(part.segment, part.rows.centres[rows]))
        elif rows.size:
            columns.append(part.filter_rows(rows, partial(observation.regressor, part.segment)))
    return np.concatenate(columns)


def compute_fitted_torque(
    observation: Observation, beta: np.ndarray, keep: np.ndarray
) -> np.ndarray:
    """(s, n) torque of the model, `columns beta`, where keep (s, n); 0 elsewhere."""
    regressor = observation.regressor
    assert isinstance(regressor, ModelRegressor)
    return np.where(
        keep, observation.filter_columns(partial(regressor.compute_torque, beta=beta)), 0.0
    )


def compute_triangles(observation: Observation, keep: np.ndarray) -> Triangles:
    """Triangles of [W_j y_j] over the rows keep (s, n) bool."""
    regressor = observation.regressor
    assert isinstance(regressor, ModelRegressor)
    state = make_empty_triangles(regressor.pattern)
    for part, part_rows in _iterate_stretches(observation):
        state = add_stretch(regressor, part, observation.torque[part_rows], keep[part_rows], state)
    return state


def add_stretch(
    regressor: ModelRegressor,
    part: FilteredSegment,
    torque: np.ndarray,
    keep: np.ndarray,
    state: Triangles,
) -> Triangles:
    """Triangles with the rows of a stretch added.

    Args:
        regressor: over its samples.
        part: the stretch.
        torque: (rows, n) filtered.
        keep: (rows, n) bool.
        state: before.
    """
    if not keep.any():
        return state
    if is_unfiltered(part):
        return regressor.compute_triangles(part, keep, state)
    spans = regressor.pattern.spans
    for rows, columns in part.iterate_blocks(partial(regressor, part.segment), _ADDED, spans):
        used = np.ascontiguousarray(keep[rows])
        state = reduce_rows(state.pattern, columns, torque[rows], used, state)
    return state


def is_unfiltered(part: FilteredSegment) -> bool:
    """True if the rows of a stretch are samples: no parallel filter, whatever the decimation."""
    return len(part.rows.weights.data) == len(part.rows.centres)


def _iterate_stretches(observation: Observation) -> Iterator[tuple[FilteredSegment, slice]]:
    first = 0
    for part in observation.stretches:
        count = len(part.rows.centres)
        yield part, slice(first, first + count)
        first += count
