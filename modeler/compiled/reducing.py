"""Least squares of a compiled model while samples pass: neither W nor a part of it is kept."""

from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from numbers import Integral
from typing import Any

import numpy as np

from modeler.compiled.bind import Library
from modeler.compiled.bind_fused import Functions, Samples
from modeler.compiled.fused import (
    PAST,
    Pattern,
    Triangles,
    of_dense,
    of_samples,
    pattern_of,
    products_of_samples,
)
from modeler.core.checks import as_mask, as_samples, same_samples
from modeler.core.contract import FunctionSpec, ModuleSpec
from modeler.core.errors import ManifestError, ShapeError


class Reducing:
    """What a compiled model makes of y = W beta without W; n samples, c base parameters."""

    spec: ModuleSpec
    _library: Library
    _functions: Mapping[str, FunctionSpec]
    _joints: int

    def triangles(
        self, q: Any, qd: Any, qdd: Any, tau: Any, use: Any = None, s: Any = None,
        weight: Any = None, state: Triangles | None = None,
    ) -> Triangles:  # fmt: skip
        """R of [W_j tau_j] = Q R for the rows of each joint, without W, by Householder reflections.

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
        if state is not None:
            self._check_state(state)
        given = self._measured((q, qd, qdd, tau), use, s, weight)
        if not self.emits_entries:
            return of_dense(self.pattern, partial(self._dense, given), given, state)
        return of_samples(self.pattern, self._entries(len(given.q)), given, state)

    def products(
        self, q: Any, qd: Any, qdd: Any, tau: Any, last: Any, use: Any = None, s: Any = None,
        first: int = 0,
    ) -> list[np.ndarray]:  # fmt: skip
        """Sums over t of x_j(t - k) x_j(t)^T, x_j = [W_j tau_j], k = first .. last_j, without W.

        (last_j - first + 1, c_j + 1, c_j + 1) for each joint, over the columns that can enter its
        torque. k = 0 is the Gram matrix, half the work of triangles and half their digits. Samples
        are one step apart; rows out of use count as zeros, as do those of samples that are not
        finite.

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            tau: (n, joints) N m or N.
            last: (joints,) largest k of each joint, from 0 to `compiled.fused.PAST`.
            use: (n, joints) rows to use; None: all.
            s: signals of effects, where there are any.
            first: smallest k, from 0.

        Raises:
            ShapeError: an array of another shape, or k that cannot be.
            ManifestError: the robot has loops, or its C is in single precision.
        """
        if not self.emits_entries:
            raise ManifestError(
                f"{self.spec.robot}: products of rows need the entries of the base regressor in "
                "double precision, which this C has not; use triangles"
            )
        given, steps = self._measured((q, qd, qdd, tau), use, s), _steps(last, self._joints)
        if not isinstance(first, Integral) or first < 0:
            raise ShapeError(f"first: got {first!r}, expected a whole number of samples, from 0")
        entries = self._entries(len(given.q))
        return products_of_samples(self.pattern, entries, given, steps, int(first))

    def _measured(
        self, values: tuple[Any, Any, Any, Any], use: Any, s: Any, weight: Any = None
    ) -> Samples:
        """Checked arrays; but for weights in use they may be not finite."""
        wanted = dict(zip(("q", "qd", "qdd", "tau"), values, strict=True))
        wanted |= {} if weight is None else {"weight": weight}
        arrays = {
            name: as_samples(value, name, self._joints, finite=False)
            for name, value in wanted.items()
        }
        samples = same_samples(arrays)
        rows = None if use is None else as_mask(use, "use", (samples, self._joints))
        read = self._signals(s, samples, False)
        if weight is not None:
            _check_weight(arrays["weight"], rows)
        q, qd, qdd, tau = (arrays[name] for name in ("q", "qd", "qdd", "tau"))
        return Samples(q, qd, qdd, tau, read, rows, arrays.get("weight"))

    def _check_state(self, state: Any) -> None:
        """Refuses what is no state, or has other columns than this robot."""
        if not isinstance(state, Triangles):
            raise ShapeError(
                f"state: got {type(state).__name__}, expected what `triangles` gave for earlier "
                "samples, or None"
            )
        own, given = self.pattern, state.pattern
        if given.width != own.width or not _same(given.columns, own.columns):
            raise ShapeError(
                f"state: got triangles of another robot ({len(given.columns)} joints, "
                f"{given.width} base parameters), expected those of {self.spec.robot} "
                f"({len(own.columns)} joints, {own.width} base parameters)"
            )

    def _entries(self, samples: int) -> Functions:
        name = f"{self.spec.prefix}_base_regressor_nonzeros"
        tile = self._tile(samples)
        return Functions(self._library.address(name), len(self.spec.signals), tile)

    @cached_property
    def pattern(self) -> Pattern:
        """Which columns can enter the torque of each joint."""
        return pattern_of(self.spec.nonzeros, self._joints, len(self.spec.base))

    @property
    def emits_entries(self) -> bool:
        """True if the C has the entries of the base regressor alone, in double precision."""
        return self.spec.closure is None and self.spec.precision == "double"

    def _dense(self, given: Samples, block: slice) -> tuple[np.ndarray, np.ndarray]:
        """The base regressor of a block, and where it has no value: loops may not close."""
        function, part = self._functions["base_regressor"], given.part(block)
        out = np.zeros((len(part.q), *function.outputs[0].shape))
        status = np.zeros(len(out), dtype=np.intc)
        states = [array for array in (part.q, part.qd, part.qdd, part.s) if array is not None]
        self._library.batch(function, states, out, status if function.status else None)
        return out, status != 0

    def _tile(self, samples: int) -> int:
        raise NotImplementedError

    def _signals(self, s: Any, samples: int, finite: bool = True) -> np.ndarray | None:
        raise NotImplementedError


def _check_weight(weight: np.ndarray, use: np.ndarray | None) -> None:
    """Refuses weights of rows in use that are negative or not finite."""
    wrong = ~(np.isfinite(weight) & (weight >= 0.0))
    if use is not None:
        wrong &= use
    if wrong.any():
        row, column = (int(i) for i in np.argwhere(wrong)[0])
        raise ShapeError(
            f"weight: got {weight[row, column]} in row {row}, column {column} (counted from 0), "
            "expected finite numbers, at least 0"
        )


def _steps(last: Any, joints: int) -> np.ndarray:
    """`last` as whole numbers from 0 to PAST, one of each joint."""
    steps = np.asarray(last)
    if steps.shape != (joints,) or steps.dtype.kind not in "iu":
        raise ShapeError(f"last: got {last!r}, expected {joints} whole numbers, one of each joint")
    if steps.min(initial=0) < 0 or steps.max(initial=0) > PAST:
        raise ShapeError(f"last: got {steps.tolist()}, expected numbers from 0 to {PAST}")
    return steps


def _same(given: Sequence[np.ndarray], own: Sequence[np.ndarray]) -> bool:
    return len(given) == len(own) and all(map(np.array_equal, given, own))
