"""The library's functions, declared from the manifest; nothing else knows cffi."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cffi
import numpy as np

from modeler.core.contract import FunctionSpec, ModuleSpec
from modeler.core.errors import BuildError, ManifestError

FUNCTIONS = {
    "regressor": 3, "base_regressor": 3, "base_regressor_nonzeros": 3, "inverse_dynamics": 4,
    "inertia_matrix": 2, "gravity": 2, "coriolis": 3, "friction": 2, "base_parameters": 1,
    "forward_kinematics": 1,
}  # fmt: skip
"""Functions that every module has, and how many inputs they read."""

_RUNTIME = """
typedef struct { const double *data; size_t step; } modeler_input;
void modeler_batch_1(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_2(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_3(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_4(void *, size_t, const modeler_input *, double *, size_t);
"""


class Library:
    """A loaded library; its functions release the interpreter lock and may run in threads.

    Attributes:
        spec: the manifest it belongs to.
    """

    def __init__(self, spec: ModuleSpec, path: Path) -> None:
        """Load the library at `path`.

        Raises:
            BuildError: it cannot be loaded.
            ManifestError: it was emitted with another manifest.
        """
        self.spec = spec
        self._ffi = cffi.FFI()
        self._ffi.cdef(_RUNTIME + _declarations(spec))
        try:
            self._library: Any = self._ffi.dlopen(str(path))
            self._check()
        except OSError as error:
            raise BuildError(
                f"{path}: the compiled library cannot be loaded ({error}); delete it and try again"
            ) from error
        except AttributeError as error:
            raise ManifestError(
                f"{spec.robot}: the compiled code lacks what its manifest names ({error}); "
                "generate both again"
            ) from error

    def _check(self) -> None:
        answer = self._ffi.string(self._function("signature")()).decode()
        if answer != self.spec.signature():
            raise ManifestError(
                f"{self.spec.robot}: the compiled code answers {answer}, the manifest expects "
                f"{self.spec.signature()}; one of them is older, generate both again"
            )
        for function in self.spec.functions:
            getattr(self._library, function.name)

    def _function(self, role: str) -> Any:
        return getattr(self._library, f"{self.spec.prefix}_{role}")

    def batch(self, function: FunctionSpec, inputs: Sequence[np.ndarray], out: np.ndarray) -> None:
        """Call `function` for every sample.

        Args:
            function: of the manifest, with 1 to 4 inputs.
            inputs: C-contiguous float64; (n, length) per sample, or (length,) the same for all.
            out: C-contiguous float64, (n, ...).
        """
        assert len(inputs) == len(function.inputs) and len(inputs) in (1, 2, 3, 4)
        given = self._ffi.new("modeler_input[]", len(inputs))
        for place, array in zip(given, inputs, strict=True):
            assert array.flags.c_contiguous and array.dtype == np.float64
            place.data = self._doubles(array)
            place.step = array.shape[1] if array.ndim == 2 else 0
        samples = len(out)
        step = out.size // samples if samples else 0
        driver = getattr(self._library, f"modeler_batch_{len(inputs)}")
        pointer = self._ffi.cast("void *", getattr(self._library, function.name))
        driver(pointer, samples, given, self._doubles(out), step)

    def observation(self, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, W: np.ndarray) -> None:
        """Fill W, (n*joints, columns), from (n, joints) arrays."""
        states = [self._doubles(array) for array in (q, qd, qdd)]
        self._function("observation")(len(q), *states, self._doubles(W))

    def base_parameters(self, function: FunctionSpec, chi: np.ndarray, beta: np.ndarray) -> None:
        """Fill beta from chi by the grouping relations."""
        getattr(self._library, function.name)(self._doubles(chi), self._doubles(beta))

    def _doubles(self, array: np.ndarray) -> Any:
        # The address itself: half the time of from_buffer; the caller holds the array.
        return self._ffi.cast("double *", array.ctypes.data)


def check_names(spec: ModuleSpec) -> None:
    """Refuse manifests whose functions could not be declared, or that lack one.

    Files are named after the prefix, so this comes before any is read or written.

    Raises:
        ManifestError: a name is no C name, or a function is missing.
    """
    inputs = {function.name: len(function.inputs) for function in spec.functions}
    for name in (spec.prefix, *inputs):
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
            raise ManifestError(f'{spec.robot}: got the name "{name}", expected a C name')
    for role, count in FUNCTIONS.items():
        got = inputs.get(f"{spec.prefix}_{role}")
        if got != count:
            raise ManifestError(
                f"{spec.robot}: the manifest names {got or 'no'} inputs of {role}, expected "
                f"{count}; generate it again"
            )


def _declarations(spec: ModuleSpec) -> str:
    lines = [
        f"const char *{spec.prefix}_signature(void);",
        f"void {spec.prefix}_observation(size_t, const double *, const double *, const double *, "
        "double *);",
    ]
    for function in spec.functions:
        inputs = ", ".join("const double *" for _ in function.inputs)
        lines.append(f"void {function.name}({inputs}, double *);")
    return "\n".join(lines)
