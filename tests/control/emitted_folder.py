"""A whole folder as `modeler generate` writes it, compiled by any compiler and called by ctypes."""

import ctypes
import subprocess

import numpy as np

from modeler.codegen.workflow import generate
from modeler.core.manifest import FittedParameter, FittedSpec
from modeler.robot.robot import Robot
from tests.bodies import buildable
from tests.oracles.complex_step import Oracle

STATE = 1 << 20  # bytes, more than any state takes


def with_values(spec, beta: np.ndarray) -> FittedSpec:
    pairs = zip(spec.base, beta, strict=True)
    values = tuple(FittedParameter(b.name, b.unit, float(x), 0.1) for b, x in pairs)
    return FittedSpec("weighted", True, "usable: yes", (), ("Values of a test.",), values)


class Folder:
    """The C of a robot with the values of a fit in a folder of its own.

    Attributes:
        oracle: the same robot with the same parameters.
        chi, beta: these parameters.
        roles: {name without the robot's: what the manifest says}.
    """

    def __init__(self, derivation, folder, single=False, seed=1, control=None):
        self.robot: Robot = derivation.robot
        precision = "single" if single else "double"
        bare = generate(derivation, precision=precision).spec
        values = buildable(bare, np.random.default_rng(seed))
        self.chi = dict(zip([p.name for p in bare.standard], values, strict=True))
        K = np.zeros((len(bare.base), len(bare.standard)))
        places = {p.name: k for k, p in enumerate(bare.standard)}
        for i, base in enumerate(bare.base):
            for term in base.terms:
                K[i, places[term.parameter]] = term.value
        self.beta = K @ np.array(list(self.chi.values()))
        self.oracle, self.path, self.single = Oracle(self.robot, self.chi), folder, single
        for base in bare.base:  # no motion distinguishes a constant weight from an offset
            offsets = [t for t in base.terms if t.parameter.startswith("Off")]
            weights = [t for t in base.terms if t not in offsets]
            if base.column_of.startswith("Off"):
                row, counted = base.column_of[3:], weights
                self.oracle.constant[row] = sum(t.value * self.chi[t.parameter] for t in counted)
            else:
                self.oracle.constant |= {t.parameter[3:]: -self.chi[t.parameter] for t in offsets}
        made = generate(
            derivation,
            folder,
            fitted=with_values(bare, self.beta),
            precision=precision,
            control=control,
        )
        self.spec = made.spec
        self.number = np.float32 if single else np.float64
        start = len(self.spec.prefix) + 1
        self.roles = {f.name[start:]: f for f in self.spec.every_function}
        self.library: ctypes.CDLL | None = None

    @property
    def sources(self) -> list[str]:
        return sorted(path.name for path in self.path.glob("*.c"))

    def compiled(self, *command: str) -> "Folder":
        """Compiled, by default without optimising, as all `.c` files of the folder."""
        words = command or ("cc", "-O0")
        self.command(*words, "-shared", "-fPIC", "-o", "all.so", *self.sources, "-lm")
        self.library = ctypes.CDLL(str(self.path / "all.so"))
        return self

    def command(self, *words: str) -> str:
        done = subprocess.run(words, cwd=self.path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{' '.join(words)}\n{done.stdout}{done.stderr}"
        return done.stdout + done.stderr

    def call(self, role: str, state=None, **known) -> tuple[int, np.ndarray]:
        """(status, output); from `state` where one is given."""
        function = self.roles[role]
        names = [a.name for a in function.inputs if state is None or a.name not in ("q", "qd")]
        inputs = [np.ascontiguousarray(known[name], self.number) for name in names]
        out = np.full(function.outputs[0].shape, 7.0, self.number)
        pointers = [ctypes.c_void_p(x.ctypes.data) for x in (*inputs, out)]
        end = "_at" if state is not None else ""
        call = getattr(self.library, f"{function.name}{end}")
        call.restype = ctypes.c_int if function.status else None
        status = call(*([] if state is None else [state]), *pointers)
        return status or 0, out

    def state(self, q: np.ndarray, qd: np.ndarray, state=None):
        """(status, state) closed from the last posture of a state, or from home."""
        q, qd = (np.ascontiguousarray(x, self.number) for x in (q, qd))
        pointers = [ctypes.c_void_p(x.ctypes.data) for x in (q, qd)]
        new = ctypes.create_string_buffer(STATE) if state is None else state
        call = getattr(self.library, f"{self.spec.prefix}_state")
        return call(*pointers, state, new), new  # its posture stands first

    def has(self, symbol: str) -> bool:
        return hasattr(self.library, f"{self.spec.prefix}_{symbol}")
