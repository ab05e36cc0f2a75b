"""The compiled model of a robot: dynamics over arrays of samples."""

from collections.abc import Callable, Mapping
from copy import copy
from pathlib import Path
from typing import Any, Literal

import numpy as np

from modeler.core.errors import LoopError, ManifestError, ShapeError, SolutionError
from modeler.core.files import read_file
from modeler.core.manifest import MANIFEST, EmittedModule, FunctionSpec, ModuleSpec, parse_manifest
from modeler.core.result import Result
from modeler.runtime.bind import Library, check_names
from modeler.runtime.build import build_library
from modeler.runtime.checks import check_vector
from modeler.runtime.fused import BatchEvaluator, check_output

_STATUS = {
    1: "the loops cannot be closed",
    2: "singular posture, the passive joints are not determined",
    3: "the loops cannot be closed, a value is not finite",
    4: "the loops were not closed within the evaluations allowed",
}
"""What a status of the C code says."""

_REFUSED = {
    2: "the inertia matrix is singular or not positive, or the Jacobian has not full rank",
    3: "a value is not finite",
    4: "the accelerations that friction depends on did not converge",
}
"""The same without loops."""


class _FunctionTable(dict[str, FunctionSpec]):
    """Functions of a module by name without the robot's; what is not there is reported."""

    def __init__(self, spec: ModuleSpec) -> None:
        start = f"{spec.prefix}_"
        super().__init__({f.name.removeprefix(start): f for f in spec.every_function})
        self._spec = spec

    def __repr__(self) -> str:
        return f"<{len(self)} functions of {self._spec.robot}>"

    def __missing__(self, role: str) -> FunctionSpec:
        some = "; it was generated with --only: generate it without" * (
            self._spec.units is not None
        )
        raise ManifestError(
            f"{self._spec.robot} has no function {role}; expected {', '.join(sorted(self))}{some}"
        )


class CompiledModel(BatchEvaluator, Result):
    """tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta, over n samples at once.

    q, qd, qdd, tau are (n, joints) in the order of `spec.joints`, SI units; beta is (c,) in the
    order of `spec.base`, chi (p,) in the order of `spec.standard`. All methods raise ShapeError for
    arrays of another shape or with values that are not finite. Threads may share a model.

    Attributes:
        spec: the manifest.
        log: the [log] of the robot file: which columns of its logs are which.
        windup_values: beta and elastic of `set_windup`; None: joints are rigid along logs.
    """

    def __init__(
        self,
        spec: ModuleSpec,
        library: Library,
        log: Mapping[str, object] | None = None,
        tile_files: Mapping[str, str] | None = None,
    ) -> None:
        self.spec = spec
        self._tile_files = tile_files or {}
        self.log: Mapping[str, object] = log or {}
        self._library = library
        self._functions = _FunctionTable(spec)
        self._joints = len(spec.joints)
        self.windup_values: tuple[Any, Any] | None = None

    def __reduce__(self) -> tuple[Callable[..., "CompiledModel"], tuple[Any, ...]]:
        """Pickled as its C: where it lands it is compiled, or taken from the cache there."""
        return load_module, (self.spec, dict(self._tile_files), self.log, self.windup_values)

    def base_regressor(self, q: Any, qd: Any, qdd: Any, s: Any = None) -> np.ndarray:
        """Returns Phi of the base parameters, (n, joints, c): tau = phi beta.

        Large batches are evaluated as those of `observation` and `nonzeros`.
        """
        return self._evaluate_function("base_regressor", {"q": q, "qd": qd, "qdd": qdd}, s=s)

    def regressor(self, q: Any, qd: Any, qdd: Any, s: Any = None) -> np.ndarray:
        """Returns Phi of the standard parameters, (n, joints, p): tau = phi chi."""
        return self._evaluate_function("regressor", {"q": q, "qd": qd, "qdd": qdd}, s=s)

    def observation(
        self,
        q: Any,
        qd: Any,
        qdd: Any,
        out: np.ndarray | None = None,
        s: Any = None,
        *,
        order: Literal["C", "F"] = "C",
    ) -> np.ndarray:
        """Returns the observation matrix W, (n*joints, c).

        Y = W beta with y = tau.reshape(-1), joint after joint in each sample.

        Args:
            q: positions.
            qd: velocities.
            qdd: accelerations.
            out: is filled and returned if given; saves most of the time of a large W, which goes
                into fresh memory pages. In either order of memory.
            s: signals of effects, where there are any.
            order: of a new W in memory: "F" column after column, as LAPACK has it.
        """
        if not self.spec.has_unit("_batch"):
            self._functions["observation"]
        inputs = self._check_motion(q, qd, qdd, s)
        shape = (len(inputs[0]) * self._joints, len(self.spec.base))
        W = np.empty(shape, order=order) if out is None else check_output(out, shape, columns=True)
        status = self._make_status(len(inputs[0]))
        if not self._fill_by_tiles(inputs, W, dense=True, status=status):
            rows = W if W.flags.c_contiguous else np.empty(shape)
            self._library.fill_observation(inputs, rows, status)
            if rows is not W:
                W[...] = rows
        self._check_status(status, inputs[0])
        return W

    def inverse_dynamics(self, q: Any, qd: Any, qdd: Any, beta: Any, s: Any = None) -> np.ndarray:
        """Returns tau, (n, joints), by the Newton-Euler recursion."""
        return self._evaluate_function("inverse_dynamics", {"q": q, "qd": qd, "qdd": qdd}, beta, s)

    def inertia_matrix(self, q: Any, beta: Any) -> np.ndarray:
        """Returns m(q), (n, joints, joints), rotor inertias included."""
        return self._evaluate_function("inertia_matrix", {"q": q}, beta)

    def gravity(self, q: Any, beta: Any) -> np.ndarray:
        """Returns the torques of gravity g(q), (n, joints)."""
        return self._evaluate_function("gravity", {"q": q}, beta)

    def coriolis(self, q: Any, qd: Any, beta: Any) -> np.ndarray:
        """Returns c(q, qd), (n, joints): Coriolis and centripetal torques."""
        return self._evaluate_function("coriolis", {"q": q, "qd": qd}, beta)

    def friction(
        self, qd: Any, beta: Any, q: Any = None, qdd: Any = None, s: Any = None
    ) -> np.ndarray:
        """Returns f(qd), (n, joints): all effects but rotor inertias, offsets included.

        With loops f(q, qd): passive joints rub too, and how fast they move depends on q. Effects
        that read positions, loads or signals need q, qdd and s.
        """
        reads = {argument.name for argument in self._functions["friction"].inputs}
        states = {n: x for n, x in {"q": q, "qd": qd, "qdd": qdd}.items() if n in reads}
        if any(value is None for value in states.values()):
            why = " has loops: its friction depends on the positions; give q"
            if "qdd" in reads:
                why = ": its effects depend on positions and loads; give q and qdd"
            raise ShapeError(self.spec.robot + why)
        return self._evaluate_function("friction", states, beta, s)

    def close(self, q: Any) -> np.ndarray:
        """Returns all free variables u of the opened tree, (n, len(u)).

        In the order of the manifest.

        Raises:
            LoopError: the loops cannot be closed; names the sample.
        """
        if self._has_loops:
            return self._evaluate_function("close", {"q": q})
        return self._check_states({"q": q})["q"]

    def closing_status(self, q: Any) -> np.ndarray:
        """Returns (n,) 0 where the loops close, else the status of the C code.

        Never raises for loops.
        """
        positions = self._check_states({"q": q})["q"]
        status = np.zeros(len(positions), dtype=np.intc)
        if self._has_loops:
            out = np.empty((len(positions), *self._functions["close"].outputs[0].shape))
            self._library.run_batch(self._functions["close"], [positions], out, status)
        return status

    def coupling(self, q: Any) -> np.ndarray:
        """Returns G of ud = G qd, (n, len(u), joints); rows of the platform are its Jacobian."""
        if not self._has_loops:
            n = len(self._check_states({"q": q})["q"])
            return np.broadcast_to(np.eye(self._joints), (n, self._joints, self._joints)).copy()
        return self._evaluate_function("coupling", {"q": q})

    def platform_close(self, x: Any) -> np.ndarray:
        """Returns u, (n, len(u)), from the platform's coordinates."""
        return self._evaluate_function("platform_close", {"x": x})

    def platform_base_regressor(self, x: Any, xd: Any, xdd: Any) -> np.ndarray:
        """Returns Phi of f = phi beta, (n, joints, c): forces along the platform's coordinates."""
        return self._evaluate_function("platform_base_regressor", {"x": x, "xd": xd, "xdd": xdd})

    def platform_inverse_dynamics(self, x: Any, xd: Any, xdd: Any, beta: Any) -> np.ndarray:
        """Returns f, (n, joints), along the platform's coordinates."""
        states = {"x": x, "xd": xd, "xdd": xdd}
        return self._evaluate_function("platform_inverse_dynamics", states, beta)

    def forward_kinematics(self, q: Any) -> np.ndarray:
        """Returns [R | p] of the frame of every moving row in frame 0, (n, rows, 3, 4); p in m.

        Columns of R are the frame's axes: a point x of frame j stands at R x + p.
        """
        return self._evaluate_function("forward_kinematics", {"q": q})

    def base_parameters(self, chi: Any) -> np.ndarray:
        """Returns beta, (c,), from chi, (p,), by the grouping relations."""
        function = self._functions["base_parameters"]
        parameters = check_vector(chi, "chi", len(self.spec.standard))
        beta = np.empty(len(self.spec.base))
        self._library.fill_base_parameters(function, parameters, beta)
        return beta

    def advance(
        self,
        dq: Any,
        dt: float,
        s: Any,
        q: Any = None,
        qd: Any = None,
        qdd: Any = None,
        beta: Any = None,
        elastic: Any = None,
    ) -> np.ndarray:
        """Returns the signals of effects one sample later, as s: time and inner states.

        See the header.

        Args:
            dq: (joints,) or (n, joints) travel since the last sample.
            dt: s since then.
            s: (m,) or (n, m) signals then.
            q: (joints,) or (n, joints) positions now; lags and elastic joints follow the motion.
            qd: the same of velocities.
            qdd: the same of accelerations.
            beta: (c,) base parameters, which elastic joints need.
            elastic: stiffnesses, then dampings; None: of the robot file.
        """
        if "advance" not in self._functions:
            raise ManifestError(f"{self.spec.robot} has no effects that read signals")
        elastic = self.spec.elastic if elastic is None else elastic
        arguments = {"dq": dq, "dt": [dt], "s": s, "q": q, "qd": qd, "qdd": qdd}
        arguments |= {"beta": beta, "elastic": elastic}
        wanted = [argument.name for argument in self._functions["advance"].inputs]
        if missing := [name for name in wanted if arguments[name] is None]:
            why = "elastic joints" if self.spec.windups else "lags"
            raise ShapeError(
                f"{self.spec.robot}: its effects have {why}; give {', '.join(missing)}"
            )
        after = self.evaluate("advance", **{name: arguments[name] for name in wanted})
        return after if np.ndim(s) == 2 else after[0]

    def compute_windup(
        self, q: Any, qd: Any, qdd: Any, step: float, beta: Any, elastic: Any = None
    ) -> np.ndarray:
        """Returns (n, m) signals s of elastic joints along a motion of the motors; others are 0.

        It starts where e holds the links along the motion, without speed of its own. NaN from where
        something is not finite.

        Args:
            q: (n, joints) positions of the motors, at even steps.
            qd: their velocities.
            qdd: their accelerations.
            step: s between samples.
            beta: (c,) base parameters.
            elastic: (2 E,) stiffnesses of the E elastic joints, then dampings; None: those of the
                robot file.
        """
        motion = [*self._check_states({"q": q, "qd": qd, "qdd": qdd}).values()]
        elastic = self.spec.elastic if elastic is None else elastic
        sizes = check_vector(elastic, "elastic", 2 * len(self.spec.windups))
        parameters = check_vector(beta, "beta", len(self.spec.base))
        s = np.zeros((len(motion[0]), len(self.spec.signals)))
        self._library.fill_windup(motion, step, parameters, sizes, s)
        return s

    def set_windup(self, beta: Any, elastic: Any = None) -> "CompiledModel":
        """Returns the model whose elastic joints wind up with these values, along any log.

        Without them, or without elastic joints, nothing winds up.

        Args:
            beta: (c,) base parameters.
            elastic: as of `compute_windup`.
        """
        if not self.spec.windups:
            return self
        model = copy(self)
        model.windup_values = beta, self.spec.elastic if elastic is None else elastic
        return model

    def evaluate(self, role: str, **arrays: Any) -> np.ndarray:
        """Returns what an emitted function gives, (n, ...) by its output's shape.

        Args:
            role: its name without the robot's, as in the manifest: "coriolis_matrix".
            arrays: its inputs by name: (n, length), or (length,) where all samples have the same.

        Raises:
            ManifestError: the module has no such function.
            ShapeError: an input is missing, or of another shape.
            LoopError: the function returns a status that is not 0; names the sample.
            SolutionError: the same of a robot without loops.
        """
        out, status, inputs = self._call_function(role, arrays)
        self._check_status(status, np.atleast_2d(inputs[0]), "" if self._has_loops else role)
        return out

    def evaluate_status(self, role: str, **arrays: Any) -> np.ndarray:
        """Returns (n,) what an emitted function returns for each sample.

        As `evaluate`, never refused.
        """
        _, status, inputs = self._call_function(role, arrays)
        return np.zeros(len(inputs[0]), dtype=np.intc) if status is None else status

    def _call_function(
        self, role: str, arrays: Mapping[str, Any]
    ) -> tuple[np.ndarray, np.ndarray | None, list[np.ndarray]]:
        """Output, statuses, inputs."""
        function = self._functions[role]
        wanted = {argument.name: argument.size for argument in function.inputs}
        if wanted.keys() != arrays.keys():
            raise ShapeError(
                f"{role}: got {', '.join(arrays) or 'nothing'}; expected {', '.join(wanted)}"
            )
        checked_arrays = {name: np.asarray(arrays[name], dtype=float) for name in wanted}
        samples = max(len(x) if x.ndim == 2 else 1 for x in checked_arrays.values())
        inputs = []
        for name, x in checked_arrays.items():
            if x.shape not in ((wanted[name],), (samples, wanted[name])):
                raise ShapeError(
                    f"{role}: {name} has the shape {x.shape}; expected ({wanted[name]},) or "
                    f"({samples}, {wanted[name]})"
                )
            inputs.append(np.ascontiguousarray(x))
        out = np.empty((samples, *function.outputs[0].shape))
        status = np.zeros(samples, dtype=np.intc) if function.status else None
        self._library.run_batch(function, inputs, out, status)
        return out, status, inputs

    def _evaluate_function(
        self, role: str, states: Mapping[str, Any], beta: Any = None, s: Any = None
    ) -> np.ndarray:
        function: FunctionSpec = self._functions[role]
        arguments = self._check_states(states)
        samples = len(next(iter(arguments.values())))
        names = [argument.name for argument in function.inputs]
        if "beta" in names:
            arguments["beta"] = check_vector(beta, "beta", len(self.spec.base))
        signals = self._check_signals(s, samples) if "s" in names or s is not None else None
        if signals is not None:
            arguments["s"] = signals
        out = np.empty((samples, *function.outputs[0].shape))
        inputs = [arguments[name] for name in names]
        if role == "base_regressor" and self._fill_by_tiles(inputs, out, dense=True):
            return out
        status = self._make_status(samples) if function.status else None
        self._library.run_batch(function, inputs, out, status)
        self._check_status(status, inputs[0])
        return out

    @property
    def _has_loops(self) -> bool:
        return self.spec.closure is not None

    def _make_status(self, samples: int) -> np.ndarray | None:
        return np.zeros(samples, dtype=np.intc) if self._has_loops else None

    def _check_status(self, status: np.ndarray | None, inputs: np.ndarray, role: str = "") -> None:
        """Raises LoopError for the first sample that does not close, or that the role refuses."""
        if status is None or not np.any(status):
            return
        first = int(np.flatnonzero(status)[0])
        where = ", ".join(f"{value:.6g}" for value in inputs[min(first, len(inputs) - 1)])
        more = int(np.count_nonzero(status)) - 1
        also = f" (and {more} more)" if more else ""
        at, code = f"{self.spec.robot}: sample {first + 1}{also}", int(status[first])
        if role:
            raise SolutionError(
                f"{at}: {role} has no result: {_REFUSED[code]}; got q ({where}); check the "
                "parameters and the posture"
            )
        raise LoopError(
            f"{at}: {_STATUS[code]}; got "
            f"({where}); expected positions that the robot reaches from [home], in SI units"
        )


def load_module(
    spec: ModuleSpec,
    files: Mapping[str, str],
    log: Mapping[str, object] | None = None,
    windup_values: tuple[Any, Any] | None = None,
) -> CompiledModel:
    """Returns the compiled model of an emitted module; compiled once, then taken from the cache.

    Args:
        spec: the manifest.
        files: {file name: text} with at least `spec.sources`; `spec.tile_sources` are compiled when
            they are first needed, others are not looked at.
        log: the [log] of the robot file.
        windup_values: of the model.

    Raises:
        ManifestError: a file is missing, a name of the manifest is no C name, or the code belongs
            to another manifest.
        BuildError: no compiler, or it refused.
    """
    check_names(spec)
    missing = [name for name in spec.sources if name not in files]
    if missing:
        lacking = ", ".join(missing)
        raise ManifestError(f"{spec.robot}: the module lacks {lacking}; generate it again")
    path = build_library({name: files[name] for name in spec.sources})
    model = CompiledModel(spec, Library(spec, path), log, files)
    model.windup_values = windup_values
    return model


def load_folder(folder: Path | str) -> CompiledModel:
    """Returns the compiled model of a folder that `modeler generate` wrote.

    Raises:
        ManifestError: the folder holds no module, or a part of it is missing or damaged.
        BuildError: no compiler, or it refused.
    """
    folder = Path(folder)
    manifest = folder / MANIFEST
    if not manifest.is_file():
        raise ManifestError(
            f"{folder}: no {MANIFEST}; expected a folder that `modeler generate` wrote"
        )
    spec = parse_manifest(_read_content(manifest), str(manifest))
    check_names(spec)
    files = {}
    for name in (*spec.sources, *spec.tile_sources):
        if (folder / name).is_file():
            try:
                files[name] = _read_content(folder / name).decode()
            except UnicodeDecodeError:
                raise ManifestError(f"{folder / name}: no text; generate it again") from None
    return load_module(spec, files)


def _read_content(path: Path) -> bytes:
    try:
        return read_file(path)
    except OSError as error:
        raise ManifestError(f"{path}: cannot be read ({error.strerror}); check the path") from None


# One compiled model of a robot in each process, however many jobs need it.


_MODELS: dict[str, CompiledModel] = {}  # of this process, by signature


def load_cached_model(emitted: EmittedModule) -> CompiledModel:
    """Returns the compiled model of an emitted module; the same object every time.

    Raises:
        BuildError: see `load`.
    """
    signature = emitted.spec.compute_signature()
    if signature not in _MODELS:
        _MODELS[signature] = load_module(emitted.spec, emitted.code, emitted.log)
    return _MODELS[signature]
