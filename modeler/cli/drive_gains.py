"""`modeler fit ROBOT LOG... --payload-log LOG --payload-mass KG --method tls`."""

import argparse
import dataclasses
from collections.abc import Callable, Sequence

from modeler.api import compile_model, generate, identified, read_currents
from modeler.cli.console import working
from modeler.compiled import CompiledModel
from modeler.core.contract import ModuleSpec
from modeler.core.errors import DataError
from modeler.derivation import Derivation
from modeler.fit import (
    GainFit,
    IdentifiedModel,
    Payload,
    identify_gains,
    with_verdict,
)
from modeler.fit.alike import not_alike
from modeler.fit.doubts import Doubt, Told
from modeler.fit.known import deviations
from modeler.fit.mounting import mounted_differently, remounted
from modeler.observation import Log, Observation, Processing, observe
from modeler.observation.findings import findings_of_fit
from modeler.robot import robot_from_text
from modeler.robot.edit import with_drive_gains

Checked = Callable[[argparse.Namespace, Sequence[Log], Sequence[Log]], None]
"""Refuses logs that do not belong together."""


def fit_with_gains(
    args: argparse.Namespace,
    derivation: Derivation,
    compiled: CompiledModel,
    processing: Processing,
    check: Checked,
) -> tuple[IdentifiedModel, Observation]:
    """The model whose robot file has the drive gains that the logs tell.

    The gains are found first. Then the logs are read once more with them, as whoever uses the model
    will: all that is told of the fit is told of those torques.
    """
    check_load(args)
    with working("finding the drive gains"):
        observation, payloads = _observed(args, compiled, processing, check)
        found = identify_gains(compiled, observation, payloads)
    choices = observation.report.choices
    with working("reading the currents with these gains"):
        gains = {joint: float(f"{gain:.7g}") for joint, gain in found.gains.items()}
        text = with_drive_gains(derivation.robot.text, gains)
        robot = robot_from_text(text, derivation.robot.name)
        model = dataclasses.replace(derivation.model, robot=robot)
        derivation = dataclasses.replace(derivation, robot=robot, model=model)
        emitted = generate(derivation)
        again = compile_model(emitted)
        observation, payloads = _observed(args, again, observation.report.processing, check)
        result = identify_gains(again, observation, payloads).result
    with working("judging the fit"):
        told: list[Told] = [*findings_of_fit(again, observation, result.beta)]
        apart = mounted_differently(again, observation, payloads)
        apart = apart or not_alike(again, observation, payloads)
        told += [Doubt(line, values=True) for line in apart]
        loaded = {name for payload in payloads for name in payload.logs}
        bare = [name for name in observation.logs if name not in loaded]
        result = with_verdict(again, observation, result, told, bare)
    said = _deviations(compiled.spec, found)
    result = dataclasses.replace(result, sentences=(*result.sentences, *said))
    report = dataclasses.replace(observation.report, choices=choices)
    observation = dataclasses.replace(observation, report=report)
    return identified(derivation, emitted, observation, result), observation


def check_load(args: argparse.Namespace) -> None:
    """Nothing, if a loaded log and the mass of its load are given.

    Raises:
        DataError: says which is missing.
    """
    if not args.payload_log:
        raise DataError(
            "--method tls: no loaded log; the gains of drives show in what a load of known mass "
            "adds to their currents; add --payload-log LOG --payload-mass KG"
        )
    if args.payload_mass is None:
        raise DataError(
            "--method tls: no --payload-mass; without a known mass all gains and all parameters "
            "may be larger by one factor; weigh the load and give its mass in kg"
        )


def _observed(
    args: argparse.Namespace, compiled: CompiledModel, processing: Processing, check: Checked
) -> tuple[Observation, list[Payload]]:
    logs, loaded = (read_currents(compiled, p, args.map) for p in (args.logs, args.payload_log))
    check(args, logs, loaded)
    return observe(compiled, [*logs, *loaded], processing), carried(args, loaded)


def carried(args: argparse.Namespace, loaded: Sequence[Log]) -> list[Payload]:
    """The load of the loaded logs; one for each if it was taken off in between."""
    payload = Payload(tuple(log.name for log in loaded), args.payload_link, args.payload_mass)
    return remounted(payload) if args.payload_moved else [payload]


def _deviations(spec: ModuleSpec, found: GainFit) -> list[str]:
    lines = deviations(spec, found)
    return [f"against the robot file: {'; '.join(lines)}"] if lines else []
