"""Robots with loops: seconds to derive, emit and compile; microseconds per regressor in C.

`from home` closes the loops from the home posture for every sample, `from the last` from the sample
before, as a controller does.
"""

import time
from collections.abc import Mapping

import numpy as np

from benchmarks.line import Key, Line, ratio
from modeler.api.workflow import load as robot
from modeler.codegen import derive, generate
from modeler.derivation import draw_random_states
from modeler.runtime import CompiledModel, load_module

ROBOTS = (
    "sr400",
    "dvrk-psm",
    "five-bar",
    "3rrr",
    "delta",
    "orthoglide-2003",
    "orthoglide-2012",
    "stewart",
    "evra",
)
OPEN = ("sr400", "dvrk-psm")
"""Those whose loops are solved in closed form: they are trees."""
SAMPLES = 4000


def motion(derivation, samples: int) -> list[np.ndarray]:
    """A smooth motion around home: q, qd, qdd of the coordinates."""
    model = derivation.model
    states = draw_random_states(model, 1, np.random.default_rng(1))
    places = list(model.closure.actuated) if model.closure else range(states[0].shape[1])
    q, qd, qdd = (x[0, list(places)] for x in states)
    way = np.sin(np.linspace(0, 6 * np.pi, samples))[:, None]
    return [np.ascontiguousarray(q + 0.01 * way), qd + 0 * way, qdd + 0 * way]


def best(call, repeats: int = 7) -> float:
    """Shortest time of a call, s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def loop_times(name: str) -> dict[str, float]:
    """Base parameters; seconds to derive, emit and compile; microseconds per base regressor.

    `home_us` closes the loops from home for every sample, `last_us` from the sample before.
    """
    start = time.perf_counter()
    derivation = derive(robot(name))
    derived = time.perf_counter()
    emitted = generate(derivation)
    written = time.perf_counter()
    compiled: CompiledModel = load_module(emitted.spec, emitted.files)
    built = time.perf_counter()
    q, qd, qdd = motion(derivation, SAMPLES)
    W = compiled.observation(q, qd, qdd)
    return {
        "base": derivation.base.rank,
        "derive_s": derived - start,
        "emit_s": written - derived,
        "compile_s": built - written,
        "home_us": 1e6 * best(lambda: compiled.base_regressor(q, qd, qdd)) / SAMPLES,
        "last_us": 1e6 * best(lambda: compiled.observation(q, qd, qdd, W)) / SAMPLES,
        "bound_ms": 1e3 * longest_failure(compiled) if derivation.model.closure else 0.0,
    } | _tiled(compiled, [q, qd, qdd], W)


def longest_failure(compiled: CompiledModel) -> float:
    """Longest call, s, that closes nothing with the evaluations that are allowed, 5000."""
    closure, longest = compiled.spec.closure, 0.0
    assert closure is not None
    home = np.array([closure.home[k] for k in closure.actuated])
    n = len(home)
    for way in (*np.eye(n), *-np.eye(n), np.ones(n), (-1.0) ** np.arange(n)):
        for far in (1.0, 10.0, 100.0, 1e3):  # rad or m
            q = home[None] + far * way
            longest = max(longest, best(lambda q=q: compiled.closing_status(q), 3))
    return longest


def _tiled(compiled: CompiledModel, motion: list[np.ndarray], W: np.ndarray) -> dict[str, float]:
    """Microseconds of a sample by tiles, and what one after another takes, over that; paired."""
    if compiled.spec.closure is None:
        return {}
    status, least = np.zeros(SAMPLES, dtype=np.intc), [float("inf")] * 2
    for _ in range(15):
        ways = (
            lambda: compiled._library.fill_observation(motion, W, status),
            lambda: compiled._tiles.fill_samples(motion, W, True, status),
        )
        least = [min(least[k], best(way, 1)) for k, way in enumerate(ways)]
    return {"tile_us": 1e6 * least[1] / SAMPLES, "tile_ratio": least[0] / least[1]}


MUST = {"orthoglide-2003": (0.85, 1.03), "stewart": (3.75, 4.35), "evra": (4.1, 4.7)}
"""A quarter of what the dense solver took on the machine that it was measured on: last, home."""


def _measure(quick: bool) -> Mapping[str, float]:
    table = {}
    for name in ROBOTS[-3:] if quick else ROBOTS:
        times = loop_times(name)
        table |= {f"loops_us.{name}": times["last_us"], f"loops_home_us.{name}": times["home_us"]}
        if "tile_us" in times:
            table[f"loops_tile_us.{name}"] = times["tile_us"]
            table[f"loops_scalar_over_tile.{name}"] = times["tile_ratio"]
            table[f"loops_bound_ms.{name}"] = times["bound_ms"]
    return table


def _keys() -> tuple[Key, ...]:
    keys = []
    for name in ROBOTS:
        last, home = MUST.get(name, (None, None))
        what = "A sample, closed from"
        keys += [
            Key(f"loops_us.{name}", "us", f"{what} the sample before.", last, last and last / 2),
            Key(f"loops_home_us.{name}", "us", f"{what} home.", home, home and home / 2),
        ]
        if name not in OPEN:
            keys += [
                Key(f"loops_tile_us.{name}", "us", f"{what} samples before, 8 at once."),
                Key(
                    f"loops_bound_ms.{name}", "ms", "Longest call that fails, of 5000 evaluations."
                ),
                ratio(
                    f"loops_scalar_over_tile.{name}",
                    "One after another over 8 at once.",
                    *((3.0, 5.0) if name in MUST else ()),
                ),
            ]
    return tuple(keys)


LINES = (Line(_keys(), _measure, 40),)
