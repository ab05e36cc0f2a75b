"""Least squares without the observation matrix, against numpy on one that is there."""

import time
from collections.abc import Callable, Mapping

import numpy as np

from benchmarks.line import Key, Line, ratio
from benchmarks.memory import states
from benchmarks.robots import compiled

ROBOTS = ("puma560", "panda")
SAMPLES, _FEW = 300_000, 30_000
_REPEATS = 3


def _measure(quick: bool) -> Mapping[str, float]:
    table: dict[str, float] = {}
    for name in ROBOTS:
        model, samples = compiled(name), _FEW if quick else SAMPLES
        q, qd, qdd = states(name, samples)
        rng = np.random.default_rng(9)
        tau = model.inverse_dynamics(q, qd, qdd, rng.uniform(0.5, 2.0, len(model.spec.base)))
        tau += rng.normal(0.0, 0.1, tau.shape)
        fused = _least(lambda m=model, x=(q, qd, qdd, tau): m.triangles(*x), _REPEATS)
        W = model.observation(q, qd, qdd)
        y = tau.reshape(-1)
        whole = _least(lambda W=W, y=y: np.linalg.lstsq(W, y), 1)
        gram = _least(lambda W=W: W.T @ W, _REPEATS)
        del W
        table[f"fused_r_seconds.{name}"] = fused
        table[f"fused_r_vs_lstsq.{name}"] = whole / fused
        table[f"fused_r_vs_gram.{name}"] = gram / fused
    return table | {"fused_r_vs_lstsq": table["fused_r_vs_lstsq.puma560"]}


def _least(work: Callable[[], object], times: int) -> float:
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return min(seconds)


LINES = (
    Line(
        (
            ratio("fused_r_vs_lstsq", "As fused_r_vs_lstsq.puma560.", 30.0, 48.0),
            *(
                key
                for name in ROBOTS
                for key in (
                    Key(
                        f"fused_r_seconds.{name}",
                        "s",
                        "Triangles of 3e5 samples from motion and torques.",
                    ),
                    ratio(f"fused_r_vs_lstsq.{name}", "numpy.linalg.lstsq on a ready W over them."),
                    ratio(f"fused_r_vs_gram.{name}", "W.T @ W on a ready W over them."),
                )
            ),
        ),
        _measure,
        60,
    ),
)
