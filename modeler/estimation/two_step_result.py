"""A two-step fit as a result: its values, whether the logs excite them, and the one-step fit."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.errors import TWO_STEPS
from modeler.core.json import entries
from modeler.core.table import percent
from modeler.estimation.doubts import HALF, LITTLE
from modeler.estimation.essential import essential_parameters
from modeler.estimation.identify import all_rows, base_equations, identify, result_of
from modeler.estimation.result import FitResult
from modeler.estimation.two_step import Configuration, Directions, TwoStep, two_steps
from modeler.observation import Doubt, Observation
from modeler.runtime import CompiledModel

# Persistent excitation of a two-step fit: the singular values of Phi, joint by joint.


_ZERO = 1e-8  # of the largest singular value
_POSES = 4  # per column, at which the largest possible rank is found
_SEED = 1872


@dataclass(frozen=True)
class PersistentExcitation:
    """Phi of the inertia of one joint: J(configuration) = Phi beta.

    Attributes:
        joint: name.
        configurations: at which it moved alone.
        singular_values: of Phi, those that are 0 left out, largest first.
        possible_rank: of Phi at ever so many configurations.
        usual_ratio: last of the singular values over the first at ever so many configurations.
    """

    joint: str
    configurations: int
    singular_values: tuple[float, ...]
    possible_rank: int
    usual_ratio: float

    @property
    def rank(self) -> int:
        """Of Phi at these configurations."""
        return len(self.singular_values)

    def line(self) -> str:
        """For people."""
        values = self.singular_values
        listed = " ".join(f"{value:.3g}" for value in values)
        ratio = values[-1] / values[0] if values else 0.0
        return (
            f"J of joint {self.joint} at {self.configurations} configurations: rank "
            f"{self.rank} of {self.possible_rank}, singular values of Phi {listed} (last "
            f"{ratio:.2g} of the first; {self.usual_ratio:.2g} at many random ones)"
        )

    def sentence(self) -> str:
        """What to do where it is not persistent."""
        return (
            f"joint {self.joint} moves alone at {self.configurations} configurations, which tell "
            f"{self.rank} of the {self.possible_rank} combinations in its inertia: not "
            f"persistently exciting; move it at {self.possible_rank - self.rank} or more further "
            "configurations of the other joints"
        )

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        names = "joint configurations singular_values rank possible_rank usual_ratio"
        return entries(self, names)


def excitations(
    model: CompiledModel, observation: Observation, steps: TwoStep
) -> tuple[PersistentExcitation, ...]:
    """Of every joint that moved alone; what is possible is what random poses give.

    Robots with loops cannot take any pose: theirs are those of the logs.
    """
    columns, directions = len(observation.names), steps.directions
    if model.spec.closure is None:
        rng = np.random.default_rng(_SEED)
        poses = rng.uniform(-np.pi, np.pi, (_POSES * columns, len(directions.names)))
    else:
        spread = np.linspace(0, len(observation.q) - 1, _POSES * columns).astype(int)
        poses = observation.q[spread]
    found = []
    for i in sorted({c.joint for c in steps.configurations}):
        own = np.array([c.pose for c in steps.configurations if c.joint == i]) @ directions.rows
        rows, best = (inertia_rows(model, q, directions.rows[i]) for q in (own, poses))
        name, every = directions.names[i], _values(best)
        usual = every[-1] / every[0]
        found.append(PersistentExcitation(name, len(own), _values(rows), len(every), usual))
    return tuple(found)


def inertia_rows(model: CompiledModel, q: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(t, c) Phi of J = d^T M(q) d = Phi beta at poses q (t, n)."""
    still, moved = np.zeros_like(q), np.tile(direction, (len(q), 1))
    rows = model.base_regressor(q, still, moved) - model.base_regressor(q, still, still)
    return np.einsum("tjc,j->tc", rows, direction)


def _values(rows: np.ndarray) -> tuple[float, ...]:
    values = np.linalg.svd(rows, compute_uv=False)
    return tuple(float(value) for value in values if value > _ZERO * values[0])


@dataclass(frozen=True, eq=False)
class TwoStepFit:
    """A two-step fit beside the one-step fit of the same logs.

    Attributes:
        result: of the two steps, for the model file.
        steps: configurations and Phi.
        excitation: of each joint that moved alone.
        one_step: the weighted least squares of all rows.
    """

    result: FitResult
    steps: TwoStep
    excitation: tuple[PersistentExcitation, ...]
    one_step: FitResult

    def lines(self) -> list[str]:
        """Lines: step 1 by configuration, what Phi tells, both fits beside each other."""
        unused = [
            f"{count} piece{'s' * (count > 1)} not used: {why}"
            for why, count in self.steps.left_out.items()
        ]
        if self.steps.several > 0.0:
            unused.append(f"{self.steps.several:.3g} s not used: several joints move")
        return [
            "step 1: one joint moves, the others stand",
            *(f"  {line}" for line in (*map(self._line, self.steps.configurations), *unused)),
            "step 2: theta = Phi beta",
            *(f"  {excitation.line()}" for excitation in self.excitation),
            *self._compared(),
        ]

    def doubts(self) -> list[Doubt]:
        """Joints that never moved alone, where torques are not described for want of them."""
        used = {c.joint for c in self.steps.configurations}
        never = [name for k, name in enumerate(self.steps.directions.names) if k not in used]
        short = all(why.startswith("too short") for why in self.steps.left_out)
        worst = max(joint.relative_error or 0.0 for joint in self.result.joints)
        line = (
            f"joint {', '.join(never)} never moved alone for long enough, and the two steps use no "
            "other motion: what only its torque tells is not found; record more motion of it "
            "alone, or take --method weighted"
        )
        doubt = Doubt(line, certain=worst > HALF, values=True)
        return [doubt] if never and short and worst > LITTLE else []

    def _line(self, c: Configuration) -> str:
        names = self.steps.directions.names
        where = ", ".join(f"q{name} {x:.2f}" for name, x in self._others(c).items())
        cells = [
            f"{'J' if name == 'qdd' else name} {x:.5g} +- {s:.2g}"
            for name, x, s in c.coefficients(0)
        ]
        further = [names[f.joint] for f in c.felt[1:]]
        also = f"; torque of joint {', '.join(further)} too" if further else ""
        return (
            f"{c.log}, {c.start:.2f} to {c.end:.2f} s: joint {names[c.joint]} at {where or '-'}: "
            f"{', '.join(cells)}{also}"
        )

    def _others(self, c: Configuration) -> dict[str, float]:
        names = self.steps.directions.names
        return {names[k]: float(x) for k, x in enumerate(c.pose) if k != c.joint}

    def _compared(self) -> list[str]:
        width = max([9, *(len(p.name) for p in self.result.parameters)])
        lines = [
            f"{'parameter':<{width}} {'two-step':>12} {'sigma':>9} {'one-step':>12} {'sigma':>9}"
        ]
        for two, one in zip(self.result.parameters, self.one_step.parameters, strict=True):
            cells = [
                f"{p.value:>12.6g} {p.sigma:>9.3g}" if p.sigma is not None
                else f"{'set aside':>12} {'':>9}"
                for p in (two, one)
            ]  # fmt: skip
            lines.append(f"{two.name:<{width}} {cells[0]} {cells[1]}")
        lines.append(
            f"relative error {percent(self.result.relative_error)} in two steps, "
            f"{percent(self.one_step.relative_error)} in one"
        )
        return lines

    def to_json(self) -> dict[str, Any]:
        """The object `two_step` beside that of the fit."""
        names = self.steps.directions.names
        return {
            "configurations": [
                {
                    **entries(c, "log start end"),
                    "joint": names[c.joint],
                    "others": self._others(c),
                    "rows": len(c.felt[0].residual),
                    "torques": {
                        names[f.joint]: {
                            name: {"value": x, "sigma": s} for name, x, s in c.coefficients(k)
                        }
                        for k, f in enumerate(c.felt)
                    },
                }
                for c in self.steps.configurations
            ],
            "left_out": dict(self.steps.left_out),
            "several_moving": self.steps.several,
            "excitation": [excitation.to_json() for excitation in self.excitation],
            "one_step": [parameter.to_json() for parameter in self.one_step.parameters],
        }


def identify_in_two_steps(
    model: CompiledModel,
    observation: Observation,
    directions: Directions,
    below: float | None = None,
) -> TwoStepFit:
    """The two-step fit of an observation, and the one-step fit beside it.

    Args:
        model: the robot.
        observation: of logs in which joints move one at a time.
        directions: how the coordinates move with each joint.
        below: as for `identify`.

    Raises:
        DataError: no piece in which one joint moves and the others stand, or what `identify` says.
    """
    one = identify(observation)
    steps = two_steps(model, observation, directions)
    excitation = excitations(model, observation, steps)
    estimate = steps.estimate
    essential = essential_parameters(steps.data, estimate, "ordinary", below)
    result = result_of(
        base_equations(observation), TWO_STEPS, estimate, essential, all_rows(observation),
        rows=sum(len(f.residual) for c in steps.configurations for f in c.felt),
        sentences=(
            *(e.sentence() for e in excitation if e.rank < e.possible_rank),
            *(tangle.sentence() for tangle in estimate.rank.aside),
        ),
    )  # fmt: skip
    return TwoStepFit(result, steps, excitation, one)
