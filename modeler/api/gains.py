"""Logs of currents and a load that was weighed: the model with the gains of its drives."""

import dataclasses
from collections.abc import Callable, Sequence

from modeler.api.chain import AnyLog, Mapped, compile_model, generate, identified, read_currents
from modeler.api.door import fitting
from modeler.api.steps import Steps, silent
from modeler.api.ways import Way, judged
from modeler.compiled import CompiledModel
from modeler.core.contract import ModuleSpec
from modeler.derivation import Derivation
from modeler.fit import GainFit, IdentifiedModel, Payload, identify_gains
from modeler.fit.alike import not_together, remounted
from modeler.fit.doubts import Doubt
from modeler.fit.known import deviations
from modeler.fit.payload import loaded_equations
from modeler.observation import Log, Observation, Processing, observe
from modeler.observation.apart import check_apart
from modeler.robot import robot_from_text
from modeler.robot.edit import with_drive_gains

Checked = Callable[[Sequence[Log], Sequence[Log]], None]
"""Refuses logs, bare and loaded, that do not belong together."""


@dataclasses.dataclass(frozen=True)
class Load:
    """A load of known mass that some logs carry.

    Attributes:
        logs: the loaded logs.
        mass: kg.
        link: row of the table; None: the platform, or the last joint's link.
        moved: True if it was taken off between these logs.
    """

    logs: Sequence[AnyLog]
    mass: float | None
    link: str | None = None
    moved: bool = False

    def __post_init__(self) -> None:
        """One log alone stands for a list of it."""
        object.__setattr__(self, "logs", fitting("Load", "logs", Sequence[AnyLog], self.logs))

    def payloads(self, loaded: Sequence[Log]) -> list[Payload]:
        """It, as the fit knows it; one for each log if it was taken off in between."""
        payload = Payload(tuple(log.name for log in loaded), self.link, self.mass)
        return remounted(payload) if self.moved else [payload]


def _apart(logs: Sequence[Log], loaded: Sequence[Log]) -> None:
    check_apart([*logs, *loaded])


def fit_gains(
    derivation: Derivation,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing | None = None,
) -> IdentifiedModel:
    """The model whose robot file has the drive gains that the logs tell (see docs/drive-gains.md).

    Args:
        derivation: of the robot; its file states no gains, or starts for them.
        logs: of currents, without load.
        load: that was weighed, and the logs that carry it.
        processing: None: chosen from the logs.

    Raises:
        DataError: logs of torques, rows given twice, or gains that the logs do not tell.
    """
    compiled = compile_model(generate(derivation))
    return found_with_gains(derivation, compiled, logs, load, processing or Processing())[0]


def found_with_gains(
    derivation: Derivation,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing,
    check: Checked = _apart,
    working: Steps = silent,
    mapping: Mapped = (),
) -> tuple[IdentifiedModel, Observation]:
    """The same, and the observation that the model was fitted to.

    The gains are found first. Then the logs are read once more with them, as whoever uses the model
    will: all that is told of the fit is told of those torques.
    """
    with working("finding the drive gains"):
        observation, payloads = _observed(compiled, logs, load, processing, check, mapping)
        found = identify_gains(compiled, observation, payloads)
    choices = observation.report.choices
    with working("reading the currents with these gains"):
        derivation = _with_gains(derivation, found)
        emitted = generate(derivation)
        again = compile_model(emitted)
        observation, payloads = _observed(
            again, logs, load, observation.report.processing, check, mapping
        )
        result = identify_gains(again, observation, payloads).result
    with working("judging the fit"):
        apart = not_together(again, observation, payloads)
        told = [Doubt(line, values=True) for line in apart]
        equations = loaded_equations(again, observation, payloads).equations
        result = judged(again, observation, Way(result, told, equations=equations))
    said = _deviations(compiled.spec, found)
    result = dataclasses.replace(result, sentences=(*result.sentences, *said))
    report = dataclasses.replace(observation.report, choices=choices)
    observation = dataclasses.replace(observation, report=report)
    return identified(derivation, emitted, observation, result), observation


def _with_gains(derivation: Derivation, found: GainFit) -> Derivation:
    """The same robot, its file with these gains."""
    gains = {joint: float(f"{gain:.7g}") for joint, gain in found.gains.items()}
    text = with_drive_gains(derivation.robot.text, gains)
    robot = robot_from_text(text, derivation.robot.name)
    model = dataclasses.replace(derivation.model, robot=robot)
    return dataclasses.replace(derivation, robot=robot, model=model)


def _observed(
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing,
    check: Checked,
    mapping: Mapped,
) -> tuple[Observation, list[Payload]]:
    bare, loaded = (read_currents(compiled, some, mapping) for some in (logs, load.logs))
    check(bare, loaded)
    return observe(compiled, [*bare, *loaded], processing), load.payloads(loaded)


def _deviations(spec: ModuleSpec, found: GainFit) -> list[str]:
    lines = deviations(spec, found)
    return [f"against the robot file: {'; '.join(lines)}"] if lines else []
