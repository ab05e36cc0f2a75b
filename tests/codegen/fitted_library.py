"""Fitted modules of robots with any values, and their C functions made callable by ctypes."""

import ctypes
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from modeler.codegen.emit import emit
from modeler.core import manifest
from modeler.core.choices import read_builtin_robot
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text
from modeler.runtime.build import build_library
from tests.modules import Module, module, unoptimised

ROBOTS = Path(__file__).with_name("robots")


def robot_text(name: str) -> str:
    """A robot of the folder beside."""
    return (ROBOTS / f"{name}.toml").read_text()


SLOW = robot_text("slow-arm")
"""Two axes that turn and one that slides; effects that read signals, positions and shapes; a joint
that rubs and whose motor, which turns with two, rubs too."""


@cache
def robot_module(name: str) -> Module:
    """A built-in robot, "slow-arm", or "rubbing": a five-bar whose passive joints rub."""
    if name not in ("slow-arm", "rubbing"):
        return module(name)
    rubbing = dict.fromkeys(("viscous", "coulomb", "passive_friction"), "all")
    text = SLOW if name == "slow-arm" else replace_effects(read_builtin_robot("five-bar"), rubbing)
    model = derive_model(parse_robot_text(text, name))
    base = derive_base_parameters(model)
    return Module(model, base, emit(model, base))


def fitted_of(spec: manifest.ModuleSpec, seed: int = 4) -> manifest.FittedSpec:
    """Values of any size; friction is none that drives."""
    random = np.random.default_rng(seed)
    parameters = []
    for base in spec.base:
        value = float(random.normal())
        value = abs(value) if base.column_of.startswith(("Fs", "Fv")) else value
        parameters.append(manifest.FittedParameter(base.name, base.unit, value, 0.1))
    notes = ("Values of a test.",)
    return manifest.FittedSpec("weighted", True, "usable: yes", (), notes, tuple(parameters))


def with_values(name: str, fitted: manifest.FittedSpec | None = None) -> manifest.EmittedModule:
    """The module of a robot with these values, or with any."""
    made = robot_module(name)
    return emit(made.model, made.base, fitted or fitted_of(made.emitted.spec))


class Functions:
    """The compiled functions of an emitted module, one sample a call."""

    def __init__(self, emitted: manifest.EmittedModule, **widths: float) -> None:
        """Compile; widths by the end of their macro's name, `COULOMB_WIDTH_1=0.1`.

        With widths, and where no loops close, the unit that reads them is all that is compiled.
        """
        self.spec = emitted.spec
        macro, end = self.spec.prefix.upper(), ".c"
        if widths and self.spec.closure is None:
            end = f"{self.spec.prefix}_fitted.c"
        units = [name for name in self.spec.sources if name.endswith((".h", end))]
        with unoptimised(*(f"-D{macro}_{name}={value}" for name, value in widths.items())):
            path = build_library({name: emitted.files[name] for name in units})
        self._library = ctypes.CDLL(str(path))
        fitted = self.spec.fitted.functions if self.spec.fitted is not None else ()
        known = (*self.spec.functions, *fitted)
        self._number = np.float32 if self.spec.precision == "single" else np.float64
        self._known = {f.name.removeprefix(f"{self.spec.prefix}_"): f for f in known}

    @property
    def roles(self) -> list[str]:
        """Names of the functions with values, without the robot's."""
        return [role for role in self._known if role.startswith("fitted_")]

    @property
    def every(self) -> list[str]:
        """Names of all functions, without the robot's."""
        return list(self._known)

    def inputs(self, role: str) -> tuple[manifest.ArgumentSpec, ...]:
        """Arguments that a function reads."""
        return self._known[role].inputs

    def output(self, role: str) -> str:
        """Name of what a function writes."""
        return self._known[role].outputs[0].name

    def text(self, role: str) -> str:
        """What a function without arguments says."""
        function = getattr(self._library, f"{self.spec.prefix}_{role}")
        function.restype = ctypes.c_char_p
        return function().decode()

    def numbers(self, name: str, count: int) -> np.ndarray:
        """A constant array."""
        array = (ctypes.c_double * count).in_dll(self._library, f"{self.spec.prefix}_{name}")
        return np.array(array)

    def __call__(self, role: str, state: Mapping[str, np.ndarray]) -> np.ndarray:
        """The output over the samples; what the function reads is taken from `state`."""
        function = self._known[role]
        arrays = [state[argument.name] for argument in function.inputs]
        call = getattr(self._library, function.name)
        result = np.full((len(state["q"]), *function.outputs[0].shape), np.nan, self._number)
        for i, out in enumerate(result):
            rows = [np.ascontiguousarray(a if a.ndim == 1 else a[i], self._number) for a in arrays]
            status = call(*(a.ctypes.data_as(ctypes.c_void_p) for a in (*rows, out)))
            assert not function.status or status == 0
        return result


def motion(name: str, samples: int = 12, seed: int = 6) -> dict[str, np.ndarray]:
    """Random states of the robot by the names of the arguments; those of loops close."""
    made = robot_module(name)
    n, random = len(made.emitted.spec.joints), np.random.default_rng(seed)
    q = random.uniform(-2.0, 2.0, (samples, n))
    x = q
    if made.model.closure is not None:
        home = np.array(made.model.closure.home)
        q = home[list(made.model.closure.actuated)] + random.uniform(-0.1, 0.1, (samples, n))
        x = home[list(made.model.closure.platform or ())]
        x = x + random.uniform(-0.1, 0.1, (samples, len(x)))
    v, a = random.normal(0.0, 1.0, (2, samples, n))
    s = random.uniform(0.1, 0.9, (samples, len(made.emitted.spec.signals)))
    return {"q": q, "qd": v, "qdd": a, "s": s, "x": x, "xd": v, "xdd": a}
