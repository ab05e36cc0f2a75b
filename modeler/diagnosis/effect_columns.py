"""The rows of an analysis: measured torque, base columns and candidates through one filter."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csr_array

from modeler.core.brief import Brief
from modeler.core.manifest import ParameterSpec
from modeler.diagnosis.candidates import Candidate, links_of
from modeler.diagnosis.signals import EVERY, WINDOW, SignalReference, Signals, tilt_columns
from modeler.effects import NOISE, TURN, Acts
from modeler.numerics.filters import SPREAD, only
from modeler.observation import Observation, Stretch, observed_alike, signals_of

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel

# The columns of a candidate over the samples of a segment: the catalogue's equations in numpy.


FUNCTIONS = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp,
    "abs": np.abs, "sign": np.sign, "tanh": np.tanh,
}  # fmt: skip

UNFELT = 1e-12
"""Columns that are nowhere larger are felt by no joint."""


def own_columns(
    candidates: Sequence[Candidate], signals: Signals, window: slice = EVERY
) -> np.ndarray:
    """(n, k) equations of candidates of one form on one joint, that of the first, then the next.

    Over a window of the samples.
    """
    first = candidates[0]
    j, names, memory = first.index, first.form.names, first.form.memory
    values: dict[str, object] = {
        name: np.array([candidate.shapes[name] for candidate in candidates])
        for name in first.shapes
    }
    span = window if memory is None else EVERY  # what remembers reads the stretch from its start
    read = ("q", "v", "a", *(names & {"load", "static", "torque", "rate"}))
    values |= {name: getattr(signals, name)[span, j, None] for name in read}
    values |= {name: signals.of_other(name)[span, None] for name in first.form.others}
    if "t" in names:
        values["t"] = signals.time[span, None]
    if "since" in names:
        backs = [candidate.shapes.get(TURN, NOISE) for candidate in candidates]
        values["since"] = np.column_stack([signals.since(j, back)[span] for back in backs])
    if "T" in names and (warmth := signals.temperature(first.joint or "")) is not None:
        values["T"] = warmth[span, None]
    with np.errstate(all="ignore"):  # columns that are not finite are not looked at
        if memory is not None:
            x = np.zeros(1)
            if memory.follows is not None:
                x = memory.follows.fold(values, FUNCTIONS, np.pi, float)
            followed = np.broadcast_to(x, (len(signals.q), len(candidates))).T
            states = [
                signals.state(memory, j, candidate.shapes, own)
                for candidate, own in zip(candidates, followed, strict=True)
            ]
            values["z"] = np.column_stack(states)
        found = np.empty((len(signals.q[span]), len(candidates), len(first.form.columns)))
        for k, column in enumerate(first.form.columns):
            found[:, :, k] = column.equation.fold(values, FUNCTIONS, np.pi, float)
    found = found if memory is None else found[window]
    return found.reshape(len(found), -1)


def all_columns(candidate: Candidate, signals: Signals, window: slice = EVERY) -> np.ndarray:
    """(n, J, k) torques of its columns on every joint, over a window of the samples."""
    acts = candidate.effect.acts
    if candidate.delays:
        return signals.rate[window, :, None]
    if acts is Acts.GRAVITY:
        return tilt_columns(signals, window)
    if acts is Acts.LINK:
        return signals.regressor(window)[:, :, [i for i, _ in _inertial(candidate, signals)]]
    if acts is Acts.MOTOR:
        turn = np.zeros(signals.q.shape[1])
        turn[list(candidate.turn)] = list(candidate.turn.values())
        own = _shaft(candidate, signals.v[window] @ turn, signals.a[window] @ turn)
        return own[:, None, :] * turn[None, :, None]
    if acts is Acts.PASSIVE:
        row = signals.coupling[window, candidate.index]
        speed = np.einsum("nj,nj->n", row, signals.v[window])
        own = _shaft(candidate, speed, np.zeros_like(speed))
        return own[:, None, :] * row[:, :, None]
    if acts is Acts.POSITION:
        dq = own_columns([candidate], signals)
        return signals.moved(candidate.index, dq, candidate.effect.whole_axis, window)
    own = own_columns([candidate], signals, window)
    result = np.zeros((len(own), signals.q.shape[1], own.shape[1]))
    result[:, candidate.index] = own
    return result


def _shaft(candidate: Candidate, speed: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
    """(n, k) equations of a shaft that is no joint of the model."""
    values = {"v": speed, "a": acceleration}
    return np.column_stack(
        [c.equation.fold(values, FUNCTIONS, np.pi, float) for c in candidate.form.columns]
    )


def body_parameters(candidate: Candidate, signals: Signals) -> list[ParameterSpec]:
    """The standard parameters of the columns of a body on a link."""
    return [parameter for _, parameter in _inertial(candidate, signals)]


def _inertial(candidate: Candidate, signals: Signals) -> list[tuple[int, ParameterSpec]]:
    """Inertial parameters of the link that a candidate loads that any joint feels; their places."""
    spec = signals.reference.compiled.spec
    own = "rigid_body", links_of(spec)[candidate.index]
    return [
        (i, p)
        for i, p in enumerate(spec.standard)
        if (p.effect, p.joint) == own and signals.largest[i] > UNFELT
    ]


Columns = tuple[np.ndarray | None, ...]
"""Columns of one candidate by joint, (rows_j, k) each; None where they are zero throughout."""


Evaluate = Callable[[int, slice], np.ndarray]
"""Values over a window of the samples of a stretch, by its number."""


@dataclass(frozen=True, eq=False)
class RowBlock(Brief):
    """Rows that lie beside each other, and the samples that they reach.

    Attributes:
        window: samples.
        filters: (rows_j, samples of the window) by joint.
    """

    window: slice
    filters: tuple[csr_array, ...]


@dataclass(frozen=True, eq=False)
class Rows(Brief):
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
    known: dict[Any, Any] = field(default_factory=dict)
    cache: dict[Any, Any] = field(default_factory=dict)

    @property
    def joints(self) -> int:
        """Number of joints, J."""
        return len(self.y)

    def about(self, reference: SignalReference) -> "Rows":
        """The same rows with effects linearised about another reference of the same robot."""
        signals = tuple(dataclasses.replace(s, reference=reference) for s in self.signals)
        return dataclasses.replace(self, signals=signals, known={})

    def filtered(self, j: int, values: Sequence[np.ndarray]) -> np.ndarray:
        """(rows_j, ...) of values (samples, ...) by stretch, on joint j."""
        return np.concatenate([block.filters[j] @ values[i][block.window]
                               for i, block in self._blocks])  # fmt: skip

    def columns(self, candidate: Candidate) -> Columns:
        """The columns of a candidate on these rows."""
        if candidate.local or candidate.effect.acts is Acts.POSITION:
            return self._together([candidate])
        if candidate.effect.acts is Acts.TORQUE and not candidate.delays:  # alike on every joint
            alone = [dataclasses.replace(candidate, index=j) for j in range(self.joints)]
            own = [np.stack([own_columns([c], s) for c in alone], axis=1) for s in self.signals]
            return self.spread(lambda i, w: own[i][w])
        return self.spread(lambda i, w: all_columns(candidate, self.signals[i], w))

    def many(self, candidates: Sequence[Candidate]) -> list[Columns]:
        """The columns of several candidates of one effect on one joint."""
        first = candidates[0]
        if not first.local and first.effect.acts is not Acts.POSITION:
            return [self.columns(candidate) for candidate in candidates]
        whole = self._together(candidates)
        columns = [None if c is None else np.ascontiguousarray(c.T) for c in whole]
        size = len(first.form.columns)
        # a candidate may leave joints alone that its neighbours move
        return [
            tuple(None if c is None or not c[k : k + size].any() else c[k : k + size].T
                  for c in columns)
            for k in range(0, size * len(candidates), size)
        ]  # fmt: skip

    def _together(self, candidates: Sequence[Candidate]) -> Columns:
        """Columns of candidates of one effect on its joint, beside each other."""
        first, signals = candidates[0], self.signals
        j, whole = first.index, first.effect.whole_axis
        if first.local and first.form.memory is None:
            return self._on(j, lambda i, w: own_columns(candidates, signals[i], w))
        own = [own_columns(candidates, s) for s in signals]
        if first.local:
            return self._on(j, lambda i, w: own[i][w])
        return self.spread(lambda i, w: signals[i].moved(j, own[i], whole, w))

    def _on(self, j: int, evaluate: Evaluate) -> Columns:
        """Columns of one joint from its values (samples, k)."""
        found: list[np.ndarray | None] = [None] * self.joints
        found[j] = np.concatenate(
            [block.filters[j] @ evaluate(i, block.window) for i, block in self._blocks]
        )
        return tuple(found)

    def spread(self, evaluate: Evaluate) -> Columns:
        """Columns from values (samples, J, k); None on joints where they are 0 throughout."""
        parts: list[list[np.ndarray]] = [[] for _ in range(self.joints)]
        shown = np.zeros(self.joints, dtype=bool)
        for i, block in self._blocks:
            values = evaluate(i, block.window)
            shown |= values.any(axis=(0, 2))
            for j, weights in enumerate(block.filters):
                parts[j].append(weights @ values[:, j])
        return tuple(
            np.concatenate(own) if felt else None for own, felt in zip(parts, shown, strict=True)
        )

    @property
    def _blocks(self) -> list[tuple[int, RowBlock]]:
        """Stretch by stretch."""
        return [(i, block) for i, blocks in enumerate(self.blocks) for block in blocks]


def width(columns: Columns) -> int:
    """k of columns that are not zero on all joints."""
    return next(c.shape[1] for c in columns if c is not None)


def dense(columns: Columns, j: int, rows: int) -> np.ndarray:
    """(rows, k) columns on joint j; zeros where there are none."""
    here = columns[j]
    return np.zeros((rows, width(columns))) if here is None else here


def rows_of(observation: Observation, reference: SignalReference) -> Rows:
    """The rows of an observation.

    Args:
        observation: of the analysis.
        reference: where effects are linearised.
    """
    signals, blocks = list[Signals](), []
    for part in coarser(observation, reference.compiled).stretches:
        s = part.segment
        signals.append(Signals(s, part.usable, s.q, s.qd, s.qdd, reference))
        pairs = zip(part.used.T, part.usable.T, strict=True)
        own = [_normed(only(part.rows.weights, usable)[used]) for used, usable in pairs]
        blocks.append(_blocks(own, s.samples))
    counted = list(observation.used.T)
    return Rows(
        y=tuple(observation.torque[rows, j] for j, rows in enumerate(counted)),
        W=base_columns(blocks, signals),
        time=tuple(observation.time[rows] for rows in counted),
        run=tuple(observation.run[rows] for rows in counted),
        segment=tuple(observation.segment[rows] for rows in counted),
        blocks=tuple(blocks),
        signals=tuple(signals),
    )


def coarser(observation: Observation, compiled: "CompiledModel") -> Observation:
    """The same rows by fewer samples: columns are smooth beside the filter of the rows.

    Its Gaussian needs one sample per width.
    """
    cutoff = observation.report.processing.parallel_cutoff
    parts = list[Stretch]()
    for part in observation.stretches:
        every = max(1, int(SPREAD / (cutoff * part.segment.step))) if cutoff > 0.0 else 1
        read = signals_of(compiled, part.segment)
        parts.append(part.thinned(every, read) if every > 1 else part)
    return observed_alike(compiled, dataclasses.replace(observation, stretches=tuple(parts)))


def base_columns(
    blocks: Sequence[Sequence[RowBlock]], signals: Sequence[Signals]
) -> tuple[np.ndarray, ...]:
    """(rows_j, c) by joint, of the motion of some signals."""
    parts: list[list[np.ndarray]] = [[] for _ in blocks[0][0].filters]
    for own, s in zip(blocks, signals, strict=True):
        for block in own:
            values = s.base_regressor(block.window)
            for j, weights in enumerate(block.filters):
                parts[j].append(weights @ values[:, j])
    return tuple(np.concatenate(own) for own in parts)


def _blocks(filters: Sequence[csr_array], samples: int) -> tuple[RowBlock, ...]:
    """Of one stretch: the rows whose first sample lies in one window, for one after the other."""
    starts = np.arange(0, samples, WINDOW)
    edges = []
    for weights in filters:
        first = weights.indices[weights.indptr[:-1]]
        edges.append([*np.searchsorted(first, starts).tolist(), len(first)])
    found = []
    for start, *ends in zip(starts.tolist(), *(pairwise(own) for own in edges), strict=True):
        parts = [weights[slice(*own)] for weights, own in zip(filters, ends, strict=True)]
        stop = max(int(part.indices.max(initial=start)) for part in parts) + 1
        made = [
            csr_array(
                (p.data, *map(np.int32, (p.indices - start, p.indptr))),
                shape=(p.shape[0], stop - start),
            )
            for p in parts
        ]
        found.append(RowBlock(slice(start, stop), tuple(made)))
    return tuple(found)


def _normed(weights: csr_array) -> csr_array:
    """Each row divided by its sum."""
    total = weights @ np.ones(weights.shape[1])
    share = np.repeat(1.0 / np.where(total > 0.0, total, 1.0), np.diff(weights.indptr))
    return csr_array((weights.data * share, weights.indices, weights.indptr), shape=weights.shape)
