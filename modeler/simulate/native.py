"""CasADi functions as machine code where there is a C compiler, called without conversions."""

import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

# No fused multiply-add: the machine code gives the same bits as CasADi's own evaluation, so that
# a seed means the same measurement with and without a compiler.
_FLAGS = ("-O1", "-ffp-contract=off", "-fPIC", "-shared")


class FastFunction:
    """A CasADi function with one dense result, called with numpy vectors.

    A call through CasADi's own conversions takes 100 us, ten times the arithmetic of an arm.
    """

    def __init__(self, function: ca.Function) -> None:
        native: Any = compiled_where_possible(function)
        assert native.n_out() == 1 and native.sparsity_out(0).is_dense()
        self._inputs = [np.zeros(native.nnz_in(i)) for i in range(native.n_in())]
        self._output = np.zeros(native.nnz_out(0))
        # CasADi does not keep the buffer alive for the callable made of it.
        self._buffer, self._evaluate = native.buffer()
        for i, values in enumerate(self._inputs):
            self._buffer.set_arg(i, values.data)
        self._buffer.set_res(0, self._output.data)

    def __call__(self, *arguments: np.ndarray) -> np.ndarray:
        """The result's elements, column after column."""
        for values, argument in zip(self._inputs, arguments, strict=True):
            values[:] = argument
        self._evaluate()
        return self._output.copy()


def compiled_where_possible(function: ca.Function) -> ca.Function:
    """The same function, about ten times faster if a C compiler is found; else as it is."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        return function
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        source, library = Path(folder) / "plant.c", Path(folder) / "plant.so"
        generator = ca.CodeGenerator(source.name)
        generator.add(function)
        generator.generate(f"{folder}/")
        command = [compiler, *_FLAGS, str(source), "-o", str(library), "-lm"]
        if subprocess.run(command, capture_output=True, check=False).returncode != 0:
            return function
        return ca.external(function.name(), str(library))
