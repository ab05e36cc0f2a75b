"""`modeler fit ROBOT LOG... --payload-log LOG --payload-mass KG --method tls`."""

import argparse
from collections.abc import Callable, Sequence

from modeler.api.gains import Load, found_with_gains
from modeler.cli.console import working
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.derivation import Derivation
from modeler.fit import IdentifiedModel, Payload
from modeler.observation import Log, Observation, Processing

Checked = Callable[[argparse.Namespace, Sequence[Log], Sequence[Log]], None]
"""Refuses logs that do not belong together."""


def fit_with_gains(
    args: argparse.Namespace,
    derivation: Derivation,
    compiled: CompiledModel,
    processing: Processing,
    check: Checked,
) -> tuple[IdentifiedModel, Observation]:
    """The model whose robot file has the drive gains that the logs tell."""
    check_load(args)
    return found_with_gains(
        derivation, compiled, args.logs, _load(args), processing,
        lambda logs, loaded: check(args, logs, loaded), working, args.map,
    )  # fmt: skip


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


def carried(args: argparse.Namespace, loaded: Sequence[Log]) -> list[Payload]:
    """The load of the loaded logs; one for each if it was taken off in between."""
    return _load(args).payloads(loaded)


def _load(args: argparse.Namespace) -> Load:
    return Load(args.payload_log, args.payload_mass, args.payload_link, args.payload_moved)
