"""A dense observation matrix into memory that is there, against a streaming fill of its bytes."""

import ctypes
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from statistics import median

import numpy as np

from benchmarks.line import Key, Line
from benchmarks.robots import compiled
from modeler.runtime import find_toolchain

ROBOTS = ("puma560", "panda")
SAMPLES, _FEW_SAMPLES = 1_000_000, 100_000
_ROUNDS, _FEW = 9, 3


def states(name: str, samples: int, seed: int = 5) -> tuple[np.ndarray, ...]:
    """Random q, qd, qdd."""
    joints = len(compiled(name).spec.joints)
    rng = np.random.default_rng(seed)
    return tuple(rng.uniform(-2.0, 2.0, (samples, joints)) for _ in range(3))


def paired(ways: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, list[float]]:
    """Seconds of every way, round by round; the first round warms up."""
    seconds: dict[str, list[float]] = {name: [] for name in ways}
    for turn in range(rounds + 1):
        for name, work in ways.items():
            start = time.perf_counter()
            work()
            if turn:
                seconds[name].append(time.perf_counter() - start)
    return seconds


def _measure(quick: bool) -> Mapping[str, float]:
    table = {}
    fill = _fill()
    for name in ROBOTS:
        model, samples = compiled(name), _FEW_SAMPLES if quick else SAMPLES
        q, qd, qdd = states(name, samples)
        W = np.ones((samples * q.shape[1], len(model.spec.base)))
        pointer = ctypes.c_void_p(W.ctypes.data)
        times = paired(
            {
                "fill": lambda p=pointer, n=W.size: fill(p, n, 1.0),
                "W": lambda m=model, x=(q, qd, qdd), W=W: m.observation(*x, out=W),
            },
            _FEW if quick else _ROUNDS,
        )
        each = [w / f for w, f in zip(times["W"], times["fill"], strict=True)]
        table[f"dense_w_vs_stream_fill.{name}"] = median(each)
        table[f"dense_w_seconds.{name}"] = min(times["W"])
        del W
    return table


def _fill() -> Callable[[ctypes.c_void_p, int, float], None]:
    tools = find_toolchain()
    with tempfile.TemporaryDirectory() as scratch:
        library = Path(scratch) / "fill.so"
        source = Path(__file__).with_name("fill.c")
        subprocess.run(
            [*tools.command, *tools.flags, "-shared", "-o", str(library), str(source)], check=True
        )
        function = ctypes.CDLL(str(library)).benchmark_fill
    function.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_double]
    function.restype = None
    return function


LINES = (
    Line(
        tuple(
            key
            for name in ROBOTS
            for key in (
                Key(
                    f"dense_w_vs_stream_fill.{name}",
                    "x",
                    "W of 1e6 samples into `out=`, over a streaming fill of its bytes.",
                    1.2,
                    1.0,
                ),
                Key(f"dense_w_seconds.{name}", "s", "W of 1e6 samples into `out=`."),
            )
        ),
        _measure,
        40,
    ),
)
