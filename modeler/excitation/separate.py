"""The motion that distinguishes two effects."""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.diagnosis import (
    Candidate,
    JointScale,
    SignalReference,
    Signals,
    evaluate_columns,
    expand_grid,
)
from modeler.effects import Effect, EffectTarget
from modeler.excitation.limits import MotionBounds
from modeler.excitation.result import ExcitingMotion
from modeler.excitation.search import (
    Deadline,
    ExcitationTask,
    MotionRequest,
    build_result,
    build_task,
    draw_motions,
)
from modeler.excitation.series import compute_condition
from modeler.excitation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import minimise_cma_es
from modeler.regression import Segment
from modeler.runtime import CompiledModel

Whose = tuple[Effect, str]
"""An effect on a joint."""


@dataclass(frozen=True, eq=False)
class DiscriminationProblem:
    """Which of two effects is it?

    Attributes:
        effects: two effects, each with the name of its joint.
        beta: (c,) base parameters of the model.
        sigma: (J,) of the torques; None: all alike.
    """

    effects: tuple[Whose, Whose]
    beta: np.ndarray
    sigma: np.ndarray | None


@dataclass(frozen=True)
class EffectDiscrimination:
    """One of two effects along a motion.

    Attributes:
        unexplained_share: of its torque, that neither the model nor the other effect explains.
        random_share: the same of the best of the random motions.
        gain: by how much the unexplained torque itself is larger than on that motion.
    """

    unexplained_share: float
    random_share: float
    gain: float


@dataclass(frozen=True)
class Discrimination:
    """How well a motion distinguishes the two.

    Attributes:
        names: of the effects.
        unexplained_share: of the torque of each, the share that neither model nor other
            effect can explain; for the shapes of the other that explain most.
        random_share: the same of the best of the random motions.
        gain: by how much the unexplained torque itself is larger than on that motion.
    """

    names: tuple[str, str]
    unexplained_share: tuple[float, float]
    random_share: tuple[float, float]
    gain: tuple[float, float]

    def format_lines(self) -> list[str]:
        """Formats how well the motion distinguishes the effects, a line for each."""
        return [
            f"{name}: {format_percent(here)} of its torque is explained by neither the model nor "
            f"{other}; best of the random motions {format_percent(there)}; that part is {gain:.3g} "
            "times as large"
            for name, other, here, there, gain in zip(
                self.names,
                self.names[::-1],
                self.unexplained_share,
                self.random_share,
                self.gain,
                strict=True,
            )
        ]

    def to_json(self) -> "dict[str, EffectDiscrimination]":
        """Returns what distinguishes the two effects, by effect."""
        values = zip(self.unexplained_share, self.random_share, self.gain, strict=True)
        return {name: EffectDiscrimination(*x) for name, x in zip(self.names, values, strict=True)}


def design_discriminating_motion(
    compiled: CompiledModel,
    bounds: MotionBounds,
    request: MotionRequest,
    question: DiscriminationProblem,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[ExcitingMotion, Discrimination]:
    """Designs the motion along which two effects are least alike.

    Maximises what is left of each effect's columns after projection on the columns of the model
    and of the other effect, for the shapes of the other that leave least: geometric mean over
    both effects and their shapes. Of memory and time no slope is at hand, so by evolution.

    Raises:
        DataError: an effect that no columns on a joint describe, or what `excite` refuses.
    """
    deadline = Deadline(request.time_limit)
    task = build_task(compiled, bounds, request, question.sigma, None, question.beta)
    rng = np.random.default_rng([request.seed, 7])
    random_motions = draw_motions(task, rng, deadline)
    columns = _EffectColumns(task, question, [x for x, _ in random_motions], request.laps, deadline)
    best = min(deadline.iterate_in_time(x for x, _ in random_motions), key=columns.evaluate_motion)

    def report_progress(generation: int) -> bool:
        progress(generation / THRESHOLDS.discrimination_generations)
        return deadline()

    unit = task.bounds.half_range[:, None]

    def restrict_motion(flat: np.ndarray) -> np.ndarray:  # motions beyond limits are drawn back in
        return task.shrink_to_limits(flat.reshape(best.shape) * unit)

    solution = minimise_cma_es(
        lambda flat: columns.evaluate_motion(restrict_motion(flat)),
        (best / unit).ravel(),
        THRESHOLDS.first_step,
        THRESHOLDS.discrimination_generations,
        rng,
        report_progress,
    )
    motion = build_result(task, restrict_motion(solution), request, random_motions, deadline)
    x = motion.x
    (here, size), (there, before) = columns.compute_remainder(x), columns.compute_remainder(best)
    names = tuple(f"{effect.id}@{joint}" for effect, joint in question.effects)
    gain = tuple(a / b if b > 0.0 else float("inf") for a, b in zip(size, before, strict=True))
    return motion, Discrimination((names[0], names[1]), here, there, (gain[0], gain[1]))


class _EffectColumns:
    """The columns of two effects along motions."""

    def __init__(
        self,
        task: ExcitationTask,
        question: DiscriminationProblem,
        random_motions: list[np.ndarray],
        laps: int,
        deadline: Deadline,
    ) -> None:
        self.task, self._laps = task, laps
        self._reference = SignalReference(task.columns.compiled, question.beta, 0.0, {})
        loads = [
            self._compute_signals(x).load for x in deadline.iterate_in_time(random_motions[:5])
        ]
        load = np.sqrt(np.mean(np.concatenate(loads) ** 2, axis=0))
        self._grids = [self._build_grid(whose, load) for whose in question.effects]
        sizes = [self._compute_blocks(x) for x in deadline.iterate_in_time(random_motions)]
        self._usual = [
            np.mean([[np.sum(block**2) for block in blocks[k]] for blocks in sizes], axis=0)
            for k in range(2)
        ]

    def _build_grid(self, whose: Whose, load: np.ndarray) -> list[Candidate]:
        effect, joint = whose
        bounds, spec = self.task.bounds, self.task.columns.compiled.spec
        form = next((form for form in effect.forms if "T" not in form.names), None)
        if form is None or effect.acts not in (EffectTarget.JOINT, EffectTarget.POSITION):
            raise DataError(
                f"between: {effect.id} is no torque of one joint that a motion determines; "
                "expected two such effects"
            )
        j = bounds.joints.index(joint)
        scale = JointScale(
            float(bounds.speed[j]),
            float(2.0 * bounds.half_range[j]),
            float(load[j]) or 1.0,
            spec.joints[j].unit == "rad",
            float(bounds.mid_range[j]),
        )
        every = list(expand_grid(effect, form, joint, j, scale))
        places = np.unique(np.linspace(0, len(every) - 1, THRESHOLDS.grid_entries).astype(int))
        return [every[k] for k in places]

    def _compute_signals(self, x: np.ndarray) -> Signals:
        q, qd, qdd = (
            np.tile(part, (self._laps, 1)) for part in self.task.series.evaluate_motion(x)
        )
        step = self.task.series.duration / len(self.task.series.time)
        time = np.arange(len(q)) * step
        segment = Segment(
            0,
            time,
            step,
            q,
            qd,
            qdd,
            0.0 * q,
            {},
            np.ones(len(q), dtype=bool),
            np.full(q.shape, -1),
        )
        return Signals(segment, segment.valid, q, qd, qdd, self._reference)

    def _compute_blocks(self, x: np.ndarray) -> list[list[np.ndarray]]:
        """Weighted columns of both effects, one block (n J, k) for each shape."""
        signals, weights = self._compute_signals(x), self.task.weights[:, None]
        return [
            [
                (block * weights).reshape(-1, block.shape[2])
                for block in (evaluate_columns(candidate, signals) for candidate in grid)
            ]
            for grid in self._grids
        ]

    def _compute_unexplained(
        self, x: np.ndarray
    ) -> tuple[list[list[np.ndarray]], list[np.ndarray]]:
        """The blocks; and of each effect and shape, the square that model and other leave."""
        W = self.task.compute_rows(self.task.series.evaluate_motion(x))
        # Every lap has the same columns of the model: one lap of Q is that of all, scaled.
        Q = np.tile(np.linalg.qr(W)[0], (self._laps, 1)) / np.sqrt(self._laps)
        blocks = self._compute_blocks(x)
        beyond = [[block - Q @ (Q.T @ block) for block in group] for group in blocks]
        bases = [[np.linalg.qr(block)[0] for block in group] for group in beyond]
        squares = [
            np.array(
                [
                    min(np.sum((block - Q @ (Q.T @ block)) ** 2) for Q in bases[1 - k])
                    for block in beyond[k]
                ]
            )
            for k in range(2)
        ]
        return blocks, squares

    def evaluate_motion(self, x: np.ndarray) -> float:
        """Returns a number that is small where both effects are discriminated."""
        _, squares = self._compute_unexplained(x)
        shares = itertools.chain(*(s / u for s, u in zip(squares, self._usual, strict=True)))
        return -float(np.mean([np.log(max(share, THRESHOLDS.rounding_share)) for share in shares]))

    def compute_remainder(self, x: np.ndarray) -> tuple[tuple[float, float], tuple[float, float]]:
        """Computes, of each effect, the share of its columns that is left, and its size."""
        blocks, squares = self._compute_unexplained(x)
        shares, sizes = [], []
        for k in range(2):
            whole = np.array([np.sum(block**2) for block in blocks[k]])
            shares.append(float(np.mean(np.sqrt(squares[k] / np.maximum(whole, 1e-300)))))
            sizes.append(float(np.mean(np.sqrt(squares[k]))))
        return (shares[0], shares[1]), (sizes[0], sizes[1])


# Which of given motions to take: the subset with the smallest condition number.


@dataclass(frozen=True)
class MotionSubset:
    """A subset of motions.

    Attributes:
        places: of those chosen, in the order given.
        condition: of their rows together, columns of length one.
        whole: of all motions together.
        single_conditions: of each motion by itself.
        is_exhaustive: True if every subset was looked at.
    """

    places: tuple[int, ...]
    condition: float
    whole: float
    single_conditions: tuple[float, ...]
    is_exhaustive: bool


def choose_motions(rows: Sequence[np.ndarray], count: int) -> MotionSubset:
    """Chooses the `count` motions whose rows together have the smallest condition number.

    How Guegan, Khalil and Lemoine 2003 (section 5) and Gautier and Khalil 1992 choose
    trajectories. All subsets where there are at most 20 000, else one motion after the other and
    then exchanges of one for one as long as they help.

    Args:
        rows: (rows, c) of each motion, weighted.
        count: how many to take.

    Raises:
        DataError: more wanted than given, or no subset that determines all columns.
    """
    if not 1 <= count <= len(rows):
        raise DataError(f"choose: got {count} of {len(rows)} motions; expected 1 to {len(rows)}")
    triangles = [np.asarray(np.linalg.qr(W, mode="r")) for W in rows]

    def compute_subset_condition(places: Sequence[int]) -> float:
        return compute_condition(np.vstack([triangles[k] for k in places]))

    exhaustive = math.comb(len(rows), count) <= THRESHOLDS.max_subsets
    if exhaustive:
        best = min(itertools.combinations(range(len(rows)), count), key=compute_subset_condition)
    else:
        best = _exchange_motions(triangles, count, compute_subset_condition)
    if not math.isfinite(compute_subset_condition(best)):
        raise DataError(
            f"choose: no {count} of these {len(rows)} motions excite all parameters; take more, or "
            "motions that move other joints"
        )
    every = tuple(compute_subset_condition([k]) for k in range(len(rows)))
    return MotionSubset(
        tuple(best),
        compute_subset_condition(best),
        compute_subset_condition(range(len(rows))),
        every,
        exhaustive,
    )


def _exchange_motions(
    triangles: list[np.ndarray],
    count: int,
    compute_subset_condition: Callable[[Sequence[int]], float],
) -> tuple[int, ...]:
    """Greedy, then one for one: by the weakest singular value first, where columns lack."""
    lengths = np.sqrt(sum(np.sum(R**2, axis=0) for R in triangles))
    scaled = [R / np.where(lengths > 0.0, lengths, 1.0) for R in triangles]

    def compute_penalty(places: Sequence[int]) -> float:
        sizes = np.linalg.svd(np.vstack([scaled[k] for k in places]), compute_uv=False)
        full = np.zeros(scaled[0].shape[1])
        full[: len(sizes)] = sizes
        # Sum of 1/s^2, bounded so that what lacks rank can still be compared.
        return float(np.sum(1.0 / (full**2 + 1e-12 * full[0] ** 2)))

    chosen: list[int] = []
    left = list(range(len(triangles)))
    while len(chosen) < count:
        chosen.append(
            min((k for k in left if k not in chosen), key=lambda k: compute_penalty([*chosen, k]))
        )
    chosen.sort()
    here, improving = compute_subset_condition(chosen), True
    while improving:
        trials = [
            sorted([*(c for c in chosen if c != out), into])
            for out in chosen
            for into in left
            if into not in chosen
        ]
        best = min(trials, key=compute_subset_condition)
        improving = compute_subset_condition(best) < here * (1.0 - 1e-12)
        if improving:
            chosen, here = best, compute_subset_condition(best)
    return tuple(chosen)
