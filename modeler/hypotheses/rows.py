"""The rows of an analysis: measured torque, base columns and candidates through one filter."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from modeler.core.brief import Brief
from modeler.effects import Acts
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.columns import all_columns, moved_columns, own_columns, own_columns_of
from modeler.hypotheses.signals import Reference, Signals
from modeler.observation import Observation
from modeler.observation.row_filter import SPREAD, only
from modeler.observation.stretch import Stretch

Columns = tuple[np.ndarray | None, ...]
"""Columns of one candidate by joint, (rows_j, k) each; None where they are zero throughout."""


@dataclass(frozen=True, eq=False)
class Rows(Brief):
    """The used rows of every joint; J joints, c base columns.

    Attributes:
        y: (rows_j,) by joint, measured torque, N m or N.
        W: (rows_j, c) by joint, base columns.
        time: (rows_j,) by joint, s.
        run: (rows_j,) by joint, index of the log.
        segment: (rows_j,) by joint.
        filters: (rows_j, samples) by stretch and joint.
        signals: by stretch.
        known: what was made of them for this reference, by name.
    """

    y: tuple[np.ndarray, ...]
    W: tuple[np.ndarray, ...]
    time: tuple[np.ndarray, ...]
    run: tuple[np.ndarray, ...]
    segment: tuple[np.ndarray, ...]
    filters: tuple[tuple[csr_array, ...], ...]
    signals: tuple[Signals, ...]
    known: dict[Any, Any] = field(default_factory=dict)

    @property
    def joints(self) -> int:
        """Number of joints, J."""
        return len(self.y)

    def about(self, reference: Reference) -> "Rows":
        """The same rows with effects linearised about another reference of the same robot."""
        signals = tuple(dataclasses.replace(s, reference=reference) for s in self.signals)
        return dataclasses.replace(self, signals=signals, known={})

    def filtered(self, j: int, values: Sequence[np.ndarray]) -> np.ndarray:
        """(rows_j, ...) of values (samples, ...) by stretch, on joint j."""
        return np.concatenate(
            [own[j] @ value for own, value in zip(self.filters, values, strict=True)]
        )

    def columns(self, candidate: Candidate) -> Columns:
        """The columns of a candidate on these rows."""
        if candidate.local:
            own = [own_columns(candidate, signals) for signals in self.signals]
            found: list[np.ndarray | None] = [None] * self.joints
            found[candidate.index] = self.filtered(candidate.index, own)
            return tuple(found)
        return self.spread([all_columns(candidate, signals) for signals in self.signals])

    def many(self, candidates: Sequence[Candidate]) -> list[Columns]:
        """The columns of several candidates of one effect on one joint."""
        first = candidates[0]
        if first.local:
            own = [own_columns_of(candidates, signals) for signals in self.signals]
            found: list[np.ndarray | None] = [None] * self.joints
            found[first.index] = self.filtered(first.index, own)
            whole: Columns = tuple(found)
        elif first.effect.acts is Acts.POSITION:
            whole = self.spread([moved_columns(candidates, signals) for signals in self.signals])
        else:
            return [self.columns(candidate) for candidate in candidates]
        columns = [None if c is None else np.ascontiguousarray(c.T) for c in whole]
        size = len(first.form.columns)
        return [
            _or_none([None if c is None else c[k : k + size].T for c in columns])
            for k in range(0, size * len(candidates), size)
        ]

    def spread(self, values: Sequence[np.ndarray]) -> Columns:
        """Columns from values (samples, J, k) by stretch."""
        return tuple(
            self.filtered(j, [value[:, j] for value in values])
            if any(value[:, j].any() for value in values)
            else None
            for j in range(self.joints)
        )


def _or_none(columns: Sequence[np.ndarray | None]) -> Columns:
    """Of a candidate that moves other joints than its neighbours do."""
    return tuple(None if c is None or not c.any() else c for c in columns)


def dense(columns: Columns, j: int, rows: int) -> np.ndarray:
    """(rows, k) columns on joint j; zeros where there are none."""
    here = columns[j]
    if here is not None:
        return here
    return np.zeros((rows, next(c.shape[1] for c in columns if c is not None)))


def rows_of(observation: Observation, reference: Reference) -> Rows:
    """The rows of an observation.

    Args:
        observation: of the analysis.
        reference: where effects are linearised.
    """
    cutoff = observation.report.processing.parallel_cutoff or 0.0
    signals = tuple(_signals(part, reference, cutoff) for part in observation.stretches)
    joints = len(observation.joints)
    full = [[_filter(part, j) for j in range(joints)] for part in observation.stretches]
    filters = tuple(
        tuple(_thinned(own, s.every) for own in part) for part, s in zip(full, signals, strict=True)
    )
    model = reference.compiled
    base = [model.base_regressor(s.q, s.v, s.a, s.read) for s in signals]

    def gather(j: int, values: list[np.ndarray]) -> np.ndarray:
        return np.concatenate([own[j] @ value for own, value in zip(filters, values, strict=True)])

    used = [observation.used[:, j] for j in range(joints)]
    torque = [part.segment.tau for part in observation.stretches]
    return Rows(
        y=tuple(
            np.concatenate([f[j] @ tau[:, j] for f, tau in zip(full, torque, strict=True)])
            for j in range(joints)
        ),
        W=tuple(gather(j, [value[:, j] for value in base]) for j in range(joints)),
        time=tuple(observation.time[rows] for rows in used),
        run=tuple(observation.run[rows] for rows in used),
        segment=tuple(observation.segment[rows] for rows in used),
        filters=filters,
        signals=signals,
    )


def _filter(part: Stretch, j: int) -> csr_array:
    """(used rows, samples) weights over usable samples, each row summing to one."""
    return _normed(only(part.rows.weights, part.usable[:, j])[part.used[:, j]])


def _thinned(weights: csr_array, every: int) -> csr_array:
    """The same filter over every k-th sample."""
    if every == 1:
        return weights
    return _normed(csr_array(weights[:, ::every]))


def _normed(weights: csr_array) -> csr_array:
    """Each row divided by its sum."""
    total = weights @ np.ones(weights.shape[1])
    share = np.repeat(1.0 / np.where(total > 0.0, total, 1.0), np.diff(weights.indptr))
    return csr_array((weights.data * share, weights.indices, weights.indptr), shape=weights.shape)


def _signals(part: Stretch, reference: Reference, cutoff: float) -> Signals:
    """Columns are smooth beside the filter: its Gaussian needs one sample per width."""
    segment = part.segment
    every = max(1, int(SPREAD / (cutoff * segment.step))) if cutoff > 0.0 else 1
    q, v, a = (np.ascontiguousarray(x[::every]) for x in (segment.q, segment.qd, segment.qdd))
    return Signals(segment, every, q, v, a, reference)
