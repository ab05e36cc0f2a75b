"""The rows of an analysis: measured torque, base columns and candidates through one filter."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csr_array

from modeler.core.brief import ShortRepr
from modeler.core.manifest import ParameterSpec
from modeler.diagnosis.candidates import Candidate, list_links
from modeler.diagnosis.signals import EVERY, SignalReference, Signals, compute_tilt_columns
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import NOISE, TURN, EffectTarget
from modeler.numerics.filters import SPREAD, restrict_weights
from modeler.regression import FilteredSegment, Observation, compute_signals, rebuild_observation

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel

# The columns of a candidate over the samples of a segment: the catalogue's equations in numpy.


FUNCTIONS = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "abs": np.abs,
    "sign": np.sign,
    "tanh": np.tanh,
}


def evaluate_equations(
    candidates: Sequence[Candidate], signals: Signals, window: slice = EVERY
) -> np.ndarray:
    """(n, k) equations of candidates of one form on one joint, that of the first, then the next.

    Over a window of the samples.
    """
    first = candidates[0]
    j, names, memory = first.index, first.form.names, first.form.internal_state
    values: dict[str, object] = {
        name: np.array([candidate.nonlinear_parameters[name] for candidate in candidates])
        for name in first.nonlinear_parameters
    }
    span = window if memory is None else EVERY  # what remembers reads the stretch from its start
    read = ("q", "v", "a", *(names & {"load", "static", "torque", "rate"}))
    values |= {name: getattr(signals, name)[span, j, None] for name in read}
    values |= {
        name: signals.select_other(name)[span, None] for name in first.form.other_joint_names
    }
    if "t" in names:
        values["t"] = signals.time[span, None]
    if "since" in names:
        backs = [candidate.nonlinear_parameters.get(TURN, NOISE) for candidate in candidates]
        values["since"] = np.column_stack(
            [signals.compute_reversal_time(j, back)[span] for back in backs]
        )
    if "T" in names and (warmth := signals.compute_temperature(first.joint or "")) is not None:
        values["T"] = warmth[span, None]
    with np.errstate(all="ignore"):  # columns that are not finite are not looked at
        if memory is not None:
            x = np.zeros(1)
            if memory.lagged_input is not None:
                x = memory.lagged_input.fold(values, FUNCTIONS, np.pi, float)
            followed = np.broadcast_to(x, (len(signals.q), len(candidates))).T
            states = [
                signals.compute_memory_state(memory, j, candidate.nonlinear_parameters, signal)
                for candidate, signal in zip(candidates, followed, strict=True)
            ]
            values["z"] = np.column_stack(states)
        columns = np.empty((len(signals.q[span]), len(candidates), len(first.form.columns)))
        for k, column in enumerate(first.form.columns):
            columns[:, :, k] = column.equation.fold(values, FUNCTIONS, np.pi, float)
    columns = columns if memory is None else columns[window]
    return columns.reshape(len(columns), -1)


def evaluate_columns(candidate: Candidate, signals: Signals, window: slice = EVERY) -> np.ndarray:
    """(n, J, k) torques of its columns on every joint, over a window of the samples."""
    acts = candidate.effect.acts
    if candidate.is_delay:
        return signals.rate[window, :, None]
    if acts is EffectTarget.GRAVITY:
        return compute_tilt_columns(signals, window)
    if acts is EffectTarget.LINK:
        return signals.compute_regressor(window)[
            :, :, [i for i, _ in _find_inertial_parameters(candidate, signals)]
        ]
    if acts is EffectTarget.MOTOR:
        turn = np.zeros(signals.q.shape[1])
        turn[list(candidate.coupling)] = list(candidate.coupling.values())
        columns = _evaluate_shaft(candidate, signals.v[window] @ turn, signals.a[window] @ turn)
        return columns[:, None, :] * turn[None, :, None]
    if acts is EffectTarget.PASSIVE:
        row = signals.coupling[window, candidate.index]
        speed = np.einsum("nj,nj->n", row, signals.v[window])
        columns = _evaluate_shaft(candidate, speed, np.zeros_like(speed))
        return columns[:, None, :] * row[:, :, None]
    if acts is EffectTarget.POSITION:
        dq = evaluate_equations([candidate], signals)
        return signals.compute_displacement_torque(
            candidate.index, dq, candidate.effect.whole_axis, window
        )
    columns = evaluate_equations([candidate], signals, window)
    result = np.zeros((len(columns), signals.q.shape[1], columns.shape[1]))
    result[:, candidate.index] = columns
    return result


def _evaluate_shaft(
    candidate: Candidate, speed: np.ndarray, acceleration: np.ndarray
) -> np.ndarray:
    """(n, k) equations of a shaft that is no joint of the model."""
    values = {"v": speed, "a": acceleration}
    return np.column_stack(
        [c.equation.fold(values, FUNCTIONS, np.pi, float) for c in candidate.form.columns]
    )


def list_body_parameters(candidate: Candidate, signals: Signals) -> list[ParameterSpec]:
    """The standard parameters of the columns of a body on a link."""
    return [parameter for _, parameter in _find_inertial_parameters(candidate, signals)]


def _find_inertial_parameters(
    candidate: Candidate, signals: Signals
) -> list[tuple[int, ParameterSpec]]:
    """Inertial parameters of the link that a candidate loads that any joint feels; their places."""
    spec = signals.reference.compiled.spec
    link_key = "rigid_body", list_links(spec)[candidate.index]
    return [
        (i, p)
        for i, p in enumerate(spec.standard)
        if (p.effect, p.joint) == link_key
        and signals.column_maxima[i] > THRESHOLDS.min_parameter_column
    ]


Columns = tuple[np.ndarray | None, ...]
"""Columns of one candidate by joint, (rows_j, k) each; None where they are zero throughout."""


Evaluate = Callable[[int, slice], np.ndarray]
"""Values over a window of the samples of a stretch, by its number."""


@dataclass(frozen=True, eq=False)
class RowBlock(ShortRepr):
    """Rows that lie beside each other, and the samples that they reach.

    Attributes:
        window: samples.
        filters: (rows_j, samples of the window) by joint.
    """

    window: slice
    filters: tuple[csr_array, ...]


@dataclass(frozen=True, eq=False)
class Rows(ShortRepr):
    """The used rows of every joint; J joints, c base columns.

    Attributes:
        y: (rows_j,) by joint, measured torque, N m or N.
        W: (rows_j, c) by joint, base columns.
        time: (rows_j,) by joint, s.
        run: (rows_j,) by joint, index of the log.
        segment: (rows_j,) by joint.
        blocks: filters (rows_j, samples) in pieces, by stretch.
        signals: by stretch.
        known: what was made of them for this reference, by name.
        cache: columns that do not depend on the model, shared by all references.
    """

    y: tuple[np.ndarray, ...]
    W: tuple[np.ndarray, ...]
    time: tuple[np.ndarray, ...]
    run: tuple[np.ndarray, ...]
    segment: tuple[np.ndarray, ...]
    blocks: tuple[tuple[RowBlock, ...], ...]
    signals: tuple[Signals, ...]
    reference_cache: dict[Any, Any] = field(default_factory=dict)
    cache: dict[Any, Any] = field(default_factory=dict)

    @property
    def joint_count(self) -> int:
        """Number of joints, J."""
        return len(self.y)

    def replace_reference(self, reference: SignalReference) -> "Rows":
        """The same rows with effects linearised about another reference of the same robot."""
        signals = tuple(dataclasses.replace(s, reference=reference) for s in self.signals)
        return dataclasses.replace(self, signals=signals, reference_cache={})

    def filter_samples(self, j: int, values: Sequence[np.ndarray]) -> np.ndarray:
        """(rows_j, ...) of values (samples, ...) by stretch, on joint j."""
        return np.concatenate(
            [block.filters[j] @ values[i][block.window] for i, block in self._numbered_blocks]
        )

    def build_columns(self, candidate: Candidate) -> Columns:
        """The columns of a candidate on these rows."""
        if candidate.is_local or candidate.effect.acts is EffectTarget.POSITION:
            return self._build_stacked([candidate])
        if (
            candidate.effect.acts is EffectTarget.TORQUE and not candidate.is_delay
        ):  # alike on every joint
            alone = [dataclasses.replace(candidate, index=j) for j in range(self.joint_count)]
            values = [
                np.stack([evaluate_equations([c], s) for c in alone], axis=1) for s in self.signals
            ]
            return self.filter_joints(lambda i, w: values[i][w])
        return self.filter_joints(lambda i, w: evaluate_columns(candidate, self.signals[i], w))

    def build_batch(self, candidates: Sequence[Candidate]) -> list[Columns]:
        """The columns of several candidates of one effect on one joint."""
        first = candidates[0]
        if not first.is_local and first.effect.acts is not EffectTarget.POSITION:
            return [self.build_columns(candidate) for candidate in candidates]
        whole = self._build_stacked(candidates)
        columns = [None if c is None else np.ascontiguousarray(c.T) for c in whole]
        size = len(first.form.columns)
        # a candidate may leave joints alone that its neighbours move
        return [
            tuple(
                None if c is None or not c[k : k + size].any() else c[k : k + size].T
                for c in columns
            )
            for k in range(0, size * len(candidates), size)
        ]

    def _build_stacked(self, candidates: Sequence[Candidate]) -> Columns:
        """Columns of candidates of one effect on its joint, beside each other."""
        first, signals = candidates[0], self.signals
        j, whole = first.index, first.effect.whole_axis
        if first.is_local and first.form.internal_state is None:
            return self._filter_joint(j, lambda i, w: evaluate_equations(candidates, signals[i], w))
        values = [evaluate_equations(candidates, s) for s in signals]
        if first.is_local:
            return self._filter_joint(j, lambda i, w: values[i][w])
        return self.filter_joints(
            lambda i, w: signals[i].compute_displacement_torque(j, values[i], whole, w)
        )

    def _filter_joint(self, j: int, evaluate: Evaluate) -> Columns:
        """Columns of one joint from its values (samples, k)."""
        columns: list[np.ndarray | None] = [None] * self.joint_count
        columns[j] = np.concatenate(
            [block.filters[j] @ evaluate(i, block.window) for i, block in self._numbered_blocks]
        )
        return tuple(columns)

    def filter_joints(self, evaluate: Evaluate) -> Columns:
        """Columns from values (samples, J, k); None on joints where they are 0 throughout."""
        parts: list[list[np.ndarray]] = [[] for _ in range(self.joint_count)]
        shown = np.zeros(self.joint_count, dtype=bool)
        for i, block in self._numbered_blocks:
            values = evaluate(i, block.window)
            shown |= values.any(axis=(0, 2))
            for j, weights in enumerate(block.filters):
                parts[j].append(weights @ values[:, j])
        return tuple(
            np.concatenate(joint_parts) if is_shown else None
            for joint_parts, is_shown in zip(parts, shown, strict=True)
        )

    @property
    def _numbered_blocks(self) -> list[tuple[int, RowBlock]]:
        """Stretch by stretch."""
        return [(i, block) for i, blocks in enumerate(self.blocks) for block in blocks]


def count_columns(columns: Columns) -> int:
    """k of columns that are not zero on all joints."""
    return next(c.shape[1] for c in columns if c is not None)


def expand_columns(columns: Columns, j: int, rows: int) -> np.ndarray:
    """(rows, k) columns on joint j; zeros where there are none."""
    here = columns[j]
    return np.zeros((rows, count_columns(columns))) if here is None else here


def build_rows(observation: Observation, reference: SignalReference) -> Rows:
    """The rows of an observation.

    Args:
        observation: of the analysis.
        reference: where effects are linearised.
    """
    signals, blocks = list[Signals](), []
    for part in thin_samples(observation, reference.compiled).stretches:
        s = part.segment
        signals.append(Signals(s, part.usable, s.q, s.qd, s.qdd, reference))
        pairs = zip(part.used.T, part.usable.T, strict=True)
        joint_filters = [
            _normalise_rows(restrict_weights(part.rows.weights, usable)[used])
            for used, usable in pairs
        ]
        blocks.append(_split_blocks(joint_filters, s.samples))
    counted = list(observation.used.T)
    return Rows(
        y=tuple(observation.torque[rows, j] for j, rows in enumerate(counted)),
        W=build_base_columns(blocks, signals),
        time=tuple(observation.time[rows] for rows in counted),
        run=tuple(observation.run[rows] for rows in counted),
        segment=tuple(observation.segment[rows] for rows in counted),
        blocks=tuple(blocks),
        signals=tuple(signals),
    )


def thin_samples(observation: Observation, compiled: "CompiledModel") -> Observation:
    """The same rows by fewer samples: columns are smooth beside the filter of the rows.

    Its Gaussian needs one sample per width.
    """
    cutoff = observation.report.processing.parallel_cutoff
    parts = list[FilteredSegment]()
    for part in observation.stretches:
        every = max(1, int(SPREAD / (cutoff * part.segment.step))) if cutoff > 0.0 else 1
        read = compute_signals(compiled, part.segment)
        parts.append(part.thin_samples(every, read) if every > 1 else part)
    return rebuild_observation(compiled, dataclasses.replace(observation, stretches=tuple(parts)))


def build_base_columns(
    blocks: Sequence[Sequence[RowBlock]], signals: Sequence[Signals]
) -> tuple[np.ndarray, ...]:
    """(rows_j, c) by joint, of the motion of some signals."""
    parts: list[list[np.ndarray]] = [[] for _ in blocks[0][0].filters]
    for group, s in zip(blocks, signals, strict=True):
        for block in group:
            values = s.compute_base_regressor(block.window)
            for j, weights in enumerate(block.filters):
                parts[j].append(weights @ values[:, j])
    return tuple(np.concatenate(group) for group in parts)


def _split_blocks(filters: Sequence[csr_array], samples: int) -> tuple[RowBlock, ...]:
    """Of one stretch: the rows whose first sample lies in one window, for one after the other."""
    starts = np.arange(0, samples, THRESHOLDS.sample_window)
    edges = []
    for weights in filters:
        first = weights.indices[weights.indptr[:-1]]
        edges.append([*np.searchsorted(first, starts).tolist(), len(first)])
    row_blocks = []
    for start, *ends in zip(starts.tolist(), *(pairwise(bounds) for bounds in edges), strict=True):
        parts = [weights[slice(*bounds)] for weights, bounds in zip(filters, ends, strict=True)]
        stop = max(int(part.indices.max(initial=start)) for part in parts) + 1
        made = [
            csr_array(
                (p.data, *map(np.int32, (p.indices - start, p.indptr))),
                shape=(p.shape[0], stop - start),
            )
            for p in parts
        ]
        row_blocks.append(RowBlock(slice(start, stop), tuple(made)))
    return tuple(row_blocks)


def _normalise_rows(weights: csr_array) -> csr_array:
    """Each row divided by its sum."""
    total = weights @ np.ones(weights.shape[1])
    share = np.repeat(1.0 / np.where(total > 0.0, total, 1.0), np.diff(weights.indptr))
    return csr_array((weights.data * share, weights.indices, weights.indptr), shape=weights.shape)
