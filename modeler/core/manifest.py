"""What an emitted module looks like: the manifest as dataclasses.

`codegen` fills it, templates lay it out, `manifest.json` stores it, `compiled` reads it back and
refuses a library that answers differently. Everything the numeric stages know of a robot is here.
"""

import dataclasses
import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from modeler.core.choices import Precision
from modeler.core.errors import ManifestError
from modeler.core.json import (
    JsonError,
    SchemaError,
    ShortRepr,
    build_instance,
    format_json,
    parse_json,
    shorten_value,
)
from modeler.core.result import Result

FORMAT = 2

RUNTIME = ("modeler_real.h", "modeler_runtime.h", "modeler_sincos.h")
"""Hand-written C files that stand beside every emitted module."""

BATCH_RUNTIME = ("modeler_batch.h", "modeler_batch.c")
"""Loops over samples, which a controller has no use for."""

CLOSURE_RUNTIME = (
    "modeler_status.h",
    "modeler_solve.h",
    "modeler_kept.h",
    "modeler_closure.h",
    "modeler_workspace.h",
    "modeler_closure.c",
    "modeler_closure_factor.c",
    "modeler_closure_motion.c",
)
"""Those that stand beside a robot with loops."""

CONTROL_RUNTIME = ("modeler_status.h", "modeler_solve.h")
"""Those that stand beside the controller's unit."""

LAW_RUNTIME = ("modeler_law.h",)
"""Those that stand beside laws that were learned; and beside tiles of them."""

LAW_TILE_RUNTIME = ("modeler_law_lanes.h",)

CUDA_THREADS = 128
"""Threads of a block of the emitted kernels."""

TILE_RUNTIME = ("modeler_tile.h", "modeler_lanes.h", "modeler_versions.h", "modeler_tile.c")
"""Those that stand beside tiles."""

CLOSING_RUNTIME = ("modeler_closing.h",)
"""Those that stand beside the tiles of a robot with loops."""

MANIFEST = "manifest.json"
"""Name of the manifest's file."""


@dataclass(frozen=True)
class ArgumentSpec:
    """One array argument of an emitted function; row-major."""

    name: str  # "qd"
    shape: tuple[int, ...]  # (joints,)
    unit: str  # "rad/s, m/s"
    meaning: str  # "joint velocities"

    @property
    def size(self) -> int:
        """Returns how many numbers it holds."""
        return math.prod(self.shape)


@dataclass(frozen=True)
class FunctionSpec(ShortRepr):
    """One emitted C function: all arguments are `const double *` inputs, then outputs."""

    name: str  # "wrist_base_regressor"
    equation: str  # "tau = phi beta"
    inputs: tuple[ArgumentSpec, ...]
    outputs: tuple[ArgumentSpec, ...]
    additions: int  # of all that it calls, once each: loops are closed in some turns
    multiplications: int
    status: bool = False  # returns 0 if it could do its work: loops may not close


@dataclass(frozen=True)
class ClosureSpec:
    """The loops of a robot: its opened tree has more variables u than coordinates q."""

    variables: tuple[str, ...]  # rows whose variables are u, in order
    units: tuple[str, ...]  # "rad" | "m"
    actuated: tuple[int, ...]  # places in u of q
    platform: tuple[int, ...]  # places in u of x, the platform's coordinates; empty without one
    home: tuple[float, ...]  # the closed posture u from which loops are closed
    carrier: str = ""  # row of the platform's link


@dataclass(frozen=True)
class DriveSpec:
    """A motor on a bridge: current = (duty voltage - k_e qd) / resistance."""

    voltage: float  # V, of the supply; a column voltage<j> of a log goes before
    resistance: float  # ohm
    k_e: float = 0.0  # V s/rad or V s/m, of the speed of the joint


@dataclass(frozen=True)
class JointSpec:
    """One joint variable; the order of the list is the order of q, qd, qdd, tau."""

    name: str  # "1"
    kind: str  # "revolute" | "prismatic"
    unit: str  # "rad" | "m"
    effort_unit: str  # "N m" | "N"
    actuated: bool
    drive_gain: float | None  # joint torque per unit of logged current
    drive: DriveSpec | None = None  # what makes a current of a logged duty


@dataclass(frozen=True)
class ParameterSpec:
    """One standard parameter.

    `effect` is "rigid_body" for the ten inertial parameters, else the id of the effect;
    `kind` is inertial | rotor_inertia | friction | offset | other.
    """

    name: str  # "XX2"
    unit: str
    kind: str
    effect: str
    joint: str  # row of the table it belongs to
    nominal: float | None
    nonnegative: bool = False  # physics allows no negative value
    deviation: float | None = None  # of the nominal value; 0: it is held; None: not stated


@dataclass(frozen=True)
class TermSpec:
    """`coefficient * parameter`; `value` is the coefficient at the nominal geometry."""

    coefficient: str
    value: float
    parameter: str


@dataclass(frozen=True)
class BaseSpec(ShortRepr):
    """One base parameter: `name = sum of terms`, its column is that of `column_of`."""

    name: str  # "ZZ1R"
    column_of: str  # "ZZ1"
    unit: str
    kind: str
    rows: tuple[int, ...]  # joints whose torque the column can enter (structural nonzeros)
    terms: tuple[TermSpec, ...]


@dataclass(frozen=True)
class SymbolSpec:
    """One geometric symbol and the value compiled into the C."""

    name: str
    value: float


SIGNALS = {
    "time": "s",
    "temperature": "K or degC",
    "slip": "1",  # bristle of a joint, z' = (v/d)(1 - z sign v)
    "bouc_wen": "1",  # loop of a cable, z' = (v - b |v| z - (1 - b) v |z|)/d
    "direction": "1",  # sign: which way a joint goes; size: 1 less the share of the way back
    "since": "s",  # time since it last turned back, by the direction before it
    "followed": "SI",  # what the lag after it follows
    "lag": "SI",  # z' = (x - z)/tau of the entry before it
    "windup": "{angle}",  # of an elastic joint: motor less link
    "windup_rate": "{angle}/s",
    "windup_acceleration": "{angle}/s2",
}
"""Kind of a signal -> its unit."""


@dataclass(frozen=True)
class SignalSpec:
    """One entry of the input `s`: what effects read besides the motion."""

    kind: str  # of `SIGNALS`
    joint: str  # whose temperature or inner state; "" for the time
    unit: str
    value: (
        float  # rad or m: travel over which the bristle turns, way back that is a reversal; tau, s;
        # of a windup the joint's stiffness, of its rate the damping: SI
    )
    share: float = 1.0  # b of a Bouc-Wen loop; 1: Dahl's bristle

    @property
    def is_internal_state(self) -> bool:
        """Returns True of a state that is stepped along the motion."""
        return self.kind not in ("time", "temperature")


@dataclass(frozen=True)
class FittedParameter:
    """One value of a fit."""

    name: str  # "ZZ1R"
    unit: str
    value: float
    sigma: float | None  # standard deviation; None: set aside, the value is 0
    essential: bool = True


@dataclass(frozen=True)
class FittedSpec(ShortRepr):
    """The values that stand in the C of a fitted model, and the functions that have them."""

    method: str  # id of the estimator
    valid: bool | None  # None: nobody has judged the fit
    verdict: str
    warnings: tuple[str, ...]
    notes: tuple[str, ...]  # what a reader of the values must know besides
    parameters: tuple[FittedParameter, ...]  # in the order of `base`
    gains: tuple[float, ...] = ()  # joint torque per drive unit; empty unless all are known
    widths: tuple[str, ...] = ()  # macros, one per joint whose friction leaps
    functions: tuple[FunctionSpec, ...] = ()
    code: str = ""  # digest of the fitted unit, its signature left out
    elastic: tuple[float, ...] = ()  # stiffnesses, then dampings; (): those of the robot file
    signature: str = ""  # of all that, and of the robot: what <prefix>_fitted_signature() answers


@dataclass(frozen=True)
class ControlSpec(ShortRepr):
    """What a controller calls besides: the unit `<prefix>_control`, which Python's fits do without.

    It is tied to the robot's signature when it is compiled; `code` is the digest of its text.
    """

    functions: tuple[FunctionSpec, ...]
    code: str = ""


@dataclass(frozen=True)
class OriginSpec:
    """What wrote a folder; no part of any signature."""

    interface: int  # of the C: see `C_INTERFACE`
    generator: str  # "modeler 0.1.0"
    license: str  # SPDX identifier


@dataclass(frozen=True)
class ModuleSpec(ShortRepr):
    """The manifest of one robot."""

    robot: str
    title: str
    prefix: str  # of C names
    format: int
    symbols: tuple[SymbolSpec, ...]
    joints: tuple[JointSpec, ...]
    standard: tuple[ParameterSpec, ...]  # columns of the standard regressor, in order
    base: tuple[BaseSpec, ...]  # columns of the base regressor, in order
    unidentifiable: tuple[str, ...]
    functions: tuple[FunctionSpec, ...]
    closure: ClosureSpec | None = None
    signals: tuple[SignalSpec, ...] = ()
    code: str = ""  # digest of the sources, their signature left out: see `code_digest`
    fitted: FittedSpec | None = None  # where it was generated from a model
    precision: Precision = "double"  # of all numbers of the C
    inertial_uncertainty: float | None = None  # of every body, over its scale
    control: ControlSpec | None = None  # where `modeler generate` wrote it
    origin: OriginSpec | None = field(default=None, compare=False)  # in the file alone
    units: tuple[str, ...] | None = None  # "_control", ...: of some functions; None: all there are
    laws: int = 0  # that were learned, whose tables stand in the C

    @property
    def every_function(self) -> tuple[FunctionSpec, ...]:
        """Returns the functions of the robot, of the fitted values, of the controller's unit."""
        more = (unit.functions for unit in (self.fitted, self.control) if unit is not None)
        return (*self.functions, *(function for unit in more for function in unit))

    @property
    def windups(self) -> tuple[int, ...]:
        """Returns the places in s of e of the elastic joints; e' and e'' follow."""
        return tuple(k for k, signal in enumerate(self.signals) if signal.kind == "windup")

    @property
    def elastic(self) -> tuple[float, ...]:
        """Returns stiffness, then damping of the elastic joints, as the robot file has them."""
        places = (*self.windups, *(k + 1 for k in self.windups))
        return tuple(self.signals[k].value for k in places)

    @property
    def nonzeros(self) -> tuple[tuple[int, int], ...]:
        """Returns (joint, base column) of the structural nonzeros of the base regressor.

        Row after row.

        The order of the values of `<prefix>_base_regressor_nonzeros`.
        """
        return tuple(
            (joint, column)
            for joint in range(len(self.joints))
            for column, base in enumerate(self.base)
            if joint in base.rows
        )

    def has_unit(self, unit: str) -> bool:
        """Returns True if the C file of that name, after the robot's, is part of the module."""
        there = {"_fitted": self.fitted, "_control": self.control, "_loops": self.closure}
        return (self.units is None or unit in self.units) and there.get(unit, self) is not None

    @property
    def controller_sources(self) -> tuple[str, ...]:
        """Returns names of the C files of the controller's library, headers included."""
        units = [".h", ".c"]
        units += [f"{unit}.c" for unit in ("_regressor", "_base_regressor") if self.has_unit(unit)]
        headed = [unit for unit in ("_fitted", "_control") if self.has_unit(unit)]
        headed += ["_joints"] if self.control is not None else []
        units += [f"{unit}.{kind}" for unit in headed for kind in "hc"]
        runtime = [*RUNTIME, *(LAW_RUNTIME if self.laws else ())]
        if self.closure is not None:
            units += ["_tree.h", "_loops.c"]
            runtime += CLOSURE_RUNTIME
        if self.control is not None or self.windups:
            runtime += [name for name in CONTROL_RUNTIME if name not in runtime]
        return (*(self.prefix + unit for unit in units), *runtime)

    @property
    def sources(self) -> tuple[str, ...]:
        """Returns names of the C files that Python compiles: those, and the loops over samples."""
        units = [f"{self.prefix}_batch.{kind}" for kind in "hc" if self.has_unit("_batch")]
        return (*self.controller_sources, *units, *BATCH_RUNTIME)

    @property
    def tile_sources(self) -> tuple[str, ...]:
        """Returns names of the C files of the tiles, which can be a library of their own.

        () if none.
        """
        if not self.has_unit("_batch"):
            return ()
        units = (f"{self.prefix}_tile.h", f"{self.prefix}_tile.c")
        runtime_files = (*RUNTIME, *(LAW_RUNTIME if self.laws else ()))
        others = runtime_files if self.closure is None else self.sources
        headers = (name for name in others if name.endswith(".h"))
        return (*units, *self.tile_runtime, *headers)

    @property
    def tile_runtime(self) -> tuple[str, ...]:
        """Returns hand-written files of the tiles alone."""
        more = CLOSING_RUNTIME if self.closure is not None else ()
        return (*TILE_RUNTIME, *more, *(LAW_TILE_RUNTIME if self.laws else ()))

    def to_json(self) -> str:
        """Returns stable text: sorted as declared, no date, no version."""
        return self._json_text

    def format_file(self) -> str:
        """Returns the text of `manifest.json`: the same entries, a parameter or function a line."""
        return format_json(json.loads(self._json_text)) + "\n"

    @cached_property
    def _json_text(self) -> str:
        entries = dataclasses.asdict(self)
        for name in ("fitted", "control", "origin", "units"):
            if entries[name] is None:
                del entries[name]
        if self.fitted is not None and not self.fitted.elastic:
            del entries["fitted"]["elastic"]
        if self.precision == "double":
            del entries["precision"]
        if not self.laws:
            del entries["laws"]
        for entry, name in [
            (entries, "inertial_uncertainty"),
            *((parameter, "deviation") for parameter in entries["standard"]),
            *((joint, "drive") for joint in entries["joints"]),
        ]:
            if entry[name] is None:
                del entry[name]
        return json.dumps(entries, indent=1) + "\n"

    def compute_signature(self) -> str:
        """Returns hash that the emitted library repeats, so that a stale library is noticed.

        Of the whole manifest but the fitted values, which have a signature of their own, and the
        controller's unit, and with it of the whole C text but these: two robots of the same
        signature have the same C. It is the same on every machine.
        """
        if self.fitted is None and self.control is None and self.origin is None:
            return digest_text(self.to_json())
        return dataclasses.replace(self, fitted=None, control=None, origin=None).compute_signature()


def digest_text(text: str) -> str:
    """Returns the sixteen digits that a signature is."""
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def digest_code(sources: Mapping[str, str]) -> str:
    """Returns digest of the C files of a module, tiles included.

    With an empty text for the signature.

    The signature stands in the C itself, so it is put there last: it covers all the rest.
    """
    parts = [part for name in sorted(sources) for part in (name, sources[name])]
    # Lengths first: no two lists of parts give the same bytes.
    return hashlib.sha256("".join(f"{len(part)}:{part}" for part in parts).encode()).hexdigest()


@dataclass(frozen=True)
class EmittedModule(Result):
    """An emitted module, on no disk yet.

    Attributes:
        spec: its manifest.
        files: {file name: text}; `code`, the manifest, build files, programs, tables. What is not
            `code` is made when it is first requested.
        log: what the robot file says of the columns of logs; no part of the C.
    """

    spec: ModuleSpec
    files: Mapping[str, str]
    log: Mapping[str, object] = field(default_factory=dict)

    @property
    def code(self) -> dict[str, str]:
        """Returns the files that the library and its tiles are compiled from."""
        names = (*self.spec.sources, *self.spec.tile_sources)
        return {name: self.files[name] for name in names if name in self.files}


def parse_manifest(text: bytes | str, where: str) -> ModuleSpec:
    """Reads a manifest back.

    Raises:
        ManifestError: not a manifest, or of another format; `where` names the file.
    """
    try:
        return build_manifest(parse_json(text), where)
    except JsonError as error:
        raise ManifestError(f"{where}: {error}; generate it again") from None


def build_manifest(raw: Any, where: str) -> ModuleSpec:
    """Returns a manifest from its JSON value.

    Raises:
        ManifestError: as `module_from_json`.
    """
    if not isinstance(raw, dict) or "format" not in raw:
        raise ManifestError(f"{where}: not a manifest; expected the output of `modeler generate`")
    if raw["format"] != FORMAT:
        raise ManifestError(
            f"{where}: manifest format {shorten_value(raw['format'])}, expected {FORMAT}; "
            "generate it again"
        )
    try:
        return build_instance(ModuleSpec, raw)
    except SchemaError as error:
        raise ManifestError(f"{where}: damaged manifest ({error}); generate it again") from None
