"""The ways to fit: one model or the other, with loads or without, in one step or two."""

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.cli.drive_gains import carried
from modeler.compiled import CompiledModel
from modeler.core.choices import TWO_STEPS
from modeler.core.errors import DataError
from modeler.estimate.alone import Directions
from modeler.fit import (
    FitResult,
    are_currents,
    identify,
    identify_energy,
    identify_with_payloads,
    known_doubts,
    two_step,
)
from modeler.fit.doubts import Told
from modeler.observation import Log, Observation
from modeler.robot import Robot
from modeler.robot.motors import joint_directions

_WITHOUT_LOADS = ("iv", "iv-direct", "didim", "consistent", TWO_STEPS)


@dataclass(frozen=True, eq=False)
class Way:
    """What a way to fit ends in.

    Attributes:
        result: not judged yet.
        told: doubts that it raises itself.
        refit: how to fit again without some rows; None: least squares.
        lines: printed above the result.
        further: fields of the JSON.
    """

    result: FitResult
    told: Sequence[Told] = ()
    refit: Callable[[np.ndarray], np.ndarray] | None = None
    lines: Sequence[str] = ()
    further: Mapping[str, Any] = field(default_factory=dict)


def estimated(
    args: argparse.Namespace, robot: Robot, compiled: CompiledModel, observation: Observation,
    logs: Sequence[Log], loaded: Sequence[Log],
) -> Way:  # fmt: skip
    """The fit that the options ask for."""
    if args.model == "energy":
        energy = identify_energy(compiled, observation, args.window, args.method)
        return Way(energy.result, refit=energy.without)
    if args.method == TWO_STEPS:
        ways = Directions(joint_directions(robot))
        steps = two_step.identify_in_two_steps(compiled, observation, ways)
        further = {"two_step": steps.to_json()}
        return Way(steps.result, steps.doubts(), lines=steps.summary(), further=further)
    if loaded:
        payloads = carried(args, loaded)
        result = identify_with_payloads(compiled, observation, payloads, args.method)
        current = are_currents([*logs, *loaded])
        return Way(result, known_doubts(compiled, observation, payloads, current))
    return Way(identify(observation, args.method, compiled))


def check_way(args: argparse.Namespace) -> None:
    """Refuse options that do not go together."""
    for option in ("payload_mass", "payload_link", "payload_moved"):
        value = getattr(args, option)
        if value is not None and value is not False and not args.payload_log:  # 0 is given too
            flag = "--" + option.replace("_", "-")
            raise DataError(f"{flag}: no loaded log; name it with --payload-log LOG")
    if args.payload_log and args.method in _WITHOUT_LOADS:
        raise DataError(
            f"--payload-log: got it with --method {args.method}, which knows no loads; expected "
            "--method weighted, ordinary, robust, ridge or tls"
        )
    if args.model != "energy" and args.window is not None:
        raise DataError("--window: only windows of --model energy have a length; add that option")
    if args.model == "energy" and args.method not in ("weighted", "ordinary"):
        raise DataError(
            f"--method {args.method}: got it with --model energy, whose rows are windows; expected "
            "--method weighted or ordinary"
        )
    if args.model == "energy" and args.payload_log:
        raise DataError(
            "--payload-log: the energy model takes logs without load; leave out --model energy"
        )
