"""A two-step fit as a result: its values, whether the logs excite them, and the one-step fit."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.choices import TWO_STEPS
from modeler.core.json import select_attributes
from modeler.core.table import format_percent
from modeler.estimation.doubts import HALF, LITTLE
from modeler.estimation.essential import select_essential_parameters
from modeler.estimation.identify import (
    build_base_equations,
    build_result,
    compress_all_rows,
    identify,
)
from modeler.estimation.result import FitResult
from modeler.estimation.two_step import (
    Configuration,
    JointDirections,
    TwoStepEstimate,
    estimate_two_steps,
)
from modeler.regression import DataWarning, Observation
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

    def format_line(self) -> str:
        """For people."""
        values = self.singular_values
        listed = " ".join(f"{value:.3g}" for value in values)
        ratio = values[-1] / values[0] if values else 0.0
        return (
            f"J of joint {self.joint} at {self.configurations} configurations: rank "
            f"{self.rank} of {self.possible_rank}, singular values of Phi {listed} (last "
            f"{ratio:.2g} of the first; {self.usual_ratio:.2g} at many random ones)"
        )

    def describe(self) -> str:
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
        return select_attributes(self, names)


def compute_excitations(
    model: CompiledModel, observation: Observation, steps: TwoStepEstimate
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
    results = []
    for i in sorted({c.joint for c in steps.configurations}):
        joint_poses = (
            np.array([c.pose for c in steps.configurations if c.joint == i]) @ directions.rows
        )
        rows, best = (
            build_inertia_rows(model, q, directions.rows[i]) for q in (joint_poses, poses)
        )
        name, every = directions.names[i], _compute_singular_values(best)
        usual = every[-1] / every[0]
        results.append(
            PersistentExcitation(
                name, len(joint_poses), _compute_singular_values(rows), len(every), usual
            )
        )
    return tuple(results)


def build_inertia_rows(model: CompiledModel, q: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(t, c) Phi of J = d^T M(q) d = Phi beta at poses q (t, n)."""
    still, moved = np.zeros_like(q), np.tile(direction, (len(q), 1))
    rows = model.base_regressor(q, still, moved) - model.base_regressor(q, still, still)
    return np.einsum("tjc,j->tc", rows, direction)


def _compute_singular_values(rows: np.ndarray) -> tuple[float, ...]:
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
    steps: TwoStepEstimate
    excitation: tuple[PersistentExcitation, ...]
    one_step: FitResult

    def format_lines(self) -> list[str]:
        """Lines: step 1 by configuration, what Phi tells, both fits beside each other."""
        unused = [
            f"{count} piece{'s' * (count > 1)} not used: {why}"
            for why, count in self.steps.left_out.items()
        ]
        if self.steps.simultaneous_time > 0.0:
            unused.append(f"{self.steps.simultaneous_time:.3g} s not used: several joints move")
        return [
            "step 1: one joint moves, the others stand",
            *(
                f"  {line}"
                for line in (*map(self._format_line, self.steps.configurations), *unused)
            ),
            "step 2: theta = Phi beta",
            *(f"  {excitation.format_line()}" for excitation in self.excitation),
            *self._compare_fits(),
        ]

    def collect_warnings(self) -> list[DataWarning]:
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
        doubt = DataWarning(line, is_certain=worst > HALF, affects_values=True)
        return [doubt] if never and short and worst > LITTLE else []

    def _format_line(self, c: Configuration) -> str:
        names = self.steps.directions.names
        where = ", ".join(f"q{name} {x:.2f}" for name, x in self._collect_others(c).items())
        cells = [
            f"{'J' if name == 'qdd' else name} {x:.5g} +- {s:.2g}"
            for name, x, s in c.compute_coefficients(0)
        ]
        further = [names[f.joint] for f in c.first_steps[1:]]
        also = f"; torque of joint {', '.join(further)} too" if further else ""
        return (
            f"{c.log}, {c.start:.2f} to {c.end:.2f} s: joint {names[c.joint]} at {where or '-'}: "
            f"{', '.join(cells)}{also}"
        )

    def _collect_others(self, c: Configuration) -> dict[str, float]:
        names = self.steps.directions.names
        return {names[k]: float(x) for k, x in enumerate(c.pose) if k != c.joint}

    def _compare_fits(self) -> list[str]:
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
            f"relative error {format_percent(self.result.relative_error)} in two steps, "
            f"{format_percent(self.one_step.relative_error)} in one"
        )
        return lines

    def to_json(self) -> dict[str, Any]:
        """The object `two_step` beside that of the fit."""
        names = self.steps.directions.names
        return {
            "configurations": [
                {
                    **select_attributes(c, "log start end"),
                    "joint": names[c.joint],
                    "others": self._collect_others(c),
                    "rows": len(c.first_steps[0].residual),
                    "torques": {
                        names[f.joint]: {
                            name: {"value": x, "sigma": s}
                            for name, x, s in c.compute_coefficients(k)
                        }
                        for k, f in enumerate(c.first_steps)
                    },
                }
                for c in self.steps.configurations
            ],
            "left_out": dict(self.steps.left_out),
            "several_moving": self.steps.simultaneous_time,
            "excitation": [excitation.to_json() for excitation in self.excitation],
            "one_step": [parameter.to_json() for parameter in self.one_step.parameters],
        }


def identify_in_two_steps(
    model: CompiledModel,
    observation: Observation,
    directions: JointDirections,
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
    steps = estimate_two_steps(model, observation, directions)
    excitation = compute_excitations(model, observation, steps)
    estimate = steps.estimate
    essential = select_essential_parameters(steps.data, estimate, "ordinary", below)
    result = build_result(
        build_base_equations(observation),
        TWO_STEPS,
        estimate,
        essential,
        compress_all_rows(observation),
        rows=sum(len(f.residual) for c in steps.configurations for f in c.first_steps),
        sentences=(
            *(e.describe() for e in excitation if e.rank < e.possible_rank),
            *(tangle.describe() for tangle in estimate.rank.dropped_columns),
        ),
    )
    return TwoStepFit(result, steps, excitation, one)
