"""What `compiled.gpu` needs of CuPy, on the CPU: arrays of numpy, kernels compiled as C++."""

import ctypes
import subprocess
import types
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent


class RawModule:
    """Kernels of a CUDA source."""

    folder = Path()  # where it is compiled
    flags = ()

    def __init__(self, code: str) -> None:
        names = [name for name in code.replace("(", " ").split() if name.endswith("_kernel")]
        lines = ['#include "cuda_on_cpu.h"', "#include <cstdint>", code]
        for name in names:
            head = code.split(f"{name}(", 1)[1].split(")", 1)[0]
            words = [part.split() for part in head.split(",")]
            kinds = [" ".join(w[:-1]) + ("*" if w[-1].startswith("*") else "") for w in words]
            inputs = ", ".join(f"std::uint64_t a{k}" for k in range(len(kinds)))
            cast = ", ".join(f"({kind})a{k}" for k, kind in enumerate(kinds))
            lines.append(f'extern "C" void run_{name}(unsigned blocks, unsigned threads, {inputs})')
            lines.append(f"{{ launch(blocks, threads, [=] {{ {name}({cast}); }}); }}")
        source, library = self.folder / "kernels.cpp", self.folder / "kernels.so"
        source.write_text("\n".join(lines))
        flags = ["-O0", "-Wall", "-Wextra", "-Wno-unknown-pragmas", "-Werror", "-shared", "-fPIC"]
        command = ["g++", "-std=c++20", *flags, "-pthread", "-I", HERE, "-o", library, source]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        self._library = ctypes.CDLL(str(library))

    def get_function(self, name: str):
        function = getattr(self._library, f"run_{name}")

        def run(grid, block, arguments) -> None:
            numbers = [a.ctypes.data if isinstance(a, np.ndarray) else int(a) for a in arguments]
            function(grid[0], block[0], *map(ctypes.c_uint64, numbers))

        return run


def cupy(folder: Path, devices: int = 1) -> types.ModuleType:
    """A module that stands for CuPy."""
    module = types.ModuleType("cupy")
    kernels = type("Kernels", (RawModule,), {"folder": folder})
    runtime = types.SimpleNamespace(getDeviceCount=lambda: devices)
    cells = {
        "RawModule": kernels,
        "cuda": types.SimpleNamespace(runtime=runtime),
        "asarray": np.asarray,
        "ascontiguousarray": np.ascontiguousarray,
        "empty": np.empty,
        "zeros": np.zeros,
        "isfinite": np.isfinite,
    }
    for name, value in cells.items():
        setattr(module, name, value)
    return module
