"""The motion that tells two effects apart."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.effects import Acts, Effect
from modeler.excite.bounds import Bounds
from modeler.excite.descent import evolve
from modeler.excite.result import Exciting
from modeler.excite.search import Deadline, Wish, drawn_motions, finished, task_of
from modeler.excite.task import Task
from modeler.hypotheses.candidates import Candidate, JointScale, over_grid
from modeler.hypotheses.columns import all_columns
from modeler.hypotheses.signals import Reference, Signals
from modeler.observation.motion import Segment

_GENERATIONS = 150
_FIRST = 0.15  # of the half ranges: size of the first steps
_ENTRIES = 5  # shapes of an effect that are looked at, spread over its grid
_NOTHING = 1e-14  # share of a column that is rounding

Whose = tuple[Effect, str]
"""An effect on a joint."""


@dataclass(frozen=True, eq=False)
class Question:
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
class Apart:
    """How well a motion tells the two apart.

    Attributes:
        names: of the effects.
        left: of the torque of each, the share (of its norm) that neither the model nor the other
            effect can explain; for the shapes of the other that explain most.
        random: the same of the best of the random motions.
        gain: by how much the unexplained torque itself is larger than on that motion.
    """

    names: tuple[str, str]
    left: tuple[float, float]
    random: tuple[float, float]
    gain: tuple[float, float]

    def lines(self) -> list[str]:
        """Lines of text."""
        return [
            f"{name}: {here:.1%} of its torque is explained by neither the model nor {other}; best "
            f"of the random motions {there:.1%}; that part is {gain:.3g} times as large"
            for name, other, here, there, gain in zip(
                self.names, self.names[::-1], self.left, self.random, self.gain, strict=True
            )
        ]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            name: {"left": a, "left_random": b, "gain": c}
            for name, a, b, c in zip(self.names, self.left, self.random, self.gain, strict=True)
        }


def tell_apart(
    compiled: CompiledModel,
    bounds: Bounds,
    wish: Wish,
    question: Question,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[Exciting, Apart]:
    """The motion along which two effects are least alike.

    Maximises what is left of each effect's columns after projection on the columns of the model
    and of the other effect, for the shapes of the other that leave least: geometric mean over
    both effects and their shapes. Of memory and time no slope is at hand, so by evolution.

    Raises:
        DataError: an effect that no columns on a joint describe, or what `excite` refuses.
    """
    on = Deadline(wish.time_limit)
    task = task_of(compiled, bounds, wish, question.sigma, None, question.beta)
    rng = np.random.default_rng([wish.seed, 7])
    drawn = drawn_motions(task, rng, on)
    columns = _Pair(task, question, [x for x, _ in drawn], wish.laps, on)
    best = min(on.through(x for x, _ in drawn), key=columns.value)

    def proceed(generation: int) -> bool:
        progress(generation / _GENERATIONS)
        return on()

    motion = finished(task, _evolved(columns, best, rng, proceed), wish, drawn, on)
    x = motion.x
    (here, size), (there, before) = columns.left(x), columns.left(best)
    names = tuple(f"{effect.id}@{joint}" for effect, joint in question.effects)
    gain = tuple(a / b if b > 0.0 else float("inf") for a, b in zip(size, before, strict=True))
    return motion, Apart((names[0], names[1]), here, there, (gain[0], gain[1]))


def _evolved(
    columns: "_Pair", x: np.ndarray, rng: np.random.Generator, on: Callable[[int], bool]
) -> np.ndarray:
    """The best motion that evolution finds from x; those beyond limits are drawn back in."""
    task = columns.task
    unit = task.bounds.half[:, None]

    def pulled_in(flat: np.ndarray) -> np.ndarray:
        return task.drawn_in(flat.reshape(x.shape) * unit)

    found = evolve(
        lambda flat: columns.value(pulled_in(flat)),
        (x / unit).ravel(), _FIRST, _GENERATIONS, rng, on,
    )  # fmt: skip
    return pulled_in(found)


class _Pair:
    """The columns of two effects along motions."""

    def __init__(
        self, task: Task, question: Question, drawn: list[np.ndarray], laps: int, on: Deadline
    ) -> None:
        self.task, self._laps = task, laps
        self._reference = Reference(task.columns.compiled, question.beta, 0.0, {})
        loads = [self._signals(x).load for x in on.through(drawn[:5])]
        load = np.sqrt(np.mean(np.concatenate(loads) ** 2, axis=0))
        self._grids = [self._grid(whose, load) for whose in question.effects]
        sizes = [self._blocks(x) for x in on.through(drawn)]
        self._usual = [
            np.mean([[np.sum(block**2) for block in blocks[k]] for blocks in sizes], axis=0)
            for k in range(2)
        ]

    def _grid(self, whose: Whose, load: np.ndarray) -> list[Candidate]:
        effect, joint = whose
        bounds, spec = self.task.bounds, self.task.columns.compiled.spec
        form = next((form for form in effect.forms if "T" not in form.names), None)
        if form is None or effect.acts not in (Acts.JOINT, Acts.POSITION):
            raise DataError(
                f"between: {effect.id} is no torque of one joint that a motion determines; "
                "expected two such effects"
            )
        j = bounds.joints.index(joint)
        scale = JointScale(
            float(bounds.speed[j]), float(2.0 * bounds.half[j]), float(load[j]) or 1.0,
            spec.joints[j].unit == "rad", float(bounds.middle[j]),
        )  # fmt: skip
        every = list(over_grid(effect, form, joint, j, scale))
        places = np.unique(np.linspace(0, len(every) - 1, _ENTRIES).astype(int))
        return [every[k] for k in places]

    def _signals(self, x: np.ndarray) -> Signals:
        q, qd, qdd = (np.tile(part, (self._laps, 1)) for part in self.task.series.motion(x))
        step = self.task.series.duration / len(self.task.series.time)
        time = np.arange(len(q)) * step
        nothing = np.zeros_like(q)
        segment = Segment(
            0, time, step, q, qd, qdd, nothing, {},
            np.ones(len(q), dtype=bool), np.ones(q.shape, dtype=bool), {},
        )  # fmt: skip
        return Signals(segment, 1, q, qd, qdd, self._reference)

    def _blocks(self, x: np.ndarray) -> list[list[np.ndarray]]:
        """Weighted columns of both effects, one block (n J, k) for each shape."""
        signals, weights = self._signals(x), self.task.weights[:, None]
        return [
            [
                (block * weights).reshape(-1, block.shape[2])
                for block in (all_columns(candidate, signals) for candidate in grid)
            ]
            for grid in self._grids
        ]

    def _beyond_model(self, x: np.ndarray) -> tuple[list[list[np.ndarray]], list[list[np.ndarray]]]:
        """The blocks, and what the model leaves of them."""
        W = self.task.rows(self.task.series.motion(x))
        # Every lap has the same columns of the model: one lap of Q is that of all, scaled.
        Q = np.tile(np.linalg.qr(W)[0], (self._laps, 1)) / np.sqrt(self._laps)
        blocks = self._blocks(x)
        return blocks, [[block - Q @ (Q.T @ block) for block in own] for own in blocks]

    def _unexplained(self, x: np.ndarray) -> tuple[list[list[np.ndarray]], list[np.ndarray]]:
        """The blocks; and of each effect and shape, the square that model and other leave."""
        blocks, beyond = self._beyond_model(x)
        bases = [[np.linalg.qr(block)[0] for block in own] for own in beyond]
        squares = [
            np.array([
                min(np.sum((block - Q @ (Q.T @ block)) ** 2) for Q in bases[1 - k])
                for block in beyond[k]
            ])
            for k in range(2)
        ]  # fmt: skip
        return blocks, squares

    def value(self, x: np.ndarray) -> float:
        """Small where both are well told apart."""
        _, squares = self._unexplained(x)
        shares = itertools.chain(*(s / u for s, u in zip(squares, self._usual, strict=True)))
        return -float(np.mean([np.log(max(share, _NOTHING)) for share in shares]))

    def left(self, x: np.ndarray) -> tuple[tuple[float, float], tuple[float, float]]:
        """Of each effect, the share of its columns that is left, and its size; means of shapes."""
        blocks, squares = self._unexplained(x)
        shares, sizes = [], []
        for k in range(2):
            whole = np.array([np.sum(block**2) for block in blocks[k]])
            shares.append(float(np.mean(np.sqrt(squares[k] / np.maximum(whole, 1e-300)))))
            sizes.append(float(np.mean(np.sqrt(squares[k]))))
        return (shares[0], shares[1]), (sizes[0], sizes[1])
