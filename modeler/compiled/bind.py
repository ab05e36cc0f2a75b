"""The library's functions, declared from the manifest; with bind_fused.py all that knows cffi."""

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

LOOP_FUNCTIONS = {
    **{role: count for role, count in FUNCTIONS.items() if role != "base_regressor_nonzeros"},
    "friction": 3, "close": 1, "close_from": 2, "coupling": 1,
}  # fmt: skip
"""Those of a robot with loops."""

PLATFORM_FUNCTIONS = {
    "platform_base_regressor": 3, "platform_inverse_dynamics": 4, "platform_close": 1,
    "platform_close_from": 2, "platform_coupling": 1,
}  # fmt: skip
"""Those of a robot with loops and a platform besides."""

READ_SIGNALS = ("regressor", "base_regressor", "base_regressor_nonzeros", "inverse_dynamics")
"""Functions with one input more where effects read signals."""

_RUNTIME = """
typedef struct { const double *data; size_t step; } modeler_input;
void modeler_batch_1(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_2(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_3(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_4(void *, size_t, const modeler_input *, double *, size_t);
void modeler_batch_5(void *, size_t, const modeler_input *, double *, size_t);
"""

_LOOP_RUNTIME = """
void modeler_batch_status_1(void *, size_t, const modeler_input *, double *, size_t, int *);
void modeler_batch_status_2(void *, size_t, const modeler_input *, double *, size_t, int *);
void modeler_batch_status_3(void *, size_t, const modeler_input *, double *, size_t, int *);
void modeler_batch_status_4(void *, size_t, const modeler_input *, double *, size_t, int *);
"""


class Library:
    """A loaded library; its functions release the interpreter lock and may run in threads.

    Arrays are float64 here, whatever the precision of the code: that in single precision is given
    copies in float32, and its results are copied back.

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
        self._single = spec.precision == "single"
        loops = _LOOP_RUNTIME if spec.closure is not None else ""
        declared = _RUNTIME + loops + _declarations(spec)
        self._ffi.cdef(_in_single(declared) if self._single else declared)
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

    def address(self, name: str) -> int:
        """Where a function of the library stands, for C that calls it; the caller holds this."""
        return int(self._ffi.cast("uintptr_t", getattr(self._library, name)))

    def batch(
        self,
        function: FunctionSpec,
        inputs: Sequence[np.ndarray],
        out: np.ndarray,
        status: np.ndarray | None = None,
    ) -> None:
        """Call `function` for every sample.

        Args:
            function: of the manifest, with 1 to 5 inputs.
            inputs: C-contiguous float64; (n, length) per sample, or (length,) the same for all.
            out: C-contiguous float64, (n, ...).
            status: (n,) C int, of a function that returns one.
        """
        assert (status is not None) == function.status
        assert len(inputs) == len(function.inputs) and len(inputs) in (1, 2, 3, 4, 5)
        runtime, arrays, result = self._runtime, self._own(inputs), self._place(out)
        given = self._ffi.new(f"{runtime}_input[]", len(arrays))
        for place, array in zip(given, arrays, strict=True):
            place.data = self._numbers(array)
            place.step = array.shape[1] if array.ndim == 2 else 0
        samples = len(out)
        step = out.size // samples if samples else 0
        pointer = self._ffi.cast("void *", getattr(self._library, function.name))
        arguments = [pointer, samples, given, self._numbers(result), step]
        if status is None:
            getattr(self._library, f"{runtime}_batch_{len(inputs)}")(*arguments)
        else:
            driver = getattr(self._library, f"{runtime}_batch_status_{len(inputs)}")
            driver(*arguments, self._integers(status))
        self._give_back(result, out)

    def observation(
        self,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        W: np.ndarray,
        status: np.ndarray | None = None,
        s: np.ndarray | None = None,
    ) -> None:
        """Fill W, (n*joints, columns), from (n, joints) arrays; (n,) `status` with loops.

        s: (n, signals), for effects that read any.
        """
        arrays = self._own([a for a in (q, qd, qdd, s) if a is not None])
        result = self._place(W)
        arguments = [self._numbers(a) for a in (*arrays, result)]
        if status is not None:
            arguments.append(self._integers(status))
        self._function("observation")(len(q), *arguments)
        self._give_back(result, W)

    def base_parameters(self, function: FunctionSpec, chi: np.ndarray, beta: np.ndarray) -> None:
        """Fill beta from chi by the grouping relations."""
        (given,), result = self._own([chi]), self._place(beta)
        getattr(self._library, function.name)(self._numbers(given), self._numbers(result))
        self._give_back(result, beta)

    @property
    def _runtime(self) -> str:
        """Start of the names of the C runtime."""
        return "modelerf" if self._single else "modeler"

    def _own(self, arrays: Sequence[np.ndarray]) -> list[np.ndarray]:
        """The arrays as the code reads them."""
        assert all(a.flags.c_contiguous and a.dtype == np.float64 for a in arrays)
        if not self._single:
            return list(arrays)
        with np.errstate(over="ignore"):  # infinite in single precision: the results will tell
            return [array.astype(np.float32) for array in arrays]

    def _place(self, out: np.ndarray) -> np.ndarray:
        """Where the code writes what is for `out`."""
        assert out.flags.c_contiguous and out.dtype == np.float64
        return np.empty_like(out, dtype=np.float32) if self._single else out

    def _give_back(self, result: np.ndarray, out: np.ndarray) -> None:
        if result is not out:
            out[...] = result

    def _integers(self, array: np.ndarray) -> Any:
        assert array.flags.c_contiguous and array.dtype == np.intc
        return self._ffi.cast("int *", array.ctypes.data)

    def _numbers(self, array: np.ndarray) -> Any:
        # The address itself: half the time of from_buffer; the caller holds the array.
        return self._ffi.cast("float *" if self._single else "double *", array.ctypes.data)


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
    wanted = FUNCTIONS
    if spec.closure is not None:
        wanted = LOOP_FUNCTIONS | (PLATFORM_FUNCTIONS if spec.closure.platform else {})
    more = int(bool(spec.signals))
    for role, count in wanted.items():
        got = inputs.get(f"{spec.prefix}_{role}")
        count += more if role in READ_SIGNALS else 0
        if role == "friction" and got == 4 + more:  # effects that read positions or loads
            continue
        if got != count:
            raise ManifestError(
                f"{spec.robot}: the manifest names {got or 'no'} inputs of {role}, expected "
                f"{count}; generate it again"
            )


def _in_single(declared: str) -> str:
    """Declarations of the same code in single precision."""
    return re.sub(r"\bmodeler_", "modelerf_", re.sub(r"\bdouble\b", "float", declared))


def _declarations(spec: ModuleSpec) -> str:
    status = ", int *" if spec.closure is not None else ""
    signals = "const double *, " if spec.signals else ""
    lines = [
        f"const char *{spec.prefix}_signature(void);",
        f"void {spec.prefix}_observation(size_t, const double *, const double *, const double *, "
        f"{signals}double *{status});",
    ]
    for function in spec.functions:
        inputs = ", ".join("const double *" for _ in function.inputs)
        returns = "int" if function.status else "void"
        lines.append(f"{returns} {function.name}({inputs}, double *);")
    return "\n".join(lines)
