"""The base regressor of a robot on a graphics processor, through CuPy; nothing else knows CuPy.

CuPy is an optional part: `pip install "modeler-robotics[gpu]"`. The kernels are compiled for
the processor at hand when they are first requested.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from modeler.core.errors import BuildError, ManifestError, ShapeError, suggest_install
from modeler.core.manifest import CUDA_THREADS, EmittedModule, ModuleSpec
from modeler.runtime.checks import check_mask, check_sample_counts, check_samples, reject_signals

_BLOCKS = 1024
"""Blocks that sum products, at most: fixed, so that sums do not depend on the processor."""

_FEWEST = 32
"""Samples that such a block takes at least."""


class GpuModel:
    """tau = phi beta over n samples, on the graphics processor.

    q, qd, qdd, tau are (n, joints) in the order of `spec.joints`, SI units, as numpy or CuPy
    arrays: what is there already is not copied. All methods raise ShapeError for arrays of another
    shape or with values that are not finite.

    Attributes:
        spec: the manifest.
    """

    def __init__(self, spec: ModuleSpec, source: str) -> None:
        """Compiles the kernels.

        Raises:
            BuildError: no CuPy, no graphics processor, or the compiler refused.
        """
        self.spec = spec
        self._cupy = _import_cupy()
        try:
            module = self._cupy.RawModule(code=source)
            self._nonzeros, self._gram = (
                module.get_function(f"{spec.prefix}_{name}_kernel") for name in ("nonzeros", "gram")
            )
        except Exception as error:  # CuPy has classes of its own for what the compiler says
            raise BuildError(f"GPU: the emitted kernels do not compile:\n{error}") from None

    def nonzeros(self, q: Any, qd: Any, qdd: Any, s: Any = None) -> Any:
        """Returns entries of the base regressor that are not always 0, a CuPy array (nonzeros, n).

        Row k holds phi[i, joint, column] of all samples i with (joint, column) =
        `spec.nonzeros[k]`.
        """
        states = self._transfer_states({"q": q, "qd": qd, "qdd": qdd}, s)
        samples = len(states[0])
        values = self._cupy.empty((len(self.spec.nonzeros), samples))
        if samples:
            blocks = -(-samples // CUDA_THREADS)
            size = np.uint64(samples)
            self._nonzeros((blocks,), (CUDA_THREADS,), (size, *states, values, size))
        return values

    def gram(
        self, q: Any, qd: Any, qdd: Any, tau: Any, use: Any = None, s: Any = None
    ) -> list[np.ndarray]:
        """Returns [W_j tau_j]' [W_j tau_j] of every joint j, summed over samples, without a W.

        W_j has the columns `columns[j]`, those that can enter the torque of joint j; the last row
        and column are those of tau. It loses half of the digits of a QR decomposition: a condition
        number of W above 1e7 leaves nothing of the weakest direction.

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            tau: torques.
            use: (n, joints) False for rows that are left out.
            s: signals of effects, where there are any.
        """
        states = self._transfer_states({"q": q, "qd": qd, "qdd": qdd, "tau": tau}, s)
        samples, cupy = len(states[0]), self._cupy
        if use is not None:
            mask = check_mask(_copy_to_host(use), "use", (samples, len(self.spec.joints)))
            use = cupy.asarray(mask.astype(np.uint8))
        torque = states.pop(3)
        sizes = [len(columns) + 1 for columns in self.columns]
        products = sum(size * (size + 1) // 2 for size in sizes)
        blocks = min(_BLOCKS, -(-samples // _FEWEST))
        sums = cupy.zeros((max(blocks, 1), products))
        if samples:
            # A number in the place of an address: 0 is NULL.
            arguments = (*states, torque, np.uint64(0) if use is None else use)
            self._gram((blocks,), (CUDA_THREADS,), (np.uint64(samples), *arguments, sums))
        return _unpack_squares(_copy_to_host(sums.sum(axis=0)), sizes)

    @property
    def columns(self) -> tuple[tuple[int, ...], ...]:
        """Returns columns of the base regressor that can enter the torque of each joint."""
        joints = range(len(self.spec.joints))
        return tuple(tuple(c for row, c in self.spec.nonzeros if row == joint) for joint in joints)

    def _transfer_states(self, arrays: dict[str, Any], s: Any) -> list[Any]:
        """The arrays on the processor, then the signals if there are any."""
        joints, signals = len(self.spec.joints), len(self.spec.signals)
        if not signals:
            reject_signals(s, self.spec.robot)
        elif s is None:
            raise ShapeError(f"{self.spec.robot}: its effects read signals; give s")
        wanted = {name: (array, joints) for name, array in arrays.items()}
        wanted |= {"s": (s, signals)} if signals else {}
        transferred = {
            name: self._transfer_array(*array_and_width, name=name)
            for name, array_and_width in wanted.items()
        }
        check_sample_counts(transferred)
        order = [name for name in ("q", "qd", "qdd", "tau", "s") if name in transferred]
        return [transferred[name] for name in order]

    def _transfer_array(self, value: Any, width: int, name: str) -> Any:
        cupy = self._cupy
        if not hasattr(value, "__cuda_array_interface__"):
            return cupy.asarray(check_samples(value, name, width))
        array = cupy.ascontiguousarray(value, dtype=np.float64)
        if array.ndim != 2 or array.shape[1] != width:
            raise ShapeError(f"{name}: got shape {array.shape}, expected (samples, {width})")
        if not bool(cupy.isfinite(array).all()):
            raise ShapeError(f"{name}: got values that are not finite; leave such samples out")
        return array


def load_gpu(emitted: EmittedModule) -> GpuModel:
    """Returns the kernels of a module, compiled for the graphics processor of this machine.

    Raises:
        ManifestError: the module was emitted without them.
        BuildError: no CuPy, no graphics processor, or the compiler refused.
    """
    source = emitted.files.get(f"{emitted.spec.prefix}.cu")
    if source is None:
        raise ManifestError(
            f"{emitted.spec.robot}: the module has no {emitted.spec.prefix}.cu; generate it with "
            "cuda=True"
        )
    return GpuModel(emitted.spec, source)


def _import_cupy() -> Any:
    """CuPy, if there is one and it finds a processor."""
    try:
        import cupy
    except ImportError:
        raise BuildError(f"GPU: CuPy is not installed; {suggest_install('gpu')}") from None
    try:
        count = cupy.cuda.runtime.getDeviceCount()
    except Exception as error:  # of CUDA, with a class of its own
        raise BuildError(
            f"GPU: CuPy finds none ({str(error).splitlines()[0]}); use compile_model, which needs "
            "none"
        ) from None
    if not count:
        raise BuildError("GPU: CuPy finds none; use compile_model, which needs none")
    return cupy


def _copy_to_host(array: Any) -> np.ndarray:
    return np.asarray(array.get() if hasattr(array, "get") else array)


def _unpack_squares(products: np.ndarray, sizes: Sequence[int]) -> list[np.ndarray]:
    """Symmetric matrices of their upper triangles, one after another."""
    squares, start = [], 0
    for size in sizes:
        rows, columns = np.triu_indices(size)
        square = np.zeros((size, size))
        square[rows, columns] = products[start : start + len(rows)]
        square[columns, rows] = square[rows, columns]
        squares.append(square)
        start += len(rows)
    return squares
