"""Least squares of a compiled model while samples pass: neither W nor a part of it is kept."""

from collections.abc import Mapping
from functools import cached_property, partial
from typing import Any

import numpy as np

from modeler.compiled.bind import Library
from modeler.compiled.bind_fused import Functions, Samples
from modeler.compiled.fused import (
    Pattern,
    Triangles,
    of_dense,
    of_samples,
    pattern_of,
    products_of_samples,
)
from modeler.core.checks import as_mask, as_samples, same_samples
from modeler.core.contract import FunctionSpec, ModuleSpec
from modeler.core.errors import ManifestError


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
            weight: (n, joints) what a row and its torque are multiplied by; None: 1.
            state: of earlier samples, which these are added to.
        """
        given = self._measured((q, qd, qdd, tau, weight), use, s)
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
            last: (joints,) largest k of each joint, at most `compiled.fused.PAST`.
            use: (n, joints) rows to use; None: all.
            s: signals of effects, where there are any.
            first: smallest k.

        Raises:
            ManifestError: the robot has loops, or its C is in single precision.
        """
        if not self.emits_entries:
            raise ManifestError(
                f"{self.spec.robot}: products of rows need the entries of the base regressor in "
                "double precision, which this C has not; use triangles"
            )
        given = self._measured((q, qd, qdd, tau, None), use, s)
        entries = self._entries(len(given.q))
        return products_of_samples(self.pattern, entries, given, np.asarray(last), first)

    def _measured(self, values: tuple[Any, Any, Any, Any, Any], use: Any, s: Any) -> Samples:
        """Checked arrays; values may be not finite, and the last of them None."""
        names = ("q", "qd", "qdd", "tau", "weight")
        arrays = {
            name: as_samples(value, name, self._joints, finite=False)
            for name, value in zip(names, values, strict=True)
            if value is not None
        }
        samples = same_samples(arrays)
        rows = None if use is None else as_mask(use, "use", (samples, self._joints))
        read = self._signals(s, samples, False)
        q, qd, qdd, tau = (arrays[name] for name in names[:4])
        return Samples(q, qd, qdd, tau, read, rows, arrays.get("weight"))

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
