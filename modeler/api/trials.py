"""All estimators on the same logs, side by side."""

from collections.abc import Callable, Sequence

from modeler.api.chain import AnyLog, Mapped, compile_model, derive, generate, read_logs
from modeler.compiled import CompiledModel
from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.estimators import ABOUT
from modeler.fit.side_by_side import SideBySide
from modeler.fit.side_by_side import side_by_side as tried_on
from modeler.observation import observe
from modeler.observation.apart import check_apart
from modeler.observation.observation import Observation
from modeler.robot import Robot
from modeler.robot.place import near


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
