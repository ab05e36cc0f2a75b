"""The ways to fit: one model or the other, with loads or without, in one step or two."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.core.errors import GAIN_METHOD, TWO_STEPS, DataError
from modeler.core.estimators import ABOUT
from modeler.estimation import two_step_result as two_step
from modeler.estimation.doubts import Told
from modeler.estimation.drive_gains import are_currents
from modeler.estimation.energy_fit import identify_energy
from modeler.estimation.identify import Equations, identify
from modeler.estimation.known import known_doubts
from modeler.estimation.payload import Payload, identify_with_payloads, loaded_equations
from modeler.estimation.result import FitResult
from modeler.estimation.two_step import Directions
from modeler.estimation.verdict import with_verdict
from modeler.numerics.least_squares import Compressed
from modeler.observation.findings import findings_of_fit
from modeler.observation.observation import Observation
from modeler.robot.motors import joint_directions
from modeler.robot.robot import Robot, near
from modeler.runtime.model import CompiledModel

WITHOUT_LOADS = ("iv", "iv-direct", "didim", "consistent", TWO_STEPS)
"""Methods that know no loads."""

OF_WINDOWS = ("weighted", "ordinary")
"""Methods of the energy model."""


@dataclass(frozen=True)
class FitRequest:
    """How a fit is to be made.

    Attributes:
        method: an id of `core.estimators`, or "two-step".
        energy: True for the energy model, whose rows are windows.
        window: its length, s; None: the spacing of the torque model's rows.
        payloads: loads that some logs carry.
        below: percent of sigma that essential parameters are below; None: an F-test finds them.
    """

    method: str = "weighted"
    energy: bool = False
    window: float | None = None
    payloads: tuple[Payload, ...] = ()
    below: float | None = None


@dataclass(frozen=True, eq=False)
class Way:
    """What a way to fit ends in.

    Attributes:
        result: not judged yet.
        told: doubts that it raises itself.
        refit: how to fit again without some rows; None: least squares.
        lines: printed above the result.
        further: fields of the JSON.
        equations: that were fitted; None: those of the bare robot.
    """

    result: FitResult
    told: Sequence[Told] = ()
    refit: Callable[[np.ndarray], np.ndarray] | None = None
    lines: Sequence[str] = ()
    further: Mapping[str, Any] = field(default_factory=dict)
    equations: Equations | None = None


def estimated(
    asked: FitRequest, robot: Robot, compiled: CompiledModel, observation: Observation
) -> Way:
    """The fit that is asked for.

    Raises:
        DataError: choices that do not go together, or what the estimator refuses.
    """
    _check(asked)
    method: Any = asked.method
    if asked.energy:
        energy = identify_energy(compiled, observation, asked.window, method, asked.below)
        return Way(energy.result, refit=energy.without)
    if asked.method == TWO_STEPS:
        ways = Directions(joint_directions(robot))
        steps = two_step.identify_in_two_steps(compiled, observation, ways, asked.below)
        further = {"two_step": steps.to_json()}
        return Way(steps.result, steps.doubts(), lines=steps.lines(), further=further)
    if asked.payloads:
        result = identify_with_payloads(compiled, observation, asked.payloads, method, asked.below)
        current = are_currents(observation.report.logs)
        told = known_doubts(compiled, observation, asked.payloads, current)
        equations = loaded_equations(compiled, observation, asked.payloads).equations
        return Way(result, told, equations=equations)
    return Way(identify(observation, method, compiled, asked.below))


def judged(
    compiled: CompiledModel, observation: Observation, way: Way, data: Compressed | None = None
) -> FitResult:
    """Its result with the verdict, to which all that is found in the logs counts.

    Args:
        compiled: the robot.
        observation: that was fitted.
        way: how.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    told = [*way.told, *findings_of_fit(compiled, observation, way.result.beta)]
    return with_verdict(compiled, observation, way.result, told, way.equations, way.refit, data)


def _check(asked: FitRequest) -> None:
    """Refuse choices that do not go together."""
    if asked.method == GAIN_METHOD:
        raise DataError(
            f"fit: got method {GAIN_METHOD}, which reads the logs itself; call fit_gains with "
            "them and the mass of the load"
        )
    known = [*ABOUT, TWO_STEPS]
    if asked.method not in known:
        raise DataError(
            f"fit: got method {asked.method}{near(str(asked.method), known)}; expected one of "
            f"{', '.join(known)}"
        )
    if asked.payloads and (asked.energy or asked.method in WITHOUT_LOADS):
        what = "the energy model" if asked.energy else f"method {asked.method}"
        raise DataError(f"fit: got payloads with {what}, which knows no loads; leave them out")
    if asked.energy and asked.method not in OF_WINDOWS:
        raise DataError(
            f"fit: got method {asked.method} for the energy model, whose rows are windows; "
            f"expected {' or '.join(OF_WINDOWS)}"
        )
    if asked.window is not None and not asked.energy:
        raise DataError("fit: got a window; only those of the energy model have a length")
