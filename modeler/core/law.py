"""A law that was learned: a smooth function of one or two quantities, given by a table.

With u = (x - low) (cells / (high - low)), held within 0 and `cells`, k the cell and f = u - k,

    law(x) = sum_m w_m(f) c[k + m],   m = 0 ... 3,
    w = ((1 - f)^3, 3 f^3 - 6 f^2 + 4, -3 f^3 + 3 f^2 + 3 f + 1, f^3) / 6,

the uniform cubic B-spline (de Boor 1978); of two quantities the tensor product. Where the three
coefficients at an end are equal it comes to rest there, so that it goes on beyond without a kink:
it is held, never extrapolated.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

BESIDE = 3
"""Coefficients along an axis more than cells."""

MOST = 10_000
"""Coefficients of a law."""


@dataclass(frozen=True)
class Law:
    """A table of one or two quantities; d axes.

    Attributes:
        low, high: (d,) ends of each axis, SI.
        cells: (d,) of equal width.
        values: (prod(cells + 3),) coefficients, the last axis first.
    """

    low: tuple[float, ...]
    high: tuple[float, ...]
    cells: tuple[int, ...]
    values: tuple[float, ...] = field(repr=False)

    @property
    def scales(self) -> tuple[float, ...]:
        """Cells per unit, by axis."""
        ends = zip(self.low, self.high, self.cells, strict=True)
        return tuple(count / (high - low) for low, high, count in ends)

    @cached_property
    def coefficients(self) -> "np.ndarray":
        """(cells + 3, ...) by axis."""
        import numpy as np  # robot files without laws do without it

        return np.array(self.values).reshape([count + BESIDE for count in self.cells])

    def __call__(self, *x: "np.ndarray | float", along: int | None = None) -> "np.ndarray":
        """Its values at x, arrays of one shape; not a number where one of x is not finite.

        Args:
            x: one for each axis.
            along: the derivative along this axis; None: the law itself.
        """
        import numpy as np

        every = np.broadcast_arrays(*x)
        places = [
            self.locate_cells(axis, points, along == axis) for axis, points in enumerate(every)
        ]
        total = np.zeros(every[0].shape)
        if len(places) == 1:
            ((k, weights),) = places
            for m, weight in enumerate(weights):
                total += weight * self.coefficients[k + m]
            return total
        (k, first), (l, second) = places
        for m, weight in enumerate(first):
            inner = sum(w * self.coefficients[k + m, l + n] for n, w in enumerate(second))
            total += weight * inner
        return total

    def locate_cells(
        self, axis: int, x: "np.ndarray", slope: bool = False
    ) -> tuple["np.ndarray", Sequence["np.ndarray"]]:
        """The cell of each x (n,), and the weights of its four coefficients, or their slopes."""
        import numpy as np

        scale, count = self.scales[axis], self.cells[axis]
        free = (x - self.low[axis]) * scale
        u = np.clip(free, 0.0, count)
        k = np.minimum(np.where(np.isnan(u), 0.0, u).astype(int), count - 1)
        with np.errstate(invalid="ignore"):
            f = u - k + (x - x)
        if not slope:
            return k, _compute_weights(f)
        rate = np.where(u == free, scale, 0.0)  # beyond the ends it is held
        return k, [rate * w for w in _compute_slopes(f)]


def _compute_weights(f: "np.ndarray") -> tuple["np.ndarray", ...]:
    g = 1.0 - f
    f2 = f * f
    first, last = g * g * g / 6.0, f2 * f / 6.0
    second = 2.0 / 3.0 - f2 + 0.5 * f2 * f
    return first, second, 1.0 - first - second - last, last


def _compute_slopes(f: "np.ndarray") -> tuple["np.ndarray", ...]:
    """Derivatives of the weights by f."""
    g = 1.0 - f
    first, second, last = -0.5 * g * g, f * (1.5 * f - 2.0), 0.5 * f * f
    return first, second, -first - second - last, last
