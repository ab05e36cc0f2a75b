"""The simulated arm of `plant.c`, compiled at first use, its parameters as arrays."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import cffi
import numpy as np

HERE = Path(__file__).resolve().parent
TICK = 1e-3  # s, of the controller and of the logs
STEPS = 4  # of a tick
RUNAWAY = 0.5  # rad: a controller that is further off has lost its arm
# Not -ffast-math: it may change the arithmetic of the whole process.
FLAGS = ("-std=c11", "-O3", "-fno-math-errno", "-fno-trapping-math", "-shared", "-fPIC")


class NoCompiler(RuntimeError):
    """No C compiler on this machine."""


def compiler() -> list[str]:
    """$CC, else the first of cc, gcc, clang."""
    named = os.environ.get("CC")
    for command in [shlex.split(named)] if named else [["cc"], ["gcc"], ["clang"]]:
        if shutil.which(command[0]):
            return command
    raise NoCompiler(
        f"{f'no {named}' if named else 'none of cc, gcc, clang'} is found; install one or set CC"
    )


@cache
def library() -> tuple[cffi.FFI, Any]:
    """The compiled C, once for a process; its file is gone when it is loaded."""
    ffi = cffi.FFI()
    ffi.cdef((HERE / "plant.h").read_text(encoding="utf-8"))
    sources = [
        str(HERE / name) for name in ("plant.c", "rigid_body.c", "held_out_effects.c", "unnamed.c")
    ]
    with tempfile.TemporaryDirectory() as folder:
        built = str(Path(folder) / "plant.so")
        subprocess.run([*compiler(), *FLAGS, *sources, "-o", built, "-lm"], check=True)
        loaded = ffi.dlopen(built)
    assert loaded.plant_size() == ffi.sizeof("Plant")
    return ffi, loaded


@dataclass(frozen=True)
class Run:
    """What a motion left.

    Attributes:
        encoder: (ticks, n) rad, as read.
        torque: (4 ticks, n) N m, of the motors, at 4 kHz.
        temperature: (ticks, n) degrees Celsius.
        link: (ticks, n) rad, true.
    """

    encoder: np.ndarray
    torque: np.ndarray
    temperature: np.ndarray
    link: np.ndarray


class Plant:
    """An arm with all that `plant.h` lists: numbers, and arrays with a row per joint.

    Arrays are views: `plant.viscous[0] = 2.0` and `plant.viscous = values` change the arm.
    """

    def __init__(self, joints: int):
        ffi, _ = library()
        struct = ffi.new("Plant *")
        struct.joints = joints
        arrays = {}
        for name, field in ffi.typeof("Plant").fields:
            if field.type.kind == "array":
                shape = tuple(int(k) for k in re.findall(r"\[(\d+)\]", field.type.cname))
                values = np.frombuffer(ffi.buffer(getattr(struct, name)), float).reshape(shape)
                arrays[name] = values[:joints] if shape[0] == 8 else values
        self.__dict__.update(_struct=struct, _arrays=arrays)

    def __getattr__(self, name: str) -> Any:
        arrays = self.__dict__["_arrays"]
        return arrays[name] if name in arrays else getattr(self.__dict__["_struct"], name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._arrays:
            self._arrays[name][...] = value
        else:
            setattr(self._struct, name, value)

    def copy(self) -> "Plant":
        """Another arm, equal so far."""
        ffi, _ = library()
        other = Plant(self.joints)
        ffi.memmove(other._struct, self._struct, ffi.sizeof("Plant"))
        return other

    def inverse_dynamics(self, q, v, a):
        """(samples, n) each: torque of the links, diagonal of their inertia, gravity's torque."""
        ffi, loaded = library()
        inputs = [_pointer(ffi, np.ascontiguousarray(x, float)) for x in (q, v, a)]
        items = (np.zeros(q.shape), np.zeros(q.shape), np.zeros(q.shape))
        loaded.inverse_dynamics(self._struct, len(q), *inputs, *(_pointer(ffi, x) for x in items))
        return items

    def run(self, wanted: np.ndarray, temperature: np.ndarray, seed: int) -> Run | None:
        """The motion along `wanted` (ticks, n), 1 kHz; None if the arm ran away."""
        ffi, loaded = library()
        ticks, n = wanted.shape
        known = [np.ascontiguousarray(x, float) for x in (wanted, rate(wanted), temperature)]
        run = Run(*(np.zeros((count, n)) for count in (ticks, STEPS * ticks, ticks, ticks)))
        left = (run.encoder, run.torque, run.temperature, run.link)
        before, after = ([_pointer(ffi, x) for x in some] for some in (known, left))
        lost = loaded.simulate(self._struct, ticks, *before, seed, *after)
        finite = np.isfinite(run.torque.sum() + run.encoder.sum())
        return None if lost or not finite or np.abs(run.encoder - wanted).max() > RUNAWAY else run


def rate(path: np.ndarray) -> np.ndarray:
    """d/dt of what is sampled at every tick."""
    return np.gradient(path, TICK, axis=0)


def _pointer(ffi: cffi.FFI, array: np.ndarray) -> Any:
    return ffi.from_buffer("double[]", array)
