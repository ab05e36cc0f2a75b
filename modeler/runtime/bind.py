"""The library's functions, declared from the manifest: all that knows cffi."""

import os
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import cffi
import numpy as np

from modeler.core.errors import BuildError, ManifestError
from modeler.core.files import locate_resources
from modeler.core.manifest import FunctionSpec, ModuleSpec
from modeler.runtime.build import build_library

_INPUT = "typedef struct { const double *data; size_t step; } modeler_input;"
_BATCH = "void modeler_batch_{}(void *, size_t, const modeler_input *, double *, size_t{});"


def _open_library(declared: str, path: Path) -> tuple[cffi.FFI, Any]:
    """The library at `path` with these functions.

    Raises:
        BuildError: it cannot be loaded.
    """
    ffi = cffi.FFI()
    ffi.cdef(declared)
    try:
        return ffi, ffi.dlopen(str(path))
    except OSError as error:
        raise BuildError(
            f"{path}: the compiled library cannot be loaded ({error}); delete it and try again"
        ) from error


def _declared(name: str) -> str:
    return Path(__file__).with_name(f"{name}_functions.h").read_text("utf-8")


class _ArrayLibrary:
    """A loaded library of either precision, and the arrays that it reads and writes.

    Arrays are float64 here, whatever the precision of the code: that in single precision is given
    copies in float32, and its results are copied back.
    """

    def __init__(self, spec: ModuleSpec, declared: str, path: Path) -> None:
        """Load the library at `path`, whose functions are declared for doubles.

        Raises:
            BuildError: it cannot be loaded.
        """
        self.spec = spec
        self._single = spec.precision == "single"
        self._runtime = "modelerf" if self._single else "modeler"  # start of the names of the C's
        if self._single:
            declared = re.sub(r"\bdouble\b", "float", declared)
            declared = re.sub(r"\bmodeler_", "modelerf_", declared)
        self._ffi, self._library = _open_library(declared, path)

    def _prepare_inputs(self, arrays: Sequence[np.ndarray]) -> list[np.ndarray]:
        """The arrays as the code reads them."""
        assert all(a.flags.c_contiguous and a.dtype == np.float64 for a in arrays)
        if not self._single:
            return list(arrays)
        with np.errstate(over="ignore"):  # infinite in single precision: the results will show
            return [array.astype(np.float32) for array in arrays]

    def _prepare_output(self, out: np.ndarray) -> np.ndarray:
        """Where the code writes what is for `out`."""
        assert out.dtype == np.float64
        return np.empty_like(out, dtype=np.float32) if self._single else out

    def _copy_back(self, result: np.ndarray, out: np.ndarray) -> None:
        if result is not out:
            out[...] = result

    def _cast_integers(self, array: np.ndarray) -> Any:
        assert array.flags.c_contiguous and array.dtype == np.intc
        return self._ffi.cast("int *", array.ctypes.data)

    def _cast_numbers(self, array: np.ndarray) -> Any:
        # The address itself: half the time of from_buffer; the caller holds the array.
        return self._ffi.cast("float *" if self._single else "double *", array.ctypes.data)


class Library(_ArrayLibrary):
    """A loaded library; its functions release the interpreter lock and may run in threads.

    Attributes:
        spec: the manifest it belongs to.
    """

    def __init__(self, spec: ModuleSpec, path: Path) -> None:
        """Loads the library at `path`.

        Raises:
            BuildError: it cannot be loaded.
            ManifestError: it was emitted with another manifest.
        """
        super().__init__(spec, _write_declarations(spec), path)
        try:
            answer = self._ffi.string(self._get_function("signature")()).decode()
            if answer != spec.compute_signature():
                raise ManifestError(
                    f"{spec.robot}: the compiled code answers {answer}, the manifest expects "
                    f"{spec.compute_signature()}; one of them is older, generate both again"
                )
            for function in spec.every_function:
                getattr(self._library, function.name)
        except AttributeError as error:
            raise ManifestError(
                f"{spec.robot}: the compiled code lacks what its manifest names ({error}); "
                "generate both again"
            ) from error

    def _get_function(self, role: str) -> Any:
        return getattr(self._library, f"{self.spec.prefix}_{role}")

    def find_address(self, name: str) -> int:
        """Returns the address of a function, for C that calls it; the caller holds this."""
        return int(self._ffi.cast("uintptr_t", getattr(self._library, name)))

    @property
    def closing_addresses(self) -> list[int]:
        """Returns addresses of the C that closes loops.

        Tables and functions, as the tiles need them.
        """
        names = [f"{self.spec.prefix}_{name}" for name in ("loops", "posed", "tree_next")]
        names.append(f"{self._runtime}_eliminated")
        cast, library = self._ffi.cast, self._library
        addresses = (self._ffi.addressof(library, name) for name in names)
        return [int(cast("uintptr_t", address)) for address in addresses]

    def run_batch(
        self,
        function: FunctionSpec,
        inputs: Sequence[np.ndarray],
        out: np.ndarray,
        status: np.ndarray | None = None,
    ) -> None:
        """Calls `function` for every sample.

        Args:
            function: of the manifest.
            inputs: C-contiguous float64; (n, length) per sample, or (length,) the same for all.
            out: C-contiguous float64, (n, ...).
            status: (n,) C int, of a function that returns one.
        """
        assert (status is not None) == function.status
        assert len(inputs) == len(function.inputs)
        runtime = self._runtime
        arrays = self._prepare_inputs(inputs)
        result = self._prepare_output(out)
        kind = "" if status is None else "status_"
        if not hasattr(self._library, f"{runtime}_batch_{kind}{len(inputs)}"):
            self._run_samples(function, arrays, result, status)
            self._copy_back(result, out)
            return
        input_structs = self._ffi.new(f"{runtime}_input[]", len(arrays))
        for place, array in zip(input_structs, arrays, strict=True):
            place.data = self._cast_numbers(array)
            place.step = array.shape[1] if array.ndim == 2 else 0
        samples = len(out)
        step = out.size // samples if samples else 0
        pointer = self._ffi.cast("void *", getattr(self._library, function.name))
        arguments = [pointer, samples, input_structs, self._cast_numbers(result), step]
        if status is not None:
            arguments.append(self._cast_integers(status))
        getattr(self._library, f"{runtime}_batch_{kind}{len(inputs)}")(*arguments)
        self._copy_back(result, out)

    def _run_samples(
        self,
        function: FunctionSpec,
        arrays: Sequence[np.ndarray],
        result: np.ndarray,
        status: np.ndarray | None,
    ) -> None:
        """The same where the C has no loop over samples for such a function."""
        call, rows = getattr(self._library, function.name), result.reshape(len(result), -1)
        for sample, row in enumerate(rows):
            sample_arrays = (array[sample] if array.ndim == 2 else array for array in arrays)
            sample_status = call(*map(self._cast_numbers, sample_arrays), self._cast_numbers(row))
            if status is not None:
                status[sample] = sample_status

    def fill_observation(
        self, states: Sequence[np.ndarray], W: np.ndarray, status: np.ndarray | None = None
    ) -> None:
        """Fills W, (n*joints, columns).

        Args:
            states: (n, joints) q, qd, qdd and, for effects that read any, (n, signals) s.
            W: is filled.
            status: (n,) of the loops, where there are any.
        """
        arrays, result = self._prepare_inputs(states), self._prepare_output(W)
        arguments = [self._cast_numbers(a) for a in (*arrays, result)]
        if status is not None:
            arguments.append(self._cast_integers(status))
        self._get_function("observation")(len(states[0]), *arguments)
        self._copy_back(result, W)

    def fill_windup(
        self,
        motion: Sequence[np.ndarray],
        step: float,
        beta: np.ndarray,
        elastic: np.ndarray,
        s: np.ndarray,
    ) -> None:
        """Fills s (n, signals) with those of elastic joints along a motion at even steps, s.

        Args:
            motion: (n, joints) q, qd, qdd.
            step: between samples.
            beta: base parameters.
            elastic: stiffnesses, then dampings.
            s: is filled.
        """
        *arrays, beta, elastic = self._prepare_inputs([*motion, beta, elastic])
        result, numbers = self._prepare_output(s), self._cast_numbers
        arguments = [step, numbers(beta), numbers(elastic), numbers(result)]
        self._get_function("windup")(len(s), *map(numbers, arrays), *arguments)
        self._copy_back(result, s)

    def fill_base_parameters(
        self, function: FunctionSpec, chi: np.ndarray, beta: np.ndarray
    ) -> None:
        """Fills beta from chi by the grouping relations."""
        (parameters,), result = self._prepare_inputs([chi]), self._prepare_output(beta)
        numbers = (self._cast_numbers(parameters), self._cast_numbers(result))
        getattr(self._library, function.name)(*numbers)
        self._copy_back(result, beta)


def check_names(spec: ModuleSpec) -> None:
    """Refuses manifests whose functions could not be declared.

    Files are named after the prefix, so this comes before any is read or written. What a manifest
    says of functions that the code has not is refused by its signature.

    Raises:
        ManifestError: a name is no C name.
    """
    for name in (spec.prefix, *(function.name for function in spec.every_function)):
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
            raise ManifestError(f'{spec.robot}: got the name "{name}", expected a C name')


def _write_declarations(spec: ModuleSpec) -> str:
    loops = spec.closure is not None
    lines = [
        _INPUT,
        *(_BATCH.format(count, "") for count in range(1, 7)),
        *(_BATCH.format(f"status_{count}", ", int *") for count in range(1, 6)),
        f"const char *{spec.prefix}_signature(void);",
    ]
    if spec.has_unit("_batch"):
        states = ", ".join(["const double *"] * (4 if spec.signals else 3))
        status_argument = ", int *" if loops else ""
        lines.append(
            f"void {spec.prefix}_observation(size_t, {states}, double *{status_argument});"
        )
        if spec.windups:
            motion = ", ".join(["const double *"] * 3)
            arguments = "double, const double *, const double *, double *"
            lines.append(f"void {spec.prefix}_windup(size_t, {motion}, {arguments});")
    if loops:
        lines.append(f"extern const char {spec.prefix}_loops[];")
        names = (f"{spec.prefix}_posed", f"{spec.prefix}_tree_next", "modeler_eliminated")
        lines += [f"void {name}(void);" for name in names]
    for function in spec.every_function:
        inputs = ", ".join("const double *" for _ in function.inputs)
        returns = "int" if function.status else "void"
        lines.append(f"{returns} {function.name}({inputs}, double *);")
    return "\n".join(lines)


# The least squares of csrc/modeler_fused.c, made callable; with bind.py all that knows cffi.


_SOURCES = ("modeler_fused.c",)
_HEADERS = (
    "modeler_fused.h",
    "modeler_fused_body.h",
    "modeler_tile.h",
    "modeler_batch.h",
    "modeler_runtime.h",
    "modeler_real.h",
)
_DECISIVE = ("CC", "CFLAGS", "PATH", "MODELER_CACHE", "XDG_CACHE_HOME", "HOME")
"""Variables that decide which library is meant, and where it is kept."""


class EntryFunctions(NamedTuple):
    """Addresses of the functions that evaluate a base regressor's entries; 0 for none.

    Attributes:
        entries: of one sample, as `<prefix>_base_regressor_nonzeros`.
        signals: how many it reads besides.
        tile: of several samples, see modeler_tile.h.
    """

    entries: int
    signals: int = 0
    tile: int = 0


class SampleArrays(NamedTuple):
    """Arrays of one call, C-contiguous, one row per sample; see `modeler_samples`."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    s: np.ndarray | None
    use: np.ndarray | None
    weight: np.ndarray | None

    def select_block(self, block: slice) -> "SampleArrays":
        """Returns the samples of a block."""
        return SampleArrays._make(None if array is None else array[block] for array in self)


Means = Mapping[str, np.ndarray]
"""Arrays of `modeler_means` by name, C-contiguous; `used` is (rows, joints)."""


class FusedLibrary:
    """The loaded library; its functions release the interpreter lock and keep nothing."""

    def __init__(self, path: Path) -> None:
        """Loads the library at `path`.

        Raises:
            BuildError: it cannot be loaded.
        """
        self._ffi, self._library = _open_library(_declared("fused"), path)

    def resolve_level(self, wanted: int = 0) -> int:
        """Returns the instructions that a wanted level means here; 0: the best.

        1: those of every processor of its kind, 2: AVX2, 3: AVX-512.
        """
        return int(self._library.modeler_fused_level(wanted))

    def add_samples(
        self,
        rows_of_entries: np.ndarray,
        functions: EntryFunctions,
        samples: SampleArrays,
        level: int,
        state: np.ndarray,
        rows: np.ndarray,
    ) -> np.ndarray:
        """Adds samples to a state; returns (samples,) True for those that were left out.

        Args:
            rows_of_entries: (entries,) C int, row after row.
            functions: that evaluate the entries.
            samples: the samples.
            level: of instructions.
            state: triangles of all joints one after another, changed.
            rows: (joints,) of numpy.uintp, increased.
        """
        source = self._make_source(rows_of_entries, functions, samples.q.shape[1])
        work = self._allocate_work(self._library.modeler_fused_work(source))
        bad = np.zeros(len(samples.q), dtype=np.uint8)
        self._library.modeler_fused_triangles(
            source,
            len(samples.q),
            self._make_samples(samples),
            level,
            self._make_pointer(state),
            self._make_pointer(rows),
            self._make_pointer(bad),
            self._make_pointer(work),
        )
        return bad.view(bool)

    def merge_states(
        self, rows_of_entries: np.ndarray, joints: int, state: np.ndarray, other: np.ndarray
    ) -> None:
        """Adds the rows of another state to a state."""
        source = self._make_source(rows_of_entries, EntryFunctions(0), joints)
        work = self._allocate_work(self._library.modeler_fused_work(source))
        self._library.modeler_fused_merge(
            source,
            0,
            self._make_pointer(state),
            self._make_pointer(other),
            self._make_pointer(work),
        )

    def add_rows(
        self,
        W: np.ndarray,
        y: np.ndarray,
        use: np.ndarray | None,
        columns: np.ndarray,
        level: int,
        triangle: np.ndarray,
    ) -> tuple[int, int]:
        """Adds rows that stand in memory to one triangle; returns rows added and rows left out.

        Args:
            W: (rows, c) rows one after another in memory, any step.
            y: (rows,) any step.
            use: (rows,) bytes, any step; None for all.
            columns: (k,) C int, the columns to use.
            level: of instructions.
            triangle: of these columns, changed.
        """
        assert W.strides[1] == 8 and W.dtype == y.dtype == np.float64
        fields = {
            "rows": len(W),
            "step": W.strides[0] // 8,
            "y_step": y.strides[0] // 8,
            "use_step": 0 if use is None else use.strides[0],
            "columns": len(columns),
            "column": self._make_pointer(columns),
            "W": self._make_pointer(W),
            "y": self._make_pointer(y),
            "use": self._make_pointer(use),
        }
        added = np.zeros(1, dtype=np.uintp)
        work = self._allocate_work(self._library.modeler_rows_work(len(columns)))
        left = self._library.modeler_rows_triangle(
            self._ffi.new("modeler_rows *", fields),
            level,
            self._make_pointer(triangle),
            self._make_pointer(added),
            self._make_pointer(work),
        )
        return int(added[0]), int(left)

    def average_rows(self, means: Means, level: int, out: np.ndarray) -> None:
        """Fills means of samples, (rows, joints, columns)."""
        fields = self._make_means(means, out[0, 0].size if out.size else 0)
        self._library.modeler_row_means(fields, level, self._make_pointer(out))

    def add_means(
        self,
        rows_of_entries: np.ndarray,
        functions: EntryFunctions,
        samples: SampleArrays,
        means: Means,
        level: int,
        state: np.ndarray,
        rows: np.ndarray,
    ) -> None:
        """Adds rows that are means, at least one, to a state; as `add_samples`.

        The torques of the samples are those of the rows.
        """
        source = self._make_source(rows_of_entries, functions, samples.q.shape[1])
        sample, start = means["sample"], means["start"]
        window = int((sample[start[1:] - 1] - sample[start[:-1]]).max()) + 1
        work = self._allocate_work(self._library.modeler_mean_work(source, window))
        self._library.modeler_mean_triangles(
            source,
            self._make_samples(samples),
            self._make_means(means),
            window,
            level,
            self._make_pointer(state),
            self._make_pointer(rows),
            self._make_pointer(work),
        )

    def _make_means(self, means: Means, columns: int = 0) -> Any:
        sizes = dict(zip(("rows", "joints"), means["used"].shape, strict=True))
        arrays = {name: self._make_pointer(array) for name, array in means.items()}
        return self._ffi.new("modeler_means *", {**sizes, "columns": columns, **arrays})

    def _make_source(
        self, rows_of_entries: np.ndarray, functions: EntryFunctions, joints: int
    ) -> Any:
        plain, reads = functions.entries, functions.signals
        return self._ffi.new(
            "modeler_source *",
            {
                "joints": joints,
                "signals": reads,
                "nonzeros": len(rows_of_entries),
                "row": self._make_pointer(rows_of_entries),
                "tile": self._ffi.cast("void *", functions.tile),
                "entries": self._ffi.cast("void *", 0 if reads else plain),
                "entries_signals": self._ffi.cast("void *", plain if reads else 0),
            },
        )

    def _make_samples(self, samples: SampleArrays) -> Any:
        arrays = {name: self._make_pointer(array) for name, array in samples._asdict().items()}
        return self._ffi.new("modeler_samples *", arrays)

    def _make_pointer(self, array: np.ndarray | None) -> Any:
        # The caller holds the array.
        return self._ffi.cast("void *", 0 if array is None else array.ctypes.data)

    @staticmethod
    def _allocate_work(size: int) -> np.ndarray:
        return np.empty(size, dtype=np.uint8)


def load_fused_library() -> FusedLibrary:
    """Returns the library, compiled once per machine and then taken from the cache.

    Raises:
        BuildError: no compiler, or it refused.
    """
    return _load_cached(tuple(os.environ.get(name, "") for name in _DECISIVE))


@lru_cache(maxsize=4)
def _load_cached(environment: tuple[str, ...]) -> FusedLibrary:
    """For variables of these values."""
    folder = locate_resources("csrc")
    texts = {name: (folder / name).read_text("utf-8") for name in _SOURCES}
    texts |= {name: (folder / "include" / name).read_text("utf-8") for name in _HEADERS}
    return FusedLibrary(build_library(texts))


# The library of tiles, see csrc/modeler_tile.h, made callable; knows cffi.
#
# It is a library of its own, which is compiled when it is first requested: small work does without.


class TileLibrary(_ArrayLibrary):
    """A loaded library; its functions release the interpreter lock and may run in threads."""

    def __init__(self, spec: ModuleSpec, path: Path, library: Library) -> None:
        """Loads the library at `path`; `library` has what closes loops one after another.

        Raises:
            BuildError: it cannot be loaded.
            ManifestError: it was emitted with another manifest.
        """
        super().__init__(spec, _declared("tile").replace("PREFIX", spec.prefix), path)
        answer = getattr(self._library, f"{spec.prefix}_tile_signature")()
        if (got := self._ffi.string(answer).decode()) != spec.compute_signature():
            raise ManifestError(
                f"{spec.robot}: the code of the tiles answers {got}, the manifest expects "
                f"{spec.compute_signature()}; one of them is older, generate both again"
            )
        tiled = getattr(self._library, f"{spec.prefix}_tiled")()
        self._tiled = self._ffi.new(f"{self._runtime}_tiled *", tiled[0])
        if spec.closure is not None:
            self._singles = self._ffi.new("uintptr_t[]", library.closing_addresses)
            self._tiled.singles = self._singles

    @property
    def tile_address(self) -> int:
        """Returns the address of the function of one tile, for C that calls it.

        The caller holds this.
        """
        return int(self._ffi.cast("uintptr_t", self._tiled.tile))

    def fill_samples(
        self,
        inputs: Sequence[np.ndarray],
        out: np.ndarray,
        dense: bool,
        status: np.ndarray | None = None,
    ) -> None:
        """Evaluates samples.

        Args:
            inputs: q, qd, qdd and, with signals, s: (n, ...), C-contiguous.
            out: rows of samples, one after another: whole regressors if `dense`, else entries; or
                rows of W with columns that are contiguous each.
            dense: with what is always 0.
            status: (n,) C int, of a robot with loops.
        """
        arrays, result = self._prepare_inputs(inputs), self._prepare_output(out)
        pointers = [self._cast_numbers(array) for array in arrays]
        work = np.empty(self._get_function("work")(self._tiled), dtype=np.uint8)
        first, start = ([self._tiled, len(inputs[0])], self._ffi.cast("void *", work.ctypes.data))
        rows = [] if result.flags.c_contiguous else [result.strides[1] // result.itemsize]
        if status is not None:
            more = [self._cast_numbers(result), *(rows or [0]), self._cast_integers(status), start]
            self._get_function("closed")(*first, *pointers, *more)
        else:
            pointers += [self._ffi.NULL] * (4 - len(inputs))
            name = "columns" if rows else "observation" if dense else "nonzeros"
            self._get_function(name)(*first, *pointers, self._cast_numbers(result), *rows, start)
        self._copy_back(result, out)

    def _get_function(self, name: str) -> Any:
        return getattr(self._library, f"{self._runtime}_tile_{name}")


def load_tile_library(spec: ModuleSpec, files: Mapping[str, str], library: Library) -> TileLibrary:
    """Returns the library of these files, compiled once and then taken from the cache.

    Args:
        spec: the manifest.
        files: with its `tile_sources`.
        library: of the same module.

    Raises:
        BuildError: no compiler, or it refused.
        ManifestError: the files belong to another manifest.
    """
    texts = {name: files[name] for name in spec.tile_sources}
    if spec.closure is not None:  # loops are closed one after another by the library that is there
        unit = f"{spec.prefix}_tile.c"
        texts[unit] = f"#define MODELER_APART\n{texts[unit]}"
    return TileLibrary(spec, build_library(texts), library)
