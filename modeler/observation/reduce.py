"""Rows of y = W beta that pass by: what is made of W where W would be large.

Up to `KEPT` bytes W is built once and kept. Beyond, every stage asks for what it makes of the rows,
and they are evaluated as often as that: cheaper than to write them to memory and read them back.
"""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from modeler.observation.observation import Evaluated, Observation, near
from modeler.observation.stretch import Stretch
from modeler.runtime.fused import Triangles, no_rows, of_rows

KEPT = 2**26
"""Bytes of the filtered regressor up to which it is kept."""


_SAMPLES = 4096  # whose regressor is evaluated at a time, where filtered rows become triangles


def is_streamed(observation: Observation) -> bool:
    """True if W is not built: it would be large, and nobody has asked for it yet."""
    if "columns" in vars(observation):
        return False
    return 8 * observation.used.size * len(observation.names) > KEPT


def blocks(observation: Observation) -> Iterator[tuple[slice, np.ndarray]]:
    """Samples (b of them) and their filtered regressor (b, n, c), in order."""
    for part, own in _stretches(observation):
        for rows, columns in part.blocks(partial(observation.regressor, part.segment)):
            yield slice(own.start + rows.start, own.start + rows.stop), columns


def columns_at(observation: Observation, places: np.ndarray) -> np.ndarray:
    """(m, n, c) filtered regressor of some samples (m,), ascending."""
    if not is_streamed(observation):
        return np.asarray(observation.columns[places])
    found = []
    for part, own in _stretches(observation):
        rows = places[(places >= own.start) & (places < own.stop)] - own.start
        if is_plain(part):
            found.append(observation.regressor(part.segment, part.rows.centres[rows]))
            continue
        for block, columns in part.blocks(partial(observation.regressor, part.segment)):
            inside = rows[(rows >= block.start) & (rows < block.stop)]
            found.append(columns[inside - block.start])
    return np.concatenate(found)


def evaluated(observation: Observation) -> Evaluated:
    """Its regressor; only one of a compiled model is asked for more than W."""
    assert isinstance(observation.regressor, Evaluated)
    return observation.regressor


def explained(observation: Observation, beta: np.ndarray, keep: np.ndarray) -> np.ndarray:
    """(s, n) torque of the model, `columns beta`; 0 where keep (s, n) is False."""
    found, regressor = np.zeros(observation.used.shape), evaluated(observation)
    for part, own in _stretches(observation):
        if not keep[own].any():
            continue
        if is_plain(part):
            some = near(np.flatnonzero(keep[own].any(axis=1)))
            found[own][some] = regressor.torque(part.segment, near(part.rows.centres[some]), beta)
        else:
            found[own] = part.filtered(partial(regressor.torque, part.segment, beta=beta))
    return np.where(keep, found, 0.0)


def triangles(observation: Observation, keep: np.ndarray) -> Triangles:
    """Triangles of [W_j y_j] over the rows keep (s, n) bool."""
    regressor = evaluated(observation)
    state = no_rows(regressor.pattern)
    for part, own in _stretches(observation):
        state = with_stretch(regressor, part, observation.torque[own], keep[own], state)
    return state


def with_stretch(
    regressor: Evaluated, part: Stretch, torque: np.ndarray, keep: np.ndarray, state: Triangles
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
    if is_plain(part):
        return regressor.triangles(part, keep, state)
    for rows, columns in part.blocks(partial(regressor, part.segment), _SAMPLES):
        used = np.ascontiguousarray(keep[rows])
        state = of_rows(state.pattern, columns, torque[rows], used, state)
    return state


def products(
    observation: Observation, keep: np.ndarray, last: Sequence[int]
) -> list[np.ndarray] | None:
    """Sums over t of w_j(t - k) w_j(t)^T within segments, k = 1 .. last_j; None: ask for blocks.

    (last_j, c_j, c_j) for each joint, over its columns of the pattern of the regressor.
    """
    regressor = evaluated(observation)
    if not regressor.multiplies or not all(map(is_plain, observation.stretches)):
        return None
    total: list[np.ndarray] | None = None
    for part, own in _stretches(observation):
        found = [joint[:, :-1, :-1] for joint in regressor.products(part, keep[own].copy(), last)]
        total = found if total is None else [a + b for a, b in zip(total, found, strict=True)]
    return total


def is_plain(part: Stretch) -> bool:
    """True if the rows of a stretch are samples: no parallel filter, whatever the decimation."""
    return len(part.rows.weights.data) == len(part.rows.centres)


def _stretches(observation: Observation) -> Iterator[tuple[Stretch, slice]]:
    first = 0
    for part in observation.stretches:
        count = len(part.rows.centres)
        yield part, slice(first, first + count)
        first += count
