"""Fits besides the usual one: drive gains from a weighed load, all estimators on one log."""

import dataclasses
from collections.abc import Callable, Sequence

from modeler.api.arguments import Steps, fitting, silent
from modeler.api.ways import Way, judged
from modeler.api.workflow import (
    AnyLog,
    Mapped,
    compile_model,
    derive,
    generate,
    identified,
    read_currents,
    read_logs,
)
from modeler.codegen.derivation import Derivation
from modeler.core.errors import DataError, Method
from modeler.core.estimators import ABOUT
from modeler.core.manifest import ModuleSpec
from modeler.estimation.doubts import Doubt, not_together, remounted
from modeler.estimation.drive_gains import GainFit, identify_gains
from modeler.estimation.known import deviations
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.payload import Payload, loaded_equations
from modeler.estimation.side_by_side import SideBySide
from modeler.estimation.side_by_side import side_by_side as tried_on
from modeler.observation.log import Log, check_apart
from modeler.observation.observation import Observation, observe
from modeler.observation.processing import Processing
from modeler.robot.edit import with_drive_gains
from modeler.robot.read import robot_from_text
from modeler.robot.robot import Robot, near
from modeler.runtime.model import CompiledModel

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


# All estimators on the same logs, side by side.


def side_by_side(
    robot: Robot | CompiledModel,
    logs: Sequence[AnyLog],
    holdout: Sequence[AnyLog] = (),
    methods: Sequence[str] | None = None,
    progress: Callable[[float], None] | None = None,
) -> SideBySide:
    """Every estimator on the same logs: values, errors, seconds, and what each says of itself.

    Args:
        robot: as loaded, or compiled.
        logs: to fit.
        holdout: logs of other motion, not fitted: their error.
        methods: some of `estimators()`; None: all.
        progress: called with the share done, 0 to 1.

    Raises:
        DataError: an unknown method, rows given twice, or what the weighted fit raises.
    """
    chosen = chosen_methods(methods)
    compiled = compile_model(generate(derive(robot))) if isinstance(robot, Robot) else robot
    observation, held = observed_apart(compiled, logs, holdout)
    tried = tried_on(observation, compiled, held, chosen, progress)
    return SideBySide(compiled.spec.robot, tried, tuple(observation.report.lines()))


def observed_apart(
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    holdout: Sequence[AnyLog],
    mapping: Mapped = (),
) -> tuple[Observation, Observation | None]:
    """Logs to fit, and held-out ones processed alike; None without any."""
    given, kept = (read_logs(compiled, some, mapping) for some in (logs, holdout))
    check_apart(given, kept)
    observation = observe(compiled, given)
    held = observe(compiled, kept, observation.report.processing) if kept else None
    return observation, held


def chosen_methods(names: Sequence[str] | None, where: str = "methods") -> list[Method]:
    """The estimators of these names, each once; all for None."""
    if names is None:
        return list(ABOUT)
    chosen = [id for name in names for id in ABOUT if id == name]
    unknown = [name for name in names if name not in chosen]
    if unknown or not names:
        got = unknown[0] if unknown else "nothing"
        raise DataError(
            f"{where}: got {got}{near(got, list(ABOUT))}; expected some of "
            f"{', '.join(ABOUT)}, with commas between"
        )
    return [*dict.fromkeys(chosen)]
