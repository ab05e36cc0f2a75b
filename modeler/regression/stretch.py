"""One segment with its parallel filter: anything of the full rate becomes rows through here."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from modeler.core.brief import ShortRepr
from modeler.numerics.filters import LEAST_WEIGHT, RowFilter, build_row_filter, choose_row_spacing
from modeler.regression.low_speed import FrictionShaft, find_moving_samples
from modeler.regression.motion import Segment
from modeler.regression.settings import ChosenProcessing

_BLOCK = 20_000  # samples evaluated at a time: 20 000 x 7 joints x 60 columns is 67 MB


@dataclass(frozen=True, eq=False)
class FilteredSegment(ShortRepr):
    """A segment, its usable samples and its filter.

    Attributes:
        segment: full-rate motion and torque.
        usable: (samples, joints) samples that count.
        rows: the parallel filter.
        used: (rows, joints) rows with enough usable samples.
    """

    segment: Segment
    usable: np.ndarray
    rows: RowFilter
    used: np.ndarray

    def thin_samples(self, every: int, read: np.ndarray | None) -> "FilteredSegment":
        """The same rows by every so manieth sample; `read` (samples, m) is what effects read."""
        weights = csr_array(self.rows.weights[:, ::every])
        rows = RowFilter(weights, self.rows.centres // every)
        usable = self.usable[::every].copy()
        return FilteredSegment(self.segment.thin_samples(every, read), usable, rows, self.used)

    @property
    def decimation(self) -> int:
        """Samples from one row to the next; 1 where there are no two."""
        centres = self.rows.centres
        return int(centres[1] - centres[0]) if len(centres) > 1 else 1

    def filter_columns(self, evaluate: Callable[[slice], np.ndarray]) -> np.ndarray:
        """Filtered columns (rows, joints, ...) of evaluate(window) -> (window, joints, ...).

        Evaluated in blocks, so that a long log needs no more memory than a short one.
        """
        return np.concatenate([values for _, values in self.iterate_blocks(evaluate)])

    def iterate_blocks(
        self,
        evaluate: Callable[[slice], np.ndarray],
        samples: int = _BLOCK,
        spans: Sequence[slice] | None = None,
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """The same, about so many samples at a time: which rows, and their values.

        Args:
            evaluate: as of `filter_columns`.
            samples: of a block.
            spans: of each joint, the columns that are not 0; None: all.
        """
        for part, window, rows in self.iterate_parts(samples):
            yield rows, self._compute_means(part, evaluate(window), window, self.used[rows], spans)

    def filter_rows(
        self, rows: np.ndarray, evaluate: Callable[[np.ndarray], np.ndarray]
    ) -> np.ndarray:
        """(m, joints, ...) the same of some rows (m,), of the samples (b,) that they reach."""
        blocks, most = list[np.ndarray](), max(1, int(np.diff(self.rows.weights.indptr).max()))
        for some in np.array_split(rows, -(-len(rows) * most // _BLOCK)):
            weights = self.rows.weights[some]
            reached = np.unique(weights.indices)
            part = RowFilter(csr_array(weights[:, reached]), self.rows.centres[some])
            blocks.append(self._compute_means(part, evaluate(reached), reached, self.used[some]))
        return np.concatenate(blocks)

    def filter_torque(self) -> np.ndarray:
        """(rows, joints) filtered torque."""
        return self.filter_columns(lambda window: self.segment.tau[window])

    def iterate_parts(self, samples: int = _BLOCK) -> Iterator[tuple[RowFilter, slice, slice]]:
        """Filters of a few rows each, the samples that they reach, and which rows they are."""
        total, count = len(self.rows.centres), max(1, samples // self.decimation)
        for first in range(0, total, count):
            rows = slice(first, min(first + count, total))
            window = self.rows.find_sample_range(rows)
            yield self.rows.extract_rows(rows, window), window, rows

    def _compute_means(
        self, part: RowFilter, values: np.ndarray, window: slice | np.ndarray, used: np.ndarray,
        spans: Sequence[slice] | None = None,
    ) -> np.ndarray:  # fmt: skip
        """Means over usable samples where the row counts, over all whole samples elsewhere."""
        result = np.zeros((len(used), *values.shape[1:]))
        for j in range(values.shape[1]):
            index = (slice(None), j) if spans is None else (slice(None), j, spans[j])
            result[index] = part.average_samples(
                values[index], self.usable[window, j], used[:, j], self.segment.whole[window]
            )
        return result


def filter_segment(
    segment: Segment, shafts: Sequence[FrictionShaft], processing: ChosenProcessing,
    centres: np.ndarray | None = None,
) -> FilteredSegment:  # fmt: skip
    """The segment with its filter; rows with half of their weight on usable samples count.

    Args:
        segment: of a log, or of a chunk of one.
        shafts: whose low speeds do not count.
        processing: of it.
        centres: (rows,) samples in the middle of the rows; None: as of a whole log.
    """
    cutoff = processing.parallel_cutoff
    usable = segment.valid & find_moving_samples(segment, shafts, processing.speed_floors)
    if centres is None:
        centres = choose_row_centres(
            segment, choose_row_spacing(segment.step, cutoff, processing.decimation)
        )
    rows = build_row_filter(centres, segment.samples, segment.step, cutoff)
    return FilteredSegment(segment, usable, rows, rows.compute_usable_share(usable) >= LEAST_WEIGHT)


def choose_row_centres(segment: Segment, every: int) -> np.ndarray:
    """(rows,) samples in the middle of the rows of a segment, so many samples apart."""
    inside = np.flatnonzero(segment.whole)
    return inside[(len(inside) - 1) % every // 2 :: every]
