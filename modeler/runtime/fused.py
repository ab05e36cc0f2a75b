"""Triangles of [W_j y_j], joint by joint, while samples pass: W is never built.

Samples are reduced in blocks of a fixed size, each from a state of zeros, and the states are merged
in the order of the blocks: results depend on nothing but the samples, however many threads there
are.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from modeler.core.errors import ManifestError, ShapeError
from modeler.core.json import ShortRepr
from modeler.core.manifest import FunctionSpec, ModuleSpec
from modeler.runtime import bind
from modeler.runtime.bind import EntryFunctions, FusedLibrary, Library, SampleArrays, TileLibrary
from modeler.runtime.build import map_parts, split_samples
from modeler.runtime.checks import check_mask, check_sample_counts, check_samples, reject_signals

BLOCK = 16384
"""Samples that are reduced by themselves."""

_DENSE = 4096  # those of a robot whose whole regressor is evaluated: 13 MB of 400 values each


@dataclass(frozen=True, eq=False)
class NonzeroPattern(ShortRepr):
    """Which columns can enter the rows of each joint; n joints, c columns.

    Attributes:
        columns: of each joint, ascending.
        width: c.
    """

    columns: tuple[np.ndarray, ...]
    width: int

    @cached_property
    def sizes(self) -> list[int]:
        """Returns the sizes of the packed triangles.

        Columns and torque, then zeros up to a multiple of 4.
        """
        return [(len(joint_columns) + 1 + 3) // 4 * 4 for joint_columns in self.columns]

    @cached_property
    def rows_of_entries(self) -> np.ndarray:
        """Returns (entries,) joint of each entry, joint after joint."""
        counts = [len(joint_columns) for joint_columns in self.columns]
        return np.repeat(np.arange(len(counts), dtype=np.intc), counts)

    @cached_property
    def spans(self) -> list[slice]:
        """Returns the columns of each joint from its first to its last; all others are 0."""
        return [
            slice(joint_columns[0], joint_columns[-1] + 1) if joint_columns.size else slice(0)
            for joint_columns in self.columns
        ]

    def split_triangles(self, packed: np.ndarray) -> list[np.ndarray]:
        """Returns the square triangle of each joint, views."""
        ends = np.cumsum([size * size for size in self.sizes])
        pairs = zip(np.split(packed, ends[:-1]), self.sizes, strict=True)
        return [part.reshape(size, size) for part, size in pairs]


def build_pattern(entries: Sequence[tuple[int, int]], joints: int, width: int) -> NonzeroPattern:
    """Returns the pattern of (joint, column) entries."""
    columns = [sorted(c for joint, c in entries if joint == j) for j in range(joints)]
    numbers = (np.array(entries, dtype=np.intc) for entries in columns)
    return NonzeroPattern(tuple(numbers), width)


@dataclass(frozen=True, eq=False)
class Triangles:
    """R of [W_j y_j] = Q R for the rows of each joint; n joints, c columns.

    Attributes:
        pattern: which columns each joint has.
        packed: the triangles over these columns only, one after another.
        rows: (n,) rows that were added.
        left_out: (samples,) of the last call: True where a row in use was not finite.
    """

    pattern: NonzeroPattern
    packed: np.ndarray
    rows: np.ndarray
    left_out: np.ndarray

    @property
    def triangles(self) -> np.ndarray:
        """Returns (n, c + 1, c + 1) over all columns and the torque.

        0 for columns a joint does not have.

        ||y_j - W_j beta|| = ||R_j [-beta; 1]||.
        """
        size = self.pattern.width + 1
        whole = np.zeros((len(self.rows), size, size))
        parts = self.pattern.split_triangles(self.packed)
        for triangle, columns, part in zip(whole, self.pattern.columns, parts, strict=True):
            places = np.append(columns, size - 1)
            triangle[np.ix_(places, places)] = part[: len(places), : len(places)]
        return whole


def make_empty_triangles(pattern: NonzeroPattern) -> Triangles:
    """Returns the triangles of no rows."""
    packed = np.zeros(sum(size * size for size in pattern.sizes))
    rows = np.zeros(len(pattern.columns), dtype=np.uintp)
    return Triangles(pattern, packed, rows, np.zeros(0, dtype=bool))


def reduce_samples(
    pattern: NonzeroPattern,
    functions: EntryFunctions,
    samples: SampleArrays,
    state: Triangles | None = None,
    level: int = 0,
) -> Triangles:
    """Reduces samples to triangles; a compiled function evaluates entries sample by sample.

    Args:
        pattern: of the entries, whose order is joint after joint.
        functions: that evaluate them.
        samples: checked arrays.
        state: of earlier samples, which these are added to.
        level: of instructions; 0: the best of this processor.
    """
    library = bind.load_fused_library()

    def reduce_block(block: slice) -> Triangles:
        triangles, part = make_empty_triangles(pattern), samples.select_block(block)
        rows = pattern.rows_of_entries
        bad = library.add_samples(rows, functions, part, level, triangles.packed, triangles.rows)
        return Triangles(pattern, triangles.packed, triangles.rows, bad)

    parts = map_parts(reduce_block, _split_blocks(len(samples.q), BLOCK))
    return _merge_blocks(library, pattern, parts, state)


def reduce_dense_samples(
    pattern: NonzeroPattern,
    evaluate: Callable[[slice], tuple[np.ndarray, np.ndarray]],
    samples: SampleArrays,
    state: Triangles | None = None,
) -> Triangles:
    """Reduces samples to triangles; the whole regressor is evaluated, some samples at a time.

    Args:
        pattern: of the entries.
        evaluate: (b, n, c) of the b samples of a block, and (b,) True where it has no value.
        samples: checked arrays.
        state: of earlier samples, which these are added to.
    """
    library = bind.load_fused_library()

    def reduce_block(block: slice) -> Triangles:
        phi, without = evaluate(block)
        part = samples.select_block(block)
        use = np.ones(part.tau.shape, dtype=bool) if part.use is None else part.use
        tau, known = part.tau, np.isfinite(phi).all(axis=2) & np.isfinite(part.tau)
        if part.weight is not None:
            phi, tau = phi * part.weight[:, :, None], tau * part.weight
            known &= np.isfinite(part.weight)
        left = (use & (~known | without[:, None])).any(axis=1)
        triangles = reduce_rows(pattern, phi, tau, use & ~left[:, None])
        return Triangles(pattern, triangles.packed, triangles.rows, left)

    parts = map_parts(reduce_block, _split_blocks(len(samples.q), _DENSE))
    return _merge_blocks(library, pattern, parts, state)


def reduce_rows(
    pattern: NonzeroPattern,
    phi: np.ndarray,
    y: np.ndarray,
    use: np.ndarray | None,
    state: Triangles | None = None,
    level: int = 0,
) -> Triangles:
    """Reduces rows that stand in memory to triangles.

    Args:
        pattern: which columns to use.
        phi: (b, n, c); copied unless C-contiguous.
        y: (b, n).
        use: (b, n) bool; None for all.
        state: of earlier rows, which these are added to.
        level: of instructions; 0: the best of this processor.
    """
    library = bind.load_fused_library()
    before = make_empty_triangles(pattern) if state is None else state
    packed, rows, phi = before.packed.copy(), before.rows.copy(), np.ascontiguousarray(phi)
    mask = None if use is None else use.view(np.uint8)
    triangles = zip(pattern.columns, pattern.split_triangles(packed), strict=True)
    for j, (columns, triangle) in enumerate(triangles):
        flags = None if mask is None else mask[:, j]
        added, _ = library.add_rows(phi[:, j], y[:, j], flags, columns, level, triangle)
        rows[j] += np.uintp(added)
    return Triangles(pattern, packed, rows, np.zeros(0, dtype=bool))


Weights = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Of all rows, their samples, and (rows + 1,) where each row's begin, as of a CSR matrix."""


def average_rows(
    weights: Weights,
    values: np.ndarray,
    usable: np.ndarray,
    used: np.ndarray,
    whole: np.ndarray,
    spans: Sequence[slice] | None = None,
    level: int = 0,
) -> np.ndarray:
    """Returns weighted means (rows, n, ...) of values (samples, n, ...), 0 without any sample.

    Args:
        weights: of the samples in the rows.
        values: n joints.
        usable: (samples, n) bool, which samples a row that is used averages.
        used: (rows, n) bool.
        whole: (samples,) bool, which ones another row averages.
        spans: of each joint, the columns that are averaged, the others are 0; None: all.
        level: of instructions; 0: the best of this processor.
    """
    values = np.ascontiguousarray(values, dtype=float)
    out = np.zeros((len(used), *values.shape[1:]))
    columns = int(np.prod(values.shape[2:], dtype=int))
    ends = [(s.start or 0, s.stop) for s in spans or [slice(columns)] * used.shape[1]]
    means = _prepare_means(weights, usable, used) | {"values": values}
    means |= {"whole": np.ascontiguousarray(whole), "span": np.array(ends, dtype=np.intc)}
    bind.load_fused_library().average_rows(means, level, out)
    return out


def _prepare_means(weights: Weights, usable: np.ndarray, used: np.ndarray) -> dict[str, np.ndarray]:
    weight, sample, start = weights
    integers = {"sample": sample, "start": start}
    flags = {"usable": usable, "used": used}
    means = {name: np.ascontiguousarray(array, np.intc) for name, array in integers.items()}
    means |= {name: np.ascontiguousarray(array, bool) for name, array in flags.items()}
    return means | {"weight": weight}


def _merge_blocks(
    library: FusedLibrary,
    pattern: NonzeroPattern,
    parts: Iterable[Triangles],
    state: Triangles | None,
) -> Triangles:
    """The rows of all parts, added to those of a state."""
    before = make_empty_triangles(pattern) if state is None else state
    packed, rows, left = before.packed.copy(), before.rows.copy(), [np.zeros(0, dtype=bool)]
    fresh = state is None
    for part in parts:
        if fresh:
            packed, fresh = part.packed, False
        else:
            library.merge_states(pattern.rows_of_entries, len(rows), packed, part.packed)
        rows += part.rows
        left.append(part.left_out)
    return Triangles(pattern, packed, rows, np.concatenate(left))


def _split_blocks(samples: int, size: int) -> list[slice]:
    return [slice(i, min(i + size, samples)) for i in range(0, samples, size)]


# Base regressors of many samples, by tiles: eight samples at once, in threads.
#
# What a sample gives depends on nothing but that sample, so neither do results depend on the number
# of threads. They are equal to those of the scalar functions but for roundings.


TILED_FROM = 2**18
"""Samples from which on tiles are used: fewer are sooner done than tiles are compiled."""

_SLICE = 2**14  # samples that a thread is worth starting for


def check_output(out: np.ndarray, shape: tuple[int, int], columns: bool = False) -> np.ndarray:
    """Checks that `out` can be filled and returns it; `columns`: it may be Fortran-contiguous too.

    Raises:
        ShapeError: says what it must be.
    """
    if not isinstance(out, np.ndarray) or out.shape != shape:
        got = out.shape if isinstance(out, np.ndarray) else type(out).__name__
        raise ShapeError(f"out: got {got}, expected an array {shape}")
    whole = out.flags.c_contiguous or (columns and out.flags.f_contiguous)
    if out.dtype != np.float64 or not whole or not out.flags.writeable:
        raise ShapeError(
            f"out: got type {out.dtype}, expected a writeable C-contiguous"
            f"{' (or Fortran-contiguous)' * columns} float64 array; "
            f"make one with np.empty({shape})"
        )
    return out


class BatchEvaluator:
    """What a compiled model makes of many samples; n samples, c base parameters."""

    spec: ModuleSpec
    _library: Library
    _functions: Mapping[str, FunctionSpec]
    _joints: int
    _tile_files: Mapping[str, str]

    def nonzeros(
        self, q: Any, qd: Any, qdd: Any, s: Any = None, out: np.ndarray | None = None
    ) -> np.ndarray:
        """Returns the entries of the base regressor that are not always 0, (n, len(spec.nonzeros)).

        values[:, k] = phi[:, joint, column] with (joint, column) = spec.nonzeros[k].

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            s: signals of effects, where there are any.
            out: is filled and returned if given.

        Raises:
            ManifestError: the robot has loops: all its entries can be something else than 0.
        """
        if self.spec.closure is not None:
            raise ManifestError(
                f"{self.spec.robot} has loops: every entry of its regressor can differ from 0; "
                "use base_regressor"
            )
        inputs = self._check_motion(q, qd, qdd, s)
        shape = (len(inputs[0]), len(self.spec.nonzeros))
        values = np.empty(shape) if out is None else check_output(out, shape)
        if not self._fill_by_tiles(inputs, values, dense=False):
            self._library.run_batch(self._functions["base_regressor_nonzeros"], inputs, values)
        return values

    def _fill_by_tiles(
        self,
        inputs: Sequence[np.ndarray],
        out: np.ndarray,
        dense: bool,
        status: np.ndarray | None = None,
    ) -> bool:
        """Fill `out` by tiles; False, and nothing done, for few samples or without tiles.

        With loops one sample starts from another: all in one thread, and `status` is filled.
        """
        samples, loops = len(inputs[0]), self.spec.closure is not None
        tiles = self._tiles if samples >= TILED_FROM else None
        if tiles is None or loops != (status is not None):
            return False
        each = len(out) // samples if out.ndim == 2 else 1  # rows of a sample

        def fill_part(piece: slice) -> None:
            rows = out[each * piece.start : each * piece.stop]
            tiles.fill_samples([array[piece] for array in inputs], rows, dense, status)

        parts = [slice(0, samples)] if loops else split_samples(samples, _SLICE)
        for _ in map_parts(fill_part, parts):
            pass
        return True

    @cached_property
    def _tiles(self) -> TileLibrary | None:
        """The library of tiles; None where there are none: in older files."""
        wanted = self.spec.tile_sources
        if not wanted or not all(name in self._tile_files for name in wanted):
            return None
        return bind.load_tile_library(self.spec, self._tile_files, self._library)

    def _check_motion(self, q: Any, qd: Any, qdd: Any, s: Any) -> tuple[np.ndarray, ...]:
        """Checked q, qd, qdd and, where effects read any, signals."""
        states = self._check_states({"q": q, "qd": qd, "qdd": qdd})
        signals = self._check_signals(s, len(states["q"]))
        return (*states.values(), *(() if signals is None else (signals,)))

    def _check_states(self, arrays: Mapping[str, Any]) -> dict[str, np.ndarray]:
        checked = {name: check_samples(a, name, self._joints) for name, a in arrays.items()}
        check_sample_counts(checked)
        return checked

    def _check_signals(self, s: Any, samples: int, finite: bool = True) -> np.ndarray | None:
        """(n, m) signals of effects; None where the robot has none, and must be given none."""
        wanted = len(self.spec.signals)
        if not wanted:
            reject_signals(s, self.spec.robot)
            return None
        if s is None:
            names = ", ".join(f"{x.kind} {x.joint}".strip() for x in self.spec.signals)
            raise ShapeError(f"{self.spec.robot}: its effects read signals; give s ({names})")
        checked = check_samples(s, "s", wanted, finite)
        if len(checked) != samples:
            raise ShapeError(f"s: got {len(checked)} samples, expected {samples} as of q")
        return checked

    # Least squares while samples pass: neither W nor a part of it is kept.

    def triangles(
        self,
        q: Any,
        qd: Any,
        qdd: Any,
        tau: Any,
        use: Any = None,
        s: Any = None,
        weight: Any = None,
        state: Triangles | None = None,
    ) -> Triangles:
        """Returns R of [W_j tau_j] = Q R for the rows of each joint, without W.

        By Householder reflections.

        The singular values of R are those of [W_j tau_j] up to rounding of the largest, also where
        W^T W has lost the small ones (Golub and Van Loan 2013, Matrix Computations, section 5.2).
        Of a joint's columns only those that can enter its torque take part. Results do not depend
        on the number of threads. Samples with a row in use that is not finite, or whose loops do
        not close, are left out and marked in the result.

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            tau: (n, joints) N m or N.
            use: (n, joints) rows to use, the others may hold anything; None: all.
            s: signals of effects, where there are any.
            weight: (n, joints) what a row and its torque are multiplied by, at least 0; None: 1.
            state: of earlier samples, which these are added to.

        Raises:
            ShapeError: an array of another shape, a weight in use that is negative or not finite,
                or the state of another robot.
        """
        pattern, width = self.pattern, len(self.spec.base)
        if state is not None:
            if not isinstance(state, Triangles):
                raise ShapeError(
                    f"state: got {type(state).__name__}, expected what `triangles` gave for "
                    "earlier samples, or None"
                )
            theirs = state.pattern.columns
            same = state.pattern.width == width and len(theirs) == len(pattern.columns)
            if not (same and all(map(np.array_equal, theirs, pattern.columns))):
                raise ShapeError(
                    f"state: got triangles of another robot ({len(theirs)} joints, "
                    f"{state.pattern.width} base parameters), expected those of {self.spec.robot} "
                    f"({len(pattern.columns)} joints, {width} base parameters)"
                )
        samples = self._check_measurements((q, qd, qdd, tau), use, s, weight)
        if self.has_entries:
            functions = self._get_entry_functions(len(samples.q))
            return reduce_samples(pattern, functions, samples, state)
        function = self._functions["base_regressor"]

        def evaluate_block(block: slice) -> tuple[np.ndarray, np.ndarray]:
            """Returns a block's base regressor, and where it has no value: loops may not close."""
            part = samples.select_block(block)
            out = np.zeros((len(part.q), *function.outputs[0].shape))
            status = np.zeros(len(out), dtype=np.intc)
            states = [array for array in (part.q, part.qd, part.qdd, part.s) if array is not None]
            self._library.run_batch(function, states, out, status if function.status else None)
            return out, status != 0

        return reduce_dense_samples(pattern, evaluate_block, samples, state)

    def mean_triangles(
        self,
        motion: tuple[np.ndarray, np.ndarray, np.ndarray],
        s: np.ndarray | None,
        torque: np.ndarray,
        weights: Weights,
        usable: np.ndarray,
        used: np.ndarray,
        state: Triangles,
    ) -> Triangles:
        """Returns triangles with rows added that are means of those of samples, as `average_rows`.

        Only of a robot that `has_entries`.

        Args:
            motion: q, qd, qdd of the samples.
            s: signals of effects, where there are any.
            torque: (rows, n) of the rows.
            weights: of the samples in the rows.
            usable: (samples, n) bool.
            used: (rows, n) bool, which rows are added.
            state: before.
        """
        packed, rows = state.packed.copy(), state.rows.copy()
        q, qd, qdd, tau = (np.ascontiguousarray(x, dtype=float) for x in (*motion, torque))
        samples = SampleArrays(q, qd, qdd, tau, self._check_signals(s, len(q)), None, None)
        pattern, means = state.pattern, _prepare_means(weights, usable, used)
        functions = self._get_entry_functions(0)
        library = bind.load_fused_library()
        library.add_means(pattern.rows_of_entries, functions, samples, means, 0, packed, rows)
        return Triangles(pattern, packed, rows, np.zeros(0, dtype=bool))

    @property
    def has_entries(self) -> bool:
        """Returns True if a function evaluates the entries of its regressor that are not 0."""
        return self.spec.closure is None and self.spec.precision == "double"

    def _check_measurements(
        self, motion: tuple[Any, Any, Any, Any], use: Any, s: Any, weight: Any
    ) -> SampleArrays:
        """Checked arrays; but for weights in use they may be not finite."""
        wanted = dict(zip(("q", "qd", "qdd", "tau"), motion, strict=True))
        wanted |= {} if weight is None else {"weight": weight}
        arrays = {
            name: check_samples(value, name, self._joints, finite=False)
            for name, value in wanted.items()
        }
        samples = check_sample_counts(arrays)
        rows = None if use is None else check_mask(use, "use", (samples, self._joints))
        read = self._check_signals(s, samples, False)
        if weight is not None:
            values, used = arrays["weight"], True if rows is None else rows
            wrong = np.argwhere(~(np.isfinite(values) & (values >= 0.0)) & used)
            if len(wrong):
                row, column = (int(i) for i in wrong[0])
                raise ShapeError(
                    f"weight: got {values[row, column]} in row {row}, column {column} (counted "
                    "from 0), expected finite numbers, at least 0"
                )
        q, qd, qdd, tau = (arrays[name] for name in ("q", "qd", "qdd", "tau"))
        return SampleArrays(q, qd, qdd, tau, read, rows, arrays.get("weight"))

    def _get_entry_functions(self, samples: int) -> EntryFunctions:
        name = f"{self.spec.prefix}_base_regressor_nonzeros"
        tiles = self._tiles if samples >= TILED_FROM else None  # compiled where there are many
        self._functions[name.removeprefix(f"{self.spec.prefix}_")]
        address = self._library.find_address(name)
        tile = 0 if tiles is None else tiles.tile_address
        return EntryFunctions(address, len(self.spec.signals), tile)

    @cached_property
    def pattern(self) -> NonzeroPattern:
        """Returns which columns can enter the torque of each joint."""
        return build_pattern(self.spec.nonzeros, self._joints, len(self.spec.base))
