"""The condition number of exciting motions: ours beside two usual ways, same robot, limits, time.

Run from the top of the checkout: `python -m benchmarks.excitation [ROBOT...]`, or with
`--families` first: Fourier series beside B-splines and trapezoids, without and with a clearance.
All minimise the condition number of W with columns of length one over the same Fourier series, with
the same compiled regressor. The peers are what is mostly done: SLSQP with limits sampled as
constraints and gradients by differences of the whole objective, from a random motion (as fmincon is
used), and differential evolution, a genetic search, of motions that are drawn back into their
limits. Each peer gets `PATIENCE` times the processor seconds that ours took.
"""

import sys
import time

import numpy as np
from scipy.optimize import differential_evolution, minimize

from modeler.api import compile_model, derive, generate
from modeler.api.motion_bounds import build_bounds
from modeler.excitation import (
    ExcitationTask,
    MotionRequest,
    build_task,
    choose_harmonics,
    compute_condition,
    design_motion,
    draw_random_motion,
)
from modeler.excitation.series import FAMILIES
from modeler.robot import Robot, parse_robot_text, read_robot, replace_effects

ROBOTS = ("scara", "ur10e", "tx40", "panda")
FIVE = (*ROBOTS, "rx90")
"""Of `--families` and of benchmarks.collisions."""

PATIENCE = 4.0
_EFFECTS = dict.fromkeys(["rotor_inertia", "viscous", "coulomb"], "all")
_CONSTRAINED = 8  # every so manieth sample is a constraint of SLSQP


class _Late(Exception):
    """The time is up."""


class _Watched:
    """The condition number of motions, and the best of those that keep the limits."""

    def __init__(self, task: ExcitationTask, seconds: float) -> None:
        self.task, self.seconds, self.begun = task, seconds, time.process_time()
        self.shape = (len(task.bounds.joints), task.series.values.shape[1])
        self.unit = task.bounds.half_range[:, None] * np.ones(self.shape[1])
        self.best, self.count = np.inf, 0

    def motion(self, flat: np.ndarray) -> np.ndarray:
        return flat.reshape(self.shape) * self.unit

    def shares(self, flat: np.ndarray) -> np.ndarray:
        return self.task.compute_kinematic_shares(self.motion(flat)) / self.task.series.room

    def condition(self, flat: np.ndarray) -> float:
        if time.process_time() - self.begun > self.seconds:
            raise _Late
        self.count += 1
        value = compute_condition(
            self.task.compute_rows(self.task.series.evaluate_motion(self.motion(flat)))
        )
        if value < self.best and np.abs(self.shares(flat)).max() <= 1.0:
            self.best = value
        return value


def slsqp(task: ExcitationTask, seconds: float) -> _Watched:
    watched, rng = _Watched(task, seconds), np.random.default_rng(0)

    def room(flat: np.ndarray) -> np.ndarray:
        shares = watched.shares(flat)[:, ::_CONSTRAINED].ravel()
        # Between these samples a little room, so that the motion keeps its limits there too.
        return np.concatenate([0.97 - shares, 0.97 + shares])

    try:
        while True:
            x = (draw_random_motion(task, rng) / watched.unit).ravel()
            minimize(
                lambda flat: np.log(watched.condition(flat)),
                x,
                method="SLSQP",
                constraints={"type": "ineq", "fun": room},
                options={"maxiter": 200},
            )
    except _Late:
        return watched


def evolution(task: ExcitationTask, seconds: float) -> _Watched:
    watched = _Watched(task, seconds)

    def repaired(flat: np.ndarray) -> float:
        # Drawn back towards the middle of the ranges until the limits hold: better than penalties.
        x = watched.motion(flat)
        still = np.zeros_like(x)
        still[:, 0] = task.bounds.mid_range
        x = still + min(1.0, 0.999 * task.compute_reach(still, x - still)) * (x - still)
        return watched.condition((x / watched.unit).ravel())

    ranges = [(-1.0, 1.0)] * watched.unit.size
    try:
        while True:
            differential_evolution(repaired, ranges, seed=0, popsize=2, maxiter=10**6, polish=False)
    except _Late:
        return watched


def with_losses(robot: Robot) -> Robot:
    return parse_robot_text(replace_effects(robot.text, _EFFECTS), robot.name)


def main(names: list[str]) -> None:
    print(
        f"{'robot':<10}{'parameters':>11}{'random':>10}{'median':>10}{'ours':>10}{'cpu s':>8}"
        f"{'SLSQP':>10}{'runs':>8}{'evolution':>11}{'runs':>8}"
    )
    for name in names:
        robot = with_losses(read_robot(name))
        compiled = compile_model(generate(derive(robot)))
        bounds = build_bounds(robot, compiled, (), ())
        wish = MotionRequest(10.0, choose_harmonics(bounds, 10.0), "condition")
        begun = time.process_time()
        ours = design_motion(compiled, bounds, wish)
        seconds = time.process_time() - begun
        task = build_task(compiled, bounds, wish, None, None, None)
        peers = [peer(task, PATIENCE * seconds) for peer in (slsqp, evolution)]
        best, median = ours.random
        print(
            f"{name:<10}{len(compiled.spec.base):>11}{best:>10.4g}{median:>10.4g}"
            f"{ours.quality.condition:>10.4g}{seconds:>8.1f}"
            + "".join(f"{w.best:>10.4g}{w.count:>8}" for w in peers),
            flush=True,
        )


def families(names: list[str]) -> None:
    """Families beside each other, and what a clearance of 10 mm costs: same starts and seed."""
    print(
        f"{'robot':<10}" + "".join(f"{f:>10}{'cpu s':>8}{'clear':>8}{'cpu s':>8}" for f in FAMILIES)
    )
    for name in names:
        robot = with_losses(read_robot(name))
        compiled = compile_model(generate(derive(robot)))
        both = [build_bounds(robot, compiled, {}, {}, margin) for margin in (None, 0.01)]
        cells = []
        for family in FAMILIES:
            for bounds, wide in zip(both, (10, 8), strict=True):
                harmonics = choose_harmonics(bounds, 10.0)
                wish = MotionRequest(10.0, harmonics, "condition", starts=3, family=family)
                begun = time.process_time()
                result = design_motion(compiled, bounds, wish)
                seconds = time.process_time() - begun
                cells.append(f"{result.quality.condition:>{wide}.3g}{seconds:>8.1f}")
        print(f"{name:<10}" + "".join(cells), flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--families"]:
        families(sys.argv[2:] or list(FIVE))
    else:
        main(sys.argv[1:] or list(ROBOTS))
